"""``ac.fmi.export``: a compiled system as a functional mock-up unit."""

from __future__ import annotations

import hashlib
import os
import re
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .binaries import library, place_of, this_platform
from .description import Description, build_description, write
from .source import KINDS, SOLVERS, equations, fixed_files, tables
from .structure import Dependence
from .variables import ExportError, collect

if TYPE_CHECKING:
    from ...system import System

VERSIONS = ("2.0", "3.0")


def export(
    system: System,
    path: str | os.PathLike[str],
    *,
    version: str = "3.0",
    kind: Sequence[str] = KINDS,
    platforms: Sequence[str] | None = None,
    stop: float = 1.0,
    tolerance: float = 1e-6,
    step: float = 0.01,
    solver: str = "rodas5p",
    dt: float | None = None,
) -> Path:
    """Write a system as a functional mock-up unit with sources and binaries.

    All parameters are tunable, inputs and outputs are those of the model.

    Args:
        system: a compiled system.
        path: file to write, ``crane.fmu``; its stem names the model's files.
        version: ``"3.0"`` or ``"2.0"`` of FMI.
        kind: interfaces that it offers: ``"me"`` (model exchange), ``"cs"`` (co-simulation), or both.
        platforms: what binaries are made for, as FMI 3.0 names platforms (``x86_64-linux``, ``aarch64-linux``,
            ``x86_64-windows``, ``aarch64-windows``, ``x86_64-darwin``, ``aarch64-darwin``); this machine's by default,
            others need the package ziglang; none with ``()``.
        stop: end of the default experiment [s].
        tolerance: relative tolerance of the default experiment.
        step: step of the default experiment [s].
        solver: inside a communication step: ``"rodas5p"`` (stiff), or, of the explicit methods, ``"adams"`` (variable
            order and step) or ``"rk4"`` (classical Runge-Kutta).
        dt: largest step of ``"rk4"`` [s]; a communication step is cut into equal parts.

    Returns:
        the path.

    Raises:
        ExportError: a version, kind, solver or platform that there is not, a parameter without a value, a model that is
            too large, or the compiler failed.
        NotInC: the model calls Python functions.
        NoCompiler: there is no C compiler on this machine.
    """
    place, system = Path(path), system.located
    kinds = _checked(version, kind)
    _check_solver(solver, dt)
    targets = (this_platform(),) if platforms is None else tuple(platforms)
    identifier = re.sub(r"\W", "_", place.stem, flags=re.ASCII)
    identifier = identifier if re.match(r"[A-Za-z_]", identifier) else f"_{identifier}"
    places = [place_of(target, version, identifier) for target in targets]
    if len(set(places)) < len(places):
        raise ExportError(f"FMI {version} has one name for two of the platforms {', '.join(targets)}")
    table = collect(system, version)
    code = equations(system, solver) + tables(system, table, kinds, solver, dt)
    fixed = fixed_files(version)
    main = f"fmi{version[0]}.c"
    description = Description(
        system.name, identifier, _token(code, fixed, identifier), _summary(system), table, Dependence(system), kinds,
        (main,), system.statements.roots.count if system.statements is not None else 0, stop, tolerance, step,
    )  # fmt: skip
    sources = fixed | {"equations.c": f'#define FMU_TOKEN "{description.token}"\n{code}'}
    members: dict[str, str | bytes] = {"modelDescription.xml": write(description, version)}
    for target, name in zip(targets, places, strict=True):
        members[name] = library(sources, main, target)
    members |= {f"sources/{name}": text for name, text in sources.items()}
    if version == "3.0":
        members["sources/buildDescription.xml"] = build_description(identifier, main)
    _pack(place, members)
    return place


def _checked(version: str, kind: Sequence[str]) -> tuple[str, ...]:
    if version not in VERSIONS:
        raise ExportError(f"version={version!r} of FMI is not one of {', '.join(VERSIONS)}")
    wanted = (kind,) if isinstance(kind, str) else tuple(kind)
    wrong = [k for k in wanted if k not in KINDS]
    if wrong or not wanted:
        raise ExportError(f"kind={kind!r}: an FMU offers 'me' (model exchange), 'cs' (co-simulation), or both")
    return tuple(k for k in KINDS if k in wanted)


def _check_solver(solver: str, dt: float | None) -> None:
    if solver not in SOLVERS:
        raise ExportError(f"solver={solver!r} is not one of {', '.join(SOLVERS)}")
    if (solver == "rk4") != (dt is not None):
        raise ExportError("'rk4', and no other method, takes fixed steps inside the unit: give the step, `dt=1e-4`")
    if dt is not None and not 0.0 < dt < float("inf"):
        raise ExportError(f"dt={dt!r}: the step inside the unit must be positive")


def _token(code: str, fixed: Mapping[str, str], identifier: str) -> str:
    """The same for the same sources."""
    digest = hashlib.sha256("\0".join([identifier, code, *fixed.values()]).encode()).hexdigest()
    return f"{{{digest[:8]}-{digest[8:12]}-{digest[12:16]}-{digest[16:20]}-{digest[20:32]}}}"


def _summary(system: System) -> str:
    """First sentence of the docstring of the model's class."""
    text = (system.stages.flat.root.cls.__doc__ or "").strip()
    return " ".join(text.split("\n\n")[0].split())


def _pack(place: Path, members: Mapping[str, str | bytes]) -> None:
    """A zip archive that is the same for the same members."""
    place.parent.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(place, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.compress_type = zipfile.ZIP_DEFLATED
            entry.external_attr = 0o644 << 16
            archive.writestr(entry, content)
