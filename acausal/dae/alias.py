"""Alias sets: variables that are equal up to sign, or zero, by equations `a = b`, `a = -b` and `v = 0`.

Every variable `v` is two nodes, `+v` and `-v`, of a graph with one more node for zero; an equation joins nodes that are
equal. Connected components of this double cover are the signed sets (the signed graphs of F. Harary, *On the notion of
balance of a signed graph*, Michigan Math. J. 2 (1953) 143-146; a set is zero where the graph is unbalanced, because
`a = -a`). Redundant equations are found by union-find with signs: R. E. Tarjan, *Efficiency of a good but not linear
set union algorithm*, J. ACM 22 (1975) 215-225.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from acausal.dae.incidence import BoolArray, IntArray


@dataclass(frozen=True, eq=False)
class AliasSets:
    """Result of `alias_sets`: variable `v` equals `sign[v]` times variable `representative[v]`.

    Attributes:
        representative: Variable that stands for each variable, itself if it stays, shape `(n_variables,)`. Variables
            that are zero point to themselves.
        sign: +1 or -1, and 0 for a variable that is zero, shape `(n_variables,)`.
        is_zero: Variables eliminated as zero, shape `(n_variables,)`.
        redundant_edges: Equations that follow from earlier ones, ascending; numbered as the edges first and the zero
            equations after them.
        contradictory_edges: Equations (same numbering) that, by their sign, force a whole set to zero (`a = b` and
            later `a = -b`). They are needed, but seldom meant.
        kept_pairs: Kept variables that share a set with another representative: rows `(k, representative, sign)`,
            shape `(n_pairs, 3)`, by `k`. The equation `k = sign * representative` has to stay. In a zero set the row
            is `(k, k, 0)` and the equation `k = 0`.
    """

    representative: IntArray
    sign: IntArray
    is_zero: BoolArray
    redundant_edges: IntArray
    contradictory_edges: IntArray
    kept_pairs: IntArray

    @property
    def eliminated(self) -> BoolArray:
        """Variables that another one (or zero) stands for, shape `(n_variables,)`."""
        return self.is_zero | (self.representative != np.arange(len(self.representative)))


def alias_sets(
    n_variables: int,
    edge_a: IntArray,
    edge_b: IntArray,
    edge_sign: IntArray,
    zero: IntArray,
    keep: BoolArray | None = None,
    rank: IntArray | None = None,
) -> AliasSets:
    """Merge variables by the equations `a = sign * b` and `v = 0`.

    The number of variables eliminated equals the number of equations that are not redundant, less one equation for
    each of `kept_pairs`.

    Args:
        n_variables: Number of variables.
        edge_a: Left variable of each equation, shape `(n_edges,)`.
        edge_b: Right variable of each equation, shape `(n_edges,)`.
        edge_sign: +1 or -1, shape `(n_edges,)`.
        zero: Variable of each equation `v = 0`, shape `(n_zero,)`.
        keep: Variables that must not be merged with each other (because they are differentiated), shape
            `(n_variables,)`. A set with kept variables is represented by one of them.
        rank: Preference for representing a set, lowest first, shape `(n_variables,)`; ties go to the lowest number.

    Raises:
        ValueError: If a sign is not +1 or -1.

    >>> a = alias_sets(5, np.array([0, 1]), np.array([1, 2]), np.array([1, -1]), zero=np.array([4]))
    >>> a.representative.tolist(), a.sign.tolist()
    ([0, 0, 0, 3, 4], [1, 1, -1, 1, 0])
    >>> keep = np.array([False, True, True, False, False])
    >>> a = alias_sets(5, np.array([0, 1]), np.array([1, 2]), np.array([1, -1]), np.array([4]), keep)
    >>> a.representative.tolist(), a.kept_pairs.tolist()  # 1 and 2 both stay, with the equation v2 = -v1
    ([1, 1, 2, 3, 4], [[2, 1, -1]])
    """
    n = n_variables
    a, b, s, z = (np.asarray(x, dtype=np.int64) for x in (edge_a, edge_b, edge_sign, zero))
    if not bool(np.all(np.abs(s) == 1)):
        raise ValueError("Every edge_sign must be +1 or -1.")
    kept = np.zeros(n, dtype=np.bool_) if keep is None else np.asarray(keep, dtype=np.bool_)
    preference = np.zeros(n, dtype=np.int64) if rank is None else np.asarray(rank, dtype=np.int64)
    variables = np.arange(n, dtype=np.int64)

    positive, negative, zero_component = _double_cover(n, a, b, s, z)
    in_zero_set = positive == negative
    first = np.full(2 * n + 1, 2 * n + 1, dtype=np.int64)
    name = np.minimum(positive, negative)  # the same number for all variables of a set

    # Best variable of each set: kept first, then by rank, then by number.
    order = np.lexsort((variables, preference, ~kept, name))
    heads = order[np.concatenate((np.ones(min(n, 1), dtype=np.bool_), name[order][1:] != name[order][:-1]))]
    first[name[heads]] = heads
    representative = first[name]
    sign = np.where(positive == positive[representative], 1, -1).astype(np.int64)

    others = np.flatnonzero(kept & (in_zero_set | (representative != variables)))
    partner = np.where(in_zero_set[others], others, representative[others])
    kept_pairs = np.stack((others, partner, np.where(in_zero_set[others], 0, sign[others])), axis=1)
    representative = np.where(in_zero_set, variables, representative)
    representative[others], sign[others] = others, 1
    is_zero = in_zero_set & ~kept
    sign[is_zero] = 0

    needed = _needed(name, in_zero_set, 2 * n + 1)
    given = np.bincount(np.concatenate((name[a], name[z])), minlength=2 * n + 1)
    unbalanced = np.zeros(2 * n + 1, dtype=np.bool_)
    unbalanced[name[in_zero_set & (positive != zero_component)]] = True
    suspect = (given > needed) | unbalanced
    redundant, contradictory = _redundant(n, a, b, s, z, suspect[name])
    return AliasSets(representative, sign, is_zero, redundant, contradictory, kept_pairs)


def _double_cover(n: int, a: IntArray, b: IntArray, s: IntArray, z: IntArray) -> tuple[IntArray, IntArray, int]:
    """Component of `+v` and of `-v` for each variable, and of zero."""
    source = np.concatenate((a, a + n, z, z + n))
    same = s > 0
    target = np.concatenate((np.where(same, b, b + n), np.where(same, b + n, b), np.full(2 * len(z), 2 * n)))
    size = 2 * n + 1
    graph = sparse.coo_array((np.ones(len(source), dtype=np.int8), (source, target)), shape=(size, size))
    _, label = csgraph.connected_components(graph.tocsr(), directed=False)
    component = np.asarray(label, dtype=np.int64)
    return component[:n], component[n : 2 * n], int(component[2 * n])


def _needed(name: IntArray, in_zero_set: BoolArray, size: int) -> IntArray:
    """Number of independent equations of each set: one less than its variables, or as many if it is zero."""
    count = np.bincount(name, minlength=size)
    is_zero = np.zeros(size, dtype=np.bool_)
    is_zero[name[in_zero_set]] = True
    return np.where(is_zero, count, np.maximum(count - 1, 0))


def _redundant(
    n: int, a: IntArray, b: IntArray, s: IntArray, z: IntArray, suspect: BoolArray
) -> tuple[IntArray, IntArray]:
    """Go through the equations of the suspect sets in creation order; signed union-find with path halving."""
    edges = np.flatnonzero(suspect[a]) if len(a) else np.zeros(0, dtype=np.int64)
    zeros = np.flatnonzero(suspect[z]) if len(z) else np.zeros(0, dtype=np.int64)
    parent: dict[int, tuple[int, int]] = {}  # variable -> (variable above it, sign)
    null: dict[int, bool] = {}  # roots whose set is zero

    def find(v: int) -> tuple[int, int]:
        sign = 1
        while True:
            up, s1 = parent.get(v, (v, 1))
            if up == v:
                return v, sign
            top, s2 = parent.get(up, (up, 1))
            parent[v] = (top, s1 * s2)
            v, sign = top, sign * s1 * s2

    redundant: list[int] = []
    contradictory: list[int] = []
    for k, va, vb, sab in zip(edges.tolist(), a[edges].tolist(), b[edges].tolist(), s[edges].tolist(), strict=True):
        (ra, sa), (rb, sb) = find(va), find(vb)
        if ra != rb:  # va = sa*ra and vb = sb*rb, so ra = sa*sab*sb*rb
            if null.get(ra, False) and null.get(rb, False):
                redundant.append(k)  # both were zero before
            low, high = min(ra, rb), max(ra, rb)
            parent[high] = (low, sa * sab * sb)
            null[low] = null.get(ra, False) or null.get(rb, False)
        elif null.get(ra, False) or sa == sab * sb:
            redundant.append(k)
        else:
            null[ra] = True
            contradictory.append(k)
    for k, v in zip(zeros.tolist(), z[zeros].tolist(), strict=True):
        root, _ = find(v)
        if null.get(root, False):
            redundant.append(len(a) + k)
        null[root] = True
    return np.array(redundant, dtype=np.int64), np.array(contradictory, dtype=np.int64)
