"""Thyristor and triac with gates and switching times."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Parameter, Variable, connect, der, exp, where

from .ideal_semiconductors import IdealDiode
from .interfaces import ConditionalHeatPort, Pin


class Thyristor(ConditionalHeatPort):
    """Thyristor with gate: a control voltage that the gate charges switches the resistance between anode and cathode.

    ``dvControl/dt = (vContot - vControl)/(1.87 TON)`` when rising, ``/(0.638 TOFF)`` when falling; below 1.5 V it
    blocks with ``VDRM^2/(VTM IH)``, above 5 V it conducts with ``(VTM - 0.7 V)/ITM``, in between on a smooth path.

    >>> model = assemble("source.p - load.p", "load.n - thyristor.Anode",
    ...                  "source.n - thyristor.Cathode - gate.p - ground.p", "gate.n - thyristor.Gate",
    ...                  thyristor=Thyristor(), gate=StepCurrent(I=20e-3, startTime=2e-5),
    ...                  source=ConstantVoltage(V=50.0), load=Resistor(R=10.0), ground=Ground())
    >>> on = run(model, at=[1e-5, 5e-5])
    >>> on["load.i"][0] < 0.1 and close(on["load.i"][1], 5.0, 2e-2)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.Thyristor.
    """

    Anode: Pin = Pin()
    Cathode: Pin = Pin()
    Gate: Pin = Pin()
    VDRM: Parameter = Parameter(100.0, unit="V", min=0.0, doc="forward breakthrough voltage")
    VRRM: Parameter = Parameter(100.0, unit="V", min=0.0, doc="reverse breakthrough voltage")
    IDRM: Parameter = Parameter(0.1, unit="A", doc="saturation current; as in the source, no equation has it")
    VTM: Parameter = Parameter(1.7, unit="V", doc="conducting voltage")
    IH: Parameter = Parameter(6e-3, unit="A", doc="holding current")
    ITM: Parameter = Parameter(25.0, unit="A", doc="conducting current")
    VGT: Parameter = Parameter(0.7, unit="V", doc="gate trigger voltage")
    IGT: Parameter = Parameter(5e-3, unit="A", doc="gate trigger current")
    TON: Parameter = Parameter(1e-6, unit="s", doc="switch-on time")
    TOFF: Parameter = Parameter(15e-6, unit="s", doc="switch-off time")
    Vt: Parameter = Parameter(0.04, unit="V", doc="voltage equivalent of the temperature")
    Nbv: Parameter = Parameter(0.74, unit="1", doc="emission coefficient of the reverse breakthrough")
    vRef: Parameter = Parameter(0.65, unit="V", doc="gate voltage at which its resistance changes")
    Von: Parameter = Parameter(5.0, unit="V", doc="control voltage of full conduction")
    Voff: Parameter = Parameter(1.5, unit="V", doc="control voltage below which it blocks")
    gain: Parameter = Parameter(10000.0, unit="1/A", doc="slope of the gate current's effect")
    step: Parameter = Parameter(1e-3, unit="A", doc="range of the gate current's effect")
    knee: Parameter = Parameter(0.7, unit="V", doc="part of the conducting voltage that is no resistance")
    vGK: Variable = Variable(unit="V", doc="voltage from gate to cathode")
    vAK: Variable = Variable(unit="V", doc="voltage from anode to cathode")
    vControl: Variable = Variable(unit="V", start=0.0, doc="control voltage")
    iGK: Variable = Variable(unit="A", nominal=1e-3, doc="current of the gate")
    vConmain: Variable = Variable(unit="V", doc="control voltage that the main current or a breakthrough demands")
    vContot: Variable = Variable(unit="V", doc="voltage that the control voltage follows")

    def equations(self) -> Equations:
        yield from super().equations()
        iGK, vGK, vAK, control = self.iGK, self.vGK, self.vAK, self.vControl
        on, off = (self.VTM - self.knee) / self.ITM, self.VDRM**2 / self.VTM / self.IH
        x = (2 * control - self.Von - self.Voff) / (2 * (self.Von - self.Voff))
        between = vAK / (ac.sqrt(on * off) * (on / off) ** ((3 * x - 4 * x**3) / 2))
        breakthrough = -self.VRRM / off * exp(-(vAK + self.VRRM) / (self.Nbv * self.Vt))
        conducting = where(control < self.Von, between, vAK / on)
        excess = iGK - 0.95 * self.IGT
        gate = where(excess < 0, 0.0, where(excess < self.step, self.gain * excess * vAK, 10 * vAK))
        held = where((self.Anode.i > self.IH) | (vAK > self.VDRM), self.Von, 0.0)
        upper = self.vRef**2 / self.VGT + iGK * (self.VGT - self.vRef) / self.IGT
        rise = self.vContot - control
        yield self.Anode.i + self.Gate.i + self.Cathode.i == 0
        yield vGK == self.Gate.v - self.Cathode.v
        yield vAK == self.Anode.v - self.Cathode.v
        yield vGK == where(vGK < self.vRef, self.VGT / self.IGT * iGK, upper)
        yield iGK == self.Gate.i
        yield self.vConmain == held
        yield self.vContot == self.vConmain + gate
        yield der(control) == rise / where(rise > 0, 1.87 * self.TON, 0.638 * self.TOFF)
        yield self.Anode.i == where(vAK < -self.VRRM, breakthrough, where(control < self.Voff, vAK / off, conducting))
        yield self.LossPower == self.Anode.i * self.Anode.v + self.Cathode.i * self.Cathode.v + iGK * self.Gate.v


class SimpleTriac(ConditionalHeatPort):
    """Triac: two thyristors in opposite directions, each with a diode before its gate.

    `thyristor` conducts from n to p, `thyristor1` from p to n; see `Thyristor` for the parameters. The heat is that of
    its pins, ``LossPower = p.i p.v + n.i n.v + g.i g.v``.

    >>> model = assemble("source.p - load.p", "load.n - triac.p", "source.n - triac.n - gate.p - ground.p",
    ...                  "gate.n - triac.g", triac=SimpleTriac(), gate=StepCurrent(I=20e-3, startTime=2e-5),
    ...                  source=ConstantVoltage(V=5.0), load=Resistor(R=10.0), ground=Ground())
    >>> on = run(model, at=[1e-5, 5e-5])
    >>> on["load.i"][0] < 1e-2 and close(on["load.i"][1], 5.0 / (10.0 + 0.04), 1e-3)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.SimpleTriac.
    """

    p: Pin = Pin()
    n: Pin = Pin()
    g: Pin = Pin()
    VDRM: Parameter = Parameter(100.0, unit="V", min=0.0, doc="forward breakthrough voltage")
    VRRM: Parameter = Parameter(100.0, unit="V", min=0.0, doc="reverse breakthrough voltage")
    IDRM: Parameter = Parameter(0.1, unit="A", doc="saturation current; as in the source, no equation has it")
    VTM: Parameter = Parameter(1.7, unit="V", doc="conducting voltage")
    IH: Parameter = Parameter(6e-3, unit="A", doc="holding current")
    ITM: Parameter = Parameter(25.0, unit="A", doc="conducting current")
    VGT: Parameter = Parameter(0.7, unit="V", doc="gate trigger voltage")
    IGT: Parameter = Parameter(5e-3, unit="A", doc="gate trigger current")
    TON: Parameter = Parameter(1e-6, unit="s", doc="switch-on time")
    TOFF: Parameter = Parameter(15e-6, unit="s", doc="switch-off time")
    Vt: Parameter = Parameter(0.04, unit="V", doc="voltage equivalent of the temperature")
    Nbv: Parameter = Parameter(0.74, unit="1", doc="emission coefficient of the reverse breakthrough")
    thyristor: Thyristor = Thyristor(
        VDRM=VDRM, VRRM=VRRM, IDRM=IDRM, VTM=VTM, IH=IH, ITM=ITM, VGT=VGT, IGT=IGT, TON=TON, TOFF=TOFF, Vt=Vt, Nbv=Nbv
    )
    thyristor1: Thyristor = Thyristor(
        VDRM=VDRM, VRRM=VRRM, IDRM=IDRM, VTM=VTM, IH=IH, ITM=ITM, VGT=VGT, IGT=IGT, TON=TON, TOFF=TOFF, Vt=Vt, Nbv=Nbv
    )
    idealDiode: IdealDiode = IdealDiode(Vknee=0.0)
    idealDiode1: IdealDiode = IdealDiode(Vknee=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.thyristor.Anode, self.thyristor1.Cathode, self.n)
        yield connect(self.thyristor1.Anode, self.thyristor.Cathode, self.p)
        yield connect(self.g, self.idealDiode.p, self.idealDiode1.p)
        yield connect(self.idealDiode.n, self.thyristor.Gate)
        yield connect(self.idealDiode1.n, self.thyristor1.Gate)
        yield self.LossPower == self.p.i * self.p.v + self.n.i * self.n.v + self.g.i * self.g.v
