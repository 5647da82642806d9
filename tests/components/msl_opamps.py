"""Operational amplifiers of the Modelica Standard Library 4.0 (Electrical.Analog.Examples.OpAmps), with its names."""

from __future__ import annotations

import math

from acausal import Component
from acausal.components import blocks, electrical
from acausal.components.examples import assemble, start


def _circuit(*connections: str, **parts: Component) -> Component:
    """OpAmps.OpAmpCircuits.PartialOpAmp: an amplifier between the pins of two ports, completed by `parts`."""
    pins = {name: electrical.Pin() for name in ("p1", "n1", "p2", "n2")}
    amplifier = electrical.IdealizedOpAmpLimited(V0=15000.0, Vps=15.0, Vns=-15.0)
    return assemble("n1 - n2", "opAmp.out - p2", *connections, **pins, opAmp=amplifier, **parts)


def _add() -> Component:
    """OpAmpCircuits.Add with both weights 1."""
    return _circuit(
        "p1 - r1.p", "p1_2 - r2.p", "n1 - opAmp.in_p", "opAmp.in_n - r1.n - r2.n - r.n", "opAmp.out - r.p",
        r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=1e3), r=electrical.Resistor(R=1e3),
        p1_2=electrical.Pin(),
    )  # fmt: skip


def _feedback() -> Component:
    """OpAmpCircuits.Feedback of amplification 1."""
    return _circuit(
        "p1 - r1.p", "opAmp.in_n - r1.n - r3.n", "opAmp.out - r3.p", "p1_2 - r2.p", "opAmp.in_p - r2.n - r4.p",
        "n1 - r4.n", r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=1e3), r3=electrical.Resistor(R=1e3),
        r4=electrical.Resistor(R=1e3), p1_2=electrical.Pin(),
    )  # fmt: skip


def _gain(k: float) -> Component:
    """OpAmpCircuits.Gain."""
    return _circuit("opAmp.out - r2.p", "opAmp.in_n - r1.n - r2.n", "r1.p - p1", "n1 - opAmp.in_p",
                    r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=k * 1e3))  # fmt: skip


def _buffer(k: float) -> Component:
    """OpAmpCircuits.Buffer."""
    return _circuit("n1 - r1.n", "opAmp.out - r2.p", "opAmp.in_n - r1.p - r2.n", "opAmp.in_p - p1",
                    r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=(k - 1) * 1e3))  # fmt: skip


def _integrator(k: float, f: float) -> Component:
    """OpAmpCircuits.Integrator."""
    return _circuit("n1 - opAmp.in_p", "p1 - r.p", "opAmp.in_n - r.n - c.n", "opAmp.out - c.p",
                    r=electrical.Resistor(R=1e3), c=_capacitor(1 / k / (2 * math.pi * f * 1e3)))  # fmt: skip


def _der(k: float, f: float) -> Component:
    """OpAmpCircuits.Der."""
    return _circuit("n1 - opAmp.in_p", "p1 - c.p", "opAmp.in_n - c.n - r.n", "opAmp.out - r.p",
                    r=electrical.Resistor(R=1e3), c=_capacitor(k / (2 * math.pi * f * 1e3)))  # fmt: skip


def _first_order(T: float) -> Component:
    """OpAmpCircuits.FirstOrder of amplification 1."""
    return _circuit("n1 - opAmp.in_p", "p1 - r1.p", "opAmp.in_n - r1.n - r2.n - c.n", "opAmp.out - r2.p - c.p",
                    r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=1e3), c=_capacitor(T / 1e3))  # fmt: skip


def _derivative(T: float) -> Component:
    """OpAmpCircuits.Derivative of amplification 1."""
    return _circuit("n1 - opAmp.in_p", "p1 - c.p", "c.n - r1.p", "opAmp.in_n - r1.n - r2.n", "opAmp.out - r2.p",
                    r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=1e3), c=_capacitor(T / 1e3))  # fmt: skip


