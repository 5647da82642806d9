"""Inputs of a model as functions of time: numbers, tables, or functions."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

import jax.numpy as jnp
import numpy as np
from jax import Array

from acausal.errors import UnknownNameError, nearest

from .cache import cache_of
from .lowered import Lowered

Driven = tuple[Array, tuple[Any, ...]]
"""Parameters of a driven system: the parameter vector and the numbers of its inputs."""


class DrivenLowered:
    """A lowered system whose inputs, the last entries of its parameter vector, follow given functions of time.

    Its functions take `Driven` instead of the parameter vector.
    """

    def __init__(self, lowered: Lowered, places: Sequence[int], signals: Sequence[Callable[[Any, Any], Any]]) -> None:
        self.lowered = lowered
        self.places = np.asarray(places)
        self.signals = tuple(signals)
        self.n_x, self.n_w, self.n_g = lowered.n_x, lowered.n_w, lowered.n_g
        self.x_nominal, self.w_nominal = lowered.x_nominal, lowered.w_nominal
        self.conserved, self.time_tables = lowered.conserved, lowered.time_tables

    def at(self, t: Any, p: Driven) -> Array:
        """The parameter vector at time t."""
        vector, data = p
        return vector.at[self.places].set(jnp.stack(self.values(t, data)))

    def values(self, t: Any, data: tuple[Any, ...]) -> list[Array]:
        """Values of the inputs at time t."""
        return [jnp.asarray(signal(t, d), float) for signal, d in zip(self.signals, data, strict=True)]

    def derivatives(self, t: Any, x: Array, w: Array, p: Any) -> tuple[Array, Array]:
        return self.lowered.derivatives(t, x, w, self.at(t, p))

    def invariants(self, t: Any, x: Array, w: Array, p: Any) -> Array:
        return self.lowered.invariants(t, x, w, self.at(t, p))

    def solve_algebraic(self, t: Any, x: Array, w_guess: Array, p: Any) -> Array:
        return self.lowered.solve_algebraic(t, x, w_guess, self.at(t, p))

    def observe(self, t: Any, x: Array, w: Array, p: Any, ids: Any = None) -> Array:
        vector = self.at(t, p)
        return self.lowered.observe(t, x, w, vector) if ids is None else self.lowered.observe(t, x, w, vector, ids)  # pyright: ignore[reportCallIssue]

    def sparsity(self) -> Any:
        return self.lowered.sparsity()


def drive(system: Any, inputs: Mapping[str, Any]) -> tuple[DrivenLowered, tuple[Any, ...]]:
    """The driven system for these inputs, and their numbers.

    Args:
        system: offers `lowered` and `input_names`, the names of the last entries of the parameter vector in order
            (before the slots of events, if it has a `hybrid`).
        inputs: name to a number; a pair (times, values) that is interpolated linearly and held beyond its ends; or a
            function of time written with `jax.numpy`.

    Raises:
        UnknownNameError: the model has no such input.
    """
    names = tuple(system.input_names)
    lowered = system.lowered
    hybrid = getattr(system, "hybrid", None)
    held = 0 if hybrid is None else hybrid.flat.slots.count
    places: list[int] = []
    signals: list[Callable[..., Any]] = []
    data: list[Any] = []
    for name, value in inputs.items():
        if name not in names:
            known = nearest(name, names) or f" Its inputs are: {', '.join(names) or 'none'}."
            raise UnknownNameError(f"The model has no input `{name}`.{known}")
        places.append(names.index(name) - len(names) - held)
        signal, numbers = _signal(value)
        signals.append(signal)
        data.append(numbers)
    key = ("driven", tuple(places), tuple(signals))
    cache = cache_of(lowered)
    if key not in cache:
        cache[key] = DrivenLowered(lowered, places, [s if s in _OWN else _ignoring(s) for s in signals])
    return cache[key], tuple(data)


def _signal(value: Any) -> tuple[Callable[..., Any], Any]:
    """The function of an input and the numbers it takes: those may change without compiling anew."""
    if callable(value):
        return value, None
    if isinstance(value, (tuple, list)):
        times, values = (jnp.asarray(v, float) for v in value)
        return _table, (times, values)
    return _constant, jnp.asarray(value, float)


def _constant(t: Any, value: Any) -> Any:
    del t
    return value


def _table(t: Any, table: tuple[Array, Array]) -> Array:
    return jnp.interp(t, *table)


def is_table(signal: Callable[..., Any]) -> bool:
    """Whether a signal is a table, whose numbers begin with the times of its points."""
    return signal is _table


_OWN = (_constant, _table)


def _ignoring(function: Callable[..., Any]) -> Callable[[Any, Any], Any]:
    return lambda t, _: function(t)
