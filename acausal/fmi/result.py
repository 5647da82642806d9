"""What a co-simulation gives: signals at the communication points, counts, and the energy that the coupling made."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UnknownNameError, nearest
from .participant import Floats

if TYPE_CHECKING:
    import pandas as pd


@dataclass(eq=False)
class CoSimulationResult:
    """Signals of all participants at the communication points.

    Attributes:
        t: communication points [s], (n_t,).
        signals: by ``participant.output``, values (n_t,).
        units: by the same names.
        energy: by power bond, the energy [J] that the coupling has made out of nothing up to each point, (n_t,); a
            negative one has been lost.
        power: by power bond, the power [W] that it carries, (n_t,).
        defect: how far the predicted inputs were off at the end of each step, relative to their size, (n_t,).
        stats: counts and seconds.
        result: ``successful`` or why it ended.
    """

    t: Floats
    signals: Mapping[str, Floats]
    units: Mapping[str, str]
    energy: Mapping[str, Floats]
    power: Mapping[str, Floats]
    defect: Floats
    stats: Mapping[str, Any]
    result: str = "successful"

    def __getitem__(self, name: str) -> Floats:
        """Values of ``participant.output``; a name without participant does if one participant only has it.

        Raises:
            UnknownNameError: no such signal, or several.
        """
        if name in self.signals:
            return self.signals[name]
        found = [n for n in self.signals if n.partition(".")[2] == name]
        if len(found) == 1:
            return self.signals[found[0]]
        if found:
            raise UnknownNameError(f"`{name}` is a signal of several participants: {', '.join(found)}")
        raise UnknownNameError(f"the co-simulation has no signal `{name}`.{nearest(name, self.signals)}")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all signals."""
        return tuple(self.signals)

    @property
    def energy_residual(self) -> float:
        """Largest energy [J] that any of the bonds has made or lost; nan without power bonds."""
        return max((float(np.max(np.abs(e))) for e in self.energy.values()), default=float("nan"))

    def rmse(self, name: str, reference: Any) -> float:
        """Root mean square of a signal's deviation from reference values at the same times, over time.

        Args:
            name: the signal.
            reference: values (n_t,), or a solution that has a variable of that name, interpolated linearly.
        """
        values = self[name]
        if hasattr(reference, "t"):
            reference = np.interp(self.t, np.asarray(reference.t), np.asarray(reference[name.partition(".")[2]]))
        deviation = (values - np.asarray(reference)) ** 2
        span = self.t[-1] - self.t[0]
        return float(np.sqrt(np.trapezoid(deviation, self.t) / span)) if span else float(np.sqrt(deviation.mean()))

    def to_dataframe(self, names: Iterable[str] | None = None) -> pd.DataFrame:
        """A pandas frame, index `t` [s], one column a signal; units are in `frame.attrs`."""
        import pandas as pd

        chosen = list(self.signals if names is None else names)
        frame = pd.DataFrame({n: self[n] for n in chosen}, index=pd.Index(self.t, name="t"))
        frame.attrs = {"units": {"t": "s", **{n: self.units.get(n, "") for n in chosen}}}
        return frame

    def plot(self, *names: str, **style: Any) -> Any:
        """Plots signals over time, one axis a unit; returns the figure."""
        from matplotlib import pyplot

        groups: dict[str, list[str]] = {}
        for name in names or self.names:
            groups.setdefault(self.units.get(name, ""), []).append(name)
        figure, axes = pyplot.subplots(
            len(groups), 1, sharex=True, squeeze=False, figsize=(8, 1 + 2.2 * len(groups)), layout="constrained"
        )
        for axis, (unit, members) in zip(axes[:, 0], groups.items(), strict=True):
            for name in members:
                axis.plot(self.t, self[name], label=name, **style)
            axis.set_ylabel(f"[{unit}]" if unit else "")
            axis.grid(True, alpha=0.3)
            axis.legend(loc="best", fontsize="small")
        axes[-1, 0].set_xlabel("t [s]")
        return figure

    def __repr__(self) -> str:
        span = f"{self.t[0]:g} to {self.t[-1]:g} s" if len(self.t) else "empty"
        return f"<CoSimulationResult {span}, {self.stats.get('macro_steps')} macro steps, {self.result}>"
