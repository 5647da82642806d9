"""Errors of declarations, modifications and equations: the field, the class and the user's line are named."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

import acausal as ac
from acausal.components import rotational, translational

from .user import error_of

CASES = {
    "misspelt modification": (
        """
        RC(resitor=Resistor())  # HERE
        """,
        ["`RC` has no field `resitor`", "Did you mean `resistor`"],
    ),
    "misspelt modification in a class body": (
        """
        class Board(Component):
            rc: RC = RC(resistor=Resistor(r=2.0))  # HERE
        """,
        ["`Resistor` has no field `r`", "Did you mean `R`"],
    ),
    "no name is near": (
        """
        Resistor(voltage=2.0)  # HERE
        """,
        ["no field `voltage`", "It has: v, i, R, p, n"],
    ),
    "misspelt path": (
        """
        ac.redeclare(RC(), {"resitor": Resistor()})  # HERE
        """,
        ["`RC` has no field `resitor`", "`resistor`"],
    ),
    "wrong replacement type": (
        """
        RC(resistor=Ground())  # HERE
        """,
        ["`RC.resistor` is declared as `TwoPin`", "not `Ground`"],
    ),
    "a class instead of an instance": (
        """
        RC(resistor=Resistor)  # HERE
        """,
        ["class `Resistor` itself (call it)"],
    ),
    "a number instead of a component": (
        """
        RC(resistor=3.0)  # HERE
        """,
        ["`TwoPin`", "not `float`"],
    ),
    "text instead of a number": (
        """
        Resistor(R="3")  # HERE
        """,
        ["Resistor(R='3')", "not `str`"],
    ),
    "text instead of a start value": (
        """
        Resistor(v="3")  # HERE
        """,
        ["`v=start(2.0, fixed=True)`"],
    ),
    "matrices that do not fit, found when the equations are made": (
        """
        from acausal.components import blocks

        class M(Component):
            plant: blocks.StateSpace = blocks.StateSpace(A=[[0, 1], [-4, 0]], B=[[1]], C=[[1, 0]])  # HERE

        ac.compile(M())
        """,
        ["B=((1.0,),) should have 2 rows of 1 numbers", "Written in:\n    plant: blocks.StateSpace = "],
    ),
    "a whole model that is no table": (
        """
        from acausal.components import blocks

        ac.compile(blocks.TimeTable(table=[[0, 1], [-1, 2]]))  # HERE
        """,
        ["whose first coordinate increases"],
    ),
    "fewer values than an array has elements": (
        """
        class M(Component):
            r: Array[Resistor] = Array(Resistor(), 3)  # HERE

        ac.compile(M(r=Resistor(R=[1.0, 2.0])))
        """,
        ["component array `r.R` has 3 elements but was given 2 values"],
    ),
    "a list that is shorter than the array": (
        """
        class M(Component):
            n: int = 3
            r: Array[Resistor] = Array(Resistor(), "n")  # HERE

        ac.compile(M(r=[Resistor(), Resistor()]))
        """,
        ["a list of 2 components in the place of an array of 3: its length is 'n'"],
    ),
    "an error of Python in equations": (
        """
        class M(Component):
            rows: tuple[tuple[float, ...], ...] = ((0.0, 1.0), (1.0, 2.0))
            x: Variable = Variable()

            def equations(self):
                yield self.x == self.rows[2][0]  # HERE

        ac.compile(M())
        """,
        ["in `M.equations`", "tuple index out of range", "yield self.x == self.rows[2][0]"],
    ),
    "reinit of what is no state": (
        """
        class M(Component):
            x: Variable = Variable(start=1.0, fixed=True)
            y: Variable = Variable()

            def equations(self):
                yield der(self.x) == -self.x
                yield self.y == 2 * self.x
                yield when(self.x < 0.5, reinit(self.y, 3.0))  # HERE

        ac.compile(M())
        """,
        ["reinit of `y`, which is no state", "states are `x`"],
    ),
    "reinit of what is zero": (
        """
        class M(Component):
            x: Variable = Variable(start=1.0, fixed=True)
            y: Variable = Variable()

            def equations(self):
                yield der(self.x) == -self.x
                yield self.y == 0
                yield when(self.x < 0.5, reinit(self.y, 3.0))  # HERE

        ac.compile(M())
        """,
        ["reinit of `y`, which is no state", "make it zero"],
    ),
    "a list instead of a number": (
        """
        class M(Component):
            r: Resistor = Resistor(R=[1.0, 2.0])

        ac.compile(M())
        """,
        ["`r.R` is one parameter but was given 2 values", "Array(component, n, R=[...])"],
    ),
    "a list as the start of one variable": (
        """
        class M(Component):
            c: Capacitor = Capacitor(v=start((0.0, 0.0, 0.0), fixed=True))

        ac.compile(M())
        """,
        ["`c.v` is one variable, but its start was given 3 values"],
    ),
    "values of an array for a field that is not there": (
        """
        class M(Component):
            r: Array[Resistor] = Array(Resistor(), 2, r=[1.0, 2.0])  # HERE
        """,
        ["Array(Resistor(), 2, r=...)", "`Resistor` has no field `r`", "Did you mean `R`"],
    ),
    "plain float field": (
        """
        class M(Component):  # HERE
            R: float = 3.0
        """,
        ["`M.R: float = 3.0` is a plain float", "Parameter(3.0)"],
    ),
    "a class in the place of an instance": (
        """
        class M(Component):  # HERE
            R: Component = Resistor
        """,
        ["`M.R = Resistor` is a class, a field holds an instance: write `Resistor()`"],
    ),
    "a parameter that is to be found, in a class body": (
        """
        class M(Component):  # HERE
            R: Parameter = Parameter(start(1.0, fixed=False))
        """,
        ["parameter `M.R`: a class declares a value", "where the component is made, `M(R=start(guess, fixed=False))`"],
    ),
    "a parameter that is a text": (
        """
        class M(Component):  # HERE
            R: Parameter = Parameter("1.0")
        """,
        ["parameter `M.R`: its value '1.0' is no number"],
    ),
    "a type without a value": (
        """
        class M(Component):  # HERE
            R: Parameter
        """,
        ["field `M.R` has a type but no value", "`R: Parameter = ...`"],
    ),
    "partial class": (
        """
        class Ideal(TwoPin, partial=True):  # HERE
            pass

        class M(RC):
            resistor: TwoPin = Ideal()

        ac.compile(M())
        """,
        ["`resistor` is an instance of the partial class `Ideal`", "one of its subclasses"],
    ),
    "missing super().equations()": (
        """
        class Cheap(TwoPin):
            def equations(self) -> Equations:  # HERE
                yield self.v == 2

        ac.compile(RC(resistor=Cheap()))
        """,
        ["`Cheap.equations` never runs `super().equations()`", "`TwoPin` are lost", "yield from super().equations()"],
    ),
    "super().equations() without yield from": (
        """
        class Cheap(TwoPin):
            def equations(self) -> Equations:  # HERE
                super().equations()
                yield self.v == 2

        ac.compile(RC(resistor=Cheap()))
        """,
        ["never runs `super().equations()`"],
    ),
    "equations returns a list": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):  # HERE
                return [self.x == 3]

        ac.compile(M())
        """,
        ["`M.equations` must be a generator", "do not return list"],
    ),
    "an expression instead of an equation": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x - 3  # HERE

        ac.compile(M())
        """,
        ["`M.equations` yields Expr(x - 3)", "yield `lhs == rhs`"],
    ),
    "a Python bool instead of an equation": (
        """
        class M(Component):
            n: int = 3

            def equations(self):
                yield self.n == 3  # HERE

        ac.compile(M())
        """,
        ["`M.equations` yields True", "one side of `==` must be a variable", "are joined with `connect(a, b)`"],
    ),
    "if on an expression": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                if self.x > 0:  # HERE
                    yield self.x == 1

        ac.compile(M())
        """,
        ["in `M.equations`", "truth value of the expression `x > 0`", "where(condition, a, b)"],
    ),
    "bool of an equation": (
        """
        class M(Component):
            x: Variable = Variable()
            y: Variable = Variable()

            def equations(self):
                assert self.x == self.y  # HERE
                yield self.x == 1

        ac.compile(M())
        """,
        ["`x = y` is an equation, which is neither true nor false", "yield it from equations()"],
    ),
    "and between conditions": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x == ac.where(self.x > 0 and self.x < 1, 1, 0)  # HERE

        ac.compile(M())
        """,
        ["`&` and `|` instead of `and` and `or`"],
    ),
    "conditions without parentheses": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x == ac.where(self.x > 0 & self.x < 1, 1, 0)  # HERE

        ac.compile(M())
        """,
        ["`&` joins conditions, and 0 is a number", "(a > 0) & (b > 0), each comparison in parentheses"],
    ),
    "a number is no condition": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x == ac.where(self.x < self.x | 3, 1, 0)  # HERE

        ac.compile(M())
        """,
        ["`|` joins conditions, and 3 is a number", "(a > 0) | (b > 0)"],
    ),
    "a connector in an equation": (
        """
        class M(Component):
            x: Variable = Variable()
            r: Resistor = Resistor()

            def equations(self):
                yield self.x == self.r.p  # HERE

        ac.compile(M())
        """,
        ["Pin cannot stand in an equation", "`self.port.p`"],
    ),
    "a function of math": (
        """
        import math
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x == math.sin(self.x)  # HERE

        ac.compile(M())
        """,
        ["`x` is a symbol, not a number", "acausal.sin"],
    ),
    "a function of numpy": (
        """
        import numpy as np
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield self.x == np.sin(self.x)  # HERE

        ac.compile(M())
        """,
        ["`x` is a symbol, not an array", "acausal.sin"],
    ),
    "a field that is not there": (
        """
        class M(Component):
            r: Resistor = Resistor()

            def equations(self):
                yield self.r.p.V == 3  # HERE

        ac.compile(M())
        """,
        ["component `r.p` of class `Pin` has no field `V`", "Did you mean `v`"],
    ),
    "a model that is not compiled": (
        """
        Resistor().simulate(1.0)  # HERE
        """,
        ["component of class `Resistor` has no field `simulate`", "Compile the model first: `ac.compile(model)` gives"],
    ),
    "an export of a model that is not compiled": (
        """
        from acausal.fmi import export

        export(Resistor(), "resistor.fmu")  # HERE
        """,
        ["component of class `Resistor` has no field `located`", "Compile the model first: `ac.compile(model)` gives"],
    ),
    "self forgotten": (
        """
        class M(Component):
            x: Variable = Variable()
            k: Parameter = Parameter(1.0)

            def equations(self):
                yield self.x == M.k  # HERE

        ac.compile(M())
        """,
        ["`k` in equations() is the declaration of the class", "`self.k`"],
    ),
    "unknown inner": (
        """
        class World(Component):
            g: Parameter = Parameter(9.81)

        class Body(Component):  # HERE
            world: World = ac.outer(World())
            x: Variable = Variable()

            def equations(self):
                yield self.x == self.world.g

        class M(Component):
            body: Body = Body()

        ac.compile(M())
        """,
        ["`body.world` is declared `outer`", "`world: World = ac.inner(World())`"],
    ),
    "parameter out of bounds": (
        """
        Resistor(R=-1.0)  # HERE
        """,
        ["parameter `Resistor.R` = -1.0 lies outside its bounds [0.0, inf]"],
    ),
    "parameter that is NaN": (
        """
        Resistor(R=float("nan"))  # HERE
        """,
        ["parameter `Resistor.R` is NaN"],
    ),
    "an expression outside a class body": (
        """
        class M(Component):
            k: Parameter = Parameter(1.0)

        ac.compile(M(k=2 * ac.time))
        """,
        ["`k` of the model was given the expression `2*time`", "give numbers"],
    ),
    "a parameter of another class": (
        """
        class M(Component):  # HERE
            r: Resistor = Resistor(R=Source.V)

        ac.compile(M())
        """,
        ["refers to `V`, which is not a field of that class"],
    ),
    "two new values in one when": (
        """
        class M(Component):
            x: Variable = Variable(start=-1.0, fixed=True)

            def equations(self):
                yield der(self.x) == 1.0
                yield when(self.x > 0, reinit(self.x, 3.0), {self.x: 4.0})  # HERE

        ac.compile(M())
        """,
        ["`when` gives `x` two new values at the same moment", "`elsewhen`"],
    ),
    "one discrete variable twice in one when": (
        """
        class M(Component):
            d: Discrete = Discrete()

            def equations(self):
                yield when(ac.time > 1, {self.d: 3.0}, {self.d: 4.0})  # HERE

        ac.compile(M())
        """,
        ["`when` gives `d` two new values at the same moment"],
    ),
    "when in when": (
        """
        class M(Component):
            d: Discrete = Discrete()

            def equations(self):
                yield when(ac.time > 1, when(ac.time > 2, {self.d: 4.0}))  # HERE

        ac.compile(M())
        """,
        ["when(condition, ...) takes dicts {variable: value}, reinit(...) and terminate(...)"],
    ),
    "index beyond an array": (
        """
        class M(Component):
            r: Array[Resistor] = Array(Resistor(), 3)
            g: Ground = Ground()

            def equations(self):
                yield connect(self.r[3].p, self.g.p)  # HERE

        ac.compile(M())
        """,
        ["index 3 of component array `r` is outside 0..2"],
    ),
    "inner and outer at once": (
        """
        class M(Component):
            g: Ground = ac.inner(ac.outer(Ground()))  # HERE
        """,
        ["inner(outer(...)): a field is either `inner` or `outer`"],
    ),
    "a class as inner": (
        """
        class M(Component):
            g: Ground = ac.inner(Ground)  # HERE
        """,
        ["inner(Ground): give a component, inner(Ground())"],
    ),
    "a table that goes back": (
        """
        ac.table([0.0, 2.0, 1.0], [0.0, 1.0, 2.0])  # HERE
        """,
        ["table: x must increase strictly"],
    ),
    "connect in initial equations": (
        """
        class M(Component):
            a: Ground = Ground()
            b: Ground = Ground()

            def initial_equations(self):
                yield connect(self.a.p, self.b.p)  # HERE

        ac.compile(M())
        """,
        ["initial_equations() of `M` yields a connect()"],
    ),
    "a class compiled": (
        """
        ac.compile(RC)
        """,
        ["not the class `RC`: call it"],
    ),
    "something else compiled": (
        """
        ac.compile(3)
        """,
        ["not int"],
    ),
    "one declaration for two fields": (
        """
        v = Variable()
        class M(Component):  # HERE
            x: Variable = v
            y: Variable = v
        """,
        ["`M.y` and `x` share one Variable object"],
    ),
    "nominal that is no scale": (
        """
        Variable(nominal=0.0)
        """,
        ["nominal=0.0 must be a positive number"],
    ),
    "wrong state_select": (
        """
        Variable(state_select="maybe")
        """,
        ["state_select='maybe'", "prefer"],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_declaration_errors(name: str, tmp_path: Path) -> None:
    text, words = CASES[name]
    error_of(tmp_path, text, ac.DeclarationError, words)


CONNECT = {
    "unlike connectors": (
        """
        class Flange(Connector):
            s: Potential = Potential()
            f: Flow = Flow()

        class Mass(Component):
            flange: Flange = Flange()

        class M(Component):
            r: Resistor = Resistor()
            m: Mass = Mass()

            def equations(self):
                yield connect(self.r.p, self.m.flange)  # HERE

        ac.compile(M())
        """,
        ["connect(r.p, m.flange)", "connector `Pin`", "connector `Flange`", "unlike"],
    ),
    "a component": (
        """
        class M(Component):
            r: Resistor = Resistor()
            m: Resistor = Resistor()

            def equations(self):
                yield connect(self.r, self.m)  # HERE

        ac.compile(M())
        """,
        ["not component `r`", "one of its ports"],
    ),
    "a signal and a connector": (
        """
        class M(Component):
            u: Input = Input()
            r: Resistor = Resistor()

            def equations(self):
                yield connect(self.r.p, self.u)  # HERE

        ac.compile(M())
        """,
        ["connector `Pin` (v, i) and a signal are unlike"],
    ),
    "connectors of one name": (
        """
        from acausal.components import rotational, translational

        class M(Component):
            m: rotational.Inertia = rotational.Inertia(J=1.0)
            s: translational.Spring = translational.Spring(c=1.0)

            def equations(self):
                yield connect(self.m.flange_b, self.s.flange_a)  # HERE

        ac.compile(M())
        """,
        ["connector `Flange` (phi, tau) and connector `Flange` (s, f) are unlike"],
    ),
    "a vector of outputs and one input": (
        """
        from acausal.components import blocks

        class M(Component):
            table: blocks.CombiTimeTable = blocks.CombiTimeTable(table=[[0, 1, 2], [1, 2, 3]])
            gain: blocks.Gain = blocks.Gain(k=2.0)

            def equations(self):
                yield connect(self.table.y, self.gain.u)  # HERE

        ac.compile(M())
        """,
        ["outputs are joined", "table.y[1]", "table.y[2]", "connect(table.y[0], gain.u)"],
    ),
    "two outputs for one input": (
        """
        from acausal.components import blocks

        class Filter(Component):
            u: Input = Input()
            lag: blocks.FirstOrder = blocks.FirstOrder(T=1.0)

            def equations(self):
                yield connect(self.u, self.lag.u)

        class M(Component):
            one: blocks.Constant = blocks.Constant(k=1.0)
            two: blocks.Constant = blocks.Constant(k=2.0)
            filters: Array[Filter] = Array(Filter(), 2)

            def equations(self):
                yield connect(self.one.y, self.filters[:].u)  # HERE
                yield connect(self.filters[0].u, self.two.y)  # HERE

        ac.compile(M())
        """,
        ["outputs are joined", "one.y", "two.y", "Try:"],
    ),
    "an output for the model's own input": (
        """
        from acausal.components import blocks

        class M(Component):
            u: Input = Input()
            one: blocks.Constant = blocks.Constant(k=1.0)
            gain: blocks.Gain = blocks.Gain(k=2.0)

            def equations(self):
                yield connect(self.u, self.gain.u)  # HERE
                yield connect(self.one.y, self.gain.u)  # HERE

        ac.compile(M())
        """,
        ["outputs are joined", "    u  ", "one.y"],
    ),
    "slices of different length": (
        """
        class M(Component):
            r: Array[Resistor] = Array(Resistor(), 4)

            def equations(self):
                yield connect(self.r[:-1].n, self.r[2:].p)  # HERE

        ac.compile(M())
        """,
        ["slices of 3 and 2 elements do not fit"],
    ),
}


@pytest.mark.parametrize("name", CONNECT)
def test_connect_errors(name: str, tmp_path: Path) -> None:
    text, words = CONNECT[name]
    error_of(tmp_path, text, ac.ConnectError, words)


def test_unit_errors(tmp_path: Path) -> None:
    text = """
        class Bad(TwoPin):
            R: Parameter = Parameter(1.0, unit="ohm")

            def equations(self) -> Equations:
                yield from super().equations()
                yield self.v == self.R  # HERE

        ac.compile(RC(resistor=Bad()))
        """
    words = ["`Bad` (component `resistor`)", "v == R", "v  has unit V", "R  has unit ohm", "factor of unit A", "Try:"]
    error_of(tmp_path, text, ac.UnitError, words)


def test_unknown_fields_are_attribute_errors_too() -> None:
    """So that `hasattr`, `getattr` with a default and interactive shells work."""
    from ..language.parts import RC

    assert not hasattr(RC(), "resitor")
    assert getattr(RC(), "resitor", 3) == 3
    assert not hasattr(RC(), "_repr_html_")


@pytest.mark.parametrize(
    ("start", "text"),
    [
        (ac.start("2.0"), "'2.0' is no number and no expression of parameters"),
        (ac.start(float("nan"), fixed=True), "its value is NaN"),
        (ac.start(1.0, fixed="yes"), "fixed='yes' is neither True nor False"),  # type: ignore[arg-type]
        (ac.start(1.0, nominal=-1.0), "nominal=-1.0 must be a positive number"),
        (ac.start(1.0, state_select="always!"), "state_select='always!' is not one of never, avoid"),  # type: ignore[arg-type]
    ],
)
def test_starts_that_cannot_be(start: Any, text: str) -> None:
    """A start that is NaN would count as none, and the variable begin anywhere."""
    with pytest.raises(ac.DeclarationError, match=f"start of `Mass.s`: {text}") as caught:
        translational.Mass(s=start)
    assert "test_declaration_errors.py" in str(caught.value)


@pytest.mark.parametrize(("cls", "text"), [
    (rotational.SpringDamper, r"`SpringDamper` takes .* as in `SpringDamper\(c=2\.0\)` \(it has `c`, `d`.*\.py:\d+\)"),
    (rotational.Inertia, r"`Inertia` takes values by keyword, as in `Inertia\(J=2\.0\)` \(.*\.py:\d+\)"),
])  # fmt: skip
def test_values_without_a_keyword(cls: Any, text: str) -> None:
    with pytest.raises(ac.DeclarationError, match=text):
        cls(2.0)
