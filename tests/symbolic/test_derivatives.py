"""Derivatives, against complex and finite differences and against JAX; isolation of unknowns."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

import acausal as ac
from acausal.symbolic.differentiate import differentiate, partial
from acausal.symbolic.expr import ONE, ZERO, Expr, par, var
from acausal.symbolic.isolate import Solvability, isolate
from acausal.symbolic.operators import OPERATORS
from acausal.symbolic.traverse import evaluate, postorder

from .strategies import LEAVES, expressions

jax.config.update("jax_enable_x64", True)
x, y, z = LEAVES
coordinates = st.floats(-2.0, 2.0).map(lambda v: round(v, 3))
points = st.tuples(coordinates, coordinates, coordinates)


def value(e: Expr, point: tuple[float, ...]) -> float:
    at = dict(zip(LEAVES, point, strict=True))
    return float(evaluate((e,), lambda leaf: at[leaf], np)[0])


@given(expressions(kinked=False), points)
def test_partial_derivatives_are_the_limits_of_differences(e: Expr, point: tuple[float, float, float]) -> None:
    for k, leaf in enumerate(LEAVES):
        h = 1e-5
        shifted = [tuple(c + s * h * (i == k) for i, c in enumerate(point)) for s in (-2, -1, 1, 2)]
        f = [value(e, p) for p in shifted]
        difference = (f[0] - 8 * f[1] + 8 * f[2] - f[3]) / (12 * h)
        scale = 1 + max(abs(v) for v in f)
        assert value(partial(e, leaf), point) == pytest.approx(difference, rel=1e-5, abs=1e-5 * scale)


@given(expressions(), points)
def test_partial_derivatives_agree_with_jax(e: Expr, point: tuple[float, float, float]) -> None:
    def function(*args: jax.Array) -> jax.Array:
        at = dict(zip(LEAVES, args, strict=True))
        return jnp.asarray(evaluate((e,), lambda leaf: at[leaf], jnp)[0], float)

    apart = [v for v in (point[0] - point[1], point[1] - point[2], *point) if abs(v) < 1e-2]
    if apart:  # on a kink both are right
        return
    wanted = jax.grad(function, (0, 1, 2))(*map(jnp.asarray, point))
    got = [value(partial(e, leaf), point) for leaf in LEAVES]
    kinks = [n for n in postorder((e,)) if n.op in ("max", "min", "abs", "clip", "where")]
    if any(abs(value(n.args[0], point) - value(a, point)) < 1e-9 for n in kinks for a in n.args[1:]):
        return
    assert np.allclose(got, np.array(wanted), rtol=1e-9, atol=1e-9)


@given(expressions(), points)
def test_a_directional_derivative_is_the_combination_of_partials(e: Expr, point: tuple[float, float, float]) -> None:
    direction = {x: 2 * ONE, y: -ONE, z: ZERO}
    got = value(differentiate((e,), direction.__getitem__)[0], point)
    with np.errstate(all="ignore"):
        wanted = 2 * value(partial(e, x), point) - value(partial(e, y), point)
    assert got == pytest.approx(wanted, rel=1e-9, abs=1e-9)


UNARY = "neg sin cos tan asin acos atan sinh cosh tanh asinh sqrt exp log log10".split()


@pytest.mark.parametrize("op", UNARY)
def test_every_unary_rule(op: str) -> None:
    e = getattr(ac, op)(x) if op != "neg" else -x
    h, at = 1e-6, 0.37
    difference = (value(e, (at + h, 0, 0)) - value(e, (at - h, 0, 0))) / (2 * h)
    assert value(partial(e, x), (at, 0.0, 0.0)) == pytest.approx(difference, rel=1e-8)
    inverse = OPERATORS[op].inverse
    if inverse is not None:
        assert value(inverse(e), (at, 0.0, 0.0)) == pytest.approx(at, rel=1e-12)


@pytest.mark.parametrize(("base", "exponent"), [(0.0, 1.0), (0.0, 1.5), (0.3, 1.5), (2.0, -1.0)])
def test_a_power_by_its_exponent(base: float, exponent: float) -> None:
    """Zero where the base is: the limit, though the logarithm is infinite."""
    wanted = base**exponent * np.log(base) if base else 0.0
    assert value(partial(x**y, y), (base, exponent, 0.0)) == wanted


def test_derivatives_share_subexpressions() -> None:
    e = x
    for _ in range(30):
        e = ac.sin(e) * e
    d = partial(e, x)
    assert len(postorder((e, d))) < 20 * 30


v0, v1, p0 = var(0), var(1), par(0)


@pytest.mark.parametrize(
    ("residual", "kind", "solution"),
    [
        (2 * v0 - v1, Solvability.CONSTANT, 0.5 * 1.7),
        (p0 * v0 - v1, Solvability.PARAMETER, 1.7 / 0.6),
        (v0 / p0 + v1, Solvability.PARAMETER, -1.7 * 0.6),
        (v1 * v0 - p0, Solvability.VARIABLE, 0.6 / 1.7),
        (v0 * (v1 + ac.sin(v1)) + v0 - p0, Solvability.VARIABLE, 0.6 / (1.7 + np.sin(1.7) + 1)),
        (ac.exp(v0) - v1, Solvability.NONLINEAR, None),
        (ac.log(2 * v0) - v1, Solvability.INVERTIBLE, np.exp(1.7) / 2),
        (p0 / v0 - v1, Solvability.INVERTIBLE, 0.6 / 1.7),
        (ac.sinh(v0 + v1) - p0, Solvability.INVERTIBLE, np.arcsinh(0.6) - 1.7),
        (v0**2 - v1, Solvability.NONLINEAR, None),
        (v0 + ac.sin(v0), Solvability.NONLINEAR, None),
        (v1 - p0, Solvability.NONLINEAR, None),
    ],
    ids=str,
)
def test_isolation(residual: Expr, kind: Solvability, solution: float | None) -> None:
    found = isolate(residual, v0)
    assert found.solvability == kind
    if solution is None:
        assert found.solution is None
        return
    at = {v1: 1.7, p0: 0.6}
    assert found.solution is not None
    assert float(evaluate((found.solution,), lambda leaf: at[leaf], np)[0]) == pytest.approx(solution)


@given(expressions(kinked=False), points)
@example(-y * (x + y), (0.0, 0.0, 0.0))
def test_what_is_isolated_solves_the_equation(e: Expr, point: tuple[float, float, float]) -> None:
    found = isolate(e, x)
    if found.solution is None:
        return
    at = {leaf: np.float64(value) for leaf, value in zip(LEAVES, point, strict=True)}  # a division by zero is inf
    with np.errstate(all="ignore"):
        at[x] = np.float64(evaluate((found.solution,), lambda leaf: at[leaf], np)[0])
        residual = float(evaluate((e,), lambda leaf: at[leaf], np)[0])
        slope = float(evaluate((found.coefficient,), lambda leaf: at[leaf], np)[0])
    if np.isfinite(at[x]) and abs(slope) > 1e-6:
        assert abs(residual) < 1e-6 * (1 + abs(at[x]) * (1 + abs(slope)))
