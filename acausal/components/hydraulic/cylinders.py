"""Chambers and double-acting cylinders."""

from __future__ import annotations

from acausal import PI, Component, Equations, Parameter, Variable, assert_, connect, der, noevent, outer, start

from .. import translational
from .interfaces import HydraulicPort, Oil, not_torn


class Chamber(Component):
    """Cylinder chamber: oil that is compressed by inflow and by the piston, which it pushes.

    With ``orientation = 1`` the volume grows with the piston's position s, ``V = V0 + A s``, and the oil pushes towards
    increasing s; with ``orientation = -1`` it shrinks, ``V = V0 + A (stroke - s)``.
    ``V/B dp/dt = port.q - dV/dt``; force on the piston ``orientation p A``.

    >>> model = assemble("piston.flange - chamber.flange", "way.y - piston.s_ref", oil=ac.inner(Oil(B=1e9)),
    ...                  piston=translational.Position(exact=True), way=blocks.Slope(slope=-0.1),
    ...                  chamber=Chamber(A=1e-2, V0=5e-3, p=start(1e5, fixed=True)))
    >>> close(run(model)["chamber.p"], [1e5, 1e5 - 1e9 * np.log(4e-3 / 5e-3)])
    True

    Source: Eqs. 7 and 8.
    """

    orientation: int = 1
    port: HydraulicPort = HydraulicPort()
    flange: translational.Flange = translational.Flange()
    oil: Oil = outer(Oil())
    A: Parameter = Parameter(1e-2, unit="m2", min=0.0, doc="piston area")
    V0: Parameter = Parameter(5e-3, unit="m3", min=0.0, doc="dead volume")
    stroke: Parameter = Parameter(1.0, unit="m", min=0.0, doc="stroke of the piston")
    p: Variable = Variable(unit="Pa", start=1e5, nominal=1e6, doc="pressure")
    V: Variable = Variable(unit="m3", nominal=1e-2, doc="volume of the oil")

    def equations(self) -> Equations:
        yield from super().equations()
        s, velocity = self.flange.s, der(self.flange.s)
        yield self.p == self.port.p
        if self.orientation > 0:
            yield self.V == self.V0 + self.A * s
            yield der(self.p) == self.oil.B / self.V * (self.port.q - self.A * velocity)
            yield self.flange.f == -self.p * self.A
        else:
            yield self.V == self.V0 + self.A * (self.stroke - s)
            yield der(self.p) == self.oil.B / self.V * (self.port.q + self.A * velocity)
            yield self.flange.f == self.p * self.A
        yield from not_torn(self.p)
        yield assert_(
            noevent(self.V > 0.0), "the piston is beyond the end of the chamber, whose volume is not positive"
        )


class PartialCylinder(Component, partial=True):
    """Double-acting cylinder in the housing; `port_a` on the bore side, `port_b` on the rod side, `flange` on the rod.

    The piston's position `x` counts from the retracted end; `-flange.f` is the force of the rod on what is connected,
    positive when it pushes. ``area_a = pi/4 bore^2``, ``area_b = area_a - pi/4 rod^2``.

    Source: Fig. 3; Eqs. 1, 7 and 8.
    """

    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    flange: translational.Flange = translational.Flange()
    bore: Parameter = Parameter(0.25, unit="m", min=1e-30, doc="diameter of the bore")
    rod: Parameter = Parameter(0.18, unit="m", min=0.0, doc="diameter of the rod")
    F_start: Parameter = Parameter(0.0, unit="N", doc="load that the pressures balance at the start")
    p_b_start: Parameter = Parameter(1e5, unit="Pa", doc="pressure on the rod side at the start")
    area_a: Parameter = Parameter(PI / 4 * bore**2, unit="m2", doc="piston area on the bore side")
    area_b: Parameter = Parameter(area_a - PI / 4 * rod**2, unit="m2", doc="piston area on the rod side")
    p_a_start: Parameter = Parameter(
        (F_start + p_b_start * area_b) / area_a, unit="Pa", doc="pressure on the bore side"
    )
    x: Variable = Variable(unit="m", start=1.0, doc="displacement of the piston from the retracted end")
    v: Variable = Variable(unit="m/s", nominal=0.1, doc="velocity of the piston")
    p_a: Variable = Variable(unit="Pa", nominal=1e6, start=p_a_start, doc="pressure in chamber a")
    p_b: Variable = Variable(unit="Pa", nominal=1e6, start=p_b_start, doc="pressure on the rod side")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.x == self.flange.s
        yield self.v == der(self.flange.s)
        yield self.p_a == self.port_a.p
        yield self.p_b == self.port_b.p


