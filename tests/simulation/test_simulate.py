"""`simulate` on hand-written lowered systems: solvers, output, caching, failures, transformations, inputs."""

from __future__ import annotations

import diffrax
import jax
import jax.numpy as jnp
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from acausal.errors import SimulationError, UnknownNameError
from acausal.simulation import RK4, Rodas5P
from acausal.simulation.simulate import simulate
from tests.simulation.systems import HandLowered, HandSystem, diode, ladder, pendulum, robertson, van_der_pol


def test_van_der_pol_against_scipy():
    system = van_der_pol()
    solution = simulate(system, 2.0, parameters={"mu": 5.0}, rtol=1e-9, saveat=jnp.linspace(0, 2, 9))
    reference = solve_ivp(
        lambda t, y: [y[1], 5.0 * (1 - y[0] ** 2) * y[1] - y[0]], (0, 2), [2, 0], "DOP853", np.linspace(0, 2, 9),
        rtol=1e-12, atol=1e-12,
    )  # fmt: skip
    assert np.allclose(solution["x"], reference.y[0], atol=1e-8)
    assert solution.stats["steps"] == solution.stats["accepted"] + solution.stats["rejected"]
    assert solution.result == "successful"


def test_second_run_does_not_compile():
    system = van_der_pol()
    first = simulate(system, 1.0)
    again = simulate(system, 1.5, parameters={"mu": 50.0}, rtol=1e-5, initial={"x": 1.9})
    assert first.stats["compile_seconds"] > 0
    # Only the start is new: it now takes a parameter and a start value.
    assert again.stats["compile_seconds"] < 0.5 * first.stats["compile_seconds"]
    third = simulate(system, 1.5, parameters={"mu": 20.0}, rtol=1e-7, initial={"x": 1.8})
    assert third.stats["compile_seconds"] == 0.0
    assert third["x"][0] == 1.8


def test_robertson_dae():
    solution = simulate(robertson(), 1e5, rtol=1e-9, saveat=diffrax.SaveAt(t1=True))
    assert solution["y1"][-1] == pytest.approx(1.7865920925e-2, rel=1e-7)
    assert solution["y3"][-1] == pytest.approx(0.982134006, rel=1e-8)


@pytest.fixture(scope="module")
def circuit():
    system = diode()
    return system, simulate(system, 10.0, rtol=1e-10)


@pytest.mark.parametrize(
    ("solver", "options", "bound"),
    [(diffrax.Tsit5(), {}, 1e-6), (diffrax.Kvaerno3(), {}, 1e-3), (RK4(), {"dt": 1e-2}, 1e-5)],
    ids=["Tsit5", "Kvaerno3", "RK4"],
)
def test_other_solvers_solve_the_algebraic_part(circuit, solver, options, bound):
    system, reference = circuit
    solution = simulate(system, 10.0, solver=solver, rtol=1e-7, **options)
    assert np.allclose(solution["i"], reference["i"], atol=bound)
    assert solution.w.shape == (501, 1)


def test_fixed_step_needs_dt():
    with pytest.raises(SimulationError, match="dt="):
        simulate(diode(), 1.0, solver=RK4())


def test_backwards(circuit):
    system, reference = circuit
    back = simulate(system, 0.0, t0=5.0, initial={"c.v": reference["c.v"][250]}, rtol=1e-10)
    assert back.t[0] == 5.0 and back.t[-1] == 0.0
    assert back["c.v"][-1] == pytest.approx(0.0, abs=1e-7)


@pytest.mark.parametrize("solver", [None, diffrax.Tsit5()], ids=["Rodas5P", "Tsit5"])
def test_pendulum_full_swing(solver):
    """Exact angle from an accurate solution in the angle; any static choice of states goes singular here."""
    angle = 2 * np.pi / 3
    system = pendulum(angle)
    solution = simulate(system, 10.0, rtol=1e-9, solver=solver)
    exact = solve_ivp(
        lambda t, y: [y[1], -9.81 * np.sin(y[0])], (0, 10), [angle, 0], "DOP853", solution.t, rtol=2.3e-14, atol=1e-14
    )
    assert np.max(np.abs(solution["x"] - np.sin(exact.y[0]))) < 1e-7
    assert np.max(np.abs(solution["x"] ** 2 + solution["y"] ** 2 - 1)) < 1e-9
    energy = (solution["vx"] ** 2 + solution["vy"] ** 2) / 2 + 9.81 * solution["y"]
    assert np.ptp(energy) < 1e-6


