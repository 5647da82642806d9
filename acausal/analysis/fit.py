r"""The result of a calibration: values, uncertainty, and what the data do not determine.

Near the best fit $2 C = \sum r^2$ is a quadratic form with the Fisher matrix $F = S^T S$ (plus that of the priors), so
that $F^{-1}$ is the covariance; intervals use the quantiles of Student's distribution where noise was estimated (Seber
and Wild, Nonlinear Regression, 2.1 and 5.1). Intervals of `LogBounds` and `LogNormal` parameters are symmetric on the
logarithmic scale.
"""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import UnknownNameError, nearest
from ..language.template import Floats
from .identifiability import NO_INFLUENCE, Identifiability, identify
from .profile import Profile, profile

if TYPE_CHECKING:
    import pandas as pd

    from ..simulation.solution import Solution
    from .calibrate import Noise, Outcome, Search
    from .residuals import Problem


class Fit:
    """A calibrated model.

    Attributes:
        problem: model, experiments, and what was free.
        noise: standard deviation of every sample, and which were estimated.
        outcome: where the search ended.
        tried: where each start ended, the best first.
    """

    def __init__(
        self, problem: Problem, search: Search, outcome: Outcome, noise: Noise, tried: list[Outcome]
    ) -> None:
        self.problem = problem
        self.search = search
        self.outcome = outcome
        self.noise = noise
        self.tried = tuple(tried)

    # ---- the best fit -------------------------------------------------------------------------------------------
    @property
    def names(self) -> tuple[str, ...]:
        """Names of the free quantities, in the order of all vectors and matrices."""
        return self.problem.names

    @property
    def parameters(self) -> dict[str, float]:
        """Values found, by name; those of one experiment alone are called ``name@experiment``."""
        return dict(zip(self.names, self.outcome.values.tolist(), strict=True))

    @property
    def cost(self) -> float:
        """Half the sum of squares of deviations in units of the noise, those of priors included."""
        return self.outcome.cost

    @property
    def converged(self) -> bool:
        """Whether the search ended by its tolerance."""
        return self.outcome.converged

    @property
    def degrees_of_freedom(self) -> int:
        """Samples and informative priors less free quantities."""
        informative = sum(f.prior.informative for f in self.problem.free)
        return max(self.problem.size + informative - len(self.names), 1)

    @property
    def at_bounds(self) -> dict[str, str]:
        """Parameters that ended at a bound: ``lower`` or ``upper``."""
        ends = {f.name: f.prior.at_bound(v) for f, v in zip(self.problem.free, self.outcome.values, strict=True)}
        return {name: end for name, end in ends.items() if end}

    @property
    def starts(self) -> pd.DataFrame:
        """Where each start began and ended, the best first: values, cost, iterations."""
        import pandas as pd

        return pd.DataFrame(
            [
                {f"start {n}": b for n, b in zip(self.names, o.begin, strict=True)}
                | dict(zip(self.names, o.values, strict=True))
                | {"cost": o.cost, "iterations": o.iterations, "converged": o.converged}
                for o in self.tried
            ]
        )

    def simulate(self, experiment: int | str = 0, saveat: Any = None) -> Solution:
        """The calibrated model in the conditions of an experiment (index or name), at its samples by default."""
        from .calibrate import simulate_experiment

        return simulate_experiment(self.problem, self._experiment(experiment), self.outcome.values, saveat)

    def _experiment(self, key: int | str) -> int:
        if isinstance(key, int):
            return key
        names = [e.name for e in self.problem.experiments]
        if key not in names:
            raise UnknownNameError(f"there is no experiment `{key}`.{nearest(key, names)}")
        return names.index(key)

    @cached_property
    def residuals(self) -> pd.DataFrame:
        """A row a sample: experiment, signal, t [s], measured, simulated, residual (measured less simulated), sigma."""
        import pandas as pd

        r, _ = self._linear
        parts: list[Any] = []
        for e, s, rows in self.problem.order:
            signal, sigma = self.problem.signals[e][s], self.noise.samples[rows]
            deviation = r[rows] * sigma
            parts.append(
                pd.DataFrame(
                    {
                        "experiment": self.problem.experiments[e].name, "signal": signal.name, "t": signal.t,
                        "measured": signal.y, "simulated": signal.y + deviation, "residual": -deviation, "sigma": sigma,
                    }
                )
            )  # fmt: skip
        return pd.concat(parts, ignore_index=True)

    # ---- uncertainty --------------------------------------------------------------------------------------------
    @cached_property
    def _linear(self) -> tuple[Floats, Floats]:
        return self.problem.residual_and_jacobian(self.outcome.values, self.noise.samples)

    @cached_property
    def _natural_covariance(self) -> Floats:
        """Covariance on the natural scales: of the logarithm where that is the scale; infinite without influence."""
        _, jacobian = self._linear
        rows = [jacobian * self._slope]
        for k, f in enumerate(self.problem.free):
            if f.prior.informative:
                rows.append(np.eye(1, len(self.names), k) / f.prior.numbers[1])
        full = np.concatenate(rows)
        length = np.linalg.norm(full, axis=0)
        silent = length <= NO_INFLUENCE * length.max()
        out = np.diag(np.where(silent, np.inf, 0.0))
        if not silent.all():
            _, s, directions = np.linalg.svd(full[:, ~silent] / length[~silent], full_matrices=False)
            half = directions.T / np.maximum(s, 1e-12 * s[0]) / length[~silent, None]
            out[np.ix_(~silent, ~silent)] = half @ half.T
        return out

    @property
    def _slope(self) -> Floats:
        """d(value)/d(natural scale)."""
        return np.array(
            [v if f.prior.log else 1.0 for f, v in zip(self.problem.free, self.outcome.values, strict=True)]
        )

    @property
    def covariance(self) -> Floats:
        """Covariance of the values, (n, n), in products of their units."""
        return self._natural_covariance * np.outer(self._slope, self._slope)

    @property
    def standard_errors(self) -> dict[str, float]:
        """Standard deviation of each value, in its unit."""
        return dict(zip(self.names, np.sqrt(np.diag(self.covariance)).tolist(), strict=True))

    @property
    def correlation(self) -> Floats:
        """Correlation of the values, (n, n)."""
        spread = np.sqrt(np.diag(self._natural_covariance))
        finite = np.isfinite(spread)
        scale = np.where(finite, spread, 1.0)
        return np.where(np.outer(finite, finite), self._natural_covariance / np.outer(scale, scale), np.eye(len(scale)))

    def quantile(self, level: float) -> float:
        """Half width of the interval of a level in standard deviations."""
        if not 0 < level < 1:
            raise ValueError(f"level={level} is no probability between 0 and 1")
        from scipy.stats import norm, t

        tail = 0.5 + level / 2
        return float(t.ppf(tail, self.degrees_of_freedom) if self.noise.estimated else norm.ppf(tail))

    def confidence(self, level: float = 0.95) -> dict[str, tuple[float, float]]:
        """Confidence interval of each value from the linearized model; see `profile` for its true shape."""
        half = self.quantile(level) * np.sqrt(np.diag(self._natural_covariance))
        out: dict[str, tuple[float, float]] = {}
        with np.errstate(over="ignore"):
            for f, value, width in zip(self.problem.free, self.outcome.values, half, strict=True):
                middle = f.prior.natural(value)
                low, high = f.prior.range
                ends = f.prior.value(middle - width), f.prior.value(middle + width)
                out[f.name] = float(max(ends[0], low)), float(min(ends[1], high))
        return out

    def profile(self, name: str, level: float = 0.95, points: int = 8) -> Profile:
        """Profile likelihood of a parameter: the best cost with it held at values around the best fit.

        Args:
            name: of a free quantity.
            level: of the interval that the profile is followed to.
            points: most values on each side.
        """
        if name not in self.names:
            raise UnknownNameError(f"`{name}` was not free in this calibration.{nearest(name, self.names)}")
        spread = float(np.sqrt(self._natural_covariance[self.names.index(name), self.names.index(name)]))
        return profile(
            self.search, self.outcome, self.noise.samples, self.names.index(name), spread, self.quantile(level), points
        )

    def identifiability(self) -> Identifiability:
        """Which parameters the data determine and which cannot be told apart, priors left aside."""
        _, jacobian = self._linear
        values = self.outcome.values
        scale = np.array([abs(v) or self._width(k) for k, v in enumerate(values)])
        return identify(self.names, jacobian, scale, self.correlation)

    def _width(self, k: int) -> float:
        low, high = self.problem.free[k].prior.quantile(np.array([0.16, 0.84]))
        return float(high - low)

    # ---- for people ---------------------------------------------------------------------------------------------
    def plot(self, experiment: int | str | None = None) -> Any:
        """Measured and simulated signals with their residuals; returns the figure. All experiments by default."""
        from .fit_plots import plot_fit

        chosen = range(len(self.problem.experiments)) if experiment is None else [self._experiment(experiment)]
        return plot_fit(self, list(chosen))

    def summary(self) -> str:
        """The result as text: values, intervals, noise, and warnings."""
        from .fit_plots import summary

        return summary(self)

    def __repr__(self) -> str:
        return self.summary()
