"""What the examples in the docstrings of the components use: `assemble`, `run`, `close`, `unary`, `binary`.

``from acausal.components.examples import *`` and the component's own package make an example run as it stands.
"""

from __future__ import annotations

import types
from collections.abc import Sequence
from typing import Any, cast

import numpy as np

import acausal as ac
from acausal import Component, connect, start

from . import blocks

__all__ = ["Component", "ac", "assemble", "binary", "close", "connect", "np", "run", "start", "unary"]


def assemble(*connections: str, **parts: Component) -> Component:
    """A model of `parts`, joined by connections such as ``"source.p - resistor.p - meter.p"``."""

    def equations(self: Component) -> ac.Equations:
        for text in connections:
            first, second, *more = (_found(self, path) for path in text.split(" - "))
            yield connect(first, second, *more)

    body: dict[str, Any] = {**parts, "equations": equations, "__doc__": "An example.", "__module__": __name__}
    made = types.new_class("Example", (Component,), exec_body=lambda names: names.update(body))
    return cast("type[Component]", made)()


def _found(model: Component, path: str) -> Any:
    found: Any = model
    for name in path.replace("[", ".").replace("]", "").split("."):
        found = found[int(name)] if name.isdigit() else getattr(found, name)
    return found


class Values:
    """The variables of a solution as lists of floats, to print."""

    def __init__(self, solution: Any) -> None:
        self.solution = solution

    def __getitem__(self, name: str) -> list[float]:
        values = np.atleast_1d(np.asarray(self.solution[name], dtype=float))
        scale = float(np.max(np.abs(values)))
        return [0.0 if abs(v) < 1e-9 * scale else float(f"{v:.8g}") for v in values.tolist()]


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

    model = assemble("source.y - block.u", source=blocks.Constant(k=value), block=tested)
    return run(model)["block.y"][-1]


def binary(tested: blocks.SI2SO, first: float, second: float) -> float:
    """Output of a block for two constant inputs."""

    sources = {"first": blocks.Constant(k=first), "second": blocks.Constant(k=second)}
    model = assemble("first.y - block.u1", "second.y - block.u2", block=tested, **sources)
    return run(model)["block.y"][-1]
