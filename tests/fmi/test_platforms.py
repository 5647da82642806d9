"""Binaries for other platforms by cross-compilation, and a binary from the sources in a unit."""

from __future__ import annotations

import shutil
import subprocess
import zipfile

import pytest

import acausal as ac
import acausal.fmi
from acausal.fmi import CoSimulation

from .export_models import Oscillator
from .models import Decay

MAGIC = {
    "binaries/x86_64-windows/one.dll": (b"MZ", None),
    "binaries/aarch64-linux/one.so": (b"\x7fELF", (18, b"\xb7\x00")),
    "binaries/x86_64-linux/one.so": (b"\x7fELF", (18, b"\x3e\x00")),
    "binaries/aarch64-darwin/one.dylib": (b"\xcf\xfa\xed\xfe", (4, b"\x0c\x00\x00\x01")),
    "binaries/x86_64-darwin/one.dylib": (b"\xcf\xfa\xed\xfe", (4, b"\x07\x00\x00\x01")),
}
"""By file: how it begins, and where its machine stands."""


@pytest.mark.slow
def test_cross_compilation(tmp_path):
    pytest.importorskip("ziglang")
    platforms = tuple(name.split("/")[1] for name in MAGIC)
    path = ac.fmi.export(ac.compile(Oscillator()), tmp_path / "one.fmu", platforms=platforms)
    with zipfile.ZipFile(path) as archive:
        assert [n for n in archive.namelist() if n.startswith("binaries")] == list(MAGIC)
        for name, (begin, machine) in MAGIC.items():
            data = archive.read(name)
            assert data.startswith(begin) and len(data) > 10_000, name
            if machine is not None:
                place, value = machine
                assert data[place : place + len(value)] == value, name


@pytest.mark.parametrize("version", ("2.0", "3.0"))
def test_the_sources_build(version, tmp_path):
    """As an importer does it: the files that the description lists, with the sources folder to include from."""
    cc = shutil.which("cc")
    if cc is None:
        pytest.skip("no C compiler by name")
    import fmpy

    path = ac.fmi.export(ac.compile(Decay()), tmp_path / "decay.fmu", version=version, platforms=())
    (configuration,) = fmpy.read_model_description(str(path)).buildConfigurations
    assert configuration.modelIdentifier == "decay"
    folder = tmp_path / "unpacked"
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    listed = [str(folder / "sources" / f) for s in configuration.sourceFileSets for f in s.sourceFiles]
    place = "linux64" if version == "2.0" else fmpy.platform_tuple
    (folder / "binaries" / place).mkdir(parents=True)
    binary = folder / "binaries" / place / f"decay{fmpy.sharedLibraryExtension}"
    options = ["-shared", "-fPIC", "-I", str(folder / "sources"), "-o", str(binary)]
    subprocess.run([cc, *options, *listed, "-lm"], check=True)
    packed = shutil.make_archive(str(tmp_path / "built"), "zip", folder)
    unit = tmp_path / "built.fmu"
    shutil.move(packed, unit)
    with CoSimulation({"d": ac.fmi.load(unit)}, [], inputs={"d.u": 2.0}, step=0.1) as master:
        assert master.simulate(1.0)["y"][-1] == pytest.approx(2 - 2.718281828459045**-2, abs=1e-4)
