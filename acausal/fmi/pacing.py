"""Real-time pacing: a macro step does not end before its time has come, and lateness is counted."""

from __future__ import annotations

import time
from typing import Any

import numpy as np


class Pacer:
    """Waits for the wall clock.

    Args:
        speed: simulated seconds per second of the wall clock; None for no waiting.
        t0: simulated time at which the clock starts [s].
    """

    def __init__(self, speed: float | None, t0: float) -> None:
        if speed is not None and not speed > 0:
            raise ValueError(f"real_time={speed!r} must be positive: simulated seconds per second")
        self.speed, self.t0 = speed, t0
        self.begin = self.last = time.perf_counter()
        self.busy: list[float] = []
        self.late: list[float] = []

    def wait(self, t: float) -> None:
        """Wait until simulated time t is due; note how long the step took and how late it was [s]."""
        if self.speed is None:
            return
        now = time.perf_counter()
        self.busy.append(now - self.last)
        due = self.begin + (t - self.t0) / self.speed
        self.late.append(max(now - due, 0.0))
        if now < due:
            time.sleep(due - now)
        self.last = time.perf_counter()

    def stats(self) -> dict[str, Any]:
        """Deadlines and those missed, greatest lateness, time of a step: median, 99th percentile, largest [s]."""
        if self.speed is None or not self.busy:
            return {}
        busy, late = np.array(self.busy), np.array(self.late)
        return {
            "deadlines": len(busy), "missed": int((late > 0).sum()), "latest": float(late.max()),
            "step_median": float(np.median(busy)), "step_99": float(np.quantile(busy, 0.99)),
            "step_largest": float(busy.max()),
        }  # fmt: skip
