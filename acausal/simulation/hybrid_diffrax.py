"""Runs with events on the diffrax engine: each stretch between events is one diffrax solve with a root finder.

Events themselves are carried out with NumPy, as on the native engine.
"""

from __future__ import annotations

import functools
import time
from collections.abc import Mapping, Sequence
from contextlib import nullcontext
from dataclasses import dataclass
from typing import Any

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import optimistix as optx

from acausal.errors import InitializationError, SimulationError
from acausal.lowering.initial_numeric import gauss_newton_part, solve_numeric
from acausal.lowering.numeric import NumericRun, is_concrete

from . import simulate as plain
from .arguments import asks_for_steps, is_saveat
from .cache import ById
from .conditions import sides
from .continuation import followed
from .controller import ROUNDING, smallest_step
from .engines import all_signals, output_times
from .event_iteration import EventIteration
from .event_tangents import EventTangents
from .failure import explain
from .hybrid_run import EVENT, HybridRun, Integrate, run_hybrid
from .hybrid_static import Stretch, static_integrate
from .hybrid_tangents import Differentiated, run_with_tangents
from .inputs import DrivenLowered, drive
from .jit import compiled_for, values_are_known
from .kinks import has_kinks, kinks
from .mode_search import Equations
from .native_library import RESULTS, Floats
from .rodas5p import Rodas5P
from .solution import Solution
from .start_tangents import StartTangents
from .started import Given, Seed, Started, Tolerances, given_values
from .switch import Switch
from .traced import Way, simulate_traced
from .watch import watch

UNSEEN = 1e-3
"""Part of its size from which a condition behind its switch has been overlooked."""
SLACK = 1e-12
"""What happens at the same time as an event is this close to its switch, relative to the condition's largest value."""
TIME, NEAR_ZERO = 1e-14, 1e-30
"""Width of the interval in which an event is located, relative to the time, and near t = 0 [s]."""
TINY = 1e-200
"""Slack of what is at its switch exactly: just not zero."""
SAME = 1e-13
"""Output times this close to that of an event, relative to it, are the event's: they show what follows."""


OUTSIDE = (
    "The diffrax engine carries out events outside of JAX's programs, where the values are known: jax.grad, jax.jacfwd "
    "and jax.jacrev of a run with events work; inside of jit or vmap (and so in a calibration or an ensemble) it "
    "cannot run. The native engine can (engine='native'; it needs a C compiler); and events=False switches events off "
    "where the model has conditions only."
)


class _JustBehind(optx.Bisection[Any]):
    """Bisection from positive to negative that returns the end of the last interval at which the value is negative.

    In its middle, no condition need have switched.
    """

    def postprocess(
        self, fn: Any, y: Any, aux: Any, args: Any, options: Any, state: Any, tags: Any, result: Any
    ) -> tuple[Any, Any, dict[str, Any]]:
        return state.upper, aux, {}


@dataclass(frozen=True, slots=True, eq=False)
class NumericEquations:
    """The equations with NumPy, for the iteration of events."""

    system: Any
    lowered: Any
    numbers: Any

    def feed(self, t: float, p: Floats) -> None:
        """Inputs at time t into p."""
        if isinstance(self.lowered, DrivenLowered):
            p[self.lowered.places] = [float(v) for v in self.lowered.values(t, self.numbers)]

    def settle(self, t: float, z: Floats, p: Floats) -> Floats | None:
        """z with the algebraic unknowns solved for."""
        low = self.system.lowered
        if not low.n_w:
            return z
        every = np.arange(low.n_x)

        def residual(z: Floats) -> tuple[Floats, Floats]:
            return NumericRun(low, t, z[: low.n_x], z[low.n_x :], p, every).residual

        nominal = np.concatenate([low.x_nominal, low.w_nominal])
        found, left = gauss_newton_part(residual, z, nominal, nominal, low.n_x + np.arange(low.n_w))
        return found if np.isfinite(left).all() and np.max(left, initial=0.0) <= 1e-9 else None

    def values(self, t: float, z: Floats, p: Floats) -> Floats:
        """All reduced variables."""
        low = self.system.lowered
        none = np.zeros((len(z), 0))
        return NumericRun(low, t, z[: low.n_x], z[low.n_x :], p, np.zeros(0, np.int64), none).value


