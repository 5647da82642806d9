"""Tables of parameters: random samples, space-filling designs, grids."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..language.template import Floats
from .priors import CalibrationError, Prior, as_prior

if TYPE_CHECKING:
    import pandas as pd

Method = Literal["random", "lhs", "sobol", "halton"]


def draw(
    distributions: Mapping[str, Any], n: int, *, method: Method = "random", seed: int | None = 0
) -> pd.DataFrame:
    """Draw `n` sets of values.

    Args:
        distributions: name to `Bounds` (uniform) or a pair ``(lo, hi)``, `LogBounds` (log-uniform), `Normal`,
            `LogNormal`, or any frozen distribution of `scipy.stats`.
        n: number of sets; a Sobol sequence is balanced at powers of two.
        method: ``random`` (Monte Carlo), ``lhs`` (Latin hypercube), ``sobol`` or ``halton`` (scrambled sequences).
        seed: of the random numbers; None for others each time.

    Returns:
        a row a set, a column a name.

    Raises:
        CalibrationError: `n` or a distribution is not as it should be.
    """
    import pandas as pd

    if n < 1:
        raise CalibrationError(f"n={n}: at least one sample is needed")
    if not distributions:
        raise CalibrationError("no distribution is given: nothing to sample")
    u = _uniform(n, len(distributions), method, seed)
    columns: dict[str, Any] = {}
    for k, (name, given) in enumerate(distributions.items()):
        if isinstance(given, Prior) or not hasattr(given, "ppf"):
            columns[name] = as_prior(name, given).quantile(u[:, k])
        else:
            columns[name] = np.asarray(given.ppf(u[:, k]), float)
    return pd.DataFrame(columns)


def _uniform(n: int, d: int, method: str, seed: int | None) -> Floats:
    """Points (n, d) in the open unit cube."""
    if method == "random":
        return np.random.default_rng(seed).uniform(1e-12, 1.0, (n, d))
    from scipy.stats import qmc

    if method == "lhs":
        engine: Any = qmc.LatinHypercube(d, rng=seed)
    elif method == "halton":
        engine = qmc.Halton(d, rng=seed)
    elif method == "sobol":
        engine = qmc.Sobol(d, rng=seed)
        return np.clip(engine.random_base2(int(np.ceil(np.log2(max(n, 2)))))[:n], 1e-12, 1.0 - 1e-12)
    else:
        raise CalibrationError(f"there is no method {method!r}; there are 'random', 'lhs', 'sobol' and 'halton'")
    return np.clip(engine.random(n), 1e-12, 1.0 - 1e-12)


def grid(values: Mapping[str, Any]) -> pd.DataFrame:
    """Every combination of values, the last name running fastest.

    Args:
        values: name to its values.
    """
    import pandas as pd

    listed = [np.atleast_1d(np.asarray(v, float)) for v in values.values()]
    return pd.DataFrame(list(itertools.product(*listed)), columns=pd.Index(list(values)))
