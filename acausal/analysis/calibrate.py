"""`calibrate`: parameters and start values of a model from measurements, with their uncertainty."""

from __future__ import annotations

import os
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..language.template import Floats
from .experiments import experiments_of
from .fit import Fit
from .least_squares import fit_program
from .priors import CalibrationError
from .residuals import FAILED, Problem

if TYPE_CHECKING:
    from ..system import System

NOISE_ROUNDS, NOISE_CHANGE = 6, 0.01
"""Rounds of estimating unknown noise, and the relative change at which they end."""
NOISE_GUESS, NOISE_FLOOR = 0.05, 1e-9
"""First guess and least value of unknown noise, as a part of the spread of the signal."""

DEPENDENT = 1e-6
"""Singular value of the scaled Jacobian below which a combination of parameters takes no degree of freedom."""


def calibrate(
    system: System,
    data: Any,
    free: Mapping[str, Any],
    *,
    sigma: float | Mapping[str, float] | None = None,
    parameters: Mapping[str, float] | None = None,
    initial: Mapping[str, float] | None = None,
    start: Mapping[str, float] | None = None,
    starts: int = 1,
    seed: int = 0,
    tolerance: float = 0.01,
    iterations: int = 100,
    rtol: float = 1e-6,
    atol: float | None = None,
    engine: Literal["auto", "diffrax", "native"] = "auto",
    max_steps: int = 100_000,
    **options: Any,
) -> Fit:
    """Find the values of free parameters and start values for which the model reproduces the data.

    Minimizes the sum of squares of the deviations, each in units of its noise, plus those of the priors
    (Levenberg-Marquardt with exact sensitivities). Where the noise of a signal is not given it is estimated from the
    residuals, and the signals are weighted by it. A simulation that fails on the way costs a smaller step.

    Args:
        system: a compiled model.
        data: an `Experiment`, several (a list, or a dict by name), or the data of one as `Experiment` takes it.
        free: dotted name of a parameter, or of a variable whose start value is sought, to bounds ``(lo, hi)``,
            `Bounds`, `LogBounds`, `Normal` or `LogNormal`, in the model's units.
        sigma: noise of the signals, for data that is no `Experiment`.
        parameters: values of other parameters in all experiments.
        initial: start values of variables in all experiments.
        start: where to begin, by name; default the model's own values.
        starts: number of starts; those after the first are drawn from bounds and priors (Latin hypercube).
        seed: of that draw.
        tolerance: the iteration ends where its next step would move no value by more than this part of its standard
            error.
        iterations: most iterations of each start.
        rtol, atol, engine, max_steps: of the simulations, as in `System.simulate`.
        **options: further options of `System.simulate`.

    Raises:
        CalibrationError, UnknownNameError: data or `free` is not as it should be; see the message.
        SimulationError: the model cannot be simulated at any of the starts.
    """
    experiments = experiments_of(data)
    shared = {"parameters": dict(parameters or {}), "initial": dict(initial or {})}
    experiments = tuple(_with(e, sigma, **shared) for e in experiments)
    settings = {"rtol": rtol, "atol": atol, "engine": engine, "max_steps": max_steps, **options}
    problem = Problem(system, experiments, free, start or {}, settings)
    begins = _begins(problem, starts, seed)
    search = Search(problem, float(tolerance), int(iterations))
    noise = Noise(problem)
    found = search.best(begins, noise.samples)
    tried = found
    for _ in range(NOISE_ROUNDS):
        if not noise.update(problem, found[0].values):
            break
        found = [search.run(found[0].z, noise.samples)]
    return Fit(problem, search, found[0], noise, tried)


def _with(experiment: Any, sigma: Any, parameters: dict[str, float], initial: dict[str, float]) -> Any:
    from dataclasses import replace

    return replace(
        experiment,
        sigma=experiment.sigma if experiment.sigma is not None else sigma,
        parameters={**parameters, **experiment.parameters},
        initial={**initial, **experiment.initial},
    )


@dataclass(frozen=True, slots=True, eq=False)
class Outcome:
    """Where one search ended.

    Attributes:
        z: internal coordinates, (n_free,).
        values: values, (n_free,).
        cost: half the sum of squares.
        iterations: of the optimizer.
        converged: whether it ended by its tolerance.
        begin: where it began, as values.
    """

    z: Floats
    values: Floats
    cost: float
    iterations: int
    converged: bool
    begin: Floats


