"""Exported units: the model description, and what two importers make of them."""

from __future__ import annotations

import zipfile
from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
import acausal.fmi

from .export_models import Balanced, Chain, Implicit, Oscillator, Pendulum, Swing, Wall
from .export_unit import OK, Unit, exported

MODELS = (Oscillator, Implicit, Balanced, Pendulum, Chain, Swing)
VERSIONS = ("2.0", "3.0")
BOTH = pytest.mark.parametrize("version", VERSIONS)


@cache
def system(model: Any) -> Any:
    return ac.compile(model())


@pytest.fixture
def unit():
    """Units by model and version, made when they are first needed."""
    return exported


def archive(unit: Unit) -> str:
    return str(unit.folder.parent / f"{unit.identifier}.fmu")


def variable(unit: Unit, name: str) -> dict[str, str]:
    """Attributes of a variable, those of its type included."""
    found = next(v for v in unit.root.iterfind("ModelVariables/*") if v.attrib["name"] == name)
    return {**found.attrib, **{k: x for child in found for k, x in child.attrib.items() if child.tag == "Real"}}


# ---- model description ----------------------------------------------------------------------------
@BOTH
@pytest.mark.parametrize("model", MODELS)
def test_fmpy_has_no_complaint(unit, model, version):
    from fmpy.validation import validate_fmu

    assert validate_fmu(archive(unit(model, version))) == []


@BOTH
def test_roles_of_variables(unit, version):
    one = unit(Oscillator, version)

    def role(name: str) -> tuple[str | None, ...]:
        found = variable(one, name)
        return tuple(found.get(k) for k in ("causality", "variability", "initial", "start", "unit"))

    assert role("k") == ("parameter", "tunable", "exact", "4.0", "N/m")
    assert role("period") == ("calculatedParameter", "tunable", "calculated", None, "s")
    assert role("u") == ("input", "continuous", None, "0.5", "N")
    assert role("y") == ("output", "continuous", "calculated", None, "m")
    assert role("v") == ("local", "continuous", "exact", "0.0", "m/s")
    assert role("der(v)") == ("local", "continuous", "calculated", None, "m/s2")
    assert role("time")[:3] == ("independent", "continuous", None)
    assert variable(one, "k")["min"] == "0.0"
    assert variable(one, "v")["nominal"] == "2.0"
    assert variable(one, "x")["description"] == "position"
    assert one.root.attrib["variableNamingConvention"] == "structured"


@BOTH
def test_starts_that_are_moved_or_computed(unit, version):
    assert variable(unit(Balanced, version), "x")["initial"] == "approx"
    assert variable(unit(Balanced, version), "r")["initial"] == "exact"
    computed = variable(unit(Implicit, version), "x")
    assert computed["initial"] == "calculated" and "start" not in computed


def test_aliases(unit):
    three, two = unit(Oscillator, "3.0"), unit(Oscillator, "2.0")
    assert three.reference["same"] == three.reference["x"] != three.reference["against"]
    assert two.reference["same"] != two.reference["x"]  # x can be set, and has one start value
    assert variable(two, "same")["initial"] == "calculated"


@BOTH
def test_units_in_base_units(unit, version):
    units = {
        u.attrib["name"]: b.attrib if (b := u.find("BaseUnit")) is not None else None
        for one in (unit(Oscillator, version), unit(Chain, version))
        for u in one.root.iterfind("UnitDefinitions/*")
    }
    assert units["N.s/m"] == {"kg": "1", "s": "-1"}
    assert units["bar"] == {"kg": "1", "m": "-1", "s": "-2", "factor": "100000.0"}
    assert units["degC"] == {"K": "1", "offset": "273.15"}
    assert units["degC/s"] == {"K": "1", "s": "-1"}


def test_angles_have_an_exponent():
    from acausal.fmi.exporter.units import base_unit

    def exponents(text: str) -> dict[str, int]:
        found = base_unit(text)
        assert found is not None
        return dict(found.exponents)

    assert exponents("rad/s") == {"s": -1, "rad": 1}
    assert exponents("N.m/rad") == {"kg": 1, "m": 2, "s": -2, "rad": -1}
    assert exponents("deg") == {"rad": 1}
    assert exponents("rad/s2") == {"s": -2, "rad": 1}
    assert base_unit("Pa^0.5") is None


