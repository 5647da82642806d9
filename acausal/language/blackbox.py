"""Opaque functions: user JAX code, and tables, as one node of an expression."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Sequence
from typing import Any

from ..errors import DeclarationError
from ..symbolic.expr import Expr, Operand, as_expr, intern_node
from .instance import call_site


class BlackBox:
    """A JAX function of scalars that returns a scalar; its derivatives come from `jax.jvp`.

    Calling it on expressions gives an expression.
    """

    def __init__(self, function: Callable[..., Any], name: str, order: tuple[int, ...] = ()) -> None:
        self.function = function
        self.name = name
        self.order = order
        self._partials: dict[int, BlackBox] = {}

    def __call__(self, *args: Operand) -> Expr:
        return intern_node("call", tuple(as_expr(a) for a in args), self)

    def partial(self, index: int, args: tuple[Expr, ...]) -> Expr:
        """Partial derivative with respect to argument `index`, as an expression."""
        if index not in self._partials:
            derivative = _partial(self.function, index)
            self._partials[index] = BlackBox(derivative, f"∂{index}{self.name}", (*self.order, index))
        return intern_node("call", args, self._partials[index])

    def evaluate(self, *args: Any, xp: Any) -> Any:
        """Value on numbers or arrays (elementwise)."""
        import jax
        import jax.numpy as jnp

        arrays = jnp.broadcast_arrays(*(jnp.asarray(a, dtype=float) for a in args))
        function = self.function
        for _ in range(arrays[0].ndim):
            function = jax.vmap(function)
        value = function(*arrays)
        if jnp.shape(value) != arrays[0].shape:
            raise TypeError(f"function `{self.name}` must return one scalar, got shape {jnp.shape(value)}")
        return value if xp is jnp else xp.asarray(value)


def _partial(function: Callable[..., Any], index: int) -> Callable[..., Any]:
    def derivative(*args: Any) -> Any:
        import jax
        import jax.numpy as jnp

        tangents = [jnp.ones_like(a) if i == index else jnp.zeros_like(a) for i, a in enumerate(args)]
        return jax.jvp(function, args, tuple(tangents))[1]

    return derivative


def function(f: Callable[..., Any], *, name: str | None = None) -> BlackBox:
    """Use a JAX function in equations: ``friction = ac.function(lambda Re: 64 / Re)``, then ``friction(self.Re)``.

    Args:
        f: takes float scalars and returns one; written with `jax.numpy`, so that JAX can differentiate it.
        name: shown in reports; the function's own name by default.
    """
    return BlackBox(f, name or getattr(f, "__name__", "function"))


def table(x: Sequence[float], y: Sequence[float], *, name: str = "table") -> BlackBox:
    """Piecewise linear interpolation of (x, y), constant outside; `x` must increase.

    Raises:
        DeclarationError: lengths differ, fewer than two points, or x does not increase.
    """
    if len(x) != len(y) or len(x) < 2:
        raise DeclarationError(
            f"table needs as many y as x and at least two points, got {len(x)} and {len(y)} {call_site()}"
        )
    if any(not b > a for a, b in itertools.pairwise(x)):
        raise DeclarationError(f"table: x must increase strictly {call_site()}")
    return Table(tuple(map(float, x)), tuple(map(float, y)), name)


class Table(BlackBox):
    """Piecewise linear interpolation between points (x, y), constant outside; its derivative is a step function."""

    def __init__(self, x: tuple[float, ...], y: tuple[float, ...], name: str, order: tuple[int, ...] = ()) -> None:
        def interpolate(value: Any) -> Any:
            import jax.numpy as jnp

            return jnp.interp(value, jnp.asarray(x), jnp.asarray(y))

        def slope(value: Any) -> Any:
            import jax.numpy as jnp

            xs, ys = jnp.asarray(x), jnp.asarray(y)
            slopes = jnp.concatenate([jnp.zeros(1), jnp.diff(ys) / jnp.diff(xs), jnp.zeros(1)])
            return slopes[jnp.searchsorted(xs, value, side="right")]

        def flat(value: Any) -> Any:
            return 0.0 * value

        super().__init__((interpolate, slope, flat)[min(len(order), 2)], name, order)
        self.x, self.y = x, y

    def partial(self, index: int, args: tuple[Expr, ...]) -> Expr:
        """Derivative, as an expression."""
        if index not in self._partials:
            self._partials[index] = Table(self.x, self.y, f"∂{self.name}", (*self.order, index))
        return intern_node("call", args, self._partials[index])
