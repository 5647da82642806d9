"""Ports, bonds, junctions, and the elements with one and two ports."""

from __future__ import annotations

from typing import ClassVar

from acausal import Array, Component, Connector, Equations, Flow, Input, Parameter, Potential, Variable, der


class BondPort(Connector):
    """End of a bond: an effort, and a flow that is positive into the component.

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), chapter 2; connector of BondLib (Cellier and Nebot,
    The Modelica bond graph library, Modelica 2005).
    """

    e: Potential = Potential(doc="effort")
    f: Flow = Flow(doc="flow into the component")


class Bond(Component):
    """A bond with its half arrow from `port_a` to `port_b`: ``e = port_a.e = port_b.e``, ``f = port_a.f = -port_b.f``.

    Ports may be connected without it; it shows effort, flow and power ``e f`` in the direction of the half arrow.

    >>> model = assemble("battery.port - bond.port_a", "bond.port_b - load.port", battery=Se(e=6.0), bond=Bond(),
    ...                  load=R(R=2.0))
    >>> run(model)["bond.power"][-1]
    18.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 2.2.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("port_a", "port_b")
    port_a: BondPort = BondPort()
    port_b: BondPort = BondPort()
    e: Variable = Variable(doc="effort")
    f: Variable = Variable(doc="flow in the direction of the half arrow")
    power: Variable = Variable(doc="power in the direction of the half arrow")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e == self.port_a.e
        yield self.e == self.port_b.e
        yield self.f == self.port_a.f
        yield self.port_a.f + self.port_b.f == 0
        yield self.power == self.e * self.f


class PartialJunction(Component, partial=True):
    """Bonds that meet: ``inp[i]`` with the half arrow into the junction, ``out[j]`` with the half arrow out of it.

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.3.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("inp", "out")
    n_in: int = 1
    n_out: int = 2
    inp: Array[BondPort] = Array(BondPort(), "n_in")
    out: Array[BondPort] = Array(BondPort(), "n_out")


class J0(PartialJunction):
    """0-junction: one effort for all bonds, flows in and out in balance, ``sum(inp.f) + sum(out.f) = 0``.

    >>> model = assemble("source.port - node.inp[0]", "node.out[0] - one.port", "node.out[1] - two.port", node=J0(),
    ...                  source=Sf(f=3.0), one=R(R=2.0), two=R(R=4.0))
    >>> close(run(model)["node.e"][-1], 4.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eq. 3.7.
    """

    e: Variable = Variable(doc="common effort")

    def equations(self) -> Equations:
        yield from super().equations()
        ports = [*self.inp, *self.out]
        for port in ports:
            yield self.e == port.e
        yield sum((port.f for port in ports[1:]), ports[0].f) == 0


class J1(PartialJunction):
    """1-junction: one flow for all bonds, ``f = inp[i].f = -out[j].f``, efforts in balance, ``sum(inp.e - out.e) = 0``.

    >>> model = assemble("source.port - loop.inp[0]", "loop.out[0] - one.port", "loop.out[1] - two.port", loop=J1(),
    ...                  source=Se(e=12.0), one=R(R=2.0), two=R(R=4.0))
    >>> close(run(model)["loop.f"][-1], 2.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eq. 3.8.
    """

    f: Variable = Variable(doc="common flow, in the direction of the half arrows")

    def equations(self) -> Equations:
        yield from super().equations()
        for port in self.inp:
            yield self.f == port.f
        for port in self.out:
            yield self.f == -port.f
        efforts = [*(port.e for port in self.inp), *(-port.e for port in self.out)]
        yield sum(efforts[1:], efforts[0]) == 0


