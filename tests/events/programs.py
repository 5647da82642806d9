"""Random hybrid programs, as models and as an interpreter of Modelica's events written by hand.

A program has states x with piecewise constant rates, numbers n that `when` assigns, and booleans b that follow from
conditions. As the states are piecewise linear, the interpreter knows all events in closed form. It follows the Modelica
Language Specification 3.6, 8.3.5, 8.6 and appendix B: relations are held between events; at an event all equations are
solved with the left limits, then values become left limits, until nothing changes.

Expressions are tuples, with the kind in front: see `condition`, `number` and `Interpreter`.
"""

from __future__ import annotations

import math
import random
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

import acausal as ac
from acausal import Component, Discrete, Equations, Variable, der, pre, reinit, when, where

END = 3.0
COMPARE: dict[str, Callable[[Any, Any], Any]] = {
    ">": lambda a, b: a > b, "<": lambda a, b: a < b, ">=": lambda a, b: a >= b, "<=": lambda a, b: a <= b,
}  # fmt: skip


class Undecided(Exception):
    """Rounding decides what the program does."""


class Endless(Exception):
    """Its events do not come to an end."""


@dataclass
class Program:
    """What a program consists of.

    Attributes:
        x, n: values at the start; the booleans are false before it.
        booleans: how many there are.
        assigned: in the order in which they may depend on each other: ``("n", k, [(condition, value), ...])`` for a
            `when` with its `elsewhen`, or ``("b", k, condition)``.
        reinits: ``(condition, k, value)``.
        rates: for each state a constant and terms.
    """

    x: list[float]
    n: list[float]
    booleans: int
    assigned: list[tuple[str, int, Any]] = field(default_factory=list[Any])
    reinits: list[tuple[Any, int, Any]] = field(default_factory=list[Any])
    rates: list[tuple[float, list[Any]]] = field(default_factory=list[Any])

    def expressions(self) -> Iterator[Any]:
        """All expressions, those within others included."""
        waiting: list[Any] = [self.assigned, self.reinits, self.rates]
        while waiting:
            one = waiting.pop()
            if isinstance(one, tuple | list):
                waiting.extend(one)
                yield one


class Writer:
    """Writes a random program."""

    def __init__(self, seed: int) -> None:
        self.random = r = random.Random(seed)
        self.program = p = Program(
            [self.between(-1.0, 1.0) for _ in range(r.randint(1, 3))],
            [r.randint(0, 2) for _ in range(r.randint(1, 3))], r.randint(0, 2),
        )  # fmt: skip
        self.n: list[int] = []
        self.b: list[int] = []
        places = [*(("n", k) for k in range(len(p.n))), *(("b", k) for k in range(p.booleans))]
        r.shuffle(places)
        for kind, k in places:
            if kind == "n":
                branches = [(self.trigger(), self.value(k)) for _ in range(r.choice([1, 1, 2]))]
                p.assigned.append(("n", k, branches))
                self.n.append(k)
            else:
                p.assigned.append(("b", k, self.condition(2)))
                self.b.append(k)
        for k in range(len(p.x)):
            if r.random() < 0.6:
                how = [("number", self.between(-1.0, 1.0)), ("back", k, self.between(0.5, 1.5)),
                       ("bounce", k, self.between(0.3, 1.0))]  # fmt: skip
                p.reinits.append((self.trigger(), k, r.choice(how)))
            p.rates.append((self.between(-1.0, 1.0), list(self.terms())))

    def between(self, low: float, high: float) -> float:
        return round(self.random.uniform(low, high), 3)

    def terms(self) -> Iterator[Any]:
        r = self.random
        if r.random() < 0.6:
            yield "times", self.between(-0.8, 0.8), ("n", r.randrange(len(self.program.n)))
        if r.random() < 0.3:
            yield "times", self.between(-0.3, 0.3), self.floor()
        if r.random() < 0.7:
            yield "where", self.condition(1), self.between(-1.0, 1.0), self.between(-1.0, 1.0)

    def floor(self) -> Any:
        return "floor", self.random.randrange(len(self.program.x)), self.between(0.2, 0.9)

    def relation(self) -> Any:
        r, p = self.random, self.program
        kinds = ["x", "x", "x", "time", "pre n", *(["n"] if self.n else []), *(["b", "b"] if self.b else []),
                 *(["pre b"] if p.booleans else [])]  # fmt: skip
        return {
            "x": lambda: ("x", r.randrange(len(p.x)), self.between(-1.2, 1.2), r.choice(list(COMPARE))),
            "time": lambda: ("time", self.between(0.05, END)),
            "n": lambda: ("n >", r.choice(self.n), r.randint(0, 2) + 0.5),
            "pre n": lambda: ("pre n >", r.randrange(len(p.n)), r.randint(0, 2) + 0.5),
            "b": lambda: ("b", r.choice(self.b)),
            "pre b": lambda: ("pre b", r.randrange(p.booleans)),
        }[r.choice(kinds)]()

    def condition(self, depth: int) -> Any:
        r = self.random
        kind = "relation" if depth == 0 or r.random() < 0.4 else r.choice(["and", "or", "not"])
        if kind == "relation":
            return self.relation()
        return kind, *(self.condition(depth - 1) for _ in range(1 if kind == "not" else 2))

    def trigger(self) -> list[Any]:
        """Conditions of a `when`, each of which triggers it."""
        r, chance = self.random, self.random.random()
        if chance < 0.2:
            return [("sample", self.between(-0.3, 0.5), self.between(0.15, 1.0))]
        if chance < 0.3 and self.b:
            return [("edge", r.choice(self.b))]
        if chance < 0.4 and self.n:
            return [("change", r.choice(self.n))]
        if chance < 0.45:
            return [("initial",), self.condition(1)]
        return [self.condition(1), self.condition(1)] if chance < 0.5 else [self.condition(2)]

    def value(self, k: int) -> Any:
        r, p = self.random, self.program
        chance = r.random()
        if chance < 0.5:
            return "count", k, r.randint(1, 3)
        if chance < 0.7 and self.n:
            return "n", r.choice(self.n)
        if chance < 0.8:
            return "pre n", r.randrange(len(p.n))
        return self.floor() if chance < 0.9 else ("x", r.randrange(len(p.x)))


