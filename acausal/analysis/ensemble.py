"""`ensemble`: many simulations of one system, on threads or any executor, and their statistics."""

from __future__ import annotations

import os
import re
import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from concurrent.futures import Executor, Future, ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ..errors import SimulationError, UnknownNameError, nearest
from ..language.template import Floats
from ..simulation.watch import Stop, watch
from ..told import users_level
from .members import Job, Member, Progress, Result, pack, run_elsewhere, run_members

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from ..simulation.solution import Solution
    from ..system import System

CHUNKS_PER_WORKER = 8
LARGEST_CHUNK = 32


@dataclass(frozen=True, slots=True)
class Failure:
    """A member that could not be simulated.

    Attributes:
        index: row of the table.
        parameters: its values.
        reason: message of the error.
    """

    index: int
    parameters: dict[str, float]
    reason: str


@dataclass(frozen=True, slots=True)
class Warned:
    """A warning of a member.

    Attributes:
        index: row of the table.
        parameters: its values.
        text: what it says.
    """

    index: int
    parameters: dict[str, float]
    text: str


def ensemble(
    system: System,
    parameters: Any,
    t1: float,
    *,
    initial: Mapping[str, Any] | None = None,
    names: Sequence[str] | None = None,
    executor: Executor | None = None,
    workers: int | None = None,
    chunk: int | None = None,
    progress: bool | Callable[[int, int, int], None] = True,
    **options: Any,
) -> Ensemble:
    """Simulate a system once for each row of a table.

    Args:
        system: a compiled model.
        parameters: the table: a `pandas.DataFrame`, a dict of arrays of the same length (numbers are the same for
            all), or a sequence of dicts; columns are dotted names of parameters, or of variables whose start value is
            meant.
        t1: end time [s].
        initial: start values of variables: numbers, or arrays as long as the table.
        names: variables to keep; by default the outputs given to `acausal.compile`, else the states.
        executor: where to run: any `concurrent.futures.Executor`, as ``dask.distributed.Client(...).get_executor()``;
            threads of this process by default.
        workers: number of threads; default one a processor.
        chunk: members in one task; by default some tasks for each worker.
        progress: show how far it is, from one second on; or a function of (done, failed, total).
        **options: of `System.simulate`: `saveat`, `rtol`, `inputs` and so on.

    Returns:
        the members' trajectories. Members that failed are listed in `failures` and are NaN; what members were warned of
        is in `warnings`, and is said once for all of them.

    Raises:
        UnknownNameError: a column that the model does not have.
        SimulationError: every member failed.
    """
    import pandas as pd

    table = _table(parameters, initial)
    kept = tuple(names) if names is not None else system.outputs or system.states
    if not kept:
        raise SimulationError(
            f"`{system.name}` has neither states nor outputs: say which variables are to be kept, `names=[...]`"
        )
    for name in kept:
        if np.size(system.index_of(name)) != 1:
            raise SimulationError(f"`{name}` is an array; name the elements that an ensemble is to keep")
    members = _members(system, table)
    job = Job(kept, float(t1), options)
    meter = Progress(len(members), progress)
    results = _run(system, job, members, executor, workers or os.cpu_count() or 1, chunk, meter)
    meter.end()
    good = [r for r in results if r.values is not None]
    failures = tuple(Failure(r.index, _values(table, r.index), r.reason) for r in results if r.reason)
    warned = tuple(Warned(r.index, _values(table, r.index), text) for r in results for text in r.warnings)
    for text in _summaries(warned, len(members)):
        warnings.warn(text, stacklevel=users_level())
    if not good:
        raise SimulationError(f"all {len(members)} members failed; the first one: {failures[0].reason}")
    if failures:
        first = failures[0]
        warnings.warn(
            f"{len(failures)} of {len(members)} members failed (see `failures`); member {first.index}, "
            f"{first.parameters}: {first.reason}",
            RuntimeWarning,
            stacklevel=users_level(),
        )
    t = good[0].t
    assert t is not None
    values = np.full((len(members), len(t), len(kept)), np.nan)
    for r in good:
        values[r.index] = r.values
    return Ensemble(system, pd.DataFrame(table), t, kept, values, failures, warned, job)


