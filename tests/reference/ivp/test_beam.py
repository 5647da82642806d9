"""The elastic beam of the IVP test set: 40 angles, the inverse of a tridiagonal matrix as 40 algebraic unknowns.

Source: Hairer, Wanner (1996), Solving ordinary differential equations II, section IV.10, problem BEAM; reference
solution: Test Set for IVP Solvers, release 2.4, problem `beam` (RADAU in quadruple precision).
"""

from __future__ import annotations

import types
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, cos, der, sin, where

N = 40
# every fifth angle and angular velocity at t = 5
ANGLES = {
    1: -0.5792366591285007e-2, 5: -0.4790616859743763e-1, 10: -0.9119134654647947e-1, 15: -0.1244520128755561,
    20: -0.1483595472463012, 25: -0.1639351238193223, 30: -0.1725821847462537, 35: -0.1761040960228576,
    40: -0.1767201761075488,
}  # fmt: skip
VELOCITIES = {
    1: 0.3747362681329794e-1, 5: 0.3121293820596567, 10: 0.5987609702624270, 15: 0.8229176659201515,
    20: 0.9868747821728363, 25: 0.1095490222005369e1, 30: 0.1156792132004482e1, 35: 0.1182198586299667e1,
    40: 0.1186724615113034e1,
}  # fmt: skip


def _equations(self: Any) -> Equations:
    """With theta'' = C v + D w, C w = D v + theta'^2."""
    angle = [getattr(self, f"a{i}") for i in range(N)]
    speed = [getattr(self, f"s{i}") for i in range(N)]
    w = [getattr(self, f"w{i}") for i in range(N)]
    force = where(ac.time > ac.PI, 0.0, 1.5 * sin(ac.time) ** 2)
    v = []
    for i in range(N):
        below = angle[i - 1] if i else -angle[0]
        above = angle[i + 1] if i < N - 1 else angle[i]
        load = force * (cos(angle[i]) + sin(angle[i]))
        v.append(N**4 * (below - 2 * angle[i] + above) + N**2 * load)
    cosine = [cos(angle[i + 1] - angle[i]) for i in range(N - 1)]
    sine = [sin(angle[i + 1] - angle[i]) for i in range(N - 1)]

    def c_times(x: list[Any], i: int) -> Any:
        diagonal = (1 if i == 0 else 3 if i == N - 1 else 2) * x[i]
        left = cosine[i - 1] * x[i - 1] if i else 0
        return diagonal - left - (cosine[i] * x[i + 1] if i < N - 1 else 0)

    def d_times(x: list[Any], i: int) -> Any:
        left = sine[i - 1] * x[i - 1] if i else 0
        return (sine[i] * x[i + 1] if i < N - 1 else 0) - left

    for i in range(N):
        yield der(angle[i]) == speed[i]
        yield der(speed[i]) == c_times(v, i) + d_times(w, i)
        yield c_times(w, i) == d_times(v, i) + speed[i] ** 2


def beam() -> Component:
    """The beam at rest."""
    fields: dict[str, Any] = {f"{letter}{i}": Variable(start=0.0) for letter in "asw" for i in range(N)}
    annotations = {name: Variable for name in fields}
    namespace = {"__module__": __name__, "__annotations__": annotations, "__doc__": "Beam.", "equations": _equations}
    return types.new_class("Beam", (Component,), {}, lambda ns: ns.update(namespace | fields))()


@pytest.mark.slow
def test_beam() -> None:
    system = ac.compile(beam())
    assert system.report().structural_index == 1
    solution = system.simulate(5.0, rtol=1e-9, atol=1e-11, saveat=np.array([0.0, 5.0]))
    for letter, values in (("a", ANGLES), ("s", VELOCITIES)):
        for i, wanted in values.items():
            assert float(np.asarray(solution[f"{letter}{i - 1}"])[-1]) == pytest.approx(wanted, rel=1e-6)
