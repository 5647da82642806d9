"""Calibration: known answers, uncertainty against linear theory, several experiments, data formats, wrong use."""

from __future__ import annotations

import jax
import jax.numpy as jnp
import numpy as np
import pandas as pd
import pytest
import xarray as xr
from matplotlib import pyplot
from scipy import stats

import acausal as ac
from acausal.analysis.calibrate import Search
from acausal.analysis.priors import decode
from acausal.analysis.residuals import Problem
from acausal.errors import SimulationError, UnknownNameError
from tests.analysis.parts import Explosive, Oscillator, Tank

TIMES = np.linspace(0.1, 6.0, 40)
TRUE = {"c": 5.0, "d": 0.4}
FREE = {"c": (1.0, 20.0), "d": ac.LogBounds(0.01, 10.0)}
SIGMA = {"s": 0.01, "v": 0.03}


@pytest.fixture(scope="module")
def oscillator():
    return ac.compile(Oscillator())


@pytest.fixture(scope="module")
def clean(oscillator):
    solution = oscillator.simulate(6.0, parameters=TRUE, saveat=TIMES, rtol=1e-9)
    return {"t": TIMES, "s": np.asarray(solution["s"]), "v": np.asarray(solution["v"])}


def noisy(clean, seed=0):
    random = np.random.default_rng(seed)
    return {"t": TIMES, **{n: clean[n] + SIGMA[n] * random.normal(size=len(TIMES)) for n in SIGMA}}


@pytest.fixture(scope="module")
def fit(oscillator, clean):
    return ac.calibrate(oscillator, noisy(clean), FREE, sigma=SIGMA)


# ---- values and uncertainty -----------------------------------------------------------------------------------------
def test_exact_data_give_the_true_values(oscillator, clean):
    found = ac.calibrate(oscillator, clean, FREE, sigma=SIGMA, rtol=1e-8)
    assert found.converged
    assert found.parameters == pytest.approx(TRUE, rel=1e-5)
    assert found.cost < 1e-6


def test_noisy_data_give_values_within_their_errors(fit):
    for name, error in fit.standard_errors.items():
        assert abs(fit.parameters[name] - TRUE[name]) < 3 * error
    low, high = fit.confidence(0.95)["c"]
    assert low < TRUE["c"] < high
    assert high - low == pytest.approx(2 * stats.norm.ppf(0.975) * fit.standard_errors["c"], rel=1e-9)
    assert fit.cost == pytest.approx(0.5 * (fit.residuals["residual"] / fit.residuals["sigma"]).pow(2).sum(), rel=1e-6)


def test_covariance_is_the_inverse_of_the_fisher_matrix(oscillator, fit):
    """By central differences of the simulation, independent of the sensitivities."""

    def simulated(**values):
        solution = oscillator.simulate(6.0, parameters={**fit.parameters, **values}, saveat=TIMES, rtol=1e-10)
        return np.concatenate([solution[n] / SIGMA[n] for n in SIGMA])

    slopes = []
    for name, value in fit.parameters.items():
        h = 1e-4 * value
        slopes.append((simulated(**{name: value + h}) - simulated(**{name: value - h})) / (2 * h))
    fisher = np.array(slopes) @ np.array(slopes).T
    assert np.allclose(fit.covariance, np.linalg.inv(fisher), rtol=1e-3)


def test_jacobian_is_the_derivative_of_the_residual(oscillator, clean):
    settings = {"rtol": 1e-9, "engine": "auto", "max_steps": 10_000}
    data = ac.Experiment(noisy(clean), sigma=SIGMA)
    problem = Problem(oscillator, [data], {**FREE, "s": (0.5, 1.5)}, {}, settings)
    values, sigma = np.array([4.0, 0.3, 1.0]), np.ones(problem.size)
    _, jacobian = problem.residual_and_jacobian(values, sigma)
    for k in range(3):
        h = np.eye(3)[k] * 1e-4
        above, below = (problem.residual_and_jacobian(values + s * h, sigma)[0] for s in (1, -1))
        assert np.allclose(jacobian[:, k], (above - below) / 2e-4, atol=1e-5)


