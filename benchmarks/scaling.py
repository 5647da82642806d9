"""How the time to compile grows with the number of cells: the table that `ladder.py` and `chain.py` make."""

from __future__ import annotations

import argparse
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from benchmarks.measure import Measurement, child_measurement, emit, measure
from benchmarks.results import Section, seconds, write

if TYPE_CHECKING:
    from acausal import Component, Solution

SIZES = (10, 100, 1_000, 10_000, 100_000)
POINTS, RTOL, ATOL = 101, 1e-6, 1e-9


@dataclass(frozen=True)
class Case:
    """A model that can be made in any size.

    Attributes:
        name: of the module that runs it.
        title: heading of its section.
        text: what it is.
        make: the model with this many cells.
        t1: end time [s].
        error: largest deviation of a solution with this many cells from the exact one.
    """

    name: str
    title: str
    text: str
    make: Callable[[int], Component]
    t1: float
    error: Callable[[int, Solution], float]


def measured(case: Case, cells: int, engine: str) -> Measurement:
    """One size, in this process."""
    saveat = np.linspace(0.0, case.t1, POINTS)
    return measure(
        lambda: case.make(cells), case.t1, saveat, lambda found: case.error(cells, found), rtol=RTOL, atol=ATOL,
        engine=engine,
    )  # fmt: skip


def table(case: Case, sizes: Sequence[int], timeout: float, engine: str) -> dict[int, Measurement]:
    """Measure the sizes, write the section, return what was measured."""
    found: dict[int, Measurement] = {}
    rows: list[tuple[str, ...]] = []
    for cells in sizes:
        result, problem = child_measurement(
            [f"benchmarks.{case.name}", "--one", str(cells), "--engine", engine], timeout
        )
        if result is None:
            rows.append((f"{cells:,}", *([""] * 8), problem[:80]))
            continue
        found[cells] = result
        exponent = ""
        before = [n for n in found if n < cells]
        if before:
            exponent = f"{math.log(result.compile / found[before[-1]].compile) / math.log(cells / before[-1]):.2f}"
        rows.append(
            (
                f"{cells:,}",
                seconds(result.instantiate),
                seconds(result.translate),
                seconds(result.prepare),
                seconds(result.build),
                seconds(result.compile),
                exponent,
                f"{result.steps}",
                seconds(result.run),
                f"{result.error:.1e}",
            )
        )
    index = sorted({r.index for r in found.values()})
    native = engine == "native"
    text = f"{case.text} Structural index found: {', '.join(map(str, index))}. "
    text += (NATIVE if native else DIFFRAX) + COLUMNS
    command = f"python -m benchmarks.{case.name} --engine {engine}"
    key, title = f"{case.name}-{engine}", f"{case.title}, {engine} engine"
    write(Section(key, title, command, text, NATIVE_HEADER if native else DIFFRAX_HEADER, rows))
    return found


LAST = ("compile in all", "exponent", "steps", "integrate", "error")
NATIVE_HEADER = ("cells", "construct", "translate", "write C", "C compiler", *LAST)
DIFFRAX_HEADER = ("cells", "construct", "translate", "trace", "XLA", *LAST)
NATIVE = "*Write C* is that and loading; the C compiler begins with an empty cache. "
DIFFRAX = "*Trace* is JAX's tracing with the initialization. "
COLUMNS = """\
*Construct* makes the model's objects, *translate* is flattening to lowering, *compile in all* is everything before the
first step. *Exponent* is the growth of that from the row above: 1 would be proportional to N. *Error* is the largest
deviation from the closed-form solution at the first, the middle and the last cell, at rtol 1e-6 and atol 1e-9. Each row
is a new process; imports are not counted."""


def arguments(description: str | None) -> argparse.ArgumentParser:
    """The options that all sizes have."""
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cells", type=int, nargs="+", default=list(SIZES), help="sizes to measure")
    parser.add_argument("--timeout", type=float, default=600.0, help="seconds for each size")
    parser.add_argument("--engine", choices=["native", "diffrax"], default="native", help="engine to measure")
    parser.add_argument("--one", type=int, metavar="N", help="measure one size in this process and print JSON")
    return parser


def run(case: Case, chosen: argparse.Namespace) -> dict[int, Measurement]:
    """What the command line asked for."""
    if chosen.one is not None:
        emit(measured(case, chosen.one, chosen.engine))
        return {}
    return table(case, chosen.cells, chosen.timeout, chosen.engine)
