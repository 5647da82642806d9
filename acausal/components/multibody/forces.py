"""Forces and torques given by signals."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, DeclarationError, Equations, Input, Variable, Vector, conditional, cross

from .frames import ZEROS, Frame, resolve1, resolve2
from .parts import PartialTwoFrames


class PartialResolved(Component, partial=True):
    """Something whose vectors are resolved in a frame that `resolveInFrame` names.

    ``world``, ``frame_a``, ``frame_b`` or ``frame_resolve``, as far as the component has these.

    Source: the types ResolveInFrameA, ResolveInFrameB and ResolveInFrameAB of Modelica.Mechanics.MultiBody.Types.
    """

    resolveInFrame: str = "world"
    frame_resolve: Frame = conditional(Frame(), "useFrameResolve")

    @property
    def useFrameResolve(self) -> bool:
        """Whether vectors are resolved in a frame of its own."""
        return self.resolveInFrame == "frame_resolve"

    def to_world(self, v: Vector, given: str = "") -> Vector:
        """A vector of the component's signals (resolved in the frame `given`), resolved in the world frame."""
        frame = self._frame(given or self.resolveInFrame)
        return v if frame is None else resolve1(frame.R, v)

    def from_world(self, v: Vector, wanted: str = "") -> Vector:
        """The other way."""
        frame = self._frame(wanted or self.resolveInFrame)
        return v if frame is None else resolve2(frame.R, v)

    def _frame(self, name: str) -> Frame | None:
        known = ["world", *(n for n in ("frame_a", "frame_b") if n in type(self)._children), "frame_resolve"]
        if name not in known:
            raise DeclarationError(
                f"{type(self).__name__}(resolveInFrame={name!r}): choose from {', '.join(known)}"
            )
        return None if name == "world" else getattr(self, name)

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useFrameResolve:
            yield self.frame_resolve.f == ZEROS
            yield self.frame_resolve.t == ZEROS


