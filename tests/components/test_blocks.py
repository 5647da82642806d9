"""Signal blocks where their examples do not go: options, limits, errors, and other people's numbers."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy import interpolate, signal

import acausal as ac
from acausal import Component, Discrete, Equations, Variable, der, pre, when
from acausal.components import blocks
from acausal.components.blocks import discrete, math_boolean, math_integer
from acausal.components.examples import assemble


def simulated(t: Any, *connections: str, **parts: Component) -> ac.Solution:
    times = np.asarray(t, float)
    return ac.compile(assemble(*connections, **parts)).simulate(float(times[-1]), saveat=times, rtol=1e-9)


def along(block: Component, values: Any, output: str = "y") -> np.ndarray:
    """Output of a block for an input that goes straight from the first to the last of the values."""
    values = np.asarray(values, float)
    ramp = blocks.Slope(slope=values[-1] - values[0], offset=values[0])
    t = (values - values[0]) / (values[-1] - values[0])
    return np.asarray(simulated(t, "ramp.y - block.u", ramp=ramp, block=block)[f"block.{output}"])


# ---- logic ------------------------------------------------------------------------------------------
@pytest.mark.parametrize(("name", "rule"), [
    ("And", all), ("Or", any), ("Xor", lambda u: sum(u) == 1), ("Nand", lambda u: not all(u)),
    ("Nor", lambda u: not any(u)),
])  # fmt: skip
def test_truth_tables(name: str, rule: Any) -> None:
    """All combinations of three booleans, one after the other."""
    pulses = {f"bit{k}": blocks.BooleanPulse(period=2.0 ** (k + 1), startTime=2.0**k) for k in range(3)}
    joints = [f"bit{k}.y - gate.u[{k}]" for k in range(3)]
    t = np.arange(8) + 0.5
    found = simulated(t, *joints, gate=getattr(math_boolean, name)(nu=3), **pulses)["gate.y"]
    assert np.asarray(found).tolist() == [float(rule([n >> k & 1 for k in range(3)])) for n in range(8)]


def test_gates_without_inputs() -> None:
    empty = {name: getattr(math_boolean, name)(nu=0) for name in ("And", "Or", "Xor")}
    solution = simulated([1.0], **empty, total=blocks.MultiSum(nu=0), times=blocks.MultiProduct(nu=0))
    assert [float(solution[f"{n}.y"][0]) for n in (*empty, "total", "times")] == [1.0, 0.0, 0.0, 0.0, 0.0]


def test_flip_flop_that_is_set_and_reset_at_once() -> None:
    """Both gates are off then; `Qini` is what was before the start."""
    on, off = blocks.BooleanTable(table=[1, 3]), blocks.BooleanTable(table=[2, 4])
    flip = blocks.RSFlipFlop(Qini=True)
    solution = simulated([0.5, 1.5, 2.5, 3.5, 4.5], "on.y - flip.S", "off.y - flip.R", on=on, off=off, flip=flip)
    assert np.asarray(solution["flip.Q"]).tolist() == [1.0, 1.0, 0.0, 0.0, 0.0]
    assert np.asarray(solution["flip.QI"]).tolist() == [0.0, 0.0, 0.0, 1.0, 1.0]


@pytest.mark.parametrize("was", [False, True])
def test_edges_at_the_start(was: bool) -> None:
    """An edge at the start is what differs from `pre_u_start`; a latch sees it."""
    parts = {"up": blocks.Edge(pre_u_start=was), "down": blocks.FallingEdge(pre_u_start=was),
             "any": blocks.Change(pre_u_start=was), "pre": blocks.Pre(pre_u_start=was)}  # fmt: skip
    model = assemble("on.y - " + " - ".join(f"{n}.u" for n in parts), on=blocks.BooleanConstant(), **parts)
    solution = ac.compile(model).simulate(1.0, saveat=[1.0])
    assert [float(solution[f"{n}.y"][0]) for n in parts] == [0.0, 0.0, 0.0, 1.0]
    held = blocks.Hysteresis(uLow=-1.0, uHigh=1.0, pre_y_start=was)
    control = blocks.OnOffController(bandwidth=2.0, pre_y_start=was)
    parts = {"zero": blocks.Constant(k=0.0), "held": held, "control": control}
    solution = simulated([0.0, 1.0], "zero.y - held.u - control.u - control.reference", **parts)
    assert np.asarray(solution["held.y"]).tolist() == np.asarray(solution["control.y"]).tolist() == [float(was)] * 2


def test_trapezoids_that_are_cut_short() -> None:
    shape = blocks.TriggeredTrapezoid(amplitude=2.0, rising=1.0, falling=0.0, offset=1.0)
    pulse = blocks.BooleanTable(table=[0.5, 1.0, 2.0])
    found = simulated([0.25, 0.75, 1.5, 2.5, 3.5], "pulse.y - shape.u", pulse=pulse, shape=shape)["shape.y"]
    assert_allclose(found, [1.0, 1.5, 1.0, 2.0, 3.0], atol=1e-9)
    on = simulated([0.0, 1.0], "on.y - shape.u", on=blocks.BooleanConstant(), shape=shape)["shape.y"]
    assert_allclose(on, [3.0, 3.0], err_msg="true from the start: the trapezoid is there")


def test_condition_that_does_not_hold() -> None:
    step = blocks.BooleanStep(startTime=0.5, startValue=True)
    with pytest.raises(ac.SimulationError, match=r"At t = 0\.5 s the assertion of test .* does not hold: too late"):
        simulated([1.0], "step.y - test.u", step=step, test=blocks.AssertCondition(message="too late"))
    with pytest.raises(ac.DeclarationError, match="assertionLevel='fatal' is none of error, warning"):
        simulated([1.0], "step.y - test.u", step=step, test=blocks.AssertCondition(assertionLevel="fatal"))


# ---- integers ---------------------------------------------------------------------------------------
def test_sum_that_is_reset() -> None:
    add = math_integer.TriggeredAdd(use_reset=True, use_set=True, y_start=1)
    pulse, stop = blocks.BooleanPulse(period=1.0, startTime=0.5), blocks.BooleanStep(startTime=2.2)
    parts = {"two": blocks.IntegerConstant(k=2), "ten": blocks.IntegerConstant(k=10), "pulse": pulse, "stop": stop}
    solution = simulated(
        [0.2, 0.7, 1.7, 2.3, 2.7], "two.y - add.u", "ten.y - add.set", "pulse.y - add.trigger", "stop.y - add.reset",
        add=add, **parts,
    )  # fmt: skip
    assert np.asarray(solution["add.y"]).tolist() == [1.0, 3.0, 5.0, 10.0, 10.0], "true, the reset holds"


def test_rounding_to_integers() -> None:
    values = np.linspace(-2.6, 2.6, 27)
    assert along(blocks.RealToInteger(), values).tolist() == np.round(values).tolist()
    assert_allclose(along(blocks.WrapAngle(), [-7.0, -4.0, 3.0, 4.0]), np.angle(np.exp(1j * np.array([-7, -4, 3, 4]))))
    positive = along(blocks.WrapAngle(positiveRange=True), [-7.0, -4.0, 3.0, 8.0])
    assert_allclose(positive, np.mod([-7.0, -4.0, 3.0, 8.0], 2 * np.pi))


@pytest.mark.parametrize(("table", "text"), [
    (blocks.IntegerTable(table=[[0, 1.5]]), "rows of a time and an integer"),
    (blocks.IntegerTable(table=[[0, 1], [0, 2]]), "times of a table must increase"),
    (blocks.BooleanTable(table=[2.0, 1.0]), "times of a table must increase"),
    (blocks.BooleanTable(extrapolation="LastTwoPoints"), "LastTwoPoints.*none of HoldLastPoint, Periodic"),
])  # fmt: skip
def test_tables_that_are_none(table: Component, text: str) -> None:
    with pytest.raises(ac.DeclarationError, match=text):
        ac.compile(assemble(table=table))


def test_tables_of_booleans_and_integers_begin_anew() -> None:
    parts = {
        "yes": blocks.BooleanTable(table=[0, 1, 3], extrapolation="Periodic", shiftTime=0.5, startTime=1.0),
        "number": blocks.IntegerTable(table=[[0, 4], [1, 5], [2, 6]], extrapolation="Periodic"),
    }  # fmt: skip
    solution = simulated([0.7, 1.2, 2.0, 3.7, 4.2, 5.3], **parts)
    assert np.asarray(solution["yes.y"]).tolist() == [0.0, 1.0, 0.0, 1.0, 1.0, 0.0]
    assert np.asarray(solution["number.y"]).tolist() == [4.0, 5.0, 4.0, 5.0, 4.0, 5.0]


# ---- tables -----------------------------------------------------------------------------------------
X, Y = [0.0, 1.0, 2.5, 3.0, 5.0], [0.0, 2.0, 2.5, 2.4, -1.0]


def test_cubics_of_a_table() -> None:
    """Modified Akima as SciPy has it; Steffen's are monotone where the points are, and go through them."""
    inside = np.linspace(0.0, 5.0, 41)
    rows = list(zip(X, Y, strict=True))
    found = along(blocks.CombiTable1Ds(table=rows, smoothness="ModifiedContinuousDerivative"), inside)[:, 0]
    assert_allclose(found, interpolate.Akima1DInterpolator(X, Y, method="makima")(inside), atol=1e-9)
    steffen = along(blocks.CombiTable1Ds(table=rows, smoothness="MonotoneContinuousDerivative2"), inside)[:, 0]
    assert np.all(np.diff(steffen[inside <= 2.5]) >= -1e-9) and np.all(np.diff(steffen[inside >= 2.5]) <= 1e-9)
    assert_allclose(steffen[np.isin(inside, X)], [y for x, y in rows if x in inside], atol=1e-9)
    slope = (2.0 * 1.5 + (0.5 / 1.5) * 1.0) / 2.5  # of the parabola at the second point, limited to twice 1/3
    limited = 2 * min(2.0, 0.5 / 1.5, slope / 2)
    curve = blocks.CombiTable1Ds(table=rows, smoothness="MonotoneContinuousDerivative2")
    near = along(curve, [0.999, 1.0, 1.001])[:, 0]
    assert_allclose((near[2] - near[0]) / 2e-3, limited, rtol=3e-3)


