"""What friction elements of all kinds of mechanics have in common."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import PI, DeclarationError, Expr

FREE, FORWARD, STUCK, BACKWARD, UNKNOWN = 2.0, 1.0, 0.0, -1.0, 3.0
"""Values of `mode`, as in Modelica.Mechanics.Rotational.Interfaces.PartialFriction."""
GIVE = 1e-11
"""Relative acceleration, over its unit, of an element that is stuck and holds as much as it can.

A stuck element that begins to slide has crept by this. Where one of those that hold a shaft begins to slide, the others
still hold it, and it accelerates by no more: that is 1e-11 of `sa`, too little to be seen in ``sa = tau0_max + a``. So
what is solved for is `along`, counted from the corner of the characteristic that the element was at before: the torque
while stuck, the acceleration itself while sliding. How elements on rigid gears share a load is then known to rounding
(linear systems are solved with a step of refinement); where it follows from the difference of two accelerations, as of
clutches in a ring, rounding leaves 1e-16 over GIVE undetermined.
"""
LEAST = 1e-12
"""Keeps the share of what an element can hold finite where it can hold nothing."""


def yielding(held: Expr, most: Expr | float) -> Expr:
    """Relative acceleration, over its unit, of an element that is stuck.

    It would be zero, were it not for elements that hold the same shaft twice: how they share its load would be
    undetermined, and the equations singular. So each gives way a little, in proportion to the share of what it can
    hold that it has to hold. Then several elements hold the same share, and let go together, when all of them hold as
    much as they can.

    Args:
        held: what it holds, over the unit of `most`.
        most: what it can hold.
    """
    return GIVE * held / (most + LEAST)


REGULARIZATIONS = ("Exp", "Sine", "Linear", "CoSine")
"""Values of `reg`, as in Modelica.Blocks.Types.Regularization."""


def regularized_sign(share: Expr, reg: str, owner: str) -> Expr:
    """The sign of `share`, continuous within -1 ... 1 in the way that `reg` of the component `owner` says."""
    within = ac.clip(share, -1.0, 1.0)
    if reg == "Exp":
        return 2 / (1 + ac.exp(-share / 0.01)) - 1
    if reg == "Sine":
        return ac.sin(PI / 2 * within)
    if reg == "Linear":
        return within
    if reg == "CoSine":
        return ac.sign(within) * (1 - ac.cos(PI / 2 * within))
    raise DeclarationError(f"{owner}: reg={reg!r} is not one of {', '.join(REGULARIZATIONS)}")


def table_columns(
    owner: object, field: str, rows: Sequence[Sequence[float]], *columns: str, largest: Sequence[float] = ()
) -> list[list[float]]:
    """The columns of a table of friction or losses over the speed, one row for each speed.

    Args:
        owner, field: the component and its field that holds the table, for errors.
        rows: the table.
        columns: names of its columns behind the speed.
        largest: bounds of the first of them, which then must not be zero.

    Raises:
        DeclarationError: rows of another length, speeds that do not begin at 0 and increase, or values out of bounds.
    """
    shape = f"rows (speed, {', '.join(columns)})"
    problem = ""
    if not rows or any(len(row) != 1 + len(columns) for row in rows):
        problem = f"it takes {shape}"
    elif not all(math.isfinite(value) for row in rows for value in row):
        problem = "its values have to be finite numbers"
    elif rows[0][0] != 0.0 or any(b[0] <= a[0] for a, b in pairwise(rows)):
        problem = f"the speeds of its {shape} begin at 0 and increase"
    else:
        for name, k in zip(columns, range(1, 1 + len(columns)), strict=True):
            values = [row[k] for row in rows]
            bounded = k <= len(largest)
            if min(values) < 0.0 or (bounded and (min(values) == 0.0 or max(values) > largest[k - 1])):
                within = f"has to be above 0 and at most {largest[k - 1]:g}" if bounded else "must not be negative"
                problem = f"{name} {within}"
                break
    if problem:
        raise DeclarationError(f"{type(owner).__name__}({field}={[list(row) for row in rows]}): {problem}")
    return [list(column) for column in zip(*rows, strict=True)]
