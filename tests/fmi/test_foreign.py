"""Units that others made.

PythonFMU and PythonFMU3 make units of FMI 2.0 and 3.0 around a Python class. The package gemseo-fmu ships some of
OpenModelica; it asks for an old FMPy, so it is used where it happens to be installed. With the environment variable
``REFERENCE_FMUS`` the tests use the Reference-FMUs of the Modelica Association, built in its folders ``2.0``, ``3.0``.
"""

from __future__ import annotations

import importlib.util
import os
from pathlib import Path

import numpy as np
import pytest

import acausal as ac
import acausal.fmi
from acausal import Component, Equations, Input, Parameter, Variable, der
from acausal.fmi import CoSimulation, CoSimulationError, FmuError

BOTH = pytest.mark.parametrize("version", ("2.0", "3.0"))

LAG_2 = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real, Integer, Boolean

class Lag(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.y, self.tau, self.parts, self.off = 0.5, 1.0, 0.5, 100, False
        self.register_variable(Real("u", causality=Fmi2Causality.input, start=0.5))
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.tunable}
        self.register_variable(Real("tau", **fixed))
        self.register_variable(Integer("parts", **fixed))
        self.register_variable(Boolean("off", **fixed))

    def do_step(self, current_time, step_size):
        if self.off:
            return False
        for _ in range(self.parts):
            self.y += step_size / self.parts * (self.u - self.y) / self.tau
        return True
"""
LAG_3 = """
from pythonfmu3 import Boolean, Float64, Fmi3Causality, Fmi3Initial, Fmi3Slave, Fmi3StepResult, Fmi3Status
from pythonfmu3 import Fmi3Variability, Int32

