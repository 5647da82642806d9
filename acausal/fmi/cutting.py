"""Cuts a model at a connector of one of its parts into two models, each with a boundary in the other's place."""

from __future__ import annotations

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import new_class
from typing import Any, cast

from ..errors import ConnectError, DeclarationError, StructureError, nearest
from ..language.checking import constraint_of
from ..language.component import Component, Connector
from ..language.connections import Connect
from ..language.declarations import Declaration, Input, Kind, Output, Parameter
from ..language.elaborate import Elaborator
from ..language.fields import view
from ..language.instance import path_text
from ..language.template import Template
from ..symbolic.equation import Equation
from ..symbolic.expr import Expr
from ..symbolic.traverse import leaves
from ..unit_algebra import UnknownUnit, parse_unit
from .participant import DEGREE

INSTANT = "t_communication"
"""Parameter of a side for the time at which its input polynomials have their origin."""
Path = tuple[Any, ...]


@dataclass(frozen=True)
class Cut:
    """A connector at which a model is cut.

    Attributes:
        path: of the connector, part first.
        kind: its class.
        potentials, flows: names of its variables.
        derivative: whether its power is the flow times the potential's derivative.
    """

    path: Path
    kind: type[Connector]
    potentials: tuple[str, ...]
    flows: tuple[str, ...]
    derivative: bool

    @property
    def prefix(self) -> str:
        """Beginning of the names of the inputs and outputs that stand for this connector."""
        return path_text(self.path).replace(".", "_").replace("[", "_").replace("]", "")

    def field(self, name: str) -> str:
        """Name of the input or output for one of its variables."""
        return f"{self.prefix}_{name}"

    def coefficients(self, potential: str) -> tuple[str, ...]:
        """Names of the parameters for a potential that is imposed: value and Taylor coefficients."""
        own = self.field(potential)
        return (own, *(f"{own}_c{k}" for k in range(1, DEGREE + 1)))


@dataclass(frozen=True)
class Halves:
    """What a model falls into: fields and items of the near side (which owns the cut connectors) and the far side."""

    model: Component
    cuts: tuple[Cut, ...]
    near: frozenset[str]
    shared: frozenset[str]
    far_ends: Mapping[Path, Path]
    items: tuple[Any, ...]
    initial: tuple[Any, ...]

    def side(self, near: bool, imposes_flow: Mapping[Path, bool]) -> Component:
        """A side as a model of its own.

        Args:
            near: the side that owns the cut connectors, or the other.
            imposes_flow: by cut, whether this side is given the flow (and gives the potential).
        """
        return _side(self, near, imposes_flow)


def cut_model(model: Component, at: Sequence[str]) -> Halves:
    """Find what falls apart when connectors of parts of a model are disconnected.

    Args:
        model: an instance of a component class.
        at: dotted paths ``part.connector``.

    Raises:
        DeclarationError: a path that is no connector of a part of the model itself.
        ConnectError: a connector that nothing is connected to.
        StructureError: the two sides hang together in another way too.
    """
    root = view(model, ())
    cuts = tuple(_cut(root, text) for text in at)
    template, _ = Elaborator().root(model)
    shared = frozenset(n for n, slot in template.children.items() if all(t.var_count == 0 for t in slot.templates))
    raw = [item for item in root.equations() if isinstance(item, (Equation, Connect))]
    items, far_ends = _disconnected(raw, cuts)
    initial = tuple(root.initial_equations())
    groups = _Groups()
    for item in items:
        groups.join([n for n in _touched(item) if _counts(template, n, shared)])
    _join_inner(template, groups)
    near = groups.of({c.path[0] for c in cuts})
    for cut in cuts:
        if far_ends[cut.path][0] in near:
            _still_joined(items, cut, far_ends[cut.path], template, shared)
    return Halves(model, cuts, frozenset(near), shared, far_ends, tuple(items), initial)


def _counts(template: Template, name: str, shared: frozenset[str]) -> bool:
    """Whether a field of the model ties equations together: parameters and parts without variables do not."""
    is_par = template.own.get(name, (False, 0))[0]
    return not is_par and name not in shared


def _cut(root: Component, text: str) -> Cut:
    parts = text.split(".")
    cls = type(root)
    if len(parts) != 2:
        raise DeclarationError(
            f"at={text!r}: give a connector of a part of the model itself, `part.connector`; to cut deeper, split the "
            "part"
        )
    if parts[0] not in cls._children:
        raise DeclarationError(
            f"at={text!r}: `{cls.__name__}` has no part `{parts[0]}`.{nearest(parts[0], cls._children)}"
        )
    part = getattr(root, parts[0])
    port = getattr(part, parts[1], None) if isinstance(part, Component) else None
    if not isinstance(port, Connector):
        known = [n for n in type(part)._children if isinstance(getattr(part, n, None), Connector)] if isinstance(
            part, Component) else []  # fmt: skip
        raise DeclarationError(
            f"at={text!r} is not a connector.{nearest(parts[1], known)} `{parts[0]}` has: {', '.join(known) or 'none'}"
        )
    declared = type(port)._declarations
    potentials = tuple(n for n, d in declared.items() if d.kind == Kind.POTENTIAL)
    flows = tuple(n for n, d in declared.items() if d.kind == Kind.FLOW)
    if len(potentials) != len(flows) or not potentials or len(declared) != 2 * len(flows) or type(port)._children:
        raise DeclarationError(
            f"at={text!r}: a connector to cut at has as many potentials as flows and nothing else; "
            f"`{type(port).__name__}` has {len(potentials)} and {len(flows)}"
        )
    return Cut(tuple(parts), type(port), potentials, flows, _is_mechanical(declared, potentials, flows))


