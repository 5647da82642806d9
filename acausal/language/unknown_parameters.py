"""Parameters that the initialization finds, ``Spring(c=start(100.0, fixed=False))``: constants that are unknown.

To the rest of the language such a parameter is a variable that does not change, ``der(c) == 0``, of which nothing is
given but a guess: one more initial equation is needed. So the instance belongs to a subclass in which it is one, made
when it is first needed (Modelica Language Specification 3.6, section 8.6: parameters with ``fixed=false``).
"""

from __future__ import annotations

import types
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, TypeVar

from .declarations import Kind, Start, Variable
from .functions import der

if TYPE_CHECKING:
    from .instance import Instance

R = TypeVar("R", bound="Instance")


def declared_class(cls: type[R]) -> type[R]:
    """The class as it is declared, all of whose parameters are known."""
    original: Any = cls.__dict__.get("_known", cls)
    return original


def with_unknowns(cls: type[R], modifications: Mapping[str, Any]) -> type[R]:
    """`cls` with the parameters that these modifications leave to the initialization as unknown constants."""
    names = tuple(
        name for name, value in modifications.items()
        if isinstance(value, Start) and value.fixed is False
        and name in cls._declarations and cls._declarations[name].kind == Kind.PARAMETER
    )  # fmt: skip
    if not names:
        return cls
    made: dict[tuple[str, ...], Any] = cls.__dict__.get("_with_unknowns", {})
    if not made:
        type.__setattr__(cls, "_with_unknowns", made)
    if names not in made:
        made[names] = _subclass(cls, names)
    return made[names]


def _subclass(cls: Any, names: tuple[str, ...]) -> Any:
    def equations(self: Any) -> Any:
        yield from cls.equations(self)
        for name in names:
            yield der(getattr(self, name)) == 0

    body: dict[str, Any] = {"_known": cls, "equations": equations}
    body |= {key: getattr(cls, key) for key in ("__module__", "__doc__", "__qualname__")}
    for name in names:
        old = cls._declarations[name]
        body[name] = Variable(unit=old.unit, doc=old.doc, nominal=old.nominal, min=old.min, max=old.max)
    variant = types.new_class(cls.__name__, (cls,), {"partial": cls._partial}, lambda into: into.update(body))
    variant._source = cls._source
    return variant
