"""Planar mechanics: a boom that a cylinder lifts."""

from .boom import Boom as Boom
from .boom import CompliantJoint as CompliantJoint
from .boom import CylinderJoint as CylinderJoint
from .boom import PartialBoom as PartialBoom
from .boom import PartialCylinderJoint as PartialCylinderJoint
from .boom import RigidJoint as RigidJoint
