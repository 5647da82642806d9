"""Test models of ModelicaTest.Blocks 4.0, from library components with their names."""

from __future__ import annotations

from typing import Any

from acausal import Component
from acausal.components import blocks
from acausal.components.blocks import discrete
from acausal.components.examples import assemble


def continuous(kind: str | None = None) -> Component:
    """ModelicaTest.Blocks.Continuous, and its variants with other kinds of initialization."""
    output = kind == "InitialOutput"
    every: dict[str, Any] = {"initType": kind or "InitialState"}
    start: dict[str, Any] = {**every, "y_start": 2.0} if output else every
    own: dict[str, Any] = {"initType": kind} if kind and kind != "SteadyState" else {"initType": "InitialState"}
    own_start: dict[str, Any] = {**own, "y_start": 2.0} if output else own
    ramp = blocks.Ramp(offset=0.5, startTime=0.5, duration=2.0)
    through = ("integrator", "limIntegrator", "derivative", "firstOrder", "secondOrder", "pI", "pID")
    filtered = ("limPID.u_s", "transferFunction.u", "stateSpace.u[0].u", "lowpassButterworth.u", "criticalDamping.u")
    return assemble(
        "ramp.y - " + " - ".join(f"{name}.u" for name in through), "ramp1.y - " + " - ".join(filtered),
        "const.y - limPID.u_m", "sine.y - der1.u", ramp=ramp, ramp1=ramp, const=blocks.Constant(k=1.5),
        sine=blocks.Sine(f=1.0), der1=blocks.Der(), integrator=blocks.Integrator(**own_start),
        limIntegrator=blocks.LimIntegrator(outMax=1.0, **({**own, "y_start": 0.5} if output else own)),
        derivative=blocks.Derivative(**start), firstOrder=blocks.FirstOrder(T=1.0, **start),
        secondOrder=blocks.SecondOrder(w=1.0, D=1.0, **start), pI=blocks.PI(T=1.0, **own_start),
        pID=blocks.PID(Ti=0.5, Td=0.1, **own_start),
        limPID=blocks.LimPID(Ti=0.5, Td=0.1, yMax=3.0 if output else 1.0, **own_start),
        transferFunction=blocks.TransferFunction(a=[1.0, 1.0], b=[1.0], **start),
        stateSpace=blocks.StateSpace(
            A=[[1.0, 0.0], [0.0, 1.0]], B=[[1.0], [1.0]], C=[[1.0, 1.0]],
            **({**every, "y_start": (2.0,)} if output else every),
        ),
        lowpassButterworth=blocks.LowpassButterworth(f=1.0, **start),
        criticalDamping=blocks.CriticalDamping(normalized=False, f=1.0, **start),
    )  # fmt: skip