def test_unknown_noise_is_estimated_for_each_signal(oscillator, clean):
    fits = [ac.calibrate(oscillator, noisy(clean, seed), FREE) for seed in range(6)]
    found = fits[0]
    for name, sigma in SIGMA.items():
        estimates = [f.residuals.groupby("signal")["sigma"].first()[name] for f in fits]
        assert np.mean(estimates) == pytest.approx(sigma, rel=0.15)
    assert found.noise.estimated == ("s", "v")
    assert found.quantile(0.95) == pytest.approx(stats.t.ppf(0.975, 2 * len(TIMES) - 2))


def test_profile_of_a_nearly_linear_parameter_is_its_interval(fit):
    profile = fit.profile("c")
    assert profile.interval == pytest.approx(fit.confidence()["c"], rel=2e-3)
    assert profile.open == (False, False)
    assert (np.diff(profile.values) > 0).all() and profile.increase.min() == 0.0
    assert profile.parameters.shape == (len(profile.values), 2)


@pytest.mark.slow
def test_intervals_hold_the_true_values(oscillator, clean):
    inside = np.zeros(2)
    for seed in range(100):
        found = ac.calibrate(oscillator, noisy(clean, seed), FREE, sigma=SIGMA)
        inside += [low <= TRUE[n] <= high for n, (low, high) in found.confidence(0.95).items()]
    assert (inside >= 89).all()


# ---- priors, starts, bounds -----------------------------------------------------------------------------------------
def test_a_prior_is_weighed_against_the_data(oscillator, clean):
    """With data as vague as the prior the estimate lies between; the weights are the inverse variances."""
    vague = {n: 100 * s for n, s in SIGMA.items()}
    alone = ac.calibrate(oscillator, clean, {"c": (1.0, 20.0)}, sigma=vague, parameters={"d": 0.4})
    error = alone.standard_errors["c"]
    both = ac.calibrate(oscillator, clean, {"c": ac.Normal(5.02, error)}, sigma=vague, parameters={"d": 0.4})
    assert both.parameters["c"] == pytest.approx(5.01, abs=1e-3)
    assert both.standard_errors["c"] == pytest.approx(error / np.sqrt(2), rel=1e-2)


@pytest.mark.parametrize("prior", [ac.Bounds(1, 9), ac.LogBounds(1, 9), ac.Normal(3, 2), ac.LogNormal(3, 0.5)])
def test_priors_and_their_coordinates(prior):
    for value in (1.5, 3.0, 8.0):
        z = prior.internal(value)
        assert float(decode(prior.kind, *prior.numbers, z)) == pytest.approx(value, rel=1e-12)
    assert prior.quantile(np.array([0.1, 0.9])).shape == (2,)
    assert prior.value(prior.natural(2.0)) == pytest.approx(2.0)


def test_several_starts_find_the_lower_minimum(oscillator):
    """From a wrong frequency the search ends in a local minimum; others of the starts find the right one."""
    solution = oscillator.simulate(12.0, parameters={"c": 30.0}, saveat=60)
    data = {"t": solution.t, "s": solution["s"]}
    free = {"c": ac.LogBounds(0.5, 100.0)}
    one = ac.calibrate(oscillator, data, free, sigma=0.01, start={"c": 1.0})
    several = ac.calibrate(oscillator, data, free, sigma=0.01, start={"c": 1.0}, starts=12)
    assert abs(one.parameters["c"] - 30.0) > 1.0
    assert several.parameters["c"] == pytest.approx(30.0, rel=1e-4)
    assert len(several.starts) == 12 and several.starts["cost"].is_monotonic_increasing


def test_a_parameter_at_its_bound_is_reported(oscillator, clean):
    found = ac.calibrate(oscillator, clean, {"c": (1.0, 4.5), "d": (0.01, 2.0)}, sigma=SIGMA)
    assert found.at_bounds == {"c": "upper"}
    assert "`c` is at its upper bound" in found.summary()


