"""The spanning forest of overdetermined connectors (Modelica Language Specification 3.6, section 9.4.2).

Nodes are the overdetermined connectors, known by their first variable. Branches within components are kept; connections
are taken in the order they are written and cut where they would close a loop or join two trees with roots of their own.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, field
from typing import Any

from ..errors import ConnectError


@dataclass(frozen=True, slots=True, eq=False)
class Link:
    """An edge between two nodes, and the text of the place where it was written."""

    a: int
    b: int
    where: str


@dataclass(slots=True, eq=False)
class Roots:
    """What is known of the nodes.

    Attributes:
        names: of every node.
        definite, potential: place where it was said; priority of a potential root.
    """

    names: dict[int, str] = field(default_factory=dict[int, str])
    definite: dict[int, str] = field(default_factory=dict[int, str])
    potential: dict[int, int] = field(default_factory=dict[int, int])
    branches: list[Link] = field(default_factory=list[Link])
    connections: list[Link] = field(default_factory=list[Link])


@dataclass(slots=True, eq=False)
class Forest:
    """The outcome.

    Attributes:
        roots: of all trees.
        inward: nodes whose way to the root leads through a branch of their own component.
        cut: numbers of the connections that close a loop.
        implied: numbers of the connections that other connections already imply.
    """

    roots: set[int]
    inward: set[int]
    cut: list[int]
    implied: list[int]


class Sets:
    """Disjoint sets; each may know one definite root."""

    def __init__(self) -> None:
        self.parent: dict[Any, Any] = {}
        self.root: dict[Any, int] = {}

    def find(self, x: Any) -> Any:
        """Representative of a set."""
        at = self.parent.setdefault(x, x)
        while self.parent[at] != at:
            self.parent[at] = at = self.parent[self.parent[at]]
        return at

    def join(self, x: Any, y: Any) -> None:
        """Merge two sets."""
        x, y = self.find(x), self.find(y)
        self.parent[y] = x
        if y in self.root:
            self.root[x] = self.root.pop(y)


def spanning_forest(graph: Roots) -> Forest:
    """Choose roots and cuts.

    Raises:
        ConnectError: a tree without root, or several roots joined rigidly.
    """
    trees = _branched(graph)
    joined = Sets()  # by connections alone
    joined.root.update({node: node for node in graph.definite})
    adjacent: dict[int, list[tuple[int, bool]]] = {node: [] for node in graph.names}
    for link in graph.branches:
        adjacent[link.a].append((link.b, True))
        adjacent[link.b].append((link.a, True))
    cut: list[int] = []
    implied: list[int] = []
    for k, link in enumerate(graph.connections):
        x, y = trees.find(link.a), trees.find(link.b)
        u, v = joined.find(link.a), joined.find(link.b)
        if u == v:
            implied.append(k)
            continue
        if x == y or (x in trees.root and y in trees.root):
            if u in joined.root and v in joined.root:
                _rigid(graph, joined.root[u], joined.root[v], link.where)
            cut.append(k)
            continue
        trees.join(x, y)
        joined.join(u, v)
        adjacent[link.a].append((link.b, False))
        adjacent[link.b].append((link.a, False))
    roots = _roots(graph, trees)
    return Forest(roots, _inward(roots, adjacent), cut, implied)


def _branched(graph: Roots) -> Sets:
    """Nodes joined by branches."""
    trees = Sets()
    for node in graph.definite:
        trees.root[node] = node
    for link in graph.branches:
        x, y = trees.find(link.a), trees.find(link.b)
        if x == y:
            raise ConnectError(
                f"the branches of the components close a loop at `{graph.names[link.a]}` and `{graph.names[link.b]}` "
                f"{link.where}: an orientation is given twice; only connections may close loops"
            )
        if x in trees.root and y in trees.root:
            _rigid(graph, trees.root[x], trees.root[y], link.where)
        trees.join(x, y)
    return trees


def _rigid(graph: Roots, a: int, b: int, where: str) -> None:
    raise ConnectError(
        f"`{graph.names[a]}` and `{graph.names[b]}` both fix what is joined rigidly {where}: the first is a root by "
        f"{graph.definite[a]}, the second by {graph.definite[b]}. Leave one of them out, or put a joint between them"
    )


def _roots(graph: Roots, trees: Sets) -> set[int]:
    """The root of every tree: its definite root, else the potential root of lowest priority named first."""
    chosen: dict[Any, int] = {trees.find(node): node for node in graph.definite}
    for node in sorted(graph.potential, key=lambda n: graph.potential[n]):  # a stable sort: in order of appearance
        chosen.setdefault(trees.find(node), node)
    lost: dict[Any, list[str]] = {}
    for node, name in graph.names.items():
        tree = trees.find(node)
        if tree not in chosen:
            lost.setdefault(tree, []).append(name)
    if lost:
        names = next(iter(lost.values()))
        shown = ", ".join(f"`{n}`" for n in names[:6]) + (f" and {len(names) - 6} more" if len(names) > 6 else "")
        raise ConnectError(
            f"nothing gives {shown}: the connections lead to no root. Connect one of them to a component that fixes it "
            "(`World`, `Fixed`) or that can have it as a state (`Body`, or `FreeMotion` to one that is fixed)"
        )
    return set(chosen.values())


def _inward(roots: set[int], adjacent: dict[int, list[tuple[int, bool]]]) -> set[int]:
    """Nodes that are reached from the roots through a branch."""
    inward: set[int] = set()
    seen = set(roots)
    queue = deque(sorted(roots))
    while queue:
        node = queue.popleft()
        for other, through_branch in adjacent[node]:
            if other not in seen:
                seen.add(other)
                queue.append(other)
                if through_branch:
                    inward.add(other)
    return inward
