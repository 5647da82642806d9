"""Compile and solve the RC ladder with one other tool, and print one line of JSON.

    python -m benchmarks.peers.run rumoca --cells 100

Needs the `bench` extra (or, for one peer alone, its package). The import of the peer is not timed. `compile` is
everything from the Modelica text to a thing that can be solved, `solve` the first run of it over 0..1 s with 101 output
points at rtol 1e-6, atol 1e-9; some peers finish their compilation inside the first solve, so compare the sums.
`error` is the largest difference from the closed-form solution at the first node, the middle node and the open end.
"""

import argparse
import importlib
import importlib.metadata
import json
import sys
import threading
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass

import numpy as np
import numpy.typing as npt

from benchmarks.exact import ladder_nodes, ladder_voltage
from benchmarks.peers.source import ladder_unrolled, ladder_with_arrays

RTOL, ATOL, POINTS = 1e-6, 1e-9, 101
Trajectory = dict[int, npt.NDArray[np.float64]]
TIMES = np.linspace(0.0, 1.0, POINTS)


@dataclass(frozen=True)
class PeerRun:
    """One measurement; seconds of wall time, and CPU seconds of both stages together."""

    peer: str
    version: str
    configuration: str
    cells: int
    compile: float
    solve: float
    cpu: float
    error: float

    @property
    def total(self) -> float:
        """Seconds from the text to the trajectory."""
        return self.compile + self.solve


def rumoca(cells: int) -> PeerRun:
    """Rumoca's own simulator (BDF), component arrays."""
    import rumoca as rm

    source = ladder_with_arrays(cells)
    cpu, begin = time.process_time(), time.perf_counter()
    model = rm.Session().loads(source, model="Ladder")
    compiled = time.perf_counter()
    result = model.simulate(t=(0, 1), dt=1 / (POINTS - 1), config=rm.SimConfig(solver="bdf", rtol=RTOL, atol=ATOL))
    voltages = {k: np.interp(TIMES, result.time, result[f"c[{k}].v"]) for k in ladder_nodes(cells)}
    solved, cpu = time.perf_counter(), time.process_time() - cpu
    return _result("rumoca", "bdf, arrays", cells, compiled - begin, solved - compiled, cpu, voltages)


def pymoca(cells: int) -> PeerRun:
    """Pymoca to CasADi, solved by SUNDIALS IDAS; one declaration for each component (its arrays fail on this model).

    CSparse is the fastest of CasADi's linear solvers here at 1000 cells (its default needs six times as long).
    """
    import casadi as ca
    from pymoca import parser
    from pymoca.backends.casadi.api import generate_model

    options = {
        "detect_aliases": True,
        "replace_parameter_values": True,
        "replace_constant_values": True,
        "expand_mx": True,
    }
    source = ladder_unrolled(cells)
    cpu, begin = time.process_time(), time.perf_counter()
    model = generate_model(parser.parse(source), "Ladder", options)
    residual = model.dae_residual_function.expand()
    t = ca.SX.sym("t")
    x, dx, z = (ca.SX.sym(name, size) for name, size in zip("xdz", map(residual.size1_in, (1, 2, 3)), strict=True))
    empty = ca.SX(0, 1)
    dae = {"t": t, "x": x, "z": ca.vertcat(dx, z), "ode": dx, "alg": residual(t, x, dx, z, empty, empty, empty)}
    integrator = ca.integrator(
        "ladder", "idas", dae, 0.0, TIMES, {"reltol": RTOL, "abstol": ATOL, "linear_solver": "csparse"}
    )
    compiled = time.perf_counter()
    outcome = integrator(x0=np.zeros(x.numel()), z0=np.zeros(dx.numel() + z.numel()))
    states = np.array(outcome["xf"])
    solved, cpu = time.perf_counter(), time.process_time() - cpu
    names = [state.symbol.name() for state in model.states]
    voltages = {k: states[names.index(f"c{k}.v")] for k in ladder_nodes(cells)}
    return _result(
        "pymoca", "CasADi IDAS with CSparse, unrolled", cells, compiled - begin, solved - compiled, cpu, voltages
    )


def modelica(cells: int) -> PeerRun:
    """The pure-Python `modelica` toolchain (Python >= 3.12), its default Radau with a sparse Jacobian."""
    from modelica.lang import parse
    from modelica.sim import build, causalize, flatten, simulate

    source = ladder_unrolled(cells)
    cpu, begin = time.process_time(), time.perf_counter()
    kernel = build(causalize(flatten([parse(source)], "Ladder")), observed_jacobian=False)
    compiled = time.perf_counter()
    result = simulate(kernel, stop=1.0, times=TIMES, tolerance=RTOL, absolute=ATOL)
    voltages = {k: np.interp(TIMES, result.time, result[f"c{k}.v"]) for k in ladder_nodes(cells)}
    solved, cpu = time.perf_counter(), time.process_time() - cpu
    return _result("modelica", "Radau, unrolled", cells, compiled - begin, solved - compiled, cpu, voltages)


def _result(
    peer: str,
    configuration: str,
    cells: int,
    compile_seconds: float,
    solve_seconds: float,
    cpu: float,
    voltages: Trajectory,
) -> PeerRun:
    error = max(float(np.max(np.abs(v - ladder_voltage(k, cells, TIMES)))) for k, v in voltages.items())
    version = importlib.metadata.version(peer)
    return PeerRun(peer, version, configuration, cells, compile_seconds, solve_seconds, cpu, error)


PEERS: dict[str, Callable[[int], PeerRun]] = {"rumoca": rumoca, "pymoca": pymoca, "modelica": modelica}
_IMPORTS = {
    "rumoca": ("rumoca",),
    "pymoca": ("casadi", "pymoca.parser"),
    "modelica": ("modelica.sim", "scipy.integrate"),
}


def main(arguments: list[str] | None = None) -> int:
    """Run one peer and print its measurement."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("peer", choices=sorted(PEERS))
    parser.add_argument("--cells", type=int, default=10)
    chosen = parser.parse_args(arguments)
    try:
        for module in _IMPORTS[chosen.peer]:
            importlib.import_module(module)
    except ImportError as missing:
        print(json.dumps({"peer": chosen.peer, "cells": chosen.cells, "missing": str(missing)}))
        return 3
    measured: list[PeerRun] = []
    _with_deep_stack(lambda: measured.append(PEERS[chosen.peer](chosen.cells)))
    if not measured:
        return 1
    print(json.dumps(asdict(measured[0])))
    return 0


def _with_deep_stack(work: Callable[[], None]) -> None:
    """Some peers walk their trees recursively: 1000 cells need more than Python's default depth."""
    sys.setrecursionlimit(1_000_000)
    threading.stack_size(512 * 2**20)
    thread = threading.Thread(target=work)
    thread.start()
    thread.join()


if __name__ == "__main__":
    sys.exit(main())