def test_failing_simulations_on_the_way_cost_smaller_steps():
    """``x = 1/(1 - a t)``: a step too far and the solution ends before the last sample."""
    system = ac.compile(Explosive())
    t = np.linspace(0.0, 0.95, 20)
    data = {"t": t, "x": 1 / (1 - t)}
    found = ac.calibrate(system, data, {"a": (0.01, 5.0)}, sigma=0.01)
    assert found.converged and found.parameters["a"] == pytest.approx(1.0, rel=1e-4)
    late = ac.calibrate(system, data, {"a": (0.01, 5.0)}, sigma=0.01, start={"a": 3.0}, starts=4)
    assert late.parameters["a"] == pytest.approx(1.0, rel=1e-4)


def test_a_model_that_fails_at_every_start_says_why():
    data = {"t": [0.0, 1.0], "x": [1.0, 2.0]}
    with pytest.raises(SimulationError, match="stopped at"):
        ac.calibrate(ac.compile(Explosive()), data, {"a": (3.0, 5.0)}, start={"a": 4.0}, sigma=0.1)


# ---- identifiability ------------------------------------------------------------------------------------------------
def test_parameters_that_cannot_be_told_apart_are_named(oscillator, clean):
    """Mass, stiffness and damping act by their ratios alone; `idle` does not act at all."""
    free = {"m": ac.LogBounds(0.1, 10), **FREE, "idle": (0.0, 5.0)}
    found = ac.calibrate(oscillator, noisy(clean), free, sigma=SIGMA).identifiability()
    assert found.without_influence == ("idle",)
    assert found.inseparable == (("m", "c", "d"),)
    assert not found.identifiable
    assert "`idle` has no influence" in str(found)
    assert "`m` and `c` and `d` cannot be told apart" in str(found)


def test_parameters_that_the_data_determine(fit):
    found = fit.identifiability()
    assert found.identifiable and found.collinearity < 2.0
    assert np.allclose(np.diag(found.correlation), 1.0)
    assert str(found).startswith("The data determine every parameter.")


# ---- several experiments --------------------------------------------------------------------------------------------
def test_experiments_with_own_signals_inputs_and_start_values():
    """A tank's outflow from three runs: start values known, free for one, and with a table as inflow."""
    system = ac.compile(Tank(), inputs=("u",))
    k, t = 0.7, np.linspace(0.0, 3.0, 16)
    ramp = (np.array([0.0, 3.0]), np.array([0.0, 3.0]))
    exact = (t / k - 1 / k**2) + (2 + 1 / k**2) * np.exp(-k * t)
    start = {"V": (1.0, 9.0)}
    runs = {
        "drained": ac.Experiment({"t": t, "V": np.exp(-k * t)}, sigma=1e-3),
        "unknown start": ac.Experiment({"time": t[1:], "V": 3 * np.exp(-k * t[1:])}, sigma=1e-3, free=start),
        "another": ac.Experiment({"V": (t[1:], 4 * np.exp(-k * t[1:]))}, sigma=1e-3, free=start),
        "filled": ac.Experiment({"t": t, "V": exact}, sigma=1e-3, initial={"V": 2.0}, inputs={"u": ramp}),
    }
    found = ac.calibrate(system, runs, {"k": ac.LogBounds(0.1, 5.0)}, rtol=1e-8)
    want = {"k": k, "V@unknown start": 3.0, "V@another": 4.0}
    assert found.parameters == pytest.approx(want, rel=1e-4)
    assert len(found.problem.groups) == 3  # the two with a free start are one batch
    assert list(found.residuals["experiment"].unique()) == ["drained", "unknown start", "another", "filled"]
    assert found.residuals["residual"].abs().max() < 1e-4
    assert found.simulate("filled")["V"] == pytest.approx(exact, abs=1e-4)
    with pytest.raises(UnknownNameError, match="Did you mean `filled`"):
        found.simulate("fill")