@dataclass(eq=False)
class DiffraxModel:
    """A system with events, as `acausal.simulation.native.NativeModel`, for runs of one kind.

    Attributes:
        system: the system.
        functions: inputs that are functions of time, by name.
        tables: names of the inputs that are tables.
        method, controller: of the stretches.
        has_dt: whether the first step is given.
        compile_seconds: what compiling has taken.
    """

    system: Any
    functions: Mapping[str, Any]
    tables: tuple[str, ...]
    method: Any
    controller: Any
    has_dt: bool
    compile_seconds: float = 0.0

    def driven(self, given: Given) -> tuple[Any, Any]:
        """The lowered system whose inputs follow time, and their numbers."""
        names = tuple(self.system.input_names)
        moving = {name: given.signals[names.index(name)] for name in self.tables} | dict(self.functions)
        return drive(self.system, moving) if moving else (self.system.lowered, None)

    def start(self, t0: float, given: Given, check: bool) -> Started:
        """A consistent start, and the iteration of events.

        Raises:
            InitializationError, DeclarationError: as `System.check_initial`.
        """
        system = self.system
        low, program = system.lowered, system.program
        p, mask = given_values(system, t0, given)
        p = program.completed(p, mask.astype(bool))
        equations = NumericEquations(system, *self.driven(given))
        iteration = EventIteration(system.hybrid, system.initial, equations)
        equations.feed(t0, p)
        starts, overrides = program.starts(p, np), system._overrides(given.initial, np)

        def solve(p: Floats) -> tuple[Floats, Floats]:
            found = solve_numeric(system.initial, t0, p, starts, overrides)
            if found is None:
                raise InitializationError("the start of this model is too large for a run with events")
            return np.concatenate(found[:2]), found[2]

        outcome, left = iteration.start(t0, p, starts, solve)
        if check:
            system.check_initial(outcome.z[: low.n_x], outcome.z[low.n_x :], outcome.p, left, t0, given.initial)
        return Started(outcome.z, outcome.p, left, mask, iteration, outcome, iteration.moves)

    def run(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, check: bool = True
    ) -> tuple[Started, HybridRun]:
        """Start and integrate."""
        started = self.start(t0, given, check)
        assert started.iteration is not None and started.outcome is not None
        stretches = _Stretches(self, started.iteration, save, how)
        integrate = stretches.integrate if self.system.lowered.n_x else stretches.static()
        run = run_hybrid(
            started.iteration, started.outcome, t0, t1, save, integrate, first_step=0.0, max_steps=how.max_steps
        )
        return started, run

    def sensitivities(
        self, t0: float, t1: float, save: Floats, given: Given, how: Tolerances, seeds: Sequence[Seed],
        check: bool = True,
    ) -> tuple[Started, HybridRun, Floats, Floats]:  # fmt: skip
        """As `run`, with derivatives along `seeds`: of z and the slots (n_t, n + n_slots, k), of the parameters."""
        started = self.start(t0, given, check)
        assert started.iteration is not None
        stretches = _Stretches(self, started.iteration, save, how)
        run, dz, dp = run_with_tangents(
            started, t0, t1, save, given, StartTangents(self.system, None, len(seeds)), seeds, stretches.rates,
            stretches.differentiated(), first_step=0.0, max_steps=how.max_steps,
        )  # fmt: skip
        return started, run, dz, dp


