"""Functions for expressions. They also accept plain numbers and declarations of the class body."""

from __future__ import annotations

import builtins
from typing import Final, overload

from ..symbolic.expr import PI as PI
from ..symbolic.expr import TIME, Expr, Operand, as_expr, make
from .vectors import Vector, vector

time: Final[Expr] = TIME
"""The independent variable [s]."""


def _apply(op: str, *args: Operand) -> Expr:
    return make(op, tuple(as_expr(a) for a in args))


@overload
def der(x: Vector) -> Vector: ...  # type: ignore[overload-overlap]
@overload
def der(x: Operand) -> Expr: ...
def der(x: Operand | Vector) -> Expr | Vector:
    """Derivative of any expression with respect to time; of a vector, element by element."""
    return vector(*(_apply("der", e) for e in x)) if isinstance(x, Vector) else _apply("der", x)


def sin(x: Operand) -> Expr:
    """Sine; x in rad."""
    return _apply("sin", x)


def cos(x: Operand) -> Expr:
    """Cosine; x in rad."""
    return _apply("cos", x)


def tan(x: Operand) -> Expr:
    """Tangent; x in rad."""
    return _apply("tan", x)


def asin(x: Operand) -> Expr:
    """Inverse sine [rad]."""
    return _apply("asin", x)


def acos(x: Operand) -> Expr:
    """Inverse cosine [rad]."""
    return _apply("acos", x)


def atan(x: Operand) -> Expr:
    """Inverse tangent [rad]."""
    return _apply("atan", x)


def atan2(y: Operand, x: Operand) -> Expr:
    """Angle of the point (x, y) [rad]."""
    return _apply("atan2", y, x)


def sinh(x: Operand) -> Expr:
    """Hyperbolic sine."""
    return _apply("sinh", x)


def cosh(x: Operand) -> Expr:
    """Hyperbolic cosine."""
    return _apply("cosh", x)


def tanh(x: Operand) -> Expr:
    """Hyperbolic tangent."""
    return _apply("tanh", x)


def asinh(x: Operand) -> Expr:
    """Inverse hyperbolic sine."""
    return _apply("asinh", x)


def sqrt(x: Operand) -> Expr:
    """Square root."""
    return _apply("sqrt", x)


def exp(x: Operand) -> Expr:
    """Exponential."""
    return _apply("exp", x)


def log(x: Operand) -> Expr:
    """Natural logarithm."""
    return _apply("log", x)


def log10(x: Operand) -> Expr:
    """Logarithm to base 10."""
    return _apply("log10", x)


def abs(x: Operand) -> Expr:
    """Magnitude."""
    return _apply("abs", x)


def sign(x: Operand) -> Expr:
    """-1, 0 or 1."""
    return _apply("sign", x)


def floor(x: Operand) -> Expr:
    """Largest integer not above x."""
    return _apply("floor", x)


def ceil(x: Operand) -> Expr:
    """Smallest integer not below x."""
    return _apply("ceil", x)


def mod(a: Operand, b: Operand) -> Expr:
    """Remainder with the sign of b."""
    return _apply("mod", a, b)


def min(*args: Operand) -> Expr:
    """Smallest of its arguments."""
    return _fold("min", args)


def max(*args: Operand) -> Expr:
    """Largest of its arguments."""
    return _fold("max", args)


def _fold(op: str, args: tuple[Operand, ...]) -> Expr:
    if builtins.len(args) < 2:
        raise TypeError(f"acausal.{op} needs two arguments or more")
    result = as_expr(args[0])
    for a in args[1:]:
        result = make(op, (result, as_expr(a)))
    return result


def clip(x: Operand, lo: Operand, hi: Operand) -> Expr:
    """x limited to [lo, hi]."""
    return _apply("clip", x, lo, hi)


def where(condition: Operand, a: Operand, b: Operand) -> Expr:
    """a where the condition holds, else b."""
    return _apply("where", condition, a, b)
