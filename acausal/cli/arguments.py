"""What the command line takes. Imports only the standard library, so that `acausal --help` is instant."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from pathlib import Path

from ..errors import AcausalError, UnknownNameError

TARGET = """\
MODEL names a component class, an instance, or a function that returns one: `package.module:Name` or `file.py:Name`.
Constructor or function arguments follow as --arg, for example
  acausal report models.kbc:reference_crane --arg hydraulics=extended --arg joint=rigid
"""
_EXIT_WRONG = 2
_EXIT_FAILED = 1


def build_parser() -> argparse.ArgumentParser:
    """The whole command line."""
    parser = argparse.ArgumentParser(
        prog="acausal", description="Compile, inspect and simulate acausal models.", allow_abbrev=False
    )
    parser.add_argument("--version", action="store_true", help="print the version and exit")
    parser.add_argument("--traceback", action="store_true", help="on an error show where in the code it arose")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND")

    demo = commands.add_parser("demo", help="the reference crane: four variants, or co-simulation; tables and figures")
    demo.add_argument(
        "what",
        nargs="?",
        choices=("crane", "cosim"),
        default="crane",
        help="crane: simulate the four variants (default); cosim: co-simulate it as FMUs and with MuJoCo",
    )
    demo.add_argument("--out", type=Path, metavar="DIR", help="folder of the figures (demo, demo/cosim)")
    demo.add_argument("--quick", action="store_true", help="cosim: a short run, which shows that everything works")
    _progress_option(demo)

    simulate = _with_model(commands, "simulate", "simulate a model; plot it and save its trajectories")
    simulate.add_argument("--t1", type=float, default=1.0, help="end time [s] (1)")
    simulate.add_argument("--t0", type=float, default=0.0, help="start time [s] (0)")
    simulate.add_argument("--rtol", type=float, default=1e-6, help="relative tolerance (1e-6)")
    simulate.add_argument("--atol", type=float, help="absolute tolerance, a fraction of the nominal values (rtol)")
    simulate.add_argument("--solver", help="Rodas5P (default), or any solver of diffrax by its name, such as Kvaerno5")
    simulate.add_argument("--dt", type=float, help="step of a solver with fixed steps [s]")
    simulate.add_argument("--saveat", type=int, default=501, metavar="N", help="equidistant output points (501)")
    simulate.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="NAME=VALUE",
        dest="settings",
        help="value of a parameter; repeatable",
    )
    simulate.add_argument(
        "--start", action="append", default=[], metavar="NAME=VALUE", help="start value of a variable; repeatable"
    )
    simulate.add_argument("--plot", nargs="+", default=[], metavar="NAME", help="draw these variables")
    simulate.add_argument("--png", type=Path, metavar="FILE", help="where --plot draws (the model's name)")
    simulate.add_argument("--csv", type=Path, metavar="FILE", help="save trajectories as comma-separated values")
    simulate.add_argument(
        "--variables", nargs="+", metavar="NAME", help="what --csv saves (the plotted variables, else the states)"
    )

    report = _with_model(commands, "report", "what the compiler found: index, states, blocks, torn variables")
    report.add_argument("--equations", choices=("sorted", "flat", "reduced"), help="print the equations of one stage")
    report.add_argument("--latex", action="store_true", help="equations as LaTeX")
    report.add_argument("--json", action="store_true", help="print the report as JSON")
    return parser


def _with_model(
    commands: argparse._SubParsersAction[argparse.ArgumentParser], name: str, text: str
) -> argparse.ArgumentParser:
    parser = commands.add_parser(
        name, help=text, description=text, epilog=TARGET, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("model", metavar="MODEL", help="package.module:Name or file.py:Name")
    parser.add_argument(
        "--arg", action="append", default=[], metavar="NAME=VALUE", help="argument of the class or function; repeatable"
    )
    _progress_option(parser)
    return parser


def _progress_option(parser: argparse.ArgumentParser) -> None:
    parser.add_argument(
        "--progress", action=argparse.BooleanOptionalAction, default=None, help="show progress (where a terminal is)"
    )


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line.

    Args:
        arguments: the words after the program's name; default those of the process.

    Returns:
        the exit status: 0, 1 when the work failed, 2 when it was asked for wrongly.
    """
    parser = build_parser()
    chosen = parser.parse_args(arguments)
    if chosen.version:
        from importlib.metadata import version

        print(f"acausal {version('acausal')}")
        return 0
    if chosen.command is None:
        parser.print_help()
        return _EXIT_WRONG
    from .targets import UsageError

    try:
        return _run(chosen)
    except (UsageError, UnknownNameError) as wrong:
        return _say(chosen, wrong, _EXIT_WRONG)
    except (AcausalError, ImportError, OSError) as failed:
        return _say(chosen, failed, _EXIT_FAILED)
    except KeyboardInterrupt:
        print("\nacausal: interrupted", file=sys.stderr)
        return 130


def _say(chosen: argparse.Namespace, error: Exception, status: int) -> int:
    if chosen.traceback:
        raise error
    print(f"acausal {chosen.command}: {error}", file=sys.stderr)
    return status


def _demo(chosen: argparse.Namespace, stage: Callable[[str], None]) -> None:
    if chosen.what == "cosim":
        from models.kbc import cosimulation_demo

        cosimulation_demo.run(chosen.out or Path("demo", "cosim"), stage, quick=chosen.quick)
        return
    if chosen.quick:
        from .targets import UsageError

        raise UsageError("--quick is for `demo cosim`")
    from models.kbc import demo

    demo.run(chosen.out or Path("demo"), stage)


def _run(chosen: argparse.Namespace) -> int:
    os.environ.setdefault("JAX_ENABLE_X64", "1")
    from .status import Status

    with Status(chosen.progress) as status:
        if chosen.command == "demo":
            _demo(chosen, status.stage)
            return 0
        from . import commands

        work = {"simulate": commands.simulate, "report": commands.report}[chosen.command]
        return work(chosen, status)
