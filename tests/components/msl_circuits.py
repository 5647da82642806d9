"""Circuits of the Modelica Standard Library 4.0, from library components with its names."""

from __future__ import annotations

import math

from acausal import Component
from acausal.components import blocks, electrical, thermal
from acausal.components.examples import assemble, start


def rectifier() -> Component:
    """Electrical.Analog.Examples.Rectifier."""
    return assemble(
        "SineVoltage1.n - SineVoltage2.n - SineVoltage3.n", "SineVoltage1.p - Inductor1.p",
        "SineVoltage2.p - Inductor2.p", "SineVoltage3.p - Inductor3.p", "IdealDiode1.p - IdealDiode4.n - Inductor1.n",
        "IdealDiode2.p - IdealDiode5.n - Inductor2.n", "IdealDiode3.p - IdealDiode6.n - Inductor3.n",
        "IdealDiode1.n - IdealDiode2.n - IdealDiode3.n - Capacitor1.p - SignalCurrent1.p",
        "IdealDiode4.p - IdealDiode5.p - IdealDiode6.p - Capacitor2.n - SignalCurrent1.n",
        "Capacitor1.n - Capacitor2.p - Ground1.p", "Constant1.y - SignalCurrent1.i",
        SineVoltage1=electrical.SineVoltage(f=50.0, V=400 * math.sqrt(2 / 3)),
        SineVoltage2=electrical.SineVoltage(f=50.0, phase=-2 * math.pi / 3, V=400 * math.sqrt(2 / 3)),
        SineVoltage3=electrical.SineVoltage(f=50.0, phase=-4 * math.pi / 3, V=400 * math.sqrt(2 / 3)),
        Inductor1=electrical.Inductor(L=6e-5), Inductor2=electrical.Inductor(L=6e-5, i=start(0.0, fixed=True)),
        Inductor3=electrical.Inductor(L=6e-5, i=start(0.0, fixed=True)),
        IdealDiode1=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        IdealDiode2=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        IdealDiode3=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        IdealDiode4=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        IdealDiode5=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        IdealDiode6=electrical.IdealDiode(Ron=0.001, Goff=0.001, Vknee=2.0),
        Capacitor1=electrical.Capacitor(C=0.03, v=start(200 * math.sqrt(2), fixed=True)),
        Capacitor2=electrical.Capacitor(C=0.03, v=start(200 * math.sqrt(2), fixed=True)), Ground1=electrical.Ground(),
        SignalCurrent1=electrical.SignalCurrent(), Constant1=blocks.Constant(k=500.0),
    )  # fmt: skip


def heating_rectifier() -> Component:
    """Electrical.Analog.Examples.HeatingRectifier."""
    return assemble(
        "SineVoltage1.p - HeatingDiode1.p", "SineVoltage1.n - G.p - Capacitor1.n - R.n",
        "HeatingDiode1.n - Capacitor1.p - R.p", "HeatingDiode1.heatPort - ThermalConductor1.port_a",
        "ThermalConductor1.port_b - HeatCapacitor1.port",
        HeatingDiode1=electrical.Diode(useTemperatureDependency=True, useHeatPort=True), G=electrical.Ground(),
        SineVoltage1=electrical.SineVoltage(V=1.0, f=1.0),
        Capacitor1=electrical.Capacitor(C=1.0, v=start(0.0, fixed=True)),
        HeatCapacitor1=thermal.HeatCapacitor(C=1.0, T=start(293.15, fixed=True)),
        ThermalConductor1=thermal.ThermalConductor(G=10.0), R=electrical.Resistor(R=1.0),
    )  # fmt: skip


def heating_mos_inverter() -> Component:
    """Electrical.Analog.Examples.HeatingMOSInverter."""
    return assemble(
        "Sin.n - G.p - Capacitor1.n - H_NMOS.B - H_NMOS.S - V.n", "H_PMOS.S - H_NMOS.D - Capacitor1.p",
        "H_PMOS.B - H_PMOS.D - V.p", "TC1.port_b - HeatCapacitor1.port - TC2.port_b - TC3.port_a",
        "TC1.port_a - H_PMOS.heatPort", "TC2.port_a - H_NMOS.heatPort", "TC3.port_b - FixedTemperature1.port",
        "Sin.p - H_NMOS.G - H_PMOS.G",
        G=electrical.Ground(), Sin=electrical.SineVoltage(V=5.0, f=1.0),
        Capacitor1=electrical.Capacitor(C=1e-5, v=start(0.0, fixed=True)),
        HeatCapacitor1=thermal.HeatCapacitor(C=0.01, T=start(293.15, fixed=True)),
        TC1=thermal.ThermalConductor(G=0.01), H_PMOS=electrical.PMOS(useTemperatureDependency=True),
        H_NMOS=electrical.NMOS(useTemperatureDependency=True), V=electrical.RampVoltage(V=5.0, duration=0.01),
        TC2=thermal.ThermalConductor(G=0.01), FixedTemperature1=thermal.FixedTemperature(T=300.0),
        TC3=thermal.ThermalConductor(G=0.01),
    )  # fmt: skip


