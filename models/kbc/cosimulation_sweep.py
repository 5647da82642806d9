"""Accuracy and cost of the crane's co-simulation against the macro step, fixed and adaptive."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

from acausal.fmi.participant import CoSimulationError
from acausal.fmi.splitting import Split

from .cosimulation import Method, Outcome, Reference, Stage, cosimulate

METHODS: Final[tuple[tuple[Method, int], ...]] = (
    ("jacobi", 0),
    ("jacobi", 1),
    ("jacobi", 2),
    ("gauss-seidel", 0),
    ("gauss-seidel", 1),
    ("gauss-seidel", 2),
)
"""Methods of the master and orders of extrapolation."""
NAMES: Final[dict[Method, str]] = {"jacobi": "Jacobi", "gauss-seidel": "Gauss-Seidel"}
MACRO_STEPS: Final = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3, 5e-3, 1e-2, 2e-2)
"""Macro steps of the sweep [s]."""
ADAPTIVE: Final[tuple[tuple[Method, int], ...]] = (("jacobi", 1), ("gauss-seidel", 2))
"""Methods with which the adaptive macro step is compared."""
_MOST: Final = 30
"""Times the steps of an adaptive run that are tried with a fixed macro step."""


def sweep(
    cut: Split, reference: Reference, steps: Sequence[float], duration: float, stage: Stage = lambda _: None
) -> list[Outcome]:
    """Co-simulations with all methods of the master and these macro steps [s]; `stage` is told about each."""
    made: list[Outcome] = []
    for method, order in METHODS:
        for step in steps:
            stage(f"macro step {1e3 * step:g} ms, {method}, order {order}")
            made.append(cosimulate(cut, reference, duration, method=method, order=order, step=step))
    return made


def largest_step(cut: Split, reference: Reference, method: Method, order: int, duration: float) -> float:
    """A macro step of 2 ms to 0.2 s with which the co-simulation holds, while one 1.1 times as long diverges [s]."""

    def holds(step: float) -> bool:
        return not cosimulate(cut, reference, duration, method=method, order=order, step=step).diverged

    low, high = 2e-3, 0.2
    if holds(high):
        return high
    while high > 1.1 * low:
        middle = (low * high) ** 0.5
        low, high = (middle, high) if holds(middle) else (low, middle)
    return low


def adaptive_runs(
    cut: Split, reference: Reference, tolerances: Sequence[float], duration: float, stage: Stage = lambda _: None
) -> list[Outcome]:
    """Co-simulations with an adaptive macro step by `ADAPTIVE` methods; `stage` is told about each."""
    made: list[Outcome] = []
    for method, order in ADAPTIVE:
        for tolerance in tolerances:
            stage(f"adaptive macro step, tolerance {tolerance:g}, {method}, order {order}")
            made.append(cosimulate(cut, reference, duration, method=method, order=order, tolerance=tolerance))
    return made


@dataclass(frozen=True)
class Comparison:
    """An adaptive run, and the fixed macro step that is as accurate.

    Attributes:
        adaptive: the run with a tolerance.
        fixed: the run with the largest fixed macro step found that is at least as accurate.
        tolerance: of the adaptive run.
    """

    adaptive: Outcome
    fixed: Outcome
    tolerance: float


def compare_adaptive(cut: Split, reference: Reference, tolerance: float, duration: float, **options: Any) -> Comparison:
    """An adaptive co-simulation and the fixed macro step that is as accurate, by bisection of the number of steps.

    Args:
        cut: of `cut_crane`.
        reference: at least as long.
        tolerance: of the adaptive master.
        duration: simulated time [s].
        **options: of `cosimulate`, for both.

    Raises:
        CoSimulationError: the adaptive run diverged, or no fixed macro step is as accurate.
    """
    adaptive = cosimulate(cut, reference, duration, tolerance=tolerance, **options)
    if adaptive.diverged:
        raise CoSimulationError(f"the adaptive co-simulation diverged with tolerance {tolerance:g}")

    def fixed(n: int) -> Outcome:
        return cosimulate(cut, reference, duration, step=duration / n, **options)

    def enough(outcome: Outcome) -> bool:
        return not outcome.diverged and outcome.rmse <= adaptive.rmse

    high = adaptive.steps
    found = fixed(high)
    while not enough(found):
        high = round(1.5 * high)
        if high > _MOST * adaptive.steps:
            least = duration / high
            raise CoSimulationError(f"no fixed step down to {least:.2g} s is as accurate as tolerance {tolerance:g}")
        found = fixed(high)
    low = high // 2
    while low > 1 and enough(nearer := fixed(low)):
        high, found, low = low, nearer, low // 2
    while high - low > max(1, 0.05 * low):
        middle = round((low * high) ** 0.5)
        nearer = fixed(middle)
        if enough(nearer):
            high, found = middle, nearer
        else:
            low = middle
    return Comparison(adaptive, found, tolerance)
