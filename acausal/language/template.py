"""Elaborated classes: one `Template` per distinct structure, shared by all instances that have it.

Equations run once per template, whatever the number of instances; an instance is an offset into the flat arrays of
variables and parameters. That is what keeps a ladder of 100 000 cells as cheap as one of ten.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import DeclarationError, nearest
from ..symbolic.equation import Origin
from ..symbolic.expr import Expr
from .component import Component, Connector
from .connections import Connect
from .declarations import Kind
from .instance import field_names, path_text
from .overdetermined import Mark, RootCondition

Ints = NDArray[np.int64]
Floats = NDArray[np.float64]
Path = tuple[Any, ...]


@dataclass(frozen=True, slots=True)
class TemplateEquation:
    """One equation of a class, over symbols with paths relative to the component."""

    lhs: Expr
    rhs: Expr
    origin: Origin


@dataclass(frozen=True, slots=True)
class TemplateAction:
    """What a class does at events beside its equations: an expression ``reinit``, ``assert`` or ``terminate``."""

    form: Expr
    origin: Origin


@dataclass(frozen=True, slots=True)
class TemplateChoice:
    """An equation that holds for the instances of which `condition` is as `wanted`."""

    condition: RootCondition
    wanted: bool
    equation: TemplateEquation
    initial: bool


@dataclass(frozen=True, slots=True)
class Binding:
    """`path` gets the value of an expression of parameters: a parameter's value, or a variable's start value."""

    path: Path
    expression: Expr
    is_start: bool
    origin: Origin


@dataclass(slots=True)
class ChildSlot:
    """Place of a sub-component in its owner.

    Attributes:
        templates: one for a single component or an array of equal ones (`count` of them), several for a list.
        count: None for a single component.
        role: ``""``, ``inner`` or ``outer`` (an outer child has no variables of its own).
    """

    name: str
    templates: list[Template]
    count: int | None
    role: str
    var_offsets: list[int] = field(default_factory=list[int])
    par_offsets: list[int] = field(default_factory=list[int])

    @property
    def uniform(self) -> bool:
        """Whether one template serves all elements."""
        return len(self.templates) == 1

    def parts(self) -> Iterator[tuple[Path, Template, int, int, int]]:
        """(path suffix, template, first variable offset, first parameter offset, repetitions) of each run of equals."""
        if self.count is None:
            yield (self.name,), self.templates[0], self.var_offsets[0], self.par_offsets[0], 1
        elif self.uniform:
            if self.count:
                prefix = (self.name, range(self.count))
                yield prefix, self.templates[0], self.var_offsets[0], self.par_offsets[0], self.count
        else:
            for i, template in enumerate(self.templates):
                yield (self.name, i), template, self.var_offsets[i], self.par_offsets[i], 1


@dataclass(slots=True)
class Reference:
    """What a path leads to: offsets relative to the component (or to the shared component `outer`).

    Attributes:
        offsets: int64 array; its shape is the shape of the slices on the path.
        declaration: of the quantity; None if the path leads to a connector or component.
        template: of the connector or component.
        outer: name of the `outer` child the path starts with.
    """

    offsets: Ints
    par_offsets: Ints
    declaration: Any  # Declaration | None; the class is a descriptor, which a type checker would apply here
    template: Template | None
    outer: str | None
    inside: bool


class Template:
    """One distinct structure of a component class."""

    def __init__(self, cls: type[Component], structural: dict[str, Any]) -> None:
        self.cls = cls
        self.structural = structural
        self.own: dict[str, tuple[bool, int]] = {}
        self.children: dict[str, ChildSlot] = {}
        self.var_count = 0
        self.par_count = 0
        self.equations: list[TemplateEquation] = []
        self.initial: list[TemplateEquation] = []
        self.actions: list[TemplateAction] = []
        self.choices: list[TemplateChoice] = []
        self.marks: list[tuple[Mark, Origin]] = []
        self.connections: list[tuple[Connect, Origin]] = []
        self.bindings: list[Binding] = []
        self.cache: dict[Any, Any] = {}

    @property
    def is_connector(self) -> bool:
        """Whether the class is a connector."""
        return issubclass(self.cls, Connector)

    def layout_own(self) -> None:
        """Number the class's own variables and parameters."""
        for name, declaration in self.cls._declarations.items():
            if declaration.kind == Kind.PARAMETER:
                self.own[name] = (True, self.par_count)
                self.par_count += 1
            else:
                self.own[name] = (False, self.var_count)
                self.var_count += 1

    def add_child(self, slot: ChildSlot) -> None:
        """Append a child's block of variables and parameters."""
        self.children[slot.name] = slot
        if slot.role == "outer":
            slot.var_offsets, slot.par_offsets = [0], [0]
            return
        repeats = [slot.count if slot.count is not None and slot.uniform else 1] * len(slot.templates)
        for template, n in zip(slot.templates, repeats, strict=True):
            slot.var_offsets.append(self.var_count)
            slot.par_offsets.append(self.par_count)
            self.var_count += n * template.var_count
            self.par_count += n * template.par_count

    def resolve(self, path: Path) -> Reference:
        """Follow `path`.

        Raises:
            DeclarationError: the path leads nowhere.
        """
        cached = self.cache.get(path)
        if cached is None:
            cached = self.cache[path] = self._resolve(path)
        return cached

    def _resolve(self, path: Path) -> Reference:
        template: Template = self
        offset, par_offset = np.zeros((), np.int64), np.zeros((), np.int64)
        outer: str | None = None
        inside = False
        i = 0
        while i < len(path):
            part = path[i]
            if part in template.own:
                is_par, own = template.own[part]
                declaration = template.cls._declarations[part]
                zero = np.zeros((), np.int64)
                if is_par:
                    return Reference(zero, par_offset + own, declaration, None, outer, inside)
                return Reference(offset + own, zero, declaration, None, outer, inside)
            slot = template.children.get(part)
            if slot is None and part in template.cls._vectors:
                return _whole(template, part, offset, par_offset, outer, inside)
            if slot is None:
                hint = nearest(str(part), field_names(template.cls))
                raise DeclarationError(f"`{path_text(path)}`: `{template.cls.__name__}` has no `{part}`.{hint}")
            if slot.role == "outer":
                outer, offset, par_offset = part, np.zeros((), np.int64), np.zeros((), np.int64)
            inside = inside or not slot.templates[0].is_connector
            i += 1
            index: Any = None
            if slot.count is not None:
                index = path[i] if i < len(path) else range(slot.count)
                i += 1
            if not slot.uniform and isinstance(index, range):
                found = _of_different(slot, index, path[i:])
                within = found.outer is None
                if found.offsets.ndim:
                    found.offsets = np.add.outer(offset * within, found.offsets)
                if found.par_offsets.ndim:
                    found.par_offsets = np.add.outer(par_offset * within, found.par_offsets)
                return replace(found, outer=outer if within else found.outer, inside=inside or found.inside)
            template, v, p = _element(slot, index)
            plain = isinstance(v, int)
            offset = offset + v if plain else np.add.outer(offset, v)
            par_offset = par_offset + p if plain else np.add.outer(par_offset, p)
        return Reference(offset, par_offset, None, template, outer, inside)

    def has_behaviour(self) -> bool:
        """Whether the component says something about its quantities, and is no mere place for them."""
        said = self.equations or self.connections or self.actions or self.choices
        return bool(said) or any(not t.is_connector for slot in self.children.values() for t in slot.templates)

    def leaf_names(self, is_par: bool) -> Iterator[tuple[Path, int]]:
        """Every variable (or parameter) below, in order, with its offset; arrays of components unrolled."""
        for name, (par, offset) in self.own.items():
            if par == is_par:
                yield (name,), offset
        for slot in self.children.values():
            if slot.role == "outer":
                continue
            for prefix, template, v0, p0, n in slot.parts():
                stride = template.par_count if is_par else template.var_count
                below = list(template.leaf_names(is_par))
                base = p0 if is_par else v0
                for k in range(n):
                    head = (prefix[0], k) if slot.count is not None and slot.uniform else prefix
                    for tail, offset in below:
                        yield (*head, *tail), base + k * stride + offset


