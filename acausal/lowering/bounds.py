"""Check of the parameters of a run: every one has a value, within its declared bounds."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..errors import DeclarationError, InitializationError
from ..language.declarations import Declaration
from ..language.flat_model import FlatModel
from ..language.places import field_place, users_field
from ..language.template import Floats, Template

SHOWN = 5
"""Parameters named in one message."""


def check_parameters(flat: FlatModel, p: Any) -> None:
    """Check the values of all parameters.

    Args:
        flat: the model.
        p: all parameters (n_p,), concrete.

    Raises:
        InitializationError: a parameter has no value.
        DeclarationError: a value lies outside the declared bounds.
    """
    values = np.asarray(p)
    missing = np.flatnonzero(np.isnan(values))
    if len(missing):
        lines = [f"`{flat.model_name}`: {_many(len(missing))} no value (or NaN):"]
        lines += [_line(flat, int(i), "") for i in missing[:SHOWN]]
        lines.append(
            "Try: a value at construction, or simulate(parameters={...}); a dependent parameter is NaN if one that it "
            "depends on is."
        )
        raise InitializationError("\n".join(lines))
    built_in = np.flatnonzero(flat.evaluated & (values[: flat.n_par] != flat.evaluated_value))
    if len(built_in):
        computed = np.concatenate([np.zeros(0, np.int64), *(a.targets for a in flat.par_assignments)])
        given = np.setdiff1d(built_in, computed)  # what is computed has changed with what was given
        raise DeclarationError(f"`{flat.model_name}`: {evaluated_text(flat, given if len(given) else built_in)}")
    low, high = declared_bounds(flat.root, parameters=True)
    outside = np.flatnonzero((values[: flat.n_par] < low) | (values[: flat.n_par] > high))
    if len(outside):
        lines = [f"`{flat.model_name}`: {_many(len(outside))} a value out of bounds:"]
        lines += [
            _line(flat, int(i), f" = {values[i]:.6g} lies outside its bounds [{low[i]:.6g}, {high[i]:.6g}]")
            for i in outside[:SHOWN]
        ]
        fields = dict.fromkeys(users_field(flat.root, flat.parameter_name(int(i))) for i in outside[:SHOWN])
        written = [f"    {field}" for field in fields if field]
        lines += ["Written in:", *written] if written else []
        raise DeclarationError("\n".join(lines))


def evaluated_text(flat: FlatModel, ids: Any) -> str:
    """What to say when evaluated parameters are to be changed."""
    names = ", ".join(f"`{flat.parameter_name(int(i))}`" for i in ids[:SHOWN])
    are = "is" if len(ids) == 1 else "are"
    return (
        f"{names} {are} built into the equations (Parameter(evaluate=True), a zero that takes an unknown out of its "
        "equation, or such a parameter is computed from it): "
        "construct the model with the new value and compile it again"
    )


def _many(n: int) -> str:
    return "1 parameter has" if n == 1 else f"{n} parameters have"


def _line(flat: FlatModel, index: int, text: str) -> str:
    if index >= flat.n_par:
        return f"    input `{flat.parameter_name(index)}`{text}"
    declaration: Any = flat.names.declaration(index, parameter=True)
    _, place = field_place(declaration.owner, declaration.name)
    unit = f" [{declaration.unit}]" if declaration.unit else ""
    doc = f" ({declaration.doc})" if declaration.doc else ""
    return f"    `{flat.parameter_name(index)}`{unit}{text}{doc}    {place}"


def declared_bounds(template: Template, *, parameters: bool) -> tuple[Floats, Floats]:
    """Lower and upper bounds of all parameters, or of all variables, of a template, in its order."""
    key = "bounds", parameters
    if key in template.cache:
        return template.cache[key]
    names = [name for name, (is_parameter, _) in template.own.items() if is_parameter == parameters]
    own: list[Declaration] = [template.cls._declarations[name] for name in names]
    count = template.par_count if parameters else template.var_count
    low, high = np.full(count, -np.inf), np.full(count, np.inf)
    low[: len(own)] = [-np.inf if d.min is None else d.min for d in own]
    high[: len(own)] = [np.inf if d.max is None else d.max for d in own]
    for slot in template.children.values():
        if slot.role == "outer":
            continue
        for _, child, first_variable, first_parameter, n in slot.parts():
            below = declared_bounds(child, parameters=parameters)
            base = first_parameter if parameters else first_variable
            end = base + n * len(below[0])
            low[base:end], high[base:end] = np.tile(below[0], n), np.tile(below[1], n)
    template.cache[key] = low, high
    return low, high
