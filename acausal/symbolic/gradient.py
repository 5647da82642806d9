"""Numerical gradients by reverse accumulation on the DAG: all leaves at once, at the cost of a few evaluations
(Griewank and Walther 2008, Evaluating Derivatives, ch. 3)."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from .expr import Expr
from .operators import OPERATORS
from .traverse import apply, postorder_missing

LARGEST_EXPONENT = 5.0
CANCELLED = 1e-13
"""A sum is zero if it is this small relative to its terms: in general position, what remains is rounding."""


class Sampler:
    """Values of expressions in general position: which branch a ``where`` takes is chosen from outside, opaque
    functions have arbitrary values (their derivatives too), exponentials are kept to sizes that rank decisions in
    floating-point numbers can bear, and sums whose terms cancel are exactly zero.

    Args:
        leaf: value of a leaf other than a constant: a number, or an array with one element per point.
        branch: called for the condition of each ``where``: True for its first branch, False for the second.
        opaque: called for the value of each opaque function.
    """

    def __init__(self, leaf: Callable[[Expr], Any], branch: Callable[[], bool], opaque: Callable[[], float]) -> None:
        self.leaf = leaf
        self.branch = branch
        self.opaque = opaque
        self.memo: dict[int, Any] = {}
        self.alive: list[Expr] = []
        self.choice: dict[int, bool] = {}

    def values(self, roots: Sequence[Expr]) -> list[Any]:
        """Values of `roots`."""
        self.alive.extend(roots)
        with np.errstate(all="ignore"):
            for node in postorder_missing(list(roots), self.memo):
                self.memo[id(node)] = self._value(node)
        return [self.memo[id(root)] for root in roots]

    def _value(self, node: Expr) -> Any:
        if node.op == "const":
            return node.value
        if node.op == "call":
            return self.opaque()
        if not node.args:
            return self.leaf(node)
        args = [self.memo[id(a)] for a in node.args]
        if node.op in ("exp", "sinh", "cosh", "tanh"):
            args = [_moderate(args[0])]
        if node.op == "add":
            return _total(args)
        if node.op == "where":
            return args[1] if self._choose(node) else args[2]
        if node.op == "div":
            return np.divide(*args)
        if node.op == "pow":
            return np.power(np.asarray(args[0], float), args[1])
        return apply(node, args, np)

    def _choose(self, node: Expr) -> bool:
        condition = id(node.args[0])
        if condition not in self.choice:
            self.choice[condition] = self.branch()
        return self.choice[condition]

    def gradient(self, root: Expr) -> dict[Expr, Any]:
        """Partial derivatives of `root` with respect to all its leaves."""
        self.values((root,))
        order = postorder_missing([root], {})
        adjoint: dict[int, Any] = {id(root): 1.0}
        with np.errstate(all="ignore"):
            for node in reversed(order):
                flow = adjoint.get(id(node))
                if flow is None or not node.args:
                    continue
                for i, slope in self._slopes(node):
                    a = id(node.args[i])
                    part = flow * slope
                    adjoint[a] = _total([adjoint[a], part]) if a in adjoint else part
        return {node: adjoint.get(id(node), 0.0) for node in order if not node.args and node.op != "const"}

    def _slopes(self, node: Expr) -> list[tuple[int, Any]]:
        if node.op == "add":
            return [(i, 1.0) for i in range(len(node.args))]
        if node.op == "where":
            return [(1 if self._choose(node) else 2, 1.0)]
        if node.op == "call":
            rules = [node.value.partial(i, node.args) for i in range(len(node.args))]
            return list(enumerate(self.values(rules)))
        pairs = [(i, rule(*node.args)) for i, rule in enumerate(OPERATORS[node.op].partials) if rule is not None]
        return list(zip((i for i, _ in pairs), self.values([e for _, e in pairs]), strict=True))


def _total(terms: Sequence[Any]) -> Any:
    """The sum of the terms, exactly zero where they cancel."""
    total, size = terms[0], np.abs(terms[0])
    for term in terms[1:]:
        total, size = total + term, size + np.abs(term)
    return np.where(np.abs(total) <= CANCELLED * size, 0.0, total)


def _moderate(exponent: Any) -> Any:
    """The exponent if it is small, else some number that is; equal ones stay equal, and opposite ones opposite."""
    return np.where(np.abs(exponent) <= LARGEST_EXPONENT, exponent, LARGEST_EXPONENT * np.sin(exponent))