def test_an_input_that_is_a_function():
    """The native engine does not take it; the fit finds its way."""
    system = ac.compile(Tank(), inputs=("u",))
    t = np.linspace(0.0, 3.0, 12)
    exact = (0.8 * np.sin(t) - np.cos(t) + np.exp(-0.8 * t)) / (1 + 0.64) + np.exp(-0.8 * t)
    data = ac.Experiment({"t": t, "V": exact}, inputs={"u": jnp.sin}, sigma=1e-3)
    found = ac.calibrate(system, data, {"k": (0.1, 2.0)}, rtol=1e-8)
    assert found.parameters["k"] == pytest.approx(0.8, rel=1e-5)


@pytest.mark.slow
def test_engines_find_the_same(oscillator, clean):
    data = noisy(clean)
    one, other = (ac.calibrate(oscillator, data, FREE, sigma=SIGMA, engine=e) for e in ("native", "diffrax"))
    assert one.parameters == pytest.approx(other.parameters, rel=1e-5)
    assert np.allclose(one.covariance, other.covariance, rtol=1e-4)


def test_signals_at_times_of_their_own(oscillator, clean):
    few = TIMES[::7]
    data = {"s": (TIMES, clean["s"]), "v": (few, clean["v"][::7])}
    found = ac.calibrate(oscillator, data, FREE, sigma=SIGMA)
    assert found.parameters == pytest.approx(TRUE, rel=1e-4)
    assert found.residuals.groupby("signal").size().to_dict() == {"s": len(TIMES), "v": len(few)}


@pytest.mark.parametrize("form", ["frame", "index", "xarray", "csv"])
def test_data_formats(form, oscillator, clean, tmp_path):
    frame = pd.DataFrame(clean)
    data = {
        "frame": frame,
        "index": frame.set_index("t"),
        "xarray": xr.Dataset({n: ("t", clean[n]) for n in SIGMA}, {"t": TIMES}),
        "csv": tmp_path / "measured.csv",
    }[form]
    frame.to_csv(tmp_path / "measured.csv", index=False)
    found = ac.calibrate(oscillator, data, FREE, sigma=SIGMA)
    assert found.parameters == pytest.approx(TRUE, rel=1e-4)


def test_another_data_set_of_the_same_shape_needs_no_compilation(oscillator, clean):
    ac.calibrate(oscillator, noisy(clean, 1), FREE, sigma=SIGMA)
    compiled: list[str] = []
    jax.monitoring.register_event_duration_secs_listener(lambda event, *_, **__: compiled.append(event))
    ac.calibrate(oscillator, noisy(clean, 2), FREE, sigma=SIGMA)
    jax.monitoring.clear_event_listeners()
    assert not [event for event in compiled if "backend_compile" in event]


# ---- a user's own loss ----------------------------------------------------------------------------------------------
def test_gradient_of_the_users_own_loss(oscillator, clean, fit):
    def loss(c):
        solution = oscillator.simulate(6.0, parameters={"c": c, "d": 0.4}, saveat=TIMES, rtol=1e-9)
        return jnp.sum((solution["s"] - clean["s"]) ** 2)

    slope = float(jax.grad(loss)(4.0))
    assert slope == pytest.approx(float(loss(4.0 + 1e-4) - loss(4.0 - 1e-4)) / 2e-4, rel=1e-5)


# ---- figures and text -----------------------------------------------------------------------------------------------
def test_summary_and_figures(fit):
    text = fit.summary()
    assert "converged" in text and "95 % interval" in text and "\nc " in text
    figure = fit.plot()
    assert len(figure.axes) == 4 and figure.axes[0].get_ylabel() == "s\n[m]"
    profile = fit.profile("d", points=4).plot()
    assert profile.axes[0].get_xlabel() == "d"
    pyplot.close("all")


