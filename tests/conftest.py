"""What all tests have in common."""

import gc
import os

import pytest

# Nearly every test compiles a model of its own and runs it for a moment.
os.environ.setdefault("ACAUSAL_CFLAGS", "-Og")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Of the cases of a test on the diffrax engine, whose programs take long to compile, all but one are slow ones."""
    seen: set[tuple[object, str]] = set()
    for item in items:
        if not isinstance(item, pytest.Function) or item.get_closest_marker("slow"):
            continue
        given = item.callspec.params.values() if hasattr(item, "callspec") else ()
        if not any(isinstance(value, str) and value == "diffrax" for value in given):
            continue
        test = item.path, item.originalname
        if test in seen:
            item.add_marker(pytest.mark.slow)
        seen.add(test)


def pytest_collection_finish() -> None:
    """What has been imported stays: a full collection, of which there are hundreds, need not look at it each time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(10_000, 10, 10)
