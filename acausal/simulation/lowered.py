"""What the solving layer needs of a lowered system: pure functions of time, states, tearing variables, parameters."""

from __future__ import annotations

from typing import Any, Protocol

import numpy as np
from jax import Array

from acausal.lowering.time_tables import TimeTable
from acausal.passes.first_integrals import FirstIntegrals


class Lowered(Protocol):
    """A semi-explicit index-1 system `x' = dx(t, x, w, p)`, `0 = r(t, x, w, p)` with invariants `0 = g(t, x, w, p)`.

    Vectors are float64 of shape (n_x,), (n_w,), (n_g,), (n_p,) and (n_all,).
    """

    n_x: int
    n_w: int
    n_g: int
    x_nominal: np.ndarray
    w_nominal: np.ndarray

    @property
    def conserved(self) -> FirstIntegrals:
        """Linear first integrals."""
        ...

    @property
    def time_tables(self) -> tuple[TimeTable, ...]:
        """Tables over time, at whose points steps end."""
        ...

    def derivatives(self, t: Any, x: Array, w: Array, p: Array) -> tuple[Array, Array]:
        """`(dx, r)` of shapes (n_x,) and (n_w,)."""
        ...

    def invariants(self, t: Any, x: Array, w: Array, p: Array) -> Array:
        """Retained hidden constraints g, shape (n_g,)."""
        ...

    def solve_algebraic(self, t: Any, x: Array, w_guess: Array, p: Array) -> Array:
        """w with r(t, x, w, p) = 0, shape (n_w,), with the implicit derivative."""
        ...

    def observe(self, t: Any, x: Array, w: Array, p: Array) -> Array:
        """Every variable of the flat model, shape (n_all,)."""
        ...

    def sparsity(self) -> Any:
        """Boolean `scipy.sparse.csr_matrix` of d(dx, r)/d(x, w), shape (n_x + n_w, n_x + n_w)."""
        ...


def dimensions(lowered: Lowered) -> tuple[int, int, int]:
    """`(n_x, n_w, n_g)`."""
    return len(lowered.x_nominal), len(lowered.w_nominal), int(lowered.n_g)
