"""Bond graphs against the component models that they stand for, and their balance of power."""

from __future__ import annotations

from contextlib import nullcontext

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import Array, Component, ConnectError, Equations, connect
from acausal.components import bondgraph, electrical, hydraulic, rotational
from acausal.components.examples import assemble
from models.kbc import reference_crane

CYLINDERS: dict[str, tuple[hydraulic.PartialCylinder, dict[str, float], float]] = {
    # without bumpers the piston comes to the boom's dead centre at x = 2.4 m, shortly before 12 s
    "simplified": (bondgraph.SimplifiedCylinder(), {}, 11.0),
    "extended": (bondgraph.ExtendedCylinder(), {"bore": 0.24}, 12.0),
}


@pytest.mark.parametrize("joint", ["rigid", "compliant"])
@pytest.mark.parametrize("hydraulics", CYLINDERS)
def test_the_crane_with_a_cylinder_of_bonds_is_the_crane(hydraulics: str, joint: str) -> None:
    cylinder, changes, end = CYLINDERS[hydraulics]
    components = reference_crane(hydraulics, joint, scenario="endstop", **changes)
    bonds = ac.redeclare(components, {"cylinder": cylinder})
    t = np.linspace(0.0, end, 61)
    torn = pytest.warns(UserWarning, match="below a vacuum")  # at the end stop, in the lines of both
    with torn if hydraulics == "extended" else nullcontext():
        one, two = (ac.compile(model).simulate(t1=end, saveat=t, rtol=1e-9) for model in (components, bonds))
    for name in ("x", "cylinder.v", "cylinder.p_a", "cylinder.p_b", "cylinder.flange.f", "cylinder.port_b.q"):
        assert_allclose(two[name], one[name], rtol=2e-6, atol=2e-6 * np.ptp(one[name]), err_msg=name)


def test_a_bond_graph_keeps_the_power() -> None:
    """Motor and pump: source, coil, gyrator, rotor with friction, transformer, accumulator with a leak."""
    model = assemble(
        "source.port - coil.inp[0]", "coil.out[0] - inductance.port", "coil.out[1] - resistance.port",
        "coil.out[2] - motor.port_a", "motor.port_b - bond.port_a", "bond.port_b - shaft.inp[0]",
        "shaft.out[0] - rotor.port", "shaft.out[1] - friction.port", "shaft.out[2] - pump.port_a",
        "pump.port_b - node.inp[0]", "node.out[0] - accumulator.port", "node.out[1] - leak.port",
        source=bondgraph.Se(e=24.0), coil=bondgraph.J1(n_out=3), inductance=bondgraph.I(I=0.1),
        resistance=bondgraph.R(R=0.5), motor=bondgraph.GY(r=0.8), bond=bondgraph.Bond(), shaft=bondgraph.J1(n_out=3),
        rotor=bondgraph.I(I=0.2), friction=bondgraph.R(R=0.05), pump=bondgraph.TF(m=2.0), node=bondgraph.J0(),
        accumulator=bondgraph.C(C=0.3), leak=bondgraph.R(R=4.0),
    )  # fmt: skip
    system = ac.compile(model)
    assert len(system.states) == 3
    solution = system.simulate(t1=2.0, saveat=np.linspace(0.0, 2.0, 201), rtol=1e-10)
    given = np.asarray(solution["source.port.e"] * solution["source.f"])
    taken = sum(
        np.asarray(solution[f"{part}.e"] * solution[f"{part}.f"])
        for part in ("inductance", "resistance", "rotor", "friction", "accumulator", "leak")
    )
    assert_allclose(taken, given, atol=1e-9 * np.max(np.abs(given)))
    assert_allclose(solution["bond.power"], solution["motor.e2"] * solution["motor.f2"], atol=1e-9)


def test_derivative_causality() -> None:
    """Two inertias on a lever are one state: what one takes depends on the other."""
    model = assemble(
        "push.port - joint.inp[0]", "joint.out[0] - one.port", "joint.out[1] - lever.port_a", "lever.port_b - two.port",
        push=bondgraph.Se(e=6.0), joint=bondgraph.J1(), one=bondgraph.I(I=2.0, f=ac.start(0.0, fixed=True)),
        lever=bondgraph.TF(m=0.5), two=bondgraph.I(I=4.0),
    )  # fmt: skip
    system = ac.compile(model)
    assert len(system.states) == 1
    t = np.linspace(0.0, 1.0, 11)
    solution = system.simulate(t1=1.0, saveat=t)
    assert_allclose(solution["one.f"], 6.0 / (2.0 + 4.0 * 0.25) * t, atol=1e-9)


