"""Ideal switches, opened and closed by signals and by potentials."""

from __future__ import annotations

from acausal import Equations, Expr, Input, Parameter, Variable, where

from .interfaces import ConditionalHeatPort, OnePort, Pin


class PartialIdealSwitch(ConditionalHeatPort, OnePort, partial=True):
    """Switch of resistance `Ron` while closed and conductance `Goff` while open.

    Source: Modelica.Electrical.Analog.Interfaces.IdealSwitch.
    """

    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance of the open switch")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s as a voltage")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s as a current")
    s: Variable = Variable(start=0.0, doc="curve parameter")

    def switched(self, off: Expr) -> Equations:
        """Equations of the switch, which is open where `off` holds."""
        yield self.v == self.s * where(off, self.unitVoltage, self.Ron * self.unitCurrent)
        yield self.i == self.s * where(off, self.Goff * self.unitVoltage, self.unitCurrent)
        yield self.LossPower == self.v * self.i


class IdealClosingSwitch(PartialIdealSwitch):
    """Switch that a signal closes: ``control`` true (1), closed; false (0), open.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - ground.p",
    ...                  "hand.y - switch.control", switch=IdealClosingSwitch(), hand=blocks.Step(startTime=0.5),
    ...                  source=ConstantVoltage(V=10.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealClosingSwitch.
    """

    control: Input = Input(doc="whether it is closed, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control <= 0.5)


class IdealOpeningSwitch(PartialIdealSwitch):
    """Switch that a signal opens: ``control`` true (1), open; false (0), closed.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - ground.p",
    ...                  "hand.y - switch.control", switch=IdealOpeningSwitch(), hand=blocks.Step(startTime=0.5),
    ...                  source=ConstantVoltage(V=10.0), load=Resistor(R=5.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [2.0, 0.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealOpeningSwitch.
    """

    control: Input = Input(doc="whether it is open, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class ControlledIdealClosingSwitch(PartialIdealSwitch):
    """Switch that a potential closes: closed where ``control.v > level``.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - hand.n - ground.p",
    ...                  "hand.p - switch.control", switch=ControlledIdealClosingSwitch(), load=Resistor(R=5.0),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [0.0, 2.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealClosingSwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v < self.level)


class ControlledIdealOpeningSwitch(PartialIdealSwitch):
    """Switch that a potential opens: open where ``control.v > level``.

    >>> model = assemble("source.p - switch.p", "switch.n - load.p", "source.n - load.n - hand.n - ground.p",
    ...                  "hand.p - switch.control", switch=ControlledIdealOpeningSwitch(), load=Resistor(R=5.0),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), ground=Ground())
    >>> close(run(model, at=[0.2, 0.7])["load.i"], [2.0, 0.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealOpeningSwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)


class PartialTwoWaySwitch(ConditionalHeatPort, partial=True):
    """Switch from `p` to `n2` or to `n1`, of resistance `Ron` where closed and conductance `Goff` where open.

    Source: Modelica.Electrical.Analog.Ideal.IdealTwoWaySwitch.
    """

    p: Pin = Pin()
    n1: Pin = Pin()
    n2: Pin = Pin()
    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance of the open switch")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s1 and s2 as voltages")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s1 and s2 as currents")
    s1: Variable = Variable(start=0.0, doc="curve parameter of the way to n1")
    s2: Variable = Variable(start=0.0, doc="curve parameter of the way to n2")

    def switched(self, second: Expr) -> Equations:
        """Equations of the switch, which leads to `n2` where `second` holds, else to `n1`."""
        closed, opened = self.Ron * self.unitCurrent, self.Goff * self.unitVoltage
        yield self.p.i + self.n1.i + self.n2.i == 0
        yield self.p.v - self.n1.v == self.s1 * where(second, self.unitVoltage, closed)
        yield self.n1.i == -self.s1 * where(second, opened, self.unitCurrent)
        yield self.p.v - self.n2.v == self.s2 * where(second, closed, self.unitVoltage)
        yield self.n2.i == -self.s2 * where(second, self.unitCurrent, opened)
        yield self.LossPower == self.p.i * self.p.v + self.n1.i * self.n1.v + self.n2.i * self.n2.v


class IdealTwoWaySwitch(PartialTwoWaySwitch):
    """Switch from `p` to `n2` where `control` is true (1), else to `n1`.

    >>> model = assemble("source.p - switch.p", "switch.n1 - one.p", "switch.n2 - two.p", "hand.y - switch.control",
    ...                  "source.n - one.n - two.n - ground.p", switch=IdealTwoWaySwitch(), ground=Ground(),
    ...                  hand=blocks.Step(startTime=0.5), source=ConstantVoltage(V=10.0), one=Resistor(R=5.0),
    ...                  two=Resistor(R=2.0))
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [2.0, 0.0], 1e-4) and close(ways["two.i"], [0.0, 5.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealTwoWaySwitch.
    """

    control: Input = Input(doc="whether it leads to n2, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class ControlledIdealTwoWaySwitch(PartialTwoWaySwitch):
    """Switch from `p` to `n2` where ``control.v > level``, else to `n1`.

    >>> model = assemble("source.p - switch.p", "switch.n1 - one.p", "switch.n2 - two.p", "hand.p - switch.control",
    ...                  "source.n - one.n - two.n - hand.n - ground.p", switch=ControlledIdealTwoWaySwitch(),
    ...                  hand=StepVoltage(startTime=0.5), source=ConstantVoltage(V=10.0), one=Resistor(R=5.0),
    ...                  two=Resistor(R=2.0), ground=Ground())
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [2.0, 0.0], 1e-4) and close(ways["two.i"], [0.0, 5.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealTwoWaySwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)


class PartialIntermediateSwitch(ConditionalHeatPort, partial=True):
    """Switch that leads straight, `p1` to `n1` and `p2` to `n2`, or crosswise, `p1` to `n2` and `p2` to `n1`.

    Each of the four ways has the resistance `Ron` where closed and the conductance `Goff` where open.

    Source: Modelica.Electrical.Analog.Ideal.IdealIntermediateSwitch.
    """

    p1: Pin = Pin()
    p2: Pin = Pin()
    n1: Pin = Pin()
    n2: Pin = Pin()
    Ron: Parameter = Parameter(1e-5, unit="ohm", min=0.0, doc="resistance of the closed switch")
    Goff: Parameter = Parameter(1e-5, unit="S", min=0.0, doc="conductance of the open switch")
    unitVoltage: Parameter = Parameter(1.0, unit="V", doc="scale of s1 to s4 as voltages")
    unitCurrent: Parameter = Parameter(1.0, unit="A", doc="scale of s1 to s4 as currents")
    s1: Variable = Variable(start=0.0, doc="curve parameter of the way from p1 to n1")
    s2: Variable = Variable(start=0.0, doc="curve parameter of the way from p2 to n2")
    s3: Variable = Variable(start=0.0, doc="curve parameter of the way from p1 to n2")
    s4: Variable = Variable(start=0.0, doc="curve parameter of the way from p2 to n1")

    def switched(self, crosswise: Expr) -> Equations:
        """Equations of the switch, which leads crosswise where that holds, else straight."""
        closed, opened = self.Ron * self.unitCurrent, self.Goff * self.unitVoltage
        straight_v, cross_v = where(crosswise, self.unitVoltage, closed), where(crosswise, closed, self.unitVoltage)
        straight_i, cross_i = where(crosswise, opened, self.unitCurrent), where(crosswise, self.unitCurrent, opened)
        yield self.p1.v - self.n1.v == self.s1 * straight_v
        yield self.p2.v - self.n2.v == self.s2 * straight_v
        yield self.p1.v - self.n2.v == self.s3 * cross_v
        yield self.p2.v - self.n1.v == self.s4 * cross_v
        yield self.p1.i == self.s1 * straight_i + self.s3 * cross_i
        yield self.p2.i == self.s2 * straight_i + self.s4 * cross_i
        yield -self.n1.i == self.s1 * straight_i + self.s4 * cross_i
        yield -self.n2.i == self.s2 * straight_i + self.s3 * cross_i
        pins = (self.p1, self.p2, self.n1, self.n2)
        yield self.LossPower == sum((pin.i * pin.v for pin in pins[1:]), pins[0].i * pins[0].v)


class IdealIntermediateSwitch(PartialIntermediateSwitch):
    """Switch that leads crosswise, `p1` to `n2` and `p2` to `n1`, where `control` is true (1), else straight.

    >>> model = assemble("source.p - switch.p1", "other.p - switch.p2", "switch.n1 - one.p", "switch.n2 - two.p",
    ...                  "source.n - other.n - one.n - two.n - ground.p", "hand.y - switch.control",
    ...                  switch=IdealIntermediateSwitch(), hand=blocks.Step(startTime=0.5), ground=Ground(),
    ...                  source=ConstantVoltage(V=10.0), other=ConstantVoltage(V=-4.0), one=Resistor(R=1.0),
    ...                  two=Resistor(R=1.0))
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [10.0, -4.0], 1e-4) and close(ways["two.i"], [-4.0, 10.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealIntermediateSwitch.
    """

    control: Input = Input(doc="whether it leads crosswise, 1 or 0")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.switched(self.control > 0.5)


class ControlledIdealIntermediateSwitch(PartialIntermediateSwitch):
    """Switch that leads crosswise, `p1` to `n2` and `p2` to `n1`, where ``control.v > level``, else straight.

    >>> model = assemble("source.p - switch.p1", "other.p - switch.p2", "switch.n1 - one.p", "switch.n2 - two.p",
    ...                  "source.n - other.n - one.n - two.n - hand.n - ground.p", "hand.p - switch.control",
    ...                  switch=ControlledIdealIntermediateSwitch(), hand=StepVoltage(startTime=0.5), ground=Ground(),
    ...                  source=ConstantVoltage(V=10.0), other=ConstantVoltage(V=-4.0), one=Resistor(R=1.0),
    ...                  two=Resistor(R=1.0))
    >>> ways = run(model, at=[0.2, 0.7])
    >>> close(ways["one.i"], [10.0, -4.0], 1e-4) and close(ways["two.i"], [-4.0, 10.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Ideal.ControlledIdealIntermediateSwitch.
    """

    level: Parameter = Parameter(0.5, unit="V", doc="potential of the change-over")
    control: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.control.i == 0
        yield from self.switched(self.control.v > self.level)
