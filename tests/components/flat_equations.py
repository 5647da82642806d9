"""The flat equations of a model, as they are written, in CasADi: before any pass of the compiler but flattening.

Nothing is eliminated, sorted, differentiated or torn here, but a variable that an equation sets to zero is zero
wherever it stands: point gravity that is switched off would be 0/0 in the centre of the world. What changes at events
only (conditions, `pre`, `floor`) is a *mode*, a symbol that an integrator holds; `FlatEquations.modes` says what each
must be.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from acausal import Component
from acausal.language.blackbox import Table
from acausal.language.flat_model import Family, FlatModel
from acausal.language.flatten import flatten
from acausal.lowering.parameters import ParameterProgram
from acausal.symbolic.expr import Expr
from acausal.symbolic.traverse import apply, postorder
from benchmarks.peers.casadi_system import Functions

Floats = NDArray[np.float64]
COMPARISONS = {"lt": (1, True), "le": (1, False), "gt": (-1, True), "ge": (-1, False)}
"""Sign that makes ``a - b`` negative where the comparison holds, and whether it is strict."""


@dataclass(frozen=True)
class Mode:
    """Something that events alone change.

    Attributes:
        kind: ``relation``, ``equal``, ``floor``, ``pre``, ``sample``, ``triggered``, ``initial`` or ``terminal``.
        value: of a relation ``a - b`` with the sign that makes it negative where the relation holds; of the others what
            they are of.
        strict: of a relation.
    """

    kind: str
    value: Any
    strict: bool = False

    def now(self, subject: Floats) -> float:
        """Its value between events; where nothing happens, nothing is triggered."""
        x = float(subject[0])
        if self.kind == "relation":
            return float(x < 0 or (x == 0 and not self.strict))
        if self.kind == "equal":
            return float(x == 0)
        return float(np.floor(x)) if self.kind == "floor" else x if self.kind == "pre" else 0.0


class FlatEquations:
    """Scalar equations ``residual(t, v, m) = 0``, one for each unknown.

    Attributes:
        flat: the flat model.
        t, v, m: symbols of time, of all variables (derivatives are variables of their own), and of the modes.
        residual: as many as there are variables, less the derivatives.
        modes: what each element of `m` stands for.
        places: component and source line of each equation.
    """

    def __init__(self, model: Component) -> None:
        self.flat: FlatModel = flatten(model)
        self.parameters = ParameterProgram(self.flat).default
        self.t, self.v = ca.SX.sym("t"), ca.SX.sym("v", self.flat.n_total)
        self.modes: list[Mode] = []
        self._symbols: list[Any] = []
        flat = self.flat
        zeros = {int(f.var_rows[row, 0]) for f in flat.families if f.residual.op == "var" for row in range(f.size)}
        self._leaves = [ca.SX(0) if i in zeros else leaf for i, leaf in enumerate(ca.vertsplit(self.v))]
        rows: list[tuple[Any, Any]] = []
        self.places: list[str] = []
        for family in flat.families:
            for row in range(family.size):
                alone = family.residual.op == "var"
                v = self.v[int(family.var_rows[row, 0])] if alone else None
                rows.append((v, ca.fabs(v)) if alone else self._row(family, row))
                self.places.append(f"{flat.equation_text(family, row)} {flat.equation_place(family, row)}")
        for a, b, sign in zip(flat.alias_a, flat.alias_b, flat.alias_sign, strict=True):
            x, y = self._leaves[a], self._leaves[b]
            rows.append((x - int(sign) * y, ca.fabs(x) + ca.fabs(y)))
            self.places.append(f"connection of {flat.name(int(a))} and {flat.name(int(b))}")
        for a in flat.zero:
            rows.append((self._leaves[a], ca.fabs(self._leaves[a])))
            self.places.append(f"flow {flat.name(int(a))} of a connector that is not connected")
        self.residual = ca.vertcat(*(residual for residual, _ in rows))
        self.sizes = ca.vertcat(*(size for _, size in rows))
        self.m = ca.vertcat(ca.SX(0, 1), *self._symbols)

    @cached_property
    def names(self) -> list[str]:
        """Of all variables, derivatives included."""
        declared = self.flat.names.all_variables
        return [*declared, *(self.flat.name(i) for i in range(self.flat.n_var, self.flat.n_total))]

    @cached_property
    def states(self) -> Any:
        """Numbers of the variables of which a derivative occurs."""
        return np.flatnonzero(self.flat.derivative_of >= 0)

    def _row(self, family: Family, row: int) -> tuple[Any, Any]:
        """Residual of one equation, and the sum of the sizes of its terms."""
        form = family.residual
        values: dict[tuple[int, bool], Any] = {}
        sizes: dict[int, Any] = {}

        def value(node: Expr, held: bool) -> Any:
            key = id(node), held
            if key not in values:
                args = [value(a, held and node.op != "noevent") for a in node.args]
                leaf = not args and node.op != "call"
                values[key] = self._leaf(node, family, row) if leaf else self._operation(node, args, held)
            return values[key]

        residual = value(form, True)
        for node in postorder((form,)):
            if (id(node), True) in values:
                below = [sizes.get(id(a)) for a in node.args]
                sizes[id(node)] = _size(node.op, below, ca.fabs(values[id(node), True]))
        return residual, sizes[id(form)]

    def _leaf(self, node: Expr, family: Family, row: int) -> Any:
        if node.op == "const":
            return ca.SX(node.value)
        if node.op == "time":
            return self.t
        if node.op == "var":
            return self._leaves[int(family.var_rows[row, node.value])]
        if node.op == "par":
            return ca.SX(float(self.parameters[family.par_rows[row, node.value]]))
        return self._mode(node.op, ca.SX(0))

    def _operation(self, node: Expr, args: list[Any], held: bool) -> Any:
        op = node.op
        if op in ("pre", "triggered", "sample"):
            return self._mode(op, ca.vertcat(*args))
        if op == "noevent":
            return args[0]
        if op == "call":
            return _table(node.value, *args)
        if not held:
            return apply(node, args, Functions)
        if op in COMPARISONS:
            sign, strict = COMPARISONS[op]
            return self._mode("relation", sign * (args[0] - args[1]), strict)
        if op == "eq":
            return self._mode("equal", args[0] - args[1])
        if op == "sign":
            return self._mode("relation", -args[0], True) - self._mode("relation", args[0], True)
        if op == "floor":
            return self._mode("floor", args[0])
        if op == "ceil":
            return -self._mode("floor", -args[0])
        if op == "mod":
            return args[0] - args[1] * self._mode("floor", args[0] / args[1])
        return apply(node, args, Functions)

    def _mode(self, kind: str, value: Any, strict: bool = False) -> Any:
        symbol = ca.SX.sym(f"m{len(self.modes)}")
        self.modes.append(Mode(kind, value, strict))
        self._symbols.append(symbol)
        return symbol

    @cached_property
    def evaluate(self) -> Any:
        """CasADi function of (t, v, m): residuals, sizes of their terms, and the values of the modes' subjects.

        What a mode is of has one row for each of its arguments.
        """
        subjects = ca.vertcat(ca.SX(0, 1), *(mode.value for mode in self.modes))
        return ca.Function("flat", [self.t, self.v, self.m], [self.residual, self.sizes, subjects])


    def settled(self, t: float, v: Floats) -> Floats:
        """The modes at a point: what each stands for, with `pre` and `triggered` as they are between events.

        Args:
            t: time [s].
            v: all variables (n_total,).
        """
        modes = np.zeros(len(self.modes))
        while True:
            subjects = self.subjects(t, v, modes)
            new = np.array([mode.now(x) for mode, x in zip(self.modes, subjects, strict=True)])
            if (new == modes).all():
                return modes
            modes = new

    def subjects(self, t: float, v: Floats, modes: Floats) -> list[Floats]:
        """What the modes are of, at a point, each with its arguments."""
        values = self.evaluate(t, v, modes)[2].full().ravel()
        ends = np.cumsum([mode.value.numel() for mode in self.modes])
        return np.split(values, ends)[:-1]


def _size(op: str, below: list[Any], value: Any) -> Any:
    """Size of the terms that a value is made of: large where they cancel."""
    if op == "add":
        return sum(below)
    if op == "neg":
        return below[0]
    if op == "mul":
        return below[0] * below[1]
    return value


def _table(function: Any, x: Any) -> Any:
    """Piecewise linear interpolation, constant outside."""
    if not isinstance(function, Table) or function.order:
        raise NotImplementedError(f"`{function.name}` is a JAX function, and CasADi has no expression for it")
    slopes = np.diff(function.y) / np.diff(function.x)
    parts = (
        slope * ca.fmin(ca.fmax(x - a, 0.0), b - a)
        for slope, a, b in zip(slopes, function.x[:-1], function.x[1:], strict=True)
    )
    return function.y[0] + sum(parts)
