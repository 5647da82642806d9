"""Guesses for states and for what is iterated on, from the start values of other variables.

A model says roughly where a mechanism is by start values of the coordinates that come to mind (a slider's position),
while the compiler iterates on others (a rod's direction) and integrates others (its middle). Start values are carried
over: an equation in which all variables but one have a value gives a value for that one. Values are those at the
default parameters; they decide which of several solutions is found, not what it is.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..language.flat_model import Bools, FlatModel
from ..language.template import Floats
from .aliases import Reduced
from .implied import LARGEST, Step, implied, propagate
from .schedule import Schedule


def infer_guesses(schedule: Schedule, aliases: Reduced, parameters: Floats, starts: Floats) -> None:
    """Give states and algebraic unknowns without start value one, where it follows from others; in place.

    Args:
        schedule: the sorted equations; `flat.start` of its model is completed.
        aliases: which variable stands for which.
        parameters: default values (n_p,).
        starts: start values of all variables at these, nan where none is given.
    """
    reduced = schedule.reduced
    flat = reduced.flat
    known = _known(aliases, starts, len(reduced.unknown))
    _take_what_counts(schedule, aliases, known, parameters)
    wanted = [int(v) for v in (*schedule.tears, *schedule.states) if v < len(known) and np.isnan(known[v])]
    if not wanted or len(reduced.rows) > LARGEST or np.isnan(known).all():
        return
    _carry_over(reduced, known, parameters)
    for v in wanted:
        if np.isfinite(known[v]):
            flat.start[v] = known[v]


def _known(aliases: Reduced, starts: Floats, n: int) -> Floats:
    """Values of the reduced variables; fixed ones before guesses, those that modifications have given before those of
    classes, then those of the variable itself before an alias's."""
    known = np.full(n, np.nan)
    flat = aliases.flat
    given = np.flatnonzero(~np.isnan(starts[: len(aliases.representative)]) & (aliases.sign != 0))
    own = aliases.representative[given] == given
    order = np.lexsort((own, _modified(flat)[given], flat.fixed[given] == 1))  # what counts most comes last
    for v in given[order].tolist():
        known[aliases.representative[v]] = aliases.sign[v] * starts[v]
    return known


def _modified(flat: FlatModel) -> Bools:
    """Mask of all variables, derivatives too, whose start value a modification has given."""
    return np.pad(flat.modified, (0, flat.n_total - flat.n_var))


def _take_what_counts(schedule: Schedule, aliases: Reduced, known: Floats, parameters: Floats) -> None:
    """Replace what contradicts fixed starts in `known`, and guesses of classes for states that contradict those of
    modifications, there and in `flat.start`.
    """
    flat = aliases.flat
    fixed, modified = flat.fixed[: len(aliases.representative)] == 1, _modified(flat)[: len(aliases.representative)]
    of_class = np.ones(len(known), bool)
    for assignment in flat.start_assignments:
        of_class[assignment.targets] = False  # a matter of the parameters of each run
    chosen = np.zeros(len(known), bool)
    for counts in (fixed, modified):
        chosen[aliases.representative[counts & (aliases.sign != 0)]] = True
        chosen &= ~np.isnan(known)
        for step in implied(schedule.reduced, chosen, schedule.states.tolist()):
            known[step.target] = step.value(lambda v: known[v], parameters, np)
            chosen[step.target] = np.isfinite(known[step.target])
            if counts is modified and chosen[step.target] and of_class[step.target]:
                flat.start[step.target] = known[step.target]


def _carry_over(reduced: Any, known: Floats, parameters: Floats) -> None:
    """Values from equations with one variable that has none, as long as there are such."""

    def take(step: Step) -> bool:
        value = step.value(lambda v: known[v], parameters, np)
        if np.isfinite(value):
            known[step.target] = value
        return bool(np.isfinite(value))

    propagate([reduced.rows.locate(row) for row in range(len(reduced.rows))], ~np.isnan(known), take)
