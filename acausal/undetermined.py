"""Unknowns that are zero whatever divides them: ``(1 - k1*k2)*y == 0`` says nothing of y where the factor is zero.

The division is not in the compiled equations, so nothing there becomes NaN; the factors are checked before a run.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InitializationError
from .symbolic.expr import ROUNDING
from .symbolic.traverse import evaluate

if TYPE_CHECKING:
    from .system import System

SHOWN = 4
"""Equations that a message names."""


def check_determined(system: System, p: Any) -> None:
    """Check that what divides zero is not zero at these parameters (n_p,).

    Raises:
        InitializationError: equations say nothing of their unknowns.
    """
    schedule = system.stages.schedule
    flat = schedule.reduced.flat
    for group in system.divided:
        divisor = group.kernel.divisor
        assert divisor is not None
        values = np.asarray(p, float)[group.par_rows]
        terms = divisor.args if divisor.op == "add" else (divisor,)
        with np.errstate(all="ignore"):
            parts = evaluate(terms, lambda leaf, values=values: values[:, leaf.value], np)
        size = sum(map(np.abs, parts)) * ROUNDING if len(parts) > 1 else 0.0
        fixed = (group.par_rows < flat.n_par).all(axis=1)  # inputs and modes change in the run
        lost = np.flatnonzero(fixed & (np.abs(sum(parts)) <= size))
        if not len(lost):
            continue
        block = int(lost[0])
        rows = [schedule.reduced.rows.locate(int(row)) for row in group.equations[block, :SHOWN]]
        unknowns = ", ".join(f"`{schedule.reduced.name(int(v))}`" for v in group.unknowns[block, :SHOWN])
        lines = "\n".join(f"    {flat.equation_line(*row)}" for row in rows)
        raise InitializationError(
            f"With the parameters of this run these equations do not determine {unknowns}: any value solves them.\n"
            f"{lines}\nChange a parameter that they hold, or add what is to determine the unknowns."
        )
