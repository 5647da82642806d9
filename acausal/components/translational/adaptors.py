"""Flanges as signals, for units that exchange signals only."""

from __future__ import annotations

from acausal import Equations, Input, Output

from ..adaptors import FlowToPotentialAdaptor, PotentialToFlowAdaptor
from .interfaces import Flange


class GeneralPositionToForceAdaptor(PotentialToFlowAdaptor):
    """Position `p`, velocity `pder` and acceleration `pder2` move the flange; the answer is the force `f` needed.

    ``flange.s = p``, ``f = -flange.f``. Without `use_pder2` or `use_pder` fewer derivatives are given.

    >>> model = assemble("drive.flange - one.flange_a", "one.flange_b - answer.flange", "answer.p - move.p",
    ...                  "move.f - answer.f", "answer.pder - move.pder", "answer.pder2 - move.pder2",
    ...                  "move.flange - two.flange_a", drive=ConstantForce(f_constant=6.0), two=Mass(m=2.0),
    ...                  one=Mass(m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    ...                  answer=GeneralForceToPositionAdaptor(), move=GeneralPositionToForceAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["two.s"], [0.25, 1.0]) and close(signals["move.f"], [4.0, 4.0])
    True

    Source: Modelica.Mechanics.Translational.Components.GeneralPositionToForceAdaptor.
    """

    flange: Flange = Flange()
    p: Input = Input(unit="m", doc="position")
    pder: Input = Input(unit="m/s", doc="velocity, with use_pder")
    pder2: Input = Input(unit="m/s2", doc="acceleration, with use_pder and use_pder2")
    f: Output = Output(unit="N", doc="force that drives the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.s == self.p
        yield self.flange.f == -self.f


class GeneralForceToPositionAdaptor(FlowToPotentialAdaptor):
    """The force `f` drives the flange; the answer is its position `p`, velocity `pder` and acceleration `pder2`.

    ``flange.f = f``, ``p = flange.s``: an `f` that is positive brakes.

    >>> model = assemble("size.y - answer.f", "one.flange_b - answer.flange", size=blocks.Constant(k=-4.0),
    ...                  one=Mass(m=2.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)),
    ...                  answer=GeneralForceToPositionAdaptor())
    >>> signals = run(model, at=[0.5, 1.0])
    >>> close(signals["answer.p"], [0.25, 1.0]) and close(signals["answer.pder2"], [2.0, 2.0])
    True

    Source: Modelica.Mechanics.Translational.Components.GeneralForceToPositionAdaptor.
    """

    flange: Flange = Flange()
    p: Output = Output(unit="m", doc="position")
    pder: Output = Output(unit="m/s", doc="velocity, zero without use_pder")
    pder2: Output = Output(unit="m/s2", doc="acceleration, zero without use_pder and use_pder2")
    f: Input = Input(unit="N", doc="force at the flange")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.flange.s == self.p
        yield self.flange.f == self.f
