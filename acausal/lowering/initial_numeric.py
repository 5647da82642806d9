"""Initialization with NumPy: the same problem as in `initial`, solved without compiling anything.

Used when all values are known numbers; inside JAX transformations `initial.solve_initial` does the work. Where Newton's
method fails from the given guesses, the conditions are turned on gradually (Newton homotopy, Allgower and Georg 2003,
Introduction to Numerical Continuation Methods, 1.1).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ..language.template import Floats
from .initial import EASE_ALGEBRAIC, InitialProblem
from .numeric import NumericRun

LARGEST = 400
"""Problems with more unknowns than this are left to the compiled path."""
ITERATIONS = 100
HOMOTOPY_STEPS = 20

System = Callable[[Floats], tuple[Floats, Floats]]


def solve_numeric(
    problem: InitialProblem, t0: float, p: Floats, starts: Floats, overrides: Mapping[int, float]
) -> tuple[Floats, Floats, Floats] | None:
    """Consistent (x0, w0) and the relative residuals of the conditions, or None if the problem is too large for this.

    Args:
        problem: what must hold.
        t0: start time [s].
        p: all parameters (n_p,).
        starts: start values of all variables (nan where not given).
        overrides: reduced variable index to value: further fixed starts.
    """
    low = problem.lowered
    states, tears = low.schedule.states, low.schedule.tears
    x = _start_of(problem, states, starts)
    w = _start_of(problem, tears, starts)
    fixed = problem.fixed.copy()
    targets = {int(v): problem.start_sign[v] * starts[int(problem.start_source[v])] for v in problem.targets}
    position = {int(v): i for i, v in enumerate(states)} if overrides else {}
    for index, value in overrides.items():
        if index in position:
            x[position[index]] = value
            fixed[position[index]] = True
        else:
            targets[index] = value
    if not (targets or problem.families or low.n_g):
        if not low.n_w:
            return x, w, np.zeros(0)
        fixed[:] = True
    free = np.flatnonzero(~fixed)
    if len(free) + len(tears) > LARGEST:
        return None
    ids = np.array(list(targets), np.int64)
    wanted = np.array(list(targets.values()), float)
    scale = np.concatenate([problem.ease[free], EASE_ALGEBRAIC * low.w_nominal])

    def system(y: Floats) -> tuple[Floats, Floats]:
        at = x.copy()
        at[free] = y[: len(free)]
        run = NumericRun(low, t0, at, y[len(free) :], p, free)
        invariants, d_invariants = run.families(low.schedule.invariants)
        extra, d_extra = run.families(problem.families)
        value = np.concatenate([run.residual[0], invariants, run.value[ids] - wanted, extra])
        slope = np.concatenate([run.residual[1], d_invariants, run.gradient[ids], d_extra])
        return value, slope * scale

    start = np.concatenate([x[free], w])
    y, left = gauss_newton(system, start, scale)
    if not left.size or not np.max(left, initial=0.0) <= 1e-9:
        other, better = _homotopy(system, start, scale)
        if np.max(better, initial=np.inf) < np.max(np.nan_to_num(left, nan=np.inf), initial=0.0):
            y, left = other, better
    x[free] = y[: len(free)]
    return x, y[len(free) :], left


def _start_of(problem: InitialProblem, ids: np.ndarray, starts: Floats) -> Floats:
    values = problem.start_sign[ids] * starts[problem.start_source[ids]]
    return np.nan_to_num(np.asarray(values, float))


def gauss_newton(system: System, y: Floats, scale: Floats) -> tuple[Floats, Floats]:
    """Root of `system` near `y` (minimum-norm steps, halved until the residual falls), and the relative residuals.

    Args:
        system: y to (residuals (m,), Jacobian times scale (m, n)).
        y: first guess (n,).
        scale: typical magnitude of the unknowns (n,).
    """
    y = y.copy()
    r, j = system(y)
    for _ in range(ITERATIONS):
        delta, size = _step(r, j)
        if delta is None:
            break
        factor = 1.0
        while factor > 1e-9:
            new = y + factor * delta * scale
            r_new, j_new = system(new)
            if _norm(r_new, j) < size:
                break
            factor *= 0.5
        else:
            break
        y, r, j = new, r_new, j_new
        if np.abs(factor * delta).max(initial=0.0) < 1e-15:
            break
    row = _rows(j)
    return y, np.abs(r) / row


def _rows(j: Floats) -> Floats:
    return np.maximum(np.abs(np.nan_to_num(j)).max(axis=1, initial=0.0), 1e-300)


def _norm(r: Floats, j: Floats) -> float:
    """Residual relative to the slopes at the last point."""
    return float(np.abs(r / _rows(j)).max(initial=0.0)) if np.isfinite(r).all() else np.inf


def _step(r: Floats, j: Floats) -> tuple[Floats | None, float]:
    row = _rows(j)
    if not (np.isfinite(r).all() and np.isfinite(j).all()):
        return None, np.inf
    size = float(np.abs(r / row).max(initial=0.0))
    if size == 0.0:
        return None, 0.0
    return np.linalg.lstsq(j / row[:, None], -r / row, rcond=1e-11)[0], size


def _homotopy(system: System, y: Floats, scale: Floats) -> tuple[Floats, Floats]:
    """Follow the root of ``r(y) - (1 - s) r(y0)`` from s = 0 to 1."""
    r0, _ = system(y)
    if not np.isfinite(r0).all():
        return y, np.full(len(r0), np.inf)
    for k in range(1, HOMOTOPY_STEPS + 1):
        part = (1.0 - k / HOMOTOPY_STEPS) * r0

        def shifted(v: Floats, part: Floats = part) -> tuple[Floats, Floats]:
            r, j = system(v)
            return r - part, j

        y, _ = gauss_newton(shifted, y, scale)
    r, j = system(y)
    return y, np.abs(r) / _rows(j)
