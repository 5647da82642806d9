"""Units as dimension and scale; unit strings in the style of Modelica (``kg.m2/s``) and of pint (``kg*m**2/s``).

The few dozen units that models are written in are a table here, so that a model compiles without loading pint (0.3 s);
any other name is looked up in pint's registry. A test compares the table with pint.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, replace
from functools import cache
from typing import Any, Final

Dimension = tuple[tuple[str, float], ...]
"""Exponent of each base unit that occurs, sorted by name."""


@dataclass(frozen=True, slots=True)
class Unit:
    """Unit of an expression.

    Attributes:
        dimension: exponents of the base units m, kg, s, A, K, mol, cd, and degC, which is a dimension of its own
            because it has another zero than K.
        scale: how many of the coherent SI unit it is (1e5 for bar).
        literal: product of the numbers written as factors: ``1e5*p_bar`` converts bar to Pa when its literal factor is
            the ratio of the scales.
        soft: made of numbers and time alone; it adapts to any other unit in sums, comparisons and functions.
    """

    dimension: Dimension = ()
    scale: float = 1.0
    literal: float = 1.0
    soft: bool = False

    def __mul__(self, other: Unit) -> Unit:
        return self._with(other, 1.0)

    def __truediv__(self, other: Unit) -> Unit:
        return self._with(other, -1.0)

    def _with(self, other: Unit, sign: float) -> Unit:
        exponents = dict(self.dimension)
        for name, e in other.dimension:
            exponents[name] = exponents.get(name, 0.0) + sign * e
        scale, literal = self.scale * other.scale**sign, self.literal * other.literal**sign
        return Unit(_dimension(exponents), scale, literal, self.soft and other.soft)

    def __pow__(self, exponent: float) -> Unit:
        exponents = {name: e * exponent for name, e in self.dimension}
        literal = abs(self.literal) ** exponent
        return Unit(_dimension(exponents), self.scale**exponent, literal, self.soft)

    @property
    def converted(self) -> Unit:
        """With the literal factor taken as a conversion."""
        return replace(self, scale=self.scale / abs(self.literal), literal=1.0)

    def __str__(self) -> str:
        return unit_text(self)


def _dimension(exponents: dict[str, float]) -> Dimension:
    return tuple(sorted((name, round(e, 9) + 0.0) for name, e in exponents.items() if abs(e) > 1e-9))


NUMBER: Final = Unit(soft=True)
DIMENSIONLESS: Final = Unit()
SECOND: Final = Unit((("s", 1.0),))

BASE: Final = ("kg", "m", "s", "A", "K", "mol", "cd", "degC")
PREFIXES: Final = {
    "T": 1e12, "G": 1e9, "M": 1e6, "k": 1e3, "h": 1e2, "d": 1e-1, "c": 1e-2, "m": 1e-3, "u": 1e-6, "µ": 1e-6, "μ": 1e-6,
    "n": 1e-9, "p": 1e-12, "f": 1e-15,
}  # fmt: skip
PREFIXED: Final = frozenset(
    "m s A K mol g N Pa J W V C F H Hz T Wb S ohm Ω Ohm bar l L eV lm lx Wh rad VA t".split()
)
DERIVED: Final[dict[str, tuple[float, str]]] = {
    "g": (1e-3, "kg"), "t": (1e3, "kg"), "N": (1.0, "kg.m/s2"), "Pa": (1.0, "N/m2"), "J": (1.0, "N.m"),
    "W": (1.0, "J/s"), "C": (1.0, "A.s"), "V": (1.0, "W/A"), "ohm": (1.0, "V/A"), "S": (1.0, "A/V"), "F": (1.0, "C/V"),
    "Wb": (1.0, "V.s"), "H": (1.0, "Wb/A"), "T": (1.0, "Wb/m2"), "Hz": (1.0, "1/s"), "VA": (1.0, "W"),
    "lm": (1.0, "cd"), "lx": (1.0, "cd/m2"), "bar": (1e5, "Pa"), "atm": (101325.0, "Pa"), "l": (1e-3, "m3"),
    "min": (60.0, "s"), "h": (3600.0, "s"), "d": (86400.0, "s"), "Wh": (3600.0, "J"), "eV": (1.602176634e-19, "J"),
    "rad": (1.0, "1"), "sr": (1.0, "1"), "deg": (math.pi / 180, "1"), "rev": (2 * math.pi, "1"),
    "rpm": (2 * math.pi / 60, "1/s"), "%": (1e-2, "1"), "gn": (9.80665, "m/s2"),
}  # fmt: skip
SYNONYMS: Final = {
    "Ohm": "ohm", "Ω": "ohm", "L": "l", "r": "rev", "turn": "rev", "sec": "s", "hour": "h", "day": "d", "percent": "%",
    "°C": "degC", "°": "deg", "degree": "deg", "var": "VA", "litre": "l", "liter": "l", "radian": "rad",
    "revolution": "rev",
}  # fmt: skip
NAMED: Final = tuple("N Pa J W V ohm C F H T K A m kg s mol cd degC bar".split())
"""Names tried for a unit in messages."""

_TOKEN: Final = re.compile(r"\s*(\*\*|[*·./^()]|[-+]?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?|[^\W\d]+|[%°]C?)", re.UNICODE)


_SUPERSCRIPT: Final = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻", "0123456789-")


class UnknownUnit(ValueError):
    """A unit string with a name that is not known, or that is not well formed."""

    def __init__(self, text: str, atom: str | None = None) -> None:
        super().__init__(text)
        self.text, self.atom = text, atom


@cache
def parse_unit(text: str) -> Unit:
    """Unit of a unit string.

    Args:
        text: factors joined by ``.``, ``*`` or ``/``, with exponents as in ``m2``, ``s-1``, ``m^2``, ``m**2``, and
            parentheses; ``1``, ``-`` or an empty string is dimensionless.

    Raises:
        UnknownUnit: a name that neither the table nor pint knows, or bad syntax.
    """
    tokens: list[str] = []
    position, stripped = 0, text.strip().translate(_SUPERSCRIPT).removeprefix("-")
    while position < len(stripped):
        match = _TOKEN.match(stripped, position)
        if match is None:
            raise UnknownUnit(text)
        tokens.append(match.group(1))
        position = match.end()
    if not tokens:
        return DIMENSIONLESS
    unit, rest = _product(tokens, 0, text)
    if rest != len(tokens):
        raise UnknownUnit(text)
    return unit


def _product(tokens: list[str], i: int, text: str) -> tuple[Unit, int]:
    unit, i = _factor(tokens, i, text)
    while i < len(tokens) and tokens[i] in ("*", "·", ".", "/"):
        right, following = _factor(tokens, i + 1, text)
        unit = unit / right if tokens[i] == "/" else unit * right
        i = following
    return unit, i


def _factor(tokens: list[str], i: int, text: str) -> tuple[Unit, int]:
    if i >= len(tokens):
        raise UnknownUnit(text)
    token = tokens[i]
    if token == "(":
        unit, i = _product(tokens, i + 1, text)
        if i >= len(tokens) or tokens[i] != ")":
            raise UnknownUnit(text)
    elif _is_number(token):
        unit = Unit(scale=float(token))
    elif token[0] in "*·./^)":
        raise UnknownUnit(text)
    else:
        unit = _atom(token, text)
    i += 1
    if i < len(tokens) and tokens[i] in ("**", "^"):
        return _raised(unit, tokens, i + 1, text)
    if i < len(tokens) and _is_number(tokens[i]) and not _is_number(token):
        return unit ** float(tokens[i]), i + 1
    return unit, i


def _raised(unit: Unit, tokens: list[str], i: int, text: str) -> tuple[Unit, int]:
    bracket = i < len(tokens) and tokens[i] == "("
    i += bracket
    if i >= len(tokens) or not _is_number(tokens[i]):
        raise UnknownUnit(text)
    exponent = float(tokens[i])
    i += 1
    if bracket and i + 1 < len(tokens) and tokens[i] == "/" and _is_number(tokens[i + 1]):
        exponent, i = exponent / float(tokens[i + 1]), i + 2
    if bracket and (i >= len(tokens) or tokens[i] != ")"):
        raise UnknownUnit(text)
    return unit**exponent, i + bracket


def _is_number(token: str) -> bool:
    return token.lstrip("+-")[:1].isdigit()


@cache
def _atom(name: str, text: str) -> Unit:
    name = SYNONYMS.get(name, name)
    if name in BASE:
        return Unit(((name, 1.0),))
    if name in DERIVED:
        scale, definition = DERIVED[name]
        unit = parse_unit(definition)
        return replace(unit, scale=unit.scale * scale)
    if name[0] in PREFIXES and name[1:] in PREFIXED:
        unit = _atom(name[1:], text)
        return replace(unit, scale=unit.scale * PREFIXES[name[0]])
    return _from_pint(name, text)


_PINT_BASE: Final = {
    "[length]": "m", "[mass]": "kg", "[time]": "s", "[current]": "A", "[temperature]": "K", "[substance]": "mol",
    "[luminosity]": "cd",
}  # fmt: skip


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def _from_pint(name: str, text: str) -> Unit:
    from pint.errors import PintError

    registry = _registry()
    try:
        quantity = registry.Quantity(1.0, name).to_base_units()
        exponents = {_PINT_BASE[str(d)]: float(e) for d, e in quantity.dimensionality.items()}
    except (PintError, AttributeError, KeyError, ValueError, TypeError):
        raise UnknownUnit(text, name) from None
    return Unit(_dimension(exponents), float(quantity.magnitude))


def known_units() -> tuple[str, ...]:
    """Names for suggestions: the table's, and those with the usual prefixes."""
    common = [f"{p}{u}" for p in "kMmu" for u in "m g N Pa W J V A ohm F H s Hz".split()]
    return (*BASE, *DERIVED, *SYNONYMS, *common)


