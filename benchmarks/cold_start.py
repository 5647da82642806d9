"""What a new process waits for: `import acausal`, and the first trajectory of the extended crane.

python -m benchmarks.cold_start
"""

from __future__ import annotations

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


def spent(code: str, repeats: int) -> float:
    """Wall seconds of a new process that runs `code`, the best of `repeats`."""
    best = float("inf")
    for _ in range(repeats):
        begin = time.perf_counter()
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True)
        best = min(best, time.perf_counter() - begin)
    return best


def main() -> int:
    """Run the benchmark."""
    empty = spent("pass", REPEATS)
    rows = [
        ("an empty Python process", seconds(empty)),
        ("`import acausal`, beyond that", seconds(spent("import acausal", REPEATS) - empty)),
        ("`import jax, diffrax`, beyond that", seconds(spent("import jax, diffrax", 2) - empty)),
    ]
    for hydraulics, joint in (("extended", "compliant"), ("extended", "rigid")):
        took = spent(CRANE.format(hydraulics=hydraulics, joint=joint), 2)
        rows.append((f"process start to result: crane {hydraulics}-{joint}, 20 s simulated", seconds(took)))
    text = "Wall seconds, the best of several new processes. `import acausal` does not load JAX; `simulate` does."
    write(Section("cold-start", "Cold start", "python -m benchmarks.cold_start", text, ("what", "seconds"), rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
