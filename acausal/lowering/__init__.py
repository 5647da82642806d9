"""From the schedule to pure JAX functions."""
