"""The classical Runge-Kutta method as a diffrax solver of fixed step."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import jax
import jax.numpy as jnp
from diffrax import RESULTS, AbstractSolver, AbstractTerm, ThirdOrderHermitePolynomialInterpolation


class RK4(AbstractSolver[None]):
    """Classical Runge-Kutta method of order 4 with cubic Hermite dense output; fixed step, no error estimate.

    Use it with `diffrax.ConstantStepSize()`. Stages are y0, y0 + h/2 k1, y0 + h/2 k2, y0 + h k3 and weights
    1/6, 1/3, 1/3, 1/6. Algebraic unknowns must be solved inside the vector field (`simulate` does).

    Source: Kutta, W. (1901), "Beitrag zur naeherungsweisen Integration totaler Differentialgleichungen",
    Z. Math. Phys. 46, 435-453.
    """

    term_structure: ClassVar[Any] = AbstractTerm
    interpolation_cls: ClassVar[Callable[..., Any]] = ThirdOrderHermitePolynomialInterpolation

    def order(self, terms: Any) -> int:
        del terms
        return 4

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> None:
        del terms, t0, t1, y0, args

    def func(self, terms: Any, t0: Any, y0: Any, args: Any) -> Any:
        return terms.vf(t0, y0, args)

    def step(
        self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: None, made_jump: Any
    ) -> tuple[Any, None, dict[str, Any], None, RESULTS]:
        """One step from `t0` to `t1`; see `diffrax.AbstractSolver.step`."""
        del solver_state, made_jump
        control = terms.contr(t0, t1)
        half = t0 + (t1 - t0) / 2

        @jax.jit
        def increment(t: Any, y: Any) -> Any:
            return terms.vf_prod(t, y, args, control)

        def shifted(k: Any, factor: float) -> Any:
            return jax.tree.map(lambda y, d: y + factor * d, y0, k)

        k1 = increment(t0, y0)
        k2 = increment(half, shifted(k1, 0.5))
        k3 = increment(half, shifted(k2, 0.5))
        k4 = increment(t1, shifted(k3, 1.0))
        y1 = jax.tree.map(lambda y, a, b, c, d: y + (a + 2 * (b + c) + d) / 6, y0, k1, k2, k3, k4)
        end = increment(t1, y1)
        dense_info = {"y0": y0, "y1": y1, "k0": jax.tree.map(jnp.asarray, k1), "k1": end}
        return y1, None, dense_info, None, RESULTS.successful
