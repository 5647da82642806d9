"""The crane as one bond graph: every part of `Crane` in place of its component model, as the paper draws them.

Ports between the parts are those of the component models, so that any part of one kind works with the others.
"""

from __future__ import annotations

from acausal import (
    PI,
    Component,
    Equations,
    Input,
    Output,
    Parameter,
    Variable,
    clip,
    connect,
    cos,
    outer,
    start,
    where,
)
from acausal import max as maximum
from acausal.components import bondgraph as bg
from acausal.components import hydraulic as hyd
from acausal.components import planar

from .supply import PartialSupply


class Boom(planar.PartialBoom):
    """A 1-junction of angular velocity, with the torque of the cylinder, the boom's inertia and its weight.

    Source: Fig. 9; Eqs. 18 and 19.
    """

    torque: bg.RotationalBond = bg.RotationalBond(inward=True)
    weight: bg.MSe = bg.MSe()
    inertia: bg.I = bg.I(I=planar.PartialBoom.I, f=start(nominal=0.1))
    rotation: bg.J1 = bg.J1(n_in=2, n_out=1)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.flange, self.torque.flange)
        yield connect(self.torque.bond, self.rotation.inp[0])
        yield connect(self.weight.port, self.rotation.inp[1])
        yield connect(self.rotation.out[0], self.inertia.port)
        yield self.weight.e == -self.m * self.g * self.r * cos(self.phi)


class PartialJoint(planar.PartialCylinderJoint, partial=True):
    """A modulated transformer between the force on the rod and the torque on the boom, whose modulus is the lever.

    Its half arrow points from the boom to the rod: so the modulus is `h`, which dead centres make zero, not 1/h.

    Source: Fig. 9; Eq. 17.
    """

    rod_end: bg.TranslationalBond = bg.TranslationalBond(inward=True)
    boom_end: bg.RotationalBond = bg.RotationalBond()
    lever: bg.MTF = bg.MTF()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.rod, self.rod_end.flange)
        yield connect(self.boom, self.boom_end.flange)
        yield connect(self.boom_end.bond, self.lever.port_a)
        yield self.lever.m == self.h


class CompliantJoint(PartialJoint):
    """A 0-junction of the force, with the spring and the damper of the gap between rod and boom.

    At the start the boom is at rest and the spring carries `F_start`.

    Source: Fig. 9; Eqs. 16 and 17.
    """

    k: Parameter = Parameter(2e8, unit="N/m", min=0.0, doc="stiffness of the constraint")
    c: Parameter = Parameter(2e6, unit="N*s/m", min=0.0, doc="damping of the constraint")
    F_start: Parameter = Parameter(0.0, unit="N", doc="force of the spring at the start")
    force: bg.J0 = bg.J0(n_in=2, n_out=1)
    gap: bg.J1 = bg.J1()
    spring: bg.C = bg.C(C=1.0 / k, e=start(nominal=1e5))
    damper: bg.R = bg.R(R=c)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.rod_end.bond, self.force.inp[0])
        yield connect(self.lever.port_b, self.force.inp[1])
        yield connect(self.force.out[0], self.gap.inp[0])
        yield connect(self.gap.out[0], self.spring.port)
        yield connect(self.gap.out[1], self.damper.port)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.k * self.s_rel == self.F_start
        yield self.spring.e == self.F_start
        yield self.boom_end.bond.f == 0


