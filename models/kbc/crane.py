"""The crane: reference, controller, supply, cylinder, joint and boom; every part can be replaced."""

from __future__ import annotations

from acausal import PI, Component, Equations, Parameter, Variable, acos, connect, cos, inner, sin, start
from acausal.components import blocks, planar
from acausal.components import hydraulic as hyd

from .supply import PartialSupply, SimplifiedSupply


class Crane(Component):
    """One-degree-of-freedom knuckle boom crane under position control, simplified hydraulics, compliant joint.

    A PI controller sets the flow gain of the supply from the piston's displacement; the cylinder lifts the boom. The
    start is at rest with the boom's eye `x_start` from the retracted end: ``phi_start`` from ``L(phi_start) - L0 =
    x_start``, and the cylinder carries ``F_start = m g r cos(phi_start)/h``.

    Source: Fig. 5 of the paper and its sections 3.1 to 3.3.
    """

    p_tank: Parameter = Parameter(1e5, unit="Pa", doc="pressure in the tank")
    m: Parameter = Parameter(11000.0, unit="kg", min=0.0, doc="mass of the boom with payload")
    r: Parameter = Parameter(8.0, unit="m", doc="distance of the boom's centre of gravity from its joint")
    g: Parameter = Parameter(9.81, unit="m/s2", doc="acceleration of gravity")
    a: Parameter = Parameter(2.0, unit="m", min=0.0, doc="distance of the cylinder's foot from the boom joint")
    b: Parameter = Parameter(3.0, unit="m", min=0.0, doc="distance of the rod's eye from the boom joint")
    alpha: Parameter = Parameter(0.2, unit="rad", doc="angle of the foot from the vertical")
    beta: Parameter = Parameter(0.3, unit="rad", doc="angle of the eye from the boom's axis")
    L0: Parameter = Parameter(2.6, unit="m", min=0.0, doc="length of the cylinder with the piston retracted")
    x_start: Parameter = Parameter(1.0, unit="m", doc="position of the boom's eye at the start")
    gamma_start: Parameter = Parameter(
        acos((a**2 + b**2 - (L0 + x_start) ** 2) / (2 * a * b)), unit="rad", doc="angle between the attachments then"
    )
    phi_start: Parameter = Parameter(gamma_start - PI / 2 + alpha + beta, unit="rad", doc="boom angle at the start")
    F_start: Parameter = Parameter(
        m * g * r * cos(phi_start) * (L0 + x_start) / (a * b * sin(gamma_start)), unit="N", doc="cylinder force then"
    )

    oil: hyd.Oil = inner(hyd.Oil(rho=850.0, nu=46e-6, B=1.2e9))
    reference: blocks.SignalSource = blocks.Sine(amplitude=0.3, f=0.05, offset=1.0)
    controller: blocks.LimPI = blocks.LimPI(Kp=6.0, Ki=2.0)
    supply: PartialSupply = SimplifiedSupply(V_disp=2.5e-4, omega=25.0, p_tank=p_tank)
    cylinder: hyd.PartialCylinder = hyd.SimplifiedCylinder(bore=0.25, rod=0.18, F_start=F_start, p_b_start=p_tank)
    joint: planar.PartialCylinderJoint = planar.CompliantJoint(
        a=a, b=b, alpha=alpha, beta=beta, L0=L0, k=2e8, c=2e6, F_start=F_start
    )
    boom: planar.PartialBoom = planar.Boom(
        m=m, r=r, I=1.008e6, g=g, phi=start(phi_start, fixed=True, state_select="prefer")
    )
    x: Variable = Variable(unit="m", doc="displacement of the piston")
    x_ref: Variable = Variable(unit="m", doc="displacement asked for")
    u: Variable = Variable(unit="1", doc="flow gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.x == self.cylinder.x
        yield self.x_ref == self.reference.y
        yield self.u == self.controller.y
        yield self.controller.u_s == self.x_ref
        yield self.controller.u_m == self.x
        yield self.supply.u == self.u
        yield connect(self.supply.port_a, self.cylinder.port_a)
        yield connect(self.supply.port_b, self.cylinder.port_b)
        yield connect(self.cylinder.flange, self.joint.rod)
        yield connect(self.joint.boom, self.boom.flange)
