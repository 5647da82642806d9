"""Compiled programs kept with the lowered system they belong to, so that they go when it goes."""

from __future__ import annotations

import weakref
from collections.abc import Callable
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


def without_keeping(owner: Any, function: Callable[..., Any]) -> Callable[..., Any]:
    """``function(owner, ...)`` as a function of the rest that does not keep the owner alive.

    Programs are kept with their owner, by objects of JAX through which Python's collector does not find its way: if
    they kept the owner in turn, neither would ever go.
    """
    held = weakref.ref(owner)

    def call(*arguments: Any) -> Any:
        return function(held(), *arguments)

    return call


class ById:
    """Hashes and compares a thing by identity, for use as a key or as static data of a pytree.

    Args:
        thing: what it stands for.
        keep: whether it keeps the thing alive.
    """

    def __init__(self, thing: Any, *, keep: bool = True) -> None:
        self._held = (lambda: thing) if keep else weakref.ref(thing)
        self._id = id(thing)

    @property
    def thing(self) -> Any:
        """The thing; None where it is gone."""
        return self._held()

    def __hash__(self) -> int:
        return self._id

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, ById) or self._id != other._id:
            return False
        return self is other or (self.thing is other.thing and self.thing is not None)
