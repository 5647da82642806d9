"""Events of exported units: the same as those of `simulate`, in both interfaces and with an importer's event mode."""

from __future__ import annotations

from collections.abc import Iterator
from ctypes import POINTER, byref, c_bool, c_double, c_int
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac

from .export_models import (
    Ball,
    Breaks,
    BreaksUnseen,
    Dosed,
    Ends,
    Latch,
    Pulsed,
    Rectifier,
    Rounded,
    Sampled,
    StruckTwice,
    Thermostat,
    Ticking,
    Wall,
)
from .export_unit import DISCARD, ERROR, OK, WARNING, Instance, Unit, exported

BOTH = pytest.mark.parametrize("version", ("2.0", "3.0"))
RUNS = {Ball: 1.5, Thermostat: 15.0, Sampled: 2.0, Ticking: 2.0, Rectifier: 3.0, Wall: 2.0, Rounded: 3.0,
        Dosed: 2.0, Latch: 4.0, Pulsed: 2.0, StruckTwice: 1.5}  # fmt: skip


def _cases() -> Iterator[Any]:
    """Every model in 3.0, two of them by default in 2.0, which has no event mode in co-simulation."""
    for model in RUNS:
        for kind in ("ModelExchange", "CoSimulation", "event mode"):
            yield pytest.param(model, kind, "3.0")
            if kind != "event mode":
                marks = () if model in (Ball, Thermostat) else (pytest.mark.slow,)
                yield pytest.param(model, kind, "2.0", marks=marks)


@cache
def system(model: Any) -> Any:
    return ac.compile(model())


def archive(unit: Unit) -> str:
    return str(unit.folder.parent / f"{unit.identifier}.fmu")


@BOTH
@pytest.mark.parametrize("model", [Thermostat, Ball])
def test_fmpy_has_no_complaint(model, version):
    from fmpy.validation import validate_fmu

    assert validate_fmu(archive(exported(model, version))) == []


def test_discrete_variables_and_indicators_in_the_description():
    three, two = exported(Thermostat, "3.0"), exported(Thermostat, "2.0")
    for unit in (three, two):
        on = next(v for v in unit.root.iterfind("ModelVariables/*") if v.attrib["name"] == "on")
        assert on.attrib["variability"] == "discrete"
    assert two.root.attrib["numberOfEventIndicators"] == "3"
    rows = three.root.findall("ModelStructure/EventIndicator")
    names = {r: n for n, r in reversed(three.reference.items())}
    assert [names[int(r.attrib["valueReference"])] for r in rows] == [f"_event_indicators[{k}]" for k in range(3)]
    assert {names[int(k)] for r in rows for k in r.attrib["dependencies"].split()} == {"T"}
    described = [v.attrib["description"] for v in three.root.find("ModelVariables") if v.attrib["name"].startswith("_")]
    assert "event: T > high" in described


@pytest.mark.parametrize(("model", "kind", "version"), list(_cases()))
def test_fmpy_agrees_with_simulate(model, kind, version):
    from fmpy import simulate_fmu

    s, end = system(model), RUNS[model]
    names = [n for n in (*s.states, *s.observed) if not n.startswith("der")]
    options = {"use_event_mode": kind == "event mode", "early_return_allowed": kind == "event mode"}
    run = simulate_fmu(
        archive(exported(model, version)), fmi_type=kind if kind != "event mode" else "CoSimulation", stop_time=end,
        output_interval=0.05, relative_tolerance=1e-10, output=names, solver="CVode", record_events=False, **options,
    )  # fmt: skip
    times, last = np.unique(run["time"][::-1], return_index=True)
    rows = run[::-1][last]
    solution = s.simulate(end, saveat=times, rtol=1e-10)
    for n in names:
        near = np.abs(times[:, None] - [e.t for e in solution.events]).min(axis=1, initial=1.0) < 1e-6
        wrong = np.abs(rows[n] - solution[n])[~near].max() / (np.ptp(solution[n]) or 1.0)
        assert wrong <= 1e-6, n


