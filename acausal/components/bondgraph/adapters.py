"""Ports of the other libraries as ends of bonds, so that bond graphs and component models mix."""

from __future__ import annotations

from typing import ClassVar

from acausal import Component, Equations, der

from .. import electrical, hydraulic, rotational, translational
from .elements import BondPort


class HydraulicBond(Component):
    """A hydraulic port as the end of a bond: effort is the pressure, flow the volume flow rate.

    >>> model = assemble("tank.port - adapter.port", "adapter.bond - load.port", tank=hydraulic.Tank(p=2e5),
    ...                  adapter=HydraulicBond(), load=R(R=1e8))
    >>> close(run(model)["load.f"][-1], 2e-3)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Table 2.1.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("bond",)
    port: hydraulic.HydraulicPort = hydraulic.HydraulicPort()
    bond: BondPort = BondPort()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.bond.e == self.port.p
        yield self.bond.f + self.port.q == 0


class ElectricalBond(Component):
    """Two pins as the end of a bond: effort is the voltage from `p` to `n`, flow the current that leaves at `p`.

    >>> model = assemble("source.p - adapter.p", "source.n - adapter.n - ground.p", "adapter.bond - load.port",
    ...                  source=electrical.ConstantVoltage(V=12.0), ground=electrical.Ground(),
    ...                  adapter=ElectricalBond(), load=R(R=4.0))
    >>> close(run(model)["load.f"][-1], 3.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Table 2.1.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("bond",)
    p: electrical.Pin = electrical.Pin()
    n: electrical.Pin = electrical.Pin()
    bond: BondPort = BondPort()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.bond.e == self.p.v - self.n.v
        yield self.bond.f + self.p.i == 0
        yield self.p.i + self.n.i == 0


class TranslationalBond(Component):
    """A flange as the end of a bond: effort is a force, flow the velocity.

    The force is the one with which the graph pushes the flange, ``e = -flange.f``, ``bond.f = v``: a half arrow towards
    the flange. With `inward` it is the one with which the flange pushes the graph, ``e = flange.f``, ``bond.f = -v``.

    >>> model = assemble("drive.port - adapter.bond", "adapter.flange - mass.flange", drive=Se(e=6.0),
    ...                  adapter=TranslationalBond(), mass=translational.PointMass(m=2.0, s=start(0.0, fixed=True),
    ...                  v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [1.5, 3.0])
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Table 2.1.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("bond",)
    inward: bool = False
    flange: translational.Flange = translational.Flange()
    bond: BondPort = BondPort()

    def equations(self) -> Equations:
        yield from super().equations()
        sign = -1 if self.inward else 1
        yield self.bond.e == -sign * self.flange.f
        yield self.bond.f == sign * der(self.flange.s)


class RotationalBond(Component):
    """A rotational flange as the end of a bond: effort is a torque, flow the angular velocity.

    The torque is the one with which the graph turns the flange, ``e = -flange.tau``, ``bond.f = w``: a half arrow
    towards the flange. With `inward` it is the one with which the flange turns the graph, ``e = flange.tau``,
    ``bond.f = -w``.

    >>> model = assemble("rotor.flange_b - adapter.flange", "adapter.bond - brake.port", brake=R(R=4.0),
    ...                  adapter=RotationalBond(inward=True), rotor=rotational.Inertia(J=2.0, w=start(3.0, fixed=True),
    ...                  phi=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["brake.f"], 3.0 * np.exp([-1.0, -2.0]))
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Table 2.1.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("bond",)
    inward: bool = False
    flange: rotational.Flange = rotational.Flange()
    bond: BondPort = BondPort()

    def equations(self) -> Equations:
        yield from super().equations()
        sign = -1 if self.inward else 1
        yield self.bond.e == -sign * self.flange.tau
        yield self.bond.f == sign * der(self.flange.phi)
