"""Expressions as one Python function, for those that are evaluated again and again with few numbers each time.

It does what `traverse.evaluate_in_order` does, node by node, without looking up again what each node is.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from .expr import Expr
from .traverse import apply, as_number

INFIX = {"add": " + ", "mul": " * ", "div": " / "}
NUMBERS = frozenset({"const", "time", "par", "var", "neg", *INFIX})
"""Operators whose values are numbers, never truth values."""

Straight = Callable[[Any, Any, Any, Any, Any], list[Any]]
"""(time, variables, parameters, rows of the variables by column, rows of the parameters) to the values of the roots."""


def straight(order: Iterable[Expr], roots: Iterable[Expr]) -> Straight:
    """The function that evaluates `roots`, whose nodes are given in order, operands first."""
    known: dict[str, Any] = {"apply": apply, "as_number": as_number, "np": np}
    name: dict[int, str] = {}
    lines = ["def straight(t, v, p, variables, parameters):"]

    def bound(value: Any) -> str:
        known[f"k{len(known)}"] = value
        return f"k{len(known) - 1}"

    for node in order:
        operands = [name[id(a)] for a in node.args]
        if node.op == "const":
            name[id(node)] = bound(node.value)
            continue
        if node.op == "call":
            text = f"{bound(node.value)}.evaluate({', '.join([*operands, 'xp=np'])})"
        elif node.op == "time":
            text = "t"
        elif node.op == "par":
            text = f"p[parameters[{node.value}]]"
        elif node.op == "var":
            text = f"v[variables[{node.value}]]"
        elif node.op in INFIX or node.op == "neg":
            terms = [x if a.op in NUMBERS else f"as_number({x})" for a, x in zip(node.args, operands, strict=True)]
            text = f"-{terms[0]}" if node.op == "neg" else INFIX[node.op].join(terms)
        else:
            text = f"apply({bound(node)}, [{', '.join(operands)}], np)"
        name[id(node)] = f"x{len(name)}"
        lines.append(f"    {name[id(node)]} = {text}")
    lines.append(f"    return [{', '.join(name[id(root)] for root in roots)}]")
    exec("\n".join(lines), known)
    return known["straight"]
