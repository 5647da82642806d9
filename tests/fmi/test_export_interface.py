"""The C interface of exported units: derivatives, saved states, several instances, refused calls, memory."""

from __future__ import annotations

import ctypes
import shutil
import subprocess
import sys
from ctypes import byref, c_double, c_int
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from acausal import Component, Equations, Parameter, Variable, der
from acausal.fmi import ExportError

from .export_models import Balanced, Ball, Chain, Explodes, Implicit, Oscillator, Pendulum, Thermostat
from .export_unit import DISCARD, ERROR, OK, Instance, Unit, exported

BOTH = pytest.mark.parametrize("version", ("2.0", "3.0"))


@pytest.fixture
def unit():
    """Units by model and version, made when they are first needed."""
    return exported


# ---- derivatives ----------------------------------------------------------------------------------
def states(unit: Unit) -> list[str]:
    names = {r: n for n, r in reversed(unit.reference.items())}
    table = [v.attrib for v in unit.root.iterfind("ModelVariables/*")]
    if unit.version == "3.0":
        return [names[int(v["derivative"])] for v in table if "derivative" in v]
    rows = unit.root.findall("ModelVariables/*")
    return [rows[int(r.attrib["derivative"]) - 1].attrib["name"] for v in rows for r in v if "derivative" in r.attrib]


def differences(one: Instance, unknowns: list[str], known: str, change: float) -> np.ndarray:
    """Central differences."""
    value = one.get(known)[0]
    step = change * max(1.0, abs(value))

    def at(x: float) -> np.ndarray:
        assert one.set_values({known: x}) == OK, one.messages
        return one.get(*unknowns)

    out = (at(value + step) - at(value - step)) / (2 * step)
    at(value)
    return out


@BOTH
@pytest.mark.parametrize("model", [Oscillator, Implicit])
def test_directional_derivatives_in_a_run(unit, model, version):
    one = unit(model, version).instance("me").initialize(start=0.3)
    x = states(one.unit)
    assert one.set_values({n: 0.7 + 0.2 * k for k, n in enumerate(x)}) == OK
    unknowns = [f"der({n})" for n in x] + ["y"]
    knowns = [*x, "u", *({"k", "m", "d"} if model is Oscillator else {"a"})]
    for known in knowns:
        found = one.derivative(unknowns, [known], [1.0])
        assert found == pytest.approx(differences(one, unknowns, known, 1e-6), rel=1e-7, abs=1e-8), known
    matrix = np.array([one.derivative(unknowns, [k], [1.0]) for k in knowns]).T
    seed = np.arange(1.0, len(knowns) + 1)
    assert one.derivative(unknowns, knowns, seed) == pytest.approx(matrix @ seed, rel=1e-12)
    if version == "3.0":
        seed = np.arange(1.0, len(unknowns) + 1)
        assert one.derivative(unknowns, knowns, seed, adjoint=True) == pytest.approx(matrix.T @ seed, rel=1e-12)
    by_time = one.derivative(unknowns, ["time"], [1.0])
    value = one.get(*unknowns)
    assert one.call("SetTime", 0.3 + 1e-6) == OK
    assert by_time == pytest.approx((one.get(*unknowns) - value) / 1e-6, abs=1e-6)
    one.free()


@BOTH
@pytest.mark.parametrize(
    ("model", "knowns"), [(Oscillator, "xvukm"), (Implicit, ("x0", "a", "u")), (Balanced, ("a", "b", "r"))]
)
def test_directional_derivatives_of_the_start(unit, model, knowns, version):
    one = unit(model, version).instance("cs")
    assert one.enter() == OK
    x = states(one.unit)
    unknowns = [*x, *(f"der({n})" for n in x), *(["period"] if model is Oscillator else [])]
    for known in knowns:
        found = one.derivative(unknowns, [known], [1.0])
        assert found == pytest.approx(differences(one, unknowns, known, 1e-6), rel=1e-7, abs=1e-7), known
    one.free()


@BOTH
def test_only_knowns_can_be_varied(unit, version):
    one = unit(Oscillator, version).instance("me").initialize()
    out = (c_double * 1)()
    head = (one.references(["y"]), 1, one.references(["y"]), 1, (c_double * 1)(1.0))
    more = (1, out, 1) if version == "3.0" else (out,)
    assert one.call("GetDirectionalDerivative", *head, *more) == ERROR
    assert "is not a known quantity in this mode" in one.messages[-1][1]
    one.free()