@pytest.mark.parametrize(("rows", "smoothness", "values"), [
    ([[0, 0], [1, 2], [1, 5]], "LinearSegments", [-2.0, 0.0, 5.0, 5.0]),  # a jump at the end is held
    ([[0, 7], [0, 0], [1, 2]], "LinearSegments", [7.0, 0.0, 2.0, 4.0]),
    ([[0, 0], [1, 2]], "ConstantSegments", [-2.0, 0.0, 2.0, 4.0]),  # outside, the line through the two points
    ([[0, 7], [0, 2]], "ConstantSegments", [7.0, 2.0, 2.0, 2.0]),
])  # fmt: skip
def test_ends_of_a_table(rows: list[list[float]], smoothness: str, values: list[float]) -> None:
    table = blocks.CombiTable1Ds(table=rows, smoothness=smoothness)
    assert_allclose(along(table, [-1.0, 0.0, 1.0, 2.0])[:, 0], values, atol=1e-12)


def test_tables_that_are_not_extrapolated() -> None:
    with pytest.raises(ac.SimulationError, match="a table from 0 to 5 is not extrapolated"):
        along(blocks.CombiTable1Ds(table=list(zip(X, Y, strict=True)), extrapolation="NoExtrapolation"), [4.0, 6.0])
    with pytest.raises(ac.DeclarationError, match="column 4: the table has columns from 2 to 2"):
        along(blocks.CombiTable1Ds(table=list(zip(X, Y, strict=True)), columns=[4]), [4.0, 6.0])
    with pytest.raises(ac.SimulationError, match="a table from 1 to 2 is not extrapolated"):
        map2(blocks.CombiTable2Ds(table=MAP, extrapolation="NoExtrapolation"), 15.0, 3.0)


