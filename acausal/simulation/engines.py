"""Which engine runs a simulation: generated C where it can, diffrax otherwise."""

from __future__ import annotations

import time
import warnings
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.asserted import check_run
from acausal.bounded import check_bounds
from acausal.errors import SimulationError, UnknownNameError, nearest
from acausal.lowering.c.text import NotInC
from acausal.lowering.numeric import is_concrete
from acausal.poles import check_poles
from acausal.told import users_level

from .arguments import asks_for_steps, check_arguments, is_saveat, within_run
from .hybrid_run import HybridRun
from .native import NativeModel, native_model
from .native_build import NoCompiler, compiler
from .native_library import METHODS, RESULTS, Floats, Run, Signal
from .started import Given, Tolerances
from .watch import watch

if TYPE_CHECKING:
    from .solution import Solution

ENGINES = ("auto", "diffrax", "native")
POINTS = 501
ATOL = 0.1
INVARIANT_SAFETY = 0.1
MAX_STEPS = 1_000_000
MAX_EXPLICIT_STEPS = 100_000_000
"""Explicit methods take many small steps on stiff models."""
_said: set[str] = set()
_NAMES = {"rodas5p": "Rodas5P", "rk4": "RK4", "adams": "Adams"}


def simulate(system: Any, t1: Any, *, engine: str = "auto", **options: Any) -> Solution:
    """As `acausal.simulation.simulate.simulate`, with the engine chosen.

    Raises:
        SimulationError: there is no such engine, or it cannot do what is asked; the message says why.
    """
    if engine not in ENGINES:
        raise SimulationError(f"There is no engine {engine!r}; there are {', '.join(map(repr, ENGINES))}.")
    solution = _solved(system, t1, engine, options)
    if options.get("throw", True) and is_concrete((solution.t, solution.x)):
        values = solution.reader()
        check_run(solution, values)
        check_bounds(solution, values, float(options.get("rtol") or 1e-6))
        check_poles(solution, values)
    return solution


def _solved(system: Any, t1: Any, engine: str, options: dict[str, Any]) -> Solution:
    """The solution by the engine that can give it."""
    check_arguments(system, t1, options)
    options["saveat"] = within_run(options.get("saveat"), options.get("t0", 0.0), t1)
    system = system_to_run(system, options, engine)
    if engine != "diffrax":
        reason = why_not_native(system, options)
        if reason is None:
            return _native(system, t1, **{k: v for k, v in options.items() if v is not None})
        if engine == "native":
            raise SimulationError(f"The native engine cannot run this: {reason}. Take engine='diffrax' or 'auto'.")
    if system.hybrid is not None:
        from .hybrid_diffrax import simulate_events

        return simulate_events(system, t1, **options)
    from .simulate import simulate as with_diffrax

    return with_diffrax(system, t1, engine="diffrax", **_telling(system, options))


def system_to_run(system: Any, options: Mapping[str, Any], engine: str) -> Any:
    """The system with its events located, or as it is where they are switched off.

    Raises:
        SimulationError: events cannot be switched off in a model with `when`.
    """
    if options.get("events", True) is False:
        if system.hybrid is not None:
            raise SimulationError(
                f"The model `{system.name}` has `when` statements or discrete variables: it does not run with "
                "events=False."
            )
        return system
    located = system.located
    if located.hybrid is None:
        return system
    if engine != "diffrax" and why_not_native(located, options) is None:
        return located
    # a compiled program of JAX cannot leave itself for an event: there a solver steps over conditions
    return located if system.hybrid is not None or _known(options) else system


def _known(options: Mapping[str, Any]) -> bool:
    """Whether the numbers of a run are known, though derivatives may be being taken with diffrax."""
    if is_concrete(list(options.values())):
        return True
    from .jit import values_are_known

    return options.get("adjoint") is None and values_are_known(list(options.values()))


