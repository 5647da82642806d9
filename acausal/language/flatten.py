"""From templates to the flat model: every equation becomes a family of index rows, by arithmetic on offsets."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ..errors import DeclarationError
from ..symbolic.differentiate import differentiate
from ..symbolic.equation import Origin
from ..symbolic.expr import ONE, ZERO, Expr, intern_node, par, var
from ..symbolic.traverse import leaves, rewrite, substitute
from .component import Component
from .connection_sets import ConnectionGraph, End, solve_connections
from .declarations import Kind
from .elaborate import Elaborator
from .flat_model import Assignment, Family, FlatModel, Source, canonical
from .instance import path_text
from .loops import LoopFinder, holds
from .overdetermined import Overdetermined
from .spanning_forest import Forest
from .template import Ints, Path, Reference, Template, TemplateAction, TemplateChoice, TemplateEquation
from .unconnected import LooseEnds

Role = Literal["equation", "initial", "action", "rule"]


@dataclass(slots=True)
class Visit:
    """All instances of one template at one place of the tree.

    Attributes:
        var_base, par_base: first variable and parameter of each instance.
        outer: by name, the bases of the enclosing `inner` component and its template.
    """

    template: Template
    path: Path
    var_base: Ints
    par_base: Ints
    outer: dict[str, tuple[Ints, Ints, Template]]


@dataclass(slots=True)
class Canonical:
    """An equation of a template with its symbols turned into slots."""

    residual: Expr
    variables: list[tuple[Path, int]]
    parameters: list[Path]
    shape: tuple[int, ...]


class Flattener:
    """Walks the templates and collects families."""

    def __init__(self) -> None:
        self.sources: list[Source] = []
        self.rows: dict[Any, list[tuple[Any, ...]]] = {}
        self.residuals: dict[Any, Canonical] = {}
        self.par_assignments: list[Assignment] = []
        self.start_assignments: list[Assignment] = []
        self.graph = ConnectionGraph()
        self.loops = LoopFinder()
        self.ends = LooseEnds()
        self.choices: list[tuple[Visit, TemplateChoice]] = []
        self.evaluated: list[Ints] = []

    def visit_all(self, root: Template) -> None:
        """Every template of the tree, owners before their parts."""
        zero = np.zeros(1, np.int64)
        stack = [Visit(root, (), zero, zero, {})]
        while stack:
            visit = stack.pop()
            self._emit(visit)
            stack.extend(reversed(list(self._below(visit))))

    def _below(self, visit: Visit) -> Iterable[Visit]:
        template = visit.template
        inherited = dict(visit.outer)
        for slot in template.children.values():
            if slot.role == "inner":
                child = slot.templates[0]
                bases = (visit.var_base + slot.var_offsets[0], visit.par_base + slot.par_offsets[0], child)
                inherited[slot.name] = bases
        for slot in template.children.values():
            if slot.role == "outer":
                continue
            for prefix, child, v0, p0, n in slot.parts():
                k = np.arange(n)
                v = (visit.var_base[:, None] + v0 + k * child.var_count).ravel()
                p = (visit.par_base[:, None] + p0 + k * child.par_count).ravel()
                outer = {name: (np.repeat(a, n), np.repeat(b, n), t) for name, (a, b, t) in inherited.items()}
                if slot.role == "inner":
                    outer = {name: bases for name, bases in outer.items() if name != slot.name}
                yield Visit(child, (*visit.path, *prefix), v, p, outer)

    @staticmethod
    def _check_outer(visit: Visit, name: str, wanted: Template) -> None:
        found = visit.outer.get(name)
        where = path_text((*visit.path, name))
        cls = visit.template.cls
        place = f"({cls.__name__}, {cls._source[0]}:{cls._source[1]})"
        if found is None:
            raise DeclarationError(
                f"`{where}` is declared `outer` {place}, but no enclosing component declares an `inner` of that name: "
                f"add `{name}: {wanted.cls.__name__} = ac.inner({wanted.cls.__name__}())` to the model"
            )
        if not issubclass(found[2].cls, wanted.cls):
            raise DeclarationError(
                f"`{where}`: the enclosing inner `{name}` is a `{found[2].cls.__name__}`, not a "
                f"`{wanted.cls.__name__}` as its outer declaration says {place}"
            )

    def _emit(self, visit: Visit) -> None:
        template = visit.template
        for slot in template.children.values():
            if slot.role == "outer":
                self._check_outer(visit, slot.name, slot.templates[0])
        for name, (is_par, offset) in template.own.items():
            if is_par and template.cls._declarations[name].evaluate:
                self.evaluated.append(visit.par_base + offset)
        self.ends.add(template, visit.path, visit.var_base)
        if template.is_connector:
            self.graph.add_connectors(template, visit.var_base, visit.path)
        for equation in template.equations:
            self._emit_equation(visit, equation, "equation")
        for equation in template.initial:
            self._emit_equation(visit, equation, "initial")
        for action in template.actions:
            self._emit_equation(visit, action, "rule" if action.form.op == "rule" else "action")
        if issubclass(template.cls, Overdetermined):
            self.loops.add_nodes(visit.var_base, visit.path)
        for mark, origin in template.marks:
            ids = [self._ids(visit, path) for path in mark.paths]
            self.loops.add_mark(mark, ids, Source(origin, visit.path, 1))
        self.choices += [(visit, choice) for choice in template.choices]
        for item, origin in template.connections:
            source = self._source(visit, origin, 1)
            self.graph.add(item, [self._end(visit, path) for path in item.paths], source, origin)
        for binding in template.bindings:
            self._emit_binding(visit, binding)

    def _source(self, visit: Visit, origin: Origin, per_instance: int) -> int:
        self.sources.append(Source(origin, visit.path, per_instance))
        return len(self.sources) - 1

    def _ids(self, visit: Visit, path: Path, *, parameter: bool = False) -> Ints:
        """Indices that `path` stands for in each instance: (instances, *slice shape)."""
        reference = visit.template.resolve(path)
        v, p = visit.var_base, visit.par_base
        if reference.outer is not None:
            v, p, inner = visit.outer[reference.outer]
            reference = inner.resolve(path[1:])
        return np.add.outer(p, reference.par_offsets) if parameter else np.add.outer(v, reference.offsets)

    def _end(self, visit: Visit, path: Path) -> End:
        reference = visit.template.resolve(path)
        gives = False
        if reference.declaration is not None and reference.inside:
            owner = visit.template.resolve(path[:-1]).template
            gives = reference.declaration.kind == Kind.OUTPUT and owner is not None and owner.has_behaviour()
        elif reference.declaration is not None:
            gives = reference.declaration.kind == Kind.INPUT and len(path) == 1  # not a signal of an own connector
        return End(self._ids(visit, path), reference.template, reference.inside, gives)

    def choose(self, forest: Forest) -> None:
        """The equations that depend on the connection graph, for the instances that they hold for."""
        for visit, choice in self.choices:
            nodes = self._ids(visit, choice.condition.path)
            chosen = holds(choice.condition, nodes, forest) == choice.wanted
            if chosen.any():
                role: Role = "initial" if choice.initial else "equation"
                self._emit_equation(visit, choice.equation, role, np.flatnonzero(chosen))

    def _emit_equation(
        self, visit: Visit, equation: TemplateEquation | TemplateAction, role: Role, some: Ints | None = None
    ) -> None:
        """One equation of all instances, or of `some` of them."""
        form = self._canonical(visit, equation)
        m = len(visit.var_base)
        size = int(np.prod(form.shape, dtype=np.int64))
        columns = [self._broadcast(self._ids(visit, path), m, form.shape) for path, _ in form.variables]
        found = [self._ids(visit, path, parameter=True) for path in form.parameters]
        parameters = [self._broadcast(ids, m, form.shape) for ids in found]
        source = self._source(visit, equation.origin, max(size, 1))
        orders = tuple(order for _, order in form.variables)
        key = (form.residual, orders, role)
        self.residuals[key] = form
        n = m * size
        variables, numbers, ordinal = _stack(columns, n), _stack(parameters, n), np.arange(n)
        if some is not None:
            ordinal = (some[:, None] * size + np.arange(size)).ravel()
            variables, numbers = variables[ordinal], numbers[ordinal]
        self.rows.setdefault(key, []).append((variables, numbers, source, ordinal))

    @staticmethod
    def _broadcast(ids: Ints, m: int, shape: tuple[int, ...]) -> Ints:
        if ids.ndim == 1 and shape:
            ids = ids.reshape((m, *([1] * len(shape))))
        return np.broadcast_to(ids, (m, *shape)).ravel()

    def _canonical(self, visit: Visit, equation: TemplateEquation | TemplateAction) -> Canonical:
        cache = visit.template.cache
        key = id(equation)
        if key not in cache:
            form = equation.form if isinstance(equation, TemplateAction) else equation.lhs - equation.rhs
            cache[key] = canonical_form(visit.template, equation, form)
        return cache[key]

    def _emit_binding(self, visit: Visit, binding: Any) -> None:
        targets = self._ids(visit, binding.path, parameter=not binding.is_start)
        shape = targets.shape[1:]
        m = len(visit.var_base)
        symbols = leaves(binding.expression, op="symbol")
        mapping: dict[Expr, Expr] = {}
        columns: list[Ints] = []
        for leaf in symbols:
            reference = visit.template.resolve(leaf.value)
            if reference.declaration is None or reference.declaration.kind != Kind.PARAMETER:
                raise DeclarationError(
                    f"`{leaf}` in the value of `{_text(visit.path, binding.path)}` is not a parameter: values and "
                    f"start values depend on parameters only {binding.origin}"
                )
            mapping[leaf] = par(len(columns))
            columns.append(self._broadcast(self._ids(visit, leaf.value, parameter=True), m, shape))
        expression = substitute(binding.expression, mapping)
        assignment = Assignment(targets.ravel(), expression, _stack(columns, targets.size), binding.origin)
        (self.start_assignments if binding.is_start else self.par_assignments).append(assignment)


def _text(path: Path, tail: Path) -> str:
    return path_text((*path, *tail))


def _stack(columns: list[Ints], n: int) -> Ints:
    return np.stack(columns, axis=1) if columns else np.zeros((n, 0), np.int64)


def canonical_form(
    template: Template, equation: TemplateEquation | TemplateAction, residual: Expr
) -> Canonical:
    """Symbols become slots, `der` is carried down to variables."""

    def resolved(path: Path) -> Reference:
        try:
            return template.resolve(path)
        except DeclarationError as error:
            raise DeclarationError(f"{error} ({equation.origin})") from None

    def is_parameter(leaf: Expr) -> bool:
        declaration = resolved(leaf.value).declaration
        if declaration is None:
            raise DeclarationError(f"`{leaf}` is a component, not a quantity ({equation.origin})")
        return declaration.kind == Kind.PARAMETER

    residual = expand_derivatives(residual, is_parameter)
    variables: list[tuple[Path, int]] = []
    parameters: list[Path] = []
    shape: tuple[int, ...] = ()
    mapping: dict[Expr, Expr] = {}
    for leaf in leaves(residual):
        if leaf.op in ("time", "initial", "terminal"):
            continue
        if leaf.op == "declared":
            raise DeclarationError(
                f"`{leaf}` in equations() is the declaration of the class, not this component's quantity: write "
                f"`self.{leaf}` ({equation.origin})"
            )
        path, order = (leaf.value, 0) if leaf.op == "symbol" else leaf.value
        reference = resolved(path)
        ids_shape = reference.par_offsets.shape if is_parameter(_symbol(path)) else reference.offsets.shape
        if ids_shape and shape and ids_shape != shape:
            raise DeclarationError(
                f"slices of {shape} and {ids_shape} elements do not fit in one equation ({equation.origin}): "
                f"`{_text((), path)}`"
            )
        shape = shape or ids_shape
        if is_parameter(_symbol(path)):
            mapping[leaf] = par(len(parameters))
            parameters.append(path)
        else:
            mapping[leaf] = var(len(variables))
            variables.append((path, order))
    return Canonical(substitute(residual, mapping), variables, parameters, shape)


def _symbol(path: Path) -> Expr:
    return intern_node("symbol", (), path)


def expand_derivatives(root: Expr, is_parameter: Any) -> Expr:
    """Replace every ``der(e)`` by its total derivative, down to leaves ``derivative`` with payload (path, order)."""

    def tangent(leaf: Expr) -> Expr:
        if leaf.op == "time":
            return ONE
        if leaf.op == "derivative":
            path, order = leaf.value
            return intern_node("derivative", (), (path, order + 1))
        if leaf.op == "symbol" and not is_parameter(leaf):
            return intern_node("derivative", (), (leaf.value, 1))
        return ZERO

    memo: dict[Expr, Expr] = {}

    def replace(node: Expr) -> Expr | None:
        return memo.get(node)

    # innermost `der` first: postorder guarantees operands are expanded before their operator
    from ..symbolic.traverse import postorder

    for node in postorder((root,)):
        if node.op == "der":
            inner = rewrite(node.args, replace)[0]
            memo[node] = differentiate((inner,), tangent)[0]
    return rewrite((root,), replace)[0] if memo else root


def flatten(model: Component) -> FlatModel:
    """Dissolve the hierarchy of `model`.

    Raises:
        DeclarationError, ConnectError: see the message.
    """
    template, attributes = Elaborator().root(model)
    walker = Flattener()
    walker.visit_all(template)
    walker.ends.check(walker.graph, template)
    loops = walker.loops.solve(walker.graph, walker.sources)
    walker.choose(loops.forest)
    joined = solve_connections(walker.graph, template, walker.sources, loops.kept)
    families, others, derivative_of, parent = _families(
        walker, template.var_count, [*joined.sums, *loops.closures]
    )
    n_total = len(derivative_of)
    evaluated = np.zeros(template.par_count, bool)
    evaluated[np.concatenate([np.zeros(0, np.int64), *walker.evaluated])] = True
    inputs = np.array([o for n, (p, o) in template.own.items() if not p and _is_input(template, n)], np.int64)
    pad = n_total - template.var_count
    attributes.modified[[o for is_par, o in template.own.values() if not is_par]] = True  # the model is the user's
    return FlatModel(
        root=template, model_name=type(model).__name__, n_var=template.var_count, n_par=template.par_count,
        derivative_of=derivative_of, parent=parent, families=families,
        initial=others["initial"], actions=[*others["action"], *loops.assertions],
        alias_a=joined.a, alias_b=joined.b, alias_sign=joined.sign,
        alias_source=joined.source, alias_ordinal=joined.ordinal,
        zero=joined.zero, zero_source=joined.zero_source, zero_ordinal=joined.zero_ordinal,
        par_value=attributes.par, par_assignments=walker.par_assignments,
        start=np.pad(attributes.start, (0, pad), constant_values=np.nan),
        fixed=np.pad(attributes.fixed, (0, pad), constant_values=-1),
        nominal=np.pad(attributes.nominal, (0, pad), constant_values=np.nan),
        select=np.pad(attributes.select, (0, pad), constant_values=2),
        kind=np.pad(attributes.kind, (0, pad), constant_values=Kind.VARIABLE),
        start_assignments=walker.start_assignments, inputs=inputs, modified=attributes.modified, sources=walker.sources,
        rules=others["rule"], loops=loops.places, evaluated=evaluated,
        evaluated_value=np.full(template.par_count, np.nan),
    )  # fmt: skip


def _is_input(template: Template, name: str) -> bool:
    return template.cls._declarations[name].kind == Kind.INPUT


def _families(
    walker: Flattener, n_var: int, sums: list[Family]
) -> tuple[list[Family], dict[Role, list[Family]], Ints, Ints]:
    """Number the derivatives, turn the collected rows into families; those that are no equations by their role."""
    derivative_of = np.full(n_var, -1, np.int64)
    parent = np.full(n_var, -1, np.int64)
    highest = max((max(orders, default=0) for _, orders, _ in walker.rows), default=0)
    at_order: list[Ints] = [np.arange(n_var)]
    for order in range(1, highest + 1):
        used = [
            rows[:, k]
            for (_, orders, _), parts in walker.rows.items()
            for rows, *_ in parts
            for k, o in enumerate(orders)
            if o >= order
        ]
        base = np.unique(np.concatenate(used))
        previous = at_order[-1][base]
        new = len(derivative_of) + np.arange(len(base))
        derivative_of[previous] = new
        derivative_of = np.concatenate([derivative_of, np.full(len(base), -1, np.int64)])
        parent = np.concatenate([parent, previous])
        table = np.full(n_var, -1, np.int64)
        table[base] = new
        at_order.append(table)
    families: list[Family] = []
    others: dict[Role, list[Family]] = {"initial": [], "action": [], "rule": []}
    for (residual, orders, role), parts in walker.rows.items():
        rows = np.concatenate([p[0] for p in parts])
        if any(orders):
            rows = np.stack([at_order[o][rows[:, k]] for k, o in enumerate(orders)], axis=1)
        source = np.concatenate([np.full(len(p[3]), p[2]) for p in parts])
        ordinal = np.concatenate([p[3] for p in parts])
        form, rows, parameters = canonical(residual, rows, np.concatenate([p[1] for p in parts]))
        others.get(role, families).append(Family(form, rows, parameters, source, ordinal))
    return [*families, *sums], others, derivative_of, parent