def test_saveat_kinds():
    system = van_der_pol()
    assert simulate(system, 1.0, saveat=11).t.tolist() == pytest.approx(np.linspace(0, 1, 11))
    steps = simulate(system, 1.0, saveat=diffrax.SaveAt(t0=True, steps=True), max_steps=500)
    assert len(steps.t) == steps.stats["accepted"] + 1
    assert np.all(np.diff(steps.t) > 0)
    with pytest.raises(SimulationError, match="dense"):
        simulate(system, 1.0, saveat=diffrax.SaveAt(dense=True))


class Blowup(HandLowered):
    x_nominal = np.array([1.0, 1.0])

    def derivatives(self, t, x, w, p):
        return jnp.stack([x[0] ** 2, jnp.sqrt(p[0] - t)]), jnp.zeros(0)


def blowup(limit):
    return HandSystem(Blowup(), ("growing", "root"), (1.0, 0.0), {"limit": limit})


def test_failure_names_time_and_state():
    with pytest.raises(SimulationError, match=r"t = 1\.0000.*\n.*growing") as caught:
        simulate(blowup(10.0), 2.0)
    assert "step size" in str(caught.value)


def test_failure_of_a_root_that_leaves_its_domain():
    with pytest.raises(SimulationError, match=r"t = 0\.5 s of(.|\n)*der\(root\) is nan just beyond"):
        simulate(blowup(0.5), 0.9)


def test_nan_at_the_start():
    with pytest.raises(SimulationError, match=r"der\(root\) is nan"):
        simulate(blowup(-1.0), 1.0)


def test_failure_without_throw():
    solution = simulate(blowup(10.0), 2.0, throw=False)
    assert solution.result == "dt_min_reached"
    assert 0.9 < solution.t[-1] <= 1.0
    assert solution.stats["t_end"] == pytest.approx(1.0, abs=1e-6)


def test_too_few_steps():
    with pytest.raises(SimulationError, match="most steps allowed, 7"):
        simulate(van_der_pol(), 100.0, max_steps=7)


@pytest.mark.slow
def test_gradient_and_vmap():
    system = diode()

    def final(c):
        at = jnp.array([2.0])
        solution = simulate(system, 2.0, parameters={"c.C": c}, rtol=1e-9, saveat=at, max_steps=500)
        return solution["i"][-1]  # through an observed variable

    run = jax.jit(final)
    difference = float(run(0.5 + 1e-4) - run(0.5 - 1e-4)) / 2e-4
    assert float(jax.grad(final)(0.5)) == pytest.approx(difference, rel=1e-5)
    batch = jax.vmap(final)(jnp.array([0.4, 0.5]))
    assert np.allclose(batch, [run(0.4), run(0.5)], atol=1e-9)


def test_solution_through_jit():
    system = van_der_pol()
    solution = jax.jit(lambda m: simulate(system, 1.0, parameters={"mu": m}, saveat=5))(3.0)
    assert solution["x"].shape == (5,)
    assert int(solution.stats["steps"]) > 0


class Driven(HandLowered):
    """x' = -k x + u + v, the inputs u and v being the last parameters."""

    x_nominal = np.ones(1)

    def derivatives(self, t, x, w, p):
        return -p[0] * x + p[1] + p[2], jnp.zeros(0)

    def observe(self, t, x, w, p):
        return jnp.stack([x[0], p[1]])


def driven():
    system = HandSystem(Driven(), ("x",), (0.0,), {"k": 1.0, "u": 0.0, "v": 0.0}, observed=("u",))
    system.input_names = ("u", "v")
    return system


