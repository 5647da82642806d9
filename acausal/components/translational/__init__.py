"""One-dimensional translational mechanics (Modelica Standard Library 4.0, `Modelica.Mechanics.Translational`).

A flange has a position `s`, the same for all that is connected, and a force `f`, positive when it acts on the component
in the direction of increasing `s`. A force between two flanges is positive when it pulls them together (tension).
Components with `useSupport` take their reaction to the flange `support`; without it they stand on the fixed housing.
"""

from ..rotational.gears import IdealGearR2T as IdealGearR2T
from ..rotational.gears import IdealRollingWheel as IdealRollingWheel
from .adaptors import GeneralForceToPositionAdaptor as GeneralForceToPositionAdaptor
from .adaptors import GeneralPositionToForceAdaptor as GeneralPositionToForceAdaptor
from .components import Damper as Damper
from .components import ElastoGap as ElastoGap
from .components import EndStops as EndStops
from .components import Fixed as Fixed
from .components import InitializeFlange as InitializeFlange
from .components import Mass as Mass
from .components import PointMass as PointMass
from .components import RelativeStates as RelativeStates
from .components import Rod as Rod
from .components import Spring as Spring
from .components import SpringDamper as SpringDamper
from .components import ViscousFriction as ViscousFriction
from .friction import Brake as Brake
from .friction import MassWithStopAndFriction as MassWithStopAndFriction
from .friction import PartialFriction as PartialFriction
from .friction import PartialNormalForce as PartialNormalForce
from .friction import SupportFriction as SupportFriction
from .interfaces import Flange as Flange
from .interfaces import PartialAbsoluteSensor as PartialAbsoluteSensor
from .interfaces import PartialCompliant as PartialCompliant
from .interfaces import PartialCompliantWithRelativeStates as PartialCompliantWithRelativeStates
from .interfaces import PartialCompliantWithVelocity as PartialCompliantWithVelocity
from .interfaces import PartialOneFlangeAndSupport as PartialOneFlangeAndSupport
from .interfaces import PartialRelativeSensor as PartialRelativeSensor
from .interfaces import PartialRigid as PartialRigid
from .interfaces import PartialSupport as PartialSupport
from .interfaces import PartialTwoFlanges as PartialTwoFlanges
from .interfaces import PartialTwoFlangesAndSupport as PartialTwoFlangesAndSupport
from .sensors import AccSensor as AccSensor
from .sensors import ForceSensor as ForceSensor
from .sensors import MultiSensor as MultiSensor
from .sensors import PositionSensor as PositionSensor
from .sensors import PowerSensor as PowerSensor
from .sensors import RelAccSensor as RelAccSensor
from .sensors import RelPositionSensor as RelPositionSensor
from .sensors import RelSpeedSensor as RelSpeedSensor
from .sensors import SpeedSensor as SpeedSensor
from .sources import Accelerate as Accelerate
from .sources import ConstantForce as ConstantForce
from .sources import ConstantSpeed as ConstantSpeed
from .sources import EddyCurrentForce as EddyCurrentForce
from .sources import Force as Force
from .sources import Force2 as Force2
from .sources import ForceStep as ForceStep
from .sources import InverseSpeedDependentForce as InverseSpeedDependentForce
from .sources import LinearSpeedDependentForce as LinearSpeedDependentForce
from .sources import Move as Move
from .sources import PartialForce as PartialForce
from .sources import PartialSpeedDependent as PartialSpeedDependent
from .sources import Position as Position
from .sources import QuadraticSpeedDependentForce as QuadraticSpeedDependentForce
from .sources import SignForce as SignForce
from .sources import Speed as Speed
from .vehicle import RollingResistance as RollingResistance
from .vehicle import Vehicle as Vehicle
