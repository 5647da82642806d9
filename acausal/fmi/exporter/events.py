"""What a unit needs for its events: the expressions of ``ac_event_values``, and the tables of ``hybrid.h``."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from ...language.flat_model import Bools, Family
from ...language.template import Ints
from ...lowering.c.text import array
from ...lowering.hybrid import Hybrid, Piece
from ...lowering.levels import levels
from ...symbolic.expr import Expr
from ...symbolic.traverse import leaves
from .variables import ExportError

if TYPE_CHECKING:
    from ...system import System


def event_families(hybrid: Hybrid | None) -> list[Family]:
    """Expressions of ``ac_event_values``, in its order."""
    if hybrid is None:
        return []
    out = [_form(piece, piece.forms[0]) for piece in (*hybrid.floors, *hybrid.pres)]
    for piece in hybrid.triggers:
        out += [_form(piece, form, row) for row in range(piece.rows.size) for form in piece.forms]
    pairs = [item.piece for item in hybrid.reinits]
    for piece in pairs:
        out += [_form(piece, form, row) for row in range(piece.rows.size) for form in piece.forms]
    out += [_form(piece, piece.forms[0]) for piece in (item.piece for item in hybrid.asserts)]
    out += [_form(piece, piece.forms[0]) for piece, _ in hybrid.ends]
    for piece in hybrid.samples:
        out += [_form(piece, form, row) for row in range(piece.rows.size) for form in piece.forms]
    return out


def _form(piece: Piece, form: Expr, row: int | None = None) -> Family:
    rows = piece.rows if row is None else piece.rows.select(slice(row, row + 1))
    return Family(form, rows.var_rows, rows.par_rows, rows.source, rows.ordinal)


def event_tables(system: System) -> list[str]:
    """Sizes and arrays of ``hybrid.h``.

    Raises:
        ExportError: a variable that is no state is reinitialized.
    """
    hybrid, low = system.statements, system.lowered
    slots = system.stages.flat.slots
    states = low.schedule.states
    sizes = dict.fromkeys(("FLOORS", "PRES", "CONDITIONS", "REINITS", "ASSERTS", "ENDS", "SAMPLES"), 0)
    numbers: dict[str, list[int]] = {
        name: [] for name in (
            "floor_slot", "pre_slot", "pre_source", "pre_sign", "pre_of_states", "condition_slot", "reinit_state",
            "reinit_sign", "sample_slot", "assert_fatal", "root_follows",
        )
    }  # fmt: skip
    texts: dict[str, list[str]] = {"slot_text": [], "assert_text": [], "end_text": []}
    scale: list[float] = []
    if hybrid is not None:
        numbers["floor_slot"] = _slots(hybrid.floors)
        numbers["pre_slot"] = _slots(hybrid.pres)
        numbers["pre_source"], numbers["pre_sign"] = _pre_sources(system, hybrid)
        numbers["pre_of_states"] = [int(of) for piece in hybrid.pres for of in _of_states(piece, states, hybrid.first)]
        numbers["condition_slot"] = [s for piece in hybrid.triggers for s in piece.slots.tolist() for _ in piece.forms]
        numbers["sample_slot"] = _slots(hybrid.samples)
        numbers["reinit_state"], numbers["reinit_sign"] = _reinits(system, hybrid)
        numbers["assert_fatal"] = [
            int(item.level == "error") for item in hybrid.asserts for _ in range(item.piece.rows.size)
        ]
        texts["assert_text"] = [
            f"{hybrid.flat.equation_place(item.piece.rows, i)[0] or system.name}: {item.message}"
            for item in hybrid.asserts for i in range(item.piece.rows.size)
        ]  # fmt: skip
        texts["end_text"] = [message for p, message in hybrid.ends for _ in range(p.rows.size)]
        texts["slot_text"] = [hybrid.flat.slot_text(hybrid.first + k) for k in range(slots.count)]
        scale = _scales(system, hybrid)
        follows = {
            s: int(follows)
            for piece, follows in zip(hybrid.relations, hybrid.following, strict=True) for s in piece.slots.tolist()
        }  # fmt: skip
        numbers["root_follows"] = [follows.get(s, 0) for s in hybrid.roots.slots.tolist()]
    counts = {
        "FLOORS": "floor_slot", "PRES": "pre_slot", "CONDITIONS": "condition_slot", "REINITS": "reinit_state",
        "ASSERTS": "assert_fatal", "SAMPLES": "sample_slot",
    }  # fmt: skip
    sizes |= {name: len(numbers[of]) for name, of in counts.items()} | {"ENDS": len(texts["end_text"])}
    return [
        f"#define FMU_SLOTS {slots.count}", f"#define FMU_INITIAL ({slots.initial})",
        f"#define FMU_TERMINAL ({slots.terminal})", *(f"#define FMU_{name} {n}" for name, n in sizes.items()),
        *(array("int", f"fmu_{name}", values) for name, values in numbers.items()),
        array("double", "fmu_root_scale", scale),
        array("int", "fmu_level", levels(low)[states].tolist()),
        array("unsigned char", "fmu_is_mode", [int(kind == "relation") for kind in slots.kinds]),
        *(_texts(f"fmu_{name}", values) for name, values in texts.items()),
    ]  # fmt: skip


def _slots(pieces: Iterable[Piece]) -> list[int]:
    return [s for piece in pieces for s in piece.slots.tolist()]


def _of_states(piece: Piece, states: Ints, first_slot: int) -> Bools:
    """Whether what it is the left limit of depends on states and parameters alone, for each row."""
    below = leaves(*piece.forms)
    read = [piece.rows.par_rows[:, leaf.value] for leaf in below if leaf.op == "par"]
    if not any(leaf.op == "var" for leaf in below) or any((rows >= first_slot).any() for rows in read):
        return np.zeros(piece.rows.size, bool)
    return np.asarray(np.isin(piece.rows.var_rows, states).all(axis=1), bool)


def _pre_sources(system: System, hybrid: Hybrid) -> tuple[list[int], list[int]]:
    """Variable whose start value a left limit has at first, -1 for other expressions; and its sign."""
    problem = system.initial
    sources: list[int] = []
    signs: list[int] = []
    for piece in hybrid.pres:
        form = piece.forms[0]
        leaf = form.args[0] if form.op == "neg" else form
        if leaf.op != "var":
            sources += [-1] * piece.rows.size
            signs += [1] * piece.rows.size
            continue
        ids = piece.rows.var_rows[:, leaf.value]
        sources += problem.start_source[ids].tolist()
        signs += ((-1 if form.op == "neg" else 1) * problem.start_sign[ids]).tolist()
    return sources, signs


def _reinits(system: System, hybrid: Hybrid) -> tuple[list[int], list[int]]:
    """Number of the state of each, and the sign."""
    position = {int(v): k for k, v in enumerate(system.lowered.schedule.states)}
    targets = [int(v) for item in hybrid.reinits for v in item.targets]
    for v in targets:
        if v not in position:
            raise ExportError(
                f"`{system.name}`: reinit({system.stages.flat.name(v)}, ...) sets a variable that is not among the "
                f"states ({', '.join(system.states)}), which an FMU cannot do; give it `state_select='always'`"
            )
    return [position[v] for v in targets], [int(s) for item in hybrid.reinits for s in item.signs]


def _scales(system: System, hybrid: Hybrid) -> list[float]:
    """Largest nominal value in each function of `Roots`, 1 where it has no variables."""
    nominal: Any = system.lowered.nominal
    rows = (row for family in hybrid.roots.families for row in family.var_rows.tolist())
    return [max((float(nominal[v]) for v in row), default=1.0) for row in rows]


def _texts(name: str, values: list[str]) -> str:
    """A constant C array of strings, without what a format could take for a directive."""
    quoted = ", ".join(f'"{_escaped(v)}"' for v in values) or '""'
    return f"AC_UNUSED static const char *const {name}[{max(len(values), 1)}] = {{{quoted}}};"


def _escaped(text: str) -> str:
    plain = " ".join(text.replace("%", " percent").split())
    return plain.replace("\\", "\\\\").replace('"', '\\"')
