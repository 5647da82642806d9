"""Conversion between voltages and words of bits."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Component,
    Discrete,
    Equations,
    Input,
    Output,
    Parameter,
    Variable,
    Vector,
    edge,
    noevent,
    pre,
    where,
)

from .interfaces import OnePort, Pin


class AD_Converter(OnePort):
    """Analog to digital: when `trig` becomes true, ``z = round((2^N - 1) (v - VRefLow)/(VRefHigh - VRefLow))``.

    The bits of z are ``y[0]``, the least significant, to ``y[N - 1]``, 0 or 1; z is 0 below `VRefLow`, and what is
    above `VRefHigh` overflows. The input resistance is `Rin`.

    >>> model = assemble("source.p - adc.p", "source.n - adc.n - ground.p", "clock.y - adc.trig", ground=Ground(),
    ...                  source=ConstantVoltage(V=6.0), adc=AD_Converter(N=3, VRefHigh=7.0),
    ...                  clock=blocks.BooleanPulse(period=0.4, startTime=0.1))
    >>> adc = run(model, at=[0.0, 0.2])
    >>> adc["adc.z"], [adc[f"adc.y[{k}]"][-1] for k in (1, 2, 3)]
    ([0.0, 6.0], [0.0, 1.0, 1.0])

    Source: Modelica.Electrical.Analog.Ideal.AD_Converter, where the bits are values of a logic with nine.
    """

    N: int = 8
    trig: Input = Input(doc="trigger, 1 or 0")
    y: Vector = Vector(Output(doc="bits, 1 or 0"), size="N")
    VRefHigh: Parameter = Parameter(10.0, unit="V", doc="voltage of the largest number")
    VRefLow: Parameter = Parameter(0.0, unit="V", doc="voltage of zero")
    Rin: Parameter = Parameter(1e6, unit="ohm", min=0.0, doc="input resistance")
    z: Discrete = Discrete(start=0.0, doc="the number")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.Rin * self.i
        share = (self.v - self.VRefLow) / (self.VRefHigh - self.VRefLow)
        number = noevent(where(share > 0, ac.floor(share * (2**self.N - 1) + 0.5), 0.0))
        yield self.z == where(edge(self.trig > 0.5), number, pre(self.z))
        for k, bit in enumerate(self.y):
            yield bit == ac.floor(self.z / 2**k) - 2 * ac.floor(self.z / 2 ** (k + 1))


class DA_Converter(Component):
    """Digital to analog: when `trig` becomes true, ``vout = Vref sum(2^k x[k])/(2^N - 1)``.

    The bits ``x[0]``, the least significant, to ``x[N - 1]`` are 0 or 1; ``p.v - n.v = vout``.

    >>> class Converter(Component):
    ...     dac: DA_Converter = DA_Converter(N=2, Vref=6.0)
    ...     clock: blocks.BooleanPulse = blocks.BooleanPulse(period=0.4, startTime=0.1)
    ...     ground: Ground = Ground()
    ...     def equations(self):
    ...         yield connect(self.clock.y, self.dac.trig)
    ...         yield connect(self.dac.n, self.ground.p)
    ...         yield self.dac.x[0] == 0
    ...         yield self.dac.x[1] == 1
    >>> run(Converter(), at=[0.0, 0.2])["dac.vout"]
    [0.0, 4.0]

    Source: Modelica.Electrical.Analog.Ideal.DA_Converter, where the bits are values of a logic with nine.
    """

    N: int = 8
    trig: Input = Input(doc="trigger, 1 or 0")
    x: Vector = Vector(Input(doc="bits, 1 or 0"), size="N")
    p: Pin = Pin()
    n: Pin = Pin()
    Vref: Parameter = Parameter(10.0, unit="V", doc="voltage of the largest number")
    y: Discrete = Discrete(start=0.0, doc="the number")
    vout: Variable = Variable(unit="V", doc="voltage from p to n")

    def equations(self) -> Equations:
        yield from super().equations()
        bits = [where(bit > 0.5, float(2**k), 0.0) for k, bit in enumerate(self.x)]
        yield self.y == where(edge(self.trig > 0.5), sum(bits[1:], bits[0]), pre(self.y))
        yield self.vout == self.y * self.Vref / (2**self.N - 1)
        yield self.p.v - self.n.v == self.vout
        yield self.p.i + self.n.i == 0
