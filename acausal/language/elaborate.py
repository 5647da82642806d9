"""From a component instance to its template and numbers: modifications applied, partial classes rejected."""

from __future__ import annotations

import os
import traceback
import types
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from ..errors import AcausalError, DeclarationError
from ..symbolic.equation import DEFINITION, Equation, Origin
from ..symbolic.expr import Expr, as_expr, intern_node, symbol
from ..symbolic.traverse import leaves, substitute
from .checking import numbers
from .children import check_length, effective_child, merged, present, with_structure
from .component import Component, Connector, with_modifications
from .connections import Connect
from .declarations import STATE_SELECT, Declaration, Kind, Start
from .events import Assert, When
from .fields import Array, Shared, view
from .instance import call_site, path_text, record
from .overdetermined import Choice, DerivativeRule, Mark
from .places import has_place, located
from .template import (
    Attributes,
    Binding,
    ChildSlot,
    Path,
    Template,
    TemplateAction,
    TemplateChoice,
    TemplateEquation,
)  # fmt: skip
from .vectors import VectorEquation
from .when import assertion, starts_discrete, statements


@dataclass(frozen=True, slots=True, eq=False)
class Bound:
    """A modification that is an expression of the parameters of the class `level` frames down the stack."""

    level: int
    expression: Expr


@dataclass(slots=True)
class Frame:
    """A component being elaborated."""

    cls: type[Component]
    step: Path
    bindings: list[Binding] = field(default_factory=list[Binding])


