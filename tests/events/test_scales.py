"""A model in other units has the same events: nothing about them is measured in seconds, or in ones."""

from __future__ import annotations

import types
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Discrete, Equations, Variable, der, mod, pre, sample, when, where

CIRCLE = 2 * np.pi


def scaled(second: float, one: float, states: bool) -> Component:
    """A swing of amplitude `one` and period `second`, with events of its values, of times, samples and steps."""

    def equations(self: Any) -> Equations:
        if states:
            yield der(self.x) == one / second * CIRCLE * ac.cos(CIRCLE * ac.time / second)
            yield der(self.y) == where(self.x > 0.5 * one, 1.0, -1.0) * one / second
        else:
            yield self.x == one * ac.sin(CIRCLE * ac.time / second) + 0.1 * one * ac.sin(self.x / one)
            yield self.y == where(self.x > 0.5 * one, 1.0, -1.0) * one
        yield self.u == ac.floor(2.0 * ac.time / second) + where(mod(ac.time, second) < 0.2 * second, 0.5, 0.0)
        yield when(sample(0.3 * second, 0.5 * second), {self.seen: self.x})
        yield when(self.x < -0.9 * one, {self.count: pre(self.count) + 1})

    moving = Variable(start=0.0, fixed=states or None, nominal=one)
    fields: dict[str, Any] = {"x": moving, "y": Variable(start=0.0, fixed=states or None, nominal=one), "u": Variable()}
    fields |= {"seen": Discrete(), "count": Discrete(start=0)}
    annotations = {name: type(field) for name, field in fields.items()}
    body = {"equations": equations, "__module__": __name__, "__annotations__": annotations, **fields}
    return types.new_class("Scaled", (Component,), {}, lambda ns: ns.update(body))()


@cache
def found(second: float, one: float, states: bool, engine: Any) -> tuple[np.ndarray, np.ndarray]:
    """Times of the events in seconds of the model, and its end in ones of the model."""
    solution = ac.compile(scaled(second, one, states)).simulate(2.2 * second, rtol=1e-9, engine=engine, saveat=2)
    end = [solution[name][-1] / size for name, size in (("x", one), ("y", one), ("seen", one), ("u", 1), ("count", 1))]
    return np.array([event.t / second for event in solution.events]), np.array(end)


@pytest.mark.parametrize(("second", "one"), [(1e-9, 1.0), (1e-12, 1e-15), (1e7, 1e12)])
@pytest.mark.parametrize("states", [True, False])
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_events_do_not_depend_on_units(second: float, one: float, states: bool, engine: Any) -> None:
    times, end = found(second, one, states, engine)
    wanted, wanted_end = found(1.0, 1.0, states, "native")
    assert len(times) == len(wanted) == 18
    np.testing.assert_allclose(times, wanted, atol=1e-8)
    np.testing.assert_allclose(end, wanted_end, atol=1e-7)
