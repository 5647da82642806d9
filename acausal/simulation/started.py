"""What a run begins with: the values given, the tolerances, a consistent start."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.lowering.initial import InitialProblem

from .event_iteration import EventIteration, Move, Outcome
from .native_library import Floats, Signal


@dataclass(slots=True, eq=False)
class Given:
    """Values that a user gave, as numbers.

    Attributes:
        parameters, initial: dotted name to value.
        signals: of all inputs of the model, in order.
    """

    parameters: Mapping[str, Any]
    initial: Mapping[str, Any]
    signals: Sequence[Signal]


@dataclass(slots=True, eq=False)
class Tolerances:
    """How a run is controlled: as the arguments of `simulate`."""

    rtol: float
    atol: Floats
    first_step: float = 0.0
    max_steps: int = 1_000_000
    method: str = "rodas5p"


@dataclass(slots=True, eq=False)
class Started:
    """A consistent start: z0, parameters, residuals left, mask of the parameters given; with events their iteration."""

    z0: Floats
    p: Floats
    left: Floats
    mask: Any
    iteration: EventIteration | None = None
    outcome: Outcome | None = None
    moves: list[Move] = field(default_factory=list[Move])


@dataclass(frozen=True, slots=True)
class Seed:
    """One direction of differentiation: a parameter, an input that is constant, or the start value of a variable.

    Attributes:
        kind: ``parameter``, ``input`` or ``initial``.
        indices: its numbers: of parameters, of an input, of reduced variables, that all take the same value.
        signs: of aliases.
    """

    kind: str
    indices: tuple[int, ...]
    signs: tuple[float, ...]


def parameter_ids(system: Any, name: str) -> Any:
    """Numbers of a parameter (of an array: of all elements)."""
    cache = system.cache.setdefault("parameter_ids", {})
    if name not in cache:
        cache[name] = system.program.flat.names.find(name, parameter=True)[0].ravel()
    return cache[name]


def given_values(system: Any, t0: float, given: Given) -> tuple[Floats, Any]:
    """Parameters and inputs at t0 with the values given, dependent ones not yet; and which are given, (n_p,)."""
    program = system.program
    p, mask = program.base.copy(), np.zeros(program.n_p, np.uint8)
    for name, value in given.parameters.items():
        ids = parameter_ids(system, name)
        mask[ids] = 1
        p[ids] = np.broadcast_to(np.asarray(value, float), ids.shape)
    put_signals(p[program.flat.n_par :], given.signals, t0)
    return p, mask


def put_signals(inputs: Floats, signals: Sequence[Signal], t: float) -> None:
    """The values of the signals at time t, into the first places of `inputs`."""
    for k, (times, values) in enumerate(signals):
        inputs[k] = np.interp(t, times, values)


def own_conditions(problem: InitialProblem, overrides: Mapping[int, Any]) -> bool:
    """Whether the conditions of the start are those that were compiled: further fixed starts are of states only."""
    states = set(problem.lowered.schedule.states.tolist())
    return all(k in states for k in overrides)


