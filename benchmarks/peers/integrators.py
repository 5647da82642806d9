"""The extended crane by several integrators: each gives milliseconds of the solve, the trajectory and the steps."""

from __future__ import annotations

import resource
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from models.kbc import SIGNALS, reference_crane

T_END, POINTS = 20.0, 401
GRID = np.linspace(0.0, T_END, POINTS)
COLUMNS = {
    "compliant": ("Pp", "Q", "P1", "P2", "P3", "Pa", "Pb", "x", "v", "theta", "omega", "ei"),
    "rigid": ("Pp", "Q", "P1", "P2", "P3", "Pa", "Pb", "theta", "omega", "ei"),
}
"""States in the order of the C program."""
SCALE = {"Q": 1e-3, "x": 1.0, "v": 1.0, "theta": 1.0, "omega": 1.0, "ei": 1.0}
"""Scale of the absolute tolerances, as in the C program; pressures have 1 MPa."""


@dataclass(frozen=True)
class Outcome:
    """One tool at one tolerance.

    Attributes:
        milliseconds: of the solve, the best of several.
        y: trajectory on `GRID`, (POINTS, n), in the order of `COLUMNS`.
        steps: of the integrator, if it tells.
    """

    milliseconds: float
    y: NDArray[np.float64]
    steps: int | None = None


Tool = Callable[[float], Outcome]


class Crane:
    """The compiled crane with what the tools need.

    Attributes:
        joint: ``compliant`` or ``rigid``.
        order: place of each of `COLUMNS` in the state vector.
        scale: absolute tolerance of each state at a tolerance of 1, in the order of the state vector.
    """

    def __init__(self, joint: Any) -> None:
        import acausal as ac

        self.joint = joint
        self.system = ac.compile(reference_crane(hydraulics="extended", joint=joint))
        representative, _ = self.system.observed_ids
        states = self.system.stages.schedule.states.tolist()
        self.order = [
            states.index(int(representative[int(np.ravel(self.system.index_of(SIGNALS[c]))[0])]))
            for c in COLUMNS[joint]
        ]
        self.scale = np.ones(len(states))
        self.scale[self.order] = [SCALE.get(c, 1e6) for c in COLUMNS[joint]]
        self.x0 = np.asarray(self.system.initialize()[0])

    def sorted(self, x: Any) -> NDArray[np.float64]:
        """Columns of a state trajectory in the order of `COLUMNS`."""
        return np.asarray(x)[:, self.order]

    def field(self) -> tuple[Callable[..., Any], Callable[..., Any]]:
        """Compiled vector field and Jacobian on NumPy arrays."""
        import jax

        p = self.system.parameter_vector({})
        f = jax.jit(lambda t, x: self.system.vector_field(t, x, p))
        jacobian = jax.jit(jax.jacfwd(lambda t, x: self.system.vector_field(t, x, p), argnums=1))
        return lambda t, x: np.asarray(f(t, x)), lambda t, x: np.asarray(jacobian(t, x))


def best(run: Callable[[], Any], repeats: int) -> tuple[float, Any]:
    """CPU milliseconds of the best of several runs after one that does not count, and what it returned.

    CPU time, because other work on the machine would count in wall time; what is measured so runs on one thread.
    """
    found, result = float("inf"), run()
    for _ in range(repeats):
        begin = time.process_time()
        result = run()
        found = min(found, 1e3 * (time.process_time() - begin))
    return found, result


def native(crane: Crane, repeats: int) -> tuple[Tool, Tool]:
    """The native engine: the compiled solve alone, and the whole call of `simulate`."""
    from acausal.simulation.engines import tolerances
    from acausal.simulation.native import native_model
    from acausal.simulation.started import Given

    system = crane.system
    model = native_model(system)
    library = model.native_library()
    given = Given({}, {}, [])
    started = model.start(0.0, given, library)

    def solve(rtol: float) -> Outcome:
        how = tolerances(system, rtol, None, None, 1_000_000)

        def run() -> Any:
            return library.run(0.0, T_END, started.z0, started.p, GRID, rtol=how.rtol, atol=how.atol)

        milliseconds, found = best(run, repeats)
        return Outcome(milliseconds, crane.sorted(found.z[:, : len(crane.x0)]), found.counts["steps"])

    def whole(rtol: float) -> Outcome:
        milliseconds, found = best(lambda: system.simulate(T_END, rtol=rtol, saveat=GRID, engine="native"), repeats)
        return Outcome(milliseconds, crane.sorted(found.x), found.stats["steps"])

    return solve, whole


def diffrax_engine(crane: Crane, repeats: int) -> Tool:
    """Our Rodas5P in diffrax."""

    def solve(rtol: float) -> Outcome:
        options: dict[str, Any] = {"rtol": rtol, "saveat": GRID, "engine": "diffrax", "events": False}
        milliseconds, found = best(lambda: crane.system.simulate(T_END, **options), repeats)
        return Outcome(milliseconds, crane.sorted(found.x), found.stats["steps"])

    return solve


