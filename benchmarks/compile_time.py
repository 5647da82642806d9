"""Compile time of fixed models in CPU seconds, against stored baselines.

    python -m benchmarks.compile_time             # measure and write the table
    python -m benchmarks.compile_time --check     # exit 1 if a model got slower than its baseline allows
    python -m benchmarks.compile_time --update    # store what is measured as the new baseline

The baselines are in `benchmarks/baselines/compile_time.json`, with the CPU seconds that a fixed piece of Python and XLA
work took when they were stored; `--check` scales by what the same work takes now, so that another machine can check.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from benchmarks.measure import Measurement, child, emit, measure
from benchmarks.results import Section, seconds, write

BASELINES = Path(__file__).with_name("baselines") / "compile_time.json"
SLACK, GRACE = 1.3, 0.5
"""A model may take this many times its baseline, and this many CPU seconds more."""


def _ladder(cells: int) -> Callable[[], Measurement]:
    def work() -> Measurement:
        from benchmarks.models import ladder

        return measure(lambda: ladder(cells), 1e-3, 2)

    return work


def _chain(cells: int) -> Callable[[], Measurement]:
    def work() -> Measurement:
        from benchmarks.models import chain

        return measure(lambda: chain(cells), 1e-3, 2)

    return work


def _crane(hydraulics: Any, joint: Any) -> Callable[[], Measurement]:
    def work() -> Measurement:
        from models.kbc import reference_crane

        return measure(lambda: reference_crane(hydraulics=hydraulics, joint=joint), 1e-3, 2)

    return work


CASES: dict[str, Callable[[], Measurement]] = {
    "ladder-10": _ladder(10),
    "ladder-100": _ladder(100),
    "ladder-1000": _ladder(1_000),
    "ladder-10000": _ladder(10_000),
    "chain-1000": _chain(1_000),
    **{f"crane-{h}-{j}": _crane(h, j) for h in ("extended", "simplified") for j in ("compliant", "rigid")},
}


def yardstick() -> float:
    """CPU seconds of fixed work of the same kind: interpreted Python, and one XLA compilation."""
    import jax
    import jax.numpy as jnp

    def chained(x: Any) -> Any:
        for k in range(300):
            x = jnp.sin(x) * (1.0 + k) + x
        return x

    jax.block_until_ready(jnp.ones(3) + 1)
    begin = time.process_time()
    table: dict[tuple[int, str], int] = {}
    for k in range(600_000):
        table[(k % 5_003, "x")] = table.get((k % 4_999, "x"), 0) + k
    jax.jit(chained, compiler_options={}).lower(jnp.ones(3)).compile()
    return time.process_time() - begin


def measure_all(names: list[str]) -> dict[str, dict[str, float]]:
    """CPU seconds of each model, a new process each; the best of two."""
    found: dict[str, dict[str, float]] = {}
    for name in names:
        runs: list[dict[str, Any]] = []
        for _ in range(2):
            result, problem = child(["benchmarks.compile_time", "--one", name], 300)
            if result is None:
                raise SystemExit(f"{name} failed: {problem}")
            runs.append(result)
        best = min(runs, key=lambda r: r["cpu"])
        found[name] = {stage: best[stage] for stage in ("cpu", "translate", "prepare", "build")}
    return found


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="compare with the baselines; exit 1 if one is exceeded")
    parser.add_argument("--update", action="store_true", help="store new baselines")
    parser.add_argument(
        "--only", nargs="+", choices=list(CASES), default=list(CASES), metavar="MODEL", help="some models"
    )
    parser.add_argument("--one", choices=[*CASES, "yardstick"], help="measure one in this process and print JSON")
    chosen = parser.parse_args(words)
    if chosen.one == "yardstick":
        print(json.dumps({"seconds": yardstick()}))
        return 0
    if chosen.one:
        emit(CASES[chosen.one]())
        return 0
    measures = [child(["benchmarks.compile_time", "--one", "yardstick"], 120)[0] for _ in range(3)]
    now = min(m["seconds"] for m in measures if m is not None)
    found = measure_all(chosen.only)
    stored = (
        json.loads(BASELINES.read_text(encoding="utf-8")) if BASELINES.exists() else {"models": {}, "yardstick": now}
    )
    if chosen.update:
        models = {**stored["models"], **{k: {n: round(s, 3) for n, s in v.items()} for k, v in found.items()}}
        BASELINES.parent.mkdir(exist_ok=True)
        text = json.dumps({"yardstick": round(now, 3), "models": models}, indent=2) + "\n"
        BASELINES.write_text(text, encoding="utf-8")
    scale = now / stored["yardstick"]
    rows, slower = [], []
    for name, figures in found.items():
        base = stored["models"].get(name, {}).get("cpu")
        allowed = None if base is None else base * scale * SLACK + GRACE
        if allowed is not None and figures["cpu"] > allowed:
            slower.append(f"{name}: {figures['cpu']:.2f} CPU seconds, allowed {allowed:.2f}")
        columns = (figures["translate"], figures["prepare"], figures["build"], figures["cpu"])
        rows.append((name, *map(seconds, columns), "" if base is None else seconds(base * scale)))
    if chosen.check:
        print("\n".join(slower) or f"{len(found)} models compile within their baselines")
        return 1 if slower else 0
    text = (
        "Construction, compilation and a simulation of 1 ms in a new process, the best of two; imports are not counted."
    )
    header = ("model", "translate [s]", "write C [s]", "C compiler [s]", "in all [CPU s]", "baseline [CPU s]")
    write(Section("compile-time", "Compile time", "python -m benchmarks.compile_time", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
