"""What a running native solve hears from outside: Ctrl-C, a request to stop, and who wants to know how far it is.

The compiled code calls back about once a second; then Python handles its signals, and the solve ends if it is to.
"""

from __future__ import annotations

import ctypes
import sys
import threading
import time
from collections.abc import Callable, Generator, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any, TextIO

CALLBACK = ctypes.CFUNCTYPE(ctypes.c_int, ctypes.c_double)
"""From the time that the solve has reached to whether it is to end."""


@dataclass(eq=False)
class Stop:
    """A request to end the solves of some threads; set `asked`."""

    asked: bool = False


class Watch(threading.local):
    """Of each thread: the function that its solves call, and what it does.

    Attributes:
        callback: for the compiled code.
        show: told the time that is reached.
        stop: ends the solve when it is asked to.
    """

    def __init__(self) -> None:
        self.show: Callable[[float], None] | None = None
        self.stop: Stop | None = None
        self.shown_at = 0.0
        calls = self._calls()
        next(calls)
        # a suspended generator: a signal that arrives when it resumes is raised inside its `try`
        self.callback = CALLBACK(calls.send)

    def _calls(self) -> Generator[int, float, None]:
        end = 0
        while True:
            try:
                t = yield end
                if self.show is not None:
                    self.show(t)
                end = int(self.stop is not None and self.stop.asked)
            except KeyboardInterrupt:
                end = 1

    def reached(self, t: float) -> None:
        """What runs in Python is at time t; shown about once a second."""
        now = time.monotonic()
        if self.show is not None and now - self.shown_at >= 1.0:
            self.shown_at = now
            self.show(t)

    @contextmanager
    def stopping(self, stop: Stop) -> Iterator[None]:
        """Solves of this thread end when `stop` is asked to."""
        before, self.stop = self.stop, stop
        try:
            yield
        finally:
            self.stop = before

    @contextmanager
    def showing(self, t0: float, t1: float, stream: TextIO | None = None) -> Iterator[None]:
        """Write how far a solve from t0 to t1 is, from the first second on."""
        line = _Line(t0, t1, stream or sys.stderr)
        self.show, self.shown_at = line, time.monotonic()
        try:
            yield
        finally:
            self.show = None
            line.end()


class _Line:
    """Per cent done, on one line of a terminal, else one line each."""

    def __init__(self, t0: float, t1: float, stream: TextIO) -> None:
        self.t0, self.span, self.stream = t0, t1 - t0, stream
        self.terminal = stream.isatty()
        self.shown = False

    def __call__(self, t: float) -> None:
        done = f"{100 * (t - self.t0) / self.span:.1f} % simulated, t = {t:.6g} s"
        self.stream.write(f"\r{done.ljust(48)}" if self.terminal else f"{done}\n")
        self.stream.flush()
        self.shown = True

    def end(self) -> None:
        """End the line."""
        if self.shown and self.terminal:
            self.stream.write("\n")


watch: Any = Watch()
"""Of the present thread."""
