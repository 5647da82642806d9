"""Modelica's gates of bipolar transistors, from the library's components; their capacitances are zero."""

from __future__ import annotations

from acausal import Component, start
from acausal.components import electrical, thermal
from acausal.components.electrical.transistors import PartialBipolar
from acausal.components.examples import assemble


def heating_npn_norgate() -> Component:
    """Electrical.Analog.Examples.HeatingNPN_NORGate."""
    return norgate(electrical.NPN, 6.0, "V.p - RI.n", "V.n - Gnd.p")


def heating_pnp_norgate() -> Component:
    """Electrical.Analog.Examples.HeatingPNP_NORGate."""
    return norgate(electrical.PNP, -6.0, "V.n - RI.n", "V.p - Gnd.p")


def norgate(kind: type[PartialBipolar], inputs: float, *supply: str) -> Component:
    """The gate of transistors of one kind, the voltage of its inputs, and how it is supplied."""

    def transistor() -> PartialBipolar:
        return kind(
            Bf=100.0, Br=1.0, Is=1e-14, Vak=0.0, Tauf=0.0, Taur=0.0, Ccs=0.0, Cje=0.0, Cjc=0.0, Phie=1.0, Me=0.5,
            Phic=1.0, Mc=0.5, Gbc=1e-12, Gbe=1e-12, EMax=40.0, useTemperatureDependency=True, useHeatPort=True,
        )  # fmt: skip

    def signal(begin: float) -> electrical.TrapezoidVoltage:
        return electrical.TrapezoidVoltage(
            V=inputs, startTime=begin, rising=5.0, width=15.0, falling=5.0, period=50.0, nperiod=10
        )

    return assemble(
        *supply, "V1.p - R1.p", "V2.p - R2.p", "Gnd1.p - V1.n", "Gnd2.p - V2.n", "Gnd7.p - C1.n", "Gnd6.p - C2.n",
        "Gnd5.p - C3.n", "C2.p - RI.p - T1.C - T2.C", "C3.p - R2.n - T2.B", "C1.p - R1.n - T1.B", "T1.E - Gnd3.p",
        "T2.E - Gnd4.p", "TC1.port_b - HeatCapacitor1.port - TC2.port_b", "TC2.port_a - T2.heatPort",
        "TC1.port_a - T1.heatPort",
        HeatCapacitor1=thermal.HeatCapacitor(C=0.1, T=start(293.15, fixed=True)), TC1=thermal.ThermalConductor(G=0.01),
        TC2=thermal.ThermalConductor(G=0.01), V=electrical.RampVoltage(V=6.0, duration=5.0), V1=signal(55.0),
        V2=signal(65.0), R1=electrical.Resistor(R=1800.0), R2=electrical.Resistor(R=1800.0),
        RI=electrical.Resistor(R=40.0), C1=electrical.Capacitor(C=0.0), C2=electrical.Capacitor(C=0.0),
        C3=electrical.Capacitor(C=0.0), T1=transistor(), T2=transistor(),
        **{name: electrical.Ground() for name in ("Gnd", "Gnd1", "Gnd2", "Gnd3", "Gnd4", "Gnd5", "Gnd6", "Gnd7")},
    )  # fmt: skip
