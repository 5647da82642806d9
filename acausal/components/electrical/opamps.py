"""Operational amplifiers, ideal, limited and detailed."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Component, Equations, Parameter, Variable, conditional, der, where

from .interfaces import Pin, TwoPort


class IdealOpAmp(TwoPort):
    """Ideal operational amplifier (nullor), ``v1 = 0``, ``i1 = 0``; whatever is needed at port 2.

    >>> model = assemble("source.p - input.p", "input.n - feedback.p - amp.n1", "feedback.n - amp.p2",
    ...                  "source.n - amp.p1 - amp.n2 - ground.p", source=ConstantVoltage(V=2.0), input=Resistor(R=1e3),
    ...                  feedback=Resistor(R=3e3), amp=IdealOpAmp(), ground=Ground())
    >>> close(run(model)["amp.v2"][-1], -6.0)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealOpAmp.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == 0
        yield self.i1 == 0


class IdealOpAmp3Pin(Component):
    """Ideal operational amplifier, ``in_p.v = in_n.v``, no input currents; whatever is needed at `out`.

    >>> model = assemble("source.p - input.p", "input.n - feedback.p - amp.in_n", "feedback.n - amp.out",
    ...                  "source.n - amp.in_p - ground.p", source=ConstantVoltage(V=2.0), input=Resistor(R=1e3),
    ...                  feedback=Resistor(R=3e3), amp=IdealOpAmp3Pin(), ground=Ground())
    >>> close(run(model)["amp.out.v"][-1], -6.0)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealOpAmp3Pin.
    """

    in_p: Pin = Pin()
    in_n: Pin = Pin()
    out: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.in_p.v == self.in_n.v
        yield self.in_p.i == 0
        yield self.in_n.i == 0


class IdealOpAmpLimited(Component):
    """Ideal operational amplifier whose output stays between the potentials of `VMin` and `VMax`.

    With a curve parameter `s`: within the limits ``vin = 0``, beyond them ``vin = s -+ 1`` and the output at its limit.

    >>> model = assemble("source.p - input.p", "input.n - feedback.p - smooth.p - amp.in_n",
    ...                  "feedback.n - smooth.n - amp.out", "source.n - amp.in_p - high.n - low.p - ground.p",
    ...                  "high.p - amp.VMax", "low.n - amp.VMin", source=RampVoltage(V=8.0, offset=-4.0, duration=1.0),
    ...                  input=Resistor(R=1e3), feedback=Resistor(R=5e3), smooth=Capacitor(C=1e-9), ground=Ground(),
    ...                  amp=IdealOpAmpLimited(), high=ConstantVoltage(V=15.0), low=ConstantVoltage(V=15.0))
    >>> close(run(model, at=[0.1, 0.5, 0.75, 1.0])["amp.out.v"], [15.0, 0.0, -10.0, -15.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealOpAmpLimited.
    """

    in_p: Pin = Pin()
    in_n: Pin = Pin()
    out: Pin = Pin()
    VMax: Pin = Pin()
    VMin: Pin = Pin()
    vin: Variable = Variable(unit="V", doc="input voltage")
    s: Variable = Variable(start=0.0, doc="curve parameter of the characteristic")
    volt: Parameter = Parameter(1.0, unit="V", doc="unit of the curve parameter")

    def equations(self) -> Equations:
        yield from super().equations()
        for pin in (self.in_p, self.in_n, self.VMax, self.VMin):
            yield pin.i == 0
        high, low = self.VMax.v, self.VMin.v
        within = (high - low) * self.s / 2 + (high + low) / 2
        yield self.vin == self.in_p.v - self.in_n.v
        yield self.vin == self.volt * where(self.s < -1, self.s + 1, where(self.s > 1, self.s - 1, 0.0))
        yield self.out.v == where(self.s < -1, low, where(self.s > 1, high, within))


class OpAmp(Component):
    """Operational amplifier of finite slope that saturates smoothly between `VMin` and `VMax`.

    ``out.v = (VMax.v + VMin.v)/2 + Slope vin/(1 + Slope |f vin|)`` with ``f = 2/(VMax.v - VMin.v)``.

    >>> model = assemble("source.p - amp.in_p", "source.n - amp.in_n - high.n - low.p - ground.p", "high.p - amp.VMax",
    ...                  "low.n - amp.VMin", source=ConstantVoltage(V=1e-3), amp=OpAmp(Slope=1e4), ground=Ground(),
    ...                  high=ConstantVoltage(V=15.0), low=ConstantVoltage(V=15.0))
    >>> close(run(model)["amp.out.v"][-1], 10.0 / (1 + 10.0 / 15.0))
    True

    Source: Modelica.Electrical.Analog.Basic.OpAmp.
    """

    Slope: Parameter = Parameter(1e4, unit="1", doc="slope of the characteristic at vin = 0")
    in_p: Pin = Pin()
    in_n: Pin = Pin()
    out: Pin = Pin()
    VMax: Pin = Pin()
    VMin: Pin = Pin()
    vin: Variable = Variable(unit="V", doc="input voltage")

    def equations(self) -> Equations:
        yield from super().equations()
        for pin in (self.in_p, self.in_n, self.VMax, self.VMin):
            yield pin.i == 0
        slope = ac.abs(self.Slope)
        f = 2 / (self.VMax.v - self.VMin.v)
        yield self.vin == self.in_p.v - self.in_n.v
        yield self.out.v == (self.VMax.v + self.VMin.v) / 2 + slope * self.vin / (1 + slope * ac.abs(f * self.vin))


