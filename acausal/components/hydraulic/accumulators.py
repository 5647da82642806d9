"""Accumulators."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, der, outer, where

from .interfaces import HydraulicPort, Oil, not_torn


class Accumulator(Component):
    """Bladder accumulator: a gas behind the oil, ``p V_gas^n = p_pre V0^n`` above the precharge pressure.

    ``(V_gas/(n p) + V_dead/B) dp/dt = port.q``. Below the precharge pressure the bladder lies on its stop, and there
    is the oil of the dead volume alone. ``n = 1`` is slow (isothermal), 1.4 fast (adiabatic).

    >>> model = assemble("tank.port - pump.port_a", "pump.port_b - store.port", oil=ac.inner(Oil()), tank=Tank(),
    ...                  pump=FixedPump(V_disp=1e-4, omega=10.0), store=Accumulator(V0=4e-3, p_pre=8e6, n=1.0,
    ...                  V_dead=1e-9, p=start(8e6, fixed=True)))
    >>> close(run(model)["store.p"], [8e6, 8e6 * 4e-3 / 3e-3])
    True

    Source: polytropic gas; Modelica names as in OpenHydraulics.Components.Volumes.Accumulator.
    """

    port: HydraulicPort = HydraulicPort()
    oil: Oil = outer(Oil())
    V0: Parameter = Parameter(1e-2, unit="m3", min=1e-30, doc="volume of the gas at the precharge pressure")
    p_pre: Parameter = Parameter(5e6, unit="Pa", min=1.0, doc="precharge pressure of the gas")
    n: Parameter = Parameter(1.4, unit="1", min=1.0, doc="polytropic exponent of the gas")
    V_dead: Parameter = Parameter(1e-4, unit="m3", min=1e-30, doc="oil ahead of the bladder on its stop")
    p: Variable = Variable(unit="Pa", start=1e5, nominal=1e6, doc="pressure of the oil")
    V_gas: Variable = Variable(unit="m3", nominal=1e-3, doc="volume of the gas")

    def equations(self) -> Equations:
        yield from super().equations()
        floating = self.p >= self.p_pre
        yield self.p == self.port.p
        yield self.V_gas == self.V0 * where(floating, (self.p_pre / self.p) ** (1 / self.n), 1.0)
        compliance = where(floating, self.V_gas / (self.n * self.p), 0.0) + self.V_dead / self.oil.B
        yield compliance * der(self.p) == self.port.q
        yield from not_torn(self.p)
