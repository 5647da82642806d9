"""An exported unit behind its C interface, without an importer in between: every call gives its status and messages."""

from __future__ import annotations

import ctypes
import tempfile
import zipfile
from ctypes import POINTER, byref, c_bool, c_char_p, c_double, c_int, c_size_t, c_uint, c_void_p
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

import acausal
import acausal.fmi

_FOLDERS: list[Any] = []


@cache
def exported(model: Any, version: str) -> Unit:
    """The unit of a model class, made once; its folder lives as long as the process."""
    _FOLDERS.append(tempfile.TemporaryDirectory(prefix="acausal-test-"))
    folder = Path(_FOLDERS[-1].name)
    path = acausal.fmi.export(acausal.compile(model()), folder / f"{model.__name__}.fmu", version=version)
    return Unit(path, folder / "unpacked")


OK, WARNING, DISCARD, ERROR, FATAL = range(5)
LOGGER = {
    "2.0": ctypes.CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p),
    "3.0": ctypes.CFUNCTYPE(None, c_void_p, c_int, c_char_p, c_char_p),
}


class Callbacks(ctypes.Structure):
    """fmi2CallbackFunctions"""

    _fields_ = (
        ("logger", LOGGER["2.0"]), ("allocate", c_void_p), ("free", c_void_p), ("finished", c_void_p),
        ("environment", c_void_p),
    )  # fmt: skip


class Unit:
    """A loaded unit."""

    def __init__(self, path: Path, folder: Path) -> None:
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        self.folder = folder
        self.root = ElementTree.parse(folder / "modelDescription.xml").getroot()
        self.version = self.root.attrib["fmiVersion"]
        self.token = self.root.attrib["guid" if self.version == "2.0" else "instantiationToken"].encode()
        self.reference: dict[str, int] = {}
        for v in self.root.iterfind("ModelVariables/*"):
            for name in (v, *v.findall("Alias")):
                self.reference[name.attrib["name"]] = int(v.attrib["valueReference"])
        interface = self.root.find("CoSimulation")
        interface = self.root.find("ModelExchange") if interface is None else interface
        assert interface is not None
        self.identifier = interface.attrib["modelIdentifier"]
        (binary,) = (p for p in (folder / "binaries").rglob(f"{self.identifier}.*"))
        self.binary = binary
        self.handle = ctypes.CDLL(str(binary))

    def function(self, name: str) -> Any:
        """A function by its name without prefix."""
        return getattr(self.handle, f"fmi{self.version[0]}{name}")

    def instance(
        self,
        kind: str = "cs",
        token: bytes | None = None,
        name: bytes | None = b"one",
        flags: tuple[bool, bool] = (False, False),
    ) -> Instance:
        """A new instance; `flags`: event mode used and early return allowed, in co-simulation of FMI 3.0."""
        return Instance(self, kind, self.token if token is None else token, name, flags)


