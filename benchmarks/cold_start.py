"""What a new process waits for: `import acausal`, and the first trajectory of the extended crane.

python -m benchmarks.cold_start
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from benchmarks.measure import ROOT
from benchmarks.results import Section, seconds, write

REPEATS = 5
CRANE = """
import os
os.environ["JAX_ENABLE_X64"] = "1"
import acausal as ac
from models.kbc import reference_crane
system = ac.compile(reference_crane(hydraulics={hydraulics!r}, joint={joint!r}))
print(float(system.simulate(t1=20.0, engine={engine!r})["x"][-1]))
"""


def spent(code: str, repeats: int, cache: Path, keep: bool = True) -> tuple[float, float]:
    """Wall and CPU seconds of a new process that runs `code`, the best of `repeats` of each.

    Args:
        code: Python code.
        repeats: number of processes.
        cache: folder of compiled models.
        keep: whether it stays from one process to the next; else each begins with an empty one.
    """
    wall, cpu = float("inf"), float("inf")
    for _ in range(repeats):
        if not keep:
            shutil.rmtree(cache, ignore_errors=True)
        begin, before = time.perf_counter(), os.times()
        env = {**os.environ, "ACAUSAL_CACHE": str(cache)}
        subprocess.run([sys.executable, "-c", code], cwd=ROOT, check=True, capture_output=True, env=env)
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
    rows: list[tuple[str, ...]] = []
    with tempfile.TemporaryDirectory() as folder:
        cache = Path(folder) / "cache"
        rows += [(name, *map(seconds, spent(code, repeats, cache))) for name, code, repeats in cases]
        for joint in ("compliant", "rigid"):
            name = f"crane extended-{joint}: import, compile, simulate 20 s"
            native = CRANE.format(hydraulics="extended", joint=joint, engine="native")
            portable = CRANE.format(hydraulics="extended", joint=joint, engine="diffrax")
            rows.append((f"{name}, native engine, empty cache", *map(seconds, spent(native, 3, cache, keep=False))))
            rows.append((f"{name}, native engine, warm cache", *map(seconds, spent(native, 3, cache))))
            rows.append((f"{name}, diffrax engine", *map(seconds, spent(portable, 2, cache))))
    text = (
        "From the start of a new process to its end, the best of several; `import acausal` does not load "
        "JAX. A processor that does other work too makes the wall time longer, the CPU time hardly."
    )
    header = ("what", "wall [s]", "CPU [s]")
    write(Section("cold-start", "Cold start", "python -m benchmarks.cold_start", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