def logical() -> Component:
    """ModelicaTest.Blocks.Logical, without the gates, which are those of Blocks.Examples.LogicalNetwork1."""
    signals = "greaterThreshold.u - greaterEqualThreshold.u - lessThreshold.u - lessEqualThreshold.u - zeroCrossing.u"
    pairs = ("greater", "greaterEqual", "less", "lessEqual")
    return assemble(
        "table1.y - and1.u1", "table2.y - and1.u2 - or1.u2 - nand.u2 - logicalSwitch.u3",
        "table2.y - triggeredTrapezoid.u - timer.u", "and1.y - or1.u1",
        f"sine.y - {signals} - hysteresis.u - onOffController.reference - switch1.u1",
        "sine.y - " + " - ".join(f"{name}.u1" for name in pairs),
        "ramp.y - " + " - ".join(f"{name}.u2" for name in pairs) + " - switch1.u3 - onOffController.u",
        "or1.y - not1.u - change1.u - nand.u1", "greaterThreshold.y - zeroCrossing.enable", "not1.y - pre1.u",
        "nand.y - logicalSwitch.u1", "pre1.y - logicalSwitch.u2", "change1.y - switch1.u2",
        "booleanPulse.y - assertCondition.u",
        table1=blocks.BooleanTable(table=[2, 4, 6, 8]), table2=blocks.BooleanTable(table=[1, 3, 5, 7]),
        and1=blocks.And(), or1=blocks.Or(), nand=blocks.Nand(), not1=blocks.Not(), pre1=blocks.Pre(),
        change1=blocks.Change(), greaterThreshold=blocks.GreaterThreshold(threshold=0.1),
        sine=blocks.Sine(amplitude=2.0, f=0.5), greaterEqualThreshold=blocks.GreaterEqualThreshold(threshold=-0.1),
        lessThreshold=blocks.LessThreshold(threshold=0.1), greater=blocks.Greater(),
        lessEqualThreshold=blocks.LessEqualThreshold(threshold=-0.1), ramp=blocks.Ramp(height=5.0, duration=8.0),
        greaterEqual=blocks.GreaterEqual(), less=blocks.Less(), lessEqual=blocks.LessEqual(),
        zeroCrossing=blocks.ZeroCrossing(), logicalSwitch=blocks.LogicalSwitch(), switch1=blocks.Switch(),
        hysteresis=blocks.Hysteresis(uLow=-0.5, uHigh=0.5), onOffController=blocks.OnOffController(bandwidth=0.5),
        triggeredTrapezoid=blocks.TriggeredTrapezoid(rising=1.0, falling=0.5), timer=blocks.Timer(),
        assertCondition=blocks.AssertCondition(assertionLevel="warning"), booleanPulse=blocks.BooleanConstant(),
    )  # fmt: skip


def sampled() -> Component:
    """ModelicaTest.Blocks.Discrete."""
    often = {"samplePeriod": 0.02}
    parts = ("sampler", "zeroOrderHold", "firstOrderHold", "unitDelay", "transferFunction")
    return assemble(
        "sine.y - " + " - ".join(f"{name}.u" for name in parts) + " - stateSpace.u[0]",
        "sine.y - triggeredSampler.u - triggeredMax.u",
        "booleanPulse.y - triggeredSampler.trigger - triggeredMax.trigger",
        sine=blocks.Sine(f=3.0), sampler=blocks.Sampler(**often), zeroOrderHold=blocks.ZeroOrderHold(**often),
        firstOrderHold=blocks.FirstOrderHold(**often), unitDelay=blocks.UnitDelay(**often),
        transferFunction=discrete.TransferFunction(a=[1.0, 0.1], **often),  # pyright: ignore
        stateSpace=discrete.StateSpace(
            A=[[0, 1], [-1, -0.1]], B=[[0], [2]], C=[[2, 3]], D=[[0.1]], **often,  # pyright: ignore
        ),
        triggeredSampler=blocks.TriggeredSampler(y_start=2.0), booleanPulse=blocks.BooleanPulse(period=0.2),
        triggeredMax=blocks.TriggeredMax(),
    )  # fmt: skip


def first_order_hold() -> Component:
    """ModelicaTest.Blocks.FirstOrderHold."""
    return assemble(
        "sine.y - zeroOrderHold.u - firstOrderHold.u", sine=blocks.Sine(f=1.0, offset=0.5),
        zeroOrderHold=blocks.ZeroOrderHold(samplePeriod=0.05), firstOrderHold=blocks.FirstOrderHold(samplePeriod=0.05),
    )  # fmt: skip


def mean() -> Component:
    """ModelicaTest.Blocks.Mean."""
    return assemble(
        "cosine.y - mean.u - rectifiedMean.u - rootMeanSquare.u - harmonic.u",
        "harmonic.y_rms - polarToRectangular.u_abs", "harmonic.y_arg - polarToRectangular.u_arg",
        "polarToRectangular.y_re - rectangularToPolar.u_re", "polarToRectangular.y_im - rectangularToPolar.u_im",
        mean=blocks.Mean(f=2.0), cosine=blocks.Cosine(offset=0.5, f=2.0, amplitude=1.0, phase=0.7853981633974483),
        rectifiedMean=blocks.RectifiedMean(f=2.0), rootMeanSquare=blocks.RootMeanSquare(f=2.0),
        harmonic=blocks.Harmonic(f=2.0, k=1), polarToRectangular=blocks.PolarToRectangular(),
        rectangularToPolar=blocks.RectangularToPolar(),
    )  # fmt: skip


