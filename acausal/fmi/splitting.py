"""`split`: one acausal model as two participants, and what that costs."""

from __future__ import annotations

import itertools
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ..compiler import compile as compile_model
from ..errors import AcausalError, ConnectError, DeclarationError, StructureError
from ..language.component import Component
from ..language.instance import path_text
from ..system import System
from .cosimulation import CoSimulation
from .coupling import PowerBond
from .cutting import INSTANT, Cut, Halves, cut_model
from .participant import Floats
from .result import CoSimulationResult
from .system_participant import PolynomialInput, SystemParticipant

if TYPE_CHECKING:
    from .fmu_participant import FmuParticipant

Side = Literal["near", "far"]


@dataclass(frozen=True, eq=False)
class Split:
    """A model in two halves.

    Attributes:
        model: the whole.
        near: the compiled side that owns the cut connectors.
        far: the other side.
        names: of the two participants, near and far.
        potential_to: by cut, the side that is given the potential and returns the flow.
        connections: (output, input) pairs by ``participant.signal``.
        bonds: the power bonds of the cuts.
        polynomials: by side, the inputs that arrive with their derivatives.
    """

    model: Component
    near: System
    far: System
    names: tuple[str, str]
    potential_to: Mapping[str, Side]
    connections: tuple[tuple[str, str], ...]
    bonds: tuple[PowerBond, ...]
    polynomials: Mapping[Side, tuple[PolynomialInput, ...]] = field(repr=False)

    def _sides(self) -> tuple[tuple[Side, str, System], tuple[Side, str, System]]:
        return ("near", self.names[0], self.near), ("far", self.names[1], self.far)

    def participant(self, side: Side, *, outputs: Sequence[str] = (), **options: Any) -> SystemParticipant:
        """One side as a participant; `outputs` are recorded too, `options` are those of `SystemParticipant`."""
        system, name = (self.near, self.names[0]) if side == "near" else (self.far, self.names[1])
        return SystemParticipant(system, outputs=outputs, polynomials=self.polynomials[side], name=name, **options)

    def cosimulation(
        self,
        *,
        record: Sequence[str] = (),
        solver: Any = None,
        dt: float | None = None,
        rtol: float = 1e-6,
        participants: Mapping[str, Any] | None = None,
        **options: Any,
    ) -> CoSimulation:
        """A master for the two sides.

        Args:
            record: names of variables of the whole model to record.
            solver: inside both participants, as in `SystemParticipant`.
            dt: step of a solver of fixed step [s].
            rtol: relative tolerance inside.
            participants: by name, others in the place of the two sides, with the same inputs and outputs.
            **options: of `CoSimulation`.
        """
        given = dict(participants or {})
        made: dict[str, Any] = {}
        for side, name, system in self._sides():
            known = set(system.stages.flat.names.all_variables)
            wanted = [n for n in record if n in known]
            made[name] = given.get(name) or self.participant(side, outputs=wanted, solver=solver, dt=dt, rtol=rtol)
        return CoSimulation(made, self.connections, bonds=self.bonds, **options)

    def fmus(
        self,
        folder: str | os.PathLike[str],
        *,
        version: str = "2.0",
        outputs: Sequence[str] = (),
        parameters: Mapping[str, float] | None = None,
        solver: str = "rodas5p",
        dt: float | None = None,
    ) -> dict[str, FmuParticipant]:
        """Both sides exported as functional mock-up units and loaded, for `cosimulation(participants=...)`.

        Args:
            folder: where they are written.
            version: of FMI. Units of 2.0 take the slopes of inputs along, those of 3.0 the means over a step.
            outputs: names of variables of the whole model to give out.
            parameters: values by name of the whole model.
            solver: inside the units, as of `export`.
            dt: step of ``"rk4"`` [s].
        """
        from .exporter.export import export
        from .fmu import load

        made: dict[str, FmuParticipant] = {}
        for side, name, system in self._sides():
            known = set(system.stages.flat.names.all_variables)
            path = export(system, Path(folder) / f"{name}.fmu", version=version, kind="cs", solver=solver, dt=dt)
            made[name] = load(path).participant(
                outputs=[n for n in outputs if n in known],
                parameters={k: v for k, v in (parameters or {}).items() if k in system.parameters},
                needs={q.name: q.needs for q in self.polynomials[side]},
                name=name,
            )
        return made

    @cached_property
    def whole(self) -> System:
        """The model compiled as one."""
        return compile_model(self.model)

    def cost(self, t1: float, *, record: Sequence[str] = (), rtol: float = 1e-6, **options: Any) -> SplitCost:
        """What the split costs: co-simulation beside the model in one piece.

        Args:
            t1: end time [s].
            record: variables to compare; default the exchanged potentials.
            rtol: relative tolerance of all solvers.
            **options: of `CoSimulation` (`step`, `method`, `order`, `tolerance`, ...).
        """
        given = list(self.potential_to)
        names = list(record) or given
        with self.cosimulation(record=names, rtol=rtol, **options) as master:
            master.simulate(min(t1, 2 * master.step))  # compiles
            result = master.simulate(t1)
        self.whole.simulate(t1, saveat=[t1], rtol=rtol)
        begin = time.perf_counter()
        whole = self.whole.simulate(t1, saveat=result.t, rtol=rtol)
        seconds = time.perf_counter() - begin
        rows: dict[str, tuple[float, float]] = {}
        for name in names:
            exact = np.asarray(whole[name])
            found = result[name if record else name.replace(".", "_")]
            rows[name] = (_rms(result.t, found - exact), float(np.ptp(exact)))
        return SplitCost(rows, result, seconds, t1)

    def __repr__(self) -> str:
        given = ", ".join(f"{k} to {self.names[0 if v == 'near' else 1]}" for k, v in self.potential_to.items())
        return f"<Split of {type(self.model).__name__}: {self.names[0]} | {self.names[1]}; potential {given}>"