# ---- as a model ---------------------------------------------------------------------------------
def model(program: Program) -> Component:
    """The program as a model with the variables x0, x1, ..., n0, ..., b0, ..."""
    fields: dict[str, Any] = {f"x{k}": Variable(start=v, fixed=True) for k, v in enumerate(program.x)}
    fields |= {f"n{k}": Discrete(start=v) for k, v in enumerate(program.n)}
    fields |= {f"b{k}": Discrete(start=0) for k in range(program.booleans)}

    def equations(self: Any) -> Equations:
        for kind, k, how in program.assigned:
            if kind == "b":
                yield getattr(self, f"b{k}") == condition(self, how)
                continue
            target = getattr(self, f"n{k}")
            (first, value), *others = how
            clause = when([condition(self, c) for c in first], {target: number(self, value)})
            for trigger, other in others:
                clause = clause.elsewhen([condition(self, c) for c in trigger], {target: number(self, other)})
            yield clause
        for trigger, k, value in program.reinits:
            yield when([condition(self, c) for c in trigger], reinit(getattr(self, f"x{k}"), number(self, value)))
        for k, (rate, terms) in enumerate(program.rates):
            yield der(getattr(self, f"x{k}")) == sum((number(self, term) for term in terms), rate)

    annotations = {name: type(value) for name, value in fields.items()}
    return type("Random", (Component,), {**fields, "equations": equations, "__annotations__": annotations})()


def condition(m: Any, e: Any) -> Any:
    """A condition in the language."""
    kind, *rest = e
    of: Callable[[str], Any] = lambda name: getattr(m, f"{name}{rest[0]}")  # noqa: E731
    return {
        "x": lambda: COMPARE[rest[2]](of("x"), rest[1]),
        "time": lambda: ac.time >= rest[0],
        "n >": lambda: of("n") > rest[1],
        "pre n >": lambda: pre(of("n")) > rest[1],
        "b": lambda: of("b") > 0.5,
        "pre b": lambda: pre(of("b")) > 0.5,
        "and": lambda: condition(m, rest[0]) & condition(m, rest[1]),
        "or": lambda: condition(m, rest[0]) | condition(m, rest[1]),
        "not": lambda: ~condition(m, rest[0]),
        "sample": lambda: ac.sample(*rest),
        "edge": lambda: ac.edge(of("b")),
        "change": lambda: ac.change(of("n")),
        "initial": ac.initial,
    }[kind]()


def number(m: Any, e: Any) -> Any:
    """A number in the language."""
    kind, *rest = e
    of: Callable[[str], Any] = lambda name: getattr(m, f"{name}{rest[0]}")  # noqa: E731
    return {
        "number": lambda: rest[0],
        "x": lambda: of("x"),
        "n": lambda: of("n"),
        "pre n": lambda: pre(of("n")),
        "count": lambda: where(pre(of("n")) > rest[1] - 0.5, 0, pre(of("n")) + 1),
        "floor": lambda: ac.floor(of("x") / rest[1]),
        "back": lambda: pre(of("x")) - rest[1],
        "bounce": lambda: -rest[1] * pre(of("x")),
        "times": lambda: rest[0] * number(m, rest[1]),
        "where": lambda: where(condition(m, rest[0]), rest[1], rest[2]),
    }[kind]()


