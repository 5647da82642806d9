"""Angles, lengths, and polar coordinates of signals."""

from __future__ import annotations

import acausal as ac
from acausal import PI, Component, Discrete, Equations, Input, Output, noevent, where

from .booleans import boolean
from .interfaces import SI2SO, SISO


class WrapAngle(SISO):
    """The same angle in ]-pi, pi], or in [0, 2 pi[ with `positiveRange` [rad].

    >>> model = assemble("ramp.y - wrap.u", ramp=Slope(slope=10.0), wrap=WrapAngle())
    >>> close(run(model, at=[0.1, 0.5, 0.7])["wrap.y"], [1.0, 5.0 - 2 * np.pi, 7.0 - 2 * np.pi])
    True

    Source: Modelica.Blocks.Math.WrapAngle.
    """

    positiveRange: bool = False

    def equations(self) -> Equations:
        yield from super().equations()
        turn = 2 * PI
        if self.positiveRange:
            yield self.y == self.u - turn * ac.floor(self.u / turn)
        else:
            yield self.y == self.u - turn * ac.ceil(self.u / turn - 0.5)


class Pythagoras(SI2SO):
    """Hypotenuse ``y = sqrt(u1^2 + u2^2)``, or with `u1IsHypotenuse` the leg ``y = sqrt(u1^2 - u2^2)``.

    A leg that does not exist is 0, and the boolean `valid` is false.

    >>> binary(Pythagoras(), 3.0, 4.0), binary(Pythagoras(u1IsHypotenuse=True), 5.0, 4.0)
    (5.0, 3.0)

    Source: Modelica.Blocks.Math.Pythagoras.
    """

    u1IsHypotenuse: bool = False
    valid: Discrete = Discrete(doc="whether y is valid")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.u1IsHypotenuse:
            square = self.u1**2 - self.u2**2
            there = noevent(square >= 0)
            yield self.valid == boolean(square >= 0)
            yield self.y == noevent(where(there, ac.sqrt(where(there, square, 1.0)), 0.0))
        else:
            yield self.valid == 1.0
            yield self.y == ac.sqrt(self.u1**2 + self.u2**2)


class RectangularToPolar(Component):
    """Length `y_abs` and angle `y_arg` [rad] of the point (u_re, u_im).

    >>> model = assemble("x.y - polar.u_re", "y.y - polar.u_im", x=Constant(k=-1.0), y=Constant(k=1.0),
    ...                  polar=RectangularToPolar())
    >>> point = run(model, at=[1.0])
    >>> close([point["polar.y_abs"][0], point["polar.y_arg"][0]], [np.sqrt(2.0), 0.75 * np.pi])
    True

    Source: Modelica.Blocks.Math.RectangularToPolar.
    """

    u_re: Input = Input(doc="real part")
    u_im: Input = Input(doc="imaginary part")
    y_abs: Output = Output(doc="length")
    y_arg: Output = Output(doc="angle [rad]")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y_abs == ac.sqrt(self.u_re**2 + self.u_im**2)
        yield self.y_arg == ac.atan2(self.u_im, self.u_re)


class PolarToRectangular(Component):
    """The point (y_re, y_im) with length `u_abs` and angle `u_arg` [rad].

    >>> model = assemble("length.y - point.u_abs", "angle.y - point.u_arg", length=Constant(k=2.0),
    ...                  angle=Constant(k=np.pi / 6), point=PolarToRectangular())
    >>> point = run(model, at=[1.0])
    >>> close([point["point.y_re"][0], point["point.y_im"][0]], [np.sqrt(3.0), 1.0])
    True

    Source: Modelica.Blocks.Math.PolarToRectangular.
    """

    u_abs: Input = Input(doc="length")
    u_arg: Input = Input(doc="angle [rad]")
    y_re: Output = Output(doc="real part")
    y_im: Output = Output(doc="imaginary part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y_re == self.u_abs * ac.cos(self.u_arg)
        yield self.y_im == self.u_abs * ac.sin(self.u_arg)
