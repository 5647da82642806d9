"""Current sources; their `offset` is added, and before `startTime` it is all there is."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Equations, Input, Parameter, Variable, structural, where

from .. import blocks
from .interfaces import CurrentSource, OnePort, TwoPin


class ConstantCurrent(OnePort):
    """Constant current from p to n through the source, ``i = I``.

    >>> source = ConstantCurrent(I=2.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.i"], [2.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.ConstantCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="current")  # noqa: E741

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.I


class StepCurrent(CurrentSource):
    """Current source: step of height `I` at `startTime`.

    >>> source = StepCurrent(I=2.0, offset=1.0, startTime=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.i"], [1.0, 3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.StepCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="height")  # noqa: E741
    signalSource: blocks.SO = blocks.Step(
        height=I, offset=CurrentSource.offset, startTime=CurrentSource.startTime
    )  # fmt: skip


class RampCurrent(CurrentSource):
    """Current source: ramp of height `I` that lasts `duration`.

    >>> source = RampCurrent(I=2.0, duration=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.25, 1.0])["source.i"], [1.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.RampCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="height")  # noqa: E741
    duration: Parameter = Parameter(2.0, unit="s", min=1e-60, doc="duration of the ramp")
    signalSource: blocks.SO = blocks.Ramp(
        height=I, duration=duration, offset=CurrentSource.offset, startTime=CurrentSource.startTime
    )  # fmt: skip


class SineCurrent(CurrentSource):
    """Current source: sine, ``I sin(2 pi f (t - startTime) + phase)``.

    >>> source = SineCurrent(I=2.0, f=0.5, offset=1.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 0.5])["source.i"], [1.0, 3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.SineCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="amplitude")  # noqa: E741
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    signalSource: blocks.SO = blocks.Sine(
        amplitude=I, f=f, phase=phase, offset=CurrentSource.offset, startTime=CurrentSource.startTime
    )  # fmt: skip


class CosineCurrent(CurrentSource):
    """Current source: cosine, ``I cos(2 pi f (t - startTime) + phase)``.

    >>> source = CosineCurrent(I=2.0, f=0.5, offset=1.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.i"], [3.0, -1.0])
    True

    Source: Modelica.Electrical.Analog.Sources.CosineCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="amplitude")  # noqa: E741
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    signalSource: blocks.SO = blocks.Cosine(
        amplitude=I, f=f, phase=phase, offset=CurrentSource.offset, startTime=CurrentSource.startTime
    )  # fmt: skip


