"""A model-exchange FMU as a component: its derivatives and outputs are opaque functions of time, states and inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from types import new_class
from typing import Any

import numpy as np

from ..language.blackbox import function
from ..language.component import Component
from ..language.declarations import Input, Output, Variable
from ..language.functions import der, time
from .fmu import Fmu, FmuError, get_reals, set_reals

_STEP = 6e-6
"""Relative step of central differences (about the cube root of the rounding error)."""


class _Evaluator:
    """One instance of the unit, evaluated at points (t, states, inputs); the last point is kept."""

    def __init__(self, fmu: Fmu, parameters: Mapping[str, float]) -> None:
        self.fmu = fmu
        self.instance = instance = fmu.instantiate("me")
        names = list(parameters)
        set_reals(instance, [fmu.variable(n).valueReference for n in names], [float(parameters[n]) for n in names])
        if fmu.version == "2.0":
            instance.setupExperiment(startTime=0.0)
            instance.enterInitializationMode()
            instance.exitInitializationMode()
            instance.newDiscreteStates()
        else:
            instance.enterInitializationMode(startTime=0.0)
            instance.exitInitializationMode()
            instance.updateDiscreteStates()
        instance.enterContinuousTimeMode()
        entries = [d.variable if hasattr(d, "variable") else d for d in fmu.description.derivatives]
        self.rates = [int(d.valueReference) for d in entries]
        self.states = [str(d.derivative.name) for d in entries]
        self.inputs, self.outputs = fmu.names("input"), fmu.names("output")
        self.unknowns = [*self.rates, *(fmu.variable(n).valueReference for n in self.outputs)]
        self.state_references = [fmu.variable(n).valueReference for n in self.states]
        self.knowns = [*self.state_references, *(fmu.variable(n).valueReference for n in self.inputs)]
        self.start = get_reals(instance, self.state_references)
        self.point: bytes | None = None
        self.values = np.zeros(len(self.unknowns))
        offered = fmu.description.modelExchange
        self.directional = any(getattr(offered, f"providesDirectionalDerivative{s}", False) for s in ("", "s"))

    def _go(self, point: np.ndarray) -> None:
        n = len(self.states)
        self.instance.setTime(float(point[0]))
        if n:
            import ctypes

            array = (ctypes.c_double * n)(*point[1 : n + 1])
            self.instance.setContinuousStates(array, n)
        set_reals(self.instance, self.knowns[n:], [float(v) for v in point[n + 1 :]])

    def evaluate(self, point: np.ndarray) -> np.ndarray:
        """Derivatives of the states, then outputs, at (t, states, inputs)."""
        key = point.tobytes()
        if key != self.point:
            self._go(point)
            self.values = np.array(get_reals(self.instance, self.unknowns))
            self.point = key
        return self.values

    def gradient(self, k: int, point: np.ndarray) -> np.ndarray:
        """Derivatives of unknown k with respect to (t, states, inputs)."""
        out = np.zeros(len(point))
        first = 0
        if self.directional:
            self._go(point)
            self.point = None
            for i, known in enumerate(self.knowns):
                out[i + 1] = self.instance.getDirectionalDerivative([self.unknowns[k]], [known], [1.0])[0]
            first = len(point)  # the derivative with respect to time is left to differences
        for i in (0, *range(max(first, 1), len(point))):
            step = _STEP * max(1.0, abs(point[i]))
            ahead, behind = point.copy(), point.copy()
            ahead[i] += step
            behind[i] -= step
            out[i] = (self.evaluate(ahead)[k] - self.evaluate(behind)[k]) / (2 * step)
        return out


def _black_box(evaluator: _Evaluator, k: int, name: str) -> Any:
    """Unknown k of the unit as a function for equations, with its derivatives."""

    def host_value(*args: Any) -> np.ndarray:
        return np.asarray(evaluator.evaluate(np.array(args, float))[k])

    def host_gradient(*args: Any) -> np.ndarray:
        return evaluator.gradient(k, np.array(args, float))

    made: list[Callable[..., Any]] = []

    def call(*args: Any) -> Any:
        if not made:
            made.append(_differentiable(host_value, host_gradient))
        return made[0](*args)

    return function(call, name=name)


def _differentiable(value: Callable[..., Any], gradient: Callable[..., Any]) -> Callable[..., Any]:
    import jax
    import jax.numpy as jnp

    @jax.custom_jvp
    def f(*args: Any) -> Any:
        return jax.pure_callback(value, jax.ShapeDtypeStruct((), float), *args, vmap_method="sequential")

    @f.defjvp
    def f_jvp(primals: Any, tangents: Any) -> Any:
        shape = jax.ShapeDtypeStruct((len(primals),), float)
        slopes = jax.pure_callback(gradient, shape, *primals, vmap_method="sequential")
        return f(*primals), jnp.sum(slopes * jnp.stack([jnp.asarray(t, float) for t in tangents]))

    return f


def fmu_component(fmu: Fmu, parameters: Mapping[str, float]) -> Component:
    """A component whose states and outputs come from the unit.

    Raises:
        FmuError: it does not offer model exchange, or has event indicators.
    """
    if "me" not in fmu.kinds:
        raise FmuError(f"{fmu.path.name} does not offer model exchange; use it in a co-simulation")
    if int(fmu.description.numberOfEventIndicators or 0):
        raise FmuError(f"{fmu.path.name} has state events, which a component cannot pass on; use it in a co-simulation")
    evaluator = _Evaluator(fmu, parameters)
    fields: dict[str, tuple[str, Any]] = {}
    for i, state in enumerate(evaluator.states):
        v = fmu.variable(state)
        fields[state] = (_identifier(state), Variable(unit=None, start=evaluator.start[i], fixed=True, doc=_doc(v)))
    for name in evaluator.inputs:
        fields[name] = (_identifier(name), Input(start=_start(fmu.variable(name)), doc=_doc(fmu.variable(name))))
    for name in evaluator.outputs:
        if name not in fields:
            fields[name] = (_identifier(name), Output(doc=_doc(fmu.variable(name))))
    identifiers = [f for f, _ in fields.values()]
    if len(set(identifiers)) != len(identifiers):
        raise FmuError(f"{fmu.path.name}: two variables would have one name in Python: {', '.join(identifiers)}")
    boxes = [_black_box(evaluator, k, f"{fmu.name}_{k}") for k in range(len(evaluator.unknowns))]

    def equations(self: Any) -> Any:
        arguments = (time, *(getattr(self, fields[n][0]) for n in (*evaluator.states, *evaluator.inputs)))
        n = len(evaluator.states)
        for state, box in zip(evaluator.states, boxes[:n], strict=True):
            yield der(getattr(self, fields[state][0])) == box(*arguments)
        for output, box in zip(evaluator.outputs, boxes[n:], strict=True):
            if output not in evaluator.states:
                yield getattr(self, fields[output][0]) == box(*arguments)

    namespace: dict[str, Any] = {
        "__module__": __name__, "__doc__": f"The functional mock-up unit {fmu.path.name}.", "equations": equations,
        **{f: d for f, d in fields.values()}, "__annotations__": {f: type(d) for f, d in fields.values()},
    }  # fmt: skip
    return new_class(_identifier(fmu.name), (Component,), None, lambda ns: ns.update(namespace))()


def _identifier(name: str) -> str:
    """A name that Python takes."""
    text = "".join(c if c.isalnum() else "_" for c in name).strip("_")
    return text if text and not text[0].isdigit() else f"v_{text}"


def _doc(variable: Any) -> str:
    unit = f" [{variable.unit}]" if variable.unit else ""
    return f"{variable.description or variable.name}{unit}"


def _start(variable: Any) -> float:
    return 0.0 if variable.start is None else float(variable.start)