class OnePort(Component, partial=True):
    """Element with one port, the half arrow of its bond pointing into it: ``e = port.e``, ``f = port.f``.

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("port",)
    port: BondPort = BondPort()
    e: Variable = Variable(doc="effort")
    f: Variable = Variable(doc="flow into the element")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e == self.port.e
        yield self.f == self.port.f


class R(OnePort):
    """Resistor, ``e = R f``.

    >>> run(assemble("source.port - load.port", source=Sf(f=3.0), load=R(R=2.0)))["load.e"][-1]
    6.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eq. 3.1.
    """

    R: Parameter = Parameter(1.0, doc="resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e == self.R * self.f


class MR(OnePort):
    """Resistor whose resistance is a signal, ``e = r f``.

    >>> model = assemble("source.port - load.port", "ramp.y - load.r", source=Sf(f=3.0), load=MR(), ramp=blocks.Slope())
    >>> run(model)["load.e"][-1]
    3.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1, with a modulating signal.
    """

    r: Input = Input(doc="resistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e == self.r * self.f


class C(OnePort):
    """Capacitor, ``q = C e``, ``C de/dt = f``.

    >>> model = assemble("source.port - store.port", source=Sf(f=3.0), store=C(C=2.0, e=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.0, 1.0])["store.e"], [1.0, 2.5])
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eqs. 3.2 and 3.3.
    """

    C: Parameter = Parameter(1.0, doc="capacitance")
    q: Variable = Variable(doc="displacement")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.q == self.C * self.e
        yield self.C * der(self.e) == self.f  # not der(q): displacements may be tiny beside the tolerances of a run


class MC(OnePort):
    """Capacitor whose tangent capacitance is a signal, ``c de/dt = f``.

    >>> model = assemble("source.port - store.port", "size.y - store.c", source=Sf(f=3.0),
    ...                  size=blocks.Slope(offset=1.0), store=MC(e=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.0, 1.0])["store.e"], [1.0, 1.0 + 3.0 * np.log(2.0)])
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 4.4.3, compliance of a fluid in a chamber.
    """

    c: Input = Input(doc="capacitance dq/de")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.c * der(self.e) == self.f


class I(OnePort):  # noqa: E742
    """Inertia, ``p = I f``, ``I df/dt = e``.

    >>> model = assemble("source.port - mass.port", source=Se(e=3.0), mass=I(I=2.0, f=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.0, 1.0])["mass.f"], [1.0, 2.5])
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eqs. 3.4 and 3.5.
    """

    I: Parameter = Parameter(1.0, doc="inertia")  # noqa: E741
    p: Variable = Variable(doc="momentum")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p == self.I * self.f
        yield self.I * der(self.f) == self.e


class MI(OnePort):
    """Inertia whose tangent inertance is a signal, ``i df/dt = e``.

    >>> model = assemble("source.port - mass.port", "size.y - mass.i", source=Se(e=3.0),
    ...                  size=blocks.Slope(offset=1.0), mass=MI(f=start(1.0, fixed=True)))
    >>> close(run(model, at=[0.0, 1.0])["mass.f"], [1.0, 1.0 + 3.0 * np.log(2.0)])
    True

    Source: dual of `MC`; as there, the energy stored is kept by the graph around it, which gives the signal.
    """

    i: Input = Input(doc="inertance dp/df")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i * der(self.f) == self.e


class PartialSource(Component, partial=True):
    """Element with one port, the half arrow of its bond pointing out of it.

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.4.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("port",)
    port: BondPort = BondPort()


class Se(PartialSource):
    """Effort source, ``port.e = e``, half arrow pointing out; `f` is the flow out of it.

    >>> run(assemble("source.port - load.port", source=Se(e=6.0), load=R(R=2.0)))["source.f"][-1]
    3.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.4.
    """

    e: Parameter = Parameter(1.0, doc="effort")
    f: Variable = Variable(doc="flow out of the source")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.e == self.e
        yield self.f == -self.port.f


class Sf(PartialSource):
    """Flow source, half arrow pointing out, ``port.f = -f``; `e` is the effort that meets it.

    >>> run(assemble("source.port - load.port", source=Sf(f=3.0), load=R(R=2.0)))["source.e"][-1]
    6.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.4.
    """

    f: Parameter = Parameter(1.0, doc="flow out of the source")
    e: Variable = Variable(doc="effort")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.f == -self.f
        yield self.e == self.port.e


