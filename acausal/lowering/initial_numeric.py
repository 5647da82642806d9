"""Initialization with NumPy: the same problem as in `initial`, solved without compiling anything.

Used when all values are known numbers; inside JAX transformations `initial.solve_initial` does the work. Where Newton's
method fails from the given guesses, the conditions are turned on gradually (Newton homotopy, Allgower and Georg 2003,
Introduction to Numerical Continuation Methods, 1.1).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ..language.template import Floats, Ints
from .conditions import Conditions
from .initial import EASE_ALGEBRAIC, InitialProblem, aside, given_starts

ITERATIONS = 100
HOMOTOPY_STEPS = 20
SMALLEST_STEP = 1e-15
"""Step, in units of the variables' scales, that changes nothing any more."""
DAMPING = 1e-12
"""Added to the normal equations of large problems, whose conditions may repeat each other."""

Function = Callable[[Floats], tuple[Floats, Any]]
"""From z = (x, w) to the residuals (m,) and their Jacobian (m, n_x + n_w), dense or sparse."""


def solve_numeric(
    problem: InitialProblem, t0: float, p: Floats, starts: Floats, overrides: Mapping[int, float],
    compiled: Function | None = None,
) -> tuple[Floats, Floats, Floats] | None:  # fmt: skip
    """Consistent (x0, w0) and the relative residuals of the conditions, or None if the problem is too large for this.

    Args:
        problem: what must hold.
        t0: start time [s].
        p: all parameters (n_p,).
        starts: start values of all variables (nan where not given).
        overrides: reduced variable index to value: further fixed starts.
        compiled: the conditions with their Jacobian as compiled code, where there is some: algebraic equations,
            invariants, values of `problem.targets`, initial equations.
    """
    low = problem.lowered
    given = given_starts(problem, starts, dict(overrides), p, np)
    if not given.conditions:
        if not low.n_w:
            return given.x, given.w, np.zeros(0)
        given.fixed[:] = True
    if compiled is None:
        evaluate = Conditions(problem, t0, p, given.ids, given.wanted)
        if evaluate.too_many:
            return None
        may_move = evaluate.may_move
    else:
        evaluate, may_move = _compiled(compiled, low.n_w + low.n_g, given.wanted), np.ones(low.n_x, bool)
    z = np.concatenate([given.x, given.w])
    nominal = np.concatenate([low.x_nominal, low.w_nominal])
    ease = np.concatenate([problem.ease, EASE_ALGEBRAIC * low.w_nominal])
    algebraic = low.n_x + np.arange(low.n_w)
    free = np.concatenate([np.flatnonzero(~given.fixed & may_move), algebraic])
    if given.conditions and low.n_w:  # the algebraic unknowns alone first, so that they do not pull at the states
        part = _Part(evaluate, nominal, ease, algebraic, slice(low.n_w))
        near = root_near(part, z)
        if np.max(part.left(near), initial=0.0) <= 1e-9:
            z = near
    conditions = _Part(evaluate, nominal, ease, free, slice(None))
    found = root_near(conditions, z)
    left = conditions.left(found)
    for attempt in (_homotopy, _beside):
        if np.max(left, initial=0.0) <= 1e-9:
            break
        other = attempt(conditions, z)
        better = conditions.left(other)
        if np.max(better, initial=0.0) < np.max(np.nan_to_num(left, nan=np.inf), initial=0.0):
            found, left = other, better
    return found[: low.n_x], found[low.n_x :], left


def _compiled(conditions: Function, first: int, wanted: Floats) -> Function:
    """Conditions of which those from number `first` on are to have the values `wanted`."""

    def function(z: Floats) -> tuple[Floats, Any]:
        value, slope = conditions(z)
        value[first : first + len(wanted)] -= wanted
        return value, slope

    return function


class _Part:
    """Some of the conditions as a function of some of the variables."""

    def __init__(self, function: Function, nominal: Floats, ease: Floats, columns: Ints, rows: slice) -> None:
        self.function = function
        self.nominal = nominal
        self.scale = ease[columns]
        self.columns = columns
        self.rows = rows
        self.offset: Any = 0.0

    def __call__(self, z: Floats) -> tuple[Floats, Any, Floats]:
        """Residuals, Jacobian with respect to the scaled variables, and the size of each row over all variables."""
        r, j = self.function(z)
        r, j = r[self.rows] - self.offset, j[self.rows]
        whole = _largest(_times(j, self.nominal))
        part = _times(j[:, self.columns], self.scale)
        size = np.maximum(_largest(part), whole)
        return r, part, np.where(size > 0, size, 1.0)

    def left(self, z: Floats) -> Floats:
        """Residuals, each relative to the change that the nominal value of some variable makes."""
        r, j = self.function(z)
        size = _largest(_times(j[self.rows], self.nominal))
        return np.abs(r[self.rows]) / np.where(size > 0, size, 1.0)


def _times(j: Any, scale: Floats) -> Any:
    return j.multiply(scale[None, :]).tocsr() if sparse.issparse(j) else j * scale


