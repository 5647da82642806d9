"""Unit strings, and the unit check of equations."""

from __future__ import annotations

import math
import subprocess
import sys
from typing import Any

import pint
import pytest

import acausal as ac
from acausal import Component, Connector, Equations, Flow, Input, Output, Parameter, Potential, Variable, connect, der
from acausal.language.flatten import flatten
from acausal.unit_algebra import DERIVED, PREFIXES, Unit, UnknownUnit, parse_unit, unit_text
from acausal.units import check_units


def check(model: Component) -> None:
    check_units(flatten(model))


def one(lhs: Any, rhs: Any) -> type[Component]:
    """A class with quantities of several units and one equation."""

    class One(Component):
        x: Variable = Variable(unit="m")
        y: Variable = Variable(unit="m")
        v: Variable = Variable(unit="m/s")
        a: Variable = Variable(unit="m/s2")
        phi: Variable = Variable(unit="rad")
        w: Variable = Variable(unit="rad/s")
        n: Variable = Variable(unit="rev/s")
        angle: Variable = Variable(unit="deg")
        p: Variable = Variable(unit="Pa")
        pb: Variable = Variable(unit="bar")
        q: Variable = Variable(unit="m3/s")
        D: Parameter = Parameter(1e-5, unit="m3/rev")
        T: Variable = Variable(unit="K")
        Tc: Variable = Variable(unit="degC")
        Td: Variable = Variable(unit="degC")
        F: Variable = Variable(unit="N")
        m: Parameter = Parameter(1.0, unit="kg")
        k: Parameter = Parameter(1.0, unit="N/m")
        rho: Parameter = Parameter(850.0, unit="kg/m3")
        A: Parameter = Parameter(1.0, unit="m2")
        ratio: Parameter = Parameter(1.0, unit="1")
        tau: Parameter = Parameter(1.0, unit="s")
        f: Parameter = Parameter(1.0, unit="Hz")
        free: Variable = Variable()
        gain: Parameter = Parameter(1.0)
        torque: Variable = Variable(unit="N.m")

        def equations(self) -> Equations:
            yield lhs(self) == rhs(self)

    return One


GOOD = {
    "same": (lambda s: s.x, lambda s: s.y),
    "derivative": (lambda s: s.v, lambda s: der(s.x)),
    "second derivative": (lambda s: s.F, lambda s: s.m * der(der(s.x))),
    "derivative of a product": (lambda s: s.F, lambda s: der(s.m * s.v)),
    "number in a sum": (lambda s: s.x, lambda s: s.y + 1),
    "zero": (lambda s: s.x - s.y, lambda s: 0),
    "product": (lambda s: s.F, lambda s: s.k * s.x),
    "wildcard": (lambda s: s.F, lambda s: s.free),
    "wildcard in a product": (lambda s: s.F, lambda s: s.gain * s.x),
    "wildcard in a sum": (lambda s: s.F, lambda s: s.F + s.free + s.m * s.a),
    "power": (lambda s: s.A, lambda s: s.x**2),
    "fractional power": (lambda s: s.x, lambda s: (s.x**2 + s.y**2) ** 0.5),
    "root": (lambda s: s.v, lambda s: ac.sqrt(2 * s.p / s.rho)),
    "orifice": (lambda s: s.q, lambda s: s.A * ac.sqrt(2 / s.rho) * s.p / (s.p**2 + 1e8) ** 0.25),
    "rad is dimensionless": (lambda s: s.x, lambda s: s.x * ac.sin(s.phi)),
    "rad over rad": (lambda s: s.w, lambda s: der(s.phi)),
    "revolutions cancel": (lambda s: s.q, lambda s: s.D * s.n),
    "literal converts revolutions": (lambda s: s.w, lambda s: 2 * ac.PI * s.n),
    "literal converts a displacement": (lambda s: s.torque, lambda s: s.p * s.D / (2 * ac.PI)),
    "literal converts bar": (lambda s: s.p, lambda s: 1e5 * s.pb),
    "literal converts bar in a sum": (lambda s: s.p, lambda s: 1e5 * s.pb + s.p),
    "literal converts degrees": (lambda s: s.x, lambda s: s.x * ac.sin(ac.PI / 180 * s.angle)),
    "Celsius to Kelvin": (lambda s: s.T, lambda s: s.Tc + 273.15),
    "Kelvin to Celsius": (lambda s: s.Tc, lambda s: s.T - 273.15),
    "difference of Celsius": (lambda s: s.T, lambda s: s.Tc - s.Td),
    "function of time": (lambda s: s.x, lambda s: ac.sin(2 * ac.PI * ac.time)),
    "time as a quantity": (lambda s: s.x, lambda s: s.v * ac.time),
    "angular frequency": (lambda s: s.x, lambda s: s.x * ac.sin(2 * ac.PI * s.f * ac.time)),
    "where": (lambda s: s.x, lambda s: ac.where(s.v > 0, s.x, 0)),
    "condition on time": (lambda s: s.x, lambda s: ac.where((ac.time > 1) & (s.v < 2), s.x, s.y)),
    "min and clip": (lambda s: s.x, lambda s: ac.clip(ac.min(s.x, s.y), 0, 1)),
    "sign and abs": (lambda s: s.x, lambda s: ac.abs(s.x) * ac.sign(s.v)),
    "atan2": (lambda s: s.phi, lambda s: ac.atan2(s.x, s.y)),
    "exponent without unit": (lambda s: s.x, lambda s: s.x * s.ratio**s.ratio),
    "black box": (lambda s: s.x, lambda s: ac.table([0.0, 1.0], [0.0, 1.0])(s.p)),
    "exponential": (lambda s: s.x, lambda s: s.x * ac.exp(-ac.time / s.tau)),
}


