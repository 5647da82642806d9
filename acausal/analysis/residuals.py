r"""Residuals of a model against measurements, and their exact Jacobian.

$r_{ek} = (y(t_{ek}; \theta) - \hat y_{ek}) / \sigma_{ek}$ over all experiments e and samples k. Experiments of the same
kind (the same signals, numbers of samples and given names) are one batch of one program; the measured values are
arguments, so that another data set of the same shape needs no compilation.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UnknownNameError, nearest
from ..language.template import Floats, Ints
from .experiments import Experiment, Signal, signals_of
from .priors import CalibrationError, Prior, as_prior, decode

if TYPE_CHECKING:
    from ..system import System

FAILED = 1e8
"""Residual of a sample that a failed simulation did not reach: no step of the optimizer is accepted there."""


@dataclass(frozen=True, slots=True)
class Free:
    """A quantity to be found.

    Attributes:
        name: its name in results: a dotted name, with ``@experiment`` if it belongs to one experiment.
        target: dotted name in the model.
        initial: whether it is a start value and not a parameter.
        experiment: index of the experiment it belongs to, or -1 for all.
        prior: what is known about it.
        start: where the search begins.
    """

    name: str
    target: str
    initial: bool
    experiment: int
    prior: Prior
    start: float


@dataclass(frozen=True, eq=False)
class Group:
    """Experiments with the same signals, numbers of samples and names of given values, as one batch of n runs.

    Attributes:
        members: indices of the experiments.
        ids: (n_signals,) places of the signals in the vector of all variables.
        t: (n, n_t) output times: all times of all signals.
        rows: for each signal (n, n_s): which output times are its own.
        y: for each signal (n, n_s): values.
        t0: (n,) start times.
        own: for each free quantity that these experiments have: its name in the model, whether it is a start value,
            and (n,) its index among the free quantities.
        parameters, initial, tables: names and values (n, ...) of given parameters, start values, and inputs.
        functions: inputs that are functions, shared by the batch.
    """

    members: tuple[int, ...]
    ids: Ints
    t: Floats
    rows: tuple[Ints, ...]
    y: tuple[Floats, ...]
    t0: Floats
    own: tuple[tuple[str, bool, Ints], ...]
    parameters: dict[str, Floats]
    initial: dict[str, Floats]
    tables: dict[str, Any]
    functions: dict[str, Callable[[Any], Any]] = field(default_factory=dict)

    @property
    def arrays(self) -> dict[str, Any]:
        """What the compiled program takes as an argument."""
        return {
            "t": self.t, "rows": self.rows, "y": self.y, "t0": self.t0, "own": tuple(index for *_, index in self.own),
            "parameters": self.parameters, "initial": self.initial, "tables": self.tables,
        }  # fmt: skip


class Problem:
    """A model, experiments, and what is free.

    Attributes:
        system: the model.
        experiments, signals: one entry an experiment.
        free: the free quantities, shared ones first; this is the order of all vectors and matrices.
        options: of `System.simulate`.
    """

    def __init__(
        self,
        system: System,
        experiments: Sequence[Experiment],
        free: Mapping[str, Any],
        start: Mapping[str, float],
        options: Mapping[str, Any],
    ) -> None:
        self.system = system
        self.experiments = tuple(experiments)
        self.signals = tuple(signals_of(system, e) for e in experiments)
        self.free = _free(system, self.experiments, free, start)
        self.options = dict(options)
        self.groups = _groups(self.experiments, self.signals, self.free)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the free quantities."""
        return tuple(f.name for f in self.free)

    @cached_property
    def order(self) -> tuple[tuple[int, int, slice], ...]:
        """(experiment, signal, rows of the residual vector) in the order of the residual vector."""
        out: list[tuple[int, int, slice]] = []
        at = 0
        for group in self.groups:
            for row, member in enumerate(group.members):
                for k in range(len(group.ids)):
                    n = len(group.y[k][row])
                    out.append((member, k, slice(at, at + n)))
                    at += n
        return tuple(out)

    @property
    def size(self) -> int:
        """Number of samples."""
        return self.order[-1][2].stop

    def residual_and_jacobian(self, values: Any, sigma: Any) -> tuple[Floats, Floats]:
        """Residuals (n,) and their derivatives by the values of the free quantities (n, n_free).

        Args:
            values: of the free quantities, (n_free,).
            sigma: standard deviation of each sample, (n,).
        """
        r, jacobian = self.program("value", value_program)(np.asarray(values, float), self.arguments(sigma))
        return np.asarray(r), np.asarray(jacobian)

    def arguments(self, sigma: Any) -> dict[str, Any]:
        """Everything that a compiled program needs besides the free quantities."""
        numbers = np.array([f.prior.numbers for f in self.free], float)
        return {"a": numbers[:, 0], "b": numbers[:, 1], "sigma": np.asarray(sigma, float),
                "groups": [g.arrays for g in self.groups]}  # fmt: skip

    def program(self, kind: str, make: Callable[..., Callable[..., Any]], *settings: Any) -> Callable[..., Any]:
        """The compiled function ``make(problem, *settings)``, shared by all problems of this structure."""
        from ..simulation.cache import cache_of
        from ..simulation.jit import jit

        structure = (
            tuple(f.prior.kind for f in self.free),
            tuple(
                (tuple(g.ids), tuple(o[:2] for o in g.own), tuple((k, id(v)) for k, v in g.functions.items()))
                for g in self.groups
            ),
            tuple(sorted((k, repr(v)) for k, v in self.options.items())),
        )
        cache = cache_of(self.system.lowered)
        key = ("calibrate", kind, structure, settings)
        if key not in cache:
            # the functions are kept with the program: their identities are part of the key
            cache[key] = (jit(make(self, *settings)), [g.functions for g in self.groups])
        return cache[key][0]

    def residual(self, values: Any, arguments: Any) -> Any:
        """Residuals (n,) with JAX; a sample that the simulation did not reach has the residual `FAILED`."""
        import jax
        import jax.numpy as jnp

        parts: list[Any] = []
        for group, arrays in zip(self.groups, arguments["groups"], strict=True):
            if len(group.members) == 1:
                parts.append(self._deviation(group, values, jax.tree.map(lambda a: a[0], arrays)))
            else:
                parts.append(jax.vmap(lambda arrays, g=group: self._deviation(g, values, arrays))(arrays).ravel())
        r = jnp.concatenate(parts) / arguments["sigma"]
        return jnp.where(jnp.isfinite(r), r, FAILED)

    def _deviation(self, group: Group, values: Any, arrays: Any) -> Any:
        """Simulated less measured values of one experiment, all signals one after the other."""
        import jax
        import jax.numpy as jnp

        parameters, initial = dict(arrays["parameters"]), dict(arrays["initial"])
        for (target, is_start, _), index in zip(group.own, arrays["own"], strict=True):
            (initial if is_start else parameters)[target] = values[index]
        inputs = {**arrays["tables"], **group.functions} or None
        solution = self.system.simulate(
            arrays["t"][-1], t0=arrays["t0"], parameters=parameters, initial=initial, saveat=arrays["t"], throw=False,
            **_forward(self.system, {**self.options, "inputs": inputs}),
        )  # fmt: skip
        observe: Any = solution.lowered.observe
        y = jax.vmap(lambda t, x, w: observe(t, x, w, solution.p, group.ids))(solution.t, solution.x, solution.w)
        simulated = jnp.concatenate([y[rows, k] for k, rows in enumerate(arrays["rows"])])
        return simulated - jnp.concatenate(arrays["y"])


