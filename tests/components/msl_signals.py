"""The examples GenerationOfFMUs of Modelica.Mechanics.Rotational and .Translational: parts that exchange signals."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Parameter, connect
from acausal.components import blocks, rotational, translational
from acausal.components.examples import assemble, start


class DirectInertia(Component):
    """Rotational.Examples.Utilities.DirectInertia."""

    J: Parameter = Parameter(1.0, unit="kg*m2")
    tauDrive: Input = Input(unit="N*m")
    tau: Input = Input(unit="N*m")
    phi: Output = Output(unit="rad")
    w: Output = Output(unit="rad/s")
    a: Output = Output(unit="rad/s2")
    inertia: rotational.Inertia = rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    torqueSource: rotational.Torque = rotational.Torque()
    torqueToAngle: rotational.TorqueToAngleAdaptor = rotational.TorqueToAngleAdaptor()

    def equations(self) -> Equations:
        yield connect(self.tauDrive, self.torqueSource.tau)
        yield connect(self.torqueSource.flange, self.inertia.flange_a)
        yield connect(self.inertia.flange_b, self.torqueToAngle.flange)
        yield connect(self.torqueToAngle.phi, self.phi)
        yield connect(self.torqueToAngle.w, self.w)
        yield connect(self.torqueToAngle.a, self.a)
        yield connect(self.torqueToAngle.tau, self.tau)


class InverseInertia(Component):
    """Rotational.Examples.Utilities.InverseInertia."""

    J: Parameter = Parameter(1.0, unit="kg*m2")
    phi: Input = Input(unit="rad")
    w: Input = Input(unit="rad/s")
    a: Input = Input(unit="rad/s2")
    tau: Output = Output(unit="N*m")
    inertia: rotational.Inertia = rotational.Inertia(J=J)
    angleToTorque: rotational.AngleToTorqueAdaptor = rotational.AngleToTorqueAdaptor()

    def equations(self) -> Equations:
        yield connect(self.angleToTorque.flange, self.inertia.flange_a)
        yield connect(self.phi, self.angleToTorque.phi)
        yield connect(self.w, self.angleToTorque.w)
        yield connect(self.a, self.angleToTorque.a)
        yield connect(self.tau, self.angleToTorque.tau)


class ShaftSignals(Component):
    """Rotational.Examples.Utilities.SpringDamper; .Spring is the same without speeds."""

    shaft: rotational.PartialCompliant = rotational.SpringDamper(stateSelect="default")
    angleToTorque1: rotational.AngleToTorqueAdaptor = rotational.AngleToTorqueAdaptor(use_a=False)
    angleToTorque2: rotational.AngleToTorqueAdaptor = rotational.AngleToTorqueAdaptor(use_a=False)

    def equations(self) -> Equations:
        yield connect(self.angleToTorque1.flange, self.shaft.flange_a)
        yield connect(self.shaft.flange_b, self.angleToTorque2.flange)


class RodSignals(Component):
    """Translational.Examples.Utilities.SpringDamper; .Spring is the same without speeds."""

    shaft: translational.PartialCompliant = translational.SpringDamper(stateSelect="default")
    positionToForce1: translational.GeneralPositionToForceAdaptor = translational.GeneralPositionToForceAdaptor(
        use_pder2=False
    )
    positionToForce2: translational.GeneralPositionToForceAdaptor = translational.GeneralPositionToForceAdaptor(
        use_pder2=False
    )

    def equations(self) -> Equations:
        yield connect(self.positionToForce1.flange, self.shaft.flange_a)
        yield connect(self.shaft.flange_b, self.positionToForce2.flange)


class DirectMass(Component):
    """Translational.Examples.Utilities.DirectMass, with the signals of its adaptor."""

    m: Parameter = Parameter(1.0, unit="kg")
    mass: translational.Mass = translational.Mass(m=m, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    forceSource: translational.Force = translational.Force()
    forceToPosition: translational.GeneralForceToPositionAdaptor = translational.GeneralForceToPositionAdaptor()

    def equations(self) -> Equations:
        yield connect(self.forceSource.flange, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.forceToPosition.flange)


class InverseMass(Component):
    """Translational.Examples.Utilities.InverseMass, with the signals of its adaptor."""

    m: Parameter = Parameter(1.0, unit="kg")
    mass: translational.Mass = translational.Mass(m=m)
    positionToForce: translational.GeneralPositionToForceAdaptor = translational.GeneralPositionToForceAdaptor()

    def equations(self) -> Equations:
        yield connect(self.positionToForce.flange, self.mass.flange_a)


def turning(J: float) -> rotational.Inertia:
    return rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))


def sliding(m: float) -> translational.Mass:
    return translational.Mass(m=m, s=start(0.0, fixed=True), v=start(0.0, fixed=True))


def rotational_signals() -> Component:
    """Rotational.Examples.GenerationOfFMUs."""
    slow = rotational.AngleToTorqueAdaptor(use_w=False, use_a=False)
    return assemble(
        "sine1.y - directInertia.tauDrive - torque2.tau - force3.tau", "directInertia.phi - inverseInertia.phi",
        "directInertia.w - inverseInertia.w", "directInertia.a - inverseInertia.a",
        "inverseInertia.tau - directInertia.tau", "torque2.flange - inertia2a.flange_a",
        "inertia2a.flange_b - torqueToAngle2a.flange", "torqueToAngle2b.flange - inertia2b.flange_a",
        "force3.flange - inertia3a.flange_a", "inertia3a.flange_b - torqueToAngle3a.flange",
        "torqueToAngle3b.flange - inertia3b.flange_a", "torqueToAngle2a.phi - springDamper.angleToTorque1.phi",
        "torqueToAngle2a.w - springDamper.angleToTorque1.w", "torqueToAngle2a.tau - springDamper.angleToTorque1.tau",
        "torqueToAngle2b.phi - springDamper.angleToTorque2.phi", "torqueToAngle2b.w - springDamper.angleToTorque2.w",
        "torqueToAngle2b.tau - springDamper.angleToTorque2.tau", "torqueToAngle3a.phi - spring.angleToTorque1.phi",
        "torqueToAngle3a.tau - spring.angleToTorque1.tau", "torqueToAngle3b.phi - spring.angleToTorque2.phi",
        "torqueToAngle3b.tau - spring.angleToTorque2.tau",
        sine1=blocks.Sine(f=2.0, amplitude=10.0), directInertia=DirectInertia(J=1.1),
        inverseInertia=InverseInertia(J=2.2), inertia2a=turning(1.1), inertia2b=turning(2.2), inertia3a=turning(1.1),
        inertia3b=turning(2.2), torque2=rotational.Torque(), force3=rotational.Torque(),
        springDamper=ShaftSignals(shaft=rotational.SpringDamper(c=1e4, d=100.0, stateSelect="default")),
        torqueToAngle2a=rotational.TorqueToAngleAdaptor(use_a=False),
        torqueToAngle2b=rotational.TorqueToAngleAdaptor(use_a=False),
        spring=ShaftSignals(shaft=rotational.Spring(c=1e4), angleToTorque1=slow, angleToTorque2=slow),
        torqueToAngle3a=rotational.TorqueToAngleAdaptor(use_w=False, use_a=False),
        torqueToAngle3b=rotational.TorqueToAngleAdaptor(use_w=False, use_a=False),
    )  # fmt: skip


def translational_signals() -> Component:
    """Translational.Examples.GenerationOfFMUs."""
    slow = translational.GeneralPositionToForceAdaptor(use_pder=False, use_pder2=False)
    answers = {
        "forceToPosition2a": translational.GeneralForceToPositionAdaptor(use_pder2=False),
        "forceToPosition2b": translational.GeneralForceToPositionAdaptor(use_pder2=False),
        "forceToPosition3a": translational.GeneralForceToPositionAdaptor(use_pder=False, use_pder2=False),
        "forceToPosition3b": translational.GeneralForceToPositionAdaptor(use_pder=False, use_pder2=False),
    }
    return assemble(
        "sine1.y - directMass.forceSource.f - force2.f - force3.f",
        "directMass.forceToPosition.p - inverseMass.positionToForce.p",
        "directMass.forceToPosition.pder - inverseMass.positionToForce.pder",
        "directMass.forceToPosition.pder2 - inverseMass.positionToForce.pder2",
        "inverseMass.positionToForce.f - directMass.forceToPosition.f", "force2.flange - mass2a.flange_a",
        "mass2a.flange_b - forceToPosition2a.flange", "forceToPosition2b.flange - mass2b.flange_a",
        "force3.flange - mass3a.flange_a", "mass3a.flange_b - forceToPosition3a.flange",
        "forceToPosition3b.flange - mass3b.flange_a", "forceToPosition2a.p - springDamper.positionToForce1.p",
        "forceToPosition2a.pder - springDamper.positionToForce1.pder",
        "forceToPosition2a.f - springDamper.positionToForce1.f",
        "forceToPosition2b.p - springDamper.positionToForce2.p",
        "forceToPosition2b.pder - springDamper.positionToForce2.pder",
        "forceToPosition2b.f - springDamper.positionToForce2.f",
        "forceToPosition3a.p - spring.positionToForce1.p", "forceToPosition3a.f - spring.positionToForce1.f",
        "forceToPosition3b.p - spring.positionToForce2.p", "forceToPosition3b.f - spring.positionToForce2.f",
        sine1=blocks.Sine(f=2.0, amplitude=10.0), directMass=DirectMass(m=1.1), inverseMass=InverseMass(m=2.2),
        force2=translational.Force(), force3=translational.Force(), mass2a=sliding(1.1), mass2b=sliding(2.2),
        mass3a=sliding(1.1), mass3b=sliding(2.2),
        springDamper=RodSignals(shaft=translational.SpringDamper(c=1e4, d=100.0, stateSelect="default")),
        spring=RodSignals(shaft=translational.Spring(c=1e4), positionToForce1=slow, positionToForce2=slow),
        **answers,
    )  # fmt: skip
