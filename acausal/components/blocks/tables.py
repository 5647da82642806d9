"""Signals through tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from acausal import Component, DeclarationError, Equations, Expr, Input, Output, Vector, assert_

from .interfaces import SI2SO
from .piecewise import interpolate
from .surfaces import interpolate2


class PartialTableData(Component, partial=True):
    """A table of numbers: `table`, or with `tableOnFile` what a CSV file has below `nHeaderLines` lines.

    Source: Modelica.Blocks.Tables.CombiTable1Ds, for CSV files.
    """

    table: Sequence[Sequence[float]] = ()
    tableOnFile: bool = False
    fileName: str = ""
    delimiter: str = ","
    nHeaderLines: int = 0

    @property
    def rows(self) -> list[list[float]]:
        """The rows of the table."""
        if not self.tableOnFile:
            if not self.table:
                who = type(self).__name__
                raise DeclarationError(f"{who}: the table has no rows, give it some: table=[[...], ...]")
            return [list(row) for row in self.table]
        try:
            found = np.loadtxt(self.fileName, delimiter=self.delimiter, skiprows=self.nHeaderLines, ndmin=2)
        except (OSError, ValueError) as error:
            raise DeclarationError(f"`fileName={self.fileName!r}` holds no table of numbers: {error}") from None
        return [[float(x) for x in row] for row in found]


class PartialTable(PartialTableData, partial=True):
    """A table whose first column is the abscissa, and the columns that are looked up.

    Source: Modelica.Blocks.Tables.CombiTable1Ds.
    """

    columns: Sequence[float] = ()
    column: int = 0
    smoothness: str = "LinearSegments"
    extrapolation: str = "LastTwoPoints"

    @property
    def chosen(self) -> list[int]:
        """The columns that are looked up, counted from 1."""
        if self.column:
            return [self.column]
        if self.columns:
            return [int(k) for k in self.columns]
        rows = self.rows if self.table or self.tableOnFile else [[0.0, 0.0]]  # none yet: one output
        return list(range(2, len(rows[0]) + 1))

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self.chosen)

    @property
    def abscissas(self) -> list[float]:
        """The first column."""
        return [row[0] for row in self.rows]

    def value(self, u: Expr, k: int) -> Expr:
        """The value of the k-th of the columns at `u`."""
        column, rows = self.chosen[k], self.rows
        if not 1 < column <= len(rows[0]):
            raise DeclarationError(f"column {column}: the table has columns from 2 to {len(rows[0])}")
        ordinates = [row[column - 1] for row in rows]
        return interpolate(u, self.abscissas, ordinates, self.smoothness, self.extrapolation)

    def inside(self, u: Expr, points: Sequence[float], when: Expr | None = None) -> Equations:
        """The assertion that `u` is in the table, without extrapolation."""
        if self.extrapolation == "NoExtrapolation":
            there = (u >= points[0]) & (u <= points[-1])
            holds = there if when is None else there | ~when
            yield assert_(holds, f"a table from {points[0]:g} to {points[-1]:g} is not extrapolated")


class CombiTable1Ds(PartialTable):
    """Columns of a table over `u`: ``y[i]`` is that of ``columns[i]``, by default of all but the first.

    `smoothness`: LinearSegments, ConstantSegments, ContinuousDerivative (Akima), ModifiedContinuousDerivative,
    MonotoneContinuousDerivative1 (Fritsch and Butland) or MonotoneContinuousDerivative2 (Steffen); `extrapolation`:
    LastTwoPoints, HoldLastPoint, Periodic or NoExtrapolation, where leaving the table is an error. A table with one
    column has one output, which `connect` takes as a whole.

    >>> class Curve(Component):
    ...     ramp: Slope = Slope(slope=4.0)
    ...     curve: CombiTable1Ds = CombiTable1Ds(table=[[0, 0, 5], [1, 2, 6], [3, 0, 7]])
    ...     def equations(self):
    ...         yield connect(self.ramp.y, self.curve.u)
    >>> result = run(Curve(), at=[0.0, 0.125, 0.5, 1.0])
    >>> close(result["curve.y[1]"], [0.0, 1.0, 1.0, -1.0]) and close(result["curve.y[2]"], [5.0, 5.5, 6.5, 7.5])
    True

    Source: Modelica.Blocks.Tables.CombiTable1Ds.
    """

    u: Input = Input(doc="abscissa")
    y: Vector = Vector(Output(doc="output signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.inside(self.u, self.abscissas)
        yield self.y == [self.value(self.u, k) for k in range(self.nout)]


class CombiTable1Dv(PartialTable):
    """Columns of a table, each over a signal of its own: ``y[i]`` is ``columns[i]`` at ``u[i]`` (see `CombiTable1Ds`).

    >>> model = assemble("ramp.y - curve.u[0]", "two.y - curve.u[1]", ramp=Slope(slope=4.0), two=Constant(k=2.0),
    ...                  curve=CombiTable1Dv(table=[[0, 0, 5], [1, 2, 6], [3, 0, 7]]))
    >>> run(model, at=[0.0, 0.125])["curve.y[1]"], run(model)["curve.y[2]"]
    ([0.0, 1.0], [6.5, 6.5])

    Source: Modelica.Blocks.Tables.CombiTable1Dv.
    """

    u: Vector = Vector(Input(doc="abscissa"), size="nout")
    y: Vector = Vector(Output(doc="output signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        for k in range(self.nout):
            yield from self.inside(self.u[k], self.abscissas)
        yield self.y == [self.value(self.u[k], k) for k in range(self.nout)]


class PartialTable2D(PartialTableData, partial=True):
    """A table over two signals; the number in its corner has no meaning.

    Source: Modelica.Blocks.Tables.Internal.CombiTable2DBase.
    """

    table: Sequence[Sequence[float]] = ()
    smoothness: str = "LinearSegments"
    extrapolation: str = "LastTwoPoints"

    def look_up(self, u1: Expr, u2: Expr) -> Expr:
        """The value at `u1` (first column) and `u2` (first row)."""
        values = [row[1:] for row in self.rows[1:]]
        return interpolate2(u1, u2, *self.edges, values, self.smoothness, self.extrapolation)

    @property
    def edges(self) -> tuple[list[float], list[float]]:
        """First column and first row."""
        rows = self.rows
        return [row[0] for row in rows[1:]], rows[0][1:]

    def inside(self, u1: Expr, u2: Expr) -> Equations:
        """The assertion that both signals are in the table, without extrapolation."""
        if self.extrapolation == "NoExtrapolation":
            for u, points in zip((u1, u2), self.edges, strict=True):
                text = f"a table from {points[0]:g} to {points[-1]:g} is not extrapolated"
                yield assert_((u >= points[0]) & (u <= points[-1]), text)


class CombiTable2Ds(SI2SO, PartialTable2D):
    """Table over `u1` (first column) and `u2` (first row); the number in the corner has no meaning.

    `smoothness` is LinearSegments (bilinear), ConstantSegments or ContinuousDerivative (Akima); `extrapolation` as of
    `CombiTable1Ds`.

    >>> close(binary(CombiTable2Ds(table=[[0, 1, 2], [10, 0, 4], [20, 8, 16]]), 15.0, 1.25), 5.5)
    True

    Source: Modelica.Blocks.Tables.CombiTable2Ds.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.inside(self.u1, self.u2)
        yield self.y == self.look_up(self.u1, self.u2)


