"""What a new process waits for: `import acausal`, and the first trajectory of the extended crane.

python -m benchmarks.cold_start
"""

from __future__ import annotations

import os
import subprocess
import sys
import time

from benchmarks.measure import ROOT
from benchmarks.results import Section, seconds, write

REPEATS = 5
CRANE = """
import os
os.environ["JAX_ENABLE_X64"] = "1"
import acausal as ac
from models.kbc import reference_crane
system = ac.compile(reference_crane(hydraulics={hydraulics!r}, joint={joint!r}))
print(float(system.simulate(t1=20.0)["x"][-1]))
"""


def spent(code: str, repeats: int) -> tuple[float, float]:
    """Wall and CPU seconds of a new process that runs `code`, the best of `repeats` of each."""
    wall, cpu = float("inf"), float("inf")
    for _ in range(repeats):
        begin, before = time.perf_counter(), os.times()
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True)
        after = os.times()
        wall = min(wall, time.perf_counter() - begin)
        cpu = min(cpu, after.children_user + after.children_system - before.children_user - before.children_system)
    return wall, cpu


def main() -> int:
    """Run the benchmark."""
    cases = [
        ("an empty Python process", "pass", REPEATS),
        ("`import acausal`", "import acausal", REPEATS),
        ("`import jax, diffrax`", "import jax, diffrax", 2),
    ]
    for hydraulics, joint in (("extended", "compliant"), ("extended", "rigid")):
        name = f"crane {hydraulics}-{joint}: import, compile, simulate 20 s"
        cases.append((name, CRANE.format(hydraulics=hydraulics, joint=joint), 2))
    rows = [(name, *map(seconds, spent(code, repeats))) for name, code, repeats in cases]
    text = (
        "From the start of a new process to its end, the best of several. `import acausal` does not load JAX; "
        "`ac.compile` does. A processor that does other work too makes the wall time longer, the CPU time hardly."
    )
    header = ("what", "wall [s]", "CPU [s]")
    write(Section("cold-start", "Cold start", "python -m benchmarks.cold_start", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
