"""The two-bit adding unit of the IVP test set: 39 MOS transistors, most of them in ten gates, index 1.

Each transistor (model of Shichman and Hodges) keeps charges between gate, channel and bulk, which are the states. The
pulses at the inputs step through all 32 sums of two numbers of two bits and a carry.

Source: Test Set for IVP Solvers, release 2.4, problem `tba`, model and reference solution (RADAU5). Its units are its
own: time is scaled by 1e4, and resistances by a further 5.
"""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Expr, Parameter, Variable, connect, der, exp, noevent, sqrt, where
from acausal.components.electrical import Capacitor, ConstantVoltage, Ground, Pin, TrapezoidVoltage

TIME, STIFF, HIGH = 1e4, 5.0, 5.0
T1 = 320.0


class Transistor(Component):
    """MOS transistor with its pins, and the potentials `s`, `d`, `bs`, `bd` at the ends of its channel."""

    V_T0: Parameter = Parameter(0.2, unit="V")
    gamma: Parameter = Parameter(0.035, unit="V0.5")
    phi: Parameter = Parameter(1.01, unit="V")
    beta: Parameter = Parameter(4 * 43.7e-6, unit="A/V2")
    delta: Parameter = Parameter(0.02, unit="1/V")
    V_T: Parameter = Parameter(25.85, unit="V")
    phi_B: Parameter = Parameter(0.87, unit="V")
    V_BB: Parameter = Parameter(-2.5, unit="V")
    I_S: Parameter = Parameter(1e-15 * TIME * STIFF, unit="A")
    R_S: Parameter = Parameter(40.0 / (TIME * STIFF), unit="Ohm")
    R_B: Parameter = Parameter(100.0 / (TIME * STIFF), unit="Ohm")
    C_G: Parameter = Parameter(0.6e-4 * TIME, unit="F")
    C_B: Parameter = Parameter(2.4e-5 * TIME, unit="F")
    D: Pin = Pin()
    G: Pin = Pin()
    S: Pin = Pin()
    s: Variable = Variable(unit="V")
    d: Variable = Variable(unit="V")
    bs: Variable = Variable(unit="V")
    bd: Variable = Variable(unit="V")
    q_s: Variable = Variable(unit="C")
    q_d: Variable = Variable(unit="C")
    q_bs: Variable = Variable(unit="C")
    q_bd: Variable = Variable(unit="C")
    i: Variable = Variable(unit="A", doc="Current of the channel, from drain to source")

    def diode(self, v: Expr) -> Expr:
        """Current from bulk to channel."""
        return noevent(where(v <= 0, -self.I_S * (exp(v / self.V_T) - 1), 0.0))

    def charge(self, v: Expr) -> Expr:
        """Charge of the depletion layer."""
        blocked = 1 / sqrt(1 - ac.min(v, 0.0) / self.phi_B)
        return noevent(self.C_B * v * where(v <= 0, blocked, 1 + v / (2 * self.phi_B)))

    def channel(self) -> Expr:
        """Current of the channel: whichever end has the lower potential is the source."""
        v = self.d - self.s
        gate = self.G.v - where(v > 0, self.s, self.d)
        bulk = where(v > 0, self.bs - self.S.v, self.bd - self.D.v)
        over = gate - self.V_T0 - self.gamma * (sqrt(self.phi - bulk) - sqrt(self.phi))
        size = ac.abs(v)
        shape = where(over <= 0, 0.0, where(over <= size, over**2, size * (2 * over - size)))
        return noevent(where(v > 0, 1.0, -1.0) * self.beta * TIME * STIFF * shape * (1 + self.delta * size))

    def equations(self) -> Equations:
        i_s, i_d = (self.S.v - self.s) / self.R_S, (self.D.v - self.d) / self.R_S
        diode_s, diode_d = self.diode(self.bs - self.S.v), self.diode(self.bd - self.D.v)
        yield self.i == self.channel()
        yield self.q_s == self.C_G * (self.s - self.G.v)
        yield self.q_d == self.C_G * (self.d - self.G.v)
        yield self.q_bs == self.charge(self.bs - self.S.v)
        yield self.q_bd == self.charge(self.bd - self.D.v)
        yield der(self.q_s) == i_s + self.i
        yield der(self.q_d) == i_d - self.i
        yield der(self.q_bs) == (self.V_BB - self.bs) / self.R_B + diode_s
        yield der(self.q_bd) == (self.V_BB - self.bd) / self.R_B + diode_d
        yield self.G.i == -der(self.q_s) - der(self.q_d)
        yield self.S.i == i_s + diode_s - der(self.q_bs)
        yield self.D.i == i_d + diode_d - der(self.q_bd)


