"""Test models of ModelicaTest.MultiBody.Joints 4.0, from library components with their names."""

from __future__ import annotations

import math

from acausal import Component, inner
from acausal.components import blocks, multibody, rotational, translational
from acausal.components.examples import assemble, start


def check_constaint_torque_universal_joint() -> Component:
    """MultiBody.Joints.CheckConstaintTorqueUniversalJoint."""
    return assemble(
        "torque.frame_b - bodyCylinder.frame_a - universal.frame_b", "signalTorque_x.y - torque.torque[0]",
        "signalTorque_y.y - torque.torque[1]", "signalTorque_z.y - torque.torque[2]",
        "world.frame_b - universal.frame_a",
        world=inner(multibody.World()), bodyCylinder=multibody.BodyCylinder(r=(1.0, 0.0, 0.0)),
        torque=multibody.WorldTorque(), signalTorque_y=blocks.Constant(k=3.0), signalTorque_x=blocks.Constant(k=2.0),
        signalTorque_z=blocks.Constant(k=4.0),
        universal=multibody.Universal(phi_a=start(0.0, fixed=True), phi_b=start(0.0, fixed=True),
            w_a=start(0.0, fixed=True), w_b=start(0.0, fixed=True)),
    )  # fmt: skip


def free_motion2() -> Component:
    """MultiBody.Joints.FreeMotion2."""
    return assemble(
        "freeMotion.frame_a - fixed.frame_b", "bodyBox.frame_b - freeMotion.frame_b",
        "prismatic.frame_b - universal.frame_a", "universal.frame_b - bodyBox.frame_a",
        "prismatic.frame_a - world.frame_b - prismatic1.frame_a", "prismatic.support - spring.flange_a",
        "prismatic.axis - spring.flange_b", "prismatic1.frame_b - universal1.frame_a",
        "universal1.frame_b - bodyBox1.frame_a", "prismatic1.support - spring1.flange_a",
        "prismatic1.axis - spring1.flange_b",
        world=inner(multibody.World()),
        freeMotion=multibody.FreeMotion(z_rel_a_fixed=False, angles_fixed=False, w_rel_a_fixed=False,
            enforceStates=False), fixed=multibody.Fixed(r=(1.0, 0.0, 0.0)),
        bodyBox=multibody.BodyBox(r=(0.5, 0.0, 0.0)),
        prismatic=multibody.Prismatic(useAxisFlange=True, s=start(0.3, fixed=True), v=start(0.1, fixed=True),
            stateSelect="never"),
        universal=multibody.Universal(phi_a=start(0.0, fixed=True), phi_b=start(0.0, fixed=True),
            w_a=start(0.3, fixed=True), w_b=start(0.3, fixed=True)), spring=translational.Spring(c=10.0, s_rel0=0.3),
        bodyBox1=multibody.BodyBox(r=(0.5, 0.0, 0.0)),
        prismatic1=multibody.Prismatic(useAxisFlange=True, s=start(0.3, fixed=True), v=start(0.1, fixed=True)),
        universal1=multibody.Universal(phi_a=start(0.0, fixed=True), phi_b=start(0.0, fixed=True),
            w_a=start(0.3, fixed=True), w_b=start(0.3, fixed=True)), spring1=translational.Spring(c=10.0, s_rel0=0.3),
    )  # fmt: skip


