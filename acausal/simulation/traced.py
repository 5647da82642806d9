"""Solves on the host inside JAX, derivatives by the sensitivities that the solve itself gives.

The tangent of a solve is its sensitivity matrix times the tangents of the values: the solve depends on primals only
and the rest is linear. The native engine solves in a callback, so that forward and reverse mode, `vmap` and `jit` all
go through it. A solve that uses JAX itself cannot be a callback, which might wait for itself: it is carried out where
the values are known, as under `grad`, `jacfwd` and `jacrev`.
"""

from __future__ import annotations

import functools
import os
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any, Protocol

import jax
import jax.numpy as jnp
import numpy as np
from jax.custom_derivatives import SymbolicZero

from acausal.errors import AcausalError, SimulationError

from .cache import ById
from .engines import POINTS
from .hybrid_run import HybridRun
from .inputs import drive
from .jit import inside_jit
from .native_library import RESULTS, Floats
from .solution import Solution
from .started import Given, Seed, Started, Tolerances, parameter_ids
from .watch import Stop, watch


class Model(Protocol):
    """What an engine offers: a run, and one with derivatives, as `acausal.simulation.native.NativeModel`."""

    system: Any

    def run(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, check: bool = True
    ) -> tuple[Started, Any]: ...

    def sensitivities(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, seeds: Sequence[Seed],
        check: bool = True,
    ) -> tuple[Started, Any, Floats, Floats]: ...  # fmt: skip


@dataclass(frozen=True)
class Way:
    """How solves are carried out.

    Attributes:
        solver, engine: names, for the record.
        direct: where the values are known, and not in a callback.
    """

    solver: str
    engine: str
    direct: bool


@dataclass(frozen=True)
class _Spec:
    """What a solve is made for: everything but the numbers.

    Attributes:
        model: the model.
        way: how it is solved.
        parameters, initial: names of the values given.
        tables: for each input, whether it is a table.
        max_steps, throw: as for `simulate`.
    """

    model: ById
    way: Way
    parameters: tuple[str, ...]
    initial: tuple[str, ...]
    tables: tuple[bool, ...]
    max_steps: int
    throw: bool


def simulate_traced(
    model: Model, way: Way, t0: Any, t1: Any, saveat: Any, rtol: Any, atol: Any, dt: Any, parameters: dict[str, Any],
    initial: dict[str, Any], signals: list[tuple[Any, Any]], *, inputs: Any, max_steps: int, throw: bool,
) -> Solution:  # fmt: skip
    """A solve with traced values; the tolerances are those that the model takes."""
    save = _times(saveat, t0, t1)
    tables = tuple(np.shape(t)[0] > 1 for t, _ in signals)
    # JAX keeps callbacks that it has carried out at once, and compiled programs need theirs
    spec = _Spec(ById(model, keep=inside_jit()), way, tuple(parameters), tuple(initial), tables, max_steps, throw)
    values = (
        tuple(jnp.asarray(v, float) for v in parameters.values()),
        tuple(jnp.asarray(v, float) for v in initial.values()),
        tuple(jnp.asarray(v[0], float) for (_, v), table in zip(signals, tables, strict=True) if not table),
    )
    plain = (
        jnp.asarray(t0, float), jnp.asarray(t1, float), save, jnp.asarray(rtol, float), jnp.asarray(atol, float),
        jnp.asarray(0.0 if dt is None else dt, float),
        tuple((jnp.asarray(t, float), jnp.asarray(v, float)) for t, v in signals if np.shape(t)[0] > 1),
    )  # fmt: skip
    x, w, p, counts, slots = _solve(spec, values, plain)
    slots = slots if model.system.hybrid is not None else None
    stats = {"steps": counts[0], "accepted": counts[1], "rejected": counts[2]}
    stats |= {"solver": way.solver, "engine": way.engine}
    if not inputs:
        return Solution(model.system, save, x, w, p, stats=stats, slots=slots)
    lowered, numbers = drive(model.system, inputs)
    return Solution(model.system, save, x, w, (p, numbers), stats=stats, lowered=lowered, slots=slots)


def _times(saveat: Any, t0: Any, t1: Any) -> Any:
    if saveat is None or isinstance(saveat, int):
        return jnp.linspace(jnp.asarray(t0, float), jnp.asarray(t1, float), POINTS if saveat is None else saveat)
    if type(saveat).__module__.startswith("diffrax"):
        sub = saveat.subs
        ends = [jnp.atleast_1d(jnp.asarray(e, float)) for e, wanted in ((t0, sub.t0), (t1, sub.t1)) if wanted]
        middle = [] if sub.ts is None else [jnp.asarray(sub.ts, float)]
        return jnp.concatenate([*ends[:1], *middle, *ends[1:]] if sub.t0 else [*middle, *ends])
    return jnp.atleast_1d(jnp.asarray(saveat, float))


