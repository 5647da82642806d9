"""Small models of library components; the tests of this directory simulate them."""

from __future__ import annotations

from functools import cache

import numpy as np

import acausal as ac
from acausal import Array, Component, Equations, Parameter, connect, inner, start
from acausal.components import blocks, electrical, hydraulic, planar, rotational, thermal, translational


class ChargedCapacitor(Component):
    """A step voltage charges a capacitor through a resistor: ``v = V (1 - exp(-t/RC))``."""

    source: electrical.StepVoltage = electrical.StepVoltage(V=10.0)
    resistor: electrical.Resistor = electrical.Resistor(R=50.0)
    capacitor: electrical.Capacitor = electrical.Capacitor(C=2e-3, v=start(0.0, fixed=True))
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.resistor.p)
        yield connect(self.resistor.n, self.capacitor.p)
        yield connect(self.capacitor.n, self.source.n, self.ground.p)


class Coil(Component):
    """A constant voltage drives an inductor through a resistor: ``i = V/R (1 - exp(-R t/L))``."""

    source: electrical.ConstantVoltage = electrical.ConstantVoltage(V=12.0)
    sensor: electrical.CurrentSensor = electrical.CurrentSensor()
    resistor: electrical.Resistor = electrical.Resistor(R=4.0)
    inductor: electrical.Inductor = electrical.Inductor(L=0.8, i=start(0.0, fixed=True))
    meter: electrical.VoltageSensor = electrical.VoltageSensor()
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.sensor.p)
        yield connect(self.sensor.n, self.resistor.p)
        yield connect(self.resistor.n, self.inductor.p, self.meter.p)
        yield connect(self.inductor.n, self.meter.n, self.source.n, self.ground.p)


class Rectifier(Component):
    """A sine voltage behind a transformer loads a capacitor through a diode."""

    source: electrical.SineVoltage = electrical.SineVoltage(V=20.0, f=5.0)
    transformer: electrical.IdealTransformer = electrical.IdealTransformer(n=2.0)
    diode: electrical.Diode = electrical.Diode()
    capacitor: electrical.Capacitor = electrical.Capacitor(C=1e-2, v=start(0.0, fixed=True))
    load: electrical.Conductor = electrical.Conductor(G=0.02)
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.transformer.p1)
        yield connect(self.transformer.p2, self.diode.p)
        yield connect(self.diode.n, self.capacitor.p, self.load.p)
        yield connect(
            self.source.n, self.transformer.n1, self.transformer.n2, self.capacitor.n, self.load.n, self.ground.p
        )


class CurrentSources(Component):
    """Three current sources and a voltage ramp share one variable resistor."""

    constant: electrical.ConstantCurrent = electrical.ConstantCurrent(I=1.0)
    stepped: electrical.StepCurrent = electrical.StepCurrent(I=0.5, startTime=0.5)
    sine: electrical.SineCurrent = electrical.SineCurrent(I=0.1, f=2.0)
    signalled: electrical.SignalCurrent = electrical.SignalCurrent()
    signal: blocks.Constant = blocks.Constant(k=0.25)
    ramp: electrical.RampVoltage = electrical.RampVoltage(V=2.0, duration=1.0)
    series: electrical.Resistor = electrical.Resistor(R=10.0)
    resistor: electrical.VariableResistor = electrical.VariableResistor()
    resistance: blocks.Slope = blocks.Slope(offset=5.0, slope=1.0)
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.ramp.p, self.series.p)
        yield connect(self.series.n, self.constant.n, self.stepped.n, self.sine.n, self.signalled.n, self.resistor.p)
        yield connect(
            self.ramp.n, self.constant.p, self.stepped.p, self.sine.p, self.signalled.p, self.resistor.n, self.ground.p
        )
        yield connect(self.signal.y, self.signalled.i)
        yield connect(self.resistance.y, self.resistor.R)


class Motor(Component):
    """A voltage turns an inertia: ``w = V/k (1 - exp(-k^2 t/(R J)))``."""

    signal: blocks.Constant = blocks.Constant(k=24.0)
    source: electrical.SignalVoltage = electrical.SignalVoltage()
    resistor: electrical.Resistor = electrical.Resistor(R=2.0)
    emf: electrical.RotationalEMF = electrical.RotationalEMF(k=1.5)
    inertia: rotational.Inertia = rotational.Inertia(J=0.5, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.signal.y, self.source.v)
        yield connect(self.source.p, self.resistor.p)
        yield connect(self.resistor.n, self.emf.p)
        yield connect(self.emf.n, self.source.n, self.ground.p)
        yield connect(self.emf.flange, self.inertia.flange_a)


