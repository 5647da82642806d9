"""The examples in the docstrings of the public components: each is run once, and the simulations in it are noted."""

from __future__ import annotations

import doctest
from dataclasses import dataclass
from functools import cache
from types import ModuleType
from typing import Any
from unittest import mock

from acausal import Component, Connector, System
from acausal.components import examples

from .test_library import MODULES, is_partial, public_classes

PACKAGES: dict[str, ModuleType] = {m.__name__.split(".")[2]: m for m in MODULES if m.__name__.count(".") == 2}


def package_of(cls: type[Component]) -> str:
    return cls.__module__.split(".")[2]


CLASSES = [
    cls for cls in public_classes()
    if package_of(cls) in PACKAGES and not issubclass(cls, Connector) and not is_partial(cls)
]  # fmt: skip


@dataclass(frozen=True)
class Run:
    """A simulation in an example.

    Attributes:
        system: what was simulated.
        t1: end time [s].
        options: further arguments of `simulate`.
    """

    system: System
    t1: float
    options: dict[str, Any]


@dataclass(frozen=True)
class Example:
    """What came of an example.

    Attributes:
        statements: how many there are.
        failure: report of what differs from the docstring; empty if nothing does.
        runs: in order.
    """

    statements: int
    failure: str
    runs: tuple[Run, ...]


@cache
def example_of(cls: type[Component]) -> Example:
    """Run the example of a class."""
    parsed = doctest.DocTestParser().get_doctest(
        cls.__doc__ or "", _namespace(package_of(cls)), cls.__name__, cls.__module__, 0
    )
    report: list[str] = []
    runs: list[Run] = []
    simulate = System.simulate

    def noted(system: System, t1: float, **options: Any) -> Any:
        runs.append(Run(system, t1, options))
        return simulate(system, t1, **options)

    runner = doctest.DocTestRunner(optionflags=doctest.NORMALIZE_WHITESPACE)
    with mock.patch.object(System, "simulate", noted):
        result = runner.run(parsed, out=report.append, clear_globs=False)  # its classes are flattened again later
    return Example(len(parsed.examples), "".join(report) if result.failed else "", tuple(runs))


def _namespace(package: str) -> dict[str, Any]:
    """Names that an example may use: the public names of all packages, its own package's first."""
    names: dict[str, Any] = {}
    for other in (*PACKAGES, package):
        names.update({k: v for k, v in vars(PACKAGES[other]).items() if not k.startswith("_")})
    names.update(PACKAGES)
    names.update({k: getattr(examples, k) for k in examples.__all__})
    return names
