"""Generated C: the same schedule as in JAX, for the native engine and for FMUs."""
