"""The `connect` statement."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..errors import ConnectError
from ..symbolic.expr import Expr
from .component import Component, Connector
from .instance import call_site, path_of
from .vectors import Vector

Path = tuple[Any, ...]


@dataclass(frozen=True, slots=True, eq=False)
class Connect:
    """A connection between connectors (or signals) of one class, by their paths."""

    paths: tuple[Path, ...]
    connectors: tuple[type[Connector] | None, ...]


def connect(
    first: Connector | Expr | Vector, second: Connector | Expr | Vector, *more: Connector | Expr | Vector
) -> Connect:
    """Join connectors: potentials become equal, flows sum to zero. Signals (`Input`, `Output`) become equal.

    Vectors of signals join element by element.

    Slices of component arrays join element by element; one connector against a slice joins all of them in one node.

    Raises:
        ConnectError: connectors of different kinds, or something that is no connector.
    """
    ends = (first, second, *more)
    kinds = tuple(_kind(end) for end in ends)
    for end, kind in zip(ends[1:], kinds[1:], strict=True):
        if (kind is None) != (kinds[0] is None) or (kind is not None and not _alike(kind, kinds[0])):
            raise ConnectError(
                f"connect({_text(first)}, {_text(end)}): {_name(kinds[0])} and {_name(kind)} are unlike; both ends "
                f"must be connectors with the same potentials and flows, or both signals {call_site()}"
            )
    return Connect(tuple(_path(end) for end in ends), kinds)


def _kind(end: Any) -> type[Connector] | None:
    if isinstance(end, Connector):
        return type(end)
    if (isinstance(end, Expr) and end.op == "symbol") or (isinstance(end, Vector) and "path" in end.__dict__):
        return None
    what = f"component `{path_of(end)}`; connect one of its ports" if isinstance(end, Component) else f"{end!r}"
    raise ConnectError(f"connect() joins connectors, not {what} {call_site()}")


def _alike(a: type[Connector], b: type[Connector] | None) -> bool:
    if b is None:
        return False
    return a is b or _signature(a) == _signature(b)


def _signature(kind: type[Connector]) -> list[tuple[str, int]]:
    return [(name, int(d.kind)) for name, d in kind._declarations.items()]


def _path(end: Connector | Expr | Vector) -> Path:
    if isinstance(end, Vector):
        return end.__dict__["path"]
    return end.value if isinstance(end, Expr) else end.__dict__["_path"]


def _text(end: Connector | Expr | Vector) -> str:
    return path_of(end) if isinstance(end, Connector) else str(end)


def _name(kind: type[Connector] | None) -> str:
    return "a signal" if kind is None else f"connector `{kind.__name__}` ({', '.join(kind._declarations)})"
