"""The paper's co-simulation: the crane cut between joint and boom, as two participants, as FMUs, with MuJoCo."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np
import numpy.typing as npt

import acausal as ac
from acausal.fmi.cosimulation import CoSimulation
from acausal.fmi.mujoco_participant import MujocoParticipant
from acausal.fmi.result import CoSimulationResult
from acausal.fmi.splitting import Split, split

from .reference import reference_crane

Floats = npt.NDArray[np.float64]
Method = Literal["jacobi", "gauss-seidel"]
Stage = Callable[[str], None]

MACRO_STEP: Final = 0.01
"""Macro step of the paper [s]."""
DURATION: Final = 20.0
"""Simulated time of Table 2 [s]."""
RECORDED: Final = ("cylinder.x", "cylinder.port_a.q", "cylinder.p_a")
RK4_STEP: Final = 1e-5
"""Step of the Runge-Kutta method inside [s]; the oil between the valves allows no more than about 1.6e-5 s."""
_FINE: Final = 5e-4
"""Spacing of the reference trajectory [s]."""


@dataclass(frozen=True)
class Reference:
    """Trajectories of the extended, compliant crane in one piece.

    Attributes:
        t: times [s], (n_t,).
        signals: of `RECORDED`, each (n_t,).
        real_time_factor: of a run at the tolerance of the participants.
    """

    t: Floats
    signals: Mapping[str, Floats]
    real_time_factor: float

    def rmse(self, t: Floats, x: Floats) -> float:
        """Root mean square over time of the deviation of the piston displacement [m].

        Args:
            t: times [s], (n,), from 0 to at most the end of the reference.
            x: displacement of the piston at these times [m], (n,).
        """
        deviation = (x - np.interp(t, self.t, self.signals["cylinder.x"])) ** 2
        return float(np.sqrt(np.trapezoid(deviation, t) / (t[-1] - t[0])))


@dataclass(frozen=True)
class Outcome:
    """One co-simulation.

    Attributes:
        label: what was simulated.
        method: of the master.
        order: of the extrapolation of inputs.
        step: macro step [s], nan if it was adaptive.
        steps: macro steps.
        rejected: macro steps that were taken back.
        rmse: root mean square of the piston displacement's deviation from the model in one piece [m]; nan if the run
            diverged.
        energy: largest energy residual of the power bond [J]; inf if the run diverged.
        real_time_factor: wall-clock time by simulated time.
        end: time that was reached [s].
        result: the trajectories.
    """

    label: str
    method: Method
    order: int
    step: float
    steps: int
    rejected: int
    rmse: float
    energy: float
    real_time_factor: float
    end: float
    result: CoSimulationResult

    @property
    def diverged(self) -> bool:
        """Whether the run ended before its time."""
        return self.result.result != "successful"


def cut_crane(scenario: Literal["sine", "step", "endstop"] = "sine") -> Split:
    """The extended, compliant crane cut between joint and boom: the boom gets the torque of the cylinder and returns
    its angle with angular velocity."""
    crane = reference_crane(hydraulics="extended", joint="compliant", scenario=scenario)
    return split(crane, at="boom.flange", names=("boom", "hydraulics"))


def whole_crane(cut: Split, duration: float) -> Reference:
    """The crane in one piece, accurate, and the real-time factor of a run at the tolerance of the participants."""
    t = np.linspace(0.0, duration, round(duration / _FINE) + 1)
    fine = cut.whole.simulate(duration, saveat=t, rtol=1e-9)
    return Reference(
        t, {name: np.asarray(fine[name], dtype=np.float64) for name in RECORDED}, monolithic_factor(cut.whole, duration)
    )


def monolithic_factor(system: ac.System, duration: float) -> float:
    """Real-time factor of a model in one piece at the tolerance of the participants."""
    points = np.linspace(0.0, duration, round(duration / MACRO_STEP) + 1)
    system.simulate(MACRO_STEP, saveat=points[:2], rtol=1e-6)
    return float(system.simulate(duration, saveat=points, rtol=1e-6).stats["run_seconds"]) / duration


def rigid_crane(reference: Reference) -> tuple[float, float]:
    """RMSE [m] to the reference and real-time factor of the rigid crane in one piece, by index reduction."""
    system = ac.compile(reference_crane(hydraulics="extended", joint="rigid", scenario="sine"))
    end = float(reference.t[-1])
    solution = system.simulate(end, saveat=reference.t, rtol=1e-9)
    x = np.asarray(solution["cylinder.x"], dtype=np.float64)
    return reference.rmse(reference.t, x), monolithic_factor(system, end)


def mujoco_boom(cut: Split, *, step: float = 1e-3) -> MujocoParticipant:
    """The boom in MuJoCo: a hinge in the place of the joint, a body with the boom's mass and inertia.

    Args:
        cut: of `cut_crane`.
        step: of the engine [s].
    """
    start = cut.whole.simulate(0.0, saveat=[0.0])
    p = {n: cut.whole.parameters[n] for n in ("m", "r", "g", "boom.I")}
    # MuJoCo asks for the inertia about the centre of gravity; only that about the hinge's axis counts here
    central = p["boom.I"] - p["m"] * p["r"] ** 2
    xml = f"""
    <mujoco model="boom">
      <compiler angle="radian"/>
      <option gravity="0 0 {-p["g"]}" integrator="RK4"/>
      <worldbody>
        <body name="boom">
          <joint name="boom" type="hinge" axis="0 -1 0"/>
          <inertial pos="{p["r"]} 0 0" mass="{p["m"]}" diaginertia="{central} {central} {central}"/>
        </body>
      </worldbody>
    </mujoco>"""
    return MujocoParticipant(
        xml,
        torques={"boom_flange_tau": ("boom", -1.0)},
        positions={"boom_flange_phi": "boom"},
        step=step,
        initial={"boom": float(np.asarray(start["boom.phi"])[0])},
        units={"boom_flange_tau": "N.m", "boom_flange_phi": "rad"},
        name="boom",
    )


def cosimulate(
    cut: Split,
    reference: Reference,
    duration: float,
    *,
    label: str = "",
    method: Method = "jacobi",
    order: int = 1,
    step: float = MACRO_STEP,
    tolerance: float | None = None,
    participants: Mapping[str, Any] | None = None,
    **options: Any,
) -> Outcome:
    """One co-simulation of the crane beside the reference; a run that diverges is cut short, not an error.

    Args:
        cut: of `cut_crane`.
        reference: at least as long.
        duration: simulated time [s].
        label: of the outcome.
        method: of the master.
        order: of the extrapolation of inputs.
        step: macro step [s]; the first one with a tolerance.
        tolerance: makes the macro step adaptive.
        participants: in the place of those in this process.
        **options: of `Split.cosimulation`.
    """
    master: CoSimulation
    with cut.cosimulation(
        record=RECORDED,
        method=method,
        order=order,
        step=step,
        tolerance=tolerance,
        participants=participants,
        **options,
    ) as master:
        result = master.simulate(duration, throw=False)
    ok = result.result == "successful"
    return Outcome(
        label=label,
        method=method,
        order=order,
        step=step if tolerance is None else float("nan"),
        steps=int(result.stats["macro_steps"]),
        rejected=int(result.stats["rejected"]),
        rmse=reference.rmse(result.t, result["cylinder.x"]) if ok else float("nan"),
        energy=result.energy_residual if ok else float("inf"),
        real_time_factor=float(result.stats["real_time_factor"]),
        end=float(result.t[-1]),
        result=result,
    )


@dataclass(frozen=True)
class Setting:
    """A row of Table 2.

    Attributes:
        label: methods and participants.
        paper: real-time factor and RMSE [m] that the paper prints, None where it has no such row.
        hydraulics: solver of the hydraulics in this process, None for an FMU.
        mujoco: whether the boom is in MuJoCo.
        version: of FMI, of the sides that are FMUs.
    """

    label: str
    paper: tuple[float, float] | None
    hydraulics: str | None
    mujoco: bool
    version: str = "2.0"


SETTINGS: Final[tuple[Setting, ...]] = (
    Setting("RK4, two participants", (0.19, 0.52e-3), "rk4", False),
    Setting("RK4 and MuJoCo", (0.17, 0.55e-3), "rk4", True),
    Setting("Adams, two participants", (0.03, 0.61e-3), "adams", False),
    Setting("Adams and MuJoCo", (0.05, 0.62e-3), "adams", True),
    Setting("two FMUs 2.0 (Rodas5P)", None, None, False),
    Setting("two FMUs 3.0 (Rodas5P)", None, None, False, "3.0"),
    Setting("FMU 2.0 and MuJoCo", None, None, True),
)
"""The four rows of the paper's Table 2, and the same with files of exported units."""


