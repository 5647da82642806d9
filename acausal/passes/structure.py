"""The structure check, index reduction and its symbolic side: differentiated families."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..dae.incidence import Incidence
from ..dae.pantelides import StructurallySingular, pantelides
from ..dae.strong_components import block_lower_triangular
from ..errors import StructureError
from ..language.flat_model import Bools, Family, FlatModel, canonical
from ..language.template import Ints
from ..symbolic.differentiate import differentiate
from ..symbolic.expr import ONE, ZERO, Expr, par, var
from ..symbolic.traverse import substitute
from .aliases import Reduced
from .diagnose import singular
from .differentiation import structural_index
from .rules import DerivativeRules, apply_rules, derivative_rules
from .specialize import without_repetition


class Rows:
    """Scalar equations of a list of families, numbered through."""

    def __init__(self, families: list[Family]) -> None:
        self.families = families
        self.offset = np.concatenate([[0], np.cumsum([f.size for f in families])]).astype(np.int64)
        self.family_of = np.repeat(np.arange(len(families)), [f.size for f in families])

    def __len__(self) -> int:
        return int(self.offset[-1])

    def locate(self, row: int) -> tuple[Family, int]:
        """Family and row within it."""
        k = int(self.family_of[row])
        return self.families[k], int(row - self.offset[k])

    def incidence(self, n_columns: int, keep: Bools) -> Incidence:
        """Which of the variables in `keep` occur in which equation."""
        rows: list[Ints] = []
        columns: list[Ints] = []
        for k, family in enumerate(self.families):
            n, slots = family.var_rows.shape
            rows.append(np.repeat(np.arange(n) + self.offset[k], slots))
            columns.append(family.var_rows.ravel())
        r = np.concatenate([np.zeros(0, np.int64), *rows])
        c = np.concatenate([np.zeros(0, np.int64), *columns])
        pick = keep[c]
        return Incidence.from_coo(r[pick], c[pick], len(self), n_columns)


@dataclass(frozen=True, slots=True, eq=False)
class Blocks:
    """Blocks of equations and their unknowns, the highest derivatives.

    Attributes:
        rows: row numbers, block after block.
        ptr: start of each block in `rows`.
        columns: matched column of each of `rows`.
    """

    rows: Ints
    ptr: Ints
    columns: Ints

    def __len__(self) -> int:
        return len(self.ptr) - 1

    def rows_of(self, block: int) -> Ints:
        """Row numbers of a block."""
        return self.rows[self.ptr[block] : self.ptr[block + 1]]

    @property
    def block_of_row(self) -> Ints:
        """Block of each of `rows`."""
        return np.repeat(np.arange(len(self)), np.diff(self.ptr))


@dataclass(eq=False)
class IndexReduced:
    """The model with its hidden constraints.

    Attributes:
        families: all equations, the differentiated ones after those they come from; `rows` numbers them.
        unknown: mask of variables and derivatives that remain (extended by those that differentiation brought in).
        row_derivative: for every row the row of its derivative, or -1.
        derivative_of, parent: as in `FlatModel`, extended.
        index: structural index (`structural_index`).
        top_assignment: matched column of every row without derivative, -1 for the others.
        consumed: as in `Reduced`.
    """

    flat: FlatModel
    families: list[Family]
    unknown: Bools
    row_derivative: Ints
    derivative_of: Ints
    parent: Ints
    index: int
    top_assignment: Ints
    n_differentiated: int
    consumed: dict[tuple[int, int], int]

    @cached_property
    def rows(self) -> Rows:
        """Row numbering."""
        return Rows(self.families)

    @cached_property
    def row_integral(self) -> Ints:
        """For every row the row that it is the derivative of, or -1."""
        before = np.full(len(self.row_derivative), -1, np.int64)
        lower = np.flatnonzero(self.row_derivative >= 0)
        before[self.row_derivative[lower]] = lower
        return before

    @cached_property
    def blocks(self) -> Blocks:
        """Blocks of the equations that give the highest derivatives, in the order of their solution."""
        rows = np.flatnonzero(self.top_assignment >= 0)
        highest = self.unknown & (self.derivative_of < 0)
        graph = self.rows.incidence(len(highest), highest).select(rows=rows)
        sorted_ = block_lower_triangular(graph, self.top_assignment[rows])
        picked = rows[sorted_.rows]
        return Blocks(picked, sorted_.ptr, self.top_assignment[picked])

    def settle(self, flat: FlatModel) -> None:
        """Add the derivatives that differentiation brought in to the flat model itself."""
        extend(flat, self.derivative_of, self.parent)
        self.flat = flat

    def name(self, index: int) -> str:
        """Name of a variable or derivative, those that differentiation brought in included."""
        order = 0
        while index >= self.flat.n_var:
            index, order = int(self.parent[index]), order + 1
        base = self.flat.name(index)
        return base if order == 0 else f"der({base})" if order == 1 else f"der({base}, {order})"


def check_structure(reduced: Reduced) -> None:
    """Raise StructureError unless there are as many equations as unknowns and none is redundant by itself."""
    rows = Rows(reduced.families)
    flat = reduced.flat
    base = _collapsed(flat)
    columns = np.unique(base[np.flatnonzero(reduced.unknown)])
    if len(rows) == len(columns) and not reduced.redundant:
        return
    raise singular(reduced, rows, base, columns)


def _collapsed(flat: FlatModel) -> Ints:
    """Base variable of every derivative."""
    base = np.arange(flat.n_total)
    for _ in range(64):
        parent = flat.parent[base]
        if (parent < 0).all():
            break
        base = np.where(parent >= 0, parent, base)
    return base


def reduce_index(reduced: Reduced) -> IndexReduced:
    """Pantelides' algorithm, then differentiate the families it names.

    Raises:
        StructureError: the equations cannot be paired with the unknowns.
    """
    flat = reduced.flat
    rows = Rows(reduced.families)
    graph = rows.incidence(flat.n_total, reduced.unknown)
    active = np.where(reduced.unknown, flat.derivative_of, -1)
    sources = np.concatenate([np.zeros(0, np.int64), *(f.source for f in reduced.families)])
    rules = derivative_rules(reduced, graph, sources)
    ordinary = np.setdiff1d(np.arange(len(rows)), rules.rows)
    part = graph.select(rows=ordinary)
    extra = rules.extra(part, reduced.unknown) if rules.any else None
    try:
        result = pantelides(part.select(column_mask=rules.family_of < 0), active, extra)
    except StructurallySingular as error:
        base = _collapsed(flat)
        raise singular(reduced, rows, base, np.unique(base[np.flatnonzero(reduced.unknown)])) from error
    n_new = len(result.new_columns)
    derivative_of = np.concatenate([flat.derivative_of, np.full(n_new, -1, np.int64)])
    parent = np.concatenate([flat.parent, np.asarray(result.new_columns, np.int64)])
    derivative_of[np.asarray(result.new_columns, np.int64)] = flat.n_total + np.arange(n_new)
    unknown = np.concatenate([reduced.unknown, np.ones(n_new, bool)])
    number = np.concatenate([ordinary, len(rows) + np.arange(len(result.new_rows))])  # of the rows of `part`
    parents = number[np.asarray(result.new_rows, np.int64)]
    families, permutation = _differentiated(reduced, rows, parents, derivative_of, rules)
    row_derivative = np.full(len(permutation), -1, np.int64)
    row_derivative[permutation[parents]] = permutation[len(rows) + np.arange(len(parents))]
    assignment = np.full(len(permutation), -1, np.int64)
    assignment[permutation[number]] = np.asarray(result.assignment)
    assignment[permutation[rules.rows]] = rules.defined
    order = np.zeros(len(rows), np.int64)
    order[ordinary] = np.asarray(result.equation_order)
    out = IndexReduced(
        flat, families, unknown, row_derivative, derivative_of, parent, 0, assignment, int((order > 0).sum()),
        reduced.consumed,
    )  # fmt: skip
    out.index = structural_index(reduced, out)
    return out


def extended(flat: FlatModel, derivative_of: Ints, parent: Ints) -> FlatModel:
    """A copy of `flat` with the derivatives that differentiation brought in."""
    copy = flat.changed()
    extend(copy, derivative_of, parent)
    return copy


def extend(flat: FlatModel, derivative_of: Ints, parent: Ints) -> None:
    """Add the derivatives that differentiation brought in, with their attributes."""
    n = len(derivative_of) - flat.n_total
    flat.derivative_of, flat.parent = derivative_of, parent
    flat.start = np.pad(flat.start, (0, n), constant_values=np.nan)
    flat.fixed = np.pad(flat.fixed, (0, n), constant_values=-1)
    flat.nominal = np.pad(flat.nominal, (0, n), constant_values=np.nan)
    flat.select = np.pad(flat.select, (0, n), constant_values=2)
    flat.kind = np.pad(flat.kind, (0, n), constant_values=0)


def _differentiated(
    reduced: Reduced, rows: Rows, new_rows: Ints, derivative_of: Ints, rules: DerivativeRules
) -> tuple[list[Family], Ints]:
    """Families for the differentiated rows, and the new number of every row."""
    families = list(reduced.families)
    n = len(rows)
    family_of = np.concatenate([rows.family_of, np.full(len(new_rows), -1, np.int64)])
    local = np.concatenate([np.arange(n) - rows.offset[rows.family_of], np.full(len(new_rows), -1, np.int64)])
    pending = np.arange(len(new_rows))
    while len(pending):
        ready = pending[family_of[new_rows[pending]] >= 0]
        parent_family = family_of[new_rows[ready]]
        for k in np.unique(parent_family):
            mine = ready[parent_family == k]
            source = families[int(k)].select(local[new_rows[mine]])
            for part, derivative in differentiate_family(source, derivative_of, reduced.flat, rules):
                families.append(derivative)
                family_of[n + mine[part]] = len(families) - 1
                local[n + mine[part]] = np.arange(len(part))
        pending = pending[family_of[n + pending] < 0]
    offset = np.concatenate([[0], np.cumsum([f.size for f in families])]).astype(np.int64)
    return families, offset[family_of] + local


def differentiate_family(
    family: Family, derivative_of: Ints, flat: FlatModel, rules: DerivativeRules
) -> list[tuple[Ints, Family]]:
    """Total time derivative of a family, in parts: rows and their derivatives."""
    _refuse_inputs(family, flat, rules)
    out: list[tuple[Ints, Family]] = []
    for rows, part, known in apply_rules(family, rules):
        k = part.var_rows.shape[1]

        def tangent(leaf: Expr, k: int = k, known: dict[Expr, Expr] = known) -> Expr:
            if leaf in known:
                return known[leaf]
            if leaf.op == "var":
                return var(k + leaf.value)
            return ONE if leaf.op == "time" else ZERO

        residual = differentiate((_between_events(part, flat),), tangent)[0]
        both = np.concatenate([part.var_rows, derivative_of[part.var_rows]], axis=1)
        form, var_rows, par_rows = canonical(residual, both, part.par_rows)
        derivative = Family(form, var_rows, par_rows, part.source, part.ordinal)
        # a rule may bring in a variable that the equation has already
        out += [(rows[some], one) for some, one in without_repetition(derivative)] if known else [(rows, derivative)]
    return out


def _refuse_inputs(family: Family, flat: FlatModel, rules: DerivativeRules) -> None:
    """Inputs from outside have no derivative that is known, but for those with a rule."""
    held = flat.n_par + len(flat.inputs)
    fed = (family.par_rows >= flat.n_par) & (family.par_rows < held)
    fed &= ~np.isin(family.par_rows, list(rules.inputs))
    if fed.any():
        i = int(np.flatnonzero(fed.any(axis=1))[0])
        component, place = flat.equation_place(family, i)
        raise StructureError(
            f"the index reduction must differentiate `{flat.equation_text(family, i)}` "
            f"({component or flat.model_name}, {place}), but the derivative of an input from outside is not known: "
            "give the input as a component of the model (a source block), or pass its derivative as an input of its own"
        )


def _between_events(family: Family, flat: FlatModel) -> Expr:
    """The residual with discrete variables as they are between events: nothing is triggered there."""
    first = flat.n_par + len(flat.inputs)
    idle: dict[Expr, Expr] = {}
    for k in range(family.par_rows.shape[1]):
        slots = family.par_rows[:, k] - first
        if slots.size and (slots >= 0).all() and all(flat.slots.kinds[i] == "triggered" for i in slots.tolist()):
            idle[par(k)] = ZERO
    return substitute(family.residual, idle) if idle else family.residual
