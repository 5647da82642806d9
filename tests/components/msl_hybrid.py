"""Examples of the Modelica Standard Library with friction, diodes, op-amps and switches, from library components.

Rebuilt after `Modelica.Mechanics.Rotational.Examples`, `Modelica.Electrical.Analog.Examples` and
`Modelica.Thermal.HeatTransfer.Examples`; the tests compare them with solutions of their own.
"""

from __future__ import annotations

import math

from acausal import Component, Equations, Parameter, where
from acausal.components import blocks, electrical, rotational, thermal, translational
from acausal.components.examples import assemble, start


def inertia(J: float = 1.0, w: float = 0.0) -> rotational.Inertia:
    return rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(w, fixed=True))


def coupled_clutches() -> Component:
    """Rotational.Examples.CoupledClutches."""
    return assemble(
        "sin1.y - torque.tau", "torque.flange - J1.flange_a", "J1.flange_b - clutch1.flange_a",
        "clutch1.flange_b - J2.flange_a", "J2.flange_b - clutch2.flange_a", "clutch2.flange_b - J3.flange_a",
        "J3.flange_b - clutch3.flange_a", "clutch3.flange_b - J4.flange_a", "sin2.y - clutch1.f_normalized",
        "step1.y - clutch2.f_normalized", "step2.y - clutch3.f_normalized", "fixed.flange - torque.support",
        J1=inertia(w=10.0), J2=inertia(), J3=inertia(), J4=inertia(), torque=rotational.Torque(useSupport=True),
        clutch1=rotational.Clutch(peak=1.1, fn_max=20.0), clutch2=rotational.Clutch(peak=1.1, fn_max=20.0),
        clutch3=rotational.Clutch(peak=1.1, fn_max=20.0), sin1=blocks.Sine(amplitude=10.0, f=5.0),
        sin2=blocks.Sine(amplitude=1.0, f=0.2, phase=math.pi / 2), step1=blocks.Step(startTime=0.4),
        step2=blocks.Step(startTime=0.9), fixed=rotational.Fixed(),
    )  # fmt: skip


