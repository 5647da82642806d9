"""Who feeds whom: connections between participants, power bonds, the equations that hold at communication points."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ..errors import ConnectError, UnknownNameError, nearest
from .participant import CoSimulationError, Floats, Participant, constant

ITERATIONS = 30
CONVERGED = 1e-10
"""Relative change at which the interface of an algebraic loop counts as solved."""
_PERTURBATION = 1e-6


@dataclass(frozen=True)
class Coupling:
    """One connection: output `output` of participant `source` feeds input `input` of participant `target`.

    Attributes:
        known: derivatives that are exchanged with the value.
        place: first entry of the connection in the interface vector.
    """

    source: int
    output: int
    target: int
    input: int
    known: int
    place: int
    name: str


@dataclass(frozen=True)
class PowerBond:
    """Two connections that carry the power of one connector: a potential one way, a flow the other.

    Attributes:
        potential: input that receives the potential, ``participant.input``.
        flow: input that receives the flow.
        derivative: whether power is flow times the potential's derivative (positions, angles) or the potential itself.
        name: of the connector.
    """

    potential: str
    flow: str
    derivative: bool
    name: str


def couple(participants: Mapping[str, Participant], connections: Iterable[tuple[str, str]]) -> list[Coupling]:
    """Connections by name as couplings; asks the sources for the derivatives that the targets need.

    Args:
        participants: by name.
        connections: pairs (``participant.output``, ``participant.input``).

    Raises:
        UnknownNameError: a participant, output or input that is not there.
        ConnectError: an input that is fed twice, or a source that cannot give the derivatives that are needed.
    """
    names = list(participants)
    made: list[Coupling] = []
    place = 0
    fed: dict[tuple[int, int], str] = {}
    for source_text, target_text in connections:
        source, output = locate(participants, source_text, "output")
        target, input_ = locate(participants, target_text, "input")
        if (target, input_) in fed:
            raise ConnectError(f"`{target_text}` is fed by `{fed[target, input_]}` and by `{source_text}`")
        fed[target, input_] = source_text
        giver, taker = participants[names[source]], participants[names[target]]
        known = min(taker.needs[taker.inputs[input_]], 2)
        if known and not giver.require(giver.outputs[output], known):
            raise ConnectError(
                f"`{target_text}` needs {known} time derivatives of its signal, and `{source_text}` does not give "
                "them: split at another connector, or turn the causality round"
            )
        made.append(Coupling(source, output, target, input_, known, place, f"{source_text} -> {target_text}"))
        place += known + 1
    return made


def locate(participants: Mapping[str, Participant], text: str, what: str) -> tuple[int, int]:
    """Numbers of participant and of its output or input.

    Raises:
        UnknownNameError: with the nearest names.
    """
    head, _, tail = text.partition(".")
    names = list(participants)
    if head not in participants:
        raise UnknownNameError(f"`{text}`: there is no participant `{head}`.{nearest(head, names)}")
    known = participants[head].outputs if what == "output" else participants[head].inputs
    if tail not in known:
        listed = nearest(tail, known) or f" It has: {', '.join(known) or 'none'}."
        raise UnknownNameError(f"participant `{head}` has no {what} `{tail}`.{listed}")
    return names.index(head), known.index(tail)


class Interface:
    """The equations between participants at a communication point: every connected input equals its output.

    The interface vector z (n_z,) holds the value and the exchanged derivatives of each connection. Without algebraic
    loop, participants are evaluated once, in order of dependence. With one, ``z = G(z)`` is solved by Newton's method
    with the interface Jacobian, which is found by differences and kept, with Broyden's update (Kuebler and Schiehlen
    2000, Math. Comput. Model. Dyn. Syst. 6(2), 93-113).
    """

    def __init__(
        self, participants: Sequence[Participant], names: Sequence[str], couplings: Sequence[Coupling]
    ) -> None:
        self.parts, self.names, self.couplings = participants, names, couplings
        self.size = sum(c.known + 1 for c in couplings)
        self.order: list[int] | None = None
        self.jacobian: Floats | None = None
        self.loop = False
        self.evaluations = 0

    def feed(self, part: int, z: Floats, coefficients: Floats) -> Floats:
        """Input polynomials of a participant with the interface's values and derivatives in place."""
        fed = coefficients.copy()
        for c in self.couplings:
            if c.target == part:
                fed[c.input] = 0.0
                fed[c.input, : c.known + 1] = (
                    z[c.place : c.place + c.known + 1] / np.array([1.0, 1.0, 2.0])[: c.known + 1]
                )
        return fed

    def read(self, part: int, values: Floats, z: Floats) -> None:
        """Write a participant's outputs into the interface vector."""
        for c in self.couplings:
            if c.source == part:
                z[c.place : c.place + c.known + 1] = values[: c.known + 1, c.output]

    def evaluate(self, part: int, t: float, z: Floats, free: Sequence[Floats]) -> Floats:
        """Outputs of one participant (3, n_y) under the inputs of z; `free` holds the polynomials of other inputs."""
        self.evaluations += 1
        return self.parts[part].evaluate(t, self.feed(part, z, free[part]))

    def sweep(self, t: float, z: Floats, free: Sequence[Floats]) -> tuple[Floats, list[Floats]]:
        """All participants under the inputs of z: what the outputs make of it, G(z), and the outputs."""
        made = z.copy()
        values = [self.evaluate(i, t, z, free) for i in range(len(self.parts))]
        for i, v in enumerate(values):
            self.read(i, v, made)
        return made, values

    def probe(self, t: float, z: Floats, free: Sequence[Floats]) -> None:
        """Find the interface Jacobian dG/dz, the order of evaluation and whether there is an algebraic loop."""
        base, _ = self.sweep(t, z, free)
        jacobian = np.zeros((self.size, self.size))
        for c in self.couplings:
            if not self.parts[c.target].feedthrough and not self._gives_rates(c.target):
                continue
            for k in range(c.place, c.place + c.known + 1):
                step = _PERTURBATION * max(abs(z[k]), abs(base[k]), 1.0)
                moved = z.copy()
                moved[k] += step
                values = self.evaluate(c.target, t, moved, free)
                made = base.copy()
                self.read(c.target, values, made)
                jacobian[:, k] = (made - base) / step
        self.jacobian = np.nan_to_num(jacobian)
        self._sort()

    def _gives_rates(self, part: int) -> bool:
        return any(c.source == part and c.known for c in self.couplings)

    def _sort(self) -> None:
        """Order of participants such that what one needs at the same instant comes before it."""
        assert self.jacobian is not None
        owner = np.zeros(self.size, int)
        fed = np.zeros(self.size, int)
        for c in self.couplings:
            owner[c.place : c.place + c.known + 1] = c.source
            fed[c.place : c.place + c.known + 1] = c.target
        rows, columns = np.nonzero(self.jacobian)
        needs: dict[int, set[int]] = {i: set() for i in range(len(self.parts))}
        for row, column in zip(rows.tolist(), columns.tolist(), strict=True):
            needs[int(owner[row])].add(int(owner[column]))
        order: list[int] = []
        while len(order) < len(self.parts):
            ready = [i for i in needs if i not in order and needs[i] <= set(order)]
            if not ready:
                self.loop = True
                break
            order.append(ready[0])
        # outputs that nobody is fed with may still depend on inputs: those participants come last
        self.order = None if self.loop else order

    def resolve(self, t: float, z: Floats, free: Sequence[Floats]) -> tuple[Floats, list[Floats]]:
        """The interface vector that satisfies all connections at time t, from a guess, and the outputs (3, n_y).

        Raises:
            CoSimulationError: the iteration of an algebraic loop does not converge.
        """
        if self.jacobian is None:
            self.probe(t, z, free)
        if self.order is not None:
            z = z.copy()
            values: list[Floats] = [np.zeros((3, 0))] * len(self.parts)
            for part in self.order:
                values[part] = self.evaluate(part, t, z, free)
                self.read(part, values[part], z)
            return z, values
        return self._newton(t, z, free)

    def _newton(self, t: float, z: Floats, free: Sequence[Floats]) -> tuple[Floats, list[Floats]]:
        assert self.jacobian is not None
        z = np.nan_to_num(z)
        residual = np.zeros(self.size)
        for _ in range(ITERATIONS):
            made, values = self.sweep(t, z, free)
            residual = made - z
            if np.all(np.abs(residual) <= CONVERGED * (1.0 + np.abs(made))):
                return made, values
            if not np.isfinite(residual).all():
                break
            step = np.linalg.solve(np.eye(self.size) - self.jacobian, residual)
            following = z + step
            again, _ = self.sweep(t, following, free)
            change = (again - made) - self.jacobian @ step
            self.jacobian = self.jacobian + np.outer(change, step) / max(float(step @ step), 1e-300)
            z = following
        worst = self.couplings[self._coupling_of(int(np.nanargmax(np.abs(residual))))]
        raise CoSimulationError(
            f"the algebraic loop between the participants does not converge at t = {t:.6g} s; worst: {worst.name}. "
            "Split at a connector where one side stores energy, or turn the causality round."
        )

    def _coupling_of(self, entry: int) -> int:
        return max(i for i, c in enumerate(self.couplings) if c.place <= entry)


def free_polynomials(parts: Sequence[Participant]) -> list[Floats]:
    """Polynomials for all inputs of all participants: constant at their start values."""
    return [constant([p.start(n) for n in p.inputs]) for p in parts]