class DampedMass(Component):
    """A mass on a spring and damper under a constant force."""

    wall: translational.Fixed = translational.Fixed()
    suspension: translational.SpringDamper = translational.SpringDamper(c=400.0, d=8.0, s_rel0=0.5)
    mass: translational.PointMass = translational.PointMass(m=4.0, s=start(0.7, fixed=True), v=start(0.0, fixed=True))
    pull: translational.ConstantForce = translational.ConstantForce(f_constant=40.0)
    position: translational.PositionSensor = translational.PositionSensor()
    speed: translational.SpeedSensor = translational.SpeedSensor()

    def equations(self) -> Equations:
        yield connect(self.wall.flange, self.suspension.flange_a)
        yield connect(
            self.suspension.flange_b, self.mass.flange, self.pull.flange, self.position.flange, self.speed.flange
        )


class CoupledMasses(Component):
    """Two masses, a rod between them (index 3), slowed down by viscous friction: ``v = v0 exp(-d t/(m1 + m2))``."""

    first: translational.Mass = translational.Mass(m=2.0, L=0.2, s=start(0.0, fixed=True), v=start(3.0, fixed=True))
    rod: translational.Rod = translational.Rod(L=1.0)
    sensor: translational.ForceSensor = translational.ForceSensor()
    second: translational.Mass = translational.Mass(m=3.0)
    friction: translational.ViscousFriction = translational.ViscousFriction(d=10.0)

    def equations(self) -> Equations:
        yield connect(self.first.flange_b, self.rod.flange_a)
        yield connect(self.rod.flange_b, self.sensor.flange_a)
        yield connect(self.sensor.flange_b, self.second.flange_a)
        yield connect(self.second.flange_b, self.friction.flange)


class Repulsion(Component):
    """A force between two free masses: their momentum stays."""

    left: translational.PointMass = translational.PointMass(m=1.0, s=start(0.0, fixed=True), v=start(0.5, fixed=True))
    right: translational.PointMass = translational.PointMass(m=4.0, s=start(1.0, fixed=True), v=start(0.0, fixed=True))
    force: translational.Force2 = translational.Force2()
    wave: blocks.Sine = blocks.Sine(amplitude=6.0, f=0.7)

    def equations(self) -> Equations:
        yield connect(self.wave.y, self.force.f)
        yield connect(self.left.flange, self.force.flange_a)
        yield connect(self.right.flange, self.force.flange_b)


class Bouncing(Component):
    """A falling mass on an elastic gap, and one thrown against the end stops of a stroke."""

    floor: translational.Fixed = translational.Fixed()
    gap: translational.ElastoGap = translational.ElastoGap(c=1e4, d=20.0)
    ball: translational.PointMass = translational.PointMass(m=1.0, s=start(0.3, fixed=True), v=start(0.0, fixed=True))
    weight: translational.Force = translational.Force()
    gravity: blocks.Constant = blocks.Constant(k=-9.81)
    slider: translational.PointMass = translational.PointMass(m=1.0, s=start(0.5, fixed=True), v=start(3.0, fixed=True))
    stops: translational.EndStops = translational.EndStops(k=1e4, c=10.0)

    def equations(self) -> Equations:
        yield connect(self.floor.flange, self.gap.flange_a)
        yield connect(self.gap.flange_b, self.ball.flange, self.weight.flange)
        yield connect(self.gravity.y, self.weight.f)
        yield connect(self.slider.flange, self.stops.flange)


class Driven(Component):
    """A spring drawn by a moving end, a damper drawn at constant speed."""

    motion: blocks.Sine = blocks.Sine(amplitude=0.1, f=0.5)
    position: translational.Position = translational.Position(exact=True)
    spring: translational.Spring = translational.Spring(c=100.0)
    mass: translational.PointMass = translational.PointMass(m=1.0, s=start(0.0, fixed=True), v=start(0.0, fixed=True))
    rate: blocks.Constant = blocks.Constant(k=0.2)
    speed: translational.Speed = translational.Speed(exact=True, s=start(0.0, fixed=True))
    damper: translational.Damper = translational.Damper(d=5.0)

    def equations(self) -> Equations:
        yield connect(self.motion.y, self.position.s_ref)
        yield connect(self.position.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.mass.flange, self.damper.flange_b)
        yield connect(self.rate.y, self.speed.v_ref)
        yield connect(self.speed.flange, self.damper.flange_a)