class Search:
    """The compiled optimizer of a problem.

    Attributes:
        problem: what is fitted.
        tolerance, iterations: see `calibrate`.
    """

    def __init__(self, problem: Problem, tolerance: float, iterations: int) -> None:
        self.problem = problem
        self._fit = problem.program("fit", fit_program, tolerance, iterations)

    def run(self, z0: Any, sigma: Any, held: Any = None) -> Outcome:
        """One search from internal coordinates `z0`; coordinates marked by `held` keep their value."""
        n = len(self.problem.free)
        held = np.zeros(n, bool) if held is None else held
        z0 = np.asarray(z0, float)
        z, cost, steps, converged = self._fit(z0, held, self.problem.arguments(sigma))
        z = np.asarray(z)
        return Outcome(z, self._values(z), float(cost), int(steps), bool(converged), self._values(z0))

    def best(self, begins: list[Floats], sigma: Any) -> list[Outcome]:
        """Searches from several starts, the best first.

        Raises:
            SimulationError: the model cannot be simulated at any start.
        """
        first = self.run(begins[0], sigma)
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            others = list(pool.map(lambda z0: self.run(z0, sigma), begins[1:]))
        found = sorted([first, *others], key=lambda o: o.cost)
        if not found[0].cost < 0.4 * FAILED**2:
            self._explain(first.begin)
            raise CalibrationError(
                "the simulation fails at every start, in a way that it does not show with plain numbers; "
                "try other starts"
            )
        return found

    def _values(self, z: Floats) -> Floats:
        pairs = [(f.prior, *f.prior.numbers) for f in self.problem.free]
        return np.array([prior.value(a + b * x) for (prior, a, b), x in zip(pairs, z.tolist(), strict=True)])

    def _explain(self, values: Floats) -> None:
        """Simulate each experiment with plain numbers, so that the failure is raised with its reason."""
        for k in range(len(self.problem.experiments)):
            simulate_experiment(self.problem, k, values)


def simulate_experiment(problem: Problem, k: int, values: Any, saveat: Any = None) -> Any:
    """The solution of experiment `k` with these values of the free quantities, at its samples or other times."""
    experiment = problem.experiments[k]
    parameters, initial = dict(experiment.parameters), dict(experiment.initial)
    for f, value in zip(problem.free, values, strict=True):
        if f.experiment in (-1, k):
            (initial if f.initial else parameters)[f.target] = float(value)
    t = np.unique(np.concatenate([s.t for s in problem.signals[k]]))
    return problem.system.simulate(
        float(t[-1]), t0=experiment.t0, parameters=parameters, initial=initial, inputs=experiment.inputs,
        saveat=t if saveat is None else saveat, **problem.options,
    )  # fmt: skip


class Noise:
    """Standard deviation of every sample, known or estimated.

    Signals of one name share an estimate over all experiments.

    Attributes:
        samples: (n,) in the order of the residual vector.
        estimated: names of the signals whose noise is estimated.
    """

    def __init__(self, problem: Problem) -> None:
        self.samples = np.ones(problem.size)
        self._rows: dict[str, list[slice]] = {}
        self._floor: dict[str, float] = {}
        for e, s, rows in problem.order:
            signal = problem.signals[e][s]
            if signal.sigma is not None:
                self.samples[rows] = signal.sigma
                continue
            self._rows.setdefault(signal.name, []).append(rows)
            spread = float(np.ptp(signal.y)) or float(np.max(np.abs(signal.y))) or 1.0
            self._floor[signal.name] = max(self._floor.get(signal.name, 0.0), spread)
        for name, rows in self._rows.items():
            for part in rows:
                self.samples[part] = NOISE_GUESS * self._floor[name]

    @property
    def estimated(self) -> tuple[str, ...]:
        return tuple(self._rows)

    def update(self, problem: Problem, values: Floats) -> bool:
        """Estimates unknown noise from the residuals at a fit; whether it changed.

        The sum of squares of a signal is divided by its samples less its part of the free quantities (its leverage;
        Seber and Wild, Nonlinear Regression, 4.2).
        """
        if not self._rows:
            return False
        r, jacobian = problem.residual_and_jacobian(values, self.samples)
        lengths = np.linalg.norm(jacobian, axis=0)
        basis, strength, _ = np.linalg.svd(jacobian / np.where(lengths > 0, lengths, 1.0), full_matrices=False)
        leverage = (basis[:, strength > DEPENDENT] ** 2).sum(axis=1)
        changed = False
        for name, parts in self._rows.items():
            old = self.samples[parts[0]][0]
            square = sum(float((r[part] ** 2).sum()) for part in parts)
            freedom = sum(float((1.0 - leverage[part]).sum()) for part in parts)
            new = max(old * float(np.sqrt(square / max(freedom, 1.0))), NOISE_FLOOR * self._floor[name])
            changed |= abs(new - old) > NOISE_CHANGE * old
            for part in parts:
                self.samples[part] = new
        return changed


def _begins(problem: Problem, starts: int, seed: int) -> list[Floats]:
    """Internal coordinates of the starts."""
    if starts < 1:
        raise CalibrationError(f"starts={starts}: at least one start is needed")
    first = np.array([f.prior.internal(f.start) for f in problem.free])
    if starts == 1:
        return [first]
    from scipy.stats import qmc

    draws = qmc.LatinHypercube(len(problem.free), rng=seed).random(starts - 1)
    drawn = [
        np.array([f.prior.internal(float(f.prior.quantile(u))) for f, u in zip(problem.free, row, strict=True)])
        for row in np.clip(draws, 1e-3, 1 - 1e-3)
    ]
    return [first, *drawn]
