"""The language: declarations, components, connectors, connections, and the instance tree they elaborate to."""
