"""Electrical examples of the Modelica Standard Library against its official trajectories, in the tube of 2e-3."""

from __future__ import annotations

from collections.abc import Callable

import pytest

import acausal as ac

from . import msl_networks, msl_opamps, msl_resonance, msl_switching
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "Resistor": msl_switching.resistor, "ControlledSwitchWithArc": msl_switching.controlled_switch_with_arc,
    "SimpleTriacCircuit": msl_switching.simple_triac_circuit, "NandGate": msl_switching.nand_gate,
    "Adder": msl_opamps.adder, "Subtracter": msl_opamps.subtracter,
    "InvertingAmplifier": msl_opamps.inverting_amplifier,
    "NonInvertingAmplifier": msl_opamps.non_inverting_amplifier, "VoltageFollower": msl_opamps.voltage_follower,
    "InvertingSchmittTrigger": msl_opamps.inverting_schmitt_trigger, "LowPass": msl_opamps.low_pass,
    "HighPass": msl_opamps.high_pass, "Integrator": msl_opamps.integrator,
    "Differentiator": msl_opamps.differentiator, "ControlCircuit": msl_opamps.control_circuit,
    "Multivibrator": msl_opamps.multivibrator, "SignalGenerator": msl_opamps.signal_generator,
    "DifferentialAmplifier": msl_opamps.differential_amplifier,
    "CauerLowPassOPV": msl_networks.cauer_low_pass_opv, "DifferenceAmplifier": msl_networks.difference_amplifier,
    "CauerLowPassSC": msl_networks.cauer_low_pass_sc, "ParallelResonance": msl_resonance.parallel_resonance,
    "SeriesResonance": msl_resonance.series_resonance, "ResonanceCircuits": msl_resonance.resonance_circuits,
    "ElectricalGenerationOfFMUs": msl_resonance.electrical_signals,
    "ThermalGenerationOfFMUs": msl_resonance.thermal_signals, "SingularTransformer": msl_networks.singular_transformer,
}  # fmt: skip


NATIVE = {"CauerLowPassSC"}
"""It has 1 200 events, which take diffrax minutes, and the native engine seconds."""


@pytest.mark.slow_case(*NATIVE)
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str) -> None:
    assert_within(name, MODELS[name](), "native")


@pytest.mark.slow
@pytest.mark.parametrize("name", [name for name in MODELS if name not in NATIVE])
def test_within_the_tube_by_diffrax(name: str) -> None:
    assert_within(name, MODELS[name](), "diffrax")
