"""Which states, inputs and time every variable depends on."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ...lowering.c.straight import Straight, write_out
from ...symbolic.expr import Expr
from ...symbolic.traverse import postorder

if TYPE_CHECKING:
    from ...system import System


class Dependence:
    """Dependence of expressions on the knowns, as sets of bits: states, then inputs, then time.

    Attributes:
        n_x, n_u: number of states and of inputs.
    """

    def __init__(self, system: System) -> None:
        low = system.lowered
        self.n_x, self.n_u = low.n_x, len(system.stages.flat.inputs)
        self.n_par, self.n_z = system.stages.flat.n_par, low.n_x + low.n_w
        self.straight: Straight = write_out(low)
        self.leaf: dict[int, int] = {k: 1 << k for k in range(self.n_x)}
        self._algebraic()
        known = self.straight.known
        bits = self._bits(known.values())
        self.variables = {v: bits[id(e)] for v, e in known.items()}
        self.slopes = [int(i) for i in low.dx_ids]

    def _algebraic(self) -> None:
        """Algebraic unknowns depend on what their equations do; those that share an equation, on the same."""
        shift = self.n_x + self.n_u + 1
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
            total = 0
            for b in found:
                total |= b
            for target in solve.targets:
                self.leaf[target.value] = total
        return {id(e): b for e, b in zip(roots, self._through(roots), strict=True)}

    def _through(self, roots: list[Expr]) -> list[int]:
        bits: dict[int, int] = {}
        for node in postorder(roots):
            if node.args:
                total = 0
                for a in node.args:
                    total |= bits[id(a)]
                bits[id(node)] = total
            else:
                bits[id(node)] = self._of_leaf(node)
        return [bits[id(e)] for e in roots]

    def _of_leaf(self, node: Expr) -> int:
        if node.op == "time":
            return 1 << (self.n_x + self.n_u)
        if node.op == "var":
            return self.leaf[node.value]
        if node.op == "par" and self.n_par <= node.value < self.n_par + self.n_u:
            return 1 << (self.n_x + node.value - self.n_par)
        return 0

    def of(self, variable: int) -> list[int]:
        """Knowns of a variable: numbers of states, n_x + number of an input, n_x + n_u for time."""
        bits = self.variables[variable]
        return [k for k in range(self.n_x + self.n_u + 1) if bits >> k & 1]
