"""Booleans: comparisons, logic, edges, switches with hysteresis. True is 1 and false is 0."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Output, Parameter, pre, when, where

from .interfaces import SISO


def true(signal: Expr) -> Expr:
    """The condition that a boolean signal, 1 or 0, is true."""
    return signal > 0.5


def boolean(condition: Expr) -> Expr:
    """1 where `condition` holds, else 0."""
    return where(condition, 1.0, 0.0)


class PartialBooleanSource(Component, partial=True):
    """A boolean output `y`, no input.

    Source: Modelica.Blocks.Interfaces.partialBooleanSource.
    """

    y: Discrete = Discrete(doc="boolean signal")


class BooleanConstant(PartialBooleanSource):
    """Constant boolean, ``y = k``.

    >>> run(BooleanConstant(k=True))["y"]
    [1.0, 1.0]

    Source: Modelica.Blocks.Sources.BooleanConstant.
    """

    k: bool = True

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == (1.0 if self.k else 0.0)


class BooleanStep(PartialBooleanSource):
    """Boolean step: `startValue` before `startTime`, the opposite from then on.

    >>> run(BooleanStep(startTime=0.5), at=[0.0, 0.4, 0.6, 1.0])["y"]
    [0.0, 0.0, 1.0, 1.0]

    Source: Modelica.Blocks.Sources.BooleanStep.
    """

    startValue: bool = False
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        before, after = (1.0, 0.0) if self.startValue else (0.0, 1.0)
        yield self.y == where(ac.time >= self.startTime, after, before)


class BooleanPulse(PartialBooleanSource):
    """Boolean pulses that last `width` per cent of each `period`, from `startTime` on.

    >>> run(BooleanPulse(width=25.0, period=0.8, startTime=0.1), at=[0.0, 0.2, 0.5, 0.95])["y"]
    [0.0, 1.0, 0.0, 1.0]

    Source: Modelica.Blocks.Sources.BooleanPulse.
    """

    width: Parameter = Parameter(50.0, min=0.0, max=100.0, doc="width in per cent of the period")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the first pulse")
    pulseStart: Discrete = Discrete(unit="s", start=-1e300, doc="time of the beginning of the last pulse")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(ac.sample(self.startTime, self.period), {self.pulseStart: ac.time})
        begun = ac.time >= self.pulseStart
        yield self.y == boolean(begun & (ac.time < self.pulseStart + self.period * self.width / 100))


class BooleanTable(PartialBooleanSource):
    """Boolean that changes at each time of a table, beginning with `startValue`.

    >>> run(BooleanTable(table=[0.25, 0.5, 0.75]), at=[0.1, 0.3, 0.6, 0.9])["y"]
    [0.0, 1.0, 0.0, 1.0]

    Source: Modelica.Blocks.Sources.BooleanTable.
    """

    table: Sequence[float] = (0.0, 1.0)
    startValue: bool = False

    def equations(self) -> Equations:
        yield from super().equations()
        y = 1.0 if self.startValue else 0.0
        value: Expr | float = y
        for time in self.table:
            y = 1.0 - y
            value = where(ac.time >= time, y, value)
        yield self.y == value


class PartialThreshold(Component, partial=True):
    """A signal `u` compared with a `threshold`.

    Source: Modelica.Blocks.Logical.GreaterThreshold.
    """

    u: Input = Input(doc="signal")
    threshold: Parameter = Parameter(0.0, doc="threshold")
    y: Discrete = Discrete(doc="boolean result")


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


class PartialComparison(Component, partial=True):
    """Two signals `u1` and `u2` compared.

    Source: Modelica.Blocks.Interfaces.partialBooleanComparison.
    """

    u1: Input = Input(doc="first signal")
    u2: Input = Input(doc="second signal")
    y: Discrete = Discrete(doc="boolean result")


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


class PartialBooleanSISO(Component, partial=True):
    """A boolean input `u` and a boolean output `y`.

    Source: Modelica.Blocks.Interfaces.partialBooleanSISO.
    """

    u: Input = Input(doc="boolean signal")
    y: Discrete = Discrete(doc="boolean result")


class Not(PartialBooleanSISO):
    """``y = not u``.

    >>> run(assemble("step.y - test.u", step=BooleanStep(startTime=0.5), test=Not()), at=[0.4, 0.6])["test.y"]
    [1.0, 0.0]

    Source: Modelica.Blocks.Logical.Not.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u), 0.0, 1.0)


