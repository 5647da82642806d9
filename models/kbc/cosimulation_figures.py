"""Figures of the crane's co-simulation: the paper's Figs. 12 to 14, and accuracy and cost against the macro step."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

from .cosimulation import Floats, Outcome, Reference
from .cosimulation_sweep import ADAPTIVE, METHODS, NAMES

_COLOURS: Final = {"jacobi": ("#f2b48a", "#d9722e", "#8f3a0b"), "gauss-seidel": ("#9cc7ea", "#3b83c0", "#12406e")}
"""By method, one shade for each order of extrapolation."""
_MARKS: Final = {"jacobi": "o", "gauss-seidel": "s"}
_ROWS: Final[tuple[dict[str, Any], ...]] = (
    {"color": "#c4531b", "linestyle": "-"},
    {"color": "#1f5fa8", "linestyle": "--"},
    {"color": "#e8a36b", "linestyle": "-."},
    {"color": "#58a5e0", "linestyle": ":", "linewidth": 2.2},
)
_PAPER_TABLE_2: Final = 0.52e-3
"""RMSE of the paper's two FMUs at a macro step of 0.01 s [m]."""


def draw_signals(reference: Reference, rows: Sequence[Outcome], end: float, out: Path) -> tuple[Path, ...]:
    """The paper's Figs. 12 to 14: deviation of the piston, flow and pressure at its side.

    Args:
        reference: the model in one piece.
        rows: the first four of Table 2.
        end: of the time axis [s].
        out: folder, which exists.

    Returns:
        the files.
    """
    whole = {"t": reference.t, **reference.signals}
    deviations = {
        r.label: (r.result.t, 1e3 * reference.deviation(r.result.t, r.result["cylinder.x"])) for r in rows
    }
    made = [_lines(out / "fig12_deviation.png", "Deviation of the piston displacement from the model in one piece",
                   "deviation [mm]", end, deviations)]  # fmt: skip
    for file, title, label, name, factor in (
        ("fig13_flow.png", "Volumetric flow rate to the piston side", "flow rate [l/min]", "cylinder.port_a.q", 6e4),
        ("fig14_pressure.png", "Pressure at the piston side", "pressure [bar]", "cylinder.p_a", 1e-5),
    ):
        curves = {"in one piece": (whole["t"], factor * whole[name])}
        curves |= {r.label: (r.result.t, factor * r.result[name]) for r in rows}
        made.append(_lines(out / file, title, label, end, curves))
    return tuple(made)


def _lines(path: Path, title: str, label: str, end: float, curves: Mapping[str, tuple[Floats, Floats]]) -> Path:
    figure, (axes,) = _figure(1, (8.0, 4.2))
    styles = iter(_ROWS)
    for name, (t, values) in curves.items():
        style = {"color": "0.25", "linewidth": 2.4, "alpha": 0.5} if name == "in one piece" else next(styles)
        axes.plot(t[t <= end], values[t <= end], **{"label": name, "linewidth": 1.4, **style})
    axes.set(title=title, xlabel="t [s]", ylabel=label, xlim=(0.0, end))
    axes.grid(True, alpha=0.3)
    axes.legend(frameon=False)
    return _save(figure, path)


def draw_sweep(
    runs: Sequence[Outcome], adaptive: Sequence[Outcome], rigid: tuple[float, float], whole: float, out: Path
) -> tuple[Path, ...]:
    """Accuracy and cost against the macro step, and what the energy residual says about the error.

    Args:
        runs: fixed macro steps with all methods.
        adaptive: runs with an adaptive macro step.
        rigid: RMSE [m] and real-time factor of the rigid model in one piece.
        whole: real-time factor of the compliant model in one piece.
        out: folder, which exists.

    Returns:
        the files.
    """
    figure, (left, right) = _figure(2, (11.0, 4.4))
    for method, order in METHODS:
        mine = [r for r in runs if (r.method, r.order) == (method, order)]
        good = [r for r in mine if not r.diverged]
        style: dict[str, Any] = {"color": _COLOURS[method][order], "marker": _MARKS[method], "markersize": 4}
        name = f"{NAMES[method]}, order {order}"
        left.plot([1e3 * r.step for r in good], [r.rmse for r in good], label=name, **style)
        right.plot([r.real_time_factor for r in good], [r.rmse for r in good], **style)
        for r in mine:
            if r.diverged:
                left.plot(1e3 * r.step, 3e-2, marker="x", color=style["color"], markersize=8, linestyle="none")
    for method, order in ADAPTIVE:
        mine = [r for r in adaptive if r.method == method]
        style = {"color": _COLOURS[method][order], "marker": "*", "markersize": 10, "linestyle": "none"}
        mean = [1e3 * r.end / r.tried for r in mine]
        left.plot(mean, [r.rmse for r in mine], label=f"{NAMES[method]}, order {order}, adaptive", **style)
        right.plot([r.real_time_factor for r in mine], [r.rmse for r in mine], **style)
    left.axhline(rigid[0], color="0.3", linestyle="--", linewidth=1.0, label="rigid, in one piece")
    left.plot(10.0, _PAPER_TABLE_2, marker="P", color="k", markersize=8, linestyle="none", label="paper, two FMUs")
    right.plot(rigid[1], rigid[0], marker="D", color="0.3", linestyle="none", label="rigid, in one piece")
    right.axvline(whole, color="0.6", linestyle=":", label="compliant, in one piece")
    left.set(xlabel="macro step [ms]", ylabel="RMSE of the piston displacement [m]", title="Accuracy")
    right.set(xlabel="real-time factor", title="Cost")
    for axes in (left, right):
        axes.set(xscale="log", yscale="log", ylim=(1e-9, 6e-2))
        axes.grid(True, alpha=0.3)
    figure.legend(*left.get_legend_handles_labels(), frameon=False, fontsize=8, loc="outside right upper")
    right.legend(frameon=False, fontsize=8, loc="lower left")
    return _save(figure, out / "macro_step.png"), _energy(runs, out / "energy_residual.png")


def _energy(runs: Sequence[Outcome], path: Path) -> Path:
    figure, (axes,) = _figure(1, (6.4, 4.8))
    for method, order in METHODS:
        good = [r for r in runs if (r.method, r.order) == (method, order) and not r.diverged]
        style: dict[str, Any] = {"color": _COLOURS[method][order], "marker": _MARKS[method], "markersize": 4}
        axes.plot([r.energy for r in good], [r.rmse for r in good], label=f"{NAMES[method]}, order {order}", **style)
    axes.set(
        xscale="log",
        yscale="log",
        xlabel="energy made by the coupling, of the energy that passed",
        ylabel="RMSE of the piston displacement [m]",
        title="What the energy residual says",
    )
    axes.grid(True, alpha=0.3)
    axes.legend(frameon=False, fontsize=8)
    return _save(figure, path)


def _figure(columns: int, size: tuple[float, float]) -> tuple[Any, Sequence[Any]]:
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=size, layout="constrained")
    FigureCanvasAgg(figure)  # draws without a display, whatever the user's backend
    axes: Any = figure.subplots(1, columns, squeeze=False)
    return figure, list(axes[0])


def _save(figure: Any, path: Path) -> Path:
    figure.savefig(str(path), dpi=100)
    return path