@pytest.mark.parametrize("name", GOOD)
def test_equations_whose_units_agree(name: str) -> None:
    check(one(*GOOD[name])())


BAD = {
    "sides": (lambda s: s.x, lambda s: s.v, ["x  has unit m", "v  has unit m/s"]),
    "scale": (lambda s: s.p, lambda s: s.pb, ["has unit Pa", "has unit bar", "100000"]),
    "derivative": (lambda s: s.x, lambda s: der(s.x), ["der(x)", "m/s"]),
    "sum": (lambda s: s.x, lambda s: s.y + s.v, ["terms of `y + v`", "v  has unit m/s"]),
    "after a wildcard": (lambda s: s.x, lambda s: s.free + s.v, ["has unit m/s"]),
    "product": (lambda s: s.F, lambda s: s.k * s.v, ["k*v", "kg.m/s3", "factor of unit s"]),
    "sine of a length": (lambda s: s.phi, lambda s: ac.sin(s.x), ["argument of `sin`", "x  has unit m"]),
    "sine of degrees": (lambda s: s.phi, lambda s: ac.sin(s.angle), ["rad", "deg", "0.0174532925"]),
    "revolutions": (lambda s: s.w, lambda s: s.n, ["6.28318531"]),
    "wrong literal": (lambda s: s.p, lambda s: 1e4 * s.pb, ["has unit bar"]),
    "exponent": (lambda s: s.ratio, lambda s: s.ratio**s.x, ["exponent of"]),
    "base": (lambda s: s.x, lambda s: s.x**s.ratio, ["base of"]),
    "comparison": (lambda s: s.x, lambda s: ac.where(s.v > s.x, s.x, 0), ["sides of `v > x`"]),
    "branches": (lambda s: s.x, lambda s: ac.where(s.v > 0, s.x, s.v), ["branches of"]),
    "min": (lambda s: s.x, lambda s: ac.min(s.x, s.v), ["operands of `min(x, v)`"]),
    "atan2": (lambda s: s.phi, lambda s: ac.atan2(s.x, s.v), ["arguments of"]),
    "Celsius is not Kelvin": (lambda s: s.T, lambda s: s.Tc, ["273.15"]),
    "root": (lambda s: s.x, lambda s: ac.sqrt(s.x), ["sqrt(x)", "m^0.5"]),
    "in a condition": (lambda s: s.x, lambda s: ac.where((s.v > 0) & (s.x > s.v), s.x, 0), ["x > v"]),
}


