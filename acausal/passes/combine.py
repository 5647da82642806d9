"""Combinations of equations that are free of their highest derivatives.

For a block whose Jacobian J with respect to the highest derivatives of its unknowns is singular for all values, a left
null vector u (over parameters and lower derivatives) gives the equation ``sum u_i f_i = 0``, in which the highest
derivatives cancel. Rows are differentiated c_i times; the combination takes them ``c_i - min c`` times (Tan, Nedialkov
and Pryce 2017, section 3). The support of u is a smallest set of dependent rows, so u is found by eliminating a few
rows of expressions; whether an expression is zero is decided by its values at points in general position.

Where u holds the highest derivatives themselves, as for ``x + exp(-x' - y y'') = f`` beside the derivative of
``x + y y' = g``, no linear combination will do. The equations are then functions of fewer combinations of the
derivatives than there are equations; if all but one can be solved for a derivative each (by one-to-one operators), what
is left of the last one is free of them. Tan, Nedialkov and Pryce treat such systems by *expression substitution*
(section 4), with a new variable for each combination; here none is needed.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import qr

from ..errors import StructureError
from ..language.flat_model import Family, FlatModel, canonical
from ..language.template import Floats, Ints
from ..symbolic.collect import collected
from ..symbolic.differentiate import partial
from ..symbolic.expr import MINUS_ONE, ONE, ZERO, Expr, add, const, div, mul, neg, par, var
from ..symbolic.gradient import Sampler
from ..symbolic.isolate import Solvability, invert, isolate
from ..symbolic.traverse import leaves, postorder, substitute
from .places import context
from .structure import IndexReduced

Point = tuple[Floats, Floats, float]
"""Values of the variables, of the parameters, and the time."""

ZERO_BELOW = 1e-11
"""A difference is zero if it is this small relative to what it is the difference of, at all points."""
CHANGED = 1e-6
"""An expression depends on a variable that makes this difference relative to the size of its terms."""
VANISHING = 1e-9
"""A pivot vanishes at the start if it is this small relative to what it is elsewhere."""
LARGEST = 2000
"""Blocks beyond this size are taken as they are."""


@dataclass(frozen=True, slots=True, eq=False)
class Replacement:
    """A combination in the place of other equations.

    Attributes:
        rows: rows that are replaced.
        family: the equations instead, in the order of `rows`.
        combined: text and place of the equations combined, for the first of `rows`.
        consumed: how often equations have been differentiated to make the combination.
    """

    rows: Ints
    family: Family
    combined: list[tuple[str, str, str]]
    consumed: int


def describe(flat: FlatModel, replacements: list[Replacement]) -> str:
    """What was replaced, as text."""
    lines: list[str] = []
    for replacement in replacements:
        lines.append("For all values, these equations do not determine their highest derivatives separately:")
        lines += [f"    {text:<48} {where or '(model)'}  {place}" for text, where, place in replacement.combined]
        lines.append(f"The combination without these derivatives: {flat.equation_text(replacement.family, 0)}")
    return "\n".join(lines)


def combine(
    index: IndexReduced, blocks: list[Ints], points: list[Point], begin: Point, random: np.random.Generator
) -> list[Replacement]:
    """Replacements for blocks (rows of `index`) with a singular Jacobian.

    Args:
        index: the equations.
        blocks: rows of each block.
        points: in general position.
        begin: where runs are likely to start, so that nothing is divided by what vanishes there.
        random: chooses between branches.

    Raises:
        StructureError: there is no combination, or it says nothing.
    """
    groups: dict[Any, list[_Block]] = {}
    for rows in blocks:
        if len(rows) <= LARGEST:
            block = _Block(index, rows)
            groups.setdefault(block.signature, []).append(block)
    out: list[Replacement] = []
    for members in groups.values():
        found = _Group(index, members, points, begin, random).replacements()
        if found is None and len(members) > 1:  # the instances differ: one by one
            for block in members:
                out.extend(_Group(index, [block], points, begin, random).replacements() or [])
        else:
            out.extend(found or [])
    return out


def scaled(matrices: Floats) -> Floats:
    """Rows, then columns, divided by their largest element, twice."""
    for _ in range(2):
        for axis in (-1, -2):
            size = np.abs(matrices).max(axis=axis, keepdims=True)
            matrices = matrices / np.where(size > 0, size, 1.0)
    return matrices


class _Block:
    """One block with the equations that its rows are derivatives of, over local numbers; the unknowns come first.

    Attributes:
        chains: for each row of the block the positions in `shape` of itself, its antiderivative, and so on.
        shape: (residual, variable slots, parameter slots) of all equations.
    """

    def __init__(self, index: IndexReduced, rows: Ints) -> None:
        before = index.row_integral
        unknowns = index.top_assignment[rows].tolist()
        number: dict[int, int] = {v: i for i, v in enumerate(unknowns)}
        parameters: dict[int, int] = {}
        self.size = len(rows)
        self.chains: list[list[int]] = []
        self.rows: list[int] = []
        self.consumed: list[int] = []
        self.shape: list[tuple[Expr, tuple[int, ...], tuple[int, ...]]] = []
        for top in rows.tolist():
            chain: list[int] = []
            row = top
            while row >= 0:
                family, k = index.rows.locate(row)
                slots = tuple(number.setdefault(v, len(number)) for v in family.var_rows[k].tolist())
                pars = tuple(parameters.setdefault(p, len(parameters)) for p in family.par_rows[k].tolist())
                chain.append(len(self.shape))
                self.shape.append((family.residual, slots, pars))
                self.rows.append(row)
                row = int(before[row])
            self.chains.append(chain)
            family, k = index.rows.locate(self.rows[chain[-1]])
            self.consumed.append(index.consumed.get((int(family.source[k]), int(family.ordinal[k])), 0))
        self.variables = list(number)
        self.parameters = list(parameters)
        self.below = [number.get(int(index.parent[v]), -1) for v in self.variables]
        self.signature = (
            tuple((id(r), s, p) for r, s, p in self.shape), tuple(map(tuple, self.chains)), tuple(self.below),
            tuple(self.consumed),
        )  # fmt: skip


@dataclass(slots=True, eq=False)
class _Entry:
    """An expression, its values at the points, and the size of the terms it came from."""

    expression: Expr
    value: Any

    def minus(self, factor: _Entry, other: _Entry) -> _Entry:
        """``self - factor * other``, exactly zero where it is zero."""
        product = factor.value * other.value
        value = self.value - product
        if np.all(np.abs(value) <= ZERO_BELOW * (np.abs(self.value) + np.abs(product))):
            return _Entry(ZERO, 0.0 * value)
        return _Entry(add(self.expression, neg(mul(factor.expression, other.expression))), value).simplest()

    def over(self, pivot: _Entry) -> _Entry:
        """``self / pivot``."""
        return _Entry(div(self.expression, pivot.expression), self.value / pivot.value).simplest()

    def simplest(self) -> _Entry:
        """A number where the expression has the same simple value at all points."""
        first = float(self.value.flat[0])
        simple = round(12 * first) / 12
        if self.expression.op == "const" or self.value.size < 2 or abs(simple - first) > ZERO_BELOW * abs(simple):
            return self
        if np.all(np.abs(self.value - simple) <= ZERO_BELOW * abs(simple)):
            return _Entry(const(simple), self.value)
        return self

    @property
    def nonzero(self) -> bool:
        """Whether it is zero nowhere."""
        return self.expression is not ZERO and bool(np.all(np.abs(self.value) > 0))


def pivot_rank(expression: Expr) -> int:
    """0 for a number, 1 for an expression of parameters, 2 for others."""
    if expression.op == "const":
        return 0
    return 1 if all(leaf.op == "par" for leaf in leaves(expression)) else 2


class _Group:
    """Blocks of equal shape."""

    def __init__(
        self, index: IndexReduced, blocks: list[_Block], points: list[Point], begin: Point, random: np.random.Generator
    ) -> None:
        self.index = index
        self.blocks = blocks
        self.first = blocks[0]
        self.var_rows = np.array([b.variables for b in blocks], np.int64)
        self.par_rows = np.array([b.parameters for b in blocks], np.int64).reshape(len(blocks), -1)
        self.forms = [
            substitute(
                residual,
                {**{var(i): var(s) for i, s in enumerate(slots)}, **{par(i): par(s) for i, s in enumerate(pars)}},
            )
            for residual, slots, pars in self.first.shape
        ]
        branches = (lambda: True, lambda: False, lambda: bool(random.integers(2)))
        self.samplers = [
            Sampler(self._leaf(point), branch, lambda: float(random.uniform(0.5, 1.5)))
            for point, branch in zip(points, branches, strict=False)
        ]
        self.begin = Sampler(self._leaf(begin), branches[0], lambda: 1.0)
        self.entries = self._jacobian()

    def _leaf(self, point: Point) -> Any:
        values, parameters, time = point

        def leaf(node: Expr) -> Any:
            if node.op == "time":
                return time
            if node.op == "par":
                return parameters[self.par_rows[:, node.value]]
            return values[self.var_rows[:, node.value]]

        return leaf

    def value(self, expression: Expr) -> Floats:
        """Values at all points of all blocks, (points, blocks)."""
        n = len(self.blocks)
        return np.stack([np.broadcast_to(np.asarray(s.values((expression,))[0], float), (n,)) for s in self.samplers])

    def _pivot_rank(self, pivot: Expr, value: Floats) -> int:
        """How safe it is to divide by it: 0 for a number, 1 for parameters, 2 for variables, 3 if it starts at zero."""
        rank = pivot_rank(pivot)
        if rank < 2:
            return rank
        at = np.abs(np.asarray(self.begin.values((pivot,))[0], float))
        return 2 if np.all(at > VANISHING * np.nanmin(np.abs(value), axis=0)) else 3

    def _jacobian(self) -> dict[tuple[int, int], _Entry]:
        entries: dict[tuple[int, int], _Entry] = {}
        m = self.first.size
        usable = np.ones(len(self.samplers), bool)
        for i, chain in enumerate(self.first.chains):
            for u in self.first.shape[chain[0]][1]:
                if u < m:
                    expression = partial(self.forms[chain[0]], var(u))
                    value = self.value(expression)
                    usable &= np.isfinite(value).all(axis=1)
                    if (value != 0).any() or not np.isfinite(value).all():
                        entries[i, u] = _Entry(expression, value)
        self.samplers = [s for s, ok in zip(self.samplers, usable, strict=True) if ok]
        for entry in entries.values():
            entry.value = entry.value[usable]
        return entries

    def replacements(self) -> list[Replacement] | None:
        """Combinations for the block's dependent rows; None if there are none after all."""
        if not self.samplers:
            return None
        m = self.first.size
        matrix = np.zeros((m, m))
        for (i, u), entry in self.entries.items():
            matrix[i, u] = entry.value[0, 0]
        out: list[Replacement] = []
        replaced: set[int] = set()
        failed: list[list[int]] = []
        for circuit in dependent_rows(matrix):
            if replaced & set(circuit):
                continue
            found = self._replacement(circuit)
            if isinstance(found, Replacement):
                out.append(found)
                replaced.update(circuit)
            elif found:
                failed.append(circuit)
        if not out and failed:
            raise self._failure(failed[0])
        return out or None

    def _replacement(self, circuit: list[int]) -> Replacement | bool:
        """The combination; True if there is none without highest derivatives, False if the rows are independent."""
        differentiated = {i: len(self.first.chains[i]) - 1 for i in circuit}
        lift = min(differentiated.values())
        gone = self._lowered(range(self.first.size), lift)
        best: tuple[tuple[int, int], int, list[int], Expr] | None = None
        dependent = False
        for last in circuit:
            if differentiated[last] != lift:
                continue
            worst, vector = self._null_vector(circuit, last)
            if vector is None:
                continue
            dependent = True
            held = {leaf.value for leaf in leaves(*vector.values(), op="var")}
            if held & gone or min(held, default=self.first.size) < self.first.size:
                continue
            residual = self._combination(vector, lift, gone)
            if residual is not None:
                rating = worst, len(postorder((residual,)))
                if best is None or rating < best[0]:
                    best = rating, last, list(vector), residual
        if best is None and dependent:
            best = self._eliminated(circuit, [i for i in circuit if differentiated[i] == lift], lift, gone)
        if best is None:
            return dependent
        return self._made(best[3], best[1], best[2])

    def _eliminated(
        self, circuit: list[int], lasts: list[int], lift: int, gone: set[int]
    ) -> tuple[tuple[int, int], int, list[int], Expr] | None:
        """One of the rows `lasts` with the unknowns `gone` replaced by what the other rows give for them."""
        best: tuple[tuple[int, int], int, list[int], Expr] | None = None
        for last in lasts:
            rows = {i: self.forms[self.first.chains[i][lift]] for i in circuit}
            worst = self._substituted(rows, last, gone)
            residual = None if worst is None else self._free(rows[last], circuit, gone)
            if worst is not None and residual is not None:
                rating = worst, len(postorder((residual,)))
                if best is None or rating < best[0]:
                    best = rating, last, circuit, residual
        return best

    def _substituted(self, rows: dict[int, Expr], last: int, gone: set[int]) -> int | None:
        """Solve each row but `last` for what it shares with others and put it there, in place.

        That is one of the unknowns `gone`, or a sum of terms with them. Returns the worst solvability or None.
        """
        active, worst = [i for i in rows if i != last], 0
        while active:
            found = [
                (*one, i) for i in active for one in self._solved(rows[i], [rows[k] for k in (*active, last)], gone)
            ]  # fmt: skip
            if not found:
                return None
            solvability, _, target, solution, p = min(found, key=lambda one: one[:2])
            worst = max(worst, solvability)
            active.remove(p)
            for i in (*active, last):
                rows[i] = substitute(rows[i], {target: solution})
        return worst

    def _solved(self, row: Expr, rows: list[Expr], gone: set[int]) -> list[tuple[int, int, Expr, Expr]]:
        """(Solvability, rank, what the row is solved for, what it is)."""
        found: list[tuple[int, int, Expr, Expr]] = []
        for rank, u in enumerate(sorted({leaf.value for leaf in leaves(row, op="var")} & gone)):
            one = isolate(row, var(u))
            if one.solution is not None and (self.value(one.coefficient) != 0).all():
                found.append((int(one.solvability), rank, var(u), one.solution))
        if found:
            return found
        often = Counter(id(node) for other in rows for node in postorder((other,)))
        for rank, node in enumerate(reversed(postorder((row,))[:-1])):
            held = {leaf.value for leaf in leaves(node, op="var")} & gone
            if held and often[id(node)] > 1 and (solution := invert(row, node, ranges=True)) is not None:
                found.append((int(Solvability.NONLINEAR), rank, node, solution))
        return found

    def _free(self, residual: Expr, involved: list[int], gone: set[int]) -> Expr | None:
        """A residual that does not depend on the unknowns `gone`, written without them; None if it does depend.

        Points at which it has no value, as what is under a logarithm is negative there, say nothing.
        """
        terms = residual.args if residual.op == "add" else (residual,)
        whole, size = self.value(residual), sum(np.abs(self.value(term)) for term in terms)
        for anything in (ZERO, ONE, MINUS_ONE):
            try:
                written = collected(substitute(residual, {var(z): anything for z in gone}))
            except ZeroDivisionError:
                continue
            value = self.value(written)
            known = np.isfinite(value) & np.isfinite(whole)
            if not known.any(axis=0).all():
                continue
            if (np.abs(value - whole) > CHANGED * size)[known].any():
                return None
            if (np.abs(value) <= ZERO_BELOW * size)[known].all():
                raise self._repetition(involved)
            return written
        return None

    def _combination(self, vector: dict[int, Expr], lift: int, gone: set[int]) -> Expr | None:
        """``sum u_i f_i`` without the unknowns `gone`, which it does not depend on; None if it cannot be written."""
        terms = [mul(u, self.forms[self.first.chains[i][lift]]) for i, u in vector.items()]
        written = [self.value(term) for term in terms]
        whole, size = sum(written), sum(np.abs(value) for value in written)
        out: Expr | None = None
        for anything in (ZERO, ONE, MINUS_ONE):
            try:
                residual = collected(substitute(add(*terms), {var(z): anything for z in gone}))
            except ZeroDivisionError:
                continue
            value = self.value(residual)
            if not np.isfinite(value).all():
                continue
            if (np.abs(value - whole) > CHANGED * size).any():
                return None  # a step function: its slope is zero, but it is not constant
            if (np.abs(value) <= ZERO_BELOW * size).all():
                raise self._repetition(list(vector))
            out = residual if out is None else out
        return out

    def _lowered(self, unknowns: Iterable[int], steps: int) -> set[int]:
        """Local numbers of the unknowns, integrated `steps` times."""
        found: set[int] = set()
        for u in unknowns:
            for _ in range(steps):
                u = self.first.below[u] if u >= 0 else u
            if u >= 0:
                found.add(u)
        return found

    def _null_vector(self, circuit: list[int], last: int) -> tuple[int, dict[int, Expr] | None]:
        """(Worst pivot, coefficients of a combination of the rows in which all unknowns cancel, 1 for row `last`)."""
        rows = {i: {u: e for (k, u), e in self.entries.items() if k == i} for i in circuit}
        one = _Entry(ONE, np.ones((len(self.samplers), len(self.blocks))))
        factors: dict[int, dict[int, _Entry]] = {i: {i: one} for i in circuit}
        active = [i for i in circuit if i != last]
        worst = 0
        while active:
            candidates = [
                (self._pivot_rank(e.expression, e.value), sum(u in rows[k] for k in circuit), i, u)
                for i in active for u, e in rows[i].items() if e.nonzero
            ]  # fmt: skip
            if not candidates:
                return 4, None
            rank, _, p, u = min(candidates)
            worst = max(worst, rank)
            active.remove(p)
            pivot = rows[p][u]
            for k in (*active, last):
                if u not in rows[k]:
                    continue
                a = rows[k].pop(u)
                factor = a.over(pivot)
                _subtract(rows[k], factor, {v: e for v, e in rows[p].items() if v != u})
                _subtract(factors[k], factor, factors[p])
        if rows[last]:
            return 4, None
        return worst, {i: e.expression for i, e in factors[last].items()}

    def _made(self, residual: Expr, last: int, involved: list[int]) -> Replacement:
        at = self.first.chains[last][-1]
        replaced = np.array([b.rows[at] for b in self.blocks], np.int64)
        families = [self.index.rows.locate(int(r)) for r in replaced]
        source = np.array([f.source[k] for f, k in families])
        ordinal = np.array([f.ordinal[k] for f, k in families])
        form, var_rows, par_rows = canonical(residual, self.var_rows, self.par_rows)
        family = Family(form, var_rows, par_rows, source, ordinal)
        first = self.first
        consumed = max(first.consumed[i] + len(first.chains[i]) for i in involved) - len(first.chains[last])
        return Replacement(replaced, family, self._texts(involved), consumed)

    def _texts(self, involved: Iterable[int]) -> list[tuple[str, str, str]]:
        out: list[tuple[str, str, str]] = []
        for i in involved:
            family, k = self.index.rows.locate(self.first.rows[self.first.chains[i][-1]])
            out.append((self.index.flat.equation_text(family, k), *self.index.flat.equation_place(family, k)))
        return out

    def _error(self, head: str, involved: list[int], tail: str) -> StructureError:
        flat, texts = self.index.flat, self._texts(involved)
        lines = [f"`{flat.model_name}` {head}"]
        lines += [f"    {text:<48} {component or '(model)'}  {place}" for text, component, place in texts]
        written = context(flat, [component for _, component, _ in texts])
        lines += [written] if written else []
        names = [self.index.name(v) for v in self.first.variables[: self.first.size]]
        return StructureError(
            "\n".join([*lines, tail]),
            equations=[t for t, _, _ in texts],
            unknowns=names,
            components=dict.fromkeys(c for _, c, _ in texts),
        )

    def _repetition(self, involved: list[int]) -> StructureError:
        if len(involved) == 1:
            return self._error(
                "is singular for all values: in this equation everything cancels, so that it determines nothing:",
                involved,
                "Try: write what is missing in its place.",
            )
        return self._error(
            "is singular for all values: one of these equations follows from the others:",
            involved,
            "Try: remove one of them and write what is missing instead, often a ground (reference), or a given value "
            "where only differences are given.",
        )

    def _failure(self, involved: list[int]) -> StructureError:
        if len(involved) == 1:
            name = self.index.name(self.first.variables[involved[0]])
            return self._error(
                f"is singular for all values: this equation does not determine `{name}`, for which it would have to be "
                "solved (its slope is zero on either side of its steps):",
                involved,
                f"Try: an equation that determines `{name}`, or a condition that leaves it free.",
            )
        return self._error(
            "cannot be reduced: for all values these equations do not determine their highest derivatives, and every "
            "combination that is free of them has coefficients that hold these derivatives:",
            involved,
            "Try: a new variable for the expression of derivatives that the equations share, used in all of them.",
        )


def _subtract(target: dict[int, _Entry], factor: _Entry, row: dict[int, _Entry]) -> None:
    """``target -= factor * row``, dropping what cancels."""
    zero = _Entry(ZERO, 0.0 * factor.value)
    for u, e in row.items():
        new = target.get(u, zero).minus(factor, e)
        if new.expression is ZERO:
            target.pop(u, None)
        else:
            target[u] = new


def dependent_rows(matrix: Floats) -> list[list[int]]:
    """Smallest sets of linearly dependent rows of a square matrix, one for each row too many."""
    a = scaled(matrix)
    factors: Any = qr(a.T, mode="r", pivoting=True)
    r, order = factors
    diagonal = np.abs(np.diag(r))
    rank = int((diagonal > 1e-9 * max(diagonal[0], 1e-300)).sum())
    out: list[list[int]] = []
    for k in range(rank, len(order)):
        if rank:
            weight = np.linalg.solve(r[:rank, :rank], r[:rank, k])
            support = order[:rank][np.abs(weight) > 1e-8 * np.abs(weight).max(initial=0.0)]
        else:
            support = order[:0]
        out.append(sorted([int(order[k]), *support.tolist()]))
    return out
