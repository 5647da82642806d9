"""Unit check of equations: once for each class, whatever the number of its instances.

A quantity without a unit agrees with everything. Numbers agree with everything in sums and comparisons, and are
dimensionless in products. Otherwise the sides of an equation, the terms of a sum, the operands of `min`, `max`, `clip`,
`where` and of comparisons must have one unit, in dimension and in scale: nothing is converted silently.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any, NoReturn

from .errors import UnitError, nearest
from .language.flat_model import FlatModel
from .language.template import Path, Template
from .symbolic.equation import Origin
from .symbolic.expr import Expr, make, symbol
from .symbolic.operators import OPERATORS
from .symbolic.printing import path_text
from .symbolic.traverse import leaves, postorder
from .unit_algebra import DIMENSIONLESS, NUMBER, SECOND, Unit, UnknownUnit, agree, known_units, parse_unit, unit_text

if TYPE_CHECKING:
    from .language.declarations import Declaration

ICE_POINT = 273.15
"""0 degC [K]"""


class _Mismatch(Exception):
    """A subexpression whose operands do not fit, without its place."""

    def __init__(self, what: str, parts: list[tuple[Expr, Unit | None]], advice: str) -> None:
        super().__init__(what)
        self.what, self.parts, self.advice = what, parts, advice


def check_units(flat: FlatModel) -> None:
    """Check the units of all equations, connections, parameter values and start values of a model.

    Raises:
        UnitError: names both expressions with their units, the class and the source line.
    """
    for template, path in _templates(flat.root):
        _Checker(template, path).run()


def _templates(root: Template) -> Iterator[tuple[Template, Path]]:
    """Every template once, with the path of its first instance."""
    seen: dict[int, None] = {}
    stack: list[tuple[Template, Path]] = [(root, ())]
    while stack:
        template, path = stack.pop()
        if id(template) in seen:
            continue
        seen[id(template)] = None
        yield template, path
        for slot in reversed(template.children.values()):
            for i, child in reversed(list(enumerate(slot.templates))):
                stack.append((child, (*path, slot.name) if slot.count is None else (*path, slot.name, i)))


def unit_of(declaration: Declaration) -> Unit | None:
    """Unit of a declared quantity, None if it has none.

    Raises:
        UnitError: the unit string is not known.
    """
    if declaration.unit is None:
        return None
    try:
        return parse_unit(declaration.unit)
    except UnknownUnit as error:
        owner = declaration.owner
        field = f"{owner.__name__}.{declaration.name}" if owner is not None else declaration.name
        place = f" ({owner._source[0]}:{owner._source[1]})" if owner is not None else ""
        if error.atom is None:
            what = "is not well formed: write factors with `.` or `*` and `/`, exponents as digits, as in `W/(m2.K)`"
        else:
            hint = nearest(error.atom, known_units())
            what = f"contains `{error.atom}`, which is not a known unit.{hint}" if error.atom != error.text else (
                f"is not a known unit.{hint}")  # fmt: skip
        raise UnitError(f"`{field}`{place}: unit {error.text!r} {what}") from None


class _Checker:
    """Checks one template."""

    def __init__(self, template: Template, path: Path) -> None:
        self.template = template
        self.path = path
        self.units: dict[Expr, Unit | None] = {}

    def run(self) -> None:
        """All statements of the template."""
        for declaration in self.template.cls._declarations.values():
            unit_of(declaration)
        chosen = (choice.equation for choice in self.template.choices)
        for equation in (*self.template.equations, *self.template.initial, *chosen):
            self._equal(equation.lhs, equation.rhs, equation.origin)
        for action in self.template.actions:
            form = action.form
            if form.op == "rule":
                self._equal(make("der", form.args[:1]), form.args[1], action.origin, "`derivative_rule` gives")
            elif form.op == "reinit":
                self._equal(form.args[0], form.args[2], action.origin, f"`reinit` gives `{form.args[0]}`")
            else:
                self._equal(form.args[0], form.args[0], action.origin)
        for binding in self.template.bindings:
            target = symbol(binding.path)
            what = "the start value of" if binding.is_start else "the value of"
            self._equal(target, binding.expression, binding.origin, f"{what} `{path_text(binding.path)}`")
        for connect, origin in self.template.connections:
            for other in connect.paths[1:]:
                self._connected(connect.paths[0], other, origin)

    def _equal(self, lhs: Expr, rhs: Expr, origin: Origin, what: str = "") -> None:
        try:
            a, b = self._unit(lhs), self._unit(rhs)
            if agree(a, b) is False:
                name = f"{what} and the expression given for it have" if what else "the two sides of the equation have"
                raise _Mismatch(f"{name} different units", [(lhs, a), (rhs, b)], _conversion(lhs, a, rhs, b))
        except _Mismatch as problem:
            text = f"{path_text(lhs.value)} := {rhs}" if what else f"{lhs} == {rhs}"
            self._fail(problem, text, origin)

    def _fail(self, problem: _Mismatch, statement: str, origin: Origin) -> NoReturn:
        where = f" (component `{path_text(self.path)}`)" if self.path else ""
        width = min(max(len(str(e)) for e, _ in problem.parts), 60)
        lines = [
            f"`{self.template.cls.__name__}`{where}: {problem.what}.",
            f"    {statement}    {origin}",
            *(f"    {e!s:<{width}}  has unit {'(none)' if u is None else unit_text(u)}" for e, u in problem.parts),
        ]
        declared = self._declared([e for e, _ in problem.parts])
        if declared:
            lines.append(f"Declared: {declared}")
        lines.append(f"Try: {problem.advice}")
        raise UnitError("\n".join(lines))

    def _declared(self, expressions: list[Expr]) -> str:
        found: dict[str, str] = {}
        for leaf in leaves(*expressions, op="symbol"):
            declaration = self.template.resolve(leaf.value).declaration
            if declaration is not None:
                found[str(leaf)] = declaration.unit if declaration.unit is not None else "no unit"
        return ", ".join(f"{name} [{unit}]" for name, unit in list(found.items())[:10])

    def _connected(self, first: Path, second: Path, origin: Origin) -> None:
        """Both ends of a connection have the same units, quantity by quantity."""
        one, two = self.template.resolve(first), self.template.resolve(second)
        if one.declaration is not None or two.declaration is not None:
            pairs = [((), one.declaration, two.declaration)]
        elif one.template is None or two.template is None or one.template is two.template:
            return
        else:
            a, b = one.template, two.template
            paths = [path for path, _ in a.leaf_names(False)]
            pairs = [(path, a.resolve(path).declaration, b.resolve(path).declaration) for path in paths]
        for tail, left, right in pairs:
            if left is None or right is None:
                continue
            a, b = unit_of(left), unit_of(right)
            if agree(a, b) is False:
                parts: list[Any] = [(symbol((*first, *tail)), a), (symbol((*second, *tail)), b)]
                advice = "a connection makes both sides equal: give them one unit, or convert in a component between"
                statement = f"connect({path_text(first)}, {path_text(second)})"
                self._fail(_Mismatch("a connection joins different units", parts, advice), statement, origin)

    def _leaf(self, node: Expr) -> Unit | None:
        if node.op == "const":
            return Unit(literal=node.value or 1.0, soft=True)
        if node.op == "time":
            return Unit(SECOND.dimension, soft=True)
        if node.op == "symbol":
            declaration = self.template.resolve(node.value).declaration
            return None if declaration is None else unit_of(declaration)
        return None

    def _unit(self, root: Expr) -> Unit | None:
        """Unit of an expression, bottom up."""
        for node in postorder((root,)):
            if node not in self.units:
                args = [self.units[a] for a in node.args]
                self.units[node] = _rule(node, args) if node.args else self._leaf(node)
        return self.units[root]


def _rule(node: Expr, args: list[Unit | None]) -> Unit | None:
    """Unit of an operator's result from those of its operands."""
    op = node.op
    if op == "add":
        return _sum(node, args)
    if op == "der":
        return _derivative(args[0])
    if op == "call":
        return None
    kind = OPERATORS[op].units
    if kind in _RULES:
        return _RULES[kind](node, args)
    return _RULES["dimensionless"](node, args)


