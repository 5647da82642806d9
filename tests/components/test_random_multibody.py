"""Random trees of bodies in space, and trees with a loop: energy is kept, by both engines, and they agree."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal import Component, inner, start
from acausal.components import multibody as mb
from acausal.components.examples import assemble

from .test_multibody_loops import energy


def direction(rng: np.random.Generator) -> tuple[float, float, float]:
    """A coordinate axis, or any direction."""
    v = rng.normal(size=3) if rng.random() < 0.5 else rng.permutation(np.eye(3))[0]
    return (float(v[0]), float(v[1]), float(v[2]))


def joint(rng: np.random.Generator, kind: str, fixed: bool) -> Component:
    """A joint somewhere in its motion; velocities are guesses where a loop may ask for others."""
    q = [start(float(x), fixed=True) for x in rng.uniform(-0.8, 0.8, 2)]
    v = [start(float(x) if fixed else 0.0, fixed=fixed) for x in rng.uniform(-1.0, 1.0, 2)]
    n = direction(rng)
    if kind == "Revolute":
        return mb.Revolute(n=n, phi=q[0], w=v[0])
    if kind == "Prismatic":
        return mb.Prismatic(n=n, s=q[0], v=v[0])
    if kind == "Cylindrical":
        return mb.Cylindrical(n=n, s=q[0], v=v[0], phi=q[1], w=v[1])
    if kind == "Universal":
        other = np.cross(n, rng.normal(size=3))
        return mb.Universal(n_a=n, n_b=tuple(other.tolist()), phi_a=q[0], w_a=v[0], phi_b=q[1], w_b=v[1])
    angles, w = (tuple(rng.uniform(-0.8, 0.8, 3).tolist()) for _ in range(2))
    return mb.Spherical(angles_fixed=True, angles_start=angles, w_rel_a_fixed=fixed, w_rel_a_start=w)


def body(rng: np.random.Generator) -> mb.BodyShape:
    I_11, I_22 = rng.uniform(0.1, 0.5, 2).tolist()
    r, r_CM = (tuple(rng.uniform(-1.0, 1.0, 3).tolist()) for _ in range(2))
    return mb.BodyShape(r=r, r_CM=r_CM, m=float(rng.uniform(0.5, 2.0)), I_11=I_11, I_22=I_22, I_33=0.8 * (I_11 + I_22))


def mechanism(seed: int, *, loop: bool) -> tuple[Component, list[str]]:
    """Bodies, each on a joint at an earlier one; with a loop, a rod holds the end of the last to the world."""
    rng = np.random.default_rng(seed)
    kinds = ["Revolute", "Prismatic", "Cylindrical", "Universal", "Spherical"]
    n = int(rng.integers(2, 4))
    parts: dict[str, Component] = {"world": inner(mb.World())}
    connections: list[str] = []
    for k in range(n):
        on = int(rng.integers(-1, k)) if k and not loop else k - 1
        parts[f"joint{k}"] = joint(rng, kinds[int(rng.integers(len(kinds)))], fixed=not loop)
        parts[f"link{k}"] = body(rng)
        below = "world.frame_b" if on < 0 else f"link{on}.frame_b"
        connections += [f"{below} - joint{k}.frame_a", f"joint{k}.frame_b - link{k}.frame_a"]
    if loop:
        parts["ground"] = mb.Fixed(r=(3.0, 1.0, -2.0))
        parts["rod"] = mb.SphericalSpherical(computeRodLength=True)
        connections += [f"link{n - 1}.frame_b - rod.frame_a", "ground.frame_b - rod.frame_b"]
    return assemble(*connections, **parts), [f"link{k}.body" for k in range(n)]


@pytest.mark.parametrize(("seed", "loop"), [
    *((k, False) for k in range(3)), (11, True), (12, True),
    *(pytest.param(k, k > 5, marks=pytest.mark.slow) for k in (3, 4, 5, 10, 13, 14)),
])  # fmt: skip
def test_energy_is_kept(seed: int, loop: bool) -> None:
    model, bodies = mechanism(seed, loop=loop)
    system = ac.compile(model)
    solution = system.simulate(1.0, saveat=21, rtol=1e-9, engine="native")
    total = energy(system, solution, bodies)
    assert np.ptp(total) < 1e-6 * max(float(np.abs(total).max()), 1.0)
    if loop:
        ends = np.asarray(solution["rod.frame_b.r_0"]) - np.asarray(solution["rod.frame_a.r_0"])
        assert np.ptp(np.linalg.norm(ends, axis=1)) < 1e-8


@pytest.mark.parametrize(("seed", "loop"), [
    (1, False), (2, False), (4, False), *((k, True) for k in (10, 11, 13)),
])  # fmt: skip
@pytest.mark.slow
def test_both_engines_agree(seed: int, loop: bool) -> None:
    model, bodies = mechanism(seed, loop=loop)
    system = ac.compile(model)
    first, second = (system.simulate(1.0, saveat=11, rtol=1e-9, engine=e) for e in ("native", "diffrax"))
    for name in bodies:
        np.testing.assert_allclose(first[f"{name}.r_0"], second[f"{name}.r_0"], atol=1e-6, err_msg=name)
