"""Solve an equation for one unknown: affine, or a chain of one-to-one operators. Never a general solver."""

from __future__ import annotations

import enum
from collections.abc import Callable
from dataclasses import dataclass

from .differentiate import partial
from .expr import ONE, ZERO, Expr, add, const, div, make, mul, neg, power
from .operators import OPERATORS
from .traverse import contains, leaves, postorder, substitute

LEFT_INVERSES: dict[str, Callable[[Expr], Expr]] = {
    "exp": lambda y: make("log", (y,)),
    "log10": lambda y: power(const(10.0), y),
    "sqrt": lambda y: mul(y, y),
    "asin": lambda y: make("sin", (y,)),
    "acos": lambda y: make("cos", (y,)),
    "atan": lambda y: make("tan", (y,)),
    "tanh": lambda y: mul(const(0.5), make("log", (div(add(ONE, y), add(ONE, neg(y))),))),
}
"""x from y = f(x), for functions whose range is not all numbers: where it is left, there is no x."""


class Solvability(enum.IntEnum):
    """How an equation can be solved for an unknown (Otter and Elmqvist 1994); the smaller the better."""

    CONSTANT = 0
    """affine, the coefficient is a non-zero number"""
    PARAMETER = 1
    """affine, the coefficient depends on parameters only"""
    VARIABLE = 2
    """affine, the coefficient depends on variables or time: it may pass through zero"""
    INVERTIBLE = 3
    """the unknown occurs once, under one-to-one operators"""
    NONLINEAR = 4


@dataclass(frozen=True, slots=True, eq=False)
class Isolated:
    """`unknown = solution`, valid while `coefficient` is not zero."""

    solution: Expr | None
    coefficient: Expr
    solvability: Solvability


def isolate(residual: Expr, unknown: Expr) -> Isolated:
    """Solve ``residual == 0`` for `unknown` (a leaf)."""
    slope = partial(residual, unknown)
    if not contains(slope, unknown):
        if slope is ZERO:
            return Isolated(None, slope, Solvability.NONLINEAR)
        rest = substitute(residual, {unknown: ZERO})
        return Isolated(_quotient(rest, slope), slope, _class_of(slope))
    solution = invert(residual, unknown)
    if solution is None:
        return Isolated(None, slope, Solvability.NONLINEAR)
    return Isolated(solution, slope, Solvability.INVERTIBLE)


def _quotient(rest: Expr, slope: Expr) -> Expr:
    return neg(div(rest, slope))


def _class_of(slope: Expr) -> Solvability:
    if slope.op == "const":
        return Solvability.CONSTANT
    if any(n.op == "where" and (n.args[1] is ZERO or n.args[2] is ZERO) for n in postorder((slope,))):
        return Solvability.VARIABLE  # in one of its modes it vanishes
    kinds = {leaf.op for leaf in leaves(slope)}
    return Solvability.PARAMETER if kinds <= {"par"} else Solvability.VARIABLE


def invert(residual: Expr, unknown: Expr, *, ranges: bool = False) -> Expr | None:
    """Peel one-to-one operators off the one term that holds the unknown (a leaf or any node).

    With `ranges` also those that do not take all values: what comes out holds wherever ``residual == 0`` does.
    """
    node, other = residual, ZERO  # invariant: node == other
    while node is not unknown:
        holding = [i for i, a in enumerate(node.args) if contains(a, unknown)]
        odd = _odd_power(node, unknown) if len(holding) == 2 else None
        if odd is not None:
            node, rest, inverse = odd
            other = inverse(div(other, rest))
            continue
        if len(holding) != 1:
            return None
        i = holding[0]
        if node.op == "add":
            other = add(other, *(neg(a) for j, a in enumerate(node.args) if j != i))
        elif node.op == "mul":
            other = div(other, node.args[1 - i])
        elif node.op == "div":
            if i == 1 and other is ZERO:  # a quotient is zero for no finite denominator
                return None
            other = other * node.args[1] if i == 0 else div(node.args[0], other)
        elif ranges and node.op == "pow" and i == 0 and node.args[1].op == "const" and node.args[1].value % 2 == 1:
            root = power(make("abs", (other,)), const(1 / node.args[1].value))
            other = mul(make("sign", (other,)), root)
        else:
            inverse = OPERATORS[node.op].inverse if node.op in OPERATORS else None
            if inverse is None and ranges:
                inverse = LEFT_INVERSES.get(node.op)
            if inverse is None:
                return None
            other = inverse(other)
        node = node.args[i]
    return other


def _odd_power(node: Expr, unknown: Expr) -> tuple[Expr, Expr, Callable[[Expr], Expr]] | None:
    """The product of k and an odd power of x, written with ``abs(x)`` or ``sign(x)``, as laws of flow are.

    Returns:
        x, which alone contains `unknown`; k; and x as a function of the power.
    """
    held: dict[str, Expr] = {}
    count, rest, pending = 0, ONE, [node]
    while pending:
        factor = pending.pop()
        if not contains(factor, unknown):
            rest = mul(rest, factor)
        elif factor.op == "mul":
            pending += factor.args
        elif factor.op == "div" and not contains(factor.args[1], unknown):
            pending.append(factor.args[0])
            rest = div(rest, factor.args[1])
        else:
            held[factor.op if factor.op in ("abs", "sign") else ""] = factor
            count += 1
    if count != 2 or "" not in held or len(held) != 2:
        return None
    other = held[""]
    if "abs" in held:
        return (other, rest, _signed_root) if held["abs"].args[0] is other else None
    x = held["sign"].args[0]
    if other is power(x, const(2.0)):
        return x, rest, _signed_root
    size = make("abs", (x,))
    if other is make("sqrt", (size,)) or other is power(size, const(0.5)):
        return x, rest, _signed_square
    return None


def _signed_root(y: Expr) -> Expr:
    return mul(make("sign", (y,)), make("sqrt", (make("abs", (y,)),)))


def _signed_square(y: Expr) -> Expr:
    return mul(y, make("abs", (y,)))
