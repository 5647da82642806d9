"""The compiler's passes: pure functions from one record to the next, between the flat model and the schedule."""
