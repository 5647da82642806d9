"""One vector of signals taken apart into several."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Equations, Input, Output, Vector


class PartialDeMultiplex(Component, partial=True):
    """One vector of inputs, taken apart into several vectors of outputs.

    Source: Modelica.Blocks.Routing.DeMultiplex2.
    """

    vectors: ClassVar[int] = 0
    u: Vector = Vector(Input(doc="input signal"), size="n")

    @property
    def n(self) -> int:
        """Number of all signals."""
        return sum(getattr(self, f"n{i + 1}") for i in range(self.vectors))

    def equations(self) -> Equations:
        yield from super().equations()
        parts: list[Vector] = [getattr(self, f"y{i + 1}") for i in range(self.vectors)]
        yield self.u == [signal for part in parts for signal in part]


class DeMultiplex2(PartialDeMultiplex):
    """One vector of signals as two, ``[y1; y2] = u``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 4)}
    >>> joints = [f"c{i}.y - each.u[{i - 1}]" for i in range(1, 4)]
    >>> run(assemble(*joints, each=DeMultiplex2(n1=2), **constants), at=[1.0])["each.y2[1]"]
    [3.0]

    Source: Modelica.Blocks.Routing.DeMultiplex2.
    """

    vectors: ClassVar[int] = 2
    n1: int = 1
    n2: int = 1
    y1: Vector = Vector(Output(doc="output signal of vector 1"), size="n1")
    y2: Vector = Vector(Output(doc="output signal of vector 2"), size="n2")


class DeMultiplex3(PartialDeMultiplex):
    """One vector of signals as three, ``[y1; y2; y3] = u``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 5)}
    >>> joints = [f"c{i}.y - each.u[{i - 1}]" for i in range(1, 5)]
    >>> run(assemble(*joints, each=DeMultiplex3(n1=2), **constants), at=[1.0])["each.y3[1]"]
    [4.0]

    Source: Modelica.Blocks.Routing.DeMultiplex3.
    """

    vectors: ClassVar[int] = 3
    n1: int = 1
    n2: int = 1
    n3: int = 1
    y1: Vector = Vector(Output(doc="output signal of vector 1"), size="n1")
    y2: Vector = Vector(Output(doc="output signal of vector 2"), size="n2")
    y3: Vector = Vector(Output(doc="output signal of vector 3"), size="n3")


class DeMultiplex4(PartialDeMultiplex):
    """One vector of signals as four, ``[y1; y2; y3; y4] = u``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 6)}
    >>> joints = [f"c{i}.y - each.u[{i - 1}]" for i in range(1, 6)]
    >>> run(assemble(*joints, each=DeMultiplex4(n1=2), **constants), at=[1.0])["each.y4[1]"]
    [5.0]

    Source: Modelica.Blocks.Routing.DeMultiplex4.
    """

    vectors: ClassVar[int] = 4
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    y1: Vector = Vector(Output(doc="output signal of vector 1"), size="n1")
    y2: Vector = Vector(Output(doc="output signal of vector 2"), size="n2")
    y3: Vector = Vector(Output(doc="output signal of vector 3"), size="n3")
    y4: Vector = Vector(Output(doc="output signal of vector 4"), size="n4")


class DeMultiplex5(PartialDeMultiplex):
    """One vector of signals as five, ``[y1; y2; y3; y4; y5] = u``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 7)}
    >>> joints = [f"c{i}.y - each.u[{i - 1}]" for i in range(1, 7)]
    >>> run(assemble(*joints, each=DeMultiplex5(n1=2), **constants), at=[1.0])["each.y5[1]"]
    [6.0]

    Source: Modelica.Blocks.Routing.DeMultiplex5.
    """

    vectors: ClassVar[int] = 5
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    n5: int = 1
    y1: Vector = Vector(Output(doc="output signal of vector 1"), size="n1")
    y2: Vector = Vector(Output(doc="output signal of vector 2"), size="n2")
    y3: Vector = Vector(Output(doc="output signal of vector 3"), size="n3")
    y4: Vector = Vector(Output(doc="output signal of vector 4"), size="n4")
    y5: Vector = Vector(Output(doc="output signal of vector 5"), size="n5")


class DeMultiplex6(PartialDeMultiplex):
    """One vector of signals as six, ``[y1; y2; y3; y4; y5; y6] = u``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 8)}
    >>> joints = [f"c{i}.y - each.u[{i - 1}]" for i in range(1, 8)]
    >>> run(assemble(*joints, each=DeMultiplex6(n1=2), **constants), at=[1.0])["each.y6[1]"]
    [7.0]

    Source: Modelica.Blocks.Routing.DeMultiplex6.
    """

    vectors: ClassVar[int] = 6
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    n5: int = 1
    n6: int = 1
    y1: Vector = Vector(Output(doc="output signal of vector 1"), size="n1")
    y2: Vector = Vector(Output(doc="output signal of vector 2"), size="n2")
    y3: Vector = Vector(Output(doc="output signal of vector 3"), size="n3")
    y4: Vector = Vector(Output(doc="output signal of vector 4"), size="n4")
    y5: Vector = Vector(Output(doc="output signal of vector 5"), size="n5")
    y6: Vector = Vector(Output(doc="output signal of vector 6"), size="n6")
