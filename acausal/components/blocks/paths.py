"""Motions from one position to another, as fast as speed and acceleration allow."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Expr, Output, Parameter, Variable, sqrt, where


class PartialPTP(Component, partial=True):
    """Fastest motion by a distance: constant acceleration, constant velocity (if it is reached), constant deceleration.

    Source: Modelica.Blocks.Sources.KinematicPTP2 with one axis.
    """

    qd_max: Parameter = Parameter(1.0, min=1e-60, doc="largest speed")
    qdd_max: Parameter = Parameter(1.0, min=1e-60, doc="largest acceleration")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the motion begins")
    qd: Output = Output(doc="velocity")
    qdd: Output = Output(doc="acceleration")
    endTime: Output = Output(unit="s", doc="time at which the motion ends")
    s: Variable = Variable(doc="distance moved")
    accelerating: Variable = Variable(unit="s", doc="duration of the acceleration, and of the deceleration")
    cruising: Variable = Variable(unit="s", doc="duration of the constant velocity")

    def motion(self, distance: Expr) -> Equations:
        """Equations of the motion by `distance`."""
        way = ac.abs(distance)
        direction = ac.sign(distance)
        acceleration = direction * self.qdd_max
        t = ac.time - self.startTime
        t1, t2, t3 = self.accelerating, self.accelerating + self.cruising, 2 * self.accelerating + self.cruising
        fast = way > self.qd_max**2 / self.qdd_max  # the speed limit is reached
        yield self.accelerating == where(fast, self.qd_max / self.qdd_max, sqrt(way / self.qdd_max))
        yield self.cruising == where(fast, way / self.qd_max - self.qd_max / self.qdd_max, 0.0)
        yield self.endTime == self.startTime + t3
        top = acceleration * t1
        moving = where(t < t1, acceleration * t, where(t < t2, top, where(t < t3, acceleration * (t3 - t), 0.0)))
        begun = where(t < t1, acceleration * t**2 / 2, top * (t - t1 / 2))
        ended = where(t < t3, distance - acceleration * (t3 - t) ** 2 / 2, distance)
        yield self.qdd == where(
            t < 0, 0.0, where(t < t1, acceleration, where(t < t2, 0.0, where(t < t3, -acceleration, 0.0)))
        )
        yield self.qd == where(t < 0, 0.0, moving)
        yield self.s == where(t < 0, 0.0, where(t < t2, begun, ended))


class KinematicPTP2(PartialPTP):
    """Fastest motion from `q_begin` to `q_end` within a speed `qd_max` and an acceleration `qdd_max`.

    Outputs the position `q`, the velocity `qd` and the acceleration `qdd`; at rest at `endTime`. The boolean `moving`
    is true until then, if there is a way to go.

    >>> motion = run(KinematicPTP2(q_end=1.0, qd_max=2.0, qdd_max=8.0), at=[0.0, 0.25, 0.5, 0.75, 1.0])
    >>> close(motion["q"], [0.0, 0.25, 0.75, 1.0, 1.0]) and close(motion["qd"], [0.0, 2.0, 2.0, 0.0, 0.0])
    True
    >>> motion["moving"]
    [1.0, 1.0, 1.0, 0.0, 0.0]

    Source: Modelica.Blocks.Sources.KinematicPTP2 with one axis.
    """

    q_begin: Parameter = Parameter(0.0, doc="position at the start")
    q_end: Parameter = Parameter(1.0, doc="position at the end")
    q: Output = Output(doc="position")
    moving: Discrete = Discrete(doc="whether the end has not been reached")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.motion(self.q_end - self.q_begin)
        yield self.q == self.q_begin + self.s
        away = ac.abs(self.q_end - self.q_begin) > 2e-15
        yield self.moving == where((ac.time < self.endTime) & away, 1.0, 0.0)


class KinematicPTP(PartialPTP):
    """Acceleration `y` of the fastest motion by `deltaq` within `qd_max` and `qdd_max`; integrate it twice.

    >>> class Move(Component):
    ...     path: KinematicPTP = KinematicPTP(deltaq=1.0, qd_max=2.0, qdd_max=8.0)
    ...     v: Integrator = Integrator()
    ...     s: Integrator = Integrator()
    ...     def equations(self):
    ...         yield connect(self.path.y, self.v.u)
    ...         yield connect(self.v.y, self.s.u)
    >>> close(run(Move(), at=[0.25, 0.5, 1.0])["s.y"], [0.25, 0.75, 1.0], 1e-4)
    True

    Source: Modelica.Blocks.Sources.KinematicPTP with one axis.
    """

    deltaq: Parameter = Parameter(1.0, doc="distance to move")
    y: Output = Output(doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield from self.motion(1.0 * self.deltaq)
        yield self.y == self.qdd
