"""Parameters that depend on parameters, and start values that do: evaluated once per run, in order of dependence."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import DeclarationError
from ..language.flat_model import Assignment, FlatModel
from ..language.template import Floats, Ints
from ..symbolic.expr import Expr
from ..symbolic.traverse import evaluate


class ParameterProgram:
    """From the given values to the vector of all parameters.

    Attributes:
        default: all parameter values with nothing given, dependent ones evaluated; inputs and slots of events behind.
        dependent: mask of the parameters that an expression gives.
    """

    def __init__(self, flat: FlatModel) -> None:
        self.flat = flat
        self.n_p = flat.n_p
        inputs = np.nan_to_num(flat.start[flat.inputs])
        self.base: Floats = np.concatenate([flat.par_value, inputs, np.zeros(flat.slots.count)])
        for piece in flat.slots.pieces:
            if piece.residual.op == "pre" and piece.residual.args[1].op == "var":  # left limits begin with start values
                slot, variable = (a.value for a in piece.residual.args)
                self.base[piece.par_rows[:, slot]] = np.nan_to_num(flat.start[piece.var_rows[:, variable]])
        self.dependent = np.zeros(self.n_p, bool)
        for a in flat.par_assignments:
            self.dependent[a.targets] = True
        self.ordered = _ordered(flat)
        self.default: Floats = self.evaluate({}, np)

    def evaluate(self, given: Mapping[str, Any], xp: Any) -> Any:
        """All parameters (n_p,), with `given` (dotted name to value, or to an array for a component array) in place.

        Raises:
            UnknownNameError: a name that is no parameter.
        """
        values: Any = self.base.copy() if xp is np else xp.asarray(self.base)
        overridden = np.zeros(self.n_p, bool)
        for name, value in given.items():
            ids, _ = self.flat.names.find(name, parameter=True)
            if self.flat.evaluated[ids].any():
                from .bounds import evaluated_text

                raise DeclarationError(evaluated_text(self.flat, ids.ravel()))
            overridden[ids] = True
            values = _put(values, ids.ravel(), xp.ravel(xp.broadcast_to(xp.asarray(value, float), ids.shape)), xp)
        return self.completed(values, overridden, xp)

    def completed(self, values: Any, given: Any, xp: Any = np) -> Any:
        """All parameters from those in `values`: dependent ones evaluated, unless the mask `given` has them."""
        for assignment in self.ordered:
            keep = ~given[assignment.targets]
            if keep.any():
                part = assignment if keep.all() else _select(assignment, keep)
                values = _put(values, part.targets, evaluate_assignment(part, values, xp), xp)
        return values

    def tangents(self, p: Floats, given: Any, dp: Floats) -> Floats:
        """Tangents of start values (n, k) from those of the given parameters; `dp` (n_p, k) is completed in place."""
        for assignment in self.ordered:
            keep = ~given[assignment.targets]
            if keep.any():
                part = assignment if keep.all() else _select(assignment, keep)
                dp[part.targets] = _moved(part, p, dp)
        starts = np.zeros((len(self.flat.start), dp.shape[1]))
        for assignment in self.flat.start_assignments:
            starts[assignment.targets] = _moved(assignment, p, dp)
        return starts

    def generic(self, random: np.random.Generator, *, keep_zeros: bool = False) -> Floats:
        """Parameter values in general position near the defaults (n_p,), dependent ones evaluated.

        Args:
            random: draws them.
            keep_zeros: whether a value of zero stays one, also that of a difference of equal ones.
        """
        noise = random.uniform(0.02, 0.2, self.n_p)
        values = np.where(np.isnan(self.base), 1.0 + noise, self.base * (1.0 + noise))
        if not keep_zeros:
            values = np.where(values == 0.0, noise, values)
        held = self.n_p - self.flat.slots.count
        values[held:] = self.base[held:]
        for assignment in self.ordered:
            new, targets = evaluate_assignment(assignment, values, np), assignment.targets
            values[targets] = np.where(self.default[targets] == 0.0, 0.0, new) if keep_zeros else new
        return values

    def starts(self, p: Any, xp: Any) -> Any:
        """Start values of all variables (nan where none is given), with expressions evaluated."""
        values: Any = self.flat.start.copy() if xp is np else xp.asarray(self.flat.start)
        for assignment in self.flat.start_assignments:
            values = _put(values, assignment.targets, evaluate_assignment(assignment, p, xp), xp)
        return values


def _put(values: Any, ids: Ints, new: Any, xp: Any) -> Any:
    if xp is np:
        values[ids] = new
        return values
    return values.at[ids].set(new)


def _select(assignment: Assignment, keep: Any) -> Assignment:
    return Assignment(assignment.targets[keep], assignment.expression, assignment.par_rows[keep], assignment.origin)


def evaluate_assignment(assignment: Assignment, p: Any, xp: Any) -> Any:
    """Values of an assignment's targets."""

    def leaf(node: Expr) -> Any:
        if node.op == "time":
            raise DeclarationError(f"a parameter cannot depend on time ({assignment.origin})")
        return p[assignment.par_rows[:, node.value]]

    with np.errstate(all="ignore"):
        return xp.broadcast_to(evaluate((assignment.expression,), leaf, xp)[0], assignment.targets.shape)


def _moved(assignment: Assignment, p: Floats, dp: Floats) -> Any:
    """Tangents of an assignment's targets."""
    from .numeric import evaluate_dual

    def leaf(node: Expr) -> Any:
        rows = assignment.par_rows[:, node.value]
        return p[rows], dp[rows]

    with np.errstate(all="ignore"):
        moved = evaluate_dual((assignment.expression,), leaf)[0][1]
    return 0.0 if moved is None else moved


def _ordered(flat: FlatModel) -> list[Assignment]:
    """Assignments split and sorted so that what an expression needs comes first."""
    level = np.zeros(flat.n_par + len(flat.inputs), np.int64)
    pending = flat.par_assignments
    for a in pending:
        level[a.targets] = 1
    for _ in range(len(level) + 1):
        changed = False
        for a in pending:
            if a.par_rows.shape[1]:
                new = level[a.par_rows].max(axis=1) + 1
                if (new > level[a.targets]).any():
                    level[a.targets] = np.maximum(level[a.targets], new)
                    changed = True
        if not changed:
            break
        if level.max() > sum(len(a.targets) for a in pending):
            k = int(level.argmax())
            raise DeclarationError(
                f"parameter `{flat.names.parameter(k)}` depends on itself: its value leads back to it through "
                "other parameters"
            )
    out: list[tuple[int, int, Assignment]] = []
    for i, a in enumerate(pending):
        for lv in np.unique(level[a.targets]):
            out.append((int(lv), i, _select(a, level[a.targets] == lv)))
    return [a for _, _, a in sorted(out, key=lambda item: item[:2])]
