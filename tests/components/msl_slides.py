"""More examples of Modelica.Mechanics.Translational, from library components with its names."""

from __future__ import annotations

import math

from acausal import Component
from acausal.components import blocks, rotational, thermal, translational
from acausal.components.examples import assemble, start

ROAD = (
    (0, 0, 0), (5, 0, 0), (5, 5.6, 0), (10.8, 5.6, 0), (10.8, 1, 0), (20, 1, 0), (20, 2.8, 0.05), (25, 2.8, 0.05),
    (25, 1, 0), (50, 1, 0), (50, -5, 0), (55, -5, 0), (55, 0, 0), (60, 0, 0),
)  # fmt: skip
"""Time [s], drive over its nominal value, and inclination of the example Vehicle."""


def stribeck_table(rows: int = 50, v_max: float = 12.0) -> list[tuple[float, float]]:
    """Friction 5 + v + 10 exp(-2 v), as Examples.Utilities.GenerateStribeckFrictionTable makes it."""
    speeds = [v_max * k / (rows - 1) for k in range(rows)]
    return [(v, 5.0 + v + 10.0 * math.exp(-2.0 * v)) for v in speeds]


def accelerate() -> Component:
    """Translational.Examples.Accelerate."""
    return assemble(
        "accelerate.flange - mass.flange_a", "constantAcc.y - accelerate.a_ref",
        accelerate=translational.Accelerate(), mass=translational.Mass(L=1.0, m=1.0),
        constantAcc=blocks.Constant(k=1.0),
    )  # fmt: skip


def damper() -> Component:
    """Translational.Examples.Damper."""
    return assemble(
        "mass1.flange_b - damper1.flange_a", "mass2.flange_b - damper2.flange_a - spring2.flange_a",
        "mass3.flange_b - springDamper3.flange_a", "damper1.flange_b - fixed1.flange",
        "damper2.flange_b - spring2.flange_b - fixed2.flange", "springDamper3.flange_b - fixed3.flange",
        mass1=translational.Mass(L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True), m=1.0),
        damper1=translational.Damper(d=25.0), fixed1=translational.Fixed(s0=4.5),
        mass2=translational.Mass(L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True), m=1.0),
        damper2=translational.Damper(d=25.0), fixed2=translational.Fixed(s0=4.5),
        mass3=translational.Mass(L=1.0, s=start(3.0, fixed=True), v=start(10.0, fixed=True), m=1.0),
        fixed3=translational.Fixed(s0=4.5), spring2=translational.Spring(s_rel0=1.0, c=1.0),
        springDamper3=translational.SpringDamper(s_rel0=1.0, d=25.0, c=1.0),
    )  # fmt: skip


def friction() -> Component:
    """Translational.Examples.Friction."""
    return assemble(
        "spring.flange_b - stop2.flange_a", "spring.flange_a - fixed2.flange", "force.flange - stop1.flange_a",
        "force2.flange - mass.flange_a", "mass.flange_b - supportFriction.flange_a",
        "sineForce.y - force.f - force2.f",
        stop1=translational.MassWithStopAndFriction(L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True),
            smax=25.0, smin=-25.0, m=1.0, F_prop=1.0, F_Coulomb=5.0, F_Stribeck=10.0, fexp=2.0),
        force=translational.Force(), sineForce=blocks.Sine(amplitude=25.0, f=0.25),
        stop2=translational.MassWithStopAndFriction(L=1.0, smax=0.9, smin=-0.9, F_Coulomb=3.0, F_Stribeck=5.0,
            s=start(0.0, fixed=True), m=1.0, F_prop=1.0, fexp=2.0, v=start(-5.0, fixed=True)),
        spring=translational.Spring(s_rel0=1.0, c=500.0), fixed2=translational.Fixed(s0=-1.75),
        force2=translational.Force(),
        mass=translational.Mass(m=1.0, L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
        supportFriction=translational.SupportFriction(f_pos=stribeck_table()),
    )  # fmt: skip


