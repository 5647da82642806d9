"""Random hybrid programs on the engines and as exported units, against an interpreter written by hand."""

from __future__ import annotations

import bisect
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac

from .programs import END, Endless, Interpreter, Undecided, Writer, model

TIMES = np.linspace(0.0, END, 31)
FEW, MORE = range(20), range(20, 500)


def expected(program: Any) -> dict[str, Any]:
    """Values at `TIMES`; nan at those of events."""
    corners = Interpreter(program).run()
    starts = [corner[0] for corner in corners]
    rows: list[list[float]] = []
    for t in TIMES.tolist():
        k = min(bisect.bisect_right(starts, t) - 1, len(corners) - 2)
        (t0, x0, n, b), (t1, x1, *_) = corners[k : k + 2]
        at = (t - t0) / (t1 - t0) if t1 > t0 else 0.0
        values = [*((1.0 - at) * np.array(x0) + at * np.array(x1)), *n, *b]
        rows.append([np.nan] * len(values) if any(abs(t - s) < 1e-6 for s in starts[1:-1]) else values)
    names = [f"{kind}{k}" for kind, of in zip("xnb", corners[0][1:], strict=True) for k in range(len(of))]
    return dict(zip(names, np.array(rows).T, strict=True))


def check(found: Any, wanted: dict[str, Any], seed: int) -> None:
    for name, values in wanted.items():
        known = np.isfinite(values)
        np.testing.assert_allclose(np.asarray(found[name])[known], values[known], atol=1e-6, err_msg=f"{seed}: {name}")


def compare(seed: int, engine: Any) -> str:
    """Run a program both ways; what came of it."""
    program = Writer(seed).program
    try:
        wanted = expected(program)
    except Undecided:
        return "undecided"
    except Endless:
        with pytest.raises(ac.SimulationError):
            ac.compile(model(program)).simulate(END, engine=engine)
        return "endless"
    check(ac.compile(model(program)).simulate(END, saveat=TIMES, rtol=1e-9, engine=engine), wanted, seed)
    return "same"


def test_random_programs() -> None:
    assert [compare(seed, "native") for seed in FEW].count("same") > 0.7 * len(FEW)


@pytest.mark.slow
def test_many_random_programs() -> None:
    outcomes = [compare(seed, "native") for seed in MORE]
    assert outcomes.count("same") > 0.7 * len(MORE) and "endless" in outcomes


@pytest.mark.slow
def test_random_programs_on_the_diffrax_engine() -> None:
    assert [compare(seed, "diffrax") for seed in FEW].count("same") > 0.7 * len(FEW)


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["ModelExchange", "CoSimulation"])
def test_random_programs_as_exported_units(kind: Any, tmp_path: Path) -> None:
    fmpy = pytest.importorskip("fmpy")
    compared = 0
    for seed in FEW:
        program = Writer(seed).program
        try:
            wanted = expected(program)
        except (Endless, Undecided):
            continue
        unit = ac.fmi.export(ac.compile(model(program)), tmp_path / f"{seed}.fmu")
        found = fmpy.simulate_fmu(
            str(unit), stop_time=END, output_interval=END / 30, fmi_type=kind, output=list(wanted),
            relative_tolerance=1e-9,
        )  # fmt: skip
        rows = [int(np.flatnonzero(np.abs(found["time"] - t) < 1e-9)[-1]) for t in TIMES]
        check(found[rows], wanted, seed)
        compared += 1
    assert compared > 0.7 * len(FEW)
