"""Sources whose frequency and amplitude are signals."""

from __future__ import annotations

from acausal import PI, Equations, Input, Parameter, Variable, cos, der, sin

from .interfaces import OnePort


class PartialVariableFrequency(OnePort, partial=True):
    """Source with a phase of its own, ``dphi/dt = 2 pi f``, so that a change of `f` leaves no jump.

    Source: the common part of Modelica.Electrical.Analog.Sources.SineVoltageVariableFrequencyAndAmplitude and others.
    """

    useConstantAmplitude: bool = False
    useConstantFrequency: bool = False
    constantFrequency: Parameter = Parameter(1.0, unit="Hz", doc="frequency with useConstantFrequency")
    f: Input = Input(unit="Hz", doc="frequency without useConstantFrequency")
    phi: Variable = Variable(unit="rad", start=0.0, doc="phase of the wave")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantFrequency:
            yield self.f == self.constantFrequency
        yield der(self.phi) == 2 * PI * self.f


class SineVoltageVariableFrequencyAndAmplitude(PartialVariableFrequency):
    """Voltage source: sine of given amplitude and frequency, ``v = offset + V sin(phi)``, ``dphi/dt = 2 pi f``.

    `V` and `f` are signals, or with `useConstantAmplitude`, `useConstantFrequency` the constants of their names.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.V",
    ...                  source=SineVoltageVariableFrequencyAndAmplitude(useConstantFrequency=True),
    ...                  resistor=Resistor(R=4.0), ground=Ground(), ramp=blocks.Slope(offset=2.0, slope=2.0))
    >>> close(run(model, at=[0.0, 0.25])["source.v"], [0.0, 2.5])
    True

    Source: Modelica.Electrical.Analog.Sources.SineVoltageVariableFrequencyAndAmplitude.
    """

    constantAmplitude: Parameter = Parameter(1.0, unit="V", doc="amplitude with useConstantAmplitude")
    offset: Parameter = Parameter(0.0, unit="V", doc="voltage added to the wave")
    V: Input = Input(unit="V", doc="amplitude without useConstantAmplitude")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantAmplitude:
            yield self.V == self.constantAmplitude
        yield self.v == self.offset + self.V * sin(self.phi)


class CosineVoltageVariableFrequencyAndAmplitude(PartialVariableFrequency):
    """Voltage source: cosine of given amplitude and frequency, ``v = offset + V cos(phi)``, ``dphi/dt = 2 pi f``.

    `V` and `f` are signals, or with `useConstantAmplitude`, `useConstantFrequency` the constants of their names.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.V",
    ...                  source=CosineVoltageVariableFrequencyAndAmplitude(useConstantFrequency=True),
    ...                  resistor=Resistor(R=4.0), ground=Ground(), ramp=blocks.Slope(offset=2.0, slope=2.0))
    >>> close(run(model, at=[0.0, 0.5])["source.v"], [2.0, -3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.CosineVoltageVariableFrequencyAndAmplitude.
    """

    constantAmplitude: Parameter = Parameter(1.0, unit="V", doc="amplitude with useConstantAmplitude")
    offset: Parameter = Parameter(0.0, unit="V", doc="voltage added to the wave")
    V: Input = Input(unit="V", doc="amplitude without useConstantAmplitude")

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantAmplitude:
            yield self.V == self.constantAmplitude
        yield self.v == self.offset + self.V * cos(self.phi)


class SineCurrentVariableFrequencyAndAmplitude(PartialVariableFrequency):
    """Current source: sine of given amplitude and frequency, ``i = offset + I sin(phi)``, ``dphi/dt = 2 pi f``.

    `I` and `f` are signals, or with `useConstantAmplitude`, `useConstantFrequency` the constants of their names.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.I",
    ...                  source=SineCurrentVariableFrequencyAndAmplitude(useConstantFrequency=True),
    ...                  resistor=Resistor(R=4.0), ground=Ground(), ramp=blocks.Slope(offset=2.0, slope=2.0))
    >>> close(run(model, at=[0.0, 0.25])["source.i"], [0.0, 2.5])
    True

    Source: Modelica.Electrical.Analog.Sources.SineCurrentVariableFrequencyAndAmplitude.
    """

    constantAmplitude: Parameter = Parameter(1.0, unit="A", doc="amplitude with useConstantAmplitude")
    offset: Parameter = Parameter(0.0, unit="A", doc="current added to the wave")
    I: Input = Input(unit="A", doc="amplitude without useConstantAmplitude")  # noqa: E741

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantAmplitude:
            yield self.I == self.constantAmplitude
        yield self.i == self.offset + self.I * sin(self.phi)


class CosineCurrentVariableFrequencyAndAmplitude(PartialVariableFrequency):
    """Current source: cosine of given amplitude and frequency, ``i = offset + I cos(phi)``, ``dphi/dt = 2 pi f``.

    `I` and `f` are signals, or with `useConstantAmplitude`, `useConstantFrequency` the constants of their names.

    >>> model = assemble("source.p - resistor.p", "source.n - resistor.n - ground.p", "ramp.y - source.I",
    ...                  source=CosineCurrentVariableFrequencyAndAmplitude(useConstantFrequency=True),
    ...                  resistor=Resistor(R=4.0), ground=Ground(), ramp=blocks.Slope(offset=2.0, slope=2.0))
    >>> close(run(model, at=[0.0, 0.5])["source.i"], [2.0, -3.0])
    True

    Source: Modelica.Electrical.Analog.Sources.CosineCurrentVariableFrequencyAndAmplitude.
    """

    constantAmplitude: Parameter = Parameter(1.0, unit="A", doc="amplitude with useConstantAmplitude")
    offset: Parameter = Parameter(0.0, unit="A", doc="current added to the wave")
    I: Input = Input(unit="A", doc="amplitude without useConstantAmplitude")  # noqa: E741

    def equations(self) -> Equations:
        yield from super().equations()
        if self.useConstantAmplitude:
            yield self.I == self.constantAmplitude
        yield self.i == self.offset + self.I * cos(self.phi)