def free_motion_scalar_init5() -> Component:
    """MultiBody.Joints.FreeMotionScalarInit5."""
    return assemble(
        "world.frame_b - freeMotionScalarInit1.frame_a - freeMotionScalarInit2.frame_a",
        "freeMotionScalarInit1.frame_b - body.frame_a - freeMotionScalarInit2.frame_b",
        world=inner(multibody.World()),
        freeMotionScalarInit1=multibody.FreeMotionScalarInit(use_r=True, r_rel_a_1=start(0.5, fixed=True),
            r_rel_a_2=start(0.4, fixed=True), r_rel_a_3=start(0.0, fixed=True), r_rel_a_1_stateSelect="always",
            r_rel_a_2_stateSelect="always", r_rel_a_3_stateSelect="always", use_v=True,
            v_rel_a_1=start(0.0, fixed=True), v_rel_a_2=start(0.0, fixed=True), v_rel_a_3=start(0.0, fixed=True),
            v_rel_a_1_stateSelect="always", v_rel_a_2_stateSelect="always", v_rel_a_3_stateSelect="always",
            use_angle=False, angle_1=start(math.pi / 4), angle_2=start(math.pi / 4), angle_3=start(math.pi / 4),
            use_angle_d=False), body=multibody.Body(r_CM=(0.0, 0.0, 0.0), m=1.0),
        freeMotionScalarInit2=multibody.FreeMotionScalarInit(use_angle=True, angle_1=start(math.pi / 4, fixed=True),
            angle_2=start(math.pi / 4, fixed=True), angle_3=start(math.pi / 4, fixed=True),
            angle_1_stateSelect="always", angle_2_stateSelect="always", angle_3_stateSelect="always", use_angle_d=True,
            angle_d_1=start(0.0, fixed=True), angle_d_2=start(0.0, fixed=True), angle_d_3=start(0.0, fixed=True),
            angle_d_1_stateSelect="always", angle_d_2_stateSelect="always", angle_d_3_stateSelect="always", use_r=False,
            r_rel_a_1=start(0.5), r_rel_a_2=start(0.4), r_rel_a_3=start(0.0), use_v=False),
    )  # fmt: skip


def gear_constraint() -> Component:
    """MultiBody.Joints.GearConstraint."""
    return assemble(
        "cyl1.frame_b - gearConstraint.frame_a", "torque1.frame_b - cyl1.frame_a",
        "torque1.frame_a - world.frame_b - gearConstraint.frame_b", "sine_1.y - torque1.torque[0] - torque2.tau",
        "sine_2.y - torque1.torque[1]", "sine_3.y - torque1.torque[2]", "inertia1.flange_b - idealGear.flange_a",
        "torque2.flange - inertia1.flange_a", "mounting1D.flange_b - torque2.support - idealGear.flange_b",
        "fixed.frame_b - mounting1D.frame_a", "cyl2.frame_a - gearConstraint.bearing",
        "inertia2.flange_a - idealGear.support",
        gearConstraint=multibody.GearConstraint(ratio=10.0, phi_b=start(0.0, fixed=True), w_b=start(0.0, fixed=True)),
        world=inner(multibody.World(driveTrainMechanics3D=True, g=0.0)),
        cyl1=multibody.BodyCylinder(diameter=0.1, r=(0.4, 0.0, 0.0)),
        cyl2=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.2), torque1=multibody.Torque(),
        sine_1=blocks.Sine(amplitude=2.0, f=1.0), sine_2=blocks.Sine(amplitude=0.0, f=1.0),
        sine_3=blocks.Sine(amplitude=0.0, f=1.0), fixed=multibody.Fixed(),
        inertia1=rotational.Inertia(J=0.0302378292908, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        idealGear=rotational.IdealGear(ratio=10.0, useSupport=True), inertia2=rotational.Inertia(J=0.483805268653),
        torque2=rotational.Torque(useSupport=True), mounting1D=multibody.Mounting1D(),
    )  # fmt: skip


def joint_ups2() -> Component:
    """MultiBody.Joints.JointUPS2."""
    return assemble(
        "world.frame_b - fixedTranslation.frame_a - jointUPS.frame_a", "jointUPS.axis - spring.flange_b",
        "jointUPS.bearing - spring.flange_a", "jointUPS.frame_ib - body.frame_a", "jointUPS.frame_b - bodyBox.frame_b",
        "fixedTranslation.frame_b - universal.frame_a", "universal.frame_b - bodyBox.frame_a",
        jointUPS=multibody.JointUPS(), world=inner(multibody.World()),
        body=multibody.Body(m=10.0, r_CM=(0.0, 0.0, 0.0)), spring=translational.Spring(c=10.0, s_rel0=0.5),
        fixedTranslation=multibody.FixedTranslation(r=(2.0, 0.0, 0.0)),
        bodyBox=multibody.BodyBox(r=(-1.4141, 0.0, 0.0)),
        universal=multibody.Universal(phi_a=start(0.0, fixed=True), phi_b=start(0.0, fixed=True),
            w_a=start(2.0, fixed=True), w_b=start(2.0, fixed=True), n_a=(0.0, 0.0, 1.0)),
    )  # fmt: skip


