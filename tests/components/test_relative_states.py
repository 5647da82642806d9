"""Relative positions and velocities as states, and their nominal values."""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Array, Component, Equations, Input, connect, pre, reinit, sample, structural, when
from acausal.components import blocks, rotational, translational
from acausal.components.examples import assemble, start


def pair(shaft: Component) -> Component:
    """Two masses, one of which is given by the relative position and velocity."""
    return assemble(
        "one.flange_b - shaft.flange_a", "shaft.flange_b - two.flange_a", shaft=shaft, two=translational.Mass(m=2.0),
        one=translational.Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    )  # fmt: skip


@pytest.mark.parametrize(("wish", "wanted"), [("prefer", True), ("default", False)])
def test_states_are_as_wished(wish: str, wanted: bool) -> None:
    shaft = translational.SpringDamper(
        c=8.0, d=0.0, stateSelect=wish, s_rel=start(1.0, fixed=True), v_rel=start(0.0, fixed=True)
    )
    system = ac.compile(pair(shaft))
    assert {"shaft.s_rel", "shaft.v_rel"} <= set(system.states) if wanted else "shaft.s_rel" not in system.states
    assert system.report().structural_index == 2  # v_rel is algebraic, whatever is done with it
    t = np.linspace(0.0, 3.0, 31)
    solution = system.simulate(3.0, saveat=t, rtol=1e-9)
    np.testing.assert_allclose(solution["shaft.s_rel"], np.cos(np.sqrt(8.0) * t), atol=1e-7)
    np.testing.assert_allclose(solution["one.s"] + solution["two.s"], 1.0, atol=1e-9)


def test_velocity_that_follows_from_forces_is_no_state() -> None:
    """Without a mass at its end, a damper's velocity follows from the force: its derivative is not asked for."""

    class Pulled(Component):
        force: Input = Input(unit="N")
        drive: translational.Force = translational.Force()
        shaft: translational.SpringDamper = translational.SpringDamper(c=8.0, d=2.0, s_rel=start(1.0, fixed=True))
        wall: translational.Fixed = translational.Fixed()

        def equations(self) -> Equations:
            yield self.drive.f == self.force
            yield connect(self.wall.flange, self.shaft.flange_a)
            yield connect(self.shaft.flange_b, self.drive.flange)

    system = ac.compile(Pulled())
    assert system.states == ("shaft.s_rel",)
    solution = system.simulate(1.0, inputs={"force": 4.0}, saveat=[0.0, 1.0], rtol=1e-9)
    np.testing.assert_allclose(solution["shaft.s_rel"], [1.0, 0.5 + 0.5 * np.exp(-4.0)], atol=1e-7)


def test_impact_keeps_the_relative_velocity() -> None:
    """What a stop takes from one side it takes from the other, too: the relative velocity is a state."""
    model = assemble(
        "mass.flange_b - shaft.flange_a", "shaft.flange_b - stop.flange_a",
        mass=translational.Mass(m=2.0, v=start(1.0, fixed=True)),
        shaft=translational.SpringDamper(c=0.0, d=0.0, s_rel=start(0.5, fixed=True), v_rel=start(0.5, fixed=True)),
        stop=translational.MassWithStopAndFriction(m=1.0, L=0.0, smax=1.0, smin=-1.0, F_prop=0.0, F_Coulomb=1e-6,
            F_Stribeck=0.0, s=start(0.25, fixed=True)),
    )  # fmt: skip
    with pytest.warns(UserWarning, match=r"`reinit` of `stop.s`, `stop.v` changes `mass.v`, too, from 1 to -0.49"):
        solution = ac.compile(model).simulate(0.6, saveat=[0.4, 0.6], rtol=1e-8)
    np.testing.assert_allclose(solution["stop.v"], [1.5, 0.0], atol=1e-5)
    np.testing.assert_allclose(solution["mass.v"], [1.0, -0.5], atol=1e-5)


class Struck(Component):
    """Two masses on a spring and damper; one of them, or a shaft geared to it, is struck twice."""

    keep: bool = False
    geared: bool = False
    stateSelect: str = "prefer"
    one: translational.Mass = translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    two: translational.Mass = translational.Mass(m=3.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True))
    spring: translational.SpringDamper = translational.SpringDamper(
        c=30.0, d=0.1, s_rel0=1.0, stateSelect=structural("stateSelect")
    )
    rack: rotational.IdealGearR2T = rotational.IdealGearR2T(ratio=2.0)
    shaft: rotational.Inertia = rotational.Inertia(J=0.0)

    def equations(self) -> Equations:
        yield connect(self.one.flange_b, self.spring.flange_a, self.rack.flangeT)
        yield connect(self.spring.flange_b, self.two.flange_a)
        yield connect(self.rack.flangeR, self.shaft.flange_a)
        one, two, shaft = self.one.v, self.two.v, self.shaft.w
        struck = [reinit(shaft, pre(shaft) + 2.0)] if self.geared else [reinit(one, pre(one) + 1.0)]
        yield when(sample(0.5, 1.0), *struck, *([reinit(two, pre(two))] if self.keep else []))


