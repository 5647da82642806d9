"""Ensembles: values, statistics, failing members, executors, tables, samplers."""

from __future__ import annotations

import pickle
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from multiprocessing import get_context

import numpy as np
import pandas as pd
import pytest
from scipy import stats

import acausal as ac
from acausal import Equations
from acausal.analysis.members import Job, Member, pack, run_elsewhere
from acausal.components import electrical
from acausal.components.examples import assemble
from acausal.errors import SimulationError, UnknownNameError
from tests.analysis.parts import Explosive, Oscillator, Tank

RATES = np.array([0.2, 0.5, 0.9])


@pytest.fixture(scope="module")
def tank():
    return ac.compile(Tank(), outputs=("V",))


@pytest.fixture(scope="module")
def drained(tank):
    return tank.ensemble({"k": RATES}, 2.0, saveat=11, rtol=1e-9)


def test_members_follow_the_closed_form(drained):
    assert drained["V"].shape == (3, 11)
    assert np.allclose(drained["V"], np.exp(-RATES[:, None] * drained.t), rtol=1e-7)
    assert drained.succeeded.all() and len(drained) == 3
    assert repr(drained) == "Ensemble(Tank: 3 members, 11 times, V)"


def test_statistics_and_export(drained):
    table = drained.statistics("V")
    assert np.allclose(table["mean"], drained["V"].mean(axis=0))
    assert np.allclose(table["50%"], drained["V"][1])
    assert np.allclose(drained.quantile("V", 0.5), drained["V"][1])
    data = drained.to_xarray()
    assert data["V"].dims == ("member", "t") and data["V"].attrs["units"] == "m3"
    assert np.allclose(data["k"], RATES)
    assert np.allclose(drained.to_dataframe()["V (end)"], drained["V"][:, -1])
    assert np.allclose(drained.member(2)["V"], drained["V"][2])


def test_plot_has_a_band_for_each_variable(drained):
    from matplotlib import pyplot

    figure = drained.plot("V", members=2)
    assert figure.axes[0].get_ylabel() == "V\n[m3]"
    assert len(figure.axes[0].collections) == 2 and len(figure.axes[0].lines) == 3
    pyplot.close(figure)


def test_start_values_in_the_table_or_apart(tank):
    in_table = tank.ensemble(pd.DataFrame({"k": RATES, "V": [1.0, 2.0, 3.0]}), 1.0, saveat=3)
    apart = tank.ensemble({"k": RATES}, 1.0, initial={"V": [1.0, 2.0, 3.0]}, saveat=3)
    assert np.array_equal(in_table["V"], apart["V"])
    assert np.array_equal(apart["V"][:, 0], [1.0, 2.0, 3.0])
    dicts = tank.ensemble([{"k": 0.2}, {"k": 0.5}], 1.0, initial={"V": 2.0}, inputs={"u": 1.0}, saveat=3)
    assert np.allclose(dicts["V"][:, -1], 1 / RATES[:2] + (2 - 1 / RATES[:2]) * np.exp(-RATES[:2]), rtol=1e-5)


def test_a_failing_member_is_reported_and_the_others_stay():
    system = ac.compile(Explosive())
    with pytest.warns(RuntimeWarning, match=r"2 of 4 members failed.*member 1, \{'a': 3.0\}"):
        found = system.ensemble({"a": [0.1, 3.0, 0.2, -1.0]}, 1.0, saveat=3)
    assert [f.index for f in found.failures] == [1, 3]
    assert found.failures[0].parameters == {"a": 3.0}
    assert "outside its bounds" in found.failures[1].reason
    assert np.isnan(found["x"][1]).all()
    assert np.allclose(found["x"][[0, 2], -1], [1 / 0.9, 1 / 0.8], rtol=1e-5)
    assert np.isfinite(found.statistics("x")).all(axis=None)


def test_all_members_failing_is_an_error():
    with pytest.raises(SimulationError, match="all 2 members failed; the first one"):
        ac.compile(Explosive()).ensemble({"a": [-1.0, -2.0]}, 1.0)


