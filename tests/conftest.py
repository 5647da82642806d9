"""What all tests have in common."""

import gc
import os

# Nearly every test compiles a model of its own and runs it for a moment.
os.environ.setdefault("ACAUSAL_CFLAGS", "-Og")


def pytest_collection_finish() -> None:
    """What has been imported stays: a full collection, of which there are hundreds, need not look at it each time."""
    gc.collect()
    gc.freeze()
    gc.set_threshold(10_000, 10, 10)
