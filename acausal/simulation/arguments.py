"""The arguments of `simulate`, looked at before either engine begins: what is wrong with one is said in its name."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from typing import Any, TypeGuard

import numpy as np

from acausal.errors import SimulationError, UnknownNameError
from acausal.lowering.numeric import is_concrete

from .native_library import METHODS


def check_arguments(system: Any, t1: Any, options: Mapping[str, Any]) -> None:
    """Look at the arguments of `simulate`; of values that JAX traces, at their shapes.

    Raises:
        SimulationError: a value that has no meaning.
        UnknownNameError: a name that the model does not have.
    """
    t0 = options.get("t0", 0.0)
    for name, value in (("t1", t1), ("t0", t0)):
        _number(f"`{name}`", value, "a finite time in seconds")
    _check_control(options)
    _check_output(options.get("saveat"), t0, t1)
    names = system.program.flat.names
    for name, value in _items("parameters", options.get("parameters")):
        _value(f"parameters={{{name!r}: ...}}", value, np.shape(names.find(name, parameter=True)[0]))
    for name, value in _items("initial", options.get("initial")):
        if name in system.input_names:
            raise UnknownNameError(f"`{name}` is an input: its value has its place in simulate(inputs={{...}})")
        what = f"initial={{{name!r}: ...}}"
        array = _value(what, value, np.shape(system.index_of(name)))
        if is_concrete((array,)) and not np.isfinite(array).all():
            raise SimulationError(f"simulate({what}) is {value!r}; a start value is finite.")
    for name, value in _items("inputs", options.get("inputs")):
        _check_input(name, value, t0)


def is_saveat(saveat: Any) -> TypeGuard[Any]:
    """Whether `saveat` is diffrax's `SaveAt` (without importing it)."""
    return type(saveat).__module__.startswith("diffrax")


def asks_for_steps(saveat: Any) -> bool:
    """Whether a `SaveAt` wants more than values at given times: those at steps, between steps, or several lists."""
    return bool(saveat.dense or not hasattr(saveat.subs, "ts") or saveat.subs.steps)


def _check_control(options: Mapping[str, Any]) -> None:
    """Tolerances, steps and switches."""
    rtol, atol, dt = (options.get(name) for name in ("rtol", "atol", "dt"))
    if rtol is not None:
        _number("`rtol`", rtol, "a number, 1e-6 by default", least=0.0)
    if atol is not None:
        _array("`atol`", atol, "numbers, as a fraction of the nominal values", least=0.0)
    if is_concrete((rtol, atol)) and rtol is not None and rtol == 0 and not np.any(0.0 if atol is None else atol):
        raise SimulationError("`rtol` and `atol` are both 0: no step is ever accurate enough; give one of them.")
    if dt is not None and is_concrete(_number("`dt`", dt, "a step in seconds", least=0.0)) and dt == 0:
        raise SimulationError("`dt` = 0: a step takes time; give one in seconds, `simulate(..., dt=1e-3)`.")
    steps = options.get("max_steps")
    if steps is not None and not (_is_integer(steps) and steps > 0):
        raise SimulationError(f"`max_steps` is {steps!r}, not a number of steps.")
    solver = options.get("solver")
    if solver is not None and solver not in METHODS and "AbstractSolver" not in _bases(solver):
        raise SimulationError(
            f"There is no solver {solver!r}; there are {', '.join(map(repr, METHODS))}, and the objects of diffrax."
        )
    events = options.get("events")
    if not (events is None or isinstance(events, bool) or is_saveat(events)):
        raise SimulationError(f"`events` is {events!r}; give True, False, or a `diffrax.Event`.")


def _check_output(saveat: Any, t0: Any, t1: Any) -> None:
    """Output times: some, in the order of the run, and within it."""
    if saveat is None or is_saveat(saveat):
        return
    if _is_integer(saveat):
        if saveat < 1:
            raise SimulationError(f"`saveat` = {saveat}: a whole number is the number of output times, 1 at least.")
        return
    what = "a number of output times (an int), an array of times, or a `diffrax.SaveAt`"
    times = _array("`saveat`", saveat, what)
    if np.ndim(times) != 1 or not np.size(times):
        raise SimulationError(f"`saveat` is {saveat!r}; give {what}.")
    if not is_concrete((times, t0, t1)):
        return
    times, t0, t1 = np.asarray(times, float), float(t0), float(t1)
    outside = ~((times - t0) * (times - t1) <= 1e-12 * (t1 - t0) ** 2)  # also where a time is NaN
    if outside.any():
        raise SimulationError(
            f"`saveat` has the time {times[outside][0]:g} s, outside of the run from {t0:g} s to {t1:g} s."
        )
    back = np.flatnonzero(np.diff(times) * (1.0 if t1 >= t0 else -1.0) < 0)
    if back.size:
        k = int(back[0])
        raise SimulationError(
            f"`saveat` has the time {times[k + 1]:g} s behind {times[k]:g} s: give the times in the order of the run."
        )


