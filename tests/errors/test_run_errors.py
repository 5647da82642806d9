"""Errors of a run: names, parameters, initial conditions, values that are not finite."""

from __future__ import annotations

import math
import re
from functools import cache
from pathlib import Path
from textwrap import dedent
from typing import Any

import jax.numpy as jnp
import numpy as np
import pytest

import acausal as ac

from .user import error_of

UNKNOWN = {
    "parameter": (
        """
        ac.compile(RC()).simulate(1.0, parameters={"resistor.r": 1.0})
        """,
        ["no parameter `resistor.r`", "Did you mean `resistor.R`"],
    ),
    "initial": (
        """
        ac.compile(RC()).simulate(1.0, initial={"capacitor.V": 1.0})
        """,
        ["no variable `capacitor.V`", "`capacitor.v`"],
    ),
    "a variable as a parameter": (
        """
        ac.compile(RC()).simulate(1.0, parameters={"resistor.v": 1.0})
        """,
        ["`resistor.v` is a variable, not a parameter"],
    ),
    "input": (
        """
        ac.compile(RC(), inputs=("u",))
        """,
        ["`u` is not an `Input` of the model `RC` itself"],
    ),
    "output": (
        """
        ac.compile(RC(), outputs=("resistor.V",))
        """,
        ["no variable `resistor.V`", "`resistor.v`"],
    ),
    "result": (
        """
        ac.compile(RC()).simulate(1.0)["capacitor.q"]
        """,
        ["no variable `capacitor.q`"],
    ),
    "index": (
        """
        class M(Component):
            r: Array[Resistor] = Array(Resistor(), 3)
            g: Ground = Ground()

            def equations(self):
                yield connect(self.r.p, self.g.p)
                yield connect(self.r.n, self.g.p)

        ac.compile(M()).index_of("r[3].v")
        """,
        ["no variable `r[3].v`", "`r[0].v`"],
    ),
}


@pytest.mark.parametrize("name", UNKNOWN)
def test_unknown_names(name: str, tmp_path: Path) -> None:
    text, words = UNKNOWN[name]
    error = error_of(tmp_path, text, ac.UnknownNameError, words)
    assert isinstance(error, KeyError)


class Lag(ac.Component):
    u: ac.Input = ac.Input()
    x: ac.Variable = ac.Variable(start=1.0, fixed=True)
    tau: ac.Parameter = ac.Parameter(1.0)
    many: ac.Vector = ac.Vector(ac.Parameter(), (1.0, 2.0))

    def equations(self) -> ac.Equations:
        yield ac.der(self.x) == (self.u - self.x) / self.tau


