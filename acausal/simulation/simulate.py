"""`simulate`: builds the solve for a system, compiles it once, runs it, and says what went wrong where."""

from __future__ import annotations

import inspect
import time
from collections.abc import Callable, Mapping
from typing import Any

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import SimulationError

from .cache import ById, cache_of, without_keeping
from .continuation import follow_in_time, undetermined
from .controller import ROUNDING, ErrorControl
from .failure import explain
from .inputs import drive
from .jit import compiled_for, ensure_x64, inside_jit, is_traced
from .kinks import kinks
from .linear_solvers import AbstractLinearSolver, DenseLU
from .lowered import Lowered, dimensions
from .projection import Conserving, Projected, WithAlgebraic, project
from .rk4 import RK4
from .rodas5p import Rodas5P
from .solution import Solution
from .sparse import DENSE_BELOW, SparseKLU, free_factors, sparse_linear_solver
from .start import start
from .switch import Switch, Watched

POINTS = 501
"""Output points when `saveat` is not given."""
INVARIANT_SAFETY = 0.1
"""Factor on the tolerances of systems with retained constraints: their velocities and multipliers, which the error
control does not see or sees together with the positions, are about a digit less accurate than the positions."""
MAX_STEPS = 1_000_000
ATOL = 0.1
"""Default absolute tolerance, as a multiple of `rtol`."""
FIRST_STEP = 1e-6
"""First step of an adaptive solve, as a part of the time span: the controller raises it tenfold or lowers it fivefold
a step, so that a better guess would save a few steps, and cost another copy of the vector field to compile."""
_RESULTS = (
    "successful", "event_occurred", "max_steps_reached", "dt_min_reached", "max_steps_rejected",
    "nonlinear_max_steps_reached", "nonlinear_divergence", "singular", "internal_error",
)  # fmt: skip


