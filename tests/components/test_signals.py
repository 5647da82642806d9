"""Flanges that are driven by signals from outside of the model, their derivatives among them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest

import acausal as ac
from acausal import Component, Equations, Input, Output, Vector, connect
from acausal.components import rotational, translational

from .msl_signals import InverseInertia


@pytest.mark.parametrize("engine", ["native", "diffrax"])
def test_derivatives_of_inputs_are_inputs(engine: Any) -> None:
    """The torque that moves 2 kg m2 is 2 a, whatever the angle is: nothing is differentiated by numbers."""
    system = ac.compile(InverseInertia(J=2.0))
    assert system.states == ()
    given = {"phi": 0.5, "w": 3.0, "a": 4.0}
    solution = system.simulate(1.0, inputs=given, saveat=[0.0, 1.0], engine=engine)
    np.testing.assert_allclose(solution["tau"], 8.0, rtol=1e-12)
    np.testing.assert_allclose(solution["inertia.w"], 3.0, rtol=1e-12)
    np.testing.assert_allclose(solution["inertia.phi"], 0.5, rtol=1e-12)


def test_speed_of_a_damper_is_an_input() -> None:
    class Damped(Component):
        """Two flanges of a damper, moved by signals; one of them backwards."""

        move: rotational.AngleToTorqueAdaptor = rotational.AngleToTorqueAdaptor(use_a=False)
        phi: Input = Input(unit="rad")
        w: Input = Input(unit="rad/s")
        tau: Output = Output(unit="N*m")
        damper: rotational.Damper = rotational.Damper(d=5.0, stateSelect="default")
        wall: rotational.Fixed = rotational.Fixed()

        def equations(self) -> Equations:
            yield self.move.phi == -self.phi
            yield self.move.w == -self.w
            yield connect(self.move.flange, self.damper.flange_b)
            yield connect(self.wall.flange, self.damper.flange_a)
            yield self.tau == self.move.tau

    solution = ac.compile(Damped()).simulate(1.0, inputs={"phi": 1.0, "w": 3.0}, saveat=[1.0])
    np.testing.assert_allclose(solution["tau"], -15.0, rtol=1e-12)


def test_missing_derivative_is_asked_for() -> None:
    """A mass needs the acceleration, too."""

    class Moved(Component):
        p: Input = Input(unit="m")
        v: Input = Input(unit="m/s")
        move: translational.GeneralPositionToForceAdaptor = translational.GeneralPositionToForceAdaptor(use_pder2=False)
        mass: translational.Mass = translational.Mass()

        def equations(self) -> Equations:
            yield connect(self.p, self.move.p)
            yield connect(self.v, self.move.pder)
            yield connect(self.move.flange, self.mass.flange_a)

    with pytest.raises(ac.StructureError, match=r"must differentiate `.*v`.*or pass its derivative as an input"):
        ac.compile(Moved())


class Lifted(Component):
    """A mass that is moved by three inputs."""

    u: Vector = Vector(Input(), size=3)
    f: Output = Output(unit="N")
    move: translational.Move = translational.Move()
    mass: translational.Mass = translational.Mass(m=3.0)

    def equations(self) -> Equations:
        yield connect(self.u, self.move.u)
        yield connect(self.move.flange, self.mass.flange_a)
        yield self.f == self.mass.flange_a.f


def test_move_by_inputs() -> None:
    inputs = {"u[1]": 1.0, "u[2]": 2.0, "u[3]": 4.0}
    solution = ac.compile(Lifted()).simulate(1.0, inputs=inputs, saveat=[1.0])
    np.testing.assert_allclose([solution["f"][0], solution["mass.v"][0]], [12.0, 2.0], rtol=1e-12)


def test_unit_that_is_moved(tmp_path: Path) -> None:
    """The exported unit answers with the force, as that of any other tool."""
    path = tmp_path / "lifted.fmu"
    ac.fmi.export(ac.compile(Lifted()), path)
    result = fmpy.simulate_fmu(
        str(path), start_values={"u[1]": 1.0, "u[2]": 2.0, "u[3]": 4.0}, output=["f"], stop_time=1.0
    )
    np.testing.assert_allclose(result["f"], 12.0, rtol=1e-12)


def test_start_by_signals() -> None:
    """`InitializeFlange` can ask for an acceleration: the spring is stretched to what gives it."""

    class Started(Component):
        begin: translational.InitializeFlange = translational.InitializeFlange(use_s_start=False)
        wall: translational.Fixed = translational.Fixed()
        spring: translational.Spring = translational.Spring(c=8.0)
        mass: translational.Mass = translational.Mass(m=2.0)

        def equations(self) -> Equations:
            yield connect(self.wall.flange, self.spring.flange_a)
            yield connect(self.spring.flange_b, self.mass.flange_a)
            yield connect(self.begin.flange, self.mass.flange_b)
            yield self.begin.v_start == 1.0
            yield self.begin.a_start == -2.0

    solution = ac.compile(Started()).simulate(1.0, saveat=[0.0, 1.0], rtol=1e-9)
    t = np.array([0.0, 1.0])
    np.testing.assert_allclose(solution["mass.s"], 0.5 * np.cos(2 * t) + 0.5 * np.sin(2 * t), atol=1e-7)