class Instance:
    """An instance; `messages` are (status, text)."""

    def __init__(self, unit: Unit, kind: str, token: bytes, name: bytes | None, flags: tuple[bool, bool]) -> None:
        self.unit, self.kind, self.version = unit, kind, unit.version
        self.messages: list[tuple[int, str]] = []
        if self.version == "2.0":
            self.logger: Any = LOGGER["2.0"](lambda _, __, status, ___, text: self._note(status, text))
            self.callbacks = Callbacks(self.logger, None, None, None, None)
            new = unit.function("Instantiate")
            new.restype = c_void_p
            self.pointer = c_void_p(
                new(name, c_int(1 if kind == "cs" else 0), token, b"", byref(self.callbacks), c_int(0), c_int(0))
            )
        else:
            self.logger = LOGGER["3.0"](lambda _, status, __, text: self._note(status, text))
            new = unit.function({"cs": "InstantiateCoSimulation", "me": "InstantiateModelExchange"}[kind])
            new.restype = c_void_p
            more = (*(c_bool(b) for b in flags), None, c_size_t(0)) if kind == "cs" else ()
            last = (None,) if kind == "cs" else ()
            self.pointer = c_void_p(
                new(name, token, None, c_bool(False), c_bool(False), *more, None, self.logger, *last)
            )

    def _note(self, status: int, text: bytes | None) -> None:
        self.messages.append((status, (text or b"").decode()))

    def call(self, name: str, *arguments: Any) -> int:
        """Status of a call; numbers are passed as C doubles, True and False as the Booleans of the version."""
        boolean = c_int if self.version == "2.0" else c_bool
        given = [
            boolean(a) if isinstance(a, bool) else c_double(a) if isinstance(a, float) else
            c_size_t(a) if isinstance(a, int) else a for a in arguments
        ]  # fmt: skip
        return int(self.unit.function(name)(self.pointer, *given))

    def free(self) -> None:
        """Free it."""
        function = self.unit.function("FreeInstance")
        function.restype = None
        function(self.pointer)

    # ---- values -----------------------------------------------------------------------------------
    def references(self, names: Any) -> Any:
        """C array of value references."""
        numbers = [self.unit.reference.get(n, n) for n in names]
        return (c_uint * max(len(numbers), 1))(*numbers)

    def get_status(self, names: Any) -> tuple[int, np.ndarray]:
        """Status and values."""
        values = np.full(len(names), np.nan)
        pointer = values.ctypes.data_as(POINTER(c_double))
        if self.version == "2.0":
            return self.call("GetReal", self.references(names), len(names), pointer), values
        return self.call("GetFloat64", self.references(names), len(names), pointer, len(names)), values

    def get(self, *names: str) -> np.ndarray:
        """Values."""
        status, values = self.get_status(names)
        assert status == OK, self.messages
        return values

    def set(self, **values: float) -> int:
        """Set variables; dots in names are written as two underscores."""
        return self.set_values({k.replace("__", "."): v for k, v in values.items()})

    def set_values(self, values: dict[Any, float]) -> int:
        """Set variables by name or value reference."""
        array = np.array(list(values.values()), float)
        pointer = array.ctypes.data_as(POINTER(c_double))
        if self.version == "2.0":
            return self.call("SetReal", self.references(values), len(array), pointer)
        return self.call("SetFloat64", self.references(values), len(array), pointer, len(array))

    # ---- time -------------------------------------------------------------------------------------
    def enter(self, start: float = 0.0, tolerance: float | None = None) -> int:
        """Enter initialization mode."""
        options = (tolerance is not None, tolerance or 0.0, start, False, 0.0)
        if self.version == "3.0":
            return self.call("EnterInitializationMode", *options)
        return self.call("SetupExperiment", *options) or self.call("EnterInitializationMode")

    def initialize(self, start: float = 0.0, tolerance: float | None = None) -> Instance:
        """To the first step; in model exchange to continuous-time mode."""
        assert self.enter(start, tolerance) == OK
        assert self.call("ExitInitializationMode") == OK, self.messages
        if self.kind == "me":
            self.update()
            assert self.call("EnterContinuousTimeMode") == OK
        return self

    def update(self) -> bool:
        """Event iteration; whether states have changed."""
        if self.version == "2.0":
            info = (c_int * 8)()
            assert self.call("NewDiscreteStates", info) == OK
            return bool(info[3])
        flags = [c_bool() for _ in range(5)]
        assert self.call("UpdateDiscreteStates", *(byref(b) for b in flags), byref(c_double())) == OK
        return flags[3].value

    def step(self, t: float, h: float) -> int:
        """One communication step."""
        if self.version == "2.0":
            return self.call("DoStep", t, h, True)
        flags, last = [c_bool() for _ in range(3)], c_double()
        return self.call("DoStep", t, h, True, *(byref(b) for b in flags), byref(last))

    def derivative(self, unknowns: Any, knowns: Any, seed: Any, adjoint: bool = False) -> np.ndarray:
        """Directional (or adjoint) derivative."""
        seeds = np.array(seed, float)
        out = np.full(len(knowns if adjoint else unknowns), np.nan)
        a, b = (x.ctypes.data_as(POINTER(c_double)) for x in (seeds, out))
        head = (self.references(unknowns), len(unknowns), self.references(knowns), len(knowns))
        if self.version == "2.0":
            status = self.call("GetDirectionalDerivative", *head, a, b)
        else:
            name = "GetAdjointDerivative" if adjoint else "GetDirectionalDerivative"
            status = self.call(name, *head, a, len(seeds), b, len(out))
        assert status == OK, self.messages
        return out

    # ---- saved states -----------------------------------------------------------------------------
    @property
    def _state(self) -> str:
        return "FMUstate" if self.version == "2.0" else "FMUState"

    def save(self) -> c_void_p:
        """Get the FMU state."""
        state = c_void_p()
        assert self.call(f"Get{self._state}", byref(state)) == OK
        return state

    def load(self, state: c_void_p) -> int:
        """Set the FMU state."""
        return self.call(f"Set{self._state}", state)

    def drop(self, state: c_void_p) -> int:
        """Free the FMU state."""
        return self.call(f"Free{self._state}", byref(state))

    def serialize(self, state: c_void_p) -> bytes:
        """The state as bytes."""
        size = c_size_t()
        name = self._state
        assert self.call(f"Serialized{name}Size", state, byref(size)) == OK
        place = ctypes.create_string_buffer(size.value)
        assert self.call(f"Serialize{name}", state, place, size.value) == OK
        return place.raw

    def deserialize(self, data: bytes) -> tuple[int, c_void_p]:
        """A state from bytes."""
        state = c_void_p()
        name = "DeSerializeFMUstate" if self.version == "2.0" else "DeserializeFMUState"
        return self.call(name, data, len(data), byref(state)), state
