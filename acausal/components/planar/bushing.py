"""Elastic connection of two frames in all three directions."""

from __future__ import annotations

from acausal import Equations, Parameter, Variable, der

from .. import thermal
from .interfaces import PartialTwoFrames


class Bushing(thermal.PartialConditionalHeatPort, PartialTwoFrames):
    """Springs and dampers in x, in y and about the angle: ``f_x = c_x (s_relx - s_relx0) + d_x ds_relx/dt``, and so on.

    Distances are those in the world frame. The forces act at the origin of either frame, so frames that are apart
    should be held along their line only: what this element carries across has no counterpart about them.

    >>> model = assemble("wall.frame - mount.frame_a", "mount.frame_b - block.frame_a", wall=Fixed(),
    ...                  mount=Bushing(c_x=8.0, c_y=2.0, c_phi=4.5, d_x=0.0, d_y=0.0, d_phi=0.0, phi_rel0=0.5),
    ...                  block=Body(m=2.0, I=0.5, r=start((1.0, 0.5), fixed=True), v=start((0.0, 0.0), fixed=True),
    ...                             phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  planarWorld=ac.inner(PlanarWorld(constantGravity=(0.0, 0.0))))
    >>> t, moved = np.array([0.5, 1.0]), run(model, at=[0.5, 1.0])
    >>> close(moved["block.r[1]"], np.cos(2 * t)) and close(moved["block.r[2]"], 0.5 * np.cos(t))
    True
    >>> close(moved["block.phi"], 0.5 - 0.5 * np.cos(3 * t))
    True

    Source: PlanarMechanics.Parts.SpringDamper.
    """

    c_x: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant in x")
    c_y: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant in y")
    c_phi: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant of the angle")
    d_x: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant in x")
    d_y: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant in y")
    d_phi: Parameter = Parameter(1.0, unit="N*m*s/rad", min=0.0, doc="damping constant of the angle")
    s_relx0: Parameter = Parameter(0.0, unit="m", doc="distance in x without force")
    s_rely0: Parameter = Parameter(0.0, unit="m", doc="distance in y without force")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="angle without torque")
    s_relx: Variable = Variable(unit="m", doc="distance in x, frame_b.x - frame_a.x")
    s_rely: Variable = Variable(unit="m", doc="distance in y")
    phi_rel: Variable = Variable(unit="rad", doc="angle of frame b against frame a")
    v_relx: Variable = Variable(unit="m/s", doc="velocity in x")
    v_rely: Variable = Variable(unit="m/s", doc="velocity in y")
    w_rel: Variable = Variable(unit="rad/s", doc="angular velocity")
    f_x: Variable = Variable(unit="N", doc="force in x that pulls the frames together")
    f_y: Variable = Variable(unit="N", doc="force in y")
    tau: Variable = Variable(unit="N*m", doc="torque that turns frame b back")

    def equations(self) -> Equations:
        yield from super().equations()
        a, b = self.frame_a, self.frame_b
        yield self.s_relx == b.x - a.x
        yield self.s_rely == b.y - a.y
        yield self.phi_rel == b.phi - a.phi
        yield self.v_relx == der(self.s_relx)
        yield self.v_rely == der(self.s_rely)
        yield self.w_rel == der(self.phi_rel)
        yield self.f_x == self.c_x * (self.s_relx - self.s_relx0) + self.d_x * self.v_relx
        yield self.f_y == self.c_y * (self.s_rely - self.s_rely0) + self.d_y * self.v_rely
        yield self.tau == self.c_phi * (self.phi_rel - self.phi_rel0) + self.d_phi * self.w_rel
        for frame, sign in ((a, -1.0), (b, 1.0)):
            yield frame.fx == sign * self.f_x
            yield frame.fy == sign * self.f_y
            yield frame.t == sign * self.tau
        lost = self.d_x * self.v_relx**2 + self.d_y * self.v_rely**2
        yield self.lossPower == lost + self.d_phi * self.w_rel**2
