"""Values that the equations leave undetermined, or that leave a function's domain: named, never handed over."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der
from acausal.errors import InitializationError, SimulationError, StructureError

ENGINES = pytest.mark.parametrize("engine", ["native", "diffrax"])


class Decay(Component):
    """x = exp(-t), and a logarithm that leaves its domain at t = log 2."""

    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == -self.x
        yield self.y == ac.log(self.x - 0.5)


@ENGINES
def test_outside_the_domain(engine: Any) -> None:
    solution = ac.compile(Decay()).simulate(1.0, saveat=[0.0, 0.5, 1.0], engine=engine)
    assert np.allclose(solution["x"], np.exp([0.0, -0.5, -1.0]), atol=1e-5)
    with pytest.raises(SimulationError, match="`y` has no finite value at t = 1 s") as info:
        solution["y"]
    assert "y = log(x - 0.5)" in str(info.value)
    assert "test_not_finite.py" in str(info.value)
    with pytest.raises(SimulationError, match="`x, y` has no finite value"):
        solution[["x", "y"]]


@ENGINES
def test_values_as_they_are(engine: Any) -> None:
    system = ac.compile(Decay())
    frame = system.simulate(1.0, saveat=[0.0, 1.0], engine=engine).to_dataframe()
    assert np.isnan(frame["y"].to_numpy()[-1])
    loose = system.simulate(1.0, saveat=[0.0, 1.0], engine=engine, throw=False)
    assert np.isnan(loose["y"][-1])


class Ring(Component):
    """Two gains in a ring: ``(1 - k*g)*y == 0``."""

    k: Parameter = Parameter(1.0)
    g: Parameter = Parameter(0.1)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()
    u: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == self.y - self.x
        yield self.y == self.k * self.u
        yield self.u == self.g * self.y


@ENGINES
@pytest.mark.parametrize("gain", [10.0, 1 / 3])
def test_zero_times_an_unknown_is_zero(engine: Any, gain: float) -> None:
    """Whatever the unknown is: without an error it would come out as zero."""
    system = ac.compile(Ring())
    assert system.simulate(1.0, engine=engine)["y"][-1] == 0.0
    with pytest.raises(InitializationError, match=r"do not determine `.`, `.`: any value solves them") as info:
        system.simulate(1.0, engine=engine, parameters={"k": gain, "g": 1 / gain})
    for words in ("y = k*u", "u = g*y", "test_not_finite.py"):
        assert words in str(info.value)


@ENGINES
def test_a_factor_that_passes_zero(engine: Any) -> None:
    class Pole(Component):
        x: Variable = Variable(start=0.0, fixed=True)
        factor: Variable = Variable()
        y: Variable = Variable()

        def equations(self) -> Equations:
            yield der(self.x) == ac.cos(ac.time)
            yield self.factor == ac.time - 0.5
            yield self.factor * self.y == 2.0

    solution = ac.compile(Pole()).simulate(1.0, saveat=[0.0, 0.5, 1.0], engine=engine)
    with pytest.raises(SimulationError, match=r"`y` has no finite value at t = 0\.5 s") as info:
        solution["y"]
    assert "does not depend on it" in str(info.value)
    assert "factor*y = 2" in str(info.value)


class Vanishing(Component):
    """The second and third equation leave y = 2 exp(-t), so x = 0, and z, which x multiplies, is free."""

    x: Variable = Variable(start=1.0)
    y: Variable = Variable(start=1.0)
    z: Variable = Variable(start=1.0)

    def equations(self) -> Equations:
        yield der(self.x) == -self.x * self.z
        yield der(self.y) == self.x * self.z - self.y
        yield self.x + self.y == 2 * ac.exp(-ac.time)


def test_singular_only_where_the_other_equations_hold() -> None:
    system = ac.compile(Vanishing())
    with pytest.raises(StructureError, match="`z` cannot be found") as info:
        system.simulate(1.0, engine="native")
    assert "= x*z" in str(info.value)
    assert "test_not_finite.py" in str(info.value)
    with pytest.raises(SimulationError, match="`z` has no finite value") as failed:
        system.simulate(1.0, engine="diffrax")["z"]
    assert "x*z" in str(failed.value)


@ENGINES
def test_a_block_that_is_singular_at_the_start(engine: Any) -> None:
    class Crossing(Component):
        """Hessenberg form of index 2 whose ``C B = t cos t + (1 - t^2 / 2) sin t`` is zero at t = 0."""

        x: Variable = Variable(start=1.0)
        y: Variable = Variable(start=0.0)
        z: Variable = Variable()

        def equations(self) -> Equations:
            t = ac.time
            yield der(self.x) == -self.x + t * self.z + self.y
            yield der(self.y) == (1 - t**2 / 2) * self.z - self.x
            yield self.x * ac.cos(t) + self.y * ac.sin(t) == ac.exp(-t)

    with pytest.raises(SimulationError, match="do not determine their unknowns") as info:
        ac.compile(Crossing()).simulate(1.0, engine=engine)
    assert "der(x) + x = time*z + y" in str(info.value)
    assert "test_not_finite.py" in str(info.value)


@ENGINES
def test_iterated_equations_that_are_singular_at_a_point(engine: Any) -> None:
    class Weak(Component):
        """At x = 0 the second equation says nothing about y and z."""

        x: Variable = Variable(start=0.0, fixed=True)
        y: Variable = Variable(start=0.5)
        z: Variable = Variable(start=0.5)

        def equations(self) -> Equations:
            yield der(self.x) == 0
            yield self.x * (self.y**3 + self.y) + self.x**2 * self.z == ac.sin(self.x)
            yield self.y + self.z**3 == 1

    with pytest.raises(SimulationError, match="The Jacobian is singular there") as info:
        ac.compile(Weak()).simulate(1.0, engine=engine)
    assert "= sin(x)" in str(info.value)
    assert "test_not_finite.py" in str(info.value)
