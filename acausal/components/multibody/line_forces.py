"""Forces along the line between two frames."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from acausal import (
    Equations,
    Parameter,
    Variable,
    Vector,
    choose,
    defining,
    der,
    dot,
    is_root,
    max,
    noevent,
    potential_root,
    sqrt,
)

from .. import thermal, translational
from .frames import IDENTITY, TINY, ZEROS, resolve2, resolve_relative
from .free_joints import implied_mass
from .parts import PartialTwoFrames
from .world import Grounded


class PartialLineForce(PartialTwoFrames, partial=True):
    """Force `f` along the line from frame_a to frame_b, positive when it pulls them together; subclasses give it.

    ``s = |r_b - r_a|``, ``f_a = -e f``, ``f_b = e f``, no torques. Closer than `s_small`, the direction fades. Where
    line forces alone meet, the orientation of that point is the world's (Modelica asks for `fixedRotationAtFrame_a` or
    `fixedRotationAtFrame_b` there; here it is found, and they may be given all the same).

    Source: Modelica.Mechanics.MultiBody.Interfaces.PartialLineForce.
    """

    fixedRotationAtFrame_a: bool = False
    fixedRotationAtFrame_b: bool = False
    s_small: Parameter = Parameter(1e-10, unit="m", min=0.0, doc="distance below which the line has no direction")
    r_rel_0: Vector = Vector(
        Variable(unit="m", state_select="never", doc="from frame_a to frame_b, in the world frame")
    )
    e_rel_0: Vector = Vector(Variable(unit="1", doc="direction from frame_a to frame_b, in the world frame"))
    r_rel_a: Vector = Vector(Variable(unit="m", doc="from frame_a to frame_b, resolved in frame_a"))
    e_a: Vector = Vector(Variable(unit="1", doc="direction from frame_a to frame_b, resolved in frame_a"))
    length: Variable = Variable(unit="m", doc="distance of the frames")
    s: Variable = Variable(unit="m", doc="distance of the frames, s_small at least")
    f: Variable = Variable(unit="N", doc="force on frame_a toward frame_b, and on frame_b toward frame_a")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_rel_0 == self.frame_b.r_0 - self.frame_a.r_0
        square = dot(self.r_rel_0, self.r_rel_0)
        yield self.s == sqrt(noevent(max(square, self.s_small**2)))  # a root that has a derivative at zero
        yield self.length == sqrt(noevent(max(square, TINY**2)))
        yield self.e_rel_0 == self.r_rel_0 / self.s
        yield self.r_rel_a == resolve2(self.frame_a.R, self.r_rel_0)
        yield self.e_a == self.r_rel_a / self.s
        for frame in (self.frame_a, self.frame_b):
            yield potential_root(frame.R, 20000)
            yield choose(is_root(frame.R), [defining(frame.R.T == IDENTITY), frame.R.w == ZEROS], [frame.t == ZEROS])
        yield from self.cut_forces()

    def cut_forces(self) -> Equations:
        """Cut forces at both frames."""
        a, b = self.frame_a, self.frame_b
        yield a.f == -resolve2(a.R, self.e_rel_0) * self.f
        yield b.f == -resolve_relative(a.f, a.R, b.R)


class PartialMassiveLineForce(PartialLineForce, Grounded, partial=True):
    """Line force with a point mass on the line, at `lengthFraction` of its length, where `m` is given.

    Source: the common part of the line forces of Modelica.Mechanics.MultiBody.Forces.
    """

    massive: bool = False
    m: Parameter = Parameter(0.0, unit="kg", min=0.0, doc="mass of the point on the line")
    lengthFraction: Parameter = Parameter(0.5, unit="1", min=0.0, max=1.0, doc="its place, 0 at frame_a, 1 at frame_b")
    r_CM_0: Vector = Vector(Variable(unit="m", doc="position of the mass, in the world frame"))
    v_CM_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity of the mass"))
    ag_CM_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration of the mass, less gravity"))

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        return implied_mass(modifications)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.r_CM_0 == self.frame_a.r_0 + self.r_rel_0 * self.lengthFraction
        if self.massive:
            yield self.v_CM_0 == der(self.r_CM_0)
            yield self.ag_CM_0 == der(self.v_CM_0) - self.world.gravity(self.r_CM_0)
        else:
            yield self.v_CM_0 == ZEROS
            yield self.ag_CM_0 == ZEROS

    def pulls(self) -> tuple[Any, Any]:
        """Forces of the line on what holds it at frame_a and frame_b, along the line from a to b."""
        return -self.f, self.f

    def cut_forces(self) -> Equations:
        a, b, inertia = self.frame_a, self.frame_b, self.ag_CM_0 * self.m
        at_a, at_b = self.pulls()
        yield a.f == resolve2(a.R, inertia * (1 - self.lengthFraction) + self.e_rel_0 * at_a)
        yield b.f == resolve2(b.R, inertia * self.lengthFraction + self.e_rel_0 * at_b)


class LineForceWithMass(PartialMassiveLineForce):
    """Line between two frames for components of `translational`, which are connected to `flange_a` and `flange_b`.

    ``flange_a.s = 0``, ``flange_b.s = s``. (In Modelica one flange alone may be connected, with its reaction on the
    other; here the other is connected to a component that is fixed.)

    >>> model = assemble("world.frame_b - line.frame_a", "line.frame_b - bob.frame_a",
    ...                  "line.flange_a - spring.flange_a", "line.flange_b - spring.flange_b",
    ...                  world=ac.inner(World(g=10.0)), line=LineForceWithMass(),
    ...                  spring=translational.Spring(c=10.0, s_rel0=1.0),
    ...                  bob=PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True)))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-5.0])  # 10*(2 - 1)/2 - 10
    True

    Source: Modelica.Mechanics.MultiBody.Forces.LineForceWithMass.
    """

    flange_a: translational.Flange = translational.Flange()
    flange_b: translational.Flange = translational.Flange()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.s == 0
        yield self.flange_b.s == self.s
        yield self.f == -self.flange_b.f

    def pulls(self) -> tuple[Any, Any]:
        return -self.flange_a.f, -self.flange_b.f


class LineForceWithTwoMasses(PartialLineForce, Grounded):
    """Line between two frames for components of `translational`, with two point masses on it.

    `m_a` is on the line at `L_a` from frame_a, `m_b` at `L_b` from frame_b: the two halves of a cylinder, say.
    Across the line their inertia acts on both frames as on the ends of a rod. ``flange_a.s = 0``, ``flange_b.s = s``.

    >>> model = assemble("world.frame_b - line.frame_a", "line.frame_b - bob.frame_a",
    ...                  "line.flange_a - spring.flange_a", "line.flange_b - spring.flange_b",
    ...                  world=ac.inner(World(g=10.0)), line=LineForceWithTwoMasses(L_a=0.3, L_b=0.5, m_a=5.0, m_b=2.0),
    ...                  spring=translational.Spring(c=10.0, s_rel0=1.0),
    ...                  bob=PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True)))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-7.5])  # 10*(2 - 1)/4 - 10
    True

    Source: Modelica.Mechanics.MultiBody.Forces.LineForceWithTwoMasses.
    """

    massive: bool = False
    flange_a: translational.Flange = translational.Flange()
    flange_b: translational.Flange = translational.Flange()
    m_a: Parameter = Parameter(0.0, unit="kg", min=0.0, doc="mass near frame_a")
    m_b: Parameter = Parameter(0.0, unit="kg", min=0.0, doc="mass near frame_b")
    L_a: Parameter = Parameter(0.0, unit="m", doc="distance of m_a from frame_a")
    L_b: Parameter = Parameter(L_a, unit="m", doc="distance of m_b from frame_b")
    r_CM1_0: Vector = Vector(Variable(unit="m", state_select="avoid", doc="position of m_a, in the world frame"))
    r_CM2_0: Vector = Vector(Variable(unit="m", state_select="avoid", doc="position of m_b, in the world frame"))
    v_CM1_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity of m_a"))
    v_CM2_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity of m_b"))
    ag_CM1_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration of m_a, less gravity"))
    ag_CM2_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration of m_b, less gravity"))

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        return implied_mass(modifications, "m_a", "m_b")

    def equations(self) -> Equations:
        yield from super().equations()
        e = self.e_rel_0
        yield self.flange_a.s == 0
        yield self.flange_b.s == self.s
        yield self.f == -self.flange_b.f
        yield self.r_CM1_0 == self.frame_a.r_0 + e * self.L_a
        yield self.r_CM2_0 == self.frame_b.r_0 - e * self.L_b
        for r, v, ag in (
            (self.r_CM1_0, self.v_CM1_0, self.ag_CM1_0), (self.r_CM2_0, self.v_CM2_0, self.ag_CM2_0)
        ):  # fmt: skip
            yield v == (der(r) if self.massive else ZEROS)
            yield ag == (der(v) - self.world.gravity(r) if self.massive else ZEROS)

    def cut_forces(self) -> Equations:
        a, b, e = self.frame_a, self.frame_b, self.e_rel_0
        of_a, of_b = self.ag_CM1_0 * self.m_a, self.ag_CM2_0 * self.m_b
        lever = (of_a * self.L_a - of_b * self.L_b) / self.s
        moved = lever - e * dot(lever, e)  # what the other frame bears of a mass that moves across the line
        yield a.f == resolve2(a.R, of_a - moved - e * self.flange_a.f)
        yield b.f == resolve2(b.R, of_b + moved - e * self.flange_b.f)


class Spring(PartialMassiveLineForce):
    """Spring between two frames, ``f = c (s - s_unstretched)``.

    >>> model = assemble("world.frame_b - spring.frame_a", "spring.frame_b - bob.frame_a",
    ...                  world=ac.inner(World(g=10.0)), spring=Spring(c=10.0, s_unstretched=1.0),
    ...                  bob=PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True)))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-5.0])  # 10*(2 - 1)/2 - 10
    True

    Source: Modelica.Mechanics.MultiBody.Forces.Spring.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_unstretched: Parameter = Parameter(0.0, unit="m", doc="length without force")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s - self.s_unstretched)