MAP = [[0, 1, 2], [10, 0, 4], [20, 8, 16]]


def map2(table: Component, u1: float, u2: float) -> float:
    parts = {"a": blocks.Constant(k=u1), "b": blocks.Constant(k=u2), "map": table}
    return float(simulated([1.0], "a.y - map.u1", "b.y - map.u2", **parts)["map.y"][0])


@pytest.mark.parametrize(("options", "point", "value"), [
    ({}, (25.0, 3.0), 8 + (8 - 0) / 2 + 2 * (8 + (12 - 8) / 2)),  # both continued
    ({"extrapolation": "HoldLastPoint"}, (25.0, 3.0), 16.0),
    ({"extrapolation": "Periodic"}, (35.0, 2.25), 5.5),
    ({"smoothness": "ConstantSegments"}, (19.0, 1.9), 0.0),
    ({"smoothness": "ConstantSegments"}, (20.0, 2.0), 16.0),
    ({"smoothness": "ConstantSegments"}, (25.0, 1.0), 12.0),  # outside, the line through the last two points
    ({"smoothness": "ConstantSegments", "extrapolation": "HoldLastPoint"}, (25.0, 3.0), 16.0),
    ({"smoothness": "ContinuousDerivative"}, (25.0, 3.0), 32.0),  # two points make lines
])  # fmt: skip
def test_map(options: dict[str, str], point: tuple[float, float], value: float) -> None:
    assert map2(blocks.CombiTable2Ds(table=MAP, **options), *point) == pytest.approx(value)  # pyright: ignore


