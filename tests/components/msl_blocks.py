"""Examples of Modelica.Blocks.Examples 4.0, from library components with its names."""

from __future__ import annotations

import math

import acausal as ac
from acausal import Component, Connector, Equations, Potential, connect
from acausal.components import blocks, electrical
from acausal.components.blocks import boolean, math_boolean, math_integer, true
from acausal.components.examples import assemble


def filter_of_all_kinds() -> Component:
    """Blocks.Examples.Filter."""
    kinds = ("CriticalDamping", "Bessel", "Butterworth", "ChebyshevI")
    filters = {k: blocks.Filter(analogFilter=k, order=3, f_cut=2.0, f_min=1.6) for k in kinds}
    return assemble("step.y - " + " - ".join(f"{k}.u" for k in kinds), step=blocks.Step(startTime=0.1, offset=0.1),
                    **filters)  # fmt: skip


def filter_with_differentiation() -> Component:
    """Blocks.Examples.FilterWithDifferentiation."""
    return assemble(
        "step.y - Bessel.u", "Bessel.y - der1.u", "der1.y - der2.u", "der2.y - der3.u", der1=blocks.Der(),
        der2=blocks.Der(), der3=blocks.Der(), step=blocks.Step(startTime=0.1, offset=0.1),
        Bessel=blocks.Filter(f_cut=2.0, order=3, analogFilter="Bessel"),
    )  # fmt: skip


def filter_with_rise_time() -> Component:
    """Blocks.Examples.FilterWithRiseTime."""
    filters = {f"filter_fac{k}": blocks.Filter(f_cut=k / (2 * math.pi * 2.0), order=2) for k in (5, 4, 3)}
    return assemble("step.y - filter_fac5.u - filter_fac4.u - filter_fac3.u", step=blocks.Step(startTime=1.0),
                    **filters)  # fmt: skip


def slew_rate_limiter() -> Component:
    """Blocks.Examples.SlewRateLimiter."""
    return assemble(
        "positionStep.y - limit_v.u", "limit_v.y - v.u", "v.y - limit_a.u", "limit_a.y - positionSmoothed.u - a.u",
        positionStep=blocks.Step(startTime=0.1), v=blocks.Der(), a=blocks.Der(),
        limit_v=blocks.SlewRateLimiter(initType="InitialOutput", Rising=2.0, y_start=0.0, Td=0.0001),
        limit_a=blocks.SlewRateLimiter(initType="InitialOutput", Rising=20.0, y_start=0.0, Td=0.0001),
        positionSmoothed=blocks.Integrator(initType="InitialOutput", y_start=0.0),
    )  # fmt: skip


def inverse_model() -> Component:
    """Blocks.Examples.InverseModel."""
    lag = blocks.FirstOrder(k=1.0, T=0.3, initType="SteadyState")
    return assemble(
        "firstOrder1.y - inverseBlockConstraints.u2", "inverseBlockConstraints.y2 - firstOrder1.u",
        "firstOrder2.y - feedback.u1", "sine.y - criticalDamping.u - feedback.u2",
        "criticalDamping.y - inverseBlockConstraints.u1", "inverseBlockConstraints.y1 - firstOrder2.u",
        firstOrder1=lag, firstOrder2=lag, sine=blocks.Sine(f=2.0, offset=1.0, startTime=0.2),
        inverseBlockConstraints=blocks.InverseBlockConstraints(), feedback=blocks.Feedback(),
        criticalDamping=blocks.CriticalDamping(n=1, f=100.0),
    )  # fmt: skip


class ShowLogicalSources(Component):
    """Blocks.Examples.ShowLogicalSources."""

    table: blocks.BooleanTable = blocks.BooleanTable(table=[2.0, 4.0, 6.0, 8.0])
    const: blocks.BooleanConstant = blocks.BooleanConstant()
    step: blocks.BooleanStep = blocks.BooleanStep(startTime=4.0)
    pulse: blocks.BooleanPulse = blocks.BooleanPulse(period=1.5)
    sample: blocks.SampleTrigger = blocks.SampleTrigger(period=0.5)
    booleanExpression: blocks.BooleanExpression = blocks.BooleanExpression()

    def equations(self) -> Equations:
        yield self.booleanExpression.y == boolean(true(self.pulse.y) & true(self.step.y))


def logical_network1() -> Component:
    """Blocks.Examples.LogicalNetwork1."""
    return assemble(
        "table2.y - Not1.u", "And1.y - Or1.u2", "table1.y - Or1.u1", "Not1.y - And1.u1", "Pre1.y - And1.u2",
        "Or1.y - Pre1.u", table2=blocks.BooleanTable(table=[1.0, 3.0, 5.0, 7.0]), Or1=blocks.Or(), Pre1=blocks.Pre(),
        table1=blocks.BooleanTable(table=[2.0, 4.0, 6.0, 8.0]), Not1=blocks.Not(), And1=blocks.And(),
    )  # fmt: skip


