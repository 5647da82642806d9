"""The equations of a compiled system, one a line, as text or LaTeX."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .language.flat_model import Family, FlatModel, sides
from .passes.schedule import Group
from .symbolic.expr import Expr
from .symbolic.printing import to_text

if TYPE_CHECKING:
    from .system import System


class Writer:
    """Names and expressions of one flat model, as text or LaTeX."""

    def __init__(self, flat: FlatModel, latex: bool) -> None:
        self.flat = flat
        self.latex = latex
        self.write: Callable[[Expr, Callable[[Expr], str]], str] = to_text
        self.style: Callable[[str], str] = str
        if latex:
            from .symbolic.latex import name_latex, to_latex

            self.write, self.style = to_latex, name_latex

    def name(self, index: int) -> str:
        """A variable or derivative."""
        return self.style(self.flat.name(int(index)))

    def expression(self, root: Expr, variables: Any, parameters: Any) -> str:
        """An expression over the slots of one row of a family."""

        def leaf(node: Expr) -> str:
            if node.op == "var":
                return self.name(variables[node.value])
            if node.op == "par":
                return self.style(self.flat.parameter_name(int(parameters[node.value])))
            return self.style("time")

        return self.write(root, leaf)

    def equation(self, family: Family, row: int) -> str:
        """One row of a family."""
        lhs, rhs = (self.expression(e, family.var_rows[row], family.par_rows[row]) for e in sides(family.residual))
        return f"{lhs} = {rhs}"

    def words(self, text: str) -> str:
        """Plain words between formulas."""
        return rf"\text{{{text}}}" if self.latex else text


def equation_lines(system: System, form: str, latex: bool) -> list[str]:
    """Equations of one stage.

    Raises:
        ValueError: `form` is not one of the three.
    """
    flat, stages = system.stages.flat, system.stages
    writer = Writer(flat, latex)
    if form == "flat":
        lines = [writer.equation(f, k) for f in flat.families for k in range(f.size)]
        triples = zip(flat.alias_a, flat.alias_b, flat.alias_sign, strict=True)
        lines += [f"{writer.name(a)} = {'-' if s < 0 else ''}{writer.name(b)}" for a, b, s in triples]
        return lines + [f"{writer.name(z)} = 0" for z in flat.zero]
    if form == "reduced":
        return [writer.equation(f, k) for f in stages.index.families for k in range(f.size)]
    if form == "sorted":
        lines = [line for g in stages.schedule.groups for line in _sorted_lines(writer, g)]
        invariants = [writer.equation(f, k) for f in stages.schedule.invariants for k in range(f.size)]
        return lines + [f"{line}{writer.words('    (invariant)')}" for line in invariants]
    raise ValueError(f"form={form!r} is not one of 'sorted', 'flat', 'reduced'")


def _sorted_lines(writer: Writer, group: Group) -> list[str]:
    lines: list[str] = []
    kernel = group.kernel
    assign = r"\;:=\;" if writer.latex else ":="
    for k in range(group.size):
        variables, parameters = group.var_rows[k], group.par_rows[k]
        names = ", ".join(writer.name(variables[t]) for t in kernel.tears)
        if kernel.matrix:
            lines.append(f"{writer.words(f'solve a linear system of {len(kernel.matrix)} for ')}{names}")
        for residual in kernel.residuals:
            text = writer.expression(residual, variables, parameters)
            lines.append(f"0 = {text}{writer.words('    (iterates ')}{names}{writer.words(')')}")
        for unknown, expression in kernel.steps:
            text = writer.expression(expression, variables, parameters)
            lines.append(f"{writer.name(variables[unknown])} {assign} {text}")
    return lines
