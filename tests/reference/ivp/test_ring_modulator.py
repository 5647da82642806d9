"""The ring modulator without the parasitic capacitances of its diodes, index 2.

Four diode equations become constraints. Source: Mazzia and Magherini (2008), Test Set for IVP Solvers, Ring modulator,
with ``Cs = 0``; the published values are for ``Cs = 2e-12``, whose fast oscillations of y3 to y6 do not vanish with Cs.
"""

from __future__ import annotations

import re
from typing import Any

import numpy as np
import pytest

import acausal as ac

from . import problems

# a Radau IIA method of order 3 with 20 000 and 40 000 equal steps, applied to the equations as they are; its two
# results differ by less than 5e-5
WANTED = {
    "y1": -0.0233991, "y2": -0.00737488, "y3": 0.3234248, "y4": -0.3413135, "y5": -0.3388118, "y6": 0.3259265,
    "y7": 0.11067448, "y10": 7.26085e-4, "y11": 7.93516e-4, "y12": -7.26085e-4, "y13": -7.93516e-4,
    "y14": 7.08781e-5, "y15": 2.38981e-5,
}  # fmt: skip


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_without_capacitances(engine: Any) -> None:
    problem = problems.load("ring_modulator")
    equations = [re.sub(r"^cs\*der\(y\d\) - ", "", text) for text in problem["equations"]]
    assert sum(a != b for a, b in zip(equations, problem["equations"], strict=True)) == 4
    system = ac.compile(problems.component(problem | {"equations": equations}))
    assert system.report().structural_index == 2
    solution = system.simulate(1e-3, rtol=1e-6, saveat=[0.0, 1e-3], engine=engine)
    found = np.array([solution[name][-1] for name in WANTED])
    np.testing.assert_allclose(found, list(WANTED.values()), rtol=1e-4)