def _pi(k: float, T: float) -> Component:
    """OpAmpCircuits.PI."""
    return _circuit("n1 - opAmp.in_p", "p1 - r1.p", "opAmp.in_n - r1.n - r2.n", "r2.p - c.n", "opAmp.out - c.p",
                    r1=electrical.Resistor(R=1e3), r2=electrical.Resistor(R=k * 1e3),
                    c=_capacitor(T / k / 1e3))  # fmt: skip


def _capacitor(C: float) -> Component:
    return electrical.Capacitor(C=C, v=start(0.0, fixed=True))


def adder() -> Component:
    """Electrical.Analog.Examples.OpAmps.Adder."""
    return assemble(
        "add.n1 - ground.p - vIn2.n - vIn1.n", "vIn1.p - add.p1", "vIn2.p - add.p1_2", "add.p2 - vOut.n",
        "add.n2 - vOut.p",
        ground=electrical.Ground(), vIn1=electrical.SineVoltage(V=5.0, f=10.0), vIn2=electrical.ConstantVoltage(V=5.0),
        vOut=electrical.VoltageSensor(), add=_add(),
    )  # fmt: skip


def subtracter() -> Component:
    """Electrical.Analog.Examples.OpAmps.Subtracter."""
    return assemble(
        "feedback.n1 - ground.p - vIn2.n - vIn1.n", "vIn1.p - feedback.p1", "vIn2.p - feedback.p1_2",
        "feedback.p2 - vOut.n", "feedback.n2 - vOut.p",
        ground=electrical.Ground(), vIn1=electrical.SineVoltage(V=5.0, f=10.0), vIn2=electrical.ConstantVoltage(V=5.0),
        vOut=electrical.VoltageSensor(), feedback=_feedback(),
    )  # fmt: skip


def inverting_amplifier() -> Component:
    """Electrical.Analog.Examples.OpAmps.InvertingAmplifier."""
    return assemble(
        "vIn.p - gain.p1", "gain.n1 - ground.p - vIn.n", "gain.p2 - vOut.n", "gain.n2 - vOut.p",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), gain=_gain(k=2.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def non_inverting_amplifier() -> Component:
    """Electrical.Analog.Examples.OpAmps.NonInvertingAmplifier."""
    return assemble(
        "vIn.n - buffer.n1 - ground.p", "vIn.p - buffer.p1", "buffer.p2 - vOut.p", "buffer.n2 - vOut.n",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), buffer=_buffer(k=2.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def voltage_follower() -> Component:
    """Electrical.Analog.Examples.OpAmps.VoltageFollower."""
    return assemble(
        "ground.p - vIn.n - vOut.n - rl.n", "opAmp.out - vOut.p - opAmp.in_n - rl.p", "vIn.p - ri.p",
        "ri.n - opAmp.in_p",
        opAmp=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0, v_in=start(0.0)), ground=electrical.Ground(),
        vOut=electrical.VoltageSensor(), ri=electrical.Resistor(R=1.0), rl=electrical.Resistor(R=1.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def inverting_schmitt_trigger() -> Component:
    """Electrical.Analog.Examples.OpAmps.InvertingSchmittTrigger."""
    return assemble(
        "r2.n - r1.p - opAmp.in_p", "ground.p - r1.n - vIn.n - vOut.n", "opAmp.out - r2.p - vOut.p",
        "vIn.p - opAmp.in_n",
        opAmp=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0), ground=electrical.Ground(),
        vOut=electrical.VoltageSensor(), r1=electrical.Resistor(R=1000.0), r2=electrical.Resistor(R=14000.0),
        vIn=electrical.TrapezoidVoltage(rising=0.02, width=0.03, falling=0.02, period=0.1, startTime=-0.035, V=10.0,
            offset=-5.0),
    )  # fmt: skip


def low_pass() -> Component:
    """Electrical.Analog.Examples.OpAmps.LowPass."""
    return assemble(
        "firstOrder.n1 - ground.p - vIn.n", "firstOrder.p2 - vOut.p", "firstOrder.n2 - vOut.n",
        "vIn.p - firstOrder.p1",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), firstOrder=_first_order(T=0.159154943092),
        vIn=electrical.TrapezoidVoltage(V=5.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=0.0,
            startTime=-0.035),
    )  # fmt: skip


def high_pass() -> Component:
    """Electrical.Analog.Examples.OpAmps.HighPass."""
    return assemble(
        "derivative.n1 - ground.p - vIn.n", "derivative.p2 - vOut.p", "derivative.n2 - vOut.n",
        "vIn.p - derivative.p1",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), derivative=_derivative(T=0.159154943092),
        vIn=electrical.TrapezoidVoltage(V=5.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=0.0,
            startTime=-0.035),
    )  # fmt: skip


