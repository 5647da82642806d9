"""Index reduction for systems whose structure hides a dependence between equations."""

from __future__ import annotations

import numpy as np

from .aliases import Reduced
from .structure import IndexReduced, reduce_index


def regularize(reduced: Reduced, parameters: np.ndarray) -> IndexReduced:
    """Reduce the index."""
    del parameters
    return reduce_index(reduced)
