"""Closed-form solutions that the benchmarks check against (numpy only: the peers' environments use them too)."""

import numpy as np
import numpy.typing as npt


def ladder_voltage(
    node: int, cells: int, t: npt.NDArray[np.float64], resistance: float = 1.0, capacitance: float = 1.0
) -> npt.NDArray[np.float64]:
    r"""Voltage of one node of a uniform RC ladder after a unit step, open at the far end.

    $v_k(t) = 1 - \frac{2}{2N+1} \sum_{j=1}^{N} \cot\frac{\theta_j}{2} \sin(k\theta_j)
    e^{-4 \sin^2(\theta_j/2)\, t / (r c)}$ with $\theta_j = (2j-1)\pi/(2N+1)$, $r = R/N$ and $c = C/N$: the modes of the
    second-difference matrix with one fixed and one free end (Strang, Computational Science and Engineering, 1.5).

    Args:
        node: which node, 1 (next to the source) .. `cells` (the open end).
        cells: number of cells N.
        t: times [s], shape (n,).
        resistance: of the whole line [ohm]; each cell has 1/N of it.
        capacitance: of the whole line [F]; each cell has 1/N of it.

    Returns:
        Voltages [V], shape (n,).
    """
    theta = (2 * np.arange(1, cells + 1) - 1) * np.pi / (2 * cells + 1)
    weight = 2 / (2 * cells + 1) * np.sin(node * theta) / np.tan(theta / 2)
    rate = 4 * np.sin(theta / 2) ** 2 * cells**2 / (resistance * capacitance)
    return np.array([1.0 - float(np.sum(weight * np.exp(-rate * moment))) for moment in t])


def ladder_nodes(cells: int) -> tuple[int, ...]:
    """The nodes that a run is judged on: the first, the middle one and the open end."""
    return (1, max(1, cells // 2), cells)


def chain_displacement(
    cell: int, cells: int, t: npt.NDArray[np.float64], stiffness: float = 1.0, damping: float = 0.02, mass: float = 1.0
) -> npt.NDArray[np.float64]:
    r"""Displacement of one cell of a bar fixed at one end and pulled with 1 N at the other from rest.

    Each cell is a mass $m = M/N$ behind a spring $c = C N$ and a damper $d = D N$ in parallel. The modes are those of
    `ladder_voltage` and the damping is proportional, so each mode is an oscillator
    $\ddot q + (d \lambda_j / m) \dot q + (c \lambda_j / m) q = g_j / m$ with $\lambda_j = 4 \sin^2(\theta_j / 2)$.

    Args:
        cell: which one, 1 (next to the wall) .. `cells` (the pulled end).
        cells: number of cells N.
        t: times [s], shape (n,).
        stiffness: of the whole bar, C [N/m].
        damping: of the whole bar, D [N s/m].
        mass: of the whole bar, M [kg].

    Returns:
        Displacements [m], shape (n,).
    """
    theta = (2 * np.arange(1, cells + 1) - 1) * np.pi / (2 * cells + 1)
    rate = 4 * np.sin(theta / 2) ** 2 * cells / (mass / cells)
    static = 4 / (2 * cells + 1) * np.sin(cells * theta) * np.sin(cell * theta) * cells / mass / (stiffness * rate)
    half = damping * rate / 2
    fast = -half - np.sqrt((half**2 - stiffness * rate).astype(np.complex128))
    slow = stiffness * rate / fast
    return np.array(
        [
            float(np.sum(static * (1 + (fast * np.exp(slow * s) - slow * np.exp(fast * s)) / (slow - fast))).real)
            for s in t
        ]
    )
