"""Linearization about a point: the state-space matrices with their names."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UnknownNameError, nearest
from ..language.template import Floats

if TYPE_CHECKING:
    from ..system import System

RANK = 1e-9
"""Singular values of the invariants' slopes below this are none: an invariant repeats others."""


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
        G: slopes of the invariants of the states (n_g, n_x): deviations that the model can make have ``G x = 0``.
    """

    A: Floats
    B: Floats
    C: Floats
    D: Floats
    states: tuple[str, ...]
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]
    x: Floats
    G: Floats

    @property
    def poles(self) -> Any:
        """Eigenvalues of A [1/s], complex, by real part; of states that invariants bind, as many as can move freely."""
        free = _null_space(self.G)
        values = np.linalg.eigvals(free.T @ self.A @ free)
        return values[np.lexsort((values.imag, values.real))]


def _null_space(G: Floats) -> Floats:
    """Orthonormal directions (n_x, n_x - rank) in which no row of G changes; rows may repeat each other."""
    size = np.abs(G).max(axis=1, initial=0.0)
    _, values, directions = np.linalg.svd(G[size > 0] / size[size > 0, None])
    return directions[int((values > RANK).sum()) :].T


def checked_inputs(system: System, inputs: Mapping[str, float] | None) -> dict[str, float]:
    """The values of inputs, which are numbers.

    Raises:
        UnknownNameError: the model has no such input.
    """
    for name in inputs or {}:
        if name not in system.input_names:
            known = nearest(name, system.input_names) or f" Its inputs are: {', '.join(system.input_names) or 'none'}."
            raise UnknownNameError(f"The model has no input `{name}`.{known}")
    return {name: float(value) for name, value in (inputs or {}).items()}


def named_values(system: System, values: Mapping[str, Any], x: Any, w: Any) -> tuple[Floats, Floats]:
    """States and algebraic unknowns with the values given by name in the place of `x` and `w`.

    Raises:
        UnknownNameError: the model has no such variable, or it follows from states that are not given.
    """
    representative, sign = system.observed_ids
    given: dict[int, tuple[str, float]] = {}
    for name, value in values.items():
        ids = np.ravel(system.index_of(name))
        for k, number in zip(ids.tolist(), np.ravel(np.broadcast_to(value, ids.shape)).tolist(), strict=True):
            given[int(representative[k])] = name, float(sign[k]) * number
    x, w = np.array(x, float), np.array(w, float)
    states, tears = system.stages.schedule.states.tolist(), system.stages.schedule.tears.tolist()
    inputs = {int(representative[system.index_of(name)]) for name in system.input_names}
    follow = [name for k, (name, _) in given.items() if k not in {*states, *tears, *inputs}]
    if follow and not all(k in given for k in states):
        known = ", ".join(f"`{name}`" for name in system.states[:8])
        raise UnknownNameError(f"`{follow[0]}` follows from the states and cannot be given for them; they are {known}")
    for into, numbers in ((x, states), (w, tears)):
        for i, k in enumerate(numbers):
            into[i] = given[k][1] if k in given else into[i]
    return x, w


def linearize(
    system: System,
    t: float = 0.0,
    x: Any = None,
    *,
    parameters: Mapping[str, Any] | None = None,
    inputs: Mapping[str, float] | None = None,
    outputs: Sequence[str] = (),
) -> StateSpace:
    """State-space matrices of `system` at time `t` and states `x`, by automatic differentiation.

    Inputs are the model's own `Input` fields; `outputs` default to those given to `acausal.compile`. Where the states
    are bound by invariants (index reduction that kept them), A acts on the constrained coordinates together, and
    `poles` are those of the deviations that the invariants allow.

    Args:
        system: a compiled model.
        t: time [s].
        x: states (n_x,), or values by name, as `steady_state` gives them (its inputs count, too); what is not given is
            as at the start.
        parameters: dotted name to value.
        inputs: values of inputs by name; 0 where they are not given.
        outputs: dotted names of variables.

    Raises:
        UnknownNameError: an output or parameter that the model does not have.
    """
    import jax
    import jax.numpy as jnp

    from ..simulation.jit import ensure_x64

    ensure_x64()
    low = system.lowered
    point: Mapping[str, Any] = x if isinstance(x, Mapping) else {}
    fed = {name: point[name] for name in system.input_names if name in point} | checked_inputs(system, inputs)
    x0, w0, p = system.initialize(t, parameters, inputs=fed)
    if point:
        x, w0 = named_values(system, point, x0, w0)
    x = jnp.asarray(x0 if x is None else x, float)
    n_u, first = len(system.input_names), system.stages.flat.n_par
    names = tuple(outputs) or system.outputs
    ids = np.array([int(np.ravel(system.index_of(name))[0]) for name in names], np.int64)
    w_guess = jnp.asarray(w0)

    def all_of(x: Any, u: Any) -> tuple[Any, Any, Any]:
        q = jnp.asarray(p).at[first : first + n_u].set(u) if n_u else jnp.asarray(p)
        w = low.solve_algebraic(t, x, w_guess, q)
        dx, _ = low.derivatives(t, x, w, q)
        bound = low.invariants(t, x, w, q) if low.n_g else jnp.zeros(0)
        return dx, low.observe(t, x, w, q, ids) if len(ids) else jnp.zeros(0), bound

    u0 = jnp.asarray(p)[first : first + n_u]
    (a, b), (c, d), (g, _) = jax.jit(jax.jacfwd(all_of, argnums=(0, 1)))(x, u0)
    a, b, c, d, g = (np.asarray(m) for m in (a, b, c, d, g))
    return StateSpace(a, b, c, d, system.states, system.input_names, names, np.asarray(x), g)