# ---- instances and saved states -------------------------------------------------------------------
@BOTH
@pytest.mark.parametrize("model", [Oscillator, Implicit, Pendulum, Chain])
def test_a_saved_state_gives_the_same_run_again(unit, model, version):
    one, other = unit(model, version).instance().initialize(), unit(model, version).instance().initialize()
    names = states(one.unit)
    for k in range(10):
        one.step(0.1 * k, 0.1)
    saved = one.save()
    data = one.serialize(saved)

    def run(f: Instance) -> np.ndarray:
        for k in range(10, 20):
            assert f.step(0.1 * k, 0.1) == OK
        return f.get(*names)

    first = run(one)
    assert one.load(saved) == OK
    assert (run(one) == first).all()
    status, copy = other.deserialize(data)
    assert status == OK and other.load(copy) == OK
    assert (run(other) == first).all()
    assert (other.serialize(copy) == data) and one.drop(saved) == OK and other.drop(copy) == OK
    broken = bytes(len(data))
    assert other.deserialize(broken)[0] == ERROR
    assert other.deserialize(data[:-8])[0] == ERROR
    assert "saved state of the model" in other.messages[0][1]
    for f in (one, other):
        f.free()


@BOTH
def test_instances_do_not_know_of_each_other(unit, version):
    many = [unit(Oscillator, version).instance(name=f"i{k}".encode()) for k in range(4)]
    for k, one in enumerate(many):
        assert one.set(k=2.0 + k) == OK
        one.initialize()
    for n in range(20):
        for one in many[::-1] if n % 2 else many:
            assert one.step(0.1 * n, 0.1) == OK
    for k, one in enumerate(many):
        alone = unit(Oscillator, version).instance()
        alone.set(k=2.0 + k)
        alone.initialize()
        for n in range(20):
            alone.step(0.1 * n, 0.1)
        assert (alone.get("x", "v") == one.get("x", "v")).all()
        alone.free()
        one.free()


@BOTH
def test_reset_is_a_new_instance(unit, version):
    one = unit(Oscillator, version).instance()
    one.set(k=9.0, x=2.0)
    one.initialize()
    one.step(0.0, 0.5)
    assert one.call("Reset") == OK
    one.initialize()
    assert one.get("k", "x", "v") == pytest.approx([4.0, 1.0, 0.0])
    one.free()


@BOTH
def test_retained_constraints_hold(unit, version):
    """In model exchange the unit asks for an event when an importer's states drift off, and puts them back."""
    one = unit(Pendulum, version).instance("me").initialize()
    length = 1.2
    x, y = one.get("x", "y")
    assert one.set(x=x + 1e-4) == OK
    event, end = (c_int(), c_int()) if version == "2.0" else (ctypes.c_bool(), ctypes.c_bool())
    assert one.call("CompletedIntegratorStep", True, byref(event), byref(end)) == OK
    assert event.value and not end.value
    assert one.call("EnterEventMode") == OK
    assert one.update() and not one.update()
    x, y = one.get("x", "y")
    assert x**2 + y**2 == pytest.approx(length**2, abs=1e-10)
    one.free()
    one = unit(Pendulum, version).instance("cs").initialize()
    for k in range(300):
        assert one.step(0.01 * k, 0.01) == OK
    x, y = one.get("x", "y")
    assert x**2 + y**2 == pytest.approx(length**2, abs=1e-10)
    one.free()


