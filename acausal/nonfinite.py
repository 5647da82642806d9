"""Where a value that is not finite comes from: the first equation that makes one out of finite values."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from .language.flat_model import Bools, Family, FlatModel
from .language.template import Floats, Ints
from .symbolic.expr import Expr
from .symbolic.traverse import evaluate

if TYPE_CHECKING:
    from .system import System

SHOWN = 6
"""Quantities named with their values."""
LISTED = 20
"""Equations of singular blocks listed."""


def explain_nonfinite(system: System, t: Any, x: Any, w: Any, p: Any) -> str | None:
    """Equations that give a non-finite value although all that goes in is finite; None if there are none.

    Args:
        system: a compiled system.
        t: time [s].
        x, w, p: states, algebraic unknowns, parameters, concrete.
    """
    flat = system.stages.flat
    parameters = np.asarray(p, float)
    with np.errstate(all="ignore"):
        values = np.asarray(system.lowered.observe(t, x, w, p), float)
        found = _rows(flat, lambda family: _culprits(family, values, parameters, float(t)))
        head = "It comes from:"
        if not found:
            found = _rows(flat, lambda family: _undetermined(family, values, parameters, float(t)))
            head = "At these values, its equation does not depend on it:"
        if not found:
            found = _first_block(system, values)
            head = "At these values, these equations do not determine their unknowns:"
    if not found:
        return None
    lines = [head]
    for family, row in found[:3]:
        lines.append(f"    {flat.equation_line(family, row)}")
        lines.append(f"    with {_given(flat, family, row, values, parameters)}")
    return "\n".join(lines)


def block_equations(system: System, unknowns: Ints) -> list[str]:
    """The equations of the blocks that iterate the algebraic unknowns of these numbers, with their places."""
    schedule, flat = system.stages.schedule, system.stages.flat
    lines: dict[str, None] = {}
    offset = 0
    for group in schedule.groups:
        if not group.kernel.iterates:
            continue
        m = len(group.kernel.tears)
        place = unknowns - offset
        offset += group.size * m
        for block in np.unique(place[(place >= 0) & (place < group.size * m)] // m):
            for row in group.equations[block].tolist():
                lines[f"    {flat.equation_line(*schedule.reduced.rows.locate(row))}"] = None
    return list(lines)[:LISTED]


def _first_block(system: System, values: Floats) -> list[tuple[Family, int]]:
    """The equations of the first block of the schedule that makes non-finite values of finite ones."""
    schedule = system.stages.schedule
    for group in schedule.groups:
        bad = ~np.isfinite(values[np.minimum(group.var_rows, len(values) - 1)])
        m = group.unknowns.shape[1]
        rows = np.flatnonzero(bad[:, :m].any(axis=1) & ~bad[:, m:].any(axis=1))
        if len(rows):
            return [schedule.reduced.rows.locate(int(row)) for row in group.equations[rows[0]]]
    return []


def _rows(flat: FlatModel, pick: Callable[[Family], Bools]) -> list[tuple[Family, int]]:
    """The first rows of each family that are picked."""
    return [(family, int(row)) for family in flat.families for row in np.flatnonzero(pick(family))[:SHOWN]]


def _culprits(family: Family, values: Floats, parameters: Floats, t: float) -> Bools:
    """Rows whose only non-finite variable, put to one, leaves the residual non-finite."""
    one, residual = _filled(family, values, parameters, t, 1.0)
    return one & ~np.isfinite(residual)


def _undetermined(family: Family, values: Floats, parameters: Floats, t: float) -> Bools:
    """Rows whose only non-finite variable makes no difference to the residual."""
    one, first = _filled(family, values, parameters, t, 1.0)
    _, second = _filled(family, values, parameters, t, 2.0)
    return one & (first == second)


def _filled(family: Family, values: Floats, parameters: Floats, t: float, fill: float) -> tuple[Bools, Floats]:
    """Rows with a single non-finite variable, and their residuals with another value in its place."""
    columns = values[np.minimum(family.var_rows, len(values) - 1)]
    bad = ~np.isfinite(columns)
    some = bad.any(axis=1)
    if not some.any():
        return np.zeros(len(bad), bool), np.zeros(len(bad))
    first = family.var_rows[np.arange(len(bad)), bad.argmax(axis=1)]
    one = some & (~bad | (family.var_rows == first[:, None])).all(axis=1)
    filled = np.where(bad, fill, columns)

    def leaf(node: Expr) -> Any:
        if node.op == "var":
            return filled[:, node.value]
        return parameters[family.par_rows[:, node.value]] if node.op == "par" else t

    return one, np.broadcast_to(np.asarray(evaluate((family.residual,), leaf, np)[0], float), one.shape)


def _given(flat: FlatModel, family: Family, row: int, values: Floats, parameters: Floats) -> str:
    """Names and values of what goes into an equation."""
    variables = [(flat.name(int(v)), values[int(v)]) for v in family.var_rows[row] if int(v) < len(values)]
    constants = [(flat.parameter_name(int(i)), parameters[int(i)]) for i in family.par_rows[row]]
    return ", ".join(f"{name} = {value:.6g}" for name, value in [*variables, *constants][:SHOWN])
