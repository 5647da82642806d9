"""Forces and prescribed motion."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Equations, Input, Parameter, Variable, Vector, der, where

from .. import thermal
from ..adaptors import differentiated
from ..friction import regularized_sign
from .interfaces import PartialOneFlangeAndSupport, PartialTwoFlanges


class Force(PartialOneFlangeAndSupport):
    """External force given by a signal, in the direction of increasing s: ``flange.f = -f``.

    >>> model = assemble("ramp.y - drive.f", "drive.flange - mass.flange_a", ramp=blocks.Slope(slope=4.0),
    ...                  drive=Force(), mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [0.25, 1.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Force.
    """

    f: Input = Input(unit="N", doc="driving force")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == -self.f


class Force2(PartialTwoFlanges):
    """Force between two flanges given by a signal: ``flange_a.f = f``, ``flange_b.f = -f``.

    >>> model = assemble("size.y - drive.f", "one.flange_a - drive.flange_a", "drive.flange_b - two.flange_a",
    ...                  size=blocks.Constant(k=4.0), drive=Force2(),
    ...                  one=Mass(m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    ...                  two=Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> masss = run(model)
    >>> close([masss["one.v"][-1], masss["two.v"][-1]], [-4.0, 2.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Force2.
    """

    f: Input = Input(unit="N", doc="force that drives b forward and a back")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.f == self.f
        yield self.flange_b.f == -self.f


class PartialForce(PartialOneFlangeAndSupport, partial=True):
    """Force `f` at the flange, ``f = flange.f``: a force that drives forward is negative.

    (The torque `tau` of rotational sources has the other sign, in Modelica too.)

    Source: Modelica.Mechanics.Translational.Interfaces.PartialForce.
    """

    f: Variable = Variable(unit="N", doc="force of the flange on the component, flange.f")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.flange.f


class ConstantForce(PartialForce):
    """Constant external force, ``f = flange.f = -f_constant``.

    >>> model = assemble("drive.flange - mass.flange_a", drive=ConstantForce(f_constant=4.0),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [1.0, 2.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.ConstantForce.
    """

    f_constant: Parameter = Parameter(1.0, unit="N", doc="driving force")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == -self.f_constant


class ForceStep(PartialForce):
    """Force step, ``f = flange.f = -offsetForce``, from `startTime` on ``-(offsetForce + stepForce)``.

    >>> model = assemble("drive.flange - mass.flange_a", drive=ForceStep(stepForce=4.0, startTime=0.5),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [0.0, 1.0], 1e-4)
    True

    Source: Modelica.Mechanics.Translational.Sources.ForceStep.
    """

    stepForce: Parameter = Parameter(1.0, unit="N", doc="height of the step")
    offsetForce: Parameter = Parameter(0.0, unit="N", doc="force before the step")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == -self.offsetForce - where(ac.time < self.startTime, 0.0, self.stepForce)


class PartialSpeedDependent(PartialForce, partial=True):
    """Force that depends on the speed `v` of the flange against the support; ``f = flange.f``, minus what drives.

    Source: Modelica.Mechanics.Translational.Sources.LinearSpeedDependentForce.
    """

    f_nominal: Parameter = Parameter(1.0, unit="N", doc="nominal force; negative: it brakes")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)


class LinearSpeedDependentForce(PartialSpeedDependent):
    """Force in proportion to the speed, ``f = -f_nominal |v/v_nominal|``; without ForceDirection with its sign.

    >>> model = assemble("brake.flange - mass.flange_a",
    ...                  brake=LinearSpeedDependentForce(f_nominal=-8.0, v_nominal=2.0, ForceDirection=False),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], 3 * np.exp([-1.0, -2.0]))
    True

    Source: Modelica.Mechanics.Translational.Sources.LinearSpeedDependentForce.
    """

    ForceDirection: bool = True
    v_nominal: Parameter = Parameter(1.0, unit="m/s", min=1e-60, doc="nominal speed")

    def equations(self) -> Equations:
        yield from super().equations()
        share = self.v / self.v_nominal
        yield self.f == -self.f_nominal * (ac.abs(share) if self.ForceDirection else share)


class QuadraticSpeedDependentForce(PartialSpeedDependent):
    """Force with the square of the speed, ``f = -f_nominal (v/v_nominal)^2``; without ForceDirection signed.

    >>> model = assemble("fan.flange - mass.flange_a",
    ...                  fan=QuadraticSpeedDependentForce(f_nominal=-8.0, v_nominal=2.0, ForceDirection=False),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], 1 / (1 / 3 + np.array([0.5, 1.0])))
    True

    Source: Modelica.Mechanics.Translational.Sources.QuadraticSpeedDependentForce.
    """

    ForceDirection: bool = True
    v_nominal: Parameter = Parameter(1.0, unit="m/s", min=1e-60, doc="nominal speed")

    def equations(self) -> Equations:
        yield from super().equations()
        share = self.v / self.v_nominal
        yield self.f == -self.f_nominal * (share**2 if self.ForceDirection else share * ac.noevent(ac.abs(share)))


class InverseSpeedDependentForce(PartialSpeedDependent):
    """Force of constant power, ``f = -f_nominal v_nominal/|v|``, limited at `v0`; without ForceDirection signed.

    >>> model = assemble("drive.flange - mass.flange_a", drive=InverseSpeedDependentForce(f_nominal=4.0),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], np.sqrt([3.0, 5.0]))
    True

    Source: Modelica.Mechanics.Translational.Sources.InverseSpeedDependentForce.
    """

    ForceDirection: bool = True
    v_nominal: Parameter = Parameter(1.0, unit="m/s", min=1e-60, doc="nominal speed")
    v0: Parameter = Parameter(0.1, unit="m/s", min=1e-60, doc="speed below which the force is limited")

    def equations(self) -> Equations:
        yield from super().equations()
        speed = ac.max(ac.abs(self.v), self.v0)
        direction = 1.0 if self.ForceDirection else ac.clip(self.v / self.v0, -1.0, 1.0)
        yield self.f == -self.f_nominal * self.v_nominal / speed * direction


class SignForce(PartialSpeedDependent):
    """Force with the sign of the speed, ``f = -f_nominal sign(v)``, made continuous around ``|v| < v0`` by `reg`.

    >>> model = assemble("brake.flange - mass.flange_a", brake=SignForce(f_nominal=-4.0, v0=0.1),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [2.0, 1.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.SignForce.
    """

    reg: str = "Exp"
    v0: Parameter = Parameter(0.1, unit="m/s", min=1e-60, doc="speed below which the force is made continuous")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == -self.f_nominal * regularized_sign(self.v / self.v0, self.reg, "SignForce")


class EddyCurrentForce(thermal.PartialConditionalHeatPort, PartialForce):
    """Eddy current brake, ``f = 2 f_nominal excitation^2 x/(1 + x^2)`` with ``x = v/v_n``, which heats itself.

    ``v_n = v_nominal (1 + alpha20/(1 + alpha20 (TRef - 293.15 K)) (T - TRef))``; it always brakes.

    >>> model = assemble("brake.flange - mass.flange_a", brake=EddyCurrentForce(f_nominal=4.0, v_nominal=2.0),
    ...                  mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(2.0, fixed=True)))
    >>> brake = run(model, at=[0.0, 1.0])
    >>> v = brake["mass.v"][-1]
    >>> close(2 * np.log(v / 2) + (v**2 - 4) / 4, -4.0)
    True

    Source: Modelica.Mechanics.Translational.Sources.EddyCurrentForce.
    """

    useExcitationInput: bool = False
    f_nominal: Parameter = Parameter(1.0, unit="N", doc="largest force, braking")
    v_nominal: Parameter = Parameter(1.0, unit="m/s", min=1e-60, doc="speed of the largest force at TRef")
    TRef: Parameter = Parameter(293.15, unit="K", doc="reference temperature")
    alpha20: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the material at 20 degC")
    T: Parameter = Parameter(293.15, unit="K", doc="temperature of the device without a heat port")
    T20: Parameter = Parameter(293.15, unit="K", doc="20 degC")
    constantExcitation: Parameter = Parameter(1.0, unit="1", doc="excitation without useExcitationInput")
    excitation: Input = Input(unit="1", doc="excitation with useExcitationInput")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange relative to the support")
    v_normalized: Variable = Variable(unit="1", doc="speed over that of the largest force")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.useExcitationInput:
            yield self.excitation == self.constantExcitation
        temperature = self.heatPort.T if self.useHeatPort else self.T
        slope = self.alpha20 / (1 + self.alpha20 * (self.TRef - self.T20))
        x = self.v_normalized
        yield x == self.v / (self.v_nominal * (1 + slope * (temperature - self.TRef)))
        yield self.v == der(self.s)
        yield self.f == 2 * self.f_nominal * self.excitation**2 * x / (1 + x * x)
        yield self.lossPower == self.f * self.v


class Position(PartialOneFlangeAndSupport):
    """Motion along a reference position, exactly with `exact`, otherwise through a Bessel filter of `f_crit`.

    >>> model = assemble("motion.y - lead.s_ref", "lead.flange - spring.flange_a", "spring.flange_b - wall.flange",
    ...                  motion=blocks.Slope(slope=2.0), lead=Position(exact=True), spring=Spring(c=3.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["spring.f"], [-3.0, -6.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Position.
    """

    exact: bool = False
    f_crit: Parameter = Parameter(50.0, unit="Hz", min=1e-60, doc="critical frequency of the filter")
    af: Parameter = Parameter(1.3617, unit="1", doc="coefficient of s of the Bessel filter")
    bf: Parameter = Parameter(0.6180, unit="1", doc="coefficient of s^2 of the Bessel filter")
    s_ref: Input = Input(unit="m", doc="reference position")
    v: Variable = Variable(unit="m/s", start=0.0, doc="velocity against the support; 0 with exact")
    a: Variable = Variable(unit="m/s2", doc="its acceleration; 0 with exact")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.exact:
            yield self.s == self.s_ref
            yield self.v == 0  # as in the source: the reference is not differentiated for them, it may jump
            yield self.a == 0
        else:
            w_crit = 2 * PI * self.f_crit
            yield self.v == der(self.s)
            yield self.a == der(self.v)
            yield self.a == ((self.s_ref - self.s) * w_crit - self.af * self.v) * (w_crit / self.bf)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if not self.exact:
            yield self.s == self.s_ref


class Speed(PartialOneFlangeAndSupport):
    """Motion with a reference velocity, exactly with `exact`, otherwise through a filter of `f_crit`.

    >>> model = assemble("rate.y - lead.v_ref", "lead.flange - damper.flange_a", "damper.flange_b - wall.flange",
    ...                  rate=blocks.Slope(slope=2.0), lead=Speed(exact=True), damper=Damper(d=3.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["damper.f"], [-3.0, -6.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Speed.
    """

    exact: bool = False
    f_crit: Parameter = Parameter(50.0, unit="Hz", min=1e-60, doc="critical frequency of the filter")
    v_ref: Input = Input(unit="m/s", doc="reference velocity")
    s: Variable = Variable(unit="m", start=0.0, doc="position of the flange relative to the support")
    v: Variable = Variable(unit="m/s", start=0.0, doc="velocity of the flange relative to the support")
    a: Variable = Variable(unit="m/s2", doc="its acceleration; 0 with exact")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)
        if self.exact:
            yield self.v == self.v_ref
            yield self.a == 0  # as in the source: the reference is not differentiated for it, it may jump
        else:
            yield self.a == der(self.v)
            yield self.a == (self.v_ref - self.v) * 2 * PI * self.f_crit

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if not self.exact:
            yield self.v == self.v_ref


class ConstantSpeed(PartialForce):
    """Constant velocity, whatever the force: ``ds/dt = v_fixed``.

    >>> model = assemble("lead.flange - damper.flange_a", "damper.flange_b - wall.flange", damper=Damper(d=3.0),
    ...                  lead=ConstantSpeed(v_fixed=2.0), wall=Fixed())
    >>> close(run(model, at=[0.5, 1.0])["damper.f"], [-6.0, -6.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.ConstantSpeed.
    """

    v_fixed: Parameter = Parameter(1.0, unit="m/s", doc="velocity")
    s: Variable = Variable(unit="m", start=0.0, doc="position of the flange relative to the support")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange relative to the support")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.v == self.v_fixed


class Accelerate(PartialOneFlangeAndSupport):
    """Motion with a reference acceleration, ``d2s/dt2 = a_ref``, from rest at 0.

    >>> model = assemble("push.y - lead.a_ref", "lead.flange - mass.flange_a", push=blocks.Constant(k=4.0),
    ...                  lead=Accelerate(), mass=Mass(m=2.0))
    >>> lead = run(model, at=[0.5, 1.0])
    >>> close(lead["mass.s"], [0.5, 2.0]) and close(lead["mass.flange_a.f"], [8.0, 8.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Accelerate.
    """

    a_ref: Input = Input(unit="m/s2", doc="reference acceleration")
    s: Variable = Variable(
        unit="m", start=0.0, fixed=True, state_select="prefer", doc="position of the flange relative to the support"
    )
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True, state_select="prefer", doc="its velocity")
    a: Variable = Variable(unit="m/s2", doc="its acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.a == self.a_ref


class Move(PartialOneFlangeAndSupport):
    """Motion with a reference position ``u[1]``, velocity ``u[2] = du[1]/dt`` and acceleration ``u[3] = du[2]/dt``.

    Velocity and acceleration are needed where the three are inputs of the whole model, whose derivatives nothing else
    would say.

    >>> class Driven(Component):
    ...     move: Move = Move()
    ...     body: Mass = Mass(m=2.0)
    ...     def equations(self):
    ...         yield connect(self.move.flange, self.body.flange_a)
    ...         yield self.move.u[0] == ac.time**2
    ...         yield self.move.u[1] == 2 * ac.time
    ...         yield self.move.u[2] == 2.0
    >>> driven = run(Driven(), at=[0.5, 1.0])
    >>> close(driven["body.s"], [0.25, 1.0]) and close(driven["body.flange_a.f"], [4.0, 4.0])
    True

    Source: Modelica.Mechanics.Translational.Sources.Move.
    """

    u: Vector = Vector(Input(doc="position, velocity and acceleration of the flange relative to the support"), size=3)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.u[0]
        yield from differentiated(self.u[0], self.u[1], self.u[2])
