"""Signals that depend on time alone."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Equations, Expr, Input, Parameter, Variable, clip, cos, der, exp, sin, where

from .interfaces import SO, SignalSource


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


def risen(start: Expr, duration: Expr) -> Expr:
    """Share of the time from `start` to ``start + duration`` that is over, 0 to 1 [s]; a step where that is no time."""
    t = ac.time - start
    line = clip(t / where(duration > 0, duration, 1.0), 0.0, 1.0)
    return where(duration > 0, line, where(t >= 0, 1.0, 0.0))


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
    """Ramp from `offset` to ``offset + height`` between `startTime` and ``startTime + duration``; a step if that is 0.

    >>> run(Ramp(height=4.0, duration=0.5, startTime=0.25), at=[0.0, 0.25, 0.5, 1.0])["y"]
    [0.0, 0.0, 2.0, 4.0]

    Source: Modelica.Blocks.Sources.Ramp.
    """

    height: Parameter = Parameter(1.0, doc="height of the ramp")
    duration: Parameter = Parameter(2.0, unit="s", min=0.0, doc="duration of the ramp")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + self.height * risen(self.startTime, self.duration)


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

    With `continuous` it is ``offset + amplitude sin(phase)`` before `startTime`, and does not jump.

    >>> run(Sine(amplitude=2.0, f=0.25, offset=1.0), at=[0.0, 1.0])["y"]
    [1.0, 3.0]

    Source: Modelica.Blocks.Sources.Sine.
    """

    continuous: bool = False
    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")

    def equations(self) -> Equations:
        yield from super().equations()
        t = ac.time - self.startTime
        if self.continuous:
            yield self.y == self.offset + self.amplitude * sin(2 * PI * self.f * ac.max(t, 0.0) + self.phase)
        else:
            wave = self.amplitude * sin(2 * PI * self.f * t + self.phase)
            yield self.y == self.offset + where(ac.time < self.startTime, 0.0, wave)


class Cosine(SignalSource):
    """Cosine, ``y = offset + amplitude cos(2 pi f (t - startTime) + phase)``, and `offset` before `startTime`.

    With `continuous` it is ``offset + amplitude cos(phase)`` before `startTime`, and does not jump.

    >>> run(Cosine(amplitude=2.0, f=0.5, startTime=0.5), at=[0.0, 0.5, 1.5])["y"]
    [0.0, 2.0, -2.0]

    Source: Modelica.Blocks.Sources.Cosine.
    """

    continuous: bool = False
    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")

    def equations(self) -> Equations:
        yield from super().equations()
        t = ac.time - self.startTime
        if self.continuous:
            yield self.y == self.offset + self.amplitude * cos(2 * PI * self.f * ac.max(t, 0.0) + self.phase)
        else:
            wave = self.amplitude * cos(2 * PI * self.f * t + self.phase)
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
    """Sinc, ``y = offset + amplitude sin(x)/x`` with ``x = 2 pi f (t - startTime)``, and `offset` before `startTime`.

    With `continuous` it is ``offset + amplitude`` before `startTime`, and does not jump.

    >>> close(run(Sinc(amplitude=2.0, f=0.5), at=[0.0, 0.5, 1.0])["y"], [2.0, 4 / np.pi, 0.0])
    True

    Source: Modelica.Blocks.Sources.Sinc.
    """

    continuous: bool = False
    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")

    def equations(self) -> Equations:
        yield from super().equations()
        x = 2 * PI * self.f * (ac.time - self.startTime)
        safe = where(ac.abs(x) < 1e-9, 1.0, x)
        wave = where(ac.abs(x) < 1e-9, 1.0, sin(safe) / safe)
        before = 1.0 if self.continuous else 0.0
        yield self.y == self.offset + self.amplitude * where(ac.time < self.startTime, before, wave)


class LogFrequencySweep(SO):
    """Frequency that grows exponentially from `wMin` to `wMax`, ``y = wMin (wMax/wMin)^((t - startTime)/duration)``.

    With a `duration` of 0 it is a step.

    >>> close(run(LogFrequencySweep(wMin=1.0, wMax=100.0), at=[0.0, 0.5, 1.0])["y"], [1.0, 10.0, 100.0])
    True

    Source: Modelica.Blocks.Sources.LogFrequencySweep.
    """

    wMin: Parameter = Parameter(1.0, min=2e-16, doc="frequency at the start")
    wMax: Parameter = Parameter(10.0, min=2e-16, doc="frequency at the end")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the sweep begins")
    duration: Parameter = Parameter(1.0, unit="s", min=0.0, doc="duration of the sweep")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.wMin * (self.wMax / self.wMin) ** risen(self.startTime, self.duration)
