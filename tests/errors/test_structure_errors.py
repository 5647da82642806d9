"""Structural errors: singular, over- and under-determined models."""

from __future__ import annotations

from pathlib import Path

import pytest

import acausal as ac
from acausal.components import planar, rotational
from acausal.components.examples import assemble, start

from .user import error_of

CASES = {
    "two ideal sources in parallel": (
        """
        class M(Component):
            a: Source = Source()  # HERE
            b: Source = Source(V=2.0)  # HERE
            ground: Ground = Ground()

            def equations(self):
                yield connect(self.a.p, self.b.p)  # HERE
                yield connect(self.a.n, self.b.n, self.ground.p)  # HERE

        ac.compile(M())
        """,
        [
            "2 equations for 2 unknowns",
            "cannot be paired",
            "Over-determined: 2 equations for 1 unknown (a.v)",
            "a.v = a.V",
            "a.v = b.V",
            "Under-determined: 1 unknown (a.i) in no equation",
            "`a` and `b` both determine `a.v`",
            "two current sources in series, or two outputs that are connected",
            "put a component between them",
        ],
    ),
    "no ground": (
        """
        class M(Component):
            a: Source = Source()  # HERE
            b: Resistor = Resistor()  # HERE

            def equations(self):
                yield connect(self.a.p, self.b.p)  # HERE
                yield connect(self.a.n, self.b.n)  # HERE

        ac.compile(M())
        """,
        ["this equation repeats or contradicts others", "namely:", "a.p.v", "occur in differences only", "a ground"],
    ),
    "an equation written twice": (
        """
        class M(Component):
            x: Variable = Variable()
            y: Variable = Variable()

            def equations(self):
                yield self.x + self.y == 1  # HERE
                yield 2 * self.x + 2 * self.y == 2  # HERE

        ac.compile(M())
        """,
        ["`M` is singular for all values", "one of these equations follows from the others", "x + y = 1"],
    ),
    "an equality written twice": (
        """
        class M(Component):
            x: Variable = Variable()
            y: Variable = Variable()
            z: Variable = Variable()

            def equations(self):
                yield self.x == self.y  # HERE
                yield self.y == self.x  # HERE
                yield self.z == self.x + 1  # HERE

        ac.compile(M())
        """,
        ["repeats or contradicts others", "y = x", "x = y", "2 unknowns (x, z) in 1 equation"],
    ),
    "too many equations": (
        """
        class R2(TwoPin):  # HERE
            R: Parameter = Parameter(1.0)

            def equations(self):
                yield from super().equations()
                yield self.v == self.R * self.i  # HERE
                yield self.i == 3  # HERE

        class M(RC):
            resistor: TwoPin = R2()  # HERE

        ac.compile(M())
        """,
        [
            "5 equations for 4 unknowns",
            "Over-determined: 5 equations for 4 unknowns",
            "resistor.R*source.i",
            "class `R2`",
            "has 5 equations where 4 are needed (too many)",
        ],
    ),
    "two statements assign one variable": (
        """
        class M(Component):
            x: Variable = Variable(start=0.0, fixed=True)
            n: Discrete = Discrete()

            def equations(self):
                yield der(self.x) == 1
                yield when(self.x > 1, {self.n: 1})  # HERE
                yield when(self.x > 2, {self.n: 0})  # HERE

        ac.compile(M())
        """,
        ["2 equations for 1 unknown (n)", "`n` is assigned by more than one `when`", "elsewhen"],
    ),
    "a variable that is assigned and not discrete": (
        """
        class M(Component):
            x: Variable = Variable(start=0.0, fixed=True)
            n: Variable = Variable()  # HERE

            def equations(self):
                yield der(self.x) == 1
                yield when(self.x > 1, {self.n: 1})

        ac.compile(M())
        """,
        ["1 unknown (n) in no equation", "`n` is given in `when` only", "`Discrete`"],
    ),
    "a flow that a class forgets": (
        """
        class Voltmeter(Component):  # HERE
            p: Pin = Pin()
            v: Output = Output()

            def equations(self):
                yield self.v == self.p.v

        class M(Component):
            source: Source = Source()  # HERE
            ground: Ground = Ground()
            meter: Voltmeter = Voltmeter()

            def equations(self):
                yield connect(self.source.n, self.ground.p)
                yield connect(self.source.p, self.meter.p)

        ac.compile(M())
        """,
        ["class `Voltmeter`", "has 1 equation where 2 are needed (too few)", "no equation of it has `p.i`"],
    ),
    "too few equations": (
        """
        class R2(TwoPin):  # HERE
            extra: Variable = Variable()  # HERE
            R: Parameter = Parameter(1.0)

            def equations(self):
                yield from super().equations()
                yield self.v == self.R * self.i

        class M(RC):
            resistor: TwoPin = R2()  # HERE

        ac.compile(M())
        """,
        [
            "4 equations for 5 unknowns",
            "Under-determined: 1 unknown (resistor.extra) in no equation",
            "class `R2`",
            "has 4 equations where 5 are needed (too few)",
        ],
    ),
    "a law is missing": (
        """
        class R2(TwoPin):  # HERE
            def equations(self):
                yield from super().equations()

        class M(RC):
            resistor: TwoPin = R2()  # HERE

        ac.compile(M())
        """,
        ["3 equations for 4 unknowns", "resistor.v", "class `R2`", "(too few)"],
    ),
    "unconnected port": (
        """
        class M(Component):
            source: Source = Source()
            resistor: Resistor = Resistor()
            ground: Ground = Ground()
            capacitor: Capacitor = Capacitor()  # HERE

            def equations(self):
                yield connect(self.source.p, self.resistor.p)
                yield connect(self.source.n, self.resistor.n, self.ground.p)

        ac.compile(M())
        """,
        ["nothing is connected to `capacitor.p`, `capacitor.n`", "is a connect() missing?"],
    ),
    "unconnected input": (
        """
        class Gain(Component):
            k: Parameter = Parameter(2.0)
            u: Input = Input()
            y: Output = Output()

            def equations(self):
                yield self.y == self.k * self.u  # HERE

        class M(Component):
            a: Gain = Gain()  # HERE
            b: Gain = Gain()  # HERE

            def equations(self):
                yield connect(self.a.y, self.b.u)  # HERE

        ac.compile(M())
        """,
        ["2 equations for 3 unknowns", "input `a.u` has no value", "connect it or give it an equation"],
    ),
    "two masses with one position each given twice": (
        """
        class M(Component):
            x: Variable = Variable()

            def equations(self):
                yield der(self.x) == 1  # HERE
                yield self.x == ac.time  # HERE

        ac.compile(M())
        """,
        ["2 equations for 1 unknown", "class `M`", "2 equations where 1 are needed"],
    ),
    "an index-reduced model that differentiates an input": (
        """
        class M(Component):
            u: Input = Input()
            x: Variable = Variable()
            v: Variable = Variable()

            def equations(self):
                yield self.x == self.u
                yield self.v == der(self.x)

        ac.compile(M())
        """,
        ["derivative of an input", "a source block"],
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_structure_errors(name: str, tmp_path: Path) -> None:
    text, words = CASES[name]
    error_of(tmp_path, text, ac.StructureError, words)


def test_the_error_holds_the_names_for_programs(tmp_path: Path) -> None:
    text, _ = CASES["two ideal sources in parallel"]
    error = error_of(tmp_path, text, ac.StructureError, [])
    assert error.unknowns == ("a.v", "a.i")
    assert error.components == ("a", "b")
    assert error.equations == ("a.v = a.V", "a.v = b.V")


def test_a_large_model_is_named_by_its_first_lines(tmp_path: Path) -> None:
    text = """
        class M(Component):
            n: int = 2000
            r: Array[Resistor] = Array(Resistor(), "n")  # HERE
            s: Source = Source()

            def equations(self):
                yield connect(self.r[:-1].n, self.r[1:].p)
                yield connect(self.s.p, self.r[0].p)
                yield connect(self.s.n, self.r[-1].n)

        ac.compile(M())
        """
    error = error_of(tmp_path, text, ac.StructureError, ["a ground", "r[1999]"])
    assert len(str(error).splitlines()) < 60


def test_two_speeds_of_one_shaft_name_their_sources() -> None:
    """The one overdetermines what the other does, through a relation of the shaft or a gear."""
    sources = {"a": rotational.ConstantSpeed(w_fixed=1.0), "b": rotational.ConstantSpeed(w_fixed=2.0)}
    stiff = assemble("a.flange - shaft.flange_a", "shaft.flange_b - b.flange", shaft=rotational.Inertia(), **sources)
    geared = assemble("a.flange - gear.flange_a", "gear.flange_b - b.flange", gear=rotational.IdealGear(), **sources)
    for model, who in ((stiff, "`a` and `b` determine"), (geared, "`gear` and `a` and `b` determine")):
        with pytest.raises(ac.StructureError, match=rf"Try: {who} .* more than once, .* two speeds given to one shaft"):
            ac.compile(model)


def test_of_an_input_without_a_value_the_long_equations_are_cut_short() -> None:
    model = assemble(
        "one.flange_b - clutch.flange_a", "clutch.flange_b - two.flange_a", one=rotational.Inertia(),
        two=rotational.Inertia(), clutch=rotational.Clutch(),
    )  # fmt: skip
    with pytest.raises(ac.StructureError) as caught:
        ac.compile(model)
    text = str(caught.value)
    assert "Try: input `clutch.f_normalized` has no value" in text  # first, before the ends of the shafts
    assert "clutch.startForward = where(" in text
    assert max(map(len, text.splitlines())) < 400


def test_a_potential_that_nothing_determines_is_told_of() -> None:
    """A planar point mass on a spring has no angle: what is missing is no reference."""
    model = assemble(
        "wall.frame - spring.frame_a", "spring.frame_b - mass.frame_a", wall=planar.Fixed(), spring=planar.Spring(),
        mass=planar.PointMass(r=start((0.0, -1.0))), planarWorld=ac.inner(planar.PlanarWorld()),
    )  # fmt: skip
    with pytest.raises(ac.StructureError, match=r"`spring.frame_b.phi` is in no equation of what is connected there"):
        ac.compile(model)
