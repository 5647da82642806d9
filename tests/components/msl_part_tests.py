"""Test models of ModelicaTest.MultiBody.Parts, .Sensors and .Frames 4.0, from library components with their names."""

from __future__ import annotations

import math

from acausal import Component, inner
from acausal.components import blocks, multibody, rotational
from acausal.components.examples import assemble, start


def body_shape() -> Component:
    """MultiBody.Parts.BodyShape."""
    return assemble(
        "world.frame_b - bar2.frame_a - spring1.frame_a - freeMotion.frame_a",
        "spring1.frame_b - body.frame_a - freeMotion.frame_b", "body.frame_b - spring2.frame_b",
        "bar2.frame_b - spring2.frame_a",
        world=inner(multibody.World()), bar2=multibody.FixedTranslation(r=(0.8, 0.0, 0.0)),
        spring1=multibody.Spring(c=20.0, s_unstretched=0.0),
        body=multibody.BodyShape(m=1.0, I_11=1.0, I_22=1.0, I_33=1.0, r=(0.4, 0.0, 0.0), r_CM=(0.2, 0.0, 0.0),
            angles_fixed=False), spring2=multibody.Spring(c=20.0, s_unstretched=0.0),
        freeMotion=multibody.FreeMotion(w_rel_a_fixed=True, v_rel_a=start((0.0, 0.0, 0.0), fixed=True),
            angles_fixed=True, r_rel_a=start((0.2, -0.5, 0.1), fixed=True)),
    )  # fmt: skip


