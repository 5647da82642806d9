"""More circuits of the Modelica Standard Library 4.0: characteristics, limits and amplifiers."""

from __future__ import annotations

import math

from acausal import Component
from acausal.components import blocks, electrical
from acausal.components.examples import assemble, start


def characteristic_ideal_diodes() -> Component:
    """Electrical.Analog.Examples.CharacteristicIdealDiodes."""
    return assemble(
        "Ground1.p - SineVoltage1.n - R1.n - R2.n - R3.n - SineVoltage2.n - SineVoltage3.n", "Ideal.n - R1.p",
        "With_Ron_Goff.n - R2.p", "With_Ron_Goff_Vknee.n - R3.p", "SineVoltage2.p - Ideal.p",
        "SineVoltage1.p - With_Ron_Goff.p", "With_Ron_Goff_Vknee.p - SineVoltage3.p",
        Ideal=electrical.IdealDiode(Ron=0.0, Goff=0.0, Vknee=0.0),
        With_Ron_Goff=electrical.IdealDiode(Ron=0.1, Goff=0.1, Vknee=0.0),
        With_Ron_Goff_Vknee=electrical.IdealDiode(Ron=0.2, Goff=0.2, Vknee=5.0),
        SineVoltage1=electrical.SineVoltage(V=10.0, offset=-9.0, f=1.0), Ground1=electrical.Ground(),
        R1=electrical.Resistor(R=0.001), R2=electrical.Resistor(R=0.001), R3=electrical.Resistor(R=0.001),
        SineVoltage2=electrical.SineVoltage(V=10.0, offset=0.0, f=1.0),
        SineVoltage3=electrical.SineVoltage(V=10.0, offset=0.0, f=1.0),
    )  # fmt: skip


def characteristic_thyristors() -> Component:
    """Electrical.Analog.Examples.CharacteristicThyristors."""
    return assemble(
        "IdealThyristor1.n - R3.p", "Ground1.p - SineVoltage1.n - R2.n - R4.n - R3.n - R1.n",
        "SineVoltage1.p - IdealThyristor1.p - IdealGTOThyristor1.p - IdealGTOThyristor2.p - IdealThyristor2.p",
        "IdealGTOThyristor1.n - R1.p", "IdealGTOThyristor1.fire - IdealThyristor1.fire - booleanStep1.y",
        "IdealThyristor2.n - R2.p", "IdealGTOThyristor2.n - R4.p",
        "IdealGTOThyristor2.fire - IdealThyristor2.fire - booleanPulse.y",
        IdealThyristor1=electrical.IdealThyristor(off=start(True, fixed=True), Vknee=1.0),
        SineVoltage1=electrical.SineVoltage(V=10.0, offset=0.0, f=1.0), Ground1=electrical.Ground(),
        R3=electrical.Resistor(R=0.001),
        IdealGTOThyristor1=electrical.IdealGTOThyristor(off=start(True, fixed=True), Vknee=1.0),
        R1=electrical.Resistor(R=0.001), booleanStep1=blocks.BooleanTable(table=(1.25, 3.2, 4.2, 4.25, 5.7, 5.72)),
        IdealThyristor2=electrical.IdealThyristor(off=start(True, fixed=True), Vknee=1.0),
        R2=electrical.Resistor(R=0.001),
        IdealGTOThyristor2=electrical.IdealGTOThyristor(off=start(True, fixed=True), Vknee=1.0),
        R4=electrical.Resistor(R=0.001), booleanPulse=blocks.BooleanPulse(width=20.0, period=1.0, startTime=0.15),
    )  # fmt: skip


def comparator() -> Component:
    """Electrical.Analog.Examples.OpAmps.Comparator."""
    return assemble(
        "vIn.p - opAmp.in_p", "opAmp.out - vOut.p", "ground.p - vOut.n - vIn.n - supplyVoltage.ground",
        "potentiometer.contact - opAmp.in_n", "potentiometer.pin_p - supplyVoltage.pin_p",
        "potentiometer.pin_n - supplyVoltage.pin_n",
        opAmp=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0), ground=electrical.Ground(),
        vOut=electrical.VoltageSensor(), potentiometer=electrical.Potentiometer(R=1000.0, rConstant=0.5),
        supplyVoltage=electrical.SupplyVoltage(Vps=15.0, Vns=-15.0),
        vIn=electrical.TrapezoidVoltage(rising=0.02, width=0.03, falling=0.02, period=0.1, startTime=-0.035, V=10.0,
            offset=-5.0),
    )  # fmt: skip


