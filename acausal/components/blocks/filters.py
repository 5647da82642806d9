"""Filters by their cut-off frequency: critical damping, Bessel, Butterworth, Chebyshev."""

from __future__ import annotations

import math

from acausal import PI, DeclarationError, Equations, Expr, Parameter, Variable, Vector, assert_, der

from .filter_design import FILTERS, Section, band, high_pass, low_pass, poles
from .interfaces import SISO, initialized


class Filter(SISO):
    """Filter of `order` with its cut-off at `f_cut` [Hz]: low-pass, high-pass, or a band from `f_min` to `f_cut`.

    ``y = gain F(s/w) u`` with ``w = 2 pi f_cut``; a high-pass filter is a low-pass filter with ``w/s`` in the place of
    ``s/w``. `filterType` is LowPass, HighPass, BandPass or BandStop; `analogFilter` is CriticalDamping, Bessel,
    Butterworth or ChebyshevI (with a ripple of `A_ripple` [dB]). With `normalized` the gain at `f_cut` is -3 dB. It
    begins at rest with ``init="SteadyState"``, the default; `initType` is the same. The states are those of
    ``u/u_nominal``.

    >>> class Lag(Component):
    ...     step: Step = Step(height=2.0, startTime=0.1)
    ...     filter: Filter = Filter(analogFilter="Butterworth", order=2, f_cut=1.0 / (2 * np.pi))
    ...     def equations(self):
    ...         yield connect(self.step.y, self.filter.u)
    >>> t = np.array([1.0, 3.0]) - 0.1
    >>> r = np.sqrt(0.5)
    >>> close(run(Lag(), at=[1.0, 3.0])["filter.y"], 2 - 2 * np.exp(-r * t) * (np.cos(r * t) + np.sin(r * t)))
    True

    Source: Modelica.Blocks.Continuous.Filter; what passes a band has the gain `gain` here for all `analogFilter`.
    """

    analogFilter: str = "CriticalDamping"
    filterType: str = "LowPass"
    order: int = 2
    normalized: bool = True
    init: str = "SteadyState"
    initType: str = ""
    f_cut: Parameter = Parameter(1.0, unit="Hz", min=1e-60, doc="cut-off frequency")
    f_min: Parameter = Parameter(0.0, unit="Hz", min=0.0, doc="lower end of a band, below f_cut")
    gain: Parameter = Parameter(1.0, doc="gain of what passes")
    A_ripple: Parameter = Parameter(0.5, min=1e-60, doc="ripple in the pass band of ChebyshevI [dB]")
    u_nominal: Parameter = Parameter(1.0, min=1e-60, doc="nominal value of the input")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")

    @property
    def nx(self) -> int:
        """Number of states."""
        return 2 * self.order if self.filterType in FILTERS[2:] else self.order

    x_start: Vector = Vector(Parameter(0.0, doc="start value of the state"), size="nx")
    x: Vector = Vector(Variable(doc="state"), x_start, size="nx")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.filterType not in FILTERS:
            raise DeclarationError(f"`filterType={self.filterType!r}` is none of {', '.join(FILTERS)}")
        signal = self.u / self.u_nominal
        singles, sections = self._parts()
        for k, rate in enumerate(singles):
            x = self.x[k]
            yield der(x) == rate * (signal - x)
            signal = signal - x if self.filterType == "HighPass" else x
        for k, part in enumerate(sections):
            x1, x2 = self.x[len(singles) + 2 * k], self.x[len(singles) + 2 * k + 1]
            yield der(x1) == part.a * x1 - part.b * x2 + part.ku * signal
            yield der(x2) == part.b * x1 + part.a * x2
            out = part.k1 * x1 + part.k2 * x2
            signal = out + signal if part.through else out
        if self.filterType in FILTERS[2:]:
            yield assert_((self.f_min > 0) & (self.f_min < self.f_cut), "a band filter needs 0 < f_min < f_cut")
            for part in sections:
                yield assert_(part.b > 0, "the band is too wide for this analogFilter: it gives poles on the real axis")
        yield self.y == self.gain * self.u_nominal * signal

    def _parts(self) -> tuple[list[Expr], list[Section]]:
        """Rates of the sections of first order, and the sections of second order."""
        w = 2 * PI * self.f_cut
        found = poles(self.analogFilter, self.order, self.normalized, self.A_ripple * 1.0)
        real, pairs = [p.re for p in found if p.real], [p for p in found if not p.real]
        if self.filterType == "LowPass":
            return [-p * w for p in real], [low_pass(p, w) for p in pairs]
        if self.filterType == "HighPass":
            return [-w / p for p in real], [high_pass(p, w) for p in pairs]
        stop = self.filterType == "BandStop"
        return [], [part for p in found for part in band(p, self.f_min * 1.0, self.f_cut * 1.0, stop=stop)]

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states = list(zip(self.x, self.x_start, strict=True))
        yield from initialized(self.initType or self.init, states, (self.y, self.y_start))


