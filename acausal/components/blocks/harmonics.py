"""Harmonics of periodic signals."""

from __future__ import annotations

import math

from acausal import Component, Discrete, Equations, Input, Output, Parameter, connect

from .comparisons import GreaterThreshold
from .geometry import Pythagoras, RectangularToPolar
from .interfaces import SISO
from .logical import And
from .math import Division
from .multi import MultiProduct
from .nonlinear import Limiter
from .sources import Cosine, Sine
from .statistics import Mean, RootMeanSquare


class Harmonic(Component):
    """The harmonic of order `k` of a signal of base frequency `f`: root mean square `y_rms`, and angle `y_arg` [rad].

    ``y_rms exp(j y_arg)`` is the mean of ``sqrt(2) u exp(j 2 pi k f t)`` over the last full period; the sign of the
    angle is the opposite with `useConjugateComplex`.

    >>> model = assemble("wave.y - third.u", wave=Cosine(amplitude=2.0, f=3.0, phase=-0.5), third=Harmonic(f=1.0, k=3))
    >>> result = run(model, at=[1.5])
    >>> close([result["third.y_rms"][0], result["third.y_arg"][0]], [np.sqrt(2.0), 0.5])
    True

    Source: Modelica.Blocks.Math.Harmonic.
    """

    useConjugateComplex: bool = False
    f: Parameter = Parameter(50.0, unit="Hz", doc="base frequency")
    k: Parameter = Parameter(1.0, doc="order of the harmonic, an integer")
    x0Cos: Parameter = Parameter(0.0, doc="start value of the integral with the cosine")
    x0Sin: Parameter = Parameter(0.0, doc="start value of the integral with the sine")
    y0Cos: Parameter = Parameter(0.0, doc="mean with the cosine in the first period")
    y0Sin: Parameter = Parameter(0.0, doc="mean with the sine in the first period")
    u: Input = Input(doc="input signal")
    y_rms: Output = Output(doc="root mean square")
    y_arg: Output = Output(doc="angle [rad]")
    sin1: Cosine = Cosine(amplitude=math.sqrt(2.0), f=k * f)
    sin2: Sine = Sine(amplitude=math.sqrt(2.0), f=k * f)
    product1: MultiProduct = MultiProduct(nu=2)
    product2: MultiProduct = MultiProduct(nu=2)
    mean1: Mean = Mean(f=f, x0=x0Cos, y0=y0Cos)
    mean2: Mean = Mean(f=f, x0=x0Sin, y0=y0Sin)
    rectangularToPolar: RectangularToPolar = RectangularToPolar()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.sin1.y, self.product1.u[0])
        yield connect(self.sin2.y, self.product2.u[1])
        yield connect(self.u, self.product1.u[1], self.product2.u[0])
        yield connect(self.product1.y, self.mean1.u)
        yield connect(self.product2.y, self.mean2.u)
        yield connect(self.mean1.y, self.rectangularToPolar.u_re)
        yield connect(self.mean2.y, self.rectangularToPolar.u_im)
        yield connect(self.rectangularToPolar.y_abs, self.y_rms)
        sign = -1.0 if self.useConjugateComplex else 1.0
        yield self.y_arg == sign * self.rectangularToPolar.y_arg


class TotalHarmonicDistortion(SISO):
    """Root mean square of all but the first harmonic over that of the first, or over that of all.

    ``y = sqrt(rms^2 - rms1^2)/rms1``; the denominator is `rms` without `useFirstHarmonic`. The boolean `valid` is true
    where there is a first harmonic.

    >>> model = assemble("base.y - sum.u1", "third.y - sum.u2", "sum.y - thd.u", base=Sine(amplitude=10.0, f=1.0),
    ...                  third=Sine(amplitude=2.0, f=3.0), sum=Add(), thd=TotalHarmonicDistortion(f=1.0))
    >>> close(run(model, at=[1.5])["thd.y"], [0.2])
    True

    Source: Modelica.Blocks.Math.TotalHarmonicDistortion.
    """

    useFirstHarmonic: bool = True
    f: Parameter = Parameter(1.0, unit="Hz", doc="base frequency")
    valid: Discrete = Discrete(doc="whether y is valid")
    harmonic: Harmonic = Harmonic(f=f, k=1.0)
    rootMeanSquare: RootMeanSquare = RootMeanSquare(f=f)
    greaterThreshold: GreaterThreshold = GreaterThreshold()
    division: Division = Division()
    limiter: Limiter = Limiter(uMin=2.220446049250313e-16, uMax=1e300)
    pythagoras: Pythagoras = Pythagoras(u1IsHypotenuse=True)
    andValid: And = And()

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.u, self.rootMeanSquare.u, self.harmonic.u)
        yield connect(self.rootMeanSquare.y, self.pythagoras.u1)
        yield connect(self.harmonic.y_rms, self.pythagoras.u2, self.greaterThreshold.u)
        whole = self.harmonic.y_rms if self.useFirstHarmonic else self.rootMeanSquare.y
        yield connect(whole, self.limiter.u)
        yield connect(self.pythagoras.y, self.division.u1)
        yield connect(self.limiter.y, self.division.u2)
        yield connect(self.division.y, self.y)
        yield connect(self.pythagoras.valid, self.andValid.u1)
        yield connect(self.greaterThreshold.y, self.andValid.u2)
        yield connect(self.andValid.y, self.valid)
