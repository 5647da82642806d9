"""Analysis of compiled systems: linearization and steady states."""