def run_setting(cut: Split, reference: Reference, setting: Setting, folder: Path, duration: float) -> Outcome:
    """A row of Table 2.

    Args:
        cut: of `cut_crane`.
        reference: at least as long.
        setting: the row.
        folder: where FMUs are written.
        duration: simulated time [s].
    """
    given: dict[str, Any] = {}
    options: dict[str, Any] = {}
    if setting.hydraulics is None:
        given |= cut.fmus(folder / f"fmi{setting.version}", version=setting.version, outputs=RECORDED)
    else:
        options = {"solver": setting.hydraulics, "dt": RK4_STEP if setting.hydraulics == "rk4" else None}
    if setting.mujoco:
        given["boom"] = mujoco_boom(cut)
    return cosimulate(cut, reference, duration, label=setting.label, participants=given, **options)


def table_2(cut: Split, reference: Reference, folder: Path, stage: Stage, duration: float = DURATION) -> list[Outcome]:
    """All rows of Table 2, macro step 0.01 s, Jacobi, inputs extrapolated linearly."""
    made: list[Outcome] = []
    for setting in SETTINGS:
        stage(f"Table 2: {setting.label}")
        made.append(run_setting(cut, reference, setting, folder, duration))
    return made


METHODS: Final[tuple[tuple[Method, int], ...]] = (
    ("jacobi", 0),
    ("jacobi", 1),
    ("jacobi", 2),
    ("gauss-seidel", 0),
    ("gauss-seidel", 1),
    ("gauss-seidel", 2),
)
"""Methods of the master and orders of extrapolation."""


