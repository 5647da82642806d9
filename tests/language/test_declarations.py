"""Fields of a class body: quantities, sub-components, structural parameters, inheritance, dependent parameters."""

from __future__ import annotations

from typing import ClassVar

import pytest

import acausal as ac
from acausal import Component, Equations, Input, Parameter, Variable, der, start
from acausal.language.flatten import flatten

from .parts import RC, Resistor, Source, TwoPin
from .support import equations, fields, fixed, parameters, starts


class Tank(Component):
    """A plain component with every kind of attribute."""

    n_tables: ClassVar[int] = 3
    A: Parameter = Parameter(2.0, unit="m2", min=0.0, max=10.0, doc="area")
    h0: Parameter = Parameter(1.5, unit="m")
    volume0: Parameter = Parameter(A * h0, unit="m3", doc="volume at the start")
    h: Variable = Variable(unit="m", start=h0, fixed=True, nominal=2.0, state_select="prefer", doc="level")
    q: Input = Input(unit="m3/s")

    def equations(self) -> Equations:
        yield self.A * der(self.h) == self.q


def test_fields_in_the_order_of_their_declaration() -> None:
    assert fields(Tank(A=1.0)) == (["h", "q"], ["A", "h0", "volume0"])
    variables, _ = fields(RC())
    assert variables[:6] == ["source.v", "source.i", "source.p.v", "source.p.i", "source.n.v", "source.n.i"]


def test_declarations_on_the_class_and_on_an_instance() -> None:
    assert isinstance(Tank.A, Parameter)
    assert (Tank.A.unit, Tank.A.doc, Tank.A.min, Tank.A.max, Tank.A.name) == ("m2", "area", 0.0, 10.0, "A")
    assert str(Tank().h) == "h"
    assert str(RC().resistor.p.v) == "resistor.p.v"
    assert Tank.n_tables == Tank().n_tables == 3


def test_attributes_of_variables() -> None:
    flat = flatten(Tank())
    assert (flat.nominal[0], flat.fixed[0], flat.select[0]) == (2.0, 1, 3)
    assert starts(Tank(h0=2.5)) == {"h": 2.5}
    assert starts(Tank(h=start(0.25))) == {"h": 0.25}
    assert fixed(Tank()) == ["h"]
    assert fixed(Tank(h=start(0.25, fixed=False))) == []
    assert fixed(Tank(h=start(0.25))) == ["h"]
    assert flatten(Tank(h=start(nominal=7.0, state_select="never"))).nominal[0] == 7.0
    assert starts(Tank(h=start(nominal=7.0))) == {"h": 1.5}
    assert starts(Tank(h=3.0)) == {"h": 3.0}


def test_dependent_parameters() -> None:
    assert parameters(Tank()) == {"A": 2.0, "h0": 1.5, "volume0": 3.0}
    assert parameters(Tank(A=4.0))["volume0"] == 6.0
    assert parameters(Tank(A=4.0, volume0=1.0))["volume0"] == 1.0
    system = ac.compile(Tank())
    assert system.parameters == {"A": 2.0, "h0": 1.5}
    assert system.parameter_vector({"h0": 3.0}).tolist()[:3] == [2.0, 3.0, 6.0]
    assert system.parameter_vector({"volume0": 7.0}).tolist()[:3] == [2.0, 1.5, 7.0]
    assert ac.compile(Tank(volume0=1.0)).parameters == {"A": 2.0, "h0": 1.5, "volume0": 1.0}


def test_a_chain_of_dependent_parameters_through_components() -> None:
    class Inner(Component):
        a: Parameter = Parameter(1.0)
        b: Parameter = Parameter(2 * a)

    class Outer(Component):
        x: Parameter = Parameter(5.0)
        y: Parameter = Parameter(x + 1)
        inner: Inner = Inner(a=y)

    class Model(Component):
        z: Parameter = Parameter(10.0)
        outer: Outer = Outer(x=3 * z)

    values = parameters(Model())
    assert (values["outer.x"], values["outer.y"], values["outer.inner.a"], values["outer.inner.b"]) == (30, 31, 31, 62)
    assert parameters(Model(outer=Outer(y=2.0)))["outer.inner.b"] == 4.0
    assert parameters(ac.modify(Model(), {"outer.inner.a": 7.0}))["outer.inner.b"] == 14.0


