"""The inside of an in-process participant as generated C."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..simulation.engines import tolerances
from ..simulation.native import native_model
from ..simulation.native_library import METHODS, Signal
from ..system import System
from .participant import Floats

MAX_STEPS = 10_000_000
"""Inner steps within one macro step."""
_SAMPLES = np.linspace(0.0, 1.0, 9)
"""Where an input polynomial of degree 2 or 3 is sampled for the piecewise linear signals of the engine."""
_NEWTON = 20


class NativeInner:
    """Steps and evaluates a system whose inputs are polynomials; arguments as of `JaxInner`.

    Args:
        n_inputs: how many of the places are inputs of the model; they follow signals, the others are held.
        derivatives: numbers of the variables that are the first and second derivatives of each output, -1 for unknown.
    """

    def __init__(
        self, system: System, places: Any, *, method: str, dt: float | None, rtol: float, atol: float,
        outputs: Sequence[int], derivatives: Sequence[tuple[int, int]], n_inputs: int,
    ) -> None:  # fmt: skip
        self.model = native_model(system)
        self.native_library = self.model.native_library(method)
        self.lowered, self.places, self.n_inputs = system.lowered, places, n_inputs
        how = tolerances(system, rtol, atol, dt, MAX_STEPS)
        self.rtol, self.atol, self.dt = how.rtol, how.atol, 0.0 if dt is None else dt
        self.method = METHODS.index(method)
        columns = np.array([list(outputs), *zip(*derivatives, strict=True)] if outputs else np.zeros((3, 0)), int)
        known = columns >= 0
        safe = np.where(known, columns, 0)
        self.variables, self.sign = self.lowered.representative[safe], np.where(known, self.lowered.sign[safe], np.nan)

    def _signals(self, t: float, h: float, matrix: Floats) -> list[Signal]:
        made: list[Signal] = []
        for row in matrix[: self.n_inputs]:
            if not row[1:].any():
                made.append((np.zeros(1), row[:1]))
                continue
            s = h * (_SAMPLES if row[2:].any() else _SAMPLES[[0, -1]])
            made.append((t + s, ((row[3] * s + row[2]) * s + row[1]) * s + row[0]))
        return made

    def step(self, t: float, h: float, z: Any, p: Any, matrix: Floats, hint: float) -> tuple[Any, float, int, bool]:
        """State after a macro step, inner step in use, inner steps taken, whether it succeeded."""
        p = p.copy()
        p[self.places] = matrix[:, 0]
        first = self.dt or min(hint, h)
        if METHODS[self.method] == "rk4":
            first = h / np.ceil(h / first - 1e-9)
        run = self.native_library.run(
            t, t + h, z, p, _NONE, rtol=self.rtol, atol=self.atol, signals=self._signals(t, h, matrix),
            first_step=first, max_steps=MAX_STEPS, method=self.method,
        )  # fmt: skip
        steps = max(run.counts["accepted"], 1)
        return run.z_end, 0.5 * h / steps, run.counts["steps"], run.code == 0 and bool(np.isfinite(run.z_end).all())

    def remember(self) -> Any:
        """What there is to save besides the states."""

    def recall(self, memory: Any) -> None:
        """Go back to what was remembered."""

    def evaluate(self, t: float, z: Any, p: Any, matrix: Floats) -> Floats:
        """Outputs and their derivatives, (3, n_y)."""
        p = p.copy()
        p[self.places] = matrix[:, 0]
        if self.lowered.n_w:
            z = self._algebraic(t, z, p)
        signals: list[Signal] = [(np.zeros(1), row[:1]) for row in matrix[: self.n_inputs]]
        values = self.native_library.observe(p, signals, np.array([t]), z[None])[0]
        return np.where(self.sign == 0, 0.0, self.sign * values[self.variables])

    def _algebraic(self, t: float, z: Floats, p: Floats) -> Floats:
        """Algebraic unknowns for these states and inputs, by Newton's method from those at hand."""
        n_x, n_w = self.lowered.n_x, self.lowered.n_w
        z = z.copy()
        for _ in range(_NEWTON):
            residual, matrix = self.native_library.conditions(p, t, z)
            step = np.linalg.solve(matrix[:n_w, n_x:], residual[:n_w])
            z[n_x:] -= step
            if np.all(np.abs(step) <= 1e-12 * (np.abs(z[n_x:]) + self.lowered.w_nominal)):
                break
        return z


_NONE = np.zeros(0)
