"""`python -m benchmarks`: every table, one after the other."""

import importlib.util
import subprocess
import sys

from benchmarks.measure import ROOT

COMMANDS = (
    ["benchmarks.cold_start"],
    ["benchmarks.compile_time"],
    ["benchmarks.ladder"],
    ["benchmarks.ladder", "--engine", "diffrax"],
    ["benchmarks.ladder", "--peers"],
    ["benchmarks.chain"],
    ["benchmarks.chain", "--engine", "diffrax"],
    ["benchmarks.solvers"],
    ["benchmarks.work_precision"],
    ["benchmarks.paper_table"],
    ["benchmarks.fmu"],
    ["benchmarks.cosimulation"],
    ["benchmarks.gradients"],
    ["benchmarks.ensembles"],
    ["benchmarks.calibration"],
)


def main() -> int:
    """Run all benchmarks; returns how many failed."""
    failed = 0
    for command in COMMANDS:
        if importlib.util.find_spec(command[0]) is None:
            continue
        print(f"== python -m {' '.join(command)}", flush=True)
        failed += subprocess.run([sys.executable, "-m", *command], cwd=ROOT, check=False).returncode != 0
    return failed


if __name__ == "__main__":
    sys.exit(main())
