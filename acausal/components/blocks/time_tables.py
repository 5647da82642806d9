"""Signals from tables over time."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import acausal as ac
from acausal import DeclarationError, Equations, Output, Parameter, Vector, where

from .interfaces import BEGINNING, SignalSource
from .piecewise import interpolate
from .tables import PartialTable


class TimeTable(SignalSource):
    """Piecewise linear signal through points, ``y = offset + table(t - shiftTime)``, and `offset` before `startTime`.

    Two rows with the same time make a jump; outside the table the last two points are continued.

    >>> table = TimeTable(table=[[0.0, 0.0], [0.25, 2.0], [0.25, -1.0], [0.75, 1.0]])
    >>> run(table, at=[0.0, 0.125, 0.5, 1.0])["y"]
    [0.0, 1.0, 0.0, 2.0]

    Source: Modelica.Blocks.Sources.TimeTable.
    """

    table: Sequence[Sequence[float]] = ()
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the first column")
    shiftTime: Parameter = Parameter(SignalSource.startTime, unit="s", doc="time of the table's zero")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.table:
            raise DeclarationError("TimeTable: the table has no rows, give it some: table=[[time, value], ...]")
        if any(len(row) != 2 for row in self.table):
            raise DeclarationError(f"TimeTable: the table has rows of a time and a value, not {self.table[0]}")
        times, values = [row[0] for row in self.table], [row[1] for row in self.table]
        scaled = (ac.time - self.shiftTime) / self.timeScale
        value = interpolate(scaled, times, values)
        yield self.y == self.offset + where(ac.time < self.startTime, 0.0, value)


class CombiTimeTable(PartialTable):
    """Columns of a table over time, by their `smoothness` and `extrapolation` (see `CombiTable1Ds`).

    `columns` count from 1, the times; by default they are all the others, and ``y[i]`` is that of ``columns[i]``.
    Before `startTime` the outputs are `offset`. A table of one column has one output, which `connect` takes as a whole.

    >>> table = CombiTimeTable(table=[[0.0, 1.0, 5.0], [0.25, 3.0, 6.0], [0.5, 1.0, 7.0]], extrapolation="Periodic")
    >>> result = run(table, at=[0.0, 0.25, 0.625, 0.75])
    >>> result["y[1]"], result["y[2]"]
    ([1.0, 3.0, 2.0, 3.0], [5.0, 6.0, 5.5, 6.0])

    Source: Modelica.Blocks.Sources.CombiTimeTable; one offset is for all outputs.
    """

    offset: Parameter = Parameter(0.0, doc="value added to the outputs")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the signals begin")
    shiftTime: Parameter = Parameter(startTime, unit="s", doc="time of the table's zero")
    timeScale: Parameter = Parameter(1.0, min=1e-30, doc="scale of the first column")
    y: Vector = Vector(Output(doc="output signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        scaled = (ac.time - self.shiftTime) / self.timeScale
        yield from self.inside(scaled, self.abscissas, when=ac.time >= self.startTime)
        begun = [where(ac.time < self.startTime, 0.0, self.value(scaled, k)) for k in range(self.nout)]
        yield self.y == [self.offset + value for value in begun]


def time_table(
    times: Sequence[float], values: Sequence[float], *, offset: float = 0.0, startTime: float = 0.0
) -> TimeTable:
    """A `TimeTable` through the given points, constant outside of them.

    Args:
        times: increasing times [s], n of them, n >= 2.
        values: value at each of the times.
        offset: value added to the table.
        startTime: time of the table's zero [s].

    Raises:
        ValueError: times that do not increase, or lengths that differ.
    """
    points = [float(t) for t in times]
    ordinates = [float(v) for v in values]
    if len(points) != len(ordinates) or len(points) < 2:
        raise ValueError(f"time_table: as many values as times, at least 2, not {len(points)} and {len(ordinates)}")
    if any(b <= a for a, b in pairwise(points)):
        raise ValueError(f"time_table needs increasing times, not {tuple(points)}")
    before, after = points[0] - 1.0, points[-1] + 1.0
    rows = [*zip(points, ordinates, strict=True)]
    held = [(before, ordinates[0]), *rows, (after, ordinates[-1])]
    return TimeTable(table=held, offset=offset, shiftTime=startTime, startTime=BEGINNING)