ARGUMENTS: dict[str, tuple[dict[str, Any], str]] = {
    "a text for a parameter": ({"parameters": {"tau": "2.0"}}, "parameters={'tau': ...}) is '2.0'; give a number"),
    "nothing for a parameter": ({"parameters": {"tau": None}}, "parameters={'tau': ...}) is None; give a number"),
    "two values for one parameter": ({"parameters": {"tau": [1, 2]}}, "values of shape (2,), but has one value"),
    "three values for two": ({"parameters": {"many": [1, 2, 3]}}, "values of shape (3,), but has shape (2,)"),
    "pairs": ({"parameters": [("tau", 1.0)]}, "`parameters` is a list; give a dict"),
    "an object as a name": ({"parameters": {Lag().tau: 1.0}}, "the key Expr(tau); the keys are dotted names"),
    "a start that is no number": ({"initial": {"x": np.nan}}, "initial={'x': ...}) is nan; a start value is finite"),
    "an input as a start": ({"initial": {"u": 1.0}}, "`u` is an input: its value has its place in simulate(inputs="),
    "text as an input": ({"inputs": {"u": "abc"}}, "input `u` is 'abc'; give a number, a pair (times, values)"),
    "a table that does not fit": (
        {"inputs": {"u": ([0, 1], [0, 1, 2])}},
        "times of shape (2,) and values of shape (3,)",
    ),
    "times that go back": ({"inputs": {"u": ([1, 0], [0, 1])}}, "times of the input `u` must increase"),
    "a function without time": ({"inputs": {"u": lambda: 1.0}}, "`u` is a function that does not take the time alone"),
    "a function of math": ({"inputs": {"u": lambda t: math.sin(t)}}, "JAX cannot follow"),
    "a function with a vector": ({"inputs": {"u": lambda t: jnp.ones(2) * t}}, "an array of shape (2,), not a number"),
    "no end": ({"t1": np.inf}, "`t1` is inf; give a finite time in seconds"),
    "text as an end": ({"t1": "1"}, "`t1` is '1'; give a finite time in seconds"),
    "negative tolerance": ({"rtol": -1e-6}, "`rtol` is -1e-06; it cannot be negative"),
    "no tolerance": ({"rtol": 0.0}, "`rtol` and `atol` are both 0"),
    "a step back": ({"solver": "rk4", "dt": -0.1}, "`dt` is -0.1; it cannot be negative"),
    "no step": ({"solver": "rk4", "dt": 0.0}, "`dt` = 0: a step takes time"),
    "no steps": ({"max_steps": 0}, "`max_steps` is 0, not a number of steps"),
    "output beyond the end": ({"saveat": [0.5, 2.0]}, "`saveat` has the time 2 s, outside of the run from 0 s to 1 s"),
    "output that goes back": ({"saveat": [0.5, 0.2]}, "`saveat` has the time 0.2 s behind 0.5 s"),
    "no output": ({"saveat": []}, "`saveat` is []; give a number of output times"),
    "an interval of output": ({"saveat": 0.1}, "`saveat` is 0.1; give a number of output times (an int)"),
    "no solver": ({"solver": "cvode"}, "There is no solver 'cvode'; there are 'rodas5p', 'rk4', 'adams'"),
    "no events": ({"events": "no"}, "`events` is 'no'; give True, False, or a `diffrax.Event`"),
}


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize("name", ARGUMENTS)
def test_arguments_are_looked_at_before_the_run(name: str, engine: Any) -> None:
    options, words = ARGUMENTS[name]
    with pytest.raises(ac.AcausalError, match=re.escape(words)):
        lag().simulate(**{"t1": 1.0, "engine": engine, **options})


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_driven_run_that_fails_names_its_equation(engine: Any) -> None:
    with pytest.raises(ac.SimulationError, match=re.escape("der(x) = (u - x)/tau")):
        lag().simulate(1.0, inputs={"u": 2.0}, parameters={"tau": 0.0}, engine=engine)


@cache
def lag() -> ac.System:
    return ac.compile(Lag())


def test_parameter_without_value(tmp_path: Path) -> None:
    text = """
        class M(Component):
            k: Parameter = Parameter(unit="1/s")  # HERE
            x: Variable = Variable(start=1.0, fixed=True)

            def equations(self):
                yield der(self.x) == self.k * self.x

        ac.compile(M()).simulate(1.0)
        """
    error_of(tmp_path, text, ac.InitializationError, ["`k` [1/s]", "no value", "simulate(parameters={...})"])


def test_parameter_out_of_bounds_at_simulate(tmp_path: Path) -> None:
    text = PARAMETER_LINE + 'ac.compile(RC(resistor=Bounded())).simulate(1.0, parameters={"resistor.k": -1.0})\n'
    words = ["`resistor.k` [1] = -1 lies outside its bounds [0, 5]"]
    error_of(tmp_path, text, ac.DeclarationError, words)
    dependent = text.replace('"resistor.k": -1.0', '"resistor.base": 9.0')
    error_of(tmp_path, dependent, ac.DeclarationError, ["`resistor.k` [1] = 18 lies outside"])


def test_a_library_component_out_of_bounds_is_found_where_it_is_declared(tmp_path: Path) -> None:
    """Limits the wrong way round are seen deep in a controller: the message names the user's own field."""
    text = """
        from acausal.components import blocks

        class Loop(Component):
            wanted: blocks.Constant = blocks.Constant(k=1.0)
            control: blocks.LimPID = blocks.LimPID(yMax=1.0, yMin=2.0)  # HERE
            plant: blocks.FirstOrder = blocks.FirstOrder(T=1.0)

            def equations(self) -> Equations:
                yield connect(self.wanted.y, self.control.u_s)
                yield connect(self.control.y, self.plant.u)
                yield connect(self.plant.y, self.control.u_m)

        ac.compile(Loop()).simulate(1.0)
        """
    words = ["`control.limiter.span` = -1 lies outside its bounds [0, inf] (upper", "Written in:"]
    error_of(tmp_path, text, ac.DeclarationError, words)


