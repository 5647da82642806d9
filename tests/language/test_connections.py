"""Connection sets: which variables become equal, and which flows sum to zero with which sign."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Component, Connector, Equations, Flow, Input, Output, Potential, Variable, connect
from acausal.language.flatten import flatten

from .parts import RC, Capacitor, Gain, Ground, Pin, Resistor, Source
from .support import equations


def flow_sums(model: Component) -> set[frozenset[str]]:
    """Every equation of flows as the set of its signed terms, the first positive."""
    flat = flatten(model)
    found: set[frozenset[str]] = set()
    for family in flat.families:
        if not any(flat.sources[int(s)].origin.kind == "connect" for s in family.source):
            continue
        for k in range(family.size):
            found.add(frozenset(signed(flat.equation_text(family, k))))
    for a, b, sign in zip(flat.alias_a, flat.alias_b, flat.alias_sign, strict=True):
        left, right = flat.name(int(a)), flat.name(int(b))
        if left.endswith(".i"):
            found.add(frozenset((f"+{left}", f"{'-' if sign > 0 else '+'}{right}")))
    return found


def signed(text: str) -> list[str]:
    lhs, rhs = text.split(" = ")
    terms = []
    for side, flip in ((lhs, 1), (rhs, -1)):
        for term in side.replace("- ", "-").replace("+ ", "+").split():
            if term != "0":
                sign = flip * (-1 if term.startswith("-") else 1)
                terms.append(("+" if sign > 0 else "-") + term.lstrip("+-"))
    return terms


def test_two_inside_connectors() -> None:
    class Model(Component):
        a: Resistor = Resistor()
        b: Resistor = Resistor()

        def equations(self) -> Equations:
            yield connect(self.a.n, self.b.p)

    lines = equations(Model())
    assert any(line in lines for line in ("a.n.v = b.p.v", "b.p.v = a.n.v"))
    assert any(line in lines for line in ("a.n.i = -b.p.i", "b.p.i = -a.n.i"))
    assert lines[-2:] == ["a.p.i = 0", "b.n.i = 0"]


def test_a_star_of_three() -> None:
    class Model(Component):
        a: Resistor = Resistor()
        b: Resistor = Resistor()
        c: Resistor = Resistor()

        def equations(self) -> Equations:
            yield connect(self.a.p, self.b.p)
            yield connect(self.c.p, self.b.p)

    assert frozenset({"+a.p.i", "+b.p.i", "+c.p.i"}) in flow_sums(Model())


def test_one_statement_with_many_ends_is_the_same_as_many() -> None:
    class One(Component):
        a: Resistor = Resistor()
        b: Resistor = Resistor()
        c: Resistor = Resistor()

        def equations(self) -> Equations:
            yield connect(self.a.p, self.b.p, self.c.p)

    class Many(One):
        def equations(self) -> Equations:
            yield from ac.Component.equations(self)
            yield connect(self.a.p, self.b.p)
            yield connect(self.b.p, self.c.p)
            yield connect(self.c.p, self.a.p)

    with pytest.raises(ac.DeclarationError, match=r"super\(\)\.equations\(\)"):
        flatten(Many())

    class Ring(Component):
        a: Resistor = Resistor()
        b: Resistor = Resistor()
        c: Resistor = Resistor()

        def equations(self) -> Equations:
            yield connect(self.a.p, self.b.p)
            yield connect(self.b.p, self.c.p)
            yield connect(self.c.p, self.a.p)

    assert flow_sums(One()) == flow_sums(Ring())
    assert sorted(equations(One())) == sorted(equations(Ring()))


class Divider(Component):
    """Two resistors in a box with three pins of its own."""

    top: Pin = Pin()
    middle: Pin = Pin()
    bottom: Pin = Pin()
    upper: Resistor = Resistor()
    lower: Resistor = Resistor()

    def equations(self) -> Equations:
        yield connect(self.top, self.upper.p)
        yield connect(self.upper.n, self.lower.p, self.middle)
        yield connect(self.lower.n, self.bottom)


class Board(Component):
    divider: Divider = Divider()
    source: Source = Source()
    ground: Ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.divider.top)
        yield connect(self.source.n, self.divider.bottom, self.ground.p)


def test_outside_connectors_count_negative() -> None:
    sums = flow_sums(Board())
    assert frozenset({"+divider.upper.n.i", "+divider.lower.p.i", "-divider.middle.i"}) in sums
    assert frozenset({"+divider.top.i", "-divider.upper.p.i"}) in sums or (
        frozenset({"+divider.upper.p.i", "-divider.top.i"}) in sums
    )
    assert frozenset({"+source.n.i", "+divider.bottom.i", "+ground.p.i"}) in sums
    assert "divider.middle.i = 0" in equations(Board())


def test_currents_of_the_divider() -> None:
    system = ac.compile(Board(divider=Divider(upper=Resistor(R=3.0)), source=Source(V=8.0)))
    assert system.lowered.n_x == 0
    import jax.numpy as jnp

    values = system.lowered.observe(0.0, jnp.zeros(0), jnp.zeros(0), system.parameter_vector())
    names = ("divider.top.i", "divider.middle.v", "source.i", "ground.p.i")
    at = {n: float(values[int(system.index_of(n))]) for n in names}
    assert at == pytest.approx({"divider.top.i": 2.0, "divider.middle.v": 2.0, "source.i": -2.0, "ground.p.i": 0.0})


def test_a_connector_passed_through_a_component() -> None:
    class Through(Component):
        a: Pin = Pin()
        b: Pin = Pin()

        def equations(self) -> Equations:
            yield connect(self.a, self.b)

    class Model(Component):
        source: Source = Source()
        wire: Through = Through()
        resistor: Resistor = Resistor()
        ground: Ground = Ground()

        def equations(self) -> Equations:
            yield connect(self.source.p, self.wire.a)
            yield connect(self.wire.b, self.resistor.p)
            yield connect(self.resistor.n, self.source.n, self.ground.p)

    sums = flow_sums(Model())
    assert any(s == {"+wire.a.i", "+wire.b.i"} for s in sums)
    assert any(s == {"+source.p.i", "+wire.a.i"} for s in sums)


def test_unconnected_flows_are_zero() -> None:
    class Model(Component):
        capacitor: Capacitor = Capacitor()

    assert equations(Model())[-2:] == ["capacitor.p.i = 0", "capacitor.n.i = 0"]


def test_the_models_own_connectors_are_unconnected_from_outside() -> None:
    lines = equations(Divider())
    assert {"top.i = 0", "middle.i = 0", "bottom.i = 0"} <= set(lines)


class Frame(Connector):
    """A connector made of connectors."""

    electric: Pin = Pin()
    T: Potential = Potential(unit="K")
    Q: Flow = Flow(unit="W")


class Device(Component):
    frame: Frame = Frame()

    def equations(self) -> Equations:
        yield self.frame.electric.i == 0
        yield self.frame.Q == 0


def test_connectors_inside_connectors() -> None:
    class Model(Component):
        a: Device = Device()
        b: Device = Device()

        def equations(self) -> Equations:
            yield connect(self.a.frame, self.b.frame)

    lines = equations(Model())
    for left, right in (("a.frame.T", "b.frame.T"), ("a.frame.electric.v", "b.frame.electric.v")):
        assert f"{left} = {right}" in lines or f"{right} = {left}" in lines
    for left, right in (("a.frame.Q", "b.frame.Q"), ("a.frame.electric.i", "b.frame.electric.i")):
        assert f"{left} = -{right}" in lines or f"{right} = -{left}" in lines


def test_signals() -> None:
    class Chain(Component):
        u: Input = Input()
        first: Gain = Gain(k=2.0)
        second: Gain = Gain(k=3.0)
        y: Output = Output()

        def equations(self) -> Equations:
            yield connect(self.u, self.first.u)
            yield connect(self.first.y, self.second.u)
            yield self.y == self.second.y

    lines = equations(Chain())
    assert {"u = first.u", "first.y = second.u", "y = second.y"} <= set(lines)
    system = ac.compile(Chain(), inputs=("u",), outputs=("y",))
    assert system.input_names == ("u",)


def test_a_fan_out_of_one_connector_to_an_array() -> None:
    class Model(Component):
        source: Source = Source()
        loads: ac.Array[Resistor] = ac.Array(Resistor(), 4)

        def equations(self) -> Equations:
            yield connect(self.source.p, self.loads.p)

    assert frozenset({"+source.p.i", *(f"+loads[{i}].p.i" for i in range(4))}) in flow_sums(Model())


class Plug(Connector):
    v: Potential = Potential(unit="V")
    i: Flow = Flow(unit="A")


class Flange(Connector):
    s: Potential = Potential(unit="m")
    f: Flow = Flow(unit="N")


class Box(Component):
    plug: Plug = Plug()
    flange: Flange = Flange()
    x: Variable = Variable()


def test_connectors_of_two_classes_with_the_same_fields_fit() -> None:
    class Model(Component):
        box: Box = Box()
        resistor: Resistor = Resistor()

        def equations(self) -> Equations:
            yield connect(self.box.plug, self.resistor.p)

    assert any("box.plug.v" in line and "resistor.p.v" in line for line in equations(Model()))


def test_what_cannot_be_connected() -> None:
    box, circuit = Box(), RC()
    for ends, words in (
        ((box.plug, box.flange), ["`Plug`", "`Flange`", "unlike"]),
        ((box.plug, box.x), ["a signal", "unlike"]),
        ((circuit.resistor, circuit.source.p), ["component `resistor`", "one of its ports"]),
        ((box.x + 1, box.x), ["x + 1"]),
        ((box.plug, 3.0), ["3.0"]),
    ):
        with pytest.raises(ac.ConnectError) as error:
            connect(*ends)  # type: ignore[arg-type]
        for word in (*words, __file__):
            assert word in str(error.value), str(error.value)