@functools.partial(jax.custom_jvp, nondiff_argnums=(0,))
def _solve(spec: _Spec, values: Any, plain: Any) -> Any:
    """Trajectories x (n_t, n_x) and w (n_t, n_w), parameters (n_p,), counts (3,), and slots (n_t, n_slots)."""
    return _called(spec, None, _shapes(spec, plain[2].shape[0]), values, plain)


def _called(spec: _Spec, moving: tuple[int, ...] | None, shapes: Any, values: Any, plain: Any) -> Any:
    """The host's solve with these values."""
    host = functools.partial(_host, spec, moving)
    if not spec.way.direct:
        return jax.pure_callback(host, shapes, values, plain, vmap_method="broadcast_all")
    with ThreadPoolExecutor(max_workers=1) as pool:  # where JAX does not record what it is asked to do
        return pool.submit(host, values, plain).result()


def _jvp(spec: _Spec, primals: Any, tangents: Any) -> Any:
    values, plain = primals
    d_values, d_plain = tangents
    if any(not isinstance(d, SymbolicZero) for d in jax.tree.leaves(d_plain, is_leaf=_is_zero)):
        raise SimulationError(
            "Parameters, start values and constant inputs are differentiated here; derivatives with respect to "
            "times, tolerances or tables have runs without events on engine='diffrax' only."
        )
    leaves = jax.tree.leaves(d_values, is_leaf=_is_zero)
    moving = tuple(k for k, d in enumerate(leaves) if not isinstance(d, SymbolicZero))
    x, w, p, _, slots = shapes = _shapes(spec, plain[2].shape[0])
    k = sum(int(np.prod(leaves[i].shape)) for i in moving)
    slopes = tuple(jax.ShapeDtypeStruct((*s.shape, k), s.dtype) for s in (x, w, p, slots))
    (x, w, p, counts, slots), (dx, dw, dp, ds) = _called(spec, moving, (shapes, slopes), values, plain)
    direction = jnp.concatenate([jnp.ravel(leaves[i]) for i in moving] or [jnp.zeros(0)])
    still = np.zeros(counts.shape, jax.dtypes.float0)
    slopes = dx @ direction, dw @ direction, dp @ direction, still, ds @ direction
    return (x, w, p, counts, slots), slopes


_solve.defjvp(_jvp, symbolic_zeros=True)  # pyright: ignore[reportUnknownMemberType]


def _is_zero(leaf: Any) -> bool:
    return isinstance(leaf, SymbolicZero)


def _shapes(spec: _Spec, n_t: int) -> Any:
    low = spec.model.thing.system.lowered
    n_p = spec.model.thing.system.program.n_p
    n_slots = spec.model.thing.system.stages.flat.slots.count
    return (
        jax.ShapeDtypeStruct((n_t, low.n_x), float), jax.ShapeDtypeStruct((n_t, low.n_w), float),
        jax.ShapeDtypeStruct((n_p,), float), jax.ShapeDtypeStruct((3,), int),
        jax.ShapeDtypeStruct((n_t, n_slots), float),
    )  # fmt: skip


# ---- on the host ----------------------------------------------------------------------------------
def _host(spec: _Spec, moving: tuple[int, ...] | None, values: Any, plain: Any) -> Any:
    """The callback: batches run on threads, which the interpreter lets go while C runs."""
    values, plain = jax.tree.map(np.asarray, (values, plain))
    batch = plain[0].shape
    if not batch:
        return _one(spec, moving, values, plain)
    members = list(np.ndindex(batch))
    one = _picker(spec, moving, values, plain)
    stop = Stop()

    def until(member: tuple[int, ...]) -> Any:
        with watch.stopping(stop):
            return one(member)

    with ThreadPoolExecutor(max_workers=min(len(members), os.cpu_count() or 1)) as pool:
        try:
            done = list(pool.map(until, members))
        finally:
            stop.asked = True
    if not done:
        raise SimulationError("a batch of simulations is empty")
    return jax.tree.map(lambda *parts: np.stack(parts).reshape((*batch, *np.shape(parts[0]))), *done)