def stock_diffrax(crane: Crane, repeats: int) -> Tool:
    """Diffrax's own stiff solver as a user would call it: `Kvaerno5`, `PIDController`, `jax.jit`."""
    import diffrax
    import jax
    import jax.numpy as jnp

    term = diffrax.ODETerm(lambda t, y, p: crane.system.vector_field(t, y, p))
    saveat = diffrax.SaveAt(ts=jnp.asarray(GRID))

    @jax.jit
    def run(y0: Any, p: Any, rtol: Any) -> Any:
        control = diffrax.PIDController(rtol=rtol, atol=rtol * jnp.asarray(crane.scale))
        found = diffrax.diffeqsolve(
            term, diffrax.Kvaerno5(), 0.0, T_END, None, y0, p, saveat=saveat, stepsize_controller=control,
            max_steps=1_000_000,
        )  # fmt: skip
        return found.ys, found.stats["num_steps"]

    p = crane.system.parameter_vector({})

    def solve(rtol: float) -> Outcome:
        milliseconds, (ys, steps) = best(lambda: jax.block_until_ready(run(crane.x0, p, rtol)), repeats)
        return Outcome(milliseconds, crane.sorted(ys), int(steps))

    return solve


def scipy_tool(crane: Crane, method: str, repeats: int) -> Tool:
    """`scipy.integrate.solve_ivp` with the compiled vector field and Jacobian."""
    from scipy.integrate import solve_ivp

    f, jacobian = crane.field()

    def solve(rtol: float) -> Outcome:
        def run() -> Any:
            return solve_ivp(
                f, (0.0, T_END), crane.x0, method, GRID, rtol=rtol, atol=rtol * crane.scale, jac=jacobian
            )

        milliseconds, found = best(run, repeats)
        if not found.success:
            raise RuntimeError(found.message)
        return Outcome(milliseconds, crane.sorted(found.y.T))

    return solve


def casadi_tool(crane: Crane, method: str, repeats: int) -> Tool:
    """CasADi's `cvodes` or `idas` on the same equations as CasADi expressions, scaled by the tolerances' scale."""
    import casadi as ca

    from benchmarks.peers.casadi_system import to_casadi

    t, x, dx = to_casadi(crane.system)
    y = ca.SX.sym("y", len(crane.x0))
    scaled = ca.substitute(dx, x, y * crane.scale) / crane.scale
    problem = {"t": t, "x": y, "ode": scaled}

    def solve(rtol: float) -> Outcome:
        options = {"abstol": rtol, "reltol": rtol, "max_num_steps": 1_000_000}
        integrator = ca.integrator("crane", method, problem, 0.0, GRID, options)
        milliseconds, found = best(lambda: integrator(x0=crane.x0 / crane.scale)["xf"], repeats)
        return Outcome(milliseconds, crane.sorted(np.asarray(found).T * crane.scale))

    return solve


def sundae(crane: Crane, repeats: int) -> Tool:
    """`scikit-SUNDAE`'s CVODE with the compiled vector field and Jacobian."""
    from sksundae.cvode import CVODE

    f, jacobian = crane.field()

    def right(t: float, y: Any, dy: Any) -> None:
        dy[:] = f(t, y)

    def slopes(t: float, y: Any, dy: Any, out: Any) -> None:
        out[:] = jacobian(t, y)

    def solve(rtol: float) -> Outcome:
        solver = CVODE(
            right, rtol=rtol, atol=rtol * crane.scale, method="BDF", jacfn=slopes, max_num_steps=1_000_000
        )
        milliseconds, found = best(lambda: solver.solve(GRID, crane.x0), repeats)
        if not found.success:
            raise RuntimeError(found.message)
        return Outcome(milliseconds, crane.sorted(found.y))

    return solve


def _children() -> float:
    """CPU seconds of processes that this one started and that have ended."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class CvodeProgram:
    """The hand-written C program with CVODE, built with `cc` from the path of its source.

    Its time is what it prints itself, or the mean CPU time of its runs if that is less; the trajectory
    comes from `cvode_grid.c`, which takes the same steps.
    """

    LIBRARIES = ("cvode", "nvecserial", "sunmatrixdense", "sunlinsoldense")

    def __init__(self, source: Path) -> None:
        self.folder = tempfile.TemporaryDirectory()
        libraries = [*(f"-lsundials_{name}" for name in self.LIBRARIES), "-lm"]
        build = ["cc", "-O3", "-march=native"]
        grid = Path(__file__).with_name("cvode_grid.c")
        define = f'-DPROGRAM="{source.resolve()}"'
        self.program, self.grid = Path(self.folder.name) / "timed", Path(self.folder.name) / "grid"
        subprocess.run([*build, str(source), "-o", str(self.program), *libraries], check=True)
        subprocess.run([*build, define, str(grid), "-o", str(self.grid), *libraries], check=True)

    def tool(self, joint: str, repeats: int) -> Tool:
        """The program for one joint."""

        def solve(rtol: float) -> Outcome:
            before = _children()
            out = subprocess.run(
                [self.program, joint, repr(rtol), str(repeats)], capture_output=True, text=True, check=True
            ).stdout.splitlines()
            mean = 1e3 * (_children() - before) / repeats
            lines = [line.split() for line in out[:repeats]]
            best_wall = min(float(line[0]) for line in lines)
            return Outcome(min(best_wall, mean), self.trajectory(joint, rtol), int(lines[0][1]))

        return solve

    def trajectory(self, joint: str, rtol: float) -> NDArray[np.float64]:
        """States on `GRID`."""
        words = [str(self.grid), joint, repr(rtol), str(POINTS)]
        out = subprocess.run(words, capture_output=True, text=True, check=True).stdout
        return np.array([[float(v) for v in line.split()] for line in out.splitlines()])
