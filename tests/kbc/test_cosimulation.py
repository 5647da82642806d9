"""The crane's co-simulation: the paper's rows, the sweep, the adaptive master, tables and figures."""

from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pytest

from acausal.cli import main
from acausal.fmi import CoSimulationError
from models.kbc.cosimulation import (
    SETTINGS,
    Outcome,
    Reference,
    cosimulate,
    cut_crane,
    mujoco_boom,
    rigid_crane,
    run_setting,
    whole_crane,
)
from models.kbc.cosimulation_demo import (
    QUICK,
    Experiment,
    Extent,
    adaptive_table,
    draw,
    experiment,
    format_table,
    sweep_table,
    table_2,
)
from models.kbc.cosimulation_sweep import compare_adaptive, largest_step, sweep

FIGURES = ["fig12_deviation", "fig13_flow", "fig14_pressure", "macro_step", "energy_residual"]
ROWS = {s.label: s for s in SETTINGS}


@pytest.fixture(scope="module")
def cut():
    return cut_crane()


@pytest.fixture(scope="module")
def reference(cut):
    return whole_crane(cut, 3.0)


def test_the_cut_gives_the_boom_the_torque(cut):
    """The boom keeps its own angle; hydraulics and joint are told angle and velocity."""
    assert cut.connections == (
        ("boom.boom_flange_phi", "hydraulics.boom_flange_phi"), ("hydraulics.boom_flange_tau", "boom.boom_flange_tau"),
    )  # fmt: skip
    assert [b.derivative for b in cut.bonds] == [True]
    assert cut.near.states == ("boom.phi", "boom.w") and len(cut.far.states) == 10


def test_rmse_is_over_time():
    t = np.array([0.0, 1.0, 3.0])
    reference = Reference(t, {"cylinder.x": np.zeros(3)}, 0.0)
    assert reference.rmse(t, np.full(3, 2.0)) == pytest.approx(2.0)
    assert reference.rmse(t, np.array([3.0, 3.0, 0.0]), until=1.0) == pytest.approx(3.0)
    assert reference.rmse(t, np.array([0.0, 0.0, 3.0])) == pytest.approx(np.sqrt(9.0 * 2 / 2 / 3))


@pytest.mark.slow_case("RK4, FMU and MuJoCo", "Rodas5P, two FMUs of FMI 3.0")
@pytest.mark.parametrize("label", ["RK4, two FMUs", "RK4, FMU and MuJoCo", "Rodas5P, two FMUs of FMI 3.0"])
def test_a_row_of_table_2(cut, reference, label, tmp_path):
    row = run_setting(cut, reference, ROWS[label], tmp_path, 3.0)
    assert not row.diverged and row.steps == 300 and row.end == pytest.approx(3.0)
    assert row.rmse <= 0.1e-3
    assert row.energy < 1e-3
    hydraulics = row.result.stats["participants"]["hydraulics"]
    assert hydraulics["macro_steps"] == 300


def test_mujoco_is_the_same_boom(cut):
    """Alone under a torque: angle, velocity and acceleration as those of the boom's own equations."""
    torque = np.zeros((1, 4))
    torque[0, :2] = 6e5, 1e5
    own, engine = cut.participant("near"), mujoco_boom(cut, step=1e-3)
    for part in (own, engine):
        part.require("boom_flange_phi", 2)
        part.initialize(0.0, torque)
        for k in range(50):
            moved = torque.copy()
            moved[0, 0] += 0.01 * k * torque[0, 1]
            part.step(0.01 * k, 0.01, moved)
    at_end = np.array([[torque[0, 0] + 0.5 * torque[0, 1], torque[0, 1], 0.0, 0.0]])
    a, b = (p.evaluate(0.5, at_end)[:, p.outputs.index("boom_flange_phi")] for p in (own, engine))
    assert abs(a[0] - cut.whole.simulate(0.0, saveat=[0.0])["boom.phi"][0]) > 0.1
    np.testing.assert_allclose(b, a, rtol=2e-6)


