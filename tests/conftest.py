"""What all tests have in common."""

import os

# Nearly every test compiles a model of its own and runs it for a moment.
os.environ.setdefault("ACAUSAL_CFLAGS", "-Og")
