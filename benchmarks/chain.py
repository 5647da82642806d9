"""A bar of N springs, dampers and pairs of rigidly joined masses (index 3), in any length.

python -m benchmarks.chain
"""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.exact import chain_displacement, ladder_nodes
from benchmarks.models import CHAIN_DAMPING, CHAIN_MASS, CHAIN_STIFFNESS, chain
from benchmarks.scaling import Case, arguments, run

if TYPE_CHECKING:
    from acausal import Solution

SIZES = (10, 100, 1_000, 10_000)


def error(cells: int, solution: Solution) -> float:
    """Largest deviation from the closed form of the first, the middle and the last cell's displacement."""
    t = np.asarray(solution.t)
    worst = 0.0
    for k in ladder_nodes(cells):
        position = np.asarray(solution[f"cells[{k - 1}].second.s"])
        exact = chain_displacement(k, cells, t, CHAIN_STIFFNESS, CHAIN_DAMPING, CHAIN_MASS)
        worst = max(worst, float(np.max(np.abs(position - position[0] - exact))))
    return worst


CASE = Case(
    name="chain",
    title="Chain of masses, springs and dampers with rigidly joined pairs",
    text=(
        "A bar of N cells, each a spring and damper and two masses rigidly joined, fixed at one end and pulled with "
        "1 N at the other, 0 to 2 s. The force in each joint is an unknown, so every pair is differentiated twice."
    ),
    make=chain,
    t1=2.0,
    error=error,
)


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = arguments(__doc__)
    parser.set_defaults(cells=list(SIZES))
    run(CASE, parser.parse_args(words))
    return 0


if __name__ == "__main__":
    sys.exit(main())
