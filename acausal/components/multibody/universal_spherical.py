"""A rod with a universal joint at one end and a ball joint at the other."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, Vector, branch, cross, der, dot, matrix, norm

from .frames import ZEROS, Frame, Rotation, absolute_rotation, equal, resolve1, resolve2, resolve_relative, unit_vector
from .parts import PartialTwoFrames


class UniversalSpherical(PartialTwoFrames):
    """Massless rod of constant length, with a universal joint at frame_a and a ball joint at frame_b.

    The first axis of the universal joint is `n1_a`, fixed in frame_a, the second is across it and the rod. The rod
    carries frame_ia, whose origin is that of frame_a: `rRod_ia` is the vector from there to frame_b, resolved in
    frame_ia, which is parallel to frame_a where the rod points along that vector. `f_rod` is the force along the rod,
    positive on frame_a when directed to frame_b. With `computeRodLength`, the length follows from the start.

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
    frame_ia: Frame = Frame()
    n1_a: Vector = Vector(Parameter(unit="1", evaluate=True, doc="first axis, resolved in frame_a"), (0.0, 0.0, 1.0))
    rRod_ia: Vector = Vector(Parameter(unit="m", doc="from frame_ia to frame_b, resolved in frame_ia"), (1.0, 0.0, 0.0))
    rodLength: Parameter = Parameter(norm(rRod_ia), unit="m", min=0.0, doc="length, unless it is computed")
    length: Variable = Variable(unit="m", start=rodLength, doc="length of the rod")
    f_rod: Variable = Variable(unit="N", doc="force along the rod, positive on frame_a when directed to frame_b")
    rRod_0: Vector = Vector(
        Variable(unit="m", state_select="never", doc="from frame_a to frame_b, in the world frame")
    )
    eRod_a: Vector = Vector(Variable(unit="1", state_select="never", doc="direction of the rod, resolved in frame_a"))
    e2_a: Vector = Vector(Variable(unit="1", state_select="never", doc="second axis, resolved in frame_a"))
    e3_a: Vector = Vector(Variable(unit="1", state_select="never", doc="across both, resolved in frame_a"))

    def equations(self) -> Equations:
        yield from super().equations()
        a, b, e1, e2, e3 = self.frame_a, self.frame_b, self.eRod_a, self.e2_a, self.e3_a
        n1 = unit_vector(self.n1_a)
        yield (der(self.length) if self.computeRodLength else self.length - self.rodLength) == 0
        yield self.rRod_0 == b.r_0 - a.r_0
        yield dot(self.rRod_0, self.rRod_0) == self.length**2
        yield e1 == resolve2(a.R, self.rRod_0) / self.length
        yield e2 == unit_vector(cross(n1, e1))
        yield e3 == cross(e1, e2)
        yield from self.rod_frame()
        # forces and torques on the rod, resolved in frame_a; about the axes the universal joint carries no torque
        R_rel = self.rotation()
        f_ia, t_ia = resolve1(R_rel, self.frame_ia.f), resolve1(R_rel, self.frame_ia.t)
        f_b = e3 * (dot(t_ia, e2) / self.length) - e2 * (dot(t_ia, n1) / (self.length * dot(n1, e3)))
        f_b = f_b - e1 * self.f_rod
        yield a.f == -f_ia - f_b
        yield a.t == -t_ia - cross(e1, f_b) * self.length
        yield b.f == resolve_relative(f_b, a.R, b.R)
        yield b.t == ZEROS

    def rotation(self) -> Rotation:
        """From frame_a to frame_ia; its angular velocity from the motion of the rod's direction in frame_a."""
        e1, e2, e3 = self.eRod_a, self.e2_a, self.e3_a
        n1, e_ia = unit_vector(self.n1_a), unit_vector(self.rRod_ia)
        across = unit_vector(cross(n1, e_ia))
        T = matrix(e_ia, across, cross(e_ia, across)).transpose() @ matrix(e1, e2, e3)
        moving = der(e1)  # = w x e1 with w along n1 and e2
        return Rotation(T, T @ (n1 * (dot(moving, e2) / dot(n1, e3)) - e2 * dot(moving, e3)))

    def rod_frame(self) -> Equations:
        """Place and orientation of frame_ia."""
        a, ia = self.frame_a, self.frame_ia
        yield branch(a.R, ia.R)
        yield ia.r_0 == a.r_0
        yield from equal(ia.R, absolute_rotation(a.R, self.rotation()))
