"""Test models of ModelicaTest.MultiBody.Forces 4.0, from library components with their names."""

from __future__ import annotations

import math

from acausal import Component, inner
from acausal.components import blocks, multibody, thermal, translational
from acausal.components.examples import assemble, start

from .msl_mechanisms import GasForce


def damper() -> Component:
    """MultiBody.Forces.Damper."""
    return assemble(
        "prismatic.frame_b - body.frame_a - damper.frame_b - force.frame_b",
        "sine.y - force.force[0] - force1.force[0] - force2.force[0]",
        "const.y - force.force[1] - force.force[2] - force1.force[1] - force1.force[2] - force2.force[1]",
        "const.y - force2.force[2]",
        "world.frame_b - prismatic1.frame_a - damper1.frame_a - force1.frame_a - fixedTranslation.frame_a",
        "prismatic1.frame_b - body1.frame_a - damper1.frame_b - force1.frame_b",
        "heatCapacitor.port - damper1.heatPort",
        "prismatic2.frame_b - body2.frame_a - damper2.frame_b - force2.frame_b",
        "fixedTranslation1.frame_a - fixedTranslation.frame_b - prismatic.frame_a - damper.frame_a - force.frame_a",
        "fixedTranslation1.frame_b - force2.frame_a - damper2.frame_a - prismatic2.frame_a",
        world=inner(multibody.World()), damper=multibody.Damper(d=10.0),
        prismatic=multibody.Prismatic(useAxisFlange=False, s=start(0.5, fixed=True), v=start(-0.1, fixed=True),
            stateSelect="never"), force=multibody.Force(), body=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0)),
        sine=blocks.Sine(f=2.0, amplitude=50.0), const=blocks.Constant(k=0.0),
        damper1=multibody.Damper(d=10.0, useHeatPort=True),
        prismatic1=multibody.Prismatic(useAxisFlange=False, stateSelect="always", s=start(0.5, fixed=True),
            v=start(-0.1, fixed=True)), force1=multibody.Force(),
        body1=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0), useQuaternions=False, r_0=start((0.5, 0.0, 0.0)),
            v_0=start((-0.1, 0.0, 0.0)), angles_fixed=False, w_0_fixed=False),
        heatCapacitor=thermal.HeatCapacitor(C=100.0, T=start(293.15, fixed=True)),
        damper2=multibody.Damper(d=start(3.0, fixed=False)),
        prismatic2=multibody.Prismatic(useAxisFlange=False, s=start(0.5, fixed=True), v=start(-0.1, fixed=True),
            a=start(0.2, fixed=True)), force2=multibody.Force(), body2=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0)),
        fixedTranslation=multibody.FixedTranslation(r=(0.0, 0.1, 0.0)),
        fixedTranslation1=multibody.FixedTranslation(r=(0.0, 0.1, 0.0)),
    )  # fmt: skip


def damper2() -> Component:
    """MultiBody.Forces.Damper2."""
    return assemble(
        "prismatic.frame_b - body.frame_a - damper.frame_b - force.frame_b",
        "trapezoid.y - force.force[0] - force1.force[0] - force2.force[0]",
        "const.y - force.force[1] - force.force[2] - force1.force[1] - force1.force[2] - force2.force[1]",
        "const.y - force2.force[2]",
        "world.frame_b - prismatic1.frame_a - damper1.frame_a - force1.frame_a - fixedTranslation.frame_a",
        "prismatic1.frame_b - body1.frame_a - damper1.frame_b - force1.frame_b",
        "heatCapacitor.port - damper1.heatPort",
        "prismatic2.frame_b - body2.frame_a - damper2.frame_b - force2.frame_b",
        "fixedTranslation1.frame_a - fixedTranslation.frame_b - prismatic.frame_a - damper.frame_a - force.frame_a",
        "fixedTranslation1.frame_b - force2.frame_a - damper2.frame_a - prismatic2.frame_a",
        world=inner(multibody.World()), damper=multibody.Damper(d=310.0),
        prismatic=multibody.Prismatic(useAxisFlange=False, s=start(0.5, fixed=True), v=start(-0.1, fixed=True)),
        force=multibody.Force(), body=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0)),
        trapezoid=blocks.Trapezoid(amplitude=50.0, rising=0.1, width=0.15, falling=0.1, period=0.5, offset=-30.0),
        const=blocks.Constant(k=0.0), damper1=multibody.Damper(useHeatPort=True, d=310.0),
        prismatic1=multibody.Prismatic(useAxisFlange=False, s=start(0.5, fixed=True), v=start(-0.1, fixed=True)),
        force1=multibody.Force(), body1=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0)),
        heatCapacitor=thermal.HeatCapacitor(C=100.0, T=start(293.15, fixed=True)),
        damper2=multibody.Damper(d=start(3.0, fixed=False)),
        prismatic2=multibody.Prismatic(useAxisFlange=False, s=start(0.5, fixed=True), v=start(-0.1, fixed=True),
            a=start(0.2, fixed=True)), force2=multibody.Force(), body2=multibody.Body(m=5.0, r_CM=(0.0, 0.0, 0.0)),
        fixedTranslation=multibody.FixedTranslation(r=(0.0, 0.1, 0.0)),
        fixedTranslation1=multibody.FixedTranslation(r=(0.0, 0.1, 0.0)),
    )  # fmt: skip


