"""Analysis of compiled systems: linearization, steady states, calibration, ensembles."""
