"""Smallest and largest values that a signal has had."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Parameter, Variable, der, pre, when, where


class PartialExtrema(Component, partial=True):
    """Smallest and largest value so far, and their times.

    Source: Modelica.Blocks.Math.SignalExtrema.
    """

    u: Input = Input(doc="input signal")
    y_min: Discrete = Discrete(doc="smallest value")
    y_max: Discrete = Discrete(doc="largest value")
    t_min: Discrete = Discrete(unit="s", doc="time of the smallest value")
    t_max: Discrete = Discrete(unit="s", doc="time of the largest value")


class SignalExtrema(PartialExtrema):
    """Smallest and largest value of the samples every `Ts` [s].

    >>> model = assemble("wave.y - seen.u", wave=Sine(f=1.0), seen=SignalExtrema(Ts=0.125))
    >>> result = run(model, at=[0.0, 0.2, 0.4, 1.0])
    >>> close(result["seen.y_max"], [0.0, np.sqrt(0.5), 1.0, 1.0]), result["seen.t_min"]
    (True, [0.0, 0.0, 0.0, 0.75])

    Source: Modelica.Blocks.Math.SignalExtrema.
    """

    Ts: Parameter = Parameter(0.01, unit="s", min=1e-60, doc="time between two samples")
    due: Discrete = Discrete(unit="s", start=1e300, doc="time of the next sample")

    def equations(self) -> Equations:
        yield from super().equations()
        first = {
            self.y_min: self.u, self.y_max: self.u, self.t_min: ac.time, self.t_max: ac.time,
            self.due: ac.time + self.Ts,
        }  # fmt: skip
        lower, higher = self.u < pre(self.y_min), self.u > pre(self.y_max)
        later = {
            self.y_min: where(lower, self.u, pre(self.y_min)), self.y_max: where(higher, self.u, pre(self.y_max)),
            self.t_min: where(lower, ac.time, pre(self.t_min)), self.t_max: where(higher, ac.time, pre(self.t_max)),
            self.due: pre(self.due) + self.Ts,
        }  # fmt: skip
        yield when(ac.initial(), first).elsewhen(ac.time >= pre(self.due), later)


class ContinuousSignalExtrema(PartialExtrema):
    """Smallest and largest value of the signal where a lag of time constant `T` behind it crosses it, and at the end.

    >>> model = assemble("wave.y - seen.u", wave=Sine(f=1.0, offset=0.5), seen=ContinuousSignalExtrema())
    >>> result = run(model, at=[0.5, 1.0])
    >>> close(result["seen.y_max"], [1.5, 1.5]) and close(result["seen.t_min"], [0.0, 0.75])
    True

    Source: Modelica.Blocks.Math.ContinuousSignalExtrema.
    """

    T: Parameter = Parameter(1e-6, unit="s", min=1e-60, doc="time constant")
    x: Variable = Variable(doc="the signal, a little later")

    def equations(self) -> Equations:
        yield from super().equations()
        low = ac.min(ac.min(pre(self.y_min), self.u), pre(self.u))
        high = ac.max(ac.max(pre(self.y_max), self.u), pre(self.u))
        first = {self.y_min: self.u, self.y_max: self.u, self.t_min: ac.time, self.t_max: ac.time}
        later = {
            self.y_min: low, self.y_max: high,
            self.t_min: where(low < pre(self.y_min), ac.time, pre(self.t_min)),
            self.t_max: where(high > pre(self.y_max), ac.time, pre(self.t_max)),
        }  # fmt: skip
        yield der(self.x) == (self.u - self.x) / self.T
        yield when(ac.initial(), first).elsewhen([self.u <= self.x, self.u >= self.x, ac.terminal()], later)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.x == self.u
