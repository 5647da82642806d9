"""The schedule as straight-line code: every variable as an expression of time, unknowns and parameters.

For systems small enough to be written out. What a block needs is put in its place, so the whole right-hand side is one
DAG whose common subexpressions are shared; only linear systems that are solved numerically stay steps of their own.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from ...errors import StructureError
from ...language.flat_model import Family
from ...symbolic.expr import ONE, ZERO, Expr, add, const, make, mul, neg, par, power, var
from ...symbolic.jacobian import Row, sparse_jacobian
from ...symbolic.traverse import leaves, postorder, postorder_missing, substitute

if TYPE_CHECKING:
    from ...passes.schedule import Group, Schedule
    from ..lowered import Lowered

TIME_COLUMN = -1
"""Column of the derivatives with respect to time."""


@dataclass(frozen=True, slots=True, eq=False)
class Solve:
    """``matrix @ targets == rhs``, solved numerically.

    Attributes:
        factor: number of the matrix; several right-hand sides share its factors.
        matrix: rows of expressions; empty where an earlier `Solve` with this `factor` has it.
        rhs: right-hand side.
        targets: leaves that stand for the solution.
    """

    factor: int
    matrix: tuple[tuple[Expr, ...], ...]
    rhs: tuple[Expr, ...]
    targets: tuple[Expr, ...]


@dataclass(eq=False)
class Straight:
    """A system written out.

    The leaves are ``var(k)``: element k of z = (x, w), or from ``n_z`` on an element solved for; ``par(k)``; time.

    Attributes:
        n_z: number of unknowns of the solver.
        known: expression of every variable of the reduced model that the schedule computes.
        residuals: of the iterated equations, in the order of w.
        solves: numerical solutions of linear systems, in order.
        maker: number of the `Solve` that finds a leaf.
    """

    n_z: int
    known: dict[int, Expr]
    residuals: list[Expr]
    solves: list[Solve] = field(default_factory=list[Solve])
    maker: dict[int, int] = field(default_factory=dict[int, int])
    rows: dict[int, Row] = field(default_factory=dict[int, Row])

    def add_solve(self, factor: int, matrix: tuple[tuple[Expr, ...], ...], rhs: tuple[Expr, ...]) -> tuple[Expr, ...]:
        """A further linear system; returns the leaves of its solution."""
        first = self.n_z + len(self.maker)
        targets = tuple(var(first + i) for i in range(len(rhs)))
        for target in targets:
            self.maker[target.value] = len(self.solves)
        self.solves.append(Solve(factor, matrix, rhs, targets))
        return targets

    def needed(self, roots: Iterable[Expr]) -> list[int]:
        """Numbers of the solves that `roots` need, in order."""
        found: set[int] = set()
        pending = list(roots)
        while pending:
            new = {self.maker[leaf.value] for leaf in leaves(*pending, op="var") if leaf.value in self.maker} - found
            found |= new
            pending = [e for k in new for e in self.expressions(k)]
        return sorted(found)

    def expressions(self, k: int) -> list[Expr]:
        """What solve `k` needs."""
        solve = self.solves[k]
        shared = next(s for s in self.solves if s.factor == solve.factor)
        return [*(e for line in shared.matrix for e in line), *solve.rhs, *(shared.targets if not solve.matrix else ())]

    # ---- derivatives ------------------------------------------------------------------------------
    def jacobian(self, roots: Iterable[Expr], slopes: dict[int, Expr]) -> list[Row]:
        """Derivatives of `roots` with respect to z, and to time in the column `TIME_COLUMN`.

        Args:
            roots: expressions.
            slopes: rate of each input, by its number as a parameter.
        """
        roots = list(roots)
        for k in self.needed(roots):
            if self.solves[k].matrix and self.solves[k].targets[0].value not in self.rows:
                self._differentiate(k, slopes)
        return sparse_jacobian(roots, lambda leaf: self._seed(leaf, slopes))

    def _seed(self, leaf: Expr, slopes: dict[int, Expr]) -> Row:
        if leaf.op == "time":
            return {TIME_COLUMN: ONE}
        if leaf.op == "par":
            slope = slopes.get(leaf.value)
            return {} if slope is None else {TIME_COLUMN: slope}
        if leaf.value < self.n_z:
            return {leaf.value: ONE}
        return self.rows.get(leaf.value, {})

    def _differentiate(self, k: int, slopes: dict[int, Expr]) -> None:
        """Derivatives of a solution: ``A dx = db - dA x``, one more right-hand side for each column."""
        solve = self.solves[k]
        m = len(solve.rhs)
        flat = [e for line in solve.matrix for e in line]
        rows = sparse_jacobian([*flat, *solve.rhs], lambda leaf: self._seed(leaf, slopes))
        columns = sorted({c for row in rows for c in row})
        found: list[dict[int, Expr]] = [{} for _ in solve.targets]
        for c in columns:
            rhs = tuple(
                add(
                    rows[m * m + i].get(c, ZERO),
                    *(neg(mul(rows[m * i + j].get(c, ZERO), solve.targets[j])) for j in range(m)),
                )
                for i in range(m)
            )
            for i, leaf in enumerate(self.add_solve(solve.factor, (), rhs)):
                found[i][c] = leaf
        for target, row in zip(solve.targets, found, strict=True):
            self.rows[target.value] = row


def write_out(lowered: Lowered) -> Straight:
    """The whole schedule as one DAG."""
    schedule = lowered.schedule
    known = {int(v): var(k) for k, v in enumerate([*schedule.states.tolist(), *schedule.tears.tolist()])}
    straight = Straight(len(known), known, [])
    for group in schedule.groups:
        for row in range(group.size):
            try:
                _block(straight, group, row)
            except ZeroDivisionError as error:
                raise StructureError(_vanishing(schedule, group, row)) from error
    return straight


def _vanishing(schedule: Schedule, group: Group, row: int) -> str:
    """The message for a block that divides by what is zero wherever the blocks before it hold."""
    reduced = schedule.reduced
    names = ", ".join(f"`{reduced.name(int(v))}`" for v in group.unknowns[row])
    lines: list[str] = []
    for number in group.equations[row].tolist():
        family, k = reduced.rows.locate(number)
        component, place = reduced.flat.equation_place(family, k)
        lines.append(f"    {reduced.flat.equation_text(family, k):<48} {component or '(model)'}  {place}")
    return "\n".join([
        f"`{reduced.flat.model_name}` is singular: {names} cannot be found from these equations, whose factors are "
        "zero wherever the other equations hold:",
        *lines, "Try: look at the equations of the factors that become zero; is one of them wrong, or one too many?",
    ])  # fmt: skip


def _block(straight: Straight, group: Group, row: int) -> None:
    """One block of equations."""
    kernel, ids = group.kernel, group.var_rows[row].tolist()
    names: dict[Expr, Expr] = {par(i): par(p) for i, p in enumerate(group.par_rows[row].tolist())}
    names |= {var(i): straight.known[v] for i, v in enumerate(ids) if i >= kernel.size or v in straight.known}
    if kernel.matrix:
        matrix = tuple(tuple(substitute(e, names) for e in line) for line in kernel.matrix)
        rhs = tuple(substitute(e, names) for e in kernel.rhs)
        factor = len(straight.solves)
        for u, leaf in zip(kernel.tears, straight.add_solve(factor, matrix, rhs), strict=True):
            straight.known[ids[u]] = names[var(u)] = leaf
    for u, expression in kernel.steps:
        straight.known[ids[u]] = names[var(u)] = substitute(expression, names)
    straight.residuals.extend(substitute(r, names) for r in kernel.residuals)


def family_residuals(straight: Straight, families: Iterable[Family]) -> list[Expr]:
    """Residuals of further equations."""
    out: list[Expr] = []
    for family in families:
        for ids, pars in zip(family.var_rows.tolist(), family.par_rows.tolist(), strict=True):
            names = {var(i): straight.known[v] for i, v in enumerate(ids)}
            out.append(substitute(family.residual, {**names, **{par(i): par(p) for i, p in enumerate(pars)}}))
    return out


def reduce_strength(roots: Iterable[Expr], memo: dict[int, Expr] | None = None) -> list[Expr]:
    """Powers with exponents that are multiples of 1/4 as products and square roots; factors 0 and 1 into choices.

    Args:
        roots: expressions.
        memo: what was found by node identity; given, it is extended. The caller keeps the nodes alive.
    """
    roots = list(roots)
    memo = {} if memo is None else memo
    for node in postorder_missing(roots, memo):
        args = tuple(memo[id(a)] for a in node.args)
        same = all(a is b for a, b in zip(args, node.args, strict=True))
        memo[id(node)] = _cheaper(node if same else make(node.op, args, node.value))
    return [memo[id(root)] for root in roots]


def _cheaper(node: Expr) -> Expr:
    if node.op == "pow" and node.args[1].op == "const":
        return _power(node.args[0], node.args[1].value)
    if node.op == "mul":
        a, b = node.args
        if a.op != "where" and b.op == "where":
            a, b = b, a
        if a.op == "where" and (a.args[1] is ZERO or a.args[2] is ZERO):
            condition, yes, no = a.args
            return make("where", (condition, mul(yes, b), mul(no, b)))
    return node


def _power(x: Expr, exponent: float) -> Expr:
    quarters = 4.0 * exponent
    if quarters != int(quarters) or abs(exponent) > 16:
        return power(x, const(exponent))
    size, whole = abs(int(quarters)), abs(int(quarters)) // 4
    factors: list[Expr] = []
    if size % 4:
        root = make("sqrt", (x,))
        quarter = make("sqrt", (root,)) if size % 2 else None
        factors += [root] if size % 4 >= 2 else []
        factors += [quarter] if quarter is not None else []
    factors += [_integer_power(x, whole)] if whole else []
    product = factors[0]
    for f in factors[1:]:
        product = mul(product, f)
    return product if exponent > 0 else make("div", (ONE, product))


def _integer_power(x: Expr, n: int) -> Expr:
    """By repeated squaring."""
    result: Expr | None = None
    square = x
    while n:
        if n & 1:
            result = square if result is None else mul(result, square)
        square = mul(square, square) if n > 1 else square
        n >>= 1
    assert result is not None
    return result


def count_nodes(straight: Straight) -> int:
    """Size of the written-out system."""
    return len(postorder([*straight.known.values(), *straight.residuals]))
