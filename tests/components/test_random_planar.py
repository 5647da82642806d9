"""Random trees of planar bodies against Lagrange's equations, derived by automatic differentiation of the energies."""

from __future__ import annotations

from dataclasses import dataclass

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import acausal as ac
from acausal import Component, inner, start
from acausal.components import planar
from acausal.components.examples import assemble

GRAVITY = (1.3, -9.81)


@dataclass(frozen=True)
class Link:
    """A joint at a point of an earlier link (or of the wall, -1), a rod from it, and a body at the rod's end.

    Attributes:
        on: number of the link that carries the joint.
        slides: a prismatic joint along the rod's direction, else a revolute one.
        r: rod, in the frame of the joint [m].
        m, inertia: of the body [kg], [kg m2].
        q, v: coordinate of the joint and its velocity at the start.
    """

    on: int
    slides: bool
    r: tuple[float, float]
    m: float
    inertia: float
    q: float
    v: float


def tree(seed: int) -> list[Link]:
    rng = np.random.default_rng(seed)
    links: list[Link] = []
    for k in range(int(rng.integers(2, 5))):
        r = rng.uniform(0.3, 1.0, 2) * rng.choice([-1.0, 1.0], 2)
        on, slides = int(rng.integers(-1, k)) if k else -1, bool(k and rng.random() < 0.3)
        (m, inertia), (q, v) = rng.uniform(0.5, 2.0, 2), rng.uniform(-1.0, 1.0, 2)
        links.append(Link(on, slides, (float(r[0]), float(r[1])), m, inertia, q, v))
    return links


def model(links: list[Link]) -> Component:
    """The tree of library components; a spring from the wall to the last body."""
    parts: dict[str, Component] = {"wall": planar.Fixed(r=(0.1, 0.0))}
    parts["spring"] = planar.Spring(c=5.0, s_unstretched=0.5)
    connections = ["wall.frame - spring.frame_a", f"body{len(links) - 1}.frame_a - spring.frame_b"]
    for k, link in enumerate(links):
        q, v = start(link.q, fixed=True), start(link.v, fixed=True)
        parts[f"joint{k}"] = planar.Prismatic(r=link.r, s=q, v=v) if link.slides else planar.Revolute(phi=q, w=v)
        parts[f"rod{k}"] = planar.FixedTranslation(r=link.r)
        parts[f"body{k}"] = planar.Body(m=link.m, I=link.inertia)
        below = "wall.frame" if link.on < 0 else f"rod{link.on}.frame_b"
        connections += [
            f"{below} - joint{k}.frame_a", f"joint{k}.frame_b - rod{k}.frame_a", f"rod{k}.frame_b - body{k}.frame_a"
        ]  # fmt: skip
    world = inner(planar.PlanarWorld(constantGravity=GRAVITY))
    return assemble(*connections, planarWorld=world, **parts)


def places(links: list[Link], q: jax.Array) -> list[tuple[jax.Array, jax.Array]]:
    """Position and angle of every body, from the joint coordinates."""
    found: list[tuple[jax.Array, jax.Array]] = []
    for k, link in enumerate(links):
        at, angle = (jnp.array([0.1, 0.0]), jnp.array(0.0)) if link.on < 0 else found[link.on]
        rod = jnp.array(link.r)
        if link.slides:
            rod = rod * (1 + q[k] / jnp.hypot(*link.r))
        else:
            angle = angle + q[k]
        c, s = jnp.cos(angle), jnp.sin(angle)
        found.append((at + jnp.array([c * rod[0] - s * rod[1], s * rod[0] + c * rod[1]]), angle))
    return found


def lagrange(links: list[Link]) -> jax.stages.Wrapped:
    """d/dt (q, v) of the tree: ``M(q) dv/dt = dL/dq - d(dL/dv)/dq v``."""

    def energies(q: jax.Array, v: jax.Array) -> jax.Array:
        total = jnp.array(0.0)
        rate = jax.jvp(lambda x: places(links, x), (q,), (v,))[1]
        for link, (r, _), (dr, w) in zip(links, places(links, q), rate, strict=True):
            total += 0.5 * link.m * dr @ dr + 0.5 * link.inertia * w**2 + link.m * jnp.array(GRAVITY) @ r
        stretch = jnp.linalg.norm(places(links, q)[-1][0] - jnp.array([0.1, 0.0])) - 0.5
        return total - 0.5 * 5.0 * stretch**2

    def rates(_: float, z: jax.Array) -> jax.Array:
        q, v = jnp.split(z, 2)
        momentum = jax.grad(energies, argnums=1)
        mass = jax.jacobian(momentum, argnums=1)(q, v)
        force = jax.grad(energies)(q, v) - jax.jvp(lambda x: momentum(x, v), (q,), (v,))[1]
        return jnp.concatenate([v, jnp.linalg.solve(mass, force)])

    return jax.jit(rates)


@pytest.mark.parametrize("seed", [0, *(pytest.param(k, marks=pytest.mark.slow) for k in (1, 2, 3)), 4])
def test_tree_moves_as_lagrange_says(seed: int) -> None:
    links = tree(seed)
    t = np.linspace(0.0, 1.0, 11)
    system = ac.compile(model(links))
    solution = system.simulate(t1=1.0, saveat=t, rtol=1e-9)
    begin = np.array([link.q for link in links] + [link.v for link in links])
    wanted = solve_ivp(lagrange(links), (0.0, 1.0), begin, method="DOP853", t_eval=t, rtol=1e-10, atol=1e-11).y
    for k, link in enumerate(links):
        name = f"joint{k}.{'s' if link.slides else 'phi'}"
        assert_allclose(solution[name], wanted[k], atol=1e-6 * (1 + np.abs(wanted[k]).max()), err_msg=name)
    assert len(system.states) == 2 * len(links)
