"""Classical Runge-Kutta: order of the steps and of the dense output."""

from __future__ import annotations

import diffrax
import jax.numpy as jnp
import numpy as np

from acausal.simulation import RK4


def run(n, saveat):
    return diffrax.diffeqsolve(
        diffrax.ODETerm(lambda t, y, a: y * jnp.cos(t)), RK4(), *jnp.array([0.0, 2.0, 2.0 / n]), jnp.ones(1),
        saveat=saveat, stepsize_controller=diffrax.ConstantStepSize(), max_steps=100,
    )  # fmt: skip


def test_order():
    exact = np.exp(np.sin(2.0))
    errors = [abs(float(run(n, diffrax.SaveAt(t1=True)).ys[-1, 0]) - exact) for n in (20, 40)]
    assert 3.8 < np.log2(errors[0] / errors[1]) < 4.5


def test_dense_output():
    ts = jnp.linspace(0.0, 2.0, 53)
    errors = [float(jnp.max(jnp.abs(run(n, diffrax.SaveAt(ts=ts)).ys[:, 0] - jnp.exp(jnp.sin(ts))))) for n in (20, 40)]
    assert np.log2(errors[0] / errors[1]) > 3.5
