"""Resistors of oil hydraulics: effort is a pressure, flow a volume flow rate."""

from __future__ import annotations

from acausal import Equations, Input, Parameter, outer

from .. import hydraulic
from .elements import OnePort


class OrificeR(OnePort):
    """Orifice whose open area is a signal, ``f = Cd (area + A_leak) sqrt(2/rho) e/(e^2 + p_tr^2)^(1/4)``.

    >>> model = assemble("source.port - valve.port", "opening.y - valve.area", oil=ac.inner(hydraulic.Oil()),
    ...                  source=Se(e=4.25e6), valve=OrificeR(), opening=blocks.Constant(k=1e-4))
    >>> close(run(model)["valve.f"][-1], 6.5e-3)
    True

    Source: Eq. 13, regularised at zero flow; modulated resistor of Fig. 8.
    """

    oil: hydraulic.Oil = outer(hydraulic.Oil())
    area: Input = Input(doc="open area without the leakage [m2]", nominal=1e-4)
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="pressure drop of the transition to laminar flow")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area")

    def equations(self) -> Equations:
        yield from super().equations()
        area = self.area + self.A_leak
        yield self.f == hydraulic.orifice_flow(self.Cd, area, self.oil.rho, self.e, self.p_tr)


class PipeFrictionR(OnePort):
    """Resistor of a pipe, ``e = law.dp(f)``, with one of the laws of `hydraulic`.

    >>> model = assemble("source.port - pipe.port", oil=ac.inner(hydraulic.Oil()), source=Sf(f=1e-3),
    ...                  pipe=PipeFrictionR(law=hydraulic.LaminarFriction(d=0.05)))
    >>> close(run(model)["pipe.e"][-1], 128 * 46e-6 * 850 * 10.0 * 1e-3 / (np.pi * 0.05**4))
    True

    Source: Eqs. 11 and 12; resistor of Fig. 8.
    """

    law: hydraulic.PartialFriction = hydraulic.BlendedFriction()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.law.q == self.f
        yield self.e == self.law.dp