class CombiTable2Dv(PartialTable2D):
    """`n` times the same table, ``y[i]`` at ``(u1[i], u2[i])`` (see `CombiTable2Ds`).

    >>> model = assemble("a.y - map.u1[0]", "b.y - map.u2[0] - map.u2[1]", "c.y - map.u1[1]", a=Constant(k=15.0),
    ...                  b=Constant(k=1.25), c=Constant(k=10.0),
    ...                  map=CombiTable2Dv(n=2, table=[[0, 1, 2], [10, 0, 4], [20, 8, 16]]))
    >>> run(model)["map.y[1]"], run(model)["map.y[2]"]
    ([5.5, 5.5], [1.0, 1.0])

    Source: Modelica.Blocks.Tables.CombiTable2Dv.
    """

    n: int = 1
    u1: Vector = Vector(Input(doc="signal over the first column"), size="n")
    u2: Vector = Vector(Input(doc="signal over the first row"), size="n")
    y: Vector = Vector(Output(doc="output signal"), size="n")

    def equations(self) -> Equations:
        yield from super().equations()
        for u1, u2 in zip(self.u1, self.u2, strict=True):
            yield from self.inside(u1, u2)
        yield self.y == [self.look_up(u1, u2) for u1, u2 in zip(self.u1, self.u2, strict=True)]
