"""Examples of the Modelica Standard Library 4.0 with friction, gears, stops and heat, from library components."""

from __future__ import annotations

import math

from acausal import Component
from acausal.components import blocks, electrical, rotational, thermal, translational
from acausal.components.examples import assemble, start


def friction() -> Component:
    """Rotational.Examples.Friction."""
    return assemble(
        "torque.flange - inertia3.flange_a", "inertia3.flange_b - clutch.flange_a",
        "clutch.flange_b - inertia2.flange_a", "inertia2.flange_b - spring.flange_a",
        "spring.flange_b - brake.flange_a", "brake.flange_b - inertia1.flange_a", "sine.y - product.u1",
        "step2.y - product.u2", "product.y - torque.tau", "const.y - clutch.f_normalized",
        "step.y - brake.f_normalized", "torque.support - fixed.flange - brake.support",
        torque=rotational.Torque(useSupport=True),
        inertia3=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(100.0, fixed=True)),
        clutch=rotational.Clutch(fn_max=160.0),
        inertia2=rotational.Inertia(J=0.05, phi=start(0.0, fixed=True), w=start(90.0, fixed=True)),
        spring=rotational.SpringDamper(c=160.0, d=1.0),
        inertia1=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(90.0, fixed=True)),
        brake=rotational.Brake(fn_max=1600.0, useSupport=True), const=blocks.Constant(k=1.0),
        step=blocks.Step(startTime=0.5), step2=blocks.Step(height=-1.0, offset=1.0, startTime=0.5),
        sine=blocks.Sine(amplitude=200.0, f=50 / math.pi), product=blocks.Product(), fixed=rotational.Fixed(),
    )  # fmt: skip


def simple_gear_shift() -> Component:
    """Rotational.Examples.SimpleGearShift."""
    return assemble(
        "torqueStep.flange - engine.flange_a", "quadraticSpeedDependentTorque.flange - load.flange_b",
        "feedback.y - brake.f_normalized", "engine.flange_b - idealPlanetary.sun - clutch.flange_a",
        "idealPlanetary.ring - clutch.flange_b - brake.flange_a", "idealPlanetary.carrier - load.flange_a",
        "const1.y - feedback.u1", "feedback.u2 - clutch.f_normalized - ramp.y",
        torqueStep=rotational.TorqueStep(offsetTorque=0.0, startTime=0.5, stepTorque=20.0),
        engine=rotational.Inertia(J=1.0), idealPlanetary=rotational.IdealPlanetary(ratio=1.5),
        load=rotational.Inertia(J=10.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        quadraticSpeedDependentTorque=rotational.QuadraticSpeedDependentTorque(
            w_nominal=100 * math.pi / 30, tau_nominal=-20.0
        ),
        clutch=rotational.Clutch(cgeo=2.0, fn_max=100.0, phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True)),
        brake=rotational.Brake(cgeo=2.0, fn_max=100.0), feedback=blocks.Feedback(), const1=blocks.Constant(k=1.0),
        ramp=blocks.Ramp(height=1.0, offset=0.0, startTime=2.0, duration=0.1),
    )  # fmt: skip


def lossy_gear_demo3() -> Component:
    """Rotational.Examples.LossyGearDemo3."""
    return assemble(
        "Inertia1.flange_b - gear.flange_a", "torque1.flange - Inertia1.flange_a", "step.y - torque1.tau",
        "gear.flange_b - Inertia2.flange_a", "Inertia2.flange_b - torque2.flange", "step1.y - torque2.tau",
        gear=rotational.LossyGear(ratio=1.0, lossTable=((0.0, 0.25, 0.25, 0.625, 2.5),), useSupport=False),
        Inertia1=rotational.Inertia(w=start(10.0), J=0.001), torque1=rotational.Torque(useSupport=False),
        torque2=rotational.Torque(useSupport=False), step=blocks.Step(height=0.0),
        step1=blocks.Step(startTime=0.5, height=1.0, offset=0.0),
        Inertia2=rotational.Inertia(J=0.001, phi=start(0.0, fixed=True), w=start(10.0, fixed=True)),
    )  # fmt: skip


