"""Torques and prescribed motion."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Equations, Input, Parameter, Variable, Vector, der, where

from .. import thermal
from ..adaptors import differentiated
from ..friction import regularized_sign
from .interfaces import PartialOneFlangeAndSupport, PartialTwoFlanges


class Torque(PartialOneFlangeAndSupport):
    """External torque given by a signal, in the direction of increasing phi: ``flange.tau = -tau``.

    >>> model = assemble("ramp.y - drive.tau", "drive.flange - rotor.flange_a", ramp=blocks.Slope(slope=4.0),
    ...                  drive=Torque(), rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], [0.25, 1.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Torque.
    """

    tau: Input = Input(unit="N*m", doc="driving torque")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.tau == -self.tau


class Torque2(PartialTwoFlanges):
    """Torque between two flanges given by a signal: ``flange_a.tau = tau``, ``flange_b.tau = -tau``.

    >>> model = assemble("size.y - drive.tau", "one.flange_a - drive.flange_a", "drive.flange_b - two.flange_a",
    ...                  size=blocks.Constant(k=4.0), drive=Torque2(),
    ...                  one=Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  two=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> rotors = run(model)
    >>> close([rotors["one.w"][-1], rotors["two.w"][-1]], [-4.0, 2.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Torque2.
    """

    tau: Input = Input(unit="N*m", doc="torque that drives b forward and a back")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.tau == self.tau
        yield self.flange_b.tau == -self.tau


class ConstantTorque(PartialOneFlangeAndSupport):
    """Constant external torque, ``flange.tau = -tau_constant``.

    >>> model = assemble("drive.flange - rotor.flange_a", drive=ConstantTorque(tau_constant=4.0),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], [1.0, 2.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.ConstantTorque.
    """

    tau_constant: Parameter = Parameter(1.0, unit="N*m", doc="driving torque")
    tau: Variable = Variable(unit="N*m", doc="driving torque, -flange.tau")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == -self.flange.tau
        yield self.tau == self.tau_constant


class TorqueStep(PartialOneFlangeAndSupport):
    """Torque step, ``flange.tau = -offsetTorque``, from `startTime` on ``-(offsetTorque + stepTorque)``.

    >>> model = assemble("drive.flange - rotor.flange_a", drive=TorqueStep(stepTorque=4.0, startTime=0.5),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], [0.0, 1.0], 1e-4)
    True

    Source: Modelica.Mechanics.Rotational.Sources.TorqueStep.
    """

    stepTorque: Parameter = Parameter(1.0, unit="N*m", doc="height of the step")
    offsetTorque: Parameter = Parameter(0.0, unit="N*m", doc="torque before the step")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the step")
    tau: Variable = Variable(unit="N*m", doc="driving torque, -flange.tau")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == -self.flange.tau
        yield self.tau == self.offsetTorque + where(ac.time < self.startTime, 0.0, self.stepTorque)


class PartialSpeedDependent(PartialOneFlangeAndSupport, partial=True):
    """Driving torque `tau` that depends on the speed `w` of the flange against the support.

    Source: Modelica.Mechanics.Rotational.Sources.LinearSpeedDependentTorque.
    """

    tau_nominal: Parameter = Parameter(1.0, unit="N*m", doc="nominal torque; negative: it brakes")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the flange relative to the support")
    tau: Variable = Variable(unit="N*m", doc="driving torque")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.phi)
        yield self.flange.tau == -self.tau


class LinearSpeedDependentTorque(PartialSpeedDependent):
    """Torque in proportion to the speed, ``tau = tau_nominal |w/w_nominal|``; without TorqueDirection with its sign.

    >>> model = assemble("brake.flange - rotor.flange_a",
    ...                  brake=LinearSpeedDependentTorque(tau_nominal=-8.0, w_nominal=2.0, TorqueDirection=False),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], 3 * np.exp([-1.0, -2.0]))
    True

    Source: Modelica.Mechanics.Rotational.Sources.LinearSpeedDependentTorque.
    """

    TorqueDirection: bool = True
    w_nominal: Parameter = Parameter(1.0, unit="rad/s", min=1e-60, doc="nominal speed")

    def equations(self) -> Equations:
        yield from super().equations()
        share = self.w / self.w_nominal
        yield self.tau == self.tau_nominal * (ac.abs(share) if self.TorqueDirection else share)


class QuadraticSpeedDependentTorque(PartialSpeedDependent):
    """Torque with the square of the speed, ``tau = tau_nominal (w/w_nominal)^2``; without TorqueDirection signed.

    >>> model = assemble("fan.flange - rotor.flange_a",
    ...                  fan=QuadraticSpeedDependentTorque(tau_nominal=-8.0, w_nominal=2.0, TorqueDirection=False),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], 1 / (1 / 3 + np.array([0.5, 1.0])))
    True

    Source: Modelica.Mechanics.Rotational.Sources.QuadraticSpeedDependentTorque.
    """

    TorqueDirection: bool = True
    w_nominal: Parameter = Parameter(1.0, unit="rad/s", min=1e-60, doc="nominal speed")

    def equations(self) -> Equations:
        yield from super().equations()
        share = self.w / self.w_nominal
        yield self.tau == self.tau_nominal * (share**2 if self.TorqueDirection else share * ac.noevent(ac.abs(share)))


class InverseSpeedDependentTorque(PartialSpeedDependent):
    """Torque of constant power, ``tau = tau_nominal w_nominal/|w|``, limited at `w0`; without TorqueDirection signed.

    >>> model = assemble("drive.flange - rotor.flange_a", drive=InverseSpeedDependentTorque(tau_nominal=4.0),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], np.sqrt([3.0, 5.0]))
    True

    Source: Modelica.Mechanics.Rotational.Sources.InverseSpeedDependentTorque.
    """

    TorqueDirection: bool = True
    w_nominal: Parameter = Parameter(1.0, unit="rad/s", min=1e-60, doc="nominal speed")
    w0: Parameter = Parameter(0.1, unit="rad/s", min=1e-60, doc="speed below which the torque is limited")

    def equations(self) -> Equations:
        yield from super().equations()
        speed = ac.max(ac.abs(self.w), self.w0)
        direction = 1.0 if self.TorqueDirection else ac.clip(self.w / self.w0, -1.0, 1.0)
        yield self.tau == self.tau_nominal * self.w_nominal / speed * direction


class SignTorque(PartialSpeedDependent):
    """Torque with the sign of the speed, ``tau = tau_nominal sign(w)``, made continuous around ``|w| < w0`` by `reg`.

    >>> model = assemble("brake.flange - rotor.flange_a", brake=SignTorque(tau_nominal=-4.0, w0=0.1),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], [2.0, 1.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.SignTorque.
    """

    reg: str = "Exp"
    w0: Parameter = Parameter(0.1, unit="rad/s", min=1e-60, doc="speed below which the torque is made continuous")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.tau_nominal * regularized_sign(self.w / self.w0, self.reg, "SignTorque")


class EddyCurrentTorque(thermal.PartialConditionalHeatPort, PartialOneFlangeAndSupport):
    """Eddy current brake, ``tau = 2 tau_nominal excitation^2 x/(1 + x^2)`` with ``x = w/w_n``, which heats itself.

    ``w_n = w_nominal (1 + alpha20/(1 + alpha20 (TRef - 293.15 K)) (T - TRef))``; it always brakes.

    >>> model = assemble("brake.flange - rotor.flange_a", brake=EddyCurrentTorque(tau_nominal=4.0, w_nominal=2.0),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(2.0, fixed=True)))
    >>> brake = run(model, at=[0.0, 1.0])
    >>> w = brake["rotor.w"][-1]
    >>> close(2 * np.log(w / 2) + (w**2 - 4) / 4, -4.0)
    True

    Source: Modelica.Mechanics.Rotational.Sources.EddyCurrentTorque.
    """

    useExcitationInput: bool = False
    tau_nominal: Parameter = Parameter(1.0, unit="N*m", doc="largest torque, braking")
    w_nominal: Parameter = Parameter(1.0, unit="rad/s", min=1e-60, doc="speed of the largest torque at TRef")
    TRef: Parameter = Parameter(293.15, unit="K", doc="reference temperature")
    alpha20: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the material at 20 degC")
    T: Parameter = Parameter(293.15, unit="K", doc="temperature of the device without a heat port")
    T20: Parameter = Parameter(293.15, unit="K", doc="20 degC")
    constantExcitation: Parameter = Parameter(1.0, unit="1", doc="excitation without useExcitationInput")
    excitation: Input = Input(unit="1", doc="excitation with useExcitationInput")
    tau: Variable = Variable(unit="N*m", doc="torque of the flange, against the motion")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the flange relative to the support")
    w_normalized: Variable = Variable(unit="1", doc="speed over that of the largest torque")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.useExcitationInput:
            yield self.excitation == self.constantExcitation
        temperature = self.heatPort.T if self.useHeatPort else self.T
        slope = self.alpha20 / (1 + self.alpha20 * (self.TRef - self.T20))
        x = self.w_normalized
        yield x == self.w / (self.w_nominal * (1 + slope * (temperature - self.TRef)))
        yield self.tau == self.flange.tau
        yield self.w == der(self.phi)
        yield self.tau == 2 * self.tau_nominal * self.excitation**2 * x / (1 + x * x)
        yield self.lossPower == self.tau * self.w


class Position(PartialOneFlangeAndSupport):
    """Motion along a reference angle, exactly with `exact`, otherwise through a second-order Bessel filter of `f_crit`.

    >>> model = assemble("motion.y - lead.phi_ref", "lead.flange - spring.flange_a", "spring.flange_b - wall.flange",
    ...                  motion=blocks.Slope(slope=2.0), lead=Position(exact=True), spring=Spring(c=3.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["spring.tau"], [-3.0, -6.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Position.
    """

    exact: bool = False
    f_crit: Parameter = Parameter(50.0, unit="Hz", min=1e-60, doc="critical frequency of the filter")
    af: Parameter = Parameter(1.3617, unit="1", doc="coefficient of s of the Bessel filter")
    bf: Parameter = Parameter(0.6180, unit="1", doc="coefficient of s^2 of the Bessel filter")
    phi_ref: Input = Input(unit="rad", doc="reference angle")
    w: Variable = Variable(unit="rad/s", start=0.0, doc="angular velocity against the support; 0 with exact")
    a: Variable = Variable(unit="rad/s2", doc="its acceleration; 0 with exact")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.exact:
            yield self.phi == self.phi_ref
            yield self.w == 0  # as in the source: the reference is not differentiated for them, it may jump
            yield self.a == 0
        else:
            w_crit = 2 * PI * self.f_crit
            yield self.w == der(self.phi)
            yield self.a == der(self.w)
            yield self.a == ((self.phi_ref - self.phi) * w_crit - self.af * self.w) * (w_crit / self.bf)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if not self.exact:
            yield self.phi == self.phi_ref


class Speed(PartialOneFlangeAndSupport):
    """Motion with a reference angular velocity, exactly with `exact`, otherwise through a filter of `f_crit`.

    >>> model = assemble("rate.y - lead.w_ref", "lead.flange - damper.flange_a", "damper.flange_b - wall.flange",
    ...                  rate=blocks.Slope(slope=2.0), lead=Speed(exact=True), damper=Damper(d=3.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["damper.tau"], [-3.0, -6.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Speed.
    """

    exact: bool = False
    f_crit: Parameter = Parameter(50.0, unit="Hz", min=1e-60, doc="critical frequency of the filter")
    w_ref: Input = Input(unit="rad/s", doc="reference angular velocity")
    phi: Variable = Variable(unit="rad", start=0.0, doc="angle of the flange relative to the support")
    w: Variable = Variable(unit="rad/s", start=0.0, doc="angular velocity of the flange relative to the support")
    a: Variable = Variable(unit="rad/s2", doc="its acceleration; 0 with exact")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.phi)
        if self.exact:
            yield self.w == self.w_ref
            yield self.a == 0  # as in the source: the reference is not differentiated for it, it may jump
        else:
            yield self.a == der(self.w)
            yield self.a == (self.w_ref - self.w) * 2 * PI * self.f_crit

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if not self.exact:
            yield self.w == self.w_ref


class ConstantSpeed(PartialOneFlangeAndSupport):
    """Constant angular velocity, whatever the torque: ``dphi/dt = w_fixed``.

    >>> model = assemble("lead.flange - damper.flange_a", "damper.flange_b - wall.flange", damper=Damper(d=3.0),
    ...                  lead=ConstantSpeed(w_fixed=2.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["damper.tau"], [-6.0, -6.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.ConstantSpeed.
    """

    w_fixed: Parameter = Parameter(1.0, unit="rad/s", doc="angular velocity")
    phi: Variable = Variable(unit="rad", start=0.0, doc="angle of the flange relative to the support")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the flange relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.phi)
        yield self.w == self.w_fixed


class Accelerate(PartialOneFlangeAndSupport):
    """Motion with a reference angular acceleration, ``d2phi/dt2 = a_ref``, from rest at 0.

    >>> model = assemble("push.y - lead.a_ref", "lead.flange - rotor.flange_a", push=blocks.Constant(k=4.0),
    ...                  lead=Accelerate(), rotor=Inertia(J=2.0))
    >>> lead = run(model, at=[0.5, 1.0])
    >>> close(lead["rotor.phi"], [0.5, 2.0]) and close(lead["rotor.flange_a.tau"], [8.0, 8.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Accelerate.
    """

    a_ref: Input = Input(unit="rad/s2", doc="reference angular acceleration")
    phi: Variable = Variable(
        unit="rad", start=0.0, fixed=True, state_select="prefer", doc="angle of the flange relative to the support"
    )
    w: Variable = Variable(unit="rad/s", start=0.0, fixed=True, state_select="prefer", doc="its angular velocity")
    a: Variable = Variable(unit="rad/s2", doc="its angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.a == self.a_ref


class Move(PartialOneFlangeAndSupport):
    """Motion with a reference angle ``u[1]``, velocity ``u[2] = du[1]/dt`` and acceleration ``u[3] = du[2]/dt``.

    Velocity and acceleration are needed where the three are inputs of the whole model, whose derivatives nothing else
    would say.

    >>> class Driven(Component):
    ...     move: Move = Move()
    ...     body: Inertia = Inertia(J=2.0)
    ...     def equations(self):
    ...         yield connect(self.move.flange, self.body.flange_a)
    ...         yield self.move.u[0] == ac.time**2
    ...         yield self.move.u[1] == 2 * ac.time
    ...         yield self.move.u[2] == 2.0
    >>> driven = run(Driven(), at=[0.5, 1.0])
    >>> close(driven["body.phi"], [0.25, 1.0]) and close(driven["body.flange_a.tau"], [4.0, 4.0])
    True

    Source: Modelica.Mechanics.Rotational.Sources.Move.
    """

    u: Vector = Vector(Input(doc="angle, velocity and acceleration of the flange relative to the support"), size=3)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.u[0]
        yield from differentiated(self.u[0], self.u[1], self.u[2])
