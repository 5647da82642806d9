"""Electrical components: what their examples do not show."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.components import blocks, electrical, thermal
from acausal.components.examples import assemble


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
