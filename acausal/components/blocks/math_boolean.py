"""Logic of vectors of booleans, and delays and choices of booleans (Modelica.Blocks.MathBoolean)."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Parameter, Vector, pre, when, where

from .booleans import PartialBooleanMISO, PartialBooleanSISO, boolean, first_true, true
from .logical import Change as ChangingEdge
from .logical import Edge as RisingEdge
from .logical import FallingEdge, Not

__all__ = [
    "And", "ChangingEdge", "FallingEdge", "MultiSwitch", "Nand", "Nor", "Not", "OnDelay", "Or", "RisingEdge", "Xor",
]  # fmt: skip


def all_true(signals: Vector) -> Expr:
    """1 if all booleans are true, else 0."""
    found = 1.0 + 0.0 * ac.time
    for signal in signals:
        found = where(true(signal), found, 0.0)
    return found


def any_true(signals: Vector) -> Expr:
    """1 if one of the booleans or more are true, else 0."""
    found = 0.0 * ac.time
    for signal in signals:
        found = where(true(signal), 1.0, found)
    return found


class And(PartialBooleanMISO):
    """``y = u[1] and u[2] and ... and u[nu]``.

    >>> model = assemble("early.y - gate.u[0]", "late.y - gate.u[1]", early=BooleanStep(startTime=0.2),
    ...                  late=BooleanStep(startTime=0.6), gate=math_boolean.And(nu=2))
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 0.0, 1.0]

    Source: Modelica.Blocks.MathBoolean.And.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == all_true(self.u)


class Or(PartialBooleanMISO):
    """``y = u[1] or u[2] or ... or u[nu]``.

    >>> model = assemble("early.y - gate.u[0]", "late.y - gate.u[1]", early=BooleanStep(startTime=0.2),
    ...                  late=BooleanStep(startTime=0.6), gate=math_boolean.Or(nu=2))
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 1.0]

    Source: Modelica.Blocks.MathBoolean.Or.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == any_true(self.u)


class Xor(PartialBooleanMISO):
    """True if exactly one of the inputs is true.

    >>> model = assemble("early.y - gate.u[0]", "late.y - gate.u[1] - gate.u[2]", early=BooleanStep(startTime=0.2),
    ...                  late=BooleanStep(startTime=0.6), gate=math_boolean.Xor(nu=3))
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.MathBoolean.Xor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        none, one = 1.0 + 0.0 * ac.time, 0.0 * ac.time
        for signal in self.u:
            none, one = where(true(signal), 0.0, none), where(true(signal), none, one)
        yield self.y == one


class Nand(PartialBooleanMISO):
    """``y = not (u[1] and u[2] and ... and u[nu])``.

    >>> model = assemble("early.y - gate.u[0]", "late.y - gate.u[1]", early=BooleanStep(startTime=0.2),
    ...                  late=BooleanStep(startTime=0.6), gate=math_boolean.Nand(nu=2))
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.MathBoolean.Nand.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == 1.0 - all_true(self.u)


class Nor(PartialBooleanMISO):
    """``y = not (u[1] or u[2] or ... or u[nu])``.

    >>> model = assemble("early.y - gate.u[0]", "late.y - gate.u[1]", early=BooleanStep(startTime=0.2),
    ...                  late=BooleanStep(startTime=0.6), gate=math_boolean.Nor(nu=2))
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 0.0, 0.0]

    Source: Modelica.Blocks.MathBoolean.Nor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == 1.0 - any_true(self.u)


class MultiSwitch(Component):
    """The boolean ``expr[i]`` (1 or 0) of the first boolean ``u[i]`` that is true.

    Where none is, the last value stays, or it is `y_default` without `use_pre_as_default`; that is the value before the
    start, too.

    >>> model = assemble("on.y - latch.u[0]", "off.y - latch.u[1]", on=BooleanTable(table=[0.2, 0.3]),
    ...                  off=BooleanTable(table=[0.6, 0.7]), latch=math_boolean.MultiSwitch(nu=2, expr=(1, 0)))
    >>> run(model, at=[0.1, 0.4, 0.8])["latch.y"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.MathBoolean.MultiSwitch.
    """

    nu: int = 2
    use_pre_as_default: bool = True
    expr: Vector = Vector(Parameter(0.0, doc="boolean where u[i] is the first that is true, 1 or 0"), size="nu")
    y_default: Parameter = Parameter(0.0, doc="boolean where no u[i] is true, 1 or 0")
    u: Vector = Vector(Input(doc="boolean signal"), size="nu")
    y: Discrete = Discrete(start=y_default, doc="chosen boolean")

    def equations(self) -> Equations:
        yield from super().equations()
        default = pre(self.y) if self.use_pre_as_default else self.y_default
        yield self.y == first_true(self.u, self.expr, default)


class OnDelay(PartialBooleanSISO):
    """The input, but true only `delayTime` after it has become true; false at once. True at the start is true at once.

    >>> model = assemble("pulse.y - late.u", pulse=BooleanTable(table=[0.2, 0.6]),
    ...                  late=math_boolean.OnDelay(delayTime=0.1))
    >>> run(model, at=[0.1, 0.25, 0.4, 0.65, 0.9])["late.y"]
    [0.0, 0.0, 1.0, 0.0, 0.0]

    Source: Modelica.Blocks.MathBoolean.OnDelay.
    """

    delayTime: Parameter = Parameter(0.1, unit="s", min=0.0, doc="delay of rising edges")
    t_next: Discrete = Discrete(unit="s", start=-1e300, doc="time at which the last rising edge is passed on")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(true(self.u), {self.t_next: ac.time + self.delayTime})
        yield self.y == boolean(true(self.u) & (ac.time >= self.t_next))
