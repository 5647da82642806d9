"""The fields of a class body, filed under what they are."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from typing import Any

from ..errors import DeclarationError
from .checking import numbers
from .children import Child
from .declarations import Declaration, Start, Structural
from .fields import Array, Conditional, Shared
from .instance import Instance
from .sizes import sizes_of
from .vectors import Quantities, Vector


def collect(cls: type[Instance]) -> None:
    """Gather the fields of the class body; replace structural and child defaults by descriptors."""
    declarations: dict[str, Declaration] = {}
    structural: dict[str, Structural] = {}
    children: dict[str, Child] = {}
    vectors: dict[str, Quantities] = {}
    for base in reversed(cls.__mro__[1:]):
        if issubclass(base, Instance) and base is not Instance:
            vectors.update(base.__dict__.get("_vectors", {}))
            for table, own in ((declarations, "_declarations"), (structural, "_structural"), (children, "_children")):
                table.update(base.__dict__.get(own, {}))  # type: ignore[arg-type]
    annotations = inspect.get_annotations(cls)
    for name, value in list(cls.__dict__.items()):
        if name.startswith("_"):
            continue
        replaced = vectors.pop(name, None)
        for element in replaced.names() if replaced is not None else ():
            declarations.pop(element)
        if isinstance(value, Quantities):
            vectors[name] = value
            declarations.update(zip(value.names(), value.elements, strict=True))
            continue
        _collect_one(cls, name, value, annotations.get(name), declarations, structural, children)
    for name in annotations:
        known = name in cls.__dict__ or _known(name, declarations, structural, children)
        if not known and not name.startswith("_"):
            annotation = annotations[name]
            kind = annotation.__name__ if isinstance(annotation, type) else annotation
            raise DeclarationError(
                f"field `{cls.__name__}.{name}` has a type but no value: write `{name}: {kind} = ...` "
                f"({cls._source[0]}:{cls._source[1]})"
            )
    cls._declarations, cls._structural, cls._children, cls._vectors = declarations, structural, children, vectors
    _resize(cls)


def _resize(cls: type[Instance]) -> None:
    """Give the vectors with a structural size their elements, behind the other quantities."""
    cls._sizes = {k: v.size for k, v in cls._vectors.items() if isinstance(v, Vector) and isinstance(v.size, str)}
    if not cls._sizes:
        return
    if "_generic" not in cls.__dict__:
        cls._generic, cls._made, cls._lengths = None, {}, sizes_of(cls, {})
    for name, length in zip(cls._sizes, cls._lengths, strict=True):
        old: Any = cls._vectors[name]
        new = old.resized(cls, length)
        for element in old.names():
            cls._declarations.pop(element, None)
        cls._declarations.update(zip(new.names(), new.elements, strict=True))
        cls._vectors[name] = new
        type.__setattr__(cls, name, new)


def _known(name: str, *tables: Mapping[str, Any]) -> bool:
    return any(name in table for table in tables)


def _collect_one(
    cls: type[Instance],
    name: str,
    value: Any,
    annotation: Any,
    declarations: dict[str, Declaration],
    structural: dict[str, Structural],
    children: dict[str, Child],
) -> None:
    """File one class attribute under what it is."""
    for table in (declarations, structural, children):
        table.pop(name, None)
    if isinstance(value, Declaration):
        if value.name != name:
            raise DeclarationError(
                f"`{cls.__name__}.{name}` and `{value.name}` share one {type(value).__name__} object: declare each "
                f"with its own ({cls._source[0]}:{cls._source[1]})"
            )
        _check_default(cls, value)
        declarations[name] = value
    elif isinstance(value, Conditional):
        if not isinstance(inspect.getattr_static(cls, value.condition, None), (bool, property, Structural)):
            raise DeclarationError(
                f"`{cls.__name__}.{name}` depends on `{value.condition}`, which is no boolean field or property of the "
                f"class ({cls._source[0]}:{cls._source[1]})"
            )
        children[name] = descriptor = Child(name, value.component, annotation, value.condition)
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, (Instance, Array, Shared)) or (
        isinstance(value, (list, tuple)) and value and all(isinstance(v, Instance) for v in value)
    ):
        descriptor = Child(name, value, annotation)
        children[name] = descriptor
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, type) and issubclass(value, Instance) and annotation is not None:
        raise DeclarationError(
            f"`{cls.__name__}.{name} = {value.__name__}` is a class, a field holds an instance: write "
            f"`{value.__name__}()` ({cls._source[0]}:{cls._source[1]})"
        )
    elif isinstance(value, (bool, int, str)) and annotation is not None and "ClassVar" not in str(annotation):
        descriptor = Structural(name, value, type(value))
        structural[name] = descriptor
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, tuple) and annotation is not None and "ClassVar" not in str(annotation):
        rows = numbers(value)
        if rows is None:
            raise DeclarationError(
                f"`{cls.__name__}.{name}: {annotation} = {value!r}`: a structural parameter that is a tuple holds "
                f"numbers, or rows of numbers ({cls._source[0]}:{cls._source[1]})"
            )
        descriptor = Structural(name, rows, tuple, _annotated_rows(annotation))
        structural[name] = descriptor
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, float) and annotation is not None and "ClassVar" not in str(annotation):
        raise DeclarationError(
            f"`{cls.__name__}.{name}: {annotation} = {value!r}` is a plain float: use `{name}: Parameter = "
            f"Parameter({value!r})` for a quantity that can change without compiling again "
            f"({cls._source[0]}:{cls._source[1]})"
        )


def _check_default(cls: type[Instance], declaration: Declaration) -> None:
    """Raise DeclarationError for a parameter whose value is no number and no expression."""
    default, problem = declaration.default, ""
    if isinstance(default, Start):
        problem = (
            "a class declares a value; what the initialization is to find is said where the component is made, "
            f"`{cls.__name__}({declaration.name}=start(guess, fixed=False))`"
        )
    elif isinstance(default, str) or (isinstance(default, float) and default != default):
        problem = f"its value {default!r} is no number and no expression of parameters"
    if problem:
        raise DeclarationError(
            f"parameter `{cls.__name__}.{declaration.name}`: {problem} ({cls._source[0]}:{cls._source[1]})"
        )


def _annotated_rows(annotation: Any) -> bool | None:
    """Whether ``Sequence[Sequence[float]]`` or the like is annotated, not ``Sequence[float]``; None if neither is."""
    text = annotation if isinstance(annotation, str) else str(annotation)
    depth = sum(text.count(f"{kind}[") for kind in ("Sequence", "tuple", "list"))
    return None if "|" in text or depth not in (1, 2) else depth == 2
