"""Units in terms of SI base units, as a model description defines them."""

from __future__ import annotations

import re
from dataclasses import dataclass

from ...unit_algebra import parse_unit
from ...units import ICE_POINT

ANGLES = re.compile(r"(?<![A-Za-z])(rad|deg|rev|rpm|°)(?![A-Za-z])(\^|\*\*)?([-+]?\d+)?")
BASE = ("kg", "m", "s", "A", "K", "mol", "cd", "rad")


@dataclass(frozen=True, slots=True)
class BaseUnit:
    """``SI value = factor * value + offset``.

    Attributes:
        exponents: of the base units that occur.
    """

    exponents: tuple[tuple[str, int], ...]
    factor: float
    offset: float


def base_unit(text: str) -> BaseUnit | None:
    """Definition of a unit string; None where base units do not have whole exponents.

    Raises:
        UnknownUnit: the unit is not known.
    """
    unit = parse_unit(text)
    exponents = dict(unit.dimension)
    celsius = exponents.pop("degC", 0.0)
    offset = ICE_POINT if celsius == 1.0 and not exponents else 0.0
    exponents["K"] = exponents.get("K", 0.0) + celsius
    exponents["rad"] = _angle(text)
    if any(e != int(e) for e in exponents.values()):
        return None
    return BaseUnit(tuple((name, int(exponents[name])) for name in BASE if exponents.get(name)), unit.scale, offset)


def _angle(text: str) -> int:
    """Exponent of the plane angle, which the algebra of units takes as a number."""
    total = 0
    for match in ANGLES.finditer(text):
        before = text[: match.start()]
        below = before.rstrip().endswith("/") or ("/(" in before and ")" not in before[before.rindex("/(") :])
        total += int(match.group(3) or 1) * (-1 if below else 1)
    return total