class Ensemble:
    """Trajectories of many members.

    ``ensemble["x"]`` is an array (n_members, n_t).

    Attributes:
        system: the system.
        table: a row a member: its parameters and start values.
        t: times [s], (n_t,).
        names: variables kept.
        values: (n_members, n_t, n_names); NaN for members that failed.
        failures: members that failed.
        warnings: what members were warned of.
        job: end time and options of the simulations.
    """

    def __init__(
        self, system: System, table: pd.DataFrame, t: Floats, names: tuple[str, ...], values: Floats,
        failures: tuple[Failure, ...], warnings: tuple[Warned, ...], job: Job,
    ) -> None:  # fmt: skip
        self.system = system
        self.table = table
        self.t = t
        self.names = names
        self.values = values
        self.failures = failures
        self.warnings = warnings
        self.job = job

    def __len__(self) -> int:
        return len(self.table)

    def __getitem__(self, name: str) -> Floats:
        """Values of a variable, (n_members, n_t).

        Raises:
            UnknownNameError: it was not kept.
        """
        if name not in self.names:
            raise UnknownNameError(
                f"the ensemble has not kept `{name}`.{nearest(name, self.names)} Name it in `names=`"
            )
        return self.values[:, :, self.names.index(name)]

    @property
    def succeeded(self) -> Any:
        """Which members were simulated, bool (n_members,)."""
        failed = {f.index for f in self.failures}
        return np.array([k not in failed for k in range(len(self))])

    def member(self, index: int) -> Solution:
        """The full solution of one member, simulated again."""
        one = _members(self.system, self.table.iloc[[index]])[0]
        return self.system.simulate(self.job.t1, parameters=one.parameters, initial=one.initial, **self.job.options)

    def quantile(self, name: str, q: Any) -> Floats:
        """Quantiles over the members that succeeded: (n_t,), or (n_q, n_t) for several."""
        return np.quantile(self[name][self.succeeded], q, axis=0)

    def statistics(self, name: str) -> pd.DataFrame:
        """Mean, standard deviation, extremes and quantiles of a variable over time, members that failed left out."""
        import pandas as pd

        values = self[name][self.succeeded]
        spread = values.std(axis=0, ddof=1) if len(values) > 1 else np.zeros(len(self.t))
        columns = {"mean": values.mean(axis=0), "std": spread, "min": values.min(axis=0)}
        for q in (0.05, 0.25, 0.5, 0.75, 0.95):
            columns[f"{q:.0%}"] = np.quantile(values, q, axis=0)
        return pd.DataFrame({**columns, "max": values.max(axis=0)}, index=pd.Index(self.t, name="t"))

    def to_xarray(self) -> xr.Dataset:
        """A dataset over member and t, the table as coordinates of the members, with units and descriptions."""
        import xarray as xr

        data = {}
        for k, name in enumerate(self.names):
            declaration = self.system.declaration_of(name)
            about = {"units": declaration.unit, "long_name": declaration.doc}
            data[name] = (("member", "t"), self.values[:, :, k], {a: v for a, v in about.items() if v})
        coordinates = {str(c): ("member", self.table[c].to_numpy()) for c in self.table.columns if c not in data}
        starts = {f"{c} (start)": ("member", self.table[c].to_numpy()) for c in self.table.columns if c in data}
        member = {"member": np.arange(len(self)), "t": ("t", self.t, {"units": "s"})}
        return xr.Dataset(data, {**member, **coordinates, **starts})

    def to_dataframe(self) -> pd.DataFrame:
        """The table with the variables' values at the end, a row a member."""
        import pandas as pd

        columns = [f"{name} (end)" for name in self.names]
        return pd.concat([self.table, pd.DataFrame(self.values[:, -1], self.table.index, columns)], axis=1)

    def plot(self, *names: str, quantiles: tuple[float, float] = (0.05, 0.95), members: int = 0) -> Any:
        """Median and bands between quantiles over time, one axis a variable; returns the figure.

        Args:
            names: variables; all that were kept by default.
            quantiles: ends of the outer band; the inner one holds the middle half.
            members: number of single members to draw as well.
        """
        from .ensemble_plot import plot_ensemble

        return plot_ensemble(self, names or self.names, quantiles, members)

    def __repr__(self) -> str:
        failed = f", {len(self.failures)} failed" if self.failures else ""
        names = ", ".join(self.names)
        return f"Ensemble({self.system.name}: {len(self)} members{failed}, {len(self.t)} times, {names})"


# ---- running --------------------------------------------------------------------------------------------------------
_NUMBER = re.compile(r"(?<=[ =])[-+]?\d[\d.]*(?:e[-+]?\d+)?(?=[ ,;\n]|$)")


def _summaries(warned: Sequence[Warned], total: int) -> Iterator[str]:
    """For each warning what to say of all members that have it; those that differ in numbers alone are one."""
    alike: dict[str, dict[int, Warned]] = {}
    for one in warned:
        alike.setdefault(_NUMBER.sub("", one.text), {}).setdefault(one.index, one)
    for members in alike.values():
        first = next(iter(members.values()))
        yield (
            f"{len(members)} of {total} members have this warning (see `warnings`); member {first.index}, "
            f"{first.parameters}: {first.text}"
        )