class Elaborator:
    """Elaborates a model; templates are shared between equal structures."""

    def __init__(self) -> None:
        self.templates: dict[Any, Template] = {}
        self.plain: dict[Any, tuple[Template, Attributes]] = {}
        self.stack: list[Frame] = []
        self.shared: dict[str, Component] = {}  # `inner` components of those on the stack: class and structure
        self.outer: dict[Any, Template] = {}

    def root(self, component: Component) -> tuple[Template, Attributes]:
        """Template and numbers of a whole model."""
        _reject_unresolved(component, ())
        try:
            return self.elaborate(component, ())
        except DeclarationError as error:
            if not has_place(str(error)):
                error.args = (f"{error} {call_site()}".rstrip(),)
            raise

    def elaborate(self, component: Component, step: Path) -> tuple[Template, Attributes]:
        """Template and numbers of one component, `step` below the component on top of the stack."""
        cls = type(component)
        mods = component.__dict__["_mods"]
        if mods and not cls._partial and _plain(cls, mods):
            template, attributes = self.elaborate(record(cls, {}), step)
            attributes = attributes.copy()
            self.stack.append(Frame(cls, step))
            for name, value in mods.items():
                self._set(cls, template, attributes, name, value)
            self.stack.pop()
            return template, attributes
        bare = (cls, *((name, *_structure(c)) for name, c in self.shared.items()))
        if not mods and bare in self.plain:
            return self.plain[bare]
        if cls._partial and (cls._declarations or not issubclass(cls, Connector)):
            raise DeclarationError(
                f"`{self._where(step) or cls.__name__}` is an instance of the partial class `{cls.__name__}` "
                f"({cls._source[0]}:{cls._source[1]}): replace it by one of its subclasses"
            )
        self.stack.append(Frame(cls, step))
        outside = self.shared
        try:
            component = _seeing(component, outside)
            self.shared = outside | _inner_components(component)
            template, attributes = self._elaborate(component)
        finally:
            self.shared = outside
            self.stack.pop()
        if not mods:
            self.plain[bare] = (template, attributes)
        return template, attributes

    def _elaborate(self, component: Component) -> tuple[Template, Attributes]:
        cls = type(component)
        mods = component.__dict__["_mods"]
        structural = {name: mods.get(name, s.default) for name, s in cls._structural.items()}
        template = Template(cls, structural)
        template.layout_own()
        parts = [self._own(component, template)]
        for name in cls._children:
            if not present(component, name):
                continue
            with located(cls, name):
                slot, attributes = self._child(component, name)
            template.add_child(slot)
            parts.extend(attributes)
        template.bindings = self.stack[-1].bindings
        key = _key(template)
        known = self.templates.get(key)
        if known is None:
            self.templates[key] = known = template
            self._behaviour(component, template)
        return known, Attributes.join(parts)

    def _own(self, component: Component, template: Template) -> Attributes:
        cls = type(component)
        mods = component.__dict__["_mods"]
        n_par = sum(1 for is_par, _ in template.own.values() if is_par)
        n_var = len(template.own) - n_par
        nan = float("nan")
        out = Attributes(
            np.full(n_par, nan), np.full(n_var, nan), np.full(n_var, -1, np.int8), np.full(n_var, nan),
            np.full(n_var, STATE_SELECT.index("default"), np.int8),
            np.array([d.kind for d in cls._declarations.values() if d.kind != Kind.PARAMETER], np.int8),
            np.zeros(n_var, bool),
        )  # fmt: skip
        for name, declaration in cls._declarations.items():
            if declaration.kind == Kind.PARAMETER:
                value = mods.get(name, declaration.default)
                if value is not None:
                    self._set(cls, template, out, name, value)
                continue
            select = _state_select(component, declaration)
            nominal = _nominal(component, declaration, mods)
            given = Start(declaration.start, declaration.fixed, nominal, select)
            self._set(cls, template, out, name, given)
            out.modified[template.own[name][1]] = False
            if name in mods:
                self._set(cls, template, out, name, mods[name])
        return out

    def _set(self, cls: type[Component], template: Template, out: Attributes, name: str, value: Any) -> None:
        """Enter one modification."""
        is_par, k = template.own[name]
        if is_par:
            if isinstance(value, (Bound, Expr, Declaration)):
                self._bind(cls, name, value, is_start=False)
            elif isinstance(value, (list, tuple)):
                raise DeclarationError(
                    f"`{self._where((name,))}` is one parameter but was given {len(value)} values; a sequence has its "
                    f"place in Array(component, n, {name}=[...])"
                )
            else:
                out.par[k] = value
            return
        if not isinstance(value, Start):
            value = Start(value)
        out.modified[k] |= value.value is not None
        if value.fixed is not None and out.kind[k] != Kind.DISCRETE:  # its start always holds, for pre(...)
            out.fixed[k] = value.fixed
        if value.nominal is not None:
            out.nominal[k] = value.nominal
        if value.state_select is not None:
            out.select[k] = STATE_SELECT.index(value.state_select)
        if isinstance(value.value, (Bound, Expr, Declaration)):
            self._drop(name)
            self._bind(cls, name, value.value, is_start=True)
            out.start[k] = np.nan
        elif isinstance(value.value, (list, tuple, np.ndarray)) and np.ndim(value.value):
            raise DeclarationError(
                f"`{self._where((name,))}` is one variable, but its start was given {np.size(value.value)} values"
            )
        elif value.value is not None:
            self._drop(name)
            out.start[k] = value.value

    def _drop(self, name: str) -> None:
        """Forget an earlier start binding of an own variable (a modification overrides the declaration)."""
        if self.stack:
            frame = self.stack[-1]
            frame.bindings[:] = [b for b in frame.bindings if not (b.is_start and b.path == (name,))]

    def _bind(self, cls: type[Component], name: str, value: Any, *, is_start: bool) -> None:
        if isinstance(value, Bound):
            level, expression = value.level, value.expression
        else:
            level, expression = len(self.stack) - 1, in_scope(as_expr(value), cls)
        frame = self.stack[level]
        path = (*(part for f in self.stack[level + 1 :] for part in f.step), name)
        kind = "start" if is_start else "parameter"
        origin = Origin(frame.cls.__qualname__, *frame.cls._source, kind)
        frame.bindings.append(Binding(path, expression, is_start, origin))

    def _child(self, component: Component, name: str) -> tuple[ChildSlot, list[Attributes]]:
        """Elaborate one child; the expressions of its declaration are bound to this class's parameters."""
        cls = type(component)
        descriptor = cls._children[name]
        given = component.__dict__["_mods"].get(name)
        default = resolve_scope(with_structure(descriptor.default, component), cls, len(self.stack) - 1)
        child = default if given is None else merged(default, given)
        check_length(component, name, default, child)
        role = ""
        if isinstance(child, Shared):
            role, child = child.role, child.component
        if role == "outer":
            return ChildSlot(name, [self._outer(child, name)], None, role), []
        if isinstance(child, Array):
            return self._array(component, name, child)
        if isinstance(child, list):
            return self._list(name, child, role)
        template, attributes = self.elaborate(child, (name,))
        return ChildSlot(name, [template], None, role), [attributes]

    def _outer(self, child: Component, name: str) -> Template:
        """Template of what an `outer` declaration refers to: for its names only."""
        key = _structure(child)
        if key not in self.outer:
            partial = type(child)._partial
            self.outer[key] = _partial_outer(child) if partial else Elaborator().elaborate(child, (name,))[0]
        return self.outer[key]

    def _array(self, component: Component, name: str, child: Array[Any]) -> tuple[ChildSlot, list[Attributes]]:
        n = len(child) if child._length is not None else len(effective_child(component, name))
        element, columns = _columns(child, n, name)
        if _has_sequence(element) or (columns and not n):
            return self._list(name, [_element_mods(child._element, child._values, i, n, name) for i in range(n)], "")
        template, attributes = self.elaborate(element, (name, range(n)))
        attributes = attributes.tile(n)
        for field_name, values in columns.items():
            is_par, k = template.own[field_name]
            stride = template.par_count if is_par else template.var_count
            (attributes.par if is_par else attributes.start)[k::stride] = values
            if not is_par:
                attributes.modified[k::stride] = True
        return ChildSlot(name, [template], n, ""), [attributes]

    def _list(self, name: str, items: list[Component], role: str) -> tuple[ChildSlot, list[Attributes]]:
        nodes = [self.elaborate(item, (name, i)) for i, item in enumerate(items)]
        templates = [t for t, _ in nodes]
        uniform = all(t is templates[0] for t in templates)
        slot = ChildSlot(name, templates[:1] if uniform else templates, len(items), role)
        return slot, [Attributes.join([a for _, a in nodes])] if nodes else []

    def _behaviour(self, component: Component, template: Template) -> None:
        """Run `equations` and `initial_equations` of the class once."""
        scope = view(component, ())
        for item, origin in _run(scope, "equations"):
            if isinstance(item, Equation):
                template.equations.append(_equation(item, origin))
            elif isinstance(item, When):
                equations, actions = statements(item, template, origin)
                template.equations += equations
                template.actions += actions
            elif isinstance(item, Assert):
                template.actions.append(assertion(item, origin))
            elif isinstance(item, Choice):
                template.choices += _choices(item, origin, initial=False)
            elif isinstance(item, DerivativeRule):
                forms = (intern_node("rule", rule) for rule in item.rules)
                template.actions += [TemplateAction(form, origin) for form in forms]
            elif isinstance(item, Mark):
                template.marks.append((item, origin))
            else:
                template.connections.append((item, origin))
        for item, origin in _run(scope, "initial_equations"):
            if isinstance(item, Choice):
                template.choices += _choices(item, origin, initial=True)
                continue
            if isinstance(item, Assert):
                template.actions.append(assertion(replace(item, at_start=True), origin))
                continue
            if not isinstance(item, Equation):
                cls, what = type(component).__name__, type(item).__name__.lower()
                raise DeclarationError(f"initial_equations() of `{cls}` yields a {what}(), use equations() {origin}")
            if not starts_discrete(item, template, origin):
                template.initial.append(TemplateEquation(item.lhs, item.rhs, origin))

    def _where(self, step: Path) -> str:
        return path_text(tuple(part for f in self.stack[1:] for part in f.step) + step)