class SimplifiedCylinder(PartialCylinder):
    """Incompressible oil, no mass: ``port_a.q = area_a v``, ``port_b.q = -area_b v``, ``p_a area_a = p_b area_b -
    flange.f``.

    >>> model = assemble("pump.port - cylinder.port_a", "tank.port - cylinder.port_b", "cylinder.flange - load.flange",
    ...                  pump=Tank(p=2e6), tank=Tank(p=0.0), load=translational.PointMass(m=1e3),
    ...                  cylinder=SimplifiedCylinder(bore=0.2, x=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.0, 0.1])["cylinder.v"][-1], 2e6 * np.pi / 4 * 0.2**2 / 1e3 * 0.1)
    True

    Source: Eqs. 1, 3 and 4.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port_a.q == self.area_a * self.v
        yield self.port_b.q == -self.area_b * self.v
        yield self.p_a * self.area_a == self.p_b * self.area_b - self.flange.f


class ExtendedCylinder(PartialCylinder):
    """Compressible oil in both chambers, piston with mass and viscous friction, bumpers at both ends.

    ``m dv/dt = p_a area_a - p_b area_b + F_bumper - c v + flange.f``.
    At the start the piston is at rest, and the pressures balance the load `F_start`.

    >>> model = assemble("cylinder.flange - load.flange", oil=ac.inner(Oil()),
    ...                  cylinder=ExtendedCylinder(F_start=1e5, x=start(0.8, fixed=True)),
    ...                  load=translational.ConstantForce(f_constant=-1e5))
    >>> run(model)["cylinder.x"]  # the oil in the closed chambers carries the load
    [0.8, 0.8]

    Source: Eqs. 7, 8, 14 and 15.
    """

    stroke: Parameter = Parameter(2.0, unit="m", min=0.0, doc="stroke")
    Va0: Parameter = Parameter(5e-3, unit="m3", min=0.0, doc="dead volume on the bore side")
    Vb0: Parameter = Parameter(5e-3, unit="m3", min=0.0, doc="dead volume on the rod side")
    m: Parameter = Parameter(400.0, unit="kg", min=0.0, doc="mass of the piston")
    c: Parameter = Parameter(5e4, unit="N*s/m", min=0.0, doc="viscous friction of the piston")
    k_bumper: Parameter = Parameter(1e8, unit="N/m", min=0.0, doc="stiffness of the bumpers")
    c_bumper: Parameter = Parameter(4e5, unit="N*s/m", min=0.0, doc="damping of the bumpers")
    chamber_a: Chamber = Chamber(
        A=PartialCylinder.area_a, V0=Va0, stroke=stroke, p=start(PartialCylinder.p_a_start, fixed=True)
    )
    chamber_b: Chamber = Chamber(
        orientation=-1, A=PartialCylinder.area_b, V0=Vb0, stroke=stroke, p=start(PartialCylinder.p_b_start, fixed=True)
    )
    piston: translational.PointMass = translational.PointMass(m=m, v=start(0.0, fixed=True, nominal=0.1))
    friction: translational.ViscousFriction = translational.ViscousFriction(d=c)
    bumpers: translational.EndStops = translational.EndStops(s_max=stroke, k=k_bumper, c=c_bumper)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.chamber_a.port)
        yield connect(self.port_b, self.chamber_b.port)
        yield connect(
            self.flange,
            self.piston.flange,
            self.chamber_a.flange,
            self.chamber_b.flange,
            self.friction.flange,
            self.bumpers.flange,
        )