def test_wrong_tables_are_named(tank):
    with pytest.raises(UnknownNameError, match=r"the table has a column `kk`.*Did you mean `k`"):
        tank.ensemble({"kk": [1.0]}, 1.0)
    with pytest.raises(SimulationError, match="differ in length: `k` 2, `V` 3"):
        tank.ensemble({"k": [1.0, 2.0], "V": [1.0, 2.0, 3.0]}, 1.0)
    with pytest.raises(SimulationError, match="NaN in column `k`"):
        tank.ensemble({"k": [1.0, np.nan]}, 1.0)
    with pytest.raises(SimulationError, match="no row"):
        tank.ensemble(pd.DataFrame({"k": []}), 1.0)
    with pytest.raises(SimulationError, match="2 start values for 1 members"):
        tank.ensemble({"k": [1.0]}, 1.0, initial={"V": [1.0, 2.0]})


def test_progress_tells_what_is_done(tank):
    seen: list[tuple[int, int, int]] = []
    tank.ensemble({"k": RATES}, 1.0, saveat=3, chunk=1, progress=lambda *counts: seen.append(counts))
    assert seen == [(1, 0, 3), (2, 0, 3), (3, 0, 3)]


def test_a_given_thread_pool_stays_open(tank, drained):
    with ThreadPoolExecutor(2) as pool:
        found = tank.ensemble({"k": RATES}, 2.0, saveat=11, rtol=1e-9, executor=pool)
        assert pool.submit(int, "1").result() == 1
    assert np.array_equal(found["V"], drained["V"])


def test_a_pickled_system_is_compiled_again(tank):
    again = pickle.loads(pickle.dumps(tank))
    assert again.states == tank.states and again.outputs == ("V",)


@pytest.mark.slow
def test_processes(tank, drained):
    with ProcessPoolExecutor(2, mp_context=get_context("spawn")) as pool:
        found = tank.ensemble({"k": RATES}, 2.0, saveat=11, rtol=1e-9, executor=pool)
    assert np.allclose(found["V"], drained["V"], rtol=1e-12)


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore")
def test_dask_cluster(tank, drained):
    distributed = pytest.importorskip("distributed")
    with (
        distributed.LocalCluster(
            n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None, protocol="tcp://"
        ) as cluster,
        distributed.Client(cluster) as client,
    ):
        found = tank.ensemble({"k": RATES}, 2.0, saveat=11, rtol=1e-9, executor=client.get_executor(), chunk=1)
        failing = ac.compile(Explosive()).ensemble(
            {"a": [0.1, 3.0]}, 1.0, saveat=3, executor=client.get_executor(), chunk=1
        )
    assert np.allclose(found["V"], drained["V"], rtol=1e-12)
    assert [f.index for f in failing.failures] == [1] and "a" in failing.failures[0].parameters




def test_a_lost_task_is_a_failure_of_its_members(tank, monkeypatch):
    import acausal.analysis.ensemble as module

    real = module.run_members

    def losing(system, job, members):
        if members[0].index == 1:
            raise RuntimeError("the worker is gone")
        return real(system, job, members)

    monkeypatch.setattr(module, "run_members", losing)
    with pytest.warns(RuntimeWarning, match="RuntimeError: the worker is gone"):
        found = tank.ensemble({"k": RATES}, 1.0, saveat=3, chunk=1)
    assert [f.index for f in found.failures] == [1]


# ---- samplers -------------------------------------------------------------------------------------------------------
def test_samples_have_their_distributions():
    n = 4096
    table = ac.draw(
        {"u": (2.0, 4.0), "l": ac.LogBounds(1e-3, 1e3), "n": ac.Normal(5.0, 0.5), "g": ac.LogNormal(2.0, 0.1),
         "w": stats.weibull_min(2.0)}, n, method="sobol",
    )  # fmt: skip
    assert table.shape == (n, 5)
    for name, distribution in {
        "u": stats.uniform(2.0, 2.0), "l": stats.loguniform(1e-3, 1e3), "n": stats.norm(5.0, 0.5),
        "g": stats.lognorm(0.1, scale=2.0), "w": stats.weibull_min(2.0),
    }.items():  # fmt: skip
        assert stats.kstest(table[name], distribution.cdf).statistic < 0.01


