"""Mechanisms of the Modelica Standard Library 4.0, an engine with a loop too, from library components."""

from __future__ import annotations

from acausal import PI, Component, Equations, Expr, Parameter, Variable, der, inner, where
from acausal.components import multibody, rotational, translational
from acausal.components.examples import assemble, start

EARLY_COMPRESSION = (177.4132, -287.2189, 151.8252, -24.9973, 2.4)
LATE_COMPRESSION = (2836360.0, -10569296.0, 14761814.0, -9158505.0, 2129670.0)
EARLY_EXPANSION = (-3929704.0, 14748765.0, -20747000.0, 12964477.0, -3036495.0)
LATE_EXPANSION = (145.930, -131.707, 17.3438, 17.9272, 2.4)
"""Pressure [bar] over the normalized position, powers 4 to 0 (MultiBody.Examples.Loops.Utilities.GasForce2)."""


def polynomial(x: Expr, coefficients: tuple[float, ...]) -> Expr:
    value = 0.0 * x
    for coefficient in coefficients:
        value = value * x + coefficient
    return value


class GasForce(translational.PartialCompliant):
    """Pressure on the piston of the engine: two polynomials of its position ``x = 1 - s_rel/L`` in either direction."""

    L: Parameter = Parameter(0.35, unit="m", doc="length of the cylinder")
    d: Parameter = Parameter(0.1, unit="m", doc="diameter of the cylinder")
    x: Variable = Variable(unit="1", doc="normalized position")
    v_rel: Variable = Variable(unit="m/s", doc="velocity of the piston, negative while it compresses")
    bar: Variable = Variable(doc="pressure [bar]")

    def equations(self) -> Equations:
        yield from super().equations()
        x = self.x
        late, early = polynomial(x, LATE_COMPRESSION), polynomial(x, EARLY_COMPRESSION)
        first, then = polynomial(x, EARLY_EXPANSION), polynomial(x, LATE_EXPANSION)
        compressed, expanded = where(x < 0.986061, early, late), where(x > 0.933, first, then)
        yield self.x == 1 - self.s_rel / self.L
        yield self.v_rel == der(self.s_rel)
        yield self.bar == where(self.v_rel < 0, compressed, expanded)
        yield self.f == -1e5 * self.bar * PI * self.d**2 / 4


def double_pendulum() -> Component:
    """MultiBody.Examples.Elementary.DoublePendulum."""
    return assemble(
        "damper.flange_b - revolute1.axis", "revolute1.support - damper.flange_a",
        "revolute1.frame_b - boxBody1.frame_a", "revolute2.frame_b - boxBody2.frame_a",
        "boxBody1.frame_b - revolute2.frame_a", "world.frame_b - revolute1.frame_a",
        world=inner(multibody.World()),
        revolute1=multibody.Revolute(useAxisFlange=True, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        damper=rotational.Damper(d=0.1), boxBody1=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.06),
        revolute2=multibody.Revolute(phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        boxBody2=multibody.BodyBox(r=(0.5, 0.0, 0.0), width=0.06),
    )  # fmt: skip


def three_springs() -> Component:
    """MultiBody.Examples.Elementary.ThreeSprings."""
    return assemble(
        "world.frame_b - bar1.frame_a - bar2.frame_a", "bar1.frame_b - spring1.frame_a",
        "bar2.frame_b - spring3.frame_a", "spring2.frame_b - body1.frame_a",
        "spring3.frame_b - spring1.frame_b - spring2.frame_a",
        world=inner(multibody.World()),
        body1=multibody.Body(
            r_CM=(0.0, -0.2, 0.0), m=0.8, I_11=0.1, I_22=0.1, I_33=0.1, r_0=start((0.5, -0.3, 0.0),
            fixed=True), v_0=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True, w_0_fixed=True,
        ),
        bar1=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)), spring1=multibody.Spring(s_unstretched=0.1, c=20.0),
        bar2=multibody.FixedTranslation(r=(0.0, 0.0, 0.3)), spring2=multibody.Spring(s_unstretched=0.1, c=40.0),
        spring3=multibody.Spring(s_unstretched=0.1, c=20.0, fixedRotationAtFrame_b=True),
    )  # fmt: skip


def spring_mass_system() -> Component:
    """MultiBody.Examples.Elementary.SpringMassSystem."""
    return assemble(
        "body1.frame_a - p1.frame_b", "world.frame_b - bar1.frame_a", "bar1.frame_b - p1.frame_a - bar2.frame_a",
        "spring1.flange_b - p1.axis", "bar2.frame_b - p2.frame_a - spring2.frame_a",
        "p2.frame_b - body2.frame_a - spring2.frame_b", "spring1.flange_a - p1.support",
        world=inner(multibody.World()),
        p1=multibody.Prismatic(
            useAxisFlange=True, n=(0.0, -1.0, 0.0), s=start(0.1, fixed=True), v=start(0.0,
            fixed=True)), spring1=translational.Spring(c=30.0, s_rel0=0.1,
        ),
        body1=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0)), bar1=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)),
        bar2=multibody.FixedTranslation(r=(0.3, 0.0, 0.0)), body2=multibody.Body(m=1.0, r_CM=(0.0, 0.0, 0.0)),
        p2=multibody.Prismatic(
            useAxisFlange=True, n=(0.0, -1.0, 0.0), stateSelect="always", s=start(0.1, fixed=True),
            v=start(0.0, fixed=True)), spring2=multibody.Spring(c=30.0, s_unstretched=0.1,
        ),
    )  # fmt: skip


