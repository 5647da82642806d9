"""What dry friction elements of all kinds of mechanics share: the values of `mode`, and how they share a load."""

from __future__ import annotations

from acausal import Expr

FREE, FORWARD, STUCK, BACKWARD, UNKNOWN = 2.0, 1.0, 0.0, -1.0, 3.0
"""Values of `mode`, as in Modelica.Mechanics.Rotational.Interfaces.PartialFriction."""
GIVE = 1e-10
"""Relative acceleration, over its unit, of an element that is stuck and holds as much as it can."""
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
