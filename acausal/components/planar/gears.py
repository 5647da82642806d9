"""Gears that mesh in the plane, on axes that may move."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, atan2, cos, der, dot, sin

from .interfaces import PartialTwoFrames, between


class PartialGearContact(PartialTwoFrames, partial=True):
    """Two gears that mesh without losses or play, ``(phi_a - phi_gear) r_a + side (phi_b - phi_gear) r_b = 0``.

    `phi_gear` is the angle of the line between the axes. Something else keeps these ``r_a + side r_b`` apart.

    Source: PlanarMechanics.GearComponents.RigidNoLossExternal.
    """

    r_a: Parameter = Parameter(1.0, unit="m", min=1e-12, doc="radius of gear a")
    r_b: Parameter = Parameter(1.0, unit="m", min=1e-12, doc="radius of gear b")
    phi_gear: Variable = Variable(unit="rad", doc="angle of the line between the axes")
    w_gear: Variable = Variable(unit="rad/s", doc="its angular velocity")
    w_a: Variable = Variable(unit="rad/s", doc="angular velocity of gear a")
    w_b: Variable = Variable(unit="rad/s", doc="angular velocity of gear b")
    F_n: Variable = Variable(unit="N", doc="force between the teeth")
    xmesh_a: Variable = Variable(unit="m", doc="way of the teeth of gear a through the mesh")
    xmesh_b: Variable = Variable(unit="m", doc="way of the teeth of gear b")
    v_mesh: Variable = Variable(unit="m/s", doc="velocity of the teeth through the mesh")
    a_mesh: Variable = Variable(unit="m/s2", doc="their acceleration")

    @property
    def side(self) -> float:
        """1 where the gears touch from outside, -1 where one is inside of the other."""
        return 1.0

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        s = between(a, b) * self.side
        yield self.w_gear == der(self.phi_gear)
        yield self.w_gear * dot(s, s) == s[0] * der(s[1]) - s[1] * der(s[0])
        yield self.w_a == der(a.phi)
        yield self.w_b == der(b.phi)
        yield self.xmesh_a == (a.phi - self.phi_gear) * self.r_a
        yield self.xmesh_b == -self.side * (b.phi - self.phi_gear) * self.r_b
        yield self.xmesh_a == self.xmesh_b
        yield self.v_mesh == der(self.xmesh_a)
        yield self.a_mesh == der(self.v_mesh)
        yield a.t == self.F_n * self.r_a
        yield b.t == self.side * self.F_n * self.r_b
        yield a.fx == -sin(self.phi_gear) * self.F_n
        yield a.fy == cos(self.phi_gear) * self.F_n
        yield a.fx + b.fx == 0
        yield a.fy + b.fy == 0

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        s = between(self.frame_a, self.frame_b) * self.side
        yield self.phi_gear == atan2(s[1], s[0])


class RigidNoLossExternal(PartialGearContact):
    """Two spur gears that touch from outside, their axes ``r_a + r_b`` apart; `phi_gear` is from a to b.

    >>> model = assemble("here.frame - one.frame_a", "there.frame - two.frame_a", "one.frame_b - big.frame_a",
    ...                  "two.frame_b - small.frame_a", "big.frame_a - mesh.frame_a", "small.frame_a - mesh.frame_b",
    ...                  "drive.flange - one.flange_a", drive=rotational.ConstantTorque(tau_constant=3.0),
    ...                  here=Fixed(), there=Fixed(r=(3.0, 0.0)), big=Body(m=1.0, I=4.0), small=Body(m=1.0, I=0.5),
    ...                  one=Revolute(useFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  two=Revolute(), mesh=RigidNoLossExternal(r_a=2.0), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model)["two.w"][-1], -2.0 * 3.0 / (4.0 + 4.0 * 0.5))
    True

    Source: PlanarMechanics.GearComponents.RigidNoLossExternal.
    """


class RigidNoLossInternal(PartialGearContact):
    """A gear a inside of a ring b, their axes ``r_b - r_a`` apart; `phi_gear` is from b to a.

    >>> model = assemble("here.frame - one.frame_a", "there.frame - two.frame_a", "one.frame_b - ring.frame_a",
    ...                  "two.frame_b - small.frame_a", "small.frame_a - mesh.frame_a", "ring.frame_a - mesh.frame_b",
    ...                  "drive.flange - one.flange_a", drive=rotational.ConstantTorque(tau_constant=3.0),
    ...                  here=Fixed(), there=Fixed(r=(2.0, 0.0)), ring=Body(m=1.0, I=4.0), small=Body(m=1.0, I=0.5),
    ...                  one=Revolute(useFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  two=Revolute(), mesh=RigidNoLossInternal(r_b=3.0), planarWorld=ac.inner(PlanarWorld()))
    >>> close(run(model)["two.w"][-1], 3.0 * 3.0 / (4.0 + 9.0 * 0.5))
    True

    Source: PlanarMechanics.GearComponents.RigidNoLossInternal.
    """

    @property
    def side(self) -> float:
        return -1.0
