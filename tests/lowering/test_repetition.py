"""Chains of equal blocks become loops: the traced program does not grow with them, values and derivatives hold."""

import jax
import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Equations, Input, Output, Parameter, Variable, connect, der, start


class Link(Component):
    k: Parameter = Parameter(0.999)
    u: Input = Input()
    z: Variable = Variable()
    y: Output = Output()

    def equations(self) -> Equations:
        yield self.z == ac.sin(self.u)
        yield self.y == self.k * self.z + 0.001


class Line(Component):
    n: int = 5
    links: Array[Link] = Array(Link(), "n")
    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield connect(self.links[:-1].y, self.links[1:].u)
        yield self.links[0].u == self.x
        yield der(self.x) == -self.links[self.n - 1].y


def by_hand(n: int, x: float) -> tuple[float, float]:
    y, slope = x, 1.0
    for _ in range(n):
        slope *= 0.999 * np.cos(y)
        y = 0.999 * np.sin(y) + 0.001
    return -y, -slope


@pytest.mark.parametrize("n", [3, 11, 40, 300])
def test_value_and_derivatives(n: int) -> None:
    system = ac.compile(Line(n=n))
    field = lambda x: system.vector_field(0.0, x)  # noqa: E731
    value, slope = by_hand(n, 0.7)
    x = jnp.array([0.7])
    assert float(field(x)[0]) == pytest.approx(value, rel=1e-13)
    assert float(jax.jacfwd(field)(x)[0, 0]) == pytest.approx(slope, rel=1e-11, abs=1e-300)
    assert float(jax.jacrev(field)(x)[0, 0]) == pytest.approx(slope, rel=1e-11, abs=1e-300)


def test_program_does_not_grow() -> None:
    def size(n: int) -> int:
        return len(jax.make_jaxpr(ac.compile(Line(n=n)).vector_field)(0.0, jnp.ones(1)).jaxpr.eqns)

    assert size(50) == size(2000)


def test_parameters_of_each_link() -> None:
    gains = np.linspace(0.5, 1.5, 30)
    system = ac.compile(Line(n=30, links=Array(Link(), 30, k=list(gains), z=start(0.0))))
    y = 0.7
    for k in gains:
        y = k * np.sin(y) + 0.001
    assert float(system.vector_field(0.0, jnp.array([0.7]))[0]) == pytest.approx(-y, rel=1e-13)
    slope = jax.grad(lambda v: system.vector_field(0.0, jnp.array([0.7]), {"links[3].k": v})[0])(gains[3])
    h = 1e-6
    up, down = (
        float(system.vector_field(0.0, jnp.array([0.7]), {"links[3].k": gains[3] + s * h})[0]) for s in (1, -1)
    )
    assert float(slope) == pytest.approx((up - down) / (2 * h), rel=1e-7)
