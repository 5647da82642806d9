"""Real-time factor of the exported crane in FMPy: co-simulation at a communication step of 0.01 s, and model exchange.

python -m benchmarks.fmu
"""

from __future__ import annotations

import argparse
import sys
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.results import Section, write
from models.kbc import SIGNALS, reference_crane

T1, STEP = 20.0, 0.01
SHOWN = [SIGNALS["x"], "boom.phi", "boom.w"]

TEXT = f"""{T1:g} s of the crane with the default scenario, communication step {STEP:g} s, relative tolerance
{{tolerance:g}}, least of {{repeats}} runs. Real-time factors (seconds of wall time per simulated second): *steps*: the
loop of `doStep` with a read of three signals after each step; *co-simulation* and *model exchange*: the whole of
`fmpy.simulate_fmu` on the unpacked unit (instantiation, loop, record; model exchange with FMPy's CVODE). *Export* is
translation of equations, compilation and packing [s], *size* that of the file [KiB]; *error* is the largest deviation
of the three signals in the loop from `simulate` at 1e-9, relative to their ranges."""


def stepped(path: Path, folder: str, tolerance: float) -> tuple[float, np.ndarray]:
    """Seconds of the loop of `doStep` with a read of three signals after each, and the signals."""
    import fmpy
    from fmpy.simulation import instantiate_fmu

    description = fmpy.read_model_description(str(path))
    numbers = {v.name: v.valueReference for v in description.modelVariables}
    read = [numbers[n] for n in SHOWN]
    unit: Any = instantiate_fmu(folder, description, "CoSimulation")
    if description.fmiVersion == "2.0":
        unit.setupExperiment(tolerance=tolerance, startTime=0.0, stopTime=T1)
        unit.enterInitializationMode()
    else:
        unit.enterInitializationMode(tolerance=tolerance, startTime=0.0, stopTime=T1)
    unit.exitInitializationMode()
    get = unit.getReal if description.fmiVersion == "2.0" else unit.getFloat64
    steps = round(T1 / STEP)
    values = np.empty((steps + 1, len(read)))
    values[0] = get(read)
    begin = time.perf_counter()
    for k in range(steps):
        unit.doStep(currentCommunicationPoint=k * STEP, communicationStepSize=STEP)
        values[k + 1] = get(read)
    seconds = time.perf_counter() - begin
    unit.terminate()
    unit.freeInstance()
    return seconds, values


def in_all(path: Path, folder: str, kind: str, tolerance: float) -> float:
    """Seconds of `fmpy.simulate_fmu`: instance, loop, record."""
    import fmpy

    description = fmpy.read_model_description(str(path))
    begin = time.perf_counter()
    fmpy.simulate_fmu(
        folder, fmi_type=kind, stop_time=T1, output_interval=STEP, step_size=STEP, relative_tolerance=tolerance,
        output=SHOWN, model_description=description, validate=False,
    )  # fmt: skip
    return time.perf_counter() - begin


def row(system: Any, name: str, version: str, folder: Path, repeats: int, tolerance: float) -> tuple[str, ...]:
    """Figures of one unit."""
    import fmpy

    import acausal as ac

    begin = time.perf_counter()
    path = ac.fmi.export(system, folder / f"{name}{version[0]}.fmu", version=version)
    export = time.perf_counter() - begin
    unpacked = fmpy.extract(str(path), unzipdir=str(folder / f"{name}{version[0]}"))
    runs = [stepped(path, unpacked, tolerance) for _ in range(repeats)]
    loop = min(seconds for seconds, _ in runs)
    whole = {k: min(in_all(path, unpacked, k, tolerance) for _ in range(repeats))
             for k in ("CoSimulation", "ModelExchange")}  # fmt: skip
    times = np.linspace(0.0, T1, round(T1 / STEP) + 1)
    exact = system.simulate(T1, saveat=times, rtol=1e-9)
    wanted = np.stack([exact[n] for n in SHOWN], axis=1)
    error = (np.abs(runs[0][1] - wanted).max(axis=0) / np.ptp(wanted, axis=0)).max()
    factors = (loop / T1, whole["CoSimulation"] / T1, whole["ModelExchange"] / T1)
    size = path.stat().st_size / 1024
    return (name, version, f"{export:.1f}", f"{size:.0f}", *(f"{f:.5f}" for f in factors), f"{error:.1e}")


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeats", type=int, default=15, help="runs, of which the fastest counts")
    parser.add_argument("--tolerance", type=float, default=1e-6, help="relative tolerance of the unit's solver")
    chosen = parser.parse_args(words)
    import acausal as ac
    import acausal.fmi

    rows: list[tuple[str, ...]] = []
    with tempfile.TemporaryDirectory(prefix="acausal-fmu-") as folder:
        for hydraulics in ("simplified", "extended"):
            for joint in ("rigid", "compliant"):
                system = ac.compile(reference_crane(hydraulics=hydraulics, joint=joint))
                for version in ("2.0", "3.0"):
                    rows.append(
                        row(system, f"{hydraulics}_{joint}", version, Path(folder), chosen.repeats, chosen.tolerance)
                    )
                    print("  ".join(rows[-1]), flush=True)
    write(
        Section(
            "fmu", "The crane as a functional mock-up unit, in FMPy", "python -m benchmarks.fmu",
            TEXT.format(tolerance=chosen.tolerance, repeats=chosen.repeats),
            ("crane", "FMI", "export", "size", "steps", "co-simulation", "model exchange", "error"), rows,
        )
    )  # fmt: skip
    return 0


if __name__ == "__main__":
    sys.exit(main())
