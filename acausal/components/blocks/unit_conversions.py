"""Signals in other units (Modelica.Blocks.Math.UnitConversions)."""

from __future__ import annotations

import math
from typing import ClassVar

from acausal import Component, Equations, Input, Output


class PartialConversion(Component, partial=True):
    """A quantity in one unit as the same quantity in another one.

    Source: Modelica.Blocks.Interfaces.PartialConversionBlock.
    """

    u: Input = Input(doc="quantity in the one unit")
    y: Output = Output(doc="the same quantity in the other unit")


class PartialTo(PartialConversion, partial=True):
    """From a unit of the SI to another one, ``y = u/factor``.

    Source: Modelica.Blocks.Interfaces.PartialConversionBlock.
    """

    factor: ClassVar[float] = 1.0

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.factor * self.y == self.u


class PartialFrom(PartialConversion, partial=True):
    """From another unit to that of the SI, ``y = factor u``.

    Source: Modelica.Blocks.Interfaces.PartialConversionBlock.
    """

    factor: ClassVar[float] = 1.0

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.factor * self.u


class To_degC(PartialConversion):
    """From kelvin to degrees Celsius, ``y = u - 273.15``.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=300.0), to=To_degC()))["to.y"], [26.85, 26.85])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_degC.
    """

    u: Input = Input(unit="K", doc="temperature in kelvin")
    y: Output = Output(unit="degC", doc="temperature in degrees Celsius")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u - 273.15


