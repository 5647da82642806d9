"""A model-exchange FMU as a component: its derivatives and outputs are opaque functions of time, states and inputs."""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Callable, Mapping
from types import new_class
from typing import Any

import numpy as np

from ..errors import AcausalError, nearest
from ..language.blackbox import function
from ..language.component import Component, Connector
from ..language.declarations import Input, Output, Variable
from ..language.functions import der, time
from .fmu import Fmu, FmuError, get_reals, set_parameters, set_reals, start_of

_STEP = 6e-6
"""Relative step of central differences (about the cube root of the rounding error)."""
_WIDE_STEP = 1e-3
"""The same for second derivatives, from first ones that are themselves differences."""


class _Evaluator:
    """One instance of the unit, evaluated at points (t, states, inputs); the last point is kept.

    Attributes:
        alone: held by who uses the instance; XLA may call from several threads.
        places: by unknown, which entries of a point it depends on: the time, and what the model description tells.
    """

    def __init__(self, fmu: Fmu, parameters: Mapping[str, float]) -> None:
        self.fmu = fmu
        self.instance = instance = fmu.instantiate("me")
        entries = [d.variable if hasattr(d, "variable") else d for d in fmu.description.derivatives]
        arrays = [str(d.name) for d in entries if d.dimensions]
        if arrays:
            raise FmuError(f"{fmu.path.name} has states in arrays ({', '.join(arrays)}), which a component cannot have")
        try:
            self._begin(instance, fmu, parameters)
        except AcausalError:
            raise
        except Exception as error:  # FMPy raises plain exceptions
            raise FmuError(f"{fmu.path.name} could not be initialized: {error}") from error
        self.rates = [int(d.valueReference) for d in entries]
        self.states = [str(d.derivative.name) for d in entries]
        # a discrete input may be set in event mode only
        self.inputs = tuple(n for n in fmu.names("input") if fmu.variable(n).variability != "discrete")
        self.outputs = fmu.names("output")
        self.unknowns = [*self.rates, *(fmu.variable(n).valueReference for n in self.outputs)]
        self.state_references = [fmu.variable(n).valueReference for n in self.states]
        self.knowns = [*self.state_references, *(fmu.variable(n).valueReference for n in self.inputs)]
        self.start = get_reals(instance, self.state_references)
        self.places = self._places()
        self.present = np.array([0.0, *self.start, *(start_of(fmu.variable(n)) for n in self.inputs)])
        self.point: bytes | None = None
        self.alone = threading.Lock()
        self.values = np.zeros(len(self.unknowns))
        self.directional = fmu.directional

    def _places(self) -> list[list[int]]:
        names = ["", *self.states, *self.inputs]
        told = {u.variable.name: u.dependencies for u in self.fmu.description.outputs if u.variable is not None}
        rows = [getattr(d, "dependencies", None) for d in self.fmu.description.derivatives]
        rows += [told.get(n) for n in self.outputs]
        places: list[list[int]] = []
        for row in rows:
            used = names if row is None else {str(d.name) for d in row}
            places.append([i for i, n in enumerate(names) if i == 0 or n in used])
        return places

    def at(self, k: int, arguments: Any) -> np.ndarray:
        """The point for what unknown k depends on; other entries, which do not count, stay as they were."""
        self.present[self.places[k]] = arguments
        return self.present.copy()

    @staticmethod
    def _begin(instance: Any, fmu: Fmu, parameters: Mapping[str, float]) -> None:
        """To continuous-time mode at time zero."""
        set_parameters(instance, fmu, parameters)
        if fmu.version == "2.0":
            instance.setupExperiment(startTime=0.0)
            instance.enterInitializationMode()
        else:
            instance.enterInitializationMode(startTime=0.0)
        instance.exitInitializationMode()
        again = True
        while again:
            # again, end of the simulation, nominal values changed, states changed, a next event by time is known, when
            told = instance.newDiscreteStates() if fmu.version == "2.0" else instance.updateDiscreteStates()
            again = bool(told[0])
            if told[4]:
                raise FmuError(
                    f"{fmu.path.name} has events in time (the next at t = {told[5]:.6g} s), which a component cannot "
                    "pass on; use it in a co-simulation"
                )
        instance.enterContinuousTimeMode()

    def _go(self, point: np.ndarray) -> None:
        n = len(self.states)
        self.instance.setTime(float(point[0]))
        if n:
            self.instance.setContinuousStates((ctypes.c_double * n)(*point[1 : n + 1]), n)
        set_reals(self.instance, self.knowns[n:], [float(v) for v in point[n + 1 :]])

    def _derivatives(self) -> list[float]:
        """Of the states; some units compute them in this call only, not for a read of the variables."""
        n = len(self.states)
        found = (ctypes.c_double * n)()
        if n and self.fmu.version == "2.0":
            self.instance.getDerivatives(found, n)
        elif n:
            self.instance.getContinuousStateDerivatives(found, n)
        return list(found)

    def evaluate(self, point: np.ndarray) -> np.ndarray:
        """Derivatives of the states, then outputs, at (t, states, inputs)."""
        key = point.tobytes()
        if key != self.point:
            self.point = None
            try:
                self._go(point)
                outputs = get_reals(self.instance, self.unknowns[len(self.states) :])
                self.values = np.array([*self._derivatives(), *outputs])
            except Exception as error:  # FMPy raises plain exceptions
                raise FmuError(f"{self.fmu.path.name} failed at t = {point[0]:.6g} s: {error}") from error
            self.point = key
        return self.values

    def gradient(self, k: int, point: np.ndarray) -> np.ndarray:
        """Derivatives of unknown k with respect to (t, states, inputs)."""
        out = np.zeros(len(point))
        first = 0
        if self.directional:
            self._go(point)
            self.point = None
            for i in self.places[k][1:]:
                known = self.knowns[i - 1]
                out[i] = self.instance.getDirectionalDerivative([self.unknowns[k]], [known], [1.0])[0]
            first = len(point)  # the derivative with respect to time is left to differences
        for i in self.places[k]:
            if 0 < i < first:
                continue
            step = _STEP * max(1.0, abs(point[i]))
            ahead, behind = point.copy(), point.copy()
            ahead[i] += step
            behind[i] -= step
            out[i] = (self.evaluate(ahead)[k] - self.evaluate(behind)[k]) / (2 * step)
        return out


    def curvature(self, k: int, point: np.ndarray) -> np.ndarray:
        """Second derivatives of unknown k with respect to what it depends on, by differences of the first ones."""
        places = self.places[k]
        out = np.zeros((len(places), len(places)))
        relative = _WIDE_STEP * (0.1 if self.directional else 1.0)
        for column, i in enumerate(places):
            step = relative * max(1.0, abs(point[i]))
            ahead, behind = point.copy(), point.copy()
            ahead[i] += step
            behind[i] -= step
            out[:, column] = (self.gradient(k, ahead) - self.gradient(k, behind))[places] / (2 * step)
        return 0.5 * (out + out.T)