def revolute2() -> Component:
    """MultiBody.Joints.Revolute2."""
    return assemble(
        "world.frame_b - revolute.frame_a - revolute1.frame_a - revolute3.frame_a", "revolute.frame_b - body.frame_a",
        "revolute1.frame_b - body1.frame_a", "constantSpeed.support - revolute1.support",
        "constantSpeed.flange - revolute1.axis", "body2.frame_a - revolute2.frame_b",
        "revolute3.axis - damper.flange_a", "revolute3.frame_b - bodyCylinder.frame_a",
        "bodyCylinder.frame_b - revolute2.frame_a", "damper.flange_b - revolute2.axis",
        world=inner(multibody.World()),
        revolute=multibody.Revolute(n=(0.0, 0.0, 1.0), w=start(2.0, fixed=True), phi=start(math.pi / 4, fixed=True)),
        body=multibody.Body(r_CM=(0.0, 0.0, 0.0), m=1.0, I_11=0.1, I_22=0.1, I_33=0.1),
        revolute1=multibody.Revolute(n=(0.0, 0.0, 1.0), useAxisFlange=True, phi=start(math.pi / 4, fixed=True)),
        body1=multibody.Body(r_CM=(0.0, 0.0, 0.0), m=1.0, I_11=0.1, I_22=0.1, I_33=0.1),
        constantSpeed=rotational.ConstantSpeed(useSupport=True, w_fixed=2.0),
        revolute2=multibody.Revolute(useAxisFlange=True, w=start(4.0, fixed=True), n=(1.0, 0.0, 0.0),
            phi=start(math.pi / 4, fixed=True)),
        body2=multibody.Body(r_CM=(0.0, 0.0, 0.0), m=1.0, I_11=0.5, I_22=0.0, I_33=0.0),
        revolute3=multibody.Revolute(useAxisFlange=True, phi=start(0.0, fixed=True), n=(1.0, 0.0, 0.0),
            w=start(20.0, fixed=True)), damper=rotational.Damper(d=0.6),
        bodyCylinder=multibody.BodyCylinder(density=25000.0, diameter=0.2, r=(1.0, 0.0, 0.0)),
    )  # fmt: skip


def revolute_planar_loop_constraint() -> Component:
    """MultiBody.Joints.RevolutePlanarLoopConstraint."""
    return assemble(
        "revolute1.frame_b - bodyCylinder.frame_a", "bodyCylinder.frame_b - revolute3.frame_a",
        "torque.flange - revolute1.axis", "realExpression.y - torque.tau", "revolute3.frame_b - bodyCylinder1.frame_a",
        "bodyCylinder1.frame_b - revolute4.frame_a", "revolute4.frame_b - bodyCylinder2.frame_a",
        "bodyCylinder2.frame_b - revolute.frame_a", "revolute.frame_b - bodyCylinder3.frame_a",
        "bodyCylinder3.frame_b - revolute1.frame_a - fixedRotation1.frame_b", "world.frame_b - revolute2.frame_a",
        "fixedRotation.frame_b - fixedRotation1.frame_a", "revolute2.frame_b - fixedRotation.frame_a",
        world=inner(multibody.World()), revolute=multibody.RevolutePlanarLoopConstraint(n=(0.0, 1.0, 0.0)),
        revolute1=multibody.Revolute(n=(0.0, 1.0, 0.0), useAxisFlange=True),
        revolute3=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(math.pi / 2, fixed=True), w=start(0.0, fixed=True)),
        revolute4=multibody.Revolute(n=(0.0, 1.0, 0.0), phi=start(math.pi / 2)),
        bodyCylinder=multibody.BodyCylinder(r=(1.0, 0.0, 0.0), diameter=0.2), torque=rotational.Torque(),
        realExpression=blocks.Step(height=-1000.0, offset=1000.0, startTime=1.0),
        bodyCylinder1=multibody.BodyCylinder(r=(1.0, 0.0, 0.0), diameter=0.2),
        bodyCylinder2=multibody.BodyCylinder(r=(1.0, 0.0, 0.0), diameter=0.2),
        bodyCylinder3=multibody.BodyCylinder(r=(1.0, 0.0, 0.0), diameter=0.2),
        revolute2=multibody.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True), w=start(2 * math.pi, fixed=True)),
        fixedRotation=multibody.FixedRotation(n=(0.0, 1.0, 0.0), angle=90.0),
        fixedRotation1=multibody.FixedRotation(angle=45.0, n=(0.0, 0.0, 1.0)),
    )  # fmt: skip


