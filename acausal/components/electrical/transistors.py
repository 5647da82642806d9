"""Bipolar (Ebers-Moll) and MOS transistors."""

from __future__ import annotations

from typing import NamedTuple

from acausal import Equations, Expr, Parameter, Variable, conditional, der, noevent, where
from acausal import max as maximum
from acausal import min as minimum

from .. import thermal
from .interfaces import ConditionalHeatPort, Pin
from .semiconductors import BOLTZMANN, CHARGE, exlin2, powlin


class PartialTemperatureDependent(ConditionalHeatPort, partial=True):
    """Device with a heat port where, with `useTemperatureDependency`, its characteristic follows the temperature.

    Source: Modelica.Electrical.Analog.Interfaces.ConditionalHeatPort with ``useHeatPort = useTemperatureDependency``.
    """

    useTemperatureDependency: bool = False
    heatPort: thermal.HeatPort = conditional(thermal.HeatPort(), "useTemperatureDependency")

    @property
    def temperature(self) -> Expr:
        """Temperature of the device [K]."""
        return self.heatPort.T if self.useTemperatureDependency else self.T

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useTemperatureDependency and not self.useHeatPort:
            yield self.heatPort.Q_flow == -self.LossPower


class Junction(NamedTuple):
    """Forward voltage `v` of a junction, current `i` of its diode, capacitance `c`; their names differ by polarity."""

    v: Expr
    i: Expr
    c: Expr


