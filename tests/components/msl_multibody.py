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
