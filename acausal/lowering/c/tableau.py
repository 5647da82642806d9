"""Coefficients of Rodas5P as C."""

from __future__ import annotations

import numpy as np

from ...simulation import rodas5p_tableau as tableau
from .text import array, number


def tableau_lines() -> list[str]:
    """Coefficients of the method."""

    def rows(a: np.ndarray) -> str:
        return ", ".join("{" + ", ".join(number(v) for v in row) + "}" for row in a.tolist())

    return [
        f"static const double ac_gamma = {tableau.GAMMA!r};",
        f"static const double ac_A[8][8] = {{{rows(tableau.A)}}};",
        f"static const double ac_C[8][8] = {{{rows(tableau.C)}}};",
        f"static const double ac_H[3][8] = {{{rows(tableau.H)}}};",
        array("double", "ac_B", tableau.B.tolist()),
        array("double", "ac_nodes", tableau.NODES.tolist()),
        array("double", "ac_D", tableau.D.tolist()),
    ]
