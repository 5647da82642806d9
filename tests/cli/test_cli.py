"""The command line: what it prints, what it writes, and how it says no."""

import csv
import io
import json
import subprocess
import sys
from pathlib import Path

import pytest

from acausal.cli import main
from acausal.cli.status import Status

DECAY = """
import acausal as ac
from acausal import Component, Equations, Parameter, Variable, der

class Decay(Component):
    rate: Parameter = Parameter(2.0, unit="1/s")
    level: Variable = Variable(unit="m", start=1.0, fixed=True)
    twice: Variable = Variable(unit="m")

    def equations(self) -> Equations:
        yield der(self.level) == -self.rate * self.level
        yield self.twice == 2 * self.level

def slow(factor: float = 0.5) -> Decay:
    return Decay(rate=factor)

number = 3
"""


@pytest.fixture
def decay(tmp_path: Path) -> str:
    path = tmp_path / "decay_model.py"
    path.write_text(DECAY)
    return str(path)


def test_help_loads_nothing_heavy() -> None:
    code = (
        "import sys\nfrom acausal.cli import main\n"
        "try: main(['--help'])\nexcept SystemExit: pass\n"
        "print(sorted({'jax', 'sympy', 'matplotlib', 'pandas', 'scipy'} & set(sys.modules)))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.splitlines()[0].startswith("usage: acausal")
    assert done.stdout.splitlines()[-1] == "[]"


def test_simulate_prints_plots_and_saves(decay: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    data, picture = tmp_path / "out" / "decay.csv", tmp_path / "out" / "decay.png"
    words = ["simulate", f"{decay}:Decay", "--set", "rate=1", "--start", "level=3", "--t1", "2", "--saveat", "5"]
    assert main([*words, "--plot", "level", "twice", "--png", str(picture), "--csv", str(data)]) == 0
    printed = capsys.readouterr().out
    assert "Decay: 1 state," in printed
    assert str(data) in printed
    assert str(picture) in printed
    rows = list(csv.DictReader(data.read_text().splitlines()))
    assert [row["t"] for row in rows] == ["0.0", "0.5", "1.0", "1.5", "2.0"]
    assert float(rows[-1]["level"]) == pytest.approx(3 * 2.718281828459045**-2, rel=1e-5)
    assert float(rows[-1]["twice"]) == pytest.approx(2 * float(rows[-1]["level"]))
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_report_as_table_as_json_and_as_equations(decay: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["report", f"{decay}:slow", "--arg", "factor=0.25"]) == 0
    assert "structural index" in capsys.readouterr().out
    assert main(["report", f"{decay}:Decay", "--json", "--equations", "flat"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["states"] == 1
    assert found["structural_index"] <= 1
    assert len(found["equations"]) == 2
    assert main(["report", f"{decay}:Decay", "--equations", "sorted"]) == 0
    assert "der(level) := " in capsys.readouterr().out


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["report", "{}:Decai"], "has no model `Decai`. Did you mean `Decay`"),
        (["report", "{}:number"], "is int, not a component"),
        (["report", "nothing"], "is not of the form package.module:Name"),
        (["report", "no_such_package.part:Name"], "there is no module `no_such_package.part`"),
        (["report", "no_such_file.py:Name"], "there is no file `no_such_file.py`"),
        (["report", "models.kbd:Crane"], "there is no module `models.kbd`. Did you mean `kbc`"),
        (["report", "{}:slow", "--arg", "factr=1"], "has no argument `factr`. Did you mean `factor`"),
        (["report", "{}:Decay", "--arg", "rat=1"], "no field `rat`"),
        (["simulate", "{}:Decay", "--set", "rat=1"], "no parameter `rat`. Did you mean `rate`"),
        (["simulate", "{}:Decay", "--set", "rate=fast"], "`fast` is not a number"),
        (["simulate", "{}:Decay", "--set", "rate"], "write --set NAME=VALUE"),
        (["simulate", "{}:Decay", "--start", "levl=1"], "`level`"),
        (["simulate", "{}:Decay", "--plot", "levle"], "`level`"),
        (["simulate", "{}:Decay", "--solver", "Kvaerno6"], "Did you mean `Kvaerno5`"),
        (["simulate", "{}:Decay", "--saveat", "1"], "at least 2 points"),
    ],
)
def test_wrong_use_is_named(words: list[str], said: str, decay: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main([word.format(decay) for word in words]) == 2
    printed = capsys.readouterr()
    assert said in printed.err
    assert printed.out == ""


def test_status_is_silent_unless_asked_for_where_no_terminal_is() -> None:
    for wanted, shown in ((None, ""), (False, ""), (True, "first\nsecond\n")):
        stream = io.StringIO()
        with Status(wanted, stream) as status:
            status.stage("first")
            status.stage("second")
        assert stream.getvalue() == shown


def test_status_rewrites_one_line_on_a_terminal() -> None:
    class Terminal(io.StringIO):
        def isatty(self) -> bool:
            return True

    stream = Terminal()
    with Status(stream=stream) as status:
        status.stage("a long stage")
        status.stage("short")
    assert "\n" not in stream.getvalue()
    assert "\ra long stage ... 0.0 s" in stream.getvalue()
    assert stream.getvalue().endswith("\r")