def spring() -> Component:
    """MultiBody.Forces.Spring."""
    return assemble(
        "world.frame_b - fixedTranslation.frame_a - spring.frame_a - prismatic.frame_a",
        "fixedTranslation.frame_b - spring1.frame_a - prismatic1.frame_a",
        "body.frame_a - spring.frame_b - prismatic.frame_b", "body1.frame_a - spring1.frame_b - prismatic1.frame_b",
        world=inner(multibody.World()), fixedTranslation=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        spring=multibody.Spring(s_unstretched=0.1, c=10.0),
        spring1=multibody.Spring(s_unstretched=0.1, c=start(1.0, fixed=False)),
        body=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0)), body1=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0)),
        prismatic=multibody.Prismatic(v=start(0.0, fixed=True), n=(0.0, 1.0, 0.0), s=start(-1.0, fixed=True)),
        prismatic1=multibody.Prismatic(v=start(0.0, fixed=True), n=(0.0, 1.0, 0.0), s=start(-1.0, fixed=True),
            a=start(-0.81, fixed=True)),
    )  # fmt: skip


def spring2() -> Component:
    """MultiBody.Forces.Spring2."""
    return assemble(
        "world.frame_b - fixedTranslation.frame_a - spring.frame_a",
        "fixedTranslation.frame_b - spring1.frame_a - fixedTranslation1.frame_a", "body2.frame_a - spring2.frame_b",
        "fixedTranslation1.frame_b - spring2.frame_a", "body1.frame_a - spring.frame_b",
        "body.frame_a - spring1.frame_b",
        world=inner(multibody.World()), fixedTranslation=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        spring=multibody.Spring(s_unstretched=0.1, c=10.0), spring1=multibody.Spring(s_unstretched=0.1, c=10.0),
        body=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0), v_0=start((0.0, 0.0, 0.0), fixed=True),
            r_0=start((1.0, -1.0, -0.4), fixed=True), angles_fixed=True, w_0_fixed=True),
        body1=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0), v_0=start((1.0, 0.4, 0.5), fixed=True),
            r_0=start((-0.1, -0.2, -0.15), fixed=True), I_11=1.0, I_22=0.3, I_33=0.5, angles_fixed=True,
            w_0_fixed=True), spring2=multibody.Spring(s_unstretched=0.1, m=1.0, c=10.0),
        body2=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0), v_0=start((1.0, 0.4, 0.5), fixed=True),
            r_0=start((2.1, -0.2, -0.15), fixed=True), angles_fixed=True, w_0_fixed=True),
        fixedTranslation1=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
    )  # fmt: skip


def spring_damper_parallel() -> Component:
    """MultiBody.Forces.SpringDamperParallel."""
    return assemble(
        "world.frame_b - springDamperParallel.frame_a - universal.frame_a - fixedTranslation.frame_a",
        "pm1.frame_a - springDamperParallel.frame_b - prismatic.frame_b", "universal.frame_b - prismatic.frame_a",
        "fixedTranslation1.frame_a - fixedTranslation.frame_b - springDamperParallel1.frame_a - universal1.frame_a",
        "pm2.frame_a - springDamperParallel1.frame_b - prismatic1.frame_b", "universal1.frame_b - prismatic1.frame_a",
        "pm3.frame_a - springDamperParallel2.frame_b - prismatic2.frame_b",
        "springDamperParallel2.frame_a - universal2.frame_a - fixedTranslation1.frame_b",
        "universal2.frame_b - prismatic2.frame_a",
        world=inner(multibody.World()),
        springDamperParallel=multibody.SpringDamperParallel(s_unstretched=0.2, d=10.0, c=100.0),
        pm1=multibody.PointMass(m=5.0, v_0=start((0.1, 0.0, 0.0))),
        universal=multibody.Universal(phi_a=start(0.0, fixed=True), w_a=start(0.0, fixed=True),
            w_b=start(0.0, fixed=True), phi_b=start(math.pi / 4, fixed=True)),
        prismatic=multibody.Prismatic(s=start(0.1, fixed=True), v=start(0.1, fixed=True)),
        fixedTranslation=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        fixedTranslation1=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        springDamperParallel1=multibody.SpringDamperParallel(s_unstretched=0.2, d=10.0, c=start(3.0, fixed=False)),
        pm2=multibody.PointMass(m=5.0, stateSelect="default", r_0=start((1.0, 0.1, 0.1)), v_0=start((0.1, 0.0, 0.0))),
        universal1=multibody.Universal(phi_a=start(0.0, fixed=True), w_a=start(0.0, fixed=True),
            w_b=start(0.0, fixed=True), phi_b=start(math.pi / 4, fixed=True)),
        prismatic1=multibody.Prismatic(s=start(0.1, fixed=True), v=start(0.1, fixed=True), a=start(1.8, fixed=True)),
        springDamperParallel2=multibody.SpringDamperParallel(s_unstretched=0.2, d=start(2.0, fixed=False), c=100.0),
        pm3=multibody.PointMass(m=5.0, v_0=start((0.1, 0.0, 0.0)), stateSelect="always"),
        universal2=multibody.Universal(phi_a=start(0.0, fixed=True), w_a=start(0.0, fixed=True),
            w_b=start(0.0, fixed=True), phi_b=start(math.pi / 4, fixed=True)),
        prismatic2=multibody.Prismatic(s=start(0.1, fixed=True), v=start(0.1, fixed=True), a=start(1.8, fixed=True)),
    )  # fmt: skip


