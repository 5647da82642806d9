"""One-dimensional translational mechanics (Modelica Standard Library 4.0, `Modelica.Mechanics.Translational`).

A flange has a position `s`, the same for all that is connected, and a force `f`, positive when it acts on the component
in the direction of increasing `s`. A force between two flanges is positive when it pulls them together (tension).
"""

from __future__ import annotations

from acausal import Component, Connector, Equations, Flow, Input, Output, Parameter, Potential, Variable, der, where
from acausal import max as maximum
from acausal import min as minimum


class Flange(Connector):
    """One-dimensional translational flange.

    Source: Modelica.Mechanics.Translational.Interfaces.Flange_a.
    """

    s: Potential = Potential(unit="m", doc="absolute position")
    f: Flow = Flow(unit="N", nominal=1e3, doc="cut force acting on the component")


class PartialCompliant(Component, partial=True):
    """Two flanges, no mass: ``s_rel = flange_b.s - flange_a.s``, force ``f = flange_b.f = -flange_a.f``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialCompliant.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    s_rel: Variable = Variable(unit="m", doc="relative position, flange_b.s - flange_a.s")
    f: Variable = Variable(unit="N", nominal=1e3, doc="force between the flanges, positive in tension")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.flange_b.f == self.f
        yield self.flange_a.f == -self.f


class PartialCompliantWithVelocity(PartialCompliant, partial=True):
    """Compliant element that needs the relative velocity, ``v_rel = d(flange_b.s)/dt - d(flange_a.s)/dt``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialCompliantWithRelativeStates, with the derivatives taken
    at the flanges, where they are derivatives of the states of the masses.
    """

    v_rel: Variable = Variable(unit="m/s", doc="relative velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v_rel == der(self.flange_b.s) - der(self.flange_a.s)


class PartialRigid(Component, partial=True):
    """Two flanges rigidly joined at distance `L`: ``flange_a.s = s - L/2``, ``flange_b.s = s + L/2``.

    Source: Modelica.Mechanics.Translational.Interfaces.PartialRigid.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    L: Parameter = Parameter(0.0, unit="m", doc="length from flange a to flange b")
    s: Variable = Variable(unit="m", doc="position of the centre")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.s - self.L / 2
        yield self.flange_b.s == self.s + self.L / 2


class Mass(PartialRigid):
    """Sliding mass of length `L`, ``v = ds/dt``, ``a = dv/dt``, ``m a = flange_a.f + flange_b.f``.

    Source: Modelica.Mechanics.Translational.Components.Mass.
    """

    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    v: Variable = Variable(unit="m/s", doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange_a.f + self.flange_b.f


class PointMass(Component):
    """Sliding mass with one flange, ``s = flange.s``, ``v = ds/dt``, ``a = dv/dt``, ``m a = flange.f``.

    Source: Newton's second law (Eq. 14); Modelica.Mechanics.Translational.Components.Mass with L = 0.
    """

    flange: Flange = Flange()
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    s: Variable = Variable(unit="m", doc="position")
    v: Variable = Variable(unit="m/s", doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.flange.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange.f


class Rod(PartialRigid):
    """Rod without mass, ``0 = flange_a.f + flange_b.f``.

    Source: Modelica.Mechanics.Translational.Components.Rod.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.f + self.flange_b.f == 0


class Fixed(Component):
    """Flange fixed in the housing at `s0`, ``flange.s = s0``.

    Source: Modelica.Mechanics.Translational.Components.Fixed.
    """

    flange: Flange = Flange()
    s0: Parameter = Parameter(0.0, unit="m", doc="position")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.s == self.s0


class Spring(PartialCompliant):
    """Linear spring, ``f = c (s_rel - s_rel0)``.

    Source: Modelica.Mechanics.Translational.Components.Spring.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s_rel - self.s_rel0)


class Damper(PartialCompliantWithVelocity):
    """Linear damper, ``f = d v_rel``; the power ``f v_rel`` is lost.

    Source: Modelica.Mechanics.Translational.Components.Damper.
    """

    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    lossPower: Variable = Variable(unit="W", doc="power lost")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.d * self.v_rel
        yield self.lossPower == self.f * self.v_rel


class SpringDamper(PartialCompliantWithVelocity):
    """Linear spring and damper in parallel, ``f = c (s_rel - s_rel0) + d v_rel``.

    Source: Modelica.Mechanics.Translational.Components.SpringDamper.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel


class ElastoGap(PartialCompliantWithVelocity):
    """Spring and damper that touch where ``s_rel < s_rel0``; contact never pulls.

    In contact ``f = f_c + clip(d v_rel, f_c, -f_c)`` with ``f_c = c (s_rel - s_rel0)``, else 0.

    Source: Modelica.Mechanics.Translational.Components.ElastoGap with n = 1.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")
    contact_force: Variable = Variable(unit="N", doc="spring force as if in contact")

    def equations(self) -> Equations:
        yield from super().equations()
        spring = self.contact_force
        damping = minimum(maximum(self.d * self.v_rel, spring), -spring)
        yield spring == self.c * (self.s_rel - self.s_rel0)
        yield self.f == where(self.s_rel < self.s_rel0, spring + damping, 0.0)


class EndStops(Component):
    """Bumpers at both ends of a stroke, fixed in the housing.

    Force on the flange ``-k (s - s_min) - c v`` for ``s < s_min``, ``-k (s - s_max) - c v`` for ``s > s_max``, else 0.

    Source: Eq. 15, with contact without a gap.
    """

    flange: Flange = Flange()
    s_min: Parameter = Parameter(0.0, unit="m", doc="position of the lower bumper")
    s_max: Parameter = Parameter(1.0, unit="m", doc="position of the upper bumper")
    k: Parameter = Parameter(1e8, unit="N/m", min=0.0, doc="spring constant")
    c: Parameter = Parameter(4e5, unit="N*s/m", min=0.0, doc="damping constant")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        s = self.flange.s
        low = self.k * (s - self.s_min) + self.c * self.v
        high = self.k * (s - self.s_max) + self.c * self.v
        yield self.v == der(s)
        yield self.flange.f == where(s < self.s_min, low, where(s > self.s_max, high, 0.0))


class ViscousFriction(Component):
    """Viscous friction against the housing, ``flange.f = d v``.

    Source: damping of the piston in Eq. 14; Modelica.Mechanics.Translational.Components.Damper to a Fixed.
    """

    flange: Flange = Flange()
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.flange.s)
        yield self.flange.f == self.d * self.v