def test_the_sweep_converges_and_diverges(cut, reference):
    """Errors fall with the order of the extrapolation plus one; Jacobi with parabolas is the first that diverges."""
    runs = sweep(cut, reference, (5e-3, 2e-2), 1.0)
    by_method = {(r.method, r.order, r.step): r for r in runs}
    for method, order in (("jacobi", 0), ("jacobi", 1), ("gauss-seidel", 0), ("gauss-seidel", 1), ("gauss-seidel", 2)):
        coarse, fine = (by_method[method, order, h] for h in (2e-2, 5e-3))
        assert np.log(coarse.rmse / fine.rmse) / np.log(4.0) > 0.85 * min(order + 1, 2), (method, order)
        assert fine.energy < coarse.energy
    lost = by_method["jacobi", 2, 2e-2]
    assert lost.diverged and np.isnan(lost.rmse) and np.isinf(lost.energy)
    assert 5e-3 < largest_step(cut, reference, "jacobi", 2, 1.0) < 2e-2


def test_adaptive_steps_are_accepted_at_the_same_error(cut, reference):
    found = compare_adaptive(cut, reference, 1e-3, 3.0, method="gauss-seidel", order=2)
    assert found.fixed.rmse <= found.adaptive.rmse < 1e-4
    assert np.isnan(found.adaptive.step) and found.adaptive.tried > found.adaptive.steps
    assert np.ptp(np.diff(found.adaptive.result.t)) > 1e-3


def test_an_adaptive_run_that_no_fixed_step_reaches(cut, reference, monkeypatch):
    from models.kbc import cosimulation_sweep

    def made_up(*_: object, tolerance: float | None = None, **options: float) -> Outcome:
        return outcome(steps=10, rmse=0.0 if tolerance else options["step"])

    monkeypatch.setattr(cosimulation_sweep, "cosimulate", made_up)
    with pytest.raises(CoSimulationError, match=r"no fixed step down to .* s is as accurate as tolerance 0.01"):
        compare_adaptive(cut, reference, 1e-2, 1.0)


def test_the_fixed_step_is_found_by_bisection(cut, reference, monkeypatch):
    """An error of 1/n: as many steps as the adaptive run's error asks for, within 5 % or one."""
    from models.kbc import cosimulation_sweep

    for wanted in (1, 2, 13, 14, 700):

        def made_up(*_: object, tolerance: float | None = None, wanted: int = wanted, **options: float) -> Outcome:
            n = 100 if tolerance else round(1.0 / options["step"])
            return outcome(steps=n, rmse=1.0 / wanted if tolerance else 1.0 / n)

        monkeypatch.setattr(cosimulation_sweep, "cosimulate", made_up)
        found = compare_adaptive(cut, reference, 1e-2, 1.0).fixed.steps
        assert wanted <= found <= max(1.05 * wanted, wanted + 1)


def test_the_rigid_model_on_the_same_axes(reference):
    rmse, factor = rigid_crane(reference)
    assert 2e-4 < rmse < 2e-3
    assert 0 < factor < 1


def outcome(**given) -> Outcome:
    """A made-up run."""
    from acausal.fmi import CoSimulationResult

    t = np.linspace(0.0, 2.0, 21)
    names = ("boom.boom.phi", "hydraulics.cylinder.x", "hydraulics.cylinder.port_a.q", "hydraulics.cylinder.p_a")
    result = CoSimulationResult(t, {n: t for n in names}, {}, {"b": t}, {"b": t}, 0 * t, {})
    one = Outcome("RK4, two FMUs", "jacobi", 1, 1e-2, 200, 3, 1e-4, 1e-5, 0.1, 2.0, result)
    return dataclasses.replace(one, **given)


def test_tables_and_figures(tmp_path):
    """Of made-up runs, so that what they show is known."""
    from models.kbc.cosimulation_sweep import METHODS, Comparison

    extent = dataclasses.replace(QUICK, steps=(1e-2,), settings=SETTINGS[:1])
    t = np.linspace(0.0, 3.0, 31)
    reference = Reference(t, {n: t for n in ("cylinder.x", "cylinder.port_a.q", "cylinder.p_a")}, 2e-4)
    lost = dataclasses.replace(outcome().result, result="diverged")
    runs = [outcome(method=m, order=o) for m, o in METHODS[:-1]]
    runs.append(outcome(method="gauss-seidel", order=2, result=lost))
    limits = dict.fromkeys(METHODS, 0.02) | {("gauss-seidel", 2): 0.2}
    pair = Comparison(outcome(steps=70, rejected=10), outcome(steps=100), 1e-3)
    found = Experiment(
        extent, reference, (7e-4, 2.5e-4), [outcome(rmse=2e-4)], [1e-4], runs, [outcome()], limits, [("step", pair)]
    )
    head, (first, compliant, rigid) = table_2(found)
    assert head[5] == "RMSE over 3 s [mm]"
    assert first == ("RK4, two FMUs", "0.1", "0.19", "0.100", "0.52", "0.200", "1.0e-05")
    assert compliant[1] == "0.0002" and rigid[5] == "0.700"
    _, (step, largest) = sweep_table(found)
    assert step[0] == "10" and step[1] == "0.1" and step[-1] == "diverges"
    assert largest[1] == "20" and largest[-1] == "> 200"
    _, (saved,) = adaptive_table(found)
    assert saved == ("step, Jacobi 1, 0.001", "0.1", "70", "10", "100", "20%")
    text = format_table(table_2(found)).splitlines()
    assert len(text) == 5 and len(set(map(len, text))) == 1
    files = draw(found, tmp_path / "made")
    assert [f.stem for f in files] == FIGURES
    assert all(f.read_bytes().startswith(b"\x89PNG") for f in files)


