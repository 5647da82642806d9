"""Expressions as SymPy expressions and back, for people: simplify, solve by hand, display.

The compiler does not use it. SymPy is imported when a function of this module is called.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from .expr import PI, Expr, add, const, make, mul, power
from .operators import OPERATORS
from .printing import leaf_text
from .traverse import postorder

_NAMES = {
    "abs": "Abs", "min": "Min", "max": "Max", "ceil": "ceiling", "and": "And", "or": "Or", "not": "Not", "lt": "Lt",
    "le": "Le", "eq": "Eq", "gt": "Gt", "ge": "Ge", "mod": "Mod", "div": None, "mul": None, "pow": None, "neg": None,
    "where": None, "clip": None, "log10": None,
}  # fmt: skip
"""SymPy functions whose name differs from the operator's, and operators that have their own rule."""


def to_sympy(root: Expr, leaf: Callable[[Expr], Any] | None = None) -> Any:
    """`root` as a SymPy expression.

    Args:
        root: an expression.
        leaf: the SymPy value of a leaf; by default a real symbol of the leaf's name.
    """
    import sympy

    def named(node: Expr) -> Any:
        return sympy.Symbol(leaf_text(node), real=True)

    value_of = leaf or named
    done: dict[Expr, Any] = {}
    for node in postorder((root,)):
        args = [done[a] for a in node.args]
        if node.op == "const":
            done[node] = _number(node.value, sympy)
        elif node.op == "call":
            done[node] = sympy.Function(node.value.name)(*args)
        elif node.op == "der":
            done[node] = sympy.Function("der")(*args)
        else:
            done[node] = _apply(node.op, args, sympy) if args else value_of(node)
    return done[root]


def _number(value: float, sympy: Any) -> Any:
    if value == PI.value:
        return sympy.pi
    return sympy.Integer(int(value)) if value == int(value) else sympy.Float(value)


def _apply(op: str, args: list[Any], sympy: Any) -> Any:
    if op == "add":
        return sympy.Add(*args)
    if op == "mul":
        return args[0] * args[1]
    if op == "div":
        return args[0] / args[1]
    if op == "pow":
        return args[0] ** args[1]
    if op == "neg":
        return -args[0]
    if op == "where":
        return sympy.Piecewise((args[1], args[0]), (args[2], True))
    if op == "clip":
        return sympy.Min(sympy.Max(args[0], args[1]), args[2])
    if op == "log10":
        return sympy.log(args[0], 10)
    return getattr(sympy, _NAMES.get(op) or op)(*args)


def from_sympy(root: Any, symbols: Mapping[str, Expr]) -> Expr:
    """A SymPy expression as ours.

    Args:
        root: built of numbers, symbols and the functions of the operator table.
        symbols: what each symbol stands for, by its name.

    Raises:
        ValueError: a function that the operator table does not have, or a symbol that `symbols` does not name.
    """
    import sympy

    names = {v: k for k, v in _NAMES.items() if v}
    done: dict[Any, Expr] = {}
    nodes: Any = sympy.postorder_traversal(root)
    for node in nodes:
        if node in done:
            continue
        if node.is_Number or node.is_NumberSymbol:
            done[node] = const(float(node))
        elif node.is_Symbol:
            if node.name not in symbols:
                raise ValueError(f"symbol `{node.name}` is not among {', '.join(symbols)}")
            done[node] = symbols[node.name]
        elif node.is_Add:
            done[node] = add(*(done[a] for a in node.args))
        elif node.is_Mul:
            product = done[node.args[0]]
            for a in node.args[1:]:
                product = mul(product, done[a])
            done[node] = product
        elif node.is_Pow:
            done[node] = _power(done[node.args[0]], done[node.args[1]])
        else:
            name = type(node).__name__
            op = names.get(name, name)
            if op not in OPERATORS:
                raise ValueError(f"`{name}` has no counterpart among the operators: {', '.join(OPERATORS)}")
            args = [done[a] for a in node.args]
            done[node] = make(op, tuple(args[:2]))
            for a in args[2:]:
                done[node] = make(op, (done[node], a))
    return done[root]


def _power(base: Expr, exponent: Expr) -> Expr:
    return make("sqrt", (base,)) if exponent.op == "const" and exponent.value == 0.5 else power(base, exponent)
