"""Circuits of the Modelica Standard Library 4.0 that switch, and a resistor that heats a room."""

from __future__ import annotations

from acausal import Component
from acausal.components import electrical, thermal
from acausal.components.examples import assemble, start


def resistor() -> Component:
    """Electrical.Analog.Examples.Resistor."""
    return assemble(
        "SineVoltage1.n - G.p - resistor.n", "resistor.heatPort - thermalConductor.port_a",
        "SineVoltage1.p - resistor.p", "thermalConductor.port_b - fixedTemperature.port",
        resistor=electrical.Resistor(R=100.0, alpha=0.001, T_ref=293.15, i=start(0.0), useHeatPort=True),
        G=electrical.Ground(), SineVoltage1=electrical.SineVoltage(V=220.0, f=1.0),
        thermalConductor=thermal.ThermalConductor(G=50.0), fixedTemperature=thermal.celsius.FixedTemperature(T=20.0),
    )  # fmt: skip


def controlled_switch_with_arc() -> Component:
    """Electrical.Analog.Examples.ControlledSwitchWithArc."""
    return assemble(
        "inductor1.n - resistor1.p", "resistor1.n - ground1.p - constantVoltage1.n", "switch1.n - inductor1.p",
        "constantVoltage1.p - switch1.p", "inductor2.n - resistor2.p", "resistor2.n - ground2.p - constantVoltage2.n",
        "switch2.n - inductor2.p", "constantVoltage2.p - switch2.p",
        "sineVoltage.p - switch1.control - switch2.control", "sineVoltage.n - ground.p",
        ground1=electrical.Ground(), constantVoltage1=electrical.ConstantVoltage(V=50.0),
        inductor1=electrical.Inductor(L=0.1, i=start(0.0, fixed=True)), resistor1=electrical.Resistor(R=1.0),
        switch1=electrical.ControlledIdealClosingSwitch(), ground2=electrical.Ground(),
        constantVoltage2=electrical.ConstantVoltage(V=50.0),
        inductor2=electrical.Inductor(L=0.1, i=start(0.0, fixed=True)), resistor2=electrical.Resistor(R=1.0),
        switch2=electrical.ControlledCloserWithArc(V0=30.0, dVdt=10000.0, Vmax=60.0),
        sineVoltage=electrical.SineVoltage(V=1.0, f=1.0), ground=electrical.Ground(),
    )  # fmt: skip


def simple_triac_circuit() -> Component:
    """Electrical.Analog.Examples.SimpleTriacCircuit."""
    return assemble(
        "L.n - R.p", "R.n - V.p", "V.n - ground.p - simpleTriac.p - trapezoidCurrent.p", "simpleTriac.n - L.p",
        "trapezoidCurrent.n - simpleTriac.g",
        ground=electrical.Ground(), L=electrical.Inductor(L=2e-6, i=start(0.0, fixed=True)),
        R=electrical.Resistor(R=10.0), V=electrical.SineVoltage(V=30.0, f=10000.0),
        simpleTriac=electrical.SimpleTriac(VDRM=400.0, VRRM=400.0),
        trapezoidCurrent=electrical.TrapezoidCurrent(I=0.005, rising=1e-6, width=5e-6, falling=1e-6, startTime=2e-5,
            period=5e-5),
    )  # fmt: skip


def _nand() -> Component:
    """Electrical.Analog.Examples.Utilities.Nand."""
    p_channel = electrical.PMOS(W=6.5e-6, L=3.1e-6, Beta=1.05e-5, Vt=-1.0, K2=0.41, K5=0.8385, dW=-2.5e-6, dL=-2.1e-6)
    n_channel = electrical.NMOS(W=6.5e-6, L=3.1e-6, Beta=4.1e-5, Vt=0.8, K2=1.144, K5=0.7311, dW=-2.5e-6, dL=-1.5e-6)
    return assemble(
        "TN1.S - TN2.D - C7.p", "TP1.S - TP2.S - TN1.D - C4.p - y", "TP1.G - TN1.G - x2", "TP2.G - TN2.G - x1",
        "TP1.D - TP2.D - Vdd", "TN2.B - TN2.S - TN1.B - TP1.B - TP2.B - C4.n - C7.n - Gnd.p",
        TP1=p_channel, TP2=p_channel, TN1=n_channel, TN2=n_channel, Gnd=electrical.Ground(),
        C4=electrical.Capacitor(C=0.4e-13, v=start(0.0, fixed=True)),
        C7=electrical.Capacitor(C=0.4e-13, v=start(0.0, fixed=True)),
        x1=electrical.Pin(), x2=electrical.Pin(), Vdd=electrical.Pin(), y=electrical.Pin(),
    )  # fmt: skip


def nand_gate() -> Component:
    """Electrical.Analog.Examples.NandGate."""
    return assemble(
        "VDD.n - Gnd1.p", "VIN1.n - Gnd4.p", "VIN2.n - Gnd5.p", "Nand.Vdd - VDD.p", "VIN1.p - Nand.x1",
        "VIN2.p - Nand.x2",
        VIN1=electrical.TrapezoidVoltage(V=3.5, startTime=2e-8, rising=1e-9, width=1.9e-8, falling=1e-9, period=4e-8),
        VIN2=electrical.TrapezoidVoltage(V=3.5, startTime=1e-8, rising=1e-9, width=1.9e-8, falling=1e-9, period=4e-8),
        VDD=electrical.RampVoltage(V=5.0, duration=1e-9), Gnd1=electrical.Ground(), Gnd4=electrical.Ground(),
        Gnd5=electrical.Ground(), Nand=_nand(),
    )  # fmt: skip