class PartialBipolar(PartialTemperatureDependent, partial=True):
    """Bipolar transistor after Ebers and Moll, with Early effect, junction and diffusion capacitances.

    With `UIC` the voltage from collector to substrate begins at `IC`.

    Source: Modelica.Electrical.Analog.Semiconductors.NPN; Vlach and Singhal, Computer Methods for Circuit Analysis and
    Design (1983), chapter 17.
    """

    polarity: int = 1
    useSubstrate: bool = False
    UIC: bool = False
    C: Pin = Pin()
    B: Pin = Pin()
    E: Pin = Pin()
    S: Pin = conditional(Pin(), "useSubstrate")
    Bf: Parameter = Parameter(50.0, unit="1", doc="forward beta")
    Br: Parameter = Parameter(0.1, unit="1", doc="reverse beta")
    Is: Parameter = Parameter(1e-16, unit="A", doc="transport saturation current")
    Vak: Parameter = Parameter(0.02, unit="1/V", doc="inverse Early voltage")
    Tauf: Parameter = Parameter(0.12e-9, unit="s", doc="ideal forward transit time")
    Taur: Parameter = Parameter(5e-9, unit="s", doc="ideal reverse transit time")
    Ccs: Parameter = Parameter(1e-12, unit="F", doc="collector-substrate capacitance")
    Cje: Parameter = Parameter(0.4e-12, unit="F", doc="base-emitter zero-bias depletion capacitance")
    Cjc: Parameter = Parameter(0.5e-12, unit="F", doc="base-collector zero-bias depletion capacitance")
    Phie: Parameter = Parameter(0.8, unit="V", doc="base-emitter diffusion voltage")
    Me: Parameter = Parameter(0.4, unit="1", doc="base-emitter gradation exponent")
    Phic: Parameter = Parameter(0.8, unit="V", doc="base-collector diffusion voltage")
    Mc: Parameter = Parameter(0.333, unit="1", doc="base-collector gradation exponent")
    Gbc: Parameter = Parameter(1e-15, unit="S", doc="base-collector conductance")
    Gbe: Parameter = Parameter(1e-15, unit="S", doc="base-emitter conductance")
    EMin: Parameter = Parameter(-100.0, unit="1", doc="below it the exponential is linear")
    EMax: Parameter = Parameter(40.0, unit="1", doc="above it the exponential is linear")
    Vt: Parameter = Parameter(0.02585, unit="V", doc="voltage equivalent of the temperature")
    Tnom: Parameter = Parameter(300.15, unit="K", doc="temperature at which the parameters were measured")
    XTI: Parameter = Parameter(3.0, unit="1", doc="temperature exponent of the saturation current")
    XTB: Parameter = Parameter(0.0, unit="1", doc="temperature exponent of the betas")
    EG: Parameter = Parameter(1.11, unit="V", doc="energy gap, over the elementary charge")
    NF: Parameter = Parameter(1.0, unit="1", doc="forward emission coefficient")
    NR: Parameter = Parameter(1.0, unit="1", doc="reverse emission coefficient")
    IC: Parameter = Parameter(0.0, unit="V", doc="voltage from collector to substrate at the start, with UIC")
    k_q: Parameter = Parameter(BOLTZMANN / CHARGE, unit="V/K", doc="Boltzmann constant over the elementary charge")
    vcs: Variable = Variable(unit="V", doc="voltage from collector to substrate")
    vt_t: Variable = Variable(unit="V", doc="voltage equivalent of the device's temperature")
    is_t: Variable = Variable(unit="A", nominal=1e-16, doc="saturation current at the device's temperature")
    bf_t: Variable = Variable(unit="1", doc="forward beta at the device's temperature")
    br_t: Variable = Variable(unit="1", doc="reverse beta at the device's temperature")
    Capcjc: Variable = Variable(unit="F", nominal=1e-12, doc="depletion capacitance between base and collector")
    Capcje: Variable = Variable(unit="F", nominal=1e-12, doc="depletion capacitance between base and emitter")
    vS: Variable = Variable(unit="V", doc="potential of the substrate")
    qbk: Variable = Variable(unit="1", doc="inverse of the relative majority carrier charge")
    iS: Variable = Variable(unit="A", nominal=1e-6, doc="current of the substrate")

    def junctions(self, collector: Junction, emitter: Junction) -> Equations:
        """Equations of the junctions of the base with the collector and the emitter."""
        s, vbc, vbe, ibc, ibe = self.polarity, collector.v, emitter.v, collector.i, emitter.i
        ratio = self.temperature / self.Tnom
        saturation, beta_r, beta_f, thermal = self.Is * 1.0, self.Br * 1.0, self.Bf * 1.0, self.Vt * 1.0
        if self.useTemperatureDependency:
            thermal = self.k_q * self.temperature
            growth = exlin2((ratio - 1) * self.EG / thermal, self.EMin, self.EMax)
            saturation = self.Is * ratio**self.XTI * growth
            beta_r, beta_f = self.Br * ratio**self.XTB, self.Bf * ratio**self.XTB
        over_c, over_e = self.NR * thermal, self.NF * thermal
        exp_c, exp_e = exlin2(vbc / over_c, self.EMin, self.EMax), exlin2(vbe / over_e, self.EMin, self.EMax)
        yield self.vt_t == thermal
        yield self.is_t == saturation
        yield self.bf_t == beta_f
        yield self.br_t == beta_r
        yield self.vS == (self.S.v if self.useSubstrate else 0.0)
        yield self.vcs == self.C.v - self.vS
        yield self.qbk == 1 - vbc * self.Vak
        yield ibc == saturation * (exp_c - 1) + vbc * self.Gbc
        yield ibe == saturation * (exp_e - 1) + vbe * self.Gbe
        depletion_c = self.Cjc * powlin(vbc / self.Phic, self.Mc)
        depletion_e = self.Cje * powlin(vbe / self.Phie, self.Me)
        cbc = self.Taur * saturation / over_c * exp_c + depletion_c
        cbe = self.Tauf * saturation / over_e * exp_e + depletion_e
        yield self.Capcjc == depletion_c
        yield self.Capcje == depletion_e
        yield collector.c == cbc
        yield emitter.c == cbe
        yield self.iS == -self.Ccs * der(self.vcs)
        # with the expressions in full: where all times and capacitances are zero, they take the derivatives out
        charge_c, charge_e = cbc * der(vbc), cbe * der(vbe)
        transport = (ibe - ibc) * self.qbk
        yield self.C.i == s * (transport - ibc / beta_r - charge_c) - self.iS
        yield self.B.i == s * (ibe / beta_f + ibc / beta_r + charge_c + charge_e)
        yield self.C.i + self.B.i + self.E.i + self.iS == 0
        if self.useSubstrate:
            yield self.S.i == self.iS
        yield self.LossPower == vbc * ibc / beta_r + vbe * ibe / beta_f + s * transport * (self.C.v - self.E.v)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.UIC:
            yield self.vcs == self.IC


