"""Roots below a condition that keeps their argument from being negative, as in ``where(h > 0, sqrt(h), 0)``.

Between events a condition is held, also a little beyond the point at which it switches, where the root has no value any
more: the switch would never be reached. There its argument is what it is at the switch, zero.

Where both branches agree at the switch and a root begins there, as in ``where(dp > 0, sqrt(dp), -sqrt(-dp))``,
``sign(dp) * sqrt(abs(dp))`` or ``sign(q) * q**2``, nothing jumps. Such a flow may reverse while it is below the
tolerances, at an infinite slope: as an event it would be found again and again. It is taken as it is at every moment
instead.
"""

from __future__ import annotations

from dataclasses import dataclass

from ..language.flat_model import Family, FlatModel, canonical
from ..symbolic.expr import ZERO, Expr, add, const, intern_node, make, mul, neg, power
from ..symbolic.traverse import postorder, rewrite, substitute

COMPARISONS = frozenset({"lt", "le", "gt", "ge"})


def hold_domains(flat: FlatModel) -> FlatModel:
    """`flat` with roots that are not evaluated beyond the switch of the condition they stand below."""
    families = [_family(f) for f in flat.families]
    initial = [_family(f) for f in flat.initial]
    same = all(a is b for a, b in zip([*families, *initial], [*flat.families, *flat.initial], strict=True))
    return flat if same else flat.changed(families=families, initial=initial)


def _family(family: Family) -> Family:
    nodes = postorder((family.residual,))
    if not any(n.op in ("where", "sign") for n in nodes) or not any(n.op in ("sqrt", "pow") for n in nodes):
        return family
    held = held_domains(family.residual)
    if held is family.residual:
        return family
    form, var_rows, par_rows = canonical(held, family.var_rows, family.par_rows)
    return Family(form, var_rows, par_rows, family.source, family.ordinal)


def held_domains(root: Expr) -> Expr:
    """One expression; see `hold_domains`."""
    memo: dict[int, Expr] = {}
    for node in postorder((root,)):
        args = tuple(memo[id(a)] for a in node.args)
        same = all(a is b for a, b in zip(args, node.args, strict=True))
        new = node if same else _made(node, args)
        if node.op == "where":
            new = _choice(node, new)
        elif node.op == "mul":
            new = _product(node, new)
        memo[id(node)] = new
    return memo[id(root)]


def _made(node: Expr, args: tuple[Expr, ...]) -> Expr:
    return intern_node(node.op, args, node.value) if node.op == "call" else make(node.op, args, node.value)


def _is_root(node: Expr) -> bool:
    if node.op == "sqrt":
        return True
    return node.op == "pow" and node.args[1].op == "const" and _fractional(node.args[1].value)


def _fractional(exponent: float) -> bool:
    return exponent > 0.0 and exponent != int(exponent)


def _is_steep(node: Expr) -> bool:
    """Whether the slope of a root is infinite at its foot."""
    return node.op == "sqrt" or node.args[1].value < 1.0


@dataclass(frozen=True, slots=True)
class _Switch:
    """Where a comparison switches: `leaf` is `value` there."""

    leaf: Expr
    value: Expr

    def there(self, e: Expr) -> Expr:
        """`e` at the switch; itself where that would divide by zero."""
        try:
            return substitute(e, {self.leaf: self.value})
        except ZeroDivisionError:
            return e


def _switch(comparison: Expr) -> _Switch | None:
    left, right = comparison.args
    difference = add(left, neg(right))
    for term in difference.args if difference.op == "add" else (difference,):
        leaf = term.args[0] if term.op == "neg" else term
        if leaf.op in ("var", "time"):
            rest = add(difference, neg(term))
            value = neg(rest) if leaf is term else rest
            return _Switch(leaf, value) if leaf not in _leaves(value) else None
    return _Switch(left, right) if left.args else None


def _leaves(e: Expr) -> set[Expr]:
    return {n for n in postorder((e,)) if not n.args}


def _choice(node: Expr, new: Expr) -> Expr:
    """``where(condition, a, b)``: `node` as it was written, `new` with its branches done."""
    if new.op != "where" or node.args[0].op not in COMPARISONS:
        return new
    switch = _switch(node.args[0])
    if switch is None:
        return new
    condition, *branches = new.args
    feet = [_feet(branch, switch) for branch in branches]
    if not feet[0] and not feet[1]:
        square = _odd_square(node.args[0], branches)
        return new if square is None else square
    steep = any(_is_steep(n) for roots in feet for n in roots)
    if steep and switch.leaf.op != "time" and switch.there(node.args[1]) is switch.there(node.args[2]):
        odd = _odd(branches, feet)
        if odd is not None:
            return odd
        condition = make("noevent", (node.args[0],))
    held = [_held(branches[i], feet[i], node.args[0], i == 0) for i in (0, 1)]
    return make("where", (condition, *held))


