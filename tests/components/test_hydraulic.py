"""Hydraulics against closed solutions and conservation of oil and energy."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import cumulative_simpson
from scipy.optimize import brentq

import acausal as ac
from acausal import Array, Component, Equations, SimulationError, connect, inner, start
from acausal.compiler import located_twin
from acausal.components import blocks, hydraulic, rotational, translational
from acausal.components.examples import assemble

OIL = hydraulic.Oil()
RHO, B = 850.0, 1.2e9


def simulate(model: Component, t: np.ndarray, rtol: float = 1e-9) -> ac.Solution:
    return ac.compile(model).simulate(t1=float(t[-1]), saveat=t, rtol=rtol)


def test_hydrostatic_transmission() -> None:
    """Engine, pump, motor, inertia and brake: what the engine gives is lost, stored or braked; the start is exact."""
    model = assemble(
        "engine.flange - meter.flange_a", "meter.flange_b - pump.flange", "pump.port_b - motor.port_a - line.port",
        "motor.port_b - pump.port_a - tank.port", "motor.flange - wheel.flange_a", "wheel.flange_b - brake.flange_a",
        "brake.flange_b - wall.flange", oil=inner(OIL), engine=rotational.ConstantSpeed(w_fixed=100.0),
        meter=rotational.PowerSensor(), tank=hydraulic.Tank(), pump=hydraulic.Pump(V_disp=5e-5, G_leak=2e-11, d=0.01),
        motor=hydraulic.Motor(V_disp=1e-4, G_leak=1e-11, d=0.02),
        line=hydraulic.ControlVolume(p=start(1e5, fixed=True)),
        wheel=rotational.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True)),
        brake=rotational.Damper(d=0.5), wall=rotational.Fixed(),
    )  # fmt: skip
    t = np.linspace(0.0, 40.0, 401)
    solution = simulate(model, t)
    pump, motor, w = 5e-5 / (2 * np.pi), 1e-4 / (2 * np.pi), np.asarray(solution["motor.w"])
    dp = np.asarray(solution["motor.dp"])
    lost = 3e-11 * dp**2 + 0.01 * 100.0**2 + 0.02 * w**2
    stored = 2.0 * w * np.asarray(solution["wheel.a"]) + np.asarray(solution["line.port.q"]) * dp
    assert_allclose(solution["meter.power"], lost + stored + 0.5 * w**2, rtol=1e-6)
    # at rest: pump w_p - G dp = motor w, motor dp = (0.5 + 0.02) w
    steady = pump * 100.0 / (motor + 3e-11 * 0.52 / motor)
    assert_allclose(w[-1], steady, rtol=1e-6)


@pytest.mark.parametrize("n", [1.0, 1.4])
def test_accumulator_takes_the_oil_that_flows_in(n: float) -> None:
    """From below the precharge pressure, where the oil of the dead volume alone gives way, to far above it."""
    model = assemble(
        "flow.y - pump.u", "tank.port - pump.port_a", "pump.port_b - store.port", oil=inner(OIL), tank=hydraulic.Tank(),
        flow=blocks.Sine(amplitude=3e-3, f=0.5), pump=hydraulic.FlowSource(),
        store=hydraulic.Accumulator(V0=4e-3, p_pre=5e6, n=n, V_dead=2e-4, p=start(1e6, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 2.0, 201)
    solution = simulate(model, t)
    p = np.asarray(solution["store.p"])
    gas = np.where(p > 5e6, 4e-3 * (5e6 / np.maximum(p, 5e6)) ** (1 / n), 4e-3)
    taken = 3e-3 / np.pi * (1 - np.cos(np.pi * t))
    assert_allclose(solution["store.V_gas"], gas, rtol=1e-9)
    assert_allclose(4e-3 - gas + 2e-4 / B * (p - 1e6), taken, atol=1e-9)
    assert p.max() > 8e6
    assert_allclose(p[-1], 1e6, rtol=1e-3)  # 1e6 Pa are less than a ten-thousandth of the oil that went in and out


def test_relief_valve_holds_the_pressure_of_a_fixed_pump() -> None:
    model = assemble(
        "tank.port - pump.port_a - relief.port_b", "pump.port_b - relief.port_a - volume.port", oil=inner(OIL),
        tank=hydraulic.Tank(p=1e5), pump=hydraulic.FixedPump(V_disp=1e-4, omega=20.0),
        relief=hydraulic.ReliefValve(p_set=20e6, dp_open=1e6, A_full=5e-5, A_leak=0.0),
        volume=hydraulic.ControlVolume(V=1e-3, p=start(1e5, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 0.1, 101)
    solution = simulate(model, t)
    closed = solution.t < 0.008
    assert_allclose(solution["volume.p"][closed], 1e5 + B / 1e-3 * 2e-3 * t[closed], rtol=1e-7)

    def excess(dp: float) -> float:
        return 0.65 * 5e-5 * (dp - 20e6) / 1e6 * np.sqrt(2 / RHO) * dp / (dp**2 + 1e8) ** 0.25 - 2e-3

    assert_allclose(solution["relief.dp"][-1], brentq(excess, 20e6, 21e6), rtol=1e-8)


def test_piston_pump_of_check_valves() -> None:
    """A flow to and fro between two check valves: all of it comes out on one side, and no oil is lost."""
    model = assemble(
        "wave.y - piston.u", "crank.port - piston.port_a",
        "piston.port_b - chamber.port - suction.port_b - delivery.port_a",
        "tank.port - suction.port_a", "delivery.port_b - vessel.port", oil=inner(OIL), crank=hydraulic.Tank(),
        tank=hydraulic.Tank(p=1e5), wave=blocks.Sine(amplitude=1e-4, f=10.0), piston=hydraulic.FlowSource(),
        chamber=hydraulic.ControlVolume(V=1e-5, p=start(1e5, fixed=True)),
        vessel=hydraulic.ControlVolume(V=0.1, p=start(1e5, fixed=True)),
        suction=hydraulic.CheckValve(A_leak=0.0), delivery=hydraulic.CheckValve(A_leak=0.0),
    )  # fmt: skip
    t = np.linspace(0.0, 1.0, 4001)
    solution = simulate(model, t)
    for valve in ("suction", "delivery"):
        flow = np.asarray(solution[f"{valve}.q"])
        assert flow.min() >= 0.0
        assert flow.max() > 0.9e-4
    sucked = cumulative_simpson(np.asarray(solution["suction.q"]), x=t)[-1]
    stored = 0.1 / B * (solution["vessel.p"][-1] - 1e5) + 1e-5 / B * (solution["chamber.p"][-1] - 1e5)
    assert_allclose(stored, sucked, rtol=2e-3)
    assert_allclose(sucked, 10 * 1e-4 / (np.pi * 10.0), rtol=2e-2)  # but for what the chamber's oil gives way


@pytest.mark.parametrize(("pilot", "open_part"), [(1e5, 0.0), (3.2e6, 0.0), (3.4e6, 0.5), (5e6, 1.0)])
def test_load_holding_valve(pilot: float, open_part: float) -> None:
    """It opens where three times the pilot pressure over that at a is more than that at b over that at a."""
    model = assemble(
        "load.port - valve.port_b", "tank.port - valve.port_a", "pilot.port - valve.port_x", oil=inner(OIL),
        load=hydraulic.Tank(p=9.9e6 - 2e5), tank=hydraulic.Tank(p=0.0), pilot=hydraulic.Tank(p=pilot),
        valve=hydraulic.PilotOperatedCheckValve(ratio=3.0, p_crack=0.0, dp_open=1e6, A_leak=0.0),
    )  # fmt: skip
    solution = simulate(model, np.array([0.0, 1.0]))
    area = 1e-4 * open_part
    assert_allclose(solution["valve.q"], -0.65 * area * np.sqrt(2 * 9.7e6 / RHO), rtol=1e-5)


class LongPipe(Component):
    """A vessel, a pipe of `n` pieces, and a valve that closes at once: the flow stops (Joukowsky 1898)."""

    n: int = 60
    oil: hydraulic.Oil = inner(hydraulic.Oil(nu=1e-9))
    vessel: hydraulic.Tank = hydraulic.Tank(p=5e6)
    pieces: Array[hydraulic.Pipe] = Array(
        hydraulic.Pipe(
            l=100.0 / 60, d=0.05, friction=hydraulic.LaminarFriction(), q=start(2e-3, fixed=True),
            p_b=start(5e6, fixed=True),
        ),
        "n",
    )  # fmt: skip

    def equations(self) -> Equations:
        yield connect(self.vessel.port, self.pieces[0].port_a)
        yield connect(self.pieces[:-1].port_b, self.pieces[1:].port_a)


def test_water_hammer() -> None:
    """The pressure rises by rho a w, with the speed of sound a = sqrt(B/rho), until the wave is back after 2 l/a."""
    speed = np.sqrt(B / RHO)
    back = 2 * 100.0 / speed
    t = np.linspace(0.0, 2 * back, 401)
    solution = simulate(LongPipe(), t, rtol=1e-7)
    rise = np.asarray(solution["pieces[59].p_b"]) - 5e6
    wanted = RHO * speed * 2e-3 / (np.pi / 4 * 0.05**2)
    high, low = (0.1 * back < t) & (t < 0.9 * back), (1.1 * back < t) & (t < 1.9 * back)
    assert_allclose(rise[high].mean(), wanted, rtol=0.01)  # the pieces ring about it
    assert_allclose(rise[low].mean(), -wanted, rtol=0.02)
    quiet = t < 0.4 * back
    assert np.abs(np.asarray(solution["pieces[0].q"])[quiet] - 2e-3).max() < 1e-4


def test_shuttle_and_reducing_valve_hand_over() -> None:
    """The higher of two pressures that cross goes on, but no higher than the reducing valve lets it."""
    model = assemble(
        "rise.y - one.p", "one.port - shuttle.port_a", "two.port - shuttle.port_b",
        "shuttle.port_c - reducer.port_a - line.port", "reducer.port_b - load.port_a - reduced.port",
        "load.port_b - tank.port", oil=inner(OIL), one=hydraulic.PressureSource(),
        rise=blocks.Slope(offset=1e6, slope=8e6), two=hydraulic.Tank(p=3e6), shuttle=hydraulic.ShuttleValve(),
        reducer=hydraulic.PressureReducingValve(p_set=5e6, dp_open=1e5), tank=hydraulic.Tank(p=0.0),
        load=hydraulic.LaminarRestriction(G=1e-11), line=hydraulic.ControlVolume(V=1e-4, p=start(3e6, fixed=True)),
        reduced=hydraulic.ControlVolume(V=1e-5, p=start(3e6, fixed=True)),
    )  # fmt: skip
    t = np.linspace(0.0, 1.0, 21)
    solution = simulate(model, t)
    higher = np.maximum(1e6 + 8e6 * t, 3e6)
    assert_allclose(solution["shuttle.port_c.p"], higher, rtol=5e-3)
    assert_allclose(solution["reducer.port_b.p"], np.minimum(higher, 5.1e6), rtol=5e-3)


class Pulled(Component):
    """A load pulls the piston away from a port that is closed."""

    oil: hydraulic.Oil = inner(hydraulic.Oil())
    tank: hydraulic.Tank = hydraulic.Tank()
    cylinder: hydraulic.ExtendedCylinder = hydraulic.ExtendedCylinder(bore=0.1, rod=0.05, x=start(0.1, fixed=True))
    load: translational.ConstantForce = translational.ConstantForce(f_constant=5e5)

    def equations(self) -> Equations:
        yield connect(self.cylinder.port_b, self.tank.port)
        yield connect(self.cylinder.flange, self.load.flange)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_oil_that_is_pulled_below_a_vacuum_is_told_of(engine: Any) -> None:
    system = ac.compile(Pulled())
    with pytest.warns(UserWarning, match=r"assertion of cylinder.chamber_a .* below a vacuum") as caught:
        system.simulate(1.0, engine=engine)
    assert len(caught) == 1
    assert "cylinder: hydraulic.ExtendedCylinder" in str(caught[0].message)  # the user's line
    system.simulate(1.0, parameters={"load.f_constant": 100.0}, engine=engine)


def test_a_piston_beyond_the_end_of_its_chamber_is_an_error() -> None:
    system = ac.compile(Pulled())
    with pytest.raises(SimulationError, match=r"assertion of cylinder.chamber_b .* piston is beyond the end"):
        system.simulate(1.0, initial={"cylinder.x": 5.0})


def test_assertions_at_the_points_of_the_result_leave_events_to_the_compiled_run() -> None:
    """So the bumpers of a cylinder cost nothing more for them."""
    hybrid = located_twin(ac.compile(Pulled())).hybrid
    assert hybrid is not None
    assert hybrid.only_modes
