"""Modelica.Mechanics.MultiBody.Examples.Systems.RobotR3.OneAxis: an axis of a robot with its motor and control.

The control bus of the original is left out: its signals are connected directly.
"""

from __future__ import annotations

import math

from acausal import Component, Equations, Input, Output, Parameter, Variable, connect, der
from acausal.components import blocks, electrical, rotational
from acausal.components.examples import assemble


class Motor(Component):
    """Utilities.Motor: the current is controlled by operational amplifiers; it starts in steady state."""

    J: Parameter = Parameter(0.0013, unit="kg*m2")
    k: Parameter = Parameter(1.1616, unit="N*m/A")
    w: Parameter = Parameter(4590.0)
    D: Parameter = Parameter(0.6)
    flange_motor: rotational.Flange = rotational.Flange()
    current_ref: Input = Input()
    motorAngle: Output = Output(unit="rad")
    motorSpeed: Output = Output(unit="rad/s")
    Vs: electrical.SignalVoltage = electrical.SignalVoltage()
    power: electrical.IdealOpAmp = electrical.IdealOpAmp()
    diff: electrical.IdealOpAmp = electrical.IdealOpAmp()
    OpI: electrical.IdealOpAmp = electrical.IdealOpAmp()
    emf: electrical.RotationalEMF = electrical.RotationalEMF(k=k)
    La: electrical.Inductor = electrical.Inductor(L=250.0 / (2 * D * w))
    Ra: electrical.Resistor = electrical.Resistor(R=250.0)
    C: electrical.Capacitor = electrical.Capacitor(C=0.004 * D / w)
    Ri: electrical.Resistor = electrical.Resistor(R=10.0)
    Rd1: electrical.Resistor = electrical.Resistor(R=100.0)
    Rd2: electrical.Resistor = electrical.Resistor(R=100.0)
    Rd3: electrical.Resistor = electrical.Resistor(R=100.0)
    Rd4: electrical.Resistor = electrical.Resistor(R=100.0)
    Rp1: electrical.Resistor = electrical.Resistor(R=200.0)
    Rp2: electrical.Resistor = electrical.Resistor(R=50.0)
    hall1: electrical.CurrentSensor = electrical.CurrentSensor()
    hall2: electrical.SignalVoltage = electrical.SignalVoltage()
    ground: electrical.Ground = electrical.Ground()
    phi: rotational.AngleSensor = rotational.AngleSensor()
    speed: rotational.SpeedSensor = rotational.SpeedSensor()
    Jmotor: rotational.Inertia = rotational.Inertia(J=J)
    convert1: blocks.Gain = blocks.Gain(k=1.0)
    convert2: blocks.Gain = blocks.Gain(k=1.0)

    def equations(self) -> Equations:
        yield connect(self.Ra.n, self.La.p)
        yield connect(self.La.n, self.emf.p)
        yield connect(self.emf.n, self.hall1.p)
        yield connect(self.Vs.p, self.Rd2.p)
        yield connect(self.Rd2.n, self.diff.n1, self.Rd1.p)
        yield connect(self.Rd1.n, self.diff.p2, self.Ri.p)
        yield connect(self.Ri.n, self.OpI.n1, self.C.p)
        yield connect(self.C.n, self.OpI.p2, self.power.p1)
        yield connect(self.power.n1, self.Rp1.p, self.Rp2.p)
        yield connect(self.power.p2, self.Rp1.n, self.Ra.p)
        yield connect(self.hall2.p, self.Rd3.p)
        yield connect(self.Rd3.n, self.diff.p1, self.Rd4.p)
        yield connect(self.ground.p, self.Vs.n, self.hall2.n, self.Rd4.n, self.Rp2.n, self.hall1.n)
        yield connect(self.ground.p, self.OpI.p1, self.OpI.n2, self.power.n2, self.diff.n2)
        yield connect(self.hall1.i, self.convert1.u)
        yield connect(self.convert1.y, self.hall2.v)
        yield connect(self.current_ref, self.convert2.u)
        yield connect(self.convert2.y, self.Vs.v)
        yield connect(self.emf.flange, self.phi.flange, self.speed.flange, self.Jmotor.flange_a)
        yield connect(self.Jmotor.flange_b, self.flange_motor)
        yield connect(self.phi.phi, self.motorAngle)
        yield connect(self.speed.w, self.motorSpeed)

    def initial_equations(self) -> Equations:
        yield der(self.C.v) == 0
        yield der(self.La.i) == 0