def _telling(system: Any, options: dict[str, Any]) -> dict[str, Any]:
    """The options; if derivatives are taken, it is said once that they leave out what happens at conditions."""
    located = system.located
    if options.get("events", True) is not True or located.hybrid is None or is_concrete(list(options.values())):
        return options
    from .jit import told_when_differentiated

    def tell() -> None:
        if not system.cache.get("told"):
            system.cache["told"] = True
            hybrid = located.hybrid
            conditions = "\n".join(f"    {hybrid.text(s)}" for s in hybrid.roots.slots[:3].tolist())
            warnings.warn(
                f"These derivatives are those of a run of `{system.name}` that steps over its conditions, as a program "
                "that JAX compiles has to on the diffrax engine. They are right where the equations are continuous "
                f"over a condition, and leave out the jump where they are not:\n{conditions}\nTake the native engine, "
                "leave out jax.jit and jax.vmap, or say events=False to accept it.",
                stacklevel=users_level(),
            )

    return {k: told_when_differentiated(v, tell) for k, v in options.items()}


def why_not_native(system: Any, options: Mapping[str, Any]) -> str | None:
    """Why the native engine cannot run a simulation with these options; None if it can."""
    for name in ("stepsize_controller", "adjoint"):
        if options.get(name) is not None:
            return f"`{name}=` is one of diffrax"
    method = options.get("solver")
    if method is not None and method not in METHODS:
        return f"`solver=` is a diffrax solver (there are {', '.join(map(repr, METHODS))})"
    if method not in (None, "rodas5p") and not is_concrete(list(options.values())):
        return f"derivatives and batches of `solver={method!r}` are not there"
    if not isinstance(options.get("events", True), bool):
        return "`events=` is a diffrax event"
    saveat = options.get("saveat")
    if is_saveat(saveat) and asks_for_steps(saveat):
        return "`saveat=` asks for the solver's own steps"
    for name, value in (options.get("inputs") or {}).items():
        if callable(value):
            return f"the input `{name}` is a Python function (a number or a table (times, values) can be used)"
    return _why_not(system)


def _why_not(system: Any) -> str | None:
    """Why this system cannot run natively; found once."""
    if "why_not_native" not in system.cache:
        system.cache["why_not_native"] = _find_out(system)
    return system.cache["why_not_native"]


def _find_out(system: Any) -> str | None:
    try:
        compiler()
        native_model(system)
    except NoCompiler as error:
        if "compiler" not in _said:
            _said.add("compiler")
            warnings.warn(f"{error} Simulations run with diffrax until then.", stacklevel=users_level())
        return "there is no C compiler"
    except NotInC as error:
        return str(error)
    return None


def _native(
    system: Any, t1: Any, *, t0: Any = 0.0, parameters: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None, inputs: Mapping[str, Any] | None = None, saveat: Any = None,
    rtol: Any = 1e-6, atol: Any = None, events: Any = True, max_steps: int | None = None, throw: bool = True,
    progress: bool = False, dt: Any = None, solver: str = "rodas5p",
) -> Solution:  # fmt: skip
    """Run with the native engine; that it can do what is asked is known (`why_not_native`)."""
    if solver == "rk4" and dt is None:
        raise SimulationError("The method 'rk4' takes fixed steps: give the step, `simulate(..., dt=1e-3)`.")
    del events
    if max_steps is None:
        max_steps = MAX_STEPS if solver == "rodas5p" else MAX_EXPLICIT_STEPS
    model = native_model(system)
    signals = all_signals(system, inputs)
    arguments = (t0, t1, saveat, rtol, atol, dt, dict(parameters or {}), dict(initial or {}), signals)
    if not is_concrete(arguments):
        from .traced import Way, simulate_traced

        arguments = (t0, t1, saveat, *_scaled(system, rtol, atol), *arguments[5:])
        way = Way(_NAMES[solver], "native", direct=False)
        return simulate_traced(model, way, *arguments, inputs=inputs, max_steps=max_steps, throw=throw)
    t0, t1 = float(t0), float(t1)
    given = Given(parameters or {}, initial or {}, [(np.asarray(t, float), np.asarray(v, float)) for t, v in signals])
    save = output_times(saveat, t0, t1)
    begin = time.perf_counter()
    model.native_library(solver)
    compiled = time.perf_counter()
    how = tolerances(system, rtol, atol, dt, max_steps)
    how.method = solver
    with watch.showing(t0, t1) if progress else nullcontext():
        started, run = model.run(t0, t1, save, given, how, check=throw)
    seconds = compiled - begin, time.perf_counter() - compiled
    return finish(model, save, started.p, run, given.signals, seconds, t1, max_steps, method=solver, throw=throw)