def initial_conditions() -> Component:
    """Translational.Examples.InitialConditions."""
    return assemble(
        "s2.flange_a - fixed2.flange", "s1.flange_a - fixed1.flange", "m1.flange_a - s1.flange_b",
        "sd1.flange_a - m1.flange_b", "m2.flange_a - sd1.flange_b", "m4.flange_a - sd2.flange_b",
        "sd2.flange_a - m3.flange_b", "m3.flange_a - s2.flange_b",
        fixed2=translational.Fixed(s0=1.0), s2=translational.Spring(s_rel0=2.0, c=1e3),
        m3=translational.Mass(L=3.0, s=start(4.5, fixed=True), v=start(0.0, fixed=True), m=1.0),
        sd2=translational.SpringDamper(s_rel0=4.0, c=111.0, d=1.0),
        m4=translational.Mass(L=5.0, s=start(12.5, fixed=True), v=start(0.0, fixed=True), m=1.0),
        fixed1=translational.Fixed(s0=-1.0), s1=translational.Spring(s_rel0=1.0, c=1e3, s_rel=start(0.5, fixed=True)),
        m1=translational.Mass(L=1.0, v=start(0.0, fixed=True), m=1.0),
        sd1=translational.SpringDamper(s_rel0=1.0, c=111.0, s_rel=start(1.0, fixed=True), v_rel=start(0.0,
            fixed=True), d=1.0),
        m2=translational.Mass(L=2.0, m=1.0),
    )  # fmt: skip


def sensors() -> Component:
    """Translational.Examples.Sensors."""
    return assemble(
        "sineForce.y - force.f", "forceSensor.flange_a - force.flange", "mass.flange_b - positionSensor2.flange",
        "forceSensor.flange_b - multiSensor.flange_a",
        "mass.flange_a - positionSensor1.flange - speedSensor1.flange - accSensor1.flange - multiSensor.flange_b",
        forceSensor=translational.ForceSensor(), multiSensor=translational.MultiSensor(),
        speedSensor1=translational.SpeedSensor(), positionSensor1=translational.PositionSensor(),
        accSensor1=translational.AccSensor(), positionSensor2=translational.PositionSensor(),
        mass=translational.Mass(L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True), m=1.0),
        force=translational.Force(), sineForce=blocks.Sine(amplitude=10.0, f=4.0),
    )  # fmt: skip


def sign_convention() -> Component:
    """Translational.Examples.SignConvention."""
    return assemble(
        "constant1.y - force1.f", "constant2.y - force2.f", "constant3.y - force3.f", "force1.flange - mass1.flange_a",
        "force2.flange - mass2.flange_b", "mass3.flange_b - force3.flange",
        mass1=translational.Mass(L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True), m=1.0),
        force1=translational.Force(), constant1=blocks.Constant(k=1.0),
        mass2=translational.Mass(L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True), m=1.0),
        force2=translational.Force(), constant2=blocks.Constant(k=1.0),
        mass3=translational.Mass(L=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True), m=1.0),
        force3=translational.Force(useSupport=False), constant3=blocks.Constant(k=1.0), fixed=translational.Fixed(),
    )  # fmt: skip


