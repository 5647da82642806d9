"""Linear systems by their transfer function or their matrices."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from acausal import Array, Component, DeclarationError, Equations, Expr, Parameter, Variable, Vector, der

from .interfaces import SISO, SignalIn, SignalOut, initialized
from .multi import total

EPS = 2.220446049250313e-16
"""Rounding of a number near 1."""

Rows = Sequence[Sequence[float]]


def check_coefficients(b: Sequence[float], a: Sequence[float]) -> None:
    """Raise DeclarationError if b and a are no coefficients of a proper transfer function."""
    if not b or not a or len(b) > len(a) or a[0] == 0:
        raise DeclarationError(
            f"TransferFunction: b={b}, a={a}: both have coefficients, a[0] is not 0 and b is not longer than a"
        )


def check_shapes(A: Rows, B: Rows, C: Rows, D: Rows) -> None:
    """Raise DeclarationError if the matrices of a state space do not fit together."""
    states, inputs, outputs = len(A), len(B[0]) if B else 0, len(C)
    shapes = {"A": (A, states, states), "B": (B, states, inputs), "C": (C, outputs, states), "D": (D, outputs, inputs)}
    for name, (matrix, rows, columns) in shapes.items():
        if len(matrix) != rows or any(len(row) != columns for row in matrix):
            raise DeclarationError(
                f"StateSpace: {name}={matrix} should have {rows} rows of {columns} numbers: A is of {states} states, B "
                f"of {inputs} inputs and C of {outputs} outputs"
            )


class TransferFunction(SISO):
    """Transfer function ``(b[0] s^m + ... + b[m]) / (a[0] s^n + ... + a[n])``, in controller canonical form.

    The states are ``x_scaled``, ``dx_scaled[i]/dt = x_scaled[i-1]``, so scaled that the last of them is the output of
    ``a[n]/a(s)``; ``x = x_scaled/a[n]``, and `x_start` are their start values.

    >>> class Lag(Component):
    ...     step: Step = Step(height=3.0)
    ...     lag: TransferFunction = TransferFunction(b=[2.0, 1.0], a=[0.5, 1.0])
    ...     def equations(self):
    ...         yield connect(self.step.y, self.lag.u)
    >>> close(run(Lag(), at=[0.25, 1.0])["lag.y"], 3 * (1 + 3 * np.exp([-0.5, -2.0])), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.TransferFunction; Kailath, Linear Systems (1980), section 2.1.
    """

    b: Sequence[float] = (1.0,)
    a: Sequence[float] = (1.0,)
    initType: str = "NoInit"
    y_start: Parameter = Parameter(0.0, doc="start value of the output")

    @property
    def nx(self) -> int:
        """Number of states."""
        check_coefficients(self.b, self.a)
        return len(self.a) - 1

    @property
    def scale(self) -> float:
        """Factor of the scaled states."""
        size = math.sqrt(sum(c * c for c in self.a))
        return self.a[-1] if self.a[-1] > 100 * EPS * size else 1.0

    x_start: Vector = Vector(Parameter(0.0, doc="start value of the state"), size="nx")
    x: Vector = Vector(Variable(doc="state"), size="nx")
    x_scaled: Vector = Vector(Variable(doc="scaled state"), size="nx")

    def equations(self) -> Equations:
        yield from super().equations()
        n, lead, x = self.nx, self.a[0], self.x_scaled
        numerator = (0.0,) * (n + 1 - len(self.b)) + tuple(self.b)
        through = numerator[0] / lead
        output = through * self.u
        if n:
            feedback = sum((self.a[i + 1] * x[i] for i in range(1, n)), self.a[1] * x[0])
            yield lead * der(x[0]) == self.scale * self.u - feedback
        for i in range(1, n):
            yield der(x[i]) == x[i - 1]
        for i in range(n):
            output = output + (numerator[i + 1] - through * self.a[i + 1]) / self.scale * x[i]
            yield self.x[i] == x[i] / self.scale
        yield self.y == output

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        x = list(zip(self.x_scaled, [start * self.scale for start in self.x_start], strict=True))
        yield from initialized(self.initType, x[::-1], (self.y, self.y_start) if x else None)


class StateSpace(Component):
    """State space, ``dx/dt = A x + B u``, ``y = C x + D u``; signals ``u[i].u``, ``y[i].y``, states ``x``.

    With ``initType="InitialOutput"`` the outputs have their start values, and the states are as steady as they can be.

    >>> class Spring(Component):
    ...     push: Step = Step(height=4.0)
    ...     mass: StateSpace = StateSpace(A=[[0, 1], [-4, 0]], B=[[0], [1]], C=[[1, 0]])
    ...     def equations(self):
    ...         yield connect(self.push.y, self.mass.u[0].u)
    >>> close(run(Spring(), at=[0.5, 1.0])["mass.y[0].y"], 1 - np.cos([1.0, 2.0]), 1e-4)
    True

    Source: Modelica.Blocks.Continuous.StateSpace.
    """

    A: Sequence[Sequence[float]] = ((1.0, 0.0), (0.0, 1.0))
    B: Sequence[Sequence[float]] = ((1.0,), (1.0,))
    C: Sequence[Sequence[float]] = ((1.0, 1.0),)
    D: Sequence[Sequence[float]] = ()
    initType: str = "NoInit"

    @property
    def nx(self) -> int:
        """Number of states."""
        return len(self.A)

    @property
    def nu(self) -> int:
        """Number of inputs."""
        return len(self.B[0]) if self.B else 0

    @property
    def ny(self) -> int:
        """Number of outputs."""
        return len(self.C)

    u: Array[SignalIn] = Array(SignalIn(), "nu")
    y: Array[SignalOut] = Array(SignalOut(), "ny")
    x_start: Vector = Vector(Parameter(0.0, doc="start value of the state"), size="nx")
    y_start: Vector = Vector(Parameter(0.0, doc="start value of the output"), size="ny")
    x: Vector = Vector(Variable(doc="state"), x_start, size="nx")

    @property
    def direct(self) -> Sequence[Sequence[float]]:
        """The matrix D, which is zero if it is not given."""
        return self.D or ((0.0,) * self.nu,) * self.ny

    def equations(self) -> Equations:
        yield from super().equations()
        check_shapes(self.A, self.B, self.C, self.direct)
        for i in range(self.nx):
            yield der(self.x[i]) == self._row(self.A[i], self.B[i])
        for i in range(self.ny):
            yield self.y[i].y == self._row(self.C[i], self.direct[i])

    def _row(self, of_states: Sequence[float], of_inputs: Sequence[float]) -> Expr:
        return total(of_states, list(self.x)) + total(of_inputs, [signal.u for signal in self._inputs()])

    def _inputs(self) -> list[SignalIn]:
        return [self.u[i] for i in range(self.nu)]

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        if self.initType == "InitialOutput":
            yield from self._steadiest()
        else:
            yield from initialized(self.initType, list(zip(self.x, self.x_start, strict=True)))

    def _steadiest(self) -> Equations:
        """The states of least ``|A x + B u|`` among those with ``C x + D u = y_start``, by Lagrange's multipliers."""
        A, C, n = np.array(self.A), np.array(self.C), self.nx
        both = np.block([[A.T @ A, C.T], [C, np.zeros((self.ny, self.ny))]])
        inverse = np.linalg.pinv(both)[:n]
        of_inputs = -inverse[:, :n] @ A.T @ np.array(self.B) - inverse[:, n:] @ np.array(self.direct)
        inputs = [signal.u for signal in self._inputs()]
        for i, x in enumerate(self.x):
            yield x == total(of_inputs[i].tolist(), inputs) + total(inverse[i, n:].tolist(), list(self.y_start))