def _forward(system: System, options: dict[str, Any]) -> dict[str, Any]:
    """Options of `simulate` for forward sensitivities: the diffrax engine wants to know the direction."""
    from ..simulation.engines import why_not_native

    native = options["engine"] != "diffrax" and why_not_native(system, options) is None
    if native or options["engine"] == "native" or "adjoint" in options:
        return options
    import diffrax

    return {**options, "engine": "diffrax", "adjoint": diffrax.ForwardMode()}


def value_program(problem: Problem) -> Callable[..., Any]:
    """(values, arguments) -> residuals and Jacobian."""
    import jax

    def both(values: Any, arguments: Any) -> tuple[Any, Any]:
        def twice(v: Any) -> tuple[Any, Any]:
            r = problem.residual(v, arguments)
            return r, r

        jacobian, r = jax.jacfwd(twice, has_aux=True)(values)
        return r, jacobian

    return both


def decoded(problem: Problem, z: Any, arguments: Any) -> Any:
    """Values (n_free,) for internal coordinates, with JAX."""
    import jax.numpy as jnp

    return jnp.stack(
        [decode(f.prior.kind, arguments["a"][k], arguments["b"][k], z[k]) for k, f in enumerate(problem.free)]
    )


# ---- what is free ---------------------------------------------------------------------------------------------------
def _free(
    system: System, experiments: Sequence[Experiment], free: Mapping[str, Any], start: Mapping[str, float]
) -> tuple[Free, ...]:
    """Checked free quantities: the shared ones, then those of each experiment.

    Raises:
        UnknownNameError: neither a parameter nor a variable.
        CalibrationError: a dependent parameter, a start outside the bounds, a value that is given and free.
    """
    found = [_one_free(system, name, given, -1, "", experiments, start) for name, given in free.items()]
    for k, e in enumerate(experiments):
        found += [_one_free(system, name, given, k, e.name, experiments, start) for name, given in e.free.items()]
    shared = {f.target for f in found if f.experiment < 0}
    twice = [f for f in found if f.experiment >= 0 and f.target in shared]
    if twice:
        raise CalibrationError(f"`{twice[0].target}` is free for all experiments and for one of them; choose one")
    if not found:
        raise CalibrationError("nothing is free: `free` names no parameter and no start value")
    unused = [name for name in start if name not in {f.name for f in found}]
    if unused:
        raise CalibrationError(f"`start` names `{unused[0]}`, which is not free.{nearest(unused[0], _names(found))}")
    return tuple(found)