def spring_damper_series() -> Component:
    """MultiBody.Forces.SpringDamperSeries."""
    return assemble(
        "s1.frame_a - world.frame_b - sps1.frame_a - universal1.frame_a",
        "s1.frame_b - pointMass.frame_a - sps1.frame_b - prismatic1.frame_b", "universal1.frame_b - prismatic1.frame_a",
        world=inner(multibody.World()), sps1=multibody.SpringDamperSeries(c=10.0, s_unstretched=0.1, d=10.0),
        s1=multibody.Spring(c=10.0, s_unstretched=0.1), pointMass=multibody.PointMass(m=1.0),
        universal1=multibody.Universal(phi_a=start(0.0, fixed=True), w_a=start(0.0, fixed=True),
            w_b=start(0.0, fixed=True), phi_b=start(math.pi / 4, fixed=True)),
        prismatic1=multibody.Prismatic(s=start(0.1, fixed=True), v=start(0.1, fixed=True)),
    )  # fmt: skip


def differentiation_of_forces() -> Component:
    """MultiBody.Forces.DifferentiationOfForces."""
    return assemble(
        "world.frame_b - rev.frame_a", "body.frame_a - rev.frame_b", "cutForce.frame_b - body.frame_b",
        "cutForce.force[0] - der1_1.u", "cutForce.force[1] - der1_2.u", "cutForce.force[2] - der1_3.u",
        "der1_1.y - der2_1.u", "der1_2.y - der2_2.u", "der1_3.y - der2_3.u",
        "forceAndTorque.frame_b - cutForce.frame_a", "sine1_1.y - forceAndTorque.force[0]",
        "sine1_2.y - forceAndTorque.force[1]", "sine1_3.y - forceAndTorque.force[2]",
        "sine2_1.y - forceAndTorque.torque[0]", "sine2_2.y - forceAndTorque.torque[1]",
        "sine2_3.y - forceAndTorque.torque[2]",
        world=inner(multibody.World(gravityType="UniformGravity")),
        rev=multibody.Revolute(n=(0.0, 0.0, 1.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body=multibody.BodyBox(r=(1.0, 0.0, 0.0)), sine1_1=blocks.Sine(f=1.0), sine1_2=blocks.Sine(f=1.0),
        sine1_3=blocks.Sine(f=1.0), cutForce=multibody.CutForce(), der1_1=blocks.Der(), der1_2=blocks.Der(),
        der1_3=blocks.Der(), der2_1=blocks.Der(), der2_2=blocks.Der(), der2_3=blocks.Der(),
        forceAndTorque=multibody.WorldForceAndTorque(resolveInFrame="frame_b"), sine2_1=blocks.Sine(f=1.0),
        sine2_2=blocks.Sine(f=1.0), sine2_3=blocks.Sine(f=1.0),
    )  # fmt: skip


def force2() -> Component:
    """MultiBody.Forces.Force2."""
    return assemble(
        "force1.frame_b - body1.frame_b", "Revolute1.frame_b - body1.frame_a", "Revolute2.frame_b - body2.frame_a",
        "force2.frame_b - body2.frame_b", "Revolute3.frame_a - fixed1.frame_b", "Revolute3.frame_b - Revolute1.frame_a",
        "fixedRotation.frame_b - force2.frame_resolve", "fixed3.frame_b - Revolute4.frame_a - fixedRotation.frame_a",
        "Revolute4.frame_b - Revolute2.frame_a", "Constant1_1.y - force1.force[0]", "Constant1_2.y - force1.force[1]",
        "Constant1_3.y - force1.force[2]", "Constant2_1.y - force2.force[0]", "Constant2_2.y - force2.force[1]",
        "Constant2_3.y - force2.force[2]", "force1.frame_a - fixed2.frame_b", "fixed4.frame_b - force2.frame_a",
        "force3.frame_b - body3.frame_b", "Revolute5.frame_b - body3.frame_a", "Revolute6.frame_b - body4.frame_a",
        "force4.frame_b - body4.frame_b", "Revolute7.frame_a - fixed5.frame_b", "Revolute7.frame_b - Revolute5.frame_a",
        "fixedRotation1.frame_b - force4.frame_resolve", "fixed6.frame_b - Revolute8.frame_a - fixedRotation1.frame_a",
        "Revolute8.frame_b - Revolute6.frame_a", "force3.frame_a - fixed7.frame_b", "fixed8.frame_b - force4.frame_a",
        "Constant3_1.y - force3.force[0]", "Constant3_2.y - force3.force[1]", "Constant3_3.y - force3.force[2]",
        "Constant3_4.y - force3.torque[0]", "Constant3_5.y - force3.torque[1]", "Constant3_6.y - force3.torque[2]",
        "Constant4_1.y - force4.force[0]", "Constant4_2.y - force4.force[1]", "Constant4_3.y - force4.force[2]",
        "Constant4_4.y - force4.torque[0]", "Constant4_5.y - force4.torque[1]", "Constant4_6.y - force4.torque[2]",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=0.0),
        Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0),
        fixed1=multibody.Fixed(r=(0.0, 0.5, 0.0)), body2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        fixed3=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        fixedRotation=multibody.FixedRotation(n=(0.0, 0.0, 1.0), angle=45.0),
        force1=multibody.Force(resolveInFrame="frame_b"), force2=multibody.Force(resolveInFrame="frame_resolve"),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant2_1=blocks.Constant(k=0.0), Constant2_2=blocks.Constant(k=500.0), Constant2_3=blocks.Constant(k=0.0),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute4=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixed2=multibody.Fixed(r=(1.5, 0.25, 0.0)), fixed4=multibody.Fixed(r=(1.5, -0.25, 0.0)),
        Revolute5=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant3_1=blocks.Constant(k=0.0),
        Constant3_2=blocks.Constant(k=500.0), Constant3_3=blocks.Constant(k=0.0), Constant3_4=blocks.Constant(k=0.0),
        Constant3_5=blocks.Constant(k=0.0), Constant3_6=blocks.Constant(k=0.0),
        fixed5=multibody.Fixed(r=(0.0, 0.5, 0.0)), body4=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        fixed6=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        fixedRotation1=multibody.FixedRotation(n=(0.0, 0.0, 1.0), angle=45.0), force3=multibody.ForceAndTorque(),
        force4=multibody.ForceAndTorque(resolveInFrame="frame_resolve"),
        Revolute6=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant4_1=blocks.Constant(k=0.0), Constant4_2=blocks.Constant(k=500.0), Constant4_3=blocks.Constant(k=0.0),
        Constant4_4=blocks.Constant(k=0.0), Constant4_5=blocks.Constant(k=0.0), Constant4_6=blocks.Constant(k=0.0),
        Revolute7=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute8=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixed7=multibody.Fixed(r=(1.5, 0.25, 0.0)), fixed8=multibody.Fixed(r=(1.5, -0.25, 0.0)),
    )  # fmt: skip


