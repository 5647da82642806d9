"""Rodas4, an ESDIRK method and BDF on the equations that the native engine compiles."""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Callable
from ctypes import POINTER, c_double, c_int, c_long
from pathlib import Path
from typing import Any

import numpy as np

from .integrators import GRID, T_END, Crane, Outcome, Tool, best

LIBRARIES = ("cvode", "nvecserial", "sunmatrixdense", "sunlinsoldense")
NAMES = ("Rodas4", "ESDIRK 5(4)", "BDF (CVODE)")


class _Esdirk(ctypes.Structure):
    _fields_ = (
        ("stages", c_int), ("order", c_int), ("a", c_double * 64), ("c", c_double * 8), ("b", c_double * 8),
        ("e", c_double * 8), ("gamma", c_double),
    )  # fmt: skip


def _kvaerno5() -> _Esdirk:
    """Coefficients of Kvaerno5, from diffrax."""
    import diffrax

    tableau: Any = diffrax.Kvaerno5.tableau
    n = len(tableau.b_sol)
    a = np.zeros((8, 8))
    for i, row in enumerate(tableau.a_lower):
        a[i + 1, : i + 1] = row
    made = _Esdirk(stages=n, order=5, gamma=float(tableau.a_diagonal[-1]))
    made.a[:] = a.ravel().tolist()
    for name, values in (("c", [0.0, *tableau.c]), ("b", tableau.b_sol), ("e", tableau.b_error)):
        getattr(made, name)[:n] = [float(v) for v in values]
    return made


class Methods:
    """The methods compiled with a crane's equations.

    Args:
        crane: the system.

    Raises:
        RuntimeError: the C compiler failed.
    """

    def __init__(self, crane: Crane) -> None:
        from acausal.simulation.native import native_model
        from acausal.simulation.started import Given

        self.crane = crane
        model = native_model(crane.system)
        self.started = model.start(0.0, Given({}, {}, []), model.native_library())
        self.folder = tempfile.TemporaryDirectory()
        place = Path(self.folder.name)
        (place / "model.c").write_text(model.source.text, encoding="utf-8")
        for name, text in model.source.runtime.items():
            (place / name).write_text(text, encoding="utf-8")
        source = Path(__file__).with_name("methods.c")
        command = [
            "cc", "-O2", "-march=native", "-fno-math-errno", "-fno-trapping-math", "-shared", "-fPIC",
            '-DMODEL="model.c"', f"-I{place}", str(source), "-o", str(place / "methods.so"),
        ]  # fmt: skip
        with_cvode = [*command, "-DWITH_CVODE", *(f"-lsundials_{name}" for name in LIBRARIES), "-lm"]
        self.cvode = subprocess.run(with_cvode, capture_output=True, check=False).returncode == 0
        if not self.cvode:
            made = subprocess.run([*command, "-lm"], capture_output=True, text=True, check=False)
            if made.returncode:
                raise RuntimeError(made.stderr)
        self.handle = ctypes.CDLL(str(place / "methods.so"))

    def tool(self, name: str, repeats: int) -> Tool:
        """One of `NAMES`."""
        from acausal.simulation.engines import tolerances

        n = len(self.started.z0)
        out, steps = np.empty((len(GRID), n)), c_long()
        coefficients = _kvaerno5()
        p, z0 = (_of(a) for a in (self.started.p, self.started.z0))

        def solve(rtol: float) -> Outcome:
            how = tolerances(self.crane.system, rtol, None, None, 1_000_000)
            rest = (
                c_double(how.rtol), _of(how.atol), c_double(T_END), z0, p, c_long(len(GRID)), _of(GRID), _of(out),
                ctypes.byref(steps),
            )  # fmt: skip
            run: Callable[[], int]
            if name == "BDF (CVODE)":
                run = lambda: self.handle.bdf_run(*rest)  # noqa: E731
            else:
                given = ctypes.byref(coefficients) if name.startswith("ESDIRK") else None
                run = lambda: self.handle.method_run(given, *rest)  # noqa: E731
            milliseconds, failed = best(run, repeats)
            if failed:
                raise RuntimeError(f"{name} failed")
            return Outcome(milliseconds, self.crane.sorted(out), int(steps.value))

        return solve


def _of(a: Any) -> Any:
    return np.ascontiguousarray(a, float).ctypes.data_as(POINTER(c_double))
