"""Time what lies between a model and its trajectory, each size in a process of its own."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from acausal import Component, Solution

ROOT = Path(__file__).resolve().parent.parent
XLA_EVENT = "/jax/core/compile/backend_compile_duration"


@dataclass(frozen=True)
class Measurement:
    """Where the time of one model went; imports are not in it.

    Attributes:
        instantiate: constructing the model [s].
        translate: flatten .. lower [s].
        passes: seconds of each pass.
        prepare: writing the C or tracing with JAX, and initialization [s].
        build: the C compiler, or XLA [s].
        first: the whole first `simulate` [s].
        run: the integration [s].
        cpu: CPU seconds from construction to the first result.
        states: number of states.
        index: structural index.
        steps: steps of the integrator.
        error: largest deviation from the exact solution, or 0.
    """

    instantiate: float
    translate: float
    passes: dict[str, float]
    prepare: float
    build: float
    first: float
    run: float
    cpu: float
    states: int
    index: int
    steps: int
    error: float

    @property
    def compile(self) -> float:
        """Everything before the first step [s]."""
        return self.instantiate + self.translate + self.first - self.run

    @property
    def total(self) -> float:
        """From construction to the first result [s]."""
        return self.instantiate + self.translate + self.first


def measure(
    make: Callable[[], Component],
    t1: float,
    saveat: Any,
    error: Callable[[Solution], float] | None = None,
    **options: Any,
) -> Measurement:
    """Construct, compile and simulate a model once.

    Args:
        make: constructs the model.
        t1: end time [s].
        saveat: output times.
        error: deviation of the solution from the exact one.
        **options: of `System.simulate`.
    """
    os.environ.setdefault("JAX_ENABLE_X64", "1")
    import diffrax
    import jax

    import acausal as ac

    del diffrax  # imported here so that its import is not timed
    ac.compile  # noqa: B018
    ac.Rodas5P  # noqa: B018
    build: list[float] = []

    def heard(event: str, duration: float, **_: Any) -> None:
        if event == XLA_EVENT:
            build.append(duration)

    jax.monitoring.register_event_duration_secs_listener(heard)
    cpu = _cpu_seconds()
    clock = [time.perf_counter()]
    model = make()
    clock.append(time.perf_counter())
    system = ac.compile(model)
    clock.append(time.perf_counter())
    solution = system.simulate(t1, saveat=saveat, **options)
    clock.append(time.perf_counter())
    cpu = _cpu_seconds() - cpu
    native = solution.stats.get("engine") == "native"
    compiling = float(solution.stats["compile_seconds"]) if native else sum(build)
    run = float(solution.stats["run_seconds"])
    report = system.report()
    return Measurement(
        instantiate=clock[1] - clock[0],
        translate=clock[2] - clock[1],
        passes=dict(report.seconds),
        prepare=clock[3] - clock[2] - run - compiling,
        build=compiling,
        first=clock[3] - clock[2],
        run=run,
        cpu=cpu,
        states=report.states,
        index=report.structural_index,
        steps=int(solution.stats["steps"]),
        error=0.0 if error is None else error(solution),
    )


def _cpu_seconds() -> float:
    """Of this process and of those that it started and that have ended, as the C compiler."""
    spent = os.times()
    return time.process_time() + spent.children_user + spent.children_system


def emit(measurement: Measurement) -> None:
    """Print a measurement for `child_measurement`."""
    print(json.dumps(asdict(measurement)))


def child(arguments: Sequence[str], timeout: float, python: str = sys.executable) -> tuple[dict[str, Any] | None, str]:
    """Run `python -m ARGUMENTS` at the root of the project with an empty cache; its last line of output is JSON.

    Returns:
        the JSON and an empty text, or None and what went wrong.
    """
    with tempfile.TemporaryDirectory() as cache:
        env = {**os.environ, "ACAUSAL_CACHE": cache}
        try:
            done = subprocess.run(
                [python, "-m", *arguments],
                capture_output=True, text=True, timeout=timeout, cwd=ROOT, check=False, env=env,
            )  # fmt: skip
        except subprocess.TimeoutExpired:
            return None, f"> {timeout:.0f} s"
    lines = done.stdout.strip().splitlines()
    if lines and lines[-1].startswith("{"):
        return json.loads(lines[-1]), ""
    return None, (done.stderr.strip().splitlines() or ["no output"])[-1]


def child_measurement(arguments: Sequence[str], timeout: float) -> tuple[Measurement | None, str]:
    """A `Measurement` from a process of its own."""
    found, problem = child(arguments, timeout)
    return (None, problem) if found is None else (Measurement(**found), "")
