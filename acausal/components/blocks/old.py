"""Signal blocks: sources, continuous and nonlinear blocks (Modelica Standard Library 4.0, `Modelica.Blocks`).

A signal is a scalar without a unit of its own; connect an output to inputs with `connect(source.y, gain.u)`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cache
from itertools import pairwise
from typing import ClassVar

import acausal as ac
from acausal import PI, Component, Equations, Expr, Input, Output, Parameter, Variable, clip, der, sin, where


class SignalSource(Component, partial=True):
    """One output `y`, no input.

    Source: Modelica.Blocks.Interfaces.SO.
    """

    y: Output = Output(doc="output signal")


class SISO(Component, partial=True):
    """One input `u`, one output `y`.

    Source: Modelica.Blocks.Interfaces.SISO.
    """

    u: Input = Input(doc="input signal")
    y: Output = Output(doc="output signal")


class Constant(SignalSource):
    """Constant signal, ``y = k``.

    Source: Modelica.Blocks.Sources.Constant.
    """

    k: Parameter = Parameter(1.0, doc="value")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k


class Sine(SignalSource):
    """Sine, ``y = offset + amplitude sin(2 pi f (t - start_time) + phase)``, and `offset` before `start_time`.

    Source: Modelica.Blocks.Sources.Sine.
    """

    amplitude: Parameter = Parameter(1.0, doc="amplitude")
    f: Parameter = Parameter(1.0, unit="Hz", doc="frequency")
    phase: Parameter = Parameter(0.0, unit="rad", doc="phase")
    offset: Parameter = Parameter(0.0, doc="value that the sine is added to")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time at which the sine begins")

    def equations(self) -> Equations:
        yield from super().equations()
        wave = self.amplitude * sin(2 * PI * self.f * (ac.time - self.start_time) + self.phase)
        yield self.y == self.offset + where(ac.time < self.start_time, 0.0, wave)


class Step(SignalSource):
    """Step, ``y = offset``, from `start_time` on ``offset + height``.

    Source: Modelica.Blocks.Sources.Step.
    """

    height: Parameter = Parameter(1.0, doc="height of the step")
    offset: Parameter = Parameter(0.0, doc="value before the step")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time of the step")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + where(ac.time >= self.start_time, self.height, 0.0)


class Ramp(SignalSource):
    """Ramp from `offset` to ``offset + height`` between `start_time` and ``start_time + duration``.

    Source: Modelica.Blocks.Sources.Ramp.
    """

    height: Parameter = Parameter(1.0, doc="height of the ramp")
    duration: Parameter = Parameter(2.0, unit="s", min=1e-30, doc="duration of the ramp")
    offset: Parameter = Parameter(0.0, doc="value before the ramp")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time at which the ramp begins")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + self.height * clip((ac.time - self.start_time) / self.duration, 0.0, 1.0)


class Slope(SignalSource):
    """Endless ramp, ``y = offset + slope (t - start_time)``, and `offset` before `start_time`.

    Source: Modelica.Blocks.Sources.Ramp with infinite duration; with offset 0 and slope 1, ContinuousClock.
    """

    slope: Parameter = Parameter(1.0, doc="change of the signal per second")
    offset: Parameter = Parameter(0.0, doc="value at the beginning")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time at which the slope begins")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + self.slope * ac.max(ac.time - self.start_time, 0.0)


class Pulse(SignalSource):
    """Rectangular pulses of `height`, `width` per cent of each `period`, from `start_time` on.

    Source: Modelica.Blocks.Sources.Pulse.
    """

    height: Parameter = Parameter(1.0, doc="height of the pulses")
    width: Parameter = Parameter(50.0, min=0.0, max=100.0, doc="width in per cent of the period")
    period: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="time of one period")
    offset: Parameter = Parameter(0.0, doc="value between the pulses")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time of the first pulse")

    def equations(self) -> Equations:
        yield from super().equations()
        cycles = (ac.time - self.start_time) / self.period
        share = cycles - ac.floor(cycles)
        on = (ac.time >= self.start_time) & (share < self.width / 100)
        yield self.y == self.offset + where(on, self.height, 0.0)


@cache
def _interpolation(times: tuple[float, ...], values: tuple[float, ...]) -> Callable[[Expr], Expr]:
    """The one piecewise linear function through these points, so that equal tables are one function."""
    return ac.table(times, values)


class TimeTable(SignalSource, partial=True):
    """Piecewise linear signal through points, ``y = offset + table(t - start_time)``, constant outside of them.

    Make one with `time_table`, or derive a class that gives `times` and `values`.

    Source: Modelica.Blocks.Sources.TimeTable (which extrapolates the last slope instead).
    """

    times: ClassVar[tuple[float, ...]] = (0.0, 1.0)
    values: ClassVar[tuple[float, ...]] = (0.0, 1.0)
    offset: Parameter = Parameter(0.0, doc="value added to the table")
    start_time: Parameter = Parameter(0.0, unit="s", doc="time of the table's zero")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.offset + _interpolation(self.times, self.values)(ac.time - self.start_time)


def time_table(
    times: Sequence[float], values: Sequence[float], *, offset: float = 0.0, start_time: float = 0.0
) -> TimeTable:
    """A `TimeTable` through the given points.

    Args:
        times: increasing times [s], n of them, n >= 2.
        values: value at each of the times.
        offset: value added to the table.
        start_time: time of the table's zero [s].

    Raises:
        ValueError: times that do not increase, or lengths that differ.
    """
    points = tuple(float(t) for t in times)
    ordinates = tuple(float(v) for v in values)
    if len(points) != len(ordinates) or len(points) < 2:
        raise ValueError(f"time_table: as many values as times, at least 2, not {len(points)} and {len(ordinates)}")
    if any(b <= a for a, b in pairwise(points)):
        raise ValueError(f"time_table needs increasing times, not {points}")
    fields = {"times": points, "values": ordinates, "__doc__": TimeTable.__doc__, "__module__": __name__}
    made: type[TimeTable] = type("TimeTable", (TimeTable,), fields)
    return made(offset=offset, start_time=start_time)


class Gain(SISO):
    """Gain, ``y = k u``.

    Source: Modelica.Blocks.Math.Gain.
    """

    k: Parameter = Parameter(1.0, doc="gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k * self.u


class Feedback(Component):
    """Difference of a command and a feedback signal, ``y = u1 - u2``.

    Source: Modelica.Blocks.Math.Feedback.
    """

    u1: Input = Input(doc="command")
    u2: Input = Input(doc="feedback")
    y: Output = Output(doc="difference")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u1 - self.u2


class Add(Component):
    """Weighted sum of two signals, ``y = k1 u1 + k2 u2``.

    Source: Modelica.Blocks.Math.Add.
    """

    u1: Input = Input(doc="first signal")
    u2: Input = Input(doc="second signal")
    y: Output = Output(doc="sum")
    k1: Parameter = Parameter(1.0, doc="weight of u1")
    k2: Parameter = Parameter(1.0, doc="weight of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.k1 * self.u1 + self.k2 * self.u2


class Product(Component):
    """Product of two signals, ``y = u1 u2``.

    Source: Modelica.Blocks.Math.Product.
    """

    u1: Input = Input(doc="first signal")
    u2: Input = Input(doc="second signal")
    y: Output = Output(doc="product")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u1 * self.u2


class Switch(Component):
    """One of two signals, ``y = u1`` where ``u2 >= threshold``, else ``u3``.

    Source: Modelica.Blocks.Logical.Switch with a Modelica.Blocks.Logical.GreaterEqualThreshold.
    """

    u1: Input = Input(doc="signal above the threshold")
    u2: Input = Input(doc="signal that decides")
    u3: Input = Input(doc="signal below the threshold")
    y: Output = Output(doc="chosen signal")
    threshold: Parameter = Parameter(0.0, doc="threshold of u2")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == where(self.u2 >= self.threshold, self.u1, self.u3)


class Integrator(SISO):
    """Integrator, ``dy/dt = k u``.

    Source: Modelica.Blocks.Continuous.Integrator. Give the start by ``y=start(y0, fixed=True)``.
    """

    k: Parameter = Parameter(1.0, unit="1/s", doc="gain")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == self.k * self.u


class FirstOrder(SISO):
    """First-order lag, ``T dy/dt + y = k u``.

    Source: Modelica.Blocks.Continuous.FirstOrder.
    """

    k: Parameter = Parameter(1.0, doc="gain")
    T: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="time constant")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.T * der(self.y) == self.k * self.u - self.y


class SecondOrder(SISO):
    """Second-order lag, ``d2y/dt2 + 2 D w dy/dt + w^2 y = k w^2 u``.

    Source: Modelica.Blocks.Continuous.SecondOrder.
    """

    k: Parameter = Parameter(1.0, doc="gain")
    w: Parameter = Parameter(1.0, unit="rad/s", min=0.0, doc="angular frequency")
    D: Parameter = Parameter(1.0, unit="1", min=0.0, doc="damping ratio")
    yd: Variable = Variable(doc="time derivative of y")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.y) == self.yd
        yield der(self.yd) == self.w * (self.w * (self.k * self.u - self.y) - 2 * self.D * self.yd)


class Derivative(SISO):
    """Filtered derivative, ``k s / (T s + 1)``: ``dx/dt = (u - x)/T``, ``y = k (u - x)/T``.

    Source: Modelica.Blocks.Continuous.Derivative.
    """

    k: Parameter = Parameter(1.0, unit="s", doc="gain")
    T: Parameter = Parameter(0.01, unit="s", min=1e-30, doc="time constant of the filter")
    x: Variable = Variable(doc="filtered input")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == (self.u - self.x) / self.T
        yield self.y == self.k / self.T * (self.u - self.x)


class PIBlock(SISO):
    """Proportional-integral block, ``y = k (u + x)``, ``dx/dt = u/T``.

    Source: Modelica.Blocks.Continuous.PI.
    """

    k: Parameter = Parameter(1.0, doc="gain")
    T: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="time constant")
    x: Variable = Variable(doc="integral part")

    def equations(self) -> Equations:
        yield from super().equations()
        yield der(self.x) == self.u / self.T
        yield self.y == self.k * (self.x + self.u)


class PID(SISO):
    """PID block in additive form, ``y = k (u + integral(u)/Ti + Td s/(Td/Nd s + 1) u)``.

    Source: Modelica.Blocks.Continuous.PID.
    """

    k: Parameter = Parameter(1.0, doc="gain")
    Ti: Parameter = Parameter(0.5, unit="s", min=1e-30, doc="time constant of the integral part")
    Td: Parameter = Parameter(0.1, unit="s", min=1e-30, doc="time constant of the derivative part")
    Nd: Parameter = Parameter(10.0, unit="1", min=1e-30, doc="the higher, the closer to an ideal derivative")
    integral: Variable = Variable(doc="integral part")
    filtered: Variable = Variable(doc="filtered input")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.Ti * der(self.integral) == self.u
        yield self.Td / self.Nd * der(self.filtered) == self.u - self.filtered
        yield self.y == self.k * (self.u + self.integral + self.Nd * (self.u - self.filtered))


class LimPI(Component):
    """PI controller with limited output, ``y = clip(Kp e + Ki x, y_min, y_max)``, ``dx/dt = e + (y - y*)/Tt``.

    ``e = u_s - u_m`` is the control error and ``y*`` the output before the limits. With `anti_windup` off (the
    default) the last term is left out and the integral runs on while the output is at a limit.

    Source: PI controller of the crane of the paper, Fig. 5; back-calculation as in Modelica.Blocks.Continuous.LimPID
    and Astrom and Hagglund, PID Controllers (1995), section 3.5.
    """

    anti_windup: bool = False
    u_s: Input = Input(doc="set point")
    u_m: Input = Input(doc="measurement")
    y: Output = Output(doc="actuating signal")
    Kp: Parameter = Parameter(1.0, doc="proportional gain")
    Ki: Parameter = Parameter(1.0, doc="integral gain")
    y_min: Parameter = Parameter(-1.0, doc="lower limit of y")
    y_max: Parameter = Parameter(1.0, doc="upper limit of y")
    Tt: Parameter = Parameter(1.0, unit="s", min=1e-30, doc="tracking time of the anti-windup")
    e: Variable = Variable(doc="control error u_s - u_m")
    integral: Variable = Variable(start=0.0, fixed=True, nominal=0.1, doc="integral of the control error")

    def equations(self) -> Equations:
        yield from super().equations()
        unlimited = self.Kp * self.e + self.Ki * self.integral
        yield self.e == self.u_s - self.u_m
        yield self.y == clip(unlimited, self.y_min, self.y_max)
        if self.anti_windup:
            yield der(self.integral) == self.e + (self.y - unlimited) / (self.Ki * self.Tt)
        else:
            yield der(self.integral) == self.e


class Limiter(SISO):
    """Limits, ``y = clip(u, u_min, u_max)``.

    Source: Modelica.Blocks.Nonlinear.Limiter.
    """

    u_max: Parameter = Parameter(1.0, doc="upper limit")
    u_min: Parameter = Parameter(-1.0, doc="lower limit")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == clip(self.u, self.u_min, self.u_max)


class DeadZone(SISO):
    """Dead zone, ``y = u - clip(u, u_min, u_max)``.

    Source: Modelica.Blocks.Nonlinear.DeadZone.
    """

    u_max: Parameter = Parameter(1.0, doc="upper end of the zone")
    u_min: Parameter = Parameter(-1.0, doc="lower end of the zone")

    def equations(self) -> Equations:
        yield from super().equations()
        yield self.y == self.u - clip(self.u, self.u_min, self.u_max)
