"""Trajectories of the Modelica Standard Library, and its official tube of 2e-3 around them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac

DATA = Path(__file__).parents[1] / "reference" / "msl"


def read(name: str) -> tuple[list[str], np.ndarray]:
    """Column names and values of a reference trajectory; repeated times are dropped."""
    path = DATA / f"{name}.csv"
    header = path.read_text(encoding="utf-8").splitlines()[0].replace('"', "").split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    return header, values[np.concatenate([[True], np.diff(values[:, 0]) > 0])]


def assert_within(
    name: str, model: ac.Component, engine: Any = "auto", *, still: float = 0.0, rtol: float = 1e-8
) -> None:
    """All signals of a reference trajectory are within 2e-3 of their range; `still`: range of those that rest."""
    header, values = read(name)
    t = values[:, 0]
    solution = ac.compile(model).simulate(t1=float(t[-1]), saveat=t, rtol=rtol, engine=engine)
    for column, signal in enumerate(header[1:], start=1):
        reference = values[:, column]
        error = np.max(np.abs(np.asarray(solution[signal]) - reference))
        rounding = 1e-10 * np.max(np.abs(reference))
        assert error <= 2e-3 * (np.ptp(reference) or still or rounding), f"{signal}: {error}"
