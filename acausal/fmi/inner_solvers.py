"""JAX solvers inside an in-process participant: from a communication point to the next, compiled once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array

from ..errors import SimulationError
from ..simulation.controller import ROUNDING, ErrorControl
from ..simulation.kinks import kinks
from ..simulation.projection import Projected, WithAlgebraic, project
from ..simulation.rk4 import RK4
from ..simulation.rodas5p import Rodas5P

Advanced = tuple[Array, Array, Array, Array, Array]
Advance = Callable[..., Advanced]
"""(t, h, x, w, p, hint) -> states, algebraic unknowns, next first step, steps taken, whether it succeeded."""

MAX_STEPS = 100_000
"""Steps of an adaptive solver within one macro step."""


def advance_with(lowered: Any, solver: Any, *, dt: float | None, rtol: float, atol: float) -> Advance:
    """The function that advances a lowered system over one macro step.

    Args:
        lowered: functions of (t, x, w, p); its parameters may be any pytree.
        solver: `RK4()`, `Rodas5P()` or another diffrax solver; None for `Rodas5P()`.
        dt: largest step of a solver of fixed step [s].
        rtol: relative tolerance.
        atol: absolute tolerance as a fraction of the nominal values.

    Raises:
        SimulationError: a solver of fixed step without `dt`.
    """
    solver = Rodas5P() if solver is None else solver
    if not lowered.n_x:
        return _without_states(lowered)
    if isinstance(solver, RK4):
        if dt is None:
            raise SimulationError("`RK4` takes fixed steps inside a participant: give the step, `dt=1e-4`.")
        return _rk4(lowered, dt)
    return _diffrax(lowered, solver, dt, rtol, atol)


def _field(lowered: Any) -> Callable[[Any, Array, Array, Any], Array]:
    """Time derivatives of the states, the algebraic unknowns solved from a guess."""

    def field(t: Any, x: Array, guess: Array, p: Any) -> Array:
        w = lowered.solve_algebraic(t, x, guess, p) if lowered.n_w else guess
        return lowered.derivatives(t, x, w, p)[0]

    return field


def _finish(lowered: Any, t: Any, x: Array, w: Array, p: Any) -> tuple[Array, Array]:
    """States on their invariants, and the algebraic unknowns there."""
    w = lowered.solve_algebraic(t, x, w, p) if lowered.n_w else w
    return project(lowered, t, x, w, p) if lowered.n_g else (x, w)


def _without_states(lowered: Any) -> Advance:
    def advance(t: Any, h: Any, x: Array, w: Array, p: Any, hint: Any) -> Advanced:
        x, w = _finish(lowered, t + h, x, w, p)
        return x, w, hint, jnp.asarray(0), jnp.all(jnp.isfinite(w))

    return advance


def _rk4(lowered: Any, dt: float) -> Advance:
    field = _field(lowered)

    def advance(t: Any, h: Any, x: Array, w: Array, p: Any, hint: Any) -> Advanced:
        n = jnp.maximum(jnp.ceil(h / dt - 1e-9), 1).astype(int)
        step = h / n

        def stages(i: Any, state: tuple[Array, Array]) -> tuple[Array, Array]:
            x, w = state
            at = t + i * step
            # a loop over the stages: one copy of the vector field to compile, not four
            nodes, weights = jnp.array([0.0, 0.5, 0.5, 1.0]), jnp.array([1.0, 2.0, 2.0, 1.0]) / 6

            def stage(carry: tuple[Array, Array], row: Any) -> tuple[tuple[Array, Array], None]:
                k, total = carry
                node, weight = row
                k = field(at + node * step, x + node * step * k, w, p)
                return (k, total + weight * k), None

            zero = jnp.zeros_like(x)
            (_, total), _ = jax.lax.scan(stage, (zero, zero), (nodes, weights))
            return _finish(lowered, at + step, x + step * total, w, p)

        x, w = jax.lax.fori_loop(0, n, stages, (x, w))
        return x, w, hint, n, jnp.all(jnp.isfinite(x))

    return advance


def _diffrax(lowered: Any, solver: Any, dt: float | None, rtol: float, atol: float) -> Advance:
    together = isinstance(solver, Rodas5P)
    method = _index_one(lowered, solver) if together else _states_only(lowered, solver)
    n_x = lowered.n_x
    x_scale, w_scale = jnp.asarray(lowered.x_nominal, float), jnp.asarray(lowered.w_nominal, float)
    scale = jnp.concatenate([x_scale, w_scale]) if together else x_scale
    adaptive = isinstance(solver, diffrax.AbstractAdaptiveSolver)
    if not adaptive and dt is None:
        raise SimulationError(f"`{type(solver).__name__}` takes fixed steps: give the step, `dt=1e-4`.")

    def advance(t: Any, h: Any, x: Array, w: Array, p: Any, hint: Any) -> Advanced:
        if adaptive:
            smallest = ROUNDING * jnp.maximum(jnp.abs(t + h), h)
            at = kinks(lowered, p)
            controller: Any = ErrorControl(rtol=rtol, atol=atol * scale, smallest=smallest, kinks=at, states=n_x)
        else:
            controller = diffrax.ConstantStepSize()
        y0, args = (jnp.concatenate([x, w]), p) if together else (x, (p, w))
        first = jnp.minimum(hint, h) if adaptive else h / jnp.ceil(h / dt - 1e-9)
        field, configured = method
        saveat = diffrax.SaveAt(t1=True, controller_state=False)
        solved = diffrax.diffeqsolve(
            diffrax.ODETerm(field), configured, t, t + h, first, y0, args, saveat=saveat,
            stepsize_controller=controller, max_steps=MAX_STEPS, adjoint=diffrax.ForwardMode(), throw=False,
        )  # fmt: skip
        assert solved.ys is not None
        y = solved.ys[0]
        steps = solved.stats["num_steps"]
        ok = (solved.result == diffrax.RESULTS.successful) & jnp.all(jnp.isfinite(y))
        x1, w1 = (y[:n_x], y[n_x:]) if together else (y, w)
        x1, w1 = _finish(lowered, t + h, x1, w1, p) if not together else (x1, w1)
        used = solved.stats["num_accepted_steps"]
        return x1, w1, jnp.clip(h / jnp.maximum(used, 1), 0.0, 1.0e3), steps, ok

    return advance


def _index_one(lowered: Any, solver: Rodas5P) -> tuple[Any, Any]:
    n_x = lowered.n_x

    @jax.jit
    def field(t: Any, z: Array, p: Any) -> Array:
        return jnp.concatenate(lowered.derivatives(t, z[:n_x], z[n_x:], p))

    if lowered.n_w:
        mass = jnp.concatenate([jnp.ones(n_x), jnp.zeros(lowered.n_w)])
        solver = eqx.tree_at(lambda s: s.mass, solver, mass, is_leaf=lambda v: v is None)
    if lowered.n_g:

        def onto(t: Any, z: Array, p: Any) -> Array:
            return jnp.concatenate(project(lowered, t, z[:n_x], z[n_x:], p))

        solver = eqx.tree_at(lambda s: s.project, solver, onto, is_leaf=lambda v: v is None)
    return field, solver


def _states_only(lowered: Any, solver: Any) -> tuple[Any, Any]:
    inner = _field(lowered)

    @jax.jit
    def field(t: Any, x: Array, args: tuple[Any, Array]) -> Array:
        p, guess = args
        return inner(t, x, guess, p)

    if lowered.n_g:

        def onto(t: Any, x: Array, args: tuple[Any, Array]) -> Array:
            p, guess = args
            return _finish(lowered, t, x, guess, p)[0]

        solver = Projected(solver, onto)
    return field, WithAlgebraic(solver, lowered.solve_algebraic) if lowered.n_w else solver
