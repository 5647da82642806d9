"""Constraints between two frames that have no coordinates of their own, in the place of joints that close a loop.

``multibody.constraints.Revolute(n=(0.0, 1.0, 0.0))``: the names are those of the joints, so that they have a module of
their own.
"""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, cross, dot

from .frames import (
    ZEROS,
    Rotation,
    planar_basis,
    relative_rotation,
    resolve1,
    resolve2,
    rotation_residual,
    same_sense,
    unit_vector,
)  # fmt: skip
from .parts import PartialTwoFrames


class PartialConstraint(PartialTwoFrames, partial=True):
    """Of the three translations of frame_b along the axes of frame_a, those that are not locked are free.

    ``r_rel_a = T_a (r_b - r_a)``; where a translation is free, the force along it is zero.

    Source: the common part of the joints of Modelica.Mechanics.MultiBody.Joints.Constraints.
    """

    x_locked: bool = True
    y_locked: bool = True
    z_locked: bool = True
    r_rel_a: Vector = Vector(Variable(unit="m", state_select="avoid", doc="from frame_a to frame_b, in frame_a"))

    def rotation(self) -> Rotation:
        """The rotation from frame_a to frame_b."""
        return relative_rotation(self.frame_a.R, self.frame_b.R)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, r, R_rel = self.frame_a, self.frame_b, self.r_rel_a, self.rotation()
        yield r == resolve2(a.R, b.r_0 - a.r_0)
        for k, locked in enumerate((self.x_locked, self.y_locked, self.z_locked)):
            yield (r[k] if locked else a.f[k]) == 0
        yield a.f + resolve1(R_rel, b.f) == ZEROS
        yield a.t + resolve1(R_rel, b.t) - cross(r, a.f) == ZEROS


class Prismatic(PartialConstraint):
    """The orientation is fixed, and so are the translations that are locked.

    >>> model = assemble("world.frame_b - rail.frame_a", "rail.frame_b - load.frame_a", world=ac.inner(World(g=10.0)),
    ...                  rail=constraints.Prismatic(y_locked=False), load=Body(m=2.0))
    >>> close(run(model, at=[1.0])["rail.r_rel_a[2]"], [-5.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Prismatic.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield rotation_residual(self.frame_a.R.T, self.frame_b.R.T) == ZEROS

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield same_sense(self.frame_a.R.T, self.frame_b.R.T)


class Revolute(PartialConstraint):
    """The axis `n` keeps its direction, and no torque acts about it: a hinge, as far as translations are locked.

    >>> bob = Body(m=2.0, r_CM=(1.0, 0.0, 0.0), I_33=0.0)
    >>> model = assemble("world.frame_b - hinge.frame_a", "hinge.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)), hinge=constraints.Revolute(n=(0.0, 0.0, 1.0)))
    >>> close(run(model, at=[0.0])["bob.z_a[3]"], [-10.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Revolute.
    """

    n: Vector = Vector(
        Parameter(unit="1", evaluate=True, doc="axis, resolved in frame_a (and in frame_b)"), (0.0, 1.0, 0.0)
    )

    def equations(self) -> Equations:
        yield from super().equations()
        e = unit_vector(self.n)
        e_a = resolve1(self.rotation(), e)  # the axis of frame_b, resolved in frame_a
        for across in planar_basis(e):
            yield dot(across, e_a) == 0
        yield dot(self.frame_a.t, e) == 0


class Spherical(PartialConstraint):
    """The orientation is free, and no torque is carried: a ball joint, as far as translations are locked.

    >>> bob = Body(m=2.0, r_CM=(0.0, 0.0, 1.0), I_11=0.0, I_22=0.0)
    >>> model = assemble("world.frame_b - ball.frame_a", "ball.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)), ball=constraints.Spherical())
    >>> close(run(model, at=[0.0])["bob.z_a[1]"], [10.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Spherical.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_b.t == ZEROS


class Universal(PartialConstraint):
    """`n_a`, fixed in frame_a, and `n_b`, fixed in frame_b, stay perpendicular, and no torque acts about them.

    They are perpendicular at the start as well, so that they must not be parallel as they are given.

    >>> bob = Body(m=2.0, r_CM=(0.0, 0.0, 1.0), I_11=0.0, I_22=0.0)
    >>> model = assemble("world.frame_b - cardan.frame_a", "cardan.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)), cardan=constraints.Universal())
    >>> close(run(model, at=[0.0])["bob.z_a[1]"], [10.0])
    True

    Source: Modelica.Mechanics.MultiBody.Joints.Constraints.Universal.
    """

    n_a: Vector = Vector(Parameter(unit="1", evaluate=True, doc="first axis, in frame_a"), (1.0, 0.0, 0.0))
    n_b: Vector = Vector(Parameter(unit="1", evaluate=True, doc="second axis, in frame_b"), (0.0, 1.0, 0.0))

    def equations(self) -> Equations:
        yield from super().equations()
        n_a, n_b = unit_vector(self.n_a), unit_vector(self.n_b)
        yield dot(self.frame_a.t, n_a) == 0
        yield dot(self.frame_b.t, n_b) == 0
        yield dot(resolve1(self.rotation(), n_b), n_a) == 0
