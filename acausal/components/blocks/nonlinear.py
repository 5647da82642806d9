"""Blocks without memory that limit, and blocks that limit a rate."""

from __future__ import annotations

from acausal import Equations, Input, Output, Parameter, assert_, clip, der

from .interfaces import SISO, initialized


class Limiter(SISO):
    """Limits, ``y = clip(u, uMin, uMax)``.

    >>> class Cut(Component):
    ...     wave: Sine = Sine(amplitude=2.0, f=0.5)
    ...     cut: Limiter = Limiter(uMax=1.5)
    ...     def equations(self):
    ...         yield connect(self.wave.y, self.cut.u)
    >>> close(run(Cut(), at=[0.0, 0.5, 0.9])["cut.y"], [0.0, 1.5, 2 * np.sin(0.9 * np.pi)])
    True

    Source: Modelica.Blocks.Nonlinear.Limiter.
    """

    uMax: Parameter = Parameter(1.0, doc="upper limit")
    uMin: Parameter = Parameter(-uMax, doc="lower limit")
    span: Parameter = Parameter(uMax - uMin, min=0.0, doc="upper limit less the lower one")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == clip(self.u, self.uMin, self.uMax)


class VariableLimiter(SISO):
    """Limits that are signals, ``y = clip(u, limit2, limit1)``.

    >>> class Cut(Component):
    ...     wave: Sine = Sine(amplitude=2.0, f=0.5)
    ...     top: Slope = Slope(slope=1.0)
    ...     bottom: Constant = Constant(k=0.0)
    ...     cut: VariableLimiter = VariableLimiter()
    ...     def equations(self):
    ...         yield connect(self.wave.y, self.cut.u)
    ...         yield connect(self.top.y, self.cut.limit1)
    ...         yield connect(self.bottom.y, self.cut.limit2)
    >>> close(run(Cut(), at=[0.0, 0.5, 0.6])["cut.y"], [0.0, 0.5, 0.6])
    True

    Source: Modelica.Blocks.Nonlinear.VariableLimiter.
    """

    limit1: Input = Input(doc="upper limit")
    limit2: Input = Input(doc="lower limit")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == clip(self.u, self.limit2, self.limit1)
        message = "the lower limit of a VariableLimiter, limit2, is above its upper one, limit1"
        yield assert_(self.limit1 >= self.limit2, message)


class DeadZone(SISO):
    """Dead zone, ``y = u - clip(u, uMin, uMax)``.

    >>> class Zone(Component):
    ...     ramp: Slope = Slope(slope=4.0, offset=-2.0)
    ...     zone: DeadZone = DeadZone(uMax=1.0)
    ...     def equations(self):
    ...         yield connect(self.ramp.y, self.zone.u)
    >>> close(run(Zone(), at=[0.0, 0.5, 1.0])["zone.y"], [-1.0, 0.0, 1.0])
    True

    Source: Modelica.Blocks.Nonlinear.DeadZone.
    """

    uMax: Parameter = Parameter(1.0, doc="upper end of the zone")
    uMin: Parameter = Parameter(-uMax, doc="lower end of the zone")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u - clip(self.u, self.uMin, self.uMax)
        yield assert_(self.uMin <= self.uMax, "the ends of a DeadZone are uMin <= uMax")


class SlewRateLimiter(SISO):
    """Limited rate, ``dy/dt = clip((u - y)/Td, Falling, Rising)``.

    >>> class Slew(Component):
    ...     step: Step = Step(height=3.0)
    ...     slew: SlewRateLimiter = SlewRateLimiter(Rising=4.0, initType="InitialState")
    ...     def equations(self):
    ...         yield connect(self.step.y, self.slew.u)
    >>> close(run(Slew(), at=[0.25, 0.5, 1.0])["slew.y"], [1.0, 2.0, 3.0], 1e-3)
    True

    Source: Modelica.Blocks.Nonlinear.SlewRateLimiter.
    """

    initType: str = "SteadyState"
    Rising: Parameter = Parameter(1.0, unit="1/s", min=1e-60, doc="largest rate of rise")
    Falling: Parameter = Parameter(-Rising, unit="1/s", max=-1e-60, doc="largest rate of fall, negative")
    Td: Parameter = Parameter(1e-3, unit="s", min=1e-60, doc="time constant within the limits")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    y: Output = Output(start=y_start, doc="output signal")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == clip((self.u - self.y) / self.Td, self.Falling, self.Rising)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.initType == "SteadyState":
            yield self.y == self.u
        else:
            yield from initialized(self.initType, [(self.y, self.y_start)], (self.y, self.y_start))
