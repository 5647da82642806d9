"""Three-dimensional mechanics, named as in Modelica.Mechanics.MultiBody 4.0."""

from .bodies import Body as Body
from .frames import Frame as Frame
from .frames import Orientation as Orientation
from .joints import Revolute as Revolute
from .parts import FixedTranslation as FixedTranslation
from .parts import PartialTwoFrames as PartialTwoFrames
from .world import Fixed as Fixed
from .world import World as World