def _names(found: Sequence[Free]) -> list[str]:
    return [f.name for f in found]


def _one_free(
    system: System, target: str, given: Any, k: int, where: str, experiments: Sequence[Experiment],
    start: Mapping[str, float],
) -> Free:  # fmt: skip
    name = f"{target}@{where}" if where else target
    initial = target not in system.parameters
    if initial:
        _check_start_value(system, target)
    prior = as_prior(name, given)
    concerned = experiments if k < 0 else experiments[k : k + 1]
    for e in concerned:
        if target in (e.initial if initial else e.parameters):
            raise CalibrationError(f"{e.name}: `{target}` is free and given at once; take it out of one of the two")
    if name in start:
        value = float(start[name])
    elif initial:
        value = _default_start(system, target, prior)
    else:
        value = system.parameters[target]
    low, high = prior.range
    if not np.isfinite(value):
        value = float(prior.quantile(0.5))
    if not low < value < high:
        hint = "it is at the bound" if value in (low, high) else "it lies outside"
        raise CalibrationError(
            f"the search for `{name}` would begin at {value:g}, and {hint} ({low:g} to {high:g}): "
            f'widen the bounds, or give start={{"{name}": ...}}'
        )
    if not initial:
        _check_declared(system, target, name, prior)
    return Free(name, target, initial, k, prior, value)


def _check_declared(system: System, target: str, name: str, prior: Prior) -> None:
    """The bounds of a parameter lie within those that the model declares; an unbounded prior may pass them."""
    flat = system.stages.flat
    ids, _ = flat.names.find(target, parameter=True)
    declaration = flat.names.declaration(int(np.ravel(ids)[0]), parameter=True)
    low, high = prior.range
    if declaration.min is not None and np.isfinite(low) and low < declaration.min:
        raise CalibrationError(f"`{name}` may go down to {low:g}, below its declared minimum {declaration.min:g}")
    if declaration.max is not None and np.isfinite(high) and high > declaration.max:
        raise CalibrationError(f"`{name}` may go up to {high:g}, above its declared maximum {declaration.max:g}")


