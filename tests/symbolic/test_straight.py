"""Expressions as one Python function, against their values node by node."""

from __future__ import annotations

import numpy as np

from acausal.symbolic.expr import Expr, add, const, div, intern_node, make, mul, neg, par, var
from acausal.symbolic.straight import straight
from acausal.symbolic.traverse import evaluate, postorder

X, Y, P = var(0), var(1), par(0)
TIME = intern_node("time", ())
FORMS = (
    add(mul(X, P), neg(Y), const(2.0)),
    div(X, Y),
    add(make("lt", (X, Y)), make("gt", (X, P))),  # truth values are counted with
    neg(make("le", (X, TIME))),
    make("where", (make("ge", (X, Y)), make("sqrt", (Y,)), make("pow", (X, const(3.0))))),
    P,
)


def test_it_gives_the_values_that_the_nodes_have() -> None:
    v, p, t = np.array([1.0, -2.0, 0.5, 0.0]), np.array([3.0, -1.0]), np.float64(0.7)
    variables, parameters = [np.array([0, 2, 3]), np.array([2, 1, 0])], [np.array([0, 1, 1])]

    def leaf(node: Expr) -> object:
        if node.op == "time":
            return t
        return p[parameters[node.value]] if node.op == "par" else v[variables[node.value]]

    with np.errstate(all="ignore"):
        found = straight(postorder(FORMS), FORMS)(t, v, p, variables, parameters)
        wanted = evaluate(FORMS, leaf, np)
    for a, b in zip(found, wanted, strict=True):
        np.testing.assert_array_equal(a, b)
