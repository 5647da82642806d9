"""Both engines on every model of the tests: the same trajectories to tolerance."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

import acausal as ac
from benchmarks.models import chain, ladder
from models.kbc import reference_crane
from tests.components.examples import EXAMPLES
from tests.native import models as small

AGREE = 1e-5
"""Largest deviation, relative to the size of the variable over the run."""
LOOSE = {"slider_crank": 1e-4, "andrews_squeezer": 1e-4}
"""Their accelerations are differences of forces that are far larger."""
QUICK = {"CoupledMasses", "Friction", "simplified-rigid", "pendulum_index3"}
"""Models of the tests that are not slow: compiling for JAX takes seconds each."""


def ivp() -> ModuleType:
    """The loader of the DAE test problems."""
    path = Path(__file__).parents[1] / "reference" / "ivp" / "problems.py"
    spec = spec_from_file_location("ivp_problems", path)
    assert spec is not None and spec.loader is not None
    module = module_from_spec(spec)
    sys.modules.setdefault("ivp_problems", module)
    spec.loader.exec_module(module)
    return module


def problem(name: str) -> Callable[[], tuple[ac.Component, float, float]]:
    def make() -> tuple[ac.Component, float, float]:
        problems = ivp()
        found = problems.load(name)
        return problems.component(found), found["t0"], found["t_end"]

    return make


def plain(model: Callable[[], ac.Component], t1: float) -> Callable[[], tuple[ac.Component, float, float]]:
    return lambda: (model(), 0.0, t1)


def cases() -> Iterator[tuple[str, Callable[[], tuple[ac.Component, float, float]]]]:
    """Name of each model, and what makes it with its time span."""
    for name, model in EXAMPLES.items():
        yield name, plain(lambda model=model: model, 1.0)
    for name in ivp().names():
        yield name, problem(name)
    for hydraulics in ("extended", "simplified"):
        for joint in ("compliant", "rigid"):
            for scenario in ("sine", "step", "endstop"):
                label = f"{hydraulics}-{joint}" + ("" if scenario == "sine" else f"-{scenario}")
                made: Any = (hydraulics, joint, scenario)
                yield label, plain(lambda made=made: reference_crane(*made), 10.0)
    for name in ("Decay", "Balanced", "Torn", "Free", "LinearBlock", "Pendulum"):
        yield f"small-{name}", plain(getattr(small, name), 2.0)
    yield "ladder", plain(lambda: ladder(300), 1.0)
    yield "chain", plain(lambda: chain(300), 2.0)


ATOL = {"robertson_dae": 1e-14, "e5": 1e-20}
"""Absolute tolerances of those whose solution is far smaller than 1."""


@pytest.mark.filterwarnings("ignore:.*below a vacuum:UserWarning")  # the crane on its rod side, at a step
@pytest.mark.filterwarnings("ignore:.*this equation jumps, but it has been:UserWarning")  # the rigid one, at a step
@pytest.mark.parametrize(
    ("name", "make"), [pytest.param(n, m, id=n, marks=() if n in QUICK else pytest.mark.slow) for n, m in cases()]
)
def test_engines_agree(name: str, make: Callable[[], tuple[ac.Component, float, float]]) -> None:
    model, t0, t1 = make()
    system = ac.compile(model)
    options: dict[str, Any] = {"t0": t0, "rtol": 1e-9, "atol": ATOL.get(name), "saveat": np.linspace(t0, t1, 41)}
    native, other = (system.simulate(t1, engine=engine, **options) for engine in ("native", "diffrax"))
    assert native.stats["engine"] == "native"
    worst = {}
    for variable in (*system.states, *system.algebraics, *system.observed):
        a, b = np.asarray(native[variable]), np.asarray(other[variable])
        size = max(float(np.max(np.abs(b))), 1e-9)
        worst[variable] = float(np.max(np.abs(a - b))) / size
    far = {variable: error for variable, error in worst.items() if not error <= LOOSE.get(name, AGREE)}
    assert not far


class Cell(ac.Component):
    """A state, and three coupled equations of which one unknown is iterated on."""

    x: ac.Variable = ac.Variable(start=1.0, fixed=True)
    a: ac.Variable = ac.Variable(start=0.5)
    b: ac.Variable = ac.Variable(start=0.5)
    c: ac.Variable = ac.Variable(start=0.5)

    def equations(self) -> ac.Equations:
        yield ac.der(self.x) == -self.a
        yield self.a + 0.1 * self.b**3 + ac.exp(0.1 * self.c) == self.x + 1
        yield self.b == 0.5 * self.a + 0.2 * ac.sin(self.c)
        yield self.c == self.a * self.a + 0.1 * self.b


class Cells(ac.Component):
    cells: ac.Array[Cell] = ac.Array(Cell(), 2)


def test_equal_blocks_with_fewer_tears_than_unknowns() -> None:
    system = ac.compile(Cells())
    assert any(g.size == 2 and 0 < len(g.kernel.tears) < g.kernel.size for g in system.lowered.schedule.groups)
    native, diffrax = (system.simulate(1.0, rtol=1e-9, saveat=11, engine=e) for e in ("native", "diffrax"))
    for name in ("cells[0].x", "cells[1].b", "cells[1].c"):
        np.testing.assert_allclose(diffrax[name], native[name], atol=1e-8)
