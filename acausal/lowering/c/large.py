"""The C file of a large system: sizes, kernels, loops; the index rows go beside it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ...dae.coloring import color_columns
from ..sparsity import condition_pattern
from .factor import plan_factors
from .families import Families, factor_tables, functions
from .points import point_lines
from .tableau import tableau_lines
from .text import array, braces

if TYPE_CHECKING:
    from ..hybrid import Hybrid
    from ..lowered import Lowered


def large_file(lowered: Lowered, n_par: int, n_inputs: int, hybrid: Hybrid | None = None) -> tuple[str, list[Any]]:
    """C text, and the tables that the compiled code is given."""
    roots = None if hybrid is None else hybrid.roots
    families = Families(lowered, n_par, n_inputs)
    own, along = functions(families, roots)
    pattern = families.pattern
    coo = pattern.tocoo()
    n = pattern.shape[0]
    numbered = sparse.csr_matrix((np.arange(coo.nnz) + 1, (coo.row, coo.col)), shape=(n, n))
    numbered.data = numbered.data - 1
    plan = plan_factors(numbered, np.arange(n) < lowered.n_x)
    tables = families.tables
    colors = int(families.color.max(initial=-1)) + 1
    bound = condition_pattern(lowered)[lowered.n_w :].tocoo()
    g_color = np.asarray(color_columns(bound.tocsr()), np.int64)
    sizes = {
        "AC_N": n, "AC_NX": lowered.n_x, "AC_NZ": coo.nnz, "AC_NF": plan.size, "AC_NC": 0, "AC_NU": n_inputs,
        "AC_NPAR": n_par, "AC_NP": lowered.n_p, "AC_NG": lowered.n_g, "AC_NGZ": bound.nnz,
        "AC_G_COLORS": int(g_color.max(initial=-1)) + 1, "AC_NI": 0, "AC_NIZ": 0, "AC_NK": 0, "AC_NKZ": 0,
        "AC_NALL": lowered.n_ids, "AC_ONLY_MODES": 0, "AC_NR": 0 if roots is None else roots.count, "AC_COLORS": colors,
        "AC_LU_SIZE": len(plan.indices),
    }  # fmt: skip
    places = {
        "AC_COLOR_TABLE": families.color, "AC_ROW_TABLE": coo.row, "AC_COLUMN_TABLE": coo.col,
        "AC_G_COLOR_TABLE": g_color, "AC_G_ROW_TABLE": bound.row, "AC_G_COLUMN_TABLE": bound.col,
    }  # fmt: skip
    if roots is not None:
        places |= {"AC_ROOT_SLOT_TABLE": roots.slots, "AC_ROOT_STRICT_TABLE": roots.strict}
    head = ["#define AC_FAMILIES 1", *(f"#define {name} {value}" for name, value in sizes.items())]
    for name, values in places.items():
        tables.add(values)
        head.append(f"#define {name} {len(tables.arrays) - 1}")
    head += factor_tables(plan, tables)
    head += [
        "#define ac_row (w->m.index[AC_ROW_TABLE])", "#define ac_column (w->m.index[AC_COLUMN_TABLE])",
        "#define ac_g_row (w->m.index[AC_G_ROW_TABLE])", "#define ac_g_column (w->m.index[AC_G_COLUMN_TABLE])",
        "#define ac_nominal (w->m.nominal)", "#define ac_root_slot (w->m.index[AC_ROOT_SLOT_TABLE])",
        "#define ac_root_strict (w->m.index[AC_ROOT_STRICT_TABLE])",
    ]  # fmt: skip
    constants = "static void ac_constants(const double *p, double *c) { (void)p; (void)c; }"
    constants_along = braces(
        "static void ac_constants_tangent(const double *p, const ac_vector *dp, ac_vector *dc)",
        ["(void)p; (void)dp; (void)dc;"],
    )
    none = [array("int", "ac_k_row", []), array("int", "ac_k_column", []), array("double", "ac_k_value", [])]
    parts = [
        *head, '#include "acausal.h"', *none, *tableau_lines(), constants, *own,
        *point_lines(lowered), "#ifdef AC_TANGENTS", constants_along,
        *along, "#endif", '#include "families.h"', '#include "solver.h"',
    ]  # fmt: skip
    return "\n".join(parts) + "\n", tables.arrays
