"""One section of `RESULTS.md` for each table, with the command that made it."""

from __future__ import annotations

import datetime
import os
import platform
import re
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

RESULTS = Path(__file__).with_name("RESULTS.md")
HEAD = """# Measured

Every table names the command that makes it and is replaced when that command runs again (`make bench` runs them all).
Seconds of wall time unless it says otherwise. Compare what stands in one table: it was measured in one run.
"""


@dataclass(frozen=True)
class Section:
    """A table.

    Attributes:
        key: what identifies the section in the file.
        title: its heading.
        command: the command that makes it.
        text: what is measured, a paragraph or more of Markdown.
        header: column heads.
        rows: cells as text, one tuple a row.
        after: Markdown below the table.
    """

    key: str
    title: str
    command: str
    text: str
    header: Sequence[str]
    rows: Sequence[Sequence[str]]
    after: str = ""

    def markdown(self) -> str:
        """The section as it stands in the file."""
        lines = ["| " + " | ".join(line) + " |" for line in (self.header, *self.rows)]
        lines.insert(1, "|" + "|".join("---" if i == 0 else "--:" for i in range(len(self.header))) + "|")
        parts = [f"## {self.title}", f"`{self.command}` ({conditions()})", self.text, "\n".join(lines), self.after]
        return "\n\n".join(part for part in parts if part) + "\n"


def conditions() -> str:
    """Date, Python, JAX and number of processors of this run."""
    try:
        jax = f", JAX {version('jax')}"
    except PackageNotFoundError:
        jax = ""
    today = datetime.datetime.now(datetime.UTC).date()
    return f"{today}, Python {platform.python_version()}{jax}, {os.cpu_count()} processors"


def write(section: Section, path: Path = RESULTS) -> None:
    """Print a section and put it into the file, in the place of the one with its key."""
    body = section.markdown()
    print(body)
    begin, end = f"<!-- {section.key} -->", f"<!-- end {section.key} -->"
    block = f"{begin}\n{body}{end}\n"
    text = path.read_text(encoding="utf-8") if path.exists() else HEAD
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end) + "\n", re.DOTALL)
    text = pattern.sub(lambda _: block, text) if pattern.search(text) else f"{text.rstrip()}\n\n{block}"
    path.write_text(text, encoding="utf-8")


def seconds(value: float) -> str:
    """A time with three significant digits."""
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"
