"""Derivatives that are known: variables with a `derivative_rule`, and the equations that define them.

The nine elements of an orientation obey ``dT/dt = -[w x] T``, whatever gives the orientation. So index reduction leaves
the equations that define such variables alone, and differentiates what they occur in by the rule. What this needs is
that each of these variables has one `defining` equation; others are differentiated like any variable.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching
from ..language.flat_model import Bools, Family, FlatModel
from ..language.template import Ints
from ..symbolic.equation import DEFINITION
from ..symbolic.expr import Expr, neg, par, var
from ..symbolic.traverse import substitute


@dataclass(frozen=True, slots=True, eq=False)
class DerivativeRules:
    """Rules over the reduced variables.

    Attributes:
        families: ``derivative of target`` as an expression over the variables of each row.
        family_of, row_of: for every variable the rule that is used for it, or -1.
        rows: rows of the model that define these variables; `defined` are the variables, in the same order.
    """

    families: list[Family]
    family_of: Ints
    row_of: Ints
    rows: Ints
    defined: Ints

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return len(self.rows) > 0

    def extra(self, graph: Incidence, unknown: Bools) -> Incidence:
        """Columns that the derivative of each row has by the rules for its variables."""
        of_row = graph.edge_rows()
        rows: list[Ints] = [np.zeros(0, np.int64)]
        columns: list[Ints] = [np.zeros(0, np.int64)]
        for k, family in enumerate(self.families):
            edges = np.flatnonzero(self.family_of[graph.indices] == k)
            below = family.var_rows[self.row_of[graph.indices[edges]]]
            rows.append(np.repeat(of_row[edges], below.shape[1]))
            columns.append(below.ravel())
        r, c = np.concatenate(rows), np.concatenate(columns)
        keep = unknown[c] & (self.family_of[c] < 0)
        return Incidence.from_coo(r[keep], c[keep], graph.n_rows, graph.n_columns)


def derivative_rules(
    flat: FlatModel, specialized: list[Family], graph: Incidence, sources: Ints, unknown: Bools
) -> DerivativeRules:
    """Which rules can be used.

    Args:
        flat: the model.
        specialized: ``rule(target, expression)`` over representatives.
        graph: all rows with all unknowns.
        sources: source of each row.
        unknown: mask of the variables that remain.
    """
    n = len(unknown)
    family_of, row_of = np.full(n, -1, np.int64), np.full(n, -1, np.int64)
    families: list[Family] = []
    for family in specialized:
        target, expression = family.residual.args
        negative = target.op == "neg"
        slot = target.args[0] if negative else target
        if slot.op != "var":  # a variable that is zero
            continue
        ids = family.var_rows[:, slot.value]
        new = (family_of[ids] < 0) & unknown[ids] & (flat.derivative_of[ids] < 0)
        family_of[ids[new]], row_of[ids[new]] = len(families), np.flatnonzero(new)
        form = neg(expression) if negative else expression
        families.append(Family(form, family.var_rows, family.par_rows, family.source, family.ordinal))
    kind = np.array([source.origin.kind == DEFINITION for source in flat.sources] or [False])
    defining = np.flatnonzero(kind[sources])
    matched = np.asarray(maximum_matching(graph.select(rows=defining, column_mask=family_of >= 0)))
    rows, defined = defining[matched >= 0], matched[matched >= 0]
    unused = np.ones(n, bool)
    unused[defined] = False
    family_of[unused] = -1
    return DerivativeRules(families, family_of, row_of, rows, defined)


def apply_rules(family: Family, rules: DerivativeRules) -> list[tuple[Ints, Family, dict[Expr, Expr]]]:
    """The family in parts that use the same rules: rows, the part with the rules' variables, slot -> derivative."""
    n = len(rules.family_of)  # beyond are derivatives that index reduction has brought in
    which = np.where(family.var_rows < n, rules.family_of[np.minimum(family.var_rows, n - 1)], -1)
    if (which < 0).all():
        return [(np.arange(family.size), family, {})]
    patterns, of_row = np.unique(which, axis=0, return_inverse=True)
    parts: list[tuple[Ints, Family, dict[Expr, Expr]]] = []
    for k, pattern in enumerate(patterns):
        rows = np.flatnonzero(of_row.ravel() == k)
        part = family.select(rows)
        columns, parameters = [part.var_rows], [part.par_rows]
        n_var, n_par = part.var_rows.shape[1], part.par_rows.shape[1]
        tangents: dict[Expr, Expr] = {}
        for slot, f in enumerate(pattern.tolist()):
            if f < 0:
                continue
            rule = rules.families[f]
            at = rules.row_of[part.var_rows[:, slot]]
            names = {var(j): var(n_var + j) for j in range(rule.var_rows.shape[1])}
            names |= {par(j): par(n_par + j) for j in range(rule.par_rows.shape[1])}
            tangents[var(slot)] = substitute(rule.residual, names)
            columns.append(rule.var_rows[at])
            parameters.append(rule.par_rows[at])
            n_var, n_par = n_var + rule.var_rows.shape[1], n_par + rule.par_rows.shape[1]
        var_rows, par_rows = np.concatenate(columns, axis=1), np.concatenate(parameters, axis=1)
        parts.append((rows, Family(part.residual, var_rows, par_rows, part.source, part.ordinal), tangents))
    return parts