def one_way_clutch() -> Component:
    """Rotational.Examples.OneWayClutch."""
    return assemble(
        "torque.flange - inertiaIn.flange_a", "signalTorque.y - torque.tau",
        "inertiaIn.flange_b - oneWayClutch.flange_a", "oneWayClutch.flange_b - inertiaOut.flange_a",
        "signalEngagement.y - oneWayClutch.f_normalized",
        inertiaIn=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(-0.5, fixed=True)),
        inertiaOut=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        oneWayClutch=rotational.OneWayClutch(peak=25.0, fn_max=3.0), torque=rotational.Torque(),
        signalTorque=blocks.Sine(amplitude=10.0, f=3.0),
        signalEngagement=blocks.Pulse(amplitude=1.0, width=50.0, period=1.3, startTime=0.3),
    )  # fmt: skip


def elastic_bearing() -> Component:
    """Rotational.Examples.ElasticBearing."""
    return assemble(
        "torque.flange - shaft.flange_a", "spring.flange_b - load.flange_a",
        "springDamper.flange_a - fixed.flange - torque.support", "shaft.flange_b - idealGear.flange_a",
        "idealGear.flange_b - spring.flange_a", "idealGear.support - housing.flange_b", "ramp.y - torque.tau",
        "housing.flange_a - multiSensor.flange_b", "multiSensor.flange_a - springDamper.flange_b",
        shaft=rotational.Inertia(phi=start(0.0, fixed=True), J=1.0, w=start(0.0, fixed=True)),
        load=rotational.Inertia(J=50.0, w=start(0.0, fixed=True)),
        spring=rotational.Spring(c=1000.0, phi_rel=start(0.0, fixed=True)), fixed=rotational.Fixed(),
        springDamper=rotational.SpringDamper(
            c=1e5, d=5.0, phi_rel=start(0.0, fixed=True), w_rel=start(0.0, fixed=True)
        ), torque=rotational.Torque(useSupport=True), ramp=blocks.Ramp(duration=5.0, height=100.0),
        idealGear=rotational.IdealGear(ratio=3.0, useSupport=True), housing=rotational.Inertia(J=5.0),
        multiSensor=rotational.MultiSensor(),
    )  # fmt: skip


def backlash() -> Component:
    """Rotational.Examples.Backlash."""
    return assemble(
        "springDamper.flange_b - inertia1.flange_a", "elastoBacklash.flange_b - inertia2.flange_a",
        "fixed1.flange - springDamper.flange_a", "fixed2.flange - elastoBacklash.flange_a",
        "elastoBacklash2.flange_b - inertia3.flange_a", "fixed3.flange - elastoBacklash2.flange_a",
        fixed1=rotational.Fixed(), springDamper=rotational.SpringDamper(c=20000.0, d=50.0),
        inertia1=rotational.Inertia(J=5.0, w=start(0.0, fixed=True), phi=start(math.pi / 2, fixed=True)),
        fixed2=rotational.Fixed(), elastoBacklash=rotational.ElastoBacklash(c=20000.0, d=50.0, b=math.pi / 4),
        inertia2=rotational.Inertia(J=5.0, w=start(0.0, fixed=True), phi=start(math.pi / 2, fixed=True)),
        fixed3=rotational.Fixed(), elastoBacklash2=rotational.ElastoBacklash2(c=20000.0, d=50.0, b=math.pi / 4),
        inertia3=rotational.Inertia(J=5.0, w=start(0.0, fixed=True), phi=start(math.pi / 2, fixed=True)),
    )  # fmt: skip


def brake() -> Component:
    """Translational.Examples.Brake."""
    return assemble(
        "mass1.flange_b - brake.flange_a", "step.y - brake.f_normalized - brake1.f_normalized",
        "mass2.flange_b - brake1.flange_a", "fixed.flange - brake1.support",
        brake=translational.Brake(fn_max=1.0, useSupport=False),
        mass1=translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True)),
        step=blocks.Step(startTime=0.1, height=2.0), brake1=translational.Brake(fn_max=1.0, useSupport=True),
        mass2=translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True)),
        fixed=translational.Fixed(),
    )  # fmt: skip