class Damper(thermal.PartialConditionalHeatPort, PartialLineForce):
    """Damper between two frames, ``f = d ds/dt``; with `useHeatPort` its loss goes to `heatPort`.

    >>> bob = PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True), v_0=start((0.0, -1.0, 0.0), fixed=True))
    >>> model = assemble("world.frame_b - damper.frame_a", "damper.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)), damper=Damper(d=4.0))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-8.0])  # 4*1/2 - 10
    True

    Source: Modelica.Mechanics.MultiBody.Forces.Damper.
    """

    d: Parameter = Parameter(0.0, unit="N*s/m", min=0.0, doc="damping constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.d * der(self.s)
        yield self.lossPower == self.f * der(self.s)


class SpringDamperParallel(thermal.PartialConditionalHeatPort, PartialLineForce):
    """Spring and damper side by side, ``f = c (s - s_unstretched) + d ds/dt``.

    >>> bob = PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True), v_0=start((0.0, -1.0, 0.0), fixed=True))
    >>> model = assemble("world.frame_b - strut.frame_a", "strut.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)), strut=SpringDamperParallel(c=10.0, s_unstretched=1.0, d=4.0))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-3.0])  # (10*(2 - 1) + 4*1)/2 - 10
    True

    Source: Modelica.Mechanics.MultiBody.Forces.SpringDamperParallel.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_unstretched: Parameter = Parameter(0.0, unit="m", doc="length without force")
    d: Parameter = Parameter(0.0, unit="N*s/m", min=0.0, doc="damping constant")
    f_d: Variable = Variable(unit="N", doc="force of the damper")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f_d == self.d * der(self.s)
        yield self.f == self.c * (self.s - self.s_unstretched) + self.f_d
        yield self.lossPower == self.f_d * der(self.s)


class SpringDamperSeries(thermal.PartialConditionalHeatPort, PartialLineForce):
    """Spring and damper one after the other, ``f = c (s - s_unstretched - s_damper) = d ds_damper/dt``.

    >>> bob = PointMass(m=2.0, r_0=start((0.0, -2.0, 0.0), fixed=True))
    >>> model = assemble("world.frame_b - strut.frame_a", "strut.frame_b - bob.frame_a", bob=bob,
    ...                  world=ac.inner(World(g=10.0)),
    ...                  strut=SpringDamperSeries(c=10.0, s_unstretched=1.0, d=4.0))
    >>> close(run(model, at=[0.0])["bob.a_0[2]"], [-5.0])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.SpringDamperSeries.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_unstretched: Parameter = Parameter(0.0, unit="m", doc="length of the spring without force")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    s_damper_start: Parameter = Parameter(0.0, unit="m", doc="length of the damper at the start")
    s_damper: Variable = Variable(unit="m", start=s_damper_start, fixed=True, doc="length of the damper")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s - self.s_unstretched - self.s_damper)
        yield self.d * der(self.s_damper) == self.f
        yield self.lossPower == self.f * der(self.s_damper)
