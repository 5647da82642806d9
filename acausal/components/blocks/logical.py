"""Logic of booleans: gates, edges, flip-flop, switches."""

from __future__ import annotations

from acausal import (
    Component,
    Discrete,
    Equations,
    Input,
    Output,
    Parameter,
    change,
    connect,
    initial,
    structural,
    where,
)

from .booleans import PartialBooleanSI2SO, PartialBooleanSISO, PartialPrevious, boolean, true


class Not(PartialBooleanSISO):
    """``y = not u``.

    >>> run(assemble("step.y - test.u", step=BooleanStep(startTime=0.5), test=Not()), at=[0.4, 0.6])["test.y"]
    [1.0, 0.0]

    Source: Modelica.Blocks.Logical.Not.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u), 0.0, 1.0)


class Pre(PartialPrevious):
    """The input before the present event, ``y = pre(u)``; breaks loops of booleans.

    >>> model = assemble("step.y - test.u", step=BooleanStep(startTime=0.5), test=Pre())
    >>> run(model, at=[0.4, 0.6])["test.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Logical.Pre.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(self.before())


class Edge(PartialPrevious):
    """True at the events at which the input becomes true, ``y = edge(u)``.

    >>> model = assemble("pulse.y - edge.u", "edge.y - count.trigger", "one.y - count.u", one=IntegerConstant(),
    ...                  pulse=BooleanPulse(period=0.4, startTime=0.1), edge=Edge(), count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.0, 0.2, 0.4, 0.6])["count.y"]
    [0.0, 1.0, 1.0, 2.0]

    Source: Modelica.Blocks.Logical.Edge and Modelica.Blocks.MathBoolean.RisingEdge.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u) & ~self.before())


class FallingEdge(PartialPrevious):
    """True at the events at which the input becomes false, ``y = edge(not u)``.

    >>> model = assemble("pulse.y - edge.u", "edge.y - count.trigger", "one.y - count.u", one=IntegerConstant(),
    ...                  pulse=BooleanPulse(period=0.4, startTime=0.1), edge=FallingEdge(),
    ...                  count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.0, 0.2, 0.4, 0.6])["count.y"]
    [0.0, 0.0, 1.0, 1.0]

    Source: Modelica.Blocks.Logical.FallingEdge and Modelica.Blocks.MathBoolean.FallingEdge.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(~true(self.u) & self.before())


class Change(PartialPrevious):
    """True at the events at which the input changes, ``y = change(u)``.

    >>> model = assemble("pulse.y - edge.u", "edge.y - count.trigger", "one.y - count.u", one=IntegerConstant(),
    ...                  pulse=BooleanPulse(period=0.4, startTime=0.1), edge=Change(),
    ...                  count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.0, 0.2, 0.4, 0.6])["count.y"]
    [0.0, 1.0, 2.0, 3.0]

    Source: Modelica.Blocks.Logical.Change and Modelica.Blocks.MathBoolean.ChangingEdge.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        now, before = true(self.u), self.before()
        yield self.y == boolean((now & ~before) | (before & ~now))


BooleanChange = Change


class IntegerChange(Component):
    """True at the events at which the integer changes, ``y = change(u)``.

    >>> model = assemble("steps.y - edge.u", "edge.y - count.trigger", "one.y - count.u", one=IntegerConstant(),
    ...                  steps=IntegerTable(table=[[0, 1], [0.2, 5], [0.6, -2]]), edge=IntegerChange(),
    ...                  count=math_integer.TriggeredAdd())
    >>> run(model, at=[0.0, 0.4, 0.8])["count.y"]
    [0.0, 1.0, 2.0]

    Source: Modelica.Blocks.Math.IntegerChange.
    """

    u: Input = Input(doc="integer")
    held: Discrete = Discrete(doc="the integer")
    y: Discrete = Discrete(doc="true at changes")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.held == self.u
        yield self.y == boolean(change(self.held) & ~initial())


class And(PartialBooleanSI2SO):
    """``y = u1 and u2``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=And())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 0.0, 1.0]

    Source: Modelica.Blocks.Logical.And.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u1) & true(self.u2))


