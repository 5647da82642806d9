"""Double precision: models mix magnitudes (1e9 Pa beside 1e-9 m2) that JAX's default single precision cannot hold."""

from __future__ import annotations

import logging
import os
import sys

MESSAGE = 'acausal turned on JAX\'s double precision for this process (`jax.config.update("jax_enable_x64", True)`).'


def enable_double_precision() -> None:
    """Turn on JAX's double precision, saying so once; without importing JAX if nothing did yet.

    A user who set the environment variable ``JAX_ENABLE_X64`` has decided, and nothing is changed.
    """
    if "JAX_ENABLE_X64" in os.environ:
        return
    if "jax" not in sys.modules:
        os.environ["JAX_ENABLE_X64"] = "1"
        logging.getLogger("acausal").info(MESSAGE)
    else:
        import jax

        if jax.config.read("jax_enable_x64"):
            return
        jax.config.update("jax_enable_x64", True)
        logging.getLogger("acausal").warning(MESSAGE)
