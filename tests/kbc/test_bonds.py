"""The crane as one bond graph gives the signals of the crane of components."""

from __future__ import annotations

from contextlib import nullcontext
from typing import Literal

import numpy as np
import pytest
from numpy.testing import assert_allclose

import acausal as ac
from acausal.components import hydraulic
from models.kbc import SIGNALS, Crane, reference_crane

T = np.linspace(0.0, 13.9, 71)  # none at the steps, where the pressure jumps
CHANGES = {"bore": 0.26, "V2": 8e-4, "k_c": 1.5e8, "Kp": 5.0, "p_tank": 2e5}


def signals(crane: Crane) -> dict[str, np.ndarray]:
    solution = ac.compile(crane).simulate(t1=T[-1], saveat=T, rtol=1e-9)
    names = set(solution.names)
    return {column: np.asarray(solution[name]) for column, name in SIGNALS.items() if name in names}


def assert_equal(found: dict[str, np.ndarray], wanted: dict[str, np.ndarray]) -> None:
    for column, values in wanted.items():
        assert_allclose(found[column], values, rtol=1e-6, atol=1e-6 * np.abs(values).max(), err_msg=column)


@pytest.mark.parametrize("joint", ["compliant", "rigid"])
@pytest.mark.parametrize("hydraulics", ["simplified", "extended"])
def test_bonds_are_components(
    hydraulics: Literal["simplified", "extended"], joint: Literal["compliant", "rigid"]
) -> None:
    """Two steps, with changed parameters in every part.

    Flows that follow the valve at once through a rigid joint make the speeds jump with the reference: that is said. So
    is that the oil on the rod side is pulled below a vacuum, with these parameters.
    """
    jumps = (hydraulics, joint) == ("simplified", "rigid")
    said = "At t = (2|12) s this equation jumps" if jumps else "cylinder.chamber_b .* below a vacuum"
    with pytest.warns(UserWarning, match=said) if jumps or hydraulics == "extended" else nullcontext():
        one, two = (
            signals(reference_crane(hydraulics, joint, "step", form, **CHANGES)) for form in ("components", "bonds")
        )
    assert len(one) == {"simplified": 7, "extended": 12}[hydraulics]
    assert_equal(two, one)


def test_parts_of_bonds_and_components_mix() -> None:
    bonds = reference_crane("extended", "compliant", "sine", form="bonds")
    mixed = ac.redeclare(bonds, {"cylinder": hydraulic.ExtendedCylinder()})
    assert_equal(signals(mixed), signals(reference_crane("extended", "compliant", "sine")))


def test_derivative_causality_and_storages() -> None:
    """The rigid joint makes the boom's inertia depend on the piston's; each compliance is a state."""
    states = {
        (h, j): len(ac.compile(reference_crane(h, j, form="bonds")).states)  # type: ignore[arg-type]
        for h in ("simplified", "extended")
        for j in ("compliant", "rigid")
    }
    # one more than with components: a bond graph has the displacement of the gap beside the positions of its sides,
    # or both positions where the joint binds velocities
    assert states == {("simplified", "compliant"): 5, ("simplified", "rigid"): 3} | {
        ("extended", "compliant"): 13,
        ("extended", "rigid"): 11,
    }


def test_unknown_form() -> None:
    with pytest.raises(ValueError, match="form='graph' is neither 'components' nor 'bonds'"):
        reference_crane(form="graph")  # type: ignore[arg-type]
