"""The knuckle boom crane of the case study, causalised by hand: a stiff 12-state scalar-code vector field for tests."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np

RHO, NU, BULK, P_TANK = 850.0, 46e-6, 1.2e9, 1e5
DISP, OMEGA, P_SET, DP_PUMP = 2.5e-4, 25.0, 25e6, 1e6
LENGTH, DIAMETER, ROUGHNESS, V2, V3 = 10.0, 0.038, 5e-5, 5e-4, 1e-3
CD, P_TR, A_LEAK = 0.65, 1e4, 1e-9
A_PCV, P_COMP, DP_PCV = 4e-4, 1e6, 8e5
A_DCV, R_B, R_AT = 2.2e-4, 0.8, 0.4
A_CBV, O_LOW, U_CB = 4e-4, 0.3, 0.05
BORE, ROD, STROKE, VA0, VB0 = 0.25, 0.18, 2.0, 5e-3, 5e-3
M_P, C_P, K_B, C_B, K_C, C_C = 400.0, 5e4, 1e8, 4e5, 2e8, 2e6
MASS, RADIUS, INERTIA = 11000.0, 8.0, 1.008e6
ARM_A, ARM_B, ALPHA, BETA, L0, GRAVITY = 2.0, 3.0, 0.2, 0.3, 2.6, 9.81
KP, KI = 6.0, 2.0
AREA_A = np.pi / 4 * BORE**2
AREA_B = AREA_A - np.pi / 4 * ROD**2
AREA_PIPE = np.pi / 4 * DIAMETER**2

NAMES = ("Pp", "Q", "P1", "P2", "P3", "Pa", "Pb", "x", "v", "theta", "omega", "ei")
NOMINAL = np.array([1e7, 1e-3, 1e7, 1e7, 1e7, 1e7, 1e7, 1.0, 0.1, 1.0, 0.1, 1.0])


def _orifice(area, dp):
    return CD * area * np.sqrt(2 / RHO) * dp / jnp.sqrt(jnp.sqrt(dp * dp + P_TR * P_TR))


def _friction(flow):
    w = flow / AREA_PIPE
    speed = jnp.abs(w)
    re = speed * DIAMETER / NU
    laminar = 32 * NU * RHO * LENGTH * w / DIAMETER**2
    safe = jnp.maximum(re, 1000.0)
    log = jnp.log10(ROUGHNESS / (3.7 * DIAMETER) + 5.74 / safe**0.9)
    turbulent = 0.25 / (log * log) * LENGTH / DIAMETER * RHO / 2 * w * speed
    k = jnp.clip((re - 2000) / 2000, 0.0, 1.0)
    s = k * k * (3 - 2 * k)
    return (1 - s) * laminar + s * turbulent


def _geometry(theta):
    gamma = theta + np.pi / 2 - ALPHA - BETA
    length = jnp.sqrt(ARM_A**2 + ARM_B**2 - 2 * ARM_A * ARM_B * jnp.cos(gamma))
    return length, ARM_A * ARM_B * jnp.sin(gamma) / length


def crane(t, y, args=None):
    """Vector field of the extended, compliant crane on the scenario *sine*; `y` as `NAMES`, shape (12,), SI units."""
    pp, q, p1, p2, p3, pa, pb, x, v, theta, omega, ei = (y[i] for i in range(12))
    bulk = BULK if args is None else args
    length, lever = _geometry(theta)
    e = 1 + 0.3 * jnp.sin(2 * np.pi * 0.05 * t) - x
    u = jnp.clip(KP * e + KI * ei, -1.0, 1.0)
    up, um = jnp.maximum(u, 0.0), jnp.maximum(-u, 0.0)
    q_pump = DISP * OMEGA * jnp.clip((P_SET - pp) / DP_PUMP, 0.0, 1.0)
    p_ls = jnp.where(u >= 0, p3, pb)
    q_pcv = _orifice(A_PCV * jnp.clip((P_COMP + DP_PCV - (p2 - p_ls)) / DP_PCV, 0.0, 1.0) + A_LEAK, p1 - p2)
    q_pa = _orifice(A_DCV * up + A_LEAK, p2 - p3)
    q_at = _orifice(A_DCV * R_AT * um + A_LEAK, p3 - P_TANK)
    q_pb = _orifice(A_DCV * R_B * um + A_LEAK, p2 - pb)
    q_bt = _orifice(A_DCV * up + A_LEAK, pb - P_TANK)
    q_cb = _orifice(A_CBV * (O_LOW + (1 - O_LOW) * jnp.clip(1 + u / U_CB, 0.0, 1.0)) + A_LEAK, p3 - pa)
    bumper = jnp.where(x < 0, -K_B * x - C_B * v, jnp.where(x > STROKE, -K_B * (x - STROKE) - C_B * v, 0.0))
    force = pa * AREA_A - pb * AREA_B + bumper - C_P * v
    joint = K_C * (x - (length - L0)) + C_C * (v - lever * omega)
    volume = AREA_PIPE * LENGTH
    return jnp.stack(
        [
            bulk / (volume / 2) * (q_pump - q),
            AREA_PIPE / (RHO * LENGTH) * (pp - p1 - _friction(q)),
            bulk / (volume / 2) * (q - q_pcv),
            bulk / V2 * (q_pcv - q_pa - q_pb),
            bulk / V3 * (q_pa - q_at - q_cb),
            bulk / (VA0 + AREA_A * x) * (q_cb - AREA_A * v),
            bulk / (VB0 + AREA_B * (STROKE - x)) * (q_pb - q_bt + AREA_B * v),
            v,
            (force - joint) / M_P,
            omega,
            (joint * lever - MASS * GRAVITY * RADIUS * jnp.cos(theta)) / INERTIA,
            e,
        ]
    )


def crane_start() -> jax.Array:
    """State at t = 0: everything at rest at x = 1 m, shape (12,)."""
    lo, hi = 0.0, 1.2
    for _ in range(100):
        mid = (lo + hi) / 2
        lo, hi = (lo, mid) if float(_geometry(mid)[0]) - L0 > 1 else (mid, hi)
    lever = float(_geometry(lo)[1])
    force = MASS * GRAVITY * RADIUS * np.cos(lo) / lever
    pa = (force + P_TANK * AREA_B) / AREA_A
    return jnp.array([P_SET, 0, P_SET, pa + P_COMP, pa, pa, P_TANK, 1 + force / K_C, 0, lo, 0, 0])