def test_a_map_is_not_monotone() -> None:
    with pytest.raises(ac.DeclarationError, match="LinearSegments or ConstantSegments or ContinuousDerivative"):
        map2(blocks.CombiTable2Ds(table=MAP, smoothness="MonotoneContinuousDerivative1"), 15.0, 1.5)


GRID = np.array([0.0, 0.4, 1.0, 1.3, 2.0]), np.array([-1.0, 0.0, 0.5, 2.0])


def across(height: Callable[[Any, Any], Any], *, tilt: float) -> tuple[Any, Any, Any]:
    """Akima's surface through the heights at the points of GRID, along a line that leaves it at both ends."""
    rows = [[0.0, *GRID[1]], *([x, *height(x, GRID[1])] for x in GRID[0])]
    t = np.linspace(0.0, 1.0, 401)
    parts = {
        "x": blocks.Ramp(height=3.0, duration=1.0, offset=-0.5),
        "y": blocks.Ramp(height=tilt, duration=1.0, offset=0.5 - tilt / 2),
        "map": blocks.CombiTable2Ds(table=rows, smoothness="ContinuousDerivative"),
    }  # fmt: skip
    found = simulated(t, "x.y - map.u1", "y.y - map.u2", **parts)
    return np.asarray(found["x.y"]), np.asarray(found["y.y"]), np.asarray(found["map.y"])


@pytest.mark.parametrize("tilt", [-4.0, 0.0, 4.0])
def test_a_smooth_map_is_exact_for_a_twisted_plane(tilt: float) -> None:
    """Inside and outside, with equal weights everywhere."""
    x, y, z = across(lambda x, y: 1 + 2 * x - 3 * y + 4 * x * y, tilt=tilt)
    assert_allclose(z, 1 + 2 * x - 3 * y + 4 * x * y, atol=1e-9)


@pytest.mark.parametrize("tilt", [-4.0, 0.0, 4.0])
def test_a_smooth_map_has_no_edges(tilt: float) -> None:
    """No kink is among its second differences, and it is near to the function it goes through."""
    x, y, z = across(lambda x, y: np.sin(x) * np.cos(y), tilt=tilt)
    inside = (x >= 0) & (x <= 2) & (y >= -1) & (y <= 2)
    assert np.abs(z - np.sin(x) * np.cos(y))[inside].max() < 0.06
    step = x[1] - x[0]
    assert np.abs(np.diff(z, 2)).max() < 20 * step**2  # a kink of 0.2 would be 0.2 * step, which is 27 * step**2


def test_tables_on_file(tmp_path: Path) -> None:
    file = tmp_path / "curve.csv"
    file.write_text("Curve\nu;a;b\n0;0;5\n1;2;6\n3;0;7\n", encoding="utf-8")
    given: dict[str, Any] = {"tableOnFile": True, "fileName": str(file), "delimiter": ";", "nHeaderLines": 2}
    assert_allclose(along(blocks.CombiTable1Ds(**given), [0.5, 2.0]), [[1.0, 5.5], [1.0, 6.5]])
    assert_allclose(simulated([0.5, 2.0], table=blocks.CombiTimeTable(**given))["table.y[2]"], [5.5, 6.5])
    with pytest.raises(ac.DeclarationError, match=r"fileName='none.csv'` holds no table of numbers"):
        blocks.CombiTimeTable(tableOnFile=True, fileName="none.csv")


