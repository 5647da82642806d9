"""Switched-mode converters from ideal switches and diodes, and their exact solutions, written by hand.

All have one inductor current i and one output voltage v. Between two switchings they are linear,
``[i, v]' = A [i, v] + b``; the switch and the diode are conductances gs and gd, and the diode conducts where the
current is above a threshold that depends on the switch and on v.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.linalg import expm
from scipy.optimize import brentq

from acausal import Component, Equations, Parameter, connect, start
from acausal.components import blocks, electrical

RON, GOFF = 1e-2, 1e-4
"""Of switches and diodes."""


class Converter(Component, partial=True):
    """Supply, switch, diode, output capacitor with load, and the pulses that close the switch."""

    V: Parameter = Parameter(24.0, unit="V", doc="supply")
    C: Parameter = Parameter(2e-5, unit="F", doc="output capacitance")
    R: Parameter = Parameter(10.0, unit="ohm", doc="load")
    source: electrical.ConstantVoltage = electrical.ConstantVoltage(V=V)
    switch: electrical.IdealClosingSwitch = electrical.IdealClosingSwitch(Ron=RON, Goff=GOFF)
    diode: electrical.IdealDiode = electrical.IdealDiode(Ron=RON, Goff=GOFF)
    capacitor: electrical.Capacitor = electrical.Capacitor(C=C, v=start(0.0, fixed=True))
    load: electrical.Resistor = electrical.Resistor(R=R)
    ground: electrical.Ground = electrical.Ground()
    pulses: blocks.BooleanPulse = blocks.BooleanPulse(width=40.0, period=1e-4)

    def equations(self) -> Equations:
        yield connect(self.pulses.y, self.switch.control)
        yield connect(self.capacitor.p, self.load.p)
        yield connect(self.source.n, self.capacitor.n, self.load.n, self.ground.p)


class Buck(Converter):
    """Step-down converter."""

    L: Parameter = Parameter(2e-4, unit="H")
    inductor: electrical.Inductor = electrical.Inductor(L=L, i=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.source.p, self.switch.p)
        yield connect(self.switch.n, self.diode.n, self.inductor.p)
        yield connect(self.inductor.n, self.capacitor.p)
        yield connect(self.diode.p, self.ground.p)


class Boost(Converter):
    """Step-up converter."""

    L: Parameter = Parameter(2e-4, unit="H")
    inductor: electrical.Inductor = electrical.Inductor(L=L, i=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.source.p, self.inductor.p)
        yield connect(self.inductor.n, self.switch.p, self.diode.p)
        yield connect(self.diode.n, self.capacitor.p)
        yield connect(self.switch.n, self.ground.p)


class Flyback(Converter):
    """Converter with an isolating transformer, whose magnetizing inductance stores the energy."""

    n: Parameter = Parameter(2.0, unit="1", doc="turns ratio")
    L: Parameter = Parameter(2e-4, unit="H", doc="magnetizing inductance")
    transformer: electrical.IdealTransformer = electrical.IdealTransformer(
        n=n, considerMagnetization=True, Lm1=L, im1=start(0.0, fixed=True)
    )

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.source.p, self.transformer.p1)
        yield connect(self.transformer.n1, self.switch.p)
        yield connect(self.transformer.n2, self.diode.p)
        yield connect(self.diode.n, self.capacitor.p)
        yield connect(self.switch.n, self.transformer.p2, self.ground.p)


@dataclass(frozen=True)
class Values:
    """Parameters of a converter and conductances of its switch and diode."""

    V: float = 24.0
    L: float = 2e-4
    C: float = 2e-5
    R: float = 10.0
    n: float = 2.0
    gs: float = 0.0
    gd: float = 0.0


Linear = tuple[np.ndarray, np.ndarray]


def buck(p: Values) -> tuple[Linear, np.ndarray]:
    """``A, b`` and the threshold of the diode's conduction as ``c0 + c1 v``; node: ``gs (V - u) - gd u = i``."""
    g = p.gs + p.gd
    A = np.array([[-1 / (g * p.L), -1 / p.L], [1 / p.C, -1 / (p.R * p.C)]])
    return (A, np.array([p.gs * p.V / (g * p.L), 0.0])), np.array([p.gs * p.V, 0.0])


