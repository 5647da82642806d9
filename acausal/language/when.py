"""`when` and `assert_` as equations and actions of a class.

A discrete variable d that is assigned obeys ``d = where(triggered, value, pre(d))``: an equation like any other, which
is sorted and solved with all others. What `reinit`, `assert_` and `terminate` do stays beside the equations.
"""

from __future__ import annotations

from ..errors import DeclarationError
from ..symbolic.equation import Equation, Origin
from ..symbolic.expr import Expr, intern_node, make
from .declarations import Kind
from .events import INITIAL, Assert, Branch, Reinit, When, noevent
from .template import Template, TemplateAction, TemplateEquation


def statements(item: When, template: Template, origin: Origin) -> tuple[list[TemplateEquation], list[TemplateAction]]:
    """Equations and actions of a `when` statement.

    Raises:
        DeclarationError: it assigns something that cannot be assigned.
    """
    triggers = [make("triggered", branch.conditions) for branch in item.branches]
    assigned: dict[Expr, list[tuple[Expr, Expr]]] = {}
    actions: list[TemplateAction] = []
    earlier: Expr | None = None
    for trigger, branch in zip(triggers, item.branches, strict=True):
        active = trigger if earlier is None else trigger & ~earlier
        for target, value in branch.values:
            if _kind(template, target, origin) == Kind.DISCRETE:
                assigned.setdefault(target, []).append((active, value))
        actions += [_reinit(r, active, template, origin) for r in _reinits(branch, template, origin)]
        if branch.terminate is not None:
            actions.append(TemplateAction(intern_node("terminate", (active,), branch.terminate.message), origin))
        earlier = trigger if earlier is None else earlier | trigger
    equations: list[TemplateEquation] = []
    for target, choices in assigned.items():
        new = make("pre", (target,))
        for active, value in reversed(choices):
            new = make("where", (active, value, new))
        equations.append(TemplateEquation(target, new, origin))
    return equations, actions


def starts_discrete(item: Equation, template: Template, origin: Origin) -> bool:
    """Whether an initial equation gives a discrete variable; the `when` that assigns it has that value at the start.

    Raises:
        DeclarationError: the variable belongs to another component, or it is ``pre`` of a variable that is given.
    """
    for target, value in ((item.lhs, item.rhs), (item.rhs, item.lhs)):
        name = target.args[0] if target.op == "pre" else target
        declaration = template.resolve(name.value).declaration if name.op == "symbol" else None
        if declaration is None or declaration.kind != Kind.DISCRETE:
            continue
        found = [k for k, e in enumerate(template.equations) if e.lhs is name and e.origin.kind == "when"]
        if target is name and found:
            k = found[0]
            old = template.equations[k]
            new = make("where", (INITIAL, value, old.rhs))
            template.equations[k] = TemplateEquation(name, new, old.origin)
            return True
        if target is not name or len(name.value) > 1:
            raise DeclarationError(
                f"initial equation `{item.lhs} == {item.rhs}`: before the first event `{name}` has its start value: "
                f"give that, `start({value})` in place of `{name}`, or assign it in `when(initial(), ...)` ({origin})"
            )
    return False


def _reinits(branch: Branch, template: Template, origin: Origin) -> list[Reinit]:
    given = [Reinit(t, v) for t, v in branch.values if _kind(template, t, origin) != Kind.DISCRETE]
    found = [*given, *branch.reinits]
    given_twice = [t for k, (t, _) in enumerate(branch.values) if any(t is u for u, _ in branch.values[:k])]
    given_twice += [r.target for k, r in enumerate(found) if any(r.target is q.target for q in found[:k])]
    for target in given_twice[:1]:
        raise DeclarationError(
            f"`when` gives `{target}` two new values at the same moment: leave one of them, or say with `elsewhen` or "
            f"`where` which one counts ({origin})"
        )
    return found


def _reinit(item: Reinit, active: Expr, template: Template, origin: Origin) -> TemplateAction:
    if _kind(template, item.target, origin) == Kind.DISCRETE:
        raise DeclarationError(
            f"reinit({item.target}, ...): a `Discrete` is assigned, `when(condition, {{{item.target}: ...}})` "
            f"({origin})"
        )
    return TemplateAction(intern_node("reinit", (item.target, active, item.value)), origin)


def _kind(template: Template, target: Expr, origin: Origin) -> Kind:
    declaration = template.resolve(target.value).declaration
    if declaration is None or declaration.kind in (Kind.PARAMETER, Kind.INPUT):
        what = "a component" if declaration is None else declaration.kind.name.lower()
        raise DeclarationError(
            f"`{target}` is {'' if declaration is None else 'of kind '}{what} and cannot be assigned in `when`: "
            f"declare it as `{target}: Discrete = Discrete()` ({origin})"
        )
    return declaration.kind


def assertion(item: Assert, origin: Origin) -> TemplateAction:
    """The action of `assert_`."""
    return TemplateAction(assertion_form(item), origin)


def assertion_form(item: Assert) -> Expr:
    """`assert_` as an expression."""
    condition = noevent(item.condition) if item.at_start else item.condition
    return intern_node("assert", (condition,), (item.message, item.level, item.at_start))
