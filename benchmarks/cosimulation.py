"""The crane's co-simulation beside the paper's Table 2; accuracy and cost against the macro step; the adaptive master.

python -m benchmarks.cosimulation

Draws the figures of docs/kbc.md too.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from benchmarks.results import DOCS, Section, write
from models.kbc.cosimulation_demo import (
    QUICK,
    Experiment,
    Extent,
    adaptive_table,
    draw,
    experiment,
    sweep_table,
    table_2,
)

COMMAND = "python -m benchmarks.cosimulation"
TABLE_2 = """The extended, compliant crane, scenario *sine*, cut between joint and boom: macro step 10 ms, Jacobi,
inputs extrapolated linearly. RK4 takes steps of 0.01 ms, Adams and Rodas5P have rtol 1e-6. *RTF*: run time of the
master with all participants by simulated time. *RMSE*: of the piston displacement, over {table:g} s, from the same
model in one piece at rtol 1e-9; of the rigid model in one piece it is what leaving out the joint's compliance costs.
*Energy made*: largest energy residual of the cut, of the energy that passed through it. The paper's figures are of its
crane, with 20-sim and AgX, on its machine."""
SWEEP = """RMSE [mm] of the piston displacement over {sweep:g} s, by method of the master and degree of the
extrapolation, Rodas5P at rtol 1e-6 in both participants. The last row is a macro step with which the co-simulation
holds while one 1.1 times as long diverges. It *diverges* where a prediction is off by as much as the
signal is large."""
ADAPTIVE = """Adaptive macro step (by the error of the predicted inputs) over {table:g} s, and the smallest number of
equal macro steps found that is as accurate. *Saved* counts the steps that were taken back as steps."""


def sections(found: Experiment) -> list[Section]:
    """The three tables."""
    extent = {"table": found.extent.table, "sweep": found.extent.sweep}
    made: list[Section] = []
    for key, title, text, table in (
        ("cosim-table-2", "Co-simulation of the crane", TABLE_2, table_2(found)),
        ("cosim-macro-step", "Co-simulation: accuracy against the macro step", SWEEP, sweep_table(found)),
        ("cosim-adaptive", "Co-simulation: adaptive macro step", ADAPTIVE, adaptive_table(found)),
    ):
        made.append(Section(key, title, COMMAND, text.format(**extent), *table))
    return made


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="a short one; prints the tables and writes nothing")
    parser.add_argument("--figures", type=Path, default=DOCS / "images" / "kbc", help="folder of the figures")
    chosen = parser.parse_args(words)
    found = experiment(QUICK if chosen.quick else Extent(), lambda what: print(f"  {what}", flush=True))
    for section in sections(found):
        if chosen.quick:
            print(section.markdown())
        else:
            write(section)
    if not chosen.quick:
        draw(found, chosen.figures)
    return 0


if __name__ == "__main__":
    sys.exit(main())
