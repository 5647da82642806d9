"""Expressions as text: infix with the fewest parentheses, iterative."""

from __future__ import annotations

from collections.abc import Callable

from .expr import Expr
from .traverse import postorder

_PREC = {"lt": 0, "le": 0, "gt": 0, "ge": 0, "eq": 0, "and": -2, "or": -3}
_INFIX = {"lt": "<", "le": "<=", "gt": ">", "ge": ">=", "eq": "==", "and": "&", "or": "|"}
_ATOM = 9


def path_text(path: tuple[object, ...]) -> str:
    """Dotted name of a path: ``("cells", 0, "p", "v")`` is ``cells[0].p.v``."""
    parts: list[str] = []
    for part in path:
        if isinstance(part, str):
            parts.append(("." if parts else "") + part)
        elif isinstance(part, range):
            parts.append(f"[{part.start}:{part.stop}]" if part.step == 1 else f"[{part.start}:{part.stop}:{part.step}]")
        else:
            parts.append(f"[{part}]")
    return "".join(parts)


def leaf_text(node: Expr) -> str:
    """Text of a leaf by itself."""
    if node.op == "symbol":
        return path_text(node.value)
    if node.op == "declared":
        return node.value.name or "?"
    if node.op == "time":
        return "time"
    if node.op in ("var", "par"):
        return f"{node.op}[{node.value}]"
    return node.op


def number_text(value: float) -> str:
    """Shortest text that reads back as the same number."""
    return repr(int(value)) if value == int(value) and abs(value) < 1e15 else repr(value)


def to_text(root: Expr, leaf: Callable[[Expr], str] = leaf_text) -> str:
    """`root` as infix text; `leaf` names its leaves."""
    text: dict[int, tuple[str, int]] = {}

    def wrap(child: Expr, at_least: int) -> str:
        body, precedence = text[id(child)]
        return body if precedence >= at_least else f"({body})"

    for node in postorder((root,)):
        text[id(node)] = _node_text(node, wrap, leaf)
    return text[id(root)][0]


def _node_text(node: Expr, wrap: Callable[[Expr, int], str], leaf: Callable[[Expr], str]) -> tuple[str, int]:
    op, args = node.op, node.args
    if op == "const":
        return number_text(node.value), _ATOM if node.value >= 0 else 2
    if op == "add":
        out = wrap(args[0], 1)
        for a in args[1:]:
            body = wrap(a, 2)
            out += f" - {body[1:]}" if body.startswith("-") else f" + {body}"
        return out, 1
    if op == "neg":
        return f"-{wrap(args[0], 3)}", 2
    if op == "mul":
        return f"{wrap(args[0], 3)}*{wrap(args[1], 3)}", 3
    if op == "div":
        return f"{wrap(args[0], 3)}/{wrap(args[1], 4)}", 3
    if op == "pow":
        return f"{wrap(args[0], 6)}**{wrap(args[1], 5)}", 5
    if op in _INFIX:
        low = 1  # comparisons are put in parentheses inside & and |, as Python needs it
        return f"{wrap(args[0], low)} {_INFIX[op]} {wrap(args[1], low)}", _PREC[op]
    if op == "not":
        return f"~{wrap(args[0], 5)}", 5
    if op == "call":
        return f"{node.value.name}({', '.join(wrap(a, -9) for a in args)})", _ATOM
    if not args:
        return leaf(node), _ATOM
    return f"{op}({', '.join(wrap(a, -9) for a in args)})", _ATOM
