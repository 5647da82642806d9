"""C text of operators: on numbers, and the factors of their tangents."""

from __future__ import annotations

from collections.abc import Iterable

from ...errors import AcausalError
from ...language.blackbox import BlackBox, Table
from ...symbolic.expr import Expr

FUNCTIONS = {
    "sin": "sin", "cos": "cos", "tan": "tan", "asin": "asin", "acos": "acos", "atan": "atan", "atan2": "atan2",
    "sinh": "sinh", "cosh": "cosh", "tanh": "tanh", "asinh": "asinh", "sqrt": "sqrt", "exp": "exp", "log": "log",
    "log10": "log10", "abs": "fabs", "floor": "floor", "ceil": "ceil", "sign": "ac_sign", "min": "ac_min",
    "max": "ac_max", "clip": "ac_clip", "mod": "ac_mod", "pow": "pow",
}  # fmt: skip
"""Operators that are calls of a function of the C library or of the runtime."""

INFIX = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "and": "&&", "or": "||", "mul": "*", "div": "/"}
CONDITIONS = frozenset({"lt", "le", "gt", "ge", "eq", "and", "or", "not"})
COST = {"div": 4, "sqrt": 6, "pow": 40, "mod": 12} | dict.fromkeys(
    ["sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sinh", "cosh", "tanh", "asinh", "exp", "log", "log10"], 20
)
"""Rough costs of operators, in multiplications."""


class NotInC(AcausalError):
    """A model has something that cannot be written in C."""


def number(value: float) -> str:
    """A number that reads back exactly."""
    if value != value:
        return "NAN"
    if value in (float("inf"), float("-inf")):
        return "INFINITY" if value > 0 else "(-INFINITY)"
    text = repr(float(value))
    return f"({text})" if text.startswith("-") else text


def value_text(node: Expr, args: list[str]) -> str:
    """C expression of one operator on the texts of its operands.

    Raises:
        NotInC: a function that the user gave as Python.
    """
    op = node.op
    if op == "add":
        terms = [_term(a, text, first=i == 0) for i, (a, text) in enumerate(zip(node.args, args, strict=True))]
        return "(" + "".join(terms) + ")"
    if op == "neg":
        return f"(-{args[0]})"
    if op == "not":
        return f"(!{args[0]})"
    if op in INFIX:
        return f"({args[0]} {INFIX[op]} {args[1]})"
    if op == "where":
        return f"({args[0]} ? {args[1]} : {args[2]})"
    if op == "call":
        return call_text(node, args)
    return f"{FUNCTIONS[op]}({', '.join(args)})"


def call_text(node: Expr, args: list[str]) -> str:
    """A table; any other function of the user's is Python."""
    box: BlackBox = node.value
    if not isinstance(box, Table):
        raise NotInC(f"the function `{box.name}` is Python: only the diffrax engine can call it")
    x, y = (", ".join(number(v) for v in values) for values in (box.x, box.y))
    n = len(box.x)
    kind = ("ac_table", "ac_table_slope")[len(box.order)] if len(box.order) < 2 else None
    return "0.0" if kind is None else f"{kind}({n}, (const double[]){{{x}}}, (const double[]){{{y}}}, {args[0]})"


def _term(node: Expr, text: str, *, first: bool) -> str:
    """One term of a sum, with its sign."""
    if node.op == "neg" and text.startswith("(-"):
        return f"-{text[2:-1]}" if first else f" - {text[2:-1]}"
    if node.op == "const" and node.value < 0 and not first:
        return f" - {number(-node.value)}"
    return text if first else f" + {text}"


def braces(head: str, lines: Iterable[str]) -> str:
    """A C function."""
    return "\n".join([head + " {", *("    " + line for line in lines), "}"])


def array(kind: str, name: str, values: list[int] | list[float]) -> str:
    """A constant C array."""
    text = ", ".join(number(v) if kind == "double" else str(v) for v in values) or "0"
    return f"AC_UNUSED static const {kind} {name}[{max(len(values), 1)}] = {{{text}}};"
