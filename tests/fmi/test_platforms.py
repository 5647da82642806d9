"""Binaries for other platforms by cross-compilation, and a binary from the sources in a unit."""

from __future__ import annotations

import shutil
import subprocess
import zipfile

import pytest

import acausal as ac
import acausal.fmi
from acausal.fmi import CoSimulation

from .export_models import Ball, Oscillator
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


PROGRAM = {
    "2.0": """
#include "fmi2_types.h"
#include <stdarg.h>
#include <stdio.h>
static void say(void *e, fmi2String n, fmi2Status s, fmi2String c, fmi2String m, ...) {
    (void)e, (void)n, (void)s, (void)c, puts(m);
}
#define UNIT(P)                                                                                                    \\
    fmi2Component P##_fmi2Instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *,  \\
                                      fmi2Boolean, fmi2Boolean);                                                   \\
    fmi2Status P##_fmi2EnterInitializationMode(fmi2Component), P##_fmi2ExitInitializationMode(fmi2Component);       \\
    fmi2Status P##_fmi2DoStep(fmi2Component, double, double, fmi2Boolean);                                         \\
    fmi2Status P##_fmi2GetReal(fmi2Component, const fmi2ValueReference *, size_t, double *);                       \\
    void P##_fmi2FreeInstance(fmi2Component);                                                                      \\
    static double P##_run(const char *token, fmi2ValueReference r) {                                               \\
        const fmi2CallbackFunctions calls = {say, 0, 0, 0, 0};                                                     \\
        double v = -1.0;                                                                                           \\
        fmi2Component c = P##_fmi2Instantiate("it", fmi2CoSimulation, token, 0, &calls, 0, 0);                     \\
        if (!c || P##_fmi2EnterInitializationMode(c) || P##_fmi2ExitInitializationMode(c)) return -1.0;            \\
        if (P##_fmi2DoStep(c, 0.0, 0.4, 1) || P##_fmi2GetReal(c, &r, 1, &v)) return -1.0;                          \\
        P##_fmi2FreeInstance(c);                                                                                   \\
        return v;                                                                                                  \\
    }
""",
    "3.0": """
#include "fmi3_types.h"
#include <stdio.h>
#define UNIT(P)                                                                                                    \\
    fmi3Instance P##_fmi3InstantiateCoSimulation(                                                                  \\
        fmi3String, fmi3String, fmi3String, bool, bool, bool, bool, const fmi3ValueReference *, size_t,            \\
        fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);                          \\
    fmi3Status P##_fmi3EnterInitializationMode(fmi3Instance, bool, double, double, bool, double);                  \\
    fmi3Status P##_fmi3ExitInitializationMode(fmi3Instance);                                                       \\
    fmi3Status P##_fmi3DoStep(fmi3Instance, double, double, bool, bool *, bool *, bool *, double *);               \\
    fmi3Status P##_fmi3GetFloat64(fmi3Instance, const fmi3ValueReference *, size_t, double *, size_t);             \\
    void P##_fmi3FreeInstance(fmi3Instance);                                                                       \\
    static double P##_run(const char *token, fmi3ValueReference r) {                                               \\
        bool event, end, early;                                                                                    \\
        double last, v = -1.0;                                                                                     \\
        fmi3Instance c = P##_fmi3InstantiateCoSimulation("it", token, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0);               \\
        if (!c || P##_fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0)) return -1.0;                            \\
        if (P##_fmi3ExitInitializationMode(c)) return -1.0;                                                        \\
        if (P##_fmi3DoStep(c, 0.0, 0.4, 1, &event, &end, &early, &last)) return -1.0;                              \\
        if (P##_fmi3GetFloat64(c, &r, 1, &v, 1)) return -1.0;                                                      \\
        P##_fmi3FreeInstance(c);                                                                                   \\
        return v;                                                                                                  \\
    }
""",
}
"""Runs units that are linked into it, each under its own prefix."""


@pytest.mark.parametrize("version", ("2.0", "3.0"))
def test_two_units_in_one_program(version, tmp_path):
    """With the standard's prefix of function names their sources can be linked statically."""
    cc = shutil.which("cc")
    if cc is None:
        pytest.skip("no C compiler by name")
    major, objects, calls = version[0], [], []
    for name, model, variable in (("decay", Decay, "y"), ("ball", Ball, "h")):
        folder = tmp_path / name
        path = ac.fmi.export(ac.compile(model()), tmp_path / f"{name}.fmu", version=version, platforms=())
        with zipfile.ZipFile(path) as archive:
            archive.extractall(folder)
        unit = ac.fmi.load(path)
        objects.append(str(tmp_path / f"{name}.o"))
        define = f"-DFMI{major}_FUNCTION_PREFIX={name}_"
        source = str(folder / "sources" / f"fmi{major}.c")
        subprocess.run([cc, "-O1", "-c", define, source, "-o", objects[-1]], check=True)
        calls.append(f'{name}_run("{unit.description.guid}", {unit.variable(variable).valueReference})')
    main = f'int main(void) {{ printf("%.9g %.9g", {", ".join(calls)}); }}'
    (tmp_path / "main.c").write_text(f"{PROGRAM[version]}\nUNIT(decay)\nUNIT(ball)\n{main}\n")
    program = str(tmp_path / "program")
    include = ["-I", str(tmp_path / "decay" / "sources")]
    subprocess.run([cc, *include, str(tmp_path / "main.c"), *objects, "-lm", "-o", program], check=True)
    found = subprocess.run([program], check=True, capture_output=True, text=True).stdout
    decay, ball = (float(v) for v in found.split())
    assert decay == pytest.approx(2.718281828459045**-0.8, rel=1e-5)
    assert ball == pytest.approx(1 - 4.905 * 0.16, rel=1e-5)
