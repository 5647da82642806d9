"""The paper's law of pipe friction jumps at Re = 2000: the flow chatters there, and a run says so."""

from __future__ import annotations

import inspect
import re
from typing import Literal

import numpy as np
import pytest
from scipy.optimize import brentq

import acausal as ac
from acausal import Component, Equations, connect, inner, start
from acausal.components import blocks, hydraulic
from models.kbc import reference_crane

CHATTERS = re.compile(
    r"At t = ([-+.\de]+) s a condition chatters: .*\n +`(\S+) < 2000` \((\S+), (\S+):(\d+) \((\w+)\)\)"
)


class Bench(Component):
    """A pipe between a pressure that rises evenly and a tank."""

    oil: hydraulic.Oil = inner(hydraulic.Oil())
    rise: blocks.Slope = blocks.Slope(offset=1e5, slope=2e4)
    source: hydraulic.PressureSource = hydraulic.PressureSource()
    pipe: hydraulic.Pipe = hydraulic.Pipe(d=0.02, friction=hydraulic.PaperFriction(), q=start(0.0, fixed=True))
    tank: hydraulic.Tank = hydraulic.Tank(p=1e5)

    def equations(self) -> Equations:
        yield connect(self.rise.y, self.source.p)
        yield connect(self.source.port, self.pipe.port_a)
        yield connect(self.pipe.port_b, self.tank.port)


def assert_named(message: str, pipe: str) -> float:
    """The error names the relation, its component and its line; the time that it gives."""
    found = CHATTERS.match(message)
    assert found, message
    time, relation, component, file, line, cls = found.groups()
    assert (relation, component, cls) == (f"{pipe}.friction.Re", f"{pipe}.friction", "PaperFriction")
    assert file == inspect.getsourcefile(hydraulic.PaperFriction)
    source, first = inspect.getsourcelines(hydraulic.PaperFriction)
    assert "where(self.Re < 2000.0" in source[int(line) - first]
    return float(time)


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_the_law_of_the_paper_chatters(engine: Literal["native", "diffrax"]) -> None:
    system = ac.compile(Bench())
    with pytest.raises(ac.SimulationError) as error:
        system.simulate(t1=20.0, saveat=3, engine=engine)
    # up to there the flow is laminar: it takes the pressure with a lag of T = d^2/(32 nu)
    lag, conductance = 0.02**2 / (32 * 46e-6), np.pi * 0.02**4 / (128 * 46e-6 * 850.0 * 10.0)
    flow = 2000 * 46e-6 * np.pi / 4 * 0.02
    reached = brentq(lambda t: conductance * 2e4 * (t - lag * (1 - np.exp(-t / lag))) - flow, 0.1, 20.0)
    assert abs(assert_named(str(error.value), "pipe") - float(reached)) < 1e-5


@pytest.mark.parametrize("engine", ["native", "diffrax"])
@pytest.mark.slow_case("diffrax")
def test_the_blended_law_does_not(engine: Literal["native", "diffrax"]) -> None:
    model = ac.redeclare(Bench(), {"pipe.friction": hydraulic.BlendedFriction()})
    solution = ac.compile(model).simulate(t1=20.0, saveat=201, rtol=1e-8, engine=engine)
    reynolds = np.asarray(solution["pipe.friction.Re"])
    assert reynolds[0] == 0.0 and reynolds[-1] > 2100.0
    assert (np.diff(reynolds) > 0.0).all()


def test_the_crane_with_the_law_of_the_paper_chatters() -> None:
    crane = ac.redeclare(reference_crane("extended", "rigid"), {"supply.pipe.friction": hydraulic.PaperFriction()})
    with pytest.raises(ac.SimulationError) as error:
        ac.compile(crane).simulate(t1=20.0, saveat=3)
    assert 0.0 < assert_named(str(error.value), "supply.pipe") < 20.0
