"""Frame, world, and the bases of planar components."""

from __future__ import annotations

from typing import ClassVar

from acausal import (
    Component,
    Connector,
    DeclarationError,
    Equations,
    Flow,
    Parameter,
    Potential,
    Variable,
    Vector,
    conditional,
    cos,
    der,
    noevent,
    outer,
    sin,
    sqrt,
    structural,
    vector,
)
from acausal import max as maximum


class Frame(Connector):
    """Coordinate system in the plane; forces are resolved in the world frame, the torque is about the frame's origin.

    Source: PlanarMechanics.Interfaces.Frame (Zimmer, A planar mechanical library for teaching Modelica, Modelica 2012).
    """

    x: Potential = Potential(unit="m", doc="x position in the world frame")
    y: Potential = Potential(unit="m", doc="y position in the world frame")
    phi: Potential = Potential(unit="rad", doc="angle against the world frame, against the clock")
    fx: Flow = Flow(unit="N", doc="cut force in x acting on the component")
    fy: Flow = Flow(unit="N", doc="cut force in y acting on the component")
    t: Flow = Flow(unit="N*m", doc="cut torque acting on the component")


def resolve1(frame: Frame, r: Vector) -> Vector:
    """A vector `r` of a frame, in the world frame."""
    c, s = cos(frame.phi), sin(frame.phi)
    return vector(c * r[0] - s * r[1], s * r[0] + c * r[1])


def resolve2(frame: Frame, r: Vector) -> Vector:
    """A vector `r` of the world frame, in a frame."""
    c, s = cos(frame.phi), sin(frame.phi)
    return vector(c * r[0] + s * r[1], c * r[1] - s * r[0])


def between(frame_a: Frame, frame_b: Frame) -> Vector:
    """From the origin of frame a to that of frame b, in the world frame [m]."""
    return vector(frame_b.x - frame_a.x, frame_b.y - frame_a.y)


class PlanarWorld(Component):
    """Uniform gravity `constantGravity`; shared by declaring one ``inner`` and reading it as ``outer``.

    >>> stone = Body(r=start((0.0, 0.0), fixed=True), v=start((1.0, 2.0), fixed=True), phi=start(0.0, fixed=True),
    ...              w=start(0.0, fixed=True))
    >>> model = assemble(planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, -1.62))), stone=stone)
    >>> close(run(model, at=[0.5, 1.0])["stone.r[2]"], [2.0 * 0.5 - 0.81 * 0.25, 2.0 - 0.81])
    True

    Source: PlanarMechanics.PlanarWorld.
    """

    constantGravity: Vector = Vector(Parameter(unit="m/s2", doc="acceleration of gravity"), (0.0, -9.81), size=2)