class LowpassButterworth(SISO):
    """Butterworth's low-pass filter of order `n` with its cut-off at `f` [Hz], where the gain is ``1/sqrt(2)``.

    Second-order filters with states `x1` and ``x2 = dx1/dt``, and for odd `n` a lag with the state `xr`.

    >>> class Lag(Component):
    ...     step: Step = Step(height=2.0, startTime=0.1)
    ...     filter: LowpassButterworth = LowpassButterworth(n=2, f=1.0 / (2 * np.pi))
    ...     def equations(self):
    ...         yield connect(self.step.y, self.filter.u)
    >>> t = np.array([1.0, 3.0]) - 0.1
    >>> r = np.sqrt(0.5)
    >>> close(run(Lag(), at=[1.0, 3.0])["filter.y"], 2 - 2 * np.exp(-r * t) * (np.cos(r * t) + np.sin(r * t)))
    True

    Source: Modelica.Blocks.Continuous.LowpassButterworth.
    """

    n: int = 2
    initType: str = "NoInit"
    f: Parameter = Parameter(1.0, unit="Hz", min=1e-60, doc="cut-off frequency")
    xr_start: Parameter = Parameter(0.0, doc="start value of the state of the lag")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    xr: Variable = Variable(start=xr_start, doc="state of the lag; 0 for even n")

    @property
    def m(self) -> int:
        """Number of filters of second order."""
        return self.n // 2

    x1_start: Vector = Vector(Parameter(0.0, doc="start value of the output of a second-order filter"), size="m")
    x2_start: Vector = Vector(Parameter(0.0, doc="start value of its derivative"), size="m")
    x1: Vector = Vector(Variable(doc="output of a second-order filter"), x1_start, size="m")
    x2: Vector = Vector(Variable(doc="its derivative"), x2_start, size="m")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.n < 1:
            raise DeclarationError(f"`n={self.n}`: a filter has at least one pole")
        w, signal = 2 * PI * self.f, self.u
        for i, (x1, x2) in enumerate(zip(self.x1, self.x2, strict=True)):
            damping = -math.cos(math.pi / 2 + math.pi / self.n * (i + 0.5))
            yield der(x1) == x2
            yield der(x2) == w**2 * (signal - x1) - 2 * damping * w * x2
            signal = x1
        if self.n % 2:
            yield der(self.xr) == w * (signal - self.xr)
            yield self.y == self.xr
        else:
            yield self.xr == 0
            yield self.y == signal

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        states = [*zip(self.x1, self.x1_start, strict=True), *zip(self.x2, self.x2_start, strict=True)]
        if self.n % 2:
            states.append((self.xr, self.xr_start * 1.0))
        yield from initialized(self.initType, states, (self.y, self.y_start))


class CriticalDamping(SISO):
    """Low-pass filter of `n` equal real poles, ``y = u/(1 + s/w)^n`` with ``w = 2 pi f/alpha``: it never overshoots.

    ``alpha = sqrt(2^(1/n) - 1)`` with `normalized`, so that the gain at the frequency `f` is ``1/sqrt(2)``, else 1.

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
    f: Parameter = Parameter(1.0, unit="Hz", min=1e-60, doc="cut-off frequency")
    y_start: Parameter = Parameter(0.0, doc="start value of the output")
    x_start: Vector = Vector(Parameter(0.0, doc="start value of the state"), size="n")
    x: Vector = Vector(Variable(doc="state"), x_start, size="n")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.n < 1:
            raise DeclarationError(f"`n={self.n}`: a filter has at least one pole")
        alpha = math.sqrt(2.0 ** (1.0 / self.n) - 1.0) if self.normalized else 1.0
        signal = self.u
        for x in self.x:
            yield der(x) == 2 * PI * self.f / alpha * (signal - x)
            signal = x
        yield self.y == signal

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield from initialized(self.initType, list(zip(self.x, self.x_start, strict=True)), (self.y, self.y_start))