def test_the_whole_experiment_in_small(tmp_path):
    tiny = Extent(0.8, 1.0, 0.2, (1e-2,), (1e-2,), ("sine",), SETTINGS[4:5])
    said: list[str] = []
    found = experiment(tiny, said.append)
    assert "Table 2: Rodas5P, two FMUs" in said and "where it diverges: jacobi, order 2" in said
    assert found.rows[0].rmse < 1e-4 and found.short[0] < 1e-4
    assert len(found.runs) == 6 and len(found.adaptive) == 2
    assert [s for s, _ in found.comparisons] == ["sine", "sine"]


@pytest.mark.slow
def test_command_line(tmp_path, monkeypatch, capsys):
    """`acausal demo cosim --quick` runs the quick extent and says where the figures are."""
    from models.kbc import cosimulation_demo

    tiny = Extent(0.1, 0.1, 0.1, (1e-2,), (1e-2,), (), SETTINGS[:1])
    monkeypatch.setattr(cosimulation_demo, "QUICK", tiny)
    assert main(["demo", "cosim", "--quick", "--out", str(tmp_path / "out"), "--progress"]) == 0
    printed = capsys.readouterr()
    assert "RK4, two FMUs" in printed.out and "Gauss-Seidel, 2" in printed.out
    assert all(str(tmp_path / "out" / f"{name}.png") in printed.out for name in FIGURES)
    assert "Table 2: RK4, two FMUs" in printed.err
    assert main(["demo", "--quick"]) == 2
    assert "--quick is for `demo cosim`" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.parametrize("setting", SETTINGS[:4], ids=lambda s: s.label)
def test_a_minute_is_stable_and_as_accurate_as_the_paper(cut, setting, tmp_path):
    """60 s at 10 ms: RMSE within the paper's figures, 0.52 mm with FMUs and 0.55 mm with the physics engine."""
    reference = whole_crane(cut, 60.0)
    row = run_setting(cut, reference, setting, tmp_path, 60.0)
    assert not row.diverged and row.end == pytest.approx(60.0)
    bound = 0.55e-3 if setting.mujoco else 0.52e-3
    assert row.rmse <= bound
    assert reference.rmse(row.result.t, row.result["cylinder.x"], 20.0) <= bound


@pytest.mark.filterwarnings("ignore:.*below a vacuum:UserWarning")  # on the rod side, at a step
@pytest.mark.slow
@pytest.mark.parametrize("scenario", ["sine", "step"])
@pytest.mark.parametrize(("method", "order"), [("jacobi", 1), ("gauss-seidel", 2)])
def test_the_adaptive_master_takes_fewer_steps(scenario, method, order):
    cut = cut_crane(scenario)
    found = compare_adaptive(cut, whole_crane(cut, 20.0), 1e-3, 20.0, method=method, order=order)
    assert found.adaptive.tried < found.fixed.steps


def test_the_master_is_closed_when_a_run_diverges(cut, reference):
    """A run that diverges is an outcome, and its trajectories end where it was lost."""
    run = cosimulate(cut, reference, 3.0, method="jacobi", order=2, step=0.05)
    assert run.diverged and np.isnan(run.rmse)


def test_figures_go_into_a_new_folder(tmp_path: Path):
    from models.kbc.cosimulation_figures import draw_signals

    t = np.linspace(0.0, 2.0, 21)
    reference = Reference(t, {n: t for n in ("cylinder.x", "cylinder.port_a.q", "cylinder.p_a")}, 2e-4)
    (tmp_path / "a").mkdir()
    assert len(draw_signals(reference, [outcome()], 2.0, tmp_path / "a")) == 3
