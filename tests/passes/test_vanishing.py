"""Zeros that take an unknown out of its equation: massless bodies, capacitors without capacitance."""

from __future__ import annotations

from typing import Any, Literal

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import acausal as ac
from acausal import Component, start
from acausal.components import electrical as el
from acausal.components import rotational as rot
from acausal.components import translational as tra
from acausal.components.examples import assemble
from acausal.errors import DeclarationError, StructureError

ENGINES: tuple[Literal["native", "diffrax"], ...] = ("native", "diffrax")


def _turned(J0: float) -> Component:
    return assemble(
        "drive.flange - first.flange_a", "first.flange_b - spring.flange_a", "spring.flange_b - load.flange_a",
        drive=rot.ConstantTorque(tau_constant=1.0), first=rot.Inertia(J=J0), spring=rot.SpringDamper(c=100.0, d=1.0),
        load=rot.Inertia(J=0.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    )  # fmt: skip


@pytest.mark.parametrize("engine", ENGINES)
def test_a_shaft_without_inertia_hands_the_torque_on(engine: Any) -> None:
    """The load turns with tau/J; the spring, damped, stays wound up by tau/c from the first moment that it can."""
    system = ac.compile(_turned(0.0))
    assert system.report().structural_index == 3
    run = system.simulate(1.0, rtol=1e-9, engine=engine, initial={"spring.phi_rel": -0.01})
    t = np.asarray(run.t)
    assert np.allclose(run["load.w"], 2.0 * t, atol=1e-7)
    assert np.allclose(run["spring.tau"], -1.0, atol=1e-9)


def test_a_small_inertia_tends_to_none() -> None:
    """What a zero makes of the equations is the limit of small values, by their order."""
    exact = ac.compile(_turned(0.0)).simulate(1.0, rtol=1e-10, initial={"spring.phi_rel": -0.01})["load.phi"]
    apart: list[float] = []
    for J in (1e-3, 1e-4):
        run = ac.compile(_turned(J)).simulate(1.0, rtol=1e-10, initial={"spring.phi_rel": -0.01})
        apart.append(float(np.max(np.abs(np.asarray(run["load.phi"]) - exact))))
    assert 0 < apart[1] < 0.12 * apart[0]


@pytest.mark.parametrize("engine", ENGINES)
def test_neither_capacitance_nor_inductance(engine: Any) -> None:
    """A resistor, a coil of 0 H and a capacitor of 0 F across a source: no current, all of the voltage at the end."""
    model = assemble(
        "source.p - r.p", "r.n - coil.p", "coil.n - c.p", "c.n - source.n - ground.p",
        source=el.SineVoltage(V=3.0, f=1.0), r=el.Resistor(R=2.0), coil=el.Inductor(L=0.0), c=el.Capacitor(C=0.0),
        ground=el.Ground(),
    )  # fmt: skip
    system = ac.compile(model)
    assert system.report().states == 0
    run = system.simulate(1.0, engine=engine)
    assert np.allclose(run["c.v"], 3.0 * np.sin(2 * np.pi * np.asarray(run.t)), atol=1e-12)
    assert np.allclose(run["coil.i"], 0.0, atol=1e-15)
    other = system.simulate(1.0, engine=engine, parameters={"r.R": 0.0, "source.V": 1.0})  # these may still change
    assert np.max(np.asarray(other["c.v"])) == pytest.approx(1.0, abs=1e-3)


def _ladder(L: list[float], C: list[float]) -> Component:
    """Coils lengthwise and capacitors across, each with its resistance; elements of None are not there."""
    parts: dict[str, Component] = {"source": el.SineVoltage(V=1.0, f=0.7), "ground": el.Ground()}
    joints, node, foot = [], "source.p", ["source.n", "ground.p"]
    for k, (inductance, capacitance) in enumerate(zip(L, C, strict=True)):
        parts[f"r{k}"], parts[f"g{k}"] = el.Resistor(R=1.0 + k), el.Resistor(R=5.0 + k)
        joints.append(f"{node} - r{k}.p")
        node = f"r{k}.n"
        if not np.isnan(inductance):
            parts[f"l{k}"] = el.Inductor(L=inductance)
            joints.append(f"{node} - l{k}.p")
            node = f"l{k}.n"
        across = [f"g{k}.p"]
        foot.append(f"g{k}.n")
        if not np.isnan(capacitance):
            parts[f"c{k}"] = el.Capacitor(C=capacitance)
            across.append(f"c{k}.p")
            foot.append(f"c{k}.n")
        joints.append(" - ".join([node, *across]))
    return assemble(*joints, " - ".join(foot), **parts)


values = st.lists(st.sampled_from([0.0, 0.3, 0.7, 1.1]), min_size=3, max_size=3)


def _same_as_without_the_elements(L: list[float], C: list[float]) -> None:
    """A coil of 0 H is a wire, a capacitor of 0 F nothing at all."""
    bare = _ladder([x or np.nan for x in L], [x or np.nan for x in C])
    system, expected = ac.compile(_ladder(L, C)), ac.compile(bare)
    assert system.report().states == expected.report().states == sum(x > 0 for x in L + C)
    run, reference = (s.simulate(3.0, rtol=1e-9, saveat=31) for s in (system, expected))
    for k in range(3):
        assert np.allclose(run[f"g{k}.v"], reference[f"g{k}.v"], atol=1e-7)


@settings(max_examples=4, deadline=None)
@given(values, values)
def test_random_ladders_are_those_without_the_elements(L: list[float], C: list[float]) -> None:
    _same_as_without_the_elements(L, C)


@pytest.mark.slow
@settings(max_examples=40, deadline=None)
@given(values, values)
def test_many_random_ladders(L: list[float], C: list[float]) -> None:
    _same_as_without_the_elements(L, C)


def _coupled(L: float) -> Component:
    return assemble(
        "source.p - r.p", "r.n - trafo.p1", "trafo.p2 - load.p", "source.n - trafo.n1 - trafo.n2 - load.n - ground.p",
        source=el.ConstantVoltage(V=6.0), r=el.Resistor(R=1.0), load=el.Resistor(R=2.0), ground=el.Ground(),
        trafo=el.Transformer(L1=L, L2=L, M=2.0, i1=start(2.0, fixed=True)),
    )  # fmt: skip


@pytest.mark.parametrize("engine", ENGINES)
def test_a_difference_of_equal_parameters_is_a_zero(engine: Any) -> None:
    """Of two windings without leakage the sum of the currents is the state: ``v = 4 exp(-t/3)``, from no field."""
    system = ac.compile(_coupled(2.0))
    assert len(system.states) == 1
    run = system.simulate(3.0, rtol=1e-9, engine=engine)
    v = 4 * np.exp(-np.asarray(run.t) / 3)
    assert np.allclose(run["trafo.v1"], v, atol=1e-7) and np.allclose(run["trafo.v2"], v, atol=1e-7)
    assert np.allclose(run["trafo.i1"], 6 - v, atol=1e-7) and np.allclose(run["trafo.i2"], -v / 2, atol=1e-7)
    with pytest.raises(DeclarationError, match=r"`trafo.L1` is built into the equations"):
        system.simulate(1.0, parameters={"trafo.L1": 3.0})
    assert len(ac.compile(_coupled(2.5)).states) == 2


def test_a_mass_of_zero_between_springs() -> None:
    """Index 1: the place of the massless joint follows from the forces of both springs."""
    model = assemble(
        "wall.flange - a.flange_a", "a.flange_b - joint.flange_a", "joint.flange_b - b.flange_a",
        "b.flange_b - load.flange_a", wall=tra.Fixed(), a=tra.Spring(c=3.0), joint=tra.Mass(m=0.0),
        b=tra.Spring(c=6.0), load=tra.Mass(m=2.0, s=start(0.1, fixed=True), v=start(0.0, fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(5.0, rtol=1e-10)
    t = np.asarray(run.t)
    assert np.allclose(run["load.s"], 0.1 * np.cos(t), atol=1e-7)  # 3 and 6 N/m in series: 2 N/m
    assert np.allclose(run["joint.s"], 2 / 3 * np.asarray(run["load.s"]), atol=1e-9)


def test_what_a_zero_made_of_the_model_cannot_be_changed_in_a_run() -> None:
    system = ac.compile(_turned(0.0))
    with pytest.raises(DeclarationError, match=r"`first.J` is built into the equations .*a zero that takes an unknown"):
        system.simulate(1.0, parameters={"first.J": 1.0})
    assert ac.compile(_turned(0.1)).simulate(0.1, parameters={"first.J": 0.2}).t[-1] == pytest.approx(0.1)


def test_a_model_that_a_zero_makes_singular() -> None:
    rotor, drive = rot.Inertia(J=0.0), rot.ConstantTorque(tau_constant=1.0)
    model = assemble("drive.flange - rotor.flange_a", drive=drive, rotor=rotor)
    with pytest.raises(StructureError) as caught:
        ac.compile(model)
    text = str(caught.value)
    assert "structurally singular" in text
    assert "drive.tau_constant = 0" in text
    assert "The value 0 of `rotor.J` takes unknowns out of their equations" in text
    assert "Give it another value, or leave the component out" in text


def test_two_springs_at_one_massless_body() -> None:
    """Both relative positions are wanted as states, but nothing moves between the two: they hold the force together."""
    model = assemble(
        "load.flange_b - slide.flange_a - a.flange_a - b.flange_b", "a.flange_b - body.flange_a - b.flange_a",
        "body.flange_b - push.flange", load=tra.Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
        slide=tra.SupportFriction(f_pos=[[0.0, 1.0]]), a=tra.SpringDamper(c=2.0, d=0.0),
        b=tra.SpringDamper(c=3.0, d=0.0), body=tra.Mass(m=0.0), push=tra.ConstantForce(f_constant=4.0),
    )  # fmt: skip
    run = ac.compile(model).simulate(2.0, rtol=1e-9)
    assert np.allclose(run["load.s"], 0.75 * np.asarray(run.t) ** 2, atol=1e-7)
    assert np.allclose(run["a.s_rel"], 0.8, atol=1e-9)
    assert np.allclose(run["b.s_rel"], -0.8, atol=1e-9)
