"""PyFMI, an importer on top of FMI Library and Assimulo's CVODE with event handling, against `simulate`.

It has no wheels and asks for an older NumPy than this package, so it runs in an interpreter of its own: the environment
variable ``PYFMI_PYTHON`` names one that has it (built from the sources of FMI Library, Assimulo and PyFMI).
"""

from __future__ import annotations

import importlib.util
import json
import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from models.kbc import reference_crane

from .export_models import Balanced, Ball, Chain, Implicit, Oscillator, Rectifier, Sampled, Thermostat

SCRIPT = """
import json, sys
import numpy as np
import pyfmi

path, kind, t1, points, names, scales = json.loads(sys.argv[1])
unit = pyfmi.load_fmu(path, kind=kind, log_level=1)
options = unit.simulate_options()
options.update(ncp=points - 1, result_handling="binary")
if kind == "ME":
    options["CVode_options"].update(rtol=1e-10, atol=[1e-12 * scales[n] for n in unit.get_states_list()])
found = unit.simulate(final_time=t1, options=options)
t = np.linspace(0.0, t1, points)
at = [np.flatnonzero(np.abs(found["time"] - v) <= 1e-12 * t1)[-1] for v in t]  # after events
print("RESULT" + json.dumps({n: np.asarray(found[n])[at].tolist() for n in names}))
"""
CASES = [(kind, version) for version in ("2.0", "3.0") for kind in ("ME", "CS") if (kind, version) != ("CS", "3.0")]
"""PyFMI does not import co-simulation of FMI 3.0."""


def interpreter() -> str:
    found = os.environ.get("PYFMI_PYTHON")
    if found is None and importlib.util.find_spec("pyfmi") is None:
        pytest.skip("pyfmi is not installed, and PYFMI_PYTHON does not name an interpreter that has it")
    return found or sys.executable


def deviation(model: Any, kind: str, version: str, folder: Path, t1: float, points: int) -> float:
    """Largest deviation of a state from `simulate`, relative to its range."""
    python, system = interpreter(), ac.compile(model)
    path = ac.fmi.export(system, folder / "unit.fmu", version=version, tolerance=1e-10)
    wanted = system.simulate(t1, saveat=points, rtol=1e-11)
    names = list(system.states)
    scales = {n: max(float(np.abs(wanted[n]).max()), 1e-3) for n in names}
    given = json.dumps([str(path), kind, t1, points, names, scales])
    ran = subprocess.run([python, "-c", SCRIPT, given], cwd=folder, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr[-2000:]
    (line,) = (x for x in ran.stdout.splitlines() if x.startswith("RESULT"))
    found = json.loads(line.removeprefix("RESULT"))
    return max(float(np.abs(np.array(found[n]) - wanted[n]).max() / np.ptp(wanted[n])) for n in names)


@pytest.mark.parametrize(("kind", "version"), CASES)
@pytest.mark.parametrize("model", [Oscillator, Implicit, Balanced, Chain, Ball, Thermostat, Sampled, Rectifier])
def test_small_models(model, kind, version, tmp_path):
    worst = deviation(model(), kind, version, tmp_path, 2.03, 30)
    print(model.__name__, kind, version, worst)
    assert worst <= 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(("kind", "version"), CASES)
@pytest.mark.parametrize("joint", ["rigid", "compliant"])
def test_the_crane(joint, kind, version, tmp_path):
    """The compliant one begins on the other side of a valve's switch, as event iteration has to find."""
    worst = deviation(reference_crane(hydraulics="extended", joint=joint), kind, version, tmp_path, 10.0, 1001)
    print(joint, kind, version, worst)
    assert worst <= 1e-6
