"""Functional Mock-up Interface: export, import, co-simulation, splitting a model, system descriptions (SSP).

Imported lazily as `acausal.fmi`; loading FMUs needs the extra ``acausal[fmi]``.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .cosimulation import CoSimulation as CoSimulation
    from .coupling import PowerBond as PowerBond
    from .exporter.export import export as export
    from .exporter.variables import ExportError as ExportError
    from .fmu import Fmu as Fmu
    from .fmu import FmuError as FmuError
    from .fmu import load as load
    from .mujoco_participant import MujocoParticipant as MujocoParticipant
    from .participant import CoSimulationError as CoSimulationError
    from .participant import Participant as Participant
    from .result import CoSimulationResult as CoSimulationResult
    from .splitting import Split as Split
    from .splitting import split as split
    from .ssp import read_ssp as read_ssp
    from .ssp import write_ssp as write_ssp
    from .system_participant import SystemParticipant as SystemParticipant

_LAZY = {
    "CoSimulation": "cosimulation",
    "CoSimulationError": "participant",
    "CoSimulationResult": "result",
    "ExportError": "exporter.variables",
    "Fmu": "fmu",
    "FmuError": "fmu",
    "MujocoParticipant": "mujoco_participant",
    "Participant": "participant",
    "PowerBond": "coupling",
    "Split": "splitting",
    "SystemParticipant": "system_participant",
    "export": "exporter.export",
    "load": "fmu",
    "read_ssp": "ssp",
    "split": "splitting",
    "write_ssp": "ssp",
}


def __getattr__(name: str) -> Any:
    if name in _LAZY:
        value = getattr(importlib.import_module(f".{_LAZY[name]}", __name__), name)
        globals()[name] = value
        return value
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted({*globals(), *_LAZY})
