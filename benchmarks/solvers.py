"""Integrators on the extended crane: the same vector field, tolerances and error norm, alternating in one process.

python -m benchmarks.solvers
"""

from __future__ import annotations

import argparse
import sys
from typing import Any

import numpy as np

from benchmarks.results import Section, seconds, write

T_END, POINTS = 20.0, 401
TOLERANCES = (1e-4, 1e-6)


def _error(solution: Any, reference: Any) -> float:
    """Largest deviation of a state, relative to its range."""
    return float(np.max(np.abs(solution.x - reference.x) / np.ptp(reference.x, axis=0)))


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=3, help="runs of each, the best counts")
    chosen = parser.parse_args(words)

    import diffrax

    import acausal as ac
    from models.kbc import reference_crane

    system = ac.compile(reference_crane(hydraulics="extended", joint="compliant"))
    solvers = {"Rodas5P": None, "Kvaerno5": diffrax.Kvaerno5()}
    reference = system.simulate(T_END, rtol=1e-10, saveat=POINTS)
    rows: list[tuple[str, ...]] = []
    for rtol in TOLERANCES:
        best: dict[str, Any] = {}
        compiling: dict[str, float] = {}
        for _ in range(chosen.repeat):
            for name, solver in solvers.items():
                solution = system.simulate(
                    T_END, rtol=rtol, solver=solver, saveat=POINTS, engine="diffrax", events=False
                )
                compiling[name] = max(compiling.get(name, 0.0), solution.stats["compile_seconds"])
                if name not in best or solution.stats["run_seconds"] < best[name].stats["run_seconds"]:
                    best[name] = solution
        fastest = best["Rodas5P"].stats["run_seconds"]
        for name, solution in best.items():
            run, steps = solution.stats["run_seconds"], solution.stats["steps"]
            figures = (seconds(run), f"{run / fastest:.1f}", f"{steps:,}", f"{1e6 * run / steps:.0f}")
            compiled = seconds(compiling[name]) if compiling[name] else ""
            rows.append((f"{name}, rtol {rtol:.0e}", *figures, f"{_error(solution, reference):.1e}", compiled))

    text = (
        f"The extended compliant crane (12 states), scenario *sine*, 0 to {T_END:g} s, both in the diffrax engine, "
        "on one vector field, without the location of events: run time of the compiled solve, "
        f"the best of {chosen.repeat} alternating runs. *Error* is the largest deviation of any state from a run at "
        "rtol 1e-10, relative to its range. Compiling (tracing and XLA) happens once for each solver."
    )
    header = ("solver", "run [s]", "to Rodas5P", "steps", "a step [us]", "error", "compile [s]")
    write(Section("solvers", "Integrators", "python -m benchmarks.solvers", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
