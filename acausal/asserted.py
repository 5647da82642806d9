"""Assertions without events: conditions below `noevent`, or of parameters alone, checked where values are known.

That is at the start of a run and at the points of its result; of `initial_equations`, at the start alone. Assertions
whose conditions switch at events are part of the event iteration.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import SimulationError
from .language.template import Floats, Ints
from .lowering.hybrid import Assertion
from .lowering.numeric import NumericRun
from .symbolic.expr import Expr
from .symbolic.traverse import evaluate_in_order
from .told import tell

if TYPE_CHECKING:
    from .simulation.solution import Solution
    from .system import System


def check_given(system: System, t0: float, p: Any) -> None:
    """Check the assertions on parameters (n_p,) alone, for a start at t0 [s].

    Raises:
        SimulationError: one does not hold.
    """
    errors = [item for item in _smooth(system) if item.level == "error"]
    found = [item for item in errors if not item.piece.rows.var_rows.shape[1]]
    _refuse(found, t0, np.zeros(0), np.asarray(p, float))


def check_start(system: System, t0: float, x0: Any, w0: Any, p: Any) -> None:
    """Check the other assertions at a start; concrete values only. Warnings wait for the result, if not for the start.

    Raises:
        SimulationError: one does not hold.
    """
    smooth = [item for item in _smooth(system) if item.at_start or item.level == "error"]
    found = [item for item in smooth if item.piece.rows.var_rows.shape[1]]
    if not found:
        return
    low = system.lowered
    groups = [low.schedule.groups[k] for k in low.closure(_variables(found), residuals=False)]
    x, w, numbers = (np.asarray(a, float) for a in (x0, w0, p))
    none = np.zeros((len(x) + len(w), 0))
    run = NumericRun(low, t0, x, w, numbers, np.zeros(0, np.int64), none, groups=groups)
    _refuse(found, t0, run.value, numbers)


def check_run(solution: Solution, values: Callable[[Ints], Floats]) -> None:
    """Check the assertions at all points of a solution with concrete values.

    Args:
        solution: of one run.
        values: of the variables with these numbers at the points of the solution, (n_t, n).

    Raises:
        SimulationError: one does not hold.
    """
    found = [item for item in _smooth(solution.system) if not item.at_start]
    if not found or not len(solution.t):
        return
    ids = _variables(found)
    table = np.asarray(values(ids), float).T if len(ids) else np.zeros((0, len(solution.t)))
    p = np.asarray(solution.p[0] if isinstance(solution.p, tuple) else solution.p, float)
    for text, level in _broken(found, np.asarray(solution.t, float), lambda at: table[np.searchsorted(ids, at)], p):
        if level == "error":
            raise SimulationError(text)
        tell(text)


def _smooth(system: System) -> list[Assertion]:
    return [] if system.statements is None else [item for item in system.statements.asserts if not item.switches]


def _refuse(found: list[Assertion], t0: float, values: Floats, p: Floats) -> None:
    for text, level in _broken(found, np.array([t0]), lambda ids: values[ids, None], p):
        if level == "error":
            raise SimulationError(text)
        tell(text)


def _variables(found: list[Assertion]) -> Ints:
    """Reduced variables in the conditions, ascending."""
    return np.unique(np.concatenate([item.piece.rows.var_rows.ravel() for item in found]))


def _broken(
    found: list[Assertion], t: Floats, values: Callable[[Ints], Floats], p: Floats
) -> Iterator[tuple[str, str]]:
    """For each assertion that does not hold, what to say of the first time at which it does not, and its level.

    Args:
        found: the assertions.
        t: times (n_t,) [s].
        values: of the variables with these numbers, (n, n_t).
        p: parameters (n_p,).
    """
    for item in found:
        rows = item.piece.rows

        def leaf(node: Expr, rows: Any = rows) -> Any:
            if node.op == "time":
                return t
            return p[rows.par_rows[:, node.value], None] if node.op == "par" else values(rows.var_rows[:, node.value])

        computed = dict[int, Any]()
        with np.errstate(all="ignore"):
            evaluate_in_order(item.piece.order, leaf, np, computed)
        holds = np.broadcast_to(computed[id(item.piece.forms[0])], (rows.size, len(t))) != 0.0
        if not holds.all():
            at = int(np.argmax(~holds.all(axis=0)))
            row = int(np.argmax(~holds[:, at]))
            yield item.text(float(t[at]), row) + _given(item, row, p), item.level


def _given(item: Assertion, row: int, p: Floats) -> str:
    """The parameters of a condition that has no variables, with their values."""
    rows = item.piece.rows
    if rows.var_rows.shape[1]:
        return ""
    numbers = dict.fromkeys(rows.par_rows[row].tolist())
    return "\nwith " + ", ".join(f"{item.flat.parameter_name(k)} = {p[k]:.6g}" for k in numbers) if numbers else ""
