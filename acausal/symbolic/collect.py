"""Sums whose terms cancel only when they are collected: ``3 x - 2 x - x``, ``2 (x + y) - 2 x``."""

from __future__ import annotations

import math

from .expr import ONE, ROUNDING, Expr, add, const, mul, neg
from .traverse import postorder

Sum = dict[int, tuple[Expr, float, float]]
"""By identity: a factor, its coefficient, and the size of the numbers that this is the sum of."""


def collected(expression: Expr) -> Expr:
    """The expression without terms that cancel: products of numbers with sums are multiplied out to see it.

    Where nothing cancels it is returned as it is.
    """
    memo: dict[int, Sum] = {}
    for node in postorder((expression,)):
        memo[id(node)] = _sum_of(node, [memo[id(a)] for a in node.args])
    terms = memo[id(expression)].values()
    kept = [(x, c) for x, c, size in terms if not abs(c) <= ROUNDING * size]
    if len(kept) == len(terms):
        return expression
    return add(*(neg(x) if c == -1.0 else mul(const(c), x) for x, c in kept))


def _sum_of(node: Expr, args: list[Sum]) -> Sum:
    if node.op == "const" and math.isfinite(node.value):
        return {id(ONE): (ONE, node.value, abs(node.value))}
    if node.op == "neg":
        return _times(args[0], -1.0)
    if node.op == "add":
        out: Sum = {}
        for arg in args:
            for key, (x, c, size) in arg.items():
                _, before, size_before = out.get(key, (x, 0.0, 0.0))
                out[key] = x, before + c, size_before + size
        return out
    if node.op == "mul" and node.args[0].op == "const":  # numbers come first
        return _times(args[1], node.args[0].value)
    if node.op == "div" and node.args[1].op == "const":
        return _times(args[0], 1.0 / node.args[1].value)
    return {id(node): (node, 1.0, 1.0)}


def _times(of: Sum, factor: float) -> Sum:
    return {key: (x, factor * c, abs(factor) * size) for key, (x, c, size) in of.items()}
