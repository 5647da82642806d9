"""Runs with events on the diffrax engine: each stretch between events is one diffrax solve with a root finder.

Events themselves are carried out with NumPy, as on the native engine.
"""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import diffrax
import jax.numpy as jnp
import numpy as np
import optimistix as optx

from acausal.errors import InitializationError, SimulationError
from acausal.lowering.hybrid import Hybrid
from acausal.lowering.initial_numeric import gauss_newton_part, solve_numeric
from acausal.lowering.numeric import NumericRun, is_concrete

from . import simulate as plain
from .conditions import sides
from .controller import ROUNDING
from .engines import all_signals, output_times
from .event_iteration import EventIteration
from .failure import explain
from .hybrid_run import EVENT, run_hybrid, warn
from .hybrid_static import Stretch, static_integrate
from .inputs import DrivenLowered, drive
from .native_library import RESULTS, Floats
from .rodas5p import Rodas5P
from .solution import Solution
from .switch import Switch

SLACK = 1e-12
TIME = 1e-14
"""Relative and absolute width of the interval in which an event is located."""
TINY = 1e-200
"""Slack of what is at its switch exactly: just not zero."""
SAME = 1e-13
"""Output times this close to that of an event, relative to it, are the event's: they show what follows."""
NARROWEST = 1e-6
"""Steps shorter than this part of the rest of the run are not refused."""


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