def _rms(t: Floats, deviation: Floats) -> float:
    return float(np.sqrt(np.trapezoid(deviation**2, t) / (t[-1] - t[0])))


@dataclass(frozen=True, eq=False)
class SplitCost:
    """What a split costs.

    Attributes:
        deviation: by variable, root mean square deviation from the model in one piece, and the range of its values.
        result: the co-simulation.
        seconds_whole: run time of the model in one piece [s].
        t1: simulated time [s].
    """

    deviation: Mapping[str, tuple[float, float]]
    result: CoSimulationResult
    seconds_whole: float
    t1: float

    def __str__(self) -> str:
        stats = self.result.stats
        lines = [
            f"co-simulation: {stats['macro_steps']} macro steps, {stats['run_seconds']:.3f} s (RTF "
            f"{stats['real_time_factor']:.2g}); in one piece: {self.seconds_whole:.3f} s "
            f"(RTF {self.seconds_whole / self.t1:.2g})",
            f"energy made by the coupling: at most {self.result.energy_residual:.3g} J",
        ]
        lines += [f"  {n}: rms deviation {d:.3g} of a range of {r:.3g}" for n, (d, r) in self.deviation.items()]
        return "\n".join(lines)


def split(
    model: Component,
    at: str | Sequence[str],
    *,
    potential_to: Side | Mapping[str, Side] | None = None,
    names: tuple[str, str] | None = None,
) -> Split:
    """Cut a model at a connector of one of its parts: one side is given the potential and returns the flow, the other
    the other way round.

    ``ac.fmi.split(crane, at="boom.flange").cost(t1=20.0, step=0.01)`` says what the split costs.

    Args:
        model: an instance of a component class.
        at: path ``part.connector``, or several; the *near* side is the one that owns them.
        potential_to: the side that is given the potential, for all cuts or by path. By default the causality of the
            lowest structural index of both sides, and of those the one where the fewest derivatives are imposed.
        names: of the two participants; by default the part's name and ``rest``.

    Returns:
        the two sides, compiled, with all that a co-simulation of them needs.

    Raises:
        DeclarationError: no instance of a component class, or a path that is no connector.
        StructureError: the two sides hang together in another way, or neither causality can be compiled.

    A potential that a side must differentiate (the position of a mass) is imposed as a polynomial in time, so that
    velocity and acceleration come with it.
    """
    if not isinstance(model, Component):
        what = f"the class `{model.__name__}`: call it" if isinstance(model, type) else type(model).__name__
        raise DeclarationError(f"split takes an instance of a Component class, not {what}")
    paths = [at] if isinstance(at, str) else list(at)
    halves = cut_model(model, paths)
    choices = _choices(halves.cuts, potential_to)
    found: list[tuple[tuple[int, ...], dict[Any, Side], tuple[System, System]]] = []
    failures: list[str] = []
    for number, choice in enumerate(choices):
        try:
            near = compile_model(halves.side(True, {p: s == "far" for p, s in choice.items()}))
            far = compile_model(halves.side(False, {p: s == "near" for p, s in choice.items()}))
        except AcausalError as error:
            failures.append(f"{_described(choice)}: {error}")
            continue
        index = sum(s.stages.index.index for s in (near, far))
        needs = sum(_needs(near if s == "near" else far, c, p) for c in halves.cuts for p in c.potentials
                    for s in (choice[c.path],))  # fmt: skip
        found.append(((index, needs, number), choice, (near, far)))
    if not found:
        listed = "\n  ".join(failures)
        raise StructureError(f"neither causality of the split at {', '.join(paths)} can be compiled:\n  {listed}")
    _, choice, (near, far) = min(found, key=lambda item: item[0])
    given = names or (str(halves.cuts[0].path[0]), "rest")
    if len(set(given)) != 2 or any("." in n for n in given):
        raise ConnectError(f"names={given!r}: two different names without dots")
    return _assembled(halves, near, far, choice, given)