def _common(node: Expr, args: list[Unit | None], operands: tuple[Expr, ...], what: str) -> Unit | None:
    """The one unit of several operands."""
    result: Unit | None = args[0]
    first = operands[0]
    for operand, unit in zip(operands[1:], args[1:], strict=True):
        common = agree(result, unit)
        if isinstance(common, bool):
            advice = _conversion(first, result, operand, unit)
            raise _Mismatch(f"{what} `{node}` have different units", [(first, result), (operand, unit)], advice)
        if result is None or result.soft:
            first = operand
        result = common if common is not None else result
    return result


def _sum(node: Expr, args: list[Unit | None]) -> Unit | None:
    args = _with_temperatures(node, args)
    if args == [_CELSIUS]:
        return _CELSIUS
    operands = tuple(a.args[0] if a.op == "neg" else a for a in node.args)
    unit = _common(node, args, operands, "terms of")
    if unit is None:
        return None
    if unit.soft and len({u and u.dimension for u in args}) > 1:
        return None
    return replace(unit, literal=1.0)


def _with_temperatures(node: Expr, args: list[Unit | None]) -> list[Unit | None]:
    """Units of the terms of a sum, where ``degC + 273.15`` is K, ``degC - degC`` is K, and ``K - 273.15`` is degC."""
    celsius = [u is not None and u.dimension == _CELSIUS.dimension for u in args]
    numbers = [term.value for term in node.args if term.op == "const"]
    if any(celsius):
        balance = sum(-1 if term.op == "neg" else 1 for term, c in zip(node.args, celsius, strict=True) if c)
        if balance == 0 or ICE_POINT in numbers:
            return [_KELVIN if c else u for u, c in zip(args, celsius, strict=True)]
    elif -ICE_POINT in numbers and _KELVIN in args:
        _common(node, args, node.args, "terms of")
        return [_CELSIUS]
    return args


