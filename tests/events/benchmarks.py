"""Hybrid systems whose event times are known: models, random parameters, and the times by a closed form."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq

import acausal as ac
from acausal import Component, Discrete, Equations, Parameter, Variable, connect, der, pre, reinit, start, when
from acausal.components import electrical, translational

Values = dict[str, float]


@dataclass(frozen=True)
class Known:
    """A hybrid system with known event times.

    Attributes:
        model: without random values.
        draw: random parameters and start values, and the end of the run.
        times: of the events, from parameters and start values.
    """

    model: Callable[[], Component]
    draw: Callable[[np.random.Generator], tuple[Values, Values, float]]
    times: Callable[[Values, Values, float], np.ndarray]


class BouncingBall(Component):
    """A ball above a floor; it comes back with the part `e` of its speed."""

    h: Variable = Variable(unit="m", start=1.0, fixed=True)
    v: Variable = Variable(unit="m/s", start=0.0, fixed=True)
    g: Parameter = Parameter(9.81, unit="m/s2")
    e: Parameter = Parameter(0.7, unit="1")
    bounces: Discrete = Discrete(start=0)
    last: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.h) == self.v
        yield der(self.v) == -self.g
        yield when(
            self.h < 0,
            reinit(self.v, -self.e * pre(self.v)),
            {self.bounces: pre(self.bounces) + 1, self.last: ac.time},
        )


def draw_ball(rng: np.random.Generator) -> tuple[Values, Values, float]:
    """Between 2 and about 12 bounces."""
    g, e = 10 ** rng.uniform(-1, 3), rng.uniform(0.3, 0.95)
    h, up = 10 ** rng.uniform(-3, 3), rng.uniform(-1.0, 1.0)
    v = up * np.sqrt(2 * g * h)
    first, speed = (v + np.sqrt(v * v + 2 * g * h)) / g, np.sqrt(v * v + 2 * g * h)
    flights = 2 * speed / g * e ** np.arange(1, int(rng.integers(2, 13)))
    return {"g": g, "e": e}, {"h": h, "v": v}, float(first + flights[:-1].sum() + rng.uniform(0.1, 0.9) * flights[-1])


def ball_times(p: Values, x: Values, t1: float) -> np.ndarray:
    """Times at which the ball meets the floor: free fall, then parabolas of a geometric series of speeds."""
    speed = np.sqrt(x["v"] ** 2 + 2 * p["g"] * x["h"])
    times = [(x["v"] + speed) / p["g"]]
    while times[-1] <= t1:
        speed *= p["e"]
        times.append(times[-1] + 2 * speed / p["g"])
    return np.array(times[:-1])


class StickSlip(Component):
    """A mass on a belt, held by a spring: it rides on the belt, tears off, and slides back."""

    v_belt: Parameter = Parameter(0.1, unit="m/s")
    belt: translational.ConstantSpeed = translational.ConstantSpeed(v_fixed=v_belt)
    friction: translational.SupportFriction = translational.SupportFriction(useSupport=True)
    mass: translational.Mass = translational.Mass(m=1.0, s=start(0.0, fixed=True), v=start(v_belt, fixed=True))
    spring: translational.Spring = translational.Spring(c=10.0)
    wall: translational.Fixed = translational.Fixed()

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange_a)
        yield connect(self.mass.flange_b, self.friction.flange_a)
        yield connect(self.belt.flange, self.friction.support)


def draw_stick_slip(rng: np.random.Generator) -> tuple[Values, Values, float]:
    """Between 2 and 5 periods."""
    m, c, v = (10 ** rng.uniform(-1, 1, 3)).tolist()
    w = np.sqrt(c / m)
    # the friction (of 1 N while sliding) stretches the spring by 1/c; the peak adds some part of the swing v/w
    peak = 1.0 + rng.uniform(0.05, 2.0) * v / w * c
    values = {"mass.m": m, "spring.c": c, "v_belt": v, "friction.peak": peak}
    stick, slip = stick_slip_spans(values)
    return values, {"mass.s": 0.0}, float(peak / c / v + rng.uniform(2, 5) * (stick + slip))


def stick_slip_spans(p: Values) -> tuple[float, float]:
    """How long the mass rides on the belt and slides in each period [s], with a sliding friction of 1 N."""
    c, v, w = p["spring.c"], p["v_belt"], np.sqrt(p["spring.c"] / p["mass.m"])
    away = (p["friction.peak"] - 1.0) / c  # from the middle of the swing to where it tears off
    return 2 * away / v, (2 * np.pi - 2 * np.arctan2(away * w, v)) / w


def stick_slip_times(p: Values, x: Values, t1: float) -> np.ndarray:
    """Times at which the mass tears off, slows down to rest, and is caught: sines about the stretch of the friction."""
    stick, slip = stick_slip_spans(p)
    times = [(p["friction.peak"] / p["spring.c"] - x["mass.s"]) / p["v_belt"]]
    while times[-1] <= t1:
        times.append(times[-1] + (slip, stick)[len(times) % 2 == 0])
    return np.array(times[:-1])


class FullWave(Component):
    """A bridge of four ideal diodes charges a capacitor with a load."""

    source: electrical.SineVoltage = electrical.SineVoltage(V=10.0, f=1.0)
    d1: electrical.IdealDiode = electrical.IdealDiode(Ron=0.1, Goff=1e-4, Vknee=0.2)
    d2: electrical.IdealDiode = electrical.IdealDiode(Ron=0.1, Goff=1e-4, Vknee=0.2)
    d3: electrical.IdealDiode = electrical.IdealDiode(Ron=0.1, Goff=1e-4, Vknee=0.2)
    d4: electrical.IdealDiode = electrical.IdealDiode(Ron=0.1, Goff=1e-4, Vknee=0.2)
    capacitor: electrical.Capacitor = electrical.Capacitor(C=0.1, v=start(0.0, fixed=True))
    load: electrical.Resistor = electrical.Resistor(R=10.0)
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.d1.p, self.d4.n)
        yield connect(self.source.n, self.d2.p, self.d3.n)
        yield connect(self.d1.n, self.d2.n, self.capacitor.p, self.load.p)
        yield connect(self.d3.p, self.d4.p, self.capacitor.n, self.load.n, self.ground.p)


def draw_full_wave(rng: np.random.Generator) -> tuple[Values, Values, float]:
    """Two to six half-waves."""
    V, f, R = 10 ** rng.uniform(0.5, 2), 10 ** rng.uniform(-1, 2), 10 ** rng.uniform(0, 2)
    values = {"source.V": V, "source.f": f, "load.R": R, "capacitor.C": 10 ** rng.uniform(-1, 1) / (R * f)}
    return values, {"capacitor.v": rng.uniform(0.0, 0.9) * V}, float(rng.uniform(1, 3) / f)


def full_wave_times(p: Values, x: Values, t1: float) -> np.ndarray:
    """Times at which diodes begin or cease to conduct.

    By symmetry opposite diodes carry the same current, and the ends of the source are at ``(v + u)/2`` and
    ``(v - u)/2``: diodes 1 and 3 have the voltage ``(u - v)/2``, 2 and 4 ``(-u - v)/2``. In each state of the diodes
    ``C v' = a - b v + c sin(w t)``, which is solved in closed form.
    """
    V, w, C, R = p["source.V"], 2 * np.pi * p["source.f"], p["capacitor.C"], p["load.R"]
    Ron, Goff, knee = 0.1, 1e-4, 0.2
    v, t, times, forward = x["capacitor.v"], 0.0, [], 0

    def diode(on: bool) -> tuple[float, float]:
        """Slope and offset of its current."""
        return (1 / Ron, -knee / Ron + Goff * knee) if on else (Goff, 0.0)

    def solution(mode: int, t0: float, v0: float) -> tuple[Callable[[float], float], Callable[[float], float]]:
        """Voltage of the capacitor from (t0, v0) on, and how far it is beyond the next change of the mode."""
        (g, i0), (h, j0) = diode(mode == 1), diode(mode == -1)
        a, b, c = i0 + j0, (g + h) / 2 + 1 / R, (g - h) / 2 * V
        rate = b / C

        def steady(t: float) -> float:
            return a / b + c / C * (rate * np.sin(w * t) - w * np.cos(w * t)) / (rate**2 + w**2)

        def curve(t: float) -> float:
            return steady(t) + (v0 - steady(t0)) * np.exp(-rate * (t - t0))

        def beyond(t: float) -> float:
            u = V * np.sin(w * t)
            return (abs(u) - curve(t)) / 2 - knee if mode == 0 else knee - (mode * u - curve(t)) / 2

        return curve, beyond

    step = 0.002 * 2 * np.pi / w
    while True:
        curve, margin = solution(forward, t, v)
        here = t + 1e-9 * step
        while here < t1 and margin(here + step) <= 0.0:
            here += step
        found = brentq(margin, here, here + step, xtol=1e-15, rtol=1e-14) if here < t1 else np.inf
        if found > t1:
            return np.array(times)
        times.append(found)
        v, t = curve(found), found
        forward = 0 if forward else int(np.sign(np.sin(w * found)))


KNOWN: dict[str, Known] = {
    "ball": Known(BouncingBall, draw_ball, ball_times),
    "stick_slip": Known(StickSlip, draw_stick_slip, stick_slip_times),
    "full_wave": Known(FullWave, draw_full_wave, full_wave_times),
}
