"""Interned, immutable expression nodes.

Two structurally equal expressions are the same object (hash-consing; Filliâtre and Conchon 2006, "Type-safe modular
hash-consing"), so identity is equality, common subexpressions are shared for free, and every traversal memoises by
node. Only local simplification happens at construction (constant folding, ``x + 0``, ``x * 1``, ``x - x``): no
expansion, no sorting, no assumptions. Anything cleverer is a named pass elsewhere.
"""

from __future__ import annotations

import math
import threading
import weakref
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Final, NoReturn

if TYPE_CHECKING:
    from .equation import Equation

_TABLE: weakref.WeakValueDictionary[tuple[Any, ...], Expr] = weakref.WeakValueDictionary()
_LOCK = threading.RLock()


class Expr:
    """A scalar expression (or an array of them, one per element of the component array it refers to).

    Attributes:
        op: name of the operator, a row of `acausal.symbolic.operators.OPERATORS`, or one of the leaf kinds
            ``const``, ``symbol``, ``declared``, ``var``, ``par``, ``time``.
        args: operands.
        value: payload of a leaf (a float, a path, an index) or of an opaque call (the function).
    """

    __slots__ = ("__weakref__", "args", "op", "value")
    op: str
    args: tuple[Expr, ...]
    value: Any

    def __setattr__(self, name: str, value: object) -> NoReturn:
        raise AttributeError(f"expressions are immutable; cannot set {name!r}")

    def __add__(self, other: Operand) -> Expr:
        return add(self, as_expr(other))

    def __radd__(self, other: Operand) -> Expr:
        return add(as_expr(other), self)

    def __sub__(self, other: Operand) -> Expr:
        return add(self, neg(as_expr(other)))

    def __rsub__(self, other: Operand) -> Expr:
        return add(as_expr(other), neg(self))

    def __mul__(self, other: Operand) -> Expr:
        if hasattr(other, "__acausal_elements__"):  # a vector multiplies its elements itself
            return NotImplemented
        return mul(self, as_expr(other))

    def __rmul__(self, other: Operand) -> Expr:
        return mul(as_expr(other), self)

    def __truediv__(self, other: Operand) -> Expr:
        return div(self, as_expr(other))

    def __rtruediv__(self, other: Operand) -> Expr:
        return div(as_expr(other), self)

    def __pow__(self, other: Operand) -> Expr:
        return power(self, as_expr(other))

    def __rpow__(self, other: Operand) -> Expr:
        return power(as_expr(other), self)

    def __neg__(self) -> Expr:
        return neg(self)

    def __pos__(self) -> Expr:
        return self

    def __abs__(self) -> Expr:
        return make("abs", (self,))

    def __lt__(self, other: Operand) -> Expr:
        return make("lt", (self, as_expr(other)))

    def __le__(self, other: Operand) -> Expr:
        return make("le", (self, as_expr(other)))

    def __gt__(self, other: Operand) -> Expr:
        return make("gt", (self, as_expr(other)))

    def __ge__(self, other: Operand) -> Expr:
        return make("ge", (self, as_expr(other)))

    def __and__(self, other: Operand) -> Expr:
        return make("and", (self, _logical(other, "&")))

    def __or__(self, other: Operand) -> Expr:
        return make("or", (self, _logical(other, "|")))

    def __rand__(self, other: Operand) -> Expr:
        return make("and", (_logical(other, "&"), self))

    def __ror__(self, other: Operand) -> Expr:
        return make("or", (_logical(other, "|"), self))

    def __invert__(self) -> Expr:
        return make("not", (self,))

    def __eq__(self, other: Operand) -> Equation:  # type: ignore[override]
        from .equation import Equation

        return Equation(self, as_expr(other))

    def __ne__(self, other: object) -> NoReturn:
        raise TypeError(
            "`!=` between expressions has no meaning in a model: write an equation with `==`, or a condition "
            "with `<`, `<=`, `>`, `>=`, `&`, `|`, `~` inside where(...)"
        )

    def __bool__(self) -> NoReturn:
        raise TypeError(
            f"the truth value of the expression `{self}` is not known while a model is being written. "
            "Use where(condition, a, b) instead of `if`, `&` and `|` instead of `and` and `or`, and chain "
            "comparisons as (lo < x) & (x < hi); plain Python `if` works on structural parameters only"
        )

    def __float__(self) -> NoReturn:
        raise TypeError(
            f"`{self}` is a symbol, not a number, so math.* and numpy functions cannot take it: use the function of "
            "the same name from acausal (acausal.sqrt, acausal.sin, ...), or wrap a JAX function with acausal.function"
        )

    def __array__(self, *args: object, **kwargs: object) -> NoReturn:
        raise TypeError(
            f"`{self}` is a symbol, not an array: use the functions of acausal (acausal.sqrt, acausal.sin, ...), or "
            "wrap a JAX function with acausal.function"
        )

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **kwargs: Any) -> Any:
        """Arithmetic with numbers of numpy; arrays and numpy's functions are refused."""
        name = _UFUNCS.get(ufunc.__name__)
        if name is not None and method == "__call__" and not kwargs and all(not getattr(i, "ndim", 0) for i in inputs):
            return getattr(as_expr(inputs[0]), name)(inputs[1])
        return self.__array__()

    __jax_array__ = None  # type: ignore[assignment]

    def __iter__(self) -> NoReturn:
        raise TypeError(f"`{self}` is one expression and cannot be iterated over")

    def __hash__(self) -> int:
        return id(self) >> 4

    def __copy__(self) -> Expr:
        return self

    def __deepcopy__(self, memo: object) -> Expr:
        return self

    def __reduce__(self) -> tuple[Any, ...]:
        return (_rebuild, (self.op, self.args, self.value))

    @property
    def name(self) -> str:
        """Dotted name of a variable or parameter; of any other expression, its text."""
        return str(self)

    def __str__(self) -> str:
        from .printing import to_text

        return to_text(self)

    def __repr__(self) -> str:
        return f"Expr({self})"


