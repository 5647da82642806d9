"""Masses, rigid and compliant connections."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Discrete, Equations, Input, Parameter, Variable, der, structural, where

from .. import thermal
from .interfaces import Flange, PartialCompliant, PartialCompliantWithRelativeStates, PartialRigid, PartialTwoFlanges


class Mass(PartialRigid):
    """Sliding mass of length `L`, ``v = ds/dt``, ``a = dv/dt``, ``m a = flange_a.f + flange_b.f``.

    >>> model = assemble("drive.flange - mass.flange_a", drive=ConstantForce(f_constant=6.0),
    ...                  mass=Mass(m=2.0, L=0.5, s=start(0.0, fixed=True), v=start(1.0, fixed=True)))
    >>> mass = run(model, at=[0.5, 1.0])
    >>> close(mass["mass.s"], [0.875, 2.5]) and close(mass["mass.flange_b.s"], [1.125, 2.75])
    True

    Source: Modelica.Mechanics.Translational.Components.Mass.
    """

    stateSelect: str = "default"
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    s: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the centre")
    v: Variable = Variable(unit="m/s", state_select=structural("stateSelect"), doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange_a.f + self.flange_b.f


class PointMass(Component):
    """Sliding mass with one flange, ``s = flange.s``, ``v = ds/dt``, ``a = dv/dt``, ``m a = flange.f``.

    >>> model = assemble("drive.flange - mass.flange", drive=ConstantForce(f_constant=6.0),
    ...                  mass=PointMass(m=2.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.s"], [0.875, 2.5])
    True

    Source: Newton's second law (Eq. 14); Modelica.Mechanics.Translational.Components.Mass with L = 0.
    """

    flange: Flange = Flange()
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    s: Variable = Variable(unit="m", doc="position")
    v: Variable = Variable(unit="m/s", doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s == self.flange.s
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.m * self.a == self.flange.f


class Rod(PartialRigid):
    """Rod without mass, ``0 = flange_a.f + flange_b.f``.

    >>> model = assemble("wall.flange - rod.flange_a", "rod.flange_b - drive.flange", wall=Fixed(s0=0.25),
    ...                  rod=Rod(L=0.5), drive=ConstantForce(f_constant=6.0))
    >>> rod = run(model)
    >>> rod["rod.flange_b.s"][-1], rod["wall.flange.f"][-1]
    (0.75, 6.0)

    Source: Modelica.Mechanics.Translational.Components.Rod.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.f + self.flange_b.f == 0


class Fixed(Component):
    """Flange fixed in the housing at `s0`, ``flange.s = s0``.

    >>> model = assemble("wall.flange - spring.flange_a", "spring.flange_b - drive.flange", wall=Fixed(s0=0.25),
    ...                  spring=Spring(c=4.0), drive=ConstantForce(f_constant=2.0))
    >>> run(model)["drive.flange.s"][-1]
    0.75

    Source: Modelica.Mechanics.Translational.Components.Fixed.
    """

    flange: Flange = Flange()
    s0: Parameter = Parameter(0.0, unit="m", doc="position")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.s == self.s0


class Spring(PartialCompliant):
    """Linear spring, ``f = c (s_rel - s_rel0)``.

    >>> model = assemble("wall.flange - spring.flange_a", "spring.flange_b - mass.flange_a", wall=Fixed(),
    ...                  spring=Spring(c=8.0, s_rel0=0.5),
    ...                  mass=Mass(m=2.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.s"], 0.5 + 0.5 * np.cos([1.0, 2.0]))
    True

    Source: Modelica.Mechanics.Translational.Components.Spring.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s_rel - self.s_rel0)


class Damper(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Linear translational damper, ``f = d v_rel``; the power ``f v_rel`` is lost.

    >>> model = assemble("wall.flange - damper.flange_a", "damper.flange_b - mass.flange_a", wall=Fixed(),
    ...                  damper=Damper(d=4.0), mass=Mass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], 3 * np.exp([-1.0, -2.0]))
    True

    Source: Modelica.Mechanics.Translational.Components.Damper.
    """

    d: Parameter = Parameter(0.0, unit="N*s/m", min=0.0, doc="damping constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.d * self.v_rel
        yield self.lossPower == self.f * self.v_rel


class SpringDamper(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Linear spring and damper in parallel, ``f = c (s_rel - s_rel0) + d v_rel``.

    >>> model = assemble("wall.flange - shaft.flange_a", "shaft.flange_b - mass.flange_a", wall=Fixed(),
    ...                  shaft=SpringDamper(c=8.0, d=8.0),
    ...                  mass=Mass(m=2.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.s"], [2.0 * np.exp(-1.0), 3.0 * np.exp(-2.0)])
    True

    Source: Modelica.Mechanics.Translational.Components.SpringDamper.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.f == self.c * (self.s_rel - self.s_rel0) + self.d * self.v_rel
        yield self.lossPower == self.d * self.v_rel * self.v_rel


class RelativeStates(PartialTwoFlanges):
    """The relative position and velocity of two flanges as states, ``s_rel = flange_b.s - flange_a.s``; no force.

    >>> model = assemble("one.flange_a - relative.flange_a", "two.flange_a - relative.flange_b",
    ...                  relative=RelativeStates(s_rel=start(0.5, fixed=True), v_rel=start(1.0, fixed=True)),
    ...                  one=Mass(s=start(0.0, fixed=True), v=start(2.0, fixed=True)), two=Mass())
    >>> close(run(model, at=[0.0, 1.0])["two.s"], [0.5, 3.5])
    True

    Source: Modelica.Mechanics.Translational.Components.RelativeStates.
    """

    stateSelect: str = "prefer"
    s_rel: Variable = Variable(
        unit="m", start=0.0, state_select=structural("stateSelect"), doc="relative position"
    )
    v_rel: Variable = Variable(
        unit="m/s", start=0.0, state_select=structural("stateSelect"), doc="relative velocity"
    )
    a_rel: Variable = Variable(unit="m/s2", doc="relative acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_rel == self.flange_b.s - self.flange_a.s
        yield self.v_rel == der(self.s_rel)
        yield self.a_rel == der(self.v_rel)
        yield self.flange_a.f == 0
        yield self.flange_b.f == 0


class ElastoGap(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Spring and damper that touch where ``s_rel < s_rel0``; contact never pulls.

    In contact ``f = f_c + f_d``, ``f_c = -f_ref |(s_rel - s_rel0)/s_ref|^n`` with ``f_ref = c s_ref``, and ``f_d =
    d v_rel`` limited to ``-f_c ... f_c``; without contact ``f = 0``.

    >>> model = assemble("floor.flange - gap.flange_a", "gap.flange_b - ball.flange", floor=Fixed(),
    ...                  gap=ElastoGap(c=np.pi**2 * 2.0, d=0.0),
    ...                  ball=PointMass(m=2.0, s=start(0.2, fixed=True), v=start(-1.0, fixed=True)))
    >>> close(run(model, at=[0.2, 0.7, 1.2, 1.4])["ball.s"], [0.0, -1 / np.pi, 0.0, 0.2], 1e-4)
    True

    Source: Modelica.Mechanics.Translational.Components.ElastoGap.
    """

    c: Parameter = Parameter(1.0, unit="N/m", min=0.0, doc="spring constant")
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    s_rel0: Parameter = Parameter(0.0, unit="m", doc="unstretched length")
    s_ref: Parameter = Parameter(1.0, unit="m", min=1e-15, doc="compression at which the spring has f_ref")
    f_ref: Parameter = Parameter(c * s_ref, unit="N", min=0.0, doc="force of the spring at s_ref")
    n: Parameter = Parameter(1.0, unit="1", min=1.0, doc="exponent of the spring's law")
    contact: Discrete = Discrete(doc="whether the sides touch, s_rel < s_rel0")
    f_c: Variable = Variable(unit="N", nominal=1e3, doc="force of the spring")
    f_d2: Variable = Variable(unit="N", nominal=1e3, doc="force of the damper before it is limited")
    f_d: Variable = Variable(unit="N", nominal=1e3, doc="force of the damper")

    def equations(self) -> Equations:
        yield from super().equations()
        gap = self.s_rel - self.s_rel0
        pressed = where(gap < 0, -gap / self.s_ref, 1.0)  # not 0, of which powers have no second derivative
        # as it is at every moment: a step that the event is found in goes beyond it
        yield self.f_c == ac.noevent(where(gap < 0, -self.f_ref * pressed**self.n, 0.0))
        yield self.contact == where(gap < 0, 1.0, 0.0)
        yield self.f_d2 == where(gap < 0, self.d * self.v_rel, 0.0)
        yield self.f_d == where(gap < 0, ac.noevent(ac.clip(self.f_d2, self.f_c, -self.f_c)), 0.0)
        yield self.f == self.f_c + self.f_d
        yield self.lossPower == self.f_d * self.v_rel


class EndStops(Component):
    """Bumpers at both ends of a stroke, fixed in the housing.

    Force on the flange ``-k (s - s_min) - c v`` for ``s < s_min``, ``-k (s - s_max) - c v`` for ``s > s_max``, else 0.

    >>> model = assemble("slider.flange - stops.flange", stops=EndStops(k=np.pi**2 * 2.0, c=0.0),
    ...                  slider=PointMass(m=2.0, s=start(0.8, fixed=True), v=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.2, 0.7, 1.2])["slider.s"], [1.0, 1.0 + 1 / np.pi, 1.0], 1e-4)
    True

    Source: Eq. 15, with contact without a gap.
    """

    flange: Flange = Flange()
    s_min: Parameter = Parameter(0.0, unit="m", doc="position of the lower bumper")
    s_max: Parameter = Parameter(1.0, unit="m", doc="position of the upper bumper")
    k: Parameter = Parameter(1e8, unit="N/m", min=0.0, doc="spring constant")
    c: Parameter = Parameter(4e5, unit="N*s/m", min=0.0, doc="damping constant")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        s = self.flange.s
        low = self.k * (s - self.s_min) + self.c * self.v
        high = self.k * (s - self.s_max) + self.c * self.v
        yield self.v == der(s)
        yield self.flange.f == where(s < self.s_min, low, where(s > self.s_max, high, 0.0))
        yield ac.assert_(self.s_min <= self.s_max, "the lower bumper is above the upper one, s_min > s_max")


class ViscousFriction(Component):
    """Viscous friction against the housing, ``flange.f = d v``.

    >>> model = assemble("mass.flange - friction.flange", friction=ViscousFriction(d=4.0),
    ...                  mass=PointMass(m=2.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], 3 * np.exp([-1.0, -2.0]))
    True

    Source: damping of the piston in Eq. 14; Modelica.Mechanics.Translational.Components.Damper to a Fixed.
    """

    flange: Flange = Flange()
    d: Parameter = Parameter(1.0, unit="N*s/m", min=0.0, doc="damping constant")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == der(self.flange.s)
        yield self.flange.f == self.d * self.v


class InitializeFlange(Component):
    """Signals say how the flange starts: position, velocity and acceleration, each with ``use_..._start``; no force.

    >>> model = assemble("at.y - begin.s_start", "speed.y - begin.v_start", "begin.flange - body.flange_a",
    ...                  at=blocks.Constant(k=2.0), speed=blocks.Constant(k=3.0), body=Mass(),
    ...                  begin=InitializeFlange(use_a_start=False))
    >>> close(run(model, at=[0.0, 1.0])["body.s"], [2.0, 5.0])
    True

    Source: Modelica.Mechanics.Translational.Components.InitializeFlange.
    """

    use_s_start: bool = True
    use_v_start: bool = True
    use_a_start: bool = True
    stateSelect: str = "default"
    flange: Flange = Flange()
    s_start: Input = Input(unit="m", doc="position at the start, with use_s_start")
    v_start: Input = Input(unit="m/s", doc="velocity at the start, with use_v_start")
    a_start: Input = Input(unit="m/s2", doc="acceleration at the start, with use_a_start")
    s_flange: Variable = Variable(unit="m", state_select=structural("stateSelect"), doc="position of the flange")
    v_flange: Variable = Variable(unit="m/s", state_select=structural("stateSelect"), doc="its velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.s_flange == self.flange.s
        yield self.v_flange == der(self.s_flange)
        yield self.flange.f == 0
        given = (self.use_s_start, self.use_v_start, self.use_a_start)
        for signal, use in zip((self.s_start, self.v_start, self.a_start), given, strict=True):
            if not use:
                yield signal == 0

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.use_s_start:
            yield self.s_flange == self.s_start
        if self.use_v_start:
            yield self.v_flange == self.v_start
        if self.use_a_start:
            yield der(self.v_flange) == self.a_start