def simulate(
    system: Any,
    t1: Any,
    *,
    t0: Any = 0.0,
    parameters: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None,
    inputs: Mapping[str, Any] | None = None,
    saveat: Any = None,
    rtol: Any = 1e-6,
    atol: Any = None,
    solver: diffrax.AbstractSolver[Any] | str | None = None,
    engine: str = "auto",
    events: Any = True,
    max_steps: int | None = None,
    throw: bool = True,
    progress: bool = False,
    dt: Any = None,
    stepsize_controller: diffrax.AbstractStepSizeController[Any, Any] | None = None,
    adjoint: diffrax.AbstractAdjoint | None = None,
) -> Solution:
    """Solves a system from `t0` to `t1` with the diffrax engine.

    The program is compiled once for each kind of solve (solver, kind and number of output points, options); other
    parameter values, start values, times and tolerances reuse it. It works under `jax.jit`, `vmap` and `grad`,
    and then neither checks nor times anything.

    Args:
        system: offers `lowered`, `initialize(t0, parameters, initial) -> (x0, w0, p)`, and the names.
        t1: end time [s]; before `t0` to integrate backwards.
        t0: start time [s].
        parameters: values of some parameters by dotted name.
        initial: start values of some variables by dotted name.
        inputs: input name to a number, a pair (times, values), or a function of time written with `jax.numpy`.
        saveat: output times: `None` for 501 equidistant points, a number of points, an array of times, or a
            `diffrax.SaveAt` (steps, ends or times).
        rtol: relative tolerance.
        atol: absolute tolerance as a fraction of each variable's nominal value, a number or shape (n_x,);
            default a tenth of `rtol`. No variable's error estimate of a step exceeds
            `atol * nominal + rtol * |value|`.
        solver: a diffrax solver, or `"rodas5p"` or `"rk4"`; default `Rodas5P()`, which solves states and tearing
            variables together. Any other integrates the states, and the tearing variables are solved in the vector
            field.
        engine: `"diffrax"`, or `"auto"`.
        events: `True`, `False`, or a `diffrax.Event`.
        max_steps: most steps, taken and rejected together.
        throw: raise `SimulationError` when the solve fails; otherwise the solution ends early and says so in `result`.
        progress: show a progress bar (not under JAX transformations).
        dt: step [s] of a fixed-step solve (`RK4()`), or the first step of an adaptive one.
        stepsize_controller: default `ErrorControl` with the tolerances, or constant steps for a solver
            without an error estimate.
        adjoint: how diffrax differentiates; `diffrax.ForwardMode()` for `jax.jvp` and `jax.jacfwd`.

    Returns:
        The solution.

    Raises:
        SimulationError: the solve failed; names the time, the variable and, if it is known, the equation.
    """
    if engine not in ("auto", "diffrax"):
        raise SimulationError(f"There is no engine {engine!r} here; take 'diffrax' or 'auto'.")
    ensure_x64()
    lowered: Lowered = system.lowered
    if inputs:
        lowered, numbers = drive(system, inputs)
        at_start = dict(zip(inputs, lowered.values(t0, numbers), strict=True))
        x0, w0, p, start_seconds = start(system, t0, parameters, initial, at_start, check=throw)
        p = (p, numbers)
    else:
        x0, w0, p, start_seconds = start(system, t0, parameters, initial, {}, check=throw)
    n_x, _, _ = dimensions(lowered)
    method = with_linear_solver(chosen_solver(solver), lowered)
    points, kind = _output(saveat, t0, t1)
    relative = jnp.asarray(rtol, float)
    absolute = jnp.broadcast_to(ATOL * relative if atol is None else jnp.asarray(atol, float), (n_x,))
    first = jnp.asarray(0.0 if dt is None else dt, float)
    arguments = (jnp.asarray(t0, float), jnp.asarray(t1, float), x0, w0, p, relative, absolute, points, first)
    traced = inside_jit() or is_traced(arguments)
    if adjoint is None:
        # nobody differentiates a run with plain numbers: without checkpoints it compiles faster
        plain = not traced and isinstance(method, Rodas5P)
        adjoint = diffrax.ForwardMode() if plain else diffrax.RecursiveCheckpointAdjoint()
    method = _for_adjoint(method, adjoint)
    settings = settings_of(
        method, kind, controller=stepsize_controller, has_dt=dt is not None, adjoint=adjoint,
        event=None if isinstance(events, bool) or events is None else events,
        max_steps=MAX_STEPS if max_steps is None else max_steps,
    )  # fmt: skip
    if traced:
        run, dynamic, _ = _program(lowered, settings.replace(throw=throw))
        try:
            t, x, w, counts, *_ = run(dynamic, *arguments)
        except TypeError as error:
            if "forward-mode autodiff" not in str(error):
                raise
            raise SimulationError(
                "Derivatives forwards (`jax.jvp`, `jax.jacfwd`) of a run on the diffrax engine need "
                "`adjoint=diffrax.ForwardMode()`. Without it there are those backwards (`jax.grad`, `jax.jacrev`)."
            ) from error
        return Solution(system, t, x, w, p, stats={**_named(counts, method), "solver": _name(method)}, lowered=lowered)

    (t, x, w, counts, code, last), compile_seconds, run_seconds = carry_out(
        lowered, settings.replace(progress=progress), arguments
    )
    t, x, w = (np.asarray(a) for a in (t, x, w))
    kept = np.isfinite(t)
    if not kept.all():
        t, x, w = t[kept], x[kept], w[kept]
    result = result_name(int(code))
    stats = {k: int(v) for k, v in _named(counts, method).items()}
    stats |= {"compile_seconds": start_seconds + compile_seconds, "run_seconds": run_seconds}
    stats |= {"solver": _name(method), "t_end": float(last[0])}
    solution = Solution(system, t, x, w, p, stats=stats, result=result, lowered=lowered)
    solution.strict = throw
    if throw and result not in ("successful", "event_occurred"):
        raise SimulationError(explain(system, lowered, result, stats, last, p, float(t1), settings.max_steps))
    return solution


def carry_out(
    lowered: Lowered, settings: _Settings, arguments: tuple[Any, ...]
) -> tuple[tuple[Any, ...], float, float]:
    """Compiles and runs a solve: its outcome, the seconds of compiling and of running."""
    linear = settings.solver.linear_solver if isinstance(settings.solver, Rodas5P) else None
    keeping = settings
    if isinstance(linear, SparseKLU):
        keeping = eqx.tree_at(lambda s: s.solver.linear_solver, settings, SparseKLU(linear.pattern, keep_factors=True))
    compile_seconds, failure = 0.0, None
    for attempt in (keeping, settings):
        run, dynamic, key = _program(lowered, attempt)
        compiled, seconds = compiled_for(lowered, key, run, (dynamic, *arguments))
        compile_seconds += seconds
        begin = time.perf_counter()
        try:
            *outcome, kept = jax.block_until_ready(compiled(dynamic, *arguments))
        except jax.errors.JaxRuntimeError as error:
            if "klu" not in str(error):
                raise
            failure = error  # the pivots of the first step may be zero later: the second attempt chooses anew
            continue
        run_seconds = time.perf_counter() - begin
        if kept is not None:
            free_factors(kept)
        return tuple(outcome), compile_seconds, run_seconds
    raise SimulationError(
        "The Jacobian became singular: some unknowns are not determined by the equations at that point. "
        "Look at `system.report()`, and start from a point where the model is regular."
    ) from failure


