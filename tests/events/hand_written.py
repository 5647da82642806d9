"""Hybrid automata written by hand, followed with SciPy: what a component with modes is to do, beside its own machinery.

An automaton has modes; each has equations of motion and exits: functions that fall through zero, and where that leads.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.integrate import solve_ivp

State = np.ndarray
Rate = Callable[[float, State], list[float]]
Guard = Callable[[float, State], float]


@dataclass(frozen=True)
class Exit:
    """Where a guard falls through zero, the automaton goes on in the mode `to(t, x)`, from the state `jump(t, x)`."""

    guard: Guard
    to: str | Callable[[float, State], str]
    jump: Callable[[float, State], list[float]] = lambda t, x: x.tolist()


@dataclass(frozen=True)
class Mode:
    """Equations of motion, the ways out, and the values of the component's discrete variables."""

    rate: Rate
    exits: tuple[Exit, ...]
    shows: dict[str, float]


@dataclass(frozen=True)
class Path:
    """States at the wanted times (n_x, n_t), the mode at each, and the times at which the mode changes."""

    x: State
    modes: list[str]
    times: list[float]


def follow(modes: dict[str, Mode], mode: str, x: list[float], t: State) -> Path:
    """From mode and state at the first of the times t to the last."""
    now, state = float(t[0]), np.asarray(x, float)
    points: list[State] = []
    names: list[str] = []
    times: list[float] = []
    while True:
        here = modes[mode]
        guards = [_falling(e.guard) for e in here.exits]
        wanted = t[(t > now) | ((t == now) & (len(points) == 0))]
        found = solve_ivp(
            here.rate, (now, float(t[-1])), state, method="DOP853", t_eval=wanted, events=guards, rtol=1e-11,
            atol=1e-12, max_step=0.01,
        )  # fmt: skip
        points += list(np.transpose(found.y))  # an empty list where no wanted time is before the exit
        names += [mode] * len(found.t)
        if found.status != 1:
            return Path(np.array(points).T, names, times)
        k = next(i for i, at in enumerate(found.t_events) if len(at))
        now, state = float(found.t_events[k][0]), found.y_events[k][0]
        leaving = here.exits[k]
        state = np.asarray(leaving.jump(now, state), float)
        mode = leaving.to if isinstance(leaving.to, str) else leaving.to(now, state)
        times.append(now)


def _falling(guard: Guard) -> Guard:
    def event(t: float, x: State) -> float:
        return guard(t, x)

    event.terminal, event.direction = True, -1.0  # type: ignore[attr-defined]
    return event
