"""Transmission lines of lumped sections: distributed resistance, inductance, conductance and capacitance.

A line has `N` shunts to the reference pin `p3` and `N + 1` elements in series, the first and the last of half the size.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeVar, cast

from acausal import (
    Array,
    Component,
    Equations,
    Expr,
    Parameter,
    Variable,
    Vector,
    conditional,
    connect,
    der,
    structural,
)

from .. import thermal
from .interfaces import ConditionalHeatPort, OnePort, Pin

E = TypeVar("E", bound=OnePort)


class SeriesResistance(ConditionalHeatPort, OnePort):
    """Resistance of `share` of one of `N` sections, ``v = share r length/N (1 + alpha (T - T_ref)) i``.

    Source: the resistors of Modelica.Electrical.Analog.Lines.ULine.
    """

    N: int = 1
    share: Parameter = Parameter(1.0, unit="1", doc="part of a section that the element stands for")
    r: Parameter = Parameter(1.0, unit="ohm/m", doc="resistance per length")
    length: Parameter = Parameter(1.0, unit="m", doc="length of the line")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")

    def part(self, per_length: Expr) -> Expr:
        """What a quantity per length amounts to in the element."""
        return self.share * per_length * self.length / self.N

    def induced(self) -> Expr | float:
        """Voltage of the inductance [V]."""
        return 0.0

    def equations(self) -> Equations:
        yield from super().equations()
        ohmic = self.part(self.r) * (1 + self.alpha * (self.temperature - self.T_ref)) * self.i
        yield self.v == ohmic + self.induced()
        yield self.LossPower == ohmic * self.i


class SeriesImpedance(SeriesResistance):
    """Resistance and inductance in series, ``v = share length/N (r (1 + alpha (T - T_ref)) i + l di/dt)``.

    Source: the resistors and inductors of Modelica.Electrical.Analog.Lines.OLine.
    """

    l: Parameter = Parameter(1.0, unit="H/m", doc="inductance per length")  # noqa: E741
    i: Variable = Variable(unit="A", start=0.0, doc="current from p to n through the component")

    def induced(self) -> Expr:
        """Voltage of the inductance [V]."""
        return self.part(self.l) * der(self.i)


class ShuntCapacitance(OnePort):
    """Capacitance of one of `N` sections, ``i = c length/N dv/dt``.

    Source: the capacitors of Modelica.Electrical.Analog.Lines.ULine.
    """

    N: int = 1
    c: Parameter = Parameter(1.0, unit="F/m", doc="capacitance per length")
    length: Parameter = Parameter(1.0, unit="m", doc="length of the line")
    v: Variable = Variable(unit="V", start=0.0, doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == self.c * self.length / self.N * der(self.v)


class ShuntAdmittance(ConditionalHeatPort, OnePort):
    """Conductance and capacitance side by side, ``i = length/N (g v/(1 + alpha (T - T_ref)) + c dv/dt)``.

    Source: the conductors and capacitors of Modelica.Electrical.Analog.Lines.OLine.
    """

    N: int = 1
    c: Parameter = Parameter(1.0, unit="F/m", doc="capacitance per length")
    g: Parameter = Parameter(1.0, unit="S/m", doc="conductance per length")
    length: Parameter = Parameter(1.0, unit="m", doc="length of the line")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    v: Variable = Variable(unit="V", start=0.0, doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        leak = self.g * self.length / self.N / (1 + self.alpha * (self.temperature - self.T_ref)) * self.v
        yield self.i == leak + self.c * self.length / self.N * der(self.v)
        yield self.LossPower == leak * self.v


class PartialLine(Component, partial=True):
    """A line from `p1` to `p2` with the reference `p3`; subclasses choose its elements.

    ``v[k]`` is the voltage of shunt k against `p3`, ``i[k]`` the current of the element before it, the last one's that
    into `p2`.

    Source: the common part of Modelica.Electrical.Analog.Lines.OLine and ULine.
    """

    N: int = 1
    useHeatPort: bool = False
    p1: Pin = Pin()
    p2: Pin = Pin()
    p3: Pin = Pin()
    heatPort: thermal.HeatPort = conditional(thermal.HeatPort(), "useHeatPort")
    length: Parameter = Parameter(1.0, unit="m", min=0.0, doc="length of the line")
    r: Parameter = Parameter(1.0, unit="ohm/m", min=0.0, doc="resistance per length")
    c: Parameter = Parameter(1.0, unit="F/m", min=0.0, doc="capacitance per length")
    T: Parameter = Parameter(293.15, unit="K", doc="temperature of the line without a heat port")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    first: SeriesResistance = SeriesResistance()
    between: Array[SeriesResistance] = Array(SeriesResistance(), "n_between")
    last: SeriesResistance = SeriesResistance()
    shunts: Array[OnePort] = Array(ShuntCapacitance(), "N")
    v13: Variable = Variable(unit="V", doc="voltage of p1 against p3")
    v23: Variable = Variable(unit="V", doc="voltage of p2 against p3")
    i1: Variable = Variable(unit="A", doc="current into p1")
    i2: Variable = Variable(unit="A", doc="current into p2")
    v: Vector = Vector(Variable(unit="V", doc="voltages of the shunts"), size="N")
    i: Vector = Vector(Variable(unit="A", doc="currents of the elements in series"), size="n_series")

    @property
    def n_between(self) -> int:
        """Number of elements in series that have the full size."""
        return self.N - 1

    @property
    def n_series(self) -> int:
        """Number of elements in series."""
        return self.N + 1

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v13 == self.p1.v - self.p3.v
        yield self.v23 == self.p2.v - self.p3.v
        yield self.i1 == self.p1.i
        yield self.i2 == self.p2.i
        yield connect(self.p1, self.first.p)
        yield connect(self.first.n, self.shunts[0].p)
        if self.n_between:
            yield connect(self.shunts[:-1].p, self.between[:].p)
            yield connect(self.between[:].n, self.shunts[1:].p)
        yield connect(self.shunts[-1].p, self.last.p)
        yield connect(self.last.n, self.p2)
        yield connect(self.p3, *(shunt.n for shunt in self.shunts))
        series = [self.first, *self.between, self.last]
        for k, element in enumerate(series):
            yield self.i[k] == element.i
        for k, shunt in enumerate(self.shunts):
            yield self.v[k] == shunt.v
        if self.useHeatPort:
            yield connect(self.heatPort, *(element.heatPort for element in (*series, *self.heated())))

    def heated(self) -> Sequence[ConditionalHeatPort]:
        """The shunts that lose heat."""
        return []


def _element(kind: Callable[..., E], **own: Any) -> E:
    """An element of a line: with the line's number of sections and length, and what it has `own`."""
    return kind(N=structural("N"), length=PartialLine.length, **own)