def _is_mechanical(declared: Mapping[str, Declaration], potentials: Sequence[str], flows: Sequence[str]) -> bool:
    """Whether potential times flow is an energy, so that power needs the potential's derivative."""
    units = declared[potentials[0]].unit, declared[flows[0]].unit
    if None in units:
        return False
    try:
        product = parse_unit(cast(str, units[0])) * parse_unit(cast(str, units[1]))
        return product.dimension == parse_unit("J").dimension
    except UnknownUnit:
        return False


def _disconnected(items: list[Any], cuts: Sequence[Cut]) -> tuple[list[Any], dict[Path, Path]]:
    """The items without connections to the cut connectors; by cut, an end of what was connected to it."""
    far_ends: dict[Path, Path] = {}
    kept: list[Any] = []
    others: dict[Path, list[tuple[Path, Any]]] = {c.path: [] for c in cuts}
    for item in items:
        hit = [c.path for c in cuts if isinstance(item, Connect) and c.path in item.paths]
        if not hit:
            kept.append(item)
            continue
        rest = [(p, k) for p, k in zip(item.paths, item.connectors, strict=True) if p not in hit]
        for path in hit:
            others[path].extend(rest)
    for path, ends in others.items():
        if not ends:
            raise ConnectError(f"nothing is connected to `{path_text(path)}`: there is nothing to cut")
        far_ends[path] = ends[0][0]
        if len(ends) > 1:
            kept.append(Connect(tuple(p for p, _ in ends), tuple(k for _, k in ends)))
    return kept, far_ends


def _touched(item: Any) -> list[str]:
    if isinstance(item, Connect):
        return [str(p[0]) for p in item.paths]
    return [str(leaf.value[0]) for leaf in leaves(item.lhs - item.rhs) if leaf.op == "symbol"]


class _Groups:
    """Disjoint sets of names."""

    def __init__(self) -> None:
        self.parent: dict[str, str] = {}

    def find(self, name: str) -> str:
        self.parent.setdefault(name, name)
        while self.parent[name] != name:
            name = self.parent[name]
        return name

    def join(self, names: Sequence[str]) -> None:
        for name in names:
            a, b = self.find(names[0]), self.find(name)
            if a != b:
                self.parent[b] = a

    def of(self, names: set[str]) -> set[str]:
        roots = {self.find(n) for n in names}
        return {n for n in self.parent if self.find(n) in roots} | names


def _join_inner(template: Template, groups: _Groups) -> None:
    """Parts that share an `inner` part with variables belong together."""
    for name, slot in template.children.items():
        if slot.role == "inner" and slot.templates[0].var_count:
            users = [n for n, s in template.children.items() if any(_refers(t, name) for t in s.templates)]
            groups.join([name, *users])


def _refers(template: Template, name: str) -> bool:
    stack = [template]
    while stack:
        current = stack.pop()
        for slot in current.children.values():
            if slot.role == "outer":
                if slot.name == name:
                    return True
                continue
            stack.extend(slot.templates)
    return False


def _still_joined(items: Sequence[Any], cut: Cut, end: Path, template: Template, shared: frozenset[str]) -> None:
    """Raise, naming a chain of parts that still joins the two sides."""
    neighbours: dict[str, set[str]] = {}
    for item in items:
        names = [n for n in _touched(item) if _counts(template, n, shared)]
        for a in names:
            neighbours.setdefault(a, set()).update(n for n in names if n != a)
    start, goal = str(cut.path[0]), str(end[0])
    before: dict[str, str] = {start: start}
    queue = [start]
    for name in queue:
        for other in sorted(neighbours.get(name, ())):
            if other not in before:
                before[other] = name
                queue.append(other)
    chain = [goal] if goal in before else []
    while chain and chain[-1] != start:
        chain.append(before[chain[-1]])
    way = " - ".join(reversed(chain)) or f"{start}, {goal}"
    raise StructureError(
        f"cutting at `{path_text(cut.path)}` does not split the model: the two sides are still joined through {way}. "
        "Cut there too: `at=[...]` takes several connectors of one side"
    )


