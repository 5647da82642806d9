"""Massless rigid parts."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, DeclarationError, Equations, Parameter, Vector, branch, choose, cross, rooted
from acausal.language.overdetermined import Choice

from .frames import (
    ZEROS,
    Frame,
    Rotation,
    absolute_rotation,
    axes_rotations,
    equal,
    from_nxy,
    inverse_rotation,
    planar_rotation,
    resolve1,
    resolve2,
    unit_vector,
)  # fmt: skip

DEGREE = 0.017453292519943295
"""One degree [rad]."""


class PartialTwoFrames(Component, partial=True):
    """Two frames, a and b.

    Source: Modelica.Mechanics.MultiBody.Interfaces.PartialTwoFrames.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_a", "frame_b")
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

    _must_connect: ClassVar[tuple[str, ...]] = ()
    r: Vector = Vector(Parameter(unit="m", doc="from frame_a to frame_b, resolved in frame_a"), ZEROS)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield branch(a.R, b.R)
        yield b.r_0 == a.r_0 + resolve1(a.R, self.r)
        yield from equal(b.R, a.R)
        yield a.f + b.f == ZEROS
        yield a.t + b.t + cross(self.r, b.f) == ZEROS


def turned(a: Frame, b: Frame, R_rel: Rotation, r: Vector | None = None) -> Choice:
    """Frame b is frame a turned by `R_rel` (and moved by `r`, resolved in a): orientations, forces and torques.

    Which of both orientations is computed depends on where the root of the tree is.
    """
    back = inverse_rotation(R_rel)
    t_b, t_a = resolve1(R_rel, b.t), resolve2(R_rel, a.t)
    if r is not None:
        t_b = t_b + cross(r, resolve1(R_rel, b.f))
        t_a = resolve2(R_rel, a.t - cross(r, a.f))
    return choose(
        rooted(a.R),
        [*equal(b.R, absolute_rotation(a.R, R_rel)), a.f == -resolve1(R_rel, b.f), a.t == -t_b],
        [*equal(a.R, absolute_rotation(b.R, back)), b.f == -resolve2(R_rel, a.f), b.t == -t_a],
    )


def oriented(a: Frame, b: Frame, R_rel: Rotation) -> Choice:
    """Frame b is frame a turned by `R_rel`: orientations alone."""
    back = inverse_rotation(R_rel)
    return choose(
        rooted(a.R), equal(b.R, absolute_rotation(a.R, R_rel)), equal(a.R, absolute_rotation(b.R, back))
    )


class FixedRotation(PartialTwoFrames):
    """Massless rigid part: frame b is moved by `r` and turned by a fixed rotation against frame a.

    `rotationType` says which: ``RotationAxis`` turns by `angle` about `n`; ``TwoAxesVectors`` has the x axis of frame b
    along `n_x` and its y axis in the plane of `n_x` and `n_y`; ``PlanarRotationSequence`` turns by `angles` about the
    axes numbered in `sequence`, one after the other. Angles are in degrees, as in Modelica.

    >>> model = assemble("world.frame_b - bend.frame_a", "bend.frame_b - load.frame_a", load=Body(m=3.0),
    ...                  world=ac.inner(World(g=10.0)), bend=FixedRotation(n=(0.0, 0.0, 1.0), angle=90.0))
    >>> solution = run(model)
    >>> close(solution["load.frame_a.f[1]"][-1], 30.0), close(solution["bend.frame_a.f[2]"][-1], 30.0)
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Parts.FixedRotation.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ()
    rotationType: str = "RotationAxis"
    sequence: tuple[float, ...] = (1.0, 2.0, 3.0)
    r: Vector = Vector(Parameter(unit="m", doc="from frame_a to frame_b, resolved in frame_a"), ZEROS)
    n: Vector = Vector(Parameter(unit="1", evaluate=True, doc="axis of rotation"), (1.0, 0.0, 0.0))
    angle: Parameter = Parameter(0.0, evaluate=True, doc="angle about n [deg]")
    n_x: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="along the x axis of frame_b, resolved in frame_a"), (1.0, 0.0, 0.0)
    )
    n_y: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="in the plane of the x and y axes of frame_b, resolved in frame_a"),
        (0.0, 1.0, 0.0),
    )
    angles: Vector = Vector(Parameter(evaluate=True, doc="angles about the axes of sequence [deg]"), ZEROS)

    def rotation(self) -> Rotation:
        """The rotation from frame_a to frame_b."""
        if self.rotationType == "RotationAxis":
            return planar_rotation(unit_vector(self.n), self.angle * DEGREE, 0.0)
        if self.rotationType == "TwoAxesVectors":
            return Rotation(from_nxy(self.n_x, self.n_y), self.n * 0.0)
        if self.rotationType == "PlanarRotationSequence":
            return axes_rotations(self.sequence, self.angles * DEGREE)
        raise DeclarationError(
            f"FixedRotation(rotationType={self.rotationType!r}): choose from RotationAxis, TwoAxesVectors, "
            "PlanarRotationSequence"
        )

    def equations(self) -> Equations:
        yield from super().equations()
        yield branch(self.frame_a.R, self.frame_b.R)
        yield self.frame_b.r_0 == self.frame_a.r_0 + resolve1(self.frame_a.R, self.r)
        yield turned(self.frame_a, self.frame_b, self.rotation(), self.r)