def boost(p: Values) -> tuple[Linear, np.ndarray]:
    """Node: ``i = gs u + gd (u - v)``."""
    g = p.gs + p.gd
    A = np.array([[-1 / (g * p.L), -p.gd / (g * p.L)],
                  [p.gd / (g * p.C), -p.gs * p.gd / (g * p.C) - 1 / (p.R * p.C)]])  # fmt: skip
    return (A, np.array([p.V / p.L, 0.0])), np.array([0.0, p.gs])


def flyback(p: Values) -> tuple[Linear, np.ndarray]:
    """Primary voltage u: ``gs (V - u) = i + gd (u/n + v)/n``; the diode has ``-u/n - v``."""
    g = p.gs + p.gd / p.n**2
    of_u, constant = np.array([-1.0, -p.gd / p.n]) / g, p.gs * p.V / g  # u = of_u [i, v] + constant
    through = -p.gd * (of_u / p.n + np.array([0.0, 1.0])) / p.C
    A = np.stack([of_u / p.L, through + np.array([0.0, -1 / (p.R * p.C)])])
    return (A, np.array([constant / p.L, -p.gd * constant / (p.n * p.C)])), np.array([p.gs * p.V, p.gs * p.n])


MODELS: dict[str, tuple[Component, str, Callable[[Values], tuple[Linear, np.ndarray]]]] = {
    "buck": (Buck(), "inductor.i", buck),
    "boost": (Boost(), "inductor.i", boost),
    "flyback": (Flyback(), "transformer.im1", flyback),
}


def step(linear: Linear, t: float) -> np.ndarray:
    """Matrix that takes ``[x, 1]`` over a time t with ``x' = A x + b``."""
    whole = np.zeros((3, 3))
    whole[:2, :2], whole[:2, 2] = linear
    return expm(whole * t)


def moved(linear: Linear, x: np.ndarray, t: float) -> np.ndarray:
    """Solution of ``x' = A x + b`` after t."""
    return (step(linear, t) @ np.append(x, 1.0))[:2]


def solved(
    law: Callable[[Values], tuple[Linear, np.ndarray]], p: Values, t1: float, width: float, period: float
) -> tuple[np.ndarray, list[float]]:
    """Current and voltage at t1, and all times at which the switch or the diode switches."""
    edges = sorted({k * period + s for k in range(int(t1 / period) + 1) for s in (0.0, width * period)} - {0.0})
    stops = [e for e in edges if e < t1] + [t1]
    t, x, events = 0.0, np.zeros(2), list[float]()
    for k, stop in enumerate(stops):
        gs = 1 / RON if k % 2 == 0 else GOFF

        def beyond(at: np.ndarray, gs: float = gs) -> float:
            c = law(_with(p, gs, GOFF))[1]
            return at[0] - c[0] - c[1] * at[1]

        on = beyond(x) >= 0.0
        while t < stop:
            linear, _ = law(_with(p, gs, 1 / RON if on else GOFF))
            grid = np.linspace(0.0, stop - t, 41)[1:]
            one, z, sides = step(linear, grid[0]), np.append(x, 1.0), np.zeros(len(grid), bool)
            for k_grid in range(len(grid)):
                z = one @ z
                sides[k_grid] = beyond(z) > 0.0
            if (sides == on).all():
                x, t = z[:2], stop
                break
            last = int(np.argmax(sides != on))
            low = grid[last - 1] if last else 1e-6 * grid[0]
            at: Any = brentq(lambda s, f=linear, x=x, b=beyond: b(moved(f, x, s)), low, grid[last], xtol=1e-18)
            x, t, on = moved(linear, x, at), t + at, not on
            events.append(t)
        if stop < t1:
            events.append(stop)
    return x, events


def _with(p: Values, gs: float, gd: float) -> Values:
    return Values(p.V, p.L, p.C, p.R, p.n, gs, gd)