def real_network1() -> Component:
    """Blocks.Examples.RealNetwork1."""
    return assemble(
        "booleanPulse1.y - multiSwitch.u[0]", "booleanPulse2.y - multiSwitch.u[1]", "sine.y - add.u[0]",
        "integerStep.y - add.u[1] - product.u[0]", "integerConstant.y - product.u[1]",
        "add.y - linearDependency1.u1 - minMax.u[0]", "product.y - linearDependency1.u2 - minMax.u[1]",
        add=blocks.MultiSum(nu=2), sine=blocks.Sine(amplitude=3.0, f=0.1),
        integerStep=blocks.Step(height=3.0, startTime=2.0), integerConstant=blocks.Constant(k=1.0),
        product=blocks.MultiProduct(nu=2), booleanPulse1=blocks.BooleanPulse(period=1.0),
        multiSwitch=blocks.MultiSwitch(nu=2, expr=(4.0, 6.0), y_default=2.0),
        booleanPulse2=blocks.BooleanPulse(period=2.0, width=80.0),
        linearDependency1=blocks.LinearDependency(y0=1.0, k1=2.0, k2=3.0), minMax=blocks.MinMax(nu=2),
    )  # fmt: skip


def integer_network1() -> Component:
    """Blocks.Examples.IntegerNetwork1."""
    return assemble(
        "sine.y - realToInteger.u", "realToInteger.y - sum.u[0]", "integerStep.y - sum.u[1] - product.u[1]",
        "integerConstant.y - sum.u[2] - triggeredAdd.u", "sum.y - product.u[0]",
        "booleanPulse1.y - triggeredAdd.trigger - multiSwitch1.u[0]", "booleanPulse2.y - multiSwitch1.u[1]",
        sum=math_integer.Sum(nu=3), sine=blocks.Sine(amplitude=3.0, f=0.1), realToInteger=blocks.RealToInteger(),
        integerStep=blocks.IntegerStep(height=3, startTime=2.0), integerConstant=blocks.IntegerConstant(k=1),
        product=math_integer.Product(nu=2), triggeredAdd=math_integer.TriggeredAdd(),
        booleanPulse1=blocks.BooleanPulse(period=1.0), booleanPulse2=blocks.BooleanPulse(period=2.0, width=80.0),
        multiSwitch1=math_integer.MultiSwitch(nu=2, expr=(4, 6), y_default=2, use_pre_as_default=False),
    )  # fmt: skip


def boolean_network1() -> Component:
    """Blocks.Examples.BooleanNetwork1."""
    return assemble(
        "booleanPulse1.y - and1.u[0]", "booleanStep.y - and1.u[1]",
        "booleanPulse2.y - and1.u[2] - or1.u[1] - xor1.u[1] - nand1.u[1] - or2.u[1]",
        "booleanPulse2.y - rising.u - falling.u - changing.u",
        "and1.y - or1.u[0]", "or1.y - xor1.u[0]", "xor1.y - nand1.u[0]", "nand1.y - or2.u[0]", "or2.y - nor1.u",
        "rising.y - set1.u[0]", "falling.y - set1.u[1]", "booleanTable.y - onDelay.u",
        "integerConstant.y - triggeredAdd.u", "changing.y - triggeredAdd.trigger",
        "sampleTriggerSet.y - rSFlipFlop.S", "sampleTriggerReset.y - rSFlipFlop.R",
        and1=math_boolean.And(nu=3), booleanPulse1=blocks.BooleanPulse(width=20.0, period=1.0),
        booleanPulse2=blocks.BooleanPulse(period=1.0, width=80.0), booleanStep=blocks.BooleanStep(startTime=1.5),
        or1=math_boolean.Or(nu=2), xor1=math_boolean.Xor(nu=2), nand1=math_boolean.Nand(nu=2),
        or2=math_boolean.Nor(nu=2), nor1=math_boolean.Not(), onDelay=math_boolean.OnDelay(delayTime=1.0),
        rising=math_boolean.RisingEdge(), set1=math_boolean.MultiSwitch(nu=2, expr=(0, 1)),
        falling=math_boolean.FallingEdge(), changing=math_boolean.ChangingEdge(),
        booleanTable=blocks.BooleanTable(table=[2.0, 4.0, 6.0, 6.5, 7.0, 9.0, 11.0]),
        triggeredAdd=math_integer.TriggeredAdd(), integerConstant=blocks.IntegerConstant(k=2),
        rSFlipFlop=blocks.RSFlipFlop(), sampleTriggerSet=blocks.SampleTrigger(period=0.5, startTime=0.0),
        sampleTriggerReset=blocks.SampleTrigger(period=0.5, startTime=0.3),
    )  # fmt: skip