def _check_start_value(system: System, target: str) -> None:
    """A free name that is no tunable parameter must be a scalar variable."""
    flat = system.stages.flat
    try:
        ids = np.ravel(system.index_of(target))
    except UnknownNameError as error:
        if target in flat.names.all_parameters:
            raise CalibrationError(
                f"`{target}` is computed from other parameters and is not tunable by itself; free those instead"
            ) from None
        known = [*system.parameters, *flat.names.all_variables]
        raise UnknownNameError(
            f"`{target}` is neither a parameter nor a variable of `{system.name}`.{nearest(target, known)}"
        ) from error
    if len(ids) != 1:
        raise CalibrationError(f"`{target}` is an array of {len(ids)} variables; free each by its own name")


def _default_start(system: System, target: str, prior: Prior) -> float:
    """The model's own start value of a variable if the bounds hold it, else the middle of the prior."""
    x0, _, _ = system.initialize()
    low, high = prior.range
    if target in system.states:
        value = float(np.asarray(x0)[system.states.index(target)])
        if low < value < high:
            return value
    return float(prior.quantile(0.5))


# ---- batches --------------------------------------------------------------------------------------------------------
def _groups(
    experiments: Sequence[Experiment], signals: Sequence[tuple[Signal, ...]], free: Sequence[Free]
) -> tuple[Group, ...]:
    """Experiments that can be one batch, in the order of their first member."""
    kinds: dict[Any, list[int]] = {}
    for k, (e, measured) in enumerate(zip(experiments, signals, strict=True)):
        times, _ = _union(measured)
        tables, functions = _inputs(e)
        shapes = tuple((n, np.shape(v[0]) if isinstance(v, tuple) else np.shape(v)) for n, v in tables.items())
        kind = (
            tuple((s.index, len(s.t)) for s in measured), len(times), tuple(e.parameters), tuple(e.initial), shapes,
            tuple((name, id(f)) for name, f in functions.items()), tuple(e.free),
        )  # fmt: skip
        kinds.setdefault(kind, []).append(k)
    return tuple(_group(members, experiments, signals, free) for members in kinds.values())


def _group(
    members: list[int], experiments: Sequence[Experiment], signals: Sequence[tuple[Signal, ...]], free: Sequence[Free]
) -> Group:
    first = experiments[members[0]]
    grids = [_union(signals[m]) for m in members]
    n_signals = len(signals[members[0]])
    tables = [_inputs(experiments[m])[0] for m in members]

    own: dict[tuple[str, bool], list[int]] = {}
    for k, f in enumerate(free):
        if f.experiment < 0:
            own[f.target, f.initial] = [k] * len(members)
    for m in members:
        for k, f in enumerate(free):
            if f.experiment == m:
                own.setdefault((f.target, f.initial), []).append(k)

    def stacked(name: str) -> Any:
        one = tables[0][name]
        if isinstance(one, tuple):
            return tuple(np.stack([np.asarray(t[name][i], float) for t in tables]) for i in (0, 1))
        return np.stack([np.asarray(t[name], float) for t in tables])

    return Group(
        members=tuple(members),
        ids=np.array([s.index for s in signals[members[0]]], np.int64),
        t=np.stack([t for t, _ in grids]),
        rows=tuple(np.stack([rows[k] for _, rows in grids]) for k in range(n_signals)),
        y=tuple(np.stack([signals[m][k].y for m in members]) for k in range(n_signals)),
        t0=np.array([experiments[m].t0 for m in members], float),
        own=tuple((target, initial, np.array(index)) for (target, initial), index in own.items()),
        parameters={n: np.array([experiments[m].parameters[n] for m in members], float) for n in first.parameters},
        initial={n: np.array([experiments[m].initial[n] for m in members], float) for n in first.initial},
        tables={name: stacked(name) for name in tables[0]},
        functions=_inputs(first)[1],
    )


def _inputs(experiment: Experiment) -> tuple[dict[str, Any], dict[str, Any]]:
    """Inputs that are numbers or tables, and those that are functions."""
    given = dict(experiment.inputs or {})
    functions = {name: value for name, value in given.items() if callable(value)}
    return {name: value for name, value in given.items() if name not in functions}, functions


def _union(signals: Sequence[Signal]) -> tuple[Floats, tuple[Ints, ...]]:
    """All times of all signals, and for each signal which of them are its own."""
    times = np.unique(np.concatenate([s.t for s in signals]))
    return times, tuple(np.searchsorted(times, s.t) for s in signals)
