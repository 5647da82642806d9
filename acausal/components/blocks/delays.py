"""Delays as rational functions."""

from __future__ import annotations

import numpy as np

from acausal import DeclarationError, Equations, Expr, Parameter, Variable, Vector, der

from .interfaces import SISO
from .multi import total


class PadeDelay(SISO):
    """Approximation of ``y(t) = u(t - delayTime)``: Pade's rational function of degree `m` over `n`.

    The states `x` are those of the controller canonical form, of which the last is `u` at the start. With `balance`
    (recommended for large `n`) they are scaled, and at rest at the start. ``m = 0`` stands for ``m = n``.

    >>> model = assemble("wave.y - late.u", wave=Sine(f=1.0), late=PadeDelay(delayTime=0.125, n=4, balance=True))
    >>> close(run(model, at=[0.5, 1.0])["late.y"], np.sin(2 * np.pi * np.array([0.375, 0.875])), 1e-3)
    True

    Source: Modelica.Blocks.Nonlinear.PadeDelay; Golub and Van Loan, Matrix Computations (1996), section 11.3.
    """

    n: int = 1
    m: int = 0
    balance: bool = False
    delayTime: Parameter = Parameter(1.0, unit="s", min=1e-60, doc="delay")
    x: Vector = Vector(Variable(start=0.0, doc="state"), size="n")

    def equations(self) -> Equations:
        yield from super().equations()
        T, x = self.delayTime, list(self.x)
        numerator, denominator = self.coefficients()
        lead = denominator[0]
        through = numerator[0] / lead
        rest = [b - through * a for a, b in zip(denominator[1:], numerator[1:], strict=True)]
        if self.balance:
            scales = _balanced(denominator)
            feedback = total([a * s for a, s in zip(denominator[1:], scales, strict=True)], x)
            yield T * der(x[0]) * scales[0] == (self.u - feedback) / lead
            for i in range(1, self.n):
                yield T * der(x[i]) == x[i - 1] * (scales[i - 1] / scales[i])
            yield self.y == total([c * s for c, s in zip(rest, scales, strict=True)], x) + through * self.u
        else:  # the coefficients of s^k have the factor T^k
            powers = [T ** (self.n - 1 - i) for i in range(self.n)]
            feedback = _weighted(denominator[1:], powers, x)
            yield lead * T**self.n * der(x[0]) == self.u - feedback
            for i in range(1, self.n):
                yield der(x[i]) == x[i - 1]
            yield self.y == _weighted(rest, powers, x) + through * self.u

    def coefficients(self) -> tuple[list[float], list[float]]:
        """Numerator and denominator for a delay of 1 s, the highest power first, of the same length."""
        n, m = self.n, self.m or self.n
        if not 1 <= m <= n:
            raise DeclarationError(f"PadeDelay: n={n}, m={m}; 1 <= m <= n is needed")
        a, b = [1.0], [1.0]
        for i in range(1, n + 1):
            a.append(a[-1] * (n - i + 1) / (n + m - i + 1) / i)
            b.append(-b[-1] * (m - i + 1) / (n + m - i + 1) / i if i <= m else 0.0)
        return b[::-1], a[::-1]

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.balance:
            for x in self.x:
                yield der(x) == 0
        else:
            yield self.x[self.n - 1] == self.u


def _weighted(weights: list[float], powers: list[Expr], x: list[Expr]) -> Expr:
    return total(weights, [p * state for p, state in zip(powers, x, strict=True)])


def _balanced(denominator: list[float]) -> list[float]:
    """Units of the states in which the rows and columns of the companion matrix have about the same size."""
    from scipy.linalg import matrix_balance

    n = len(denominator) - 1
    companion = np.eye(n, k=-1)
    companion[0] = -np.array(denominator[1:]) / denominator[0]
    scales = matrix_balance(companion, permute=False, separate=True)[1][0]
    return [float(s) for s in scales]
