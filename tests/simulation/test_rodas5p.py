"""Rodas5P: order conditions, orders on ODEs and DAEs, stiff accuracy, dense output, transformations, projection."""

from __future__ import annotations

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal.simulation import DenseLU, Rodas5P
from acausal.simulation import rodas5p_tableau as tableau


def fixed_step(field, y0, t1, n, solver=None, args=None, t0=0.0, saveat=None):
    solved = diffrax.diffeqsolve(
        diffrax.ODETerm(field), solver or Rodas5P(), *jnp.array([t0, t1, (t1 - t0) / n]), y0, args,
        stepsize_controller=diffrax.ConstantStepSize(), saveat=saveat or diffrax.SaveAt(t1=True), max_steps=100,
    )  # fmt: skip
    return solved.ys


def observed_order(error, n=(8, 16)):
    coarse, fine = (error(k) for k in n)
    return np.log(coarse / fine) / np.log(n[1] / n[0])


def test_order_conditions():
    """The 17 conditions of order 5 of Rosenbrock methods (Hairer & Wanner II, Table IV.7.1), and stiff accuracy."""
    gamma = np.linalg.inv(np.eye(8) / tableau.GAMMA - tableau.C)
    alpha, b = tableau.A @ gamma, tableau.B @ gamma
    beta, a1 = alpha + gamma, alpha @ np.ones(8)
    b1 = beta @ np.ones(8)
    assert np.allclose(a1, tableau.NODES, atol=1e-13)
    assert np.allclose(gamma @ np.ones(8), tableau.D, atol=1e-13)
    assert np.allclose(beta[7], b, atol=1e-13)
    conditions = [
        (b @ np.ones(8), 1), (b @ b1, 1 / 2), (b @ a1**2, 1 / 3), (b @ beta @ b1, 1 / 6), (b @ a1**3, 1 / 4),
        (b @ (a1 * (alpha @ b1)), 1 / 8), (b @ beta @ a1**2, 1 / 12), (b @ beta @ beta @ b1, 1 / 24),
        (b @ a1**4, 1 / 5), (b @ (a1**2 * (alpha @ b1)), 1 / 10), (b @ (alpha @ b1) ** 2, 1 / 20),
        (b @ (a1 * (alpha @ a1**2)), 1 / 15), (b @ (a1 * (alpha @ beta @ b1)), 1 / 30), (b @ beta @ a1**3, 1 / 20),
        (b @ beta @ (a1 * (alpha @ b1)), 1 / 40), (b @ beta @ beta @ a1**2, 1 / 60),
        (b @ beta @ beta @ beta @ b1, 1 / 120),
    ]  # fmt: skip
    for left, right in conditions:
        assert left == pytest.approx(right, abs=1e-13)


def test_order_autonomous():
    def field(t, y, args):
        return jnp.stack([y[1] * y[0], -(y[0] ** 2)])

    y0 = jnp.array([1.0, 0.0])
    assert observed_order(lambda n: abs(fixed_step(field, y0, 2.0, n)[-1, 0] - 1 / np.cosh(2.0))) > 4.6


def test_order_non_autonomous_pytree():
    def field(t, y, args):
        return {"a": -y["b"] * jnp.cos(t) ** 2 * y["a"], "b": jnp.zeros(())}

    y0 = {"a": jnp.ones(()), "b": jnp.ones(())}
    exact = np.exp(-(1.0 + np.sin(4.0) / 4))
    assert observed_order(lambda n: abs(fixed_step(field, y0, 2.0, n)["a"][-1] - exact)) > 4.6


def test_order_index_one_dae():
    """x' = -w, 0 = w + x w^3 - sin t - cos t sin^3 t, with the solution x = cos t, w = sin t."""

    def field(t, z, args):
        x, w = z
        return jnp.stack([-w, w + x * w**3 - jnp.sin(t) - jnp.cos(t) * jnp.sin(t) ** 3])

    solver = Rodas5P(mass=jnp.array([1.0, 0.0]))

    def error(n):
        end = fixed_step(field, jnp.array([1.0, 0.0]), 1.0, n, solver)[-1]
        return float(jnp.max(jnp.abs(end - jnp.array([np.cos(1.0), np.sin(1.0)]))))

    assert error(64) < 1e-9
    assert observed_order(error, (16, 32)) > 4.5


def test_stiff_accuracy():
    """Prothero-Robinson y' = -lam (y - sin t) + cos t: no order reduction below 4, and the error falls as lam grows."""

    def field(t, y, lam):
        return -lam * (y - jnp.sin(t)) + jnp.cos(t)

    def error(lam, n=20):
        return float(jnp.abs(fixed_step(field, jnp.zeros(1), 2.0, n, args=jnp.asarray(lam))[-1, 0] - np.sin(2.0)))

    assert error(1e6) < 1e-9
    assert error(1e10) < 1e-12
    assert observed_order(lambda n: error(1e3, n), (20, 40)) > 3.5


def test_dense_output_order():
    ts = jnp.linspace(0.0, 2.0, 101)

    def field(t, y, args):
        return jnp.stack([y[1], -y[0]])

    def error(n):
        ys = fixed_step(field, jnp.array([0.0, 1.0]), 2.0, n, saveat=diffrax.SaveAt(ts=ts))
        return float(jnp.max(jnp.abs(ys[:, 0] - jnp.sin(ts))))

    assert observed_order(error) > 3.7
    assert error(16) < 1e-5


