"""The crane, compiled from components, against its equations causalised by hand."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal.components.hydraulic import PaperFriction
from models.kbc import PARAMETERS, SIGNALS, Crane, reference_crane

from .reference import Parameters, solve, spread
from .support import VARIANTS, Floats, read_curve

STATES = {
    ("extended", "compliant"): 12,
    ("extended", "rigid"): 10,
    ("simplified", "compliant"): 4,
    ("simplified", "rigid"): 2,
}


@cache
def compiled(hydraulics: Any, joint: Any, scenario: Any = "sine") -> ac.System:
    return ac.compile(reference_crane(hydraulics, joint, scenario))


def agree(solution: ac.Solution, columns: dict[str, Floats], tolerance: float = 1e-5) -> None:
    """Every column within `tolerance` of its range."""
    worst = {
        name: float(np.max(np.abs(np.asarray(solution[SIGNALS[name]]) - column)) / spread(column))
        for name, column in columns.items()
    }
    assert all(error <= tolerance for error in worst.values()), worst


def given(symbols: dict[str, float]) -> dict[str, float]:
    """`simulate(parameters=...)` for values of the parameter table."""
    return {PARAMETERS[symbol]: value for symbol, value in symbols.items()}


@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
def test_structure(variant: tuple[str, str]) -> None:
    system = compiled(*variant)
    index = system.report().structural_index
    assert index == 3 if variant[1] == "rigid" else index <= 1
    assert len(system.states) == STATES[variant]


@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
def test_sine(variant: tuple[str, str]) -> None:
    t, columns = read_curve(*variant)
    agree(compiled(*variant).simulate(t1=20.0, saveat=t, rtol=1e-8), columns)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*below a vacuum:UserWarning")  # on the rod side, at a step
@pytest.mark.filterwarnings("ignore:At t = (2|12) s this equation jumps:UserWarning")  # simplified, with a rigid joint
@pytest.mark.parametrize("scenario", ["step", "endstop"])
@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
def test_other_scenarios(variant: Any, scenario: Any) -> None:
    # without the end stops of the extended cylinder the piston runs on; 11 s are within the reach of the triangle
    end = 11.0 if scenario == "endstop" and variant[0] == "simplified" else 20.0
    t = np.linspace(0.0, end, 201)
    solution = compiled(*variant, scenario).simulate(t1=end, saveat=t, rtol=1e-8)
    agree(solution, solve(*variant, scenario, t).columns)


OTHER: dict[str, dict[str, float]] = {
    "bore": {"bore": 0.28, "rod": 0.15},
    "oil": {"B": 0.9e9, "rho": 870.0, "nu": 30e-6},
    "boom": {"I": 1.4e6, "m": 9000.0, "r": 7.0},
    "triangle": {"a": 2.1, "b": 2.9, "alpha": 0.25, "beta": 0.25, "L0": 2.5},
    "supply": {"p_set": 22e6, "dp_pump": 2e6, "l": 14.0, "d": 0.032, "p_tank": 2e5, "p_comp": 0.8e6, "V_disp": 3e-4},
    "joint": {"k_c": 4e8, "c_c": 1e6, "Kp": 5.0, "Ki": 1.0},
}
"""Other values of the parameter table."""


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore:.*below a vacuum:UserWarning")  # on the rod side, with thin oil or a short boom
@pytest.mark.parametrize("variant", VARIANTS, ids="-".join)
@pytest.mark.parametrize("case", OTHER)
def test_other_parameters(variant: Any, case: str) -> None:
    t = np.linspace(0.0, 10.0, 101)
    system = compiled(*variant)
    known = {symbol: value for symbol, value in OTHER[case].items() if PARAMETERS[symbol] in system.parameters}
    solution = system.simulate(t1=10.0, saveat=t, rtol=1e-8, parameters=given(known))
    agree(solution, solve(*variant, "sine", t, **OTHER[case]).columns)


@pytest.mark.slow
def test_parameters_by_keyword_are_those_of_the_run() -> None:
    t = np.linspace(0.0, 5.0, 51)
    changed = ac.compile(reference_crane("extended", "rigid", B=1e9, bore=0.28, s=1.9)).simulate(
        t1=5.0, saveat=t, rtol=1e-8
    )
    agree(changed, solve("extended", "rigid", "sine", t, B=1e9, bore=0.28, s=1.9).columns)


def test_every_symbol_is_tunable() -> None:
    system = compiled("extended", "compliant")
    for symbol, value in vars(Parameters()).items():
        assert system.parameters[PARAMETERS[symbol]] == pytest.approx(value), symbol


def test_starts_at_rest_for_any_parameters() -> None:
    system = compiled("extended", "compliant")
    solution = system.simulate(
        t1=0.01, saveat=np.array([0.0, 0.01]), parameters=given({"bore": 0.2, "a": 2.2, "m": 8000.0})
    )
    assert solution["joint.L"][0] - 2.6 == pytest.approx(1.0, abs=1e-12)
    assert solution["boom.flange.tau"][0] == pytest.approx(8000.0 * 9.81 * 8.0 * np.cos(solution["boom.phi"][0]))
    area = np.pi / 4 * np.array([0.2**2, 0.2**2 - 0.18**2])
    assert solution["cylinder.p_a"][0] * area[0] - 1e5 * area[1] == pytest.approx(solution["joint.F"][0])
    for name in ("cylinder.v", "boom.w", "supply.pipe.q", "controller.integral"):
        assert solution[name][0] == pytest.approx(0.0, abs=1e-12)


def test_variants_are_redeclarations() -> None:
    model = Crane()
    extended = reference_crane("extended", "rigid", "step")
    assert isinstance(extended, Crane)
    assert repr(model) == repr(Crane())
    assert len(compiled("simplified", "compliant").states) == 4


@pytest.mark.parametrize(
    "arguments",
    [{"hydraulics": "extendet"}, {"joint": "loose"}, {"scenario": "triangle"}, {"boer": 0.3}],
    ids=lambda a: next(iter(a)),
)
def test_wrong_arguments_are_named(arguments: dict[str, Any]) -> None:
    with pytest.raises((TypeError, ValueError), match=r"extendet|loose|triangle|boer"):
        reference_crane(**arguments)


def test_parts_deep_inside_are_replaceable() -> None:
    model = ac.redeclare(reference_crane(), {"supply.pipe.friction": PaperFriction()})
    system = ac.compile(model)
    assert len(system.states) == 12
    assert "PaperFriction" in repr(model)
    assert "PaperFriction" not in repr(reference_crane())
