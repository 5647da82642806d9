"""What index reduction divides by, where that is about to vanish: the steps end before it."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from ..language.template import Floats, Ints
from ..passes.structure import IndexReduced
from ..symbolic.differentiate import differentiate
from ..symbolic.expr import ONE, ZERO, Expr
from ..symbolic.traverse import evaluate, leaves, postorder

NEAR = 1e-3
"""A zero is near if it is within this part of the time that is left and has passed."""


def vanishing_divisor(index: IndexReduced, p: Floats, t: float, t1: float) -> list[str]:
    """Lines of a message on a factor that varies with time, by which combinations of equations are divided.

    Args:
        index: the equations.
        p: all parameters.
        t: last time of the run [s].
        t1: end of the run [s].
    """
    for family in index.families:
        if (int(family.source[0]), int(family.ordinal[0])) not in index.consumed:
            continue
        for factor in _divisors(family.residual):
            rate = differentiate((factor,), lambda leaf: ONE if leaf.op == "time" else ZERO)[0]
            for k, row in enumerate(family.par_rows):

                def leaf(node: Expr, row: Ints = row) -> np.float64:
                    return np.float64(t if node.op == "time" else p[row[node.value]])

                with np.errstate(all="ignore"):
                    value, slope = (float(v) for v in evaluate((factor, rate), leaf, np))
                    ahead = np.float64(-value) / slope
                if abs(ahead) <= NEAR * max(abs(t1 - t), abs(t)):
                    text = index.flat.equation_text(family, k, factor)
                    return [
                        f"Index reduction has combined equations and divides by `{text}`, which is zero at t = "
                        f"{t + ahead:.6g} s. If the equations have a solution there, write them so that what stands in "
                        "the place of this factor does not vanish."
                    ]
    return []


def _divisors(root: Expr) -> Iterator[Expr]:
    """Factors of denominators, of time and parameters only, that vary with time."""
    seen: set[int] = set()
    pending = [node.args[1] for node in postorder((root,)) if node.op == "div"]
    while pending:
        node = pending.pop()
        if id(node) in seen:
            continue
        seen.add(id(node))
        if node.op in ("mul", "neg", "pow"):
            pending += node.args
        elif "time" in (kinds := {leaf.op for leaf in leaves(node)}) and kinds <= {"time", "par"}:
            yield node
