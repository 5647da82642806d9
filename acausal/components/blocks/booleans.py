"""Booleans as signals: true is 1 and false is 0. What blocks with booleans have in common."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Input, Parameter, Vector, pre, where


def true(signal: Expr) -> Expr:
    """The condition that a boolean signal, 1 or 0, is true."""
    return signal > 0.5


def boolean(condition: Expr) -> Expr:
    """1 where `condition` holds, else 0."""
    return where(condition, 1.0, 0.0)


class PartialBooleanSource(Component, partial=True):
    """A boolean output `y`, no input.

    Source: Modelica.Blocks.Interfaces.partialBooleanSource.
    """

    y: Discrete = Discrete(doc="boolean signal")


class PartialBooleanSISO(Component, partial=True):
    """A boolean input `u` and a boolean output `y`.

    Source: Modelica.Blocks.Interfaces.partialBooleanSISO.
    """

    u: Input = Input(doc="boolean signal")
    y: Discrete = Discrete(doc="boolean result")


class PartialThreshold(Component, partial=True):
    """A signal `u` compared with a `threshold`.

    Source: Modelica.Blocks.Logical.GreaterThreshold.
    """

    u: Input = Input(doc="signal")
    threshold: Parameter = Parameter(0.0, doc="threshold")
    y: Discrete = Discrete(doc="boolean result")


class PartialComparison(Component, partial=True):
    """Two signals `u1` and `u2` compared.

    Source: Modelica.Blocks.Interfaces.partialBooleanComparison.
    """

    u1: Input = Input(doc="first signal")
    u2: Input = Input(doc="second signal")
    y: Discrete = Discrete(doc="boolean result")


class PartialBooleanSI2SO(PartialComparison, partial=True):
    """Two boolean inputs `u1` and `u2` and a boolean output `y`.

    Source: Modelica.Blocks.Interfaces.partialBooleanSI2SO.
    """


class PartialBooleanMISO(Component, partial=True):
    """A vector `u` of `nu` boolean inputs and a boolean output `y`.

    Source: Modelica.Blocks.Interfaces.PartialBooleanMISO.
    """

    nu: int = 2
    u: Vector = Vector(Input(doc="boolean signal"), size="nu")
    y: Discrete = Discrete(doc="boolean result")


class PartialPrevious(PartialBooleanSISO, partial=True):
    """A boolean output that depends on what the boolean input was before an event; `pre_u_start` at the start.

    Source: Modelica.Blocks.Logical.Pre.
    """

    pre_u_start: bool = False
    held: Discrete = Discrete(doc="the input")

    def before(self) -> Expr:
        """The condition that the input was true before the event."""
        was = true(pre(self.held))
        return was | ac.initial() if self.pre_u_start else was

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.held == boolean(true(self.u))


def first_true(signals: Vector, values: Vector, default: Expr) -> Expr:
    """The value that belongs to the first of the boolean signals that is true; `default` if none is."""
    found = default
    for signal, value in reversed(list(zip(signals, values, strict=True))):
        found = where(true(signal), value, found)
    return found
