"""Orifices: flow through a sharp edge, fixed or moved by a signal."""

from __future__ import annotations

from acausal import Equations, Expr, Input, Parameter, outer, sqrt

from .interfaces import Oil, PartialTwoPort


def orifice_flow(Cd: Expr, area: Expr, rho: Expr, dp: Expr, p_tr: Expr) -> Expr:
    """Volume flow rate through an orifice [m3/s], odd and smooth in `dp`.

    ``q = Cd A sqrt(2/rho) dp / (dp^2 + p_tr^2)^(1/4)``, which is Eq. 13, ``Cd A sqrt(2 |dp|/rho)``, for ``|dp| >>
    p_tr`` and laminar around zero, where the root has an infinite slope.

    Args:
        Cd: discharge coefficient [1].
        area: open area [m2].
        rho: density [kg/m3].
        dp: pressure drop [Pa].
        p_tr: pressure drop of the transition to laminar flow [Pa].
    """
    return Cd * area * sqrt(2 / rho) * dp / sqrt(sqrt(dp**2 + p_tr**2))


class PartialOrifice(PartialTwoPort, partial=True):
    """Orifice; subclasses supply its open area in ``q = orifice_flow(Cd, area, rho, dp, p_tr)``.

    Source: Eq. 13, regularised at zero flow.
    """

    oil: Oil = outer(Oil())
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="pressure drop of the transition to laminar flow")


class LaminarRestriction(PartialTwoPort):
    """Narrow gap with laminar flow, ``q = G dp``.

    >>> model = assemble("tank.port - gap.port_a", "gap.port_b - drain.port", tank=Tank(p=3e5), drain=Tank(p=1e5),
    ...                  gap=LaminarRestriction(G=1e-9))
    >>> run(model)["gap.q"][-1]
    0.0002

    Source: Merritt, Hydraulic Control Systems (1967), section 3.2, Hagen-Poiseuille.
    """

    G: Parameter = Parameter(1e-10, unit="m3/(s*Pa)", min=0.0, doc="conductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.G * self.dp


class Orifice(PartialOrifice):
    """Orifice of constant area, ``q = Cd area sqrt(2/rho) dp/(dp^2 + p_tr^2)^(1/4)``.

    >>> model = assemble("supply.port - orifice.port_a", "orifice.port_b - tank.port", supply=Tank(p=4.35e6),
    ...                  tank=Tank(p=1e5), orifice=Orifice(area=1e-5), oil=ac.inner(Oil(rho=850.0)))
    >>> close(run(model)["orifice.q"][-1], 0.65 * 1e-5 * 100.0)
    True

    Source: Eq. 13, regularised at zero flow.
    """

    area: Parameter = Parameter(1e-4, unit="m2", min=0.0, doc="open area")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == orifice_flow(self.Cd, self.area, self.oil.rho, self.dp, self.p_tr)


class VariableOrifice(PartialOrifice):
    """Orifice whose open area is a signal; `A_leak` is open always.

    ``q = Cd (area + A_leak) sqrt(2/rho) dp/(dp^2 + p_tr^2)^(1/4)``.

    >>> model = assemble("supply.port - valve.port_a", "valve.port_b - tank.port", "opening.y - valve.area",
    ...                  supply=Tank(p=4.35e6), tank=Tank(p=1e5), valve=VariableOrifice(A_leak=0.0),
    ...                  opening=blocks.Slope(slope=1e-5), oil=ac.inner(Oil(rho=850.0)))
    >>> close(run(model)["valve.q"], [0.0, 0.65 * 1e-5 * 100.0])
    True

    Source: Eq. 13, regularised at zero flow; modulated resistor of Fig. 8.
    """

    area: Input = Input(doc="open area without the leakage [m2]", nominal=1e-4)
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == orifice_flow(self.Cd, self.area + self.A_leak, self.oil.rho, self.dp, self.p_tr)