def _choices(cuts: Sequence[Cut], wanted: Side | Mapping[str, Side] | None) -> list[dict[Any, Side]]:
    sides: tuple[Side, Side] = ("far", "near")
    if wanted is None:
        return [
            dict(zip([c.path for c in cuts], combination, strict=True))
            for combination in itertools.product(sides, repeat=len(cuts))
        ]
    by_path: dict[str, Side]
    by_path = {path_text(c.path): wanted for c in cuts} if isinstance(wanted, str) else dict(wanted)
    missing = [path_text(c.path) for c in cuts if by_path.get(path_text(c.path)) not in sides]
    if missing:
        raise ConnectError(f"potential_to must say 'near' or 'far' for {', '.join(missing)}")
    return [{c.path: by_path[path_text(c.path)] for c in cuts}]


def _described(choice: Mapping[Any, Side]) -> str:
    return ", ".join(f"potential of {path_text(p)} to the {s} side" for p, s in choice.items())


def _needs(system: System, cut: Cut, potential: str) -> int:
    """Derivatives of an imposed potential that a side's equations use."""
    ids = system.index_of(f"{cut.prefix}_boundary.port.{potential}")
    index = int(np.ravel(ids)[0])
    order = 0
    index = int(system.observed_ids[0][index])
    while order < 2:
        following = int(system.stages.index.derivative_of[index])
        if following < 0:
            break
        index, order = int(system.observed_ids[0][following]), order + 1
    return order


def _assembled(halves: Halves, near: System, far: System, choice: Mapping[Any, Side], names: tuple[str, str]) -> Split:
    connections: list[tuple[str, str]] = []
    bonds: list[PowerBond] = []
    polynomials: dict[Side, list[PolynomialInput]] = {"near": [], "far": []}
    for cut in halves.cuts:
        to = choice[cut.path]
        taker, giver = (names[0], names[1]) if to == "near" else (names[1], names[0])
        for potential, flow in zip(cut.potentials, cut.flows, strict=True):
            pair = f".{cut.field(potential)}", f".{cut.field(flow)}"
            connections += [(giver + pair[0], taker + pair[0]), (taker + pair[1], giver + pair[1])]
            text = path_text(cut.path) + ("" if len(cut.flows) == 1 else f".{flow}")
            bonds.append(PowerBond(taker + pair[0], giver + pair[1], cut.derivative, text))
            needs = _needs(near if to == "near" else far, cut, potential)
            coefficients = cut.coefficients(potential)
            # power of a mechanical bond takes the velocity, whether the equations do or not
            needs = max(needs, 1) if cut.derivative else needs
            polynomials[to].append(PolynomialInput(coefficients[0], coefficients, INSTANT, needs))
    by_name: dict[str, Side] = {f"{path_text(c.path)}.{c.potentials[0]}": choice[c.path] for c in halves.cuts}
    return Split(
        halves.model, near, far, names, by_name, tuple(connections), tuple(bonds),
        {k: tuple(v) for k, v in polynomials.items()},
    )  # fmt: skip
