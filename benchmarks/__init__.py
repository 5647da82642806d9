"""Timings of the package, side by side with what a user would pick instead."""
