"""What a class body declares: variables, parameters, signals, and start values."""

from __future__ import annotations

import enum
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Final, Literal, Self, overload

from ..errors import DeclarationError
from ..symbolic.equation import Origin
from ..symbolic.expr import Expr, as_expr, intern_node, symbol

if TYPE_CHECKING:
    from .component import Component
    from .vectors import Vector

StateSelect = Literal["never", "avoid", "default", "prefer", "always"]
STATE_SELECT: Final[tuple[StateSelect, ...]] = ("never", "avoid", "default", "prefer", "always")


class Kind(enum.IntEnum):
    """What a declared quantity is."""

    VARIABLE = 0
    POTENTIAL = 1
    FLOW = 2
    INPUT = 3
    OUTPUT = 4
    PARAMETER = 5
    DISCRETE = 6


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """Start value and attributes of a variable in a modification, made by `start`."""

    value: Any = None
    fixed: bool | None = None
    nominal: float | None = None
    state_select: StateSelect | None = None


def start(
    value: float | Expr | Declaration | Vector | Sequence[Any] | None = None,
    *,
    fixed: bool | None = None,
    nominal: float | None = None,
    state_select: StateSelect | None = None,
) -> Start:
    """Start value of a variable, as a modification: ``Chamber(p=start(2e5, fixed=True))``.

    Args:
        value: value at the start, a number or an expression of the parameters of the class body it stands in; of a
            vector, one for each element.
        fixed: True makes it an equation of the initialization; False a guess.
        nominal: typical magnitude, the scale of the solvers' error control.
        state_select: how much the compiler should want this variable as a state.
    """
    return Start(value, fixed, nominal, state_select)


class _Arithmetic:
    """Declarations can be used in expressions of the class body they stand in (dependent parameters, bindings)."""

    __array_ufunc__ = None  # numbers of numpy leave the operation to us

    def __acausal_expr__(self) -> Expr:
        return intern_node("declared", (), self)

    def __add__(self, other: Any) -> Expr:
        return as_expr(self) + other

    def __radd__(self, other: Any) -> Expr:
        return other + as_expr(self)

    def __sub__(self, other: Any) -> Expr:
        return as_expr(self) - other

    def __rsub__(self, other: Any) -> Expr:
        return other - as_expr(self)

    def __mul__(self, other: Any) -> Expr:
        return as_expr(self) * other

    def __rmul__(self, other: Any) -> Expr:
        return other * as_expr(self)

    def __truediv__(self, other: Any) -> Expr:
        return as_expr(self) / other

    def __rtruediv__(self, other: Any) -> Expr:
        return other / as_expr(self)

    def __pow__(self, other: Any) -> Expr:
        return as_expr(self) ** other

    def __rpow__(self, other: Any) -> Expr:
        return other ** as_expr(self)

    def __neg__(self) -> Expr:
        return -as_expr(self)

    def __lt__(self, other: Any) -> Expr:
        return as_expr(self) < other

    def __le__(self, other: Any) -> Expr:
        return as_expr(self) <= other

    def __gt__(self, other: Any) -> Expr:
        return as_expr(self) > other

    def __ge__(self, other: Any) -> Expr:
        return as_expr(self) >= other


Value = float | Expr | Start | _Arithmetic
"""What may be given for a declared quantity when a component is constructed."""


class Declaration(_Arithmetic):
    """A scalar quantity of a component class. Subclasses are `Variable`, `Parameter`, `Potential`, ...

    As a class attribute it is a descriptor: on an instance it reads as an `Expr`.
    """

    kind: Kind = Kind.VARIABLE

    def __init__(
        self,
        default: Any = None,
        *,
        unit: str | None = None,
        doc: str = "",
        start: float | Expr | Declaration | None = None,
        fixed: bool | None = None,
        nominal: float | Declaration | None = None,
        min: float | None = None,
        max: float | None = None,
        state_select: StateSelect | Any = "default",
        evaluate: bool = False,
    ) -> None:
        self.name = ""
        self.evaluate = evaluate
        self.owner: type[Component] | None = None
        self.default = default
        self.unit = unit
        self.doc = doc
        self.start = start
        self.fixed = fixed
        self.nominal = nominal
        self.min = min
        self.max = max
        self.state_select = state_select
        self.origin: Origin | None = None
        if isinstance(state_select, str) and state_select not in STATE_SELECT:
            raise DeclarationError(f"state_select={state_select!r} is not one of {', '.join(STATE_SELECT)}")
        if isinstance(nominal, (int, float)) and not nominal > 0:
            raise DeclarationError(f"nominal={nominal!r} must be a positive number: it is a scale")

    def __set_name__(self, owner: type[Component], name: str) -> None:
        self.name = self.name or name  # a second name is an error of the class, raised when its body is gathered
        self.owner = owner

    @overload
    def __get__(self, instance: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type[Any]) -> Expr: ...
    def __get__(self, instance: Any, owner: type[Any]) -> Self | Expr:
        if instance is None:
            return self
        return symbol((*instance.__dict__["_path"], self.name))

    def __set__(self, instance: object, value: Value) -> None:
        raise DeclarationError(
            f"`{type(instance).__name__}.{self.name}` cannot be assigned: give it when the component is constructed, "
            f"`{type(instance).__name__}({self.name}=...)`, or write an equation, `yield self.{self.name} == ...`"
        )

    def __repr__(self) -> str:
        return f"<{type(self).__name__} {self.name or '?'}>"


