"""Valves of a load-sensing crane circuit: pressure compensator, directional valve, load control valve."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Parameter, clip, connect, where
from acausal import max as maximum

from .interfaces import HydraulicPort
from .orifices import VariableOrifice


class PressureCompensator(VariableOrifice):
    """Pressure compensator (PCV) ahead of a directional valve: closes as that valve's pressure drop exceeds `p_comp`.

    ``area = A_full clip((p_comp + dp_close - (port_b.p - p_ls))/dp_close, 0, 1)``, flow as in `VariableOrifice`.

    Source: section 3.2 of the paper, whose sentence has the sign the other way round; modulated resistor of Fig. 8.
    """

    p_ls: Input = Input(doc="load pressure behind the directional valve [Pa]", nominal=1e6)
    A_full: Parameter = Parameter(4e-4, unit="m2", min=0.0, doc="area when fully open")
    p_comp: Parameter = Parameter(1e6, unit="Pa", doc="compensation pressure: up to this drop fully open")
    dp_close: Parameter = Parameter(8e5, unit="Pa", min=1e-30, doc="further pressure drop until closed")

    def equations(self) -> Equations:
        yield from super().equations()
        drop = self.port_b.p - self.p_ls
        yield self.area == self.A_full * clip((self.p_comp + self.dp_close - drop) / self.dp_close, 0.0, 1.0)


class DirectionalValve(Component):
    """Proportional 4/3 directional valve (DCV), closed in the middle; u > 0 joins P to A and B to T, u < 0 P to B and
    A to T.

    Areas ``P-A: A_full u+``, ``B-T: A_full u+``, ``P-B: r_b A_full u-``, ``A-T: r_at A_full u-``, with ``u+ = max(u,
    0)``, ``u- = max(-u, 0)``; each way leaks. Load-sensing pressure ``p_ls`` is that of the working port that P is
    joined to.

    Source: section 3.2 of the paper; orifices by Eq. 13.
    """

    port_p: HydraulicPort = HydraulicPort()
    port_t: HydraulicPort = HydraulicPort()
    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    u: Input = Input(doc="spool position, -1 to 1")
    p_ls: Output = Output(unit="Pa", nominal=1e6, doc="load-sensing pressure")
    A_full: Parameter = Parameter(2.2e-4, unit="m2", min=0.0, doc="area at full stroke")
    r_b: Parameter = Parameter(0.8, unit="1", min=0.0, doc="area ratio of P to B")
    r_at: Parameter = Parameter(0.4, unit="1", min=0.0, doc="area ratio of A to T")
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="pressure drop of the transition to laminar flow")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area of each way")
    u_noise: Parameter = Parameter(
        1e-12, unit="1", min=0.0, doc="rounding of u: up to -u_noise it counts as the middle"
    )
    pa: VariableOrifice = VariableOrifice(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    at: VariableOrifice = VariableOrifice(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    pb: VariableOrifice = VariableOrifice(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    bt: VariableOrifice = VariableOrifice(Cd=Cd, p_tr=p_tr, A_leak=A_leak)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_p, self.pa.port_a, self.pb.port_a)
        yield connect(self.port_t, self.at.port_b, self.bt.port_b)
        yield connect(self.port_a, self.pa.port_b, self.at.port_a)
        yield connect(self.port_b, self.pb.port_b, self.bt.port_a)
        yield self.pa.area == self.A_full * maximum(self.u, 0.0)
        yield self.bt.area == self.A_full * maximum(self.u, 0.0)
        yield self.pb.area == self.r_b * self.A_full * maximum(-self.u, 0.0)
        yield self.at.area == self.r_at * self.A_full * maximum(-self.u, 0.0)
        yield self.p_ls == where(self.u >= -self.u_noise, self.port_a.p, self.port_b.p)


class LoadControlValve(VariableOrifice):
    """Load control (counterbalance) valve (CBV): fully open when hoisting, partly open when lowering.

    ``area = A_full (o_low + (1 - o_low) clip(1 + u/u_change, 0, 1))``, flow as in `VariableOrifice`.

    Source: section 3.2 of the paper; modulated resistor of Fig. 8.
    """

    u: Input = Input(doc="spool position of the directional valve, -1 to 1")
    A_full: Parameter = Parameter(4e-4, unit="m2", min=0.0, doc="area when hoisting")
    o_low: Parameter = Parameter(0.3, unit="1", min=0.0, max=1.0, doc="opening when lowering")
    u_change: Parameter = Parameter(0.05, unit="1", min=1e-30, doc="spool range of the change-over")

    def equations(self) -> Equations:
        yield from super().equations()
        opening = self.o_low + (1 - self.o_low) * clip(1 + self.u / self.u_change, 0.0, 1.0)
        yield self.area == self.A_full * opening