@pytest.mark.parametrize("name", BAD)
def test_equations_whose_units_differ(name: str) -> None:
    lhs, rhs, words = BAD[name]
    with pytest.raises(ac.UnitError) as error:
        check(one(lhs, rhs)())
    text = str(error.value)
    for word in (*words, "`One`", __file__, "Try:"):
        assert word in text, text


def test_a_number_that_should_have_a_unit_is_named() -> None:
    with pytest.raises(ac.UnitError, match=r"factor of unit m/s2 is missing.*a number has no unit"):
        check(one(lambda s: s.F, lambda s: s.m * 9.81)())


def test_the_message_shows_both_sides_and_the_declared_units() -> None:
    class Spring(Component):
        s: Variable = Variable(unit="mm")
        f: Variable = Variable(unit="N")
        c: Parameter = Parameter(1e3, unit="N/m")

        def equations(self) -> Equations:
            yield self.f == self.c * self.s

    class Model(Component):
        spring: Spring = Spring()

    with pytest.raises(ac.UnitError) as error:
        check(Model())
    line = Spring.equations.__wrapped__.__code__.co_firstlineno + 1
    assert f"{__file__}:{line} (Spring)" in str(error.value)
    assert "component `spring`" in str(error.value)
    assert "f == c*s" in str(error.value)
    assert "f [N], c [N/m], s [mm]" in str(error.value)
    assert "0.001" in str(error.value)


class Signal(Component):
    u: Input = Input(unit="Pa")
    y: Output = Output(unit="bar")

    def equations(self) -> Equations:
        yield self.u == 1e5 * self.y


def test_signals_of_different_units_cannot_be_connected() -> None:
    class Chain(Component):
        a: Signal = Signal()
        b: Signal = Signal()

        def equations(self) -> Equations:
            yield self.a.u == 0
            yield connect(self.a.y, self.b.u)

    with pytest.raises(ac.UnitError, match=r"connection joins different units") as error:
        check(Chain())
    assert "connect(a.y, b.u)" in str(error.value)
    assert "a.y  has unit bar" in str(error.value)


def test_connectors_alike_but_for_a_unit_cannot_be_connected() -> None:
    class Port(Connector):
        p: Potential = Potential(unit="Pa")
        q: Flow = Flow(unit="m3/s")

    class OtherPort(Connector):
        p: Potential = Potential(unit="bar")
        q: Flow = Flow(unit="m3/s")

    class Model(Component):
        a: Port = Port()
        b: OtherPort = OtherPort()

        def equations(self) -> Equations:
            yield connect(self.a, self.b)

    with pytest.raises(ac.UnitError, match=r"a\.p  has unit Pa"):
        check(Model())


class Pipe(Component):
    d: Parameter = Parameter(0.1, unit="m")
    area: Parameter = Parameter(ac.PI / 4 * d**2, unit="m2")
    p: Variable = Variable(unit="Pa")

    def equations(self) -> Equations:
        yield der(self.p) == 0


def test_bindings_and_start_values_are_checked() -> None:
    class Good(Component):
        d: Parameter = Parameter(0.1, unit="m")
        p0: Parameter = Parameter(1e5, unit="Pa")
        pipe: Pipe = Pipe(d=d, p=ac.start(p0, fixed=True))

    class BadBinding(Component):
        area: Parameter = Parameter(0.1, unit="m2")
        pipe: Pipe = Pipe(d=area)

    class BadStart(Component):
        p0: Parameter = Parameter(1.0, unit="bar")
        pipe: Pipe = Pipe(p=ac.start(p0))

    class BadDependent(Component):
        d: Parameter = Parameter(0.1, unit="m")
        area: Parameter = Parameter(ac.PI / 4 * d, unit="m2")

    check(Good())
    with pytest.raises(ac.UnitError, match=r"the value of `pipe\.d`"):
        check(BadBinding())
    with pytest.raises(ac.UnitError, match=r"the start value of `pipe\.p`"):
        check(BadStart())
    with pytest.raises(ac.UnitError, match=r"the value of `area`"):
        check(BadDependent())


