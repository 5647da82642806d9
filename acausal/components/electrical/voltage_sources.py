"""Voltage sources; their `offset` is added, and before `startTime` it is all there is."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Component, Equations, Input, Parameter, Variable, connect, structural, where

from .. import blocks
from .interfaces import OnePort, Pin, VoltageSource


class ConstantVoltage(OnePort):
    """Constant voltage, ``v = V``.

    >>> source = ConstantVoltage(V=2.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.v"], [2.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.ConstantVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="voltage")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.V


class StepVoltage(VoltageSource):
    """Voltage source: step of height `V` at `startTime`.

    >>> source = StepVoltage(V=2.0, offset=1.0, startTime=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.v"], [1.0, 3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.StepVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="height")
    signalSource: blocks.SO = blocks.Step(
        height=V, offset=VoltageSource.offset, startTime=VoltageSource.startTime
    )  # fmt: skip


class RampVoltage(VoltageSource):
    """Voltage source: ramp of height `V` that lasts `duration`.

    >>> source = RampVoltage(V=2.0, duration=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.25, 1.0])["source.v"], [1.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.RampVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="height")
    duration: Parameter = Parameter(2.0, unit="s", min=1e-60, doc="duration of the ramp")
    signalSource: blocks.SO = blocks.Ramp(
        height=V, duration=duration, offset=VoltageSource.offset, startTime=VoltageSource.startTime
    )  # fmt: skip


class SineVoltage(VoltageSource):
    """Voltage source: sine, ``V sin(2 pi f (t - startTime) + phase)``.

    >>> source = SineVoltage(V=2.0, f=0.5, offset=1.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 0.5])["source.v"], [1.0, 3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.SineVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    signalSource: blocks.SO = blocks.Sine(
        amplitude=V, f=f, phase=phase, offset=VoltageSource.offset, startTime=VoltageSource.startTime
    )  # fmt: skip


class CosineVoltage(VoltageSource):
    """Voltage source: cosine, ``V cos(2 pi f (t - startTime) + phase)``.

    >>> source = CosineVoltage(V=2.0, f=0.5, offset=1.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 1.0])["source.v"], [3.0, -1.0])
    True

    Source: Modelica.Electrical.Analog.Sources.CosineVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    signalSource: blocks.SO = blocks.Cosine(
        amplitude=V, f=f, phase=phase, offset=VoltageSource.offset, startTime=VoltageSource.startTime
    )  # fmt: skip


class ExpSineVoltage(VoltageSource):
    """Voltage source: damped sine, ``V exp(-damping (t - startTime)) sin(2 pi f (t - startTime) + phase)``.

    >>> source = ExpSineVoltage(V=2.0, f=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.0, 0.5])["source.v"], [0.0, 2 * np.exp(-0.5)])
    True

    Source: Modelica.Electrical.Analog.Sources.ExpSineVoltage.
    """

    V: Parameter = Parameter(1.0, unit="V", doc="amplitude")
    f: Parameter = Parameter(2.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    damping: Parameter = Parameter(1.0, unit="1/s", doc="damping coefficient")
    signalSource: blocks.SO = blocks.ExpSine(
        amplitude=V, f=f, phase=phase, damping=damping, offset=VoltageSource.offset,
        startTime=VoltageSource.startTime
    )  # fmt: skip


class ExponentialsVoltage(VoltageSource):
    """Voltage source: exponential rise towards `vMax` for `riseTime`, then exponential fall.

    >>> source = ExponentialsVoltage(vMax=2.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.6])["source.v"], [2 - 2 * np.exp(-1.0), (2 - 2 * np.exp(-5.0)) * np.exp(-1.0)])
    True

    Source: Modelica.Electrical.Analog.Sources.ExponentialsVoltage.
    """

    vMax: Parameter = Parameter(1.0, unit="V", doc="height for an infinite rise time")
    riseTime: Parameter = Parameter(0.5, unit="s", min=0.0, doc="rise time")
    riseTimeConst: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time constant of the rise")
    fallTimeConst: Parameter = Parameter(riseTimeConst, unit="s", min=1e-60, doc="time constant of the fall")
    signalSource: blocks.SO = blocks.Exponentials(
        outMax=vMax, riseTime=riseTime, riseTimeConst=riseTimeConst, fallTimeConst=fallTimeConst,
        offset=VoltageSource.offset, startTime=VoltageSource.startTime, 
    )  # fmt: skip


class PulseVoltage(VoltageSource):
    """Voltage source: rectangular pulses of height `V`, `width` per cent of each `period`.

    >>> source = PulseVoltage(V=2.0, period=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.4, 0.6])["source.v"], [2.0, 0.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Sources.PulseVoltage.
    """

    nperiod: int = -1
    V: Parameter = Parameter(1.0, unit="V", doc="height")
    width: Parameter = Parameter(50.0, min=0.0, max=100.0, doc="width in per cent of the period")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.Pulse(
        amplitude=V, width=width, period=period, offset=VoltageSource.offset, startTime=VoltageSource.startTime,
        nperiod=structural("nperiod"),
    )  # fmt: skip


class SawToothVoltage(VoltageSource):
    """Voltage source: saw tooth of height `V`.

    >>> source = SawToothVoltage(V=2.0, period=0.5)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.4, 0.6])["source.v"], [0.4, 1.6, 0.4])
    True

    Source: Modelica.Electrical.Analog.Sources.SawToothVoltage.
    """

    nperiod: int = -1
    V: Parameter = Parameter(1.0, unit="V", doc="height")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.SawTooth(
        amplitude=V, period=period, offset=VoltageSource.offset, startTime=VoltageSource.startTime,
        nperiod=structural("nperiod"),
    )  # fmt: skip


class TrapezoidVoltage(VoltageSource):
    """Voltage source: trapezoids of height `V`.

    >>> source = TrapezoidVoltage(V=2.0, rising=0.2, width=0.2, falling=0.4)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.1, 0.3, 0.6])["source.v"], [1.0, 2.0, 1.0])
    True

    Source: Modelica.Electrical.Analog.Sources.TrapezoidVoltage.
    """

    nperiod: int = -1
    V: Parameter = Parameter(1.0, unit="V", doc="height")
    rising: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the rise")
    width: Parameter = Parameter(0.5, unit="s", min=0.0, doc="duration of the plateau")
    falling: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the fall")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")
    signalSource: blocks.SO = blocks.Trapezoid(
        amplitude=V, rising=rising, width=width, falling=falling, period=period, offset=VoltageSource.offset,
        startTime=VoltageSource.startTime, nperiod=structural("nperiod"),
    )  # fmt: skip


