"""Port, oil, and the two-port that most components extend."""

from __future__ import annotations

from acausal import Component, Connector, Equations, Expr, Flow, Parameter, Potential, Variable, assert_, noevent

VACUUM = -1e5
"""No pressure is lower [Pa], whether it is absolute or counted from that of the air."""


class HydraulicPort(Connector):
    """Point where oil can cross a component's boundary.

    Source: connector of OpenHydraulics and of Modelica.Fluid, with the volume flow rate as the flow variable.
    """

    p: Potential = Potential(unit="Pa", nominal=1e6, doc="absolute pressure")
    q: Flow = Flow(unit="m3/s", nominal=1e-3, doc="volume flow rate into the component")


class Oil(Component):
    """Properties of the oil, all constant; shared by declaring one ``inner`` and reading it as ``outer``.

    >>> model = assemble("flow.y - pump.u", "tank.port - pump.port_a", "pump.port_b - volume.port", tank=Tank(),
    ...                  oil=ac.inner(Oil(B=1.6e9)), flow=blocks.Constant(k=1e-6), pump=FlowSource(),
    ...                  volume=ControlVolume(V=1e-3, p=start(1e5, fixed=True)))
    >>> close(run(model)["volume.p"][-1], 1e5 + 1.6e9 * 1e-6 / 1e-3)
    True

    Source: bulk modulus as in Eq. 6; values of an ISO VG 46 oil at 40 degC.
    """

    rho: Parameter = Parameter(850.0, unit="kg/m3", min=1e-30, doc="density")
    nu: Parameter = Parameter(46e-6, unit="m2/s", min=1e-30, doc="kinematic viscosity")
    B: Parameter = Parameter(1.2e9, unit="Pa", min=1e-30, doc="bulk modulus")


def not_torn(p: Expr) -> Equations:
    """The warning that the pressure `p` is below that of a vacuum: oil boils before, and these components do not."""
    text = (
        "the pressure of the oil is below a vacuum, as there is no cavitation: let oil flow in before, through a "
        "CheckValve from the tank, or take the load off"
    )
    yield assert_(noevent(p >= VACUUM), text, level="warning")


class PartialTwoPort(Component, partial=True):
    """Two ports, no storage: ``q = port_a.q = -port_b.q``, ``dp = port_a.p - port_b.p``.

    Source: Modelica.Fluid.Interfaces.PartialTwoPortTransport, for a volume flow rate.
    """

    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    dp: Variable = Variable(unit="Pa", nominal=1e6, doc="pressure drop, port_a.p - port_b.p")
    q: Variable = Variable(unit="m3/s", nominal=1e-3, doc="volume flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dp == self.port_a.p - self.port_b.p
        yield self.q == self.port_a.q
        yield self.port_a.q + self.port_b.q == 0
