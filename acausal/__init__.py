"""acausal: an acausal, equation-based modelling language in Python, compiled to JAX.

Components declare equations and connectors; `compile` turns a model into a `System` that simulates, differentiates and
calibrates. Importing this module does not import JAX.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from .errors import AcausalError as AcausalError
from .errors import ConnectError as ConnectError
from .errors import DeclarationError as DeclarationError
from .errors import InitializationError as InitializationError
from .errors import SimulationError as SimulationError
from .errors import StructureError as StructureError
from .errors import UnitError as UnitError
from .errors import UnknownNameError as UnknownNameError
from .language.blackbox import function as function
from .language.blackbox import table as table
from .language.component import Component as Component
from .language.component import Connector as Connector
from .language.component import Equations as Equations
from .language.connections import connect as connect
from .language.declarations import Discrete as Discrete
from .language.declarations import Flow as Flow
from .language.declarations import Input as Input
from .language.declarations import Output as Output
from .language.declarations import Parameter as Parameter
from .language.declarations import Potential as Potential
from .language.declarations import Variable as Variable
from .language.declarations import start as start
from .language.events import assert_ as assert_
from .language.events import change as change
from .language.events import edge as edge
from .language.events import initial as initial
from .language.events import noevent as noevent
from .language.events import pre as pre
from .language.events import reinit as reinit
from .language.events import sample as sample
from .language.events import smooth as smooth
from .language.events import terminal as terminal
from .language.events import terminate as terminate
from .language.events import when as when
from .language.fields import Array as Array
from .language.fields import conditional as conditional
from .language.fields import inner as inner
from .language.fields import outer as outer
from .language.fields import structural as structural
from .language.functions import PI as PI
from .language.functions import abs as abs
from .language.functions import acos as acos
from .language.functions import asin as asin
from .language.functions import asinh as asinh
from .language.functions import atan as atan
from .language.functions import atan2 as atan2
from .language.functions import ceil as ceil
from .language.functions import clip as clip
from .language.functions import cos as cos
from .language.functions import cosh as cosh
from .language.functions import der as der
from .language.functions import exp as exp
from .language.functions import floor as floor
from .language.functions import log as log
from .language.functions import log10 as log10
from .language.functions import max as max
from .language.functions import min as min
from .language.functions import mod as mod
from .language.functions import sign as sign
from .language.functions import sin as sin
from .language.functions import sinh as sinh
from .language.functions import sqrt as sqrt
from .language.functions import tan as tan
from .language.functions import tanh as tanh
from .language.functions import time as time
from .language.functions import where as where
from .language.modification import modify as modify
from .language.modification import redeclare as redeclare
from .language.overdetermined import Overdetermined as Overdetermined
from .language.overdetermined import branch as branch
from .language.overdetermined import choose as choose
from .language.overdetermined import defining as defining
from .language.overdetermined import derivative_rule as derivative_rule
from .language.overdetermined import is_root as is_root
from .language.overdetermined import potential_root as potential_root
from .language.overdetermined import root as root
from .language.overdetermined import rooted as rooted
from .language.vectors import Matrix as Matrix
from .language.vectors import Vector as Vector
from .language.vectors import cross as cross
from .language.vectors import dot as dot
from .language.vectors import matrix as matrix
from .language.vectors import norm as norm
from .language.vectors import vector as vector
from .symbolic.expr import Expr as Expr

if TYPE_CHECKING:
    from . import fmi as fmi
    from .analysis.calibrate import calibrate as calibrate
    from .analysis.ensemble import Ensemble as Ensemble
    from .analysis.experiments import Experiment as Experiment
    from .analysis.fit import Fit as Fit
    from .analysis.priors import Bounds as Bounds
    from .analysis.priors import CalibrationError as CalibrationError
    from .analysis.priors import LogBounds as LogBounds
    from .analysis.priors import LogNormal as LogNormal
    from .analysis.priors import Normal as Normal
    from .analysis.sampling import draw as draw
    from .analysis.sampling import grid as grid
    from .compiler import compile as compile
    from .simulation.jit import jit as jit
    from .simulation.rk4 import RK4 as RK4
    from .simulation.rodas5p import Rodas5P as Rodas5P
    from .simulation.solution import Solution as Solution
    from .system import Report as Report
    from .system import System as System

_LAZY = {
    "calibrate": "analysis.calibrate",
    "Ensemble": "analysis.ensemble",
    "Experiment": "analysis.experiments",
    "Fit": "analysis.fit",
    "Bounds": "analysis.priors",
    "CalibrationError": "analysis.priors",
    "LogBounds": "analysis.priors",
    "LogNormal": "analysis.priors",
    "Normal": "analysis.priors",
    "grid": "analysis.sampling",
    "draw": "analysis.sampling",
    "compile": "compiler",
    "System": "system",
    "Report": "system",
    "Solution": "simulation.solution",
    "Rodas5P": "simulation.rodas5p",
    "RK4": "simulation.rk4",
    "jit": "simulation.jit",
}


_PACKAGES = ("fmi",)


def __getattr__(name: str) -> Any:
    if name in _PACKAGES:
        return importlib.import_module(f".{name}", __name__)
    if name in _LAZY:
        value = getattr(importlib.import_module(f".{_LAZY[name]}", __name__), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_LAZY, *_PACKAGES})