def _partial_outer(child: Component) -> Template:
    template = Template(type(child), {})
    template.layout_own()
    return template


def _structure(component: Component) -> tuple[Any, ...]:
    """Class and structural parameters."""
    mods, names = component.__dict__["_mods"], type(component)._structural
    return type(component), *((name, value) for name, value in mods.items() if name in names)


def _inner_components(component: Component) -> dict[str, Component]:
    """Those that `component` declares `inner`, with their structural parameters alone."""
    found: dict[str, Component] = {}
    for name, descriptor in type(component)._children.items():
        if isinstance(descriptor.default, Shared) and descriptor.default.role == "inner" and present(component, name):
            child = effective_child(component, name).component
            found[name] = record(type(child), dict(_structure(child)[1:]))
    return found


def _seeing(component: Component, shared: dict[str, Component]) -> Component:
    """`component`, whose `outer` declarations are what the enclosing `inner` components are: methods, structure.

    So a method that a subclass overrides is the one that is called (gravity of a `World`, say).
    """
    seen: dict[str, Component] = {}
    for name, descriptor in type(component)._children.items():
        declared: Any = descriptor.default
        if not isinstance(declared, Shared) or declared.role != "outer" or name not in shared:
            continue
        if issubclass(type(shared[name]), type(declared.component)):  # else an error once all is flat
            seen[name] = shared[name]
    if not seen:
        return component
    return record(type(component), {**component.__dict__["_mods"], **seen}, component.__dict__["_path"])


