"""Index reduction for systems whose structure hides a dependence between equations.

Pantelides' algorithm counts occurrences. Where the Jacobian of a block of equations with respect to their highest
derivatives is singular for all values, as in ``C*(der(a) - der(b)) = i`` written at both ends of a capacitor, a
combination of the equations is free of these derivatives: the *linear combination method* of G. Tan, N. S. Nedialkov
and J. D. Pryce, "Conversion methods for improving structural analysis of differential-algebraic equation systems",
BIT 57 (2017) 845-865. It replaces one of the equations, and the structure is analysed again.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from ..errors import StructureError
from ..language.flat_model import Family
from ..language.template import Ints
from .aliases import Reduced
from .combine import Replacement, combine, describe
from .singular_blocks import Parameters, always_singular, point_nearby
from .specialize import merge
from .structure import IndexReduced, extended, reduce_index

ROUNDS = 50
"""Most times that equations are replaced."""


def regularize(reduced: Reduced, parameters: Parameters) -> IndexReduced:
    """Reduce the index, replacing equations that only seem to determine their highest derivatives.

    Raises:
        StructureError: the equations cannot be paired with the unknowns, or some say the same thing.
    """
    flat = reduced.flat
    current = reduced
    history: list[Replacement] = []
    for _ in range(ROUNDS):
        try:
            index = reduce_index(current)
        except StructureError as error:
            if not history:
                raise
            raise StructureError(
                f"{describe(flat, history)}\nWith the combinations in their place: {error}",
                equations=error.equations, unknowns=error.unknowns, components=error.components,
            ) from error  # fmt: skip
        replacements = _replacements(index, parameters)
        if not replacements:
            return index
        history.extend(replacements)
        current = _replaced(current, index, replacements)
    raise StructureError(
        f"`{flat.model_name}`: the index reduction does not end: after {ROUNDS} replacements there are still equations "
        f"that do not determine their highest derivatives.\n{describe(flat, history[-3:])}"
    )


def _replaced(current: Reduced, index: IndexReduced, replacements: list[Replacement]) -> Reduced:
    """The undifferentiated equations with the combinations in place of others."""
    rows = np.concatenate([r.rows for r in replacements])
    drop = np.zeros(len(index.rows), bool)
    drop[rows] = True
    families: list[Family] = []
    offset = index.rows.offset
    for k in range(len(current.families)):
        keep = ~drop[offset[k] : offset[k + 1]]
        families.append(current.families[k] if keep.all() else current.families[k].select(keep))
    families = merge([*families, *(r.family for r in replacements)])
    # derivatives that nothing holds any more are no unknowns
    unknown, derivative_of = index.unknown.copy(), index.derivative_of.copy()
    held = np.zeros(len(unknown), bool)
    held[_held_elsewhere(current)] = True
    for family in families:
        held[family.var_rows.ravel()] = True
    while True:
        last = unknown & (index.parent >= 0) & ~held & (derivative_of < 0)
        if not last.any():
            break
        unknown[last] = False
        derivative_of[index.parent[last]] = -1
    flat = extended(current.flat, derivative_of, index.parent)
    consumed = dict(current.consumed)
    for replacement in replacements:
        family = replacement.family
        keys = zip(family.source.tolist(), family.ordinal.tolist(), strict=True)
        consumed.update(dict.fromkeys(keys, replacement.consumed))
    return replace(current, flat=flat, families=families, unknown=unknown, consumed=consumed)


def _held_elsewhere(current: Reduced) -> Ints:
    """What stands for variables of the model, or is in initial equations, conditions and actions."""
    flat = current.flat
    others = (*flat.initial, *flat.actions, *flat.slots.pieces)
    ids = np.unique(np.concatenate([np.arange(flat.n_var), *(family.var_rows.ravel() for family in others)]))
    return current.representative[ids[current.sign[ids] != 0]]


def _replacements(index: IndexReduced, parameters: Parameters) -> list[Replacement]:
    blocks = index.blocks
    random = np.random.default_rng(2017)
    singular = always_singular(index, blocks, np.ones(len(blocks), bool), parameters, random)
    if not singular.any():
        return []
    members = [blocks.rows_of(int(b)) for b in np.flatnonzero(singular)]
    points = [point_nearby(index, parameters, random) for _ in range(3)]
    values, parameter_values, _ = points[0]
    start = np.pad(index.flat.start, (0, len(values) - len(index.flat.start)), constant_values=np.nan)
    begin = np.where(np.isnan(start), values, start), parameter_values, 0.0
    return combine(index, members, points, begin, random)