def force_with_two_masses2() -> Component:
    """MultiBody.Forces.ForceWithTwoMasses2."""
    return assemble(
        "jointUPS.bearing - damper1.flange_a", "jointUPS.axis - damper1.flange_b", "jointUPS.frame_ib - body2.frame_a",
        "world.frame_b - rod2.frame_a - rod1.frame_a - rod4.frame_a - rod3.frame_a", "rod2.frame_b - revolute1.frame_a",
        "revolute1.frame_b - bodyBox1.frame_a", "bodyBox1.frame_b - jointUPS.frame_b",
        "body1.frame_a - jointUPS.frame_ia", "rod1.frame_b - jointUPS.frame_a", "rod4.frame_b - revolute2.frame_a",
        "revolute2.frame_b - bodyBox2.frame_a", "lineForceWithTwoMasses.frame_a - rod3.frame_b",
        "lineForceWithTwoMasses.frame_b - bodyBox2.frame_b", "lineForceWithTwoMasses.flange_b - damper2.flange_b",
        "lineForceWithTwoMasses.flange_a - damper2.flange_a",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox1=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod1=multibody.FixedTranslation(r=(0.0, -0.9, 0.0)),
        jointUPS=multibody.JointUPS(nAxis_ia=(0.7, 1.2, 0.0)),
        body1=multibody.Body(r_CM=(0.100774205105, 0.17275578018, 0.0), m=2.0, I_11=0.0, I_22=0.0, I_33=0.0),
        body2=multibody.Body(r_CM=(-0.100774205105, -0.17275578018, -0.0), m=2.0, I_11=0.0, I_22=0.0, I_33=0.0),
        rod2=multibody.FixedTranslation(r=(0.0, 0.3, 0.0)), damper1=translational.Damper(d=3.0),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox2=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod3=multibody.FixedTranslation(r=(0.0, -0.9, 0.3)),
        rod4=multibody.FixedTranslation(r=(0.0, 0.3, 0.3)), damper2=translational.Damper(d=3.0),
        lineForceWithTwoMasses=multibody.LineForceWithTwoMasses(L_a=0.2, L_b=0.2, m_a=2.0, m_b=2.0),
    )  # fmt: skip


def frame_forces2() -> Component:
    """MultiBody.Forces.FrameForces2."""
    return assemble(
        "BodyCylinder1.frame_a - Revolute1.frame_b", "fixed1.frame_b - Revolute1.frame_a",
        "frameForce1.frame_b - BodyCylinder1.frame_b", "Constant1_1.y - frameForce1.force[0] - frameForce2.force[0]",
        "Constant1_2.y - frameForce1.force[1] - frameForce2.force[1]",
        "Constant1_3.y - frameForce1.force[2] - frameForce2.force[2]", "BodyCylinder2.frame_a - Revolute2.frame_b",
        "fixed2.frame_b - Revolute2.frame_a", "frameForce2.frame_b - BodyCylinder2.frame_b - frameForce2.frame_resolve",
        "BodyCylinder3.frame_a - Revolute3.frame_b", "frameForce3.frame_b - BodyCylinder3.frame_b",
        "Constant2_1.y - frameForce3.force[0] - frameForce4.force[0]",
        "Constant2_2.y - frameForce3.force[1] - frameForce4.force[1]",
        "Constant2_3.y - frameForce3.force[2] - frameForce4.force[2]", "BodyCylinder4.frame_a - Revolute4.frame_b",
        "frameForce4.frame_b - BodyCylinder4.frame_b",
        "world.frame_b - Revolute3.frame_a - frameForce4.frame_resolve - Revolute4.frame_a",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True), useAxisFlange=False),
        BodyCylinder1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=0.0),
        Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0),
        fixed1=multibody.Fixed(r=(0.0, 0.5, 0.0)), frameForce1=multibody.WorldForce(resolveInFrame="frame_b"),
        Revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), fixed2=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        frameForce2=multibody.WorldForce(resolveInFrame="frame_resolve"),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True), useAxisFlange=False),
        BodyCylinder3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant2_1=blocks.Constant(k=0.0),
        Constant2_2=blocks.Constant(k=500.0), Constant2_3=blocks.Constant(k=0.0),
        frameForce3=multibody.WorldForce(resolveInFrame="world"),
        Revolute4=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder4=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        frameForce4=multibody.WorldForce(resolveInFrame="frame_resolve"),
    )  # fmt: skip


