"""The one table of operators: evaluation, partial derivatives, inverse, unit rule, text and LaTeX.

Adding an operator is one row.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

from .expr import MINUS_ONE, ONE, ZERO, Expr, add, const, div, make, mul, neg, power

Partial = Callable[..., Expr]


@dataclass(frozen=True, slots=True)
class Operator:
    """One operator.

    Attributes:
        name: name of the operator in `Expr.op`.
        array: name of the function in `numpy` and `jax.numpy`.
        scalar: the same on Python floats (constant folding); None if the operator does not fold.
        partials: per operand, the partial derivative as a function of the operands; None where it is zero.
        inverse: for one-to-one functions of one operand, x as a function of y.
        units: rule for the unit check: ``same`` (all operands alike, result like them), ``dimensionless``,
            ``condition``, or the operator's own name when it needs its own rule.
        latex: LaTeX macro.
    """

    name: str
    array: str
    scalar: Callable[..., Any] | None
    partials: tuple[Partial | None, ...]
    inverse: Callable[[Expr], Expr] | None = None
    units: str = "dimensionless"
    latex: str = ""


def _f(op: str, *args: Expr) -> Expr:
    return make(op, args)


def _indicator(condition: Expr) -> Expr:
    return make("where", (condition, ONE, ZERO))


def _sign(x: float) -> float:
    return math.copysign(1.0, x) if x != 0 else 0.0


def _pow_base(a: Expr, b: Expr) -> Expr:
    return mul(b, power(a, add(b, MINUS_ONE)))


def _pow_exponent(a: Expr, b: Expr) -> Expr:
    """At a = 0 the limit for b > 0, where the logarithm alone is infinite."""
    return mul(power(a, b), _f("log", make("where", (a * a > 0.0, a, ONE))))


_ROWS: Final = [
    Operator("neg", "negative", lambda x: -x, (lambda x: MINUS_ONE,), neg, "same"),
    Operator("mul", "multiply", lambda a, b: a * b, (lambda a, b: b, lambda a, b: a), None, "mul"),
    Operator("div", "divide", None, (lambda a, b: div(ONE, b), lambda a, b: neg(div(a, mul(b, b)))), None, "div"),
    Operator("pow", "power", None, (_pow_base, _pow_exponent), None, "pow"),
    Operator("sin", "sin", math.sin, (lambda x: _f("cos", x),), None, latex=r"\sin"),
    Operator("cos", "cos", math.cos, (lambda x: neg(_f("sin", x)),), None, latex=r"\cos"),
    Operator("tan", "tan", math.tan, (lambda x: add(ONE, power(_f("tan", x), const(2))),), None, latex=r"\tan"),
    Operator("asin", "arcsin", math.asin, (lambda x: div(ONE, _f("sqrt", ONE - x * x)),), None, latex=r"\arcsin"),
    Operator("acos", "arccos", math.acos, (lambda x: div(MINUS_ONE, _f("sqrt", ONE - x * x)),), latex=r"\arccos"),
    Operator("atan", "arctan", math.atan, (lambda x: div(ONE, ONE + x * x),), None, latex=r"\arctan"),
    Operator(
        "atan2", "arctan2", math.atan2,
        (lambda y, x: div(x, x * x + y * y), lambda y, x: neg(div(y, x * x + y * y))),
        None, "atan2", r"\operatorname{atan2}",
    ),
    Operator("sinh", "sinh", math.sinh, (lambda x: _f("cosh", x),), lambda y: _f("asinh", y), latex=r"\sinh"),
    Operator("cosh", "cosh", math.cosh, (lambda x: _f("sinh", x),), None, latex=r"\cosh"),
    Operator("tanh", "tanh", math.tanh, (lambda x: ONE - power(_f("tanh", x), const(2)),), None, latex=r"\tanh"),
    Operator("asinh", "arcsinh", math.asinh, (lambda x: div(ONE, _f("sqrt", x * x + 1.0)),), lambda y: _f("sinh", y),
             latex=r"\operatorname{asinh}"),
    Operator("sqrt", "sqrt", math.sqrt, (lambda x: div(const(0.5), _f("sqrt", x)),), None, "sqrt", r"\sqrt"),
    Operator("exp", "exp", math.exp, (lambda x: _f("exp", x),), None, latex=r"\exp"),
    Operator("log", "log", math.log, (lambda x: div(ONE, x),), lambda y: _f("exp", y), latex=r"\ln"),
    Operator("log10", "log10", math.log10, (lambda x: div(const(1 / math.log(10)), x),),
             lambda y: _f("exp", y * math.log(10)), latex=r"\log_{10}"),
    Operator("abs", "abs", abs, (lambda x: _f("sign", x),), None, "same", r"\operatorname{abs}"),
    Operator("sign", "sign", _sign, (None,), None, "any", r"\operatorname{sign}"),
    Operator("floor", "floor", math.floor, (None,), None, "dimensionless", r"\operatorname{floor}"),
    Operator("ceil", "ceil", math.ceil, (None,), None, "dimensionless", r"\operatorname{ceil}"),
    Operator("mod", "mod", lambda a, b: a % b, (lambda a, b: ONE, lambda a, b: neg(_f("floor", div(a, b)))), None,
             "same", r"\operatorname{mod}"),
    Operator("min", "minimum", min, (lambda a, b: _indicator(a <= b), lambda a, b: _indicator(a > b)), None, "same",
             r"\min"),
    Operator("max", "maximum", max, (lambda a, b: _indicator(a >= b), lambda a, b: _indicator(a < b)), None, "same",
             r"\max"),
    Operator(
        "clip", "clip", lambda x, lo, hi: min(max(x, lo), hi),
        (lambda x, lo, hi: _indicator((x >= lo) & (x <= hi)), lambda x, lo, hi: _indicator(x < lo),
         lambda x, lo, hi: _indicator(x > hi)),
        None, "same", r"\operatorname{clip}",
    ),
    Operator("where", "where", lambda c, a, b: a if c else b,
             (None, lambda c, a, b: _indicator(c), lambda c, a, b: make("where", (c, ZERO, ONE))), None, "where"),
    Operator("lt", "less", lambda a, b: a < b, (None, None), None, "condition", "<"),
    Operator("le", "less_equal", lambda a, b: a <= b, (None, None), None, "condition", r"\le"),
    Operator("gt", "greater", lambda a, b: a > b, (None, None), None, "condition", ">"),
    Operator("ge", "greater_equal", lambda a, b: a >= b, (None, None), None, "condition", r"\ge"),
    Operator("eq", "equal", lambda a, b: a == b, (None, None), None, "condition", "="),
    Operator("and", "logical_and", lambda a, b: bool(a) and bool(b), (None, None), None, "logical", r"\land"),
    Operator("or", "logical_or", lambda a, b: bool(a) or bool(b), (None, None), None, "logical", r"\lor"),
    Operator("not", "logical_not", lambda a: not a, (None,), None, "logical", r"\lnot"),
    # What follows is for hybrid models and is gone before anything is evaluated: see `acausal.passes.events`.
    Operator("pre", "", None, (None,), None, "same", r"\operatorname{pre}"),
    Operator("noevent", "", None, (None,), None, "same", r"\operatorname{noEvent}"),
    Operator("triggered", "", None, (None,), None, "logical", r"\operatorname{edge}"),
    Operator("sample", "", None, (None, None), None, "condition", r"\operatorname{sample}"),
]  # fmt: skip

OPERATORS: Final[dict[str, Operator]] = {row.name: row for row in _ROWS}


def slope(node: Expr, i: int) -> Expr | None:
    """Partial derivative for linearizations: as in the table, but zero where the derivative of a root is infinite.

    A solution that begins at the foot of a root (an empty tank, equal pressures, a speed of zero) leaves it at once or
    stays: its steps need no slope there, and infinity times zero would spoil the equations beside it.

    Args:
        node: an operator on expressions, or a call.
        i: number of the operand.

    Returns:
        The derivative; None where it is zero throughout.
    """
    if node.op == "call":
        return node.value.partial(i, node.args)
    rule = OPERATORS[node.op].partials[i]
    if rule is None:
        return None
    partial = rule(*node.args)
    x = node.args[0]
    if node.op in ("asin", "acos"):
        return make("where", (x * x < 1.0, partial, ZERO))
    if node.op == "sqrt" or (node.op == "pow" and i == 0 and _is_root(node.args[1])):
        return make("where", (x > 0.0, partial, ZERO))
    return partial


def _is_root(exponent: Expr) -> bool:
    return exponent.op == "const" and exponent.value > 0.0 and exponent.value != int(exponent.value)
