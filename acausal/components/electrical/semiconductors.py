"""Diodes and the functions that semiconductors share."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Expr, Parameter, Variable, exp, where
from acausal import max as maximum
from acausal import min as minimum

from .interfaces import ConditionalHeatPort, OnePort

BOLTZMANN = 1.380649e-23
"""Boltzmann constant [J/K] (CODATA 2018)."""
CHARGE = 1.602176634e-19
"""Elementary charge [C] (CODATA 2018)."""


def exlin(x: Expr, limit: Expr | float) -> Expr:
    """``exp(x)``, linearly continued for ``x > limit``."""
    return exp(minimum(x, limit)) * (1 + maximum(x - limit, 0.0))


def exlin2(x: Expr, low: Expr | float, high: Expr | float) -> Expr:
    """``exp(x)``, linearly continued for ``x < low`` and ``x > high``."""
    return exp(ac.clip(x, low, high)) * (1 + maximum(x - high, 0.0) + minimum(x - low, 0.0))


def powlin(x: Expr, y: Expr | float) -> Expr:
    """``(1 - x)^-y``, linearly continued for ``x > 0``."""
    return where(x > 0, 1 + y * x, (1 - minimum(x, 0.0)) ** (-y))


class Diode(ConditionalHeatPort, OnePort):
    """Shockley diode with a parallel resistance, ``i = Ids (exp(v/Vt) - 1) + v/R``, linear beyond ``v/Vt = Maxexp``.

    With `useTemperatureDependency` the voltage equivalent is ``N k T/q``, and the saturation current grows with the
    temperature, ``Ids (T/TNOM)^(XTI/N) exp((T/TNOM - 1) EG q/(N k T))``.

    >>> model = assemble("source.p - diode.p", "source.n - diode.n - ground.p", ground=Ground(), diode=Diode(),
    ...                  source=RampVoltage(V=1.0, offset=-0.5, duration=1.0))
    >>> v = np.array([-0.5, 0.0, 0.2, 0.5])
    >>> close(run(model, at=v + 0.5)["diode.i"], 1e-6 * (np.exp(v / 0.04) - 1) + v / 1e8)
    True

    Source: Modelica.Electrical.Analog.Semiconductors.Diode.
    """

    useTemperatureDependency: bool = False
    Ids: Parameter = Parameter(1e-6, unit="A", min=0.0, doc="saturation current")
    Vt: Parameter = Parameter(0.04, unit="V", min=1e-30, doc="voltage equivalent of the temperature")
    Maxexp: Parameter = Parameter(15.0, unit="1", doc="exponent from which on the characteristic is linear")
    R: Parameter = Parameter(1e8, unit="ohm", doc="parallel resistance")
    EG: Parameter = Parameter(1.11, unit="V", doc="activation energy, over the elementary charge")
    N: Parameter = Parameter(1.0, unit="1", doc="emission coefficient")
    TNOM: Parameter = Parameter(300.15, unit="K", doc="temperature at which the parameters were measured")
    XTI: Parameter = Parameter(3.0, unit="1", doc="temperature exponent of the saturation current")
    k_q: Parameter = Parameter(BOLTZMANN / CHARGE, unit="V/K", doc="Boltzmann constant over the elementary charge")
    vt_t: Variable = Variable(unit="V", doc="voltage equivalent of the device's temperature, k T/q")
    id: Variable = Variable(unit="A", doc="current without that of R and the growth of Ids")

    def equations(self) -> Equations:
        yield from super().equations()
        thermal = self.k_q * self.temperature
        ratio, scale, growth = self.temperature / self.TNOM, self.N * thermal, 1.0
        if self.useTemperatureDependency:
            growth = ratio ** (self.XTI / self.N) * exp((ratio - 1) * self.EG / scale)
        else:
            scale = self.Vt * 1.0
        shockley = self.Ids * (exlin(self.v / scale, self.Maxexp) - 1)
        yield self.vt_t == thermal
        yield self.id == shockley
        yield self.i == growth * shockley + self.v / self.R
        yield self.LossPower == self.v * self.i


class HeatingDiode(Diode):
    """Diode whose characteristic follows the temperature of its heat port (see `Diode`).

    >>> model = assemble("source.p - diode.p", "source.n - diode.n - ground.p", "diode.heatPort - hot.port",
    ...                  source=ConstantVoltage(V=0.1), ground=Ground(), diode=HeatingDiode(),
    ...                  hot=thermal.FixedTemperature(T=300.15))
    >>> close(run(model)["diode.i"][-1], 1e-6 * (np.exp(0.1 / (8.617333e-5 * 300.15)) - 1))
    True

    Source: Modelica.Electrical.Analog.Semiconductors.HeatingDiode.
    """

    useHeatPort: bool = True
    useTemperatureDependency: bool = True


class Diode2(ConditionalHeatPort, OnePort):
    """Diode with series resistance, breakdown and a forward voltage from which on it is linear.

    The thermal voltage is `Vt`, ``k T/q`` if not given; with `useHeatPort` it follows the temperature of the port.
    ``id = Ids (exp(vd/(N Vt)) - 1)`` below ``Vf + N Vt`` and its tangent above; for ``vd < -Bv/2`` the breakdown
    ``-Ids (exp(-(vd + Bv)/(N Vt)) + 1 - 2 exp(-Bv/(2 N Vt)))``; ``v = vd + Rs id``, ``i = id + Gp v``.

    >>> model = assemble("source.p - diode.p", "source.n - diode.n - ground.p", ground=Ground(), diode=Diode2(),
    ...                  source=RampVoltage(V=1.0, offset=-0.5, duration=1.0))
    >>> diode = run(model, at=[0.0, 1.0])
    >>> vd, id = np.array(diode["diode.vd"]), np.array(diode["diode.id"])
    >>> close(id, 1e-13 * (np.exp(vd / (8.617333e-5 * 293.15)) - 1)) and close(vd + 16 * id, [-0.5, 0.5])
    True

    Source: Modelica.Electrical.Analog.Semiconductors.Diode2.
    """

    Vf: Parameter = Parameter(0.7, unit="V", doc="forward voltage")
    Ids: Parameter = Parameter(1e-13, unit="A", doc="saturation current")
    Rs: Parameter = Parameter(16.0, unit="ohm", doc="series resistance")
    k_q: Parameter = Parameter(BOLTZMANN / CHARGE, unit="V/K", doc="Boltzmann constant over the elementary charge")
    Vt: Parameter = Parameter(k_q * ConditionalHeatPort.T, unit="V", doc="thermal voltage without a heat port")
    N: Parameter = Parameter(1.0, unit="1", doc="emission coefficient")
    Bv: Parameter = Parameter(100.0, unit="V", doc="breakdown voltage")
    Gp: Parameter = Parameter(1e-6, unit="S", doc="parallel conductance")
    vd: Variable = Variable(unit="V", start=0.0, doc="voltage of the diode without its series resistance")
    id: Variable = Variable(unit="A", doc="current of the diode without its parallel conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        thermal = self.N * (self.k_q * self.temperature if self.useHeatPort else self.Vt)
        top = self.Vf + thermal
        forward = self.Ids * (exlin(minimum(self.vd, top) / thermal, 1e300) - 1)
        forward = forward + maximum(self.vd - top, 0.0) * self.Ids * exp(top / thermal) / thermal
        low = minimum(self.vd, -self.Bv / 2)
        breakdown = -self.Ids * (exp(-(low + self.Bv) / thermal) + 1 - 2 * exp(-self.Bv / (2 * thermal)))
        yield self.id == where(self.vd < -self.Bv / 2, breakdown, forward)
        yield self.v == self.vd + self.Rs * self.id
        yield self.i == self.id + self.Gp * self.v
        yield self.LossPower == self.v * self.i


class ZDiode(ConditionalHeatPort, OnePort):
    """Zener diode, ``i = Ids (exp(v/Vt) - 1) - Ibv exp(-(v + Bv)/(Nbv Vt)) + v/R``, linear beyond `Maxexp`.

    >>> model = assemble("source.p - resistor.p", "resistor.n - diode.n", "source.n - diode.p - ground.p",
    ...                  source=ConstantVoltage(V=12.0), resistor=Resistor(R=100.0), diode=ZDiode(), ground=Ground())
    >>> 4.9 < run(model)["diode.n.v"][-1] < 5.1
    True

    Source: Modelica.Electrical.Analog.Semiconductors.ZDiode.
    """

    Ids: Parameter = Parameter(1e-6, unit="A", doc="saturation current")
    Vt: Parameter = Parameter(0.04, unit="V", doc="voltage equivalent of the temperature")
    Maxexp: Parameter = Parameter(30.0, unit="1", doc="exponent from which on the characteristic is linear")
    R: Parameter = Parameter(1e8, unit="ohm", doc="parallel resistance")
    Bv: Parameter = Parameter(5.1, unit="V", doc="breakthrough voltage")
    Ibv: Parameter = Parameter(0.7, unit="A", doc="current at the knee of the breakthrough")
    Nbv: Parameter = Parameter(0.74, unit="1", doc="emission coefficient of the breakthrough")

    def equations(self) -> Equations:
        yield from super().equations()
        forward = exlin(self.v / self.Vt, self.Maxexp) - 1
        breakthrough = exlin(-(self.v + self.Bv) / (self.Nbv * self.Vt), self.Maxexp)
        yield self.i == self.Ids * forward - self.Ibv * breakthrough + self.v / self.R
        yield self.LossPower == self.v * self.i
