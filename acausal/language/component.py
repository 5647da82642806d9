"""Components and connectors: classes of declarations, instances that are cheap records of modifications."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Generator, Iterator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, Generic, Self, TypeVar, cast, dataclass_transform, overload

from ..errors import DeclarationError, nearest
from ..symbolic.equation import Equation
from ..symbolic.expr import Expr
from .declarations import Declaration, Kind, Start, Structural
from .vectors import Quantities, VectorEquation

if TYPE_CHECKING:
    from .connections import Connect
    from .events import Assert, When
    from .overdetermined import Choice, DerivativeRule, Mark

Equations = Generator[
    "Equation | VectorEquation | Connect | When | Assert | Choice | Mark | DerivativeRule", None, None
]
"""Return type of `equations` and `initial_equations`."""

C = TypeVar("C", bound="Component")


@dataclass_transform(kw_only_default=True)
class Component:
    """A piece of a model: fields declared in the class body, behaviour in `equations`.

    Construction takes modifications by keyword: numbers for parameters, `start` for variables, components for
    replaceable sub-components, plain values for structural parameters. An instance is a template: using it inside
    another component copies it.
    """

    _declarations: ClassVar[dict[str, Declaration]] = {}
    _structural: ClassVar[dict[str, Structural]] = {}
    _children: ClassVar[dict[str, Child]] = {}
    _vectors: ClassVar[dict[str, Quantities]] = {}
    _partial: ClassVar[bool] = True
    _source: ClassVar[tuple[str, int]] = ("", 0)

    def __init_subclass__(cls, *, partial: bool = False, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        cls._partial = partial
        frame = sys._getframe(1)
        cls._source = (frame.f_code.co_filename, frame.f_lineno)
        _collect(cls)
        for name in ("equations", "initial_equations"):
            if name in cls.__dict__:
                setattr(cls, name, _recorded(cls, name, cls.__dict__[name]))

    def __init__(self, **modifications: Any) -> None:
        # modifications are checked one by one below; the class body gives the type checker their names and types
        modifications = by_element(type(self), modifications)
        for name, value in modifications.items():
            modifications[name] = checked(type(self), name, value)
        self.__dict__["_mods"] = {**self._implied(modifications), **modifications}
        self.__dict__["_path"] = ()

    @classmethod
    def _implied(cls, modifications: Mapping[str, Any]) -> dict[str, Any]:
        """Structural parameters that follow from modifications, where these do not give them (for subclasses)."""
        return {}

    def equations(self) -> Equations:
        """The component's equations and connections; a subclass yields from ``super().equations()`` first."""
        yield from ()

    def initial_equations(self) -> Equations:
        """Equations that hold at the start only."""
        yield from ()

    def __setattr__(self, name: str, value: object) -> None:
        descriptor = inspect.getattr_static(type(self), name, None)
        if hasattr(type(descriptor), "__set__"):
            descriptor.__set__(self, value)  # type: ignore[union-attr]
        raise DeclarationError(
            f"`{type(self).__name__}` has no field `{name}` to assign; components are immutable: declare fields in the "
            f"class body and give values at construction.{nearest(name, field_names(type(self)))}"
        )

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        where = f" `{path_of(self)}`" if self.__dict__.get("_path") else ""
        if not present(self, name):
            condition = type(self)._children[name].condition
            raise UnknownFieldError(
                f"component{where} of class `{type(self).__name__}` has `{name}` only with `{condition}=True`: "
                f"construct it so, `{type(self).__name__}({condition}=True)` {call_site()}".rstrip()
            )
        known = field_names(type(self))
        hint = nearest(name, known) or f" It has: {', '.join(known)}."
        raise UnknownFieldError(
            f"component{where} of class `{type(self).__name__}` has no field `{name}`.{hint} {call_site()}".rstrip()
        )

    def __repr__(self) -> str:
        mods = ", ".join(f"{k}={v!r}" for k, v in self.__dict__["_mods"].items())
        return f"{type(self).__name__}({mods})"


class UnknownFieldError(DeclarationError, AttributeError):
    """A field that the class does not have."""


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


