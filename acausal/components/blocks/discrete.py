"""Sampled signals."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Output, Parameter, pre, when


class PartialSampled(Component, partial=True):
    """A block that acts at the times ``startTime + k samplePeriod``.

    Source: Modelica.Blocks.Interfaces.DiscreteSISO.
    """

    u: Input = Input(doc="input signal")
    y: Discrete = Discrete(doc="output signal")
    samplePeriod: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time between two samples")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the first sample")

    @property
    def sampled(self) -> Expr:
        """True at the samples."""
        return ac.sample(self.startTime, self.samplePeriod)


class Sampler(PartialSampled):
    """The input at the last sample.

    >>> model = assemble("ramp.y - held.u", ramp=Slope(slope=1.0), held=Sampler(samplePeriod=0.25))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["held.y"]
    [0.0, 0.25, 0.5, 0.75]

    Source: Modelica.Blocks.Discrete.Sampler.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.sampled, {self.y: self.u})


class ZeroOrderHold(Sampler):
    """The input at the last sample, held until the next.

    >>> model = assemble("ramp.y - held.u", ramp=Slope(slope=1.0), held=ZeroOrderHold(samplePeriod=0.25))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["held.y"]
    [0.0, 0.25, 0.5, 0.75]

    Source: Modelica.Blocks.Discrete.ZeroOrderHold.
    """


class UnitDelay(PartialSampled):
    """The input at the sample before the last.

    >>> model = assemble("ramp.y - late.u", ramp=Slope(slope=1.0), late=UnitDelay(samplePeriod=0.25))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["late.y"]
    [0.0, 0.0, 0.25, 0.5]

    Source: Modelica.Blocks.Discrete.UnitDelay.
    """

    held: Discrete = Discrete(doc="the input at the last sample")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.sampled, {self.y: pre(self.held), self.held: self.u})


class FirstOrderHold(PartialSampled):
    """The line through the last two samples, continued.

    >>> model = assemble("ramp.y - line.u", ramp=Slope(slope=2.0), line=FirstOrderHold(samplePeriod=0.25))
    >>> close(run(model, at=[0.1, 0.3, 0.6, 0.9])["line.out"], [0.0, 0.6, 1.2, 1.8])
    True

    Source: Modelica.Blocks.Discrete.FirstOrderHold (its output is `out`, `y` the last sample).
    """

    out: Output = Output(doc="continued signal")
    slope: Discrete = Discrete(unit="1/s", doc="slope through the last two samples")
    tSample: Discrete = Discrete(unit="s", doc="time of the last sample")

    def equations(self) -> Equations:
        yield from super().equations()
        first = ac.time <= self.startTime + self.samplePeriod / 2
        rise = ac.where(first, 0.0, (self.u - pre(self.y)) / self.samplePeriod)
        yield when(self.sampled, {self.y: self.u, self.slope: rise, self.tSample: ac.time})
        yield self.out == self.y + self.slope * (ac.time - self.tSample)


class TriggeredSampler(Component):
    """The input at the moment at which the boolean `trigger` last became true; `y_start` before.

    >>> model = assemble("ramp.y - held.u", "pulse.y - held.trigger", ramp=Slope(slope=1.0),
    ...                  pulse=BooleanPulse(period=0.4, startTime=0.2), held=TriggeredSampler())
    >>> close(run(model, at=[0.1, 0.3, 0.7])["held.y"], [0.0, 0.2, 0.6])
    True

    Source: Modelica.Blocks.Discrete.TriggeredSampler.
    """

    u: Input = Input(doc="input signal")
    trigger: Input = Input(doc="boolean that triggers")
    y_start: Parameter = Parameter(0.0, doc="value before the first sample")
    y: Discrete = Discrete(start=y_start, doc="output signal")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.trigger > 0.5, {self.y: self.u})
