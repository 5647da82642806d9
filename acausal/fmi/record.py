"""Collects what a co-simulation run gives at its communication points."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .participant import Floats, Participant
from .result import CoSimulationResult


class Recorder:
    """Rows of outputs, energies and powers, one a communication point."""

    def __init__(self, names: Sequence[str], parts: Sequence[Participant], bonds: Sequence[str]) -> None:
        self.names, self.bonds = names, bonds
        self.columns = [f"{n}.{o}" for n, p in zip(names, parts, strict=True) for o in p.outputs]
        self.rows: list[tuple[float, Floats, Floats, Floats, float]] = []

    def add(self, t: float, values: Sequence[Floats], energy: Floats, power: Floats, defect: float) -> None:
        """One communication point."""
        self.rows.append((t, np.concatenate([v[0] for v in values]), energy.copy(), power.copy(), defect))

    def result(self, parts: Sequence[Participant], stats: Mapping[str, Any], result: str) -> CoSimulationResult:
        """All of it."""
        t = np.array([r[0] for r in self.rows])
        table = np.array([r[1] for r in self.rows])
        energy, power = (np.array([r[k] for r in self.rows]).reshape(len(t), -1) for k in (2, 3))
        units = {f"{n}.{o}": p.unit(o) for n, p in zip(self.names, parts, strict=True) for o in p.outputs}
        return CoSimulationResult(
            t=t, signals={n: table[:, i] for i, n in enumerate(self.columns)}, units=units,
            energy={n: energy[:, i] for i, n in enumerate(self.bonds)},
            power={n: power[:, i] for i, n in enumerate(self.bonds)},
            defect=np.array([r[4] for r in self.rows]), stats=stats, result=result,
        )  # fmt: skip