def simulate_events(
    system: Any, t1: Any, *, t0: Any = 0.0, parameters: Mapping[str, Any] | None = None,
    initial: Mapping[str, Any] | None = None, inputs: Mapping[str, Any] | None = None, saveat: Any = None,
    rtol: Any = 1e-6, atol: Any = None, solver: Any = None, max_steps: int | None = None, throw: bool = True,
    dt: Any = None, stepsize_controller: Any = None, **rest: Any,
) -> Solution:  # fmt: skip
    """As `acausal.simulation.simulate.simulate`, for a system with events; values are numbers."""
    given = (t0, t1, dict(parameters or {}), dict(initial or {}), rtol, atol)
    if not is_concrete(given):
        raise SimulationError(
            "The diffrax engine does not differentiate runs with events; the native engine does (engine='native'; it "
            "needs a C compiler), and events=False switches events off where the model has conditions only."
        )
    if rest.get("adjoint") is not None:
        raise SimulationError("`adjoint=` has no meaning in a run with events.")
    hybrid: Hybrid = system.hybrid
    t0, t1 = float(t0), float(t1)
    begin = time.perf_counter()
    low = system.lowered
    lowered, numbers = drive(system, inputs) if inputs else (low, ())
    all_signals(system, {k: v for k, v in (inputs or {}).items() if not callable(v)})
    equations = NumericEquations(system, lowered, numbers)
    iteration = EventIteration(hybrid, system.initial, equations, warn)
    p = system.program.evaluate(parameters or {}, np)
    equations.feed(t0, p)
    starts, overrides = system.program.starts(p, np), system._overrides(initial, np)

    def solve(p: Floats) -> tuple[Floats, Floats]:
        found = solve_numeric(system.initial, t0, p, starts, overrides)
        if found is None:
            raise InitializationError("the start of this model is too large for a run with events")
        return np.concatenate(found[:2]), found[2]

    outcome, left = iteration.start(t0, p, starts, solve)
    if throw:
        system.check_initial(outcome.z[: low.n_x], outcome.z[low.n_x :], outcome.p, left, t0)
    save = output_times(saveat, t0, t1)
    method = plain.with_linear_solver(plain.chosen_solver(solver), lowered)
    together = isinstance(method, Rodas5P)
    relative = jnp.asarray(rtol, float)
    absolute = jnp.broadcast_to(plain.ATOL * relative if atol is None else jnp.asarray(atol, float), (low.n_x,))
    compile_seconds = [0.0]
    most = plain.MAX_STEPS if max_steps is None else max_steps

    def integrate(
        t: float, stop: float, z: Floats, p: Floats, remaining: Floats, step: float, end_open: bool, steps: int
    ) -> Stretch:
        if stop - t <= ROUNDING * abs(t):  # between an event and the end there is no room for a step
            n = 0 if end_open else int((remaining <= stop).sum())
            return Stretch(np.tile(z, (n, 1)), 0, n, max(t, stop), z, step, None, {})
        times = np.full(len(save), stop)
        times[: len(remaining)] = np.clip(remaining, t, stop)
        slack, shortest = _slack(iteration, equations, t, z, p), jnp.asarray(NARROWEST * (stop - t))
        switch = Switch(jnp.asarray(slack), shortest, lowered, hybrid.roots, together, low.n_x)
        finder = optx.Bisection(rtol=TIME, atol=TIME, flip=True)  # what switches by rounding is at an end of the step
        event = diffrax.Event(switch, finder) if hybrid.roots.count else None
        settings = plain.settings_of(
            method, ("times",), controller=stepsize_controller, has_dt=dt is not None, event=event, max_steps=most
        )
        vector = jnp.asarray(p)
        arguments = (
            jnp.asarray(t), jnp.asarray(stop), jnp.asarray(z[: low.n_x]), jnp.asarray(z[low.n_x :]),
            (vector, numbers) if inputs else vector, relative, absolute, jnp.asarray(times),
            jnp.asarray(0.0 if dt is None else dt, float),
        )  # fmt: skip
        (_, x, w, counts, code, last), seconds, _ = plain.carry_out(lowered, settings, arguments)
        compile_seconds[0] += seconds
        name = plain.result_name(int(code))
        t_end = float(last[0])
        z_end = np.concatenate([np.asarray(last[1]), np.asarray(last[2])])
        happened = name == "event_occurred"
        until = t_end - SAME * abs(t_end) if happened else t_end
        before = remaining < until if happened or end_open else remaining <= until
        n = int(before.sum())
        found = np.concatenate([np.asarray(x), np.asarray(w)], axis=1)[:n]
        named = {k: int(c) for k, c in zip(("steps", "accepted", "rejected"), counts, strict=True)}
        if sum(named.values()) and steps < named["steps"]:
            name = "max_steps_reached"
        result = EVENT if happened else RESULTS.index(name) if name in RESULTS else 1
        roots = _switched(hybrid, equations, t_end, z_end, p, slack) if happened else None
        return Stretch(found, result, n, t_end, z_end, 0.0, roots, named)

    stretch = integrate if low.n_x else static_integrate(hybrid, equations, np.asarray(low.w_nominal, float))
    run = run_hybrid(iteration, outcome, t0, t1, save, stretch, first_step=0.0, max_steps=most)
    result = RESULTS[run.code] if run.code else "successful" if run.ended is None else f"terminated: {run.ended}"
    stats = {k: run.counts[k] for k in ("steps", "accepted", "rejected")}
    seconds = time.perf_counter() - begin
    stats |= {"compile_seconds": compile_seconds[0], "run_seconds": seconds - compile_seconds[0]}
    stats |= {"solver": type(method).__name__, "t_end": run.t_end}
    vector: Any = jnp.asarray(run.p_end)
    vector = (vector, numbers) if inputs else vector
    solution = Solution(
        system, run.save, run.z[:, : low.n_x], run.z[:, low.n_x :], vector, stats=stats, result=result,
        events=tuple(run.events), lowered=lowered, slots=run.slots,
    )  # fmt: skip
    if throw and run.code:
        last = run.t_end, run.z_end[: low.n_x], run.z_end[low.n_x :]
        raise SimulationError(explain(system, lowered, result, stats, last, solution.p, t1, most))
    return solution


def _slack(iteration: EventIteration, equations: NumericEquations, t: float, z: Floats, p: Floats) -> Floats:
    side = -sides(iteration.hybrid, equations, t, z, p)
    return np.where(side <= iteration.noise, 10.0 * np.abs(side) + iteration.noise + TINY, 0.0)


def _switched(hybrid: Hybrid, equations: NumericEquations, t: float, z: Floats, p: Floats, slack: Floats) -> Any:
    """The conditions that switch at a root: the nearest to its switch, and what is already behind.

    What has rested at its switch since the start of the stretch (it has `slack`) is no nearer to it than it was: it
    switches where it has left its slack behind.
    """
    settled = equations.settle(t, z, p)
    distance = slack - sides(hybrid, equations, t, z if settled is None else settled, p)
    behind, moving = distance <= 0.0, slack == 0.0
    if not behind.any() and moving.any():
        return moving & (distance <= distance[moving].min() + SLACK)
    return behind | (moving & (distance <= SLACK)) if behind.any() else distance <= distance.min() + SLACK
