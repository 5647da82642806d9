"""Transformers, gyrator, controlled sources, and the conversion into mechanical power."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import cast

from acausal import Array, Component, DeclarationError, Equations, Parameter, Variable, conditional, der

from .. import rotational, translational
from .interfaces import OnePort, TwoPort


class VCV(TwoPort):
    """Voltage-controlled voltage source, ``v2 = gain v1``, ``i1 = 0``.

    >>> model = assemble("source.p - amplifier.p1", "amplifier.p2 - load.p",
    ...                  "source.n - amplifier.n1 - amplifier.n2 - load.n - ground.p", source=ConstantVoltage(V=2.0),
    ...                  amplifier=VCV(gain=3.0), load=Resistor(R=2.0), ground=Ground())
    >>> run(model)["load.i"][-1]
    3.0

    Source: Modelica.Electrical.Analog.Basic.VCV.
    """

    gain: Parameter = Parameter(1.0, unit="1", doc="voltage gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v2 == self.gain * self.v1
        yield self.i1 == 0


class VCC(TwoPort):
    """Voltage-controlled current source, ``i2 = transConductance v1``, ``i1 = 0``.

    >>> model = assemble("source.p - amplifier.p1", "amplifier.p2 - load.p",
    ...                  "source.n - amplifier.n1 - amplifier.n2 - load.n - ground.p", source=ConstantVoltage(V=2.0),
    ...                  amplifier=VCC(transConductance=0.5), load=Resistor(R=3.0), ground=Ground())
    >>> run(model)["load.v"][-1]
    -3.0

    Source: Modelica.Electrical.Analog.Basic.VCC.
    """

    transConductance: Parameter = Parameter(1.0, unit="S", doc="transconductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i2 == self.transConductance * self.v1
        yield self.i1 == 0


class CCV(TwoPort):
    """Current-controlled voltage source, ``v2 = transResistance i1``, ``v1 = 0``.

    >>> model = assemble("source.p - ground.p - amplifier.n1 - amplifier.n2 - load.n", "source.n - amplifier.p1",
    ...                  "amplifier.p2 - load.p", source=ConstantCurrent(I=2.0), load=Resistor(R=3.0),
    ...                  amplifier=CCV(transResistance=6.0), ground=Ground())
    >>> run(model)["load.i"][-1]
    4.0

    Source: Modelica.Electrical.Analog.Basic.CCV.
    """

    transResistance: Parameter = Parameter(1.0, unit="ohm", doc="transresistance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v2 == self.transResistance * self.i1
        yield self.v1 == 0


class CCC(TwoPort):
    """Current-controlled current source, ``i2 = gain i1``, ``v1 = 0``.

    >>> model = assemble("source.p - ground.p - amplifier.n1 - amplifier.n2 - load.n", "source.n - amplifier.p1",
    ...                  "amplifier.p2 - load.p", source=ConstantCurrent(I=2.0), load=Resistor(R=3.0),
    ...                  amplifier=CCC(gain=5.0), ground=Ground())
    >>> run(model)["load.i"][-1]
    -10.0

    Source: Modelica.Electrical.Analog.Basic.CCC.
    """

    gain: Parameter = Parameter(1.0, unit="1", doc="current gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i2 == self.gain * self.i1
        yield self.v1 == 0


class Gyrator(TwoPort):
    """Gyrator, ``i1 = G2 v2``, ``i2 = -G1 v1``.

    >>> model = assemble("source.p - gyrator.p1", "gyrator.p2 - load.p",
    ...                  "source.n - gyrator.n1 - gyrator.n2 - load.n - ground.p", source=ConstantVoltage(V=2.0),
    ...                  gyrator=Gyrator(G1=0.5, G2=0.5), load=Resistor(R=4.0), ground=Ground())
    >>> run(model)["gyrator.i1"][-1]
    2.0

    Source: Modelica.Electrical.Analog.Basic.Gyrator.
    """

    G1: Parameter = Parameter(1.0, unit="S", doc="gyration conductance of the left port")
    G2: Parameter = Parameter(1.0, unit="S", doc="gyration conductance of the right port")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i1 == self.G2 * self.v2
        yield self.i2 == -self.G1 * self.v1


class IdealTransformer(TwoPort):
    """Ideal transformer, ``v1 = n v2``, ``i1 = im1 - i2/n``; `im1` is 0 or, with `considerMagnetization`, magnetizes.

    ``Lm1 dim1/dt = v1``. Without magnetization the equations hold at zero frequency too.

    >>> model = assemble("source.p - trafo.p1", "trafo.p2 - load.p",
    ...                  "source.n - trafo.n1 - trafo.n2 - load.n - ground.p",
    ...                  source=ConstantVoltage(V=6.0), trafo=IdealTransformer(n=3.0), load=Resistor(R=2.0),
    ...                  ground=Ground())
    >>> close(run(model)["trafo.i1"][-1], 1.0 / 3.0)
    True

    Source: Modelica.Electrical.Analog.Ideal.IdealTransformer.
    """

    considerMagnetization: bool = False
    n: Parameter = Parameter(1.0, unit="1", doc="turns ratio primary to secondary")
    Lm1: Parameter = Parameter(1.0, unit="H", doc="magnetization inductance seen from the primary side")
    im1: Variable = Variable(unit="A", start=0.0, doc="magnetization current seen from the primary side")
    psim1: Variable = Variable(unit="Wb", doc="magnetization flux seen from the primary side, 0 without it")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == self.n * self.v2
        yield self.im1 == self.i1 + self.i2 / self.n
        if self.considerMagnetization:
            yield self.Lm1 * der(self.im1) == self.v1
            yield self.psim1 == self.Lm1 * self.im1
        else:
            yield self.im1 == 0
            yield self.psim1 == 0


class Transformer(TwoPort):
    """Two coupled inductors, ``v1 = L1 di1/dt + M di2/dt``, ``v2 = M di1/dt + L2 di2/dt``.

    >>> model = assemble("source.p - trafo.p1", "trafo.p2 - load.p",
    ...                  "source.n - trafo.n1 - trafo.n2 - load.n - ground.p",
    ...                  source=ConstantVoltage(V=6.0), load=Resistor(R=1e6), ground=Ground(),
    ...                  trafo=Transformer(L1=2.0, L2=8.0, M=3.0, i1=start(0.0, fixed=True), i2=start(0.0, fixed=True)))
    >>> trafo = run(model, at=[0.5, 1.0])
    >>> close(trafo["trafo.i1"], [1.5, 3.0], 1e-4) and close(trafo["load.v"], [9.0, 9.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Basic.Transformer.
    """

    L1: Parameter = Parameter(1.0, unit="H", doc="primary inductance")
    L2: Parameter = Parameter(1.0, unit="H", doc="secondary inductance")
    M: Parameter = Parameter(1.0, unit="H", doc="coupling inductance")
    leakage1: Parameter = Parameter(L1 - M, unit="H", doc="what L1 does not couple; follows from L1 and M")
    leakage2: Parameter = Parameter(L2 - M, unit="H", doc="what L2 does not couple; follows from L2 and M")
    i1: Variable = Variable(unit="A", start=0.0, doc="current from p1 to n1")
    i2: Variable = Variable(unit="A", start=0.0, doc="current from p2 to n2")
    dv: Variable = Variable(unit="V", doc="v1 - v2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v1 == self.L1 * der(self.i1) + self.M * der(self.i2)
        # the difference, so that L1 = L2 = M loses a state visibly
        yield self.dv == self.leakage1 * der(self.i1) - self.leakage2 * der(self.i2)
        yield self.v2 == self.v1 - self.dv


class Winding(OnePort):
    """One of the coupled inductors of an `M_Transformer`, which gives its equation.

    Source: Modelica.Electrical.Analog.Basic.M_Transformer.
    """

    i: Variable = Variable(unit="A", start=0.0, fixed=True, doc="current from p to n through the winding")


class M_Transformer(Component):
    """Coupled inductors ``windings[k]``, ``v = L di/dt`` with a symmetric matrix `L` in henry.

    `L` is the matrix, or its upper triangle row by row, ``(L11, L12, L13, L22, L23, L33)``; the number N of inductors
    follows from it.

    >>> model = assemble("source.p - trafo.windings[0].p", "trafo.windings[1].p - load.p",
    ...                  "source.n - trafo.windings[0].n - trafo.windings[1].n - load.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=6.0), load=Resistor(R=1e6), trafo=M_Transformer(L=[[2, 3], [3, 8]]))
    >>> close(run(model, at=[0.5, 1.0])["trafo.windings[0].i"], [1.5, 3.0], 1e-4)
    True

    Source: Modelica.Electrical.Analog.Basic.M_Transformer.
    """

    L: Sequence[Sequence[float]] | Sequence[float] = ((1.0, 0.1), (0.1, 2.0))
    henry: Parameter = Parameter(1.0, unit="H", doc="unit of the matrix")

    @property
    def matrix(self) -> Sequence[Sequence[float]]:
        """The inductances [H].

        Raises:
            DeclarationError: `L` is neither a symmetric matrix nor its upper triangle.
        """
        rows = list(self.L)
        if all(isinstance(row, Sequence) for row in rows):
            full = cast("list[Sequence[float]]", rows)
            if any(len(row) != len(full) for row in full) or any(
                full[j][k] != full[k][j] for j in range(len(full)) for k in range(j)
            ):
                raise DeclarationError(f"M_Transformer: L must be a symmetric matrix, not {self.L}")
            return full
        n = (math.isqrt(8 * len(rows) + 1) - 1) // 2
        if n * (n + 1) != 2 * len(rows) or any(isinstance(value, Sequence) for value in rows):
            raise DeclarationError(
                f"M_Transformer: L must be a matrix or its upper triangle, of 1, 3, 6, 10, ... values, not {self.L}"
            )
        triangle = iter(cast("list[float]", rows))
        upper = [[next(triangle) if k >= j else 0.0 for k in range(n)] for j in range(n)]
        return [[upper[min(j, k)][max(j, k)] for k in range(n)] for j in range(n)]

    @property
    def N(self) -> int:
        """Number of inductors."""
        return len(self.matrix)

    windings: Array[Winding] = Array(Winding(), "N")

    def equations(self) -> Equations:
        yield from super().equations()
        for winding, row in zip(self.windings, self.matrix, strict=True):
            voltages = [self.henry * value * der(other.i) for value, other in zip(row, self.windings, strict=True)]
            yield winding.v == sum(voltages[1:], voltages[0])


class RotationalEMF(OnePort):
    """Electric motor or generator, ``v = k w``, torque on the shaft ``k i`` against `support`, or the housing.

    >>> model = assemble("source.p - emf.p", "source.n - emf.n - ground.p", "emf.flange - rotor.flange_a",
    ...                  source=ConstantCurrent(I=-3.0), emf=RotationalEMF(k=2.0), ground=Ground(),
    ...                  rotor=rotational.Inertia(J=4.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["emf.w"], [0.75, 1.5])
    True

    Source: Modelica.Electrical.Analog.Basic.RotationalEMF.
    """

    useSupport: bool = False
    k: Parameter = Parameter(1.0, unit="V*s/rad", doc="transformation coefficient")
    flange: rotational.Flange = rotational.Flange()
    support: rotational.Flange = conditional(rotational.Flange(), "useSupport")
    phi: Variable = Variable(unit="rad", doc="angle of the shaft relative to the support")
    w: Variable = Variable(unit="rad/s", doc="angular velocity of the shaft relative to the support")
    tau: Variable = Variable(unit="N*m", doc="torque of the flange")
    tauElectrical: Variable = Variable(unit="N*m", doc="electrical torque, k i")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useSupport:
            yield self.phi == self.flange.phi - self.support.phi
            yield self.support.tau == -self.tau
        else:
            yield self.phi == self.flange.phi
        yield self.w == der(self.phi)
        yield self.v == self.k * self.w
        yield self.tau == -self.k * self.i
        yield self.tauElectrical == -self.tau
        yield self.flange.tau == self.tau


class TranslationalEMF(OnePort):
    """Linear motor, ``v = k vel``, force on the flange ``k i`` against `support`, or the housing.

    >>> model = assemble("source.p - emf.p", "source.n - emf.n - ground.p", "emf.flange - mass.flange_a",
    ...                  source=ConstantCurrent(I=-3.0), emf=TranslationalEMF(k=2.0), ground=Ground(),
    ...                  mass=translational.Mass(m=4.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["mass.v"], [0.75, 1.5])
    True

    Source: Modelica.Electrical.Analog.Basic.TranslationalEMF.
    """

    useSupport: bool = False
    k: Parameter = Parameter(1.0, unit="V*s/m", doc="transformation coefficient")
    flange: translational.Flange = translational.Flange()
    support: translational.Flange = conditional(translational.Flange(), "useSupport")
    s: Variable = Variable(unit="m", doc="position of the flange relative to the support")
    vel: Variable = Variable(unit="m/s", doc="velocity of the flange relative to the support")
    f: Variable = Variable(unit="N", doc="force of the flange")
    fElectrical: Variable = Variable(unit="N", doc="electrical force, k i")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useSupport:
            yield self.s == self.flange.s - self.support.s
            yield self.support.f == -self.f
        else:
            yield self.s == self.flange.s
        yield self.vel == der(self.s)
        yield self.v == self.k * self.vel
        yield self.f == -self.k * self.i
        yield self.fElectrical == -self.f
        yield self.flange.f == self.f
