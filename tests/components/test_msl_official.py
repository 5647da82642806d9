"""More examples of the Modelica Standard Library against its official trajectories, in the tube of 2e-3.

Each file has about a hundred points of the signals that the library's own regression tests compare, away from events.
LossyGearDemo2 is without the mode of its bearing, which follows a speed of 5e-11 rad/s while the gear holds the shaft,
and without the 17 ms in which the mode of the gear does.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, rotational
from acausal.components.examples import assemble, start

from . import msl_characteristics, msl_circuits, msl_drives, msl_gates, msl_mechanisms, msl_shafts, msl_slides
from .msl_hybrid import coupled_clutches
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "CoupledClutches": coupled_clutches, "Friction": msl_drives.friction,
    "SimpleGearShift": msl_drives.simple_gear_shift, "LossyGearDemo3": msl_drives.lossy_gear_demo3,
    "OneWayClutch": msl_drives.one_way_clutch, "ElasticBearing": msl_drives.elastic_bearing,
    "Backlash": msl_drives.backlash, "Brake": msl_drives.brake, "PreLoad": msl_drives.pre_load,
    "ControlledTemperature": msl_drives.controlled_temperature, "Rectifier": msl_circuits.rectifier,
    "HeatingRectifier": msl_circuits.heating_rectifier, "HeatingMOSInverter": msl_circuits.heating_mos_inverter,
    "SwitchWithArc": msl_circuits.switch_with_arc, "ThyristorBehaviourTest": msl_circuits.thyristor_behaviour_test,
    "AmplifierWithOpAmpDetailed": msl_circuits.amplifier_with_op_amp_detailed,
    "LCOscillator": msl_circuits.lc_oscillator, "IdealTriacCircuit": msl_circuits.ideal_triac_circuit,
    "DoublePendulum": msl_mechanisms.double_pendulum, "ThreeSprings": msl_mechanisms.three_springs,
    "SpringMassSystem": msl_mechanisms.spring_mass_system, "FreeBody": msl_mechanisms.free_body,
    "Engine1a": msl_mechanisms.engine1a, "Engine1b": msl_mechanisms.engine1b,
    "FirstGrounded": msl_shafts.first_grounded, "LossyGearDemo1": msl_shafts.lossy_gear_demo1,
    "LossyGearDemo2": msl_shafts.lossy_gear_demo2, "EddyCurrentBrake": msl_shafts.eddy_current_brake,
    "OneWayClutchDisengaged": msl_shafts.one_way_clutch_disengaged, "RotationalRollingWheel": msl_shafts.rolling_wheel,
    "Accelerate": msl_slides.accelerate, "Damper": msl_slides.damper,
    "InitialConditions": msl_slides.initial_conditions, "Sensors": msl_slides.sensors,
    "SignConvention": msl_slides.sign_convention, "Vehicle": msl_slides.vehicle, "WhyArrows": msl_slides.why_arrows,
    "SlidingFriction": msl_slides.friction,
    "CharacteristicIdealDiodes": msl_characteristics.characteristic_ideal_diodes,
    "CharacteristicThyristors": msl_characteristics.characteristic_thyristors,
    "Comparator": msl_characteristics.comparator,
    "ShowSaturatingInductor": msl_characteristics.show_saturating_inductor,
    "ShowVariableResistor": msl_characteristics.show_variable_resistor,
    "OvervoltageProtection": msl_characteristics.overvoltage_protection,
    "InvertingAmp": msl_characteristics.inverting_amp, "SchmittTrigger": msl_characteristics.schmitt_trigger,
    "HeatingNPN_NORGate": msl_gates.heating_npn_norgate, "HeatingPNP_NORGate": msl_gates.heating_pnp_norgate,
}  # fmt: skip


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)


def test_ideal_lossy_gear_is_free() -> None:
    """Without losses nothing holds the gear, not even at rest: it is an `IdealGear`."""
    found = []
    for gear in (rotational.LossyGear(ratio=2.0), rotational.IdealGear(ratio=2.0)):
        model = assemble(
            "drive.y - torque.tau", "torque.flange - one.flange_a", "one.flange_b - gear.flange_a",
            "gear.flange_b - two.flange_a", drive=blocks.Sine(amplitude=3.0, f=1.0), torque=rotational.Torque(),
            gear=gear, one=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
            two=rotational.Inertia(J=2.0),
        )  # fmt: skip
        found.append(ac.compile(model).simulate(2.0, saveat=21, rtol=1e-9))
    assert np.all(np.asarray(found[0]["gear.mode"]) == 2.0)
    wanted = 3.0 / 1.5 / (2 * np.pi) * (1 - np.cos(2 * np.pi * np.linspace(0.0, 2.0, 21)))
    for solution in found:
        np.testing.assert_allclose(solution["one.w"], wanted, atol=1e-7)
