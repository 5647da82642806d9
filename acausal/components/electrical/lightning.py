"""Lightning impulses by their rise time, decay time and amplitude."""

from __future__ import annotations

import acausal as ac
from acausal import DeclarationError, Equations, Expr, Parameter, Variable, exp, log, structural, where

from .. import blocks
from .interfaces import CurrentSource, VoltageSource

APPROXIMATIONS = ("DoubleExp", "Heidler")
"""Values of `approximation`, as in Modelica.Electrical.Analog.Types.ImpulseApproximation."""


class LightningImpulse(blocks.SignalSource):
    """Impulse that rises in the time `T1` to the height `amplitude` and has fallen to half of it at `T2`.

    ``"Heidler"``: ``y = amplitude/eta x^m/(1 + x^m) exp(-t/tau2)`` with ``x = t/tau1``; ``"DoubleExp"``: ``y =
    amplitude/eta (exp(-t/tau1) - exp(-t/tau2))``. The amplitude factor `eta` and the time constants follow from T1 and
    T2, which count from a virtual origin: 10 % are reached at ``T10``, 90 % at ``T10 + 0.8 T1``, and 50 % again at
    ``T10 - 0.1 T1 + T2``.

    >>> impulse = run(LightningImpulse(amplitude=2.0, T1=1.0, T2=35.0), at=[0.0, 2.40321, 35.51376])
    >>> close(impulse["y"], [0.0, 2.0, 1.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Sources.LightningImpulse; Heidler, Analytische Blitzstromfunktion zur
    LEMP-Berechnung, ICLP 1985.
    """

    approximation: str = "Heidler"
    m: int = 5
    amplitude: Parameter = Parameter(1.0, doc="height of the impulse")
    T1: Parameter = Parameter(10e-6, unit="s", min=1e-60, doc="rise time")
    T2: Parameter = Parameter(350e-6, unit="s", min=1e-60, doc="decay time to half the height")
    ratio: Parameter = Parameter(T2 / T1, unit="1", doc="of the decay time to the rise time")
    eta: Variable = Variable(unit="1", start=1.0, doc="amplitude factor")
    peak: Variable = Variable(unit="1", start=2.5, doc="time of the largest value, over T1")
    tenth: Variable = Variable(unit="1", start=0.3, doc="time at which 10 % are reached, over T1")
    rise: Variable = Variable(unit="1", start=1.0, doc="time constant of the rise, over T1")
    fall: Variable = Variable(unit="1", start=1.0, doc="time constant of the fall, over T2")
    tau1: Variable = Variable(unit="s", nominal=1e-5, doc="first time constant of the function")
    tau2: Variable = Variable(unit="s", nominal=1e-4, doc="second time constant of the function")

    def shape(self, t: Expr) -> Expr:
        """The impulse without its amplitude factor at a time over T1."""
        falling = exp(-t / (self.fall * self.ratio))
        if self.approximation == "DoubleExp":
            return falling - exp(-t / self.rise)
        power = (t / self.rise) ** self.m
        return power / (1 + power) * falling

    def equations(self) -> Equations:
        if self.approximation not in APPROXIMATIONS:
            raise DeclarationError(f"approximation={self.approximation!r} is not one of {', '.join(APPROXIMATIONS)}")
        yield from super().equations()
        slow = self.fall * self.ratio
        if self.approximation == "DoubleExp":
            yield ac.assert_(self.ratio > 5, "The rise time has to be smaller than a fifth of the decay time.")
            yield self.peak * (slow - self.rise) == slow * self.rise * log(slow / self.rise)
            yield self.tau1 == self.fall * self.T2
            yield self.tau2 == self.rise * self.T1
        else:
            yield slow * self.m == self.peak * (1 + (self.peak / self.rise) ** self.m)
            yield self.tau1 == self.rise * self.T1
            yield self.tau2 == self.fall * self.T2
        yield self.eta == self.shape(self.peak)
        yield 0.1 * self.eta == self.shape(self.tenth)
        yield 0.9 * self.eta == self.shape(self.tenth + 0.8)
        yield 0.5 * self.eta == self.shape(self.tenth - 0.1 + self.ratio)
        elapsed = ac.max(ac.time - self.startTime, 0.0) / self.T1
        yield self.y == self.offset + where(
            ac.time < self.startTime, 0.0, self.amplitude / self.eta * self.shape(elapsed)
        )


class LightningImpulseVoltage(VoltageSource):
    """Voltage source: an impulse of height `V`, rise time `T1` and decay time `T2` (see `LightningImpulse`).

    >>> source = LightningImpulseVoltage(V=2.0, approximation="DoubleExp", T1=1.2, T2=50.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> peak = 1.2 * 1.99711
    >>> close(run(model, at=[0.0, peak, 50.0 + 1.2 * (0.04068 - 0.1)])["source.v"], [0.0, 2.0, 1.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Sources.LightningImpulseVoltage.
    """

    approximation: str = "Heidler"
    m: int = 5
    V: Parameter = Parameter(1.0, unit="V", doc="height of the impulse")
    T1: Parameter = Parameter(10e-6, unit="s", min=1e-60, doc="rise time")
    T2: Parameter = Parameter(350e-6, unit="s", min=1e-60, doc="decay time to half the height")
    signalSource: blocks.SO = LightningImpulse(
        approximation=structural("approximation"), m=structural("m"), amplitude=V, T1=T1, T2=T2,
        offset=VoltageSource.offset, startTime=VoltageSource.startTime,
    )  # fmt: skip


class LightningImpulseCurrent(CurrentSource):
    """Current source: an impulse of height `I`, rise time `T1` and decay time `T2` (see `LightningImpulse`).

    >>> source = LightningImpulseCurrent(I=2.0, approximation="DoubleExp", T1=1.2, T2=50.0)
    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", source=source,
    ...                  resistor=Resistor(R=4.0), ground=Ground())
    >>> peak = 1.2 * 1.99711
    >>> close(run(model, at=[0.0, peak, 50.0 + 1.2 * (0.04068 - 0.1)])["source.i"], [0.0, 2.0, 1.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Sources.LightningImpulseCurrent.
    """

    approximation: str = "Heidler"
    m: int = 5
    I: Parameter = Parameter(1.0, unit="A", doc="height of the impulse")  # noqa: E741
    T1: Parameter = Parameter(10e-6, unit="s", min=1e-60, doc="rise time")
    T2: Parameter = Parameter(350e-6, unit="s", min=1e-60, doc="decay time to half the height")
    signalSource: blocks.SO = LightningImpulse(
        approximation=structural("approximation"), m=structural("m"), amplitude=I, T1=T1, T2=T2,
        offset=CurrentSource.offset, startTime=CurrentSource.startTime,
    )  # fmt: skip