def switch(width: int = 1) -> Transistor:
    """Of the enhancement type; a path through two of them needs twice the width."""
    return Transistor(beta=4 * width * 43.7e-6)


class Gate(Component, partial=True):
    """Pulled up by a transistor of the depletion type; subclasses pull `out` down."""

    high: Pin = Pin()
    ground: Pin = Pin()
    out: Pin = Pin()
    a: Pin = Pin()
    b: Pin = Pin()
    load: Transistor = Transistor(V_T0=-2.43, gamma=0.2, phi=1.28, beta=53.5e-6)

    def equations(self) -> Equations:
        yield connect(self.high, self.load.D)
        yield connect(self.load.G, self.load.S, self.out)


class Nor(Gate):
    """not (a or b)"""

    first: Transistor = switch()
    second: Transistor = switch()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.a, self.first.G)
        yield connect(self.b, self.second.G)
        yield connect(self.out, self.first.D, self.second.D)
        yield connect(self.ground, self.first.S, self.second.S)


class Nand(Gate):
    """not (a and b)"""

    first: Transistor = switch(2)
    second: Transistor = switch(2)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.a, self.first.G)
        yield connect(self.b, self.second.G)
        yield connect(self.out, self.first.D)
        yield connect(self.first.S, self.second.D)
        yield connect(self.ground, self.second.S)


class AndOrInvert(Gate):
    """not (a or (b and c))"""

    c: Pin = Pin()
    first: Transistor = switch()
    second: Transistor = switch(2)
    third: Transistor = switch(2)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.a, self.first.G)
        yield connect(self.b, self.second.G)
        yield connect(self.c, self.third.G)
        yield connect(self.out, self.first.D, self.second.D)
        yield connect(self.second.S, self.third.D)
        yield connect(self.ground, self.first.S, self.third.S)


class OrAndInvert(Gate):
    """not (a and (b or c))"""

    c: Pin = Pin()
    first: Transistor = switch(2)
    second: Transistor = switch(2)
    third: Transistor = switch(2)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.a, self.first.G)
        yield connect(self.b, self.second.G)
        yield connect(self.c, self.third.G)
        yield connect(self.out, self.first.D)
        yield connect(self.first.S, self.second.D, self.third.D)
        yield connect(self.ground, self.second.S, self.third.S)


def pulse(delay: float, width: float, period: float) -> TrapezoidVoltage:
    return TrapezoidVoltage(V=HIGH, rising=5.0, width=width, falling=5.0, period=period, startTime=delay)


