"""The `Solution`: names, objects, aliases, arrays, exports, plots."""

from __future__ import annotations

from types import SimpleNamespace

import jax
import jax.numpy as jnp
import numpy as np
import pytest

from acausal.errors import UnknownNameError
from acausal.simulation.simulate import simulate
from acausal.simulation.solution import Solution
from tests.simulation.systems import diode, van_der_pol


@pytest.fixture(scope="module")
def solution():
    return simulate(diode(), 2.0, saveat=21)


def test_by_name_and_by_object(solution):
    assert solution["c.v"].shape == (21,)
    assert isinstance(solution["c.v"], np.ndarray)
    assert np.array_equal(solution[SimpleNamespace(name="i")], solution["i"])
    assert np.allclose(solution["i"], solution["r.v"] + 0.1 * solution["r.v"] ** 3)


def test_alias_with_sign(solution):
    assert np.allclose(solution["alias"], solution["r.v"])


def test_arrays(solution):
    assert solution["all"].shape == (21, 4)
    assert solution[["c.v", "i"]].shape == (21, 2)
    assert np.array_equal(solution["all"][:, 0], solution["c.v"])


def test_unknown_name(solution):
    with pytest.raises(UnknownNameError, match=r"`c\.vv`.*`c\.v`"):
        solution["c.vv"]
    with pytest.raises(KeyError):
        solution["c.vv"]
    assert "c.v" in solution and "nothing" not in solution


def test_without_keeping_everything(solution, monkeypatch):
    monkeypatch.setattr("acausal.simulation.solution.KEEP_ALL", 0)
    fresh = simulate(diode(), 2.0, saveat=21)
    assert np.allclose(fresh["i"], solution["i"])
    assert np.allclose(fresh["all"], solution["all"])
    assert fresh._all is None


def test_to_dataframe_and_csv(solution, tmp_path):
    frame = solution.to_dataframe()
    assert list(frame.columns) == ["c.v", "r.v", "i", "neg"]
    assert frame.attrs["units"]["c.v"] == "V"
    assert frame.index.name == "t"
    wide = solution.to_dataframe(["i", "all"])
    assert list(wide.columns) == ["i", "all[0]", "all[1]", "all[2]", "all[3]"]
    path = solution.to_csv(tmp_path / "run.csv", ["c.v"])
    read = np.genfromtxt(path, delimiter=",", names=True, deletechars="")
    assert np.allclose(read["c.v"], solution["c.v"])


def test_to_xarray(solution):
    data = solution.to_xarray(["c.v", "all"])
    assert data["c.v"].attrs == {"units": "V", "long_name": "text"}
    assert data["all"].shape == (21, 4)
    assert data["t"].attrs["units"] == "s"


def test_plot(solution):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    from matplotlib import pyplot

    figure = solution.plot("c.v", "r.v", "i")
    assert [axis.get_ylabel() for axis in figure.axes] == ["[V]", "[A]"]
    assert [t.get_text() for t in figure.axes[0].get_legend().get_texts()] == ["c.v", "r.v"]
    assert figure.axes[-1].get_xlabel() == "t [s]"
    one = pyplot.figure().subplots()
    assert solution.plot("c.v", ax=one) is one.figure
    with pytest.raises(ValueError, match="one unit"):
        solution.plot("c.v", "i", ax=one)
    pyplot.close("all")


def test_pytree(solution):
    doubled = jax.tree.map(lambda a: 2 * a, solution)
    assert isinstance(doubled, Solution)
    assert np.allclose(doubled.x, 2 * solution.x)
    assert doubled.system is solution.system


@pytest.mark.slow
def test_batch_of_solutions():
    system = van_der_pol()
    batch = jax.vmap(lambda m: simulate(system, 1.0, parameters={"mu": m}, saveat=5))(jnp.array([1.0, 2.0]))
    assert batch.x.shape == (2, 5, 2)
    with pytest.raises(ValueError, match="batch"):
        batch["all"]
    one = jax.tree.map(lambda a: a[1], batch)
    assert one["x"].shape == (5,)


def test_repr(solution):
    assert "21 points" in repr(solution) and "successful" in repr(solution)