class GearedRack(Component):
    """A constant torque lifts a mass through a gear and a rack (index 3); all accelerations are constant."""

    drive: rotational.ConstantTorque = rotational.ConstantTorque(tau_constant=6.0)
    rotor: rotational.Inertia = rotational.Inertia(J=0.1, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    gear: rotational.IdealGear = rotational.IdealGear(ratio=4.0)
    sensor: rotational.TorqueSensor = rotational.TorqueSensor()
    wheel: rotational.Inertia = rotational.Inertia(J=0.5)
    rack: rotational.IdealGearR2T = rotational.IdealGearR2T(ratio=5.0)
    mass: translational.Mass = translational.Mass(m=8.0)
    angle: rotational.AngleSensor = rotational.AngleSensor()
    speed: rotational.SpeedSensor = rotational.SpeedSensor()

    def equations(self) -> Equations:
        yield connect(self.drive.flange, self.rotor.flange_a)
        yield connect(self.rotor.flange_b, self.gear.flange_a)
        yield connect(self.gear.flange_b, self.sensor.flange_a)
        yield connect(self.sensor.flange_b, self.wheel.flange_a)
        yield connect(self.wheel.flange_b, self.rack.flangeR, self.angle.flange, self.speed.flange)
        yield connect(self.rack.flangeT, self.mass.flange_a)


class Torsion(Component):
    """Two inertias on a torsion spring and damper, with a torque between them, and a shaft turned by its end."""

    left: rotational.Inertia = rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    shaft: rotational.SpringDamper = rotational.SpringDamper(c=50.0, d=0.5)
    right: rotational.Inertia = rotational.Inertia(J=2.0, phi=start(0.3, fixed=True), w=start(0.0, fixed=True))
    torque: rotational.Torque2 = rotational.Torque2()
    wave: blocks.Sine = blocks.Sine(amplitude=2.0, f=1.0)
    turn: rotational.Position = rotational.Position(exact=True)
    ramp: blocks.Slope = blocks.Slope(slope=0.5)
    spring: rotational.Spring = rotational.Spring(c=20.0)
    flywheel: rotational.Inertia = rotational.Inertia(J=0.2, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    brake: rotational.Damper = rotational.Damper(d=0.3)
    spin: rotational.Speed = rotational.Speed(exact=True, phi=start(0.0, fixed=True))
    rate: blocks.Constant = blocks.Constant(k=1.0)

    def equations(self) -> Equations:
        yield connect(self.left.flange_b, self.shaft.flange_a, self.torque.flange_a)
        yield connect(self.shaft.flange_b, self.right.flange_a, self.torque.flange_b)
        yield connect(self.wave.y, self.torque.tau)
        yield connect(self.ramp.y, self.turn.phi_ref)
        yield connect(self.turn.flange, self.spring.flange_a)
        yield connect(self.spring.flange_b, self.flywheel.flange_a)
        yield connect(self.flywheel.flange_b, self.brake.flange_a)
        yield connect(self.brake.flange_b, self.spin.flange)
        yield connect(self.rate.y, self.spin.w_ref)


class First(Component):
    """Drive train of Modelica.Mechanics.Rotational.Examples.First (Modelica Standard Library 4.0)."""

    sine: blocks.Sine = blocks.Sine(amplitude=10.0, f=5.0)
    torque: rotational.Torque = rotational.Torque(useSupport=True)
    inertia1: rotational.Inertia = rotational.Inertia(J=0.1)
    idealGear: rotational.IdealGear = rotational.IdealGear(ratio=10.0, useSupport=True)
    inertia2: rotational.Inertia = rotational.Inertia(J=2.0, phi=start(0.0, fixed=True), w=start(0.0, fixed=True))
    spring: rotational.Spring = rotational.Spring(c=1e4, phi_rel=start(0.0, fixed=True))
    inertia3: rotational.Inertia = rotational.Inertia(J=2.0, w=start(0.0, fixed=True))
    damper: rotational.Damper = rotational.Damper(d=10.0)
    fixed: rotational.Fixed = rotational.Fixed()

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.torque.tau)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.inertia1.flange_b, self.idealGear.flange_a)
        yield connect(self.idealGear.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia2.flange_b, self.spring.flange_a, self.damper.flange_a)
        yield connect(self.spring.flange_b, self.inertia3.flange_a)
        yield connect(self.damper.flange_b, self.fixed.flange, self.torque.support, self.idealGear.support)


