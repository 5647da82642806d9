"""Knuckle boom crane of the paper: one `Crane`, whose parts are replaced for the variants.

``reference_crane(hydraulics=..., joint=..., scenario=...)`` makes one of the four, with ``form="bonds"`` as a bond
graph; `SIGNALS` and `PARAMETERS` map the symbols of the parameter table to dotted names.
"""

from .crane import Crane as Crane
from .reference import PARAMETERS as PARAMETERS
from .reference import SIGNALS as SIGNALS
from .reference import reference_crane as reference_crane
from .scenarios import TwoSteps as TwoSteps
from .scenarios import scenario_source as scenario_source
from .supply import ExtendedSupply as ExtendedSupply
from .supply import PartialSupply as PartialSupply
from .supply import SimplifiedSupply as SimplifiedSupply