class Pre(PartialBooleanSISO):
    """The input before the present event, ``y = pre(u)``; breaks loops of booleans.

    >>> model = assemble("step.y - test.u", step=BooleanStep(startTime=0.5), test=Pre())
    >>> run(model, at=[0.4, 0.6])["test.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Logical.Pre.
    """

    held: Discrete = Discrete(doc="the input")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.held == boolean(true(self.u))
        yield self.y == pre(self.held)


class PartialBooleanSI2SO(PartialComparison, partial=True):
    """Two boolean inputs `u1` and `u2` and a boolean output `y`.

    Source: Modelica.Blocks.Interfaces.partialBooleanSI2SO.
    """


class And(PartialBooleanSI2SO):
    """``y = u1 and u2``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=And())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 0.0, 1.0]

    Source: Modelica.Blocks.Logical.And.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u1) & true(self.u2))


class Or(PartialBooleanSI2SO):
    """``y = u1 or u2``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Or())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 1.0]

    Source: Modelica.Blocks.Logical.Or.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u1) | true(self.u2))


class Xor(PartialBooleanSI2SO):
    """``y = u1 or u2, but not both``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Xor())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.Xor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        one, two = true(self.u1), true(self.u2)
        yield self.y == boolean((one | two) & ~(one & two))


class Nand(PartialBooleanSI2SO):
    """``y = not (u1 and u2)``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Nand())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.Nand.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u1) & true(self.u2), 0.0, 1.0)


