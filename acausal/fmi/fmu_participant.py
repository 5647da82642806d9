"""A co-simulation FMU as a participant."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ..errors import UnknownNameError
from .cutting import INSTANT
from .fmu import Fmu, FmuError, get_reals, set_parameters, set_reals, start_of
from .participant import DEGREE, CoSimulationError, Floats

_TAILS = tuple(f"_c{k}" for k in range(1, DEGREE + 1))


class FmuParticipant:
    """A co-simulation FMU that steps in this process.

    An input arrives as a polynomial in time: of an FMI 2.0 unit that interpolates, its first derivative is handed on;
    of others its mean over the step. A quantity whose Taylor coefficients are inputs or parameters of the unit
    (``name``, ``name_c1``, ..., and ``t_communication`` for their origin, as sides of a `split` have them) gets them
    all.

    Args:
        fmu: the unit.
        outputs: names of further variables to give out.
        parameters: values by name.
        needs: by quantity with Taylor coefficients, how many derivatives of it the model uses (2).
        name: shown in messages.

    Raises:
        FmuError: it does not offer co-simulation, or an output is not a real number.
        UnknownNameError: an output or parameter that it does not have.
    """

    def __init__(
        self,
        fmu: Fmu,
        *,
        outputs: Sequence[str] = (),
        parameters: Mapping[str, float] | None = None,
        needs: Mapping[str, int] | None = None,
        name: str | None = None,
    ) -> None:
        if "cs" not in fmu.kinds:
            raise FmuError(f"{fmu.path.name} does not offer co-simulation; use it as a component of a model")
        self.fmu, self.name = fmu, name or fmu.name
        every = fmu.names("input")
        settable = {*every, *fmu.names("parameter")}
        self._series = {
            n: tuple(n + tail for tail in _TAILS) for n in fmu.variables
            if n in settable and all(n + tail in settable for tail in _TAILS)
        }  # fmt: skip
        hidden = {c for series in self._series.values() for c in series}
        plain = [n for n in every if n not in hidden and n not in self._series]
        self.inputs = (*plain, *self._series)
        self.outputs = tuple(dict.fromkeys([*fmu.names("output"), *outputs]))
        given = dict(needs or {})
        self.needs = {n: given.get(n, 2) if n in self._series else 0 for n in self.inputs}
        capability = fmu.description.coSimulation
        self.can_reject = bool(capability.canGetAndSetFMUstate)
        self._follows = bool(capability.canInterpolateInputs) and fmu.version == "2.0"
        self._orders = int(capability.maxOutputDerivativeOrder or 0)
        self.parameters = dict(parameters or {})
        self._plain = [fmu.variable(n).valueReference for n in plain]
        self._coefficients = [
            fmu.variable(v).valueReference for n, tails in self._series.items() for v in (n, *tails)
        ]  # fmt: skip
        self._origin = [fmu.variable(INSTANT).valueReference] if self._series and INSTANT in settable else []
        self._reads = [fmu.number(n).valueReference for n in self.outputs]
        self.feedthrough = frozenset(self._direct())
        self._derived: list[tuple[int, int, int]] = []
        self._rates: list[int] = []
        self._instance: Any = None
        self._running = False
        self._saved: Any = None
        self._counts: dict[str, float] = {"macro_steps": 0, "steps": 0, "seconds": 0.0}

    def _direct(self) -> list[str]:
        """Outputs that depend on inputs at the same instant, as far as the model description tells."""
        known = {u.variable.name: u.dependencies for u in self.fmu.description.outputs if u.variable is not None}
        inputs = set(self.fmu.names("input"))
        return [
            n for n in self.outputs
            if self._series or known.get(n) is None or any(d.name in inputs for d in known[n] or ())
        ]  # fmt: skip

    def require(self, output: str, order: int) -> bool:
        """Ask for time derivatives of an output: what the unit gives out as a derivative of it, or at its steps."""
        k, reference = self.outputs.index(output), int(self.fmu.variable(output).valueReference)
        for j in range(1, order + 1):
            rate = self._rate_of(reference)
            if rate is None:
                if j > 1 or not self._orders:
                    return False
                self._rates.append(k)
                return order == 1
            self._derived.append((k, j, rate))
            reference = rate
        return True

    def _rate_of(self, reference: int) -> int | None:
        """Value reference of the derivative of a variable, if the model description has it."""
        for v in self.fmu.variables.values():
            if v.derivative is not None and int(v.derivative.valueReference) == reference:
                return int(v.valueReference)
        return None

    def nominal(self, name: str) -> float:
        """Nominal value of the model description, else 0."""
        value = self.fmu.variable(name).nominal
        return 0.0 if value is None else abs(float(value))

    def start(self, name: str) -> float:
        """Value of an input that nothing feeds: the start value of the model description."""
        return start_of(self.fmu.variable(name))

    def unit(self, name: str) -> str:
        """Unit of the model description, empty if it has none."""
        return self.fmu.variable(name).unit or ""

    # ---- a participant's life -------------------------------------------------------------------------------------
    def initialize(self, t0: float, coefficients: Floats) -> None:
        """Enter initialization mode (again, after a run: a new instance) and set the inputs."""
        if self._running:
            self.close()
        try:
            if self._instance is None:
                self._instance = self.fmu.instantiate("cs")
                self._set_parameters()
                if self.fmu.version == "2.0":
                    self._instance.setupExperiment(startTime=t0)
                    self._instance.enterInitializationMode()
                else:
                    self._instance.enterInitializationMode(startTime=t0)
            self._set(t0, coefficients, 0.0)
        except (FmuError, UnknownNameError):
            raise
        except Exception as error:  # FMPy raises plain exceptions
            raise CoSimulationError(f"participant `{self.name}` ({self.fmu.path.name}): {error}") from error

    def _set_parameters(self) -> None:
        set_parameters(self._instance, self.fmu, self.parameters)

    def _set(self, t: float, coefficients: Floats, h: float) -> None:
        """Inputs as they can be followed over a step of length h from t."""
        n = len(self._plain)
        plain, series = coefficients[:n], coefficients[n:]
        powers = np.arange(coefficients.shape[1])
        values = plain[:, 0] if self._follows else plain @ (h**powers / (powers + 1.0))
        set_reals(self._instance, self._plain, values.tolist())
        set_reals(self._instance, self._coefficients, series.ravel().tolist())
        set_reals(self._instance, self._origin, [t] * len(self._origin))
        if self._follows and n:
            # at the end of a step only the value counts, else the straight line from the first to the last value
            slopes = (plain @ h**powers - plain[:, 0]) / h if h else np.zeros(n)
            self._instance.setRealInputDerivatives(self._plain, [1] * n, slopes.tolist())

    def step(self, t: float, h: float, coefficients: Floats) -> None:
        """Advance from t to t + h.

        Raises:
            CoSimulationError: the unit reports an error.
        """
        begin = time.perf_counter()
        try:
            if not self._running:
                self._instance.exitInitializationMode()
                self._running = True
            self._set(t, coefficients, h)
            if self.fmu.version == "2.0":
                self._instance.doStep(t, h)
            else:
                _, terminate, _, last = self._instance.doStep(t, h)
                if terminate or last < t + h - 1e-9 * max(abs(t + h), h):
                    raise CoSimulationError(f"it stopped at t = {last:.6g} s{self._pace(h)}")
        except Exception as error:  # FMPy raises plain exceptions
            raise CoSimulationError(
                f"participant `{self.name}` ({self.fmu.path.name}) could not advance from t = {t:.6g} s by {h:.3g} s: "
                f"{error}"
            ) from error
        self._counts["macro_steps"] += 1
        self._counts["seconds"] += time.perf_counter() - begin

    def _pace(self, h: float) -> str:
        """Advice where a step is no multiple of the unit's own."""
        own = float(getattr(self.fmu.description.coSimulation, "fixedInternalStepSize", None) or 0.0)
        if not own or abs(h / own - round(h / own)) < 1e-9 * h / own:
            return ""
        return f"; its own steps are {own:.6g} s long: take multiples of them as macro step"

    def evaluate(self, t: float, coefficients: Floats) -> Floats:
        """Outputs under these inputs, (3, n_y); of a unit that computes outputs in its steps alone, the last ones.

        Raises:
            CoSimulationError: the unit reports an error.
        """
        begin = time.perf_counter()
        try:
            values = self._values(t, coefficients)
        except Exception as error:  # FMPy raises plain exceptions
            raise CoSimulationError(
                f"participant `{self.name}` ({self.fmu.path.name}) has no outputs at t = {t:.6g} s: {error}"
            ) from error
        self._counts["seconds"] += time.perf_counter() - begin
        return values

    def _values(self, t: float, coefficients: Floats) -> Floats:
        values = np.full((3, len(self.outputs)), np.nan)
        if self.feedthrough:
            self._set(t, coefficients, 0.0)
        values[0] = get_reals(self._instance, self._reads)
        found = get_reals(self._instance, [r for _, _, r in self._derived])
        for (k, order, _), value in zip(self._derived, found, strict=True):
            values[order, k] = value
        if self._rates:
            values[1, self._rates] = self._slopes() if self._running else 0.0
        return values

    def _slopes(self) -> list[float]:
        """First derivatives of outputs, which units tell in step mode."""
        get = (
            self._instance.getRealOutputDerivatives
            if self.fmu.version == "2.0"
            else self._instance.getOutputDerivatives
        )
        return list(get([self._reads[k] for k in self._rates], [1] * len(self._rates)))

    def save(self) -> Any:
        """The unit's state; the one saved before is freed."""
        self._free()
        self._saved = self._instance.getFMUState()
        return self._saved, self._running

    def restore(self, state: Any) -> None:
        """Go back to the saved state."""
        saved, self._running = state
        self._instance.setFMUState(saved)

    def _free(self) -> None:
        if self._saved is not None:
            self._instance.freeFMUState(self._saved)
            self._saved = None

    def close(self) -> None:
        """Terminate and free the instance."""
        if self._instance is not None:
            self._free()
            if self._running:
                self._instance.terminate()
            self._instance.freeInstance()
            self._instance, self._running = None, False

    @property
    def stats(self) -> dict[str, Any]:
        """Macro steps and seconds."""
        return dict(self._counts)