def frame_forces_and_torques2() -> Component:
    """MultiBody.Forces.FrameForcesAndTorques2."""
    return assemble(
        "frameTorque1.frame_b - body1.frame_b", "Revolute1.frame_b - body1.frame_a",
        "Revolute2.frame_b - body2.frame_a", "frameTorque2.frame_b - body2.frame_b - frameTorque2.frame_resolve",
        "Revolute3.frame_a - fixed1.frame_b", "Revolute3.frame_b - Revolute1.frame_a",
        "fixed2.frame_b - Revolute4.frame_a", "Revolute4.frame_b - Revolute2.frame_a",
        "Constant1_1.y - frameTorque1.force[0]", "Constant1_2.y - frameTorque1.force[1]",
        "Constant1_3.y - frameTorque1.force[2]", "Constant1_4.y - frameTorque1.torque[0]",
        "Constant1_5.y - frameTorque1.torque[1]", "Constant1_6.y - frameTorque1.torque[2]",
        "Constant2_1.y - frameTorque2.force[0]", "Constant2_2.y - frameTorque2.force[1]",
        "Constant2_3.y - frameTorque2.force[2]", "Constant2_4.y - frameTorque2.torque[0]",
        "Constant2_5.y - frameTorque2.torque[1]", "Constant2_6.y - frameTorque2.torque[2]",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=0.0),
        Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0), Constant1_4=blocks.Constant(k=-100.0),
        Constant1_5=blocks.Constant(k=100.0), Constant1_6=blocks.Constant(k=0.0),
        fixed1=multibody.Fixed(r=(0.0, 0.5, 0.0)), body2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        fixed2=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        frameTorque1=multibody.WorldForceAndTorque(resolveInFrame="frame_b"),
        frameTorque2=multibody.WorldForceAndTorque(resolveInFrame="frame_resolve"),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant2_1=blocks.Constant(k=0.0), Constant2_2=blocks.Constant(k=500.0), Constant2_3=blocks.Constant(k=0.0),
        Constant2_4=blocks.Constant(k=-100.0), Constant2_5=blocks.Constant(k=100.0), Constant2_6=blocks.Constant(k=0.0),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute4=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip


def frame_forces_and_torques3() -> Component:
    """MultiBody.Forces.FrameForcesAndTorques3."""
    return assemble(
        "frameTorque1.frame_b - body1.frame_b", "Revolute1.frame_b - body1.frame_a",
        "Revolute2.frame_b - body2.frame_a", "frameTorque2.frame_b - body2.frame_b",
        "Revolute3.frame_b - Revolute1.frame_a", "Revolute4.frame_b - Revolute2.frame_a",
        "Constant1_1.y - frameTorque1.force[0]", "Constant1_2.y - frameTorque1.force[1]",
        "Constant1_3.y - frameTorque1.force[2]", "Constant1_4.y - frameTorque1.torque[0]",
        "Constant1_5.y - frameTorque1.torque[1]", "Constant1_6.y - frameTorque1.torque[2]",
        "Constant2_1.y - frameTorque2.force[0]", "Constant2_2.y - frameTorque2.force[1]",
        "Constant2_3.y - frameTorque2.force[2]", "Constant2_4.y - frameTorque2.torque[0]",
        "Constant2_5.y - frameTorque2.torque[1]", "Constant2_6.y - frameTorque2.torque[2]",
        "world.frame_b - Revolute3.frame_a - fixedTranslation.frame_a",
        "fixedTranslation.frame_b - Revolute4.frame_a - frameTorque2.frame_resolve",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=0.0),
        Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0), Constant1_4=blocks.Constant(k=-100.0),
        Constant1_5=blocks.Constant(k=100.0), Constant1_6=blocks.Constant(k=0.0),
        body2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        frameTorque1=multibody.WorldForceAndTorque(resolveInFrame="world"),
        frameTorque2=multibody.WorldForceAndTorque(resolveInFrame="frame_resolve"),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant2_1=blocks.Constant(k=0.0), Constant2_2=blocks.Constant(k=500.0), Constant2_3=blocks.Constant(k=0.0),
        Constant2_4=blocks.Constant(k=-100.0), Constant2_5=blocks.Constant(k=100.0), Constant2_6=blocks.Constant(k=0.0),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute4=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixedTranslation=multibody.FixedTranslation(r=(0.0, 0.0, 1.0)),
    )  # fmt: skip