def point_mass() -> Component:
    """MultiBody.Parts.PointMass."""
    return assemble(
        "fixedTranslation.frame_b - pointMass.frame_a", "world.frame_b - rev.frame_a",
        "rev.frame_b - fixedTranslation.frame_a",
        world=inner(multibody.World()), fixedTranslation=multibody.FixedTranslation(r=(1.0, 0.0, 0.0)),
        pointMass=multibody.PointMass(m=5.0),
        rev=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip


def rotor1d_2() -> Component:
    """MultiBody.Parts.Rotor1D.Rotor1D_2."""
    return assemble(
        "world.frame_b - revolute.frame_a - torque.frame_resolve - torque.frame_a",
        "revolute.frame_b - bodyCylinder.frame_a", "torque.frame_b - bodyCylinder.frame_b",
        "sine_1.y - torque.torque[0] - torque1.tau", "sine_2.y - torque.torque[1]", "sine_3.y - torque.torque[2]",
        "fixed.frame_b - rotor1D.frame_a - mounting1D.frame_a", "torque1.flange - rotor1D.flange_a",
        "mounting1D.flange_b - torque1.support",
        bodyCylinder=multibody.BodyShape(r=(0.5, 0.0, 0.0), m=0.0, I_11=2.0, I_22=0.0, I_33=0.0, r_CM=(0.0, 0.0, 0.0)),
        revolute=multibody.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        world=inner(multibody.World(g=0.0, driveTrainMechanics3D=True)),
        torque=multibody.Torque(resolveInFrame="frame_resolve"), sine_1=blocks.Sine(amplitude=1.0, f=1.0),
        sine_2=blocks.Sine(amplitude=0.0, f=1.0), sine_3=blocks.Sine(amplitude=0.0, f=1.0),
        fixed=inner(multibody.Fixed()),
        rotor1D=multibody.Rotor1D(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torque1=rotational.Torque(useSupport=True), mounting1D=multibody.Mounting1D(),
    )  # fmt: skip


def rotor1d_3() -> Component:
    """MultiBody.Parts.Rotor1D.Rotor1D_3."""
    return assemble(
        "revolute.frame_b - bodyCylinder.frame_a", "torque.frame_b - bodyCylinder.frame_b",
        "sine1_1.y - torque.torque[0] - torque1.tau", "sine1_2.y - torque.torque[1]", "sine1_3.y - torque.torque[2]",
        "torque1.flange - rotor1D.flange_a", "mounting1D.flange_b - torque1.support",
        "r1.frame_a - world.frame_b - mounting1D1.frame_a", "position1.flange - r1.axis",
        "position1.support - mounting1D1.flange_b", "sine2.y - position1.phi_ref - position2.phi_ref",
        "r1.frame_b - revolute.frame_a - torque.frame_resolve - torque.frame_a", "position2.flange - r2.axis",
        "position2.support - mounting1D2.flange_b", "fixed.frame_b - r2.frame_a - mounting1D2.frame_a",
        "r2.frame_b - rotor1D.frame_a - mounting1D.frame_a",
        bodyCylinder=multibody.BodyShape(r=(0.5, 0.0, 0.0), m=0.0, I_11=2.0, I_22=0.0, I_33=0.0, r_CM=(0.0, 0.0, 0.0)),
        revolute=multibody.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        world=inner(multibody.World(g=0.0, driveTrainMechanics3D=True)),
        torque=multibody.Torque(resolveInFrame="frame_resolve"), sine1_1=blocks.Sine(amplitude=1.0, f=1.0),
        sine1_2=blocks.Sine(amplitude=0.0, f=1.0), sine1_3=blocks.Sine(amplitude=0.0, f=1.0),
        rotor1D=multibody.Rotor1D(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torque1=rotational.Torque(useSupport=True), mounting1D=multibody.Mounting1D(),
        r1=multibody.Revolute(n=(0.0, 1.0, 0.0), useAxisFlange=True, w=start(0.0, fixed=True)),
        position1=rotational.Position(useSupport=True), sine2=blocks.Sine(amplitude=2.0, f=1.0),
        mounting1D1=multibody.Mounting1D(),
        r2=multibody.Revolute(n=(0.0, 1.0, 0.0), useAxisFlange=True, w=start(0.0, fixed=True)),
        position2=rotational.Position(useSupport=True), mounting1D2=multibody.Mounting1D(), fixed=multibody.Fixed(),
    )  # fmt: skip


def bevel1d() -> Component:
    """MultiBody.Parts.Rotor1D.Bevel1D."""
    return assemble(
        "world.frame_b - gearConstraint.bearing - torque1.frame_a", "cyl1.frame_b - gearConstraint.frame_a",
        "gearConstraint.frame_b - cyl2.frame_a", "torque1.frame_b - cyl1.frame_a",
        "sine_1.y - torque1.torque[0] - torque2.tau", "sine_2.y - torque1.torque[1]", "sine_3.y - torque1.torque[2]",
        "torque2.flange - inertia1.flange_a", "inertia1.flange_b - bevelGear1D.flange_a",
        "bevelGear1D.flange_b - inertia2.flange_a", "fixed.frame_b - bevelGear1D.frame_a",
        gearConstraint=multibody.GearConstraint(ratio=10.0, phi_b=start(0.0, fixed=True), w_b=start(0.0, fixed=True)),
        world=inner(multibody.World(g=0.0, driveTrainMechanics3D=True)),
        cyl1=multibody.BodyCylinder(diameter=0.1, r=(0.4, 0.0, 0.0)),
        cyl2=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.2),
        torque1=multibody.Torque(resolveInFrame="frame_b"), sine_1=blocks.Sine(amplitude=2.0, f=1.0),
        sine_2=blocks.Sine(amplitude=0.0, f=1.0), sine_3=blocks.Sine(amplitude=0.0, f=1.0), fixed=multibody.Fixed(),
        inertia1=rotational.Inertia(J=0.0302378292908, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        inertia2=rotational.Inertia(J=0.483805268653), torque2=rotational.Torque(useSupport=False),
        bevelGear1D=multibody.BevelGear1D(ratio=10.0),
    )  # fmt: skip


def gear_constraint2() -> Component:
    """MultiBody.Parts.Rotor1D.GearConstraint2."""
    return assemble(
        "gc2.frame_b - bodyCylinder3.frame_a",
        "fixedTranslation.frame_a - world.frame_b - gc1.bearing - torque1.frame_a",
        "gc1.frame_b - bodyCylinder2.frame_a", "bodyCylinder.frame_b - fixedTranslation1.frame_a",
        "fixedTranslation1.frame_b - gc1.frame_a", "bodyCylinder1.frame_b - fixedTranslation2.frame_a",
        "fixedTranslation2.frame_b - gc2.frame_a", "torque1.frame_b - bodyCylinder.frame_a",
        "fixedTranslation.frame_b - torque2.frame_a - gc2.bearing", "torque2.frame_b - bodyCylinder1.frame_a",
        "ramp_1.y - torque1.torque[0] - torque2.torque[0]", "ramp_2.y - torque1.torque[1] - torque2.torque[1]",
        "ramp_3.y - torque1.torque[2] - torque2.torque[2]",
        gc1=multibody.GearConstraint(ratio=5.0, phi_b=start(0.0, fixed=True), w_b=start(0.0, fixed=True),
            r_a=(1.0, 0.0, 0.0), r_b=(1.0, 0.0, 0.0), n_a=(1.0, 0.0, 0.0), n_b=(1.0, 0.0, 0.0)),
        world=inner(multibody.World()),
        gc2=multibody.GearConstraint(phi_b=start(0.0, fixed=True), w_b=start(0.0, fixed=True), n_a=(1.0, 0.0, 0.0),
            n_b=(1.0, 0.0, 0.0), r_a=(1.0, 0.0, 0.0), r_b=(1.0, 0.0, 0.0), ratio=2.5),
        bodyCylinder=multibody.BodyCylinder(diameter=0.3, r=(0.1, 0.0, 0.0), angles_fixed=False, w_0_fixed=False),
        bodyCylinder1=multibody.BodyCylinder(diameter=0.3, r=(0.1, 0.0, 0.0), angles_fixed=False, w_0_fixed=False),
        bodyCylinder2=multibody.BodyCylinder(diameter=0.3, r=(0.2, 0.0, 0.0), angles_fixed=False, w_0_fixed=False),
        bodyCylinder3=multibody.BodyCylinder(diameter=0.3, r=(0.2, 0.0, 0.0), angles_fixed=False, w_0_fixed=False),
        ramp_1=blocks.Ramp(height=100.0, duration=2.0), ramp_2=blocks.Ramp(height=0.0, duration=2.0),
        ramp_3=blocks.Ramp(height=0.0, duration=2.0), fixedTranslation=multibody.FixedTranslation(r=(0.0, 0.0, 1.0)),
        fixedTranslation1=multibody.FixedTranslation(r=(0.5, 0.0, 0.0)),
        fixedTranslation2=multibody.FixedTranslation(r=(0.5, 0.0, 0.0)), torque1=multibody.Torque(),
        torque2=multibody.Torque(),
    )  # fmt: skip


def gear_constraint4() -> Component:
    """MultiBody.Parts.Rotor1D.GearConstraint4."""
    return assemble(
        "freeMotion1.frame_b - bodyBox1.frame_a - absoluteSensor_MBS.frame_a",
        "bodyBox1.frame_b - fixedTranslation1.frame_a",
        "revolute1.frame_a - fixedTranslation1.frame_b - torque1.frame_a",
        "bodyShape1.frame_a - fixedRotation1.frame_b",
        "revolute1.frame_b - fixedTranslation2.frame_a - torque1.frame_b",
        "fixedRotation1.frame_a - fixedTranslation2.frame_b - fixedTranslation4.frame_a",
        "fixed1.frame_b - freeMotion1.frame_a", "cyl1.frame_b - gearConstraint.frame_a",
        "gearConstraint.frame_b - cyl2.frame_a", "torque2.frame_b - cyl1.frame_a", "sine_1.y - torque2.torque[0]",
        "sine_2.y - torque2.torque[1]", "sine_3.y - torque2.torque[2]",
        "torque2.frame_a - fixedTranslation4.frame_b - gearConstraint.bearing",
        "freeMotion2.frame_b - bodyBox3.frame_a - absoluteSensor_1D.frame_a",
        "bodyBox3.frame_b - fixedTranslation5.frame_a",
        "revolute2.frame_a - fixedTranslation5.frame_b - torque3.frame_a",
        "bodyShape2.frame_a - fixedRotation2.frame_b",
        "revolute2.frame_b - fixedTranslation7.frame_a - torque3.frame_b",
        "fixedRotation2.frame_a - fixedTranslation7.frame_b - fixedTranslation8.frame_a",
        "fixed2.frame_b - freeMotion2.frame_a", "inertia1.flange_b - idealGear.flange_a",
        "idealGear.flange_b - inertia2.flange_a", "torque4.flange - inertia1.flange_a",
        "mounting1D.flange_b - idealGear.support - torque4.support",
        "mounting1D.frame_a - fixedTranslation8.frame_b - inertia1.frame_a - inertia2.frame_a - cyl3.frame_b",
        "mounting1D.frame_a - cyl4.frame_a", "sine2.y - torque4.tau",
        "constVec3_1.y - torque1.torque[0] - torque3.torque[0]",
        "constVec3_2.y - torque1.torque[1] - torque3.torque[1]",
        "constVec3_3.y - torque1.torque[2] - torque3.torque[2]",
        world=inner(multibody.World(g=0.0)),
        freeMotion1=multibody.FreeMotion(r_rel_a=start((0.0, 0.0, 0.0), fixed=True),
            v_rel_a=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True, w_rel_a_fixed=True, useQuaternions=False),
        fixed1=multibody.Fixed(), bodyBox1=multibody.BodyBox(r=(1.0, 0.0, 0.0), width=0.1, density=70.0),
        revolute1=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixedTranslation1=multibody.FixedTranslation(r=(0.0, 0.0, 0.05)),
        fixedRotation1=multibody.FixedRotation(rotationType="PlanarRotationSequence", n=(0.0, 1.0, 0.0), angle=60.0,
            angles=(0.0, 90.0, 0.0)),
        bodyShape1=multibody.BodyShape(r=(0.0, 0.0, 0.0), r_CM=(0.0, 0.0, 0.0), m=0.0, I_11=1.5, I_22=0.0, I_33=0.0),
        fixedTranslation2=multibody.FixedTranslation(r=(0.0, 0.0, 0.025)), torque1=multibody.Torque(),
        constVec3_1=blocks.Constant(k=0.0), constVec3_2=blocks.Constant(k=0.0), constVec3_3=blocks.Constant(k=1.0),
        gearConstraint=multibody.GearConstraint(ratio=10.0, phi_b=start(0.0, fixed=True), w_b=start(0.0, fixed=True)),
        cyl1=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.1, r_0=start((0.0, 0.0, 0.0))),
        cyl2=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.2), torque2=multibody.Torque(),
        sine_1=blocks.Sine(amplitude=2.0, f=1.0), sine_2=blocks.Sine(amplitude=0.0, f=1.0),
        sine_3=blocks.Sine(amplitude=0.0, f=1.0), fixedTranslation4=multibody.FixedTranslation(r=(0.4, 0.0, 0.0)),
        freeMotion2=multibody.FreeMotion(r_rel_a=start((0.0, 0.0, 0.0), fixed=True),
            v_rel_a=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True, w_rel_a_fixed=True, useQuaternions=False),
        fixed2=multibody.Fixed(), bodyBox3=multibody.BodyBox(r=(1.0, 0.0, 0.0), width=0.1, density=70.0),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        fixedTranslation5=multibody.FixedTranslation(r=(0.0, 0.0, 0.05)),
        fixedRotation2=multibody.FixedRotation(rotationType="PlanarRotationSequence", n=(0.0, 1.0, 0.0), angle=60.0,
            angles=(0.0, 90.0, 0.0)),
        bodyShape2=multibody.BodyShape(r=(0.0, 0.0, 0.0), r_CM=(0.0, 0.0, 0.0), m=0.0, I_11=1.5, I_22=0.0, I_33=0.0),
        fixedTranslation7=multibody.FixedTranslation(r=(0.0, 0.0, 0.025)), torque3=multibody.Torque(),
        fixedTranslation8=multibody.FixedTranslation(r=(0.4, 0.0, 0.0)),
        inertia1=multibody.Rotor1D(J=0.0302378292908, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        idealGear=rotational.IdealGear(useSupport=True, ratio=10.0), inertia2=multibody.Rotor1D(J=0.483805268653),
        torque4=rotational.Torque(useSupport=True), mounting1D=multibody.Mounting1D(),
        sine2=blocks.Sine(amplitude=2.0, f=1.0),
        absoluteSensor_MBS=multibody.AbsoluteSensor(get_r=True, get_angles=True),
        absoluteSensor_1D=multibody.AbsoluteSensor(get_r=True, get_angles=True),
        cyl3=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.1, r_0=start((0.0, 0.0, 0.0))),
        cyl4=multibody.BodyCylinder(r=(0.4, 0.0, 0.0), diameter=0.2),
    )  # fmt: skip


def rotor1d_1() -> Component:
    """MultiBody.Parts.Rotor1D.Rotor1D_1."""
    return assemble(
        "world.frame_b - spherical1.frame_a", "spherical1.frame_b - bodyCylinder1.frame_a",
        "bodyCylinder1.frame_b - fixedRotation1.frame_a", "fixedRotation1.frame_b - revolute.frame_a",
        "revolute.frame_b - fixedTranslation.frame_a", "fixedTranslation.frame_b - bodyCylinder2.frame_a",
        "spherical2.frame_b - bodyCylinder3.frame_a", "bodyCylinder3.frame_b - fixedRotation2.frame_a",
        "fixed.frame_b - spherical2.frame_a", "fixedTranslation1.frame_b - bodyCylinder4.frame_a",
        "fixedRotation2.frame_b - fixedTranslation1.frame_a - rotor1D.frame_a",
        world=inner(multibody.World(driveTrainMechanics3D=True)),
        spherical1=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False),
        bodyCylinder1=multibody.BodyCylinder(r=(0.25, 0.0, 0.0), diameter=0.05),
        fixedRotation1=multibody.FixedRotation(angle=45.0, n=(0.0, 1.0, 0.0)),
        revolute=multibody.Revolute(n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True), w=start(8.72664625997, fixed=True)),
        fixedTranslation=multibody.FixedTranslation(r=(-0.1, 0.0, 0.0)),
        bodyCylinder2=multibody.BodyCylinder(diameter=0.1, r=(0.2, 0.0, 0.0)), fixed=multibody.Fixed(),
        spherical2=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False),
        bodyCylinder3=multibody.BodyCylinder(r=(0.25, 0.0, 0.0), diameter=0.05),
        fixedRotation2=multibody.FixedRotation(n=(0.0, 1.0, 0.0), angle=45.0),
        fixedTranslation1=multibody.FixedTranslation(r=(-0.1, 0.0, 0.0)),
        bodyCylinder4=multibody.BodyCylinder(diameter=0.1, r=(0.2, 0.0, 0.0)),
        rotor1D=multibody.Rotor1D(J=0.0151189146454, n=(1.0, 0.0, 0.0), phi=start(0.0, fixed=True),
            w=start(8.72664625997, fixed=True)),
    )  # fmt: skip