@dataclass(eq=False)
class _Stretches:
    """The stretches of one run."""

    model: DiffraxModel
    iteration: EventIteration
    save: Floats
    tolerances: Tolerances

    def __post_init__(self) -> None:
        self.lowered, self.numbers = _driven(self.iteration)

    def integrate(
        self, t: float, stop: float, z: Floats, p: Floats, remaining: Floats, step: float, end_open: bool, steps: int
    ) -> Stretch:
        """To the first event or to `stop`; as `acausal.simulation.hybrid_run.Integrate`."""
        if stop - t <= ROUNDING * abs(t):  # between an event and the end there is no room for a step
            n = 0 if end_open else int((remaining <= stop).sum())
            return Stretch(np.tile(z, (n, 1)), 0, n, max(t, stop), z, step, None, {})
        hybrid, equations, n_x = self.iteration.hybrid, self.iteration.equations, self.lowered.n_x
        before = sides(hybrid, equations, t, z, p)
        slack, rest = _slack(self.iteration, before), jnp.asarray(stop - t)
        together = isinstance(self.model.method, Rodas5P)
        size, noise = jnp.asarray(self.iteration.sizes_of_roots), jnp.asarray(self.iteration.noise)
        held = ById(self.lowered, keep=False)
        switch = Switch(jnp.asarray(slack), size, noise, rest, held, hybrid.roots, together, n_x)
        finder = _JustBehind(rtol=TIME, atol=NEAR_ZERO, flip=True)  # what switches by rounding is at an end of the step
        event = diffrax.Event(switch, finder) if hybrid.roots.count else None
        outcome, seconds, _ = plain.carry_out(
            self.lowered, self._settings(event), self._arguments(t, stop, z, p, remaining)
        )
        self.model.compile_seconds += seconds
        _, x, w, counts, code, last = outcome
        name = plain.result_name(int(code))
        t_end = float(last[0])
        z_end = np.concatenate([np.asarray(last[1]), np.asarray(last[2])])
        happened = name == "event_occurred"
        until = t_end - SAME * abs(t_end) if happened else t_end
        n = int((remaining < until if happened or end_open else remaining <= until).sum())
        found = np.concatenate([np.asarray(x), np.asarray(w)], axis=1)[:n]
        named = {k: int(c) for k, c in zip(("steps", "accepted", "rejected"), counts, strict=True)}
        if sum(named.values()) and steps < named["steps"]:
            name = "max_steps_reached"
        result = EVENT if happened else RESULTS.index(name) if name in RESULTS else 1
        if result == 0:
            self._check_seen(t_end, z_end, p, slack)
        roots = _switched(self.iteration, equations, t_end, z_end, p, slack, before) if happened else None
        return Stretch(found, result, n, t_end, z_end, 0.0, roots, named)

    def _check_seen(self, t: float, z: Floats, p: Floats, slack: Floats) -> None:
        """Raise an error where a condition is on the other side than its mode says, and no event was found."""
        iteration = self.iteration
        beyond = sides(iteration.hybrid, iteration.equations, t, z, p) - slack
        unseen = beyond > UNSEEN * np.maximum(iteration.sizes_of_roots, np.abs(beyond))
        if unseen.any():
            slots = dict.fromkeys(iteration.hybrid.roots.slots[unseen].tolist())
            texts = [iteration.hybrid.text(s) for s in slots if s >= 0] or ["a step of `floor`"]
            raise SimulationError(
                f"By t = {t:.12g} s these conditions have switched, and no event was found:\n"
                + "\n".join(f"    {text}" for text in texts[:8])
                + "\nWhat is compared there hangs on rounding, as how several stuck frictions share the load of one "
                "shaft. Take engine='native', or give the components that share it some elasticity."
            )

    def static(self) -> Integrate:
        """The same for a model without states."""
        hybrid, lowered = self.iteration.hybrid, self.lowered
        none = jnp.zeros(hybrid.roots.count)
        switch = Switch(none, none, none, jnp.zeros(()), ById(lowered, keep=False), hybrid.roots, True, 0)
        run = jax.jit(functools.partial(_look, switch))

        def look(begin: float, t: float, z: Floats, p: Floats) -> tuple[Floats, Floats]:
            given: Any = (p, self.numbers) if isinstance(lowered, DrivenLowered) else p
            arguments = (np.asarray(begin), np.asarray(t), z, given)
            compiled, seconds = compiled_for(lowered, "look", run, arguments)
            self.model.compile_seconds += seconds
            w, beyond = compiled(*arguments)
            return np.asarray(w), np.asarray(beyond)

        if not has_kinks(lowered):
            return static_integrate(self.iteration, look, lambda t, stop, p: np.inf)

        @jax.jit
        def kink(t: Any, stop: Any, p: Any) -> Any:
            found = kinks(lowered, (p, self.numbers))
            assert found is not None
            return found.after(t, smallest_step(t, ROUNDING * (stop - t)))

        return static_integrate(self.iteration, look, lambda t, stop, p: float(kink(t, stop, p)))

    def differentiated(self) -> Differentiated:
        """Stretches with their derivatives."""
        if self.lowered.n_x:
            return lambda *arguments: self._with_slopes(self.integrate(*arguments[:-2]), *arguments)
        tangents, static = EventTangents(self.iteration, self.rates), self.static()

        def at(t: float, z: Floats, p: Floats, dp: Floats) -> Floats:
            p = p.copy()
            self.iteration.equations.feed(t, p)
            k = dp.shape[1]
            return tangents.with_algebraic(t, z, p, np.zeros((0, k)), dp, np.zeros(k))

        def integrate(t: float, stop: float, z: Floats, p: Floats, remaining: Floats, *rest: Any) -> Any:
            dz, dp = rest[-2:]
            run = static(t, stop, z, p, remaining, *rest[:-2])
            rows = [at(float(at_t), z, p, dp) for at_t, z in zip(remaining, run.z, strict=False)]
            return run, np.array(rows).reshape((run.saved, *dz.shape)), at(run.t_end, run.z_end, p, dp)

        return integrate

    def rates(self, t: float) -> Floats:
        """Rates of the inputs."""
        out = np.zeros(len(self.model.system.input_names))
        if isinstance(self.lowered, DrivenLowered):
            values = functools.partial(self.lowered.values, data=self.numbers)
            moving = jax.jvp(lambda t: jnp.stack(values(t)), (jnp.asarray(t),), (jnp.ones(()),))[1]
            held = self.iteration.hybrid.flat.slots.count
            out[self.lowered.places + held] = np.asarray(moving)
        return out

    def _settings(self, event: Any) -> Any:
        model, most = self.model, self.tolerances.max_steps
        return plain.settings_of(
            model.method, ("times",), controller=model.controller, has_dt=model.has_dt, event=event, max_steps=most
        )

    def _arguments(self, t: float, stop: float, z: Floats, p: Floats, remaining: Floats) -> tuple[Any, ...]:
        """Arguments of the solve; its output times are as many in every stretch."""
        n_x, tolerances = self.lowered.n_x, self.tolerances
        times = np.full(len(self.save), stop)
        times[: len(remaining)] = np.clip(remaining, t, stop)
        vector = jnp.asarray(p)
        return (
            jnp.asarray(t), jnp.asarray(stop), jnp.asarray(z[:n_x]), jnp.asarray(z[n_x:]),
            (vector, self.numbers) if isinstance(self.lowered, DrivenLowered) else vector,
            jnp.asarray(tolerances.rtol), jnp.asarray(tolerances.atol), jnp.asarray(times),
            jnp.asarray(tolerances.first_step),
        )  # fmt: skip

    def _with_slopes(
        self, run: Stretch, t: float, stop: float, z: Floats, p: Floats, remaining: Floats, *rest: Any
    ) -> tuple[Stretch, Floats, Floats]:
        """A stretch that has been solved, with derivatives: it is solved again, up to its end, with them."""
        dz, dp = rest[-2:]
        n_x = self.lowered.n_x
        if not run.counts or run.t_end - t <= ROUNDING * abs(t):
            return run, np.tile(dz, (run.saved, 1, 1)), dz
        directions = jnp.asarray(dz[:n_x]), jnp.asarray(dz[n_x:]), jnp.asarray(dp)
        outcome, seconds = plain.carry_out_slopes(
            self.lowered, self._settings(None), self._arguments(t, run.t_end, z, p, remaining), directions
        )
        self.model.compile_seconds += seconds
        x, w, x_end, w_end = (np.asarray(a) for a in outcome)
        return run, np.concatenate([x, w], axis=1)[: run.saved], np.concatenate([x_end, w_end])