class Lag(Fmi3Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u, self.y, self.tau, self.parts, self.off, self.time = 0.5, 1.0, 0.5, 100, False, 0.0
        continuous = Fmi3Variability.continuous
        self.register_variable(Float64("time", causality=Fmi3Causality.independent, variability=continuous))
        self.register_variable(Float64("u", causality=Fmi3Causality.input, variability=continuous, start=0.5))
        self.register_variable(Float64("y", causality=Fmi3Causality.output, variability=continuous))
        fixed = {"causality": Fmi3Causality.parameter, "variability": Fmi3Variability.tunable}
        self.register_variable(Float64("tau", **fixed))
        self.register_variable(Int32("parts", **fixed))
        self.register_variable(Boolean("off", **fixed))

    def do_step(self, current_time, step_size):
        if self.off:
            return Fmi3StepResult(status=Fmi3Status.error)
        for _ in range(self.parts):
            self.y += step_size / self.parts * (self.u - self.y) / self.tau
        return True
"""
DECAY_3 = """
from pythonfmu3 import Float64, Fmi3Causality, Fmi3Initial, Fmi3SlaveBase, Fmi3Variability, ModelExchange

class Decay(Fmi3SlaveBase, ModelExchange):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.time, self.k, self.x, self.derx = 0.0, 2.0, 1.0, 0.0
        continuous = Fmi3Variability.continuous
        self.register_variable(Float64("time", causality=Fmi3Causality.independent, variability=continuous))
        self.register_variable(
            Float64("x", causality=Fmi3Causality.output, start=1, variability=continuous, initial=Fmi3Initial.exact)
        )
        self.register_variable(Float64("derx", causality=Fmi3Causality.local, variability=continuous, derivative=1))
        self.register_variable(Float64("k", causality=Fmi3Causality.parameter, variability=Fmi3Variability.tunable))

    def get_continuous_state_derivatives(self):
        self.derx = -self.k * self.x
        return [self.derx]
"""


def build(text: str, version: str, folder: Path) -> ac.fmi.Fmu:
    """A unit around a class."""
    # a name of its own: the class is imported into this process
    script = folder / f"{folder.name}_{version[0]}.py"
    script.write_text(text)
    if version == "2.0":
        builder = pytest.importorskip("pythonfmu.builder")
    else:
        builder = pytest.importorskip("pythonfmu3.builder")
    return ac.fmi.load(builder.FmuBuilder.build_FMU(script, dest=folder))


@pytest.fixture(scope="module")
def lags(tmp_path_factory):
    return {v: build(t, v, tmp_path_factory.mktemp(f"lag{v[0]}_")) for v, t in (("2.0", LAG_2), ("3.0", LAG_3))}


class Swing(Component):
    """``y'' = -4 y + u``, 1 at first."""

    u: Input = Input()
    y: ac.Output = ac.Output(start=1.0, fixed=True)
    v: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.y) == self.v
        yield der(self.v) == -4 * self.y + self.u


@BOTH
def test_a_lag_of_python(lags, version):
    """Alone with its start values; parameters of three types."""
    lag = lags[version]
    assert lag.version == version and lag.kinds == ("cs",)
    with CoSimulation({"lag": lag.participant(parameters={"tau": 0.25, "parts": 2000})}, [], step=0.1) as master:
        result = master.simulate(1.0)
    np.testing.assert_allclose(result["y"], 0.5 + 0.5 * np.exp(-result.t / 0.25), atol=1e-3)
    with CoSimulation({"lag": lag.participant(parameters={"off": 1})}, [], step=0.1) as master:
        with pytest.raises(CoSimulationError, match=r"participant `Lag` \(Lag\.fmu\) could not advance from t = 0 s"):
            master.simulate(1.0)


@BOTH
def test_coupled_with_a_system(lags, version):
    """y'' = -4 y + w, 0.5 w' = y - w, against one system."""

    class Whole(Component):
        swing: Swing = Swing()
        tau: Parameter = Parameter(0.5)
        w: Variable = Variable(start=1.0, fixed=True)

        def equations(self) -> Equations:
            yield self.swing.u == self.w
            yield self.tau * der(self.w) == self.swing.y - self.w

    parts = {"swing": ac.compile(Swing()), "lag": lags[version]}
    links = [("swing.y", "lag.u"), ("lag.y", "swing.u")]
    with CoSimulation(parts, links, step=0.01) as master:
        result = master.simulate(2.0)
    whole = ac.compile(Whole()).simulate(2.0, saveat=result.t, rtol=1e-9)
    np.testing.assert_allclose(result["swing.y"], whole["swing.y"], atol=2e-3)


@BOTH
def test_what_a_unit_cannot(lags, version):
    with pytest.raises(FmuError, match=r"Lag\.fmu does not offer model exchange; use it in a co-simulation"):
        lags[version].component()
    parts = {"lag": lags[version]}
    if not lags[version].participant().can_reject:
        with pytest.raises(CoSimulationError, match=r"`lag` cannot save its state"):
            CoSimulation(parts, [], iterations=3)


def test_model_exchange_of_python(tmp_path):
    """FMI 3.0 without directional derivatives: a component, and its sensitivity by differences."""
    unit = build(DECAY_3, "3.0", tmp_path)
    assert unit.kinds == ("me",) and not unit.directional
    solution = ac.compile(unit.component(parameters={"k": 3.0})).simulate(1.0, saveat=11, rtol=1e-8)
    np.testing.assert_allclose(solution["x"], np.exp(-3 * solution.t), atol=1e-6)


# ---- OpenModelica ---------------------------------------------------------------------------------
def gemseo(name: str) -> ac.fmi.Fmu:
    found = importlib.util.find_spec("gemseo_fmu")
    if found is None or found.origin is None:
        pytest.skip("gemseo-fmu is not installed")
    path = Path(found.origin).parent / "problems" / "fmu_files" / "linux" / f"{name}.fmu"
    if not path.exists():
        pytest.skip(f"no {name}")
    return ac.fmi.load(path)


def test_two_halves_made_by_openmodelica():
    """Two masses and springs as two units, against the unit of the whole."""
    parameters = {"1": {"m1": 1.0, "k1": 1.0, "k2": 1.0}, "2": {"m2": 1.0, "k2": 1.0, "k3": 1.0}}
    halves = {f"h{k}": gemseo(f"MassSpringSubSystem{k}") for k in ("1", "2")}
    feeds = {
        f"h{k}.{n}": v for k, values in parameters.items() for n, v in values.items()
        if n in halves[f"h{k}"].names("input")
    }  # fmt: skip
    links = [("h1.x1", "h2.x1"), ("h2.x2", "h1.x2")]
    with CoSimulation(halves, links, inputs=feeds, step=0.01) as master:
        split = master.simulate(5.0)
    whole = gemseo("MassSpringSystem")
    given = {f"w.{n}": 1.0 for n in ("m1", "m2", "k1", "k2", "k3") if n in whole.names("input")}
    with CoSimulation({"w": whole.participant(outputs=["x1", "x2"])}, [], inputs=given, step=0.01) as master:
        one = master.simulate(5.0)
    assert np.ptp(one["w.x1"]) > 0.1
    for name in ("x1", "x2"):
        np.testing.assert_allclose(split[f"h{name[1]}.{name}"], one[f"w.{name}"], atol=0.02)


def test_a_unit_of_fmi_3_made_elsewhere():
    with CoSimulation({"u": gemseo("FMU3Model")}, [], step=0.1) as master:
        assert np.isfinite(master.simulate(0.5)["output"]).all()


# ---- Reference-FMUs -------------------------------------------------------------------------------
def reference(name: str, version: str) -> ac.fmi.Fmu:
    folder = os.environ.get("REFERENCE_FMUS")
    if folder is None:
        pytest.skip("REFERENCE_FMUS is not set")
    return ac.fmi.load(Path(folder) / version / f"{name}.fmu")


class VanDerPol(Component):
    x0: Variable = Variable(start=2.0, fixed=True)
    x1: Variable = Variable(start=0.0, fixed=True)

    def equations(self) -> Equations:
        yield der(self.x0) == self.x1
        yield der(self.x1) == (1 - self.x0**2) * self.x1 - self.x0


@BOTH
def test_reference_van_der_pol(version):
    unit = reference("VanDerPol", version)
    solution = ac.compile(unit.component()).simulate(5.0, saveat=51, rtol=1e-8)

    exact = ac.compile(VanDerPol()).simulate(5.0, saveat=51, rtol=1e-10)
    np.testing.assert_allclose(solution["x0"], exact["x0"], atol=1e-5)
    with CoSimulation({"u": unit}, [], step=0.1) as master:
        result = master.simulate(5.0)  # its own solver is Euler's method, at 0.01 s
    np.testing.assert_allclose(result["x0"], exact["x0"], atol=0.1)


@BOTH
def test_reference_bouncing_ball(version):
    unit = reference("BouncingBall", version)
    with pytest.raises(FmuError, match="has state events"):
        unit.component()
    with CoSimulation({"ball": unit}, [], step=0.01) as master:
        result = master.simulate(1.0)
    drop = np.sqrt(2 / 9.81)
    flying = result.t < drop - 0.01
    np.testing.assert_allclose(result["h"][flying], 1 - 4.905 * result.t[flying] ** 2, atol=0.05)
    assert result["h"].min() > -0.05 and result["v"].max() > 2.0


def test_reference_units_with_a_step_of_their_own():
    with CoSimulation({"u": reference("Stair", "3.0")}, [], step=0.1) as master:
        with pytest.raises(CoSimulationError, match=r"its own steps are 0\.2 s long: take multiples of them"):
            master.simulate(1.0)
    with CoSimulation({"u": reference("Stair", "3.0")}, [], step=0.2) as master:
        assert master.simulate(1.0).t[-1] == pytest.approx(1.0)


def test_reference_arrays_are_refused():
    with pytest.raises(FmuError, match=r"StateSpace\.fmu has states in arrays"):
        reference("StateSpace", "3.0").component()
    with pytest.raises(FmuError, match=r"StateSpace\.fmu: `y` is an array; signals are real numbers"):
        reference("StateSpace", "3.0").participant(outputs=["y"])


@BOTH
def test_reference_derivatives(version):
    """A gradient through the unit's directional derivatives equals that of the same equations."""
    import jax

    unit = reference("VanDerPol", version)
    assert unit.directional

    def end(system, x0):
        return system.simulate(2.0, saveat=[2.0], rtol=1e-9, initial={"x0": x0}, engine="diffrax")["x0"][-1]

    found, wanted = (jax.grad(lambda x, s=s: end(s, x))(2.1) for s in map(ac.compile, (unit.component(), VanDerPol())))
    assert abs(wanted) > 1.0
    np.testing.assert_allclose(found, wanted, rtol=1e-8)


@BOTH
def test_reference_types(version):
    """Discrete inputs of a component keep what they are given; signals of other types are refused by name."""
    unit = reference("Feedthrough", version)
    system = ac.compile(unit.component(parameters={"Float64_discrete_input": 2.5}))
    solution = system.simulate(1.0, saveat=3, inputs={"Float64_continuous_input": 1.5})
    assert (solution["Float64_continuous_output"] == 1.5).all() and (solution["Float64_discrete_output"] == 2.5).all()
    feeds = {"u.Float64_continuous_input": lambda t: t, "u.Float64_discrete_input": 3.0}
    with CoSimulation({"u": unit}, [], inputs=feeds, step=0.1) as master:
        result = master.simulate(1.0)
    np.testing.assert_allclose(result["Float64_continuous_output"], result.t, atol=0.06)
    assert result["Float64_discrete_output"][-1] == 3.0
    with pytest.raises(FmuError, match=r"Feedthrough\.fmu: `String_output` is of type String; signals are real"):
        unit.participant(outputs=["String_output"])


def test_reference_scheduled_execution_is_refused():
    with pytest.raises(FmuError, match=r"Clocks\.fmu offers scheduled execution only"):
        reference("Clocks", "3.0")
