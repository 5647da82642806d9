"""Signals that depend on time alone."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import (
    PI,
    Component,
    Equations,
    Expr,
    Input,
    Output,
    Parameter,
    Variable,
    clip,
    cos,
    der,
    exp,
    sin,
    sqrt,
    where,
)

from .interfaces import SO, SignalSource
from .piecewise import interpolate

BEGINNING = -1e300
"""A start time that always has been [s]."""


class Constant(SO):
    """Constant signal, ``y = k``.

    >>> run(Constant(k=3.0))["y"][-1]
    3.0

    Source: Modelica.Blocks.Sources.Constant.
    """

    k: Parameter = Parameter(1.0, doc="value")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k


class Step(SignalSource):
    """Step, ``y = offset``, from `startTime` on ``offset + height``.

    >>> run(Step(height=2.0, offset=1.0, startTime=0.5), at=[0.0, 0.4, 0.6, 1.0])["y"]
    [1.0, 1.0, 3.0, 3.0]

    Source: Modelica.Blocks.Sources.Step.
    """

    height: Parameter = Parameter(1.0, doc="height of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + where(ac.time >= self.startTime, self.height, 0.0)


class Ramp(SignalSource):
    """Ramp from `offset` to ``offset + height`` between `startTime` and ``startTime + duration``.

    >>> run(Ramp(height=4.0, duration=0.5, startTime=0.25), at=[0.0, 0.25, 0.5, 1.0])["y"]
    [0.0, 0.0, 2.0, 4.0]

    Source: Modelica.Blocks.Sources.Ramp.
    """

    height: Parameter = Parameter(1.0, doc="height of the ramp")
    duration: Parameter = Parameter(2.0, unit="s", min=1e-30, doc="duration of the ramp")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + self.height * clip((ac.time - self.startTime) / self.duration, 0.0, 1.0)


class Slope(SignalSource):
    """Endless ramp, ``y = offset + slope (t - startTime)``, and `offset` before `startTime`.

    >>> run(Slope(slope=2.0, offset=1.0, startTime=0.5), at=[0.0, 0.5, 1.0])["y"]
    [1.0, 1.0, 2.0]

    Source: Modelica.Blocks.Sources.Ramp with infinite duration.
    """

    slope: Parameter = Parameter(1.0, doc="change of the signal per second")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + self.slope * ac.max(ac.time - self.startTime, 0.0)


class ContinuousClock(SignalSource):
    """Time since `startTime`, ``y = offset + t - startTime``, and `offset` before.

    >>> run(ContinuousClock(startTime=0.25), at=[0.0, 1.0])["y"]
    [0.0, 0.75]

    Source: Modelica.Blocks.Sources.ContinuousClock.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, ac.time - self.startTime)


class Sine(SignalSource):
    """Sine, ``y = offset + amplitude sin(2 pi f (t - startTime) + phase)``, and `offset` before `startTime`.

    >>> run(Sine(amplitude=2.0, f=0.25, offset=1.0), at=[0.0, 1.0])["y"]
    [1.0, 3.0]

    Source: Modelica.Blocks.Sources.Sine.
    """

    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")

    def equations(self) -> Equations:
        yield from super().equations()
        wave = self.amplitude * sin(2 * PI * self.f * (ac.time - self.startTime) + self.phase)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, wave)


class Cosine(SignalSource):
    """Cosine, ``y = offset + amplitude cos(2 pi f (t - startTime) + phase)``, and `offset` before `startTime`.

    >>> run(Cosine(amplitude=2.0, f=0.5, startTime=0.5), at=[0.0, 0.5, 1.5])["y"]
    [0.0, 2.0, -2.0]

    Source: Modelica.Blocks.Sources.Cosine.
    """

    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")

    def equations(self) -> Equations:
        yield from super().equations()
        wave = self.amplitude * cos(2 * PI * self.f * (ac.time - self.startTime) + self.phase)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, wave)


