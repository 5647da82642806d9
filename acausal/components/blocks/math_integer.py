"""Arithmetic of integers, with vectors of inputs (Modelica.Blocks.MathInteger)."""

from __future__ import annotations

from acausal import Component, Discrete, Equations, Input, Parameter, Vector, pre, when, where

from .booleans import first_true, true
from .multi import product, total


class PartialIntegerMISO(Component, partial=True):
    """A vector `u` of `nu` integer inputs and an integer output `y`.

    Source: Modelica.Blocks.Interfaces.PartialIntegerMISO.
    """

    nu: int = 2
    u: Vector = Vector(Input(doc="integer signal"), size="nu")
    y: Discrete = Discrete(doc="integer result")


class Sum(PartialIntegerMISO):
    """Weighted sum, ``y = sum k[i] u[i]``.

    >>> model = assemble("three.y - sum.u[0]", "four.y - sum.u[1]", three=IntegerConstant(k=3),
    ...                  four=IntegerConstant(k=4), sum=math_integer.Sum(nu=2, k=(1, 10)))
    >>> run(model)["sum.y"]
    [43.0, 43.0]

    Source: Modelica.Blocks.MathInteger.Sum.
    """

    k: Vector = Vector(Parameter(1.0, doc="weight, an integer"), size="nu")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == total(self.k, self.u)


class Product(PartialIntegerMISO):
    """Product, ``y = u[1] u[2] ... u[nu]``; 0 without factors.

    >>> model = assemble("three.y - times.u[0]", "four.y - times.u[1]", three=IntegerConstant(k=3),
    ...                  four=IntegerConstant(k=4), times=math_integer.Product(nu=2))
    >>> run(model)["times.y"]
    [12.0, 12.0]

    Source: Modelica.Blocks.MathInteger.Product.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == product(self.u)


class MultiSwitch(Component):
    """The number ``expr[i]`` of the first boolean ``u[i]`` that is true.

    Where none is, the last value stays, or it is `y_default` without `use_pre_as_default`; that is the value before the
    start, too.

    >>> model = assemble("first.y - switch.u[0]", "second.y - switch.u[1]", first=BooleanStep(startTime=0.6),
    ...                  second=BooleanStep(startTime=0.3),
    ...                  switch=math_integer.MultiSwitch(nu=2, expr=(4, 6), y_default=2))
    >>> run(model, at=[0.0, 0.4, 0.8])["switch.y"]
    [2.0, 6.0, 4.0]

    Source: Modelica.Blocks.MathInteger.MultiSwitch.
    """

    nu: int = 2
    use_pre_as_default: bool = True
    expr: Vector = Vector(Parameter(0.0, doc="value where u[i] is the first that is true, an integer"), size="nu")
    y_default: Parameter = Parameter(0.0, doc="value where no u[i] is true, an integer")
    u: Vector = Vector(Input(doc="boolean signal"), size="nu")
    y: Discrete = Discrete(start=y_default, doc="chosen value")

    def equations(self) -> Equations:
        yield from super().equations()
        default = pre(self.y) if self.use_pre_as_default else self.y_default
        yield self.y == first_true(self.u, self.expr, default)


class TriggeredAdd(Component):
    """Adds `u` to the output when the boolean `trigger` becomes true.

    With `use_reset` the boolean `reset` sets the output back to `y_start`, or to the integer `set` with `use_set`.

    >>> model = assemble("two.y - add.u", "pulse.y - add.trigger", two=IntegerConstant(k=2),
    ...                  pulse=BooleanPulse(period=0.4, startTime=0.1), add=math_integer.TriggeredAdd(y_start=5))
    >>> run(model, at=[0.0, 0.2, 0.4, 0.6])["add.y"]
    [5.0, 7.0, 7.0, 9.0]

    Source: Modelica.Blocks.MathInteger.TriggeredAdd.
    """

    use_reset: bool = False
    use_set: bool = False
    y_start: Parameter = Parameter(0.0, doc="value before the first trigger, an integer")
    u: Input = Input(doc="integer that is added")
    trigger: Input = Input(doc="boolean that triggers")
    reset: Input = Input(doc="boolean that resets, with use_reset")
    set: Input = Input(doc="integer that the output is reset to, with use_reset and use_set")
    y: Discrete = Discrete(start=y_start, doc="sum")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.use_reset:
            yield self.reset == 0
        if not (self.use_reset and self.use_set):
            yield self.set == self.y_start
        value = where(true(self.reset), self.set, pre(self.y) + self.u)
        yield when([true(self.trigger), true(self.reset)], {self.y: value})
