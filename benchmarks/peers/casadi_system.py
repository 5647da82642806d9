"""The equations of a compiled system in CasADi, for CasADi's integrators: the same schedule, another algebra."""

from __future__ import annotations

from typing import Any

import casadi as ca
import numpy as np

from acausal.symbolic.expr import Expr
from acausal.symbolic.traverse import evaluate


class Functions:
    """NumPy's names for CasADi's functions."""

    where = staticmethod(ca.if_else)
    minimum, maximum, sqrt, exp, log, log10, tanh = ca.fmin, ca.fmax, ca.sqrt, ca.exp, ca.log, ca.log10, ca.tanh
    sin, cos, tan, arcsin, arccos, arctan, arctan2 = ca.sin, ca.cos, ca.tan, ca.asin, ca.acos, ca.atan, ca.atan2
    sinh, cosh, arcsinh = ca.sinh, ca.cosh, ca.asinh
    abs, sign, power, floor, ceil = ca.fabs, ca.sign, ca.power, ca.floor, ca.ceil
    logical_and, logical_or, logical_not = ca.logic_and, ca.logic_or, ca.logic_not

    @staticmethod
    def clip(x: Any, low: Any, high: Any) -> Any:
        return ca.fmin(ca.fmax(x, low), high)

    @staticmethod
    def mod(a: Any, b: Any) -> Any:
        return a - b * ca.floor(a / b)

    @staticmethod
    def equal(a: Any, b: Any) -> Any:
        return a == b

    @staticmethod
    def less(a: Any, b: Any) -> Any:
        return a < b

    @staticmethod
    def less_equal(a: Any, b: Any) -> Any:
        return a <= b

    @staticmethod
    def greater(a: Any, b: Any) -> Any:
        return a > b

    @staticmethod
    def greater_equal(a: Any, b: Any) -> Any:
        return a >= b


def to_casadi(system: Any) -> tuple[Any, Any, Any]:
    """Time, states and derivatives of a system without algebraic unknowns, as CasADi symbols and expressions."""
    low = system.lowered
    if low.n_w:
        raise ValueError(f"{system.name} has algebraic unknowns that an integrator of this kind does not take")
    parameters = np.asarray(system.program.default)
    t, x = ca.SX.sym("t"), ca.SX.sym("x", low.n_x)
    value: dict[int, Any] = {int(v): x[k] for k, v in enumerate(low.schedule.states)}
    for group in low.schedule.groups:
        for row in range(group.size):
            rows, par_rows = group.var_rows[row], group.par_rows[row]

            def leaf(node: Expr, rows: Any = rows, par_rows: Any = par_rows) -> Any:
                if node.op == "time":
                    return t
                if node.op == "par":
                    return float(parameters[par_rows[node.value]])
                return value[int(rows[node.value])]

            kernel = group.kernel
            if kernel.matrix:
                k = len(kernel.matrix)
                entries = evaluate([*(e for line in kernel.matrix for e in line), *kernel.rhs], leaf, Functions)
                matrix = ca.vertcat(*[ca.horzcat(*entries[i * k : (i + 1) * k]) for i in range(k)])
                solved = ca.solve(matrix, ca.vertcat(*entries[k * k :]))
                for i, u in enumerate(kernel.tears):
                    value[int(rows[u])] = solved[i]
            for u, expression in kernel.steps:
                value[int(rows[u])] = evaluate((expression,), leaf, Functions)[0]
    return t, x, ca.vertcat(*[value[int(v)] for v in low.dx_ids])