_UFUNCS: Final = {
    "add": "__add__", "subtract": "__sub__", "multiply": "__mul__", "divide": "__truediv__", "power": "__pow__",
    "less": "__lt__", "less_equal": "__le__", "greater": "__gt__", "greater_equal": "__ge__", "equal": "__eq__",
}  # fmt: skip

Operand = Any
"""What arithmetic accepts beside an expression: a number, or a declaration of the class body (`Parameter`, ...)."""


def intern_node(op: str, args: tuple[Expr, ...], value: Any = None) -> Expr:
    """The one node with this operator, operands and payload (no simplification)."""
    key = (op, type(value), value, *map(id, args))
    node = _TABLE.get(key)
    if node is not None:
        return node
    with _LOCK:
        node = _TABLE.get(key)
        if node is None:
            node = object.__new__(Expr)
            object.__setattr__(node, "op", op)
            object.__setattr__(node, "args", args)
            object.__setattr__(node, "value", value)
            _TABLE[key] = node
        return node


def _logical(other: Operand, operator: str) -> Expr:
    """An operand of ``&`` or ``|``; a number is none, but what is left of a comparison without parentheses."""
    if isinstance(other, (int, float)) and not isinstance(other, bool):
        raise TypeError(
            f"`{operator}` joins conditions, and {other!r} is a number: it binds closer than comparisons do, so write "
            f"(a > 0) {operator} (b > 0), each comparison in parentheses"
        )
    return as_expr(other)


def _rebuild(op: str, args: tuple[Expr, ...], value: Any) -> Expr:
    return intern_node(op, args, value)


def const(value: float) -> Expr:
    """A number."""
    number = float(value)
    return intern_node("const", (), 0.0 if number == 0.0 else number)