def _run(
    system: System, job: Job, members: list[Member], executor: Executor | None, workers: int, chunk: int | None,
    meter: Progress,
) -> list[Result]:  # fmt: skip
    """Results of all members, by index."""
    results: list[Result] = []

    def take(found: list[Result]) -> None:
        results.extend(found)
        meter.add(found)

    if executor is None or isinstance(executor, ThreadPoolExecutor):
        take(run_members(system, job, members[:1]))  # the first one compiles, for all threads
        rest = members[1:]
        pool = executor or ThreadPoolExecutor(workers)
        stop = Stop()

        def until(part: list[Member]) -> list[Result]:
            with watch.stopping(stop):
                return run_members(system, job, part)

        try:
            chunks = _chunks(rest, chunk, pool._max_workers)
            _collect({pool.submit(until, part): part for part in chunks}, take)
        finally:
            stop.asked = True
            if executor is None:
                pool.shutdown(cancel_futures=True)
    else:
        recipe, what = pack(system), pack(job)
        chunks = _chunks(members, chunk, getattr(executor, "_max_workers", None) or workers)
        _collect({executor.submit(run_elsewhere, recipe, what, part): part for part in chunks}, take)
    return sorted(results, key=lambda r: r.index)


def _collect(futures: Mapping[Future[list[Result]], list[Member]], take: Callable[[list[Result]], None]) -> None:
    """Results as they come; a task that was lost with its worker is a failure of its members."""
    for future in as_completed(futures):
        try:
            take(future.result())
        except Exception as error:  # whatever an executor raises for a lost or broken task
            reason = f"{type(error).__name__}: {error}"
            take([Result(m.index, None, None, reason) for m in futures[future]])


def _chunks(members: list[Member], size: int | None, workers: int) -> list[list[Member]]:
    size = size or max(1, min(LARGEST_CHUNK, len(members) // (CHUNKS_PER_WORKER * workers)))
    return [members[k : k + size] for k in range(0, len(members), size)]


def _values(table: pd.DataFrame, row: int) -> dict[str, float]:
    """What is in one row of a table, for messages."""
    return {str(name): float(value) for name, value in table.iloc[row].items()}


def _table(parameters: Any, initial: Mapping[str, Any] | None) -> pd.DataFrame:
    """One data frame of everything that differs between members."""
    import pandas as pd

    if isinstance(parameters, Mapping):
        parameters = {name: np.asarray(v, float) for name, v in parameters.items()}
        lengths = {name: len(v) for name, v in parameters.items() if v.ndim}
        if len(set(lengths.values())) > 1:
            text = ", ".join(f"`{name}` {n}" for name, n in lengths.items())
            raise SimulationError(f"the columns of the table differ in length: {text}")
        n = next(iter(lengths.values()), 1)
        table = pd.DataFrame({name: np.broadcast_to(v, n) for name, v in parameters.items()}, index=range(n))
    else:
        table = pd.DataFrame(parameters).reset_index(drop=True)
    for name, value in (initial or {}).items():
        if name in table.columns:
            raise SimulationError(f"`{name}` is in the table and in `initial`")
        if np.ndim(value) and not len(table.columns):
            table = pd.DataFrame(index=range(np.size(value)))
        if np.ndim(value) and np.size(value) != len(table):
            raise SimulationError(f"`{name}` has {np.size(value)} start values for {len(table)} members")
        table[name] = np.broadcast_to(np.asarray(value, float), len(table))
    if not len(table):
        raise SimulationError("the table has no row: there is nothing to simulate")
    missing = table.columns[table.isna().any()]
    if len(missing):
        raise SimulationError(f"the table has NaN in column `{missing[0]}`")
    return table


def _members(system: System, table: pd.DataFrame) -> list[Member]:
    """The rows of the table, each name known to be a parameter or a variable."""
    flat = system.stages.flat
    columns = [str(c) for c in table.columns]
    is_parameter: list[bool] = []
    for name in columns:
        try:
            _, found = flat.names.find(name)
        except UnknownNameError as error:
            raise UnknownNameError(f"the table has a column `{name}`. {error}") from None
        is_parameter.append(bool(found))
    members: list[Member] = []
    for k, row in enumerate(table.to_numpy(float)):
        values = list(zip(columns, is_parameter, row.tolist(), strict=True))
        members.append(Member(k, {n: v for n, par, v in values if par}, {n: v for n, par, v in values if not par}))
    return members
