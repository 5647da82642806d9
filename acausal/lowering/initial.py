"""Initialization: consistent values at the start, from fixed starts, initial equations, invariants and guesses.

Unknowns are the states that are not fixed and the algebraic unknowns. Where the conditions leave freedom, the solution
nearest to the start values is taken (in the scale of the nominal values): a Gauss-Newton iteration with minimum-norm
steps (Deuflhard 2011, Newton Methods for Nonlinear Problems, 4.4).
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from ..language.flat_model import Bools, Family
from ..language.template import Floats, Ints
from ..passes.aliases import Reduced
from ..passes.implied import Step, implied
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
HOMOTOPY_STEPS = 20
ASIDE = (1e-3, -1e-3, 0.1, -0.1, 1.0, -1.0)
"""Largest distances from the guess, in nominal values, of further attempts: upwards first, as most quantities that have
a square are positive."""
SATISFIED = 1e-9
"""Relative residual from which no other attempt is made."""
SMALLEST_STEP = 1e-15
"""Step, in units of the variables' scales, that changes nothing any more."""
MOST_TRIED = 300
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
        plans: how the conditions are evaluated, by the variables that have a value (`conditions`).
        chains: how states follow from these.
    """

    lowered: Lowered
    start_source: Ints
    start_sign: Ints
    fixed: Bools
    targets: Ints
    families: list[Family]
    ease: Floats
    plans: dict[bytes, Any] = field(default_factory=dict[bytes, Any], init=False)
    chains: dict[bytes, list[Step]] = field(default_factory=dict[bytes, list[Step]], init=False)

    @property
    def all_ease(self) -> Floats:
        """The same with that of the algebraic unknowns (n_x + n_w,)."""
        return np.concatenate([self.ease, EASE_ALGEBRAIC * self.lowered.w_nominal])

    def chain(self, fixed: Bools, ids: Ints) -> list[Step]:
        """How further states follow from those in the mask `fixed` and from the variables `ids`."""
        key = fixed.tobytes() + ids.tobytes()
        if key not in self.chains:
            states, known = self.lowered.schedule.states, np.zeros(self.lowered.n_ids, bool)
            known[states[fixed]] = known[ids] = True
            self.chains[key] = implied(self.lowered.schedule.reduced, known, states[~fixed].tolist())
        return self.chains[key]


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
    counts = np.where(given, 1 + 2 * fixed, 0)
    counts[: flat.n_var] += given[: flat.n_var] & flat.modified
    # fixed values count before guesses, and guesses by modification before those of classes; then that of its own
    for v in members[reduced.representative[members] != members].tolist():
        r = int(reduced.representative[v])
        best = int(source[r])
        if counts[v] > counts[best] or (best != r and fixed[v] and fixed[best]):
            source[r], sign[r] = v, int(reduced.sign[v])
    fixed |= fixed[source]
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
    given = given_starts(problem, starts, overrides, p, jnp)
    x_start, w_start, ids, wanted = given.x, given.w, given.ids, given.wanted
    if not given.conditions:
        return x_start, _algebraic(low, t0, x_start, w_start, p) if low.n_w else w_start, jnp.zeros(0)
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
    columns = np.concatenate([free, low.n_x + np.arange(low.n_w)]) if together else free
    away = aside(columns) * nominal
    y, left = _gauss_newton(residual, y_start, jnp.asarray(ease), jnp.asarray(nominal), jnp.asarray(away), x_start)
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


def given_starts(problem: InitialProblem, starts: Any, overrides: dict[int, Any], p: Any, xp: Any) -> GivenStarts:
    """Start values with `overrides` in place, guesses that contradict fixed ones replaced.

    Args:
        problem, starts, overrides, p: as for `solve_initial`.
        xp: numpy or jax.numpy.
    """
    low = problem.lowered
    states = low.schedule.states
    x = _start_of(problem, states, starts, xp)
    w = _start_of(problem, low.schedule.tears, starts, xp)
    fixed = problem.fixed.copy()
    ids = problem.targets[~np.isin(problem.targets, list(overrides))] if overrides else problem.targets
    wanted = _start_of(problem, ids, starts, xp)
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
    x = _without_contradictions(problem, x, fixed, ids, wanted, p, xp)
    return GivenStarts(x, w, fixed, ids, wanted, bool(len(ids) or problem.families or low.n_g))


def _without_contradictions(
    problem: InitialProblem, x: Any, fixed: Bools, ids: Ints, wanted: Any, p: Any, xp: Any
) -> Any:
    """Start values of the states, with what follows from those that are `fixed` and from `wanted` of `ids`."""
    chain = problem.chain(fixed, ids)
    if not chain:
        return x
    place = {int(v): i for i, v in enumerate(problem.lowered.schedule.states)}
    values = {int(v): wanted[i] for i, v in enumerate(ids)}
    values |= {v: x[i] for v, i in place.items() if fixed[i]}
    for step in chain:
        values[step.target] = step.value(values.__getitem__, p, xp)
        i = place.get(step.target)
        if i is not None:
            new = xp.where(xp.isfinite(values[step.target]), values[step.target], x[i])
            if xp is np:
                x[i] = new
            else:
                x = x.at[i].set(new)
    return x


def concerned(problem: InitialProblem, ids: Ints) -> Bools:
    """Mask of the states that conditions (other than the algebraic equations) depend on, possibly over others."""
    from .sparsity import condition_pattern

    low = problem.lowered
    pattern = condition_pattern(low, ids, problem.families)
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
    """Start values of the variables, zero where none is given."""
    if not len(ids):
        return xp.zeros(0)
    values = problem.start_sign[ids] * starts[problem.start_source[ids]]
    return xp.where(xp.isnan(values), 0.0, values)


def aside(columns: Ints) -> Floats:
    """How far from the guess the further attempts begin, in nominal values: (attempts, columns).

    Each variable, by its number among states and algebraic unknowns, has the same numbers in every engine (`ac_beside`
    in initialize.h), so that all find the same root: xorshift, Marsaglia (2003), J. Statistical Software 8:14.
    """
    out = np.zeros((len(ASIDE), int(columns.max(initial=-1)) + 1))
    for attempt, size in enumerate(ASIDE):
        state = 88172645463325252 + attempt
        for j in range(out.shape[1]):
            state ^= state << 13 & 0xFFFFFFFFFFFFFFFF
            state ^= state >> 7
            state ^= state << 17 & 0xFFFFFFFFFFFFFFFF
            out[attempt, j] = size * (state >> 11) / 2.0**53
    return out[:, columns]


def _algebraic(low: Lowered, t0: Any, x: Any, w_start: Any, p: Any) -> Any:
    """Algebraic unknowns (n_w,) at given states; where Newton's method fails from the guess, all equations together."""
    import jax
    import jax.numpy as jnp

    if low.n_w > LARGEST:
        return low.solve_algebraic(t0, x, w_start, p)
    at = jax.lax.stop_gradient((t0, x, p))
    guess = jax.lax.stop_gradient(w_start)

    def together(near: Any) -> Any:
        del near
        nominal = jnp.asarray(low.w_nominal)
        away = aside(low.n_x + np.arange(low.n_w)) * nominal
        return _search(
            lambda w: low.derivatives(at[0], at[1], w, at[2])[1], guess, EASE_ALGEBRAIC * nominal, nominal, away
        )

    near = low.solve_algebraic(at[0], at[1], guess, at[2])
    near = jax.lax.cond(jnp.isfinite(near).all(), lambda near: near, together, near)
    return low.solve_algebraic(t0, x, jax.lax.stop_gradient(near), p)


