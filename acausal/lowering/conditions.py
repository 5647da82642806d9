"""The conditions of a consistent start as a function of states and algebraic unknowns, with NumPy.

Large problems have sparse Jacobians, found by compressed directional derivatives (Curtis, Powell and Reid 1974).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse

from ..dae.coloring import color_columns
from ..language.flat_model import Bools
from ..language.template import Floats, Ints
from ..passes.schedule import Group
from .held import Held, regrouped
from .initial import InitialProblem, connected
from .numeric import NumericRun
from .sparsity import condition_groups, condition_pattern

LARGEST = 400
"""With more states and algebraic unknowns than this, Jacobians are sparse."""
COLORS = 1000
"""Problems that would need more directional derivatives are left to the compiled path."""


@dataclass(frozen=True, slots=True, eq=False)
class _Plan:
    """How the conditions of a large problem are evaluated, with variables `ids` held at their values.

    Attributes:
        groups: of the schedule.
        pattern, color: of the Jacobian, and the direction of each of its columns.
        may_move: mask of the states that there is a reason to move.
    """

    groups: list[Group]
    pattern: Any
    color: Ints
    may_move: Bools

    @property
    def colors(self) -> int:
        return int(self.color.max(initial=-1)) + 1


class Conditions:
    """Algebraic equations, invariants, variables `ids` at the values `wanted`, and initial equations.

    Args:
        problem: what must hold.
        t: time [s].
        p: all parameters (n_p,).
        ids, wanted: reduced variables with a value that is given.
    """

    def __init__(self, problem: InitialProblem, t: float, p: Floats, ids: Ints, wanted: Floats) -> None:
        self.problem, self.t, self.p, self.ids, self.wanted = problem, t, p, ids, wanted
        low = problem.lowered
        self.plan = _plan_of(problem, ids) if low.n_x + low.n_w > LARGEST else None

    @property
    def too_many(self) -> bool:
        """Whether the Jacobian would need more directional derivatives than are taken here."""
        return self.plan is not None and self.plan.colors > COLORS

    @property
    def may_move(self) -> Bools:
        """Mask of the states that there is a reason to move, (n_x,)."""
        return np.ones(self.problem.lowered.n_x, bool) if self.plan is None else self.plan.may_move

    def __call__(self, z: Floats) -> tuple[Floats, Any]:
        """Residuals (m,) and their Jacobian with respect to z = (x, w), dense or sparse."""
        plan = self.plan
        if plan is None:
            return self._along(z, None)
        directions = np.zeros((len(z), plan.colors))
        directions[np.arange(len(z)), plan.color] = 1.0
        value, slope = self._along(z, directions)
        pattern = plan.pattern
        rows = np.repeat(np.arange(pattern.shape[0]), np.diff(pattern.indptr))
        data = slope[rows, plan.color[pattern.indices]]
        return value, sparse.csr_array((data, pattern.indices, pattern.indptr), pattern.shape)

    def rates(self, z: Floats, dz: Floats, dp: Floats, d_wanted: Floats, dt: Floats | None = None) -> Floats:
        """How the residuals move (m, k) with z, the parameters, the values wanted and time moving in k directions."""
        return self._along(z, dz, dp, d_wanted, dt)[1]

    def _along(
        self, z: Floats, dz: Floats | None, dp: Any = None, d_wanted: Any = None, dt: Any = None
    ) -> tuple[Floats, Floats]:
        low, ids = self.problem.lowered, self.ids
        x, w, everything = z[: low.n_x], z[low.n_x :], np.arange(low.n_x)
        held = None if self.plan is None else Held(ids, self.wanted, d_wanted)
        groups = None if self.plan is None else self.plan.groups
        run = NumericRun(low, self.t, x, w, self.p, everything, dz, dp, dt, groups, held)
        parts = [run.families(low.schedule.invariants), run.computed(ids), run.families(self.problem.families)]
        value = np.concatenate([run.residual[0], *(v for v, _ in parts)])
        slope = np.concatenate([run.residual[1], *(g for _, g in parts)])
        mine = slice(low.n_w + low.n_g, low.n_w + low.n_g + len(ids))
        value[mine] -= self.wanted
        if d_wanted is not None:
            slope[mine] -= d_wanted
        return value, slope


def _plan_of(problem: InitialProblem, ids: Ints) -> _Plan:
    """Made once for each choice of variables with a value that is given."""
    key = ids.tobytes()
    if key not in problem.plans:
        low = problem.lowered
        groups = regrouped(low.schedule, condition_groups(low, ids, problem.families), ids, low.n_ids)
        pattern = condition_pattern(low, ids, problem.families, groups, ids)
        may_move = connected(pattern, np.arange(pattern.shape[0]) >= low.n_w)[: low.n_x]
        problem.plans[key] = _Plan(groups, pattern, np.asarray(color_columns(pattern), np.int64), may_move)
    return problem.plans[key]
