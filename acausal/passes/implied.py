"""What fixed starts alone imply: values of states that are no matter of guessing.

A guess may contradict a fixed start, as the zero that a spring's deflection has by default where the angle that it is
has been fixed. The search for the start would begin with the contradiction, and might end far from all guesses, with a
mechanism put together the other way round. So what follows from fixed starts by an equation in which all variables but
one have a value replaces the guess of a state; the conditions of the start hold it in any case.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..language.flat_model import Bools, Family
from ..language.template import Ints
from ..symbolic.expr import Expr, var
from ..symbolic.isolate import Isolated, isolate
from ..symbolic.traverse import evaluate, leaves
from .structure import IndexReduced

LARGEST = 5000
"""Models with more equations than this keep the guesses they are given."""


@dataclass(frozen=True, slots=True, eq=False)
class Step:
    """A variable that follows from others that have a value.

    Attributes:
        target: the variable.
        solution: its value; its leaves are those of an equation's family.
        variables, parameters: which ones these leaves are.
    """

    target: int
    solution: Expr
    variables: Ints
    parameters: Ints

    def value(self, values: Callable[[int], Any], p: Any, xp: Any) -> Any:
        """Its value, with a time of zero; not finite where its equation cannot be solved for it there.

        Args:
            values: those of variables.
            p: all parameters.
            xp: numpy or jax.numpy.
        """

        def leaf(node: Expr) -> Any:
            if node.op == "time":
                return 0.0
            return values(int(self.variables[node.value])) if node.op == "var" else p[self.parameters[node.value]]

        with np.errstate(all="ignore"):
            try:
                return evaluate((self.solution,), leaf, xp)[0]
            except ZeroDivisionError:
                return np.nan


def implied(reduced: IndexReduced, fixed: Bools, states: Sequence[int]) -> list[Step]:
    """How states follow from the variables in the mask `fixed`, in order; empty where none of them does.

    Only equations count that are the same at all times and in all modes.

    Args:
        reduced: the equations.
        fixed: mask over the reduced variables.
        states: those that are wanted.
    """
    if len(reduced.rows) > LARGEST or not fixed.any():
        return []
    steps = _follow(reduced, fixed.copy())
    needed = {int(v) for v in states}
    kept: list[Step] = []
    for step in reversed(steps):
        if step.target in needed:
            kept.append(step)
            needed.update(int(step.variables[e.value]) for e in leaves(step.solution) if e.op == "var")
    return kept[::-1]


def _follow(reduced: IndexReduced, known: Bools) -> list[Step]:
    """All that follows from what is known (a mask that is completed)."""
    constant = [_is_constant(family) for family in reduced.families]
    rows = [
        (family, k) for i, family in enumerate(reduced.families) if constant[i] for k in range(family.size)
        if (family.par_rows[k] < reduced.flat.n_par).all()  # no inputs, nothing that events change
    ]  # fmt: skip
    steps: list[Step] = []

    def take(step: Step) -> bool:
        steps.append(step)
        return True

    propagate(rows, known, take)
    return steps


def propagate(rows: Sequence[tuple[Family, int]], known: Bools, take: Callable[[Step], bool]) -> None:
    """Follow equations with one variable that is not known, as long as there are such.

    Args:
        rows: equations, as families and their rows.
        known: mask of the variables, which is completed.
        take: called with what follows; whether it counts as known.
    """
    users: dict[int, list[int]] = {}
    missing: list[int] = []
    for row, (family, k) in enumerate(rows):
        open_ones = {int(v) for v in family.var_rows[k] if not known[v]}
        missing.append(len(open_ones))
        for v in open_ones:
            users.setdefault(v, []).append(row)
    solved: dict[tuple[int, int], Isolated] = {}
    queue = deque(row for row, count in enumerate(missing) if count == 1)
    while queue:
        family, k = rows[queue.popleft()]
        slots = np.flatnonzero(~known[family.var_rows[k]])
        if len(slots) != 1:
            continue
        key = id(family.residual), int(slots[0])
        if key not in solved:
            solved[key] = isolate(family.residual, var(int(slots[0])))
        solution, target = solved[key].solution, int(family.var_rows[k, slots[0]])
        if solution is None or not take(Step(target, solution, family.var_rows[k], family.par_rows[k])):
            continue
        known[target] = True
        for user in users.get(target, ()):
            missing[user] -= 1
            if missing[user] == 1:
                queue.append(user)


def _is_constant(family: Family) -> bool:
    return not any(e.op == "time" for e in leaves(family.residual))
