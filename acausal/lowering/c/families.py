"""C of large systems: a function for each kind of block, loops over index rows; the text does not grow with the model.

Derivatives are tangents of these functions: the Jacobian by compressed sweeps (Curtis, Powell and Reid 1974), the
directions of sensitivities and their second derivatives by tangents of tangents.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...dae.coloring import color_columns
from ...language.flat_model import Family
from ...language.template import Ints
from ...passes.schedule import Group, Kernel
from ...symbolic.differentiate import differentiate
from ...symbolic.expr import ZERO, Expr, add, mul, neg, par, var
from ...symbolic.traverse import substitute
from ..hybrid import Roots
from ..lowered import Lowered, is_wide
from ..repetition import Repetition
from .emit import Writer
from .factor import Factorisation
from .straight import Straight, reduce_strength
from .text import braces

RATE = 1 << 20
"""Parameter number from which a leaf stands for the rate of an input; `RATE - 1` for that of time."""


@dataclass(eq=False)
class Tables:
    """Index rows that the compiled code is given when it runs."""

    arrays: list[NDArray[np.int32]] = field(default_factory=list[Any])

    def add(self, values: Any) -> str:
        """C text of a further table."""
        self.arrays.append(np.ascontiguousarray(values, np.int32).ravel())
        return f"m->index[{len(self.arrays) - 1}]"


@dataclass(eq=False)
class _Kernel:
    """One kind of block, written out over its slots.

    Attributes:
        outputs: (slot, expression) of its unknowns; residuals of an iterating block.
        lifted: the same of their derivatives along one direction.
    """

    straight: Straight
    slots: int
    outputs: list[tuple[int, Expr]]
    residuals: list[Expr]
    lifted: list[tuple[int, Expr]]
    lifted_residuals: list[Expr]


def write_kernel(kernel: Kernel, slots: int, driven: frozenset[int]) -> _Kernel:
    """Expressions of a block over its slots, and their derivatives along a direction whose slots follow the first.

    Args:
        kernel: how the block is solved.
        slots: number of its variables.
        driven: parameter slots that are inputs: they have rates.
    """
    straight = Straight(2 * slots, {}, [])
    names: dict[Expr, Expr] = {}
    outputs: list[tuple[int, Expr]] = []
    if kernel.matrix:
        matrix = tuple(tuple(reduce_strength(line)) for line in kernel.matrix)
        leaves = straight.add_solve(0, matrix, tuple(reduce_strength(kernel.rhs)))
        for u, leaf in zip(kernel.tears, leaves, strict=True):
            names[var(u)] = leaf
            outputs.append((u, leaf))
    memo: dict[int, Expr] = {}
    alive: list[Expr] = []  # what `memo` knows by identity
    for u, expression in kernel.steps:
        alive.append(substitute(expression, names))
        names[var(u)] = reduce_strength(alive[-1:], memo)[0]
        outputs.append((u, names[var(u)]))
    residuals = reduce_strength(substitute(r, names) for r in kernel.residuals)
    moved: dict[int, Expr] = {}

    def direction(leaf: Expr) -> Expr:
        if leaf.op == "time":
            return par(RATE - 1)
        if leaf.op == "par":
            return mul(par(RATE - 1), par(RATE + leaf.value)) if leaf.value in driven else ZERO
        return moved.get(leaf.value, ZERO) if leaf.value >= 2 * slots else var(leaf.value + slots)

    if kernel.matrix:
        _lift_solve(straight, direction, moved)
    roots = [e for _, e in outputs] + residuals
    lifted = reduce_strength(differentiate(roots, direction))
    n = len(outputs)
    return _Kernel(
        straight, slots, outputs, residuals,
        [(u, e) for (u, _), e in zip(outputs, lifted[:n], strict=True)], lifted[n:],
    )  # fmt: skip


def _lift_solve(straight: Straight, direction: Callable[[Expr], Expr], moved: dict[int, Expr]) -> None:
    """The derivative of the solution of a linear system: the same matrix with another right-hand side."""
    solve = straight.solves[0]
    m = len(solve.rhs)
    d = differentiate([*(e for line in solve.matrix for e in line), *solve.rhs], direction)
    rhs = tuple(add(d[m * m + i], *(neg(mul(d[m * i + j], solve.targets[j])) for j in range(m))) for i in range(m))
    for target, leaf in zip(solve.targets, straight.add_solve(0, (), tuple(reduce_strength(rhs))), strict=True):
        moved[target.value] = leaf


class Families:
    """C functions of a large system.

    Args:
        lowered: the system.
        n_par, n_inputs: parameters, and inputs after them.
    """

    def __init__(self, lowered: Lowered, n_par: int, n_inputs: int) -> None:
        self.lowered = lowered
        self.n_par, self.n_inputs = n_par, n_inputs
        self.tables = Tables()
        self.kernels: dict[tuple[int, frozenset[int]], int] = {}
        self.written: list[_Kernel] = []
        self.pattern = lowered.sparsity().tocsr()
        self.pattern.sort_indices()
        self.color = np.asarray(color_columns(self.pattern), np.int64)

    def _inputs_among(self, par_rows: Ints) -> frozenset[int]:
        """Parameter slots that are inputs in some row."""
        inside = (par_rows >= self.n_par) & (par_rows < self.n_par + self.n_inputs)
        return frozenset(np.flatnonzero(inside.any(axis=0)).tolist()) if par_rows.size else frozenset[int]()

    # ---- kernels ------------------------------------------------------------------------------------------------
    def _kernel(self, group: Group, par_rows: Ints) -> int:
        """Number of the kernel of a group."""
        driven = self._inputs_among(par_rows)
        key = (id(group.kernel), driven)
        if key not in self.kernels:
            self.kernels[key] = len(self.written)
            self.written.append(write_kernel(group.kernel, group.var_rows.shape[1], driven))
        return self.kernels[key]

    def kernel_functions(self, tangents: bool) -> list[str]:
        """The functions of all kernels: values; or with tangents along directions, and those of the lifted ones."""
        out: list[str] = []
        for k, kernel in enumerate(self.written):
            if tangents:
                out += [self._along(k, kernel), self._second(k, kernel)]
            else:
                out += [self._values(k, kernel), self._sweep(k, kernel)]
        return out

    def _values(self, k: int, kernel: _Kernel) -> str:
        outputs = [(f"v[r[{u}]]", e) for u, e in kernel.outputs] + [
            (f"res[{i}]", e) for i, e in enumerate(kernel.residuals)
        ]
        writer = Writer(kernel.straight, _leaf(kernel.slots))
        return braces(f"static inline void ac_k{k}({_ARGUMENTS}, double *res)", writer.function(outputs))

    def _sweep(self, k: int, kernel: _Kernel) -> str:
        """Tangents with respect to unknowns and time."""
        return self._tangent(f"ac_k{k}_sweep", kernel, constant=True)

    def _along(self, k: int, kernel: _Kernel) -> str:
        """Tangents with respect to unknowns and parameters."""
        return self._tangent(f"ac_k{k}_along", kernel, constant=False)

    def _tangent(self, name: str, kernel: _Kernel, *, constant: bool) -> str:
        outputs = [(f"dv[r[{u}]]", e) for u, e in kernel.outputs] + [
            (f"dres[{i}]", e) for i, e in enumerate(kernel.residuals)
        ]

        tangent = _tangent_leaf(lambda slot: constant and not self._driven(kernel, slot))
        writer = Writer(kernel.straight, _leaf(kernel.slots), tangent)
        head = f"static inline void {name}({_ARGUMENTS}, {_TANGENTS})"
        return braces(head, writer.function((), outputs))

    def _driven(self, kernel: _Kernel, slot: int) -> bool:
        numbers = {n: key[1] for key, n in self.kernels.items()}
        return slot in numbers[next(n for n, w in enumerate(self.written) if w is kernel)]

    def _second(self, k: int, kernel: _Kernel) -> str:
        """Derivatives along a direction, and the tangents of these."""
        values = [(f"va[r[{u}]]", e) for u, e in kernel.lifted]
        tangents = [(f"dva[r[{u}]]", e) for u, e in kernel.lifted]
        tangents += [(f"dres[{i}]", e) for i, e in enumerate(kernel.lifted_residuals)]

        def tangent(leaf: Expr) -> str | None:
            if leaf.op == "time":
                return None
            if leaf.op == "par":
                return None if leaf.value >= RATE - 1 else f"dp[q[{leaf.value}]]"
            j = leaf.value
            return f"dv[r[{j}]]" if j < kernel.slots else f"dva[r[{j - kernel.slots}]]"

        writer = Writer(kernel.straight, _leaf(kernel.slots), tangent)
        head = f"static inline void ac_k{k}_second({_ARGUMENTS}, {_SECOND})"
        return braces(head, writer.function(values, tangents))

    def switches(self, roots: list[Family], begin: list[str]) -> str:
        """The functions whose change of sign is an event."""
        return braces(f"AC_UNUSED static void ac_roots({_AT}, double *g)", self._expressions(roots, begin, "values"))

    def constraints(self, begin: list[str], d_begin: list[str]) -> tuple[str, str, str]:
        """The retained constraints, and their tangents: of `sweep` and `along`."""
        families = self.lowered.schedule.invariants
        head = f"{_AT_Z}, const ac_vector *dz, ac_vector *dg"
        sweep = ["ac_vector *dp = m->dpi; ac_feed_rates(m, dt);", *self._expressions(families, d_begin, "sweep")]
        along = ["const ac_vector *dp = m->dp;", *self._expressions(families, d_begin, "along")]
        return (
            braces(f"static void ac_constraints({_AT}, double *g)", self._expressions(families, begin, "values")),
            braces(f"static void ac_constraints_sweep({head})", [_STANDS_STILL, *sweep]),
            braces(f"static void ac_constraints_along({head})", [_STANDS_STILL, *along]),
        )

    def _expressions(self, families: list[Family], begin: list[str], kind: str) -> list[str]:
        """Statements ``g[i] = residual``, or for tangents ``dg[i] = ...``, with all that is needed before."""
        ids = np.concatenate([np.zeros(0, np.int64), *(f.var_rows.ravel() for f in families)])
        loops = self.loops(self.lowered.closure(ids, residuals=False))
        values = kind == "values"
        lines = [*begin, "double *f = m->f;" if values else "ac_vector *df = m->swept;", *_lines(loops, kind)]
        first = 0
        for family in families:
            residual = reduce_strength((family.residual,))[0]
            driven = self._inputs_among(family.par_rows)
            tangent = None if values else _tangent_leaf(lambda slot, d=driven: kind == "sweep" and slot not in d)
            writer = Writer(Straight(0, {}, []), _leaf(family.var_rows.shape[1]), tangent)
            rows, pars = self.tables.add(family.var_rows), self.tables.add(family.par_rows)
            step = f"r += {family.var_rows.shape[1]}, q += {family.par_rows.shape[1]}"
            put = [(f"{'g' if values else 'dg'}[{first} + i]", residual)]
            lines.append("{")
            lines.append(f"    const int *r = {rows}, *q = {pars};")
            lines.append(f"    for (long i = 0; i < {family.size}; i++, {step}) {{")
            lines += ["        " + line for line in (writer.function(put) if values else writer.function((), put))]
            lines += ["    }", "    (void)r; (void)q;", "}"]
            first += family.size
        unused = "(void)f; (void)g;" if values else "(void)df; (void)dt; (void)dp; (void)dg;"
        return [*lines, f"(void)t; (void)p; (void)v; {unused}"]

    # ---- loops --------------------------------------------------------------------------------------------------
    def loops(self, groups: list[int]) -> list[_Loop]:
        """What is evaluated, in order."""
        low = self.lowered
        starts: dict[int, int] = {}
        offset = low.n_x
        for group in low.schedule.groups:
            starts[id(group)] = offset
            offset += group.size * len(group.kernel.tears) if group.kernel.iterates else 0
        out: list[_Loop] = []
        for item in low._plan(tuple(groups)):
            if isinstance(item, Repetition):
                inner = [self._loop(period, item.groups, j) for j, period in enumerate(item.groups[0])]
                out.append(_Loop(len(item.groups), inner=inner))
            elif is_wide(item):
                out.append(self._wide(item))
            else:
                out.append(self._loop(item, None, 0, starts[id(item)]))
        return out

    def _loop(self, group: Group, periods: list[list[Group]] | None, j: int, first: int = 0) -> _Loop:
        rows = group.var_rows if periods is None else np.concatenate([p[j].var_rows for p in periods])
        pars = group.par_rows if periods is None else np.concatenate([p[j].par_rows for p in periods])
        k = self._kernel(group, pars)
        return _Loop(
            group.size, kernel=k, rows=self.tables.add(rows), pars=self.tables.add(pars), columns=rows.shape[1],
            par_columns=pars.shape[1], residuals=len(group.kernel.residuals), first=first,
        )  # fmt: skip

    def _wide(self, group: Group) -> _Loop:
        index, expression = group.kernel.steps[0]
        slots = [(a.args[0].value, -1) if a.op == "neg" else (a.value, 1) for a in expression.args]
        signs = self.tables.add([s for _, s in slots])
        rows = self.tables.add(np.column_stack([group.var_rows[:, index], group.var_rows[:, [s for s, _ in slots]]]))
        return _Loop(group.size, rows=rows, pars=signs, columns=len(slots) + 1)


_AT_Z = "const ac_model *m, double t"
_AT = f"{_AT_Z}, const double *z"
_STANDS_STILL = "const ac_vector dt = ac_zero;"
_ARGUMENTS = "double t, double *restrict v, const double *p, const int *r, const int *q"
_TANGENTS = "ac_vector dt, ac_vector *restrict dv, const ac_vector *dp, ac_vector *dres"
_SECOND = (
    "double ta, const double *pa, double *restrict va, ac_vector *restrict dv, ac_vector *restrict dva, "
    "const ac_vector *dp, ac_vector *dres"
)


def _leaf(slots: int) -> Callable[[Expr], str]:
    def text(node: Expr) -> str:
        if node.op == "time":
            return "t"
        if node.op == "par":
            if node.value >= RATE:
                return f"pa[q[{node.value - RATE}]]"
            return "ta" if node.value == RATE - 1 else f"p[q[{node.value}]]"
        return f"v[r[{node.value}]]" if node.value < slots else f"va[r[{node.value - slots}]]"

    return text


def _tangent_leaf(still: Callable[[int], bool]) -> Callable[[Expr], str | None]:
    """Tangents of leaves; parameter slots for which `still` holds do not move."""

    def text(leaf: Expr) -> str | None:
        if leaf.op == "time":
            return "dt"
        if leaf.op == "par":
            return None if still(leaf.value) else f"dp[q[{leaf.value}]]"
        return f"dv[r[{leaf.value}]]"

    return text


@dataclass(eq=False)
class _Loop:
    """Rows of one kernel, a sum over many variables (no kernel), or a chain of loops that is repeated."""

    count: int
    kernel: int = -1
    rows: str = ""
    pars: str = ""
    columns: int = 0
    par_columns: int = 0
    residuals: int = 0
    first: int = 0
    inner: list[_Loop] | None = None

    def lines(self, kind: str) -> list[str]:
        """C of the loop; `kind` is what is computed: ``values``, ``sweep``, ``along`` or ``second``."""
        if self.inner is not None:
            return self._chain(kind)
        if self.kernel < 0:
            return self._sum(kind)
        return ["{", *("    " + line for line in self._body(kind, self.rows, self.pars)), "}"]

    def _body(self, kind: str, rows: str, pars: str) -> list[str]:
        name = f"ac_k{self.kernel}" + ("" if kind == "values" else f"_{kind}")
        out = f"f + {self.first} + i * {self.residuals}" if self.residuals else "NULL"
        d_out = f"df + {self.first} + i * {self.residuals}" if self.residuals else "NULL"
        more = {
            "values": out, "sweep": f"dt, dv, dp, {d_out}", "along": f"dt, dv, dp, {d_out}",
            "second": f"ta, pa, va, dv, dva, dp, {d_out}",
        }[kind]  # fmt: skip
        step = f"r += {self.columns}, q += {self.par_columns}"
        return [
            f"const int *r = {rows}, *q = {pars};",
            f"for (long i = 0; i < {self.count}; i++, {step}) {name}(t, v, p, r, q, {more});",
        ]

    def _chain(self, kind: str) -> list[str]:
        assert self.inner is not None
        lines = [f"for (long n = 0; n < {self.count}; n++) {{"]
        for loop in self.inner:
            rows = f"{loop.rows} + n * {loop.count * loop.columns}"
            pars = f"{loop.pars} + n * {loop.count * loop.par_columns}"
            lines += ["    {", *("        " + line for line in loop._body(kind, rows, pars)), "    }"]
        return [*lines, "}"]

    def _sum(self, kind: str) -> list[str]:
        pairs = {
            "values": [("v", "double", "0.0")], "sweep": [("dv", "ac_vector", "ac_zero")],
            "along": [("dv", "ac_vector", "ac_zero")],
            "second": [("va", "double", "0.0"), ("dva", "ac_vector", "ac_zero")],
        }[kind]  # fmt: skip
        lines = [f"for (long i = 0; i < {self.count}; i++) {{", f"    const int *r = {self.rows} + i * {self.columns};"]
        for name, of, zero in pairs:
            lines.append(f"    {of} sum_{name} = {zero};")
            lines.append(
                f"    for (int j = 1; j < {self.columns}; j++) sum_{name} += {self.pars}[j - 1] * {name}[r[j]];"
            )
            lines.append(f"    {name}[r[0]] = sum_{name};")
        return [*lines, "}"]


def functions(families: Families, roots: Roots | None = None) -> tuple[list[str], list[str]]:
    """The C functions, and those that are only needed for tangents."""
    low = families.lowered
    dx = families.loops(low._groups_dx)
    everything = families.loops(low.closure(np.flatnonzero(_computed(low)), residuals=True))
    known = families.tables.add(np.concatenate([low.schedule.states, low.schedule.tears]))
    slopes = families.tables.add(low.dx_ids)
    at = "const ac_model *m, double t, const double *z"
    begin = [
        "double *v = m->v; const double *p = m->p;",
        "ac_feed(m);",
        f"for (long i = 0; i < AC_N; i++) v[{known}[i]] = z[i];",
    ]
    gather = f"for (long i = 0; i < AC_NX; i++) f[i] = v[{slopes}[i]];"
    values = braces(
        f"static void ac_field({at}, double *f)", [*begin, *_lines(dx, "values"), gather, "(void)t; (void)p;"]
    )
    observe = braces(
        f"AC_UNUSED static void ac_observe({at}, double *all)",
        [*begin, "double *f = m->f;", *_lines(everything, "values"), "(void)f; (void)t; (void)p;",
         "memcpy(all, v, sizeof(double) * AC_NALL);"],
    )  # fmt: skip
    sweep_head = "const ac_model *m, double t, ac_vector dt, const ac_vector *dz, ac_vector *df"
    d_begin = [
        "double *v = m->v; const double *p = m->p; ac_vector *dv = m->dv;",
        f"for (long i = 0; i < AC_N; i++) dv[{known}[i]] = dz[i];",
    ]
    d_gather = f"for (long i = 0; i < AC_NX; i++) df[i] = dv[{slopes}[i]];"
    unused = "(void)t; (void)dt; (void)p; (void)v; (void)dp;"
    sweep = braces(
        f"static void ac_sweep({sweep_head})",
        [*d_begin, "ac_vector *dp = m->dpi; ac_feed_rates(m, dt);", *_lines(dx, "sweep"), d_gather, unused],
    )
    along = braces(
        f"static void ac_along({sweep_head})",
        [*d_begin, "const ac_vector *dp = m->dp;", *_lines(dx, "along"), d_gather, unused],
    )
    second = braces(
        "static void ac_second("
        "const ac_model *m, double t, double ta, const double *za, const ac_vector *dz, ac_vector *df)",
        ["double *v = m->v, *va = m->va; const double *p = m->p, *pa = m->pa;",
         "ac_vector *dv = m->dv, *dva = m->dva; const ac_vector *dp = m->dp;",
         f"for (long i = 0; i < AC_N; i++) {{ const int k = {known}[i];",
         "va[k] = za[i]; dv[k] = dz[i]; dva[k] = ac_zero; }",
         *_lines(dx, "second"),
         f"for (long i = 0; i < AC_NX; i++) df[i] = dva[{slopes}[i]];",
         "(void)t; (void)ta; (void)p; (void)pa; (void)v; (void)dp;"],
    )  # fmt: skip
    switches = families.switches(roots.families if roots is not None else [], begin)
    own, moving = [values, observe, sweep, switches], [along, second]
    if low.n_g:
        constraints = families.constraints(begin, d_begin)
        own += constraints[:2]
        moving.append(constraints[2])
    return [*families.kernel_functions(False), *own], [*families.kernel_functions(True), *moving]


def _computed(low: Lowered) -> Any:
    computed = np.zeros(low.n_ids, bool)
    for group in low.schedule.groups:
        computed[group.unknowns] = True
    return computed


def _lines(loops: Iterable[_Loop], kind: str) -> list[str]:
    return [line for loop in loops for line in loop.lines(kind)]


def factor_tables(plan: Factorisation, tables: Tables) -> list[str]:
    """Definitions that give the runtime the pattern of the factors."""
    named = {
        "AC_LU_PTR": plan.indptr, "AC_LU_COL": plan.indices, "AC_LU_ENTRY": plan.entry, "AC_LU_MASS": plan.on_mass,
        "AC_LU_DIAGONAL": plan.diagonal, "AC_LU_ROWS": plan.rows, "AC_LU_COLUMNS": plan.columns,
    }  # fmt: skip
    return [f"#define {name}(m) ({tables.add(values).replace('m->', '(m)->')})" for name, values in named.items()]
