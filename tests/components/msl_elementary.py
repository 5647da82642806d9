"""Examples of Modelica.Mechanics.MultiBody.Examples.Elementary 4.0, from library components."""

from __future__ import annotations

from acausal import Component, Parameter, Vector, inner, vector
from acausal.components import blocks, multibody, rotational, thermal, translational
from acausal.components.examples import assemble, start


def hanging(x: float) -> multibody.Body:
    """A body at `x` that turns by two degrees per second about z."""
    return multibody.Body(
        m=1.0, r_CM=(0.0, -0.2, 0.0), I_11=0.1, I_22=0.1, I_33=0.1, r_0=start((x, -0.2, 0.0), fixed=True),
        v_0=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True, w_0_fixed=True,
        w_0_start=(0.0, 0.0, 0.03490658503988659),
    )  # fmt: skip


def wheel_set() -> multibody.RollingWheelSet:
    """A set of wheels at rest, off the origin."""
    rest = start(0.0, fixed=True)
    return multibody.RollingWheelSet(
        R_wheel=0.1, m_wheel=0.5, I_wheelAxis=0.01, I_wheelLong=0.02, track=0.5, x=start(0.1, fixed=True),
        y=start(0.1, fixed=True), phi=rest, theta1=rest, theta2=rest, der_theta1=rest, der_theta2=rest,
    )  # fmt: skip


def force_and_torque() -> Component:
    """MultiBody.Examples.Elementary.ForceAndTorque."""
    return assemble(
        "revolute2.frame_b - body.frame_a",
        "forceAndTorque.frame_b - body.frame_b",
        "fixed1.frame_b - revolute1.frame_a",
        "revolute1.frame_b - revolute2.frame_a",
        "fixed2.frame_b - forceAndTorque.frame_a",
        "fixedRotation.frame_a - fixed1.frame_b",
        "forceAndTorque.frame_resolve - fixedRotation.frame_b",
        "force1.y - forceAndTorque.force[0]",
        "force2.y - forceAndTorque.force[1]",
        "force3.y - forceAndTorque.force[2]",
        "torque1.y - forceAndTorque.torque[0]",
        "torque2.y - forceAndTorque.torque[1]",
        "torque3.y - forceAndTorque.torque[2]",
        world=inner(multibody.World()),
        body=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        fixed1=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        fixedRotation=multibody.FixedRotation(n=(0.0, 0.0, 1.0), angle=30.0),
        forceAndTorque=multibody.ForceAndTorque(resolveInFrame="frame_resolve"),
        revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torque1=blocks.Constant(k=-100.0),
        torque2=blocks.Constant(k=100.0),
        torque3=blocks.Constant(k=0.0),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixed2=multibody.Fixed(r=(1.5, 0.25, 0.0)),
        force1=blocks.Constant(k=0.0),
        force2=blocks.Constant(k=1000.0),
        force3=blocks.Constant(k=0.0),
    )


def pendulum_with_spring_damper() -> Component:
    """MultiBody.Examples.Elementary.PendulumWithSpringDamper."""
    return assemble(
        "world.frame_b - bar1.frame_a",
        "revolute.frame_a - bar1.frame_b",
        "prismatic.frame_a - revolute.frame_b",
        "damper1.frame_a - bar1.frame_b",
        "damper1.frame_b - prismatic.frame_b",
        "spring1.frame_a - bar1.frame_b",
        "spring1.frame_b - prismatic.frame_b",
        "body1.frame_a - prismatic.frame_b",
        world=inner(multibody.World()),
        body1=multibody.Body(m=1.0, I_11=1.0, I_22=1.0, I_33=1.0, r_CM=(0.0, 0.0, 0.0)),
        bar1=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        spring1=multibody.Spring(c=20.0, s_unstretched=0.2),
        damper1=multibody.Damper(d=1.0),
        revolute=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        prismatic=multibody.Prismatic(s=start(0.5, fixed=True), v=start(0.0, fixed=True)),
    )


