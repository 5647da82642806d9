"""Rodas5P, a stiffly accurate Rosenbrock-Wanner method of order 5 for ODEs and index-1 DAEs, as a diffrax solver."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, ClassVar

import jax
import jax.numpy as jnp
import numpy as np
from diffrax import RESULTS, AbstractAdaptiveSolver, AbstractLocalInterpolation, AbstractTerm
from jax import Array
from jax.flatten_util import ravel_pytree
from jaxtyping import PyTree

from . import rodas5p_tableau as tableau
from .linear_solvers import AbstractLinearSolver, DenseLU

NOT_REFUSED = 1e-13
"""Steps shorter than this, relative to the time, are as short as they can be."""
_COUPLING = np.stack([tableau.A, tableau.C], axis=1)  # (stage, A or C, earlier stage)


class Rodas5PInterpolation(AbstractLocalInterpolation):
    """Dense output of order 4: Steinebach (2023), section 2, with the coefficients of `rodas5p_tableau.H`."""

    t0: Any
    t1: Any
    y0: PyTree[Array]
    y1: PyTree[Array]
    v: PyTree[Array]
    """Three coefficient vectors, each leaf of shape (3, *leaf of y)."""

    def evaluate(self, t0: Any, t1: Any | None = None, left: bool = True) -> PyTree[Array]:
        """Value at `t0`, or the increment from `t0` to `t1`."""
        del left
        if t1 is not None:
            return jax.tree.map(lambda b, a: b - a, self.evaluate(t1), self.evaluate(t0))
        length = self.t1 - self.t0
        s = (t0 - self.t0) / jnp.where(length == 0, 1.0, length)

        def leaf(y0: Array, y1: Array, v: Array) -> Array:
            return ((1 - s) * y0 + s * (y1 + (1 - s) * (v[0] + s * (v[1] + s * v[2])))).astype(y0.dtype)

        return jax.tree.map(leaf, self.y0, self.y1, self.v)


def _flat(y: PyTree[Array]) -> tuple[Array, Callable[[Array], PyTree[Array]]]:
    """`y` as one vector, and the way back; a vector is left as it is."""
    if isinstance(y, Array) and y.ndim == 1:
        return y, lambda z: z
    return ravel_pytree(y)


class Rodas5P(AbstractAdaptiveSolver[Any]):
    r"""Eight-stage Rosenbrock-Wanner method of order 5(4) for \(M y' = f(t, y)\): stiffly accurate, A-stable, L-stable.

    Linearly implicit: a step takes one Jacobian, one LU factorisation, eight back-substitutions and eight
    evaluations of f, and no Newton iteration. It keeps order 5 on index-1 DAEs and does not lose it on
    Prothero-Robinson problems. Rows with `mass` 0 are algebraic equations `0 = f_i(t, y)`.

    It is an ordinary diffrax solver: `diffrax.diffeqsolve(ODETerm(f), Rodas5P(), ...)` takes `y0` of any pytree
    of real arrays, and `jit`, `vmap`, forward and reverse differentiation go through it.

    Args:
        mass: the diagonal of M, shape (n,), in the order of `ravel_pytree(y)`; `None` is the identity.
        jacobian: `(t, y, args) -> J`, the Jacobian in the representation of `linear_solver` (dense: (n, n) in
            the order of `ravel_pytree`); `None` has the linear solver differentiate the vector field.
        time_derivative: `(t, y, args) -> df/dt`, like y; used with `jacobian` only. `None` differentiates.
        project: `(t, y, args) -> y`, run on the candidate of each step: projects it on known invariants.
        linear_solver: how W = M/(h gamma) - J is formed and solved: `DenseLU()` or `SparseKLU(...)`; `None` is
            dense, and in `simulate` whatever suits the size of the system.

    Source: Steinebach (2023), BIT Numerical Mathematics 63:27, https://doi.org/10.1007/s10543-023-00967-x.
    """

    mass: Array | None = None
    jacobian: Callable[[Any, PyTree[Array], Any], Array] | None = None
    time_derivative: Callable[[Any, PyTree[Array], Any], PyTree[Array]] | None = None
    project: Callable[[Any, PyTree[Array], Any], PyTree[Array]] | None = None
    linear_solver: AbstractLinearSolver | None = None

    term_structure: ClassVar[Any] = AbstractTerm
    interpolation_cls: ClassVar[Callable[..., Rodas5PInterpolation]] = Rodas5PInterpolation

    def order(self, terms: PyTree[AbstractTerm]) -> int:
        del terms
        return 5

    def init(self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any) -> Any:
        del terms, t0, t1, args
        if any(jnp.iscomplexobj(leaf) for leaf in jax.tree.leaves(y0)):
            raise ValueError("Rodas5P takes real states. Write a complex state as its real and imaginary parts.")
        n = sum(jnp.size(leaf) for leaf in jax.tree.leaves(y0))
        if self.mass is not None and jnp.shape(self.mass) != (n,):
            raise ValueError(f"`mass` is the diagonal, of shape ({n},) for this y0; got shape {jnp.shape(self.mass)}.")
        return (DenseLU() if self.linear_solver is None else self.linear_solver).init()

    def func(self, terms: Any, t0: Any, y0: Any, args: Any) -> Any:
        return terms.vf(t0, y0, args)

    def step(
        self, terms: Any, t0: Any, t1: Any, y0: Any, args: Any, solver_state: Any, made_jump: Any
    ) -> tuple[Any, Any, dict[str, Any], Any, RESULTS]:
        """One step from `t0` to `t1`; see `diffrax.AbstractSolver.step`.

        Everything is written for `h f`, so that the term's control carries the direction of time.
        """
        del made_jump
        y, unflatten = _flat(y0)
        t0, h = jnp.asarray(t0, y.dtype), jnp.asarray(t1 - t0, y.dtype)
        control = terms.contr(t0, t1)

        @jax.jit
        def field(t: Array, state: Array) -> Array:
            value = terms.vf_prod(t, unflatten(state), args, control)
            return _flat(value)[0].astype(y.dtype)

        linear_solver = DenseLU() if self.linear_solver is None else self.linear_solver
        if self.jacobian is None:
            first, rate, jacobian = linear_solver.jacobian(field, t0, y)
        else:
            first, rate, jacobian = self._given_jacobian(field, t0, y, unflatten, terms, args, control)
        rate = h * rate
        mass = jnp.ones_like(y) if self.mass is None else jnp.asarray(self.mass, y.dtype)
        factors, kept = linear_solver.factor(mass / tableau.GAMMA, jacobian, solver_state)
        outrun, kept = linear_solver.outrun(factors, mass / tableau.GAMMA, jacobian, kept)
        outrun &= jnp.abs(h) > NOT_REFUSED * jnp.abs(t0)

        def stage(u: Array, row: tuple[Array, Array, Array, Array]) -> tuple[Array, None]:
            i, coupling, node, weight = row
            increments = coupling @ u
            value = field(t0 + node * h, y + increments[0]) + mass * increments[1] + weight * rate
            return u.at[i].set(linear_solver.solve(factors, value)), None

        u = jnp.zeros((8, y.shape[0]), y.dtype).at[0].set(linear_solver.solve(factors, first + tableau.D[0] * rate))
        coupling, nodes, weights = (jnp.asarray(a[1:], y.dtype) for a in (_COUPLING, tableau.NODES, tableau.D))
        # A loop, not seven copies of the vector field: it compiles in half the time and runs as fast.
        u, _ = jax.lax.scan(stage, u, (jnp.arange(1, 8), coupling, nodes, weights))

        increments = jnp.asarray(np.concatenate([tableau.B[None], tableau.H]), y.dtype) @ u
        y1 = unflatten(y + increments[0])
        if self.project is not None:
            y1 = self.project(_real_time(terms, t1), y1, args)
        dense_info = {"y0": y0, "y1": y1, "v": jax.vmap(unflatten)(increments[1:])}
        error = jnp.where(outrun, jnp.inf, u[7])  # so the step is refused
        return y1, unflatten(error), dense_info, kept, RESULTS.successful

    def _given_jacobian(
        self, field: Any, t0: Array, y: Array, unflatten: Any, terms: Any, args: Any, control: Any
    ) -> tuple[Array, Array, Array]:
        """Value, rate and Jacobian of `h f` from the user's callables, which are written for f and real time."""
        assert self.jacobian is not None
        time, state = _real_time(terms, t0), unflatten(y)
        jacobian = jnp.asarray(self.jacobian(time, state, args)) * control
        if self.time_derivative is None:
            first, rate = jax.jvp(lambda t: field(t, y), (t0,), (jnp.ones_like(t0),))
        else:
            first = field(t0, y)
            rate = _flat(self.time_derivative(time, state, args))[0] * control * _direction(terms)
        return first, rate, jacobian


def _real_time(terms: Any, t: Any) -> Any:
    """The user's time: diffrax integrates backwards by running its own time forwards."""
    return t * _direction(terms)


def _direction(terms: Any) -> Any:
    """+1 or -1: of the wrapper that `diffeqsolve` puts around every term."""
    return getattr(terms, "direction", 1)