# ---- routing ----------------------------------------------------------------------------------------
def test_extractor() -> None:
    step = blocks.IntegerStep(offset=1, height=2, startTime=0.5)
    parts = {"one": blocks.Constant(k=1.0), "two": blocks.Constant(k=2.0), "step": step}
    joints = ("one.y - pick.u[0]", "two.y - pick.u[1]", "step.y - pick.index")
    free = blocks.Extractor(nin=2, allowOutOfRange=True, outOfRangeValue=-7.0)
    assert np.asarray(simulated([0.4, 0.6], *joints, pick=free, **parts)["pick.y"]).tolist() == [1.0, -7.0]
    with pytest.raises(ac.SimulationError, match="the index of an Extractor is out of range: there are 2 signals"):
        simulated([0.4, 0.6], *joints, pick=blocks.Extractor(nin=2), **parts)


ROWS: Any = [[1.0]]
FLAT: Any = [1.0]


@pytest.mark.parametrize(("make", "text"), [
    (lambda: blocks.ExtractSignal(nin=2, extract=[3]), "no numbers from 1 to 2"),
    (lambda: blocks.MinMax(nu=0), "no smallest of no signals"),
    (lambda: blocks.MatrixGain(K=[[1.0, 2.0], [3.0]]), "`K` takes rows that are equally long, not of 2, 1 numbers"),
    (lambda: blocks.PadeDelay(n=2, m=3), "n=2, m=3"),
    (lambda: discrete.TransferFunction(b=[1.0, 2.0]), "b is not longer than a"),
    (lambda: blocks.TransferFunction(a=[]), "both have coefficients"),
    (lambda: blocks.TransferFunction(b=[1.0], a=[0.0, 1.0]), "is not 0"),
    (lambda: blocks.TransferFunction(b=[float("nan")], a=[1.0, 2.0]), "`b` holds NaN"),
    (lambda: blocks.TransferFunction(b=ROWS, a=[1.0, 2.0]), "`b` takes numbers, not rows of numbers"),
    (lambda: discrete.StateSpace(C=[[1.0]]), r"C=\(\(1.0,\),\) should have 1 rows of 2 numbers"),
    (lambda: blocks.StateSpace(A=[[1.0]], B=FLAT, C=[[1.0]]), "`B` takes rows of numbers, as in"),
    (lambda: blocks.TimeTable(table=[[0, 1], [1], [2, 3]]), "`table` takes rows that are equally long, not of 2, 1, 2"),
    (lambda: blocks.TimeTable(table=[[0, 1, 2], [1, 2, 3]]), "rows of a time and a value"),
    (lambda: blocks.TimeTable(table=[[0.0, 1.0], [-1.0, 2.0]]), "whose first coordinate increases"),
    (lambda: blocks.CombiTimeTable(table=[]), "the table has no rows"),
])  # fmt: skip
def test_blocks_that_are_none(make: Callable[[], Component], text: str) -> None:
    with pytest.raises(ac.DeclarationError, match=text) as caught:
        ac.compile(assemble(block=make()))
    assert "test_blocks.py" in str(caught.value)


# ---- linear systems ---------------------------------------------------------------------------------
@pytest.mark.parametrize(("n", "m"), [(1, 0), (3, 2), (5, 0)])
@pytest.mark.parametrize("balance", [False, True])
def test_pade_delay(n: int, m: int, balance: bool) -> None:
    """SciPy's Pade approximation of exp(-s T), as a transfer function."""
    T, t = 0.4, np.linspace(0.0, 1.5, 31)
    taylor = [(-T) ** k / float(np.prod(np.arange(1, k + 1))) for k in range(n + (m or n) + 1)]
    p, q = interpolate.pade(taylor, n, m or n)
    fine = np.linspace(0.0, 1.5, 3001)
    wanted = signal.lsim((p.coeffs, q.coeffs), np.sin(3 * fine), fine)[1][::100]
    late = blocks.PadeDelay(delayTime=T, n=n, m=m, balance=balance)
    wave = blocks.Sine(f=3 / (2 * np.pi))
    found = simulated(t, "wave.y - late.u", wave=wave, late=late)["late.y"]
    assert_allclose(found, wanted, atol=1e-6)