class OpAmpLimited(Component):
    """Operational amplifier of gain `V0` between its supplies, ``v_out = clip(V0 v_in, vns, vps)``.

    With `useFirstOrder`, ``Tau dv_int/dt = V0 v_in - v_int``, which begins as `initOpAmp` says: ``"Linear"`` (``v_int =
    clip(V0 v_in, vns, vps)``), ``"UpperLimit"`` (`vps`) or ``"LowerLimit"`` (`vns`). With `useSupply` the pins `s_p`
    and `s_n` feed it with all its power; without, the supplies are `Vps` and `Vns`.

    >>> model = assemble("source.p - input.p", "input.n - feedback.p - amp.in_n", "feedback.n - amp.out",
    ...                  "source.n - amp.in_p - ground.p", input=Resistor(R=1e3), feedback=Resistor(R=5e3),
    ...                  source=RampVoltage(V=8.0, offset=-4.0, duration=1.0), ground=Ground(),
    ...                  amp=OpAmpLimited(useFirstOrder=True))
    >>> close(run(model, at=[0.0, 0.5, 0.75, 1.0])["amp.v_out"], [15.0, 0.0, -10.0, -15.0], 1e-3)
    True

    Source: Modelica.Electrical.Analog.Ideal.OpAmpLimited.
    """

    useSupply: bool = False
    useFirstOrder: bool = False
    initOpAmp: str = "Linear"
    in_p: Pin = Pin()
    in_n: Pin = Pin()
    out: Pin = Pin()
    s_p: Pin = conditional(Pin(), "useSupply")
    s_n: Pin = conditional(Pin(), "useSupply")
    V0: Parameter = Parameter(15000.0, unit="1", doc="gain without load")
    Vps: Parameter = Parameter(15.0, unit="V", doc="positive supply voltage")
    Vns: Parameter = Parameter(-15.0, unit="V", doc="negative supply voltage")
    Tau: Parameter = Parameter(1e-5, unit="s", min=1e-30, doc="time constant of the output with useFirstOrder")
    vps: Variable = Variable(unit="V", start=Vps, doc="positive supply voltage")
    vns: Variable = Variable(unit="V", start=Vns, doc="negative supply voltage")
    v_in: Variable = Variable(unit="V", start=0.0, doc="input voltage")
    v_int: Variable = Variable(unit="V", start=0.0, doc="output voltage without limits")
    v_out: Variable = Variable(unit="V", doc="output voltage against ground")
    p_in: Variable = Variable(unit="W", doc="power at the inputs")
    p_out: Variable = Variable(unit="W", doc="power at the output, negative where it is delivered")
    p_s: Variable = Variable(unit="W", doc="power of the supply, -(p_in + p_out)")
    i_s: Variable = Variable(unit="A", doc="current of the supply")

    def equations(self) -> Equations:
        yield from super().equations()
        taken, given = self.in_p.v * self.in_p.i + self.in_n.v * self.in_n.i, self.out.v * self.out.i
        yield self.p_in == taken
        yield self.p_out == given
        yield self.p_s == -(taken + given)
        yield self.in_p.i == 0
        yield self.in_n.i == 0
        yield self.v_in == self.in_p.v - self.in_n.v
        yield self.v_out == self.out.v
        yield self.i_s == -(taken + given) / (self.vps - self.vns)
        if self.useSupply:
            yield self.vps == self.s_p.v
            yield self.vns == self.s_n.v
            yield self.s_p.i == self.i_s
            yield self.s_n.i == -self.i_s
        else:
            yield self.vps == self.Vps
            yield self.vns == self.Vns
        if self.useFirstOrder:
            yield self.Tau * der(self.v_int) == self.V0 * self.v_in - self.v_int
        else:
            yield self.v_int == self.V0 * self.v_in
        low, high = self.v_int < self.vns, self.v_int > self.vps
        yield self.v_out == ac.where(high, self.vps, ac.where(low, self.vns, self.v_int))

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        starts = {"Linear": ac.clip(self.V0 * self.v_in, self.vns, self.vps), "UpperLimit": self.vps,
                  "LowerLimit": self.vns}  # fmt: skip
        if self.initOpAmp not in starts:
            raise ac.DeclarationError(f"`initOpAmp={self.initOpAmp!r}` is none of {', '.join(starts)}")
        if self.useFirstOrder:
            yield self.v_int == starts[self.initOpAmp]


