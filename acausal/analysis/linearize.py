"""Linearization about a point: the state-space matrices with their names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..language.template import Floats

if TYPE_CHECKING:
    from ..system import System


@dataclass(frozen=True, slots=True)
class StateSpace:
    """``dx = A x + B u``, ``y = C x + D u``, as deviations from the point of linearization.

    Attributes:
        A: (n_x, n_x).
        B: (n_x, n_u).
        C: (n_y, n_x).
        D: (n_y, n_u).
        states, inputs, outputs: names of rows and columns.
        x: states at the point, (n_x,).
    """

    A: Floats
    B: Floats
    C: Floats
    D: Floats
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: Floats

    @property
    def poles(self) -> Any:
        """Eigenvalues of A [1/s], complex (n_x,), by real part."""
        values = np.linalg.eigvals(self.A)
        return values[np.lexsort((values.imag, values.real))]


def linearize(
    system: System,
    t: float = 0.0,
    x: Any = None,
    *,
    parameters: Mapping[str, Any] | None = None,
    outputs: Sequence[str] = (),
) -> StateSpace:
    """State-space matrices of `system` at time `t` and states `x`, by automatic differentiation.

    Inputs are the model's own `Input` fields; `outputs` default to those given to `acausal.compile`. Where the states
    are bound by invariants (index reduction that kept them), A acts on the constrained coordinates together.

    Args:
        system: a compiled model.
        t: time [s].
        x: states (n_x,); those of the start by default.
        parameters: dotted name to value.
        outputs: dotted names of variables.

    Raises:
        UnknownNameError: an output or parameter that the model does not have.
    """
    import jax
    import jax.numpy as jnp

    from ..simulation.jit import ensure_x64

    ensure_x64()
    low = system.lowered
    x0, w0, p = system.initialize(t, parameters)
    x = jnp.asarray(x0 if x is None else x, float)
    n_u, first = len(system.input_names), system.stages.flat.n_par
    names = tuple(outputs) or system.outputs
    ids = np.array([int(np.ravel(system.index_of(name))[0]) for name in names], np.int64)
    w_guess = jnp.asarray(w0)

    def both(x: Any, u: Any) -> tuple[Any, Any]:
        q = jnp.asarray(p).at[first : first + n_u].set(u) if n_u else jnp.asarray(p)
        w = low.solve_algebraic(t, x, w_guess, q)
        dx, _ = low.derivatives(t, x, w, q)
        return dx, low.observe(t, x, w, q, ids) if len(ids) else jnp.zeros(0)

    u0 = jnp.asarray(p)[first : first + n_u]
    (a, b), (c, d) = jax.jit(jax.jacfwd(both, argnums=(0, 1)))(x, u0)
    a, b, c, d = (np.asarray(m) for m in (a, b, c, d))
    return StateSpace(a, b, c, d, system.states, system.input_names, names, np.asarray(x))