@pytest.mark.parametrize("method", ["random", "lhs", "sobol", "halton"])
def test_samples_are_the_same_for_the_same_seed(method):
    one, same, other = (ac.draw({"a": (0, 1), "b": (0, 1)}, 10, method=method, seed=s) for s in (1, 1, 2))
    assert one.equals(same) and not one.equals(other)
    assert one.shape == (10, 2) and ((one > 0) & (one < 1)).all(axis=None)


def test_latin_hypercube_has_one_sample_in_each_stratum():
    table = ac.draw({"a": (0, 1)}, 50, method="lhs")
    assert np.array_equal(np.sort((table["a"] * 50).astype(int)), np.arange(50))


def test_grid_has_every_combination():
    table = ac.grid({"a": [1.0, 2.0], "b": [10.0, 20.0, 30.0]})
    assert table.to_numpy().tolist() == [[1, 10], [1, 20], [1, 30], [2, 10], [2, 20], [2, 30]]


def test_wrong_samples_are_named():
    with pytest.raises(ac.CalibrationError, match="`a`: Bounds\\(2, 1\\) is empty"):
        ac.draw({"a": (2, 1)}, 3)
    with pytest.raises(ac.CalibrationError, match="no method 'mc'"):
        ac.draw({"a": (0, 1)}, 3, method="mc")  # type: ignore[arg-type]
    with pytest.raises(ac.CalibrationError, match="at least one sample"):
        ac.draw({"a": (0, 1)}, 0)


def test_oscillator_keeps_states_by_default():
    found = ac.compile(Oscillator()).ensemble({"c": [4.0]}, 0.1, saveat=2)
    assert found.names == ("s", "v")


def test_a_model_without_states_says_what_to_keep():
    model = assemble(
        "source.p - load.p", "source.n - load.n - ground.p", source=electrical.ConstantVoltage(V=2.0),
        load=electrical.Resistor(R=1.0), ground=electrical.Ground(),
    )  # fmt: skip
    system = ac.compile(model)
    with pytest.raises(SimulationError, match=r"neither states nor outputs: .* `names=\[...\]`"):
        system.ensemble({"load.R": [1.0, 2.0]}, 1.0, progress=False)
    kept = system.ensemble({"load.R": [1.0, 2.0]}, 1.0, names=["load.i"], progress=False)
    assert np.allclose(kept["load.i"][:, -1], [2.0, 1.0])


class Watched(Explosive):
    """It warns where it is large: at an event, or at the points of the result."""

    smooth: bool = False

    def equations(self) -> Equations:
        yield from super().equations()
        small = self.x < 1.5
        yield ac.assert_(ac.noevent(small) if self.smooth else small, "rather large", level="warning")


@pytest.mark.parametrize("smooth", [False, True])
def test_what_members_are_warned_of_is_said_once(smooth):
    system = ac.compile(Watched(smooth=smooth))
    with pytest.warns(UserWarning) as told:
        found = system.ensemble({"a": [0.1, 0.4, 0.5, 0.6]}, 1.0, saveat=101, workers=2, chunk=1)
    (one,) = told
    text = str(one.message)
    assert one.filename == __file__
    assert text.startswith("3 of 4 members have this warning (see `warnings`); member 1, {'a': 0.4}: At t = 0.8")
    assert text.endswith("does not hold: rather large")
    assert [w.index for w in found.warnings] == [1, 2, 3] and not found.failures
    assert found.warnings[2].parameters == {"a": 0.6} and "At t = 0.5" in found.warnings[2].text


def test_warnings_of_another_process_come_back():
    system = ac.compile(Watched())
    job = Job(("x",), 1.0, {"saveat": 3})
    (result,) = run_elsewhere(pack(system), pack(job), [Member(0, {"a": 0.5}, {})])
    assert len(result.warnings) == 1 and "rather large" in result.warnings[0]
