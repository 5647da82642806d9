"""Functional mock-up units made elsewhere: loading them, and using them in a co-simulation or in a model."""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
import zipfile
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any
from xml.etree import ElementTree

from ..errors import AcausalError, UnknownNameError, nearest

if TYPE_CHECKING:
    from ..language.component import Component, Connector
    from .fmu_participant import FmuParticipant

REAL = ("Real", "Float64")


class FmuError(AcausalError):
    """An FMU that cannot be loaded or that reports an error."""


def fmpy() -> Any:
    """The package FMPy.

    Raises:
        FmuError: it is not installed.
    """
    try:
        import fmpy as package
    except ImportError as missing:
        raise FmuError("loading FMUs needs the package FMPy: `pip install acausal[fmi]`") from missing
    return package


def load(path: str | os.PathLike[str]) -> Fmu:
    """Load a functional mock-up unit, FMI 2.0 or 3.0.

    Args:
        path: the file, ``model.fmu``.

    Raises:
        FmuError: no such file, not an FMU, a version of FMI other than 2.0 and 3.0, or scheduled execution only.
    """
    file = Path(path)
    if not file.is_file():
        raise FmuError(f"there is no file {file}")
    package = fmpy()
    try:
        description = package.read_model_description(str(file))
    except Exception as error:  # FMPy raises what the XML parser and the archive raise
        raise FmuError(f"{file.name} is not a functional mock-up unit: {error}") from error
    if not str(description.fmiVersion).startswith(("2.", "3.")):
        raise FmuError(f"{file.name} is FMI {description.fmiVersion}; versions 2.0 and 3.0 can be loaded")
    if description.coSimulation is None and description.modelExchange is None:
        raise FmuError(f"{file.name} offers scheduled execution only; co-simulation and model exchange can be loaded")
    return Fmu(file, description)


