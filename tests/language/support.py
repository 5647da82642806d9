"""Flat models as text and numbers."""

from __future__ import annotations

import numpy as np

import acausal as ac
from acausal.language.flat_model import FlatModel
from acausal.language.flatten import flatten
from acausal.lowering.parameters import ParameterProgram


def equations(model: ac.Component | FlatModel) -> list[str]:
    """Every equation of the flat model, those of connections included."""
    flat = model if isinstance(model, FlatModel) else flatten(model)
    lines = [flat.equation_text(f, k) for f in flat.families for k in range(f.size)]
    triples = zip(flat.alias_a, flat.alias_b, flat.alias_sign, strict=True)
    lines += [f"{flat.name(int(a))} = {'-' if s < 0 else ''}{flat.name(int(b))}" for a, b, s in triples]
    return lines + [f"{flat.name(int(z))} = 0" for z in flat.zero]


def parameters(model: ac.Component) -> dict[str, float]:
    """All parameters with their values, dependent ones included."""
    flat = flatten(model)
    return dict(zip(flat.names.all_parameters, ParameterProgram(flat).default[: flat.n_par].tolist(), strict=True))


def starts(model: ac.Component) -> dict[str, float]:
    """Start values that are given."""
    flat = flatten(model)
    program = ParameterProgram(flat)
    values = program.starts(program.default, np)[: flat.n_var]
    return {n: float(v) for n, v in zip(flat.names.all_variables, values, strict=True) if not np.isnan(v)}


def fixed(model: ac.Component) -> list[str]:
    """Variables whose start value is an equation."""
    flat = flatten(model)
    return [flat.name(int(i)) for i in np.flatnonzero(flat.fixed == 1)]


def fields(model: ac.Component) -> tuple[list[str], list[str]]:
    """Names of all variables and of all parameters."""
    flat = flatten(model)
    return flat.names.all_variables, flat.names.all_parameters