def show_saturating_inductor() -> Component:
    """Electrical.Analog.Examples.ShowSaturatingInductor."""
    return assemble(
        "SineVoltage1.n - Ground1.p - SaturatingInductance1.n - Inductance1.n",
        "SaturatingInductance1.p - SineVoltage1.p - Inductance1.p",
        SineVoltage1=electrical.SineVoltage(V=1.25, phase=math.pi / 2, f=0.159154943092), Ground1=electrical.Ground(),
        SaturatingInductance1=electrical.SaturatingInductor(
            Lzer=2.0, Lnom=1.0, Inom=1.0, Linf=0.5, i=start(0.0, fixed=True)
        ), Inductance1=electrical.Inductor(L=1.0, i=start(0.0, fixed=True)),
    )  # fmt: skip


def show_variable_resistor() -> Component:
    """Electrical.Analog.Examples.ShowVariableResistor."""
    return assemble(
        "R1.n - R2.p", "R2.n - R3.p", "R4.n - VariableResistor.p", "VariableResistor.n - R5.p",
        "R3.n - Ground2.p - R5.n", "SineVoltage1.p - Ground1.p", "SineVoltage1.n - R1.p - R4.p",
        "Ramp1.y - VariableResistor.R",
        VariableResistor=electrical.VariableResistor(), Ground1=electrical.Ground(), Ground2=electrical.Ground(),
        R1=electrical.Resistor(R=1.0), R2=electrical.Resistor(R=1.0), R3=electrical.Resistor(R=1.0),
        R4=electrical.Resistor(R=1.0), R5=electrical.Resistor(R=1.0),
        SineVoltage1=electrical.SineVoltage(V=1.0, f=1.0), Ramp1=blocks.Ramp(height=5.0, offset=2.0, duration=2.0),
    )  # fmt: skip


def overvoltage_protection() -> Component:
    """Electrical.Analog.Examples.OvervoltageProtection."""
    return assemble(
        "sineVoltage.p - Rv.p", "RL.p - CL.p - zDiode1.p - Rv.n", "RL.n - CL.n - sineVoltage.n - zDiode.p - ground.p",
        "zDiode1.n - zDiode.n",
        sineVoltage=electrical.SineVoltage(offset=0.0, V=10.0, f=5.0), Rv=electrical.Resistor(R=20.0),
        RL=electrical.Resistor(R=2000.0), ground=electrical.Ground(),
        CL=electrical.Capacitor(C=1e-7, v=start(0.0, fixed=True)), zDiode=electrical.ZDiode(),
        zDiode1=electrical.ZDiode(v=start(0.0)),
    )  # fmt: skip


def inverting_amp() -> Component:
    """Electrical.Analog.Examples.InvertingAmp."""
    return assemble(
        "r1.n - r2.n - opAmp.in_n", "r2.p - opAmp.out - vOut.p", "ground.p - opAmp.in_p - vIn.n - vOut.n",
        "vIn.p - r1.p", "ground1.p - vSourcePos.n - vSourceNeg.n", "vSourcePos.p - opAmp.VMax",
        "vSourceNeg.p - opAmp.VMin",
        opAmp=electrical.IdealOpAmpLimited(), ground=electrical.Ground(), vOut=electrical.VoltageSensor(),
        r1=electrical.Resistor(R=1000.0), r2=electrical.Resistor(R=2000.0), ground1=electrical.Ground(),
        vSourcePos=electrical.ConstantVoltage(V=15.0), vSourceNeg=electrical.ConstantVoltage(V=-15.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def schmitt_trigger() -> Component:
    """Electrical.Analog.Examples.OpAmps.SchmittTrigger."""
    return assemble(
        "ground.p - vIn.n - vOut.n - opAmp.in_n", "opAmp.out - vOut.p - r2.n", "r2.p - opAmp.in_p - r1.n",
        "r1.p - vIn.p",
        opAmp=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0), ground=electrical.Ground(),
        vOut=electrical.VoltageSensor(), r1=electrical.Resistor(R=1000.0), r2=electrical.Resistor(R=15000.0),
        vIn=electrical.TrapezoidVoltage(rising=0.02, width=0.03, falling=0.02, period=0.1, startTime=-0.035, V=10.0,
            offset=-5.0),
    )  # fmt: skip
