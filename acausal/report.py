"""The compilation report, and explanations of numerical findings."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .language.flat_model import FlatModel
from .lowering.initial import ACCEPTED
from .lowering.left_open import left_open
from .passes.derivative_array import differentiation_index
from .passes.places import declared
from .passes.schedule import Schedule

if TYPE_CHECKING:
    from .system import System


@dataclass(frozen=True, slots=True)
class Report:
    """What the compiler found and did; prints as a table.

    Attributes:
        variables, equations: declared scalar variables, and equations including those of connections.
        aliases: variables eliminated as equal (or zero).
        unknowns: variables and equations that remain.
        structural_index: 0 = explicit ODE, 1 = algebraic unknowns, 2 and more = hidden constraints (Pryce 2001,
            counting once more only the equations that algebraic variables follow from).
        index: the differentiation index, up to which the structural one is an upper bound: it is lower where equations
            cancel in an unknown that seems to follow from them. That of a large system is the structural one.
        differentiated: equations that index reduction differentiated.
        states, algebraics, invariants: numbers of states, of algebraic unknowns of the solver, of retained constraints.
        state_names, torn: names of the states and of the algebraic unknowns.
        left_open, open_names: how many values of the start neither fixed starts nor initial equations determine, and
            the states among which guesses choose them.
        blocks: size of a block of simultaneous equations to how many there are.
        linear_systems: sizes of the linear systems solved inside the right-hand side.
        families: distinct kernels, and the number of groups they are evaluated in.
        levels: length of the longest chain of blocks.
        seconds: time of each pass [s].
    """

    model: str
    variables: int
    equations: int
    aliases: int
    unknowns: int
    structural_index: int
    index: int
    differentiated: int
    states: int
    algebraics: int
    invariants: int
    state_names: tuple[str, ...]
    torn: tuple[str, ...]
    left_open: int
    open_names: tuple[str, ...]
    blocks: dict[int, int]
    linear_systems: dict[int, int]
    families: int
    groups: int
    levels: int
    seconds: dict[str, float]

    def to_dict(self) -> dict[str, Any]:
        """As plain data."""
        return asdict(self)

    def __str__(self) -> str:
        blocks = ", ".join(f"{n} of size {size}" for size, n in self.blocks.items())
        linear = ", ".join(f"{n} of size {size}" for size, n in self.linear_systems.items()) or "none"
        count = f"{self.left_open} value{'' if self.left_open == 1 else 's'}"
        rows = [
            ("declared", f"{self.variables} variables, {self.equations} equations"),
            ("alias elimination", f"{self.aliases} eliminated, {self.unknowns} unknowns remain"),
            ("structural index", f"{self.structural_index} ({self.differentiated} equations differentiated)"),
            *([("index", f"{self.index}")] if self.index != self.structural_index else []),
            ("states", f"{self.states}: {_few(self.state_names)}"),
            ("algebraic unknowns", f"{self.algebraics}" + (f": {_few(self.torn)}" if self.torn else "")),
            ("invariants", f"{self.invariants}"),
            ("start", f"{count} by guesses, of: {_few(self.open_names)}" if self.left_open else "determined"),
            ("blocks", blocks),
            ("linear systems", linear),
            ("kernels", f"{self.families} in {self.groups} groups, {self.levels} levels"),
            ("seconds", ", ".join(f"{k} {v:.3g}" for k, v in self.seconds.items())),
        ]
        width = max(len(k) for k, _ in rows)
        return "\n".join([self.model, "-" * len(self.model), *(f"{k:<{width}}  {v}" for k, v in rows)])

    __repr__ = __str__


def _few(names: tuple[str, ...], n: int = 16) -> str:
    return ", ".join(names[:n]) + (f", ... ({len(names)})" if len(names) > n else "")


def make_report(system: System) -> Report:
    """Collect the figures of a compilation."""
    stages, low = system.stages, system.lowered
    schedule = stages.schedule
    linear = Counter(len(g.kernel.matrix) for g in schedule.groups for _ in range(g.size) if g.kernel.matrix)
    kernels = {id(g.kernel) for g in schedule.groups}
    open_count, open_states = left_open(system.initial)
    return Report(
        model=system.name,
        variables=stages.counts["variables"],
        equations=stages.counts["equations"],
        aliases=int((~stages.reduced.unknown).sum()),
        unknowns=int(stages.reduced.unknown.sum()),
        structural_index=stages.index.index,
        index=_index(system),
        differentiated=stages.index.n_differentiated,
        states=low.n_x,
        algebraics=low.n_w,
        invariants=low.n_g,
        state_names=system.states,
        torn=system.algebraics,
        left_open=open_count,
        open_names=tuple(system.states[i] for i in open_states.tolist()),
        blocks=dict(sorted(schedule.block_sizes.items())),
        linear_systems=dict(sorted(linear.items())),
        families=len(kernels),
        groups=len(schedule.groups),
        levels=max((g.level for g in schedule.groups), default=-1) + 1,
        seconds=dict(stages.seconds),
    )


def _index(system: System) -> int:
    """The differentiation index; it takes a moment, and is kept."""
    if "index" not in system.cache:
        stages = system.stages
        index = differentiation_index(stages.reduced, stages.index.index, system.program.generic)
        system.cache["index"] = index
    return system.cache["index"]


def explain_initial(
    system: System, x0: np.ndarray, w0: np.ndarray, p: np.ndarray, left: np.ndarray, t0: float,
    initial: Mapping[str, Any],
) -> str:  # fmt: skip
    """Why an initialization failed: the conditions that cannot be met, with their sources."""
    problem, flat, low = system.initial, system.stages.flat, system.lowered
    values = np.asarray(low.observe(t0, x0, w0, p))
    starts = np.asarray(system.program.starts(p, np))
    entries: list[tuple[float, str]] = []
    texts: list[str] = []
    texts += conditions_in_words(system.stages.schedule)
    given = _given(system, initial, values)
    at = {int(v): i for i, v in enumerate(low.schedule.states)}
    texts += [_fixed(flat, int(v), starts, values) for v in problem.targets if int(v) not in given]
    texts += [text for v, text in given.items() if v not in at]
    texts += [flat.equation_line(f, k) for f in problem.families for k in range(f.size)]
    if len(left):
        distances = [float(r) if np.isfinite(r) else np.inf for r in left]
        entries = sorted(zip(distances, texts, strict=False), key=lambda e: -e[0])
    lines = [f"Initialization of `{system.name}` found no consistent start."]
    shown = [e for e in entries if e[0] > ACCEPTED][:8]
    if shown:
        lines.append("Conditions that are not met (distance relative to the scale of the unknowns):")
        lines += [f"    {r:9.2e}  {t}" for r, t in shown]
    names = (*system.states, *system.algebraics)
    bad = [n for n, v in zip(names, np.concatenate([x0, w0]), strict=True) if not np.isfinite(v)]
    if bad:
        lines.append(f"Not finite at the start: {', '.join(bad[:8])}")
        cause = system.diagnose_nonfinite(t0, x0, w0, p)
        lines += [cause] if cause else []
    mask = problem.fixed.copy()
    mask[[at[v] for v in given if v in at]] = True
    fixed = [n for n, f in zip(system.states, mask, strict=True) if f]
    if fixed:
        held = [f"{n} = {v:.6g}" for n, v, f in zip(system.states, x0, mask, strict=True) if f]
        lines.append(f"Held exactly (fixed start values): {_few(tuple(held))}")
        lines += declared(flat, map(_owner, fixed))
    lines.append(
        f"Try: fewer `fixed=True` start values {'or names in `initial=` ' if initial else ''}where the conditions "
        "contradict each other, or better guesses (start values) for the variables named here."
    )
    return "\n".join(lines)


def _given(system: System, initial: Mapping[str, Any], values: np.ndarray) -> dict[int, str]:
    """Reduced variables that `initial` gives a value, in order, with what there is to say of each."""
    found: dict[int, str] = {}
    for v, wanted in system._overrides(initial, np).items():
        name = system.stages.flat.name(v)
        found[v] = f"`{name}` has the value {float(wanted):.6g} from simulate(initial={{...}}){_got(v, values)}"
    return found


def _got(v: int, values: np.ndarray) -> str:
    """What the other conditions make of a variable that has a value given, if that is finite."""
    finite = v < len(values) and np.isfinite(values[v])
    return f", but the other conditions give {values[v]:.6g}" if finite else ""


def _owner(name: str) -> str:
    """The component that a variable belongs to; the variable itself if that is the model."""
    return name.rpartition(".")[0] or name


def conditions_in_words(schedule: Schedule) -> list[str]:
    """What each residual of the algebraic unknowns says, and then each invariant, with sources."""
    flat = schedule.reduced.flat
    texts = [_determining(schedule, int(v)) for v in schedule.tears]
    return texts + [flat.equation_line(f, k) for f in schedule.invariants for k in range(f.size)]


def _determining(schedule: Schedule, v: int) -> str:
    """The equations of the block that an algebraic unknown is solved from, as far as they hold it."""
    flat = schedule.reduced.flat
    found: list[str] = []
    for family in schedule.reduced.families:
        for row in np.flatnonzero((family.var_rows == v).any(axis=1))[:2]:
            found.append(flat.equation_line(family, int(row)))
    lines = "".join(f"\n                   {text}" for text in found[:3])
    return f"the equations that determine `{flat.name(v)}`{':' if lines else ''}{lines}"


def _fixed(flat: FlatModel, v: int, starts: np.ndarray, values: np.ndarray) -> str:
    """A fixed start value that is an equation of the initialization."""
    wanted = f" {starts[v]:.6g}" if v < len(starts) and np.isfinite(starts[v]) else ""
    places = declared(flat, [_owner(flat.name(v))])
    place = f"  {places[0].strip()}" if places else ""
    return f"`{flat.name(v)}` has the fixed start value{wanted}{_got(v, values)}{place}"