@BOTH
@pytest.mark.parametrize("y", [-1.0, 1.0])
def test_start_values_choose_between_modes(version, y):
    one = exported(Latch, version).instance("me")
    assert one.set(y0=y) == OK
    one.initialize()
    assert one.get("y")[0] == y == system(Latch).simulate(0.1, parameters={"y0": y})["y"][0]
    one.free()


@BOTH
def test_model_exchange_by_hand(version):
    """The event is where the indicator changes sign; the iteration changes the state and tells so."""
    one = exported(Ball, version).instance("me").initialize()
    indicator = np.zeros(1)
    place = indicator.ctypes.data_as(POINTER(c_double))
    assert one.set(h=1e-6, v=-2.0) == OK
    assert one.call("GetEventIndicators", place, 1) == OK and indicator[0] < 0
    assert one.set(h=-1e-6) == OK
    assert one.call("GetEventIndicators", place, 1) == OK and indicator[0] > 0
    assert one.get("bounces")[0] == 0.0
    assert one.call("EnterEventMode") == OK
    assert one.update() and not one.update()
    assert one.get("bounces", "v") == pytest.approx([1.0, 1.4])
    one.free()


@BOTH
def test_next_sample_is_told(version):
    one = exported(Sampled, version).instance("me")
    one.enter()
    assert one.call("ExitInitializationMode") == OK
    assert one.get("u")[0] == -2.0  # sampled at the start

    def update() -> tuple[bool, float]:
        if version == "2.0":
            info = (c_int * 8)()
            assert one.call("NewDiscreteStates", info) == OK
            return bool(info[4]), np.frombuffer(info, np.float64)[3]
        flags, time = [c_bool() for _ in range(5)], c_double()
        assert one.call("UpdateDiscreteStates", *(byref(b) for b in flags), byref(time)) == OK
        return flags[4].value, time.value

    assert update() == (True, 0.25)
    assert one.call("EnterContinuousTimeMode") == OK and one.call("SetTime", 0.25) == OK and one.set(x=0.5) == OK
    assert one.call("EnterEventMode") == OK
    assert update() == (True, 0.5) and one.get("u")[0] == -1.0
    assert update() == (True, 0.5) and one.get("u")[0] == -1.0
    one.free()


@BOTH
def test_inputs_and_parameters_switch_conditions(version):
    one = exported(Thermostat, version).instance().initialize()
    assert one.get("on")[0] == 1.0
    assert one.set(high=14.0) == OK
    assert one.step(0.0, 0.01) == OK
    assert one.get("on")[0] == 0.0
    saved = one.save()
    assert one.set(high=40.0) == OK  # below `low`, but the heater is switched on at the moment T falls only
    assert one.step(0.01, 0.01) == OK
    assert one.get("on")[0] == 0.0
    assert one.load(saved) == OK and one.get("high")[0] == 14.0
    one.drop(saved)
    one.free()


@BOTH
def test_a_saved_state_holds_the_modes(version):
    one = exported(Ball, version).instance().initialize()
    other = exported(Ball, version).instance().initialize()
    for k in range(60):
        assert one.step(0.01 * k, 0.01) == OK
    status, state = other.deserialize(one.serialize(one.save()))
    assert status == OK and other.load(state) == OK
    for k in range(60, 120):
        assert one.step(0.01 * k, 0.01) == other.step(0.01 * k, 0.01) == OK
    assert (one.get("h", "v", "bounces") == other.get("h", "v", "bounces")).all()
    assert one.get("bounces")[0] > 1
    for f in (one, other):
        f.free()


def early(one: Instance, t: float, h: float) -> tuple[int, tuple[bool, ...], float]:
    """A step of FMI 3.0: status, (event, terminate, early return), time reached."""
    flags, last = [c_bool() for _ in range(3)], c_double()
    status = one.call("DoStep", t, h, True, *(byref(b) for b in flags), byref(last))
    return status, tuple(b.value for b in flags), last.value


def fmi3(model: Any, event_mode: bool, early_return: bool) -> Instance:
    unit = exported(model, "3.0")
    one = unit.instance("cs", flags=(event_mode, early_return))
    assert one.enter(tolerance=1e-8) == OK and one.call("ExitInitializationMode") == OK
    return one


