"""``acausal demo cosim``: the paper's co-simulation as tables beside its own figures, and as plots."""

from __future__ import annotations

import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from acausal.fmi.splitting import Split

from .cosimulation import (
    SETTINGS,
    Method,
    Outcome,
    Reference,
    Scenario,
    Setting,
    Stage,
    cut_crane,
    rigid_crane,
    run_setting,
    whole_crane,
)
from .cosimulation_figures import draw_signals, draw_sweep
from .cosimulation_sweep import (
    ADAPTIVE,
    MACRO_STEPS,
    METHODS,
    NAMES,
    Comparison,
    adaptive_runs,
    compare_adaptive,
    largest_step,
    sweep,
)

Table = tuple[tuple[str, ...], list[tuple[str, ...]]]
"""Head and rows."""


@dataclass(frozen=True)
class Extent:
    """How much of the experiment is done.

    Attributes:
        table: simulated time of the RMSE in Table 2 [s], the paper's.
        stable: simulated time over which its rows must stay accurate [s].
        sweep: simulated time of the sweep [s].
        steps: macro steps of the sweep [s].
        tolerances: of the adaptive master.
        scenarios: motions in which it is compared with a fixed macro step.
        settings: rows of Table 2.
    """

    table: float = 20.0
    stable: float = 60.0
    sweep: float = 10.0
    steps: tuple[float, ...] = MACRO_STEPS
    tolerances: tuple[float, ...] = (1e-2, 1e-3, 1e-4)
    scenarios: tuple[Scenario, ...] = ("sine", "step")
    settings: tuple[Setting, ...] = SETTINGS


QUICK: Final = Extent(2.0, 3.0, 1.0, (2e-3, 5e-3, 1e-2, 2e-2), (1e-2, 1e-3), ("sine",))
"""Enough to see that everything works."""


@dataclass(frozen=True)
class Experiment:
    """What was found.

    Attributes:
        extent: how much was done.
        reference: the extended, compliant crane in one piece.
        rigid: RMSE [m] and real-time factor of the rigid crane in one piece.
        rows: of Table 2, each over `extent.stable`.
        short: RMSE of these over `extent.table` [m].
        runs: with fixed macro steps.
        adaptive: with an adaptive macro step.
        limits: largest macro step that does not diverge [s], by method and order.
        comparisons: adaptive and fixed macro step at the same RMSE, by scenario.
    """

    extent: Extent
    reference: Reference
    rigid: tuple[float, float]
    rows: Sequence[Outcome]
    short: Sequence[float]
    runs: Sequence[Outcome]
    adaptive: Sequence[Outcome]
    limits: Mapping[tuple[Method, int], float]
    comparisons: Sequence[tuple[Scenario, Comparison]] = field(repr=False)


def experiment(extent: Extent, stage: Stage = lambda _: None) -> Experiment:
    """The whole experiment.

    Args:
        extent: how much of it.
        stage: told what is being done.
    """
    stage("splitting the crane, simulating it in one piece")
    cut = cut_crane()
    reference = whole_crane(cut, extent.stable)
    rigid = rigid_crane(reference)
    rows: list[Outcome] = []
    with tempfile.TemporaryDirectory(prefix="acausal-cosim-") as folder:
        for setting in extent.settings:
            stage(f"Table 2: {setting.label}")
            rows.append(run_setting(cut, reference, setting, Path(folder), extent.stable))
    short = [reference.rmse(r.result.t, r.result["cylinder.x"], extent.table) for r in rows]
    runs = sweep(cut, reference, extent.steps, extent.sweep, stage)
    adaptive = adaptive_runs(cut, reference, extent.tolerances, extent.sweep, stage)
    limits: dict[tuple[Method, int], float] = {}
    for method, order in METHODS:
        stage(f"where it diverges: {method}, order {order}")
        limits[method, order] = largest_step(cut, reference, method, order, extent.sweep)
    comparisons = _comparisons(extent, {"sine": (cut, reference)}, stage)
    return Experiment(extent, reference, rigid, rows, short, runs, adaptive, limits, comparisons)


def _comparisons(
    extent: Extent, known: Mapping[Scenario, tuple[Split, Reference]], stage: Stage
) -> list[tuple[Scenario, Comparison]]:
    made: list[tuple[Scenario, Comparison]] = []
    for scenario in extent.scenarios:
        if scenario in known:
            cut, reference = known[scenario]
        else:
            cut = cut_crane(scenario)
            reference = whole_crane(cut, extent.table)
        for method, order in ADAPTIVE:
            for tolerance in extent.tolerances:
                stage(f"adaptive against fixed, scenario {scenario}: {method}, order {order}, tolerance {tolerance:g}")
                found = compare_adaptive(cut, reference, tolerance, extent.table, method=method, order=order)
                made.append((scenario, found))
    return made


