"""Examples of Modelica.Mechanics.MultiBody.Examples.Constraints 4.0, from library components."""

from __future__ import annotations

from typing import Any

from acausal import Component, inner
from acausal.components import multibody
from acausal.components.examples import assemble, start

AT_THE_BODIES = ("bodyOfConstraint.frame_b - springOfConstraint.frame_b", "bodyOfJoint.frame_b - springOfJoint.frame_b")
"""The springs, where they are fixed at the bodies themselves."""


def compared(*connections: str, sensor: dict[str, Any] | None = None, **parts: Component) -> Component:
    """Two equal bodies on springs, of which one is held by a joint and the other one by a constraint."""
    body: dict[str, Any] = {
        "m": 1.0, "I_11": 1.0, "I_22": 1.0, "I_33": 1.0, "r": (0.4, 0.0, 0.0), "r_CM": (0.2, 0.0, 0.0),
        "angles_start": (0.17453292519943, 0.95993108859688, 1.1868238913561),
    }  # fmt: skip
    place = (0.2, -0.5, 0.1)
    return assemble(
        "fixedTranslation.frame_a - world.frame_b", "world.frame_b - fixedRotation.frame_a",
        "fixedRotation.frame_b - constraint.frame_a", "constraint.frame_a - sensorConstraintRelative.frame_a",
        "sensorConstraintRelative.frame_b - constraint.frame_b", "fixedTranslation.frame_b - springOfJoint.frame_a",
        "fixedTranslation.frame_b - springOfConstraint.frame_a", "bodyOfConstraint.frame_a - constraint.frame_b",
        "freeMotionScalarInit.frame_a - fixedRotation.frame_b",
        "freeMotionScalarInit.frame_b - bodyOfConstraint.frame_a", *connections,
        sensorConstraintRelative=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_r_rel=True, get_a_rel=False, get_angles=True, **(sensor or {})
        ),
        bodyOfJoint=multibody.BodyShape(**body, r_0=start(place, fixed=False), angles_fixed=False, w_0_fixed=False),
        bodyOfConstraint=multibody.BodyShape(**body, r_0=start(place)),
        springOfJoint=multibody.Spring(c=20.0, s_unstretched=0.0),
        springOfConstraint=multibody.Spring(c=20.0, s_unstretched=0.0), world=inner(multibody.World()),
        fixedRotation=multibody.FixedRotation(
            r=(0.2, -0.3, 0.2), rotationType="PlanarRotationSequence", angles=(10.0, 55.0, 68.0)
        ),
        fixedTranslation=multibody.FixedTranslation(r=(0.8, 0.0, 0.3)), **parts,
    )  # fmt: skip


def prismatic_constraint() -> Component:
    """MultiBody.Examples.Constraints.PrismaticConstraint."""
    rest = start(0.0, fixed=True)
    return compared(
        *AT_THE_BODIES, "jointPrismatic_x.frame_b - jointPrismatic_y.frame_a",
        "fixedRotation.frame_b - jointPrismatic_x.frame_a", "bodyOfJoint.frame_a - jointPrismatic_y.frame_b",
        jointPrismatic_x=multibody.Prismatic(stateSelect="always", n=(1.0, 0.0, 0.0), s=rest, v=rest),
        jointPrismatic_y=multibody.Prismatic(stateSelect="always", n=(0.0, 1.0, 0.0), s=rest, v=rest),
        constraint=multibody.constraints.Prismatic(x_locked=False, y_locked=False),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_r=True, use_v=True, v_rel_a_2=rest, v_rel_a_3=rest, use_w=True,
            r_rel_a_1=rest, v_rel_a_1=rest,  # Modelica leaves the free translations to the tool
            r_rel_a_2=rest, r_rel_a_3=rest,
        ),
    )  # fmt: skip


def revolute_constraint() -> Component:
    """MultiBody.Examples.Constraints.RevoluteConstraint."""
    rest = start(0.0, fixed=True)
    return compared(
        *AT_THE_BODIES, "joint.frame_b - bodyOfJoint.frame_a", "joint.frame_a - fixedRotation.frame_b",
        joint=multibody.Revolute(stateSelect="always", n=(0.0, 1.0, 0.0), phi=rest, w=rest),
        constraint=multibody.constraints.Revolute(n=(0.0, 1.0, 0.0)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True, use_angle_d=True, angle_2=rest, angle_d_2=rest
        ),
    )  # fmt: skip


def spherical_constraint() -> Component:
    """MultiBody.Examples.Constraints.SphericalConstraint."""
    rest = start(0.0, fixed=True)
    return compared(
        *AT_THE_BODIES, "joint.frame_b - bodyOfJoint.frame_a", "joint.frame_a - fixedRotation.frame_b",
        joint=multibody.Spherical(angles_fixed=True, w_rel_a_fixed=True, enforceStates=True),
        constraint=multibody.constraints.Spherical(),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True, use_angle_d=True, angle_1=rest, angle_2=rest, angle_3=rest, angle_d_1=rest, angle_d_2=rest,
            angle_d_3=rest,
        ),
    )  # fmt: skip


def universal_constraint() -> Component:
    """MultiBody.Examples.Constraints.UniversalConstraint."""
    rest = start(0.0, fixed=True)
    return compared(
        "joint.frame_b - bodyOfJoint.frame_a", "joint.frame_a - fixedRotation.frame_b",
        "bodyOfJoint.frame_b - fixedTranslationOfJoint.frame_a",
        "bodyOfConstraint.frame_b - fixedTranslationOfConstraint.frame_a",
        "springOfJoint.frame_b - fixedTranslationOfJoint.frame_b",
        "springOfConstraint.frame_b - fixedTranslationOfConstraint.frame_b",
        sensor={"sequence": (3.0, 2.0, 1.0)},
        joint=multibody.Universal(
            n_a=(0.0, 0.0, 1.0), n_b=(1.0, 0.0, 0.0), stateSelect="always", phi_a=rest, phi_b=rest, w_a=rest, w_b=rest
        ),
        constraint=multibody.constraints.Universal(n_a=(0.0, 0.0, 1.0), n_b=(1.0, 0.0, 0.0)),
        fixedTranslationOfJoint=multibody.FixedTranslation(r=(0.1, 0.15, 0.2)),
        fixedTranslationOfConstraint=multibody.FixedTranslation(r=(0.1, 0.15, 0.2)),
        freeMotionScalarInit=multibody.FreeMotionScalarInit(
            use_angle=True, use_angle_d=True, angle_1=rest, angle_3=rest, angle_d_1=rest, angle_d_3=rest,
            sequence_start=(1.0, 2.0, 3.0),
        ),
    )  # fmt: skip
