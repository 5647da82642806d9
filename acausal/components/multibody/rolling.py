"""Wheels that roll without slip on the plane z = 0 of the world frame (gravity then is along its z axis)."""

from __future__ import annotations

from typing import ClassVar

from acausal import (
    Component,
    Equations,
    Parameter,
    Variable,
    Vector,
    connect,
    cross,
    defining,
    der,
    dot,
    root,
    structural,
    vector,
)

from .. import rotational
from .bodies import Body
from .drives import Mounting1D
from .frames import ZEROS, Frame, axes_rotations, resolve1, resolve2, unit_vector
from .joints import Prismatic, Revolute
from .parts import FixedTranslation
from .world import Fixed

UP = (0.0, 0.0, 1.0)


class RollingWheelJoint(Component):
    """Massless wheel that rolls on the plane z = 0; frame_a is at its centre, the y axis along the wheel's.

    `x`, `y` and `angles`, about the axes z, y, x one after the other, place it. The point of contact is the lowest one,
    where the velocity is zero: ``r_contact - r = radius e_long x e_axis``, ``v + w x (r_contact - r) = 0``; `f_n`,
    `f_lat` and `f_long` are the forces there. A wheel that lies flat is singular.

    >>> wheel = RollingWheelJoint(radius=0.5, angles=start((0.0, 0.0, 0.0), fixed=True), x=start(1.0, fixed=True),
    ...                           der_angles=start((0.0, 2.0, 0.0), fixed=True), y=start(0.0, fixed=True))
    >>> model = assemble("wheel.frame_a - body.frame_a", wheel=wheel, body=Body(m=3.0),
    ...                  world=ac.inner(World(g=10.0, n=(0.0, 0.0, -1.0))))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["wheel.x"], [2.0]), close(solution["wheel.f_n"], [30.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.RollingWheel.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a",)
    stateSelect: str = "always"
    frame_a: Frame = Frame()
    radius: Parameter = Parameter(0.3, unit="m", min=0.0, doc="radius of the wheel")
    x: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the centre along x")
    y: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the centre along y")
    z: Variable = Variable(unit="m", doc="height of the centre")
    angles: Vector = Vector(
        Variable(unit="rad", state_select=structural("stateSelect"), doc="angles about the axes z, y, x"), ZEROS
    )
    der_angles: Vector = Vector(
        Variable(unit="rad/s", state_select=structural("stateSelect"), doc="their derivatives"), ZEROS
    )
    delta_0: Vector = Vector(Variable(unit="m", doc="from the centre to the point of contact, in the world frame"))
    f_n: Variable = Variable(unit="N", doc="force on the wheel across the plane")
    f_lat: Variable = Variable(unit="N", doc="force on the wheel along its axis")
    f_long: Variable = Variable(unit="N", doc="force on the wheel in the direction it rolls")

    def equations(self) -> Equations:
        yield from super().equations()
        a, R, up = self.frame_a, self.frame_a.R, vector(*UP)
        yield root(R)
        yield a.r_0 == vector(self.x, self.y, self.z)
        yield self.der_angles == der(self.angles)
        turned = axes_rotations((3, 2, 1), self.angles, self.der_angles)
        yield defining(R.T == turned.T)
        yield R.w == turned.w
        axis = resolve1(R, vector(0.0, 1.0, 0.0))
        along = unit_vector(cross(up, axis))
        across = cross(along, up)
        yield self.delta_0 == cross(along, axis) * self.radius
        yield self.z == -self.delta_0[2]
        v_contact = der(a.r_0) + cross(resolve1(R, R.w), self.delta_0)
        yield dot(v_contact, along) == 0
        yield dot(v_contact, across) == 0
        f_0 = up * self.f_n + across * self.f_lat + along * self.f_long
        yield a.f == -resolve2(R, f_0)
        yield a.t == -resolve2(R, cross(self.delta_0, f_0))


class UprightWheel(Component):
    """Rolling of a wheel whose axis stays parallel to the plane z = 0, inside of a wheel set.

    Only one of two wheels on an axis can hold the track: `lateralSlidingConstraint` is false for the other.

    Source: Modelica.Mechanics.MultiBody.Joints.Internal.RollingConstraintVerticalWheel.
    """

    lateralSlidingConstraint: bool = True
    frame_a: Frame = Frame()
    radius: Parameter = Parameter(0.3, unit="m", min=0.0, doc="radius of the wheel")
    f_lat: Variable = Variable(unit="N", doc="force on the wheel along its axis")
    f_long: Variable = Variable(unit="N", doc="force on the wheel in the direction it rolls")

    def equations(self) -> Equations:
        yield from super().equations()
        a, R, up = self.frame_a, self.frame_a.R, vector(*UP)
        along = unit_vector(cross(up, resolve1(R, vector(0.0, 1.0, 0.0))))
        across, down = cross(along, up), up * -self.radius
        v_contact = der(a.r_0) + cross(resolve1(R, R.w), down)
        yield dot(v_contact, along) == 0
        yield (dot(v_contact, across) if self.lateralSlidingConstraint else self.f_lat) == 0
        f_0 = across * self.f_lat + along * self.f_long
        yield a.f == -resolve2(R, f_0)
        yield a.t == -resolve2(R, cross(down, f_0))


class PartialWheelSet(Component, partial=True):
    """Coordinates and connectors of two wheels on an axis.

    Source: the common part of Joints.RollingWheelSet and Parts.RollingWheelSet of Modelica.Mechanics.MultiBody.
    """

    stateSelect: str = "default"
    frameMiddle: Frame = Frame()
    frame1: Frame = Frame()
    frame2: Frame = Frame()
    axis1: rotational.Flange = rotational.Flange()
    axis2: rotational.Flange = rotational.Flange()
    support: rotational.Flange = rotational.Flange()
    x: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the middle along x")
    y: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the middle along y")
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of the axis about z")
    theta1: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of wheel 1")
    theta2: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of wheel 2")
    der_theta1: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="its derivative")
    der_theta2: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="its derivative")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.der_theta1 == der(self.theta1)
        yield self.der_theta2 == der(self.theta2)


class RollingWheelSetJoint(PartialWheelSet):
    """Two massless wheels on an axis that roll on the plane z = 0.

    frameMiddle is in the middle of the axis, with the y axis along it and x ahead; frame1 and frame2 turn with the
    wheels, half the `track` to its left and right. Wheel 1 holds the track for both. `axis1` and `axis2` drive them,
    against `support`, which is frameMiddle.

    >>> speed = start(5.0, fixed=True)
    >>> parts = dict(world=ac.inner(World(g=10.0, n=(0.0, 0.0, -1.0))), left=Body(m=1.0, I_22=0.02), body=Body(m=1.0),
    ...              right=Body(m=1.0, I_22=0.02),
    ...              wheels=RollingWheelSetJoint(radius=0.1, track=0.5, der_theta1=speed, der_theta2=speed))
    >>> model = assemble("wheels.frame1 - left.frame_a", "wheels.frame2 - right.frame_a",
    ...                  "wheels.frameMiddle - body.frame_a", **parts)
    >>> close(run(model, at=[2.0])["wheels.x"], [1.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.RollingWheelSet.
    """

    radius: Parameter = Parameter(0.3, unit="m", min=0.0, doc="radius of the wheels")
    track: Parameter = Parameter(1.0, unit="m", min=0.0, doc="distance of the wheels")
    height: Vector = Vector(Parameter(unit="m", doc="from the origin of the world to the axis"), vector(0, 0, radius))
    half: Vector = Vector(Parameter(unit="m", doc="from the middle to wheel 1"), vector(0, track / 2, 0))
    fixed: Fixed = Fixed(r=height)
    prismatic1: Prismatic = Prismatic(n=(1.0, 0.0, 0.0))
    prismatic2: Prismatic = Prismatic(n=(0.0, 1.0, 0.0))
    revolute: Revolute = Revolute()
    rod1: FixedTranslation = FixedTranslation(r=half)
    rod2: FixedTranslation = FixedTranslation(r=-half)
    revolute1: Revolute = Revolute(n=(0.0, 1.0, 0.0), useAxisFlange=True)
    revolute2: Revolute = Revolute(n=(0.0, 1.0, 0.0), useAxisFlange=True)
    rolling1: UprightWheel = UprightWheel(radius=radius)
    rolling2: UprightWheel = UprightWheel(radius=radius, lateralSlidingConstraint=False)
    mounting1D: Mounting1D = Mounting1D(n=(0.0, 1.0, 0.0))

    def equations(self) -> Equations:
        yield from super().equations()
        yield from (self.x == self.prismatic1.s, self.y == self.prismatic2.s, self.phi == self.revolute.phi)
        yield from (self.theta1 == self.revolute1.phi, self.theta2 == self.revolute2.phi)
        yield connect(self.fixed.frame_b, self.prismatic1.frame_a)
        yield connect(self.prismatic1.frame_b, self.prismatic2.frame_a)
        yield connect(self.prismatic2.frame_b, self.revolute.frame_a)
        yield connect(self.revolute.frame_b, self.frameMiddle, self.rod1.frame_a, self.rod2.frame_a)
        yield connect(self.frameMiddle, self.mounting1D.frame_a)
        yield connect(self.mounting1D.flange_b, self.support)
        yield connect(self.rod1.frame_b, self.revolute1.frame_a)
        yield connect(self.rod2.frame_b, self.revolute2.frame_a)
        yield connect(self.revolute1.frame_b, self.rolling1.frame_a, self.frame1)
        yield connect(self.revolute2.frame_b, self.rolling2.frame_a, self.frame2)
        yield connect(self.revolute1.axis, self.axis1)
        yield connect(self.revolute2.axis, self.axis2)


class RollingWheel(Component):
    """Wheel with mass that rolls on the plane z = 0: a `RollingWheelJoint` and a body.

    >>> model = assemble(world=ac.inner(World(g=10.0, n=(0.0, 0.0, -1.0))), wheel=RollingWheel(radius=0.5, m=3.0,
    ...                  I_axis=0.4, I_long=0.2, der_angles=start((0.0, 2.0, 0.0))))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["wheel.x"], [1.0]), close(solution["wheel.rollingWheel.f_n"], [30.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Parts.RollingWheel.
    """

    stateSelect: str = "always"
    frame_a: Frame = Frame()
    radius: Parameter = Parameter(0.3, unit="m", min=0.0, doc="radius of the wheel")
    m: Parameter = Parameter(2.0, unit="kg", min=0.0, doc="mass")
    I_axis: Parameter = Parameter(0.06, unit="kg*m2", min=0.0, doc="inertia about the axis")
    I_long: Parameter = Parameter(0.12, unit="kg*m2", min=0.0, doc="inertia about a line across it")
    x: Variable = Variable(
        unit="m", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="position of the centre along x"
    )
    y: Variable = Variable(
        unit="m", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="position of the centre along y"
    )
    angles: Vector = Vector(
        Variable(unit="rad", fixed=True, state_select=structural("stateSelect"), doc="angles about the axes z, y, x"),
        ZEROS,
    )
    der_angles: Vector = Vector(
        Variable(unit="rad/s", fixed=True, state_select=structural("stateSelect"), doc="their derivatives"), ZEROS
    )
    body: Body = Body(m=m, r_CM=ZEROS, I_11=I_long, I_22=I_axis, I_33=I_long)
    rollingWheel: RollingWheelJoint = RollingWheelJoint(radius=radius, stateSelect="avoid")

    def equations(self) -> Equations:
        yield from super().equations()
        joint = self.rollingWheel
        yield connect(joint.frame_a, self.body.frame_a, self.frame_a)
        yield from (self.x == joint.x, self.y == joint.y)
        yield self.angles == joint.angles
        yield self.der_angles == joint.der_angles


class RollingWheelSet(PartialWheelSet):
    """Two wheels with masses on an axis that roll on the plane z = 0: a `RollingWheelSetJoint` and two bodies.

    >>> parts = dict(world=ac.inner(World(g=10.0, n=(0.0, 0.0, -1.0))), body=Body(m=1.0), wheels=RollingWheelSet(
    ...              R_wheel=0.1, track=0.5, m_wheel=1.0, der_theta1=start(6.0), der_theta2=start(4.0)))
    >>> solution = run(assemble("wheels.frameMiddle - body.frame_a", **parts), at=[2.0])
    >>> close(solution["wheels.phi"], [-0.8])  # (4 - 6)*0.1/0.5 per second
    True

    Source: Modelica.Mechanics.MultiBody.Parts.RollingWheelSet.
    """

    stateSelect: str = "always"
    R_wheel: Parameter = Parameter(0.3, unit="m", min=0.0, doc="radius of the wheels")
    m_wheel: Parameter = Parameter(0.5, unit="kg", min=0.0, doc="mass of one wheel")
    I_wheelAxis: Parameter = Parameter(0.01, unit="kg*m2", min=0.0, doc="inertia of one wheel about its axis")
    I_wheelLong: Parameter = Parameter(0.02, unit="kg*m2", min=0.0, doc="inertia of one wheel about a line across it")
    track: Parameter = Parameter(1.0, unit="m", min=0.0, doc="distance of the wheels")
    x: Variable = Variable(
        unit="m", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="position of the middle along x"
    )
    y: Variable = Variable(
        unit="m", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="position of the middle along y"
    )
    phi: Variable = Variable(
        unit="rad", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="angle of the axis about z"
    )
    theta1: Variable = Variable(
        unit="rad", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="angle of wheel 1"
    )
    theta2: Variable = Variable(
        unit="rad", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="angle of wheel 2"
    )
    der_theta1: Variable = Variable(
        unit="rad/s", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="its derivative"
    )
    der_theta2: Variable = Variable(
        unit="rad/s", start=0.0, fixed=True, state_select=structural("stateSelect"), doc="its derivative"
    )
    body1: Body = Body(m=m_wheel, r_CM=ZEROS, I_11=I_wheelLong, I_22=I_wheelAxis, I_33=I_wheelLong)
    body2: Body = Body(m=m_wheel, r_CM=ZEROS, I_11=I_wheelLong, I_22=I_wheelAxis, I_33=I_wheelLong)
    wheelSetJoint: RollingWheelSetJoint = RollingWheelSetJoint(radius=R_wheel, track=track, stateSelect="avoid")

    def equations(self) -> Equations:
        yield from super().equations()
        joint = self.wheelSetJoint
        yield from (self.x == joint.x, self.y == joint.y, self.phi == joint.phi)
        yield from (self.theta1 == joint.theta1, self.theta2 == joint.theta2)
        yield connect(joint.frameMiddle, self.frameMiddle)
        yield connect(joint.frame1, self.body1.frame_a, self.frame1)
        yield connect(joint.frame2, self.body2.frame_a, self.frame2)
        yield connect(joint.axis1, self.axis1)
        yield connect(joint.axis2, self.axis2)
        yield connect(joint.support, self.support)