def pre_load() -> Component:
    """Translational.Examples.PreLoad."""
    return assemble(
        "outerContactA.flange_b - springPlateA.flange_a", "springPlateA.flange_b - spring.flange_a - rod1.flange_a",
        "spring.flange_b - springPlateB.flange_a - rod2.flange_b", "springPlateB.flange_b - outerContactB.flange_a",
        "outerContactB.flange_b - housing.flange_b", "innerContactA.flange_a - rod3.flange_a - friction.flange_b",
        "innerContactA.flange_b - rod1.flange_b", "rod2.flange_a - innerContactB.flange_a",
        "rod4.flange_b - innerContactB.flange_b", "rod3.flange_b - rod4.flange_a - spool.flange_a - force.flange",
        "sineForce.y - force.f", "outerContactA.flange_a - fixedLe.flange - housing.flange_a - friction.flange_a",
        innerContactA=translational.ElastoGap(c=1e6, d=250.0, s_rel0=0.001),
        innerContactB=translational.ElastoGap(c=1e6, d=250.0, s_rel0=0.001),
        spool=translational.Mass(L=0.19, m=0.15, s=start(0.01475, fixed=True), v=start(0.0, fixed=True)),
        fixedLe=translational.Fixed(s0=-0.0955),
        springPlateA=translational.Mass(m=0.01, L=0.002, s=start(-0.093, fixed=True), v=start(0.0, fixed=True)),
        springPlateB=translational.Mass(m=0.01, s=start(-0.06925, fixed=True), L=0.002, v=start(0.0, fixed=True)),
        spring=translational.Spring(c=20000.0, s_rel0=0.025),
        outerContactA=translational.ElastoGap(c=1e6, d=250.0, s_rel0=0.0015),
        outerContactB=translational.ElastoGap(c=1e6, d=250.0, s_rel0=0.0015), rod1=translational.Rod(L=0.007),
        friction=translational.Damper(d=2500.0), force=translational.Force(), housing=translational.Rod(L=0.0305),
        rod3=translational.Rod(L=0.00575), rod4=translational.Rod(L=0.00575), rod2=translational.Rod(L=0.007),
        sineForce=blocks.Sine(amplitude=150.0, f=0.01),
    )  # fmt: skip


def controlled_temperature() -> Component:
    """Thermal.HeatTransfer.Examples.ControlledTemperature."""
    return assemble(
        "constantVoltage.n - resistor.n - ground.p",
        "resistor.heatPort - thermalConductor.port_a - temperatureSensor.port - heatCapacitor.port",
        "thermalConductor.port_b - fixedTemperature.port", "constantVoltage.p - idealSwitch.p",
        "idealSwitch.n - resistor.p", "ramp.y - onOffController.reference", "temperatureSensor.T - onOffController.u",
        "onOffController.y - logicalNot.u", "logicalNot.y - idealSwitch.control",
        ground=electrical.Ground(), constantVoltage=electrical.ConstantVoltage(V=10.0),
        heatCapacitor=thermal.HeatCapacitor(C=1.0, T=start(293.15, fixed=True)),
        resistor=electrical.Resistor(R=10.0, T_ref=293.15, alpha=1 / 255, useHeatPort=True),
        fixedTemperature=thermal.FixedTemperature(T=293.15), temperatureSensor=thermal.celsius.TemperatureSensor(),
        thermalConductor=thermal.ThermalConductor(G=0.1), idealSwitch=electrical.IdealOpeningSwitch(),
        ramp=blocks.Ramp(height=25.0, duration=6.0, offset=25.0, startTime=2.0),
        onOffController=blocks.OnOffController(bandwidth=2.0), logicalNot=blocks.Not(),
    )  # fmt: skip
