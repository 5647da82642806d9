"""A run with events together with its derivatives, on either engine."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from .event_iteration import Outcome
from .event_tangents import EventTangents, Rates
from .hybrid_run import HybridRun, Segment, run_hybrid
from .native_library import Floats
from .start_tangents import StartTangents
from .started import Given, Seed, Started

Differentiated = Callable[..., tuple[Segment, Floats, Floats]]
"""The arguments of `acausal.simulation.hybrid_run.Integrate`, and tangents of z (n_z, k) and p (n_p, k) at the start of
the stretch, to the segment and the tangents of what it saved (n_saved, n_z, k) and of its end (n_z, k)."""


def run_with_tangents(
    started: Started, t0: float, t1: float, save: Floats, given: Given, starts: StartTangents, seeds: Sequence[Seed],
    rates: Rates, integrate: Differentiated, *, first_step: float, max_steps: int,
) -> tuple[HybridRun, Floats, Floats]:  # fmt: skip
    """The run, and derivatives along `seeds`: of z and the slots (n_t, n_z + n_slots, k), of the parameters (n_p, k).

    Args:
        started: the start, with the iteration that carries out its events.
        t0, t1, save: start, end and output times [s].
        given: values given.
        starts: derivatives of the start.
        seeds: directions.
        rates: of the inputs.
        integrate: a stretch between events.
        first_step, max_steps: as for `run_hybrid`.
    """
    iteration, outcome = started.iteration, started.outcome
    assert iteration is not None and outcome is not None
    slots = iteration.hybrid.slots
    tangents = EventTangents(iteration, rates)
    first = replace(started, z0=started.moves[0].z, p=started.moves[0].p)
    moving: list[Any] = [*tangents.start(started.moves, *starts.at(t0, given.initial, first, seeds))]
    found: list[Floats] = []

    def stretch(*arguments: Any) -> Segment:
        segment, dz, moving[0] = integrate(*arguments, moving[0], moving[1])
        held = moving[1][slots]
        found.append(np.concatenate([dz, np.broadcast_to(held, (len(dz), *held.shape))], axis=1))
        return segment

    def at_event(t: float, segment: Any, after: Outcome, samples: list[int]) -> None:
        roots = segment.switched if segment is not None and segment.code else None
        moving[:] = tangents.event(iteration.moves, after.p, moving[0], moving[1], roots, samples)

    run = run_hybrid(
        iteration, outcome, t0, t1, save, stretch, first_step=first_step, max_steps=max_steps, at_event=at_event
    )
    dz = np.concatenate(found)
    last = np.concatenate([moving[0], moving[1][slots]])[None]
    if len(dz) < len(run.z) or run.closed:  # the end itself, where `terminate` or `terminal()` have changed it
        dz = np.concatenate([dz[: len(run.z) - 1], last])
    return run, dz, moving[1]
