"""The examples in the docstrings of all components run and give what they say."""

from __future__ import annotations

import pytest

from acausal import Component

from .docstrings import CLASSES, example_of
from .test_library import named


@pytest.mark.parametrize("cls", CLASSES, ids=named)
def test_example_of_the_docstring(cls: type[Component]) -> None:
    example = example_of(cls)
    assert example.statements, f"{named(cls)} has no example"
    assert not example.failure, example.failure
