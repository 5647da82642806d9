"""What to say when a solve fails: the time, the variable, and the equation if it can be found."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np

from .lowered import Lowered

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
    dx, r = (np.asarray(v) for v in lowered.derivatives(t, x, w, p))
    states = list(system.states)
    algebraics = [*getattr(system, "iteration_variables", ())] or [f"iteration variable {i}" for i in range(w.size)]

    bad = np.flatnonzero(~np.isfinite(dx))
    bad_r = np.flatnonzero(~np.isfinite(r))
    if bad.size or bad_r.size:
        name = f"der({states[bad[0]]})" if bad.size else f"the equation of {algebraics[bad_r[0]]}"
        value = dx[bad[0]] if bad.size else r[bad_r[0]]
        found = f"{name} is {value} there."
        return "\n".join([head, found, *_equation(system, t, x, w, p), counts])

    lines = [head, *_fastest(states, np.asarray(x), dx, lowered.x_nominal)]
    if result == "dt_min_reached":
        # Just beyond the last point: the step that failed went there.
        ahead = x + dx * 1e-9 * max(abs(t1 - t), 1e-9)
        lines += _equation(system, t, ahead, w, p)
        lines.append(
            "Often: a solution that grows without bound, a square root or division that leaves its domain beyond this "
            "point, or a discontinuity that should be an event."
        )
    if result == "max_steps_reached":
        lines.append("Raise `max_steps`, loosen `rtol`, or look for chattering in this variable.")
    return "\n".join([*lines, counts])


def _equation(system: Any, t: float, x: Any, w: Any, p: Any) -> list[str]:
    """What the system itself says about a non-finite value, if it can say anything."""
    diagnose = getattr(system, "diagnose_nonfinite", None)
    text = diagnose(t, x, w, p) if diagnose is not None else None
    return [text] if text else []


def _fastest(states: list[str], x: np.ndarray, dx: np.ndarray, nominal: np.ndarray) -> list[str]:
    """The state that changes fastest for its size: most often the one whose error the steps follow."""
    if not x.size:
        return []
    speed = np.abs(dx) / (np.abs(x) + np.asarray(nominal))
    worst = int(np.argmax(speed))
    return [f"The fastest variable there is {states[worst]} = {x[worst]:.6g}, changing at {dx[worst]:.6g} per second."]