def carry_out_slopes(
    lowered: Lowered, settings: _Settings, arguments: tuple[Any, ...], directions: tuple[Array, Array, Array]
) -> tuple[tuple[Any, ...], float]:
    """Derivatives of a solve at its output times and its end, and the seconds of compiling.

    Args:
        lowered, settings, arguments: of the solve, as for `carry_out`.
        directions: tangents of x0 (n_x, k), w0 (n_w, k) and the parameter vector (n_p, k).

    Returns:
        Tangents of x (n_t, n_x, k) and w (n_t, n_w, k) at the output times, and of both at the end.
    """
    run, dynamic, key = _program(lowered, settings, _slopes)
    compiled, seconds = compiled_for(lowered, key, run, (dynamic, directions, *arguments))
    return jax.block_until_ready(compiled(dynamic, directions, *arguments)), seconds


class _Settings(eqx.Module):
    """What a compiled solve is made for; arrays in it are arguments of the program, the rest is its key."""

    solver: diffrax.AbstractSolver[Any]
    saveat: Any
    controller: Any
    adjoint: Any
    event: Any
    has_dt: bool
    max_steps: int
    progress: bool
    throw: bool

    def replace(self, **changes: Any) -> _Settings:
        return _Settings(**{**{k: getattr(self, k) for k in self.__dataclass_fields__}, **changes})


def settings_of(
    solver: Any, saveat: Any, *, controller: Any, has_dt: bool, event: Any, max_steps: int, adjoint: Any = None
) -> _Settings:
    """Settings of a solve; without `adjoint` it is not differentiated."""
    return _Settings(
        solver=solver, saveat=saveat, controller=controller, has_dt=has_dt, event=event, max_steps=max_steps,
        adjoint=diffrax.ForwardMode() if adjoint is None else adjoint, progress=False, throw=False,
    )  # fmt: skip


def _output(saveat: Any, t0: Any, t1: Any) -> tuple[Any, Any]:
    """Times at which to save (or none) and what kind of output this is."""
    if isinstance(saveat, diffrax.SaveAt):
        if saveat.dense or isinstance(saveat.subs, (list, tuple, dict)):
            raise SimulationError(
                "`saveat` may have `t0`, `t1`, `ts` and `steps`; `dense` and several `subs` are not used here."
            )
        return saveat.subs.ts, ("diffrax", saveat.subs.t0, saveat.subs.t1, saveat.subs.steps)
    if saveat is None:
        return None, ("points", POINTS)
    if isinstance(saveat, (int, np.integer)):
        return None, ("points", int(saveat))
    return jnp.asarray(saveat, float), ("times",)


def _program(lowered: Lowered, settings: _Settings, solve: Any = None) -> tuple[Callable[..., Any], Any, Any]:
    """The jitted solve (or its `_slopes`) for these settings, the arrays in them, and the key of the program."""
    solve = _solve if solve is None else solve
    dynamic, static = eqx.partition(settings, eqx.is_array)
    leaves, structure = jax.tree.flatten(static)
    shapes = tuple((a.shape, str(a.dtype)) for a in jax.tree.leaves(dynamic))
    key = (solve.__name__, structure, tuple(leaves), shapes)
    cache = cache_of(lowered)
    if key not in cache:
        cache[key] = jax.jit(without_keeping(lowered, lambda low, *rest: solve(low, static, *rest)))
    return cache[key], dynamic, key


