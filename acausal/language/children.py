"""Sub-components as their owner has them: the declaration, its modifications and the replacement together."""

from __future__ import annotations

import inspect
from typing import Any

from ..errors import DeclarationError, nearest
from .checking import checked
from .declarations import Start, Structural
from .fields import Array, Shared, StructuralReference, view
from .instance import Instance, field_names, record
from .sizes import sized
from .unknown_parameters import declared_class, with_unknowns


class Child:
    """Descriptor of a sub-component, connector, component array or list of components."""

    def __init__(self, name: str, default: Any, constraint: Any, condition: str = "") -> None:
        self.name = name
        self.default = default
        self.constraint = constraint
        self.condition = condition

    def __get__(self, instance: Any, owner: type[Any]) -> Any:
        if instance is None:
            return self.default
        if not present(instance, self.name):
            raise AttributeError(self.name)  # explained by Component.__getattr__
        cache = instance.__dict__.setdefault("_views", {})
        if self.name not in cache:
            cache[self.name] = view(effective_child(instance, self.name), (*instance.__dict__["_path"], self.name))
        return cache[self.name]

    def __set__(self, instance: object, value: object) -> None:
        raise DeclarationError(
            f"sub-component `{self.name}` of `{type(instance).__name__}` is replaced at construction, "
            f"`{type(instance).__name__}({self.name}=...)`, or with acausal.redeclare(model, {{path: replacement}})"
        )


def present(owner: Instance, name: str) -> bool:
    """Whether sub-component `name` exists in `owner`, going by its condition."""
    child = type(owner)._children.get(name)
    return child is None or not child.condition or bool(getattr(owner, child.condition))


def with_structure(child: Any, owner: Instance) -> Any:
    """A declaration with references to structural parameters of `owner` replaced by their values."""
    if isinstance(child, StructuralReference):
        if child.name not in type(owner)._structural and not isinstance(
            inspect.getattr_static(type(owner), child.name, None), property
        ):
            raise DeclarationError(
                f"`{type(owner).__name__}`: {child!r} is no structural parameter or property of the class."
                f"{nearest(child.name, type(owner)._structural)} ({type(owner)._source[0]}:{type(owner)._source[1]})"
            )
        return getattr(owner, child.name)
    if isinstance(child, Shared):
        return Shared(with_structure(child.component, owner), child.role)
    if isinstance(child, Array):
        copy = Array(with_structure(child._element, owner), child._count, **child._values)
        copy._length = child._length
        return copy
    if isinstance(child, (list, tuple)) and child and all(isinstance(c, Instance) for c in child):
        return [with_structure(c, owner) for c in child]
    if not isinstance(child, Instance) or not _refers(child):
        return child
    mods = child.__dict__["_mods"]
    found = {k: with_structure(v, owner) for k, v in mods.items()}
    return record(type(child), {k: checked(type(child), k, v) if v is not mods[k] else v for k, v in found.items()})


def _refers(component: Instance) -> bool:
    values = component.__dict__["_mods"].values()
    return any(isinstance(v, StructuralReference) or (isinstance(v, Instance) and _refers(v)) for v in values)


def effective_child(owner: Instance, name: str) -> Any:
    """Sub-component `name` of `owner` after modifications, with an array's length resolved.

    The modifications written in the declaration carry over to a replacement for the fields it also has
    (Modelica Language Specification 3.6, section 7.3.2, constraining clause).
    """
    descriptor = type(owner)._children[name]
    default = with_structure(descriptor.default, owner)
    given = owner.__dict__["_mods"].get(name)
    child = default if given is None else merged(default, given)
    if isinstance(child, Array) and child._length is None:
        return _with_length(owner, name, child)
    check_length(owner, name, default, child)
    return child


def check_length(owner: Instance, name: str, default: Any, child: Any) -> None:
    """Raise DeclarationError for a list of components in the place of an array of another length."""
    if not isinstance(child, list) or not isinstance(default, Array):
        return
    wanted = len(default) if default._length is not None else len(_with_length(owner, name, default))
    if wanted != len(child):
        raise DeclarationError(
            f"`{type(owner).__name__}({name}=[...])`: a list of {len(child)} components in the place of an array of "
            f"{wanted}: its length is {default._count!r}"
        )


def _with_length(owner: Instance, name: str, child: Array[Any]) -> Array[Any]:
    count = child._count
    known = isinstance(count, str) and isinstance(
        inspect.getattr_static(type(owner), count, None), (property, Structural)
    )
    length = getattr(owner, str(count)) if known else count
    if not isinstance(length, int) or isinstance(length, bool) or length < 0:
        raise DeclarationError(
            f"`{type(owner).__name__}.{name}`: the count {count!r} of a component array must be a non-negative integer "
            f"or the name of a structural parameter or property of the class."
            f"{nearest(str(count), type(owner)._structural)}"
        )
    resolved = Array(child._element, count, **child._values)
    resolved._length = length
    return resolved


def merged(default: Any, given: Any) -> Any:
    """`given`, with the modifications of `default` for fields that both have."""
    if isinstance(default, Shared):
        return Shared(merged(default.component, given.component if isinstance(given, Shared) else given), default.role)
    if isinstance(default, Array) and isinstance(given, Instance):
        known = field_names(type(given))
        values = {k: v for k, v in default._values.items() if k in known}
        changed = Array(merged(default._element, given), default._count, **values)
        changed._length = default._length
        return changed
    if isinstance(default, Array) and isinstance(given, Array):
        known = field_names(type(given._element))
        values = {k: v for k, v in default._values.items() if k in known}
        changed = Array(merged(default._element, given._element), given._count, **{**values, **given._values})
        changed._length = given._length
        return changed
    if isinstance(default, Start) and isinstance(given, Start):
        return combined(default, given)
    if not isinstance(default, Instance) or not isinstance(given, Instance):
        return given
    cls = sized(declared_class(type(given)), {**default.__dict__["_mods"], **given.__dict__["_mods"]})
    names = set(field_names(cls))
    inherited = {k: v for k, v in default.__dict__["_mods"].items() if k in names}
    mods = {**inherited, **given.__dict__["_mods"]}
    for key, value in given.__dict__["_mods"].items():
        if key in inherited:
            mods[key] = merged(inherited[key], value)
    return record(with_unknowns(cls, mods), mods)


def combined(default: Start, given: Start) -> Start:
    """`given`, with the attributes of `default` that it leaves open."""
    return Start(
        default.value if given.value is None else given.value,
        default.fixed if given.fixed is None else given.fixed,
        default.nominal if given.nominal is None else given.nominal,
        default.state_select if given.state_select is None else given.state_select,
    )
