"""Derivatives of a consistent start, by the implicit-function theorem, with NumPy or with compiled equations."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal.errors import InitializationError
from acausal.lowering.conditions import Conditions
from acausal.lowering.initial import EASE_ALGEBRAIC, GivenStarts, given_starts
from acausal.lowering.initial_numeric import least_change

from .event_iteration import left_starts
from .native_library import Floats, NativeLibrary
from .started import Seed, Started, own_conditions

Tangents = tuple[Floats, Floats]


@dataclass(frozen=True, slots=True, eq=False)
class StartTangents:
    """Derivatives of the start of a system in `lanes` directions.

    Attributes:
        system: the system.
        native_library: with the compiled equations of the start; None to evaluate them with NumPy.
        lanes: number of directions.
    """

    system: Any
    native_library: NativeLibrary | None
    lanes: int

    def at(self, t0: float, initial: Mapping[str, Any], started: Started, seeds: Sequence[Seed]) -> Tangents:
        """Tangents of z0 (n, lanes) and p (n_p, lanes): the implicit-function theorem at the start.

        Where the conditions leave freedom, start values move the solution within the null space of the Jacobian.
        """
        system, lanes = self.system, self.lanes
        program, problem = system.program, system.initial
        low = problem.lowered
        dp = np.zeros((program.n_p, lanes))
        for k, seed in enumerate(seeds):
            if seed.kind != "initial":
                first = program.flat.n_par if seed.kind == "input" else 0
                dp[first + np.array(seed.indices), k] = 1.0
        d_starts, starts = self._starts(started, dp)
        if system.hybrid is not None:
            for piece, ids, signs in left_starts(system.hybrid):
                dp[piece.slots] = (signs * problem.start_sign[ids])[:, None] * d_starts[problem.start_source[ids]]
        overrides = system._overrides(initial, np)
        given_at = given_starts(problem, starts, overrides, started.p, np)
        dz = np.zeros((low.n_x + low.n_w, lanes))
        known = np.concatenate([low.schedule.states, low.schedule.tears])
        source, sign = problem.start_source[known], problem.start_sign[known]
        dz[:] = sign[:, None] * np.where(np.isnan(starts[source])[:, None], 0.0, d_starts[source])
        dz[low.n_x :] = 0.0
        ids = given_at.ids
        d_wanted = problem.start_sign[ids, None] * d_starts[problem.start_source[ids]]
        position = {int(v): i for i, v in enumerate(low.schedule.states)}
        further = [v for v in overrides if v not in position]  # their conditions come last
        row = {v: len(ids) - len(further) + i for i, v in enumerate(further)}
        d_wanted[len(ids) - len(further) :] = 0.0
        for k, seed in enumerate(seeds):
            for index, sign_of in zip(seed.indices, seed.signs, strict=True) if seed.kind == "initial" else ():
                if index in row:
                    d_wanted[row[index], k] = sign_of
                else:
                    dz[position[index]] = 0.0
                    dz[position[index], k] = sign_of
        own = self.native_library is not None and own_conditions(problem, overrides)
        j, rate = self._conditions(t0, started, dz, dp, None if own else given_at, d_wanted)
        n_w = low.n_w
        fixed = given_at.fixed if given_at.conditions else np.ones(low.n_x, bool)
        free = np.concatenate([np.flatnonzero(~fixed), low.n_x + np.arange(n_w)])
        ease = np.concatenate([problem.ease, EASE_ALGEBRAIC * low.w_nominal])[free]
        if len(free) and len(rate):
            dz[free] += ease[:, None] * least_change(j[:, free], ease, rate)
        return dz, dp

    def _starts(self, started: Started, dp: Floats) -> Tangents:
        """Tangents of the start values and the values; `dp` is completed in place."""
        program, library = self.system.program, self.native_library
        if library is None:
            return program.tangents(started.p, started.mask.astype(bool), dp), program.starts(started.p, np)
        library.parameters_tangent(started.mask, started.p, dp)
        d_starts = np.zeros((len(program.flat.start), library.lanes))
        library.starts_tangent(started.p, dp, d_starts)
        starts = program.flat.start.copy()
        library.starts(started.p, starts)
        return d_starts, starts

    def _conditions(
        self, t0: float, started: Started, dz: Floats, dp: Floats, given: GivenStarts | None, d_wanted: Floats
    ) -> tuple[Any, Floats]:
        """Jacobian of the start's conditions with respect to z, and their tangents (n_i, lanes).

        `given` are the start values that are conditions, where these are not those that were compiled.
        """
        problem = self.system.initial
        low = problem.lowered
        if given is None:
            library = self.native_library
            assert library is not None
            slope = library.conditions(started.p, t0, started.z0)[1]
            rate = library.conditions_tangent(started.p, dp, t0, started.z0, dz)
            rate[low.n_w + low.n_g : low.n_w + low.n_g + len(d_wanted)] -= d_wanted
            return slope, rate
        conditions = Conditions(problem, t0, started.p, given.ids, given.wanted)
        if conditions.too_many:
            raise InitializationError(
                "the start of this model is too large for the derivatives of this run; events=False and "
                "engine='diffrax' do without"
            )
        return conditions(started.z0)[1], conditions.rates(started.z0, dz, dp, d_wanted)
