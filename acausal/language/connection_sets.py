"""Connection sets: potentials equal, flows sum to zero (Modelica Language Specification 3.6, section 9.2)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components

from ..errors import ConnectError
from ..symbolic.equation import Origin
from ..symbolic.expr import add, neg, var
from .connections import Connect
from .declarations import Kind
from .flat_model import Bools, Family, Source
from .instance import path_text
from .template import Ints, Path, Template

Edge = tuple[Ints, Ints, int]


@dataclass(frozen=True, slots=True)
class End:
    """One end of a connect statement.

    Attributes:
        bases: first variables of the connectors, or the signals: (instances, *slice).
        template: of the connector; None for signals.
        inside: whether it belongs to a part of the component whose statement this is.
        gives: whether it is a signal that comes from this side: the output of a part, or the component's own input.
    """

    bases: Ints
    template: Template | None
    inside: bool
    gives: bool


@dataclass(slots=True)
class SignalEdges:
    """Signals joined by one connect statement: faces, as nodes of the graph, and those among them that give a value."""

    a: Ints
    b: Ints
    giving: Ints
    source: int


@dataclass(slots=True)
class ConnectionGraph:
    """Connector faces joined by connect statements.

    A connector is known by its first variable; its inside face (seen from the owner of the component it belongs to) is
    node ``2 * base``, its outside face (seen from the component's own equations) ``2 * base + 1``.
    """

    templates: dict[Any, Template] = field(default_factory=dict[Any, Template])
    connectors: dict[Any, list[tuple[Ints, Path]]] = field(default_factory=dict[Any, list[tuple[Ints, Path]]])
    edges: dict[Any, list[Edge]] = field(default_factory=dict[Any, list[Edge]])
    signals: list[SignalEdges] = field(default_factory=list[SignalEdges])

    def add_connectors(self, template: Template, base: Ints, path: Path) -> None:
        """Note instances of a connector class (only outermost connectors: nested ones belong to their owner)."""
        key = _interface(template)
        self.templates.setdefault(key, template)
        self.connectors.setdefault(key, []).append((base, path))

    def add(self, item: Connect, ends: list[End], source: int, origin: Origin) -> None:
        """One connect statement."""
        first = ends[0]
        for end in ends[1:]:
            a, b = _fit(first.bases, end.bases, item, origin)
            a, b = 2 * a + (not first.inside), 2 * b + (not end.inside)
            if first.template is None or end.template is None:
                giving = np.concatenate([a[:0], *([a] if first.gives else []), *([b] if end.gives else [])])
                self.signals.append(SignalEdges(a, b, giving, source))
                continue
            key = _interface(first.template)
            self.templates.setdefault(key, first.template)
            self.edges.setdefault(key, []).append((a, b, source))


def _interface(template: Template) -> Any:
    """Connectors with the same quantities in the same order can be joined."""
    return tuple((tail, kind) for tail, kind, _ in quantities(template))


def quantities(template: Template) -> list[tuple[Path, Kind, int]]:
    """Path, kind and offset of every variable of a connector, those of nested connectors included."""
    if "quantities" not in template.cache:
        found: list[tuple[Path, Kind, int]] = []
        for path, offset in template.leaf_names(False):
            declaration = template.resolve(path).declaration
            assert declaration is not None
            found.append((path, declaration.kind, offset))
        template.cache["quantities"] = found
    return template.cache["quantities"]


def _fit(a: Ints, b: Ints, item: Connect, origin: Origin) -> tuple[Ints, Ints]:
    """Ends of a connection, element by element."""
    m = len(a)
    a, b = a.reshape(m, -1), b.reshape(m, -1)
    if a.shape[1] != b.shape[1] and 1 not in (a.shape[1], b.shape[1]):
        names = ", ".join(path_text(p) for p in item.paths)
        raise ConnectError(
            f"connect({names}): slices of {a.shape[1]} and {b.shape[1]} elements do not fit; both need as many, "
            f"or one of them must be a single connector {origin}"
        )
    a, b = np.broadcast_arrays(a, b)
    return a.ravel(), b.ravel()


def _sets(a: Ints, b: Ints) -> tuple[Ints, Ints, Ints]:
    """The nodes that edges ``a - b`` join, in order, the set that each is in, and where each of `a` is among them."""
    nodes, inverse = np.unique(np.concatenate([a, b]), return_inverse=True)
    ia, ib = inverse[: len(a)], inverse[len(a) :]
    graph = coo_matrix((np.ones(len(a), np.int8), (ia, ib)), shape=(len(nodes), len(nodes)))
    return nodes, connected_components(graph, directed=False)[1], ia


def check_signals(edges: list[SignalEdges], root: Template, sources: list[Source]) -> None:
    """A signal comes from one side at most.

    Raises:
        ConnectError: outputs of several components are joined (a vector of outputs with one input, say).
    """
    giving = np.concatenate([np.zeros(0, np.int64), *(e.giving for e in edges)])
    if len(giving) < 2:
        return
    a, b = np.concatenate([e.a for e in edges]), np.concatenate([e.b for e in edges])
    statement = np.concatenate([np.full(len(e.giving), e.source) for e in edges])
    nodes, label, _ = _sets(a, b)
    givers, first = np.unique(giving, return_index=True)
    its_set = label[np.searchsorted(nodes, givers)]
    crowded = np.flatnonzero(np.bincount(its_set, minlength=1) > 1)
    if not len(crowded):
        return
    which = np.flatnonzero(its_set == crowded[0])
    names = {offset: path_text(path) for path, offset in root.leaf_names(False)}
    rows = [(names[int(givers[k]) >> 1], sources[int(statement[first[k]])].origin) for k in which]
    raise ConnectError(
        "outputs are joined, but a signal comes from one of them only:\n"
        + "".join(f"    {name}    {origin}\n" for name, origin in rows)
        + "Try: of a vector of outputs connect the element that is meant, `connect(table.y[0], gain.u)`; or combine "
        "the outputs by a block (`Add`, `Sum`, `Switch`)"
    )


@dataclass(slots=True)
class Joined:
    """Equations of all connections: aliases, zero flows, sums."""

    a: Ints
    b: Ints
    sign: Ints
    source: Ints
    ordinal: Ints
    zero: Ints
    zero_source: Ints
    zero_ordinal: Ints
    sums: list[Family]


@dataclass(slots=True)
class _Collector:
    alias: list[tuple[Ints, Ints, int, Ints, Ints]] = field(default_factory=list[Any])
    zero: list[tuple[Ints, Ints, Ints]] = field(default_factory=list[Any])
    sums: list[Family] = field(default_factory=list[Family])

    def joined(self) -> Joined:
        def cat(arrays: list[Any]) -> Ints:
            return np.concatenate([np.zeros(0, np.int64), *arrays])

        return Joined(
            cat([a for a, *_ in self.alias]), cat([b for _, b, *_ in self.alias]),
            cat([np.full(len(a), s) for a, _, s, *_ in self.alias]), cat([s for *_, s, _ in self.alias]),
            cat([o for *_, o in self.alias]), cat([z for z, *_ in self.zero]), cat([s for _, s, _ in self.zero]),
            cat([o for *_, o in self.zero]), self.sums,
        )  # fmt: skip


def solve_connections(
    graph: ConnectionGraph, root: Template, sources: list[Source], kept: dict[Any, dict[int, Bools]]
) -> Joined:
    """Equations of all connection sets of a model.

    Args:
        graph: the connections.
        root: template of the model.
        sources: where statements were written; those of unconnected connectors are added.
        kept: by interface, for the offset of a quantity the edges over which it is equal, where these are not all.
    """
    out = _Collector()
    check_signals(graph.signals, root, sources)
    for edges in graph.signals:
        n = len(edges.a)
        out.alias.append((edges.a >> 1, edges.b >> 1, 1, np.full(n, edges.source), np.arange(n)))
    for key in graph.connectors | graph.edges:
        _solve_interface(graph, key, sources, out, kept.get(key, {}))
    return out.joined()


def _solve_interface(
    graph: ConnectionGraph, key: Any, sources: list[Source], out: _Collector, kept: dict[int, Bools]
) -> None:
    template = graph.templates[key]
    edges = graph.edges.get(key, [])
    a = np.concatenate([np.zeros(0, np.int64), *(e[0] for e in edges)])
    b = np.concatenate([np.zeros(0, np.int64), *(e[1] for e in edges)])
    edge_source = np.concatenate([np.zeros(0, np.int64), *(np.full(len(e[0]), e[2]) for e in edges)])
    edge_ordinal = np.concatenate([np.zeros(0, np.int64), *(np.arange(len(e[0])) for e in edges)])
    nodes, label, ia = _sets(a, b)
    n = len(nodes)
    order = np.lexsort((nodes, label))
    nodes, label = nodes[order], label[order]
    # an edge of each set, to name where the set was written
    by_set = np.zeros(label.max() + 1 if n else 0, np.int64)
    position = np.empty(n, np.int64)
    position[order] = np.arange(n)
    by_set[label[position[ia[::-1]]]] = np.arange(len(a))[::-1]
    bounds = np.flatnonzero(np.r_[True, label[1:] != label[:-1], True]) if n else np.zeros(1, np.int64)
    first, size = bounds[:-1], np.diff(bounds)
    set_source, set_ordinal = edge_source[by_set], edge_ordinal[by_set]
    for _, kind, offset in quantities(template):
        if kind == Kind.FLOW:
            _flows(nodes, offset, first, size, set_source, set_ordinal, out)
        elif offset in kept:
            uncut = kept[offset]
            _pairwise(a[uncut] >> 1, b[uncut] >> 1, offset, edge_source[uncut], edge_ordinal[uncut], out)
        else:
            _potentials(nodes, label, first, offset, set_source, set_ordinal, out)
    _unconnected(graph.connectors.get(key, []), template, nodes, sources, out)


def _potentials(
    nodes: Ints, label: Ints, first: Ints, offset: int, source: Ints, ordinal: Ints, out: _Collector
) -> None:
    head = (nodes[first] >> 1)[label]
    here = nodes >> 1
    other = here != head
    chosen = label[other]
    out.alias.append((here[other] + offset, head[other] + offset, 1, source[chosen], ordinal[chosen]))


def _pairwise(a: Ints, b: Ints, offset: int, source: Ints, ordinal: Ints, out: _Collector) -> None:
    """Equal potentials over edges that form no loop."""
    out.alias.append((a + offset, b + offset, 1, source, ordinal))


def _flows(
    nodes: Ints, offset: int, first: Ints, size: Ints, source: Ints, ordinal: Ints, out: _Collector
) -> None:
    """Inside faces count positive, outside faces negative."""
    ids, sign = (nodes >> 1) + offset, 1 - 2 * (nodes & 1)
    for s in np.unique(size):
        sets = np.flatnonzero(size == s)
        columns = first[sets][:, None] + np.arange(s)
        rows, signs = ids[columns], sign[columns]
        if s == 2:
            for product in (1, -1):
                pick = signs[:, 0] * signs[:, 1] == product
                chosen = sets[pick]
                out.alias.append((rows[pick, 0], rows[pick, 1], -product, source[chosen], ordinal[chosen]))
            continue
        patterns, which = np.unique(signs, axis=0, return_inverse=True)
        for k, pattern in enumerate(patterns):
            pick = which.ravel() == k
            residual = add(*(var(j) if positive > 0 else neg(var(j)) for j, positive in enumerate(pattern)))
            chosen = sets[pick]
            none = np.zeros((len(chosen), 0), np.int64)
            out.sums.append(Family(residual, rows[pick], none, source[chosen], ordinal[chosen]))


def _unconnected(
    instances: list[tuple[Ints, Path]], template: Template, nodes: Ints, sources: list[Source], out: _Collector
) -> None:
    """Flows of connectors that nothing is connected to are zero."""
    offsets = [offset for _, kind, offset in quantities(template) if kind == Kind.FLOW]
    for base, path in instances:
        loose = np.flatnonzero(~np.isin(2 * base, nodes))
        if not len(loose) or not offsets:
            continue
        cls = template.cls
        sources.append(Source(Origin(cls.__qualname__, *cls._source, "unconnected"), path, 1))
        for offset in offsets:
            source = np.full(len(loose), len(sources) - 1)
            out.zero.append((base[loose] + offset, source, loose))
