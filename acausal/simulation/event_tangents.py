"""Derivatives through events: of the time at which they happen, and of what follows from them.

Along the surface on which an event happens, all quantities are followed by the chain rule through the turns of the
event; before and behind it the derivatives at fixed times differ by the rates there. Hiskens and Pai (2000), Trajectory
sensitivity analysis of hybrid systems, IEEE Trans. Circuits Syst. I 47(2), eq. 18 to 24.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from acausal.lowering.conditions import Conditions
from acausal.lowering.hybrid import Piece
from acausal.lowering.initial import EASE_ALGEBRAIC
from acausal.lowering.initial_numeric import least_change
from acausal.lowering.numeric import NumericRun, evaluate_dual
from acausal.passes.schedule import Group

from .event_iteration import EventIteration, Move
from .native_library import Floats

Rates = Callable[[float], Floats]
"""Time to the rates of the inputs."""


class EventTangents:
    """Directional derivatives with respect to k values, carried through events.

    Args:
        iteration: has carried the events out.
        rates: of the inputs, at a time.
    """

    def __init__(self, iteration: EventIteration, rates: Rates) -> None:
        self.iteration, self.rates = iteration, rates
        self.low = iteration.problem.lowered
        self.hybrid = iteration.hybrid

    def start(self, moves: list[Move], dz: Floats, dp: Floats) -> tuple[Floats, Floats]:
        """Derivatives behind the start, from those of the consistent start: (n_z, k) and (n_p, k)."""
        dx, dp = self._through(moves, dz[: self.low.n_x], dp.copy(), np.zeros(dz.shape[1]))
        last = moves[-1]
        return self.with_algebraic(last.t, last.z_after, last.p, dx, dp, np.zeros(dz.shape[1])), dp

    def event(
        self, moves: list[Move], p_after: Floats, dz: Floats, dp: Floats, roots: Any, samples: list[int]
    ) -> tuple[Floats, Floats]:
        """Derivatives behind an event, from those before it at its time."""
        low, first = self.low, moves[0]
        k = dz.shape[1]
        fed = self._inputs()
        rate = self._rate(first.t, first.z, first.p)
        dz = self.with_algebraic(first.t, first.z, first.p, dz[: low.n_x], dp, np.zeros(k))
        both = np.concatenate([dz, rate[:, None]], axis=1)
        p_both = np.concatenate([dp, np.zeros((len(dp), 1))], axis=1)
        p_both[fed, k] = self.rates(first.t)
        time = np.zeros(k + 1)
        time[k] = 1.0
        x, w = first.z[: low.n_x], first.z[low.n_x :]
        run = NumericRun(low, first.t, x, w, first.p, np.arange(low.n_x), both, p_both, time, self._groups("switches"))
        tau = self._delay(run, roots, samples, dp)
        along = p_both[:, :k] + np.outer(p_both[:, k], tau)
        dx, moved = self._through(moves, both[: low.n_x, :k] + np.outer(both[: low.n_x, k], tau), along, tau)
        moved[fed] = dp[fed]
        last = moves[-1]
        dx = dx - np.outer(self._rate(last.t, last.z_after, p_after)[: low.n_x], tau)
        return self.with_algebraic(last.t, last.z_after, p_after, dx, moved, np.zeros(k)), moved

    def _groups(self, purpose: str) -> list[Group]:
        """Groups of the schedule that are needed for what switches, for what events change, or for the residuals."""
        hybrid, known = self.hybrid, self.hybrid.closures
        if purpose not in known:
            pieces = {
                "switches": [*hybrid.roots.families, *(piece.rows for piece in hybrid.samples)],
                "changes": [*(piece.rows for piece in hybrid.pres), *(item.piece.rows for item in hybrid.reinits)],
                "residuals": list[Any](),
            }[purpose]
            ids = np.concatenate([np.zeros(0, np.int64), *(rows.var_rows.ravel() for rows in pieces)])
            needed = self.low.closure(ids, residuals=purpose == "residuals")
            known[purpose] = [self.low.schedule.groups[k] for k in needed]
        return known[purpose]

    def _inputs(self) -> slice:
        flat = self.hybrid.flat
        return slice(flat.n_par, flat.n_par + len(flat.inputs))

    def _delay(self, run: NumericRun, roots: Any, samples: list[int], dp: Floats) -> Floats:
        """Derivatives of the time of the event."""
        k = dp.shape[1]
        for piece in self.hybrid.samples:
            for row in np.flatnonzero(np.isin(piece.slots, samples)).tolist():
                forms = evaluate_dual(piece.forms, run.leaf(piece.rows.var_rows, piece.rows.par_rows))
                (start, d_start), (interval, d_interval) = ((np.ravel(v), g) for v, g in forms)
                number = round((run.t - start[row % len(start)]) / interval[row % len(interval)])
                return _row(d_start, row, k) + number * _row(d_interval, row, k)
        if roots is None or not roots.any():
            return np.zeros(k)
        slopes = run.families(self.hybrid.roots.families)[1][np.flatnonzero(roots)]
        passing = slopes[np.argmax(np.abs(slopes[:, k]))]
        return -passing[:k] / passing[k] if passing[k] != 0.0 else np.zeros(k)

    def passing(self, t: float, z: Floats, p: Floats) -> Floats:
        """Time derivatives of the functions of all conditions, (n_roots,)."""
        low = self.low
        dp = np.zeros((len(p), 1))
        dp[self._inputs(), 0] = self.rates(t)
        rate, x, w = self._rate(t, z, p)[:, None], z[: low.n_x], z[low.n_x :]
        run = NumericRun(low, t, x, w, p, np.arange(low.n_x), rate, dp, np.ones(1), self._groups("switches"))
        return run.families(self.hybrid.roots.families)[1][:, 0]

    def _rate(self, t: float, z: Floats, p: Floats) -> Floats:
        """Time derivatives of states and algebraic unknowns."""
        low = self.low
        dx = self.iteration.equations.values(t, z, p)[low.dx_ids]
        dp = np.zeros((len(p), 1))
        dp[self._inputs(), 0] = self.rates(t)
        return self.with_algebraic(t, z, p, dx[:, None], dp, np.ones(1))[:, 0]

    def with_algebraic(self, t: float, z: Floats, p: Floats, dx: Floats, dp: Floats, dt: Floats) -> Floats:
        """Derivatives of z from those of the states, by the implicit-function theorem."""
        low = self.low
        if not low.n_w:
            return dx
        k = dx.shape[1]
        n = low.n_w
        directions = np.zeros((low.n_x + n, k + n))
        directions[: low.n_x, :k] = dx
        directions[low.n_x :, k:] = np.eye(n)
        p_directions = np.concatenate([dp, np.zeros((len(dp), n))], axis=1)
        time = np.concatenate([dt, np.zeros(n)])
        x, w, groups = z[: low.n_x], z[low.n_x :], self._groups("residuals")
        run = NumericRun(low, t, x, w, p, np.arange(low.n_x), directions, p_directions, time, groups)
        slope = run.residual[1]
        dw = np.asarray(np.linalg.lstsq(slope[:, k:], -slope[:, :k], rcond=None)[0], float)
        return np.concatenate([dx, dw])

    def _through(self, moves: list[Move], dx: Floats, dp: Floats, tau: Floats) -> tuple[Floats, Floats]:
        """Total derivatives of states and parameters through the turns of an event."""
        low = self.low
        for move in moves:
            dz = self.with_algebraic(move.t, move.z, move.p, dx, dp, tau)
            x, w = move.z[: low.n_x], move.z[low.n_x :]
            run = NumericRun(low, move.t, x, w, move.p, np.arange(low.n_x), dz, dp, tau, self._groups("changes"))
            dx = self._reinitialized(move, run, dz, dp, tau)
            dp = dp.copy()
            for piece in self.hybrid.pres:
                dp[piece.slots] = self._slopes(piece, run)[0]
        return dx, dp

    def _slopes(self, piece: Piece, run: NumericRun) -> list[Floats]:
        n, k = piece.rows.size, run.n_y
        with np.errstate(all="ignore"):
            found = evaluate_dual(piece.forms, run.leaf(piece.rows.var_rows, piece.rows.par_rows))
        return [np.zeros((n, k)) if g is None else np.broadcast_to(g, (n, k)) for _, g in found]

    def _reinitialized(self, move: Move, run: NumericRun, dz: Floats, dp: Floats, tau: Floats) -> Floats:
        """Derivatives of the states behind `reinit`; `run` goes on with them, for the left limits of the next turn."""
        low = self.low
        states = low.schedule.states
        position = {int(v): i for i, v in enumerate(states.tolist())}
        wanted: dict[int, Floats] = {}
        for item, rows in zip(self.hybrid.reinits, move.reinits, strict=False):
            if len(rows):
                slopes = self._slopes(item.piece, run)[1]
                for row in rows.tolist():
                    wanted[int(item.targets[row])] = item.signs[row] * slopes[row]
        dz = dz.copy()
        for v, slope in wanted.items():
            if v in position:
                dz[position[v]] = slope
        if not wanted:
            return dz[: low.n_x]
        run.value[states] = move.z_after[: low.n_x]
        if move.free is None:
            run.gradient[states] = dz[: low.n_x]
            return dz[: low.n_x]
        ids = np.array(list(wanted), np.int64)
        problem = replace(self.iteration.problem, families=[], targets=ids)
        value = self.iteration.equations.values(move.t, move.z_after, move.p)
        conditions = Conditions(problem, move.t, move.p, ids, value[ids])
        d_wanted = np.array(list(wanted.values())).reshape(len(ids), dz.shape[1])
        rates = conditions.rates(move.z_after, dz, dp, d_wanted, tau)
        columns = np.concatenate([np.flatnonzero(move.free), low.n_x + np.arange(low.n_w)])
        ease = np.concatenate([low.x_nominal, EASE_ALGEBRAIC * low.w_nominal])[columns]
        dz[columns] += ease[:, None] * least_change(conditions(move.z_after)[1][:, columns], ease, rates)
        run.gradient[states] = dz[: low.n_x]
        run.value[ids], run.gradient[ids] = value[ids], d_wanted
        return dz[: low.n_x]


def _row(gradient: Any, row: int, k: int) -> Floats:
    """Gradient of one row, without the direction of time."""
    if gradient is None:
        return np.zeros(k)
    return np.atleast_2d(gradient)[row % len(np.atleast_2d(gradient))][:k]