def test_steadiest_start_of_a_state_space() -> None:
    """The smallest derivatives among the states with the wanted output, by least squares in the null space of C."""
    A, B = [[-1.0, 2.0, 0.0], [0.0, -3.0, 1.0], [1.0, 0.0, -2.0]], [[1.0], [0.0], [2.0]]
    C, D = [[1.0, 1.0, 0.0]], [[0.5]]
    space = blocks.StateSpace(A=A, B=B, C=C, D=D, initType="InitialOutput", y_start=(4.0,))
    x = np.asarray(simulated([0.0, 0.1], "u.y - space.u[0].u", u=blocks.Constant(k=3.0), space=space)["space.x"])[0]
    y = 4.0 - 1.5
    some, free = np.array([y, 0.0, 0.0]), np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0]])
    a, b = np.array(A), np.array(B)[:, 0] * 3.0
    wanted = some + free @ np.linalg.lstsq(a @ free, -(a @ some + b), rcond=None)[0]
    assert_allclose(x, wanted, atol=1e-9)


def test_limits_of_an_integrator_at_the_start() -> None:
    one = {"one": blocks.Constant(k=1.0)}
    inside = blocks.LimIntegrator(outMax=2.0, limitsAtInit=False, initType="InitialState", y_start=1.5)
    assert_allclose(simulated([0.0, 1.0], "one.y - level.u", **one, level=inside)["level.y"], [1.5, 2.0], atol=1e-6)
    beyond = blocks.LimIntegrator(outMax=2.0, limitsAtInit=False, initType="InitialState", y_start=3.0)
    with pytest.raises(ac.AcausalError, match="the start of a LimIntegrator is not within its limits"):
        simulated([0.0, 1.0], "one.y - level.u", **one, level=beyond)


def test_integrator_that_is_set() -> None:
    level = blocks.Integrator(use_reset=True, use_set=True, y_start=1.0)
    parts = {"two": blocks.Constant(k=2.0), "five": blocks.Constant(k=5.0), "at": blocks.BooleanStep(startTime=0.5)}
    found = simulated([0.4, 1.0], "two.y - level.u", "five.y - level.set", "at.y - level.reset", level=level, **parts)
    assert_allclose(found["level.y"], [1.8, 6.0])
    limited = blocks.LimIntegrator(use_reset=True, use_set=True, outMax=3.0)
    found = simulated([0.6], "two.y - level.u", "five.y - level.set", "at.y - level.reset", level=limited, **parts)
    assert_allclose(found["level.y"], [3.0], atol=1e-6)


# ---- statistics -------------------------------------------------------------------------------------
def test_means_of_a_run_that_does_not_begin_at_zero() -> None:
    """Periods count from the start of the run."""
    mean, later = blocks.Mean(f=1.0), blocks.ContinuousMean(startTime=3.0)
    parts = {"ramp": blocks.Slope(slope=2.0), "mean": mean, "later": later}
    model = ac.compile(assemble("ramp.y - mean.u - later.u", **parts))
    solution = model.simulate(4.0, t0=1.5, saveat=[2.4, 2.6, 3.6, 4.0], rtol=1e-9)
    assert_allclose(solution["mean.y"], [0.0, 4.0, 6.0, 6.0], atol=1e-7)
    assert_allclose(solution["later.y"], [4.8, 5.2, 6.6, 7.0], atol=1e-6)


def test_moments_are_those_of_the_samples() -> None:
    wave = blocks.Sine(amplitude=2.0, f=0.3, phase=0.4)
    t = np.linspace(0.0, 7.3, 100_001)
    u = 2.0 * np.sin(2 * np.pi * 0.3 * t + 0.4)
    solution = simulated([3.0, 7.3], "wave.y - mean.u - spread.u", wave=wave, mean=blocks.ContinuousMean(),
                         spread=blocks.Variance())  # fmt: skip
    assert solution["mean.y"][-1] == pytest.approx(np.trapezoid(u, t) / 7.3, rel=1e-5)
    mu = np.concatenate([[u[0]], (np.cumsum(u[1:] + u[:-1]) / 2 * (t[1] - t[0])) / t[1:]])
    assert solution["spread.y"][-1] == pytest.approx(np.trapezoid((u - mu) ** 2, t) / 7.3, rel=1e-3)


def test_distortion_that_is_there_and_that_is_not() -> None:
    parts = {"none": blocks.Constant(k=0.0), "thd": blocks.TotalHarmonicDistortion(f=1.0)}
    assert float(simulated([2.5], "none.y - thd.u", **parts)["thd.valid"][0]) == 0.0
    square = blocks.Pulse(period=1.0, amplitude=2.0, offset=-1.0)
    parts = {"square": square, "thd": blocks.TotalHarmonicDistortion(f=1.0)}
    solution = simulated([2.5], "square.y - thd.u", **parts)
    assert solution["thd.y"][0] == pytest.approx(np.sqrt(np.pi**2 / 8 - 1), rel=1e-6)
    assert float(solution["thd.valid"][0]) == 1.0


