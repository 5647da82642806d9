"""The same model gives the same system in every process, whatever the hash seed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

CODE = """
import re
import acausal as ac
from models.kbc import reference_crane

for joint in ("compliant", "rigid"):
    system = ac.compile(reference_crane("extended", joint))
    print(re.sub(r"seconds.*", "", str(system.report())))
    for form in ("flat", "reduced", "sorted"):
        print(system.equations(form))
    print(system.states, system.algebraics, system.observed, list(system.parameters))
    print(system.lowered.sparsity().indices.tolist())
"""


def test_two_processes_compile_to_the_same() -> None:
    root = Path(__file__).parents[2]
    outputs = []
    for seed in ("1", "2"):
        environment = {**os.environ, "PYTHONHASHSEED": seed, "PYTHONPATH": str(root)}
        run = subprocess.run([sys.executable, "-c", CODE], capture_output=True, text=True, check=True, env=environment)
        outputs.append(run.stdout)
    assert "der(cylinder" in outputs[0]
    assert outputs[0] == outputs[1]


def test_compiling_twice_in_one_process() -> None:
    import acausal as ac

    from .parts import RC

    one, two = ac.compile(RC()), ac.compile(RC())
    assert one.equations("sorted") == two.equations("sorted")
    assert one.states == two.states
