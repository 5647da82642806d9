"""What the examples in the docstrings of the components use: `run`, `close`, `unary`, `binary`.

``from acausal.components.examples import *`` and the component's own package make an example run as it stands.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

import acausal as ac
from acausal import Component, connect, start

from . import blocks

__all__ = ["Component", "ac", "binary", "close", "connect", "np", "run", "start", "unary"]


class Values:
    """The variables of a solution as lists of floats, to print."""

    def __init__(self, solution: Any) -> None:
        self.solution = solution

    def __getitem__(self, name: str) -> list[float]:
        return [round(float(v), 7) + 0.0 for v in np.atleast_1d(self.solution[name])]


def run(model: Component, at: Sequence[float] | Any = (0.0, 1.0), rtol: float = 1e-9, **options: Any) -> Values:
    """Compile `model` and simulate it until the last time of `at` [s]; the values are those at the times of `at`."""
    times = np.asarray(at, dtype=float)
    return Values(ac.compile(model).simulate(t1=float(times[-1]), saveat=times, rtol=rtol, **options))


def close(found: Any, wanted: Any, tolerance: float = 1e-5) -> bool:
    """Whether numbers agree, relative to the largest one wanted."""
    found, wanted = np.asarray(found, dtype=float), np.asarray(wanted, dtype=float)
    return bool(np.max(np.abs(found - wanted)) <= tolerance * max(float(np.max(np.abs(wanted))), 1e-3))


def unary(tested: blocks.SISO, value: float) -> float:
    """Output of a block for a constant input."""

    class Model(Component):
        source: blocks.Constant = blocks.Constant(k=value)
        block: blocks.SISO = tested

        def equations(self) -> ac.Equations:
            yield connect(self.source.y, self.block.u)

    return run(Model())["block.y"][-1]


def binary(tested: blocks.SI2SO, first: float, second: float) -> float:
    """Output of a block for two constant inputs."""

    class Model(Component):
        source1: blocks.Constant = blocks.Constant(k=first)
        source2: blocks.Constant = blocks.Constant(k=second)
        block: blocks.SI2SO = tested

        def equations(self) -> ac.Equations:
            yield connect(self.source1.y, self.block.u1)
            yield connect(self.source2.y, self.block.u2)

    return run(Model())["block.y"][-1]
