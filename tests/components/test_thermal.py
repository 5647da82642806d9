"""Heat transfer: temperatures in degrees Celsius, and the motor of Modelica's examples in closed form."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from acausal import Component, Equations, Parameter, start
from acausal.components import blocks, thermal
from acausal.components.examples import assemble
from acausal.components.thermal import celsius


def test_a_celsius_signal_does_not_fit_a_kelvin_input() -> None:
    model = assemble(
        "body.port - meter.port", "meter.T - other.T", body=thermal.FixedTemperature(T=300.0),
        meter=celsius.TemperatureSensor(), other=thermal.PrescribedTemperature(),
    )  # fmt: skip
    with pytest.raises(ac.UnitError, match=r"meter\.T.*degC.*other\.T.*K"):
        ac.compile(model)


def test_a_celsius_parameter_does_not_fit_a_kelvin_one() -> None:
    class House(Component):
        T_room: Parameter = Parameter(20.0, unit="degC", doc="of the room")
        room: thermal.FixedTemperature = thermal.FixedTemperature(T=T_room)

        def equations(self) -> Equations:
            yield from super().equations()

    with pytest.raises(ac.UnitError, match=r"(?s)room\.T.*has unit K.*T_room.*add 273\.15"):
        ac.compile(House())


def test_the_older_name_of_the_celsius_sensor() -> None:
    assert thermal.CelsiusTemperatureSensor is celsius.TemperatureSensor


def test_a_sensor_that_holds_no_temperature() -> None:
    model = assemble(
        "hot.port - wall.port_a", "wall.port_b - meter.port_a", "meter.port_b - cold.port",
        hot=celsius.FixedTemperature(T=60.0), wall=thermal.ThermalConductor(G=2.0),
        meter=thermal.ConditionalFixedHeatFlowSensor(), cold=celsius.FixedTemperature(T=10.0),
    )  # fmt: skip
    np.testing.assert_allclose(ac.compile(model).simulate(1.0, saveat=[1.0])["meter.Q_flow"], [100.0])


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_motor(engine: Any) -> None:
    """Thermal.HeatTransfer.Examples.Motor: two masses, linear between the changes of the load."""
    table = ((0.0, 100.0, 500.0), (360.0, 1000.0, 500.0), (600.0, 100.0, 500.0))
    ambient, T_ref, alpha = 293.15, 368.15, 3.03e-3
    model = assemble(
        "lossTable.y[0] - windingLosses.Q_flow", "lossTable.y[1] - coreLosses.Q_flow",
        "convectionConstant.y - convection.Gc",
        "windingLosses.port - winding.port - winding2core.port_a - Twinding.port",
        "coreLosses.port - core.port - winding2core.port_b - convection.solid - Tcore.port",
        "convection.fluid - environment.port",
        lossTable=blocks.CombiTimeTable(table=table, smoothness="ConstantSegments", extrapolation="Periodic"),
        windingLosses=thermal.PrescribedHeatFlow(T_ref=T_ref, alpha=alpha), coreLosses=thermal.PrescribedHeatFlow(),
        winding=thermal.HeatCapacitor(C=2500.0, T=start(ambient, fixed=True)), Twinding=celsius.TemperatureSensor(),
        core=thermal.HeatCapacitor(C=25000.0, T=start(ambient, fixed=True)), Tcore=celsius.TemperatureSensor(),
        winding2core=thermal.ThermalConductor(G=10.0), convectionConstant=blocks.Constant(k=25.0),
        convection=thermal.Convection(), environment=thermal.FixedTemperature(T=ambient),
    )  # fmt: skip
    period, C = 600.0, np.array([2500.0, 25000.0])
    T, wanted = np.array([ambient, ambient]), []
    for begin in np.arange(0.0, 7200.0, period):
        for losses, duration in ((100.0, 360.0), (1000.0, 240.0)):
            flow = np.array([[losses * alpha - 10.0, 10.0], [10.0, -35.0]]) / C[:, None]
            given = np.array([losses * (1 - alpha * T_ref), 500.0 + 25.0 * ambient]) / C
            rest = -np.linalg.solve(flow, given)
            T = rest + expm(flow * duration) @ (T - rest)
            wanted.append((begin + (360.0 if losses == 100.0 else period), *T))
    t, winding, core = np.array(wanted).T
    solution = ac.compile(model).simulate(7200.0, saveat=t, rtol=1e-9, engine=engine)
    np.testing.assert_allclose(solution["Twinding.T"], winding - 273.15, rtol=1e-6)
    np.testing.assert_allclose(solution["Tcore.T"], core - 273.15, rtol=1e-6)
    assert np.max(winding) > 400.0


def test_a_temperature_below_absolute_zero_is_an_error() -> None:
    """Degrees Celsius where kelvin are meant, below the freezing point."""
    with pytest.raises(ac.DeclarationError, match=r"FixedTemperature.T` = -20.0 lies outside its bounds \[0.0, inf\]"):
        thermal.FixedTemperature(T=-20.0)
