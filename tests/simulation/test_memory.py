"""Systems, and the programs compiled for them, go when nobody holds them any more."""

from __future__ import annotations

import gc
import weakref
from collections.abc import Callable
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import pytest

import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der, reinit, sin, when


class Decay(Component):
    """With an algebraic unknown that the solver iterates on."""

    k: Parameter = Parameter(2.0)
    x: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == -self.k * self.x + self.y
        yield self.y + 0.1 * self.y**3 == sin(self.x)


class Ball(Component):
    k: Parameter = Parameter(0.8)
    x: Variable = Variable(start=1.0, fixed=True)
    v: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == self.v
        yield der(self.v) == -9.81
        yield when(self.x < 0.0, reinit(self.v, -self.k * self.v))


def last(system: ac.System, k: Any, **options: Any) -> Any:
    return system.simulate(1.0, saveat=5, parameters={"k": k}, **options)["x"][-1]


def run(system: ac.System) -> None:
    last(system, 0.7, engine="diffrax")


def run_with_algebraic_unknowns_inside(system: ac.System) -> None:
    last(system, 0.7, engine="diffrax", solver=diffrax.Kvaerno3())


def gradient(system: ac.System) -> None:
    jax.grad(lambda k: last(system, k))(0.7)


def compiled(system: ac.System) -> None:
    jax.jit(lambda k: last(system, k))(0.7)


def many(system: ac.System) -> None:
    jax.vmap(lambda k: last(system, k))(jnp.array([0.7, 0.8]))


def linearization(system: ac.System) -> None:
    system.linearize()


WAYS = [
    (Decay, run), (Decay, run_with_algebraic_unknowns_inside), (Decay, gradient), (Decay, compiled), (Decay, many),
    (Decay, linearization), (Ball, run), (Ball, gradient), (Ball, compiled), (Ball, many),
]  # fmt: skip
QUICK = {(Ball, run)}


def programs() -> int:
    """Programs of JAX in memory that solve."""
    found = jax.devices()[0].client.live_executables()
    return sum("_solve" in module.name for one in found for module in one.hlo_modules())


def used(model: type[Component], use: Callable[[ac.System], None]) -> list[weakref.ref[Any]]:
    """References to what has been used; in a function of its own, as frames may keep what they had."""
    system = ac.compile(model())
    use(system)
    return [weakref.ref(one) for one in (system, system.lowered, system.located, system.located.lowered)]


@pytest.mark.parametrize(("model", "use"), [
    pytest.param(m, u, id=f"{m.__name__}-{u.__name__}", marks=[] if (m, u) in QUICK else pytest.mark.slow)
    for m, u in WAYS
])  # fmt: skip
def test_a_system_goes_with_its_programs(model: type[Component], use: Callable[[ac.System], None]) -> None:
    gc.collect()
    before = programs()
    held = used(model, use)
    for _ in range(2):  # the callbacks of a program go when the program has gone
        gc.collect()
    assert [ref() for ref in held] == [None] * len(held)
    assert programs() <= before