def dependencies(unit: Unit, tag: str, name: str) -> set[str]:
    names = {r: n for n, r in reversed(unit.reference.items())}
    if unit.version == "3.0":
        for row in unit.root.find("ModelStructure").iter(tag):
            if names[int(row.attrib["valueReference"])] == name:
                return {names[int(k)] for k in row.attrib["dependencies"].split()}
    table = [v.attrib["name"] for v in unit.root.find("ModelVariables")]
    plural = {"Output": "Outputs", "ContinuousStateDerivative": "Derivatives", "InitialUnknown": "InitialUnknowns"}
    for row in unit.root.find(f"ModelStructure/{plural[tag]}") if unit.version == "2.0" else ():
        if table[int(row.attrib["index"]) - 1] == name:
            return {table[int(k) - 1] for k in row.attrib["dependencies"].split()}
    raise KeyError(name)


@BOTH
def test_dependencies(unit, version):
    one = unit(Oscillator, version)
    assert dependencies(one, "Output", "y") == {"x"}
    assert dependencies(one, "ContinuousStateDerivative", "der(x)") == {"v"}
    assert dependencies(one, "ContinuousStateDerivative", "der(v)") == {"x", "v", "u", "time"}
    assert dependencies(one, "InitialUnknown", "period") == {"m", "k"}
    assert dependencies(one, "InitialUnknown", "der(v)") == {"x", "v", "u", "k", "m", "d", "F"}
    # through an algebraic unknown
    implicit = unit(Implicit, version)
    assert dependencies(implicit, "Output", "y") == {"x", "u"}
    assert dependencies(implicit, "InitialUnknown", "x") == {"x0"}
    assert dependencies(implicit, "InitialUnknown", "y") == {"x0", "a", "u"}
    chain = unit(Chain, version)
    assert dependencies(chain, "ContinuousStateDerivative", "der(cells[1].T)") == {"cells[0].T", "cells[1].T"}


def test_the_same_sources_every_time(unit, tmp_path):
    first = archive(unit(Oscillator, "3.0"))
    second = ac.fmi.export(ac.compile(Oscillator()), tmp_path / "Oscillator.fmu", platforms=())
    with zipfile.ZipFile(first) as a, zipfile.ZipFile(second) as b:
        assert [n for n in a.namelist() if not n.startswith("binaries")] == b.namelist()
        assert all(a.read(n) == b.read(n) for n in b.namelist())


@BOTH
@pytest.mark.parametrize("model", [Pendulum, Wall])
def test_sources_are_clean_c_and_export_only_the_interface(unit, version, model):
    import shutil
    import subprocess

    one = unit(model, version)
    cc = shutil.which("gcc") or shutil.which("clang")
    if cc is None:
        pytest.skip("no C compiler by name")
    main = one.folder / "sources" / f"fmi{version[0]}.c"
    flags = ["-std=gnu11", "-Wall", "-Wextra", "-Wno-unused-parameter", "-Werror", "-O2", "-c", "-o", "/dev/null"]
    made = subprocess.run([cc, *flags, str(main)], capture_output=True, text=True, check=False)
    assert made.returncode == 0, made.stderr
    nm = shutil.which("nm")
    if nm is not None:
        listed = subprocess.run([nm, "-D", "--defined-only", str(one.binary)], capture_output=True, text=True).stdout
        names = [line.split()[-1] for line in listed.splitlines()]
        assert names and all(n.startswith((f"fmi{version[0]}", "_")) for n in names)


# ---- FMPy -----------------------------------------------------------------------------------------
def fmpy_run(unit: Unit, kind: str, **options: Any) -> Any:
    from fmpy import simulate_fmu

    full = {"me": "ModelExchange", "cs": "CoSimulation"}[kind]
    given: dict[str, Any] = {"stop_time": 4.0, "output_interval": 0.05, "relative_tolerance": 1e-10} | options
    return simulate_fmu(archive(unit), fmi_type=full, solver="CVode", **given)


def largest_difference(run: Any, solution: Any, names: Any) -> float:
    return max(float(np.abs(run[n] - solution[n]).max() / (np.ptp(solution[n]) or 1.0)) for n in names)


@BOTH
@pytest.mark.parametrize("kind", ["me", "cs"])
@pytest.mark.parametrize("model", MODELS)
def test_fmpy_agrees_with_simulate(unit, model, kind, version):
    s = system(model)
    names = [*s.states, *s.observed][:8]
    run = fmpy_run(unit(model, version), kind, output=names)
    solution = s.simulate(4.0, saveat=run["time"], rtol=1e-10)
    assert largest_difference(run, solution, names) <= 1e-6


