"""Solving: integrators, sparse linear algebra, and the trajectories that come out.

Everything here is loaded on first use, so that `import acausal` does not load JAX.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .linear_solvers import AbstractLinearSolver as AbstractLinearSolver
    from .linear_solvers import DenseLU as DenseLU
    from .lowered import Lowered as Lowered
    from .projection import Projected as Projected
    from .rk4 import RK4 as RK4
    from .rodas5p import Rodas5P as Rodas5P
    from .solution import Solution as Solution
    from .sparse import SparseKLU as SparseKLU
    from .sparse import SparsityPattern as SparsityPattern

_PLACES = {
    "AbstractLinearSolver": "linear_solvers",
    "DenseLU": "linear_solvers",
    "Lowered": "lowered",
    "Projected": "projection",
    "RK4": "rk4",
    "Rodas5P": "rodas5p",
    "Solution": "solution",
    "SparseKLU": "sparse",
    "SparsityPattern": "sparse",
}
# `jit` and `simulate` are also the names of their modules: `from acausal.simulation.jit import jit`.


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(importlib.import_module(f".{_PLACES[name]}", __name__), name)