@pytest.mark.parametrize(
    ("unit", "words"),
    [
        ("Nw", ["not a known unit", "Did you mean"]), ("kg/", ["not well formed"]), ("m//s", ["not well formed"]),
        ("kg/sce", ["`sce`", "`sec`"]),
    ],
)
def test_unknown_unit(unit: str, words: list[str]) -> None:
    class Odd(Component):
        x: Variable = Variable(unit=unit)

        def equations(self) -> Equations:
            yield self.x == 1

    with pytest.raises(ac.UnitError) as error:
        check(Odd())
    for word in (*words, "`Odd.x`", repr(unit), __file__):
        assert word in str(error.value), str(error.value)


SAME = [
    ("N.s/m", "kg/s"), ("kg.m2", "kg*m**2"), ("W/(m2.K)", "W/m2/K"), ("m2/s", "m**2/s"), ("1/s", "Hz"), ("s-1", "1/s"),
    ("N*m/rad", "N.m"), ("m^2", "m2"), ("m**3/s", "m3/s"), ("bar", "100.kPa"), ("l/min", "1e-3.m3/min"),
    ("m**(1/2)", "m**0.5"), ("Ohm", "V/A"), ("", "1"), ("µm", "um"), ("K", "kelvin"),
    ("m³·s⁻¹", "m3/s"), ("-", "1"),
]  # fmt: skip


@pytest.mark.parametrize(("a", "b"), SAME)
def test_spellings(a: str, b: str) -> None:
    left, right = parse_unit(a), parse_unit(b)
    assert left.dimension == right.dimension
    assert math.isclose(left.scale, right.scale)


def test_the_table_agrees_with_pint() -> None:
    registry = pint.UnitRegistry()
    names = {"gn": "standard_gravity", "%": "percent", "rev": "turn", "d": "day", "h": "hour"}
    base = {"[length]": "m", "[mass]": "kg", "[time]": "s", "[current]": "A", "[luminosity]": "cd"}
    for name in DERIVED:
        factor, unit = registry.get_base_units(names.get(name, name))
        dimension = tuple(sorted((base[d], float(e)) for d, e in unit.dimensionality.items()))
        mine = parse_unit(name)
        assert (name, mine.dimension) == (name, dimension)
        assert math.isclose(mine.scale, factor), name
    for prefix, factor in PREFIXES.items():
        assert math.isclose(registry.get_base_units(f"{prefix}Pa")[0], factor)


def test_names_beyond_the_table_come_from_pint() -> None:
    assert math.isclose(parse_unit("psi").scale, 6894.757, rel_tol=1e-6)
    assert parse_unit("inch").dimension == (("m", 1.0),)
    with pytest.raises(UnknownUnit):
        parse_unit("furlongs_per_fortnightly")


@pytest.mark.parametrize("text", ["N", "Pa", "ohm", "m/s2", "W/(m2.K)", "m^0.5", "1/s", "1", "deg", "bar"])
def test_units_as_text_read_back(text: str) -> None:
    unit = parse_unit(text)
    again = parse_unit(unit_text(unit))
    assert (again.dimension, again.scale) == (unit.dimension, pytest.approx(unit.scale))


def test_multiplication_and_powers() -> None:
    newton, metre = parse_unit("N"), parse_unit("m")
    assert newton * metre == parse_unit("J")
    assert (newton / metre**2).dimension == parse_unit("Pa").dimension
    assert (metre**2) ** 0.5 == metre
    assert metre / metre == Unit()


def test_checking_common_units_does_not_load_pint_or_jax() -> None:
    code = (
        "import sys, acausal as ac\n"
        "from acausal.language.flatten import flatten\n"
        "from acausal.units import check_units\n"
        "from models.kbc import reference_crane\n"
        "check_units(flatten(reference_crane('extended', 'rigid')))\n"
        "print([m for m in ('pint', 'jax', 'sympy') if m in sys.modules])"
    )
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert run.stdout.strip() == "[]"
