"""Linear first integrals: combinations of the equations that say ``d/dt sum c_i x_i = 0``, the coefficients numbers.

Elements in a reaction, the total of what only moves from place to place. A Rosenbrock method keeps such sums in exact
arithmetic, but in the linear solves of a stiff step rounding errors grow by the step times the Jacobian. Where a
solution falls by many powers of ten what is lost of a sum is soon as large as its terms, and no error control sees it.
Source: Hairer, Lubich and Wanner (2006), Geometric Numerical Integration, IV.1 (linear invariants), IV.4 (projection).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

import numpy as np

from ..language.template import Floats, Ints
from ..symbolic.expr import Expr, par, var
from ..symbolic.traverse import postorder, substitute

if TYPE_CHECKING:
    from .schedule import Schedule

MOST_EQUATIONS = 2_000
"""Larger systems are not searched."""
MOST_TOGETHER = 200
"""Most equations whose terms may all cancel that are combined; elimination is cubic in them."""
LARGEST_COEFFICIENT = 1e6
"""Coefficients further apart than this are accidents of rounding in the numbers of the model."""

Term = tuple[int, ...]
"""The identities of the factors of a product, sorted; none for a number."""
Row = dict[Term, Fraction]


@dataclass(frozen=True, slots=True, eq=False)
class FirstIntegrals:
    """``sum c_i x_i`` that stay what they are: `count` of them, the numbers ``c`` by (row, state)."""

    count: int
    row: Ints
    column: Ints
    value: Floats

    def matrix(self, n_x: int) -> Floats:
        """Dense, (count, n_x)."""
        out = np.zeros((self.count, n_x))
        out[self.row, self.column] = self.value
        return out


def first_integrals(schedule: Schedule) -> FirstIntegrals:
    """Those with two states or more that follow from the equations term by term.

    Each equation is a sum of products with numbers before them. Equations with a product that is in no other one drop
    out first, which leaves nothing of most models; from the others all products but the rates of states are eliminated.
    """
    reduced = schedule.reduced
    rows = np.concatenate([np.zeros(0, np.int64), *(g.equations.ravel() for g in schedule.groups)])
    if len(rows) > MOST_EQUATIONS:
        return _collected([])
    # expressions are interned; those whose identities count have to stay alive
    kept = [var(d) for d in reduced.derivative_of[schedule.states].tolist()]
    derivative = {id(rate): k for k, rate in enumerate(kept)}
    table: list[Row] = []
    for row in np.sort(rows).tolist():
        family, k = reduced.rows.locate(row)
        names = {var(i): var(v) for i, v in enumerate(family.var_rows[k].tolist())}
        names |= {par(i): par(v) for i, v in enumerate(family.par_rows[k].tolist())}
        residual = substitute(family.residual, names)
        kept.append(residual)
        table.append(expanded(residual))

    def is_rate(term: Term) -> bool:
        return len(term) == 1 and term[0] in derivative

    table = _cancelling(table, is_rate)
    if len(table) > MOST_TOGETHER:
        return _collected([])
    found = [{derivative[t[0]]: c for t, c in line.items()} for line in _eliminated(table, is_rate)]
    return _collected(found)


def expanded(residual: Expr) -> Row:
    """A residual as products with rational coefficients; what is no sum, product or quotient is a factor."""
    memo: dict[int, Row] = {}
    for node in postorder((residual,)):
        memo[id(node)] = _expanded(node, [memo[id(a)] for a in node.args])
    return memo[id(residual)]


def _expanded(node: Expr, args: list[Row]) -> Row:
    if node.op == "const" and np.isfinite(node.value):
        return {(): Fraction(node.value)} if node.value else {}
    if node.op == "neg":
        return {t: -c for t, c in args[0].items()}
    if node.op == "add":
        out: Row = {}
        for arg in args:
            _add(out, arg, Fraction(1))
        return out
    if node.op == "mul" and min(map(len, args)) <= 1:  # a product of two sums is left alone
        a, b = args
        return {tuple(sorted(s + t)): c * d for s, c in a.items() for t, d in b.items()}
    if node.op == "div" and list(args[1]) == [()]:
        return {t: c / args[1][()] for t, c in args[0].items()}
    return {(id(node),): Fraction(1)}


def _add(target: Row, row: Row, factor: Fraction) -> None:
    """``target += factor * row``, dropping what cancels."""
    for term, c in row.items():
        new = target.get(term, 0) + factor * c
        if new:
            target[term] = new
        else:
            target.pop(term, None)


def _cancelling(table: list[Row], is_rate: Callable[[Term], bool]) -> list[Row]:
    """The equations each of whose products is in another one, too."""
    while True:
        count: dict[Term, int] = {}
        for line in table:
            for term in line:
                count[term] = count.get(term, 0) + 1
        kept = [line for line in table if all(is_rate(t) or count[t] > 1 for t in line)]
        if len(kept) == len(table):
            return kept
        table = kept


def _eliminated(table: list[Row], is_rate: Callable[[Term], bool]) -> list[Row]:
    """What is left of the equations when all products but rates are eliminated (Gauss, in exact numbers)."""
    table = [dict(line) for line in table]
    out: list[Row] = []
    while table:
        table.sort(key=len)
        line = table.pop(0)
        pivot = next((t for t in line if not is_rate(t)), None)
        if pivot is None:
            out.append(line)
            continue
        for other in table:
            if pivot in other:
                _add(other, line, -other[pivot] / line[pivot])
    return out


def _collected(found: list[dict[int, Fraction]]) -> FirstIntegrals:
    entries: list[tuple[int, int, float]] = []
    count = 0
    for line in found:
        size = [abs(c) for c in line.values()]
        if len(line) < 2 or max(size) > LARGEST_COEFFICIENT * min(size):
            continue
        largest = max(size)
        entries += [(count, k, float(c / largest)) for k, c in sorted(line.items())]
        count += 1
    row, column, value = zip(*entries, strict=True) if entries else ((), (), ())
    return FirstIntegrals(count, np.array(row, np.int64), np.array(column, np.int64), np.array(value, float))