def _black_box(evaluator: _Evaluator, k: int, name: str) -> Any:
    """Unknown k of the unit as a function for equations, with its derivatives."""

    def host_value(*args: Any) -> np.ndarray:
        with evaluator.alone:
            return np.asarray(evaluator.evaluate(evaluator.at(k, args))[k])

    def host_gradient(*args: Any) -> np.ndarray:
        with evaluator.alone:
            return evaluator.gradient(k, evaluator.at(k, args))[evaluator.places[k]]

    def host_curvature(*args: Any) -> np.ndarray:
        with evaluator.alone:
            return evaluator.curvature(k, evaluator.at(k, args))

    made: list[Callable[..., Any]] = []

    def call(*args: Any) -> Any:
        if not made:
            made.append(_differentiable(host_value, host_gradient, host_curvature))
        return made[0](*args)

    return function(call, name=name)


def _differentiable(
    value: Callable[..., Any], gradient: Callable[..., Any], curvature: Callable[..., Any]
) -> Callable[..., Any]:
    """A function of scalars that runs outside of JAX, and can be differentiated twice."""
    import jax
    import jax.numpy as jnp

    def outside(function: Callable[..., Any], rank: int, args: Any) -> Any:
        shape = jax.ShapeDtypeStruct((len(args),) * rank, float)
        return jax.pure_callback(function, shape, *args, vmap_method="sequential")

    def along(tangents: Any) -> Any:
        return jnp.stack([jnp.asarray(t, float) for t in tangents])

    @jax.custom_jvp
    def slopes(*args: Any) -> Any:
        return outside(gradient, 1, args)

    @slopes.defjvp
    def slopes_jvp(primals: Any, tangents: Any) -> Any:
        return slopes(*primals), outside(curvature, 2, primals) @ along(tangents)

    @jax.custom_jvp
    def f(*args: Any) -> Any:
        return outside(value, 0, args)

    @f.defjvp
    def f_jvp(primals: Any, tangents: Any) -> Any:
        return f(*primals), jnp.sum(slopes(*primals) * along(tangents))

    return f