def spring_damper_system() -> Component:
    """MultiBody.Examples.Elementary.SpringDamperSystem."""
    return assemble(
        "world.frame_b - bar1.frame_a",
        "bar1.frame_b - bar2.frame_a",
        "bar2.frame_b - p2.frame_a",
        "p2.frame_b - body2.frame_a",
        "bar2.frame_b - spring2.frame_a",
        "body2.frame_a - spring2.frame_b",
        "damper1.frame_a - bar1.frame_b",
        "spring1.frame_a - bar1.frame_b",
        "damper1.frame_b - body1.frame_a",
        "spring1.frame_b - body1.frame_a",
        world=inner(multibody.World()),
        body1=hanging(0.3),
        bar1=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        bar2=multibody.FixedTranslation(r=(0.6, 0.0, 0.0)),
        body2=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0)),
        p2=multibody.Prismatic(
            useAxisFlange=True,
            n=(0.0, -1.0, 0.0),
            stateSelect="always",
            v=start(0.0, fixed=True),
            s=start(0.1, fixed=True),
        ),
        spring2=multibody.Spring(c=30.0, s_unstretched=0.1),
        spring1=multibody.Spring(s_unstretched=0.1, c=30.0),
        damper1=multibody.Damper(d=2.0),
    )


def spring_with_mass() -> Component:
    """MultiBody.Examples.Elementary.SpringWithMass."""
    return assemble(
        "world.frame_b - spring.frame_a",
        "body.frame_a - spring.frame_b",
        world=inner(multibody.World()),
        spring=multibody.Spring(s_unstretched=0.2, m=0.5, c=40.0),
        body=multibody.Body(
            r_0=start((0.0, -0.3, 0.0), fixed=True),
            v_0=start((0.0, 0.0, 0.0), fixed=True),
            angles_fixed=True,
            w_0_fixed=True,
            r_CM=(0.0, 0.0, 0.0),
            m=1.0,
        ),
    )


def point_gravity_with_point_masses() -> Component:
    """MultiBody.Examples.Elementary.PointGravityWithPointMasses."""
    return assemble(
        "spring.frame_a - body3.frame_a",
        "spring.frame_b - body4.frame_a",
        world=inner(multibody.World(mu=1.0, gravityType="PointGravity")),
        body1=multibody.PointMass(
            m=1.0, r_0=start((0.0, 0.6, 0.0), fixed=True), v_0=start((1.0, 0.0, 0.0), fixed=True)
        ),
        body2=multibody.PointMass(
            m=1.0, r_0=start((0.6, 0.6, 0.0), fixed=True), v_0=start((0.6, 0.0, 0.0), fixed=True)
        ),
        body3=multibody.PointMass(
            m=1.0, r_0=start((0.0, 0.8, 0.0), fixed=True), v_0=start((0.6, 0.0, 0.0), fixed=True)
        ),
        body4=multibody.PointMass(
            m=1.0, r_0=start((0.3, 0.8, 0.0), fixed=True), v_0=start((0.6, 0.0, 0.0), fixed=True)
        ),
        spring=multibody.Spring(c=10.0, fixedRotationAtFrame_b=True, fixedRotationAtFrame_a=True),
    )


def heat_losses() -> Component:
    """MultiBody.Examples.Elementary.HeatLosses."""
    return assemble(
        "world.frame_b - bar1.frame_a",
        "bar1.frame_b - bar2.frame_a",
        "damper1.frame_a - bar1.frame_b",
        "spring1.frame_a - bar1.frame_b",
        "damper1.frame_b - body1.frame_a",
        "spring1.frame_b - body1.frame_a",
        "bar2.frame_b - springDamper.frame_a",
        "springDamper.frame_b - body2.frame_a",
        "bar3.frame_b - springDamperSeries.frame_a",
        "springDamperSeries.frame_b - body3.frame_a",
        "bar3.frame_a - bar2.frame_b",
        "bar3.frame_b - spring.frame_a",
        "spring.frame_b - body3.frame_a",
        "const.y - convection.Gc",
        "TAmbient.port - convection.fluid",
        "damper1.heatPort - convection.solid",
        "springDamper.heatPort - convection.solid",
        "springDamperSeries.heatPort - convection.solid",
        world=inner(multibody.World()),
        body1=hanging(0.3),
        bar1=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        bar2=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        spring1=multibody.Spring(s_unstretched=0.1, c=30.0),
        damper1=multibody.Damper(d=2.0, useHeatPort=True),
        springDamper=multibody.SpringDamperParallel(d=2.0, c=30.0, s_unstretched=0.1, useHeatPort=True),
        body2=hanging(0.6),
        bar3=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        springDamperSeries=multibody.SpringDamperSeries(d=2.0, c=30.0, s_unstretched=0.1, useHeatPort=True),
        body3=hanging(0.9),
        spring=multibody.Spring(s_unstretched=0.2, c=30.0),
        const=blocks.Constant(k=20.0),
        convection=thermal.Convection(),
        TAmbient=thermal.FixedTemperature(T=298.15),
    )


