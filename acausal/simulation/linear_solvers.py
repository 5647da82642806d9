"""How a Rosenbrock step forms and solves with `W = diag(d) - J`: the policy interface, and dense LU."""

from __future__ import annotations

import abc
from collections.abc import Callable
from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array

from acausal.lowering.balanced import row_scale

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

    def outrun(self, factors: Any, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Array, Any]:
        """Whether a mode grows faster than the step that `diagonal` belongs to can follow; not, where that is unknown.

        Returns:
            A boolean, and what is kept for the next step.
        """
        del factors, diagonal, jacobian
        return jnp.asarray(False), kept

    @abc.abstractmethod
    def solve(self, factors: Any, b: Array) -> Array:
        """Solves `W x = b` with what `factor` returned; `b` and `x` have shape (n,)."""


SMALL_STEP = 1e30
"""Factor of the diagonal of W that makes a step so small that no mode can be seen in it."""


class DenseLU(AbstractLinearSolver):
    """Dense Jacobian by forward mode; LU with partial pivoting (LAPACK on a CPU). For up to a few hundred states.

    Rows are scaled to a sum of 1 first, so that pivots stand out in their rows. Models mix magnitudes (a bulk modulus
    beside a position), and without it rounding errors drown the error estimate of a step below rtol 1e-8 or so.
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
        scale = row_scale(matrix, jnp)[:, 0]
        lu, _, permutation = jax.lax.linalg.lu(matrix * scale[:, None])
        return (lu, permutation, scale), kept

    def init(self) -> Array:
        """The sign of the determinant for small steps, which is not known yet."""
        return jnp.asarray(0)

    def outrun(self, factors: Any, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Array, Any]:
        """Beyond the pole of its stability function an implicit method takes growth for decay, and a solution stays at
        an equilibrium that it has to leave. A real mode is there if the determinant of W has changed its sign, compared
        with that for a small step, which is looked at again before anything is said. Modes in pairs are not seen.

        Hairer and Wanner, Solving Ordinary Differential Equations II, IV.2.
        """
        sign, jacobian = _sign_of_determinant(factors), jax.lax.stop_gradient(jacobian)
        reference = jnp.asarray(0) if kept is None else kept

        def for_small_steps() -> Array:
            return _sign_of_determinant(self.factor(SMALL_STEP * jax.lax.stop_gradient(diagonal), jacobian)[0])

        reference = jax.lax.cond(sign == reference, lambda: reference, for_small_steps)
        return sign != reference, reference

    def solve(self, factors: tuple[Array, Array, Array], b: Array) -> Array:
        lu, permutation, scale = factors
        x = (b * scale)[permutation][:, None]
        x = jax.lax.linalg.triangular_solve(lu, x, left_side=True, lower=True, unit_diagonal=True)
        x = jax.lax.linalg.triangular_solve(lu, x, left_side=True, lower=False)
        return x[:, 0]


def _sign_of_determinant(factors: tuple[Array, Array, Array]) -> Array:
    """1 or -1, from the diagonal of U and the order of the rows."""
    lu, permutation, _ = factors
    before = permutation[:, None] > permutation[None, :]
    exchanged = jnp.sum(jnp.triu(before, 1)) + jnp.sum(jnp.diagonal(lu) < 0)
    return 1 - 2 * (exchanged % 2)
