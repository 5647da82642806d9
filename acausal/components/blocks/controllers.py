"""Controllers: PI and PID, with limited output, anti-windup, set-point weights and feed-forward."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Equations,
    Expr,
    Input,
    Output,
    Parameter,
    Variable,
    assert_,
    clip,
    conditional,
    connect,
    der,
)

from . import math
from .continuous import Derivative, Integrator
from .interfaces import SISO, initialized
from .math import Add, Add3, Gain
from .nonlinear import Limiter


class PI(SISO):
    """Proportional-integral controller, ``y = k (u + x)``, ``dx/dt = u/T``.

    >>> class Act(Component):
    ...     error: Constant = Constant(k=2.0)
    ...     control: PI = PI(k=3.0, T=0.5)
    ...     def equations(self):
    ...         yield connect(self.error.y, self.control.u)
    >>> close(run(Act(), at=[0.0, 1.0])["control.y"], [6.0, 18.0])
    True

    Source: Modelica.Blocks.Continuous.PI.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, doc="gain")
    T: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="time constant")
    x_start: Parameter = Parameter(0.0, doc="start value of the integral part")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    x: Variable = Variable(start=x_start, doc="integral part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == self.u / self.T
        yield self.y == self.k * (self.x + self.u)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.x, self.x_start)], (self.y, self.y_start))


PIBlock = PI


