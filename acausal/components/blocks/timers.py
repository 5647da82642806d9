"""What booleans do in time: timers, delays, trapezoids, the end of a run."""

from __future__ import annotations

import acausal as ac
from acausal import (
    Component,
    DeclarationError,
    Discrete,
    Equations,
    Input,
    Output,
    Parameter,
    assert_,
    pre,
    terminate,
    when,
    where,
)

from .booleans import boolean, true


class Timer(Component):
    """Time since the boolean `u` has become true, 0 while it is false.

    >>> model = assemble("step.y - timer.u", step=BooleanStep(startTime=0.25), timer=Timer())
    >>> close(run(model, at=[0.2, 0.5, 1.0])["timer.y"], [0.0, 0.25, 0.75])
    True

    Source: Modelica.Blocks.Logical.Timer.
    """

    u: Input = Input(doc="boolean signal")
    y: Output = Output(unit="s", doc="time since u has become true")
    entryTime: Discrete = Discrete(unit="s", doc="time at which u has become true")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(true(self.u), {self.entryTime: ac.time})
        yield self.y == where(true(self.u), ac.time - self.entryTime, 0.0)


class TriggeredTrapezoid(Component):
    """Rises to `amplitude` during `rising` when `u` becomes true, falls to 0 during `falling` when it becomes false.

    >>> model = assemble("pulse.y - shape.u", pulse=BooleanTable(table=[0.2, 0.6]),
    ...                  shape=TriggeredTrapezoid(amplitude=2.0, rising=0.2, falling=0.4))
    >>> close(run(model, at=[0.1, 0.3, 0.5, 0.8])["shape.y"], [0.0, 1.0, 2.0, 1.0])
    True

    Source: Modelica.Blocks.Logical.TriggeredTrapezoid.
    """

    u: Input = Input(doc="boolean signal")
    y: Output = Output(doc="signal")
    amplitude: Parameter = Parameter(1.0, doc="height")
    rising: Parameter = Parameter(0.0, unit="s", min=0.0, doc="duration of the rise")
    falling: Parameter = Parameter(rising, unit="s", min=0.0, doc="duration of the fall")
    offset: Parameter = Parameter(0.0, doc="value that the trapezoid is added to")
    endValue: Discrete = Discrete(doc="value that is approached")
    rate: Discrete = Discrete(unit="1/s", doc="rate of the approach")
    T: Discrete = Discrete(unit="s", doc="time at which endValue is reached")

    def equations(self) -> Equations:
        yield from super().equations()
        on = true(self.u)
        end = self.offset + where(on, self.amplitude, 0.0)
        duration, way = where(on, self.rising, self.falling), where(on, self.amplitude, -self.amplitude)
        at_once = (duration <= 0) | (ac.abs(way) <= 0)
        rate = where(at_once, 0.0, way / where(at_once, 1.0, duration))
        left = where(at_once | ac.initial(), 0.0, (end - pre(self.y)) / where(at_once, 1.0, rate))
        new = {self.endValue: end, self.rate: rate, self.T: ac.time + left}
        yield when([ac.initial(), on, ~on], new)
        yield self.y == where(ac.time < self.T, self.endValue - (self.T - ac.time) * self.rate, self.endValue)


class LogicalDelay(Component):
    """`y1` is the boolean `u`, but false only `delayTime` later; `y2` is `u`, but true only `delayTime` later.

    >>> model = assemble("pulse.y - late.u", pulse=BooleanTable(table=[0.2, 0.6]), late=LogicalDelay(delayTime=0.1))
    >>> result = run(model, at=[0.1, 0.25, 0.4, 0.65, 0.9])
    >>> result["late.y1"], result["late.y2"]
    ([0.0, 1.0, 1.0, 1.0, 0.0], [0.0, 0.0, 1.0, 0.0, 0.0])

    Source: Modelica.Blocks.Logical.LogicalDelay.
    """

    delayTime: Parameter = Parameter(0.0, unit="s", min=0.0, doc="delay")
    u: Input = Input(doc="boolean signal")
    y1: Discrete = Discrete(doc="u with its falling edges delayed")
    y2: Discrete = Discrete(doc="u with its rising edges delayed")
    tSwitch: Discrete = Discrete(unit="s", start=-1e300, doc="time of the last edge")

    def equations(self) -> Equations:
        yield from super().equations()
        on = true(self.u)
        passed = ac.time >= self.tSwitch + self.delayTime
        yield when([on, ~on], {self.tSwitch: ac.time})
        yield self.y1 == boolean(on | ~passed)
        yield self.y2 == boolean(on & passed)


class AssertCondition(Component):
    """The boolean `u` must be true; else `message`, and the end of the run with the `assertionLevel` ``error``.

    >>> run(assemble("yes.y - test.u", yes=BooleanConstant(k=True), test=AssertCondition(message="no")))["test.u"]
    [1.0, 1.0]

    Source: Modelica.Blocks.Logical.AssertCondition.
    """

    message: str = "Assert block failed"
    assertionLevel: str = "error"
    u: Input = Input(doc="boolean that must be true")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.assertionLevel not in ("error", "warning"):
            raise DeclarationError(f"assertionLevel={self.assertionLevel!r} is none of error, warning")
        level = "error" if self.assertionLevel == "error" else "warning"
        yield assert_(true(self.u), self.message, level=level)


class TerminateSimulation(Component):
    """Ends the run when the boolean `condition` becomes true.

    >>> model = assemble("step.y - end.condition", step=BooleanStep(startTime=0.5), end=TerminateSimulation())
    >>> solution = ac.compile(model).simulate(1.0, saveat=[0.0, 0.25, 0.75, 1.0])
    >>> np.asarray(solution.t).tolist()
    [0.0, 0.25, 0.5]

    Source: Modelica.Blocks.Logical.TerminateSimulation.
    """

    terminationText: str = "... End condition reached"
    condition: Input = Input(doc="boolean that ends the run")

    def equations(self) -> Equations:
        yield from super().equations()
        yield when(true(self.condition), terminate(self.terminationText))
