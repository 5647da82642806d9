"""Names, defaults and signs of variables that PlanarMechanics has."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

import acausal as ac
from acausal import start
from acausal.components import planar, rotational
from acausal.components.examples import assemble

FLOATING = planar.PlanarWorld(constantGravity=(0.0, 0.0))
AT_REST: dict[str, Any] = {"phi": start(0.5, fixed=True), "w": start(0.0, fixed=True)}


def of(run: ac.Solution, *names: str) -> list[float]:
    return [float(run[name][-1]) for name in names]


def test_air_tells_its_velocity_and_brakes_forward_only() -> None:
    """The drag of this speed is `fDrag` in both directions, and what acts is `f_long`."""
    for speed, acts in ((3.0, 1.0), (-3.0, 0.0)):
        v = start((speed * np.cos(0.5), speed * np.sin(0.5)), fixed=True)
        car = planar.Body(r=start((0.0, 0.0), fixed=True), v=v, **AT_REST)
        air = planar.AirResistanceLongitudinal(c_W=0.5, area=2.0, rho=1.2)
        model = assemble("air.frame_a - car.frame_a", planarWorld=ac.inner(FLOATING), air=air, car=car)
        run = ac.compile(model).simulate(t1=1e-9, saveat=2)
        assert of(run, "air.fDrag", "air.f_long") == pytest.approx([5.4, 5.4 * acts])
        assert of(run, "air.vAir[1]", "air.vAir[2]") == pytest.approx([-speed, 0.0], abs=1e-7)
        force = 5.4 * acts * np.cos(0.5)
        assert of(run, "car.f[1]", "air.frame_a.fx") == pytest.approx([-force, force])


def test_a_rolling_wheel_has_coordinates() -> None:
    """Its radius is 1 m unless it is given."""
    wheel = planar.IdealRolling(x=start(2.0, fixed=True), w=start(-3.0, fixed=True), phi=start(0.0, fixed=True))
    model = assemble("wheel.frame_a - disc.frame_a", disc=planar.Body(m=2.0, I=0.5), wheel=wheel,
                     planarWorld=ac.inner(planar.PlanarWorld(constantGravity=(5.0, -10.0))))  # fmt: skip
    run = ac.compile(model).simulate(t1=1.0, saveat=2, rtol=1e-9)
    rate = 2.0 * 5.0 / (2.0 + 0.5)
    assert of(run, "wheel.x", "wheel.vx") == pytest.approx([2.0 + 3.0 + rate / 2, 3.0 + rate])
    assert of(run, "wheel.phi", "wheel.w", "wheel.z") == pytest.approx([-3.0 - rate / 2, -3.0 - rate, -rate])


def test_a_wheel_tells_its_direction_and_a_gear_its_mesh() -> None:
    car = planar.Body(m=3.0, I=1.0, r=start((0.0, 0.0), fixed=True), **AT_REST)
    model = assemble(
        "drive.flange - wheel.flange_a", "wheel.frame_a - car.frame_a", planarWorld=ac.inner(FLOATING), car=car,
        drive=rotational.ConstantTorque(tau_constant=1.5),
        wheel=planar.IdealWheelJoint(radius=0.25, r=(0.0, 2.0), w_roll=start(4.0, fixed=True)),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=1e-9, saveat=2)
    assert of(run, "wheel.e0[1]", "wheel.e0[2]") == pytest.approx([-np.sin(0.5), np.cos(0.5)])
    assert of(run, "wheel.v[1]", "wheel.v[2]") == pytest.approx([-np.sin(0.5), np.cos(0.5)])
    assert of(run, "wheel.a", "wheel.v_long") == pytest.approx([1.5 / 0.25 / 3.0, 1.0])


def test_gears_tell_the_way_of_their_teeth() -> None:
    big = planar.Revolute(useFlange=True, phi=start(0.3, fixed=True), w=start(2.0, fixed=True))
    model = assemble(
        "here.frame - one.frame_a", "there.frame - two.frame_a", "one.frame_b - big.frame_a - mesh.frame_a",
        "two.frame_b - small.frame_a - mesh.frame_b", "drive.flange - one.flange_a", planarWorld=ac.inner(FLOATING),
        drive=rotational.ConstantTorque(tau_constant=3.0), here=planar.Fixed(), there=planar.Fixed(r=(3.0, 0.0)),
        one=big, two=planar.Revolute(), big=planar.Body(I=4.0), small=planar.Body(I=0.5),
        mesh=planar.RigidNoLossExternal(r_a=2.0),
    )  # fmt: skip
    run = ac.compile(model).simulate(t1=1e-9, saveat=2)
    assert of(run, "mesh.xmesh_a", "mesh.xmesh_b", "mesh.v_mesh") == pytest.approx([0.6, 0.6, 4.0])
    assert of(run, "mesh.a_mesh") == pytest.approx([2.0 * 3.0 / (4.0 + 4.0 * 0.5)])


def test_rods_and_slides_tell_where_they_point() -> None:
    model = assemble(
        "wall.frame - rod.frame_a", "rod.frame_b - slide.frame_a", "slide.frame_b - load.frame_a",
        wall=planar.Fixed(phi=0.5), rod=planar.FixedTranslation(r=(2.0, 1.0)), load=planar.Body(),
        slide=planar.Prismatic(r=(0.0, 3.0), s=start(2.0, fixed=True), v=start(0.0, fixed=True), stateSelect="always"),
        planarWorld=ac.inner(FLOATING),
    )  # fmt: skip
    system = ac.compile(model)
    assert system.states == ("slide.s", "slide.v")
    run, c, s = system.simulate(t1=1e-9, saveat=2), np.cos(0.5), np.sin(0.5)
    assert of(run, "rod.r0[1]", "rod.r0[2]") == pytest.approx([2.0 * c - s, 2.0 * s + c])
    assert of(run, "slide.e0[1]", "slide.e0[2]", "slide.r0[1]", "slide.r0[2]") == pytest.approx([-s, c, -2 * s, 2 * c])