# ---- tables -------------------------------------------------------------------------------------------------------
def table_2(found: Experiment) -> Table:
    """The paper's Table 2 beside ours, and the models in one piece."""
    long = f"RMSE over {found.extent.stable:g} s [mm]"
    head = ("participants", "RTF", "paper: RTF", "RMSE [mm]", "paper: RMSE [mm]", long, "energy made")
    lines: list[tuple[str, ...]] = []
    for setting, row, short in zip(found.extent.settings, found.rows, found.short, strict=True):
        paper = ("", "") if setting.paper is None else (f"{setting.paper[0]:g}", f"{1e3 * setting.paper[1]:.2f}")
        ours = f"{row.real_time_factor:.2g}", f"{1e3 * short:.3f}"
        lines.append((row.label, ours[0], paper[0], ours[1], paper[1], f"{1e3 * row.rmse:.3f}", f"{row.energy:.1e}"))
    factor, (rmse, rigid) = found.reference.real_time_factor, found.rigid
    lines.append(("in one piece, compliant", f"{factor:.2g}", "", "0", "", "0", ""))
    lines.append(("in one piece, rigid", f"{rigid:.2g}", "", "", "", f"{1e3 * rmse:.3f}", ""))
    return head, lines


def sweep_table(found: Experiment) -> Table:
    """RMSE by macro step and method, and the largest macro step that holds."""
    head = ("macro step [ms]", *(f"{NAMES[m]}, {o}" for m, o in METHODS))
    lines: list[tuple[str, ...]] = []
    for step in found.extent.steps:
        by_method = {(r.method, r.order): r for r in found.runs if r.step == step}
        cells = ("diverges" if (r := by_method[key]).diverged else f"{1e3 * r.rmse:.2g}" for key in METHODS)
        lines.append((f"{1e3 * step:g}", *cells))
    cells = ("> 200" if (limit := found.limits[key]) >= 0.2 else f"{1e3 * limit:.3g}" for key in METHODS)
    lines.append(("largest that holds [ms]", *cells))
    return head, lines


def adaptive_table(found: Experiment) -> Table:
    """Steps of the adaptive master and of a fixed macro step at the same RMSE."""
    head = ("scenario, method, tolerance", "RMSE [mm]", "steps", "taken back", "fixed steps", "saved")
    lines: list[tuple[str, ...]] = []
    for scenario, c in found.comparisons:
        a = c.adaptive
        name = f"{scenario}, {NAMES[a.method]} {a.order}, {c.tolerance:g}"
        counts = f"{a.steps}", f"{a.rejected}", f"{c.fixed.steps}"
        lines.append((name, f"{1e3 * a.rmse:.3g}", *counts, f"{1 - a.tried / c.fixed.steps:.0%}"))
    return head, lines


def format_table(table: Table) -> str:
    """A table as aligned text."""
    head, rows = table
    widths = [max(len(line[i]) for line in (head, *rows)) for i in range(len(head))]

    def aligned(row: tuple[str, ...]) -> str:
        pairs = zip(row, widths, strict=True)
        return "  ".join(cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(pairs))

    lines = [aligned(row) for row in (head, *rows)]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def draw(found: Experiment, out: Path) -> tuple[Path, ...]:
    """All figures into a folder."""
    out.mkdir(parents=True, exist_ok=True)
    factor = found.reference.real_time_factor
    first = [row for row, setting in zip(found.rows, found.extent.settings, strict=True) if setting.paper is not None]
    return (
        *draw_signals(found.reference, first, found.extent.table, out),
        *draw_sweep(found.runs, found.adaptive, found.rigid, factor, out),
    )


def run(out: Path, stage: Stage = lambda _: None, *, quick: bool = False) -> Experiment:
    """The experiment, its tables printed and its figures drawn.

    Args:
        out: folder of the figures; made if it is not there.
        stage: told what is being done.
        quick: a short one, which shows that everything works.
    """
    found = experiment(QUICK if quick else Extent(), stage)
    stage("drawing")
    files = draw(found, out)
    stage("")
    print("Co-simulation of the knuckle boom crane, cut between joint and boom, scenario sine\n")
    print(f"Table 2: macro step 10 ms, Jacobi, inputs extrapolated linearly, {found.extent.table:g} s\n")
    print(format_table(table_2(found)))
    print("\nRTF: run time / simulated time. RMSE: of the piston displacement, from the compliant model in one piece;")
    print("that of the rigid one is what leaving the compliance of the joint out costs. Energy made: the largest")
    print("energy residual of the cut, of the energy that passed through it.")
    print(f"\nRMSE [mm] against the macro step over {found.extent.sweep:g} s, by method and order of extrapolation\n")
    print(format_table(sweep_table(found)))
    print("\nAdaptive macro step, and the fixed one that is as accurate; saved: steps taken back are counted\n")
    print(format_table(adaptive_table(found)))
    print("\nWritten:")
    for path in files:
        print(f"  {path.resolve()}")
    return found


