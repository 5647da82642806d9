"""Error control by the largest scaled error, with steps across discontinuities."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
from diffrax import RESULTS, AbstractAdaptiveStepSizeController
from jax import Array

from .kinks import Kinks

ROUNDING = 1e-14
"""Smallest step as a fraction of the time: some tens of the spacing of floating-point numbers."""
JUMP = 1e3
"""Error of the states, in tolerances, up to which a smallest step may be forced."""
FORCED_STEPS = 50
"""So many steps in a row may be forced; more means that the solution does not leave the discontinuity."""


def largest(error: Array) -> Array:
    """Norm of a scaled error: a mean would hide one active cell among thousands at rest."""
    return jnp.max(jnp.abs(error), initial=0.0)


SMALLEST_ERROR = 1e-10, 1e-2
"""Errors below the first, of a step that is judged, and below the second, of the one before it, count as these."""


class ErrorControl(AbstractAdaptiveStepSizeController[Any, Any]):
    """Predictive control of the step size, that crosses a jump of the vector field by one smallest step.

    The size of a step follows from its error and from how the error has changed since the step before; behind a refused
    step it does not grow at once. The native engine has the same control. With one that lets steps grow more slowly, a
    method can stay before a jump that is its own attractor (`der(x) == noevent(where(x > 1, 0, k))`): all its steps
    mix values from both sides, and none ends beyond it.

    No error estimate falls below the tolerance while a step contains a jump. The steps shrink to `smallest`, which
    is of the order of rounding error of the time: that step is taken in spite of its estimate. The error it makes in
    the states is the jump times `smallest`; algebraic unknowns may jump themselves. A state whose estimate is above
    `JUMP` tolerances, or one that is not finite, or `FORCED_STEPS` forced steps in a row end the solve with
    `dt_min_reached`: there the solution has ended.

    No step goes beyond a kink of inputs or tables over time: a pulse between two evaluations would not be seen.

    Source: Gustafsson (1994), Control-theoretic techniques for stepsize selection in implicit Runge-Kutta methods, ACM
    TOMS 20; Hairer & Wanner, *Solving Ordinary Differential Equations II*, IV.8.

    Args:
        rtol: relative tolerance.
        atol: absolute tolerance, one number or one for each variable.
        states: how many of the unknowns, the first ones, are states; None for all.
        smallest: smallest step at the far end of the time axis [s]; elsewhere the smallest step is that fraction of
            the time, so that a run over 1e11 s can begin with steps of microseconds.
        kinks: where steps end; None for nowhere.
    """

    rtol: Any
    atol: Any
    smallest: Any
    kinks: Kinks | None = None
    states: int | None = eqx.field(static=True, default=None)
    norm: Callable[[Any], Any] = eqx.field(static=True, default=largest)

    def wrap(self, direction: Any) -> ErrorControl:
        """For the time of diffrax, which runs forwards where the run goes backwards: the kinks alone depend on it."""
        if self.kinks is None:
            return self
        return eqx.tree_at(lambda control: control.kinks, self, self.kinks.reversed(direction))

    def init(
        self, terms: Any, t0: Any, t1: Any, y0: Any, dt0: Any, args: Any, func: Any, error_order: Any
    ) -> tuple[Any, Any]:
        """First end point and state of the control; see `diffrax.AbstractStepSizeController.init`."""
        first = diffrax.PIDController(rtol=self.rtol, atol=self.atol, norm=self.norm)
        end, _ = first.init(terms, t0, t1, y0, dt0, args, func, error_order)
        zero = jnp.zeros_like(jnp.asarray(end))
        end, planned = self._end(t0, end - t0, t1)
        return end, _State(zero, jnp.ones_like(zero), jnp.asarray(False), jnp.asarray(0), t1 + zero, planned)

    def adapt_step_size(
        self, t0: Any, t1: Any, y0: Any, y1_candidate: Any, args: Any, y_error: Any, error_order: Any,
        controller_state: Any,
    ) -> tuple[Any, Any, Any, Any, Any, RESULTS]:  # fmt: skip
        """Whether to keep the step, and the next; see `diffrax.AbstractStepSizeController.adapt_step_size`."""
        del args
        state: _State = controller_state
        h = t1 - t0
        scaled = jax.tree.map(self._scaled, y0, y1_candidate, y_error)
        error = jax.lax.stop_gradient(self.norm(scaled))
        leaves = [*jax.tree.leaves(y1_candidate), *jax.tree.leaves(y_error)]
        finite = jnp.all(jnp.stack([jnp.all(jnp.isfinite(leaf)) for leaf in leaves]))
        good = finite & (error <= 1.0)
        floor = smallest_step(t0, self.smallest)
        at_floor = h <= 1.5 * floor
        of_states = jnp.max(jnp.abs(_flat(scaled))[: self.states], initial=0.0)
        force = at_floor & ~good & finite & (of_states <= JUMP)
        forced = jnp.where(force, state.forced + 1, jnp.where(good, 0, state.forced))
        kept = good | force
        size = jnp.maximum(jnp.where(finite, error, 1.0), SMALLEST_ERROR[0])
        step = jnp.where(kept, self._next(h, size, good, state, error_order), self._again(h, size, finite, error_order))
        next_t0 = jnp.where(kept, t1, t0)
        step = jnp.where(kept, jnp.maximum(step, state.planned), step)  # one cut short says nothing against the planned
        next_t1, planned = self._end(next_t0, jax.lax.stop_gradient(jnp.maximum(step, floor)), state.end)
        failed = (at_floor & ~kept) | (forced > FORCED_STEPS)
        result = RESULTS.where(failed, RESULTS.dt_min_reached, RESULTS.successful)
        before = jax.lax.stop_gradient(jnp.where(kept, h, state.step))
        error_before = jnp.where(kept, jnp.maximum(size, SMALLEST_ERROR[1]), state.error)
        state = _State(before, error_before, ~kept, forced, state.end, planned)
        return kept, next_t0, next_t1, False, state, result

    def _end(self, t: Any, step: Any, end: Any) -> tuple[Any, Any]:
        """End of the step from t on, by the end of the run or the next kink, and what was planned if it is cut."""
        if self.kinks is not None:
            end = jnp.minimum(end, self.kinks.after(t, smallest_step(t, self.smallest)))
        size, planned = _limited(step, end - t)
        return jnp.where(size >= end - t, end, t + size), planned

    def _scaled(self, y0: Any, y1: Any, error: Any) -> Any:
        magnitude = jnp.maximum(jnp.abs(y0), jnp.abs(jnp.where(jnp.isfinite(y1), y1, y0)))
        return error / (self.atol + self.rtol * magnitude)

    @staticmethod
    def _next(h: Any, error: Any, good: Any, state: _State, order: Any) -> Any:
        """Size of the step behind one that is kept."""
        step = h * jnp.clip(0.9 * error ** (-1 / order), 0.2, 8.0)
        known = state.step > 0.0
        ratio = h / jnp.where(known, state.step, 1.0)
        predicted = h * jnp.clip(0.9 * ratio * (state.error / error**2) ** (1 / order), 0.2, 8.0)
        step = jnp.where(known & good, jnp.minimum(step, predicted), step)
        return jnp.where(state.refused, jnp.minimum(step, h), step)

    @staticmethod
    def _again(h: Any, error: Any, finite: Any, order: Any) -> Any:
        """Size of the step in the place of one that is refused."""
        return h * jnp.where(finite, jnp.clip(0.9 * error ** (-1 / order), 0.2, 1.0), 0.1)


class _State(NamedTuple):
    """What the control knows.

    Attributes:
        step, error: size and error of the last step that was kept.
        refused: whether one was refused since.
        forced: how many were forced in a row.
        end: end of the run.
        planned: size of the present step before it was cut short, or 0.
    """

    step: Any
    error: Any
    refused: Any
    forced: Any
    end: Any
    planned: Any


def smallest_step(t: Any, smallest: Any) -> Any:
    """The smallest step at time t [s], of a run with the smallest step `smallest` at its far end."""
    return jnp.maximum(ROUNDING * jnp.abs(t), 1e-10 * smallest)


def _limited(step: Any, left: Any) -> tuple[Any, Any]:
    """The step where `left` is left to where it must end, and what was planned if it is cut.

    Two equal steps rather than one and a short rest.
    """
    last = step >= left * (1.0 - 1e-12)
    size = jnp.where(last, left, jnp.minimum(step, 0.5 * left))
    return size, jnp.where(step <= size, 0.0, step)


def _flat(tree: Any) -> Array:
    return jnp.concatenate([jnp.ravel(leaf) for leaf in jax.tree.leaves(tree)])