ZERO: Final = const(0.0)
ONE: Final = const(1.0)
MINUS_ONE: Final = const(-1.0)
TIME: Final = intern_node("time", ())


def symbol(path: tuple[str | int | range, ...]) -> Expr:
    """A variable or parameter by its path relative to the component whose equations are being written."""
    return intern_node("symbol", (), path)


def var(index: int) -> Expr:
    """Variable number `index` (of a family's index rows, or of the flat model)."""
    return intern_node("var", (), index)


def par(index: int) -> Expr:
    """Parameter number `index` (of a family's index rows, or of the flat model)."""
    return intern_node("par", (), index)


def as_expr(value: Operand) -> Expr:
    """`value` as an expression.

    Raises:
        TypeError: for what is neither a number, an expression nor a declaration.
    """
    if isinstance(value, Expr):
        return value
    if isinstance(value, (int, float)):
        return const(value)
    convert = getattr(value, "__acausal_expr__", None)
    if convert is not None:
        return convert()
    if hasattr(value, "__float__") and getattr(value, "ndim", 0) == 0:  # numpy and JAX scalars
        return const(float(value))
    raise TypeError(
        f"{type(value).__name__} cannot stand in an equation (got {value!r}): numbers, variables, parameters and "
        "expressions of them can; a sub-component or connector needs one of its variables, as in `self.port.p`"
    )


def is_const(node: Expr, value: float | None = None) -> bool:
    """Whether `node` is a number (this one, if given)."""
    return node.op == "const" and (value is None or node.value == value)


CONDITIONS: Final = frozenset({"lt", "le", "gt", "ge", "eq", "and", "or", "not"})


def numeric(node: Expr) -> Expr:
    """A condition as the number 0 or 1; any other expression as it is."""
    return make("where", (node, ONE, ZERO)) if node.op in CONDITIONS else node


LONGEST = 32
"""A sum of more terms than this stays one term of another. In a chain each sum is the one before it and one term more:
written out they would grow with the square of its length."""
ROUNDING = 4e-16
"""A sum of numbers that is this small beside them is zero: what is left of ``0.1 + 0.2 - 0.3`` is no coefficient."""


def add(*terms: Expr) -> Expr:
    """Sum, with constants folded and ``x - x`` cancelled; flat, but for sums of very many terms, which are shared."""
    flat: list[Expr] = []
    long = False
    for term in map(numeric, terms):
        short = term.op == "add" and len(term.args) <= LONGEST
        long = long or (term.op == "add" and not short)
        flat.extend(term.args if short else (term,))
    if long:
        flat = _opened(flat)
    constant = size = 0.0
    kept: list[Expr] = []
    for term in flat:
        if term.op == "const":
            constant += term.value
            size += abs(term.value)
        else:
            kept.append(term)
    kept = _cancel(kept)
    if constant != 0.0 and not abs(constant) <= ROUNDING * size < math.inf:
        kept.append(const(constant))
    if not kept:
        return ZERO
    if len(kept) == 1:
        return kept[0]
    return intern_node("add", tuple(kept))


def _opened(terms: list[Expr]) -> list[Expr]:
    """With the long sums among the terms written out that have a term which another one cancels."""
    single = {_signed(term) for term in terms if term.op != "add"}
    out: list[Expr] = []
    for term in terms:
        cancels = term.op == "add" and any((key, not negative) in single for key, negative in map(_signed, term.args))
        out.extend(term.args if cancels else (term,))
    return out


def _signed(term: Expr) -> tuple[int, bool]:
    negative = term.op == "neg"
    return id(term.args[0] if negative else term), negative


def _cancel(terms: list[Expr]) -> list[Expr]:
    """Drop pairs ``x`` and ``-x``."""
    count: dict[int, int] = {}
    paired = False
    for term in terms:
        key, negative = _signed(term)
        old = count.get(key, 0)
        step = -1 if negative else 1
        paired = paired or old * step < 0
        count[key] = old + step
    if not paired:
        return terms
    kept: list[Expr] = []
    for term in terms:
        key, negative = _signed(term)
        left = count[key]
        if (left < 0) if negative else (left > 0):
            kept.append(term)
            count[key] = left + (1 if negative else -1)
    return kept


