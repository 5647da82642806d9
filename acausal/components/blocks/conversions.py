"""Signals of one kind as another: reals, integers and booleans."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Parameter, where

from .booleans import PartialThreshold, boolean, true
from .interfaces import SISO


class PartialToInteger(Component, partial=True):
    """An input `u` and an integer output `y`.

    Source: Modelica.Blocks.Math.RealToInteger.
    """

    u: Input = Input(doc="signal")
    y: Discrete = Discrete(doc="integer")


class RealToInteger(PartialToInteger):
    """The nearest integer; halves are rounded away from zero.

    >>> model = assemble("ramp.y - round.u", ramp=Slope(slope=6.0, offset=-3.0), round=RealToInteger())
    >>> run(model, at=[0.0, 0.1, 0.4, 0.6, 0.9])["round.y"]
    [-3.0, -2.0, -1.0, 1.0, 2.0]

    Source: Modelica.Blocks.Math.RealToInteger.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.u > 0, ac.floor(self.u + 0.5), ac.ceil(self.u - 0.5))


class IntegerToReal(SISO):
    """The same number, ``y = u``.

    >>> model = assemble("step.y - number.u", step=IntegerStep(height=3, startTime=0.5), number=IntegerToReal())
    >>> run(model, at=[0.4, 0.6])["number.y"]
    [0.0, 3.0]

    Source: Modelica.Blocks.Math.IntegerToReal.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u


class BooleanToReal(SISO):
    """A number for a boolean, ``y = realTrue`` where `u` is true, else ``realFalse``.

    >>> model = assemble("step.y - number.u", step=BooleanStep(startTime=0.5), number=BooleanToReal(realTrue=7.0))
    >>> run(model, at=[0.4, 0.6])["number.y"]
    [0.0, 7.0]

    Source: Modelica.Blocks.Math.BooleanToReal.
    """

    realTrue: Parameter = Parameter(1.0, doc="value for true")
    realFalse: Parameter = Parameter(0.0, doc="value for false")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u), self.realTrue, self.realFalse)


class BooleanToInteger(PartialToInteger):
    """An integer for a boolean, ``y = integerTrue`` where `u` is true, else ``integerFalse``.

    >>> model = assemble("step.y - number.u", step=BooleanStep(startTime=0.5), number=BooleanToInteger(integerTrue=7))
    >>> run(model, at=[0.4, 0.6])["number.y"]
    [0.0, 7.0]

    Source: Modelica.Blocks.Math.BooleanToInteger.
    """

    integerTrue: Parameter = Parameter(1.0, doc="value for true, an integer")
    integerFalse: Parameter = Parameter(0.0, doc="value for false, an integer")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u), self.integerTrue, self.integerFalse)


class RealToBoolean(PartialThreshold):
    """A boolean for a number, ``y = u >= threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=RealToBoolean())
    >>> run(model, at=[0.4, 0.6])["test.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Math.RealToBoolean.
    """

    threshold: Parameter = Parameter(0.5, doc="threshold")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u >= self.threshold)


class IntegerToBoolean(PartialThreshold):
    """A boolean for an integer, ``y = u >= threshold``.

    >>> model = assemble("step.y - test.u", step=IntegerStep(startTime=0.5), test=IntegerToBoolean())
    >>> run(model, at=[0.4, 0.6])["test.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Math.IntegerToBoolean.
    """

    threshold: Parameter = Parameter(1.0, doc="threshold, an integer")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u >= self.threshold)
