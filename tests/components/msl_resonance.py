"""Resonance of the Modelica Standard Library 4.0, and its units of circuits and heat that exchange signals."""

from __future__ import annotations

from acausal import Component
from acausal.components import blocks, electrical, thermal
from acausal.components.electrical import GeneralCurrentToVoltageAdaptor, GeneralVoltageToCurrentAdaptor
from acausal.components.examples import assemble, start
from acausal.components.thermal import GeneralHeatFlowToTemperatureAdaptor, GeneralTemperatureToHeatFlowAdaptor


def parallel_resonance() -> Component:
    """Electrical.Analog.Examples.ParallelResonance."""
    return assemble(
        "sineCurrent.p - ground1.p - inductor1.n - capacitor1.n - voltageSensor1.n",
        "ramp.y - sineCurrent.f - cosineCurrent.f", "sineCurrent.n - resistor1.p - capacitor1.p - voltageSensor1.p",
        "resistor1.n - inductor1.p", "cosineCurrent.p - ground2.p - inductor2.n - capacitor2.n - voltageSensor2.n",
        "cosineCurrent.n - resistor2.p - capacitor2.p - voltageSensor2.p", "resistor2.n - inductor2.p",
        sineCurrent=electrical.SineCurrentVariableFrequencyAndAmplitude(useConstantAmplitude=True, phi=start(0.0,
            fixed=True)), ground1=electrical.Ground(), resistor1=electrical.Resistor(R=0.5),
        inductor1=electrical.Inductor(i=start(0.0, fixed=True), L=0.0159154943092),
        capacitor1=electrical.Capacitor(v=start(0.0, fixed=True), C=0.000159154943092),
        voltageSensor1=electrical.VoltageSensor(),
        ramp=blocks.Ramp(height=200.0, duration=1.0, offset=0.0, startTime=0.0),
        cosineCurrent=electrical.CosineCurrentVariableFrequencyAndAmplitude(useConstantAmplitude=True, phi=start(0.0,
            fixed=True)), ground2=electrical.Ground(), resistor2=electrical.Resistor(R=0.5),
        inductor2=electrical.Inductor(i=start(0.0, fixed=True), L=0.0159154943092),
        capacitor2=electrical.Capacitor(v=start(0.0, fixed=True), C=0.000159154943092),
        voltageSensor2=electrical.VoltageSensor(),
    )  # fmt: skip


def series_resonance() -> Component:
    """Electrical.Analog.Examples.SeriesResonance."""
    return assemble(
        "sineVoltage.p - inductor1.p", "inductor1.n - capacitor1.p", "capacitor1.n - resistor1.p",
        "sineVoltage.n - ground1.p - currentSensor1.n", "currentSensor1.p - resistor1.n",
        "ramp.y - sineVoltage.f - cosineVoltage.f", "cosineVoltage.p - inductor2.p", "inductor2.n - capacitor2.p",
        "capacitor2.n - resistor2.p", "cosineVoltage.n - ground2.p - currentSensor2.n",
        "currentSensor2.p - resistor2.n",
        sineVoltage=electrical.SineVoltageVariableFrequencyAndAmplitude(useConstantAmplitude=True, phi=start(0.0,
            fixed=True)), ground1=electrical.Ground(), resistor1=electrical.Resistor(R=0.5),
        inductor1=electrical.Inductor(i=start(0.0, fixed=True), L=0.0159154943092),
        capacitor1=electrical.Capacitor(v=start(0.0, fixed=True), C=0.000159154943092),
        currentSensor1=electrical.CurrentSensor(),
        ramp=blocks.Ramp(height=200.0, duration=1.0, offset=0.0, startTime=0.0),
        cosineVoltage=electrical.CosineVoltageVariableFrequencyAndAmplitude(useConstantAmplitude=True, phi=start(0.0,
            fixed=True)), ground2=electrical.Ground(), resistor2=electrical.Resistor(R=0.5),
        inductor2=electrical.Inductor(i=start(0.0, fixed=True), L=0.0159154943092),
        capacitor2=electrical.Capacitor(v=start(0.0, fixed=True), C=0.000159154943092),
        currentSensor2=electrical.CurrentSensor(),
    )  # fmt: skip


