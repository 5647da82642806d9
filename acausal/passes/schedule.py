"""Sort and tear: equations in block lower triangular order, blocks of equal shape grouped into one kernel."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..dae.strong_components import block_lower_triangular
from ..dae.tearing import tear
from ..errors import StructureError
from ..language.flat_model import Family
from ..language.template import Floats, Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import ZERO, Expr, add, div, mul, neg, par, var
from ..symbolic.isolate import Isolated, Solvability, isolate
from ..symbolic.traverse import contains, evaluate, leaves, postorder, substitute
from .states import Selected
from .structure import IndexReduced

SYMBOLIC = 3
"""Linear systems of up to this many tearing variables are solved symbolically (Cramer's rule)."""
ZERO_PIVOT = 1e-14
"""A coefficient of parameters that is smaller than this counts as zero."""
DENSE = 60
"""Linear systems of up to this many tearing variables are solved inside the right-hand side; larger ones become
algebraic unknowns of the solver, whose sparse matrix then solves them."""


@dataclass(frozen=True, slots=True, eq=False)
class Kernel:
    """How one block of equations is solved, over ``var(0..m-1)`` (its unknowns), ``var(m..)`` (what it needs), ``par``.

    Attributes:
        size: number m of unknowns.
        steps: explicit assignments in order: (unknown, expression).
        tears: unknowns that are found first, by a linear system or by iteration.
        residuals: as many equations as tears, for iteration.
        matrix, rhs: the linear system for the tears, where the residuals are affine in them.
        divisor: a factor, made of parameters, of unknowns that are zero if it is not (`undetermined`).
    """

    size: int
    steps: tuple[tuple[int, Expr], ...]
    tears: tuple[int, ...] = ()
    residuals: tuple[Expr, ...] = ()
    matrix: tuple[tuple[Expr, ...], ...] = ()
    rhs: tuple[Expr, ...] = ()
    divisor: Expr | None = None

    @property
    def iterates(self) -> bool:
        """Whether the tears are unknowns of the solver."""
        return bool(self.residuals)

    @property
    def expressions(self) -> list[Expr]:
        """All that is evaluated, in order."""
        entries = [e for line in self.matrix for e in line]
        return [*(e for _, e in self.steps), *self.residuals, *entries, *self.rhs]


@dataclass(frozen=True, slots=True, eq=False)
class Group:
    """Blocks with the same kernel at the same level.

    Attributes:
        var_rows: int64 (n, m + externals), the block's unknowns first.
        par_rows: int64 (n, parameters).
        equations: int64 (n, m), row numbers of the block's equations.
    """

    kernel: Kernel
    level: int
    var_rows: Ints
    par_rows: Ints
    equations: Ints

    @property
    def size(self) -> int:
        """Number of blocks."""
        return len(self.var_rows)

    @property
    def unknowns(self) -> Ints:
        """(n, m) variables that the blocks determine."""
        return self.var_rows[:, : self.kernel.size]


@dataclass(frozen=True, slots=True, eq=False)
class Schedule:
    """Everything the lowering needs.

    Attributes:
        groups: in evaluation order.
        tears: variables iterated on by the solver (algebraic unknowns), in group order.
        invariants: families of constraints on the states.
    """

    reduced: IndexReduced
    states: Ints
    groups: list[Group]
    tears: Ints
    invariants: list[Family]
    block_sizes: dict[int, int] = field(default_factory=dict[int, int])


def make_schedule(selected: Selected, parameters: Floats) -> Schedule:
    """Sort into blocks, tear, group; `parameters` are the default values (a pivot that is zero there is none)."""
    reduced = selected.reduced
    rows = np.flatnonzero(selected.assignment >= 0)
    is_unknown = reduced.unknown.copy()
    is_unknown[selected.states] = False
    n_columns = len(is_unknown)
    graph = reduced.rows.incidence(n_columns, is_unknown).select(rows=rows)
    blocks = block_lower_triangular(graph, selected.assignment[rows])
    size = np.diff(blocks.ptr)
    single = blocks.ptr[:-1][size == 1]
    groups = _singles(reduced, rows[blocks.rows[single]], selected.assignment, np.asarray(blocks.level)[size == 1])
    builder = _BlockBuilder(reduced, selected.assignment, parameters)
    for b in np.flatnonzero(size > 1):
        members = rows[blocks.rows[blocks.ptr[b] : blocks.ptr[b + 1]]]
        builder.add(members, int(blocks.level[b]))
    groups.extend(builder.groups())
    groups.sort(key=lambda g: (g.level, int(g.equations[0, 0])))
    tears = [g.unknowns[:, g.kernel.tears].ravel() for g in groups if g.kernel.iterates]
    sizes, counts = np.unique(size, return_counts=True)
    return Schedule(
        reduced, selected.states, groups, np.concatenate([np.zeros(0, np.int64), *tears]),
        _rows_of(reduced, selected.invariants), dict(zip(sizes.tolist(), counts.tolist(), strict=True)),
    )  # fmt: skip


def _rows_of(reduced: IndexReduced, rows: Ints) -> list[Family]:
    """Families of some rows."""
    out: list[Family] = []
    family_of = reduced.rows.family_of[rows]
    for k in np.unique(family_of):
        out.append(reduced.families[int(k)].select(rows[family_of == k] - reduced.rows.offset[k]))
    return out


def _singles(reduced: IndexReduced, rows: Ints, assignment: Ints, level: Ints) -> list[Group]:
    """Blocks of one equation, grouped by family, slot and level."""
    groups: list[Group] = []
    table = reduced.rows
    family_of = table.family_of[rows]
    order = np.lexsort((rows, level, family_of))
    rows, level, family_of = rows[order], level[order], family_of[order]
    for k in np.unique(family_of):
        mine = slice(*np.searchsorted(family_of, [k, k + 1]))
        family = table.families[int(k)]
        local = rows[mine] - table.offset[k]
        var_rows = family.var_rows[local]
        slot = (var_rows == assignment[rows[mine]][:, None]).argmax(axis=1)
        lv = level[mine]
        keys, which = np.unique(np.stack([lv, slot], axis=1), axis=0, return_inverse=True)
        by_key = np.argsort(which.ravel(), kind="stable")
        bounds = np.searchsorted(which.ravel()[by_key], np.arange(len(keys) + 1))
        kernels: dict[int, Kernel] = {}
        for g, (at_level, s) in enumerate(keys.tolist()):
            pick = by_key[bounds[g] : bounds[g + 1]]
            others = [j for j in range(var_rows.shape[1]) if j != s]
            columns = var_rows[pick][:, [s, *others]]
            if s not in kernels:
                kernels[s] = _single_kernel(family.residual, s, others)
            kernel = kernels[s]
            groups.append(
                Group(kernel, at_level, columns, family.par_rows[local[pick]], rows[mine][pick][:, None])
            )
    return groups


def _single_kernel(residual: Expr, slot: int, others: list[int]) -> Kernel:
    """One equation for one unknown."""
    renumber = {var(slot): var(0), **{var(j): var(i + 1) for i, j in enumerate(others)}}
    form = substitute(residual, renumber)
    isolated = isolate(form, var(0))
    if isolated.solution is not None:
        divisor = _dividing((isolated.solution,), isolated.coefficient)
        return Kernel(1, ((0, isolated.solution),), divisor=divisor)
    return Kernel(1, (), (0,), (form,))


class Dependent(ValueError):
    """Equations that are dependent once those that can be solved are put into the others."""


class _BlockBuilder:
    """Collects simultaneous blocks and groups those of equal shape."""

    def __init__(self, reduced: IndexReduced, assignment: Ints, defaults: Floats) -> None:
        self.reduced = reduced
        self.defaults = defaults
        self.assignment = assignment
        self.kernels: dict[Any, Kernel] = {}
        self.collected: dict[Any, list[tuple[list[int], list[int], Ints]]] = {}
        self.isolated: dict[tuple[Expr, int], Isolated] = {}

    def add(self, members: Ints, level: int) -> None:
        """One block: equations `members`."""
        table = self.reduced.rows
        unknowns = self.assignment[members].tolist()
        number = {v: i for i, v in enumerate(unknowns)}
        externals: dict[int, int] = {}
        parameters: dict[int, int] = {}
        shape: list[Any] = []
        for row in members.tolist():
            family, k = table.locate(row)
            slots = tuple(
                number[v] if v in number else len(unknowns) + externals.setdefault(v, len(externals))
                for v in family.var_rows[k].tolist()
            )
            pars = tuple(parameters.setdefault(p, len(parameters)) for p in family.par_rows[k].tolist())
            shape.append((family.residual, slots, pars))
        values = self.defaults[list(parameters)]
        signature = (*((id(residual), slots, pars) for residual, slots, pars in shape), tuple((values == 0).tolist()))
        if signature not in self.kernels:
            try:
                self.kernels[signature] = self._kernel(shape, len(unknowns), self._preference(unknowns), values)
            except Dependent as error:
                raise self._dependent(members) from error
        columns = [*unknowns, *externals]
        self.collected.setdefault((level, signature), []).append((columns, list(parameters), members))

    def _dependent(self, members: Ints) -> StructureError:
        flat, rows = self.reduced.flat, [self.reduced.rows.locate(int(row)) for row in members]
        names = [self.reduced.name(int(v)) for v in self.assignment[members]]
        return StructureError(
            f"`{flat.model_name}` cannot be solved: put into each other, these equations lose "
            f"{', '.join(f'`{name}`' for name in names)}, although their structure looks regular:\n"
            + "\n".join(f"    {flat.equation_line(*row)}" for row in rows)
            + "\nTry: simplify them by hand. Where one is a multiple of another plus a condition, write the condition.",
            equations=[flat.equation_text(*row) for row in rows], unknowns=names,
            components=dict.fromkeys(flat.equation_place(*row)[0] for row in rows),
        )  # fmt: skip

    def _preference(self, unknowns: list[int]) -> list[float]:
        """Variables with a start value make good tearing variables: they have a guess."""
        start = self.reduced.flat.start[unknowns]
        return np.where(np.isnan(start), 0.0, 1.0).tolist()

    def groups(self) -> list[Group]:
        """All blocks, grouped."""
        out: list[Group] = []
        for (level, signature), blocks in self.collected.items():
            var_rows = np.array([b[0] for b in blocks], np.int64)
            par_rows = np.array([b[1] for b in blocks], np.int64).reshape(len(blocks), -1)
            out.append(Group(self.kernels[signature], level, var_rows, par_rows, np.stack([b[2] for b in blocks])))
        return out

    def _kernel(self, shape: list[Any], m: int, preference: list[float], values: Floats) -> Kernel:
        forms = [
            substitute(
                residual,
                {**{var(i): var(s) for i, s in enumerate(slots)}, **{par(i): par(s) for i, s in enumerate(pars)}},
            )
            for residual, slots, pars in shape
        ]
        local = [[s for s in slots if s < m] for _, slots, _ in shape]
        solved = {(i, u): isolate(forms[i], var(u)) for i in range(m) for u in local[i]}
        safe = [[solved[i, u].solvability == Solvability.CONSTANT for u in local[i]] for i in range(m)]
        solvable = [[_pivots(solved[i, u], values) for u in local[i]] for i in range(m)]
        result = tear(local, solvable, m, preference=preference)
        if safe != solvable:  # without division by parameters, which may become zero, if that costs nothing
            other = tear(local, safe, m, preference=preference)
            result = other if len(other.tear_columns) <= len(result.tear_columns) else result
        steps: list[tuple[int, Expr]] = []
        for row, column in result.sequence:
            solution = solved[row, column].solution
            assert solution is not None
            steps.append((int(column), solution))
        tears = tuple(int(c) for c in result.tear_columns)
        residuals = tuple(forms[int(r)] for r in result.residual_rows)
        return finish_kernel(m, steps, tears, residuals)


def _pivots(isolated: Isolated, parameters: Floats) -> bool:
    """Whether the coefficient is a number, or one of parameters that is not zero at their default values.

    One that a mode switches is no pivot: an ideal diode has the voltage `s` or ``1e-5 s``, and 0 with ``Ron=0``.
    """
    if isolated.solvability != Solvability.PARAMETER:
        return isolated.solvability == Solvability.CONSTANT
    if any(node.op == "where" for node in postorder((isolated.coefficient,))):
        return False
    value = evaluate((isolated.coefficient,), lambda leaf: parameters[leaf.value], np)[0]
    return not abs(value) < ZERO_PIVOT


def finish_kernel(m: int, steps: list[tuple[int, Expr]], tears: tuple[int, ...], residuals: tuple[Expr, ...]) -> Kernel:
    """Decide how the tears are solved for: symbolically, by a small matrix, or by the solver."""
    inner: dict[Expr, Expr] = {}
    for column, solution in steps:
        inner[var(column)] = substitute(solution, inner)
    closed = [substitute(r, inner) for r in residuals]
    if not tears:
        return Kernel(m, tuple(steps))
    matrix = [[partial(r, var(t)) for t in tears] for r in closed]
    affine = not any(contains(entry, var(t)) for line in matrix for entry in line for t in tears)
    if not affine or len(tears) > DENSE:
        return Kernel(m, tuple(steps), tears, residuals)
    rest = [neg(substitute(r, {var(t): ZERO for t in tears})) for r in closed]
    if len(tears) > SYMBOLIC:
        return Kernel(m, tuple(steps), tears, (), tuple(map(tuple, matrix)), tuple(rest))
    found, determinant = cramer(matrix, rest)
    return Kernel(m, (*zip(tears, found, strict=True), *steps), divisor=_dividing(found, determinant))


def _dividing(solutions: Sequence[Expr], divisor: Expr) -> Expr | None:
    """The divisor of the solutions, where one of them is zero without it and parameters decide whether it is zero."""
    hidden = any(solution is ZERO for solution in solutions)
    return divisor if hidden and {leaf.op for leaf in leaves(divisor)} == {"par"} else None


def cramer(matrix: list[list[Expr]], rhs: list[Expr]) -> tuple[list[Expr], Expr]:
    """Solution of a linear system of up to three unknowns, and its determinant.

    Raises:
        Dependent: the determinant is zero.
    """
    determinant = _determinant(matrix)
    if determinant is ZERO:
        raise Dependent
    out: list[Expr] = []
    for j in range(len(rhs)):
        replaced = [[rhs[i] if k == j else entry for k, entry in enumerate(line)] for i, line in enumerate(matrix)]
        out.append(div(_determinant(replaced), determinant))
    return out, determinant


def _determinant(a: list[list[Expr]]) -> Expr:
    if len(a) == 1:
        return a[0][0]
    terms: list[Expr] = []
    for j, entry in enumerate(a[0]):
        minor = [[e for k, e in enumerate(line) if k != j] for line in a[1:]]
        term = mul(entry, _determinant(minor))
        terms.append(term if j % 2 == 0 else neg(term))
    return add(*terms)


def needs(group: Group) -> Ints:
    """Variables that a group needs from elsewhere."""
    return group.var_rows[:, group.kernel.size :]
