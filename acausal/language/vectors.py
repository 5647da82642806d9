"""Vectors and matrices of scalar quantities: fields ``r_0[1]``, ``r_0[2]``, ``r_0[3]`` that are written as one.

Names count from one, as in Modelica; Python's indices count from zero, as everywhere in Python. In equations a vector
is no more than its elements: the compiler sees scalars.
"""

from __future__ import annotations

import copy
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NoReturn, Self, cast, overload

from ..errors import DeclarationError
from ..symbolic.equation import Equation
from ..symbolic.expr import Expr, Operand, add, as_expr, make, symbol
from .declarations import Declaration, Kind, Start
from .instance import call_site, path_text

Elements = Sequence["Operand | Declaration"]
"""Numbers, expressions or declarations, one an element."""


@dataclass(frozen=True, slots=True, eq=False)
class VectorEquation:
    """One equation for each element, made by ``a == b`` of vectors or matrices."""

    equations: tuple[Equation, ...]

    def __bool__(self) -> NoReturn:
        raise TypeError(
            "an equation between vectors is neither true nor false: yield it from equations(); conditions are written "
            "for the elements"
        )


class ElementError(DeclarationError, IndexError):
    """An element that a vector does not have."""


class Quantities:
    """What `Vector` and `Matrix` share: a field that stands for several declarations.

    Attributes:
        elements: declarations (of a class body) or expressions, row by row.
        depth: how deep its values are nested.
    """

    elements: tuple[Any, ...]
    depth: int = 1
    __array_ufunc__ = None  # numbers of numpy leave the operation to us
    __acausal_elements__ = True  # and so do scalar expressions that stand on the left
    name: str = ""

    def _declare(self, element: Declaration, values: Any, size: int) -> None:
        if not isinstance(element, Declaration):
            raise DeclarationError(
                f"{type(self).__name__}({element!r}): the first argument declares one element, as in "
                f'`Vector(Parameter(unit="m"))`; a vector of expressions is made by `vector(a, b, c)`'
            )
        self.elements = tuple(copy.copy(element) for _ in range(size))
        if values is None:
            return
        for declaration, value in zip(self.elements, self._flat(values), strict=True):
            if declaration.kind == Kind.PARAMETER:
                declaration.default = value
            else:
                declaration.start = value

    def _flat(self, values: Any) -> tuple[Any, ...]:
        """Elements of something that is to fit this one."""
        raise NotImplementedError

    def labels(self) -> Iterator[str]:
        """Index of every element, as it stands in names."""
        raise NotImplementedError

    def names(self) -> list[str]:
        """Names of the elements in their class."""
        return [f"{self.name}[{label}]" for label in self.labels()]

    def __set_name__(self, owner: type[Any], name: str) -> None:
        if self.name or not all(isinstance(e, Declaration) for e in self.elements):
            return
        self.name = name
        for declaration, full in zip(self.elements, self.names(), strict=True):
            declaration.name, declaration.owner = full, owner

    @overload
    def __get__(self, instance: None, owner: type[Any]) -> Self: ...
    @overload
    def __get__(self, instance: object, owner: type[Any]) -> Self: ...
    def __get__(self, instance: Any, owner: type[Any]) -> Self:
        if instance is None:
            return self
        path = instance.__dict__["_path"]
        made = self._like(tuple(symbol((*path, name)) for name in self.names()))
        made.__dict__["path"] = (*path, self.name)
        return made

    def __set__(self, instance: object, value: Any) -> None:
        raise DeclarationError(
            f"`{type(instance).__name__}.{self.name}` cannot be assigned: give it when the component is constructed, "
            f"or write an equation, `yield self.{self.name} == ...`"
        )

    def _like(self, elements: tuple[Any, ...]) -> Self:
        made = object.__new__(type(self))
        made.__dict__.update({k: v for k, v in self.__dict__.items() if k not in ("name", "path")})
        made.elements = elements
        return made

    def modifications(self, value: Any) -> dict[str, Any]:
        """What a modification of the whole gives to each element.

        Raises:
            DeclarationError: the value does not have as many elements.
        """
        if isinstance(value, Start):
            given = [None] * len(self.elements) if value.value is None else self._flat(value.value)
            items: Any = [Start(v, value.fixed, value.nominal, value.state_select) for v in given]
        else:
            items = self._flat(value)
        return dict(zip(self.names(), items, strict=True))

    def __add__(self, other: Self | Elements) -> Self:
        return self._like(tuple(add(as_expr(a), as_expr(b)) for a, b in self._pairs(other)))

    def __radd__(self, other: Elements) -> Self:
        return self + other

    def __sub__(self, other: Self | Elements) -> Self:
        return self._like(tuple(as_expr(a) - as_expr(b) for a, b in self._pairs(other)))

    def __rsub__(self, other: Elements) -> Self:
        return -self + other

    def __neg__(self) -> Self:
        return self._like(tuple(-as_expr(a) for a in self.elements))

    def __mul__(self, factor: Operand | Declaration) -> Self:
        return self._like(tuple(as_expr(a) * as_expr(factor) for a in self.elements))

    def __rmul__(self, factor: Operand | Declaration) -> Self:
        return self._like(tuple(as_expr(factor) * as_expr(a) for a in self.elements))

    def __truediv__(self, divisor: Operand | Declaration) -> Self:
        return self._like(tuple(as_expr(a) / as_expr(divisor) for a in self.elements))

    def __eq__(self, other: Self | Elements) -> VectorEquation:  # type: ignore[override]
        return VectorEquation(tuple(as_expr(a) == as_expr(b) for a, b in self._pairs(other)))

    def __ne__(self, other: object) -> NoReturn:
        raise TypeError("`!=` between vectors has no meaning in a model: write an equation with `==`")

    __hash__ = None  # type: ignore[assignment]

    def _pairs(self, other: Any) -> Iterator[tuple[Any, Any]]:
        return zip(self.elements, self._flat(other), strict=True)


