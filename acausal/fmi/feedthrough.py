"""What depends on inputs at the same instant, by the structure of the equations."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..language.template import Ints
from ..lowering.lowered import Lowered


def depends_at_once(lowered: Lowered, variables: Any, parameters: Any, places: Ints) -> bool:
    """Whether something made of variables and parameters depends on some entries of the parameter vector at once.

    Args:
        lowered: the system.
        variables: numbers of its reduced variables.
        parameters: numbers of entries of its parameter vector.
        places: entries that inputs give.
    """
    if np.isin(parameters, places).any():
        return True
    ids = np.unique(np.ravel(variables))
    groups = lowered.closure(ids, residuals=False)
    reached = {int(v) for k in groups for v in lowered.schedule.groups[k].var_rows.ravel()} | set(ids.tolist())
    if reached & set(lowered.schedule.tears.tolist()):
        groups = lowered.closure(ids, residuals=True)
    return any(np.isin(lowered.schedule.groups[k].par_rows, places).any() for k in groups)
