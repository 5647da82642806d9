"""Planar mechanics: frames, bodies, joints, forces and sensors, and the boom of a crane with its cylinder.

Names are those of the open library PlanarMechanics, of the forces between two frames those of MultiBody. A model
declares its world once, ``planarWorld: PlanarWorld = inner(PlanarWorld())``. Loops of bodies and joints are closed as
they are: the compiler finds what coordinates describe the motion.
"""

from .boom import Boom as Boom
from .boom import CompliantJoint as CompliantJoint
from .boom import CylinderJoint as CylinderJoint
from .boom import PartialBoom as PartialBoom
from .boom import PartialCylinderJoint as PartialCylinderJoint
from .boom import RigidJoint as RigidJoint
from .bushing import Bushing as Bushing
from .cut_sensors import CutForce as CutForce
from .cut_sensors import CutForceAndTorque as CutForceAndTorque
from .cut_sensors import CutTorque as CutTorque
from .cut_sensors import PartialCutSensor as PartialCutSensor
from .cut_sensors import PartialTransform as PartialTransform
from .cut_sensors import Power as Power
from .cut_sensors import TransformAbsoluteVector as TransformAbsoluteVector
from .cut_sensors import TransformRelativeVector as TransformRelativeVector
from .forces import Damper as Damper
from .forces import LineForce as LineForce
from .forces import Spring as Spring
from .forces import SpringDamper as SpringDamper
from .gears import PartialGearContact as PartialGearContact
from .gears import RigidNoLossExternal as RigidNoLossExternal
from .gears import RigidNoLossInternal as RigidNoLossInternal
from .interfaces import Frame as Frame
from .interfaces import PartialAbsoluteSensor as PartialAbsoluteSensor
from .interfaces import PartialCompliant as PartialCompliant
from .interfaces import PartialLineForce as PartialLineForce
from .interfaces import PartialMass as PartialMass
from .interfaces import PartialRelativeSensor as PartialRelativeSensor
from .interfaces import PartialResolved as PartialResolved
from .interfaces import PartialTwoFrames as PartialTwoFrames
from .interfaces import PlanarWorld as PlanarWorld
from .interfaces import between as between
from .interfaces import resolve1 as resolve1
from .interfaces import resolve2 as resolve2
from .interfaces import untouched as untouched
from .joints import PartialPrismatic as PartialPrismatic
from .joints import Prismatic as Prismatic
from .joints import PrismaticConstraint as PrismaticConstraint
from .joints import Revolute as Revolute
from .joints import RevoluteConstraint as RevoluteConstraint
from .parts import Body as Body
from .parts import Fixed as Fixed
from .parts import FixedRotation as FixedRotation
from .parts import FixedTranslation as FixedTranslation
from .parts import PointMass as PointMass
from .sensors import AbsoluteAcceleration as AbsoluteAcceleration
from .sensors import AbsolutePosition as AbsolutePosition
from .sensors import AbsoluteVelocity as AbsoluteVelocity
from .sensors import Distance as Distance
from .sensors import PartialRelativeMotion as PartialRelativeMotion
from .sensors import RelativeAcceleration as RelativeAcceleration
from .sensors import RelativePosition as RelativePosition
from .sensors import RelativeVelocity as RelativeVelocity
from .sources import QuadraticSpeedDependentForce as QuadraticSpeedDependentForce
from .sources import RelativeForce as RelativeForce
from .sources import WorldForce as WorldForce
from .to_multibody import PlanarToMultiBody as PlanarToMultiBody
from .vehicle import AirResistanceLongitudinal as AirResistanceLongitudinal
from .vehicle import DifferentialGear as DifferentialGear
from .wheels import DryFrictionBasedRolling as DryFrictionBasedRolling
from .wheels import DryFrictionWheelJoint as DryFrictionWheelJoint
from .wheels import IdealRolling as IdealRolling
from .wheels import IdealWheelJoint as IdealWheelJoint
from .wheels import PartialRolling as PartialRolling
from .wheels import PartialSlippingWheel as PartialSlippingWheel
from .wheels import PartialWheelJoint as PartialWheelJoint
from .wheels import SlipBasedWheelJoint as SlipBasedWheelJoint
from .wheels import slip_curve as slip_curve
