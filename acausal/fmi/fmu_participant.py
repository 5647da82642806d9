"""A co-simulation FMU as a participant."""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from .fmu import Fmu, FmuError, get_reals, set_reals
from .participant import CoSimulationError, Floats

_MATCH = {1: "c1", 2: "c2", 3: "c3"}


class FmuParticipant:
    """A co-simulation FMU that steps in this process.

    Inputs of higher degree than the FMU can follow are held at their mean over the step. Quantities that another
    tool exported with their Taylor coefficients as inputs (``name``, ``name_c1``, ...; `export` writes sides of a split
    so) get these.

    Args:
        fmu: the unit.
        outputs: names of further variables to give out.
        parameters: values by name.
        name: shown in messages.
    """

    def __init__(
        self, fmu: Fmu, *, outputs: Sequence[str] = (), parameters: Mapping[str, float] | None = None,
        name: str | None = None,
    ) -> None:  # fmt: skip
        if "cs" not in fmu.kinds:
            raise FmuError(f"{fmu.path.name} does not offer co-simulation; use it as a component of a model")
        self.fmu, self.name = fmu, name or fmu.name
        every = fmu.names("input")
        self._series = {
            n: tuple(f"{n}_{tail}" for tail in _MATCH.values()) for n in every
            if all(f"{n}_{tail}" in every for tail in _MATCH.values())
        }  # fmt: skip
        hidden = {c for series in self._series.values() for c in series}
        self.inputs = tuple(n for n in every if n not in hidden)
        self.outputs = tuple(dict.fromkeys([*fmu.names("output"), *outputs]))
        self.needs = {n: self._needed(n) for n in self.inputs}
        self.feedthrough: frozenset[str] = frozenset()
        capability = fmu.description.coSimulation
        self.can_reject = bool(getattr(capability, "canGetAndSetFMUstate", False) or
                               getattr(capability, "canGetAndSetFMUState", False))  # fmt: skip
        self._interpolates = bool(getattr(capability, "canInterpolateInputs", False)) and fmu.version == "2.0"
        self.parameters = dict(parameters or {})
        self._places = [fmu.variable(n).valueReference for n in self.inputs]
        self._reads = [fmu.variable(n).valueReference for n in self.outputs]
        self._rates = {n: self._rate_of(n) for n in self.outputs}
        self._derived: list[tuple[int, int, int]] = []
        self._instance: Any = None
        self._running = False
        self._counts: dict[str, float] = {"macro_steps": 0, "steps": 0, "seconds": 0.0}

    def _needed(self, name: str) -> int:
        """Derivatives of an input that the unit says it uses, in the description of its first coefficient."""
        if name not in self._series:
            return 0
        text = self.fmu.variable(self._series[name][0]).description or ""
        return 2 if "second" in text else 1

    def _rate_of(self, name: str) -> int | None:
        """Value reference of the variable ``der(name)``, if there is one."""
        variable = self.fmu.variables.get(f"der({name})")
        return None if variable is None else int(variable.valueReference)

    def require(self, output: str, order: int) -> bool:
        """Ask for time derivatives of an output: those that the unit gives out as ``der(output)``."""
        k, at = self.outputs.index(output), output
        for j in range(1, order + 1):
            reference = self._rate_of(at)
            if reference is None:
                return False
            self._derived.append((k, j, reference))
            at = f"der({at})"
        return True

    def nominal(self, name: str) -> float:
        """Nominal value of the model description, else 0."""
        value = self.fmu.variable(name).nominal
        return 0.0 if value is None else abs(float(value))

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
            self._set(coefficients, 0.0)
        except FmuError:
            raise
        except Exception as error:  # FMPy raises plain exceptions
            raise CoSimulationError(f"participant `{self.name}` ({self.fmu.path.name}): {error}") from error

    def _set_parameters(self) -> None:
        names = list(self.parameters)
        references = [self.fmu.variable(n).valueReference for n in names]
        set_reals(self._instance, references, [float(self.parameters[n]) for n in names])

    def _set(self, coefficients: Floats, h: float) -> None:
        """Inputs as they can be followed over a step of length h."""
        series = [(n, row) for n, row in zip(self.inputs, coefficients, strict=True) if n in self._series]
        mean = coefficients @ (h ** np.arange(coefficients.shape[1]) / np.arange(1, coefficients.shape[1] + 1))
        values = coefficients[:, 0] if self._interpolates else mean
        plain = [(r, v) for n, r, v in zip(self.inputs, self._places, values, strict=True) if n not in self._series]
        set_reals(self._instance, [r for r, _ in plain], [float(v) for _, v in plain])
        for name, row in series:
            names = (name, *self._series[name])
            set_reals(self._instance, [self.fmu.variable(n).valueReference for n in names], row.tolist())
        if self._interpolates and h > 0:
            slopes = [(r, float(c[1])) for r, c in zip(self._places, coefficients, strict=True) if c[1]]
            if slopes:
                references, numbers = zip(*slopes, strict=True)
                self._instance.setRealInputDerivatives(references, [1] * len(slopes), numbers)

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
            self._set(coefficients, h)
            if self.fmu.version == "2.0":
                self._instance.doStep(t, h)
            else:
                _, terminate, _, last = self._instance.doStep(t, h)
                if terminate or last < t + h - 1e-9 * max(abs(t + h), h):
                    raise CoSimulationError(f"it stopped at t = {last:.6g} s")
        except Exception as error:  # FMPy raises plain exceptions
            raise CoSimulationError(
                f"participant `{self.name}` ({self.fmu.path.name}) could not advance from t = {t:.6g} s by {h:.3g} s: "
                f"{error}"
            ) from error
        self._counts["macro_steps"] += 1
        self._counts["seconds"] += time.perf_counter() - begin

    def evaluate(self, t: float, coefficients: Floats) -> Floats:
        """Outputs, as the unit computed them at the end of its last step, (3, n_y)."""
        begin = time.perf_counter()
        values = np.full((3, len(self.outputs)), np.nan)
        values[0] = get_reals(self._instance, self._reads)
        if self._derived:
            found = get_reals(self._instance, [r for _, _, r in self._derived])
            for (k, order, _), value in zip(self._derived, found, strict=True):
                values[order, k] = value
        self._counts["seconds"] += time.perf_counter() - begin
        return values

    def save(self) -> Any:
        """The unit's state (None before its first step)."""
        get = getattr(self._instance, "getFMUState", None) or self._instance.getFMUstate
        return get()

    def restore(self, state: Any) -> None:
        """Go back to a saved state."""
        put = getattr(self._instance, "setFMUState", None) or self._instance.setFMUstate
        put(state)

    def close(self) -> None:
        """Terminate and free the instance."""
        if self._instance is not None:
            if self._running:
                self._instance.terminate()
            self._instance.freeInstance()
            self._instance, self._running = None, False

    @property
    def stats(self) -> dict[str, Any]:
        """Macro steps and seconds."""
        return dict(self._counts)
