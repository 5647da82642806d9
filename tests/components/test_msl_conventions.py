"""Signs and names of variables that the Modelica Standard Library 4.0 has, where they are not those one would guess."""

from __future__ import annotations

import warnings
from typing import Any

import jax
import numpy as np
import pytest

import acausal as ac
from acausal import Component, start
from acausal.components import blocks, electrical, multibody, rotational, thermal, translational
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
        "step.y - lead.phi_ref", "lead.flange - spring.flange_a - load.flange", "spring.flange_b - rotor.flange_a",
        step=blocks.Step(startTime=0.5), lead=rotational.Position(exact=True), spring=rotational.Spring(c=4.0),
        load=rotational.ConstantTorque(tau_constant=1.0),
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
    names = ("veb", "vcb", "ieb", "icb", "ceb", "ccb", "qbk", "C.i", "Capcje", "Capcjc", "is_t", "bf_t", "br_t", "vS")
    value = {name: run[f"tr.{name}"][-1] for name in names}
    assert value["veb"] > 0.5 > 0.0 > value["vcb"] and value["ieb"] > 0.0 and value["ceb"] > value["ccb"] > 0.0
    assert value["C.i"] == pytest.approx(-(value["ieb"] - value["icb"]) * value["qbk"] + value["icb"] / 0.1, rel=1e-6)
    assert (value["is_t"], value["bf_t"], value["br_t"], value["vS"]) == (1e-16, 50.0, 0.1, 0.0)
    assert value["Capcje"] == pytest.approx(0.4e-12 * (1.0 + 0.4 * value["veb"] / 0.8), rel=1e-9)
    assert value["Capcjc"] == pytest.approx(0.5e-12 * (1.0 - value["vcb"] / 0.8) ** -0.333, rel=1e-9)
    assert value["ceb"] > value["Capcje"] and value["ccb"] >= value["Capcjc"]


