"""Random systems of equations: those without a pairing of equations and unknowns are errors with the right culprits."""

from __future__ import annotations

import re
import types
from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Variable, sin
from acausal.errors import StructureError

Rows = list[list[int]]


def pairs(rows: Rows) -> int:
    """Size of a maximum matching, by trying all."""
    if not rows:
        return 0
    first, rest = rows[0], rows[1:]
    return max([pairs(rest), *(1 + pairs([[k for k in row if k != j] for row in rest]) for j in first)])


def system_of(rows: Rows, n: int) -> Component:
    """Equation i holds the unknowns `rows[i]`, none of them isolated by an alias or a number."""

    def equations(self: Any) -> Equations:
        for i, row in enumerate(rows):
            unknowns = [getattr(self, f"x{j}") for j in row]
            terms = [2 * x + sin((i + 1) * x) for x in unknowns]
            total: Any = sum(terms[1:], terms[0])
            yield total == 100 + i + ac.time

    names = [f"x{j}" for j in range(n)]
    fields: dict[str, Any] = {name: Variable() for name in names}
    body = {"equations": equations, "__module__": __name__, "__annotations__": dict.fromkeys(names, Variable), **fields}
    return types.new_class("RandomSystem", (Component,), {}, lambda ns: ns.update(body))()


@pytest.mark.parametrize("seed", range(20))
def test_culprits_by_brute_force(seed: int) -> None:
    """An equation is one too many iff the others pair as many unknowns; an unknown is undetermined likewise."""
    random, singular = np.random.default_rng(seed), 0
    for _ in range(20):
        n = int(random.integers(2, 6))
        rows = [sorted(random.choice(n, random.integers(1, 1 + min(n, 3)), replace=False).tolist()) for _ in range(n)]
        full = pairs(rows)
        if full == n:
            ac.compile(system_of(rows, n))
            continue
        singular += 1
        over = [i for i in range(n) if pairs([row for k, row in enumerate(rows) if k != i]) == full]
        under = [j for j in range(n) if pairs([[k for k in row if k != j] for row in rows]) == full]
        with pytest.raises(StructureError) as caught:
            ac.compile(system_of(rows, n))
        numbers = re.findall(r"time \+ (\d+)", "\n".join(caught.value.equations))
        with_undetermined = [i for i, row in enumerate(rows) if any(j in under for j in row)]
        assert sorted(int(k) - 100 for k in numbers) == sorted([*over, *with_undetermined]), rows
        unknowns = {j for i in over for j in rows[i]} | set(under)
        assert set(caught.value.unknowns) == {f"x{j}" for j in unknowns}, rows
        assert len(caught.value.unknowns) == len(unknowns)
    assert singular
