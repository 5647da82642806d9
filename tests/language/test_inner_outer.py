"""Shared components."""

from __future__ import annotations

import pytest

import acausal as ac
from acausal import Array, Component, Equations, Expr, Parameter, Variable, der, inner, outer
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


class Hall(World):
    """A world that says how heavy things are in it."""

    def weight(self, m: Expr) -> Expr:
        return m * self.g


class Lift(Hall):
    """Things are heavier here while it accelerates."""

    accelerates: bool = True

    def weight(self, m: Expr) -> Expr:
        return super().weight(m) * (2 if self.accelerates else 1)


class Bag(Component):
    """Its equation is made by a method of the world."""

    world: Hall = outer(Hall())
    f: Variable = Variable(unit="N")
    m: Parameter = Parameter(3.0, unit="kg")

    def equations(self) -> Equations:
        yield self.f == self.world.weight(self.m)


class Scales(Component):
    world: Hall = inner(Hall(g=10.0))
    bag: Bag = Bag()
    more: Bag = Bag(m=4.0)


@pytest.mark.parametrize(("world", "wanted"), [(Hall(), 30.0), (Lift(), 60.0), (Lift(accelerates=False), 30.0)])
def test_methods_and_structure_of_the_inner_component_count(world: Hall, wanted: float) -> None:
    solution = ac.compile(Scales(world=world)).simulate(1.0, saveat=[1.0])
    assert solution["bag.f"][0] == wanted and solution["more.f"][0] == wanted * 4 / 3


def test_each_sees_the_inner_component_above_it() -> None:
    class Building(Component):
        hall: Scales = Scales()
        lift: Scales = Scales(world=Lift())

    solution = ac.compile(Building()).simulate(1.0, saveat=[1.0])
    assert solution["hall.bag.f"][0] == 30.0 and solution["lift.bag.f"][0] == 60.0
