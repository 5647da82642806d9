"""Rigid bodies with two frames, whose mass properties may follow from a shape."""

from __future__ import annotations

from acausal import (
    PI,
    Component,
    Equations,
    Matrix,
    Parameter,
    Variable,
    Vector,
    connect,
    matrix,
    norm,
    structural,
    vector,
)

from .bodies import Body
from .frames import IDENTITY, ZEROS, Frame, from_nxy, unit_vector
from .parts import FixedTranslation


class PartialBodyShape(Component, partial=True):
    """Two rigidly connected frames and how the body starts; subclasses declare `body`.

    Source: the common part of Modelica.Mechanics.MultiBody.Parts.BodyShape, BodyBox and BodyCylinder.
    """

    angles_fixed: bool = False
    w_0_fixed: bool = False
    z_0_fixed: bool = False
    enforceStates: bool = False
    useQuaternions: bool = True
    sequence_start: tuple[float, ...] = (1.0, 2.0, 3.0)
    sequence_angleStates: tuple[float, ...] = (1.0, 2.0, 3.0)
    frame_a: Frame = Frame()
    frame_b: Frame = Frame()
    r: Vector = Vector(Parameter(unit="m", doc="from frame_a to frame_b, resolved in frame_a"), (0.1, 0.0, 0.0))
    angles_start: Vector = Vector(
        Parameter(unit="rad", doc="angles about the axes of sequence_start, from the world to frame_a, at the start"),
        ZEROS,
    )
    w_0_start: Vector = Vector(
        Parameter(unit="rad/s", doc="angular velocity at the start, resolved in the world frame"), ZEROS
    )
    z_0_start: Vector = Vector(
        Parameter(unit="rad/s2", doc="angular acceleration at the start, resolved in the world frame"), ZEROS
    )
    r_0: Vector = Vector(Variable(unit="m", state_select="avoid", doc="position of frame_a in the world frame"))
    v_0: Vector = Vector(Variable(unit="m/s", state_select="avoid", doc="velocity of frame_a, in the world frame"))
    a_0: Vector = Vector(Variable(unit="m/s2", doc="acceleration of frame_a, in the world frame"))
    frameTranslation: FixedTranslation = FixedTranslation(r=r)
    body: Body = Body(
        angles_fixed=structural("angles_fixed"), w_0_fixed=structural("w_0_fixed"), z_0_fixed=structural("z_0_fixed"),
        enforceStates=structural("enforceStates"), sequence_start=structural("sequence_start"),
        useQuaternions=structural("useQuaternions"), sequence_angleStates=structural("sequence_angleStates"),
        angles_start=angles_start, w_0_start=w_0_start, z_0_start=z_0_start,
    )  # fmt: skip

    def equations(self) -> Equations:
        yield from super().equations()
        yield connect(self.frame_a, self.frameTranslation.frame_a, self.body.frame_a)
        yield connect(self.frameTranslation.frame_b, self.frame_b)
        yield self.r_0 == self.body.r_0
        yield self.v_0 == self.body.v_0
        yield self.a_0 == self.body.a_0


_STARTS = PartialBodyShape.__dict__["body"].default


def _with_starts(**mass: object) -> Body:
    """The body of a shape: the starts of `PartialBodyShape` and its own mass properties."""
    return Body(**{**_STARTS.__dict__["_mods"], **mass})