class SineVariableFrequencyAndAmplitude(SO):
    """Sine whose frequency and amplitude are signals, ``y = offset + amplitude sin(phi)``, ``dphi/dt = 2 pi f``.

    >>> class Sweep(Component):
    ...     f: Ramp = Ramp(height=2.0, duration=1.0)
    ...     sine: SineVariableFrequencyAndAmplitude = SineVariableFrequencyAndAmplitude(useConstantAmplitude=True)
    ...     def equations(self):
    ...         yield connect(self.f.y, self.sine.f)
    >>> t = np.linspace(0.0, 1.0, 5)
    >>> close(run(Sweep(), at=t)["sine.y"], np.sin(2 * np.pi * t**2))
    True

    Source: Modelica.Blocks.Sources.SineVariableFrequencyAndAmplitude.
    """

    useConstantAmplitude: bool = False
    useConstantFrequency: bool = False
    amplitude: Input = Input(doc="amplitude; `constantAmplitude` if that is used")
    f: Input = Input(unit="Hz", doc="frequency; `constantFrequency` if that is used")
    constantAmplitude: Parameter = Parameter(1.0, doc="amplitude with useConstantAmplitude")
    constantFrequency: Parameter = Parameter(1.0, unit="Hz", doc="frequency with useConstantFrequency")
    offset: Parameter = Parameter(0.0, doc="value that the sine is added to")
    phi: Variable = Variable(unit="rad", start=0.0, fixed=True, doc="phase of the sine")

    def wave(self) -> Expr:
        """The wave of unit amplitude."""
        return sin(self.phi)

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantAmplitude:
            yield self.amplitude == self.constantAmplitude
        if self.useConstantFrequency:
            yield self.f == self.constantFrequency
        yield der(self.phi) == 2 * PI * self.f
        yield self.y == self.offset + self.amplitude * self.wave()


class CosineVariableFrequencyAndAmplitude(SineVariableFrequencyAndAmplitude):
    """Cosine whose frequency and amplitude are signals, ``y = offset + amplitude cos(phi)``, ``dphi/dt = 2 pi f``.

    >>> class Wave(Component):
    ...     amplitude: Slope = Slope(slope=1.0, offset=2.0)
    ...     cosine: CosineVariableFrequencyAndAmplitude = CosineVariableFrequencyAndAmplitude(
    ...         useConstantFrequency=True, constantFrequency=0.5)
    ...     def equations(self):
    ...         yield connect(self.amplitude.y, self.cosine.amplitude)
    >>> run(Wave(), at=[0.0, 1.0])["cosine.y"]
    [2.0, -3.0]

    Source: Modelica.Blocks.Sources.CosineVariableFrequencyAndAmplitude.
    """

    def wave(self) -> Expr:
        """The wave of unit amplitude."""
        return cos(self.phi)


class ExpSine(SignalSource):
    """Damped sine, ``y = offset + amplitude exp(-damping (t - startTime)) sin(2 pi f (t - startTime) + phase)``.

    >>> t = np.linspace(0.0, 1.0, 5)
    >>> close(run(ExpSine(f=2.0, damping=3.0, phase=0.1), at=t)["y"], np.exp(-3 * t) * np.sin(4 * np.pi * t + 0.1))
    True

    Source: Modelica.Blocks.Sources.ExpSine.
    """

    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(2.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    damping: Parameter = Parameter(1.0, unit="1/s", doc="damping coefficient")

    def equations(self) -> Equations:
        yield from super().equations()
        t = ac.time - self.startTime
        wave = self.amplitude * exp(-t * self.damping) * sin(2 * PI * self.f * t + self.phase)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, wave)


class Exponentials(SignalSource):
    """Exponential rise towards `outMax` for `riseTime`, then exponential fall to zero.

    ``outMax (1 - exp(-t/riseTimeConst))`` while rising, ``y_rise exp(-(t - riseTime)/fallTimeConst)`` after.

    >>> pulse = Exponentials(outMax=2.0, riseTime=0.5, riseTimeConst=0.1, fallTimeConst=0.2)
    >>> top = 2.0 * (1 - np.exp(-5.0))
    >>> close(run(pulse, at=[0.1, 0.5, 1.0])["y"], [2 * (1 - np.exp(-1.0)), top, top * np.exp(-2.5)])
    True

    Source: Modelica.Blocks.Sources.Exponentials.
    """

    outMax: Parameter = Parameter(1.0, doc="height of the output for an infinite rise time")
    riseTime: Parameter = Parameter(0.5, unit="s", min=0.0, doc="rise time")
    riseTimeConst: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time constant of the rise")
    fallTimeConst: Parameter = Parameter(riseTimeConst, unit="s", min=1e-60, doc="time constant of the fall")

    def equations(self) -> Equations:
        yield from super().equations()
        t = ac.time - self.startTime
        top = self.outMax * (1 - exp(-self.riseTime / self.riseTimeConst))
        rise = self.outMax * (1 - exp(-t / self.riseTimeConst))
        fall = top * exp(-(t - self.riseTime) / self.fallTimeConst)
        pulse = where(ac.time < self.startTime + self.riseTime, rise, fall)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, pulse)