def unit_text(unit: Unit) -> str:
    """A unit as text: a known name if there is one, else base units, with the scale in front."""
    if not unit.dimension:
        for name in ("1", "deg", "rev", "%"):
            if math.isclose(parse_unit(name).scale, unit.scale, rel_tol=1e-9):
                return name
        return f"{unit.scale:.6g}"
    for name in NAMED:
        known = parse_unit(name)
        if known.dimension == unit.dimension and math.isclose(known.scale, unit.scale, rel_tol=1e-9):
            return name
    above = [_power_text(n, e) for n, e in _ordered(unit.dimension) if e > 0]
    below = [_power_text(n, -e) for n, e in _ordered(unit.dimension) if e < 0]
    body = ".".join(above) or "1"
    if below:
        body += "/" + (below[0] if len(below) == 1 else f"({'.'.join(below)})")
    return body if math.isclose(unit.scale, 1.0, rel_tol=1e-9) else f"{unit.scale:.6g} {body}"


def _ordered(dimension: Dimension) -> list[tuple[str, float]]:
    return sorted(dimension, key=lambda pair: BASE.index(pair[0]))


def _power_text(name: str, exponent: float) -> str:
    if exponent == 1.0:
        return name
    return f"{name}{int(exponent)}" if exponent == int(exponent) else f"{name}^{exponent:.6g}"


def agree(a: Unit | None, b: Unit | None) -> Unit | bool | None:
    """The common unit of two operands of a sum or sides of an equation; False if they differ.

    None, the unit of a quantity declared without one, agrees with everything and becomes the other's unit; so do
    numbers.
    """
    if a is None or b is None:
        other = b if a is None else a
        return None if other is None or other.soft else other
    if a.soft and b.soft:
        return a if a.dimension == b.dimension else None
    if a.soft or b.soft:
        return replace(b if a.soft else a, literal=1.0)
    if a.dimension != b.dimension:
        return False
    for one, two in ((a, b), (a.converted, b), (a, b.converted), (a.converted, b.converted)):
        if math.isclose(one.scale, two.scale, rel_tol=1e-6):
            return replace(one, literal=1.0)
    return False
