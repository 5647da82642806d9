"""Medical Akzo Nobel problem: a front of 400 equations, fed until t = 5, from the test set for initial value problems.

Source: Mazzia and Magherini (2008), Test Set for IVP Solvers, release 2.4, chapter II.9.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Array, Component, Equations, Parameter, Variable, der

N = 200


class Cell(Component):
    """Concentrations of the antibody u and of the substrate v in one cell."""

    place: Parameter = Parameter(0.0)
    u: Variable = Variable(start=0.0, fixed=True)
    v: Variable = Variable(start=1.0, fixed=True)
    left: Variable = Variable()
    right: Variable = Variable()

    def equations(self) -> Equations:
        c, k, dz = 4.0, 100.0, 1.0 / N
        drift, spread = 2 * (self.place - 1) ** 3 / c**2, (self.place - 1) ** 4 / c**2
        transport = drift * (self.right - self.left) / (2 * dz) + spread * (self.left - 2 * self.u + self.right) / dz**2
        yield der(self.u) == transport - k * self.u * self.v
        yield der(self.v) == -k * self.u * self.v


class MedicalAkzoNobel(Component):
    """Penetration of antibodies into a tissue that a tumour has changed; the far end is closed."""

    n: int = N
    cell: Array[Cell] = Array(Cell(), "n")

    def equations(self) -> Equations:
        yield self.cell[0].left == ac.where(ac.time <= 5, 2.0, 0.0)
        yield self.cell[1:].left == self.cell[:-1].u
        yield self.cell[:-1].right == self.cell[1:].u
        yield self.cell[-1].right == self.cell[-1].u


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.slow_case("diffrax")
def test_six_digits(engine: Any) -> None:
    """Some of the components that the source publishes at t = 20; the values are from SciPy's Radau at rtol 1e-9."""
    system = ac.compile(MedicalAkzoNobel())
    assert system.report().structural_index == 1  # the feed is an unknown of its own; without it, 0
    places = {f"cell[{k}].place": (k + 1) / N for k in range(N)}
    solution = system.simulate(20.0, parameters=places, saveat=[0.0, 20.0], rtol=1e-7, atol=1e-10, engine=engine)
    wanted = {
        "cell[39].u": 2.33994222e-4, "cell[74].u": 3.59561603e-4, "cell[99].u": 1.17374130e-4,
        "cell[99].v": 6.19082202e-6, "cell[119].u": 6.86009484e-12, "cell[119].v": 0.99999973259,
    }  # fmt: skip
    found = np.array([solution[name][-1] for name in wanted])
    np.testing.assert_allclose(found, list(wanted.values()), rtol=1e-6, atol=1e-14)