PARAMETER_LINE = """\
class Bounded(Resistor):
    base: Parameter = Parameter(1.0)
    k: Parameter = Parameter(2 * base, unit="1", min=0.0, max=5.0)  # HERE

"""

INITIAL = {
    "two fixed values that contradict": (
        """
        class M(Component):
            x: Variable = Variable(start=1.0, fixed=True)  # HERE
            y: Variable = Variable(start=3.0, fixed=True)  # HERE

            def equations(self):
                yield der(self.x) == -self.x
                yield self.y == 2 * self.x

        MODEL = M
        """,
        ["`y` has the fixed start value 3, but the other conditions give 2", "x = 1", "fixed=True"],
    ),
    "an initial equation against a fixed value": (
        """
        class M(Component):
            x: Variable = Variable(start=1.0, fixed=True)  # HERE

            def equations(self):
                yield der(self.x) == -self.x

            def initial_equations(self):
                yield self.x == 4  # HERE

        MODEL = M
        """,
        ["x = 4", "Held exactly (fixed start values): x = 1"],
    ),
    "two charged capacitors in parallel": (
        """
        class M(Component):
            a: Capacitor = Capacitor(v=start(1.0, fixed=True))  # HERE
            b: Capacitor = Capacitor(v=start(2.0, fixed=True))  # HERE
            g: Ground = Ground()

            def equations(self):
                yield connect(self.a.p, self.b.p)
                yield connect(self.a.n, self.b.n, self.g.p)

        MODEL = M
        """,
        ["has the fixed start value", "but the other conditions give"],
    ),
    "an algebraic equation without solution": (
        """
        class M(Component):
            x: Variable = Variable(start=1.0, fixed=True)
            y: Variable = Variable()

            def equations(self):
                yield der(self.x) == -self.x
                yield self.y**2 + self.x + 2 == ac.sin(self.y)  # HERE

        MODEL = M
        """,
        ["the equations that determine `y`", "better guesses"],
    ),
}


@pytest.mark.parametrize("name", INITIAL)
def test_inconsistent_initial_conditions(name: str, tmp_path: Path) -> None:
    text, words = INITIAL[name]
    run = "ac.compile(MODEL()).simulate(1.0)\n"
    error_of(tmp_path, dedent(text) + run, ac.InitializationError, [*words, "found no consistent start", "Try:"])
    check = "system = ac.compile(MODEL())\nsystem.check_initial(*system.initialize_with_residual(0.0, None, None))\n"
    error_of(tmp_path, dedent(text) + check, ac.InitializationError, words)


class Doubled(ac.Component):
    """Two names that follow from x, one of them an alias."""

    x: ac.Variable = ac.Variable(start=1.0)
    y: ac.Variable = ac.Variable()
    minus: ac.Variable = ac.Variable()

    def equations(self) -> ac.Equations:
        yield ac.der(self.x) == -self.x
        yield self.y == 2 * self.x + 1
        yield self.minus == -self.x


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.parametrize(("initial", "words"), [
    ({"x": 1.0, "y": 5.0}, ["`y` has the value 5 from simulate(initial={...}), but the other conditions give 3",
                            "Held exactly (fixed start values): x = 1", "or names in `initial=`"]),
    ({"x": 1.0, "minus": 2.0}, ["`x` and `minus` values that are not opposite, as they are in this model"]),
])  # fmt: skip
def test_start_values_that_contradict_each_other(engine: Any, initial: Any, words: list[str]) -> None:
    with pytest.raises(ac.InitializationError) as caught:
        ac.compile(Doubled()).simulate(1.0, initial=initial, engine=engine)
    assert all(word in str(caught.value) for word in words), str(caught.value)


def test_start_values_that_agree() -> None:
    agreed = ac.compile(Doubled()).simulate(1.0, initial={"x": 1.0, "minus": -1.0}, saveat=2)
    assert agreed["x"][0] == 1.0
    other = ac.compile(Doubled()).simulate(1.0, initial={"y": 5.0}, saveat=2)
    assert abs(other["x"][0] - 2.0) < 1e-9


