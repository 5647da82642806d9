"""Running the members of an ensemble, in this process or in others.

Another process gets what the system was compiled from, compiles it once and keeps it.
"""

from __future__ import annotations

import functools
import pickle
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TextIO

import numpy as np

from ..errors import AcausalError
from ..language.template import Floats
from ..told import keeping

if TYPE_CHECKING:
    from ..system import System

QUIET = 1.0
"""Seconds before progress is shown."""
EVERY = 0.2
"""Seconds between two updates of the progress."""


@dataclass(frozen=True, slots=True, eq=False)
class Job:
    """What is the same for all members.

    Attributes:
        names: variables to keep.
        t1: end time [s].
        options: of `System.simulate`.
    """

    names: tuple[str, ...]
    t1: float
    options: Mapping[str, Any]


@dataclass(frozen=True, slots=True, eq=False)
class Member:
    """Values of one member."""

    index: int
    parameters: dict[str, float]
    initial: dict[str, float]


@dataclass(frozen=True, slots=True, eq=False)
class Result:
    """What came of one member: times and (n_t, n_names) values, or the reason why not; and what it was warned of."""

    index: int
    t: Floats | None
    values: Floats | None
    reason: str = ""
    warnings: tuple[str, ...] = ()


def run_members(system: System, job: Job, members: Sequence[Member]) -> list[Result]:
    """Simulate some members one after the other; a failing one is a result too."""
    columns = _state_columns(system, job.names)
    return [_run_member(system, job, columns, member) for member in members]


def _run_member(system: System, job: Job, columns: list[tuple[int, float] | None], member: Member) -> Result:
    with keeping() as told:
        try:
            solution = system.simulate(job.t1, parameters=member.parameters, initial=member.initial, **job.options)
        except AcausalError as error:
            return Result(member.index, None, None, str(error), tuple(told))
    kept = [
        np.asarray(solution[name]) if at is None else at[1] * np.asarray(solution.x)[:, at[0]]
        for name, at in zip(job.names, columns, strict=True)
    ]
    return Result(member.index, np.asarray(solution.t), np.stack(kept, axis=1), warnings=tuple(told))


def _state_columns(system: System, names: Sequence[str]) -> list[tuple[int, float] | None]:
    """For each variable that is a state, or an alias of one, its column and sign: it needs no evaluation."""
    representative, sign = system.observed_ids
    states = {int(v): k for k, v in enumerate(system.stages.schedule.states)}
    ids = [int(np.ravel(system.index_of(name))[0]) for name in names]
    return [(states[r], float(sign[i])) if (r := int(representative[i])) in states else None for i in ids]


def run_elsewhere(recipe: bytes, job: bytes, members: Sequence[Member]) -> list[Result]:
    """As `run_members` in another process, from what `pack` made."""
    return run_members(_system(recipe), pickle.loads(job), members)


@functools.lru_cache(maxsize=4)
def _system(recipe: bytes) -> System:
    from ..precision import enable_double_precision

    enable_double_precision()
    return pickle.loads(recipe)


def pack(thing: Any) -> bytes:
    """A pickle; with cloudpickle if it is there, which also takes classes that were defined in a notebook."""
    try:
        import cloudpickle
    except ImportError:
        return pickle.dumps(thing)
    return cloudpickle.dumps(thing)


class Progress:
    """A line that tells how many members are done, from the second second on.

    Args:
        total: number of members.
        show: whether to; or a function of (done, failed, total).
        stream: where to.
    """

    def __init__(self, total: int, show: bool | Callable[[int, int, int], None], stream: TextIO | None = None) -> None:
        self.total = total
        self.show = show
        self.stream = stream or sys.stderr
        self.begin = self.last = time.monotonic()
        self.done = self.failed = 0
        self.shown = False

    def add(self, results: Sequence[Result]) -> None:
        """Count results."""
        self.done += len(results)
        self.failed += sum(bool(r.reason) for r in results)
        if callable(self.show):
            self.show(self.done, self.failed, self.total)
            return
        now = time.monotonic()
        if self.show and now - self.begin > QUIET and (now - self.last > EVERY or self.done == self.total):
            self.last, self.shown = now, True
            left = (now - self.begin) / self.done * (self.total - self.done)
            failed = f", {self.failed} failed" if self.failed else ""
            self.stream.write(f"\r{self.done} of {self.total} members{failed}, {left:.0f} s left ")
            self.stream.flush()

    def end(self) -> None:
        """End the line."""
        if self.shown:
            self.stream.write("\n")
