"""The flat model: integer-numbered variables and parameters, equations in families.

A *family* is one equation template together with the index rows of its instances; ten thousand resistors are one family
of ten thousand rows. Every later stage works on families.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..errors import AcausalError, UnknownNameError, nearest
from ..symbolic.equation import Origin
from ..symbolic.expr import Expr, make, par, var
from ..symbolic.printing import path_text, to_text
from .declarations import Declaration
from .template import Ints, Path, Template

Bools = NDArray[np.bool_]
Floats = NDArray[np.float64]


SHOWN = 5
"""Loops named in one message."""


@dataclass(frozen=True, slots=True, eq=False)
class Source:
    """Where rows of a family come from: an origin in user code, and the instances of the component it stands in.

    Attributes:
        path: pattern of the component's path; a range stands for the elements of an array.
        per_instance: rows per component instance (more than one for an equation over a slice).
    """

    origin: Origin
    path: Path
    per_instance: int

    def component(self, ordinal: int) -> str:
        """Path of the component instance that row `ordinal` belongs to."""
        k = ordinal // self.per_instance
        parts: list[Any] = []
        for part in reversed(self.path):
            if isinstance(part, range):
                parts.append(part[k % len(part)])
                k //= len(part)
            else:
                parts.append(part)
        return path_text(tuple(reversed(parts)))


@dataclass(frozen=True, slots=True, eq=False)
class Family:
    """Equations ``residual == 0`` that differ only in the variables and parameters they refer to.

    Attributes:
        residual: over ``var(k)`` and ``par(k)``, which stand for column k of `var_rows` and `par_rows`.
        var_rows: int64 (n, number of variable slots), indices of variables (derivatives are variables of their own).
        par_rows: int64 (n, number of parameter slots).
        source: int64 (n,), index into `FlatModel.sources`.
        ordinal: int64 (n,), row number within the source.
    """

    residual: Expr
    var_rows: Ints
    par_rows: Ints
    source: Ints
    ordinal: Ints

    @property
    def size(self) -> int:
        """Number of equations."""
        return len(self.source)

    def select(self, rows: Any) -> Family:
        """The family of some of the rows."""
        return Family(self.residual, self.var_rows[rows], self.par_rows[rows], self.source[rows], self.ordinal[rows])


@dataclass(frozen=True, slots=True, eq=False)
class Assignment:
    """Parameters or start values given by expressions of parameters: ``target[i] = expression(par_rows[i])``."""

    targets: Ints
    expression: Expr
    par_rows: Ints
    origin: Origin


@dataclass(eq=False)
class Slots:
    """Values that change at events only: modes of conditions, left limits, triggers.

    Attributes:
        pieces: how each is determined: families of ``relation(slot, a, b)`` (its payload is the comparison),
            ``floor(slot, x)``, ``pre(slot, x)``, ``triggered(slot, conditions...)``, ``sample(slot, start, interval)``.
        kinds: operator of each slot.
        initial, terminal: numbers of the slots that are 1 during initialization and at the end, or -1.
    """

    pieces: list[Family] = field(default_factory=list[Family])
    kinds: list[str] = field(default_factory=list[str])
    initial: int = -1
    terminal: int = -1

    @property
    def count(self) -> int:
        """Number of slots."""
        return len(self.kinds)


@dataclass(eq=False)
class FlatModel:
    """A model with its hierarchy dissolved.

    Attributes:
        root: template of the model, for names.
        n_var: number of declared scalar variables; derivatives follow from this number on.
        n_par: number of scalar parameters.
        derivative_of: int64, for every variable the index of its derivative or -1.
        parent: int64, for every variable the index of the variable it is the derivative of or -1.
        alias_a, alias_b, alias_sign: connection equations ``a = sign * b``; `alias_source` and `alias_ordinal` say
            where from.
        zero: flows of unconnected connectors.
        inputs: variables that are inputs of the whole model.
        actions: what happens at events beside the equations: rows of ``reinit``, ``assert``, ``terminate``.
        slots: values that change at events only; they stand behind the parameters and the inputs.
        rules: ``rule(target, expression)``, derivatives of variables that follow from other equations.
        loops: connections that close loops, and advice for them.
        modified: mask of the declared variables (n_var,) whose start value a modification has given, not their class;
            those of the model itself count as modified. Such guesses count before others.
        evaluated: mask of the parameters that are built into the equations; `evaluated_value` are their values.
    """

    root: Template
    model_name: str
    n_var: int
    n_par: int
    derivative_of: Ints
    parent: Ints
    families: list[Family]
    initial: list[Family]
    alias_a: Ints
    alias_b: Ints
    alias_sign: Ints
    alias_source: Ints
    alias_ordinal: Ints
    zero: Ints
    zero_source: Ints
    zero_ordinal: Ints
    par_value: Floats
    par_assignments: list[Assignment]
    start: Floats
    fixed: NDArray[np.int8]
    nominal: Floats
    select: NDArray[np.int8]
    kind: NDArray[np.int8]
    start_assignments: list[Assignment]
    inputs: Ints
    modified: Bools
    sources: list[Source] = field(default_factory=list[Source])
    actions: list[Family] = field(default_factory=list[Family])
    slots: Slots = field(default_factory=lambda: Slots())
    rules: list[Family] = field(default_factory=list[Family])
    loops: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])
    evaluated: Bools = field(default_factory=lambda: np.zeros(0, bool))
    evaluated_value: Floats = field(default_factory=lambda: np.zeros(0))

    @property
    def n_p(self) -> int:
        """Parameters, inputs and slots."""
        return self.n_par + len(self.inputs) + self.slots.count

    @property
    def n_total(self) -> int:
        """Variables and derivatives."""
        return len(self.derivative_of)

    @cached_property
    def names(self) -> Names:
        """Names of variables and parameters."""
        return Names(self.root)

    def changed(self, **fields: Any) -> FlatModel:
        """A copy with other values of some fields."""
        made = replace(self, **fields)
        made.__dict__["names"] = self.names
        return made

    def name(self, index: int) -> str:
        """Name of a variable or derivative: ``x``, ``der(x)``, ``der(x, 2)``."""
        order = 0
        while index >= self.n_var:
            index = int(self.parent[index])
            order += 1
        base = self.names.variable(index)
        return base if order == 0 else f"der({base})" if order == 1 else f"der({base}, {order})"

    def equation_text(self, family: Family, row: int, form: Expr | None = None) -> str:
        """One equation with the model's names, as ``a = b``."""
        variables, parameters = family.var_rows[row], family.par_rows[row]

        def leaf(node: Expr) -> str:
            if node.op == "var":
                return self.name(int(variables[node.value]))
            if node.op == "par":
                return self.parameter_name(int(parameters[node.value]))
            return "time"

        if form is not None:
            return to_text(form, leaf)
        lhs, rhs = sides(family.residual)
        return f"{to_text(lhs, leaf)} = {to_text(rhs, leaf)}"

    def parameter_name(self, index: int) -> str:
        """Name of a parameter; an input of the whole model goes by the input's name."""
        if index < self.n_par:
            return self.names.parameter(index)
        if index >= self.n_par + len(self.inputs):
            return self.slot_text(index)
        return self.names.variable(int(self.inputs[index - self.n_par]))

    def slot_text(self, index: int) -> str:
        """What slot parameter `index` stands for, in the model's names."""
        if index in (self.slots.initial, self.slots.terminal):
            return "initial()" if index == self.slots.initial else "terminal()"
        for family in self.slots.pieces:
            column = family.residual.args[0].value
            rows = np.flatnonzero(family.par_rows[:, column] == index)
            if len(rows):
                return self.piece_text(family, int(rows[0]))
        return f"event {index}"

    def piece_text(self, family: Family, row: int) -> str:
        """What a row of `Slots.pieces` is about, as the user wrote it."""
        form = family.residual
        op, args = form.op, form.args[1:]
        if op == "relation":
            return self.equation_text(family, row, make(form.value, args))
        texts = ", ".join(self.equation_text(family, row, a) for a in args)
        return texts if op == "triggered" else f"{op}({texts})"

    def loop_hint(self) -> str:
        """What to say of closed loops where the model cannot be solved; empty without loops."""
        if not self.loops:
            return ""
        shown = self.loops[:SHOWN]
        more = f"\n    and {len(self.loops) - SHOWN} more" if len(self.loops) > SHOWN else ""
        lines = [f"    {text}" for text, _ in shown]
        advice = list(dict.fromkeys(advice for _, advice in self.loops if advice))
        return "\n".join(["\nThe model has closed loops, at the connections of", *lines]) + more + "".join(
            f"\n{text}" for text in advice
        )

    def equation_place(self, family: Family, row: int) -> tuple[str, str]:
        """Component path and source position of an equation."""
        source = self.sources[int(family.source[row])]
        return source.component(int(family.ordinal[row])), str(source.origin)

    def equation_line(self, family: Family, row: int) -> str:
        """One equation with its component and source position, for a message."""
        component, place = self.equation_place(family, row)
        return f"{self.equation_text(family, row)}    {component or '(model)'}  {place}"


