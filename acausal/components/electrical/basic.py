"""Ground, resistors, capacitors and inductors, of constant and of variable value."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Component, Equations, Input, Parameter, Variable, der, noevent, where

from .interfaces import ConditionalHeatPort, OnePort, Pin


class Ground(Component):
    """Zero potential, ``p.v = 0``.

    >>> model = assemble("ground.p - source.n", ground=Ground(), source=ConstantVoltage(V=5.0))
    >>> run(model)["source.p.v"][-1]
    5.0

    Source: Modelica.Electrical.Analog.Basic.Ground.
    """

    p: Pin = Pin()

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.p.v == 0


class Resistor(ConditionalHeatPort, OnePort):
    """Linear resistor, ``v = R (1 + alpha (T - T_ref)) i``; with `useHeatPort` its loss heats what is connected.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=10.0), resistor=Resistor(R=5.0, alpha=1e-2, T=400.15))
    >>> run(model)["resistor.i"][-1]
    1.0

    Source: Modelica.Electrical.Analog.Basic.Resistor.
    """

    R: Parameter = Parameter(1.0, unit="ohm", doc="resistance at the temperature T_ref")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T: Parameter = Parameter(T_ref, unit="K", doc="temperature of the device without a heat port")

    R_actual: Variable = Variable(unit="ohm", doc="resistance at the temperature of the device")

    def equations(self) -> Equations:
        yield from super().equations()
        resistance = self.R * (1 + self.alpha * (self.temperature - self.T_ref))
        yield self.R_actual == resistance
        yield self.v == resistance * self.i
        yield self.LossPower == self.v * self.i


class Conductor(ConditionalHeatPort, OnePort):
    """Linear conductor, ``i = G v/(1 + alpha (T - T_ref))``; with `useHeatPort` its loss heats what is connected.

    >>> model = assemble("source.p - conductor.p", "source.n - conductor.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=10.0), conductor=Conductor(G=0.2))
    >>> run(model)["conductor.LossPower"][-1]
    20.0

    Source: Modelica.Electrical.Analog.Basic.Conductor.
    """

    G: Parameter = Parameter(1.0, unit="S", doc="conductance at the temperature T_ref")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T: Parameter = Parameter(T_ref, unit="K", doc="temperature of the device without a heat port")
    G_actual: Variable = Variable(unit="S", doc="conductance at the temperature of the device")

    def equations(self) -> Equations:
        yield from super().equations()
        conductance = self.G / (1 + self.alpha * (self.temperature - self.T_ref))
        yield self.G_actual == conductance
        yield self.i == conductance * self.v
        yield self.LossPower == self.v * self.i


class Capacitor(OnePort):
    """Ideal linear capacitor, ``i = C dv/dt``.

    >>> model = assemble("source.p - resistor.p", "resistor.n - capacitor.p", "source.n - capacitor.n - ground.p",
    ...                  source=ConstantVoltage(V=10.0), resistor=Resistor(R=2.0), ground=Ground(),
    ...                  capacitor=Capacitor(C=0.25, v=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["capacitor.v"], 10 * (1 - np.exp([-1.0, -2.0])))
    True

    Source: Modelica.Electrical.Analog.Basic.Capacitor.
    """

    C: Parameter = Parameter(1.0, unit="F", min=0.0, doc="capacitance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.C * der(self.v) == self.i


class Inductor(OnePort):
    """Ideal linear inductor, ``v = L di/dt``.

    >>> model = assemble("source.p - resistor.p", "resistor.n - inductor.p", "source.n - inductor.n - ground.p",
    ...                  source=ConstantVoltage(V=10.0), resistor=Resistor(R=2.0), ground=Ground(),
    ...                  inductor=Inductor(L=4.0, i=start(0.0, fixed=True)))
    >>> close(run(model, at=[0.5, 1.0])["inductor.i"], 5 * (1 - np.exp([-0.25, -0.5])))
    True

    Source: Modelica.Electrical.Analog.Basic.Inductor.
    """

    L: Parameter = Parameter(1.0, unit="H", min=0.0, doc="inductance")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.L * der(self.i) == self.v


class SaturatingInductor(OnePort):
    """Inductor that saturates, ``v = dPsi/dt``, ``Psi = Linf i + (Lzer - Linf) Ipar atan(i/Ipar)``.

    `Ipar` follows from the inductance `Lnom` at the current `Inom`.

    >>> model = assemble("source.p - coil.p", "source.n - coil.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=3.0), coil=SaturatingInductor(Lnom=2.0, Inom=1.0, Lzer=4.0, Linf=1.0))
    >>> coil = run(model, at=[0.0, 0.5, 1.0])
    >>> close(coil["coil.Psi"], [0.0, 1.5, 3.0]) and 3.0 / 2.0 < coil["coil.i"][-1] < 3.0
    True

    Source: Modelica.Electrical.Analog.Basic.SaturatingInductor.
    """

    Inom: Parameter = Parameter(1.0, unit="A", doc="nominal current")
    Lnom: Parameter = Parameter(1.0, unit="H", doc="inductance at the nominal current")
    Lzer: Parameter = Parameter(2 * Lnom, unit="H", doc="inductance near current 0")
    Linf: Parameter = Parameter(Lnom / 2, unit="H", doc="inductance at large currents")
    Psi: Variable = Variable(unit="Wb", start=0.0, doc="flux")
    Lact: Variable = Variable(unit="H", doc="inductance at the present current, Psi/i")
    ratio: Variable = Variable(start=0.3, doc="Inom/Ipar")

    def equations(self) -> Equations:
        yield from super().equations()
        span = self.Lzer - self.Linf
        current = self.Inom * self.ratio
        # (Lnom - Linf)/(Lzer - Linf) = x (pi/2 - atan(x)) with x = Ipar/Inom
        yield (self.Lnom - self.Linf) / span == self.ratio * (PI / 2 - ac.atan(self.ratio))
        yield self.Psi == self.Linf * self.i + span * current * ac.atan(self.i / current)
        yield der(self.Psi) == self.v
        x = self.i / current
        rest = noevent(where(ac.abs(x) < 1e-4, 1 - x**2 / 3, ac.atan(x) / x))  # atan(x)/x is 1 - x^2/3 + x^4/5 - ...
        yield self.Lact == self.Linf + span * rest


class VariableResistor(ConditionalHeatPort, OnePort):
    """Resistor whose resistance is a signal, ``v = R (1 + alpha (T - T_ref)) i``.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - resistor.R",
    ...                  source=ConstantVoltage(V=6.0), resistor=VariableResistor(), ground=Ground(),
    ...                  ramp=blocks.Slope(offset=1.0, slope=2.0))
    >>> run(model, at=[0.0, 0.5, 1.0])["resistor.i"]
    [6.0, 3.0, 2.0]

    Source: Modelica.Electrical.Analog.Basic.VariableResistor.
    """

    R: Input = Input(unit="ohm", doc="resistance at the temperature T_ref")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T: Parameter = Parameter(T_ref, unit="K", doc="temperature of the device without a heat port")
    R_actual: Variable = Variable(unit="ohm", doc="resistance at the temperature of the device")

    def equations(self) -> Equations:
        yield from super().equations()
        resistance = self.R * (1 + self.alpha * (self.temperature - self.T_ref))
        yield self.R_actual == resistance
        yield self.v == resistance * self.i
        yield self.LossPower == self.v * self.i


class VariableConductor(ConditionalHeatPort, OnePort):
    """Conductor whose conductance is a signal, ``i = G v/(1 + alpha (T - T_ref))``.

    >>> model = assemble("source.p - conductor.p", "source.n - conductor.n - ground.p", "ramp.y - conductor.G",
    ...                  source=ConstantVoltage(V=6.0), conductor=VariableConductor(), ground=Ground(),
    ...                  ramp=blocks.Slope(offset=1.0, slope=2.0))
    >>> run(model, at=[0.0, 0.5, 1.0])["conductor.i"]
    [6.0, 12.0, 18.0]

    Source: Modelica.Electrical.Analog.Basic.VariableConductor.
    """

    G: Input = Input(unit="S", doc="conductance at the temperature T_ref")
    T_ref: Parameter = Parameter(300.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T: Parameter = Parameter(T_ref, unit="K", doc="temperature of the device without a heat port")
    G_actual: Variable = Variable(unit="S", doc="conductance at the temperature of the device")

    def equations(self) -> Equations:
        yield from super().equations()
        conductance = self.G / (1 + self.alpha * (self.temperature - self.T_ref))
        yield self.G_actual == conductance
        yield self.i == conductance * self.v
        yield self.LossPower == self.v * self.i


class VariableCapacitor(OnePort):
    """Capacitor whose capacitance is a signal, ``i = dQ/dt``, ``Q = max(C, Cmin) v``.

    >>> model = assemble("charge.p - ground.p - capacitor.n", "charge.n - capacitor.p", "ramp.y - capacitor.C",
    ...                  charge=ConstantCurrent(I=2.0), capacitor=VariableCapacitor(Q=start(0.0, fixed=True)),
    ...                  ground=Ground(), ramp=blocks.Slope(offset=1.0, slope=1.0))
    >>> close(run(model, at=[0.5, 1.0])["capacitor.v"], [1.0 / 1.5, 2.0 / 2.0])
    True

    Source: Modelica.Electrical.Analog.Basic.VariableCapacitor.
    """

    C: Input = Input(unit="F", doc="capacitance")
    UIC: bool = False
    IC: Parameter = Parameter(0.0, unit="V", doc="voltage at the start, with UIC")
    Cmin: Parameter = Parameter(2.220446049250313e-16, unit="F", doc="lower bound of the capacitance")
    Q: Variable = Variable(unit="C", start=0.0, doc="charge")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Q == ac.max(self.C, self.Cmin) * self.v
        yield der(self.Q) == self.i

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.UIC:
            yield self.v == self.IC


class VariableInductor(OnePort):
    """Inductor whose inductance is a signal, ``v = dPsi/dt``, ``Psi = max(L, Lmin) i``.

    >>> model = assemble("source.p - coil.p", "source.n - coil.n - ground.p", "ramp.y - coil.L", ground=Ground(),
    ...                  source=ConstantVoltage(V=6.0), coil=VariableInductor(Psi=start(0.0, fixed=True)),
    ...                  ramp=blocks.Slope(offset=1.0, slope=1.0))
    >>> close(run(model, at=[0.5, 1.0])["coil.i"], [2.0, 3.0])
    True

    Source: Modelica.Electrical.Analog.Basic.VariableInductor.
    """

    L: Input = Input(unit="H", doc="inductance")
    UIC: bool = False
    IC: Parameter = Parameter(0.0, unit="A", doc="current at the start, with UIC")
    Lmin: Parameter = Parameter(2.220446049250313e-16, unit="H", doc="lower bound of the inductance")
    Psi: Variable = Variable(unit="Wb", start=0.0, doc="flux")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Psi == ac.max(self.L, self.Lmin) * self.i
        yield der(self.Psi) == self.v

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.UIC:
            yield self.i == self.IC


class Potentiometer(ConditionalHeatPort):
    """Resistor with a tap, `r` from ``0`` at `pin_n` to ``1`` at `pin_p`, a constant or with `useRinput` a signal.

    ``Rp = R (1 + alpha (T - T_ref)) (1 - r)`` from `pin_p` to the contact, ``Rn`` with ``r`` from there to `pin_n`.

    >>> model = assemble("source.p - pot.pin_p", "source.n - pot.pin_n - ground.p", source=ConstantVoltage(V=10.0),
    ...                  pot=Potentiometer(R=4.0, rConstant=0.25), ground=Ground())
    >>> run(model)["pot.contact.v"][-1]
    2.5

    Source: Modelica.Electrical.Analog.Basic.Potentiometer.
    """

    useRinput: bool = False
    pin_p: Pin = Pin()
    pin_n: Pin = Pin()
    contact: Pin = Pin()
    R: Parameter = Parameter(1.0, unit="ohm", doc="resistance at the temperature T_ref")
    T_ref: Parameter = Parameter(293.15, unit="K", doc="reference temperature")
    alpha: Parameter = Parameter(0.0, unit="1/K", doc="temperature coefficient of the resistance")
    T: Parameter = Parameter(T_ref, unit="K", doc="temperature of the device without a heat port")
    rConstant: Parameter = Parameter(0.5, min=0.0, max=1.0, doc="position of the contact without useRinput")
    r: Input = Input(doc="position of the contact with useRinput")
    Rp: Variable = Variable(unit="ohm", doc="resistance between pin_p and the contact")
    Rn: Variable = Variable(unit="ohm", doc="resistance between the contact and pin_n")

    def equations(self) -> Equations:
        yield from super().equations()
        if not self.useRinput:
            yield self.r == self.rConstant
        resistance = self.R * (1 + self.alpha * (self.temperature - self.T_ref))
        share = ac.clip(self.r, 0.0, 1.0)
        upper, lower = self.pin_p.v - self.contact.v, self.pin_n.v - self.contact.v
        yield self.pin_p.i + self.pin_n.i + self.contact.i == 0
        yield self.Rp == resistance * (1 - share)
        yield self.Rn == resistance * share
        yield upper == self.Rp * self.pin_p.i
        yield lower == self.Rn * self.pin_n.i
        yield self.LossPower == upper * self.pin_p.i + lower * self.pin_n.i
