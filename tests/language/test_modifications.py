"""Modifications and redeclarations: by keyword, by path, carried over to replacements; originals stay as they are."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, connect, start

from .parts import RC, Capacitor, Cell, Conductor, Diode, Ground, Resistor, Source, TwoPin
from .support import equations, fixed, parameters, starts


class Board(Component):
    """A circuit that gives its parts its own parameters."""

    R0: Parameter = Parameter(7.0, unit="ohm")
    v0: Parameter = Parameter(0.3, unit="V")
    circuit: RC = RC(resistor=Resistor(R=R0), capacitor=Capacitor(v=start(v0, fixed=True)))
    load: TwoPin = Resistor(R=2 * R0)
    ground: Ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.load.p, self.load.n, self.ground.p)


def test_nested_modification_keeps_what_it_does_not_mention() -> None:
    class Shelf(Component):
        board: Board = Board(R0=3.0)

    model = Shelf(board=Board(v0=0.1))
    values = parameters(model)
    assert values["board.R0"] == 3.0
    assert values["board.circuit.resistor.R"] == 3.0
    assert values["board.load.R"] == 6.0
    assert starts(model) == {"board.circuit.capacitor.v": 0.1}
    assert fixed(model) == ["board.circuit.capacitor.v"]


def test_modify_by_path_leaves_the_original() -> None:
    model = Board()
    before = parameters(model), starts(model), repr(model)
    changed = ac.modify(
        model, {"circuit.resistor.R": 1.0, "circuit.capacitor.C": 4.0, "R0": 5.0, "circuit.capacitor.v": start(0.9)}
    )
    assert (parameters(model), starts(model), repr(model)) == before
    values = parameters(changed)
    assert (values["circuit.resistor.R"], values["circuit.capacitor.C"], values["load.R"]) == (1.0, 4.0, 10.0)
    assert starts(changed) == {"circuit.capacitor.v": 0.9}


def test_modify_a_subcomponent_with_a_component() -> None:
    changed = ac.modify(Board(), {"circuit.resistor": Resistor(R=4.0)})
    assert parameters(changed)["circuit.resistor.R"] == 4.0
    assert parameters(ac.modify(changed, {"circuit.source": Source(V=9.0)}))["circuit.resistor.R"] == 4.0


def test_redeclare_carries_modifications_over() -> None:
    model = Board()
    changed = ac.redeclare(model, {"load": Conductor(k=2.0)})
    assert parameters(changed)["load.R"] == 14.0  # R = 2*R0 is written in the declaration, and Conductor has an R
    assert parameters(changed)["load.k"] == 2.0
    assert parameters(ac.redeclare(model, {"load": Conductor(R=1.0)}))["load.R"] == 1.0
    assert "load.R" not in parameters(ac.redeclare(model, {"load": Diode()}))
    assert parameters(ac.redeclare(model, {"circuit.resistor": Conductor()}))["circuit.resistor.R"] == 7.0
    assert equations(model) == equations(Board())


def test_redeclaring_twice_and_nested() -> None:
    model = ac.redeclare(Board(), {"circuit.resistor": Diode(Is=2e-9), "load": Conductor()})
    again = ac.redeclare(model, {"circuit.resistor": Resistor()})
    assert parameters(again)["circuit.resistor.R"] == 7.0
    assert "load.k" in parameters(again)


def test_keyword_construction_is_the_same_as_redeclare() -> None:
    by_keyword = Board(load=Conductor(k=3.0))
    by_path = ac.redeclare(Board(), {"load": Conductor(k=3.0)})
    assert parameters(by_keyword) == parameters(by_path)
    assert equations(by_keyword) == equations(by_path)


def test_a_replacement_in_a_subclass() -> None:
    class DiodeBoard(Board):
        load: TwoPin = Diode(Is=3e-9)

    assert parameters(DiodeBoard())["load.Is"] == 3e-9


def test_inner_components_can_be_modified_by_path() -> None:
    class World(Component):
        g: Parameter = Parameter(9.81, unit="m/s2")

    class Body(Component):
        world: World = ac.outer(World())
        w: Variable = Variable(unit="m/s2")

        def equations(self) -> Equations:
            yield self.w == self.world.g

    class Model(Component):
        world: World = ac.inner(World())
        body: Body = Body()

    model = Model()
    assert parameters(ac.modify(model, {"world.g": 1.62})) == {"world.g": 1.62}
    assert parameters(Model(world=World(g=3.7))) == {"world.g": 3.7}
    assert parameters(ac.redeclare(model, {"world": World(g=3.7)})) == {"world.g": 3.7}
    assert equations(ac.modify(model, {"world.g": 1.62})) == ["body.w = world.g"]
    assert parameters(model) == {"world.g": 9.81}


def test_arrays_are_modified_as_a_whole_by_path() -> None:
    class Ladder(Component):
        n: int = 3
        cells: ac.Array[Cell] = ac.Array(Cell(), "n")

    model = Ladder()
    changed = ac.modify(model, {"cells.resistor.R": 5.0, "n": 2})
    values = parameters(changed)
    assert [values[f"cells[{i}].resistor.R"] for i in range(2)] == [5.0, 5.0]
    assert values["cells[1].capacitor.C"] == 0.01
    assert len([k for k in parameters(model) if k.endswith("R")]) == 3


def test_a_start_given_from_the_scope_where_it_is_written() -> None:
    class Pair(Component):
        v0: Parameter = Parameter(2.0)
        a: RC = RC(capacitor=Capacitor(v=start(v0, fixed=True)))
        b: RC = RC(capacitor=Capacitor(v=start(2 * v0 + 1)))

    assert starts(Pair(v0=3.0)) == {"a.capacitor.v": 3.0, "b.capacitor.v": 7.0}
    assert fixed(Pair()) == ["a.capacitor.v", "b.capacitor.v"]  # RC itself fixes the voltage; the second only moves it


@pytest.mark.parametrize(
    ("path", "words"),
    [
        ("circiut.resistor.R", ["`circiut`", "Did you mean `circuit`"]),
        ("circuit.resistor.r", ["`Resistor` has no field `r`", "`R`"]),
        ("circuit.resistor.R.x", ["no sub-component `R`"]),
        ("circuit[0].R", ["leave the index out", "`circuit`"]),
    ],
)
def test_wrong_paths(path: str, words: list[str]) -> None:
    with pytest.raises(ac.DeclarationError) as error:
        ac.modify(Board(), {path: 1.0})
    for word in (*words, __file__):
        assert word in str(error.value), str(error.value)


def test_redeclare_takes_components() -> None:
    with pytest.raises(ac.DeclarationError, match="`load` needs a component"):
        ac.redeclare(Board(), {"load": 3.0})  # type: ignore[dict-item]
    with pytest.raises(ac.DeclarationError, match="declared as `TwoPin`"):
        ac.redeclare(Board(), {"load": Ground()})


class Layered(ac.Component):
    """A part whose equations depend on a structural parameter."""

    double: bool = False
    x: ac.Variable = ac.Variable()

    def equations(self) -> ac.Equations:
        yield self.x == (2.0 if self.double else 1.0)


class Owner(ac.Component):
    """Passes its structural parameter on."""

    twice: bool = False
    part: Layered = Layered(double=ac.structural("twice"))


def test_structural_parameters_are_passed_on() -> None:
    assert ac.compile(Owner()).simulate(t1=1.0)["part.x"][-1] == 1.0
    assert ac.compile(Owner(twice=True)).simulate(t1=1.0)["part.x"][-1] == 2.0
    assert ac.compile(Owner(twice=True, part=Layered(double=False))).simulate(t1=1.0)["part.x"][-1] == 1.0


class Misnamed(ac.Component):
    twice: bool = False
    part: Layered = Layered(double=ac.structural("twise"))


def test_a_misnamed_structural_parameter_is_named() -> None:
    with pytest.raises(ac.DeclarationError, match=r"structural\('twise'\) is no structural parameter.*`twice`"):
        ac.compile(Misnamed())