def _side(halves: Halves, near: bool, imposes_flow: Mapping[Path, bool]) -> Component:
    model = halves.model
    cls = type(model)
    namespace: dict[str, Any] = {"__module__": cls.__module__, "__doc__": f"One side of `{cls.__name__}`."}
    annotations: dict[str, Any] = {}

    def mine(name: str) -> bool:
        return name in halves.shared or (name in halves.near) == near

    for name, declaration in cls._declarations.items():
        if declaration.kind == Kind.PARAMETER or mine(name):
            namespace[name] = copy.copy(declaration)
            annotations[name] = type(declaration)
    for name, structural in cls._structural.items():
        namespace[name], annotations[name] = structural.default, structural.annotation
    for name, child in cls._children.items():
        if mine(name):
            namespace[name], annotations[name] = child.default, constraint_of(cls, name)
    items = [i for i in halves.items if all(mine(n) for n in _touched(i) if n not in cls._declarations or
                                            cls._declarations[n].kind != Kind.PARAMETER)]  # fmt: skip
    initial = [i for i in halves.initial if _belongs(i, cls, mine)]
    extra: list[Any] = []
    for cut in halves.cuts:
        _add_boundary(cut, near, imposes_flow[cut.path], halves, namespace, annotations, extra)
    if any(not imposes_flow[c.path] for c in halves.cuts):
        namespace[INSTANT] = Parameter(0.0, unit="s", doc="time of the communication point")
        annotations[INSTANT] = Parameter
    namespace["__annotations__"] = annotations

    def equations(self: Any) -> Any:
        yield from items
        for make in extra:
            yield from make(self)

    def initial_equations(self: Any) -> Any:
        del self
        yield from initial

    namespace["equations"], namespace["initial_equations"] = equations, initial_equations
    made = new_class(f"{cls.__name__}{'Near' if near else 'Far'}", (Component,), None, lambda ns: ns.update(namespace))
    mods = {k: v for k, v in model.__dict__["_mods"].items() if k in annotations}
    return made(**mods)


def _belongs(item: Any, cls: type[Component], mine: Any) -> bool:
    names = [n for n in _touched(item) if n not in cls._declarations or cls._declarations[n].kind != Kind.PARAMETER]
    inside = [mine(n) for n in names]
    if any(inside) and not all(inside):
        raise StructureError(
            f"the initial equation `{item.lhs} == {item.rhs}` of `{cls.__name__}` needs both sides of the split"
        )
    return all(inside)


def _add_boundary(
    cut: Cut, near: bool, flow_given: bool, halves: Halves, namespace: dict[str, Any], annotations: dict[str, Any],
    extra: list[Any],
) -> None:  # fmt: skip
    """Fields and equations that stand for the other side at one cut."""
    boundary = f"{cut.prefix}_boundary"
    namespace[boundary] = _boundary_class(cut.kind)()
    annotations[boundary] = type(namespace[boundary])
    declared = cut.kind._declarations
    given, returned = (cut.flows, cut.potentials) if flow_given else (cut.potentials, cut.flows)
    for name in given:
        d = declared[name]
        fields = (cut.field(name),) if flow_given else cut.coefficients(name)
        for k, field in enumerate(fields):
            doc = d.doc if k == 0 else f"Taylor coefficient {k} of `{fields[0]}`"
            if flow_given:
                namespace[field] = Input(unit=d.unit, nominal=d.nominal, doc=doc)
            else:
                # a parameter, not an input: the compiler differentiates the polynomial with respect to time
                namespace[field] = Parameter(0.0, unit=d.unit if k == 0 else None, doc=doc)
            annotations[field] = type(namespace[field])
    for name in returned:
        d = declared[name]
        namespace[cut.field(name)] = Output(unit=d.unit, nominal=d.nominal, doc=d.doc)
        annotations[cut.field(name)] = Output
    end = cut.path if near else halves.far_ends[cut.path]

    def equations(self: Any) -> Any:
        port = getattr(self, boundary).port
        yield Connect((end, (boundary, "port")), (cut.kind, cut.kind))
        for name in given:
            if flow_given:
                yield getattr(port, name) == getattr(self, cut.field(name))
                continue
            yield getattr(port, name) == _polynomial(self, cut.coefficients(name))
        for name in returned:
            own = getattr(port, name)
            yield getattr(self, cut.field(name)) == (own if flow_given else -own)

    extra.append(equations)


def _polynomial(scope: Any, names: Sequence[str]) -> Expr:
    """Input polynomial as an expression of time, which the compiler can differentiate."""
    from ..language.functions import time

    elapsed = time - getattr(scope, INSTANT)
    value: Expr = getattr(scope, names[-1])
    for name in reversed(names[:-1]):
        value = getattr(scope, name) + elapsed * value
    return value


_boundaries: dict[type[Connector], type[Component]] = {}


def _boundary_class(kind: type[Connector]) -> type[Component]:
    """A component with nothing but one connector of a class; the model it stands in gives its equations."""
    if kind not in _boundaries:
        body = {
            "__module__": __name__, "__doc__": f"Stands for what was connected to a `{kind.__name__}`.",
            "port": kind(), "__annotations__": {"port": kind},
        }  # fmt: skip
        _boundaries[kind] = new_class(f"{kind.__name__}Boundary", (Component,), None, lambda ns: ns.update(body))
    return _boundaries[kind]
