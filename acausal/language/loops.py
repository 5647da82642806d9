"""Connections of overdetermined connectors: which of them close loops, and what is asked for there instead."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..errors import DeclarationError
from ..symbolic.expr import Expr, as_expr, var
from ..symbolic.traverse import leaves, substitute
from .connection_sets import ConnectionGraph
from .fields import view
from .flat_model import Bools, Family, Source
from .instance import path_text, record
from .overdetermined import Mark, Overdetermined, RootCondition
from .spanning_forest import Forest, Link, Roots, spanning_forest
from .template import Ints, Path, Template
from .when import assertion_form


@dataclass(frozen=True, slots=True, eq=False)
class Loops:
    """The outcome.

    Attributes:
        kept: by connector interface and offset of each overdetermined quantity, the edges over which it is equal.
        closures: equations at the connections that close loops.
        assertions: what must hold there, too.
        places: text of these connections, with advice for loops of that kind.
    """

    forest: Forest
    kept: dict[Any, dict[int, Bools]]
    closures: list[Family]
    assertions: list[Family]
    places: list[tuple[str, str]]


def holds(condition: RootCondition, nodes: Ints, forest: Forest) -> Bools:
    """The answer for each of `nodes`."""
    if condition.op == "is_root":
        return np.isin(nodes, list(forest.roots))
    return ~np.isin(nodes, list(forest.inward))


@dataclass(slots=True, eq=False)
class LoopFinder:
    """Collects nodes and marks, then cuts loops."""

    graph: Roots = field(default_factory=Roots)

    def add_nodes(self, base: Ints, path: Path) -> None:
        """Instances of an overdetermined connector."""
        names = Source(None, path, 1)  # type: ignore[arg-type]
        self.graph.names.update((int(b), names.component(k)) for k, b in enumerate(base.tolist()))

    def add_mark(self, mark: Mark, ids: list[Ints], source: Source) -> None:
        """One statement of all instances of a component; `ids` are those of its connectors."""
        for k, nodes in enumerate(zip(*(a.ravel().tolist() for a in ids), strict=True)):
            where = _place(source, k)
            if mark.kind == "branch":
                self.graph.branches.append(Link(nodes[0], nodes[1], where))
            elif mark.kind == "root":
                self.graph.definite[nodes[0]] = where
            else:
                self.graph.potential[nodes[0]] = mark.priority

    def solve(self, graph: ConnectionGraph, sources: list[Source]) -> Loops:
        """Choose roots, cut the connections that close loops."""
        places: list[tuple[Any, int, int, tuple[int, int, int, int]]] = []  # interface, part, number of edge, edge
        uncut: dict[Any, Bools] = {}
        parts: dict[Any, Template] = {}
        for key, template in graph.templates.items():
            edges = list(_each(graph.edges.get(key, [])))
            for offset, part in overdetermined_parts(template):
                parts[key, offset] = part
                uncut[key, offset] = np.ones(len(edges), bool)
                for j, (a, b, source, ordinal) in enumerate(edges):
                    ends = (a >> 1) + offset, (b >> 1) + offset
                    places.append((key, offset, j, (*ends, source, ordinal)))
                    self.graph.connections.append(Link(*ends, _place(sources[source], ordinal)))
        forest = spanning_forest(self.graph)
        closing: dict[Any, list[tuple[int, int, int, int]]] = {}
        for k in forest.cut:
            key, offset, _, edge = places[k]
            closing.setdefault((key, offset), []).append(edge)
        for k in (*forest.cut, *forest.implied):
            key, offset, j, _ = places[k]
            uncut[key, offset][j] = False
        kept: dict[Any, dict[int, Bools]] = {}
        for (key, offset), mask in uncut.items():
            for quantity in range(offset, offset + parts[key, offset].var_count):
                kept.setdefault(key, {})[quantity] = mask
        closures = [f for place, rows in closing.items() for f in _closures(parts[place], np.array(rows, np.int64))]
        assertions = [f for k in forest.cut for f in _assertions(parts[places[k][:2]], places[k][3], self._pair(k))]
        said = [(self._text(k), _advice(parts[places[k][:2]])) for k in forest.cut]
        return Loops(forest, kept, closures, assertions, said)

    def _text(self, k: int) -> str:
        return f"{self._pair(k, 'with')} {self.graph.connections[k].where}"

    def _pair(self, k: int, joined: str = "and") -> str:
        link = self.graph.connections[k]
        return f"`{self.graph.names[link.a]}` {joined} `{self.graph.names[link.b]}`"


def _advice(template: Template) -> str:
    assert issubclass(template.cls, Overdetermined)
    return template.cls.loop_advice


def _each(edges: list[tuple[Ints, Ints, int]]) -> Iterator[tuple[int, int, int, int]]:
    """Ends, source and number of every connection."""
    for a, b, source in edges:
        for k, (x, y) in enumerate(zip(a.tolist(), b.tolist(), strict=True)):
            yield x, y, source, k


def _place(source: Source, ordinal: int) -> str:
    component = source.component(ordinal)
    return f"({f'`{component}`, ' if component else ''}{source.origin})"


def overdetermined_parts(template: Template) -> list[tuple[int, Template]]:
    """Offset and template of every overdetermined connector in a connector (itself, or nested)."""
    if issubclass(template.cls, Overdetermined):
        return [(0, template)]
    return [
        (offset + below, part)
        for slot in template.children.values() if slot.role != "outer"
        for _, child, offset, _, _ in slot.parts()
        for below, part in overdetermined_parts(child)
    ]  # fmt: skip


def _ends(template: Template) -> tuple[Any, Any]:
    """The connectors at both ends of a connection."""
    bare = record(template.cls, dict(template.structural))
    return view(bare, ("a",)), view(bare, ("b",))


def _closures(template: Template, rows: Ints) -> list[Family]:
    """``equality_constraint`` of the connectors at both ends of connections; `rows`: (node, node, source, number)."""
    a, b = _ends(template)
    return [_family(template, rows, as_expr(residual), "equality_constraint") for residual in a.equality_constraint(b)]


def _assertions(template: Template, edge: tuple[int, int, int, int], ends: str) -> list[Family]:
    """``equality_assertion`` of the connectors at both ends of one connection, which its message names."""
    a, b = _ends(template)
    item = a.equality_assertion(b)
    if item is None:
        return []
    named = replace(item, message=f"{ends}: {item.message}", at_start=True)
    return [_family(template, np.array([edge], np.int64), assertion_form(named), "equality_assertion")]


def _family(template: Template, rows: Ints, written: Expr, method: str) -> Family:
    """What a method of the connectors says of both ends, for all connections."""
    mapping: dict[Expr, Expr] = {}
    columns: list[Ints] = []
    for leaf in leaves(written):
        if leaf.op != "symbol" or leaf.value[0] not in ("a", "b"):
            raise DeclarationError(
                f"`{template.cls.__name__}.{method}` may use quantities of the two connectors only, not "
                f"`{path_text(leaf.value) if leaf.op == 'symbol' else leaf}`"
            )
        side, *tail = leaf.value
        offset = int(template.resolve(tuple(tail)).offsets)
        mapping[leaf] = var(len(columns))
        columns.append(rows[:, 0 if side == "a" else 1] + offset)
    none = np.zeros((len(rows), 0), np.int64)
    return Family(substitute(written, mapping), np.stack(columns, axis=1), none, rows[:, 2], rows[:, 3])
