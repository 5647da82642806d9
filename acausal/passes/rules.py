"""Derivatives that are known: variables with a `derivative_rule`, and the equations that define them.

The nine elements of an orientation obey ``dT/dt = -[w x] T``, whatever gives the orientation. So index reduction leaves
the equations that define such variables alone, and differentiates what they occur in by the rule. What this needs is
that each of these variables has one `defining` equation; others are differentiated like any variable.

Inputs of the whole model have no defining equation; the derivative of one is what a rule for it says.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching
from ..language.flat_model import Bools, Family
from ..language.template import Ints
from ..symbolic.equation import DEFINITION
from ..symbolic.expr import Expr, neg, par, var
from ..symbolic.traverse import substitute
from .aliases import Reduced


@dataclass(frozen=True, slots=True, eq=False)
class DerivativeRules:
    """Rules over the reduced variables.

    Attributes:
        families: ``derivative of target`` as an expression over the variables of each row.
        family_of, row_of: for every variable the rule that is used for it, or -1.
        rows: rows of the model that define these variables; `defined` are the variables, in the same order.
        inputs: for each slot of an input with a rule the rule, its row there, and the sign of the input.
        fed: for each row of the model with such an input, its slots.
    """

    families: list[Family]
    family_of: Ints
    row_of: Ints
    rows: Ints
    defined: Ints
    inputs: dict[int, tuple[int, int, int]]
    fed: dict[int, list[int]]

    @property
    def any(self) -> bool:
        """Whether there is one."""
        return len(self.rows) > 0 or len(self.fed) > 0

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
        for i, slots in self.fed.items():
            for slot in slots:
                k, at, _ = self.inputs[slot]
                columns.append(self.families[k].var_rows[at])
                rows.append(np.full(len(columns[-1]), i))
        r, c = np.concatenate(rows), np.concatenate(columns)
        keep = unknown[c] & (self.family_of[c] < 0)
        return Incidence.from_coo(r[keep], c[keep], graph.n_rows, graph.n_columns)


def derivative_rules(reduced: Reduced, graph: Incidence, sources: Ints) -> DerivativeRules:
    """Which rules can be used.

    Args:
        reduced: the model.
        graph: all rows with all unknowns.
        sources: source of each row.
    """
    flat, unknown = reduced.flat, reduced.unknown
    n = len(unknown)
    family_of, row_of = np.full(n, -1, np.int64), np.full(n, -1, np.int64)
    families: list[Family] = []
    at: dict[int, tuple[int, int]] = {}
    for family in reduced.rules:
        target, expression = family.residual.args
        negative = target.op == "neg"
        slot = target.args[0] if negative else target
        if slot.op != "var":  # a variable that is zero
            continue
        ids = family.var_rows[:, slot.value]
        at |= {v: (len(families), i) for i, v in enumerate(ids.tolist()) if v not in at}
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
    inputs = _input_rules(reduced, at)
    return DerivativeRules(families, family_of, row_of, rows, defined, inputs, _fed(reduced.families, inputs))


def _input_rules(reduced: Reduced, at: dict[int, tuple[int, int]]) -> dict[int, tuple[int, int, int]]:
    """Rule, row there and sign for the slot of each input of the whole model whose variable has one."""
    found: dict[int, tuple[int, int, int]] = {}
    for k, v in enumerate(reduced.flat.inputs.tolist()):
        rule = at.get(int(reduced.representative[v]))
        if rule is not None and reduced.sign[v]:
            found[reduced.flat.n_par + k] = (*rule, int(reduced.sign[v]))
    return found


def _fed(families: list[Family], inputs: dict[int, tuple[int, int, int]]) -> dict[int, list[int]]:
    """For each row with one of these inputs, numbered through, their slots."""
    out: dict[int, list[int]] = {}
    first = 0
    for family in families if inputs else []:
        for i in np.flatnonzero(np.isin(family.par_rows, list(inputs)).any(axis=1)).tolist():
            out[first + i] = [s for s in family.par_rows[i].tolist() if s in inputs]
        first += family.size
    return out


def apply_rules(family: Family, rules: DerivativeRules) -> list[tuple[Ints, Family, dict[Expr, Expr]]]:
    """The family in parts that use the same rules: rows, the part with the rules' variables, slot -> derivative."""
    n = len(rules.family_of)  # beyond are derivatives that index reduction has brought in
    of_variables = np.where(family.var_rows < n, rules.family_of[np.minimum(family.var_rows, n - 1)], -1)
    of_inputs, row_of, sign = np.full((3, *family.par_rows.shape), -1)
    for slot, rule in rules.inputs.items():
        mine = family.par_rows == slot
        of_inputs[mine], row_of[mine], sign[mine] = rule
    which = np.concatenate([of_variables, of_inputs, np.where(of_inputs < 0, 0, sign)], axis=1)
    if (which[:, : of_variables.shape[1] + of_inputs.shape[1]] < 0).all():
        return [(np.arange(family.size), family, {})]
    leaves_ = [var(k) for k in range(of_variables.shape[1])] + [par(k) for k in range(of_inputs.shape[1])]
    patterns, of_row = np.unique(which, axis=0, return_inverse=True)
    parts: list[tuple[Ints, Family, dict[Expr, Expr]]] = []
    for k, pattern in enumerate(patterns.tolist()):
        rows = np.flatnonzero(of_row.ravel() == k)
        part = family.select(rows)
        columns, parameters = [part.var_rows], [part.par_rows]
        n_var, n_par = part.var_rows.shape[1], part.par_rows.shape[1]
        tangents: dict[Expr, Expr] = {}
        for leaf, f in zip(leaves_, pattern, strict=False):
            if f < 0:
                continue
            rule = rules.families[f]
            input_ = leaf.op == "par"
            at = row_of[rows, leaf.value] if input_ else rules.row_of[part.var_rows[:, leaf.value]]
            names = {var(j): var(n_var + j) for j in range(rule.var_rows.shape[1])}
            names |= {par(j): par(n_par + j) for j in range(rule.par_rows.shape[1])}
            tangent = substitute(rule.residual, names)
            backwards = input_ and pattern[len(leaves_) + leaf.value] < 0
            tangents[leaf] = neg(tangent) if backwards else tangent
            columns.append(rule.var_rows[at])
            parameters.append(rule.par_rows[at])
            n_var, n_par = n_var + rule.var_rows.shape[1], n_par + rule.par_rows.shape[1]
        var_rows, par_rows = np.concatenate(columns, axis=1), np.concatenate(parameters, axis=1)
        parts.append((rows, Family(part.residual, var_rows, par_rows, part.source, part.ordinal), tangents))
    return parts