def interaction1() -> Component:
    """Blocks.Examples.Interaction1, without the displays."""
    rows = [[0, 0], [1, 2.1], [2, 4.2], [3, 6.3], [4, 4.2], [6, 2.1], [6, 2.1]]
    return assemble(
        "stop.on - start.reset[0]", "start.on - stop.reset[0]", timeTable=blocks.TimeTable(table=rows),
        integerTable=blocks.IntegerTable(table=[[0, 0], [1, 2], [2, 4], [3, 6], [4, 4], [6, 2]]),
        booleanTable=blocks.BooleanTable(table=[1, 2, 3, 4, 5, 6, 7, 8, 9]),
        start=blocks.RadioButtonSource(buttonTimeTable=[1, 3]),
        stop=blocks.RadioButtonSource(buttonTimeTable=[2, 4]),
    )  # fmt: skip


class SubControlBus(Connector):
    """Signals of a part."""

    myRealSignal: Potential = Potential()
    myBooleanSignal: Potential = Potential()


class ControlBus(Connector):
    """Signals of the whole, with those of the part; an expandable connector in Modelica."""

    realSignal1: Potential = Potential()
    integerSignal: Potential = Potential()
    booleanSignal: Potential = Potential()
    subControlBus: SubControlBus = SubControlBus()


class Part(Component):
    """A part that puts two signals on its bus."""

    subControlBus: SubControlBus = SubControlBus()
    realExpression: blocks.RealExpression = blocks.RealExpression()
    booleanExpression: blocks.BooleanExpression = blocks.BooleanExpression()

    def equations(self) -> Equations:
        yield self.realExpression.y == ac.time
        yield self.booleanExpression.y == boolean(ac.time >= 0.5)
        yield connect(self.realExpression.y, self.subControlBus.myRealSignal)
        yield connect(self.booleanExpression.y, self.subControlBus.myBooleanSignal)


class BusUsage(Component):
    """Blocks.Examples.BusUsage."""

    integerStep: blocks.IntegerStep = blocks.IntegerStep(height=1, offset=2, startTime=0.5)
    booleanStep: blocks.BooleanStep = blocks.BooleanStep(startTime=0.5)
    sine: blocks.Sine = blocks.Sine(f=1.0)
    part: Part = Part()
    gain: blocks.Gain = blocks.Gain(k=1.0)
    controlBus: ControlBus = ControlBus()

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.controlBus.realSignal1, self.gain.u)
        yield connect(self.booleanStep.y, self.controlBus.booleanSignal)
        yield connect(self.integerStep.y, self.controlBus.integerSignal)
        yield connect(self.part.subControlBus, self.controlBus.subControlBus)


def total_harmonic_distortion() -> Component:
    """Blocks.Examples.TotalHarmonicDistortion."""
    return assemble(
        "voltageSensor.p - sineVoltage3.p", "sineVoltage3.n - sineVoltage1.p",
        "sineVoltage1.n - ground.p - voltageSensor.n", "voltageSensor.v - thd1.u - thdRMS.u",
        ground=electrical.Ground(), voltageSensor=electrical.VoltageSensor(),
        sineVoltage3=electrical.SineVoltage(V=math.sqrt(2.0) * 20.0, f=150.0, startTime=0.02),
        sineVoltage1=electrical.SineVoltage(V=math.sqrt(2.0) * 100.0, f=50.0, startTime=0.02),
        thd1=blocks.TotalHarmonicDistortion(f=50.0),
        thdRMS=blocks.TotalHarmonicDistortion(f=50.0, useFirstHarmonic=False),
    )  # fmt: skip


def modulation() -> Component:
    """Blocks.Examples.Modulation."""
    am = {"useConstantFrequency": True, "constantFrequency": 100.0}
    fm = {"useConstantAmplitude": True, "constantFrequency": 100.0}
    return assemble(
        "amplitude.y - sinAM.amplitude - cosAM.amplitude", "frequency.y - sinFM.f - cosFM.f",
        sine=blocks.SineVariableFrequencyAndAmplitude(useConstantAmplitude=True, **am),  # pyright: ignore
        amplitude=blocks.Sine(amplitude=0.5, f=2.0, offset=1.0),
        sinAM=blocks.SineVariableFrequencyAndAmplitude(**am),  # pyright: ignore
        cosAM=blocks.CosineVariableFrequencyAndAmplitude(**am),  # pyright: ignore
        frequency=blocks.Sine(amplitude=50.0, f=2.0, offset=100.0),
        sinFM=blocks.SineVariableFrequencyAndAmplitude(**fm),  # pyright: ignore
        cosFM=blocks.CosineVariableFrequencyAndAmplitude(**fm),  # pyright: ignore
    )  # fmt: skip


def compare_sinc_exp_sine() -> Component:
    """Blocks.Examples.CompareSincExpSine."""
    return assemble(
        sinc=blocks.Sinc(f=5.0), expSine1=blocks.ExpSine(f=5.0, damping=5.0),
        expSine2=blocks.ExpSine(f=5.0, phase=math.pi / 2, damping=5.0),
    )  # fmt: skip
