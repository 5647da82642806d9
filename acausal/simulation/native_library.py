"""A compiled model behind its C interface: NumPy arrays in and out, the interpreter lock released while it runs."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from ctypes import POINTER, byref, c_double, c_int, c_long, c_void_p
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from acausal.errors import AcausalError

from .watch import CALLBACK, watch

Floats = NDArray[np.float64]
_P = c_void_p

Signal = tuple[Floats, Floats]
"""An input over time: times (n,) and values (n,); one point is a constant."""

RESULTS = (
    "successful", "max_steps_reached", "dt_min_reached", "singular", "out_of_memory", "stopped", "event_occurred",
)  # fmt: skip
"""Names of the results of a run, by code; as diffrax calls them where it has them."""
STOPPED = RESULTS.index("stopped")


METHODS = ("rodas5p", "rk4", "adams")
"""Methods by number."""
PASSED = 64
"""Events that only switch modes up to which a run goes on by itself."""


class _Signal(ctypes.Structure):
    _fields_ = (("n", c_int), ("t", _P), ("v", _P))


class _Problem(ctypes.Structure):
    _fields_ = (
        ("t0", c_double), ("t1", c_double), ("rtol", c_double), ("first_step", c_double), ("smallest", c_double),
        ("atol", _P), ("method", c_int),
        ("max_steps", c_long), ("z0", _P), ("p", _P), ("signals", POINTER(_Signal)),
        ("index", c_void_p), ("nominal", _P),
        ("n_save", c_long), ("save", _P), ("n_directions", c_int), ("dz0", _P), ("dp", _P), ("z_out", _P),
        ("dz_out", _P), ("z_end", _P), ("dz_end", _P), ("t_end", c_double), ("steps", c_long), ("accepted", c_long),
        ("rejected", c_long), ("pivoted", c_long), ("saved", c_long), ("watch", CALLBACK),
        ("watched", c_long), ("located", c_int),
        ("open", c_int), ("step", c_double), ("noise", _P), ("switched", c_void_p),
        ("most_passed", c_long), ("passed", c_long), ("passed_t", _P), ("passed_saved", _P), ("passed_switched", _P),
        ("largest", _P),
    )  # fmt: skip


class Run:
    """What a run gave.

    Attributes:
        z: (n_saved, n_z); NaN where the run did not get to.
        dz: (n_saved, n_z, lanes), or None.
        code: 0, or the position in `RESULTS` of what ended it.
        t_end, z_end: the last accepted point.
        dz_end: tangents there (n, lanes), or None.
        step: to go on with from there.
        switched: mask of the roots that have changed their sign at an event.
        counts: steps, accepted, rejected, pivoted.
        passed: events within the run that only switched modes: time, rows saved before, mask of the roots.
    """

    __slots__ = ("code", "counts", "dz", "dz_end", "passed", "saved", "step", "switched", "t_end", "z", "z_end")

    def __init__(
        self, z: Floats, dz: Floats | None, code: int, problem: _Problem, z_end: Floats, dz_end: Floats | None = None,
        switched: Any = None, passed: Sequence[tuple[float, int, Any]] = (),
    ) -> None:  # fmt: skip
        self.z, self.dz, self.code, self.z_end, self.dz_end, self.switched = z, dz, code, z_end, dz_end, switched
        self.passed = passed
        self.step = float(problem.step)
        self.t_end = float(problem.t_end)
        self.saved = int(problem.saved)
        self.counts = {name: int(getattr(problem, name)) for name in ("steps", "accepted", "rejected", "pivoted")}


class _Passed:
    """Room for the events that a run passes."""

    def __init__(self, problem: _Problem, largest: Floats) -> None:
        self.t, self.saved = np.empty(PASSED), np.empty(PASSED, c_long)
        self.switched = np.empty((PASSED, len(largest)), np.int32)
        problem.most_passed, problem.largest = PASSED, _of(largest)
        problem.passed_t, problem.passed_saved = _of(self.t), _of(self.saved)
        problem.passed_switched = _of(self.switched)

    def found(self, problem: _Problem) -> list[tuple[float, int, Any]]:
        """Time, rows saved before, and mask of the roots of each."""
        masks = self.switched.astype(bool)
        return [(float(self.t[k]), int(self.saved[k]), masks[k]) for k in range(problem.passed)]


class NativeLibrary:
    """Functions of a compiled model.

    Attributes:
        n, n_x, n_p: sizes of z = (x, w), of x, of the parameters with the inputs.
        n_all: number of variables of the reduced model.
        lanes: directions that one run of tangents carries.
        start_rows, start_columns: pattern of the derivatives of the start's conditions.
    """

    def __init__(self, path: Path, tangents: bool, tables: Sequence[Any] = (), nominal: Any = None) -> None:
        self.tables = list(tables)
        self.index = (c_void_p * max(len(self.tables), 1))(*(a.ctypes.data for a in self.tables))
        self.nominal = None if nominal is None else np.ascontiguousarray(nominal, float)
        self.handle = ctypes.CDLL(str(path))
        lib = self.handle
        lib.acausal_size.restype = c_long
        sizes = [int(lib.acausal_size(k)) for k in range(9)]
        self.n, self.n_x, self.n_p, self.n_i, n_iz, self.n_all, self.lanes, size, self.n_roots = sizes
        if size != ctypes.sizeof(_Problem):
            raise AcausalError("the compiled model and this version of acausal do not fit; empty the cache folder")
        self.tangents = tangents
        lib.acausal_run.argtypes = (POINTER(_Problem),)
        lib.acausal_settle.argtypes = (_P, POINTER(_Signal), c_void_p, _P, c_double, _P)
        lib.acausal_observe.argtypes = (_P, POINTER(_Signal), c_void_p, c_long, _P, _P, _P)
        if not self.tables:
            self._bind_start(n_iz)

    def _bind_start(self, n_iz: int) -> None:
        """Functions of the parameters and the start, that systems which are written out have."""
        lib, tangents = self.handle, self.tangents
        lib.acausal_start_pattern.restype = POINTER(c_int)
        self.start_rows, self.start_columns = (
            np.ctypeslib.as_array(lib.acausal_start_pattern(k), (max(n_iz, 1),))[:n_iz].copy() for k in (0, 1)
        )
        lib.acausal_parameters.argtypes = (c_void_p, _P)
        lib.acausal_starts.argtypes = (_P, _P)
        lib.acausal_conditions.argtypes = (_P, c_double, _P, _P, _P)
        lib.acausal_start.argtypes = (_P, c_double, c_void_p, _P, _P, c_int, _P)
        lib.acausal_start.restype = c_double
        for name in ("parameters", "starts", "conditions"):
            getattr(lib, f"acausal_{name}").restype = None
        if tangents:
            lib.acausal_parameters_tangent.argtypes = (c_void_p, _P, _P)
            lib.acausal_starts_tangent.argtypes = (_P, _P, _P)
            lib.acausal_conditions_tangent.argtypes = (_P, _P, c_double, _P, _P, _P)
            for name in ("parameters", "starts", "conditions"):
                getattr(lib, f"acausal_{name}_tangent").restype = None

    # ---- parameters and start ---------------------------------------------------------------------
    def parameters(self, given: NDArray[np.uint8], p: Floats) -> None:
        """Dependent parameters in place, except those that are `given` (a mask)."""
        self.handle.acausal_parameters(_of(given), _of(p))

    def starts(self, p: Floats, starts: Floats) -> None:
        """Start values that depend on parameters, in place."""
        self.handle.acausal_starts(_of(p), _of(starts))

    def conditions(self, p: Floats, t: float, z: Floats) -> tuple[Floats, Floats]:
        """What must vanish at the start (n_i,), and its derivatives (n_i, n)."""
        value, entries = np.empty(self.n_i), np.empty(len(self.start_rows))
        self.handle.acausal_conditions(_of(p), t, _of(z), _of(value), _of(entries))
        matrix = np.zeros((self.n_i, self.n))
        matrix[self.start_rows, self.start_columns] = entries
        return value, matrix

    def start(
        self, p: Floats, t: float, fixed: NDArray[np.bool_], ease: Floats, wanted: Floats, z: Floats
    ) -> float:
        """A consistent start from the start values z (n,), in place; the largest relative residual left.

        Args:
            p: parameters (n_p,).
            t: start time [s].
            fixed: mask of the states (n_x,) that keep their start values.
            ease: scale in which a variable is moved (n,).
            wanted: values of the variables whose start is a condition.
            z: start values.
        """
        left = float(
            self.handle.acausal_start(_of(p), t, _of(fixed), _of(ease), _of(wanted), len(wanted), _of(z))
        )
        if left < 0.0:
            raise MemoryError("no memory for the start")
        return left

    def parameters_tangent(self, given: NDArray[np.uint8], p: Floats, dp: Floats) -> None:
        """Tangents (n_p, lanes) of dependent parameters, in place."""
        self.handle.acausal_parameters_tangent(_of(given), _of(p), _of(dp))

    def starts_tangent(self, p: Floats, dp: Floats, ds: Floats) -> None:
        """Tangents of start values, in place."""
        self.handle.acausal_starts_tangent(_of(p), _of(dp), _of(ds))

    def conditions_tangent(self, p: Floats, dp: Floats, t: float, z: Floats, dz: Floats) -> Floats:
        """Tangents (n_i, lanes) of what must vanish at the start."""
        out = np.empty((self.n_i, self.lanes))
        self.handle.acausal_conditions_tangent(_of(p), _of(dp), t, _of(z), _of(dz), _of(out))
        return out

    # ---- run --------------------------------------------------------------------------------------
    def run(
        self, t0: float, t1: float, z0: Floats, p: Floats, save: Floats, *, rtol: float, atol: Floats,
        signals: Sequence[Signal] = (), first_step: float = 0.0, max_steps: int = 1_000_000, method: int = 0,
        tangents: tuple[Floats, Floats] | None = None, noise: Floats | None = None, end_open: bool = False,
        largest: Floats | None = None,
    ) -> Run:  # fmt: skip
        """Integrate from t0 to t1.

        Args:
            t0, t1: start and end time [s].
            z0: consistent start (n,).
            p: parameters (n_p,).
            save: output times (n_t,), in the direction of the run.
            rtol: relative tolerance.
            atol: absolute tolerances (n,).
            signals: inputs.
            first_step: first step [s]; 0 to estimate one.
            max_steps: most steps, rejected ones included.
            method: position in `METHODS`.
            tangents: of z0 (n, lanes) and p (n_p, lanes).
            noise: end at the first event; values of its functions (n_roots,) this small are rounding.
            end_open: save nothing at t1.
            largest: largest values of the functions (n_roots,) at earlier events, kept up in place; events that only
                switch modes then do not end the run, as many as `PASSED`.

        Raises:
            KeyboardInterrupt: the run was ended by Ctrl-C or a request to stop.
        """
        n_t = len(save)
        z, z_end = np.full((n_t, self.n), np.nan), np.empty(self.n)
        keep = [np.ascontiguousarray(a, float) for a in (z0, p, save, atol)]
        problem = _Problem(
            t0=t0, t1=t1, rtol=rtol, first_step=first_step, atol=_of(keep[3]), method=method, max_steps=max_steps,
            smallest=1e-14 * max(abs(t0), abs(t1), abs(t1 - t0)), z0=_of(keep[0]), p=_of(keep[1]), n_save=n_t,
            save=_of(keep[2]), z_out=_of(z), z_end=_of(z_end), t_end=t0, located=noise is not None, open=end_open,
        )  # fmt: skip
        small = np.zeros(self.n_roots) if noise is None else np.array(noise, float)
        problem.noise = _of(small)
        switched = np.zeros(max(self.n_roots, 1), np.int32)
        problem.switched = _of(switched)
        passed = None if largest is None else _Passed(problem, largest)
        held = _signals(signals)
        problem.signals = held[0]
        problem.index = ctypes.addressof(self.index)
        if self.nominal is not None:
            problem.nominal = _of(self.nominal)
        dz = dz_end = None
        if tangents is not None:
            dz0, dp = (np.ascontiguousarray(a, float) for a in tangents)
            dz, dz_end = np.full((n_t, self.n, self.lanes), np.nan), np.empty((self.n, self.lanes))
            problem.n_directions = self.lanes
            problem.dz0, problem.dp, problem.dz_out, problem.dz_end = _of(dz0), _of(dp), _of(dz), _of(dz_end)
        problem.watch = watch.callback
        code = int(self.handle.acausal_run(byref(problem)))
        if code == STOPPED:
            raise KeyboardInterrupt
        found = () if passed is None else passed.found(problem)
        return Run(z, dz, code, problem, z_end, dz_end, switched[: self.n_roots].astype(bool), found)

    def settle(self, p: Floats, signals: Sequence[Signal], t: float, z: Floats) -> bool:
        """The algebraic unknowns in z (n,) from its states, in place; False if that fails."""
        held = _signals(signals)
        nominal = None if self.nominal is None else _of(self.nominal)
        return not self.handle.acausal_settle(_of(p), held[0], self.index, nominal, t, _of(z))

    def observe(self, p: Floats, signals: Sequence[Signal], t: Floats, z: Floats) -> Floats:
        """Every variable of the reduced model at times t (n_t,): (n_t, n_all); NaN where it is not computed."""
        out = np.full((len(t), self.n_all), np.nan)
        t, z = np.ascontiguousarray(t, float), np.ascontiguousarray(z, float)
        held = _signals(signals)
        if self.handle.acausal_observe(_of(p), held[0], self.index, len(t), _of(t), _of(z), _of(out)):
            raise MemoryError("no memory to evaluate all variables")
        return out


def _of(array: NDArray[Any]) -> int:
    """The address; whoever passes it on keeps the array alive meanwhile."""
    return array.ctypes.data


def _signals(signals: Sequence[Signal]) -> tuple[Any, Any]:
    """The C array of the inputs, and what it points to."""
    arrays = [(np.ascontiguousarray(t, float), np.ascontiguousarray(v, float)) for t, v in signals]
    made = (_Signal * max(len(arrays), 1))()
    for k, (t, v) in enumerate(arrays):
        made[k] = _Signal(len(t), _of(t), _of(v))
    return made, arrays
