"""The examples run and say what they claim."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType

import pytest

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


@pytest.fixture(autouse=True)
def _agg(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("MPLBACKEND", "Agg")
    monkeypatch.syspath_prepend(str(EXAMPLES))


def load(name: str) -> ModuleType:
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    assert spec is not None and spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


@pytest.mark.slow
@pytest.mark.parametrize("name", ["car", "quarter_car"])
def test_cars(name: str, tmp_path: Path) -> None:
    load(name).main(tmp_path / "car.png")
    assert (tmp_path / "car.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.slow
def test_pendulum_keeps_its_length(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    load("pendulum").main(tmp_path / "pendulum.png")
    printed = capsys.readouterr().out
    assert "structural index    3" in printed
    assert float(printed.split("stays within")[1].split()[0]) < 1e-9


@pytest.mark.slow
def test_gradient_finds_the_damper(capsys: pytest.CaptureFixture[str]) -> None:
    load("quarter_car")
    assert load("gradient").main() == pytest.approx(870.0, abs=5.0)
    assert "after" in capsys.readouterr().out