@BOTH
@pytest.mark.parametrize("kind", ["me", "cs"])
def test_parameters_and_starts_are_recomputed(unit, kind, version):
    run = fmpy_run(unit(Balanced, version), kind, output=["x", "z", "r"], start_values={"a": 5.0, "r": 9.0})
    solution = system(Balanced).simulate(4.0, saveat=run["time"], rtol=1e-10, parameters={"a": 5.0}, initial={"r": 9.0})
    assert largest_difference(run, solution, ["x", "z", "r"]) <= 1e-6
    assert run["x"][0] == pytest.approx(0.4, abs=1e-12)
    run = fmpy_run(unit(Implicit, version), kind, output=["x", "y"], start_values={"x0": 2.0})
    solution = system(Implicit).simulate(4.0, saveat=run["time"], rtol=1e-10, parameters={"x0": 2.0})
    assert largest_difference(run, solution, ["x", "y"]) <= 1e-6


@BOTH
def test_inputs_over_time(unit, version):
    """Model exchange with an importer that sets time, input and states in every evaluation."""
    from ctypes import POINTER, c_double

    from scipy.integrate import solve_ivp

    one = unit(Implicit, version).instance("me")
    one.enter()
    one.set(u=1.0)
    assert one.call("ExitInitializationMode") == OK
    one.update()
    assert one.call("EnterContinuousTimeMode") == OK
    name = "GetDerivatives" if version == "2.0" else "GetContinuousStateDerivatives"

    def slope(t: float, x: np.ndarray) -> np.ndarray:
        out = np.empty(1)
        a, b = (np.ascontiguousarray(v).ctypes.data_as(POINTER(c_double)) for v in (x, out))
        assert one.call("SetTime", float(t)) == OK and one.set(u=np.interp(t, times, values)) == OK
        assert one.call("SetContinuousStates", a, 1) == OK and one.call(name, b, 1) == OK
        return out

    times = np.linspace(0.0, 4.0, 9)
    values = np.cos(times)
    run = solve_ivp(slope, (0.0, 4.0), [1.0], method="LSODA", rtol=1e-10, atol=1e-12)
    one.free()
    solution = system(Implicit).simulate(4.0, saveat=run.t, rtol=1e-10, inputs={"u": (times, values)})
    assert np.abs(run.y[0] - solution["x"]).max() <= 1e-7


def test_linear_inputs_in_co_simulation(unit):
    """FMI 2.0: with the rate of the input a piecewise linear signal is followed exactly."""
    from ctypes import c_double, c_int

    one = unit(Implicit, "2.0").instance("cs")
    times = np.linspace(0.0, 4.0, 9)
    values = np.cos(times)
    one.enter(tolerance=1e-10)
    one.set(u=values[0])
    assert one.call("ExitInitializationMode") == OK
    found = [one.get("x", "y")]
    for t, u, rate in zip(times[:-1], values, np.diff(values) / np.diff(times), strict=False):
        assert one.set(u=u) == OK
        given = (one.references(["u"]), 1, (c_int * 1)(1), (c_double * 1)(rate))
        assert one.call("SetRealInputDerivatives", *given) == OK
        assert one.step(float(t), 0.5) == OK
        found.append(one.get("x", "y"))
    solution = system(Implicit).simulate(4.0, saveat=times, rtol=1e-10, inputs={"u": (times, values)})
    x, y = np.array(found).T
    assert np.abs(x - solution["x"]).max() <= 1e-8
    assert np.abs(y + y**3 - 1.5 * x - 0.2 * values).max() <= 1e-10
    rates = (c_double * 1)()
    given = (one.references(["x"]), 1, (c_int * 1)(1), rates)
    assert one.call("GetRealOutputDerivatives", *given) == OK
    assert rates[0] == pytest.approx(one.get("der(x)")[0], rel=1e-12)
    one.free()


# ---- CasADi ---------------------------------------------------------------------------------------
@BOTH
@pytest.mark.parametrize("model", [Oscillator, Implicit, Balanced, Chain])
def test_casadi_agrees_with_simulate(unit, model, version):
    casadi = pytest.importorskip("casadi")
    one, s = unit(model, version), system(model)
    dae = casadi.DaeBuilder(one.identifier, str(one.folder))
    f = dae.create("f", ["t", "x", "u", "p"], ["ode"])
    solution = s.simulate(2.0, saveat=np.linspace(0.0, 2.0, 5), rtol=1e-10)
    t, x = casadi.MX.sym("t"), casadi.MX.sym("x", f.size1_in(1))
    u, p = dae.start(dae.u()), dae.start(dae.p())
    problem = {"t": t, "x": x, "ode": f(t, x, u, p)}
    options = {"abstol": 1e-12, "reltol": 1e-10}
    run = casadi.integrator("run", "cvodes", problem, 0.0, solution.t[1:], options)
    start = [float(solution[n][0]) for n in dae.x()]
    found = np.array(run(x0=start)["xf"])
    wanted = np.stack([solution[n][1:] for n in dae.x()])
    assert np.abs(found - wanted).max() <= 1e-6 * np.abs(wanted).max()
