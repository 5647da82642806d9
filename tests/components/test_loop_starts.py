"""A loop is put together as its guesses say, wherever a fixed start puts its drive."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, connect, inner, start
from acausal.components import planar, rotational

CRANK, COUPLER, ROCKER = 0.4, 1.2, 0.9


class FourBar(Component):
    """A crank with a damper, whose angle has a guess of its own: zero."""

    planarWorld: planar.PlanarWorld = inner(planar.PlanarWorld())
    left: planar.Fixed = planar.Fixed()
    right: planar.Fixed = planar.Fixed(r=(1.0, 0.0))
    crank: planar.Revolute = planar.Revolute(useFlange=True, phi=start(2.0, fixed=True), w=start(1.0, fixed=True))
    damper: rotational.Damper = rotational.Damper(d=1.0)
    bar: planar.FixedTranslation = planar.FixedTranslation(r=(CRANK, 0.0))
    knee: planar.Revolute = planar.Revolute()
    coupler: planar.FixedTranslation = planar.FixedTranslation(r=(COUPLER, 0.0))
    body: planar.Body = planar.Body()
    hip: planar.Revolute = planar.Revolute()
    rocker: planar.FixedTranslation = planar.FixedTranslation(r=(ROCKER, 0.0))
    end: planar.Revolute = planar.Revolute()

    def equations(self) -> Equations:
        yield connect(self.left.frame, self.crank.frame_a)
        yield connect(self.crank.support, self.damper.flange_a)
        yield connect(self.crank.flange_a, self.damper.flange_b)
        yield connect(self.crank.frame_b, self.bar.frame_a)
        yield connect(self.bar.frame_b, self.knee.frame_a)
        yield connect(self.knee.frame_b, self.coupler.frame_a)
        yield connect(self.coupler.frame_b, self.hip.frame_a, self.body.frame_a)
        yield connect(self.hip.frame_b, self.rocker.frame_a)
        yield connect(self.rocker.frame_b, self.end.frame_a)
        yield connect(self.right.frame, self.end.frame_b)


def joints(phi: float, side: float) -> tuple[float, float]:
    """Angles of knee and hip where the coupler lies on one `side` of the line from the knee to the end."""
    knee = CRANK * np.exp(1j * phi)
    across = 1.0 - knee
    length = abs(across)
    coupler = np.angle(across) + side * np.arccos((COUPLER**2 + length**2 - ROCKER**2) / (2 * COUPLER * length))
    rocker = np.angle(across - COUPLER * np.exp(1j * coupler))
    return float(coupler - phi), float(rocker - coupler)


@cache
def compiled(phi: float, side: float) -> ac.System:
    knee, hip = joints(phi, side)
    parts: Any = {"knee": planar.Revolute(phi=start(knee)), "hip": planar.Revolute(phi=start(hip))}
    return ac.compile(FourBar(**parts))


@pytest.mark.parametrize("side", [1.0, -1.0])
def test_the_fixed_angle_of_a_crank_counts_before_the_guess_of_its_damper(side: float) -> None:
    solution = compiled(2.0, side).simulate(1e-3, saveat=2)
    np.testing.assert_allclose((solution["knee.phi"][0], solution["hip.phi"][0]), joints(2.0, side), atol=1e-9)


def test_the_guess_of_a_model_counts_before_that_of_a_class() -> None:
    """That of the damper's angle, zero, is one of its class."""
    knee, hip = joints(2.0, 1.0)
    crank = planar.Revolute(useFlange=True, phi=start(2.0, fixed=False), w=start(1.0, fixed=True))
    parts: Any = {"crank": crank, "knee": planar.Revolute(phi=start(knee)), "hip": planar.Revolute(phi=start(hip))}
    solution = ac.compile(FourBar(**parts)).simulate(1e-3, saveat=2)
    np.testing.assert_allclose([solution[f"{n}.phi"][0] for n in ("crank", "knee", "hip")], (2.0, knee, hip), atol=1e-9)


@pytest.mark.parametrize("inside", [False, True])
def test_an_angle_that_is_given_to_a_run_counts_too(inside: bool) -> None:
    """The guesses are those for -3 rad, where the crank stands by its declaration at 2 rad."""
    system = compiled(-3.0, 1.0)

    def begun(phi: Any) -> Any:
        return system.initialize(0.0, None, {"crank.phi": phi})[0]

    x = dict(zip(system.states, np.asarray((ac.jit(begun) if inside else begun)(-3.0)).tolist(), strict=True))
    np.testing.assert_allclose((x["knee.phi"], x["hip.phi"]), joints(-3.0, 1.0), atol=1e-9)
