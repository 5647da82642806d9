"""Forces and torques that signals or speeds give."""

from __future__ import annotations

from typing import ClassVar

from acausal import Equations, Input, Parameter, Variable, Vector, abs, der, noevent, vector

from .interfaces import Frame, PartialResolved, PartialTwoFrames


class WorldForce(PartialResolved):
    """Force in x and y and torque on a frame, the signals `force`, resolved in frame_b by default.

    >>> class Push(WorldForce):
    ...     def equations(self):
    ...         yield from super().equations()
    ...         yield self.force == (0.0, 5.0, 0.0)
    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - push.frame_b", wall=Fixed(phi=1.0), push=Push(),
    ...                  rod=FixedTranslation(r=(2.0, 0.0)))
    >>> close(run(model)["wall.frame.t"][-1], 10.0)  # what the rod does to the wall
    True

    Source: PlanarMechanics.Sources.WorldForce.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_b",)
    resolveInFrame: str = "frame_b"
    frame_b: Frame = Frame()
    force: Vector = Vector(Input(doc="forces in x and y [N], and torque [N.m]"))

    def equations(self) -> Equations:
        yield from super().equations()
        f = self.to_world(vector(self.force[0], self.force[1]))
        yield vector(self.frame_b.fx, self.frame_b.fy, self.frame_b.t) == (-f[0], -f[1], -self.force[2])


class RelativeForce(PartialTwoFrames, PartialResolved):
    """Force in x and y and torque on frame b, the signals `force`, and the opposite on frame a.

    Resolved in frame_a by default. The force need not go through both frames: where they are apart, it turns them.

    >>> class Pull(RelativeForce):
    ...     def equations(self):
    ...         yield from super().equations()
    ...         yield self.force == (5.0, 0.0, 0.0)
    >>> model = assemble("wall.frame - pull.frame_a", "pull.frame_b - disc.frame_a", wall=Fixed(phi=np.pi / 2),
    ...                  pull=Pull(), planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  disc=Body(m=2.0, r=start((0.0, 0.0), fixed=True), v=start((0.0, 0.0), fixed=True),
    ...                            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model)["disc.v[2]"], [0.0, 2.5])
    True

    Source: PlanarMechanics.Sources.RelativeForce.
    """

    resolveInFrame: str = "frame_a"
    force: Vector = Vector(Input(doc="forces in x and y [N], and torque [N.m], on frame b"))

    def equations(self) -> Equations:
        yield from super().equations()
        f, a, b = self.to_world(vector(self.force[0], self.force[1])), self.frame_a, self.frame_b
        yield vector(b.fx, b.fy, b.t) == (-f[0], -f[1], -self.force[2])
        yield vector(a.fx, a.fy, a.t) == (-b.fx, -b.fy, -b.t)


class QuadraticSpeedDependentForce(PartialResolved):
    """Force and torque with the square of the speeds and their signs, ``F_nominal |v| v/v_nominal^2`` in x and in y.

    Negative nominal values brake. The torque is ``tau_nominal |w| w/w_nominal^2``; resolved in the world frame by
    default.

    >>> model = assemble("disc.frame_a - drag.frame_b", planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))),
    ...                  drag=QuadraticSpeedDependentForce(F_nominal=-8.0, v_nominal=2.0),
    ...                  disc=Body(m=2.0, r=start((0.0, 0.0), fixed=True), v=start((3.0, 0.0), fixed=True),
    ...                            phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["disc.v[1]"], 1 / (1 / 3 + np.array([0.5, 1.0])))
    True

    Source: PlanarMechanics.Sources.QuadraticSpeedDependentForce.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_b",)
    frame_b: Frame = Frame()
    force: Vector = Vector(Variable(doc="forces in x and y [N], and torque [N.m], that act"))
    F_nominal: Parameter = Parameter(0.0, unit="N", doc="force at v_nominal, braking where negative")
    v_nominal: Parameter = Parameter(1.0, unit="m/s", min=1e-15, doc="nominal speed")
    tau_nominal: Parameter = Parameter(0.0, unit="N*m", doc="torque at w_nominal, braking where negative")
    w_nominal: Parameter = Parameter(1.0, unit="rad/s", min=1e-15, doc="nominal angular velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_b
        v, w = self.from_world(vector(der(frame.x), der(frame.y))), der(frame.phi)
        x, y = (self.F_nominal / self.v_nominal**2 * noevent(abs(u)) * u for u in v)
        yield self.force == (x, y, self.tau_nominal / self.w_nominal**2 * noevent(abs(w)) * w)
        f = self.to_world(vector(self.force[0], self.force[1]))
        yield vector(frame.fx, frame.fy, frame.t) == (-f[0], -f[1], -self.force[2])
