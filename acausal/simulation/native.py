"""The native engine: a whole run in compiled C, from the given values to the trajectories and their sensitivities.

Nothing here needs JAX; `traced` wraps it for JAX's transformations.
"""

from __future__ import annotations

import threading
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from acausal.errors import InitializationError
from acausal.lowering.bounds import check_parameters
from acausal.lowering.c.generate import EXPLICIT, TANGENTS, CSource, to_c
from acausal.lowering.initial import SATISFIED, given_starts
from acausal.lowering.initial_numeric import solve_numeric
from acausal.symbolic.traverse import postorder

from .event_iteration import EventIteration
from .hybrid_run import HybridRun, run_hybrid
from .hybrid_tangents import run_with_tangents
from .native_build import build
from .native_library import METHODS, Floats, NativeLibrary, Run, Signal
from .start_tangents import StartTangents
from .started import Given, Seed, Started, Tolerances, given_values, own_conditions, put_signals

LARGEST = 1_000
"""Operations up to which a system is written out in C: compiling grows faster than their number."""
WIDTHS = (1, 2, 4, 8)
"""Numbers of directions that a library is compiled for; more directions take several runs."""


@dataclass(frozen=True, slots=True, eq=False)
class NativeEquations:
    """The compiled equations for the iteration of events."""

    model: NativeModel
    native_library: NativeLibrary
    signals: Sequence[Signal]

    def feed(self, t: float, p: Floats) -> None:
        """Inputs at time t into p."""
        put_signals(p[self.model.system.program.flat.n_par :], self.signals, t)

    def settle(self, t: float, z: Floats, p: Floats) -> Floats | None:
        """z with the algebraic unknowns solved for."""
        low = self.model.system.lowered
        if not low.n_w:
            return z
        z = z.copy()
        return z if self.native_library.settle(p, self.signals, t, z) else None

    def values(self, t: float, z: Floats, p: Floats) -> Floats:
        """All reduced variables."""
        return self.native_library.observe(p, self.signals, np.array([t]), z[None])[0]


