"""The result of a simulation: every variable of the model, by name or by object, computed when asked for."""

from __future__ import annotations

import functools
import sys
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from acausal.errors import SimulationError, UnknownNameError, nearest
from acausal.lowering.lowered import Lowered as CompiledSystem

from .cache import ById, cache_of, without_keeping

if TYPE_CHECKING:
    import pandas as pd
    import xarray as xr

    from .lowered import Lowered

KEEP_ALL = 4_000_000
"""Up to so many values all variables are computed at once and kept; beyond, each request computes what it returns."""


class Solution:
    """Trajectories of all variables of a model.

    `solution["cylinder.chamber.p"]` or `solution[crane.cylinder.chamber.p]` is an array of shape (n_t,); an array
    of components, `solution["cells.v"]`, gives (n_t, n). Inside JAX transformations the values are traced arrays.

    Attributes:
        system: the system that was simulated.
        t: times [s], shape (n_t,).
        x: states, shape (n_t, n_x).
        w: tearing variables of numerically solved blocks, shape (n_t, n_w).
        p: parameters, shape (n_p,).
        stats: counts (`steps`, `accepted`, `rejected`, `rhs`, `jacobians`), `compile_seconds`, `run_seconds`,
            `solver`, and where the solve ended: `t_end`.
        result: `"successful"`, or what ended the solve early.
        events: the events that occurred, in order (of a traced run they are not known).
        slots: what changes at events, shape (n_t, n_slots), or None where there are no events.
        strict: whether to refuse values that are not finite; not for runs with `throw=False` and traced ones.
    """

    strict: bool = False

    def __init__(
        self,
        system: Any,
        t: Any,
        x: Any,
        w: Any,
        p: Any,
        stats: Mapping[str, Any] | None = None,
        result: str = "successful",
        events: tuple[Any, ...] = (),
        lowered: Lowered | None = None,
        observe: Callable[..., Any] | None = None,
        slots: Any = None,
    ) -> None:
        self.system = system
        self.t, self.x, self.w, self.p = t, x, w, p
        self.stats: dict[str, Any] = dict(stats or {})
        self.result = result
        self.events = events
        self.lowered: Lowered = system.lowered if lowered is None else lowered
        self._observe = observe
        self.slots = slots
        self._all: Any = None
        self._reduced: Any = None
        register()

    def tree_flatten(self) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
        """Leaves: times, trajectories, parameters and the counts that are arrays."""
        import jax

        numbers = {k: v for k, v in self.stats.items() if isinstance(v, jax.Array)}
        fixed = tuple((k, v) for k, v in self.stats.items() if k not in numbers and k not in _RUN_ONLY)
        children = (self.t, self.x, self.w, self.p, numbers, self.slots)
        aux = ById(self.system), fixed, self.result, ById(self.lowered), ById(self._observe), ById(self.events)
        return children, aux

    @classmethod
    def tree_unflatten(cls, aux: tuple[Any, ...], children: tuple[Any, ...]) -> Solution:
        system, fixed, result, lowered, observe, events = aux
        t, x, w, p, numbers, slots = children
        made = object.__new__(cls)
        made.system, made.lowered, made.result, made.events = system.thing, lowered.thing, result, events.thing
        made.slots = slots
        made.t, made.x, made.w, made.p = t, x, w, p
        made.stats = {**dict(fixed), **numbers}
        made._observe = observe.thing
        made._all = made._reduced = None
        return made

    # ------------------------------------------------------------------ values

    def __getitem__(self, key: Any) -> Any:
        """Values of a variable, shape (n_t,), or of an array of variables, shape (n_t, n).

        Args:
            key: dotted name, a variable object of the model, or a list of either (stacked along the last axis).

        Raises:
            UnknownNameError: the model has no such variable; the nearest names are given.
            SimulationError: a value is not a finite number; names the time and the equation it comes from. The values
                themselves are to be had by `to_dataframe`, and from a run with `throw=False`.
        """
        values = self._get(key)
        if self.strict and not is_traced(values) and values.dtype.kind == "f" and not np.isfinite(values).all():
            raise SimulationError(self._not_finite(key, values))
        return values

    def _get(self, key: Any) -> Any:
        if isinstance(key, (list, tuple)):
            return self._stack([self._get(k) for k in key])
        if isinstance(key, str):
            column = _state_columns(self.system).get(key)
            if column is not None:
                return self._out(self.x[..., column])
        indices, sign = self._locate(key)
        values = self._values(indices)
        return self._out(values if isinstance(sign, int) and sign == 1 else values * sign)

    def reader(self) -> Callable[[Any], Any]:
        """A function that gives variables by their numbers in the vector of all, (n_t, n); concrete values only.

        For checks: the model is evaluated once, and what is found is not kept in the solution.
        """
        if self._observe is None or self._reduced is not None:
            return self._values
        reduced = functools.cache(self._observed)
        return lambda ids: self.system.lowered.expanded(reduced(), ids)

    def _observed(self) -> Any:
        """Variables of the reduced model, (n_t, n)."""
        assert self._observe is not None
        return self._observe(self.t, np.concatenate([self.x, self.w], axis=1))

    def _not_finite(self, key: Any, values: Any) -> str:
        """The first time at which a variable has no finite value, and the equation that this comes from."""
        where = ~np.isfinite(values.reshape(len(values), -1)).all(axis=1)
        k = int(np.argmax(where))
        name = ", ".join(label(one) for one in key) if isinstance(key, (list, tuple)) else label(key)
        lines = [f"`{name}` has no finite value at t = {float(self.t[k]):.9g} s."]
        diagnose = getattr(self.system, "diagnose_nonfinite", None)
        p = np.asarray(self.p[0] if isinstance(self.p, tuple) else self.p)
        if diagnose is not None:
            if self.slots is not None:
                p = p.copy()
                p[self.system.hybrid.slots] = self.slots[k]
            found = diagnose(float(self.t[k]), np.asarray(self.x[k]), np.asarray(self.w[k]), p)
            lines += [found] if found else []
        lines.append(
            "Often: a division by zero, or a square root or logarithm that leaves its domain; a quotient of two "
            "quantities that are both zero there is not determined by the equations."
        )
        return "\n".join(lines)

    def __contains__(self, key: Any) -> bool:
        try:
            self._locate(key)
        except UnknownNameError:
            return False
        return True

    def _locate(self, key: Any) -> tuple[Any, Any]:
        """Positions in the vector of all variables (an int or an integer array) and the sign of an alias."""
        try:
            found = self.system.index_of(key)
        except KeyError as error:
            if isinstance(error, UnknownNameError):
                raise
            name = label(key)
            raise UnknownNameError(f"The model has no variable `{name}`.{nearest(name, self.names)}") from None
        return found if isinstance(found, tuple) else (found, 1)

    def _values(self, indices: Any) -> Any:
        if self._traced or self.x.ndim != 2:
            if self.x.ndim != 2:
                raise ValueError(
                    "Take a single solution out of a batch first: `jax.tree.map(lambda a: a[0], solution)`."
                )
            return self._traced_values(indices)
        if self._observe is not None:
            if self._reduced is None:
                self._reduced = self._observed()
            return self.system.lowered.expanded(self._reduced, indices)
        import jax.numpy as jnp

        if self._all is None and self._size <= KEEP_ALL:
            everything = jnp.arange(self._n_all)
            self._all = np.asarray(self._at_all_times(everything))
        if self._all is not None:
            return self._all[:, indices]
        return self._at_all_times(jnp.asarray(indices))

    def _at_all_times(self, indices: Any) -> Any:
        held = None if self.slots is None else self.system.hybrid.slots
        return _observe(self.lowered, indices, self.t, self.x, self.w, self.p, self.slots, held)

    def _traced_values(self, indices: Any) -> Any:
        """Only what these variables need is traced."""
        import jax
        import jax.numpy as jnp

        ids, shape = np.ravel(np.asarray(indices)), np.shape(indices)
        from .inputs import DrivenLowered

        if not isinstance(self.lowered, (CompiledSystem, DrivenLowered)):
            return self._at_all_times(jnp.asarray(indices))
        observe = self.lowered.observe
        if self.slots is None:
            values = jax.vmap(lambda t, x, w: observe(t, x, w, self.p, ids))(self.t, self.x, self.w)
        else:
            held, p = self.system.hybrid.slots, self.p

            def one(t: Any, x: Any, w: Any, slots: Any) -> Any:
                return observe(t, x, w, _with_slots(p, held, slots), ids)

            values = jax.vmap(one)(self.t, self.x, self.w, self.slots)
        return jnp.reshape(values, (*values.shape[:1], *shape))

    @property
    def _n_all(self) -> int:
        """Number of all variables; found by tracing, which takes as long as a run."""
        import jax

        cache = cache_of(self.lowered)
        if "n_all" not in cache:
            shape = jax.eval_shape(self.lowered.observe, self.t[0], self.x[0], self.w[0], self.p)
            cache["n_all"] = shape.shape[0]
        return cache["n_all"]

    @property
    def _size(self) -> int:
        return len(self.t) * self._n_all

    @property
    def _traced(self) -> bool:
        return any(is_traced(leaf) for leaf in (self.t, self.x, self.w, self.p))

    def _out(self, values: Any) -> Any:
        return values if is_traced(values) else np.asarray(values)

    def _stack(self, columns: list[Any]) -> Any:
        columns = [c if c.ndim == 2 else c[:, None] for c in columns]
        if not any(is_traced(c) for c in columns):
            return np.concatenate(columns, axis=1)
        import jax.numpy as jnp

        return jnp.concatenate(columns, axis=1)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of all variables: states, algebraic variables, observed ones."""
        system = self.system
        return (*system.states, *system.algebraics, *system.observed)

    def __len__(self) -> int:
        return len(self.t)

    def __repr__(self) -> str:
        if self._traced or self.x.ndim != 2:
            return f"<Solution, {self.x.shape} states>"
        span = f"{self.t[0]:g} to {self.t[-1]:g} s, {len(self.t)} points" if len(self.t) else "empty"
        steps = self.stats.get("steps")
        return f"<Solution {span}, {self.x.shape[1]} states, {steps} steps, {self.result}>"

    # ------------------------------------------------------------------ export

    def to_dataframe(self, names: Iterable[Any] | None = None) -> pd.DataFrame:
        """A pandas frame, index `t` [s], one column a variable (an array variable: one column an element).

        Args:
            names: variables to take; default all. Units and descriptions are in `frame.attrs`.
        """
        import pandas as pd

        columns: dict[str, Any] = {}
        units: dict[str, str] = {}
        docs: dict[str, str] = {}
        for key in self.names if names is None else names:
            values, name = self._get(key), label(key)
            units[name], docs[name] = self.describe(key)
            if values.ndim == 1:
                columns[name] = values
            else:
                columns.update({f"{name}[{i}]": values[:, i] for i in range(values.shape[1])})
        frame = pd.DataFrame(columns, index=pd.Index(np.asarray(self.t), name="t"))
        frame.attrs = {"units": {"t": "s", **units}, "docs": docs}
        return frame

    def to_xarray(self, names: Iterable[Any] | None = None) -> xr.Dataset:
        """An xarray data set over the coordinate `t` [s]; `units` and `long_name` are attributes of each variable."""
        import xarray as xr

        data: dict[str, Any] = {}
        for key in self.names if names is None else names:
            values, name = self._get(key), label(key)
            unit, doc = self.describe(key)
            dims = ("t",) if values.ndim == 1 else ("t", f"{name} index")
            data[name] = (dims, values, {"units": unit, "long_name": doc or name})
        time = ("t", np.asarray(self.t), {"units": "s", "long_name": "time"})
        return xr.Dataset(data, coords={"t": time})

    def to_csv(self, path: str | Path, names: Iterable[Any] | None = None) -> Path:
        """Writes `t` and the variables as comma-separated values with a header of names; returns the path."""
        path = Path(path)
        self.to_dataframe(names).to_csv(path)
        return path

    def describe(self, key: Any) -> tuple[str, str]:
        """Unit and description of a variable, empty where the model gives none."""
        declaration = self.system.declaration_of(key)
        return getattr(declaration, "unit", None) or "", getattr(declaration, "doc", None) or ""

    def plot(self, *names: Any, ax: Any = None, **style: Any) -> Any:
        """Plots variables over time: one axis a unit, named in the legend, units on the axes.

        Args:
            names: names or variable objects; default the states.
            ax: matplotlib axis to draw on, for variables of one unit; default a new figure.
            style: passed to `Axes.plot`.

        Returns:
            The figure.
        """
        from matplotlib import pyplot

        groups: dict[str, list[Any]] = {}
        for key in names or self.system.states:
            groups.setdefault(self.describe(key)[0], []).append(key)
        if ax is None:
            figure, axes = pyplot.subplots(
                len(groups), 1, sharex=True, squeeze=False, figsize=(8, 1 + 2.2 * len(groups)), layout="constrained"
            )
            axes = list(axes[:, 0])
        elif len(groups) > 1:
            raise ValueError(
                f"One `ax` is for one unit; these variables have the units {', '.join(map(repr, groups))}."
            )
        else:
            figure, axes = ax.figure, [ax]
        for axis, (unit, keys) in zip(axes, groups.items(), strict=True):
            for key in keys:
                values, name = self._get(key), label(key)
                lines = [name] if values.ndim == 1 else [f"{name}[{i}]" for i in range(values.shape[1])]
                axis.plot(np.asarray(self.t), values, label=lines if len(lines) > 1 else lines[0], **style)
            axis.set_ylabel(f"[{unit}]" if unit else "")
            axis.grid(True, alpha=0.3)
            axis.legend(loc="best", fontsize="small")
        axes[-1].set_xlabel("t [s]")
        return figure


_registered: list[bool] = []


def register() -> None:
    """Make `Solution` known to JAX as a pytree, once, if JAX is loaded: results of the native engine do not need it."""
    if not _registered and "jax" in sys.modules:
        import jax

        _registered.append(True)
        jax.tree_util.register_pytree_node_class(Solution)


def is_traced(value: Any) -> bool:
    """Whether a value is traced by JAX."""
    if "jax" not in sys.modules:
        return False
    from jax.core import Tracer

    return isinstance(value, Tracer)


_RUN_ONLY = ("compile_seconds", "run_seconds")


def label(key: Any) -> str:
    """The name under which a variable is shown."""
    return key if isinstance(key, str) else str(getattr(key, "name", key))


def _state_columns(system: Any) -> dict[str, int]:
    """Column of each state, kept with the tuple of names it was made from."""
    return _columns(tuple(system.states))


@functools.lru_cache(maxsize=16)
def _columns(names: tuple[str, ...]) -> dict[str, int]:
    return {name: column for column, name in enumerate(names)}


def _with_slots(p: Any, held: slice, slots: Any) -> Any:
    """Parameters with the slots of events of one time."""
    return (p[0].at[held].set(slots), p[1]) if isinstance(p, tuple) else p.at[held].set(slots)


def _observe(
    lowered: Lowered, indices: Any, t: Any, x: Any, w: Any, p: Any, slots: Any = None, held: slice | None = None
) -> Any:
    """Variables at `indices` over all times, shape (n_t, *indices.shape), without keeping the others."""
    import jax

    from .jit import jit

    cache = cache_of(lowered)
    if "observe" not in cache:

        def values(lowered: Any, indices: Any, t: Any, x: Any, w: Any, p: Any, slots: Any) -> Any:
            def one(at: Any) -> Any:
                now = p if held is None else _with_slots(p, held, at[3])
                return lowered.observe(at[0], at[1], at[2], now)[indices]

            return jax.lax.map(one, (t, x, w, slots))

        cache["observe"] = jit(without_keeping(lowered, values))
    return cache["observe"](indices, t, x, w, p, slots)
