"""The compiled equations as pure JAX functions of (t, x, w, p).

The schedule's groups are emitted in order: a group of many blocks as operations on arrays, a single block as scalar
operations that share common subexpressions with all other single blocks. The number of operations therefore does not
grow with the number of instances.
"""

from __future__ import annotations

from functools import cached_property
from typing import Any

import numpy as np

from ..language.flat_model import Family
from ..language.template import Floats, Ints
from ..passes.first_integrals import FirstIntegrals, first_integrals
from ..passes.schedule import Group, Kernel, Schedule, needs
from ..symbolic.expr import Expr, par, var
from ..symbolic.traverse import evaluate, substitute
from .balanced import solve_balanced
from .environment import Environment
from .newton import newton_root
from .repetition import Repetition, emit, plan
from .time_tables import TimeTable, time_tables

WIDE = 24
"""Sums of more terms than this are emitted as a gather and a reduction."""


class Lowered:
    """Pure functions of a schedule.

    With x the states (n_x,), w the iterated algebraic unknowns (n_w,), p all parameters followed by the inputs (n_p,):
    ``x' = dx(t, x, w, p)``, ``0 = r(t, x, w, p)``, and the states satisfy ``0 = g(t, x, w, p)`` (n_g invariants).
    """

    def __init__(self, schedule: Schedule, nominal: Floats, n_p: int) -> None:
        self.schedule = schedule
        self.n_x = len(schedule.states)
        self.n_w = len(schedule.tears)
        self.n_p = n_p
        self.n_g = sum(f.size for f in schedule.invariants)
        self.n_ids = len(schedule.reduced.unknown)
        self.x_nominal = nominal[schedule.states]
        self.w_nominal = nominal[schedule.tears]
        self.nominal = nominal
        self.conditions: list[Family] = []
        self._global: dict[int, Any] = {}
        self._plans: dict[tuple[int, ...], list[Group | Repetition]] = {}
        derivative_of = schedule.reduced.derivative_of
        self.dx_ids = derivative_of[schedule.states]
        self.tear_position = np.full(self.n_ids, -1, np.int64)  # place among the algebraic unknowns
        self.tear_position[schedule.tears] = np.arange(self.n_w)

    @cached_property
    def time_tables(self) -> tuple[TimeTable, ...]:
        """Tables over time in the equations and in the conditions of events."""
        return time_tables(self.schedule, self.conditions)

    def attach(self, observed: tuple[Ints, Ints]) -> None:
        """Tell which reduced variable (with which sign) every variable of the flat model is."""
        self.representative, self.sign = observed
        self.n_all = len(self.representative)

    def expanded(self, values: Floats, ids: Any) -> Floats:
        """Variables of the flat model by number, from values of the reduced one, (n_t, n_ids): (n_t, *shape of ids)."""
        sign = self.sign[ids]
        found = values[:, self.representative[ids]]
        return np.where(sign == 0, 0.0, sign * found) if np.any(sign != 1) else found

    # ---- what is needed -------------------------------------------------------------------------------------------
    def closure(self, ids: Ints, *, residuals: bool) -> list[int]:
        """Groups needed for variables `ids` (and for the residuals of all iterating groups, if asked for)."""
        wanted = np.zeros(self.n_ids, bool)
        wanted[ids] = True
        chosen: list[int] = []
        for k in range(len(self.schedule.groups) - 1, -1, -1):
            group = self.schedule.groups[k]
            if (residuals and group.kernel.iterates) or wanted[group.unknowns].any():
                chosen.append(k)
                wanted[needs(group)] = True
        return chosen[::-1]

    @cached_property
    def _groups_dx(self) -> list[int]:
        return self.closure(self.dx_ids, residuals=True)

    @cached_property
    def _groups_g(self) -> list[int]:
        ids = np.concatenate([np.zeros(0, np.int64), *(f.var_rows.ravel() for f in self.schedule.invariants)])
        return self.closure(ids, residuals=False)

    # ---- public functions -----------------------------------------------------------------------------------------
    def derivatives(self, t: Any, x: Any, w: Any, p: Any) -> tuple[Any, Any]:
        """Time derivatives of the states (n_x,) and residuals of the iterated equations (n_w,)."""
        env, residuals = self._run(self._groups_dx, t, x, w, p)
        return self._vector(env, self.dx_ids), self._residual_vector(residuals)

    def invariants(self, t: Any, x: Any, w: Any, p: Any) -> Any:
        """Constraints that consistent states satisfy, (n_g,)."""
        env, _ = self._run(self._groups_g, t, x, w, p)
        return self._families(self.schedule.invariants, env, t, p)

    def values(self, ids: Ints, t: Any, x: Any, w: Any, p: Any) -> Any:
        """Values of some variables (indices of the reduced model), (len(ids),)."""
        env, _ = self._run(self.closure(ids, residuals=False), t, x, w, p)
        return self._vector(env, ids)

    def observe(self, t: Any, x: Any, w: Any, p: Any, ids: Ints | None = None) -> Any:
        """Values of variables of the flat model, eliminated ones included: all (n_all,), or those numbered `ids`."""
        import jax.numpy as jnp

        chosen = np.arange(self.n_all) if ids is None else np.asarray(ids)
        reduced, sign = self.representative[chosen], self.sign[chosen]
        alive = np.unique(reduced[sign != 0])
        values = self.values(alive, t, x, w, p) if len(alive) else jnp.zeros(1)
        position = np.searchsorted(alive, reduced).clip(0, max(len(alive) - 1, 0))
        return jnp.where(sign == 0, 0.0, sign * values[position])

    def residuals_of(self, families: list[Family], t: Any, x: Any, w: Any, p: Any) -> Any:
        """Residuals of further equations (of the initialization), concatenated."""
        ids = np.concatenate([np.zeros(0, np.int64), *(f.var_rows.ravel() for f in families)])
        env, _ = self._run(self.closure(ids, residuals=False), t, x, w, p)
        return self._families(families, env, t, p)

    def explicit(self, t: Any, x: Any, w_guess: Any, p: Any) -> Any:
        """Time derivatives with the algebraic unknowns solved inside, block by block, from `w_guess`."""
        env, _ = self._run(self._groups_dx, t, x, w_guess, p, solve=True)
        return self._vector(env, self.dx_ids)

    def solve_algebraic(self, t: Any, x: Any, w_guess: Any, p: Any) -> Any:
        """Algebraic unknowns (n_w,) that make the residuals zero; derivatives by the implicit-function theorem."""
        if not self.n_w:
            return w_guess
        groups = self.closure(np.zeros(0, np.int64), residuals=True)
        env, _ = self._run(groups, t, x, w_guess, p, solve=True)
        return self._vector(env, self.schedule.tears)

    @cached_property
    def conserved(self) -> FirstIntegrals:
        """Sums of states that stay what they are."""
        return first_integrals(self.schedule)

    def sparsity(self) -> Any:
        """Boolean CSR pattern of d(dx, r)/d(x, w), (n_x + n_w, n_x + n_w)."""
        from .sparsity import jacobian_pattern

        return jacobian_pattern(self, self._groups_dx)

    # ---- emission -------------------------------------------------------------------------------------------------
    def _run(
        self, groups: list[int], t: Any, x: Any, w: Any, p: Any, *, solve: bool = False
    ) -> tuple[Environment, dict[int, Any]]:
        import jax.numpy as jnp

        t = jnp.asarray(t, float)  # a number of Python's own would raise where it is divided by
        env = Environment(self.n_ids, jnp)
        env.put(self.schedule.states, x)
        if not solve:
            env.put(self.schedule.tears, w)
        emitter = _Emitter(env, t, p, jnp)
        residuals: dict[int, Any] = {}
        offset = 0
        starts: dict[int, int] = {}
        for k, group in enumerate(self.schedule.groups):
            starts[k] = offset
            offset += group.size * len(group.kernel.tears) if group.kernel.iterates else 0
        position = {id(self.schedule.groups[k]): k for k in groups}
        for item in self._plan(tuple(groups)):
            if isinstance(item, Repetition):
                emitter.repetition(item)
                continue
            k = position[id(item)]
            if item.kernel.iterates and solve:
                n, m = item.size, len(item.kernel.tears)
                guess = w[starts[k] : starts[k] + n * m].reshape(n, m)
                self._solve_block(emitter, item, guess)
            result = emitter.group(item, self._global_form(k))
            if item.kernel.iterates:
                residuals[k] = result
        return env, residuals

    def _plan(self, groups: tuple[int, ...]) -> list[Group | Repetition]:
        """The groups with long chains folded into loops."""
        if groups not in self._plans:
            self._plans[groups] = plan([self.schedule.groups[k] for k in groups])
        return self._plans[groups]

    def _solve_block(self, emitter: _Emitter, group: Group, guess: Any) -> None:
        """Newton's method on all blocks of a group at once."""
        kernel = group.kernel
        m = kernel.size
        externals = [emitter.env.gather(group.var_rows[:, j]) for j in range(m, group.var_rows.shape[1])]
        parameters = [emitter.parameter_column(group.par_rows[:, j]) for j in range(group.par_rows.shape[1])]
        jnp, t = emitter.jnp, emitter.t

        def residual(tears: Any) -> Any:
            local: dict[int, Any] = {u: tears[:, i] for i, u in enumerate(kernel.tears)}

            def leaf(node: Expr) -> Any:
                if node.op == "time":
                    return t
                if node.op == "par":
                    return parameters[node.value]
                return local[node.value] if node.value < m else externals[node.value - m]

            for u, expression in kernel.steps:
                local[u] = evaluate((expression,), leaf, jnp)[0]
            values = evaluate(kernel.residuals, leaf, jnp)
            return jnp.stack([jnp.broadcast_to(v, tears.shape[:1]) for v in values], axis=1)

        scale = jnp.asarray(self.nominal[group.unknowns[:, kernel.tears]])
        tears = newton_root(residual, guess, scale)
        ids = group.unknowns[:, kernel.tears]
        emitter.env.put(ids.ravel(), tears.ravel())

    def _vector(self, env: Environment, ids: Ints) -> Any:
        jnp = env.jnp
        if not len(ids):
            return jnp.zeros(0)
        if len(ids) <= 64:
            return jnp.stack([env.scalar(int(i)) for i in ids])
        return jnp.broadcast_to(env.gather(ids), (len(ids),))

    def _residual_vector(self, residuals: dict[int, Any]) -> Any:
        import jax.numpy as jnp

        return jnp.concatenate([r.ravel() for r in residuals.values()]) if residuals else jnp.zeros(0)

    def _families(self, families: list[Family], env: Environment, t: Any, p: Any) -> Any:
        jnp = env.jnp
        emitter = _Emitter(env, t, p, jnp)
        out = [emitter.family(f) for f in families]
        return jnp.concatenate(out) if out else jnp.zeros(0)

    def _global_form(self, k: int) -> Any:
        """Kernel of a single block over the model's own variable numbers (cached: nodes stay alive for memoisation)."""
        group = self.schedule.groups[k]
        if group.size != 1 or is_wide(group):
            return None
        if k not in self._global:
            names = {
                **{var(i): var(v) for i, v in enumerate(group.var_rows[0].tolist())},
                **{par(i): par(v) for i, v in enumerate(group.par_rows[0].tolist())},
            }
            kernel = group.kernel
            steps = [(int(group.var_rows[0, u]), substitute(e, names)) for u, e in kernel.steps]
            residuals = [substitute(r, names) for r in kernel.residuals]
            matrix = [[substitute(e, names) for e in line] for line in kernel.matrix]
            rhs = [substitute(e, names) for e in kernel.rhs]
            tears = [int(group.var_rows[0, u]) for u in kernel.tears]
            self._global[k] = (steps, residuals, matrix, rhs, tears)
        return self._global[k]