class IdealizedOpAmpLimited(OpAmpLimited):
    """Operational amplifier of gain `V0` between its supplies, without dynamics (see `OpAmpLimited`).

    >>> model = assemble("source.p - amp.in_p", "amp.in_n - amp.out - load.p", "source.n - load.n - ground.p",
    ...                  source=ConstantVoltage(V=2.0), amp=IdealizedOpAmpLimited(), load=Resistor(R=1e3),
    ...                  ground=Ground())
    >>> close(run(model)["load.v"][-1], 2.0, 1e-3)
    True

    `strict` is there for models written in Modelica, and changes nothing: the limits are kept in both cases, and their
    times located. So is `homotopyType`, with its default only: at the start nothing is made linear here.

    Source: Modelica.Electrical.Analog.Ideal.IdealizedOpAmpLimited (named ...Limted in earlier versions).
    """

    strict: bool = True
    homotopyType: str = "NoHomotopy"

    def equations(self) -> Equations:
        if self.homotopyType != "NoHomotopy":
            raise ac.DeclarationError(
                f"`homotopyType={self.homotopyType!r}`: there is no homotopy at the start here. Leave it at "
                '"NoHomotopy"; of several solutions at the start, a start value beyond a limit chooses the one there, '
                "as in `v_int=start(30.0)`."
            )
        yield from super().equations()


IdealizedOpAmpLimted = IdealizedOpAmpLimited


