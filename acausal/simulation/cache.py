"""Compiled programs kept with the lowered system they belong to, so that they go when it goes."""

from __future__ import annotations

from typing import Any

_ATTRIBUTE = "_simulation_cache"
_kept: dict[int, tuple[Any, dict[Any, Any]]] = {}


def cache_of(owner: Any) -> dict[Any, Any]:
    """The cache of `owner`, made on first use; an owner that takes no attributes is kept alive instead."""
    found = getattr(owner, _ATTRIBUTE, None)
    if found is not None:
        return found
    if id(owner) in _kept:
        return _kept[id(owner)][1]
    made: dict[Any, Any] = {}
    try:
        object.__setattr__(owner, _ATTRIBUTE, made)
    except (AttributeError, TypeError):
        _kept[id(owner)] = (owner, made)
    return made


class ById:
    """Hashes and compares a thing by identity, for use as a key or as static data of a pytree."""

    def __init__(self, thing: Any) -> None:
        self.thing = thing

    def __hash__(self) -> int:
        return id(self.thing)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, ById) and self.thing is other.thing
