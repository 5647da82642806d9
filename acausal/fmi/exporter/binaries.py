"""Shared libraries of an FMU, for this platform and for others."""

from __future__ import annotations

import importlib.util
import platform
import subprocess
import sys
import tempfile
from collections.abc import Mapping
from pathlib import Path

from ...simulation.native_build import FLAGS, compiler, flags
from .variables import ExportError

TARGETS = {
    "x86_64-linux": "x86_64-linux-gnu.2.17", "aarch64-linux": "aarch64-linux-gnu.2.17",
    "x86_64-windows": "x86_64-windows-gnu", "aarch64-windows": "aarch64-windows-gnu",
    "x86_64-darwin": "x86_64-macos", "aarch64-darwin": "aarch64-macos",
}  # fmt: skip
"""Platforms as FMI 3.0 names them, and the compiler's names for them."""
FMI2 = {
    "x86_64-linux": "linux64", "x86_64-windows": "win64", "x86_64-darwin": "darwin64",
    "aarch64-darwin": "darwin64",
}  # fmt: skip
"""Platforms as FMI 2.0 names them."""
SUFFIX = {"linux": ".so", "windows": ".dll", "darwin": ".dylib"}
WARNINGS = ("-std=gnu11", "-Wall", "-Wextra", "-Wno-unused-parameter")


def this_platform() -> str:
    """Name of this machine's platform."""
    machine = {"AMD64": "x86_64", "arm64": "aarch64"}.get(platform.machine(), platform.machine())
    return f"{machine}-{platform.system().lower()}"


def place_of(target: str, version: str, name: str) -> str:
    """Path of a library in the archive.

    Raises:
        ExportError: the version of FMI has no name for the platform.
    """
    if target not in TARGETS:
        raise ExportError(f"`{target}` is not a platform that FMUs can be made for (these are: {', '.join(TARGETS)})")
    if version == "2.0" and target not in FMI2:
        raise ExportError(f"FMI 2.0 has no name for the platform `{target}`; take version='3.0'")
    folder = FMI2[target] if version == "2.0" else target
    return f"binaries/{folder}/{name}{SUFFIX[target.split('-')[1]]}"


def library(sources: Mapping[str, str], main: str, target: str) -> bytes:
    """Compile the sources for a platform.

    Args:
        sources: text by file name.
        main: the file that includes the others.
        target: platform.

    Raises:
        NoCompiler: there is no compiler on this machine.
        ExportError: no cross compiler, or the compiler failed.
    """
    here = target == this_platform()
    command = compiler() if here else _cross(target)
    with tempfile.TemporaryDirectory(prefix="acausal-fmu-") as folder:
        place = Path(folder)
        for name, text in sources.items():
            (place / name).write_text(text, encoding="utf-8")
        out = place / f"model{SUFFIX[target.split('-')[1]]}"
        options = [*(flags() if here else FLAGS), *WARNINGS, "-shared", *([] if "windows" in target else ["-fPIC"])]
        made = subprocess.run(
            [*command, *options, "-I", folder, "-o", str(out), str(place / main), "-lm"],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if made.returncode:
            raise ExportError(f"The C compiler `{' '.join(command[:3])}` failed:\n{made.stderr[-2000:]}")
        return out.read_bytes()


def _cross(target: str) -> tuple[str, ...]:
    if importlib.util.find_spec("ziglang") is None:
        raise ExportError(
            f"a library for {target} needs the package ziglang on this machine ({this_platform()}): "
            "`pip install acausal[native]`"
        )
    return (sys.executable, "-m", "ziglang", "cc", "-target", TARGETS[target])
