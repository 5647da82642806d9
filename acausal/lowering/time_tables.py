"""Tables over time: steps end at their points, as a pulse between two evaluations would not be seen."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..language.blackbox import Table
from ..language.template import Ints
from ..symbolic.differentiate import partial
from ..symbolic.expr import TIME, ZERO, Expr, par, var
from ..symbolic.traverse import contains, leaves, postorder, substitute

if TYPE_CHECKING:
    from ..language.flat_model import Family
    from ..passes.schedule import Group, Schedule

SLOPES = 2
"""Orders of the derivatives of a table that its points matter for: the value and its slope."""


@dataclass(frozen=True, slots=True, eq=False)
class TimeTable:
    """A table over what moves along a straight line in time, as ``(time - start) / period``.

    Attributes:
        points: where the table has its kinks, increasing.
        argument: where it is read, of time and parameters.
        slope: rate of the argument, of parameters [1/s]; it may switch with conditions.
    """

    points: tuple[float, ...]
    argument: Expr
    slope: Expr


def time_tables(schedule: Schedule, conditions: Iterable[Family] = ()) -> tuple[TimeTable, ...]:
    """The tables over time in the equations of a schedule, and in further expressions of its variables.

    Tables over inputs are left out, as are those over curves in time: their next point does not follow from a value
    and a rate.
    """
    kernels = {id(g.kernel): g.kernel for g in schedule.groups}
    calling = {key for key, kernel in kernels.items() if any(map(_is_table, postorder(kernel.expressions)))}
    further = [f for f in (*schedule.invariants, *conditions) if any(map(_is_table, postorder((f.residual,))))]
    if not calling and not further:
        return ()
    flat = schedule.reduced.flat
    inputs = range(flat.n_par, flat.n_par + len(flat.inputs))
    timed = {key for key, kernel in kernels.items() if leaves(*kernel.expressions, op="time")}
    known: dict[int, Expr] = {}
    found: dict[tuple[tuple[float, ...], int], TimeTable] = {}
    for group in schedule.groups:
        key = id(group.kernel)
        rows = range(group.size) if key in calling or key in timed else _passing_on(group, known)
        for k in rows:
            names = _names(group.var_rows[k], group.par_rows[k], known)
            for unknown, expression in group.kernel.steps:
                value = substitute(expression, names)
                if not group.kernel.tears and _of_time(value, inputs):
                    known[int(group.var_rows[k, unknown])] = names[var(unknown)] = value
            if key in calling:
                _add(group.kernel.expressions, names, inputs, found)
    for family in further:
        for variables, parameters in zip(family.var_rows, family.par_rows, strict=True):
            _add((family.residual,), _names(variables, parameters, known), inputs, found)
    return tuple(found.values())


def _is_table(node: Expr) -> bool:
    return node.op == "call" and isinstance(node.value, Table) and len(node.value.order) < SLOPES


def _passing_on(group: Group, known: Mapping[int, Expr]) -> Iterator[int]:
    """Blocks of a group that do nothing but compute from what is known."""
    kernel = group.kernel
    needed = group.var_rows[:, kernel.size :]
    if kernel.tears or not needed.shape[1] or not known:
        return iter(())
    return iter(np.flatnonzero(np.isin(needed, list(known)).all(axis=1)).tolist())


def _names(variables: Ints, parameters: Ints, known: Mapping[int, Expr]) -> dict[Expr, Expr]:
    """What the leaves of a kernel are in one of its blocks; leaves that are no functions of time stay."""
    names = {par(i): par(p) for i, p in enumerate(parameters.tolist())}
    return names | {var(i): known[v] for i, v in enumerate(variables.tolist()) if v in known}


def _of_time(e: Expr, inputs: range) -> bool:
    return all(leaf.op == "time" or (leaf.op == "par" and leaf.value not in inputs) for leaf in leaves(e))


def _add(
    expressions: Iterable[Expr], names: Mapping[Expr, Expr], inputs: range,
    found: dict[tuple[tuple[float, ...], int], TimeTable],
) -> None:  # fmt: skip
    for node in filter(_is_table, postorder(expressions)):
        argument = substitute(node.args[0], names)
        if not contains(argument, TIME) or not _of_time(argument, inputs):
            continue
        slope = partial(argument, TIME)
        if partial(slope, TIME) is ZERO:
            found.setdefault((node.value.x, id(argument)), TimeTable(node.value.x, argument, slope))
