"""Random nonlinear DAEs in Hessenberg form of index 2 and 3, made for a solution that is known (the method of
manufactured solutions): the index is found, and the solution with all its hidden constraints."""

from __future__ import annotations

import types
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, cast

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, der


@dataclass(frozen=True)
class Wave:
    """``offset + a sin(b t + c)``."""

    a: float
    b: float
    c: float
    offset: float

    def at(self, t: Any, sin: Callable[[Any], Any], order: int = 0) -> Any:
        """Its value, or that of a derivative."""
        value = self.a * self.b**order * sin(self.b * t + (self.c + order * np.pi / 2))
        return value if order else value + self.offset


@dataclass(frozen=True)
class Hessenberg:
    """``x' = f(x, z) + p(t)`` or ``x'' = f(x, z) + p(t)``, and ``g(x) = g(exact x)``, with ``dg/dx df/dz`` regular.

    Source: Hairer and Wanner (1996), VII.1, (1.15) and (1.20).
    """

    index: int
    mixed: bool
    x: tuple[Wave, ...]
    z: tuple[Wave, ...]
    B: np.ndarray
    pick: np.ndarray

    def f(self, x: list[Any], z: list[Any]) -> list[Any]:
        """Right-hand side without its forcing."""
        terms = []
        for i, (k, a, b) in enumerate(self.pick[:, :3].tolist()):
            u, v = x[a], x[b]
            term = (u * v, ac.sin(u), 0.3 * u**2, u / (2 + v**2))[k]
            terms.append(term + sum(self.B[i, j] * (q + 0.1 * q**3) for j, q in enumerate(z)))
        return terms

    def g(self, x: list[Any]) -> list[Any]:
        """The constraints."""
        other = self.pick[:, 3].tolist()
        return [
            x[j] + 0.2 * x[j] ** 3 + 0.3 * ac.sin(x[other[j]]) + 0.1 * x[(j + 1) % len(x)] * x[0]
            for j in range(len(self.z))
        ]

    def model(self) -> Component:
        """The equations; the start values are those of the solution, but none is fixed."""
        n, m = len(self.x), len(self.z)

        def equations(self_: Any) -> Equations:
            t = ac.time
            x, z = [getattr(self_, f"x{i}") for i in range(n)], [getattr(self_, f"z{j}") for j in range(m)]
            exact_x, exact_z = [w.at(t, ac.sin) for w in self.x], [w.at(t, ac.sin) for w in self.z]
            left = [der(q) for q in x]
            if self.index == 3:
                speed = [getattr(self_, f"v{i}") for i in range(n)]
                for v, rate in zip(speed, left, strict=True):
                    yield rate == v
                left = [der(v) for v in speed]
            order = self.index - 1
            forcing = [w.at(t, ac.sin, order) - e for w, e in zip(self.x, self.f(exact_x, exact_z), strict=True)]
            right = [a + b for a, b in zip(self.f(x, z), forcing, strict=True)]
            if self.mixed:
                left[0], right[0] = left[0] + 2 * left[1], right[0] + 2 * right[1]
                left[1], right[1] = left[1] - 3 * left[0], right[1] - 3 * right[0]
            for a, b in zip(left, right, strict=True):
                yield a == b
            for a, b in zip(self.g(x), self.g(exact_x), strict=True):
                yield a == b

        fields: dict[str, Any] = {name: Variable(start=float(w.at(0.0, np.sin, k))) for name, w, k in self.names()}
        body = {"equations": equations, "__annotations__": dict.fromkeys(fields, Variable), "__module__": __name__}
        made = types.new_class("Nonlinear", (Component,), exec_body=lambda ns: ns.update(body | fields))
        return cast("type[Component]", made)()

    def names(self) -> list[tuple[str, Wave, int]]:
        """Name of every variable, and the wave and order of derivative that it is."""
        out = [(f"x{i}", w, 0) for i, w in enumerate(self.x)] + [(f"z{j}", w, 0) for j, w in enumerate(self.z)]
        return out + [(f"v{i}", w, 1) for i, w in enumerate(self.x) if self.index == 3]