class Fmu:
    """A loaded functional mock-up unit; its archive is unpacked on first use and removed with the object.

    Attributes:
        path: the file.
        description: its model description, as FMPy reads it.
    """

    def __init__(self, path: Path, description: Any) -> None:
        self.path, self.description = path, description
        self.variables = {v.name: v for v in description.modelVariables}

    @property
    def name(self) -> str:
        """Name of the model in it."""
        return str(self.description.modelName)

    @property
    def version(self) -> str:
        """``2.0`` or ``3.0``."""
        return str(self.description.fmiVersion)[:3]

    @property
    def kinds(self) -> tuple[str, ...]:
        """What it offers: ``cs``, ``me``, or both."""
        d = self.description
        return tuple(k for k, has in (("cs", d.coSimulation), ("me", d.modelExchange)) if has is not None)

    @cached_property
    def directional(self) -> bool:
        """Whether model exchange has directional derivatives; FMPy does not read that attribute of FMI 3.0."""
        with zipfile.ZipFile(self.path) as archive:
            root = ElementTree.fromstring(archive.read("modelDescription.xml"))
        name = "providesDirectionalDerivative" + ("" if self.version == "2.0" else "s")
        interface = root.find("ModelExchange")
        return interface is not None and interface.get(name) in ("true", "1")

    @cached_property
    def folder(self) -> str:
        """Where it is unpacked."""
        place = tempfile.mkdtemp(prefix="acausal-fmu-")
        self._finalizer = weakref.finalize(self, shutil.rmtree, place, True)
        return str(fmpy().extract(str(self.path), unzipdir=place))

    def names(self, causality: str) -> tuple[str, ...]:
        """Real scalar variables of one causality: ``input``, ``output``, ``parameter``, ``local``."""
        return tuple(
            v.name for v in self.description.modelVariables
            if v.causality == causality and v.type in REAL and not v.dimensions
        )  # fmt: skip

    def number(self, name: str) -> Any:
        """Entry of a variable that is a real number.

        Raises:
            UnknownNameError: no such variable.
            FmuError: it is an array, or of another type.
        """
        variable = self.variable(name)
        if variable.dimensions or variable.type not in REAL:
            what = "an array" if variable.dimensions else f"of type {variable.type}"
            raise FmuError(f"{self.path.name}: `{name}` is {what}; signals are real numbers")
        return variable

    def variable(self, name: str) -> Any:
        """Entry of the model description.

        Raises:
            UnknownNameError: no such variable.
        """
        if name not in self.variables:
            raise UnknownNameError(f"{self.path.name} has no variable `{name}`.{nearest(name, self.variables)}")
        return self.variables[name]

    def instantiate(self, kind: str) -> Any:
        """A new FMPy instance, ``cs`` or ``me``, instantiated.

        Raises:
            FmuError: it does not offer that kind, or has no binary for this platform.
        """
        if kind not in self.kinds:
            wanted = {"cs": "co-simulation", "me": "model exchange"}[kind]
            raise FmuError(f"{self.path.name} does not offer {wanted} (it has: {', '.join(self.kinds)})")
        supported = fmpy().supported_platforms(str(self.path))
        if fmpy().platform not in supported and fmpy().platform_tuple not in supported:
            made = ", ".join(p for p in supported if p != "c-code") or "no platform"
            advice = "; it has C sources: `fmpy compile` makes a binary of them" if "c-code" in supported else ""
            raise FmuError(f"{self.path.name} has binaries for {made}, not for {fmpy().platform}{advice}")
        from fmpy.simulation import instantiate_fmu

        full = {"cs": "CoSimulation", "me": "ModelExchange"}[kind]
        try:
            return instantiate_fmu(self.folder, self.description, full, early_return_allowed=False)
        except Exception as error:  # FMPy raises plain exceptions
            raise FmuError(f"{self.path.name} could not be instantiated: {error}") from error

    def participant(
        self,
        *,
        outputs: Sequence[str] = (),
        parameters: Mapping[str, float] | None = None,
        needs: Mapping[str, int] | None = None,
        name: str | None = None,
    ) -> FmuParticipant:
        """As a participant of a co-simulation.

        Args:
            outputs: names of further variables to give out.
            parameters: values by name.
            needs: by quantity with Taylor coefficients, how many derivatives of it the model uses.
            name: shown in messages.
        """
        from .fmu_participant import FmuParticipant

        return FmuParticipant(self, outputs=outputs, parameters=parameters, needs=needs, name=name)

    def component(
        self,
        *,
        parameters: Mapping[str, float] | None = None,
        connectors: Mapping[str, tuple[type[Connector], Mapping[str, str]]] | None = None,
    ) -> Component:
        """As a component of a model: its inputs and outputs are signals, its states are states of the system.

        Discrete inputs, which may change at events only, keep their start value, or what `parameters` gives.

        Args:
            parameters: values by name.
            connectors: by name of a connector that the component gets, its class, and by variable of the connector the
                input or output of the unit that it equals, with a minus sign before the name where it is its negative:
                ``{"flange": (tr.Flange, {"s": "position", "f": "-force"})}``.

        Raises:
            FmuError: it does not offer model exchange, has state events or arrays, or its variables do not fit the
                connectors.
        """
        from .fmu_component import fmu_component

        return fmu_component(self, parameters or {}, connectors or {})

    def __repr__(self) -> str:
        return f"<Fmu {self.path.name}: {self.name}, FMI {self.version}, {' and '.join(self.kinds)}>"


def start_of(variable: Any) -> float:
    """Start value of a real variable of a model description, 0 where it has none."""
    return 0.0 if variable.start is None else float(variable.start)


def set_parameters(instance: Any, fmu: Fmu, values: Mapping[str, float]) -> None:
    """Set parameters of an FMPy instance of either version, whatever their type.

    Raises:
        UnknownNameError: no such variable.
        FmuError: an array, or a string.
    """
    for name, value in values.items():
        variable = fmu.variable(name)
        kind = str(variable.type)
        if variable.dimensions or kind in ("String", "Binary", "Clock"):
            what = "an array" if variable.dimensions else f"of type {kind}"
            raise FmuError(f"{fmu.path.name}: `{name}` is {what}; only numbers can be set")
        if kind in REAL:
            set_reals(instance, [variable.valueReference], [float(value)])
            continue
        whole = {"Enumeration": "Integer" if fmu.version == "2.0" else "Int64"}.get(kind, kind)
        given = bool(value) if kind == "Boolean" else int(value)
        getattr(instance, f"set{whole}")([variable.valueReference], [given])


def set_reals(instance: Any, references: Sequence[int], values: Sequence[float]) -> None:
    """Set real variables of an FMPy instance of either version."""
    if references:
        (instance.setFloat64 if hasattr(instance, "setFloat64") else instance.setReal)(references, values)


def get_reals(instance: Any, references: Sequence[int]) -> list[float]:
    """Real variables of an FMPy instance of either version."""
    if not references:
        return []
    return list((instance.getFloat64 if hasattr(instance, "getFloat64") else instance.getReal)(references))
