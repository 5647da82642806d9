"""Signals combined into vectors, and taken out of them."""

from __future__ import annotations

from collections.abc import Sequence

from acausal import Component, DeclarationError, Discrete, Equations, Input, Output, Parameter, Vector, assert_, where

from .booleans import PartialBooleanSISO, boolean, true
from .interfaces import SISO


class RealPassThrough(SISO):
    """The signal itself, ``y = u``.

    >>> unary(RealPassThrough(), 3.0)
    3.0

    Source: Modelica.Blocks.Routing.RealPassThrough.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u


class IntegerPassThrough(Component):
    """The integer itself, ``y = u``.

    >>> run(assemble("five.y - same.u", five=IntegerConstant(k=5), same=IntegerPassThrough()))["same.y"]
    [5.0, 5.0]

    Source: Modelica.Blocks.Routing.IntegerPassThrough.
    """

    u: Input = Input(doc="integer")
    y: Discrete = Discrete(doc="integer")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u


class BooleanPassThrough(PartialBooleanSISO):
    """The boolean itself, ``y = u``.

    >>> run(assemble("step.y - same.u", step=BooleanStep(startTime=0.5), same=BooleanPassThrough()))["same.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Routing.BooleanPassThrough.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u))


class Replicator(Component):
    """`nout` times the same signal, ``y[i] = u``.

    >>> run(assemble("three.y - copies.u", three=Constant(k=3.0), copies=Replicator(nout=2)))["copies.y[2]"]
    [3.0, 3.0]

    Source: Modelica.Blocks.Routing.Replicator.
    """

    nout: int = 1
    u: Input = Input(doc="input signal")
    y: Vector = Vector(Output(doc="the signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == [self.u] * self.nout


class IntegerReplicator(Component):
    """`nout` times the same integer, ``y[i] = u``.

    >>> run(assemble("three.y - copies.u", three=IntegerConstant(k=3), copies=IntegerReplicator(nout=2)))["copies.y[2]"]
    [3.0, 3.0]

    Source: Modelica.Blocks.Routing.IntegerReplicator.
    """

    nout: int = 1
    u: Input = Input(doc="integer")
    y: Vector = Vector(Discrete(doc="the integer"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == [self.u] * self.nout


class BooleanReplicator(Component):
    """`nout` times the same boolean, ``y[i] = u``.

    >>> model = assemble("step.y - copies.u", step=BooleanStep(startTime=0.5), copies=BooleanReplicator(nout=2))
    >>> run(model)["copies.y[2]"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Routing.BooleanReplicator.
    """

    nout: int = 1
    u: Input = Input(doc="boolean")
    y: Vector = Vector(Discrete(doc="the boolean"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == [boolean(true(self.u))] * self.nout


class ExtractSignal(Component):
    """Some of the `nin` signals, ``y[i] = u[extract[i]]``; `extract` counts from 1.

    >>> model = assemble("one.y - some.u[0]", "two.y - some.u[1]", one=Constant(k=1.0), two=Constant(k=2.0),
    ...                  some=ExtractSignal(nin=2, extract=[2, 1, 2]))
    >>> run(model)["some.y[1]"], run(model)["some.y[2]"]
    ([2.0, 2.0], [1.0, 1.0])

    Source: Modelica.Blocks.Routing.ExtractSignal.
    """

    nin: int = 1
    extract: Sequence[float] = (1.0,)

    @property
    def nout(self) -> int:
        """Number of signals that are taken out."""
        return len(self.extract)

    u: Vector = Vector(Input(doc="input signal"), size="nin")
    y: Vector = Vector(Output(doc="output signal"), size="nout")

    def equations(self) -> Equations:
        yield from super().equations()
        if any(k % 1 or not 1 <= k <= self.nin for k in self.extract):
            raise DeclarationError(f"ExtractSignal: extract={self.extract} are no numbers from 1 to {self.nin}")
        yield self.y == [self.u[int(k) - 1] for k in self.extract]


class Extractor(Component):
    """The signal whose number is the integer `index`, ``y = u[index]``.

    An index that no signal has is an error, or gives `outOfRangeValue` with `allowOutOfRange`.

    >>> model = assemble("one.y - pick.u[0]", "two.y - pick.u[1]", "step.y - pick.index", one=Constant(k=10.0),
    ...                  two=Constant(k=20.0), step=IntegerStep(offset=1, startTime=0.5), pick=Extractor(nin=2))
    >>> run(model, at=[0.4, 0.6])["pick.y"]
    [10.0, 20.0]

    Source: Modelica.Blocks.Routing.Extractor.
    """

    nin: int = 1
    allowOutOfRange: bool = False
    outOfRangeValue: Parameter = Parameter(1e10, doc="output for an index that no signal has")
    u: Vector = Vector(Input(doc="input signal"), size="nin")
    index: Input = Input(doc="number of the signal, an integer from 1 to nin")
    y: Output = Output(doc="chosen signal")

    def equations(self) -> Equations:
        yield from super().equations()
        inside = (self.index > 0.5) & (self.index < self.nin + 0.5)
        found = self.outOfRangeValue * 1.0
        for number, signal in enumerate(self.u, start=1):
            found = where((self.index > number - 0.5) & (self.index < number + 0.5), signal, found)
        if not self.allowOutOfRange:
            yield assert_(inside, f"the index of an Extractor is out of range: there are {self.nin} signals")
        yield self.y == found


class Multiplex(Component):
    """`n` signals as one vector, ``y[i] = u[i]``.

    >>> model = assemble("one.y - all.u[0]", "two.y - all.u[1]", one=Constant(k=1.0), two=Constant(k=2.0),
    ...                  all=Multiplex(n=2))
    >>> run(model)["all.y[2]"]
    [2.0, 2.0]

    Source: Modelica.Blocks.Routing.Multiplex.
    """

    n: int = 2
    u: Vector = Vector(Input(doc="input signal"), size="n")
    y: Vector = Vector(Output(doc="output signal"), size="n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u


class DeMultiplex(Component):
    """The `n` signals of one vector, ``y[i] = u[i]``.

    >>> model = assemble("copies.y - each.u", "three.y - copies.u", three=Constant(k=3.0), copies=Replicator(nout=2),
    ...                  each=DeMultiplex(n=2))
    >>> run(model, at=[1.0])["each.y[2]"]
    [3.0]

    Source: Modelica.Blocks.Routing.DeMultiplex.
    """

    n: int = 2
    u: Vector = Vector(Input(doc="input signal"), size="n")
    y: Vector = Vector(Output(doc="output signal"), size="n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u
