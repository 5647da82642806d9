"""A vehicle with its driving resistances."""

from __future__ import annotations

import acausal as ac
from acausal import Component, Equations, Input, Parameter, Variable, der

from ..friction import regularized_sign
from ..rotational.interfaces import Flange as ShaftFlange
from .interfaces import Flange
from .sources import PartialForce


class RollingResistance(PartialForce):
    """Resistance of a rolling wheel, ``f = cr fWeight cos(atan(inclination)) sign(v)``, made continuous by `reg`.

    >>> model = assemble("wheel.flange - mass.flange_a", wheel=RollingResistance(fWeight=100.0, CrConstant=0.02),
    ...                  mass=Mass(m=4.0, s=start(0.0, fixed=True), v=start(3.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [2.75, 2.5])
    True

    Source: Modelica.Mechanics.Translational.Components.RollingResistance.
    """

    useCrInput: bool = False
    useInclinationInput: bool = False
    reg: str = "Exp"
    fWeight: Parameter = Parameter(0.0, unit="N", doc="load of the wheel by its weight")
    CrConstant: Parameter = Parameter(0.01, unit="1", doc="rolling resistance coefficient without useCrInput")
    inclinationConstant: Parameter = Parameter(0.0, unit="1", doc="tan(angle) of the road without useInclinationInput")
    v0: Parameter = Parameter(0.1, unit="m/s", min=1e-60, doc="speed below which the force is made continuous")
    cr: Input = Input(unit="1", doc="rolling resistance coefficient with useCrInput")
    inclination: Input = Input(unit="1", doc="tan(angle) of the road with useInclinationInput")
    v: Variable = Variable(unit="m/s", doc="velocity of the flange relative to the support")
    f_nominal: Variable = Variable(unit="N", doc="minus the largest force")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.useCrInput:
            yield self.cr == self.CrConstant
        if not self.useInclinationInput:
            yield self.inclination == self.inclinationConstant
        yield self.v == der(self.s)
        yield self.f_nominal == -self.cr * self.fWeight * ac.cos(ac.atan(self.inclination))
        yield self.f == -self.f_nominal * regularized_sign(self.v / self.v0, self.reg, "RollingResistance")


class Vehicle(Component):
    """Vehicle on wheels that do not slip, driven at `flangeR`, pulled at `flangeT`; ``s = R flangeR.phi``.

    ``(m + J/R^2) a = flangeR.tau/R + flangeT.f - fDrag - fRoll - fGrav``, with ``fDrag = Cd A rho/2 (v - vWind)^2``,
    signed, ``fRoll = cr m g cos(alpha)`` against the motion and ``fGrav = m g sin(alpha)``, ``alpha =
    atan(inclination)``.

    >>> model = assemble("drive.flange - car.flangeR", drive=rotational.ConstantTorque(tau_constant=150.0),
    ...                  car=Vehicle(m=1000.0, J=0.0, R=0.3, A=2.0, Cd=0.4, CrConstant=0.01,
    ...                              s=start(0.0, fixed=True), v=start(1.0, fixed=True)))
    >>> fast = run(model, at=[0.0, 2000.0])  # 500 N against 98.0665 N and 0.48 kg/m v^2
    >>> close(fast["car.v"][-1], np.sqrt((500 - 98.0665) / 0.48), 1e-3)
    True

    Source: Modelica.Mechanics.Translational.Components.Vehicle.
    """

    useWindInput: bool = False
    useCrInput: bool = False
    useInclinationInput: bool = False
    flangeT: Flange = Flange()
    flangeR: ShaftFlange = ShaftFlange()
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass of the vehicle")
    g: Parameter = Parameter(9.80665, unit="m/s2", doc="gravity")
    J: Parameter = Parameter(0.0, unit="kg*m2", min=0.0, doc="rotating inertia of the drive train at the wheels")
    R: Parameter = Parameter(1.0, unit="m/rad", min=0.0, doc="radius of the wheels, the way per angle")
    A: Parameter = Parameter(1.0, unit="m2", min=0.0, doc="cross section")
    Cd: Parameter = Parameter(0.5, unit="1", min=0.0, doc="drag coefficient")
    rho: Parameter = Parameter(1.2, unit="kg/m3", min=0.0, doc="density of air")
    vWindConstant: Parameter = Parameter(0.0, unit="m/s", doc="wind velocity without useWindInput")
    CrConstant: Parameter = Parameter(0.015, unit="1", doc="rolling resistance coefficient without useCrInput")
    vReg: Parameter = Parameter(1e-3, unit="m/s", min=1e-60, doc="speed below which rolling resistance is continuous")
    inclinationConstant: Parameter = Parameter(0.0, unit="1", doc="tan(angle) of the road without useInclinationInput")
    vWind: Input = Input(unit="m/s", doc="wind velocity with useWindInput")
    cr: Input = Input(unit="1", doc="rolling resistance coefficient with useCrInput")
    inclination: Input = Input(unit="1", doc="tan(angle) of the road with useInclinationInput")
    s: Variable = Variable(unit="m", start=0.0, doc="position")
    v: Variable = Variable(unit="m/s", start=0.0, doc="velocity")
    a: Variable = Variable(unit="m/s2", doc="acceleration")
    f_drag: Variable = Variable(unit="N", doc="drag")
    f_roll: Variable = Variable(unit="N", doc="rolling resistance")
    f_grav: Variable = Variable(unit="N", doc="what gravity takes uphill")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.useWindInput:
            yield self.vWind == self.vWindConstant
        if not self.useCrInput:
            yield self.cr == self.CrConstant
        if not self.useInclinationInput:
            yield self.inclination == self.inclinationConstant
        alpha, wind = ac.atan(self.inclination), self.v - self.vWind
        yield self.s == self.flangeT.s
        yield self.s == self.R * self.flangeR.phi
        yield self.v == der(self.s)
        yield self.a == der(self.v)
        yield self.f_drag == self.Cd * self.A * self.rho / 2 * wind * ac.noevent(ac.abs(wind))
        rolling = regularized_sign(self.v / self.vReg, "Linear", "Vehicle")
        yield self.f_roll == self.cr * self.m * self.g * ac.cos(alpha) * rolling
        yield self.f_grav == self.m * self.g * ac.sin(alpha)
        pull = self.flangeR.tau / self.R + self.flangeT.f - self.f_drag - self.f_roll - self.f_grav
        yield (self.m + self.J / self.R**2) * self.a == pull
