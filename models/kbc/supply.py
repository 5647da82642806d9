"""Oil supply of the crane's cylinder, in two implementations behind one interface."""

from __future__ import annotations

from acausal import Component, Equations, Input, Parameter, connect, outer
from acausal.components import hydraulic as hyd


class PartialSupply(Component, partial=True):
    """Drives a double-acting cylinder by the flow gain `u`, -1 to 1: positive fills side A.

    Source: Fig. 5 of the paper.
    """

    port_a: hyd.HydraulicPort = hyd.HydraulicPort()
    port_b: hyd.HydraulicPort = hyd.HydraulicPort()
    u: Input = Input(doc="flow gain")
    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement of the pump per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed of the pump in revolutions per second")
    p_tank: Parameter = Parameter(1e5, unit="Pa", doc="pressure in the tank")


class SimplifiedSupply(PartialSupply):
    """Pump flow proportional to `u`, straight into side A; side B returns to the tank.

    Source: section 3.1 of the paper, Fig. 6, Eq. 2.
    """

    tank: hyd.Tank = hyd.Tank(p=PartialSupply.p_tank)
    pump: hyd.MeteringPump = hyd.MeteringPump(V_disp=PartialSupply.V_disp, omega=PartialSupply.omega)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.tank.port, self.pump.port_a, self.port_b)
        yield connect(self.pump.port_b, self.port_a)
        yield self.pump.u == self.u


class ExtendedSupply(PartialSupply):
    """Pressure-compensated pump, pipe, pressure compensator, directional valve and load control valve.

    At the start nothing flows, the pump stands at its set point, the valves' volumes at the load pressure.

    Source: section 3.2 of the paper, Figs. 7 and 8.
    """

    oil: hyd.Oil = outer(hyd.Oil())
    p_set: Parameter = Parameter(25e6, unit="Pa", doc="pressure set point of the pump")
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient of every valve")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="laminar transition pressure of every valve")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area of every valve")
    tank: hyd.Tank = hyd.Tank(p=PartialSupply.p_tank)
    pump: hyd.PressureCompensatedPump = hyd.PressureCompensatedPump(
        V_disp=PartialSupply.V_disp, omega=PartialSupply.omega, p_set=p_set, dp_full=1e6
    )
    pipe: hyd.Pipe = hyd.Pipe(l=10.0, d=0.038, eps=5e-5)
    pcv: hyd.PressureCompensator = hyd.PressureCompensator(
        A_full=4e-4, p_comp=1e6, dp_close=8e5, Cd=Cd, p_tr=p_tr, A_leak=A_leak
    )
    volume_2: hyd.ControlVolume = hyd.ControlVolume(V=5e-4)
    dcv: hyd.DirectionalValve = hyd.DirectionalValve(A_full=2.2e-4, r_b=0.8, r_at=0.4, Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    volume_3: hyd.ControlVolume = hyd.ControlVolume(V=1e-3)
    cbv: hyd.LoadControlValve = hyd.LoadControlValve(
        A_full=4e-4, o_low=0.3, u_change=0.05, Cd=Cd, p_tr=p_tr, A_leak=A_leak
    )

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.tank.port, self.pump.port_a, self.dcv.port_t)
        yield connect(self.pump.port_b, self.pipe.port_a)
        yield connect(self.pipe.port_b, self.pcv.port_a)
        yield connect(self.pcv.port_b, self.volume_2.port, self.dcv.port_p)
        yield connect(self.dcv.port_a, self.volume_3.port, self.cbv.port_a)
        yield connect(self.cbv.port_b, self.port_a)
        yield connect(self.dcv.port_b, self.port_b)
        yield self.dcv.u == self.u
        yield self.cbv.u == self.u
        yield self.pcv.p_ls == self.dcv.p_ls

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.pipe.p_a == self.p_set
        yield self.pipe.p_b == self.p_set
        yield self.pipe.q == 0
        yield self.volume_3.p == self.port_a.p
        yield self.volume_2.p == self.volume_3.p + self.pcv.p_comp
