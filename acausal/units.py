"""Unit check of equations."""

from __future__ import annotations

from .language.flat_model import FlatModel


def check_units(flat: FlatModel) -> None:
    """Check."""
    del flat
