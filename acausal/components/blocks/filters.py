"""Filters by their cut-off frequency: critical damping, Bessel, Butterworth."""

from __future__ import annotations

import math
from collections.abc import Callable, Generator
from typing import Any

import numpy as np

from acausal import PI, Array, DeclarationError, Equations, Expr, Parameter, der

from ...symbolic.equation import Equation
from .continuous import State, initialized
from .interfaces import SISO


def poles(kind: str, order: int, normalized: bool) -> list[complex]:
    """Poles of a low-pass filter of cut-off 1 rad/s, those above the real axis and on it.

    Args:
        kind: ``"CriticalDamping"``, ``"Bessel"`` or ``"Butterworth"``.
        order: number of poles.
        normalized: whether the gain at the cut-off frequency is -3 dB, ``10^(-3/20)``.

    Source: Tietze and Schenk, Halbleiter-Schaltungstechnik (2002), chapter 13; the scaling of
    Modelica.Blocks.Continuous.Filter.
    """
    from scipy.signal import besselap, buttap

    designs: dict[str, Callable[[], Any]] = {
        "CriticalDamping": lambda: np.full(order, -1.0), "Bessel": lambda: besselap(order, norm="delay")[1],
        "Butterworth": lambda: buttap(order)[1],
    }  # fmt: skip
    if kind not in designs:
        raise DeclarationError(f"`analogFilter={kind!r}` is none of {', '.join(designs)}")
    if order < 1:
        raise DeclarationError(f"`order={order}`: a filter has at least one pole")
    found = np.asarray(designs[kind](), complex)
    scale = _cutoff(found) if normalized else 1.0
    return [complex(p) / scale for p in found if p.imag > -1e-9]


def _cutoff(found: Any) -> float:
    """Frequency at which the gain, which falls all the way, is -3 dB against that at rest."""
    from scipy.optimize import brentq

    def excess(logarithm: float) -> float:
        gain = np.prod(np.abs(found) / np.abs(1j * math.exp(logarithm) - found))
        return math.log(gain) + 3.0 / 20.0 * math.log(10.0)

    root: Any = brentq(excess, -20.0, 20.0)
    return math.exp(root)


class Filter(SISO):
    """Low-pass or high-pass filter of `order`, with its cut-off at `f_cut` [Hz].

    ``y = gain F(s/w) u`` with ``w = 2 pi f_cut``; a high-pass filter is a low-pass filter with ``w/s`` in the place of
    ``s/w``. `analogFilter` is ``"CriticalDamping"``, ``"Bessel"`` or ``"Butterworth"``; with `normalized` the gain at
    `f_cut` is -3 dB. It begins at rest with ``initType="SteadyState"``.

    >>> class Lag(Component):
    ...     step: Step = Step(height=2.0, startTime=0.1)
    ...     filter: Filter = Filter(order=2, f_cut=1.0 / (2 * np.pi))
    ...     def equations(self):
    ...         yield connect(self.step.y, self.filter.u)
    >>> t = np.array([1.0, 3.0]) - 0.1
    >>> r = np.sqrt(0.5)
    >>> close(run(Lag(), at=[1.0, 3.0])["filter.y"], 2 - 2 * np.exp(-r * t) * (np.cos(r * t) + np.sin(r * t)), 1e-2)
    True

    Source: Modelica.Blocks.Continuous.Filter.
    """

    analogFilter: str = "Butterworth"
    filterType: str = "LowPass"
    order: int = 2
    normalized: bool = True
    initType: str = "SteadyState"
    f_cut: Parameter = Parameter(1.0, unit="Hz", doc="cut-off frequency")
    gain: Parameter = Parameter(1.0, doc="gain of what passes")
    x: Array[State] = Array(State(), "order")

    def equations(self) -> Equations:
        yield from super().equations()
        w, signal, k = 2 * PI * self.f_cut, self.u * 1.0, 0
        for pole in poles(self.analogFilter, self.order, self.normalized):
            pair = pole.imag > 1e-9
            section = self._second(w, signal, pole, k) if pair else self._first(w, signal, -pole.real, k)
            signal = yield from section
            k += 2 if pair else 1
        yield self.y == self.gain * signal

    @property
    def high(self) -> bool:
        """Whether high frequencies pass."""
        if self.filterType not in ("LowPass", "HighPass"):
            raise DeclarationError(f"`filterType={self.filterType!r}` is none of LowPass, HighPass")
        return self.filterType == "HighPass"

    def _first(self, w: Expr, u: Expr, corner: float, k: int) -> Generator[Equation, None, Expr]:
        """A real pole at ``-corner w`` (high-pass: at ``-w/corner``); what comes out of it."""
        x = self.x[k].x
        rate = 1.0 / corner if self.high else corner
        yield der(x) == w * rate * (u - x)
        return u - x if self.high else x

    def _second(self, w: Expr, u: Expr, pole: complex, k: int) -> Generator[Equation, None, Expr]:
        """A pair of poles at `pole` (times w; high-pass: its inverse); what comes out of it."""
        x, v = self.x[k].x, self.x[k + 1].x
        at = 1.0 / pole if self.high else pole
        square = abs(at) ** 2
        yield der(x) == w * v
        if self.high:
            passed = u + 2 * at.real * v - square * x
            yield der(v) == w * passed
            return passed
        yield der(v) == w * (square * (u - x) + 2 * at.real * v)
        return x

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.x[i].x, 0.0) for i in range(self.order)])


class CriticalDamping(SISO):
    """Low-pass filter of `n` equal real poles, ``y = u/(1 + s/w)^n`` with ``w = 2 pi f/alpha``: it never overshoots.

    ``alpha = sqrt(10^(3/(10 n)) - 1)`` with `normalized`, so that the gain at the frequency `f` is -3 dB, else 1.

    >>> class Lag(Component):
    ...     step: Step = Step(height=2.0, startTime=0.1)
    ...     filter: CriticalDamping = CriticalDamping(n=2, f=0.5, normalized=False, initType="InitialState")
    ...     def equations(self):
    ...         yield connect(self.step.y, self.filter.u)
    >>> wt = np.pi * (np.array([0.5, 1.0]) - 0.1)
    >>> close(run(Lag(), at=[0.5, 1.0])["filter.y"], 2 - 2 * np.exp(-wt) * (1 + wt), 1e-6)
    True

    Source: Modelica.Blocks.Continuous.CriticalDamping.
    """

    n: int = 2
    normalized: bool = True
    initType: str = "NoInit"
    f: Parameter = Parameter(1.0, unit="Hz", doc="cut-off frequency")
    x: Array[State] = Array(State(), "n")

    def equations(self) -> Equations:
        yield from super().equations()
        alpha = math.sqrt(10.0 ** (0.3 / self.n) - 1.0) if self.normalized else 1.0
        signal = self.u * 1.0
        for i in range(self.n):
            yield der(self.x[i].x) == 2 * PI * self.f / alpha * (signal - self.x[i].x)
            signal = self.x[i].x
        yield self.y == signal

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, [(self.x[i].x, 0.0) for i in range(self.n)])
