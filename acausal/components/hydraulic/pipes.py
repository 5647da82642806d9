"""Volumes that store oil by compression, pipes with inertia, and the laws of pipe friction."""

from __future__ import annotations

from acausal import PI, Component, Equations, Expr, Input, Output, Parameter, Variable, clip, der, log10, outer, where
from acausal import abs as magnitude
from acausal import max as maximum

from .interfaces import HydraulicPort, Oil, not_torn


class ControlVolume(Component):
    """Constant volume of compressible oil, ``V/B dp/dt = port.q``.

    >>> model = assemble("one.port - gap.port_a", "gap.port_b - two.port", oil=ac.inner(Oil(B=1e9)),
    ...                  one=ControlVolume(V=2e-3, p=start(3e6, fixed=True)), gap=LaminarRestriction(G=1e-12),
    ...                  two=ControlVolume(V=2e-3, p=start(1e6, fixed=True)))
    >>> close(run(model)["one.p"][-1], 2e6 + 1e6 * np.exp(-1.0))
    True

    Source: Eq. 6.
    """

    port: HydraulicPort = HydraulicPort()
    oil: Oil = outer(Oil())
    V: Parameter = Parameter(1e-3, unit="m3", min=1e-30, doc="volume")
    p: Variable = Variable(unit="Pa", start=1e5, nominal=1e6, doc="pressure")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p == self.port.p
        yield der(self.p) == self.oil.B / self.V * self.port.q
        yield from not_torn(self.p)


class PartialFriction(Component, partial=True):
    """Law of pipe friction: the pressure loss `dp`, of the sign of the flow, for the volume flow rate `q`.

    Source: Darcy-Weisbach equation (Eq. 11), ``dp = lambda l/d rho/2 w |w|``, with ``w = q/(pi/4 d^2)``.
    """

    oil: Oil = outer(Oil())
    q: Input = Input(unit="m3/s", nominal=1e-3, doc="volume flow rate")
    dp: Output = Output(unit="Pa", nominal=1e5, doc="pressure loss")
    l: Parameter = Parameter(10.0, unit="m", min=0.0, doc="length")  # noqa: E741
    d: Parameter = Parameter(0.038, unit="m", min=1e-30, doc="inner diameter")
    eps: Parameter = Parameter(5e-5, unit="m", min=0.0, doc="absolute roughness")
    w: Variable = Variable(unit="m/s", doc="mean velocity")
    Re: Variable = Variable(unit="1", nominal=1e3, doc="Reynolds number, never negative")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.w == self.q / (PI / 4 * self.d**2)
        yield self.Re == magnitude(self.w) * self.d / self.oil.nu

    def laminar(self) -> Expr:
        """Loss of laminar flow [Pa], ``lambda = 64/Re``: ``32 nu rho l w/d^2`` (Hagen-Poiseuille)."""
        return 32 * self.oil.nu * self.oil.rho * self.l * self.w / self.d**2

    def turbulent(self) -> Expr:
        """Loss of turbulent flow [Pa], ``lambda = 0.25/log10(eps/(3.7 d) + 5.74/Re^0.9)^2`` (Swamee and Jain; Eq.
        12)."""
        turbulent_Re = maximum(self.Re, 2000.0)  # below, the law is not used, and its derivative at rest is infinite
        factor = 0.25 / log10(self.eps / (3.7 * self.d) + 5.74 / turbulent_Re**0.9) ** 2
        return factor * self.l / self.d * self.oil.rho / 2 * self.w * magnitude(self.w)


