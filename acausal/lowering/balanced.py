"""Linear systems whose rows and unknowns have unlike sizes."""

from __future__ import annotations

from typing import Any

import numpy as np


def row_scale(a: Any, jnp: Any = np) -> Any:
    """Factors (..., n, 1) of the rows of a (..., n, n) that make their absolute sums 1; constants to derivatives."""
    size = jnp.sum(jnp.abs(a), axis=-1, keepdims=True)
    if jnp is not np:
        import jax

        size = jax.lax.stop_gradient(size)
    return 1 / jnp.where(size > 0, size, 1.0)


def solve_balanced(a: Any, b: Any, jnp: Any = np) -> Any:
    """Solution of ``a x = b``, as accurate as if each entry of `a` and `b` were known to rounding.

    Rows are scaled to absolute sums of 1, so that pivots are the entries that stand out in their rows, and a step of
    refinement follows: small differences are kept, as those of ``x - 1e-11 y == 0`` beside ``3 x + y == 1``.
    Source: Skeel (1980), Iterative refinement implies numerical stability for Gaussian elimination, Math. Comp. 35.

    Args:
        a: (..., n, n).
        b: (..., n) or (..., n, k), like `a` in what comes first.
        jnp: NumPy or `jax.numpy`.
    """
    scale = row_scale(a, jnp)
    right = b * scale if b.ndim == a.ndim else b[..., None] * scale
    matrix = a * scale
    x = jnp.linalg.solve(matrix, right)
    x = x + jnp.linalg.solve(matrix, right - matrix @ x)
    return x if b.ndim == a.ndim else x[..., 0]


def solve_any(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """`solve_balanced`; of the systems that are singular, the smallest of the solutions that come closest.

    Guesses may make a system singular that the root of what is iterated does not: a rod without length has no
    direction. With a finite answer the iteration goes on.
    """
    try:
        return solve_balanced(a, b)
    except np.linalg.LinAlgError:
        if a.ndim > 2:
            return np.stack([solve_any(one, right) for one, right in zip(a, b, strict=True)])
        return np.linalg.pinv(a) @ b
