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

from .inputs import DrivenLowered
from .projection import Wrapped

SMALL = 1e-30
"""The root finder asks for a small function as well as for a short interval: the interval alone is to count."""
INSIDE = (0.125, 0.25, 0.375, 0.5, 0.625, 0.75, 0.875)
"""Where within a step conditions are looked at."""


class Switch(eqx.Module):
    """Positive until a condition is on the other side than its mode says.

    Attributes:
        slack: (n_roots,) what a condition may be on the other side.
        lowered: the equations.
        roots: the conditions.
        together: whether y holds the algebraic unknowns behind the states.
        n_x: number of states.
    """

    slack: Array
    lowered: Any = eqx.field(static=True)
    roots: Roots = eqx.field(static=True)
    together: bool = eqx.field(static=True)
    n_x: int = eqx.field(static=True)

    def __call__(self, t: Any, y: Any, args: Any, **_: Any) -> Array:
        p, guess = (args, None) if self.together else args
        w = y[self.n_x :] if self.together else self.lowered.solve_algebraic(t, y[: self.n_x], guess, p)
        own: Any = self.lowered
        vector = p
        if isinstance(own, DrivenLowered):
            own, vector = own.lowered, own.at(t, p)
        g = own.residuals_of(self.roots.families, t, y[: self.n_x], w, vector)
        slots = self.roots.slots
        holds = jnp.where(slots < 0, True, vector[np.maximum(slots, 0)] != 0.0)
        return SMALL * jnp.min(jnp.where(holds, -g, g) + self.slack)


class Watched(Wrapped):
    """A diffrax solver whose steps are refused where a condition switches there and back within them.

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

            def side(s: Any) -> Any:
                t = t0 + s * (t1 - t0)
                return self.switch(t, between.evaluate(t), args)

            inside = jnp.min(jax.lax.map(side, jnp.asarray(INSIDE)))
            over = (inside <= 0.0) & (self.switch(t1, y1, args) > 0.0)
            error = jax.tree.map(lambda e: jnp.where(over, jnp.inf, e), error)
        return y1, error, dense, state, result