def test_inheritance_adds_and_overrides() -> None:
    class Heated(Tank):
        T: Variable = Variable(unit="K", start=300.0)
        A: Parameter = Parameter(5.0, unit="m2")

        def equations(self) -> Equations:
            yield from super().equations()
            yield der(self.T) == 0

    assert fields(Heated()) == (["h", "q", "T"], ["h0", "volume0", "A"])
    assert len(equations(Heated())) == 2
    assert parameters(Heated())["A"] == 5.0
    assert parameters(Tank())["A"] == 2.0


def test_a_subclass_can_replace_the_equations_of_a_component_without_equations() -> None:
    class Base(Component, partial=True):
        x: Variable = Variable()

    class Sub(Base):
        def equations(self) -> Equations:
            yield self.x == 1

    assert equations(Sub()) == ["x = 1"]


def test_multiple_inheritance_runs_each_base_once() -> None:
    class Top(Component, partial=True):
        x: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x == 1

    class Left(Top, partial=True):
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield from super().equations()
            yield self.y == 2

    class Right(Top, partial=True):
        z: Variable = Variable()

        def equations(self) -> Equations:
            yield from super().equations()
            yield self.z == 3

    class Bottom(Left, Right):
        def equations(self) -> Equations:
            yield from super().equations()

    assert sorted(equations(Bottom())) == ["x = 1", "y = 2", "z = 3"]


class Polynomial(Component):
    degree: int = 2
    odd: bool = False
    name_of_law: str = "plain"
    x: Variable = Variable()
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield self.x == ac.time
        terms = [self.x**k for k in range(self.degree + 1) if not self.odd or k % 2]
        yield self.y == sum(terms[1:], terms[0])
        if self.name_of_law == "strange":
            yield self.x == 0


def test_structural_parameters_decide_the_equations() -> None:
    assert equations(Polynomial())[1] == "y = x + x**2 + 1"
    assert equations(Polynomial(degree=3, odd=True))[1] == "y = x + x**3"
    assert len(equations(Polynomial(name_of_law="strange"))) == 3
    assert Polynomial(degree=3).degree == 3
    assert fields(Polynomial()) == (["x", "y"], [])


@pytest.mark.parametrize("wrong", [{"degree": 2.5}, {"degree": True}, {"odd": 1}, {"name_of_law": 3}])
def test_structural_parameters_have_a_type(wrong: dict[str, object]) -> None:
    with pytest.raises(ac.DeclarationError, match="structural parameter") as error:
        Polynomial(**wrong)
    assert __file__ in str(error.value)


def test_instances_are_templates() -> None:
    resistor = Resistor(R=3.0)
    model = RC(resistor=resistor, source=Source(V=2.0))
    assert parameters(model)["resistor.R"] == 3.0
    assert repr(model) == "RC(resistor=Resistor(R=3.0), source=Source(V=2.0))"
    two = RC(resistor=resistor)
    assert parameters(two)["source.V"] == 1.0


def test_fields_cannot_be_assigned() -> None:
    model = RC()
    for assign, words in (
        (lambda: setattr(model, "resistor", Resistor()), "redeclare"),
        (lambda: setattr(model.resistor, "R", 2.0), r"Resistor\(R=\.\.\.\)"),
        (lambda: setattr(Polynomial(), "degree", 4), "construction"),
        (lambda: setattr(model, "resitor", Resistor()), "Did you mean `resistor`"),
    ):
        with pytest.raises(ac.DeclarationError, match=words):
            assign()


def test_the_time_derivative_of_expressions() -> None:
    class Moving(Component):
        r: Parameter = Parameter(2.0)
        phi: Variable = Variable()
        x: Variable = Variable()
        v: Variable = Variable()
        a: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x == self.r * ac.sin(self.phi)
            yield self.v == der(self.x * self.r)
            yield self.a == der(der(self.phi))
            yield der(self.phi**2 + ac.time) == 1

    lines = equations(Moving())
    assert "v = r*der(x)" in lines
    assert "a = der(phi, 2)" in lines
    assert "2*phi*der(phi) = 0" in lines or "2*phi*der(phi) + 1 = 1" in lines


def test_constants_and_parameters_have_no_derivative() -> None:
    class Still(Component):
        p: Parameter = Parameter(2.0)
        x: Variable = Variable()

        def equations(self) -> Equations:
            yield self.x == der(self.p * 3.0 + self.p**2) + 1

    assert equations(Still()) == ["x = 1"]


def test_partial_annotations_are_constraints() -> None:
    assert isinstance(RC(source=Resistor()).source, TwoPin)
    with pytest.raises(ac.DeclarationError, match="declared as `TwoPin`"):
        RC(source=Tank())  # type: ignore[arg-type]