class PID(SISO):
    """PID controller in additive form, ``y = k (u + I + D)``, ``dI/dt = u/Ti``, ``D = Td s/(Td/Nd s + 1) u``.

    >>> class Act(Component):
    ...     error: Slope = Slope(slope=2.0)
    ...     control: PID = PID(k=3.0, Ti=0.5, Td=0.1, Nd=50.0)
    ...     def equations(self):
    ...         yield connect(self.error.y, self.control.u)
    >>> close(run(Act(), at=[0.5, 1.0])["control.y"], [3 * (1 + 0.5 + 0.2), 3 * (2 + 2.0 + 0.2)], 1e-4)
    True

    Source: Modelica.Blocks.Continuous.PID.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, doc="gain")
    Ti: Parameter = Parameter(0.5, unit="s", min=1e-30, doc="time constant of the integral part")
    Td: Parameter = Parameter(0.1, unit="s", min=1e-30, doc="time constant of the derivative part")
    Nd: Parameter = Parameter(10.0, unit="1", min=1e-30, doc="the higher, the closer to an ideal derivative")
    xi_start: Parameter = Parameter(0.0, doc="start value of the integral part")
    xd_start: Parameter = Parameter(0.0, doc="start value of the filtered input")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    P: math.Gain = math.Gain(k=1.0)
    I: Integrator = Integrator(k=1 / Ti, y_start=xi_start)  # noqa: E741
    D: Derivative = Derivative(k=Td, T=Td / Nd, x_start=xd_start)
    Gain: math.Gain = math.Gain(k=k)
    Add: math.Add3 = math.Add3()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.u, self.P.u, self.I.u, self.D.u)
        yield connect(self.P.y, self.Add.u1)
        yield connect(self.I.y, self.Add.u2)
        yield connect(self.D.y, self.Add.u3)
        yield connect(self.Add.y, self.Gain.u)
        yield connect(self.Gain.y, self.y)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states = [(self.D.x, self.xd_start), (self.I.y, self.xi_start)]
        yield from initialized(self.initType, states, (self.y, self.y_start))


CONTROLLERS = ("P", "PI", "PD", "PID")
"""Values of `controllerType`, as in Modelica.Blocks.Types.SimpleController."""


class LimPID(Component):
    """P, PI, PD or PID controller with limited output, anti-windup and set-point weights.

    ``y = clip(k (P + I + D) + kFF u_ff, yMin, yMax)`` with ``P = wp u_s - u_m``, ``D`` the filtered derivative of
    ``wd u_s - u_m`` and ``Ti dI/dt = u_s - u_m + (y - y*)/(k Ni)``, `y*` the output before the limits.

    >>> class Loop(Component):
    ...     wanted: Constant = Constant(k=1.0)
    ...     control: LimPID = LimPID(k=20.0, Ti=0.1, yMax=2.0, controllerType="PI")
    ...     plant: FirstOrder = FirstOrder(T=0.5)
    ...     def equations(self):
    ...         yield connect(self.wanted.y, self.control.u_s)
    ...         yield connect(self.control.y, self.plant.u)
    ...         yield connect(self.plant.y, self.control.u_m)
    >>> loop = run(Loop(), at=[0.1, 1.0])
    >>> close(loop["plant.y"], [2 * (1 - np.exp(-0.2)), 1.0], 1e-3) and loop["control.y"][0] == 2.0
    True

    Source: Modelica.Blocks.Continuous.LimPID; Astrom and Hagglund, PID Controllers (1995), section 3.5.
    """

    controllerType: str = "PID"
    initType: str = "InitialState"
    withFeedForward: bool = False
    u_s: Input = Input(doc="set point")
    u_m: Input = Input(doc="measurement")
    u_ff: Input = Input(doc="feed-forward, added to the actuating signal with withFeedForward")
    y: Output = Output(doc="actuating signal")
    controlError: Output = Output(doc="control error u_s - u_m")
    k: Parameter = Parameter(1.0, doc="gain")
    Ti: Parameter = Parameter(0.5, unit="s", min=1e-60, doc="time constant of the integral part")
    Td: Parameter = Parameter(0.1, unit="s", min=0.0, doc="time constant of the derivative part")
    yMax: Parameter = Parameter(1.0, doc="upper limit of y")
    yMin: Parameter = Parameter(-yMax, doc="lower limit of y")
    wp: Parameter = Parameter(1.0, min=0.0, doc="weight of the set point in the proportional part")
    wd: Parameter = Parameter(0.0, min=0.0, doc="weight of the set point in the derivative part")
    Ni: Parameter = Parameter(0.9, min=1e-13, doc="Ni Ti is the time constant of the anti-windup")
    Nd: Parameter = Parameter(10.0, min=1e-13, doc="the higher, the closer to an ideal derivative")
    kFF: Parameter = Parameter(1.0, doc="gain of the feed-forward")
    xi_start: Parameter = Parameter(0.0, doc="start value of the integral part")
    xd_start: Parameter = Parameter(0.0, doc="start value of the filtered input of the derivative part")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")

    @property
    def with_I(self) -> bool:
        """Whether there is an integral part."""
        return self.controllerType in ("PI", "PID")

    @property
    def with_D(self) -> bool:
        """Whether there is a derivative part."""
        return self.controllerType in ("PD", "PID")

    addP: Add = Add(k1=wp, k2=-1.0)
    P: Gain = Gain(k=1.0)
    addI: Add3 = conditional(Add3(k2=-1.0), "with_I")
    I: Integrator = conditional(Integrator(k=1 / Ti, y_start=xi_start), "with_I")  # noqa: E741
    addSat: Add = conditional(Add(k1=1.0, k2=-1.0), "with_I")
    gainTrack: Gain = conditional(Gain(k=1 / (k * Ni)), "with_I")
    addD: Add = conditional(Add(k1=wd, k2=-1.0), "with_D")
    D: Derivative = conditional(Derivative(k=Td, T=ac.max(Td / Nd, 1e-14), x_start=xd_start), "with_D")
    addPID: Add3 = Add3()
    gainPID: Gain = Gain(k=k)
    addFF: Add = Add(k1=1.0, k2=kFF)
    limiter: Limiter = Limiter(uMax=yMax, uMin=yMin)

    def equations(self) -> Equations:
        yield from super().equations()
        if self.controllerType not in CONTROLLERS:
            raise DeclarationError(f"controllerType={self.controllerType!r} is not one of {', '.join(CONTROLLERS)}")
        yield self.controlError == self.u_s - self.u_m
        yield connect(self.u_s, self.addP.u1)
        yield connect(self.u_m, self.addP.u2)
        yield connect(self.addP.y, self.P.u)
        yield connect(self.P.y, self.addPID.u1)
        yield from self._derivative()
        yield from self._integral()
        yield connect(self.addPID.y, self.gainPID.u)
        yield connect(self.gainPID.y, self.addFF.u1)
        yield connect(self.u_ff, self.addFF.u2)
        if not self.withFeedForward:
            yield self.u_ff == 0
        yield connect(self.addFF.y, self.limiter.u)
        yield connect(self.limiter.y, self.y)
        if self.initType == "InitialOutput":
            within = (self.y_start >= self.yMin) & (self.y_start <= self.yMax)
            yield assert_(within, "the start of the output, y_start, is not within its limits, yMin and yMax")

    def _derivative(self) -> Equations:
        if not self.with_D:
            yield self.addPID.u2 == 0
            return
        yield connect(self.u_s, self.addD.u1)
        yield connect(self.u_m, self.addD.u2)
        yield connect(self.addD.y, self.D.u)
        yield connect(self.D.y, self.addPID.u2)

    def _integral(self) -> Equations:
        if not self.with_I:
            yield self.addPID.u3 == 0
            return
        yield connect(self.u_s, self.addI.u1)
        yield connect(self.u_m, self.addI.u2)
        yield connect(self.limiter.y, self.addSat.u1)
        yield connect(self.addFF.y, self.addSat.u2)
        yield connect(self.addSat.y, self.gainTrack.u)
        yield connect(self.gainTrack.y, self.addI.u3)
        yield connect(self.addI.y, self.I.u)
        yield connect(self.I.y, self.addPID.u3)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states: list[tuple[Expr, Expr | float]] = []
        if self.with_D:
            states.append((self.D.x, self.xd_start))
        if self.with_I:
            states.append((self.I.y, self.xi_start))
        yield from initialized(self.initType, states, (self.gainPID.y, self.y_start) if states else None)


class LimPI(Component):
    """PI controller with limited output, ``y = clip(Kp e + Ki x, y_min, y_max)``, ``dx/dt = e + (y - y*)/Tt``.

    ``e = u_s - u_m`` is the control error and ``y*`` the output before the limits. With `anti_windup` off (the
    default) the last term is left out and the integral runs on while the output is at a limit.

    >>> class Act(Component):
    ...     wanted: Constant = Constant(k=2.0)
    ...     measured: Constant = Constant(k=1.5)
    ...     control: LimPI = LimPI(Kp=1.0, Ki=2.0, y_max=1.2)
    ...     def equations(self):
    ...         yield connect(self.wanted.y, self.control.u_s)
    ...         yield connect(self.measured.y, self.control.u_m)
    >>> close(run(Act(), at=[0.0, 0.5, 1.0])["control.y"], [0.5, 1.0, 1.2])
    True

    Source: PI controller of the crane of the paper, Fig. 5; back-calculation as in Modelica.Blocks.Continuous.LimPID
    and Astrom and Hagglund, PID Controllers (1995), section 3.5.
    """

    anti_windup: bool = False
    u_s: Input = Input(doc="set point")
    u_m: Input = Input(doc="measurement")
    y: Output = Output(doc="actuating signal")
    Kp: Parameter = Parameter(1.0, doc="proportional gain")
    Ki: Parameter = Parameter(1.0, doc="integral gain")
    y_min: Parameter = Parameter(-1.0, doc="lower limit of y")
    y_max: Parameter = Parameter(1.0, doc="upper limit of y")
    Tt: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="tracking time of the anti-windup")
    e: Variable = Variable(doc="control error u_s - u_m")
    integral: Variable = Variable(start=0.0, fixed=True, nominal=0.1, doc="integral of the control error")

    def equations(self) -> Equations:
        yield from super().equations()
        unlimited = self.Kp * self.e + self.Ki * self.integral
        yield self.e == self.u_s - self.u_m
        yield self.y == clip(unlimited, self.y_min, self.y_max)
        if self.anti_windup:
            yield der(self.integral) == self.e + (self.y - unlimited) / (self.Ki * self.Tt)
        else:
            yield der(self.integral) == self.e
