"""Structural findings as sentences: which equations and unknowns do not fit, where they were written, what to try."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..dae.dulmage_mendelsohn import connected_parts, dulmage_mendelsohn
from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching
from ..errors import StructureError
from ..language.declarations import Kind
from ..language.template import Ints, Template
from .aliases import Reduced

if TYPE_CHECKING:
    from .structure import Rows

SHOWN = 12
"""Equations and unknowns listed per part."""


def singular(reduced: Reduced, rows: Rows, base: Ints, columns: Ints) -> StructureError:
    """The error that names the over- and under-determined parts (Dulmage and Mendelsohn 1958)."""
    flat = reduced.flat
    position = np.full(flat.n_total, -1, np.int64)
    position[columns] = np.arange(len(columns))
    full = rows.incidence(flat.n_total, reduced.unknown)
    owner = np.repeat(np.arange(full.n_rows), np.diff(full.indptr))
    graph = Incidence.from_coo(owner, position[base[full.indices]], len(rows), len(columns))
    matching = np.asarray(maximum_matching(graph))
    parts = dulmage_mendelsohn(graph, matching)
    n_eq = len(rows) + len(reduced.redundant)
    counts = f"{n_eq} equations for {len(columns)} unknowns" + (", but they cannot be paired" if n_eq == len(columns) else "")
    lines = [f"`{flat.model_name}` is structurally singular: {counts} (after alias elimination)."]
    equations: list[str] = []
    unknowns: list[str] = []
    components: list[str] = []
    if reduced.redundant:
        lines.append("\nOver-determined: these equations repeat or contradict others:")
        for r in reduced.redundant[:SHOWN]:
            lines.append(f"    {r.text:<48} {r.component or '(model)'}  {r.place}")
            equations.append(r.text)
            components.append(r.component)
    for row_set, column_set in connected_parts(graph, parts.over_rows, parts.over_columns)[:3]:
        if len(row_set) <= len(column_set):
            continue
        names = [flat.name(int(columns[c])) for c in column_set[:SHOWN]]
        known = f"{len(column_set)} unknowns ({', '.join(names)})" if names else "no unknown that is not zero or known"
        lines.append(f"\nOver-determined: {len(row_set)} equations share {known}:")
        _list_equations(reduced, rows, row_set, lines, equations, components)
        unknowns.extend(names)
    for row_set, column_set in connected_parts(graph, parts.under_rows, parts.under_columns)[:3]:
        if len(column_set) <= len(row_set):
            continue
        names = [flat.name(int(columns[c])) for c in column_set[:SHOWN]]
        more = ", ..." if len(column_set) > SHOWN else ""
        lines.append(
            f"\nUnder-determined: {len(column_set)} unknowns ({', '.join(names)}{more}) in {len(row_set)} equations"
            + (":" if len(row_set) else "")
        )
        _list_equations(reduced, rows, row_set, lines, equations, components)
        unknowns.extend(names)
    lines.append(_advice(reduced, unknowns))
    return StructureError("\n".join(lines), equations=equations, unknowns=unknowns, components=dict.fromkeys(components))


def _list_equations(
    reduced: Reduced, rows: Rows, row_set: Ints, lines: list[str], equations: list[str], components: list[str]
) -> None:
    flat = reduced.flat
    for r in row_set[:SHOWN]:
        family, k = rows.locate(int(r))
        text = flat.equation_text(family, k)
        component, place = flat.equation_place(family, k)
        lines.append(f"    {text:<48} {component or '(model)'}  {place}")
        equations.append(text)
        components.append(component)
    if len(row_set) > SHOWN:
        lines.append(f"    ... and {len(row_set) - SHOWN} more")


def _advice(reduced: Reduced, unknowns: list[str]) -> str:
    """What to try: unbalanced classes, unconnected ports and inputs, no ground."""
    tips: list[str] = []
    for text in unbalanced_classes(reduced.flat.root):
        tips.append(text)
    loose = _unconnected(reduced)
    if loose:
        tips.append(f"nothing is connected to {', '.join(f'`{p}`' for p in loose[:6])}: is a connect() missing?")
    inputs = _free_inputs(reduced, unknowns)
    if inputs:
        tips.append(f"input {', '.join(f'`{i}`' for i in inputs[:6])} has no value: connect it or give it an equation")
    if not tips:
        tips.append(
            "often two ideal sources are connected without anything between them, a ground (reference) is missing, or "
            "one equation was written twice"
        )
    return "\nTry: " + "\n     ".join(tips)


def _unconnected(reduced: Reduced) -> list[str]:
    flat = reduced.flat
    seen: dict[str, None] = {}
    for z in flat.zero.tolist():
        seen[flat.name(int(z)).rsplit(".", 1)[0]] = None
    return list(seen)


def _free_inputs(reduced: Reduced, unknowns: list[str]) -> list[str]:
    flat = reduced.flat
    found: list[str] = []
    for name in unknowns:
        if not name.startswith("der("):
            ids, is_par = flat.names.find(name)
            if not is_par and flat.names.declaration(int(ids)).kind == Kind.INPUT:
                found.append(name)
    return found


def unbalanced_classes(root: Template) -> list[str]:
    """Component classes whose own equations and unknowns do not balance (Modelica Specification 3.6, section 4.7).

    A class is balanced if it has one equation for each of its own variables and outputs and for each flow of its own
    connectors, and its connections and equations serve the inputs of its parts.
    """
    tips: list[str] = []
    seen: dict[int, None] = {}
    stack = [root]
    while stack:
        template = stack.pop()
        if id(template) in seen:
            continue
        seen[id(template)] = None
        for slot in template.children.values():
            stack.extend(slot.templates)
        if template.is_connector or template.connections:
            continue
        have = sum(_equation_count(template, e) for e in template.equations)
        need = _needed(template)
        if have != need and all(t.is_connector for s in template.children.values() for t in s.templates):
            kind = "too many" if have > need else "too few"
            tips.append(
                f"class `{template.cls.__name__}` ({template.cls._source[0]}:{template.cls._source[1]}) has {have} equations "
                f"where {need} are needed ({kind}): one for each variable, output and flow"
            )
    return tips


def _equation_count(template: Template, equation: object) -> int:
    from ..symbolic.traverse import leaves

    shapes = [
        template.resolve(leaf.value).offsets.size
        for leaf in leaves(equation.lhs, equation.rhs, op="symbol")  # type: ignore[attr-defined]
    ]
    return max(shapes, default=1)


def _needed(template: Template) -> int:
    own = sum(
        1 for n, (is_par, _) in template.own.items() if not is_par and template.cls._declarations[n].kind != Kind.INPUT
    )
    for path, _ in template.leaf_names(False):
        if len(path) > 1:
            declaration = template.resolve(path).declaration
            own += declaration is not None and declaration.kind == Kind.FLOW
    return own