def is_wide(group: Group) -> bool:
    """Whether the group is one explicit sum of very many variables."""
    kernel = group.kernel
    return (
        not kernel.tears
        and len(kernel.steps) == 1
        and kernel.steps[0][1].op == "add"
        and len(kernel.steps[0][1].args) > WIDE
        and all((a.args[0] if a.op == "neg" else a).op == "var" for a in kernel.steps[0][1].args)
    )


class _Emitter:
    """Evaluates groups into an environment."""

    def __init__(self, env: Environment, t: Any, p: Any, jnp: Any) -> None:
        self.env = env
        self.t = t
        self.p = p
        self.jnp = jnp
        self.memo: dict[int, Any] = {}

    def group(self, group: Group, form: Any) -> Any:
        """Compute a group's unknowns; returns the residuals of an iterating group."""
        if form is not None:
            return self._single(form)
        if is_wide(group):
            return self._wide(group)
        return self._batch(group)

    def _leaf(self, node: Expr) -> Any:
        if node.op == "var":
            return self.env.scalar(node.value)
        return self.t if node.op == "time" else self.p[node.value]

    def _single(self, form: Any) -> Any:
        steps, residuals, matrix, rhs, tears = form
        jnp = self.jnp
        if matrix:
            lines = [evaluate(line, self._leaf, jnp, self.memo) for line in (*matrix, rhs)]
            *rows, b = [jnp.stack([self._scalar(v) for v in line]) for line in lines]
            a = jnp.stack(rows)
            solution = solve_balanced(a, b, jnp)
            for i, index in enumerate(tears):
                self.env.put_scalar(index, solution[i])
        for index, expression in steps:
            self.env.put_scalar(index, self._scalar(evaluate((expression,), self._leaf, jnp, self.memo)[0]))
        if residuals:
            return jnp.stack([self._scalar(v) for v in evaluate(residuals, self._leaf, jnp, self.memo)])
        return None

    def _scalar(self, value: Any) -> Any:
        if isinstance(value, (int, float)):
            return self.jnp.asarray(value, float)
        return value * 1.0 if self._is_bool(value) else value

    def _is_bool(self, value: Any) -> bool:
        return getattr(value, "dtype", None) == np.dtype(bool)

    def _wide(self, group: Group) -> Any:
        index, expression = group.kernel.steps[0]
        slots = [(a.args[0].value, -1.0) if a.op == "neg" else (a.value, 1.0) for a in expression.args]
        columns = group.var_rows[:, [s for s, _ in slots]]
        signs = np.array([s for _, s in slots])
        if (signs == signs[0]).all():
            values = self.jnp.broadcast_to(self.env.gather(columns.ravel()), (columns.size,)).reshape(columns.shape)
            total = values.sum(axis=1) * signs[0]
        else:
            total = self.jnp.zeros(len(columns))
            for sign in (1.0, -1.0):
                part = columns[:, signs == sign]
                values = self.jnp.broadcast_to(self.env.gather(part.ravel()), (part.size,)).reshape(part.shape)
                total = total + sign * values.sum(axis=1)
        self.env.put(group.var_rows[:, index], total)

    def parameter_column(self, rows: Ints) -> Any:
        """Values of one parameter slot over a group's rows."""
        if (rows == rows[0]).all():
            return self.p[int(rows[0])]
        step = np.diff(rows)
        if (step == step[0]).all() and step[0] > 0:
            return self.p[int(rows[0]) : int(rows[-1]) + 1 : int(step[0])]
        return self.p[rows]

    def _batch(self, group: Group) -> Any:
        kernel, n = group.kernel, group.size
        given = [*(kernel.tears if kernel.iterates else ()), *range(kernel.size, group.var_rows.shape[1])]
        columns = {j: self.env.gather(group.var_rows[:, j]) for j in given}
        parameters = [self.parameter_column(group.par_rows[:, j]) for j in range(group.par_rows.shape[1])]
        found, residuals = self.kernel(kernel, columns, parameters, n)
        for u, value in found.items():
            self.env.put(group.var_rows[:, u], value)
        return residuals

    def kernel(
        self, kernel: Kernel, columns: dict[int, Any], parameters: list[Any], n: int
    ) -> tuple[dict[int, Any], Any]:
        """Unknowns of `n` blocks with one kernel, and the residuals of an iterating one (n, tears)."""
        jnp = self.jnp
        values = dict(columns)

        def leaf(node: Expr) -> Any:
            return self.t if node.op == "time" else parameters[node.value] if node.op == "par" else values[node.value]

        memo: dict[int, Any] = {}
        found: dict[int, Any] = {}
        if kernel.matrix:
            entries = [[self._column(v, n) for v in evaluate(line, leaf, jnp, memo)] for line in kernel.matrix]
            a = jnp.stack([jnp.stack(line, 1) for line in entries], 1)
            b = jnp.stack([self._column(v, n) for v in evaluate(kernel.rhs, leaf, jnp, memo)], 1)
            solution = solve_balanced(a, b, jnp)
            for i, u in enumerate(kernel.tears):
                found[u] = values[u] = solution[:, i]
        for u, expression in kernel.steps:
            found[u] = values[u] = self._column(evaluate((expression,), leaf, jnp, memo)[0], n)
        if not kernel.residuals:
            return found, None
        return found, jnp.stack([self._column(v, n) for v in evaluate(kernel.residuals, leaf, jnp, memo)], 1)

    def repetition(self, chain: Repetition) -> None:
        """A chain of equal blocks as one loop."""
        values = self.jnp.broadcast_to(self.env.gather(chain.external), chain.external.shape)
        made = emit(chain, values, self.p, lambda *given: self.kernel(*given)[0])
        self.env.put(chain.produced, made)

    def _column(self, value: Any, n: int) -> Any:
        value = value * 1.0 if self._is_bool(value) else value
        return self.jnp.broadcast_to(self.jnp.asarray(value, float), (n,))

    def family(self, family: Family) -> Any:
        """Residuals of a family, (n,)."""

        def leaf(node: Expr) -> Any:
            if node.op == "time":
                return self.t
            if node.op == "par":
                return self.parameter_column(family.par_rows[:, node.value])
            return self.env.gather(family.var_rows[:, node.value])

        return self._column(evaluate((family.residual,), leaf, self.jnp)[0], family.size)
