"""Bodies, and rigid connections of frames."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Equations, Parameter, Variable, Vector, der, structural

from .interfaces import Frame, PartialMass, PartialTwoFrames, resolve1


class Fixed(Component):
    """Frame fixed in the world at `r`, turned by `phi`.

    >>> model = assemble("wall.frame - rod.frame_a", wall=Fixed(r=(1.0, 0.0), phi=0.5),
    ...                  rod=FixedTranslation(r=(2.0, 0.0)))
    >>> close(run(model)["rod.frame_b.y"][-1], 2.0 * np.sin(0.5))
    True

    Source: PlanarMechanics.Parts.Fixed.
    """

    frame: Frame = Frame()
    r: Vector = Vector(Parameter(unit="m", doc="position"), (0.0, 0.0), size=2)
    phi: Parameter = Parameter(0.0, unit="rad", doc="angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r == (self.frame.x, self.frame.y)
        yield self.frame.phi == self.phi


class FixedTranslation(PartialTwoFrames):
    """Rigid rod without mass: frame b is at `r` in frame a, turned as frame a.

    >>> model = assemble("wall.frame - rod.frame_a", "rod.frame_b - load.frame_a", wall=Fixed(),
    ...                  rod=FixedTranslation(r=(2.0, 0.0)), load=Body(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> run(model)["rod.frame_a.t"][-1]  # the wall holds the moment of the weight
    60.0

    Source: PlanarMechanics.Parts.FixedTranslation.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ()
    r: Vector = Vector(Parameter(unit="m", doc="position of frame b in frame a"), (1.0, 0.0), size=2)
    r0: Vector = Vector(Variable(unit="m", doc="from frame a to frame b, in the world frame"), size=2)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi == self.frame_b.phi
        yield self.r0 == resolve1(self.frame_a, self.r)
        yield from self.held_together(self.r0)


class FixedRotation(PartialTwoFrames):
    """Frame b is turned against frame a by `alpha`.

    >>> model = assemble("wall.frame - turn.frame_a", wall=Fixed(phi=0.5), turn=FixedRotation(alpha=0.25))
    >>> run(model)["turn.frame_b.phi"][-1]
    0.75

    Source: PlanarMechanics.Parts.FixedRotation.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ()
    alpha: Parameter = Parameter(0.0, unit="rad", doc="angle of frame b against frame a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.phi + self.alpha == self.frame_b.phi
        yield from self.held_together()


class Body(PartialMass):
    """Rigid body with its centre of gravity in the frame's origin: ``frame_a.f + m g = m a``, ``frame_a.t = I z``.

    >>> model = assemble(planarWorld=ac.inner(PlanarWorld()), stick=Body(m=2.0, I=0.5, r=start((0.0, 0.0), fixed=True),
    ...                  v=start((1.0, 4.0), fixed=True), phi=start(0.0, fixed=True), w=start(3.0, fixed=True)))
    >>> values = run(model, at=[0.5, 1.0])
    >>> close(values["stick.phi"], [1.5, 3.0]), close(values["stick.r[2]"], [2.0 - 9.81 / 8, 4.0 - 9.81 / 2])
    (True, True)

    Source: PlanarMechanics.Parts.Body.
    """

    I: Parameter = Parameter(0.1, unit="kg*m2", min=0.0, doc="moment of inertia about the centre of gravity")  # noqa: E741
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle")
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="angular velocity")
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
    ...                  rod=FixedTranslation(r=(2.0, 0.0)), load=PointMass(m=3.0),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -10.0))))
    >>> close(run(model)["rod.frame_a.t"][-1], 3.0 * 10.0 * 2.0 * np.cos(np.pi / 6))
    True

    Source: Modelica.Mechanics.MultiBody.Parts.PointMass, in the plane.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.t == 0
