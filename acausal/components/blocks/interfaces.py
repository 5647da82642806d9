"""Bases of blocks, and the kinds of initialization that blocks with states share."""

from __future__ import annotations

from collections.abc import Sequence

from acausal import Component, DeclarationError, Equations, Expr, Input, Output, Parameter, der

INITIALIZATIONS = ("NoInit", "SteadyState", "InitialState", "InitialOutput")
"""Values of `initType`, as in Modelica.Blocks.Types.Init."""

BEGINNING = -1e300
"""A start time that always has been [s]."""


class SO(Component, partial=True):
    """One output `y`, no input.

    Source: Modelica.Blocks.Interfaces.SO.
    """

    y: Output = Output(doc="output signal")


class SignalSource(SO, partial=True):
    """A source with one output `y`, an offset and a time at which the signal begins.

    Source: Modelica.Blocks.Interfaces.SignalSource.
    """

    offset: Parameter = Parameter(0.0, doc="value added to the signal")
    startTime: Parameter = Parameter(0.0, unit="s", doc="time at which the signal begins")


class SISO(Component, partial=True):
    """One input `u`, one output `y`.

    Source: Modelica.Blocks.Interfaces.SISO.
    """

    u: Input = Input(doc="input signal")
    y: Output = Output(doc="output signal")


class SI2SO(Component, partial=True):
    """Two inputs `u1` and `u2`, one output `y`.

    Source: Modelica.Blocks.Interfaces.SI2SO.
    """

    u1: Input = Input(doc="first input signal")
    u2: Input = Input(doc="second input signal")
    y: Output = Output(doc="output signal")


class SignalIn(Component):
    """One element of a vector of inputs, ``block.u[i].u``.

    Source: Modelica.Blocks.Interfaces.RealVectorInput.
    """

    u: Input = Input(doc="input signal")


class SignalOut(Component):
    """One element of a vector of outputs, ``block.y[i].y``; the block that has it gives its equation.

    Source: Modelica.Blocks.Interfaces.RealVectorOutput.
    """

    y: Output = Output(doc="output signal")


def initialized(
    kind: str, states: Sequence[tuple[Expr, Expr | float]], output: tuple[Expr, Expr | float] | None = None
) -> Equations:
    """Initial equations of a block by its `initType`.

    Args:
        kind: ``NoInit``: start values are guesses, which hold where nothing else determines the states;
            ``SteadyState``: derivatives are zero; ``InitialState``: states have their start values;
            ``InitialOutput``: the output has its start value, all states but the last are steady.
        states: each state with its start value.
        output: the output with its start value.

    Raises:
        DeclarationError: another `kind`.
    """
    if kind not in INITIALIZATIONS:
        raise DeclarationError(f"initType={kind!r} is not one of {', '.join(INITIALIZATIONS)}")
    if kind == "SteadyState":
        for state, _ in states:
            yield der(state) == 0
    elif kind == "InitialState":
        for state, value in states:
            yield state == value
    elif kind == "InitialOutput" and output is not None:
        yield output[0] == output[1]
        for state, _ in states[:-1]:
            yield der(state) == 0
