"""Events: everything that changes at events only becomes a slot behind the parameters.

A comparison in an equation is replaced by its mode, which is held between events; ``pre(x)`` by the left limit of x;
the trigger of a `when` by a number that is 1 while its actions are due. What is left are ordinary equations, smooth
between events, for all later passes. How the slots are determined is kept beside them, in families as all else.
Modelica Language Specification 3.6, 8.5 and Appendix B.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..errors import DeclarationError
from ..language.declarations import Kind
from ..language.flat_model import Family, FlatModel, Slots, canonical
from ..language.template import Ints
from ..symbolic.expr import ONE, ZERO, Expr, add, const, div, intern_node, make, mul, neg, par
from ..symbolic.traverse import leaves, postorder, rewrite_located

COMPARISONS = frozenset({"lt", "le", "gt", "ge"})
HYBRID = COMPARISONS | {
    "floor", "ceil", "mod", "sign", "pre", "noevent", "sample", "triggered", "initial", "terminal", "eq",
}  # fmt: skip
PIECE = "reinit", "assert", "terminate"


def extract_events(flat: FlatModel, *, located: bool = True) -> FlatModel:
    """`flat` with slots in the place of what changes at events only.

    Args:
        flat: the model.
        located: False leaves comparisons as they are: the solver sees what switches, and nothing is located.

    Raises:
        DeclarationError: `pre`, `sample` or an equality has a meaning for discrete quantities only.
    """
    work = _Extraction(flat, located)
    families = [work.family(f, "equation") for f in flat.families]
    initial = [work.family(f, "initial") for f in flat.initial]
    actions = [work.family(f, "action") for f in flat.actions]
    if not work.changed:
        return flat
    return flat.changed(families=families, initial=initial, actions=actions, slots=work.slots)


@dataclass(eq=False)
class _Extraction:
    """Slots found so far."""

    flat: FlatModel
    located: bool
    slots: Slots = field(default_factory=Slots)
    known: dict[Any, int] = field(default_factory=dict[Any, int])
    changed: bool = False

    def family(self, family: Family, role: str) -> Family:
        """One family rewritten."""
        if not any(node.op in HYBRID for node in postorder((family.residual,))):
            return family
        self.changed = True
        rows = _Rows(self, family, role)
        residual = rows.rewrite(family.residual)
        form, var_rows, par_rows = canonical(residual, family.var_rows, rows.par_rows())
        return Family(form, var_rows, par_rows, family.source, family.ordinal)

    @property
    def first(self) -> int:
        """Number of the first slot among the parameters."""
        return self.flat.n_par + len(self.flat.inputs)

    def single(self, kind: str) -> int:
        """The slot of `initial` or `terminal`."""
        if getattr(self.slots, kind) < 0:
            setattr(self.slots, kind, self.first + self.slots.count)
            self.slots.kinds.append(kind)
        return getattr(self.slots, kind)

    def allocate(self, form: Expr, var_rows: Ints, par_rows: Ints, source: Ints, ordinal: Ints) -> Ints:
        """Slots of the rows of an expression; equal rows share one."""
        form, var_rows, par_rows = canonical(form, var_rows, par_rows)
        table = np.ascontiguousarray(np.concatenate([var_rows, par_rows], axis=1))
        slots = np.empty(len(source), np.int64)
        new: list[int] = []
        for i in range(len(source)):
            key = form, table[i].tobytes()
            slot = self.known.get(key, -1)
            if slot < 0:
                slot = self.known[key] = self.first + self.slots.count
                self.slots.kinds.append(form.op)
                new.append(i)
            slots[i] = slot
        if new:
            pick = np.array(new)
            k = par_rows.shape[1]
            piece = intern_node(form.op, (par(k), *form.args), form.value)
            rows = np.concatenate([par_rows[pick], slots[pick, None]], axis=1)
            self.slots.pieces.append(Family(piece, var_rows[pick], rows, source[pick], ordinal[pick]))
        return slots


class _Rows:
    """Rewrites the expression of one family; further parameter columns hold the slots of its rows."""

    def __init__(self, work: _Extraction, family: Family, role: str) -> None:
        self.work = work
        self.origin = family
        self.role = role
        self.columns = [family.par_rows]
        self.count = family.par_rows.shape[1]
        self.memo: dict[tuple[int, bool], Expr] = {}
        self.in_action = role == "action" or any(n.op == "triggered" for n in postorder((family.residual,)))

    def par_rows(self) -> Ints:
        """All parameter columns."""
        return np.concatenate(self.columns, axis=1)

    def rewrite(self, root: Expr) -> Expr:
        """Bottom up; below `noevent` comparisons stay."""
        return rewrite_located(root, self._replaced, self.work.located, self.memo)

    def _replaced(self, node: Expr, args: tuple[Expr, ...], located: bool) -> Expr:
        op = node.op
        if op in ("initial", "terminal"):
            return self._column(np.full(self.origin.size, self.work.single(op)))
        if op == "noevent":
            return args[0]
        if op == "sign" and located and _moves(args):
            low = self._slot(intern_node("relation", (args[0], ZERO), "lt"))
            high = self._slot(intern_node("relation", (args[0], ZERO), "gt"))
            return make("where", (high, ONE, make("where", (low, const(-1.0), ZERO))))
        if op in COMPARISONS and located and _moves(args):
            return self._slot(intern_node("relation", args, op))
        if op in ("floor", "ceil", "mod") and located and _moves(args):
            return self._rounded(op, args)
        if op == "eq":
            self._check_equality(node)
        if op == "pre":
            self._check_pre(node)
            return args[0] if args[0].op == "const" else self._slot(intern_node("pre", args))
        if op == "sample":
            if _moves(args):
                raise DeclarationError(f"`{self._text(node)}`: start and interval are constants {self._place()}")
            return self._slot(intern_node("sample", args))
        if op == "triggered":
            return self._slot(intern_node("triggered", args))
        same = all(a is b for a, b in zip(args, node.args, strict=True))
        return node if same else intern_node(op, args, node.value) if op in PIECE else make(op, args, node.value)

    def _rounded(self, op: str, args: tuple[Expr, ...]) -> Expr:
        if op == "floor":
            return self._floor(args[0])
        if op == "ceil":
            return neg(self._floor(neg(args[0])))
        a, b = args
        return add(a, neg(mul(b, self._floor(div(a, b)))))

    def _floor(self, x: Expr) -> Expr:
        # its slot holds the integer above: what is left of x to the next step has the right sign however small it is,
        # where x + 1 is 1 already for an x just below zero
        return add(self._slot(intern_node("floor", (x,))), neg(ONE))

    def _slot(self, form: Expr) -> Expr:
        family = self.origin
        slots = self.work.allocate(form, family.var_rows, self.par_rows(), family.source, family.ordinal)
        return self._column(slots)

    def _column(self, slots: Ints) -> Expr:
        self.columns.append(slots[:, None])
        self.count += 1
        return par(self.count - 1)

    # ---- what is wrong ----------------------------------------------------------------------------
    def _check_pre(self, node: Expr) -> None:
        """Outside of `when`, `pre` is for what is discrete."""
        if self.in_action:
            return
        for leaf in self._continuous(node.args):
            raise DeclarationError(
                f"`{self._text(node)}`: `{self._text(leaf)}` is not discrete, and has a left limit only inside `when`: "
                f"declare it `Discrete`, or use it in when(condition, ...) {self._place()}"
            )

    def _check_equality(self, node: Expr) -> None:
        for leaf in self._continuous(node.args):
            raise DeclarationError(
                f"`{self._text(node)}` asks whether quantities are equal, and `{self._text(leaf)}` is not discrete: "
                f"real quantities are hardly ever equal; use < or > {self._place()}"
            )

    def _continuous(self, roots: Iterable[Expr]) -> list[Expr]:
        """Variables (and time) outside of comparisons that are not discrete."""
        found: list[Expr] = []
        pending = list(roots)
        while pending:
            node = pending.pop()
            if node.op in COMPARISONS or node.op in ("eq", "sample", "floor", "ceil", "sign"):
                continue
            if node.op == "time" or (node.op == "var" and not self._discrete(node)):
                found.append(node)
            pending.extend(node.args)
        return found

    def _discrete(self, leaf: Expr) -> bool:
        ids = self.origin.var_rows[:, leaf.value]
        return bool((self.work.flat.kind[ids] != Kind.VARIABLE).all()) and not self._potential(ids)

    def _potential(self, ids: Ints) -> bool:
        kinds = self.work.flat.kind[ids]
        return bool(((kinds == Kind.POTENTIAL) | (kinds == Kind.FLOW)).any())

    def _text(self, node: Expr) -> str:
        return self.work.flat.equation_text(self.origin, 0, node)

    def _place(self) -> str:
        component, place = self.work.flat.equation_place(self.origin, 0)
        return f"({component + ', ' if component else ''}{place})"


def _moves(args: Iterable[Expr]) -> bool:
    """Whether a variable or time is in it: otherwise its value changes at events only, and needs none of its own."""
    return any(leaf.op in ("var", "time") for leaf in leaves(*args))
