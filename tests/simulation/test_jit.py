"""`ac.jit`, the choice of XLA options, and double precision."""

from __future__ import annotations

import logging
import os
import subprocess
import sys

import jax
import jax.numpy as jnp

from acausal.simulation.jit import choose_fusion, compiler_options, count_equations, jit


def test_jit_is_jit():
    calls = []

    @jit
    def f(x, y=1.0):
        calls.append(1)
        return jnp.sin(x) * y

    assert f(1.0) == jnp.sin(1.0)
    assert f(1.0, y=2.0) == 2 * jnp.sin(1.0)
    f(2.0)
    assert len(calls) == 2
    assert jax.grad(f)(0.0) == 1.0
    assert jax.jit(f)(1.0) == jnp.sin(1.0)
    assert f.__name__ == "f"


def test_static_arguments():
    f = jit(lambda x, n: x**n, static_argnums=1)
    assert f(2.0, 3) == 8.0
    g = jit(lambda x, n: x**n, fusion=False, static_argnames="n")
    assert g(2.0, n=3) == 8.0


def test_choice_by_size(monkeypatch):
    def big(x):
        for _ in range(60):
            x = x * 1.0001
        return x

    assert count_equations(jax.make_jaxpr(big)(1.0)) == 60
    monkeypatch.setattr("acausal.simulation.jit.FUSE_BELOW", 50)
    assert not choose_fusion(jax.make_jaxpr(big)(1.0))
    assert choose_fusion(jax.make_jaxpr(jnp.sin)(1.0))
    monkeypatch.setenv("ACAUSAL_XLA_FUSION", "1")
    assert choose_fusion(jax.make_jaxpr(big)(1.0))


def test_options_are_probed():
    for fusion in (True, False):
        options = compiler_options(fusion)
        assert options is None or isinstance(options, dict)


def test_x64_is_turned_on_with_one_line():
    code = (
        "import logging, jax; logging.basicConfig(format='%(message)s')\n"
        "from acausal.simulation.jit import ensure_x64\n"
        "ensure_x64(); ensure_x64(); print(jax.numpy.zeros(1).dtype)"
    )
    env = {k: v for k, v in os.environ.items() if k != "JAX_ENABLE_X64"}
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, env=env)
    assert done.stdout.strip() == "float64"
    assert done.stderr.count("double precision") == 1
    assert logging.getLogger("acausal")
