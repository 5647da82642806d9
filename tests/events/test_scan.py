"""The scan of conditions that are known at single times."""

from __future__ import annotations

import numpy as np
import pytest

from acausal.simulation.scan import Scan


class Counted:
    """-sin(pi t), which counts how often it is asked for."""

    def __init__(self) -> None:
        self.count = 0

    def __call__(self, t: float) -> np.ndarray:
        self.count += 1
        assert self.count < 10_000, "the scan does not come to its end"
        return np.array([-np.sin(np.pi * t)])


@pytest.mark.parametrize("end", [1.0, 1.0 - 1e-16])
def test_a_condition_that_is_at_its_switch_at_the_end_by_rounding(end: float) -> None:
    """At t = 1 the sine is 1e-16: near there, its rounding is all that matters."""
    assert Scan(Counted(), np.array([False])).first(1e-3, end) is None


def test_a_switch_close_to_the_end_is_found() -> None:
    found = Scan(Counted(), np.array([False])).first(1e-3, 1.0 + 1e-9)
    assert found is not None and found[0] <= 1.0 <= found[1] + 1e-15


@pytest.mark.parametrize("ulps", [1, 2, 5])
def test_a_stretch_of_a_few_roundings_of_time_ends(ulps: int) -> None:
    """Between two events at nearly the same time no interval can be halved as often as in others."""
    begin, count = 0.005, 0
    end = begin + ulps * np.spacing(begin)

    def beyond(t: float) -> np.ndarray:
        nonlocal count
        count += 1
        assert count < 1_000, "the scan does not come to its end"
        return np.array([t - 2 * end + begin])

    assert Scan(beyond, np.array([True])).first(begin, end) is None
