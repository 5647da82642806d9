"""The inside of an in-process participant as JAX programs: works wherever JAX does, with any diffrax solver."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np

from ..simulation.jit import compiler_options
from ..system import System
from .driven import PolynomialDriven
from .inner_solvers import advance_with
from .participant import Floats


class JaxInner:
    """Steps and evaluates a system whose inputs are polynomials.

    Args:
        system: the compiled model.
        places: entries of its parameter vector that the polynomials give.
        solver, dt, rtol, atol: as in `advance_with`.
        outputs: numbers of the variables to give out.
        orders: derivatives of each that are wanted, at most 2.
    """

    def __init__(
        self, system: System, places: Any, *, solver: Any, dt: float | None, rtol: float, atol: float,
        outputs: Sequence[int], orders: Sequence[int],
    ) -> None:  # fmt: skip
        self.lowered = system.lowered
        self.driven = PolynomialDriven(system.lowered, places)
        self.inner = advance_with(self.driven, solver, dt=dt, rtol=rtol, atol=atol)
        self.outputs, self.orders = np.asarray(outputs, int), np.asarray(orders, int)

    @cached_property
    def _advance(self) -> Any:
        n_x = self.driven.n_x

        def advance(clock: Any, z: Any, p: Any, matrix: Any) -> tuple[Any, Any]:
            t, h, hint = clock[0], clock[1], clock[2]
            x, w, hint, steps, ok = self.inner(t, h, z[:n_x], z[n_x:], (p, matrix, t), hint)
            return jnp.concatenate([x, w]), jnp.stack([hint, steps * 1.0, ok * 1.0])

        return jax.jit(advance, compiler_options=compiler_options(True))

    def step(self, t: float, h: float, z: Any, p: Any, matrix: Floats, hint: float) -> tuple[Any, float, int, bool]:
        """State after a macro step, inner step in use, inner steps taken, whether it succeeded."""
        z, told = self._advance(np.array([t, h, hint if hint > 0 else 1e-3 * h]), z, p, matrix)
        hint, steps, ok = np.asarray(told)
        return z, float(hint), int(steps), bool(ok)

    def _values(self, t: Any, x: Any, w: Any, p: Any, which: Any) -> Any:
        w = self.driven.solve_algebraic(t, x, w, p) if self.driven.n_w else w
        return self.lowered.observe(t, x, w, self.driven.at(t, p), which)

    def _along(self, function: Any) -> Any:
        """Time derivative of a function of (t, x) along the motion."""
        driven = self.driven

        def derivative(t: Any, x: Any, w: Any, p: Any) -> Any:
            solved = driven.solve_algebraic(t, x, w, p) if driven.n_w else w
            flow = driven.derivatives(t, x, solved, p)[0]
            return jax.jvp(lambda t, x: function(t, x, w, p), (t, x), (jnp.ones_like(t), flow))[1]

        return derivative

    @cached_property
    def _observe(self) -> Any:
        n_x = self.driven.n_x

        def observe(t: Any, z: Any, p: Any, matrix: Any) -> Any:
            full, x, w = (p, matrix, t), z[:n_x], z[n_x:]
            out = jnp.full((3, len(self.outputs)), jnp.nan)
            if len(self.outputs):
                out = out.at[0].set(self._values(t, x, w, full, self.outputs))
            for order in (1, 2):
                places = np.flatnonzero(self.orders >= order)
                if not len(places):
                    continue

                def function(t: Any, x: Any, w: Any, p: Any, which: Any = self.outputs[places]) -> Any:
                    return self._values(t, x, w, p, which)

                for _ in range(order):
                    function = self._along(function)
                out = out.at[order, places].set(function(t, x, w, full))
            return out

        return jax.jit(observe, compiler_options=compiler_options(True))

    def remember(self) -> Any:
        """What there is to save besides the states."""

    def recall(self, memory: Any) -> None:
        """Go back to what was remembered."""

    def evaluate(self, t: float, z: Any, p: Any, matrix: Floats) -> Floats:
        """Outputs and their derivatives, (3, n_y)."""
        return np.asarray(self._observe(np.float64(t), z, p, matrix))
