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


class Orifice(PartialOrifice):
    """Orifice of constant area, ``q = Cd area sqrt(2/rho) dp/(dp^2 + p_tr^2)^(1/4)``.

    Source: Eq. 13, regularised at zero flow.
    """

    area: Parameter = Parameter(1e-4, unit="m2", min=0.0, doc="open area")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == orifice_flow(self.Cd, self.area, self.oil.rho, self.dp, self.p_tr)


class VariableOrifice(PartialOrifice):
    """Orifice whose open area is a signal; `A_leak` is open always.

    ``q = Cd (area + A_leak) sqrt(2/rho) dp/(dp^2 + p_tr^2)^(1/4)``.

    Source: Eq. 13, regularised at zero flow; modulated resistor of Fig. 8.
    """

    area: Input = Input(doc="open area without the leakage [m2]", nominal=1e-4)
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == orifice_flow(self.Cd, self.area + self.A_leak, self.oil.rho, self.dp, self.p_tr)