def line_force_with_mass() -> Component:
    """MultiBody.Forces.LineForceWithMass."""
    return assemble(
        "jointUPS.bearing - damper1.flange_a", "jointUPS.axis - damper1.flange_b",
        "world.frame_b - rod2.frame_a - rod1.frame_a - rod4.frame_a - rod3.frame_a", "rod2.frame_b - revolute1.frame_a",
        "revolute1.frame_b - bodyBox1.frame_a", "bodyBox1.frame_b - jointUPS.frame_b",
        "rod1.frame_b - jointUPS.frame_a", "rod4.frame_b - revolute2.frame_a", "revolute2.frame_b - bodyBox2.frame_a",
        "damper2.flange_a - lineForceWithMass.flange_a", "damper2.flange_b - lineForceWithMass.flange_b",
        "rod3.frame_b - lineForceWithMass.frame_a", "lineForceWithMass.frame_b - bodyBox2.frame_b",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox1=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod1=multibody.FixedTranslation(r=(0.0, -0.9, 0.0)),
        jointUPS=multibody.JointUPS(nAxis_ia=(0.7, 1.2, 0.0)), rod2=multibody.FixedTranslation(r=(0.0, 0.3, 0.0)),
        damper1=translational.Damper(d=3.0),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox2=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod3=multibody.FixedTranslation(r=(0.0, -0.9, 0.3)),
        rod4=multibody.FixedTranslation(r=(0.0, 0.3, 0.3)), damper2=translational.Damper(d=3.0),
        lineForceWithMass=multibody.LineForceWithMass(m=0.0),
    )  # fmt: skip


def line_force_with_two_masses() -> Component:
    """MultiBody.Forces.LineForceWithTwoMasses."""
    return assemble(
        "jointUPS.bearing - damper1.flange_a", "jointUPS.axis - damper1.flange_b", "jointUPS.frame_ib - body2.frame_a",
        "world.frame_b - rod2.frame_a - rod1.frame_a - rod4.frame_a - rod3.frame_a", "rod2.frame_b - revolute1.frame_a",
        "revolute1.frame_b - bodyBox1.frame_a", "bodyBox1.frame_b - jointUPS.frame_b",
        "body1.frame_a - jointUPS.frame_ia", "rod1.frame_b - jointUPS.frame_a", "rod4.frame_b - revolute2.frame_a",
        "revolute2.frame_b - bodyBox2.frame_a", "lineForceWithTwoMasses.frame_a - rod3.frame_b",
        "lineForceWithTwoMasses.frame_b - bodyBox2.frame_b", "lineForceWithTwoMasses.flange_b - damper2.flange_b",
        "lineForceWithTwoMasses.flange_a - damper2.flange_a",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox1=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod1=multibody.FixedTranslation(r=(0.0, -0.9, 0.0)),
        jointUPS=multibody.JointUPS(nAxis_ia=(0.7, 1.2, 0.0)),
        body1=multibody.Body(r_CM=(0.100774205105, 0.17275578018, 0.0), m=1.0, I_11=0.0, I_22=0.0, I_33=0.0),
        body2=multibody.Body(r_CM=(-0.100774205105, -0.17275578018, -0.0), m=1.0, I_11=0.0, I_22=0.0, I_33=0.0),
        rod2=multibody.FixedTranslation(r=(0.0, 0.3, 0.0)), damper1=translational.Damper(d=3.0),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox2=multibody.BodyBox(r=(0.7, 0.0, 0.0)), rod3=multibody.FixedTranslation(r=(0.0, -0.9, 0.3)),
        rod4=multibody.FixedTranslation(r=(0.0, 0.3, 0.3)), damper2=translational.Damper(d=3.0),
        lineForceWithTwoMasses=multibody.LineForceWithTwoMasses(L_a=0.2, L_b=0.2, m_a=1.0, m_b=1.0),
    )  # fmt: skip


def torque3() -> Component:
    """MultiBody.Forces.Torque3."""
    return assemble(
        "torque1.frame_b - body1.frame_b", "Revolute1.frame_b - body1.frame_a", "Revolute2.frame_b - body2.frame_a",
        "torque2.frame_b - body2.frame_b - torque2.frame_resolve", "Revolute3.frame_a - fixed1.frame_b",
        "Revolute3.frame_b - Revolute1.frame_a", "fixed3.frame_b - Revolute4.frame_a",
        "Revolute4.frame_b - Revolute2.frame_a", "Constant1_1.y - torque1.torque[0]",
        "Constant1_2.y - torque1.torque[1]", "Constant1_3.y - torque1.torque[2]", "Constant2_1.y - torque2.torque[0]",
        "Constant2_2.y - torque2.torque[1]", "Constant2_3.y - torque2.torque[2]", "torque1.frame_a - fixed2.frame_b",
        "fixed4.frame_b - torque2.frame_a", "torque3.frame_b - body3.frame_b", "Revolute5.frame_b - body3.frame_a",
        "Revolute6.frame_b - body4.frame_a", "torque4.frame_b - body4.frame_b", "Revolute7.frame_b - Revolute5.frame_a",
        "Revolute8.frame_b - Revolute6.frame_a", "torque3.frame_a - fixed7.frame_b", "fixed8.frame_b - torque4.frame_a",
        "Constant3_1.y - torque3.force[0]", "Constant3_2.y - torque3.force[1]", "Constant3_3.y - torque3.force[2]",
        "Constant3_4.y - torque3.torque[0]", "Constant3_5.y - torque3.torque[1]", "Constant3_6.y - torque3.torque[2]",
        "Constant4_1.y - torque4.force[0]", "Constant4_2.y - torque4.force[1]", "Constant4_3.y - torque4.force[2]",
        "Constant4_4.y - torque4.torque[0]", "Constant4_5.y - torque4.torque[1]", "Constant4_6.y - torque4.torque[2]",
        "world.frame_b - Revolute7.frame_a - Revolute8.frame_a - torque4.frame_resolve",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=-100.0),
        Constant1_2=blocks.Constant(k=100.0), Constant1_3=blocks.Constant(k=0.0),
        fixed1=multibody.Fixed(r=(0.0, 0.5, 0.0)), body2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        fixed3=multibody.Fixed(r=(0.0, -0.5, 0.0)), torque1=multibody.Torque(resolveInFrame="frame_b"),
        torque2=multibody.Torque(resolveInFrame="frame_resolve"),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant2_1=blocks.Constant(k=-100.0), Constant2_2=blocks.Constant(k=100.0), Constant2_3=blocks.Constant(k=0.0),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute4=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixed2=multibody.Fixed(r=(1.5, 0.25, 0.0)), fixed4=multibody.Fixed(r=(1.5, -0.25, 0.0)),
        Revolute5=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        body3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant3_1=blocks.Constant(k=0.0),
        Constant3_2=blocks.Constant(k=0.0), Constant3_3=blocks.Constant(k=0.0), Constant3_4=blocks.Constant(k=-100.0),
        Constant3_5=blocks.Constant(k=100.0), Constant3_6=blocks.Constant(k=0.0),
        body4=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), torque3=multibody.ForceAndTorque(resolveInFrame="world"),
        torque4=multibody.ForceAndTorque(resolveInFrame="frame_resolve"),
        Revolute6=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Constant4_1=blocks.Constant(k=0.0), Constant4_2=blocks.Constant(k=0.0), Constant4_3=blocks.Constant(k=0.0),
        Constant4_4=blocks.Constant(k=-100.0), Constant4_5=blocks.Constant(k=100.0), Constant4_6=blocks.Constant(k=0.0),
        Revolute7=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        Revolute8=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixed7=multibody.Fixed(r=(1.5, 0.25, 0.0)), fixed8=multibody.Fixed(r=(1.5, -0.25, 0.0)),
    )  # fmt: skip


