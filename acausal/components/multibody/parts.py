"""Massless rigid parts."""

from __future__ import annotations

from acausal import Component, Equations, Parameter, Vector, branch, cross

from .frames import ZEROS, Frame, equal, resolve1


class PartialTwoFrames(Component, partial=True):
    """Two frames, a and b.

    Source: Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames.
    """

    frame_a: Frame = Frame()
    frame_b: Frame = Frame()


class FixedTranslation(PartialTwoFrames):
    """Massless rigid rod: frame b is `r` away from frame a and has its orientation, ``r_b = r_a + T' r``.

    >>> parts = dict(world=ac.inner(World(g=10.0)), boom=FixedTranslation(r=(2.0, 0.0, 0.0)), load=Body(m=3.0))
    >>> solution = run(assemble("world.frame_b - boom.frame_a", "boom.frame_b - load.frame_a", **parts))
    >>> solution["load.r_0[1]"][-1], solution["boom.frame_a.t[3]"][-1]
    (2.0, 60.0)

    Source: Modelica.Mechanics.MultiBody.Parts.FixedTranslation.
    """

    r: Vector = Vector(Parameter(unit="m", doc="from frame_a to frame_b, resolved in frame_a"), ZEROS)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield branch(a.R, b.R)
        yield b.r_0 == a.r_0 + resolve1(a.R, self.r)
        yield from equal(b.R, a.R)
        yield a.f + b.f == ZEROS
        yield a.t + b.t + cross(self.r, b.f) == ZEROS