class Nor(PartialBooleanSI2SO):
    """``y = not (u1 or u2)``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Nor())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 0.0, 0.0]

    Source: Modelica.Blocks.Logical.Nor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u1) | true(self.u2), 0.0, 1.0)


class RSFlipFlop(Component):
    """Flip-flop: `Q` is set by `S` and reset by `R`, which wins; `QI` is the opposite.

    >>> model = assemble("on.y - flip.S", "off.y - flip.R", on=BooleanTable(table=[0.2, 0.3]),
    ...                  off=BooleanTable(table=[0.6, 0.7]), flip=RSFlipFlop())
    >>> run(model, at=[0.1, 0.4, 0.8])["flip.Q"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.RSFlipFlop.
    """

    S: Input = Input(doc="boolean that sets")
    R: Input = Input(doc="boolean that resets")
    Q: Discrete = Discrete(doc="state")
    QI: Discrete = Discrete(start=1.0, doc="opposite of the state")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q == where(true(self.R), 0.0, where(true(self.S), 1.0, pre(self.Q)))
        yield self.QI == where(true(self.Q), 0.0, 1.0)


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
    y: Discrete = Discrete(doc="boolean state; its start is the state before the simulation")

    def equations(self) -> Equations:
        yield from super().equations()
        stays = true(pre(self.y)) & (self.u >= self.uLow)
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
    y: Discrete = Discrete(doc="boolean state; its start is the state before the simulation")

    def equations(self) -> Equations:
        yield from super().equations()
        half = self.bandwidth / 2
        stays = true(pre(self.y)) & (self.u < self.reference + half)
        yield self.y == boolean(stays | (self.u < self.reference - half))


class Switch(Component):
    """One of two signals, ``y = u1`` where ``u2 >= threshold`` (true, for a boolean 0 or 1), else ``u3``.

    >>> model = assemble("one.y - switch.u1", "ramp.y - switch.u2 - switch.u3", one=Constant(k=1.0), ramp=Slope(),
    ...                  switch=Switch())
    >>> run(model, at=[0.0, 0.25, 1.0])["switch.y"]
    [0.0, 0.25, 1.0]

    Source: Modelica.Blocks.Logical.Switch with a Modelica.Blocks.Logical.GreaterEqualThreshold.
    """

    u1: Input = Input(doc="signal above the threshold")
    u2: Input = Input(doc="signal that decides")
    u3: Input = Input(doc="signal below the threshold")
    y: Output = Output(doc="chosen signal")
    threshold: Parameter = Parameter(0.5, doc="threshold of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.u2 >= self.threshold, self.u1, self.u3)


class LogicalSwitch(Component):
    """One of two booleans, ``y = u1`` where `u2` is true, else ``u3``.

    >>> model = assemble("one.y - switch.u1", "step.y - switch.u2", "none.y - switch.u3", one=BooleanConstant(k=True),
    ...                  none=BooleanConstant(k=False), step=BooleanStep(startTime=0.5), switch=LogicalSwitch())
    >>> run(model, at=[0.4, 0.6])["switch.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Logical.LogicalSwitch.
    """

    u1: Input = Input(doc="boolean where u2 is true")
    u2: Input = Input(doc="boolean that decides")
    u3: Input = Input(doc="boolean where u2 is false")
    y: Discrete = Discrete(doc="chosen boolean")

    def equations(self) -> Equations:
        yield from super().equations()
        chosen = (true(self.u2) & true(self.u1)) | (~true(self.u2) & true(self.u3))
        yield self.y == boolean(chosen)


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


class RealToBoolean(PartialThreshold):
    """A boolean for a number, ``y = u >= threshold``.

    >>> model = assemble("ramp.y - test.u", ramp=Slope(slope=1.0), test=RealToBoolean(threshold=0.5))
    >>> run(model, at=[0.4, 0.6])["test.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Math.RealToBoolean.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.u >= self.threshold)


class Timer(Component):
    """Time since the boolean `u` has become true, 0 while it is false.

    >>> model = assemble("step.y - timer.u", step=BooleanStep(startTime=0.25), timer=Timer())
    >>> close(run(model, at=[0.2, 0.5, 1.0])["timer.y"], [0.0, 0.25, 0.75])
    True

    Source: Modelica.Blocks.Logical.Timer.
    """

    u: Input = Input(doc="boolean signal")
    y: Output = Output(unit="s", doc="time since u has become true")
    entryTime: Discrete = Discrete(unit="s", doc="time at which u has become true")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(true(self.u), {self.entryTime: ac.time})
        yield self.y == where(true(self.u), ac.time - self.entryTime, 0.0)


class TriggeredTrapezoid(Component):
    """Rises to `amplitude` during `rising` when `u` becomes true, falls to 0 during `falling` when it becomes false.

    >>> model = assemble("pulse.y - shape.u", pulse=BooleanTable(table=[0.2, 0.6]),
    ...                  shape=TriggeredTrapezoid(amplitude=2.0, rising=0.2, falling=0.4))
    >>> close(run(model, at=[0.1, 0.3, 0.5, 0.8])["shape.y"], [0.0, 1.0, 2.0, 1.0])
    True

    Source: Modelica.Blocks.Logical.TriggeredTrapezoid.
    """

    u: Input = Input(doc="boolean signal")
    y: Output = Output(doc="signal")
    amplitude: Parameter = Parameter(1.0, doc="height")
    rising: Parameter = Parameter(1e-9, unit="s", min=1e-60, doc="duration of the rise")
    falling: Parameter = Parameter(rising, unit="s", min=1e-60, doc="duration of the fall")
    offset: Parameter = Parameter(0.0, doc="value that the trapezoid is added to")
    endValue: Discrete = Discrete(doc="value that is approached, without the offset")
    rate: Discrete = Discrete(unit="1/s", doc="rate of the approach")
    T: Discrete = Discrete(unit="s", start=-1e300, doc="time at which endValue is reached")

    def equations(self) -> Equations:
        yield from super().equations()
        on, level = true(self.u), self.y - self.offset
        rise, fall = self.amplitude / self.rising, -self.amplitude / self.falling
        up = {
            self.endValue: self.amplitude, self.rate: rise, self.T: ac.time + (self.amplitude - pre(level)) / rise
        }  # fmt: skip
        down = {self.endValue: 0.0, self.rate: fall, self.T: ac.time - pre(level) / fall}
        yield when(on, up).elsewhen(~on, down)
        yield self.y == self.offset + where(
            ac.time < self.T, self.endValue - (self.T - ac.time) * self.rate, self.endValue
        )
