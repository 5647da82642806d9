"""Sparse Jacobians by forward automatic differentiation on the DAG: one pass for all columns.

Every node carries the derivatives that are not identically zero, by column; sharing is kept (Griewank and Walther 2008,
Evaluating Derivatives, ch. 7.1).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from .expr import ZERO, Expr, add, make, mul
from .operators import slope
from .traverse import postorder

Row = Mapping[int, Expr]
"""Derivatives of one expression: column to expression, absent where zero."""


def sparse_jacobian(roots: Iterable[Expr], seed: Callable[[Expr], Row]) -> list[Row]:
    """Derivatives of `roots`, a row for each.

    Args:
        roots: expressions.
        seed: derivatives of a leaf.
    """
    roots = list(roots)
    rows: dict[int, Row] = {}
    empty: Row = {}
    for node in postorder(roots):
        if node.op == "const":
            rows[id(node)] = empty
        elif not node.args and node.op != "call":
            rows[id(node)] = seed(node)
        elif all(not rows[id(a)] for a in node.args):
            rows[id(node)] = empty
        elif node.op == "add":
            rows[id(node)] = _sum(node, rows)
        elif node.op == "where":
            rows[id(node)] = _choice(node, rows)
        else:
            rows[id(node)] = _chain(node, rows)
    return [rows[id(root)] for root in roots]


def _sum(node: Expr, rows: Mapping[int, Row]) -> Row:
    terms: dict[int, list[Expr]] = {}
    for a in node.args:
        for column, d in rows[id(a)].items():
            terms.setdefault(column, []).append(d)
    return _kept({column: add(*parts) for column, parts in terms.items()})


def _choice(node: Expr, rows: Mapping[int, Row]) -> Row:
    condition, a, b = node.args
    da, db = rows[id(a)], rows[id(b)]
    columns = dict.fromkeys([*da, *db])
    return _kept({c: make("where", (condition, da.get(c, ZERO), db.get(c, ZERO))) for c in columns})


def _chain(node: Expr, rows: Mapping[int, Row]) -> Row:
    terms: dict[int, list[Expr]] = {}
    for i, a in enumerate(node.args):
        row = rows[id(a)]
        if not row:
            continue
        factor = slope(node, i)
        if factor is None:
            continue
        for column, d in row.items():
            terms.setdefault(column, []).append(mul(factor, d))
    return _kept({column: add(*parts) for column, parts in terms.items()})


def _kept(row: dict[int, Expr]) -> Row:
    return {column: d for column, d in row.items() if d is not ZERO}