def backlash() -> Component:
    """Rotational.Examples.Backlash: one inertia on a spring and damper, one with a backlash besides."""
    return assemble(
        "fixed.flange - springDamper.flange_a - elastoBacklash.flange_a", "springDamper.flange_b - inertia1.flange_a",
        "elastoBacklash.flange_b - inertia2.flange_a",
        fixed=rotational.Fixed(), springDamper=rotational.SpringDamper(c=20e3, d=50.0),
        elastoBacklash=rotational.ElastoBacklash(c=20e3, d=50.0, b=math.pi / 4),
        inertia1=rotational.Inertia(J=5.0, phi=start(math.pi / 2, fixed=True), w=start(0.0, fixed=True)),
        inertia2=rotational.Inertia(J=5.0, phi=start(math.pi / 2, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip


def rolling_wheel() -> Component:
    """Rotational.Examples.RollingWheel."""
    drag = translational.QuadraticSpeedDependentForce(f_nominal=-10.0, ForceDirection=False, v_nominal=5.0)
    return assemble(
        "torqueStep.flange - inertia.flange_a", "inertia.flange_b - wheel.flangeR", "wheel.flangeT - mass.flange_a",
        "mass.flange_b - drag.flange",
        inertia=inertia(), wheel=rotational.IdealRollingWheel(radius=1.0), mass=translational.Mass(m=1.0), drag=drag,
        torqueStep=rotational.TorqueStep(stepTorque=10.0, startTime=0.1),
    )  # fmt: skip


def eddy_current_brake() -> Component:
    """Rotational.Examples.EddyCurrentBrake."""
    return assemble(
        "brake.flange - inertia.flange_a", "brake.heatPort - body.port",
        inertia=inertia(w=100.0), body=thermal.HeatCapacitor(C=10.0, T=start(293.15, fixed=True)),
        brake=rotational.EddyCurrentTorque(tau_nominal=100.0, w_nominal=10.0, TRef=293.15, useHeatPort=True),
    )  # fmt: skip


def lossy_gear(load: float, friction: float = 0.0) -> Component:
    """Rotational.Examples.LossyGearDemo1, with a constant load and a torque that swings."""
    return assemble(
        "sine.y - torque1.tau", "torque1.flange - inertia1.flange_a", "inertia1.flange_b - gear.flange_a",
        "gear.flange_b - inertia2.flange_a", "inertia2.flange_b - torque2.flange",
        gear=rotational.LossyGear(ratio=2.0, lossTable=[[0.0, 0.8, 0.6, friction, friction]]), inertia1=inertia(),
        inertia2=rotational.Inertia(J=1.5), torque1=rotational.Torque(), sine=blocks.Sine(amplitude=10.0, f=1.0),
        torque2=rotational.ConstantTorque(tau_constant=load),
    )  # fmt: skip


def braked_bearing() -> Component:
    """A brake and a bearing on one rigid shaft, under a torque that grows with time."""
    return assemble(
        "ramp.y - torque.tau", "torque.flange - rotor.flange_a", "rotor.flange_b - bearing.flange_a",
        "bearing.flange_b - brake.flange_a", "press.y - brake.f_normalized",
        ramp=blocks.Slope(slope=1.0), torque=rotational.Torque(), rotor=rotational.Inertia(J=2.0),
        bearing=rotational.BearingFriction(), brake=rotational.Brake(fn_max=6.0), press=blocks.Constant(k=1.0),
    )  # fmt: skip


def two_switches() -> Component:
    """Two closed switches without resistance side by side: how they share the current is undetermined."""
    closed = electrical.IdealClosingSwitch(Ron=0.0)
    return assemble(
        "source.p - load.p", "load.n - one.p - two.p", "one.n - two.n - source.n - ground.p",
        "on.y - one.control - two.control",
        source=electrical.ConstantVoltage(V=1.0), load=electrical.Resistor(R=1.0), one=closed, two=closed,
        ground=electrical.Ground(), on=blocks.BooleanConstant(k=True),
    )  # fmt: skip


def rectifier() -> Component:
    """Electrical.Analog.Examples.Rectifier: a six-pulse bridge behind inductors."""
    phases = {f"V{k}": electrical.SineVoltage(V=326.0, f=50.0, phase=-2 * math.pi / 3 * (k - 1)) for k in (1, 2, 3)}
    coils = {f"L{k}": electrical.Inductor(L=3e-3, i=start(0.0, fixed=k < 3)) for k in (1, 2, 3)}
    diodes = {f"D{k}": electrical.IdealDiode(Ron=1e-4, Goff=1e-6, Vknee=2.0) for k in range(1, 7)}
    return assemble(
        "V1.n - V2.n - V3.n", *(f"V{k}.p - L{k}.p" for k in (1, 2, 3)),
        *(f"L{k}.n - D{k}.p - D{k + 3}.n" for k in (1, 2, 3)), "D1.n - D2.n - D3.n - C1.p - R.p",
        "D4.p - D5.p - D6.p - C2.n - R.n", "C1.n - C2.p - ground.p",
        **phases, **coils, **diodes, C1=electrical.Capacitor(C=1e-4, v=start(0.0, fixed=True)),
        C2=electrical.Capacitor(C=1e-4, v=start(0.0, fixed=True)), R=electrical.Resistor(R=20.0),
        ground=electrical.Ground(),
    )  # fmt: skip


class NonlinearResistor(electrical.OnePort):
    """Chua's diode: three straight lines."""

    Ga: Parameter = Parameter(-0.757576, unit="S")
    Gb: Parameter = Parameter(-0.409091, unit="S")
    Ve: Parameter = Parameter(1.0, unit="V")

    def equations(self) -> Equations:
        yield from super().equations()
        outside = where(self.v > 0, 1.0, -1.0) * (self.Ga - self.Gb) * self.Ve + self.Gb * self.v
        yield self.i == where((self.v < -self.Ve) | (self.v > self.Ve), outside, self.Ga * self.v)


def chua() -> Component:
    """Electrical.Analog.Examples.ChuaCircuit."""
    return assemble(
        "L.n - Ro.p", "C2.p - L.p - G.p", "G.n - Nr.p - C1.p", "ground.p - C1.n - C2.n - Ro.n - Nr.n",
        L=electrical.Inductor(L=18.0, i=start(0.0, fixed=True)), Ro=electrical.Resistor(R=12.5e-3),
        G=electrical.Conductor(G=0.565), C1=electrical.Capacitor(C=10.0, v=start(4.0, fixed=True)),
        C2=electrical.Capacitor(C=100.0, v=start(0.0, fixed=True)), Nr=NonlinearResistor(), ground=electrical.Ground(),
    )  # fmt: skip


def nand_gate() -> Component:
    """Electrical.Analog.Examples.NandGate, slower."""
    gate = {"rising": 1e-3, "width": 19e-3, "falling": 1e-3, "period": 40e-3}
    return assemble(
        "x1.p - P1.G - N1.G", "x2.p - P2.G - N2.G", "VDD.p - P1.S - P1.B - P2.S - P2.B", "P1.D - P2.D - N1.D - C.p",
        "N1.S - N2.D", "N1.B - N2.B - N2.S - C.n - VDD.n - x1.n - x2.n - ground.p",
        x1=electrical.TrapezoidVoltage(V=5.0, startTime=20e-3, **gate),
        x2=electrical.TrapezoidVoltage(V=5.0, startTime=10e-3, **gate),
        VDD=electrical.RampVoltage(V=5.0, duration=1e-3), P1=electrical.PMOS(), P2=electrical.PMOS(),
        N1=electrical.NMOS(), N2=electrical.NMOS(), C=electrical.Capacitor(C=1e-9, v=start(0.0, fixed=True)),
        ground=electrical.Ground(),
    )  # fmt: skip


def multivibrator(amp: Component | None = None) -> Component:
    """Electrical.Analog.Examples.OpAmps.Multivibrator; with an amplifier of one's own."""
    return assemble(
        "amp.in_n - C.p - R.p", "amp.out - R.n - R2.n - out.p", "amp.in_p - R1.p - R2.p",
        "C.n - R1.n - ground.p - out.n",
        C=electrical.Capacitor(C=1e-4, v=start(8.0, fixed=True)), R=electrical.Resistor(R=1e3),
        R1=electrical.Resistor(R=1e3), R2=electrical.Resistor(R=1e3), ground=electrical.Ground(),
        amp=amp or electrical.IdealizedOpAmpLimited(V0=1e6), out=electrical.VoltageSensor(),
    )  # fmt: skip


def controlled_temperature() -> Component:
    """Thermal.HeatTransfer.Examples.ControlledTemperature, with a constant set point and a resistor without
    temperature coefficient."""
    return assemble(
        "source.p - switch.p", "switch.n - heater.p", "source.n - heater.n - ground.p",
        "heater.heatPort - wall.port_a - body.port - sensor.port", "wall.port_b - room.port", "set.y - relay.reference",
        "sensor.T - relay.u", "relay.y - not.u", "not.y - switch.control",
        source=electrical.ConstantVoltage(V=10.0), switch=electrical.IdealOpeningSwitch(Ron=0.0, Goff=0.0),
        heater=electrical.Resistor(R=10.0, useHeatPort=True), ground=electrical.Ground(),
        body=thermal.HeatCapacitor(C=1.0, T=start(298.15, fixed=True)), wall=thermal.ThermalConductor(G=0.1),
        room=thermal.FixedTemperature(T=298.15), sensor=thermal.TemperatureSensor(), set=blocks.Constant(k=303.15),
        relay=blocks.OnOffController(bandwidth=2.0), **{"not": blocks.Not()},
    )  # fmt: skip