def resonance_circuits() -> Component:
    """Electrical.Analog.Examples.ResonanceCircuits."""
    return assemble(
        "voltage2.n - ground2.p - currentToVoltageAdaptor2a.pin_n",
        "ground1.p - current1.p - voltageToCurrentAdaptor1a.pin_n", "current1.n - voltageToCurrentAdaptor1a.pin_p",
        "currentToVoltageAdaptor1a.p - voltageToCurrentAdaptor1a.p",
        "voltageToCurrentAdaptor1a.f - currentToVoltageAdaptor1a.f",
        "voltageToCurrentAdaptor1a.fder - currentToVoltageAdaptor1a.fder",
        "currentToVoltageAdaptor1a.pin_p - inductor1.p - currentToVoltageAdaptor1b.pin_p",
        "currentToVoltageAdaptor1a.pin_n - inductor1.n - currentToVoltageAdaptor1b.pin_n - ground1a.p",
        "currentToVoltageAdaptor1b.p - voltageToCurrentAdaptor1b.p",
        "currentToVoltageAdaptor1b.fder - voltageToCurrentAdaptor1b.fder",
        "currentToVoltageAdaptor1b.f - voltageToCurrentAdaptor1b.f",
        "voltageToCurrentAdaptor1b.pin_p - conductor1.p - voltageToCurrentAdaptor1c.pin_p",
        "voltageToCurrentAdaptor1b.pin_n - conductor1.n - ground1b.p - voltageToCurrentAdaptor1c.pin_n",
        "capacitor1.n - ground1c.p - currentToVoltageAdaptor1c.pin_n",
        "voltageToCurrentAdaptor1c.p - currentToVoltageAdaptor1c.p",
        "voltageToCurrentAdaptor1c.fder - currentToVoltageAdaptor1c.fder",
        "voltageToCurrentAdaptor1c.f - currentToVoltageAdaptor1c.f", "currentToVoltageAdaptor1c.pin_p - capacitor1.p",
        "voltage2.p - currentToVoltageAdaptor2a.pin_p", "voltageToCurrentAdaptor2a.pin_p - inductor2.p",
        "currentToVoltageAdaptor2a.p - voltageToCurrentAdaptor2a.p",
        "currentToVoltageAdaptor2a.pder - voltageToCurrentAdaptor2a.pder",
        "currentToVoltageAdaptor2a.f - voltageToCurrentAdaptor2a.f",
        "voltageToCurrentAdaptor2b.p - currentToVoltageAdaptor2b.p",
        "voltageToCurrentAdaptor2b.pder - currentToVoltageAdaptor2b.pder",
        "inductor2.n - voltageToCurrentAdaptor2b.pin_p",
        "voltageToCurrentAdaptor2a.pin_n - ground2a.p - voltageToCurrentAdaptor2b.pin_n",
        "voltageToCurrentAdaptor2b.f - currentToVoltageAdaptor2b.f",
        "capacitor2.n - ground2c.p - voltageToCurrentAdaptor2c.pin_n", "currentToVoltageAdaptor2b.pin_p - resistor2.p",
        "currentToVoltageAdaptor2c.pin_p - resistor2.n", "voltageToCurrentAdaptor2c.pin_p - capacitor2.p",
        "currentToVoltageAdaptor2c.pin_n - ground2b.p - currentToVoltageAdaptor2b.pin_n",
        "currentToVoltageAdaptor2c.p - voltageToCurrentAdaptor2c.p",
        "currentToVoltageAdaptor2c.pder - voltageToCurrentAdaptor2c.pder",
        "currentToVoltageAdaptor2c.f - voltageToCurrentAdaptor2c.f",
        current1=electrical.SineCurrent(I=1.0, f=15.9154943092), ground1=electrical.Ground(),
        inductor1=electrical.Inductor(i=start(0.0, fixed=True), L=0.01), conductor1=electrical.Conductor(G=1.0),
        capacitor1=electrical.Capacitor(v=start(0.0, fixed=True), C=0.01),
        voltage2=electrical.SineVoltage(V=1.0, f=15.9154943092), ground2=electrical.Ground(),
        inductor2=electrical.Inductor(i=start(0.0, fixed=True), L=0.01), resistor2=electrical.Resistor(R=1.0),
        capacitor2=electrical.Capacitor(v=start(0.0, fixed=True), C=0.01),
        voltageToCurrentAdaptor1a=electrical.GeneralVoltageToCurrentAdaptor(use_pder=False),
        currentToVoltageAdaptor1a=electrical.GeneralCurrentToVoltageAdaptor(use_pder=False),
        ground1a=electrical.Ground(),
        currentToVoltageAdaptor1b=electrical.GeneralCurrentToVoltageAdaptor(use_pder=False),
        voltageToCurrentAdaptor1b=electrical.GeneralVoltageToCurrentAdaptor(use_pder=False),
        ground1b=electrical.Ground(),
        voltageToCurrentAdaptor1c=electrical.GeneralVoltageToCurrentAdaptor(use_pder=False),
        currentToVoltageAdaptor1c=electrical.GeneralCurrentToVoltageAdaptor(use_pder=False),
        ground1c=electrical.Ground(),
        currentToVoltageAdaptor2a=electrical.GeneralCurrentToVoltageAdaptor(use_fder=False),
        voltageToCurrentAdaptor2a=electrical.GeneralVoltageToCurrentAdaptor(use_fder=False),
        ground2a=electrical.Ground(),
        voltageToCurrentAdaptor2b=electrical.GeneralVoltageToCurrentAdaptor(use_fder=False),
        currentToVoltageAdaptor2b=electrical.GeneralCurrentToVoltageAdaptor(use_fder=False),
        ground2b=electrical.Ground(),
        currentToVoltageAdaptor2c=electrical.GeneralCurrentToVoltageAdaptor(use_fder=False),
        voltageToCurrentAdaptor2c=electrical.GeneralVoltageToCurrentAdaptor(use_fder=False),
        ground2c=electrical.Ground(),
    )  # fmt: skip


