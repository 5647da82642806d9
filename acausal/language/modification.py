"""Variants of a model: fields at dotted paths changed, sub-components replaced."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, TypeVar, cast

from ..errors import DeclarationError, nearest
from .checking import by_element, checked
from .children import effective_child, merged
from .component import Component, fitting_class, with_modifications
from .declarations import Value
from .fields import Array, Shared
from .instance import call_site, record

C = TypeVar("C", bound=Component)


def modify(model: C, changes: Mapping[str, Value | Sequence[float]]) -> C:
    """A copy of `model` with fields at dotted paths changed; the original is untouched.

    Args:
        model: a component.
        changes: by dotted path, a number, a `start`, a structural value or a component: ``{"valve.area": 2e-4}``.

    Raises:
        DeclarationError: a path that the model does not have, or a value of the wrong type.
    """
    result = model
    for path, value in changes.items():
        result = _modify_one(result, result, path.split("."), value, path)
    return result


def redeclare(model: C, replacements: Mapping[str, Component]) -> C:
    """A variant of `model` with sub-components at dotted paths replaced; modifications that both classes know stay.

    Args:
        model: a component.
        replacements: by dotted path, the new sub-component, of the declared type or a subclass.

    Raises:
        DeclarationError: a path that the model does not have, or a replacement of the wrong type.
    """
    for path, value in replacements.items():
        if not isinstance(value, (Component, Array)):
            raise DeclarationError(f"redeclare: `{path}` needs a component, not {type(value).__name__} {call_site()}")
    return modify(model, cast("Mapping[str, Value]", replacements))


def _modify_one(given: C, effective: Component, parts: list[str], value: Any, path: str) -> C:
    """`given` with one more modification; `effective` is the same component with its declaration's modifications."""
    head = parts[0]
    cls = type(effective)
    if len(parts) == 1:
        old = given.__dict__["_mods"]
        cls = fitting_class(cls, old, {head: value})
        changed = {name: checked(cls, name, one) for name, one in by_element(cls, {head: value}).items()}
        return with_modifications(given, {k: merged(old[k], v) if k in old else v for k, v in changed.items()})
    if head not in cls._children:
        name, index, _ = head.partition("[")
        if index and name in cls._children:
            raise DeclarationError(
                f"`{path}`: elements of `{name}` are not modified one by one: leave the index out to modify all of "
                f"them, or give a value for each, `{name}=Array(..., n, field=[...])` {call_site()}"
            )
        hint = nearest(name, cls._children)
        raise DeclarationError(f"`{path}`: class `{cls.__name__}` has no sub-component `{name}`.{hint} {call_site()}")
    child = effective_child(effective, head)
    child = child.component if isinstance(child, Shared) else child
    below = given.__dict__["_mods"].get(head)
    if isinstance(child, Array):
        element = below._element if isinstance(below, Array) else below if isinstance(below, Component) else None
        changed = _modify_one(element or _unmodified(child._element), child._element, parts[1:], value, path)
        if isinstance(below, Array):
            return with_modifications(given, {head: Array(changed, below._count, **below._values)})
        return with_modifications(given, {head: changed})
    if not isinstance(child, Component):
        raise DeclarationError(f"`{path}`: `{head}` is a list of components: give a new list {call_site()}")
    changed = _modify_one(below or _unmodified(child), child, parts[1:], value, path)
    return with_modifications(given, {head: changed})


def _unmodified(component: Component) -> Component:
    """A component of the same class and structure without other modifications."""
    cls = type(component)
    mods = component.__dict__["_mods"]
    return record(cls, {k: v for k, v in mods.items() if k in cls._structural} if cls._sizes else {})
