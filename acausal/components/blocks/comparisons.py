"""Booleans from signals: thresholds, comparisons, relays with hysteresis."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Parameter, assert_, change, pre

from .booleans import PartialComparison, PartialThreshold, boolean, true


class GreaterThreshold(PartialThreshold):
    """``y = u > threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=GreaterThreshold(threshold=0.5))
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [0.0, 0.0, 1.0]

    Source: Modelica.Blocks.Logical.GreaterThreshold.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u > self.threshold)


class GreaterEqualThreshold(PartialThreshold):
    """``y = u >= threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=GreaterEqualThreshold(threshold=0.0))
    >>> run(model, at=[0.0, 0.4])["test.y"]
    [1.0, 1.0]

    Source: Modelica.Blocks.Logical.GreaterEqualThreshold.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u >= self.threshold)


class LessThreshold(PartialThreshold):
    """``y = u < threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=LessThreshold(threshold=0.5))
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.LessThreshold.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u < self.threshold)


class LessEqualThreshold(PartialThreshold):
    """``y = u <= threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=LessEqualThreshold(threshold=0.5))
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.LessEqualThreshold.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u <= self.threshold)


class Greater(PartialComparison):
    """``y = u1 > u2``.

    >>> model = assemble("ramp.y - test.u1", "half.y - test.u2", ramp=Slope(), half=Constant(k=0.5), test=Greater())
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [0.0, 0.0, 1.0]

    Source: Modelica.Blocks.Logical.Greater.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u1 > self.u2)


class GreaterEqual(PartialComparison):
    """``y = u1 >= u2``.

    >>> model = assemble("ramp.y - test.u1", "zero.y - test.u2", ramp=Slope(), zero=Constant(k=0.0),
    ...                  test=GreaterEqual())
    >>> run(model, at=[0.0, 0.4])["test.y"]
    [1.0, 1.0]

    Source: Modelica.Blocks.Logical.GreaterEqual.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u1 >= self.u2)


class Less(PartialComparison):
    """``y = u1 < u2``.

    >>> model = assemble("ramp.y - test.u1", "half.y - test.u2", ramp=Slope(), half=Constant(k=0.5), test=Less())
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.Less.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u1 < self.u2)


class LessEqual(PartialComparison):
    """``y = u1 <= u2``.

    >>> model = assemble("ramp.y - test.u1", "half.y - test.u2", ramp=Slope(), half=Constant(k=0.5), test=LessEqual())
    >>> run(model, at=[0.0, 0.4, 0.6])["test.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.LessEqual.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u1 <= self.u2)


class ZeroCrossing(Component):
    """True at the events at which `u` crosses zero while the boolean `enable` is true.

    ``u_pos = enable and u >= 0``, ``y = change(u_pos)``, except where `enable` itself changes.

    >>> model = assemble("wave.y - zero.u", "on.y - zero.enable", "zero.y - count.trigger", "one.y - count.u",
    ...                  wave=Sine(f=2.0, phase=1.0), on=BooleanStep(startTime=0.3), zero=ZeroCrossing(),
    ...                  one=IntegerConstant(), count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.2, 0.35, 0.5, 0.7, 1.0])["count.y"]
    [0.0, 0.0, 1.0, 2.0, 3.0]

    Source: Modelica.Blocks.Logical.ZeroCrossing.
    """

    u: Input = Input(doc="signal")
    enable: Input = Input(doc="boolean that enables")
    y: Discrete = Discrete(doc="true at crossings")
    enabled: Discrete = Discrete(doc="the boolean that enables")
    u_pos: Discrete = Discrete(doc="whether u is positive and enabled")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.enabled == boolean(true(self.enable))
        yield self.u_pos == boolean(true(self.enable) & (self.u >= 0))
        yield self.y == boolean(change(self.u_pos) & ~change(self.enabled))


def before(state: Expr, at_start: bool) -> Expr:
    """The condition that a boolean was true before an event; at the start as its start value says, or `at_start`."""
    was = true(pre(state))
    return was | ac.initial() if at_start else was


class Hysteresis(Component):
    """Relay: `y` becomes true where ``u > uHigh`` and false where ``u < uLow``, and stays in between.

    >>> model = assemble("wave.y - relay.u", wave=Sine(f=1.0), relay=Hysteresis(uLow=-0.5, uHigh=0.5))
    >>> run(model, at=[0.05, 0.25, 0.5, 0.75, 1.0])["relay.y"]
    [0.0, 1.0, 1.0, 0.0, 0.0]

    Source: Modelica.Blocks.Logical.Hysteresis.
    """

    u: Input = Input(doc="signal")
    uLow: Parameter = Parameter(0.0, doc="below it, false")
    uHigh: Parameter = Parameter(1.0, doc="above it, true")
    pre_y_start: bool = False
    y: Discrete = Discrete(doc="boolean state; its start, or `pre_y_start`, is the state before the simulation")

    def equations(self) -> Equations:
        yield from super().equations()
        yield assert_(self.uHigh > self.uLow, "the limits of a Hysteresis are uLow < uHigh")
        stays = before(self.y, self.pre_y_start) & (self.u >= self.uLow)
        yield self.y == boolean((self.u > self.uHigh) | stays)


class OnOffController(Component):
    """Two-point controller: on where ``u < reference - bandwidth/2``, off where ``u > reference + bandwidth/2``.

    >>> model = assemble("wanted.y - control.reference", "wave.y - control.u", wanted=Constant(k=0.0), wave=Sine(f=1.0),
    ...                  control=OnOffController(bandwidth=1.0))
    >>> run(model, at=[0.05, 0.25, 0.5, 0.75, 1.0])["control.y"]
    [0.0, 0.0, 0.0, 1.0, 1.0]

    Source: Modelica.Blocks.Logical.OnOffController.
    """

    reference: Input = Input(doc="wanted value of u")
    u: Input = Input(doc="measured value")
    bandwidth: Parameter = Parameter(0.1, doc="width of the band in which the state stays")
    pre_y_start: bool = False
    y: Discrete = Discrete(doc="boolean state; its start, or `pre_y_start`, is the state before the simulation")

    def equations(self) -> Equations:
        yield from super().equations()
        half = self.bandwidth / 2
        stays = before(self.y, self.pre_y_start) & (self.u < self.reference + half)
        yield self.y == boolean(stays | (self.u < self.reference - half))
