"""Who called: for what is said at the user's own line."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from types import FrameType

PACKAGE = __name__.partition(".")[0]


def callers() -> Iterator[tuple[FrameType, str]]:
    """The function that asks, its caller, and so on, each with the name of its module."""
    frame: FrameType | None = sys._getframe(1)
    while frame is not None:
        yield frame, str(frame.f_globals.get("__name__", ""))
        frame = frame.f_back


def package_of(module: str) -> str:
    """The package at the top of a module's name."""
    return module.partition(".")[0]
