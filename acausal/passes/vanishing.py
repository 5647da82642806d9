"""Zeros that take an unknown out of its equation: a capacitor of 0 F, a mass of 0 kg, a transit time of 0 s.

With ``C = 0`` the equation ``C*der(v) == i`` says ``i == 0``, and `v` is no state. With `C` left a symbol, `v` would be
one whose derivative nothing determines. So where the values of parameters make a block of equations singular that is
regular in general, those zeros are built into the equations and the model is analysed again. All other zeros may
change in each run.
"""

from __future__ import annotations

import numpy as np

from ..language.flat_model import Bools, Family, FlatModel
from ..language.template import Ints
from ..lowering.parameters import ParameterProgram
from ..symbolic.expr import Expr, const, par, var
from ..symbolic.traverse import leaves, substitute
from .evaluate import evaluate_parameters
from .singular_blocks import always_singular
from .structure import Blocks, IndexReduced

SHOWN = 6
"""Parameters that a message names."""


def vanishing_zeros(index: IndexReduced, program: ParameterProgram) -> Ints:
    """Numbers of the parameters that are zero and with that leave a highest derivative undetermined."""
    n_par = index.flat.n_par
    random = np.random.default_rng(2017)
    zero = np.zeros(program.n_p, bool)
    zero[:n_par] = program.generic(random, keep_zeros=True)[:n_par] == 0
    blocks = index.blocks
    holding = _holding(index, blocks, zero)
    singular = always_singular(index, blocks, holding, lambda r: program.generic(r, keep_zeros=True), random)
    marked = np.zeros(program.n_p, bool)
    for b in np.flatnonzero(singular):
        for row in blocks.rows_of(int(b)).tolist():
            marked[_taking_out(index, blocks, row, int(b), zero)] = True
    return np.flatnonzero(marked)


def with_zeros(written: FlatModel, zeros: Ints) -> FlatModel:
    """A copy of `written` with these parameters built in, and without the derivatives that are in no equation then."""
    evaluated = written.evaluated.copy()
    evaluated[zeros] = True
    return _without_unheld(evaluate_parameters(written.changed(evaluated=evaluated)))


def zeros_hint(flat: FlatModel, zeros: Ints) -> str:
    """What to say of zeros that are built in where the model cannot be solved; empty without such."""
    if not len(zeros):
        return ""
    shown = ", ".join(f"`{flat.parameter_name(int(i))}`" for i in zeros[:SHOWN])
    more = f" and {len(zeros) - SHOWN} more" if len(zeros) > SHOWN else ""
    one = len(zeros) == 1
    several = "values 0", "take", "them other values"
    subject, verb, value = ("value 0", "takes", "it another value") if one else several
    return (
        f"\nThe {subject} of {shown}{more} {verb} unknowns out of their equations, and what remains is this. Give "
        f"{value}, or leave the component out."
    )


def _holding(index: IndexReduced, blocks: Blocks, zero: Bools) -> Bools:
    """Mask of the blocks in whose equations there is a zero."""
    touched = np.zeros(len(index.rows), bool)
    for k, family in enumerate(index.families):
        touched[index.rows.offset[k] : index.rows.offset[k + 1]] = zero[family.par_rows].any(axis=1)
    holding = np.zeros(len(blocks), bool)
    holding[blocks.block_of_row[touched[blocks.rows]]] = True
    return holding


def _taking_out(index: IndexReduced, blocks: Blocks, row: int, block: int, zero: Bools) -> Ints:
    """The zeros in an equation that take an unknown of its block out of it."""
    family, k = index.rows.locate(row)
    zeros = np.flatnonzero(zero[family.par_rows[k]])
    if not len(zeros):
        return zeros
    mine = blocks.columns[blocks.ptr[block] : blocks.ptr[block + 1]]
    found = _variables(family.residual, zeros)
    needed: set[int] = set()
    for column in np.flatnonzero(np.isin(family.var_rows[k], mine)).tolist():
        if var(column) not in found:
            alone = [z for z in zeros.tolist() if var(column) in _variables(family.residual, zeros[zeros != z])]
            needed.update(alone or zeros.tolist())  # where each of several suffices, all
    return family.par_rows[k, sorted(needed)]


def _variables(residual: Expr, zeros: Ints) -> set[Expr]:
    """Variables of a residual with some of its parameters zero; all of them where it divides by one."""
    try:
        return set(leaves(substitute(residual, {par(int(c)): const(0.0) for c in zeros}), op="var"))
    except ZeroDivisionError:
        return set(leaves(residual, op="var"))


def _without_unheld(flat: FlatModel) -> FlatModel:
    """`flat` without the derivatives that nothing in it holds, nor a higher derivative of theirs."""
    held = np.zeros(flat.n_total, bool)
    held[: flat.n_var] = True
    for family in (*flat.families, *flat.initial, *flat.actions, *flat.rules):
        held[family.var_rows] = True
    while not held[flat.parent[(flat.parent >= 0) & held]].all():
        held[flat.parent[(flat.parent >= 0) & held]] = True
    keep = np.flatnonzero(held)
    new = np.full(flat.n_total + 1, -1)  # the last place is for -1
    new[keep] = np.arange(len(keep))

    def renumbered(families: list[Family]) -> list[Family]:
        return [Family(f.residual, new[f.var_rows], f.par_rows, f.source, f.ordinal) for f in families]

    return flat.changed(
        families=renumbered(flat.families), initial=renumbered(flat.initial), actions=renumbered(flat.actions),
        rules=renumbered(flat.rules), derivative_of=new[flat.derivative_of[keep]], parent=new[flat.parent[keep]],
        start=flat.start[keep], fixed=flat.fixed[keep], nominal=flat.nominal[keep], select=flat.select[keep],
        kind=flat.kind[keep],
    )  # fmt: skip
