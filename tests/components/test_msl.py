"""Library components against reference trajectories of the Modelica Standard Library, in its official tube of 2e-3."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import acausal as ac

from .examples import First, Oscillator, TwoMasses
from .msl import CauerLowPassAnalog, ElastoGap, PID_Controller
from .msl_multibody import Fourbar1, Pendulum

DATA = Path(__file__).parents[1] / "reference" / "msl"


def read(name: str) -> tuple[list[str], np.ndarray]:
    """Column names and values of a reference trajectory; repeated times are dropped."""
    path = DATA / f"{name}.csv"
    header = path.read_text(encoding="utf-8").splitlines()[0].replace('"', "").split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    return header, values[np.concatenate([[True], np.diff(values[:, 0]) > 0])]


MODELS = [First(), Oscillator(), TwoMasses(), ElastoGap(), CauerLowPassAnalog(), PID_Controller(), Pendulum(),
          Fourbar1()]  # fmt: skip


@pytest.mark.parametrize("model", MODELS, ids=lambda m: type(m).__name__)
def test_within_the_tube(model: ac.Component) -> None:
    header, values = read(type(model).__name__)
    t = values[:, 0]
    solution = ac.compile(model).simulate(t1=float(t[-1]), saveat=t, rtol=1e-8)
    for column, name in enumerate(header[1:], start=1):
        reference = values[:, column]
        error = np.max(np.abs(np.asarray(solution[name]) - reference))
        assert error <= 2e-3 * (np.ptp(reference) or 1.0), f"{name}: {error}"
