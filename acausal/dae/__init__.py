"""Structural algorithms on integers: equations are row numbers, variables are column numbers.

Nothing here knows an expression, a unit or a component name: every function takes and returns integer arrays, so that
the bulk of the work runs in numpy and in `scipy.sparse.csgraph`, and a million equations take seconds. One algorithm,
one paper, one file. All of it is deterministic (lowest number first) and iterative (no recursion).

| module | question it answers | source |
|---|---|---|
| `incidence` | which columns does a row touch? | |
| `alias` | which variables are equal up to sign, or zero? | signed union-find |
| `matching` | which column is each row solved for? | Hopcroft & Karp 1973 |
| `dulmage_mendelsohn` | which part has too many equations, which too few? | Dulmage & Mendelsohn 1958 |
| `pantelides` | how often must each equation be differentiated? | Pantelides 1988 |
| `strong_components` | in which order are the blocks solved? | Tarjan 1972 |
| `tearing` | which unknowns of a block must be iterated? | Cellier & Elmqvist 1993 |
| `coloring` | which Jacobian columns can be evaluated together? | Curtis, Powell & Reid 1974 |
"""
