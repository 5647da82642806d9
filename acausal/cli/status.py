"""A status line on standard error: what is being done, and for how long."""

from __future__ import annotations

import sys
import threading
import time
from types import TracebackType
from typing import Self, TextIO

PERIOD = 0.2
"""Seconds between two refreshes of the line."""


class Status:
    """Shows the present stage and its elapsed seconds until left; silent where no terminal is.

    Args:
        wanted: True shows it in any case (one line a stage where no terminal is), False never, None on a terminal.
        stream: where to; default standard error.
    """

    def __init__(self, wanted: bool | None = None, stream: TextIO | None = None) -> None:
        self._stream = sys.stderr if stream is None else stream
        self._terminal = self._stream.isatty()
        self._shown = self._terminal if wanted is None else wanted
        self._lock = threading.Lock()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None
        self._text = ""
        self._since = time.perf_counter()
        self._width = 0

    def stage(self, text: str) -> None:
        """Begin a stage; an empty text ends the last one."""
        if not text:
            self.clear()
            return
        with self._lock:
            self._text, self._since = text, time.perf_counter()
        if self._shown and not self._terminal:
            print(text, file=self._stream, flush=True)
        self._draw()

    def clear(self) -> None:
        """Take the line away before other text is printed."""
        with self._lock:
            self._text = ""
            self._write("")

    def __enter__(self) -> Self:
        if self._shown and self._terminal:
            self._thread = threading.Thread(target=self._refresh, daemon=True)
            self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stop.set()
        if self._thread is not None:
            self._thread.join()
        self.clear()

    def _refresh(self) -> None:
        while not self._stop.wait(PERIOD):
            self._draw()

    def _draw(self) -> None:
        with self._lock:
            if self._text:
                self._write(f"{self._text} ... {time.perf_counter() - self._since:.1f} s")

    def _write(self, line: str) -> None:
        if not (self._shown and self._terminal) or (not line and not self._width):
            return
        self._stream.write("\r" + line.ljust(self._width) + ("" if line else "\r"))
        self._stream.flush()
        self._width = len(line)
