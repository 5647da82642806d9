"""Signals that repeat with a period."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Expr, Parameter, where

from .interfaces import SignalSource


class PartialPeriodic(SignalSource, partial=True):
    """A signal that repeats every `period` from `startTime` on, `nperiod` times (without end if negative).

    Source: Modelica.Blocks.Sources.Pulse.
    """

    nperiod: int = -1
    amplitude: Parameter = Parameter(1.0, doc="height of the signal above the offset")
    period: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="time of one period")

    def elapsed(self) -> Expr:
        """Time since the beginning of the present period [s], which may be negative by rounding."""
        t = ac.time - self.startTime
        return t - self.period * ac.floor(t / self.period)

    def before(self, end: Expr) -> Expr:
        """Whether the present period has not come to `end` yet; never where that is its beginning."""
        return (self.elapsed() < end) & (end > 0.0)

    def repeated(self, shape: Expr) -> Equations:
        """The output: `shape` while it repeats, then the offset."""
        active = ac.time >= self.startTime
        if self.nperiod >= 0:
            active = active & (ac.time < self.startTime + self.nperiod * self.period)
        yield self.y == self.offset + where(active, shape, 0.0)


class Pulse(PartialPeriodic):
    """Rectangular pulses of height `amplitude` that last `width` per cent of each `period`.

    >>> run(Pulse(amplitude=2.0, width=25.0, period=0.8, startTime=0.1), at=[0.0, 0.2, 0.5, 0.95])["y"]
    [0.0, 2.0, 0.0, 2.0]

    Source: Modelica.Blocks.Sources.Pulse.
    """

    width: Parameter = Parameter(50.0, min=0.0, max=100.0, doc="width in per cent of the period")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.repeated(where(self.before(self.period * self.width / 100), self.amplitude, 0.0))


class SawTooth(PartialPeriodic):
    """Linear rise to `amplitude` in each `period`, then back to the offset at once.

    >>> close(run(SawTooth(amplitude=2.0, period=0.5, nperiod=1), at=[0.0, 0.25, 0.6])["y"], [0.0, 1.0, 0.0])
    True

    Source: Modelica.Blocks.Sources.SawTooth.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.repeated(self.amplitude * self.elapsed() / self.period)


class Trapezoid(PartialPeriodic):
    """Trapezoids: a rise during `rising`, `amplitude` during `width`, a fall during `falling`, then the offset.

    >>> shape = Trapezoid(amplitude=2.0, rising=0.2, width=0.2, falling=0.4, period=1.0)
    >>> close(run(shape, at=[0.1, 0.3, 0.5, 0.9])["y"], [1.0, 2.0, 1.5, 0.0])
    True

    Source: Modelica.Blocks.Sources.Trapezoid.
    """

    rising: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the rise")
    width: Parameter = Parameter(0.5, unit="s", min=0.0, doc="duration of the plateau")
    falling: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the fall")

    def equations(self) -> Equations:
        yield from super().equations()
        t = self.elapsed()
        plateau, fall = self.rising + self.width, self.rising + self.width + self.falling
        rising = self.amplitude * t / ac.max(self.rising, 1e-300)
        falling = self.amplitude * (fall - t) / ac.max(self.falling, 1e-300)
        falls = self.before(fall) & (self.falling > 0.0)
        level = where(self.before(plateau), self.amplitude, where(falls, falling, 0.0))
        yield from self.repeated(where(self.before(self.rising), rising, level))
