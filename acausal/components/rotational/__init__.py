"""One-dimensional rotational mechanics (Modelica Standard Library 4.0, `Modelica.Mechanics.Rotational`).

A flange has an angle `phi`, the same for all that is connected, and a torque `tau`, positive when it acts on the
component in the direction of increasing `phi`. Components with `useSupport` take their reaction to the flange
`support`; without it they stand on the fixed housing.
"""

# first, as it has the gears of this package under its own name, too
from .. import translational as translational
from .adaptors import AngleToTorqueAdaptor as AngleToTorqueAdaptor
from .adaptors import GeneralAngleToTorqueAdaptor as GeneralAngleToTorqueAdaptor
from .adaptors import GeneralTorqueToAngleAdaptor as GeneralTorqueToAngleAdaptor
from .adaptors import TorqueToAngleAdaptor as TorqueToAngleAdaptor
from .components import Damper as Damper
from .components import Disc as Disc
from .components import ElastoBacklash as ElastoBacklash
from .components import ElastoBacklash2 as ElastoBacklash2
from .components import Fixed as Fixed
from .components import Inertia as Inertia
from .components import InitializeFlange as InitializeFlange
from .components import PartialElastoBacklash as PartialElastoBacklash
from .components import RelativeStates as RelativeStates
from .components import Spring as Spring
from .components import SpringDamper as SpringDamper
from .friction import BearingFriction as BearingFriction
from .friction import Brake as Brake
from .friction import Clutch as Clutch
from .friction import OneWayClutch as OneWayClutch
from .friction import PartialFriction as PartialFriction
from .friction import PartialNormalForce as PartialNormalForce
from .gearbox import Gearbox as Gearbox
from .gears import IdealGear as IdealGear
from .gears import IdealGearR2T as IdealGearR2T
from .gears import IdealPlanetary as IdealPlanetary
from .gears import IdealRollingWheel as IdealRollingWheel
from .gears import PartialRotationalToTranslational as PartialRotationalToTranslational
from .interfaces import Flange as Flange
from .interfaces import PartialAbsoluteSensor as PartialAbsoluteSensor
from .interfaces import PartialCompliant as PartialCompliant
from .interfaces import PartialCompliantWithRelativeStates as PartialCompliantWithRelativeStates
from .interfaces import PartialCompliantWithVelocity as PartialCompliantWithVelocity
from .interfaces import PartialOneFlangeAndSupport as PartialOneFlangeAndSupport
from .interfaces import PartialRelativeSensor as PartialRelativeSensor
from .interfaces import PartialSupport as PartialSupport
from .interfaces import PartialTwoFlanges as PartialTwoFlanges
from .interfaces import PartialTwoFlangesAndSupport as PartialTwoFlangesAndSupport
from .lossy_gear import LossyGear as LossyGear
from .sensors import AccSensor as AccSensor
from .sensors import AngleSensor as AngleSensor
from .sensors import MultiSensor as MultiSensor
from .sensors import PowerSensor as PowerSensor
from .sensors import RelAccSensor as RelAccSensor
from .sensors import RelAngleSensor as RelAngleSensor
from .sensors import RelSpeedSensor as RelSpeedSensor
from .sensors import SpeedSensor as SpeedSensor
from .sensors import TorqueSensor as TorqueSensor
from .sources import Accelerate as Accelerate
from .sources import ConstantSpeed as ConstantSpeed
from .sources import ConstantTorque as ConstantTorque
from .sources import EddyCurrentTorque as EddyCurrentTorque
from .sources import InverseSpeedDependentTorque as InverseSpeedDependentTorque
from .sources import LinearSpeedDependentTorque as LinearSpeedDependentTorque
from .sources import Move as Move
from .sources import PartialSpeedDependent as PartialSpeedDependent
from .sources import Position as Position
from .sources import QuadraticSpeedDependentTorque as QuadraticSpeedDependentTorque
from .sources import SignTorque as SignTorque
from .sources import Speed as Speed
from .sources import Torque as Torque
from .sources import Torque2 as Torque2
from .sources import TorqueStep as TorqueStep
