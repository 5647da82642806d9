"""The co-simulation master: participants that meet at communication points, with a fixed or an adaptive macro step."""

from __future__ import annotations

import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any, Literal, cast

import numpy as np

from ..errors import AcausalError, InitializationError, UnknownNameError
from .coupling import Coupling, Interface, PowerBond, couple, free_polynomials, locate
from .pacing import Pacer
from .participant import CoSimulationError, Floats, Participant, slope_at, value_at
from .polynomials import History, interpolate, newton_coefficients
from .record import Recorder
from .result import CoSimulationResult

INITIAL_SWEEPS = 20
_SAFETY, _SHRINK, _GROW = 0.9, 0.3, 1.5
_INTEGRAL, _PROPORTIONAL = 0.3, 0.4
"""Gains of the step control for steps that stability bounds: Gustafsson (1991), ACM Trans. Math. Softw. 17, 533-554."""
_ENVELOPE, _FADE = 0.97, 0.95
"""Part of the step that the envelope of the errors allows, and what is left of that envelope after a step."""
_DIVERGED = 1e12
"""A signal this many times its nominal value has diverged."""
Signal = float | Callable[[float], float]


class CoSimulation:
    """A master for functional mock-up units and systems in this process.

    ```python
    master = ac.fmi.CoSimulation(
        {"plant": plant_system, "control": "controller.fmu"},
        [("plant.y", "control.u"), ("control.y", "plant.u")],
        step=0.01,
    )
    result = master.simulate(10.0)
    ```

    Args:
        participants: by name, a `Participant`, a compiled system, a loaded FMU or the path of one.
        connections: pairs (``participant.output``, ``participant.input``).
        bonds: power bonds, for the energy residual; `split` knows them.
        inputs: values or functions of time for inputs that nothing is connected to.
        method: ``jacobi``, where all step at once, or ``gauss-seidel``, where later participants see what the earlier
            ones have just done. The order is that of `participants`.
        order: degree 0 to 2 of the extrapolation of inputs over a step. Of an input whose derivatives are exchanged,
            it is the highest exchanged derivative that is extrapolated.
        step: macro step [s]; the first one if it is adaptive.
        iterations: most repetitions of each macro step with interpolated inputs until the outputs agree (implicit
            coupling); 0 for none.
        tolerance: makes the macro step adaptive: largest error of a step relative to the size of the signals.
        control: what is taken for the error of a step: ``defect``, how far predicted inputs were off at its end, or
            ``energy``, the power residual of the bonds relative to their largest power.
        min_step: smallest macro step [s].
        max_step: largest macro step [s].

    Raises:
        UnknownNameError, ConnectError: names or connections that do not fit.
        CoSimulationError: options that do not fit each other.

    Sources: Kuebler and Schiehlen (2000) on algebraic loops; Busch (2012) on extrapolation and its error; Sadjina,
    Kyllingstad, Skjong and Pedersen (2017), Engineering with Computers 33, 607-620, on power bonds.
    """

    def __init__(
        self,
        participants: Mapping[str, Any],
        connections: Iterable[tuple[str, str]],
        *,
        bonds: Sequence[PowerBond] = (),
        inputs: Mapping[str, Signal] | None = None,
        method: Literal["jacobi", "gauss-seidel"] = "jacobi",
        order: int = 1,
        step: float = 0.01,
        iterations: int = 0,
        tolerance: float | None = None,
        control: Literal["defect", "energy"] = "defect",
        min_step: float = 1e-6,
        max_step: float = 0.1,
    ) -> None:
        if method not in ("jacobi", "gauss-seidel"):
            raise CoSimulationError(f"method={method!r} is neither 'jacobi' nor 'gauss-seidel'")
        if order not in (0, 1, 2):
            raise CoSimulationError(f"order={order!r}: inputs are extrapolated with degree 0, 1 or 2")
        if control not in ("defect", "energy") or (control == "energy" and not bonds):
            raise CoSimulationError(
                f"control={control!r}: take 'defect', or 'energy' with power bonds (`bonds=`, as `split` makes them)"
            )
        if not 0 < min_step <= max_step or step <= 0:
            raise CoSimulationError(
                f"steps must be positive and min_step <= max_step: {step=}, {min_step=}, {max_step=}"
            )
        self.participants: dict[str, Participant] = {n: _participant(n, p) for n, p in participants.items()}
        self.names = tuple(self.participants)
        self.parts = tuple(self.participants.values())
        self.couplings = couple(self.participants, connections)
        self.bonds = tuple(_Bond(b, self.participants, self.couplings) for b in bonds)
        self.inputs = {locate(self.participants, n, "input"): s for n, s in (inputs or {}).items()}
        self.method, self.order, self.iterations = method, order, iterations
        self.step, self.tolerance, self.control = step, tolerance, control
        self.min_step, self.max_step = min_step, max_step
        if (iterations or tolerance is not None) and not all(p.can_reject for p in self.parts):
            names = ", ".join(f"`{n}`" for n, p in self.participants.items() if not p.can_reject)
            if iterations:
                raise CoSimulationError(
                    f"repeating steps needs participants that can go back; {names} cannot save its state. Use "
                    "iterations=0."
                )
        self.can_reject = all(p.can_reject for p in self.parts)
        self.largest = np.array([max(self._nominal(c), 0.0) for c in self.couplings])

    def _nominal(self, c: Coupling) -> float:
        part = self.parts[c.target]
        return part.nominal(part.inputs[c.input])

    # ---- the run --------------------------------------------------------------------------------------------------
    def simulate(
        self,
        t1: float,
        *,
        t0: float = 0.0,
        real_time: float | None = None,
        throw: bool = True,
        progress: Callable[[float], None] = lambda _: None,
    ) -> CoSimulationResult:
        """Run from t0 to t1.

        Args:
            t1: end time [s].
            t0: start time [s].
            real_time: pace the run: simulated seconds per second of the wall clock; None for as fast as it goes.
            throw: raise when a participant fails or signals diverge; otherwise return what there is, saying so in
                `result`.
            progress: told the time after each step.

        Raises:
            CoSimulationError: a participant failed or signals diverged.
            InitializationError: a participant has no consistent start.
        """
        begin = time.perf_counter()
        run = _Run(self, t0)
        recorder = Recorder(self.names, self.parts, [b.bond.name for b in self.bonds])
        z, values = run.start(t0)
        recorder.add(t0, values, np.zeros(len(self.bonds)), run.powers(z), 0.0)
        started = time.perf_counter()
        before = {n: dict(p.stats) for n, p in self.participants.items()}
        pacer = Pacer(real_time, t0)
        t, h, result, smallest = t0, self.step, "successful", 1e-9 * abs(t1 - t0)
        while t < t1 - smallest:
            h = min(h, t1 - t)
            if t1 - (t + h) < 1e-6 * h:
                h = t1 - t
            try:
                taken, following = run.advance(t, h)
            except AcausalError as error:
                if throw:
                    raise
                result = str(error)
                break
            t += taken
            recorder.add(t, run.values, run.energy, run.powers(run.z), run.defect)
            h = following
            pacer.wait(t)
            progress(t)
        seconds = time.perf_counter() - started
        stats = {
            "macro_steps": run.accepted, "rejected": run.rejected, "iterations": run.repeated,
            "run_seconds": seconds, "start_seconds": started - begin, "real_time_factor": seconds / max(t - t0, 1e-300),
            "participants": {n: p.stats for n, p in self.participants.items()}, **pacer.stats(),
        }  # fmt: skip
        compiled = sum(p.stats.get("compile_seconds", 0.0) - before[n].get("compile_seconds", 0.0)
                       for n, p in self.participants.items())  # fmt: skip
        stats["run_seconds"] = seconds - compiled
        stats["real_time_factor"] = stats["run_seconds"] / max(t - t0, 1e-300)
        return recorder.result(self.parts, stats, result)

    def close(self) -> None:
        """Give the participants' resources back."""
        for part in self.parts:
            part.close()

    def __enter__(self) -> CoSimulation:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def _participant(name: str, given: Any) -> Participant:
    if isinstance(given, Participant):
        return given
    from ..system import System

    if isinstance(given, System):
        from .system_participant import SystemParticipant

        return SystemParticipant(given, name=name)
    from .fmu import Fmu, load

    if isinstance(given, Fmu):
        return given.participant(name=name)
    if isinstance(given, (str, os.PathLike)):
        return load(given).participant(name=name)
    raise CoSimulationError(
        f"participant `{name}` is a {type(given).__name__}: give a compiled system, an FMU or its path, or an object "
        "with the methods of `acausal.fmi.Participant`"
    )


