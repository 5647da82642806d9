"""Straight-line C from expressions: values, and on demand tangents in several directions at once.

A tangent is a short vector, one element a direction; the factors of the chain rule are expressions of the operator
table, computed once for all directions (Griewank and Walther 2008, Evaluating Derivatives, ch. 3.2). What only one
branch of a `where` needs is computed only if that branch is taken, where that saves anything.
"""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field

from ...symbolic.expr import ONE, Expr, div, mul, neg
from ...symbolic.operators import slope
from ...symbolic.traverse import postorder_missing
from .straight import Straight, reduce_strength
from .text import CONDITIONS, COST, number, value_text

WORTH = 15
"""Cost, in multiplications, from which the work for one branch is put behind a condition."""
LONGEST = 90
"""Characters up to which an expression that is used once is written where it is used."""

Guard = frozenset[tuple[int, bool]]
"""Conditions (task numbers) and which way each must be for a value to be needed."""


@dataclass(eq=False)
class Hoisted:
    """Expressions of parameters alone: computed once a run, and read from the array ``c``."""

    fixed: Callable[[Expr], bool]
    slots: dict[int, int] = field(default_factory=dict[int, int])
    nodes: list[Expr] = field(default_factory=list[Expr])
    _constant: dict[int, bool] = field(default_factory=dict[int, bool])
    _alive: list[Expr] = field(default_factory=list[Expr])

    def _mark(self, root: Expr) -> None:
        """Find out which nodes below `root` depend on parameters alone."""
        for node in postorder_missing([root], self._constant):
            leaf = node.op in ("const", "call") or (node.op == "par" and self.fixed(node))
            self._constant[id(node)] = all(self._constant[id(a)] for a in node.args) if node.args else leaf
            self._alive.append(node)

    def __call__(self, node: Expr) -> str | None:
        """Text of a hoisted node; None for others."""
        if not node.args:
            return None
        if id(node) not in self._constant:
            self._mark(node)
        if not self._constant[id(node)]:
            return None
        if id(node) not in self.slots:
            self.slots[id(node)] = len(self.nodes)
            self.nodes.append(node)
        return f"c[{self.slots[id(node)]}]"


@dataclass(eq=False)
class _Task:
    """One statement: the value or the tangent of a node, or the solution of a linear system."""

    kind: str
    node: Expr | None
    needs: list[tuple[int, tuple[int, bool] | None]]
    factors: list[tuple[int | None, int]] = field(default_factory=list[tuple[int | None, int]])
    solve: int = -1
    guard: Guard | None = None
    uses: int = 0
    text: str = ""


