r"""Which parameters the data determine, and which cannot be told apart.

The sensitivities of all residuals, $\tilde S_{ij} = \partial r_i / \partial u_j$ with u the parameter relative to its
own value (or to its bounds if it is zero), are decomposed, $\tilde S = U \Sigma V^T$ (singular vectors of the scaled
Fisher matrix $\tilde S^T \tilde S$). The standard deviation of the combination $v_k$ is $1/\sigma_k$. The collinearity
of the columns is judged after each is divided by its length (Brun, Reichert and Kuensch, Water Resources Research 37,
2001, eq. 15).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..language.template import Floats

NO_INFLUENCE = 1e-7
"""A column this much shorter than the longest has no influence."""
COLLINEAR = 1e3
"""Collinearity index from which columns cannot be told apart whatever the noise: sensitivities have that accuracy."""
UNCERTAIN = 1.0
"""Relative standard deviation of a combination of parameters from which the data do not determine it."""
NAMED = 0.3
"""Part of a parameter in a combination (of unit length) from which it is named."""
CORRELATED = 0.95
"""Correlation from which a pair is mentioned."""


@dataclass(frozen=True, slots=True, eq=False)
class Identifiability:
    """What the data say about the parameters; prints as text.

    Attributes:
        names: of the parameters.
        singular_values: (n,) of the scaled sensitivities, descending; 1 over each is the relative standard deviation of
            its combination.
        combinations: (n, n), row k is the combination of singular value k.
        collinearity: collinearity index of all parameters together; above 20 one is hard to tell from the others.
        correlation: (n, n) of the estimates.
        without_influence: parameters that do not change the measured signals.
        inseparable: groups of parameters of which the data only determine a combination.
        correlated: pairs whose estimates are correlated, with the correlation.
    """

    names: tuple[str, ...]
    singular_values: Floats
    combinations: Floats
    collinearity: float
    correlation: Floats
    without_influence: tuple[str, ...]
    inseparable: tuple[tuple[str, ...], ...]
    correlated: tuple[tuple[str, str, float], ...]

    @property
    def identifiable(self) -> bool:
        """Whether the data determine every parameter."""
        return not self.without_influence and not self.inseparable

    def __str__(self) -> str:
        lines = [f"`{name}` has no influence on the measured signals." for name in self.without_influence]
        for group in self.inseparable:
            quoted = " and ".join(f"`{name}`" for name in group)
            if len(group) == 1:
                lines.append(f"The data hardly determine {quoted}: its relative standard deviation exceeds 100 %.")
            else:
                lines.append(f"{quoted} cannot be told apart: the data only determine a combination of them.")
        if lines:
            lines.append("Fix one of each group, give it a prior, or measure a signal that tells them apart.")
        else:
            lines.append("The data determine every parameter.")
        pairs = (f"`{a}` and `{b}` are correlated: {c:+.3f}." for a, b, c in self.correlated)
        worst = 1.0 / self.singular_values[-1] if self.singular_values[-1] > 0 else np.inf
        lines += [*pairs, f"Collinearity index {self.collinearity:.3g}; worst combination uncertain by {worst:.2g}."]
        return "\n".join(lines)

    __repr__ = __str__


def identify(names: tuple[str, ...], sensitivity: Floats, scale: Floats, correlation: Floats) -> Identifiability:
    """Analysis of sensitivities.

    Args:
        names: of the parameters.
        sensitivity: of the residuals (in units of the noise) by the parameters, (n_samples, n).
        scale: value that each parameter is taken relative to, (n,).
        correlation: of the estimates, (n, n).
    """
    scaled = sensitivity * scale
    length = np.linalg.norm(scaled, axis=0)
    active = length > NO_INFLUENCE * max(float(length.max()), 1e-300)
    silent = tuple(n for n, on in zip(names, active, strict=True) if not on)
    _, values, rows = np.linalg.svd(scaled, full_matrices=True)
    values = np.concatenate([values, np.zeros(len(names) - len(values))])
    kept = np.flatnonzero(active)
    groups: list[tuple[str, ...]] = []
    collinearity = 1.0
    if len(kept):
        _, small, directions = np.linalg.svd(scaled[:, kept] / length[kept], full_matrices=True)
        small = np.concatenate([small, np.zeros(len(kept) - len(small))])
        collinearity = float(1.0 / max(small[-1], 1e-300))
        alike = [(directions[k] / length[kept], small[k] * COLLINEAR < 1.0) for k in range(len(kept))]
        _, certain, axes = np.linalg.svd(scaled[:, kept], full_matrices=True)
        certain = np.concatenate([certain, np.zeros(len(kept) - len(certain))])
        vague = [(axes[k], certain[k] * UNCERTAIN < 1.0) for k in range(len(kept))]
        for direction, bad in [*alike, *vague]:
            part = np.abs(direction) / np.linalg.norm(direction)
            group = tuple(names[kept[j]] for j in np.flatnonzero(part > NAMED))
            if bad and not any(set(group) <= set(g) for g in groups):
                groups.append(group)
    pairs = tuple(
        (names[i], names[j], float(correlation[i, j]))
        for i in range(len(names))
        for j in range(i)
        if abs(correlation[i, j]) > CORRELATED
    )
    return Identifiability(names, values, rows, collinearity, correlation, silent, tuple(groups), pairs)