class Vector(Quantities):
    """A vector of scalar quantities: ``r_0: Vector = Vector(Potential(unit="m", doc="position"))``.

    Args:
        element: the declaration that is repeated (`Variable`, `Parameter`, `Potential`, `Flow`, ...).
        values: default of a parameter or start values of a variable, one an element; a vector expression of parameters
            makes dependent parameters.
        size: number of elements, or the name of the structural parameter or property of the class that is that number;
            `values` is then another vector of the same size, or None. By default the number of values, 3 without.
    """

    def __init__(
        self, element: Declaration, values: Vector | Elements | None = None, *, size: int | str | None = None
    ) -> None:
        if size is None and isinstance(values, Vector):
            size = values.size
        elif size is None:
            size = 3 if values is None else len(_items(values, "a vector"))
        self.size, self.element, self.values = size, element, values
        if isinstance(size, int):
            self._declare(element, values, size)
            return
        if values is not None and (not isinstance(values, Vector) or values.size != size):
            raise DeclarationError(
                f"Vector(..., {values!r}, size={size!r}): the values of a vector with a structural size are those of "
                f"another vector of that size; a value for all elements is given to the element"
            )
        self._declare(element, None, 0)

    def resized(self, owner: type[Any], length: int) -> Vector:
        """This field of `owner` with `length` elements; other vectors of the same size have theirs already."""
        values = self.values
        if isinstance(values, Vector):
            values = owner._vectors[values.name]
        made = Vector(self.element, values, size=length)
        made.size, made.values = self.size, self.values
        made.__set_name__(owner, self.name)
        return made

    def labels(self) -> Iterator[str]:
        """``1``, ``2``, ``3``."""
        return (str(i + 1) for i in range(len(self.elements)))

    def _flat(self, values: Any) -> tuple[Any, ...]:
        items = _items(values, "a vector")
        if len(items) != len(self.elements):
            where = f"`{self.name}`" if self.name else "a vector"
            raise DeclarationError(f"{where} has {len(self.elements)} elements, not {len(items)}: {items!r}")
        return items

    def __len__(self) -> int:
        return len(self.elements)

    def __getitem__(self, index: int) -> Expr:
        try:
            return as_expr(self.elements[index])
        except IndexError:
            text = path_text(self.__dict__["path"]) if "path" in self.__dict__ else self.name or "the vector"
            n = len(self.elements)
            have = f"{n} elements, [0] to [{n - 1}]" if n > 1 else f"{n or 'no'} element{'' if n else 's'}"
            raise ElementError(f"`{text}` has {have}: there is no [{index}] {call_site()}".rstrip()) from None

    def __iter__(self) -> Iterator[Expr]:
        return (as_expr(e) for e in self.elements)

    def __set__(self, instance: object, value: Vector | Elements | Start) -> None:
        super().__set__(instance, value)

    def __repr__(self) -> str:
        return f"vector({', '.join(str(e) for e in self.elements)})"


