"""Import of units: as components with signals or connectors, differentiated, and as participants."""

from __future__ import annotations

import zipfile
from functools import cache
from pathlib import Path

import jax
import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from acausal import Component, Equations, Input, Output, Parameter, Variable, connect, der
from acausal.components import translational as tr
from acausal.fmi import CoSimulation, CoSimulationError, FmuError

from .export_models import Ball, Implicit, Oscillator, Rounded, Sampled
from .export_unit import exported

BOTH = pytest.mark.parametrize("version", ("2.0", "3.0"))
ONE_IS_QUICK = pytest.mark.parametrize("version", [pytest.param("2.0", marks=pytest.mark.slow), "3.0"])


def load(model: type[Component], version: str) -> ac.fmi.Fmu:
    unit = exported(model, version)
    return ac.fmi.load(unit.folder.parent / f"{unit.identifier}.fmu")


@cache
def system(model: type[Component]) -> ac.System:
    return ac.compile(model())


# ---- loading --------------------------------------------------------------------------------------
def test_what_cannot_be_loaded(tmp_path):
    with pytest.raises(FmuError, match=r"there is no file .*absent\.fmu"):
        ac.fmi.load(tmp_path / "absent.fmu")
    (tmp_path / "text.fmu").write_text("no archive")
    with pytest.raises(FmuError, match=r"text\.fmu is not a functional mock-up unit: "):
        ac.fmi.load(tmp_path / "text.fmu")
    with zipfile.ZipFile(tmp_path / "empty.fmu", "w") as archive:
        archive.writestr("readme.txt", "nothing")
    with pytest.raises(FmuError, match=r"empty\.fmu is not a functional mock-up unit: "):
        ac.fmi.load(tmp_path / "empty.fmu")
    with zipfile.ZipFile(tmp_path / "one.fmu", "w") as archive:
        archive.writestr(
            "modelDescription.xml",
            '<fmiModelDescription fmiVersion="1.0" modelName="a" modelIdentifier="a" guid="{}" '
            'numberOfContinuousStates="0" numberOfEventIndicators="0"/>',
        )
    with pytest.raises(FmuError, match=r"one\.fmu is (FMI 1\.0; versions 2\.0 and 3\.0 can be|not a functional)"):
        ac.fmi.load(tmp_path / "one.fmu")


@BOTH
def test_a_unit_for_another_platform(version, tmp_path):
    path = ac.fmi.export(system(Oscillator), tmp_path / "bare.fmu", version=version, platforms=())
    with pytest.raises(FmuError, match=r"bare\.fmu has binaries for no platform, not for .*; it has C sources"):
        ac.fmi.load(path).component()


@BOTH
def test_what_is_in_a_unit(version):
    unit = load(Oscillator, version)
    assert unit.version == version and unit.kinds == ("cs", "me") and unit.name == "Oscillator"
    assert unit.names("input") == ("u",) and unit.names("output") == ("y",)
    assert repr(unit) == f"<Fmu Oscillator.fmu: Oscillator, FMI {version}, cs and me>"
    with pytest.raises(ac.UnknownNameError, match=r"Oscillator\.fmu has no variable `perod`\. .*`period`"):
        unit.variable("perod")
    only = load(Oscillator, version).participant
    with pytest.raises(ac.UnknownNameError, match=r"has no variable `z`"):
        only(outputs=["z"])


# ---- components with signals ----------------------------------------------------------------------
def driven(part: Component) -> Component:
    """The part behind a source whose gain can be differentiated."""

    class Driven(Component):
        part_: Component = part
        gain: Parameter = Parameter(2.0)

        def equations(self) -> Equations:
            yield self.part_.u == self.gain * ac.cos(3 * ac.time)

    return Driven()


@ONE_IS_QUICK
@pytest.mark.parametrize("model", [Oscillator, Implicit])
def test_a_component_is_the_model(model, version):
    unit = load(model, version)
    found = ac.compile(driven(unit.component())).simulate(3.0, saveat=31, rtol=1e-9)
    wanted = ac.compile(driven(model())).simulate(3.0, saveat=31, rtol=1e-9)
    for name in ("x", "y"):
        np.testing.assert_allclose(found[f"part_.{name}"], wanted[f"part_.{name}"], atol=2e-7)


