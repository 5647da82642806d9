"""Error control by the largest scaled error, with steps across discontinuities."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
from diffrax import RESULTS, AbstractAdaptiveStepSizeController
from jax import Array

ROUNDING = 1e-14
"""Smallest step as a fraction of the time: some tens of the spacing of floating-point numbers."""
JUMP = 1e3
"""Error of the states, in tolerances, up to which a smallest step may be forced."""
FORCED_STEPS = 50
"""So many steps in a row may be forced; more means that the solution does not leave the discontinuity."""


def largest(error: Array) -> Array:
    """Norm of a scaled error: a mean would hide one active cell among thousands at rest."""
    return jnp.max(jnp.abs(error), initial=0.0)


class ErrorControl(AbstractAdaptiveStepSizeController[Any, Any]):
    """PI control of the step size, that crosses a jump of the vector field by one smallest step.

    No error estimate falls below the tolerance while a step contains a jump. The steps shrink to `smallest`, which
    is of the order of rounding error of the time: that step is taken in spite of its estimate. The error it makes in
    the states is the jump times `smallest`; algebraic unknowns may jump themselves. A state whose estimate is above
    `JUMP` tolerances, or one that is not finite, or `FORCED_STEPS` forced steps in a row end the solve with
    `dt_min_reached`: there the solution has ended.

    Coefficients of the PI control: Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.2, as in diffrax.

    Args:
        rtol: relative tolerance.
        atol: absolute tolerance, one number or one for each variable.
        states: how many of the unknowns, the first ones, are states; None for all.
        smallest: smallest step at the far end of the time axis [s]; elsewhere the smallest step is that fraction of
            the time, so that a run over 1e11 s can begin with steps of microseconds.
    """

    rtol: Any
    atol: Any
    smallest: Any
    states: int | None = eqx.field(static=True, default=None)
    norm: Callable[[Any], Any] = eqx.field(static=True, default=largest)

    @property
    def _inner(self) -> diffrax.PIDController:
        return diffrax.PIDController(rtol=self.rtol, atol=self.atol, norm=self.norm, pcoeff=0.4, icoeff=0.3)

    def wrap(self, direction: Any) -> ErrorControl:
        """diffrax integrates backwards by running its own time forwards: nothing depends on the direction."""
        del direction
        return self

    def init(
        self, terms: Any, t0: Any, t1: Any, y0: Any, dt0: Any, args: Any, func: Any, error_order: Any
    ) -> tuple[Any, Any]:
        """First end point and state of the control; see `diffrax.AbstractStepSizeController.init`."""
        end, state = self._inner.init(terms, t0, t1, y0, dt0, args, func, error_order)
        return end, (state, jnp.asarray(0))

    def adapt_step_size(
        self, t0: Any, t1: Any, y0: Any, y1_candidate: Any, args: Any, y_error: Any, error_order: Any,
        controller_state: Any,
    ) -> tuple[Any, Any, Any, Any, Any, RESULTS]:  # fmt: skip
        """Whether to keep the step, and the next; see `diffrax.AbstractStepSizeController.adapt_step_size`."""
        inner, forced = controller_state
        kept, next_t0, next_t1, jump, inner, result = self._inner.adapt_step_size(
            t0, t1, y0, y1_candidate, args, y_error, error_order, inner
        )
        leaves = [*jax.tree.leaves(y1_candidate), *jax.tree.leaves(y_error)]
        finite = jnp.all(jnp.stack([jnp.all(jnp.isfinite(leaf)) for leaf in leaves]))
        floor = jnp.maximum(ROUNDING * jnp.abs(t0), 1e-10 * self.smallest)
        at_floor = t1 - t0 <= 1.5 * floor
        magnitude = jnp.maximum(jnp.abs(y0), jnp.abs(y1_candidate))
        of_states = (jnp.abs(y_error) / (self.atol + self.rtol * magnitude))[..., : self.states]
        force = at_floor & ~kept & finite & (jnp.max(of_states, initial=0.0) <= JUMP)
        forced = jnp.where(force, forced + 1, jnp.where(kept, 0, forced))
        next_t0 = jnp.where(force, t1, next_t0)
        step = jnp.where(force, floor, jnp.maximum(next_t1 - next_t0, floor))
        failed = (at_floor & ~kept & ~force) | (forced > FORCED_STEPS)
        result = RESULTS.where(failed, RESULTS.dt_min_reached, result)
        return kept | force, next_t0, next_t0 + step, jump, (inner, forced), result
