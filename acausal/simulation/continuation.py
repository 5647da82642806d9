"""Algebraic equations alone followed through time, so that far output times do not land on another of their solutions.

Source: Allgower and Georg (2003), Introduction to numerical continuation methods, chapter 2: a predictor along the
tangent, Newton's method as the corrector, and a step that is halved where the corrector moves far.
"""

from __future__ import annotations

from typing import Any

import jax
import jax.numpy as jnp
from jax import Array

from .lowered import Lowered

MOVED = 0.1
"""How far the corrector may move, relative to the size of an unknown."""
LARGEST = 500
"""Up to so many unknowns their Jacobian is looked at."""
SINGULAR = 1e-13
"""Smallest singular value relative to the largest, after scaling, of a Jacobian that is singular but for rounding."""
SMALLEST = 2.0**-10
"""Smallest step relative to the distance of two output times; taken wherever the corrector goes, as across a jump."""


def follow_in_time(lowered: Lowered, t0: Array, t: Array, w0: Array, p: Array) -> Array:
    """The unknowns `w` at the times `t`, shape (n_t, n_w), from `w0` at `t0`.

    The way from one time to the next gives a guess only: derivatives are those of the equations at the output times.
    """

    def step(carry: tuple[Array, Array], target: Array) -> tuple[tuple[Array, Array], Array]:
        found = followed(lowered, carry[0], target, w := carry[1], p)
        good = jnp.all(jnp.isfinite(found))
        return (target, jnp.where(good, found, w)), found

    return jax.lax.scan(step, (t0, w0), t)[1]


def undetermined(lowered: Lowered, t: Array, w: Array, p: Any) -> Array:
    """Whether the equations do not determine the unknowns around a solution `w` of theirs: a boolean.

    Newton's method shows it by the way that it fails to converge; where it begins at a solution it has nothing to do.
    """
    if not 0 < w.shape[0] <= LARGEST:
        return jnp.asarray(False)
    slope = jax.jacfwd(lambda w: lowered.derivatives(t, jnp.zeros(0), w, p)[1])(jax.lax.stop_gradient(w))
    slope = slope * jnp.asarray(lowered.w_nominal, float)
    for axis in (1, 0):
        size = jnp.max(jnp.abs(slope), axis=axis, keepdims=True)
        slope = slope / jnp.where(size > 0, size, 1.0)
    slope = jnp.where(jnp.isfinite(slope).all(), slope, jnp.eye(w.shape[0]))
    sigma = jnp.linalg.svd(slope, compute_uv=False)
    return sigma[-1] <= SINGULAR * sigma[0]


def followed(lowered: Lowered, begin: Array, end: Array, w: Array, p: Any) -> Array:
    """The unknowns at `end`, (n_w,), from their values `w` at `begin`; not finite where there is no solution."""
    guess = _continued(lowered, *jax.lax.stop_gradient((begin, end, w, p)))
    return lowered.solve_algebraic(end, jnp.zeros(0), guess, p)


def _continued(lowered: Lowered, begin: Array, end: Array, w: Array, p: Any) -> Array:
    """A guess of the unknowns at `end`, from their values at `begin`."""
    x, size = jnp.zeros(0), jnp.asarray(lowered.w_nominal, float)
    span = end - begin

    def at(s: Array, guess: Array) -> Array:
        return lowered.solve_algebraic(begin + s * span, x, guess, p)

    def advance(state: tuple[Array, Array, Array]) -> tuple[Array, Array, Array]:
        s, h, w = state
        h = jnp.minimum(h, 1.0 - s)
        slope = jax.jvp(lambda s: at(s, w), (s,), (jnp.ones_like(s),))[1]
        predicted = w + h * jnp.where(jnp.isfinite(slope), slope, 0.0)
        found = at(s + h, predicted)
        near = jnp.all(jnp.abs(found - predicted) <= MOVED * jnp.maximum(size, jnp.abs(w)))
        finite, last = jnp.all(jnp.isfinite(found)), h <= SMALLEST
        taken = finite & (near | last)
        # where nothing solves the equations any more the search ends, and the output time shows it
        s = jnp.where(taken, s + h, jnp.where(last, 1.0, s))
        return s, jnp.where(taken, 2.0 * h, 0.5 * h), jnp.where(taken, found, w)

    start = (jnp.zeros_like(span), jnp.ones_like(span), w)
    return jax.lax.while_loop(lambda state: state[0] < 1.0, advance, start)[2]