def output_times(saveat: Any, t0: float, t1: float) -> Floats:
    """Output times of a concrete run."""
    if saveat is None or isinstance(saveat, (int, np.integer)):
        return np.linspace(t0, t1, POINTS if saveat is None else saveat)
    if is_saveat(saveat):
        sub = saveat.subs
        times = [] if sub.ts is None else [np.asarray(sub.ts, float)]
        ends = [[t0]] if sub.t0 else []
        return np.concatenate([*ends, *times, *([[t1]] if sub.t1 else [])]).astype(float)
    return np.asarray(saveat, float)


def tolerances(system: Any, rtol: Any, atol: Any, dt: Any, max_steps: int) -> Tolerances:
    """Tolerances of each unknown: as in the diffrax engine."""
    return Tolerances(*_scaled(system, float(rtol), atol, np), 0.0 if dt is None else float(dt), max_steps)


def _scaled(system: Any, rtol: Any, atol: Any, xp: Any = None) -> tuple[Any, Any]:
    """Relative and absolute tolerances, the latter of each unknown; with JAX where no other module is given."""
    if xp is None:
        import jax.numpy as xp
    low = system.lowered
    safety = INVARIANT_SAFETY if low.n_g else 1.0
    given = xp.asarray(ATOL * rtol if atol is None else atol, float)
    relative = xp.broadcast_to(given, (low.n_x,))
    return safety * rtol, safety * xp.concatenate([relative * low.x_nominal, given.min() * low.w_nominal])


def all_signals(system: Any, inputs: Mapping[str, Any] | None) -> list[tuple[Any, Any]]:
    """Every input of the model as a signal, those not given at their start value.

    Raises:
        UnknownNameError: the model has no such input.
    """
    names = tuple(system.input_names)
    flat = system.program.flat
    first = flat.n_par
    signals: list[tuple[Any, Any]] = [
        (np.zeros(1), system.program.base[first + k : first + k + 1]) for k in range(len(names))
    ]
    for name, value in (inputs or {}).items():
        if name not in names:
            known = nearest(name, names) or f" Its inputs are: {', '.join(names) or 'none'}."
            raise UnknownNameError(f"The model has no input `{name}`.{known}")
        signals[names.index(name)] = _signal(value)
    return signals


def _signal(value: Any) -> tuple[Any, Any]:
    if isinstance(value, (tuple, list)):
        return value[0], value[1]
    return np.zeros(1), value[None] if hasattr(value, "shape") else np.array([float(value)])


def finish(
    model: NativeModel, save: Floats, p: Floats, run: Run | HybridRun, signals: Sequence[Signal],
    seconds: tuple[float, float], t1: float, max_steps: int, *, method: str, throw: bool,
) -> Solution:  # fmt: skip
    """The solution of a concrete run; raises where it failed."""
    from .solution import Solution

    system = model.system
    low = system.lowered
    counts = run.counts
    stats: dict[str, Any] = {k: counts[k] for k in ("steps", "accepted", "rejected")}
    if method == "rodas5p":
        stats |= {"rhs": 8 * counts["steps"], "jacobians": counts["accepted"]}
    stats |= {"solver": _NAMES[method], "engine": "native"}
    stats |= {"compile_seconds": seconds[0], "run_seconds": seconds[1], "t_end": run.t_end}
    if isinstance(run, HybridRun):
        z, t, slots, events, result = run.z, run.save, run.slots, tuple(run.events), run.result
        p_end = run.p_end  # with the modes that the run has ended in
    else:
        z, t, slots, events, result = run.z[: run.saved], save[: run.saved], None, (), RESULTS[run.code]
        p_end = p

    def observe(t: Any, z: Any) -> Any:
        return model.observe(t, z, p, signals, slots)

    x, w = z[:, : low.n_x], z[:, low.n_x :]
    solution = Solution(system, t, x, w, p, stats=stats, result=result, events=events, observe=observe)
    solution.strict = throw
    if throw and run.code:
        from .failure import explain

        last = run.t_end, run.z_end[: low.n_x], run.z_end[low.n_x :]
        raise SimulationError(explain(system, low, RESULTS[run.code], stats, last, p_end, t1, max_steps))
    return solution
