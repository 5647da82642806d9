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
    dx, r = lowered.derivatives(t, x, w, p)
    found = _nonfinite(system, dx, r)
    if found:
        return "\n".join([head, f"{found} there.", *_equation(system, t, x, w, p), counts])

    lines = [head, *_fastest(system, np.asarray(x), np.asarray(dx), lowered.x_nominal)]
    if result == "dt_min_reached":
        # The step that failed went just beyond the last point.
        step = 1e-6 * (t1 - t)
        beyond = t + step, x + step * dx, w, p
        found = _nonfinite(system, *lowered.derivatives(*beyond))
        if found:
            lines += [f"{found} just beyond this point.", *_equation(system, *beyond)]
        lines.append(
            "Often: a square root or a division that leaves its domain, a solution that grows without bound, a "
            "discontinuity that should be an event, or a variable that matters while it is far below its absolute "
            "tolerance (give it its `nominal`, or a smaller `atol`)."
        )
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


def _equation(system: Any, t: float, x: Any, w: Any, p: Any) -> list[str]:
    """What the system itself says about a non-finite value, if it can say anything."""
    diagnose = getattr(system, "diagnose_nonfinite", None)
    text = diagnose(t, x, w, p) if diagnose is not None else None
    return [text] if text else []


def _fastest(system: Any, x: np.ndarray, dx: np.ndarray, nominal: np.ndarray) -> list[str]:
    """The state that changes fastest for its size: most often the one whose error the steps follow."""
    if not x.size:
        return []
    speed = np.abs(dx) / (np.abs(x) + np.asarray(nominal))
    worst = int(np.argmax(speed))
    value = f"{system.states[worst]} = {x[worst]:.6g}"
    return [f"The fastest variable there is {value}, changing at {dx[worst]:.6g} per second."]
