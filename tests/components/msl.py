"""Examples of the Modelica Standard Library 4.0, assembled from the components of this library."""

from __future__ import annotations

from acausal import Component, Equations, connect, der, start
from acausal.components import blocks, electrical, rotational, translational


class ElastoGap(Component):
    """Modelica.Mechanics.Translational.Examples.ElastoGap."""

    fixed: translational.Fixed = translational.Fixed()
    rod1: translational.Rod = translational.Rod(L=2.0)
    rod2: translational.Rod = translational.Rod(L=2.0)
    springDamper1: translational.SpringDamper = translational.SpringDamper(c=10.0, s_rel0=1.0, d=1.5)
    springDamper2: translational.SpringDamper = translational.SpringDamper(c=10.0, s_rel0=1.0, d=1.5)
    mass1: translational.Mass = translational.Mass(s=start(2.0, fixed=True), v=start(0.0, fixed=True))
    elastoGap1: translational.ElastoGap = translational.ElastoGap(c=10.0, s_rel0=1.5, d=1.5)
    elastoGap2: translational.ElastoGap = translational.ElastoGap(c=10.0, s_rel0=1.5, d=1.5)
    mass2: translational.Mass = translational.Mass(s=start(2.0, fixed=True), v=start(0.0, fixed=True))

    def equations(self) -> Equations:
        yield connect(self.rod1.flange_b, self.fixed.flange, self.rod2.flange_a)
        yield connect(self.springDamper1.flange_a, self.rod1.flange_a, self.elastoGap1.flange_a)
        yield connect(self.springDamper2.flange_b, self.rod2.flange_b, self.elastoGap2.flange_b)
        yield connect(self.springDamper1.flange_b, self.mass1.flange_a)
        yield connect(self.mass1.flange_b, self.springDamper2.flange_a)
        yield connect(self.elastoGap1.flange_b, self.mass2.flange_a)
        yield connect(self.mass2.flange_b, self.elastoGap2.flange_a)


class CauerLowPassAnalog(Component):
    """Modelica.Electrical.Analog.Examples.CauerLowPassAnalog."""

    G: electrical.Ground = electrical.Ground()
    C1: electrical.Capacitor = electrical.Capacitor(C=1.072, v=start(0.0, fixed=True))
    C2: electrical.Capacitor = electrical.Capacitor(C=1 / (1.704992**2 * 1.304))
    C3: electrical.Capacitor = electrical.Capacitor(C=1.682, v=start(0.0, fixed=True))
    C4: electrical.Capacitor = electrical.Capacitor(C=1 / (1.179945**2 * 0.8586))
    C5: electrical.Capacitor = electrical.Capacitor(C=0.7262, v=start(0.0, fixed=True))
    L1: electrical.Inductor = electrical.Inductor(L=1.304, i=start(0.0, fixed=True))
    L2: electrical.Inductor = electrical.Inductor(L=0.8586, i=start(0.0, fixed=True))
    R1: electrical.Resistor = electrical.Resistor(R=1.0)
    R2: electrical.Resistor = electrical.Resistor(R=1.0)
    V: electrical.StepVoltage = electrical.StepVoltage(startTime=1.0, V=1.0)

    def equations(self) -> Equations:
        yield connect(self.V.p, self.R1.p)
        yield connect(self.R1.n, self.C1.p, self.L1.p, self.C2.p)
        yield connect(self.L1.n, self.C2.n, self.C3.p, self.C4.p, self.L2.p)
        yield connect(self.L2.n, self.C4.n, self.C5.p, self.R2.p)
        yield connect(self.C1.n, self.C3.n, self.C5.n, self.R2.n, self.V.n, self.G.p)


class PID_Controller(Component):
    """Modelica.Blocks.Examples.PID_Controller."""

    PI: blocks.LimPID = blocks.LimPID(k=100.0, Ti=0.1, yMax=12.0, Ni=0.1, Td=0.1, initType="SteadyState",
                                      controllerType="PI")  # fmt: skip
    inertia1: rotational.Inertia = rotational.Inertia(J=1.0, phi=start(0.0, fixed=True), a=start(0.0, fixed=True))
    torque: rotational.Torque = rotational.Torque()
    spring: rotational.SpringDamper = rotational.SpringDamper(c=1e4, d=100.0, w_rel=start(0.0, fixed=True))
    inertia2: rotational.Inertia = rotational.Inertia(J=2.0)
    kinematicPTP: blocks.KinematicPTP = blocks.KinematicPTP(
        startTime=0.5, deltaq=1.570796326794897, qd_max=1.0, qdd_max=1.0
    )
    integrator: blocks.Integrator = blocks.Integrator(initType="InitialState")
    speedSensor: rotational.SpeedSensor = rotational.SpeedSensor()
    loadTorque: rotational.ConstantTorque = rotational.ConstantTorque(tau_constant=10.0)

    def equations(self) -> Equations:
        yield connect(self.spring.flange_b, self.inertia2.flange_a)
        yield connect(self.inertia1.flange_b, self.spring.flange_a, self.speedSensor.flange)
        yield connect(self.torque.flange, self.inertia1.flange_a)
        yield connect(self.kinematicPTP.y, self.integrator.u)
        yield connect(self.loadTorque.flange, self.inertia2.flange_b)
        yield connect(self.PI.y, self.torque.tau)
        yield connect(self.speedSensor.w, self.PI.u_m)
        yield connect(self.integrator.y, self.PI.u_s)

    def initial_equations(self) -> Equations:
        yield der(self.spring.w_rel) == 0
