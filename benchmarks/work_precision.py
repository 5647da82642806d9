"""Work and precision on the extended crane: the engines beside CVODE from C, and what Python users have.

    python -m benchmarks.work_precision --cvode path/to/kbc_cvode.c

Without `--cvode`, without its libraries, or without one of the packages, that tool is left out. Tools of the `bench`
extra: CasADi, scikit-SUNDAE.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.peers import integrators
from benchmarks.peers.integrators import CvodeProgram, Outcome, Tool
from benchmarks.peers.methods import NAMES as METHODS
from benchmarks.peers.methods import Methods
from benchmarks.results import Section, write

LEVELS = (1e-4, 1e-6, 1e-8)
DENSE = tuple(float(10.0**k) for k in np.arange(-3, -11.1, -0.5))
MEDIUM = tuple(10.0**k for k in range(-3, -12, -1))
FEW = tuple(10.0**k for k in range(-3, -10, -1))
FIGURE = Path(__file__).with_name("work_precision.png")
PEER, OURS, STOCK = "CVODE from C", "native engine, the solve", "stock diffrax (Kvaerno5)"

Curve = list[tuple[float, Outcome, float]]
"""Tolerance, outcome, error."""


def error(y: Any, reference: Any) -> float:
    """Root mean square over all states and times of the deviation relative to the range of each state."""
    return float(np.sqrt(np.mean(((y - reference) / np.ptp(reference, axis=0)) ** 2)))


def at_level(curve: Curve, level: float) -> float | None:
    """Milliseconds for an error, log-log interpolated on the curve of what was best so far; None outside of it."""
    frontier: list[tuple[float, float]] = []
    for _, outcome, e in sorted(curve, key=lambda c: c[1].milliseconds):
        if not frontier or e < frontier[-1][1]:
            frontier.append((outcome.milliseconds, e))
    times, errors = (np.log([f[i] for f in frontier][::-1]) for i in (0, 1))
    if not errors[0] <= np.log(level) <= errors[-1]:
        return None
    return float(np.exp(np.interp(np.log(level), errors, times)))


def tools(joint: str, cvode: CvodeProgram | None, quick: bool) -> dict[str, tuple[Callable[[], Tool], Any]]:
    """Tool and its tolerances by name; made when its turn comes."""
    crane = integrators.Crane(joint)
    many, few, one = (5, 2, 1) if quick else (20, 4, 1)
    native = integrators.native(crane, many)
    named: dict[str, tuple[Callable[[], Tool], Any]] = {}
    if cvode is not None:
        named[PEER] = lambda: cvode.tool(joint, many), DENSE
    named[OURS] = lambda: native[0], DENSE
    named["native engine, `simulate`"] = lambda: native[1], DENSE
    methods = Methods(crane)
    for name in METHODS if methods.cvode else METHODS[:-1]:
        named[f"{name} on the same C"] = lambda name=name: methods.tool(name, many), DENSE
    named["CasADi CVODES"] = lambda: integrators.casadi_tool(crane, "cvodes", few), MEDIUM
    named["CasADi IDAS"] = lambda: integrators.casadi_tool(crane, "idas", few), MEDIUM
    named["diffrax engine (Rodas5P)"] = lambda: integrators.diffrax_engine(crane, few), MEDIUM
    named["SciPy LSODA"] = lambda: integrators.scipy_tool(crane, "LSODA", one), MEDIUM
    named["scikit-SUNDAE CVODE"] = lambda: integrators.sundae(crane, one), MEDIUM
    named["SciPy Radau"] = lambda: integrators.scipy_tool(crane, "Radau", one), FEW
    named[STOCK] = lambda: integrators.stock_diffrax(crane, one), FEW
    return named


def measure(
    joint: str, cvode: CvodeProgram | None, only: list[str] | None, quick: bool
) -> tuple[dict[str, Curve], str]:
    """Curves of all tools, and how well the reference is known."""
    crane = integrators.Crane(joint)
    reference = crane.sorted(crane.system.simulate(20.0, rtol=1e-13, saveat=integrators.GRID).x)  # with located events
    other = (
        cvode.trajectory(joint, 1e-13)
        if cvode is not None
        else crane.sorted(crane.system.simulate(20.0, rtol=1e-11, saveat=integrators.GRID, engine="diffrax").x)
    )
    known = f"{error(other, reference):.0e}"
    curves: dict[str, Curve] = {}
    for name, (make, tolerances) in tools(joint, cvode, quick).items():
        if only and not any(word in name for word in only):
            continue
        try:
            tool = make()
        except ImportError as problem:
            print(f"{name} is left out: {problem}", file=sys.stderr)
            continue
        curves[name] = []
        for tolerance in tolerances:
            try:
                outcome = tool(tolerance)
            except RuntimeError as problem:
                print(f"{name} at {tolerance:.0e}: {problem}", file=sys.stderr)
                continue
            if outcome.y.shape != reference.shape or not np.isfinite(outcome.y).all():
                print(f"{name} at {tolerance:.0e} did not reach the end", file=sys.stderr)
                continue
            e = error(outcome.y, reference)
            curves[name].append((tolerance, outcome, e))
            print(f"{joint:9} {name:28} {tolerance:.0e} {outcome.milliseconds:10.2f} ms  error {e:.1e}", flush=True)
    return curves, known


def table(curves: dict[str, Curve]) -> tuple[list[str], list[tuple[str, ...]]]:
    """Milliseconds at each level, and the ratio to the C program."""
    header = ["tool"]
    for level in LEVELS:
        header += [f"{level:.0e} [ms]", f"to {PEER}"]
    rows: list[tuple[str, ...]] = []
    for name, curve in curves.items():
        row = [name]
        for level in LEVELS:
            mine = at_level(curve, level) if curve else None
            peer = at_level(curves[PEER], level) if PEER in curves else None
            row.append("" if mine is None else f"{mine:.3g}")
            row.append("" if mine is None or peer is None else f"{mine / peer:.3g}")
        rows.append(tuple(row))
    return header, rows


def speedup(curves: dict[str, Curve]) -> str:
    """A sentence about the stock solver beside the native engine."""
    if OURS not in curves or STOCK not in curves:
        return ""
    pairs = [(level, at_level(curves[OURS], level), at_level(curves[STOCK], level)) for level in LEVELS]
    said = [f"{stock / ours:.0f} times at {level:.0e}" for level, ours, stock in pairs if ours and stock]
    return f"The stock solver takes the time of the native engine's solve {', '.join(said)}." if said else ""


def plot(curves: dict[str, dict[str, Curve]]) -> None:
    """Time over error, a panel for each joint."""
    from matplotlib import pyplot

    figure, axes = pyplot.subplots(
        1, len(curves), sharey=True, squeeze=False, layout="constrained", figsize=(6.8 * len(curves), 6.2)
    )
    for axis, (joint, named) in zip(axes[0], curves.items(), strict=True):
        for name, curve in named.items():
            e, ms = [c[2] for c in curve], [c[1].milliseconds for c in curve]
            axis.loglog(e, ms, "o-", markersize=3, linewidth=2 if "native" in name or name == PEER else 1, label=name)
        axis.set_xlabel("error (root mean square, relative to the range)")
        axis.set_title(f"extended-{joint}, 20 s")
        axis.grid(True, which="both", alpha=0.2)
        axis.invert_xaxis()
    axes[0, 0].set_ylabel("CPU time of the solve [ms]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize="small", loc="outside lower center", ncols=5)
    figure.savefig(FIGURE, dpi=110)


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cvode", type=Path, help="source of the C program")
    parser.add_argument("--only", nargs="+", metavar="WORD", help="tools with one of these words in the name")
    parser.add_argument("--joint", nargs="+", choices=["compliant", "rigid"], default=["compliant", "rigid"])
    parser.add_argument("--quick", action="store_true", help="fewer repetitions")
    parser.add_argument("--dry", action="store_true", help="print only: leave the results as they are")
    chosen = parser.parse_args(words)
    cvode = CvodeProgram(chosen.cvode) if chosen.cvode else None
    found = {joint: measure(joint, cvode, chosen.only, chosen.quick) for joint in chosen.joint}
    for joint, (curves, known) in found.items():
        header, rows = table(curves)
        text = (
            f"The extended-{joint} crane, scenario *sine*, 0 to 20 s: CPU milliseconds of the solve (without compiling "
            "and, but for `simulate`, without the start) at equal error, interpolated on each tool's curve. The "
            "error is the root mean square over all states and 401 times, relative to the range of each state; the "
            f"reference is known to {known}. Only `simulate` locates the switching of the valve as an event. *{PEER}* "
            "is the hand-written program with dense BDF, compiled with -O3 -march=native; *on the same C* are other "
            "methods with the compiled equations, Jacobian and factors of the native engine (BDF: CVODE with dense "
            "factors). SciPy and scikit-SUNDAE call the compiled vector field and its Jacobian; CasADi has the same "
            "equations as expressions in its virtual machine. Tools that do not reach a level have no entry."
        )
        key, command = f"work-precision-{joint}", "python -m benchmarks.work_precision --cvode kbc_cvode.c"
        picture = "![work and precision](work_precision.png)" if joint == "compliant" else ""
        after = "\n\n".join(part for part in (speedup(curves), picture) if part)
        section = Section(key, f"Work and precision, {joint} joint", command, text, header, rows, after)
        if chosen.dry:
            print(section.markdown())
        else:
            write(section)
    if not chosen.dry:
        plot({joint: curves for joint, (curves, _) in found.items()})
    return 0


if __name__ == "__main__":
    sys.exit(main())
