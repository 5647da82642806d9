"""System structure packages: valid, read back to the same run, read by another tool, and what is refused."""

from __future__ import annotations

import zipfile
from functools import cache
from importlib.resources import files
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from acausal.fmi import CoSimulation, CoSimulationError, read_ssp, split, write_ssp

from .models import Decay, TwoMasses

NAMES = {"ssd": "SystemStructureDescription", "ssc": "SystemStructureCommon", "ssv": "SystemStructureParameterValues"}
BOTH = pytest.mark.parametrize("version", ("2.0", "3.0"))


@cache
def masses() -> ac.fmi.Split:
    return split(TwoMasses(), "middle.flange_a", names=("right", "left"))


@pytest.fixture
def master(version, tmp_path):
    parts = masses().fmus(tmp_path, version=version, outputs=["one.s"], parameters={"one.m": 2.5, "two.m": 0.8})
    made = masses().cosimulation(participants=parts, step=0.02, order=2, method="gauss-seidel", max_step=0.05)
    with made:
        yield made


def document(path: Path) -> bytes:
    with zipfile.ZipFile(path) as archive:
        return archive.read("SystemStructure.ssd")


def rewritten(path: Path, old: str, new: str) -> Path:
    """A package with another description."""
    text = document(path).decode()
    assert old in text
    place = path.with_name("other.ssp")
    with zipfile.ZipFile(path) as source, zipfile.ZipFile(place, "w") as target:
        for name in source.namelist():
            target.writestr(name, text.replace(old, new) if name.endswith(".ssd") else source.read(name))
    return place


@BOTH
def test_the_description_is_valid(master, tmp_path):
    """Against the schemas of SSP 1.0, which FMPy brings along."""
    etree = pytest.importorskip("lxml.etree")
    path = write_ssp(master, tmp_path / "masses.ssp", name="masses", t1=4.0)
    schema = etree.XMLSchema(etree.parse(str(files("fmpy") / "ssp" / "schema" / f"{NAMES['ssd']}.xsd")))
    parsed = etree.fromstring(document(path))
    assert schema.validate(parsed), schema.error_log
    spaces = {k: f"http://ssp-standard.org/SSP1/{v}" for k, v in NAMES.items()}
    sets = parsed.findall(".//ssv:ParameterSet", spaces)
    assert {p.get("name"): p[0].get("value") for s in sets for p in s.iterfind(".//ssv:Parameter", spaces)} == {
        "two.m": "0.8", "one.m": "2.5"
    }  # fmt: skip
    values = etree.XMLSchema(etree.parse(str(files("fmpy") / "ssp" / "schema" / f"{NAMES['ssv']}.xsd")))
    assert all(values.validate(etree.fromstring(etree.tostring(s))) for s in sets), values.error_log


@BOTH
def test_a_package_is_the_same_run_again(master, tmp_path):
    first = master.simulate(1.0)
    path = write_ssp(master, tmp_path / "deep" / "masses.ssp")
    with read_ssp(path) as again:
        assert again.names == master.names
        assert (again.method, again.order, again.step, again.max_step) == ("gauss-seidel", 2, 0.02, 0.05)
        assert [b.bond for b in again.bonds] == [b.bond for b in master.bonds]
        second = again.simulate(1.0)
    np.testing.assert_array_equal(second.t, first.t)
    for name in first.names:
        np.testing.assert_allclose(second[name], first[name], rtol=1e-12, atol=1e-12)
    assert second.energy_residual == pytest.approx(first.energy_residual)
    with read_ssp(path, step=0.05, method="jacobi") as other:
        assert (other.step, other.method) == (0.05, "jacobi")


def test_another_tool_reads_it(tmp_path):
    """FMPy's simulation of packages: two lags in a ring, by its own (Jacobi, order 0) master."""
    from fmpy.ssp.simulation import simulate_ssp

    decay = ac.compile(Decay())
    a, b = (ac.fmi.load(ac.fmi.export(decay, tmp_path / f"{n}.fmu", version="2.0", kind="cs")) for n in "ab")
    parts = {"a": a.participant(parameters={"tau": 0.25}), "b": b.participant()}
    with CoSimulation(parts, [("a.y", "b.u"), ("b.y", "a.u")], inputs={}, step=0.01, order=0) as master:
        path = write_ssp(master, tmp_path / "ring.ssp", t1=1.0)
        ours = master.simulate(1.0)
    theirs = simulate_ssp(str(path), stop_time=1.0, step_size=0.01)
    columns = {n.rpartition(".")[0].rpartition(".")[2]: n for n in theirs.dtype.names if n.endswith(".y")}
    for n in "ab":
        np.testing.assert_allclose(np.interp(ours.t, theirs["time"], theirs[columns[n]]), ours[f"{n}.y"], atol=0.02)


@pytest.mark.parametrize("version", ["2.0"])
def test_what_cannot_be_read(master, tmp_path):
    path = write_ssp(master, tmp_path / "masses.ssp")
    (tmp_path / "text.ssp").write_text("no archive")
    with pytest.raises(CoSimulationError, match=r"text\.ssp is not a system structure package: "):
        read_ssp(tmp_path / "text.ssp")
    with pytest.raises(CoSimulationError, match=r"absent\.ssp is not a system structure package: "):
        read_ssp(tmp_path / "absent.ssp")
    for old, new, message in (
        ('source="resources/left.fmu"', 'source="../left.fmu"', r"its FMU \.\./left\.fmu is not in the package"),
        ('type="application/x-fmu-sharedlibrary"', 'type="application/x-ssp-package"', "only FMUs can be read"),
        ("ssd:Component", "ssd:SignalDictionaryReference", "is a SignalDictionaryReference; only FMUs can be read"),
        ("<ssv:Real", "<ssv:String", "is not a real number"),
    ):
        with pytest.raises(CoSimulationError, match=message):
            read_ssp(rewritten(path, old, new))


@BOTH
def test_an_input_of_the_whole_system(master, tmp_path):
    path = write_ssp(master, tmp_path / "masses.ssp")
    first = document(path).decode()
    i = first.index("<ssd:Connection ")
    one = first[i : first.index("/>", i) + 2]
    source = " ".join(w for w in one.split() if w.startswith("startElement="))
    open_ended = rewritten(path, one, one.replace(source, "").replace("  ", " "))
    with pytest.raises(CoSimulationError, match=r"own input `.*` drives `(.*)`, and nothing gives it a value") as told:
        read_ssp(open_ended)
    name = str(told.value).split("drives `")[1].split("`")[0]
    with read_ssp(open_ended, inputs={name: 0.0}, bonds=()) as made:  # the bond has lost its connection
        assert made.inputs


def test_what_cannot_be_written(tmp_path):
    decay = ac.compile(Decay())
    with pytest.raises(CoSimulationError, match=r"a system structure package holds FMUs; `d` is none. Export it first"):
        write_ssp(CoSimulation({"d": decay}, []), tmp_path / "a.ssp")
    unit = ac.fmi.load(ac.fmi.export(decay, tmp_path / "d.fmu", kind="cs"))
    with CoSimulation({"d": unit}, [], inputs={"d.u": 1.0}) as fed:
        with pytest.raises(CoSimulationError, match=r"cannot hold the signals of `inputs=`"):
            write_ssp(fed, tmp_path / "a.ssp")
