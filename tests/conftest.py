"""What all tests have in common."""

import gc
import os

import pytest

# Nearly every test compiles a model of its own and runs it for a moment.
os.environ.setdefault("ACAUSAL_CFLAGS", "-Og")


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Marks the slow ones of the cases of a test.

    They are those that `slow_case` names, and of those on the diffrax engine, whose programs take long to compile, all
    but one.
    """
    seen: set[tuple[object, str]] = set()
    for item in items:
        if not isinstance(item, pytest.Function) or item.get_closest_marker("slow"):
            continue
        slow = {value for mark in item.iter_markers("slow_case") for value in mark.args}
        test = item.path, item.originalname
        if not slow.isdisjoint(given := _given(item)) or ("diffrax" in given and test in seen):
            item.add_marker(pytest.mark.slow)
        elif "diffrax" in given:
            seen.add(test)


def _given(item: pytest.Function) -> set[str | type]:
    """The strings and the classes that a case of a test is given."""
    values = item.callspec.params.values() if hasattr(item, "callspec") else ()
    return {value for value in values if isinstance(value, str | type)}


def pytest_collection_finish() -> None:
    """What has been imported stays: a full collection, of which there are hundreds, need not look at it each time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(10_000, 10, 10)
