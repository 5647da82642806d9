"""Examples of Modelica.Mechanics.MultiBody 4.0, assembled from the components of this library."""

from __future__ import annotations

from acausal import Component, Equations, connect, inner, start
from acausal.components import multibody, rotational


class Pendulum(Component):
    """Modelica.Mechanics.MultiBody.Examples.Elementary.Pendulum."""

    world: multibody.World = inner(multibody.World())
    rev: multibody.Revolute = multibody.Revolute(
        n=(0.0, 0.0, 1.0), useAxisFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)
    )
    damper: rotational.Damper = rotational.Damper(d=0.1)
    body: multibody.Body = multibody.Body(m=1.0, r_CM=(0.5, 0.0, 0.0))

    def equations(self) -> Equations:
        yield connect(self.world.frame_b, self.rev.frame_a)
        yield connect(self.damper.flange_b, self.rev.axis)
        yield connect(self.rev.support, self.damper.flange_a)
        yield connect(self.body.frame_a, self.rev.frame_b)


class Fourbar1(Component):
    """Modelica.Mechanics.MultiBody.Examples.Loops.Fourbar1."""

    world: multibody.World = inner(multibody.World())
    j1: multibody.Revolute = multibody.Revolute(
        n=(1.0, 0.0, 0.0), stateSelect="always", phi=start(0.0, fixed=True), w=start(5.235987755982989, fixed=True)
    )
    j2: multibody.Prismatic = multibody.Prismatic(n=(1.0, 0.0, 0.0), s=start(-0.2))
    b1: multibody.BodyCylinder = multibody.BodyCylinder(r=(0.0, 0.5, 0.1), diameter=0.05)
    b2: multibody.BodyCylinder = multibody.BodyCylinder(r=(0.0, 0.2, 0.0), diameter=0.05)
    b3: multibody.BodyCylinder = multibody.BodyCylinder(r=(-1.0, 0.3, 0.1), diameter=0.05)
    rev: multibody.Revolute = multibody.Revolute(n=(0.0, 1.0, 0.0))
    rev1: multibody.Revolute = multibody.Revolute()
    j3: multibody.Revolute = multibody.Revolute(n=(1.0, 0.0, 0.0))
    j4: multibody.Revolute = multibody.Revolute(n=(0.0, 1.0, 0.0))
    j5: multibody.Revolute = multibody.Revolute(n=(0.0, 0.0, 1.0))
    b0: multibody.FixedTranslation = multibody.FixedTranslation(r=(1.2, 0.0, 0.0))

    def equations(self) -> Equations:
        yield connect(self.j2.frame_b, self.b2.frame_a)
        yield connect(self.j1.frame_b, self.b1.frame_a)
        yield connect(self.rev.frame_a, self.b2.frame_b)
        yield connect(self.rev.frame_b, self.rev1.frame_a)
        yield connect(self.rev1.frame_b, self.b3.frame_a)
        yield connect(self.world.frame_b, self.j1.frame_a)
        yield connect(self.b1.frame_b, self.j3.frame_a)
        yield connect(self.j3.frame_b, self.j4.frame_a)
        yield connect(self.j4.frame_b, self.j5.frame_a)
        yield connect(self.j5.frame_b, self.b3.frame_b)
        yield connect(self.b0.frame_a, self.world.frame_b)
        yield connect(self.b0.frame_b, self.j2.frame_a)