# ---- refused calls --------------------------------------------------------------------------------
@BOTH
def test_wrong_calls_are_errors_with_a_message(unit, version):
    prefix = f"fmi{version[0]}"
    wrong = unit(Oscillator, version).instance(token=b"{not the token}")
    assert not wrong.pointer.value and "is not that of this model" in wrong.messages[0][1]
    wrong = unit(Oscillator, version).instance(name=b"")
    assert not wrong.pointer.value and "needs a name" in wrong.messages[0][1]
    one = unit(Oscillator, version).instance()

    def refused(status: int, text: str, expected: int = ERROR) -> None:
        assert status == expected
        assert text in one.messages[-1][1]
        assert one.messages[-1][0] == expected

    refused(one.step(0.0, 0.1), f"{prefix}DoStep is not allowed in this state (instantiated)")
    refused(one.get_status(["x"])[0], "is not allowed in this state (instantiated)")
    refused(one.call("ExitInitializationMode"), "is not allowed in this state (instantiated)")
    refused(one.set(k=-1.0), "-1 for the parameter with value reference 1 lies outside its bounds [0, inf]", DISCARD)
    refused(one.set(y=1.0), "cannot be set in this mode")
    refused(one.set(period=1.0), "cannot be set in this mode")
    refused(one.set(k=float("nan")), "is not a finite number")
    refused(one.set_values({99: 1.0}), "there is no variable with value reference 99")
    refused(one.enter(tolerance=-1.0), "the relative tolerance -1 is not between 0 and 1")
    refused(one.enter(start=float("inf")), "the experiment from t = inf s")
    one.initialize()
    refused(one.enter(), "is not allowed in this state (step mode)")
    refused(one.set(x=1.0), "cannot be set in this mode")
    refused(one.call("SetTime", 1.0), "is a function of model exchange, this instance is for co-simulation")
    refused(one.step(0.5, 0.1), "a step of 0.1 s at t = 0.5 s is not possible: the instance is at t = 0 s")
    refused(one.step(0.0, -0.1), "is not po")
    refused(one.get_status([99])[0], "there is no variable with value reference 99")
    kind = "GetInteger" if version == "2.0" else "GetInt32"
    more = () if version == "2.0" else (1,)
    refused(one.call(kind, one.references([0]), 1, (c_int * 1)(), *more), "the model has no")
    get = "GetReal" if version == "2.0" else "GetFloat64"
    refused(one.call(get, None, 1, None, *more), f"{prefix}{get} was given a null pointer")
    refused(one.load(ctypes.c_void_p()), "was given a null pointer")
    assert one.step(0.0, 0.1) == OK
    assert one.call("Terminate") == OK
    refused(one.step(0.1, 0.1), "is not allowed in this state (terminated)")
    assert one.get_status(["x"])[0] == OK
    assert one.call("Reset") == OK
    one.free()
    nobody = ctypes.c_void_p()
    assert unit(Oscillator, version).function("Reset")(nobody) == ERROR
    unit(Oscillator, version).function("FreeInstance")(nobody)


@BOTH
def test_wrong_sizes_in_model_exchange(unit, version):
    one = unit(Oscillator, version).instance("me").initialize()
    three = (c_double * 3)()
    assert one.call("GetContinuousStates", three, 3) == ERROR
    assert one.messages[-1][1] == "the model has 2 continuous states, not 3"
    assert one.call("GetEventIndicators", three, 1) == ERROR
    assert one.messages[-1][1] == "the model has 0 event indicators, not 1"
    assert one.call("GetEventIndicators", None, 0) == OK
    assert one.call("GetNominalsOfContinuousStates", three, 2) == OK and list(three)[:2] == [1.0, 2.0]
    assert one.call("SetTime", float("nan")) == ERROR
    assert one.call("SetContinuousStates", (c_double * 2)(1.0, np.inf), 2) == ERROR
    assert one.step(0.0, 0.1) == ERROR
    one.free()


@BOTH
def test_a_step_that_fails_is_discarded(unit, version):
    """x' = x^2 from 1 has no solution beyond t = 1."""
    one = unit(Explodes, version).instance().initialize()
    assert one.step(0.0, 0.5) == OK
    assert one.get("x")[0] == pytest.approx(2.0, rel=1e-5)
    saved = one.save()
    assert one.step(0.5, 1.0) == DISCARD
    assert "the solver stopped at t = " in one.messages[-1][1]
    assert one.step(0.5, 1.0) == ERROR
    assert 0.9 < one.get("time")[0] <= 1.0 + 1e-6
    if version == "2.0":
        last = c_double()
        assert one.call("GetRealStatus", c_int(2), byref(last)) == OK
        assert last.value == one.get("time")[0]
    assert one.load(saved) == OK and one.step(0.5, 0.25) == OK
    assert one.get("x")[0] == pytest.approx(4.0, rel=1e-5)
    one.drop(saved)
    one.free()


@BOTH
def test_a_start_that_does_not_exist_is_an_error(unit, version):
    one = unit(Balanced, version).instance()
    assert one.set(a=0.0) == OK  # b - a x = 0 has no solution
    assert one.enter() == OK
    assert one.call("ExitInitializationMode") == ERROR
    assert "the conditions of the start have no solution near the start values" in one.messages[-1][1]
    assert one.set(a=2.0) == OK and one.call("ExitInitializationMode") == OK
    assert one.get("x")[0] == pytest.approx(1.0)
    one.free()


# ---- errors of the export -------------------------------------------------------------------------
class Bare(Component):
    k: Parameter = Parameter()
    x: Variable = Variable(start=1.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x) == -self.k * self.x