# ---- wrong use ------------------------------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("data", "free", "options", "error", "text"),
    [
        ({"t": [1.0], "spped": [1.0]}, FREE, {}, UnknownNameError, "the data has a signal `spped`"),
        ({"t": [1.0, 1.0], "s": [1.0, 2.0]}, FREE, {}, ac.CalibrationError, "do not increase: t = 1 s at sample 0"),
        ({"t": [1.0, 2.0], "s": [1.0, np.nan]}, FREE, {}, ac.CalibrationError, "1 of 2 values of `s` are NaN"),
        ({"t": [1.0, 2.0], "s": [1.0]}, FREE, {}, ac.CalibrationError, "values of shape"),
        ({"t": [-1.0, 2.0], "s": [1.0, 1.0]}, FREE, {}, ac.CalibrationError, "before the start of the experiment"),
        ({"t": [1.0]}, FREE, {}, ac.CalibrationError, "no signal"),
        ({"s": [1.0]}, FREE, {}, ac.CalibrationError, "no times for `s`"),
        (3.0, FREE, {}, ac.CalibrationError, "data of type float is not understood"),
        ([], FREE, {}, ac.CalibrationError, "there is no experiment"),
        (None, {"double": (1, 2)}, {}, ac.CalibrationError, "`double` is computed from other parameters"),
        (None, {"cc": (1, 2)}, {}, UnknownNameError, "`cc` is neither a parameter nor a variable.*Did you mean `c`"),
        (None, {"c": (5, 1)}, {}, ac.CalibrationError, "`c`: Bounds\\(5, 1\\) is empty"),
        (None, {"c": (0, np.inf)}, {}, ac.CalibrationError, "`c`: Bounds\\(0, inf\\): both ends must be finite"),
        (None, {"c": 5.0}, {}, ac.CalibrationError, "`c`: 5.0 is no prior"),
        (None, {"c": (5, 9)}, {}, ac.CalibrationError, "would begin at 4, and it lies outside \\(5 to 9\\)"),
        (None, {"c": (4, 9)}, {}, ac.CalibrationError, "would begin at 4, and it is at the bound"),
        (None, FREE, {"start": {"m": 1.0}}, ac.CalibrationError, "`start` names `m`, which is not free"),
        (None, FREE, {"parameters": {"c": 3.0}}, ac.CalibrationError, "`c` is free and given at once"),
        (None, {"c": (-1, 9)}, {}, ac.CalibrationError, "below its declared minimum 0"),
        (None, {}, {}, ac.CalibrationError, "nothing is free"),
        (None, FREE, {"sigma": {"x": 1.0}}, ac.CalibrationError, "`sigma` names `x`"),
        (None, FREE, {"sigma": -1.0}, ac.CalibrationError, "noise of `s` must be positive"),
        (None, FREE, {"starts": 0}, ac.CalibrationError, "at least one start"),
    ],
)
def test_wrong_use_is_named(oscillator, clean, data, free, options, error, text):
    with pytest.raises(error, match=text):
        ac.calibrate(oscillator, clean if data is None else data, free, **options)


def test_wrong_priors_are_named():
    with pytest.raises(ac.CalibrationError, match="a logarithmic scale needs positive ends"):
        ac.LogBounds(0.0, 1.0)
    with pytest.raises(ac.CalibrationError, match="standard deviation must be finite and positive"):
        ac.Normal(1.0, 0.0)
    with pytest.raises(ac.CalibrationError, match="both must be positive"):
        ac.LogNormal(-1.0, 0.1)


def test_samples_that_are_nan_can_be_dropped(oscillator, clean):
    holes = {**clean, "s": np.where(np.arange(len(TIMES)) == 3, np.nan, clean["s"])}
    found = ac.calibrate(oscillator, ac.Experiment(holes, sigma=SIGMA, missing="drop"), FREE)
    assert found.problem.size == 2 * len(TIMES) - 1


def test_search_holds_coordinates(oscillator, clean):
    settings = {"rtol": 1e-6, "engine": "auto", "max_steps": 10_000}
    problem = Problem(oscillator, [ac.Experiment(clean, sigma=SIGMA, name="one")], FREE, {}, settings)
    search = Search(problem, 1e-6, 50)
    z0 = np.array([f.prior.internal(f.start) for f in problem.free])
    outcome = search.run(z0, np.ones(problem.size), np.array([True, False]))
    assert outcome.values[0] == pytest.approx(4.0) and outcome.z[0] == z0[0]
