"""Where a field is declared, and errors of components that were made elsewhere than where they are found out."""

from __future__ import annotations

import linecache
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from ..errors import DeclarationError
from .component import Component

if TYPE_CHECKING:
    from .template import Template

PACKAGE = str(Path(__file__).parents[1])


def field_place(cls: type[Component], name: str) -> tuple[str, str]:
    """Source text and ``file:line`` of the field `name` in the class body that declares it."""
    owner = next((base for base in cls.__mro__ if name in base.__dict__ and issubclass(base, Component)), cls)
    file, first = owner._source
    lines = linecache.getlines(file)
    for number in range(first, len(lines)):
        text = lines[number]
        if re.match(rf"\s+{re.escape(name)}\s*[:=]", text):
            return text.strip(), f"{file}:{number + 1}"
        if text.strip() and not text[0].isspace() and not text.startswith((")", "]", "#")):
            break
    return "", f"{file}:{first} ({owner.__name__})"


def owner_of(root: Template, path: str) -> tuple[Template, str] | None:
    """Template of the component that declares the last field of a dotted path, and that field's name."""
    template = root
    *owners, last = path.split(".")
    for piece in owners:
        head, _, index = piece.partition("[")
        slot = template.children.get(head)
        if slot is None or not slot.templates:
            return None
        k = 0 if slot.uniform or not index else int(index.rstrip("]"))
        template = slot.templates[k]
    return template, last.partition("[")[0]


def users_field(root: Template, path: str) -> str:
    """The innermost field on a dotted path that is not declared in this package, and where; empty if all are."""
    pieces = path.split(".")
    for n in range(len(pieces), 0, -1):
        found = owner_of(root, ".".join(pieces[:n]))
        text, place = field_place(found[0].cls, found[1]) if found is not None else ("", PACKAGE)
        if not place.startswith(PACKAGE):
            return f"{text or pieces[n - 1]}    {place}"
    return ""


@contextmanager
def located(owner: type[Component], name: str) -> Iterator[None]:
    """Errors of the component in field `name` of `owner` get the line of that field, if none of the user's is in them.

    A component of a library finds out when its equations are made that its parameters do not fit together, and knows
    only its own class. What the user wrote is the innermost field on the way to it that is not in a library.
    """
    try:
        yield
    except DeclarationError as error:
        text, place = field_place(owner, name)
        if not place.startswith(PACKAGE) and not has_place(str(error)):
            error.args = (f"{error}\nWritten in:\n    {text or name}    {place}",)
        raise


def has_place(message: str) -> bool:
    """Whether a message names a line outside this package."""
    found = re.findall(r"(\S[^\n(]*):\d+\)", message)
    return "Written in:" in message or any(not file.startswith(PACKAGE) for file in found)
