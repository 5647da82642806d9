"""A solution beside the flat equations: their residuals, and other integrators on them.

Between events the modes are held, so that each stretch is a smooth DAE ``F(t, v, v') = 0``, of whatever index the model
as written has. It becomes ``x' = d, 0 = F(t, x, z)`` with the derivatives d among the unknowns z, and nothing else is
done to it. Where F can be solved for z (index 1), SUNDIALS' IDAS integrates it. Where it cannot, Radau collocation does
(both in CasADi): that is stable and convergent for the higher indices of mechanics, without index reduction (Hairer and
Wanner, Solving Ordinary Differential Equations II, ch. VII.4). Its Newton steps are whole: between residuals of
different units a line search shortens them to nothing. What was held is checked against what it stands for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import casadi as ca
import numpy as np
from numpy.typing import NDArray

from .docstrings import Run
from .flat_equations import FlatEquations

Floats = NDArray[np.float64]
NODES = (1.0 - np.cos(np.pi * np.linspace(0.0, 1.0, 9))) / 2.0
"""Times at which solutions are compared, as parts of the stretch between two events."""
MIDDLE = len(NODES) // 2
RTOL = 1e-10
CLOSE = 1e-9
"""Events closer than this part of the run are one; so long before an event its left limits are taken."""
SHORT = 0.1
"""An example that looks at the start only is run so long [s]."""
ELEMENTS = 8, 32, 128
"""Finite elements of collocation, until the solutions agree."""
AGREES = 1e-5
"""Largest difference between two solutions, relative to the size of each variable."""
FLOOR = 1e-7
"""Terms and variables smaller than this may be what rounding leaves of zero."""
AMPLIFIED = 1e-6, 1e-2
"""The same for states and for unknowns, where collocation differentiates: it amplifies rounding."""
SOLVED = 1e-6
"""Largest residual where Newton's method converged, relative to the size of the terms, at least `AMPLIFIED[1]`."""


@dataclass(frozen=True, eq=False)
class Stretch:
    """What `simulate` gives between two events.

    Attributes:
        t: times [s], shape (n,).
        v: all variables of the flat model, shape (n_total, n).
        modes: what is held.
    """

    t: Floats
    v: Floats
    modes: Floats


class Check:
    """One example's simulation beside its flat equations.

    Attributes:
        equations: the flat equations of its model.
        stretches: the solution between events.
        size: largest value of each variable, at least `FLOOR`.
    """

    def __init__(self, run: Run) -> None:
        assert run.system.made_from is not None
        self.equations = FlatEquations(run.system.made_from[0])
        t1 = run.t1 or SHORT
        options = {**run.options, "rtol": RTOL}
        first = run.system.simulate(t1, **{**options, "saveat": np.array([0.0, t1])})
        t1 = float(first.t[-1])  # a model may end its run
        spans = _spans([0.0, *(event.t for event in first.events), t1], CLOSE * t1)
        times = np.concatenate([a + (b - a) * NODES for a, b in spans])
        solution = run.system.simulate(t1, **{**options, "saveat": times})
        values = np.asarray(solution._values(np.arange(self.equations.flat.n_total)), float).T
        self.stretches: list[Stretch] = []
        for k in range(len(spans)):
            part = slice(k * len(NODES), (k + 1) * len(NODES))
            t, v = times[part], values[:, part]
            self.stretches.append(Stretch(t, v, self.equations.settled(t[MIDDLE], v[:, MIDDLE])))
        self.size = np.maximum(np.abs(values).max(axis=1), FLOOR)


def _spans(times: list[float], close: float) -> list[tuple[float, float]]:
    """Stretches between times that are not close to each other, without what an event is close to."""
    return [
        (a, b if last else b - 0.1 * close)
        for a, b, last in zip(times[:-1], times[1:], [*(False for _ in times[2:]), True], strict=True)
        if b - a > close
    ]


