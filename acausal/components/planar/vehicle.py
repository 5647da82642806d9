"""Parts of vehicles beside their wheels."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, Vector, connect, der, noevent, norm, vector, where

from .. import rotational
from .interfaces import Frame, resolve1


class DifferentialGear(Component):
    """Turns two wheels with the same torque each: ``2 w_b = w_left + w_right``, ``tau_left = tau_right = -tau_b/2``.

    >>> model = assemble("drive.flange - gear.flange_b", "gear.flange_left - left.flange_a",
    ...                  "gear.flange_right - right.flange_a", drive=rotational.ConstantTorque(tau_constant=4.0),
    ...                  gear=DifferentialGear(),
    ...                  left=rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  right=rotational.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> turned = run(model)
    >>> close([turned["left.w"][-1], turned["right.w"][-1]], [2.0, 1.0])
    True

    Source: PlanarMechanics.VehicleComponents.DifferentialGear.
    """

    flange_b: rotational.Flange = rotational.Flange()
    flange_left: rotational.Flange = rotational.Flange()
    flange_right: rotational.Flange = rotational.Flange()
    idealPlanetary: rotational.IdealPlanetary = rotational.IdealPlanetary(ratio=-2.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.flange_b, self.idealPlanetary.ring)
        yield connect(self.flange_left, self.idealPlanetary.carrier)
        yield connect(self.flange_right, self.idealPlanetary.sun)


class AirResistanceLongitudinal(Component):
    """Drag along the driving direction `r` of a vehicle, ``f_long = fDrag = c_W area rho/2 vAir[1]^2``.

    There is none, ``f_long = 0``, where it drives backward.

    >>> model = assemble("air.frame_a - car.frame_a", planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  air=AirResistanceLongitudinal(c_W=0.5, area=2.0, rho=1.2),
    ...                  car=Body(m=0.6, r=start((0.0, 0.0), fixed=True), v=start((2.0, 1.0), fixed=True),
    ...                           phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> slow = run(model, at=[0.5, 1.0])
    >>> close(slow["car.v[1]"], 1 / (0.5 + np.array([0.5, 1.0]))) and close(slow["car.v[2]"], [1.0, 1.0])
    True

    Source: PlanarMechanics.VehicleComponents.AirResistanceLongitudinal.
    """

    frame_a: Frame = Frame()
    c_W: Parameter = Parameter(0.5, unit="1", min=0.0, doc="drag coefficient")
    area: Parameter = Parameter(2.0, unit="m2", min=0.0, doc="cross section")
    rho: Parameter = Parameter(1.18, unit="kg/m3", min=0.0, doc="density of air")
    r: Vector = Vector(
        Parameter(unit="m", doc="driving direction in the frame, of any length but zero"), (1.0, 0.0), size=2
    )
    vAir: Vector = Vector(Variable(unit="m/s", doc="velocity of the air, along `r` and across"), size=2)
    fDrag: Variable = Variable(unit="N", doc="drag at this speed forward")
    f_long: Variable = Variable(unit="N", doc="drag, zero where the vehicle drives backward")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        e = resolve1(frame, self.r / norm(self.r))
        v_x, v_y = der(frame.x), der(frame.y)
        yield self.vAir == (-v_x * e[0] - v_y * e[1], v_x * e[1] - v_y * e[0])
        yield self.fDrag == self.c_W * self.area * self.rho / 2 * self.vAir[0] ** 2
        yield self.f_long == noevent(where(self.vAir[0] < 0, self.fDrag, 0.0))
        yield vector(frame.fx, frame.fy) == e * self.f_long
        yield frame.t == 0
