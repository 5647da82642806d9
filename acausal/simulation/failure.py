"""What to say when a solve fails: the time, the variable, and the equation if it can be found."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from ..nonfinite import block_equations
from ..passes.combine import scaled
from .divisors import vanishing_divisor
from .lowered import Lowered

LARGEST = 500
"""Up to so many algebraic unknowns their Jacobian is looked at."""
SINGULAR = 1e-7
"""Smallest singular value relative to the largest, after scaling: steps end near a singular point, not at it."""
VANISHED = 1e-5
"""The same beside what the equations say of the states: an unknown vanishes with the root of the distance."""
RUN_AWAY = 1e20
"""Size, in nominal values, of an unknown that no equation holds any more."""
SHOWN = 6
"""Unknowns named."""

_WHAT = {
    "max_steps_reached": "the most steps allowed, {max_steps}, were taken",
    "dt_min_reached": "the step size fell to rounding error",
    "internal_error": "diffrax met an internal error",
}


def explain(
    system: Any,
    lowered: Lowered,
    result: str,
    stats: dict[str, Any],
    last: Sequence[Any],
    p: Any,
    t1: float,
    max_steps: int,
) -> str:
    """The message for a solve that ended at the point `last = (t, x, w)` with a diffrax result.

    Outside JAX transformations only: it evaluates the model once more at the last good point.
    """
    t, x, w = float(last[0]), jnp.asarray(last[1]), jnp.asarray(last[2])
    what = _WHAT.get(result, result.replace("_", " ")).format(max_steps=max_steps)
    head = f"The simulation stopped at t = {t:.9g} s of {t1:.9g} s: {what}."
    counts = f"{stats['steps']} steps by {stats['solver']}, {stats['rejected']} of them rejected."
    dx, r = lowered.derivatives(t, x, w, p)
    found = _nonfinite(system, dx, r)
    lost = _run_away(system, lowered, w)
    if found:
        return "\n".join([head, f"{found} there.", *_equation(system, lowered, t, x, w, p), *lost, counts])

    lines = [head, *_fastest(system, np.asarray(x), np.asarray(dx), lowered.x_nominal)]
    if result in ("dt_min_reached", "max_steps_reached"):
        # The steps that failed went just beyond the last point.
        step = 1e-6 * (t1 - t)
        beyond = t + step, x + step * dx, w, p
        found = _nonfinite(system, *lowered.derivatives(*beyond))
        if found:
            lines += [f"{found} just beyond this point.", *_equation(system, lowered, *beyond)]
    if result == "dt_min_reached":
        lines.append(
            "Often: a square root or a division that leaves its domain, a solution that grows without bound, a "
            "discontinuity that should be an event, or a variable that matters while it is far below its absolute "
            "tolerance (give it its `nominal`, or a smaller `atol`)."
        )
    if result in ("dt_min_reached", "singular"):
        lines += lost or _singular(system, lowered, t, x, w, p)
    if result in ("dt_min_reached", "max_steps_reached"):
        lines += _divided(system, lowered, p, t, t1)
    if result == "max_steps_reached":
        lines.append("Raise `max_steps`, loosen `rtol`, or look for chattering in this variable.")
    return "\n".join([*lines, counts])


def _nonfinite(system: Any, dx: Any, r: Any) -> str:
    """The first value that is not finite, as `name is value`; empty if there is none."""
    for values, names, text in ((dx, system.states, "der({})"), (r, system.algebraics, "the residual of {}")):
        bad = np.flatnonzero(~np.isfinite(np.asarray(values)))
        if bad.size:
            return f"{text.format(names[bad[0]])} is {np.asarray(values)[bad[0]]}"
    return ""


def _singular(system: Any, lowered: Lowered, t: float, x: Any, w: Any, p: Any) -> list[str]:
    """The algebraic unknowns that their equations no longer determine, and these equations."""
    if not hasattr(system, "stages") or not 0 < w.size <= LARGEST:
        return []
    slopes = jax.jacfwd(lambda x, w: lowered.derivatives(t, x, w, p)[1], argnums=(0, 1))(x, w)
    by_states, by_unknowns = (np.asarray(slope, float) for slope in slopes)
    if not np.isfinite(by_unknowns).all():
        return []
    found = _undetermined(scaled(by_unknowns), SINGULAR)
    if found is None and np.isfinite(by_states).all():
        # a single equation compares with itself: beside what it says of the states, it may say nothing of its unknown
        moved = np.concatenate([by_states * lowered.x_nominal, by_unknowns * lowered.w_nominal], axis=1)
        size = np.abs(moved).max(axis=1, keepdims=True)
        found = _undetermined(moved[:, len(x) :] / np.where(size > 0, size, 1.0), VANISHED)
    if found is None:
        return []
    weak = np.abs(found)
    unknowns = np.flatnonzero(weak > 1e-3 * weak.max())[:SHOWN]
    names = ", ".join(f"`{system.algebraics[k]}`" for k in unknowns)
    head = f"The Jacobian is singular there: these equations do not determine {names}:"
    return [head, *block_equations(system, unknowns)]


def _run_away(system: Any, lowered: Lowered, w: Any) -> list[str]:
    """The algebraic unknowns that have left all bounds, and their equations: there is no solution any more."""
    if not hasattr(system, "stages"):
        return []
    lost = np.flatnonzero(~(np.abs(np.asarray(w)) < RUN_AWAY * np.asarray(lowered.w_nominal)))[:SHOWN]
    if not len(lost):
        return []
    names = ", ".join(f"`{system.algebraics[k]}`" for k in lost)
    return [f"These equations have no solution for {names} there:", *block_equations(system, lost)]


def _undetermined(matrix: np.ndarray, least: float) -> np.ndarray | None:
    """The direction that a matrix does not determine, if there is one."""
    _, sigma, right = np.linalg.svd(matrix)
    return right[-1] if sigma[-1] <= least * max(sigma[0], 1.0) else None


def _equation(system: Any, lowered: Any, t: float, x: Any, w: Any, p: Any) -> list[str]:
    """What the system itself says about a non-finite value, if it can say anything."""
    diagnose = getattr(system, "diagnose_nonfinite", None)
    if isinstance(p, tuple):  # of a driven system: the numbers of its inputs go along
        p = lowered.at(t, p)
    text = diagnose(t, x, w, p) if diagnose is not None else None
    return [text] if text else []


def _divided(system: Any, lowered: Any, p: Any, t: float, t1: float) -> list[str]:
    """What is divided by that vanishes."""
    if not hasattr(system, "stages"):
        return []
    parameters = np.asarray(lowered.at(t, p) if isinstance(p, tuple) else p, float)
    return vanishing_divisor(system.stages.index, parameters, t, t1)


def _fastest(system: Any, x: np.ndarray, dx: np.ndarray, nominal: np.ndarray) -> list[str]:
    """The state that changes fastest for its size: most often the one whose error the steps follow."""
    if not x.size:
        return []
    speed = np.abs(dx) / (np.abs(x) + np.asarray(nominal))
    worst = int(np.argmax(speed))
    value = f"{system.states[worst]} = {x[worst]:.6g}"
    return [f"The fastest variable there is {value}, changing at {dx[worst]:.6g} per second."]