def integrator() -> Component:
    """Electrical.Analog.Examples.OpAmps.Integrator."""
    return assemble(
        "integrator.n1 - ground.p - vIn.n", "integrator.p2 - vOut.p", "integrator.n2 - vOut.n",
        "vIn.p - integrator.p1",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), integrator=_integrator(k=2.0, f=10.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def differentiator() -> Component:
    """Electrical.Analog.Examples.OpAmps.Differentiator."""
    return assemble(
        "vIn.p - der_.p1", "vIn.n - der_.n1 - ground.p", "der_.p2 - vOut.p", "der_.n2 - vOut.n",
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), der_=_der(k=2.0, f=10.0),
        vIn=electrical.TrapezoidVoltage(V=10.0, rising=0.02, width=0.03, falling=0.02, period=0.1, offset=-5.0,
            startTime=-0.035),
    )  # fmt: skip


def control_circuit() -> Component:
    """Electrical.Analog.Examples.OpAmps.ControlCircuit."""
    return assemble(
        "stepA.n - ground.p - feedbackA.n1 - step1A.n", "feedbackA.p2 - PIA.p1", "feedbackA.n2 - PIA.n1",
        "PIA.p2 - firstOrder1A.p1", "PIA.n2 - firstOrder1A.n1", "stepB.y - feedbackB.u1", "feedbackB.y - PIB.u",
        "PIB.y - firstOrder1B.u", "firstOrder1B.y - addB.u1", "addB.y - firstOrder2B.u", "step1B.y - addB.u2",
        "firstOrder2B.y - feedbackB.u2", "stepA.p - feedbackA.p1_2", "firstOrder2A.p2 - feedbackA.p1",
        "firstOrder1A.n2 - addA.n1", "firstOrder1A.p2 - addA.p1", "step1A.p - addA.p1_2", "addA.p2 - firstOrder2A.p1",
        "addA.n2 - firstOrder2A.n1",
        ground=electrical.Ground(), stepA=electrical.StepVoltage(V=10.0, startTime=0.1), feedbackA=_feedback(),
        PIA=_pi(k=0.5, T=0.01), firstOrder1A=_first_order(T=0.01), addA=_add(),
        step1A=electrical.StepVoltage(V=1.0, startTime=0.5), firstOrder2A=_first_order(T=0.01),
        stepB=blocks.Step(height=10.0, startTime=0.1), feedbackB=blocks.Feedback(),
        PIB=blocks.PI(k=0.5, T=0.01, initType="InitialOutput"),
        firstOrder1B=blocks.FirstOrder(T=0.01, initType="InitialOutput"), addB=blocks.Add(),
        step1B=blocks.Step(height=1.0, startTime=0.5),
        firstOrder2B=blocks.FirstOrder(T=0.01, initType="InitialOutput"),
    )  # fmt: skip