class PartialWorldAction(PartialResolved, partial=True):
    """Acts at frame_b, from the world.

    Source: Modelica.Mechanics.MultiBody.Interfaces.PartialOneFrame_b.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("frame_b",)
    frame_b: Frame = Frame()


class WorldForce(PartialWorldAction):
    """External force `force` on frame_b, resolved in the world frame (or as `resolveInFrame` says).

    >>> model = assemble("push.frame_b - stone.frame_a", "x.y - push.force[0]", "y.y - push.force[1]",
    ...                  "y.y - push.force[2]", world=ac.inner(World(gravityType="NoGravity")),
    ...                  push=WorldForce(), stone=Body(m=2.0),
    ...                  x=Constant(k=4.0), y=Constant(k=0.0))
    >>> close(run(model, at=[1.0])["stone.r_0[1]"], [1.0])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.WorldForce.
    """

    force: Vector = Vector(Input(unit="N", doc="force on frame_b"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_b.f == -resolve2(self.frame_b.R, self.to_world(self.force))
        yield self.frame_b.t == ZEROS


class WorldTorque(PartialWorldAction):
    """External torque `torque` on frame_b, resolved in the world frame (or as `resolveInFrame` says).

    >>> model = assemble("turn.frame_b - wheel.frame_a", "x.y - turn.torque[0]", "y.y - turn.torque[1]",
    ...                  "y.y - turn.torque[2]", world=ac.inner(World(gravityType="NoGravity")), turn=WorldTorque(),
    ...                  wheel=Body(I_11=2.0), x=Constant(k=4.0), y=Constant(k=0.0))
    >>> close(run(model, at=[1.0])["wheel.w_a[1]"], [2.0])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.WorldTorque.
    """

    torque: Vector = Vector(Input(unit="N*m", doc="torque on frame_b"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_b.t == -resolve2(self.frame_b.R, self.to_world(self.torque))
        yield self.frame_b.f == ZEROS


class WorldForceAndTorque(PartialWorldAction):
    """External force and torque on frame_b.

    >>> model = assemble("act.frame_b - wheel.frame_a", "x.y - act.torque[0]", "y.y - act.torque[1]",
    ...                  "y.y - act.torque[2]", "x.y - act.force[0]", "y.y - act.force[1]", "y.y - act.force[2]",
    ...                  world=ac.inner(World(gravityType="NoGravity")), act=WorldForceAndTorque(),
    ...                  wheel=Body(I_11=2.0, m=2.0), x=Constant(k=4.0), y=Constant(k=0.0))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["wheel.w_a[1]"], [2.0]), close(solution["wheel.v_0[1]"], [2.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Forces.WorldForceAndTorque.
    """

    force: Vector = Vector(Input(unit="N", doc="force on frame_b"))
    torque: Vector = Vector(Input(unit="N*m", doc="torque on frame_b"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.frame_b.f == -resolve2(self.frame_b.R, self.to_world(self.force))
        yield self.frame_b.t == -resolve2(self.frame_b.R, self.to_world(self.torque))


class PartialAction(PartialTwoFrames, PartialResolved, partial=True):
    """Acts on frame_b, with its reaction on frame_a; resolved in frame_b by default.

    Source: the common part of Modelica.Mechanics.MultiBody.Forces.Force and Torque.
    """

    resolveInFrame: str = "frame_b"


def _react(action: PartialAction, f_b_0: Vector, t_b_0: Vector) -> Equations:
    """Cut forces and torques at both frames from those at frame_b, resolved in the world frame."""
    a, b = action.frame_a, action.frame_b
    yield b.f == resolve2(b.R, f_b_0)
    yield b.t == resolve2(b.R, t_b_0)
    yield a.f == -resolve2(a.R, f_b_0)
    yield a.t == -resolve2(a.R, t_b_0 + cross(b.r_0 - a.r_0, f_b_0))


class Force(PartialAction):
    """Force `force` on frame_b, and its reaction (with a torque, where the force points past it) on frame_a.

    >>> model = assemble("world.frame_b - push.frame_a", "push.frame_b - stone.frame_a", "x.y - push.force[0]",
    ...                  "y.y - push.force[1]", "y.y - push.force[2]", push=Force(), stone=Body(m=2.0),
    ...                  world=ac.inner(World(gravityType="NoGravity")), x=Constant(k=4.0), y=Constant(k=0.0))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["stone.r_0[1]"], [1.0]), close(solution["push.frame_a.f[1]"], [4.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Forces.Force.
    """

    force: Vector = Vector(Input(unit="N", doc="force on frame_b"))
    f_b_0: Vector = Vector(Variable(unit="N", doc="cut force at frame_b, in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f_b_0 == -self.to_world(self.force)
        yield from _react(self, self.f_b_0, self.f_b_0 * 0.0)


class Torque(PartialAction):
    """Torque `torque` on frame_b, and its reaction on frame_a.

    >>> model = assemble("world.frame_b - turn.frame_a", "turn.frame_b - wheel.frame_a", "x.y - turn.torque[0]",
    ...                  "y.y - turn.torque[1]", "y.y - turn.torque[2]", turn=Torque(), wheel=Body(I_11=2.0),
    ...                  world=ac.inner(World(gravityType="NoGravity")), x=Constant(k=4.0), y=Constant(k=0.0))
    >>> close(run(model, at=[1.0])["wheel.w_a[1]"], [2.0])
    True

    Source: Modelica.Mechanics.MultiBody.Forces.Torque.
    """

    torque: Vector = Vector(Input(unit="N*m", doc="torque on frame_b"))
    t_b_0: Vector = Vector(Variable(unit="N*m", doc="cut torque at frame_b, in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.t_b_0 == -self.to_world(self.torque)
        yield from _react(self, self.t_b_0 * 0.0, self.t_b_0)


class ForceAndTorque(PartialAction):
    """Force and torque on frame_b, and their reactions on frame_a.

    >>> model = assemble("world.frame_b - act.frame_a", "act.frame_b - wheel.frame_a", "x.y - act.torque[0]",
    ...                  "y.y - act.torque[1]", "y.y - act.torque[2]", "x.y - act.force[0]", "y.y - act.force[1]",
    ...                  "y.y - act.force[2]", act=ForceAndTorque(), wheel=Body(I_11=2.0, m=2.0),
    ...                  world=ac.inner(World(gravityType="NoGravity")), x=Constant(k=4.0), y=Constant(k=0.0))
    >>> solution = run(model, at=[1.0])
    >>> close(solution["wheel.w_a[1]"], [2.0]), close(solution["wheel.v_0[1]"], [2.0])
    (True, True)

    Source: Modelica.Mechanics.MultiBody.Forces.ForceAndTorque.
    """

    force: Vector = Vector(Input(unit="N", doc="force on frame_b"))
    torque: Vector = Vector(Input(unit="N*m", doc="torque on frame_b"))
    f_b_0: Vector = Vector(Variable(unit="N", doc="cut force at frame_b, in the world frame"))
    t_b_0: Vector = Vector(Variable(unit="N*m", doc="cut torque at frame_b, in the world frame"))

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f_b_0 == -self.to_world(self.force)
        yield self.t_b_0 == -self.to_world(self.torque)
        yield from _react(self, self.f_b_0, self.t_b_0)
