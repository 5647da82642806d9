"""Examples of Modelica.Mechanics.MultiBody.Examples.Loops 4.0, from library components."""

from __future__ import annotations

from acausal import Component, inner
from acausal.components import blocks, multibody, rotational
from acausal.components.examples import assemble, start

from .msl_mechanisms import GasForce


def fourbar2() -> Component:
    """MultiBody.Examples.Loops.Fourbar2."""
    return assemble(
        "j2.frame_b - b2.frame_a",
        "j1.frame_b - b1.frame_a",
        "j1.frame_a - world.frame_b",
        "b1.frame_b - universalSpherical.frame_b",
        "universalSpherical.frame_a - b2.frame_b",
        "b3.frame_a - world.frame_b",
        "b3.frame_b - j2.frame_a",
        world=inner(multibody.World()),
        j1=multibody.Revolute(
            n=(1.0, 0.0, 0.0),
            stateSelect="always",
            phi=start(0.0, fixed=True),
            useAxisFlange=False,
            w=start(5.235987755983, fixed=True),
        ),
        j2=multibody.Prismatic(n=(1.0, 0.0, 0.0), s=start(-0.2, fixed=True)),
        b1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
        universalSpherical=multibody.UniversalSpherical(
            n1_a=(0.0, 1.0, 0.0), computeRodLength=True, rRod_ia=(-1.0, 0.3, 0.1)
        ),
        b3=multibody.FixedTranslation(r=(1.2, 0.0, 0.0)),
    )


def fourbar_analytic() -> Component:
    """MultiBody.Examples.Loops.Fourbar_analytic."""
    return assemble(
        "j1.frame_b - b1.frame_a",
        "j1.frame_a - world.frame_b",
        "b3.frame_a - world.frame_b",
        "b1.frame_b - jointSSP.frame_a",
        "b3.frame_b - jointSSP.frame_b",
        "b2.frame_a - jointSSP.frame_ib",
        world=inner(multibody.World()),
        j1=multibody.Revolute(
            n=(1.0, 0.0, 0.0),
            stateSelect="always",
            phi=start(0.0, fixed=True),
            useAxisFlange=False,
            w=start(5.235987755983, fixed=True),
        ),
        b1=multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05),
        b3=multibody.FixedTranslation(r=(1.2, 0.0, 0.0)),
        jointSSP=multibody.JointSSP(
            rod1Length=1.0488088481701516, n_b=(1.0, 0.0, 0.0), s_offset=-0.2, rRod2_ib=(0.0, 0.2, 0.0)
        ),
        b2=multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05),
    )


def planar_fourbar() -> Component:
    """MultiBody.Examples.Loops.PlanarFourbar."""
    return assemble(
        "revolute1.frame_b - body1.frame_a",
        "revolute2.frame_a - body1.frame_b",
        "revolute2.frame_b - body2.frame_a",
        "world.frame_b - revolute1.frame_a",
        "world.frame_b - body3.frame_a",
        "body3.frame_b - revolute3.frame_a",
        "revolute3.frame_b - body4.frame_a",
        "body4.frame_b - revolute4cut.frame_a",
        "body2.frame_b - revolute4cut.frame_b",
        "damper.flange_b - revolute1.axis",
        "revolute1.support - damper.flange_a",
        "sensorJoint4.frame_a - revolute4cut.frame_a",
        "sensorJoint4.frame_b - revolute4cut.frame_b",
        revolute1=multibody.Revolute(
            n=(0.0, 0.0, 1.0),
            stateSelect="always",
            phi=start(0.0, fixed=True),
            w=start(0.0, fixed=True),
            useAxisFlange=True,
        ),
        revolute2=multibody.Revolute(n=(0.0, 0.0, 1.0)),
        revolute3=multibody.Revolute(n=(0.0, 0.0, 1.0)),
        revolute4cut=multibody.RevolutePlanarLoopConstraint(),
        body1=multibody.BodyBox(width=0.05, r=(0.4, 0, 0)),
        body2=multibody.BodyBox(width=0.05, r=(0.1, 1.1, 0)),
        body3=multibody.BodyBox(width=0.05, r=(-0.15, 1.0, 0)),
        body4=multibody.BodyBox(width=0.05, r=(0.4 + 0.1 + 0.15, 1.1 - 1.0, 0)),
        world=inner(multibody.World()),
        damper=rotational.Damper(d=0.1),
        sensorJoint4=multibody.RelativeSensor(
            resolveInFrame="frame_a", get_w_rel=True, get_z_rel=True, get_angles=True, sequence=(1.0, 2.0, 3.0)
        ),
    )


