"""Writing a system as a functional mock-up unit."""