def switch_with_arc() -> Component:
    """Electrical.Analog.Examples.SwitchWithArc."""
    return assemble(
        "inductor1.n - resistor1.p", "resistor1.n - ground1.p - constantVoltage1.n", "switch1.n - inductor1.p",
        "constantVoltage1.p - switch1.p", "inductor2.n - resistor2.p", "resistor2.n - ground2.p - constantVoltage2.n",
        "switch2.n - inductor2.p", "constantVoltage2.p - switch2.p",
        "booleanPulse.y - switch1.control - switch2.control",
        booleanPulse=blocks.BooleanPulse(period=1.0), ground1=electrical.Ground(),
        constantVoltage1=electrical.ConstantVoltage(V=50.0),
        inductor1=electrical.Inductor(L=0.1, i=start(0.0, fixed=True)), resistor1=electrical.Resistor(R=1.0),
        switch1=electrical.IdealClosingSwitch(), ground2=electrical.Ground(),
        constantVoltage2=electrical.ConstantVoltage(V=50.0),
        inductor2=electrical.Inductor(L=0.1, i=start(0.0, fixed=True)), resistor2=electrical.Resistor(R=1.0),
        switch2=electrical.CloserWithArc(dVdt=1e4, V0=30.0, Vmax=60.0),
    )  # fmt: skip


def thyristor_behaviour_test() -> Component:
    """Electrical.Analog.Examples.ThyristorBehaviourTest."""
    return assemble(
        "sineVoltage.n - ground.p - inductor.n", "sineVoltage.p - thyristor_v4_1.Anode",
        "resistor.p - thyristor_v4_1.Cathode - pulseCurrent.p", "pulseCurrent.n - thyristor_v4_1.Gate",
        "resistor.n - inductor.p",
        ground=electrical.Ground(), sineVoltage=electrical.SineVoltage(V=30.0, f=1e4),
        resistor=electrical.Resistor(R=10.0),
        pulseCurrent=electrical.PulseCurrent(width=10.0, period=0.0001, startTime=2e-5, I=0.005),
        thyristor_v4_1=electrical.Thyristor(vControl=start(0.0, fixed=True)),
        inductor=electrical.Inductor(L=2e-6, i=start(0.0, fixed=True)),
    )  # fmt: skip


def amplifier_with_op_amp_detailed() -> Component:
    """Electrical.Analog.Examples.AmplifierWithOpAmpDetailed."""
    return assemble(
        "resistor.n - opAmp.m - resistor1.p", "resistor1.n - resistor2.p - opAmp.outp", "resistor.p - sineVoltage.p",
        "sineVoltage.n - ground.p - opAmp.p - resistor2.n - constantVoltage.n - constantVoltage1.n",
        "opAmp.p_supply - constantVoltage.p", "opAmp.m_supply - constantVoltage1.p",
        opAmp=electrical.OpAmpDetailed(), resistor=electrical.Resistor(R=1e4),
        resistor1=electrical.Resistor(R=20000.0), resistor2=electrical.Resistor(R=1e4),
        sineVoltage=electrical.SineVoltage(V=12.0, f=1000.0), ground=electrical.Ground(),
        constantVoltage=electrical.ConstantVoltage(V=15.0), constantVoltage1=electrical.ConstantVoltage(V=-15.0),
    )  # fmt: skip


def lc_oscillator() -> Component:
    """Electrical.Analog.Examples.OpAmps.LCOscillator."""
    return assemble(
        "opAmp.out - r.p - r2.p", "r2.n - r1.p - opAmp.in_n", "r1.n - ground.p - l.n - c.n - vOut.n",
        "r.n - opAmp.in_p - l.p - c.p - vOut.p",
        ground=electrical.Ground(), opAmp=electrical.OpAmpLimited(), r=electrical.Resistor(R=1e4),
        r2=electrical.Resistor(R=10.0, i=start(0.0)), r1=electrical.Resistor(R=1e4),
        c=electrical.Capacitor(C=1 / (0.001 * (2 * math.pi * 1000.0) ** 2), v=start(10.0, fixed=True)),
        l=electrical.Inductor(L=0.001, i=start(0.0, fixed=True)), vOut=electrical.VoltageSensor(),
    )  # fmt: skip


def ideal_triac_circuit() -> Component:
    """Electrical.Analog.Examples.IdealTriacCircuit."""
    triac = electrical.IdealTriac(capacitor=electrical.Capacitor(v=start(0.0, fixed=True)))
    return assemble(
        "V.n - ground.p - idealTriac.p", "R.p - V.p", "R.n - idealTriac.n", "booleanPulse.y - idealTriac.fire1",
        ground=electrical.Ground(), R=electrical.Resistor(R=20.0), V=electrical.SineVoltage(V=5.0, f=2.0),
        booleanPulse=blocks.BooleanPulse(width=50.0, period=0.25, startTime=0.1), idealTriac=triac,
    )  # fmt: skip
