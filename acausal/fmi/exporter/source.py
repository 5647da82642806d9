"""The C sources of an FMU: equations, tables, and the fixed files of the interface."""

from __future__ import annotations

from collections.abc import Sequence
from importlib.resources import files
from typing import TYPE_CHECKING

import numpy as np

from ...lowering.c.generate import EXPLICIT, runtime_files, to_c
from ...lowering.c.text import array
from ...lowering.initial import EASE_ALGEBRAIC
from ...simulation.native_library import METHODS
from .events import event_families, event_tables
from .guesses import guess_function
from .variables import ExportError, FmuVariable, Place, Starts

if TYPE_CHECKING:
    from ...system import System

LARGEST = 20_000
"""Operations up to which a model is written out in C."""
FIXED = ("instance.h", "hybrid.h", "values.h", "advance.h", "directional.h")
KINDS = ("me", "cs")
SOLVERS = METHODS
"""Methods of co-simulation; the position is the number in ``instance.h``."""


def equations(system: System, solver: str) -> str:
    """The equations in C, with tangents of all variables, and the method.

    Raises:
        ExportError: the model is too large to be written out.
        NotInC: the model calls Python functions.
    """
    from ...simulation.native import operations

    size = operations(system.lowered)
    if size > LARGEST:
        raise ExportError(
            f"`{system.name}` has {size} operations; models of up to {LARGEST} can be exported. Split it, for example "
            "with acausal.fmi.split, and export the parts."
        )
    flat = system.stages.flat

    def label(v: int) -> str:
        return flat.name(v) if v < flat.n_total else ""

    hybrid = system.statements
    further = {"ac_event_values": event_families(hybrid)}
    made = to_c(system.program, system.initial, label, hybrid=hybrid, further=further, observe_tangent=True)
    return made.text if solver == SOLVERS[0] else f"#define {EXPLICIT}\n{made.text}"


def tables(
    system: System, table: Sequence[FmuVariable], kinds: Sequence[str], solver: str, dt: float | None
) -> str:
    """Sizes, arrays and the method of ``instance.h``, to stand behind the equations."""
    starts, flat, low = Starts(system), system.stages.flat, system.lowered
    state = {int(v): k for k, v in enumerate(starts.ids[: starts.n_x])}
    wanted = len(starts.ids) - starts.n_x - starts.n_w
    mask = sum(1 << KINDS.index(k) for k in kinds)
    low_bounds, high_bounds = np.full(system.program.n_p, -np.inf), np.full(system.program.n_p, np.inf)
    for v in table:
        if v.place is Place.PARAMETER:
            low_bounds[v.index] = -np.inf if v.minimum is None else v.minimum
            high_bounds[v.index] = np.inf if v.maximum is None else v.maximum
    ease = np.concatenate([system.initial.ease, EASE_ALGEBRAIC * low.w_nominal])
    lines = [
        f"#define AC_NS {len(flat.start)}", f"#define FMU_VARIABLES {len(table)}",
        f"#define FMU_STARTS {len(starts.ids)}", f"#define FMU_WANTED {wanted}",
        f"#define FMU_KINDS {mask}", f'#define FMU_NAME "{system.name}"',
        f"#define FMU_SOLVER {SOLVERS.index(solver)}", f"#define FMU_DT {0.0 if dt is None else dt!r}",
        array("unsigned char", "fmu_kind", [int(v.place) for v in table]),
        array("int", "fmu_index", [v.index for v in table]),
        array("signed char", "fmu_sign", [v.sign for v in table]),
        array("int", "fmu_start", [v.slot for v in table]),
        array("int", "fmu_state_number", [
            state.get(v.index, -1) if v.place is Place.VARIABLE else -1 for v in table
        ]),
        array("int", "fmu_slope_of", low.dx_ids.tolist()),
        array("double", "fmu_default", system.program.default.tolist()),
        array("double", "fmu_low", low_bounds.tolist()), array("double", "fmu_high", high_bounds.tolist()),
        array("double", "fmu_base_start", flat.start.tolist()),
        array("double", "fmu_start_value", starts.value.tolist()),
        array("int", "fmu_start_source", starts.source.tolist()),
        array("signed char", "fmu_start_sign", starts.sign.tolist()),
        array("unsigned char", "fmu_fixed", starts.fixed.astype(int).tolist()),
        array("double", "fmu_ease", ease.tolist()),
        *event_tables(system), guess_function(system),
    ]  # fmt: skip
    return "\n".join(lines) + "\n"


def fixed_files(version: str) -> dict[str, str]:
    """The files that are the same for all models, by name."""
    own = files("acausal.fmi.exporter") / "c"
    major = version[0]
    names = (*FIXED, f"fmi{major}_types.h", f"fmi{major}.c")
    return runtime_files() | {n: (own / n).read_text(encoding="utf-8") for n in names}