class Integrators:
    """IDAS and Radau collocation on the flat equations of one model, on stretches of any length.

    Attributes:
        regular: whether the equations can be solved for everything but the states: index 1 or less.
    """

    def __init__(self, equations: FlatEquations, size: Floats) -> None:
        self.equations, self.size = equations, size
        self.x = equations.states.tolist()
        self.z = np.setdiff1d(np.arange(equations.flat.n_total), self.x).tolist()
        y, w = ca.SX.sym("y", max(len(self.x), 1)), ca.SX.sym("w", len(self.z))
        span, tau, start = ca.SX.sym("span", 2), ca.SX.sym("tau"), ca.SX.sym("start", len(self.x))
        v = ca.SX(equations.flat.n_total, 1)
        v[self.z] = w * size[self.z]
        if self.x:
            v[self.x] = start + y * size[self.x]  # from the start: the derivative of a constant is zero to the last bit
        t = span[0] + (span[1] - span[0]) * tau
        (residual,) = ca.substitute([equations.residual], [equations.t, equations.v], [t, v])
        slopes = v[equations.flat.derivative_of[self.x].tolist()] / size[self.x] if self.x else ca.SX(0)
        jacobian = ca.jacobian(residual, w)
        self.regular = jacobian.shape[0] == jacobian.shape[1] == ca.sprank(jacobian)
        self.problem = {
            "t": tau, "x": y, "z": w, "p": ca.vertcat(span, start, equations.m),
            "ode": (span[1] - span[0]) * slopes, "alg": residual,
        }  # fmt: skip

    @cached_property
    def idas(self) -> Any:
        """SUNDIALS' IDAS: variable order and step."""
        options = {"abstol": 10 * RTOL, "reltol": 10 * RTOL, "max_num_steps": 100_000}
        return ca.integrator("run", "idas", self.problem, 0.0, NODES.tolist(), options)

    def collocation(self, elements: int) -> Any:
        """Radau collocation with five points in each finite element."""
        newton = {"abstol": 1e-11, "max_iter": 20, "line_search": False, "error_on_fail": False}
        options = {
            "interpolation_order": 5, "collocation_scheme": "radau", "number_of_finite_elements": elements,
            "rootfinder": "newton", "rootfinder_options": newton,
        }  # fmt: skip
        return ca.integrator("run", "collocation", self.problem, 0.0, NODES.tolist(), options)

    def run(self, integrator: Any, stretch: Stretch) -> Floats:
        """All variables on the times of a stretch, (n_total, n), from its start; nan where the integrator fails."""
        size, found = self.size[:, None], np.full(stretch.v.shape, np.nan)
        start = stretch.v[self.x, 0]
        given = np.concatenate([stretch.t[[0, -1]], start, stretch.modes])
        try:
            result = integrator(x0=0.0, z0=stretch.v[self.z, 0] / self.size[self.z], p=given)
        except RuntimeError:  # which says that the integrator failed; the caller goes on to another
            return found
        if self.x:
            found[self.x] = start[:, None] + result["xf"].full() * size[self.x]
        found[self.z] = result["zf"].full() * size[self.z]
        return found

    def collocate(self, elements: int, stretch: Stretch) -> Floats:
        """What collocation makes of a stretch, as `run` gives it, but nan where Newton's method does not converge."""
        found = self.run(self.collocation(elements), stretch)
        found[:, 0] = stretch.v[:, 0]  # it gives no unknowns at the start, and does not need them
        left, sizes = _residuals(self.equations, replace(stretch, v=found))
        if (left > SOLVED * (sizes + AMPLIFIED[1])).any():  # where an unknown is nan it says so itself
            found[:] = np.nan
        return found

    def disagreement(self, stretch: Stretch) -> float:
        """Largest difference to another integrator's solution, relative to the size of each variable.

        Where collocation stands in for IDAS, the states count: they determine the unknowns of regular equations, which
        have their residuals, and derivatives of stiff states are less precise.
        """
        best = np.inf
        if self.regular:
            found = self.run(self.idas, stretch)
            best = _largest(np.abs(found - stretch.v).max(axis=1) / self.size)
        size, counts = self.size, self.x
        if not self.regular:
            counts, floor = np.arange(len(size)), np.full(len(size), AMPLIFIED[1])
            floor[self.x] = AMPLIFIED[0]
            size = np.maximum(size, floor)
        for elements in ELEMENTS:
            if best <= AGREES:
                break
            found = self.collocate(elements, stretch)
            best = min(best, _largest((np.abs(found - stretch.v).max(axis=1) / size)[counts]))
        return best


def _largest(errors: Floats) -> float:
    """The largest of some errors; nan is infinite."""
    return float(np.max(np.where(np.isnan(errors), np.inf, errors), initial=0.0))


def _residuals(equations: FlatEquations, stretch: Stretch) -> tuple[Floats, Floats]:
    """Largest residual of each flat equation on a stretch, and largest size of its terms."""
    n = len(stretch.t)
    modes = np.tile(stretch.modes[:, None], (1, n))
    left, sizes, _ = equations.evaluate.map(n)(stretch.t[None], stretch.v, modes)
    return np.abs(left.full()).max(axis=1), sizes.full().max(axis=1)


def residual(check: Check) -> tuple[float, str]:
    """Largest residual of the flat equations relative to the size of their terms, and the equation with its place."""
    worst = (0.0, "")
    for stretch in check.stretches:
        left, sizes = _residuals(check.equations, stretch)
        relative = left / (sizes + FLOOR)
        relative = np.where(np.isnan(relative), np.inf, relative)
        k = int(np.argmax(relative))
        worst = max(worst, (float(relative[k]), check.equations.places[k]))
    return worst


def broken(check: Check) -> list[str]:
    """Conditions in equations that do not stay as they are between two events; that of a `when` may cease to hold."""
    matter = ca.which_depends(check.equations.residual, check.equations.m)
    found: list[str] = []
    for stretch in check.stretches:
        at_times = [check.equations.subjects(t, v, stretch.modes) for t, v in zip(stretch.t, stretch.v.T, strict=True)]
        for k, mode in enumerate(check.equations.modes):
            if mode.kind != "relation" or not matter[k]:
                continue
            x = np.array([subjects[k][0] for subjects in at_times])
            beyond = np.max(x) if stretch.modes[k] else -np.min(x)
            if beyond > max(AGREES * np.max(np.abs(x)), FLOOR):
                found.append(f"from {stretch.t[0]:g} s to {stretch.t[-1]:g} s: {mode.value}")
    return found
