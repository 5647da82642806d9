"""Damped Newton iteration for batches of small nonlinear systems, with derivatives by the implicit-function theorem."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .balanced import solve_balanced

MAX_ITERATIONS = 60


def newton_root(residual: Callable[[Any], Any], guess: Any, scale: Any) -> Any:
    """Root of `residual`, a function of (n, k) unknowns to (n, k) residuals, independent over the first axis.

    Steps are halved until the residual falls (Deuflhard 2011, Newton Methods for Nonlinear Problems, 3.1). A system
    that does not converge comes back as nan, so that the failure shows at once.

    Args:
        residual: the function.
        guess: start of the iteration, (n, k).
        scale: typical magnitude of the unknowns, (n, k).
    """
    import jax
    import jax.numpy as jnp

    def jacobian(y: Any) -> Any:
        return _block_diagonal(lambda v: jax.jvp(residual, (y,), (v,))[1], y)

    def norm(r: Any) -> Any:
        return jnp.where(jnp.isfinite(r).all(axis=1), jnp.abs(r).max(axis=1), jnp.inf)

    def iterate(function: Any, start: Any) -> Any:
        del function
        reference = norm(residual(start))

        def again(state: Any) -> Any:
            _, _, done, k = state
            return (~done.all()) & (k < MAX_ITERATIONS)

        def step(state: Any) -> Any:
            y, r, done, k = state
            newton = -_solve(jacobian(y), r)
            there = jnp.isfinite(newton)  # none where the Jacobian is singular, which is no convergence
            delta = jnp.where(there, newton, 0.0)
            size = norm(r)

            def damp(s: Any) -> Any:
                factor, _, tries = s
                return factor * 0.5, norm(residual(y + (factor * 0.5)[:, None] * delta)), tries + 1

            def worse(s: Any) -> Any:
                _, new, tries = s
                return (~(new <= size * (1 + 1e-9)) & ~done).any() & (tries < 30)

            def one(s: Any) -> Any:
                factor, new, tries = damp(s)
                keep = (s[1] <= size * (1 + 1e-9)) | done
                return jnp.where(keep, s[0], factor), jnp.where(keep, s[1], new), tries

            full = jnp.ones_like(size)
            factor, _, _ = jax.lax.while_loop(worse, one, (full, norm(residual(y + delta)), 0))
            moved = factor[:, None] * delta
            y = jnp.where(done[:, None], y, y + moved)
            small = (there & (jnp.abs(delta) <= 1e-13 * jnp.maximum(jnp.abs(y), scale))).all(axis=1)
            r = residual(y)
            return y, r, done | small | (norm(r) == 0.0), k + 1

        start_state = (start, residual(start), reference == 0.0, 0)
        y, r, done, _ = jax.lax.while_loop(again, step, start_state)
        stalled = norm(r) <= 1e-9 * jnp.maximum(reference, 1e-300)
        return jnp.where((done | stalled)[:, None], y, jnp.nan)

    def tangent(linear: Any, y: Any) -> Any:
        return _solve(_block_diagonal(linear, y), y)

    return jax.lax.custom_root(residual, jax.lax.stop_gradient(guess), iterate, tangent)


def _block_diagonal(linear: Callable[[Any], Any], like: Any) -> Any:
    """Matrices (n, k, k) of a linear map that is independent over the first axis."""
    import jax
    import jax.numpy as jnp

    k = like.shape[1]
    basis = jnp.broadcast_to(jnp.eye(k)[:, None, :], (k, *like.shape))
    return jnp.moveaxis(jax.vmap(linear)(basis), 0, -1)


def _solve(matrix: Any, rhs: Any) -> Any:
    import jax.numpy as jnp

    if rhs.shape[1] == 1:
        return rhs / matrix[:, :, 0]
    return solve_balanced(matrix, rhs, jnp)
