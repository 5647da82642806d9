"""Inertia, rigid and compliant connections."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Equations, Expr, Input, Parameter, Variable, der, structural, where

from .. import thermal
from .interfaces import Flange, PartialCompliant, PartialCompliantWithRelativeStates, PartialTwoFlanges


class Inertia(PartialTwoFlanges):
    """Rotating inertia, ``w = dphi/dt``, ``a = dw/dt``, ``J a = flange_a.tau + flange_b.tau``.

    >>> model = assemble("drive.flange - rotor.flange_a", drive=ConstantTorque(tau_constant=6.0),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.phi"], [0.875, 2.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.Inertia.
    """

    stateSelect: str = "default"
    J: Parameter = Parameter(1.0, unit="kg*m2", min=0.0, doc="moment of inertia")
    phi: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="absolute angle")
    w: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="absolute angular velocity")
    a: Variable = Variable(unit="rad/s2", doc="absolute angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi == self.flange_a.phi
        yield self.phi == self.flange_b.phi
        yield self.w == der(self.phi)
        yield self.a == der(self.w)
        yield self.J * self.a == self.flange_a.tau + self.flange_b.tau


class Disc(PartialTwoFlanges):
    """Two flanges turned against each other by `deltaPhi`, no inertia.

    >>> model = assemble("wall.flange - disc.flange_a", wall=Fixed(phi0=0.25), disc=Disc(deltaPhi=0.5))
    >>> run(model)["disc.flange_b.phi"][-1]
    0.75

    Source: Modelica.Mechanics.Rotational.Components.Disc.
    """

    deltaPhi: Parameter = Parameter(0.0, unit="rad", doc="angle of flange b against flange a")
    phi: Variable = Variable(unit="rad", doc="absolute angle of the middle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange_a.phi == self.phi - self.deltaPhi / 2
        yield self.flange_b.phi == self.phi + self.deltaPhi / 2
        yield self.flange_a.tau + self.flange_b.tau == 0


class Fixed(Component):
    """Flange fixed in the housing at `phi0`, ``flange.phi = phi0``.

    >>> model = assemble("wall.flange - spring.flange_a", "spring.flange_b - drive.flange", wall=Fixed(phi0=0.25),
    ...                  spring=Spring(c=4.0), drive=ConstantTorque(tau_constant=2.0))
    >>> run(model)["drive.flange.phi"][-1]
    0.75

    Source: Modelica.Mechanics.Rotational.Components.Fixed.
    """

    flange: Flange = Flange()
    phi0: Parameter = Parameter(0.0, unit="rad", doc="angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.phi0


class Spring(PartialCompliant):
    """Linear torsion spring, ``tau = c (phi_rel - phi_rel0)``.

    >>> model = assemble("wall.flange - spring.flange_a", "spring.flange_b - rotor.flange_a", wall=Fixed(),
    ...                  spring=Spring(c=8.0, phi_rel0=0.5),
    ...                  rotor=Inertia(J=2.0, phi=start(1.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.phi"], 0.5 + 0.5 * np.cos([1.0, 2.0]))
    True

    Source: Modelica.Mechanics.Rotational.Components.Spring.
    """

    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="unstretched angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0)


class Damper(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Linear rotational damper, ``tau = d w_rel``; the power ``tau w_rel`` is lost.

    >>> model = assemble("wall.flange - damper.flange_a", "damper.flange_b - rotor.flange_a", wall=Fixed(),
    ...                  damper=Damper(d=4.0),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.w"], 3 * np.exp([-1.0, -2.0]))
    True

    Source: Modelica.Mechanics.Rotational.Components.Damper.
    """

    d: Parameter = Parameter(0.0, unit="N*m*s/rad", min=0.0, doc="damping constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.d * self.w_rel
        yield self.lossPower == self.tau * self.w_rel


class SpringDamper(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates):
    """Linear torsion spring and damper in parallel, ``tau = c (phi_rel - phi_rel0) + d w_rel``.

    >>> model = assemble("wall.flange - shaft.flange_a", "shaft.flange_b - rotor.flange_a", wall=Fixed(),
    ...                  shaft=SpringDamper(c=8.0, d=8.0),
    ...                  rotor=Inertia(J=2.0, phi=start(1.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["rotor.phi"], [2.0 * np.exp(-1.0), 3.0 * np.exp(-2.0)])
    True

    Source: Modelica.Mechanics.Rotational.Components.SpringDamper.
    """

    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant")
    d: Parameter = Parameter(0.0, unit="N*m*s/rad", min=0.0, doc="damping constant")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="unstretched angle")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.tau == self.c * (self.phi_rel - self.phi_rel0) + self.d * self.w_rel
        yield self.lossPower == self.d * self.w_rel * self.w_rel


class PartialElastoBacklash(thermal.PartialConditionalHeatPort, PartialCompliantWithRelativeStates, partial=True):
    """Spring and damper with a backlash `b`: ``tau_c = c (phi_rel - phi_rel0 -+ b/2)`` beyond it, zero within.

    Subclasses give the torque of the damper.

    Source: Modelica.Mechanics.Rotational.Components.ElastoBacklash.
    """

    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant")
    d: Parameter = Parameter(0.0, unit="N*m*s/rad", min=0.0, doc="damping constant")
    b: Parameter = Parameter(0.0, unit="rad", min=0.0, doc="total backlash")
    phi_rel0: Parameter = Parameter(0.0, unit="rad", doc="unstretched angle")
    tau_c: Variable = Variable(unit="N*m", doc="torque of the spring")
    tau_d: Variable = Variable(unit="N*m", doc="torque of the damper")

    def equations(self) -> Equations:
        yield from super().equations()
        turned, half = self.phi_rel - self.phi_rel0, self.b / 2
        beyond = where(self.above, turned - half, where(self.below, turned + half, 0.0))
        yield self.tau_c == self.c * where(self.none, turned, beyond)

    @property
    def above(self) -> Expr:
        """Whether the sides meet in forward direction."""
        return self.phi_rel - self.phi_rel0 > self.b / 2

    @property
    def below(self) -> Expr:
        """Whether the sides meet in backward direction."""
        return self.phi_rel - self.phi_rel0 < -self.b / 2

    @property
    def none(self) -> Expr:
        """Whether there is no backlash at all."""
        return self.b <= 1e-10


class ElastoBacklash(PartialElastoBacklash):
    """Spring and damper with a backlash `b`: no torque within ``|phi_rel - phi_rel0| <= b/2``, never pulling.

    Beyond it ``tau_c = c (phi_rel - phi_rel0 -+ b/2)`` and ``tau = tau_c + d w_rel``, where the damping is no larger
    than the spring's torque and the sum has the sign of ``tau_c``.

    >>> model = assemble("wall.flange - play.flange_a", "play.flange_b - rotor.flange_a", wall=Fixed(),
    ...                  play=ElastoBacklash(c=np.pi**2 * 2.0, b=0.4),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.1, 0.2, 0.7, 1.2])["rotor.phi"], [0.1, 0.2, 0.2 + 1 / np.pi, 0.2], 1e-4)
    True

    Source: Modelica.Mechanics.Rotational.Components.ElastoBacklash.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        spring, damping = self.tau_c, self.d * self.w_rel
        backward = where(self.below, ac.clip(damping, spring, -spring), 0.0)
        limited = where(self.above, ac.clip(damping, -spring, spring), backward)
        yield self.tau_d == where(self.none, damping, ac.noevent(limited))
        yield self.tau == spring + self.tau_d
        yield self.lossPower == self.tau_d * self.w_rel


class ElastoBacklash2(PartialElastoBacklash):
    """Spring and damper with a backlash `b`, whose torque may jump when the sides meet.

    No torque within ``|phi_rel - phi_rel0| <= b/2``; beyond it ``tau = c (phi_rel - phi_rel0 -+ b/2) + d w_rel``, as
    long as that pushes the sides apart. `ElastoBacklash` limits the damping instead.

    >>> model = assemble("wall.flange - play.flange_a", "play.flange_b - rotor.flange_a", wall=Fixed(),
    ...                  play=ElastoBacklash2(c=np.pi**2 * 2.0, d=0.4, b=0.4),
    ...                  rotor=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(1.0, fixed=True)))
    >>> turned = run(model, at=[0.1, 0.2 + 1e-6, 1.5])
    >>> close(turned["play.tau"], [0.0, 0.4, 0.0], 1e-3) and close(turned["rotor.phi"][:1], [0.1])
    True

    Source: Modelica.Mechanics.Rotational.Components.ElastoBacklash2.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        both = self.tau_c + self.tau_d
        pushes = self.none | (self.above & (both > 0)) | (self.below & (both < 0))
        yield self.tau_d == self.d * self.w_rel
        yield self.tau == where(pushes, both, 0.0)
        yield self.lossPower == where(pushes, self.tau_d * self.w_rel, 0.0)


class RelativeStates(PartialTwoFlanges):
    """The relative angle and velocity of two flanges as states, ``phi_rel = flange_b.phi - flange_a.phi``; no torque.

    >>> model = assemble("one.flange_a - relative.flange_a", "two.flange_a - relative.flange_b",
    ...                  relative=RelativeStates(phi_rel=start(0.5, fixed=True), w_rel=start(1.0, fixed=True)),
    ...                  one=Inertia(phi=start(0.0, fixed=True), w=start(2.0, fixed=True)), two=Inertia())
    >>> close(run(model, at=[0.0, 1.0])["two.phi"], [0.5, 3.5])
    True

    Source: Modelica.Mechanics.Rotational.Components.RelativeStates.
    """

    stateSelect: str = "prefer"
    phi_nominal: Parameter = Parameter(1.0, unit="rad", evaluate=True, doc="typical size of phi_rel")
    phi_rel: Variable = Variable(
        unit="rad", start=0.0, state_select=structural("stateSelect"), nominal=phi_nominal, doc="relative angle"
    )
    w_rel: Variable = Variable(
        unit="rad/s", start=0.0, state_select=structural("stateSelect"), doc="relative angular velocity"
    )
    a_rel: Variable = Variable(unit="rad/s2", doc="relative angular acceleration")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_rel == self.flange_b.phi - self.flange_a.phi
        yield self.w_rel == der(self.phi_rel)
        yield self.a_rel == der(self.w_rel)
        yield self.flange_a.tau == 0
        yield self.flange_b.tau == 0


class InitializeFlange(Component):
    """Signals say how the flange starts: its angle, velocity and acceleration, each with ``use_..._start``; no torque.

    >>> model = assemble("at.y - begin.phi_start", "speed.y - begin.w_start", "begin.flange - body.flange_a",
    ...                  at=blocks.Constant(k=2.0), speed=blocks.Constant(k=3.0), body=Inertia(),
    ...                  begin=InitializeFlange(use_a_start=False))
    >>> close(run(model, at=[0.0, 1.0])["body.phi"], [2.0, 5.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.InitializeFlange.
    """

    use_phi_start: bool = True
    use_w_start: bool = True
    use_a_start: bool = True
    stateSelect: str = "default"
    flange: Flange = Flange()
    phi_start: Input = Input(unit="rad", doc="angle at the start, with use_phi_start")
    w_start: Input = Input(unit="rad/s", doc="velocity at the start, with use_w_start")
    a_start: Input = Input(unit="rad/s2", doc="acceleration at the start, with use_a_start")
    phi_flange: Variable = Variable(unit="rad", state_select=structural("stateSelect"), doc="angle of the flange")
    w_flange: Variable = Variable(unit="rad/s", state_select=structural("stateSelect"), doc="its velocity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.phi_flange == self.flange.phi
        yield self.w_flange == der(self.phi_flange)
        yield self.flange.tau == 0
        given = (self.use_phi_start, self.use_w_start, self.use_a_start)
        for signal, use in zip((self.phi_start, self.w_start, self.a_start), given, strict=True):
            if not use:
                yield signal == 0

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.use_phi_start:
            yield self.phi_flange == self.phi_start
        if self.use_w_start:
            yield self.w_flange == self.w_start
        if self.use_a_start:
            yield der(self.w_flange) == self.a_start
