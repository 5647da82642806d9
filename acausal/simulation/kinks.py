"""Times at which the equations have kinks: the points of inputs and of tables over time.

No step goes beyond one, as a pulse between two evaluations would not be seen.
"""

from __future__ import annotations

from typing import Any

import equinox as eqx
import jax
import jax.numpy as jnp
from jax import Array

from acausal.lowering.time_tables import TimeTable
from acausal.symbolic.expr import Expr
from acausal.symbolic.traverse import evaluate

from .inputs import DrivenLowered, is_table


class Kinks(eqx.Module):
    """The kinks of a system with given parameters.

    Attributes:
        times: those of the inputs [s], in order (n,).
        p: the parameter vector, from which those of the tables follow.
        tables: the tables over time.
        direction: -1.0 for a run that goes backwards, whose time goes forwards from `-t0`.
    """

    times: Array
    p: Array
    tables: tuple[TimeTable, ...] = eqx.field(static=True)
    direction: Any = 1.0

    def reversed(self, direction: Any) -> Kinks:
        """For time times `direction`."""
        return Kinks(jnp.sort(self.times * direction), self.p, self.tables, self.direction * direction)

    def after(self, t: Any, least: Any) -> Array:
        """The next kink behind t; infinity where there is none.

        Args:
            t: time [s].
            least: the smallest step [s], above zero: a table that starts on one of its points crosses it in that step.
        """
        following = jnp.append(self.times, jnp.inf)[jnp.searchsorted(self.times, t + least, side="right")]
        for points, alike in self._alike().items():
            following = jnp.minimum(following, jnp.min(self._next(jnp.asarray(points), alike, t, least)))
        return following

    def _alike(self) -> dict[tuple[float, ...], list[TimeTable]]:
        """Tables by their points: those of many instances of a component are looked up together."""
        found: dict[tuple[float, ...], list[TimeTable]] = {}
        for table in self.tables:
            found.setdefault(table.points, []).append(table)
        return found

    def _next(self, x: Array, tables: list[TimeTable], t: Any, least: Any) -> Array:
        """Up to just before tables are read at their next points, and from there to just behind, (number of tables,).

        Within the steps between two points each table has one slope, also where a point moves with a parameter.
        """

        def leaf(node: Expr) -> Any:
            return self.direction * t if node.op == "time" else self.p[node.value]

        values = evaluate([e for table in tables for e in (table.argument, table.slope)], leaf, jnp)
        at, slope = (jnp.stack([jnp.asarray(v, float) for v in values[k::2]]) for k in (0, 1))
        slope = slope * self.direction
        first = jnp.searchsorted(x, at, side="right")
        x = jnp.concatenate([jnp.array([-jnp.inf]), x, jnp.array([jnp.inf])])
        moving = slope != 0.0
        rate = jnp.where(moving, slope, 1.0)
        point = t + (jnp.where(slope > 0.0, x[first + 1], x[first]) - at) / rate
        rounding = 1e-15 * (jnp.abs(point) + jnp.abs(at / rate))
        before, across = point - rounding, t + jnp.maximum(least, point - t + rounding)
        return jnp.where(moving, jnp.where(before - t > least, before, across), jnp.inf)


def has_kinks(lowered: Any) -> bool:
    """Whether a system has kinks, driven or not."""
    return bool(lowered.time_tables) or (isinstance(lowered, DrivenLowered) and any(map(is_table, lowered.signals)))


def kinks(lowered: Any, p: Any) -> Kinks | None:
    """The kinks of a system; None if there are none.

    Args:
        lowered: a system, driven or not.
        p: its parameters; of a driven one a tuple that begins with the parameter vector.
    """
    if not has_kinks(lowered):
        return None
    driven = isinstance(lowered, DrivenLowered)
    times = [d[0] for signal, d in zip(lowered.signals, p[1], strict=True) if is_table(signal)] if driven else []
    vector = jnp.asarray(p[0] if isinstance(p, tuple) else p)
    found = Kinks(jnp.sort(jnp.concatenate([jnp.zeros(0), *times])), vector, lowered.time_tables)
    return jax.lax.stop_gradient(found)
