"""Levenberg-Marquardt on exact sensitivities between bounds, as one compiled program.

The frame is optimistix's (trust-region control of Nocedal and Wright, Numerical Optimization, 10.3), with damping in
the scale of the columns (Marquardt 1963), steps that are cut at the bounds (Kanzow, Yamashita and Fukushima 2004,
J. Comput. Appl. Math. 172, projected variant) and an end by what is still to be gained. A trial point where the
simulation fails has a huge residual: it is rejected and the step is cut.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import equinox as eqx
import jax
import jax.numpy as jnp
import lineax as lx
import numpy as np
import optimistix as optx

if TYPE_CHECKING:
    from .residuals import Problem

INDEPENDENT = 1e-6
"""Singular value of the Jacobian, columns of length one, from which a combination of coordinates is determined."""


class _Point(eqx.Module):
    """Where a step begins: coordinates, residuals, Jacobian, and which coordinates may move."""

    y: Any
    residual: Any
    jacobian: Any
    free: Any

    def scaled(self) -> tuple[Any, Any]:
        """The Jacobian of what may move with columns of length one, and their lengths; 1 for a column of zeros."""
        jacobian = jnp.where(self.free, self.jacobian, 0.0)
        length = jnp.linalg.norm(jacobian, axis=0)
        length = jnp.where(length > 0, length, 1.0)
        return jacobian / length, length


class _BoundedDescent(optx.AbstractDescent[Any, Any, _Point]):
    """Damped Gauss-Newton steps between bounds.

    A coordinate at a bound that the gradient pushes outwards does not move; others stop at their bounds.

    Attributes:
        low, high: bounds of the coordinates, (n,).
    """

    low: Any
    high: Any

    def init(self, y: Any, f_info_struct: Any) -> _Point:
        shape = f_info_struct.residual.shape
        return _Point(y, jnp.zeros(shape), jnp.zeros((*shape, *y.shape)), jnp.ones(y.shape, bool))

    def query(self, y: Any, f_info: Any, state: _Point) -> _Point:
        del state
        jacobian = f_info.jac.as_matrix()
        slope = f_info.residual @ jacobian
        stuck = ((y <= self.low) & (slope > 0)) | ((y >= self.high) & (slope < 0))
        return _Point(y, f_info.residual, jacobian, ~stuck)

    def step(self, step_size: Any, state: _Point) -> tuple[Any, Any]:
        jacobian, length = state.scaled()
        damped = jnp.concatenate([jacobian, jnp.eye(len(length)) / jnp.sqrt(step_size)])
        wanted = jnp.concatenate([-state.residual, jnp.zeros(len(length))])
        solution = lx.linear_solve(lx.MatrixLinearOperator(damped), wanted, lx.QR(), throw=False)
        moved = jnp.where(state.free, solution.value / length, 0.0)
        return jnp.clip(state.y + moved, self.low, self.high) - state.y, optx.RESULTS.successful


class _Statistical(optx.AbstractGaussNewton[Any, Any, Any]):
    """Ends where the statistics say that nothing is left to be gained.

    A Gauss-Newton step from the best fit gains nothing; one that gains ``tolerance**2 / 2`` moves no coordinate by more
    than `tolerance` of its standard error (the projection of the residuals onto the tangent plane: Seber and Wild,
    Nonlinear Regression, 14.4). Changes of the cost say less: with adaptive steps they are noise in the end.
    """

    tolerance: float
    rtol: float
    atol: float
    norm: Any
    descent: Any
    search: Any
    verbose: Any

    def step(self, *given: Any, **named: Any) -> Any:
        y, state, aux = super().step(*given, **named)
        point = state.descent_state
        basis, strength, _ = jnp.linalg.svd(point.scaled()[0], full_matrices=False)
        projected = jnp.where(strength > INDEPENDENT, point.residual @ basis, 0.0)
        done = state.terminate | (jnp.sum(projected**2) <= self.tolerance**2)
        return y, eqx.tree_at(lambda s: s.terminate, state, done), aux


def _solver(tolerance: float, low: Any, high: Any) -> _Statistical:
    region = optx.ClassicalTrustRegion(high_cutoff=0.75, high_constant=10.0, low_constant=0.1)
    descent = _BoundedDescent(jnp.asarray(low), jnp.asarray(high))
    return _Statistical(
        tolerance=tolerance, rtol=1e-10, atol=1e-10, norm=optx.max_norm, descent=descent, search=region,
        verbose=lambda **_: None,
    )  # fmt: skip


def fit_program(problem: Problem, tolerance: float, iterations: int) -> Callable[..., Any]:
    """(z0, held, arguments) -> z, half the sum of squares, iterations, whether it converged.

    `held` (n_free,) marks coordinates that keep their value: profiles hold one at a time.

    Args:
        problem: what is to be fitted.
        tolerance: part of the standard errors that does not matter.
        iterations: most iterations.
    """
    from .residuals import decoded

    informative = jnp.asarray([f.prior.informative for f in problem.free])
    low, high = np.array([f.prior.limits for f in problem.free]).T

    def residual(z: Any, held: Any, at: Any, arguments: Any) -> Any:
        z = jnp.where(held, at, z)
        r = problem.residual(decoded(problem, z, arguments), arguments)
        return jnp.concatenate([r, jnp.where(informative, z, 0.0)])

    @jax.custom_jvp
    def exact(z: Any, held: Any, at: Any, arguments: Any) -> Any:
        return residual(z, held, at, arguments)

    @exact.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        # one evaluation with all sensitivities, then a matrix: optimistix asks for one direction after the other
        z, *rest = primals

        def twice(z: Any) -> tuple[Any, Any]:
            r = residual(z, *rest)
            return r, r

        jacobian, r = jax.jacfwd(twice, has_aux=True)(z)
        return r, jnp.where(jnp.isfinite(jacobian), jacobian, 0.0) @ tangents[0]

    def fit(z0: Any, held: Any, arguments: Any) -> tuple[Any, Any, Any, Any]:
        found = optx.least_squares(
            lambda z, args: exact(z, *args), _solver(tolerance, low, high), z0, (held, z0, arguments),
            max_steps=iterations, throw=False,
        )  # fmt: skip
        z = jnp.where(held, z0, found.value)
        cost = 0.5 * jnp.sum(exact(z, held, z0, arguments) ** 2)
        return z, cost, found.stats["num_steps"], found.result == optx.RESULTS.successful

    return fit