class Variable(Declaration):
    """An unknown of the component: ``dp: Variable = Variable(unit="Pa", start=0.0)``.

    Args:
        unit: unit string, as in ``kg/s``; equations are checked where units are given.
        start: value at the start, a guess unless `fixed`.
        fixed: whether `start` is an equation of the initialization.
        nominal: typical magnitude, the scale of the solvers' error control, or a parameter (`evaluate=True`) that is.
        min: lower bound; a solution with a value below it is an error.
        max: upper bound.
        state_select: how much the compiler should want this variable as a state; ``structural("name")`` leaves it to a
            structural parameter of the class.
    """

    def __init__(
        self,
        *,
        unit: str | None = None,
        doc: str = "",
        start: float | Expr | Declaration | None = None,
        fixed: bool | None = None,
        nominal: float | Declaration | None = None,
        min: float | None = None,
        max: float | None = None,
        state_select: StateSelect | Any = "default",
    ) -> None:
        super().__init__(
            unit=unit, doc=doc, start=start, fixed=fixed, nominal=nominal, min=min, max=max, state_select=state_select
        )


class Potential(Variable):
    """Connector variable that is equal on all sides of a connection (pressure, voltage, position)."""

    kind = Kind.POTENTIAL


class Flow(Variable):
    """Connector variable that sums to zero over a connection, positive into the component."""

    kind = Kind.FLOW


class Input(Variable):
    """Signal that the component needs from outside: connect it, give it an equation, or feed it at `simulate`."""

    kind = Kind.INPUT


class Output(Variable):
    """Signal that the component computes for others."""

    kind = Kind.OUTPUT


class Discrete(Variable):
    """A quantity that changes at events only: assigned by `when`, or by an equation of discrete things and conditions.

    Numbers, and 0 and 1 for false and true. `start` is its value before the first event, 0 by default; as that is an
    exact value already, `fixed` adds nothing (Modelica Language Specification 8.6).
    """

    kind = Kind.DISCRETE


class Parameter(Declaration):
    """A quantity that is constant during a run and can be changed without compiling again.

    Args:
        default: value; a number, or an expression of parameters declared above it (a dependent parameter).
        unit: unit string.
        min: lower bound; a value below it is an error.
        max: upper bound.
        evaluate: build the value into the equations, where zeros and ones simplify them; it cannot be changed after
            compiling, and neither can what it is computed from.
    """

    kind = Kind.PARAMETER

    def __init__(
        self,
        default: float | Expr | Declaration | None = None,
        *,
        unit: str | None = None,
        doc: str = "",
        min: float | None = None,
        max: float | None = None,
        evaluate: bool = False,
    ) -> None:
        super().__init__(default, unit=unit, doc=doc, min=min, max=max, evaluate=evaluate)


class Structural:
    """Descriptor of a structural parameter (a plain int, bool, str or tuple of numbers of the class body).

    Attributes:
        rows: whether a tuple holds rows of numbers (a matrix), or numbers; None where its annotation allows both.
    """

    def __init__(self, name: str, default: Any, annotation: type, rows: bool | None = None) -> None:
        self.name = name
        self.default = default
        self.annotation = annotation
        self.rows = rows

    def __get__(self, instance: Any, owner: type[Any]) -> Any:
        if instance is None:
            return self.default
        return instance.__dict__["_mods"].get(self.name, self.default)

    def __set__(self, instance: object, value: object) -> None:
        raise DeclarationError(
            f"structural parameter `{self.name}` is fixed at construction: `{type(instance).__name__}({self.name}=...)`"
        )