def world_forces() -> Component:
    """MultiBody.Forces.WorldForces."""
    return assemble(
        "BodyCylinder1.frame_a - Revolute1.frame_b", "worldForce.frame_b - BodyCylinder1.frame_b",
        "fixed2.frame_b - Revolute2.frame_a", "BodyCylinder2.frame_a - Revolute2.frame_b",
        "worldTorque1.frame_b - BodyCylinder2.frame_b", "fixed1.frame_b - Revolute1.frame_a",
        "fixed3.frame_b - Revolute3.frame_a", "Revolute3.frame_b - Revolute4.frame_a",
        "Revolute4.frame_b - BodyCylinder3.frame_a", "Constant1_1.y - worldForce.force[0]",
        "Constant1_2.y - worldForce.force[1]", "Constant1_3.y - worldForce.force[2]",
        "Constant2_1.y - worldTorque1.torque[0]", "Constant2_2.y - worldTorque1.torque[1]",
        "Constant2_3.y - worldTorque1.torque[2]", "forceAndTorque.frame_b - BodyCylinder3.frame_b",
        "Constant4_1.y - forceAndTorque.force[0]", "Constant4_2.y - forceAndTorque.force[1]",
        "Constant4_3.y - forceAndTorque.force[2]", "Constant4_4.y - forceAndTorque.torque[0]",
        "Constant4_5.y - forceAndTorque.torque[1]", "Constant4_6.y - forceAndTorque.torque[2]",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), worldForce=multibody.WorldForce(),
        Constant1_1=blocks.Constant(k=0.0), Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0),
        fixed2=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), worldTorque1=multibody.WorldTorque(),
        Constant2_1=blocks.Constant(k=100.0), Constant2_2=blocks.Constant(k=100.0),
        Constant2_3=blocks.Constant(k=100.0), fixed1=multibody.Fixed(r=(0.0, 0.5, 0.0)),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant4_1=blocks.Constant(k=0.0),
        Constant4_2=blocks.Constant(k=500.0), Constant4_3=blocks.Constant(k=0.0), Constant4_4=blocks.Constant(k=100.0),
        Constant4_5=blocks.Constant(k=100.0), Constant4_6=blocks.Constant(k=100.0),
        fixed3=multibody.Fixed(r=(0.0, -1.0, 0.0)),
        Revolute4=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        forceAndTorque=multibody.WorldForceAndTorque(resolveInFrame="world"),
    )  # fmt: skip


