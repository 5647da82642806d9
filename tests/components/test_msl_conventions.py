"""Signs and names of variables that the Modelica Standard Library 4.0 has, where they are not those one would guess."""

from __future__ import annotations

import warnings

import numpy as np
import pytest

import acausal as ac
from acausal import Component, start
from acausal.components import blocks, electrical, rotational, thermal, translational
from acausal.components.examples import assemble

MOVING = translational.Mass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True))
FORCES = [
    translational.LinearSpeedDependentForce(f_nominal=-8.0, v_nominal=2.0, ForceDirection=False),
    translational.QuadraticSpeedDependentForce(f_nominal=-8.0, v_nominal=2.0),
    translational.InverseSpeedDependentForce(f_nominal=-8.0),
    translational.SignForce(f_nominal=-8.0),
    translational.ConstantForce(f_constant=-8.0),
    translational.ForceStep(stepForce=-8.0),
    translational.EddyCurrentForce(f_nominal=8.0),
    translational.RollingResistance(fWeight=100.0),
]


@pytest.mark.parametrize("force", FORCES, ids=lambda f: type(f).__name__)
def test_forces_are_those_of_their_flange(force: Component) -> None:
    """What brakes has a positive `f` at a positive speed (PartialForce); `tau` has the other sign."""
    run = ac.compile(assemble("brake.flange - mass.flange_a", brake=force, mass=MOVING)).simulate(t1=0.1, saveat=3)
    f = np.asarray(run["brake.f"])
    assert (f > 0.0).all() and np.array_equal(f, run["brake.flange.f"])
    np.testing.assert_allclose(np.asarray(run["mass.a"]) * 2.0, -f)


@pytest.mark.parametrize("torque", [rotational.ConstantTorque(tau_constant=3.0), rotational.TorqueStep(stepTorque=3.0)])
def test_torques_are_what_drives(torque: Component) -> None:
    model = assemble("drive.flange - rotor.flange_a", drive=torque, rotor=rotational.Inertia(J=2.0))
    run = ac.compile(model).simulate(t1=0.1, saveat=3)
    assert run["drive.tau"].tolist() == [3.0] * 3 and run["rotor.a"].tolist() == [1.5] * 3


def test_an_exact_position_may_jump() -> None:
    """Nothing asks for its velocity: `w` and `a` are 0, and the reference is not differentiated."""
    model = assemble(
        "step.y - lead.phi_ref", "lead.flange - spring.flange_a", "spring.flange_b - rotor.flange_a",
        step=blocks.Step(startTime=0.5), lead=rotational.Position(exact=True), spring=rotational.Spring(c=4.0),
        rotor=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        run = ac.compile(model).simulate(t1=1.5, saveat=4, rtol=1e-9)
    np.testing.assert_allclose(run["rotor.phi"][-1], 1.0 - np.cos(2.0), rtol=1e-7)
    assert not np.any(run["lead.w"]) and not np.any(run["lead.a"])


def test_filtered_motion_tells_its_acceleration() -> None:
    model = assemble("ramp.y - lead.w_ref", ramp=blocks.Slope(slope=2.0), lead=rotational.Speed())
    run = ac.compile(model).simulate(t1=1.0, saveat=3, rtol=1e-9)
    np.testing.assert_allclose(run["lead.a"][-1], 2.0, rtol=1e-6)


def test_the_temperature_of_a_device_and_what_follows_from_it_have_names() -> None:
    model = assemble(
        "source.p - resistor.p", "resistor.n - conductor.p", "conductor.n - diode.p", "diode.n - source.n - ground.p",
        "resistor.heatPort - oven.port", source=electrical.ConstantVoltage(V=5.0), ground=electrical.Ground(),
        resistor=electrical.Resistor(R=10.0, alpha=1e-2, useHeatPort=True), oven=thermal.FixedTemperature(T=350.15),
        conductor=electrical.Conductor(G=0.1, alpha=1e-2, T=350.15), diode=electrical.Diode(),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=1.0, saveat=2)
    names = ("resistor.T_heatPort", "resistor.R_actual", "conductor.T_heatPort", "conductor.G_actual", "diode.vt_t")
    boltzmann = 1.380649e-23 * 293.15 / 1.602176634e-19
    assert [run[name][0] for name in names] == pytest.approx([350.15, 15.0, 350.15, 0.1 / 1.5, boltzmann])
    assert run["diode.id"][0] + run["diode.v"][0] / 1e8 == pytest.approx(run["diode.i"][0], rel=1e-9)


def test_junctions_of_a_pnp_transistor_are_named_after_its_polarity() -> None:
    model = assemble(
        "drive.n - base.p", "base.n - tr.B", "supply.n - tr.C", "drive.p - supply.p - tr.E - ground.p",
        drive=electrical.ConstantVoltage(V=1.7), base=electrical.Resistor(R=1e5), ground=electrical.Ground(),
        supply=electrical.ConstantVoltage(V=5.0), tr=electrical.PNP(),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=1e-3, saveat=2)
    value = {name: run[f"tr.{name}"][-1] for name in ("veb", "vcb", "ieb", "icb", "ceb", "ccb", "qbk", "C.i")}
    assert value["veb"] > 0.5 > 0.0 > value["vcb"] and value["ieb"] > 0.0 and value["ceb"] > value["ccb"] > 0.0
    assert value["C.i"] == pytest.approx(-(value["ieb"] - value["icb"]) * value["qbk"] + value["icb"] / 0.1, rel=1e-6)
