"""Booleans that depend on time alone."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Discrete,
    Equations,
    Expr,
    Input,
    Parameter,
    Vector,
    pre,
    structural,
    vector,
    when,
    where,
)

from .booleans import PartialBooleanSource, boolean, true
from .interfaces import BEGINNING
from .piecewise import interpolate


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
    pulseStart: Discrete = Discrete(unit="s", start=startTime, doc="time of the beginning of the last pulse")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(ac.sample(self.startTime, self.period), {self.pulseStart: ac.time})
        begun = ac.time >= self.pulseStart
        yield self.y == boolean(begun & (ac.time < self.pulseStart + self.period * self.width / 100))


class BooleanTable(PartialBooleanSource):
    """Boolean that changes at each time of a table, beginning with `startValue`; false before `startTime`.

    Behind the last time it stays (`extrapolation` HoldLastPoint) or begins anew (Periodic).

    >>> run(BooleanTable(table=[0.25, 0.5, 0.75]), at=[0.1, 0.3, 0.6, 0.9])["y"]
    [0.0, 1.0, 0.0, 1.0]

    Source: Modelica.Blocks.Sources.BooleanTable.
    """

    table: Sequence[float] = (0.0, 1.0)
    startValue: bool = False
    extrapolation: str = "HoldLastPoint"
    startTime: Parameter = Parameter(BEGINNING, unit="s", doc="false before")
    shiftTime: Parameter = Parameter(0.0, unit="s", doc="time of the table's zero")
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the times")

    def equations(self) -> Equations:
        yield from super().equations()
        times, first = list(self.table), 1.0 if self.startValue else 0.0
        values = [first, *((first + i) % 2 for i in range(1, len(times) + 1))]
        t = (ac.time - self.shiftTime) / self.timeScale
        value = held([times[0] if times else 0.0, *times], values, self.extrapolation, t)
        yield self.y == where(ac.time < self.startTime, 0.0, value)


def held(times: Sequence[float], values: Sequence[float], extrapolation: str, t: Expr) -> Expr:
    """The value of the last of the `times` at `t`; the first value before them.

    Raises:
        DeclarationError: times that do not increase (but for the first two), or an unsuitable extrapolation.
    """
    if any(b <= a for a, b in pairwise(times[1:])):
        raise DeclarationError(f"the times of a table must increase: {list(times[1:])}")
    if extrapolation not in ("HoldLastPoint", "Periodic"):
        raise DeclarationError(f"extrapolation={extrapolation!r} is none of HoldLastPoint, Periodic")
    return interpolate(t, times, values, "ConstantSegments", extrapolation)


class SampleTrigger(PartialBooleanSource):
    """True at the events at times ``startTime + k period``.

    >>> model = assemble("sample.y - count.trigger", "one.y - count.u", one=IntegerConstant(),
    ...                  sample=SampleTrigger(period=0.25, startTime=0.1), count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.0, 0.2, 0.4, 1.0])["count.y"]
    [0.0, 1.0, 2.0, 4.0]

    Source: Modelica.Blocks.Sources.SampleTrigger.
    """

    period: Parameter = Parameter(0.01, unit="s", min=1e-60, doc="time between two samples")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the first sample")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(ac.sample(self.startTime, self.period))


class BooleanExpression(PartialBooleanSource):
    """A boolean given by an equation of the model that has this block.

    >>> class Model(Component):
    ...     late: BooleanExpression = BooleanExpression()
    ...     no: Not = Not()
    ...     def equations(self):
    ...         yield self.late.y == boolean(ac.time > 0.5)
    ...         yield connect(self.late.y, self.no.u)
    >>> run(Model(), at=[0.4, 0.6])["no.y"]
    [1.0, 0.0]

    Source: Modelica.Blocks.Sources.BooleanExpression.
    """


class RadioButtonSource(Component):
    """A button that is on from each time of `buttonTimeTable` until one of the booleans `reset` becomes true.

    >>> model = assemble("start.on - stop.reset[0]", "stop.on - start.reset[0]",
    ...                  start=RadioButtonSource(buttonTimeTable=[0.2, 0.6]),
    ...                  stop=RadioButtonSource(buttonTimeTable=[0.4, 0.8]))
    >>> run(model, at=[0.1, 0.3, 0.5, 0.7, 0.9])["start.on"]
    [0.0, 1.0, 0.0, 1.0, 0.0]

    Source: Modelica.Blocks.Sources.RadioButtonSource.
    """

    buttonTimeTable: Sequence[float] = (0.0, 1.0)
    nReset: int = 1
    reset: Vector = Vector(Input(doc="boolean that resets"), size="nReset")
    was: Vector = Vector(Discrete(doc="the boolean that resets"), size="nReset")
    on: Discrete = Discrete(doc="whether the button is on")
    table: BooleanTable = BooleanTable(table=structural("buttonTimeTable"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.was == vector(*(boolean(true(signal)) for signal in self.reset))
        pressed = when(ac.change(self.table.y), {self.on: 1.0})
        if self.nReset:  # a loop of buttons that reset each other is broken by the left limits
            pressed = pressed.elsewhen([true(pre(signal)) for signal in self.was], {self.on: 0.0})
        yield pressed