class Array(Generic[C]):
    """A field of `count` equal components: ``cells: Array[Cell] = Array(Cell(), "n")``.

    Args:
        element: the component that is repeated.
        count: an integer, or the name of a structural parameter or of a property of the class.
        **values: per-element values of the element's parameters or start values, sequences of length `count`.
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
        self._values = values
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


class Shared:
    """Wrapper of an `inner` or `outer` component."""

    def __init__(self, component: Component, role: str) -> None:
        self.component = component
        self.role = role


class Conditional:
    """Wrapper of a sub-component that exists only where a structural parameter says so."""

    def __init__(self, component: Component, condition: str) -> None:
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


def with_structure(child: Any, owner: Component) -> Any:
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
    if isinstance(child, (list, tuple)) and child and all(isinstance(c, Component) for c in child):
        return [with_structure(c, owner) for c in child]
    if not isinstance(child, Component) or not _refers(child):
        return child
    copy = object.__new__(type(child))
    copy.__dict__["_path"] = ()
    mods = child.__dict__["_mods"]
    found = {k: with_structure(v, owner) for k, v in mods.items()}
    copy.__dict__["_mods"] = {k: checked(type(child), k, v) if v is not mods[k] else v for k, v in found.items()}
    return copy


def _refers(component: Component) -> bool:
    values = component.__dict__["_mods"].values()
    return any(isinstance(v, StructuralReference) or (isinstance(v, Component) and _refers(v)) for v in values)


def conditional(component: C, condition: str) -> C:
    """Declare a sub-component or connector that exists only where the boolean field `condition` is True.

    ``heatPort: HeatPort = conditional(HeatPort(), "useHeatPort")``. The class's equations and connections refer to it
    under ``if self.useHeatPort:``.
    """
    return cast(C, Conditional(component, condition))


def present(owner: Component, name: str) -> bool:
    """Whether sub-component `name` exists in `owner`, going by its condition."""
    child = type(owner)._children.get(name)
    return child is None or not child.condition or bool(getattr(owner, child.condition))


def inner(component: C) -> C:
    """Declare a component that sub-components at any depth can share by declaring `outer` under the same name."""
    return cast(C, Shared(component, "inner"))


def outer(component: C) -> C:
    """Refer to the nearest enclosing component of the same name that is declared `inner`; `component` is its type."""
    return cast(C, Shared(component, "outer"))


def path_text(path: tuple[Any, ...]) -> str:
    """Dotted name of a path."""
    from ..symbolic.printing import path_text as text

    return text(path)


def path_of(component: Component) -> str:
    """Dotted path of a component reached from its root."""
    return path_text(component.__dict__["_path"])


def field_names(cls: type[Component]) -> list[str]:
    """All fields of a class."""
    return [*cls._declarations, *cls._vectors, *cls._structural, *cls._children]


def by_element(cls: type[Component], modifications: Mapping[str, Any]) -> dict[str, Any]:
    """Modifications with those of vectors and matrices given to their elements."""
    if not cls._vectors or not modifications.keys() & cls._vectors.keys():
        return dict(modifications)
    out: dict[str, Any] = {}
    for name, value in modifications.items():
        whole = cls._vectors.get(name)
        out.update({name: value} if whole is None else _located_elements(cls, whole, value))
    return out


def _located_elements(cls: type[Component], whole: Quantities, value: Any) -> dict[str, Any]:
    try:
        return whole.modifications(value)
    except DeclarationError as error:
        raise DeclarationError(f"`{cls.__name__}({whole.name}=...)`: {error} {call_site()}") from None


def view(child: Any, path: tuple[Any, ...]) -> Any:
    """`child` seen at `path`: its fields read as expressions with that path."""
    if isinstance(child, Shared):
        return view(child.component, path)
    if isinstance(child, Array):
        seen = Array(child._element, child._count, **child._values)
        seen._path, seen._length = path, child._length
        return seen
    if isinstance(child, (list, tuple)):
        return [view(c, (*path, i)) for i, c in enumerate(child)]
    copy = object.__new__(type(child))
    copy.__dict__["_mods"] = child.__dict__["_mods"]
    copy.__dict__["_path"] = path
    return copy


def effective_child(owner: Component, name: str) -> Any:
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
    return child


def _with_length(owner: Component, name: str, child: Array[Any]) -> Array[Any]:
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
    if isinstance(default, Array) and isinstance(given, Component):
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
    if not isinstance(default, Component) or not isinstance(given, Component):
        return given
    names = set(field_names(type(given)))
    inherited = {k: v for k, v in default.__dict__["_mods"].items() if k in names}
    mods = {**inherited, **given.__dict__["_mods"]}
    for key, value in given.__dict__["_mods"].items():
        if key in inherited:
            mods[key] = merged(inherited[key], value)
    copy = object.__new__(type(given))
    copy.__dict__["_mods"] = mods
    copy.__dict__["_path"] = ()
    return copy


def combined(default: Start, given: Start) -> Start:
    """`given`, with the attributes of `default` that it leaves open."""
    return Start(
        default.value if given.value is None else given.value,
        default.fixed if given.fixed is None else given.fixed,
        default.nominal if given.nominal is None else given.nominal,
        default.state_select if given.state_select is None else given.state_select,
    )


def with_modifications(component: C, mods: Mapping[str, Any]) -> C:
    """A copy of `component` with modifications added (checked)."""
    copy = object.__new__(type(component))
    new = {k: checked(type(component), k, v) for k, v in by_element(type(component), mods).items()}
    together = {**component.__dict__["_mods"], **new}
    copy.__dict__["_mods"] = {**together, **{k: v for k, v in component._implied(together).items() if k not in new}}
    copy.__dict__["_path"] = ()
    return copy


def _recorded(cls: type[Component], name: str, function: Any) -> Any:
    """`function`, noting on the instance that it ran, so that a forgotten super().equations() is found."""

    def run(self: Any) -> Any:
        generator = function(self)
        if not inspect.isgenerator(generator):
            code = function.__code__
            raise DeclarationError(
                f"`{cls.__name__}.{name}` must be a generator: `yield` each equation, do not return "
                f"{type(generator).__name__} ({code.co_filename}:{code.co_firstlineno})"
            )
        self.__dict__.setdefault(f"_ran_{name}", []).append(cls)  # here, not above: a call alone runs no equation
        yield from generator

    run.__name__, run.__doc__, run.__qualname__ = name, function.__doc__, function.__qualname__
    run.__wrapped__ = function  # type: ignore[attr-defined]
    return run


def _collect(cls: type[Component]) -> None:
    """Gather the fields of the class body; replace structural and child defaults by descriptors."""
    declarations: dict[str, Declaration] = {}
    structural: dict[str, Structural] = {}
    children: dict[str, Child] = {}
    vectors: dict[str, Quantities] = {}
    for base in reversed(cls.__mro__[1:]):
        if issubclass(base, Component) and base is not Component:
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
            raise DeclarationError(
                f"field `{cls.__name__}.{name}` has a type but no value: write `{name}: {annotations[name]} = ...` "
                f"({cls._source[0]}:{cls._source[1]})"
            )
    cls._declarations, cls._structural, cls._children, cls._vectors = declarations, structural, children, vectors


def _known(name: str, *tables: Mapping[str, Any]) -> bool:
    return any(name in table for table in tables)


def _collect_one(
    cls: type[Component],
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
        declarations[name] = value
    elif isinstance(value, Conditional):
        if not isinstance(inspect.getattr_static(cls, value.condition, None), (bool, property, Structural)):
            raise DeclarationError(
                f"`{cls.__name__}.{name}` depends on `{value.condition}`, which is no boolean field or property of the "
                f"class ({cls._source[0]}:{cls._source[1]})"
            )
        children[name] = descriptor = Child(name, value.component, annotation, value.condition)
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, (Component, Array, Shared)) or (
        isinstance(value, (list, tuple)) and value and all(isinstance(v, Component) for v in value)
    ):
        descriptor = Child(name, value, annotation)
        children[name] = descriptor
        type.__setattr__(cls, name, descriptor)
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
        descriptor = Structural(name, rows, tuple)
        structural[name] = descriptor
        type.__setattr__(cls, name, descriptor)
    elif isinstance(value, float) and annotation is not None and "ClassVar" not in str(annotation):
        raise DeclarationError(
            f"`{cls.__name__}.{name}: {annotation} = {value!r}` is a plain float: use `{name}: Parameter = "
            f"Parameter({value!r})` for a quantity that can change without compiling again "
            f"({cls._source[0]}:{cls._source[1]})"
        )


def constraint_of(cls: type[Component], name: str) -> type[Component]:
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
    return annotation if isinstance(annotation, type) and issubclass(annotation, Component) else type(element)


def _evaluate_annotation(cls: type[Component], text: str) -> Any:
    for base in cls.__mro__:
        module = sys.modules.get(base.__module__)
        try:
            return eval(text, dict(vars(module)) if module else {}, dict(vars(base)))
        except Exception:  # an annotation that exists for the type checker only
            continue
    return None


def checked(cls: type[Component], name: str, value: Any) -> Any:
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


def _checked_quantity(cls: type[Component], declaration: Declaration, value: Any) -> Any:
    name = declaration.name
    if isinstance(value, (Expr, Declaration)):
        return value
    if declaration.kind == Kind.PARAMETER:
        number = _number(value)
        if number is None:
            raise DeclarationError(
                f"`{cls.__name__}({name}={value!r})`: a parameter takes a number or an expression of parameters of the "
                f"class body it stands in, not `{type(value).__name__}` {call_site()}"
            )
        check_bounds(f"{cls.__name__}.{name}", declaration, number)
        return value
    if isinstance(value, Start):
        return value
    number = _number(value)
    if number is None:
        raise DeclarationError(
            f"`{cls.__name__}({name}={value!r})`: a variable takes a start value, `{name}=start(2.0, fixed=True)` "
            f"{call_site()}"
        )
    return Start(value)


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


def _checked_structural(cls: type[Component], field: Structural, value: Any) -> Any:
    if isinstance(value, StructuralReference):
        return value  # resolved where the owner is known
    wanted = field.annotation
    if wanted is tuple:
        found = numbers(value)
        if found is None:
            raise DeclarationError(
                f"`{cls.__name__}({field.name}={value!r})`: `{field.name}` takes a sequence of numbers, or one of rows "
                f"of numbers, not {type(value).__name__} {call_site()}"
            )
        return found
    integer = wanted is int and hasattr(value, "__index__") and not isinstance(value, bool)
    if type(value) is not wanted and not integer:
        raise DeclarationError(
            f"`{cls.__name__}({field.name}={value!r})`: structural parameter `{field.name}` takes a plain "
            f"{wanted.__name__}, not {type(value).__name__} {call_site()}"
        )
    return int(value) if wanted is int else value


def _checked_child(cls: type[Component], name: str, value: Any) -> Any:
    wanted = constraint_of(cls, name)
    items = [value.component] if isinstance(value, Shared) else [value._element] if isinstance(value, Array) else value
    for item in items if isinstance(items, (list, tuple)) else [items]:
        if not isinstance(item, wanted):
            got = f"class `{item.__name__}` itself (call it)" if isinstance(item, type) else f"`{type(item).__name__}`"
            raise DeclarationError(
                f"`{cls.__name__}.{name}` is declared as `{wanted.__name__}`: its replacement must be an instance of "
                f"that class or of a subclass, not {got} {call_site()}"
            )
    return list(value) if isinstance(value, (list, tuple)) else value


def call_site() -> str:
    """``(file:line)`` of the nearest caller outside this package."""
    frame = sys._getframe(1)
    package = __name__.rsplit(".", 2)[0]
    inside = tuple(f"{package}.{part}" for part in ("language", "symbolic", "compiler"))
    while frame is not None:
        module = str(frame.f_globals.get("__name__", ""))
        if module != package and not module.startswith(inside):
            return f"({frame.f_code.co_filename}:{frame.f_lineno})"
        frame = frame.f_back
    return ""


class Connector(Component, partial=True):
    """An interface: potentials (equal over a connection) and flows (sum to zero, positive into the component)."""


__all__ = ["Array", "Component", "Connector", "Equations", "Self", "conditional", "inner", "outer", "structural"]
