"""Reference motions of the piston."""

from __future__ import annotations

from acausal import Equations
from acausal.components import blocks


class TwoSteps(blocks.SignalSource):
    """Sum of two steps, ``y = first.y + second.y``.

    Source: scenario *step* of the reference crane.
    """

    first: blocks.Step = blocks.Step(offset=1.0, height=0.2, startTime=2.0)
    second: blocks.Step = blocks.Step(height=-0.35, startTime=12.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.first.y + self.second.y


def scenario_source(scenario: str) -> blocks.SignalSource:
    """Source of the piston's reference displacement [m].

    Args:
        scenario: ``sine`` (Fig. 11 of the paper: ``1 + 0.3 sin(2 pi 0.05 t)``), ``step`` (up 0.2 m after 2 s, down
        0.35 m
            after 12 s) or ``endstop`` (``1 + 0.12 t``, into the upper bumper).

    Raises:
        ValueError: any other name.
    """
    if scenario == "sine":
        return blocks.Sine(amplitude=0.3, f=0.05, offset=1.0)
    if scenario == "step":
        return TwoSteps()
    if scenario == "endstop":
        return blocks.Slope(offset=1.0, slope=0.12)
    raise ValueError(f"no scenario {scenario!r}: the reference crane has 'sine', 'step' and 'endstop'")
