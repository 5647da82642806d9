"""Vectors whose number of elements is a structural parameter: a class of its own for every size.

To the rest of the language a class has a fixed list of quantities. So a component class with such vectors is generic:
its instances belong to a subclass that has the sizes their structural parameters ask for, made when it is first needed.
"""

from __future__ import annotations

import types
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from ..errors import DeclarationError, nearest
from .declarations import Structural

if TYPE_CHECKING:
    from .instance import Instance

R = TypeVar("R", bound="Instance")


def sized(cls: type[R], modifications: Mapping[str, Any]) -> type[R]:
    """`cls` with its vectors as long as the structural parameters among `modifications` make them."""
    generic: Any = cls._generic or cls
    if not generic._sizes:
        return cls
    structural = {k: v for k, v in modifications.items() if k in generic._structural}
    if any(not isinstance(v, (bool, int, str, tuple)) for v in structural.values()):
        return cls  # refers to structural parameters of an owner that is not known yet
    sizes = sizes_of(generic, structural)
    if sizes == generic._lengths:
        return generic
    if sizes not in generic._made:
        body = {"_lengths": sizes, "_generic": generic, "__module__": generic.__module__, "__doc__": generic.__doc__,
                "__qualname__": generic.__qualname__, "__reduce__": _reduced}  # fmt: skip
        made = types.new_class(
            generic.__name__, (generic,), {"partial": generic._partial}, lambda names: names.update(body)
        )
        made._source = generic._source
        generic._made[sizes] = made
    return generic._made[sizes]


def _reduced(component: Instance) -> tuple[Any, ...]:
    """How to make a component anew where its class has no name, as `pickle` asks for it."""
    return _restored, (type(component)._generic, component.__dict__["_mods"], component.__dict__["_path"])


def _restored(generic: type[Instance], mods: dict[str, Any], path: tuple[Any, ...]) -> Instance:
    new = object.__new__(sized(generic, mods))
    new.__dict__.update(_mods=mods, _path=path)
    return new


def sizes_of(cls: type[Instance], structural: Mapping[str, Any]) -> tuple[int, ...]:
    """Number of elements of each vector of `cls` that has no fixed one."""
    probe = object.__new__(cls)
    probe.__dict__.update(_mods=structural, _path=())
    return tuple(_length(cls, probe, name, count) for name, count in cls._sizes.items())


def _length(cls: type[Instance], probe: Instance, name: str, count: str) -> int:
    known = [k for c in cls.__mro__ for k, v in vars(c).items() if isinstance(v, (Structural, property))]
    length = getattr(probe, count) if count in known else None
    if not isinstance(length, int) or isinstance(length, bool) or length < 0:
        found = f", not {length!r}" if count in known else f".{nearest(count, known)}"
        raise DeclarationError(
            f"`{cls.__name__}.{name}`: the size {count!r} of a vector must be the name of a structural parameter or "
            f"property of the class that is a non-negative integer{found}"
        )
    return length