def _feet(branch: Expr, switch: _Switch) -> list[Expr]:
    """Roots that begin at the switch."""
    roots = [n for n in postorder((branch,)) if _is_root(n) and not _is_held(n)]
    return [n for n in roots if switch.there(n.args[0]) is ZERO]


def _odd(branches: list[Expr], feet: list[list[Expr]]) -> Expr | None:
    """``where(x > 0, k * sqrt(x), -k * sqrt(-x))`` as ``sign(x) * k * sqrt(abs(x))``, which can be solved for x."""
    if len(feet[0]) != 1 or len(feet[1]) != 1:
        return None
    one, two = feet[0][0], feet[1][0]
    alike = one.op == two.op and all(a is b for a, b in zip(one.args[1:], two.args[1:], strict=True))
    if not alike or not (_opposite(one.args[0], two.args[0]) or add(one.args[0], two.args[0]) is ZERO):
        return None
    root = _with_argument(one, make("abs", (one.args[0],)))
    even = [_put(branches[i], feet[i][0], root) for i in (0, 1)]
    if not _opposite(*even):
        return None
    return mul(even[0], make("noevent", (make("sign", (one.args[0],)),)))


def _odd_square(comparison: Expr, branches: list[Expr]) -> Expr | None:
    """``where(x > 0, k * x**2, -k * x**2)`` as ``k * x * abs(x)``."""
    if not _opposite(*branches):
        return None
    difference = add(comparison.args[0], neg(comparison.args[1]))
    for factor in _factors(branches[0]):
        x = factor.args[0] if factor.op == "pow" and factor.args[1] is const(2.0) else None
        if x is None or (x is not difference and x is not neg(difference)):
            continue
        falls = (comparison.op in ("lt", "le")) != (x is not difference)
        return _put(branches[1] if falls else branches[0], factor, mul(x, make("abs", (x,))))
    return None


def _opposite(a: Expr, b: Expr) -> bool:
    """Whether b is -a, as it was written."""
    if b is neg(a):
        return True
    numbers = a.op == b.op == "mul" and a.args[0].op == b.args[0].op == "const"
    return numbers and a.args[0].value == -b.args[0].value and a.args[1] is b.args[1]


def _put(e: Expr, old: Expr, new: Expr) -> Expr:
    return rewrite((e,), lambda n: new if n is old else None)[0]


def _with_argument(root: Expr, argument: Expr) -> Expr:
    return make("sqrt", (argument,)) if root.op == "sqrt" else power(argument, root.args[1])


def _is_held(root: Expr) -> bool:
    argument = root.args[0]
    return argument.op == "where" and argument.args[0].op == "noevent"


def _held(branch: Expr, feet: list[Expr], condition: Expr, where_true: bool) -> Expr:
    """`branch` with the arguments of these roots zero beyond the switch."""
    literal = make("noevent", (condition,))

    def replace(n: Expr) -> Expr | None:
        if not any(n is foot for foot in feet):
            return None
        return _with_argument(
            n, make("where", (literal, n.args[0], ZERO) if where_true else (literal, ZERO, n.args[0]))
        )

    return rewrite((branch,), replace)[0]


def _product(node: Expr, new: Expr) -> Expr:
    """``sign(x) * sqrt(abs(x))`` and ``sign(x) * x**2`` without an event, whatever other factors there are."""
    factors = _factors(node)
    for sign in factors:
        if sign.op != "sign" or sign.args[0].op == "const":
            continue
        switch = _switch(intern_node("gt", (sign.args[0], ZERO)))
        if switch is None or switch.leaf.op == "time":
            continue
        if any(_vanishes(f, sign, switch) for f in factors if f is not sign):
            literal = make("noevent", (sign,))
            return _put(new, sign, literal)
    return new


def _factors(node: Expr) -> list[Expr]:
    found: list[Expr] = []
    pending = [node]
    while pending:
        n = pending.pop()
        if n.op == "mul":
            pending += n.args
        elif n.op in ("neg", "div"):
            pending.append(n.args[0])
        else:
            found.append(n)
    return found


def _vanishes(factor: Expr, sign: Expr, switch: _Switch) -> bool:
    """Whether a factor makes the jump of a sign vanish: a root, or the square of the same."""
    if factor.op == "pow" and factor.args[1] is const(2.0):
        return factor.args[0] is sign.args[0]
    return _is_root(factor) and _is_steep(factor) and switch.there(factor.args[0]) is ZERO