def _capacitor(C: float) -> electrical.Capacitor:
    return electrical.Capacitor(C=C, v=start(0.0, fixed=True))


def _inductor(L: float) -> electrical.Inductor:
    return electrical.Inductor(L=L, i=start(0.0, fixed=True))


def _body(C: float) -> thermal.HeatCapacitor:
    return thermal.HeatCapacitor(C=C, T=start(293.15, fixed=True))


def electrical_signals() -> Component:
    """Electrical.Analog.Examples.GenerationOfFMUs, the units with the signals of their adaptors."""
    direct_capacitor = assemble(
        "capacitor.p - currentToVoltage.pin_p - currentSource.n",
        "capacitor.n - currentToVoltage.pin_n - currentSource.p - ground.p", capacitor=_capacitor(1e-3),
        currentSource=electrical.SignalCurrent(), currentToVoltage=GeneralCurrentToVoltageAdaptor(use_fder=False),
        ground=electrical.Ground(),
    )  # fmt: skip
    inverse_capacitor = assemble(
        "voltageToCurrent.pin_p - capacitor.p", "capacitor.n - voltageToCurrent.pin_n - ground.p",
        capacitor=electrical.Capacitor(C=2e-3), voltageToCurrent=GeneralVoltageToCurrentAdaptor(use_fder=False),
        ground=electrical.Ground(),
    )  # fmt: skip
    direct_inductor = assemble(
        "voltageSource.p - inductor.p", "inductor.n - currentToVoltage.pin_p",
        "voltageSource.n - currentToVoltage.pin_n - ground.p", inductor=_inductor(1e-3),
        voltageSource=electrical.SignalVoltage(), currentToVoltage=GeneralVoltageToCurrentAdaptor(use_pder=False),
        ground=electrical.Ground(),
    )  # fmt: skip
    inverse_inductor = assemble(
        "currentToVoltage.pin_p - inductor.p", "inductor.n - currentToVoltage.pin_n - ground.p",
        inductor=electrical.Inductor(L=2e-3), currentToVoltage=GeneralCurrentToVoltageAdaptor(use_pder=False),
        ground=electrical.Ground(),
    )  # fmt: skip
    voltage_to_current = GeneralVoltageToCurrentAdaptor(use_pder=False, use_fder=False)
    current_to_voltage = GeneralCurrentToVoltageAdaptor(use_pder=False, use_fder=False)
    resistor = assemble(
        "voltageToCurrent1.pin_p - resistor.p", "resistor.n - voltageToCurrent2.pin_p",
        "voltageToCurrent1.pin_n - voltageToCurrent2.pin_n - ground.p", voltageToCurrent1=voltage_to_current,
        voltageToCurrent2=voltage_to_current, resistor=electrical.Resistor(R=10.0), ground=electrical.Ground(),
    )  # fmt: skip
    conductor = assemble(
        "currentToVoltage1.pin_p - conductor.p - currentToVoltage2.pin_p",
        "currentToVoltage1.pin_n - conductor.n - currentToVoltage2.pin_n - ground.p",
        currentToVoltage1=current_to_voltage, currentToVoltage2=current_to_voltage,
        conductor=electrical.Conductor(G=10.0), ground=electrical.Ground(),
    )  # fmt: skip
    one, two = "directCapacitor1.currentToVoltage", "inverseCapacitor1.voltageToCurrent"
    three, four = "directInductor3.currentToVoltage", "inverseInductor3.currentToVoltage"
    return assemble(
        "sine12.y - directCapacitor1.currentSource.i - current2.i", f"{one}.p - {two}.p", f"{one}.pder - {two}.pder",
        f"{two}.f - {one}.f", "current2.n - capacitor2a.p - currentToVoltage2a.pin_p",
        "capacitor2a.n - currentToVoltage2a.pin_n - current2.p - ground2a.p",
        "currentToVoltage2a.p - resistor2.voltageToCurrent1.p", "resistor2.voltageToCurrent1.f - currentToVoltage2a.f",
        "currentToVoltage2b.p - resistor2.voltageToCurrent2.p", "resistor2.voltageToCurrent2.f - currentToVoltage2b.f",
        "currentToVoltage2b.pin_p - capacitor2b.p", "currentToVoltage2b.pin_n - capacitor2b.n - ground3b.p",
        "sine34.y - directInductor3.voltageSource.v - voltage4.v", f"{four}.p - {three}.p", f"{three}.f - {four}.f",
        f"{three}.fder - {four}.fder", "voltage4.p - inductor4a.p", "inductor4a.n - voltageToCurrent4a.pin_p",
        "voltage4.n - voltageToCurrent4a.pin_n - ground4a.p", "voltageToCurrent4a.f - conductor4.currentToVoltage1.f",
        "conductor4.currentToVoltage1.p - voltageToCurrent4a.p",
        "conductor4.currentToVoltage2.p - voltageToCurrent4b.p",
        "voltageToCurrent4b.f - conductor4.currentToVoltage2.f", "voltageToCurrent4b.pin_p - inductor4b.p",
        "inductor4b.n - voltageToCurrent4b.pin_n - ground4b.p",
        sine12=blocks.Sine(f=2.0), directCapacitor1=direct_capacitor, inverseCapacitor1=inverse_capacitor,
        current2=electrical.SignalCurrent(), capacitor2a=_capacitor(1e-3), currentToVoltage2a=current_to_voltage,
        resistor2=resistor, currentToVoltage2b=current_to_voltage, capacitor2b=_capacitor(2e-3),
        ground2a=electrical.Ground(), ground3b=electrical.Ground(), sine34=blocks.Sine(f=2.0),
        directInductor3=direct_inductor, inverseInductor3=inverse_inductor, voltage4=electrical.SignalVoltage(),
        ground4a=electrical.Ground(), inductor4a=_inductor(1e-3), voltageToCurrent4a=voltage_to_current,
        conductor4=conductor, voltageToCurrent4b=voltage_to_current, inductor4b=_inductor(2e-3),
        ground4b=electrical.Ground(),
    )  # fmt: skip


