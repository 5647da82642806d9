"""Shared libraries from generated C: found in a cache, else made by the C compiler of the machine."""

from __future__ import annotations

import functools
import hashlib
import os
import platform
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from acausal.errors import AcausalError
from acausal.lowering.c.generate import CSource

FLAGS = ("-O2", "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=fast", "-fvisibility=hidden")
"""No flag that changes results beyond rounding: infinities and what is not a number behave as in Python."""


def flags() -> tuple[str, ...]:
    """Options for a compiler of this machine: `FLAGS`, then what ``$ACAUSAL_CFLAGS`` says."""
    return *FLAGS, *shlex.split(os.environ.get("ACAUSAL_CFLAGS", ""))


class NoCompiler(AcausalError):
    """There is no C compiler on this machine."""


@functools.cache
def compiler() -> tuple[str, ...]:
    """Command of the C compiler.

    ``$CC``, else ``cc``, ``gcc`` or ``clang``, else that of the package `ziglang`.

    Raises:
        NoCompiler: none of these is there.
    """
    chosen = os.environ.get("CC")
    if chosen:
        return tuple(chosen.split())
    if sys.platform != "win32":
        for name in ("cc", "gcc", "clang"):
            if shutil.which(name):
                return (name,)
    import importlib.util

    if importlib.util.find_spec("ziglang") is not None:
        return (sys.executable, "-m", "ziglang", "cc")
    raise NoCompiler(
        "There is no C compiler (looked for $CC, cc, gcc, clang and the package ziglang). "
        "Install one, for example with `pip install acausal[native]`, or use engine='diffrax'."
    )


def cache_folder() -> Path:
    """Where compiled models are kept: ``$ACAUSAL_CACHE``, else a folder of the user's cache."""
    chosen = os.environ.get("ACAUSAL_CACHE")
    if chosen:
        return Path(chosen)
    if sys.platform == "win32":
        base = Path(os.environ.get("LOCALAPPDATA") or Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = Path.home() / "Library" / "Caches"
    else:
        base = Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache")
    return base / "acausal" / "native"


@functools.cache
def _machine() -> str:
    """What a library made for this processor depends on."""
    text = platform.machine() + platform.system()
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
        text += next((line for line in lines if line.startswith("flags")), "")
    except OSError:
        text += platform.processor()
    return text


def build(source: CSource, defines: tuple[str, ...] = ()) -> Path:
    """The shared library of a source; made if the cache does not have it.

    Args:
        source: generated C.
        defines: macros to define, as ``NAME`` or ``NAME=value``.

    Raises:
        NoCompiler: there is no compiler.
        AcausalError: the compiler failed; its message is in the text.
    """
    command = compiler()
    native = () if "ziglang" in command else ("-march=native",) if platform.machine() in _MARCH else ()
    options = (*native, *flags(), *(f"-D{d}" for d in defines))
    key = hashlib.sha256(
        "\0".join([source.text, *source.runtime.values(), *command, *options, _machine()]).encode()
    ).hexdigest()[:32]
    folder = cache_folder()
    library = folder / f"{key}{_SUFFIX}"
    if not library.exists():
        folder.mkdir(parents=True, exist_ok=True)
        _compile(source, [*command, *options], library)
    return library


_SUFFIX = {"win32": ".dll", "darwin": ".dylib"}.get(sys.platform, ".so")
_MARCH = ("x86_64", "AMD64")


def _compile(source: CSource, command: list[str], library: Path) -> None:
    """Runs the compiler beside the library's place, then moves the result there in one step."""
    with tempfile.TemporaryDirectory(dir=library.parent) as name:
        place = Path(name)
        (place / "model.c").write_text(source.text, encoding="utf-8")
        for file, text in source.runtime.items():
            (place / file).write_text(text, encoding="utf-8")
        out = place / library.name
        made = subprocess.run(
            [*command, "-shared", "-fPIC", "-I", str(place), "-o", str(out), str(place / "model.c"), "-lm"],
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        if made.returncode != 0:
            raise AcausalError(f"The C compiler `{' '.join(command[:3])}` failed:\n{made.stderr[-2000:]}")
        os.replace(out, library)
