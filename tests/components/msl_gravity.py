"""Examples of Modelica.Mechanics.MultiBody.Examples.Elementary: gravity of a point, and a start in equilibrium."""

from __future__ import annotations

from collections.abc import Sequence

from acausal import Component, inner
from acausal.components import multibody, rotational
from acausal.components.examples import assemble, start

ARMS = {
    f"fixedTranslation{name}": multibody.FixedTranslation(r=r)
    for name, r in {
        "": (1.0, 0.0, 0.0), "1": (-1.0, 0.0, 0.0), "2": (0.0, 1.0, 0.0), "3": (0.0, -1.0, 0.0), "4": (0.0, 0.0, 1.0),
        "5": (0.0, 0.0, -1.0),
    }.items()
}  # fmt: skip
MIDDLE = " - ".join(f"{name}.frame_a" for name in ARMS)
ENDS = tuple(f"{name}.frame_b - pointMass{k}.frame_a" for k, name in enumerate(ARMS, start=1))


def init_spring_constant() -> Component:
    """InitSpringConstant: the constant of the spring is found such that the pendulum rests where it is."""
    return assemble(
        "world.frame_b - rev.frame_a", "damper.flange_b - rev.axis", "rev.support - damper.flange_a",
        "rev.frame_b - body.frame_a", "fixed.frame_b - spring.frame_a", "body.frame_b - spring.frame_b",
        world=inner(multibody.World()), damper=rotational.Damper(d=0.1),
        rev=multibody.Revolute(useAxisFlange=True, n=(0.0, 0.0, 1.0), phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True), a=start(0.0, fixed=True)),
        body=multibody.BodyShape(r=(1.0, 0.0, 0.0), r_CM=(0.5, 0.0, 0.0), m=1.0),
        fixed=multibody.Fixed(r=(1.0, 0.2, 0.0)),
        spring=multibody.Spring(s_unstretched=0.1, c=start(100.0, fixed=False)),
    )  # fmt: skip


def point_gravity() -> Component:
    """PointGravity."""

    def body(r: Sequence[float], v: Sequence[float]) -> multibody.Body:
        return multibody.Body(
            m=1.0, I_11=0.1, I_22=0.1, I_33=0.1, r_CM=(0.0, 0.0, 0.0), r_0=start(r, fixed=True),
            v_0=start(v, fixed=True), angles_fixed=True, w_0_fixed=True,
        )  # fmt: skip

    return assemble(
        world=inner(multibody.World(mu=1.0, gravityType="PointGravity")),
        body1=body((0.0, 0.6, 0.0), (1.0, 0.0, 0.0)), body2=body((0.6, 0.6, 0.0), (0.6, 0.0, 0.0)),
    )  # fmt: skip


def with_standard_bodies() -> Component:
    """PointGravityWithPointMasses2.SystemWithStandardBodies."""

    def body(**more: object) -> multibody.Body:
        return multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0), I_11=0.0, I_22=0.0, I_33=0.0, **more)

    first = body(
        r_0=start((3.0, 0.0, 0.0), fixed=True), v_0=start((0.0, 0.0, -1.0), fixed=True), angles_fixed=True,
        w_0_fixed=True,
    )  # fmt: skip
    others = {f"pointMass{k}": body() for k in range(2, 7)}
    return assemble(MIDDLE, *ENDS, pointMass1=first, **others, **ARMS)


def point_gravity_with_point_masses2() -> Component:
    """PointGravityWithPointMasses2: six point masses, joined rigidly; their orientation is that of the joint."""

    def mass(r: Sequence[float], fixed: Sequence[bool]) -> multibody.PointMass:
        v = (0.0, 0.0, -1.0)
        return multibody.PointMass(
            m=1.0, r_0=[start(x, fixed=f) for x, f in zip(r, fixed, strict=True)],
            v_0=[start(x, fixed=f) for x, f in zip(v, fixed, strict=True)],
        )  # fmt: skip

    return assemble(
        MIDDLE, *ENDS, "world.frame_b - freeMotion.frame_a", "freeMotion.frame_b - fixedTranslation1.frame_a",
        world=inner(multibody.World(mu=5.0, gravityType="PointGravity")),
        pointMass1=mass((3.0, 0.0, 0.0), (True, True, True)), pointMass2=multibody.PointMass(m=1.0),
        pointMass3=mass((2.0, 1.0, 0.0), (True, False, False)), pointMass4=mass((2.0, -1.0, 0.0), (False, False, True)),
        pointMass5=mass((2.0, 0.0, 1.0), (False, False, True)), pointMass6=multibody.PointMass(m=1.0),
        freeMotion=multibody.FreeMotion(), referenceSystem=with_standard_bodies(), **ARMS,
    )  # fmt: skip