def _driven(iteration: Any) -> tuple[Any, Any]:
    """The lowered system of a run, with its inputs, and their numbers."""
    equations = iteration.equations
    assert isinstance(equations, NumericEquations)
    return equations.lowered, equations.numbers


def simulate_events(
    system: Any, t1: Any, *, t0: Any = 0.0, parameters: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None, inputs: Mapping[str, Any] | None = None, saveat: Any = None,
    rtol: Any = 1e-6, atol: Any = None, solver: Any = None, max_steps: int | None = None, throw: bool = True,
    dt: Any = None, stepsize_controller: Any = None, adjoint: Any = None, events: Any = True, progress: bool = False,
) -> Solution:  # fmt: skip
    """As `acausal.simulation.simulate.simulate`, for a system with events; values are numbers, or differentiated."""
    if not values_are_known((t0, t1, parameters, initial, inputs, saveat, rtol, atol, dt)):
        raise SimulationError(OUTSIDE)
    if adjoint is not None:
        raise SimulationError("`adjoint=` has no meaning in a run with events.")
    if events is not True:
        raise SimulationError(
            "`events=` with a diffrax event does not go with the model's own events: end the run with "
            "`terminate` in a `when` of the model."
        )
    if is_saveat(saveat) and asks_for_steps(saveat):
        raise SimulationError(
            "`saveat=` asks for the solver's own steps, which a run with events does not keep: give output times."
        )
    functions = {k: v for k, v in (inputs or {}).items() if callable(v)}
    signals = all_signals(system, {k: v for k, v in (inputs or {}).items() if k not in functions})
    tables = tuple(k for k, (t, _) in zip(system.input_names, signals, strict=True) if np.shape(t)[0] > 1)
    low = system.lowered
    method = plain.with_linear_solver(plain.chosen_solver(solver), low)
    most = plain.MAX_STEPS if max_steps is None else max_steps
    model = DiffraxModel(system, functions, tables, method, stepsize_controller, dt is not None)
    name = type(method).__name__
    relative = jnp.asarray(rtol, float)
    absolute = jnp.broadcast_to(plain.ATOL * relative if atol is None else jnp.asarray(atol, float), (low.n_x,))
    step = 0.0 if dt is None else dt
    if not is_concrete((t0, t1, parameters, initial, relative, absolute, signals)):
        return simulate_traced(
            model, Way(name, "diffrax", direct=True), t0, t1, saveat, relative, absolute, step, dict(parameters or {}),
            dict(initial or {}), signals, inputs=inputs, max_steps=most, throw=throw,
        )  # fmt: skip
    t0, t1 = float(t0), float(t1)
    begin = time.perf_counter()
    given = Given(parameters or {}, initial or {}, [(np.asarray(t, float), np.asarray(v, float)) for t, v in signals])
    how = Tolerances(float(relative), np.asarray(absolute), float(step), most)
    with watch.showing(t0, t1) if progress else nullcontext():
        started, run = model.run(t0, t1, output_times(saveat, t0, t1), given, how, check=throw)
    seconds = time.perf_counter() - begin
    return _finished(model, started, run, how, seconds, t1, throw)


