"""Boundaries, a sensor and conversions for temperatures in degrees Celsius; those of the ports stay in kelvin.

``thermal.celsius.FixedTemperature(T=20.0)`` is a room, ``thermal.FixedTemperature(T=20.0)`` is liquid hydrogen: both
are meant by somebody, so that neither warns. A signal of the one unit on an input of the other is a `UnitError`.
The names are those of Modelica.Thermal.HeatTransfer.Celsius, so that they have a module of their own.
"""

from __future__ import annotations

from acausal import Component, Equations, Input, Output, Parameter

from .interfaces import HeatPort


class FixedTemperature(Component):
    """Boundary of a temperature given in degrees Celsius, ``port.T = T + 273.15``.

    >>> model = assemble("room.port - wall.port_a", "wall.port_b - cold.port", wall=ThermalConductor(G=2.0),
    ...                  room=celsius.FixedTemperature(T=20.0), cold=FixedTemperature(T=273.15))
    >>> room = run(model)
    >>> room["room.port.T"][-1], room["wall.Q_flow"][-1]
    (293.15, 40.0)

    Source: Modelica.Thermal.HeatTransfer.Celsius.FixedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Parameter = Parameter(20.0, unit="degC", doc="temperature in degrees Celsius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T + 273.15


class PrescribedTemperature(Component):
    """Boundary whose temperature is a signal in degrees Celsius, ``port.T = T + 273.15``.

    >>> model = assemble("ramp.y - hot.T", "hot.port - wall.port_a", "wall.port_b - cold.port",
    ...                  hot=celsius.PrescribedTemperature(), wall=ThermalConductor(G=2.0),
    ...                  cold=celsius.FixedTemperature(T=0.0), ramp=blocks.Slope(offset=20.0, slope=10.0))
    >>> run(model, at=[0.0, 1.0])["wall.Q_flow"]
    [40.0, 60.0]

    Source: Modelica.Thermal.HeatTransfer.Celsius.PrescribedTemperature.
    """

    port: HeatPort = HeatPort()
    T: Input = Input(unit="degC", doc="temperature in degrees Celsius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.port.T == self.T + 273.15


class TemperatureSensor(Component):
    """Temperature of what is connected in degrees Celsius, ``T = port.T - 273.15``; takes no heat.

    >>> model = assemble("body.port - meter.port", body=FixedTemperature(T=310.15), meter=celsius.TemperatureSensor())
    >>> run(model)["meter.T"][-1]
    37.0

    Source: Modelica.Thermal.HeatTransfer.Celsius.TemperatureSensor.
    """

    port: HeatPort = HeatPort()
    T: Output = Output(unit="degC", doc="temperature in degrees Celsius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T == self.port.T - 273.15
        yield self.port.Q_flow == 0


class ToKelvin(Component):
    """Conversion of a signal, ``Kelvin = Celsius + 273.15``.

    >>> model = assemble("ramp.y - scale.Celsius", "scale.Kelvin - hot.T", "hot.port - meter.port",
    ...                  scale=celsius.ToKelvin(), hot=PrescribedTemperature(), meter=celsius.TemperatureSensor(),
    ...                  ramp=blocks.Slope(offset=20.0, slope=10.0))
    >>> hot = run(model, at=[0.0, 1.0])
    >>> hot["scale.Kelvin"], hot["meter.T"]
    ([293.15, 303.15], [20.0, 30.0])

    Source: Modelica.Thermal.HeatTransfer.Celsius.ToKelvin.
    """

    Celsius: Input = Input(unit="degC", doc="temperature in degrees Celsius")
    Kelvin: Output = Output(unit="K", doc="the same in kelvin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Kelvin == self.Celsius + 273.15


class FromKelvin(Component):
    """Conversion of a signal, ``Celsius = Kelvin - 273.15``.

    >>> model = assemble("body.port - meter.port", "meter.T - scale.Kelvin", body=FixedTemperature(T=310.15),
    ...                  meter=TemperatureSensor(), scale=celsius.FromKelvin())
    >>> run(model)["scale.Celsius"][-1]
    37.0

    Source: Modelica.Thermal.HeatTransfer.Celsius.FromKelvin.
    """

    Kelvin: Input = Input(unit="K", doc="temperature in kelvin")
    Celsius: Output = Output(unit="degC", doc="the same in degrees Celsius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Celsius == self.Kelvin - 273.15