def _picker(spec: _Spec, moving: Any, values: Any, plain: Any) -> Callable[[tuple[int, ...]], Any]:
    def one(at: tuple[int, ...]) -> Any:
        picked = jax.tree.map(lambda a: a[at], (values, plain))
        return _one(spec, moving, *picked)

    return one


def _one(spec: _Spec, moving: tuple[int, ...] | None, values: Any, plain: Any) -> Any:
    """One solve: trajectories, parameters, counts, and with `moving` their slopes."""
    model: Model = spec.model.thing
    low, n_p = model.system.lowered, model.system.program.n_p
    t0, t1, save, rtol, atol, dt, tables = plain
    given = Given(
        dict(zip(spec.parameters, values[0], strict=True)), dict(zip(spec.initial, values[1], strict=True)),
        _signals(spec, values[2], tables),
    )  # fmt: skip
    how = Tolerances(float(rtol), np.asarray(atol), float(dt), spec.max_steps)
    seeds = None if moving is None else _seeds(model, spec, values, moving)
    try:
        if seeds is None:
            started, run = model.run(float(t0), float(t1), save, given, how, check=spec.throw)
            dz, dp = np.zeros((len(run.z), 0, 0)), np.zeros((n_p, 0))
        else:
            started, run, dz, dp = model.sensitivities(float(t0), float(t1), save, given, how, seeds, check=spec.throw)
        if run.code and spec.throw:
            raise SimulationError(
                f"The simulation stopped at t = {run.t_end:.9g} s of {float(t1):.9g} s: "
                f"{RESULTS[run.code].replace('_', ' ')}."
            )
    except AcausalError:
        if spec.throw:
            raise
        shapes = _all(spec, seeds, len(save))
        return jax.tree.map(lambda s: np.full(s.shape, np.nan if s.dtype == float else 0, s.dtype), shapes)
    counts = np.array([run.counts[name] for name in ("steps", "accepted", "rejected")])
    n_x, n_z = low.n_x, low.n_x + low.n_w
    slots = run.slots if isinstance(run, HybridRun) else np.zeros((len(run.z), 0))
    z, slots, dz = (_to(len(save), a) for a in (run.z, slots, dz))
    found = z[:, :n_x], z[:, n_x:], started.p, counts, slots
    return found if seeds is None else (found, (dz[:, :n_x], dz[:, n_x:n_z], dp, dz[:, n_z:]))


def _to(n_t: int, values: Any) -> Any:
    """A trajectory that ended early stays where it is."""
    if len(values) >= n_t or not len(values):
        return values[:n_t] if len(values) else np.full((n_t, *values.shape[1:]), np.nan)
    return np.concatenate([values, np.broadcast_to(values[-1], (n_t - len(values), *values.shape[1:]))])


def _all(spec: _Spec, seeds: Any, n_t: int) -> Any:
    """Shapes of what a solve returns."""
    shapes = _shapes(spec, n_t)
    if seeds is None:
        return shapes
    x, w, p, _, slots = shapes
    return shapes, tuple(jax.ShapeDtypeStruct((*s.shape, len(seeds)), float) for s in (x, w, p, slots))


def _signals(spec: _Spec, constants: Sequence[Any], tables: Sequence[Any]) -> list[Any]:
    constant, table = iter(constants), iter(tables)
    return [next(table) if is_table else (np.zeros(1), np.reshape(next(constant), 1)) for is_table in spec.tables]


def _seeds(model: Model, spec: _Spec, values: Any, moving: tuple[int, ...]) -> list[Seed]:
    """Directions of the moving values, one for each element."""
    representative, sign = model.system.observed_ids
    places: list[tuple[str, Any, Any]] = []
    for name in spec.parameters:
        ids = parameter_ids(model.system, name)
        places.append(("parameter", ids, np.ones(len(ids))))
    for name in spec.initial:
        ids = np.ravel(model.system.index_of(name))
        places.append(("initial", representative[ids], sign[ids].astype(float)))
    places += [("input", np.array([k]), np.ones(1)) for k, table in enumerate(spec.tables) if not table]
    leaves = [*values[0], *values[1], *values[2]]
    seeds: list[Seed] = []
    for k in moving:
        kind, ids, signs = places[k]
        if np.ndim(leaves[k]) == 0:
            seeds.append(Seed(kind, tuple(ids.tolist()), tuple(signs.tolist())))
        else:
            seeds += [Seed(kind, (int(i),), (float(s),)) for i, s in zip(ids, signs, strict=True)]
    return seeds
