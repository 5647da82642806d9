"""Conditions in diffrax solves: whether one has switched, and steps that do not jump over it."""

from __future__ import annotations

from typing import Any

import diffrax
import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from diffrax import AbstractSolver
from jax import Array

from acausal.lowering.hybrid import Roots

from .cache import ById
from .inputs import DrivenLowered
from .projection import Wrapped
from .scan import CUBIC, FURTHER, LOOKS, NODES, ROUNDING, TRUST

SMALL = 1e-90
"""The root finder asks for a small function as well as for a short interval: the interval alone is to count."""
ARMED = 1e-6
"""Part of its size that a condition may be behind its switch by rounding."""
NARROWEST = 1e-6
"""Steps shorter than this part of the rest of the run are not refused."""
_PLACES = np.sort([*LOOKS, *FURTHER])
_NODES = np.searchsorted(_PLACES, LOOKS[NODES])


def unresolved(sides: Any, noise: Any) -> Any:
    """Whether the values of each condition at `_PLACES` leave open what happens between them.

    As `acausal/lowering/c/runtime/scan.h`: the cubic through four of them is to tell the others where it matters, and a
    switch there and back has to be between two values.

    Args:
        sides: (9, n), negative where a condition has switched.
        noise: (n,) what of each is rounding.
    """
    a = CUBIC @ sides[_NODES]
    error = TRUST * jnp.max(jnp.abs(sides - np.vander(_PLACES, 4, increasing=True) @ a), axis=0)
    square = a[2] ** 2 - 3.0 * a[3] * a[1]
    root = jnp.sqrt(jnp.maximum(square, 0.0))
    bottom = jnp.where(a[2] < 0.0, (root - a[2]) / (3.0 * a[3]), -a[1] / (root + a[2]))
    between = (square > 0.0) & (bottom > 0.0) & (bottom < 1.0)
    x = jnp.where(between, bottom, 0.0)
    seen, span = jnp.min(sides, axis=0), jnp.ptp(sides, axis=0)
    least = jnp.where(between, jnp.minimum(seen, a[0] + x * (a[1] + x * (a[2] + x * a[3]))), seen)
    vague = jnp.where(seen <= 0.0, error > 0.1 * span, least < error) & (error > 10.0 * noise + ROUNDING * span)
    hidden = (seen > 0.0) & (least <= 0.0)
    on = (sides <= 0.0).any(axis=1)
    there_and_back = (on[:-1] & ~on[1:]).any()
    return vague.any() | hidden.any() | there_and_back


class Switch(eqx.Module):
    """Positive until a condition is on the other side than its mode says.

    Attributes:
        slack: (n_roots,) what a condition may be on the other side.
        size: (n_roots,) largest value of each condition at events.
        noise: (n_roots,) what of each condition is rounding.
        rest: time to the end of the stretch [s].
        held: the equations; the programs that hold a switch are kept with them, and may not keep them.
        roots: the conditions.
        together: whether y holds the algebraic unknowns behind the states.
        n_x: number of states.
    """

    slack: Array
    size: Array
    noise: Array
    rest: Array
    held: ById = eqx.field(static=True)
    roots: Roots = eqx.field(static=True)
    together: bool = eqx.field(static=True)
    n_x: int = eqx.field(static=True)

    @property
    def lowered(self) -> Any:
        """The equations."""
        return self.held.thing

    def armed(self, t: Any, y: Any, args: Any) -> Switch:
        """With slack for what has switched at the start already, but for rounding.

        The mode that an event has left is that of values computed elsewhere; where equations are nearly singular,
        those here differ. A root is a change of sign: without slack, none would be found from there on. What has been
        zero at all events so far, a time that a clock begins with, is as large as time makes it until the end.
        """
        value, rate = jax.jvp(lambda t: self.sides(t, y, args), (t,), (jnp.ones_like(t),))
        behind = jax.lax.stop_gradient(-value)
        size = jnp.where(self.size > 0.0, self.size, jax.lax.stop_gradient(jnp.abs(rate)) * self.rest)
        some = (behind >= 0.0) & (behind <= ARMED * size)
        slack = self.slack + jnp.where(some, 10.0 * behind + self.noise, 0.0)
        return Switch(slack, self.size, self.noise, self.rest, self.held, self.roots, self.together, self.n_x)

    def __call__(self, t: Any, y: Any, args: Any, **_: Any) -> Array:
        return SMALL * jnp.min(self.sides(t, y, args))

    def sides(self, t: Any, y: Any, args: Any) -> Array:
        """How far each condition is from its switch, (n_roots,)."""
        p, guess = (args, None) if self.together else args
        w = y[self.n_x :] if self.together else self.lowered.solve_algebraic(t, y[: self.n_x], guess, p)
        own: Any = self.lowered
        vector = p
        if isinstance(own, DrivenLowered):
            own, vector = own.lowered, own.at(t, p)
        g = own.residuals_of(self.roots.families, t, y[: self.n_x], w, vector)
        slots = self.roots.slots
        holds = jnp.where(slots < 0, True, vector[np.maximum(slots, 0)] != 0.0)
        return jnp.where(holds, -g, g) + self.slack


class Watched(Wrapped):
    """A diffrax solver whose steps are refused where a condition may switch there and back within them.

    Refused steps become shorter, until one ends in between, where diffrax sees it. Solvers without error estimate
    cannot be refused anything.

    """

    solver: AbstractSolver[Any]  # pyright: ignore[reportIncompatibleVariableOverride]
    switch: Switch

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> Any:
        return self.solver.init(terms, t0, t1, y0, args)

    def step(
        self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: Any, made_jump: Any
    ) -> tuple[Any, Any, Any, Any, diffrax.RESULTS]:
        """One step of the solver; see `diffrax.AbstractSolver.step`."""
        y1, error, dense, state, result = self.solver.step(terms, t0, t1, y0, args, solver_state, made_jump)
        if error is not None:
            between = self.solver.interpolation_cls(t0=t0, t1=t1, **dense)

            def sides(s: Any) -> Any:
                t = t0 + s * (t1 - t0)
                return self.switch.sides(t, between.evaluate(t), args)

            inside = jax.lax.map(sides, jnp.asarray(_PLACES[1:-1]))
            ends = self.switch.sides(t0, y0, args), self.switch.sides(t1, y1, args)
            over = unresolved(jnp.concatenate([ends[0][None], inside, ends[1][None]]), self.switch.noise)
            over &= t1 - t0 > NARROWEST * self.switch.rest
            error = jax.tree.map(lambda e: jnp.where(over, jnp.inf, e), error)
        return y1, error, dense, state, result