def test_friction_tells_its_coefficient_at_rest() -> None:
    table = [[0.0, 0.4], [1.0, 0.3], [10.0, 0.3]]
    model = assemble(
        "press.y - brake.f_normalized - slow.f_normalized", "wheel.flange_b - brake.flange_a",
        "mass.flange_b - slow.flange_a", press=blocks.Constant(), brake=rotational.Brake(mu_pos=table, peak=1.5),
        wheel=rotational.Inertia(phi=start(0.0, fixed=True), w=start(5.0, fixed=True)),
        slow=translational.Brake(mu_pos=table),
        mass=translational.Mass(L=2.0, s=start(0.0, fixed=True), v=start(5.0, fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=0.1, saveat=2)
    assert (run["brake.mu0"][0], run["brake.mu"][0], run["brake.tau0_max"][0]) == pytest.approx((0.4, 0.3, 0.6))
    assert (run["slow.mu0"][0], run["slow.s_a"][0], run["slow.s_b"][0]) == pytest.approx((0.4, 1.0, 1.0))


def test_a_gear_tells_the_losses_of_both_directions() -> None:
    gear = rotational.LossyGear(ratio=2.0, lossTable=[[0.0, 0.9, 0.8, 0.3, 0.5], [10.0, 0.8, 0.7, 0.4, 0.7]])
    model = assemble(
        "drive.flange - wheel.flange_a", "wheel.flange_b - gear.flange_a", "gear.flange_b - load.flange_a", gear=gear,
        drive=rotational.ConstantTorque(tau_constant=8.0), load=rotational.Inertia(J=4.0),
        wheel=rotational.Inertia(phi=start(0.0, fixed=True), w=start(5.0, fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=0.1, saveat=2)
    of = lambda *names: [run[f"gear.{name}"][0] for name in names]  # noqa: E731
    assert of("eta_mf1", "eta_mf2", "tau_bf1", "tau_bf2") == pytest.approx([0.85, 0.75, 0.35, 0.6])
    assert of("tau_bf_a") == pytest.approx([0.25 / (1 / 0.75 - 0.85)])
    tau, most, least = of("tau_a", "tauLossMax", "tauLossMin")
    assert most == pytest.approx(0.15 * tau + 0.35) and least == pytest.approx((1 - 1 / 0.75) * tau - 0.6)
    assert of("tauLoss") == [most]


def test_a_gap_tells_whether_it_is_closed() -> None:
    gap = translational.ElastoGap(c=100.0, d=500.0)
    ball = translational.PointMass(m=2.0, s=start(0.1, fixed=True), v=start(-1.0, fixed=True))
    model = assemble("floor.flange - gap.flange_a", "gap.flange_b - ball.flange", floor=translational.Fixed(), gap=gap,
                     ball=ball)  # fmt: skip
    run = ac.compile(model).simulate(t1=0.15, saveat=[0.05, 0.15])
    assert run["gap.contact"].tolist() == [0.0, 1.0] and run["gap.f_d2"][0] == 0.0
    v, f_c = run["ball.v"][-1], run["gap.f_c"][-1]
    assert run["gap.f_d2"][-1] == pytest.approx(500.0 * v) and run["gap.f_d"][-1] == pytest.approx(f_c)  # limited


def test_a_line_force_tells_its_direction_in_its_first_frame() -> None:
    model = assemble(
        "world.frame_b - turned.frame_a", "turned.frame_b - spring.frame_a", "spring.frame_b - bob.frame_a",
        world=ac.inner(multibody.World()), turned=multibody.FixedRotation(n=(0.0, 0.0, 1.0), angle=90.0),
        spring=multibody.Spring(c=10.0), bob=multibody.PointMass(r_0=start((3.0, 4.0, 0.0), fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=0.1, saveat=2)
    of = lambda name: [run[f"spring.{name}[{i}]"][0] for i in (1, 2, 3)]  # noqa: E731
    assert run["spring.length"][0] == pytest.approx(5.0)
    np.testing.assert_allclose(of("r_rel_a"), [4.0, -3.0, 0.0], atol=1e-12)
    np.testing.assert_allclose(of("e_a"), [0.8, -0.6, 0.0], atol=1e-12)


def test_a_detailed_amplifier_tells_the_currents_of_its_inputs() -> None:
    model = assemble(
        "source.p - amp.p", "amp.m - amp.outp - load.p", "high.p - amp.p_supply", "low.n - amp.m_supply",
        "source.n - load.n - high.n - low.p - ground.p", source=electrical.ConstantVoltage(V=2.0),
        ground=electrical.Ground(), amp=electrical.OpAmpDetailed(), load=electrical.Resistor(R=1e4),
        high=electrical.ConstantVoltage(V=15.0), low=electrical.ConstantVoltage(V=14.0),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=1e-4, saveat=2)
    names = "v_3 v_4 v_out v_pos v_neg i_3 i_4 i_vos i_r2 i_out p.i outp.i q_sum q_sum_help".split()
    of = {name: float(run[f"amp.{name}"][-1]) for name in names}
    assert (of["v_3"], of["v_pos"], of["v_neg"]) == pytest.approx((1.999, 15.0, -14.0)) and of["v_4"] == of["v_out"]
    assert of["i_3"] == pytest.approx(9e-8 + 1.999 / 2e9) and of["i_4"] == pytest.approx(7e-8 + of["v_4"] / 2e9)
    assert of["p.i"] == of["i_vos"] and of["i_out"] == of["outp.i"] and of["q_sum_help"] == pytest.approx(of["q_sum"])
    assert of["i_r2"] == pytest.approx((of["v_3"] - of["v_4"]) / 2e6, abs=1e-15)


@pytest.mark.slow
def test_a_gap_has_derivatives_where_it_is_open() -> None:
    """With an implicit method, that differentiates the force twice."""
    ball = translational.PointMass(m=2.0, s=start(0.1, fixed=True), v=start(-1.0, fixed=True))
    model = assemble("floor.flange - gap.flange_a", "gap.flange_b - ball.flange", floor=translational.Fixed(),
                     gap=translational.ElastoGap(c=100.0), ball=ball)  # fmt: skip
    system = ac.compile(model)

    def s(c: Any, engine: Any) -> Any:
        return system.simulate(t1=0.3, saveat=2, parameters={"gap.c": c}, engine=engine)["ball.s"][-1]

    slopes = [float(jax.grad(s)(100.0, engine)) for engine in ("native", "diffrax")]
    assert slopes[0] > 1e-4 and slopes[1] == pytest.approx(slopes[0], rel=1e-2)
