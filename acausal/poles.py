"""Poles that a run has passed: a denominator that has changed its sign in equations which determine what is in it.

Such equations have another branch of solutions beyond the pole, as ``h + b == k / h`` for h below zero. No solution
passes from one to the other, but a step does where all that happens at the pole is below the tolerances: it solves the
equations on either side.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import SimulationError
from .language.template import Floats, Ints
from .passes.schedule import Group, Kernel
from .symbolic.expr import ONE, Expr
from .symbolic.traverse import evaluate, leaves

if TYPE_CHECKING:
    from .simulation.solution import Solution
    from .system import System

SHOWN = 4
"""Equations that a message names."""
NOISE = 1e-9
"""Denominators below this fraction of their largest value are rounding."""


def check_poles(solution: Solution, values: Callable[[Ints], Floats]) -> None:
    """Check a solution with concrete values between its points, but for where an event lies between them.

    Args:
        solution: of one run.
        values: of the variables with these numbers at the points of the solution, (n_t, n).

    Raises:
        SimulationError: a pole has been passed; names the time, what divides and the equations.
    """
    t = np.asarray(solution.t, float)
    found = _dividing(solution.system)
    if len(t) < 2 or not found:
        return
    between = _quiet(solution, t)
    for group, quotients in found:
        leaf = _leaves(solution, values, group)
        for a, b in quotients:
            with np.errstate(all="ignore"):
                above, below = (np.broadcast_to(v, (group.size, len(t))) for v in evaluate((a, b), leaf, np))
                size = np.abs(below)
                passed = (below[:, :-1] * below[:, 1:] < 0.0) & (above[:, :-1] * above[:, 1:] > 0.0)
                passed &= np.minimum(size[:, :-1], size[:, 1:]) > NOISE * size.max(axis=1, keepdims=True)
            row, k = np.unravel_index(int(np.argmax(passed & between)), passed.shape)
            if passed[row, k] and between[k]:
                raise SimulationError(_text(solution, group, int(row), float(t[k]), float(t[k + 1]), b))


def _dividing(system: System) -> list[tuple[Group, list[tuple[Expr, Expr]]]]:
    """The blocks that have quotients which may have poles; found once for a system."""
    if "dividing" not in system.cache:
        schedule = system.stages.schedule
        found = [(group, _quotients(group.kernel)) for group in schedule.groups if group.kernel.iterates]
        n_par = schedule.reduced.flat.n_par
        kept = [(group, [q for q in quotients if _constant(q, group, n_par)]) for group, quotients in found]
        system.cache["dividing"] = [(group, quotients) for group, quotients in kept if quotients]
    return system.cache["dividing"]


def _quotients(kernel: Kernel) -> list[tuple[Expr, Expr]]:
    """Numerators and denominators in a block, where an unknown of the block is in the denominator.

    Not those below other functions: a condition may keep a denominator from zero, and what is infinite may be bounded.
    """
    found: dict[int, tuple[Expr, Expr]] = {}
    seen: set[int] = set()
    pending = [*(e for _, e in kernel.steps), *kernel.residuals]
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        if node.op in ("add", "neg", "mul", "div"):
            pending += node.args
        above, below = (node.args[0], node.args[1]) if node.op == "div" else (ONE, _odd_inverse(node))
        if below is not None and any(leaf.op == "var" and leaf.value < kernel.size for leaf in leaves(below)):
            found[id(node)] = above, below
    return list(found.values())


def _odd_inverse(node: Expr) -> Expr | None:
    if node.op != "pow" or node.args[1].op != "const":
        return None
    exponent = node.args[1].value
    return node.args[0] if exponent < 0.0 and exponent % 2.0 == 1.0 else None


def _constant(quotient: tuple[Expr, Expr], group: Group, n_par: int) -> bool:
    """Whether it holds nothing that changes at events or is an input."""
    columns = [leaf.value for leaf in leaves(*quotient) if leaf.op == "par"]
    return bool((group.par_rows[:, columns] < n_par).all())


def _leaves(solution: Solution, values: Callable[[Ints], Floats], group: Group) -> Any:
    """Values of leaves, (blocks, points)."""
    ids, places = np.unique(group.var_rows, return_inverse=True)
    table = np.asarray(values(ids), float).T[places.reshape(group.var_rows.shape)]
    p = np.asarray(solution.p[0] if isinstance(solution.p, tuple) else solution.p, float)
    t = np.asarray(solution.t, float)

    def leaf(node: Expr) -> Any:
        if node.op == "time":
            return t
        return p[group.par_rows[:, node.value], None] if node.op == "par" else table[:, node.value]

    return leaf


def _quiet(solution: Solution, t: Floats) -> Any:
    """Between which points of the result there is no event, (n_t - 1,)."""
    events = np.array([float(event.t) for event in solution.events])
    first = np.searchsorted(events, t[:-1], side="left")
    return first == np.searchsorted(events, t[1:], side="right")


def _text(solution: Solution, group: Group, row: int, before: float, after: float, below: Expr) -> str:
    schedule = solution.system.stages.schedule
    reduced = schedule.reduced
    rows = [reduced.rows.locate(int(r)) for r in group.equations[row, :SHOWN]]
    lines = "\n".join(f"    {reduced.flat.equation_line(*r)}" for r in rows)
    inside = [int(group.var_rows[row, leaf.value]) for leaf in leaves(below) if leaf.op == "var"]
    names = ", ".join(f"`{reduced.name(v)}`" for v in inside if v in group.unknowns[row])
    return (
        f"Between t = {before:.9g} and {after:.9g} s a step has passed a pole: what divides in these equations changes "
        f"its sign with {names}, and the values beyond are another solution of them.\n{lines}\n"
        "Try: a smaller `rtol`, and the `nominal` of what becomes that small."
    )
