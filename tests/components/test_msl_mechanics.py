"""Examples of Modelica.Mechanics against its official trajectories, in the tube of 2e-3 (see `test_msl_official`)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

import acausal as ac

from . import msl_signals, msl_slides
from .tube import assert_within

MODELS: dict[str, Callable[[], ac.Component]] = {
    "TranslationalHeatLosses": msl_slides.heat_losses,
    "RotationalGenerationOfFMUs": msl_signals.rotational_signals,
    "TranslationalGenerationOfFMUs": msl_signals.translational_signals,
}


@pytest.mark.parametrize("engine", ["native", pytest.param("diffrax", marks=pytest.mark.slow)])
@pytest.mark.parametrize("name", MODELS)
def test_within_the_tube(name: str, engine: Any) -> None:
    assert_within(name, MODELS[name](), engine)