class Sinc(SignalSource):
    """Sinc, ``y = offset + amplitude sin(x)/x`` with ``x = 2 pi f (t - startTime)``.

    >>> close(run(Sinc(amplitude=2.0, f=0.5), at=[0.0, 0.5, 1.0])["y"], [2.0, 4 / np.pi, 0.0])
    True

    Source: Modelica.Blocks.Sources.Sinc.
    """

    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")

    def equations(self) -> Equations:
        yield from super().equations()
        x = 2 * PI * self.f * (ac.time - self.startTime)
        safe = where(ac.abs(x) < 1e-9, 1.0, x)
        wave = where(ac.abs(x) < 1e-9, 1.0, sin(safe) / safe)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, self.amplitude * wave)


class TimeTable(SignalSource):
    """Piecewise linear signal through points, ``y = offset + table(t - shiftTime)``, and `offset` before `startTime`.

    Two rows with the same time make a jump; outside the table the last two points are continued.

    >>> table = TimeTable(table=[[0.0, 0.0], [0.25, 2.0], [0.25, -1.0], [0.75, 1.0]])
    >>> run(table, at=[0.0, 0.125, 0.5, 1.0])["y"]
    [0.0, 1.0, 0.0, 2.0]

    Source: Modelica.Blocks.Sources.TimeTable.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0), (1.0, 1.0))
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the first column")
    shiftTime: Parameter = Parameter(SignalSource.startTime, unit="s", doc="time of the table's zero")

    def equations(self) -> Equations:
        yield from super().equations()
        times, values = [row[0] for row in self.table], [row[1] for row in self.table]
        scaled = (ac.time - self.shiftTime) / self.timeScale
        value = interpolate(scaled, times, values)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, value)


class CombiTimeTable(SignalSource):
    """One column of a table over time, by its `smoothness` and `extrapolation`.

    `smoothness`: LinearSegments, ConstantSegments, ContinuousDerivative (Akima) or MonotoneContinuousDerivative1
    (Fritsch and Butland); `extrapolation`: LastTwoPoints, HoldLastPoint or Periodic. `column` counts from 1, the times.

    >>> table = CombiTimeTable(table=[[0.0, 1.0], [0.25, 3.0], [0.5, 1.0]], extrapolation="Periodic")
    >>> run(table, at=[0.0, 0.25, 0.625, 0.75])["y"]
    [1.0, 3.0, 2.0, 3.0]

    Source: Modelica.Blocks.Sources.CombiTimeTable with one column.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0), (1.0, 1.0))
    column: int = 2
    smoothness: str = "LinearSegments"
    extrapolation: str = "LastTwoPoints"
    shiftTime: Parameter = Parameter(SignalSource.startTime, unit="s", doc="time of the table's zero")
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the first column")

    def equations(self) -> Equations:
        yield from super().equations()
        times, values = [row[0] for row in self.table], [row[self.column - 1] for row in self.table]
        scaled = (ac.time - self.shiftTime) / self.timeScale
        value = interpolate(scaled, times, values, self.smoothness, self.extrapolation)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, value)


def time_table(
    times: Sequence[float], values: Sequence[float], *, offset: float = 0.0, startTime: float = 0.0
) -> TimeTable:
    """A `TimeTable` through the given points, constant outside of them.

    Args:
        times: increasing times [s], n of them, n >= 2.
        values: value at each of the times.
        offset: value added to the table.
        startTime: time of the table's zero [s].

    Raises:
        ValueError: times that do not increase, or lengths that differ.
    """
    points = [float(t) for t in times]
    ordinates = [float(v) for v in values]
    if len(points) != len(ordinates) or len(points) < 2:
        raise ValueError(f"time_table: as many values as times, at least 2, not {len(points)} and {len(ordinates)}")
    if any(b <= a for a, b in pairwise(points)):
        raise ValueError(f"time_table needs increasing times, not {tuple(points)}")
    before, after = points[0] - 1.0, points[-1] + 1.0
    rows = [*zip(points, ordinates, strict=True)]
    held = [(before, ordinates[0]), *rows, (after, ordinates[-1])]
    return TimeTable(table=held, offset=offset, shiftTime=startTime, startTime=BEGINNING)