def planar_loops_analytic() -> Component:
    """MultiBody.Examples.Loops.PlanarLoops_analytic."""
    return assemble(
        "world.frame_b - rev.frame_a",
        "rod1.frame_a - rev.frame_b",
        "rod1.frame_b - jointRRR1.frame_a",
        "rod2.frame_a - world.frame_b",
        "rod2.frame_b - jointRRR1.frame_b",
        "jointRRR1.frame_ia - body1.frame_a",
        "rod3.frame_a - rod2.frame_b",
        "rod3.frame_b - jointRRR2.frame_b",
        "jointRRR2.frame_ia - body2.frame_a",
        "jointRRR1.frame_im - jointRRR2.frame_a",
        "rod3.frame_b - rod4.frame_a",
        "rod4.frame_b - jointRRR3.frame_b",
        "jointRRR2.frame_im - jointRRR3.frame_a",
        "jointRRR3.frame_ia - body3.frame_a",
        "sine.y - position.phi_ref",
        "mounting1D.flange_b - position.support",
        "mounting1D.frame_a - world.frame_b",
        "position.flange - rev.axis",
        world=inner(multibody.World()),
        jointRRR1=multibody.JointRRR(rRod1_ia=(0.6, 0.0, 0.0), rRod2_ib=(0.1, 0.5, 0.0)),
        rev=multibody.Revolute(useAxisFlange=True, w=start(0.0, fixed=True)),
        rod1=multibody.FixedTranslation(r=(0.0, 0.5, 0.0)),
        rod2=multibody.FixedTranslation(r=(0.5, 0.0, 0.0)),
        body1=multibody.Body(m=1.0, r_CM=(0.3, 0, 0)),
        position=rotational.Position(useSupport=True),
        sine=blocks.Sine(amplitude=0.7, f=1.0),
        jointRRR2=multibody.JointRRR(rRod1_ia=(0.5, 0.09999999999999998, 0.0), rRod2_ib=(0.1, 0.6, 0.0)),
        rod3=multibody.FixedTranslation(r=(0.5, 0.0, 0.0)),
        body2=multibody.Body(m=1.0, r_CM=(0.25, 0.05, 0)),
        jointRRR3=multibody.JointRRR(rRod1_ia=(0.4, -0.04999999999999993, 0.0), rRod2_ib=(0.0, 0.55, 0.0)),
        rod4=multibody.FixedTranslation(r=(0.5, 0.0, 0.0)),
        body3=multibody.Body(m=1.0, r_CM=(0.2, -0.025, 0)),
        mounting1D=multibody.Mounting1D(),
    )


def engine1b_analytic() -> Component:
    """MultiBody.Examples.Loops.Engine1b_analytic."""
    return assemble(
        "world.frame_b - bearing.frame_a",
        "crank2.frame_a - crank1.frame_b",
        "bearing.frame_b - crank1.frame_a",
        "world.frame_b - cylPosition.frame_a",
        "crank3.frame_b - crank4.frame_a",
        "inertia.flange_b - bearing.axis",
        "crank2.frame_b - crank3.frame_a",
        "crank2.frame_b - mid.frame_a",
        "mid.frame_b - jointRRP.frame_a",
        "jointRRP.frame_b - cylPosition.frame_b",
        "gasForce.flange_a - jointRRP.bearing",
        "gasForce.flange_b - jointRRP.axis",
        "jointRRP.frame_ib - piston.frame_a",
        "connectingRod.frame_b - jointRRP.frame_ia",
        world=inner(multibody.World()),
        piston=multibody.BodyCylinder(diameter=0.1, r=(0.0, -0.1, 0.0)),
        connectingRod=multibody.BodyBox(widthDirection=(1.0, 0.0, 0.0), width=0.02, height=0.06, r=(0.0, -0.2, 0.0)),
        bearing=multibody.Revolute(useAxisFlange=True, n=(1.0, 0.0, 0.0)),
        inertia=rotational.Inertia(J=1.0, w=start(10.0, fixed=True), phi=start(0.0, fixed=True)),
        crank1=multibody.BodyCylinder(diameter=0.05, r=(0.1, 0.0, 0.0)),
        crank2=multibody.BodyBox(height=0.05, widthDirection=(1.0, 0.0, 0.0), width=0.02, r=(0.0, 0.1, 0.0)),
        crank3=multibody.BodyCylinder(r=(0.1, 0.0, 0.0), diameter=0.03),
        crank4=multibody.BodyBox(height=0.05, widthDirection=(1.0, 0.0, 0.0), width=0.02, r=(0.0, -0.1, 0.0)),
        mid=multibody.FixedTranslation(r=(0.05, 0.0, 0.0)),
        cylPosition=multibody.FixedTranslation(r=(0.15, 0.45, 0.0)),
        gasForce=GasForce(d=0.1, L=0.35),
        jointRRP=multibody.JointRRP(
            n_a=(1.0, 0.0, 0.0), n_b=(0.0, -1.0, 0.0), rRod1_ia=(0.0, 0.2, 0.0), rRod2_ib=(0.0, -0.1, 0.0)
        ),
    )