_CELSIUS = Unit((("degC", 1.0),))
_KELVIN = Unit((("K", 1.0),))


def _derivative(unit: Unit | None) -> Unit | None:
    if unit is None:
        return None
    return (_KELVIN if unit.dimension == _CELSIUS.dimension else unit) / SECOND


def _same(node: Expr, args: list[Unit | None]) -> Unit | None:
    return args[0] if len(args) == 1 else _common(node, args, node.args, "operands of")


def _condition(node: Expr, args: list[Unit | None]) -> Unit | None:
    _common(node, args, node.args, "sides of")
    return NUMBER


def _where(node: Expr, args: list[Unit | None]) -> Unit | None:
    return _common(node, args[1:], node.args[1:], "branches of")


def _product(node: Expr, args: list[Unit | None]) -> Unit | None:
    a, b = args
    return None if a is None or b is None else a * b


def _quotient(node: Expr, args: list[Unit | None]) -> Unit | None:
    a, b = args
    return None if a is None or b is None else a / b


def _root(node: Expr, args: list[Unit | None]) -> Unit | None:
    return None if args[0] is None else args[0] ** 0.5


def _power(node: Expr, args: list[Unit | None]) -> Unit | None:
    base, exponent = args
    _dimensionless(node, [exponent], (node.args[1],), "the exponent of")
    if node.args[1].op == "const":
        return None if base is None else base ** node.args[1].value
    if base is not None and not base.soft and base.dimension:
        raise _Mismatch(
            f"the base of `{node}` has a unit, so the unit of the power depends on the value of the exponent",
            [(node.args[0], base)],
            "divide the base by a reference value of the same unit, or write the exponent as a number",
        )
    return _dimensionless(node, [base], (node.args[0],), "the base of")


def _dimensionless(node: Expr, args: list[Unit | None], operands: tuple[Expr, ...] = (), what: str = "") -> Unit | None:
    operands = operands or node.args
    what = what or f"the argument of `{node.op}` in"
    for operand, unit in zip(operands, args, strict=True):
        if unit is None or unit.soft:
            continue
        if unit.dimension:
            advice = "divide it by a quantity of the same unit, or multiply a time by an angular frequency"
            raise _Mismatch(f"{what} `{node}` must be dimensionless", [(operand, unit)], advice)
        if not any(math.isclose(scale, 1.0, rel_tol=1e-6) for scale in (unit.scale, unit.converted.scale)):
            advice = f"convert it to rad (or 1) with the literal factor {unit.scale:.9g}"
            raise _Mismatch(f"{what} `{node}` must be in rad (or 1)", [(operand, unit)], advice)
    if any(u is None for u in args):
        return None
    return NUMBER if all(u is not None and u.soft for u in args) else DIMENSIONLESS


def _angle(node: Expr, args: list[Unit | None]) -> Unit | None:
    unit = _common(node, args, node.args, "arguments of")
    return None if unit is None else NUMBER if unit.soft else DIMENSIONLESS


def _sign(node: Expr, args: list[Unit | None]) -> Unit | None:
    return NUMBER


def _logical(node: Expr, args: list[Unit | None]) -> Unit | None:
    return NUMBER


_RULES: dict[str, Callable[[Expr, list[Unit | None]], Unit | None]] = {
    "same": _same, "condition": _condition, "where": _where, "mul": _product, "div": _quotient, "pow": _power,
    "sqrt": _root, "atan2": _angle, "any": _sign, "logical": _logical, "dimensionless": _dimensionless,
}  # fmt: skip


def _conversion(first: Expr, a: Unit | None, second: Expr, b: Unit | None) -> str:
    """What to try against a mismatch."""
    if a is not None and b is not None and a.dimension == b.dimension:
        return (
            f"nothing is converted silently: one {unit_text(b)} is {b.scale / a.scale:.9g} {unit_text(a)}, so multiply "
            f"`{second}` by the number {b.scale / a.scale:.9g}, or declare both in one unit"
        )
    if a is not None and b is not None and {a.dimension, b.dimension} == {_CELSIUS.dimension, _KELVIN.dimension}:
        return "add 273.15 to the temperature in degC"
    if a is not None and b is not None and a != b:
        factor = a / b
        number = "" if a.literal == b.literal == 1.0 else " (a number has no unit: one that has is a Parameter)"
        return (
            f"check the equation: a factor of unit {unit_text(Unit(factor.dimension, factor.scale))} is missing from "
            f"`{second}`{number}; or correct the `unit=` of a declaration (a quantity declared without unit is not "
            "checked)"
        )
    return "check the equation and the `unit=` of its quantities"
