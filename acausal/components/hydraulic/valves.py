"""Valves: directional, relief, check, and those of a load-sensing crane circuit."""

from __future__ import annotations

from acausal import Component, Equations, Expr, Input, Output, Parameter, Variable, clip, connect, where
from acausal import max as maximum

from .interfaces import HydraulicPort
from .orifices import PartialOrifice, VariableOrifice, orifice_flow


class PressureCompensator(VariableOrifice):
    """Pressure compensator (PCV) ahead of a directional valve: closes as that valve's pressure drop exceeds `p_comp`.

    ``area = A_full clip((p_comp + dp_close - (port_b.p - p_ls))/dp_close, 0, 1)``, flow as in `VariableOrifice`.

    >>> model = assemble("supply.port - valve.port_a", "valve.port_b - behind.port", "load.y - valve.p_ls",
    ...                  supply=Tank(p=2e7), behind=Tank(p=9.4e6), load=blocks.Constant(k=8e6), oil=ac.inner(Oil()),
    ...                  valve=PressureCompensator(A_full=4e-4, p_comp=1e6, dp_close=8e5))
    >>> run(model)["valve.area"][-1]  # half closed, as the drop behind is 1.4 MPa
    0.0002

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

    >>> model = assemble("spool.y - valve.u", "supply.port - valve.port_p", "tank.port - valve.port_t",
    ...                  "valve.port_a - load.port_a", "valve.port_b - load.port_b", spool=blocks.Constant(k=0.5),
    ...                  supply=Tank(p=1e7), tank=Tank(p=1e5), load=LaminarRestriction(G=1e-10), oil=ac.inner(Oil()),
    ...                  valve=DirectionalValve())
    >>> close(run(model)["valve.pa.q"][-1], run(model)["valve.bt.q"][-1], 1e-3)  # but for the leakage
    True

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

    >>> model = assemble("spool.y - valve.u", "load.port - valve.port_a", "valve.port_b - tank.port", load=Tank(p=5e6),
    ...                  spool=blocks.Slope(offset=0.0, slope=-1.0), tank=Tank(), oil=ac.inner(Oil()),
    ...                  valve=LoadControlValve(A_full=4e-4, o_low=0.3, u_change=0.05))
    >>> run(model)["valve.area"]
    [0.0004, 0.00012]

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


class TwoWayValve(VariableOrifice):
    """Proportional 2/2 valve between a and b, ``area = A_full clip(u, 0, 1)``, flow as in `VariableOrifice`.

    >>> model = assemble("supply.port - valve.port_a", "valve.port_b - tank.port", "spool.y - valve.u",
    ...                  tank=Tank(p=1e5), supply=Tank(p=4.35e6), spool=blocks.Slope(slope=2.0),
    ...                  oil=ac.inner(Oil(rho=850.0)), valve=TwoWayValve(A_full=1e-5, A_leak=0.0))
    >>> close(run(model, at=[0.0, 0.25, 1.0])["valve.q"], [0.0, 0.5 * 0.65e-3, 0.65e-3])
    True

    Source: Merritt, Hydraulic Control Systems (1967), Eq. 3-31, regularised at zero flow.
    """

    u: Input = Input(unit="1", doc="spool position, 0 closed to 1 open")
    A_full: Parameter = Parameter(1e-4, unit="m2", min=0.0, doc="area when open")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.area == self.A_full * clip(self.u, 0.0, 1.0)


class PartialPressureValve(PartialOrifice, partial=True):
    """Valve that a pressure difference opens against a spring, without inertia.

    ``opening = clip((p_open - p_crack)/dp_open, 0, 1)``, ``q = Cd (A_full opening + A_leak) sqrt(2/rho) dp/(dp^2 +
    p_tr^2)^(1/4)``; subclasses give the difference ``p_open``.

    Source: Merritt, Hydraulic Control Systems (1967), section 9.2, in the steady state.
    """

    A_full: Parameter = Parameter(1e-4, unit="m2", min=0.0, doc="area when fully open")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area")
    dp_open: Parameter = Parameter(1e5, unit="Pa", min=1e-30, doc="further pressure difference until fully open")
    opening: Variable = Variable(unit="1", doc="part of the area that is open")

    def opened(self, beyond: Expr) -> Equations:
        """Equations of a valve whose pressure difference is `beyond` that of cracking [Pa]."""
        area = self.A_full * self.opening + self.A_leak
        yield self.opening == clip(beyond / self.dp_open, 0.0, 1.0)
        yield self.q == orifice_flow(self.Cd, area, self.oil.rho, self.dp, self.p_tr)


class ReliefValve(PartialPressureValve):
    """Relief valve from a to b: opens as ``dp = port_a.p - port_b.p`` exceeds `p_set`, fully at ``p_set + dp_open``.

    >>> model = assemble("tank.port - pump.port_a - relief.port_b", "pump.port_b - relief.port_a", oil=ac.inner(Oil()),
    ...                  tank=Tank(p=1e5), pump=FixedPump(V_disp=1e-4, omega=20.0),
    ...                  relief=ReliefValve(p_set=20e6, dp_open=1e6))
    >>> values = run(model)
    >>> close(values["relief.dp"][-1], 20e6 + 1e6 * values["relief.opening"][-1])
    True

    Source: Merritt, Hydraulic Control Systems (1967), section 9.2, in the steady state.
    """

    p_set: Parameter = Parameter(25e6, unit="Pa", doc="pressure difference at which it begins to open")
    dp_open: Parameter = Parameter(1e6, unit="Pa", min=1e-30, doc="further pressure difference until fully open")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.opened(self.dp - self.p_set)


class CheckValve(PartialPressureValve):
    """Check valve: lets oil through from a to b, once ``dp`` exceeds that of the spring, `p_crack`.

    >>> model = assemble("pressure.y - source.p", "source.port - valve.port_a", "valve.port_b - tank.port",
    ...                  pressure=blocks.Slope(offset=-2e6, slope=4e6), source=PressureSource(), tank=Tank(p=0.0),
    ...                  valve=CheckValve(A_leak=0.0), oil=ac.inner(Oil()))
    >>> values = run(model, at=[0.0, 0.25, 0.75, 1.0])["valve.q"]
    >>> values[:2], close(values[2] / values[3], 0.5**0.5, 1e-3)
    ([0.0, 0.0], True)

    Source: Merritt, Hydraulic Control Systems (1967), Eq. 3-31, with an area that a spring closes.
    """

    p_crack: Parameter = Parameter(5e4, unit="Pa", doc="pressure difference at which it begins to open")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.opened(self.dp - self.p_crack)


class PilotOperatedCheckValve(PartialPressureValve):
    """Check valve from a to b that a pilot pressure opens for the way back, too: a load-holding valve.

    It begins to open at ``dp + ratio (port_x.p - port_a.p) = p_crack``.

    >>> model = assemble("load.port - valve.port_b", "tank.port - valve.port_a", "pilot.port - valve.port_x",
    ...                  load=Tank(p=1e7), tank=Tank(p=1e5), pilot=Tank(p=5e6), oil=ac.inner(Oil()),
    ...                  valve=PilotOperatedCheckValve(ratio=3.0))
    >>> run(model)["valve.q"][-1] < -1e-3
    True

    Source: pilot ratio as in Ivantysyn and Ivantysynova, Hydrostatic Pumps and Motors (2001), without inertia.
    """

    port_x: HydraulicPort = HydraulicPort()
    p_crack: Parameter = Parameter(5e4, unit="Pa", doc="pressure difference at which it begins to open")
    ratio: Parameter = Parameter(3.0, unit="1", min=0.0, doc="area of the pilot piston by that of the seat")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_x.q == 0
        yield from self.opened(self.dp + self.ratio * (self.port_x.p - self.port_a.p) - self.p_crack)


class PressureReducingValve(PartialPressureValve):
    """Reducing valve from a to b: closes as the pressure behind it rises from `p_set` to ``p_set + dp_open``.

    >>> model = assemble("supply.port - valve.port_a", "valve.port_b - load.port_a", "load.port_b - tank.port",
    ...                  supply=Tank(p=2e7), tank=Tank(p=0.0), load=LaminarRestriction(G=1e-10), oil=ac.inner(Oil()),
    ...                  valve=PressureReducingValve(p_set=5e6, dp_open=1e5))
    >>> 5e6 < run(model)["valve.port_b.p"][-1] < 5.1e6
    True

    Source: Merritt, Hydraulic Control Systems (1967), section 9.3, in the steady state.
    """

    p_set: Parameter = Parameter(5e6, unit="Pa", doc="pressure at b above which it begins to close")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.opened(self.p_set + self.dp_open - self.port_b.p)


class ShuttleValve(Component):
    """Shuttle valve: joins `port_c` to the one of a and b with the higher pressure, as for load sensing.

    ``opening_a = clip(1/2 + (port_a.p - port_b.p)/dp_open, 0, 1)``, that of b is the rest to 1.

    >>> model = assemble("one.port - shuttle.port_a", "two.port - shuttle.port_b", "shuttle.port_c - meter.port",
    ...                  one=Tank(p=5e6), two=Tank(p=8e6), shuttle=ShuttleValve(), meter=PressureSensor(),
    ...                  oil=ac.inner(Oil()))
    >>> close(run(model)["meter.p"][-1], 8e6)
    True

    Source: two seats and one ball, each seat by Eq. 13.
    """

    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    port_c: HydraulicPort = HydraulicPort()
    A_full: Parameter = Parameter(2e-5, unit="m2", min=0.0, doc="area of each seat when open")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area of each seat")
    dp_open: Parameter = Parameter(1e4, unit="Pa", min=1e-30, doc="pressure difference that moves the ball across")
    seat_a: VariableOrifice = VariableOrifice(A_leak=A_leak)
    seat_b: VariableOrifice = VariableOrifice(A_leak=A_leak)
    opening_a: Variable = Variable(unit="1", doc="part of seat a that is open")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.seat_a.port_a)
        yield connect(self.port_b, self.seat_b.port_a)
        yield connect(self.port_c, self.seat_a.port_b, self.seat_b.port_b)
        yield self.opening_a == clip(0.5 + (self.port_a.p - self.port_b.p) / self.dp_open, 0.0, 1.0)
        yield self.seat_a.area == self.A_full * self.opening_a
        yield self.seat_b.area == self.A_full * (1 - self.opening_a)