def gear_constraint3() -> Component:
    """MultiBody.Parts.Rotor1D.GearConstraint3, as long as it is not chaotic."""
    return assemble(
        "world.frame_b - revolute1.frame_a - torque.frame_a", "revolute1.frame_b - revolute2.frame_a",
        "revolute2.frame_b - revolute3.frame_a", "torque1.flange - revolute1.axis", "torque2.flange - revolute2.axis",
        "torque3.flange - revolute3.axis", "sine1.y - torque1.tau", "torque2.tau - sine2.y", "torque3.tau - sine3.y",
        "revolute3.frame_b - bodyBox1.frame_a - gearConstraint.bearing", "gearConstraint.frame_b - bodyBox2.frame_a",
        "gearConstraint.frame_a - bodyBox3.frame_b", "bodyBox3.frame_a - torque.frame_b",
        "sine4_1.y - torque.torque[0]", "sine4_2.y - torque.torque[1]", "sine4_3.y - torque.torque[2]",
        world=inner(multibody.World()),
        gearConstraint=multibody.GearConstraint(ratio=10.0, n_a=(1.0, 0.0, 0.0), n_b=(0.0, 1.0, 0.0)),
        revolute1=multibody.Revolute(useAxisFlange=True, n=(1.0, 0.0, 0.0), stateSelect="always",
            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        revolute2=multibody.Revolute(useAxisFlange=True, n=(0.0, 1.0, 0.0), stateSelect="always",
            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        revolute3=multibody.Revolute(useAxisFlange=True, n=(0.0, 0.0, 1.0), stateSelect="always",
            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)), torque1=rotational.Torque(),
        torque2=rotational.Torque(), torque3=rotational.Torque(), sine1=blocks.Sine(amplitude=110.0, f=5.0),
        sine2=blocks.Sine(amplitude=120.0, f=6.0), sine3=blocks.Sine(amplitude=130.0, f=7.0),
        sine4_1=blocks.Sine(amplitude=140.0, f=8.0), sine4_2=blocks.Sine(amplitude=150.0, f=9.0),
        sine4_3=blocks.Sine(amplitude=160.0, f=10.0),
        bodyBox1=multibody.BodyBox(r=(0.1, 0.1, 0.1), length=0.1, width=0.1),
        bodyBox2=multibody.BodyBox(length=0.1, width=0.1, r=(1.1, 1.2, 1.3)),
        bodyBox3=multibody.BodyBox(length=0.1, width=0.1, r=(0.11, 0.12, 0.13)), torque=multibody.Torque(),
    )  # fmt: skip


def initialized_rotors() -> Component:
    """MultiBody.InitializationConversion.Rotor1D, as long as its official trajectory keeps the phase."""
    return assemble(
        "world.frame_b - rotor1D1.frame_a - rotor1D2.frame_a - rotor1D3.frame_a - rotor1D4.frame_a - rotor1D5.frame_a",
        "world.frame_b - rotor1D6.frame_a - rotor1D7.frame_a - rotor1D8.frame_a - rotor1D9.frame_a - rotor1D10.frame_a",
        "spring.flange_a - rotor1D5.flange_b", "spring.flange_b - rotor1D6.flange_a",
        "spring1.flange_a - rotor1D7.flange_b", "spring1.flange_b - rotor1D8.flange_a",
        "spring2.flange_a - rotor1D9.flange_b", "spring2.flange_b - rotor1D10.flange_a",
        world=inner(multibody.World()),
        rotor1D1=multibody.Rotor1D(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        rotor1D2=multibody.Rotor1D(J=1.0, stateSelect="prefer", w=start(1.74532925199, fixed=True),
            phi=start(math.pi / 2, fixed=True)),
        rotor1D3=multibody.Rotor1D(J=1.0, stateSelect="prefer", phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        rotor1D4=multibody.Rotor1D(J=1.0, stateSelect="prefer", w=start(0.0, fixed=True), phi=start(0.0, fixed=True)),
        rotor1D5=multibody.Rotor1D(J=1.0, stateSelect="prefer", a=start(0.0, fixed=True), w=start(0.0, fixed=True),
            phi=start(0.0, fixed=True)),
        rotor1D6=multibody.Rotor1D(J=1.0, stateSelect="prefer", w=start(0.0, fixed=True)),
        spring=rotational.Spring(c=10000.0),
        rotor1D7=multibody.Rotor1D(J=1.0, a=start(0.0523598775598, fixed=True), stateSelect="prefer",
            w=start(0.0349065850399, fixed=True), phi=start(0.0174532925199, fixed=True)),
        rotor1D8=multibody.Rotor1D(J=1.0, stateSelect="prefer", w=start(0.0, fixed=True)),
        spring1=rotational.Spring(c=10000.0),
        rotor1D9=multibody.Rotor1D(J=1.0, a=start(0.0523598775598, fixed=True), w=start(0.0349065850399, fixed=True),
            phi=start(0.0174532925199, fixed=True)),
        rotor1D10=multibody.Rotor1D(J=1.0, stateSelect="prefer", w=start(0.0, fixed=True)),
        spring2=rotational.Spring(c=10000.0),
    )  # fmt: skip


def absolute_sensor() -> Component:
    """MultiBody.Sensors.AbsoluteSensor with the box of its official trajectory."""
    return assemble(
        "world.frame_b - rev.frame_a - sensor_world2.frame_resolve", "damper.flange_b - rev.axis",
        "rev.support - damper.flange_a", "rev.frame_b - rev1.frame_a", "damper1.flange_b - rev1.axis",
        "rev1.support - damper1.flange_a", "rev1.frame_b - box.frame_a - sensor_frame_a2.frame_resolve",
        "box.frame_b - sensor_frame_a1.frame_a - sensor_world1.frame_a - sensor_frame_a2.frame_a",
        "box.frame_b - sensor_world2.frame_a",
        world=inner(multibody.World(gravityType="UniformGravity")),
        rev=multibody.Revolute(n=(0.0, 0.0, 1.0), useAxisFlange=True, phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True)),
        rev1=multibody.Revolute(n=(1.0, 0.0, 0.0), useAxisFlange=True, phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True)), damper=rotational.Damper(d=0.1), damper1=rotational.Damper(d=0.1),
        box=multibody.BodyBox(r=(1.0, 0.0, 0.0)),
        sensor_frame_a1=multibody.AbsoluteSensor(get_angles=True, resolveInFrame="frame_a", get_r=True, get_v=True,
            get_a=True, get_w=True, get_z=True),
        sensor_frame_a2=multibody.AbsoluteSensor(get_angles=True, resolveInFrame="frame_resolve", get_r=True,
            get_v=True, get_a=True, get_w=True, get_z=True),
        sensor_world1=multibody.AbsoluteSensor(get_angles=True, resolveInFrame="world", get_r=True, get_v=True,
            get_a=True, get_w=True, get_z=True),
        sensor_world2=multibody.AbsoluteSensor(get_angles=True, resolveInFrame="frame_resolve", get_r=True, get_v=True,
            get_a=True, get_w=True, get_z=True),
    )  # fmt: skip


def distance() -> Component:
    """MultiBody.Sensors.Distance."""
    return assemble(
        "world.frame_b - rev.frame_a", "damper.flange_b - rev.axis", "rev.support - damper.flange_a",
        "rev.frame_b - BodyBox1.frame_a", "Distance1.frame_b - BodyBox1.frame_b", "Distance1.frame_a - fixed.frame_b",
        "Der1.y - Der2.u", "Distance1.distance - Der1.u",
        world=inner(multibody.World(gravityType="UniformGravity")),
        rev=multibody.Revolute(n=(0.0, 0.0, 1.0), useAxisFlange=True, phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True)), damper=rotational.Damper(d=0.1), fixed=multibody.Fixed(r=(0.0, -1.0, 0.0)),
        Distance1=multibody.Distance(), BodyBox1=multibody.BodyBox(r=(0.5, 0.0, 0.0)), Der1=blocks.Der(),
        Der2=blocks.Der(),
    )  # fmt: skip


