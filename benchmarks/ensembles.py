"""A Monte-Carlo ensemble of the crane: time of a member beside a single solve, on one thread and on two.

python -m benchmarks.ensembles
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

from benchmarks.calibration import TRUE
from benchmarks.peers.integrators import best
from benchmarks.results import Section, write
from models.kbc import reference_crane

T_END, POINTS, SINGLE = 20.0, 201, 200


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--members", type=int, default=1000)
    parser.add_argument("--threads", type=int, nargs="+", default=[1, 2])
    chosen = parser.parse_args(words)
    import acausal as ac

    system = ac.compile(reference_crane(hydraulics="extended", joint="compliant"), outputs=("x",))
    spread = {name: ac.LogNormal(value, 0.03) for name, value in TRUE.items()}
    table = ac.draw(spread, chosen.members, method="lhs")
    rows_of: list[dict[str, Any]] = table.to_dict("records")

    def singly() -> None:
        for given in rows_of[:SINGLE]:
            system.simulate(T_END, parameters=given, saveat=POINTS)["x"]

    single = best(singly, 3)[0] / min(SINGLE, len(rows_of))
    rows: list[tuple[str, ...]] = [("single `simulate`", "", f"{single:.3g}", "1", "")]
    one_thread = 0.0
    for threads in chosen.threads:
        spent = float("inf")
        for _ in range(3):
            begin = time.perf_counter()
            system.ensemble(table, T_END, saveat=POINTS, workers=threads, progress=False)
            spent = min(spent, time.perf_counter() - begin)
        one_thread = one_thread or spent
        core = 1e3 * spent * threads / chosen.members
        figures = (f"{spent:.3g}", f"{core:.3g}", f"{core / single:.2f}", f"{one_thread / spent:.2f}")
        rows.append((f"ensemble, {threads} thread{'s' if threads > 1 else ''}", *figures))
    text = (
        f"{chosen.members:,} members of the extended-compliant crane, 20 s each at rtol 1e-6, four parameters by Latin "
        "hypercube, the piston's displacement at 201 times kept. The single solve is `simulate` in a loop over the "
        "first members; everything is the best of 3."
    )
    header = ("what", "in all [s]", "a member and core [ms]", "to the single solve", "speedup")
    write(Section("ensembles", "Ensembles", "python -m benchmarks.ensembles", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
