"""Random networks of library components: they run, or fail with a cause that is named, and they keep the books."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import simpson

import acausal as ac
from acausal import Component
from acausal.components import blocks, electrical, hydraulic, thermal, translational
from acausal.components.examples import assemble, start

pytestmark = pytest.mark.filterwarnings("ignore:.*below a vacuum:UserWarning")  # the books are kept there, too

T = np.concatenate([[0.0], np.geomspace(1e-7, 4e-4, 1000), np.linspace(5e-4, 2.0, 8000)])
"""Dense at the start, where volumes fill in microseconds."""
Books = Callable[[ac.Solution], tuple[Any, Any, Any]]
"""From a solution to the power that goes in, the energy that is stored, and the power that is lost."""


def tree(rng: np.random.Generator, nodes: int, more: int) -> list[tuple[int, int]]:
    """Edges of a random connected graph."""
    edges = [(int(rng.integers(0, k)), k) for k in range(1, nodes)]
    return edges + [(int(a), int(b)) for a, b in (rng.choice(nodes, 2, replace=False) for _ in range(more))]


def circuit(rng: np.random.Generator) -> tuple[Component, Books]:
    """Resistors, capacitors, inductors, ideal diodes and one source with a resistor, between random nodes."""
    nodes, parts, at = int(rng.integers(2, 6)), {}, {}
    for k, (a, b) in enumerate(tree(rng, nodes, int(rng.integers(1, 5)))):
        kind = rng.choice(["R", "C", "L", "D"], p=[0.35, 0.25, 0.2, 0.2])
        value = float(10 ** rng.uniform(-1, 1))
        parts[f"{kind}{k}"] = {
            "R": lambda v: electrical.Resistor(R=v), "C": lambda v: electrical.Capacitor(C=0.1 * v, v=start(0.0)),
            "L": lambda v: electrical.Inductor(L=0.1 * v, i=start(0.0)),
            "D": lambda v: electrical.IdealDiode(Ron=0.01, Goff=1e-3, Vknee=0.1 * v),
        }[kind](value)  # fmt: skip
        for node, end in ((a, "p"), (b, "n")):
            at.setdefault(node, []).append(f"{kind}{k}.{end}")
    parts |= {"V": electrical.SineVoltage(V=5.0, f=1.0), "Rs": electrical.Resistor(R=0.5)}
    parts["ground"] = electrical.Ground()
    at[nodes - 1].append("Rs.n")
    at[0] += ["V.n", "ground.p"]
    model = assemble("V.p - Rs.p", *(" - ".join(ends) for ends in at.values() if len(ends) > 1), **parts)

    def books(s: ac.Solution) -> tuple[Any, Any, Any]:
        power = {n: np.asarray(s[f"{n}.v"]) * np.asarray(s[f"{n}.i"]) for n in parts if n != "ground"}
        stored: Any = 0.0
        for n in power:
            if n[0] in "CL":
                size = s.system.parameters[f"{n}.{n[0]}"]
                stored = stored + 0.5 * size * np.asarray(s[f"{n}.{'v' if n[0] == 'C' else 'i'}"]) ** 2
        lost = sum(p for n, p in power.items() if n[0] in "RD")
        assert_allclose(sum(power.values()), 0.0, atol=1e-7 * max(1.0, np.abs(lost).max()))
        return -power["V"], stored, lost

    return model, books


def chain(rng: np.random.Generator) -> tuple[Component, Books]:
    """Masses in a tree of springs, dampers and gaps, some of them on a slide with friction, one of them driven."""
    n = int(rng.integers(2, 5))
    parts: dict[str, Any] = {"wall": translational.Fixed()}
    lines = []
    for k in range(n):
        free = {"s": start(0.2 * k, fixed=True), "v": start(float(rng.uniform(-1, 1)), fixed=True)}
        parts[f"m{k}"] = translational.Mass(m=float(rng.uniform(0.5, 3)), **free)
        if rng.random() < 0.5:
            parts[f"slide{k}"] = translational.SupportFriction(f_pos=[[0, float(rng.uniform(0.2, 2))]], peak=1.2)
            lines.append(f"m{k}.flange_b - slide{k}.flange_a")
    for k, (a, b) in enumerate(tree(rng, n, 1)):
        kind = str(rng.choice(["spring", "damper", "both", "gap"]))
        c, d = float(10 ** rng.uniform(0, 2)), float(10 ** rng.uniform(-1, 1))
        parts[f"{kind}{k}"] = {
            "spring": translational.Spring(c=c, s_rel0=0.2), "damper": translational.Damper(d=d),
            "both": translational.SpringDamper(c=c, d=d, s_rel0=0.2), "gap": translational.ElastoGap(c=c, d=d, n=1.0),
        }[kind]  # fmt: skip
        lines += [f"m{a}.flange_b - {kind}{k}.flange_a", f"m{b}.flange_b - {kind}{k}.flange_b"]
    parts["hold"], parts["push"] = translational.Spring(c=10.0), translational.ConstantForce(f_constant=2.0)
    lines += ["wall.flange - hold.flange_a", "hold.flange_b - m0.flange_a", f"push.flange - m{n - 1}.flange_a"]
    model = assemble(*lines, **parts)

    def books(s: ac.Solution) -> tuple[Any, Any, Any]:
        value = s.system.parameters
        stored = sum(0.5 * value[f"m{k}.m"] * np.asarray(s[f"m{k}.v"]) ** 2 for k in range(n))
        lost: Any = 0.0
        for name in parts:
            if name.startswith(("spring", "both", "hold", "gap")):
                by = np.asarray(s[f"{name}.s_rel"]) - value[f"{name}.s_rel0"]
                stored = stored + 0.5 * value[f"{name}.c"] * (np.minimum(by, 0.0) if name[0] == "g" else by) ** 2
            if name.startswith(("damper", "both", "gap", "slide")):
                lost = lost + np.asarray(s[f"{name}.lossPower"])
        return 2.0 * np.asarray(s[f"m{n - 1}.v"]), stored, lost

    return model, books


def bodies(rng: np.random.Generator) -> tuple[Component, Books]:
    """Heat capacities between conductors and radiation, in a heat flow."""
    n = int(rng.integers(2, 6))
    parts: dict[str, Any] = {
        f"C{k}": thermal.HeatCapacitor(C=float(rng.uniform(1, 10)), T=start(float(rng.uniform(280, 400)), fixed=True))
        for k in range(n)
    }
    lines = []
    for k, (a, b) in enumerate(tree(rng, n, int(rng.integers(0, 3)))):
        G = float(rng.uniform(0.1, 5))
        parts[f"e{k}"] = thermal.BodyRadiation(Gr=0.5) if rng.random() < 0.4 else thermal.ThermalConductor(G=G)
        lines += [f"C{a}.port - e{k}.port_a", f"C{b}.port - e{k}.port_b"]
    parts["heat"] = thermal.FixedHeatFlow(Q_flow=20.0)
    model = assemble(*lines, "heat.port - C0.port", **parts)

    def books(s: ac.Solution) -> tuple[Any, Any, Any]:
        stored = sum(s.system.parameters[f"C{k}.C"] * np.asarray(s[f"C{k}.T"]) for k in range(n))
        return np.full(len(T), 20.0), stored, np.zeros(len(T))

    return model, books


def network(rng: np.random.Generator) -> tuple[Component, Books]:
    """A pump with a relief valve, orifices, valves, pipes between volumes and bare junctions, a cylinder with a load.

    Node 0 is the tank, the last one the pump's.
    """
    nodes, parts, at = int(rng.integers(3, 7)), {}, {}
    for k in range(1, nodes):
        if rng.random() < 0.6 or k == nodes - 1:
            p = start(float(rng.uniform(1e5, 5e6)), fixed=True)
            parts[f"volume{k}"] = hydraulic.ControlVolume(V=float(10 ** rng.uniform(-4, -2.5)), p=p)
            at.setdefault(k, []).append(f"volume{k}.port")
    for k, (a, b) in enumerate(tree(rng, nodes, int(rng.integers(1, 4)))):
        kind = str(rng.choice(["orifice", "gap", "check", "relief", "pipe", "valve"]))
        if kind == "pipe" and not {f"volume{a}", f"volume{b}"}.isdisjoint(parts):
            kind = "orifice"  # a pipe has volumes of its own, whose pressures two starts would fix
        area = float(10 ** rng.uniform(-6, -4.5))
        parts[f"{kind}{k}"] = {
            "orifice": lambda a: hydraulic.Orifice(area=a), "gap": lambda a: hydraulic.LaminarRestriction(G=1e-6 * a),
            "check": lambda a: hydraulic.CheckValve(A_full=a), "valve": lambda a: hydraulic.TwoWayValve(A_full=a),
            "relief": lambda a: hydraulic.ReliefValve(p_set=2e6, A_full=a), "pipe": lambda _: hydraulic.Pipe(d=0.02),
        }[kind](area)  # fmt: skip
        for node, end in ((a, "port_a"), (b, "port_b")):
            at.setdefault(node, []).append(f"{kind}{k}.{end}")
    parts |= {"tank": hydraulic.Tank(p=1e5), "pump": hydraulic.FixedPump(V_disp=1e-5, omega=10.0)}
    parts["relief"] = hydraulic.ReliefValve(p_set=float(rng.uniform(3e6, 2e7)))
    at[0] += ["tank.port", "pump.port_a", "relief.port_b"]
    at[nodes - 1] += ["pump.port_b", "relief.port_a"]
    lines = []
    if rng.random() < 0.5:
        moving = {"x": start(0.5, fixed=True), "v": start(0.0, fixed=True)}
        parts["cylinder"] = hydraulic.SimplifiedCylinder(bore=0.05, rod=0.03, **moving)
        parts["load"], parts["spring"] = translational.PointMass(m=200.0), translational.SpringDamper(c=1e5, d=2e3)
        parts["wall"] = translational.Fixed()
        at[int(rng.integers(1, nodes))].append("cylinder.port_a")
        at[0].append("cylinder.port_b")
        lines += ["cylinder.flange - load.flange - spring.flange_b", "spring.flange_a - wall.flange"]
    for name in [n for n in parts if n.startswith("valve")]:
        parts[f"u_{name}"] = blocks.Sine(amplitude=0.5, offset=0.5, f=float(rng.uniform(0.5, 3)))
        lines.append(f"u_{name}.y - {name}.u")
    oil = hydraulic.Oil()
    joined = [" - ".join(ends) for ends in at.values() if len(ends) > 1]
    model = assemble(*joined, *lines, oil=ac.inner(oil), **parts)

    def books(s: ac.Solution) -> tuple[Any, Any, Any]:
        def power(name: str) -> Any:
            return sum(np.asarray(s[f"{name}.{port}.p"]) * np.asarray(s[f"{name}.{port}.q"]) for port in ports(name))

        def ports(name: str) -> list[str]:
            return ["port"] if name.startswith(("tank", "volume")) else ["port_a", "port_b"]

        rho, B = 850.0, 1.2e9
        mechanical = ("load", "spring", "wall", "u_")
        oily = [n for n in parts if not n.startswith(mechanical)]
        put_in, stored, lost = -power("pump") - power("tank"), np.zeros(len(T)), np.zeros(len(T))
        total = -put_in
        for name in oily:
            if name in ("pump", "tank"):
                continue
            total = total + power(name)
            if name.startswith("volume"):
                stored = stored + s.system.parameters[f"{name}.V"] / (2 * B) * np.asarray(s[f"{name}.p"]) ** 2
            elif name.startswith("pipe"):
                area, q = np.pi / 4 * 0.02**2, np.asarray(s[f"{name}.q"])
                ends = np.asarray(s[f"{name}.p_a"]) ** 2 + np.asarray(s[f"{name}.p_b"]) ** 2
                stored = stored + area * 10.0 / (4 * B) * ends + rho * 10.0 / (2 * area) * q**2
                lost = lost + np.asarray(s[f"{name}.friction.dp"]) * q
            elif name == "cylinder":
                stretch = np.asarray(s["spring.s_rel"]) - s.system.parameters["spring.s_rel0"]
                stored = stored + 0.5 * 200.0 * np.asarray(s["cylinder.v"]) ** 2 + 0.5 * 1e5 * stretch**2
                lost = lost + np.asarray(s["spring.lossPower"])
            else:
                lost = lost + power(name)
                assert (power(name) >= -1e-9 * np.abs(put_in).max()).all(), name
        assert_allclose(total, 0.0, atol=1e-5 * max(1.0, np.abs(lost).max()))
        return put_in, stored, lost

    return model, books


KINDS = {"network": network, "circuit": circuit, "chain": chain, "bodies": bodies}


def kept(kind: str, seed: int, engine: Any = "native") -> bool:
    """Whether a random network runs; then its books have to be right. False where an error names a cause."""
    model, books = KINDS[kind](np.random.default_rng(seed))
    try:
        system = ac.compile(model)
        solution = system.simulate(T[-1], saveat=T, rtol=1e-8, engine=engine, max_steps=200_000)
    except ac.AcausalError as error:
        assert any(word in str(error) for word in (".py:", "`")), f"seed {seed}: {error}"
        return False
    put_in, stored, lost = books(solution)
    stored = np.broadcast_to(stored, T.shape)  # a network may store nothing
    change = stored - stored[0]
    wanted = simpson(np.asarray(put_in) - lost, x=T)
    size = max(simpson(np.abs(put_in) + np.abs(lost), x=T), np.abs(change).max(), 1e-3)
    assert abs(change[-1] - wanted) < 5e-4 * size, f"{kind}, seed {seed}: {change[-1]} and not {wanted}"
    return True


@pytest.mark.parametrize("kind", KINDS)
def test_random_networks_keep_the_books(kind: str) -> None:
    assert sum(kept(kind, seed) for seed in range(5)) >= 4


@pytest.mark.parametrize("seed", [50, 72])
def test_steps_that_end_just_behind_a_kink(seed: int) -> None:
    """Check valves in a row: where one closes, the pressure between them is found anew, which no small step does."""
    assert kept("network", seed)


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_many_random_networks(kind: str) -> None:
    assert sum(kept(kind, seed) for seed in range(5, 100)) >= 76


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_random_networks_on_the_diffrax_engine(kind: str) -> None:
    assert sum(kept(kind, seed, "diffrax") for seed in range(4)) >= 3
