"""What a co-simulation master needs of a participant, and the polynomials in which its inputs arrive."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from ..errors import SimulationError

Floats = NDArray[np.float64]

DEGREE = 3
"""Highest degree of an input polynomial."""


class CoSimulationError(SimulationError):
    """A participant failed, or a master that cannot go on: names participant, time and step."""


@runtime_checkable
class Participant(Protocol):
    """One side of a co-simulation: it steps on its own and meets the others at communication points.

    Inputs arrive as polynomials in the time since the communication point, rows of shape (n_u, `DEGREE` + 1):
    ``u(t + s) = c[0] + c[1] s + c[2] s^2 + c[3] s^3``.

    Attributes:
        inputs: names of the inputs.
        outputs: names of the outputs, the recorded ones included.
        needs: by input, how many derivatives of it the participant uses (a position that is imposed on a mass
            needs its velocity and acceleration).
        feedthrough: names of the outputs that depend on inputs at the same instant.
        can_reject: whether `save` and `restore` work.
    """

    @property
    def inputs(self) -> tuple[str, ...]: ...

    @property
    def outputs(self) -> tuple[str, ...]: ...

    @property
    def needs(self) -> Mapping[str, int]: ...

    @property
    def feedthrough(self) -> frozenset[str]: ...

    @property
    def can_reject(self) -> bool: ...

    def initialize(self, t0: float, coefficients: Floats) -> None:
        """Put the participant at its start, with these input polynomials."""
        ...

    def step(self, t: float, h: float, coefficients: Floats) -> None:
        """Advance from t to t + h.

        Raises:
            CoSimulationError: it cannot.
        """
        ...

    def require(self, output: str, order: int) -> bool:
        """Ask, before `initialize`, for time derivatives of an output up to an order; False if it cannot give them."""
        ...

    def evaluate(self, t: float, coefficients: Floats) -> Floats:
        """Outputs and their first two time derivatives at the present state, (3, n_y); nan for unknown derivatives."""
        ...

    def save(self) -> Any:
        """The present state, for `restore`; it counts until the next one is saved."""
        ...

    def restore(self, state: Any) -> None:
        """Go back to a saved state."""
        ...

    def close(self) -> None:
        """Give resources back."""
        ...

    def nominal(self, name: str) -> float:
        """Typical magnitude of an input or output."""
        ...

    def start(self, name: str) -> float:
        """Value of an input that nothing feeds, and the guess for one that is fed."""
        ...

    def unit(self, name: str) -> str:
        """Unit of an input or output, empty if none is known."""
        ...

    @property
    def stats(self) -> dict[str, Any]:
        """Counts since the start: macro steps, inner steps, seconds."""
        ...


def constant(values: Sequence[float] | Floats) -> Floats:
    """Polynomials that hold values, (n, `DEGREE` + 1)."""
    held = np.zeros((len(values), DEGREE + 1))
    held[:, 0] = values
    return held


def value_at(coefficients: Floats, s: float) -> Floats:
    """Polynomials at time s after their origin, (n,)."""
    return coefficients @ s ** np.arange(coefficients.shape[1])


def slope_at(coefficients: Floats, s: float) -> Floats:
    """First derivatives of polynomials at time s after their origin, (n,)."""
    powers = np.arange(1, coefficients.shape[1])
    return coefficients[:, 1:] @ (powers * s ** (powers - 1))


def shifted(coefficients: Floats, s: float) -> Floats:
    """The same polynomials with their origin moved by s."""
    c0, c1, c2, c3 = coefficients.T
    return np.stack([c0 + s * (c1 + s * (c2 + s * c3)), c1 + s * (2 * c2 + s * 3 * c3), c2 + 3 * s * c3, c3], axis=1)
