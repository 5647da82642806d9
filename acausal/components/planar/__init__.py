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
from .forces import Damper as Damper
from .forces import LineForce as LineForce
from .forces import Spring as Spring
from .forces import SpringDamper as SpringDamper
from .forces import WorldForce as WorldForce
from .interfaces import Frame as Frame
from .interfaces import PartialAbsoluteSensor as PartialAbsoluteSensor
from .interfaces import PartialCompliant as PartialCompliant
from .interfaces import PartialLineForce as PartialLineForce
from .interfaces import PartialMass as PartialMass
from .interfaces import PartialRelativeSensor as PartialRelativeSensor
from .interfaces import PartialTwoFrames as PartialTwoFrames
from .interfaces import PlanarWorld as PlanarWorld
from .interfaces import between as between
from .interfaces import resolve1 as resolve1
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
from .sensors import AbsolutePosition as AbsolutePosition
from .sensors import AbsoluteVelocity as AbsoluteVelocity
from .sensors import CutForceAndTorque as CutForceAndTorque
from .sensors import Distance as Distance
from .sensors import RelativePosition as RelativePosition
from .wheels import IdealRolling as IdealRolling
from .wheels import IdealWheelJoint as IdealWheelJoint
