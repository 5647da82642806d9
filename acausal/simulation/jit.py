"""`jax.jit` with the XLA:CPU options that suit scalar equation code."""

from __future__ import annotations

import functools
import os
import time
from collections.abc import Callable
from typing import Any

import jax
import jax.numpy as jnp
from jax.core import Tracer
from jax.extend.core import jaxprs_in_params

from acausal.precision import enable_double_precision

from .cache import cache_of

FUSE_BELOW = 20_000
"""Equations of a traced program up to which loop fusion pays; beyond, compiling it grows faster than its size.

Measured on the extended crane: with fusion (in the older emitters) its solve, 2,800 equations, compiles in a third of
the time that it takes without and runs four times faster; its gradient, 13,000 equations, in 0.6 of the time and six
times faster. A random graph, where everything shares with everything, has the break-even of compile time at 2,500."""

# the lower optimization level of LLVM: a quarter less compile time at the same speed (ladder and crane)
_FUSED = (
    {"xla_cpu_use_fusion_emitters": False, "xla_backend_optimization_level": 1},
    {"xla_cpu_use_fusion_emitters": False},
    {},
)
_UNFUSED = ({"xla_disable_hlo_passes": "fusion"}, {"xla_cpu_use_fusion_emitters": False}, {})


@functools.cache
def compiler_options(fusion: bool) -> dict[str, Any] | None:
    """XLA options with or without loop fusion, each set probed once; `None` if this XLA knows none of them.

    Without fusion, a large program of shared scalar expressions compiles in time proportional to its size; with
    fusion (in the older, quicker emitters) a small one compiles as fast and runs about four times faster.
    """
    if jax.default_backend() != "cpu":
        return None
    for options in _FUSED if fusion else _UNFUSED:
        try:
            jax.jit(jnp.negative, compiler_options=options).lower(1.0).compile()
        except Exception:  # an unknown option has no exception type of its own
            continue
        return options or None
    return None


def count_equations(jaxpr: Any) -> int:
    """Equations of a jaxpr, those of inner jaxprs (loops, conditionals, calls) included."""
    total = 0
    stack = [getattr(jaxpr, "jaxpr", jaxpr)]
    seen: set[int] = set()
    while stack:
        inner = stack.pop()
        if id(inner) in seen:
            continue
        seen.add(id(inner))
        total += len(inner.eqns)
        for equation in inner.eqns:
            stack.extend(jaxprs_in_params(equation.params))
    return total


def jit(fun: Callable[..., Any], *, fusion: bool | None = None, **options: Any) -> Callable[..., Any]:
    """`jax.jit` with the XLA:CPU compiler options that suit models; use it as the outermost `jit` around `simulate`.

    The options count on the outermost `jit` only; inside other transformations this is plain `jax.jit`.

    Args:
        fun: function to compile.
        fusion: XLA's loop fusion on or off. `None` decides at the first call by the size of the program
            (on up to `FUSE_BELOW` equations).
        options: passed to `jax.jit`.

    Returns:
        The compiled function, of the same signature as `fun`.
    """
    inner = jax.jit(fun, **options)
    static = {k: v for k, v in options.items() if k.startswith("static_")}
    chosen: dict[bool, Callable[..., Any]] = {}

    def outer(use_fusion: bool) -> Callable[..., Any]:
        if use_fusion not in chosen:
            with_options = compiler_options(use_fusion)
            plain = {k: v for k, v in options.items() if k not in static}
            chosen[use_fusion] = jax.jit(inner, compiler_options=with_options, **static, **plain)
        return chosen[use_fusion]

    decided: list[bool] = [] if fusion is None else [fusion]

    @functools.wraps(fun)
    def call(*args: Any, **kwargs: Any) -> Any:
        if inside_jit() or is_traced((args, kwargs)):
            return inner(*args, **kwargs)
        if not decided:
            decided.append(choose_fusion(inner.trace(*args, **kwargs).jaxpr))
        return outer(decided[0])(*args, **kwargs)

    call.lower = lambda *args, **kwargs: outer(decided[0] if decided else True).lower(*args, **kwargs)  # type: ignore[attr-defined]
    return call


def inside_jit() -> bool:
    """Whether operations are being recorded for a compiled program rather than carried out."""
    return isinstance(jax.lax.stop_gradient(0.0), Tracer)  # an operation that compiles nothing


def is_traced(tree: Any) -> bool:
    """Whether a pytree has a traced leaf."""
    return any(isinstance(leaf, Tracer) for leaf in jax.tree.leaves(tree))


def values_are_known(tree: Any) -> bool:
    """Whether the numbers in a pytree are known now: they may be differentiated, but not compiled or batched."""
    known: list[bool] = []

    @jax.custom_jvp
    def look(value: Any) -> Any:
        known.append(not isinstance(value, Tracer))
        return value

    @look.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        known.append(not isinstance(primals[0], Tracer))
        return primals[0], tangents[0]

    for leaf in jax.tree.leaves(tree):
        if isinstance(leaf, Tracer):
            look(leaf)
    return all(known) and not inside_jit()


def told_when_differentiated(tree: Any, tell: Callable[[], None]) -> Any:
    """The pytree; `tell` is called when derivatives with respect to its numbers are taken."""

    @jax.custom_jvp
    def same(value: Any) -> Any:
        return value

    @same.defjvp
    def _(primals: Any, tangents: Any) -> Any:
        tell()
        return primals[0], tangents[0]

    return jax.tree.map(lambda leaf: same(leaf) if isinstance(leaf, Tracer) else leaf, tree)


def compiled_for(owner: Any, key: Any, run: Any, arguments: tuple[Any, ...]) -> tuple[Any, float]:
    """The executable of a jitted function for the shapes of the arguments, kept with `owner`.

    Args:
        owner: what the executable is kept with.
        key: name of the function there.
        run: what `jax.jit` returned.
        arguments: its arguments.

    Returns:
        The executable, and the seconds of tracing and compiling (0 if it was there).
    """
    cache = cache_of(owner)
    leaves, structure = jax.tree.flatten(arguments)
    full = ("executable", key, structure, tuple((jnp.shape(a), str(jnp.result_type(a))) for a in leaves))
    if full in cache:
        return cache[full], 0.0
    begin = time.perf_counter()
    traced = run.trace(*arguments)
    options = compiler_options(choose_fusion(traced.jaxpr))
    cache[full] = traced.lower().compile(compiler_options=options)
    return cache[full], time.perf_counter() - begin


def choose_fusion(jaxpr: Any) -> bool:
    """Whether loop fusion pays for this program; `ACAUSAL_XLA_FUSION=0` or `1` overrides it."""
    forced = os.environ.get("ACAUSAL_XLA_FUSION")
    if forced in ("0", "1"):
        return forced == "1"
    return count_equations(jaxpr) <= FUSE_BELOW


def ensure_x64() -> None:
    """Turns on JAX's double precision, saying so once: models mix magnitudes that single precision cannot hold.

    Raises:
        SimulationError: it is off, and the caller is already inside a JAX transformation, where it is too late.
    """
    if jax.config.read("jax_enable_x64"):
        return
    if inside_jit():
        from acausal.errors import SimulationError

        raise SimulationError(
            "JAX runs in single precision, and this call is inside a JAX transformation, where that can no longer be "
            'changed. Put `jax.config.update("jax_enable_x64", True)` at the start of the program.'
        )
    enable_double_precision()
