"""The inside of an in-process participant with events, as generated C from event to event."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..lowering.hybrid import Piece, Point
from ..simulation.conditions import modes
from ..simulation.event_iteration import EventIteration, Outcome
from ..simulation.hybrid_run import run_hybrid
from ..simulation.native import NativeEquations
from ..simulation.native_library import METHODS, Run
from ..system import System
from .feedthrough import depends_at_once
from .inner_native import MAX_STEPS, NativeInner
from .participant import CoSimulationError, Floats


@dataclass(frozen=True, slots=True, eq=False)
class Memory:
    """What a system with events knows besides its states.

    Attributes:
        slots: modes, left limits, triggers (n_slots,).
        before: whether each condition of a `when` held.
        noise, largest: sizes of what the conditions are made of, for what counts as rounding.
        margins: of the conditions at the last communication point, (n_roots,).
    """

    slots: Floats
    before: tuple[Any, ...]
    noise: Floats
    largest: Floats
    margins: Floats


class EventInner(NativeInner):
    """As `NativeInner`, for a system with events: those within a step, and those that new inputs bring about.

    Inputs may jump at a communication point. A condition that has thereby come to the other side switches there, before
    the step; the outputs at the point are those after the switch.
    """

    def __init__(
        self, system: System, places: Any, *, method: str, dt: float | None, rtol: float, atol: float,
        outputs: Sequence[int], derivatives: Sequence[tuple[int, int]], n_inputs: int, name: str,
    ) -> None:  # fmt: skip
        super().__init__(
            system, places, method=method, dt=dt, rtol=rtol, atol=atol, outputs=outputs, derivatives=derivatives,
            n_inputs=n_inputs,
        )  # fmt: skip
        assert system.hybrid is not None
        self.hybrid, self.problem, self.name = system.hybrid, system.initial, name
        self.iteration = self._iteration(NativeEquations(self.model, self.native_library, ()))
        self.direct = self._direct()
        self.margins = np.zeros(self.hybrid.roots.count)
        self.slots = np.zeros(self.hybrid.flat.slots.count)

    def _iteration(self, equations: NativeEquations) -> EventIteration:
        return EventIteration(self.hybrid, self.problem, equations)

    def _direct(self) -> list[tuple[slice, Piece]]:
        """The conditions that inputs can switch at once, by the structure of the equations, and where they stand."""
        found: list[tuple[slice, Piece]] = []
        first = 0
        for piece in self.hybrid.root_pieces:
            here, first = slice(first, first + piece.rows.size), first + piece.rows.size
            if depends_at_once(self.lowered, piece.rows.var_rows, piece.rows.par_rows, self.places):
                found.append((here, piece))
        return found

    def start(
        self, t0: float, p: Floats, starts: Floats, solve: Callable[[Floats], tuple[Floats, Floats]], matrix: Floats
    ) -> tuple[Floats, Floats, Floats]:
        """Consistent states and unknowns, parameters with the slots, residuals left; as `EventIteration.start`."""
        equations = self._equations(t0, 0.0, matrix)
        self.iteration = self._iteration(equations)
        outcome, left = self.iteration.start(t0, p, starts, solve)
        self._check_running(outcome.ended, t0)
        self._keep(t0, outcome.z, outcome.p)
        return outcome.z, outcome.p, left

    # ---- saved states ---------------------------------------------------------------------------------------------
    def remember(self) -> Memory:
        """Everything but the states."""
        i = self.iteration
        return Memory(self.slots.copy(), tuple(i.before), i.noise.copy(), i.largest.copy(), self.margins.copy())

    def recall(self, memory: Memory | None) -> None:
        """Go back to what was remembered."""
        assert memory is not None
        i = self.iteration
        self.slots, self.margins = memory.slots.copy(), memory.margins.copy()
        i.before, i.noise, i.largest = list(memory.before), memory.noise.copy(), memory.largest.copy()

    def _keep(self, t: float, z: Floats, p: Floats) -> None:
        """Remember the slots of p, and where the conditions stand."""
        self.slots = p[self.hybrid.slots].copy()
        self.margins = self._margins(t, z, p)

    # ---- steps ----------------------------------------------------------------------------------------------------
    def step(self, t: float, h: float, z: Any, p: Any, matrix: Floats, hint: float) -> tuple[Any, float, int, bool]:
        """State after a macro step, inner step in use, inner steps taken, whether it succeeded.

        Raises:
            CoSimulationError: the model ends the simulation.
            SimulationError: events accumulate, an assertion fails, an event has no consistent outcome.
        """
        p, equations = self._with_slots(p, matrix), self._equations(t, h, matrix)
        begin = self._react(t, z, p)
        none = np.zeros(0)

        def integrate(
            at: float, stop: float, z: Floats, p: Floats, save: Floats, step: float, end_open: bool, steps: int
        ) -> Run:
            if METHODS[self.method] == "rk4":
                step = (stop - at) / max(np.ceil((stop - at) / self.dt - 1e-9), 1.0)
            return self.native_library.run(
                at, stop, z, p, save, rtol=self.rtol, atol=self.atol, signals=equations.signals, first_step=step,
                max_steps=steps, method=self.method, noise=self.iteration.noise, end_open=end_open,
            )  # fmt: skip

        run = run_hybrid(
            self.iteration, begin, t, t + h, none, integrate, first_step=min(hint, h), max_steps=MAX_STEPS,
            at_end=False,
        )  # fmt: skip
        ok = run.code == 0 and bool(np.isfinite(run.z_end).all())
        if ok:
            self._check_running(run.ended, run.t_end)
            self._keep(t + h, run.z_end, run.p_end)
        steps = max(run.counts["accepted"], 1)
        return run.z_end, 0.5 * h / steps, run.counts["steps"], ok

    def evaluate(self, t: float, z: Any, p: Any, matrix: Floats) -> Floats:
        """Outputs and their derivatives, (3, n_y), after what these inputs switch; that itself is left to the step."""
        p = self._with_slots(p, matrix)
        self._equations(t, 0.0, matrix)
        memory = self.remember()
        after = self._react(t, z, p)
        self.recall(memory)
        return super().evaluate(t, after.z, after.p, matrix)

    def _react(self, t: float, z: Floats, p: Floats) -> Outcome:
        """What follows at once from new inputs: the conditions that they have taken to the other side switch."""
        unchanged = Outcome(z, p, np.zeros(0))
        if not self.direct:
            return unchanged
        settled = self.iteration.equations.settle(t, z, p)
        z = z if settled is None else settled
        g = self._margins(t, z, p)
        holds = np.where(self.hybrid.roots.strict, g < 0.0, g <= 0.0)
        far = (np.abs(g) > self.iteration.noise) | (g == 0.0)
        switched = (holds != modes(self.hybrid, p)) & far & (g != self.margins)
        if not switched.any():
            return unchanged
        outcome = self.iteration.event(t, z, p, switched)
        self._check_running(outcome.ended, t)
        return outcome

    def _margins(self, t: float, z: Floats, p: Floats) -> Floats:
        """Values of the conditions that inputs can switch, (n_roots,); of others those that they had."""
        margins = self.margins.copy()
        if self.direct:
            point = Point(t, self.iteration.equations.values(t, z, p), p)
            for place, piece in self.direct:
                margins[place] = piece.values(point)[0]
        return margins

    def _with_slots(self, p: Floats, matrix: Floats) -> Floats:
        p = p.copy()
        p[self.places] = matrix[:, 0]
        p[self.hybrid.slots] = self.slots
        return p

    def _equations(self, t: float, h: float, matrix: Floats) -> NativeEquations:
        """The equations over a step, for the iteration of events."""
        signals = self._signals(t, h, matrix if h else matrix * (np.arange(matrix.shape[1]) == 0))
        made = NativeEquations(self.model, self.native_library, signals)
        self.iteration.equations = made
        return made

    def _check_running(self, ended: str | None, t: float) -> None:
        if ended is not None:
            raise CoSimulationError(f"participant `{self.name}` ends the simulation at t = {t:.6g} s: {ended}")
