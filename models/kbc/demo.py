"""The main job: the reference crane in four variants on the sine, as a table and as the paper's Figs. 11 to 14."""

from __future__ import annotations

import csv
from collections.abc import Callable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path
from time import perf_counter
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

import acausal as ac

from .reference import reference_crane

Floats = npt.NDArray[np.float64]
Hydraulics = Literal["extended", "simplified"]
Joint = Literal["compliant", "rigid"]

VARIANTS: Final[tuple[tuple[Hydraulics, Joint], ...]] = (
    ("extended", "compliant"),
    ("extended", "rigid"),
    ("simplified", "compliant"),
    ("simplified", "rigid"),
)
"""Hydraulics and joint; the first is the reference of the deviations."""

DURATION: Final = 20.0
"""Simulated time [s]."""
POINTS: Final = 2001
_STYLES: Final[dict[str, dict[str, Any]]] = {
    "x_ref": {"color": "0.35", "linestyle": ":", "linewidth": 2.0, "label": "reference signal"},
    "extended-compliant": {"color": "#1f5fa8", "linestyle": "-"},
    "extended-rigid": {"color": "#58a5e0", "linestyle": "--"},
    "simplified-compliant": {"color": "#c4531b", "linestyle": "-"},
    "simplified-rigid": {"color": "#eda15a", "linestyle": "--"},
}


@dataclass(frozen=True)
class Row:
    """One variant of the crane: what the compiler found, how long it took, how far it is off.

    Attributes:
        variant: hydraulics and joint.
        states: number of states.
        structural_index: structural index of the model as it was written.
        steps: steps of the integrator.
        compile_time: from the model to the first step, JAX compilation included [s].
        run_time: the integration [s].
        real_time_factor: run time divided by simulated time.
        rmse_extended: root mean square of the piston displacement's deviation from extended-compliant [m].
        rmse_reference: the same from the reference signal [m].
    """

    variant: str
    states: int
    structural_index: int
    steps: int
    compile_time: float
    run_time: float
    real_time_factor: float
    rmse_extended: float
    rmse_reference: float


@dataclass(frozen=True)
class Run:
    """Trajectories of one variant, each of shape (n_t,).

    Attributes:
        x: displacement of the piston [m].
        x_ref: reference signal [m].
        q: volume flow rate to the piston side [m3/s].
        p: pressure at the piston side [Pa].
    """

    x: Floats
    x_ref: Floats
    q: Floats
    p: Floats


def run(out: Path, stage: Callable[[str], None] = lambda _: None) -> tuple[Row, ...]:
    """Simulate the four variants, print the table, draw the figures and say where they are.

    Args:
        out: folder of the figures and of `results.csv`; made if it is not there.
        stage: told what is being done.

    Returns:
        the rows of the table.
    """
    t = np.linspace(0.0, DURATION, POINTS)
    runs: dict[str, Run] = {}
    rows: list[Row] = []
    for hydraulics, joint in VARIANTS:
        name = f"{hydraulics}-{joint}"
        row, runs[name] = _simulate(name, hydraulics, joint, t, runs.get("extended-compliant"), stage)
        rows.append(row)
    stage("drawing")
    out.mkdir(parents=True, exist_ok=True)
    figures = draw(t, runs, out)
    table = out / "results.csv"
    with table.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, list(asdict(rows[0])))
        writer.writeheader()
        writer.writerows(asdict(row) for row in rows)
    stage("")
    print(f"Knuckle boom crane, scenario sine, {DURATION:g} s simulated\n")
    print(format_table(rows))
    print("RTF: run time / simulated time; RMSE: of the displacement of the piston")
    print("\nWritten:")
    for path in (*figures, table):
        print(f"  {path.resolve()}")
    return tuple(rows)


