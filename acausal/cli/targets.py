"""From the words of the command line to a model, its arguments and its values."""

from __future__ import annotations

import ast
import importlib
import importlib.util
import inspect
import sys
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType
from typing import Any

from ..errors import nearest
from ..language.component import Component


class UsageError(Exception):
    """The command line asks for something that is not there."""


def load_model(target: str, arguments: Sequence[str]) -> Component:
    """The model that `module:Name` or `file.py:Name` stands for.

    Args:
        target: where the component class, instance or function is.
        arguments: `name=value` words for the class or function.

    Raises:
        UsageError: there is no such module, name or argument; the nearest names are given.
    """
    place, colon, name = target.rpartition(":")
    if not colon or not place or not name:
        raise UsageError(f"`{target}` is not of the form package.module:Name or file.py:Name")
    module = _module(place)
    if not hasattr(module, name):
        models = _models_of(module)
        listed = nearest(name, models) or (f" It has {', '.join(models)}." if models else "")
        raise UsageError(f"module `{place}` has no model `{name}`.{listed}")
    found = getattr(module, name)
    given = {key: _literal(value) for key, value in pairs(arguments, "--arg").items()}
    if isinstance(found, Component):
        if given:
            raise UsageError(f"`{target}` is an instance: it takes no --arg; set its parameters with --set")
        return found
    if not callable(found):
        raise UsageError(f"`{target}` is {type(found).__name__}, not a component or a function that returns one")
    _check_arguments(found, given, target)
    try:
        made = found(**given)
    except (TypeError, ValueError) as wrong:
        raise UsageError(f"`{target}` cannot be made with these arguments: {wrong}") from wrong
    if not isinstance(made, Component):
        raise UsageError(f"`{target}` returned {type(made).__name__}, not a component")
    return made


def _module(place: str) -> ModuleType:
    if place.endswith(".py"):
        path = Path(place)
        spec = importlib.util.spec_from_file_location(path.stem, path)
        if not path.is_file() or spec is None or spec.loader is None:
            raise UsageError(f"there is no file `{place}`")
        module = importlib.util.module_from_spec(spec)
        sys.modules.setdefault(path.stem, module)
        sys.path.insert(0, str(path.resolve().parent))
        spec.loader.exec_module(module)
        return module
    here = str(Path.cwd())
    if here not in sys.path:
        sys.path.insert(0, here)
    try:
        return importlib.import_module(place)
    except ModuleNotFoundError as missing:
        if missing.name is None or not f"{place}.".startswith(f"{missing.name}."):
            raise
        raise UsageError(f"there is no module `{place}`.{_near_modules(missing.name)}") from missing


def _near_modules(name: str) -> str:
    import pkgutil

    parent, _, last = name.rpartition(".")
    path = getattr(sys.modules.get(parent), "__path__", None) if parent else [str(Path.cwd())]
    return nearest(last, [m.name for m in pkgutil.iter_modules(path)] if path else [])


def _models_of(module: ModuleType) -> list[str]:
    return [
        name
        for name, value in vars(module).items()
        if not name.startswith("_")
        and (isinstance(value, Component) or (inspect.isclass(value) and issubclass(value, Component)))
    ] + [name for name, value in vars(module).items() if inspect.isfunction(value) and not name.startswith("_")]


def _check_arguments(function: Any, given: dict[str, Any], target: str) -> None:
    """Unknown keywords of a plain function; a component class checks its own."""
    if inspect.isclass(function):
        return
    parameters = inspect.signature(function).parameters
    if any(p.kind is inspect.Parameter.VAR_KEYWORD for p in parameters.values()):
        return
    for key in given:
        if key not in parameters:
            raise UsageError(f"`{target}` has no argument `{key}`.{nearest(key, parameters)}")


def _literal(text: str) -> Any:
    try:
        return ast.literal_eval(text)
    except (ValueError, SyntaxError):
        return text


def pairs(words: Sequence[str], option: str) -> dict[str, str]:
    """`name=value` words as a dict, in order.

    Raises:
        UsageError: a word without `=`.
    """
    found: dict[str, str] = {}
    for word in words:
        name, equals, value = word.partition("=")
        if not equals or not name.strip():
            raise UsageError(f"{option} {word}: write {option} NAME=VALUE")
        found[name.strip()] = value.strip()
    return found


def numbers(words: Sequence[str], option: str) -> dict[str, float]:
    """`name=value` words with numbers.

    Raises:
        UsageError: a value that is not a number.
    """
    found: dict[str, float] = {}
    for name, value in pairs(words, option).items():
        try:
            found[name] = float(value)
        except ValueError:
            raise UsageError(f"{option} {name}={value}: `{value}` is not a number") from None
    return found
