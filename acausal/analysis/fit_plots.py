"""What a calibration shows: figures and text."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .fit import Fit
    from .profile import Profile


def plot_fit(fit: Fit, experiments: list[int]) -> Any:
    """Measured points, simulated lines, and below them the residuals in units of the noise."""
    from matplotlib import pyplot

    table = fit.residuals
    names = list(dict.fromkeys(s.name for k in experiments for s in fit.problem.signals[k]))
    figure, axes = pyplot.subplots(
        2 * len(names), len(experiments), squeeze=False, sharex="col", layout="constrained",
        figsize=(1.5 + 4.5 * len(experiments), 1 + 3.0 * len(names)), height_ratios=[3, 1] * len(names),
    )  # fmt: skip
    for column, k in enumerate(experiments):
        experiment = fit.problem.experiments[k].name
        axes[0, column].set_title(experiment)
        times = np.concatenate([s.t for s in fit.problem.signals[k]])
        fine = np.linspace(fit.problem.experiments[k].t0, times.max(), 400)
        solution = fit.simulate(k, saveat=fine)
        for row, name in enumerate(names):
            upper, lower = axes[2 * row, column], axes[2 * row + 1, column]
            part = table[(table["experiment"] == experiment) & (table["signal"] == name)]
            upper.plot(fine, solution[name], label="model")
            upper.plot(part["t"], part["measured"], ".", markersize=3, label="measured")
            unit = solution.describe(name)[0]
            upper.set_ylabel(f"{name}\n[{unit}]" if unit else name)
            upper.legend(fontsize="small")
            lower.axhline(0.0, color="gray", linewidth=0.8)
            lower.plot(part["t"], part["residual"] / part["sigma"], ".", markersize=3)
            lower.set_ylabel("residual / σ")
        axes[-1, column].set_xlabel("t [s]")
    return figure


def plot_profile(profile: Profile, ax: Any = None) -> Any:
    """Twice the increase of the cost over the held value, with threshold and interval."""
    from matplotlib import pyplot

    if ax is None:
        _, ax = pyplot.subplots(layout="constrained")
    ax.plot(profile.values, profile.increase, ".-")
    ax.axhline(profile.threshold, color="gray", linestyle="--")
    for end, opened in zip(profile.interval, profile.open, strict=True):
        if not opened:
            ax.axvline(end, color="gray", linewidth=0.8)
    ax.set_xlabel(profile.name)
    ax.set_ylabel("2 (cost - best cost)")
    return ax.figure


def summary(fit: Fit) -> str:
    """A table of values and intervals, then noise, convergence and warnings."""
    intervals, errors = fit.confidence(), fit.standard_errors
    width = max(len(name) for name in fit.names)
    state = "converged" if fit.converged else "NOT converged"
    lines = [
        f"{fit.problem.system.name}: {fit.problem.size} samples of {len(fit.problem.experiments)} experiment(s), "
        f"{len(fit.names)} free; {state} after {fit.outcome.iterations} iterations, cost {fit.cost:.6g}",
        f"{'':{width}}  {'value':>12}  {'std. error':>12}  95 % interval",
    ]
    for name, value in fit.parameters.items():
        low, high = intervals[name]
        lines.append(f"{name:{width}}  {value:12.6g}  {errors[name]:12.3g}  {low:.6g} .. {high:.6g}")
    for name in fit.noise.estimated:
        sigma = fit.residuals.loc[fit.residuals["signal"] == name, "sigma"].iloc[0]
        lines.append(f"noise of {name}: {sigma:.3g} (estimated)")
    for name, end in fit.at_bounds.items():
        lines.append(f"`{name}` is at its {end} bound: widen it, or the model misses something.")
    found = fit.identifiability()
    if not found.identifiable:
        lines.append(str(found))
    return "\n".join(lines)
