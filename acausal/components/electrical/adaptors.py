"""Pairs of pins as signals, for units that exchange signals only."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Variable, der

from ..adaptors import differentiated
from .interfaces import Pin


class PartialAdaptor(Component, partial=True):
    """Two pins, ``v = pin_p.v - pin_n.v``, ``i = pin_p.i = -pin_n.i``, whose voltage and current are signals.

    Source: the common part of Modelica.Electrical.Analog.Basic.GeneralCurrentToVoltageAdaptor and its opposite.
    """

    use_pder: bool = True
    use_fder: bool = True
    pin_p: Pin = Pin()
    pin_n: Pin = Pin()
    v: Variable = Variable(unit="V", doc="voltage from pin_p to pin_n")
    i: Variable = Variable(unit="A", doc="current from pin_p to pin_n")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.pin_p.v - self.pin_n.v
        yield self.i == self.pin_p.i
        yield self.pin_p.i + self.pin_n.i == 0


class GeneralCurrentToVoltageAdaptor(PartialAdaptor):
    """The current `f` and its derivative `fder` are given; the answer is the voltage `p` and its derivative `pder`.

    ``i = f``, ``p = v``. Without `use_fder` and `use_pder` there are no derivatives.

    >>> model = assemble("size.y - answer.f", "slope.y - answer.fder", "c.p - answer.pin_p",
    ...                  "c.n - answer.pin_n - ground.p", size=blocks.Constant(k=-6.0), slope=blocks.Constant(k=0.0),
    ...                  c=Capacitor(C=3.0, v=start(0.0, fixed=True)), answer=GeneralCurrentToVoltageAdaptor(),
    ...                  ground=Ground())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["answer.p"], [1.0, 2.0]) and close(signals["answer.pder"], [2.0, 2.0])
    True

    Source: Modelica.Electrical.Analog.Basic.GeneralCurrentToVoltageAdaptor.
    """

    p: Output = Output(unit="V", doc="voltage")
    pder: Output = Output(unit="V/s", doc="its derivative, zero without use_pder")
    f: Input = Input(unit="A", doc="current")
    fder: Input = Input(unit="A/s", doc="its derivative, with use_fder")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p == self.v
        yield self.i == self.f
        yield self.pder == (der(self.p) if self.use_pder else 0.0)
        if self.use_fder:
            yield from differentiated(self.f, self.fder)
        else:
            yield self.fder == 0


class GeneralVoltageToCurrentAdaptor(PartialAdaptor):
    """The voltage `p` and its derivative `pder` are given; the answer is the current `f` and its derivative `fder`.

    ``v = p``, ``f = -i``: the current out of `pin_p`, which drives what is connected. Without `use_pder` and `use_fder`
    there are no derivatives.

    >>> model = assemble("source.n - one.p - answer.pin_p", "source.p - one.n - answer.pin_n - ground.p",
    ...                  "answer.p - hold.p", "answer.pder - hold.pder", "hold.f - answer.f", "hold.pin_p - two.p",
    ...                  "hold.pin_n - two.n - g.p", source=ConstantCurrent(I=12.0), ground=Ground(), g=Ground(),
    ...                  one=Capacitor(C=4.0, v=start(0.0, fixed=True)), two=Capacitor(C=2.0),
    ...                  answer=GeneralCurrentToVoltageAdaptor(use_fder=False),
    ...                  hold=GeneralVoltageToCurrentAdaptor(use_fder=False))
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["two.v"], [1.0, 2.0]) and close(signals["hold.f"], [4.0, 4.0])
    True

    Source: Modelica.Electrical.Analog.Basic.GeneralVoltageToCurrentAdaptor.
    """

    p: Input = Input(unit="V", doc="voltage")
    pder: Input = Input(unit="V/s", doc="its derivative, with use_pder")
    f: Output = Output(unit="A", doc="current")
    fder: Output = Output(unit="A/s", doc="its derivative, zero without use_fder")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.p
        yield self.f == -self.i
        yield self.fder == (der(self.f) if self.use_fder else 0.0)
        if self.use_pder:
            yield from differentiated(self.p, self.pder)
        else:
            yield self.pder == 0
