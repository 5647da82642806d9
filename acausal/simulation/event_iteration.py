"""What happens at an event: modes, triggers, left limits and states until nothing changes any more.

Everything is solved together by the model's own equations, in which modes, left limits and triggers are numbers; this
iteration finds these numbers. Modelica Language Specification 3.6, 8.6 and Appendix B.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.errors import SimulationError
from acausal.language.template import Ints
from acausal.lowering.hybrid import Hybrid, Piece, Point
from acausal.lowering.initial import InitialProblem
from acausal.lowering.levels import levels
from acausal.passes.impulses import driven_states
from acausal.told import tell

from .mode_search import NOISE, TURNS, Equations, ModeSearch
from .native_library import Floats
from .scan import EPS

JUMPS = 1e-5
"""Equations whose sides differ by more than this, relative to what is in them, jump at an event."""
ROUNDING = 1e-13
"""Values of a condition this small, relative to the quantities in it, are rounding."""
SIMULTANEOUS = 1e-9
"""A sample that is this part of its interval away from an event is at the event."""


@dataclass(frozen=True, slots=True)
class Clock:
    """What samples at ``start + k interval``, k = 0, 1, ...; `slot` is true at these moments."""

    start: float
    interval: float
    slot: int

    def time(self, k: float) -> float:
        """Time of sample k [s]."""
        return self.start + k * self.interval

    def passed(self, t: float) -> float:
        """How many samples there have been until t, those behind it by no more than rounding included."""
        return max(0.0, float(np.floor((t - self.start) / self.interval + self._slack(t))) + 1.0)

    def is_due(self, t: float) -> bool:
        """Whether there is a sample at t itself."""
        k = self.passed(t)
        return k > 0 and abs(self.time(k - 1) - t) <= self._slack(t) * self.interval

    def _slack(self, t: float) -> float:
        return SIMULTANEOUS + 4 * EPS * (abs(t) + abs(self.start)) / self.interval


@dataclass(slots=True, eq=False)
class Move:
    """One turn of an event, as its derivatives need it.

    Attributes:
        t, z, p: a solution of the equations; z before anything is reinitialized.
        reinits: for each of `Hybrid.reinits` the rows that act.
        z_after: with the new states.
        free: states that may follow the new ones, or None if nothing has to.
    """

    t: float
    z: Floats
    p: Floats
    reinits: list[Any]
    z_after: Floats
    free: Any = None


@dataclass(slots=True, eq=False)
class Outcome:
    """What an event has led to.

    Attributes:
        z, p: from where the run goes on.
        values: of all reduced variables there.
        ended: message of `terminate`, or None.
        changed: slots whose modes or triggers took part, for the record.
    """

    z: Floats
    p: Floats
    values: Floats
    ended: str | None = None
    changed: list[int] = field(default_factory=list[int])


class EventIteration(ModeSearch):
    """Carries out events.

    Args:
        hybrid: what there is.
        problem: initialization of the system, for reinitialized states that depend on each other.
        equations: how an engine evaluates the system.
    """

    def __init__(self, hybrid: Hybrid, problem: InitialProblem, equations: Equations) -> None:
        super().__init__(hybrid, problem, equations)
        self.warned: set[tuple[int, int]] = set()
        self.jumped: set[int] = set()
        self.followed: set[int] = set()
        self.shared: set[bytes] = set()
        self.clocks: list[Clock] = []
        self.moves: list[Move] = []
        self.noise: Floats = np.zeros(hybrid.roots.count)

    # ---- pieces -----------------------------------------------------------------------------------
    def _put_lefts(self, p: Floats, point: Point) -> list[int]:
        """Put left limits into p; the slots that change, those of continuous quantities by more than rounding."""
        changed: list[int] = []
        lefts = [piece.values(point)[0] for piece in self.hybrid.pres]  # before any changes: one may have another in it
        for piece, moves, left in zip(self.hybrid.pres, self.hybrid.moving_lefts, lefts, strict=True):
            old = p[piece.slots]
            same = (old == left) | (np.isnan(old) & np.isnan(left))
            if moves:
                same |= np.abs(left - old) <= NOISE * self._scale(piece, point)
            changed += piece.slots[~same].tolist()
            p[piece.slots] = left
        return changed

    # ---- one event --------------------------------------------------------------------------------
    def event(self, t: float, z: Floats, p: Floats, roots: Any = None, samples: list[int] | None = None) -> Outcome:
        """What follows at time t from the left limits z.

        Args:
            t: time [s].
            z: states and algebraic unknowns before (n_z,).
            p: parameters and slots before (n_p,).
            roots: mask of the roots that have switched.
            samples: slots of the samples that are due, `terminal` included.
        """
        p = p.copy()
        self.equations.feed(t, p)
        z = self._settled(t, z, p)
        self.moves = [Move(t, z, p.copy(), [], z)]
        left = Point(t, self.equations.values(t, z, p), p)
        self._put_lefts(p, left)
        self._sample(p, samples or [], 1.0)
        changed = self._flip(p, left, roots)
        outcome = self._iterate(t, z, p)
        self.forced = []
        if samples:
            outcome = self._over(t, outcome, samples)
        self._check_jumps(left, outcome)
        outcome.changed = [*changed, *(samples or []), *outcome.changed]
        return outcome

    def _over(self, t: float, outcome: Outcome, samples: list[int]) -> Outcome:
        """The samples are over, at the same time: what is true with them falls back, and is seen to do so."""
        z, p = outcome.z, outcome.p
        self._sample(p, samples, 0.0)
        z = self._settled(t, z, p)
        values = self.equations.values(t, z, p)
        if np.array_equal(values, outcome.values, equal_nan=True):  # only triggers depend on them
            self.before = self._conditions(Point(t, outcome.values, p))
            return outcome
        after = self._iterate(t, z, p)
        after.ended, after.changed = outcome.ended or after.ended, [*outcome.changed, *after.changed]
        return after

    def _sample(self, p: Floats, slots: list[int], value: float) -> None:
        for slot in slots:
            p[slot] = value

    def _flip(self, p: Floats, left: Point, roots: Any) -> list[int]:
        """Modes of the conditions that were found to switch."""
        if roots is None or not roots.any():
            return []
        slots = self.hybrid.roots.slots[roots]
        modes = np.unique(slots[slots >= 0])
        p[modes] = 1.0 - p[modes]
        self.forced = changed = modes.tolist()
        if (slots < 0).any():
            for piece in self.hybrid.floors:
                changed += self._put(p, piece.slots, self.hybrid.steps(piece, left))
        return changed

    def _iterate(self, t: float, z: Floats, p: Floats) -> Outcome:
        """To the fixed point: no trigger is left, and left limits are values."""
        seen, active, moved = list[int](), list[int](), list[int]()
        ended: str | None = None
        for _ in range(TURNS):
            z, values = self._consistent(t, z, p)
            point = Point(t, values, p)
            now = self._conditions(point)
            active = self._active(p)
            seen += active
            self._check(point)
            if active:
                ended = ended or self._ends(point)
            z, left = self._reinitialized(t, z, p, point)
            moved = self._put_lefts(p, left)
            self.before = now
            if not active and not moved:
                self._check_solved(t, values)
                self._rounding(values)
                self._note_sizes(point)
                return Outcome(z, p, values, ended, list(dict.fromkeys(seen)))
            for piece in self.hybrid.triggers:
                p[piece.slots] = 0.0
        raise SimulationError(
            f"At t = {t:.12g} s the events do not come to an end: each change brings about another. Involved are:\n"
            + self._names([*active, *moved] or seen)
        )

    def _check_jumps(self, left: Point, outcome: Outcome) -> None:
        """What a jump leaves out: the impulse in the derivatives of what jumps; where `reinit` acts, it says how.

        Raises:
            SimulationError: a state would have to jump with it.
        """
        if not self.hybrid.jumps or any(len(rows) for move in self.moves for rows in move.reinits):
            return
        low, flat = self.problem.lowered, self.hybrid.flat
        point = Point(left.t, left.v, outcome.p)
        for jump in self.hybrid.jumps:
            apart, size = jump.size(point, low.nominal)
            for k in np.flatnonzero(apart > JUMPS * size)[:1].tolist():
                rows, row = jump.piece.rows, int(jump.piece.slots[k])
                states = driven_states(low.schedule, row)
                names = ", ".join(f"`{low.schedule.reduced.name(int(v))}`" for v in states[:5])
                text = (
                    f"At t = {left.t:.9g} s this equation jumps, but it has been differentiated, and the derivative "
                    f"has an impulse there:\n    {flat.equation_line(rows, k)}\n"
                )
                if len(states):
                    slope = low.schedule.reduced.row_integral[row] >= 0  # the equation as written has a kink
                    source = (
                        "whose slope does not jump (a table of cubics, or a filter of higher order behind it)" if slope
                        else "without jumps (a steep ramp, or a filter behind it)"
                    )  # fmt: skip
                    raise SimulationError(
                        f"{text}With it {names} would have to jump.\nTry: a source {source}, or `reinit` in a `when` "
                        "that says what the states are behind the jump."
                    )
                if row not in self.jumped:
                    self.jumped.add(row)
                    tell(f"{text}The results do not show the impulse; all else is right.")

    def _check_solved(self, t: float, values: Floats) -> None:
        """Raise an error where coupled equations have become singular with these modes."""
        low = self.problem.lowered
        unknowns = [g.unknowns.ravel() for g in low.schedule.groups if g.kernel.size > 1]
        ids = np.concatenate([np.zeros(0, np.int64), *unknowns])
        lost = ids[~np.isfinite(values[ids])]
        if len(lost):
            names = ", ".join(f"`{self.hybrid.flat.name(int(v))}`" for v in lost[:5])
            raise SimulationError(
                f"At t = {t:.12g} s the equations are singular with the present states of all switches: nothing "
                f"determines {names}.\nTwo parts of the model fix the same quantity at once, such as two closed "
                "switches side by side, or two clutches that slide with no inertia between them: give one of them some "
                "resistance or elasticity, what is between them some inertia, or remove one."
            )

    def _note_sizes(self, point: Point) -> None:
        for piece in self.hybrid.relations:
            places, g = piece.slots - self.hybrid.first, np.abs(piece.values(point)[0])
            self.largest[places] = np.maximum(self.largest[places], np.where(np.isfinite(g), g, 0.0))

    @property
    def largest_of_roots(self) -> Floats:
        """Largest values of the conditions at the events so far (n_roots,), where each root is that of a condition."""
        return self.largest[self.hybrid.roots.slots - self.hybrid.first]

    @property
    def sizes_of_roots(self) -> Floats:
        """The same for all roots: that of a step of `floor` is 1."""
        slots = self.hybrid.roots.slots
        return np.where(slots < 0, 1.0, self.largest[np.maximum(slots - self.hybrid.first, 0)])

    def note_largest(self, values: Floats) -> None:
        """Take over values as `largest_of_roots` gives them."""
        self.largest[self.hybrid.roots.slots - self.hybrid.first] = values

    def _rounding(self, values: Floats) -> None:
        """What of each root function is rounding: nothing where it depends on time and discrete variables only."""
        parts: list[Any] = [np.zeros(0)]
        nominal = self.problem.lowered.nominal
        size = np.fmax(np.abs(values), nominal[: len(values)])
        for family, moves in zip(self.hybrid.roots.families, self.hybrid.moving_roots, strict=True):
            parts.append(ROUNDING * (size[family.var_rows] * moves).max(axis=1, initial=0.0))
        self.noise = np.concatenate(parts)

    # ---- actions ----------------------------------------------------------------------------------
    def _reinitialized(self, t: float, z: Floats, p: Floats, point: Point) -> tuple[Floats, Point]:
        """States with the values that `reinit` gives, and what the left limits of the next turn are.

        What depends on these states follows by the least change. A second `reinit` at the same moment begins from what
        the first has given: the states are copied before their left limits are (Modelica Language Specification 8.3.6).
        """
        low = self.problem.lowered
        wanted: dict[int, float] = {}
        move = Move(t, z, p.copy(), [], z)
        self.moves.append(move)
        for item in self.hybrid.reinits:
            trigger, value = item.piece.values(point)
            move.reinits.append(np.flatnonzero(trigger))
            for row in move.reinits[-1]:
                wanted[int(item.targets[row])] = float(item.signs[row] * value[row])
        if not wanted:
            return z, point
        self.forced = []
        ids, values = np.array(list(wanted), np.int64), np.array(list(wanted.values()))
        position = {int(v): i for i, v in enumerate(low.schedule.states.tolist())}
        z = z.copy()
        own = np.array([int(v) in position for v in ids])
        z[[position[int(v)] for v in ids[own]]] = values[own]
        if not own.all() or low.n_g:
            move.free = self._may_follow(ids)
            z = self._moved(t, z, p, ids, values, move.free)
        move.z_after = z
        self._tell_followers(t, z, p, point, ids, values)
        if low.n_g and ids.tobytes() not in self.shared:
            self.shared.add(ids.tobytes())
            self._tell_shared(t, z, p, point, ids, values)
        behind = point.v.copy()
        behind[low.schedule.states] = z[: low.n_x]
        behind[ids] = values
        return z, Point(t, behind, p)

    def _tell_shared(self, t: float, z: Floats, p: Floats, before: Point, ids: Ints, values: Floats) -> None:
        """Warn of states that jump with `reinit` by the least change, each of which could keep its value.

        So it is in a mechanism whose constraints leave more freedom than `reinit` takes.
        """
        low = self.problem.lowered
        states = low.schedule.states
        old = before.v[states]
        size = np.maximum(np.maximum(np.abs(old), np.abs(z[: low.n_x])), low.x_nominal)
        open_: list[int] = []
        for v in np.setdiff1d(states[np.abs(z[: low.n_x] - old) > JUMPS * size], ids).tolist():
            try:
                self._moved(t, z, p, np.append(ids, v), np.append(values, before.v[v]), self._may_follow(ids))
            except SimulationError:  # it has to follow
                continue
            open_.append(v)
        if open_:
            new, some = (", ".join(f"`{low.schedule.reduced.name(int(v))}`" for v in of[:5]) for of in (ids, open_))
            first = low.schedule.reduced.name(open_[0])
            tell(
                f"At t = {t:.9g} s `reinit` of {new} does not say how {some} jump with it: the constraints that bind "
                "them leave each of them free to keep its value, and they have been changed as little as possible.\n"
                f"Try: name more of them, as in `reinit({first}, pre({first}))` for one that keeps its value."
            )

    def _tell_followers(self, t: float, z: Floats, p: Floats, before: Point, ids: Ints, values: Floats) -> None:
        """Warn of what jumps with `reinit` although it could keep its value, as velocities with relative ones do.

        A variable whose derivative an equation holds stays as it is at an impulse on another part. Where the states are
        relative coordinates instead, these keep their values, and it jumps.
        """
        kept, followers = self.hybrid.kept, self.hybrid.followers
        if not len(kept) or not len(followers):
            return
        low, name = self.problem.lowered, self.hybrid.flat.name
        after = self.equations.values(t, self._settled(t, z, p), p)
        size = np.maximum(np.maximum(np.abs(before.v), np.abs(after)), low.nominal[: len(after)])
        moved = followers[np.abs(after - before.v)[followers] > JUMPS * size[followers]]
        for v in np.setdiff1d(moved, [*ids, *self.followed]).tolist():
            try:
                self._moved(t, z, p, np.append(ids, v), np.append(values, before.v[v]), self._may_follow(ids))
            except SimulationError:  # it has to follow
                continue
            self.followed.add(v)
            new, still = (", ".join(f"`{name(int(k))}`" for k in some[:4]) for some in (ids, kept))
            keep = "the states {} keep their values" if len(kept) > 1 else "the state {} keeps its value"
            tell(
                f"At t = {t:.9g} s `reinit` of {new} changes `{name(v)}`, too, from {before.v[v]:.6g} to {after[v]:.6g}"
                f", as {keep.format(still)}.\nTry: `reinit({name(v)}, pre({name(v)}))` beside it if `{name(v)}` is to "
                "keep its value, or make it a state (stateSelect='default' of the spring or damper)."
            )

    def _may_follow(self, ids: Any) -> Any:
        """States that may jump with these variables: velocities with velocities, while positions stay."""
        level = levels(self.problem.lowered)
        return level[self.problem.lowered.schedule.states] <= level[ids].max()

    def _ends(self, point: Point) -> str | None:
        for piece, message in self.hybrid.ends:
            if piece.values(point)[0].any():
                return message
        return None

    def _check(self, point: Point) -> None:
        """Assertions that switch at events.

        Raises:
            SimulationError: one of level ``error`` does not hold.
        """
        for k, item in enumerate(self.hybrid.asserts):
            bad = np.flatnonzero(item.piece.values(point)[0] == 0.0) if item.switches else np.zeros(0, np.int64)
            if not len(bad):
                continue
            text = item.text(point.t, int(bad[0]))
            if item.level == "error":
                raise SimulationError(text)
            if (k, int(bad[0])) not in self.warned:
                self.warned.add((k, int(bad[0])))
                tell(text)

    # ---- samples ----------------------------------------------------------------------------------
    def schedule(self, t0: float, p: Floats) -> None:
        """Note when samples are due."""
        self.clocks = []
        for piece in self.hybrid.samples:
            starts, intervals = piece.values(Point(t0, np.zeros(0), p))
            for slot, start, interval in zip(piece.slots.tolist(), starts, intervals, strict=True):
                if not interval > 0.0:
                    name = self.hybrid.text(slot)
                    raise SimulationError(f"{name}: the interval is {interval:g} s and must be positive")
                self.clocks.append(Clock(float(start), float(interval), slot))

    def next_sample(self, t: float) -> float:
        """Time of the next samples behind t."""
        return min((clock.time(clock.passed(t)) for clock in self.clocks), default=np.inf)

    def samples(self, since: float, t: float) -> list[int]:
        """Slots of the samples that have become due behind `since`, until t.

        An event that comes before a sample by rounding takes it along: behind the event it counts as passed.
        """
        return [clock.slot for clock in self._due(since, t)]

    def moment(self, since: float, t: float) -> float:
        """Time of these samples, which an event at t may be before by rounding.

        That is the time of all that happens with them: what else switches at the sample, which is hit exactly, may not
        have switched yet at t.
        """
        return max([t, *(clock.time(clock.passed(t) - 1.0) for clock in self._due(since, t))])

    def _due(self, since: float, t: float) -> list[Clock]:
        return [clock for clock in self.clocks if clock.passed(t) > clock.passed(since)]

    # ---- start ------------------------------------------------------------------------------------
    def _guess_modes(self, t0: float, p: Floats, starts: Floats) -> None:
        """Put the modes that hold at the start values into p, where those say so; where not, 0 is the guess.

        Where several modes are consistent, as in what switches by positive feedback, start values choose one of them.
        """
        guess = Point(t0, self.problem.start_sign * starts[self.problem.start_source], p)
        for following in (False, True):
            for piece, _ in self.hybrid.conditions(following=following):
                p[piece.slots] = np.where(piece.values(guess)[0] < 0.0, 1.0, 0.0)

    def start(
        self, t0: float, p: Floats, starts: Floats, solve: Callable[[Floats], tuple[Floats, Floats]]
    ) -> tuple[Outcome, Floats]:
        """Slots and a consistent start, and the residuals left.

        Args:
            t0: start time [s].
            p: parameters, with room for the slots (n_p,).
            starts: start values of all declared variables (nan where none is given).
            solve: consistent z for given parameters and slots, with the residuals left.
        """
        hybrid, problem = self.hybrid, self.problem
        slots = hybrid.flat.slots
        p[hybrid.slots] = 0.0
        if slots.initial >= 0:
            p[slots.initial] = 1.0
        for piece, ids, signs in left_starts(hybrid):
            p[piece.slots] = signs * problem.start_sign[ids] * np.nan_to_num(starts[problem.start_source[ids]])
        self._guess_modes(t0, p, starts)
        self.schedule(t0, p)
        due = [clock.slot for clock in self.clocks if clock.is_due(t0)]
        self.rounding = ROUNDING
        z, left, values = self._first_modes(t0, p, solve)
        self.rounding = 0.0
        point = Point(t0, values, p)
        if slots.initial >= 0:  # assertions on the start itself
            self._check(point)
        self.moves = []
        self.before = self._conditions(point)
        seen = self._active(p)
        ended = self._ends(point) if seen else None
        z, begun = self._reinitialized(t0, z, p, point)
        self._put_lefts(p, begun)
        for piece in hybrid.triggers:
            p[piece.slots] = 0.0
        if slots.initial >= 0:
            p[slots.initial] = 0.0
        outcome = self._iterate(t0, z, p)
        if due:
            earlier = self.moves
            again = self.event(t0, outcome.z, outcome.p, samples=due)
            again.changed = [*seen, *outcome.changed, *again.changed]
            outcome, self.moves = again, [*earlier, *self.moves]
        if ended and not outcome.ended:  # what ends a run at its start is the event it has
            outcome.ended, outcome.changed = ended, list(dict.fromkeys([*seen, *outcome.changed]))
        return outcome, left

    def _first_modes(self, t0: float, p: Floats, solve: Callable[[Floats], tuple[Floats, Floats]]) -> Any:
        """Slots that agree with the consistent start, put into p; the start, the residuals left, and all values.

        The start is solved for anew with each change of the slots. Where that goes round in a circle, it goes on from
        the modes that are found as at any other event.
        """
        z, changed = np.zeros(0), list[int]()
        for searched in (False, True):
            tried: dict[bytes, None] = {}
            for _turn in range(TURNS):
                z, left = solve(p)
                values = self.equations.values(t0, z, p)
                point, old = Point(t0, values, p), p[self.hybrid.slots].tobytes()
                changed = self._modes(point, p) + self._following(point, p) + self._initial_triggers(point, p)
                again = p[self.hybrid.slots].tobytes() in tried
                if not changed or (again and self._by_rounding(point, changed)):
                    return z, left, values
                tried[old] = None
                if again:
                    break
            if not searched:
                self._consistent(t0, z, p)
        raise SimulationError(
            f"At the start the conditions and the equations contradict each other:\n{self._names(changed)}"
        )

    def _initial_triggers(self, point: Point, p: Floats) -> list[int]:
        """Triggers that `initial()` pulls: conditions that hold with it and would not without."""
        slot = self.hybrid.flat.slots.initial
        if slot < 0:
            return []
        now = self._conditions(point)
        without = p.copy()
        without[slot] = 0.0
        rest = self._conditions(Point(point.t, point.v, without))
        changed: list[int] = []
        for piece, a, b in zip(self.hybrid.triggers, now, rest, strict=True):
            changed += self._put(p, piece.slots, (a & ~b).any(axis=0).astype(float))
        return changed


def left_starts(hybrid: Hybrid) -> list[tuple[Piece, Any, Any]]:
    """Left limits of variables, which begin with start values: the piece, reduced variables, and signs."""
    found: list[tuple[Piece, Any, Any]] = []
    for piece in hybrid.pres:
        form = piece.forms[0]
        leaf = form.args[0] if form.op == "neg" else form
        if leaf.op == "var":
            signs = np.full(piece.rows.size, -1.0 if form.op == "neg" else 1.0)
            found.append((piece, piece.rows.var_rows[:, leaf.value], signs))
    return found