def _finished(
    model: DiffraxModel, started: Started, run: HybridRun, how: Tolerances, seconds: float, t1: float, throw: bool
) -> Solution:
    """The solution of a run with numbers; raises where it failed."""
    system, n_x = model.system, model.system.lowered.n_x
    stats: dict[str, Any] = {k: run.counts[k] for k in ("steps", "accepted", "rejected")}
    stats |= {"compile_seconds": model.compile_seconds, "run_seconds": seconds - model.compile_seconds}
    stats |= {"solver": type(model.method).__name__, "t_end": run.t_end}
    lowered, numbers = _driven(started.iteration)
    vector: Any = jnp.asarray(run.p_end)
    vector = (vector, numbers) if isinstance(lowered, DrivenLowered) else vector
    solution = Solution(
        system, run.save, run.z[:, :n_x], run.z[:, n_x:], vector, stats=stats, result=run.result,
        events=tuple(run.events), lowered=lowered, slots=run.slots,
    )  # fmt: skip
    solution.strict = throw
    if throw and run.code:
        last = run.t_end, run.z_end[:n_x], run.z_end[n_x:]
        raise SimulationError(explain(system, lowered, run.result, stats, last, solution.p, t1, how.max_steps))
    return solution


def _look(switch: Switch, begin: Any, t: Any, w: Any, p: Any) -> tuple[Any, Any]:
    """A model without states at time t, from its solution at `begin`, and how far its conditions are behind."""
    w = followed(switch.lowered, begin, t, w, p) if switch.lowered.n_w else w
    return w, -switch.sides(t, w, p)


def _slack(iteration: EventIteration, before: Floats) -> Floats:
    """What conditions may be on the other side that are at their switch at the start of a stretch."""
    return np.where(-before <= iteration.noise, 10.0 * np.abs(before) + iteration.noise + TINY, 0.0)


def _switched(
    iteration: EventIteration, equations: Equations, t: float, z: Floats, p: Floats, slack: Floats, before: Floats
) -> Any:
    """The conditions that switch at a root: what is behind its switch, and what is there but for rounding.

    If rounding has put none behind, it is the one that is nearest for its size. What has rested at its switch since
    the start of the stretch (it has `slack`) is no nearer to it than it was: it switches where it has left its slack
    behind. Neither is what has switched just before and moves away.

    Args:
        slack, before: of the start of the stretch; `before` as `sides`.
    """
    settled = equations.settle(t, z, p)
    distance = slack - sides(iteration.hybrid, equations, t, z if settled is None else settled, p)
    behind, moving = distance <= 0.0, (slack == 0.0) & (distance < -before)
    size = np.maximum(iteration.sizes_of_roots, np.abs(distance)) + TINY
    nearest = behind if behind.any() else moving if moving.any() else np.ones_like(moving)
    least = (distance / size)[nearest].min()
    return behind | ((moving | nearest) & (distance / size <= max(least, 0.0) + SLACK))