def sides(residual: Expr) -> tuple[Expr, Expr]:
    """Positive terms on the left, negative ones on the right."""
    from ..symbolic.expr import add, neg

    terms = residual.args if residual.op == "add" else (residual,)
    negative = [t.op == "neg" or (t.op == "const" and t.value < 0) for t in terms]
    lhs = add(*(t for t, n in zip(terms, negative, strict=True) if not n))
    rhs = add(*(neg(t) for t, n in zip(terms, negative, strict=True) if n))
    return (rhs, lhs) if lhs.op == "const" and rhs.op != "const" else (lhs, rhs)


class Names:
    """Names and declarations by index, and indices by name, without a table of all names."""

    def __init__(self, root: Template) -> None:
        self.root = root

    def variable(self, index: int) -> str:
        """Dotted name of variable `index`."""
        return path_text(self._path(index, False)[0])

    def parameter(self, index: int) -> str:
        """Dotted name of parameter `index`."""
        return path_text(self._path(index, True)[0])

    def declaration(self, index: int, *, parameter: bool = False) -> Declaration:
        """Declaration of variable or parameter `index`."""
        return self._path(index, parameter)[1]

    def _path(self, index: int, is_par: bool) -> tuple[Path, Declaration]:
        template, path = self.root, ()
        while True:
            if index < sum(1 for p, _ in template.own.values() if p == is_par):
                name = next(n for n, (p, o) in template.own.items() if p == is_par and o == index)
                return (*path, name), template.cls._declarations[name]
            template, path, index = self._descend(template, path, index, is_par)

    @staticmethod
    def _descend(template: Template, path: Path, index: int, is_par: bool) -> tuple[Template, Path, int]:
        for slot in template.children.values():
            if slot.role == "outer":
                continue
            for prefix, child, v0, p0, n in slot.parts():
                base, size = (p0, child.par_count) if is_par else (v0, child.var_count)
                if base <= index < base + n * size:
                    k, rest = divmod(index - base, size)
                    step = (prefix[0], k) if slot.count is not None and slot.uniform else prefix
                    return child, (*path, *step), rest
        raise IndexError(index)

    @cached_property
    def all_variables(self) -> list[str]:
        """Names of all variables in order."""
        return self._all(False)

    @cached_property
    def all_parameters(self) -> list[str]:
        """Names of all parameters in order."""
        return self._all(True)

    def _all(self, is_par: bool) -> list[str]:
        pairs = sorted(((offset, path) for path, offset in self.root.leaf_names(is_par)), key=lambda pair: pair[0])
        return [path_text(path) for _, path in pairs]

    def find(self, name: str, *, parameter: bool | None = None) -> tuple[Ints, bool]:
        """Indices that a name stands for, and whether they are parameters; a component array without index means all.

        Raises:
            UnknownNameError: with the nearest names.
        """
        try:
            reference = self.root.resolve(self.path(name))
        except (AcausalError, ValueError, IndexError):
            reference = None
        if reference is None or reference.declaration is None:
            patterns = [path_text(path) for path, is_par in _patterns(self.root) if parameter in (None, is_par)]
            what = "parameter" if parameter else "variable"
            raise UnknownNameError(f"the model has no {what} `{name}`.{nearest(name, patterns)}")
        is_par = reference.declaration.kind.name == "PARAMETER"
        if parameter is not None and is_par != parameter:
            what, other = ("parameter", "variable") if parameter else ("variable", "parameter")
            raise UnknownNameError(f"`{name}` is a {other}, not a {what}")
        return (reference.par_offsets if is_par else reference.offsets), is_par

    def path(self, name: str) -> Path:
        """``cells[0].p.v`` as a path; ``cells[1:3]`` and ``cells`` (all elements) hold a range.

        Raises:
            IndexError, ValueError: an index outside the array, or one that is no integer.
        """
        template: Template | None = self.root
        parts: list[Any] = []
        for piece in name.split("."):
            if template is not None and piece in template.own:  # an element of a vector has its index in its name
                parts.append(piece)
                template = None
                continue
            head, _, index = piece.partition("[")
            parts.append(head)
            slot = None if template is None else template.children.get(head)
            template = None if slot is None else slot.templates[0] if slot.templates else None
            if slot is None or slot.count is None:
                if index:
                    raise IndexError(name)
                continue
            chosen = _chosen(index.rstrip("]"), slot.count)
            parts.append(chosen)
            if not slot.uniform:
                template = slot.templates[chosen[0] if isinstance(chosen, range) else chosen]
        return tuple(parts)


