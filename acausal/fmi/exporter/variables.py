"""The variables that an FMU shows: names, roles, start values, aliases."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TYPE_CHECKING, Any

import numpy as np

from ...errors import AcausalError
from ...language.declarations import Kind

if TYPE_CHECKING:
    from ...lowering.hybrid import Hybrid
    from ...system import System


class ExportError(AcausalError):
    """A system that cannot be written as an FMU as asked."""


class Place(IntEnum):
    """Where the value of a variable is found; the numbers are those of ``instance.h``."""

    PARAMETER = 0
    CALCULATED = 1
    INPUT = 2
    TIME = 3
    VARIABLE = 4
    DERIVATIVE = 5
    ZERO = 6
    INDICATOR = 7


@dataclass(slots=True, eq=False)
class FmuVariable:
    """One row of the table of variables; its number is the value reference.

    Attributes:
        name: dotted name.
        place, index, sign: where the value is found: in the parameters, the variables or the derivatives.
        causality, variability, initial: as in the model description.
        start: start value, None where it is computed.
        slot: number of the start value that setting this variable changes, -1 where it is computed.
        derivative_of: value reference of the state.
        aliases: further names with their descriptions.
    """

    name: str
    place: Place
    index: int
    sign: int
    causality: str
    variability: str = "continuous"
    initial: str | None = "calculated"
    start: float | None = None
    slot: int = -1
    unit: str | None = None
    nominal: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    description: str = ""
    derivative_of: int | None = None
    aliases: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])


INDICATORS = "_event_indicators"
"""Name of the array of event indicators."""
STATES = "_states"
"""Name of the array of states that are no variables of the model."""
STRUCTURED = re.compile(r"(?:der\()?[A-Za-z_]\w*(?:\[\d+\])?(?:\.[A-Za-z_]\w*(?:\[\d+\])?)*\)?", re.ASCII)
"""Names of the structured naming convention, as far as they occur here."""


class Starts:
    """Start values: of all states and algebraic unknowns (x, w), then of other variables with a fixed one.

    Attributes:
        ids: reduced variable behind each.
        source, sign: the variable whose declared start value it takes.
        fixed: mask of the states that keep their start value exactly.
        value: of each at default parameters, 0 where none is given.
        computed: mask of those that depend on parameters.
    """

    def __init__(self, system: System) -> None:
        problem, flat = system.initial, system.stages.flat
        schedule = problem.lowered.schedule
        self.ids = np.concatenate([schedule.states, schedule.tears, problem.targets])
        self.source, self.sign = problem.start_source[self.ids], problem.start_sign[self.ids]
        more = bool(len(problem.targets) or problem.families or problem.lowered.n_g)
        self.fixed = problem.fixed if more else np.ones(len(schedule.states), bool)
        values = self.sign * system.program.starts(system.program.default, np)[self.source]
        self.value = np.nan_to_num(values)
        assigned = np.zeros(len(flat.start), bool)
        for assignment in flat.start_assignments:
            assigned[assignment.targets] = True
        self.computed = assigned[self.source]
        self.n_x, self.n_w = len(schedule.states), len(schedule.tears)
        self.settable = {int(v): k for k, v in enumerate(self.ids) if not self.n_x <= k < self.n_x + self.n_w}


def collect(system: System, version: str) -> list[FmuVariable]:
    """All variables: time, parameters, inputs, declared variables with their aliases, derivatives of the states.

    Args:
        system: a compiled system.
        version: of FMI; in 2.0 an alias of a variable that can be set is a variable of its own.

    Raises:
        ExportError: a parameter has no value.
    """
    table = [
        FmuVariable("time", Place.TIME, 0, 1, "independent", initial=None, unit="s", description="simulation time")
    ]
    table += _parameters(system)
    starts = Starts(system)
    table += _declared(system, starts, version)
    flat = system.stages.flat
    for i, state in enumerate(starts.ids[: starts.n_x].tolist()):
        of = _state_reference(table, state, flat.name(state))
        if of is None:  # a derivative that index reduction has made: `der(name)` is the slope of the state `name`
            of = len(table)
            entry = FmuVariable(f"{STATES}[{i}]", Place.VARIABLE, state, 1, "local", description=flat.name(state))
            entry.nominal = float(system.lowered.x_nominal[i])
            table.append(entry)
        slope = FmuVariable(f"der({table[of].name})", Place.DERIVATIVE, i, 1, "local", derivative_of=of)
        slope.unit, slope.description = _per_second(table[of].unit), f"time derivative of {table[of].name}"
        table.append(slope)
    if version == "3.0" and system.statements is not None:
        table += list(_indicators(system.statements))
    return table


def _indicators(hybrid: Hybrid) -> Iterator[FmuVariable]:
    """Event indicators, which FMI 3.0 has among the variables."""
    for k, slot in enumerate(hybrid.roots.slots.tolist()):
        text = hybrid.flat.slot_text(slot) if slot >= 0 else "a number is rounded"
        yield FmuVariable(f"{INDICATORS}[{k}]", Place.INDICATOR, k, 1, "local", description=f"event: {text}")


def _state_reference(table: list[FmuVariable], state: int, name: str) -> int | None:
    """Number of the variable that stands for a state, None if the model declares none."""
    own = (k for k, v in enumerate(table) if v.place is Place.VARIABLE and v.index == state and v.name == name)
    return next(own, None)


def _per_second(unit: str | None) -> str | None:
    if unit is None:
        return None
    if unit in ("", "1"):
        return "1/s"
    return f"{unit}2" if unit.endswith("/s") else f"({unit})/s" if "/" in unit else f"{unit}/s"


def _parameters(system: System) -> Iterator[FmuVariable]:
    flat, program = system.stages.flat, system.program
    names = flat.names.all_parameters
    missing = [names[i] for i in np.flatnonzero(np.isnan(program.default[: flat.n_par]))]
    if missing:
        raise ExportError(
            f"`{system.name}`: {len(missing)} of the parameters have no value, which an FMU needs: "
            f"{', '.join(f'`{n}`' for n in missing[:5])}. Give one at construction."
        )
    for i, name in enumerate(names):
        if flat.evaluated[i]:  # built into the equations: nothing to be set
            continue
        declaration: Any = flat.names.declaration(i, parameter=True)
        free = not program.dependent[i]
        yield FmuVariable(
            name, Place.PARAMETER if free else Place.CALCULATED, i, 1, "parameter" if free else "calculatedParameter",
            "tunable", "exact" if free else "calculated", float(program.default[i]) if free else None,
            unit=declaration.unit, minimum=declaration.min, maximum=declaration.max, description=declaration.doc,
        )  # fmt: skip


def _declared(system: System, starts: Starts, version: str) -> list[FmuVariable]:
    """Variables of the model, one for each value, unit and causality, in the order of declaration."""
    flat = system.stages.flat
    representative, sign = system.observed_ids
    inputs, outputs = {int(v): k for k, v in enumerate(flat.inputs)}, _outputs(system)
    found: dict[Any, FmuVariable] = {}

    def role(v: int) -> tuple[str, str | None]:
        causality = "input" if v in inputs else "output" if v in outputs else "local"
        return causality, flat.names.declaration(v).unit

    for v, name in enumerate(flat.names.all_variables):
        r, s = int(representative[v]), int(sign[v])
        own = s == 1 and (v == r or (version == "3.0" and r < flat.n_var and role(v) == role(r)))
        slot = starts.settable.get(r, -1) if own and v not in inputs else -1
        if slot >= 0 and starts.computed[slot]:
            slot = -1
        place, index = (Place.VARIABLE, r) if s else (Place.ZERO, 0)
        if v in inputs:
            place, index, s = Place.INPUT, flat.n_par + inputs[v], 1
        key = (place, index, s, role(v), slot)
        if key not in found:
            entry = FmuVariable(name, place, index, s or 1, role(v)[0], slot=slot)
            found[key] = _entry(system, starts, v, entry)
        else:
            found[key].aliases.append((name, flat.names.declaration(v).doc))
            if v == r:
                _rename(found[key], flat.names.declaration(v))
    return list(found.values())


def _entry(system: System, starts: Starts, v: int, entry: FmuVariable) -> FmuVariable:
    """Attributes of a variable of the model."""
    flat = system.stages.flat
    declaration: Any = flat.names.declaration(v)
    entry.unit, entry.description = declaration.unit, declaration.doc
    entry.minimum, entry.maximum = declaration.min, declaration.max
    entry.variability = "discrete" if declaration.kind is Kind.DISCRETE else "continuous"
    state = np.flatnonzero(starts.ids[: starts.n_x] == entry.index)
    if len(state) and entry.sign == 1 and entry.place is Place.VARIABLE:
        entry.nominal = float(system.lowered.x_nominal[state[0]])
    elif not np.isnan(flat.nominal[v]):
        entry.nominal = float(flat.nominal[v])
    if entry.place is Place.INPUT:
        entry.initial, entry.start = None, float(system.program.default[entry.index])
    elif entry.slot >= 0:
        exact = entry.slot >= starts.n_x or starts.fixed[entry.slot]
        entry.initial, entry.start = "exact" if exact else "approx", float(starts.value[entry.slot])
    return entry


def _rename(entry: FmuVariable, declaration: Any) -> None:
    """The last alias, which the model computes with, becomes the name."""
    name, doc = entry.aliases.pop()
    entry.aliases.append((entry.name, entry.description))
    entry.name, entry.description = name, doc
    entry.minimum, entry.maximum = declaration.min, declaration.max


def _outputs(system: System) -> set[int]:
    """Variables that the user named as outputs, and the `Output` fields of the model itself."""
    flat = system.stages.flat
    named = {int(v) for name in system.outputs for v in np.ravel(system.index_of(name))}
    own = {v for v, name in enumerate(flat.names.all_variables) if flat.kind[v] == Kind.OUTPUT and "." not in name}
    return {v for v in named | own if v < flat.n_var}
