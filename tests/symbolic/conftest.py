"""Hypothesis without time limit for one example: the first one compiles."""

from hypothesis import settings

settings.register_profile("acausal", deadline=None)
settings.load_profile("acausal")