class PartialPTP(Component, partial=True):
    """Fastest motion by a distance: constant acceleration, constant velocity (if it is reached), constant deceleration.

    Source: Modelica.Blocks.Sources.KinematicPTP2 with one axis.
    """

    qd_max: Parameter = Parameter(1.0, min=1e-60, doc="largest speed")
    qdd_max: Parameter = Parameter(1.0, min=1e-60, doc="largest acceleration")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the motion begins")
    qd: Output = Output(doc="velocity")
    qdd: Output = Output(doc="acceleration")
    endTime: Output = Output(unit="s", doc="time at which the motion ends")
    s: Variable = Variable(doc="distance moved")
    accelerating: Variable = Variable(unit="s", doc="duration of the acceleration, and of the deceleration")
    cruising: Variable = Variable(unit="s", doc="duration of the constant velocity")

    def motion(self, distance: Expr) -> Equations:
        """Equations of the motion by `distance`."""
        way = ac.abs(distance)
        direction = ac.sign(distance)
        acceleration = direction * self.qdd_max
        t = ac.time - self.startTime
        t1, t2, t3 = self.accelerating, self.accelerating + self.cruising, 2 * self.accelerating + self.cruising
        fast = way > self.qd_max**2 / self.qdd_max  # the speed limit is reached
        yield self.accelerating == where(fast, self.qd_max / self.qdd_max, sqrt(way / self.qdd_max))
        yield self.cruising == where(fast, way / self.qd_max - self.qd_max / self.qdd_max, 0.0)
        yield self.endTime == self.startTime + t3
        top = acceleration * t1
        moving = where(t < t1, acceleration * t, where(t < t2, top, where(t < t3, acceleration * (t3 - t), 0.0)))
        begun = where(t < t1, acceleration * t**2 / 2, top * (t - t1 / 2))
        ended = where(t < t3, distance - acceleration * (t3 - t) ** 2 / 2, distance)
        yield self.qdd == where(
            t < 0, 0.0, where(t < t1, acceleration, where(t < t2, 0.0, where(t < t3, -acceleration, 0.0)))
        )
        yield self.qd == where(t < 0, 0.0, moving)
        yield self.s == where(t < 0, 0.0, where(t < t2, begun, ended))


class KinematicPTP2(PartialPTP):
    """Fastest motion from `q_begin` to `q_end` within a speed `qd_max` and an acceleration `qdd_max`.

    Outputs the position `q`, the velocity `qd` and the acceleration `qdd`; at rest at `endTime`.

    >>> motion = run(KinematicPTP2(q_end=1.0, qd_max=2.0, qdd_max=8.0), at=[0.0, 0.25, 0.5, 0.75, 1.0])
    >>> close(motion["q"], [0.0, 0.25, 0.75, 1.0, 1.0]) and close(motion["qd"], [0.0, 2.0, 2.0, 0.0, 0.0])
    True

    Source: Modelica.Blocks.Sources.KinematicPTP2 with one axis.
    """

    q_begin: Parameter = Parameter(0.0, doc="position at the start")
    q_end: Parameter = Parameter(1.0, doc="position at the end")
    q: Output = Output(doc="position")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.motion(self.q_end - self.q_begin)
        yield self.q == self.q_begin + self.s


class KinematicPTP(PartialPTP):
    """Acceleration `y` of the fastest motion by `deltaq` within `qd_max` and `qdd_max`; integrate it twice.

    >>> class Move(Component):
    ...     path: KinematicPTP = KinematicPTP(deltaq=1.0, qd_max=2.0, qdd_max=8.0)
    ...     v: Integrator = Integrator()
    ...     s: Integrator = Integrator()
    ...     def equations(self):
    ...         yield connect(self.path.y, self.v.u)
    ...         yield connect(self.v.y, self.s.u)
    >>> close(run(Move(), at=[0.25, 0.5, 1.0])["s.y"], [0.25, 0.75, 1.0], 1e-4)
    True

    Source: Modelica.Blocks.Sources.KinematicPTP with one axis.
    """

    deltaq: Parameter = Parameter(1.0, doc="distance to move")
    y: Output = Output(doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.motion(1.0 * self.deltaq)
        yield self.y == self.qdd
