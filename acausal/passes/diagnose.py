"""Structural findings as sentences: which equations and unknowns do not fit, where they were written, what to try."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..dae.dulmage_mendelsohn import connected_parts, dulmage_mendelsohn
from ..dae.incidence import Incidence
from ..dae.matching import maximum_matching
from ..errors import StructureError
from ..language.declarations import Kind
from ..language.flat_model import FlatModel
from ..language.loops import overdetermined_parts
from ..language.template import Ints, Template, TemplateEquation
from ..symbolic.printing import path_text
from ..symbolic.traverse import leaves
from .aliases import Reduced
from .places import context

if TYPE_CHECKING:
    from .structure import Rows

SHOWN = 12
"""Equations and unknowns listed per part."""
PARTS = 3
"""Parts of one kind."""
WIDEST = 160
"""Characters shown of an equation; its place says where the rest is."""


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
    text = _Text(reduced, rows)
    n_eq = len(rows) + len(reduced.redundant)
    counts = f"{_count(n_eq, 'equation')} for {_count(len(columns), 'unknown')}"
    text.lines.append(
        f"`{flat.model_name}` is structurally singular: {counts} after alias elimination"
        + (", but they cannot be paired." if n_eq == len(columns) else ".")
    )
    text.redundant()
    for row_set, column_set in connected_parts(graph, parts.over_rows, parts.over_columns)[:PARTS]:
        if len(row_set) > len(column_set):
            text.over(row_set, [flat.name(int(columns[c])) for c in column_set])
    for row_set, column_set in connected_parts(graph, parts.under_rows, parts.under_columns)[:PARTS]:
        if len(column_set) > len(row_set):
            text.under(row_set, [flat.name(int(columns[c])) for c in column_set])
    return text.error()


class _Text:
    """A message that grows part by part."""

    def __init__(self, reduced: Reduced, rows: Rows) -> None:
        self.reduced = reduced
        self.flat = reduced.flat
        self.rows = rows
        self.lines: list[str] = []
        self.equations: list[str] = []
        self.over_unknowns: list[str] = []
        self.under_unknowns: list[str] = []
        self.components: list[str] = []
        self.tips: list[str] = []
        self.absent: list[str] = []

    def _entry(self, text: str, component: str, place: str) -> None:
        short = text if len(text) <= WIDEST else f"{text[:WIDEST]} ..."
        self.lines.append(f"    {short:<48} {component or '(model)'}  {place}")
        self.equations.append(text)
        self.components.append(component)

    def _rows(self, row_set: Ints) -> list[str]:
        """List equations; returns their components."""
        found: list[str] = []
        for r in row_set[:SHOWN]:
            family, k = self.rows.locate(int(r))
            component, place = self.flat.equation_place(family, k)
            self._entry(self.flat.equation_text(family, k), component, place)
            found.append(component)
        if len(row_set) > SHOWN:
            self.lines.append(f"    ... and {len(row_set) - SHOWN} more")
        return list(dict.fromkeys(found))

    def _kinds(self, row_set: Ints) -> set[str]:
        """What kinds of statements the equations come from."""
        places = (self.rows.locate(int(r)) for r in row_set)
        return {self.flat.sources[int(family.source[k])].origin.kind for family, k in places}

    def redundant(self) -> None:
        """Alias equations that close a cycle."""
        for r in self.reduced.redundant[:PARTS]:
            self.lines.append("\nOver-determined: this equation repeats or contradicts others:")
            self._entry(r.text, r.component, r.place)
            if r.others:
                self.lines.append("  namely:")
                for other in r.others:
                    self._entry(*other)
        if len(self.reduced.redundant) > PARTS:
            self.lines.append(f"\n... and {len(self.reduced.redundant) - PARTS} more such equations")

    def over(self, row_set: Ints, names: list[str]) -> None:
        """More equations than unknowns."""
        known = f"{_count(len(names), 'unknown')} ({_few(names)})" if names else "no unknown: all is zero or known"
        self.lines.append(f"\nOver-determined: {_count(len(row_set), 'equation')} for {known}:")
        components = self._rows(row_set)
        self.over_unknowns.extend(names)
        if len(names) == 1 and self._kinds(row_set) == {"when"}:
            self.tips.append(
                f"`{names[0]}` is assigned by more than one `when`: make them branches of one, "
                "when(a, ...).elsewhen(b, ...), of which the first that is triggered counts"
            )
        elif 1 < len(components) <= 4 and 1 <= len(names) <= 4:
            who = " and ".join(f"`{c or self.flat.model_name}`" for c in components)
            both, more = ("both ", "") if len(names) == 1 else ("", " more than once")
            self.tips.append(
                f"{who} {both}determine {', '.join(f'`{n}`' for n in names)}{more}, like two ideal voltage sources in "
                "parallel, two speeds given to one shaft, two current sources in series, or two outputs that are "
                "connected: put a component between them that takes the difference (a resistance, a spring), or remove "
                "one"
            )

    def under(self, row_set: Ints, names: list[str]) -> None:
        """More unknowns than equations."""
        many = _count(len(row_set), "equation") if len(row_set) else "no equation"
        colon = ":" if len(row_set) else ""
        self.lines.append(f"\nUnder-determined: {_count(len(names), 'unknown')} ({_few(names)}) in {many}{colon}")
        self._rows(row_set)
        self.under_unknowns.extend(names)
        if not len(row_set):
            self.absent.extend(names)

    def error(self) -> StructureError:
        """The finished message."""
        flat = self.flat
        owners = [n.rpartition(".")[0] for n in self.absent]
        absent = [n for n, c in zip(self.absent, owners, strict=True) if c not in self.components]
        written = context(flat, [*self.components, *owners], absent)
        if written:
            self.lines.append("\n" + written)
        self.lines.append(self._advice())
        unknowns = [*self.over_unknowns[:SHOWN], *self.under_unknowns[:SHOWN]]
        components = dict.fromkeys(self.components)
        return StructureError("\n".join(self.lines), equations=self.equations, unknowns=unknowns, components=components)

    def _advice(self) -> str:
        """What to try: unbalanced classes, unconnected ports and inputs, no ground."""
        tips = [*unbalanced_classes(self.flat.root), *self.tips]
        inputs = [n for n in self.under_unknowns if _kind(self.flat, n) == Kind.INPUT]
        if inputs:
            names = ", ".join(f"`{i}`" for i in inputs[:6])
            tips.append(f"input {names} has no value: connect it or give it an equation")
        loose = _unconnected(self.reduced)
        if loose:
            tips.append(f"nothing is connected to {', '.join(f'`{p}`' for p in loose[:6])}: is a connect() missing?")
        potentials = [n for n in self.under_unknowns if _kind(self.flat, n) == Kind.POTENTIAL]
        unsaid = [n for n in potentials if n in self.absent]
        if unsaid and not loose:
            names, verb = ", ".join(f"`{n}`" for n in unsaid[:4]), "are" if len(unsaid) > 1 else "is"
            tips.append(f"{names} {verb} in no equation of what is connected there: connect something that has one")
        potentials = [n for n in potentials if n not in unsaid]
        given = [n for n in self.absent if n in _reinitialized(self.flat)]
        if given:
            names, verb = ", ".join(f"`{n}`" for n in given[:4]), "are" if len(given) > 1 else "is"
            tips.insert(0, f"{names} {verb} given in `when` only: declare what changes at events only as `Discrete`")
        if potentials and self.reduced.redundant:
            names = ", ".join(f"`{p}`" for p in potentials[:4])
            occur = "occur" if len(potentials) > 1 else "occurs"
            tips.append(
                f"{names} {occur} in differences only: connect a reference (a ground, a fixed point, a given pressure)"
            )
        if not tips:
            tips.append("is an equation missing, written twice, or written for the wrong variable?")
        return "\nTry: " + "\n     ".join(tips)


def _count(n: int, what: str) -> str:
    return f"{n} {what}" + ("" if n == 1 else "s")


def _few(names: list[str]) -> str:
    return ", ".join(names[:SHOWN]) + (", ..." if len(names) > SHOWN else "")


def _unconnected(reduced: Reduced) -> list[str]:
    flat = reduced.flat
    seen: dict[str, None] = {}
    for z in flat.zero.tolist():
        seen[flat.name(int(z)).rsplit(".", 1)[0]] = None
    return list(seen)


def _reinitialized(flat: FlatModel) -> dict[str, None]:
    """Variables that a `when` gives new values without being their equation."""
    reinits = [f for f in flat.actions if f.residual.op == "reinit"]
    return {flat.name(int(v)): None for f in reinits for v in f.var_rows[:, f.residual.args[0].value]}


def _kind(flat: FlatModel, name: str) -> Kind | None:
    """Kind of a variable by its name, None for a derivative."""
    if name.startswith("der("):
        return None
    ids, is_par = flat.names.find(name)
    return None if is_par else flat.names.declaration(int(ids)).kind


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
        if any(overdetermined_parts(t) for s in template.children.values() for t in s.templates if t.is_connector):
            continue  # what such a component must give depends on where the root is
        have = sum(_equation_count(template, e) for e in template.equations if not _gives_inputs(template, e))
        need = _needed(template)
        if have != need and all(t.is_connector for s in template.children.values() for t in s.templates):
            kind = "too many" if have > need else "too few"
            tips.append(
                f"class `{template.cls.__name__}` ({template.cls._source[0]}:{template.cls._source[1]}) has "
                f"{_count(have, 'equation')} where {need} are needed ({kind}): one for each variable, output and flow"
                + _unused_flow(template)
            )
    return tips


def _gives_inputs(template: Template, equation: TemplateEquation) -> bool:
    """Whether an equation has no unknown but inputs, which the class gives itself where nothing is to be connected."""
    found = [template.resolve(leaf.value).declaration for leaf in leaves(equation.lhs, equation.rhs, op="symbol")]
    kinds = {declaration.kind for declaration in found if declaration is not None} - {Kind.PARAMETER}
    return kinds == {Kind.INPUT}


def _unused_flow(template: Template) -> str:
    """A flow of the class that none of its equations has: most often the one that is forgotten."""
    used = {leaf.value for e in template.equations for leaf in leaves(e.lhs, e.rhs, op="symbol")}
    for path, _ in template.leaf_names(False):
        declaration = template.resolve(path).declaration
        if declaration is not None and declaration.kind == Kind.FLOW and not any(path[: len(u)] == u for u in used):
            return f"; no equation of it has `{path_text(path)}`"
    return ""


def _equation_count(template: Template, equation: TemplateEquation) -> int:
    symbols = leaves(equation.lhs, equation.rhs, op="symbol")
    shapes = [template.resolve(leaf.value).offsets.size for leaf in symbols]
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