def distance2() -> Component:
    """MultiBody.Sensors.Distance2."""
    return assemble(
        "world.frame_b - Revolute1.frame_a - distance2.frame_a",
        "Revolute1.frame_b - BodyBox1.frame_a - distance2.frame_b", "BodyBox1.frame_b - distance1.frame_a",
        "distance1.frame_b - fixed.frame_b", "distance1.distance - Der1.u - LessEqualThreshold1.u",
        world=inner(multibody.World()),
        Revolute1=multibody.Revolute(phi=start(0.523598775598, fixed=True), w=start(0.0, fixed=True)),
        BodyBox1=multibody.BodyBox(r=(1.0, 0.0, 0.0), width=0.08), fixed=multibody.Fixed(r=(1.0, 0.0, 0.0)),
        distance1=multibody.Distance(), Der1=blocks.Der(), LessEqualThreshold1=blocks.LessEqualThreshold(),
        distance2=multibody.Distance(),
    )  # fmt: skip


def angular_velocity() -> Component:
    """MultiBody.Frames.AngularVelocity."""
    return assemble(
        "bar2.frame_a - world.frame_b - spring1.frame_a", "spring1.frame_b - body.frame_a",
        "spring2.frame_b - body.frame_b - FrameTorque1.frame_b", "bar2.frame_b - spring2.frame_a",
        "Constant1_1.y - FrameTorque1.torque[0]", "Constant1_2.y - FrameTorque1.torque[1]",
        "Constant1_3.y - FrameTorque1.torque[2]",
        world=inner(multibody.World()), bar2=multibody.FixedTranslation(r=(0.8, 0.0, 0.0)),
        spring1=multibody.Spring(c=20.0, s_unstretched=0.0),
        body=multibody.BodyShape(m=1.0, I_11=1.0, I_22=1.0, I_33=1.0, r=(0.4, 0.0, 0.0), r_CM=(0.2, 0.0, 0.0),
            angles_start=(0.174532925199, 0.174532925199, 0.174532925199), angles_fixed=True,
            r_0=start((0.2, -0.5, 0.1), fixed=True), v_0=start((0.0, 0.0, 0.0), fixed=True), w_0_fixed=True,
            z_0_fixed=False), spring2=multibody.Spring(c=20.0, s_unstretched=0.0),
        FrameTorque1=multibody.WorldTorque(resolveInFrame="frame_b"), Constant1_1=blocks.Constant(k=10.0),
        Constant1_2=blocks.Constant(k=0.0), Constant1_3=blocks.Constant(k=0.0),
    )  # fmt: skip