class BodyShape(PartialBodyShape):
    """Rigid body with two frames, `r` apart; mass, centre of mass and inertia tensor are given.

    >>> model = assemble("world.frame_b - shape.frame_a", "shape.frame_b - tip.frame_a", tip=Body(m=2.0),
    ...                  world=ac.inner(World(g=10.0)),
    ...                  shape=BodyShape(r=(1.0, 0.0, 0.0), r_CM=(0.5, 0.0, 0.0), m=4.0))
    >>> run(model)["shape.frame_a.t[3]"][-1]  # 4*10*0.5 + 2*10*1
    40.0

    Source: Modelica.Mechanics.MultiBody.Parts.BodyShape.
    """

    r: Vector = Vector(Parameter(unit="m", doc="from frame_a to frame_b, resolved in frame_a"), ZEROS)
    r_CM: Vector = Vector(Parameter(unit="m", doc="from frame_a to the centre of mass, resolved in frame_a"), ZEROS)
    m: Parameter = Parameter(1.0, unit="kg", min=0.0, doc="mass")
    I_11: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 1,1 of the inertia tensor at the centre")
    I_22: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 2,2 of the inertia tensor")
    I_33: Parameter = Parameter(0.001, unit="kg*m2", min=0.0, doc="element 3,3 of the inertia tensor")
    I_21: Parameter = Parameter(0.0, unit="kg*m2", doc="element 2,1 of the inertia tensor")
    I_31: Parameter = Parameter(0.0, unit="kg*m2", doc="element 3,1 of the inertia tensor")
    I_32: Parameter = Parameter(0.0, unit="kg*m2", doc="element 3,2 of the inertia tensor")
    body: Body = _with_starts(r_CM=r_CM, m=m, I_11=I_11, I_22=I_22, I_33=I_33, I_21=I_21, I_31=I_31, I_32=I_32)


def _outer(e: Vector) -> Matrix:
    return matrix(*([a * b for b in e] for a in e))


def _tensor(I: Matrix) -> dict[str, object]:  # noqa: E741 (its symbol)
    """Elements of an inertia tensor, as `Body` takes them."""
    rows = I.rows()
    return {f"I_{i}{j}": rows[i - 1][j - 1] for i, j in ((1, 1), (2, 2), (3, 3), (2, 1), (3, 1), (3, 2))}


class BodyCylinder(PartialBodyShape):
    """Rigid body in the shape of a (hollow) cylinder from frame_a to frame_b.

    ``m = rho pi l (R^2 - R_i^2)``; with ``m_o, m_i`` the masses of the full cylinder and of the hole,
    ``I_axis = (m_o R^2 - m_i R_i^2)/2`` and ``I_across = (m_o (l^2 + 3 R^2) - m_i (l^2 + 3 R_i^2))/12``.

    >>> model = assemble("world.frame_b - rod.frame_a", world=ac.inner(World(g=10.0)),
    ...                  rod=BodyCylinder(r=(2.0, 0.0, 0.0), diameter=0.1, density=1000.0))
    >>> solution = run(model)
    >>> close(solution["rod.frame_a.f[2]"][-1], 1000.0 * np.pi * 0.05**2 * 2.0 * 10.0)
    True

    Source: Modelica.Mechanics.MultiBody.Parts.BodyCylinder.
    """

    r_shape: Vector = Vector(Parameter(unit="m", doc="from frame_a to the cylinder's beginning"), ZEROS)
    lengthDirection: Vector = Vector(
        Parameter(unit="m", doc="along the cylinder, of any length, resolved in frame_a"), PartialBodyShape.r - r_shape
    )
    length: Parameter = Parameter(norm(PartialBodyShape.r - r_shape), unit="m", min=0.0, doc="length of the cylinder")
    diameter: Parameter = Parameter(length / 20, unit="m", min=0.0, doc="diameter")
    innerDiameter: Parameter = Parameter(0.0, unit="m", min=0.0, doc="inner diameter")
    density: Parameter = Parameter(7700.0, unit="kg/m3", min=0.0, doc="density")
    mo: Parameter = Parameter(density * PI * length * diameter**2 / 4, unit="kg", doc="mass without the hole")
    mi: Parameter = Parameter(density * PI * length * innerDiameter**2 / 4, unit="kg", doc="mass of what is not there")
    m: Parameter = Parameter(mo - mi, unit="kg", min=0.0, doc="mass")
    I11: Parameter = Parameter(
        (mo * diameter**2 - mi * innerDiameter**2) / 8, unit="kg*m2", doc="inertia about the axis"
    )
    I22: Parameter = Parameter(
        (mo * (length**2 + diameter**2 * 0.75) - mi * (length**2 + innerDiameter**2 * 0.75)) / 12,
        unit="kg*m2", doc="inertia across the axis",
    )  # fmt: skip
    r_CM: Vector = Vector(
        Parameter(unit="m", doc="from frame_a to the centre of mass"),
        r_shape + unit_vector(lengthDirection) * length / 2,
    )
    I: Matrix = Matrix(  # noqa: E741 (Modelica's name)
        Parameter(unit="kg*m2", doc="inertia tensor at the centre of mass, resolved in frame_a"),
        matrix(*IDENTITY) * I22 + _outer(unit_vector(lengthDirection)) * (I11 - I22),
    )
    body: Body = _with_starts(r_CM=r_CM, m=m, **_tensor(I))


