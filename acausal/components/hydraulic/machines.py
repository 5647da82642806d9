"""Pumps and motors on a shaft."""

from __future__ import annotations

from acausal import PI, Equations, Expr, Input, Parameter, Variable, der

from .. import rotational
from .interfaces import PartialTwoPort


class PartialDisplacementMachine(PartialTwoPort, partial=True):
    """Pump or motor: turned forward it delivers from a to b, and a higher pressure at a turns it forward.

    ``q = D w + G_leak dp``, ``flange.tau = d w - D dp``, with the displacement `D` per radian, which subclasses give.
    The power ``D dp w`` goes from the oil to the shaft; what leakage and friction take is lost.

    Source: Merritt, Hydraulic Control Systems (1967), section 4.2.
    """

    flange: rotational.Flange = rotational.Flange()
    V_disp: Parameter = Parameter(5e-5, unit="m3", min=0.0, doc="displacement per revolution")
    G_leak: Parameter = Parameter(0.0, unit="m3/(s*Pa)", min=0.0, doc="conductance of the leakage from a to b")
    d: Parameter = Parameter(0.0, unit="N*m*s/rad", min=0.0, doc="viscous friction of the shaft")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the shaft")

    def displacement(self) -> Expr:
        """Displacement per radian [m3]."""
        return self.V_disp / (2 * PI)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == der(self.flange.phi)
        yield self.q == self.displacement() * self.w + self.G_leak * self.dp
        yield self.flange.tau == self.d * self.w - self.displacement() * self.dp


class FixedDisplacementMachine(PartialDisplacementMachine):
    """Pump or motor of constant displacement: ``q = V_disp/(2 pi) w + G_leak dp``.

    A motor between 21 MPa and 1 MPa on a brake, and a pump on a shaft of constant speed:

    >>> model = assemble("supply.port - motor.port_a", "motor.port_b - tank.port", "motor.flange - brake.flange_a",
    ...                  "brake.flange_b - wall.flange", supply=Tank(p=21e6), tank=Tank(p=1e6),
    ...                  motor=Motor(V_disp=1e-4), brake=rotational.Damper(d=5.0), wall=rotational.Fixed())
    >>> close(run(model)["motor.w"][-1], 20e6 * 1e-4 / (2 * np.pi) / 5.0)
    True
    >>> model = assemble("tank.port - pump.port_a", "pump.port_b - load.port", "engine.flange - pump.flange",
    ...                  tank=Tank(p=1e5), load=Tank(p=21e5), pump=Pump(V_disp=1e-4, G_leak=1e-11),
    ...                  engine=rotational.ConstantSpeed(w_fixed=50 * np.pi))
    >>> close(run(model)["pump.q"][-1], 25 * 1e-4 - 1e-11 * 20e5)
    True

    Source: Merritt, Hydraulic Control Systems (1967), Eqs. 4-8 and 4-9.
    """


Pump = Motor = FixedDisplacementMachine
"""The same machine both ways."""


class VariableDisplacementMachine(PartialDisplacementMachine):
    """Pump or motor whose displacement is the part `stroke` of `V_disp`, -1 to 1: beyond the middle it reverses.

    >>> model = assemble("tank.port - pump.port_a", "pump.port_b - load.port", "engine.flange - pump.flange",
    ...                  "swash.y - pump.stroke", tank=Tank(p=1e5), load=Tank(p=21e5), swash=blocks.Constant(k=-0.25),
    ...                  engine=rotational.ConstantSpeed(w_fixed=50 * np.pi),
    ...                  pump=VariableDisplacementMachine(V_disp=1e-4))
    >>> close(run(model)["pump.q"][-1], -0.25 * 25 * 1e-4)
    True

    Source: Merritt, Hydraulic Control Systems (1967), section 4.2; swash plate as in OpenHydraulics.
    """

    stroke: Input = Input(unit="1", doc="part of the displacement, -1 to 1")

    def displacement(self) -> Expr:
        return self.stroke * self.V_disp / (2 * PI)