def neg(x: Expr) -> Expr:
    """``-x``."""
    x = numeric(x)
    if x.op == "const":
        return const(-x.value)
    if x.op == "neg":
        return x.args[0]
    if x.op == "add" and len(x.args) <= LONGEST:
        return add(*(neg(a) for a in x.args))
    return intern_node("neg", (x,))


def mul(a: Expr, b: Expr) -> Expr:
    """``a * b``; constants and signs move to the front."""
    a, b = numeric(a), numeric(b)
    if a.op == "const" and b.op == "const":
        return const(a.value * b.value)
    if b.op == "const":
        a, b = b, a
    if a.op == "const":
        if a.value == 0.0:
            return ZERO
        if a.value == 1.0:
            return b
        if a.value == -1.0:
            return neg(b)
        if b.op == "mul" and b.args[0].op == "const":
            return mul(const(a.value * b.args[0].value), b.args[1])
    if a.op == "neg":
        return neg(mul(a.args[0], b))
    if b.op == "neg":
        return neg(mul(a, b.args[0]))
    return intern_node("mul", (a, b))


def div(a: Expr, b: Expr) -> Expr:
    """``a / b``."""
    a, b = numeric(a), numeric(b)
    if b.op == "const":
        if b.value == 0.0:
            raise ZeroDivisionError(f"division of `{a}` by the constant 0")
        return const(a.value / b.value) if a.op == "const" else a if b.value == 1.0 else intern_or_sign(a, b)
    if is_const(a, 0.0):
        return ZERO
    if a is b:
        return ONE
    return intern_or_sign(a, b)


def intern_or_sign(a: Expr, b: Expr) -> Expr:
    """The quotient with signs pulled to the front."""
    if a.op == "neg":
        return neg(div(a.args[0], b))
    if b.op == "neg":
        return neg(div(a, b.args[0]))
    if b.op == "const" and b.value < 0:
        return neg(div(a, const(-b.value)))
    return intern_node("div", (a, b))


def power(a: Expr, b: Expr) -> Expr:
    """``a ** b``."""
    a, b = numeric(a), numeric(b)
    if b.op == "const":
        if b.value == 0.0:
            return ONE
        if b.value == 1.0:
            return a
        if a.op == "const":
            result = a.value**b.value
            if isinstance(result, complex):
                raise ValueError(f"{a.value} ** {b.value} is not a real number")
            return const(result)
    return intern_node("pow", (a, b))


def make(op: str, args: tuple[Expr, ...], value: Any = None) -> Expr:
    """A node of any operator, simplified where the operator's constructor does so."""
    if op in _CONSTRUCTORS:
        return _CONSTRUCTORS[op](*args)
    if op == "where":
        condition, a, b = args
        if condition.op == "const":
            return a if condition.value else b
        if a is b:
            return a
    elif value is None and args and all(a.op == "const" for a in args):
        folded = _fold(op, args)
        if folded is not None:
            return folded
    return intern_node(op, args, value)


_CONSTRUCTORS: Final = {"add": add, "neg": neg, "mul": mul, "div": div, "pow": power}


def _fold(op: str, args: tuple[Expr, ...]) -> Expr | None:
    from .operators import OPERATORS

    row = OPERATORS.get(op)
    if row is None or row.scalar is None:
        return None
    try:
        return const(float(row.scalar(*(a.value for a in args))))
    except (ValueError, OverflowError):
        return None


def total(terms: Iterable[Expr]) -> Expr:
    """Sum of many terms, built once (`sum` would build every partial sum)."""
    return add(*terms)


PI: Final = const(math.pi)