class ExpSineCurrent(CurrentSource):
    """Current source: damped sine, ``I exp(-damping (t - startTime)) sin(2 pi f (t - startTime) + phase)``.

    >>> source = ExpSineCurrent(I=2.0, f=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 0.5])["source.i"], [0.0, 2 * np.exp(-0.5)])
    True

    Source: Modelica.Electrical.Analog.Sources.ExpSineCurrent.
    """

    I: Parameter = Parameter(1.0, unit="A", doc="amplitude")  # noqa: E741
    f: Parameter = Parameter(2.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    damping: Parameter = Parameter(1.0, unit="1/s", doc="damping coefficient")
    signalSource: blocks.SO = blocks.ExpSine(
        amplitude=I, f=f, phase=phase, damping=damping, offset=CurrentSource.offset,
        startTime=CurrentSource.startTime
    )  # fmt: skip


class ExponentialsCurrent(CurrentSource):
    """Current source: exponential rise towards `iMax` for `riseTime`, then exponential fall.

    >>> source = ExponentialsCurrent(iMax=2.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.6])["source.i"], [2 - 2 * np.exp(-1.0), (2 - 2 * np.exp(-5.0)) * np.exp(-1.0)])
    True

    Source: Modelica.Electrical.Analog.Sources.ExponentialsCurrent.
    """

    iMax: Parameter = Parameter(1.0, unit="A", doc="height for an infinite rise time")
    riseTime: Parameter = Parameter(0.5, unit="s", min=0.0, doc="rise time")
    riseTimeConst: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time constant of the rise")
    fallTimeConst: Parameter = Parameter(riseTimeConst, unit="s", min=1e-60, doc="time constant of the fall")
    signalSource: blocks.SO = blocks.Exponentials(
        outMax=iMax, riseTime=riseTime, riseTimeConst=riseTimeConst, fallTimeConst=fallTimeConst,
        offset=CurrentSource.offset, startTime=CurrentSource.startTime, 
    )  # fmt: skip


class PulseCurrent(CurrentSource):
    """Current source: rectangular pulses of height `I`, `width` per cent of each `period`.

    >>> source = PulseCurrent(I=2.0, period=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.4, 0.6])["source.i"], [2.0, 0.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.PulseCurrent.
    """

    nperiod: int = -1
    I: Parameter = Parameter(1.0, unit="A", doc="height")  # noqa: E741
    width: Parameter = Parameter(50.0, min=0.0, max=100.0, doc="width in per cent of the period")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.Pulse(
        amplitude=I, width=width, period=period, offset=CurrentSource.offset, startTime=CurrentSource.startTime,
        nperiod=structural("nperiod"),
    )  # fmt: skip


class SawToothCurrent(CurrentSource):
    """Current source: saw tooth of height `I`.

    >>> source = SawToothCurrent(I=2.0, period=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.4, 0.6])["source.i"], [0.4, 1.6, 0.4])
    True

    Source: Modelica.Electrical.Analog.Sources.SawToothCurrent.
    """

    nperiod: int = -1
    I: Parameter = Parameter(1.0, unit="A", doc="height")  # noqa: E741
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.SawTooth(
        amplitude=I, period=period, offset=CurrentSource.offset, startTime=CurrentSource.startTime,
        nperiod=structural("nperiod"),
    )  # fmt: skip


class TrapezoidCurrent(CurrentSource):
    """Current source: trapezoids of height `I`.

    >>> source = TrapezoidCurrent(I=2.0, rising=0.2, width=0.2, falling=0.4)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.3, 0.6])["source.i"], [1.0, 2.0, 1.0])
    True

    Source: Modelica.Electrical.Analog.Sources.TrapezoidCurrent.
    """

    nperiod: int = -1
    I: Parameter = Parameter(1.0, unit="A", doc="height")  # noqa: E741
    rising: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the rise")
    width: Parameter = Parameter(0.5, unit="s", min=0.0, doc="duration of the plateau")
    falling: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the fall")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.Trapezoid(
        amplitude=I, rising=rising, width=width, falling=falling, period=period, offset=CurrentSource.offset,
        startTime=CurrentSource.startTime, nperiod=structural("nperiod"),
    )  # fmt: skip


class TableCurrent(CurrentSource):
    """Current source: piecewise linear through the rows (time, current) of a table, the last two continued.

    >>> source = TableCurrent(table=[[0, 0], [0.5, 2], [1, 1]])
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.25, 0.5, 0.75])["source.i"], [1.0, 2.0, 1.5])
    True

    Source: Modelica.Electrical.Analog.Sources.TableCurrent.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0), (1.0, 1.0), (2.0, 4.0))
    signalSource: blocks.SO = blocks.RealExpression()
    elapsed: Variable = Variable(doc="time since startTime")

    def equations(self) -> Equations:
        yield from super().equations()
        times, values = [row[0] for row in self.table], [row[1] for row in self.table]
        value = blocks.interpolate(self.elapsed, times, values)
        yield self.elapsed == ac.time - self.startTime
        yield self.signalSource.y == self.offset + where(ac.time < self.startTime, 0.0, value)


class SignalCurrent(TwoPin):
    """Current given by the signal `i`, from p to n through the source.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.i",
    ...                  source=SignalCurrent(), resistor=Resistor(R=4.0), ground=Ground(),
    ...                  ramp=blocks.Slope(slope=8.0))
    >>> run(model, at=[0.0, 0.5, 1.0])["resistor.v"]
    [0.0, -16.0, -32.0]

    Source: Modelica.Electrical.Analog.Sources.SignalCurrent.
    """

    i: Input = Input(unit="A", doc="current from p to n through the source")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0
