"""Connectors at which something has to be connected, because their component means nothing without.

A joint, a spring or a sensor with a loose end can be a regular system all the same (the loose end is wherever it puts
no force), or a singular one that says much of its equations and nothing of the connection that was forgotten.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..errors import ConnectError
from .component import Component
from .connection_sets import ConnectionGraph
from .flat_model import Source
from .places import users_field
from .template import Ints, Path, Template

SHOWN = 5
"""Connectors named in one message."""


@dataclass(frozen=True, slots=True)
class Needed:
    """A connector of all instances of a component, known by their first variables."""

    cls: type[Component]
    path: Path
    name: str
    bases: Ints


@dataclass(slots=True)
class LooseEnds:
    """Collects the connectors that are needed, then looks for those to which nothing is connected."""

    needed: list[Needed] = field(default_factory=list[Needed])

    def add(self, template: Template, path: Path, var_base: Ints) -> None:
        """All instances of a component, but for the model itself: what it is connected to is not there."""
        for name in template.cls._must_connect if path else ():
            slot = template.children.get(name)
            if slot is not None and slot.templates:
                self.needed.append(Needed(template.cls, path, name, var_base + slot.var_offsets[0]))

    def check(self, graph: ConnectionGraph, root: Template) -> None:
        """Check that something is connected to all of them.

        Raises:
            ConnectError: nothing is; names the connectors, and others that are loose.
        """
        edges = [end for key in graph.edges for a, b, _ in graph.edges[key] for end in (a, b)]
        joined = np.unique(np.concatenate([np.zeros(0, np.int64), *edges]))
        found: list[tuple[str, Needed]] = []
        for item in self.needed:
            names = Source(None, item.path, 1)  # type: ignore[arg-type]
            loose = np.flatnonzero(~np.isin(2 * item.bases, joined))
            found += [(names.component(int(k)), item) for k in loose[:SHOWN]]
        if found:
            raise ConnectError(_text(found[:SHOWN], _others(graph, joined, found), root))


def _text(found: list[tuple[str, Needed]], others: list[str], root: Template) -> str:
    ends = ", ".join(f"`{component}.{item.name}`" for component, item in found)
    lines = [f"nothing is connected to {ends}"]
    for cls in dict.fromkeys(item.cls for _, item in found):
        names = " and ".join(f"`{name}`" for name in cls._must_connect)
        lines.append(f"    a `{cls.__name__}` acts on what is connected to {names}")
    fields = dict.fromkeys(users_field(root, component) for component, _ in found)
    written = [f"    {text}" for text in fields if text]
    lines += ["Written in:", *written] if written else []
    component, item = found[0]
    also = f"; nothing is connected to {', '.join(f'`{name}`' for name in others)} either" if others else ""
    lines.append(f"Try: connect(self.{component}.{item.name}, ...) in `equations`{also}")
    return "\n".join(lines)


def _others(graph: ConnectionGraph, joined: Ints, found: list[tuple[str, Needed]]) -> list[str]:
    """Loose connectors that the first one fits, of other components."""
    known = {f"{component}.{item.name}" for component, item in found}
    first = int(found[0][1].bases[0])
    for instances in graph.connectors.values():
        if not any(first in bases for bases, _ in instances):
            continue
        loose = (
            Source(None, path, 1).component(int(k))  # type: ignore[arg-type]
            for bases, path in instances for k in np.flatnonzero(~np.isin(2 * bases, joined)) if len(path) == 2
        )  # fmt: skip
        return [name for name in loose if name not in known][:SHOWN]
    return []
