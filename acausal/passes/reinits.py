"""What `reinit` may give a new value: a variable whose derivative the model has; and what jumps with it by choice.

Modelica Language Specification 3.6, 8.3.6.
"""

from __future__ import annotations

import numpy as np

from ..errors import DeclarationError
from ..language.flat_model import FlatModel
from ..language.template import Ints
from .schedule import Schedule

SHOWN = 8
"""States named in a message."""


def check_reinits(flat: FlatModel, schedule: Schedule, representative: Ints, sign: Ints) -> None:
    """Raise DeclarationError where `reinit` is for a variable that is neither a state nor differentiated.

    Other variables follow from the states at every moment: a new value for one of them says of no state how it jumps.
    """
    states = set(schedule.states.tolist())
    derivative_of = schedule.reduced.derivative_of
    for family in flat.actions:
        if family.residual.op != "reinit":
            continue
        target = family.residual.args[0]
        for row, index in enumerate(family.var_rows[:, target.value].tolist()):
            number = int(representative[index])
            if sign[index] and (derivative_of[number] >= 0 or number in states):
                continue
            component, place = flat.equation_place(family, row)
            known = ", ".join(f"`{flat.name(v)}`" for v in schedule.states[:SHOWN].tolist())
            raise DeclarationError(
                f"reinit of `{flat.name(index)}`, which is no state: it follows from "
                f"{'the other variables' if sign[index] else 'the equations, which make it zero'} at every moment "
                f"({component + ', ' if component else ''}{place})\nTry: reinit a variable whose derivative the model "
                f"has{f' (states are {known})' if known else ''}, or make it a state by an equation with its `der`."
            )


def states_by_choice(flat: FlatModel, schedule: Schedule, representative: Ints) -> tuple[Ints, Ints]:
    """States whose derivative no equation holds, and variables whose derivative one holds that are no states.

    An impulse leaves the second kind as they are where it does not act on them: their equations have finite sides. But
    it is the states that keep their values at a `reinit`, and where relative coordinates are states these others jump.
    """
    has = np.flatnonzero(flat.derivative_of[: flat.n_var] >= 0)
    held = np.zeros(flat.n_total, bool)
    for family in flat.families:
        held[family.var_rows.ravel()] = True
    written = held[flat.derivative_of[has]]
    differentiated = np.unique(representative[has[written]])
    chosen = np.setdiff1d(representative[has[~written]], differentiated)
    return np.intersect1d(chosen, schedule.states), np.setdiff1d(differentiated, schedule.states)