def draw(seed: int) -> Hessenberg:
    """Two to four differential variables, one or two algebraic ones."""
    rng = np.random.default_rng(seed)
    n = int(rng.integers(2, 5))
    m = int(rng.integers(1, min(2, n - 1) + 1))
    index = int(rng.integers(2, 4))

    def wave() -> Wave:
        return Wave(*(float(rng.uniform(*span)) for span in ((0.3, 1.0), (0.5, 3.0), (0.0, 3.0), (-1.0, 1.0))))

    B = np.round(rng.uniform(-0.4, 0.4, (n, m)), 2) + 2 * np.eye(n, m)
    pick = np.stack([rng.integers(0, 4, n), *(rng.integers(0, n, n) for _ in range(3))], axis=1)
    return Hessenberg(
        index, bool(rng.integers(2)), tuple(wave() for _ in range(n)), tuple(wave() for _ in range(m)), B, pick
    )


def check(seed: int, engine: Any) -> None:
    dae = draw(seed)
    system = ac.compile(dae.model())
    assert system.report().structural_index == dae.index
    t = np.linspace(0.0, 2.0, 5)
    solution = system.simulate(2.0, saveat=t, rtol=1e-9, engine=engine)
    for name, wave, order in dae.names():
        np.testing.assert_allclose(solution[name], wave.at(t, np.sin, order), atol=1e-6, err_msg=f"{seed} {name}")


@pytest.mark.parametrize("seed", range(8))
def test_the_exact_solution(seed: int) -> None:
    check(seed, "diffrax" if seed == 0 else "native")


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(8, 60))
def test_many_exact_solutions(seed: int) -> None:
    check(seed, "diffrax" if seed % 10 == 0 else "native")


def mixed(seed: int, power: int = 1) -> tuple[Hessenberg, Component]:
    """A system whose equations have multiples of others (or their powers) added, by factors that vary."""
    dae = draw(seed)
    plain: Any = type(dae.model())

    def equations(self: Any) -> Equations:
        rng = np.random.default_rng(1000 + seed)
        rows = [equation.lhs - equation.rhs for equation in plain.equations(self)]
        unknowns = [getattr(self, name) for name, _, _ in dae.names()]
        for _ in range(int(rng.integers(1, len(rows) + 1))):
            i, j = rng.choice(len(rows), 2, replace=False)
            c, v = float(np.round(rng.uniform(0.5, 2), 2)), unknowns[int(rng.integers(len(unknowns)))]
            rows[i] = rows[i] + (c, c * ac.time, c * ac.cos(ac.time), c * v)[int(rng.integers(4))] * rows[j] ** power
        for row in rows:
            yield row == 0

    made = types.new_class("Mixed", (plain,), exec_body=lambda ns: ns.update(equations=equations, __module__=__name__))
    return dae, cast("type[Component]", made)()


@pytest.mark.slow
def test_mixed_equations_give_the_exact_solution_or_an_error() -> None:
    """Sums with multiples of other equations may be singular on the solution only, which no structure shows."""
    t, solved = np.linspace(0.0, 1.0, 5), 0
    for seed in range(16):
        dae, model = mixed(seed)
        try:
            system = ac.compile(model)
            solution = system.simulate(1.0, saveat=t, rtol=1e-9, engine="native", max_steps=20_000)
        except ac.AcausalError as error:
            assert len(str(error)) > 40
            continue
        solved += 1
        assert system.report().index == dae.index
        for name, wave, order in dae.names():
            np.testing.assert_allclose(solution[name], wave.at(t, np.sin, order), atol=1e-6, err_msg=f"{seed} {name}")
    assert solved >= 10


@pytest.mark.slow
@pytest.mark.parametrize("seed", [2, 9, 22])
def test_the_index_is_that_of_solutions(seed: int) -> None:
    """The cube of an equation changes the rank of the derivative array everywhere but where the equation holds."""
    dae, model = mixed(seed, power=3)
    assert ac.compile(model).report().index == dae.index
