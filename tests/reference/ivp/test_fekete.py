"""Elliptic Fekete points of the IVP test set: 20 repelling points on a sphere, index 2 with stabilised constraints.

Source: Test Set for IVP Solvers, release 2.4, problem `fekete` (J. J. B. de Swart and others); reference solution by
RADAU5 with tolerances of 1e-12. Velocities and the multipliers `m` end at zero, the multipliers `l` at -4.75.
"""

from __future__ import annotations

import types
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, der

N, DAMPING = 20, 0.5
# count and number of the first point, turn, and latitude of four rings of the start
RINGS = ((3, 1, np.pi / 13, 3 * np.pi / 8), (7, 1, np.pi / 29, np.pi / 8), (6, 1, np.pi / 7, -2 * np.pi / 15),
         (4, 0, np.pi / 17, -3 * np.pi / 10))  # fmt: skip
# positions at t = 1000
END = (
    (-0.4070263380333202, 0.3463758772791802, 0.8451942450030429),
    (0.0775293475252155, -0.2628662719972299, 0.9617122871829146),
    (0.7100577833343567, 0.121294805558612, 0.6936177005172217),
    (0.2348267744557627, 0.7449277976923311, 0.6244509285956391),
    (-0.4341114738782885, 0.8785430442262876, 0.199272044423766),
    (-0.9515059600312596, 0.2203508762787005, 0.2146669498274008),
    (-0.6385191643609878, -0.4310833259390688, 0.6375425027722121),
    (-0.1464175087914336, -0.9380871635228862, 0.313933729874469),
    (0.5666974065069942, -0.6739221885076542, 0.4740073135462156),
    (0.9843259538440293, -0.1696995357819996, -0.0480050429060909),
    (0.1464175087914331, 0.9380871635228875, -0.3139337298744656),
    (-0.7092757549979014, 0.5264062637139616, -0.4688542938854929),
    (-0.8665731819284478, -0.4813878059756024, -0.1315929352982178),
    (-0.2347897778700538, -0.859434040801313, -0.4541441287957579),
    (0.5530976940074118, -0.7674370265615124, -0.3242273140037833),
    (0.7711050969896927, 0.6357041816577034, 0.03573685519777001),
    (0.7103951209379591, 0.2403570431280519, -0.6614886725910596),
    (-0.0303820873873566, 0.4501923293640461, -0.8924145871442046),
    (-0.5772996158107093, -0.1766763414971813, -0.7971892020969544),
    (0.2414481766969039, -0.3416456818373135, -0.908284650344625),
)  # fmt: skip


def start() -> list[tuple[float, float, float]]:
    """Points on the four rings, on the unit sphere."""
    points = []
    for count, first, turn, latitude in RINGS:
        for k in range(first, first + count):
            longitude = 2 * np.pi * k / count + turn
            ring = np.cos(latitude)
            points.append((np.cos(longitude) * ring, np.sin(longitude) * ring, np.sin(latitude)))
    return points


def _equations(self: Any) -> Equations:
    p = [[getattr(self, f"p{i}{axis}") for axis in "xyz"] for i in range(N)]
    q = [[getattr(self, f"q{i}{axis}") for axis in "xyz"] for i in range(N)]
    distance = {(i, j): sum((a - b) ** 2 for a, b in zip(p[i], p[j], strict=True)) for i in range(N) for j in range(i)}
    for i in range(N):
        stay, along = getattr(self, f"l{i}"), getattr(self, f"m{i}")
        for k in range(3):
            push = sum((p[i][k] - p[j][k]) / distance[max(i, j), min(i, j)] for j in range(N) if j != i)
            yield der(p[i][k]) == q[i][k] + 2 * along * p[i][k]
            yield der(q[i][k]) == push - DAMPING * q[i][k] + 2 * stay * p[i][k]
        (x, y, z), (u, v, w) = p[i], q[i]
        yield x**2 + y**2 + z**2 == 1
        yield x * u + y * v + z * w == 0


def fekete() -> Component:
    """The points at rest on their rings."""
    fields: dict[str, Any] = {}
    for i, point in enumerate(start()):
        fields |= {f"p{i}{axis}": Variable(start=x) for axis, x in zip("xyz", point, strict=True)}
        fields |= {f"q{i}{axis}": Variable(start=0.0) for axis in "xyz"}
        fields |= {f"l{i}": Variable(start=-4.75), f"m{i}": Variable(start=0.0)}
    annotations = {name: Variable for name in fields}
    namespace = {"__module__": __name__, "__annotations__": annotations, "__doc__": "Points.", "equations": _equations}
    return types.new_class("Fekete", (Component,), {}, lambda ns: ns.update(namespace | fields))()


@pytest.mark.slow
def test_fekete_points() -> None:
    system = ac.compile(fekete())
    assert system.report().structural_index == 2
    solution = system.simulate(1000.0, rtol=1e-9, saveat=np.array([0.0, 1000.0]))
    for i, point in enumerate(END):
        found = [float(np.asarray(solution[f"p{i}{axis}"])[-1]) for axis in "xyz"]
        assert found == pytest.approx(point, abs=1e-6)
        assert float(np.asarray(solution[f"l{i}"])[-1]) == pytest.approx(-4.75, rel=1e-9)
        assert float(np.asarray(solution[f"m{i}"])[-1]) == pytest.approx(0.0, abs=1e-9)
