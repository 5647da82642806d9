"""Gearbox with losses, elasticity and backlash."""

from __future__ import annotations

from collections.abc import Sequence

from acausal import Equations, Parameter, Variable, conditional, connect, der, structural

from .. import thermal
from .components import ElastoBacklash
from .interfaces import Flange, PartialTwoFlanges
from .lossy_gear import LossyGear


class Gearbox(PartialTwoFlanges):
    """Gear with losses in series with elasticity and backlash: `LossyGear`, then `ElastoBacklash` at flange b.

    >>> model = assemble("drive.flange - box.flange_a", "box.flange_b - load.flange_a", "wall.flange - one.flange_a",
    ...                  "one.flange_b - load.flange_b", drive=ConstantTorque(tau_constant=2.0), wall=Fixed(),
    ...                  box=Gearbox(ratio=3.0, c=1e4, d=10.0), one=SpringDamper(c=60.0, d=60.0), load=Inertia(J=1.0))
    >>> held = run(model, at=[0.0, 40.0])  # 6 N m over 60 N m/rad
    >>> close(held["load.phi"][-1], 0.1, 1e-3) and close(held["box.phi_rel"][-1], -6e-4, 1e-3)
    True

    Source: Modelica.Mechanics.Rotational.Components.Gearbox.
    """

    useSupport: bool = False
    useHeatPort: bool = False
    stateSelect: str = "prefer"
    lossTable: Sequence[Sequence[float]] = ((0.0, 1.0, 1.0, 0.0, 0.0),)
    ratio: Parameter = Parameter(1.0, unit="1", doc="transmission ratio flange_a.phi / flange_b.phi")
    c: Parameter = Parameter(1e5, unit="N*m/rad", min=0.0, doc="spring constant of the elasticity")
    d: Parameter = Parameter(0.0, unit="N*m*s/rad", min=0.0, doc="damping constant of the elasticity")
    b: Parameter = Parameter(0.0, unit="rad", min=0.0, doc="total backlash")
    support: Flange = conditional(Flange(), "useSupport")
    heatPort: thermal.HeatPort = conditional(thermal.HeatPort(), "useHeatPort")
    lossyGear: LossyGear = LossyGear(
        ratio=ratio, lossTable=structural("lossTable"), useSupport=structural("useSupport"),
        useHeatPort=structural("useHeatPort"),
    )  # fmt: skip
    elastoBacklash: ElastoBacklash = ElastoBacklash(
        c=c, d=d, b=b, stateSelect=structural("stateSelect"), useHeatPort=structural("useHeatPort")
    )
    phi_rel: Variable = Variable(unit="rad", doc="angle of flange b against the gear")
    w_rel: Variable = Variable(unit="rad/s", doc="relative angular velocity over the elasticity")

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.flange_a, self.lossyGear.flange_a)
        yield connect(self.lossyGear.flange_b, self.elastoBacklash.flange_a)
        yield connect(self.elastoBacklash.flange_b, self.flange_b)
        yield self.phi_rel == self.flange_b.phi - self.lossyGear.flange_b.phi
        yield self.w_rel == der(self.phi_rel)
        if self.useSupport:
            yield connect(self.support, self.lossyGear.support)
        if self.useHeatPort:
            yield connect(self.heatPort, self.lossyGear.heatPort, self.elastoBacklash.heatPort)
