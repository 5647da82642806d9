"""A compiled system as a participant of a co-simulation, with the solver of one's choice inside."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..errors import SimulationError, UnknownNameError, nearest
from ..language.declarations import Kind
from ..language.template import Ints
from ..lowering.initial import solve_initial
from ..lowering.initial_numeric import solve_numeric
from ..simulation.engines import why_not_native
from ..system import System
from .feedthrough import depends_at_once
from .participant import DEGREE, CoSimulationError, Floats


@dataclass(frozen=True)
class PolynomialInput:
    """A quantity imposed on a model as a polynomial in time, so that the model can differentiate it.

    Attributes:
        name: the quantity.
        coefficients: parameters of the model, value first, then the coefficients of the powers of time.
        instant: parameter of the model for the time at which the polynomial has its origin [s].
        needs: derivatives of the quantity that the model's equations use.
    """

    name: str
    coefficients: tuple[str, ...]
    instant: str
    needs: int


class SystemParticipant:
    """A system that steps in this process; its program is compiled once and serves all steps.

    Args:
        system: the compiled model; its inputs are the participant's.
        outputs: names of variables to give out or to record; default the `Output` fields of the model itself.
        solver: "rodas5p" (default), "rk4" or "adams" as generated C, or a diffrax solver, which runs in JAX.
        dt: step of a solver of fixed step [s].
        rtol: relative tolerance of the inner solver.
        atol: absolute tolerance as a fraction of the nominal values; a tenth of `rtol` by default.
        parameters: values by dotted name.
        initial: start values by dotted name.
        polynomials: quantities that are imposed with their derivatives.
        name: shown in messages; default the model's.

    Raises:
        UnknownNameError: an output that the model does not have.
        CoSimulationError: a model with `when` and a solver that runs in JAX.
    """

    can_reject = True

    def __init__(
        self,
        system: System,
        *,
        outputs: Sequence[str] = (),
        solver: Any = None,
        dt: float | None = None,
        rtol: float = 1e-6,
        atol: float | None = None,
        parameters: Mapping[str, float] | None = None,
        initial: Mapping[str, float] | None = None,
        polynomials: Sequence[PolynomialInput] = (),
        name: str | None = None,
    ) -> None:
        self.given, self.name = system, name or system.name
        self.method = "rodas5p" if solver is None else solver
        native = isinstance(self.method, str) and why_not_native(system, {"solver": self.method}) is None
        self.system = system.located if native else system
        self.parameters, self.initial = dict(parameters or {}), dict(initial or {})
        self.polynomials = {p.name: p for p in polynomials}
        self.inputs = (*system.input_names, *self.polynomials)
        own = [n for n, d in system.stages.flat.root.cls._declarations.items() if d.kind == Kind.OUTPUT]
        self.outputs = tuple(dict.fromkeys([*own, *outputs]))
        for output in self.outputs:
            system.index_of(output)
        self.needs = {n: self.polynomials[n].needs if n in self.polynomials else 0 for n in self.inputs}
        self.solver, self.dt, self.rtol = solver, dt, rtol
        self.atol = 0.1 * rtol if atol is None else atol
        self._orders = {n: 0 for n in self.outputs}
        self._p: Any = None
        self._state: tuple[Any, float] = (None, 0.0)
        self._ran: set[str] = set()
        self._check_events()
        self._counts: dict[str, float] = {"macro_steps": 0, "steps": 0, "seconds": 0.0, "compile_seconds": 0.0}

    def _check_events(self) -> None:
        if self.system.hybrid is not None and not self._native:
            raise CoSimulationError(
                f"participant `{self.name}` has `when` statements or discrete variables, which need generated C in "
                "this process: take solver='rodas5p' and a machine with a C compiler, or export it with "
                "`acausal.fmi.export` and take the unit"
            )

    @property
    def _native(self) -> bool:
        """Whether generated C does it; a diffrax solver and derivatives that the model does not compute need JAX."""
        if not isinstance(self.method, str) or why_not_native(self.system, {"solver": self.method}) is not None:
            return False
        return all(d >= 0 for n in self.outputs for d in self._derivatives(n)[: self._orders[n]])

    # ---- names ----------------------------------------------------------------------------------------------------
    def require(self, output: str, order: int) -> bool:
        """Ask for time derivatives of an output up to an order, at most 2; always possible."""
        if output not in self._orders:
            raise UnknownNameError(
                f"participant `{self.name}` has no output `{output}`.{nearest(output, self.outputs)}"
            )
        self._orders[output] = max(self._orders[output], min(order, 2))
        if self.system.hybrid is not None and not self._native:
            self.system = self.given  # conditions in equations need no events
            for cached in ("_places", "_feedthrough"):
                self.__dict__.pop(cached, None)
            self._check_events()
        return True

    @property
    def feedthrough(self) -> frozenset[str]:
        """Outputs that depend on inputs at the same instant, by the structure of the equations."""
        return self._feedthrough

    @cached_property
    def _feedthrough(self) -> frozenset[str]:
        low, none = self.system.lowered, np.zeros(0, np.int64)
        found = [
            n for n in self.outputs
            if depends_at_once(low, low.representative[np.ravel(self.system.index_of(n))], none, self._places)
        ]  # fmt: skip
        return frozenset(found)

    def nominal(self, name: str) -> float:
        """Typical magnitude of an input or output: of its declaration, else of its start value, else 1."""
        if name in self.polynomials:
            return 0.0
        low = self.system.lowered
        ids = np.ravel(self.system.index_of(name))
        return float(low.nominal[low.representative[ids[0]]])

    def start(self, name: str) -> float:
        """Value of an input that nothing feeds: its start value."""
        place = self._places[self.system.input_names.index(name)] if name not in self.polynomials else None
        return 0.0 if place is None else float(self.system.program.default[place])

    def unit(self, name: str) -> str:
        """Unit of an input or output, empty if the model gives none."""
        if name in self.polynomials:
            return self.system.stages.flat.root.cls._declarations[name].unit or ""
        return self.system.declaration_of(name).unit or ""

    @cached_property
    def _places(self) -> Ints:
        """Entries of the parameter vector that the inputs give: the system's own, then those of the polynomials."""
        flat = self.system.stages.flat
        places = list(range(flat.n_par, flat.n_par + len(self.system.input_names)))
        for polynomial in self.polynomials.values():
            for name in (*polynomial.coefficients, polynomial.instant):
                places.append(int(np.ravel(flat.names.find(name, parameter=True)[0])[0]))
        return np.array(places, np.int64)

    # ---- programs -------------------------------------------------------------------------------------------------
    @cached_property
    def _inner(self) -> Any:
        """What steps and evaluates: generated C where the machine has a compiler, else JAX."""
        ids = [int(np.ravel(self.system.index_of(n))[0]) for n in self.outputs]
        if self._native:
            from .inner_events import EventInner
            from .inner_native import NativeInner

            if self.method == "rk4" and self.dt is None:
                raise SimulationError("'rk4' takes fixed steps inside a participant: give the step, `dt=1e-4`.")
            options = {
                "method": self.method, "dt": self.dt, "rtol": self.rtol, "atol": self.atol, "outputs": ids,
                "derivatives": [self._derivatives(n) for n in self.outputs], "n_inputs": len(self.system.input_names),
            }  # fmt: skip
            if self.system.hybrid is not None:
                return EventInner(self.system, self._places, name=self.name, **options)
            return NativeInner(self.system, self._places, **options)
        from .inner_jax import JaxInner

        return JaxInner(
            self.system, self._places, solver=_jax_solver(self.method), dt=self.dt, rtol=self.rtol, atol=self.atol,
            outputs=ids, orders=[self._orders[n] for n in self.outputs],
        )  # fmt: skip

    def _derivatives(self, output: str) -> tuple[int, int]:
        """Variables that are the first and second derivative of an output, -1 where the model computes none."""
        index, found = self.system.stages.index, [-1, -1]
        representative, sign = self.system.observed_ids
        at = int(np.ravel(self.system.index_of(output))[0])
        if sign[at] < 0:
            return -1, -1
        at = int(representative[at])
        for k in range(2):
            at = int(index.derivative_of[at])
            if at < 0 or sign[at] < 0:
                break
            found[k], at = at, int(representative[at])
        return found[0], found[1]

    def _matrix(self, t: float, coefficients: Floats) -> Floats:
        """Polynomials of the driven entries of the parameter vector, (n_places, DEGREE + 1)."""
        n = len(self.system.input_names)
        matrix = np.zeros((len(self._places), DEGREE + 1))
        matrix[:n] = coefficients[:n]
        for row in coefficients[n:]:
            matrix[n : n + DEGREE + 1, 0] = row
            matrix[n + DEGREE + 1, 0] = t
            n += DEGREE + 2
        return matrix

    # ---- a participant's life -------------------------------------------------------------------------------------
    def initialize(self, t0: float, coefficients: Floats) -> None:
        """Consistent start with these input polynomials.

        Raises:
            InitializationError: there is none.
        """
        system = self.system
        p = system.program.evaluate(self.parameters, np)
        matrix = self._matrix(t0, coefficients)
        p[self._places] = matrix[:, 0]
        starts, overrides = system.program.starts(p, np), system._overrides(self.initial, np)
        if system.hybrid is not None:
            z0, p, left = self._inner.start(t0, p, starts, self._solve_start(t0, starts, overrides), matrix)
        else:
            z0, left = self._solve_start(t0, starts, overrides)(p)
        system.check_initial(z0[: system.lowered.n_x], z0[system.lowered.n_x :], p, left, t0, self.initial)
        self._p = np.asarray(p, float)
        self._state = (z0, 0.0)

    def _solve_start(self, t0: float, starts: Floats, overrides: Mapping[int, Any]) -> Callable[[Floats], Any]:
        """Consistent states and unknowns for given parameters, and the residuals left."""
        system = self.system

        def solve(p: Floats) -> tuple[Floats, Floats]:
            found = solve_numeric(system.initial, float(t0), p, starts, overrides)
            if found is None:
                import jax.numpy as jnp

                given = system._overrides(self.initial, jnp)
                found = solve_initial(system.initial, t0, jnp.asarray(p), jnp.asarray(starts), given)
            x0, w0, left = (np.asarray(a, float) for a in found)
            return np.concatenate([x0, w0]), left

        return solve

    def step(self, t: float, h: float, coefficients: Floats) -> None:
        """Advance from t to t + h.

        Raises:
            CoSimulationError: the inner solver failed, an event has no outcome, or the model ends the simulation.
        """
        z, hint = self._state
        begin = time.perf_counter()
        key = self._timed("step")
        try:
            z, hint, steps, ok = self._inner.step(t, h, z, self._p, self._matrix(t, coefficients), hint)
        except CoSimulationError:
            raise
        except SimulationError as error:
            raise CoSimulationError(f"participant `{self.name}`: {error}") from error
        self._counts[key] += time.perf_counter() - begin
        self._counts["macro_steps"] += 1
        self._counts["steps"] += steps
        if not ok:
            solver = self.solver if isinstance(self.solver, str) else type(self.solver).__name__
            solver = "Rodas5P" if self.solver is None else solver
            raise CoSimulationError(
                f"participant `{self.name}`: {solver} could not advance from t = {t:.6g} s by {h:.3g} s. The inputs "
                "may have diverged: take a smaller macro step, Gauss-Seidel instead of Jacobi, or a smaller `dt` of an "
                "explicit inner solver."
            )
        self._state = (z, hint)

    def evaluate(self, t: float, coefficients: Floats) -> Floats:
        """Outputs and requested time derivatives at the present state, (3, n_y)."""
        begin = time.perf_counter()
        key = self._timed("evaluate")
        values = self._inner.evaluate(t, self._state[0], self._p, self._matrix(t, coefficients))
        self._counts[key] += time.perf_counter() - begin
        return values

    def _timed(self, what: str) -> str:
        """Under which count the next call goes: the first of each kind compiles."""
        first = what not in self._ran
        self._ran.add(what)
        return "compile_seconds" if first else "seconds"

    def save(self) -> Any:
        """The present state, with modes and discrete variables."""
        return self._state, self._inner.remember()

    def restore(self, state: Any) -> None:
        """Go back to a saved state."""
        self._state, memory = state
        self._inner.recall(memory)

    def close(self) -> None:
        """Nothing is held."""

    @property
    def stats(self) -> dict[str, Any]:
        """Macro steps, inner steps, seconds of running and of compiling."""
        return dict(self._counts)


def _jax_solver(method: Any) -> Any:
    """A diffrax solver for the name of a method."""
    if not isinstance(method, str):
        return method
    from ..simulation.rk4 import RK4
    from ..simulation.rodas5p import Rodas5P

    made = {"rodas5p": Rodas5P, "rk4": RK4}
    if method not in made:
        raise SimulationError(
            f"There is no method {method!r} without a C compiler; there are {', '.join(map(repr, made))}, and the "
            "solvers of diffrax."
        )
    return made[method]()