def universal_spherical() -> Component:
    """MultiBody.Joints.UniversalSpherical."""
    return assemble(
        "spherical1.frame_b - bodyBox1.frame_a",
        "world.frame_b - universalSpherical.frame_a - universal.frame_a - universalSpherical1.frame_a - init.frame_a",
        "world.frame_b - init2.frame_a", "universalSpherical.frame_b - bodyBox.frame_a - init.frame_b",
        "universalSpherical1.frame_b - bodyBox2.frame_a - init2.frame_b",
        "universal.frame_b - fixedTranslation.frame_a", "fixedTranslation.frame_b - spherical1.frame_a",
        world=inner(multibody.World()), fixedTranslation=multibody.FixedTranslation(r=(-1.0, 0.0, 0.0)),
        bodyBox=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.1, height=0.1, r_0=start((1.0, 0.0, 0.0)),
            angles_fixed=True, w_0_fixed=True, w_0_start=(0.0, 0.0, 0.0)), spherical1=multibody.Spherical(),
        bodyBox1=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.1, height=0.1, w_0_start=(0.0, 0.0, 0.0),
            angles_fixed=True, w_0_fixed=True),
        bodyBox2=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.1, height=0.1, v_0=start((0.0, 0.0, 0.0)),
            angles_fixed=True, w_0_fixed=True, r_0=start((1.0, 0.0, 0.0), fixed=True), w_0_start=(0.0, 0.0, 0.0)),
        universalSpherical=multibody.UniversalSpherical(),
        universalSpherical1=multibody.UniversalSpherical(computeRodLength=True),
        universal=multibody.Universal(w_a=start(0.0, fixed=True), w_b=start(0.0, fixed=True), n_a=(0.0, 0.0, 1.0),
            n_b=(0.0, 1.0, 0.0), phi_a=start(0.0, fixed=True), phi_b=start(math.pi, fixed=True)),
        init=multibody.FreeMotionScalarInit(use_r=True, use_v=True, v_rel_a_2=start(0.0, fixed=True),
            v_rel_a_3=start(0.0, fixed=True), r_rel_a_2=start(0.0, fixed=True), r_rel_a_3=start(0.0, fixed=True)),
        init2=multibody.FreeMotionScalarInit(use_r=True, use_v=True, v_rel_a_2=start(0.0, fixed=True),
            v_rel_a_3=start(0.0, fixed=True)),
    )  # fmt: skip


def universal() -> Component:
    """MultiBody.Joints.Universal, as long as rounding does not tip the body over."""
    return assemble(
        "world.frame_b - universal.frame_a", "universal.frame_b - body.frame_a",
        world=inner(multibody.World()),
        universal=multibody.Universal(n_a=(0.0, 0.0, 1.0), phi_a=start(math.pi / 2, fixed=True),
            phi_b=start(math.pi / 4, fixed=True), w_a=start(0.0, fixed=True), w_b=start(0.0, fixed=True)),
        body=multibody.Body(m=1.0, r_CM=(0.5, 0.0, 0.0)),
    )  # fmt: skip