def test_errors_of_the_export(tmp_path):
    good, path = ac.compile(Oscillator()), tmp_path / "a.fmu"
    with pytest.raises(ExportError, match=r"version='1.0' of FMI is not one of 2.0, 3.0"):
        ac.fmi.export(good, path, version="1.0")
    with pytest.raises(ExportError, match=r"kind=\('se',\): an FMU offers 'me' \(model exchange\)"):
        ac.fmi.export(good, path, kind=("se",))
    with pytest.raises(ExportError, match=r"`sparc-sun` is not a platform that FMUs can be made for \(these are: x86"):
        ac.fmi.export(good, path, platforms=("sparc-sun",))
    with pytest.raises(ExportError, match=r"FMI 2.0 has no name for the platform `aarch64-linux`; take version='3.0'"):
        ac.fmi.export(good, path, version="2.0", platforms=("aarch64-linux",))
    with pytest.raises(ExportError, match=r"FMI 2.0 has one name for two of the platforms x86_64-darwin, aarch64-darw"):
        ac.fmi.export(good, path, version="2.0", platforms=("x86_64-darwin", "aarch64-darwin"))
    with pytest.raises(ExportError, match=r"`Bare`: 1 of the parameters have no value.*`k`. Give one at constr"):
        ac.fmi.export(ac.compile(Bare()), path)
    assert not path.exists()


def test_a_platform_without_cross_compiler(tmp_path, monkeypatch):
    from acausal.fmi.exporter import binaries

    monkeypatch.setattr(binaries.importlib.util, "find_spec", lambda name: None)
    other = next(t for t in binaries.TARGETS if t != binaries.this_platform())
    with pytest.raises(ExportError, match=f"a library for {other} needs the package ziglang on this machine"):
        ac.fmi.export(ac.compile(Oscillator()), tmp_path / "a.fmu", platforms=(other,))


def test_python_functions_cannot_be_exported(tmp_path):
    from acausal.lowering.c.text import NotInC

    @ac.function
    def f(x: Any) -> Any:
        return x**2

    class Calls(Component):
        x: Variable = Variable(start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield der(self.x) == -f(self.x)

    with pytest.raises(NotInC, match="is Python"):
        ac.fmi.export(ac.compile(Calls()), tmp_path / "a.fmu")


@BOTH
def test_one_interface_only(tmp_path, version):
    path = ac.fmi.export(ac.compile(Chain()), tmp_path / "only.fmu", version=version, kind="me")
    one = Unit(path, tmp_path / "unpacked")
    assert one.root.find("CoSimulation") is None
    refused = one.instance("cs")
    assert not refused.pointer.value and "does not offer that interface" in refused.messages[0][1]
    one.instance("me").initialize().free()


# ---- many calls, many instances -------------------------------------------------------------------
def random_calls(path: Path, folder: Path, options: list[str]) -> None:
    """Runs `export_random.py`, which may crash, in a process of its own."""
    script = Path(__file__).with_name("export_random.py")
    done = subprocess.run(
        [sys.executable, str(script), str(path), str(folder), *options], capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, (done.returncode, done.stdout[-2000:], done.stderr[-2000:])


@BOTH
@pytest.mark.parametrize("model", [Implicit, Thermostat])
def test_random_calls(unit, model, version, tmp_path):
    one = unit(model, version)
    random_calls(one.folder.parent / f"{one.identifier}.fmu", tmp_path / "x", ["--sequences", "250"])


@BOTH
@pytest.mark.slow
@pytest.mark.parametrize("model", [Balanced, Ball])
def test_ten_thousand_random_sequences(unit, model, version, tmp_path):
    one = unit(model, version)
    random_calls(one.folder.parent / f"{one.identifier}.fmu", tmp_path / "x", ["--sequences", "10000"])


@BOTH
def test_a_thousand_instances(unit, version):
    """Created, stepped, saved and freed: memory does not grow."""
    resource = pytest.importorskip("resource")

    def generation() -> None:
        many = [unit(Pendulum, version).instance().initialize() for _ in range(100)]
        for one in many:
            saved = one.save()
            assert one.step(0.0, 0.05) == OK
            one.drop(saved)
            one.free()

    generation()
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    for _ in range(10):
        generation()
    grown = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    assert grown < 20_000  # KiB


@BOTH
@pytest.mark.slow
def test_valgrind_finds_nothing(unit, version, tmp_path):
    if shutil.which("valgrind") is None or shutil.which("cc") is None:
        pytest.skip("valgrind or cc is not installed")
    one = unit(Implicit, version)
    driver = Path(__file__).with_name("export_driver.c")
    program = tmp_path / "driver"
    sources = one.folder / "sources"
    defines = (f"-DFMI={version[0]}", f'-DTOKEN="{one.token.decode()}"')
    files = (str(driver), str(sources / f"fmi{version[0]}.c"))
    subprocess.run(["cc", "-g", "-O1", *defines, "-I", str(sources), "-o", str(program), *files, "-lm"], check=True)
    done = subprocess.run(
        ["valgrind", "--leak-check=full", "--errors-for-leak-kinds=all", "--error-exitcode=99", str(program)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    assert "0 errors from 0 contexts" in done.stderr
