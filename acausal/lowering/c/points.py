"""C of the tables over time: where each is read, how fast that moves, and its points."""

from __future__ import annotations

from itertools import accumulate

from ...symbolic.expr import Expr
from ..lowered import Lowered
from .emit import Writer
from .straight import Straight, reduce_strength
from .text import array, braces


def point_lines(lowered: Lowered) -> list[str]:
    """Sizes, arrays and the function ``ac_points`` of the tables over time."""
    tables = lowered.time_tables
    expressions = iter(reduce_strength([e for table in tables for e in (table.argument, table.slope)]))
    values = [(f"{name}[{k}]", next(expressions)) for k in range(len(tables)) for name in ("at", "slope")]
    head = "AC_UNUSED static void ac_points(const ac_model *m, double t, double *at, double *slope)"
    writer = Writer(Straight(0, {}, []), _leaf)
    return [
        f"#define AC_NT {len(tables)}",
        array("int", "ac_point_first", [0, *accumulate(len(table.points) for table in tables)]),
        array("double", "ac_point_x", [x for table in tables for x in table.points]),
        *([braces(head, writer.function(values))] if tables else []),
    ]


def _leaf(node: Expr) -> str:
    return "t" if node.op == "time" else f"m->p[{node.value}]"