def joint_usp2() -> Component:
    """MultiBody.Joints.JointUSP2, up to the dead centre of its loop."""
    return assemble(
        "jointUSP.frame_im - body.frame_a", "world.frame_b - jointUSP.frame_a - fixedTranslation.frame_a",
        "spring.flange_a - jointUSP.axis", "jointUSP.bearing - spring.flange_b",
        "fixedTranslation.frame_b - revolute.frame_a", "revolute.frame_b - bodyBox.frame_a",
        "bodyBox.frame_b - jointUSP.frame_b",
        world=inner(multibody.World()),
        jointUSP=multibody.JointUSP(n1_a=(0.0, 1.0, 0.0), rRod1_ia=(1.0, 1.0, 0.0), n_b=(0.0, 0.0, 1.0),
            rRod2_ib=(-1.0, 1.0, 0.0)), body=multibody.Body(m=10.0, r_CM=(0.0, 0.0, 0.0)),
        spring=translational.Spring(c=10.0, s_rel0=0.5), fixedTranslation=multibody.FixedTranslation(r=(2.0, 0.0, 0.0)),
        revolute=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        bodyBox=multibody.BodyBox(r=(-1.4141, 0.0, 0.0)),
    )  # fmt: skip


def fourbar_spherical_and_universal() -> Component:
    """MultiBody.FourbarVariants.SphericalAndUniversal."""
    return assemble(
        "j2.frame_b - b2.frame_a", "j1.frame_b - b1.frame_a", "j1.frame_a - world.frame_b - b3.frame_a",
        "b3.frame_b - j2.frame_a", "b1.frame_b - spherical.frame_a", "spherical.frame_b - FixedTranslation1.frame_a",
        "FixedTranslation1.frame_b - Universal1.frame_a", "b2.frame_b - Universal1.frame_b",
        world=inner(multibody.World()),
        j1=multibody.Revolute(n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True),
            w=start(5.23598775598, fixed=True)), j2=multibody.Prismatic(n=(1.0, 0.0, 0.0)),
        b1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05), b3=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        spherical=multibody.Spherical(), FixedTranslation1=multibody.FixedTranslation(r=(1.0, -0.3, -0.1)),
        Universal1=multibody.Universal(n_b=(0.0, 1.0, 0.0), n_a=(0.0, 0.0, 1.0)),
    )  # fmt: skip


def fourbar_spherical_spherical() -> Component:
    """MultiBody.FourbarVariants.SphericalSpherical."""
    return assemble(
        "j2.frame_b - b2.frame_a", "j1.frame_b - b1.frame_a", "j1.frame_a - world.frame_b - b3.frame_a",
        "b1.frame_b - sphericalSpherical.frame_b", "sphericalSpherical.frame_a - b2.frame_b", "b3.frame_b - j2.frame_a",
        world=inner(multibody.World()),
        j1=multibody.Revolute(n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True),
            w=start(5.23598775598, fixed=True)), j2=multibody.Prismatic(n=(1.0, 0.0, 0.0), s=start(0.0, fixed=True)),
        b1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        sphericalSpherical=multibody.SphericalSpherical(computeRodLength=True, m=1.0),
        b3=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
    )  # fmt: skip


def fourbar_universal_spherical() -> Component:
    """MultiBody.FourbarVariants.UniversalSpherical."""
    return assemble(
        "j2.frame_b - b2.frame_a", "j1.frame_b - b1.frame_a", "j1.frame_a - world.frame_b - b3.frame_a",
        "b1.frame_b - universalSpherical.frame_b", "universalSpherical.frame_a - b2.frame_b", "b3.frame_b - j2.frame_a",
        world=inner(multibody.World()),
        j1=multibody.Revolute(n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True),
            w=start(5.23598775598, fixed=True)), j2=multibody.Prismatic(n=(1.0, 0.0, 0.0)),
        b1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        universalSpherical=multibody.UniversalSpherical(rRod_ia=(-1.0, 0.3, 0.1), n1_a=(0.0, 1.0, 0.1)),
        b3=multibody.FixedTranslation(r=(0.8, 0.0, 0.0)),
    )  # fmt: skip