def _state_select(component: Component, declaration: Declaration) -> Any:
    """The wish that a declaration states, or that the structural parameter it refers to does."""
    wish = with_structure(declaration.state_select, component)
    if wish not in STATE_SELECT:
        cls = type(component)
        raise DeclarationError(
            f"`{cls.__name__}.{declaration.name}`: state_select={declaration.state_select!r} is {wish!r}, which is not "
            f"one of {', '.join(STATE_SELECT)} ({cls._source[0]}:{cls._source[1]})"
        )
    return wish


def _nominal(component: Component, declaration: Declaration, mods: dict[str, Any]) -> float | None:
    """The scale that a declaration states, or the parameter it refers to."""
    if not isinstance(declaration.nominal, Declaration):
        return declaration.nominal
    scale = declaration.nominal
    value = mods.get(scale.name, scale.default)
    if not isinstance(value, (int, float)) or not value > 0:
        cls = type(component)
        raise DeclarationError(
            f"`{cls.__name__}.{declaration.name}`: its nominal value `{scale.name}` is {value!r}, which is not a "
            f"positive number ({cls._source[0]}:{cls._source[1]})"
        )
    return float(value)


def _plain(cls: type[Component], mods: dict[str, Any]) -> bool:
    """Whether modifications are numbers for own quantities that no expression gives: the template stays the same."""
    for name, value in mods.items():
        declaration = cls._declarations.get(name)
        if declaration is None or isinstance(declaration.default, (Expr, Declaration)):
            return False
        if isinstance(value, Start):
            if isinstance(declaration.start, (Expr, Declaration)):
                return False
            if isinstance(value.value, (Bound, Expr, Declaration, list)):
                return False
        elif not isinstance(value, (int, float)):
            return False
        elif declaration.evaluate and any(d.nominal is declaration for d in cls._declarations.values()):
            return False
    return True


def _key(template: Template) -> Any:
    children = tuple(
        (slot.name, slot.role, slot.count, tuple(map(id, slot.templates))) for slot in template.children.values()
    )
    bindings = tuple((b.path, id(b.expression), b.is_start) for b in template.bindings)
    return template.cls, tuple(sorted(template.structural.items())), children, bindings


def in_scope(expression: Expr, cls: type[Component]) -> Expr:
    """Declarations of the class body become symbols of the class."""
    mapping: dict[Expr, Expr] = {}
    for leaf in leaves(expression):
        if leaf.op == "declared":
            declaration: Declaration = leaf.value
            if declaration.name not in cls._declarations:
                raise DeclarationError(
                    f"a modification in the body of `{cls.__name__}` refers to `{declaration.name or '?'}`, which is "
                    f"not a field of that class ({cls._source[0]}:{cls._source[1]})"
                )
            mapping[leaf] = symbol((declaration.name,))
        elif leaf.op == "symbol":
            raise DeclarationError(
                f"`{leaf}` is used in a modification in `{cls.__name__}`: refer to the parameter as it is declared in "
                "the class body (without `self.`), or write an equation"
            )
    return substitute(expression, mapping)


