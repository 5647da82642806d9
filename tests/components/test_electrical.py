"""Electrical components: what their examples do not show."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Equations, Parameter, Variable, start, where
from acausal.components import blocks, electrical, thermal
from acausal.components.electrical import transistors
from acausal.components.examples import assemble

from . import msl_gates


@pytest.mark.parametrize(("where", "begins"), [("Linear", 0.0), ("UpperLimit", 15.0), ("LowerLimit", -15.0)])
def test_start_of_an_amplifier(where: str, begins: float) -> None:
    model = assemble(
        "source.p - amp.in_p", "amp.in_n - amp.out - load.p", "source.n - load.n - ground.p",
        source=electrical.ConstantVoltage(V=0.0), load=electrical.Resistor(R=1e3), ground=electrical.Ground(),
        amp=electrical.OpAmpLimited(useFirstOrder=True, Tau=1.0, initOpAmp=where),
    )  # fmt: skip
    solution = ac.compile(model).simulate(0.01, saveat=[0.0, 0.01])
    np.testing.assert_allclose(solution["load.v"], [begins, 0.0], atol=1e-5)


def test_unknown_start_of_an_amplifier() -> None:
    with pytest.raises(ac.DeclarationError, match=r"initOpAmp='Top'.*Linear, UpperLimit, LowerLimit"):
        ac.compile(electrical.OpAmpLimited(initOpAmp="Top"))


def test_homotopy_of_an_amplifier_is_refused() -> None:
    assert electrical.IdealizedOpAmpLimited(strict=False, homotopyType="NoHomotopy").strict is False
    with pytest.raises(ac.DeclarationError, match=r"homotopyType='UpperLimit'.*a start value beyond a limit"):
        ac.compile(electrical.IdealizedOpAmpLimited(homotopyType="UpperLimit"))


def test_initial_values_of_a_transistor_and_of_variable_storages() -> None:
    """`UIC` begins at `IC`: the collector, a capacitor and an inductor whose values are signals."""
    model = assemble(
        "one.y - capacitor.C - coil.L", "load.n - tr.C", "load.p - supply.p", "capacitor.p - leak.p",
        "coil.p - short.p", "tr.B - tr.E - supply.n - capacitor.n - leak.n - coil.n - short.n - ground.p",
        one=blocks.Constant(k=1.0), tr=electrical.NPN(UIC=True, IC=2.0), load=electrical.Resistor(R=1e3),
        supply=electrical.ConstantVoltage(V=5.0), capacitor=electrical.VariableCapacitor(UIC=True, IC=3.0),
        leak=electrical.Resistor(R=1.0),
        coil=electrical.VariableInductor(UIC=True, IC=4.0), short=electrical.Resistor(R=1.0),
        ground=electrical.Ground(),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[0.0, 1.0])
    np.testing.assert_allclose(solution["tr.vcs"], [2.0, 5.0], rtol=1e-6)
    np.testing.assert_allclose(solution["capacitor.v"], [3.0, 3.0 * np.exp(-1.0)], rtol=1e-5)
    np.testing.assert_allclose(solution["coil.i"], [4.0, 4.0 * np.exp(-1.0)], rtol=1e-5)


def test_diode_with_series_resistance_follows_its_heat_port() -> None:
    model = assemble(
        "source.p - diode.p", "source.n - diode.n - ground.p", "diode.heatPort - hot.port", ground=electrical.Ground(),
        source=electrical.ConstantVoltage(V=0.4), diode=electrical.Diode2(useHeatPort=True, Rs=1e-9, Gp=0.0),
        hot=thermal.celsius.FixedTemperature(T=100.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[1.0])
    wanted = 1e-13 * np.expm1(0.4 / (1.380649e-23 * 373.15 / 1.602176634e-19))
    np.testing.assert_allclose(solution["diode.i"], wanted, rtol=1e-6)
    np.testing.assert_allclose(solution["hot.port.Q_flow"], 0.4 * wanted, rtol=1e-6)


def test_pulses_that_end() -> None:
    model = assemble(
        "source.p - load.p", "source.n - load.n - ground.p", load=electrical.Resistor(R=2.0),
        source=electrical.PulseVoltage(V=4.0, period=0.2, nperiod=2), ground=electrical.Ground(),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[0.05, 0.15, 0.25, 0.45, 1.0])
    np.testing.assert_allclose(solution["load.i"], [2.0, 0.0, 2.0, 0.0, 0.0])


def test_heat_port_of_a_transistor_that_depends_on_temperature() -> None:
    """`useTemperatureDependency` alone gives the port; the heat through it is the power lost."""
    model = assemble(
        "drive.p - mos.G", "supply.p - mos.D", "drive.n - supply.n - mos.S - mos.B - ground.p",
        "mos.heatPort - hot.port", drive=electrical.ConstantVoltage(V=3.0), supply=electrical.ConstantVoltage(V=5.0),
        mos=electrical.NMOS(useTemperatureDependency=True), ground=electrical.Ground(),
        hot=thermal.FixedTemperature(T=350.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1.0, saveat=[1.0])
    np.testing.assert_allclose(solution["hot.port.Q_flow"], solution["mos.D.i"] * 5.0, rtol=1e-8)


def test_a_word_of_bits_passes_at_once_from_converter_to_converter() -> None:
    """Electrical.Analog.Examples.AD_DA_conversion: what is converted back is what was sampled at the same trigger."""
    model = assemble(
        "source.p - adc.p - load.p", "source.n - adc.n - dac.n - ground.p", "dac.p - load.n",
        "clock.y - adc.trig - dac.trig", *(f"adc.y[{k}] - dac.x[{k}]" for k in range(7)),
        source=electrical.SineVoltage(V=5.0, f=10.0, offset=5.0), clock=blocks.BooleanPulse(width=1.0, period=1e-3),
        adc=electrical.AD_Converter(N=7), dac=electrical.DA_Converter(N=7), load=electrical.Resistor(R=1.0),
        ground=electrical.Ground(),
    )  # fmt: skip
    sampled = np.arange(1, 100) * 1e-3
    solution = ac.compile(model).simulate(0.1, saveat=sampled + 0.5e-3, rtol=1e-9)
    number = np.floor((5.0 + 5.0 * np.sin(2 * np.pi * 10.0 * sampled)) / 10.0 * 127 + 0.5)
    np.testing.assert_allclose(solution["adc.z"], number)
    np.testing.assert_allclose(solution["dac.vout"], number * 10.0 / 127)
    bits = [np.asarray(solution[f"adc.y[{k + 1}]"]) for k in range(7)]
    np.testing.assert_allclose(sum(2**k * bit for k, bit in enumerate(bits)), number)


def test_matrix_and_triangle_of_coupled_inductors() -> None:
    """As in Modelica, L may be the upper triangle, row by row."""
    matrix = electrical.M_Transformer(L=((1.0, 0.1, 0.2), (0.1, 2.0, 0.3), (0.2, 0.3, 3.0)))
    triangle = electrical.M_Transformer(L=(1.0, 0.1, 0.2, 2.0, 0.3, 3.0))
    assert list(map(tuple, triangle.matrix)) == matrix.matrix and triangle.N == 3
    with pytest.raises(ac.DeclarationError, match=r"symmetric matrix, not"):
        ac.compile(electrical.M_Transformer(L=((1.0, 0.1), (0.2, 2.0))))
    with pytest.raises(ac.DeclarationError, match=r"upper triangle, of 1, 3, 6, 10"):
        ac.compile(electrical.M_Transformer(L=(1.0, 0.1)))


def test_present_inductance_and_flux() -> None:
    model = assemble(
        "ramp.p - coil.p - trafo.p1", "ramp.n - coil.n - trafo.n1 - trafo.n2 - load.n - ground.p", "trafo.p2 - load.p",
        ramp=electrical.ConstantVoltage(V=2.0), coil=electrical.SaturatingInductor(), ground=electrical.Ground(),
        trafo=electrical.IdealTransformer(n=2.0, considerMagnetization=True, Lm1=4.0), load=electrical.Resistor(R=1.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(2.0, saveat=[0.0, 1e-6, 1.0, 2.0], rtol=1e-10)
    i, psi = np.asarray(solution["coil.i"]), np.asarray(solution["coil.Psi"])
    np.testing.assert_allclose(solution["coil.Lact"], [2.0, *(psi[1:] / i[1:])], rtol=1e-7)
    np.testing.assert_allclose(solution["trafo.psim1"], 2.0 * np.asarray(solution.t), rtol=1e-7, atol=1e-12)


class ChuaResistor(electrical.OnePort):
    """Electrical.Analog.Examples.Utilities.NonlinearResistor."""

    Ga: Parameter = Parameter(-0.757576, unit="S", doc="conductance in the inner range")
    Gb: Parameter = Parameter(-0.409091, unit="S", doc="conductance in the outer ranges")
    Ve: Parameter = Parameter(1.0, unit="V", doc="limit of the inner range")

    def equations(self) -> Equations:
        yield from super().equations()
        bend = (self.Ga - self.Gb) * self.Ve
        outside = where(self.v > self.Ve, self.Gb * self.v + bend, self.Ga * self.v)
        yield self.i == where(self.v < -self.Ve, self.Gb * self.v - bend, outside)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_chua_circuit(engine: Any) -> None:
    """Electrical.Analog.Examples.ChuaCircuit for as long as its chaos lets two solvers agree."""
    model = assemble(
        "L.p - C2.p - G.p", "G.n - C1.p - Nr.p", "L.n - Ro.p", "Ro.n - C2.n - C1.n - Nr.n - Gnd.p",
        L=electrical.Inductor(L=18.0, i=start(0.0, fixed=True)), Ro=electrical.Resistor(R=12.5e-3),
        G=electrical.Conductor(G=0.565), C1=electrical.Capacitor(C=10.0, v=start(4.0, fixed=True)),
        C2=electrical.Capacitor(C=100.0, v=start(0.0, fixed=True)), Nr=ChuaResistor(), Gnd=electrical.Ground(),
    )  # fmt: skip

    def slopes(_t: float, y: np.ndarray) -> list[float]:
        i, v1, v2 = y
        nonlinear = -0.409091 * v1 + (-0.757576 + 0.409091) / 2 * (abs(v1 + 1) - abs(v1 - 1))
        return [(v2 - 12.5e-3 * i) / 18.0, (0.565 * (v2 - v1) - nonlinear) / 10.0, (0.565 * (v1 - v2) - i) / 100.0]

    t = np.linspace(0.0, 2000.0, 41)
    wanted = solve_ivp(slopes, (0.0, 2000.0), [0.0, 4.0, 0.0], t_eval=t, rtol=1e-11, atol=1e-12, max_step=1.0).y
    solution = ac.compile(model).simulate(2000.0, saveat=t, rtol=1e-10, engine=engine)
    for signal, values in zip(("L.i", "C1.v", "C2.v"), wanted, strict=True):
        np.testing.assert_allclose(solution[signal], values, atol=1e-4)


def test_compare_transformers() -> None:
    """Electrical.Analog.Examples.CompareTransformers: both are the linear circuits that their equations say."""
    w, n, V = 2 * np.pi * 10.0, 2.0, 0.1
    L1s, Lm, L2s, R1, R2, load = 0.05 / w, 10.0 / w, 0.05 / w / n**2, 0.01, 0.01 / n**2, 1 / n**2
    M = Lm / n
    L1, L2 = L1s + M * n, L2s + M / n
    wave = electrical.SineVoltage(V=V, phase=np.pi / 2, f=10.0, offset=V)
    model = assemble(
        "sineVoltage1.p - resistor11.p", "resistor11.n - basic.p1", "basic.p2 - resistor12.p", "resistor12.n - load1.p",
        "sineVoltage1.n - basic.n1 - basic.n2 - load1.n - ground1.p", "sineVoltage2.p - resistor21.p",
        "resistor21.n - inductor21.p", "inductor21.n - ideal.p1", "ideal.p2 - inductor22.p",
        "inductor22.n - resistor22.p", "resistor22.n - load2.p",
        "sineVoltage2.n - ideal.n1 - ideal.n2 - load2.n - ground2.p", sineVoltage1=wave, sineVoltage2=wave,
        basic=electrical.Transformer(L1=L1, L2=L2, M=M, i1=start(0.0, fixed=True), i2=start(0.0, fixed=True)),
        ideal=electrical.IdealTransformer(n=n, Lm1=Lm), inductor21=electrical.Inductor(L=L1s),
        inductor22=electrical.Inductor(L=L2s, i=start(0.0, fixed=True)), resistor11=electrical.Resistor(R=R1),
        resistor12=electrical.Resistor(R=R2), resistor21=electrical.Resistor(R=R1),
        resistor22=electrical.Resistor(R=R2), load1=electrical.Resistor(R=load), load2=electrical.Resistor(R=load),
        ground1=electrical.Ground(), ground2=electrical.Ground(),
    )  # fmt: skip
    inverse = np.linalg.inv([[L1, M], [M, L2]])

    def slopes(t: float, y: np.ndarray) -> list[float]:
        """Currents i1, i2 of the basic transformer, and that of the secondary side of the ideal one."""
        v = V * np.cos(w * t) + V
        basic = inverse @ [v - R1 * y[0], -(R2 + load) * y[1]]
        ideal = (v / n - (R1 / n**2 + R2 + load) * y[2]) / (L1s / n**2 + L2s)
        return [*basic, ideal]

    t = np.linspace(0.0, 0.5, 51)
    wanted = solve_ivp(slopes, (0.0, 0.5), [0.0, 0.0, 0.0], t_eval=t, rtol=1e-10, atol=1e-12, method="LSODA").y
    solution = ac.compile(model).simulate(0.5, saveat=t, rtol=1e-9)
    for signal, values in zip(("basic.i1", "basic.i2", "inductor22.i"), wanted, strict=True):
        np.testing.assert_allclose(solution[signal], values, rtol=1e-6, atol=1e-7)


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_an_ideal_diode_conducts_what_its_circuit_gives_it(engine: Any) -> None:
    """Its curve parameter is iterated: as a difference of potentials over 1e-5 ohm, 2 uA would be lost in rounding."""
    fired = electrical.Thyristor(vControl=start(5.0, fixed=True))
    model = assemble(
        "source.p - load.p", "load.n - triac.p", "source.n - triac.n - ground.p - gate.p", "gate.n - triac.g",
        source=electrical.ConstantVoltage(V=50.0), load=electrical.Resistor(R=10.0), ground=electrical.Ground(),
        triac=electrical.SimpleTriac(thyristor1=fired), gate=electrical.ConstantCurrent(I=0.0),
    )  # fmt: skip
    solution = ac.compile(model).simulate(1e-4, saveat=[0.0, 1e-4], engine=engine)
    np.testing.assert_allclose(solution["triac.idealDiode1.s"], solution["triac.idealDiode1.i"], rtol=1e-9)
    np.testing.assert_allclose(solution["triac.idealDiode1.i"], 1.986469e-6, rtol=1e-5)


@pytest.mark.parametrize("approximation", ["Heidler", "DoubleExp"])
def test_times_of_a_lightning_impulse(approximation: str) -> None:
    """80 % of the height are passed in 0.8 T1; half of it is left at T2 after the virtual origin."""
    T1, T2 = 1.2e-6, 50e-6
    t = np.linspace(0.0, 80e-6, 8001)
    impulse = electrical.LightningImpulse(approximation=approximation, amplitude=3.0, T1=T1, T2=T2)
    share = np.asarray(ac.compile(impulse).simulate(t[-1], saveat=t, rtol=1e-9)["y"]) / 3.0
    top = int(np.argmax(share))
    tenth, most = np.interp([0.1, 0.9], share[:top], t[:top])
    half = np.interp(0.5, share[top:][::-1], t[top:][::-1])
    np.testing.assert_allclose([share[top], most - tenth, half - (tenth - 0.1 * T1)], [1.0, 0.8 * T1, T2], rtol=1e-3)


def test_unknown_approximation_of_a_lightning_impulse() -> None:
    with pytest.raises(ac.DeclarationError, match=r"approximation='Bolt' is not one of DoubleExp, Heidler"):
        ac.compile(electrical.LightningImpulse(approximation="Bolt"))


def test_regions_of_a_power_supply() -> None:
    """Constant voltage, power and current, on the lines and the hyperbola that the parameters give."""
    loads = [10.0, 2.6, 1.0, 0.3]
    found: list[tuple[float, float]] = []
    for R in loads:
        model = assemble(
            "supply.p - load.p", "supply.n - load.n - ground.p", load=electrical.Resistor(R=R),
            supply=electrical.DCPowerSupply(Rcv=0.1, Gcc=0.1), ground=electrical.Ground(),
        )  # fmt: skip
        solution = ac.compile(model).simulate(1.0, saveat=[1.0])
        found.append((float(solution["supply.v"][-1]), -float(solution["supply.i"][-1])))
    for R, (v, i) in zip(loads, found, strict=True):
        assert v == pytest.approx(R * i, rel=1e-9)
        assert min(60.0 - 0.1 * i - v, 50.0 - 0.1 * v - i, 1200.0 - v * i) == pytest.approx(0.0, abs=1e-6)
    assert [v * i == pytest.approx(1200.0) for v, i in found] == [False, True, True, False]


class Reordered(transistors.PartialBipolar):
    """An NPN transistor whose variables are declared in another order."""

    vbc: Variable = Variable(unit="V")
    vbe: Variable = Variable(unit="V")
    ibc: Variable = Variable(unit="A", nominal=1e-3)
    ibe: Variable = Variable(unit="A", nominal=1e-3)
    cbc: Variable = Variable(unit="F", nominal=1e-12)
    cbe: Variable = Variable(unit="F", nominal=1e-12)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.vbc == self.B.v - self.C.v
        yield self.vbe == self.B.v - self.E.v
        collector = transistors.Junction(self.vbc, self.ibc, self.cbc)
        yield from self.junctions(collector, transistors.Junction(self.vbe, self.ibe, self.cbe))


def test_the_order_of_declarations_does_not_decide_how_many_steps_are_taken() -> None:
    """It decides the order of pivots: small ones, of junctions that block, must not spoil the solutions of a step."""
    steps = [
        ac.compile(msl_gates.norgate(kind, 6.0, "V.p - RI.n", "V.n - Gnd.p"))
        .simulate(104.0, rtol=1e-8, saveat=2)
        .stats["steps"]
        for kind in (electrical.NPN, Reordered)
    ]
    assert max(steps) < 1.1 * min(steps) < 5_000