def struck_by_hand() -> np.ndarray:
    """Positions and velocities at 2 s."""

    def rates(_: float, y: np.ndarray) -> list[float]:
        f = 30.0 * (y[1] - y[0] - 1.0) + 0.1 * (y[3] - y[2])
        return [y[2], y[3], f, -f / 3.0]

    y = np.array([0.0, 1.0, 1.0, 0.0])
    y = solve_ivp(rates, (0.5, 1.5), y, rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1] + [0.0, 0.0, 1.0, 0.0]
    return solve_ivp(rates, (1.5, 2.0), y, rtol=1e-12, atol=1e-13, method="DOP853").y[:, -1]


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("geared", [False, True])
def test_what_a_blow_on_one_mass_does_to_the_other_is_said(geared: bool, engine: Any) -> None:
    """With the relative velocity as a state the other mass is struck, too; `reinit` of both says that it is not."""
    struck, name = "shaft.w" if geared else "one.v", "one.v"
    with pytest.warns(
        UserWarning, match=rf"`reinit` of `({struck}|{name})` changes `two.v`, too, from 0 to 1"
    ) as caught:
        ac.compile(Struck(geared=geared)).simulate(2.0, engine=engine)
    assert len(caught) == 1
    assert "Try: `reinit(two.v, pre(two.v))` beside it if `two.v` is to keep its value" in str(caught[0].message)
    for other in (Struck(geared=geared, keep=True), Struck(geared=geared, stateSelect="default")):
        solution = ac.compile(other).simulate(2.0, engine=engine, rtol=1e-9)
        found = [solution[n][-1] for n in ("one.s", "two.s", "one.v", "two.v")]
        np.testing.assert_allclose(found, struck_by_hand(), atol=1e-7)


def test_states_beside_a_prescribed_motion_are_those_of_the_mass() -> None:
    """A prescribed side may jump, as an input that is held over a communication step does."""
    model = assemble(
        "drive.y - move.s_ref", "move.flange - shaft.flange_a", "shaft.flange_b - two.flange_a",
        drive=blocks.Sine(f=0.2), move=translational.Position(exact=True),
        shaft=translational.SpringDamper(c=8.0, d=0.0, stateSelect="prefer"),
        two=translational.Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    )  # fmt: skip
    assert set(ac.compile(model).states) == {"two.s", "two.v"}


@pytest.mark.parametrize("scale", [0.0, -1.0])
def test_nominal_value_is_positive(scale: float) -> None:
    with pytest.raises(ac.DeclarationError, match=rf"`SpringDamper.phi_rel`.*`phi_nominal` is {scale}"):
        ac.compile(rotational.SpringDamper(phi_nominal=scale))


def test_nominal_value_is_the_scale_of_the_error_control() -> None:
    steps = []
    for scale in (1e-8, 1.0):
        shaft = translational.SpringDamper(c=8.0, d=0.0, s_nominal=scale, s_rel=start(1e-7, fixed=True))
        steps.append(ac.compile(pair(shaft)).simulate(3.0, rtol=1e-6).stats["steps"])
    assert steps[0] > steps[1]


@pytest.mark.parametrize("version", ["2.0", "3.0"])
def test_units_have_no_parameters_that_are_built_in(tmp_path: Path, version: Any) -> None:
    system = ac.compile(pair(translational.SpringDamper(c=8.0, d=1.0)))
    path = tmp_path / "pair.fmu"
    ac.fmi.export(system, path, version=version)
    with zipfile.ZipFile(path) as archive:
        root = ElementTree.fromstring(archive.read("modelDescription.xml"))
    references = {v.attrib["name"]: int(v.attrib["valueReference"]) for v in root.iterfind("ModelVariables/*")}
    assert "shaft.s_nominal" not in references and "shaft.c" in references
    rows = root.iterfind("ModelStructure//*[@dependencies]")
    knowns = {int(k) for row in rows for k in row.attrib["dependencies"].split()}
    numbers = set(references.values()) if version == "3.0" else set(range(1, len(references) + 1))
    assert knowns and knowns <= numbers


@pytest.mark.parametrize(
    ("wish", "states"),
    [("default", {"relative.s_rel", "relative.v_rel"}), ("always", {"two.s", "two.v"})],
)
def test_masses_may_be_states(wish: str, states: set[str]) -> None:
    model = assemble(
        "one.flange_a - relative.flange_a", "two.flange_a - relative.flange_b", one=translational.Mass(),
        two=translational.Mass(stateSelect=wish), relative=translational.RelativeStates(),
    )  # fmt: skip
    assert states < set(ac.compile(model).states)


@pytest.mark.parametrize("wish", ["prefer", "avoid"])
def test_relative_states_may_be_left_out(wish: str) -> None:
    model = assemble(
        "one.flange_a - relative.flange_a", "two.flange_a - relative.flange_b", one=rotational.Inertia(),
        two=rotational.Inertia(), relative=rotational.RelativeStates(stateSelect=wish, phi_nominal=1e-3),
    )  # fmt: skip
    assert ("relative.phi_rel" in ac.compile(model).states) == (wish == "prefer")


class Train(Component):
    """Wagons behind each other, the first of them held."""

    count: int = 3
    wall: translational.Fixed = translational.Fixed()
    couplings: Array[translational.SpringDamper] = Array(translational.SpringDamper(c=8.0, d=1.0), "count")
    wagons: Array[translational.Mass] = Array(
        translational.Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)), "count"
    )

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.couplings[0].flange_a)
        yield connect(self.couplings[:].flange_b, self.wagons[:].flange_a)
        yield connect(self.wagons[:-1].flange_b, self.couplings[1:].flange_a)


@pytest.mark.parametrize(("count", "velocity"), [(3, "couplings[2].v_rel"), (60, "wagons[59].v")])
def test_long_chains_keep_absolute_velocities(count: int, velocity: str) -> None:
    """There each would be a sum of all the relative ones before it."""
    assert {velocity, f"couplings[{count - 1}].s_rel"} < set(ac.compile(Train(count=count)).states)
