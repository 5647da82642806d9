"""Which states, inputs and time every variable depends on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from ...lowering.c.straight import Straight, family_residuals, write_out
from ...symbolic.expr import Expr
from ...symbolic.traverse import postorder
from .variables import Starts

if TYPE_CHECKING:
    from ...system import System


class Dependence:
    """Dependence of variables on the knowns, as sets of bits: states, then inputs, time, parameters.

    Attributes:
        n_x, n_u: number of states and of inputs.
        parameters: bits of every parameter, those of dependent ones being what they depend on.
        starts: bits of the start value of every state: of a fixed one itself, of one that is computed its parameters;
            one that the initialization may move depends on all that is known then.
        roots: what each event indicator depends on, as `of`.
    """

    def __init__(self, system: System) -> None:
        low = system.lowered
        self.n_x, self.n_u = low.n_x, len(system.stages.flat.inputs)
        self.n_par, self.n_z = system.stages.flat.n_par, low.n_x + low.n_w
        self.parameters = self._parameters(system)
        self.straight: Straight = write_out(low)
        self.leaf: dict[int, int] = {k: 1 << k for k in range(self.n_x)}
        self._algebraic()
        known = self.straight.known
        bits = self._bits(known.values())
        self.variables = {v: bits[id(e)] for v, e in known.items()}
        self.slopes = [int(i) for i in low.dx_ids]
        self.starts = self._starts(system)
        forms = [] if system.statements is None else family_residuals(self.straight, system.statements.roots.families)
        bits = self._bits(forms)
        self.roots = [self._in_run(bits[id(e)]) for e in forms]

    def _parameters(self, system: System) -> list[int]:
        first = self.n_x + self.n_u + 1
        built_in = system.stages.flat.evaluated[: self.n_par]  # are in the equations and have no number
        rank = np.cumsum(~built_in) - 1
        bits = [0 if fixed else 1 << (first + int(k)) for k, fixed in zip(rank, built_in, strict=True)]
        for assignment in system.program.ordered:
            for target, row in zip(assignment.targets.tolist(), assignment.par_rows.tolist(), strict=True):
                bits[target] = _union(bits[k] for k in row)
        return bits

    def _starts(self, system: System) -> list[int]:
        given = Starts(system)
        computed: dict[int, int] = {}
        for assignment in system.stages.flat.start_assignments:
            for target, row in zip(assignment.targets.tolist(), assignment.par_rows.tolist(), strict=True):
                computed[target] = _union(self.parameters[k] for k in row)
        own = [1 << k if not given.computed[k] else computed[int(given.source[k])] for k in range(self.n_x)]
        inputs = ((1 << self.n_u) - 1) << self.n_x
        everything = inputs | _union(self.parameters) | _union(b for b, f in zip(own, given.fixed, strict=True) if f)
        return [b if f else everything for b, f in zip(own, given.fixed, strict=True)]

    def _algebraic(self) -> None:
        """Algebraic unknowns depend on what their equations do; those that share an equation, on the same."""
        shift = self.n_x + self.n_u + 1 + self.n_par
        for k in range(self.n_x, self.n_z):
            self.leaf[k] = 1 << (shift + k - self.n_x)
        groups: list[int] = []
        bits = self._bits(self.straight.residuals)
        for residual in self.straight.residuals:
            merged = bits[id(residual)]
            for other in [g for g in groups if (g & merged) >> shift]:
                groups.remove(other)
                merged |= other
            groups.append(merged)
        low = (1 << shift) - 1
        for k in range(self.n_x, self.n_z):
            self.leaf[k] = next((g & low for g in groups if g & self.leaf[k]), 0)

    def _bits(self, roots: Iterable[Expr]) -> dict[int, int]:
        """Bits of all nodes below `roots`."""
        roots = list(roots)
        for solve in self.straight.solves:
            found = self._through([*(e for line in solve.matrix for e in line), *solve.rhs])
            for target in solve.targets:
                self.leaf[target.value] = _union(found)
        return {id(e): b for e, b in zip(roots, self._through(roots), strict=True)}

    def _through(self, roots: list[Expr]) -> list[int]:
        bits: dict[int, int] = {}
        for node in postorder(roots):
            if node.args:
                bits[id(node)] = _union(bits[id(a)] for a in node.args)
            else:
                bits[id(node)] = self._of_leaf(node)
        return [bits[id(e)] for e in roots]

    def _of_leaf(self, node: Expr) -> int:
        if node.op == "time":
            return 1 << (self.n_x + self.n_u)
        if node.op == "var":
            return self.leaf[node.value]
        if node.op == "par" and node.value < self.n_par:
            return self.parameters[node.value]
        if node.op == "par" and node.value < self.n_par + self.n_u:
            return 1 << (self.n_x + node.value - self.n_par)
        return 0

    def of(self, variable: int) -> list[int]:
        """Knowns of a variable in a run: numbers of states, n_x + number of an input, n_x + n_u for time."""
        return self._in_run(self.variables[variable])

    def _in_run(self, bits: int) -> list[int]:
        return [k for k in range(self.n_x + self.n_u + 1) if bits >> k & 1]

    def at_start(self, bits: int) -> list[int]:
        """Knowns of a set of bits in the initialization: numbers as in `of`, n_x + n_u + 1 + number of a parameter."""
        time = self.n_x + self.n_u
        found = bits & ~((1 << self.n_x) - 1) & ~(1 << time)
        for k in range(self.n_x):
            if bits >> k & 1:
                found |= self.starts[k]
        return [k for k in range(time + 1 + self.n_par) if found >> k & 1]


def _union(bits: Iterable[int]) -> int:
    total = 0
    for b in bits:
        total |= b
    return total
