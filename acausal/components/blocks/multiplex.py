"""Vectors of signals joined into one."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Equations, Input, Output, Vector


class PartialMultiplex(Component, partial=True):
    """Several vectors of inputs, joined into one vector of outputs.

    Source: Modelica.Blocks.Routing.Multiplex2.
    """

    vectors: ClassVar[int] = 0
    y: Vector = Vector(Output(doc="output signal"), size="n")

    @property
    def n(self) -> int:
        """Number of all signals."""
        return sum(getattr(self, f"n{i + 1}") for i in range(self.vectors))

    def equations(self) -> Equations:
        yield from super().equations()
        parts: list[Vector] = [getattr(self, f"u{i + 1}") for i in range(self.vectors)]
        yield self.y == [signal for part in parts for signal in part]


class Multiplex2(PartialMultiplex):
    """Two vectors of signals as one, ``y = [u1; u2]``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 3)}
    >>> joints = [f"c{i}.y - all.u{i}[0]" for i in range(1, 3)]
    >>> run(assemble(*joints, all=Multiplex2(), **constants), at=[1.0])["all.y[2]"]
    [2.0]

    Source: Modelica.Blocks.Routing.Multiplex2.
    """

    vectors: ClassVar[int] = 2
    n1: int = 1
    n2: int = 1
    u1: Vector = Vector(Input(doc="input signal of vector 1"), size="n1")
    u2: Vector = Vector(Input(doc="input signal of vector 2"), size="n2")


class Multiplex3(PartialMultiplex):
    """Three vectors of signals as one, ``y = [u1; u2; u3]``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 4)}
    >>> joints = [f"c{i}.y - all.u{i}[0]" for i in range(1, 4)]
    >>> run(assemble(*joints, all=Multiplex3(), **constants), at=[1.0])["all.y[3]"]
    [3.0]

    Source: Modelica.Blocks.Routing.Multiplex3.
    """

    vectors: ClassVar[int] = 3
    n1: int = 1
    n2: int = 1
    n3: int = 1
    u1: Vector = Vector(Input(doc="input signal of vector 1"), size="n1")
    u2: Vector = Vector(Input(doc="input signal of vector 2"), size="n2")
    u3: Vector = Vector(Input(doc="input signal of vector 3"), size="n3")


class Multiplex4(PartialMultiplex):
    """Four vectors of signals as one, ``y = [u1; u2; u3; u4]``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 5)}
    >>> joints = [f"c{i}.y - all.u{i}[0]" for i in range(1, 5)]
    >>> run(assemble(*joints, all=Multiplex4(), **constants), at=[1.0])["all.y[4]"]
    [4.0]

    Source: Modelica.Blocks.Routing.Multiplex4.
    """

    vectors: ClassVar[int] = 4
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    u1: Vector = Vector(Input(doc="input signal of vector 1"), size="n1")
    u2: Vector = Vector(Input(doc="input signal of vector 2"), size="n2")
    u3: Vector = Vector(Input(doc="input signal of vector 3"), size="n3")
    u4: Vector = Vector(Input(doc="input signal of vector 4"), size="n4")


class Multiplex5(PartialMultiplex):
    """Five vectors of signals as one, ``y = [u1; u2; u3; u4; u5]``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 6)}
    >>> joints = [f"c{i}.y - all.u{i}[0]" for i in range(1, 6)]
    >>> run(assemble(*joints, all=Multiplex5(), **constants), at=[1.0])["all.y[5]"]
    [5.0]

    Source: Modelica.Blocks.Routing.Multiplex5.
    """

    vectors: ClassVar[int] = 5
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    n5: int = 1
    u1: Vector = Vector(Input(doc="input signal of vector 1"), size="n1")
    u2: Vector = Vector(Input(doc="input signal of vector 2"), size="n2")
    u3: Vector = Vector(Input(doc="input signal of vector 3"), size="n3")
    u4: Vector = Vector(Input(doc="input signal of vector 4"), size="n4")
    u5: Vector = Vector(Input(doc="input signal of vector 5"), size="n5")


class Multiplex6(PartialMultiplex):
    """Six vectors of signals as one, ``y = [u1; u2; u3; u4; u5; u6]``.

    >>> constants = {f"c{i}": Constant(k=1.0 * i) for i in range(1, 7)}
    >>> joints = [f"c{i}.y - all.u{i}[0]" for i in range(1, 7)]
    >>> run(assemble(*joints, all=Multiplex6(), **constants), at=[1.0])["all.y[6]"]
    [6.0]

    Source: Modelica.Blocks.Routing.Multiplex6.
    """

    vectors: ClassVar[int] = 6
    n1: int = 1
    n2: int = 1
    n3: int = 1
    n4: int = 1
    n5: int = 1
    n6: int = 1
    u1: Vector = Vector(Input(doc="input signal of vector 1"), size="n1")
    u2: Vector = Vector(Input(doc="input signal of vector 2"), size="n2")
    u3: Vector = Vector(Input(doc="input signal of vector 3"), size="n3")
    u4: Vector = Vector(Input(doc="input signal of vector 4"), size="n4")
    u5: Vector = Vector(Input(doc="input signal of vector 5"), size="n5")
    u6: Vector = Vector(Input(doc="input signal of vector 6"), size="n6")