def resolve_scope(child: Any, cls: type[Component], level: int) -> Any:
    """A declaration's default with its expressions bound to the class it is written in."""
    if isinstance(child, Shared):
        return Shared(resolve_scope(child.component, cls, level), child.role)
    if isinstance(child, Array):
        copy = Array(resolve_scope(child._element, cls, level), child._count, **child._values)
        copy._length = child._length
        return copy
    if isinstance(child, (list, tuple)):
        return child if numbers(child) is not None else [resolve_scope(c, cls, level) for c in child]
    if isinstance(child, Component):
        mods = child.__dict__["_mods"]
        if not mods:
            return child
        return record(type(child), {k: resolve_scope(v, cls, level) for k, v in mods.items()})
    if isinstance(child, (Expr, Declaration)):
        return Bound(level, in_scope(as_expr(child), cls))
    if isinstance(child, Start) and isinstance(child.value, (Expr, Declaration)):
        bound: Any = Bound(level, in_scope(as_expr(child.value), cls))
        return Start(bound, child.fixed, child.nominal, child.state_select)
    return child


def _reject_unresolved(component: Any, path: Path) -> None:
    """Expressions make sense in a class body only."""
    if isinstance(component, Array):
        _reject_unresolved(component._element, path)
    if not isinstance(component, Component):
        return
    for name, value in component.__dict__["_mods"].items():
        inner = value.value if isinstance(value, Start) else value
        if isinstance(inner, (Expr, Declaration)):
            raise DeclarationError(
                f"`{path_text((*path, name))}` of the model was given the expression `{as_expr(inner)}`: outside a "
                "class body give numbers; an expression of parameters belongs into the class body that declares them"
            )
        _reject_unresolved(value, (*path, name))


def _columns(child: Array[Any], n: int, name: str) -> tuple[Component, dict[str, Any]]:
    """The first element of an array, and the values of all elements for its own quantities that vary."""
    element = child._element
    given = {**element.__dict__["_mods"], **child._values}
    columns: dict[str, Any] = {}
    first: dict[str, Any] = {}
    for key, value in given.items():
        number: Any = value.value if isinstance(value, Start) else value
        number = number.tolist() if hasattr(number, "tolist") else number
        varies = isinstance(number, (list, tuple)) and key in type(element)._declarations and n > 0
        if varies:
            checked = with_modifications(element, {key: list(number)}).__dict__["_mods"][key]
            columns[key] = checked.value if isinstance(checked, Start) else checked
            head = _pick(number, 0, n, f"{name}.{key}")
            start = isinstance(value, Start)
            first[key] = Start(head, value.fixed, value.nominal, value.state_select) if start else head
        elif key in child._values:
            first[key] = value
    return (with_modifications(element, first) if first else element), columns


def _has_sequence(component: Any) -> bool:
    if not isinstance(component, Component):
        return False
    for value in component.__dict__["_mods"].values():
        inner = value.value if isinstance(value, Start) else value
        if isinstance(inner, list) and not isinstance(next(iter(inner), None), Component):
            return True
        if _has_sequence(value):
            return True
    return False


def _element_mods(element: Component, values: dict[str, Any], i: int, n: int, name: str) -> Component:
    """Element `i` of an array whose values vary."""
    picked = {k: _pick(v, i, n, f"{name}.{k}") for k, v in {**element.__dict__["_mods"], **values}.items()}
    bound = {k: v for k, v in picked.items() if isinstance(v.value if isinstance(v, Start) else v, Bound)}
    copy = with_modifications(element, {k: v for k, v in picked.items() if k not in bound})
    copy.__dict__["_mods"].update(bound)
    return copy