def test_early_return():
    hit = float(np.sqrt(2 / 9.81))
    one = fmi3(Ball, event_mode=False, early_return=True)
    status, flags, last = early(one, 0.0, 1.0)
    assert status == OK and flags == (False, False, True) and last == pytest.approx(hit, rel=1e-7)
    assert one.get("bounces", "v") == pytest.approx([1.0, 0.7 * 9.81 * hit], rel=1e-6)
    end = last + 0.1
    while last < end:  # the ball is above the ground again: the condition switches back
        status, flags, last = early(one, last, end - last)
        assert status == OK
    assert one.get("bounces")[0] == 1.0
    one.free()


def test_event_mode_in_co_simulation():
    one = fmi3(Ball, event_mode=True, early_return=True)
    assert early(one, 0.0, 1.0)[0] == ERROR and "not allowed in this state (event mode)" in one.messages[-1][1]
    assert not one.update() and one.call("EnterStepMode") == OK
    status, flags, last = early(one, 0.0, 1.0)
    assert status == OK and flags == (True, False, True)
    assert one.get("bounces")[0] == 0.0 and one.get("v")[0] < 0
    assert one.call("EnterEventMode") == OK
    assert one.update()
    assert one.get("bounces")[0] == 1.0 and one.get("v")[0] > 0
    assert one.call("EnterStepMode") == OK and early(one, last, 0.1)[0] == OK
    one.free()
    one = fmi3(Ball, event_mode=False, early_return=False)
    assert one.call("EnterEventMode") == ERROR
    one.free()


@BOTH
def test_the_model_ends_the_simulation(version):
    one = exported(Ends, version).instance().initialize()
    assert one.step(0.0, 0.6) == OK
    assert (WARNING, "at t = 0.5 s: Ends: x is large") in one.messages
    assert one.get("time")[0] == 0.6
    if version == "2.0":
        ended = c_int()
        assert one.step(0.6, 0.6) == DISCARD
        assert one.call("GetBooleanStatus", c_int(3), byref(ended)) == OK and ended.value == 1
    else:
        status, flags, last = early(one, 0.6, 0.6)
        assert status == OK and flags == (False, True, True) and last == pytest.approx(0.8)
    assert one.get("time")[0] == pytest.approx(0.8)
    assert one.step(0.8, 0.1) == ERROR
    assert "the model has ended the simulation at t = 0.8 s" in one.messages[-1][1]
    assert one.call("Terminate") == OK
    assert one.get("last")[0] == pytest.approx(0.8)
    one.free()


@BOTH
def test_a_broken_assertion(version):
    one = exported(Breaks, version).instance().initialize()
    assert one.step(0.0, 0.4) == OK
    assert one.step(0.4, 0.4) == DISCARD
    assert "an assertion does not hold: Breaks: 100 percent is too much" in one.messages[-1][1]
    one.free()


@BOTH
def test_a_broken_assertion_without_an_event(version):
    unit = exported(BreaksUnseen, version)
    assert unit.root.attrib.get("numberOfEventIndicators", "0") == "0"
    one = unit.instance().initialize()
    assert one.step(0.0, 0.4) == OK
    assert one.step(0.4, 0.4) == DISCARD
    assert "an assertion does not hold: BreaksUnseen: this is too much" in one.messages[-1][1]
    one.free()


def test_reinit_of_what_is_no_state(tmp_path):
    from acausal.fmi import ExportError

    class Other(ac.Component):
        x: ac.Variable = ac.Variable(start=1.0, fixed=True, state_select="always")
        y: ac.Variable = ac.Variable()

        def equations(self) -> ac.Equations:
            yield ac.der(self.x) == -self.x
            yield self.y == self.x**3
            yield ac.when(ac.time > 1, ac.reinit(self.y, 8.0))

    try:
        made = ac.compile(Other())
        _ = made.located
    except ac.AcausalError:
        pytest.skip("the language refuses it")
    with pytest.raises(ExportError, match=r"reinit\(y, ...\) sets a variable that is not among the states \(x\)"):
        ac.fmi.export(made, tmp_path / "a.fmu")
