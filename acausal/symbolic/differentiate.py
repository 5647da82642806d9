"""Derivatives by forward automatic differentiation on the DAG.

Sharing is kept; the size stays linear in the number of nodes times the number of directions (Griewank and Walther 2008,
Evaluating Derivatives, ch. 3).
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

from .expr import ONE, ZERO, Expr, add, make, mul
from .operators import OPERATORS
from .traverse import postorder


def differentiate(roots: Iterable[Expr], tangent: Callable[[Expr], Expr]) -> list[Expr]:
    """Directional derivative of `roots`.

    Args:
        roots: expressions.
        tangent: derivative of each leaf in the wanted direction (`ZERO` where it does not move).
    """
    roots = list(roots)
    d: dict[int, Expr] = {}
    for node in postorder(roots):
        if node.op == "const":
            d[id(node)] = ZERO
        elif not node.args:
            d[id(node)] = tangent(node)
        elif node.op == "add":
            d[id(node)] = add(*(d[id(a)] for a in node.args))
        elif node.op == "where":
            condition, a, b = node.args
            d[id(node)] = make("where", (condition, d[id(a)], d[id(b)]))
        else:
            d[id(node)] = add(*_terms(node, d))
    return [d[id(root)] for root in roots]


def _terms(node: Expr, d: dict[int, Expr]) -> list[Expr]:
    moving = [(i, d[id(a)]) for i, a in enumerate(node.args) if d[id(a)] is not ZERO]
    if node.op == "call":
        return [mul(node.value.partial(i, node.args), da) for i, da in moving]
    partials = OPERATORS[node.op].partials
    terms: list[Expr] = []
    for i, da in moving:
        rule = partials[i]
        if rule is not None:
            terms.append(mul(rule(*node.args), da))
    return terms


def partial(root: Expr, leaf: Expr) -> Expr:
    """Partial derivative with respect to one leaf."""
    return differentiate((root,), lambda node: ONE if node is leaf else ZERO)[0]
