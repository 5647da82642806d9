"""Connectors that exist only where a structural parameter says so, and structural parameters that are tables."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import pytest

import acausal as ac
from acausal import Component, Connector, Equations, Flow, Parameter, Potential, Variable, conditional, connect


class Port(Connector):
    T: Potential = Potential(unit="K")
    Q: Flow = Flow(unit="W")


class Heater(Component):
    use_port: bool = False
    rows: Sequence[Sequence[float]] = ((0.0, 1.0),)
    port: Port = conditional(Port(), "use_port")
    P: Parameter = Parameter(5.0, unit="W")
    loss: Variable = Variable(unit="W")

    def equations(self) -> Equations:
        yield self.loss == self.P * sum(row[1] for row in self.rows)
        if self.use_port:
            yield self.port.Q == -self.loss


class Sink(Component):
    port: Port = Port()

    def equations(self) -> Equations:
        yield self.port.T == 300.0


class Rig(Component):
    heater: Heater = Heater(use_port=True)
    sink: Sink = Sink()

    def equations(self) -> Equations:
        yield connect(self.heater.port, self.sink.port)


def test_a_connector_that_is_there_and_one_that_is_not() -> None:
    assert "port.T" not in ac.compile(Heater()).observed
    solution = ac.compile(Rig()).simulate(t1=1.0)
    np.testing.assert_allclose(solution["sink.port.Q"], 5.0)


def test_the_absent_connector_is_explained() -> None:
    with pytest.raises(ac.DeclarationError, match=r"`heater` of class `Heater` has `port` only with `use_port=True`"):
        ac.compile(Rig(heater=Heater(use_port=False)))


def test_tables_are_sequences_of_numbers() -> None:
    assert Heater(rows=[[0, 1], [1, 2]]).rows == ((0.0, 1.0), (1.0, 2.0))
    assert Heater(rows=np.eye(2)).rows == ((1.0, 0.0), (0.0, 1.0))  # type: ignore[arg-type]
    solution = ac.compile(Heater(rows=[[0, 1], [1, 2]])).simulate(t1=1.0)
    np.testing.assert_allclose(solution["loss"], 15.0)
    with pytest.raises(ac.DeclarationError, match="`rows` takes rows of numbers only"):
        Heater(rows=[["a"]])  # type: ignore[list-item]


def test_the_condition_must_be_a_field() -> None:
    with pytest.raises(ac.DeclarationError, match="depends on `used`, which is no boolean field or property"):

        class Wrong(Component):
            port: Port = conditional(Port(), "used")

        del Wrong
