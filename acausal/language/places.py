"""Where a field is declared, and errors of components that were made elsewhere than where they are found out."""

from __future__ import annotations

import linecache
import re
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ..errors import DeclarationError
from .component import Component

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
