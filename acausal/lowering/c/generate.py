"""C source of a system that is small enough to be written out: equations, derivatives, factors, in one file."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from importlib.resources import files
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ...errors import StructureError
from ...symbolic.expr import ZERO, Expr, par
from ...symbolic.jacobian import Row
from ...symbolic.traverse import substitute
from ..hybrid import Hybrid
from .emit import Hoisted, Writer
from .factor import Factorisation, SingularPattern, factor_lines, plan_factors, solve_lines
from .large import large_file
from .points import point_lines
from .roots import root_tables
from .straight import TIME_COLUMN, Straight, family_residuals, reduce_strength, write_out
from .tableau import tableau_lines
from .text import NotInC, array, braces

if TYPE_CHECKING:
    from ...language.flat_model import Assignment, Family
    from ..initial import InitialProblem
    from ..lowered import Lowered
    from ..parameters import ParameterProgram

RUNTIME = (
    "acausal.h", "solver.h", "events.h", "scan.h", "modes.h", "tangent.h", "stepping.h", "integrate.h", "explicit.h",
    "projection.h", "conserved.h", "families.h", "initialize.h", "start.h",
)  # fmt: skip
TANGENTS = "AC_TANGENTS"
"""Macro that asks for tangents."""
EXPLICIT = "AC_EXPLICIT"
"""Macro that asks for the explicit methods."""
DENSE = 4_000_000
"""Numbers in the matrices of the projection, which are dense, up to which the native engine takes a large system."""


@dataclass(frozen=True, slots=True)
class CSource:
    """Generated C.

    Attributes:
        text: the file of this model.
        runtime: the fixed files that it includes, by name.
        tables: index rows (int32) that the compiled code of a large system is given.
    """

    text: str
    runtime: dict[str, str]
    tables: list[Any] = field(default_factory=list[Any])

    def __str__(self) -> str:
        return self.text


def runtime_files() -> dict[str, str]:
    """The fixed files."""
    folder = files("acausal.lowering.c") / "runtime"
    return {name: (folder / name).read_text(encoding="utf-8") for name in RUNTIME}


def to_c(
    program: ParameterProgram,
    problem: InitialProblem,
    labels: Callable[[int], str] | None = None,
    *,
    hybrid: Hybrid | None = None,
    further: Mapping[str, Sequence[Family]] | None = None,
    loops: bool = False,
    observe_tangent: bool = False,
) -> CSource:
    """C source of a compiled system.

    Args:
        program: its parameters.
        problem: its initialization, with the lowered equations.
        labels: name of a variable by number, for comments.
        hybrid: its events.
        further: names of further functions, each with the expressions that it evaluates, for systems that are written
            out.
        loops: write families as loops, for systems that are too large to be written out.
        observe_tangent: add the tangents of all variables, for systems that are written out.

    Raises:
        NotInC: the model calls Python functions; or it has very many retained constraints.
        StructureError: unknowns of the algebraic equations occur in none of them.
    """
    try:
        return _written(program, problem, labels, hybrid, further, loops, observe_tangent)
    except SingularPattern as error:
        raise StructureError(_singular(problem.lowered, error)) from error


def _singular(lowered: Lowered, error: SingularPattern) -> str:
    reduced = lowered.schedule.reduced
    flat = reduced.flat
    equations = [
        reduced.rows.locate(int(row))
        for group in lowered.schedule.groups if group.kernel.iterates
        for block in group.equations for row in block
    ]  # fmt: skip
    names = ", ".join(reduced.name(int(lowered.schedule.tears[k - lowered.n_x])) for k in error.columns)
    lines = [f"    {flat.equation_text(f, k):<48} {' '.join(flat.equation_place(f, k))}" for f, k in equations]
    return "\n".join([
        f"`{flat.model_name}` is singular: nothing determines {names}, which cancels in these equations:",
        *lines[:20], "Try: remove what says the same thing twice, and write what is missing instead.",
    ])  # fmt: skip


def _written(
    program: ParameterProgram, problem: InitialProblem, labels: Callable[[int], str] | None, hybrid: Hybrid | None,
    further: Mapping[str, Sequence[Family]] | None, loops: bool, observe_tangent: bool,
) -> CSource:  # fmt: skip
    if loops:
        low = problem.lowered
        if low.n_g * low.n_x + (low.n_w * low.n_x if low.n_g else 0) > DENSE:
            raise NotInC(f"{low.n_g} retained constraints of {low.n_x} states are left to the diffrax engine")
        text, tables = large_file(problem.lowered, program.flat.n_par, len(program.flat.inputs), hybrid)
        return CSource(text, runtime_files(), tables)
    return CSource(_Small(program, problem, labels, hybrid, further).file(observe_tangent), runtime_files())


class _Small:
    """A system written out in straight lines."""

    def __init__(
        self, program: ParameterProgram, problem: InitialProblem, labels: Callable[[int], str] | None,
        hybrid: Hybrid | None, further: Mapping[str, Sequence[Family]] | None = None,
    ) -> None:  # fmt: skip
        self.hybrid = hybrid
        self.program, self.problem = program, problem
        self.lowered = lowered = problem.lowered
        self.n_par = n_par = program.flat.n_par
        self.n_inputs = len(program.flat.inputs)
        self.straight: Straight = write_out(lowered)
        s = self.straight
        self.n_x, self.n_z = lowered.n_x, s.n_z
        outputs = [s.known[int(i)] for i in lowered.dx_ids] + s.residuals
        invariants = family_residuals(s, lowered.schedule.invariants)
        targets = [s.known[int(i)] for i in problem.targets]
        conditions = [*s.residuals, *invariants, *targets, *family_residuals(s, problem.families)]
        self._reduce([*outputs, *invariants, *conditions])
        slopes = {n_par + i: par(lowered.n_p + i) for i in range(self.n_inputs)}
        self.field = _Block(self._roots[: self.n_z])
        self.invariants = _Block(self._roots[self.n_z : self.n_z + len(invariants)])
        self.conditions = _Block(self._roots[self.n_z + len(invariants) :])
        rows = s.jacobian(self._roots, slopes)
        for block in (self.field, self.invariants, self.conditions):
            block.differentiate(rows[: len(block.values)])
            rows = rows[len(block.values) :]
        self.switching = reduce_strength(family_residuals(s, hybrid.roots.families if hybrid else []))
        self.further = {name: reduce_strength(family_residuals(s, f)) for name, f in (further or {}).items()}
        held = n_par + self.n_inputs
        self.hoisted = Hoisted(lambda leaf: leaf.value < n_par or held <= leaf.value < lowered.n_p)
        self.observed = reduce_strength(s.known.values())
        self.labels: dict[int, str] = {}
        if labels is not None:
            for v, e in zip(s.known, self.observed, strict=True):
                if e.args:
                    self.labels.setdefault(id(e), labels(v))

    def _reduce(self, roots: list[Expr]) -> None:
        """Cheaper forms of the outputs and of what the linear solves need, all sharing."""
        s = self.straight
        flat = list(roots)
        for solve in s.solves:
            flat += [*(e for line in solve.matrix for e in line), *solve.rhs]
        new = iter(reduce_strength(flat))
        self._roots = [next(new) for _ in roots]
        for k, solve in enumerate(s.solves):
            matrix = tuple(tuple(next(new) for _ in line) for line in solve.matrix)
            s.solves[k] = type(solve)(solve.factor, matrix, tuple(next(new) for _ in solve.rhs), solve.targets)

    # ---- pieces -----------------------------------------------------------------------------------
    def plan(self) -> Factorisation:
        """Order and fill of the factors."""
        rows, columns = (np.array([e[k] for e in self.field.entries], np.int64) for k in (0, 1))
        shape = (self.n_z, self.n_z)
        pattern = sparse.csr_matrix((np.arange(len(rows)) + 1, (rows, columns)), shape=shape)
        pattern.data = pattern.data - 1
        return plan_factors(pattern, np.arange(self.n_z) < self.n_x)

    def _leaf(self, node: Expr) -> str:
        if node.op == "time":
            return "t"
        if node.op == "var":
            return f"z[{node.value}]"
        k = node.value - self.n_par
        if 0 <= k < self.n_inputs:
            return f"m->u[{k}]"
        return f"p[{node.value}]" if node.value < self.lowered.n_p else f"m->du[{node.value - self.lowered.n_p}]"

    def _tangent(self, node: Expr) -> str | None:
        if node.op == "time":
            return None
        if node.op == "var":
            return f"dz[{node.value}]"
        return f"dp[{node.value}]" if node.value < self.lowered.n_p else None

    def _function(
        self, head: str, values: Iterable[tuple[str, Expr]], tangents: Iterable[tuple[str, Expr]] = ()
    ) -> str:
        tangents = list(tangents)
        writer = Writer(self.straight, self._leaf, self._tangent if tangents else None, self.hoisted, self.labels)
        body = ["AC_UNUSED const double *p = m->p, *c = m->c;"]
        if tangents:
            body.append("AC_UNUSED const ac_vector *dp = m->dp, *dc = m->dc;")
        return braces(head, [*body, *writer.function(values, tangents)])

    def functions(self) -> list[str]:
        """Field, constraints, conditions of the start, with their derivatives."""
        f, jacobian = self.field.assign("f"), self.field.assign_entries("J")
        rates = [(f"ft[{i}]", e) for i, e in enumerate(self.field.rates)]
        out = [
            self._function(f"static void ac_field({_AT}, double *f)", f),
            self._function(
                f"static void ac_field_jacobian({_AT}, double *f, double *ft, double *J)", [*f, *jacobian, *rates]
            ),
        ]  # fmt: skip
        for name, block in (("invariants", self.invariants), ("conditions", self.conditions)):
            head = f"AC_UNUSED static void ac_{name}({_AT}, double *g, double *G)"
            out.append(self._function(head, [*block.assign("g"), *block.assign_entries("G")]))
        return out

    def tangent_functions(self) -> list[str]:
        """The same along directions."""
        at = _AT + ", const ac_vector *dz"
        jacobian = self.field.assign_entries("dJ")
        rates = [(f"dft[{i}]", e) for i, e in enumerate(self.field.rates)]
        out = [
            self._function(f"static void ac_field_tangent({at}, ac_vector *df)", (), self.field.assign("df")),
            self._function(
                f"static void ac_jacobian_tangent({at}, ac_vector *dJ, ac_vector *dft)", (), [*jacobian, *rates]
            ),
        ]  # fmt: skip
        for name, block in (("invariants", self.invariants), ("conditions", self.conditions)):
            head = f"AC_UNUSED static void ac_{name}_tangent({at}, ac_vector *dg)"
            out.append(self._function(head, (), block.assign("dg")))
        return out

    def observe(self) -> str:
        """All variables of the reduced model, by number; those that are not computed are left alone."""
        values = [(f"all[{v}]", e) for v, e in zip(self.straight.known, self.observed, strict=True)]
        return self._function(f"AC_UNUSED static void ac_observe({_AT}, double *all)", values)

    def observe_tangent(self) -> str:
        """Tangents of all variables; time moves, too."""

        def tangent(node: Expr) -> str | None:
            return "dt" if node.op == "time" else self._tangent(node)

        values = [(f"dall[{v}]", e) for v, e in zip(self.straight.known, self.observed, strict=True)]
        writer = Writer(self.straight, self._leaf, tangent, self.hoisted)
        body = [
            "AC_UNUSED const double *p = m->p, *c = m->c;", "AC_UNUSED const ac_vector *dp = m->dp, *dc = m->dc;",
            *writer.function((), values),
        ]  # fmt: skip
        return braces(f"AC_UNUSED static void ac_observe_tangent({_AT}, {_DT}, ac_vector *dall)", body)

    def switches(self) -> list[str]:
        """The functions whose change of sign is an event, and further ones."""
        return [
            self._function(
                f"AC_UNUSED static void {name}({_AT}, double *g)", [(f"g[{k}]", e) for k, e in enumerate(es)]
            )
            for name, es in {"ac_roots": self.switching, **self.further}.items()
        ]

    def constants(self, tangents: bool) -> str:
        """Expressions of parameters, and with tangents theirs."""
        values = [(f"c[{i}]", e) for i, e in enumerate(self.hoisted.nodes)]
        writer = Writer(self.straight, self._leaf, self._tangent if tangents else None)
        if not tangents:
            return braces("static void ac_constants(const double *p, double *c)", writer.function(values))
        moving = [(f"dc[{i}]", e) for i, e in enumerate(self.hoisted.nodes)]
        head = "static void ac_constants_tangent(const double *p, const ac_vector *dp, ac_vector *dc)"
        return braces(head, writer.function((), moving))

    def assignments(self, assignments: list[Assignment], name: str, given: bool, tangents: bool) -> list[str]:
        """Statements ``name[target] = expression`` of parameters, in order."""
        lines: list[str] = []
        for a in assignments:
            for target, row in zip(a.targets.tolist(), a.par_rows.tolist(), strict=True):
                e = reduce_strength((substitute(a.expression, {par(i): par(p) for i, p in enumerate(row)}),))[0]
                writer = Writer(self.straight, self._leaf, self._tangent if tangents else None)
                place = f"{'d' if tangents else ''}{name}[{target}]"
                body = writer.function((), [(place, e)]) if tangents else writer.function([(place, e)])
                test = f"if (!given[{target}]) " if given else ""
                lines.append(test + "{ " + " ".join(body) + " }")
        return lines

    def parameters(self, tangents: bool) -> list[str]:
        """Dependent parameters, and start values that depend on parameters."""
        d = ", const ac_vector *dp, ac_vector *ds" if tangents else ", double *s"
        d_p = ", ac_vector *dp" if tangents else ""
        end = "_tangent" if tangents else ""
        p = "const double *p" if tangents else "double *p"
        ordered, starts = self.program.ordered, self.program.flat.start_assignments
        return [
            braces(
                f"static void ac_parameters{end}(const unsigned char *given, {p}{d_p})",
                self.assignments(ordered, "p", True, tangents),
            ),
            braces(f"static void ac_starts{end}(const double *p{d})", self.assignments(starts, "s", False, tangents)),
        ]

    # ---- the file ---------------------------------------------------------------------------------
    def file(self, observe_tangent: bool = False) -> str:
        """The whole file."""
        plan = self.plan()
        nominal = np.concatenate([self.lowered.x_nominal, self.lowered.w_nominal])
        kept = self.lowered.conserved
        functions, tangents = self.functions(), self.tangent_functions()
        functions += [self.observe(), *self.switches()]
        if observe_tangent:
            tangents.append(self.observe_tangent())
        constants, constants_tangent = self.constants(False), self.constants(True)
        sizes = {
            "AC_N": self.n_z, "AC_NX": self.n_x, "AC_NZ": len(self.field.entries), "AC_NF": max(plan.size, self.n_z),
            "AC_NC": len(self.hoisted.nodes), "AC_NU": self.n_inputs, "AC_NPAR": self.n_par, "AC_NP": self.lowered.n_p,
            "AC_NG": len(self.invariants.values), "AC_NGZ": len(self.invariants.entries),
            "AC_NI": len(self.conditions.values), "AC_NIZ": len(self.conditions.entries),
            "AC_NALL": self.lowered.n_ids, "AC_NR": len(self.switching), "AC_NK": kept.count, "AC_NKZ": len(kept.value),
        }  # fmt: skip
        head = [f"#define {name} {value}" for name, value in sizes.items()]
        arrays = [*self.field.arrays("ac"), *self.invariants.arrays("ac_g"), *self.conditions.arrays("ac_i")]
        arrays.append(array("double", "ac_nominal", nominal.tolist()))
        arrays += root_tables(self.hybrid, self.lowered)
        arrays += [array("int", "ac_k_row", kept.row.tolist()), array("int", "ac_k_column", kept.column.tolist())]
        arrays.append(array("double", "ac_k_value", kept.value.tolist()))
        factor = [
            braces(
                "static int ac_factor(const ac_model *m, double d, const double *J, double *F)",
                factor_lines(plan, nominal),
            ),
            braces("static void ac_solve(const ac_model *m, const double *F, double *b)", solve_lines(plan, "double")),
        ]
        along = braces(
            "static void ac_solve_vector(const ac_model *m, const double *F, ac_vector *b)",
            solve_lines(plan, "ac_vector"),
        )
        parts = [
            *head, '#include "acausal.h"', *arrays, *tableau_lines(), *self.parameters(False), constants, *functions,
            *factor, *point_lines(self.lowered), f"#ifdef {TANGENTS}", *self.parameters(True), constants_tangent,
            *tangents, along, "#endif", '#include "solver.h"', '#include "start.h"',
        ]  # fmt: skip
        return "\n".join(parts) + "\n"


_AT = "const ac_model *m, double t, const double *z"
_DT = "ac_vector dt, const ac_vector *dz"


class _Block:
    """Some expressions and their derivatives.

    Attributes:
        values: the expressions.
        entries: (row, column) of their derivatives with respect to z that are not zero.
        slopes: these derivatives.
        rates: derivatives with respect to time.
    """

    def __init__(self, values: list[Expr]) -> None:
        self.values = values
        self.entries: list[tuple[int, int]] = []
        self.slopes: list[Expr] = []
        self.rates: list[Expr] = []

    def differentiate(self, rows: list[Row]) -> None:
        """Take the derivatives from sparse rows."""
        self.entries = [(i, c) for i, row in enumerate(rows) for c in sorted(row) if c != TIME_COLUMN]
        flat = reduce_strength([rows[i][c] for i, c in self.entries] + [row.get(TIME_COLUMN, ZERO) for row in rows])
        self.slopes, self.rates = flat[: len(self.entries)], flat[len(self.entries) :]

    def assign(self, name: str) -> list[tuple[str, Expr]]:
        """Where the values go."""
        return [(f"{name}[{i}]", e) for i, e in enumerate(self.values)]

    def assign_entries(self, name: str) -> list[tuple[str, Expr]]:
        """Where the derivatives go."""
        return [(f"{name}[{i}]", e) for i, e in enumerate(self.slopes)]

    def arrays(self, name: str) -> list[str]:
        """Rows and columns of the derivatives."""
        return [
            array("int", f"{name}_row", [i for i, _ in self.entries]),
            array("int", f"{name}_column", [j for _, j in self.entries]),
        ]
