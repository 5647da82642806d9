"""The RC ladder from resistor, capacitor, ground and source components, in any length.

    python -m benchmarks.ladder                     # how compilation grows with the number of cells
    python -m benchmarks.ladder --engine diffrax    # the same for the other engine
    python -m benchmarks.ladder --peers             # side by side with other Modelica compilers for Python

`--peers` needs the `bench` extra. A peer that needs another interpreter: `--peer-python modelica=/path/to/python`.
"""

from __future__ import annotations

import argparse
import sys
from typing import TYPE_CHECKING, Any

import numpy as np

from benchmarks.exact import ladder_nodes, ladder_voltage
from benchmarks.measure import child
from benchmarks.models import ladder
from benchmarks.results import Section, seconds, write
from benchmarks.scaling import Case, arguments, run

if TYPE_CHECKING:
    from acausal import Solution

PEERS = ("rumoca", "pymoca", "modelica")
PEER_SIZES = (10, 100, 1_000)


def error(cells: int, solution: Solution) -> float:
    """Largest deviation from the closed form at the first node, the middle one and the open end."""
    t = np.asarray(solution.t)
    return max(
        float(np.max(np.abs(solution[f"cells[{k - 1}].capacitor.v"] - ladder_voltage(k, cells, t))))
        for k in ladder_nodes(cells)
    )


CASE = Case(
    name="ladder",
    title="RC ladder",
    text="A line of N cells (R to the next node, C to ground) behind a source of 1 V, 1 ohm and 1 F in all, 0 to 1 s.",
    make=ladder,
    t1=1.0,
    error=error,
)


def beside_peers(chosen: argparse.Namespace) -> None:
    """The ladder in this package and in the others, one process each, one after the other."""
    rows: list[tuple[str, ...]] = []
    for cells in [n for n in chosen.cells if n in PEER_SIZES] or PEER_SIZES:
        ours, problem = child(["benchmarks.ladder", "--one", str(cells)], chosen.timeout)
        if ours is None:
            raise SystemExit(f"the ladder of {cells} cells failed: {problem}")
        ours_total = ours["instantiate"] + ours["translate"] + ours["first"]
        rows.append(
            _row(cells, "acausal", ours_total - ours["run"], ours["run"], ours["error"], ours_total, ours["cpu"])
        )
        for peer in PEERS:
            python = chosen.peer_python.get(peer, sys.executable)
            found, problem = child(["benchmarks.peers.run", peer, "--cells", str(cells)], chosen.peer_timeout, python)
            if found is None or "missing" in found:
                why = problem if found is None else "not installed"
                rows.append((f"{cells:,}", peer, "", "", why[:60], "", "", ""))
                continue
            label = f"{peer} {found['version']} ({found['configuration']})"
            rows.append(_row(cells, label, found["compile"], found["solve"], found["error"], ours_total, found["cpu"]))
    text = (
        "The ladder of the sections above, for the others as Modelica text with the same classes and connections. All "
        "give 101 points at rtol 1e-6 and atol 1e-9. *Ratio* is the tool's total divided by ours. Each row is a new "
        "process; imports are not counted. Ours is the native engine with an empty cache, the C compiler included."
    )
    header = ("cells", "tool", "compile", "solve", "total", "ratio", "CPU seconds", "error")
    command = "python -m benchmarks.ladder --peers"
    write(Section("ladder-peers", "RC ladder beside other tools", command, text, header, rows))


def _row(
    cells: int, tool: str, compiling: float, solving: float, error: float, ours: float, cpu: float
) -> tuple[str, ...]:
    total = compiling + solving
    numbers = (
        seconds(compiling),
        seconds(solving),
        seconds(total),
        f"{total / ours:.3g}",
        seconds(cpu),
        f"{error:.1e}",
    )
    return (f"{cells:,}", tool, *numbers)


def _interpreter(word: str) -> tuple[str, str]:
    peer, equals, python = word.partition("=")
    if not equals or peer not in PEERS:
        raise argparse.ArgumentTypeError(f"write PEER=PYTHON with a peer of {', '.join(PEERS)}")
    return peer, python


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = arguments(__doc__)
    parser.add_argument("--peers", action="store_true", help="side by side with other tools")
    parser.add_argument("--peer-python", type=_interpreter, action="append", default=[], metavar="PEER=PYTHON")
    parser.add_argument("--peer-timeout", type=float, default=300.0, help="seconds for each peer and size")
    chosen: Any = parser.parse_args(words)
    chosen.peer_python = dict(chosen.peer_python)
    if chosen.peers and chosen.one is None:
        beside_peers(chosen)
    else:
        run(CASE, chosen)
    return 0


if __name__ == "__main__":
    sys.exit(main())