class Oscillator(Component):
    """Modelica.Mechanics.Translational.Examples.Oscillator (Modelica Standard Library 4.0)."""

    sine1: blocks.Sine = blocks.Sine(f=15.9155)
    force1: translational.Force = translational.Force()
    mass1: translational.Mass = translational.Mass(m=1.0, L=1.0, s=start(-0.5, fixed=True), v=start(0.0, fixed=True))
    spring1: translational.Spring = translational.Spring(c=1e4, s_rel0=1.0)
    fixed1: translational.Fixed = translational.Fixed(s0=1.0)
    sine2: blocks.Sine = blocks.Sine(f=15.9155)
    force2: translational.Force = translational.Force()
    mass2: translational.Mass = translational.Mass(m=1.0, L=1.0, s=start(-0.5, fixed=True), v=start(0.0, fixed=True))
    spring2: translational.Spring = translational.Spring(c=1e4, s_rel0=1.0)
    damper1: translational.Damper = translational.Damper(d=10.0)
    fixed2: translational.Fixed = translational.Fixed(s0=1.0)

    def equations(self) -> Equations:
        yield connect(self.sine1.y, self.force1.f)
        yield connect(self.force1.flange, self.mass1.flange_a)
        yield connect(self.mass1.flange_b, self.spring1.flange_a)
        yield connect(self.spring1.flange_b, self.fixed1.flange)
        yield connect(self.sine2.y, self.force2.f)
        yield connect(self.force2.flange, self.mass2.flange_a)
        yield connect(self.mass2.flange_b, self.spring2.flange_a, self.damper1.flange_a)
        yield connect(self.spring2.flange_b, self.damper1.flange_b, self.fixed2.flange)


class TwoMasses(Component):
    """Modelica.Thermal.HeatTransfer.Examples.TwoMasses (Modelica Standard Library 4.0)."""

    mass1: thermal.HeatCapacitor = thermal.HeatCapacitor(C=15.0, T=start(373.15, fixed=True))
    mass2: thermal.HeatCapacitor = thermal.HeatCapacitor(C=15.0, T=start(273.15, fixed=True))
    conduction: thermal.ThermalConductor = thermal.ThermalConductor(G=10.0)
    sensor: thermal.TemperatureSensor = thermal.TemperatureSensor()

    def equations(self) -> Equations:
        yield connect(self.mass1.port, self.conduction.port_a, self.sensor.port)
        yield connect(self.conduction.port_b, self.mass2.port)


class Cooling(Component):
    """A heated body that loses heat in three ways."""

    body: thermal.HeatCapacitor = thermal.HeatCapacitor(C=20.0, T=start(350.0, fixed=True))
    heater: thermal.FixedHeatFlow = thermal.FixedHeatFlow(Q_flow=30.0)
    sun: thermal.PrescribedHeatFlow = thermal.PrescribedHeatFlow()
    shine: blocks.Pulse = blocks.Pulse(amplitude=10.0, period=0.6, startTime=0.1)
    wall: thermal.ThermalResistor = thermal.ThermalResistor(R=0.5)
    meter: thermal.HeatFlowSensor = thermal.HeatFlowSensor()
    outside: thermal.FixedTemperature = thermal.FixedTemperature(T=280.0)
    air: thermal.Convection = thermal.Convection()
    conductance: blocks.Constant = blocks.Constant(k=3.0)
    weather: thermal.PrescribedTemperature = thermal.PrescribedTemperature()
    day: blocks.Ramp = blocks.Ramp(height=20.0, duration=0.5, offset=290.0)
    sky: thermal.BodyRadiation = thermal.BodyRadiation(Gr=0.3)

    def equations(self) -> Equations:
        yield connect(self.shine.y, self.sun.Q_flow)
        yield connect(self.conductance.y, self.air.Gc)
        yield connect(self.day.y, self.weather.T)
        yield connect(
            self.body.port, self.heater.port, self.sun.port, self.wall.port_a, self.air.solid, self.sky.port_a
        )
        yield connect(self.wall.port_b, self.meter.port_a)
        yield connect(self.meter.port_b, self.outside.port)
        yield connect(self.air.fluid, self.sky.port_b, self.weather.port)


