"""What the crane's tests share."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

VARIANTS: Final = (
    ("simplified", "rigid"),
    ("simplified", "compliant"),
    ("extended", "rigid"),
    ("extended", "compliant"),
)
"""Hydraulics and joint of the four variants."""


def read_curve(hydraulics: str, joint: str) -> tuple[Floats, dict[str, Floats]]:
    """Times and columns of a published curve of the scenario *sine*."""
    path = Path(__file__).parent / "data" / f"sine_{hydraulics}-{joint}.csv"
    names = path.read_text(encoding="utf-8").splitlines()[0].split(",")
    values = np.loadtxt(path, delimiter=",", skiprows=1)
    return values[:, 0], {name: values[:, i] for i, name in enumerate(names) if i}
