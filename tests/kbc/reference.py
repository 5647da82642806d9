"""The reference crane solved by hand: ordinary differential equations in numpy, integrated by scipy.

Independent of the language, the compiler and the component library: the equations are sorted and reduced on paper.
With the rigid joint the constraint ``x = L(theta) - L0`` is differentiated twice by hand,
``v = h omega`` and ``dv/dt = h domega/dt + h' omega^2``, and the force is eliminated.

All quantities are in SI units; pressures are absolute.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields, replace
from itertools import pairwise
from typing import Final, Literal

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]
Hydraulics = Literal["extended", "simplified"]
Joint = Literal["compliant", "rigid"]
Scenario = Literal["sine", "step", "endstop"]

COLUMNS: Final[dict[tuple[str, str], tuple[str, ...]]] = {
    ("extended", "compliant"): ("Pp", "Q", "P1", "P2", "P3", "Pa", "Pb", "x", "v", "theta", "omega", "ei"),
    ("extended", "rigid"): ("Pp", "Q", "P1", "P2", "P3", "Pa", "Pb", "theta", "omega", "ei"),
    ("simplified", "compliant"): ("x", "theta", "omega", "ei"),
    ("simplified", "rigid"): ("theta", "ei"),
}
"""States of each variant, in the order of the integration."""

_BREAKS: Final[dict[str, tuple[float, ...]]] = {"sine": (), "step": (2.0, 12.0), "endstop": ()}
_NOMINAL: Final = {"Q": 1e-3, "x": 1.0, "v": 1e-1, "theta": 1.0, "omega": 1e-1, "ei": 1e-1}


@dataclass(frozen=True)
class Parameters:
    """The parameter table of the reference crane."""

    rho: float = 850.0
    nu: float = 46e-6
    B: float = 1.2e9
    p_tank: float = 1e5
    V_disp: float = 2.5e-4
    omega_pump: float = 25.0
    p_set: float = 25e6
    dp_pump: float = 1e6
    l: float = 10.0  # noqa: E741
    d: float = 0.038
    eps: float = 5e-5
    V2: float = 5e-4
    V3: float = 1e-3
    Cd: float = 0.65
    p_tr: float = 1e4
    A_leak: float = 1e-9
    A_pcv: float = 4e-4
    p_comp: float = 1e6
    dp_pcv: float = 8e5
    A_dcv: float = 2.2e-4
    r_b: float = 0.8
    r_at: float = 0.4
    A_cbv: float = 4e-4
    o_low: float = 0.3
    u_cb: float = 0.05
    bore: float = 0.25
    rod: float = 0.18
    s: float = 2.0
    Va0: float = 5e-3
    Vb0: float = 5e-3
    m_p: float = 400.0
    c_p: float = 5e4
    k_b: float = 1e8
    c_b: float = 4e5
    k_c: float = 2e8
    c_c: float = 2e6
    m: float = 11000.0
    r: float = 8.0
    I: float = 1.008e6  # noqa: E741
    a: float = 2.0
    b: float = 3.0
    alpha: float = 0.2
    beta: float = 0.3
    L0: float = 2.6
    g: float = 9.81
    Kp: float = 6.0
    Ki: float = 2.0

    @property
    def area_a(self) -> float:
        """Piston area on the bore side [m2]."""
        return np.pi / 4 * self.bore**2

    @property
    def area_b(self) -> float:
        """Piston area on the rod side [m2]."""
        return self.area_a - np.pi / 4 * self.rod**2


SYMBOLS: Final = tuple(f.name for f in fields(Parameters))
"""Every symbol of the parameter table."""


@dataclass(frozen=True)
class Curve:
    """A trajectory.

    Attributes:
        t: times [s], shape (n,).
        columns: by name of the state (and `x`, `v`, `omega` where they are not states), shape (n,).
    """

    t: Array
    columns: dict[str, Array]


def reference_position(scenario: Scenario, t: float) -> float:
    """Piston displacement asked for, x_ref(t) [m]."""
    if scenario == "sine":
        return 1.0 + 0.3 * np.sin(2 * np.pi * 0.05 * t)
    if scenario == "step":
        return 1.0 + 0.2 * (t >= 2.0) - 0.35 * (t >= 12.0)
    return 1.0 + 0.12 * t


def _clip(x: float, low: float, high: float) -> float:
    return low if x < low else high if x > high else x


def orifice(p: Parameters, area: float, dp: float) -> float:
    """Volume flow rate through an orifice [m3/s] (Eq. 13, regularised at zero flow)."""
    return p.Cd * area * np.sqrt(2 / p.rho) * dp / (dp * dp + p.p_tr * p.p_tr) ** 0.25


def pipe_loss(p: Parameters, flow: float) -> float:
    """Friction pressure loss of the pipe [Pa] (Eqs. 11 and 12, blended between Re 2000 and 4000)."""
    speed = flow / (np.pi / 4 * p.d**2)
    reynolds = abs(speed) * p.d / p.nu
    laminar = 32 * p.nu * p.rho * p.l * speed / p.d**2
    if reynolds <= 2000:
        return laminar
    factor = 0.25 / np.log10(p.eps / (3.7 * p.d) + 5.74 / reynolds**0.9) ** 2
    turbulent = factor * p.l / p.d * p.rho / 2 * speed * abs(speed)
    if reynolds >= 4000:
        return turbulent
    k = (reynolds - 2000) / 2000
    weight = k * k * (3 - 2 * k)
    return (1 - weight) * laminar + weight * turbulent


def geometry(p: Parameters, theta: float) -> tuple[float, float, float]:
    """Cylinder length L [m], lever h = dL/dtheta [m] and dh/dtheta [m] (Eq. 17)."""
    gamma = theta + np.pi / 2 - p.alpha - p.beta
    length = np.sqrt(p.a**2 + p.b**2 - 2 * p.a * p.b * np.cos(gamma))
    lever = p.a * p.b * np.sin(gamma) / length
    return length, lever, (p.a * p.b * np.cos(gamma) - lever**2) / length


def start(p: Parameters, hydraulics: Hydraulics, joint: Joint) -> Array:
    """Start values of the states, at rest with the cylinder 1 m out."""
    cosine = (p.a**2 + p.b**2 - (p.L0 + 1.0) ** 2) / (2 * p.a * p.b)
    theta = np.arccos(cosine) - np.pi / 2 + p.alpha + p.beta
    _, lever, _ = geometry(p, theta)
    force = p.m * p.g * p.r * np.cos(theta) / lever
    p_a = (force + p.p_tank * p.area_b) / p.area_a
    values = {
        "Pp": p.p_set, "Q": 0.0, "P1": p.p_set, "P2": p_a + p.p_comp, "P3": p_a, "Pa": p_a, "Pb": p.p_tank,
        "x": 1.0 + force / p.k_c, "v": 0.0, "theta": theta, "omega": 0.0, "ei": 0.0,
    }  # fmt: skip
    return np.array([values[name] for name in COLUMNS[hydraulics, joint]])


def _circuit(p: Parameters, y: Array, u: float, x: float, v: float) -> tuple[list[float], float]:
    """Time derivatives of the seven hydraulic states, and the force of the oil and the bumpers on the piston [N]."""
    p_p, flow, p_1, p_2, p_3, p_a, p_b = (float(value) for value in y[:7])
    up, down = max(u, 0.0), max(-u, 0.0)
    section = np.pi / 4 * p.d**2
    half = p.B / (section * p.l / 2)
    pump = p.V_disp * p.omega_pump * _clip((p.p_set - p_p) / p.dp_pump, 0, 1)
    load = p_3 if u >= -1e-12 else p_b  # u >= 0 but for its rounding: at rest u is 0, and its noise must not decide
    opening = _clip((p.p_comp + p.dp_pcv - (p_2 - load)) / p.dp_pcv, 0, 1)
    pcv = orifice(p, p.A_pcv * opening + p.A_leak, p_1 - p_2)
    p_to_a = orifice(p, p.A_dcv * up + p.A_leak, p_2 - p_3)
    a_to_t = orifice(p, p.r_at * p.A_dcv * down + p.A_leak, p_3 - p.p_tank)
    p_to_b = orifice(p, p.r_b * p.A_dcv * down + p.A_leak, p_2 - p_b)
    b_to_t = orifice(p, p.A_dcv * up + p.A_leak, p_b - p.p_tank)
    cbv = orifice(p, p.A_cbv * (p.o_low + (1 - p.o_low) * _clip(1 + u / p.u_cb, 0, 1)) + p.A_leak, p_3 - p_a)
    bumper = -p.k_b * x - p.c_b * v if x < 0 else -p.k_b * (x - p.s) - p.c_b * v if x > p.s else 0.0
    rates = [
        half * (pump - flow),
        section / (p.rho * p.l) * (p_p - p_1 - pipe_loss(p, flow)),
        half * (flow - pcv),
        p.B / p.V2 * (pcv - p_to_a - p_to_b),
        p.B / p.V3 * (p_to_a - a_to_t - cbv),
        p.B / (p.Va0 + p.area_a * x) * (cbv - p.area_a * v),
        p.B / (p.Vb0 + p.area_b * (p.s - x)) * (p_to_b - b_to_t + p.area_b * v),
    ]
    return rates, p_a * p.area_a - p_b * p.area_b + bumper - p.c_p * v


Field = Callable[[float, Array], list[float]]


def vector_field(p: Parameters, hydraulics: Hydraulics, joint: Joint, scenario: Scenario, at: float) -> Field:
    """Right-hand side ``dy/dt``; the reference is taken on the side of a jump on which `at` lies."""
    gravity = p.m * p.g * p.r

    def control(t: float, x: float, ei: float) -> tuple[float, float]:
        side = t if scenario != "step" else at
        error = reference_position(scenario, side) - x
        return error, _clip(p.Kp * error + p.Ki * ei, -1, 1)

    def compliant_force(x: float, v: float, theta: float, omega: float) -> tuple[float, float]:
        length, lever, _ = geometry(p, theta)
        return p.k_c * (x - (length - p.L0)) + p.c_c * (v - lever * omega), lever

    def extended_compliant(t: float, y: Array) -> list[float]:
        x, v, theta, omega, ei = (float(value) for value in y[7:])
        error, u = control(t, x, ei)
        rates, force = _circuit(p, y, u, x, v)
        joint_force, lever = compliant_force(x, v, theta, omega)
        angular = (joint_force * lever - gravity * np.cos(theta)) / p.I
        return [*rates, v, (force - joint_force) / p.m_p, omega, angular, error]

    def extended_rigid(t: float, y: Array) -> list[float]:
        theta, omega, ei = (float(value) for value in y[7:])
        length, lever, slope = geometry(p, theta)
        x, v = length - p.L0, lever * omega
        error, u = control(t, x, ei)
        rates, force = _circuit(p, y, u, x, v)
        torque = (force - p.m_p * slope * omega**2) * lever - gravity * np.cos(theta)
        return [*rates, omega, torque / (p.I + p.m_p * lever**2), error]

    def simplified_compliant(t: float, y: Array) -> list[float]:
        x, theta, omega, ei = (float(value) for value in y)
        error, u = control(t, x, ei)
        v = u * p.V_disp * p.omega_pump / p.area_a
        joint_force, lever = compliant_force(x, v, theta, omega)
        return [v, omega, (joint_force * lever - gravity * np.cos(theta)) / p.I, error]

    def simplified_rigid(t: float, y: Array) -> list[float]:
        theta, ei = (float(value) for value in y)
        length, lever, _ = geometry(p, theta)
        error, u = control(t, length - p.L0, ei)
        return [u * p.V_disp * p.omega_pump / p.area_a / lever, error]

    if hydraulics == "extended":
        return extended_compliant if joint == "compliant" else extended_rigid
    return simplified_compliant if joint == "compliant" else simplified_rigid


def _jacobian(field: Field, steps: Array) -> Callable[[float, Array], Array]:
    """Central differences with fixed steps (scipy's adaptive ones overflow where a signal is at its limit)."""

    def jacobian(t: float, y: Array) -> Array:
        shifts = np.diag(steps)
        return np.stack(
            [(np.array(field(t, y + e)) - np.array(field(t, y - e))) / (2 * e.sum()) for e in shifts], axis=1
        )

    return jacobian


def solve(
    hydraulics: Hydraulics,
    joint: Joint,
    scenario: Scenario,
    t: Array,
    *,
    rtol: float = 1e-9,
    method: str = "LSODA",
    **symbols: float,
) -> Curve:
    """The trajectory of one variant.

    Args:
        hydraulics: ``extended`` (12 or 10 states) or ``simplified`` (4 or 2).
        joint: ``compliant`` or ``rigid``.
        scenario: ``sine``, ``step`` or ``endstop``.
        t: increasing times at which the states are wanted [s], the first one the start, shape (n,).
        rtol: relative tolerance; the absolute one is `rtol` times the magnitude of the state.
        method: a method of `scipy.integrate.solve_ivp` for stiff systems.
        **symbols: values of the parameter table that differ from the reference.

    Returns:
        The states, and x.
    """
    p = replace(Parameters(), **symbols)
    names = COLUMNS[hydraulics, joint]
    y = start(p, hydraulics, joint)
    nominal = np.array([_NOMINAL.get(name, 1e6) for name in names])
    values = np.empty((len(t), len(names)))
    values[0] = y
    edges = [float(t[0]), *(s for s in _BREAKS[scenario] if t[0] < s < t[-1]), float(t[-1])]
    for begin, end in pairwise(edges):
        inside = (t > begin) & (t <= end)
        field = vector_field(p, hydraulics, joint, scenario, 0.5 * (begin + end))
        wanted = np.unique([*t[inside], end])
        result = solve_ivp(
            field,
            (begin, end),
            y,
            method=method,
            t_eval=wanted,
            rtol=rtol,
            atol=rtol * nominal,
            jac=None if method == "LSODA" else _jacobian(field, 1e-6 * nominal),
        )
        if not result.success:
            raise RuntimeError(result.message)
        values[inside] = result.y.T[np.isin(wanted, t[inside])]
        y = result.y[:, -1]
    columns = {name: values[:, i] for i, name in enumerate(names)}
    if "x" not in columns:
        columns["x"] = np.array([geometry(p, theta)[0] - p.L0 for theta in columns["theta"]])
    return Curve(t, columns)


def spread(curve: Array) -> float:
    """Range of a column: the scale that differences are judged by."""
    return float(curve.max() - curve.min()) or 1.0
