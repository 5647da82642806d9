"""Electrical examples of the Modelica Standard Library against its official trajectories, in the tube of 2e-3."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_switching
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "Resistor": msl_switching.resistor, "ControlledSwitchWithArc": msl_switching.controlled_switch_with_arc,
    "SimpleTriacCircuit": msl_switching.simple_triac_circuit, "NandGate": msl_switching.nand_gate,
}  # fmt: skip


@pytest.mark.parametrize("engine", ["native", pytest.param("diffrax", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)