class OpAmpDetailed(Component):
    """Operational amplifier with input stage, three poles and a zero, common mode, slew rate, and limited output.

    >>> model = assemble("source.p - amp.p", "amp.m - amp.outp - load.p", "high.p - amp.p_supply",
    ...                  "low.n - amp.m_supply", "source.n - load.n - high.n - low.p - ground.p",
    ...                  source=ConstantVoltage(V=2.0), ground=Ground(),
    ...                  amp=OpAmpDetailed(), load=Resistor(R=1e4), high=ConstantVoltage(V=15.0),
    ...                  low=ConstantVoltage(V=15.0))
    >>> close(run(model, at=[0.0, 1e-4])["load.v"][-1], 2.0 - 1e-3, 1e-3)
    True

    Source: Modelica.Electrical.Analog.Basic.OpAmpDetailed; Conelly and Choi, Macromodeling with SPICE (1992).
    """

    p: Pin = Pin()
    m: Pin = Pin()
    outp: Pin = Pin()
    p_supply: Pin = Pin()
    m_supply: Pin = Pin()
    Rdm: Parameter = Parameter(2e6, unit="ohm", doc="differential input resistance")
    Rcm: Parameter = Parameter(2e9, unit="ohm", doc="common-mode input resistance")
    Cin: Parameter = Parameter(1.4e-12, unit="F", doc="input capacitance")
    Vos: Parameter = Parameter(1e-3, unit="V", doc="input offset voltage")
    Ib: Parameter = Parameter(80e-9, unit="A", doc="input bias current")
    Ios: Parameter = Parameter(20e-9, unit="A", doc="input offset current")
    vcp: Parameter = Parameter(0.0, unit="V", doc="distance of the output from the positive supply")
    vcm: Parameter = Parameter(0.0, unit="V", doc="distance of the output from the negative supply")
    Avd0: Parameter = Parameter(106.0, doc="differential gain [dB]")
    CMRR: Parameter = Parameter(90.0, doc="common-mode rejection [dB]")
    fp1: Parameter = Parameter(5.0, unit="Hz", doc="dominant pole")
    fp2: Parameter = Parameter(2e6, unit="Hz", doc="second pole")
    fp3: Parameter = Parameter(20e6, unit="Hz", doc="third pole")
    fp4: Parameter = Parameter(100e6, unit="Hz", doc="fourth pole")
    fz: Parameter = Parameter(5e6, unit="Hz", doc="zero")
    sr_p: Parameter = Parameter(0.5e6, unit="V/s", doc="slew rate upwards")
    sr_m: Parameter = Parameter(0.5e6, unit="V/s", doc="slew rate downwards")
    Rout: Parameter = Parameter(75.0, unit="ohm", doc="output resistance")
    Imaxso: Parameter = Parameter(25e-3, unit="A", doc="largest current that the output gives")
    Imaxsi: Parameter = Parameter(25e-3, unit="A", doc="largest current that the output takes")
    Ts: Parameter = Parameter(1.2e-6, unit="s", doc="time constant of the slew rate stage")
    v_in: Variable = Variable(unit="V", start=0.0, doc="differential input voltage")
    q_fr1: Variable = Variable(unit="V", start=0.0, doc="after the second pole")
    q_fr2: Variable = Variable(unit="V", start=0.0, doc="after the third pole and the zero")
    q_fr3: Variable = Variable(unit="V", start=0.0, doc="after the fourth pole")
    q_sum: Variable = Variable(unit="V", doc="sum of differential and common-mode gain")
    q_fp1: Variable = Variable(unit="V", start=0.0, doc="after the dominant pole")
    q_sum_help: Variable = Variable(unit="V", doc="q_sum, limited by the supply")
    v_source: Variable = Variable(unit="V", start=0.0, doc="voltage of the output stage")
    v_pos: Variable = Variable(unit="V", doc="potential of the positive supply")
    v_neg: Variable = Variable(unit="V", doc="potential of the negative supply")
    v_vos: Variable = Variable(unit="V", doc="input offset voltage")
    v_3: Variable = Variable(unit="V", doc="potential of p behind the offset voltage")
    v_4: Variable = Variable(unit="V", doc="potential of m")
    i_vos: Variable = Variable(unit="A", nominal=1e-6, doc="current into p")
    i_3: Variable = Variable(unit="A", nominal=1e-6, doc="its part from behind the offset voltage to ground")
    i_4: Variable = Variable(unit="A", nominal=1e-6, doc="current from m to ground")
    i_r2: Variable = Variable(unit="A", nominal=1e-6, doc="current of the differential input resistance")
    i_c3: Variable = Variable(unit="A", nominal=1e-6, doc="current of the input capacitance")
    v_out: Variable = Variable(unit="V", doc="potential of the output")
    i_out: Variable = Variable(unit="A", nominal=1e-3, doc="current into the output")
    x: Variable = Variable(unit="V", start=0.0, doc="integral of the slew rate stage")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self._input()
        yield from self._gain()
        yield from self._output()

    def _input(self) -> Equations:
        yield self.v_pos == self.p_supply.v
        yield self.v_neg == self.m_supply.v
        yield self.v_vos == self.Vos
        yield self.v_3 == self.p.v - self.v_vos
        yield self.v_4 == self.m.v
        yield self.v_in == self.v_3 - self.v_4
        yield self.i_r2 == self.v_in / self.Rdm
        yield self.i_c3 == self.Cin * der(self.v_in)
        yield self.i_3 == self.Ib + self.Ios / 2 + self.v_3 / self.Rcm
        yield self.i_4 == self.Ib - self.Ios / 2 + self.v_4 / self.Rcm
        yield self.i_vos == self.i_3 + self.i_r2 + self.i_c3
        yield self.p.i == self.i_vos
        yield self.m.i == self.i_4 - self.i_r2 - self.i_c3
        yield self.p_supply.i == 0
        yield self.m_supply.i == 0

    def _gain(self) -> Equations:
        differential = 10 ** (self.Avd0 / 20)
        common = differential / 10 ** (self.CMRR / 20) / 2
        high, low = self.v_pos - ac.abs(self.vcp), self.v_neg + ac.abs(self.vcm)
        above, below = (self.q_sum > high) & (self.q_fp1 >= high), (self.q_sum < low) & (self.q_fp1 <= low)
        yield self.q_sum_help == where(above, high, where(below, low, self.q_sum))
        yield der(self.q_fr1) == 2 * PI * self.fp2 * (self.v_in - self.q_fr1)
        lag, lead = 1 / (2 * PI * self.fp3), 1 / (2 * PI * self.fz)
        yield self.q_fr2 + lag * der(self.q_fr2) == self.q_fr1 + lead * der(self.q_fr1)
        yield der(self.q_fr3) == 2 * PI * self.fp4 * (self.q_fr2 - self.q_fr3)
        yield self.q_sum == differential * self.q_fr3 + common * (self.v_3 + self.v_4)
        yield der(self.q_fp1) == 2 * PI * self.fp1 * (self.q_sum_help - self.q_fp1)

    def _output(self) -> Equations:
        rate = (self.q_fp1 - self.v_source) / self.Ts
        yield der(self.x) == rate
        yield der(self.v_source) == ac.clip(rate, -ac.abs(self.sr_m), ac.abs(self.sr_p))
        current = (self.v_out - self.v_source) / self.Rout
        yield self.v_out == self.outp.v
        yield self.i_out == self.outp.i
        yield self.i_out == ac.clip(current, -ac.abs(self.Imaxso), ac.abs(self.Imaxsi))

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.v_source == self.q_fp1
        yield self.x == 0
