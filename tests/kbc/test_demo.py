"""The demo: its table, its figures, and that it tells the truth about the four variants."""

import csv
import dataclasses
from pathlib import Path

import numpy as np
import pytest

from acausal.cli import main
from models.kbc.demo import VARIANTS, Row, Run, draw, format_table

FIGURES = ["fig11_displacement.png", "fig12_deviation.png", "fig13_flow.png", "fig14_pressure.png"]


def test_table_is_aligned_and_leaves_out_the_deviation_from_itself() -> None:
    first = Row("extended-compliant", 12, 1, 1000, 9.0, 0.5, 0.025, 0.0, 0.04)
    lines = format_table(
        [first, dataclasses.replace(first, variant="simplified-rigid", rmse_extended=3e-2)]
    ).splitlines()
    assert len({len(line) for line in lines}) == 1
    assert "  -  " in lines[2]
    assert "3.00e-02" in lines[3]


def test_figures_are_drawn(tmp_path: Path) -> None:
    t = np.linspace(0.0, 20.0, 11)
    runs = {f"{h}-{j}": Run(t, t + 1, t / 1e3, t * 1e5) for h, j in VARIANTS}
    paths = draw(t, runs, tmp_path)
    assert [path.name for path in paths] == FIGURES
    assert all(path.read_bytes().startswith(b"\x89PNG") for path in paths)


@pytest.mark.slow
def test_demo_simulates_the_four_variants(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["demo", "--out", str(tmp_path / "demo")]) == 0
    printed = capsys.readouterr().out
    assert all(str(tmp_path / "demo" / name) in printed for name in FIGURES)
    with (tmp_path / "demo" / "results.csv").open() as file:
        rows = {row["variant"]: row for row in csv.DictReader(file)}
    found = {name: (int(row["states"]), int(row["structural_index"])) for name, row in rows.items()}
    assert found["extended-rigid"] == (10, 3)
    assert found["simplified-rigid"] == (2, 3)
    assert found["extended-compliant"][0] == 12
    assert found["simplified-compliant"][0] == 4
    assert float(rows["extended-rigid"]["rmse_extended"]) < 2e-3
    assert float(rows["simplified-rigid"]["rmse_extended"]) < 5e-2