def _solve(
    lowered: Lowered, static: _Settings, dynamic: _Settings, t0: Array, t1: Array, x0: Array, w0: Array, p: Array,
    rtol: Array, atol: Array, points: Array | None, dt: Array,
) -> tuple[Any, ...]:  # fmt: skip
    """The solve: times, states, tearing variables, counts, result code, last point, and kept factors."""
    settings = eqx.combine(dynamic, static)
    n_x, n_w, n_g = dimensions(lowered)
    if n_g:
        rtol, atol = INVARIANT_SAFETY * rtol, INVARIANT_SAFETY * atol
    if not n_x:
        return _without_states(lowered, settings, t0, t1, w0, p, points)
    x_nominal, w_nominal = jnp.asarray(lowered.x_nominal, float), jnp.asarray(lowered.w_nominal, float)
    together = isinstance(settings.solver, Rodas5P)
    if isinstance(settings.solver, Rodas5P):
        solver, field, y0, args = _index_one(lowered, settings.solver, x0, w0, p)
        scale = jnp.concatenate([atol * x_nominal, jnp.min(atol) * w_nominal])
    else:
        solver, field, y0, args = _states_only(lowered, settings.solver, x0, w0, p)
        scale = atol * x_nominal
    adaptive = isinstance(settings.solver, diffrax.AbstractAdaptiveSolver)
    controller = settings.controller
    if controller is None and adaptive:
        smallest = ROUNDING * jnp.maximum(jnp.maximum(jnp.abs(t0), jnp.abs(t1)), jnp.abs(t1 - t0))
        controller = ErrorControl(rtol=rtol, atol=scale, smallest=smallest, kinks=kinks(lowered, p), states=n_x)
    elif controller is None:
        controller = diffrax.ConstantStepSize()
    if not settings.has_dt:
        if isinstance(controller, diffrax.ConstantStepSize):
            name = _name(settings.solver)
            raise SimulationError(f"`{name}` takes fixed steps here: give the step, `simulate(..., dt=1e-3)`.")
        dt = FIRST_STEP * (t1 - t0)
    dt = jnp.where(t1 < t0, -jnp.abs(dt), jnp.abs(dt))

    where: tuple[Any, ...] = settings.saveat
    if where[0] == "points":
        points = jnp.linspace(t0, t1, where[1])
    if where[0] == "diffrax":
        sub = diffrax.SubSaveAt(t0=where[1], t1=where[2], ts=points, steps=where[3])
    else:
        sub = diffrax.SubSaveAt(ts=points)
    event = settings.event
    if event is not None and isinstance(event.cond_fn, Switch):
        switch = event.cond_fn.armed(t0, y0, args)
        solver, event = Watched(solver, switch), diffrax.Event(switch, event.root_finder)
    keep = _keeps_factors(settings.solver)
    saveat = diffrax.SaveAt(subs=[sub, diffrax.SubSaveAt(t1=True)], solver_state=keep)
    solved = inspect.unwrap(diffrax.diffeqsolve)(
        diffrax.ODETerm(field), solver, t0, t1, None if isinstance(controller, diffrax.StepTo) else dt, y0, args,
        saveat=saveat, stepsize_controller=controller,
        max_steps=settings.max_steps, adjoint=settings.adjoint, event=event, throw=settings.throw,
        progress_meter=diffrax.TextProgressMeter() if settings.progress else diffrax.NoProgressMeter(),
    )  # fmt: skip
    assert solved.ts is not None and solved.ys is not None
    t, y = solved.ts[0], solved.ys[0]
    t_last, y_last = solved.ts[1][0], solved.ys[1][0]
    if together:
        reverse = not isinstance(settings.adjoint, diffrax.ForwardMode)
        x, w = y[:, :n_x], _solved(lowered, t, y[:, :n_x], y[:, n_x:], (t0, x0, w0), p, reverse)
        last = (t_last, y_last[:n_x], y_last[n_x:])
    else:
        x, w = y, _follow(lowered, t, y, w0, p) if n_w else jnp.zeros((y.shape[0], 0), y.dtype)
        last = (t_last, y_last, w[-1] if n_w else w0)
    counts = [solved.stats[f"num_{k}"] for k in ("steps", "accepted_steps", "rejected_steps")]
    return t, x, w, counts, _code(solved.result), last, solved.solver_state if keep else None


def _slopes(
    lowered: Lowered, static: _Settings, dynamic: _Settings, directions: Any, *arguments: Any
) -> tuple[Any, ...]:
    """Directional derivatives of the solve, see `carry_out_slopes`."""
    t0, t1, x0, w0, p, *rest = arguments
    vector, *numbers = p if isinstance(p, tuple) else (p,)

    def solve(x0: Array, w0: Array, vector: Array) -> tuple[Any, ...]:
        given: Any = (vector, *numbers) if numbers else vector
        _, x, w, _, _, (_, x_end, w_end), _ = _solve(lowered, static, dynamic, t0, t1, x0, w0, given, *rest)
        return x, w, x_end, w_end

    def along(*direction: Array) -> tuple[Any, ...]:
        return jax.jvp(solve, (x0, w0, vector), direction)[1]

    return jax.vmap(along, in_axes=-1, out_axes=-1)(*directions)


