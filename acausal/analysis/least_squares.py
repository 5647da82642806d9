"""Levenberg-Marquardt on exact sensitivities, in internal coordinates without bounds, as one compiled program.

The algorithm is optimistix's (damping after Marquardt 1963, trust-region control of Nocedal and Wright, Numerical
Optimization, 10.3). A trial point where the simulation fails has a huge residual: it is rejected and the step is cut.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .residuals import Problem


def fit_program(problem: Problem, tolerance: float, iterations: int) -> Callable[..., Any]:
    """(z0, held, arguments) -> z, half the sum of squares, iterations, whether it converged.

    `held` (n_free,) marks coordinates that keep their value: profiles hold one at a time.

    Args:
        problem: what is to be fitted.
        tolerance: of coordinates and cost, relative and absolute.
        iterations: most iterations.
    """
    import jax
    import jax.numpy as jnp
    import optimistix as optx

    from .residuals import decoded

    informative = jnp.asarray([f.prior.informative for f in problem.free])

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
        solver = optx.LevenbergMarquardt(rtol=tolerance, atol=tolerance)
        found = optx.least_squares(
            lambda z, args: exact(z, *args), solver, z0, (held, z0, arguments), max_steps=iterations, throw=False
        )
        z = jnp.where(held, z0, found.value)
        cost = 0.5 * jnp.sum(exact(z, held, z0, arguments) ** 2)
        return z, cost, found.stats["num_steps"], found.result == optx.RESULTS.successful

    return fit