class Controller(Component):
    """Utilities.Controller: a position controller around one of the speed."""

    kp: Parameter = Parameter(10.0)
    ks: Parameter = Parameter(1.0)
    Ts: Parameter = Parameter(0.01, unit="s")
    ratio: Parameter = Parameter(1.0)
    angle_ref: Input = Input()
    speed_ref: Input = Input()
    motorAngle: Input = Input()
    motorSpeed: Input = Input()
    current_ref: Output = Output()
    PI: blocks.PI = blocks.PI(k=ks, T=Ts)

    def equations(self) -> Equations:
        position = self.kp * (self.ratio * self.angle_ref - self.motorAngle)
        yield self.PI.u == self.ratio * self.speed_ref + position - self.motorSpeed
        yield connect(self.PI.y, self.current_ref)


class GearType1(rotational.PartialTwoFlanges):
    """Utilities.GearType1: elastic, with friction at the side of the motor; the elasticity starts at rest."""

    gear: rotational.IdealGear = rotational.IdealGear()
    spring: rotational.SpringDamper = rotational.SpringDamper()
    bearingFriction: rotational.BearingFriction = rotational.BearingFriction()
    a_rel: Variable = Variable(unit="rad/s2")

    def equations(self) -> Equations:
        yield connect(self.flange_a, self.bearingFriction.flange_a)
        yield connect(self.bearingFriction.flange_b, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.flange_b)
        yield self.a_rel == der(self.spring.w_rel)

    def initial_equations(self) -> Equations:
        yield self.spring.w_rel == 0
        yield self.a_rel == 0


class Axis(Component):
    """Utilities.AxisType1; starts where its reference does."""

    flange: rotational.Flange = rotational.Flange()
    angle_ref: Input = Input()
    speed_ref: Input = Input()
    gear: GearType1 = GearType1()
    motor: Motor = Motor()
    controller: Controller = Controller()
    initializeFlange: rotational.InitializeFlange = rotational.InitializeFlange(stateSelect="prefer")

    def equations(self) -> Equations:
        yield connect(self.motor.flange_motor, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.flange, self.initializeFlange.flange)
        yield connect(self.angle_ref, self.controller.angle_ref, self.initializeFlange.phi_start)
        yield connect(self.speed_ref, self.controller.speed_ref, self.initializeFlange.w_start)
        yield self.initializeFlange.a_start == 0
        yield connect(self.motor.motorAngle, self.controller.motorAngle)
        yield connect(self.motor.motorSpeed, self.controller.motorSpeed)
        yield connect(self.controller.current_ref, self.motor.current_ref)


def axis_type1(*, w: float, ratio: float, c: float, cd: float, Rv0: float, Rv1: float) -> Axis:
    return Axis(
        gear=GearType1(
            gear=rotational.IdealGear(ratio=ratio), spring=rotational.SpringDamper(c=c, d=cd),
            bearingFriction=rotational.BearingFriction(tau_pos=((0.0, Rv0), (1.0, Rv0 + Rv1))),
        ),
        motor=Motor(w=w), controller=Controller(kp=5.0, ks=0.5, Ts=0.05, ratio=ratio),
    )  # fmt: skip


def one_axis() -> Component:
    """OneAxis."""
    return assemble(
        "axis.flange - load.flange_a", "path.q - axis.angle_ref", "path.qd - axis.speed_ref",
        axis=axis_type1(w=5500.0, ratio=210.0, c=8.0, cd=0.01, Rv0=0.5, Rv1=0.1 / 130),
        load=rotational.Inertia(J=1.14**2 * 15.0),
        path=blocks.KinematicPTP2(q_end=math.radians(120.0), qd_max=3.0, qdd_max=10.0),
    )  # fmt: skip
