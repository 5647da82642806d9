"""Initialization: consistent values at the start, from fixed starts, initial equations, invariants and guesses.

Unknowns are the states that are not fixed and the algebraic unknowns. Where the conditions leave freedom, the solution
nearest to the start values is taken (in the scale of the nominal values): a Gauss-Newton iteration with minimum-norm
steps (Deuflhard 2011, Newton Methods for Nonlinear Problems, 4.4).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from ..language.flat_model import Bools, Family
from ..language.template import Floats, Ints
from ..passes.aliases import Reduced
from .lowered import Lowered

EASE_NOT_GIVEN, EASE_ALGEBRAIC = 1e2, 1e4
"""How much more readily than a state with a start value a state without one, or an algebraic unknown, is moved."""

LEAST = 1e-8
"""A state whose start value is less than 1, without a nominal value, is moved in the scale of the start value, but not
less readily than this."""
ACCEPTED = 1e-6
"""A condition holds if moving one variable by this fraction of its nominal value could make it hold exactly. Newton's
method leaves much less; what is left is the rounding of start values that are given twice, as all coordinates of a
mechanism."""
LARGEST = 1000
"""Up to so many unknowns the conditions are solved together; beyond, only for the states that they concern."""


@dataclass(slots=True, eq=False)
class InitialProblem:
    """What must hold at the start.

    Attributes:
        start_source: for every reduced variable, the variable whose start value it takes (an alias, or itself).
        start_sign: sign of that alias.
        fixed: mask over the states of those whose start value is an equation.
        targets: other variables whose start value is an equation.
        families: initial equations.
        ease: scale of the states in the distance from the start values.
    """

    lowered: Lowered
    start_source: Ints
    start_sign: Ints
    fixed: Bools
    targets: Ints
    families: list[Family]
    ease: Floats



def initial_problem(reduced: Reduced, lowered: Lowered, families: list[Family], with_start: Bools) -> InitialProblem:
    """Collect start values over alias sets.

    Args:
        reduced: the model after alias elimination.
        lowered: the compiled equations.
        families: initial equations over representatives.
        with_start: mask of the variables that have a start value.
    """
    flat = reduced.flat
    n = lowered.n_ids
    source, sign = np.arange(n), np.ones(n, np.int64)
    fixed = np.zeros(n, bool)
    fixed[: flat.n_var] = flat.fixed[: flat.n_var] == 1
    given = np.zeros(n, bool)
    given[: len(with_start)] = with_start
    members = np.flatnonzero(given[: len(reduced.representative)])
    alias = members[reduced.representative[members] != members]
    # later assignments win: guesses first, fixed ones last; a representative's own fixed value stays
    for v in alias[np.argsort(fixed[alias], kind="stable")][::-1]:
        r = int(reduced.representative[v])
        own = given[r] and (fixed[r] or not fixed[v])
        if not own and not (source[r] != r and fixed[source[r]]):
            source[r], sign[r] = v, int(reduced.sign[v])
            fixed[r] = fixed[r] or fixed[v]
    states = lowered.schedule.states
    is_state = np.zeros(n, bool)
    is_state[states] = True
    remaining = np.zeros(n, bool)
    remaining[: len(reduced.unknown)] = reduced.unknown
    targets = np.flatnonzero(fixed & remaining & ~is_state)
    given[: len(with_start)] = with_start
    value = np.abs(flat.start[source[states]])
    small = np.isnan(flat.nominal[states]) & (value > 0) & (value < 1)
    trust = np.where(small, np.maximum(value, LEAST), 1.0)
    ease = lowered.x_nominal * np.where(given[source[states]], trust, EASE_NOT_GIVEN)
    return InitialProblem(lowered, source, sign, fixed[states], targets, families, ease)


def solve_initial(
    problem: InitialProblem, t0: Any, p: Any, starts: Any, overrides: dict[int, Any]
) -> tuple[Any, Any, Any]:
    """Consistent (x0, w0) and the remaining residuals.

    Args:
        problem: what must hold.
        t0: start time [s].
        p: all parameters.
        starts: start values of all variables (nan where not given).
        overrides: reduced variable index to value: further fixed starts.
    """
    import jax
    import jax.numpy as jnp

    low = problem.lowered
    given = given_starts(problem, starts, overrides, jnp)
    x_start, w_start, ids, wanted = given.x, given.w, given.ids, given.wanted
    if not given.conditions:
        w0 = low.solve_algebraic(t0, x_start, w_start, p) if low.n_w else w_start
        return x_start, w0, jnp.zeros(0)
    free = np.flatnonzero(~given.fixed)
    together = len(free) + low.n_w <= LARGEST
    if not together:
        free = free[concerned(problem, ids)[free]]

    def residual(y: Any, x_start: Any) -> Any:
        x = x_start.at[free].set(y[: len(free)]) if len(free) else x_start
        if together:
            w = y[len(free) :]
            parts = [low.derivatives(t0, x, w, p)[1]] if low.n_w else []
        else:
            w, parts = low.solve_algebraic(t0, x, w_start, p) if low.n_w else w_start, []
        if low.n_g:
            parts.append(low.invariants(t0, x, w, p))
        if len(ids):
            parts.append(low.values(ids, t0, x, w, p) - wanted)
        if problem.families:
            parts.append(low.residuals_of(problem.families, t0, x, w, p))
        return jnp.concatenate(parts)

    nominal, ease, y_start = low.x_nominal[free], problem.ease[free], x_start[free]
    if together:
        if low.n_w:  # the algebraic unknowns alone first, so that they do not pull at the states
            w_near = jax.lax.stop_gradient(low.solve_algebraic(t0, x_start, w_start, p))
            w_start = jnp.where(jnp.isfinite(w_near).all(), w_near, w_start)
        nominal = np.concatenate([nominal, low.w_nominal])
        ease = np.concatenate([ease, EASE_ALGEBRAIC * low.w_nominal])
        y_start = jnp.concatenate([y_start, w_start])
    y, left = _gauss_newton(residual, y_start, jnp.asarray(ease), jnp.asarray(nominal), x_start)
    x0 = x_start.at[free].set(y[: len(free)]) if len(free) else x_start
    if together:
        return x0, y[len(free) :], left
    w0 = low.solve_algebraic(t0, x0, w_start, p) if low.n_w else w_start
    return x0, w0, jnp.concatenate([jnp.zeros(low.n_w), left])


@dataclass(slots=True, eq=False)
class GivenStarts:
    """Start values, and those that are conditions.

    Attributes:
        x, w: start values of states and algebraic unknowns.
        fixed: mask of the states that keep theirs.
        ids, wanted: other variables whose start value is a condition, and these values.
        conditions: whether there is more to solve than the algebraic equations.
    """

    x: Any
    w: Any
    fixed: Bools
    ids: Ints
    wanted: Any
    conditions: bool


def given_starts(problem: InitialProblem, starts: Any, overrides: dict[int, Any], xp: Any) -> GivenStarts:
    """Start values with `overrides` in place; `xp` is numpy or jax.numpy."""
    low = problem.lowered
    states = low.schedule.states
    x = _start_of(problem, states, starts, xp)
    w = _start_of(problem, low.schedule.tears, starts, xp)
    fixed = problem.fixed.copy()
    ids = problem.targets[~np.isin(problem.targets, list(overrides))] if overrides else problem.targets
    wanted = problem.start_sign[ids] * starts[problem.start_source[ids]]
    position = {int(v): i for i, v in enumerate(states)} if overrides else {}
    inside = {position[k]: v for k, v in overrides.items() if k in position}
    outside = {k: v for k, v in overrides.items() if k not in position}
    if inside:
        at = np.array(list(inside), np.int64)
        values = xp.stack([xp.asarray(v, float) for v in inside.values()])
        fixed[at] = True
        if xp is np:
            x[at] = values
        else:
            x = x.at[at].set(values)
    if outside:
        ids = np.concatenate([ids, np.array(list(outside), np.int64)])
        wanted = xp.concatenate([wanted, xp.stack([xp.asarray(v, float) for v in outside.values()])])
    return GivenStarts(x, w, fixed, ids, wanted, bool(len(ids) or problem.families or low.n_g))


def concerned(problem: InitialProblem, ids: Ints) -> Bools:
    """Mask of the states that conditions (other than the algebraic equations) depend on, possibly over others."""
    from .sparsity import condition_pattern

    low = problem.lowered
    pattern = condition_pattern(low, ids, [*low.schedule.invariants, *problem.families])
    return connected(pattern, np.arange(pattern.shape[0]) >= low.n_w)[: low.n_x]


def connected(pattern: Any, rows: Bools) -> Bools:
    """Mask of the columns in the connected components of `pattern` that have one of `rows`."""
    m = pattern.shape[0]
    graph = sparse.bmat([[None, pattern], [pattern.T, None]], format="csr")
    count, label = csgraph.connected_components(graph, directed=False)
    reached = np.zeros(count, bool)
    reached[label[:m][rows]] = True
    return reached[label[m:]]


def _start_of(problem: InitialProblem, ids: Ints, starts: Any, xp: Any) -> Any:
    if not len(ids):
        return xp.zeros(0)
    values = problem.start_sign[ids] * starts[problem.start_source[ids]]
    return xp.where(xp.isnan(values), 0.0, values)


def _gauss_newton(residual: Any, y_start: Any, scale: Any, nominal: Any, context: Any) -> tuple[Any, Any]:
    """Nearest root to `y_start`, and its residual (relative to the scale of each equation).

    The iteration runs without derivatives; one more step outside of it carries them: at a root its derivative is that
    of the implicit function, and start values move the solution within the null space of the Jacobian.
    """
    import jax
    import jax.numpy as jnp

    frozen = jax.lax.stop_gradient(context)

    def f(y: Any) -> Any:
        return residual(y, frozen)

    jac = jax.jacfwd(f)

    def step_of(y: Any) -> tuple[Any, Any]:
        r, j = f(y), jac(y) * scale
        row = _row_size(j)
        delta = jnp.linalg.lstsq(j / row[:, None], -r / row, rcond=1e-11)[0]
        return delta, jnp.linalg.norm(r / row)

    def body(state: Any) -> Any:
        y, _, k = state
        delta, size = step_of(y)
        delta = jnp.where(jnp.isfinite(delta), delta, 0.0)

        def worse(s: Any) -> Any:
            return (~(s[1] < size)) & (s[0] > 1e-9)

        def halve(s: Any) -> Any:
            factor = 0.5 * s[0]
            return factor, step_of(y + factor * delta * scale)[1]

        factor, new = jax.lax.while_loop(worse, halve, (jnp.ones(()), step_of(y + delta * scale)[1]))
        moved = jnp.abs(factor * delta).max(initial=0.0)
        y = jnp.where(new < size, y + factor * delta * scale, y)
        return y, jnp.where(new < size, moved, 0.0), k + 1

    def again(state: Any) -> Any:
        return (state[1] > 1e-15) & (state[2] < 80)

    start = jax.lax.stop_gradient(y_start)
    flat = (jnp.abs(jac(start)).max(axis=1, initial=0.0) == 0) & (jnp.abs(f(start)) > 0)
    aside = start + 1e-3 * nominal * np.random.default_rng(1).uniform(-1, 1, start.shape)
    y, _, _ = jax.lax.while_loop(again, body, (jnp.where(flat.any(), aside, start), jnp.asarray(jnp.inf), 0))
    y = jax.lax.stop_gradient(y)
    j = jax.lax.stop_gradient(jac(y)) * scale
    row = _row_size(j)
    pseudo = jnp.linalg.pinv(j / row[:, None], rtol=1e-11)
    r = residual(y, context)
    left = jax.lax.stop_gradient(jnp.abs(r) / _row_size(j * (nominal / scale)))
    correction = -pseudo @ (r / row)
    tangent_start = (y_start - start) / scale
    null = tangent_start - pseudo @ ((j / row[:, None]) @ tangent_start)
    # values are those of the iteration; only derivatives come from the two linear terms
    correction = correction - jax.lax.stop_gradient(correction)
    return y + (correction + null) * scale, left


def _row_size(j: Any) -> Any:
    """Largest element of each row, 1 for a row of zeros."""
    import jax.numpy as jnp

    size = jnp.abs(j).max(axis=1, initial=0.0)
    return jnp.where(size > 0, size, 1.0)
