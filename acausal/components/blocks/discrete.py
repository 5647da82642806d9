"""Sampled signals."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Output, Parameter, Vector, pre, when

from .multi import total
from .state_space import check_coefficients, check_shapes


class PartialSampled(Component, partial=True):
    """A block that acts at the times ``startTime + k samplePeriod``.

    Source: Modelica.Blocks.Interfaces.DiscreteSISO.
    """

    u: Input = Input(doc="input signal")
    samplePeriod: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time between two samples")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the first sample")

    @property
    def sampled(self) -> Expr:
        """True at the samples."""
        return ac.sample(self.startTime, self.samplePeriod)


class Sampler(PartialSampled):
    """The input at the last sample; before the first, at the start.

    >>> model = assemble("ramp.y - held.u", ramp=Slope(slope=1.0), held=Sampler(samplePeriod=0.25))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["held.y"]
    [0.0, 0.25, 0.5, 0.75]

    Source: Modelica.Blocks.Discrete.Sampler.
    """

    y: Discrete = Discrete(doc="output signal")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when([ac.initial(), self.sampled], {self.y: self.u})


class ZeroOrderHold(PartialSampled):
    """The input at the last sample, held until the next; at a sample itself that before, which breaks loops.

    Before the first sample it is the input at the start.

    >>> model = assemble("ramp.y - held.u", ramp=Slope(slope=1.0), held=ZeroOrderHold(samplePeriod=0.25))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["held.y"]
    [0.0, 0.25, 0.5, 0.75]

    Source: Modelica.Blocks.Discrete.ZeroOrderHold.
    """

    y: Discrete = Discrete(doc="output signal")
    ySample: Discrete = Discrete(doc="the input at the last sample")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when([ac.initial(), self.sampled], {self.ySample: self.u})
        yield self.y == pre(self.ySample)


class UnitDelay(PartialSampled):
    """The input just before the last sample, so that of the sample before if the input is sampled with it, too.

    >>> model = assemble("ramp.y - held.u", "held.y - late.u", ramp=Slope(slope=1.0), held=Sampler(samplePeriod=0.25),
    ...                  late=UnitDelay(samplePeriod=0.25, y_start=-1.0))
    >>> run(model, at=[0.1, 0.3, 0.6, 0.9])["late.y"]
    [0.0, 0.0, 0.25, 0.5]

    Source: Modelica.Blocks.Discrete.UnitDelay.
    """

    y_start: Parameter = Parameter(0.0, doc="value before the first sample")
    y: Discrete = Discrete(start=y_start, doc="output signal")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.sampled, {self.y: pre(self.u)})


class FirstOrderHold(PartialSampled):
    """The line through the last two samples, one period late: `y` goes from one to the other in the next period.

    ``y = uSample' + c (t - tSample)`` with the last sample but one, `uSample'`; `out` is the line as it is,
    ``uSample + c (t - tSample)``.

    >>> model = assemble("ramp.y - line.u", ramp=Slope(slope=2.0), line=FirstOrderHold(samplePeriod=0.25))
    >>> result = run(model, at=[0.1, 0.3, 0.6, 0.9])
    >>> close(result["line.y"], [0.0, 0.1, 0.7, 1.3]) and close(result["line.out"], [0.0, 0.6, 1.2, 1.8])
    True

    Source: Modelica.Blocks.Discrete.FirstOrderHold.
    """

    y: Output = Output(doc="line through the last two samples, one period late")
    out: Output = Output(doc="line through the last two samples")
    uSample: Discrete = Discrete(doc="last sample")
    pre_uSample: Discrete = Discrete(doc="last sample but one")
    c: Discrete = Discrete(unit="1/s", doc="slope through the last two samples")
    tSample: Discrete = Discrete(unit="s", doc="time of the last sample")

    def equations(self) -> Equations:
        yield from super().equations()
        first = ac.time <= self.startTime + self.samplePeriod / 2
        rise = ac.where(first, 0.0, (self.u - pre(self.uSample)) / self.samplePeriod)
        begun = {self.uSample: self.u, self.pre_uSample: self.u, self.c: 0.0, self.tSample: ac.time}
        later = {self.uSample: self.u, self.pre_uSample: pre(self.uSample), self.c: rise, self.tSample: ac.time}
        yield when(ac.initial(), begun).elsewhen(self.sampled, later)
        since = ac.time - self.tSample
        yield self.y == self.pre_uSample + self.c * since
        yield self.out == self.uSample + self.c * since


class TransferFunction(PartialSampled):
    """Transfer function ``(b[0] z^m + ... + b[m])/(a[0] z^n + ... + a[n])``, in controller canonical form.

    >>> lag = discrete.TransferFunction(b=[1.0], a=[1.0, -0.5], samplePeriod=0.25)
    >>> run(assemble("one.y - lag.u", one=Constant(), lag=lag), at=[0.1, 0.3, 0.6, 0.9])["lag.y"]
    [0.0, 1.0, 1.5, 1.75]

    Source: Modelica.Blocks.Discrete.TransferFunction; Kailath, Linear Systems (1980), section 2.1.
    """

    y: Discrete = Discrete(doc="output signal")
    b: Sequence[float] = (1.0,)
    a: Sequence[float] = (1.0,)

    @property
    def nx(self) -> int:
        """Number of states."""
        check_coefficients(self.b, self.a)
        return len(self.a) - 1

    x: Vector = Vector(Discrete(doc="state"), size="nx")

    def equations(self) -> Equations:
        yield from super().equations()
        before = [pre(x) for x in self.x]
        newest = (self.u - total(self.a[1:], before)) / self.a[0]
        weights = (*(0.0,) * (len(self.a) - len(self.b)), *self.b)
        extended = [newest, *before]
        states = dict(zip(self.x, extended[: self.nx], strict=True))
        yield when(self.sampled, {**states, self.y: total(weights, extended)})


class StateSpace(Component):
    """State space, ``x(k+1) = A x(k) + B u(k)``, ``y(k) = C x(k) + D u(k)``, at ``startTime + k samplePeriod``.

    >>> count = discrete.StateSpace(A=[[1.0]], B=[[1.0]], C=[[1.0]], samplePeriod=0.25)
    >>> run(assemble("two.y - count.u[0]", two=Constant(k=2.0), count=count), at=[0.1, 0.3, 0.6, 0.9])["count.y[1]"]
    [0.0, 2.0, 4.0, 6.0]

    Source: Modelica.Blocks.Discrete.StateSpace.
    """

    A: Sequence[Sequence[float]] = ((1.0, 0.0), (0.0, 1.0))
    B: Sequence[Sequence[float]] = ((1.0,), (1.0,))
    C: Sequence[Sequence[float]] = ((1.0, 1.0),)
    D: Sequence[Sequence[float]] = ()
    samplePeriod: Parameter = Parameter(0.1, unit="s", min=1e-60, doc="time between two samples")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the first sample")

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def nin(self) -> int:
        """Number of inputs."""
        return len(self.B[0]) if self.B else 0

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self.C)

    u: Vector = Vector(Input(doc="input signal"), size="nin")
    y: Vector = Vector(Discrete(doc="output signal"), size="nout")
    x: Vector = Vector(Discrete(doc="state"), size="nx")

    def equations(self) -> Equations:
        yield from super().equations()
        direct = self.D or ((0.0,) * self.nin,) * self.nout
        check_shapes(self.A, self.B, self.C, direct)
        before = [pre(x) for x in self.x]
        new: dict[Expr, Expr] = {}
        for targets, of_states, of_inputs in ((self.x, self.A, self.B), (self.y, self.C, direct)):
            for target, states, inputs in zip(targets, of_states, of_inputs, strict=True):
                new[target] = total(states, before) + total(inputs, self.u)
        yield when(ac.sample(self.startTime, self.samplePeriod), new)


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


class TriggeredMax(Component):
    """The largest magnitude of the input at the moments at which the boolean `trigger` has become true.

    >>> model = assemble("wave.y - most.u", "pulse.y - most.trigger", wave=Sine(amplitude=-2.0, f=1.0),
    ...                  pulse=BooleanPulse(period=0.25, startTime=0.0), most=TriggeredMax())
    >>> close(run(model, at=[0.1, 0.4, 0.9])["most.y"], [0.0, 2.0, 2.0])
    True

    Source: Modelica.Blocks.Discrete.TriggeredMax.
    """

    u: Input = Input(doc="input signal")
    trigger: Input = Input(doc="boolean that triggers")
    y: Discrete = Discrete(doc="largest magnitude")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(self.trigger > 0.5, {self.y: ac.max(pre(self.y), ac.abs(self.u))})