def vehicle() -> Component:
    """Translational.Examples.Vehicle."""
    return assemble(
        "torqueTable.y - gain.u", "torque.flange - vehicle.flangeR", "torque1.flange - vehicle1.flangeR",
        "inclinationTable.y - vehicle.inclination - vehicle1.inclination - trailer.inclination",
        "gain.y - torque.tau - gain1.u", "gain1.y - torque1.tau", "vehicle1.flangeT - multiSensor.flange_a",
        "multiSensor.flange_b - trailer.flangeT",
        vehicle=translational.Vehicle(m=100.0, J=0.0, R=0.25, A=1.0, Cd=0.5, CrConstant=0.01,
            useInclinationInput=True, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
        vehicle1=translational.Vehicle(m=100.0, J=0.0, R=0.25, A=1.0, Cd=0.5, CrConstant=0.01,
            useInclinationInput=True, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
        trailer=translational.Vehicle(m=100.0, J=0.0, R=0.25, A=1.0, Cd=0.5, CrConstant=0.01,
            useInclinationInput=True),
        multiSensor=translational.MultiSensor(), torque=rotational.Torque(), torque1=rotational.Torque(),
        gain=blocks.Gain(k=(0.5 * 1.18 * (25 / 3.5) ** 2 / 2 + 0.01 * 100.0 * 9.80665) * 0.25),
        gain1=blocks.Gain(k=2.0),
        torqueTable=blocks.CombiTimeTable(table=ROAD, column=2, extrapolation="HoldLastPoint"),
        inclinationTable=blocks.CombiTimeTable(table=ROAD, column=3, extrapolation="HoldLastPoint"),
    )  # fmt: skip


def why_arrows() -> Component:
    """Translational.Examples.WhyArrows."""
    return assemble(
        "spring1.flange_b - mass1.flange_b", "spring2.flange_b - inertia2.flange_b",
        "rod3.flange_b - positionSensor3.flange", "rod1.flange_a - positionSensor1.flange",
        "rod1.flange_b - fixed.flange - rod3.flange_a - rod2.flange_a", "rod2.flange_b - positionSensor2.flange",
        "fixed1.flange - spring1.flange_a", "fixed2.flange - spring2.flange_a",
        fixed=translational.Fixed(), rod1=translational.Rod(L=1.0), rod2=translational.Rod(L=1.0),
        rod3=translational.Rod(L=1.0), positionSensor2=translational.PositionSensor(),
        positionSensor1=translational.PositionSensor(), positionSensor3=translational.PositionSensor(),
        fixed1=translational.Fixed(s0=-1.9), spring1=translational.Spring(s_rel0=2.0, c=11.0),
        mass1=translational.Mass(L=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True), m=1.0),
        fixed2=translational.Fixed(s0=-1.9), spring2=translational.Spring(s_rel0=2.0, c=11.0),
        inertia2=translational.Mass(L=2.0, m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    )  # fmt: skip


def heat_losses() -> Component:
    """Translational.Examples.HeatLosses."""
    return assemble(
        "mass1.flange_b - springDamper.flange_a", "sine1.y - force.f", "damper.flange_b - fixed1.flange",
        "force.flange - mass1.flange_a - damper.flange_a - elastoGap.flange_b", "elastoGap.flange_a - fixed2.flange",
        "springDamper.flange_b - mass2.flange_a", "mass2.flange_b - supportFriction.flange_a",
        "supportFriction.flange_b - spring.flange_a", "spring.flange_b - mass3.flange_a",
        "mass3.flange_b - brake.flange_a", "sine2.y - brake.f_normalized", "brake.flange_b - springDamper1.flange_a",
        "springDamper1.flange_b - massWithStopAndFriction.flange_a", "const.y - convection.Gc",
        "convection.solid - elastoGap.heatPort - damper.heatPort - springDamper.heatPort - supportFriction.heatPort",
        "convection.solid - brake.heatPort - massWithStopAndFriction.heatPort - springDamper1.heatPort",
        "TAmbient.port - convection.fluid",
        mass1=translational.Mass(m=1.0, L=0.1, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
        springDamper=translational.SpringDamper(c=100.0, d=10.0, s_rel=start(0.0, fixed=True), v_rel=start(0.0,
            fixed=True), useHeatPort=True),
        damper=translational.Damper(d=10.0, useHeatPort=True), fixed1=translational.Fixed(),
        elastoGap=translational.ElastoGap(c=100.0, d=20.0, s_rel0=-0.02, useHeatPort=True),
        fixed2=translational.Fixed(), force=translational.Force(), sine1=blocks.Sine(f=1.0, amplitude=20.0),
        mass2=translational.Mass(m=1.0, L=0.1), supportFriction=translational.SupportFriction(useHeatPort=True),
        spring=translational.Spring(c=100.0, s_rel=start(0.0, fixed=True)),
        mass3=translational.Mass(m=1.0, L=0.1, v=start(0.0, fixed=True)),
        brake=translational.Brake(fn_max=10.0, useHeatPort=True), sine2=blocks.Sine(amplitude=10.0, f=2.0),
        massWithStopAndFriction=translational.MassWithStopAndFriction(L=0.1, m=1.0, F_prop=0.5, F_Coulomb=1.0,
            F_Stribeck=2.0, fexp=2.0, smin=0.0, smax=0.4, v=start(0.0, fixed=True), useHeatPort=True),
        springDamper1=translational.SpringDamper(c=1e4, d=1e3, s_rel=start(0.0, fixed=True), useHeatPort=True),
        convection=thermal.Convection(), const=blocks.Constant(k=20.0), TAmbient=thermal.FixedTemperature(T=298.15),
    )  # fmt: skip


def eddy_current_brake() -> Component:
    """Translational.Examples.EddyCurrentBrake of version 4.0, whose excitation is constant."""
    return assemble(
        "eddyCurrentForce.flange - mass.flange_a", "eddyCurrentForce.heatPort - heatCapacitor.port",
        eddyCurrentForce=translational.EddyCurrentForce(f_nominal=100.0, v_nominal=10.0, useHeatPort=True, TRef=293.15,
            alpha20=3.92e-3),
        mass=translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(20.0, fixed=True)),
        heatCapacitor=thermal.HeatCapacitor(C=1.0, T=start(293.15, fixed=True)),
    )  # fmt: skip
