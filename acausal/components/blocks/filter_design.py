"""Poles of low-pass filters, and the sections that make a filter of them: low-pass, high-pass, band-pass, band-stop."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import DeclarationError, Expr, cosh, exp, log, sinh, sqrt

from ...symbolic.expr import as_expr

FILTERS = ("LowPass", "HighPass", "BandPass", "BandStop")
"""Values of `filterType`, as in Modelica.Blocks.Types.FilterType."""


@dataclass(frozen=True, slots=True, eq=False)
class Pole:
    """A pole of a low-pass filter of cut-off 1 rad/s, on the real axis or one of a pair, above it."""

    re: Expr
    im: Expr
    real: bool


def poles(kind: str, order: int, normalized: bool, ripple: Expr) -> list[Pole]:
    """Poles of a low-pass filter of cut-off 1 rad/s: that on the real axis, then those above it, one for each pair.

    Args:
        kind: ``"CriticalDamping"``, ``"Bessel"``, ``"Butterworth"`` or ``"ChebyshevI"``.
        order: number of poles.
        normalized: whether the gain at the cut-off frequency is -3 dB, ``10^(-3/20)``; Butterworth's are as they are.
        ripple: ripple in the pass band of ``"ChebyshevI"`` [dB].

    Source: Tietze and Schenk, Halbleiter-Schaltungstechnik (2002), chapter 13; the scaling and the order of
    Modelica.Blocks.Continuous.Filter.
    """
    from scipy.signal import besselap, buttap

    if order < 1:
        raise DeclarationError(f"`order={order}`: a filter has at least one pole")
    if kind == "ChebyshevI":
        return _chebyshev(order, normalized, ripple)
    designs: dict[str, Callable[[], Any]] = {
        "CriticalDamping": lambda: np.full(order, -1.0), "Bessel": lambda: besselap(order, norm="delay")[1],
        "Butterworth": lambda: buttap(order)[1],
    }  # fmt: skip
    if kind not in designs:
        raise DeclarationError(f"`analogFilter={kind!r}` is none of {', '.join(designs)}, ChebyshevI")
    found = np.asarray(designs[kind](), complex)
    scale = _cutoff(found) if normalized and kind != "Butterworth" else 1.0
    real = [Pole(as_expr(p.real / scale), as_expr(0.0), True) for p in found if abs(p.imag) <= 1e-9]
    above = sorted((p for p in found if p.imag > 1e-9), key=lambda p: p.imag, reverse=kind == "Butterworth")
    return real + [Pole(as_expr(p.real / scale), as_expr(p.imag / scale), False) for p in above]


def _chebyshev(order: int, normalized: bool, ripple: Expr) -> list[Pole]:
    """Poles on an ellipse, the most damped first; the gain at rest is 1."""
    epsilon = sqrt(exp(ripple * (math.log(10.0) / 10)) - 1)
    fac = log(1 / epsilon + sqrt(1 / epsilon**2 + 1)) / order
    scale = as_expr(1.0)
    if normalized:  # where the polynomial of Chebyshev, cosh(order acosh(w)), is as large as -3 dB need
        most = (1 + epsilon**2 if order % 2 == 0 else as_expr(1.0)) * 10**0.3 - 1
        T = sqrt(most) / epsilon
        scale = cosh(log(T + sqrt(T**2 - 1)) / order)
    real = [Pole(-sinh(fac) / scale, as_expr(0.0), True)] if order % 2 else []
    angles = [(i * math.pi if order % 2 else (i - 0.5) * math.pi) / order for i in range(1, order // 2 + 1)]
    return real + [Pole(-sinh(fac) * math.cos(a) / scale, cosh(fac) * math.sin(a) / scale, False) for a in angles]


def _cutoff(found: Any) -> float:
    """Frequency at which the gain, which falls beyond it, is -3 dB against that at rest."""
    from scipy.optimize import brentq

    def excess(logarithm: float) -> float:
        gain = np.prod(np.abs(found) / np.abs(1j * math.exp(logarithm) - found))
        return math.log(gain) + 3.0 / 20.0 * math.log(10.0)

    root: Any = brentq(excess, -20.0, 20.0, xtol=1e-14)
    return math.exp(root)


@dataclass(frozen=True, slots=True, eq=False)
class Section:
    """A pair of poles ``a +- j b``: ``dx1/dt = a x1 - b x2 + ku u``, ``dx2/dt = b x1 + a x2``.

    Attributes:
        a, b: real part and imaginary part [1/s].
        ku: gain of the input, ``(a^2 + b^2)/b``.
        k1, k2: weights of the states in the output.
        through: whether the input is part of the output.
    """

    a: Expr
    b: Expr
    ku: Expr
    k1: Expr
    k2: Expr
    through: bool


def low_pass(pole: Pole, w: Expr) -> Section:
    """``c0/(s^2 + c1 s + c0)`` with the cut-off at `w` [rad/s]: the output is the second state."""
    ku = (pole.re**2 + pole.im**2) / pole.im
    return Section(pole.re * w, pole.im * w, ku * w, as_expr(0.0), as_expr(1.0), False)


def high_pass(pole: Pole, w: Expr) -> Section:
    """``s^2/(s^2 + c1 s + c0)``: the poles are the inverse ones."""
    square = pole.re**2 + pole.im**2
    a, b = pole.re / square, pole.im / square
    ku = (a**2 + b**2) / b
    k2 = (a**2 - b**2) / (a**2 + b**2)
    return Section(a * w, b * w, ku * w, 2 * a / ku, k2, True)


def band(pole: Pole, f_min: Expr, f_max: Expr, *, stop: bool) -> list[Section]:
    """Sections of a band filter for a pole of the low-pass filter: two for a pair of poles, one for a real pole.

    With ``(s + 1/s)/w_band`` in the place of s (band-stop: of 1/s), ``s^2 - 2 q s + 1 = 0``; the section of the higher
    frequency comes first. The gain in the middle of the band is 1, or 0 where it stops: that is the definition, from
    which Modelica.Blocks.Continuous.Filter departs in the gain of a band-pass filter whose poles are not on the unit
    circle and in the zeros of a band-stop filter.
    """
    w, width = 2 * math.pi * sqrt(f_min * f_max), (f_max - f_min) / sqrt(f_min * f_max)
    distance = sqrt(pole.re**2 + pole.im**2)
    part = width / 2 / distance**2 if stop else width / 2
    re, im = pole.re * part, pole.im * part
    if pole.real:
        found = [(re, sqrt(1 - re**2))]
    else:
        d_re, d_im = re**2 - im**2 - 1, 2 * re * im
        size = sqrt(d_re**2 + d_im**2)
        r, i = sqrt((size + d_re) / 2), sqrt((size - d_re) / 2)
        found = [(re - r, im + i), (re + r, i - im)]
    sections: list[Section] = []
    for a, b in found:
        ku = (a**2 + b**2) / b
        if stop:
            k1, k2 = 2 * a / ku, (1 + a**2 - b**2) / (b * ku)
        else:
            k1, k2 = distance * width / ku, distance * width * a / (b * ku)
        sections.append(Section(a * w, b * w, ku * w, k1, k2, stop))
    return sections
