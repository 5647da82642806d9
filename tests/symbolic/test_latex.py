"""LaTeX of names and expressions, and of a compiled system's equations."""

from __future__ import annotations

import pytest
from matplotlib.mathtext import MathTextParser

import acausal as ac
from acausal.symbolic.expr import symbol
from acausal.symbolic.latex import name_latex, to_latex

from ..language.parts import RC

x, y, p = symbol(("x",)), symbol(("y",)), symbol(("port_a", "p"))

NAMES = {
    "x": "x",
    "phi": r"\varphi",
    "p_tr": r"p_{\mathrm{tr}}",
    "A1": "A_{1}",
    "dp": r"\mathrm{dp}",
    "time": "t",
    "cells[0].p.v": r"\mathrm{cells}_{0}.\mathrm{p}.v",
    "cells[1:3].rho": r"\mathrm{cells}_{1{:}3}.\rho",
    "port_a.p": r"\mathrm{port}_{a}.p",
    "der(x)": r"\dot{x}",
    "der(x, 2)": r"\ddot{x}",
    "der(a.x)": r"\frac{\mathrm{d}}{\mathrm{d}t} \mathrm{a}.x",
    "der(a.x, 2)": r"\frac{\mathrm{d}^{2}}{\mathrm{d}t^{2}} \mathrm{a}.x",
}


@pytest.mark.parametrize("name", NAMES)
def test_names(name: str) -> None:
    assert name_latex(name) == NAMES[name]
    MathTextParser("path").parse(f"${name_latex(name)}$")


EXPRESSIONS = {
    "sum": (x - y + 2, "x - y + 2"),
    "product": (2 * (x + y), r"2 \, \left(x + y\right)"),
    "quotient": (x / (y + 1), r"\frac{x}{y + 1}"),
    "power": ((x + y) ** 2, r"\left(x + y\right)^{2}"),
    "power of a quotient": ((x / y) ** 2, r"\left(\frac{x}{y}\right)^{2}"),
    "root": (ac.sqrt(x**2 + 1), r"\sqrt{x^{2} + 1}"),
    "function": (ac.sin(x * y), r"\sin\left(x \, y\right)"),
    "magnitude": (ac.abs(x), r"\left|x\right|"),
    "negative": (-(x * y), r"-x \, y"),
    "pi": (2 * ac.PI * x, r"2\pi \, x"),
    "exponent": (1e-9 * x, r"10^{-9} \, x"),
    "derivative": (ac.der(p), r"\frac{\mathrm{d}}{\mathrm{d}t} \mathrm{port}_{a}.p"),
    "black box": (ac.function(abs, name="drag")(x), r"\mathrm{drag}\left(x\right)"),
}


@pytest.mark.parametrize("name", EXPRESSIONS)
def test_expressions(name: str) -> None:
    expression, wanted = EXPRESSIONS[name]
    assert to_latex(expression) == wanted
    MathTextParser("path").parse(f"${wanted}$")


def test_conditions() -> None:
    text = to_latex(ac.where((x > 0) & ~(y <= 1), x, 0))
    condition = r"x > 0 \land \lnot \left(y \le 1\right)"
    assert text == rf"\begin{{cases}} x & \text{{if }} {condition} \\ 0 & \text{{otherwise}} \end{{cases}}"


def test_a_deep_expression_does_not_recurse() -> None:
    e = x
    for _ in range(2000):
        e = ac.sin(e) + y
    assert to_latex(e).count(r"\sin") == 2000


def test_the_equations_of_a_system() -> None:
    system = ac.compile(RC())
    for form in ("flat", "reduced", "sorted"):
        plain, latex = system.equations(form).splitlines(), system.equations(form, latex=True).splitlines()
        assert len(plain) == len(latex)
        for line in latex:
            MathTextParser("path").parse(f"${line}$")
    assert r"\frac{\mathrm{d}}{\mathrm{d}t} \mathrm{capacitor}.v" in system.equations("sorted", latex=True)
    with pytest.raises(ValueError, match="'sorted', 'flat', 'reduced'"):
        system.equations("other")  # type: ignore[arg-type]