class Matrix(Quantities):
    """A matrix of scalar quantities: ``T: Matrix = Matrix(Potential(doc="transformation"))``, elements ``T[1,1]``, ...

    Args:
        element: the declaration that is repeated.
        values: default of a parameter or start values of a variable, a sequence of rows.
        shape: numbers of rows and columns; as the values have them, 3 and 3 without any.
    """

    depth = 2

    def __init__(self, element: Declaration, values: Any = None, *, shape: tuple[int, int] | None = None) -> None:
        if shape is None:
            shape = (3, 3) if values is None else _shape(values)
        self.shape = shape
        self._declare(element, values, shape[0] * shape[1])

    def labels(self) -> Iterator[str]:
        """``1,1``, ``1,2``, ..."""
        return (f"{i + 1},{j + 1}" for i in range(self.shape[0]) for j in range(self.shape[1]))

    def _flat(self, values: Any) -> tuple[Any, ...]:
        items = _rows(values)
        if len(items) != self.shape[0] or any(len(row) != self.shape[1] for row in items):
            where = f"`{self.name}`" if self.name else "a matrix"
            raise DeclarationError(f"{where} has {self.shape[0]} rows of {self.shape[1]} elements, not {items!r}")
        return tuple(e for row in items for e in row)

    def rows(self) -> list[Vector]:
        """The rows as vectors."""
        n = self.shape[1]
        return [vector(*self.elements[i * n : (i + 1) * n]) for i in range(self.shape[0])]

    @overload
    def __getitem__(self, index: int) -> Vector: ...
    @overload
    def __getitem__(self, index: tuple[int, int]) -> Expr: ...
    def __getitem__(self, index: int | tuple[int, int]) -> Vector | Expr:
        return self.rows()[index[0]][index[1]] if isinstance(index, tuple) else self.rows()[index]

    def transpose(self) -> Matrix:
        """Rows and columns exchanged."""
        return matrix(*([row[j] for row in self.rows()] for j in range(self.shape[1])))

    @overload
    def __matmul__(self, other: Vector) -> Vector: ...
    @overload
    def __matmul__(self, other: Matrix) -> Matrix: ...
    def __matmul__(self, other: Vector | Matrix) -> Vector | Matrix:
        if isinstance(other, Vector):
            return vector(*(dot(row, other) for row in self.rows()))
        columns = other.transpose().rows()
        return matrix(*([dot(row, column) for column in columns] for row in self.rows()))

    def __set__(self, instance: object, value: Any) -> None:
        super().__set__(instance, value)

    def __repr__(self) -> str:
        return f"matrix({', '.join(repr(row) for row in self.rows())})"


def _rows(values: Any) -> list[tuple[Any, ...]]:
    """The rows of a matrix or of a sequence of sequences."""
    rows = values.rows() if isinstance(values, Matrix) else _items(values, "a matrix")
    return [_items(row, "a row of a matrix") for row in rows]


def _shape(values: Any) -> tuple[int, int]:
    """Numbers of rows and columns of the values of a matrix."""
    rows = _rows(values)
    if not rows or any(len(row) != len(rows[0]) for row in rows):
        raise DeclarationError(f"a matrix has rows of the same length, not {rows!r}")
    return len(rows), len(rows[0])


def _items(values: Any, what: str) -> tuple[Any, ...]:
    if isinstance(values, Vector):
        return values.elements
    if hasattr(values, "tolist"):
        values = values.tolist()
    if not isinstance(values, (list, tuple)):
        raise DeclarationError(f"{what} takes a sequence with a value for each element, not {values!r}")
    return tuple(cast("Sequence[Any]", values))


def vector(*elements: Operand | Declaration) -> Vector:
    """A vector of expressions, numbers or declarations."""
    made = object.__new__(Vector)
    made.size, made.elements = len(elements), elements
    return made


def matrix(*rows: Vector | Elements) -> Matrix:
    """A matrix of rows."""
    items = [_items(row, "a row of a matrix") for row in rows]
    made = object.__new__(Matrix)
    made.shape = (len(items), len(items[0]))
    made.elements = tuple(e for row in items for e in row)
    return made


def dot(a: Vector | Elements, b: Vector | Elements) -> Expr:
    """Scalar product."""
    return add(*(as_expr(x) * as_expr(y) for x, y in zip(_items(a, "dot"), _items(b, "dot"), strict=True)))


def cross(a: Vector | Elements, b: Vector | Elements) -> Vector:
    """Vector product in three dimensions."""
    (x, y, z), (u, v, w) = ([as_expr(e) for e in _items(c, "cross")] for c in (a, b))
    return vector(y * w - z * v, z * u - x * w, x * v - y * u)


def norm(a: Vector | Elements) -> Expr:
    """Length, the square root of the sum of squares."""
    return make("sqrt", (dot(a, a),))
