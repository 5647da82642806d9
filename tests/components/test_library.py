"""Every public component: documented with its source, made without arguments; the examples simulate."""

from __future__ import annotations

import inspect

import numpy as np
import pytest

import acausal as ac
from acausal import Component
from acausal.components import (
    blocks,
    bondgraph,
    electrical,
    hydraulic,
    multibody,
    planar,
    rotational,
    thermal,
    translational,
)

from .examples import EXAMPLES, simulated

MODULES = (blocks, blocks.discrete, blocks.math_boolean, blocks.math_integer, bondgraph, electrical, hydraulic,
           multibody, multibody.constraints, planar, rotational, thermal, thermal.celsius,
           translational)  # fmt: skip


def public_classes() -> list[type[Component]]:
    """The component and connector classes that the library's modules define for users."""
    found: dict[type[Component], None] = {}  # once each: an older name of one is in its package beside it
    for module in MODULES:
        for name, value in vars(module).items():
            own = inspect.isclass(value) and value.__module__.startswith(module.__name__)
            if own and issubclass(value, Component) and not name.startswith("_"):
                found[value] = None
    return list(found)


CLASSES = public_classes()


def named(cls: type[Component]) -> str:
    return f"{cls.__module__.removeprefix('acausal.components.')}.{cls.__name__}"


def is_partial(cls: type[Component]) -> bool:
    """Whether the class cannot stand in a model on its own: a subclass or the block it is part of completes it."""
    return cls._partial or cls in {blocks.SignalIn, blocks.SignalOut, electrical.Winding}


def test_the_library_is_not_empty() -> None:
    assert len(CLASSES) > 100
    assert {named(c) for c in CLASSES} >= {"electrical.basic.Resistor", "hydraulic.pipes.Pipe"}


@pytest.mark.parametrize("cls", CLASSES, ids=named)
def test_documented_with_source(cls: type[Component]) -> None:
    text = cls.__doc__ or ""
    assert "Source:" in text, f"{named(cls)} names no source"
    assert len(text.split("Source:")[0].split()) >= 3


@pytest.mark.parametrize("cls", CLASSES, ids=named)
def test_fields_have_units_or_texts(cls: type[Component]) -> None:
    for base in cls.__mro__:
        for name, value in vars(base).items():
            if isinstance(value, (ac.Parameter, ac.Variable)):
                assert value.doc, f"{named(cls)}.{name} has no doc"


@pytest.mark.parametrize("cls", CLASSES, ids=named)
def test_made_without_arguments(cls: type[Component]) -> None:
    assert isinstance(cls(), cls)


@pytest.mark.parametrize("name", EXAMPLES)
def test_example_simulates(name: str) -> None:
    solution = simulated(name)
    system = ac.compile(EXAMPLES[name])
    for variable in (*system.states, *system.observed):
        assert np.all(np.isfinite(solution[variable])), f"{name}: {variable}"
