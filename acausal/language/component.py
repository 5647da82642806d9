"""Components and connectors: classes of declarations, instances that are cheap records of modifications."""

from __future__ import annotations

import inspect
import sys
from collections.abc import Generator, Mapping
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar, dataclass_transform

from ..errors import DeclarationError, nearest
from ..symbolic.equation import Equation
from .checking import by_element, checked
from .children import present
from .collecting import collect
from .declarations import Kind
from .instance import Instance, call_site, field_names, path_of, record
from .sizes import sized
from .unknown_parameters import declared_class, with_unknowns
from .vectors import VectorEquation

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
class Component(Instance):
    """A piece of a model: fields declared in the class body, behaviour in `equations`.

    Construction takes modifications by keyword: numbers for parameters, `start` for variables, components for
    replaceable sub-components, plain values for structural parameters. An instance is a template: using it inside
    another component copies it.
    """

    def __init_subclass__(cls, *, partial: bool = False, **kwargs: Any) -> None:
        super().__init_subclass__(**kwargs)
        cls._partial = partial
        frame = sys._getframe(1)
        while frame.f_globals.get("__name__") == "types" and frame.f_back is not None:  # made by `types.new_class`
            frame = frame.f_back
        cls._source = (frame.f_code.co_filename, frame.f_lineno)
        collect(cls)
        for name in ("equations", "initial_equations"):
            if name in cls.__dict__:
                setattr(cls, name, _recorded(cls, name, cls.__dict__[name]))

    def __init__(self, *unnamed: Any, **modifications: Any) -> None:
        # modifications are checked one by one below; the class body gives the type checker their names and types
        if unnamed:
            raise DeclarationError(_unnamed(type(self), unnamed[0]))
        cls = fitting_class(type(self), {}, modifications)
        if cls is not type(self):
            object.__setattr__(self, "__class__", cls)
        modifications = by_element(cls, modifications)
        for name, value in modifications.items():
            modifications[name] = checked(cls, name, value)
        self.__dict__["_mods"] = {**self._implied(modifications), **modifications}
        self.__dict__["_path"] = ()

    _must_connect: ClassVar[tuple[str, ...]] = ()
    """Names of connectors without a connection to which the component means nothing."""

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
        what = f"component{where} of class `{type(self).__name__}` has no field `{name}`."
        raise UnknownFieldError(f"{what}{self._hint(name)} {call_site()}".rstrip())

    def _hint(self, name: str) -> str:
        """What may be meant by a name that is no field."""
        known = field_names(type(self))
        if close := nearest(name, known):
            return close
        from ..system import System

        if hasattr(System, name):
            return f" Compile the model first: `ac.compile(model)` gives a system, which has `{name}`."
        return f" It has: {', '.join(known)}."

    def __repr__(self) -> str:
        mods = ", ".join(f"{k}={v!r}" for k, v in self.__dict__["_mods"].items())
        return f"{type(self).__name__}({mods})"


class UnknownFieldError(DeclarationError, AttributeError):
    """A field that the class does not have."""


class Connector(Component, partial=True):
    """An interface: potentials (equal over a connection) and flows (sum to zero, positive into the component)."""


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


def _unnamed(cls: type[Component], value: Any) -> str:
    """What to say of a value without a keyword; it is mostly that of a parameter of the class itself."""
    parameters = [name for name, declaration in cls._declarations.items() if declaration.kind == Kind.PARAMETER]
    parameters.sort(key=lambda name: name not in cls.__dict__)
    fields = parameters or field_names(cls)
    example = f", as in `{cls.__name__}({fields[0]}={value!r})`" if fields else "; it has no fields"
    more = f" (it has {', '.join(f'`{n}`' for n in fields[:8])})" if len(fields) > 1 else ""
    return f"`{cls.__name__}` takes values by keyword{example}{more} {call_site()}"


def fitting_class(cls: type[C], old: Mapping[str, Any], new: Mapping[str, Any]) -> type[C]:
    """The class that modifications ask for, by sizes of vectors and unknown parameters; the `new` are unchecked."""
    fitting = declared_class(cls)
    if fitting._sizes:
        structural = {k: checked(fitting, k, v) for k, v in new.items() if k in fitting._structural}
        try:
            fitting = sized(fitting, {**old, **structural})
        except DeclarationError as error:
            raise DeclarationError(f"{error} {call_site()}") from None
    return with_unknowns(fitting, {**old, **new})


def with_modifications(component: C, mods: Mapping[str, Any]) -> C:
    """A copy of `component` with modifications added (checked)."""
    old = component.__dict__["_mods"]
    cls = fitting_class(type(component), old, mods)
    new = {k: checked(cls, k, v) for k, v in by_element(cls, mods).items()}
    kept = old if cls is type(component) else {k: v for k, v in old.items() if k in field_names(cls)}
    together = {**kept, **new}
    implied = {k: v for k, v in component._implied(together).items() if k not in new}
    return record(cls, {**together, **implied})