def _simulate(
    name: str, hydraulics: Hydraulics, joint: Joint, t: Floats, base: Run | None, stage: Callable[[str], None]
) -> tuple[Row, Run]:
    """One variant; `base` is what its displacement is compared with, None if it is that itself."""
    stage(f"{name}: compiling")
    begin = perf_counter()
    crane = reference_crane(hydraulics=hydraulics, joint=joint, scenario="sine")
    system = ac.compile(crane, progress=lambda what: stage(f"{name}: {what}"))
    stage(f"{name}: JAX compilation and integration")
    solution = system.simulate(t1=DURATION, saveat=t, rtol=1e-6)
    total = perf_counter() - begin
    seconds = float(solution.stats["run_seconds"])
    stage(f"{name}: reading results")
    columns = ("x", "x_ref", "cylinder.port_a.q", "cylinder.p_a")
    made = Run(*(np.asarray(solution[column], dtype=np.float64) for column in columns))
    report = system.report()
    row = Row(
        variant=name,
        states=report.states,
        structural_index=report.structural_index,
        steps=int(solution.stats["steps"]),
        compile_time=total - seconds,
        run_time=seconds,
        real_time_factor=seconds / DURATION,
        rmse_extended=_rms(made.x - (base or made).x),
        rmse_reference=_rms(made.x - made.x_ref),
    )
    return row, made


def _rms(deviation: Floats) -> float:
    return float(np.sqrt(np.mean(deviation**2)))


def format_table(rows: list[Row]) -> str:
    """The rows as aligned text."""
    heads = (
        "variant", "states", "index", "steps", "compile [s]", "run [s]", "RTF", "RMSE to extended [m]",
        "RMSE to x_ref [m]",
    )  # fmt: skip
    cells = [
        (
            row.variant,
            f"{row.states}",
            f"{row.structural_index}",
            f"{row.steps}",
            f"{row.compile_time:.2f}",
            f"{row.run_time:.3f}",
            f"{row.real_time_factor:.1e}",
            f"{row.rmse_extended:.2e}" if row.rmse_extended else "-",
            f"{row.rmse_reference:.2e}",
        )
        for row in rows
    ]
    widths = [max(len(line[i]) for line in (heads, *cells)) for i in range(len(heads))]
    lines = [
        "  ".join(
            cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths, strict=True))
        )
        for line in (heads, *cells)
    ]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def draw(t: Floats, runs: Mapping[str, Run], out: Path) -> tuple[Path, ...]:
    """Draw the paper's Figs. 11 to 14.

    Args:
        t: times [s], shape (n_t,).
        runs: trajectories of each variant.
        out: folder, which exists.

    Returns:
        the files, in the order of the figures.
    """
    base = runs["extended-compliant"]
    pair = ("extended-compliant", "simplified-compliant")
    return (
        _figure(
            out / "fig11_displacement.png",
            "Displacement of the cylinder piston",
            "displacement [m]",
            t,
            {"x_ref": base.x_ref, **{name: runs[name].x for name in pair}},
        ),
        _figure(
            out / "fig12_deviation.png",
            "Deviation of the piston displacement from extended-compliant",
            "deviation [mm]",
            t,
            {name: 1e3 * (r.x - base.x) for name, r in runs.items() if r is not base},
        ),
        _figure(
            out / "fig13_flow.png",
            "Volumetric flow rate to the cylinder's piston side",
            "flow rate [l/min]",
            t,
            {name: 6e4 * runs[name].q for name in pair},
        ),
        _figure(
            out / "fig14_pressure.png",
            "Pressure at the cylinder's piston side",
            "pressure [bar]",
            t,
            {name: 1e-5 * runs[name].p for name in pair},
        ),
    )


def _figure(path: Path, title: str, label: str, t: Floats, curves: Mapping[str, Floats]) -> Path:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8.0, 4.2), layout="constrained")
    FigureCanvasAgg(figure)  # draws without a display, whatever the user's backend
    axes: Any = figure.subplots()
    for name, values in curves.items():
        axes.plot(t, values, **{"label": name, "linewidth": 1.5, **_STYLES[name]})
    axes.set(title=title, xlabel="t [s]", ylabel=label, xlim=(t[0], t[-1]))
    axes.grid(True, alpha=0.3)
    axes.legend(frameon=False)
    figure.savefig(str(path), dpi=130)  # pyright: ignore[reportUnknownMemberType]
    return path
