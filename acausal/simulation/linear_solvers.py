"""How a Rosenbrock step forms and solves with `W = diag(d) - J`: the policy interface, and dense LU."""

from __future__ import annotations

import abc
from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array

Field = Callable[[Array, Array], Array]


class AbstractLinearSolver(eqx.Module):
    """Policy for the Jacobian of a vector field and for linear systems with `W = diag(d) - J`.

    The representation of `J` belongs to the policy (a matrix, or the values of a sparsity pattern), so that a
    user-supplied Jacobian must return what the policy expects.
    """

    @abc.abstractmethod
    def jacobian(self, field: Field, t: Array, y: Array) -> tuple[Array, Array, Array]:
        """Value, time derivative and Jacobian of `field(t, y)`, all from one linearisation.

        Args:
            field: maps a scalar time and a state of shape (n,) to shape (n,).
            t: time.
            y: state, shape (n,).

        Returns:
            `field(t, y)` (n,), its derivative with respect to t (n,), and the Jacobian with respect to y.
        """

    def init(self) -> Any:
        """What is kept from step to step; nothing by default."""
        return None

    @abc.abstractmethod
    def factor(self, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Any, Any]:
        """Factors `diag(diagonal) - jacobian`; `diagonal` has shape (n,).

        Returns:
            What `solve` takes, and what is kept for the next step.
        """

    @abc.abstractmethod
    def solve(self, factors: Any, b: Array) -> Array:
        """Solves `W x = b` with what `factor` returned; `b` and `x` have shape (n,)."""


class DenseLU(AbstractLinearSolver):
    """Dense Jacobian by forward mode; LU with partial pivoting (LAPACK on a CPU). For up to a few hundred states.

    Rows are scaled to a largest entry of 1 first. Models mix magnitudes (a bulk modulus beside a position), and
    without it the rounding errors of the solves drown the error estimate of a step below rtol 1e-8 or so.
    """

    def jacobian(self, field: Field, t: Array, y: Array) -> tuple[Array, Array, Array]:
        n = y.shape[0]
        seeds = jnp.eye(n + 1, dtype=y.dtype)

        def push(seed: Array) -> tuple[Array, Array]:
            return jax.jvp(field, (t, y), (seed[0].astype(t.dtype), seed[1:]))

        value, columns = jax.vmap(push, out_axes=(None, 1))(seeds)
        return value, columns[:, 0], columns[:, 1:]

    def factor(self, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[tuple[Array, Array, Array], Any]:
        matrix = jnp.diag(diagonal) - jacobian
        largest = jax.lax.stop_gradient(jnp.max(jnp.abs(matrix), axis=1, initial=0.0))
        scale = 1 / jnp.where(largest == 0, 1, largest)
        lu, _, permutation = jax.lax.linalg.lu(matrix * scale[:, None])
        return (lu, permutation, scale), kept

    def solve(self, factors: tuple[Array, Array, Array], b: Array) -> Array:
        lu, permutation, scale = factors
        x = (b * scale)[permutation][:, None]
        x = jax.lax.linalg.triangular_solve(lu, x, left_side=True, lower=True, unit_diagonal=True)
        x = jax.lax.linalg.triangular_solve(lu, x, left_side=True, lower=False)
        return x[:, 0]
