"""Bodies, and rigid connections of frames."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, cos, der, sin

from .interfaces import Frame, PartialMass, PartialTwoFrames


class Fixed(Component):
    """Frame fixed in the world at ``(r_x, r_y)``, turned by `phi`.

    >>> model = assemble("wall.frame - rod.frame_a", wall=Fixed(r_x=1.0, phi=0.5), rod=FixedTranslation(r_x=2.0))
    >>> close(run(model)["rod.frame_b.y"][-1], 2.0 * np.sin(0.5))
    True

    Source: PlanarMechanics.Parts.Fixed.
    """

    frame: Frame = Frame()
    r_x: Parameter = Parameter(0.0, unit="m", doc="x position")
    r_y: Parameter = Parameter(0.0, unit="m", doc="y position")
    phi: Parameter = Parameter(0.0, unit="rad", doc="angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame.x == self.r_x
        yield self.frame.y == self.r_y
        yield self.frame.phi == self.phi


class FixedTranslation(PartialTwoFrames):
    """Rigid rod without mass: frame b is at ``(r_x, r_y)`` in frame a, turned as frame a.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - load.frame_a", wall=Fixed(),
    ...                  rod=FixedTranslation(r_x=2.0), load=Body(m=3.0), planarWorld=ac.inner(PlanarWorld(g_y=-10.0)))
    >>> run(model)["rod.frame_a.t"][-1]  # the wall holds the moment of the weight
    60.0

    Source: PlanarMechanics.Parts.FixedTranslation.
    """

    r_x: Parameter = Parameter(1.0, unit="m", doc="position of frame b in frame a, x")
    r_y: Parameter = Parameter(0.0, unit="m", doc="position of frame b in frame a, y")

    def equations(self) -> Equations:
        yield from super().equations()
        c, s = cos(self.frame_a.phi), sin(self.frame_a.phi)
        yield self.frame_a.phi == self.frame_b.phi
        yield from self.held_together(c * self.r_x - s * self.r_y, s * self.r_x + c * self.r_y)


class FixedRotation(PartialTwoFrames):
    """Frame b is turned against frame a by `alpha`.

    >>> model = assemble("wall.frame - turn.frame_a", wall=Fixed(phi=0.5), turn=FixedRotation(alpha=0.25))
    >>> run(model)["turn.frame_b.phi"][-1]
    0.75

    Source: PlanarMechanics.Parts.FixedRotation.
    """

    alpha: Parameter = Parameter(0.0, unit="rad", doc="angle of frame b against frame a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi + self.alpha == self.frame_b.phi
        yield from self.held_together()


class Body(PartialMass):
    """Rigid body with its centre of gravity in the frame's origin: ``frame_a.f + m g = m a``, ``frame_a.t = I z``.

    >>> model = assemble("torque.y - drive.torque", "zero.y - drive.force_x - drive.force_y",
    ...                  "drive.frame_b - disc.frame_a", torque=blocks.Constant(k=3.0), zero=blocks.Constant(k=0.0),
    ...                  drive=WorldForce(), planarWorld=ac.inner(PlanarWorld()),
    ...                  disc=Body(m=2.0, I=0.5, r_x=start(0.0, fixed=True), r_y=start(0.0, fixed=True),
    ...                            v_x=start(1.0, fixed=True), v_y=start(4.0, fixed=True),
    ...                            phi=start(0.0, fixed=True), w=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["disc.phi"], [0.5 + 0.75, 1.0 + 3.0])
    True

    Source: PlanarMechanics.Parts.Body.
    """

    I: Parameter = Parameter(0.1, unit="kg*m2", min=0.0, doc="moment of inertia about the centre of gravity")  # noqa: E741
    phi: Variable = Variable(unit="rad", doc="angle")
    w: Variable = Variable(unit="rad/s", doc="angular velocity")
    z: Variable = Variable(unit="rad/s2", doc="angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.frame_a.phi
        yield self.w == der(self.phi)
        yield self.z == der(self.w)
        yield self.I * self.z == self.frame_a.t


class PointMass(PartialMass):
    """Mass without a moment of inertia: ``frame_a.f + m g = m a``, ``frame_a.t = 0``.

    The angle of its frame comes from what holds it: a mass that hangs on springs alone is a `Body`.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - load.frame_a", wall=Fixed(phi=np.pi / 6),
    ...                  rod=FixedTranslation(r_x=2.0), load=PointMass(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(g_y=-10.0)))
    >>> close(run(model)["rod.frame_a.t"][-1], 3.0 * 10.0 * 2.0 * np.cos(np.pi / 6))
    True

    Source: Modelica.Mechanics.MultiBody.Parts.PointMass, in the plane.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.t == 0
