"""The schedule evaluated with NumPy, with derivatives: for work that is done once, where compiling would cost more.

Derivatives are forward-mode: each value carries its gradient with respect to a chosen vector, by the operator table's
partial derivatives (Griewank and Walther 2008, Evaluating Derivatives, ch. 3).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ..language.flat_model import Family
from ..language.template import Floats, Ints
from ..symbolic.expr import Expr
from ..symbolic.operators import slope
from ..symbolic.traverse import apply, evaluate, postorder_missing
from .balanced import solve_any
from .held import Held

if TYPE_CHECKING:
    from ..passes.schedule import Group
    from .lowered import Lowered

Dual = tuple[Any, Any]
"""A value, and its gradient with one more axis (or None where it is zero)."""


class NumericRun:
    """Values of all variables at one point, with directional derivatives with respect to z = (x, w).

    Attributes:
        value: (n_ids,) values; nan where not yet computed.
        gradient: (n_ids, n_y).
        residual: residuals of the iterated equations, in the order of the algebraic unknowns.
    """

    def __init__(
        self, lowered: Lowered, t: float, x: Floats, w: Floats, p: Floats, free: Ints, directions: Any = None,
        p_directions: Any = None, t_direction: Any = None, groups: Iterable[Group] | None = None,
        held: Held | None = None,
    ) -> None:  # fmt: skip
        """Derivatives with respect to the states `free` and all of w, or along the columns of `directions` of z.

        With `p_directions` (n_p, n_y) the parameters move too, with `t_direction` (n_y,) time. Only these `groups` of
        the schedule are evaluated if they are given. Values that are `held` stand in the place of what is computed.
        """
        self.t_direction = t_direction
        self.p_directions = p_directions
        self.lowered = lowered
        self.t = np.float64(t)  # divided by, zero is infinity, where Python's own floats raise an error
        self.p = p
        states, tears = lowered.schedule.states, lowered.schedule.tears
        if directions is None:
            directions = np.eye(len(states) + len(tears))[
                :, np.r_[free, len(states) + np.arange(len(tears))].astype(int)
            ]
        self.n_y = directions.shape[1]
        self.value = np.full(lowered.n_ids, np.nan)
        self.gradient = np.zeros((lowered.n_ids, self.n_y))
        self.value[states], self.value[tears] = x, w
        self.gradient[states] = directions[: len(states)]
        self.gradient[tears] = directions[len(states) :]
        self.residual: tuple[Floats, Floats] = np.zeros(len(tears)), np.zeros((len(tears), self.n_y))
        self.place: Ints | None = None
        if held is not None:
            self._hold(held, np.concatenate([states, tears]))
        with np.errstate(all="ignore"):
            for group in lowered.schedule.groups if groups is None else groups:
                self._group(group)

    def _hold(self, held: Held, known: Ints) -> None:
        """Put the values in, and make places for what is computed."""
        free = ~np.isin(held.ids, known)
        ids = held.ids[free]
        self.place = np.full(self.lowered.n_ids, -1, np.int64)
        self.place[ids] = np.arange(len(ids))
        self.value[ids] = held.value[free]
        self.gradient[ids] = 0.0 if held.gradient is None else held.gradient[free]
        self.found: tuple[Floats, Floats] = np.full(len(ids), np.nan), np.zeros((len(ids), self.n_y))

    def _put(self, ids: Ints, value: Any, gradient: Any) -> None:
        """Values of variables; of those that are held, beside what they are."""
        place = None if self.place is None else self.place[ids]
        if place is None or (place < 0).all():
            self.value[ids] = value
            self.gradient[ids] = 0.0 if gradient is None else gradient
            return
        free, kept = place < 0, place >= 0
        value = np.broadcast_to(value, ids.shape)
        gradient = np.broadcast_to(0.0 if gradient is None else gradient, (len(ids), self.n_y))
        self.value[ids[free]], self.gradient[ids[free]] = value[free], gradient[free]
        self.found[0][place[kept]], self.found[1][place[kept]] = value[kept], gradient[kept]

    def computed(self, ids: Ints) -> Dual:
        """Values of variables as they are computed, whether they are held or not, and their gradients."""
        value, gradient = self.value[ids], self.gradient[ids]
        if self.place is not None:
            kept = np.flatnonzero(self.place[ids] >= 0)
            value[kept] = self.found[0][self.place[ids[kept]]]
            gradient[kept] = self.found[1][self.place[ids[kept]]]
        return value, gradient

    def _group(self, group: Group) -> None:
        kernel, rows = group.kernel, group.var_rows
        leaf = self.leaf(rows, group.par_rows)
        if kernel.matrix:
            self._linear(group, leaf)
        for u, expression in kernel.steps:
            self._put(rows[:, u], *evaluate_dual((expression,), leaf)[0])
        if not kernel.residuals:
            return
        position = self.lowered.tear_position[group.unknowns[:, kernel.tears]]
        for at, (value, gradient) in zip(position.T, evaluate_dual(kernel.residuals, leaf), strict=True):
            self.residual[0][at] = value
            self.residual[1][at] = 0.0 if gradient is None else gradient

    def leaf(self, rows: Ints, par_rows: Ints) -> Callable[[Expr], Dual]:
        """Values and gradients of the variables and parameters of some rows."""

        def leaf(node: Expr) -> Dual:
            if node.op == "time":
                return self.t, self.t_direction
            if node.op == "par":
                moved = None if self.p_directions is None else self.p_directions[par_rows[:, node.value]]
                return self.p[par_rows[:, node.value]], moved
            ids = rows[:, node.value]
            return self.value[ids], self.gradient[ids]

        return leaf

    def _linear(self, group: Group, leaf: Callable[[Expr], Dual]) -> None:
        """A linear system and its derivative: A dx = db - dA x."""
        kernel, n, k = group.kernel, group.size, len(group.kernel.matrix)
        flat = [e for line in kernel.matrix for e in line]
        entries = evaluate_dual([*flat, *kernel.rhs], leaf)
        value = np.stack([np.broadcast_to(v, (n,)) for v, _ in entries], axis=1)
        zero = np.zeros((n, self.n_y))
        slope = np.stack([np.broadcast_to(zero if g is None else g, zero.shape) for _, g in entries], axis=1)
        a, b = value[:, : k * k].reshape(n, k, k), value[:, k * k :]
        da, db = slope[:, : k * k].reshape(n, k, k, self.n_y), slope[:, k * k :]
        solution = solve_any(a, b)
        gradient = solve_any(a, db - np.einsum("nijy,nj->niy", da, solution))
        for i, u in enumerate(kernel.tears):
            self._put(group.var_rows[:, u], solution[:, i], gradient[:, i])

    def families(self, families: list[Family]) -> Dual:
        """Residuals of further equations and their gradients."""
        values, gradients = [np.zeros(0)], [np.zeros((0, self.n_y))]
        with np.errstate(all="ignore"):
            for family in families:
                value, gradient = evaluate_dual((family.residual,), self.leaf(family.var_rows, family.par_rows))[0]
                shape = (family.size, self.n_y)
                values.append(np.broadcast_to(np.asarray(value, float), (family.size,)))
                gradients.append(np.zeros(shape) if gradient is None else np.broadcast_to(gradient, shape))
        return np.concatenate(values), np.concatenate(gradients)


def evaluate_dual(roots: Iterable[Expr], leaf: Callable[[Expr], Dual]) -> list[Dual]:
    """Values and gradients of expressions; gradients have one more axis than values."""
    roots = list(roots)
    values: dict[int, Any] = {}
    gradients: dict[int, Any] = {}
    alive: list[Expr] = []  # the nodes of partial derivatives: `values` is keyed by their identity
    for node in postorder_missing(roots, values):
        if node.op == "const":
            values[id(node)], gradients[id(node)] = node.value, None
        elif not node.args:
            values[id(node)], gradients[id(node)] = leaf(node)
        elif node.op == "call":
            values[id(node)] = node.value.evaluate(*(values[id(a)] for a in node.args), xp=np)
            gradients[id(node)] = _chain(node, values, gradients, alive)
        else:
            values[id(node)] = apply(node, [values[id(a)] for a in node.args], np)
            gradients[id(node)] = _chain(node, values, gradients, alive)
    return [(values[id(root)], gradients[id(root)]) for root in roots]


def _chain(node: Expr, values: dict[int, Any], gradients: dict[int, Any], alive: list[Expr]) -> Any:
    """Gradient of an operator by the chain rule."""
    moving = [(i, gradients[id(a)]) for i, a in enumerate(node.args) if gradients[id(a)] is not None]
    if not moving:
        return None
    if node.op == "add":
        return sum(g for _, g in moving)
    if node.op == "neg":
        return -moving[0][1]
    if node.op == "where":
        condition = np.asarray(values[id(node.args[0])])[..., None]
        parts = dict(moving)
        return np.where(condition, parts.get(1, 0.0), parts.get(2, 0.0))
    total: Any = None
    for i, g in moving:
        rule = slope(node, i)
        if rule is None:
            continue
        alive.append(rule)
        factor = np.asarray(evaluate((rule,), _no_leaf, np, values)[0], float)[..., None]
        term = np.where(g == 0.0, 0.0, factor * g)
        total = term if total is None else total + term
    return total


def _no_leaf(node: Expr) -> Any:
    raise AssertionError(f"leaf {node} of a partial derivative has no value")


def is_concrete(tree: Any) -> bool:
    """Whether no leaf is traced by JAX (without importing it if nothing did)."""
    import sys

    if "jax" not in sys.modules:
        return True
    import jax
    import jax.core

    if any(isinstance(leaf, jax.core.Tracer) for leaf in jax.tree.leaves(tree)):
        return False
    return not isinstance(jax.lax.stop_gradient(0.0), jax.core.Tracer)  # an operation that compiles nothing
