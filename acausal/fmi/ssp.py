"""System Structure and Parameterization 1.0: a co-simulation of FMUs as an ``.ssp`` archive, written and read.

Source: Modelica Association, System Structure and Parameterization 1.0 (2019), chapters 2 (archive), 5 (description)
and 6 (parameter values).
"""

from __future__ import annotations

import os
import shutil
import tempfile
import weakref
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any
from xml.etree import ElementTree

from .cosimulation import CoSimulation
from .coupling import PowerBond
from .fmu import load
from .fmu_participant import FmuParticipant
from .participant import CoSimulationError

_BASE = "http://ssp-standard.org/SSP1/SystemStructure"
_SPACES = {"ssd": f"{_BASE}Description", "ssc": f"{_BASE}Common", "ssv": f"{_BASE}ParameterValues"}
_DOCUMENT = "SystemStructure.ssd"
_OWN = "acausal"
"""Type of the annotations with what the standard has no element for: options of the master, power bonds."""
_OPTIONS = ("method", "order", "step", "iterations", "tolerance", "control", "min_step", "max_step")


def _tag(name: str) -> str:
    space, _, local = name.partition(":")
    return f"{{{_SPACES[space]}}}{local}"


def write_ssp(master: CoSimulation, path: str | os.PathLike[str], *, name: str = "system", t1: float = 1.0) -> Path:
    """Write a co-simulation of FMUs as a system structure package, the FMUs in it.

    Args:
        master: its participants are loaded FMUs.
        path: file to write, ``crane.ssp``.
        name: of the system.
        t1: end of the default experiment [s].

    Returns:
        the path.

    Raises:
        CoSimulationError: a participant that is no FMU, or inputs from outside, which a package cannot hold.
    """
    foreign = [n for n, p in master.participants.items() if not isinstance(p, FmuParticipant)]
    if foreign:
        raise CoSimulationError(
            f"a system structure package holds FMUs; {', '.join(f'`{n}`' for n in foreign)} is none. Export it first: "
            "`ac.fmi.export`, or `fmus` of a split"
        )
    if master.inputs:
        raise CoSimulationError("a system structure package cannot hold the signals of `inputs=`; give them on reading")
    for prefix, space in _SPACES.items():
        ElementTree.register_namespace(prefix, space)
    root = _document(master, name, t1)
    ElementTree.indent(root)
    place = Path(path)
    place.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(place, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr(_DOCUMENT, ElementTree.tostring(root, encoding="UTF-8", xml_declaration=True))
        for n, part in _units(master):
            archive.write(part.fmu.path, f"resources/{n}.fmu")
    return place


def _units(master: CoSimulation) -> Iterator[tuple[str, FmuParticipant]]:
    for n, part in master.participants.items():
        assert isinstance(part, FmuParticipant)
        yield n, part


def _document(master: CoSimulation, name: str, t1: float) -> ElementTree.Element:
    top = ElementTree.Element(
        _tag("ssd:SystemStructureDescription"), version="1.0", name=name, generationTool="acausal"
    )
    system = ElementTree.SubElement(top, _tag("ssd:System"), name=name)
    elements = ElementTree.SubElement(system, _tag("ssd:Elements"))
    for n, part in _units(master):
        _component(elements, n, part)
    if master.couplings:
        connections = ElementTree.SubElement(system, _tag("ssd:Connections"))
        for c in master.couplings:
            source, target = master.parts[c.source], master.parts[c.target]
            ElementTree.SubElement(
                connections, _tag("ssd:Connection"), startElement=master.names[c.source],
                startConnector=source.outputs[c.output], endElement=master.names[c.target],
                endConnector=target.inputs[c.input],
            )  # fmt: skip
    options = {k: str(v) for k in _OPTIONS if (v := getattr(master, k)) is not None}
    made = _annotation(system, ElementTree.Element("Master", options))
    for bond in master.bonds:
        b = bond.bond
        ElementTree.SubElement(
            made, "Bond", name=b.name, potential=b.potential, flow=b.flow, derivative=str(b.derivative).lower()
        )
    ElementTree.SubElement(top, _tag("ssd:DefaultExperiment"), startTime="0.0", stopTime=repr(float(t1)))
    return top


def _component(elements: ElementTree.Element, name: str, part: FmuParticipant) -> None:
    component = ElementTree.SubElement(
        elements, _tag("ssd:Component"), name=name, type="application/x-fmu-sharedlibrary",
        source=f"resources/{name}.fmu", implementation="CoSimulation",
    )  # fmt: skip
    ends = [(n, _kind(part, n)) for n in (*part.inputs, *part.outputs)]
    if ends:
        connectors = ElementTree.SubElement(component, _tag("ssd:Connectors"))
        for n, kind in ends:
            entry = ElementTree.SubElement(connectors, _tag("ssd:Connector"), name=n, kind=kind)
            unit = part.unit(n)
            ElementTree.SubElement(entry, _tag("ssc:Real"), {"unit": unit} if unit else {})
    if part.parameters:
        bindings = ElementTree.SubElement(component, _tag("ssd:ParameterBindings"))
        values = ElementTree.SubElement(
            ElementTree.SubElement(bindings, _tag("ssd:ParameterBinding")), _tag("ssd:ParameterValues")
        )
        held = ElementTree.SubElement(values, _tag("ssv:ParameterSet"), version="1.0", name=name)
        listed = ElementTree.SubElement(held, _tag("ssv:Parameters"))
        for n, value in part.parameters.items():
            entry = ElementTree.SubElement(listed, _tag("ssv:Parameter"), name=n)
            ElementTree.SubElement(entry, _tag("ssv:Real"), value=repr(float(value)))
    needs = {n: k for n, k in part.needs.items() if k}
    if needs:
        made = _annotation(component, ElementTree.Element("Participant"))
        for n, k in needs.items():
            ElementTree.SubElement(made, "Needs", name=n, derivatives=str(k))


def _kind(part: FmuParticipant, name: str) -> str:
    """Kind of a connector: a quantity with Taylor coefficients is a parameter of the unit."""
    causality = str(part.fmu.variable(name).causality)
    return causality if causality in ("input", "parameter") else "output"


def _annotation(parent: ElementTree.Element, content: ElementTree.Element) -> ElementTree.Element:
    held = ElementTree.SubElement(
        ElementTree.SubElement(parent, _tag("ssd:Annotations")), _tag("ssc:Annotation"), type=_OWN
    )
    held.append(content)
    return content


def read_ssp(path: str | os.PathLike[str], **options: Any) -> CoSimulation:
    """Read a system structure package as a co-simulation; its FMUs are unpacked as long as the object lives.

    Args:
        path: the file, ``crane.ssp``.
        **options: of `CoSimulation`, in the place of those in the package: `step`, `method`, `inputs`, ...

    Raises:
        CoSimulationError: no system structure package, or one with what cannot be simulated here: nested systems,
            components that are no FMUs, transformations in connections, parameter files; or an input of the whole
            system that is not among `inputs`.
    """
    file = Path(path)
    folder = tempfile.mkdtemp(prefix="acausal-ssp-")
    try:
        with zipfile.ZipFile(file) as archive:
            archive.extractall(folder)
        root = ElementTree.parse(Path(folder) / _DOCUMENT).getroot()
    except (OSError, zipfile.BadZipFile, ElementTree.ParseError) as error:
        shutil.rmtree(folder, ignore_errors=True)
        raise CoSimulationError(f"{file.name} is not a system structure package: {error}") from error
    try:
        system = root.find("ssd:System", _SPACES)
        if system is None:
            raise CoSimulationError(f"{file.name}: the description has no system")
        made = _master(file.name, system, Path(folder), options)
    except BaseException:
        shutil.rmtree(folder, ignore_errors=True)
        raise
    weakref.finalize(made, shutil.rmtree, folder, True)
    return made


def _master(file: str, system: ElementTree.Element, folder: Path, options: Mapping[str, Any]) -> CoSimulation:
    connections = [_connection(file, c) for c in system.iterfind("ssd:Connections/ssd:Connection", _SPACES)]
    inner = [pair for pair in connections if all(not end.startswith(".") for end in pair)]
    given = options.get("inputs") or {}
    open_ends = [(a, b) for a, b in connections if a.startswith(".") and b not in given]
    if open_ends:
        a, b = open_ends[0]
        raise CoSimulationError(
            f"{file}: the system's own input `{a[1:]}` drives `{b}`, and nothing gives it a value. Give it as "
            f"read_ssp(..., inputs={{'{b}': 0.0}}): a number, or a function of time."
        )
    parts: dict[str, FmuParticipant] = {}
    for element in system.iterfind("ssd:Elements/*", _SPACES):
        name = element.get("name", "")
        if element.tag != _tag("ssd:Component"):
            raise CoSimulationError(
                f"{file}: element `{name}` is a {element.tag.rpartition('}')[2]}; only FMUs can be read"
            )
        parts[name] = _participant(file, element, folder, [a for a, _ in inner if a.startswith(f"{name}.")])
    own = system.find(f"ssd:Annotations/ssc:Annotation[@type='{_OWN}']/Master", _SPACES)
    chosen: dict[str, Any] = {}
    if own is not None:
        chosen = {k: _value(v) for k, v in own.attrib.items() if k in _OPTIONS}
        chosen["bonds"] = tuple(
            PowerBond(b.attrib["potential"], b.attrib["flow"], b.attrib["derivative"] == "true", b.attrib["name"])
            for b in own.iterfind("Bond")
        )
    return CoSimulation(parts, inner, **{**chosen, **options})


def _value(text: str) -> Any:
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text


def _connection(file: str, c: ElementTree.Element) -> tuple[str, str]:
    """Both ends as ``element.connector``; those of the system itself begin with a dot."""
    ends = (
        f"{c.get('startElement', '')}.{c.attrib['startConnector']}",
        f"{c.get('endElement', '')}.{c.attrib['endConnector']}",
    )
    for child in c:
        if child.tag.endswith("Transformation"):
            raise CoSimulationError(
                f"{file}: the connection {ends[0]} -> {ends[1]} transforms its signal: not supported"
            )
    return ends


def _participant(file: str, element: ElementTree.Element, folder: Path, given_out: list[str]) -> FmuParticipant:
    name, source = element.attrib["name"], PurePosixPath(element.attrib["source"])
    if element.get("type", "application/x-fmu-sharedlibrary") != "application/x-fmu-sharedlibrary":
        raise CoSimulationError(f"{file}: component `{name}` is of type {element.get('type')}; only FMUs can be read")
    if source.is_absolute() or ".." in source.parts:
        raise CoSimulationError(f"{file}: component `{name}`: its FMU {source} is not in the package")
    values: dict[str, float] = {}
    for binding in element.iterfind("ssd:ParameterBindings/ssd:ParameterBinding", _SPACES):
        if binding.get("source"):
            raise CoSimulationError(
                f"{file}: component `{name}` has its parameters in {binding.get('source')}: not read"
            )
        for p in binding.iterfind(".//ssv:Parameter", _SPACES):
            real = p.find("ssv:Real", _SPACES)
            if real is None:
                raise CoSimulationError(f"{file}: parameter `{name}.{p.get('name')}` is not a real number")
            values[binding.get("prefix", "") + p.attrib["name"]] = float(real.attrib["value"])
    needs = {
        n.attrib["name"]: int(n.attrib["derivatives"])
        for n in element.iterfind(f"ssd:Annotations/ssc:Annotation[@type='{_OWN}']/Participant/Needs", _SPACES)
    }
    fmu = load(folder / source)
    listed = [
        c.attrib["name"] for c in element.iterfind("ssd:Connectors/ssd:Connector", _SPACES) if c.get("kind") == "output"
    ]
    used = [a.partition(".")[2] for a in given_out]
    return fmu.participant(outputs=[*listed, *used], parameters=values, needs=needs, name=name)