class PartialTwoFrames(Component, partial=True):
    """Two frames, a and b.

    Source: PlanarMechanics.Interfaces.PartialTwoFrames.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a", "frame_b")
    frame_a: Frame = Frame()
    frame_b: Frame = Frame()

    def held_together(self, r: Vector | None = None) -> Equations:
        """Equations of positions and cut forces, where frame b is `r` [m] away from a, in the world frame.

        The torques of both frames and of the force at b with that lever are in balance, as nothing here has a mass.
        """
        r_x, r_y = r or (0.0, 0.0)
        yield self.frame_a.x + r_x == self.frame_b.x
        yield self.frame_a.y + r_y == self.frame_b.y
        yield self.frame_a.fx + self.frame_b.fx == 0
        yield self.frame_a.fy + self.frame_b.fy == 0
        yield self.frame_a.t + self.frame_b.t + r_x * self.frame_b.fy - r_y * self.frame_b.fx == 0


class PartialMass(Component, partial=True):
    """Mass at the frame's origin, ``frame_a.f + m g = m a``, ``v = dr/dt``, ``a = dv/dt``; g with `enableGravity`.

    Source: PlanarMechanics.Parts.Body.
    """

    frame_a: Frame = Frame()
    planarWorld: PlanarWorld = outer(PlanarWorld())
    enableGravity: bool = True
    stateSelect: str = "default"
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    f: Vector = Vector(Variable(unit="N", doc="cut force at the frame"), size=2)
    r: Vector = Vector(Variable(unit="m", state_select=structural("stateSelect"), doc="position"), size=2)
    v: Vector = Vector(Variable(unit="m/s", state_select=structural("stateSelect"), doc="velocity"), size=2)
    a: Vector = Vector(Variable(unit="m/s2", doc="acceleration"), size=2)

    def equations(self) -> Equations:
        yield from super().equations()
        frame = self.frame_a
        yield self.r == (frame.x, frame.y)
        yield self.v == der(self.r)
        yield self.a == der(self.v)
        yield self.f == (frame.fx, frame.fy)
        weight = self.planarWorld.constantGravity * self.m
        yield self.a * self.m == (self.f + weight if self.enableGravity else self.f)


class PartialLineForce(PartialTwoFrames, partial=True):
    """Force along the line between the origins of two frames, with `s` their distance; subclasses give `f`.

    `f` is positive when it pulls the frames together. Closer than `s_small`, the direction fades.

    Source: Modelica.Mechanics.MultiBody.Forces.LineForceWithMass, in the plane.
    """

    s_small: Parameter = Parameter(1e-10, unit="m", min=0.0, doc="distance below which the line has no direction")
    s: Variable = Variable(unit="m", start=1.0, doc="distance of the frames")
    f: Variable = Variable(unit="N", doc="force that pulls the frames together")
    e: Vector = Vector(Variable(unit="1", doc="direction from frame a to frame b"), size=2)

    def equations(self) -> Equations:
        yield from super().equations()
        r = between(self.frame_a, self.frame_b)
        square = r[0] ** 2 + r[1] ** 2
        yield self.s == sqrt(noevent(maximum(square, self.s_small**2)))  # a root that has a derivative at zero
        yield self.e == r / self.s
        yield vector(self.frame_b.fx, self.frame_b.fy) == self.e * self.f
        yield self.frame_a.t == 0
        yield self.frame_b.t == 0
        yield from self.reaction()

    def reaction(self) -> Equations:
        """Equations of the force at frame a: what the line has no mass for goes from one frame to the other."""
        yield vector(self.frame_a.fx, self.frame_a.fy) == -self.e * self.f


class PartialCompliant(PartialLineForce, partial=True):
    """Line force that needs the velocity ``v = ds/dt``.

    Source: Modelica.Mechanics.MultiBody.Forces.Damper, in the plane.
    """

    v: Variable = Variable(unit="m/s", doc="velocity with which the frames part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)


def untouched(frame: Frame) -> Equations:
    """Neither a force nor a torque acts on a frame."""
    yield frame.fx == 0
    yield frame.fy == 0
    yield frame.t == 0


class PartialResolved(Component, partial=True):
    """Something whose vectors are resolved in a frame that `resolveInFrame` names.

    ``world``, ``frame_a``, ``frame_b`` or ``frame_resolve``, as far as the component has these.

    Source: the types ResolveInFrameA, ResolveInFrameB and ResolveInFrameAB of Modelica.Mechanics.MultiBody.Types.
    """

    resolveInFrame: str = "world"
    frame_resolve: Frame = conditional(Frame(), "useFrameResolve")

    @property
    def useFrameResolve(self) -> bool:
        """Whether vectors are resolved in a frame of its own."""
        return self.resolveInFrame == "frame_resolve"

    def to_world(self, v: Vector, given: str = "") -> Vector:
        """A vector of the component's signals (resolved in the frame `given`), resolved in the world frame."""
        frame = self.frame_of(given or self.resolveInFrame)
        return v if frame is None else resolve1(frame, v)

    def from_world(self, v: Vector, wanted: str = "") -> Vector:
        """The other way."""
        frame = self.frame_of(wanted or self.resolveInFrame)
        return v if frame is None else resolve2(frame, v)

    def frame_of(self, name: str) -> Frame | None:
        """The frame of this name; None for the world.

        Raises:
            DeclarationError: the component has no such frame.
        """
        known = ["world", *(n for n in ("frame_a", "frame_b") if n in type(self)._children), "frame_resolve"]
        if name not in known:
            raise DeclarationError(
                f"{type(self).__name__}: vectors are resolved in one of {', '.join(known)}, not in {name!r}"
            )
        return None if name == "world" else getattr(self, name)

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useFrameResolve:
            yield from untouched(self.frame_resolve)


class PartialAbsoluteSensor(PartialResolved, partial=True):
    """Measures at frame_a, without force and torque; resolved in frame_a by default.

    Source: PlanarMechanics.Sensors.Internal.PartialAbsoluteSensor.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a",)
    resolveInFrame: str = "frame_a"
    frame_a: Frame = Frame()

    def equations(self) -> Equations:
        yield from super().equations()
        yield from untouched(self.frame_a)


class PartialRelativeSensor(PartialTwoFrames, PartialResolved, partial=True):
    """Measures between frame_a and frame_b, without forces and torques; resolved in frame_a by default.

    Source: PlanarMechanics.Sensors.Internal.PartialRelativeSensor.
    """

    resolveInFrame: str = "frame_a"

    def equations(self) -> Equations:
        yield from super().equations()
        for frame in (self.frame_a, self.frame_b):
            yield from untouched(frame)