# ---- by hand ------------------------------------------------------------------------------------
ROUNDING, APART = 1e-9, 1e-6
"""Events nearer than the first are at the same time by the program; those that are not, but nearer than the second, may
be so by rounding."""
Corner = tuple[float, list[float], list[float], list[int]]


class Interpreter:
    """Runs a program.

    Attributes:
        t, x, n, b: where it is; `pre_n`, `pre_b` and `pre_x` are left limits.
        held: truth of the relations, and values of the steps of `floor`.
        true: which conditions of `when` were true in the last turn.
        corners: ``(t, x, n, b)`` on both sides of each event, and at the end.
    """

    def __init__(self, program: Program) -> None:
        self.program = program
        everything = [e for e in program.expressions() if e and isinstance(e[0], str)]
        self.relations = sorted({e for e in everything if len(e) == 4 and e[0] == "x"} | _of("time", everything))
        self.floors, self.clocks = sorted(_of("floor", everything)), sorted(_of("sample", everything))
        self.t = 0.0
        self.x, self.n, self.b = list(program.x), list(program.n), [0] * program.booleans
        self.sampled: set[Any] = set()
        self.held: dict[Any, Any] = {}
        self.true: set[Any] = set()
        self.beginning = False
        self.corners: list[Corner] = []

    def run(self) -> list[Corner]:
        """To the end.

        Raises:
            Endless, Undecided: there is no result to compare with.
        """
        self._look(range(len(self.x)))
        self._settle(beginning=True)
        due = {c for c in self.clocks if c[1] <= 0.0 and (c[1] / c[2]).is_integer()}
        if due:
            self._at_once(due)
        self._note()
        times: list[float] = []
        while self._next():
            times.append(self.t)
            if len(times) > 20 and self.t - times[-20] < ROUNDING:
                raise Endless
            if len(times) > 400:
                raise Undecided("it grows")
        return self.corners

    def _note(self) -> None:
        self.corners.append((self.t, list(self.x), list(self.n), list(self.b)))

    def _next(self) -> bool:
        """To the next event, or to the end."""
        self.pre_x, self.pre_n, self.pre_b = self.x, self.n, self.b
        rates = [sum((self._number(term) for term in terms), rate) for rate, terms in self.program.rates]
        coming = list(self._coming(rates))
        t = min((at for at, _ in coming), default=math.inf)
        if t > END + APART:
            self._move(END, rates)
            return False
        now = [(at, what) for at, what in coming if at <= t + APART]
        # at one time by the program is what happens at times that are given, or at one place of one state
        if abs(t - END) < APART or any(at != t for at, _ in now) or len({self._place(what) for _, what in now}) > 1:
            raise Undecided
        self._move(t, rates)
        for kind, relation, value in (what for _, what in now if what[0] != "sample"):
            if kind != "time":
                self.x[relation[1]] = self._edge(relation, value)
            self.held[relation] = value
        self._at_once({what[1] for _, what in now if what[0] == "sample"})
        self._note()
        return True

    def _coming(self, rates: list[float]) -> Iterator[tuple[float, Any]]:
        """Times at which relations and steps would change with these rates, and samples."""
        for relation in self.relations:
            if relation[0] == "time":
                if not self.held[relation]:
                    yield relation[1], ("time", relation, True)
                continue
            _, k, at, how = relation
            rises = self.held[relation] != (how[0] == ">")
            if (rates[k] > 0.0) == rises and rates[k] != 0.0:
                yield self.t + max((at - self.x[k]) / rates[k], 0.0), ("x", relation, not self.held[relation])
        for step in self.floors:
            k = step[1]
            if rates[k] != 0.0:
                value = self.held[step] + (1 if rates[k] > 0.0 else -1)
                edge = self._edge(step, value)
                yield self.t + max((edge - self.x[k]) / rates[k], 0.0), ("floor", step, value)
        for clock in self.clocks:
            count = max(math.floor((self.t - clock[1]) / clock[2] + ROUNDING) + 1, 0)
            yield clock[1] + count * clock[2], ("sample", clock, True)

    def _edge(self, what: Any, value: Any) -> float:
        """Value of the state at which a relation switches, or a step begins or ends with this new value."""
        return what[2] if what[0] == "x" else what[2] * max(value, self.held[what])

    def _place(self, what: Any) -> Any:
        kind, relation, value = what
        return "time" if kind in ("time", "sample") else (relation[1], self._edge(relation, value))

    def _move(self, t: float, rates: list[float]) -> None:
        self.x = [x + rate * (t - self.t) for x, rate in zip(self.x, rates, strict=True)]
        self.t = t
        self._note()

    def _look(self, moved: Any) -> None:
        """Relations and steps of these states, and of time, as they are."""
        for relation in self.relations:
            if relation[0] == "time":
                self.held[relation] = self.t >= relation[1]
            elif relation[1] in moved:
                self.held[relation] = COMPARE[relation[3]](self.x[relation[1]], relation[2])
        for step in self.floors:
            if step[1] in moved:
                self.held[step] = math.floor(self.x[step[1]] / step[2])

    # ---- events -----------------------------------------------------------------------------------
    def _at_once(self, samples: set[Any]) -> None:
        self.sampled = samples
        self._settle()
        self.sampled = set()
        if samples:
            self._settle()

    def _settle(self, *, beginning: bool = False) -> None:
        """Turns until nothing changes."""
        self.beginning = beginning
        self.pre_x, self.pre_n, self.pre_b = list(self.x), list(self.n), list(self.b)
        for _ in range(60):
            before = set(self.true)
            new = self._turn()
            still = not new and self.true == before and (self.n, self.b) == (self.pre_n, self.pre_b)
            self.beginning = False
            self.pre_n, self.pre_b = list(self.n), list(self.b)
            for k, value in new.items():
                self.x[k] = value
            self._look(new)
            self.pre_x = list(self.x)
            if still:
                return
        raise Endless

    def _turn(self) -> dict[int, float]:
        """All equations with the present left limits; new values of states."""
        self.n, self.b = list(self.pre_n), list(self.pre_b)
        true: set[Any] = set()
        for kind, k, how in self.program.assigned:
            if kind == "b":
                self.b[k] = int(self._truth(how))
                continue
            acts = [self._acts(trigger, ("n", k, place), true) for place, (trigger, _) in enumerate(how)]
            if any(acts):
                value = how[acts.index(True)][1]
                self.n[k] = self._number(value)
                if value[0] == "x" and abs(self.n[k] - self.pre_n[k]) < ROUNDING:
                    raise Undecided("it changes, or it does not")
        new: dict[int, float] = {}
        for place, (trigger, k, value) in enumerate(self.program.reinits):
            if self._acts(trigger, ("x", place), true):
                new[k] = self._number(value)
        self.true = true
        return new

    def _acts(self, trigger: list[Any], key: Any, true: set[Any]) -> bool:
        """Whether one of the conditions has just become true; those that are true are noted."""
        acts = False
        for k, one in enumerate(trigger):
            if self._truth(one):
                true.add((key, k))
                acts |= one[0] == "initial" if self.beginning else (key, k) not in self.true
        return acts

    def _truth(self, e: Any) -> bool:
        kind, *rest = e
        return {
            "x": lambda: self.held[e],
            "time": lambda: self.held[e],
            "n >": lambda: self.n[rest[0]] > rest[1],
            "pre n >": lambda: self.pre_n[rest[0]] > rest[1],
            "b": lambda: bool(self.b[rest[0]]),
            "pre b": lambda: bool(self.pre_b[rest[0]]),
            "and": lambda: self._truth(rest[0]) and self._truth(rest[1]),
            "or": lambda: self._truth(rest[0]) or self._truth(rest[1]),
            "not": lambda: not self._truth(rest[0]),
            "sample": lambda: e in self.sampled,
            "edge": lambda: bool(self.b[rest[0]]) and not self.pre_b[rest[0]],
            "change": lambda: self.n[rest[0]] != self.pre_n[rest[0]],
            "initial": lambda: self.beginning,
        }[kind]()

    def _number(self, e: Any) -> float:
        kind, *rest = e
        return {
            "number": lambda: rest[0],
            "x": lambda: self.x[rest[0]],
            "n": lambda: self.n[rest[0]],
            "pre n": lambda: self.pre_n[rest[0]],
            "count": lambda: 0 if self.pre_n[rest[0]] > rest[1] - 0.5 else self.pre_n[rest[0]] + 1,
            "floor": lambda: self.held[e],
            "back": lambda: self.pre_x[rest[0]] - rest[1],
            "bounce": lambda: -rest[1] * self.pre_x[rest[0]],
            "times": lambda: rest[0] * self._number(rest[1]),
            "where": lambda: rest[1] if self._truth(rest[0]) else rest[2],
        }[kind]()


def _of(kind: str, everything: list[Any]) -> set[Any]:
    return {e for e in everything if e[0] == kind}
