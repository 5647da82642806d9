"""Flanges as signals, for units that exchange signals only."""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, der

from ..adaptors import FlowToPotentialAdaptor, PotentialToFlowAdaptor, differentiated
from .interfaces import Flange


class GeneralAngleToTorqueAdaptor(PotentialToFlowAdaptor):
    """Angle `p`, velocity `pder` and acceleration `pder2` move the flange; the answer is the torque `f` needed.

    ``flange.phi = p``, ``f = -flange.tau``. Without `use_pder2` or `use_pder` fewer derivatives are given.

    >>> model = assemble("drive.flange - one.flange_a", "one.flange_b - answer.flange", "answer.p - move.p",
    ...                  "move.f - answer.f", "answer.pder - move.pder", "answer.pder2 - move.pder2",
    ...                  "move.flange - two.flange_a", drive=ConstantTorque(tau_constant=6.0), two=Inertia(J=2.0),
    ...                  one=Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  answer=GeneralTorqueToAngleAdaptor(), move=GeneralAngleToTorqueAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["two.phi"], [0.25, 1.0]) and close(signals["move.f"], [4.0, 4.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.GeneralAngleToTorqueAdaptor.
    """

    flange: Flange = Flange()
    p: Input = Input(unit="rad", doc="angle")
    pder: Input = Input(unit="rad/s", doc="velocity, with use_pder")
    pder2: Input = Input(unit="rad/s2", doc="acceleration, with use_pder and use_pder2")
    f: Output = Output(unit="N*m", doc="torque that drives the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.p
        yield self.flange.tau == -self.f


class GeneralTorqueToAngleAdaptor(FlowToPotentialAdaptor):
    """The torque `f` drives the flange; the answer is its angle `p`, velocity `pder` and acceleration `pder2`.

    ``flange.tau = f``, ``p = flange.phi``: an `f` that is positive brakes.

    >>> model = assemble("size.y - answer.f", "one.flange_b - answer.flange", size=blocks.Constant(k=-4.0),
    ...                  one=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  answer=GeneralTorqueToAngleAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["answer.p"], [0.25, 1.0]) and close(signals["answer.pder2"], [2.0, 2.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.GeneralTorqueToAngleAdaptor.
    """

    flange: Flange = Flange()
    p: Output = Output(unit="rad", doc="angle")
    pder: Output = Output(unit="rad/s", doc="velocity, zero without use_pder")
    pder2: Output = Output(unit="rad/s2", doc="acceleration, zero without use_pder and use_pder2")
    f: Input = Input(unit="N*m", doc="torque at the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.p
        yield self.flange.tau == self.f


class AngleToTorqueAdaptor(Component):
    """Angle `phi`, speed `w` and acceleration `a` move the flange; the answer is the torque `tau` that this takes.

    ``flange.phi = phi``, ``tau = -flange.tau``. Without `use_a` or `use_w` fewer derivatives are given.

    >>> model = assemble("drive.flange - one.flange_a", "one.flange_b - answer.flange", "answer.phi - move.phi",
    ...                  "move.tau - answer.tau", "answer.w - move.w", "answer.a - move.a",
    ...                  "move.flange - two.flange_a", drive=ConstantTorque(tau_constant=6.0), two=Inertia(J=2.0),
    ...                  one=Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  answer=TorqueToAngleAdaptor(), move=AngleToTorqueAdaptor())
    >>> close(run(model, at=[0.5, 1.0])["move.tau"], [4.0, 4.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.AngleToTorqueAdaptor.
    """

    use_w: bool = True
    use_a: bool = True
    flange: Flange = Flange()
    phi: Input = Input(unit="rad", doc="angle")
    w: Input = Input(unit="rad/s", doc="speed, with use_w or use_a")
    a: Input = Input(unit="rad/s2", doc="acceleration, with use_a")
    tau: Output = Output(unit="N*m", doc="torque that drives the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.phi
        yield self.flange.tau == -self.tau
        if self.use_a:
            yield from differentiated(self.phi, self.w, self.a)
        else:
            yield self.a == 0
        if self.use_w and not self.use_a:
            yield from differentiated(self.phi, self.w)
        if not (self.use_w or self.use_a):
            yield self.w == 0


class TorqueToAngleAdaptor(Component):
    """The torque `tau` drives the flange; the answer is its angle `phi`, speed `w` and acceleration `a`.

    ``flange.tau = tau``, ``phi = flange.phi``: a `tau` that is positive brakes.

    >>> model = assemble("size.y - answer.tau", "one.flange_b - answer.flange", size=blocks.Constant(k=-4.0),
    ...                  one=Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
    ...                  answer=TorqueToAngleAdaptor())
    >>> close(run(model, at=[0.5, 1.0])["answer.phi"], [0.25, 1.0])
    True

    Source: Modelica.Mechanics.Rotational.Components.TorqueToAngleAdaptor.
    """

    use_w: bool = True
    use_a: bool = True
    flange: Flange = Flange()
    phi: Output = Output(unit="rad", doc="angle")
    w: Output = Output(unit="rad/s", doc="speed, zero without use_w")
    a: Output = Output(unit="rad/s2", doc="acceleration, the derivative of w, zero without use_a")
    tau: Input = Input(unit="N*m", doc="torque at the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.phi == self.phi
        yield self.flange.tau == self.tau
        yield self.w == (der(self.phi) if self.use_w else 0.0)
        yield self.a == (der(self.w) if self.use_a else 0.0)