def _whole(template: Template, name: str, offset: Ints, par_offset: Ints, outer: str | None, inside: bool) -> Reference:
    """All elements of a vector or matrix, as a slice."""
    names = template.cls._vectors[name].names()
    if not names:
        raise DeclarationError(f"`{template.cls.__name__}.{name}` has no elements")
    is_par = template.own[names[0]][0]
    own = np.array([template.own[n][1] for n in names], np.int64)
    declaration = template.cls._declarations[names[0]]
    none = np.zeros(np.add.outer(offset, own).shape, np.int64)
    if is_par:
        return Reference(none, np.add.outer(par_offset, own), declaration, None, outer, inside)
    return Reference(np.add.outer(offset, own), none, declaration, None, outer, inside)


def _element(slot: ChildSlot, index: Any) -> tuple[Template, Any, Any]:
    """Template and offsets of the elements of `slot` chosen by `index` (None, an int or a range)."""
    if index is None:
        return slot.templates[0], slot.var_offsets[0], slot.par_offsets[0]
    if isinstance(index, str):
        raise DeclarationError(f"`{slot.name}` is an array of components: take an element, `{slot.name}[0].{index}`")
    if slot.uniform:
        template = slot.templates[0]
        k = index if isinstance(index, int) else np.asarray(index, np.int64)
        return template, slot.var_offsets[0] + k * template.var_count, slot.par_offsets[0] + k * template.par_count
    return slot.templates[index], slot.var_offsets[index], slot.par_offsets[index]


