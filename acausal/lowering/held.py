"""The schedule with the values of some variables given: what is computed from them waits for nothing else.

In a chain of masses whose states are relative, each absolute position is the sum of all relative ones before it. Where
the start values of the positions are given, they stand where they are used, and what is computed for each has to be
equal to it: each condition then concerns neighbours only, as in multiple shooting.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..language.template import Floats, Ints
from ..passes.schedule import Group, Kernel, Schedule, needs


@dataclass(frozen=True, slots=True, eq=False)
class Held:
    """Values of variables that stand in the place of what is computed for them.

    Attributes:
        ids: their numbers; states and algebraic unknowns among them are not held.
        value: (n,).
        gradient: (n, directions), None if the values do not move.
    """

    ids: Ints
    value: Floats
    gradient: Floats | None = None


def regrouped(schedule: Schedule, chosen: list[int], held: Ints, n_ids: int) -> list[Group]:
    """The `chosen` groups of the schedule, those together that can be evaluated together with variables `held`."""
    given = np.zeros(n_ids, bool)
    given[held] = True
    level_of = np.zeros(n_ids, np.int64)
    parts: dict[tuple[int, int], list[tuple[Group, Ints]]] = {}
    for k in chosen:
        group = schedule.groups[k]
        level = 1 + level_of[needs(group)].max(axis=1, initial=0)
        known = given[group.unknowns]
        if group.kernel.iterates:
            known[:, list(group.kernel.tears)] = True
        level_of[group.unknowns] = np.where(known, 0, level[:, None])
        for at in np.unique(level).tolist():
            parts.setdefault((at, id(group.kernel)), []).append((group, np.flatnonzero(level == at)))
    in_order = sorted(parts.items(), key=lambda item: item[0][0])
    return [_joined(pieces[0][0].kernel, level, pieces) for (level, _), pieces in in_order]


def _joined(kernel: Kernel, level: int, pieces: list[tuple[Group, Ints]]) -> Group:
    var_rows, par_rows, equations = (
        np.concatenate([getattr(group, name)[rows] for group, rows in pieces])
        for name in ("var_rows", "par_rows", "equations")
    )
    return Group(kernel, level, var_rows, par_rows, equations)
