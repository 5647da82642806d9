"""Functions of one signal."""

from __future__ import annotations

import acausal as ac
from acausal import Equations, Parameter, noevent, where

from .interfaces import SISO


class Abs(SISO):
    """Magnitude, ``y = abs(u)``; with `generateEvent` its kink is an event.

    >>> close(unary(Abs(), -2.0), 2.0)
    True

    Source: Modelica.Blocks.Math.Abs.
    """

    generateEvent: bool = False

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == (where(self.u >= 0, self.u, -self.u) if self.generateEvent else ac.abs(self.u))


class Sign(SISO):
    """Sign, -1, 0 or 1, ``y = sign(u)``; its jumps are events with `generateEvent` only.

    >>> close(unary(Sign(), -2.0), -1.0)
    True

    Source: Modelica.Blocks.Math.Sign.
    """

    generateEvent: bool = False

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == (ac.sign(self.u) if self.generateEvent else noevent(ac.sign(self.u)))


class Sqrt(SISO):
    """Square root, ``y = sqrt(u)``.

    >>> close(unary(Sqrt(), 9.0), 3.0)
    True

    Source: Modelica.Blocks.Math.Sqrt.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.sqrt(self.u)


class Sin(SISO):
    """Sine, ``y = sin(u)``.

    >>> close(unary(Sin(), 0.5), np.sin(0.5))
    True

    Source: Modelica.Blocks.Math.Sin.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.sin(self.u)


class Cos(SISO):
    """Cosine, ``y = cos(u)``.

    >>> close(unary(Cos(), 0.5), np.cos(0.5))
    True

    Source: Modelica.Blocks.Math.Cos.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.cos(self.u)


class Tan(SISO):
    """Tangent, ``y = tan(u)``.

    >>> close(unary(Tan(), 0.5), np.tan(0.5))
    True

    Source: Modelica.Blocks.Math.Tan.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.tan(self.u)


class Asin(SISO):
    """Inverse sine [rad], ``y = asin(u)``.

    >>> close(unary(Asin(), 0.5), np.arcsin(0.5))
    True

    Source: Modelica.Blocks.Math.Asin.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.asin(self.u)


class Acos(SISO):
    """Inverse cosine [rad], ``y = acos(u)``.

    >>> close(unary(Acos(), 0.5), np.arccos(0.5))
    True

    Source: Modelica.Blocks.Math.Acos.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.acos(self.u)


class Atan(SISO):
    """Inverse tangent [rad], ``y = atan(u)``.

    >>> close(unary(Atan(), 0.5), np.arctan(0.5))
    True

    Source: Modelica.Blocks.Math.Atan.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.atan(self.u)


class Sinh(SISO):
    """Hyperbolic sine, ``y = sinh(u)``.

    >>> close(unary(Sinh(), 0.5), np.sinh(0.5))
    True

    Source: Modelica.Blocks.Math.Sinh.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.sinh(self.u)


class Cosh(SISO):
    """Hyperbolic cosine, ``y = cosh(u)``.

    >>> close(unary(Cosh(), 0.5), np.cosh(0.5))
    True

    Source: Modelica.Blocks.Math.Cosh.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.cosh(self.u)


class Tanh(SISO):
    """Hyperbolic tangent, ``y = tanh(u)``.

    >>> close(unary(Tanh(), 0.5), np.tanh(0.5))
    True

    Source: Modelica.Blocks.Math.Tanh.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.tanh(self.u)


class Exp(SISO):
    """Exponential, ``y = exp(u)``.

    >>> close(unary(Exp(), 0.5), np.exp(0.5))
    True

    Source: Modelica.Blocks.Math.Exp.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.exp(self.u)


class Log(SISO):
    """Logarithm, ``y = log(u)/log(base)``; natural by default.

    >>> close([unary(Log(), 0.5), unary(Log(base=2.0), 0.5)], [np.log(0.5), -1.0])
    True

    Source: Modelica.Blocks.Math.Log.
    """

    base: Parameter = Parameter(2.718281828459045, min=0.0, doc="base of the logarithm")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.log(self.u) / ac.log(self.base)


class Exponentiation(SISO):
    """Power of the signal, ``y = u^exponent``.

    >>> unary(Exponentiation(exponent=3.0), 2.0)
    8.0

    Source: Modelica.Blocks.Math.Exponentiation.
    """

    exponent: Parameter = Parameter(2.0, doc="exponent of the power")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u**self.exponent


class Log10(SISO):
    """Logarithm to base 10, ``y = log10(u)``.

    >>> close(unary(Log10(), 0.5), np.log10(0.5))
    True

    Source: Modelica.Blocks.Math.Log10.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == ac.log10(self.u)
