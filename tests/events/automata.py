"""Library components with modes, and what they are to do as automata written by hand (`hand_written`).

Each case drives its component through all of its modes by sines, so that every transition happens at a time of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from acausal import Component, start
from acausal.components import blocks, electrical, rotational, translational
from acausal.components.examples import assemble

from .hand_written import Exit, Mode, State


@dataclass(frozen=True)
class Case:
    """A model with one component that has modes, and its automaton.

    Attributes:
        states: variables of the model in the order of the automaton's states.
        begin: mode at the start; `x` are the states there.
    """

    model: Component
    states: tuple[str, ...]
    modes: dict[str, Mode]
    begin: str
    x: list[float]
    end: float = 3.0


def at_rest(J: float) -> rotational.Inertia:
    return rotational.Inertia(J=J, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))


def wave(amplitude: float, f: float, phase: float = 0.0) -> tuple[blocks.Sine, Callable[[float], float]]:
    """A sine as a block, and as a function."""
    return blocks.Sine(amplitude=amplitude, f=f, phase=phase), lambda t: amplitude * np.sin(2 * np.pi * f * t + phase)


def stick_slip(
    load: Callable[[float], float], mass: float, rest: Callable[[float], float], most: Callable[[float], float],
    sliding: Callable[[float, float], float], name: str, free: Callable[[float], float] | None = None,
) -> dict[str, Mode]:
    """Modes of dry friction on one mass, whose states are position and velocity.

    Args:
        load: driving force at a time.
        rest, most: friction at the beginning of sliding, and what holds at rest.
        sliding: size of the friction at a time and speed.
        name: of the component's variable `mode`.
        free: positive where the friction acts; it acts always, if this is left out.
    """

    def rests(t: float, _: State) -> str:
        return "stuck" if abs(load(t)) <= most(t) else "forward" if load(t) > 0 else "backward"

    def gripped(t: float, x: State) -> str:
        return rests(t, x) if x[1] == 0.0 else "forward" if x[1] > 0 else "backward"

    lets_go = () if free is None else (Exit(lambda t, x: free(t), "free"),)
    stopped: Callable[[float, State], list[float]] = lambda t, x: [x[0], 0.0]  # noqa: E731
    modes = {
        "forward": Mode(
            lambda t, x: [x[1], (load(t) - sliding(t, x[1])) / mass],
            (Exit(lambda t, x: x[1], rests, stopped), *lets_go), {name: 1.0},
        ),
        "backward": Mode(
            lambda t, x: [x[1], (load(t) + sliding(t, -x[1])) / mass],
            (Exit(lambda t, x: -x[1], rests, stopped), *lets_go), {name: -1.0},
        ),
        "stuck": Mode(
            lambda t, x: [0.0, 0.0],
            (
                Exit(lambda t, x: most(t) - load(t), "forward"),
                Exit(lambda t, x: most(t) + load(t), "backward"),
                *lets_go,
            ),
            {name: 0.0},
        ),
    }  # fmt: skip
    if free is not None:
        modes["free"] = Mode(
            lambda t, x: [x[1], load(t) / mass], (Exit(lambda t, x: -free(t), gripped),), {name: 2.0}
        )
    return modes


def bearing_friction() -> Case:
    drive, load = wave(3.0, 0.5)
    bearing = rotational.BearingFriction(tau_pos=((0.0, 1.0), (1.0, 1.5)), peak=1.5)
    model = assemble(
        "drive.y - torque.tau", "torque.flange - rotor.flange_a", "rotor.flange_b - bearing.flange_a",
        drive=drive, torque=rotational.Torque(), rotor=at_rest(2.0), bearing=bearing,
    )  # fmt: skip
    modes = stick_slip(load, 2.0, lambda t: 1.0, lambda t: 1.5, lambda t, w: 1.0 + 0.5 * w, "bearing.mode")
    return Case(model, ("rotor.phi", "rotor.w"), modes, "stuck", [0.0, 0.0], 4.0)


def rotational_brake() -> Case:
    drive, load = wave(2.0, 0.7)
    press, pressed = wave(1.0, 0.4)
    model = assemble(
        "drive.y - torque.tau", "torque.flange - rotor.flange_a", "rotor.flange_b - brake.flange_a",
        "press.y - brake.f_normalized", drive=drive, press=press, torque=rotational.Torque(), rotor=at_rest(1.0),
        brake=rotational.Brake(mu_pos=((0.0, 0.5),), peak=1.2, cgeo=2.0, fn_max=2.0),
    )  # fmt: skip
    held: Callable[[float], float] = lambda t: 2.0 * pressed(t)  # noqa: E731
    modes = stick_slip(
        load, 1.0, held, lambda t: 1.2 * held(t), lambda t, w: held(t), "brake.mode", lambda t: pressed(t)
    )
    return Case(model, ("rotor.phi", "rotor.w"), modes, "stuck", [0.0, 0.0], 4.0)


def support_friction() -> Case:
    drive, load = wave(3.0, 0.5, 0.3)
    model = assemble(
        "drive.y - force.f", "force.flange - mass.flange_a", "mass.flange_b - slide.flange_a", drive=drive,
        force=translational.Force(), slide=translational.SupportFriction(f_pos=((0.0, 1.0), (1.0, 1.4)), peak=1.3),
        mass=translational.Mass(m=2.0, s=start(0.0, fixed=True), v=start(1.0, fixed=True)),
    )  # fmt: skip
    modes = stick_slip(load, 2.0, lambda t: 1.0, lambda t: 1.3, lambda t, v: 1.0 + 0.4 * v, "slide.mode")
    return Case(model, ("mass.s", "mass.v"), modes, "forward", [0.0, 1.0], 4.0)


def hard_stops() -> Case:
    """Stribeck friction between two stops at which the mass loses its speed, and stays while it is pushed there."""
    drive, load = wave(12.0, 0.4)
    mass = translational.MassWithStopAndFriction(
        m=2.0, L=0.0, smax=0.6, smin=-0.3, F_prop=1.0, F_Coulomb=2.0, F_Stribeck=1.5, fexp=2.0,
        s=start(0.0, fixed=True), v=start(0.0, fixed=True),
    )  # fmt: skip
    model = assemble("drive.y - force.f", "force.flange - mass.flange_a", drive=drive, force=translational.Force(),
                     mass=mass)  # fmt: skip
    most = 1.001 * 3.5
    modes = stick_slip(
        load, 2.0, lambda t: 3.5, lambda t: most, lambda t, v: v + 2.0 + 1.5 * np.exp(-2.0 * v), "mass.mode"
    )
    for way, end, sign in (("forward", 0.6, 1.0), ("backward", -0.3, -1.0)):
        back = "backward" if sign > 0 else "forward"
        hit = Exit(lambda t, x, e=end, s=sign: s * (e - x[0]), f"at {way} stop", lambda t, x, e=end: [e, 0.0])
        modes[way] = Mode(modes[way].rate, (hit, *modes[way].exits), {**modes[way].shows, "mass.stopped": 0.0})
        modes[f"at {way} stop"] = Mode(
            lambda t, x: [0.0, 0.0], (Exit(lambda t, x, s=sign: most + s * load(t), back),),
            {"mass.mode": 0.0, "mass.stopped": sign},
        )  # fmt: skip
    return Case(model, ("mass.s", "mass.v"), modes, "stuck", [0.0, 0.0], 5.0)


def clutch() -> Case:
    """Two shafts; the states are their speeds."""
    drive, load = wave(4.0, 0.6)
    model = assemble(
        "drive.y - torque.tau", "torque.flange - one.flange_a", "one.flange_b - clutch.flange_a",
        "clutch.flange_b - two.flange_a", "press.y - clutch.f_normalized", drive=drive, torque=rotational.Torque(),
        press=blocks.Constant(k=0.8), one=at_rest(1.0), two=at_rest(2.0),
        clutch=rotational.Clutch(mu_pos=((0.0, 0.5), (1.0, 0.4)), peak=1.1, fn_max=5.0),
    )  # fmt: skip
    most = 1.1 * 0.5 * 4.0

    def carried(t: float) -> float:  # by the clutch, where both turn as one: what two needs
        return -load(t) * 2.0 / 3.0

    def slips(sign: float) -> Mode:
        def rate(t: float, x: State) -> list[float]:
            tau = sign * (0.5 - 0.1 * sign * (x[1] - x[0])) * 4.0
            return [load(t) + tau, -tau / 2.0]

        def joined(t: float, _: State) -> str:
            return "stuck" if abs(carried(t)) <= most else "forward" if carried(t) > 0 else "backward"

        one_speed: Callable[[float, State], list[float]] = lambda t, x: [(x[0] + 2 * x[1]) / 3] * 2  # noqa: E731
        return Mode(rate, (Exit(lambda t, x: sign * (x[1] - x[0]), joined, one_speed),), {"clutch.mode": sign})

    stuck = Mode(
        lambda t, x: [load(t) / 3.0] * 2,
        (Exit(lambda t, x: most - carried(t), "forward"), Exit(lambda t, x: most + carried(t), "backward")),
        {"clutch.mode": 0.0},
    )
    modes = {"forward": slips(1.0), "backward": slips(-1.0), "stuck": stuck}
    return Case(model, ("one.w", "two.w"), modes, "stuck", [0.0, 0.0], 4.0)


def one_way_clutch() -> Case:
    """Shaft b may run ahead of a, and is taken along where it would fall behind."""
    drive, load = wave(4.0, 0.6)
    model = assemble(
        "drive.y - torque.tau", "torque.flange - one.flange_a", "one.flange_b - clutch.flange_a",
        "clutch.flange_b - two.flange_a", "none.y - clutch.f_normalized", "two.flange_b - brake.flange",
        drive=drive, torque=rotational.Torque(),
        none=blocks.Constant(k=0.0), one=at_rest(1.0), two=at_rest(2.0), clutch=rotational.OneWayClutch(fn_max=2.0),
        brake=rotational.ConstantTorque(tau_constant=-0.4),
    )  # fmt: skip

    def together(t: float) -> float:
        return (load(t) - 0.4) / 3.0

    modes = {
        "taken along": Mode(
            lambda t, x: [together(t)] * 2,
            (Exit(lambda t, x: 1e-4 * 0.5 * 2.0 + 0.4 + 2.0 * together(t), "ahead"),), {"clutch.locked": 1.0},
        ),
        "ahead": Mode(
            lambda t, x: [load(t), -0.2],
            (Exit(lambda t, x: x[1] - x[0], "taken along", lambda t, x: [(x[0] + 2 * x[1]) / 3] * 2),),
            {"clutch.locked": 0.0, "clutch.stuck": 0.0},
        ),
    }  # fmt: skip
    return Case(model, ("one.w", "two.w"), modes, "taken along", [0.0, 0.0], 4.0)


def lossy_gear() -> Case:
    """A gear that drives an inertia, is driven by it, and jams in between; the states are those of the first shaft."""
    eta, bearing, J, behind = (0.8, 0.7), (0.1, 0.2), 1.0, 8.0 / 2.0**2
    drive, load = wave(1.0, 0.5)
    model = assemble(
        "drive.y - torque.tau", "torque.flange - one.flange_a", "one.flange_b - gear.flange_a",
        "gear.flange_b - two.flange_a", drive=drive, torque=rotational.Torque(), one=at_rest(J),
        gear=rotational.LossyGear(ratio=2.0, lossTable=((0.0, *eta, *bearing),)), two=rotational.Inertia(J=8.0),
    )  # fmt: skip
    same = (bearing[1] - bearing[0]) / (1 / eta[1] - eta[0])  # torque at which both losses are equal

    def loss(tau: float, sign: float) -> tuple[float, float]:
        """Slope and value for none of the loss, which is that of the side that drives."""
        drives = sign * tau >= same
        return (1 - eta[0], sign * bearing[0]) if drives else (1 - 1 / eta[1], sign * bearing[1])

    def acceleration(t: float, sign: float) -> float:
        for assumed in (10.0, -10.0):
            k, b = loss(sign * assumed, sign)
            a = ((1 - k) * load(t) - b) / (behind + (1 - k) * J)
            if (loss(load(t) - J * a, sign)) == (k, b):
                return a
        raise AssertionError("one side has to drive")

    def lost(t: float, sign: float) -> float:
        k, b = loss(load(t), sign)
        return k * load(t) + b

    def stopped(t: float, _: State) -> str:
        return "forward" if load(t) > lost(t, 1.0) else "backward" if load(t) < lost(t, -1.0) else "stuck"

    def rolls(sign: float) -> Mode:
        stop: Callable[[float, State], list[float]] = lambda t, x: [x[0], 0.0]  # noqa: E731
        return Mode(
            lambda t, x: [x[1], acceleration(t, sign)], (Exit(lambda t, x: sign * x[1], stopped, stop),),
            {"gear.mode": sign},
        )  # fmt: skip

    stuck = Mode(
        lambda t, x: [0.0, 0.0],
        (
            Exit(lambda t, x: lost(t, 1.0) - load(t), "forward"),
            Exit(lambda t, x: load(t) - lost(t, -1.0), "backward"),
        ),
        {"gear.mode": 0.0},
    )
    modes = {"forward": rolls(1.0), "backward": rolls(-1.0), "stuck": stuck}
    return Case(model, ("one.phi", "one.w"), modes, "stuck", [0.0, 0.0], 4.0)


def elasto_gap() -> Case:
    """A ball that is thrown against an elastic wall; the damper never pulls."""
    c, d, n = 50.0, 4.0, 1.5
    ball = translational.PointMass(m=2.0, s=start(0.3, fixed=True), v=start(-1.0, fixed=True))
    model = assemble(
        "wall.flange - gap.flange_a", "gap.flange_b - ball.flange - pull.flange", wall=translational.Fixed(), ball=ball,
        gap=translational.ElastoGap(c=c, d=d, n=n), pull=translational.ConstantForce(f_constant=-1.0),
    )  # fmt: skip

    def contact(t: float, x: State) -> list[float]:
        spring = c * max(-x[0], 0.0) ** n
        return [x[1], (-1.0 + spring - float(np.clip(d * x[1], -spring, spring))) / 2.0]

    modes = {
        "apart": Mode(lambda t, x: [x[1], -0.5], (Exit(lambda t, x: x[0], "contact"),), {}),
        "contact": Mode(contact, (Exit(lambda t, x: -x[0], "apart"),), {}),
    }
    return Case(model, ("ball.s", "ball.v"), modes, "apart", [0.3, -1.0], 4.0)


def elasto_backlash() -> Case:
    c, d, half = 40.0, 1.0, 0.1
    drive, load = wave(1.0, 0.8)
    model = assemble(
        "wall.flange - play.flange_a", "play.flange_b - rotor.flange_a", "drive.y - torque.tau",
        "torque.flange - rotor.flange_b", wall=rotational.Fixed(), drive=drive, torque=rotational.Torque(),
        rotor=at_rest(0.5), play=rotational.ElastoBacklash(c=c, d=d, b=2 * half),
    )  # fmt: skip

    def touching(sign: float) -> Mode:
        def rate(t: float, x: State) -> list[float]:
            spring = c * max(sign * x[0] - half, 0.0)
            damping = float(np.clip(d * sign * x[1], -spring, spring))
            return [x[1], (load(t) - sign * (spring + damping)) / 0.5]

        return Mode(rate, (Exit(lambda t, x: sign * x[0] - half, "play"),), {})

    play = Mode(
        lambda t, x: [x[1], load(t) / 0.5],
        (Exit(lambda t, x: half - x[0], "above"), Exit(lambda t, x: half + x[0], "below")), {},
    )  # fmt: skip
    modes = {"play": play, "above": touching(1.0), "below": touching(-1.0)}
    return Case(model, ("rotor.phi", "rotor.w"), modes, "play", [0.0, 0.0], 4.0)


R, L, RON, GOFF, KNEE = 2.0, 0.3, 0.05, 0.01, 0.4


def rectifier(part: Component, *connections: str, **more: Component) -> Component:
    """A sine through `part` into a coil with resistance."""
    return assemble(
        "source.p - part.p", "part.n - load.p", "load.n - coil.p", "source.n - coil.n - ground.p", *connections,
        source=electrical.SineVoltage(V=5.0, f=1.0), part=part, load=electrical.Resistor(R=R),
        coil=electrical.Inductor(L=L, i=start(0.0, fixed=True)), ground=electrical.Ground(), **more,
    )  # fmt: skip


def volts(t: float) -> float:
    return 5.0 * np.sin(2 * np.pi * t)


def current(conducts: bool, knee: float = 0.0) -> Callable[[float, State], list[float]]:
    """Of the coil, behind a part that conducts or blocks."""

    def rate(t: float, x: State) -> list[float]:
        drop = RON * (x[0] - GOFF * knee) + knee if conducts else x[0] / GOFF
        return [(volts(t) - R * x[0] - drop) / L]

    return rate


def ideal_diode() -> Case:
    modes = {
        "blocks": Mode(current(False), (Exit(lambda t, x: KNEE - x[0] / GOFF, "conducts"),), {"part.off": 1.0}),
        "conducts": Mode(
            current(True, KNEE), (Exit(lambda t, x: x[0] - GOFF * KNEE, "blocks"),), {"part.off": 0.0}
        ),
    }
    model = rectifier(electrical.IdealDiode(Ron=RON, Goff=GOFF, Vknee=KNEE))
    return Case(model, ("coil.i",), modes, "blocks", [0.0])


def ideal_thyristor() -> Case:
    """It conducts only once it is fired while the voltage is forward; the gate opens at 0.2 s of each period."""
    opens = Exit(lambda t, x: 0.2 - t % 1.0 if t % 1.0 < 0.5 else 1.0, "conducts")
    modes = {
        "blocks": Mode(current(False), (opens,), {"part.off": 1.0}),
        "conducts": Mode(current(True), (Exit(lambda t, x: x[0], "blocks"),), {"part.off": 0.0}),
    }
    model = rectifier(
        electrical.IdealThyristor(Ron=RON, Goff=GOFF), "gate.y - part.fire",
        gate=blocks.BooleanPulse(width=5.0, period=1.0, startTime=0.2),
    )  # fmt: skip
    return Case(model, ("coil.i",), modes, "blocks", [0.0])


def controlled_switch() -> Case:
    """Closed while the control is above its level."""

    def control(t: float) -> float:
        return np.sin(2 * np.pi * 0.7 * t) - 0.3

    modes = {
        "open": Mode(current(False), (Exit(lambda t, x: -control(t), "closed"),), {}),
        "closed": Mode(current(True), (Exit(lambda t, x: control(t), "open"),), {}),
    }
    model = rectifier(
        electrical.ControlledIdealClosingSwitch(Ron=RON, Goff=GOFF, level=0.3), "hand.p - part.control",
        "hand.n - ground.p", hand=electrical.SineVoltage(V=1.0, f=0.7),
    )  # fmt: skip
    return Case(model, ("coil.i",), modes, "open", [0.0])


def hysteresis() -> Case:
    """A room that is heated until its thermostat has seen enough."""
    model = assemble(
        "room.y - relay.u", "relay.y - heating.u", "heating.y - room.u", relay=blocks.Hysteresis(uLow=0.3, uHigh=0.7),
        room=blocks.FirstOrder(k=1.0, T=0.5, initType="InitialState"),
        heating=blocks.BooleanToReal(realTrue=0.0, realFalse=1.0),
    )  # fmt: skip
    modes = {
        "heats": Mode(lambda t, x: [(1.0 - x[0]) / 0.5], (Exit(lambda t, x: 0.7 - x[0], "cools"),), {"relay.y": 0.0}),
        "cools": Mode(lambda t, x: [-x[0] / 0.5], (Exit(lambda t, x: x[0] - 0.3, "heats"),), {"relay.y": 1.0}),
    }
    return Case(model, ("room.y",), modes, "heats", [0.0])


def triggered_sampler() -> Case:
    """The second state of the automaton is what is held."""
    signal, value = wave(1.0, 0.37, 0.5)
    clock, ticks = wave(1.0, 0.9)
    model = assemble(
        "signal.y - held.u", "clock.y - above.u", "above.y - held.trigger", "held.y - total.u", signal=signal,
        clock=clock, above=blocks.GreaterThreshold(threshold=0.2), held=blocks.TriggeredSampler(),
        total=blocks.Integrator(initType="InitialState"),
    )  # fmt: skip

    def holds(t: float, x: State) -> list[float]:
        return [x[1], 0.0]

    modes = {
        "waits": Mode(
            holds, (Exit(lambda t, x: 0.2 - ticks(t), "has sampled", lambda t, x: [x[0], value(t)]),), {"above.y": 0.0}
        ),
        "has sampled": Mode(holds, (Exit(lambda t, x: ticks(t) - 0.2, "waits"),), {"above.y": 1.0}),
    }
    return Case(model, ("total.y", "held.y"), modes, "waits", [0.0, 0.0])
