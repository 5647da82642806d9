"""The compiled system: what a user simulates, differentiates and inspects."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from .asserted import check_given, check_start
from .errors import InitializationError, UnknownNameError
from .language.component import Component
from .language.flat_model import FlatModel
from .language.template import Ints
from .language.vectors import Quantities
from .listing import equation_lines
from .lowering.bounds import check_parameters
from .lowering.hybrid import Hybrid
from .lowering.initial import ACCEPTED, InitialProblem, solve_initial
from .lowering.initial_numeric import solve_numeric
from .lowering.lowered import Lowered
from .lowering.numeric import is_concrete
from .lowering.parameters import ParameterProgram
from .passes.aliases import Reduced
from .passes.schedule import Group, Schedule
from .passes.structure import IndexReduced
from .precision import enable_double_precision
from .report import Report, make_report
from .symbolic.expr import Expr
from .symbolic.printing import path_text
from .undetermined import check_determined

if TYPE_CHECKING:
    import diffrax

    from .analysis.ensemble import Ensemble
    from .analysis.linearize import StateSpace
    from .simulation.solution import Solution


@dataclass(slots=True, eq=False)
class Stages:
    """Every record of the compilation, for inspection."""

    flat: FlatModel
    reduced: Reduced
    index: IndexReduced
    schedule: Schedule
    counts: dict[str, int]
    seconds: dict[str, float]


class System:
    """A compiled model. Made by `acausal.compile`.

    Attributes:
        stages: the records of the compilation.
        lowered: the equations as pure JAX functions.
        outputs: names given to `compile`.
        written: the flat model before events were taken out of it.
        hybrid: what happens at events; None if nothing does.
        statements: the same, with assertions even where these are all there is; None if there is nothing.
        made_from: model, inputs and outputs that were compiled; a pickled system is compiled again from them.
    """

    def __init__(
        self,
        stages: Stages,
        program: ParameterProgram,
        lowered: Lowered,
        initial: InitialProblem,
        written: FlatModel,
        statements: Hybrid | None = None,
    ) -> None:
        self.stages = stages
        self.program = program
        self.lowered = lowered
        self.initial = initial
        self.outputs: tuple[str, ...] = ()
        self.written = written
        self.statements = statements
        self.hybrid = statements if statements is not None and statements.eventful else None
        self.made_from: tuple[Component, tuple[str, ...], tuple[str, ...]] | None = None
        self.cache: dict[Any, Any] = {}
        lowered.attach(self.observed_ids)
        enable_double_precision()

    @cached_property
    def located(self) -> System:
        """The same system for runs with events: conditions in equations are modes, which change where they switch."""
        from .compiler import located_twin

        return located_twin(self)

    # ---- names ----------------------------------------------------------------------------------------------------
    @property
    def name(self) -> str:
        """Class name of the model."""
        return self.stages.flat.model_name

    @cached_property
    def parameters(self) -> dict[str, float]:
        """Tunable parameters: dotted name to default value."""
        flat, program = self.stages.flat, self.program
        names = flat.names.all_parameters
        free = np.flatnonzero(~program.dependent[: flat.n_par] & ~flat.evaluated)
        return {names[i]: float(program.default[i]) for i in free.tolist()}

    @cached_property
    def divided(self) -> tuple[Group, ...]:
        """Groups of equations that give zero for an unknown, if something is not zero."""
        return tuple(group for group in self.stages.schedule.groups if group.kernel.divisor is not None)

    @cached_property
    def states(self) -> tuple[str, ...]:
        """Dotted names of the states, in the order of the state vector."""
        return self._names(self.stages.schedule.states)

    @cached_property
    def algebraics(self) -> tuple[str, ...]:
        """Dotted names of the algebraic unknowns that the solver iterates on."""
        return self._names(self.stages.schedule.tears)

    @cached_property
    def observed(self) -> tuple[str, ...]:
        """Dotted names of all other variables: computed from the states, eliminated ones included."""
        kept = set(self.states) | set(self.algebraics)
        return tuple(n for n in self.stages.flat.names.all_variables if n not in kept)

    @cached_property
    def input_names(self) -> tuple[str, ...]:
        """Dotted names of the inputs of the whole model."""
        return self._names(self.stages.flat.inputs)

    def _names(self, ids: Ints) -> tuple[str, ...]:
        flat = self.stages.flat
        if len(ids) < 2000:
            return tuple(flat.name(int(i)) for i in ids)
        names = flat.names.all_variables
        return tuple(names[i] if i < flat.n_var else flat.name(int(i)) for i in ids.tolist())

    @property
    def observed_ids(self) -> tuple[Ints, Ints]:
        """(representative, sign) of every declared variable and derivative of the flat model."""
        n = len(self.stages.index.unknown)
        reduced = self.stages.reduced
        more = n - len(reduced.representative)
        representative = np.concatenate([reduced.representative, np.arange(n - more, n)])
        sign = np.concatenate([reduced.sign, np.ones(more, np.int64)])
        return representative, np.where(self.stages.index.unknown[representative], sign, 0)

    def index_of(self, key: str | Expr) -> Ints:
        """Indices in the vector of all variables that a name (or a variable of the model object) stands for.

        A component array without index gives all its elements; ``der(x)`` gives a derivative that the model has.

        Raises:
            UnknownNameError: with the nearest names.
        """
        if isinstance(key, Quantities) and "path" in key.__dict__:
            key = path_text(key.__dict__["path"])
        text = path_text(key.value) if isinstance(key, Expr) and key.op == "symbol" else str(key)
        flat = self.stages.flat
        if text.startswith("der(") and text.endswith(")"):
            inside = text[4:-1].split(",")
            ids, order = self.index_of(inside[0].strip()), int(inside[1]) if len(inside) > 1 else 1
            for _ in range(order):
                reduced = self.observed_ids[0][ids]
                ids = self.stages.index.derivative_of[reduced]
                if (np.asarray(ids) < 0).any():
                    raise UnknownNameError(
                        f"the model does not compute `{text}`: its equations do not need that derivative"
                    )
            return ids
        ids, is_par = flat.names.find(text)
        if is_par:
            raise UnknownNameError(f"`{text}` is a parameter; its value is in `Solution.parameters`")
        return ids

    def declaration_of(self, key: str | Expr) -> Any:
        """Declaration (unit, doc) of a variable."""
        ids = np.ravel(self.index_of(key))
        flat = self.stages.flat
        index = int(ids[0])
        while index >= flat.n_var:
            index = int(self.stages.index.parent[index])
        return flat.names.declaration(index)

    # ---- numbers --------------------------------------------------------------------------------------------------
    def parameter_vector(self, parameters: Mapping[str, Any] | None = None) -> Any:
        """All parameters (n_p,), dependent ones evaluated; values may be tracers. Pure JAX."""
        import jax.numpy as jnp

        return self.program.evaluate(parameters or {}, jnp)

    def initialize(
        self,
        t0: Any = 0.0,
        parameters: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Any] | None = None,
    ) -> tuple[Any, Any, Any]:
        """Consistent start: states x0, algebraic unknowns w0, and the parameter vector p. Pure JAX.

        Args:
            t0: start time [s].
            parameters: dotted name to value.
            initial: dotted name of a variable to its value at the start; it replaces the declared start value and holds
                exactly.
            inputs: name of an input of the model to its value at the start.
        """
        x0, w0, p, _ = self.initialize_with_residual(t0, parameters, initial, inputs)
        return x0, w0, p

    def initialize_with_residual(
        self,
        t0: Any,
        parameters: Mapping[str, Any] | None,
        initial: Mapping[str, Any] | None,
        inputs: Mapping[str, Any] | None = None,
    ) -> tuple[Any, Any, Any, Any]:
        """As `initialize`, with the relative residuals of the initial conditions."""
        found = self.initialize_numeric(t0, parameters, initial, inputs)
        if found is not None:
            return found
        import jax.numpy as jnp

        p = self._fed(self.parameter_vector(parameters), inputs, jnp)
        starts = self.program.starts(p, jnp)
        x0, w0, left = solve_initial(self.initial, t0, p, starts, self._overrides(initial, jnp))
        return x0, w0, p, left

    def initialize_numeric(
        self,
        t0: Any,
        parameters: Mapping[str, Any] | None,
        initial: Mapping[str, Any] | None,
        inputs: Mapping[str, Any] | None = None,
    ) -> tuple[Any, Any, Any, Any] | None:
        """As `initialize_with_residual`, with NumPy and at once; None inside JAX transformations or if it is large."""
        if not is_concrete((t0, dict(parameters or {}), dict(initial or {}), dict(inputs or {}))):
            return None
        p = self._fed(self.program.evaluate(parameters or {}, np), inputs, np)
        starts = self.program.starts(p, np)
        found = solve_numeric(self.initial, float(t0), p, starts, self._overrides(initial, np))
        return None if found is None else (found[0], found[1], p, found[2])

    def _fed(self, p: Any, inputs: Mapping[str, Any] | None, xp: Any) -> Any:
        """The parameter vector with values of inputs in their places."""
        if not inputs:
            return p
        first = self.program.flat.n_par
        places = np.array([first + self.input_names.index(name) for name in inputs])
        values = xp.stack([xp.asarray(v, float) for v in inputs.values()])
        if xp is not np:
            return p.at[places].set(values)
        p = p.copy()
        p[places] = values
        return p

    def _overrides(self, initial: Mapping[str, Any] | None, xp: Any) -> dict[int, Any]:
        """Further fixed starts: reduced variable index to value."""
        representative, sign = self.observed_ids
        overrides: dict[int, Any] = {}
        written: dict[int, tuple[str, int]] = {}
        for name, value in (initial or {}).items():
            ids = self.index_of(name)
            values = xp.ravel(xp.broadcast_to(xp.asarray(value, float), np.shape(ids)))
            for k, index in enumerate(np.ravel(ids)):
                if not sign[index]:
                    raise InitializationError(
                        f"`{name}` is always zero in this model and cannot be given a start value"
                    )
                number, own = int(representative[index]), int(sign[index])
                given = values[k] * own
                other, its = written.setdefault(number, (name, own))
                if other != name and is_concrete((given, overrides[number])) and given != overrides[number]:
                    related = "equal" if own == its else "opposite"
                    raise InitializationError(
                        f"simulate(initial=...) gives `{other}` and `{name}` values that are not {related}, as they "
                        "are in this model: give one of them"
                    )
                overrides[number] = given
        return overrides

    def check_initial(
        self, x0: Any, w0: Any, p: Any, left: Any, t0: Any = 0.0, initial: Mapping[str, Any] | None = None
    ) -> None:
        """Check concrete results of `initialize_with_residual`, at the start time t0 [s] with start values `initial`.

        Raises:
            DeclarationError: a parameter has a value outside its bounds.
            InitializationError: a parameter has no value, or the start is not consistent.
            SimulationError: an assertion does not hold.
        """
        from .report import explain_initial

        check_parameters(self.stages.flat, p)
        check_given(self, float(t0), p)
        check_determined(self, p)
        values = np.concatenate([np.ravel(np.asarray(a)) for a in (x0, w0, left)])
        if np.isfinite(values).all() and (not np.size(left) or float(np.max(np.asarray(left))) <= ACCEPTED):
            check_start(self, float(t0), x0, w0, p)
            return
        arrays = np.asarray(x0), np.asarray(w0), np.asarray(p), np.asarray(left)
        raise InitializationError(explain_initial(self, *arrays, float(t0), initial or {}))

    def diagnose_nonfinite(self, t: Any, x: Any, w: Any, p: Any) -> str | None:
        """Which equation gives NaN or infinity at a point, as text; None if none does. Concrete values only."""
        from .nonfinite import explain_nonfinite

        return explain_nonfinite(self, t, x, w, p)

    def vector_field(self, t: Any, x: Any, parameters: Mapping[str, Any] | Any = None) -> Any:
        """Time derivatives of the states, (n_x,). Pure JAX: jit, vmap and grad go through.

        Args:
            t: time [s].
            x: states (n_x,), in the order of `states`.
            parameters: dict of dotted names (missing ones at their default), or a vector from `parameter_vector`.
        """
        import jax.numpy as jnp

        p = self.parameter_vector(parameters) if parameters is None or isinstance(parameters, Mapping) else parameters
        x = jnp.asarray(x)
        if not self.lowered.n_w:
            return self.lowered.derivatives(t, x, jnp.zeros(0), p)[0]
        return self.lowered.explicit(t, x, jnp.asarray(self.algebraic_guess), p)

    @cached_property
    def algebraic_guess(self) -> Any:
        """Algebraic unknowns at the default start: where Newton's method begins inside `vector_field`."""
        p = self.program.default
        found = solve_numeric(self.initial, 0.0, p, self.program.starts(p, np), {})
        return np.nan_to_num(self.lowered.w_nominal if found is None else found[1])

    def jacobian(self, t: Any, x: Any, parameters: Mapping[str, Any] | None = None) -> Any:
        """d(vector_field)/dx, (n_x, n_x)."""
        import jax

        return jax.jacfwd(lambda y: self.vector_field(t, y, parameters))(x)

    def linearize(
        self,
        t: float = 0.0,
        x: Any = None,
        *,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, float] | None = None,
        outputs: Sequence[str] = (),
    ) -> StateSpace:
        """State-space matrices at time t and states x; see `acausal.analysis.linearize.linearize`."""
        from .analysis.linearize import linearize

        return linearize(self, t, x, parameters=parameters, inputs=inputs, outputs=outputs)

    def steady_state(
        self,
        *,
        t: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
        inputs: Mapping[str, float] | None = None,
        guess: Any = None,
        tolerance: float = 1e-10,
    ) -> dict[str, float]:
        """Values of all variables where nothing changes; see `acausal.analysis.steady_state.steady_state`."""
        from .analysis.steady_state import steady_state

        return steady_state(self, t=t, parameters=parameters, inputs=inputs, guess=guess, tolerance=tolerance)

    # ---- running --------------------------------------------------------------------------------------------------
    def simulate(
        self,
        t1: float,
        *,
        t0: float = 0.0,
        parameters: Mapping[str, Any] | None = None,
        initial: Mapping[str, Any] | None = None,
        inputs: Mapping[str, Any] | None = None,
        saveat: Any = None,
        rtol: float = 1e-6,
        atol: Any = None,
        solver: Any = None,
        engine: Literal["auto", "diffrax", "native"] = "auto",
        events: Any = True,
        max_steps: int | None = None,
        throw: bool = True,
        progress: bool = False,
        dt: Any = None,
        stepsize_controller: diffrax.AbstractStepSizeController[Any, Any] | None = None,
        adjoint: diffrax.AbstractAdjoint | None = None,
    ) -> Solution:
        """Simulate from t0 to t1. Differentiable in `parameters` and `initial`.

        Args:
            t1: end time [s].
            t0: start time [s].
            parameters: dotted name to value, for those that differ from their default; values may be tracers.
            initial: dotted name to start value; it holds exactly.
            inputs: input name to a number, a function of time written with `jax.numpy`, or a pair (times, values).
            saveat: times of the result, an array or a `diffrax.SaveAt`; by default 501 equidistant points.
            rtol: relative tolerance of the error control.
            atol: absolute tolerance as a fraction of the nominal values; a tenth of `rtol` by default.
            solver: ``"rodas5p"`` (the default, for stiff models), ``"rk4"`` (fixed steps `dt`), ``"adams"`` (variable
                order and step, for models that are not stiff), or a diffrax solver.
            engine: ``native`` (generated C), ``diffrax``, or ``auto``: native where it can do what is asked.
            events: whether events are handled, or a `diffrax.Event`.
            max_steps: most steps, taken and rejected together.
            throw: raise `SimulationError` when the solve fails; otherwise the solution ends early and says so.
            progress: show a progress bar.
            dt: step [s] of a fixed-step solve, or the first step of another.
            stepsize_controller: of diffrax, in place of the error control with the tolerances.
            adjoint: how diffrax differentiates.

        Raises:
            UnknownNameError, InitializationError, SimulationError: see the message.
        """
        from .simulation.engines import simulate

        return simulate(
            self, t1, t0=t0, parameters=parameters, initial=initial, inputs=inputs, saveat=saveat, rtol=rtol, atol=atol,
            solver=solver, engine=engine, events=events, max_steps=max_steps, throw=throw, progress=progress, dt=dt,
            stepsize_controller=stepsize_controller, adjoint=adjoint,
        )  # fmt: skip

    def ensemble(self, parameters: Any, t1: float, **options: Any) -> Ensemble:
        """Simulate once for each row of a table of parameters; see `acausal.analysis.ensemble.ensemble`."""
        from .analysis.ensemble import ensemble

        return ensemble(self, parameters, t1, **options)

    # ---- inspection -----------------------------------------------------------------------------------------------
    def report(self) -> Report:
        """Counts at each stage, structural index, blocks, torn variables, families, seconds; prints as a table."""
        return make_report(self)

    def equations(self, form: Literal["sorted", "flat", "reduced"] = "sorted", latex: bool = False) -> str:
        """The equations as text, one a line.

        Args:
            form: ``flat`` as written with full names, ``reduced`` after alias elimination and index reduction,
                ``sorted`` as assignments in the order of evaluation.
            latex: as LaTeX.
        """
        return "\n".join(equation_lines(self, form, latex))

    def __reduce__(self) -> tuple[Any, ...]:
        if self.made_from is None:
            raise TypeError(f"this System of `{self.name}` was not made by `acausal.compile` and cannot be pickled")
        return _compile_again, self.made_from

    def __repr__(self) -> str:
        return f"System({self.name}: {self.lowered.n_x} states, {self.lowered.n_w} algebraic unknowns)"


def _compile_again(model: Component, inputs: tuple[str, ...], outputs: tuple[str, ...]) -> System:
    """A pickled system in its new process."""
    from .compiler import compile

    return compile(model, inputs=inputs, outputs=outputs)


__all__ = ["Component", "Report", "Stages", "System"]
