"""Terms of sums that cancel only when they are collected."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from acausal.symbolic.collect import collected
from acausal.symbolic.expr import Expr, add, const, div, make, mul, neg, var
from acausal.symbolic.traverse import contains, evaluate

X, Y, Z = var(0), var(1), var(2)


def test_terms_that_cancel() -> None:
    assert collected(add(mul(const(3), X), neg(mul(const(2), X)), neg(X), Y)) is Y
    assert collected(add(mul(const(2), add(X, Y)), mul(const(-2), X), Z)) is add(mul(const(2), Y), Z)
    assert collected(add(div(X, const(4)), mul(const(-0.25), X), Y)) is Y
    product = mul(X, make("sin", (Y,)))
    assert not contains(collected(add(mul(const(0.5), product), Z, mul(const(-0.5), product))), X)


def test_what_rounding_leaves_cancels() -> None:
    left = add(mul(const(0.1), X), mul(const(0.2), X), mul(const(-0.3), X), Y)
    assert collected(left) is Y


def test_others_are_left_as_they_are() -> None:
    for e in (add(X, mul(const(2), X)), mul(const(2), add(X, Y)), add(X, neg(Y), const(3.0)), mul(X, Y), const(0.0)):
        assert collected(e) is e


linear = st.recursive(
    st.sampled_from([X, Y, Z, const(1.0), mul(X, Y)]),
    lambda inner: st.one_of(
        st.tuples(inner, inner).map(lambda t: add(*t)),
        st.tuples(st.sampled_from([-2.0, -1.0, 0.5, 3.0]), inner).map(lambda t: mul(const(t[0]), t[1])),
        st.tuples(inner, st.sampled_from([-4.0, 2.0])).map(lambda t: div(t[0], const(t[1]))),
        inner.map(neg),
    ),
    max_leaves=12,
)


@given(linear)
def test_value_stays(e: Expr) -> None:
    point = np.array([[1.3, 0.4], [-0.7, 1.9], [2.1, -3.3]])
    before, after = (np.broadcast_to(v, 2) for v in evaluate((e, collected(e)), lambda leaf: point[leaf.value], np))
    assert_allclose(after, before, rtol=1e-12, atol=1e-12)