class _Bond:
    """Where the quantities of a power bond stand."""

    def __init__(self, bond: PowerBond, participants: Mapping[str, Participant], couplings: Sequence[Coupling]) -> None:
        self.bond = bond
        self.potential = self._find(bond.potential, participants, couplings)
        self.flow = self._find(bond.flow, participants, couplings)

    @staticmethod
    def _find(text: str, participants: Mapping[str, Participant], couplings: Sequence[Coupling]) -> Coupling:
        target, input_ = locate(participants, text, "input")
        for c in couplings:
            if (c.target, c.input) == (target, input_):
                return c
        raise UnknownNameError(f"power bond: nothing is connected to `{text}`")


class _Run:
    """The state of one run: histories of the interface, what is expected of each step, counts."""

    def __init__(self, master: CoSimulation, t0: float) -> None:
        self.m = master
        self.interface = Interface(master.parts, master.names, master.couplings)
        self.unfed = free_polynomials(master.parts)
        self.histories = [History(c.known) for c in master.couplings]
        self.largest = master.largest.copy()
        self.largest_power = 0.0
        self.z: Floats = np.zeros(self.interface.size)
        self.values: list[Floats] = []
        self.energy = np.zeros(len(master.bonds))
        self.defect = 0.0
        self.accepted = self.rejected = self.repeated = 0
        self.error_before, self.envelope = 1.0, 0.0

    # ---- start ----------------------------------------------------------------------------------------------------
    def start(self, t0: float) -> tuple[Floats, list[Floats]]:
        """Consistent start of all participants: each is started with the others' outputs until nothing changes."""
        free = self.free(t0, self.m.step)
        z = np.zeros(self.interface.size)
        for c in self.m.couplings:
            z[c.place] = self.m.parts[c.target].start(self.m.parts[c.target].inputs[c.input])
        failure: InitializationError | None = None
        for _ in range(INITIAL_SWEEPS):
            before, failure = z.copy(), None
            for i, part in enumerate(self.m.parts):
                try:
                    part.initialize(t0, self.interface.feed(i, z, free[i]))
                except InitializationError as error:
                    failure = error  # its inputs may not have their values yet
                    continue
                self.interface.read(i, self.interface.evaluate(i, t0, z, free), z)
            if failure is None and np.allclose(z, before, rtol=1e-9, atol=1e-12):
                break
        if failure is not None:
            raise failure
        z, self.values = self.interface.resolve(t0, z, free)
        self.note(t0, z)
        return z, self.values

    def free(self, t: float, h: float) -> list[Floats]:
        """Polynomials of the inputs that are fed from outside, over a step."""
        made = [c.copy() for c in self.unfed]
        for (part, place), signal in self.m.inputs.items():
            if callable(signal):
                s = (0.0, 0.5 * h, h)
                made[part][place, :3] = newton_coefficients(s, [float(signal(t + d)) for d in s])
            else:
                made[part][place, 0] = signal
        return made

    def note(self, t: float, z: Floats) -> None:
        """Enter an accepted interface vector into the histories."""
        self.z = z
        for i, (c, history) in enumerate(zip(self.m.couplings, self.histories, strict=True)):
            history.add(t, z[c.place : c.place + c.known + 1])
            self.largest[i] = max(self.largest[i], abs(z[c.place]))

    # ---- one macro step -------------------------------------------------------------------------------------------
    def advance(self, t: float, h: float) -> tuple[float, float]:
        """One accepted macro step from t, at most h long: its length, and that of the next."""
        m = self.m
        saved = [p.save() for p in m.parts] if m.can_reject and (m.tolerance is not None or m.iterations) else None
        while True:
            free = self.free(t, h)
            predicted = [history.extrapolate(m.order) for history in self.histories]
            coefficients = self._stepped(t, h, predicted, free)
            if m.iterations:
                coefficients = self._repeat(t, h, predicted, free, cast("list[Any]", saved))
            end = self.free(t + h, h)
            ahead = self._at_end(coefficients, h)
            residual, jump = self._power_residual(t + h, ahead, end)
            z, values = self.interface.resolve(t + h, ahead, end)
            self._check(t + h, z)
            error = self._error(ahead, z, residual, h)
            factor = self._factor(error, h)
            if m.tolerance is None or error <= 1.0 or h <= m.min_step * 1.001 or saved is None:
                break
            self.rejected += 1
            for part, state in zip(m.parts, saved, strict=True):
                part.restore(state)
            h = max(h * min(factor, 0.9), m.min_step)
        self.values, self.accepted = values, self.accepted + 1
        self.energy = self.energy + 0.5 * h * residual + jump
        self.note(t + h, z)
        following = h if m.tolerance is None else float(np.clip(h * factor, m.min_step, m.max_step))
        return h, m.step if m.tolerance is None else following

    def _stepped(self, t: float, h: float, predicted: list[Floats], free: list[Floats]) -> list[Floats]:
        """Step all participants; the polynomial that each connection really had."""
        m = self.m
        used = list(predicted)
        for i, part in enumerate(m.parts):
            coefficients = free[i].copy()
            for k, c in enumerate(m.couplings):
                if c.target == i:
                    coefficients[c.input] = used[k]
            part.step(t, h, coefficients)
            if m.method == "gauss-seidel":
                ahead = self._at_end(used, h)
                values = self.interface.evaluate(i, t + h, ahead, self.free(t + h, h))
                for k, c in enumerate(m.couplings):
                    if c.source == i and c.target > i:
                        entry = slice(c.place, c.place + c.known + 1)
                        used[k] = interpolate(h, self.z[entry], values[: c.known + 1, c.output], c.known)
        return used

    def _repeat(
        self, t: float, h: float, predicted: list[Floats], free: list[Floats], saved: list[Any]
    ) -> list[Floats]:
        """Repeat a step with interpolated inputs until its end agrees with itself (quasi-Newton, Broyden's update)."""
        m, end = self.m, self.free(t + h, h)
        used = predicted
        z = self._at_end(used, h)
        made, _ = self.interface.resolve(t + h, z, end)
        jacobian = np.zeros((len(z), len(z)))
        scale = np.maximum(np.abs(made), 1e-9 * np.concatenate([[n] * (c.known + 1) for n, c in zip(
            self.largest, m.couplings, strict=True)]))  # fmt: skip
        for _ in range(m.iterations):
            residual = made - z
            if np.all(np.abs(residual) <= 1e-8 * scale):
                break
            step = np.linalg.solve(np.eye(len(z)) - jacobian, residual)
            following = z + step
            for part, state in zip(m.parts, saved, strict=True):
                part.restore(state)
            used = [
                interpolate(
                    h, self.z[c.place : c.place + c.known + 1], following[c.place : c.place + c.known + 1], c.known
                )
                for c in m.couplings
            ]
            for i, part in enumerate(m.parts):
                coefficients = free[i].copy()
                for k, c in enumerate(m.couplings):
                    if c.target == i:
                        coefficients[c.input] = used[k]
                part.step(t, h, coefficients)
            again, _ = self.interface.resolve(t + h, following, end)
            # Broyden's update in scaled entries: forces and angles differ by many powers of ten
            change = ((again - made) - jacobian @ step) / scale
            direction = step / scale
            outer = np.outer(change, direction) / max(float(direction @ direction), 1e-300)
            jacobian = jacobian + scale[:, None] * outer / scale[None, :]
            z, made = following, again
            self.repeated += 1
        return used

    def _at_end(self, used: Sequence[Floats], h: float) -> Floats:
        """Interface vector that the polynomials lead to at the end of a step."""
        z = np.zeros(self.interface.size)
        for c, row in zip(self.m.couplings, used, strict=True):
            z[c.place] = value_at(row[None], h)[0]
            if c.known > 0:
                z[c.place + 1] = slope_at(row[None], h)[0]
            if c.known > 1:
                z[c.place + 2] = 2 * row[2] + 6 * row[3] * h
        return z

    # ---- errors ---------------------------------------------------------------------------------------------------
    def _power_residual(self, t: float, ahead: Floats, free: list[Floats]) -> tuple[Floats, Floats]:
        """Power [W] that each bond makes at the end of a step: what enters one side minus what leaves the other.

        Second, the work [J] that a position does when it is put right at the communication point.
        """
        m, jump = self.m, np.zeros(len(self.m.bonds))
        needed = {part for b in m.bonds for part in (b.potential.source, b.flow.source)}
        values = {part: self.interface.evaluate(part, t, ahead, free) for part in needed}
        residual = np.zeros(len(m.bonds))
        for i, b in enumerate(m.bonds):
            row = int(b.bond.derivative)
            imposed, flow = ahead[b.potential.place + row], values[b.flow.source][0, b.flow.output]
            own, given = values[b.potential.source][row, b.potential.output], ahead[b.flow.place]
            residual[i] = imposed * flow - own * given
            if row:
                jump[i] = (values[b.potential.source][0, b.potential.output] - ahead[b.potential.place]) * flow
        return residual, jump

    def powers(self, z: Floats) -> Floats:
        """Power [W] that each bond carries."""
        power = np.zeros(len(self.m.bonds))
        for i, b in enumerate(self.m.bonds):
            power[i] = z[b.potential.place + int(b.bond.derivative)] * z[b.flow.place]
        self.largest_power = max(self.largest_power, float(np.max(np.abs(power), initial=0.0)))
        return power

    def _error(self, ahead: Floats, z: Floats, residual: Floats, h: float) -> float:
        """What a step's defect does to the states, relative to what `tolerance` does over the first macro step."""
        places = np.array([c.place for c in self.m.couplings], int)
        size = np.maximum(self.largest, np.abs(z[places]))
        off = np.abs(ahead[places] - z[places]) / np.maximum(size, 1e-300)
        self.defect = float(np.max(off, initial=0.0))
        if self.m.tolerance is None:
            return 0.0
        if self.m.control == "energy":
            scale = max(self.largest_power, 1e-12)
            return float(np.max(np.abs(residual)) / (scale * self.m.tolerance)) * h / self.m.step
        return self.defect / self.m.tolerance * h / self.m.step

    def _factor(self, error: float, h: float) -> float:
        """Factor on the macro step h (PI control): the error grows with the power `order` + 2 of it.

        The error of the prediction of a signal that swings vanishes twice a period. A step that follows it each time
        grows there beyond what the swing, or the stability of the coupling, allows, and is taken back soon after.
        So it grows only as far as the envelope allows: the largest error by its step, which fades.
        """
        power = self.m.order + 2
        size = max(error, 1e-12)
        self.envelope = max(size / h**power, _FADE * self.envelope)
        allowed = _ENVELOPE / (h * self.envelope ** (1.0 / power))
        controlled = _SAFETY * size ** (-_INTEGRAL / power) * (self.error_before / size) ** (_PROPORTIONAL / power)
        if size > 1.0:
            controlled = min(controlled, _SAFETY * size ** (-1.0 / power))
        else:
            self.error_before = max(size, 1e-4)
        return float(np.clip(min(controlled, allowed), _SHRINK, _GROW))

    def _check(self, t: float, z: Floats) -> None:
        for i, c in enumerate(self.m.couplings):
            value, scale = abs(z[c.place]), self.m.largest[i]
            if not np.isfinite(value) or value > _DIVERGED * max(scale, 1.0):
                raise CoSimulationError(
                    f"the co-simulation diverged at t = {t:.6g} s: {c.name} is {z[c.place]:.3g}. Take a smaller macro "
                    "step, another causality of the split, Gauss-Seidel, or an adaptive step (`tolerance=`)."
                )
