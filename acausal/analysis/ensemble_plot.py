"""The bands of an ensemble."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from .ensemble import Ensemble


def plot_ensemble(found: Ensemble, names: Sequence[str], quantiles: tuple[float, float], members: int) -> Any:
    """Median, the middle half and the band between `quantiles` of each variable over time."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(
        len(names), 1, sharex=True, squeeze=False, figsize=(8, 1 + 2.4 * len(names)), layout="constrained"
    )
    low, high = quantiles
    for axis, name in zip(axes[:, 0], names, strict=True):
        below, first, median, third, above = found.quantile(name, [low, 0.25, 0.5, 0.75, high])
        axis.fill_between(found.t, below, above, alpha=0.25, linewidth=0, label=f"{low:.0%} to {high:.0%}")
        axis.fill_between(found.t, first, third, alpha=0.4, linewidth=0, color="C0", label="25% to 75%")
        axis.plot(found.t, median, color="C0", label="median")
        for k in np.flatnonzero(found.succeeded)[:members]:
            axis.plot(found.t, found[name][k], color="gray", linewidth=0.5, alpha=0.7)
        unit = getattr(found.system.declaration_of(name), "unit", None)
        axis.set_ylabel(f"{name}\n[{unit}]" if unit else name)
        axis.grid(True, alpha=0.3)
        axis.legend(loc="best", fontsize="small")
    axes[-1, 0].set_xlabel("t [s]")
    return figure