def root_mean_square() -> Component:
    """ModelicaTest.Blocks.RootMeanSquare."""
    return assemble(
        "expSine.y - mean1.u - rootMeanSquare.u", mean1=blocks.Mean(f=2.0),
        expSine=blocks.ExpSine(f=2.0, damping=0.5, offset=-0.5), rootMeanSquare=blocks.RootMeanSquare(f=2.0),
    )  # fmt: skip


def kinematic_ptp() -> Component:
    """ModelicaTest.Blocks.KinematicPTP."""
    within = {"qd_max": 3.0, "qdd_max": 4.0, "startTime": 0.5}
    return assemble(
        "kinematicPTP1a.y - integrator.u", "integrator.y - integrator1.u", "kinematicPTP2a.y - integrator2.u",
        "integrator2.y - integrator3.u", "integrator1.y - diff1.u1", "kinematicPTP1b.q - diff1.u2",
        "integrator3.y - diff2.u1", "kinematicPTP2b.q - diff2.u2",
        kinematicPTP1a=blocks.KinematicPTP(deltaq=1.0, **within), integrator=blocks.Integrator(),
        integrator1=blocks.Integrator(y_start=1.0), kinematicPTP2a=blocks.KinematicPTP(deltaq=4.0, **within),
        integrator2=blocks.Integrator(), integrator3=blocks.Integrator(y_start=1.0),
        kinematicPTP1b=blocks.KinematicPTP2(q_end=2.0, q_begin=1.0, **within), diff1=blocks.Feedback(),
        kinematicPTP2b=blocks.KinematicPTP2(q_end=5.0, q_begin=1.0, **within), diff2=blocks.Feedback(),
    )  # fmt: skip


def lim_pid() -> Component:
    """ModelicaTest.Blocks.LimPID, without the homotopies."""
    steps = [(0.4, 0.5), (-1.5, 2.0), (1.5, -1.0), (0.4, 0.5)]
    parts: dict[str, Component] = {}
    joints: list[str] = []
    for k, (height, offset) in enumerate(steps, start=1):
        parts[f"PID{k}"] = blocks.LimPID(Ti=1.0, yMax=1.0, yMin=0.0, initType="SteadyState", controllerType="PI")
        parts[f"step{k}"] = blocks.Step(height=height, offset=offset, startTime=1.0)
        parts[f"firstOrder{k}"] = blocks.FirstOrder(T=1.0, initType="SteadyState")
        joints += [f"firstOrder{k}.y - PID{k}.u_m", f"PID{k}.y - firstOrder{k}.u", f"step{k}.y - PID{k}.u_s"]
    return assemble(*joints, **parts)


def limiters() -> Component:
    """ModelicaTest.Blocks.Limiters."""
    return assemble(
        "sine.y - limiter.u - variableLimiter.u - deadZone.u - slewRateLimiter.u",
        "constPos.y - variableLimiter.limit1", "constNeg.y - variableLimiter.limit2",
        "slewRateLimiter.y - idealDerivative.u",
        limiter=blocks.Limiter(uMax=1.0), variableLimiter=blocks.VariableLimiter(), deadZone=blocks.DeadZone(uMax=1.0),
        sine=blocks.Sine(amplitude=2.0, f=1.0), constPos=blocks.Constant(k=1.0), constNeg=blocks.Constant(k=-1.0),
        slewRateLimiter=blocks.SlewRateLimiter(Rising=10.0), idealDerivative=blocks.Der(),
    )  # fmt: skip