def line_force_with_two_masses() -> Component:
    """MultiBody.Examples.Elementary.LineForceWithTwoMasses."""
    return assemble(
        "jointUPS.bearing - damper1.flange_a",
        "jointUPS.axis - damper1.flange_b",
        "jointUPS.frame_ib - body2.frame_a",
        "world.frame_b - rod2.frame_a",
        "world.frame_b - rod1.frame_a",
        "rod2.frame_b - revolute1.frame_a",
        "revolute1.frame_b - bodyBox1.frame_a",
        "bodyBox1.frame_b - jointUPS.frame_b",
        "body1.frame_a - jointUPS.frame_ia",
        "rod1.frame_b - jointUPS.frame_a",
        "rod4.frame_b - revolute2.frame_a",
        "revolute2.frame_b - bodyBox2.frame_a",
        "world.frame_b - rod4.frame_a",
        "rod3.frame_a - rod4.frame_a",
        "lineForceWithTwoMasses.frame_a - rod3.frame_b",
        "lineForceWithTwoMasses.frame_b - bodyBox2.frame_b",
        "lineForceWithTwoMasses.flange_b - damper2.flange_b",
        "lineForceWithTwoMasses.flange_a - damper2.flange_a",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox1=multibody.BodyBox(r=(0.7, 0.0, 0.0)),
        rod1=multibody.FixedTranslation(r=(0.0, -0.9, 0.0)),
        jointUPS=multibody.JointUPS(nAxis_ia=(0.7, 1.2, 0.0)),
        body1=multibody.Body(r_CM=(0.10077420510481723, 0.17275578017968668, 0.0), m=1.0, I_11=0.0, I_22=0.0, I_33=0.0),
        body2=multibody.Body(
            r_CM=(-0.10077420510481723, -0.17275578017968668, 0.0), m=1.0, I_11=0.0, I_22=0.0, I_33=0.0
        ),
        rod2=multibody.FixedTranslation(r=(0.0, 0.3, 0.0)),
        damper1=translational.Damper(d=3.0),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox2=multibody.BodyBox(r=(0.7, 0.0, 0.0)),
        rod3=multibody.FixedTranslation(r=(0.0, -0.9, 0.3)),
        rod4=multibody.FixedTranslation(r=(0.0, 0.3, 0.3)),
        damper2=translational.Damper(d=3.0),
        lineForceWithTwoMasses=multibody.LineForceWithTwoMasses(L_a=0.2, L_b=0.2, m_a=1.0, m_b=1.0),
    )


def double_pendulum_init_tip() -> Component:
    """MultiBody.Examples.Elementary.DoublePendulumInitTip."""
    return assemble(
        "damper.flange_b - revolute1.axis",
        "revolute1.support - damper.flange_a",
        "revolute1.frame_b - boxBody1.frame_a",
        "revolute2.frame_b - boxBody2.frame_a",
        "boxBody1.frame_b - revolute2.frame_a",
        "world.frame_b - revolute1.frame_a",
        "world.frame_b - freeMotionScalarInit.frame_a",
        "freeMotionScalarInit.frame_b - boxBody2.frame_b",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(useAxisFlange=True),
        damper=rotational.Damper(d=0.1),
        boxBody1=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.06),
        revolute2=multibody.Revolute(phi=start(1.5707963267948966)),
        boxBody2=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.06),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_r=True,
            r_rel_a_1=start(0.7, fixed=True),
            r_rel_a_2=start(0.3, fixed=True),
            use_v=True,
            v_rel_a_1=start(0.0, fixed=True),
            v_rel_a_2=start(0.0, fixed=True),
        ),
    )


