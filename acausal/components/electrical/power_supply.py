"""A power supply that limits voltage, power and current."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Expr, Parameter, Variable, where

from .interfaces import TwoPin


class DCPowerSupply(TwoPin):
    """Power supply of constant voltage, constant power and constant current, one after the other as the load grows.

    Constant voltage ``v = V0 + Rcv i`` up to the current `iLim`, constant current ``-i = I0 - Gcc v`` up to the voltage
    `vLim`, between them constant power ``-v i = P0``, if the other two would give more. `i` is negative when delivered;
    neither ``v < 0`` nor ``i > iBack`` is allowed.

    >>> model = assemble("supply.p - load.p", "supply.n - load.n - ground.p", "ramp.y - load.R", ground=Ground(),
    ...                  supply=DCPowerSupply(V0=60.0, I0=50.0, P0=1200.0, Rcv=1e-9, Gcc=1e-9),
    ...                  load=VariableResistor(), ramp=blocks.Slope(offset=4.0, slope=-3.9))
    >>> close(run(model, at=[0.0, 0.5, 1.0])["supply.i"], [-15.0, -((1200 / 2.05) ** 0.5), -50.0])
    True

    Source: Modelica.Electrical.Analog.Sources.DCPowerSupply.
    """

    V0: Parameter = Parameter(60.0, unit="V", min=1e-15, doc="voltage without load")
    I0: Parameter = Parameter(50.0, unit="A", min=1e-15, doc="current of a short circuit")
    P0: Parameter = Parameter(1200.0, unit="W", min=1e-15, doc="largest power")
    Rcv: Parameter = Parameter(1e-3, unit="ohm", min=1e-15, doc="inner resistance at constant voltage")
    Gcc: Parameter = Parameter(1e-3, unit="S", min=1e-15, doc="inner conductance at constant current")
    iBack: Parameter = Parameter(1e-3, unit="A", doc="current back into the supply that is allowed")
    v: Variable = Variable(unit="V", start=V0, doc="voltage from p to n")
    i: Variable = Variable(unit="A", start=-P0 / V0, doc="current into p")
    P: Variable = Variable(unit="W", doc="power, negative when delivered")

    @property
    def corner(self) -> tuple[Expr, Expr]:
        """Voltage and current where constant voltage and constant current meet without a limit of the power."""
        rest = 1 - self.Rcv * self.Gcc
        return (self.V0 - self.Rcv * self.I0) / rest, (self.I0 - self.Gcc * self.V0) / rest

    def equations(self) -> Equations:
        yield from super().equations()
        v, i = self.corner
        powered = v * i > self.P0
        # with a limit of the power: where its hyperbola meets the two lines, in a form without cancellation
        v_power = 2 * self.P0 / (self.I0 + ac.sqrt(ac.max(self.I0**2 - 4 * self.Gcc * self.P0, 0.0)))
        i_power = 2 * self.P0 / (self.V0 + ac.sqrt(ac.max(self.V0**2 - 4 * self.Rcv * self.P0, 0.0)))
        v_limit, i_limit = where(powered, v_power, v), where(powered, i_power, i)
        yield ac.assert_(self.Rcv < self.V0 / self.I0, "Rcv too high!")
        yield ac.assert_(self.Gcc < self.I0 / self.V0, "Gcc too high!")
        yield ac.assert_(self.v >= 0, "Only voltages >= 0 are allowed.")
        yield ac.assert_(self.i <= self.iBack, "The current back into the supply is too large.")
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0
        yield self.P == self.v * self.i
        constant_voltage = (self.v - self.V0 - self.Rcv * self.i) / self.V0
        constant_current = (self.i + self.I0 - self.Gcc * self.v) / self.I0
        constant_power = 1 + self.v * self.i / self.P0
        beyond = where(powered & (self.v > v_limit), constant_power, constant_current)
        yield where(-self.i <= i_limit, constant_voltage, beyond) == 0