def test_extrema() -> None:
    wave = blocks.ExpSine(f=1.0, damping=0.3)
    parts = {"wave": wave, "often": blocks.SignalExtrema(Ts=1e-3), "exact": blocks.ContinuousSignalExtrema(T=1e-5)}
    solution = simulated([3.0], "wave.y - often.u - exact.u", **parts)
    t = np.linspace(0.0, 3.0, 300_001)
    u = np.exp(-0.3 * t) * np.sin(2 * np.pi * t)
    for name, close in (("often", 1e-5), ("exact", 1e-7)):
        assert solution[f"{name}.y_max"][0] == pytest.approx(u.max(), abs=close)
        assert solution[f"{name}.y_min"][0] == pytest.approx(u.min(), abs=close)
        assert solution[f"{name}.t_max"][0] == pytest.approx(t[u.argmax()], abs=1e-3)


def test_phase_of_an_encoder() -> None:
    """Blocks.Examples.SinCosEncoder: an integrator follows the phase of two signals, w/2e6 behind, for fifty turns."""

    class Encoder(Component):
        ramp: blocks.Ramp = blocks.Ramp(height=100.0, duration=1.0)
        cosine: blocks.CosineVariableFrequencyAndAmplitude = blocks.CosineVariableFrequencyAndAmplitude(
            useConstantAmplitude=True, constantAmplitude=2.0
        )
        sine: blocks.SineVariableFrequencyAndAmplitude = blocks.SineVariableFrequencyAndAmplitude(
            useConstantAmplitude=True, constantAmplitude=2.0
        )
        integrator: blocks.Integrator = blocks.Integrator(k=1e6)
        der1: blocks.Der = blocks.Der()
        wrapAngle: blocks.WrapAngle = blocks.WrapAngle()

        def equations(self) -> ac.Equations:
            angle = self.integrator.y
            yield ac.connect(self.ramp.y, self.sine.f, self.cosine.f)
            yield self.integrator.u == self.sine.y * ac.cos(angle) - self.cosine.y * ac.sin(angle)
            yield ac.connect(self.integrator.y, self.der1.u, self.wrapAngle.u)

    t = np.linspace(0.0, 1.0, 12)
    solution = ac.compile(Encoder()).simulate(1.0, saveat=t, rtol=1e-10)
    phase, w = 100 * np.pi * t**2, 200 * np.pi * t
    assert_allclose(solution["integrator.y"], phase - w / 2e6, atol=1e-6)
    assert_allclose(solution["der1.y"], w, atol=1e-3)
    assert_allclose(np.exp(1j * np.asarray(solution["wrapAngle.y"])), np.exp(1j * (phase - w / 2e6)), atol=1e-6)
    assert np.all(np.abs(solution["wrapAngle.y"]) <= np.pi)


def test_characteristics_of_pulses() -> None:
    """Blocks.Examples.DemoSignalCharacteristic, with a duty cycle of 30 %: the integrals are elementary."""
    top, base, duty, f = 3.0, -1.0, 0.3, 50.0
    square = blocks.Pulse(amplitude=top - base, width=100 * duty, period=1 / f, offset=base)
    kinds = {"mean": blocks.Mean, "rectifiedMean": blocks.RectifiedMean, "rootMeanSquare": blocks.RootMeanSquare,
             "harmonic": blocks.Harmonic}  # fmt: skip
    parts = {name: kind(f=f) for name, kind in kinds.items()}
    solution = simulated([0.05], "square.y - " + " - ".join(f"{n}.u" for n in parts), square=square, **parts)
    assert solution["mean.y"][0] == pytest.approx(top * duty + base * (1 - duty), abs=1e-7)
    assert solution["rectifiedMean.y"][0] == pytest.approx(abs(top) * duty + abs(base) * (1 - duty), abs=1e-7)
    wanted = np.sqrt(top**2 * duty + base**2 * (1 - duty))
    assert solution["rootMeanSquare.y"][0] == pytest.approx(wanted, abs=1e-7)
    first = (top - base) / (np.sqrt(2) * np.pi) * (np.sin(2 * np.pi * duty) + 1j * (1 - np.cos(2 * np.pi * duty)))
    assert solution["harmonic.y_rms"][0] == pytest.approx(abs(first), rel=1e-6)
    assert solution["harmonic.y_arg"][0] == pytest.approx(np.angle(first), abs=1e-6)


