"""Component arrays and lists of components."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal import (
    Array,
    Component,
    DeclarationError,
    Equations,
    Matrix,
    Parameter,
    Variable,
    Vector,
    connect,
    der,
    start,
)
from acausal.language.flatten import flatten

from .parts import RC, Capacitor, Cell, Conductor, Diode, Ground, Pin, Resistor, Source, TwoPin
from .support import equations, fields, fixed, parameters, starts


class Ladder(Component):
    """RC ladder with `n` cells."""

    n: int = 3
    source: Source = Source()
    ground: Ground = Ground()
    cells: Array[Cell] = Array(Cell(), "n")

    def equations(self) -> Equations:
        yield connect(self.source.p, self.cells[0].p)
        yield connect(self.cells[:-1].n, self.cells[1:].p)
        yield connect(self.source.n, self.ground.p, self.cells.g)


def test_names_and_size() -> None:
    variables, names = fields(Ladder())
    assert [n for n in variables if n.endswith("capacitor.v")] == [f"cells[{i}].capacitor.v" for i in range(3)]
    assert len([n for n in names if n.startswith("cells")]) == 6
    assert len(fields(Ladder(n=10))[0]) - len(fields(Ladder(n=9))[0]) == 18
    assert len(Ladder(n=5).cells) == 5


def test_the_ladder_computes_what_a_chain_written_by_hand_computes() -> None:
    n, R, C = 4, 2.0, 0.01
    system = ac.compile(Ladder(n=n))
    assert system.states == tuple(f"cells[{i}].capacitor.v" for i in range(n))
    x = np.array([0.4, 0.3, 0.2, 0.1])
    left, right = np.concatenate([[1.0], x[:-1]]), np.concatenate([x[1:], [x[-1]]])
    expected = ((left - x) - (x - right)) / (R * C)
    assert np.allclose(system.vector_field(0.0, x), expected)


def test_slices_select_elements() -> None:
    class Chain(Component):
        cells: Array[Capacitor] = Array(Capacitor(), 4)
        x: Variable = Variable()

        def equations(self) -> Equations:
            yield self.cells[1:3].v == 5
            yield self.cells[::3].v == self.x
            yield self.x == self.cells[-1].i + self.cells[0].i

    lines = equations(Chain())
    assert "cells[1].v = 5" in lines
    assert "cells[2].v = 5" in lines
    assert "cells[0].v = x" in lines
    assert "cells[3].v = x" in lines
    assert "x = cells[3].i + cells[0].i" in lines
    assert not any("cells[3].v = 5" in line or "cells[0].v = 5" in line for line in lines)


def test_equations_broadcast_over_slices() -> None:
    class Wave(Component):
        n: int = 5
        c: Parameter = Parameter(2.0)
        cells: Array[Capacitor] = Array(Capacitor(), "n")

        def equations(self) -> Equations:
            yield der(self.cells[1:].v) == self.c * (self.cells[:-1].v - self.cells[1:].v)
            yield self.cells.i == 0

    lines = equations(Wave())
    assert "der(cells[1].v) = c*(cells[0].v - cells[1].v)" in lines
    assert "der(cells[4].v) = c*(cells[3].v - cells[4].v)" in lines
    assert [f"cells[{i}].i = 0" in lines for i in range(5)] == [True] * 5


def test_arrays_in_arrays() -> None:
    class Row(Component):
        m: int = 2
        cells: Array[Capacitor] = Array(Capacitor(), "m")

    class Grid(Component):
        rows: Array[Row] = Array(Row(m=3), 2)

        def equations(self) -> Equations:
            yield self.rows.cells.v == 1
            yield connect(self.rows[0].cells.p, self.rows[1].cells.n)

    lines = equations(Grid())
    assert "rows[1].cells[2].v = 1" in lines
    assert len([line for line in lines if line.endswith("].v = 1")]) == 6
    ends = ("rows[0].cells[2].p.v", "rows[1].cells[2].n.v")
    assert f"{ends[0]} = {ends[1]}" in lines or f"{ends[1]} = {ends[0]}" in lines


@pytest.mark.parametrize("R", [[1.0, 2.0, 3.0], (1.0, 2.0, 3.0), np.array([1.0, 2.0, 3.0])])
def test_values_for_each_element(R: object) -> None:
    class Bank(Component):
        resistors: Array[Resistor] = Array(Resistor(), 3, R=R)

    assert list(parameters(Bank()).values()) == [1.0, 2.0, 3.0]


def test_values_for_each_element_from_outside_and_nested() -> None:
    class Bank(Component):
        n: int = 3
        v0: Parameter = Parameter(5.0)
        cells: Array[Cell] = Array(Cell(capacitor=Capacitor(v=start(v0))), "n")

    model = Bank(cells=Array(Cell(resistor=Resistor(R=[1.0, 2.0, 3.0])), 3))  # type: ignore[arg-type]
    values = parameters(model)
    assert [values[f"cells[{i}].resistor.R"] for i in range(3)] == [1.0, 2.0, 3.0]
    assert [values[f"cells[{i}].capacitor.C"] for i in range(3)] == [0.01] * 3
    assert list(starts(model).values()) == [5.0] * 3

    class Started(Component):
        capacitors: Array[Capacitor] = Array(Capacitor(), 2, v=start([1.0, 2.0], fixed=True))  # type: ignore[arg-type]

    assert starts(Started()) == {"capacitors[0].v": 1.0, "capacitors[1].v": 2.0}
    assert fixed(Started()) == ["capacitors[0].v", "capacitors[1].v"]


def test_values_for_each_element_must_be_as_many_as_elements() -> None:
    class Bank(Component):
        resistors: Array[Resistor] = Array(Resistor(), 3, R=[1.0, 2.0])

    with pytest.raises(ac.DeclarationError, match=r"`resistors.R` has 3 elements but was given 2 values"):
        flatten(Bank())
    with pytest.raises(ac.DeclarationError, match="one parameter but was given 2 values"):
        flatten(RC(resistor=Resistor(R=[1.0, 2.0])))  # type: ignore[arg-type]


def test_an_array_of_a_replacement() -> None:
    model = Ladder(cells=Cell(resistor=Conductor(R=4.0)))  # type: ignore[arg-type]
    assert [v for k, v in parameters(model).items() if k.endswith(".R")] == [4.0] * 3
    again = Ladder(n=2, cells=Array(Cell(), "n"))
    assert len([k for k in parameters(again) if k.endswith(".R")]) == 2


def test_values_of_elements_carry_over_to_a_replacement_that_has_the_field() -> None:
    class Bank(Component):
        loads: Array[TwoPin] = Array(Resistor(), 2, R=[1.0, 2.0])

    replaced = ac.redeclare(Bank(), {"loads": Array(Conductor(), 2)})  # type: ignore[dict-item]
    assert [v for k, v in parameters(replaced).items() if k.endswith(".R")] == [1.0, 2.0]
    assert list(parameters(Bank(loads=Diode())).values()) == [1e-9, 1e-9]  # type: ignore[arg-type]


def test_parameters_of_the_owner_reach_every_element() -> None:
    class Bank(Component):
        R0: Parameter = Parameter(3.0)
        resistors: Array[Resistor] = Array(Resistor(R=2 * R0), 3)

    assert [v for k, v in parameters(Bank(R0=5.0)).items() if k.endswith(".R")] == [10.0] * 3


class Series(Component):
    """Any two-pins in series."""

    parts: list[TwoPin] = [Resistor(), Resistor()]
    p: Pin = Pin()
    n: Pin = Pin()

    def equations(self) -> Equations:
        yield connect(self.p, self.parts[0].p)
        for a, b in zip(self.parts[:-1], self.parts[1:], strict=True):
            yield connect(a.n, b.p)
        yield connect(self.parts[-1].n, self.n)


def test_lists_of_components() -> None:
    three = Series(parts=[Resistor(R=1.0), Resistor(R=2.0), Resistor(R=3.0)])
    assert list(parameters(three).values()) == [1.0, 2.0, 3.0]
    mixed = Series(parts=[Resistor(), Diode(), Capacitor()])
    assert fields(mixed)[1] == ["parts[0].R", "parts[1].Is", "parts[2].C"]
    lines = equations(mixed)
    assert "parts[1].i = parts[1].Is*(exp(parts[1].v/0.025) - 1)" in lines
    assert any(line in lines for line in ("parts[1].p.v = parts[0].n.v", "parts[0].n.v = parts[1].p.v"))


def test_an_index_outside() -> None:
    class Bad(Component):
        cells: Array[Capacitor] = Array(Capacitor(), 2)

        def equations(self) -> Equations:
            yield self.cells[2].v == 0

    with pytest.raises(ac.DeclarationError, match=r"index 2 of component array `cells` is outside 0\.\.1"):
        flatten(Bad())


def test_slices_that_do_not_fit() -> None:
    class Bad(Component):
        cells: Array[Capacitor] = Array(Capacitor(), 4)

        def equations(self) -> Equations:
            yield self.cells[1:].v == self.cells[:-2].v

    with pytest.raises(ac.DeclarationError, match="do not fit") as error:
        flatten(Bad())
    assert __file__ in str(error.value)

    class Unfit(Component):
        cells: Array[Capacitor] = Array(Capacitor(), 4)

        def equations(self) -> Equations:
            yield connect(self.cells[1:].p, self.cells[:-2].n)

    with pytest.raises(ac.ConnectError, match="slices of 3 and 2 elements do not fit") as error:
        flatten(Unfit())
    assert __file__ in str(error.value)


def test_a_wrong_count() -> None:
    class Bad(Component):
        n: int = 3
        cells: Array[Capacitor] = Array(Capacitor(), "m")

    with pytest.raises(ac.DeclarationError, match="count 'm'"):
        flatten(Bad())


def test_no_elements() -> None:
    class Empty(Component):
        n: int = 0
        x: Variable = Variable()
        cells: Array[Capacitor] = Array(Capacitor(), "n")

        def equations(self) -> Equations:
            yield self.x == 1
            yield self.cells.v == 1

    assert equations(Empty()) == ["x = 1"]


def test_a_hundred_thousand_components_are_one_family_per_equation() -> None:
    small, large = flatten(Ladder(n=10)), flatten(Ladder(n=33_334))
    assert large.n_var == 18 * 33_334 + 8
    assert len(large.families) == len(small.families)
    assert len(large.sources) == len(small.sources)
    assert large.name(8 + 18 * 33_333) == "cells[33333].p.v"
    ids, _ = large.names.find("cells[:].capacitor.v")
    assert ids.shape == (33_334,)


class Beam(Component):
    """A part with a vector and a matrix."""

    r: Vector = Vector(Parameter(), (1.0, 0.0, 0.0))
    T: Matrix = Matrix(Parameter(), ((1.0, 0.0), (0.0, 1.0)))
    x: Vector = Vector(Variable(), size=3)

    def equations(self) -> Equations:
        yield der(self.x) == self.r * self.T[1, 0]


def test_vectors_that_vary_along_an_array() -> None:
    class Frame(Component):
        beams: Array[Beam] = Array(
            Beam(), 2, r=np.array([(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)]), T=[((1, 2), (3, 4)), ((5, 6), (7, 8))],
            x=start([(0.1, 0.2, 0.3), (0.4, 0.5, 0.6)], fixed=True),  # type: ignore[arg-type]
        )  # fmt: skip
        same: Array[Beam] = Array(Beam(), 2, r=(0.0, 0.0, 2.0), x=start((7.0, 8.0, 9.0), fixed=True))

    solution = ac.compile(Frame()).simulate(1.0, saveat=2)
    assert_allclose(solution["beams[0].x"], [[0.1, 0.2, 0.3], [3.1, 6.2, 9.3]])
    assert_allclose(solution["beams[1].x"], [[0.4, 0.5, 0.6], [28.4, 35.5, 42.6]])
    assert_allclose(solution["same[1].x"][0], [7.0, 8.0, 9.0])
    assert_allclose(solution["same[1].x"][1], [7.0, 8.0, 9.0])  # T[2,1] is 0 by default


def test_vectors_along_an_array_have_the_length_of_the_field() -> None:
    with pytest.raises(DeclarationError, match=r"Array\(Beam\(\), \.\.\., r=\.\.\.\): `r` has 3 elements, not 2"):
        Array(Beam(), 2, r=[(1.0, 2.0), (3.0, 4.0)])

    class Short(Component):
        beams: Array[Beam] = Array(Beam(), 3, r=[(1.0, 2.0, 3.0), (4.0, 5.0, 6.0)])

    with pytest.raises(DeclarationError, match=r"beams\.r\[1\]"):
        ac.compile(Short())


class Meter(Component):
    u: Variable = Variable(unit="V")


class InSeries(Component):
    """Parts in a row between the poles of a source, with a meter for each."""

    source: Source = Source()
    ground: Ground = Ground()
    parts: Array[TwoPin] = Array(Resistor(), 3)
    meters: Array[Meter] = Array(Meter(), 3)

    def equations(self) -> Equations:
        yield connect(self.source.p, self.parts[0].p)
        yield connect(self.parts[:-1].n, self.parts[1:].p)
        yield connect(self.parts[-1].n, self.source.n, self.ground.p)
        yield self.meters[:].u == self.parts[:].v


def test_a_slice_of_a_list_stands_for_components_of_different_classes() -> None:
    """A list takes the place of the array of a class that is written with slices."""
    parts: Any = [Resistor(R=2.0), Capacitor(C=0.5, v=start(0.0, fixed=True)), Conductor(R=2.0)]
    solution = ac.compile(InSeries(parts=parts)).simulate(2.0, saveat=5, rtol=1e-9)
    decay = np.exp(-np.asarray(solution.t) / 2.0)
    for k, expected in enumerate((decay / 2, 1.0 - decay, decay / 2)):
        assert_allclose(solution[f"meters[{k}].u"], expected, atol=1e-8)


def test_a_slice_of_what_only_some_components_have() -> None:
    class Bad(InSeries):
        def equations(self) -> Equations:
            yield from super().equations()
            yield self.parts[:].R == 1  # HERE

    message = r"`parts\[0:3\]\.R` is not in all elements: .*`Capacitor` has no `R`.*test_arrays.py:\d+ \(Bad\)"
    parts: Any = [Resistor(), Capacitor(), Resistor()]
    with pytest.raises(DeclarationError, match=message):
        ac.compile(Bad(parts=parts))


def test_several_components_for_one() -> None:
    class Two(Component):
        part: Resistor = Resistor()

    for several in ([Resistor(), Resistor()], Array(Resistor(), 2)):
        with pytest.raises(DeclarationError, match=r"`Two.part` is one `Resistor`.*\[Two\(part=...\), .*test_arrays"):
            Two(part=several)  # pyright: ignore[reportArgumentType]
