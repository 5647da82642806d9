"""The exceptions of acausal.

Every message says what is wrong, where (component, the user's source line) and what to try.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class AcausalError(Exception):
    """Base of all errors raised on purpose by this package."""


class DeclarationError(AcausalError, TypeError):
    """A class or an instance declares something that cannot be: unknown name, wrong type, partial class."""


class ConnectError(AcausalError):
    """Connectors that do not fit, or a connection that is not possible here."""


class UnitError(AcausalError):
    """The two sides of an equation, or two operands, have different units."""


class StructureError(AcausalError):
    """Equations and unknowns cannot be paired.

    Attributes:
        equations: text of the equations involved.
        unknowns: names of the unknowns involved.
        components: paths of the components involved.
    """

    def __init__(
        self,
        message: str,
        *,
        equations: Iterable[str] = (),
        unknowns: Iterable[str] = (),
        components: Iterable[str] = (),
    ) -> None:
        super().__init__(message)
        self.equations = tuple(equations)
        self.unknowns = tuple(unknowns)
        self.components = tuple(components)


class InitializationError(AcausalError):
    """No consistent initial values: contradicting, missing or not found."""


class SimulationError(AcausalError):
    """The run failed: time, equation and state are named."""


class UnknownNameError(AcausalError, KeyError):
    """A name that the model does not have."""

    def __str__(self) -> str:
        return str(self.args[0]) if self.args else ""


def nearest(name: str, known: Iterable[str], count: int = 3) -> str:
    """`` Did you mean ...?`` with the known names nearest to `name`, or an empty string."""
    names = list(known)
    found = [n for n in names if n.casefold() == name.casefold()][:count]
    found = found or difflib.get_close_matches(name, names, n=count, cutoff=0.5)
    return f" Did you mean {' or '.join(f'`{f}`' for f in found)}?" if found else ""
