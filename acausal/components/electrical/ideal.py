"""Branches that carry nothing or drop nothing."""

from __future__ import annotations

from acausal import Equations

from .interfaces import OnePort


class Idle(OnePort):
    """Idle branch, ``i = 0``.

    >>> model = assemble("source.p - idle.p", "source.n - idle.n - ground.p", source=ConstantVoltage(V=2.0),
    ...                  idle=Idle(), ground=Ground())
    >>> run(model)["source.i"][-1]
    0.0

    Source: Modelica.Electrical.Analog.Ideal.Idle.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.i == 0


class Short(OnePort):
    """Short cut, ``v = 0``.

    >>> model = assemble("source.p - short.p", "short.n - load.p", "source.n - load.n - ground.p", ground=Ground(),
    ...                  source=ConstantVoltage(V=2.0), short=Short(), load=Resistor(R=4.0))
    >>> run(model)["short.i"][-1]
    0.5

    Source: Modelica.Electrical.Analog.Ideal.Short.
    """

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == 0
