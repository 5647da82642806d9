"""The simulations in the docstrings of all components, against the flat equations and against other integrators.

The flat equations are those the user wrote, in CasADi, before any elimination, index reduction, sorting and tearing.
"""

from __future__ import annotations

import numpy as np
import pytest

pytest.importorskip("casadi")

from acausal import Component
from acausal.components import rotational

from .docstrings import CLASSES, example_of
from .independent import AGREES, Check, Integrators, broken, residual
from .test_library import named

RESIDUAL = 1e-6
"""Largest residual of an equation, relative to the size of its terms."""
SPREAD = 8
"""Every so many classes one is always tested, the others with the slow tests."""

PARAMETERS = [
    pytest.param(cls, id=named(cls), marks=() if k % SPREAD == 0 else pytest.mark.slow)
    for k, cls in enumerate(CLASSES)
]  # fmt: skip


def checks(cls: type[Component]) -> list[Check]:
    made = [Check(run) for run in example_of(cls).runs]
    assert made, f"the example of {named(cls)} simulates nothing"
    return made


@pytest.mark.parametrize("cls", PARAMETERS)
def test_example_agrees_with_independent_solution(cls: type[Component]) -> None:
    found = checks(cls)
    for check in found:
        worst, equation = residual(check)
        assert worst <= RESIDUAL, f"residual {worst:.1e} of {equation}"
        assert not broken(check), broken(check)
    worst = max(map(_disagreement, found))
    assert worst <= AGREES, f"another integrator's solution differs by {worst:.1e}"


def _disagreement(check: Check) -> float:
    integrators = Integrators(check.equations, check.size)
    return max(integrators.disagreement(stretch) for stretch in check.stretches)


def test_wrong_solutions_are_seen() -> None:
    (check, *_) = checks(rotational.Inertia)
    assert _disagreement(check) <= AGREES
    (stretch, *_) = check.stretches
    names = check.equations.names
    stretch.v[names.index("der(" + names[check.equations.states[0]] + ")")] += 1e-3 * np.max(np.abs(stretch.v))
    assert residual(check)[0] > RESIDUAL
    stretch.v[check.equations.states, 1:] *= 1.001
    assert _disagreement(check) > AGREES
