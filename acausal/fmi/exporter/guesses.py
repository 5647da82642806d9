"""The modes that hold at the start values, from which a unit begins to look for those that agree with its equations."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...lowering.c.emit import Writer
from ...lowering.c.straight import Straight, reduce_strength
from ...lowering.c.text import braces
from ...symbolic.expr import Expr, neg, par, var
from ...symbolic.traverse import substitute

if TYPE_CHECKING:
    from ...system import System


def guess_function(system: System) -> str:
    """C function that puts them into the slots of `p`, from start values `s` at time `t`.

    As in `simulate`: where several modes are consistent, as in what switches by positive feedback, start values choose.
    Where they say nothing (they are nan), a mode is 0.
    """
    problem, hybrid, n_p = system.initial, system.statements, system.lowered.n_p

    def leaf(node: Expr) -> str:
        if node.op == "time":
            return "t"
        return f"p[{node.value}]" if node.value < n_p else f"s[{node.value - n_p}]"

    lines: list[str] = []
    pieces = [] if hybrid is None else [p for follows in (False, True) for p, _ in hybrid.conditions(following=follows)]
    for piece in pieces:
        for row, slot in enumerate(piece.slots.tolist()):
            start: dict[Expr, Expr] = {}
            for i, v in enumerate(piece.rows.var_rows[row].tolist()):
                given = par(n_p + int(problem.start_source[v]))
                start[var(i)] = neg(given) if problem.start_sign[v] < 0 else given
            parameters = {par(i): par(k) for i, k in enumerate(piece.rows.par_rows[row].tolist())}
            form = reduce_strength((substitute(piece.forms[0], start | parameters),))[0]
            body = Writer(Straight(0, {}, []), leaf, None).function([("const double g", form)])
            lines.append("{ " + " ".join([*body, f"p[{slot}] = g < 0.0;"]) + " }")
    head = "static void fmu_guess(double t, const double *s, double *p)"
    return braces(head, ["(void)t, (void)s, (void)p;", *lines])
