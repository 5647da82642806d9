"""Random bond graphs: those with a solution compile and keep the power, the others are reported with the culprits."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from hypothesis import HealthCheck, given, seed, settings
from hypothesis import strategies as st

import acausal as ac
from acausal import Component
from acausal.components import bondgraph as bg
from acausal.components.examples import assemble

S = 1.7
"""A value of Laplace's variable; any positive one tells whether a graph of passive elements has a solution."""
SOURCES, PASSIVE, TWO_PORTS, JUNCTIONS = ("Se", "Sf"), ("R", "C", "I"), ("TF", "GY", "Bond"), ("J0", "J1")


@dataclass(frozen=True)
class Node:
    """An element, a two-port or a junction, with what its half arrows point to."""

    kind: str
    value: float
    below: tuple[Node, ...] = ()


@st.composite
def trees(draw: st.DrawFn, depth: int = 4) -> Node:
    kinds = PASSIVE * 2 + SOURCES + (() if depth == 0 else TWO_PORTS * 2 + JUNCTIONS * 4)
    kind, value = draw(st.sampled_from(kinds)), draw(st.floats(0.5, 2.0))
    width = draw(st.integers(1, 3)) if kind in JUNCTIONS else 1 if kind in TWO_PORTS else 0
    return Node(kind, value, tuple(draw(trees(depth - 1)) for _ in range(width)))


@st.composite
def graphs(draw: st.DrawFn) -> tuple[Node, Node]:
    """A source, and a junction of two to three trees."""
    below = tuple(draw(trees(3)) for _ in range(draw(st.integers(2, 3))))
    return Node(draw(st.sampled_from(SOURCES)), 1.5), Node(draw(st.sampled_from(JUNCTIONS)), 1.0, below)


class Unsolvable(Exception):
    """Two ports determine one quantity."""


def relation(node: Node) -> tuple[float, float]:
    """(a, b) of ``a e + b f = c`` for effort and flow into a tree, by Laplace's transform and hand."""
    v, ports = node.value, [relation(child) for child in node.below]
    match node.kind:
        case "R":
            return 1.0, -v
        case "C":
            return v * S, -1.0
        case "I":
            return 1.0, -v * S
        case "Se":
            return 1.0, 0.0
        case "Sf":
            return 0.0, 1.0
        case "TF":
            return ports[0][0] / v, ports[0][1] * v
        case "GY":
            return ports[0][1] / v, ports[0][0] * v
        case "J0":  # of two ports that give the effort one is too many
            given = sum(b == 0.0 for _, b in ports)
            if given > 1:
                raise Unsolvable
            return (1.0, 0.0) if given else (sum(a / b for a, b in ports), 1.0)
        case "J1":
            given = sum(a == 0.0 for a, _ in ports)
            if given > 1:
                raise Unsolvable
            return (0.0, 1.0) if given else (1.0, sum(b / a for a, b in ports))
        case _:
            return ports[0]


def solvable(source: Node, root: Node) -> bool:
    try:
        (a, b), (c, d) = relation(source), relation(root)
    except Unsolvable:
        return False
    return a * d != b * c


@dataclass
class Built:
    """Parts and connections of a model."""

    parts: dict[str, Component] = field(default_factory=dict)
    connections: list[str] = field(default_factory=list)

    def add(self, node: Node, port: str | None = None) -> str:
        name = f"{node.kind.lower()}{len(self.parts)}"
        v = node.value
        self.parts[name] = {
            "R": bg.R(R=v), "C": bg.C(C=v), "I": bg.I(I=v), "Se": bg.Se(e=v), "Sf": bg.Sf(f=v), "TF": bg.TF(m=v),
            "GY": bg.GY(r=v), "Bond": bg.Bond(), "J0": bg.J0(n_out=max(len(node.below), 1)),
            "J1": bg.J1(n_out=max(len(node.below), 1)),
        }[node.kind]  # fmt: skip
        own = {**dict.fromkeys(JUNCTIONS, "inp[0]"), **dict.fromkeys(TWO_PORTS, "port_a")}.get(node.kind, "port")
        if port is not None:
            self.connections.append(f"{port} - {name}.{own}")
        for i, child in enumerate(node.below):
            self.add(child, f"{name}.out[{i}]" if node.kind in JUNCTIONS else f"{name}.port_b")
        return name

    def named(self, *kinds: type[Component]) -> list[str]:
        return [name for name, part in self.parts.items() if isinstance(part, kinds)]


def built(source: Node, root: Node) -> Built:
    graph = Built()
    graph.add(root, f"{graph.add(source)}.port")
    return graph


@seed(4)
@settings(max_examples=200, deadline=None, database=None, suppress_health_check=list(HealthCheck))
@given(graphs())
def test_compiles_or_names_the_sources(pair: tuple[Node, Node]) -> None:
    graph = built(*pair)
    try:
        ac.compile(assemble(*graph.connections, **graph.parts))
    except ac.StructureError as error:
        assert not solvable(*pair)
        assert any(f"{name}." in str(error) for name in graph.named(bg.Se, bg.Sf)), str(error)
    else:
        assert solvable(*pair)


@seed(5)
@settings(max_examples=20, deadline=None, database=None, suppress_health_check=list(HealthCheck))
@given(graphs().filter(lambda pair: solvable(*pair)))
def test_power_is_kept(pair: tuple[Node, Node]) -> None:
    graph = built(*pair)
    system = ac.compile(assemble(*graph.connections, **graph.parts))
    solution = system.simulate(t1=1.0, saveat=np.linspace(0.0, 1.0, 11), rtol=1e-8)

    def power(name: str) -> np.ndarray:
        return np.asarray(solution[f"{name}.port.e"]) * np.asarray(solution[f"{name}.port.f"])

    flows = np.array([power(name) for name in graph.named(bg.OnePort, bg.Se, bg.Sf)])
    scale = np.max(np.abs(flows)) + 1.0
    np.testing.assert_allclose(flows.sum(axis=0), 0.0, atol=1e-9 * scale)
    for name in graph.named(bg.R):  # a resistor never gives power
        assert power(name).min() >= -1e-9 * scale
