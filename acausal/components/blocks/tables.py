"""Signals through tables."""

from __future__ import annotations

from collections.abc import Sequence

from acausal import Equations

from .interfaces import SI2SO, SISO
from .piecewise import interpolate, interpolate2


class CombiTable1Ds(SISO):
    """One column of a table over `u`, by its `smoothness` and `extrapolation` (see `CombiTimeTable`).

    >>> class Curve(Component):
    ...     ramp: Slope = Slope(slope=4.0)
    ...     curve: CombiTable1Ds = CombiTable1Ds(table=[[0, 0], [1, 2], [3, 0]])
    ...     def equations(self):
    ...         yield connect(self.ramp.y, self.curve.u)
    >>> close(run(Curve(), at=[0.0, 0.125, 0.5, 1.0])["curve.y"], [0.0, 1.0, 1.0, -1.0])
    True

    Source: Modelica.Blocks.Tables.CombiTable1Ds with one column.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0), (1.0, 1.0))
    column: int = 2
    smoothness: str = "LinearSegments"
    extrapolation: str = "LastTwoPoints"

    def equations(self) -> Equations:
        yield from super().equations()
        x, y = [row[0] for row in self.table], [row[self.column - 1] for row in self.table]
        yield self.y == interpolate(self.u, x, y, self.smoothness, self.extrapolation)


class CombiTable2Ds(SI2SO):
    """Bilinear table over `u1` (first column) and `u2` (first row); the number in the corner has no meaning.

    >>> close(binary(CombiTable2Ds(table=[[0, 1, 2], [10, 0, 4], [20, 8, 16]]), 15.0, 1.25), 5.5)
    True

    Source: Modelica.Blocks.Tables.CombiTable2Ds with smoothness LinearSegments.
    """

    table: Sequence[Sequence[float]] = ((0.0, 0.0, 1.0), (0.0, 0.0, 0.0), (1.0, 0.0, 1.0))

    def equations(self) -> Equations:
        yield from super().equations()
        rows, columns = [row[0] for row in self.table[1:]], self.table[0][1:]
        yield self.y == interpolate2(self.u1, self.u2, rows, columns, [row[1:] for row in self.table[1:]])
