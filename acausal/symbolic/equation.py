"""Equations: two expressions that are equal at all times, and where the user wrote them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NoReturn

from .expr import Expr, as_expr, make

DEFINITION = "definition"
"""Kind of the equations that define variables with a derivative rule."""


@dataclass(frozen=True, slots=True)
class Origin:
    """Where an equation was written.

    Attributes:
        class_name: class whose `equations` yielded it.
        file: path of the source file.
        line: line number, 0 when unknown.
        kind: ``equation``, ``connect``, ``initial``, ``start``, ``definition`` ...
    """

    class_name: str
    file: str
    line: int
    kind: str = "equation"

    def __str__(self) -> str:
        if self.kind == "unconnected":
            return "(nothing is connected there)"
        return f"{self.file}:{self.line} ({self.class_name})" if self.line else self.class_name


@dataclass(frozen=True, slots=True, eq=False)
class Equation:
    """``lhs == rhs``.

    Attributes:
        defines: whether it defines variables whose derivatives are given by `derivative_rule`.
    """

    lhs: Expr
    rhs: Expr
    defines: bool = False

    def __bool__(self) -> NoReturn:
        raise TypeError(
            f"`{self}` is an equation, which is neither true nor false: yield it from equations(), or use a "
            "comparison (<, <=, >, >=) inside where(...) for a condition"
        )

    def __acausal_expr__(self) -> Expr:
        """As a condition: whether two discrete quantities are equal."""
        return make("eq", (self.lhs, self.rhs))

    def __and__(self, other: Any) -> Expr:
        return as_expr(self) & as_expr(other)

    def __rand__(self, other: Any) -> Expr:
        return as_expr(other) & as_expr(self)

    def __or__(self, other: Any) -> Expr:
        return as_expr(self) | as_expr(other)

    def __ror__(self, other: Any) -> Expr:
        return as_expr(other) | as_expr(self)

    def __invert__(self) -> Expr:
        return ~as_expr(self)

    def __str__(self) -> str:
        return f"{self.lhs} = {self.rhs}"

    @property
    def residual(self) -> Expr:
        """``lhs - rhs``."""
        return self.lhs - self.rhs
