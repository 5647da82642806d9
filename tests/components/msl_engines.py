"""V6 engines of Modelica.Mechanics.MultiBody.Examples.Loops 4.0: six planar loops, cut or solved in closed form."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np

from acausal import Component, Equations, Parameter, connect, cos, inner, sin, start, vector
from acausal.components import blocks, multibody, rotational
from acausal.components.examples import assemble

from .msl_mechanisms import GasForce

X, DOWN = (1.0, 0.0, 0.0), (0.0, -1.0, 0.0)


class PartialCylinder(Component, partial=True):
    """Between two cranks and two cylinders: the connectors of one cylinder of an engine."""

    cylinder_a: multibody.Frame = multibody.Frame()
    cylinder_b: multibody.Frame = multibody.Frame()
    crank_a: multibody.Frame = multibody.Frame()
    crank_b: multibody.Frame = multibody.Frame()


def turned(angle: Any, **more: Any) -> multibody.FixedRotation:
    """Turned by an angle [rad] about the x axis."""
    n_y = vector(0.0, cos(angle), sin(angle))
    return multibody.FixedRotation(rotationType="TwoAxesVectors", n_y=n_y, **more)


def box(r: tuple[float, float, float]) -> multibody.BodyBox:
    return multibody.BodyBox(r=r, height=0.05, width=0.02, widthDirection=X)


class Cylinder(PartialCylinder):
    """Utilities.Cylinder: one hinge is replaced by a constraint in the plane."""

    cylinderInclinationAngle: Parameter = Parameter(0.0, unit="rad")
    crankAngleOffset: Parameter = Parameter(0.0, unit="rad")
    piston: multibody.BodyCylinder = multibody.BodyCylinder(diameter=0.1, r=(0.0, 0.1, 0.0))
    connectingRod: multibody.BodyBox = multibody.BodyBox(
        widthDirection=X, height=0.06, width=0.02, r_shape=(0.0, -0.02, 0.0), r=(0.0, 0.2, 0.0)
    )
    b2: multibody.Revolute = multibody.Revolute(n=X)
    crank4: multibody.BodyBox = box((0.0, -0.1, 0.0))
    crank3: multibody.BodyCylinder = multibody.BodyCylinder(
        r_shape=(-0.01, 0.0, 0.0), length=0.12, diameter=0.03, r=(0.1, 0.0, 0.0)
    )
    crank1: multibody.BodyCylinder = multibody.BodyCylinder(
        diameter=0.05, r_shape=(-0.01, 0.0, 0.0), length=0.12, r=(0.1, 0.0, 0.0)
    )
    crank2: multibody.BodyBox = box((0.0, 0.1, 0.0))
    b1: multibody.RevolutePlanarLoopConstraint = multibody.RevolutePlanarLoopConstraint(n=X)
    mid: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.05, 0.0, 0.0))
    cylinder: multibody.Prismatic = multibody.Prismatic(useAxisFlange=True, s=start(-0.3), n=DOWN)
    mounting: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.2, 0.0, 0.0))
    cylinderInclination: multibody.FixedRotation = turned(cylinderInclinationAngle, r=(0.15, 0.0, 0.0))
    crankAngle1: multibody.FixedRotation = turned(crankAngleOffset)
    crankAngle2: multibody.FixedRotation = turned(-crankAngleOffset)
    cylinderTop: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.0, 0.42, 0.0))
    gasForce: GasForce = GasForce(L=0.22, d=0.1)

    def equations(self) -> Equations:
        yield connect(self.b1.frame_a, self.mid.frame_b)
        yield connect(self.connectingRod.frame_a, self.b1.frame_b)
        yield connect(self.cylinder.frame_b, self.piston.frame_b)
        yield connect(self.crank1.frame_a, self.crankAngle1.frame_b)
        yield connect(self.b2.frame_a, self.piston.frame_a)
        yield connect(self.connectingRod.frame_b, self.b2.frame_b)
        yield connect(self.crank4.frame_b, self.crankAngle2.frame_a)
        yield connect(self.cylinderInclination.frame_b, self.cylinderTop.frame_a)
        yield connect(self.crank1.frame_b, self.crank2.frame_a)
        yield connect(self.crank3.frame_b, self.crank4.frame_a)
        yield connect(self.crank3.frame_a, self.crank2.frame_b, self.mid.frame_a)
        yield connect(self.cylinderTop.frame_b, self.cylinder.frame_a)
        yield connect(self.cylinderInclination.frame_a, self.cylinder_a, self.mounting.frame_a)
        yield connect(self.mounting.frame_b, self.cylinder_b)
        yield connect(self.crankAngle1.frame_a, self.crank_a)
        yield connect(self.crankAngle2.frame_b, self.crank_b)
        yield connect(self.cylinder.axis, self.gasForce.flange_b)
        yield connect(self.cylinder.support, self.gasForce.flange_a)


class CylinderAnalytic(PartialCylinder):
    """Utilities.CylinderBase: piston and rod by a JointRRP."""

    cylinderInclinationAngle: Parameter = Parameter(0.0)
    crankAngleOffset: Parameter = Parameter(0.0)
    mid: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.09, 0.05, 0.0))
    mounting: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.14, 0.0, 0.0))
    cylinderInclination: multibody.FixedRotation = multibody.FixedRotation(
        r=(0.09, 0.0, 0.0), n=X, angle=cylinderInclinationAngle
    )
    crankAngle: multibody.FixedRotation = multibody.FixedRotation(n=X, angle=crankAngleOffset)
    jointRRP: multibody.JointRRP = multibody.JointRRP(
        n_a=X, n_b=DOWN, rRod1_ia=(0.0, 0.175, 0.0), rRod2_ib=(0.0, -0.1, 0.0), s_offset=-0.42
    )
    connectingRod: multibody.BodyShape = multibody.BodyShape(
        r=(0.0, 0.175, 0.0), r_CM=(0.0, 0.0875, 0.0), m=1.0, I_11=0.006, I_22=0.0005, I_33=0.006
    )
    piston: multibody.BodyShape = multibody.BodyShape(
        r=(0.0, 0.1, 0.0), r_CM=(0.0, 0.05, 0.0), m=6.0, I_11=0.0088, I_22=0.0076, I_33=0.0088
    )
    gasForce: GasForce = GasForce(L=0.195, d=0.1)
    crank: multibody.FixedTranslation = multibody.FixedTranslation(r=(0.14, 0.0, 0.0))

    def equations(self) -> Equations:
        joint = self.jointRRP
        yield connect(joint.frame_ia, self.connectingRod.frame_a)
        yield connect(self.mid.frame_b, joint.frame_a)
        yield connect(joint.frame_ib, self.piston.frame_b)
        yield connect(joint.frame_b, self.cylinderInclination.frame_b)
        yield connect(self.crankAngle.frame_b, self.mid.frame_a)
        yield connect(self.cylinder_a, self.cylinderInclination.frame_a, self.mounting.frame_a)
        yield connect(self.cylinder_b, self.mounting.frame_b)
        yield connect(self.crankAngle.frame_a, self.crank_a, self.crank.frame_a)
        yield connect(self.crank.frame_b, self.crank_b)
        yield connect(self.gasForce.flange_a, joint.bearing)
        yield connect(self.gasForce.flange_b, joint.axis)


INCLINED = (-30.0, 30.0, -30.0, 30.0, -30.0, 30.0)
OFFSET = (-30.0, 90.0, 210.0, 210.0, 90.0, -30.0)


def engine(cylinders: dict[str, Component], crank: multibody.BodyShape) -> Component:
    """Cylinders in a row, with a load."""
    names = list(cylinders)
    cranks = [f"{a}.crank_b - {b}.crank_a" for a, b in pairwise(names)]
    housings = [f"{a}.cylinder_b - {b}.cylinder_a" for a, b in pairwise(names)]
    return assemble(
        "bearing.frame_b - crank.frame_a", "crank.frame_b - cylinder1.crank_a",
        "world.frame_b - cylinder1.cylinder_a - bearing.frame_a",
        "load2.flange - load.flange_b", "torqueSensor.flange_b - load.flange_a", "torqueSensor.tau - filter.u",
        "torqueSensor.flange_a - bearing.axis", *cranks, *housings, world=inner(multibody.World()), crank=crank,
        bearing=multibody.Revolute(useAxisFlange=True, n=X),
        load=rotational.Inertia(phi=start(0.0, fixed=True), w=start(10.0, fixed=True), J=1.0),
        load2=rotational.QuadraticSpeedDependentTorque(tau_nominal=-100.0, w_nominal=200.0),
        torqueSensor=rotational.TorqueSensor(), filter=blocks.CriticalDamping(n=2, initType="SteadyState", f=5.0),
        **cylinders,
    )  # fmt: skip


def engine_v6() -> Component:
    """MultiBody.Examples.Loops.EngineV6."""
    cylinders: dict[str, Component] = {
        f"cylinder{k + 1}": Cylinder(cylinderInclinationAngle=np.deg2rad(a), crankAngleOffset=np.deg2rad(b))
        for k, (a, b) in enumerate(zip(INCLINED, OFFSET, strict=True))
    }
    return engine(cylinders, multibody.BodyShape(m=0.0, I_11=0.0, I_22=0.0, I_33=0.0))  # nothing


def engine_v6_analytic() -> Component:
    """MultiBody.Examples.Loops.EngineV6_analytic."""
    cylinders: dict[str, Component] = {
        f"cylinder{k + 1}": CylinderAnalytic(cylinderInclinationAngle=a, crankAngleOffset=b)
        for k, (a, b) in enumerate(zip(INCLINED, OFFSET, strict=True))
    }
    crank = multibody.BodyShape(r_CM=(0.3, 0.0, 0.0), m=180.0, I_11=0.1, I_22=1e-5, I_33=1e-5)
    return engine(cylinders, crank)
