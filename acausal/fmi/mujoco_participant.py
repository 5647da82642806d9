"""MuJoCo, the physics engine, as a participant: torques in, positions of joints with velocity and acceleration out."""

from __future__ import annotations

import importlib
import math
import time
from collections.abc import Mapping
from typing import Any

import numpy as np

from ..errors import UnknownNameError, nearest
from .participant import CoSimulationError, Floats


class MujocoParticipant:
    """A mechanism in MuJoCo that steps in this process.

    The torque (force) of an input acts on a hinge (slide) joint and follows its polynomial within a macro step, taken
    at the middle of each step of the engine. An output is the position of a joint; velocity and acceleration are known.

    Args:
        xml: the mechanism as MJCF; its `option` elements choose the engine's integrator.
        torques: by input, the joint on which it acts, or the joint and a factor (-1.0 for a flow that counts as
            leaving the mechanism, as the flows of a `split` do).
        positions: by output, the joint whose position it is.
        step: step of the engine [s]; macro steps are cut into equal steps of at most this length.
        initial: by joint, its position at the start [rad or m]; joints start at rest.
        units: by input or output.
        name: shown in messages.

    Raises:
        CoSimulationError: the package is missing, or the engine refuses the mechanism.
        UnknownNameError: a joint that the mechanism does not have.
    """

    can_reject = True

    def __init__(
        self,
        xml: str,
        *,
        torques: Mapping[str, str | tuple[str, float]],
        positions: Mapping[str, str],
        step: float = 1e-3,
        initial: Mapping[str, float] | None = None,
        units: Mapping[str, str] | None = None,
        name: str = "mujoco",
    ) -> None:
        try:
            mujoco: Any = importlib.import_module("mujoco")
        except ImportError as missing:
            raise CoSimulationError(
                f"participant `{name}` needs the package MuJoCo: `pip install acausal[mujoco]`"
            ) from missing
        try:
            self.model: Any = mujoco.MjModel.from_xml_string(xml)
        except ValueError as error:
            raise CoSimulationError(f"participant `{name}`: MuJoCo refuses the mechanism: {error}") from error
        self._engine: Any = mujoco
        self.data: Any = mujoco.MjData(self.model)
        self.name, self.largest_step = name, step
        self.inputs, self.outputs = tuple(torques), tuple(positions)
        self.needs: Mapping[str, int] = {n: 0 for n in self.inputs}
        self.feedthrough: frozenset[str] = frozenset()
        self.units = dict(units or {})
        forced = [(j, 1.0) if isinstance(j, str) else j for j in torques.values()]
        self._forced = np.array([self._joint(j)[1] for j, _ in forced], int)
        self._factors = np.array([factor for _, factor in forced], float)
        self._read = np.array([self._joint(j) for j in positions.values()], int).reshape(-1, 2)
        self._initial = [(self._joint(j)[0], float(q)) for j, q in (initial or {}).items()]
        self._kind = int(mujoco.mjtState.mjSTATE_INTEGRATION)
        self._counts: dict[str, float] = {"macro_steps": 0, "steps": 0, "seconds": 0.0}

    def _joint(self, name: str) -> tuple[int, int]:
        """Places of a joint's position and velocity."""
        joints = [self.model.joint(i).name for i in range(self.model.njnt)]
        if name not in joints:
            raise UnknownNameError(f"participant `{self.name}`: no joint `{name}`.{nearest(name, joints)}")
        number = joints.index(name)
        return int(self.model.jnt_qposadr[number]), int(self.model.jnt_dofadr[number])

    def require(self, output: str, order: int) -> bool:
        """Velocity and acceleration are always known."""
        del output
        return order <= 2

    def nominal(self, name: str) -> float:
        """Unknown: the master takes the size of the signal."""
        del name
        return 0.0

    def start(self, name: str) -> float:
        """A torque that nothing feeds is zero."""
        del name
        return 0.0

    def unit(self, name: str) -> str:
        """As it was given, else empty."""
        return self.units.get(name, "")

    def initialize(self, t0: float, coefficients: Floats) -> None:
        """Joints at their start, at rest."""
        self._engine.mj_resetData(self.model, self.data)
        self.data.time = t0
        for place, q in self._initial:
            self.data.qpos[place] = q
        self._push(coefficients, 0.0)
        self._engine.mj_forward(self.model, self.data)

    def _push(self, coefficients: Floats, s: float) -> None:
        """Torques at time s after the communication point."""
        c0, c1, c2, c3 = coefficients.T
        self.data.qfrc_applied[self._forced] = self._factors * (c0 + s * (c1 + s * (c2 + s * c3)))

    def step(self, t: float, h: float, coefficients: Floats) -> None:
        """Advance from t to t + h in equal steps of the engine.

        Raises:
            CoSimulationError: the engine's state is not finite.
        """
        begin = time.perf_counter()
        n = max(math.ceil(h / self.largest_step - 1e-9), 1)
        self.model.opt.timestep = h / n
        for i in range(n):
            self._push(coefficients, (i + 0.5) * h / n)
            self._engine.mj_step(self.model, self.data)
        self._counts["macro_steps"] += 1
        self._counts["steps"] += n
        self._counts["seconds"] += time.perf_counter() - begin
        if not np.isfinite(self.data.qpos).all() or not np.isfinite(self.data.qvel).all():
            raise CoSimulationError(
                f"participant `{self.name}`: MuJoCo's state is not finite after t = {t + h:.6g} s. Take a smaller "
                "macro step or a smaller `step` of the engine."
            )

    def evaluate(self, t: float, coefficients: Floats) -> Floats:
        """Positions, velocities and accelerations under these torques, (3, n_y)."""
        del t
        begin = time.perf_counter()
        self._push(coefficients, 0.0)
        self._engine.mj_forward(self.model, self.data)
        position, speed = self._read.T
        values = np.stack([self.data.qpos[position], self.data.qvel[speed], self.data.qacc[speed]])
        self._counts["seconds"] += time.perf_counter() - begin
        return values

    def save(self) -> Any:
        """The engine's full integration state."""
        state = np.empty(self._engine.mj_stateSize(self.model, self._kind))
        self._engine.mj_getState(self.model, self.data, state, self._kind)
        return state

    def restore(self, state: Any) -> None:
        """Go back to a saved state."""
        self._engine.mj_setState(self.model, self.data, state, self._kind)

    def close(self) -> None:
        """Nothing is held."""

    @property
    def stats(self) -> dict[str, Any]:
        """Macro steps, steps of the engine, seconds."""
        return dict(self._counts)
