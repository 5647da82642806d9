"""What happens at an event: modes, triggers, left limits and states until nothing changes any more.

Everything is solved together by the model's own equations, in which modes, left limits and triggers are numbers; this
iteration finds these numbers. Modelica Language Specification 3.6, 8.6 and Appendix B.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any, Protocol

import numpy as np

from acausal.errors import SimulationError
from acausal.lowering.hybrid import Hybrid, Piece, Point
from acausal.lowering.initial import EASE_ALGEBRAIC, InitialProblem
from acausal.lowering.initial_numeric import conditions_of, gauss_newton_part
from acausal.lowering.levels import levels

from .native_library import Floats

TURNS = 200
"""Most solutions of one event."""
ROUNDING = 1e-13
"""Values of a condition this small, relative to the quantities in it, are rounding."""
NOISE = 1e-9
"""A condition that switches back and forth and is no further from its switch than this, relative to the quantities in
it, is there by rounding."""
MOST_SEARCHED = 10
"""Conditions of which all combinations are tried."""


class Equations(Protocol):
    """The equations of a system with numbers, as an engine evaluates them."""

    def feed(self, t: float, p: Floats) -> None:
        """Put the inputs at time t into p."""
        ...

    def settle(self, t: float, z: Floats, p: Floats) -> Floats | None:
        """z with the algebraic unknowns solved for; None if that fails."""
        ...

    def values(self, t: float, z: Floats, p: Floats) -> Floats:
        """All reduced variables (n_ids,)."""
        ...


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


class EventIteration:
    """Carries out events.

    Args:
        hybrid: what there is.
        problem: initialization of the system, for reinitialized states that depend on each other.
        equations: how an engine evaluates the system.
        warn: called with the message of an assertion of level ``warning``.
    """

    def __init__(
        self, hybrid: Hybrid, problem: InitialProblem, equations: Equations, warn: Callable[[str], None]
    ) -> None:
        self.hybrid, self.problem, self.equations, self.warn = hybrid, problem, equations, warn
        self.before: list[Any] = [np.zeros((len(t.forms), t.rows.size), bool) for t in hybrid.triggers]
        self.warned: set[str] = set()
        self.due: list[tuple[float, float, int]] = []
        self.moves: list[Move] = []
        self.forced: list[int] = []
        self.noise: Floats = np.zeros(hybrid.roots.count)
        self.largest: Floats = np.zeros(hybrid.flat.slots.count)

    # ---- pieces -----------------------------------------------------------------------------------
    def _conditions(self, point: Point) -> list[Any]:
        return [np.array([v != 0.0 for v in t.values(point)]) for t in self.hybrid.triggers]

    def _modes(self, point: Point, p: Floats) -> list[int]:
        """Put the modes that follow from values that move into p; the slots that change."""
        changed: list[int] = []
        for piece, strict in self.hybrid.conditions(following=False):
            g = piece.values(point)[0]
            new = ((g < 0.0) if strict else (g <= 0.0)).astype(float)
            if self.forced:  # what was found to switch may still be on its old side by rounding
                stays = _among(piece.slots, self.forced)
                if stays.any():
                    stays &= np.abs(g) <= NOISE * self._scale(piece, point)
                    new[stays] = p[piece.slots[stays]]
            changed += self._put(p, piece.slots, new)
        for piece in self.hybrid.floors:
            changed += self._put(p, piece.slots, np.floor(piece.values(point)[0]))
        return changed

    def _following(self, point: Point, p: Floats) -> list[int]:
        """Put the modes of conditions on discrete quantities into p; the slots that change."""
        changed: list[int] = []
        for piece, strict in self.hybrid.conditions(following=True):
            g = piece.values(point)[0]
            changed += self._put(p, piece.slots, ((g < 0.0) if strict else (g <= 0.0)).astype(float))
        return changed

    @staticmethod
    def _put(p: Floats, slots: Any, new: Any) -> list[int]:
        different = p[slots] != new
        p[slots] = new
        return slots[different].tolist()

    def _put_lefts(self, p: Floats, point: Point) -> list[int]:
        """Put left limits into p; the slots that change, those of continuous quantities by more than rounding."""
        changed: list[int] = []
        for piece, moves in zip(self.hybrid.pres, self.hybrid.moving_lefts, strict=True):
            left, old = piece.values(point)[0], p[piece.slots]
            same = (old == left) | (np.isnan(old) & np.isnan(left))
            if moves:
                same |= np.abs(left - old) <= NOISE * self._scale(piece, point)
            changed += piece.slots[~same].tolist()
            p[piece.slots] = left
        return changed

    def _triggers(self, p: Floats, now: list[Any]) -> list[int]:
        changed: list[int] = []
        for piece, condition, before in zip(self.hybrid.triggers, now, self.before, strict=True):
            new = (condition & ~before).any(axis=0).astype(float)
            changed += self._put(p, piece.slots, new)
        return changed

    def _active(self, p: Floats) -> list[int]:
        return [s for t in self.hybrid.triggers for s in t.slots[p[t.slots] != 0.0].tolist()]

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
            self._sample(outcome.p, samples, 0.0)
            point = Point(t, outcome.values, outcome.p)
            self.before = self._conditions(point)
        outcome.changed = [*changed, *(samples or []), *outcome.changed]
        return outcome

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
                changed += self._put(p, piece.slots, np.floor(piece.values(left)[0]))
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
            z = self._reinitialized(t, z, p, point)
            moved = self._put_lefts(p, point)
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

    def _consistent(self, t: float, z: Floats, p: Floats) -> tuple[Floats, Floats]:
        """Modes and triggers that agree with the solution of the equations."""
        before, involved = p[self.hybrid.slots].copy(), dict[int, None]()
        found = self._by_turns(t, z, p, involved, one_by_one=False)
        found = found or self._by_turns(t, z, p, involved, one_by_one=True)
        found = found or self._by_search(t, z, p, before, list(involved))
        if found is not None:
            return found
        raise SimulationError(
            f"At t = {t:.12g} s no values of these conditions agree with the equations (each contradicts itself):\n"
            f"{self._names(list(involved))}\nThe model has no solution there, or several states of a switch depend on "
            "each other: give the components a smooth or resistive characteristic."
        )

    def _by_turns(
        self, t: float, z: Floats, p: Floats, involved: dict[int, None], *, one_by_one: bool
    ) -> tuple[Floats, Floats] | None:
        """Modes changed as the solution says, again and again; None if that goes round in a circle.

        One by one is Murty's least-index rule, which does not cycle where the characteristics are monotone: Murty
        (1974), Note on a Bard-type scheme for solving the complementarity problem, Opsearch 11.
        """
        held = self.hybrid.slots
        kinds = self.hybrid.flat.slots.kinds
        tried: dict[bytes, None] = {}
        for _ in range(TURNS):
            z, values, restless = self._propagated(t, z, p)
            point, old = Point(t, values, p.copy()), p[held].copy()
            changed = self._modes(point, p)
            if not changed and not restless:
                return z, values
            involved.update(dict.fromkeys([*changed, *restless]))
            if old.tobytes() in tried:
                by_rounding = not restless and self._by_rounding(point, changed)
                p[held] = old
                return (z, values) if by_rounding else None
            tried[old.tobytes()] = None
            if one_by_one and len(changed) > 1:
                p[held] = old
                first = min(changed)
                p[first] = 1.0 - p[first] if kinds[first - self.hybrid.first] == "relation" else p[first]
        return None

    def _by_search(
        self, t: float, z: Floats, p: Floats, before: Floats, involved: list[int]
    ) -> tuple[Floats, Floats] | None:
        """The modes nearest to those before that agree, of all combinations of the conditions that have changed or that
        feel it when these do."""
        held, kinds = self.hybrid.slots, self.hybrid.flat.slots.kinds
        slots = [s for s in involved if kinds[s - self.hybrid.first] == "relation"]
        slots = list(dict.fromkeys([*slots, *self._feeling(t, z, p, before, slots)]))[:MOST_SEARCHED]
        for n in range(len(slots) + 1):
            for flipped in combinations(slots, n):
                p[held] = before
                p[list(flipped)] = 1.0 - p[list(flipped)]
                try:
                    found, values, restless = self._propagated(t, z, p)
                except SimulationError:  # these modes have no solution
                    continue
                if not restless and not self._modes(Point(t, values, p), p):
                    return found, values
        p[held] = before
        return None

    def _feeling(self, t: float, z: Floats, p: Floats, before: Floats, slots: list[int]) -> list[int]:
        """Conditions whose functions have other values when one of these modes is another."""
        found: list[int] = []
        values: list[Any] = []
        for flipped in [[], *([s] for s in slots)]:
            p[self.hybrid.slots] = before
            p[flipped] = 1.0 - p[flipped]
            try:
                point = Point(t, self._propagated(t, z, p)[1], p)
            except SimulationError:  # these modes have no solution
                continue
            values.append([piece.values(point)[0] for piece in self.hybrid.relations])
        for k, piece in enumerate(self.hybrid.relations):
            size = np.array([v[k] for v in values])
            moved = np.ptp(size, axis=0) > NOISE * np.abs(size).max(axis=0)
            if not self.hybrid.following[k]:
                found += piece.slots[moved].tolist()
        return found

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
                "switches side by side: give one of them some resistance or elasticity, or remove one."
            )

    def _propagated(self, t: float, z: Floats, p: Floats) -> tuple[Floats, Floats, list[int]]:
        """Solution and values with all that follows from discrete quantities; the slots that do not come to rest.

        A condition on a discrete variable is no choice of its own: it follows from the conditions that determine the
        variable, so the search for modes that agree is one over the conditions on what moves.
        """
        tried: dict[bytes, None] = {}
        while True:
            z = self._settled(t, z, p)
            values = self.equations.values(t, z, p)
            tried[p[self.hybrid.slots].tobytes()] = None
            changed = self._following(Point(t, values, p), p)
            changed += self._triggers(p, self._conditions(Point(t, values, p)))
            if not changed or p[self.hybrid.slots].tobytes() in tried:
                return z, values, changed

    def _by_rounding(self, point: Point, changed: list[int]) -> bool:
        """Whether all conditions that changed are at their switch but for rounding."""
        for piece in self.hybrid.relations:
            rows = np.isin(piece.slots, changed)
            if rows.any():
                g = np.abs(piece.values(point)[0][rows])
                scale = self._scale(piece, point)[rows]
                if not (g <= NOISE * scale).all():
                    return False
        kinds = self.hybrid.flat.slots.kinds
        return all(kinds[s - self.hybrid.first] == "relation" for s in changed)

    def _scale(self, piece: Piece, point: Point) -> Any:
        """Size of what is in a condition, or of its function at earlier events."""
        ids, earlier = piece.rows.var_rows, self.largest[piece.slots - self.hybrid.first]
        if not ids.shape[1]:
            return np.maximum(earlier, 1.0)
        now = np.maximum(np.abs(point.v[ids]), self.problem.lowered.nominal[ids]).max(axis=1)
        return np.maximum(earlier, now)

    def _note_sizes(self, point: Point) -> None:
        for piece in self.hybrid.relations:
            places, g = piece.slots - self.hybrid.first, np.abs(piece.values(point)[0])
            self.largest[places] = np.maximum(self.largest[places], np.where(np.isfinite(g), g, 0.0))

    @property
    def largest_of_roots(self) -> Floats:
        """Largest values of the conditions at the events so far (n_roots,), where each root is that of a condition."""
        return self.largest[self.hybrid.roots.slots - self.hybrid.first]

    def note_largest(self, values: Floats) -> None:
        """Take over values as `largest_of_roots` gives them."""
        self.largest[self.hybrid.roots.slots - self.hybrid.first] = values

    def _settled(self, t: float, z: Floats, p: Floats) -> Floats:
        found = self.equations.settle(t, z, p)
        if found is None:
            found = self._moved(t, z, p, np.zeros(0, np.int64), np.zeros(0), np.zeros(self.problem.lowered.n_x, bool))
        return found

    def _rounding(self, values: Floats) -> None:
        """What of each root function is rounding: nothing where it depends on time and discrete variables only."""
        parts: list[Any] = [np.zeros(0)]
        nominal = self.problem.lowered.nominal
        size = np.fmax(np.abs(values), nominal[: len(values)])
        for family, moves in zip(self.hybrid.roots.families, self.hybrid.moving_roots, strict=True):
            parts.append(ROUNDING * (size[family.var_rows] * moves).max(axis=1, initial=0.0))
        self.noise = np.concatenate(parts)

    # ---- actions ----------------------------------------------------------------------------------
    def _reinitialized(self, t: float, z: Floats, p: Floats, point: Point) -> Floats:
        """States with the values that `reinit` gives; those that depend on them follow by the least change."""
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
            return z
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
        return z

    def _may_follow(self, ids: Any) -> Any:
        """States that may jump with these variables: velocities with velocities, while positions stay."""
        level = levels(self.problem.lowered)
        return level[self.problem.lowered.schedule.states] <= level[ids].max()

    def _moved(self, t: float, z: Floats, p: Floats, ids: Any, wanted: Any, free: Any) -> Floats:
        """Consistent values near z with variables `ids` at the wanted values."""
        low = self.problem.lowered
        problem = replace(self.problem, families=[], targets=ids)
        made = conditions_of(problem, t, p, ids, wanted)
        if made is None:
            raise SimulationError(f"At t = {t:.12g} s the system is too large to be made consistent after an event.")
        columns = np.concatenate([np.flatnonzero(free), low.n_x + np.arange(low.n_w)])
        nominal = np.concatenate([low.x_nominal, low.w_nominal])
        ease = np.concatenate([low.x_nominal, EASE_ALGEBRAIC * low.w_nominal])
        found, left = gauss_newton_part(made[0], z, nominal, ease, columns)
        if not np.isfinite(left).all() or np.max(left, initial=0.0) > 1e-6:
            raise SimulationError(
                f"At t = {t:.12g} s the equations have no solution near the values before the event.\n"
                + self._names(self._active(p))
            )
        return found

    def _ends(self, point: Point) -> str | None:
        for piece, message in self.hybrid.ends:
            if piece.values(point)[0].any():
                return message
        return None

    def _check(self, point: Point) -> None:
        """Assertions.

        Raises:
            SimulationError: one of level ``error`` does not hold.
        """
        flat = self.hybrid.flat
        for piece, message, level in self.hybrid.asserts:
            bad = np.flatnonzero(piece.values(point)[0] == 0.0)
            if not len(bad):
                continue
            component, place = flat.equation_place(piece.rows, int(bad[0]))
            who = component or flat.model_name
            text = f"At t = {point.t:.9g} s the assertion of {who} ({place}) does not hold: {message}"
            if level == "error":
                raise SimulationError(text)
            if place + component not in self.warned:
                self.warned.add(place + component)
                self.warn(text)

    def check(self, t: float, z: Floats, p: Floats) -> None:
        """Assertions at a point of a run."""
        if self.hybrid.asserts:
            self._check(Point(t, self.equations.values(t, z, p), p))

    def _names(self, slots: list[int]) -> str:
        wanted = [s for s in dict.fromkeys(slots) if s not in (self.hybrid.flat.slots.initial,)]
        return "\n".join(f"    {self.hybrid.text(s)}" for s in wanted[:8])

    # ---- samples ----------------------------------------------------------------------------------
    def schedule(self, t0: float, p: Floats) -> None:
        """Note when samples are due."""
        self.due = []
        for piece in self.hybrid.samples:
            starts, intervals = piece.values(Point(t0, np.zeros(0), p))
            for slot, start, interval in zip(piece.slots.tolist(), starts, intervals, strict=True):
                if not interval > 0.0:
                    name = self.hybrid.text(slot)
                    raise SimulationError(f"{name}: the interval is {interval:g} s and must be positive")
                self.due.append((float(start), float(interval), slot))

    def next_sample(self, t: float, *, at: bool = False) -> tuple[float, list[int]]:
        """Time of the next samples behind t (or at it), and their slots."""
        best, slots = np.inf, list[int]()
        for start, interval, slot in self.due:
            k = np.ceil((t - start) / interval - 1e-9)
            k = max(k if at else np.floor((t - start) / interval + 1e-9) + 1.0, 0.0)
            time = start + k * interval
            if time < best - 1e-12 * interval:
                best, slots = time, [slot]
            elif time <= best + 1e-12 * interval:
                slots.append(slot)
        return best, slots

    # ---- start ------------------------------------------------------------------------------------
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
        self.schedule(t0, p)
        _, due = self.next_sample(t0, at=True)
        due = due if abs(_ - t0) <= 1e-9 * max(1.0, abs(t0)) else []
        tried: dict[bytes, None] = {}
        changed: list[int] = []
        for _turn in range(TURNS):
            z, left = solve(p)
            values = self.equations.values(t0, z, p)
            old = p[hybrid.slots].tobytes()
            changed = self._modes(Point(t0, values, p), p) + self._following(Point(t0, values, p), p)
            changed += self._initial_triggers(Point(t0, values, p), p)
            if not changed or (p[hybrid.slots].tobytes() in tried and self._by_rounding(Point(t0, values, p), changed)):
                break
            tried[old] = None
        else:
            raise SimulationError(
                f"At the start the conditions and the equations contradict each other:\n{self._names(changed)}"
            )
        point = Point(t0, values, p)
        self.moves = []
        seen = self._active(p)
        ended = self._ends(point) if seen else None
        z = self._reinitialized(t0, z, p, point)
        self._put_lefts(p, point)
        for piece in hybrid.triggers:
            p[piece.slots] = 0.0
        if slots.initial >= 0:
            p[slots.initial] = 0.0
        self.before = self._conditions(Point(t0, values, p))
        outcome = self._iterate(t0, z, p)
        if due:
            earlier = self.moves
            again = self.event(t0, outcome.z, outcome.p, samples=due)
            again.changed = [*seen, *outcome.changed, *again.changed]
            outcome, self.moves = again, [*earlier, *self.moves]
        outcome.ended = outcome.ended or ended
        return outcome, left

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


def _among(slots: Any, some: list[int]) -> Any:
    """Mask of the slots that are among some, of which there are mostly few."""
    if len(some) > 8:
        return np.isin(slots, some)
    mask = np.zeros(len(slots), bool)
    for slot in some:
        mask |= slots == slot
    return mask


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
