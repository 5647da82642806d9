"""Frames: where the parts of a mechanism touch, and the algebra of their orientations.

A vector is resolved in a frame: its elements are its projections onto the frame's axes. ``T`` carries elements in the
world frame to elements in the frame, ``v2 = T v1``, and its rows are the frame's axes; ``w`` is the frame's absolute
angular velocity, resolved in the frame itself, so that ``dT/dt = -[w x] T``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from acausal import (
    PI,
    Connector,
    DeclarationError,
    Equations,
    Expr,
    Flow,
    Matrix,
    Overdetermined,
    Potential,
    Vector,
    assert_,
    atan2,
    cos,
    cross,
    defining,
    derivative_rule,
    dot,
    floor,
    matrix,
    noevent,
    norm,
    sin,
    vector,
    where,
)
from acausal.language.events import Assert
from acausal.language.vectors import VectorEquation

ZEROS = (0.0, 0.0, 0.0)
TINY = 1e-15
"""Smallest length that counts as one [m]."""
PARALLEL = 1e-5
"""Directions with a smaller sine of the angle between them are parallel."""
ALONG = 1e-12
"""With a smaller sine of the angle between them, the first axis of a sequence of rotations is along the third."""
IDENTITY = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class Orientation(Overdetermined):
    """Orientation of a frame against the world: twelve quantities of three degrees of freedom.

    Source: Modelica.Mechanics.MultiBody.Frames.Orientation.
    """

    loop_advice = (
        "If the joints of a loop are hinges with parallel axes (or slide across them), the constraints across that "
        "plane are there several times: replace one `Revolute` of each planar loop by `RevolutePlanarLoopConstraint`.\n"
        "If the axes of a loop meet in one point (two shafts in fixed bearings with a `Universal` between them), the "
        "constraints of position are: put `Prismatic` joints in different directions, two of them across the shaft, "
        "between one of the bearings and what holds it, until the loop has seven freedoms. They stay where they are.\n"
        "Any other loop needs joints with seven freedoms in all to move (Revolute and Prismatic have one, Universal "
        "and Cylindrical two, Spherical three); one with fewer that moves by its measures alone has to be given them."
    )
    T: Matrix = Matrix(Potential(unit="1", doc="transformation matrix from the world frame to this frame"))
    w: Vector = Vector(Potential(unit="rad/s", doc="absolute angular velocity, resolved in this frame"))

    def equations(self) -> Equations:
        yield derivative_rule(self.T, -(skew(self.w) @ self.T))

    def equality_constraint(self, other: Orientation) -> Vector:
        """Small angles of the rotation from one to the other about the three axes."""
        return rotation_residual(self.T, other.T)

    def equality_assertion(self, other: Orientation) -> Assert:
        """The other roots are half a turn off."""
        return same_sense(self.T, other.T)


class Frame(Connector):
    """Coordinate system fixed to a part, with one cut force and one cut torque.

    Source: Modelica.Mechanics.MultiBody.Interfaces.Frame.
    """

    r_0: Vector = Vector(Potential(unit="m", state_select="avoid", doc="position of the origin in the world frame"))
    R: Orientation = Orientation()
    f: Vector = Vector(Flow(unit="N", doc="cut force, resolved in the frame"))
    t: Vector = Vector(Flow(unit="N*m", doc="cut torque, resolved in the frame"))


@dataclass(frozen=True, slots=True, eq=False)
class Rotation:
    """An orientation that is computed: matrix `T` and angular velocity `w` of a second frame against a first one."""

    T: Matrix
    w: Vector


AnyRotation = Orientation | Rotation


def resolve1(R: AnyRotation, v2: Vector) -> Vector:
    """Elements in frame 1 of a vector given in frame 2."""
    return R.T.transpose() @ v2


def resolve2(R: AnyRotation, v1: Vector) -> Vector:
    """Elements in frame 2 of a vector given in frame 1."""
    return R.T @ v1


def resolve_relative(v1: Vector, R1: AnyRotation, R2: AnyRotation) -> Vector:
    """Elements in frame 2 of a vector given in frame 1, both with their absolute orientations."""
    return resolve2(R2, resolve1(R1, v1))


def absolute_rotation(R1: AnyRotation, R_rel: Rotation) -> Rotation:
    """Frame 2 from frame 1 and the rotation from frame 1 to frame 2."""
    return Rotation(R_rel.T @ R1.T, resolve2(R_rel, R1.w) + R_rel.w)


def inverse_rotation(R: Rotation) -> Rotation:
    """The rotation from frame 2 to frame 1."""
    return Rotation(R.T.transpose(), -resolve1(R, R.w))


def relative_rotation(R1: AnyRotation, R2: AnyRotation) -> Rotation:
    """The rotation from frame 1 to frame 2 of two absolute orientations."""
    T = R2.T @ R1.T.transpose()
    return Rotation(T, R2.w - T @ R1.w)


def equal(R: Orientation, other: AnyRotation) -> list[VectorEquation]:
    """Equations by which an orientation is what was computed."""
    return [defining(R.T == other.T), R.w == other.w]


def unit_vector(n: Vector) -> Vector:
    """Vector of length one in the direction of `n`."""
    return n / norm(n)


def planar_basis(e: Vector) -> tuple[Vector, Vector]:
    """Two unit vectors across `e`, which has length one, and across each other."""
    first = abs(e[0]) > 0.1
    second = abs(e[1]) > 0.1
    otherwise = vector(where(second, 0.0, 1.0), 0.0, where(second, 1.0, 0.0))
    other = vector(*(where(first, x, o) for x, o in zip((0.0, 1.0, 0.0), otherwise, strict=True)))
    y = unit_vector(cross(e, other))
    return cross(y, e), y


def skew(v: Vector) -> Matrix:
    """Matrix of the vector product, ``skew(v) u = v x u``."""
    x, y, z = v
    return matrix((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0))


def planar_rotation(e: Vector, phi: Any, w: Any) -> Rotation:
    """Rotation by `phi` about the axis `e` (of length one), ``T = e e' + (I - e e') cos(phi) - [e x] sin(phi)``."""
    c, s = cos(phi), sin(phi)
    outer = matrix(*([a * b for b in e] for a in e))
    cosines = matrix(*IDENTITY) - outer
    return Rotation(outer + cosines * c - skew(e) * s, e * w)


def axis_rotation(axis: int, phi: Any) -> Matrix:
    """Rotation by `phi` about coordinate axis 1, 2 or 3."""
    c, s = cos(phi), sin(phi)
    if axis == 1:
        return matrix((1.0, 0.0, 0.0), (0.0, c, s), (0.0, -s, c))
    if axis == 2:
        return matrix((c, 0.0, -s), (0.0, 1.0, 0.0), (s, 0.0, c))
    return matrix((c, s, 0.0), (-s, c, 0.0), (0.0, 0.0, 1.0))


def coordinate_axis(axis: int) -> Vector:
    """Unit vector along coordinate axis 1, 2 or 3."""
    return vector(*(1.0 if i == axis else 0.0 for i in (1, 2, 3)))


def checked_sequence(sequence: Sequence[float], *, all_orientations: bool) -> tuple[int, ...]:
    """Numbers of the three axes of a sequence of rotations; for all orientations, neighbours have to differ.

    Raises:
        DeclarationError: they are something else.
    """
    axes = tuple(int(axis) for axis in sequence)
    if len(axes) != 3 or not {*axes} <= {1, 2, 3}:
        raise DeclarationError(f"a rotation sequence is three axes, each 1, 2 or 3, not {tuple(sequence)}")
    if all_orientations and (axes[0] == axes[1] or axes[1] == axes[2]):
        raise DeclarationError(f"the rotation sequence {axes} does not give all orientations: neighbours must differ")
    return axes


def axes_rotations(sequence: Sequence[float], angles: Vector, rates: Vector | None = None) -> Rotation:
    """Rotations one after the other about the (turned) axes numbered in `sequence`, as Cardan or Euler angles are."""
    axes = checked_sequence(sequence, all_orientations=rates is not None)
    first, second, third = (axis_rotation(axis, phi) for axis, phi in zip(axes, angles, strict=True))
    T = third @ (second @ first)
    if rates is None:
        return Rotation(T, vector(*ZEROS))
    e = [coordinate_axis(axis) for axis in axes]
    w = e[2] * rates[2] + third @ (e[1] * rates[1]) + third @ (second @ (e[0] * rates[0]))
    return Rotation(T, w)


def rotation_angles(T: Matrix, sequence: Sequence[float], guess: Any) -> Vector:
    """Angles about the axes numbered in `sequence` that give the matrix: the inverse of `axes_rotations`.

    Of both solutions, the one whose first angle is nearer to `guess`. The third axis is across the turned second one,
    which gives the first angle; where the first axis is along the third, only the sum or the difference of their
    angles is determined, and the first one is `guess`.
    """
    first, second, third = map(coordinate_axis, checked_sequence(sequence, all_orientations=True))
    axis = T.transpose() @ third
    a, b = dot(second, axis), dot(cross(first, second), axis)
    along = noevent((abs(a) <= ALONG) & (abs(b) <= ALONG))
    y, x = where(along, sin(guess), a), where(along, cos(guess), -b)
    one, other = atan2(y, x), atan2(-y, -x)
    phi_1 = noevent(where(abs(one - guess) <= abs(other - guess), one, other))
    rest = T @ axis_rotation(int(sequence[0]), phi_1).transpose()  # about the second axis, then the third
    across = cross(third, second)
    phi_2 = atan2(-dot(rest.transpose() @ third, across), dot(rest.transpose() @ third, third))
    phi_3 = atan2(-dot(rest @ second, across), dot(rest @ second, second))
    return vector(phi_1, phi_2, phi_3)


def nearest_angles(T: Matrix, sequence: Sequence[float], guess: Vector) -> Vector:
    """Angles about the axes numbered in `sequence` that give the matrix: of all solutions, the one nearest to `guess`.

    That is each angle within half a turn of its guess.
    """
    one = rotation_angles(T, sequence, guess[0])
    other = vector(one[0] + PI, (0.0 if sequence[0] == sequence[2] else PI) - one[1], one[2] + PI)
    first, second = (vector(*map(half_turn, angles - guess)) for angles in (one, other))
    nearer = noevent(dot(first, first) <= dot(second, second))
    return guess + vector(*(where(nearer, a, b) for a, b in zip(first, second, strict=True)))


def half_turn(angle: Any) -> Any:
    """The same angle, less whole turns, within half a turn of zero."""
    return angle - 2 * PI * noevent(floor(angle / (2 * PI) + 0.5))


def from_nxy(n_x: Vector, n_y: Vector) -> Matrix:
    """Matrix of the frame with x axis along `n_x` and y axis in the plane of `n_x` and `n_y`.

    Where both are parallel, another axis takes the place of `n_y`.
    """
    e_x = unit_vector(n_x)
    across = cross(e_x, n_y)
    parallel = dot(across, across) < 1e-6
    other = where(abs(e_x[0]) > 1e-6, 1.0, 0.0)
    chosen = vector(*(where(parallel, b, a) for a, b in zip(n_y, (1.0 - other, other, 0.0), strict=True)))
    e_z = unit_vector(cross(e_x, chosen))
    return matrix(e_x, cross(e_z, e_x), e_z)


def from_quaternion(Q: Vector) -> Matrix:
    """Matrix of a quaternion (its scalar part comes last), which need not have length one."""
    a, b, c, d = Q
    square = dot(Q, Q)
    rows = (
        (a * a - b * b - c * c + d * d, 2 * (a * b + c * d), 2 * (a * c - b * d)),
        (2 * (b * a - c * d), b * b + d * d - a * a - c * c, 2 * (b * c + a * d)),
        (2 * (c * a + b * d), 2 * (c * b - a * d), c * c + d * d - a * a - b * b),
    )
    return matrix(*rows) / square


def quaternion_rate(Q: Vector, w: Vector) -> Vector:
    """Derivative of a quaternion at angular velocity `w`, resolved in the turned frame."""
    a, b, c, d = Q
    x, y, z = w
    return vector(d * x - c * y + b * z, c * x + d * y - a * z, a * y + d * z - b * x, -(a * x + b * y + c * z)) / 2


def axes_quaternion(sequence: Sequence[float], angles: Sequence[float]) -> tuple[float, ...]:
    """Quaternion (its scalar part last) of the rotations of `axes_rotations`, of numbers."""
    Q = np.array([0.0, 0.0, 0.0, 1.0])
    for axis, angle in zip(checked_sequence(sequence, all_orientations=False), angles, strict=True):
        turn = np.zeros(3)
        turn[axis - 1] = np.sin(angle / 2)
        vector_part = turn * Q[3] + Q[:3] * np.cos(angle / 2) - np.cross(turn, Q[:3])
        Q = np.array([*vector_part, Q[3] * np.cos(angle / 2) - turn @ Q[:3]])
    return tuple(Q.tolist())


def rotation_residual(T1: Matrix, T2: Matrix) -> Vector:
    """Zero, all three, where both matrices are the same rotation (to first order the angles between them).

    They are zero at half a turn between them, too: see `same_sense`.
    """
    (_, y1, z1), (x2, y2, _) = T1.rows(), T2.rows()
    return vector(dot(z1, y2), -dot(z1, x2), dot(y1, x2))


def same_sense(T1: Matrix, T2: Matrix) -> Assert:
    """That two rotations for which `rotation_residual` is zero are not half a turn apart."""
    return assert_(
        _trace(T1, T2) > 0,
        "two orientations that are to be the same are half a turn apart: the start values of the angles are too far "
        "from a position in which they agree",
    )


def rotation_between(T1: Matrix, T2: Matrix) -> Vector:
    """Zero, all three, where both matrices are the same rotation, and there only: ``2 n tan(phi/2)``."""
    (x1, y1, z1), (x2, y2, z2) = T1.rows(), T2.rows()
    turned = vector(dot(z1, y2) - dot(y1, z2), dot(x1, z2) - dot(z1, x2), dot(y1, x2) - dot(x1, y2))
    return turned * (2 / (1 + _trace(T1, T2)))


def _trace(T1: Matrix, T2: Matrix) -> Expr:
    """``1 + 2 cos(phi)`` of the rotation by the angle phi from one to the other."""
    (x1, y1, z1), (x2, y2, z2) = T1.rows(), T2.rows()
    return dot(x1, x2) + dot(y1, y2) + dot(z1, z2)
