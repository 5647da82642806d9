"""Component libraries, one package or module a domain; names and signs follow the Modelica Standard Library 4.0.

`blocks`, `electrical`, `translational`, `rotational`, `thermal`, `planar`, `hydraulic` and `bondgraph` are imported by
name: ``from acausal.components import electrical``. All quantities are in SI units. Flow variables are positive into
the component.
"""