def test_inputs():
    system = driven()
    exact = lambda t: (np.sin(t) - np.cos(t) + np.exp(-t)) / 2 + 2 * (1 - np.exp(-t))  # noqa: E731
    solution = simulate(system, 3.0, inputs={"u": jnp.sin, "v": 2.0}, rtol=1e-9)
    assert np.allclose(solution["x"], exact(solution.t), atol=1e-8)
    assert np.allclose(solution["u"], np.sin(solution.t))
    again = simulate(system, 3.0, inputs={"u": jnp.sin, "v": 3.0}, rtol=1e-9)
    assert again.stats["compile_seconds"] == 0.0
    table = simulate(system, 3.0, inputs={"u": ([0.0, 3.0], [0.0, 3.0])}, rtol=1e-9)
    assert np.allclose(table["x"], table.t - 1 + np.exp(-table.t), atol=1e-8)
    with pytest.raises(UnknownNameError, match="`u`"):
        simulate(system, 1.0, inputs={"uu": 1.0})


def test_sparse_is_chosen_for_large_systems():
    system = ladder(200)
    solution = simulate(system, 1.0)
    dense = simulate(system, 1.0, solver=diffrax.Kvaerno3(), rtol=1e-5, saveat=jnp.array([1.0]))
    assert np.allclose(solution.x[-1], dense.x[-1], atol=1e-4)
    assert "linear_solver" in system.lowered._simulation_cache


def test_explicit_rodas5p_gets_the_mass_matrix(circuit):
    system, reference = circuit
    solution = simulate(system, 10.0, solver=Rodas5P(), rtol=1e-8)
    assert np.allclose(solution["r.v"], reference["r.v"], atol=1e-6)


def test_unknown_engine():
    with pytest.raises(SimulationError, match="engine"):
        simulate(van_der_pol(), 1.0, engine="other")


@pytest.mark.slow
@pytest.mark.parametrize("system", [diode(), pendulum(1.0)], ids=["algebraic unknowns", "invariants"])
def test_forward_mode_through_wrapped_solvers(system):
    name, seen = list(system.defaults)[-1], system.states[0]

    def last(value, **options):
        found = simulate(system, 0.3, parameters={name: value}, rtol=1e-9, saveat=3, **options)
        return found[seen][-1]

    at = float(system.defaults[name])
    forward = jax.jacfwd(lambda v: last(v, solver=diffrax.Tsit5(), adjoint=diffrax.ForwardMode()))(at)
    step = 1e-4 * at
    difference = (last(at + step) - last(at - step)) / (2 * step)
    assert forward == pytest.approx(float(difference), rel=1e-5, abs=1e-9)


def test_forward_mode_without_its_adjoint_is_told():
    with pytest.raises(SimulationError, match=r"need `adjoint=diffrax.ForwardMode\(\)`"):
        jax.jacfwd(lambda mu: simulate(van_der_pol(), 0.3, parameters={"mu": mu})["x"][-1])(2.0)


def test_many_invariants_are_projected_by_conjugate_gradients():
    from acausal.simulation import projection

    class Circles(HandLowered):
        """Points (x_k, y_k) that belong on circles of radius 1, one invariant each."""

        n_x, n_w, n_g = 160, 0, 80
        x_nominal, w_nominal = np.ones(160), np.zeros(0)

        def derivatives(self, t, x, w, p):
            return jnp.concatenate([x[80:], -x[:80]]), jnp.zeros(0)

        def invariants(self, t, x, w, p):
            return x[:80] ** 2 + x[80:] ** 2 - 1.0

    angle = jnp.linspace(0.0, 6.0, 80)
    near = jnp.concatenate([jnp.cos(angle), jnp.sin(angle)]) * jnp.tile(1.0 + 1e-4 * jnp.sin(5 * angle), 2)
    assert projection.DENSE_CONSTRAINTS < Circles.n_g
    x, _ = projection.project(Circles(), 0.0, near, jnp.zeros(0), jnp.zeros(0))
    assert jnp.max(jnp.abs(x[:80] ** 2 + x[80:] ** 2 - 1.0)) < 1e-14
    exact = jnp.concatenate([jnp.cos(angle), jnp.sin(angle)])
    assert jnp.max(jnp.abs(x - exact)) < 1e-12