def spherical_double_pendulum() -> Component:
    """MultiBody.SphericalDoublePendulum."""
    return assemble(
        "boxBody1.frame_b - Spherical2.frame_a", "Spherical2.frame_b - boxBody2.frame_a",
        "world.frame_b - Spherical1.frame_a - Spherical3.frame_a - Spherical5.frame_a",
        "Spherical1.frame_b - boxBody1.frame_a", "boxBody3.frame_b - Spherical4.frame_a",
        "Spherical4.frame_b - boxBody4.frame_a", "Spherical3.frame_b - boxBody3.frame_a",
        "boxBody5.frame_b - Spherical6.frame_a", "Spherical6.frame_b - boxBody6.frame_a",
        "Spherical5.frame_b - boxBody5.frame_a",
        world=inner(multibody.World()), boxBody1=multibody.BodyBox(width=0.06, r=(0.4, 0.0, -0.3)),
        boxBody2=multibody.BodyBox(width=0.06, r=(0.3, -0.4, 0.0)),
        Spherical1=multibody.Spherical(enforceStates=True, useQuaternions=False, angles_fixed=True, w_rel_a_fixed=True,
            z_rel_a_fixed=False, w_rel_a_start=(0.0523598775598, 0.0349065850399, 0.0174532925199)),
        Spherical2=multibody.Spherical(enforceStates=True, useQuaternions=False, angles_fixed=True, w_rel_a_fixed=True,
            z_rel_a_fixed=False), boxBody3=multibody.BodyBox(width=0.06, r=(0.4, 0.0, -0.3)),
        boxBody4=multibody.BodyBox(width=0.06, r=(0.3, -0.4, 0.0)),
        Spherical3=multibody.Spherical(enforceStates=True, angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False,
            w_rel_a_start=(0.0523598775598, 0.0349065850399, 0.0174532925199)),
        Spherical4=multibody.Spherical(enforceStates=True, angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False),
        boxBody5=multibody.BodyBox(width=0.06, r=(0.4, 0.0, -0.3), useQuaternions=True),
        boxBody6=multibody.BodyBox(width=0.06, r=(0.3, -0.4, 0.0), useQuaternions=True),
        Spherical5=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False,
            w_rel_a_start=(0.0523598775598, 0.0349065850399, 0.0174532925199)),
        Spherical6=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, z_rel_a_fixed=False),
    )  # fmt: skip
