"""``modelDescription.xml`` of FMI 2.0 and 3.0, and ``buildDescription.xml``."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from xml.etree.ElementTree import Element, SubElement, indent, tostring

from .structure import Dependence
from .units import base_unit
from .variables import STRUCTURED, FmuVariable, Place

TOOL = "acausal"
CATEGORIES = {
    "logEvents": "events", "logStatusWarning": "warnings", "logStatusDiscard": "steps and values that were refused",
    "logStatusError": "errors", "logStatusFatal": "fatal errors",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Description:
    """What a model description tells.

    Attributes:
        name: of the model; identifier: of its files.
        token: that an importer hands back.
        table: all variables; the position is the value reference.
        kinds: ``me``, ``cs``.
        sources: C files that are compiled.
        indicators: number of event indicators.
        stop: end of the default experiment [s].
        tolerance: relative, of the default experiment.
        step: step of the default experiment [s].
    """

    name: str
    identifier: str
    token: str
    description: str
    table: Sequence[FmuVariable]
    dependence: Dependence
    kinds: Sequence[str]
    sources: Sequence[str]
    indicators: int
    stop: float
    tolerance: float
    step: float


def write(d: Description, version: str) -> str:
    """The model description."""
    root = _fmi2(d) if version == "2.0" else _fmi3(d)
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"


def _text(value: float) -> str:
    return repr(float(value))


def _root(d: Description, version: str, token: str) -> Element:
    names = [n for v in d.table for n in (v.name, *(a for a, _ in v.aliases))]
    convention = "structured" if all(STRUCTURED.fullmatch(n) for n in names) else "flat"
    attributes = {
        "fmiVersion": version, "modelName": d.name, token: d.token, "description": d.description,
        "generationTool": TOOL, "variableNamingConvention": convention,
    }  # fmt: skip
    return Element("fmiModelDescription", attributes)


def _units(root: Element, d: Description) -> None:
    parent = SubElement(root, "UnitDefinitions")
    for text in dict.fromkeys(v.unit for v in d.table if v.unit):
        unit, base = SubElement(parent, "Unit", name=text), base_unit(text)
        if base is not None:
            attributes = {name: str(e) for name, e in base.exponents}
            attributes |= {} if base.factor == 1.0 else {"factor": _text(base.factor)}
            attributes |= {} if base.offset == 0.0 else {"offset": _text(base.offset)}
            SubElement(unit, "BaseUnit", attributes)


def _common(root: Element, d: Description) -> None:
    _units(root, d)
    categories = SubElement(root, "LogCategories")
    for name, text in CATEGORIES.items():
        SubElement(categories, "Category", name=name, description=text)
    SubElement(
        root, "DefaultExperiment", startTime="0.0", stopTime=_text(d.stop), tolerance=_text(d.tolerance),
        stepSize=_text(d.step),
    )  # fmt: skip


def _numbers(v: FmuVariable) -> dict[str, str]:
    """Attributes that are alike in both versions."""
    values = {"unit": v.unit or None, "min": v.minimum, "max": v.maximum, "nominal": v.nominal, "start": v.start}
    return {k: x if isinstance(x, str) else _text(x) for k, x in values.items() if x is not None}


# ---- FMI 2.0 --------------------------------------------------------------------------------------
def _fmi2(d: Description) -> Element:
    root = _root(d, "2.0", "guid")
    root.set("numberOfEventIndicators", str(d.indicators))
    abilities = {
        "modelIdentifier": d.identifier, "canNotUseMemoryManagementFunctions": "true", "canGetAndSetFMUstate": "true",
        "canSerializeFMUstate": "true", "providesDirectionalDerivative": "true",
    }  # fmt: skip
    steps = {"canHandleVariableCommunicationStepSize": "true", "maxOutputDerivativeOrder": "1"}
    more = {**steps, "canInterpolateInputs": "true"}
    for kind, name, extra in (("me", "ModelExchange", {}), ("cs", "CoSimulation", more)):
        if kind in d.kinds:
            files = SubElement(SubElement(root, name, {**abilities, **extra}), "SourceFiles")
            for source in d.sources:
                SubElement(files, "File", name=source)
    _common(root, d)
    variables, position = SubElement(root, "ModelVariables"), _fmi2_positions(d)
    for reference, v in enumerate(d.table):
        for name, text in ((v.name, v.description), *v.aliases):
            attributes = {"name": name, "valueReference": str(reference), "causality": v.causality}
            attributes |= {"variability": v.variability}
            attributes |= {"description": text} if text else {}
            attributes |= {"initial": v.initial} if v.initial else {}
            scalar = SubElement(variables, "ScalarVariable", attributes)
            number = SubElement(scalar, "Real", _numbers(v))
            if v.derivative_of is not None:
                number.set("derivative", str(position[v.derivative_of]))
    structure = SubElement(root, "ModelStructure")
    for tag, rows in _structure(d).items():
        if rows:
            parent = SubElement(structure, tag)
            for reference, knowns in sorted(rows, key=lambda row: position[row[0]] if tag == "InitialUnknowns" else 0):
                unknown = SubElement(parent, "Unknown", index=str(position[reference]))
                unknown.set("dependencies", " ".join(str(i) for i in sorted(position[k] for k in knowns)))
    return root


def _fmi2_positions(d: Description) -> list[int]:
    """Number of each variable in the list, from 1, aliases being members of their own."""
    position, out = 1, list[int]()
    for v in d.table:
        out.append(position)
        position += 1 + len(v.aliases)
    return out


# ---- FMI 3.0 --------------------------------------------------------------------------------------
def _fmi3(d: Description) -> Element:
    root = _root(d, "3.0", "instantiationToken")
    abilities = {
        "modelIdentifier": d.identifier, "canGetAndSetFMUState": "true", "canSerializeFMUState": "true",
        "providesDirectionalDerivatives": "true", "providesAdjointDerivatives": "true",
    }  # fmt: skip
    if "me" in d.kinds:
        SubElement(root, "ModelExchange", {**abilities, "needsCompletedIntegratorStep": "true"})
    if "cs" in d.kinds:
        more = {
            "canHandleVariableCommunicationStepSize": "true", "maxOutputDerivativeOrder": "1",
            "mightReturnEarlyFromDoStep": "true", "hasEventMode": "true",
        }  # fmt: skip
        SubElement(root, "CoSimulation", {**abilities, **more})
    _common(root, d)
    variables = SubElement(root, "ModelVariables")
    for reference, v in enumerate(d.table):
        attributes = {"name": v.name, "valueReference": str(reference)}
        attributes |= {"description": v.description} if v.description else {}
        attributes |= {"causality": v.causality, "variability": v.variability}
        attributes |= {"initial": v.initial} if v.initial else {}
        attributes |= _numbers(v)
        attributes |= {} if v.derivative_of is None else {"derivative": str(v.derivative_of)}
        entry = SubElement(variables, "Float64", attributes)
        for name, text in v.aliases:
            SubElement(entry, "Alias", {"name": name} | ({"description": text} if text else {}))
    structure = SubElement(root, "ModelStructure")
    tags = {"Outputs": "Output", "Derivatives": "ContinuousStateDerivative", "InitialUnknowns": "InitialUnknown"}
    rows = _structure(d)
    tags["Indicators"] = "EventIndicator"
    first = next((k for k, v in enumerate(d.table) if v.place is Place.INDICATOR), 0)
    known = _knowns(d)
    rows["Indicators"] = [(first + k, sorted(known[i] for i in ids)) for k, ids in enumerate(d.dependence.roots)]
    for tag, entries in rows.items():
        for reference, knowns in entries:
            text = " ".join(str(k) for k in knowns)
            SubElement(structure, tags[tag], valueReference=str(reference), dependencies=text)
    return root


def _structure(d: Description) -> dict[str, list[tuple[int, list[int]]]]:
    """Value references of outputs, derivatives and initial unknowns, with those of what they depend on."""
    outputs = [k for k, v in enumerate(d.table) if v.causality == "output"]
    slopes = [k for k, v in enumerate(d.table) if v.place is Place.DERIVATIVE]
    states = [k for v in d.table if (k := v.derivative_of) is not None]
    knowns = _knowns(d)

    def number(v: FmuVariable) -> int:
        return d.dependence.slopes[v.index] if v.place is Place.DERIVATIVE else v.index

    def depends(k: int) -> list[int]:
        v = d.table[k]
        return [] if v.place is Place.ZERO else sorted(knowns[i] for i in d.dependence.of(number(v)))

    def depends_at_start(k: int) -> list[int]:
        v = d.table[k]
        if v.place is Place.ZERO:
            return []
        bits = d.dependence.parameters[v.index] if v.place is Place.CALCULATED else d.dependence.variables[number(v)]
        return sorted(knowns[i] for i in d.dependence.at_start(bits))

    initial = [
        k for k, v in enumerate(d.table)
        if (v.causality in ("output", "calculatedParameter") or k in states or v.place is Place.DERIVATIVE)
        and v.initial in ("approx", "calculated")
    ]  # fmt: skip
    return {
        "Outputs": [(k, depends(k)) for k in outputs], "Derivatives": [(k, depends(k)) for k in slopes],
        "InitialUnknowns": [(k, depends_at_start(k)) for k in initial],
    }  # fmt: skip


def _knowns(d: Description) -> list[int]:
    """Value references of the knowns as `Dependence` numbers them."""
    states = [k for v in d.table if (k := v.derivative_of) is not None]
    inputs = [k for k, v in enumerate(d.table) if v.place is Place.INPUT]
    time = next(k for k, v in enumerate(d.table) if v.place is Place.TIME)
    parameters = [k for k, v in enumerate(d.table) if v.place in (Place.PARAMETER, Place.CALCULATED)]
    return [*states, *inputs, time, *parameters]


def build_description(identifier: str, source: str) -> str:
    """How the sources of an FMI 3.0 unit are compiled."""
    root = Element("fmiBuildDescription", fmiVersion="3.0")
    configuration = SubElement(root, "BuildConfiguration", modelIdentifier=identifier)
    SubElement(SubElement(configuration, "SourceFileSet", language="C11"), "SourceFile", name=source)
    SubElement(configuration, "Library", name="m", external="true")
    indent(root)
    return '<?xml version="1.0" encoding="UTF-8"?>\n' + tostring(root, encoding="unicode") + "\n"
