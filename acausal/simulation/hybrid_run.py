"""A run with events: from one event to the next, on either engine."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import Any, Protocol

import numpy as np

from acausal.errors import SimulationError
from acausal.lowering.hybrid import Hybrid

from .accumulation import TurnedBack
from .event_iteration import EventIteration, Outcome
from .native_library import RESULTS, Floats
from .watch import watch

CLOSE, SHRINKING, MANY_SHRINKING = 1e-7, 0.999, 20
"""So many events in a row, each sooner than the last, up to this part of the run: they accumulate."""
STUCK, MANY_STUCK = 1e-10, 60
"""So many events in a row without time passing, to this part of the run: they chatter."""
EVENT = RESULTS.index("event_occurred")


@dataclass(frozen=True, slots=True)
class Event:
    """Something that happened.

    Attributes:
        t: time [s].
        causes: the conditions that switched and the triggers, as the user wrote them, with component and source line.
    """

    t: float
    causes: tuple[str, ...]


class Segment(Protocol):
    """What an engine returns for a stretch between events; as `acausal.simulation.native_library.Run`."""

    z: Any
    code: int
    saved: int
    t_end: float
    z_end: Any
    step: float
    switched: Any
    counts: dict[str, int]
    passed: Sequence[tuple[float, int, Any]]


Integrate = Callable[[float, float, Floats, Floats, Floats, float, bool, int], Segment]
"""(t, t_stop, z, p, output times, first step, end open, steps left) to a segment."""


AtEvent = Callable[[float, Segment | None, Outcome, list[int]], None]
"""Told the time of an event, the segment before (None at the end), what followed, and the samples that were due."""


@dataclass(eq=False)
class HybridRun:
    """Trajectories with events.

    Attributes:
        z: (n_saved, n_z).
        slots: (n_saved, n_slots).
        events: in order.
        code, t_end, z_end, p_end, counts: as of a run without events; the code of an end by `terminate` is 0.
        ended: message of `terminate`.
        save: times of the rows.
        closed: whether the last row is what follows from `terminal()` or `terminate`, and not what was saved.
    """

    z: Floats
    slots: Floats
    events: list[Event]
    code: int
    t_end: float
    z_end: Floats
    p_end: Floats
    counts: dict[str, int]
    ended: str | None
    save: Floats
    closed: bool

    @property
    def result(self) -> str:
        """`"successful"`, or what ended the run early."""
        if self.code:
            return RESULTS[self.code]
        return "successful" if self.ended is None else f"terminated: {self.ended}"


@dataclass(eq=False)
class _Record:
    """What is collected on the way."""

    hybrid: Hybrid
    span: float
    z: list[Any] = field(default_factory=list[Any])
    slots: list[Any] = field(default_factory=list[Any])
    events: list[Event] = field(default_factory=list[Event])
    counts: dict[str, int] = field(default_factory=dict[str, int])
    recent: deque[tuple[float, list[int]]] = field(default_factory=lambda: deque(maxlen=MANY_STUCK + 1))

    def segment(self, segment: Segment, p: Floats) -> Floats:
        """Keep a stretch, and note the events that it has passed; the parameters at its end."""
        self.z.append(segment.z[: segment.saved])
        for name, n in segment.counts.items():
            self.counts[name] = self.counts.get(name, 0) + n
        kept = 0
        for t, saved, switched in segment.passed:
            self._hold(p, saved - kept)
            modes = self.hybrid.roots.slots[switched].tolist()
            p, kept = p.copy(), saved
            p[modes] = 1.0 - p[modes]
            self.event(t, sorted(modes))
        self._hold(p, segment.saved - kept)
        return p

    def _hold(self, p: Floats, n: int) -> None:
        """The same slots in n rows."""
        self.slots.append(np.broadcast_to(p[self.hybrid.slots], (n, self.hybrid.flat.slots.count)))

    def event(self, t: float, slots: list[int]) -> None:
        """Note an event, if anything follows from it; those that do not let time pass are an error.

        That the condition of a `when` is no longer true has no consequence: a ball that bounces does so once.
        """
        if not (slots and self.hybrid.only_triggers.issuperset(slots)):
            self.events.append(Event(t, tuple(dict.fromkeys(self.hybrid.text(s) for s in slots))))
        self.recent.append((t, slots))
        gaps = np.abs(np.diff([at for at, _ in self.recent]))
        if len(gaps) >= MANY_STUCK and (gaps < STUCK * self.span).all():
            self._fail(t, "chatters: it switches again as soon as it has switched", gaps)
        pairs = (gaps[1:] + gaps[:-1])[-MANY_SHRINKING:]  # a condition may switch there and back each time
        close = len(pairs) == MANY_SHRINKING and bool(pairs[-1] < CLOSE * self.span)
        if close and (pairs[2:] < SHRINKING * pairs[:-2]).all():
            self._fail(t, "switches ever faster: its events accumulate at this time", gaps)

    def unresolved(self, slots: list[int]) -> None:
        """An error, if there are conditions that have come back to their switch too soon to be seen."""
        if slots:
            times = [at for at, _ in self.recent]
            self.recent = deque([(times[0], []), *((at, slots) for at in times[1:])])
            what = "comes back to its switch faster than can be resolved: its events accumulate at this time"
            self._fail(times[-1], what, np.abs(np.diff(times)))

    def _fail(self, t: float, what: str, gaps: Any) -> None:
        counts: dict[int, int] = {}
        for _, slots in self.recent:
            for slot in dict.fromkeys(slots):
                counts[slot] = counts.get(slot, 0) + 1
        often = sorted(counts, key=lambda s: -counts[s])
        texts = dict.fromkeys(self.hybrid.text(s) for s in often if 2 * counts[s] >= counts[often[0]])
        raise SimulationError(
            f"At t = {t:.12g} s a condition {what} ({len(gaps)} events within the last {gaps.sum():.2g} s):\n"
            + "\n".join(f"    {text}" for text in list(texts)[:4])
            + "\nTry: a mode of its own for what the model does there (sticking, resting, sliding), a hysteresis, a "
            "smooth characteristic, or noevent(...) around the condition where the solver may step over it."
        )


def run_hybrid(
    iteration: EventIteration, start: Outcome, t0: float, t1: float, save: Floats, integrate: Integrate,
    *, first_step: float, max_steps: int, at_event: AtEvent | None = None, at_end: bool = True,
) -> HybridRun:  # fmt: skip
    """Integrate from event to event.

    Args:
        iteration: carries the events out.
        start: consistent start, with the slots.
        t0, t1: start and end time [s].
        save: output times.
        integrate: integrates to the next event at most.
        first_step: first step [s]; 0 to estimate one.
        max_steps: most steps.
        at_event: told of each event, and of the end.
        at_end: whether the end of the run is the end of the simulation, for `terminal()`.

    Raises:
        SimulationError: events chatter or accumulate, an assertion fails, an event has no consistent outcome.
    """
    hybrid = iteration.hybrid
    slots = hybrid.flat.slots
    if t1 < t0:
        raise SimulationError("A model with events runs forward in time only: t1 is before t0.")
    record, turned = _Record(hybrid, t1 - t0), TurnedBack(iteration, t1 - t0)
    t, z, p, step, saved, code = t0, start.z, start.p, first_step, 0, 0
    if start.changed:
        record.event(t0, start.changed)
    ended, z_end = start.ended, start.z
    while ended is None:
        since, stop = t, float(min(iteration.next_sample(t), t1))
        sampled = bool(iteration.samples(t, stop))
        segment = integrate(t, stop, z, p, save[saved:], step, sampled, max_steps - record.counts.get("steps", 0))
        p = record.segment(segment, p)
        saved += segment.saved
        t, z_end, code = segment.t_end, segment.z_end, segment.code
        watch.reached(t)
        if code in (0, EVENT):
            record.unresolved(turned.segment(t, z_end, p, segment.switched if code == EVENT else None))
        if code not in (0, EVENT):
            break
        happened = code == EVENT
        samples = iteration.samples(since, t)
        if not happened and not samples:
            break
        t = min(iteration.moment(since, t), t1)
        outcome = iteration.event(t, z_end, p, segment.switched if happened else None, samples)
        if at_end and outcome.ended is not None and slots.terminal >= 0:
            outcome = _closing(iteration, t, outcome)
        if at_event is not None:
            at_event(t, segment, outcome, samples)
        record.event(t, outcome.changed)
        turned.event(t, (z_end, p), outcome, segment.switched if happened else None)
        z, p, ended, step, code = outcome.z, outcome.p, outcome.ended, segment.step, 0
        z_end = z
    changed = ended is not None
    closing = ended is None or start.ended is not None  # not at an event that has ended it: that has seen to it
    if at_end and slots.terminal >= 0 and code == 0 and closing:
        outcome = iteration.event(t, z_end, p, None, [slots.terminal])
        if at_event is not None:
            at_event(t, None, outcome, [slots.terminal])
        p, z_end, changed = outcome.p, outcome.z, True
    closed = bool(changed and saved and save[saved - 1] == t)
    found = np.concatenate(record.z) if record.z else np.zeros((0, len(start.z)))
    modes = np.concatenate(record.slots) if record.slots else np.zeros((0, slots.count))
    if closed:  # the end is as `terminal()` or `terminate` has left it
        found[-1], modes[-1] = z_end, p[hybrid.slots]
    if ended is not None and (not saved or save[saved - 1] < t):  # the end itself is part of the result
        found, modes = np.concatenate([found, z_end[None]]), np.concatenate([modes, p[None, hybrid.slots]])
        save = np.concatenate([save[:saved], [t]])
    else:
        save = save[:saved]
    counts = {name: record.counts.get(name, 0) for name in ("steps", "accepted", "rejected", "pivoted")}
    return HybridRun(found, modes, record.events, code, t, z_end, p, counts, ended, save, closed)


def _closing(iteration: EventIteration, t: float, outcome: Outcome) -> Outcome:
    """What follows from `terminal()` where `terminate` has ended a run, as a part of the event that has: where the time
    of that moves, so does what is written at the end."""
    earlier = iteration.moves
    last = iteration.event(t, outcome.z, outcome.p, None, [iteration.hybrid.flat.slots.terminal])
    iteration.moves = [*earlier, *iteration.moves]
    last.ended, last.changed = outcome.ended, outcome.changed
    return last