class LaminarFriction(PartialFriction):
    """Laminar flow at any Reynolds number, ``dp = 32 nu rho l w/d^2``.

    >>> model = assemble("flow.y - law.q", flow=blocks.Constant(k=1e-3), law=LaminarFriction(l=10.0, d=0.05),
    ...                  oil=ac.inner(Oil()))
    >>> close(run(model)["law.dp"][-1], 128 * 46e-6 * 850 * 10.0 * 1e-3 / (np.pi * 0.05**4))
    True

    Source: Hagen-Poiseuille law; first line of Eq. 12.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dp == self.laminar()


class PaperFriction(PartialFriction):
    """Laminar for Re < 2000, turbulent above: the loss jumps by half there.

    The jump is ill-posed: at constant pressure difference the flow chatters on it. `BlendedFriction` is the law to use.

    >>> model = assemble("flow.y - law.q", flow=blocks.Slope(slope=4e-3), law=PaperFriction(), oil=ac.inner(Oil()))
    >>> values = run(model, at=[0.6, 0.8])  # at Re = 1750 and 2330
    >>> values["law.Re"][0] < 2000 < values["law.Re"][1], values["law.dp"][1] > 1.7 * values["law.dp"][0]
    (True, True)

    Source: Eqs. 11 and 12.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.dp == where(self.Re < 2000.0, self.laminar(), self.turbulent())


class BlendedFriction(PartialFriction):
    """Laminar up to Re = 2000, turbulent from 4000 on, between them ``(1 - s) laminar + s turbulent``.

    ``s = k^2 (3 - 2 k)``, ``k = (Re - 2000)/2000``.

    >>> model = assemble("flow.y - law.q - sharp.q", flow=blocks.Constant(k=8e-3), law=BlendedFriction(),
    ...                  sharp=PaperFriction(), oil=ac.inner(Oil()))
    >>> run(model)["law.dp"] == run(model)["sharp.dp"]  # turbulent
    True

    Source: Eqs. 11 and 12 with a smooth transition instead of the jump.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        k = clip((self.Re - 2000) / 2000, 0.0, 1.0)
        share = k**2 * (3 - 2 * k)
        yield self.dp == (1 - share) * self.laminar() + share * self.turbulent()


class Pipe(Component):
    """Pipe with half of its compressible volume at each end, and inertia and friction between them.

    ``A l/(2 B) dp_a/dt = port_a.q - q``, ``A l/(2 B) dp_b/dt = port_b.q + q``,
    ``rho l/A dq/dt = p_a - p_b - friction.dp``, ``A = pi/4 d^2``.

    >>> model = assemble("supply.port - pipe.port_a", "pipe.port_b - tank.port", oil=ac.inner(Oil()), tank=Tank(p=1e5),
    ...                  supply=Tank(p=1.1e5), pipe=Pipe(friction=LaminarFriction(), d=0.02, q=start(0.0, fixed=True)))
    >>> steady, lag = 1e4 * np.pi * 0.02**4 / (128 * 46e-6 * 850 * 10), 0.02**2 / (32 * 46e-6)
    >>> close(run(model, at=[0.0, 0.1])["pipe.q"][-1], steady * (1 - np.exp(-0.1 / lag)))
    True

    Source: Eqs. 6, 9, 10, 11; lumped C-I-C element of Fig. 8.
    """

    port_a: HydraulicPort = HydraulicPort()
    port_b: HydraulicPort = HydraulicPort()
    oil: Oil = outer(Oil())
    l: Parameter = Parameter(10.0, unit="m", min=1e-30, doc="length")  # noqa: E741
    d: Parameter = Parameter(0.038, unit="m", min=1e-30, doc="inner diameter")
    eps: Parameter = Parameter(5e-5, unit="m", min=0.0, doc="absolute roughness")
    friction: PartialFriction = BlendedFriction(l=l, d=d, eps=eps)
    p_a: Variable = Variable(unit="Pa", start=1e5, nominal=1e6, doc="pressure at port a")
    p_b: Variable = Variable(unit="Pa", start=1e5, nominal=1e6, doc="pressure at port b")
    q: Variable = Variable(unit="m3/s", start=0.0, nominal=1e-3, doc="volume flow rate from a to b")

    def equations(self) -> Equations:
        yield from super().equations()
        area = PI / 4 * self.d**2
        stiffness = self.oil.B / (area * self.l / 2)
        yield self.p_a == self.port_a.p
        yield self.p_b == self.port_b.p
        yield self.friction.q == self.q
        yield der(self.p_a) == stiffness * (self.port_a.q - self.q)
        yield der(self.p_b) == stiffness * (self.port_b.q + self.q)
        yield der(self.q) == area / (self.oil.rho * self.l) * (self.p_a - self.p_b - self.friction.dp)
        yield from not_torn(self.p_a)
        yield from not_torn(self.p_b)
