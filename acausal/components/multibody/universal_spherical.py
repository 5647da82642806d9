"""A rod with a universal joint at one end and a ball joint at the other."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, branch, cross, der, dot, matrix, norm

from .frames import (
    PARALLEL,
    TINY,
    ZEROS,
    Frame,
    Rotation,
    absolute_rotation,
    equal,
    resolve1,
    resolve2,
    resolve_relative,
    unit_vector,
)
from .parts import PartialTwoFrames


class PartialUniversalRod(PartialTwoFrames, partial=True):
    """Rod from a universal joint at frame_a to a ball joint at frame_b; subclasses say how long it is.

    The first axis of the universal joint is `n1_a`, fixed in frame_a, the second is across it and the rod. The rod
    carries frame_ia, whose origin is that of frame_a. `f_rod` is the force along the rod, positive on frame_a when
    directed to frame_b.

    Source: the common part of Modelica.Mechanics.MultiBody.Joints.UniversalSpherical and Joints.Assemblies.JointUPS;
    its equations derived anew.
    """

    frame_ia: Frame = Frame()
    n1_a: Vector = Vector(Parameter(unit="1", evaluate=True, doc="first axis, resolved in frame_a"), (0.0, 0.0, 1.0))
    length: Variable = Variable(unit="m", doc="length of the rod")
    f_rod: Variable = Variable(unit="N", doc="force along the rod, positive on frame_a when directed to frame_b")
    rRod_0: Vector = Vector(
        Variable(unit="m", state_select="never", doc="from frame_a to frame_b, in the world frame")
    )
    eRod_a: Vector = Vector(Variable(unit="1", state_select="never", doc="direction of the rod, resolved in frame_a"))
    e2_a: Vector = Vector(Variable(unit="1", state_select="never", doc="second axis, resolved in frame_a"))
    e3_a: Vector = Vector(Variable(unit="1", state_select="never", doc="across both, resolved in frame_a"))

    def direction(self) -> Vector:
        """Direction of the rod, of length one, resolved in frame_ia."""
        raise NotImplementedError

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, e1 = self.frame_a, self.frame_b, self.eRod_a
        yield self.rRod_0 == b.r_0 - a.r_0
        yield e1 == resolve2(a.R, self.rRod_0) / self.length
        yield self.e2_a == unit_vector(cross(unit_vector(self.n1_a), e1))
        yield self.e3_a == cross(e1, self.e2_a)
        yield branch(a.R, self.frame_ia.R)
        yield self.frame_ia.r_0 == a.r_0
        yield from equal(self.frame_ia.R, absolute_rotation(a.R, self.rotation()))

    def rotation(self) -> Rotation:
        """From frame_a to frame_ia; its angular velocity from the motion of the rod's direction in frame_a."""
        e1, e2, e3 = self.eRod_a, self.e2_a, self.e3_a
        n1, e_ia = unit_vector(self.n1_a), self.direction()
        across = unit_vector(cross(n1, e_ia))
        T = matrix(e_ia, across, cross(e_ia, across)).transpose() @ matrix(e1, e2, e3)
        moving = der(e1)  # = w x e1 with w along n1 and e2
        return Rotation(T, T @ (n1 * (dot(moving, e2) / dot(n1, e3)) - e2 * dot(moving, e3)))

    def force_at_end(self, t_ia: Vector) -> Vector:
        """Force on the rod at frame_b, resolved in frame_a, where it carries the torque `t_ia` (resolved in frame_ia).

        About its axes the universal joint carries no torque.
        """
        e2, e3, n1 = self.e2_a, self.e3_a, unit_vector(self.n1_a)
        t = resolve1(self.rotation(), t_ia)
        across = e3 * (dot(t, e2) / self.length) - e2 * (dot(t, n1) / (self.length * dot(n1, e3)))
        return across - self.eRod_a * self.f_rod


class UniversalSpherical(PartialUniversalRod):
    """Massless rod of constant length, with a universal joint at frame_a and a ball joint at frame_b.

    The first axis of the universal joint is `n1_a`, fixed in frame_a, the second is across it and the rod. The rod
    carries frame_ia, whose origin is that of frame_a: `rRod_ia` is the vector from there to frame_b, resolved in
    frame_ia, which is parallel to frame_a where the rod points along that vector. `f_rod` is the force along the rod,
    positive on frame_a when directed to frame_b. With `computeRodLength`, the length follows from the start.
    (`constrained` is for the assemblies, which see to the length.)

    >>> bob = PointMass(m=3.0, r_0=start((0.0, -2.0, 0.0), fixed=True))
    >>> rod = UniversalSpherical(n1_a=(1.0, 0.0, 0.0), rRod_ia=(0.0, -1.0, 0.0), computeRodLength=True)
    >>> model = assemble("world.frame_b - rod.frame_a", "rod.frame_b - bob.frame_a", world=ac.inner(World(g=10.0)),
    ...                  rod=rod, bob=bob)
    >>> solution = run(model, at=[0.0])
    >>> close(solution["rod.f_rod"], [-30.0], 1e-3), close(solution["rod.length"], [2.0])  # the rod is pulled
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Joints.UniversalSpherical; its equations derived anew.
    """

    computeRodLength: bool = False
    constrained: bool = True
    rRod_ia: Vector = Vector(Parameter(unit="m", doc="from frame_ia to frame_b, resolved in frame_ia"), (1.0, 0.0, 0.0))
    rodLength: Parameter = Parameter(norm(rRod_ia), unit="m", min=TINY, doc="length, unless it is computed")
    slant: Parameter = Parameter(
        norm(cross(PartialUniversalRod.n1_a, rRod_ia)) / (norm(PartialUniversalRod.n1_a) * norm(rRod_ia)),
        unit="1", min=PARALLEL, doc="sine of the angle between n1_a and rRod_ia, which must not be parallel",
    )  # fmt: skip
    length: Variable = Variable(unit="m", start=rodLength, doc="length of the rod")

    def direction(self) -> Vector:
        return unit_vector(self.rRod_ia)

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, ia = self.frame_a, self.frame_b, self.frame_ia
        yield (der(self.length) if self.computeRodLength else self.length - self.rodLength) == 0
        if self.constrained:
            yield dot(self.rRod_0, self.rRod_0) == self.length**2
        # forces and torques on the rod, resolved in frame_a
        R_rel, f_b = self.rotation(), self.force_at_end(ia.t)
        yield a.f == -resolve1(R_rel, ia.f) - f_b
        yield a.t == -resolve1(R_rel, ia.t) - cross(self.eRod_a, f_b) * self.length
        yield b.f == resolve_relative(f_b, a.R, b.R)
        yield b.t == ZEROS
