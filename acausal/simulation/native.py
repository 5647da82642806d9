"""The native engine: a whole run in compiled C, from the given values to the trajectories and their sensitivities.

Nothing here needs JAX; `native_jax` wraps it for JAX's transformations.
"""

from __future__ import annotations

import threading
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from acausal.errors import InitializationError
from acausal.language.template import Ints
from acausal.lowering.bounds import check_parameters
from acausal.lowering.c.generate import CSource, to_c
from acausal.lowering.initial import EASE_ALGEBRAIC, SATISFIED, given_starts
from acausal.lowering.initial_numeric import conditions_of, least_change, solve_numeric
from acausal.lowering.numeric import NumericRun
from acausal.symbolic.traverse import postorder

from .event_iteration import EventIteration, Move, Outcome, left_starts
from .event_tangents import EventTangents
from .hybrid_run import HybridRun, run_hybrid, warn
from .native_build import build
from .native_library import METHODS, Floats, NativeLibrary, Run, Signal

LARGEST = 1_000
"""Operations up to which a system is written out in C: compiling grows faster than their number."""
WIDTHS = (1, 2, 4, 8)
"""Numbers of directions that a library is compiled for; more directions take several runs."""


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


@dataclass(frozen=True, slots=True, eq=False)
class NativeEquations:
    """The compiled equations for the iteration of events."""

    model: NativeModel
    library: NativeLibrary
    signals: Sequence[Signal]

    def feed(self, t: float, p: Floats) -> None:
        """Inputs at time t into p."""
        first = self.model.system.program.flat.n_par
        for k, (times, values) in enumerate(self.signals):
            p[first + k] = np.interp(t, times, values)

    def settle(self, t: float, z: Floats, p: Floats) -> Floats | None:
        """z with the algebraic unknowns solved for."""
        low = self.model.system.lowered
        if not low.n_w:
            return z
        z = z.copy()
        return z if self.library.settle(p, self.signals, t, z) else None

    def values(self, t: float, z: Floats, p: Floats) -> Floats:
        """All reduced variables."""
        return self.library.observe(p, self.signals, np.array([t]), z[None])[0]


