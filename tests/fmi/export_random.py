"""Random sequences of calls, legal and illegal, on one unit; run as a program, since a crash is what it looks for.

Every status is checked against a small model of the state machine: a call that is not allowed is an error, and one that
is allowed and well formed is not.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from ctypes import byref, c_bool, c_double, c_int, c_size_t, c_void_p
from pathlib import Path
from typing import Any

import numpy as np

_spec = importlib.util.spec_from_file_location("export_unit", Path(__file__).with_name("export_unit.py"))
assert _spec is not None and _spec.loader is not None
export_unit = importlib.util.module_from_spec(_spec)
sys.modules["export_unit"] = export_unit
_spec.loader.exec_module(export_unit)

READABLE = {"initialization", "event", "continuous", "step", "failed", "terminated"}


class Walk:
    """One instance, and the mode that it should be in."""

    def __init__(self, unit: Any, random: np.random.Generator) -> None:
        self.unit, self.random = unit, random
        self.kind = str(random.choice(["cs", "me"]))
        self.one = unit.instance(self.kind)
        self.mode, self.t = "instantiated", 0.0
        self.saved: list[tuple[c_void_p, str, float]] = []
        self.references = sorted(set(unit.reference.values()))

    def check(self, name: str, status: int, allowed: bool, strict: bool = True) -> bool:
        """Whether the call was done; `strict`: allowed means that it must succeed."""
        if not allowed and status != export_unit.ERROR:
            raise AssertionError(f"{name} in {self.mode} ({self.kind}) gave {status}, not an error")
        if allowed and strict and status != export_unit.OK:
            raise AssertionError(f"{name} in {self.mode} ({self.kind}) gave {status}: {self.one.messages[-3:]}")
        return status == export_unit.OK

    # ---- one call each ----------------------------------------------------------------------------
    def enter(self) -> None:
        if self.check("enter", self.one.enter(0.0, 1e-5), self.mode == "instantiated"):
            self.mode, self.t = "initialization", 0.0

    def leave(self) -> None:
        done = self.one.call("ExitInitializationMode")
        if self.check("exit", done, self.mode == "initialization", strict=False):
            self.mode = "step" if self.kind == "cs" else "event"

    def step(self) -> None:
        h = float(self.random.choice([1e-3, 0.01, 0.1, 1.0]))
        allowed = self.mode == "step" and self.kind == "cs"
        status = self.one.step(self.t, h)
        if self.check("step", status, allowed, strict=False):
            self.t += h
        elif allowed:  # the instance has failed, or stands still where its equations have no solution
            again = self.one.step(self.t, h)
            self.mode = "failed" if "step failed" in self.one.messages[-1][1] else self.mode
            assert again != export_unit.OK

    def odd_step(self) -> None:
        h, t = self.random.choice([-1.0, np.nan, np.inf, 1e-3]), self.t + self.random.choice([1.0, -5.0, np.nan])
        self.check("odd step", self.one.step(float(t), float(h)), False)

    def get(self) -> None:
        names = [int(r) for r in self.random.choice(self.references, self.random.integers(0, 5))]
        self.check("get", self.one.get_status(names)[0], self.mode in READABLE, strict=False)

    def get_nothing(self) -> None:
        self.check("get nothing", self.one.get_status([10_000 + len(self.references)])[0], False)

    def set(self) -> None:
        r = int(self.random.choice(self.references))
        self.one.set_values({r: float(self.random.choice([0.5, 1.0, 2.0, -1.0, 0.0]))})

    def set_bad(self) -> None:
        r = int(self.random.choice(self.references))
        self.check("set NaN", self.one.set_values({r: np.nan}), False)

    def null(self) -> None:
        two = self.unit.version == "2.0"
        name = str(self.random.choice(["GetReal", "SetReal"] if two else ["GetFloat64", "SetFloat64"]))
        self.check(name, self.one.call(name, None, 3, None, *(() if two else (3,))), False)

    def derivatives(self) -> None:
        name = "GetDerivatives" if self.unit.version == "2.0" else "GetContinuousStateDerivatives"
        n = int(self.random.integers(0, 6))
        self.one.call(name, (c_double * 6)(), n)
        self.one.call("GetContinuousStates", (c_double * 6)(), n)
        self.one.call("GetNominalsOfContinuousStates", (c_double * 6)(), n)
        self.one.call("GetEventIndicators", (c_double * 6)(), n)

    def states(self) -> None:
        n = int(self.random.integers(0, 6))
        values = (c_double * 6)(*self.random.normal(size=6))
        self.one.call("SetContinuousStates", values, n)

    def time(self) -> None:
        allowed = self.kind == "me" and self.mode in ("event", "continuous")
        if self.check("time", self.one.call("SetTime", self.t + 0.1), allowed):
            self.t += 0.1

    def event(self) -> None:
        if self.check("event", self.one.call("EnterEventMode"), self.kind == "me" and self.mode == "continuous"):
            self.mode = "event"

    def continuous(self) -> None:
        allowed = self.kind == "me" and self.mode == "event"
        if self.check("continuous", self.one.call("EnterContinuousTimeMode"), allowed):
            self.mode = "continuous"

    def update(self) -> None:
        allowed = self.kind == "me" and self.mode == "event"
        if self.unit.version == "2.0":
            self.check("update", self.one.call("NewDiscreteStates", (c_int * 16)()), allowed)
            return
        flags = [c_bool() for _ in range(5)]
        done = self.one.call("UpdateDiscreteStates", *(byref(b) for b in flags), byref(c_double()))
        self.check("update", done, allowed)

    def completed(self) -> None:
        a, b = (c_int(), c_int()) if self.unit.version == "2.0" else (c_bool(), c_bool())
        done = self.one.call("CompletedIntegratorStep", True, byref(a), byref(b))
        self.check("completed", done, self.kind == "me" and self.mode == "continuous")

    def direction(self) -> None:
        unknowns, knowns = (self.random.choice(self.references, 2) for _ in range(2))
        head = (self.one.references(unknowns), 2, self.one.references(knowns), 2)
        if self.unit.version == "2.0":
            done = self.one.call("GetDirectionalDerivative", *head, (c_double * 2)(1.0, 2.0), (c_double * 2)())
        else:
            name = str(self.random.choice(["GetDirectionalDerivative", "GetAdjointDerivative"]))
            done = self.one.call(name, *head, (c_double * 2)(1.0, 2.0), 2, (c_double * 2)(), 2)
        self.check("direction", done, self.mode in READABLE, strict=False)

    def save(self) -> None:
        self.saved.append((self.one.save(), self.mode, self.t))

    def load(self) -> None:
        if not self.saved:
            self.check("load nothing", self.one.load(c_void_p()), False)
            return
        state, mode, t = self.saved[int(self.random.integers(len(self.saved)))]
        self.check("load", self.one.load(state), True)
        self.mode, self.t = mode, t

    def serialize(self) -> None:
        if self.saved:
            data = self.one.serialize(self.saved[-1][0])
            cut = len(data) - int(self.random.integers(0, 2)) * 9
            status, state = self.one.deserialize(data[:cut])
            if self.check("deserialize", status, cut == len(data)):
                self.check("drop", self.one.drop(state), True)

    def drop(self) -> None:
        if self.saved:
            self.check("drop", self.one.drop(self.saved.pop()[0]), True)

    def terminate(self) -> None:
        if self.check(
            "terminate", self.one.call("Terminate"), self.mode in READABLE - {"initialization", "terminated"}
        ):
            self.mode = "terminated"

    def reset(self) -> None:
        self.check("reset", self.one.call("Reset"), True)
        self.mode, self.t = "instantiated", 0.0

    def foreign(self) -> None:
        """A pointer to something else."""
        other = (c_size_t * 64)()
        function = self.unit.function("Reset")
        self.check("foreign", int(function(byref(other))), False)
        self.check("nobody", int(function(c_void_p())), False)

    def end(self) -> None:
        """Free everything."""
        while self.saved:
            self.drop()
        self.one.free()


COMMON = ("enter", "leave", "step", "continuous", "get", "set", "time", "update", "completed", "derivatives")


def main() -> None:
    """All sequences."""
    parser = argparse.ArgumentParser()
    parser.add_argument("path", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--sequences", type=int, default=1000)
    parser.add_argument("--calls", type=int, default=25)
    options = parser.parse_args()
    unit = export_unit.Unit(options.path, options.folder)
    names = [n for n, f in vars(Walk).items() if callable(f) and not n.startswith("_") and n not in ("check", "end")]
    random = np.random.default_rng(3)
    for _ in range(options.sequences):
        walk = Walk(unit, random)
        if random.random() < 0.7:
            walk.enter()
            walk.leave()
        for _ in range(options.calls):
            pool = COMMON if random.random() < 0.6 else names
            getattr(walk, str(random.choice(pool)))()
        walk.end()
        walk.one.messages.clear()


if __name__ == "__main__":
    main()
