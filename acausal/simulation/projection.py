"""Coordinate projection: the states are put back onto retained constraints after each step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
from diffrax import AbstractSolver, AbstractWrappedSolver
from jax import Array

from .lowered import Lowered, dimensions

DENSE_CONSTRAINTS = 64
"""Up to so many invariants the normal equations are formed; beyond, conjugate gradients apply them."""


def project(lowered: Lowered, t: Any, x: Array, w: Array, p: Array, iterations: int = 2) -> tuple[Array, Array]:
    """The point nearest to `(x, w)` with `g(t, x, w, p) = 0` and `r(t, x, w, p) = 0`, to first order.

    Newton steps of minimum norm `|| dx / x_nominal ||`; w follows x through its own equations.
    Source: Eich (1993), "Convergence results for a coordinate projection method applied to mechanical systems
    with algebraic constraints", SIAM J. Numer. Anal. 30(5), Eq. (2.4); scaled as in Hairer & Wanner II, VII.2.

    Args:
        lowered: the system.
        t: time.
        x, w: candidate, shapes (n_x,) and (n_w,).
        p: parameters.
        iterations: Newton steps; the candidate of a step is so near that one gives nearly full accuracy.
    """
    n_g = dimensions(lowered)[2]
    if n_g == 0:
        return x, w
    step = _dense_step if n_g <= DENSE_CONSTRAINTS else _matrix_free_step

    def body(state: tuple[Array, Array], _: None) -> tuple[tuple[Array, Array], None]:
        return step(lowered, t, *state, p), None

    (x, w), _ = jax.lax.scan(body, (x, w), None, length=iterations)
    return x, w


def _residuals(lowered: Lowered, t: Any, x: Array, w: Array, p: Array) -> tuple[Array, Array]:
    return lowered.derivatives(t, x, w, p)[1], lowered.invariants(t, x, w, p)


def _dense_step(lowered: Lowered, t: Any, x: Array, w: Array, p: Array) -> tuple[Array, Array]:
    n_x, n_w, n_g = dimensions(lowered)
    scale = jnp.asarray(lowered.x_nominal, x.dtype)

    def residuals(z: Array) -> tuple[Array, Array]:
        return _residuals(lowered, t, z[:n_x], z[n_x:], p)

    z = jnp.concatenate([x, w])
    r, g = residuals(z)
    r_z, g_z = jax.jacfwd(residuals)(z)
    follow = jnp.zeros((0, n_x + 1), x.dtype)
    if n_w:
        follow = -jnp.linalg.solve(r_z[:, n_x:], jnp.concatenate([r_z[:, :n_x], r[:, None]], axis=1))
    reduced = jnp.concatenate([g_z[:, :n_x], g[:, None]], axis=1) + g_z[:, n_x:] @ follow
    matrix, rest = reduced[:, :n_x] * scale, reduced[:, n_x]
    row = 1 / jnp.maximum(jnp.sqrt(jnp.sum(matrix**2, axis=1)), jnp.finfo(x.dtype).tiny)
    matrix, rest = matrix * row[:, None], rest * row
    normal = matrix @ matrix.T + 1e-14 * jnp.eye(n_g, dtype=x.dtype)
    dx = -scale * (matrix.T @ jnp.linalg.solve(normal, rest))
    dw = follow[:, :n_x] @ dx + follow[:, n_x]
    return x + dx, w + dw


def _matrix_free_step(lowered: Lowered, t: Any, x: Array, w: Array, p: Array) -> tuple[Array, Array]:
    n_x = dimensions(lowered)[0]
    scale = jnp.concatenate([jnp.asarray(lowered.x_nominal, x.dtype), jnp.asarray(lowered.w_nominal, x.dtype)])

    def residuals(s: Array) -> Array:
        z = s * scale
        return jnp.concatenate(_residuals(lowered, t, z[:n_x], z[n_x:], p))

    s = jnp.concatenate([x, w]) / scale
    c, push = jax.linearize(residuals, s)
    pull = jax.linear_transpose(push, s)
    multiplier, _ = jax.scipy.sparse.linalg.cg(lambda v: push(pull(v)[0]), c, tol=1e-12, maxiter=200)
    z = (s - pull(multiplier)[0]) * scale
    return z[:n_x], z[n_x:]


class Conserving(eqx.Module):
    """The candidate of a step with its linear first integrals as at the start; then what else it is projected on.

    Each state moves in proportion to its size, so that none changes by more than rounding of its own.
    Source: Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, IV.4, Eq. (4.5), in this norm.

    Args:
        matrix: coefficients of the sums, (n_k, n_x).
        sums: their values at the start, (n_k,).
        after: a further projection, or None.
    """

    matrix: Array
    sums: Array
    after: Callable[[Any, Array, Any], Array] | None = eqx.field(static=True)

    def __call__(self, t: Any, z: Array, args: Any) -> Array:
        n_k, n_x = self.matrix.shape
        weight = jnp.abs(jax.lax.stop_gradient(z[:n_x]))
        square = (self.matrix**2) @ weight
        scaled = self.matrix / jnp.sqrt(jnp.where(square > 0, square, jnp.inf))[:, None]
        left = (self.sums - self.matrix @ z[:n_x]) / jnp.sqrt(jnp.where(square > 0, square, jnp.inf))
        normal = (scaled * weight) @ scaled.T + 1e-14 * jnp.eye(n_k)
        z = z.at[:n_x].add(weight * (scaled.T @ jnp.linalg.solve(normal, left)))
        return z if self.after is None else self.after(t, z, args)


class Wrapped(AbstractWrappedSolver[Any]):
    """What a wrapper passes on to the solver in it."""

    @property
    def term_structure(self) -> Any:  # pyright: ignore[reportIncompatibleVariableOverride]
        return self.solver.term_structure

    @property
    def interpolation_cls(self) -> Any:  # pyright: ignore[reportIncompatibleMethodOverride]
        return self.solver.interpolation_cls

    @property
    def term_compatible_contr_kwargs(self) -> Any:  # pyright: ignore[reportIncompatibleVariableOverride]
        return self.solver.term_compatible_contr_kwargs

    @property
    def scan_kind(self) -> Any:
        """Of Runge-Kutta solvers: how their stages are looped over."""
        return self.solver.scan_kind  # pyright: ignore[reportAttributeAccessIssue]

    @property
    def root_finder(self) -> Any:
        """Of implicit solvers: diffrax sets its tolerances."""
        return self.solver.root_finder  # pyright: ignore[reportAttributeAccessIssue]

    @property
    def root_find_max_steps(self) -> Any:
        return self.solver.root_find_max_steps  # pyright: ignore[reportAttributeAccessIssue]

    def order(self, terms: Any) -> int | None:
        return self.solver.order(terms)

    def error_order(self, terms: Any) -> Any:
        return self.solver.error_order(terms)

    def func(self, terms: Any, t0: Any, y0: Any, args: Any) -> Any:
        return self.solver.func(terms, t0, y0, args)


class Projected(Wrapped):
    """Any diffrax solver, with `project(t, y, args) -> y` run on the candidate of each step.

    Args:
        solver: the solver to wrap.
        project: projection of a candidate, for example on the invariants of a mechanism.
    """

    solver: AbstractSolver[Any]  # pyright: ignore[reportIncompatibleVariableOverride]
    project: Callable[[Any, Any, Any], Any]

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> Any:
        return self.solver.init(terms, t0, t1, y0, args)

    def step(
        self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: Any, made_jump: Any
    ) -> tuple[Any, Any, Any, Any, diffrax.RESULTS]:
        """One step of the solver, then the projection; see `diffrax.AbstractSolver.step`."""
        y1, error, dense_info, _, result = self.solver.step(terms, t0, t1, y0, args, solver_state, made_jump)
        time = t1 * getattr(terms, "direction", 1)
        projected = self.project(time, y1, args)
        # Solvers that reuse their last stage must see the projected point.
        state = self.solver.init(terms, t1, t1 + (t1 - t0), projected, args)
        return projected, error, _end(dense_info, projected), state, result


def _end(dense_info: Any, y1: Any) -> Any:
    """Dense output that ends in the projected point, where the solver's interpolation has an end point of its own."""
    return {**dense_info, "y1": y1} if isinstance(dense_info, dict) and "y1" in dense_info else dense_info


class WithAlgebraic(Wrapped):
    """A diffrax solver of `x' = f(t, x, (p, w))` that carries w from step to step as the guess for its own equations.

    Args:
        solver: the solver of the states.
        solve_algebraic: `(t, x, w_guess, p) -> w`.
    """

    solver: AbstractSolver[Any]  # pyright: ignore[reportIncompatibleVariableOverride]
    solve_algebraic: Callable[[Any, Array, Array, Array], Array]

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> Any:
        return self.solver.init(terms, t0, t1, y0, args), args[1]

    def step(
        self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: Any, made_jump: Any
    ) -> tuple[Any, Any, Any, Any, diffrax.RESULTS]:
        """One step of the solver with the carried guess; see `diffrax.AbstractSolver.step`."""
        inner, w = solver_state
        p = args[0]
        y1, error, dense_info, inner, result = self.solver.step(terms, t0, t1, y0, (p, w), inner, made_jump)
        w = self.solve_algebraic(t1 * getattr(terms, "direction", 1), y1, w, p)
        return y1, error, dense_info, (inner, w), result