def multivibrator() -> Component:
    """Electrical.Analog.Examples.OpAmps.Multivibrator.

    It can begin at either limit or between them; the example means the lower limit.
    """
    return assemble(
        "ground.p - r1.n - vOut.n - c.n", "opAmp.out - vOut.p - r.p - r2.p", "r.n - opAmp.in_n - c.p",
        "r2.n - opAmp.in_p - r1.p",
        opAmp=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0, v_int=start(-30.0)),
        ground=electrical.Ground(), vOut=electrical.VoltageSensor(), r1=electrical.Resistor(R=1000.0, i=start(0.0)),
        r2=electrical.Resistor(R=1000.0), r=electrical.Resistor(R=1000.0),
        c=electrical.Capacitor(C=4.55119613313e-5, v=start(1.0, fixed=True)),
    )  # fmt: skip


def signal_generator() -> Component:
    """Electrical.Analog.Examples.OpAmps.SignalGenerator.

    It can begin at either limit or between them; the example means the lower limit.
    """
    return assemble(
        "opAmp1.out - r2.n - r.p - vOutRectangle.p", "opAmp1.in_p - r2.p - r1.p",
        "opAmp1.in_n - ground.p - opAmp2.in_p - vOutRectangle.n - vOutTriangle.n", "r.n - c.n - opAmp2.in_n",
        "c.p - opAmp2.out - r1.n - vOutTriangle.p",
        opAmp1=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0, v_int=start(-30.0)),
        r2=electrical.Resistor(R=1500.0, i=start(0.01)), r1=electrical.Resistor(R=1000.0), ground=electrical.Ground(),
        opAmp2=electrical.IdealizedOpAmpLimited(Vps=15.0, Vns=-15.0, v_in=start(0.0)),
        c=electrical.Capacitor(C=3.75e-5, v=start(0.0, fixed=True)), r=electrical.Resistor(R=1000.0),
        vOutRectangle=electrical.VoltageSensor(), vOutTriangle=electrical.VoltageSensor(),
    )  # fmt: skip


def differential_amplifier() -> Component:
    """Electrical.Analog.Examples.OpAmps.DifferentialAmplifier."""
    attenuation, V = 100.0, math.sqrt(2 / 3) * 400.0
    return assemble(
        "voltageSensor.v - rootMeanSquare.u", "negativeSupply.p - opAmp.s_n", "opAmp.s_p - positiveSupply.p",
        "resistor4.n - resistorGround.n - resistanceInstrument.n - voltageSensor.n - positiveSupply.n "
        "- negativeSupply.n", "sourceVoltage1.n - sourceVoltage2.n - resistorGround.p - ground.p",
        "sourceVoltage1.p - resistor1.p - voltageSensorSource.p - resistanceLoad.p",
        "sourceVoltage2.p - resistor2.p - voltageSensorSource.n - resistanceLoad.n", "voltageSensorSource.v - gain.u",
        "resistor3.n - resistanceInstrument.p - voltageSensor.p - opAmp.out", "resistor1.n - resistor3.p - opAmp.in_n",
        "resistor2.n - resistor4.p - opAmp.in_p",
        sourceVoltage1=electrical.SineVoltage(V=V, phase=math.pi / 3, f=50.0),
        sourceVoltage2=electrical.SineVoltage(V=V, phase=-math.pi / 3, f=50.0),
        resistanceLoad=electrical.Resistor(R=10.0), voltageSensorSource=electrical.VoltageSensor(),
        gain=blocks.Gain(k=-1 / attenuation), resistorGround=electrical.Resistor(R=1e5),
        opAmp=electrical.IdealizedOpAmpLimited(V0=1e4, useSupply=True), resistor1=electrical.Resistor(R=1e5),
        resistor2=electrical.Resistor(R=1e5), resistor3=electrical.Resistor(R=1e5 / attenuation),
        resistor4=electrical.Resistor(R=1e5 / attenuation), positiveSupply=electrical.ConstantVoltage(V=15.0),
        negativeSupply=electrical.ConstantVoltage(V=-15.0), resistanceInstrument=electrical.Resistor(R=1e5),
        voltageSensor=electrical.VoltageSensor(), rootMeanSquare=blocks.RootMeanSquare(f=50.0),
        ground=electrical.Ground(),
    )  # fmt: skip
