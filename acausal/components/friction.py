"""What friction elements of all kinds of mechanics have in common."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import PI, Component, DeclarationError, Discrete, Equations, Expr, Variable, pre, where

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


def corners(ahead: Expr, back: Expr, highest: Expr, lowest: Expr) -> tuple[Expr, Expr, Expr]:
    """`sa` at the corner of the characteristic where an element was before, and the two corners as seen from there.

    Args:
        ahead, back: whether it was sliding forward, or backward; at neither it was stuck, and counts from zero.
        highest, lowest: `sa` where forward and backward sliding begin.
    """
    at = where(ahead, highest, where(back, lowest, 0.0))
    upper = where(ahead, 0.0, where(back, highest - lowest, highest))
    return at, upper, where(ahead, lowest - highest, where(back, 0.0, lowest))


class StickSlip(Component, partial=True):
    """State machine of dry friction: sliding forward, sliding backward, stuck, or free.

    While stuck the unknown `sa` is what holds, in units of torque or force. While sliding it is the acceleration,
    shifted so that the characteristic has no jump.

    Source: Modelica.Mechanics.Rotational.Interfaces.PartialFriction; Otter, Elmqvist and Mattsson, Hybrid modeling in
    Modelica based on the synchronous data flow principle, CACSD 1999.
    """

    free: Discrete = Discrete(doc="whether the frictional element is not active")
    sa: Variable = Variable(doc="curve parameter of the friction characteristic")
    along: Variable = Variable(doc="sa from its corner: what holds while stuck, what accelerates while sliding")
    startForward: Discrete = Discrete(doc="whether the relative speed is 0 and forward sliding starts")
    startBackward: Discrete = Discrete(doc="whether the relative speed is 0 and backward sliding starts")
    locked: Discrete = Discrete(doc="whether the relative speed is 0 and not sliding")
    mode: Discrete = Discrete(start=UNKNOWN, doc="2 free, 1 forward, 0 stuck, -1 backward, 3 unknown")
    holds: Variable = Variable(doc="friction torque or force while stuck; subclasses give its unit")

    def stick_slip(
        self, speed: Expr, acceleration: Expr, peak: Expr, small: Expr, units: tuple[Expr, Expr]
    ) -> Equations:
        """The equations of the state machine.

        Args:
            speed, acceleration: of the frictional surfaces, relative to each other.
            peak: the largest torque or force while stuck, over its unit.
            small: speed near 0, for impulses that stop the motion.
            units: of `sa` as an acceleration and as a torque or force.
        """
        along = self.along
        unit_acceleration, unit_holds = units
        was = pre(self.mode)
        was_free, forward, stuck, backward = was == FREE, was == FORWARD, was == STUCK, was == BACKWARD
        held = pre(self.locked) > 0.5  # what comes to rest is held first: sliding on would agree with the laws, too
        begins, returns = ac.initial() & (speed > 0), ac.initial() & (speed < 0)
        went, came = pre(self.startForward) > 0.5, pre(self.startBackward) > 0.5
        at, upper, lower = corners(forward | went, backward | came, peak, -peak)
        sa = along + at
        yield self.sa == sa
        starts = stuck & self.ahead((held | went) & (along > upper))
        reverses = stuck & self.behind((held | came) & (along < lower))
        yield self.startForward == where(starts | (backward & (speed > small)) | begins, 1.0, 0.0)
        yield self.startBackward == where(reverses | (forward & (speed < -small)) | returns, 1.0, 0.0)
        going, coming, free = self.startForward > 0.5, self.startBackward > 0.5, self.free > 0.5
        yield self.locked == where(free | forward | going | backward | coming, 0.0, 1.0)
        moving = along - where(going | (forward & ~coming), upper, lower)
        rate = where(self.locked > 0.5, yielding(sa, peak), where(free, sa, moving))
        yield acceleration == unit_acceleration * rate
        yield self.holds == where(self.locked > 0.5, sa * unit_holds, 0.0)
        slides = self.ahead((forward | was_free | going) & (speed > 0))
        slips = self.behind((backward | was_free | coming) & (speed < 0))
        yield self.mode == where(free, FREE, where(slides, FORWARD, where(slips, BACKWARD, STUCK)))

    def ahead(self, condition: Expr) -> Expr:
        """`condition`, where there is room to move forward."""
        return condition

    def behind(self, condition: Expr) -> Expr:
        """`condition`, where there is room to move backward."""
        return condition

    def direction(self) -> Expr:
        """Sign of the sliding motion, by the mode before this moment."""
        forward = (pre(self.mode) == FORWARD) | (self.startForward > 0.5)
        return where(self.startBackward > 0.5, -1.0, where(forward, 1.0, -1.0))

    def friction(self, sliding: Expr) -> Expr:
        """Friction torque or force: what holds while locked, nothing while free, else `sliding`."""
        return where(self.locked > 0.5, self.holds, where(self.free > 0.5, 0.0 * sliding, sliding))


def not_continued_below_zero(field: str, values: Sequence[float], value: Expr, idle: Expr | None = None) -> Equations:
    """The assertion that the line through the last two points of a table of friction is not followed below zero.

    Friction below zero drives: a table of falling friction (Stribeck) may end at a speed that the model exceeds.

    Args:
        field: the field that holds the table.
        values: the friction in its rows.
        value: what the table says at the present speed.
        idle: where there is no friction, whatever the table says.
    """
    if len(values) > 1 and values[-1] < values[-2]:
        holds = value >= 0.0 if idle is None else (value >= 0.0) | idle
        text = f"beyond its last row `{field}` is continued below zero, and drives: end it with a row at a higher speed"
        yield ac.assert_(ac.noevent(holds), text)


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
