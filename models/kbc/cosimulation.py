"""The paper's co-simulation: the crane cut between joint and boom, as two participants, as FMUs, with MuJoCo."""

from __future__ import annotations

from collections.abc import Callable, Mapping
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
Scenario = Literal["sine", "step", "endstop"]
Stage = Callable[[str], None]

MACRO_STEP: Final = 0.01
"""Macro step of the paper [s]."""
RECORDED: Final = ("cylinder.x", "cylinder.port_a.q", "cylinder.p_a")
RK4_STEP: Final = 1e-5
"""Step of the Runge-Kutta method inside [s]; the oil between the valves allows no more than about 1.6e-5 s."""
_FINE: Final = 1e-4
"""Spacing of the reference trajectory [s]; communication points lie on it, or close by."""
_LOST: Final = 1.0
"""A prediction that is off by as much as the signal is large: the co-simulation has lost the motion."""


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

    def deviation(self, t: Floats, x: Floats) -> Floats:
        """Deviation of the piston displacement [m].

        Args:
            t: times [s], (n,), from 0 to at most the end of the reference.
            x: displacement of the piston at these times [m], (n,).
        """
        return x - np.interp(t, self.t, self.signals["cylinder.x"])

    def rmse(self, t: Floats, x: Floats, until: float = np.inf) -> float:
        """Root mean square over time of the `deviation` [m], up to a time [s]."""
        part = t <= until * (1 + 1e-9)
        squared = self.deviation(t[part], x[part]) ** 2
        return float(np.sqrt(np.trapezoid(squared, t[part]) / (t[part][-1] - t[0])))


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
        energy: largest energy residual of the power bond, relative to the energy that passed through it; inf if the run
            diverged.
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
        """Whether the run ended before its time, or lost the motion: a limit of the cylinder may keep it finite."""
        return _diverged(self.result)

    @property
    def tried(self) -> int:
        """Macro steps with those that were taken back."""
        return self.steps + self.rejected


def _diverged(result: CoSimulationResult) -> bool:
    return result.result != "successful" or bool(np.max(result.defect) > _LOST)


def _relative_energy(result: CoSimulationResult) -> float:
    """Largest energy residual by the energy that passed through the bond."""
    (power,) = result.power.values()
    return result.energy_residual / float(np.trapezoid(np.abs(power), result.t))


def cut_crane(scenario: Scenario = "sine") -> Split:
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


def rigid_crane(reference: Reference, scenario: Scenario = "sine") -> tuple[float, float]:
    """RMSE [m] to the reference and real-time factor of the rigid crane in one piece, by index reduction."""
    system = ac.compile(reference_crane(hydraulics="extended", joint="rigid", scenario=scenario))
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
    ok = not _diverged(result)
    return Outcome(
        label=label,
        method=method,
        order=order,
        step=step if tolerance is None else float("nan"),
        steps=int(result.stats["macro_steps"]),
        rejected=int(result.stats["rejected"]),
        rmse=reference.rmse(result.t, result["cylinder.x"]) if ok else float("nan"),
        energy=_relative_energy(result) if ok else float("inf"),
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
        solver: inside the units.
        mujoco: whether the boom is in MuJoCo.
        version: of FMI; None for participants in this process instead of units.
    """

    label: str
    paper: tuple[float, float] | None
    solver: str
    mujoco: bool = False
    version: str | None = "2.0"


SETTINGS: Final[tuple[Setting, ...]] = (
    Setting("RK4, two FMUs", (0.19, 0.52e-3), "rk4"),
    Setting("RK4, FMU and MuJoCo", (0.17, 0.55e-3), "rk4", mujoco=True),
    Setting("Adams, two FMUs", (0.03, 0.61e-3), "adams"),
    Setting("Adams, FMU and MuJoCo", (0.05, 0.62e-3), "adams", mujoco=True),
    Setting("Rodas5P, two FMUs", None, "rodas5p"),
    Setting("Rodas5P, FMU and MuJoCo", None, "rodas5p", mujoco=True),
    Setting("Rodas5P, two FMUs of FMI 3.0", None, "rodas5p", version="3.0"),
    Setting("Rodas5P, in one process", None, "rodas5p", version=None),
)
"""The four rows of the paper's Table 2, with RK4 and Adams inside and MuJoCo in the place of AgX; then the same with
the stiff method inside. Units are of FMI 2.0, which hands the slopes of inputs on."""


def run_setting(cut: Split, reference: Reference, setting: Setting, folder: Path, duration: float) -> Outcome:
    """A row of Table 2: macro step 0.01 s, Jacobi, inputs extrapolated linearly.

    Args:
        cut: of `cut_crane`.
        reference: at least as long.
        setting: the row.
        folder: where FMUs are written.
        duration: simulated time [s].
    """
    given: dict[str, Any] = {}
    dt = RK4_STEP if setting.solver == "rk4" else None
    if setting.version is not None:
        place = folder / f"{setting.solver}-{setting.version}"
        given |= cut.fmus(place, version=setting.version, outputs=RECORDED, solver=setting.solver, dt=dt)
    if setting.mujoco:
        given["boom"] = mujoco_boom(cut)
    return cosimulate(cut, reference, duration, label=setting.label, participants=given, solver=setting.solver, dt=dt)
