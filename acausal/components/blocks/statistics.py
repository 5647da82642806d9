"""Means, variances and extreme values of signals over time."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Discrete,
    Equations,
    Parameter,
    Variable,
    connect,
    der,
    noevent,
    pre,
    reinit,
    when,
    where,
)

from .functions import Abs, Sqrt
from .interfaces import BEGINNING, SISO
from .multi import MultiProduct


class Mean(SISO):
    """Mean of the last full period ``1/f``, ``y = f int u dt``; `y0` before the first period is over.

    With `yGreaterOrEqualZero` rounding below zero is cut off.

    >>> model = assemble("wave.y - mean.u", wave=Sine(f=2.0, offset=3.0), mean=Mean(f=2.0))
    >>> close(run(model, at=[0.4, 0.6, 1.0])["mean.y"], [0.0, 3.0, 3.0])
    True

    Source: Modelica.Blocks.Math.Mean.
    """

    yGreaterOrEqualZero: bool = False
    f: Parameter = Parameter(50.0, unit="Hz", doc="base frequency")
    x0: Parameter = Parameter(0.0, doc="start value of the integral")
    y0: Parameter = Parameter(0.0, doc="output in the first period")
    x: Variable = Variable(start=x0, fixed=True, doc="integral since the beginning of the period")
    y_last: Discrete = Discrete(start=y0, doc="mean of the last period")
    end: Discrete = Discrete(unit="s", start=1e300, doc="end of the period")

    def equations(self) -> Equations:
        yield from super().equations()
        mean = self.f * pre(self.x)
        last = ac.max(mean, 0.0) if self.yGreaterOrEqualZero else mean
        over = {self.y_last: last, self.end: pre(self.end) + 1 / self.f}
        yield der(self.x) == self.u
        yield when(ac.initial(), {self.end: ac.time + 1 / self.f, self.y_last: self.y0}).elsewhen(
            ac.time >= pre(self.end), over, reinit(self.x, 0.0)
        )
        yield self.y == self.y_last


class RectifiedMean(SISO):
    """Mean of the magnitude of the signal in the last full period ``1/f``; `y0` before.

    >>> model = assemble("wave.y - mean.u", wave=Sine(f=2.0), mean=RectifiedMean(f=2.0))
    >>> close(run(model, at=[0.4, 0.6, 1.0])["mean.y"], [0.0, 2 / np.pi, 2 / np.pi])
    True

    Source: Modelica.Blocks.Math.RectifiedMean.
    """

    f: Parameter = Parameter(50.0, unit="Hz", doc="base frequency")
    x0: Parameter = Parameter(0.0, doc="start value of the integral")
    y0: Parameter = Parameter(0.0, min=0.0, doc="output in the first period")
    abs1: Abs = Abs()
    mean: Mean = Mean(f=f, x0=x0, y0=y0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.u, self.abs1.u)
        yield connect(self.abs1.y, self.mean.u)
        yield connect(self.mean.y, self.y)


class RootMeanSquare(SISO):
    """Root of the mean square of the signal in the last full period ``1/f``; `y0` before.

    >>> model = assemble("wave.y - mean.u", wave=Sine(f=2.0), mean=RootMeanSquare(f=2.0))
    >>> close(run(model, at=[0.4, 0.6, 1.0])["mean.y"], [0.0, np.sqrt(0.5), np.sqrt(0.5)])
    True

    Source: Modelica.Blocks.Math.RootMeanSquare.
    """

    f: Parameter = Parameter(50.0, unit="Hz", doc="base frequency")
    x0: Parameter = Parameter(0.0, doc="start value of the integral")
    y0: Parameter = Parameter(0.0, min=0.0, doc="output in the first period")
    product: MultiProduct = MultiProduct(nu=2)
    mean: Mean = Mean(f=f, x0=x0, y0=y0**2, yGreaterOrEqualZero=True)
    sqrt1: Sqrt = Sqrt()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.u, self.product.u[0], self.product.u[1])
        yield connect(self.product.y, self.mean.u)
        yield connect(self.mean.y, self.sqrt1.u)
        yield connect(self.sqrt1.y, self.y)


class PartialMoment(SISO, partial=True):
    """A statistic of the signal since the start, from `t_eps` behind it on.

    Source: Modelica.Blocks.Math.Variance.
    """

    t_eps: Parameter = Parameter(1e-7, unit="s", min=1e-14, doc="time behind the start at which the calculation begins")
    t_0: Discrete = Discrete(unit="s", doc="start time")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(ac.initial(), {self.t_0: ac.time})


class ContinuousMean(PartialMoment):
    """Mean since the start or `startTime`, ``y = int u dt/(t - t0)``; the signal itself in the first `t_eps` [s].

    >>> model = assemble("ramp.y - mean.u", ramp=Slope(slope=2.0, offset=1.0), mean=ContinuousMean())
    >>> close(run(model, at=[0.0, 0.5, 1.0])["mean.y"], [1.0, 1.5, 2.0])
    True

    Source: Modelica.Blocks.Math.ContinuousMean.
    """

    startTime: Parameter = Parameter(BEGINNING, unit="s", doc="time at which the mean begins, if behind the start")
    mu: Variable = Variable(start=0.0, fixed=True, doc="integral of the signal")

    def equations(self) -> Equations:
        yield from super().equations()
        since = ac.time - ac.max(self.t_0, self.startTime)
        late = since > self.t_eps
        yield der(self.mu) == where(since >= 0, self.u, 0.0)
        yield self.y == noevent(where(late, self.mu / where(late, since, 1.0), self.u))


class Variance(PartialMoment):
    """Variance since the start: ``dmu/dt = (u - mu)/(t - t0)``, ``dvar/dt = ((u - mu)^2 - var)/(t - t0)``.

    >>> model = assemble("wave.y - spread.u", wave=Sine(amplitude=2.0, f=1.0), spread=Variance())
    >>> t, y = 20.0, run(model, at=[20.0])["spread.y"][0]
    >>> close(y, 2.0, 5e-2)
    True

    Source: Modelica.Blocks.Math.Variance.
    """

    mu: Variable = Variable(doc="mean")
    var: Variable = Variable(start=0.0, fixed=True, doc="variance")

    def equations(self) -> Equations:
        yield from super().equations()
        since = ac.time - self.t_0
        late = since >= self.t_eps
        span = where(late, since, 1.0)
        yield der(self.mu) == noevent(where(late, (self.u - self.mu) / span, 0.0))
        yield der(self.var) == noevent(where(late, ((self.u - self.mu) ** 2 - self.var) / span, 0.0))
        yield self.y == noevent(where(late, ac.max(self.var, 0.0), 0.0))

    def initial_equations(self) -> Equations:
        yield from super().initial_equations()
        yield self.mu == self.u


class StandardDeviation(SISO):
    """Square root of the `Variance` since the start.

    >>> model = assemble("wave.y - spread.u", wave=Sine(amplitude=2.0, f=1.0), spread=StandardDeviation())
    >>> close(run(model, at=[20.0])["spread.y"], [np.sqrt(2.0)], 5e-2)
    True

    Source: Modelica.Blocks.Math.StandardDeviation.
    """

    t_eps: Parameter = Parameter(1e-7, unit="s", min=1e-14, doc="time behind the start at which the calculation begins")
    variance: Variance = Variance(t_eps=t_eps)
    sqrt1: Sqrt = Sqrt()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.u, self.variance.u)
        yield connect(self.variance.y, self.sqrt1.u)
        yield connect(self.sqrt1.y, self.y)