class NPN(PartialBipolar):
    """NPN transistor after Ebers and Moll; junction voltages ``vbc = B.v - C.v``, ``vbe = B.v - E.v``.

    ``C.i = (ibe - ibc) qbk - ibc/Br - cbc dvbc/dt - iS``, ``B.i = ibe/Bf + ibc/Br + cbc dvbc/dt + cbe dvbe/dt`` with
    ``ibe = Is (exp(vbe/(NF Vt)) - 1) + Gbe vbe``, ``qbk = 1 - Vak vbc``, ``iS = -Ccs d(C.v)/dt``.

    >>> model = assemble("drive.p - base.p", "base.n - tr.B", "supply.p - load.p", "load.n - tr.C",
    ...                  "drive.n - supply.n - tr.E - ground.p", drive=ConstantVoltage(V=1.7), base=Resistor(R=1e5),
    ...                  supply=ConstantVoltage(V=5.0), load=Resistor(R=1e3), tr=NPN(), ground=Ground())
    >>> tr = run(model, at=[0.0, 1.0])
    >>> ib, ic = tr["tr.B.i"][-1], tr["tr.C.i"][-1]
    >>> close(ic / ib, 50.0 * (1 + 0.02 * (tr["tr.C.v"][-1] - tr["tr.B.v"][-1])), 1e-2)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.NPN.
    """

    ibc: Variable = Variable(unit="A", nominal=1e-3, doc="current of the base-collector diode")
    ibe: Variable = Variable(unit="A", nominal=1e-3, doc="current of the base-emitter diode")
    cbc: Variable = Variable(unit="F", nominal=1e-12, doc="capacitance between base and collector")
    cbe: Variable = Variable(unit="F", nominal=1e-12, doc="capacitance between base and emitter")
    vbc: Variable = Variable(unit="V", doc="voltage from base to collector")
    vbe: Variable = Variable(unit="V", doc="voltage from base to emitter")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.vbc == self.B.v - self.C.v
        yield self.vbe == self.B.v - self.E.v
        collector, emitter = Junction(self.vbc, self.ibc, self.cbc), Junction(self.vbe, self.ibe, self.cbe)
        yield from self.junctions(collector, emitter)


class PNP(PartialBipolar):
    """PNP transistor after Ebers and Moll; junction voltages ``vcb = C.v - B.v``, ``veb = E.v - B.v``.

    The equations of `NPN` with these voltages, all currents in the other direction.

    >>> model = assemble("drive.n - base.p", "base.n - tr.B", "supply.n - load.p", "load.n - tr.C",
    ...                  "drive.p - supply.p - tr.E - ground.p", drive=ConstantVoltage(V=1.7), base=Resistor(R=1e5),
    ...                  supply=ConstantVoltage(V=5.0), load=Resistor(R=1e3), tr=PNP(), ground=Ground())
    >>> tr = run(model, at=[0.0, 1.0])
    >>> ib, ic = tr["tr.B.i"][-1], tr["tr.C.i"][-1]
    >>> ic < 0 and close(ic / ib, 50.0 * (1 + 0.02 * (tr["tr.B.v"][-1] - tr["tr.C.v"][-1])), 1e-2)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.PNP.
    """

    polarity: int = -1
    icb: Variable = Variable(unit="A", nominal=1e-3, doc="current of the collector-base diode")
    ieb: Variable = Variable(unit="A", nominal=1e-3, doc="current of the emitter-base diode")
    ccb: Variable = Variable(unit="F", nominal=1e-12, doc="capacitance between collector and base")
    ceb: Variable = Variable(unit="F", nominal=1e-12, doc="capacitance between emitter and base")
    vcb: Variable = Variable(unit="V", doc="voltage from collector to base")
    veb: Variable = Variable(unit="V", doc="voltage from emitter to base")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.vcb == self.C.v - self.B.v
        yield self.veb == self.E.v - self.B.v
        collector, emitter = Junction(self.vcb, self.icb, self.ccb), Junction(self.veb, self.ieb, self.ceb)
        yield from self.junctions(collector, emitter)


