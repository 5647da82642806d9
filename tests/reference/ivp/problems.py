"""Test problems written as residual equations in text (json files of this directory), as components."""

from __future__ import annotations

import ast
import json
import types
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

import acausal as ac

DIRECTORY = Path(__file__).parent
_FUNCTIONS: dict[str, Any] = {
    name: getattr(ac, name)
    for name in (
        "sin",
        "cos",
        "tan",
        "sqrt",
        "exp",
        "log",
        "log10",
        "atan",
        "tanh",
        "abs",
        "sign",
        "mod",
        "where",
        "der",
    )
}


def names() -> list[str]:
    """Names of all problems."""
    return sorted(path.stem for path in DIRECTORY.glob("*.json"))


def load(name: str) -> dict[str, Any]:
    """A problem as plain data."""
    return json.loads((DIRECTORY / f"{name}.json").read_text(encoding="utf-8"))


def component(
    problem: Mapping[str, Any],
    *,
    fixed: str = "none",
    attributes: Mapping[str, Mapping[str, Any]] | None = None,
    equations: list[str] | None = None,
) -> ac.Component:
    """An instance of a class made for the problem.

    Args:
        problem: as read from its file: parameters, variables, locals, functions, equations.
        fixed: which start values are equations: ``none``, or those of the ``differential`` variables.
        attributes: further attributes of some variables, as `nominal`.
        equations: other equations than the problem's own.
    """
    variables = [v["name"] for v in problem["variables"]]
    parameters = list(problem["parameters"])
    texts = problem["equations"] if equations is None else equations
    code = [_compiled(text) for text in texts]
    local_code = [(name, _compiled(text)) for name, text in problem["locals"]]

    def body(self: Any) -> ac.Equations:
        scope: dict[str, Any] = {**_FUNCTIONS, "pi": ac.PI, "t": ac.time, "__builtins__": {}}
        scope.update({name: getattr(self, name) for name in (*parameters, *variables)})
        for name, f in problem["functions"].items():
            scope[name] = _function(f["args"], _compiled(f["expr"]), scope)
        for name, text in local_code:
            scope[name] = eval(text, scope)
        for text in code:
            yield eval(text, scope) == 0

    fields: dict[str, Any] = {name: ac.Parameter(value) for name, value in problem["parameters"].items()}
    for v in problem["variables"]:
        hold = fixed == "differential" and v["kind"] == "differential"
        fields[v["name"]] = ac.Variable(start=v["start"], fixed=hold or None, **(attributes or {}).get(v["name"], {}))
    annotations = {k: type(v) for k, v in fields.items()}
    title = "".join(part.capitalize() for part in problem["id"].split("_"))
    namespace = {"__module__": __name__, "__annotations__": annotations, "__doc__": problem["title"], "equations": body}
    cls = types.new_class(title, (ac.Component,), {}, lambda ns: ns.update(namespace | fields))
    return cls()


def reference(problem: Mapping[str, Any]) -> tuple[list[str], np.ndarray]:
    """Names and values of the solution at the end."""
    values = problem["reference"]["values"]
    return list(values), np.array([v if v is not None else np.nan for v in values.values()], float)


def digits(problem: Mapping[str, Any], found: np.ndarray, atol: float | None = None) -> float:
    """Correct significant digits of the worst variable, with a mixed error measure; nan in the reference is ignored."""
    expected = reference(problem)[1]
    given = ~np.isnan(expected)
    floor = 1e-12 * np.nanmax(np.abs(expected)) if atol is None else atol
    error = np.abs(found - expected)[given] / (floor + np.abs(expected[given]))
    return float(np.min(-np.log10(error + 1e-17)))


def _function(arguments: list[str], code: Any, scope: dict[str, Any]) -> Callable[..., Any]:
    def call(*values: Any) -> Any:
        return eval(code, {**scope, **dict(zip(arguments, values, strict=True))})

    return call


class _Conditions(ast.NodeTransformer):
    """``a if c else b`` as ``where(c, a, b)``."""

    def visit_IfExp(self, node: ast.IfExp) -> ast.AST:
        self.generic_visit(node)
        return ast.Call(ast.Name("where", ast.Load()), [node.test, node.body, node.orelse], [])


def _compiled(text: str) -> Any:
    tree = _Conditions().visit(ast.parse(text.strip(), mode="eval"))
    return compile(ast.fix_missing_locations(tree), text, "eval")
