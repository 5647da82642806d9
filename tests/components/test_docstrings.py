"""The examples in the docstrings of all components run and give what they say."""

from __future__ import annotations

import doctest
from types import ModuleType
from typing import Any

import pytest

from acausal import Component, Connector
from acausal.components import (
    blocks,
    bondgraph,
    electrical,
    examples,
    hydraulic,
    multibody,
    planar,
    rotational,
    thermal,
    translational,
)

from .test_library import is_partial, named, public_classes

PACKAGES: dict[str, ModuleType] = {
    "blocks": blocks, "electrical": electrical, "rotational": rotational, "thermal": thermal,
    "translational": translational, "bondgraph": bondgraph, "planar": planar, "hydraulic": hydraulic,
    "multibody": multibody,
}  # fmt: skip


def package_of(cls: type[Component]) -> str:
    return cls.__module__.split(".")[2]


CLASSES = [
    cls for cls in public_classes()
    if package_of(cls) in PACKAGES and not issubclass(cls, Connector) and not is_partial(cls)
]  # fmt: skip


def namespace(package: str) -> dict[str, Any]:
    """Names that an example may use: the public names of all packages, its own package's first."""
    names: dict[str, Any] = {}
    for other in (*PACKAGES, package):
        names.update({k: v for k, v in vars(PACKAGES[other]).items() if not k.startswith("_")})
    names.update(PACKAGES)
    names.update({k: getattr(examples, k) for k in examples.__all__})
    return names


@pytest.mark.parametrize("cls", CLASSES, ids=named)
def test_example_of_the_docstring(cls: type[Component]) -> None:
    parsed = doctest.DocTestParser().get_doctest(
        cls.__doc__ or "", namespace(package_of(cls)), cls.__name__, cls.__module__, 0
    )
    assert parsed.examples, f"{named(cls)} has no example"
    report: list[str] = []
    result = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE).run(parsed, out=report.append)
    assert not result.failed, "".join(report)
