"""The EMEP problem of the IVP test set: 66 species of the air over Europe, their reactions given as a table.

Photolysis begins at 4:00 and ends at 20:00 of each day, with a jump, and deposition is slower at night.

Source: Verwer, Spee, Blom and Hundsdorfer (1999), A second-order Rosenbrock method applied to photochemical dispersion
problems, SIAM J. Sci. Comput. 20, 1456-1480; reactions and reference solution: Test Set for IVP Solvers, release 2.4,
problem `emep`.
"""

from __future__ import annotations

import types
from math import exp, radians
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, cos, der, mod, sin, where

HERE = Path(__file__).parent
HOUR, MIXING_HEIGHT, TEMPERATURE = 3600.0, 1.2e5, 298.0
T0, T1 = 4 * HOUR, 116 * HOUR


class Reaction(NamedTuple):
    """A row of the table."""

    kind: str
    a: float
    b: float
    reactants: list[str]
    changes: dict[str, float]


def table(name: str) -> list[list[str]]:
    lines = (HERE / name).read_text(encoding="utf-8").splitlines()
    return [line.split() for line in lines if not line.startswith("#")]


def reaction(words: list[str]) -> Reaction:
    """``light 2.16e-4 0.79 MGLYOX -MGLYOX +CO +2*HO2``."""
    kind, a, b, *rest = words
    changes: dict[str, float] = {}
    for word in (w for w in rest if w[0] in "+-" and w != "-"):
        factor, _, species = word[1:].rpartition("*")
        changes[species] = float(f"{word[0]}{factor or 1}")
    return Reaction(kind, float(a), float(b), [w for w in rest if w[0] not in "+-"], changes)


SPECIES = {name: (float(start), float(end)) for name, start, end in table("emep_species.txt")}
REACTIONS = [reaction(words) for words in table("emep.txt")]


def rate(r: Reaction) -> Any:
    """Rate of a reaction, but for its reactants."""
    of_day = mod(ac.time, 24 * HOUR)
    day = (of_day >= 4 * HOUR) & (of_day < 20 * HOUR)
    latitude, declination, angle = radians(50), radians(23.5), (1 + of_day / (12 * HOUR)) * ac.PI
    height = cos(angle) * float(np.cos(latitude) * np.cos(declination)) + float(np.sin(latitude) * np.sin(declination))
    T = TEMPERATURE
    saturation = 61.078 * exp(-(597.3 - 0.57 * (T - 273.16)) * 18 / 1.986 * (1 / T - 1 / 273.16)) / (1.38e-16 * T)
    if r.kind == "emitted":
        return r.a / MIXING_HEIGHT
    if r.kind == "deposited":
        return r.a / MIXING_HEIGHT * where(day, 1.0, 0.25)
    if r.kind == "light":
        return where(day, r.a * ac.exp(-r.b / where(day, height, 1.0)), 1e-40)
    thermal = r.a * exp(r.b / T)
    return thermal * (saturation * (23 * sin(2.43 - 7.93e-5 * of_day) + 66.5) if r.kind == "water" else 1.0)


def air() -> Component:
    """All species, with their densities [molecules/cm3]."""

    def equations(self: Any) -> Equations:
        change: dict[str, list[Any]] = {name: [] for name in SPECIES}
        for r in REACTIONS:
            speed = rate(r)
            for name in r.reactants:
                speed = speed * getattr(self, name)
            for name, factor in r.changes.items():
                change[name].append(factor * speed)
        for name, terms in change.items():
            yield der(getattr(self, name)) == sum(terms[1:], terms[0])

    fields: dict[str, Any] = {k: Variable(start=start, fixed=True, nominal=1e6) for k, (start, _) in SPECIES.items()}
    annotations = dict.fromkeys(fields, Variable)
    body = {"equations": equations, "__module__": __name__, "__annotations__": annotations, **fields}
    return types.new_class("Air", (Component,), {}, lambda ns: ns.update(body))()


@pytest.mark.slow_case("diffrax")
@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_five_days(engine: Any) -> None:
    solution = ac.compile(air()).simulate(T1, t0=T0, rtol=1e-8, atol=1e-13, saveat=2, engine=engine)
    found = np.array([solution[name][-1] for name in SPECIES])
    wanted = np.array([end for _, end in SPECIES.values()])
    # four molecules of OP are left, and of OD none: there the reference is as good as its absolute tolerance
    np.testing.assert_allclose(found, wanted, rtol=1e-6, atol=1e-4)
