"""More examples of Modelica.Mechanics.Rotational, from library components with its names."""

from __future__ import annotations

from acausal import Component
from acausal.components import blocks, rotational, thermal, translational
from acausal.components.examples import assemble, start


def first_grounded() -> Component:
    """Rotational.Examples.FirstGrounded."""
    return assemble(
        "inertia1.flange_b - idealGear.flange_a", "idealGear.flange_b - inertia2.flange_a",
        "spring.flange_b - inertia3.flange_a", "inertia2.flange_b - spring.flange_a - damper.flange_a",
        "damper.flange_b - fixed.flange", "sine.y - torque.tau", "torque.flange - inertia1.flange_a",
        fixed=rotational.Fixed(), torque=rotational.Torque(useSupport=False), inertia1=rotational.Inertia(J=0.1),
        idealGear=rotational.IdealGear(ratio=10.0, useSupport=False),
        inertia2=rotational.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        spring=rotational.Spring(c=1e4, phi_rel=start(0.0, fixed=True)),
        inertia3=rotational.Inertia(J=2.0, w=start(0.0, fixed=True)), damper=rotational.Damper(d=10.0),
        sine=blocks.Sine(amplitude=10.0, f=5.0),
    )  # fmt: skip


def lossy_gear_demo1() -> Component:
    """Rotational.Examples.LossyGearDemo1."""
    return assemble(
        "Inertia1.flange_b - gear.flange_a", "gear.flange_b - Inertia2.flange_a", "torque1.flange - Inertia1.flange_a",
        "torque2.flange - Inertia2.flange_b", "DriveSine.y - torque1.tau", "load.y - torque2.tau",
        "fixed.flange - gear.support - torque1.support - torque2.support",
        gear=rotational.LossyGear(ratio=2.0, lossTable=((0.0, 0.5, 0.5, 0.0, 0.0),), useSupport=True),
        Inertia1=rotational.Inertia(J=1.0),
        Inertia2=rotational.Inertia(J=1.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torque1=rotational.Torque(useSupport=True), torque2=rotational.Torque(useSupport=True),
        DriveSine=blocks.Sine(amplitude=10.0, f=1.0), load=blocks.Ramp(height=5.0, duration=2.0, offset=-10.0),
        fixed=rotational.Fixed(),
    )  # fmt: skip


def lossy_gear_demo2() -> Component:
    """Rotational.Examples.LossyGearDemo2."""
    return assemble(
        "torque2.flange - Inertia2.flange_b", "Inertia2.flange_a - gear.flange_b", "gear.flange_a - Inertia1.flange_b",
        "Inertia1.flange_a - bearingFriction.flange_b", "bearingFriction.flange_a - torque1.flange",
        "DriveSine.y - torque1.tau", "load.y - torque2.tau",
        "gear.support - fixed.flange - torque2.support - bearingFriction.support - torque1.support",
        gear=rotational.LossyGear(ratio=2.0, lossTable=((0.0, 0.5, 0.5, 0.0, 0.0),), useSupport=True),
        Inertia1=rotational.Inertia(J=1.0),
        Inertia2=rotational.Inertia(J=1.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torque1=rotational.Torque(useSupport=True), torque2=rotational.Torque(useSupport=True),
        DriveSine=blocks.Sine(amplitude=10.0, f=1.0), load=blocks.Ramp(height=5.0, duration=2.0, offset=-10.0),
        bearingFriction=rotational.BearingFriction(tau_pos=((0.0, 0.5), (1.0, 1.0)), useSupport=True),
        fixed=rotational.Fixed(),
    )  # fmt: skip


def eddy_current_brake() -> Component:
    """Rotational.Examples.EddyCurrentBrake."""
    return assemble(
        "eddyCurrentTorque.flange - inertia.flange_a", "eddyCurrentTorque.heatPort - heatCapacitor.port",
        eddyCurrentTorque=rotational.EddyCurrentTorque(tau_nominal=100.0, w_nominal=10.0, useSupport=False,
            alpha20=3.92e-3, TRef=293.15, useHeatPort=True),
        inertia=rotational.Inertia(phi=start(0.0, fixed=True), J=1.0, w=start(20.0, fixed=True)),
        heatCapacitor=thermal.HeatCapacitor(C=1.0, T=start(293.15, fixed=True)),
    )  # fmt: skip


def one_way_clutch_disengaged() -> Component:
    """Rotational.Examples.OneWayClutchDisengaged."""
    return assemble(
        "torque.flange - inertiaIn.flange_a", "signalTorque.y - torque.tau",
        "inertiaIn.flange_b - oneWayClutch.flange_a", "oneWayClutch.flange_b - inertiaOut.flange_a",
        "signalEngagement.y - oneWayClutch.f_normalized", "inertiaOut.flange_b - torqueLoad.flange",
        inertiaIn=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(-0.5, fixed=True)),
        inertiaOut=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        oneWayClutch=rotational.OneWayClutch(peak=25.0, fn_max=3.0), torque=rotational.Torque(),
        torqueLoad=rotational.ConstantTorque(tau_constant=-0.3),
        signalTorque=blocks.Sine(amplitude=10.0, offset=0.3, f=2.0), signalEngagement=blocks.Constant(k=0.0),
    )  # fmt: skip


def rolling_wheel() -> Component:
    """Rotational.Examples.RollingWheel."""
    return assemble(
        "torqueStep.flange - inertia.flange_a", "inertia.flange_b - idealRollingWheel.flangeR",
        "idealRollingWheel.flangeT - mass.flange_a", "quadraticSpeedDependentForce.flange - mass.flange_b",
        idealRollingWheel=rotational.IdealRollingWheel(radius=1.0),
        inertia=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        torqueStep=rotational.TorqueStep(stepTorque=10.0, offsetTorque=0.0, startTime=0.1, useSupport=False),
        mass=translational.Mass(L=0.0, m=1.0),
        quadraticSpeedDependentForce=translational.QuadraticSpeedDependentForce(f_nominal=-10.0,
            ForceDirection=False, v_nominal=5.0),
    )  # fmt: skip


def heat_losses() -> Component:
    """Rotational.Examples.HeatLosses."""
    return assemble(
        "sine.y - torque.tau", "torque.flange - inertia1.flange_a", "damper.flange_a - fixed.flange",
        "inertia1.flange_b - damper.flange_b - springDamper.flange_a", "springDamper.flange_b - inertia2.flange_a",
        "inertia2.flange_b - elastoBacklash.flange_a", "elastoBacklash.flange_b - inertia3.flange_a",
        "inertia3.flange_b - bearingFriction.flange_a", "bearingFriction.flange_b - spring3.flange_a",
        "spring3.flange_b - inertia4.flange_a", "inertia4.flange_b - lossyGear.flange_a",
        "lossyGear.flange_b - clutch.flange_a", "clutch.flange_b - inertia5.flange_a",
        "inertia5.flange_b - oneWayClutch.flange_a", "oneWayClutch.flange_b - inertia6.flange_a",
        "inertia6.flange_b - brake.flange_a", "TAmbient.port - convection.fluid", "const.y - convection.Gc",
        "sine2.y - clutch.f_normalized - oneWayClutch.f_normalized - brake.f_normalized",
        "convection.solid - damper.heatPort - springDamper.heatPort - elastoBacklash.heatPort - brake.heatPort",
        "convection.solid - bearingFriction.heatPort - lossyGear.heatPort - clutch.heatPort - oneWayClutch.heatPort",
        sine=blocks.Sine(f=5.0, amplitude=20.0), torque=rotational.Torque(), inertia1=resting(),
        damper=rotational.Damper(useHeatPort=True, d=10.0), fixed=rotational.Fixed(), convection=thermal.Convection(),
        TAmbient=thermal.FixedTemperature(T=298.15), const=blocks.Constant(k=20.0),
        springDamper=rotational.SpringDamper(c=1e4, d=20.0, useHeatPort=True), inertia2=resting(),
        elastoBacklash=rotational.ElastoBacklash(c=1e5, d=100.0, useHeatPort=True, b=0.001), inertia3=resting(),
        bearingFriction=rotational.BearingFriction(useHeatPort=True), spring3=rotational.Spring(c=1e4),
        inertia4=resting(), inertia5=rotational.Inertia(J=2.0), inertia6=rotational.Inertia(J=2.0),
        lossyGear=rotational.LossyGear(ratio=2.0, lossTable=((0, 0.8, 0.8, 1, 1), (1, 0.7, 0.7, 2, 2)),
            useHeatPort=True),
        clutch=rotational.Clutch(useHeatPort=True, fn_max=10.0, phi_rel=start(0.0, fixed=True),
            w_rel=start(0.0, fixed=True)),
        oneWayClutch=rotational.OneWayClutch(phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True), fn_max=1.0,
            useHeatPort=True),
        brake=rotational.Brake(fn_max=2.0, useHeatPort=True), sine2=blocks.Sine(f=0.2, amplitude=1.0),
    )  # fmt: skip


def resting() -> rotational.Inertia:
    """An inertia of 2 kg m2 that starts from rest."""
    return rotational.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
