"""Parameters that are built into the equations: numbers in place of ``Parameter(evaluate=True)``.

The axis of a joint is one: with its zeros known, most of the products of an orientation vanish. (Modelica's annotation
``Evaluate``; what such a parameter is computed from is built in with it.)
"""

from __future__ import annotations

import numpy as np

from ..errors import DeclarationError
from ..language.flat_model import Family, FlatModel, canonical
from ..language.template import Floats
from ..lowering.parameters import ParameterProgram
from ..symbolic.expr import Expr, const, par
from ..symbolic.traverse import substitute

ROUNDING = 1e-15
"""Numbers closer to 0, 1 or -1 than this are these: a normalised axis is exactly one."""


def evaluate_parameters(flat: FlatModel) -> FlatModel:
    """`flat` with the values of evaluated parameters in its equations."""
    marked = flat.evaluated
    if not marked.any():
        return flat
    while True:
        before = int(marked.sum())
        for assignment in flat.par_assignments:
            below = assignment.par_rows[marked[assignment.targets]]
            marked[below.ravel()] = True
        if int(marked.sum()) == before:
            break
    values = ParameterProgram(flat).default[: flat.n_par]
    flat.evaluated_value = np.where(marked, values, np.nan)
    flat.families = [part for f in flat.families for part in _with_numbers(flat, f)]
    flat.initial = [part for f in flat.initial for part in _with_numbers(flat, f)]
    flat.actions = [part for f in flat.actions for part in _with_numbers(flat, f)]
    flat.rules = [part for f in flat.rules for part in _with_numbers(flat, f)]
    return flat


def _with_numbers(flat: FlatModel, family: Family) -> list[Family]:
    """The family in parts of equal numbers; rows with a parameter that has no value keep it."""
    known: Floats = flat.evaluated_value
    inside = family.par_rows < len(known)
    numbers = np.where(inside, known[np.where(inside, family.par_rows, 0)], np.nan)
    columns = np.flatnonzero(~np.isnan(numbers).all(axis=0))
    if not len(columns):
        return [family]
    patterns, which = np.unique(numbers[:, columns], axis=0, return_inverse=True, equal_nan=True)
    out: list[Family] = []
    for k, pattern in enumerate(patterns):
        rows = np.flatnonzero(which.ravel() == k)
        mapping: dict[Expr, Expr] = {
            par(int(c)): const(_rounded(float(v))) for c, v in zip(columns, pattern, strict=True) if not np.isnan(v)
        }
        part = family.select(rows)
        try:
            residual = substitute(part.residual, mapping)
        except ZeroDivisionError as error:
            raise DeclarationError(_divided_text(flat, part)) from error
        form, variables, parameters = canonical(residual, part.var_rows, part.par_rows)
        out.append(Family(form, variables, parameters, part.source, part.ordinal))
    return out


def _divided_text(flat: FlatModel, family: Family) -> str:
    """Which built-in values an equation divides by zero with."""
    where, place = flat.equation_place(family, 0)
    given = [int(k) for k in family.par_rows[0] if k < flat.n_par and flat.evaluated[k]]
    values = ", ".join(f"{flat.parameter_name(k)} = {flat.evaluated_value[k]:g}" for k in given)
    return (
        f"with the values {values}, an equation of `{where or flat.model_name}` divides by zero (a direction has no "
        f"length, or two that span a plane are parallel)    {place}"
    )


def _rounded(value: float) -> float:
    near = round(value)
    return float(near) if abs(near) <= 1 and abs(value - near) < ROUNDING else value
