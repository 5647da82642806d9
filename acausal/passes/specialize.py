"""Rewrite families after variables were identified: a slot that became zero, changed sign, or coincides with another
slot changes the template, so rows are split by that pattern and each part gets a simplified template."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

import numpy as np

from ..language.flat_model import Family, canonical
from ..language.template import Ints
from ..symbolic.expr import ZERO, Expr, neg, var
from ..symbolic.traverse import substitute


def specialize(families: Iterable[Family], representative: Ints, sign: Ints) -> list[Family]:
    """Replace every variable by ``sign * representative`` (sign 0: the variable is zero), families merged again."""
    out: list[Family] = []
    for family in families:
        out.extend(_split(family, representative, sign))
    return merge(out)


def merge(families: Iterable[Family]) -> list[Family]:
    """Join families with the same template, in order of first occurrence."""
    groups: dict[Expr, list[Family]] = {}
    for family in families:
        if family.size:
            groups.setdefault(family.residual, []).append(family)
    return [_concatenate(residual, parts) for residual, parts in groups.items()]


def _concatenate(residual: Expr, parts: list[Family]) -> Family:
    if len(parts) == 1:
        return parts[0]

    def cat(name: str) -> Any:
        return np.concatenate([getattr(p, name) for p in parts])

    return Family(residual, cat("var_rows"), cat("par_rows"), cat("source"), cat("ordinal"))


def _split(family: Family, representative: Ints, sign: Ints) -> list[Family]:
    rows = representative[family.var_rows]
    signs = sign[family.var_rows]
    k = rows.shape[1]
    if k == 0:
        return [family]
    plain = bool((signs == 1).all())
    if plain and (k == 1 or not (np.diff(np.sort(rows, axis=1), axis=1) == 0).any()):
        return [Family(family.residual, rows, family.par_rows, family.source, family.ordinal)]
    pattern = np.concatenate([signs, _first_occurrence(rows, signs)], axis=1)
    patterns, which = _unique_rows(pattern)
    parts: list[Family] = []
    for p, code in enumerate(patterns):
        pick = np.flatnonzero(which == p)
        residual = substitute(family.residual, _mapping(code[:k], code[k:]))
        form, var_rows, par_rows = canonical(residual, rows[pick], family.par_rows[pick])
        parts.append(Family(form, var_rows, par_rows, family.source[pick], family.ordinal[pick]))
    return parts


def without_repetition(family: Family) -> list[tuple[Ints, Family]]:
    """The family in parts (rows and family) in which no variable has two slots."""
    rows = family.var_rows
    ones = np.ones_like(rows)
    patterns, which = _unique_rows(_first_occurrence(rows, ones)) if rows.size else (rows[:1], np.zeros(len(rows), int))
    parts: list[tuple[Ints, Family]] = []
    for p, first in enumerate(patterns):
        pick = np.flatnonzero(which == p)
        residual = substitute(family.residual, _mapping(ones[0], first))
        form, var_rows, par_rows = canonical(residual, rows[pick], family.par_rows[pick])
        parts.append((pick, Family(form, var_rows, par_rows, family.source[pick], family.ordinal[pick])))
    return parts


def _first_occurrence(rows: Ints, signs: Ints) -> Ints:
    """Per slot, the first slot of the row with the same variable (itself if none)."""
    n, k = rows.shape
    first = np.tile(np.arange(k), (n, 1))
    if n < k:
        for i in range(n):
            seen: dict[int, int] = {}
            for j, (v, s) in enumerate(zip(rows[i].tolist(), signs[i].tolist(), strict=True)):
                if s:
                    first[i, j] = seen.setdefault(v, j)
        return first
    for j in range(1, k):
        for i in range(j - 1, -1, -1):
            same = (rows[:, i] == rows[:, j]) & (signs[:, i] != 0) & (signs[:, j] != 0)
            first[same, j] = first[same, i]
    return first


def _unique_rows(pattern: Ints) -> tuple[Ints, Ints]:
    """Distinct rows in order of first occurrence, and which one each row is."""
    if len(pattern) == 1:
        return pattern, np.zeros(1, np.int64)
    compact = np.ascontiguousarray(pattern.astype(np.int32))
    view = compact.view(np.dtype((np.void, compact.dtype.itemsize * compact.shape[1]))).ravel()
    _, index, inverse = np.unique(view, return_index=True, return_inverse=True)
    order = np.argsort(index)
    rank = np.empty(len(index), np.int64)
    rank[order] = np.arange(len(index))
    return pattern[index[order]], rank[inverse.ravel()]


def _mapping(signs: Ints, first: Ints) -> dict[Expr, Expr]:
    mapping: dict[Expr, Expr] = {}
    for k, (s, f) in enumerate(zip(signs.tolist(), first.tolist(), strict=True)):
        target = var(f)
        mapping[var(k)] = ZERO if s == 0 else target if s > 0 else neg(target)
    return mapping