def rolling_wheel() -> Component:
    """MultiBody.Examples.Elementary.RollingWheel."""
    return assemble(
        wheel1=multibody.RollingWheel(
            radius=0.3, m=2.0, I_axis=0.06, I_long=0.12, x=start(0.2), y=start(0.2), der_angles=start((0.0, 5.0, 1.0))
        ),
        world=inner(multibody.World(n=(0.0, 0.0, -1.0))),
    )


def rolling_wheel_set_driving() -> Component:
    """MultiBody.Examples.Elementary.RollingWheelSetDriving."""
    return assemble(
        "fixedTranslation.frame_a - wheelSet.frameMiddle",
        "fixedTranslation.frame_b - body.frame_a",
        "wheelSet.axis1 - torque1.flange_a",
        "torque1.flange_b - wheelSet.support",
        "wheelSet.axis2 - torque2.flange_a",
        "wheelSet.support - torque2.flange_b",
        "sine1.y - torque1.tau",
        "sine2.y - torque2.tau",
        world=inner(multibody.World(n=(0.0, 0.0, -1.0))),
        wheelSet=wheel_set(),
        body=multibody.Body(m=0.01, r_CM=(0.0, 0.0, 0.0)),
        fixedTranslation=multibody.FixedTranslation(r=(0.2, 0.0, 0.0)),
        sine1=blocks.Sine(f=1.0, amplitude=2.0),
        sine2=blocks.Sine(f=1.0, amplitude=2.0, phase=1.5707963267949),
        torque1=rotational.Torque2(),
        torque2=rotational.Torque2(),
    )


PULLS = ((0.0, 1.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.0), (2.0, 0.0, 2.0, 0.0), (3.0, 0.0, 2.0, 0.0))


def rolling_wheel_set_pulling() -> Component:
    """MultiBody.Examples.Elementary.RollingWheelSetPulling."""
    return assemble(
        "x.y - force.force[0]",
        "y.y - force.force[1]",
        "z.y - force.force[2]",
        "fixedTranslation.frame_a - wheelSet.frameMiddle",
        "fixedTranslation.frame_b - body.frame_a",
        "force.frame_b - fixedTranslation.frame_b",
        force=multibody.WorldForce(),
        world=inner(multibody.World(n=(0.0, 0.0, -1.0))),
        wheelSet=wheel_set(),
        body=multibody.Body(m=0.01, r_CM=(0.0, 0.0, 0.0)),
        x=blocks.CombiTimeTable(table=PULLS, column=2),
        y=blocks.CombiTimeTable(table=PULLS, column=3),
        z=blocks.CombiTimeTable(table=PULLS, column=4),
        fixedTranslation=multibody.FixedTranslation(r=(0.2, 0.0, 0.0)),
    )


class NormalGravity(multibody.World):
    """Gravity of the WGS84 ellipsoid at the equator, along -y (Elementary.Utilities.theoreticalNormalGravityWGS84)."""

    a: Parameter = Parameter(6378137.0, unit="m")
    b: Parameter = Parameter(6356752.3142, unit="m")
    g_e: Parameter = Parameter(9.7803253359, unit="m/s2")
    GM: Parameter = Parameter(3986004.418e8, unit="m3/s2")
    w: Parameter = Parameter(7292115e-11, unit="rad/s")
    f: Parameter = Parameter(1 / 298.257223563, unit="1")

    def gravity(self, r: Vector) -> Vector:
        h, m = r[1] / self.a, self.w**2 * self.a**2 * self.b / self.GM
        g = self.g_e * (1 - h * (2 * (1 + self.f + m) + 3 * h))
        return vector(0.0 * g, -g, 0.0 * g)


def user_defined_gravity_field() -> Component:
    """MultiBody.Examples.Elementary.UserDefinedGravityField."""
    return assemble(
        "damper.flange_b - rev.axis",
        "rev.support - damper.flange_a",
        "body.frame_a - rev.frame_b",
        "world.frame_b - fixedTranslation.frame_a",
        "fixedTranslation.frame_b - rev.frame_a",
        world=inner(NormalGravity()),
        rev=multibody.Revolute(useAxisFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        damper=rotational.Damper(d=0.1),
        body=multibody.Body(r_CM=(10.0, 0.0, 0.0), m=1000.0),
        fixedTranslation=multibody.FixedTranslation(r=(0.0, 20.0, 0.0)),
    )
