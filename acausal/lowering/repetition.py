"""Long chains of equal blocks, each needing the one before: emitted as one loop instead of one copy per link.

Levels of the schedule that repeat (the same kernels on as many rows) become a `lax.scan` whose carry holds all values
of the chain; without it the traced program would grow with the length of the chain.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ..language.template import Ints
from ..passes.schedule import Group, needs

SHORTEST = 12
"""Repetitions from which a loop is used."""
LONGEST_PERIOD = 6
"""Levels after which a chain may repeat itself."""


@dataclass(eq=False)
class Repetition:
    """Groups that repeat: `groups[r][j]` is group j of repetition r; kernels depend on j only."""

    groups: list[list[Group]]

    @cached_property
    def produced(self) -> Ints:
        """Variables that the chain computes, in order."""
        return np.concatenate([g.unknowns.ravel() for period in self.groups for g in period])

    @cached_property
    def external(self) -> Ints:
        """Variables that the chain needs from elsewhere."""
        needed = np.unique(np.concatenate([needs(g).ravel() for period in self.groups for g in period]))
        return np.setdiff1d(needed, self.produced)

    @cached_property
    def rows(self) -> list[Ints]:
        """For each group j, positions in (external, produced) of all its variables: (repetitions, n, columns)."""
        order = np.concatenate([self.external, self.produced])
        position = np.zeros(int(order.max()) + 1, np.int64)
        position[order] = np.arange(len(order))
        return [position[np.stack([period[j].var_rows for period in self.groups])] for j in range(len(self.groups[0]))]

    @cached_property
    def par_rows(self) -> list[Ints]:
        """For each group j, its parameters: (repetitions, n, parameters)."""
        return [np.stack([period[j].par_rows for period in self.groups]) for j in range(len(self.groups[0]))]

    @property
    def unknowns(self) -> Ints:
        """As for a `Group`."""
        return self.produced


def plan(groups: list[Group]) -> list[Group | Repetition]:
    """`groups` (sorted by level) with repeating levels folded."""
    levels = _by_level(groups)
    signatures = [tuple((id(g.kernel), g.size) for g in level) for level in levels]
    out: list[Group | Repetition] = []
    i = 0
    while i < len(levels):
        period, count = _run_at(signatures, i, levels)
        if count >= SHORTEST:
            starts = range(i, i + period * count, period)
            out.append(Repetition([[g for level in levels[a : a + period] for g in level] for a in starts]))
            i += period * count
        else:
            out.extend(levels[i])
            i += 1
    return out


def _by_level(groups: list[Group]) -> list[list[Group]]:
    levels: list[list[Group]] = []
    for g in groups:
        if not levels or levels[-1][0].level != g.level:
            levels.append([])
        levels[-1].append(g)
    return levels


def _run_at(signatures: list[Any], i: int, levels: list[list[Group]]) -> tuple[int, int]:
    """Shortest period with the longest run of repetitions that starts at level `i`."""
    best = (1, 1)
    for period in range(1, LONGEST_PERIOD + 1):
        if i + 2 * period > len(signatures):
            break
        if any(g.kernel.iterates for level in levels[i : i + period] for g in level):
            break
        head = signatures[i : i + period]
        count = 1
        while signatures[i + count * period : i + (count + 1) * period] == head:
            count += 1
        if count >= SHORTEST and count * period > best[0] * best[1]:
            best = (period, count)
    return best


def emit(repetition: Repetition, values: Any, p: Any, batch: Any) -> Any:
    """Values of everything the chain computes.

    Args:
        repetition: the chain.
        values: values of its external variables.
        p: all parameters.
        batch: ``batch(kernel, columns, parameters, n)`` gives the columns of a kernel's unknowns.
    """
    import jax
    import jax.numpy as jnp

    first = repetition.groups[0]
    n_external = len(repetition.external)
    start = jnp.concatenate([values, jnp.zeros(len(repetition.produced))])

    def step(carry: Any, at: Any) -> tuple[Any, None]:
        rows, par_rows = at
        for group, row, par_row in zip(first, rows, par_rows, strict=True):
            m = group.kernel.size
            columns = {j: carry[row[:, j]] for j in range(m, row.shape[1])}
            parameters = [p[par_row[:, j]] for j in range(par_row.shape[1])]
            found = batch(group.kernel, columns, parameters, group.size)
            for u in range(m):
                carry = carry.at[row[:, u]].set(found[u])
        return carry, None

    index = ([jnp.asarray(r) for r in repetition.rows], [jnp.asarray(r) for r in repetition.par_rows])
    return jax.lax.scan(step, start, index)[0][n_external:]
