"""Linear continuous blocks of first and second order: integrators, derivatives, lags."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Discrete,
    Equations,
    Expr,
    Input,
    Output,
    Parameter,
    Variable,
    assert_,
    clip,
    der,
    noevent,
    reinit,
    when,
    where,
)

from .booleans import true
from .interfaces import SISO, initialized


class Integrator(SISO):
    """Integrator, ``dy/dt = k u``; `y_start` holds at the start unless something else determines it.

    With `use_reset` the output becomes `y_start` when the boolean `reset` becomes true, or the signal `set` with
    `use_set`.

    >>> class Fill(Component):
    ...     flow: Constant = Constant(k=3.0)
    ...     level: Integrator = Integrator(k=0.5, y_start=1.0)
    ...     def equations(self):
    ...         yield connect(self.flow.y, self.level.u)
    >>> run(Fill(), at=[0.0, 1.0])["level.y"]
    [1.0, 2.5]

    Source: Modelica.Blocks.Continuous.Integrator; the same with its default, ``initType="InitialState"``, where nothing
    else determines the start.
    """

    initType: str = "NoInit"
    use_reset: bool = False
    use_set: bool = False
    k: Parameter = Parameter(1.0, unit="1/s", doc="gain")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    y: Output = Output(start=y_start, doc="output signal")
    reset: Input = Input(doc="boolean that resets, with use_reset")
    set: Input = Input(doc="value after a reset, with use_reset and use_set")

    def rate(self) -> Expr:
        """Derivative of the output."""
        return self.k * self.u

    def after_reset(self) -> Expr:
        """Value of the output after a reset."""
        return self.set if self.use_set else self.y_start * 1.0

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == self.rate()
        if self.use_reset:
            yield when(true(self.reset), reinit(self.y, self.after_reset()))
        else:
            yield self.reset == 0
        if not (self.use_reset and self.use_set):
            yield self.set == 0

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.y, self.y_start)], (self.y, self.y_start))


class LimIntegrator(Integrator):
    """Integrator that stops at its limits, ``dy/dt = k u``, but 0 beyond `outMin` or `outMax` when going outwards.

    Where it stops is an event, or with `strict` left to the solver. Without `limitsAtInit` the start does not know the
    limits, and is an error beyond them.

    >>> class Tank(Component):
    ...     flow: Constant = Constant(k=4.0)
    ...     level: LimIntegrator = LimIntegrator(outMax=2.0)
    ...     def equations(self):
    ...         yield connect(self.flow.y, self.level.u)
    >>> close(run(Tank(), at=[0.25, 0.75, 1.0])["level.y"], [1.0, 2.0, 2.0], 1e-3)
    True

    Source: Modelica.Blocks.Continuous.LimIntegrator.
    """

    strict: bool = False
    limitsAtInit: bool = True
    outMax: Parameter = Parameter(1.0, doc="upper limit of the output")
    outMin: Parameter = Parameter(-outMax, doc="lower limit of the output")
    span: Parameter = Parameter(outMax - outMin, min=0.0, doc="upper limit less the lower one")
    begunInside: Discrete = Discrete(start=1.0, doc="whether the start is within the limits, without limitsAtInit")

    def rate(self) -> Expr:
        """Derivative of the output."""
        rate = self.k * self.u
        above, below = self.y > self.outMax, self.y < self.outMin
        stops = (below & (rate < 0)) | (above & (rate > 0))
        if not self.limitsAtInit:
            stops = stops & ~ac.initial()
        return noevent(where(stops, 0.0, rate)) if self.strict else where(stops, 0.0, rate)

    def after_reset(self) -> Expr:
        """Value of the output after a reset, within the limits."""
        return clip(super().after_reset(), self.outMin, self.outMax)

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.limitsAtInit:
            some = 1e-3 * ac.abs(self.outMax - self.outMin)
            inside = (self.y >= self.outMin - some) & (self.y <= self.outMax + some)
            yield when(ac.initial(), {self.begunInside: where(inside, 1.0, 0.0)})
            yield assert_(true(self.begunInside), "the start of a LimIntegrator is not within its limits")
        else:
            yield self.begunInside == 1.0


class Der(SISO):
    """Derivative of the input, ``y = du/dt``; the input must be differentiable.

    >>> class Rate(Component):
    ...     wave: Sine = Sine(amplitude=2.0, f=0.5)
    ...     rate: Der = Der()
    ...     def equations(self):
    ...         yield connect(self.wave.y, self.rate.u)
    >>> close(run(Rate(), at=[0.0, 1.0])["rate.y"], [2 * np.pi, -2 * np.pi])
    True

    Source: Modelica.Blocks.Continuous.Der.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == der(self.u)


class Derivative(SISO):
    """Filtered derivative, ``k s/(T s + 1)``: ``dx/dt = (u - x)/T``, ``y = k (u - x)/T``.

    >>> class Rate(Component):
    ...     ramp: Ramp = Ramp(height=3.0, duration=1.0)
    ...     rate: Derivative = Derivative(T=0.1)
    ...     def equations(self):
    ...         yield connect(self.ramp.y, self.rate.u)
    >>> close(run(Rate(), at=[0.1, 0.5])["rate.y"], 3 * (1 - np.exp([-1.0, -5.0])), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.Derivative.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, unit="s", doc="gain")
    T: Parameter = Parameter(0.01, unit="s", min=1e-30, doc="time constant of the filter")
    x_start: Parameter = Parameter(0.0, doc="start value of the filtered input")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    x: Variable = Variable(start=x_start, doc="filtered input")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == (self.u - self.x) / self.T
        yield self.y == self.k / self.T * (self.u - self.x)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.x, self.x_start)], (self.y, self.y_start))


class FirstOrder(SISO):
    """First-order lag, ``T dy/dt + y = k u``.

    >>> class Lag(Component):
    ...     step: Step = Step(height=2.0)
    ...     lag: FirstOrder = FirstOrder(k=3.0, T=0.5)
    ...     def equations(self):
    ...         yield connect(self.step.y, self.lag.u)
    >>> close(run(Lag(), at=[0.5, 1.0])["lag.y"], 6 * (1 - np.exp([-1.0, -2.0])), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.FirstOrder.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, doc="gain")
    T: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="time constant")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    y: Output = Output(start=y_start, doc="output signal")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T * der(self.y) == self.k * self.u - self.y

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.y, self.y_start)], (self.y, self.y_start))


class SecondOrder(SISO):
    """Second-order lag, ``d2y/dt2 + 2 D w dy/dt + w^2 y = k w^2 u``.

    >>> class Lag(Component):
    ...     step: Step = Step()
    ...     lag: SecondOrder = SecondOrder(w=6.0, D=0.0)
    ...     def equations(self):
    ...         yield connect(self.step.y, self.lag.u)
    >>> close(run(Lag(), at=[0.2, 1.0])["lag.y"], 1 - np.cos([1.2, 6.0]), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.SecondOrder.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, doc="gain")
    w: Parameter = Parameter(1.0, unit="rad/s", min=0.0, doc="angular frequency")
    D: Parameter = Parameter(1.0, unit="1", min=0.0, doc="damping ratio")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    yd_start: Parameter = Parameter(0.0, doc="start value of the derivative of the output")
    y: Output = Output(start=y_start, doc="output signal")
    yd: Variable = Variable(start=yd_start, doc="time derivative of y")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == self.yd
        yield der(self.yd) == self.w * (self.w * (self.k * self.u - self.y) - 2 * self.D * self.yd)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states = [(self.y, self.y_start), (self.yd, self.yd_start)]
        yield from initialized("InitialState" if self.initType == "InitialOutput" else self.initType, states)
