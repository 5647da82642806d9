"""The consistent start of a run, compiled once."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import jax
import jax.numpy as jnp

from .cache import cache_of, without_keeping
from .jit import compiled_for, inside_jit, is_traced


def start(
    system: Any,
    t0: Any,
    parameters: Mapping[str, Any] | None,
    initial: Mapping[str, Any] | None,
    inputs: Mapping[str, Any],
    *,
    check: bool,
) -> tuple[Any, Any, Any, float]:
    """States, tearing variables and parameters at `t0`, and the seconds of compiling; `inputs` are values at `t0`.

    The system's `initialize` runs as one compiled program; other values of the same names reuse it. If the system
    offers `initialize_with_residual` and `check_initial`, the start is checked (not inside JAX transformations).
    """
    given = {name: jnp.asarray(value, float) for name, value in (parameters or {}).items()}
    starts = {name: jnp.asarray(value, float) for name, value in (initial or {}).items()}
    fed = {name: jnp.asarray(value, float) for name, value in inputs.items()}
    further = (fed,) if fed else ()  # the protocol asks systems without inputs for three arguments only
    at_once = getattr(system, "initialize_numeric", None)
    found = at_once(t0, parameters, initial, *further) if at_once is not None else None
    if found is not None:
        if check:
            system.check_initial(*found, t0, initial)
        x0, w0, p, _ = (jnp.asarray(a, float) for a in found)
        return x0, w0, p, 0.0
    arguments = (jnp.asarray(t0, float), given, starts, *further)
    with_residual = getattr(system, "initialize_with_residual", None)
    cache = cache_of(system.lowered)
    if "start" not in cache:
        way = "initialize" if with_residual is None else "initialize_with_residual"
        cache["start"] = jax.jit(without_keeping(system, lambda system, *given: getattr(system, way)(*given)))
    run = cache["start"]
    if inside_jit() or is_traced(arguments):
        x0, w0, p, *_ = run(*arguments)
        return x0, w0, p, 0.0
    compiled, seconds = compiled_for(system.lowered, "start", run, arguments)
    x0, w0, p, *left = compiled(*arguments)
    if left and check:
        system.check_initial(x0, w0, p, left[0], t0, initial)
    return x0, w0, p, seconds
