"""What a gradient costs beside a solve: a loss on the crane's trajectory, four parameters.

python -m benchmarks.gradients
"""

from __future__ import annotations

import argparse
import sys
from typing import Any

import numpy as np

from benchmarks.calibration import TRUE
from benchmarks.peers.integrators import best
from benchmarks.results import Section, write
from models.kbc import reference_crane

T_END, POINTS = 20.0, 201

TIGHT, STEP = 1e-11, 3e-4
"""Tolerance and relative step of the central differences."""
TARGET = 1.0 + 0.3 * np.sin(2 * np.pi * 0.05 * np.linspace(0.0, T_END, POINTS))
"""The reference of the piston's displacement."""


def main(words: list[str] | None = None) -> int:
    """Run the benchmark."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--repeat", type=int, default=15, help="runs of each, the best counts")
    parser.add_argument("--engine", nargs="+", default=["native", "diffrax"], choices=["native", "diffrax"])
    chosen = parser.parse_args(words)
    import jax
    import jax.numpy as jnp

    import acausal as ac

    rows: list[tuple[str, ...]] = []
    for joint in ("compliant", "rigid"):
        system = ac.compile(reference_crane(hydraulics="extended", joint=joint))
        at = jnp.array(list(TRUE.values()))
        for engine in chosen.engine:

            def loss(v: Any, rtol: float, system: Any = system, engine: Any = engine) -> Any:
                given = dict(zip(TRUE, v, strict=True))
                solution = system.simulate(T_END, parameters=given, saveat=POINTS, rtol=rtol, engine=engine)
                return jnp.sum((solution["x"] - TARGET) ** 2)

            repeats = chosen.repeat if engine == "native" else 2
            value = ac.jit(lambda v, loss=loss: loss(v, 1e-6))
            slope = ac.jit(lambda v, loss=loss: jax.grad(loss)(v, 1e-6))
            once, _ = best(lambda f=value, at=at: jax.block_until_ready(f(at)), repeats)
            both, _ = best(lambda f=slope, at=at: jax.block_until_ready(f(at)), repeats)
            row = (f"extended-{joint}", engine, f"{once:.3g}", f"{both:.3g}", f"{both / once:.2f}")
            rows.append((*row, f"{_deviation(loss, at):.1e}" if engine == "native" else ""))
    text = (
        "A sum of squares over 201 points of the piston's displacement, 20 s at rtol 1e-6, as a function of four "
        "parameters (bulk modulus, discharge coefficient, two valve areas), jitted; the gradient by `jax.grad`: "
        "forward sensitivities of the step itself in the native engine, whose errors are controlled, too, checkpointed "
        "reverse mode in the diffrax engine. *Deviation*: largest deviation of the gradient from central "
        "differences of the loss, both at rtol 1e-11, by logarithms of the parameters, relative to the largest of them."
    )
    header = ("crane", "engine", "solve [ms]", "gradient [ms]", "ratio", "deviation")
    write(Section("gradients", "Gradients", "python -m benchmarks.gradients", text, header, rows))
    return 0


def _deviation(loss: Any, at: Any) -> float:
    """Of the gradient from central differences, by logarithms of the parameters, relative to the largest."""
    import jax

    slope = np.asarray(jax.grad(loss)(at, TIGHT)) * np.asarray(at)
    differences = np.empty(len(at))
    for k in range(len(at)):
        up, down = (np.asarray(at) * np.exp(s * STEP * np.eye(len(at))[k]) for s in (1, -1))
        differences[k] = float(loss(up, TIGHT) - loss(down, TIGHT)) / (2 * STEP)
    return float(np.max(np.abs(slope - differences)) / np.max(np.abs(differences)))


if __name__ == "__main__":
    sys.exit(main())