def _without_states(
    lowered: Lowered, settings: _Settings, t0: Array, t1: Array, w0: Array, p: Array, points: Array | None
) -> tuple[Any, ...]:
    """A model without states: its algebraic equations are followed through time, and solved at each output time."""
    if settings.saveat[0] == "points":
        points = jnp.linspace(t0, t1, settings.saveat[1])
    ends = jnp.stack([t0, t1])
    t = ends if points is None else jnp.concatenate([points, ends[1:]])
    x = jnp.zeros((t.shape[0], 0))
    w = follow_in_time(lowered, t0, t, w0, p) if lowered.n_w else jnp.zeros((t.shape[0], 0))
    none = jnp.asarray(0)
    shown = slice(None) if points is None else slice(None, -1)
    code = jnp.where(jnp.isfinite(w).all(), 0, -1)
    if lowered.n_w:  # at a single time they may lose their hold in passing
        lost = undetermined(lowered, t0, w0, p) & undetermined(lowered, t1, w[-1], p)
        code = jnp.where(lost, _RESULTS.index("singular"), code)
    return t[shown], x[shown], w[shown], [none, none, none], code, (t1, x[-1], w[-1]), None


def _index_one(lowered: Lowered, solver: Rodas5P, x0: Array, w0: Array, p: Array) -> tuple[Any, Any, Array, Any]:
    """States and tearing variables as one vector z with a mass matrix."""
    n_x, n_w, n_g = dimensions(lowered)
    held = ById(lowered, keep=False)  # JAX keeps what the functions below hold

    @jax.jit
    def field(t: Any, z: Array, p: Array) -> Array:
        return jnp.concatenate(held.thing.derivatives(t, z[:n_x], z[n_x:], p))

    if n_w and solver.mass is None:
        mass = jnp.concatenate([jnp.ones(n_x), jnp.zeros(n_w)])
        solver = eqx.tree_at(lambda s: s.mass, solver, mass, is_leaf=lambda v: v is None)
    if n_g and solver.project is None:

        def onto(t: Any, z: Array, p: Array) -> Array:
            return jnp.concatenate(project(held.thing, t, z[:n_x], z[n_x:], p))

        solver = eqx.tree_at(lambda s: s.project, solver, onto, is_leaf=lambda v: v is None)
    if lowered.conserved.count:
        matrix = jnp.asarray(lowered.conserved.matrix(n_x))
        conserving = Conserving(matrix, matrix @ x0, solver.project)
        solver = eqx.tree_at(lambda s: s.project, solver, conserving, is_leaf=lambda v: v is None or callable(v))
    return solver, field, jnp.concatenate([x0, w0]), p


def _states_only(lowered: Lowered, solver: Any, x0: Array, w0: Array, p: Array) -> tuple[Any, Any, Array, Any]:
    """The states alone; tearing variables are solved in the vector field, from a guess that goes along."""
    _, n_w, n_g = dimensions(lowered)
    held = ById(lowered, keep=False)  # JAX keeps what the functions below hold

    def algebraic(t: Any, x: Array, guess: Array, p: Any) -> Array:
        return held.thing.solve_algebraic(t, x, guess, p) if n_w else guess

    @jax.jit
    def field(t: Any, x: Array, args: tuple[Any, Array]) -> Array:
        p, guess = args
        return held.thing.derivatives(t, x, algebraic(t, x, guess, p), p)[0]

    if n_g:

        def onto(t: Any, x: Array, args: tuple[Any, Array]) -> Array:
            p, guess = args
            return project(held.thing, t, x, algebraic(t, x, guess, p), p)[0]

        solver = Projected(solver, onto)
    if n_w:
        solver = WithAlgebraic(solver, algebraic)
    return solver, field, x0, (p, w0)


def _follow(lowered: Lowered, t: Array, x: Array, w0: Array, p: Array) -> Array:
    """Tearing variables at the output points, each from the one before, shape (n_t, n_w)."""

    def step(w: Array, point: tuple[Array, Array]) -> tuple[Array, Array]:
        found = lowered.solve_algebraic(point[0], point[1], w, p)
        good = jnp.all(jnp.isfinite(found))
        return jnp.where(good, found, w), found

    return jax.lax.scan(step, w0, (t, x))[1]


