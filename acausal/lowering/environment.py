"""Values of variables while a schedule is traced: whole families as arrays, single variables as scalars."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..language.template import Ints

RUNS = 12
"""A gather of up to this many contiguous runs becomes slices and one concatenation; more need an index array."""


class Environment:
    """Where each variable's value is: (piece, position), pieces being one-dimensional arrays or scalars."""

    def __init__(self, n: int, jnp: Any) -> None:
        self.jnp = jnp
        self.piece = np.full(n, -1, np.int32)
        self.position = np.zeros(n, np.int64)
        self.pieces: list[Any] = []
        self.cache: dict[int, Any] = {}

    def put(self, ids: Ints, value: Any) -> None:
        """Variables `ids` have the elements of the one-dimensional array `value`."""
        self.piece[ids] = len(self.pieces)
        self.position[ids] = np.arange(len(ids))
        self.pieces.append(value)

    def put_scalar(self, index: int, value: Any) -> None:
        """Variable `index` has the scalar `value`."""
        self.piece[index] = len(self.pieces)
        self.pieces.append(value)
        self.cache[index] = value

    def scalar(self, index: int) -> Any:
        """Value of one variable."""
        if index not in self.cache:
            piece = int(self.piece[index])
            if piece < 0:
                raise KeyError(f"variable {index} is used before it is computed")
            array = self.pieces[piece]
            self.cache[index] = array if self.jnp.ndim(array) == 0 else array[int(self.position[index])]
        return self.cache[index]

    def gather(self, ids: Ints) -> Any:
        """Values of several variables, one-dimensional (a scalar if they are all the same variable)."""
        if len(ids) == 1 or (ids == ids[0]).all():
            return self.scalar(int(ids[0]))
        return self._collect(self.piece[ids], self.position[ids])

    def _collect(self, piece: Any, position: Ints) -> Any:
        if (piece < 0).any():
            raise KeyError("a variable is used before it is computed")
        stride = np.diff(position)
        jump = (np.diff(piece) != 0) | (stride != (stride[0] if len(stride) else 1))
        if not jump.any():
            return self._slice(int(piece[0]), position)
        cuts = np.flatnonzero((np.diff(piece) != 0) | (stride != 1)) + 1
        if len(cuts) < RUNS:
            parts = [
                self._slice(int(piece[a]), position[a:b])
                for a, b in zip(np.r_[0, cuts].tolist(), np.r_[cuts, len(piece)].tolist(), strict=True)
            ]
            return self.jnp.concatenate([self.jnp.atleast_1d(p) for p in parts])
        return self._index(piece, position)

    def _slice(self, piece: int, position: Ints) -> Any:
        array = self.pieces[piece]
        if self.jnp.ndim(array) == 0:
            return self.jnp.broadcast_to(array, (len(position),)) if len(position) > 1 else array
        first, n = int(position[0]), len(position)
        if n == 1:
            return array[first : first + 1]
        step = int(position[1] - position[0])
        if step == 0:
            return self.jnp.broadcast_to(array[first], (n,))
        if step < 0:
            return array[int(position[-1]) : first + 1 : -step][::-1]
        if first == 0 and step == 1 and n == array.shape[0]:
            return array
        return array[first : first + (n - 1) * step + 1 : step]

    def _index(self, piece: Any, position: Ints) -> Any:
        used = np.unique(piece)
        if len(used) == 1:
            return self.pieces[int(used[0])][position]
        arrays = [self.jnp.atleast_1d(self.pieces[int(k)]) for k in used]
        start = np.concatenate([[0], np.cumsum([a.shape[0] for a in arrays])])[:-1]
        offset = np.zeros(int(used[-1]) + 1, np.int64)
        offset[used] = start
        return self.jnp.concatenate(arrays)[position + offset[piece]]