@pytest.mark.parametrize(
    "kind", [blocks.CombiTable1Ds, blocks.CombiTable1Dv, blocks.CombiTable2Ds, blocks.CombiTimeTable, blocks.TimeTable]
)
def test_a_table_that_was_forgotten_is_an_error(kind: type[Component]) -> None:
    """Without rows of its own it would be that of another curve."""
    with pytest.raises(ac.DeclarationError, match=f"{kind.__name__}: the table has no rows, give it some"):
        ac.compile(assemble(table=kind()))


@pytest.mark.parametrize(("startTime", "y"), [(0.0, [3.0, 3.0, 3.0]), (0.5, [1.0, 3.0, 3.0])])
def test_a_ramp_of_no_duration_is_a_step(startTime: float, y: list[float]) -> None:
    model = assemble(ramp=blocks.Ramp(height=2.0, offset=1.0, duration=0.0, startTime=startTime),
                     sweep=blocks.LogFrequencySweep(wMin=1.0, wMax=3.0, duration=0.0, startTime=startTime))  # fmt: skip
    run = ac.compile(model).simulate(t1=1.0, saveat=3)
    assert run["ramp.y"].tolist() == y
    np.testing.assert_allclose(run["sweep.y"], y)


def test_what_samples_later_begins_with_the_input_at_the_start() -> None:
    late = {"samplePeriod": 0.2, "startTime": 0.5}
    model = assemble("line.y - sampler.u - hold.u", line=blocks.Slope(slope=1.0, offset=3.0),
                     sampler=discrete.Sampler(**late), hold=discrete.ZeroOrderHold(**late))  # fmt: skip
    run = ac.compile(model).simulate(t1=1.0, saveat=[0.0, 0.4, 0.6, 0.8])
    for name in ("sampler", "hold"):
        np.testing.assert_allclose(run[f"{name}.y"], [3.0, 3.0, 3.5, 3.7])


def test_limits_that_contradict_each_other_are_errors() -> None:
    crossing = assemble("high.y - cut.limit1 - cut.u", "low.y - cut.limit2", high=blocks.Slope(slope=-2.0, offset=1.0),
                        low=blocks.Constant(k=0.0), cut=blocks.VariableLimiter())  # fmt: skip
    with pytest.raises(ac.SimulationError, match=r"At t = 0\.5 s .*limit2, is above its upper one, limit1"):
        ac.compile(crossing).simulate(t1=1.0)
    control = blocks.LimPID(controllerType="PI", initType="InitialOutput", yMax=1.0, y_start=2.0)
    beyond = assemble("one.y - control.u_s", "two.y - control.u_m", one=blocks.Constant(), two=blocks.Constant(),
                      control=control)  # fmt: skip
    with pytest.raises(ac.SimulationError, match=r"y_start, is not within its limits(.|\n)*y_start = 2"):
        ac.compile(beyond).simulate(t1=1.0)


class Phases(Component):
    """Periodic signals of which some phases take no time."""

    steep: blocks.Trapezoid = blocks.Trapezoid(period=0.1, startTime=0.05, rising=0.0, width=0.04, falling=0.0)
    none: blocks.Pulse = blocks.Pulse(period=0.1, startTime=-7 / 30, width=0.0)
    integral: Variable = Variable(start=0.0, fixed=True)
    ups: Discrete = Discrete(start=0)
    pulses: Discrete = Discrete(start=0)

    def equations(self) -> Equations:
        yield der(self.integral) == self.steep.y
        yield when(self.steep.y > 0.5, {self.ups: pre(self.ups) + 1})
        yield when(self.none.y > 0.5, {self.pulses: pre(self.pulses) + 1})


def test_phases_of_no_length_are_not_seen_by_rounding() -> None:
    run = ac.compile(Phases()).simulate(1.74, saveat=2001)
    assert [run["ups"][-1], run["pulses"][-1]] == [17.0, 0.0]
    assert run["integral"][-1] == pytest.approx(17 * 0.04, rel=1e-9)
    assert set(run["steep.y"]) == {0.0, 1.0}
