"""What a component is to the rest of the language: tables of fields, and a record of modifications at a path."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from ..callers import PACKAGE, callers, package_of
from ..symbolic.printing import path_text
from .sizes import sized

if TYPE_CHECKING:
    from .children import Child
    from .declarations import Declaration, Structural
    from .vectors import Quantities

R = TypeVar("R", bound="Instance")


class Instance:
    """Base of `Component`, for the modules that it is built from."""

    _declarations: ClassVar[dict[str, Declaration]] = {}
    _structural: ClassVar[dict[str, Structural]] = {}
    _children: ClassVar[dict[str, Child]] = {}
    _vectors: ClassVar[dict[str, Quantities]] = {}
    _sizes: ClassVar[dict[str, str]] = {}  # vectors with a structural size, and what gives it
    _lengths: ClassVar[tuple[int, ...]] = ()
    _generic: ClassVar[type[Instance] | None] = None
    _made: ClassVar[dict[tuple[int, ...], type[Any]]] = {}
    _partial: ClassVar[bool] = True
    _source: ClassVar[tuple[str, int]] = ("", 0)


def record(cls: type[R], mods: Mapping[str, Any], path: tuple[Any, ...] = ()) -> R:
    """An instance with modifications that have been checked before."""
    new = object.__new__(sized(cls, mods))
    new.__dict__["_mods"] = mods
    new.__dict__["_path"] = path
    return new


def path_of(component: Instance) -> str:
    """Dotted path of a component reached from its root."""
    return path_text(component.__dict__["_path"])


def field_names(cls: type[Instance]) -> list[str]:
    """All fields of a class."""
    return [*cls._declarations, *cls._vectors, *cls._structural, *cls._children]


def call_site() -> str:
    """``(file:line)`` of the nearest caller outside this package; its libraries of components count as outside."""
    for frame, module in callers():
        if package_of(module) != PACKAGE or module.startswith(f"{PACKAGE}.components"):
            return f"({frame.f_code.co_filename}:{frame.f_lineno})"
    return ""


__all__ = ["Instance", "call_site", "field_names", "path_of", "path_text", "record"]