def _largest(j: Any) -> Floats:
    """Largest magnitude in each row."""
    if sparse.issparse(j):
        return np.nan_to_num(np.asarray(abs(j).max(axis=1).todense()).ravel()) if j.shape[1] else np.zeros(j.shape[0])
    return np.abs(np.nan_to_num(j)).max(axis=1, initial=0.0)


@np.errstate(over="ignore", invalid="ignore")  # a step that goes too far is halved
def root_near(system: _Part, z: Floats) -> Floats:
    """Root of `system` near `z`: steps of minimum norm, halved until the residual falls."""
    z = z.copy()
    r, j, size = system(z)
    norm = _norm(r, size)
    for _ in range(ITERATIONS):
        delta = _step(r, j, size)
        if delta is None:
            break
        factor, length = 1.0, np.abs(delta).max(initial=0.0)
        while factor > 1e-9 and factor * length >= SMALLEST_STEP:
            new = z.copy()
            new[system.columns] += factor * delta * system.scale
            r_new, j_new, size_new = system(new)
            if _norm(r_new, size) < norm:
                break
            factor *= 0.5
        else:
            break
        z, r, j, size = new, r_new, j_new, size_new
        norm = _norm(r, size)
    return z


def gauss_newton(system: Function, y: Floats, scale: Floats) -> tuple[Floats, Floats]:
    """Root of `system` near `y`, and the relative residuals.

    Args:
        system: y to (residuals (m,), Jacobian times scale (m, n)).
        y: first guess (n,).
        scale: typical magnitude of the unknowns (n,).
    """

    def unscaled(z: Floats) -> tuple[Floats, Any]:
        r, j = system(z)
        return r, j / scale

    part = _Part(unscaled, scale, scale, np.arange(len(y)), slice(None))
    found = root_near(part, y)
    return found, part.left(found)


def gauss_newton_part(
    system: Function, z: Floats, nominal: Floats, ease: Floats, columns: Ints
) -> tuple[Floats, Floats]:
    """Root of `system` near z that differs in some of the variables only, and the relative residuals.

    Args:
        system: z to (residuals (m,), Jacobian (m, n)).
        z: first guess (n,).
        nominal: typical magnitude of the variables (n,).
        ease: scale in which a variable is moved (n,).
        columns: the variables that may move.
    """
    part = _Part(system, nominal, ease, columns, slice(None))
    found = root_near(part, z)
    left = part.left(found)
    if np.max(left, initial=0.0) > 1e-9 or not np.isfinite(left).all():
        other = _homotopy(part, z)
        if np.max(part.left(other), initial=0.0) < np.max(np.nan_to_num(left, nan=np.inf), initial=0.0):
            return other, part.left(other)
    return found, left


def _norm(r: Floats, size: Floats) -> float:
    """Residual relative to the slopes at the last point."""
    return float(np.linalg.norm(r / size)) if np.isfinite(r).all() else np.inf


def _step(r: Floats, j: Any, size: Floats) -> Floats | None:
    """Least-squares step of minimum norm, None if there is none to take."""
    if not np.isfinite(r).all() or not r.any() or not j.shape[1]:
        return None
    if not sparse.issparse(j):
        if not np.isfinite(j).all():
            return None
        return np.linalg.lstsq(j / size[:, None], -r / size, rcond=1e-11)[0]
    if not np.isfinite(j.data).all():
        return None
    scaled = (sparse.diags_array(1 / size) @ j).tocsr()
    used = np.flatnonzero(np.diff(scaled.indptr))
    scaled, rhs = scaled[used], -r[used] / size[used]
    normal = (scaled @ scaled.T + DAMPING * sparse.eye_array(len(used))).tocsc()
    return scaled.T @ splu(normal).solve(rhs)


def least_change(j: Any, ease: Floats, rate: Floats) -> Floats:
    """Change of the unknowns, in units of `ease`, that undoes the rates (m, k) of the conditions: (n, k), the least.

    Args:
        j: Jacobian (m, n), dense or sparse.
        ease: scale of the unknowns (n,).
        rate: how the conditions move.
    """
    matrix = _times(j, ease)
    size = _largest(matrix)
    size = np.where(size > 0, size, 1.0)
    found = [_step(rate[:, k], matrix, size) for k in range(rate.shape[1])]
    return np.stack([np.zeros(matrix.shape[1]) if f is None else f for f in found], axis=1)


def _homotopy(system: _Part, z: Floats) -> Floats:
    """Follow the root of ``r(z) - (1 - s) r(z0)`` from s = 0 to 1."""
    r0, _, _ = system(z)
    if not np.isfinite(r0).all():
        return z
    for k in range(1, HOMOTOPY_STEPS + 1):
        system.offset = (1.0 - k / HOMOTOPY_STEPS) * r0
        z = root_near(system, z)
    system.offset = 0.0
    return z


def _beside(system: _Part, z: Floats) -> Floats:
    """The root from guesses beside the given one, where a slope may not vanish that vanishes there."""
    best, least = z, np.inf
    for away in aside(system.columns):
        near = z.copy()
        near[system.columns] += system.nominal[system.columns] * away
        found = root_near(system, near)
        left = float(np.max(np.nan_to_num(system.left(found), nan=np.inf), initial=0.0))
        if left < least:
            best, least = found, left
        if least <= 1e-9:
            break
    return best