class Force(Component):
    """External force given by a signal, in the direction of increasing s: ``flange.f = -f``.

    Source: Modelica.Mechanics.Translational.Sources.Force.
    """

    flange: Flange = Flange()
    f: Input = Input(doc="driving force [N]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == -self.f


class Force2(Component):
    """Force between two flanges given by a signal: ``flange_a.f = f``, ``flange_b.f = -f``.

    Source: Modelica.Mechanics.Translational.Sources.Force2.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    f: Input = Input(doc="force that drives b forward and a back [N]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.f == self.f
        yield self.flange_b.f == -self.f


class ConstantForce(Component):
    """Constant external force, ``flange.f = -f_constant``.

    Source: Modelica.Mechanics.Translational.Sources.ConstantForce.
    """

    flange: Flange = Flange()
    f_constant: Parameter = Parameter(1.0, unit="N", doc="driving force")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == -self.f_constant


class Position(Component):
    """Motion along a reference position, ``flange.s = s_ref``; the reference must be differentiable where a mass
    follows.

    Source: Modelica.Mechanics.Translational.Sources.Position with exact = true.
    """

    flange: Flange = Flange()
    s_ref: Input = Input(doc="reference position [m]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.s == self.s_ref


class Speed(Component):
    """Motion with a reference velocity, ``ds/dt = v_ref``.

    Source: Modelica.Mechanics.Translational.Sources.Speed with exact = true.
    """

    flange: Flange = Flange()
    v_ref: Input = Input(doc="reference velocity [m/s]")
    s: Variable = Variable(unit="m", start=0.0, doc="position of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.flange.s
        yield der(self.s) == self.v_ref


class PositionSensor(Component):
    """Position of a flange, ``s = flange.s``; takes no force.

    Source: Modelica.Mechanics.Translational.Sensors.PositionSensor.
    """

    flange: Flange = Flange()
    s: Output = Output(unit="m", doc="position of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == 0
        yield self.s == self.flange.s


class SpeedSensor(Component):
    """Velocity of a flange, ``v = d(flange.s)/dt``; takes no force.

    Source: Modelica.Mechanics.Translational.Sensors.SpeedSensor.
    """

    flange: Flange = Flange()
    v: Output = Output(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.f == 0
        yield self.v == der(self.flange.s)


class ForceSensor(Component):
    """Force between two flanges that move together, ``f = flange_a.f``.

    Source: Modelica.Mechanics.Translational.Sensors.ForceSensor.
    """

    flange_a: Flange = Flange()
    flange_b: Flange = Flange()
    f: Output = Output(unit="N", doc="force from b on a through the sensor, flange_a.f")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == self.flange_b.s
        yield self.flange_a.f + self.flange_b.f == 0
        yield self.f == self.flange_a.f