def within_run(saveat: Any, t0: Any, t1: Any) -> Any:
    """Output times without what rounding puts beyond the ends of the run: the last of ``np.arange(0.05, 1, 0.1)``."""
    if saveat is None or is_saveat(saveat) or _is_integer(saveat) or not is_concrete((saveat, t0, t1)):
        return saveat
    return np.clip(np.asarray(saveat, float), min(t0, t1), max(t0, t1))


def _items(argument: str, given: Any) -> list[tuple[str, Any]]:
    """The names and values of a dict."""
    if given is None:
        return []
    if not isinstance(given, Mapping):
        raise SimulationError(f"`{argument}` is a {type(given).__name__}; give a dict of dotted names and values.")
    for name in given:
        if not isinstance(name, str):
            raise SimulationError(
                f"`{argument}` has the key {name!r}; the keys are dotted names, as text (`system.parameters` has them)."
            )
    return list(given.items())


def _check_input(name: str, value: Any, t0: Any) -> None:
    """An input: a number, a table, or a function of time."""
    what = f"The input `{name}`"
    if callable(value):
        if is_concrete(t0):
            _check_function(what, value, float(t0))
        return
    if not (isinstance(value, (tuple, list)) and len(value) == 2 and np.ndim(value[0]) == 1):
        expected = "a number, a pair (times, values), or a function of time"
        if np.ndim(_array(what, value, expected)):
            raise SimulationError(f"{what} is a {type(value).__name__}; give {expected}.")
        return
    times, values = (_array(f"{what}: its table", part, "two vectors, (times, values)") for part in value)
    if np.shape(times) != np.shape(values) or not np.shape(times)[0]:
        raise SimulationError(
            f"The table of the input `{name}` has times of shape {np.shape(times)} and values of shape "
            f"{np.shape(values)}; they must be vectors of the same length."
        )
    if is_concrete((times,)) and not (np.diff(np.asarray(times, float)) > 0).all():
        raise SimulationError(f"The times of the input `{name}` must increase.")


def _check_function(what: str, function: Callable[..., Any], t0: float) -> None:
    """A function of time has to be one that JAX can trace, and give a number."""
    import jax
    import jax.numpy as jnp

    try:
        inspect.signature(function).bind(t0)
    except TypeError as error:
        raise SimulationError(f"{what} is a function that does not take the time alone: {error}.") from error
    except ValueError:  # a function without a signature in Python: the trace tells
        pass
    try:
        shape = jax.eval_shape(lambda t: jnp.asarray(function(t), float), t0).shape
    except (jax.errors.JAXTypeError, TypeError, ValueError) as error:
        raise SimulationError(
            f"{what} is a function that JAX cannot follow: {str(error).splitlines()[0]}\n"
            "Try: write it with `jax.numpy` instead of `numpy` or `math`, with `jnp.where` in the place of `if`; or "
            "give a pair (times, values)."
        ) from error
    if shape:
        raise SimulationError(f"{what} is a function that gives an array of shape {shape}, not a number.")


def _value(what: str, value: Any, shape: tuple[int, ...]) -> Any:
    """A value of a parameter or variable, or of all elements of an array of them."""
    array = _array(f"simulate({what})", value, "a number" if shape in ((), (1,)) else f"a number, or {shape} of them")
    try:
        fits = np.broadcast_shapes(np.shape(array), shape) == shape
    except ValueError:
        fits = False
    if not fits:
        has = f"shape {shape}" if shape else "one value"
        raise SimulationError(f"simulate({what}) was given values of shape {np.shape(array)}, but has {has}.")
    return array


def _number(what: str, value: Any, expected: str, *, least: float = -np.inf) -> Any:
    """A finite number, not below `least`."""
    array = _array(what, value, expected, least=least)
    if np.shape(array) != ():
        raise SimulationError(f"{what} is {value!r}; give {expected}.")
    if is_concrete((array,)) and not np.isfinite(array):
        raise SimulationError(f"{what} is {float(array)}; give {expected}.")
    return array


def _array(what: str, value: Any, expected: str, *, least: float = -np.inf) -> Any:
    """Numbers as an array, not below `least`; what JAX traces, or holds, as it is."""
    if hasattr(value, "aval") and not is_concrete((value,)):
        return value
    try:
        array = np.asarray(value)
    except ValueError as error:  # rows of different lengths
        raise SimulationError(f"{what} is {value!r}; give {expected}.") from error
    if array.dtype == object and not is_concrete(value):
        return np.zeros(array.shape)  # a list that holds traced values: its shape is known
    if array.dtype.kind not in "iufb":
        raise SimulationError(f"{what} is {value!r}; give {expected}.")
    if (array < least).any():
        raise SimulationError(f"{what} is {value!r}; it cannot be negative.")
    return array


def _bases(value: Any) -> list[str]:
    return [c.__name__ for c in type(value).__mro__]


def _is_integer(value: Any) -> bool:
    return isinstance(value, (int, np.integer)) and not isinstance(value, bool)