class Writer:
    """Writes the statements of one C function.

    Args:
        straight: where solved leaves come from.
        leaf: text of a leaf's value.
        tangent: text of a leaf's tangent, None where it is zero; without it there are no tangents.
        hoisted: expressions of parameters; None to write them out.
        labels: names of expressions, for comments.
    """

    def __init__(
        self,
        straight: Straight,
        leaf: Callable[[Expr], str],
        tangent: Callable[[Expr], str | None] | None = None,
        hoisted: Hoisted | None = None,
        labels: Mapping[int, str] | None = None,
    ) -> None:
        self.straight = straight
        self.leaf = leaf
        self.tangent = tangent
        self.hoisted = hoisted
        self.labels = labels or {}
        self.tasks: list[_Task] = []
        self.value_of: dict[int, int] = {}
        self.tangent_of: dict[int, int | None] = {}
        self.solve_of: dict[tuple[int, bool], int] = {}
        self.alive: list[Expr] = []
        self.reduced: dict[int, Expr] = {}

    # ---- building the graph of statements ---------------------------------------------------------
    def _values(self, roots: Iterable[Expr]) -> None:
        roots = list(roots)
        self.alive.extend(roots)
        pending = [(r, False) for r in reversed(roots)]
        while pending:
            node, ready = pending.pop()
            if id(node) in self.value_of:
                continue
            below = self._below(node)
            if not ready and below:
                pending.append((node, True))
                pending.extend((a, False) for a in reversed(below))
                continue
            self._add_value(node)

    def _below(self, node: Expr) -> list[Expr]:
        """What the value of a node needs."""
        if node.op == "var" and node.value in self.straight.maker:
            return self.straight.expressions(self.straight.maker[node.value])
        if self.hoisted is not None and self.hoisted(node) is not None:
            return []
        return list(node.args)

    def _add_value(self, node: Expr) -> None:
        task = _Task("v", node, [])
        if node.op == "var" and node.value in self.straight.maker:
            task.needs = [(self._solve(self.straight.maker[node.value], False), None)]
        elif node.args and (self.hoisted is None or self.hoisted(node) is None):
            condition = self.value_of[id(node.args[0])] if node.op == "where" else -1
            for i, a in enumerate(node.args):
                choice = (condition, i == 1) if node.op == "where" and i else None
                task.needs.append((self.value_of[id(a)], choice))
        self.value_of[id(node)] = len(self.tasks)
        self.tasks.append(task)

    def _solve(self, k: int, tangent: bool) -> int:
        """The statement that solves linear system `k`, or its tangent; what it needs exists already."""
        if (k, tangent) not in self.solve_of:
            task = _Task("s" if not tangent else "st", None, [], solve=k)
            for e in self.straight.expressions(k):
                task.needs.append((self.value_of[id(e)], None))
                moving = self.tangent_of.get(id(e)) if tangent else None
                if moving is not None:
                    task.needs.append((moving, None))
            earlier = self._same_factor(k)
            if earlier != k:
                task.needs.append((self._solve(earlier, False), None))
            if tangent:
                task.needs.append((self._solve(k, False), None))
            self.solve_of[k, tangent] = len(self.tasks)
            self.tasks.append(task)
        return self.solve_of[k, tangent]

    def _same_factor(self, k: int) -> int:
        return self.straight.solves[k].factor

    def _tangents(self, roots: Iterable[Expr]) -> None:
        """Tangents of `roots` and of all below."""
        roots = list(roots)
        self._values(roots)
        pending = [(r, False) for r in reversed(roots)]
        while pending:
            node, ready = pending.pop()
            if id(node) in self.tangent_of:
                continue
            below = self._below(node)
            if not ready and below:
                pending.append((node, True))
                pending.extend((a, False) for a in reversed(below))
                continue
            self._add_tangent(node)

    def _add_tangent(self, node: Expr) -> None:
        assert self.tangent is not None
        if node.op == "var" and node.value in self.straight.maker:
            k = self.straight.maker[node.value]
            moving = any(self.tangent_of[id(e)] is not None for e in self.straight.expressions(k))
            self._put_tangent(node, [(self._solve(k, True), None)] if moving else None)
        elif node.op == "const":
            self._put_tangent(node, None)
        elif not self._below(node):
            text = self.tangent(node) if not node.args else self._hoisted_tangent(node)
            self._put_tangent(node, None if text is None else [])
        elif node.op == "where":
            self._choice(node)
        else:
            moving = [(i, t) for i, a in enumerate(node.args) if (t := self.tangent_of[id(a)]) is not None]
            self._chain(node, moving)

    def _hoisted_tangent(self, node: Expr) -> str | None:
        return None if self.hoisted is None else f"d{self.hoisted(node)}"

    def _put_tangent(self, node: Expr, needs: list[tuple[int, tuple[int, bool] | None]] | None) -> None:
        if needs is None:
            self.tangent_of[id(node)] = None
            return
        self.tangent_of[id(node)] = len(self.tasks)
        self.tasks.append(_Task("t", node, needs))

    def _choice(self, node: Expr) -> None:
        condition, a, b = node.args
        da, db = self.tangent_of[id(a)], self.tangent_of[id(b)]
        if da is None and db is None:
            self.tangent_of[id(node)] = None
            return
        c = self.value_of[id(condition)]
        needs: list[tuple[int, tuple[int, bool] | None]] = [(c, None)]
        needs += [(d, (c, way)) for d, way in ((da, True), (db, False)) if d is not None]
        self._put_tangent(node, needs)

    def _chain(self, node: Expr, moving: list[tuple[int, int]]) -> None:
        factors: list[tuple[Expr | None, int]] = []
        for i, t in moving:
            rule = _factor(node, i)
            if rule is not None:
                factors.append((None if rule is ONE else self._reduced(rule), t))
        self._values(f for f, _ in factors if f is not None)
        if not factors:
            self.tangent_of[id(node)] = None
            return
        task = _Task("t", node, [])
        for f, t in factors:
            number_of_factor = None if f is None else self.value_of[id(f)]
            task.factors.append((number_of_factor, t))
            task.needs += [(t, None)] + ([] if number_of_factor is None else [(number_of_factor, None)])
        self.tangent_of[id(node)] = len(self.tasks)
        self.tasks.append(task)

    def _reduced(self, rule: Expr) -> Expr:
        self.alive.append(rule)
        reduced = reduce_strength((rule,), self.reduced)[0]
        self.alive.append(reduced)
        return reduced

    # ---- what is behind a condition ---------------------------------------------------------------
    def _guards(self, roots: list[int]) -> None:
        for r in roots:
            self.tasks[r].guard = frozenset()
            self.tasks[r].uses += 1
        for k in range(len(self.tasks) - 1, -1, -1):
            task = self.tasks[k]
            if task.guard is None:
                continue
            for need, choice in task.needs:
                given = task.guard if choice is None else task.guard | {choice}
                below = self.tasks[need]
                below.guard = given if below.guard is None else below.guard & given
                below.uses += 1
        self._drop_cheap()

    def _drop_cheap(self) -> None:
        cost: dict[tuple[int, bool], int] = {}
        for task in self.tasks:
            for pair in task.guard or ():
                size = COST.get(task.node.op, 1) if task.node is not None and task.node.args else 0
                cost[pair] = cost.get(pair, 0) + size
        worth = {pair for pair, c in cost.items() if c >= WORTH}
        for task in self.tasks:
            if task.guard:
                task.guard = task.guard & worth if task.solve < 0 else frozenset()
        # what a solve needs is needed always, and conditions must be there before what they guard
        for k in range(len(self.tasks) - 1, -1, -1):
            task = self.tasks[k]
            for need, choice in task.needs:
                below = self.tasks[need]
                if below.guard and task.guard is not None:
                    kept = task.guard if choice is None or choice not in worth else task.guard | {choice}
                    below.guard = below.guard & kept
            for condition, _ in task.guard or ():
                self.tasks[condition].guard = frozenset()
                self.tasks[condition].uses += 1

    # ---- text -------------------------------------------------------------------------------------
    def function(self, values: Iterable[tuple[str, Expr]], tangents: Iterable[tuple[str, Expr]] = ()) -> list[str]:
        """Statements that assign the values and the tangents of expressions to C lvalues."""
        values, tangents = list(values), list(tangents)
        self._values(e for _, e in values)
        self._tangents(e for _, e in tangents)
        outputs = [(target, self.value_of[id(e)]) for target, e in values]
        moving = [(target, self.tangent_of[id(e)]) for target, e in tangents]
        self._guards([k for _, k in outputs] + [k for _, k in moving if k is not None])
        lines = self._schedule()
        lines += [f"{target} = {self.tasks[k].text};" for target, k in outputs]
        lines += [f"{target} = {'ac_zero' if k is None else self.tasks[k].text};" for target, k in moving]
        return lines

    def _schedule(self) -> list[str]:
        """Statements in an order that respects what they need, those behind one condition together."""
        live = [k for k, task in enumerate(self.tasks) if task.guard is not None]
        waiting: dict[int, int] = {}
        users: dict[int, list[int]] = {}
        for k in live:
            needs = {n for n, _ in self.tasks[k].needs} | {c for c, _ in self.tasks[k].guard or ()}
            waiting[k] = len(needs)
            for n in needs:
                users.setdefault(n, []).append(k)
        queues: dict[Guard, list[int]] = {}
        for k in live:
            if not waiting[k]:
                heapq.heappush(queues.setdefault(self.tasks[k].guard or frozenset(), []), k)
        lines: list[str] = []
        here: Guard = frozenset()
        while queues:
            if here not in queues:
                here = frozenset() if frozenset() in queues else min(queues, key=lambda g: queues[g][0])
            block: list[tuple[str, str, str]] = []
            while here in queues:
                k = heapq.heappop(queues[here])
                if not queues[here]:
                    del queues[here]
                block.extend(self._statement(k))
                for user in users.get(k, ()):
                    waiting[user] -= 1
                    if not waiting[user]:
                        heapq.heappush(queues.setdefault(self.tasks[user].guard or frozenset(), []), user)
            lines.extend(self._block(here, block))
        return lines

    def _block(self, guard: Guard, block: list[tuple[str, str, str]]) -> list[str]:
        if not guard:
            return [f"{kind} {name} = {text};" if name else text for kind, name, text in block]
        if not block:
            return []
        terms = [("" if way else "!") + self.tasks[c].text for c, way in sorted(guard)]
        lines = [f"{kind.removeprefix('const ')} {name} = {_ZERO[kind]};" for kind, name, _ in block]
        lines.append(f"if ({' && '.join(terms)}) {{")
        lines += [f"    {name} = {text};" for _, name, text in block]
        return [*lines, "}"]

    def _statement(self, k: int) -> list[tuple[str, str, str]]:
        """Type, name and right-hand side of a statement; nothing where the text goes into its only user."""
        task = self.tasks[k]
        if task.kind in ("s", "st"):
            return [("", "", line) for line in self._solve_lines(task)]
        assert task.node is not None
        if task.kind == "t":
            text = self._tangent_text(task)
            if not self._below(task.node) or (task.node.op == "var" and task.node.value in self.straight.maker):
                task.text = text
                return []
            task.text = f"d{k}"
            return [("const ac_vector", task.text, text)]
        text, plain = self._value_text(task.node)
        if plain or (task.uses == 1 and len(text) <= LONGEST):
            task.text = text
            return []
        kind = "const int" if task.node.op in CONDITIONS else "const double"
        task.text = f"v{k}"
        label = self.labels.get(id(task.node))
        return [(kind, task.text, text + (f" /* {label} */" if label else ""))]

    def _value_text(self, node: Expr) -> tuple[str, bool]:
        """Text of a node's value, and whether it is as short as a name."""
        if node.op == "const":
            return number(node.value), True
        if node.op == "var" and node.value in self.straight.maker:
            solve = self.straight.solves[self.straight.maker[node.value]]
            place = next(i for i, t in enumerate(solve.targets) if t is node)
            return f"x{self.straight.maker[node.value]}[{place}]", True
        hoisted = self.hoisted(node) if self.hoisted is not None else None
        if hoisted is not None:
            return hoisted, True
        if not node.args and node.op != "call":
            return self.leaf(node), True
        return value_text(node, [self.tasks[self.value_of[id(a)]].text for a in node.args]), False

    def _tangent_text(self, task: _Task) -> str:
        node = task.node
        assert node is not None and self.tangent is not None
        if node.op == "var" and node.value in self.straight.maker:
            k = self.straight.maker[node.value]
            place = next(i for i, t in enumerate(self.straight.solves[k].targets) if t is node)
            return f"xd{k}[{place}]"
        if not self._below(node):
            text = self.tangent(node) if not node.args else self._hoisted_tangent(node)
            assert text is not None
            return text
        if node.op == "where":
            condition, a, b = node.args
            texts = [self._tangent_name(a), self._tangent_name(b)]
            return f"{self.tasks[self.value_of[id(condition)]].text} ? {texts[0]} : {texts[1]}"
        terms: list[str] = []
        for f, t in task.factors:
            factor = "" if f is None else self.tasks[f].text + " * "
            terms.append(f"{factor}{self.tasks[t].text}")
        return "(" + " + ".join(terms) + ")"

    def _tangent_name(self, node: Expr) -> str:
        t = self.tangent_of[id(node)]
        return "ac_zero" if t is None else self.tasks[t].text

    def _solve_lines(self, task: _Task) -> list[str]:
        k, solve = task.solve, self.straight.solves[task.solve]
        m, factor = len(solve.rhs), self._same_factor(task.solve)
        lines: list[str] = []

        def text(e: Expr) -> str:
            return self.tasks[self.value_of[id(e)]].text

        if task.kind == "s":
            if solve.matrix:
                flat = ", ".join(text(e) for line in solve.matrix for e in line)
                lines += [
                    f"double a{k}[{m * m}] = {{{flat}}}, f{k}[{m * m}];",
                    f"int q{k}[{m}];",
                    f"memcpy(f{k}, a{k}, sizeof f{k});",
                    f"ac_dense_factor({m}, f{k}, q{k});",
                ]
            lines.append(f"double x{k}[{m}] = {{{', '.join(text(e) for e in solve.rhs)}}};")
            if solve.matrix:
                lines.append(f"ac_dense_solve_refined({m}, a{k}, f{k}, q{k}, x{k});")
            else:
                lines.append(f"ac_dense_solve({m}, f{factor}, q{factor}, x{k});")
            return lines
        matrix = self.straight.solves[factor].matrix
        entries: list[str] = []
        for i, e in enumerate(solve.rhs):
            terms = [self._tangent_name(e)]
            for j, entry in enumerate(matrix[i]):
                if self.tangent_of.get(id(entry)) is not None:
                    terms.append(f"x{k}[{j}] * {self._tangent_name(entry)}")
            entries.append(" - ".join(terms))
        lines.append(f"ac_vector xd{k}[{m}] = {{{', '.join(entries)}}};")
        lines.append(f"ac_dense_solve_vector({m}, f{factor}, q{factor}, xd{k});")
        return lines


_ZERO = {"const double": "0.0", "const int": "0", "const ac_vector": "ac_zero"}


def _factor(node: Expr, i: int) -> Expr | None:
    """Factor of operand `i`'s tangent; None where it is zero."""
    if node.op == "add":
        return ONE
    if node.op == "div":
        reciprocal = div(ONE, node.args[1])
        return reciprocal if i == 0 else neg(mul(node, reciprocal))
    return slope(node, i)
