"""Conditions at one point of a run: how far they are from their switch."""

from __future__ import annotations

from typing import Any

import numpy as np

from acausal.lowering.hybrid import Hybrid, Point

from .mode_search import Equations
from .native_library import Floats


def sides(hybrid: Hybrid, equations: Equations, t: float, z: Floats, p: Floats) -> Floats:
    """How far each condition is on the other side than its mode says; (n_roots,)."""
    p = p.copy()
    equations.feed(t, p)
    point = Point(t, equations.values(t, z, p), p)
    g = np.concatenate([np.zeros(0), *(piece.values(point)[0] for piece in hybrid.root_pieces)])
    return np.where(modes(hybrid, p), g, -g)


def modes(hybrid: Hybrid, p: Floats) -> Any:
    """Whether each condition is to hold, (n_roots,)."""
    slots = hybrid.roots.slots
    return (slots < 0) | (p[np.maximum(slots, 0)] != 0.0)
