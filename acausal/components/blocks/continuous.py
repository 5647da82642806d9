"""Linear continuous blocks: integrators, lags, controllers, transfer functions, state spaces."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import (
    Array,
    Component,
    DeclarationError,
    Equations,
    Expr,
    Input,
    Output,
    Parameter,
    Variable,
    clip,
    conditional,
    connect,
    der,
    where,
)

from . import math
from .interfaces import SISO, SignalIn, SignalOut, initialized
from .math import Add, Add3, Gain
from .nonlinear import Limiter


class Integrator(SISO):
    """Integrator, ``dy/dt = k u``; `y_start` holds at the start unless something else determines it.

    >>> class Fill(Component):
    ...     flow: Constant = Constant(k=3.0)
    ...     level: Integrator = Integrator(k=0.5, y_start=1.0)
    ...     def equations(self):
    ...         yield connect(self.flow.y, self.level.u)
    >>> run(Fill(), at=[0.0, 1.0])["level.y"]
    [1.0, 2.5]

    Source: Modelica.Blocks.Continuous.Integrator.
    """

    initType: str = "NoInit"
    k: Parameter = Parameter(1.0, unit="1/s", doc="gain")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    y: Output = Output(start=y_start, doc="output signal")

    def rate(self) -> Expr:
        """Derivative of the output."""
        return self.k * self.u

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == self.rate()

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.y, self.y_start)], (self.y, self.y_start))


class LimIntegrator(Integrator):
    """Integrator that stops at its limits, ``dy/dt = k u``, but 0 beyond `outMin` or `outMax` when going outwards.

    >>> class Tank(Component):
    ...     flow: Constant = Constant(k=4.0)
    ...     level: LimIntegrator = LimIntegrator(outMax=2.0)
    ...     def equations(self):
    ...         yield connect(self.flow.y, self.level.u)
    >>> close(run(Tank(), at=[0.25, 0.75, 1.0])["level.y"], [1.0, 2.0, 2.0], 1e-3)
    True

    Source: Modelica.Blocks.Continuous.LimIntegrator.
    """

    outMax: Parameter = Parameter(1.0, doc="upper limit of the output")
    outMin: Parameter = Parameter(-outMax, doc="lower limit of the output")

    def rate(self) -> Expr:
        """Derivative of the output."""
        rate = self.k * self.u
        above, below = self.y > self.outMax, self.y < self.outMin
        return where((below & (rate < 0)) | (above & (rate > 0)), 0.0, rate)


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


class State(Component):
    """One state of a block with several, ``block.x[i].x``; the block gives its equation.

    Source: state vector of Modelica.Blocks.Continuous.TransferFunction.
    """

    x: Variable = Variable(start=0.0, doc="state")


class TransferFunction(SISO):
    """Transfer function ``(b[0] s^m + ... + b[m]) / (a[0] s^n + ... + a[n])``, in controller canonical form.

    States ``x[i].x``, ``dx[i]/dt = x[i-1]``, scaled so that ``x[n-1]`` is the output of ``a[n]/a(s)`` over the gain.

    >>> class Lag(Component):
    ...     step: Step = Step(height=3.0)
    ...     lag: TransferFunction = TransferFunction(b=[2.0, 1.0], a=[0.5, 1.0])
    ...     def equations(self):
    ...         yield connect(self.step.y, self.lag.u)
    >>> close(run(Lag(), at=[0.25, 1.0])["lag.y"], 3 * (1 + 3 * np.exp([-0.5, -2.0])), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.TransferFunction; Kailath, Linear Systems (1980), section 2.1.
    """

    b: Sequence[float] = (1.0,)
    a: Sequence[float] = (1.0,)
    initType: str = "NoInit"
    y_start: Parameter = Parameter(0.0, doc="start value of the output")

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.a) - 1

    x: Array[State] = Array(State(), "nx")

    def equations(self) -> Equations:
        yield from super().equations()
        n, lead = self.nx, self.a[0]
        if len(self.b) > n + 1 or lead == 0:
            raise DeclarationError(f"b={self.b}, a={self.a}: a[0] must not be 0 and b not longer than a")
        numerator = (0.0,) * (n + 1 - len(self.b)) + tuple(self.b)
        through = numerator[0] / lead
        scale = self.a[-1] if abs(self.a[-1]) > 1e-14 else 1.0
        output = through * self.u
        if n:
            feedback = sum((self.a[i + 1] * self.x[i].x for i in range(1, n)), self.a[1] * self.x[0].x)
            yield lead * der(self.x[0].x) == scale * self.u - feedback
        for i in range(1, n):
            yield der(self.x[i].x) == self.x[i - 1].x
        for i in range(n):
            output = output + (numerator[i + 1] - through * self.a[i + 1]) / scale * self.x[i].x
        yield self.y == output

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states = [(self.x[i].x, 0.0) for i in reversed(range(self.nx))]
        yield from initialized(self.initType, states, (self.y, self.y_start) if states else None)


class StateSpace(Component):
    """State space, ``dx/dt = A x + B u``, ``y = C x + D u``; signals ``u[i].u``, ``y[i].y``, states ``x[i].x``.

    >>> class Spring(Component):
    ...     push: Step = Step(height=4.0)
    ...     mass: StateSpace = StateSpace(A=[[0, 1], [-4, 0]], B=[[0], [1]], C=[[1, 0]])
    ...     def equations(self):
    ...         yield connect(self.push.y, self.mass.u[0].u)
    >>> close(run(Spring(), at=[0.5, 1.0])["mass.y[0].y"], 1 - np.cos([1.0, 2.0]), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.StateSpace.
    """

    A: Sequence[Sequence[float]] = ((1.0, 0.0), (0.0, 1.0))
    B: Sequence[Sequence[float]] = ((1.0,), (1.0,))
    C: Sequence[Sequence[float]] = ((1.0, 1.0),)
    D: Sequence[Sequence[float]] = ()
    initType: str = "NoInit"

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def nu(self) -> int:
        """Number of inputs."""
        return len(self.B[0]) if self.B else 0

    @property
    def ny(self) -> int:
        """Number of outputs."""
        return len(self.C)

    u: Array[SignalIn] = Array(SignalIn(), "nu")
    y: Array[SignalOut] = Array(SignalOut(), "ny")
    x: Array[State] = Array(State(), "nx")

    def equations(self) -> Equations:
        yield from super().equations()
        direct = self.D or ((0.0,) * self.nu,) * self.ny
        shapes = (self.A, self.nx, self.nx), (self.B, self.nx, self.nu), (self.C, self.ny, self.nx)
        for matrix, rows, columns in (*shapes, (direct, self.ny, self.nu)):
            if len(matrix) != rows or any(len(row) != columns for row in matrix):
                raise DeclarationError(f"StateSpace: {matrix} should have {rows} rows of {columns} numbers")
        for i in range(self.nx):
            yield der(self.x[i].x) == self._row(self.A[i], self.B[i])
        for i in range(self.ny):
            yield self.y[i].y == self._row(self.C[i], direct[i])

    def _row(self, of_states: Sequence[float], of_inputs: Sequence[float]) -> Expr:
        terms = [c * self.x[j].x for j, c in enumerate(of_states) if c]
        terms += [c * self.u[j].u for j, c in enumerate(of_inputs) if c]
        return sum(terms[1:], terms[0]) if terms else 0.0 * self.x[0].x

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.x[i].x, 0.0) for i in range(self.nx)])