class _Search(NamedTuple):
    """Where the search for a root is.

    Attributes:
        y, residual, size, delta: the present point, its residuals, the size of each row, and the step from it.
        left: largest residual at y of the whole conditions, relative to nominal values.
        factor: part of the step to be tried; 0 to begin at y.
        tried: points tried in this attempt.
        attempt: 0 from the guess, then the conditions turned on gradually, then from beside the guess.
        best, best_left: of the attempts that are over.
    """

    y: Any
    residual: Any
    size: Any
    delta: Any
    left: Any
    factor: Any
    tried: Any
    attempt: Any
    best: Any
    best_left: Any


def _search(system: Any, start: Any, scale: Any, nominal: Any, away: Any) -> Any:
    """Root of `system` near `start`: steps of least norm, halved until the residual falls, as `root_near` takes them.

    Where they fail, the conditions are turned on gradually, then it begins beside the guess. One loop does it all, so
    that the equations are compiled once.

    Args:
        system: y to residuals (m,).
        start: guess (n,).
        scale, nominal: scales in which the unknowns are moved, and their typical sizes (n,).
        away: how far from the guess the last attempts begin, (attempts, n).
    """
    import jax
    import jax.numpy as jnp

    value_and_slope = jax.jacfwd(lambda y: (lambda r: (r, r))(system(y)), has_aux=True)
    whole = system(start)
    whole = jnp.where(jnp.isfinite(whole).all(), whole, 0.0)
    first_aside = HOMOTOPY_STEPS + 1

    def share(attempt: Any) -> Any:
        gradual = (attempt > 0) & (attempt < first_aside)
        return jnp.where(gradual, 1.0 - attempt / HOMOTOPY_STEPS, 0.0)

    def visit(state: _Search) -> _Search:
        y = state.y + state.factor * state.delta * scale
        j, all_of = value_and_slope(y)
        r = all_of - share(state.attempt) * whole
        nominal_size = _row_size(j * nominal)
        size = jnp.maximum(_row_size(j * scale), nominal_size)
        norm, before = (jnp.linalg.norm(v / state.size) for v in (r, state.residual))
        better = (state.factor == 0.0) | (norm < before)
        delta = jnp.linalg.lstsq(j * scale / size[:, None], -r / size, rcond=1e-11)[0]
        delta = jnp.where(jnp.isfinite(delta), delta, 0.0)
        left = jnp.max(jnp.where(jnp.isfinite(all_of), jnp.abs(all_of) / nominal_size, jnp.inf), initial=0.0)
        moved = state._replace(y=y, residual=r, size=size, delta=delta, left=left, factor=jnp.ones(()))
        kept = state._replace(factor=0.5 * state.factor)
        state = jax.tree.map(lambda a, b: jnp.where(better, a, b), moved, kept)
        return state._replace(tried=state.tried + 1)

    def settle(state: _Search) -> _Search:
        """The end of an attempt, and the beginning of the next one."""
        counts = (share(state.attempt) == 0.0) & (state.left < state.best_left)
        best = jnp.where(counts, state.y, state.best)
        attempt = state.attempt + 1
        begin = jnp.where(attempt == 1, start, state.y)
        begin = jnp.where(attempt >= first_aside, start + away[attempt - first_aside], begin)
        return state._replace(
            y=begin, factor=jnp.zeros(()), tried=jnp.zeros((), int), attempt=attempt, best=best,
            best_left=jnp.where(counts, state.left, state.best_left),
        )  # fmt: skip

    def body(state: _Search) -> _Search:
        state = visit(state)
        stands = state.factor * jnp.max(jnp.abs(state.delta), initial=0.0) < SMALLEST_STEP
        over = stands | (state.factor <= 1e-9) | (state.tried >= MOST_TRIED)
        return jax.tree.map(lambda a, b: jnp.where(over, a, b), settle(state), state)

    def again(state: _Search) -> Any:
        return (state.best_left > SATISFIED) & (state.attempt < first_aside + len(ASIDE))

    zero, none = jnp.zeros(()), jnp.zeros(start.shape)
    rest = jnp.zeros(whole.shape), jnp.ones(whole.shape)
    state = _Search(start, *rest, none, zero, zero, jnp.zeros((), int), jnp.zeros((), int), start, jnp.asarray(jnp.inf))
    return jax.lax.while_loop(again, body, state).best


def _gauss_newton(
    residual: Any, y_start: Any, scale: Any, nominal: Any, away: Any, context: Any
) -> tuple[Any, Any]:
    """Nearest root to `y_start`, and its residual (relative to the scale of each equation).

    The iteration runs without derivatives; one more step outside of it carries them: at a root its derivative is that
    of the implicit function, and start values move the solution within the null space of the Jacobian.
    """
    import jax
    import jax.numpy as jnp

    frozen = jax.lax.stop_gradient(context)

    def f(y: Any) -> Any:
        return residual(y, frozen)

    start = jax.lax.stop_gradient(y_start)
    y = jax.lax.stop_gradient(_search(f, start, scale, nominal, away))
    j = jax.lax.stop_gradient(jax.jacfwd(f)(y)) * scale
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
