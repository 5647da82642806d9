"""Parameters that the initialization finds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Equations, Parameter, connect, start
from acausal.components import translational

UNKNOWN = start(1.0, fixed=False)
PULLED = translational.Mass(s=start(1.0, fixed=True), v=start(0.0, fixed=True), a=start(-3.0, fixed=True))


class Hung(Component):
    """A mass on a spring."""

    k: Parameter = Parameter(2.0, unit="N/m")
    wall: translational.Fixed = translational.Fixed()
    spring: translational.Spring = translational.Spring(c=k)
    mass: translational.Mass = translational.Mass(s=start(1.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange_a)


class Found(Hung):
    """The constant of the spring follows from the acceleration."""

    spring: translational.Spring = translational.Spring(c=UNKNOWN)
    mass: translational.Mass = PULLED


def constant(model: Component, **options: Any) -> list[float]:
    solution = ac.compile(model).simulate(1.0, saveat=[0.0, 1.0], **options)
    return np.asarray(solution["spring.c"]).tolist()


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_constant_follows_from_the_start(engine: Any) -> None:
    system = ac.compile(Found())
    assert set(system.states) == {"spring.c", "mass.s", "mass.v"}
    assert "spring.c" not in system.parameters
    solution = system.simulate(1.0, saveat=[0.0, 1.0], rtol=1e-9, engine=engine)
    assert solution["spring.c"][0] == solution["spring.c"][1]
    np.testing.assert_allclose(solution["spring.c"], 3.0, rtol=1e-9)
    np.testing.assert_allclose(solution["mass.s"][1], np.cos(np.sqrt(3.0)), atol=1e-7)


@pytest.mark.parametrize(
    ("model", "wanted"),
    [
        (Hung(spring=translational.Spring(c=UNKNOWN), mass=PULLED), 3.0),
        (ac.modify(Hung(mass=PULLED), {"spring.c": UNKNOWN}), 3.0),
        (Found(spring=translational.Spring(s_rel0=0.5)), 6.0),
        (ac.redeclare(Hung(mass=PULLED), {"spring": translational.Spring(c=UNKNOWN, s_rel0=0.25)}), 4.0),
        (Found(spring=translational.Spring(c=5.0), mass=translational.Mass()), None),
        (ac.modify(Found(mass=translational.Mass(a=start(0.0, fixed=False))), {"spring.c": 5.0}), None),
    ],
)  # fmt: skip
def test_modifications(model: Component, wanted: float | None) -> None:
    if wanted is None:
        assert ac.compile(model).parameters["spring.c"] == 5.0
    else:
        np.testing.assert_allclose(constant(model), wanted, rtol=1e-9)


def test_it_is_still_of_its_class() -> None:
    spring = translational.Spring(c=UNKNOWN)
    assert isinstance(spring, translational.Spring)
    assert type(spring) is type(translational.Spring(c=start(7.0, fixed=False)))
    assert "Spring(c=" in repr(spring)


def test_element_of_an_array() -> None:
    class Many(Component):
        wall: translational.Fixed = translational.Fixed()
        springs: Array[translational.Spring] = Array(translational.Spring(c=UNKNOWN), 3)
        masses: Array[translational.Mass] = Array(PULLED, 3)

        def equations(self) -> Equations:
            for i in range(3):
                yield connect(self.wall.flange, self.springs[i].flange_a)
            yield connect(self.springs[:].flange_b, self.masses[:].flange_a)

    solution = ac.compile(Many()).simulate(1.0, saveat=[1.0])
    np.testing.assert_allclose([solution[f"springs[{i}].c"][0] for i in range(3)], 3.0, rtol=1e-9)


@pytest.mark.parametrize("fixed", [None, True])
def test_start_of_a_parameter_says_that_it_is_unknown(fixed: Any) -> None:
    with pytest.raises(ac.DeclarationError, match=r"Spring\(c=.*or `start\(guess, fixed=False\)` if the init"):
        translational.Spring(c=start(1.0, fixed=fixed))


def test_parameters_of_a_class_do_not_follow_from_it() -> None:
    with pytest.raises(ac.DeclarationError, match=r"`k` in the value of `spring.c` is not a parameter"):
        ac.compile(Hung(k=UNKNOWN, mass=PULLED))