@pytest.mark.slow
def test_backwards_in_time():
    def field(t, y, args):
        return y * jnp.cos(t)

    def jacobian(t, y, args):
        return jnp.cos(t)[None, None]

    exact = np.exp(np.sin(0.0) - np.sin(2.0))
    for solver in (Rodas5P(), Rodas5P(jacobian=jacobian)):
        assert fixed_step(field, jnp.ones(1), 0.0, 40, solver, t0=2.0)[-1, 0] == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize("given", [pytest.param(False, marks=pytest.mark.slow), True])
def test_given_jacobian_and_rate(given):
    def field(t, y, args):
        return jnp.stack([-args * y[0] + jnp.sin(t), y[0] - y[1] ** 2])

    def jacobian(t, y, args):
        return jnp.array([[-args, 0.0], [1.0, 0.0]]).at[1, 1].set(-2 * y[1])

    def rate(t, y, args):
        return jnp.stack([jnp.cos(t), jnp.zeros_like(t)])

    y0 = jnp.array([1.0, 0.5])
    plain = fixed_step(field, y0, 2.0, 20, args=3.0)
    solver = Rodas5P(jacobian=jacobian, time_derivative=rate if given else None)
    assert np.allclose(fixed_step(field, y0, 2.0, 20, solver, args=3.0), plain, rtol=1e-13)


def robertson(t, y, args):
    a, b, c = args
    r1, r2, r3 = a * y[0], b * y[1] * y[2], c * y[1] ** 2
    return jnp.stack([-r1 + r2, r1 - r2 - r3, r3])


def robertson_dae(t, y, args):
    return robertson(t, y, args).at[2].set(jnp.sum(y) - 1)


@pytest.mark.parametrize("dae", [False, True])
def test_robertson(dae):
    """Reference of the IVP test set at t = 1e11."""
    solver = Rodas5P(mass=jnp.array([1.0, 1.0, 0.0])) if dae else Rodas5P()
    controller = diffrax.PIDController(rtol=1e-8, atol=1e-8 * jnp.array([1.0, 1e-6, 1.0]), pcoeff=0.4, icoeff=0.3)
    solved = diffrax.diffeqsolve(
        diffrax.ODETerm(robertson_dae if dae else robertson), solver, 0.0, 1e11, 1e-4, jnp.array([1.0, 0.0, 0.0]),
        (0.04, 1e4, 3e7), stepsize_controller=controller, max_steps=5000,
    )  # fmt: skip
    reference = np.array([0.2083340149701255e-7, 0.8333360770334713e-13, 0.9999999791665050])
    assert np.allclose(solved.ys[-1], reference, rtol=2e-6)
    assert solved.stats["num_steps"] < 1500


def end_value(mu, adjoint):
    def field(t, y, args):
        return jnp.stack([y[1], args * (1 - y[0] ** 2) * y[1] - y[0]])

    solved = diffrax.diffeqsolve(
        diffrax.ODETerm(field), Rodas5P(), 0.0, 5.0, 1e-3, jnp.array([2.0, 0.0]), mu, adjoint=adjoint,
        stepsize_controller=diffrax.PIDController(rtol=1e-9, atol=1e-9, pcoeff=0.4, icoeff=0.3), max_steps=2000,
    )  # fmt: skip
    return solved.ys[-1, 0]


@pytest.mark.slow
def test_derivatives():
    h, mu = 1e-4, 10.0
    reverse_mode = diffrax.RecursiveCheckpointAdjoint()
    run = jax.jit(lambda m: end_value(m, reverse_mode))
    difference = float(run(mu + h) - run(mu - h)) / (2 * h)
    reverse = float(jax.jit(jax.grad(lambda m: end_value(m, reverse_mode)))(mu))
    forward = float(jax.jit(lambda m: jax.jvp(lambda v: end_value(v, diffrax.ForwardMode()), (m,), (1.0,))[1])(mu))
    assert reverse == pytest.approx(difference, rel=1e-5)
    assert forward == pytest.approx(reverse, rel=1e-10)


def test_vmap():
    mus = jnp.array([1.0, 10.0, 30.0])
    run = jax.jit(lambda m: end_value(m, diffrax.RecursiveCheckpointAdjoint()))
    assert np.allclose(jax.jit(jax.vmap(run))(mus), [run(m) for m in mus], rtol=1e-9)


def test_wrong_mass_shape():
    with pytest.raises(ValueError, match=r"shape \(2,\)"):
        fixed_step(lambda t, y, a: -y, jnp.ones(2), 1.0, 4, Rodas5P(mass=jnp.ones(3)))


def test_linear_solver_dense():
    matrix = jax.random.normal(jax.random.key(0), (7, 7))
    b = jnp.arange(7.0)
    solver = DenseLU()
    x = solver.solve(solver.factor(jnp.full(7, 2.0), matrix)[0], b)
    assert np.allclose((2 * np.eye(7) - matrix) @ x, b, atol=1e-12)
