"""Steady states: where all derivatives vanish."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from ..errors import SimulationError
from .linearize import checked_inputs, named_values

if TYPE_CHECKING:
    from ..language.template import Floats
    from ..system import System

FIRST, STEPS, STEP_TOLERANCE, SETTLED = 1e-2, 100, 1e-8, 1e-2
"""Of the way to a steady state: part of its scale by which a state may move in the first step, number of steps, what is
left in each, and the relative change in a step from which Newton's method is tried."""


def _followed(
    residual: Callable[[Floats], tuple[Floats, Floats]], y: Floats, n_x: int, scale: Floats, tolerance: float
) -> tuple[Floats, Floats]:
    """A root that growing implicit Euler steps of ``dx = residual[:n_x]`` lead to, and its relative residuals."""
    from ..lowering.initial_numeric import gauss_newton

    states = np.arange(n_x)
    rate = np.max(np.abs(residual(y)[0][:n_x]) / scale[:n_x], initial=0.0)
    h = FIRST / rate if 0.0 < rate < np.inf else 1.0
    left = np.full(len(y), np.inf)
    for _ in range(STEPS):

        def step(z: Floats, y: Floats = y, h: float = h) -> tuple[Floats, Floats]:
            value, slope = residual(z)
            value, slope = value.copy(), slope.copy()
            value[:n_x] -= (z - y)[:n_x] / h
            slope[states, states] -= scale[:n_x] / h
            return value, slope

        after, missed = gauss_newton(step, y, scale)
        if not np.max(missed, initial=0.0) <= STEP_TOLERANCE:
            h *= 0.1
            continue
        moved = np.max(np.abs(after - y) / np.maximum(scale, np.abs(after)), initial=0.0)
        y, h = after, 3.0 * h
        if moved > SETTLED:
            continue
        found, left = gauss_newton(residual, y, scale)
        if np.max(left, initial=0.0) <= tolerance:
            return found, left
    return y, left


def steady_state(
    system: System,
    *,
    t: float = 0.0,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, float] | None = None,
    guess: Any = None,
    tolerance: float = 1e-10,
) -> dict[str, float]:
    """Values of all variables at a point where the derivatives of all states are zero.

    The root is sought from the start of the model (or `guess`) by damped Gauss-Newton steps of minimum norm, with
    invariants as further equations; of a continuum of steady states the nearest one is found. Where that fails, as in
    circuits of transistors, the model is followed on its way there by implicit Euler steps that grow (pseudo-transient
    continuation, Kelley and Keyes 1998).

    Args:
        system: a compiled model.
        t: time at which sources are evaluated [s].
        parameters: dotted name to value.
        inputs: values of inputs by name; 0 where they are not given.
        guess: states to start from (n_x,), or values by name.
        tolerance: largest relative residual.

    Returns:
        dotted name to value, for every variable of the model.

    Raises:
        SimulationError: none was found; the states that do not settle are named.
    """
    from ..lowering.initial_numeric import gauss_newton
    from ..lowering.numeric import NumericRun

    low = system.lowered
    fed = checked_inputs(system, inputs)
    x, w0, p = (np.asarray(a, float) for a in system.initialize(t, parameters, inputs=fed))
    if isinstance(guess, Mapping):
        x, w0 = named_values(system, cast("Mapping[str, Any]", guess), x, w0)
    elif guess is not None:
        x = np.asarray(guess, float)
    free = np.arange(low.n_x)
    scale = np.concatenate([low.x_nominal, low.w_nominal])

    def residual(y: Any) -> tuple[Any, Any]:
        run = NumericRun(low, t, y[: low.n_x], y[low.n_x :], p, free)
        g, dg = run.families(low.schedule.invariants)
        value = np.concatenate([run.value[low.dx_ids], run.residual[0], g])
        return value, np.concatenate([run.gradient[low.dx_ids], run.residual[1], dg]) * scale

    first = np.concatenate([x, w0])
    y, left = gauss_newton(residual, first, scale)
    if not np.max(left, initial=0.0) <= tolerance:
        y, left = _followed(residual, first, low.n_x, scale, tolerance)
    if not np.max(left, initial=0.0) <= tolerance:
        names = [*system.states, *(f"the equation of {n}" for n in system.algebraics)]
        worst = [f"`{names[i]}`" for i in np.argsort(-np.nan_to_num(left, nan=np.inf))[:5] if i < len(names)]
        raise SimulationError(
            f"`{system.name}` has no steady state near the given start: {', '.join(worst)} keep changing (largest "
            f"relative residual {np.max(left):.2g}). Try another `guess`, or simulate until it settles"
        )
    run = NumericRun(low, t, y[: low.n_x], y[low.n_x :], p, free)
    representative, sign = system.observed_ids
    names = system.stages.flat.names.all_variables
    values = np.where(sign == 0, 0.0, sign * run.value[representative])
    return {name: float(values[i]) for i, name in enumerate(names)}