class BodyBox(PartialBodyShape):
    """Rigid body in the shape of a (hollow) box from frame_a to frame_b.

    Its axes are those of `from_nxy`: x along `r`, y in the plane of `r` and `widthDirection`; with ``m_o, m_i`` the
    masses of the full box and of the hole, ``I_xx = (m_o (w^2 + h^2) - m_i (w_i^2 + h_i^2))/12`` and so on.

    >>> model = assemble("world.frame_b - box.frame_a", world=ac.inner(World(g=10.0)),
    ...                  box=BodyBox(r=(2.0, 0.0, 0.0), width=0.1, height=0.2, density=1000.0))
    >>> close(run(model)["box.frame_a.f[2]"][-1], 1000.0 * 0.1 * 0.2 * 2.0 * 10.0)
    True

    Source: Modelica.Mechanics.MultiBody.Parts.BodyBox.
    """

    r_shape: Vector = Vector(Parameter(unit="m", doc="from frame_a to the box's beginning"), ZEROS)
    lengthDirection: Vector = Vector(
        Parameter(unit="m", doc="along the box, of any length, resolved in frame_a"), PartialBodyShape.r - r_shape
    )
    widthDirection: Vector = Vector(Parameter(unit="1", doc="across the box, resolved in frame_a"), (0.0, 1.0, 0.0))
    length: Parameter = Parameter(norm(PartialBodyShape.r - r_shape), unit="m", min=0.0, doc="length of the box")
    width: Parameter = Parameter(length / 20, unit="m", min=0.0, doc="width")
    height: Parameter = Parameter(width, unit="m", min=0.0, doc="height")
    innerWidth: Parameter = Parameter(0.0, unit="m", min=0.0, doc="width of the hole")
    innerHeight: Parameter = Parameter(innerWidth, unit="m", min=0.0, doc="height of the hole")
    density: Parameter = Parameter(7700.0, unit="kg/m3", min=0.0, doc="density")
    mo: Parameter = Parameter(density * length * width * height, unit="kg", doc="mass without the hole")
    mi: Parameter = Parameter(density * length * innerWidth * innerHeight, unit="kg", doc="mass of what is not there")
    m: Parameter = Parameter(mo - mi, unit="kg", min=0.0, doc="mass")
    J: Vector = Vector(
        Parameter(unit="kg*m2", doc="inertia about the axes of the box"),
        vector(
            (mo * (width**2 + height**2) - mi * (innerWidth**2 + innerHeight**2)) / 12,
            (mo * (length**2 + height**2) - mi * (length**2 + innerHeight**2)) / 12,
            (mo * (length**2 + width**2) - mi * (length**2 + innerWidth**2)) / 12,
        ),
    )
    T: Matrix = Matrix(
        Parameter(unit="1", doc="from frame_a to the axes of the box"), from_nxy(PartialBodyShape.r, widthDirection)
    )
    r_CM: Vector = Vector(
        Parameter(unit="m", doc="from frame_a to the centre of mass"),
        r_shape + unit_vector(lengthDirection) * length / 2,
    )
    I: Matrix = Matrix(  # noqa: E741 (Modelica's name)
        Parameter(unit="kg*m2", doc="inertia tensor at the centre of mass, resolved in frame_a"),
        T.transpose() @ matrix((J[0], 0.0, 0.0), (0.0, J[1], 0.0), (0.0, 0.0, J[2])) @ T,
    )
    body: Body = _with_starts(r_CM=r_CM, m=m, **_tensor(I))