class TableVoltage(VoltageSource):
    """Voltage source: piecewise linear through the rows (time, voltage) of a table, the last two continued.

    >>> source = TableVoltage(table=[[0, 0], [0.5, 2], [1, 1]])
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> close(run(model, at=[0.25, 0.5, 0.75])["source.v"], [1.0, 2.0, 1.5])
    True

    Source: Modelica.Electrical.Analog.Sources.TableVoltage.
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


class SignalVoltage(Component):
    """Voltage given by the signal `v`, ``p.v - n.v = v``.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.v",
    ...                  source=SignalVoltage(), resistor=Resistor(R=4.0), ground=Ground(),
    ...                  ramp=blocks.Slope(slope=8.0))
    >>> run(model, at=[0.0, 0.5, 1.0])["resistor.i"]
    [0.0, 1.0, 2.0]

    Source: Modelica.Electrical.Analog.Sources.SignalVoltage.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    v: Input = Input(unit="V", doc="voltage from p to n")
    i: Variable = Variable(unit="A", doc="current from p to n through the source")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.p.v - self.n.v
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0


class SupplyVoltage(Component):
    """Two constant voltages with a common `ground`: `Vps` at `pin_p`, `Vns` at `pin_n`, as amplifiers need them.

    >>> model = assemble("supply.pin_p - upper.p", "supply.pin_n - lower.p", "supply.ground - upper.n - lower.n - g.p",
    ...                  supply=SupplyVoltage(Vps=12.0, Vns=-5.0), upper=Resistor(R=4.0), lower=Resistor(R=5.0),
    ...                  g=Ground())
    >>> volts = run(model)
    >>> close(volts["upper.i"], [3.0, 3.0]) and close(volts["lower.i"], [-1.0, -1.0])
    True

    Source: Modelica.Electrical.Analog.Sources.SupplyVoltage.
    """

    pin_p: Pin = Pin()
    pin_n: Pin = Pin()
    ground: Pin = Pin()
    Vps: Parameter = Parameter(15.0, unit="V", doc="positive supply voltage")
    Vns: Parameter = Parameter(-15.0, unit="V", doc="negative supply voltage")
    positiveSupply: ConstantVoltage = ConstantVoltage(V=Vps)
    negativeSupply: ConstantVoltage = ConstantVoltage(V=-Vns)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.pin_p, self.positiveSupply.p)
        yield connect(self.positiveSupply.n, self.ground, self.negativeSupply.p)
        yield connect(self.negativeSupply.n, self.pin_n)
