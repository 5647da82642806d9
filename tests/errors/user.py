"""Model files as a user writes them, and the error that each gives."""

from __future__ import annotations

import importlib.util
import itertools
import sys
from pathlib import Path
from textwrap import dedent
from types import ModuleType
from typing import Any

import pytest

import acausal as ac

PRELUDE = """\
from __future__ import annotations
import acausal as ac
from acausal import *
from acausal import Array, Component, Connector, Equations, Flow, Input, Output, Parameter, Potential, Variable
from acausal import connect, der, start


class Pin(Connector):
    v: Potential = Potential(unit="V")
    i: Flow = Flow(unit="A")


class TwoPin(Component, partial=True):
    p: Pin = Pin()
    n: Pin = Pin()
    v: Variable = Variable(unit="V")
    i: Variable = Variable(unit="A")

    def equations(self) -> Equations:
        yield self.v == self.p.v - self.n.v
        yield self.i == self.p.i
        yield self.p.i + self.n.i == 0


class Resistor(TwoPin):
    R: Parameter = Parameter(1.0, unit="ohm", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.R * self.i


class Capacitor(TwoPin):
    C: Parameter = Parameter(1e-3, unit="F", min=0.0)

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.C * der(self.v) == self.i


class Source(TwoPin):
    V: Parameter = Parameter(1.0, unit="V")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.v == self.V


class Ground(Component):
    p: Pin = Pin()

    def equations(self) -> Equations:
        yield self.p.v == 0


class RC(Component):
    source: TwoPin = Source()
    resistor: TwoPin = Resistor()
    capacitor: Capacitor = Capacitor(v=start(0.0, fixed=True))
    ground: Ground = Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.resistor.p)
        yield connect(self.resistor.n, self.capacitor.p)
        yield connect(self.capacitor.n, self.source.n, self.ground.p)


"""
"""What every model file of these tests begins with."""

HERE = "# HERE"
"""Marks the line of a model file that a message must name."""

_numbers = itertools.count()


class ModelFile:
    """A module written to disk and run; `places` are the marked lines."""

    def __init__(self, folder: Path, text: str) -> None:
        self.name = f"bad_model_{next(_numbers)}"
        self.path = folder / f"{self.name}.py"
        self.text = PRELUDE + dedent(text).lstrip("\n")
        self.path.write_text(self.text, encoding="utf-8")
        lines = self.text.splitlines()
        self.places = [f"{self.path}:{k}" for k, line in enumerate(lines, start=1) if HERE in line]

    def run(self) -> ModuleType:
        """Import it."""
        spec = importlib.util.spec_from_file_location(self.name, self.path)
        assert spec is not None
        assert spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules[self.name] = module
        spec.loader.exec_module(module)
        return module


def error_of(folder: Path, text: str, kind: type[Exception], words: list[str]) -> Any:
    """Run a model file that raises `kind`; the message has all `words` and names every marked line."""
    file = ModelFile(folder, text)
    with pytest.raises(kind) as caught:
        file.run()
    message = str(caught.value)
    for word in (*words, *file.places):
        assert word in message, f"`{word}` is not in:\n{message}"
    if kind is not TypeError:
        assert isinstance(caught.value, ac.AcausalError)
    return caught.value
