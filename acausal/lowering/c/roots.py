"""Tables of the functions whose change of sign is an event."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..hybrid import Hybrid
from ..lowered import Lowered
from .text import array


def root_tables(hybrid: Hybrid | None, lowered: Lowered) -> list[str]:
    """Slots and variables of these functions, and what ``modes.h`` needs to switch modes within a run."""
    first, variables, moving = [0], list[int](), list[int]()
    if hybrid is not None:
        for family, moves in zip(hybrid.roots.families, hybrid.moving_roots, strict=True):
            for row, row_moves in zip(family.var_rows.tolist(), moves.astype(int).tolist(), strict=True):
                variables += row
                moving += row_moves
                first.append(len(variables))
    nominal = lowered.nominal
    only_modes = hybrid is not None and hybrid.only_modes
    coupled = [int(v) for g in lowered.schedule.groups if g.kernel.size > 1 for v in g.unknowns.ravel()]
    return [
        f"#define AC_ONLY_MODES {int(only_modes)}", f"#define AC_COUPLED {len(coupled) if only_modes else 0}",
        array("int", "ac_root_slot", _list(hybrid.roots.slots if hybrid else ())),
        array("int", "ac_root_strict", _list(hybrid.roots.strict if hybrid else ())),
        array("int", "ac_root_first", first), array("int", "ac_root_variable", variables),
        array("int", "ac_root_moves", moving),
        array("double", "ac_root_nominal", [float(nominal[v]) for v in variables]),
        array("int", "ac_coupled", coupled if only_modes else []),
    ]  # fmt: skip


def _list(values: Any) -> list[int]:
    return np.asarray(values).astype(int).tolist()