def strict_limiters() -> Component:
    """ModelicaTest.Blocks.StrictLimiters; limiters are strict always."""
    wave, rate = blocks.Sine(amplitude=1.5, f=2.0), blocks.SlewRateLimiter(Rising=13.0)
    pid = blocks.LimPID(yMax=0.4, initType="InitialOutput")
    return assemble(
        "sine2.y - variableLimiter.u", "sine2a.y - variableLimiter.limit1", "sine2ab.y - variableLimiter.limit2",
        "sine3.y - slewRateLimiter1.u - slewRateLimiter2.u - limIntegrator1.u - limIntegrator2.u",
        "sine3.y - PID1.u_s - PID2.u_s",
        "variableLimiter.y - PID1.u_m - PID2.u_m", sine2=wave, sine3=wave,
        sine2a=blocks.Sine(amplitude=0.3, f=4.0, offset=1.0), sine2ab=blocks.Sine(amplitude=0.3, f=4.0, offset=-1.0),
        variableLimiter=blocks.VariableLimiter(), slewRateLimiter1=rate, slewRateLimiter2=rate,
        limIntegrator1=blocks.LimIntegrator(k=5.0, outMax=0.9),
        limIntegrator2=blocks.LimIntegrator(strict=True, k=5.0, outMax=0.9), PID1=pid, PID2=pid,
    )  # fmt: skip


def self_resetting_integrator() -> Component:
    """ModelicaTest.Blocks.SelfResettingIntegrator."""
    return assemble(
        "const.y - integrator.u", "integrator.y - greaterEqualThreshold.u",
        "greaterEqualThreshold.y - integrator.reset", integrator=blocks.Integrator(k=1.0, use_reset=True),
        const=blocks.Constant(k=1.0), greaterEqualThreshold=blocks.GreaterEqualThreshold(threshold=1.0),
    )  # fmt: skip


def reset_hold_integrator() -> Component:
    """ModelicaTest.Blocks.ResetHoldIntegrator."""
    return assemble(
        "switch.y - integrator.u", "fallingEdge.y - integrator.reset", "const1.y - switch.u1", "const0.y - switch.u3",
        "booleanPulse.y - switch.u2 - fallingEdge.u", integrator=blocks.Integrator(k=2.0, use_reset=True),
        const1=blocks.Constant(k=1.0), switch=blocks.Switch(), const0=blocks.Constant(k=0.0),
        booleanPulse=blocks.BooleanPulse(period=1.0), fallingEdge=blocks.FallingEdge(),
    )  # fmt: skip


def lim_reset_integrator() -> Component:
    """ModelicaTest.Blocks.LimResetIntegrator."""
    return assemble(
        "switch.y - integrator.u", "change.y - integrator.reset", "const1.y - switch.u1", "constMinus1.y - switch.u3",
        "booleanPulse.y - switch.u2 - change.u", switch=blocks.Switch(), const1=blocks.Constant(k=1.0),
        integrator=blocks.LimIntegrator(k=2.0, use_reset=True, outMax=0.75), constMinus1=blocks.Constant(k=-1.0),
        booleanPulse=blocks.BooleanPulse(period=1.0), change=blocks.Change(),
    )  # fmt: skip


def pade_delay1() -> Component:
    """ModelicaTest.Blocks.PadeDelay1; both implementations are the one there is."""
    late = blocks.PadeDelay(delayTime=0.2, n=10)
    return assemble(
        "step.y - padeDelay1.u - padeDelayOld1.u", "Sine.y - padeDelay2.u - padeDelayOld2.u", padeDelay1=late,
        padeDelay2=late, padeDelayOld1=late, padeDelayOld2=late, step=blocks.Step(startTime=0.1, offset=0.1),
        Sine=blocks.Sine(startTime=0.1, offset=0.1, f=2.0),
    )  # fmt: skip