def _heated(kind: Callable[..., E], **own: Any) -> E:
    """An element that has the line's temperature, or its heat port."""
    return _element(kind, T=PartialLine.T, T_ref=PartialLine.T_ref, useHeatPort=structural("useHeatPort"), **own)


class ULine(PartialLine):
    """Lossy line of resistance and capacitance (RC line), `N` sections.

    >>> model = assemble("source.p - line.p1", "line.p2 - load.p", "source.n - line.p3 - load.n - ground.p",
    ...                  source=ConstantVoltage(V=2.0), line=ULine(N=4, r=3.0, c=1e-3, length=2.0),
    ...                  load=Resistor(R=2.0), ground=Ground())
    >>> close(run(model)["load.v"][-1], 2.0 * 2.0 / (2.0 + 3.0 * 2.0))
    True

    Source: Modelica.Electrical.Analog.Lines.ULine.
    """

    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    first: SeriesResistance = _heated(SeriesResistance, r=PartialLine.r, alpha=alpha, share=0.5)
    between: Array[SeriesResistance] = Array(_heated(SeriesResistance, r=PartialLine.r, alpha=alpha), "n_between")
    last: SeriesResistance = _heated(SeriesResistance, r=PartialLine.r, alpha=alpha, share=0.5)
    shunts: Array[OnePort] = Array(_element(ShuntCapacitance, c=PartialLine.c), "N")


class OLine(PartialLine):
    """Lossy line of resistance, inductance, conductance and capacitance (RLGC line), `N` sections.

    >>> model = assemble("source.p - line.p1", "line.p2 - load.p", "source.n - line.p3 - load.n - ground.p",
    ...                  line=OLine(N=20, r=1e-3, l=2.5e-7, g=1e-9, c=1e-10, length=100.0), load=Resistor(R=50.0),
    ...                  source=StepVoltage(V=2.0, startTime=1e-7), ground=Ground())
    >>> passed = run(model, at=[4e-7, 9e-7])  # the wave takes 0.5 us
    >>> abs(passed["load.v"][0]) < 1e-2 and abs(passed["load.v"][1] - 2.0) < 0.3
    True

    Source: Modelica.Electrical.Analog.Lines.OLine.
    """

    l: Parameter = Parameter(1.0, unit="H/m", min=0.0, doc="inductance per length")  # noqa: E741
    g: Parameter = Parameter(1.0, unit="S/m", min=0.0, doc="conductance per length")
    alpha_R: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    alpha_G: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the conductance")
    first: SeriesResistance = _heated(SeriesImpedance, r=PartialLine.r, l=l, alpha=alpha_R, share=0.5)
    between: Array[SeriesResistance] = Array(
        _heated(SeriesImpedance, r=PartialLine.r, l=l, alpha=alpha_R), "n_between"
    )  # fmt: skip
    last: SeriesResistance = _heated(SeriesImpedance, r=PartialLine.r, l=l, alpha=alpha_R, share=0.5)
    shunts: Array[OnePort] = Array(_heated(ShuntAdmittance, c=PartialLine.c, g=g, alpha=alpha_G), "N")

    def heated(self) -> Sequence[ConditionalHeatPort]:
        """The shunts that lose heat."""
        return cast("list[ShuntAdmittance]", list(self.shunts))
