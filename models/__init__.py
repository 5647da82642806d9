"""Case studies built on the component libraries."""
