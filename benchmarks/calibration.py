"""Calibration of the extended crane from noisy measurements: coverage of the intervals, and time of a fit.

python -m benchmarks.calibration
"""

from __future__ import annotations

import argparse
import sys
import time
from typing import Any

import numpy as np

from benchmarks.results import Section, seconds, write
from models.kbc import PARAMETERS, SIGNALS, reference_crane

TRUE = {
    PARAMETERS["B"]: 1.1e9,
    PARAMETERS["Cd"]: 0.62,
    PARAMETERS["A_dcv"]: 2.0e-4,
    PARAMETERS["A_cbv"]: 3.6e-4,
}
"""Bulk modulus, discharge coefficient, and two valve areas: what the measured crane has."""
NOISE = {"x": 1e-3, **{SIGNALS[name]: 5e4 for name in ("P1", "P3", "Pa", "Pb")}}
"""Measured signals: the piston's displacement [m] and four pressures [Pa], with the noise of each."""
TIMES = np.linspace(0.1, 20.0, 200)


def free() -> dict[str, Any]:
    """What is sought, and within which bounds."""
    import acausal as ac

    bounds = (ac.LogBounds(5e8, 2.5e9), ac.Bounds(0.4, 0.9), ac.LogBounds(1e-4, 5e-4), ac.LogBounds(1e-4, 1e-3))
    return dict(zip(TRUE, bounds, strict=True))


def measured(system: Any, seed: int) -> dict[str, Any]:
    """A noisy measurement of the crane with the true values."""
    solution = system.simulate(20.0, parameters=TRUE, saveat=TIMES, rtol=1e-8)
    random = np.random.default_rng(seed)
    return {"t": TIMES} | {n: np.asarray(solution[n]) + s * random.normal(size=len(TIMES)) for n, s in NOISE.items()}


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sets", type=int, default=50, help="number of data sets")
    chosen = parser.parse_args(words)
    import acausal as ac

    system = ac.compile(reference_crane(hydraulics="extended", joint="compliant"))
    inside = {name: 0 for name in TRUE}
    errors: dict[str, list[float]] = {name: [] for name in TRUE}
    spent: list[float] = []
    iterations: list[int] = []
    for seed in range(chosen.sets):
        data = measured(system, seed)
        begin = time.perf_counter()
        fit = ac.calibrate(system, data, free(), sigma=NOISE)
        intervals = fit.confidence(0.95)
        spent.append(time.perf_counter() - begin)
        iterations.append(fit.outcome.iterations)
        for name, true in TRUE.items():
            low, high = intervals[name]
            inside[name] += low <= true <= high
            errors[name].append(fit.parameters[name] / true - 1.0)
    rows: list[tuple[str, ...]] = []
    for name, true in TRUE.items():
        mean, spread = 100 * float(np.mean(errors[name])), 100 * float(np.std(errors[name]))
        held = 100 * inside[name] / chosen.sets
        rows.append((f"`{name}`", f"{true:g}", f"{mean:+.2f}", f"{spread:.2f}", f"{held:.0f}"))
    everything = sum(inside.values()) / (len(TRUE) * chosen.sets)
    text = (
        f"{chosen.sets} seeded data sets of the extended-compliant crane (20 s, 200 samples of the piston's "
        "displacement with 1 mm of noise and of four pressures with 0.5 bar) are fitted from the model's defaults, "
        f"4 parameters at once. {100 * everything:.0f} % of the 95 % intervals hold the true value. The first fit took "
        f"{seconds(spent[0])} s (with compiling), the others {seconds(float(np.median(spent[1:])))} s in the median "
        f"and {seconds(max(spent[1:]))} s at most, in {int(np.median(iterations))} iterations in the median."
    )
    header = ("parameter", "true value", "mean error [%]", "standard deviation [%]", "inside the 95 % interval [%]")
    write(Section("calibration", "Calibration", "python -m benchmarks.calibration", text, header, rows))
    return 0


if __name__ == "__main__":
    sys.exit(main())
