"""Overdetermined connectors: potentials that depend on each other, in a connection graph with roots.

An orientation in space has nine direction cosines and three degrees of freedom. Equating all nine around a closed loop
of connections says the same things twice. So components say how their overdetermined connectors hang together (`root`,
`potential_root`, `branch`); a spanning forest of that graph and of the connections is chosen; and a connection that
closes a loop asks for the independent `equality_constraint` alone (Modelica Language Specification 3.6, section 9.4).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Literal

from ..errors import DeclarationError
from ..symbolic.equation import Equation
from ..symbolic.expr import Expr
from .component import Connector
from .events import Assert
from .instance import call_site
from .vectors import Matrix, Vector, VectorEquation

Path = tuple[Any, ...]


class Overdetermined(Connector, partial=True):
    """A connector (mostly a part of another) whose potentials depend on each other.

    Attributes:
        loop_advice: what to try where a model with closed loops cannot be solved.
    """

    loop_advice: ClassVar[str] = ""

    def equality_constraint(self, other: Any) -> Vector:
        """Independent expressions that are zero where this one and the other are equal."""
        raise NotImplementedError(f"{type(self).__name__} has no equality_constraint(self, other)")

    def equality_assertion(self, other: Any) -> Assert | None:
        """What tells equality from other roots of `equality_constraint`, if it has any: an `assert_`, of the start."""
        del other
        return None


@dataclass(frozen=True, slots=True, eq=False)
class Mark:
    """A statement about the connection graph.

    Attributes:
        paths: of one connector, for a branch of two.
        priority: of a potential root; the lowest is taken first.
    """

    kind: Literal["root", "potential_root", "branch"]
    paths: tuple[Path, ...]
    priority: int = 0


@dataclass(frozen=True, slots=True, eq=False)
class RootCondition:
    """A question to the connection graph, answered for each instance when the model is flattened."""

    op: Literal["is_root", "rooted"]
    path: Path


@dataclass(frozen=True, slots=True, eq=False)
class Choice:
    """Equations of a component that depend on its place in the connection graph, made by `choose`."""

    condition: RootCondition
    then: tuple[Equation, ...]
    otherwise: tuple[Equation, ...]


def root(connector: Overdetermined) -> Mark:
    """The component fixes this overdetermined connector: it has to be the root of its tree."""
    return Mark("root", (_path(connector, "root"),))


def potential_root(connector: Overdetermined, priority: int = 0) -> Mark:
    """The component can have the states of this connector: it becomes a root where a tree has none.

    Args:
        connector: part of a connector of the component.
        priority: of all potential roots of a tree, one with the lowest number is taken.
    """
    return Mark("potential_root", (_path(connector, "potential_root"),), priority)


def branch(a: Overdetermined, b: Overdetermined) -> Mark:
    """The component's equations give one of the two connectors from the other."""
    return Mark("branch", (_path(a, "branch"), _path(b, "branch")))


def is_root(connector: Overdetermined) -> RootCondition:
    """Whether this connector was chosen as a root, for `choose`."""
    return RootCondition("is_root", _path(connector, "is_root"))


def rooted(connector: Overdetermined) -> RootCondition:
    """Whether this end of a `branch` is closer to the root than the other, for `choose`."""
    return RootCondition("rooted", _path(connector, "rooted"))


def choose(
    condition: RootCondition,
    then: Sequence[Equation | VectorEquation],
    otherwise: Sequence[Equation | VectorEquation] = (),
) -> Choice:
    """Equations that depend on the connection graph: ``yield choose(is_root(self.frame_a.R), [...], [...])``."""
    if not isinstance(condition, RootCondition):
        raise DeclarationError(
            f"choose() asks the connection graph, is_root(connector) or rooted(connector), not {condition!r}: use "
            f"`where` for conditions on variables and Python's `if` for structural parameters {call_site()}"
        )
    return Choice(condition, _scalar(then), _scalar(otherwise))


@dataclass(frozen=True, slots=True, eq=False)
class DerivativeRule:
    """Derivatives that are known, made by `derivative_rule`."""

    rules: tuple[tuple[Expr, Expr], ...]


def derivative_rule(quantity: Expr | Vector | Matrix, derivative: Expr | Vector | Matrix) -> DerivativeRule:
    """State what the derivative of a quantity is, as a consequence of other equations.

    Index reduction uses it where it would differentiate the equations of the quantity, which `defining` marks. It is
    no equation of its own. (An orientation changes with the angular velocity, ``dT/dt = -[w x] T``; differentiating
    its nine elements instead gives the same result with many times the operations.)
    """
    pairs: Any = quantity == derivative  # type: ignore[operator]
    items: tuple[Equation, ...] = pairs.equations if isinstance(pairs, VectorEquation) else (pairs,)
    return DerivativeRule(tuple((item.lhs, item.rhs) for item in items))


def defining(equation: Equation | VectorEquation) -> VectorEquation:
    """An equation that defines a quantity with a `derivative_rule`: it need not be differentiated."""
    return VectorEquation(tuple(replace(item, defines=True) for item in _scalar([equation])))


def _scalar(items: Sequence[Equation | VectorEquation]) -> tuple[Equation, ...]:
    out: list[Equation] = []
    for item in items:
        if not isinstance(item, (Equation, VectorEquation)):
            raise DeclarationError(f"choose() takes lists of equations, which {item!r} is not {call_site()}")
        out.extend(item.equations if isinstance(item, VectorEquation) else (item,))
    return tuple(out)


def _path(connector: Any, statement: str) -> Path:
    if not isinstance(connector, Overdetermined):
        raise DeclarationError(
            f"{statement}() is about an overdetermined connector such as `self.frame_a.R`, not {connector!r} "
            f"{call_site()}"
        )
    return connector.__dict__["_path"]
