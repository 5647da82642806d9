"""Integers that depend on time alone."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Component, DeclarationError, Discrete, Equations, Parameter, where

from .boolean_sources import held
from .interfaces import BEGINNING


class IntegerSO(Component, partial=True):
    """An integer output `y`, no input.

    Source: Modelica.Blocks.Interfaces.IntegerSO.
    """

    y: Discrete = Discrete(doc="integer signal")


class IntegerConstant(IntegerSO):
    """Constant integer, ``y = k``.

    >>> run(IntegerConstant(k=3))["y"]
    [3.0, 3.0]

    Source: Modelica.Blocks.Sources.IntegerConstant.
    """

    k: Parameter = Parameter(1.0, doc="value, an integer")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k


class IntegerStep(IntegerSO):
    """Step, ``y = offset``, from `startTime` on ``offset + height``.

    >>> run(IntegerStep(height=2, offset=1, startTime=0.5), at=[0.0, 0.4, 0.6, 1.0])["y"]
    [1.0, 1.0, 3.0, 3.0]

    Source: Modelica.Blocks.Sources.IntegerStep.
    """

    height: Parameter = Parameter(1.0, doc="height of the step, an integer")
    offset: Parameter = Parameter(0.0, doc="value before, an integer")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, self.height)


class IntegerTable(IntegerSO):
    """Integer that changes at the times of a table with rows (time, value); 0 before `startTime`.

    Before the first time it has the first value; behind the last one it stays (`extrapolation` HoldLastPoint) or begins
    anew (Periodic).

    >>> run(IntegerTable(table=[[0, 1], [0.5, 4], [0.75, -2]]), at=[0.0, 0.4, 0.6, 1.0])["y"]
    [1.0, 1.0, 4.0, -2.0]

    Source: Modelica.Blocks.Sources.IntegerTable.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0),)
    extrapolation: str = "HoldLastPoint"
    startTime: Parameter = Parameter(BEGINNING, unit="s", doc="0 before")
    shiftTime: Parameter = Parameter(0.0, unit="s", doc="time of the table's zero")
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the times")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.table or any(len(row) != 2 or row[1] % 1 for row in self.table):
            raise DeclarationError(f"IntegerTable: rows of a time and an integer, not {self.table}")
        times, values = [row[0] for row in self.table], [row[1] for row in self.table]
        t = (ac.time - self.shiftTime) / self.timeScale
        value = held([times[0], *times], [values[0], *values], self.extrapolation, t)
        yield self.y == where(ac.time < self.startTime, 0.0, value)


class IntegerExpression(IntegerSO):
    """An integer given by an equation of the model that has this block.

    >>> class Model(Component):
    ...     number: IntegerExpression = IntegerExpression()
    ...     def equations(self):
    ...         yield self.number.y == ac.floor(3 * ac.time)
    >>> run(Model(), at=[0.2, 0.5, 0.9])["number.y"]
    [0.0, 1.0, 2.0]

    Source: Modelica.Blocks.Sources.IntegerExpression.
    """
