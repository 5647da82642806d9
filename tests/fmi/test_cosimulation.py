"""The co-simulation master, on models whose answer in one piece is known."""

from __future__ import annotations

import numpy as np
import pytest

import acausal as ac
from acausal.fmi import CoSimulation, CoSimulationError, PowerBond, SystemParticipant, split

from .models import Decay, Gain, RigidMasses, TwoMasses


@pytest.fixture(scope="module")
def masses():
    return split(TwoMasses(), "middle.flange_a", names=("right", "left"))


@pytest.fixture(scope="module")
def decay():
    return ac.compile(Decay())


@pytest.fixture(scope="module")
def gain():
    return ac.compile(Gain())


def error(master: CoSimulation, whole, names=("one.s",), t1=4.0) -> tuple[float, object]:
    result = master.simulate(t1)
    exact = whole.simulate(t1, saveat=result.t, rtol=1e-10)
    return max(result.rmse(n, np.asarray(exact[n])) for n in names), result


def test_two_participants_with_feedback(decay):
    """tau y1' = y2 - y1, tau y2' = y1 - y2: eigenvalues 0 and -2/tau; the first step has nothing to extrapolate."""
    inverter = ac.compile(Decay(y=ac.start(0.0, fixed=True)))
    one = SystemParticipant(decay)
    two = SystemParticipant(inverter)
    master = CoSimulation({"one": one, "two": two}, [("two.y", "one.u"), ("one.y", "two.u")], step=0.01, order=2)
    result = master.simulate(1.0)
    exact = 0.5 * (1 + np.exp(-2 * result.t / 0.5))
    np.testing.assert_allclose(result["one.y"], exact, atol=3e-4)


@pytest.mark.parametrize("method", ["jacobi", "gauss-seidel"])
@pytest.mark.parametrize("order", [pytest.param(0, marks=pytest.mark.slow), 1])
@pytest.mark.slow_case("gauss-seidel")
def test_order_of_convergence(masses, method, order):
    """Extrapolation of degree k makes a global error of order k + 1."""
    errors = []
    for step in (0.02, 0.01):
        master = masses.cosimulation(record=["one.s"], step=step, order=order, method=method, rtol=1e-9)
        errors.append(error(master, masses.whole)[0])
    rate = np.log2(errors[0] / errors[1])
    assert rate > order + 0.7, (errors, rate)


def test_implicit_coupling_conserves_energy(masses):
    explicit = masses.cosimulation(record=["one.s"], step=0.02, order=1, rtol=1e-8)
    implicit = masses.cosimulation(record=["one.s"], step=0.02, order=1, iterations=20, rtol=1e-8)
    e, r = error(explicit, masses.whole)
    i, s = error(implicit, masses.whole)
    assert i < 0.4 * e
    assert s.energy_residual < 0.05 * r.energy_residual


def test_energy_residual_is_the_energy_that_appears():
    """Without damping, the energy of the whole grows by what the bond has made."""
    model = ac.modify(TwoMasses(), {"left.d": 0.0, "middle.d": 0.0})
    cut = split(model, "middle.flange_a", names=("right", "left"))
    record = ["one.s", "one.v", "two.s", "two.v"]
    result = cut.cosimulation(record=record, step=0.01, order=0, rtol=1e-10).simulate(2.0)
    s1, v1, s2, v2 = (result[n] for n in record)
    energy = 0.5 * (2.0 * v1**2 + v2**2 + 20.0 * s1**2 + 10.0 * (s2 - s1) ** 2)
    made = next(iter(result.energy.values()))
    assert abs(made[-1]) > 0.01
    np.testing.assert_allclose(energy - energy[0], made, atol=0.1 * np.max(np.abs(made)))


def test_adaptive_step_meets_its_tolerance(masses):
    results = {}
    for tolerance in (1e-2, 1e-3, 1e-4):
        master = masses.cosimulation(record=["one.s"], step=0.01, tolerance=tolerance, rtol=1e-9)
        results[tolerance] = error(master, masses.whole)
    errors = [e for e, _ in results.values()]
    steps = [r.stats["macro_steps"] for _, r in results.values()]
    assert errors[0] > errors[1] > errors[2]
    assert steps[0] < steps[1] < steps[2]


@pytest.mark.slow
def test_energy_control(masses):
    loose, tight = (
        error(masses.cosimulation(record=["one.s"], tolerance=t, control="energy", rtol=1e-9), masses.whole)[1]
        for t in (1e-1, 1e-3)
    )
    assert tight.energy_residual < loose.energy_residual


def test_rejected_steps_go_back(masses):
    master = masses.cosimulation(record=["one.s"], step=0.1, tolerance=1e-5, max_step=0.1, rtol=1e-9)
    deviation, result = error(master, masses.whole)
    assert result.stats["rejected"] > 0
    assert deviation < 1e-3


def test_acceleration_is_exchanged_across_a_rigid_joint():
    """m = 2 and m = 0.5 rigidly joined on c = 20: cos(sqrt(20/2.5) t)."""
    cut = split(RigidMasses(), "two.flange_a", potential_to="near")
    assert cut.near.states == ()
    master = cut.cosimulation(record=["one.s"], step=0.005, rtol=1e-9)
    result = master.simulate(2.0)
    np.testing.assert_allclose(result["one.s"], np.cos(np.sqrt(8.0) * result.t), atol=2e-3)


