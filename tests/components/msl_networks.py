"""Networks of the Modelica Standard Library 4.0: a filter of ideal amplifiers, and a pair of transistors."""

from __future__ import annotations

from acausal import Component
from acausal.components import blocks, electrical
from acausal.components.examples import assemble, start


def cauer_low_pass_opv() -> Component:
    """Electrical.Analog.Examples.CauerLowPassOPV."""
    return assemble(
        "Op1.in_p - G.p", "G1.p - Op2.in_p", "R1.n - Op1.in_n - C2.n - R2.n - C1.p - R3.p",
        "C1.n - R3.n - Op1.out - R4.p - C5.p", "R4.n - Op2.in_n - C3.p - R5.n",
        "R5.p - C2.p - C6.n - Op3.out - R9.p - C8.p", "C3.n - Op2.out - R2.p - R7.p",
        "R7.n - Op3.in_n - C5.n - R6.n - C6.p - C4.n", "C4.p - R8.p - R11.n - C9.n - Op5.out",
        "R8.n - R9.n - Op4.in_n - C7.p", "C7.n - R6.p - Op4.out - R10.p", "G2.p - Op3.in_p",
        "C9.p - R11.p - R10.n - Op5.in_n - C8.n", "Op4.in_p - G3.p", "Op5.in_p - G4.p", "V.p - Ground1.p",
        "V.n - R1.p",
        C1=electrical.Capacitor(C=1.33580177747, v=start(0.0, fixed=True)),
        C2=electrical.Capacitor(C=0.263801777467, v=start(0.0, fixed=True)),
        C3=electrical.Capacitor(C=1.304, v=start(0.0, fixed=True)),
        C4=electrical.Capacitor(C=0.836537833495, v=start(0.0, fixed=True)), C5=electrical.Capacitor(C=0.263801777467),
        R1=electrical.Resistor(R=1.0), R2=electrical.Resistor(R=1.0), R3=electrical.Resistor(R=1.0),
        Op1=electrical.IdealOpAmp3Pin(), G=electrical.Ground(), R4=electrical.Resistor(R=-1.0),
        R5=electrical.Resistor(R=-1.0), Op2=electrical.IdealOpAmp3Pin(), Op3=electrical.IdealOpAmp3Pin(),
        G1=electrical.Ground(), R6=electrical.Resistor(R=1.0), R7=electrical.Resistor(R=1.0),
        C6=electrical.Capacitor(C=2.78233961096), R8=electrical.Resistor(R=-1.0), R9=electrical.Resistor(R=-1.0),
        R10=electrical.Resistor(R=1.0), Op4=electrical.IdealOpAmp3Pin(), Op5=electrical.IdealOpAmp3Pin(),
        C7=electrical.Capacitor(C=0.8586, v=start(0.0, fixed=True)), C8=electrical.Capacitor(C=0.836537833495),
        C9=electrical.Capacitor(C=1.56273783349), R11=electrical.Resistor(R=1.0), G2=electrical.Ground(),
        G3=electrical.Ground(), G4=electrical.Ground(), V=electrical.StepVoltage(startTime=1.0, V=1.0),
        Ground1=electrical.Ground(),
    )  # fmt: skip


def _transistor() -> Component:
    """Electrical.Analog.Examples.Utilities.Transistor."""
    return assemble(
        "rtb.n - Tr.B - ct.p", "ct.n - Ground1.p", "Tr.C - rtc.p", "rtc.n - c", "b - rtb.p", "Tr.E - e",
        rtb=electrical.Resistor(R=0.05), rtc=electrical.Resistor(R=0.1), ct=electrical.Capacitor(C=1e-10),
        Tr=electrical.NPN(UIC=True), Ground1=electrical.Ground(), c=electrical.Pin(), b=electrical.Pin(),
        e=electrical.Pin(),
    )  # fmt: skip


def difference_amplifier() -> Component:
    """Electrical.Analog.Examples.DifferenceAmplifier."""
    return assemble(
        "V1.n - Gnd1.p", "C1.n - Gnd2.p", "I1.n - Gnd7.p", "C5.n - Gnd8.p", "C3.n - Gnd5.p", "R3.n - Gnd4.p",
        "C2.n - Gnd3.p", "C4.p - Gnd6.p", "I1.p - C5.p - Transistor1.e - Transistor2.e", "R1.p - V1.p",
        "R2.p - V2.p - R4.p", "V2.n - Gnd9.p", "R1.n - Transistor1.b - C1.p", "Transistor1.c - C2.p - R2.n",
        "Transistor2.b - R3.p - C3.p", "C4.n - Transistor2.c - R4.n",
        V1=electrical.ExpSineVoltage(V=0.2, f=200000000.0, damping=10000000.0),
        V2=electrical.RampVoltage(V=15.0, duration=1e-9), I1=electrical.RampCurrent(I=0.16, duration=1e-9),
        R1=electrical.Resistor(R=0.0001), R2=electrical.Resistor(R=100.0), R3=electrical.Resistor(R=0.0001),
        R4=electrical.Resistor(R=100.0), C1=electrical.Capacitor(C=1e-10, v=start(0.0, fixed=True)),
        C4=electrical.Capacitor(C=1e-10, v=start(0.0, fixed=True)),
        C5=electrical.Capacitor(C=1e-10, v=start(0.0, fixed=True)),
        C2=electrical.Capacitor(C=1e-10, v=start(0.0, fixed=True)),
        C3=electrical.Capacitor(C=1e-10, v=start(0.0, fixed=True)), Gnd1=electrical.Ground(), Gnd9=electrical.Ground(),
        Gnd3=electrical.Ground(), Gnd2=electrical.Ground(), Gnd6=electrical.Ground(), Gnd7=electrical.Ground(),
        Gnd8=electrical.Ground(), Gnd5=electrical.Ground(), Gnd4=electrical.Ground(), Transistor1=_transistor(),
        Transistor2=_transistor(),
    )  # fmt: skip


