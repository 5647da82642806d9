"""One-dimensional heat transfer with lumped elements (Modelica Standard Library 4.0, `Modelica.Thermal.HeatTransfer`).

Temperatures are absolute [K], but in `celsius`; the heat flow of a port is positive into the component.
"""

from . import celsius as celsius
from .adaptors import GeneralHeatFlowToTemperatureAdaptor as GeneralHeatFlowToTemperatureAdaptor
from .adaptors import GeneralTemperatureToHeatFlowAdaptor as GeneralTemperatureToHeatFlowAdaptor
from .components import BodyRadiation as BodyRadiation
from .components import Convection as Convection
from .components import ConvectiveResistor as ConvectiveResistor
from .components import HeatCapacitor as HeatCapacitor
from .components import PartialConvection as PartialConvection
from .components import ThermalCollector as ThermalCollector
from .components import ThermalConductor as ThermalConductor
from .components import ThermalResistor as ThermalResistor
from .interfaces import Element1D as Element1D
from .interfaces import HeatPort as HeatPort
from .interfaces import PartialConditionalHeatPort as PartialConditionalHeatPort
from .sensors import ConditionalFixedHeatFlowSensor as ConditionalFixedHeatFlowSensor
from .sensors import HeatFlowSensor as HeatFlowSensor
from .sensors import RelTemperatureSensor as RelTemperatureSensor
from .sensors import TemperatureSensor as TemperatureSensor
from .sources import FixedHeatFlow as FixedHeatFlow
from .sources import FixedTemperature as FixedTemperature
from .sources import PrescribedHeatFlow as PrescribedHeatFlow
from .sources import PrescribedTemperature as PrescribedTemperature

CelsiusTemperatureSensor = celsius.TemperatureSensor
"""Its name before there was `celsius`."""
