"""Double precision for all tests of the passes."""

import jax

jax.config.update("jax_enable_x64", True)
