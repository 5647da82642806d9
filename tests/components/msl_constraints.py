"""Examples of Modelica.Mechanics.MultiBody.Examples.Constraints 4.0, from library components."""

from __future__ import annotations

from acausal import Component, inner
from acausal.components import multibody
from acausal.components.examples import assemble, start


def prismatic_constraint() -> Component:
    """MultiBody.Examples.Constraints.PrismaticConstraint."""
    return assemble(
        "fixedTranslation.frame_a - world.frame_b",
        "bodyOfConstraint.frame_b - springOfConstraint.frame_b",
        "world.frame_b - fixedRotation.frame_a",
        "fixedRotation.frame_b - constraint.frame_a",
        "constraint.frame_a - sensorConstraintRelative.frame_a",
        "bodyOfJoint.frame_b - springOfJoint.frame_b",
        "sensorConstraintRelative.frame_b - constraint.frame_b",
        "fixedTranslation.frame_b - springOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfConstraint.frame_a",
        "bodyOfConstraint.frame_a - constraint.frame_b",
        "jointPrismatic_x.frame_b - jointPrismatic_y.frame_a",
        "fixedRotation.frame_b - jointPrismatic_x.frame_a",
        "bodyOfJoint.frame_a - jointPrismatic_y.frame_b",
        "freeMotionScalarInit.frame_a - fixedRotation.frame_b",
        "freeMotionScalarInit.frame_b - bodyOfConstraint.frame_a",
        jointPrismatic_x=multibody.Prismatic(
            stateSelect="always", n=(1.0, 0.0, 0.0), s=start(0.0, fixed=True), v=start(0.0, fixed=True)
        ),
        jointPrismatic_y=multibody.Prismatic(
            stateSelect="always", n=(0.0, 1.0, 0.0), s=start(0.0, fixed=True), v=start(0.0, fixed=True)
        ),
        constraint=multibody.constraints.Prismatic(x_locked=False, y_locked=False),
        sensorConstraintRelative=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_r_rel=True, get_a_rel=False, get_angles=True
        ),
        bodyOfJoint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1), fixed=False),
            angles_fixed=False,
            w_0_fixed=False,
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        bodyOfConstraint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1)),
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        springOfJoint=multibody.Spring(c=20.0, s_unstretched=0.0),
        springOfConstraint=multibody.Spring(c=20.0, s_unstretched=0.0),
        world=inner(multibody.World()),
        fixedRotation=multibody.FixedRotation(
            r=(0.2, -0.3, 0.2), rotationType="PlanarRotationSequence", angles=(10.0, 55.0, 68.0)
        ),
        fixedTranslation=multibody.FixedTranslation(r=(0.8, 0.0, 0.3)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_r=True,
            use_v=True,
            v_rel_a_2=start(0.0, fixed=True),
            v_rel_a_3=start(0.0, fixed=True),
            use_w=True,
            r_rel_a_1=start(0.0, fixed=True),  # Modelica leaves the free translations to the tool
            v_rel_a_1=start(0.0, fixed=True),
            r_rel_a_2=start(0.0, fixed=True),
            r_rel_a_3=start(0.0, fixed=True),
        ),
    )


def revolute_constraint() -> Component:
    """MultiBody.Examples.Constraints.RevoluteConstraint."""
    return assemble(
        "fixedTranslation.frame_a - world.frame_b",
        "bodyOfConstraint.frame_b - springOfConstraint.frame_b",
        "world.frame_b - fixedRotation.frame_a",
        "fixedRotation.frame_b - constraint.frame_a",
        "constraint.frame_a - sensorConstraintRelative.frame_a",
        "bodyOfJoint.frame_b - springOfJoint.frame_b",
        "joint.frame_b - bodyOfJoint.frame_a",
        "sensorConstraintRelative.frame_b - constraint.frame_b",
        "fixedTranslation.frame_b - springOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfConstraint.frame_a",
        "bodyOfConstraint.frame_a - constraint.frame_b",
        "joint.frame_a - fixedRotation.frame_b",
        "freeMotionScalarInit.frame_a - fixedRotation.frame_b",
        "bodyOfConstraint.frame_a - freeMotionScalarInit.frame_b",
        joint=multibody.Revolute(
            stateSelect="always", n=(0.0, 1.0, 0.0), phi=start(0.0, fixed=True), w=start(0.0, fixed=True)
        ),
        constraint=multibody.constraints.Revolute(n=(0.0, 1.0, 0.0)),
        sensorConstraintRelative=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_r_rel=True, get_a_rel=False, get_angles=True
        ),
        bodyOfJoint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1), fixed=False),
            angles_fixed=False,
            w_0_fixed=False,
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        bodyOfConstraint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1)),
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        springOfJoint=multibody.Spring(c=20.0, s_unstretched=0.0),
        springOfConstraint=multibody.Spring(c=20.0, s_unstretched=0.0),
        world=inner(multibody.World()),
        fixedRotation=multibody.FixedRotation(
            r=(0.2, -0.3, 0.2), rotationType="PlanarRotationSequence", angles=(10.0, 55.0, 68.0)
        ),
        fixedTranslation=multibody.FixedTranslation(r=(0.8, 0.0, 0.3)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True, use_angle_d=True, angle_2=start(0.0, fixed=True), angle_d_2=start(0.0, fixed=True)
        ),
    )


