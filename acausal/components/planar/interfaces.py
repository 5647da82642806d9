"""Frame, world, and the bases of planar components."""

from __future__ import annotations

from acausal import Component, Connector, Equations, Expr, Flow, Parameter, Potential, Variable, der, outer, sqrt


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


class PlanarWorld(Component):
    """Uniform gravity ``(g_x, g_y)``; shared by declaring one ``inner`` and reading it as ``outer``.

    >>> stone = Body(r_x=start(0.0, fixed=True), v_x=start(1.0, fixed=True), r_y=start(0.0, fixed=True),
    ...              v_y=start(2.0, fixed=True), phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    >>> model = assemble(planarWorld=ac.inner(PlanarWorld(g_y=-1.62)), stone=stone)
    >>> close(run(model, at=[0.5, 1.0])["stone.r_y"], [2.0 * 0.5 - 0.81 * 0.25, 2.0 - 0.81])
    True

    Source: PlanarMechanics.PlanarWorld.
    """

    g_x: Parameter = Parameter(0.0, unit="m/s2", doc="acceleration of gravity in x")
    g_y: Parameter = Parameter(-9.81, unit="m/s2", doc="acceleration of gravity in y")


class PartialTwoFrames(Component, partial=True):
    """Two frames, a and b.

    Source: PlanarMechanics.Interfaces.PartialTwoFrames.
    """

    frame_a: Frame = Frame()
    frame_b: Frame = Frame()

    def held_together(self, r_x: Expr | float = 0.0, r_y: Expr | float = 0.0) -> Equations:
        """Equations of positions and cut forces, where frame b is at ``(r_x, r_y)`` [m] from a, in the world frame.

        The torques of both frames and of the force at b with that lever are in balance, as nothing here has a mass.
        """
        yield self.frame_a.x + r_x == self.frame_b.x
        yield self.frame_a.y + r_y == self.frame_b.y
        yield self.frame_a.fx + self.frame_b.fx == 0
        yield self.frame_a.fy + self.frame_b.fy == 0
        yield self.frame_a.t + self.frame_b.t + r_x * self.frame_b.fy - r_y * self.frame_b.fx == 0


class PartialMass(Component, partial=True):
    """Mass at the frame's origin, ``frame_a.f + m g = m a``, ``v = dr/dt``, ``a = dv/dt``.

    Source: PlanarMechanics.Parts.Body.
    """

    frame_a: Frame = Frame()
    planarWorld: PlanarWorld = outer(PlanarWorld())
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    r_x: Variable = Variable(unit="m", doc="x position")
    r_y: Variable = Variable(unit="m", doc="y position")
    v_x: Variable = Variable(unit="m/s", doc="velocity in x")
    v_y: Variable = Variable(unit="m/s", doc="velocity in y")
    a_x: Variable = Variable(unit="m/s2", doc="acceleration in x")
    a_y: Variable = Variable(unit="m/s2", doc="acceleration in y")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_x == self.frame_a.x
        yield self.r_y == self.frame_a.y
        yield self.v_x == der(self.r_x)
        yield self.v_y == der(self.r_y)
        yield self.a_x == der(self.v_x)
        yield self.a_y == der(self.v_y)
        yield self.m * self.a_x == self.frame_a.fx + self.m * self.planarWorld.g_x
        yield self.m * self.a_y == self.frame_a.fy + self.m * self.planarWorld.g_y


class PartialLineForce(PartialTwoFrames, partial=True):
    """Force along the line between the origins of two frames, with `s` their distance; subclasses give `f`.

    `f` is positive when it pulls the frames together. The line has no direction where the frames meet.

    Source: Modelica.Mechanics.MultiBody.Forces.LineForceWithMass, in the plane.
    """

    s: Variable = Variable(unit="m", start=1.0, doc="distance of the frames")
    f: Variable = Variable(unit="N", doc="force that pulls the frames together")
    e_x: Variable = Variable(unit="1", doc="direction from frame a to frame b, x")
    e_y: Variable = Variable(unit="1", doc="direction from frame a to frame b, y")

    def equations(self) -> Equations:
        yield from super().equations()
        r_x, r_y = self.frame_b.x - self.frame_a.x, self.frame_b.y - self.frame_a.y
        yield self.s == sqrt(r_x**2 + r_y**2)
        yield self.e_x == r_x / self.s
        yield self.e_y == r_y / self.s
        yield self.frame_b.fx == self.e_x * self.f
        yield self.frame_b.fy == self.e_y * self.f
        yield self.frame_a.t == 0
        yield self.frame_b.t == 0
        yield from self.reaction()

    def reaction(self) -> Equations:
        """Equations of the force at frame a: what the line has no mass for goes from one frame to the other."""
        yield self.frame_a.fx == -self.e_x * self.f
        yield self.frame_a.fy == -self.e_y * self.f


class PartialCompliant(PartialLineForce, partial=True):
    """Line force that needs the velocity ``v = ds/dt``.

    Source: Modelica.Mechanics.MultiBody.Forces.Damper, in the plane.
    """

    v: Variable = Variable(unit="m/s", doc="velocity with which the frames part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)


class PartialAbsoluteSensor(Component, partial=True):
    """Frame on which no force acts.

    Source: PlanarMechanics.Sensors.Internal.PartialAbsoluteSensor.
    """

    frame_a: Frame = Frame()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_a.fx == 0
        yield self.frame_a.fy == 0
        yield self.frame_a.t == 0


class PartialRelativeSensor(PartialTwoFrames, partial=True):
    """Two frames on which no force acts.

    Source: PlanarMechanics.Sensors.Internal.PartialRelativeSensor.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        for frame in (self.frame_a, self.frame_b):
            yield frame.fx == 0
            yield frame.fy == 0
            yield frame.t == 0
