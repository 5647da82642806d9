"""Arithmetic of vectors of signals."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Component, DeclarationError, Equations, Expr, Input, Output, Parameter, Vector

from .booleans import first_true
from .interfaces import SO

ZERO = 0.0 * ac.time
"""The number 0 as an expression."""


def total(weights: Vector | Sequence[float], signals: Vector | Sequence[Expr]) -> Expr:
    """Weighted sum of signals, without those of weight 0; 0 of none."""
    both = zip(weights, signals, strict=True)
    terms = [k * u for k, u in both if not isinstance(k, (int, float)) or k != 0.0]
    return sum(terms[1:], terms[0]) if terms else ZERO


def product(signals: Vector) -> Expr:
    """Product of signals; 0 of none, as in Modelica."""
    if not len(signals):
        return ZERO
    result = signals[0] * 1.0
    for signal in list(signals)[1:]:
        result = result * signal
    return result


class PartialRealMISO(SO, partial=True):
    """A vector `u` of `nu` inputs and an output `y`.

    Source: Modelica.Blocks.Interfaces.PartialRealMISO.
    """

    nu: int = 2
    u: Vector = Vector(Input(doc="input signal"), size="nu")


class MultiSum(PartialRealMISO):
    """Weighted sum, ``y = sum k[i] u[i]``.

    >>> model = assemble("one.y - sum.u[0] - sum.u[2]", "ramp.y - sum.u[1]", one=Constant(k=1.0), ramp=Slope(),
    ...                  sum=MultiSum(nu=3, k=(1.0, 2.0, 3.0)))
    >>> run(model, at=[0.0, 1.0])["sum.y"]
    [4.0, 6.0]

    Source: Modelica.Blocks.Math.MultiSum.
    """

    k: Vector = Vector(Parameter(1.0, doc="weight"), size="nu")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == total(self.k, self.u)


class MultiProduct(PartialRealMISO):
    """Product, ``y = u[1] u[2] ... u[nu]``; 0 without factors.

    >>> model = assemble("two.y - times.u[0] - times.u[2]", "ramp.y - times.u[1]", two=Constant(k=2.0), ramp=Slope(),
    ...                  times=MultiProduct(nu=3))
    >>> run(model, at=[0.0, 1.0])["times.y"]
    [0.0, 4.0]

    Source: Modelica.Blocks.Math.MultiProduct.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == product(self.u)


class MultiSwitch(SO):
    """The number ``expr[i]`` of the first boolean ``u[i]`` that is true, `y_default` where none is.

    >>> model = assemble("first.y - switch.u[0]", "second.y - switch.u[1]", first=BooleanStep(startTime=0.6),
    ...                  second=BooleanStep(startTime=0.3), switch=MultiSwitch(nu=2, expr=(4.0, 6.0), y_default=2.0))
    >>> run(model, at=[0.0, 0.4, 0.8])["switch.y"]
    [2.0, 6.0, 4.0]

    Source: Modelica.Blocks.Math.MultiSwitch; the numbers are parameters here and may be signals there.
    """

    nu: int = 2
    expr: Vector = Vector(Parameter(0.0, doc="value where u[i] is the first that is true"), size="nu")
    y_default: Parameter = Parameter(0.0, doc="value where no u[i] is true")
    u: Vector = Vector(Input(doc="boolean signal"), size="nu")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == first_true(self.u, self.expr, self.y_default)


class MinMax(Component):
    """Smallest and largest of `nu` signals.

    >>> model = assemble("one.y - both.u[0]", "ramp.y - both.u[1]", one=Constant(k=1.0), ramp=Slope(slope=2.0),
    ...                  both=MinMax(nu=2))
    >>> result = run(model, at=[0.0, 1.0])
    >>> result["both.yMin"], result["both.yMax"]
    ([0.0, 1.0], [1.0, 2.0])

    Source: Modelica.Blocks.Math.MinMax.
    """

    nu: int = 2
    u: Vector = Vector(Input(doc="input signal"), size="nu")
    yMax: Output = Output(doc="largest input")
    yMin: Output = Output(doc="smallest input")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.nu:
            raise DeclarationError("MinMax: nu=0, and there is no smallest of no signals")
        low = high = self.u[0] * 1.0
        for signal in list(self.u)[1:]:
            low, high = ac.min(low, signal), ac.max(high, signal)
        yield self.yMin == low
        yield self.yMax == high


class MatrixGain(Component):
    """Product with a matrix, ``y = K u``.

    >>> model = assemble("one.y - gain.u[0]", "ramp.y - gain.u[1]", one=Constant(k=1.0), ramp=Slope(),
    ...                  gain=MatrixGain(K=[[1, 2], [3, 4], [5, 6]]))
    >>> run(model, at=[1.0])["gain.y[3]"]
    [11.0]

    Source: Modelica.Blocks.Math.MatrixGain.
    """

    K: Sequence[Sequence[float]] = ((1.0, 0.0), (0.0, 1.0))

    @property
    def nin(self) -> int:
        """Number of inputs."""
        return len(self.K[0]) if self.K else 0

    @property
    def nout(self) -> int:
        """Number of outputs."""
        return len(self.K)

    u: Vector = Vector(Input(doc="input signal"), size="nin")
    y: Vector = Vector(Output(doc="output signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == [total(row, self.u) for row in self.K]