def _solved(
    lowered: Lowered, t: Array, x: Array, w: Array, start: tuple[Array, Array, Array], p: Any, reverse: bool
) -> Array:
    """Tearing variables that solve their equations at the output points, from interpolated ones, shape (n_t, n_w).

    The dense output does not know of kinks, jumps and pulses that no state feels. Where there is no solution nearby it
    stays. Reverse mode multiplies what failed by zero, which must be finite: it is solved at the start there.
    """
    if not lowered.n_w or not t.shape[0]:
        return w

    def solve(t: Array, x: Array, w: Array) -> Array:
        return jax.lax.map(lambda at: lowered.solve_algebraic(at[0], at[1], at[2], p), (t, x, w))

    if not reverse:
        found = solve(t, x, w)
        return jnp.where(jnp.isfinite(found).all(axis=1)[:, None], found, w)

    def again(carry: tuple[Array, Array], first: Array) -> tuple[tuple[Array, Array], None]:
        good = carry[0]
        held = [jnp.where(first, jax.lax.stop_gradient(a), a) for a in (t, x, w)]
        chosen = [jnp.where(good.reshape(-1, *[1] * (a.ndim - 1)), a, at) for a, at in zip(held, start, strict=True)]
        found = solve(*chosen)
        return (good & jnp.isfinite(found).all(axis=1), found), None

    (good, found), _ = jax.lax.scan(again, (jnp.isfinite(t), w), jnp.asarray([True, False]))
    return jnp.where(good[:, None], found, w)


def _keeps_factors(solver: Any) -> bool:
    linear = solver.linear_solver if isinstance(solver, Rodas5P) else None
    return isinstance(linear, SparseKLU) and linear.keep_factors


def chosen_solver(given: diffrax.AbstractSolver[Any] | str | None) -> diffrax.AbstractSolver[Any]:
    """The solver that is meant."""
    if given is None or given == "rodas5p":
        return Rodas5P()
    if given == "rk4":
        return RK4()
    if isinstance(given, str):
        raise SimulationError(
            f"The diffrax engine has no solver {given!r}: give 'rodas5p', 'rk4' or a diffrax solver, "
            "or take engine='native' for 'adams'."
        )
    return given


def _for_adjoint(solver: Any, adjoint: Any) -> Any:
    """A Runge-Kutta solver with the loop over its stages that the adjoint can differentiate.

    Diffrax sets it itself, but not inside of a wrapper.
    """
    kinds: dict[type, str] = {diffrax.ForwardMode: "lax", diffrax.DirectAdjoint: "bounded"}
    if not isinstance(solver, diffrax.AbstractRungeKutta) or solver.scan_kind is not None or type(adjoint) not in kinds:
        return solver
    return eqx.tree_at(lambda s: s.scan_kind, solver, kinds[type(adjoint)], is_leaf=lambda v: v is None)


def with_linear_solver(solver: Any, lowered: Lowered) -> Any:
    """The solver, and if it leaves that open, with the linear solver that suits the size."""
    if not isinstance(solver, Rodas5P) or solver.linear_solver is not None:
        return solver
    cache = cache_of(lowered)
    if "linear_solver" not in cache:
        cache["linear_solver"] = _linear_solver(lowered)
    return eqx.tree_at(lambda s: s.linear_solver, solver, cache["linear_solver"], is_leaf=lambda v: v is None)


def _linear_solver(lowered: Lowered) -> AbstractLinearSolver:
    """Dense LU for few unknowns; coloured and sparse from `DENSE_BELOW` on."""
    n_x, n_w, _ = dimensions(lowered)
    if n_x + n_w < DENSE_BELOW:
        return DenseLU()
    from acausal.dae.coloring import color_columns

    csr = lowered.sparsity().tocsr()
    return sparse_linear_solver(csr, np.asarray(color_columns(csr)))


def _named(counts: list[Any], solver: Any) -> dict[str, Any]:
    """Counts by name; evaluations of the vector field and Jacobians where the solver's are known."""
    steps, accepted, rejected = counts
    named = {"steps": steps, "accepted": accepted, "rejected": rejected}
    if isinstance(solver, Rodas5P):
        named |= {"rhs": 8 * steps, "jacobians": steps}
    return named


def _name(solver: Any) -> str:
    return type(solver).__name__


def _code(result: diffrax.RESULTS) -> Array:
    """Position of a result in `_RESULTS`, or -1."""
    code = jnp.asarray(-1)
    for i, name in enumerate(_RESULTS):
        code = jnp.where(result == getattr(diffrax.RESULTS, name), i, code)
    return code


def result_name(code: int) -> str:
    """Name of a diffrax result."""
    return _RESULTS[code] if code >= 0 else "solver_failed"
