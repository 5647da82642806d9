"""The cylinders of the hydraulic library as bond graphs."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Input, Parameter, Variable, connect, start, where

from .. import hydraulic
from .adapters import HydraulicBond, TranslationalBond
from .elements import J0, J1, MC, TF, I, OnePort, R


class Bumpers(OnePort):
    """Springs and dampers beyond both ends of a stroke: ``e = k x + c f`` for ``x < 0``, ``e = k (x - stroke) + c f``
    beyond it, else 0; `x` is a signal.

    >>> model = assemble("speed.port - bumpers.port", "way.y - bumpers.x", speed=Sf(f=0.5), way=blocks.Slope(slope=0.5),
    ...                  bumpers=Bumpers(k=100.0, c=10.0, stroke=0.3))
    >>> close(run(model, at=[0.5, 1.0])["bumpers.e"], [0.0, 25.0])
    True

    Source: Eq. 15, with contact without a gap.
    """

    x: Input = Input(doc="position, from the lower end")
    k: Parameter = Parameter(1e8, doc="stiffness")
    c: Parameter = Parameter(4e5, doc="damping")
    stroke: Parameter = Parameter(1.0, doc="position of the upper end")

    def equations(self) -> Equations:
        yield from super().equations()
        low = self.k * self.x + self.c * self.f
        high = self.k * (self.x - self.stroke) + self.c * self.f
        yield self.e == where(self.x < 0, low, where(self.x > self.stroke, high, 0.0))


class PartialBondGraphCylinder(hydraulic.PartialCylinder, partial=True):
    """Cylinder whose piston is a 1-junction between two transformers: pressure to force by the areas.

    Source: Fig. 3, simplified implementation as a bond graph.
    """

    side_a: HydraulicBond = HydraulicBond()
    side_b: HydraulicBond = HydraulicBond()
    area_a_tf: TF = TF(m=1 / hydraulic.PartialCylinder.area_a)
    area_b_tf: TF = TF(m=1.0 * hydraulic.PartialCylinder.area_b)
    rod_end: TranslationalBond = TranslationalBond()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.port_a, self.side_a.port)
        yield connect(self.port_b, self.side_b.port)
        yield connect(self.flange, self.rod_end.flange)


class SimplifiedCylinder(PartialBondGraphCylinder):
    """The simplified cylinder as a bond graph: incompressible oil, no mass; equal to `hydraulic.SimplifiedCylinder`.

    >>> model = assemble("pump.port - cylinder.port_a", "tank.port - cylinder.port_b", "cylinder.flange - load.flange",
    ...                  pump=hydraulic.Tank(p=2e6), tank=hydraulic.Tank(p=0.0),
    ...                  cylinder=SimplifiedCylinder(bore=0.2, x=start(0.0, fixed=True)),
    ...                  load=translational.PointMass(m=1e3, v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.0, 0.1])["cylinder.v"][-1], 2e6 * np.pi / 4 * 0.2**2 / 1e3 * 0.1)
    True

    Source: Eqs. 1, 3 and 4; Fig. 3.
    """

    piston: J1 = J1()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.side_a.bond, self.area_a_tf.port_a)
        yield connect(self.area_a_tf.port_b, self.piston.inp[0])
        yield connect(self.piston.out[0], self.area_b_tf.port_a)
        yield connect(self.area_b_tf.port_b, self.side_b.bond)
        yield connect(self.piston.out[1], self.rod_end.bond)


class ExtendedCylinder(PartialBondGraphCylinder):
    """The extended cylinder as a bond graph: equal to `hydraulic.ExtendedCylinder`.

    >>> model = assemble("cylinder.flange - load.flange", oil=ac.inner(hydraulic.Oil()),
    ...                  cylinder=ExtendedCylinder(F_start=1e5, x=start(0.8, fixed=True)),
    ...                  load=translational.ConstantForce(f_constant=-1e5))
    >>> run(model)["cylinder.x"]  # the oil in the closed chambers carries the load
    [0.8, 0.8]

    A 0-junction for each chamber with the compliance of its oil, a 1-junction for the piston with its inertia, its
    friction and the bumpers. At the start the piston is at rest, and the pressures balance the load `F_start`.

    Source: Eqs. 7, 8, 14 and 15; Fig. 3.
    """

    stroke: Parameter = Parameter(2.0, unit="m", min=0.0, doc="stroke")
    Va0: Parameter = Parameter(5e-3, unit="m3", min=0.0, doc="dead volume on the bore side")
    Vb0: Parameter = Parameter(5e-3, unit="m3", min=0.0, doc="dead volume on the rod side")
    m: Parameter = Parameter(400.0, unit="kg", min=0.0, doc="mass of the piston")
    c: Parameter = Parameter(5e4, unit="N*s/m", min=0.0, doc="viscous friction of the piston")
    k_bumper: Parameter = Parameter(1e8, unit="N/m", min=0.0, doc="stiffness of the bumpers")
    c_bumper: Parameter = Parameter(4e5, unit="N*s/m", min=0.0, doc="damping of the bumpers")
    oil: hydraulic.Oil = ac.outer(hydraulic.Oil())
    chamber_a: J0 = J0()
    chamber_b: J0 = J0()
    oil_a: MC = MC(e=start(hydraulic.PartialCylinder.p_a_start, fixed=True, nominal=1e6))
    oil_b: MC = MC(e=start(hydraulic.PartialCylinder.p_b_start, fixed=True, nominal=1e6))
    piston: J1 = J1(n_out=5)
    inertia: I = I(I=m, f=start(0.0, fixed=True, nominal=0.1))
    friction: R = R(R=c)
    bumpers: Bumpers = Bumpers(k=k_bumper, c=c_bumper, stroke=stroke)
    V_a: Variable = Variable(unit="m3", nominal=1e-2, doc="volume of the oil on the bore side")
    V_b: Variable = Variable(unit="m3", nominal=1e-2, doc="volume of the oil on the rod side")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.V_a == self.Va0 + self.area_a * self.x
        yield self.V_b == self.Vb0 + self.area_b * (self.stroke - self.x)
        yield self.oil_a.c == self.V_a / self.oil.B
        yield self.oil_b.c == self.V_b / self.oil.B
        yield self.bumpers.x == self.x
        yield connect(self.side_a.bond, self.chamber_a.inp[0])
        yield connect(self.chamber_a.out[0], self.oil_a.port)
        yield connect(self.chamber_a.out[1], self.area_a_tf.port_a)
        yield connect(self.area_a_tf.port_b, self.piston.inp[0])
        yield connect(self.piston.out[0], self.area_b_tf.port_a)
        yield connect(self.area_b_tf.port_b, self.chamber_b.inp[0])
        yield connect(self.chamber_b.out[0], self.oil_b.port)
        yield connect(self.chamber_b.out[1], self.side_b.bond)
        yield connect(self.piston.out[1], self.inertia.port)
        yield connect(self.piston.out[2], self.friction.port)
        yield connect(self.piston.out[3], self.bumpers.port)
        yield connect(self.piston.out[4], self.rod_end.bond)