class HeatingNPN(NPN):
    """NPN transistor whose currents follow the temperature of its heat port (see `NPN`).

    >>> model = assemble("drive.p - base.p", "base.n - tr.B", "supply.p - tr.C", "tr.heatPort - hot.port",
    ...                  "drive.n - supply.n - tr.E - ground.p", drive=ConstantVoltage(V=1.7), base=Resistor(R=1e5),
    ...                  supply=ConstantVoltage(V=5.0), tr=HeatingNPN(), ground=Ground(),
    ...                  hot=thermal.FixedTemperature(T=300.15))
    >>> tr = run(model)
    >>> close(tr["hot.port.Q_flow"][-1], tr["tr.LossPower"][-1])
    True

    Source: Modelica.Electrical.Analog.Semiconductors.HeatingNPN.
    """

    useHeatPort: bool = True
    useTemperatureDependency: bool = True


class HeatingPNP(PNP):
    """PNP transistor whose currents follow the temperature of its heat port (see `PNP`).

    >>> model = assemble("drive.n - base.p", "base.n - tr.B", "supply.n - tr.C", "tr.heatPort - hot.port",
    ...                  "drive.p - supply.p - tr.E - ground.p", drive=ConstantVoltage(V=1.7), base=Resistor(R=1e5),
    ...                  supply=ConstantVoltage(V=5.0), tr=HeatingPNP(), ground=Ground(),
    ...                  hot=thermal.FixedTemperature(T=300.15))
    >>> tr = run(model)
    >>> close(tr["hot.port.Q_flow"][-1], tr["tr.LossPower"][-1])
    True

    Source: Modelica.Electrical.Analog.Semiconductors.HeatingPNP.
    """

    useHeatPort: bool = True
    useTemperatureDependency: bool = True


class PartialMOS(PartialTemperatureDependent, partial=True):
    """MOS transistor with drain, gate, source and bulk, without capacitances.

    Source: Modelica.Electrical.Analog.Semiconductors.NMOS; Spiro, Simulation integrierter Schaltungen (1990).
    """

    D: Pin = Pin()
    G: Pin = Pin()
    S: Pin = Pin()
    B: Pin = Pin()
    W: Parameter = Parameter(20e-6, unit="m", doc="width")
    L: Parameter = Parameter(6e-6, unit="m", doc="length")
    Beta: Parameter = Parameter(0.041e-3, unit="A/V2", doc="transconductance parameter")
    Vt: Parameter = Parameter(0.8, unit="V", doc="threshold voltage at zero bias")
    K2: Parameter = Parameter(1.144, unit="1", doc="bulk threshold parameter")
    K5: Parameter = Parameter(0.7311, unit="1", doc="reduction of the pinch-off region")
    dW: Parameter = Parameter(-2.5e-6, unit="m", doc="narrowing of the channel")
    dL: Parameter = Parameter(-1.5e-6, unit="m", doc="shortening of the channel")
    RDS: Parameter = Parameter(1e7, unit="ohm", doc="resistance between drain and source")
    Tnom: Parameter = Parameter(300.15, unit="K", doc="temperature at which the parameters were measured")
    kvt: Parameter = Parameter(-6.96e-3, unit="1/K", doc="temperature coefficient of Vt")
    kk2: Parameter = Parameter(6e-4, unit="1/K", doc="temperature coefficient of K2")
    id: Variable = Variable(unit="A", nominal=1e-3, doc="current of the channel from the higher to the lower side")

    def channel(self, s: int) -> Equations:
        """Equations of the channel; `s` is 1 for an n-channel and -1 for a p-channel: all voltages are mirrored."""
        beta, threshold, k2 = self.Beta * 1.0, self.Vt * 1.0, self.K2 * 1.0
        if self.useTemperatureDependency:
            beta = self.Beta * (self.temperature / self.Tnom) ** -1.5
            threshold = self.Vt * (1 + (self.temperature - self.Tnom) * self.kvt)
            k2 = self.K2 * (1 + (self.temperature - self.Tnom) * self.kk2)
        d, g, source, bulk = s * self.D.v, s * self.G.v, s * self.S.v, s * self.B.v
        gain = beta * (self.W + self.dW) / (self.L + self.dL)
        reverse = d < source  # everywhere the same side where both are equal: the slope there is that of `RDS`
        low = noevent(where(reverse, d, source))
        uds = noevent(where(reverse, source, d)) - low
        ugst = (g - low - s * threshold + k2 * minimum(bulk - low, 0.0)) * self.K5
        effective = minimum(uds, maximum(ugst, 0.0))
        yield self.id == gain * effective * (maximum(ugst, 0.0) - effective / 2) + uds / self.RDS
        yield self.D.i == s * noevent(where(reverse, -self.id, self.id))
        yield self.S.i == -self.D.i
        yield self.G.i == 0
        yield self.B.i == 0
        yield self.LossPower == self.D.i * (self.D.v - self.S.v)


