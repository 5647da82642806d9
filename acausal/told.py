"""Warnings of a run: given at once, or kept for what runs many and says each once."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_kept: ContextVar[list[str] | None] = ContextVar("_kept", default=None)


def tell(text: str, stacklevel: int = 1) -> None:
    """Warn of what a run has met, or keep it where `keeping` says so.

    Args:
        text: what to say.
        stacklevel: whose line it is: 1 is that of the caller.
    """
    kept = _kept.get()
    if kept is None:
        warnings.warn(text, stacklevel=stacklevel + 1)
    else:
        kept.append(text)


@contextmanager
def keeping() -> Iterator[list[str]]:
    """What is told in this thread meanwhile is not given as a warning, but gathered in this list."""
    kept: list[str] = []
    before = _kept.set(kept)
    try:
        yield kept
    finally:
        _kept.reset(before)
