"""Coloured Jacobians and KLU against dense linear algebra."""

from __future__ import annotations

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest
import scipy.sparse as sp

from acausal.simulation import DenseLU, Rodas5P, SparseKLU, SparsityPattern
from acausal.simulation.sparse import ColouredJacobian, SparseDense, have_klu, solve_klu, sparse_linear_solver

needs_klu = pytest.mark.skipif(not have_klu(), reason="klujax is not installed")


def banded(n):
    pattern = sp.diags_array([np.ones(n - 1), np.ones(n), np.ones(n - 1)], offsets=[-1, 0, 1]).tocsr()
    return SparsityPattern(pattern, np.arange(n) % 3)


def field(t, y, args=1.0):
    left = jnp.concatenate([jnp.sin(t)[None], y[:-1]])
    right = jnp.concatenate([y[1:], y[-1:]])
    return args * (left - 2 * y + right) - y**3


def test_coloured_jacobian():
    n, t = 12, jnp.asarray(0.3)
    y, pattern = jnp.linspace(0, 1, n), banded(n)
    value, rate, values = ColouredJacobian(pattern)(field, t, y)
    dense = jnp.zeros((n, n)).at[pattern.rows, pattern.columns].set(values)
    assert np.allclose(dense, jax.jacfwd(field, 1)(t, y))
    assert np.allclose(value, field(t, y))
    assert np.allclose(rate, jax.jacfwd(field, 0)(t, y))


def test_diagonal_is_added():
    pattern = SparsityPattern(sp.csr_matrix(np.array([[0, 1], [1, 0]])), np.array([0, 1]))
    assert pattern.rows.tolist() == [0, 0, 1, 1]
    assert pattern.in_jacobian.tolist() == [False, True, True, False]
    _, _, values = ColouredJacobian(pattern)(lambda t, y: jnp.stack([3 * y[1], 5 * y[0]]), jnp.zeros(()), jnp.ones(2))
    assert values.tolist() == [0, 3, 5, 0]


def test_wrong_colouring():
    with pytest.raises(ValueError, match="share a row"):
        SparsityPattern(sp.csr_matrix(np.ones((2, 2))), np.zeros(2))


@needs_klu
@pytest.mark.slow
def test_klu_solves_and_differentiates():
    n, pattern = 9, banded(9)
    values = jax.random.normal(jax.random.key(1), (len(pattern.rows),)).at[pattern.diagonal].add(5.0)
    b = jnp.arange(n, dtype=float)

    def dense(values, b):
        return jnp.linalg.solve(jnp.zeros((n, n)).at[pattern.rows, pattern.columns].set(values), b)

    def klu(values, b):
        return solve_klu(pattern, values, b)

    assert np.allclose(jax.jit(klu)(values, b), dense(values, b), atol=1e-13)
    gradient = [jax.jit(jax.grad(lambda v, b, s=s: jnp.sum(s(v, b) ** 2), (0, 1)))(values, b) for s in (klu, dense)]
    assert np.allclose(gradient[0][0], gradient[1][0], atol=1e-12)
    assert np.allclose(gradient[0][1], gradient[1][1], atol=1e-12)
    batch = jnp.stack([values, 2 * values])
    assert np.allclose(jax.vmap(klu, (0, None))(batch, b), jax.vmap(dense, (0, None))(batch, b), atol=1e-13)
    assert np.allclose(jax.jit(jax.vmap(klu, (0, 0)))(batch, jnp.stack([b, -b]))[1], -dense(2 * values, b), atol=1e-13)
    assert np.isnan(klu(values.at[0].set(jnp.nan), b)).all()


def solve(y0, rate, linear_solver, rtol=1e-7):
    solved = diffrax.diffeqsolve(
        diffrax.ODETerm(field), Rodas5P(linear_solver=linear_solver), 0.0, 1.0, 1e-3, y0, rate, max_steps=400,
        stepsize_controller=diffrax.PIDController(rtol=rtol, atol=rtol),
    )  # fmt: skip
    return solved.ys[-1]


@pytest.mark.slow
@needs_klu
def test_ladder_against_dense():
    n = 100
    runs = [solve(jnp.zeros(n), 50.0, s) for s in (SparseKLU(banded(n)), SparseDense(banded(n)), DenseLU())]
    assert np.allclose(runs[0], runs[2], atol=1e-12)
    assert np.allclose(runs[1], runs[2], atol=1e-12)


@needs_klu
@pytest.mark.slow
def test_large_ladder_vmap_and_grad():
    n = 500
    solver = SparseKLU(banded(n))
    run = jax.jit(lambda k: solve(jnp.zeros(n), k, solver, 1e-5))
    both = jax.jit(jax.vmap(run))(jnp.array([10.0, 50.0]))
    assert np.allclose(both[1], run(50.0), atol=1e-9)
    gradient = float(jax.jit(jax.grad(lambda k: run(k)[0]))(50.0))
    assert gradient == pytest.approx(float(run(50.01)[0] - run(49.99)[0]) / 0.02, rel=1e-3)


def test_small_is_dense():
    small = sp.eye_array(10).tocsr()
    assert isinstance(sparse_linear_solver(small, np.zeros(10)), DenseLU)