def free_body() -> Component:
    """MultiBody.Examples.Elementary.FreeBody."""
    return assemble(
        "bar2.frame_a - world.frame_b - spring1.frame_a", "spring1.frame_b - body.frame_a",
        "bar2.frame_b - spring2.frame_a", "body.frame_b - spring2.frame_b",
        world=inner(multibody.World()), bar2=multibody.FixedTranslation(r=(0.8, 0.0, 0.0)),
        spring1=multibody.Spring(c=20.0, s_unstretched=0.0),
        body=multibody.BodyShape(m=1.0, I_11=1.0, I_22=1.0, I_33=1.0, r=(0.4, 0.0, 0.0), r_CM=(0.2, 0.0, 0.0),
            r_0=start((0.2, -0.5, 0.1), fixed=True), v_0=start((0.0, 0.0, 0.0), fixed=True), angles_fixed=True,
            w_0_fixed=True, angles_start=(0.174532925199433, 0.174532925199433, 0.174532925199433)),
        spring2=multibody.Spring(c=20.0, s_unstretched=0.0),
    )  # fmt: skip


CRANK = (
    "world.frame_b - bearing.frame_a - cylPosition.frame_a", "crank2.frame_a - crank1.frame_b",
    "bearing.frame_b - crank1.frame_a", "crank3.frame_b - crank4.frame_a", "inertia.flange_b - bearing.axis",
    "crank2.frame_b - crank3.frame_a - mid.frame_a", "cylPosition.frame_b - cylinder.frame_a",
)  # fmt: skip
"""Connections that both engines have."""


def crank() -> dict[str, Component]:
    """Parts that both engines have."""
    return {
        "world": inner(multibody.World()), "piston": multibody.BodyCylinder(diameter=0.1, r=(0.0, -0.1, 0.0)),
        "connectingRod": multibody.BodyBox(
            widthDirection=(1.0, 0.0, 0.0), width=0.02, height=0.06, r=(0.0, -0.2, 0.0)
        ),
        "bearing": multibody.Revolute(useAxisFlange=True, n=(1.0, 0.0, 0.0)),
        "inertia": rotational.Inertia(J=1.0, w=start(10.0, fixed=True), phi=start(0.0, fixed=True)),
        "crank1": multibody.BodyCylinder(diameter=0.05, r=(0.1, 0.0, 0.0)),
        "crank2": multibody.BodyBox(height=0.05, widthDirection=(1.0, 0.0, 0.0), width=0.02, r=(0.0, 0.1, 0.0)),
        "crank3": multibody.BodyCylinder(r=(0.1, 0.0, 0.0), diameter=0.03),
        "crank4": multibody.BodyBox(height=0.05, widthDirection=(1.0, 0.0, 0.0), width=0.02, r=(0.0, -0.1, 0.0)),
        "mid": multibody.FixedTranslation(r=(0.05, 0.0, 0.0)),
        "cylPosition": multibody.FixedTranslation(r=(0.15, 0.45, 0.0)), "b1": multibody.Revolute(n=(1.0, 0.0, 0.0)),
        "b2": multibody.RevolutePlanarLoopConstraint(n=(1.0, 0.0, 0.0)),
    }  # fmt: skip


def engine1a() -> Component:
    """MultiBody.Examples.Loops.Engine1a."""
    return assemble(
        *CRANK, "b2.frame_a - mid.frame_b", "b2.frame_b - connectingRod.frame_b",
        "connectingRod.frame_a - b1.frame_b", "b1.frame_a - piston.frame_b", "cylinder.frame_b - piston.frame_a",
        **crank(), cylinder=multibody.Prismatic(n=(0.0, -1.0, 0.0), s=start(0.15)),
    )  # fmt: skip


def engine1b() -> Component:
    """MultiBody.Examples.Loops.Engine1b."""
    return assemble(
        *CRANK, "cylinder.frame_b - rod3.frame_a - piston.frame_a", "gasForce.flange_a - cylinder.support",
        "gasForce.flange_b - cylinder.axis", "rod3.frame_b - b1.frame_a", "mid.frame_b - b2.frame_a",
        "b2.frame_b - connectingRod.frame_b - rod1.frame_b", "b1.frame_b - rod1.frame_a",
        **crank(), gasForce=GasForce(d=0.1, L=0.35),
        cylinder=multibody.Prismatic(useAxisFlange=True, n=(0.0, -1.0, 0.0)),
        rod1=multibody.FixedTranslation(r=(0.0, -0.2, 0.0)), rod3=multibody.FixedTranslation(r=(0.0, -0.1, 0.0)),
    )  # fmt: skip