BAD_RUN = """\
class M(Component):
    x: Variable = Variable(start=1.0, fixed=True)
    z: Variable = Variable(start=1.0, fixed=True)
    y: Variable = Variable()

    def equations(self) -> Equations:
        yield der(self.x) == -1
        yield self.y == ac.log(self.x)  # HERE
        yield der(self.z) == self.y


"""


def test_nan_in_the_run(tmp_path: Path) -> None:
    words = ["stopped at t = 1 s of 2 s", "der(z) is nan", "y = log(x)", "It comes from:"]
    error_of(tmp_path, BAD_RUN + "ac.compile(M()).simulate(2.0)\n", ac.SimulationError, words)


def test_nan_at_the_start(tmp_path: Path) -> None:
    words = ["stopped at t = 0 s of 2 s", "der(z) is nan", "y = log(x)", "x = -1"]
    error_of(tmp_path, BAD_RUN + "ac.compile(M(x=start(-1.0))).simulate(2.0)\n", ac.SimulationError, words)


def test_a_point_that_is_finite_has_no_culprit(tmp_path: Path) -> None:
    from ..language.parts import RC

    system = ac.compile(RC())
    x0, w0, p = system.initialize()
    assert system.diagnose_nonfinite(0.0, x0, w0, p) is None


def test_a_misspelt_option_is_refused(tmp_path: Path) -> None:
    """Else a run with the default values would pass for one with those given."""
    for engine in ("auto", "diffrax"):
        text = f"ac.compile(RC()).simulate(1.0, engine={engine!r}, parametres={{}})\n"
        error_of(tmp_path, text, TypeError, ["unexpected keyword argument 'parametres'"])


def test_no_solution_behind_an_event(tmp_path: Path) -> None:
    text = """
    class M(Component):
        c: Variable = Variable(start=1.0)
        y: Variable = Variable(start=1.0)
        x: Variable = Variable(start=0.0, fixed=True)

        def equations(self):
            yield der(self.x) == self.y
            yield self.y**2 + self.y / 10 == where(ac.time < 0.5, 1, -self.x)  # HERE
            yield self.c == self.y


    ac.compile(M()).simulate(1.0, engine="native")
    """
    words = ["At t = 0.5 s the equations have no solution", "Not met:", "der(x)**2", "where(time < 0.5, 1, -x)"]
    error_of(tmp_path, dedent(text), ac.SimulationError, words)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_a_root_that_ends_names_its_equation(engine: str, tmp_path: Path) -> None:
    """``z^2 = x`` with x through zero: the equation determines nothing at x = 0, and has no root behind it."""
    text = f"""
    class M(Component):
        x: Variable = Variable(start=1.0, fixed=True)
        z: Variable = Variable(start=1.0)

        def equations(self) -> Equations:
            yield der(self.x) == -1
            yield self.z**2 == self.x  # HERE


    ac.compile(M()).simulate(2.0, engine={engine!r})
    """
    words = ["stopped at t = 1 s of 2 s", "These equations have no solution for `z` there:", "z**2 = x"]
    error_of(tmp_path, dedent(text), ac.SimulationError, words)


def test_a_mode_that_leaves_an_unknown_undetermined(tmp_path: Path) -> None:
    """An ideal diode without any resistance beside capacitors: conducting, its equation has no unknown."""
    text = """
    from acausal.components import electrical as el
    from acausal.components.examples import assemble

    model = assemble(
        "source.p - coil.p", "coil.n - diode.p - first.p", "diode.n - second.p",
        "source.n - first.n - second.n - ground.p", source=el.SineVoltage(V=5.0, f=1.0), coil=el.Inductor(L=0.1),
        first=el.Capacitor(C=0.1, v=start(0.0, fixed=True)), second=el.Capacitor(C=0.2, v=start(1.0, fixed=True)),
        diode=el.IdealDiode(Ron=0.0, Goff=0.0), ground=el.Ground(),
    )
    ac.compile(model).simulate(2.0, engine="native")
    """
    words = ["singular", "its equation does not depend on it", "diode.Ron = 0"]
    error_of(tmp_path, dedent(text), ac.SimulationError, words)
