"""The pass list: from a model to a `System`."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from time import perf_counter
from typing import TypeVar

import numpy as np

from .errors import DeclarationError, StructureError
from .language.component import Component
from .language.flat_model import FlatModel
from .language.flatten import flatten
from .language.template import Floats, Ints
from .lowering.hybrid import make_hybrid
from .lowering.initial import initial_problem
from .lowering.lowered import Lowered
from .lowering.parameters import ParameterProgram
from .passes.aliases import Reduced, eliminate_aliases
from .passes.domains import hold_domains
from .passes.evaluate import evaluate_parameters
from .passes.events import extract_events
from .passes.guesses import infer_guesses
from .passes.inputs import input_equations
from .passes.kinks import kinks_as_conditions
from .passes.regularize import regularize
from .passes.reinits import check_reinits
from .passes.schedule import make_schedule
from .passes.specialize import specialize
from .passes.states import select_states
from .passes.structure import check_structure
from .passes.vanishing import vanishing_zeros, with_zeros, zeros_hint
from .passes.wishes import wished_states, with_derivatives
from .system import Stages, System
from .units import check_units

T = TypeVar("T")


class Clock:
    """Runs passes and notes how long each took; `progress` is told the name of each before it starts."""

    def __init__(self, progress: Callable[[str], None] | None) -> None:
        self.seconds: dict[str, float] = {}
        self.progress = progress

    def __call__(self, name: str, work: Callable[[], T]) -> T:
        if self.progress is not None:
            self.progress(name)
        begin = perf_counter()
        result = work()
        self.seconds[name] = self.seconds.get(name, 0.0) + perf_counter() - begin
        return result


def compile(
    model: Component,
    *,
    inputs: Sequence[str] = (),
    outputs: Sequence[str] = (),
    progress: Callable[[str], None] | None = None,
) -> System:
    """Compile a model.

    Args:
        model: an instance of a component class.
        inputs: names of the model's own `Input` fields that `simulate(inputs=...)` will feed, for a check that they
            exist; every `Input` of the model itself is an input of the system.
        outputs: names of variables of interest (checked; they head the result).
        progress: called with the name of each pass before it runs.

    Returns:
        the compiled system.

    Raises:
        DeclarationError: the model's declarations are wrong.
        ConnectError: connectors that do not fit.
        UnitError: an equation whose sides have different units.
        StructureError: equations and unknowns cannot be paired.
    """
    if not isinstance(model, Component):
        what = f"the class `{model.__name__}`: call it" if isinstance(model, type) else f"{type(model).__name__}"
        raise DeclarationError(f"ac.compile takes an instance of a Component class, not {what}")
    clock = Clock(progress)
    flat = clock("flatten", lambda: flatten(model))
    counts = {"variables": flat.n_var, "equations": _declared(flat)}
    clock("units", lambda: check_units(flat))
    flat = clock("inputs", lambda: input_equations(flat, inputs, outputs))
    flat = clock("evaluate", lambda: evaluate_parameters(flat))
    system = finish(flat, clock, counts, located=False)
    system.outputs = tuple(outputs)
    system.made_from = (model, tuple(inputs), tuple(outputs))
    return system


def finish(written: FlatModel, clock: Clock, counts: dict[str, int], *, located: bool) -> System:
    """All passes behind flattening.

    Args:
        written: the flat model as the user wrote it.
        clock: runs the passes.
        counts: of variables and equations, for the report.
        located: whether conditions in equations are modes that change at events, or what they are at every moment.
    """
    zeros = np.zeros(0, np.int64)
    try:
        while True:
            made = _passes(written, clock, counts, located=located)
            if isinstance(made, System):
                return made
            zeros = np.concatenate([zeros, made])
            written = clock("evaluate", lambda made=made, written=written: with_zeros(written, made))
    except StructureError as error:
        raise StructureError(
            f"{error}{zeros_hint(written, zeros)}{written.loop_hint()}", equations=error.equations,
            unknowns=error.unknowns, components=error.components,
        ) from error  # fmt: skip


def _passes(
    written: FlatModel, clock: Clock, counts: dict[str, int], *, located: bool, index: int | None = None
) -> System | Ints:
    """The compiled system, or the parameters that have to be built in first (`vanishing_zeros`).

    `index` is the structural index where the model has been given derivatives that it need not have.
    """
    flat = clock("events", lambda: extract_events(hold_domains(written), located=located))
    program = clock("parameters", lambda: ParameterProgram(flat))
    reduced = clock("aliases", lambda: eliminate_aliases(flat))
    clock("structure check", lambda: check_structure(reduced))
    low_index = clock("index reduction", lambda: regularize(reduced, program.generic))
    zeros = clock("zeros", lambda: vanishing_zeros(low_index, program))
    if len(zeros):
        return zeros
    wished = clock("states", lambda: wished_states(reduced, low_index))
    if len(wished):
        again = clock("states", lambda: with_derivatives(written, wished))
        return _passes(again, clock, counts, located=located, index=low_index.index)
    if index is not None:
        low_index.index = index
    low_index.settle(flat)
    selected = clock("states", lambda: select_states(low_index, program.default))
    schedule = clock("sort and tear", lambda: make_schedule(selected, program.default))
    infer_guesses(schedule, reduced, program.default, program.starts(program.default, np))
    lowered = clock("lower", lambda: Lowered(schedule, _nominal(flat, reduced, len(low_index.unknown)), program.n_p))
    extended = _extended(reduced, flat.n_total)
    check_reinits(flat, schedule, *extended)
    initial = specialize(flat.initial, *extended)
    with_start = ~np.isnan(flat.start)
    for assignment in flat.start_assignments:
        with_start[assignment.targets] = True
    problem = initial_problem(reduced, lowered, initial, with_start)
    stages = Stages(flat, reduced, low_index, schedule, counts, clock.seconds)
    hybrid = make_hybrid(flat, *extended, schedule)
    if hybrid is not None:
        lowered.conditions = hybrid.roots.families
    return System(stages, program, lowered, problem, written, hybrid)


def located_twin(system: System) -> System:
    """The system with its conditions as modes that change at events; itself where there is nothing to locate."""
    written = kinks_as_conditions(system.written, system.stages.index)
    if extract_events(hold_domains(written)).slots.count == system.stages.flat.slots.count:
        return system
    twin = finish(written, Clock(None), system.stages.counts, located=True)
    twin.outputs, twin.made_from = system.outputs, system.made_from
    return twin


def _declared(flat: FlatModel) -> int:
    """Scalar equations before alias elimination, those of connections included."""
    return sum(f.size for f in flat.families) + len(flat.alias_a) + len(flat.zero)


def _extended(reduced: Reduced, n: int) -> tuple[Ints, Ints]:
    """Representative and sign of all variables, those that index reduction added included."""
    more = n - len(reduced.representative)
    return (
        np.concatenate([reduced.representative, np.arange(n - more, n)]),
        np.concatenate([reduced.sign, np.ones(more, np.int64)]),
    )


def _nominal(flat: FlatModel, reduced: Reduced, n: int) -> Floats:
    """Scale of every variable: its nominal value, that of an alias, the size of its start value, else 1."""
    nominal = np.full(n, np.nan)
    given = flat.nominal[:n]
    nominal[: len(given)] = given
    m = len(reduced.representative)
    aliases = np.flatnonzero(~np.isnan(given[:m]) & (reduced.representative != np.arange(m)))
    for v in aliases[::-1]:
        r = int(reduced.representative[v])
        if np.isnan(nominal[r]):
            nominal[r] = given[v]
    return np.where(np.isnan(nominal), 1.0, nominal)
