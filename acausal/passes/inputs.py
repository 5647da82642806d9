"""Inputs of the whole model: each is equal to an entry behind the parameters, which the run feeds."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from ..errors import UnknownNameError, nearest
from ..language.flat_model import Family, FlatModel, Source
from ..symbolic.equation import Origin
from ..symbolic.expr import add, neg, par, var


def input_equations(flat: FlatModel, inputs: Sequence[str], outputs: Sequence[str]) -> FlatModel:
    """`flat` with an equation for every input of the model.

    Raises:
        UnknownNameError: `inputs` or `outputs` name something the model does not have.
    """
    names = [flat.name(int(v)) for v in flat.inputs]
    for name in inputs:
        if name not in names:
            raise UnknownNameError(
                f"`{name}` is not an `Input` of the model `{flat.model_name}` itself (it has: "
                f"{', '.join(names) or 'none'})."
                f"{nearest(name, names)}"
            )
    for name in outputs:
        flat.names.find(name, parameter=False)
    if not len(flat.inputs):
        return flat
    cls = flat.root.cls
    flat.sources.append(Source(Origin(cls.__qualname__, *cls._source, "input"), (), len(flat.inputs)))
    n = len(flat.inputs)
    slots = flat.n_par + np.arange(n)
    residual = add(var(0), neg(par(0)))
    source = np.full(n, len(flat.sources) - 1)
    flat.families = [*flat.families, Family(residual, flat.inputs[:, None], slots[:, None], source, np.arange(n))]
    return flat