@dataclass(eq=False)
class NativeModel:
    """A system with its compiled libraries, made when they are first needed."""

    system: Any
    source: CSource
    libraries: dict[tuple[int, bool], NativeLibrary] = field(default_factory=dict[tuple[int, bool], NativeLibrary])
    lock: Any = field(default_factory=threading.Lock)

    def native_library(self, method: str = METHODS[0], width: int = 0) -> NativeLibrary:
        """The library with a method, and with tangents in `width` directions; 0 is without."""
        explicit = method != METHODS[0]
        with self.lock:
            key = width, explicit
            if key not in self.libraries:
                defines = (TANGENTS, f"AC_LANES={width}") if width else ()
                made = build(self.source, (*defines, EXPLICIT) if explicit else defines)
                low = self.system.lowered
                nominal = np.concatenate([low.x_nominal, low.w_nominal])
                self.libraries[key] = NativeLibrary(made, bool(width), self.source.tables, nominal)
            return self.libraries[key]

    def _any_library(self) -> NativeLibrary:
        """One that is there, for what all have in common."""
        with self.lock:
            found = next(iter(self.libraries.values()), None)
        return found or self.native_library()

    # ---- start ------------------------------------------------------------------------------------
    def start(self, t0: float, given: Given, library: NativeLibrary, check: bool = True) -> Started:
        """Parameters and a consistent start.

        Raises:
            InitializationError, DeclarationError: as `System.check_initial`.
        """
        system = self.system
        program, problem = system.program, system.initial
        p, mask = given_values(system, t0, given)
        if self.large:
            p = program.completed(p, mask.astype(bool))
            starts = program.starts(p, np)
        else:
            library.parameters(mask, p)
            starts = program.flat.start.copy()
            library.starts(p, starts)
        overrides = system._overrides(given.initial, np)
        own = not self.large and own_conditions(problem, overrides)

        def solve(p: Floats) -> tuple[Floats, Floats]:
            if own and problem.lowered.n_x + problem.lowered.n_w:
                given_at = given_starts(problem, starts, overrides, p, np)
                z = np.concatenate([given_at.x, given_at.w])
                left = library.start(p, t0, given_at.fixed, problem.all_ease, given_at.wanted, z)
                if left <= SATISFIED:
                    return z, np.array([left])
            conditions = (lambda z: library.conditions(p, t0, z)) if own else None
            found = solve_numeric(problem, t0, p, starts, overrides, conditions)
            if found is None:
                raise InitializationError("the start of this model is too large for the native engine")
            return np.concatenate(found[:2]), found[2]

        iteration = outcome = None
        if system.hybrid is None:
            z0, left = solve(p)
        else:
            iteration = EventIteration(system.hybrid, problem, NativeEquations(self, library, given.signals))
            outcome, left = iteration.start(t0, p, starts, solve)
            z0, p = outcome.z, outcome.p
        if check:
            system.check_initial(z0[: problem.lowered.n_x], z0[problem.lowered.n_x :], p, left, t0, given.initial)
        else:
            check_parameters(program.flat, p)
        return Started(z0, p, left, mask, iteration, outcome, [] if iteration is None else iteration.moves)

    @property
    def large(self) -> bool:
        """Whether families are loops."""
        return bool(self.source.tables)

    # ---- run --------------------------------------------------------------------------------------
    def run(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, check: bool = True
    ) -> tuple[Started, Run | HybridRun]:
        """Start and integrate."""
        library = self.native_library(how.method)
        started = self.start(t0, given, library, check)
        if started.iteration is not None:
            return started, self._run_events(library, started, t0, t1, save, given, how)
        run = library.run(
            t0, t1, started.z0, started.p, save, rtol=how.rtol, atol=how.atol, signals=given.signals,
            first_step=how.first_step, max_steps=how.max_steps, method=METHODS.index(how.method),
        )  # fmt: skip
        return started, run

    def _run_events(
        self, library: NativeLibrary, started: Started, t0: float, t1: float, save: Floats, given: Given,
        how: Tolerances,
    ) -> HybridRun:  # fmt: skip
        """Integrate from event to event."""
        iteration, outcome = started.iteration, started.outcome
        assert iteration is not None and outcome is not None
        by_itself = iteration.hybrid.only_modes and not self.large

        def integrate(
            t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
        ) -> Run:
            largest = iteration.largest_of_roots if by_itself else None
            run = library.run(
                t, stop, z, p, save, rtol=how.rtol, atol=how.atol, signals=given.signals, first_step=step,
                max_steps=steps, method=METHODS.index(how.method), noise=iteration.noise, end_open=end_open,
                largest=largest,
            )  # fmt: skip
            if largest is not None:
                iteration.note_largest(largest)
            return run

        return run_hybrid(
            iteration, outcome, t0, t1, save, integrate, first_step=how.first_step,
            max_steps=how.max_steps,
        )  # fmt: skip

    def sensitivities(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, seeds: Sequence[Seed],
        check: bool = True,
    ) -> tuple[Started, Run | HybridRun, Floats, Floats]:  # fmt: skip
        """As `run`, with derivatives along `seeds`: of z (n_t, n, k) and of the parameters (n_p, k).

        In a run with events those of the slots follow those of z.
        """
        width = next((w for w in WIDTHS if w >= len(seeds)), WIDTHS[-1])
        library = self.native_library(how.method, width)
        started = self.start(t0, given, library, check)
        slopes: list[Floats] = []
        p_slopes: list[Floats] = []
        run: Run | HybridRun | None = None
        for first in range(0, len(seeds), width):
            chosen = seeds[first : first + width]
            if started.iteration is not None:
                started = self.start(t0, given, library, check) if first else started
                run, dz, dp = self._tangents_events(library, started, t0, t1, save, given, how, chosen)
                slopes.append(dz[:, :, : len(chosen)])
                p_slopes.append(dp[:, : len(chosen)])
                continue
            dz0, dp = self._start_tangents(library).at(t0, given.initial, started, chosen)
            run = library.run(
                t0, t1, started.z0, started.p, save, rtol=how.rtol, atol=how.atol, signals=given.signals,
                first_step=how.first_step, max_steps=how.max_steps, tangents=(dz0, dp),
            )  # fmt: skip
            assert run.dz is not None
            slopes.append(run.dz[:, :, : len(chosen)])
            p_slopes.append(dp[:, : len(chosen)])
        assert run is not None
        return started, run, np.concatenate(slopes, axis=2), np.concatenate(p_slopes, axis=1)

    def _tangents_events(
        self, library: NativeLibrary, started: Started, t0: float, t1: float, save: Floats, given: Given,
        how: Tolerances, seeds: Sequence[Seed],
    ) -> tuple[HybridRun, Floats, Floats]:  # fmt: skip
        """A run with events and its derivatives: of z and the slots (n_t, n + n_slots, lanes), of p (n_p, lanes)."""
        iteration = started.iteration
        assert iteration is not None

        def integrate(
            t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int,
            dz: Floats, dp: Floats,
        ) -> tuple[Run, Floats, Floats]:  # fmt: skip
            run = library.run(
                t, stop, z, p, save, rtol=how.rtol, atol=how.atol, signals=given.signals, first_step=step,
                max_steps=steps, method=METHODS.index(how.method), noise=iteration.noise, end_open=end_open,
                tangents=(dz, dp),
            )  # fmt: skip
            assert run.dz is not None and run.dz_end is not None
            return run, run.dz[: run.saved], run.dz_end

        return run_with_tangents(
            started, t0, t1, save, given, self._start_tangents(library), seeds,
            lambda t: np.array([_slope(s, t) for s in given.signals]), integrate, first_step=how.first_step,
            max_steps=how.max_steps,
        )  # fmt: skip

    def _start_tangents(self, library: NativeLibrary) -> StartTangents:
        return StartTangents(self.system, None if self.large else library, library.lanes)

    # ---- what follows from the states -------------------------------------------------------------
    def observe(
        self, t: Floats, z: Floats, p: Floats, signals: Sequence[Signal], slots: Floats | None = None
    ) -> Floats:
        """All variables of the reduced model, (n_t, n_ids); `slots` (n_t, n_slots) are those of a run with events."""
        library = self._any_library()
        if slots is None:
            return library.observe(p, signals, t, z)
        values = np.empty((len(t), self.system.lowered.n_ids))
        cuts = np.flatnonzero((slots[1:] != slots[:-1]).any(axis=1)) + 1
        for a, b in zip([0, *cuts.tolist()], [*cuts.tolist(), len(t)], strict=True):
            if b > a:
                at = p.copy()
                at[self.system.hybrid.slots] = slots[a]
                values[a:b] = library.observe(at, signals, t[a:b], z[a:b])
        return values


def _slope(signal: Signal, t: float) -> float:
    """Rate of an input."""
    times, values = signal
    if len(times) == 1 or not times[0] <= t < times[-1]:
        return 0.0
    k = int(np.searchsorted(times, t, side="right")) - 1
    return float((values[k + 1] - values[k]) / (times[k + 1] - times[k]))


def operations(lowered: Any) -> int:
    """Operations of the written-out system."""
    total = 0
    for group in lowered.schedule.groups:
        kernel = group.kernel
        total += group.size * (len(postorder(kernel.expressions)) + len(kernel.matrix) ** 3 // 10)
    return total


def native_model(system: Any) -> NativeModel:
    """The system's native model: C is written once.

    Raises:
        NotInC: the model has something that cannot be written in C.
    """
    if "native" not in system.cache:
        flat = system.stages.flat
        loops = operations(system.lowered) > LARGEST

        def label(v: int) -> str:
            return flat.name(v) if v < flat.n_total else ""

        source = to_c(system.program, system.initial, label, hybrid=system.hybrid, loops=loops)
        system.cache["native"] = NativeModel(system, source)
    return system.cache["native"]
