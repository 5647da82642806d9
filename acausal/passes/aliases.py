"""Alias elimination: ``a = b``, ``a = -b`` and ``a = 0`` disappear, whole families at a time."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import breadth_first_order

from ..dae.alias import AliasSets, alias_sets
from ..language.declarations import STATE_SELECT, Kind
from ..language.flat_model import Bools, Family, FlatModel
from ..language.template import Ints
from ..symbolic.expr import Expr, add, neg, var
from .specialize import merge, specialize
from .twins import twins

SHOWN = 8
"""Equations named with a redundant one."""


@dataclass(frozen=True, slots=True, eq=False)
class Redundant:
    """An alias equation that adds nothing to the others (or contradicts them).

    Attributes:
        others: the equations it follows from (or contradicts), each with its component and place.
    """

    text: str
    component: str
    place: str
    others: tuple[tuple[str, str, str], ...] = ()


@dataclass(frozen=True, slots=True, eq=False)
class Reduced:
    """The model without aliases.

    Attributes:
        families: remaining equations, over representatives.
        representative: of every variable (itself if it remains).
        sign: ``variable = sign * representative``; 0 for variables that are always zero.
        unknown: mask of the variables (and derivatives) that remain.
        redundant: alias equations that close a cycle.
        rules: derivatives that are known, over representatives.
        consumed: how often equations have been differentiated in the making of an equation, by its source and row
            there; absent where never.
    """

    flat: FlatModel
    families: list[Family]
    representative: Ints
    sign: Ints
    unknown: Bools
    redundant: list[Redundant]
    rules: list[Family]
    consumed: dict[tuple[int, int], int] = field(default_factory=dict[tuple[int, int], int])


@dataclass(slots=True)
class _Edges:
    """Alias equations found so far; the sign of a zero equation is 0."""

    a: Ints
    b: Ints
    sign: Ints
    source: Ints
    ordinal: Ints

    def extend(self, a: Ints, b: Ints, sign: Ints, source: Ints, ordinal: Ints) -> _Edges:
        pairs = zip((self.a, self.b, self.sign, self.source, self.ordinal), (a, b, sign, source, ordinal), strict=True)
        return _Edges(*(np.concatenate(p) for p in pairs))


def eliminate_aliases(flat: FlatModel) -> Reduced:
    """Merge equal variables.

    Of several differentiated variables in one set, a component's own (not those of its connectors) stay apart, with the
    constraint between them as an equation: two masses joined rigidly are a system of index 3, two capacitors in
    parallel of index 2. Differentiated connector variables are merged, and so are their derivatives.
    """
    edges = _Edges(flat.alias_a, flat.alias_b, flat.alias_sign, flat.alias_source, flat.alias_ordinal)
    edges = edges.extend(flat.zero, flat.zero, np.zeros_like(flat.zero), flat.zero_source, flat.zero_ordinal)
    rank = _rank(flat)
    families, found = _detect(merge(flat.families))
    keep = (flat.derivative_of >= 0) | (flat.parent >= 0)
    while True:
        for family, sign in found:
            zero = sign == 0
            b = family.var_rows[:, 0 if zero else 1]
            signs = np.full(family.size, sign)
            edges = edges.extend(family.var_rows[:, 0], b, signs, family.source, family.ordinal)
        edges, keep = _merge_differentiated(flat, edges, keep, rank)
        sets, order = _sets(flat.n_total, edges, keep, rank)
        representative = np.asarray(sets.representative)
        sign = np.where(np.asarray(sets.is_zero), 0, np.asarray(sets.sign)).astype(np.int64)
        families, found = _detect(specialize(families, representative, sign))
        if not found:
            break
    closing = order[np.asarray(sets.redundant_edges, np.int64)]
    redundant = [_redundant(flat, edges, int(e), closing) for e in closing]
    families = merge([*families, *_kept(edges, np.asarray(sets.kept_pairs))])
    unknown = (representative == np.arange(flat.n_total)) & (sign != 0)
    rules = specialize(flat.rules, representative, sign)
    return Reduced(flat, families, representative, sign, unknown, redundant, rules)


def _sets(n: int, edges: _Edges, keep: Bools | None, rank: Ints | None) -> tuple[AliasSets, Ints]:
    """Alias sets, and the edge that each of their equation numbers is."""
    zeros = edges.sign == 0
    link = ~zeros
    sets = alias_sets(n, edges.a[link], edges.b[link], edges.sign[link], edges.a[zeros], keep, rank)
    return sets, np.concatenate([np.flatnonzero(link), np.flatnonzero(zeros)])


def _merge_differentiated(flat: FlatModel, edges: _Edges, keep: Bools, rank: Ints) -> tuple[_Edges, Bools]:
    """Give up the separate life of differentiated variables that repeat another; add edges of their derivatives."""
    base = np.flatnonzero((flat.derivative_of >= 0) & keep & (flat.parent < 0))
    if not len(base):
        return edges, keep
    sets, _ = _sets(flat.n_total, edges, None, None)
    name = np.asarray(sets.representative)
    zero = np.asarray(sets.is_zero)
    own = flat.kind[base] == Kind.VARIABLE
    group = np.where(zero[base], -1, name[base])
    order = np.lexsort((base, rank[base], ~own, group))
    base, own, group = base[order], own[order], group[order]
    first = np.r_[True, group[1:] != group[:-1]]
    head = base[first][np.cumsum(first) - 1]
    give_up = ~own & (~first | (group == -1))
    if not give_up.any():
        return edges, keep
    keep = keep.copy()
    sign = np.asarray(sets.sign)
    a, b = base[give_up], head[give_up]
    relation = np.where(group[give_up] == -1, 0, sign[a] * sign[b])
    keep[a] = False
    da, db = flat.derivative_of[a], np.where(relation == 0, flat.derivative_of[a], flat.derivative_of[b])
    keep[da] = False
    source, ordinal = _blame(edges, a)
    ahead = _Edges(da, db, relation, source, ordinal)
    return ahead.extend(edges.a, edges.b, edges.sign, edges.source, edges.ordinal), keep


def _blame(edges: _Edges, variables: Ints) -> tuple[Ints, Ints]:
    """Source of some alias equation that holds each variable."""
    ends = np.concatenate([edges.a, edges.b])
    order = np.argsort(ends, kind="stable")
    at = order[np.searchsorted(ends[order], variables).clip(0, max(len(ends) - 1, 0))] % len(edges.a)
    return edges.source[at], edges.ordinal[at]


def _rank(flat: FlatModel) -> Ints:
    """Preference for the representative: what the user named most: a start value, then creation order."""
    prefer = STATE_SELECT.index("default") - flat.select.astype(np.int64)
    return prefer * 4 + np.where(flat.fixed == 1, 0, np.where(np.isnan(flat.start), 2, 1))


def _alias_sign(residual: Expr) -> int | None:
    """1 for ``a = b``, -1 for ``a = -b``, 0 for ``a = 0``, None for other equations."""
    if residual.op == "var" or (residual.op == "neg" and residual.args[0].op == "var"):
        return 0
    if residual.op == "add" and len(residual.args) == 2:
        a, b = residual.args
        same = [(x.args[0] if x.op == "neg" else x).op == "var" for x in (a, b)]
        if all(same):
            return 1 if (a.op == "neg") != (b.op == "neg") else -1
    return None


def _detect(families: list[Family]) -> tuple[list[Family], list[tuple[Family, int]]]:
    """The equations that are no equalities, and equalities with the sign between their sides."""
    families, repeated = twins(families)
    rest: list[Family] = []
    found: list[tuple[Family, int]] = []
    for family in families:
        sign = _alias_sign(family.residual)
        if sign is None:
            rest.append(family)
        else:
            found.append((family, sign))
    return rest, [*found, *repeated]


def _kept(edges: _Edges, pairs: Ints) -> list[Family]:
    """Equations ``k = sign * representative`` for differentiated variables that must not be merged."""
    k, representative, sign = pairs.reshape(-1, 3).T
    out: list[Family] = []
    if not len(k):
        return out
    position = {int(v): e for e, v in reversed(list(enumerate(edges.b.tolist())))}
    position.update({int(v): e for e, v in reversed(list(enumerate(edges.a.tolist())))})
    at = np.array([position[int(v)] for v in k], np.int64)
    for s, residual in ((1, add(var(0), neg(var(1)))), (-1, add(var(0), var(1))), (0, var(0))):
        pick = sign == s
        columns = [k[pick]] if s == 0 else [k[pick], representative[pick]]
        rows = np.stack(columns, axis=1)
        none = np.zeros((len(rows), 0), np.int64)
        out.append(Family(residual, rows, none, edges.source[at[pick]], edges.ordinal[at[pick]]))
    return out


def _redundant(flat: FlatModel, edges: _Edges, e: int, closing: Ints) -> Redundant:
    """Edge `e` and the edges that join its ends without those of `closing`."""
    zero = flat.n_total
    a, b = edges.a, np.where(edges.sign == 0, zero, edges.b)
    kept = np.setdiff1d(np.arange(len(a)), closing)
    graph = coo_matrix((np.ones(len(kept)), (a[kept], b[kept])), shape=(zero + 1, zero + 1)).tocsr()
    _, before = breadth_first_order(graph, int(a[e]), directed=False)
    others: list[tuple[str, str, str]] = []
    at = int(b[e])
    while at != int(a[e]) and before[at] >= 0 and len(others) < SHOWN:
        previous = int(before[at])
        found = kept[((a[kept] == at) & (b[kept] == previous)) | ((a[kept] == previous) & (b[kept] == at))]
        others.append(_edge(flat, edges, int(found[0])))
        at = previous
    return Redundant(*_edge(flat, edges, e), tuple(others))


def _edge(flat: FlatModel, edges: _Edges, e: int) -> tuple[str, str, str]:
    """Text, component and place of one alias equation."""
    a, b, sign = flat.name(int(edges.a[e])), flat.name(int(edges.b[e])), int(edges.sign[e])
    source = flat.sources[int(edges.source[e])]
    text = f"{a} = {'0' if sign == 0 else b if sign > 0 else '-' + b}"
    return text, source.component(int(edges.ordinal[e])), str(source.origin)
