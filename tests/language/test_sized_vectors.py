"""Vectors whose number of elements is a structural parameter or a property of the class."""

from __future__ import annotations

import copy
import pickle
import re

import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Equations, Input, Output, Parameter, Variable, Vector, connect, der, start


class Total(Component):
    """The weighted sum of `n` signals; the fields stand before what they are sized by."""

    u: Vector = Vector(Input(), size="n")
    k: Vector = Vector(Parameter(1.0), size="n")
    n: int = 2
    y: Output = Output()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == sum((k * u for k, u in zip(self.k, self.u, strict=True)), start=0.0 * ac.time)


class Chain(Component):
    """Lags in a row, one for each of the time constants `T`."""

    T: tuple[float, ...] = (1.0, 2.0)
    x_start: Vector = Vector(Parameter(0.0), size="order")
    x: Vector = Vector(Variable(), x_start, size="order")
    u: Input = Input()

    @property
    def order(self) -> int:
        return len(self.T)

    def equations(self) -> Equations:
        yield from super().equations()
        before = self.u * 1.0
        for T, x in zip(self.T, self.x, strict=True):
            yield T * der(x) == before - x
            before = x

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.x == self.x_start


class Triple(Total):
    """Three signals."""

    n: int = 3


class Model(Component):
    """A chain of three on a sum of three; a pair that is joined as a whole; one element with one signal."""

    m: int = 3
    total: Total = Total(n=ac.structural("m"))
    pair: Total = Total(k=(2.0, 3.0))
    single: Total = Total(n=1)
    chain: Chain = Chain(T=(0.5, 1.0, 2.0), x=start((1.0, 2.0, 3.0)))

    def equations(self) -> Equations:
        yield self.total.u == vector_of_time(self.m)
        yield connect(self.total.y, self.chain.u, self.single.u)
        yield self.pair.u == vector_of_time(2)


def vector_of_time(n: int) -> Vector:
    return ac.vector(*((i + 1) * ac.time for i in range(n)))


def test_sizes_follow_structure() -> None:
    solution = ac.compile(Model()).simulate(1.0, saveat=[0.0, 1.0])
    assert np.asarray(solution["total.u"])[-1].tolist() == [1.0, 2.0, 3.0]
    assert float(solution["total.y"][-1]) == 6.0
    assert float(solution["pair.y"][-1]) == 8.0
    assert float(solution["single.y"][-1]) == 6.0
    assert solution["chain.x[3]"].shape == (2,) and solution["chain.x"].shape == (2, 3)
    assert np.asarray(solution["chain.x"])[0].tolist() == [0.0, 0.0, 0.0], "x_start holds, x is a guess"


def test_instances_are_of_the_class() -> None:
    assert isinstance(Total(n=5), Total) and type(Total(n=5)).__name__ == "Total"
    assert type(Total(n=5)) is type(Total(n=5)) and type(Total(n=2)) is Total
    assert len(Total(n=5).u) == 5 and len(Triple().u) == 3 and len(Total(n=0).u) == 0
    assert list(Total._declarations) == ["y", "u[1]", "u[2]", "k[1]", "k[2]"]
    assert list(type(Triple(n=1))._declarations) == ["y", "u[1]", "k[1]"]


def test_values_for_the_elements() -> None:
    assert ac.compile(Total(n=3, k=(1.0, 2.0, 3.0)), inputs=["u[1]", "u[2]", "u[3]"]).parameters == {
        "k[1]": 1.0, "k[2]": 2.0, "k[3]": 3.0
    }  # fmt: skip
    with pytest.raises(ac.DeclarationError, match="`k` has 3 elements, not 2"):
        Total(n=3, k=(1.0, 2.0))


def test_variants_have_other_sizes() -> None:
    wide = ac.modify(Model(), {"m": 4, "chain.T": (1.0,), "pair.n": 2})
    solution = ac.compile(wide).simulate(1.0, saveat=[1.0])
    assert float(solution["total.y"][-1]) == 10.0 and solution["chain.x"].shape == (1, 1)
    assert float(solution["pair.y"][-1]) == 8.0
    weighted = ac.modify(Model(chain=Chain(T=(1.0, 2.0))), {"chain.x_start": (5.0, 6.0), "total.k[3]": 0.0})
    solution = ac.compile(weighted).simulate(1.0, saveat=[0.0, 1.0])
    assert np.asarray(solution["chain.x"])[0].tolist() == [5.0, 6.0] and float(solution["total.y"][-1]) == 3.0
    other = ac.redeclare(Model(), {"single": Triple(n=1)})
    assert float(ac.compile(other).simulate(1.0, saveat=[1.0])["single.y"][-1]) == 6.0


class Bank(Component):
    """An array of sums of `n` signals each."""

    n: int = 3
    sums: Array[Total] = Array(Total(n=ac.structural("n")), 2)

    def equations(self) -> Equations:
        for i in range(2):
            yield self.sums[i].u == vector_of_time(self.n)


def test_arrays_of_components_with_such_vectors() -> None:
    solution = ac.compile(Bank(n=4)).simulate(1.0, saveat=[1.0])
    assert np.asarray(solution["sums.y"]).tolist() == [[10.0, 10.0]]


def test_components_of_any_size_are_copied_and_pickled() -> None:
    for made in (Total(n=2), Total(n=4, k=(1.0, 2.0, 3.0, 4.0)), Triple(n=1)):
        for again in (pickle.loads(pickle.dumps(made)), copy.copy(made)):
            assert type(again) is type(made) and repr(again) == repr(made)


def test_a_size_that_is_none() -> None:
    with pytest.raises(ac.DeclarationError, match=r"`Bad\.x`: the size 'm' .* name of a structural parameter"):

        class Bad(Component):
            n: int = 2
            x: Vector = Vector(Variable(), size="m")

    with pytest.raises(ac.DeclarationError, match=r"`Total\.u`: the size 'n' .* not -1"):
        Total(n=-1)
    with pytest.raises(ac.DeclarationError, match=re.escape("structural parameter `n` takes a plain int, not str")):
        Total(n="three")  # pyright: ignore[reportArgumentType]
    with pytest.raises(ac.DeclarationError, match="values of a vector with a structural size"):
        Vector(Parameter(), (1.0, 2.0), size="n")
    with pytest.raises(ac.DeclarationError, match=r"`Total\.u` has no elements"):
        ac.compile(Joined())


class Missed(Component):
    total: Total = Total(n=3)
    one: Total = Total(n=1)
    which: str = "total"

    def equations(self) -> Equations:
        yield getattr(self, self.which).u[self.total.n] == ac.time


@pytest.mark.parametrize(("which", "has"), [("total", r"3 elements, \[0\] to \[2\]"), ("one", "1 element")])
def test_an_element_that_is_not_there(which: str, has: str) -> None:
    text = rf"`{which}\.u` has {has}: there is no \[3\] \(.*test_sized_vectors\.py:\d+\)"
    with pytest.raises(ac.DeclarationError, match=text):
        ac.compile(Missed(which=which))
    with pytest.raises(IndexError, match="`u` has no elements"):
        Total(n=0).u[0]


class Joined(Component):
    none: Total = Total(n=0)
    source: Output = Output()

    def equations(self) -> Equations:
        yield self.source == 1.0
        yield connect(self.source, self.none.u)
