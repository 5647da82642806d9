"""What is known about a free parameter: bounds, a scale, a distribution.

A prior gives a free parameter its natural scale (linear or logarithmic), on which intervals are stated; an internal
coordinate z, which is linear in it and runs from 0 to 1 between bounds, or counts standard deviations from the mean;
for `Normal` and `LogNormal` a residual of its own; and quantiles, from which several starts and ensembles are drawn.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ..errors import AcausalError
from ..language.template import Floats

AT_BOUND = 1e-3
"""A parameter closer to a bound than this part of the interval (on its natural scale) is reported to be there."""


class CalibrationError(AcausalError):
    """A calibration or an ensemble that cannot be carried out as it was asked for."""


class Prior(ABC):
    """Base of `Bounds`, `LogBounds`, `Normal` and `LogNormal`.

    Attributes:
        kind: name of the class, under which compiled programs find the transformation.
        log: whether the natural scale is logarithmic.
    """

    kind: ClassVar[str]
    log: ClassVar[bool] = False

    @property
    @abstractmethod
    def numbers(self) -> tuple[float, float]:
        """(a, b): the natural value is ``a + b z``."""

    @property
    @abstractmethod
    def range(self) -> tuple[float, float]:
        """Lowest and highest possible value."""

    @abstractmethod
    def quantile(self, u: Any) -> Floats:
        """Values below which a part `u` of the distribution lies, of the shape of `u`."""

    @property
    def informative(self) -> bool:
        """Whether values are preferred over others: a residual of its own."""
        return False

    def natural(self, value: Any) -> Any:
        """Values on the natural scale: themselves or their logarithm."""
        return np.log(value) if self.log else value

    def value(self, natural: Any) -> Any:
        """Inverse of `natural`."""
        return np.exp(natural) if self.log else natural

    def internal(self, value: float) -> float:
        """Internal coordinate of a value inside the range."""
        a, b = self.numbers
        return (float(self.natural(value)) - a) / b

    @property
    def limits(self) -> tuple[float, float]:
        """Ends of the internal coordinate."""
        return (-math.inf, math.inf) if self.informative else (0.0, 1.0)

    def at_bound(self, value: float) -> str:
        """``lower`` or ``upper`` if the value is at that bound, else an empty text."""
        if self.informative:
            return ""
        part = self.internal(value)
        return "lower" if part < AT_BOUND else "upper" if part > 1 - AT_BOUND else ""


def decode(kind: str, a: Any, b: Any, z: Any) -> Any:
    """The value for an internal coordinate, with JAX; `a` and `b` are the prior's `numbers`."""
    import jax.numpy as jnp

    natural = a + b * z
    return jnp.exp(natural) if kind in ("LogBounds", "LogNormal") else natural


def _interval(name: str, lo: float, hi: float) -> None:
    if not (math.isfinite(lo) and math.isfinite(hi)):
        raise CalibrationError(
            f"{name}({lo:g}, {hi:g}): both ends must be finite. For a positive parameter without a natural end take "
            "LogBounds over several decades, or LogNormal(median, sigma)"
        )
    if not lo < hi:
        raise CalibrationError(f"{name}({lo:g}, {hi:g}) is empty: the lower end must be below the upper one")


@dataclass(frozen=True, slots=True)
class Bounds(Prior):
    """Between `lo` and `hi`, nothing preferred; in ensembles uniformly distributed."""

    lo: float
    hi: float
    kind: ClassVar[str] = "Bounds"

    def __post_init__(self) -> None:
        _interval("Bounds", self.lo, self.hi)

    @property
    def numbers(self) -> tuple[float, float]:
        return float(self.lo), float(self.hi - self.lo)

    @property
    def range(self) -> tuple[float, float]:
        return float(self.lo), float(self.hi)

    def quantile(self, u: Any) -> Floats:
        return self.lo + (self.hi - self.lo) * np.asarray(u, float)


@dataclass(frozen=True, slots=True)
class LogBounds(Prior):
    """Between `lo` and `hi`, both positive, on a logarithmic scale; in ensembles log-uniformly distributed."""

    lo: float
    hi: float
    kind: ClassVar[str] = "LogBounds"
    log: ClassVar[bool] = True

    def __post_init__(self) -> None:
        _interval("LogBounds", self.lo, self.hi)
        if self.lo <= 0:
            raise CalibrationError(f"LogBounds({self.lo:g}, {self.hi:g}): a logarithmic scale needs positive ends")

    @property
    def numbers(self) -> tuple[float, float]:
        return math.log(self.lo), math.log(self.hi / self.lo)

    @property
    def range(self) -> tuple[float, float]:
        return float(self.lo), float(self.hi)

    def quantile(self, u: Any) -> Floats:
        a, b = self.numbers
        return np.exp(a + b * np.asarray(u, float))


@dataclass(frozen=True, slots=True)
class Normal(Prior):
    """Normally distributed with a mean and a standard deviation, both in the parameter's unit."""

    mean: float
    sd: float
    kind: ClassVar[str] = "Normal"

    def __post_init__(self) -> None:
        if not (math.isfinite(self.mean) and math.isfinite(self.sd) and self.sd > 0):
            raise CalibrationError(
                f"Normal(mean={self.mean:g}, sd={self.sd:g}): the standard deviation must be finite and positive"
            )

    @property
    def numbers(self) -> tuple[float, float]:
        return float(self.mean), float(self.sd)

    @property
    def range(self) -> tuple[float, float]:
        return -math.inf, math.inf

    @property
    def informative(self) -> bool:
        return True

    def quantile(self, u: Any) -> Floats:
        from scipy.special import ndtri

        return self.mean + self.sd * ndtri(u)


@dataclass(frozen=True, slots=True)
class LogNormal(Prior):
    """Positive, its logarithm normally distributed: `median` in the parameter's unit, `sigma` of the logarithm.

    A `sigma` of 0.1 is about 10 % of uncertainty.
    """

    median: float
    sigma: float
    kind: ClassVar[str] = "LogNormal"
    log: ClassVar[bool] = True

    def __post_init__(self) -> None:
        if not (0 < self.median < math.inf and 0 < self.sigma < math.inf):
            raise CalibrationError(f"LogNormal(median={self.median:g}, sigma={self.sigma:g}): both must be positive")

    @property
    def numbers(self) -> tuple[float, float]:
        return math.log(self.median), float(self.sigma)

    @property
    def range(self) -> tuple[float, float]:
        return 0.0, math.inf

    @property
    def informative(self) -> bool:
        return True

    def quantile(self, u: Any) -> Floats:
        from scipy.special import ndtri

        return self.median * np.exp(self.sigma * ndtri(u))


def as_prior(name: str, given: Any) -> Prior:
    """A prior from what a user writes: a prior, or a pair ``(lo, hi)``.

    Raises:
        CalibrationError: anything else, with the parameter's name.
    """
    if isinstance(given, Prior):
        return given
    try:
        lo, hi = (float(v) for v in given)
    except (TypeError, ValueError):
        raise CalibrationError(
            f"`{name}`: {given!r} is no prior. Give bounds (lo, hi), or Bounds, LogBounds, Normal or LogNormal"
        ) from None
    try:
        return Bounds(lo, hi)
    except CalibrationError as error:
        raise CalibrationError(f"`{name}`: {error}") from None
