"""Expressions as LaTeX: built from the operator table, iterative like the text printer."""

from __future__ import annotations

import math
import re
from collections.abc import Callable

from .expr import Expr
from .operators import OPERATORS
from .printing import leaf_text, number_text
from .traverse import postorder

_PREC = {"lt": 0, "le": 0, "gt": 0, "ge": 0, "eq": 0, "and": -2, "or": -3}
_INFIX = ("lt", "le", "gt", "ge", "eq", "and", "or")
_ATOM = 9

_GREEK = {
    "alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi",
    "pi", "rho", "sigma", "tau", "phi", "chi", "psi", "omega", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Pi", "Sigma",
    "Phi", "Psi", "Omega",
}  # fmt: skip
_VARIANT = {"phi": r"\varphi", "epsilon": r"\varepsilon", "eps": r"\varepsilon"}
_DERIVATIVE = re.compile(r"der\((.*?)(?:, (\d+))?\)")


def name_latex(name: str) -> str:
    r"""LaTeX of a dotted name: ``cells[0].p.v`` is ``\mathrm{cells}_{0}.\mathrm{p}.v``, ``der(x)`` is ``\dot{x}``."""
    derivative = _DERIVATIVE.fullmatch(name)
    if derivative is not None:
        inner, order = name_latex(derivative.group(1)), int(derivative.group(2) or 1)
        if "." not in inner and order <= 2:
            return rf"\{'d' * order}ot{{{inner}}}"
        power = f"^{{{order}}}" if order > 1 else ""
        return rf"\frac{{\mathrm{{d}}{power}}}{{\mathrm{{d}}t{power}}} {inner}"
    if name == "time":
        return "t"
    *owners, last = name.split(".")
    return ".".join([*(_part(owner, upright=True) for owner in owners), _part(last, upright=False)])


def _part(text: str, *, upright: bool) -> str:
    """One field of a name; its indices and what follows an underscore become subscripts."""
    head, *indices = re.split(r"\[|\]\[|\]", text.rstrip("]"))
    base, *below = head.split("_") if head.strip("_") else [head]
    subscripts = [_word(b, upright=len(b) > 1) for b in below if b] + [i.replace(":", r"{:}") for i in indices if i]
    body = _word(base or head, upright=upright)
    return body + (f"_{{{', '.join(subscripts)}}}" if subscripts else "")


def _word(text: str, *, upright: bool) -> str:
    if text in _VARIANT:
        return _VARIANT[text]
    if text in _GREEK:
        return rf"\{text}"
    escaped = text.replace("_", r"\_")
    if len(text) == 1 and not upright:
        return escaped
    letters = re.fullmatch(r"([A-Za-z])(\d+)", text)
    if letters is not None and not upright:
        return f"{letters.group(1)}_{{{letters.group(2)}}}"
    return rf"\mathrm{{{escaped}}}"


def _leaf(node: Expr) -> str:
    return name_latex(leaf_text(node))


def to_latex(root: Expr, leaf: Callable[[Expr], str] = _leaf) -> str:
    """`root` as LaTeX; `leaf` gives the LaTeX of its leaves."""
    text: dict[int, tuple[str, int]] = {}

    def wrap(child: Expr, at_least: int) -> str:
        body, precedence = text[id(child)]
        return body if precedence >= at_least else rf"\left({body}\right)"

    for node in postorder((root,)):
        text[id(node)] = _node(node, wrap, leaf)
    return text[id(root)][0]


def _node(node: Expr, wrap: Callable[[Expr, int], str], leaf: Callable[[Expr], str]) -> tuple[str, int]:
    op, args = node.op, node.args
    if op == "const":
        return _number(node.value)
    if not args and op != "call":
        return leaf(node), _ATOM
    if op == "add":
        out = wrap(args[0], 1)
        for a in args[1:]:
            body = wrap(a, 2)
            out += f" - {body[1:].lstrip()}" if body.startswith("-") else f" + {body}"
        return out, 1
    if op == "neg":
        return f"-{wrap(args[0], 3)}", 2
    if op == "mul":
        left, right = wrap(args[0], 3), wrap(args[1], 3)
        return f"{left} {_times(right)} {right}", 3
    if op == "div":
        return rf"\frac{{{wrap(args[0], -9)}}}{{{wrap(args[1], -9)}}}", 4
    if op == "pow":
        return f"{wrap(args[0], 6)}^{{{wrap(args[1], -9)}}}", 5
    if op == "sqrt":
        return rf"\sqrt{{{wrap(args[0], -9)}}}", _ATOM
    if op == "abs":
        return rf"\left|{wrap(args[0], -9)}\right|", _ATOM
    if op == "where":
        condition, a, b = (wrap(x, -9) for x in args)
        return rf"\begin{{cases}} {a} & \text{{if }} {condition} \\ {b} & \text{{otherwise}} \end{{cases}}", 0
    if op in _INFIX:
        low = _PREC[op] + 1
        return f"{wrap(args[0], low)} {OPERATORS[op].latex} {wrap(args[1], low)}", _PREC[op]
    if op == "not":
        return rf"\lnot {wrap(args[0], 5)}", 5
    if op == "der":
        return rf"\frac{{\mathrm{{d}}}}{{\mathrm{{d}}t}} {wrap(args[0], 4)}", 3
    name = _word(node.value.name, upright=True) if op == "call" else OPERATORS[op].latex
    return rf"{name}\left({', '.join(wrap(a, -9) for a in args)}\right)", _ATOM


def _times(right: str) -> str:
    """The sign between two factors: a dot before a number, a thin space otherwise."""
    return r"\cdot" if right[:1].isdigit() else r"\,"


def _number(value: float) -> tuple[str, int]:
    for denominator in (1, 2, 3, 4, 6, 180):
        numerator = value * denominator / math.pi
        if value and abs(numerator) < 13 and abs(numerator - round(numerator)) < 1e-14 * abs(numerator):
            n = "" if abs(round(numerator)) == 1 else str(abs(round(numerator)))
            body = rf"{n}\pi" if denominator == 1 else rf"\frac{{{n}\pi}}{{{denominator}}}"
            return ("-" + body, 2) if value < 0 else (body, 3)
    text = number_text(value)
    mantissa, _, exponent = text.partition("e")
    if exponent:
        sign = "-" if mantissa.startswith("-") else ""
        body = "" if mantissa.lstrip("-") == "1" else rf"{mantissa.lstrip('-')} \cdot "
        return rf"{sign}{body}10^{{{int(exponent)}}}", 2 if sign else 3
    return text, _ATOM if value >= 0 else 2