class SignalChain(Component):
    """Linear blocks, one after the other, on a sine and a step."""

    sine: blocks.Sine = blocks.Sine(amplitude=2.0, f=0.5, phase=0.3, offset=0.1, startTime=0.2)
    step: blocks.Step = blocks.Step(height=1.5, offset=-0.5, startTime=0.4)
    gain: blocks.Gain = blocks.Gain(k=3.0)
    add: blocks.Add = blocks.Add(k1=2.0, k2=-1.0)
    feedback: blocks.Feedback = blocks.Feedback()
    integrator: blocks.Integrator = blocks.Integrator(k=2.0, y=start(0.0, fixed=True))
    lag: blocks.FirstOrder = blocks.FirstOrder(k=2.0, T=0.3, y=start(0.0, fixed=True))
    second: blocks.SecondOrder = blocks.SecondOrder(w=8.0, D=0.4, y=start(0.0, fixed=True), yd=start(0.0, fixed=True))
    rate: blocks.Derivative = blocks.Derivative(k=1.0, T=0.05, x=start(0.0, fixed=True))
    pi: blocks.PIBlock = blocks.PIBlock(k=0.5, T=0.4, x=start(0.0, fixed=True))
    pid: blocks.PID = blocks.PID()

    def equations(self) -> Equations:
        yield connect(self.sine.y, self.gain.u)
        yield connect(self.gain.y, self.add.u1)
        yield connect(self.step.y, self.add.u2)
        yield connect(self.add.y, self.feedback.u1)
        yield connect(self.integrator.y, self.feedback.u2)
        yield connect(self.feedback.y, self.integrator.u)
        yield connect(self.step.y, self.lag.u)
        yield connect(self.lag.y, self.second.u)
        yield connect(self.lag.y, self.rate.u)
        yield connect(self.lag.y, self.pi.u)
        yield connect(self.step.y, self.pid.u)


class Nonlinear(Component):
    """Nonlinear blocks, a table, and two limited controllers of a lag, one with anti-windup."""

    table: blocks.TimeTable = blocks.time_table([0.0, 0.25, 0.75, 1.0], [0.0, 2.0, -2.0, 1.0])
    limiter: blocks.Limiter = blocks.Limiter(uMax=0.8, uMin=-0.5)
    zone: blocks.DeadZone = blocks.DeadZone(uMax=0.5, uMin=-0.5)
    product: blocks.Product = blocks.Product()
    switch: blocks.Switch = blocks.Switch(threshold=0.0)
    command: blocks.Step = blocks.Step(height=2.0)
    plain: blocks.LimPI = blocks.LimPI(Kp=2.0, Ki=4.0)
    plant: blocks.FirstOrder = blocks.FirstOrder(k=1.5, T=0.2, y=start(0.0, fixed=True))
    careful: blocks.LimPI = blocks.LimPI(Kp=2.0, Ki=4.0, anti_windup=True, Tt=0.1)
    copy: blocks.FirstOrder = blocks.FirstOrder(k=1.5, T=0.2, y=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.table.y, self.limiter.u, self.zone.u, self.switch.u2)
        yield connect(self.limiter.y, self.product.u1, self.switch.u1)
        yield connect(self.zone.y, self.product.u2, self.switch.u3)
        yield connect(self.command.y, self.plain.u_s, self.careful.u_s)
        yield connect(self.plain.y, self.plant.u)
        yield connect(self.plant.y, self.plain.u_m)
        yield connect(self.careful.y, self.copy.u)
        yield connect(self.copy.y, self.careful.u_m)


class Vessels(Component):
    """Two volumes that even out through a fixed and a variable orifice; a flow source returns some of the oil."""

    oil: hydraulic.Oil = inner(hydraulic.Oil(rho=870.0, B=1.6e9))
    first: hydraulic.ControlVolume = hydraulic.ControlVolume(V=2e-3, p=start(8e6, fixed=True))
    second: hydraulic.ControlVolume = hydraulic.ControlVolume(V=5e-3, p=start(1e6, fixed=True))
    orifice: hydraulic.Orifice = hydraulic.Orifice(area=1e-7)
    valve: hydraulic.VariableOrifice = hydraulic.VariableOrifice()
    opening: blocks.Ramp = blocks.Ramp(height=2e-7, duration=1.0)
    pump: hydraulic.FlowSource = hydraulic.FlowSource()
    flow: blocks.Constant = blocks.Constant(k=2e-6)

    def equations(self) -> Equations:
        yield connect(self.first.port, self.orifice.port_a, self.valve.port_a, self.pump.port_b)
        yield connect(self.second.port, self.orifice.port_b, self.valve.port_b, self.pump.port_a)
        yield connect(self.opening.y, self.valve.area)
        yield connect(self.flow.y, self.pump.u)


