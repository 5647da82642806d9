"""Forces along the line between two frames."""

from __future__ import annotations

from acausal import Equations, Parameter, conditional, vector

from .. import translational
from .interfaces import PartialCompliant, PartialLineForce


class Spring(PartialLineForce):
    """Spring between two frames, ``f = c (s - s_unstretched)``.

    >>> model = assemble("left.frame - spring.frame_a", "spring.frame_b - right.frame", left=Fixed(),
    ...                  spring=Spring(c=10.0, s_unstretched=3.0), right=Fixed(r=(3.0, 4.0)))
    >>> close([run(model)[f"spring.frame_b.{n}"][-1] for n in ("fx", "fy")], [20.0 * 0.6, 20.0 * 0.8])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.Spring, in the plane.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_unstretched: Parameter = Parameter(0.0, unit="m", doc="distance at which there is no force")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s - self.s_unstretched)


class Damper(PartialCompliant):
    """Damper between two frames, ``f = d v``.

    >>> model = assemble("wall.frame - guide.frame_a - damper.frame_a", "guide.frame_b - load.frame_a - damper.frame_b",
    ...                  wall=Fixed(), guide=Prismatic(s=start(1.0, fixed=True), v=start(2.0, fixed=True)),
    ...                  damper=Damper(d=6.0), load=PointMass(m=3.0), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model, at=[0.5, 1.0])["guide.v"], 2.0 * np.exp([-1.0, -2.0]))
    True

    Source: Modelica.Mechanics.MultiBody.Forces.Damper, in the plane.
    """

    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.d * self.v


class SpringDamper(PartialCompliant):
    """Spring and damper in parallel between two frames, ``f = c (s - s_unstretched) + d v``.

    >>> model = assemble("wall.frame - guide.frame_a - buffer.frame_a", "guide.frame_b - load.frame_a - buffer.frame_b",
    ...                  wall=Fixed(), guide=Prismatic(s=start(2.0, fixed=True), v=start(0.0, fixed=True)),
    ...                  buffer=SpringDamper(c=4.0, d=4.0, s_unstretched=1.0), load=PointMass(m=1.0),
    ...                  planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model, at=[0.5, 1.0])["guide.s"], 1.0 + np.exp([-1.0, -2.0]) * [2.0, 3.0])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.SpringDamperParallel, in the plane.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_unstretched: Parameter = Parameter(0.0, unit="m", doc="distance at which the spring has no force")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s - self.s_unstretched) + self.d * self.v


class LineForce(PartialLineForce):
    """Force of what is connected to `flange_b`, along the line between the frames: a cylinder, say, and its eyes.

    ``flange_b.s = s - s0``, and `f` is minus the force of the drive. The drive's housing is on frame a: with
    `useFlange_a` it is what is connected to `flange_a`, whose position is zero; else the reaction of `flange_b`.

    >>> model = assemble("wall.frame - line.frame_a - guide.frame_a", "guide.frame_b - load.frame_a - line.frame_b",
    ...                  "drive.flange - line.flange_b", wall=Fixed(), load=PointMass(m=3.0), line=LineForce(),
    ...                  guide=Prismatic(s=start(1.0, fixed=True), v=start(0.0, fixed=True)),
    ...                  drive=translational.ConstantForce(f_constant=6.0), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model, at=[0.0, 2.0])["guide.s"][-1], 1.0 + 0.5 * 2.0 * 2.0**2)
    True

    Source: Modelica.Mechanics.MultiBody.Forces.LineForceWithMass, in the plane and without mass.
    """

    useFlange_a: bool = False
    flange_a: translational.Flange = conditional(translational.Flange(), "useFlange_a")
    flange_b: translational.Flange = translational.Flange()
    s0: Parameter = Parameter(0.0, unit="m", doc="distance of the frames where flange b is at zero")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_b.s == self.s - self.s0
        yield self.f == -self.flange_b.f

    def reaction(self) -> Equations:
        if self.useFlange_a:
            yield self.flange_a.s == 0
            yield vector(self.frame_a.fx, self.frame_a.fy) == -self.e * self.flange_a.f
        else:
            yield from super().reaction()