class From_degC(PartialConversion):
    """From degrees Celsius to kelvin, ``y = u + 273.15``.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=26.85), of=From_degC()))["of.y"], [300.0, 300.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_degC.
    """

    u: Input = Input(unit="degC", doc="temperature in degrees Celsius")
    y: Output = Output(unit="K", doc="temperature in kelvin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u + 273.15


class To_degF(PartialConversion):
    """From kelvin to degrees Fahrenheit, ``y = (u - 273.15) 1.8 + 32.0``.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=300.0), to=To_degF()))["to.y"], [80.33, 80.33])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_degF.
    """

    u: Input = Input(doc="temperature in kelvin")
    y: Output = Output(doc="temperature in degrees Fahrenheit")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == (self.u - 273.15) * 1.8 + 32.0


class From_degF(PartialConversion):
    """From degrees Fahrenheit to kelvin, ``y = (u - 32.0) / 1.8 + 273.15``.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=80.33), of=From_degF()))["of.y"], [300.0, 300.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_degF.
    """

    u: Input = Input(doc="temperature in degrees Fahrenheit")
    y: Output = Output(doc="temperature in kelvin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == (self.u - 32.0) / 1.8 + 273.15


class To_degRk(PartialConversion):
    """From kelvin to degrees Rankine, ``y = u 1.8``.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=300.0), to=To_degRk()))["to.y"], [540.0, 540.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_degRk.
    """

    u: Input = Input(doc="temperature in kelvin")
    y: Output = Output(doc="temperature in degrees Rankine")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u * 1.8


class From_degRk(PartialConversion):
    """From degrees Rankine to kelvin, ``y = u / 1.8``.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=540.0), of=From_degRk()))["of.y"], [300.0, 300.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_degRk.
    """

    u: Input = Input(doc="temperature in degrees Rankine")
    y: Output = Output(doc="temperature in kelvin")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u / 1.8


class To_deg(PartialTo):
    """From radian to degrees.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=np.pi / 6), to=To_deg()))["to.y"], [30.0, 30.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_deg.
    """

    factor: ClassVar[float] = math.pi / 180
    u: Input = Input(unit="rad", doc="quantity in radian")
    y: Output = Output(unit="deg", doc="quantity in degrees")


class From_deg(PartialFrom):
    """From degrees to radian.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=30.0), of=From_deg()))["of.y"], [np.pi / 6, np.pi / 6])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_deg.
    """

    factor: ClassVar[float] = math.pi / 180
    u: Input = Input(unit="deg", doc="quantity in degrees")
    y: Output = Output(unit="rad", doc="quantity in radian")


class To_rpm(PartialTo):
    """From radian per second to revolutions per minute.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=np.pi), to=To_rpm()))["to.y"], [30.0, 30.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_rpm.
    """

    factor: ClassVar[float] = math.pi / 30
    u: Input = Input(unit="rad/s", doc="quantity in radian per second")
    y: Output = Output(unit="rpm", doc="quantity in revolutions per minute")


class From_rpm(PartialFrom):
    """From revolutions per minute to radian per second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=30.0), of=From_rpm()))["of.y"], [np.pi, np.pi])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_rpm.
    """

    factor: ClassVar[float] = math.pi / 30
    u: Input = Input(unit="rpm", doc="quantity in revolutions per minute")
    y: Output = Output(unit="rad/s", doc="quantity in radian per second")


class To_kmh(PartialTo):
    """From metre per second to kilometres per hour.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=10.0), to=To_kmh()))["to.y"], [36.0, 36.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_kmh.
    """

    factor: ClassVar[float] = 1 / 3.6
    u: Input = Input(unit="m/s", doc="quantity in metre per second")
    y: Output = Output(unit="km/h", doc="quantity in kilometres per hour")


class From_kmh(PartialFrom):
    """From kilometres per hour to metre per second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=36.0), of=From_kmh()))["of.y"], [10.0, 10.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_kmh.
    """

    factor: ClassVar[float] = 1 / 3.6
    u: Input = Input(unit="km/h", doc="quantity in kilometres per hour")
    y: Output = Output(unit="m/s", doc="quantity in metre per second")


class To_day(PartialTo):
    """From second to days.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=43200.0), to=To_day()))["to.y"], [0.5, 0.5])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_day.
    """

    factor: ClassVar[float] = 86400.0
    u: Input = Input(unit="s", doc="quantity in second")
    y: Output = Output(unit="d", doc="quantity in days")


class From_day(PartialFrom):
    """From days to second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=0.5), of=From_day()))["of.y"], [43200.0, 43200.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_day.
    """

    factor: ClassVar[float] = 86400.0
    u: Input = Input(unit="d", doc="quantity in days")
    y: Output = Output(unit="s", doc="quantity in second")


class To_hour(PartialTo):
    """From second to hours.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=1800.0), to=To_hour()))["to.y"], [0.5, 0.5])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_hour.
    """

    factor: ClassVar[float] = 3600.0
    u: Input = Input(unit="s", doc="quantity in second")
    y: Output = Output(unit="h", doc="quantity in hours")


class From_hour(PartialFrom):
    """From hours to second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=0.5), of=From_hour()))["of.y"], [1800.0, 1800.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_hour.
    """

    factor: ClassVar[float] = 3600.0
    u: Input = Input(unit="h", doc="quantity in hours")
    y: Output = Output(unit="s", doc="quantity in second")


class To_minute(PartialTo):
    """From second to minutes.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=30.0), to=To_minute()))["to.y"], [0.5, 0.5])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_minute.
    """

    factor: ClassVar[float] = 60.0
    u: Input = Input(unit="s", doc="quantity in second")
    y: Output = Output(unit="min", doc="quantity in minutes")


class From_minute(PartialFrom):
    """From minutes to second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=0.5), of=From_minute()))["of.y"], [30.0, 30.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_minute.
    """

    factor: ClassVar[float] = 60.0
    u: Input = Input(unit="min", doc="quantity in minutes")
    y: Output = Output(unit="s", doc="quantity in second")


class To_litre(PartialTo):
    """From cubic metre to litres.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=0.002), to=To_litre()))["to.y"], [2.0, 2.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_litre.
    """

    factor: ClassVar[float] = 1e-3
    u: Input = Input(unit="m3", doc="quantity in cubic metre")
    y: Output = Output(unit="l", doc="quantity in litres")


class From_litre(PartialFrom):
    """From litres to cubic metre.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=2.0), of=From_litre()))["of.y"], [0.002, 0.002])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_litre.
    """

    factor: ClassVar[float] = 1e-3
    u: Input = Input(unit="l", doc="quantity in litres")
    y: Output = Output(unit="m3", doc="quantity in cubic metre")


class To_kWh(PartialTo):
    """From joule to kilowatt hours.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=7.2e6), to=To_kWh()))["to.y"], [2.0, 2.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_kWh.
    """

    factor: ClassVar[float] = 3.6e6
    u: Input = Input(unit="J", doc="quantity in joule")
    y: Output = Output(unit="kWh", doc="quantity in kilowatt hours")


class From_kWh(PartialFrom):
    """From kilowatt hours to joule.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=2.0), of=From_kWh()))["of.y"], [7.2e6, 7.2e6])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_kWh.
    """

    factor: ClassVar[float] = 3.6e6
    u: Input = Input(unit="kWh", doc="quantity in kilowatt hours")
    y: Output = Output(unit="J", doc="quantity in joule")


class To_bar(PartialTo):
    """From pascal to bar.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=2e5), to=To_bar()))["to.y"], [2.0, 2.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_bar.
    """

    factor: ClassVar[float] = 1e5
    u: Input = Input(unit="Pa", doc="quantity in pascal")
    y: Output = Output(unit="bar", doc="quantity in bar")


class From_bar(PartialFrom):
    """From bar to pascal.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=2.0), of=From_bar()))["of.y"], [2e5, 2e5])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_bar.
    """

    factor: ClassVar[float] = 1e5
    u: Input = Input(unit="bar", doc="quantity in bar")
    y: Output = Output(unit="Pa", doc="quantity in pascal")


class To_gps(PartialTo):
    """From kilogram per second to grams per second.

    >>> close(run(assemble("source.y - to.u", source=Constant(k=0.002), to=To_gps()))["to.y"], [2.0, 2.0])
    True

    Source: Modelica.Blocks.Math.UnitConversions.To_gps.
    """

    factor: ClassVar[float] = 1e-3
    u: Input = Input(unit="kg/s", doc="quantity in kilogram per second")
    y: Output = Output(unit="g/s", doc="quantity in grams per second")


class From_gps(PartialFrom):
    """From grams per second to kilogram per second.

    >>> close(run(assemble("source.y - of.u", source=Constant(k=2.0), of=From_gps()))["of.y"], [0.002, 0.002])
    True

    Source: Modelica.Blocks.Math.UnitConversions.From_gps.
    """

    factor: ClassVar[float] = 1e-3
    u: Input = Input(unit="g/s", doc="quantity in grams per second")
    y: Output = Output(unit="kg/s", doc="quantity in kilogram per second")
