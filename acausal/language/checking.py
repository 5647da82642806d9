"""Values that modify a field are checked where they are given: the field is there, its type and bounds hold."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from typing import Any

from ..errors import DeclarationError, nearest
from ..symbolic.expr import Expr
from .declarations import STATE_SELECT, Declaration, Kind, Start, Structural
from .fields import Array, Shared, StructuralReference
from .instance import Instance, call_site, field_names
from .unknown_parameters import declared_class
from .vectors import Quantities


def by_element(cls: type[Instance], modifications: Mapping[str, Any]) -> dict[str, Any]:
    """Modifications with those of vectors and matrices given to their elements."""
    if not cls._vectors or not modifications.keys() & cls._vectors.keys():
        return dict(modifications)
    out: dict[str, Any] = {}
    for name, value in modifications.items():
        whole = cls._vectors.get(name)
        out.update({name: value} if whole is None else _located_elements(cls, whole, value))
    return out


def _located_elements(cls: type[Instance], whole: Quantities, value: Any) -> dict[str, Any]:
    try:
        return whole.modifications(value)
    except DeclarationError as error:
        raise DeclarationError(f"`{cls.__name__}({whole.name}=...)`: {error} {call_site()}") from None


def checked(cls: type[Instance], name: str, value: Any) -> Any:
    """`value` if it may modify field `name` of `cls`.

    Raises:
        DeclarationError: unknown field, or a value of the wrong type.
    """
    if name in cls._declarations:
        return _checked_quantity(cls, cls._declarations[name], value)
    if name in cls._structural:
        return _checked_structural(cls, cls._structural[name], value)
    if name in cls._children:
        return _checked_child(cls, name, value)
    hint = nearest(name, field_names(cls)) or f" It has: {', '.join(field_names(cls)) or 'none'}."
    raise DeclarationError(f"`{cls.__name__}` has no field `{name}` to modify.{hint} {call_site()}".rstrip())


def _checked_quantity(cls: type[Instance], declaration: Declaration, value: Any) -> Any:
    name = declaration.name
    if isinstance(value, (Expr, Declaration)):
        return value
    if declaration.kind == Kind.PARAMETER:
        number = _number(value)
        if number is None:
            raise DeclarationError(
                f"`{cls.__name__}({name}={value!r})`: a parameter takes a number or an expression of parameters of the "
                f"class body it stands in, or `start(guess, fixed=False)` if the initialization is to find it, not "
                f"`{type(value).__name__}` {call_site()}"
            )
        check_bounds(f"{cls.__name__}.{name}", declaration, number)
        return value
    if isinstance(value, Start):
        _check_start(f"{cls.__name__}.{name}", value)
        return value
    number = _number(value)
    if number is None:
        raise DeclarationError(
            f"`{cls.__name__}({name}={value!r})`: a variable takes a start value, `{name}=start(2.0, fixed=True)` "
            f"{call_site()}"
        )
    return Start(value)


def _check_start(text: str, start: Start) -> None:
    """Raise DeclarationError if an attribute of a start value cannot be what it says."""
    values = start.value if isinstance(start.value, (list, tuple)) else (start.value,)
    problem = ""
    if any(isinstance(v, str) for v in values):
        problem = f"{start.value!r} is no number and no expression of parameters"
    elif any(isinstance(v, float) and v != v for v in values):
        problem = "its value is NaN"
    elif start.fixed not in (None, True, False):
        problem = f"fixed={start.fixed!r} is neither True nor False"
    elif start.nominal is not None and not start.nominal > 0:
        problem = f"nominal={start.nominal!r} must be a positive number: it is a scale"
    elif start.state_select is not None and start.state_select not in STATE_SELECT:
        problem = f"state_select={start.state_select!r} is not one of {', '.join(STATE_SELECT)}"
    if problem:
        raise DeclarationError(f"start of `{text}`: {problem} {call_site()}")


def check_bounds(text: str, declaration: Declaration, value: Any) -> None:
    """Raise DeclarationError if a number lies outside the declared bounds or is NaN."""
    values = value if isinstance(value, (list, tuple)) else (value,)
    for number in values:
        if number != number:
            raise DeclarationError(f"parameter `{text}` is NaN {call_site()}")
        low, high = declaration.min, declaration.max
        if (low is not None and number < low) or (high is not None and number > high):
            bounds = f"[{'-inf' if low is None else low}, {'inf' if high is None else high}]"
            raise DeclarationError(f"parameter `{text}` = {number!r} lies outside its bounds {bounds} {call_site()}")


def _number(value: Any) -> Any:
    if isinstance(value, (bool, str)):
        return None
    if isinstance(value, (int, float)):
        return value
    if isinstance(value, (list, tuple)) or hasattr(value, "tolist"):
        items: Any = list(value) if isinstance(value, (list, tuple)) else value.tolist()
        flat = items if isinstance(items, list) else [items]
        return flat if all(isinstance(v, (int, float)) for v in flat) else None
    return None


def numbers(value: Any) -> Any:
    """`value` as (nested) tuples of floats; None if it is something else."""
    items: Any = value.tolist() if hasattr(value, "tolist") else value
    if not isinstance(items, (list, tuple)):
        return None
    found = [float(v) if isinstance(v, (int, float)) and not isinstance(v, bool) else numbers(v) for v in items]
    return None if any(v is None for v in found) else tuple(found)


def _checked_structural(cls: type[Instance], field: Structural, value: Any) -> Any:
    if isinstance(value, StructuralReference):
        return value  # resolved where the owner is known
    wanted = field.annotation
    if wanted is tuple:
        return _checked_numbers(cls, field, value)
    integer = wanted is int and hasattr(value, "__index__") and not isinstance(value, bool)
    if type(value) is not wanted and not integer:
        raise DeclarationError(
            f"`{cls.__name__}({field.name}={value!r})`: structural parameter `{field.name}` takes a plain "
            f"{wanted.__name__}, not {type(value).__name__} {call_site()}"
        )
    return int(value) if wanted is int else value


def _checked_numbers(cls: type[Instance], field: Structural, value: Any) -> Any:
    """Numbers or rows of numbers, as the field declares them."""
    found = numbers(value)
    wrong = ""
    if found is None:
        either = "a sequence of numbers, or one of rows of numbers"
        wanted = either if field.rows is None else "rows of numbers" if field.rows else "a sequence of numbers"
        wrong = f"takes {wanted}{' only' if isinstance(value, (list, tuple)) else f', not {type(value).__name__}'}"
    elif field.rows and not all(isinstance(row, tuple) for row in found):
        wrong = "takes rows of numbers, as in ((1.0, 2.0), (3.0, 4.0)), not numbers"
    elif field.rows and len({len(row) for row in found}) > 1:
        wrong = f"takes rows that are equally long, not of {', '.join(str(len(row)) for row in found)} numbers"
    elif field.rows is False and any(isinstance(item, tuple) for item in found):
        wrong = "takes numbers, not rows of numbers"
    elif any(x != x for item in found for x in (item if isinstance(item, tuple) else (item,))):
        wrong = "holds NaN"
    if wrong:
        raise DeclarationError(f"`{cls.__name__}({field.name}={value!r})`: `{field.name}` {wrong} {call_site()}")
    return found


def _checked_child(cls: type[Instance], name: str, value: Any) -> Any:
    wanted = constraint_of(cls, name)
    default = cls._children[name].default
    if isinstance(value, (list, tuple, Array)) and isinstance(default, (Instance, Shared)):
        raise DeclarationError(
            f"`{cls.__name__}.{name}` is one `{wanted.__name__}`, and cannot be replaced by several: where elements of "
            f"an array differ in a sub-component, write them out, `[{cls.__name__}({name}=...), ...]` {call_site()}"
        )
    items = [value.component] if isinstance(value, Shared) else [value._element] if isinstance(value, Array) else value
    for item in items if isinstance(items, (list, tuple)) else [items]:
        if not isinstance(item, wanted):
            got = f"class `{item.__name__}` itself (call it)" if isinstance(item, type) else f"`{type(item).__name__}`"
            raise DeclarationError(
                f"`{cls.__name__}.{name}` is declared as `{wanted.__name__}`: its replacement must be an instance of "
                f"that class or of a subclass, not {got} {call_site()}"
            )
    return list(value) if isinstance(value, (list, tuple)) else value


def constraint_of(cls: type[Instance], name: str) -> type[Instance]:
    """Class that a replacement of sub-component `name` must derive from: the annotation, else the default's class."""
    child = cls._children[name]
    default = child.default.component if isinstance(child.default, Shared) else child.default
    element = default._element if isinstance(default, Array) else default
    element = element[0] if isinstance(element, (list, tuple)) else element
    annotation = child.constraint
    if isinstance(annotation, str):
        annotation = _evaluate_annotation(cls, annotation)
    arguments = getattr(annotation, "__args__", None)
    if arguments:
        annotation = arguments[0]
    if isinstance(annotation, type) and issubclass(annotation, Instance):
        return annotation
    return type(element)._generic or declared_class(type(element))


def _evaluate_annotation(cls: type[Instance], text: str) -> Any:
    for base in cls.__mro__:
        module = sys.modules.get(base.__module__)
        try:
            return eval(text, dict(vars(module)) if module else {}, dict(vars(base)))
        except Exception:  # an annotation that exists for the type checker only
            continue
    return None
