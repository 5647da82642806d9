"""Equations that say the same of two variables: ``a = x - y`` and ``b = x - y`` are ``a = x - y`` and ``a = b``.

What lies side by side between the same two points, none of them fixed, then has one difference in common, and not two
that agree but for rounding.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from ..language.flat_model import Family
from ..language.template import Ints
from ..symbolic.expr import Expr

TERMS = 3


def twins(families: Sequence[Family]) -> tuple[list[Family], list[tuple[Family, int]]]:
    """The equations without those that repeat two terms of an earlier one, and what these come to.

    Returns:
        The rest, and families over two variables with the sign between them.
    """
    signs = {k: s for k, f in enumerate(families) if (s := _signs(f.residual)) is not None}
    if not signs:
        return list(families), []
    family = np.concatenate([np.full(families[k].size, k) for k in signs])
    row = np.concatenate([np.arange(families[k].size) for k in signs])
    variables = np.concatenate([families[k].var_rows for k in signs])
    sign = np.concatenate([np.tile(s, (families[k].size, 1)) for k, s in signs.items()])
    pairs = _pairs(variables, sign)
    if not pairs:
        return list(families), []
    found: list[tuple[Family, int]] = []
    gone = {k: np.zeros(families[k].size, bool) for k in signs}
    at, a, b, relation = np.array(pairs, np.int64).T
    for k in signs:
        gone[k][row[at[family[at] == k]]] = True
        for sign_between in (1, -1):
            mine = (family[at] == k) & (relation == sign_between)
            if mine.any():
                same = families[k].select(row[at[mine]])
                found.append((replace(same, var_rows=np.stack([a[mine], b[mine]], axis=1)), sign_between))
    rest = [f.select(np.flatnonzero(~gone[k])) if k in gone and gone[k].any() else f for k, f in enumerate(families)]
    return rest, found


def _signs(residual: Expr) -> Ints | None:
    """Signs of the variables of a sum of three, None for other equations."""
    if residual.op != "add" or len(residual.args) != TERMS:
        return None
    signs = np.zeros(TERMS, np.int64)
    for term in residual.args:
        leaf = term.args[0] if term.op == "neg" else term
        if leaf.op != "var" or leaf.value >= TERMS:
            return None
        signs[leaf.value] = -1 if term.op == "neg" else 1
    return signs if signs.all() else None


def _pairs(variables: Ints, sign: Ints) -> list[tuple[int, int, int, int]]:
    """(row, a, b, relation): a row that repeats two terms of an earlier one, and so says ``a = relation * b``."""
    n = len(variables)
    keys: list[Ints] = []
    for slot in range(TERMS):
        rest = np.array([k for k in range(TERMS) if k != slot])
        order = np.argsort(variables[:, rest], axis=1, kind="stable")
        names = np.take_along_axis(variables[:, rest], order, axis=1)
        signs = np.take_along_axis(sign[:, rest], order, axis=1)
        own = sign[:, slot] * signs[:, 0]
        alike = [names[:, 0], names[:, 1], signs[:, 0] * signs[:, 1]]
        keys.append(np.stack([*alike, np.arange(n), variables[:, slot], own], axis=1))
    table = np.concatenate(keys)
    table = table[np.lexsort((table[:, 3], table[:, 2], table[:, 1], table[:, 0]))]
    same = (table[1:, :3] == table[:-1, :3]).all(axis=1)
    starts = np.flatnonzero(same & np.r_[True, ~same[:-1]]) if len(same) else np.zeros(0, np.int64)
    gone: set[int] = set()
    found: list[tuple[int, int, int, int]] = []
    for start in starts[np.argsort(table[starts, 3], kind="stable")].tolist():
        end = start + 1
        while end < len(table) and same[end - 1]:
            end += 1
        heads = [k for k in range(start, end) if int(table[k, 3]) not in gone]
        for k in heads[1:]:
            (_, _, _, i, a, mine), (_, _, _, _, b, its) = table[k].tolist(), table[heads[0]].tolist()
            if a != b and i not in gone:
                gone.add(i)
                found.append((i, a, b, mine * its))
    return found