def _switched_capacitor(R: float) -> Component:
    """Electrical.Analog.Examples.Utilities.SwitchedCapacitor with a clock of 0.1 s; R < 0 by other wiring."""
    drive = "BooleanPulse.y - IdealCommutingSwitch2.control - "
    inverse = "not1.u", "not1.y - IdealCommutingSwitch1.control"
    control = (drive + inverse[0], inverse[1]) if R <= 0.0 else (drive + "IdealCommutingSwitch1.control",)
    return assemble(
        "IdealCommutingSwitch1.p - Capacitor.p", "Capacitor.n - IdealCommutingSwitch2.p",
        "Ground1.p - IdealCommutingSwitch1.n2", "Ground2.p - IdealCommutingSwitch2.n2", "IdealCommutingSwitch1.n1 - p",
        "IdealCommutingSwitch2.n1 - n", *control,
        BooleanPulse=blocks.BooleanPulse(period=0.1),
        Capacitor=electrical.Capacitor(C=0.1 / abs(R), v=start(0.0, fixed=True)),
        IdealCommutingSwitch1=electrical.IdealTwoWaySwitch(), IdealCommutingSwitch2=electrical.IdealTwoWaySwitch(),
        Ground1=electrical.Ground(), Ground2=electrical.Ground(), p=electrical.Pin(), n=electrical.Pin(),
        **({"not1": blocks.Not()} if R <= 0.0 else {}),
    )  # fmt: skip


def cauer_low_pass_sc() -> Component:
    """Electrical.Analog.Examples.CauerLowPassSC."""
    return assemble(
        "Op1.in_p - G.p", "G1.p - Op2.in_p", "Op1.in_n - C2.n - C1.p - R1.n - R2.n - R3.p",
        "C1.n - Op1.out - C5.p - R4.p - R3.n", "Op2.in_n - C3.p - R4.n - R5.n",
        "C2.p - C6.n - Op3.out - C8.p - R5.p - R9.p", "C3.n - Op2.out - R2.p - R7.p",
        "Op3.in_n - C5.n - C6.p - C4.n - Rp1.n - R7.n", "C4.p - C9.n - Op5.out - R8.p - R11.n",
        "Op4.in_n - C7.p - R8.n - R9.n", "C7.n - Op4.out - Rp1.p - R10.p", "G2.p - Op3.in_p",
        "C9.p - Op5.in_n - C8.n - R10.n - R11.p", "Op4.in_p - G3.p", "Op5.in_p - G4.p", "V.p - Ground1.p",
        "R1.p - V.n",
        C1=electrical.Capacitor(C=1.33580177747, v=start(0.0, fixed=True)),
        C2=electrical.Capacitor(C=0.263801777467, v=start(0.0, fixed=True)),
        C3=electrical.Capacitor(C=1.304, v=start(0.0, fixed=True)),
        C4=electrical.Capacitor(C=0.836537833495, v=start(0.0, fixed=True)), C5=electrical.Capacitor(C=0.263801777467),
        Op1=electrical.IdealOpAmp3Pin(), G=electrical.Ground(), Op2=electrical.IdealOpAmp3Pin(),
        Op3=electrical.IdealOpAmp3Pin(), G1=electrical.Ground(), C6=electrical.Capacitor(C=2.78233961096),
        Op4=electrical.IdealOpAmp3Pin(), Op5=electrical.IdealOpAmp3Pin(),
        C7=electrical.Capacitor(C=0.8586, v=start(0.0, fixed=True)), C8=electrical.Capacitor(C=0.836537833495),
        C9=electrical.Capacitor(C=1.56273783349), G2=electrical.Ground(), G3=electrical.Ground(),
        G4=electrical.Ground(), V=electrical.StepVoltage(startTime=1.0, V=1.0), Ground1=electrical.Ground(),
        R4=_switched_capacitor(-1.0), R5=_switched_capacitor(-1.0), R8=_switched_capacitor(-1.0),
        R9=_switched_capacitor(-1.0), R1=_switched_capacitor(1.0), R2=_switched_capacitor(1.0),
        R3=_switched_capacitor(1.0), Rp1=_switched_capacitor(1.0), R7=_switched_capacitor(1.0),
        R10=_switched_capacitor(1.0), R11=_switched_capacitor(1.0),
    )  # fmt: skip


def singular_transformer() -> Component:
    """ModelicaTest.Electrical.SingularTransformer: coupled so well that its currents are one state."""
    return assemble(
        "sineVoltage1.n - ground1.p - basicTransformer.n1", "sineVoltage1.p - resistor11.p",
        "load1.n - ground2.p - basicTransformer.n2", "resistor12.n - load1.p", "basicTransformer.p1 - resistor11.n",
        "basicTransformer.p2 - resistor12.p",
        sineVoltage1=electrical.SineVoltage(V=220.0, f=50.0), ground1=electrical.Ground(),
        resistor11=electrical.Resistor(R=0.1), resistor12=electrical.Resistor(R=0.1), load1=electrical.Resistor(R=2.0),
        ground2=electrical.Ground(),
        basicTransformer=electrical.Transformer(L1=2.0, L2=2.0, M=2.0, i1=start(0.0, fixed=True)),
    )  # fmt: skip