class Adder(Component):
    """Sum of `a0 + 2 a1`, `b0 + 2 b1` and a carry; the numbers come inverted, the carry does not."""

    supply: ConstantVoltage = ConstantVoltage(V=HIGH)
    ground: Ground = Ground()
    not_a0: TrapezoidVoltage = pulse(0.0, 5.0, 20.0)
    not_b0: TrapezoidVoltage = pulse(10.0, 15.0, 40.0)
    not_a1: TrapezoidVoltage = pulse(30.0, 35.0, 80.0)
    not_b1: TrapezoidVoltage = pulse(70.0, 75.0, 160.0)
    carry: TrapezoidVoltage = pulse(150.0, 155.0, 320.0)
    nor_0: Nor = Nor()
    aoi_0: AndOrInvert = AndOrInvert()
    nor_s: Nor = Nor()
    aoi_s: AndOrInvert = AndOrInvert()
    aoi_c: AndOrInvert = AndOrInvert()
    nor_1: Nor = Nor()
    aoi_1: AndOrInvert = AndOrInvert()
    nand: Nand = Nand()
    oai: OrAndInvert = OrAndInvert()
    aoi_out: AndOrInvert = AndOrInvert()
    t1: Transistor = switch(3)
    t2: Transistor = switch(3)
    t3: Transistor = switch(3)
    c_0: Capacitor = Capacitor(C=2.0)
    c_1: Capacitor = Capacitor(C=2.0)
    c_2: Capacitor = Capacitor(C=2.0)

    def equations(self) -> Equations:
        sources = (self.not_a0, self.not_b0, self.not_a1, self.not_b1, self.carry)
        first, second = (self.nor_0, self.aoi_0, self.nor_1, self.aoi_1), (self.nor_s, self.aoi_s, self.aoi_c)
        gates = (*first, *second, self.nand, self.oai, self.aoi_out)
        loads = (self.c_0, self.c_1, self.c_2)
        grounded = (self.supply.n, self.t3.S, *(part.n for part in (*sources, *loads)))
        yield connect(self.supply.p, *(gate.high for gate in gates))
        yield connect(self.ground.p, *grounded, *(gate.ground for gate in gates))
        yield connect(self.not_a0.p, self.nor_0.a, self.aoi_0.c)
        yield connect(self.not_b0.p, self.nor_0.b, self.aoi_0.b)
        yield connect(self.not_a1.p, self.nor_1.a, self.aoi_1.c)
        yield connect(self.not_b1.p, self.nor_1.b, self.aoi_1.b)
        yield connect(self.carry.p, self.nor_s.b, self.aoi_s.b, self.aoi_c.b, self.t3.G)
        yield connect(self.nor_0.out, self.aoi_0.a, self.aoi_c.a, self.aoi_out.b)
        yield connect(self.aoi_0.out, self.nor_s.a, self.aoi_s.c, self.aoi_c.c, self.t2.G)
        yield connect(self.nor_s.out, self.aoi_s.a)
        yield connect(self.aoi_s.out, self.c_0.p)
        yield connect(self.aoi_c.out, self.nand.a, self.oai.b)
        yield connect(self.nor_1.out, self.aoi_1.a, self.aoi_out.a)
        yield connect(self.aoi_1.out, self.nand.b, self.oai.c, self.aoi_out.c, self.t1.G)
        yield connect(self.nand.out, self.oai.a)
        yield connect(self.oai.out, self.c_1.p)
        yield connect(self.aoi_out.out, self.c_2.p, self.t1.D)
        yield connect(self.t1.S, self.t2.D)
        yield connect(self.t2.S, self.t3.D)


BITS = ("not_a0", "not_b0", "not_a1", "not_b1", "carry")
SUM = {"aoi_s.out.v": "c_0.v", "oai.out.v": "c_1.v", "aoi_out.out.v": "c_2.v"}
"""Potentials of the sum, lowest bit first and its highest inverted, and the capacitors that hold them."""
_LINES = (Path(__file__).parent / "two_bit_adder.txt").read_text(encoding="utf-8").splitlines()[1:]
TABLE = {name: (float(start), float(end)) for name, start, end in map(str.split, _LINES)}


@cache
def compiled() -> ac.System:
    """Start values of the channels' potentials and of the sum; the other nodes hold no charge."""
    held = {name: SUM.get(name, name) for name in TABLE if name in SUM or not name.endswith(".v")}
    return ac.compile(ac.modify(Adder(), {k: ac.start(TABLE[name][0], fixed=True) for name, k in held.items()}))


def test_index() -> None:
    assert compiled().report().structural_index == 1
    assert len(compiled().states) == 4 * 39 + 3


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_all_sums(engine: Any) -> None:
    """The sum where the inputs are at rest, and all potentials at the end."""
    rest = np.arange(10.0, T1 + 1, 10.0)
    solution = compiled().simulate(T1, saveat=rest, rtol=1e-6, engine=engine)
    not_a0, not_b0, not_a1, not_b1, carry = (np.rint(solution[f"{name}.p.v"] / HIGH).astype(int) for name in BITS)
    wanted = (1 - not_a0) + 2 * (1 - not_a1) + (1 - not_b0) + 2 * (1 - not_b1) + carry
    assert len({*zip(not_a0, not_b0, not_a1, not_b1, carry, strict=True)}) == 32
    low, high, not_carry = (solution[name] > HIGH / 2 for name in SUM)
    np.testing.assert_array_equal(low + 2 * high + 4 * ~not_carry, wanted)
    # solutions at rtol=1e-6 and 1e-7 are the same to 3e-7 V; the reference is 2e-5 V away from both inside of `nand`
    for name, (_, end) in TABLE.items():
        assert solution[name][-1] == pytest.approx(end, abs=1e-5 if name in SUM else 3e-5), name