def thermal_signals() -> Component:
    """Thermal.HeatTransfer.Examples.GenerationOfFMUs, the units with the signals of their adaptors."""
    plain_temperature = GeneralTemperatureToHeatFlowAdaptor(use_pder=False)
    plain_flow = GeneralHeatFlowToTemperatureAdaptor(use_pder=False)
    direct = assemble(
        "heatCapacitor.port - heatFlowToTemperature.heatPort - forceSource.port", heatCapacitor=_body(1.1),
        forceSource=thermal.PrescribedHeatFlow(), heatFlowToTemperature=GeneralHeatFlowToTemperatureAdaptor(),
    )  # fmt: skip
    inverse = assemble("temperatureToHeatFlow.heatPort - mass.port", mass=thermal.HeatCapacitor(C=2.2),
                       temperatureToHeatFlow=GeneralTemperatureToHeatFlowAdaptor())  # fmt: skip
    conduction = assemble(
        "temperatureToHeatFlow1.heatPort - thermalConductor.port_a",
        "thermalConductor.port_b - temperatureToHeatFlow2.heatPort", temperatureToHeatFlow1=plain_temperature,
        temperatureToHeatFlow2=plain_temperature, thermalConductor=thermal.ThermalConductor(G=10.0),
    )  # fmt: skip
    one, two = "directCapacity.heatFlowToTemperature", "inverseCapacity.temperatureToHeatFlow"
    return assemble(
        "sine1.y - directCapacity.forceSource.Q_flow - heatFlow3.Q_flow", f"{one}.p - {two}.p",
        f"{one}.pder - {two}.pder", f"{two}.f - {one}.f",
        "heatFlow3.port - capacitor3a.port - heatFlowToTemperature3a.heatPort",
        "heatFlowToTemperature3a.p - conductor.temperatureToHeatFlow1.p",
        "conductor.temperatureToHeatFlow1.f - heatFlowToTemperature3a.f",
        "heatFlowToTemperature3b.p - conductor.temperatureToHeatFlow2.p",
        "conductor.temperatureToHeatFlow2.f - heatFlowToTemperature3b.f",
        "heatFlowToTemperature3b.heatPort - capacitor3b.port",
        sine1=blocks.Sine(f=2.0, amplitude=1000.0), directCapacity=direct, inverseCapacity=inverse,
        conductor=conduction, capacitor3a=_body(1.1), heatFlow3=thermal.PrescribedHeatFlow(),
        heatFlowToTemperature3a=plain_flow, capacitor3b=_body(2.2), heatFlowToTemperature3b=plain_flow,
    )  # fmt: skip