def _chosen(text: str, count: int) -> int | range:
    """Elements of an array that an index in a name stands for."""
    if ":" not in text and text:
        return range(count)[int(text)]
    return range(count)[slice(*(int(b) if b else None for b in text.split(":")))] if text else range(count)


def _patterns(template: Template) -> Iterator[tuple[Path, bool]]:
    """Paths of all quantities, of component arrays those of the first element only."""
    for name, (is_par, _) in template.own.items():
        yield (name,), is_par
    for slot in template.children.values():
        if slot.role == "outer":
            continue
        for i, child in enumerate(slot.templates):
            head = (slot.name,) if slot.count is None else (slot.name, i)
            yield from (((*head, *tail), is_par) for tail, is_par in _patterns(child))


def canonical(residual: Expr, var_rows: Ints, par_rows: Ints) -> tuple[Expr, Ints, Ints]:
    """Renumber slots by first occurrence and drop those that do not occur."""
    from ..symbolic.traverse import leaves, substitute

    mapping: dict[Expr, Expr] = {}
    columns: tuple[list[int], list[int]] = ([], [])
    for leaf in leaves(residual):
        if leaf.op in ("var", "par"):
            which = columns[leaf.op == "par"]
            mapping[leaf] = par(len(which)) if leaf.op == "par" else var(len(which))
            which.append(leaf.value)
    complete = len(columns[0]) == var_rows.shape[1] and len(columns[1]) == par_rows.shape[1]
    if complete and all(a is b for a, b in mapping.items()):
        return residual, var_rows, par_rows
    return substitute(residual, mapping), var_rows[:, columns[0]], par_rows[:, columns[1]]
