"""The command line: `acausal demo`, `acausal simulate`, `acausal report`."""

from .arguments import main as main