def sweep(
    cut: Split, reference: Reference, steps: Sequence[float], stage: Stage, duration: float, **options: Any
) -> list[Outcome]:
    """Co-simulations with all methods of the master and these macro steps [s]."""
    made: list[Outcome] = []
    for method, order in METHODS:
        for step in steps:
            stage(f"macro step {1e3 * step:g} ms, {method}, order {order}")
            made.append(cosimulate(cut, reference, duration, method=method, order=order, step=step, **options))
    return made


@dataclass(frozen=True)
class Comparison:
    """An adaptive run, and the fixed macro step that is as accurate.

    Attributes:
        adaptive: the run with a tolerance.
        fixed: the run with the largest fixed macro step found that is at least as accurate.
        tolerance: of the adaptive run.
    """

    adaptive: Outcome
    fixed: Outcome
    tolerance: float


def compare_adaptive(cut: Split, reference: Reference, tolerance: float, duration: float, **options: Any) -> Comparison:
    """An adaptive co-simulation and the fixed macro step that is as accurate, by bisection of the number of steps.

    Args:
        cut: of `cut_crane`.
        reference: at least as long.
        tolerance: of the adaptive master.
        duration: simulated time [s].
        **options: of `cosimulate`, for both.
    """
    adaptive = cosimulate(cut, reference, duration, tolerance=tolerance, **options)

    def fixed(n: int) -> Outcome:
        return cosimulate(cut, reference, duration, step=duration / n, **options)

    def enough(outcome: Outcome) -> bool:
        return not outcome.diverged and outcome.rmse <= adaptive.rmse

    high = adaptive.steps
    found = fixed(high)
    while not enough(found):
        high = round(1.5 * high)
        found = fixed(high)
    low = high // 2
    while enough(nearer := fixed(low)):
        high, found, low = low, nearer, low // 2
    while high > 1.05 * low:
        middle = round((low * high) ** 0.5)
        nearer = fixed(middle)
        if enough(nearer):
            high, found = middle, nearer
        else:
            low = middle
    return Comparison(adaptive, found, tolerance)
