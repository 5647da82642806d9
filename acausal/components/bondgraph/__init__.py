"""Bond graphs: sources, storages, resistors, transformers, gyrators, junctions and bonds.

The flow of a port is positive into the component. Half arrows give the direction in which power counts as positive:
into `I`, `C` and `R`, out of sources, from `port_a` to `port_b` of two-ports, into ``inp[i]`` and out of ``out[j]`` of
junctions. Connect two ports for a bond; a `Bond` between them shows its power. No causality is assigned: the
compiler finds it.
"""

from .adapters import ElectricalBond as ElectricalBond
from .adapters import HydraulicBond as HydraulicBond
from .adapters import RotationalBond as RotationalBond
from .adapters import TranslationalBond as TranslationalBond
from .cylinders import Bumpers as Bumpers
from .cylinders import ExtendedCylinder as ExtendedCylinder
from .cylinders import PartialBondGraphCylinder as PartialBondGraphCylinder
from .cylinders import SimplifiedCylinder as SimplifiedCylinder
from .elements import GY as GY
from .elements import J0 as J0
from .elements import J1 as J1
from .elements import MC as MC
from .elements import MGY as MGY
from .elements import MI as MI
from .elements import MR as MR
from .elements import MTF as MTF
from .elements import TF as TF
from .elements import Bond as Bond
from .elements import BondPort as BondPort
from .elements import C as C
from .elements import I as I
from .elements import Junction0 as Junction0
from .elements import Junction1 as Junction1
from .elements import MSe as MSe
from .elements import MSf as MSf
from .elements import OnePort as OnePort
from .elements import PartialJunction as PartialJunction
from .elements import PartialSource as PartialSource
from .elements import R as R
from .elements import Se as Se
from .elements import Sf as Sf
from .elements import TwoPort as TwoPort
from .hydraulics import OrificeR as OrificeR
from .hydraulics import PipeFrictionR as PipeFrictionR
