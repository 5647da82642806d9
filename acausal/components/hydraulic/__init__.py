"""Oil hydraulics: ports, oil, volumes, orifices, valves, pumps and motors, accumulators, pipes, cylinders and sensors.

Pressures are absolute [Pa]; flows are volume flow rates [m3/s], positive into the component. The oil is
incompressible in resistances and of constant bulk modulus in volumes. Every component reads the oil from the nearest
enclosing component that declares ``oil: Oil = inner(Oil())``.

Equation numbers refer to the paper on object-oriented modelling of a knuckle boom crane that the library was built for.
"""

from .accumulators import Accumulator as Accumulator
from .cylinders import Chamber as Chamber
from .cylinders import ExtendedCylinder as ExtendedCylinder
from .cylinders import PartialCylinder as PartialCylinder
from .cylinders import SimplifiedCylinder as SimplifiedCylinder
from .interfaces import HydraulicPort as HydraulicPort
from .interfaces import Oil as Oil
from .interfaces import PartialTwoPort as PartialTwoPort
from .machines import FixedDisplacementMachine as FixedDisplacementMachine
from .machines import Motor as Motor
from .machines import PartialDisplacementMachine as PartialDisplacementMachine
from .machines import Pump as Pump
from .machines import VariableDisplacementMachine as VariableDisplacementMachine
from .orifices import LaminarRestriction as LaminarRestriction
from .orifices import Orifice as Orifice
from .orifices import PartialOrifice as PartialOrifice
from .orifices import VariableOrifice as VariableOrifice
from .orifices import orifice_flow as orifice_flow
from .pipes import BlendedFriction as BlendedFriction
from .pipes import ControlVolume as ControlVolume
from .pipes import LaminarFriction as LaminarFriction
from .pipes import PaperFriction as PaperFriction
from .pipes import PartialFriction as PartialFriction
from .pipes import Pipe as Pipe
from .sensors import FlowSensor as FlowSensor
from .sensors import PressureSensor as PressureSensor
from .sensors import RelativePressureSensor as RelativePressureSensor
from .sources import FixedPump as FixedPump
from .sources import FlowSource as FlowSource
from .sources import MeteringPump as MeteringPump
from .sources import PressureCompensatedPump as PressureCompensatedPump
from .sources import PressureSource as PressureSource
from .sources import Tank as Tank
from .valves import CheckValve as CheckValve
from .valves import DirectionalValve as DirectionalValve
from .valves import LoadControlValve as LoadControlValve
from .valves import PartialPressureValve as PartialPressureValve
from .valves import PilotOperatedCheckValve as PilotOperatedCheckValve
from .valves import PressureCompensator as PressureCompensator
from .valves import PressureReducingValve as PressureReducingValve
from .valves import ReliefValve as ReliefValve
from .valves import ShuttleValve as ShuttleValve
from .valves import TwoWayValve as TwoWayValve