Adapters = Mapping[str, tuple[type[Connector], Mapping[str, str]]]
"""By name of a connector: its class, and the unit's variable that each of its variables equals ("-name": negative)."""


def fmu_component(fmu: Fmu, parameters: Mapping[str, float], connectors: Adapters) -> Component:
    """A component whose states and outputs come from the unit.

    Raises:
        FmuError: it does not offer model exchange, has events or arrays, or does not fit the connectors.
    """
    if "me" not in fmu.kinds:
        raise FmuError(f"{fmu.path.name} does not offer model exchange; use it in a co-simulation")
    if int(fmu.description.numberOfEventIndicators or 0):
        raise FmuError(f"{fmu.path.name} has state events, which a component cannot pass on; use it in a co-simulation")
    evaluator = _Evaluator(fmu, parameters)
    bound = _bound(evaluator, connectors)
    fields: dict[str, tuple[str, Any]] = {}
    for i, state in enumerate(evaluator.states):
        v = fmu.variable(state)
        fields[state] = (_identifier(state), Variable(unit=None, start=evaluator.start[i], fixed=True, doc=_doc(v)))
    for name in evaluator.inputs:
        kind = Variable if name in bound else Input
        fields[name] = (_identifier(name), kind(start=start_of(fmu.variable(name)), doc=_doc(fmu.variable(name))))
    for name in evaluator.outputs:
        if name not in fields:
            fields[name] = (_identifier(name), Output(doc=_doc(fmu.variable(name))))
    ports: dict[str, Any] = {name: cls() for name, (cls, _) in connectors.items()}
    identifiers = [*(f for f, _ in fields.values()), *ports]
    if len(set(identifiers)) != len(identifiers):
        raise FmuError(f"{fmu.path.name}: two variables would have one name in Python: {', '.join(identifiers)}")
    boxes = [_black_box(evaluator, k, f"{fmu.name}_{k}") for k in range(len(evaluator.unknowns))]

    def equations(self: Any) -> Any:
        point = (time, *(getattr(self, fields[n][0]) for n in (*evaluator.states, *evaluator.inputs)))
        values = [box(*(point[i] for i in places)) for box, places in zip(boxes, evaluator.places, strict=True)]
        n = len(evaluator.states)
        for state, value in zip(evaluator.states, values[:n], strict=True):
            yield der(getattr(self, fields[state][0])) == value
        for output, value in zip(evaluator.outputs, values[n:], strict=True):
            if output not in evaluator.states:
                yield getattr(self, fields[output][0]) == value
        for port, (_, pairs) in connectors.items():
            for name, of in pairs.items():
                value = getattr(self, fields[of.removeprefix("-")][0])
                yield getattr(getattr(self, port), name) == (-value if of.startswith("-") else value)

    namespace: dict[str, Any] = {
        "__module__": __name__, "__doc__": f"The functional mock-up unit {fmu.path.name}.", "equations": equations,
        **{f: d for f, d in fields.values()}, **ports,
        "__annotations__": {f: type(d) for f, d in (*fields.values(), *ports.items())},
    }  # fmt: skip
    return new_class(_identifier(fmu.name), (Component,), None, lambda ns: ns.update(namespace))()


def _bound(evaluator: _Evaluator, connectors: Adapters) -> set[str]:
    """Inputs and outputs that stand for variables of connectors.

    Raises:
        FmuError: a variable of a connector that is missing or too many, or a name that is no input or output.
    """
    used: set[str] = set()
    for port, (cls, pairs) in connectors.items():
        declared = set(cls._declarations)
        if declared != set(pairs):
            raise FmuError(
                f"connector `{port}`: a `{cls.__name__}` has {', '.join(cls._declarations)}; give the unit's variable "
                f"for each, not for {', '.join(pairs) or 'none'}"
            )
        for of in pairs.values():
            name = of.removeprefix("-")
            known = (*evaluator.inputs, *evaluator.outputs, *evaluator.states)
            if name not in known:
                file = evaluator.fmu.path.name
                raise FmuError(f"connector `{port}`: {file} has no input or output `{name}`.{nearest(name, known)}")
            if name in used and name in evaluator.inputs:
                raise FmuError(f"connector `{port}`: the input `{name}` is given twice")
            used.add(name)
    return used


def _identifier(name: str) -> str:
    """A name that Python takes."""
    text = "".join(c if c.isalnum() else "_" for c in name).strip("_")
    return text if text and not text[0].isdigit() else f"v_{text}"


def _doc(variable: Any) -> str:
    unit = f" [{variable.unit}]" if variable.unit else ""
    return f"{variable.description or variable.name}{unit}"

