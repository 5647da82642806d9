"""`acausal simulate` and `acausal report`."""

from __future__ import annotations

import argparse
import json
import time
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import acausal as ac

from ..errors import nearest
from .status import Status
from .targets import UsageError, load_model, numbers

if TYPE_CHECKING:
    from ..simulation.solution import Solution
    from ..system import System


def report(chosen: argparse.Namespace, status: Status) -> int:
    """Print what the compiler found."""
    system, _ = _compile(chosen, status)
    if chosen.json:
        found = system.report().to_dict()
        if chosen.equations:
            found["equations"] = system.equations(chosen.equations, latex=chosen.latex).splitlines()
        text = json.dumps(found, indent=2)
    elif chosen.equations:
        text = system.equations(chosen.equations, latex=chosen.latex)
    else:
        text = str(system.report())
    status.clear()
    print(text)
    return 0


def simulate(chosen: argparse.Namespace, status: Status) -> int:
    """Simulate a model, print a summary, draw and save what was asked for."""
    settings, starts = numbers(chosen.settings, "--set"), numbers(chosen.start, "--start")
    if chosen.saveat < 2:
        raise UsageError(f"--saveat {chosen.saveat}: at least 2 points are needed")
    system, compile_seconds = _compile(chosen, status)
    _check_names(settings, system.parameters, "--set", "parameter")
    wanted: Sequence[str] = chosen.plot
    saved: Sequence[str] = chosen.variables or wanted or system.states
    for option, names in (("--start", starts), ("--plot", wanted), ("--variables", saved)):
        _check_variables(system, names, option)
    options: dict[str, Any] = {}
    if chosen.dt is not None:
        options["dt"] = chosen.dt
    status.stage(f"simulating {system.name} to t = {chosen.t1:g} s")
    begin = time.perf_counter()
    solution = system.simulate(
        chosen.t1,
        t0=chosen.t0,
        parameters=settings,
        initial=starts,
        saveat=_times(chosen),
        rtol=chosen.rtol,
        atol=chosen.atol,
        solver=_solver(chosen.solver),
        **options,
    )
    seconds = time.perf_counter() - begin
    shown = wanted or system.states[:12]
    summary = _summary(system, solution, shown, compile_seconds, seconds)
    written = _write(chosen, system, solution, saved, status)
    status.clear()
    print("\n".join([*summary, *written]))
    return 0


def _compile(chosen: argparse.Namespace, status: Status) -> tuple[System, float]:
    status.stage(f"loading {chosen.model}")
    model = load_model(chosen.model, chosen.arg)
    begin = time.perf_counter()
    system = ac.compile(model, progress=lambda stage: status.stage(f"compiling: {stage}"))
    return system, time.perf_counter() - begin


def _check_names(names: Iterable[str], known: Iterable[str], option: str, what: str) -> None:
    listed = list(known)
    for name in names:
        if name not in listed:
            raise UsageError(f"{option} {name}: the model has no {what} `{name}`.{nearest(name, listed)}")


def _check_variables(system: System, names: Iterable[str], option: str) -> None:
    for name in names:
        try:
            system.index_of(name)
        except ac.UnknownNameError as unknown:
            raise UsageError(f"{option} {name}: {unknown}") from None


def _times(chosen: argparse.Namespace) -> Any:
    import numpy as np

    return np.linspace(chosen.t0, chosen.t1, chosen.saveat)


def _solver(name: str | None) -> Any:
    """A solver object by its class name: ours, then those of diffrax."""
    if name is None:
        return None
    import diffrax

    ours = {"Rodas5P": ac.Rodas5P, "RK4": ac.RK4}
    if name in ours:
        return ours[name]()
    found = getattr(diffrax, name, None)
    theirs = [n for n, v in vars(diffrax).items() if isinstance(v, type) and issubclass(v, diffrax.AbstractSolver)]
    concrete = [n for n in theirs if not n.startswith("Abstract")]
    if name not in concrete or found is None:
        raise UsageError(f"--solver {name}: there is no such solver.{nearest(name, [*ours, *concrete])}")
    return found()


def _summary(system: System, solution: Solution, names: Sequence[str], compiled: float, seconds: float) -> list[str]:
    import numpy as np

    stats = solution.stats
    rows = [
        f"{system.name}: {_count(system.states, 'state')}, {_count(system.algebraics, 'algebraic unknown')}",
        f"t = {float(solution.t[0]):g} .. {float(solution.t[-1]):g} s, {len(solution.t)} points, {_steps(stats)}",
        f"compiled in {compiled:.2f} s, solved in {seconds:.2f} s{_split(stats)}",
    ]
    width = max((len(name) for name in names), default=0)
    for name in names:
        values = np.asarray(solution[name])
        unit = solution.describe(name)[0]
        low, high, last = float(values.min()), float(values.max()), values[-1]
        end = f"{float(last):.6g}" if values.ndim == 1 else f"({values.shape[1]} values)"
        rows.append(f"  {name:<{width}}  min {low:<13.6g} max {high:<13.6g} end {end:<13} {unit}".rstrip())
    return rows


def _count(names: Sequence[str], what: str) -> str:
    return f"{len(names)} {what}{'' if len(names) == 1 else 's'}"


def _steps(stats: dict[str, Any]) -> str:
    return f"{int(stats['steps'])} steps" if "steps" in stats else "steps not counted"


def _split(stats: dict[str, Any]) -> str:
    if "compile_seconds" not in stats or "run_seconds" not in stats:
        return ""
    return f" (of which {stats['compile_seconds']:.2f} s JAX compilation and {stats['run_seconds']:.3f} s integration)"


def _write(
    chosen: argparse.Namespace, system: System, solution: Solution, saved: Sequence[str], status: Status
) -> list[str]:
    written: list[str] = []
    if chosen.plot:
        status.stage("drawing")
        import matplotlib

        matplotlib.use("Agg")
        path = chosen.png or Path(f"{system.name}.png")
        path.parent.mkdir(parents=True, exist_ok=True)
        solution.plot(*chosen.plot).savefig(path, dpi=120)
        written.append(f"plot: {path}")
    if chosen.csv:
        status.stage("writing")
        chosen.csv.parent.mkdir(parents=True, exist_ok=True)
        solution.to_csv(chosen.csv, saved)
        written.append(f"data: {chosen.csv}")
    return written
