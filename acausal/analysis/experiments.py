"""Measurements as users have them, read into plain arrays and checked against the model."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..errors import UnknownNameError
from ..language.template import Floats
from .priors import CalibrationError

if TYPE_CHECKING:
    from ..system import System

TIME_NAMES = ("t", "time")


@dataclass(frozen=True)
class Experiment:
    """One run of the real system.

    Attributes:
        data: what was measured: a dict ``{"t": times, name: values}`` (a value may also be a pair ``(times, values)``
            with times of its own), a `pandas.DataFrame` or a CSV file (column ``t`` or ``time``, or the index), or an
            `xarray.Dataset` (coordinate ``t`` or ``time``). Names are dotted names of variables, in the model's units.
        sigma: standard deviation of the noise in the signal's unit: a number for all signals or one for each name.
            What is missing is estimated from the residuals.
        parameters: values of parameters in this experiment.
        initial: start values of variables in this experiment.
        inputs: inputs of this experiment, as in `System.simulate`.
        free: free parameters and start values of this experiment alone, name to prior or bounds.
        t0: start time [s].
        name: shown in plots and messages; ``experiment 1`` and so on by default.
        missing: ``drop`` to leave out samples that are NaN; they are an error by default.
    """

    data: Any
    sigma: float | Mapping[str, float] | None = None
    parameters: Mapping[str, float] = field(default_factory=dict)
    initial: Mapping[str, float] = field(default_factory=dict)
    inputs: Mapping[str, Any] | None = None
    free: Mapping[str, Any] = field(default_factory=dict)
    t0: float = 0.0
    name: str = ""
    missing: Literal["raise", "drop"] = "raise"


@dataclass(frozen=True, slots=True, eq=False)
class Signal:
    """One measured variable.

    Attributes:
        name: dotted name.
        index: its place in the vector of all variables.
        t: times [s], (n,), increasing.
        y: values, (n,).
        sigma: standard deviation of the noise, or None if it is to be estimated.
    """

    name: str
    index: int
    t: Floats
    y: Floats
    sigma: float | None


def experiments_of(data: Any) -> tuple[Experiment, ...]:
    """What was given as `data` as experiments with names."""
    if isinstance(data, Mapping) and data and all(isinstance(e, Experiment) for e in data.values()):
        return tuple(_named(e, str(name)) for name, e in data.items())
    several = isinstance(data, Sequence) and not isinstance(data, str)
    listed: list[Any] = list(data) if several else [data]
    if not len(listed):
        raise CalibrationError("there is no experiment: `data` is empty")
    made = [e if isinstance(e, Experiment) else Experiment(e) for e in listed]
    named = tuple(_named(e, e.name or f"experiment {k + 1}") for k, e in enumerate(made))
    if len({e.name for e in named}) < len(named):
        raise CalibrationError("two experiments have the same name; give each its own")
    return named


def _named(experiment: Experiment, name: str) -> Experiment:
    fields = {k: getattr(experiment, k) for k in experiment.__dataclass_fields__}
    return Experiment(**{**fields, "name": name})


def signals_of(system: System, experiment: Experiment) -> tuple[Signal, ...]:
    """The measured signals of an experiment.

    Raises:
        UnknownNameError: a signal that the model does not have, with the nearest names.
        CalibrationError: times that do not increase, NaN, lengths that differ, no signal at all.
    """
    where = experiment.name
    columns = _columns(experiment.data, where)
    if not columns:
        raise CalibrationError(f"{where}: the data has times but no signal")
    sigma = experiment.sigma
    if isinstance(sigma, Mapping):
        unknown = [name for name in sigma if name not in columns]
        if unknown:
            raise CalibrationError(f"{where}: `sigma` names `{unknown[0]}`, which the data does not have")
    signals: list[Signal] = []
    for name, (t, y) in columns.items():
        try:
            ids = np.ravel(system.index_of(name))
        except UnknownNameError as error:
            raise UnknownNameError(f"{where}: the data has a signal `{name}`. {error}") from None
        if len(ids) != 1:
            raise CalibrationError(f"{where}: `{name}` is an array of {len(ids)} variables; give each its own signal")
        t, y = _checked(where, name, t, y, experiment)
        noise = sigma.get(name) if isinstance(sigma, Mapping) else sigma
        if noise is not None and not 0 < float(noise) < np.inf:
            raise CalibrationError(f"{where}: the noise of `{name}` must be positive, not {noise}")
        signals.append(Signal(name, int(ids[0]), t, y, None if noise is None else float(noise)))
    return tuple(signals)


def _checked(where: str, name: str, t: Any, y: Any, experiment: Experiment) -> tuple[Floats, Floats]:
    """Times and values of a signal as arrays without fault."""
    try:
        t, y = np.asarray(t, float), np.asarray(y, float)
    except (TypeError, ValueError) as error:
        raise CalibrationError(f"{where}: times or values of `{name}` are not numbers ({error})") from None
    if t.ndim != 1 or t.shape != y.shape:
        raise CalibrationError(f"{where}: `{name}` has values of shape {y.shape} at times of shape {t.shape}")
    bad = np.isnan(y)
    if bad.any() and experiment.missing == "raise":
        k = int(np.argmax(bad))
        raise CalibrationError(
            f"{where}: {int(bad.sum())} of {len(y)} values of `{name}` are NaN, the first at sample {k}, "
            f"t = {t[k]:g} s. "
            'Experiment(..., missing="drop") leaves them out'
        )
    t, y = t[~bad], y[~bad]
    if not len(t):
        raise CalibrationError(f"{where}: `{name}` has no values")
    if not (np.isfinite(t).all() and np.isfinite(y).all()):
        raise CalibrationError(f"{where}: times or values of `{name}` are not finite")
    steps = np.diff(t)
    if (steps <= 0).any():
        k = int(np.argmax(steps <= 0))
        raise CalibrationError(
            f"{where}: the times of `{name}` do not increase: t = {t[k]:g} s at sample {k} is followed by "
            f"{t[k + 1]:g} s"
        )
    if t[0] < experiment.t0:
        raise CalibrationError(
            f"{where}: `{name}` begins at t = {t[0]:g} s, before the start of the experiment at {experiment.t0:g} s; "
            "set Experiment(..., t0=...)"
        )
    return t, y


def _columns(data: Any, where: str) -> dict[str, tuple[Any, Any]]:
    """Signal name to times and values."""
    if isinstance(data, (str, Path)):
        import pandas as pd

        data = pd.read_csv(data, comment="#", skipinitialspace=True)
    if hasattr(data, "data_vars") or hasattr(data, "to_dataset"):
        return _from_xarray(data, where)
    if hasattr(data, "columns") and hasattr(data, "index"):
        time = _time_name(data.columns)
        t = data.index.to_numpy() if time is None else data[time].to_numpy()
        return {str(name): (t, data[name].to_numpy()) for name in data.columns if name != time}
    if not isinstance(data, Mapping):
        raise CalibrationError(
            f"{where}: data of type {type(data).__name__} is not understood; give a dict of arrays, a pandas "
            "DataFrame, an xarray Dataset or the path of a CSV file"
        )
    time = _time_name(data)
    columns: dict[str, tuple[Any, Any]] = {}
    for name, values in data.items():
        if name == time:
            continue
        if isinstance(values, tuple) and len(values) == 2:
            columns[str(name)] = values
        elif time is None:
            raise CalibrationError(
                f"{where}: no times for `{name}`: add an entry `t`, or give the signal as (times, values)"
            )
        else:
            columns[str(name)] = (data[time], values)
    return columns


def _from_xarray(data: Any, where: str) -> dict[str, tuple[Any, Any]]:
    if not hasattr(data, "data_vars"):
        data = data.to_dataset(name=data.name or "signal")
    time = _time_name(data.coords)
    if time is None:
        raise CalibrationError(f"{where}: the xarray data has no coordinate `t` or `time`, but {list(data.coords)}")
    t = data[time].to_numpy()
    return {str(name): (t, variable.to_numpy()) for name, variable in data.data_vars.items()}


def _time_name(names: Iterable[Any]) -> Any:
    """The name of the times among some names, or None."""
    return next((name for name in names if str(name).strip().lower() in TIME_NAMES), None)