@ONE_IS_QUICK
def test_values_of_parameters(version):
    unit = load(Oscillator, version)
    part = unit.component(parameters={"k": 9.0})
    found = ac.compile(part).simulate(2.0, saveat=11, rtol=1e-9)
    wanted = system(Oscillator).simulate(2.0, saveat=11, rtol=1e-9, parameters={"k": 9.0})
    np.testing.assert_allclose(found["x"], wanted["x"], atol=1e-7)
    with pytest.raises(ac.UnknownNameError, match="has no variable `kk`"):
        unit.component(parameters={"kk": 1.0})
    with pytest.raises(FmuError, match=r"Oscillator\.fmu could not be initialized: "):
        unit.component(parameters={"k": -1.0})


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "version"), [(Implicit, "3.0"), (Implicit, "2.0"), (Oscillator, "2.0"), (Oscillator, "3.0")]
)
def test_derivatives_go_through_the_unit(model, version):
    """Directional derivatives of the unit, against central differences of whole runs and against the model itself."""
    unit = ac.compile(driven(load(model, version).component()))
    itself = ac.compile(driven(model()))

    def last(of: ac.System, gain: float) -> jax.Array:
        return of.simulate(0.5, parameters={"gain": gain}, saveat=2, rtol=1e-8, engine="diffrax")["part_.x"][-1]

    slope = float(jax.grad(lambda g: last(unit, g))(2.0))
    step = 1e-3
    central = float(last(unit, 2.0 + step) - last(unit, 2.0 - step)) / (2 * step)
    assert slope == pytest.approx(central, rel=1e-5)
    assert slope == pytest.approx(float(jax.grad(lambda g: last(itself, g))(2.0)), rel=1e-6)


@BOTH
def test_without_directional_derivatives_differences_are_taken(version):
    from acausal.fmi.fmu_component import _Evaluator

    evaluator = _Evaluator(load(Oscillator, version), {})
    assert evaluator.directional
    point = np.array([0.4, 0.7, -0.3, 0.2])
    exact = [evaluator.gradient(k, point) for k in range(3)]
    evaluator.directional = False
    for k in range(3):
        np.testing.assert_allclose(evaluator.gradient(k, point), exact[k], atol=1e-8)


@BOTH
@pytest.mark.parametrize(("model", "what"), [(Ball, "state events"), (Rounded, "state events"), (Sampled, "in time")])
def test_events_cannot_be_passed_on(model, what, version):
    with pytest.raises(FmuError, match=rf"{what}.*which a component cannot pass on; use it in a co-simulation"):
        load(model, version).component()


@BOTH
def test_the_other_interface_is_missing(version, tmp_path):
    for kind, use in (("cs", "component"), ("me", "participant")):
        path = ac.fmi.export(system(Oscillator), tmp_path / f"{kind}.fmu", version=version, kind=kind)
        with pytest.raises(FmuError, match=r"does not offer (model exchange|co-simulation)"):
            getattr(ac.fmi.load(path), use)()


# ---- connectors -----------------------------------------------------------------------------------
class Body(Component):
    """A mass with signals in the place of its flange."""

    force: Input = Input(unit="N")
    position: Output = Output(unit="m")
    m: Parameter = Parameter(2.0, unit="kg")
    s: Variable = Variable(unit="m", start=0.3, fixed=True)
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.s) == self.v
        yield self.m * der(self.v) == self.force
        yield self.position == self.s


class Swinging(Component):
    """A body on a spring."""

    body: Component = tr.Mass(m=2.0, s=ac.start(0.3, fixed=True), v=ac.start(0.0, fixed=True))
    spring: tr.SpringDamper = tr.SpringDamper(c=50.0, d=1.0)
    wall: tr.Fixed = tr.Fixed()

    def equations(self) -> Equations:
        port = self.body.flange_a if isinstance(self.body, tr.Mass) else self.body.flange
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, port)


@ONE_IS_QUICK
def test_a_unit_behind_a_flange(version):
    body = load(Body, version).component(connectors={"flange": (tr.Flange, {"s": "position", "f": "force"})})
    found = ac.compile(Swinging(body=body)).simulate(3.0, saveat=31, rtol=1e-9)
    wanted = ac.compile(Swinging()).simulate(3.0, saveat=31, rtol=1e-9)
    np.testing.assert_allclose(found["body.s"], wanted["body.s"], atol=1e-7)
    np.testing.assert_allclose(found["body.flange.f"], -50.0 * found["body.s"] - found["body.v"], rtol=1e-6, atol=1e-6)


