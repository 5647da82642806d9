"""A lowered system whose inputs follow polynomials in time."""

from __future__ import annotations

from typing import Any

from jax import Array

from ..language.template import Ints
from ..lowering.lowered import Lowered
from .participant import DEGREE

Driven = tuple[Array, Array, Any]
"""Parameter vector, coefficients (n_inputs, DEGREE + 1), and the time of their origin [s]."""


class PolynomialDriven:
    """The functions of a lowered system, with `Driven` in the place of the parameter vector.

    Args:
        lowered: the system.
        places: entries of its parameter vector that the polynomials give, (n_inputs,).
    """

    def __init__(self, lowered: Lowered, places: Ints) -> None:
        self.lowered = lowered
        self.places = places
        self.n_x, self.n_w, self.n_g = lowered.n_x, lowered.n_w, lowered.n_g
        self.x_nominal, self.w_nominal = lowered.x_nominal, lowered.w_nominal
        self.conserved, self.time_tables = lowered.conserved, lowered.time_tables

    def at(self, t: Any, p: Driven) -> Array:
        """The parameter vector at time t."""
        vector, coefficients, origin = p
        if not len(self.places):
            return vector
        s = t - origin
        values = coefficients[:, DEGREE]
        for k in range(DEGREE - 1, -1, -1):
            values = values * s + coefficients[:, k]
        return vector.at[self.places].set(values)

    def derivatives(self, t: Any, x: Array, w: Array, p: Any) -> tuple[Array, Array]:
        """As `Lowered.derivatives`."""
        return self.lowered.derivatives(t, x, w, self.at(t, p))

    def invariants(self, t: Any, x: Array, w: Array, p: Any) -> Array:
        """As `Lowered.invariants`."""
        return self.lowered.invariants(t, x, w, self.at(t, p))

    def solve_algebraic(self, t: Any, x: Array, w_guess: Array, p: Any) -> Array:
        """As `Lowered.solve_algebraic`."""
        return self.lowered.solve_algebraic(t, x, w_guess, self.at(t, p))