@dataclass(eq=False)
class NativeModel:
    """A system with its compiled libraries, made when they are first needed."""

    system: Any
    source: CSource
    libraries: dict[int, NativeLibrary] = field(default_factory=dict[int, NativeLibrary])
    lock: Any = field(default_factory=threading.Lock)

    def library(self, width: int = 0) -> NativeLibrary:
        """The library with tangents in `width` directions; 0 is without."""
        with self.lock:
            if width not in self.libraries:
                defines = ("AC_TANGENTS", f"AC_LANES={width}") if width else ()
                low = self.system.lowered
                nominal = np.concatenate([low.x_nominal, low.w_nominal])
                made = build(self.source, defines)
                self.libraries[width] = NativeLibrary(made, bool(width), self.source.tables, nominal)
            return self.libraries[width]

    # ---- start ------------------------------------------------------------------------------------
    def start(self, t0: float, given: Given, library: NativeLibrary, check: bool = True) -> Started:
        """Parameters and a consistent start.

        Raises:
            InitializationError, DeclarationError: as `System.check_initial`.
        """
        system = self.system
        program, problem = system.program, system.initial
        p = program.base.copy()
        mask = np.zeros(program.n_p, np.uint8)
        for name, value in given.parameters.items():
            ids = self.parameter_ids(name)
            mask[ids] = 1
            p[ids] = np.broadcast_to(np.asarray(value, float), ids.shape)
        for k, (times, values) in enumerate(given.signals):
            p[program.flat.n_par + k] = np.interp(t0, times, values)
        if self.large:
            p = program.completed(p, mask.astype(bool))
            starts = program.starts(p, np)
        else:
            library.parameters(mask, p)
            starts = program.flat.start.copy()
            library.starts(p, starts)
        overrides = system._overrides(given.initial, np)
        own = not self.large and _own_conditions(problem, overrides)

        def solve(p: Floats) -> tuple[Floats, Floats]:
            if own and problem.lowered.n_x + problem.lowered.n_w:
                given_at = given_starts(problem, starts, overrides, np)
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
            iteration = EventIteration(system.hybrid, problem, NativeEquations(self, library, given.signals), warn)
            outcome, left = iteration.start(t0, p, starts, solve)
            z0, p = outcome.z, outcome.p
        if check:
            system.check_initial(z0[: problem.lowered.n_x], z0[problem.lowered.n_x :], p, left, t0)
        else:
            check_parameters(program.flat, p)
        return Started(z0, p, left, mask, iteration, outcome, [] if iteration is None else iteration.moves)

    @property
    def large(self) -> bool:
        """Whether families are loops."""
        return bool(self.source.tables)

    def parameter_ids(self, name: str) -> Any:
        """Numbers of a parameter (of an array: of all elements)."""
        cache = self.system.cache.setdefault("parameter_ids", {})
        if name not in cache:
            cache[name] = self.system.program.flat.names.find(name, parameter=True)[0].ravel()
        return cache[name]

    # ---- run --------------------------------------------------------------------------------------
    def run(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, check: bool = True
    ) -> tuple[Started, Run | HybridRun]:
        """Start and integrate."""
        library = self.library()
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
        library = self.library(width)
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
            dz0, dp = self._start_tangent(t0, given, started, library, chosen)
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
        iteration, outcome = started.iteration, started.outcome
        assert iteration is not None and outcome is not None
        tangents = EventTangents(iteration, lambda t: np.array([_slope(s, t) for s in given.signals]))
        first = replace(started, z0=started.moves[0].z, p=started.moves[0].p)
        moving: list[Any] = [*tangents.start(started.moves, *self._start_tangent(t0, given, first, library, seeds))]
        found: list[Floats] = []

        def integrate(
            t: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
        ) -> Run:
            run = library.run(
                t, stop, z, p, save, rtol=how.rtol, atol=how.atol, signals=given.signals, first_step=step,
                max_steps=steps, method=METHODS.index(how.method), noise=iteration.noise, end_open=end_open,
                tangents=(moving[0], moving[1]),
            )  # fmt: skip
            assert run.dz is not None
            held = moving[1][iteration.hybrid.slots]
            held = np.broadcast_to(held, (run.saved, *held.shape))
            found.append(np.concatenate([run.dz[: run.saved], held], axis=1))
            moving[0] = run.dz_end
            return run

        def at_event(t: float, segment: Any, after: Outcome, samples: list[int]) -> None:
            roots = segment.switched if segment is not None and segment.code else None
            moving[:] = tangents.event(iteration.moves, after.p, moving[0], moving[1], roots, samples)

        run = run_hybrid(
            iteration, outcome, t0, t1, save, integrate, first_step=how.first_step, max_steps=how.max_steps,
            at_event=at_event,
        )  # fmt: skip
        dz = np.concatenate(found)
        last = np.concatenate([moving[0], moving[1][iteration.hybrid.slots]])[None]
        if len(dz) < len(run.z) or run.closed:  # the end itself, where `terminate` or `terminal()` have changed it
            dz = np.concatenate([dz[: len(run.z) - 1], last])
        return run, dz, moving[1]

    def _start_tangent(
        self, t0: float, given: Given, started: Started, library: NativeLibrary, seeds: Sequence[Seed]
    ) -> tuple[Floats, Floats]:
        """Tangents of z0 (n, lanes) and p (n_p, lanes): the implicit-function theorem at the start.

        Where the conditions leave freedom, start values move the solution within the null space of the Jacobian.
        """
        system, lanes = self.system, library.lanes
        program, problem = system.program, system.initial
        low = problem.lowered
        dp = np.zeros((program.n_p, lanes))
        for k, seed in enumerate(seeds):
            if seed.kind != "initial":
                first = program.flat.n_par if seed.kind == "input" else 0
                dp[first + np.array(seed.indices), k] = 1.0
        d_starts, starts = self._starts_tangent(library, started, dp)
        if system.hybrid is not None:
            for piece, ids, signs in left_starts(system.hybrid):
                dp[piece.slots] = (signs * problem.start_sign[ids])[:, None] * d_starts[problem.start_source[ids]]
        overrides = system._overrides(given.initial, np)
        given_at = given_starts(problem, starts, overrides, np)
        dz = np.zeros((library.n, lanes))
        known = np.concatenate([low.schedule.states, low.schedule.tears])
        source, sign = problem.start_source[known], problem.start_sign[known]
        dz[:] = sign[:, None] * np.where(np.isnan(starts[source])[:, None], 0.0, d_starts[source])
        dz[low.n_x :] = 0.0
        ids = given_at.ids
        d_wanted = problem.start_sign[ids, None] * d_starts[problem.start_source[ids]]
        position = {int(v): i for i, v in enumerate(low.schedule.states)}
        further = [v for v in overrides if v not in position]  # their conditions come last
        row = {v: len(ids) - len(further) + i for i, v in enumerate(further)}
        d_wanted[len(ids) - len(further) :] = 0.0
        for k, seed in enumerate(seeds):
            for index, sign_of in zip(seed.indices, seed.signs, strict=True) if seed.kind == "initial" else ():
                if index in row:
                    d_wanted[row[index], k] = sign_of
                else:
                    dz[position[index]] = 0.0
                    dz[position[index], k] = sign_of
        own = not self.large and _own_conditions(problem, overrides)
        j, rate = self._conditions_tangent(library, t0, started, dz, dp, None if own else ids)
        n_w, n_g = low.n_w, low.n_g
        rate[n_w + n_g : n_w + n_g + len(ids)] -= d_wanted
        fixed = given_at.fixed if given_at.conditions else np.ones(low.n_x, bool)
        free = np.concatenate([np.flatnonzero(~fixed), low.n_x + np.arange(n_w)])
        ease = np.concatenate([problem.ease, EASE_ALGEBRAIC * low.w_nominal])[free]
        if len(free) and len(rate):
            dz[free] += ease[:, None] * least_change(j[:, free], ease, rate)
        return dz, dp

    def _starts_tangent(self, library: NativeLibrary, started: Started, dp: Floats) -> tuple[Floats, Floats]:
        """Tangents of the start values and the values; `dp` is completed in place."""
        program = self.system.program
        if self.large:
            return program.tangents(started.p, started.mask.astype(bool), dp), program.starts(started.p, np)
        library.parameters_tangent(started.mask, started.p, dp)
        d_starts = np.zeros((len(program.flat.start), library.lanes))
        library.starts_tangent(started.p, dp, d_starts)
        starts = program.flat.start.copy()
        library.starts(started.p, starts)
        return d_starts, starts

    def _conditions_tangent(
        self, library: NativeLibrary, t0: float, started: Started, dz: Floats, dp: Floats, ids: Ints | None
    ) -> tuple[Any, Floats]:
        """Jacobian of the start's conditions with respect to z, and their tangents (n_i, lanes).

        `ids` are the variables whose start is a condition, where these are not those that were compiled.
        """
        if ids is None:
            slope = library.conditions(started.p, t0, started.z0)[1]
            return slope, library.conditions_tangent(started.p, dp, t0, started.z0, dz)
        problem = self.system.initial
        low = problem.lowered
        x, w = started.z0[: low.n_x], started.z0[low.n_x :]
        run = NumericRun(low, t0, x, w, started.p, np.arange(low.n_x), dz, dp)
        invariants, extra = (run.families(f)[1] for f in (low.schedule.invariants, problem.families))
        rate = np.concatenate([run.residual[1], invariants, run.gradient[ids], extra])
        if not len(rate):
            return np.zeros((0, low.n_x + low.n_w)), rate
        found = conditions_of(problem, t0, started.p, ids, np.zeros(len(ids)))
        if found is None:
            raise InitializationError(
                "the start of this model is too large for the native engine's derivatives; take engine='diffrax'"
            )
        return found[0](started.z0)[1], rate

    # ---- what follows from the states -------------------------------------------------------------
    def observe(
        self, t: Floats, z: Floats, p: Floats, signals: Sequence[Signal], slots: Floats | None = None
    ) -> Floats:
        """All variables of the flat model, (n_t, n_all); `slots` (n_t, n_slots) are those of a run with events."""
        low = self.system.lowered
        if slots is None:
            values = self.library().observe(p, signals, t, z)
        else:
            values = np.empty((len(t), low.n_ids))
            cuts = np.flatnonzero((slots[1:] != slots[:-1]).any(axis=1)) + 1
            for a, b in zip([0, *cuts.tolist()], [*cuts.tolist(), len(t)], strict=True):
                if b > a:
                    at = p.copy()
                    at[self.system.hybrid.slots] = slots[a]
                    values[a:b] = self.library().observe(at, signals, t[a:b], z[a:b])
        found = values[:, low.representative]
        found[:, low.sign < 0] *= -1.0
        found[:, low.sign == 0] = 0.0
        return found


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
        roots = [e for _, e in kernel.steps] + list(kernel.residuals) + [e for line in kernel.matrix for e in line]
        total += group.size * (len(postorder(roots)) + len(kernel.matrix) ** 3 // 10)
    return total


def _own_conditions(problem: Any, overrides: Mapping[int, Any]) -> bool:
    """Whether the conditions of the start are those that were compiled: further fixed starts are of states only."""
    states = set(problem.lowered.schedule.states.tolist())
    return all(k in states for k in overrides)


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
