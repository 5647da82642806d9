"""Hand-written lowered systems, of the form that the compiler makes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import jax
import jax.numpy as jnp
import numpy as np
import scipy.sparse as sp

from acausal.errors import UnknownNameError, nearest
from acausal.passes.first_integrals import FirstIntegrals


class HandLowered:
    """Base: no tearing variables, no invariants, dense sparsity, variables = states and tearing variables."""

    x_nominal = np.ones(2)
    w_nominal = np.ones(0)
    n_g = 0
    conserved = FirstIntegrals(0, np.zeros(0, int), np.zeros(0, int), np.zeros(0))
    time_tables = ()

    @property
    def n_x(self) -> int:
        return len(self.x_nominal)

    @property
    def n_w(self) -> int:
        return len(self.w_nominal)

    def derivatives(self, t, x, w, p):
        raise NotImplementedError

    def invariants(self, t, x, w, p):
        return jnp.zeros(0)

    def solve_algebraic(self, t, x, w_guess, p):
        def newton(w):
            r, jac = self.derivatives(t, x, w, p)[1], jax.jacfwd(lambda v: self.derivatives(t, x, v, p)[1])(w)
            return w - jnp.linalg.solve(jac, r)

        solved = jax.lax.fori_loop(0, 8, lambda _, w: newton(w), jax.lax.stop_gradient(w_guess))
        return newton(jax.lax.stop_gradient(solved))  # one more step carries the implicit derivative

    def observe(self, t, x, w, p):
        return jnp.concatenate([x, w])

    def sparsity(self):
        n = self.n_x + self.n_w
        return sp.csr_matrix(np.ones((n, n), dtype=bool))


class VanDerPol(HandLowered):
    x_nominal = np.array([2.0, 2.0])

    def derivatives(self, t, x, w, p):
        return jnp.stack([x[1], p[0] * (1 - x[0] ** 2) * x[1] - x[0]]), jnp.zeros(0)


class Robertson(HandLowered):
    """y1, y2 as states; y3 from the conservation of mass, as an algebraic unknown."""

    x_nominal = np.array([1.0, 1e-5])
    w_nominal = np.array([1.0])

    def derivatives(self, t, x, w, p):
        a, b, c = p
        dx = jnp.stack([-a * x[0] + b * x[1] * w[0], a * x[0] - b * x[1] * w[0] - c * x[1] ** 2])
        return dx, x[0] + x[1] + w - 1


class DiodeCircuit(HandLowered):
    """A source, a resistor, a capacitor with a diode: C v' = i, i = (E sin t - v)/R - I_s (exp(v_d) - 1) as a loop."""

    x_nominal = np.array([1.0])
    w_nominal = np.array([1.0])

    def derivatives(self, t, x, w, p):
        current = w[0] + 0.1 * w[0] ** 3
        return jnp.stack([current / p[0]]), jnp.stack([jnp.sin(t) - x[0] - w[0] - 0.5 * current])

    def observe(self, t, x, w, p):
        return jnp.stack([x[0], w[0], w[0] + 0.1 * w[0] ** 3, -w[0]])


class Pendulum(HandLowered):
    """Cartesian pendulum, states x, y, vx, vy, tension eliminated; the length and its derivative are invariants."""

    x_nominal = np.array([1.0, 1.0, 3.0, 3.0])
    n_g = 2

    def derivatives(self, t, x, w, p):
        length, g = p
        tension = (x[2] ** 2 + x[3] ** 2 - g * x[1]) / length**2
        return jnp.stack([x[2], x[3], -tension * x[0], -tension * x[1] - g]), jnp.zeros(0)

    def invariants(self, t, x, w, p):
        return jnp.stack([x[0] ** 2 + x[1] ** 2 - p[0] ** 2, x[0] * x[2] + x[1] * x[3]])


class Ladder(HandLowered):
    """RC ladder of n cells driven by sin t."""

    def __init__(self, n: int) -> None:
        self.x_nominal = np.ones(n)

    def derivatives(self, t, x, w, p):
        left = jnp.concatenate([jnp.sin(t)[None], x[:-1]])
        right = jnp.concatenate([x[1:], x[-1:]])
        return p[0] * (left - 2 * x + right), jnp.zeros(0)

    def sparsity(self):
        n = self.n_x
        return sp.diags_array([np.ones(n - 1), np.ones(n), np.ones(n - 1)], offsets=[-1, 0, 1]).tocsr().astype(bool)


@dataclass(eq=False)
class HandSystem:
    """What `simulate` and `Solution` need of a system."""

    lowered: Any
    states: tuple[str, ...]
    start: Sequence[float]
    defaults: Mapping[str, float]
    algebraics: tuple[str, ...] = ()
    observed: tuple[str, ...] = ()
    w_start: Sequence[float] = ()
    units: Mapping[str, str] = field(default_factory=dict)
    signs: Mapping[str, tuple[int, int]] = field(default_factory=dict)

    def initialize(self, t0, parameters, initial, inputs=None):
        given = {**(parameters or {}), **(inputs or {})}
        p = jnp.stack([jnp.asarray(given.get(k, v), float) for k, v in self.defaults.items()])
        x0 = jnp.stack(
            [jnp.asarray((initial or {}).get(k, v), float) for k, v in zip(self.states, self.start, strict=True)]
        )
        w0 = jnp.asarray(self.w_start, float)
        return x0, self.lowered.solve_algebraic(t0, x0, w0, p) if len(w0) else w0, p

    def index_of(self, key):
        name = key if isinstance(key, str) else key.name
        names = (*self.states, *self.algebraics, *self.observed)
        if name in self.signs:
            return self.signs[name]
        if name == "all":
            return np.arange(len(names)), 1
        if name not in names:
            raise UnknownNameError(f"no `{name}`.{nearest(name, names)}")
        return names.index(name), 1

    def declaration_of(self, key):
        return SimpleNamespace(unit=self.units.get(key if isinstance(key, str) else key.name, ""), doc="text")


def van_der_pol(mu: float = 100.0) -> HandSystem:
    return HandSystem(VanDerPol(), ("x", "v"), (2.0, 0.0), {"mu": mu})


def robertson() -> HandSystem:
    return HandSystem(Robertson(), ("y1", "y2"), (1.0, 0.0), {"a": 0.04, "b": 1e4, "c": 3e7}, ("y3",), w_start=(0.0,))


def diode() -> HandSystem:
    return HandSystem(
        DiodeCircuit(), ("c.v",), (0.0,), {"c.C": 0.5}, ("r.v",), ("i", "neg"), (0.1,),
        {"c.v": "V", "r.v": "V", "i": "A"}, {"alias": (3, -1)},
    )  # fmt: skip


def pendulum(angle: float) -> HandSystem:
    start = (np.sin(angle), -np.cos(angle), 0.0, 0.0)
    return HandSystem(Pendulum(), ("x", "y", "vx", "vy"), start, {"L": 1.0, "g": 9.81})


def ladder(n: int) -> HandSystem:
    return HandSystem(Ladder(n), tuple(f"c[{i}].v" for i in range(n)), np.zeros(n), {"k": 100.0})