class RigidJoint(PartialJoint):
    """Rod and boom on one transformer, inertias of which one depends on the other (derivative causality).

    A bond graph knows velocities: that the positions agree is said of the start.

    Source: kinematics of Eq. 17 without the compliance of Eq. 16.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.rod_end.bond, self.lever.port_b)

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.s_rel == 0


class SimplifiedSupply(PartialSupply):
    """A modulated flow source and the effort source of the return line.

    Source: Fig. 6; Eq. 2.
    """

    pump: bg.MSf = bg.MSf()
    tank: bg.Se = bg.Se(e=PartialSupply.p_tank)
    side_a: bg.HydraulicBond = bg.HydraulicBond()
    side_b: bg.HydraulicBond = bg.HydraulicBond()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.pump.port, self.side_a.bond)
        yield connect(self.tank.port, self.side_b.bond)
        yield connect(self.side_a.port, self.port_a)
        yield connect(self.side_b.port, self.port_b)
        yield self.pump.f == self.u * self.V_disp * self.omega


class Pump(Component):
    """Flow source, modulated by the pressure that it delivers to.

    Source: Fig. 8; Eq. 5.
    """

    port: bg.BondPort = bg.BondPort()
    V_disp: Parameter = Parameter(2.5e-4, unit="m3", min=0.0, doc="displacement per revolution")
    omega: Parameter = Parameter(25.0, unit="1/s", doc="speed in revolutions per second")
    p_set: Parameter = Parameter(25e6, unit="Pa", doc="pressure set point, of no flow")
    dp_full: Parameter = Parameter(1e6, unit="Pa", min=1e-30, doc="deviation from the set point for full flow")
    source: bg.MSf = bg.MSf()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.source.port, self.port)
        yield self.source.f == self.V_disp * self.omega * clip((self.p_set - self.source.e) / self.dp_full, 0.0, 1.0)


class Volume(Component):
    """Capacitor of the oil in a constant volume.

    Source: Fig. 8; Eq. 6.
    """

    oil: hyd.Oil = outer(hyd.Oil())
    port: bg.BondPort = bg.BondPort()
    V: Parameter = Parameter(1e-3, unit="m3", min=1e-30, doc="volume")
    oil_c: bg.MC = bg.MC(e=start(1e5, nominal=1e6))
    p: Variable = Variable(unit="Pa", nominal=1e6, doc="pressure")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port, self.oil_c.port)
        yield self.oil_c.c == self.V / self.oil.B
        yield self.p == self.oil_c.e


class Pipe(Component):
    """C-I-C element: the oil's compliance in two halves, and between them a 1-junction of inertia and friction.

    Source: Fig. 8; Eqs. 6, 9, 10 and 11.
    """

    oil: hyd.Oil = outer(hyd.Oil())
    port_a: bg.BondPort = bg.BondPort()
    port_b: bg.BondPort = bg.BondPort()
    l: Parameter = Parameter(10.0, unit="m", min=1e-30, doc="length")  # noqa: E741
    d: Parameter = Parameter(0.038, unit="m", min=1e-30, doc="inner diameter")
    eps: Parameter = Parameter(5e-5, unit="m", min=0.0, doc="absolute roughness")
    half_a: Volume = Volume(V=PI / 8 * d**2 * l)
    half_b: Volume = Volume(V=PI / 8 * d**2 * l)
    node_a: bg.J0 = bg.J0()
    node_b: bg.J0 = bg.J0()
    slug: bg.J1 = bg.J1(n_out=3)
    inertia: bg.MI = bg.MI(f=start(nominal=1e-3))
    friction: bg.PipeFrictionR = bg.PipeFrictionR(law=hyd.BlendedFriction(l=l, d=d, eps=eps))
    p_a: Variable = Variable(unit="Pa", nominal=1e6, doc="pressure at port a")
    p_b: Variable = Variable(unit="Pa", nominal=1e6, doc="pressure at port b")
    q: Variable = Variable(unit="m3/s", nominal=1e-3, doc="volume flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.node_a.inp[0])
        yield connect(self.node_a.out[0], self.half_a.port)
        yield connect(self.node_a.out[1], self.slug.inp[0])
        yield connect(self.slug.out[0], self.inertia.port)
        yield connect(self.slug.out[1], self.friction.port)
        yield connect(self.slug.out[2], self.node_b.inp[0])
        yield connect(self.node_b.out[0], self.half_b.port)
        yield connect(self.node_b.out[1], self.port_b)
        yield self.inertia.i == self.oil.rho * self.l / (PI / 4 * self.d**2)
        yield self.p_a == self.half_a.p
        yield self.p_b == self.half_b.p
        yield self.q == self.slug.f


class Restriction(Component):
    """A 1-junction with a modulated resistor: one way through a valve.

    Source: Fig. 8; Eq. 13.
    """

    port_a: bg.BondPort = bg.BondPort()
    port_b: bg.BondPort = bg.BondPort()
    area: Input = Input(doc="open area without the leakage [m2]", nominal=1e-4)
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="pressure drop of the transition to laminar flow")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area")
    flow: bg.J1 = bg.J1()
    resistor: bg.OrificeR = bg.OrificeR(Cd=Cd, p_tr=p_tr, A_leak=A_leak)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.flow.inp[0])
        yield connect(self.flow.out[0], self.resistor.port)
        yield connect(self.flow.out[1], self.port_b)
        yield self.resistor.area == self.area


class PressureCompensator(Restriction):
    """Restriction that closes as the pressure drop behind it exceeds `p_comp`.

    Source: Fig. 8; section 3.2 of the paper.
    """

    p_ls: Input = Input(doc="load pressure behind the directional valve [Pa]", nominal=1e6)
    A_full: Parameter = Parameter(4e-4, unit="m2", min=0.0, doc="area when fully open")
    p_comp: Parameter = Parameter(1e6, unit="Pa", doc="compensation pressure: up to this drop fully open")
    dp_close: Parameter = Parameter(8e5, unit="Pa", min=1e-30, doc="further pressure drop until closed")

    def equations(self) -> Equations:
        yield from super().equations()
        drop = self.port_b.e - self.p_ls
        yield self.area == self.A_full * clip((self.p_comp + self.dp_close - drop) / self.dp_close, 0.0, 1.0)


class DirectionalValve(Component):
    """Four restrictions between 0-junctions of the pressures P, T, A and B.

    Source: Fig. 8; section 3.2 of the paper.
    """

    port_p: bg.BondPort = bg.BondPort()
    port_t: bg.BondPort = bg.BondPort()
    port_a: bg.BondPort = bg.BondPort()
    port_b: bg.BondPort = bg.BondPort()
    u: Input = Input(doc="spool position, -1 to 1")
    p_ls: Output = Output(nominal=1e6, doc="load-sensing pressure [Pa]")
    A_full: Parameter = Parameter(2.2e-4, unit="m2", min=0.0, doc="area at full stroke")
    r_b: Parameter = Parameter(0.8, unit="1", min=0.0, doc="area ratio of P to B")
    r_at: Parameter = Parameter(0.4, unit="1", min=0.0, doc="area ratio of A to T")
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="pressure drop of the transition to laminar flow")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area of each way")
    u_noise: Parameter = Parameter(1e-12, unit="1", min=0.0, doc="rounding of u: to -u_noise it counts as the middle")
    pa: Restriction = Restriction(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    at: Restriction = Restriction(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    pb: Restriction = Restriction(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    bt: Restriction = Restriction(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    p: bg.J0 = bg.J0()
    a: bg.J0 = bg.J0()
    b: bg.J0 = bg.J0()
    t: bg.J0 = bg.J0(n_in=2, n_out=1)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_p, self.p.inp[0])
        yield connect(self.p.out[0], self.pa.port_a)
        yield connect(self.p.out[1], self.pb.port_a)
        yield connect(self.pa.port_b, self.a.inp[0])
        yield connect(self.a.out[0], self.at.port_a)
        yield connect(self.a.out[1], self.port_a)
        yield connect(self.pb.port_b, self.b.inp[0])
        yield connect(self.b.out[0], self.bt.port_a)
        yield connect(self.b.out[1], self.port_b)
        yield connect(self.at.port_b, self.t.inp[0])
        yield connect(self.bt.port_b, self.t.inp[1])
        yield connect(self.t.out[0], self.port_t)
        yield self.pa.area == self.A_full * maximum(self.u, 0.0)
        yield self.bt.area == self.A_full * maximum(self.u, 0.0)
        yield self.pb.area == self.r_b * self.A_full * maximum(-self.u, 0.0)
        yield self.at.area == self.r_at * self.A_full * maximum(-self.u, 0.0)
        yield self.p_ls == where(self.u >= -self.u_noise, self.a.e, self.b.e)


class LoadControlValve(Restriction):
    """Restriction that is fully open when hoisting, partly open when lowering.

    Source: Fig. 8; section 3.2 of the paper.
    """

    u: Input = Input(doc="spool position of the directional valve, -1 to 1")
    A_full: Parameter = Parameter(4e-4, unit="m2", min=0.0, doc="area when hoisting")
    o_low: Parameter = Parameter(0.3, unit="1", min=0.0, max=1.0, doc="opening when lowering")
    u_change: Parameter = Parameter(0.05, unit="1", min=1e-30, doc="spool range of the change-over")

    def equations(self) -> Equations:
        yield from super().equations()
        opening = self.o_low + (1 - self.o_low) * clip(1 + self.u / self.u_change, 0.0, 1.0)
        yield self.area == self.A_full * opening


class ExtendedSupply(PartialSupply):
    """Pump, pipe, valves and the volumes between them.

    At the start nothing flows, the pump stands at its set point, the valves' volumes at the load pressure.

    Source: Fig. 8.
    """

    p_set: Parameter = Parameter(25e6, unit="Pa", doc="pressure set point of the pump")
    Cd: Parameter = Parameter(0.65, unit="1", min=0.0, doc="discharge coefficient of every valve")
    p_tr: Parameter = Parameter(1e4, unit="Pa", min=0.0, doc="laminar transition pressure of every valve")
    A_leak: Parameter = Parameter(1e-9, unit="m2", min=0.0, doc="leakage area of every valve")
    tank: bg.Se = bg.Se(e=PartialSupply.p_tank)
    pump: Pump = Pump(V_disp=PartialSupply.V_disp, omega=PartialSupply.omega, p_set=p_set)
    pipe: Pipe = Pipe()
    pcv: PressureCompensator = PressureCompensator(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    node_2: bg.J0 = bg.J0()
    volume_2: Volume = Volume(V=5e-4)
    dcv: DirectionalValve = DirectionalValve(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    node_3: bg.J0 = bg.J0()
    volume_3: Volume = Volume(V=1e-3)
    cbv: LoadControlValve = LoadControlValve(Cd=Cd, p_tr=p_tr, A_leak=A_leak)
    side_a: bg.HydraulicBond = bg.HydraulicBond()
    side_b: bg.HydraulicBond = bg.HydraulicBond()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.pump.port, self.pipe.port_a)
        yield connect(self.pipe.port_b, self.pcv.port_a)
        yield connect(self.pcv.port_b, self.node_2.inp[0])
        yield connect(self.node_2.out[0], self.volume_2.port)
        yield connect(self.node_2.out[1], self.dcv.port_p)
        yield connect(self.dcv.port_t, self.tank.port)
        yield connect(self.dcv.port_a, self.node_3.inp[0])
        yield connect(self.node_3.out[0], self.volume_3.port)
        yield connect(self.node_3.out[1], self.cbv.port_a)
        yield connect(self.cbv.port_b, self.side_a.bond)
        yield connect(self.dcv.port_b, self.side_b.bond)
        yield connect(self.side_a.port, self.port_a)
        yield connect(self.side_b.port, self.port_b)
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
