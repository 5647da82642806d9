"""Kinks of equations that are differentiated twice: ``abs``, ``min``, ``max``, ``clip`` and linear tables.

Where ``x == abs(sin(time))`` is the place of a mass, its velocity jumps at the kink, and the force on it is an impulse.
Such functions are taken as they are at every moment where nothing depends on their slope; here they become conditions,
so that the solver stops at the kink, and the impulse is found (`impulses`).
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from ..language.blackbox import Table
from ..language.flat_model import Family, FlatModel, canonical
from ..symbolic.expr import Expr, add, const, intern_node, make, mul, neg
from ..symbolic.traverse import leaves, postorder, rewrite_located
from .differentiation import differentiations
from .structure import IndexReduced

TWICE = 2
"""Differentiations from which on the slope of an equation must not jump."""


def kinks_as_conditions(flat: FlatModel, index: IndexReduced) -> FlatModel:
    """`flat` with conditions in the place of functions with kinks, in the equations that `index` differentiates twice.

    What is below `noevent` stays as it is.
    """
    differentiated = _differentiated(index)
    if not differentiated:
        return flat
    families: list[Family] = []
    changed = False
    for family in flat.families:
        keys = zip(family.source.tolist(), family.ordinal.tolist(), strict=True)
        twice = np.array([key in differentiated for key in keys], bool)
        residual = _conditions(family.residual) if twice.any() else family.residual
        if residual is family.residual:
            families.append(family)
            continue
        changed = True
        if not twice.all():
            families.append(family.select(~twice))
        part = family.select(twice)
        form, var_rows, par_rows = canonical(residual, part.var_rows, part.par_rows)
        families.append(Family(form, var_rows, par_rows, part.source, part.ordinal))
    return flat.changed(families=families) if changed else flat


def _differentiated(index: IndexReduced) -> set[tuple[int, int]]:
    """Source and ordinal of the equations that have been differentiated `TWICE` at least."""
    found: set[tuple[int, int]] = set()
    last = np.flatnonzero(index.row_derivative < 0)
    for row, n in zip(last.tolist(), differentiations(index, last).tolist(), strict=True):
        if n >= TWICE:
            family, k = index.rows.locate(row)
            found.add((int(family.source[k]), int(family.ordinal[k])))
    return found


def _conditions(root: Expr) -> Expr:
    """One expression with conditions in the place of its kinks."""
    if not any(_has_kink(node) for node in postorder((root,))):
        return root
    return rewrite_located(root, _replaced)


def _has_kink(node: Expr) -> bool:
    kind = node.op in ("abs", "min", "max", "clip") or (
        node.op == "call" and isinstance(node.value, Table) and not node.value.order
    )
    return kind and any(leaf.op in ("var", "time") for leaf in leaves(*node.args))


def _replaced(node: Expr, args: tuple[Expr, ...], located: bool) -> Expr:
    if not located or not _has_kink(node):
        same = all(a is b for a, b in zip(args, node.args, strict=True))
        return node if same else intern_node(node.op, args, node.value)
    if node.op == "abs":
        return make("where", (args[0] >= 0.0, args[0], neg(args[0])))
    if node.op == "clip":
        x, low, high = args
        return make("where", (x < low, low, make("where", (x > high, high, x))))
    if node.op == "call":
        return _pieces(args[0], node.value)
    first, second = args
    return make("where", (first <= second if node.op == "min" else first >= second, first, second))


def _pieces(x: Expr, table: Table) -> Expr:
    """The table at x as lines, between points, that conditions choose from."""
    points = list(zip(table.x, table.y, strict=True))
    lines = [const(table.y[0])]
    lines += [add(const(a), mul(const((b - a) / (q - p)), x - p)) for (p, a), (q, b) in pairwise(points)]
    return _chosen(x, table.x, [*lines, const(table.y[-1])])


def _chosen(x: Expr, breaks: Sequence[float], pieces: Sequence[Expr]) -> Expr:
    """``pieces[k]`` where ``breaks[k-1] <= x < breaks[k]``; one piece more than breaks."""
    if not breaks:
        return pieces[0]
    middle = len(breaks) // 2
    low = _chosen(x, breaks[:middle], pieces[: middle + 1])
    high = _chosen(x, breaks[middle + 1 :], pieces[middle + 1 :])
    return make("where", (x < breaks[middle], low, high))