def _of_different(slot: ChildSlot, index: range, rest: Path) -> Reference:
    """What `rest` leads to in the elements of a slice that are components of several classes, as one reference."""
    what = f"`{slot.name}[{index.start}:{index.stop}]{f'.{path_text(rest)}' if rest else ''}`"
    try:
        found = [slot.templates[i].resolve(rest) for i in index]
    except DeclarationError as error:
        raise DeclarationError(f"{what} is not in all elements: {error}") from None
    kinds = {(None if r.declaration is None else r.declaration.kind, id(r.template), r.outer) for r in found}
    if len(kinds) != 1 or len({(r.offsets.shape, r.par_offsets.shape) for r in found}) != 1:
        raise DeclarationError(
            f"{what} is not the same in all elements, which are of different classes: take them one by one, "
            f"`for part in self.{slot.name}`"
        )
    first, within = found[0], found[0].outer is None
    offsets = np.stack([r.offsets + within * slot.var_offsets[i] for r, i in zip(found, index, strict=True)])
    par_offsets = np.stack([r.par_offsets + within * slot.par_offsets[i] for r, i in zip(found, index, strict=True)])
    if first.declaration is not None:  # a quantity is a variable or a parameter
        is_par = first.declaration.kind == Kind.PARAMETER
        offsets, par_offsets = (np.zeros((), np.int64), par_offsets) if is_par else (offsets, np.zeros((), np.int64))
    return Reference(offsets, par_offsets, first.declaration, first.template, first.outer, first.inside)


@dataclass(slots=True)
class Attributes:
    """Numbers of one instance: parameter values and variable attributes, in template order.

    Attributes:
        par: parameter values, nan where bound by an expression or missing.
        start: start values, nan where not given.
        fixed: 1, 0, or -1 where not given.
        nominal: nan where not given.
        select: index into `STATE_SELECT`.
        kind: `Kind` of each variable.
        modified: whether a modification has given the start value, not the class.
    """

    par: Floats
    start: Floats
    fixed: NDArray[np.int8]
    nominal: Floats
    select: NDArray[np.int8]
    kind: NDArray[np.int8]
    modified: NDArray[np.bool_]

    def copy(self) -> Attributes:
        """An independent copy."""
        return Attributes(*(a.copy() for a in self.arrays()))

    def arrays(self) -> tuple[Any, ...]:
        """All arrays."""
        return self.par, self.start, self.fixed, self.nominal, self.select, self.kind, self.modified

    @staticmethod
    def join(parts: list[Attributes]) -> Attributes:
        """Concatenation."""
        if len(parts) == 1:
            return parts[0]
        return Attributes(*(np.concatenate(arrays) for arrays in zip(*(p.arrays() for p in parts), strict=True)))

    def tile(self, n: int) -> Attributes:
        """`n` copies in a row."""
        return Attributes(*(np.tile(a, n) for a in self.arrays()))
