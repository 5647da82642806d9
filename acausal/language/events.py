"""Hybrid statements: `when`, `reinit`, `assert_`, `terminate`, and the functions that only have a meaning with events.

Names and semantics are those of the Modelica Language Specification 3.6, chapters 3.7 and 8.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from ..errors import DeclarationError
from ..symbolic.equation import Equation
from ..symbolic.expr import Expr, Operand, as_expr, intern_node, make

Level = Literal["error", "warning"]
INITIAL: Final = intern_node("initial", ())
TERMINAL: Final = intern_node("terminal", ())


def pre(x: Operand | Equation) -> Expr:
    """Left limit of x at an event: the value of a discrete variable or condition before it, of any x inside `when`."""
    return make("pre", (as_expr(x),))


def edge(condition: Operand | Equation) -> Expr:
    """Whether the condition has just become true."""
    now = as_expr(condition)
    return now & ~pre(now)


def change(x: Operand | Equation) -> Expr:
    """Whether the discrete quantity x has just got another value."""
    now = as_expr(x)
    return ~make("eq", (now, pre(now)))


def noevent(x: Operand) -> Expr:
    """x, with its conditions evaluated as they are at every moment: nothing is located, the solver sees what is there.

    For conditions at which x and its slope hardly jump, and for those that protect an expression from being evaluated.
    """
    return make("noevent", (as_expr(x),))


def smooth(order: int, x: Operand) -> Expr:
    """x, which is continuous with its derivatives up to `order` although its conditions switch: no event is needed."""
    if not isinstance(order, int) or order < 0:
        raise DeclarationError(f"smooth(order, x): order is a number of derivatives, 0 or more, not {order!r}")
    return noevent(x)


def sample(start: Operand, interval: Operand) -> Expr:
    """True at the events at times ``start + k interval``, k = 0, 1, ...; both depend on parameters only [s]."""
    return make("sample", (as_expr(start), as_expr(interval)))


def initial() -> Expr:
    """True during initialization."""
    return INITIAL


def terminal() -> Expr:
    """True at the end of the simulation."""
    return TERMINAL


@dataclass(frozen=True, slots=True, eq=False)
class Reinit:
    """A new value for a state at an event, made by `reinit`."""

    target: Expr
    value: Expr


@dataclass(frozen=True, slots=True, eq=False)
class Terminate:
    """The end of a simulation at an event, made by `terminate`."""

    message: str


@dataclass(frozen=True, slots=True, eq=False)
class Assert:
    """A condition that must hold, made by `assert_`; `at_start`: at the start alone, whatever it does later."""

    condition: Expr
    message: str
    level: Level
    at_start: bool = False


Action = Mapping[Expr, Operand] | Reinit | Terminate


@dataclass(frozen=True, slots=True, eq=False)
class Branch:
    """Conditions of which one becomes true, and what happens then."""

    conditions: tuple[Expr, ...]
    values: tuple[tuple[Expr, Expr], ...]
    reinits: tuple[Reinit, ...]
    terminate: Terminate | None


@dataclass(frozen=True, slots=True, eq=False)
class When:
    """A `when` statement: its branches, of which the first that is triggered counts."""

    branches: tuple[Branch, ...]

    def elsewhen(self, condition: Operand | Equation | Sequence[Operand | Equation], *actions: Action) -> When:
        """A further branch, for when the conditions above are not triggered."""
        return When((*self.branches, _branch(condition, actions)))


def when(condition: Operand | Equation | Sequence[Operand | Equation], *actions: Action) -> When:
    """What happens at the moment at which a condition becomes true.

    Args:
        condition: a condition, or several in a sequence, each of which triggers the actions.
        *actions: dicts of discrete variables and their new values (a continuous variable is reinitialized), `reinit`
            and `terminate`. All values are computed together, with everything else at that moment; `pre` gives those
            before.
    """
    return When((_branch(condition, actions),))


def reinit(target: Expr, value: Operand) -> Reinit:
    """The state `target` continues from `value` (only inside `when`)."""
    if not isinstance(target, Expr) or target.op != "symbol":
        raise DeclarationError(f"reinit(x, value) gives a variable a new value, and `{target}` is not a variable")
    return Reinit(target, as_expr(value))


def terminate(message: str) -> Terminate:
    """The simulation ends here, successfully (only inside `when`)."""
    return Terminate(str(message))


def assert_(condition: Operand | Equation, message: str, *, level: Level = "error") -> Assert:
    """A condition that must hold at every moment; the run stops with the message, or warns once.

    Where it ceases to hold is found as an event. ``assert_(noevent(condition), ...)``, and a condition of parameters
    alone, are checked at the start and at the points of the result instead, where their values are known (not inside of
    JAX's transformations). One that `initial_equations` yields is checked at the start alone.
    """
    if level not in ("error", "warning"):
        raise DeclarationError(f"assert_(level={level!r}): there are 'error' and 'warning'")
    return Assert(as_expr(condition), str(message), level)


def _branch(condition: Operand | Equation | Sequence[Operand | Equation], actions: Sequence[Action]) -> Branch:
    several = condition if isinstance(condition, (list, tuple)) else (condition,)
    values: list[tuple[Expr, Expr]] = []
    reinits: list[Reinit] = []
    end: Terminate | None = None
    for action in actions:
        if isinstance(action, Reinit):
            reinits.append(action)
        elif isinstance(action, Terminate):
            end = action
        elif isinstance(action, Mapping):
            values += [(target, as_expr(value)) for target, value in action.items()]
        else:
            raise DeclarationError(
                f"when(condition, ...) takes dicts {{variable: value}}, reinit(...) and terminate(...), not {action!r}"
            )
    for target, _ in values:
        if not isinstance(target, Expr) or target.op != "symbol":
            raise DeclarationError(f"when(condition, {{{target}: ...}}): `{target}` is not a variable")
    return Branch(tuple(as_expr(c) for c in several), tuple(values), tuple(reinits), end)