def _pick(value: Any, i: int, n: int, text: str) -> Any:
    if isinstance(value, Component):
        return _element_mods(value, {}, i, n, text) if _has_sequence(value) else value
    if isinstance(value, Start):
        return Start(_pick(value.value, i, n, text), value.fixed, value.nominal, value.state_select)
    if hasattr(value, "tolist"):
        value = value.tolist()
    if isinstance(value, (list, tuple)) and not isinstance(next(iter(value), None), Component):
        if len(value) != n:
            raise DeclarationError(f"component array `{text}` has {n} elements but was given {len(value)} values")
        return value[i]
    return value


def _equation(item: Equation, origin: Origin) -> TemplateEquation:
    return TemplateEquation(item.lhs, item.rhs, replace(origin, kind=DEFINITION) if item.defines else origin)


def _choices(item: Choice, origin: Origin, *, initial: bool) -> list[TemplateChoice]:
    return [
        TemplateChoice(item.condition, wanted, _equation(e, origin), initial)
        for wanted, equations in ((True, item.then), (False, item.otherwise))
        for e in equations
    ]


_KINDS: dict[type, str] = {Connect: "connect", When: "when", Assert: "assert"}
_ITEMS = (Equation, Connect, When, Assert, Choice, Mark, DerivativeRule)


def _run(scope: Component, method: str) -> Any:
    """Items yielded by `equations` (or `initial_equations`), each with the source line that yielded it."""
    generator = getattr(scope, method)()
    cls = type(scope)
    for item in _located(generator, cls, method):
        file, line, owner = _position(generator)
        kind = "initial" if method != "equations" else _KINDS.get(type(item), "equation")
        origin = Origin(owner, file, line, kind)
        if isinstance(item, VectorEquation):
            yield from ((equation, origin) for equation in item.equations)
            continue
        if not isinstance(item, _ITEMS):
            hint = (
                "one side of `==` must be a variable or expression of the component; connectors are joined with "
                "`connect(a, b)`"
                if isinstance(item, bool)
                else "yield `lhs == rhs` or `connect(a, b)`; the base class's with `yield from super().equations()`"
            )
            raise DeclarationError(f"`{owner}.{method}` yields {item!r} at {file}:{line}: {hint}")
        yield item, origin
    ran = scope.__dict__.get(f"_ran_{method}", [])
    for base in cls.__mro__:
        if method in base.__dict__ and base not in (Component, Connector, object) and base not in ran:
            overriding = next(c for c in cls.__mro__ if method in c.__dict__)
            code = overriding.__dict__[method].__wrapped__.__code__
            raise DeclarationError(
                f"`{overriding.__name__}.{method}` never runs `super().{method}()`, so the equations of "
                f"`{base.__name__}` are lost: begin it with `yield from super().{method}()` "
                f"({code.co_filename}:{code.co_firstlineno})"
            )


def _located(generator: types.GeneratorType[Any, Any, Any], cls: type[Component], method: str) -> Iterator[Any]:
    """Items of a generator; an error inside (a symbol used as a number, say) gets the user's line."""
    try:
        yield from generator
    except (TypeError, ValueError, ArithmeticError, LookupError) as error:
        package = os.path.dirname(os.path.dirname(__file__))
        frames = [f for f in traceback.extract_tb(error.__traceback__) if not f.filename.startswith(package)]
        place = f" ({frames[-1].filename}:{frames[-1].lineno})" if frames else ""
        line = f"\n    {frames[-1].line}" if frames and frames[-1].line else ""
        if type(error) is DeclarationError and place.strip(" ()") not in str(error):
            raise DeclarationError(f"{error}{place}{line}") from error
        if isinstance(error, AcausalError):
            raise
        raise DeclarationError(f"in `{cls.__name__}.{method}`{place}: {error}{line}") from error


def _position(generator: types.GeneratorType[Any, Any, Any]) -> tuple[str, int, str]:
    """File, line and class of the innermost suspended generator."""
    inner = generator
    while isinstance(inner.gi_yieldfrom, types.GeneratorType):
        inner = inner.gi_yieldfrom
    frame, code = inner.gi_frame, inner.gi_code
    owner = code.co_qualname.rsplit(".", 1)[0].rsplit("<locals>.", 1)[-1]
    return code.co_filename, frame.f_lineno if frame is not None else code.co_firstlineno, owner
