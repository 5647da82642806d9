"""Planar mechanism of a crane boom: the boom on its joint, and the cylinder that drives it.

Angles are counted against the clock from the horizontal. The cylinder acts at two points, at distances `a` and `b`
from the joint (Fig. 10 of the paper); its length L and its lever h = dL/dphi follow from the triangle of these points.
"""

from __future__ import annotations

from acausal import PI, Component, Equations, Parameter, Variable, cos, der, sin, sqrt

from .. import rotational, translational


class PartialBoom(Component, partial=True):
    """Rigid boom on a revolute joint under gravity; subclasses give the law of motion for `w` = dphi/dt.

    Source: Fig. 10.
    """

    flange: rotational.Flange = rotational.Flange()
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass with payload")
    r: Parameter = Parameter(1.0, unit="m", doc="distance of the centre of gravity from the joint")
    I: Parameter = Parameter(1.0, unit="kg*m2", min=0.0, doc="moment of inertia about the joint")  # noqa: E741
    g: Parameter = Parameter(9.81, unit="m/s2", doc="acceleration of gravity")
    phi: Variable = Variable(unit="rad", state_select="prefer", doc="angle above the horizontal")
    w: Variable = Variable(unit="rad/s", nominal=0.1, doc="angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange.phi
        yield der(self.phi) == self.w


class Boom(PartialBoom):
    """Rigid boom on a revolute joint under gravity: ``dphi/dt = w``, ``I dw/dt = flange.tau - m g r cos(phi)``.

    >>> values = run(assemble(boom=Boom(m=2.0, r=1.5, I=6.0, phi=start(0.5, fixed=True), w=start(0.0, fixed=True))))
    >>> close(0.5 * 6.0 * values["boom.w"][-1] ** 2, 2.0 * 9.81 * 1.5 * (np.sin(0.5) - np.sin(values["boom.phi"][-1])))
    True

    Source: Eqs. 18 and 19.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.I * der(self.w) == self.flange.tau - self.m * self.g * self.r * cos(self.phi)


class PartialCylinderJoint(Component, partial=True):
    """Geometry of the joint between a cylinder's rod (`rod`) and a boom (`boom`); subclasses give the forces.

    ``gamma = phi + pi/2 - alpha - beta``, ``L = sqrt(a^2 + b^2 - 2 a b cos(gamma))``, ``h = a b sin(gamma)/L =
    dL/dphi``. `s_rel` is how far the rod stands ahead of the boom.

    Source: Eq. 17 and Fig. 10.
    """

    rod: translational.Flange = translational.Flange()
    boom: rotational.Flange = rotational.Flange()
    a: Parameter = Parameter(2.0, unit="m", min=0.0, doc="distance of the cylinder's foot from the boom joint")
    b: Parameter = Parameter(3.0, unit="m", min=0.0, doc="distance of the rod's eye from the boom joint")
    alpha: Parameter = Parameter(0.2, unit="rad", doc="angle of the foot from the vertical")
    beta: Parameter = Parameter(0.3, unit="rad", doc="angle of the eye from the boom's axis")
    L0: Parameter = Parameter(2.6, unit="m", min=0.0, doc="length of the cylinder with the piston retracted")
    gamma: Variable = Variable(unit="rad", start=PI / 2, doc="angle between the two attachments")
    L: Variable = Variable(unit="m", start=3.0, doc="distance of the two attachments")
    h: Variable = Variable(unit="m", start=1.0, doc="lever of the cylinder's force about the boom joint")
    s_rel: Variable = Variable(unit="m", doc="rod's position minus that of the boom's eye, s - (L - L0)")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.gamma == self.boom.phi + PI / 2 - self.alpha - self.beta
        yield self.L == sqrt(self.a**2 + self.b**2 - 2 * self.a * self.b * cos(self.gamma))
        yield self.h == self.a * self.b * sin(self.gamma) / self.L
        yield self.s_rel == self.rod.s - (self.L - self.L0)


class CylinderJoint(PartialCylinderJoint, partial=True):
    """Joint between a cylinder's rod and a boom; subclasses say what holds them together.

    The force `F` of the rod on the boom makes the torque ``F h``.

    Source: Eq. 17 and Fig. 10.
    """

    F: Variable = Variable(unit="N", nominal=1e5, doc="force of the rod on the boom, positive when it lifts")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.rod.f == self.F
        yield self.boom.tau == -self.F * self.h


class CompliantJoint(CylinderJoint):
    """Spring and damper between rod and boom, ``F = k s_rel + c (ds/dt - h dphi/dt)``.

    At the start the boom is at rest and the spring carries `F_start`.

    >>> model = assemble("eye.flange - joint.rod", "joint.boom - boom.flange", eye=translational.Fixed(s0=1.0),
    ...                  joint=CompliantJoint(k=1e6, c=1e5), boom=Boom(m=100.0, r=4.0, I=2000.0))
    >>> values = run(model, at=[0.0, 10.0])  # until it is at rest on the spring
    >>> close(values["joint.F"][-1] * values["joint.h"][-1], 100.0 * 9.81 * 4.0 * np.cos(values["boom.phi"][-1]))
    True

    Source: Eq. 16.
    """

    k: Parameter = Parameter(2e8, unit="N/m", min=0.0, doc="stiffness of the constraint")
    c: Parameter = Parameter(2e6, unit="N*s/m", min=0.0, doc="damping of the constraint")
    F_start: Parameter = Parameter(0.0, unit="N", doc="force of the spring at the start")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.F == self.k * self.s_rel + self.c * (der(self.rod.s) - self.h * der(self.boom.phi))

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.k * self.s_rel == self.F_start
        yield der(self.boom.phi) == 0


class RigidJoint(CylinderJoint):
    """Ideal joint between rod and boom, ``0 = s_rel``; the force is an unknown.

    The compiler finds the constraints on velocity and acceleration that follow (structural index 3).

    >>> model = assemble("eye.flange - joint.rod", "joint.boom - boom.flange", eye=translational.Fixed(s0=1.0),
    ...                  joint=RigidJoint(), boom=Boom(m=100.0, r=4.0, I=2000.0))
    >>> values = run(model)
    >>> close(values["joint.F"][-1] * values["joint.h"][-1], 100.0 * 9.81 * 4.0 * np.cos(values["boom.phi"][-1]))
    True

    Source: kinematics of Eq. 17 without the compliance of Eq. 16.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_rel == 0
