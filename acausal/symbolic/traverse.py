"""Iterative traversals: postorder, leaves, substitution, evaluation. No recursion, so depth is not limited."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from .expr import Expr, make
from .operators import OPERATORS


def postorder(roots: Iterable[Expr]) -> list[Expr]:
    """Every node below `roots`, operands before operators, each once."""
    seen: dict[int, None] = {}
    order: list[Expr] = []
    stack: list[tuple[Expr, bool]] = [(root, False) for root in reversed(list(roots))]
    while stack:
        node, expanded = stack.pop()
        if expanded:
            order.append(node)
            continue
        if id(node) in seen:
            continue
        seen[id(node)] = None
        stack.append((node, True))
        stack.extend((a, False) for a in reversed(node.args) if id(a) not in seen)
    return order


def leaves(*roots: Expr, op: str | None = None) -> list[Expr]:
    """Leaves below `roots` in order of first occurrence; only those of kind `op` if given."""
    return [n for n in postorder(roots) if not n.args and n.op not in ("const", "call") and (op is None or n.op == op)]


def contains(root: Expr, leaf: Expr) -> bool:
    """Whether `leaf` occurs in `root`."""
    return any(node is leaf for node in postorder((root,)))


def rewrite(roots: Iterable[Expr], replace: Callable[[Expr], Expr | None]) -> list[Expr]:
    """Rebuild `roots` bottom up; `replace(node)` gives a node's substitute, or None to keep it (with new operands)."""
    roots = list(roots)
    memo: dict[int, Expr] = {}
    for node in postorder(roots):
        new = replace(node)
        if new is None:
            args = tuple(memo[id(a)] for a in node.args)
            same = all(a is b for a, b in zip(args, node.args, strict=True))
            new = node if same else make(node.op, args, node.value)
        memo[id(node)] = new
    return [memo[id(root)] for root in roots]


def substitute(root: Expr, mapping: Mapping[Expr, Expr]) -> Expr:
    """`root` with leaves (or whole nodes) replaced."""
    return rewrite((root,), mapping.get)[0]


def rewrite_located(
    root: Expr, replace: Callable[[Expr, tuple[Expr, ...], bool], Expr], located: bool = True,
    memo: dict[tuple[int, bool], Expr] | None = None,
) -> Expr:  # fmt: skip
    """Rebuild `root` bottom up, where it matters whether a node is below `noevent`.

    Args:
        root: an expression.
        replace: ``replace(node, args, located)`` gives a node's substitute; `args` are its operands, replaced, and
            `located` is False below `noevent`.
        located: whether `root` itself is not below `noevent`.
        memo: substitutes by identity and `located`, where several expressions are rebuilt.
    """
    memo = {} if memo is None else memo
    pending = [(root, located, False)]
    while pending:
        node, here, ready = pending.pop()
        if (id(node), here) in memo:
            continue
        below = here and node.op != "noevent"
        if node.args and not ready:
            pending.append((node, here, True))
            pending.extend((a, below, False) for a in node.args)
            continue
        memo[id(node), here] = replace(node, tuple(memo[id(a), below] for a in node.args), here)
    return memo[id(root), located]


def evaluate(
    roots: Iterable[Expr], leaf: Callable[[Expr], Any], xp: Any, memo: dict[int, Any] | None = None
) -> list[Any]:
    """Values of `roots`, computed with the functions of module `xp` (`numpy` or `jax.numpy`).

    Args:
        roots: expressions.
        leaf: value of a leaf other than a constant.
        xp: array module.
        memo: values by node identity; given, it is extended, so that later calls share subexpressions. The caller
            keeps the nodes alive.
    """
    roots = list(roots)
    values: dict[int, Any] = {} if memo is None else memo
    evaluate_in_order(postorder_missing(roots, values), leaf, xp, values)
    return [values[id(root)] for root in roots]


def evaluate_in_order(order: Iterable[Expr], leaf: Callable[[Expr], Any], xp: Any, values: dict[int, Any]) -> None:
    """Put the values of nodes, operands before operators, into `values`, by node identity."""
    for node in order:
        if node.op == "const":
            values[id(node)] = node.value
        elif node.op == "call":
            values[id(node)] = node.value.evaluate(*(values[id(a)] for a in node.args), xp=xp)
        elif not node.args:
            values[id(node)] = leaf(node)
        else:
            values[id(node)] = apply(node, [values[id(a)] for a in node.args], xp)


def postorder_missing(roots: list[Expr], known: Mapping[int, Any]) -> list[Expr]:
    """Postorder that stops at nodes whose value is known."""
    seen: dict[int, None] = {}
    order: list[Expr] = []
    stack: list[tuple[Expr, bool]] = [(root, False) for root in reversed(roots)]
    while stack:
        node, expanded = stack.pop()
        if expanded:
            order.append(node)
            continue
        if id(node) in seen or id(node) in known:
            continue
        seen[id(node)] = None
        stack.append((node, True))
        stack.extend((a, False) for a in reversed(node.args))
    return order


_ARITHMETIC = frozenset({"add", "mul", "div", "neg", "pow"})


def apply(node: Expr, args: list[Any], xp: Any) -> Any:
    """Value of one operator on its operands' values."""
    op = node.op
    if op in _ARITHMETIC:
        args = [as_number(a) for a in args]
    if op == "add":
        return _sum(args)
    if op == "mul":
        return args[0] * args[1]
    if op == "div":
        return args[0] / args[1]
    if op == "neg":
        return -args[0]
    if op == "pow":
        exponent = node.args[1]
        if exponent.op == "const" and exponent.value == int(exponent.value) and abs(exponent.value) <= 16:
            return args[0] ** int(exponent.value)
        if exponent.op == "const" and exponent.value > 0.0 and _moves(node.args[0]):
            return _rooted(args[0], lambda x: xp.power(x, args[1]), xp)
        return xp.power(args[0], args[1])
    if op == "sqrt" and _moves(node.args[0]):
        return _rooted(args[0], xp.sqrt, xp)
    if op == "where":
        return xp.where(*args)
    return getattr(xp, OPERATORS[op].array)(*args)


def _moves(x: Expr) -> bool:
    """Whether x depends on more than parameters."""
    stack = [x]
    while stack:
        node = stack.pop()
        if node.op in ("var", "time", "symbol"):
            return True
        stack += node.args
    return False


def _rooted(x: Any, root: Callable[[Any], Any], xp: Any) -> Any:
    """A root, whose slope is zero at its foot (`operators.slope`), and not zero times infinity, as in JAX."""
    foot = x == 0.0
    return xp.where(foot, 0.0, root(xp.where(foot, 1.0, x)))


def as_number(value: Any) -> Any:
    """A condition that is counted with is 1.0 or 0.0: truth values of arrays have no difference and no negative, and
    their sum is another truth value."""
    return value * 1.0 if getattr(value, "dtype", None) == np.bool_ else value


def _sum(args: list[Any]) -> Any:
    """Left-to-right sum."""
    result = args[0]
    for value in args[1:]:
        result = result + value
    return result