def pade_delay2() -> Component:
    """ModelicaTest.Blocks.PadeDelay2."""
    plain = blocks.PadeDelay(delayTime=0.001, n=4)
    balanced = blocks.PadeDelay(delayTime=0.001, n=4, balance=True)
    return assemble(
        "step.y - padeDelay1a.u - padeDelay1b.u", "Sine.y - padeDelay2a.u - padeDelay2b.u", padeDelay1a=plain,
        padeDelay1b=balanced, padeDelay2a=plain, padeDelay2b=balanced, step=blocks.Step(startTime=0.01, offset=0.1),
        Sine=blocks.Sine(startTime=0.01, offset=0.1, f=2.0),
    )  # fmt: skip


def mux_demux() -> Component:
    """ModelicaTest.Blocks.MuxDemux; its outputs y1 to y5 are those of `demux2` and `demux3`."""
    return assemble(
        "clock.y - mux2.u[0] - mux2.u[1] - mux3.u[0] - mux3.u[1] - mux3.u[2]", "mux2.y[0] - mux5.u[0]",
        "mux2.y[1] - mux5.u[1]", "mux3.y[0] - mux5.u[2]", "mux3.y[1] - mux5.u[3]", "mux3.y[2] - mux5.u[4]",
        "mux5.y - demux5.u", "demux5.y[0] - demux2.u[0]", "demux5.y[1] - demux2.u[1]", "demux5.y[2] - demux3.u[0]",
        "demux5.y[3] - demux3.u[1]", "demux5.y[4] - demux3.u[2]", clock=blocks.ContinuousClock(),
        mux5=blocks.Multiplex(n=5), demux5=blocks.DeMultiplex(n=5), mux3=blocks.Multiplex(n=3),
        mux2=blocks.Multiplex(n=2), demux2=blocks.DeMultiplex(n=2), demux3=blocks.DeMultiplex(n=3),
    )  # fmt: skip


def integer_table() -> Component:
    """ModelicaTest.Blocks.IntegerTable."""
    rows = [[0, 1], [1, 4], [1.5, 5], [2, 6]]
    return assemble(
        integerTable=blocks.IntegerTable(table=rows), integerTable2=blocks.IntegerTable(table=[[0, -1]]),
        integerTable3=blocks.IntegerTable(table=[[2, -2]]), integerTable4=blocks.IntegerTable(table=[*rows, [4, 7]]),
    )  # fmt: skip


def boolean_table() -> Component:
    """ModelicaTest.Blocks.BooleanTable."""
    tables = {
        "1": [1, 1.5, 2], "2a": [0, 1, 2], "2b": [-1, 0, 1, 2], "3a": [1], "3b": [0], "3c": [-1], "4a": [],
    }  # fmt: skip
    made = {f"booleanTable{k}": blocks.BooleanTable(table=times) for k, times in tables.items()}
    return assemble(**made, booleanTable4b=blocks.BooleanTable(table=[], startValue=True))


def hysteresis() -> Component:
    """ModelicaTest.Blocks.Hysteresis."""
    return assemble(
        "Signal.y - hysteresis.u", Signal=blocks.Sine(f=1.0), hysteresis=blocks.Hysteresis(uLow=-0.5, uHigh=0.5)
    )  # fmt: skip


def filters() -> Component:
    """ModelicaTest.Blocks.FilterTests.Basic."""
    parts: dict[str, Component] = {}
    for kind in ("CriticalDamping", "Bessel", "Butterworth", "ChebyshevI"):
        for label, order, f_cut in (("a", 3, 3.0), ("b", 6, 5.0)):
            parts[f"{kind}_{label}"] = blocks.Filter(analogFilter=kind, order=order, f_cut=f_cut, f_min=0.8 * f_cut)
    return assemble(
        "step.y - " + " - ".join(f"{name}.u" for name in parts), step=blocks.Step(startTime=0.1, offset=0.1), **parts
    )  # fmt: skip
