"""The slots and actions of a hybrid model over the reduced variables, and their values at one point."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

import numpy as np

from ..language.declarations import Kind
from ..language.flat_model import Bools, Family, FlatModel
from ..language.places import PACKAGE, users_field
from ..language.template import Floats, Ints
from ..passes.impulses import jumping, terms_and_slopes
from ..passes.reinits import states_by_choice
from ..passes.schedule import Group, Schedule
from ..passes.specialize import specialize
from ..symbolic.expr import ONE, Expr, add, neg
from ..symbolic.straight import Straight, straight
from ..symbolic.traverse import leaves, postorder

Values = Floats


@dataclass(frozen=True, eq=False)
class Piece:
    """Expressions over the rows of a family.

    Attributes:
        forms: the expressions.
        rows: where their variables and parameters are.
        slots: what they determine, one number a row (of an action: nothing).
        order: all nodes below the expressions, operands first.
    """

    forms: tuple[Expr, ...]
    rows: Family
    slots: Ints
    order: list[Expr] = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "order", postorder(self.forms))

    @cached_property
    def program(self) -> tuple[Straight, list[Ints], list[Ints]]:
        """The expressions as a function, and the rows of its variables and parameters by column."""
        rows = self.rows
        columns = [list(np.ascontiguousarray(table.T)) for table in (rows.var_rows, rows.par_rows)]
        return straight(self.order, self.forms), columns[0], columns[1]

    def values(self, point: Point) -> list[Any]:
        """Values of all forms at a point, each (n,)."""
        n = self.rows.size
        found: list[Any] = []
        for v in point.evaluate(self):
            v = np.asarray(v, float)
            found.append(v if v.shape == (n,) else np.broadcast_to(v, (n,)))
        return found


@dataclass(frozen=True, slots=True, eq=False)
class Roots:
    """Functions whose change of sign is an event.

    Attributes:
        families: of the functions g, over the reduced variables.
        slots: (n,) mode of each, or -1 where g < 0 must hold until the next event.
        strict: (n,) whether the condition is g < 0 and not g <= 0.
        pieces: (n,) number of the family of `FlatModel.slots.pieces`, and the row in it, for messages.
    """

    families: list[Family]
    slots: Ints
    strict: Bools

    @property
    def count(self) -> int:
        """Number of functions."""
        return len(self.slots)


@dataclass(frozen=True, slots=True, eq=False)
class Reinits:
    """States that get new values: forms are (trigger, value); `targets` and `signs` say whose."""

    piece: Piece
    targets: Ints
    signs: Ints


@dataclass(frozen=True, slots=True, eq=False)
class Assertion:
    """A condition that must hold.

    Attributes:
        flat: the model.
        piece: the condition.
        message: what to say where it does not hold.
        level: ``error`` or ``warning``.
        switches: whether its condition switches at events; otherwise it is evaluated where values are known.
        at_start: it is to hold at the start alone.
    """

    flat: FlatModel
    piece: Piece
    message: str
    level: str
    switches: bool
    at_start: bool

    def text(self, t: float, row: int) -> str:
        """What to say if one row does not hold at time t [s]."""
        component, place = self.flat.equation_place(self.piece.rows, row)
        who = component or self.flat.model_name
        field = users_field(self.flat.root, component) if component and place.startswith(PACKAGE) else ""
        written = f"\nWritten in:\n    {field}" if field else ""
        return f"At t = {t:.9g} s the assertion of {who} ({place}) does not hold: {self.message}{written}"


@dataclass(frozen=True, slots=True, eq=False)
class Jump:
    """Equations that have been differentiated and hold what changes at events: `n_terms` forms are their terms."""

    piece: Piece
    n_terms: int

    def size(self, point: Point, nominal: Floats) -> tuple[Floats, Floats]:
        """How far each equation is from holding at a point, and how large that may be called: both (n,)."""
        values = self.piece.values(point)
        terms, slopes = values[: self.n_terms], values[self.n_terms :]
        typical = [np.abs(s) * nominal[v] for s, v in zip(slopes, self.piece.rows.var_rows.T, strict=True)]
        return np.abs(sum(terms)), sum(map(np.abs, terms)) + np.max(typical, axis=0, initial=0.0)


@dataclass(eq=False)
class Hybrid:
    """How the slots of a model are determined, and what happens at its events.

    Attributes:
        flat: the model, for names.
        first: number of the first slot among the parameters.
        jumps: differentiated equations that may jump: terms and slopes of their residuals, and their row numbers.
        closures: groups of the schedule that something needs, by what that is; filled when they are first asked for.
        kept, followers: states that keep their values at a `reinit` by choice, and what may jump for it
            (`states_by_choice`).
    """

    flat: FlatModel
    first: int
    relations: list[Piece]
    strict: list[bool]
    floors: list[Piece]
    pres: list[Piece]
    triggers: list[Piece]
    samples: list[Piece]
    reinits: list[Reinits]
    asserts: list[Assertion]
    ends: list[tuple[Piece, str]]
    roots: Roots
    jumps: list[Jump]
    texts: dict[int, str] = field(default_factory=dict[int, str])
    closures: dict[str, list[Group]] = field(default_factory=dict[str, list[Group]])
    kept: Ints = field(default_factory=lambda: np.zeros(0, np.int64))
    followers: Ints = field(default_factory=lambda: np.zeros(0, np.int64))

    @property
    def eventful(self) -> bool:
        """Whether there is more than assertions without events."""
        return bool(self.flat.slots.count or self.reinits or self.ends)

    @property
    def only_modes(self) -> bool:
        """Whether nothing can happen at an event but that conditions on what moves switch their modes."""
        asserts = [item for item in self.asserts if item.switches]
        others = self.floors, self.pres, self.triggers, self.samples, self.reinits, asserts, self.ends, self.jumps
        return self.roots.count > 0 and not any(others) and not any(self.following)

    @property
    def slots(self) -> slice:
        """Where the slots are among the parameters."""
        return slice(self.first, self.first + self.flat.slots.count)

    @staticmethod
    def steps(piece: Piece, point: Point) -> Floats:
        """Values of the slots of one of `floors`: the integer above."""
        return np.floor(piece.values(point)[0]) + 1.0

    def moves(self, ids: Ints) -> Bools:
        """Which of these variables move between events."""
        kinds = self.flat.kind
        return np.where(ids < len(kinds), kinds[np.minimum(ids, len(kinds) - 1)] != Kind.DISCRETE, True)

    @cached_property
    def moving_roots(self) -> list[Bools]:
        """Which of the variables in each function whose change of sign is an event move between events."""
        return [self.moves(family.var_rows) for family in self.roots.families]

    @cached_property
    def moving_lefts(self) -> list[bool]:
        """For each of `pres` whether what it is the left limit of moves between events."""
        return [bool(self.moves(piece.rows.var_rows).any()) for piece in self.pres]

    @cached_property
    def following(self) -> list[bool]:
        """For each of `relations` whether it depends on discrete quantities only: it changes with those and not by
        itself."""
        return [self._follows(piece) for piece in self.relations]

    @cached_property
    def only_triggers(self) -> frozenset[int]:
        """Slots of conditions that stand nowhere but in the conditions of `when`: that one is no longer true changes
        nothing."""
        flat = self.flat
        others = [*flat.families, *flat.initial, *flat.actions]
        read = [family.par_rows for family in others]
        for piece in flat.slots.pieces:
            own = piece.residual.args[0].value
            if piece.residual.op != "triggered":
                read.append(np.delete(piece.par_rows, own, axis=1))
        used = np.unique(np.concatenate([np.zeros(0, np.int64), *(rows.ravel() for rows in read)]))
        relations = np.concatenate([np.zeros(0, np.int64), *(piece.slots for piece in self.relations)])
        return frozenset(np.setdiff1d(relations, used).tolist())

    @cached_property
    def moving_conditions(self) -> tuple[list[Piece], Ints, Bools]:
        """The relations that do not follow discrete quantities; of their rows the slots, and whether each is strict."""
        found = list(self.conditions(following=False))
        pieces = [piece for piece, _ in found]
        slots = np.concatenate([np.zeros(0, np.int64), *(piece.slots for piece in pieces)])
        strict = np.concatenate([np.zeros(0, bool), *(np.full(piece.rows.size, s) for piece, s in found)])
        return pieces, slots, strict

    def conditions(self, *, following: bool) -> Iterator[tuple[Piece, bool]]:
        """The relations that follow discrete quantities, or the others; and whether each is strict."""
        for piece, strict, follows in zip(self.relations, self.strict, self.following, strict=True):
            if follows == following:
                yield piece, strict

    def _follows(self, piece: Piece) -> bool:
        ids = piece.rows.var_rows
        timed = any(leaf.op == "time" for leaf in leaves(*piece.forms))
        return bool(ids.shape[1]) and not timed and not self.moves(ids).any()

    @cached_property
    def root_pieces(self) -> list[Piece]:
        """The functions whose change of sign is an event."""
        none = np.zeros(0, np.int64)
        return [Piece((family.residual,), family, none) for family in self.roots.families]

    def text(self, slot: int) -> str:
        """What a slot is about, with component and source line."""
        if slot not in self.texts:
            self.texts[slot] = self._text(slot)
        return self.texts[slot]

    def _text(self, slot: int) -> str:
        flat = self.flat
        for family in flat.slots.pieces:
            rows = np.flatnonzero(family.par_rows[:, family.residual.args[0].value] == slot)
            if len(rows):
                component, place = flat.equation_place(family, int(rows[0]))
                where = f"{component}, " if component else ""
                return f"`{flat.piece_text(family, int(rows[0]))}` ({where}{place})"
        return f"`{flat.slot_text(slot)}`"


class Point:
    """Values at one time, for evaluating pieces."""

    def __init__(self, t: float, values: Floats, p: Floats) -> None:
        self.t, self.v, self.p = np.float64(t), values, p  # one that may divide

    def evaluate(self, piece: Piece) -> list[Any]:
        """Values of its expressions, each a number or (n,)."""
        function, variables, parameters = piece.program
        with np.errstate(all="ignore"):
            return function(self.t, self.v, self.p, variables, parameters)


def make_hybrid(flat: FlatModel, representative: Ints, sign: Ints, schedule: Schedule) -> Hybrid | None:
    """Slots and actions over the reduced variables; None for a model without events."""
    slots = flat.slots
    if not slots.count and not flat.actions:
        return None
    groups: dict[str, list[Piece]] = {op: [] for op in ("relation", "floor", "pre", "triggered", "sample")}
    strict: list[bool] = []
    families: list[Family] = []
    root_slots: list[Ints] = []
    root_strict: list[Bools] = []
    for family in specialize(slots.pieces, representative, sign):
        form, at = family.residual, family.par_rows[:, family.residual.args[0].value]
        forms = form.args[1:]
        if form.op == "relation":
            a, b = forms if form.value in ("lt", "le") else forms[::-1]
            forms = (add(a, neg(b)),)
            strict.append(form.value in ("lt", "gt"))
            families.append(Family(forms[0], family.var_rows, family.par_rows, family.source, family.ordinal))
            root_slots.append(at)
            root_strict.append(np.full(len(at), strict[-1]))
        elif form.op == "floor":
            below, above = add(form.args[0], neg(forms[0]), neg(ONE)), add(forms[0], neg(form.args[0]))
            for g, is_strict in ((below, False), (above, True)):
                families.append(Family(g, family.var_rows, family.par_rows, family.source, family.ordinal))
                root_slots.append(np.full(len(at), -1))
                root_strict.append(np.full(len(at), is_strict))
        groups[form.op].append(Piece(forms, family, at))
    none = np.zeros(0, np.int64)
    roots = Roots(families, np.concatenate([none, *root_slots]), np.concatenate([none, *root_strict]).astype(bool))
    hybrid = Hybrid(
        flat, flat.n_par + len(flat.inputs), groups["relation"], strict, groups["floor"], groups["pre"],
        groups["triggered"], groups["sample"], [], [], [], roots, [],
    )  # fmt: skip
    for family, rows in jumping(schedule):
        forms, count = terms_and_slopes(family)
        hybrid.jumps.append(Jump(Piece(forms, family, rows), count))
    for family in specialize(flat.actions, representative, sign):
        _action(hybrid, family)
    if hybrid.reinits:
        hybrid.kept, hybrid.followers = states_by_choice(flat, schedule, representative)
    return hybrid


def _action(hybrid: Hybrid, family: Family) -> None:
    form, none = family.residual, np.zeros(0, np.int64)
    if form.op == "reinit":
        target, trigger, value = form.args
        leaf = target.args[0] if target.op == "neg" else target
        if leaf.op == "var":
            n = family.size
            signs = np.full(n, -1 if target.op == "neg" else 1)
            piece = Piece((trigger, value), family, none)
            hybrid.reinits.append(Reinits(piece, family.var_rows[:, leaf.value], signs))
    elif form.op == "assert":
        switches = bool((family.par_rows >= hybrid.first).any())
        message, level, at_start = form.value
        piece = Piece(form.args, family, none)
        hybrid.asserts.append(Assertion(hybrid.flat, piece, message, level, switches, at_start))
    else:
        hybrid.ends.append((Piece(form.args, family, none), form.value))