def spherical_constraint() -> Component:
    """MultiBody.Examples.Constraints.SphericalConstraint."""
    return assemble(
        "fixedTranslation.frame_a - world.frame_b",
        "bodyOfConstraint.frame_b - springOfConstraint.frame_b",
        "world.frame_b - fixedRotation.frame_a",
        "fixedRotation.frame_b - constraint.frame_a",
        "constraint.frame_a - sensorConstraintRelative.frame_a",
        "bodyOfJoint.frame_b - springOfJoint.frame_b",
        "joint.frame_b - bodyOfJoint.frame_a",
        "sensorConstraintRelative.frame_b - constraint.frame_b",
        "fixedTranslation.frame_b - springOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfConstraint.frame_a",
        "bodyOfConstraint.frame_a - constraint.frame_b",
        "joint.frame_a - fixedRotation.frame_b",
        "bodyOfConstraint.frame_a - freeMotionScalarInit.frame_b",
        "freeMotionScalarInit.frame_a - fixedRotation.frame_b",
        joint=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, enforceStates=True),
        constraint=multibody.constraints.Spherical(),
        sensorConstraintRelative=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_r_rel=True, get_a_rel=False, get_angles=True
        ),
        bodyOfJoint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1), fixed=False),
            angles_fixed=False,
            w_0_fixed=False,
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        bodyOfConstraint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1)),
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        springOfJoint=multibody.Spring(c=20.0, s_unstretched=0.0),
        springOfConstraint=multibody.Spring(c=20.0, s_unstretched=0.0),
        world=inner(multibody.World()),
        fixedRotation=multibody.FixedRotation(
            r=(0.2, -0.3, 0.2), rotationType="PlanarRotationSequence", angles=(10.0, 55.0, 68.0)
        ),
        fixedTranslation=multibody.FixedTranslation(r=(0.8, 0.0, 0.3)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True,
            use_angle_d=True,
            angle_1=start(0.0, fixed=True),
            angle_2=start(0.0, fixed=True),
            angle_3=start(0.0, fixed=True),
            angle_d_1=start(0.0, fixed=True),
            angle_d_2=start(0.0, fixed=True),
            angle_d_3=start(0.0, fixed=True),
        ),
    )


def universal_constraint() -> Component:
    """MultiBody.Examples.Constraints.UniversalConstraint."""
    return assemble(
        "fixedTranslation.frame_a - world.frame_b",
        "world.frame_b - fixedRotation.frame_a",
        "fixedRotation.frame_b - constraint.frame_a",
        "constraint.frame_a - sensorConstraintRelative.frame_a",
        "joint.frame_b - bodyOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfConstraint.frame_a",
        "bodyOfConstraint.frame_a - constraint.frame_b",
        "joint.frame_a - fixedRotation.frame_b",
        "bodyOfJoint.frame_b - fixedTranslationOfJoint.frame_a",
        "bodyOfConstraint.frame_b - fixedTranslationOfConstraint.frame_a",
        "springOfJoint.frame_b - fixedTranslationOfJoint.frame_b",
        "springOfConstraint.frame_b - fixedTranslationOfConstraint.frame_b",
        "fixedRotation.frame_b - freeMotionScalarInit.frame_a",
        "bodyOfConstraint.frame_a - freeMotionScalarInit.frame_b",
        "bodyOfConstraint.frame_a - sensorConstraintRelative.frame_b",
        joint=multibody.Universal(
            n_a=(0.0, 0.0, 1.0),
            n_b=(1.0, 0.0, 0.0),
            stateSelect="always",
            phi_a=start(0.0, fixed=True),
            phi_b=start(0.0, fixed=True),
            w_a=start(0.0, fixed=True),
            w_b=start(0.0, fixed=True),
        ),
        constraint=multibody.constraints.Universal(n_a=(0.0, 0.0, 1.0), n_b=(1.0, 0.0, 0.0)),
        sensorConstraintRelative=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_r_rel=True, get_a_rel=False, get_angles=True, sequence=(3.0, 2.0, 1.0)
        ),
        bodyOfJoint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1), fixed=False),
            angles_fixed=False,
            w_0_fixed=False,
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        bodyOfConstraint=multibody.BodyShape(
            m=1.0,
            I_11=1.0,
            I_22=1.0,
            I_33=1.0,
            r=(0.4, 0.0, 0.0),
            r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1)),
            angles_start=(0.17453292519943, 0.95993108859688, 1.1868238913561),
        ),
        springOfJoint=multibody.Spring(c=20.0, s_unstretched=0.0),
        springOfConstraint=multibody.Spring(c=20.0, s_unstretched=0.0),
        world=inner(multibody.World()),
        fixedRotation=multibody.FixedRotation(
            r=(0.2, -0.3, 0.2), rotationType="PlanarRotationSequence", angles=(10.0, 55.0, 68.0)
        ),
        fixedTranslation=multibody.FixedTranslation(r=(0.8, 0.0, 0.3)),
        fixedTranslationOfJoint=multibody.FixedTranslation(r=(0.1, 0.15, 0.2)),
        fixedTranslationOfConstraint=multibody.FixedTranslation(r=(0.1, 0.15, 0.2)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True,
            use_angle_d=True,
            angle_1=start(0.0, fixed=True),
            angle_3=start(0.0, fixed=True),
            angle_d_1=start(0.0, fixed=True),
            angle_d_3=start(0.0, fixed=True),
            sequence_start=(1.0, 2.0, 3.0),
        ),
    )