@ONE_IS_QUICK
def test_a_minus_sign_in_an_adapter(version):
    """A unit that counts its force the other way round pushes the body away."""
    body = load(Body, version).component(connectors={"flange": (tr.Flange, {"s": "position", "f": "-force"})})
    found = ac.compile(Swinging(body=body)).simulate(0.5, saveat=11, rtol=1e-9)
    np.testing.assert_allclose(found["body.flange.f"], -found["body.force"])
    assert found["body.s"][-1] > 0.5


@BOTH
def test_adapters_that_do_not_fit(version):
    unit = load(Body, version)
    with pytest.raises(FmuError, match=r"connector `flange`: a `Flange` has s, f; give the unit's variable for each"):
        unit.component(connectors={"flange": (tr.Flange, {"s": "position"})})
    with pytest.raises(FmuError, match=r"has no input or output `forse`\. .*`force`"):
        unit.component(connectors={"flange": (tr.Flange, {"s": "position", "f": "forse"})})
    twice = (tr.Flange, {"s": "position", "f": "force"})
    with pytest.raises(FmuError, match="the input `force` is given twice"):
        unit.component(connectors={"a": twice, "b": twice})


# ---- participants ---------------------------------------------------------------------------------
@BOTH
def test_an_input_that_nothing_feeds_keeps_its_start_value(version):
    """u = 0.5 by its declaration, in a unit as in a system in this process."""
    wanted = system(Oscillator).simulate(1.0, saveat=11, rtol=1e-9)
    for part in (load(Oscillator, version), system(Oscillator)):
        with CoSimulation({"o": part}, [], step=0.1) as master:
            np.testing.assert_allclose(master.simulate(1.0)["y"], wanted["y"], atol=1e-5)


@BOTH
def test_events_inside_a_macro_step(version):
    """The unit handles its own events; what it gives out at communication points is as `simulate` has it."""
    part = load(Ball, version).participant(outputs=["h", "bounces"])
    with CoSimulation({"ball": part}, [], step=0.125) as master:
        result = master.simulate(1.25)
    wanted = system(Ball).simulate(1.25, saveat=result.t, rtol=1e-9)
    np.testing.assert_allclose(result["h"], wanted["h"], atol=1e-5)
    np.testing.assert_array_equal(result["bounces"], wanted["bounces"])
    assert result["bounces"][-1] >= 2


@BOTH
def test_steps_of_a_unit_are_taken_back(version):
    """Adaptive and implicit masters save and restore the unit's state, as those of systems in this process."""

    class Follower(Component):
        u: Input = Input()
        y: Output = Output(start=0.0, fixed=True)

        def equations(self) -> Equations:
            yield 0.1 * der(self.y) == self.u - self.y

    follower = ac.compile(Follower())
    links = [("o.y", "f.u"), ("f.y", "o.u")]
    options = {"order": 1, "tolerance": 1e-4, "step": 0.2}
    runs = []
    for part in (load(Oscillator, version), system(Oscillator)):
        with CoSimulation({"o": part, "f": follower}, links, **options) as master:
            runs.append(master.simulate(2.0))
    assert runs[0].stats["rejected"] > 0
    np.testing.assert_allclose(
        runs[0]["o.y"], np.interp(runs[0].t, runs[1].t, runs[1]["o.y"]), atol=5e-3
    )
    with CoSimulation({"o": load(Oscillator, version), "f": follower}, links, iterations=10, step=0.05) as master:
        implicit = master.simulate(2.0)
    assert implicit.stats["iterations"] > 0
    np.testing.assert_allclose(runs[0]["o.y"][-1], implicit["o.y"][-1], atol=5e-3)


@BOTH
def test_bad_values_are_told(version):
    part = load(Oscillator, version).participant(parameters={"k": -1.0})
    with pytest.raises(CoSimulationError, match=r"participant `Oscillator` \(Oscillator\.fmu\): "):
        CoSimulation({"o": part}, [], step=0.1).simulate(1.0)
    with pytest.raises(ac.UnknownNameError, match="has no variable `q`"):
        CoSimulation({"o": load(Oscillator, version).participant(parameters={"q": 1.0})}, [], step=0.1).simulate(1.0)
    nan = CoSimulation({"o": load(Oscillator, version)}, [], inputs={"o.u": lambda t: np.nan if t > 0.5 else 0.0})
    with pytest.raises(CoSimulationError, match=r"participant `o` \(Oscillator\.fmu\) could not advance from t = 0\."):
        nan.simulate(1.0)


def test_folders_are_removed(tmp_path):
    unit = load(Oscillator, "3.0")
    folder = Path(unit.folder)
    assert folder.is_dir()
    del unit
    assert not folder.exists()