def test_series_resonance() -> None:
    model = assemble(
        "source.port - loop.inp[0]", "loop.out[0] - coil.port", "loop.out[1] - resistor.port",
        "loop.out[2] - capacitor.port", source=bondgraph.Se(e=10.0), loop=bondgraph.J1(n_out=3),
        coil=bondgraph.I(I=0.1, f=ac.start(0.0, fixed=True)), resistor=bondgraph.R(R=4.0),
        capacitor=bondgraph.C(C=1e-3, e=ac.start(0.0, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 0.3, 61)
    solution = ac.compile(model).simulate(t1=0.3, saveat=t, rtol=1e-10)
    decay = 4.0 / (2 * 0.1)
    frequency = np.sqrt(1 / (0.1 * 1e-3) - decay**2)
    assert_allclose(
        solution["loop.f"], 10.0 / (0.1 * frequency) * np.exp(-decay * t) * np.sin(frequency * t), atol=1e-7
    )


def test_algebraic_loop_of_resistors() -> None:
    """A bridge: no causality can be given by stroke propagation, the five resistors are one system of equations."""
    model = assemble(
        "source.port - top.inp[0]", "top.out[0] - one.inp[0]", "top.out[1] - two.inp[0]",
        "one.out[0] - r1.port", "one.out[1] - left.inp[0]", "two.out[0] - r2.port", "two.out[1] - right.inp[0]",
        "left.out[0] - r3.port", "left.out[1] - across.inp[0]", "across.out[0] - r5.port",
        "across.out[1] - right.inp[1]", "right.out[0] - r4.port", source=bondgraph.Se(e=12.0),
        top=bondgraph.J0(), one=bondgraph.J1(), two=bondgraph.J1(), left=bondgraph.J0(),
        right=bondgraph.J0(n_in=2, n_out=1), across=bondgraph.J1(), r1=bondgraph.R(R=1.0), r2=bondgraph.R(R=2.0),
        r3=bondgraph.R(R=3.0), r4=bondgraph.R(R=4.0), r5=bondgraph.R(R=5.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(t1=1.0, saveat=[0.0, 1.0])
    conductances = np.array([[1 + 1 / 3 + 1 / 5, -1 / 5], [-1 / 5, 1 / 2 + 1 / 4 + 1 / 5]])
    left, right = np.linalg.solve(conductances, [12.0, 6.0])
    assert_allclose(solution["r5.f"], (left - right) / 5, rtol=1e-9)
    assert_allclose(solution["source.f"], (12 - left) + (12 - right) / 2, rtol=1e-9)


def test_motor_of_a_gyrator_between_circuit_and_shaft() -> None:
    """A component circuit, a gyrator of the bond graph, a component shaft: ``w = V/k (1 - exp(-k^2 t/(R J)))``."""
    model = assemble(
        "source.p - resistor.p", "resistor.n - armature.p", "source.n - armature.n - ground.p",
        "armature.bond - motor.port_a", "motor.port_b - gear.port_a", "gear.port_b - shaft.bond",
        "shaft.flange - rotor.flange_a", source=electrical.ConstantVoltage(V=24.0), ground=electrical.Ground(),
        resistor=electrical.Resistor(R=2.0), armature=bondgraph.ElectricalBond(), motor=bondgraph.GY(r=3.0),
        gear=bondgraph.TF(m=0.5), shaft=bondgraph.RotationalBond(),
        rotor=rotational.Inertia(J=0.5, phi=ac.start(0.0, fixed=True), w=ac.start(0.0, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 1.0, 21)
    solution = ac.compile(model).simulate(t1=1.0, saveat=t, rtol=1e-10)
    # tau1 = 3 i, tau2 = tau1/0.5; w2 = 0.5 w1; v = 3 w1: as a motor of constant 6
    assert_allclose(solution["rotor.w"], 24.0 / 6.0 * (1 - np.exp(-(6.0**2) / (2.0 * 0.5) * t)), atol=1e-7)
    given = np.asarray(solution["armature.p.i"] * solution["armature.p.v"])
    assert_allclose(given, -solution["shaft.flange.tau"] * solution["rotor.w"], atol=1e-7)


class Ladder(Component):
    """Rungs of a resistor each, one of whose junctions keeps an end that nothing is connected to."""

    source: bondgraph.Se = bondgraph.Se(e=6.0)
    rungs: Array[bondgraph.J1] = Array(bondgraph.J1(), 2)
    loads: Array[bondgraph.R] = Array(bondgraph.R(), 2)

    def equations(self) -> Equations:
        yield connect(self.source.port, self.rungs[0].inp[0])
        yield connect(self.rungs[0].out[0], self.rungs[1].inp[0])
        yield connect(self.rungs[0].out[1], self.loads[0].port)
        yield connect(self.rungs[1].out[0], self.loads[1].port)


def test_an_end_of_a_junction_with_nothing_on_it_is_an_error() -> None:
    """It would carry no flow, and so stop that of the whole 1-junction."""
    with pytest.raises(ConnectError, match=r"nothing is connected to `rungs\[1\].out\[1\]`") as caught:
        ac.compile(Ladder())
    assert "or fewer of them: `n_out` says how many there are" in str(caught.value)
    assert "rungs: Array[bondgraph.J1]" in str(caught.value)


@pytest.mark.parametrize(
    "part", [bondgraph.C(), bondgraph.Bond(), bondgraph.TF(), bondgraph.MSe(), bondgraph.ElectricalBond()]
)
def test_an_element_without_a_bond_is_an_error(part: Component) -> None:
    model = assemble("source.port - load.port", source=bondgraph.Se(), load=bondgraph.R(), part=part)
    with pytest.raises(ConnectError, match=r"nothing is connected to `part[.](port|port_a|bond)`"):
        ac.compile(model)