def world_force_and_torque() -> Component:
    """MultiBody.Forces.WorldForceAndTorque."""
    return assemble(
        "fixed3.frame_b - Revolute3.frame_a", "Revolute3.frame_b - Revolute4.frame_a",
        "Revolute4.frame_b - BodyCylinder3.frame_a", "forceAndTorque.frame_b - BodyCylinder3.frame_b",
        "Constant4_1.y - forceAndTorque.force[0]", "Constant4_2.y - forceAndTorque.force[1]",
        "Constant4_3.y - forceAndTorque.force[2]", "Constant4_4.y - forceAndTorque.torque[0]",
        "Constant4_5.y - forceAndTorque.torque[1]", "Constant4_6.y - forceAndTorque.torque[2]",
        "fixed1.frame_b - Revolute1.frame_a", "Revolute1.frame_b - Revolute2.frame_a",
        "Revolute2.frame_b - BodyCylinder1.frame_a", "forceAndTorque1.frame_b - BodyCylinder1.frame_b",
        "world.frame_b - forceAndTorque1.frame_resolve", "Constant1_1.y - forceAndTorque1.force[0]",
        "Constant1_2.y - forceAndTorque1.force[1]", "Constant1_3.y - forceAndTorque1.force[2]",
        "Constant1_4.y - forceAndTorque1.torque[0]", "Constant1_5.y - forceAndTorque1.torque[1]",
        "Constant1_6.y - forceAndTorque1.torque[2]", "fixed2.frame_b - Revolute5.frame_a",
        "Revolute5.frame_b - Revolute6.frame_a", "Revolute6.frame_b - BodyCylinder2.frame_a",
        "forceAndTorque2.frame_b - BodyCylinder2.frame_b", "Constant2_1.y - forceAndTorque2.force[0]",
        "Constant2_2.y - forceAndTorque2.force[1]", "Constant2_3.y - forceAndTorque2.force[2]",
        "Constant2_4.y - forceAndTorque2.torque[0]", "Constant2_5.y - forceAndTorque2.torque[1]",
        "Constant2_6.y - forceAndTorque2.torque[2]",
        world=inner(multibody.World()),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant4_1=blocks.Constant(k=0.0),
        Constant4_2=blocks.Constant(k=500.0), Constant4_3=blocks.Constant(k=0.0), Constant4_4=blocks.Constant(k=100.0),
        Constant4_5=blocks.Constant(k=100.0), Constant4_6=blocks.Constant(k=100.0),
        fixed3=multibody.Fixed(r=(0.0, -1.0, 0.0)),
        Revolute4=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        forceAndTorque=multibody.WorldForceAndTorque(resolveInFrame="world"),
        Revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant1_1=blocks.Constant(k=0.0),
        Constant1_2=blocks.Constant(k=500.0), Constant1_3=blocks.Constant(k=0.0), Constant1_4=blocks.Constant(k=100.0),
        Constant1_5=blocks.Constant(k=100.0), Constant1_6=blocks.Constant(k=100.0),
        fixed1=multibody.Fixed(r=(0.0, -1.0, 0.0)),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        forceAndTorque1=multibody.WorldForceAndTorque(resolveInFrame="frame_resolve"),
        Revolute5=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), Constant2_1=blocks.Constant(k=0.0),
        Constant2_2=blocks.Constant(k=500.0), Constant2_3=blocks.Constant(k=0.0), Constant2_4=blocks.Constant(k=100.0),
        Constant2_5=blocks.Constant(k=100.0), Constant2_6=blocks.Constant(k=100.0),
        fixed2=multibody.Fixed(r=(0.0, -1.0, 0.0)),
        Revolute6=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        forceAndTorque2=multibody.WorldForceAndTorque(resolveInFrame="frame_b"),
    )  # fmt: skip


def world_torques() -> Component:
    """MultiBody.Forces.WorldTorques."""
    return assemble(
        "fixed2.frame_b - Revolute2.frame_a", "BodyCylinder2.frame_a - Revolute2.frame_b",
        "worldTorque1.frame_b - BodyCylinder2.frame_b", "Constant2_1.y - worldTorque1.torque[0]",
        "Constant2_2.y - worldTorque1.torque[1]", "Constant2_3.y - worldTorque1.torque[2]",
        "fixed1.frame_b - Revolute1.frame_a", "BodyCylinder1.frame_a - Revolute1.frame_b",
        "worldTorque2.frame_b - BodyCylinder1.frame_b", "Constant1_1.y - worldTorque2.torque[0]",
        "Constant1_2.y - worldTorque2.torque[1]", "Constant1_3.y - worldTorque2.torque[2]",
        "world.frame_b - worldTorque2.frame_resolve", "BodyCylinder3.frame_a - Revolute3.frame_b",
        "fixed3.frame_b - Revolute3.frame_a", "worldTorque3.frame_b - BodyCylinder3.frame_b",
        "sine_1.y - worldTorque3.torque[0]", "sine_2.y - worldTorque3.torque[1]", "sine_3.y - worldTorque3.torque[2]",
        world=inner(multibody.World()), fixed2=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        Revolute2=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), worldTorque1=multibody.WorldTorque(),
        Constant2_1=blocks.Constant(k=100.0), Constant2_2=blocks.Constant(k=100.0),
        Constant2_3=blocks.Constant(k=100.0), fixed1=multibody.Fixed(r=(0.0, -0.5, 0.0)),
        Revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        BodyCylinder1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        worldTorque2=multibody.WorldTorque(resolveInFrame="frame_resolve"), Constant1_1=blocks.Constant(k=100.0),
        Constant1_2=blocks.Constant(k=100.0), Constant1_3=blocks.Constant(k=100.0),
        Revolute3=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True), n=(0.0, 1.0, 0.0)),
        BodyCylinder3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)), fixed3=multibody.Fixed(r=(0.0, 0.5, 0.0)),
        sine_1=blocks.Sine(amplitude=100.0, f=5.0), sine_2=blocks.Sine(amplitude=100.0, f=5.0),
        sine_3=blocks.Sine(amplitude=100.0, f=5.0), worldTorque3=multibody.WorldTorque(resolveInFrame="frame_b"),
    )  # fmt: skip


def engine_gas_force() -> Component:
    """MultiBody.Forces.EngineGasForce."""
    return assemble(
        "sine.y - position.s_ref", "gasForce.flange_b - mass.flange_a", "gasForce.flange_a - fixed.flange",
        "position.flange - mass.flange_b",
        fixed=translational.Fixed(), mass=translational.Mass(m=1.0, L=0.0), position=translational.Position(exact=True),
        gasForce=GasForce(L=0.2, d=0.1),
        sine=blocks.Sine(f=1.0, phase=0.0, startTime=0.0, offset=0.1, amplitude=0.0999999),
    )  # fmt: skip