class NMOS(PartialMOS):
    """n-channel MOS transistor: ``id = v uds (ugst - uds/2)`` below pinch-off, ``v ugst^2/2`` beyond, plus ``uds/RDS``.

    ``ugst = K5 (G.v - us - Vt + K2 min(B.v - us, 0))``, ``v = Beta (W + dW)/(L + dL)``, `us` the lower of the sides.

    >>> model = assemble("drive.p - mos.G", "supply.p - mos.D", "drive.n - supply.n - mos.S - mos.B - ground.p",
    ...                  drive=ConstantVoltage(V=3.0), supply=ConstantVoltage(V=5.0), mos=NMOS(), ground=Ground())
    >>> v, ugst = 0.041e-3 * 17.5 / 4.5, 2.2 * 0.7311
    >>> close(1e3 * run(model)["mos.D.i"][-1], 1e3 * (v * ugst**2 / 2 + 5.0 / 1e7), 1e-3)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.NMOS.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.channel(1)


class PMOS(PartialMOS):
    """p-channel MOS transistor: the equations of `NMOS` with all voltages and currents in the other direction.

    >>> model = assemble("drive.n - mos.G", "supply.n - mos.D", "drive.p - supply.p - mos.S - mos.B - ground.p",
    ...                  drive=ConstantVoltage(V=3.0), supply=ConstantVoltage(V=5.0), mos=PMOS(), ground=Ground())
    >>> v, ugst = 0.0105e-3 * 17.5 / 3.9, 2.0 * 0.839
    >>> close(1e3 * run(model)["mos.D.i"][-1], -1e3 * (v * ugst**2 / 2 + 5.0 / 1e7), 1e-3)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.PMOS.
    """

    Beta: Parameter = Parameter(0.0105e-3, unit="A/V2", doc="transconductance parameter")
    Vt: Parameter = Parameter(-1.0, unit="V", doc="threshold voltage at zero bias")
    K2: Parameter = Parameter(0.41, unit="1", doc="bulk threshold parameter")
    K5: Parameter = Parameter(0.839, unit="1", doc="reduction of the pinch-off region")
    dL: Parameter = Parameter(-2.1e-6, unit="m", doc="shortening of the channel")
    kvt: Parameter = Parameter(-2.9e-3, unit="1/K", doc="temperature coefficient of Vt")
    kk2: Parameter = Parameter(6.2e-4, unit="1/K", doc="temperature coefficient of K2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.channel(-1)


class HeatingNMOS(NMOS):
    """n-channel MOS transistor whose currents follow the temperature of its heat port (see `NMOS`).

    >>> model = assemble("drive.p - mos.G", "supply.p - mos.D", "drive.n - supply.n - mos.S - mos.B - ground.p",
    ...                  "mos.heatPort - hot.port", drive=ConstantVoltage(V=3.0), supply=ConstantVoltage(V=5.0),
    ...                  mos=HeatingNMOS(), ground=Ground(), hot=thermal.FixedTemperature(T=300.15))
    >>> mos = run(model)
    >>> close(mos["hot.port.Q_flow"][-1], mos["mos.D.i"][-1] * 5.0)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.HeatingNMOS.
    """

    useHeatPort: bool = True
    useTemperatureDependency: bool = True


class HeatingPMOS(PMOS):
    """p-channel MOS transistor whose currents follow the temperature of its heat port (see `PMOS`).

    >>> model = assemble("drive.n - mos.G", "supply.n - mos.D", "drive.p - supply.p - mos.S - mos.B - ground.p",
    ...                  "mos.heatPort - hot.port", drive=ConstantVoltage(V=3.0), supply=ConstantVoltage(V=5.0),
    ...                  mos=HeatingPMOS(), ground=Ground(), hot=thermal.FixedTemperature(T=300.15))
    >>> mos = run(model)
    >>> close(mos["hot.port.Q_flow"][-1], -mos["mos.D.i"][-1] * 5.0)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.HeatingPMOS.
    """

    useHeatPort: bool = True
    useTemperatureDependency: bool = True