class Or(PartialBooleanSI2SO):
    """``y = u1 or u2``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Or())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 1.0]

    Source: Modelica.Blocks.Logical.Or.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == boolean(true(self.u1) | true(self.u2))


class Xor(PartialBooleanSI2SO):
    """``y = u1 or u2, but not both``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Xor())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.Xor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        one, two = true(self.u1), true(self.u2)
        yield self.y == boolean((one | two) & ~(one & two))


class Nand(PartialBooleanSI2SO):
    """``y = not (u1 and u2)``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Nand())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.Nand.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u1) & true(self.u2), 0.0, 1.0)


class Nor(PartialBooleanSI2SO):
    """``y = not (u1 or u2)``.

    >>> model = assemble("one.y - gate.u1", "two.y - gate.u2", one=BooleanStep(startTime=0.2),
    ...                  two=BooleanStep(startTime=0.6), gate=Nor())
    >>> run(model, at=[0.1, 0.4, 0.8])["gate.y"]
    [1.0, 0.0, 0.0]

    Source: Modelica.Blocks.Logical.Nor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(true(self.u1) | true(self.u2), 0.0, 1.0)


class RSFlipFlop(Component):
    """Flip-flop of two Nor gates: `Q` is set by `S` and reset by `R`; `QI` is the opposite unless both are true.

    `Qini` is the state before the start.

    >>> model = assemble("on.y - flip.S", "off.y - flip.R", on=BooleanTable(table=[0.2, 0.3]),
    ...                  off=BooleanTable(table=[0.6, 0.7]), flip=RSFlipFlop())
    >>> run(model, at=[0.1, 0.4, 0.8])["flip.Q"]
    [0.0, 1.0, 0.0]

    Source: Modelica.Blocks.Logical.RSFlipFlop.
    """

    Qini: bool = False
    S: Input = Input(doc="boolean that sets")
    R: Input = Input(doc="boolean that resets")
    Q: Discrete = Discrete(doc="state")
    QI: Discrete = Discrete(doc="opposite of the state")

    @property
    def reset_before(self) -> bool:
        """Whether the flip-flop was reset before the start."""
        return not self.Qini

    nor: Nor = Nor()
    nor1: Nor = Nor()
    pre: Pre = Pre(pre_u_start=structural("reset_before"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.S, self.nor.u1)
        yield connect(self.R, self.nor1.u2)
        yield connect(self.nor.y, self.pre.u)
        yield connect(self.pre.y, self.nor1.u1, self.QI)
        yield connect(self.nor1.y, self.nor.u2, self.Q)


class Switch(Component):
    """One of two signals, ``y = u1`` where ``u2 >= threshold`` (true, for a boolean 0 or 1), else ``u3``.

    >>> model = assemble("one.y - switch.u1", "ramp.y - switch.u2 - switch.u3", one=Constant(k=1.0), ramp=Slope(),
    ...                  switch=Switch())
    >>> run(model, at=[0.0, 0.25, 1.0])["switch.y"]
    [0.0, 0.25, 1.0]

    Source: Modelica.Blocks.Logical.Switch with a Modelica.Blocks.Logical.GreaterEqualThreshold.
    """

    u1: Input = Input(doc="signal above the threshold")
    u2: Input = Input(doc="signal that decides")
    u3: Input = Input(doc="signal below the threshold")
    y: Output = Output(doc="chosen signal")
    threshold: Parameter = Parameter(0.5, doc="threshold of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.u2 >= self.threshold, self.u1, self.u3)


class LogicalSwitch(Component):
    """One of two booleans, ``y = u1`` where `u2` is true, else ``u3``.

    >>> model = assemble("one.y - switch.u1", "step.y - switch.u2", "none.y - switch.u3", one=BooleanConstant(k=True),
    ...                  none=BooleanConstant(k=False), step=BooleanStep(startTime=0.5), switch=LogicalSwitch())
    >>> run(model, at=[0.4, 0.6])["switch.y"]
    [0.0, 1.0]

    Source: Modelica.Blocks.Logical.LogicalSwitch.
    """

    u1: Input = Input(doc="boolean where u2 is true")
    u2: Input = Input(doc="boolean that decides")
    u3: Input = Input(doc="boolean where u2 is false")
    y: Discrete = Discrete(doc="chosen boolean")

    def equations(self) -> Equations:
        yield from super().equations()
        chosen = (true(self.u2) & true(self.u1)) | (~true(self.u2) & true(self.u3))
        yield self.y == boolean(chosen)
