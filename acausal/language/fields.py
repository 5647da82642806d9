"""Fields that hold components: arrays of them, shared ones, conditional ones, and how they are seen at a path."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any, Generic, TypeVar, cast, overload

from ..errors import DeclarationError, nearest
from .declarations import Start
from .instance import Instance, call_site, field_names, path_text, record

C = TypeVar("C", bound=Instance)


class Array(Generic[C]):
    """A field of `count` equal components: ``cells: Array[Cell] = Array(Cell(), "n")``.

    Args:
        element: the component that is repeated.
        count: an integer, or the name of a structural parameter or of a property of the class.
        **values: per-element values of the element's parameters or start values, sequences of length `count`; of a
            vector a sequence of vectors, ``r=[(1, 0, 0), (0, 1, 0)]`` (one vector alone is that of all elements).
    """

    def __init__(self, element: C, count: int | str, **values: Any) -> None:
        cls = type(element)
        for name in values:
            if name not in field_names(cls):
                hint = nearest(name, field_names(cls))
                raise DeclarationError(
                    f"Array({cls.__name__}(), {count!r}, {name}=...): `{cls.__name__}` has no field `{name}`.{hint} "
                    f"{call_site()}"
                )
        self._element = element
        self._count = count
        self._values = {k: v for name, value in values.items() for k, v in _by_component(cls, name, value).items()}
        self._path: tuple[Any, ...] = ()
        self._length: int | None = count if isinstance(count, int) else None

    def __len__(self) -> int:
        if self._length is None:
            raise DeclarationError(f"the length of this array is the structural parameter {self._count!r} of its owner")
        return self._length

    @overload
    def __getitem__(self, index: int) -> C: ...
    @overload
    def __getitem__(self, index: slice) -> C: ...
    def __getitem__(self, index: int | slice) -> C:
        n = len(self)
        if isinstance(index, slice):
            return cast(C, view(self._element, (*self._path, range(*index.indices(n)))))
        if not -n <= index < n:
            raise DeclarationError(f"index {index} of component array `{path_text(self._path)}` is outside 0..{n - 1}")
        return cast(C, view(self._element, (*self._path, index % n)))

    def __iter__(self) -> Iterator[C]:
        return (self[i] for i in range(len(self)))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        return getattr(self[:], name)

    def __repr__(self) -> str:
        return f"Array({self._element!r}, {self._count!r})"


class Listed(list[Any]):
    """Components of possibly different classes, seen at a path: as of an `Array`, a field of a slice is that of all."""

    def __init__(self, components: Sequence[Instance], path: tuple[Any, ...], chosen: range) -> None:
        super().__init__(view(components[i], (*path, i)) for i in chosen)
        self._seen = components, path, chosen

    def __getitem__(self, index: Any) -> Any:
        if not isinstance(index, slice):
            return super().__getitem__(index)
        components, path, chosen = self._seen
        return Listed(components, path, chosen[index])

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_") or not self:
            raise AttributeError(name)
        components, path, chosen = self._seen
        return getattr(view(components[chosen[0]], (*path, chosen)), name)


def _by_component(cls: type[Instance], name: str, value: Any) -> dict[str, Any]:
    """What the values of field `name` give to each component of it, where it is a vector that varies."""
    whole = cls._vectors.get(name)
    start = isinstance(value, Start)
    items: Any = value.value if start else value
    items = items.tolist() if hasattr(items, "tolist") else items
    if whole is None or _depth(items) <= whole.depth:
        return {name: value}
    try:
        rows = [whole.modifications(item) for item in items]
    except DeclarationError as error:
        raise DeclarationError(f"Array({cls.__name__}(), ..., {name}=...): {error} {call_site()}") from None
    columns: dict[str, Any] = {key: [row[key] for row in rows] for key in whole.names()}
    if start:
        columns = {key: Start(v, value.fixed, value.nominal, value.state_select) for key, v in columns.items()}
    return columns


def _depth(items: Any) -> int:
    """How deep sequences are nested."""
    return 1 + _depth(items[0]) if isinstance(items, (list, tuple)) and items else 0


class Shared:
    """Wrapper of an `inner` or `outer` component."""

    def __init__(self, component: Any, role: str) -> None:
        if isinstance(component, Shared):
            raise DeclarationError(
                f"{role}({component.role}(...)): a field is either `inner` or `outer`; what a component takes from "
                f"outside, those inside of it take from there too {call_site()}"
            )
        if isinstance(component, type):
            raise DeclarationError(
                f"{role}({component.__name__}): give a component, {role}({component.__name__}()) {call_site()}"
            )
        self.component = component
        self.role = role


class Conditional:
    """Wrapper of a sub-component that exists only where a structural parameter says so."""

    def __init__(self, component: Instance, condition: str) -> None:
        self.component = component
        self.condition = condition


class StructuralReference:
    """A structural parameter of the owner, as the value of one of a sub-component."""

    def __init__(self, name: str) -> None:
        self.name = name

    def __repr__(self) -> str:
        return f"structural({self.name!r})"


def structural(name: str) -> Any:
    """The value of the owner's structural parameter `name`, in the declaration of a sub-component.

    ``body: Body = Body(angles_fixed=structural("angles_fixed"))``. (Parameters are passed on by themselves, `m=m`.)
    """
    return StructuralReference(name)


def conditional(component: C, condition: str) -> C:
    """Declare a sub-component or connector that exists only where the boolean field `condition` is True.

    ``heatPort: HeatPort = conditional(HeatPort(), "useHeatPort")``. The class's equations and connections refer to it
    under ``if self.useHeatPort:``.
    """
    return cast(C, Conditional(component, condition))


def inner(component: C) -> C:
    """Declare a component that sub-components at any depth can share by declaring `outer` under the same name."""
    return cast(C, Shared(component, "inner"))


def outer(component: C) -> C:
    """Refer to the nearest enclosing component of the same name that is declared `inner`; `component` is its type."""
    return cast(C, Shared(component, "outer"))


def view(child: Any, path: tuple[Any, ...]) -> Any:
    """`child` seen at `path`: its fields read as expressions with that path."""
    if isinstance(child, Shared):
        return view(child.component, path)
    if isinstance(child, Array):
        seen = Array(child._element, child._count, **child._values)
        seen._path, seen._length = path, child._length
        return seen
    if isinstance(child, (list, tuple)):
        return Listed(child, path, range(len(child)))
    return record(type(child), child.__dict__["_mods"], path)