def fourbar_joint_ssr() -> Component:
    """MultiBody.FourbarVariants.JointSSR."""
    return assemble(
        "jointSSR.axis - damper.flange_b", "jointSSR.bearing - damper.flange_a",
        "world.frame_b - b3.frame_a - jointSSR.frame_b", "b3.frame_b - j2.frame_a", "j2.frame_b - b2.frame_a",
        "b2.frame_b - jointSSR.frame_a", "Body1.frame_a - jointSSR.frame_ib", "Body2.frame_a - jointSSR.frame_im",
        world=inner(multibody.World()),
        j2=multibody.Prismatic(n=(1.0, 0.0, 0.0), stateSelect="always", s=start(0.0, fixed=True),
            v=start(-0.2, fixed=True)), b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        b3=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        jointSSR=multibody.JointSSR(n_b=(1.0, 0.0, 0.0), rRod2_ib=(0.0, 0.5, 0.1), rod1Length=1.04880884817,
            rod1Mass=0.1), Body1=multibody.Body(r_CM=(0.0, 0.25, 0.05), m=0.1),
        Body2=multibody.Body(m=0.1, r_CM=(0.0, 0.0, 0.0)), damper=rotational.Damper(d=0.5),
    )  # fmt: skip


def fourbar_joint_usp() -> Component:
    """MultiBody.FourbarVariants.JointUSP."""
    return assemble(
        "jointUSP.bearing - damper.flange_a", "jointUSP.axis - damper.flange_b",
        "ground_rod.frame_b - jointUSP.frame_b", "world.frame_b - ground_rod.frame_a - revolute.frame_a",
        "revolute.frame_b - body1.frame_a", "body1.frame_b - jointUSP.frame_a", "jointUSP.frame_ia - body2.frame_a",
        "jointUSP.frame_ib - body3.frame_a",
        world=inner(multibody.World()),
        revolute=multibody.Revolute(n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True),
            w=start(5.23598775598, fixed=True)), body1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        body3=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        ground_rod=multibody.FixedTranslation(r=(1.2, 0.0, 0.0)),
        jointUSP=multibody.JointUSP(rRod2_ib=(0.0, 0.2, 0.0), n1_a=(0.0, 0.0, -1.0), n_b=(-1.0, 0.0, 0.0),
            rRod1_ia=(1.0, -0.3, 0.1)), body2=multibody.BodyCylinder(r=(1.0, -0.3, 0.1), diameter=0.05),
        damper=translational.Damper(d=50.0),
    )  # fmt: skip


def fourbar_joint_usr() -> Component:
    """MultiBody.FourbarVariants.JointUSR, up to the dead centre of its loop."""
    return assemble(
        "j2.frame_b - b2.frame_a", "b3.frame_a - world.frame_b - jointUSR.frame_b", "b3.frame_b - j2.frame_a",
        "jointUSR.frame_a - b2.frame_b", "damper.flange_b - jointUSR.axis", "damper.flange_a - jointUSR.bearing",
        "Body1.frame_a - jointUSR.frame_ib", "Body2.frame_a - jointUSR.frame_ia", "Body3.frame_a - jointUSR.frame_im",
        world=inner(multibody.World()),
        j2=multibody.Prismatic(n=(1.0, 0.0, 0.0), stateSelect="always", s=start(0.0, fixed=True),
            v=start(-0.4, fixed=True)), b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        b3=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        jointUSR=multibody.JointUSR(n1_a=(0.0, 1.0, 0.0), n_b=(1.0, 0.0, 0.0), rRod2_ib=(0.0, 0.5, 0.1),
            rRod1_ia=(-1.0, 0.3, -0.1)),
        Body1=multibody.Body(m=1.0, I_11=0.1, I_22=0.1, I_33=0.1, r_CM=(0.01, 0.0, 0.0)),
        Body2=multibody.Body(m=1.0, I_11=0.1, I_22=0.1, I_33=0.1,
            r_CM=(-0.476731294623, 0.143019388387, -0.0476731294623)),
        Body3=multibody.Body(m=1.0, I_11=0.1, I_22=0.1, I_33=0.1, r_CM=(0.0, 0.0, 0.0)),
        damper=rotational.Damper(d=0.1),
    )  # fmt: skip
