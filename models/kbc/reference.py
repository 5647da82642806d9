"""The four variants of the reference crane, their signals and their parameters by the symbols of the parameter
table."""

from __future__ import annotations

from typing import Final, Literal

from acausal import Component, modify, redeclare
from acausal.components import bondgraph as bg
from acausal.components import hydraulic as hyd
from acausal.components import planar

from . import bondgraph as bonds
from .crane import Crane
from .scenarios import scenario_source
from .supply import ExtendedSupply

SIGNALS: Final[dict[str, str]] = {
    "Pp": "supply.pipe.p_a",
    "Q": "supply.pipe.q",
    "P1": "supply.pipe.p_b",
    "P2": "supply.volume_2.p",
    "P3": "supply.volume_3.p",
    "Pa": "cylinder.p_a",
    "Pb": "cylinder.p_b",
    "x": "cylinder.x",
    "v": "cylinder.v",
    "theta": "boom.phi",
    "omega": "boom.w",
    "ei": "controller.integral",
}
"""Columns of the reference curves -> dotted names, where the variant has them."""

_SHARED: Final[dict[str, str]] = {
    "rho": "oil.rho",
    "nu": "oil.nu",
    "B": "oil.B",
    "p_tank": "p_tank",
    "V_disp": "supply.V_disp",
    "omega_pump": "supply.omega",
    "bore": "cylinder.bore",
    "rod": "cylinder.rod",
    "m": "m",
    "r": "r",
    "I": "boom.I",
    "a": "a",
    "b": "b",
    "alpha": "alpha",
    "beta": "beta",
    "L0": "L0",
    "g": "g",
    "Kp": "controller.Kp",
    "Ki": "controller.Ki",
}

_EXTENDED: Final[dict[str, str]] = {
    "p_set": "supply.p_set",
    "dp_pump": "supply.pump.dp_full",
    "l": "supply.pipe.l",
    "d": "supply.pipe.d",
    "eps": "supply.pipe.eps",
    "V2": "supply.volume_2.V",
    "V3": "supply.volume_3.V",
    "Cd": "supply.Cd",
    "p_tr": "supply.p_tr",
    "A_leak": "supply.A_leak",
    "A_pcv": "supply.pcv.A_full",
    "p_comp": "supply.pcv.p_comp",
    "dp_pcv": "supply.pcv.dp_close",
    "A_dcv": "supply.dcv.A_full",
    "r_b": "supply.dcv.r_b",
    "r_at": "supply.dcv.r_at",
    "A_cbv": "supply.cbv.A_full",
    "o_low": "supply.cbv.o_low",
    "u_cb": "supply.cbv.u_change",
    "s": "cylinder.stroke",
    "Va0": "cylinder.Va0",
    "Vb0": "cylinder.Vb0",
    "m_p": "cylinder.m",
    "c_p": "cylinder.c",
    "k_b": "cylinder.k_bumper",
    "c_b": "cylinder.c_bumper",
}

_COMPLIANT: Final[dict[str, str]] = {"k_c": "joint.k", "c_c": "joint.c"}

PARAMETERS: Final[dict[str, str]] = {**_SHARED, **_EXTENDED, **_COMPLIANT}
"""Symbols of the parameter table -> the dotted name that `simulate(parameters=...)` takes, where the variant has it."""

_PARTS: Final[dict[str, dict[str, dict[str, Component]]]] = {
    "components": {
        "simplified": {},
        "extended": {"supply": ExtendedSupply(), "cylinder": hyd.ExtendedCylinder()},
        "compliant": {},
        "rigid": {"joint": planar.RigidJoint()},
    },
    "bonds": {
        "simplified": {"supply": bonds.SimplifiedSupply(), "cylinder": bg.SimplifiedCylinder()},
        "extended": {"supply": bonds.ExtendedSupply(), "cylinder": bg.ExtendedCylinder()},
        "compliant": {"joint": bonds.CompliantJoint(), "boom": bonds.Boom()},
        "rigid": {"joint": bonds.RigidJoint(), "boom": bonds.Boom()},
    },
}
"""What takes the place of the parts of the simplified, compliant `Crane`, for each form and choice."""


def reference_crane(
    hydraulics: Literal["extended", "simplified"] = "extended",
    joint: Literal["compliant", "rigid"] = "compliant",
    scenario: Literal["sine", "step", "endstop"] = "sine",
    form: Literal["components", "bonds"] = "components",
    **symbols: float,
) -> Crane:
    """One variant of the reference crane; *extended* and *rigid* are redeclarations of the simplified, compliant
    `Crane`.

    Args:
        hydraulics: ``extended`` (pump, pipe, valves, compressible oil) or ``simplified`` (ideal flow).
        joint: ``compliant`` (spring and damper) or ``rigid`` (constraint, index 3) between rod and boom.
        scenario: reference motion of the piston, see `scenario_source`.
        form: parts from the libraries of the domains, or of bonds.
        **symbols: values of the parameter table in SI units; those of parts that the variant lacks have no effect.

    Raises:
        ValueError: an unknown variant.
        TypeError: a symbol that the parameter table does not have.
    """
    unknown = [symbol for symbol in symbols if symbol not in PARAMETERS]
    if unknown:
        raise TypeError(f"reference_crane has no parameter {', '.join(unknown)}; it has {', '.join(PARAMETERS)}")
    if form not in _PARTS:
        raise ValueError(f"form={form!r} is neither 'components' nor 'bonds'")
    for name, choice in (("hydraulics", hydraulics), ("joint", joint)):
        if choice not in _PARTS[form]:
            known = ("extended", "simplified") if name == "hydraulics" else ("rigid", "compliant")
            raise ValueError(f"{name}={choice!r} is neither {known[0]!r} nor {known[1]!r}")
    parts = {"reference": scenario_source(scenario), **_PARTS[form][hydraulics], **_PARTS[form][joint]}
    table = _SHARED | (_EXTENDED if hydraulics == "extended" else {}) | (_COMPLIANT if joint == "compliant" else {})
    crane = redeclare(Crane(), parts)
    return modify(crane, {table[symbol]: float(value) for symbol, value in symbols.items() if symbol in table})
