"""Where the user wrote what a message is about: the fields that declare components, and the connect statements."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from ..language.flat_model import FlatModel
from ..language.places import field_place, owner_of
from ..language.template import Template
from ..symbolic.printing import path_text

SHOWN = 8
"""Lines of one kind."""


def declared(flat: FlatModel, paths: Iterable[str]) -> list[str]:
    """One line for each component or variable: its path, the field that declares it, and where."""
    rows: list[tuple[str, str, str]] = []
    seen: set[str] = set()
    for path in paths:
        found = owner_of(flat.root, path) if path and not path.startswith("der(") else None
        if found is None:
            continue
        slot = found[0].children.get(found[1])
        if slot is not None and slot.templates and slot.templates[0].is_connector and "." in path:
            path = path.rpartition(".")[0]  # a connector says less than the component it belongs to
            found = owner_of(flat.root, path) or found
        text, place = field_place(found[0].cls, found[1])
        if place not in seen:
            rows.append((path, text, place))
        seen.add(place)
    width = min(max((len(text) for _, text, _ in rows[:SHOWN]), default=0), 60)
    return [f"    {text or path:<{width}}    {place}" for path, text, place in rows[:SHOWN]]


def connected(flat: FlatModel, components: Iterable[str]) -> list[str]:
    """The connect statements that join the components among each other."""
    wanted = [_pattern(c) for c in components if c]
    lines: list[str] = []
    for prefix, template in _owners(flat.root, wanted):
        for item, origin in template.connections:
            ends = [_pattern(path_text((*prefix, *path))) for path in item.paths]
            touching = [e for e in ends if any(e == w or e.startswith(f"{w}.") for w in wanted)]
            if len(touching) >= 2:
                names = ", ".join(path_text(path) for path in item.paths)
                lines.append(f"    connect({names})    {origin.file}:{origin.line}")
    return lines[:SHOWN]


def _pattern(path: str) -> str:
    """A path with its indices left out."""
    return re.sub(r"\[[^\]]*\]", "", path)


def _owners(root: Template, wanted: list[str]) -> Iterator[tuple[tuple[str, ...], Template]]:
    """The model, and every component that owns one of `wanted`."""
    prefixes = {tuple(w.split(".")[:k]): None for w in wanted for k in range(w.count(".") + 1)}
    for prefix in prefixes or {(): None}:
        template: Template | None = root
        for name in prefix:
            slot = None if template is None else template.children.get(name)
            template = slot.templates[0] if slot is not None and slot.templates else None
        if template is not None:
            yield prefix, template


def context(flat: FlatModel, components: Iterable[str], unknowns: Iterable[str] = ()) -> str:
    """The paragraph of a message that leads to the user's own lines; empty if there is nothing to say."""
    components = list(dict.fromkeys(components))
    lines = [*declared(flat, [*components, *unknowns]), *connected(flat, components)]
    return "\n".join(["Written in:", *lines]) if lines else ""
