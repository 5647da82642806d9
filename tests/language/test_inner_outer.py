"""Shared components."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Array, Component, Equations, Parameter, Variable, der, inner, outer
from acausal.language.flatten import flatten

from .parts import Pin
from .support import equations, fields, parameters


class World(Component):
    g: Parameter = Parameter(9.81, unit="m/s2")
    T: Variable = Variable(unit="K")

    def equations(self) -> Equations:
        yield self.T == 300


class Moon(World):
    g: Parameter = Parameter(1.62, unit="m/s2")


class Body(Component):
    world: World = outer(World())
    m: Parameter = Parameter(2.0, unit="kg")
    v: Variable = Variable(unit="m/s")

    def equations(self) -> Equations:
        yield self.m * der(self.v) == self.m * self.world.g + 0 * self.world.T


class Arm(Component):
    body: Body = Body()


class Scene(Component):
    world: World = inner(World())
    arm: Arm = Arm()
    bodies: Array[Body] = Array(Body(), 2)


def test_all_refer_to_the_one_above() -> None:
    model = Scene()
    assert fields(model) == (
        ["world.T", "arm.body.v", "bodies[0].v", "bodies[1].v"],
        ["world.g", "arm.body.m", "bodies[0].m", "bodies[1].m"],
    )
    lines = equations(model)
    assert "arm.body.m*der(arm.body.v) = arm.body.m*world.g" in lines
    assert "bodies[1].m*der(bodies[1].v) = bodies[1].m*world.g" in lines
    assert lines.count("world.T = 300") == 1


def test_the_inner_component_can_be_replaced() -> None:
    assert parameters(Scene(world=Moon()))["world.g"] == 1.62
    assert parameters(ac.redeclare(Scene(), {"world": Moon()}))["world.g"] == 1.62


def test_the_nearest_enclosing_one_counts() -> None:
    class Room(Component):
        world: World = inner(World(g=1.0))
        body: Body = Body()

    class House(Component):
        world: World = inner(World(g=2.0))
        room: Room = Room()
        body: Body = Body()

    lines = equations(House())
    assert "room.body.m*der(room.body.v) = room.body.m*room.world.g" in lines
    assert "body.m*der(body.v) = body.m*world.g" in lines


def test_arrays_of_components_with_an_inner_one_each() -> None:
    class Room(Component):
        world: World = inner(World())
        bodies: Array[Body] = Array(Body(), 2)

    class Houses(Component):
        rooms: Array[Room] = Array(Room(), 3)

    lines = equations(Houses())
    assert "rooms[2].bodies[1].m*der(rooms[2].bodies[1].v) = rooms[2].bodies[1].m*rooms[2].world.g" in lines


def test_connectors_of_a_shared_component() -> None:
    class Rail(Component):
        p: Pin = Pin()

        def equations(self) -> Equations:
            yield self.p.v == 0

    class Load(Component):
        rail: Rail = outer(Rail())
        p: Pin = Pin()

        def equations(self) -> Equations:
            yield ac.connect(self.p, self.rail.p)
            yield self.p.i == 1

    class Plant(Component):
        rail: Rail = inner(Rail())
        a: Load = Load()
        b: Load = Load()

    lines = equations(Plant())
    assert any("a.p.v" in line and "rail.p.v" in line for line in lines)


def test_nothing_above() -> None:
    with pytest.raises(ac.DeclarationError) as error:
        flatten(Arm())
    for word in ("`body.world` is declared `outer`", "world: World = ac.inner(World())"):
        assert word in str(error.value)


def test_something_else_above() -> None:
    class Air(Component):
        pass

    class Wrong(Component):
        world: Air = inner(Air())
        body: Body = Body()

    with pytest.raises(ac.DeclarationError, match="inner `world` is a `Air`, not a `World`"):
        flatten(Wrong())