def test_algebraic_loop_is_solved(gain):
    """y1 = 0.5 y2 + 1, y2 = 0.5 y1 + 1: both 2."""
    one, two = (SystemParticipant(gain, parameters={"k": 0.5, "b": 1.0}) for _ in range(2))
    result = CoSimulation({"a": one, "b": two}, [("a.y", "b.u"), ("b.y", "a.u")], step=0.1).simulate(0.5)
    np.testing.assert_allclose(result["a.y"], 2.0, rtol=1e-9)
    np.testing.assert_allclose(result["b.y"], 2.0, rtol=1e-9)


def test_inputs_from_outside(decay):
    ramp = CoSimulation({"d": decay}, [], inputs={"d.u": lambda t: t}, step=0.05).simulate(1.0)
    exact = ramp.t - 0.5 + 1.5 * np.exp(-ramp.t / 0.5)
    np.testing.assert_allclose(ramp["y"], exact, atol=1e-5)


def test_result(decay):
    result = CoSimulation({"d": decay}, [], inputs={"d.u": 1.0}, step=0.1).simulate(0.5)
    assert result.names == ("d.y",)
    frame = result.to_dataframe()
    assert list(frame.columns) == ["d.y"] and len(frame) == 6
    assert result.plot("d.y").axes
    with pytest.raises(ac.UnknownNameError, match=r"no signal `d\.z`"):
        result["d.z"]


def test_real_time_pacing(decay):
    result = CoSimulation({"d": decay}, [], inputs={"d.u": 1.0}, step=0.02).simulate(0.1, real_time=2.0)
    assert result.stats["deadlines"] == 5
    assert 0 <= result.stats["missed"] <= 5
    assert result.stats["step_largest"] >= result.stats["step_median"] > 0


def test_divergence_is_reported(gain):
    one, two = (SystemParticipant(gain, parameters={"k": 3.0, "b": 1.0}, outputs=["x"]) for _ in range(2))
    master = CoSimulation({"a": one, "b": two}, [("a.x", "b.u"), ("b.x", "a.u")], step=0.1)
    with pytest.raises(CoSimulationError, match=r"diverged at t = .*: a\.x -> b\.u is .* smaller macro"):
        master.simulate(60.0)
    cut_short = master.simulate(60.0, throw=False)
    assert cut_short.t[-1] < 60.0 and "diverged" in cut_short.result


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"method": "euler"}, "neither 'jacobi' nor 'gauss-seidel'"),
        ({"order": 3}, "degree 0, 1 or 2"),
        ({"control": "energy", "tolerance": 1e-3}, "with power bonds"),
        ({"step": -1.0}, "steps must be positive"),
    ],
)
def test_wrong_options(decay, options, message):
    with pytest.raises(CoSimulationError, match=message):
        CoSimulation({"d": decay}, [], **options)


def test_wrong_names(decay, gain):
    parts = {"d": decay, "g": gain}
    with pytest.raises(ac.UnknownNameError, match=r"no participant `e`"):
        CoSimulation(parts, [("e.y", "g.u")])
    with pytest.raises(ac.UnknownNameError, match=r"`d` has no output `z`. It has: y"):
        CoSimulation(parts, [("d.z", "g.u")])
    with pytest.raises(ac.ConnectError, match=r"`g\.u` is fed by `d\.y` and by `g\.y`"):
        CoSimulation(parts, [("d.y", "g.u"), ("g.y", "g.u")])
    with pytest.raises(ac.UnknownNameError, match="nothing is connected to"):
        CoSimulation(parts, [], bonds=[PowerBond("g.u", "d.u", False, "port")])
    with pytest.raises(CoSimulationError, match="is a int: give a compiled system"):
        CoSimulation({"d": 3}, [])


def test_a_class_is_not_a_model():
    with pytest.raises(ac.DeclarationError, match=r"split takes an instance .*, not the class `TwoMasses`: call it"):
        split(TwoMasses, "middle.flange_a")  # pyright: ignore[reportArgumentType]


@pytest.mark.slow
def test_jax_inside(masses):
    """Any diffrax solver can be inside a participant."""
    import diffrax

    native = masses.cosimulation(record=["one.s"], step=0.05).simulate(1.0)
    for solver, dt in ((diffrax.Tsit5(), None), (ac.RK4(), 0.01), (ac.Rodas5P(), None)):
        other = masses.cosimulation(record=["one.s"], step=0.05, solver=solver, dt=dt).simulate(1.0)
        np.testing.assert_allclose(other["one.s"], native["one.s"], atol=1e-5)


@pytest.mark.parametrize("method", ["jacobi", "gauss-seidel"])
def test_three_participants_in_a_ring(decay, method):
    """``tau y_i' = y_{i-1} - y_i``: the sum stays, the differences die out; against the matrix exponential."""
    from scipy.linalg import expm

    starts = np.array([3.0, 0.0, 0.0])
    parts = {n: SystemParticipant(decay, initial={"y": y}) for n, y in zip("abc", starts, strict=True)}
    ring = [("a.y", "b.u"), ("b.y", "c.u"), ("c.y", "a.u")]
    result = CoSimulation(parts, ring, step=0.005, method=method, order=1).simulate(1.0)
    matrix = (np.roll(np.eye(3), -1, axis=1) - np.eye(3)) / 0.5
    exact = np.array([expm(matrix * t) @ starts for t in result.t])
    found = np.stack([result[f"{n}.y"] for n in "abc"], axis=1)
    np.testing.assert_allclose(found, exact, atol=5e-3)
