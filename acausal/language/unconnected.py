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
    """A connector, or an array of them, of all instances of a component.

    Attributes:
        cls: the component's class.
        path: pattern of the connectors' paths.
        sized: name of the structural parameter that says how many there are, if there is one.
        bases: their first variables.
    """

    cls: type[Component]
    path: Path
    sized: str
    bases: Ints


@dataclass(slots=True)
class LooseEnds:
    """Collects the connectors that are needed, then looks for those to which nothing is connected."""

    needed: list[Needed] = field(default_factory=list[Needed])

    def add(self, template: Template, path: Path, var_base: Ints) -> None:
        """All instances of a component, but for the model itself: what it is connected to is not there."""
        for name in template.cls._must_connect if path else ():
            slot = template.children.get(name)
            if slot is None or not slot.templates:
                continue
            count = getattr(template.cls._children[name].default, "_count", "")
            for suffix, connector, first, _, repetitions in slot.parts():
                elements = first + connector.var_count * np.arange(repetitions)
                bases = (var_base[:, None] + elements).ravel()
                self.needed.append(
                    Needed(template.cls, (*path, *suffix), count if isinstance(count, str) else "", bases)
                )

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
    lines = [f"nothing is connected to {', '.join(f'`{connector}`' for connector, _ in found)}"]
    for cls in dict.fromkeys(item.cls for _, item in found):
        names = " and ".join(f"`{name}`" for name in cls._must_connect)
        lines.append(f"    a `{cls.__name__}` acts on what is connected to {names}")
    fields = dict.fromkeys(users_field(root, connector.rpartition(".")[0]) for connector, _ in found)
    written = [f"    {text}" for text in fields if text]
    lines += ["Written in:", *written] if written else []
    connector, item = found[0]
    fewer = f", or fewer of them: `{item.sized}` says how many there are" if item.sized else ""
    also = f"; nothing is connected to {', '.join(f'`{name}`' for name in others)} either" if others else ""
    lines.append(f"Try: connect(self.{connector}, ...) in `equations`{fewer}{also}")
    return "\n".join(lines)


def _others(graph: ConnectionGraph, joined: Ints, found: list[tuple[str, Needed]]) -> list[str]:
    """Loose connectors that the first one fits, of other components."""
    known = {connector for connector, _ in found}
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
