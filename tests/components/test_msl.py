"""Library components against reference trajectories of the Modelica Standard Library, in its official tube of 2e-3."""

from __future__ import annotations

import pytest

import acausal as ac

from .examples import First, Oscillator, TwoMasses
from .msl import CauerLowPassAnalog, ElastoGap, PID_Controller
from .msl_multibody import Fourbar1, Pendulum
from .tube import assert_within

MODELS = [First(), Oscillator(), TwoMasses(), ElastoGap(), CauerLowPassAnalog(), PID_Controller(), Pendulum(),
          Fourbar1()]  # fmt: skip


@pytest.mark.parametrize("model", MODELS, ids=lambda m: type(m).__name__)
def test_within_the_tube(model: ac.Component) -> None:
    assert_within(type(model).__name__, model, still=1.0)
