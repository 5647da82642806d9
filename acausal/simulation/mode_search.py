"""Modes and triggers that agree with the solution of the equations.

A mode says whether a condition holds; the equations are solved with it as a number, and the solution says what it
should be.
"""

from __future__ import annotations

from dataclasses import replace
from itertools import combinations
from typing import Any, Protocol

import numpy as np

from acausal.errors import SimulationError
from acausal.lowering.conditions import Conditions
from acausal.lowering.hybrid import Hybrid, Piece, Point
from acausal.lowering.initial import ACCEPTED, EASE_ALGEBRAIC, InitialProblem
from acausal.lowering.initial_numeric import gauss_newton_part
from acausal.report import conditions_in_words

from .native_library import Floats

TURNS = 200
"""Most solutions of one event."""
NOISE = 1e-9
"""A condition that switches back and forth and is no further from its switch than this, relative to the quantities in
it, is there by rounding."""
SHOWN = 8
"""Conditions that a message names."""
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


class ModeSearch:
    """Finds modes and triggers at one time.

    Args:
        hybrid: what there is.
        problem: initialization of the system, for unknowns that Newton's method does not find.
        equations: how an engine evaluates the system.
    """

    def __init__(self, hybrid: Hybrid, problem: InitialProblem, equations: Equations) -> None:
        self.hybrid, self.problem, self.equations = hybrid, problem, equations
        self.before: list[Any] = [np.zeros((len(t.forms), t.rows.size), bool) for t in hybrid.triggers]
        self.forced: list[int] = []
        self.rounding = 0.0  # of conditions, at the start: what is zero by its equations has no sign, whatever is left
        self.largest: Floats = np.zeros(hybrid.flat.slots.count)

    def _conditions(self, point: Point) -> list[Any]:
        return [np.array([v != 0.0 for v in t.values(point)]) for t in self.hybrid.triggers]

    def _modes(self, point: Point, p: Floats) -> list[int]:
        """Put the modes that follow from values that move into p; the slots that change."""
        pieces, slots, strict = self.hybrid.moving_conditions
        changed: list[int] = []
        if pieces:
            g = np.concatenate([piece.values(point)[0] for piece in pieces])
            if self.rounding:
                g[np.abs(g) <= self.rounding * self._scales(pieces, point)] = 0.0
            new = np.where(strict, g < 0.0, g <= 0.0).astype(float)
            stays = _among(slots, self.forced) & (new != p[slots])
            if stays.any():  # what was found to switch may still be on its old side by rounding
                stays &= np.abs(g) <= NOISE * self._scales(pieces, point)
                new[stays] = p[slots[stays]]
            changed += self._put(p, slots, new)
        for piece in self.hybrid.floors:
            changed += self._put(p, piece.slots, self.hybrid.steps(piece, point))
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

    def _triggers(self, p: Floats, now: list[Any]) -> list[int]:
        changed: list[int] = []
        for piece, condition, before in zip(self.hybrid.triggers, now, self.before, strict=True):
            new = (condition & ~before).any(axis=0).astype(float)
            changed += self._put(p, piece.slots, new)
        return changed

    def _active(self, p: Floats) -> list[int]:
        return [s for t in self.hybrid.triggers for s in t.slots[p[t.slots] != 0.0].tolist()]

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

    def _scales(self, pieces: list[Piece], point: Point) -> Floats:
        return np.concatenate([self._scale(piece, point) for piece in pieces])

    def _scale(self, piece: Piece, point: Point) -> Any:
        """Size of what is in a condition, or of its function at earlier events."""
        ids, earlier = piece.rows.var_rows, self.largest[piece.slots - self.hybrid.first]
        if not ids.shape[1]:
            return np.maximum(earlier, 1.0)
        now = np.maximum(np.abs(point.v[ids]), self.problem.lowered.nominal[ids]).max(axis=1)
        return np.maximum(earlier, now)

    def _settled(self, t: float, z: Floats, p: Floats) -> Floats:
        found = self.equations.settle(t, z, p)
        if found is None:
            found = self._moved(t, z, p, np.zeros(0, np.int64), np.zeros(0), np.zeros(self.problem.lowered.n_x, bool))
        return found

    def _moved(self, t: float, z: Floats, p: Floats, ids: Any, wanted: Any, free: Any) -> Floats:
        """Consistent values near z with variables `ids` at the wanted values."""
        low = self.problem.lowered
        problem = replace(self.problem, families=[], targets=ids)
        conditions = Conditions(problem, t, p, ids, wanted)
        if conditions.too_many:
            raise SimulationError(f"At t = {t:.12g} s the system is too large to be made consistent after an event.")
        columns = np.concatenate([np.flatnonzero(free), low.n_x + np.arange(low.n_w)])
        nominal = np.concatenate([low.x_nominal, low.w_nominal])
        ease = np.concatenate([low.x_nominal, EASE_ALGEBRAIC * low.w_nominal])
        found, left = gauss_newton_part(conditions, z, nominal, ease, columns)
        if not np.isfinite(left).all() or np.max(left, initial=0.0) > ACCEPTED:
            raise SimulationError(
                f"At t = {t:.12g} s the equations have no solution near the values before the event.\n"
                + "\n".join(filter(None, (self._unmet(left, ids), self._names(self._active(p)))))
            )
        return found

    def _unmet(self, left: Floats, ids: Any) -> str:
        """The conditions that are furthest from being met, one below the other."""
        texts = conditions_in_words(self.problem.lowered.schedule)
        texts += [f"the new value of `{self.hybrid.flat.name(int(v))}`" for v in ids]
        distance = np.where(np.isfinite(left), left, np.inf)
        worst = [k for k in np.argsort(-distance)[:SHOWN].tolist() if distance[k] > ACCEPTED]
        return "Not met:\n" + "\n".join(f"    {texts[k]}" for k in worst)

    def _names(self, slots: list[int]) -> str:
        wanted = [s for s in dict.fromkeys(slots) if s not in (self.hybrid.flat.slots.initial,)]
        return "\n".join(f"    {self.hybrid.text(s)}" for s in wanted[:SHOWN])


def _among(slots: Any, some: list[int]) -> Any:
    """Mask of the slots that are among some, of which there are mostly few."""
    if len(some) > 8:
        return np.isin(slots, some)
    mask = np.zeros(len(slots), bool)
    for slot in some:
        mask |= slots == slot
    return mask