class Line(Component):
    """A pressure source drives oil through a pipe to a tank over an orifice."""

    pressure: Parameter = Parameter(2e6, unit="Pa", doc="pressure of the source")
    oil: hydraulic.Oil = inner(hydraulic.Oil())
    signal: blocks.Constant = blocks.Constant(k=pressure)
    source: hydraulic.PressureSource = hydraulic.PressureSource()
    inlet: hydraulic.Orifice = hydraulic.Orifice(area=1e-3)
    pipe: hydraulic.Pipe = hydraulic.Pipe(
        p_a=start(1e5, fixed=True), p_b=start(1e5, fixed=True), q=start(0.0, fixed=True)
    )
    outlet: hydraulic.Orifice = hydraulic.Orifice(area=1e-3)
    tank: hydraulic.Tank = hydraulic.Tank(p=1e5)

    def equations(self) -> Equations:
        yield connect(self.signal.y, self.source.p)
        yield connect(self.source.port, self.inlet.port_a)
        yield connect(self.inlet.port_b, self.pipe.port_a)
        yield connect(self.pipe.port_b, self.outlet.port_a)
        yield connect(self.outlet.port_b, self.tank.port)


class Friction(Component):
    """The three laws of pipe friction at the same flow, which grows with time from zero."""

    oil: hydraulic.Oil = inner(hydraulic.Oil())
    flow: blocks.Slope = blocks.Slope(slope=1e-2)
    laminar: hydraulic.LaminarFriction = hydraulic.LaminarFriction()
    paper: hydraulic.PaperFriction = hydraulic.PaperFriction()
    blended: hydraulic.BlendedFriction = hydraulic.BlendedFriction()

    def equations(self) -> Equations:
        yield connect(self.flow.y, self.laminar.q, self.paper.q, self.blended.q)


class PressedCylinder(Component):
    """A closed extended cylinder, held by its oil, rocks under a force; the oil stays in its chambers."""

    oil: hydraulic.Oil = inner(hydraulic.Oil())
    cylinder: hydraulic.ExtendedCylinder = hydraulic.ExtendedCylinder(p_b_start=5e6, x=start(0.8, fixed=True))
    force: translational.Force = translational.Force()
    wave: blocks.Sine = blocks.Sine(amplitude=1e5, f=2.0)

    def equations(self) -> Equations:
        yield connect(self.cylinder.flange, self.force.flange)
        yield connect(self.wave.y, self.force.f)


class HangingBoom(Component):
    """A boom that falls freely about its joint: its energy stays."""

    boom: planar.Boom = planar.Boom(m=100.0, r=1.5, I=300.0, phi=start(0.2, fixed=True), w=start(0.0, fixed=True))


class Ladder(Component):
    """RC ladder of `n` cells, as an array of components."""

    n: int = 5
    source: electrical.ConstantVoltage = electrical.ConstantVoltage(V=1.0)
    resistors: Array[electrical.Resistor] = Array(electrical.Resistor(R=2.0), "n")
    capacitors: Array[electrical.Capacitor] = Array(electrical.Capacitor(C=0.01, v=start(0.0, fixed=True)), "n")
    ground: electrical.Ground = electrical.Ground()

    def equations(self) -> Equations:
        yield connect(self.source.p, self.resistors[0].p)
        yield connect(self.resistors[:-1].n, self.resistors[1:].p)
        yield connect(self.resistors.n, self.capacitors.p)
        yield connect(self.source.n, self.ground.p)
        for i in range(self.n):
            yield connect(self.capacitors[i].n, self.ground.p)


EXAMPLES: dict[str, Component] = {
    type(model).__name__: model
    for model in (
        ChargedCapacitor(), Coil(), Rectifier(), CurrentSources(), Motor(), DampedMass(), CoupledMasses(), Repulsion(),
        Bouncing(), Driven(), GearedRack(), Torsion(), First(), Oscillator(), TwoMasses(), Cooling(), SignalChain(),
        Nonlinear(), Vessels(), Line(), Friction(), PressedCylinder(), HangingBoom(), Ladder(),
    )
}  # fmt: skip
"""Examples by name."""

TIMES = np.linspace(0.0, 1.0, 51)


@cache
def simulated(name: str) -> ac.Solution:
    """The first second of an example at `TIMES`; run once for all tests."""
    return ac.compile(EXAMPLES[name]).simulate(t1=1.0, saveat=TIMES, rtol=1e-9)
