"""The world frame, gravity, and frames fixed in it."""

from __future__ import annotations

from acausal import Component, DeclarationError, Equations, Parameter, Variable, Vector, defining, dot, outer, root

from .frames import IDENTITY, ZEROS, Frame, unit_vector


class World(Component):
    """The inertial frame, and the gravity of all bodies: one `World` in a model, ``world: World = ac.inner(World())``.

    Uniform gravity ``a = g n/|n|``, point gravity ``a = -mu r/|r|^3`` toward the origin, or none. A subclass that
    overrides `gravity` gives another field (Modelica redeclares `gravityAcceleration`). With `driveTrainMechanics3D`
    false, `Mounting1D`, `Rotor1D` and `BevelGear1D` exert nothing on the parts that carry them.

    >>> body = Body(r_0=start((0.0, 0.0, 5.0), fixed=True), v_0=start((1.0, 0.0, 0.0), fixed=True))
    >>> solution = run(assemble(world=ac.inner(World(g=10.0, n=(0.0, 0.0, -1.0))), body=body), at=[0.5, 1.0])
    >>> solution["body.r_0[1]"], solution["body.r_0[3]"]
    ([0.5, 1.0], [3.75, 0.0])

    Source: Modelica.Mechanics.MultiBody.World.
    """

    gravityType: str = "UniformGravity"
    driveTrainMechanics3D: bool = True
    g: Parameter = Parameter(9.80665, unit="m/s2", doc="acceleration of uniform gravity")
    n: Vector = Vector(Parameter(unit="1", doc="direction of uniform gravity, in the world frame"), (0.0, -1.0, 0.0))
    mu: Parameter = Parameter(3.986004418e14, unit="m3/s2", min=0.0, doc="gravity field constant of point gravity")
    direction: Vector = Vector(Parameter(unit="1", doc="n with length one; n must not be zero"), unit_vector(n))
    frame_b: Frame = Frame()
    uniform: Vector = Vector(Variable(unit="m/s2", doc="acceleration of uniform gravity"))
    point: Variable = Variable(unit="m3/s2", doc="field constant of point gravity")

    def gravity(self, r: Vector) -> Vector:
        """Acceleration at a point r of the world frame [m/s2]."""
        return self.uniform - r * (self.point / dot(r, r) ** 1.5)

    def equations(self) -> Equations:
        yield from super().equations()
        kinds = ("UniformGravity", "PointGravity", "NoGravity")
        if self.gravityType not in kinds:
            raise DeclarationError(f"World(gravityType={self.gravityType!r}): choose from {', '.join(kinds)}")
        yield root(self.frame_b.R)
        yield self.frame_b.r_0 == ZEROS
        yield defining(self.frame_b.R.T == IDENTITY)
        yield self.frame_b.R.w == ZEROS
        if self.gravityType == "UniformGravity":
            yield self.uniform == self.direction * self.g
        else:
            yield self.uniform == ZEROS
        yield self.point == (self.mu if self.gravityType == "PointGravity" else 0.0)


class Fixed(Component):
    """Frame fixed in the world at the place `r`.

    >>> parts = dict(world=ac.inner(World(g=10.0)), fixed=Fixed(r=(1.0, 2.0, 0.0)), body=Body(m=2.0))
    >>> solution = run(assemble("fixed.frame_b - body.frame_a", **parts))
    >>> solution["body.r_0[2]"][-1], solution["fixed.frame_b.f[2]"][-1]  # the force on `fixed`
    (2.0, -20.0)

    Source: Modelica.Mechanics.MultiBody.Parts.Fixed.
    """

    frame_b: Frame = Frame()
    r: Vector = Vector(Parameter(unit="m", doc="position in the world frame"), ZEROS)

    def equations(self) -> Equations:
        yield from super().equations()
        yield root(self.frame_b.R)
        yield self.frame_b.r_0 == self.r
        yield defining(self.frame_b.R.T == IDENTITY)
        yield self.frame_b.R.w == ZEROS


class Grounded(Component, partial=True):
    """A component that feels the gravity of the world.

    Source: own; Modelica's components have `outer world`.
    """

    world: World = outer(World())
