"""Arithmetic and functions of signals."""

from __future__ import annotations

from collections.abc import Sequence

import acausal as ac
from acausal import Array, Component, Equations, Input, Output, Parameter

from .interfaces import SI2SO, SISO, SO, SignalIn


class Gain(SISO):
    """Gain, ``y = k u``.

    >>> class Twice(Component):
    ...     source: Constant = Constant(k=3.0)
    ...     gain: Gain = Gain(k=2.0)
    ...     def equations(self):
    ...         yield connect(self.source.y, self.gain.u)
    >>> run(Twice())["gain.y"][-1]
    6.0

    Source: Modelica.Blocks.Math.Gain.
    """

    k: Parameter = Parameter(1.0, doc="gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k * self.u


class Feedback(SI2SO):
    """Difference of a command and a feedback signal, ``y = u1 - u2``.

    >>> binary(Feedback(), 5.0, 3.0)
    2.0

    Source: Modelica.Blocks.Math.Feedback.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u1 - self.u2


class Add(SI2SO):
    """Weighted sum of two signals, ``y = k1 u1 + k2 u2``.

    >>> binary(Add(k2=-2.0), 5.0, 3.0)
    -1.0

    Source: Modelica.Blocks.Math.Add.
    """

    k1: Parameter = Parameter(1.0, doc="weight of u1")
    k2: Parameter = Parameter(1.0, doc="weight of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2


class Add3(Component):
    """Weighted sum of three signals, ``y = k1 u1 + k2 u2 + k3 u3``.

    >>> class Total(Component):
    ...     two: Constant = Constant(k=2.0)
    ...     add: Add3 = Add3(k1=1.0, k2=10.0, k3=100.0)
    ...     def equations(self):
    ...         yield connect(self.two.y, self.add.u1, self.add.u2, self.add.u3)
    >>> run(Total())["add.y"][-1]
    222.0

    Source: Modelica.Blocks.Math.Add3.
    """

    u1: Input = Input(doc="first signal")
    u2: Input = Input(doc="second signal")
    u3: Input = Input(doc="third signal")
    y: Output = Output(doc="sum")
    k1: Parameter = Parameter(1.0, doc="weight of u1")
    k2: Parameter = Parameter(1.0, doc="weight of u2")
    k3: Parameter = Parameter(1.0, doc="weight of u3")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2 + self.k3 * self.u3


class Sum(SO):
    """Weighted sum of the signals ``u[i].u``, ``y = sum k[i] u[i]``; as many signals as weights.

    >>> class Total(Component):
    ...     one: Constant = Constant(k=1.0)
    ...     sum: Sum = Sum(k=[2.0, 3.0])
    ...     def equations(self):
    ...         yield connect(self.one.y, self.sum.u[0].u, self.sum.u[1].u)
    >>> run(Total())["sum.y"][-1]
    5.0

    Source: Modelica.Blocks.Math.Sum and MultiSum.
    """

    k: Sequence[float] = (1.0, 1.0)

    @property
    def nin(self) -> int:
        """Number of signals."""
        return len(self.k)

    u: Array[SignalIn] = Array(SignalIn(), "nin")

    def equations(self) -> Equations:
        yield from super().equations()
        terms = [k * self.u[i].u for i, k in enumerate(self.k)]
        yield self.y == sum(terms[1:], terms[0])


class Product(SI2SO):
    """Product of two signals, ``y = u1 u2``.

    >>> binary(Product(), 5.0, 3.0)
    15.0

    Source: Modelica.Blocks.Math.Product.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u1 * self.u2


class Division(SI2SO):
    """Quotient of two signals, ``y = u1/u2``.

    >>> binary(Division(), 6.0, 3.0)
    2.0

    Source: Modelica.Blocks.Math.Division.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u1 / self.u2


class Max(SI2SO):
    """Larger of two signals, ``y = max(u1, u2)``.

    >>> binary(Max(), 6.0, 3.0)
    6.0

    Source: Modelica.Blocks.Math.Max.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.max(self.u1, self.u2)


class Min(SI2SO):
    """Smaller of two signals, ``y = min(u1, u2)``.

    >>> binary(Min(), 6.0, 3.0)
    3.0

    Source: Modelica.Blocks.Math.Min.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.min(self.u1, self.u2)


class Atan2(SI2SO):
    """Angle of the point (u2, u1), ``y = atan2(u1, u2)`` [rad].

    >>> close(binary(Atan2(), 1.0, -1.0), 0.75 * np.pi)
    True

    Source: Modelica.Blocks.Math.Atan2.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.atan2(self.u1, self.u2)


class LinearDependency(SI2SO):
    """Linear combination of two signals, ``y = y0 + k1 u1 + k2 u2``.

    >>> binary(LinearDependency(y0=1.0, k1=2.0, k2=3.0), 5.0, 7.0)
    32.0

    Source: Modelica.Blocks.Math.LinearDependency.
    """

    y0: Parameter = Parameter(0.0, doc="value for u1 = u2 = 0")
    k1: Parameter = Parameter(0.0, doc="weight of u1")
    k2: Parameter = Parameter(0.0, doc="weight of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.y0 + self.k1 * self.u1 + self.k2 * self.u2


class InverseBlockConstraints(Component):
    """Two inputs that are equal and two outputs that are: it turns a block around, ``u1 = u2``, ``y1 = y2``.

    What is connected to `u1` is wanted at the output of the block, which goes to `u2`; `y2` is the input of the block,
    which is found, and comes out at `y1`.

    >>> model = assemble("ramp.y - inverse.u1", "lag.y - inverse.u2", "inverse.y2 - lag.u", ramp=Slope(slope=2.0),
    ...                  inverse=InverseBlockConstraints(), lag=FirstOrder(T=0.5))
    >>> close(run(model, at=[0.0, 1.0])["inverse.y1"], [1.0, 3.0])
    True

    Source: Modelica.Blocks.Math.InverseBlockConstraints.
    """

    u1: Input = Input(doc="wanted output of the block")
    u2: Input = Input(doc="output of the block")
    y1: Output = Output(doc="input of the block that gives it")
    y2: Output = Output(doc="input of the block")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.u1 == self.u2
        yield self.y1 == self.y2


class Power(SISO):
    """Power of a base, ``y = base^u``.

    >>> unary(Power(base=2.0), 3.0)
    8.0

    Source: Modelica.Blocks.Math.Power.
    """

    base: Parameter = Parameter(2.718281828459045, min=0.0, doc="base of the power")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.base**self.u


class RealExpression(SO):
    """A signal given by an equation of the model that has this block.

    >>> class Model(Component):
    ...     value: RealExpression = RealExpression()
    ...     half: Gain = Gain(k=0.5)
    ...     def equations(self):
    ...         yield self.value.y == 4.0 + ac.time
    ...         yield connect(self.value.y, self.half.u)
    >>> run(Model(), at=[0.0, 1.0])["half.y"]
    [2.0, 2.5]

    Source: Modelica.Blocks.Sources.RealExpression.
    """
