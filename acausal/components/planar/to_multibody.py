"""From the plane into space."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Variable, defining, der, root, vector

from .. import multibody
from ..multibody.frames import axis_rotation
from .interfaces import Frame


class PlanarToMultiBody(Component):
    """A frame of the plane as a frame in space: the plane is that of the world's x and y, at height `zPosition`.

    What acts at `frame_b` out of the plane, along z and about x and y, the plane carries.

    >>> model = assemble("wall.frame - hinge.frame_a", "hinge.frame_b - rod.frame_a", "rod.frame_b - lift.frame_a",
    ...                  "lift.frame_b - bob.frame_a", planarWorld=ac.inner(PlanarWorld()), wall=Fixed(),
    ...                  world=ac.inner(multibody.World(g=9.81)), rod=FixedTranslation(r=(2.0, 0.0)),
    ...                  hinge=Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  lift=PlanarToMultiBody(), bob=multibody.Body(m=3.0, r_CM=(0.0, 0.0, 0.0), I_33=1.0))
    >>> swung = run(model, at=[0.0, 0.5])
    >>> close((12.0 + 1.0) / 2 * swung["hinge.w"][-1] ** 2, -3.0 * 9.81 * 2.0 * np.sin(swung["hinge.phi"][-1]))
    True

    Source: PlanarMechanics.Interfaces.PlanarToMultiBody.
    """

    frame_a: Frame = Frame()
    frame_b: multibody.Frame = multibody.Frame()
    zPosition: Parameter = Parameter(0.0, unit="m", doc="height of the plane")
    fz: Variable = Variable(unit="N", doc="force along z that the plane carries")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        T = axis_rotation(3, a.phi)
        yield b.r_0 == (a.x, a.y, self.zPosition)
        yield root(b.R)
        yield defining(b.R.T == T)
        yield b.R.w == (0.0, 0.0, der(a.phi))
        yield T @ vector(a.fx, a.fy, self.fz) == -b.f
        yield a.t + b.t[2] == 0
