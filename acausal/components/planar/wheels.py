"""Wheels without mass that roll and do not slip."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, Vector, der, dot, norm

from .. import rotational
from .interfaces import Frame, resolve1


class IdealRolling(Component):
    """A wheel in the plane rolls on the x axis: its hub, the frame, is at ``y = R``, and ``dx/dt = -R dphi/dt``.

    The ground holds it with whatever force that takes, in x by friction and in y either way.

    >>> model = assemble("wheel.frame_a - disc.frame_a", planarWorld=ac.inner(PlanarWorld(constantGravity=(3.0, 0.0))),
    ...                  wheel=IdealRolling(R=0.5), disc=Body(m=2.0, I=0.25, phi=start(0.0, fixed=True),
    ...                  w=start(0.0, fixed=True), r=start((0.0, 0.5), fixed=True)))
    >>> close(run(model)["disc.r[1]"][-1], 0.5 * 3.0 * 2.0 / (2.0 + 0.25 / 0.5**2))
    True

    Source: PlanarMechanics.Joints.IdealRolling.
    """

    frame_a: Frame = Frame()
    R: Parameter = Parameter(0.5, unit="m", min=1e-30, doc="radius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.y == self.R
        yield der(self.frame_a.x) == -self.R * der(self.frame_a.phi)
        yield self.frame_a.t == self.R * self.frame_a.fx


class IdealWheelJoint(Component):
    """A wheel seen from above, on a ground that is the plane: it rolls along its direction and does not slip sideways.

    The direction is `r` in its frame; ``v_long = radius w_roll`` with the angular velocity of `flange_a`,
    whose torque drives it, ``flange_a.tau = -radius f_long``. The force across is whatever it takes.

    >>> model = assemble("drive.flange - wheel.flange_a", "wheel.frame_a - car.frame_a",
    ...                  drive=rotational.ConstantTorque(tau_constant=1.5),
    ...                  wheel=IdealWheelJoint(radius=0.25, w_roll=start(0.0, fixed=True)),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  car=Body(m=3.0, I=1.0, r=start((0.0, 0.0), fixed=True), phi=start(0.5, fixed=True),
    ...                           w=start(0.0, fixed=True)))
    >>> close(run(model)["car.r[1]"][-1], 0.5 * 1.5 / 0.25 / 3.0 * np.cos(0.5))
    True

    Source: PlanarMechanics.VehicleComponents.Wheels.IdealWheelJoint.
    """

    frame_a: Frame = Frame()
    flange_a: rotational.Flange = rotational.Flange()
    radius: Parameter = Parameter(0.3, unit="m", min=1e-30, doc="radius of the wheel")
    r: Vector = Vector(
        Parameter(unit="m", doc="driving direction in the frame, of any length but zero"), (1.0, 0.0), size=2
    )
    w_roll: Variable = Variable(unit="rad/s", doc="angular velocity of rolling")
    v_long: Variable = Variable(unit="m/s", doc="velocity along the driving direction")
    f_long: Variable = Variable(unit="N", doc="force of the frame on the wheel along the driving direction")

    def equations(self) -> Equations:
        yield from super().equations()
        e = resolve1(self.frame_a, self.r / norm(self.r))
        v = (der(self.frame_a.x), der(self.frame_a.y))
        yield self.w_roll == der(self.flange_a.phi)
        yield self.v_long == dot(v, e)
        yield v[1] * e[0] == v[0] * e[1]
        yield self.v_long == self.radius * self.w_roll
        yield self.f_long == dot((self.frame_a.fx, self.frame_a.fy), e)
        yield self.frame_a.t == 0
        yield self.flange_a.tau == -self.radius * self.f_long
