"""Warnings of a run: given at the user's line, or kept for what runs many and says each once."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from .callers import PACKAGE, callers, package_of

_kept: ContextVar[list[str] | None] = ContextVar("_kept", default=None)
_BETWEEN = {PACKAGE, "jax", "jaxlib", "equinox", "diffrax", "optimistix", "contextlib", "concurrent", "threading"}
"""Packages whose functions may stand between the user's line and a warning."""


def tell(text: str) -> None:
    """Warn of what a run has met, or keep it where `keeping` says so."""
    kept = _kept.get()
    if kept is None:
        warnings.warn(text, stacklevel=users_level())
    else:
        kept.append(text)


def users_level() -> int:
    """The `stacklevel` of a warning that the caller gives at the user's line, or 1 where no user is on the stack."""
    for level, (_, module) in enumerate(callers()):
        if package_of(module) not in _BETWEEN:
            return level
    return 1


@contextmanager
def keeping() -> Iterator[list[str]]:
    """What is told in this thread meanwhile is not given as a warning, but gathered in this list."""
    kept: list[str] = []
    before = _kept.set(kept)
    try:
        yield kept
    finally:
        _kept.reset(before)
