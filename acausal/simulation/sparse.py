"""Sparse Jacobians by coloured forward mode, and sparse LU by KLU."""

from __future__ import annotations

import importlib
import importlib.util
from typing import Any, Protocol

import equinox as eqx
import jax
import jax.numpy as jnp
import numpy as np
from jax import Array

from .linear_solvers import AbstractLinearSolver, DenseLU, Field

DENSE_BELOW = 64
"""Systems smaller than this are solved densely even when their sparsity is known."""


class CSR(Protocol):
    """What is used of a `scipy.sparse.csr_matrix`."""

    indptr: np.ndarray
    indices: np.ndarray
    shape: tuple[int, int]


class SparsityPattern:
    """A square sparsity pattern with its column colours, compared by identity.

    Args:
        csr: pattern of the Jacobian, shape (n, n), rows = equations; values are ignored.
        colours: colour of each column, shape (n,): two columns of one colour share no row.

    Attributes:
        rows, columns: the entries sorted by row then column, with the diagonal added, shape (nnz,).
        in_jacobian: false where the diagonal was added, shape (nnz,).
        diagonal: positions of the diagonal entries, shape (n,).
    """

    def __init__(self, csr: CSR, colours: np.ndarray) -> None:
        n, m = csr.shape
        if n != m:
            raise ValueError(f"A Jacobian is square; got a pattern of shape {csr.shape}.")
        colours = np.asarray(colours, dtype=np.int32)
        if colours.shape != (n,):
            raise ValueError(f"One colour for each of the {n} columns; got shape {colours.shape}.")
        rows = np.repeat(np.arange(n), np.diff(csr.indptr))
        present = np.unique(rows.astype(np.int64) * n + csr.indices)
        keys = np.union1d(present, np.arange(n, dtype=np.int64) * (n + 1))
        self.n = n
        self.rows = (keys // n).astype(np.int32)
        self.columns = (keys % n).astype(np.int32)
        self.in_jacobian = np.isin(keys, present)
        self.diagonal = np.searchsorted(keys, np.arange(n, dtype=np.int64) * (n + 1))
        self.colours = colours
        self.count = int(colours.max(initial=-1)) + 1
        entry_colours = colours[csr.indices].astype(np.int64) + rows.astype(np.int64) * self.count
        if np.unique(entry_colours).size != rows.size:
            raise ValueError("The colouring is wrong: two columns of one colour share a row.")
        self._symbolic: Any = None

    def seeds(self, dtype: Any) -> Array:
        """One direction for each colour, shape (count, n)."""
        return jnp.asarray(np.arange(self.count)[:, None] == self.colours[None, :], dtype)

    def symbolic(self) -> Any:
        """KLU's symbolic analysis of the pattern, done once and kept."""
        if self._symbolic is None:
            with jax.ensure_compile_time_eval():
                self._symbolic = _klu().analyze(self.rows, self.columns, self.n)
        return self._symbolic


class ColouredJacobian(eqx.Module):
    """Values of a sparse Jacobian from one forward directional derivative for each colour.

    Source: Curtis, Powell, Reid (1974), "On the estimation of sparse Jacobian matrices", IMA J. Appl. Math. 13.
    """

    pattern: SparsityPattern = eqx.field(static=True)

    def __call__(self, field: Field, t: Array, y: Array) -> tuple[Array, Array, Array]:
        """`field(t, y)` (n,), its rate in t (n,), and the values at the entries of the pattern (nnz,)."""
        pattern = self.pattern
        space = jnp.concatenate([jnp.zeros((1, pattern.n), y.dtype), pattern.seeds(y.dtype)])
        time = jnp.zeros(pattern.count + 1, t.dtype).at[0].set(1)

        def push(dt: Array, dy: Array) -> tuple[Array, Array]:
            return jax.jvp(field, (t, y), (dt, dy))

        value, compressed = jax.vmap(push, out_axes=(None, 0))(time, space)
        values = compressed[1 + pattern.colours[pattern.columns], pattern.rows]
        return value, compressed[0], jnp.where(pattern.in_jacobian, values, 0)


class SparseDense(AbstractLinearSolver):
    """Coloured Jacobian with dense LU: for middling systems, and where KLU is not installed."""

    pattern: SparsityPattern = eqx.field(static=True)

    def jacobian(self, field: Field, t: Array, y: Array) -> tuple[Array, Array, Array]:
        value, rate, values = ColouredJacobian(self.pattern)(field, t, y)
        n = self.pattern.n
        return value, rate, jnp.zeros((n, n), y.dtype).at[self.pattern.rows, self.pattern.columns].set(values)

    def init(self) -> Array:
        return DenseLU().init()

    def factor(self, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Any, Any]:
        return DenseLU().factor(diagonal, jacobian, kept)

    def outrun(self, factors: Any, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Array, Any]:
        return DenseLU().outrun(factors, diagonal, jacobian, kept)

    def solve(self, factors: Any, b: Array) -> Array:
        return DenseLU().solve(factors, b)


class SparseKLU(AbstractLinearSolver):
    """Coloured Jacobian with KLU: the symbolic analysis is done once, when the pattern is first used.

    A Jacobian that is exactly singular stops the run with KLU's own error; a non-finite one gives NaN, which a
    step-size controller takes as a rejected step.

    Args:
        pattern: sparsity and colours.
        keep_factors: `False` factorises at each of the eight solves of a step, which keeps the solve a pure function
            that may run under `vmap` and be differentiated. `True` factorises once a step, with the pivots of the
            first step, and refines each solution once; the factors are in memory outside JAX, and the solver state
            holds their address. `simulate` does this in plain runs, and frees them with `free_factors`.

    Source: Davis, Palamadai Natarajan (2010), "Algorithm 907: KLU", ACM Trans. Math. Softw. 37(3).
    """

    pattern: SparsityPattern = eqx.field(static=True)
    keep_factors: bool = eqx.field(static=True, default=False)

    def init(self) -> Array | None:
        return jnp.zeros(1, jnp.uint64) if self.keep_factors else None

    def jacobian(self, field: Field, t: Array, y: Array) -> tuple[Array, Array, Array]:
        return ColouredJacobian(self.pattern)(field, t, y)

    def factor(self, diagonal: Array, jacobian: Array, kept: Any = None) -> tuple[Any, Any]:
        values = (-jacobian).at[self.pattern.diagonal].add(diagonal)
        if not self.keep_factors:
            return values, kept
        factors = _KeptFactors(self.pattern, values, kept)
        return factors, factors.handle

    def solve(self, factors: Any, b: Array) -> Array:
        if isinstance(factors, _KeptFactors):
            return factors.solve(b)
        return solve_klu(self.pattern, factors, b)


class _KeptFactors:
    """KLU factors at an address that goes from step to step: made in the first step, overwritten in later ones.

    The order of the operations is safe because the factors of a step need the state that the solves of the step
    before it made.
    """

    def __init__(self, pattern: SparsityPattern, values: Array, handle: Array) -> None:
        klu = _klu()
        self.pattern = pattern
        self.rows, self.columns = jnp.asarray(pattern.rows), jnp.asarray(pattern.columns)
        self.symbolic = jnp.asarray(pattern.symbolic().raw, jnp.uint64)
        self.finite = jnp.all(jnp.isfinite(values))
        identity = jnp.zeros_like(values).at[pattern.diagonal].set(1)
        self.values = jnp.where(self.finite, values, identity)[None]

        def first() -> Array:
            return klu.factor_f64.bind(self.rows, self.columns, self.values, self.symbolic)

        def again() -> Array:
            return klu.refactor_f64.bind(self.rows, self.columns, self.values, self.symbolic, handle)

        self.handle = jax.lax.cond(handle[0] == 0, first, again)

    def solve(self, b: Array) -> Array:
        klu = _klu()
        right = b[None, :, None]
        x = klu.solve_with_numeric_f64.bind(self.symbolic, self.handle, right)
        rest = right - klu.dot_f64.bind(self.rows, self.columns, self.values, x)
        x = x + klu.solve_with_numeric_f64.bind(self.symbolic, self.handle, rest)
        return jnp.where(self.finite, x[0, :, 0], jnp.nan)


def free_factors(handle: Any) -> None:
    """Frees kept factors, given the solver state of a finished solve."""
    address = int(np.asarray(handle).ravel()[0])
    if address:
        _klu().KLUNumeric([address]).close()


def solve_klu(pattern: SparsityPattern, values: Array, b: Array) -> Array:
    """Solves `A x = b` with the values (nnz,) of A at the entries of `pattern`; differentiable in both."""
    rows, columns = jnp.asarray(pattern.rows), jnp.asarray(pattern.columns)
    finite = jnp.all(jnp.isfinite(values)) & jnp.all(jnp.isfinite(b))
    identity = jnp.zeros_like(values).at[pattern.diagonal].set(1)
    safe = jnp.where(finite, values, identity)

    def multiply(x: Array) -> Array:
        return jnp.zeros_like(x).at[rows].add(safe * x[columns])

    def bind(primitive: Any, right: Array) -> Array:
        handle = jnp.asarray(pattern.symbolic().raw, jnp.uint64)
        solved = primitive.bind(
            rows, columns, jax.lax.stop_gradient(safe)[None].astype(jnp.float64),
            right[None, :, None].astype(jnp.float64), handle,
        )  # fmt: skip
        return solved[0, :, 0].astype(right.dtype)

    def solve(_: Any, right: Array) -> Array:
        return bind(_klu().solve_with_symbol_f64, right)

    def transpose_solve(_: Any, right: Array) -> Array:
        return bind(_klu().tsolve_with_symbol_f64, right)

    solved = jax.lax.custom_linear_solve(multiply, jnp.where(finite, b, 0), solve, transpose_solve)
    return jnp.where(finite, solved, jnp.nan)


def sparse_linear_solver(csr: CSR, colours: np.ndarray) -> AbstractLinearSolver:
    """The policy for a pattern: dense if small, KLU if it is installed, else coloured Jacobian with dense LU."""
    if csr.shape[0] < DENSE_BELOW:
        return DenseLU()
    pattern = SparsityPattern(csr, colours)
    return SparseKLU(pattern) if have_klu() else SparseDense(pattern)


def have_klu() -> bool:
    """Whether KLU can be used: installed, and on a CPU."""
    return importlib.util.find_spec("klujax") is not None and jax.default_backend() == "cpu"


def _klu() -> Any:
    """klujax, which on import sets JAX's platform and precision for the whole process: that is undone."""
    platform = jax.config.read("jax_platform_name")
    x64 = jax.config.read("jax_enable_x64")
    klujax = importlib.import_module("klujax")
    if jax.config.read("jax_platform_name") != platform:
        jax.config.update("jax_platform_name", platform)
    if jax.config.read("jax_enable_x64") != x64:
        jax.config.update("jax_enable_x64", x64)
    return klujax
