"""Random linear DAEs of known index against their exact solution: the right answer, or an error that says why."""

from __future__ import annotations

import types
from dataclasses import dataclass, replace
from typing import Any, cast

import numpy as np
import pytest
from scipy.linalg import expm

import acausal as ac
from acausal import Component, Equations, Variable, der


@dataclass(frozen=True)
class LinearDAE:
    """``E z' + A z = f(t)`` in Weierstrass form: ``E = P diag(I, N) Q``, ``A = P diag(-J, I) Q``, N nilpotent.

    Source: Kunkel and Mehrmann (2006), Differential-Algebraic Equations, theorem 2.7 and lemma 2.8.
    """

    P: np.ndarray
    Q: np.ndarray
    J: np.ndarray
    N: np.ndarray
    y0: np.ndarray
    amplitude: np.ndarray

    @property
    def index(self) -> int:
        """Smallest k with ``N^k = 0``."""
        k = 0
        while len(self.N) and np.any(np.linalg.matrix_power(self.N, k)):
            k += 1
        return k

    def exact(self, t: float) -> np.ndarray:
        """``y = exp(J t) y0``; ``w = sum_k (-N)^k g^(k)`` for ``g = amplitude sin(2 t)``."""
        w = np.zeros(len(self.N))
        for k in range(self.index):
            derivative = self.amplitude * 2.0**k * np.sin(2 * t + k * np.pi / 2)
            w = w + np.linalg.matrix_power(-self.N, k) @ derivative
        return np.linalg.solve(self.Q, np.concatenate([expm(self.J * t) @ self.y0, w]))

    def model(self) -> Component:
        """The equations, written out; the start values are those of the solution, but none is fixed."""
        r, n = len(self.J), len(self.P)
        zero, one = np.zeros((r, n - r)), np.eye(n - r)
        E = self.P @ np.block([[np.eye(r), zero], [zero.T, self.N]]) @ self.Q
        A = self.P @ np.block([[-self.J, zero], [zero.T, one]]) @ self.Q
        F = self.P @ np.concatenate([np.zeros(r), self.amplitude])
        first = self.exact(0.0)

        def equations(self: Any) -> Equations:
            z = [getattr(self, f"z{j}") for j in range(n)]
            for i in range(n):
                terms = [float(E[i, j]) * der(z[j]) for j in range(n) if E[i, j]]
                terms += [float(A[i, j]) * z[j] for j in range(n) if A[i, j]]
                yield sum(terms[1:], terms[0]) == float(F[i]) * ac.sin(2 * ac.time)

        fields: dict[str, Any] = {f"z{j}": Variable(start=float(first[j])) for j in range(n)}
        notes = {f"z{j}": Variable for j in range(n)}
        body = {**fields, "equations": equations, "__annotations__": notes, "__module__": __name__}
        return cast("type[Component]", types.new_class("Linear", (Component,), exec_body=lambda ns: ns.update(body)))()


def mixing(rng: np.random.Generator, n: int, steps: int) -> np.ndarray:
    """A matrix of small integers with determinant 1 or -1: row operations on a permutation."""
    matrix = np.eye(n)[rng.permutation(n)]
    for _ in range(steps if n > 1 else 0):
        i, j = rng.choice(n, 2, replace=False)
        matrix[i] += float(rng.choice([-2, -1, 1, 2])) * matrix[j]
    return matrix


def draw(seed: int) -> LinearDAE:
    """Up to 7 variables, index 0 to 3, from structures that are plain to ones that are hidden."""
    rng = np.random.default_rng(seed)
    index, r = int(rng.integers(0, 4)), int(rng.integers(1, 4))
    blocks = [index] * (index > 0) + [int(rng.integers(1, index + 1)) for _ in range(rng.integers(0, 2)) if index]
    N = np.zeros((sum(blocks), sum(blocks)))
    at = 0
    for size in blocks:
        N[at : at + size, at : at + size] = np.eye(size, k=1)
        at += size
    n = r + len(N)
    steps = int(rng.integers(0, n + 1))
    J = np.round(rng.uniform(-1, 1, (r, r)), 2)
    return LinearDAE(mixing(rng, n, steps), mixing(rng, n, steps), J, N, np.round(rng.uniform(-1, 1, r), 2) + 1.5,
                     np.round(rng.uniform(0.5, 2.0, len(N)), 2))  # fmt: skip


def solved(seed: int, engine: Any) -> bool:
    """Whether the compiler and solver find the exact solution; False for an error of theirs. Never another answer."""
    dae = draw(seed)
    try:
        system = ac.compile(dae.model())
        solution = system.simulate(1.0, saveat=[0.0, 0.5, 1.0], rtol=1e-9, engine=engine, max_steps=50_000)
    except ac.AcausalError as error:
        assert len(str(error)) > 40
        return False
    values = np.array([solution[f"z{j}"] for j in range(len(dae.P))]).T
    begun = replace(dae, y0=(dae.Q @ values[0])[: len(dae.J)])  # nothing fixes the start but the constraints
    for found, t in zip(values, (0.0, 0.5, 1.0), strict=True):
        wanted = begun.exact(t)
        np.testing.assert_allclose(found, wanted, rtol=1e-5, atol=1e-6 * np.abs(wanted).max(), err_msg=f"seed {seed}")
    return True


def test_the_exact_solution_or_an_error() -> None:
    count = sum(solved(seed, "diffrax" if seed == 0 else "native") for seed in range(16))
    assert count >= 14


@pytest.mark.parametrize("seed", [304, 392])
def test_combinations_whose_terms_cancel_when_they_are_collected(seed: int) -> None:
    """``-2 x' + 3 x' - x'`` is no occurrence of x'."""
    assert solved(seed, "native")


def test_the_index_is_right_and_the_structural_one_an_upper_bound() -> None:
    """Where variables mix, an algebraic one seems to follow from equations that cancel in it."""
    excess: list[int] = []
    for dae in map(draw, range(20)):
        report = ac.compile(dae.model()).report()
        assert report.index == dae.index
        excess.append(report.structural_index - report.index)
    assert min(excess) == 0
    assert sum(excess) <= 1


@pytest.mark.slow
def test_many_indices() -> None:
    for dae in map(draw, range(20, 300)):
        assert ac.compile(dae.model()).report().index == dae.index


@pytest.mark.slow
def test_many_linear_daes() -> None:
    assert sum(solved(seed, "native") for seed in range(16, 300)) >= 260