class MSe(PartialSource):
    """Effort source whose effort is a signal, ``port.e = e``, half arrow pointing out.

    >>> model = assemble("ramp.y - source.e", "source.port - load.port", ramp=blocks.Slope(slope=6.0), source=MSe(),
    ...                  load=R(R=2.0))
    >>> run(model)["source.f"][-1]
    3.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.4, with a modulating signal.
    """

    e: Input = Input(doc="effort")
    f: Variable = Variable(doc="flow out of the source")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.e == self.e
        yield self.f == -self.port.f


class MSf(PartialSource):
    """Flow source whose flow is a signal, half arrow pointing out, ``port.f = -f``.

    >>> model = assemble("ramp.y - source.f", "source.port - load.port", ramp=blocks.Slope(slope=3.0), source=MSf(),
    ...                  load=R(R=2.0))
    >>> run(model)["source.e"][-1]
    6.0

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.1.4, with a modulating signal.
    """

    f: Input = Input(doc="flow out of the source")
    e: Variable = Variable(doc="effort")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.f == -self.f
        yield self.e == self.port.e


class TwoPort(Component, partial=True):
    """Element with two ports, half arrows into `port_a` and out of `port_b`; ``e1 f1 = e2 f2``.

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.2.
    """

    _must_connect: ClassVar[tuple[str, ...]] = ("port_a", "port_b")
    port_a: BondPort = BondPort()
    port_b: BondPort = BondPort()
    e1: Variable = Variable(doc="effort at port a")
    f1: Variable = Variable(doc="flow into port a")
    e2: Variable = Variable(doc="effort at port b")
    f2: Variable = Variable(doc="flow out of port b")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e1 == self.port_a.e
        yield self.f1 == self.port_a.f
        yield self.e2 == self.port_b.e
        yield self.f2 == -self.port_b.f


class TF(TwoPort):
    """Transformer, ``e1 = m e2``, ``f2 = m f1``.

    >>> model = assemble("source.port - gear.port_a", "gear.port_b - load.port", source=Se(e=6.0), gear=TF(m=3.0),
    ...                  load=R(R=2.0))
    >>> close(run(model)["gear.f1"][-1], 1.0 / 3.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eq. 3.10.
    """

    m: Parameter = Parameter(1.0, doc="modulus")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e1 == self.m * self.e2
        yield self.f2 == self.m * self.f1


class MTF(TwoPort):
    """Transformer whose modulus is a signal, ``e1 = m e2``, ``f2 = m f1``.

    >>> model = assemble("source.port - gear.port_a", "gear.port_b - load.port", "ratio.y - gear.m", source=Se(e=6.0),
    ...                  gear=MTF(), load=R(R=2.0), ratio=blocks.Constant(k=3.0))
    >>> close(run(model)["gear.f1"][-1], 1.0 / 3.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.2.3.
    """

    m: Input = Input(doc="modulus")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e1 == self.m * self.e2
        yield self.f2 == self.m * self.f1


class GY(TwoPort):
    """Gyrator, ``e1 = r f2``, ``e2 = r f1``.

    >>> model = assemble("source.port - motor.port_a", "motor.port_b - load.port", source=Se(e=6.0), motor=GY(r=3.0),
    ...                  load=R(R=2.0))
    >>> close(run(model)["motor.f1"][-1], 4.0 / 3.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), Eq. 3.12.
    """

    r: Parameter = Parameter(1.0, doc="modulus")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e1 == self.r * self.f2
        yield self.e2 == self.r * self.f1


class MGY(TwoPort):
    """Gyrator whose modulus is a signal, ``e1 = r f2``, ``e2 = r f1``.

    >>> model = assemble("source.port - motor.port_a", "motor.port_b - load.port", "field.y - motor.r",
    ...                  source=Se(e=6.0), motor=MGY(), load=R(R=2.0), field=blocks.Constant(k=3.0))
    >>> close(run(model)["motor.f1"][-1], 4.0 / 3.0)
    True

    Source: Karnopp, Margolis and Rosenberg, System Dynamics (2012), section 3.2.3.
    """

    r: Input = Input(doc="modulus")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.e1 == self.r * self.f2
        yield self.e2 == self.r * self.f1


Junction0, Junction1 = J0, J1
