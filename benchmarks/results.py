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
DOCS = Path(__file__).parents[1] / "docs"
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
        parts = [f"## {self.title}", self._source(), self.text, self._table(), self.after]
        return "\n\n".join(part for part in parts if part) + "\n"

    def quotation(self) -> str:
        """The table with its source, for a document."""
        return f"{self._table()}\n\n{self._source()}\n"

    def _source(self) -> str:
        return f"`{self.command}` ({conditions()})"

    def _table(self) -> str:
        lines = ["| " + " | ".join(line) + " |" for line in (self.header, *self.rows)]
        lines.insert(1, "|" + "|".join("---" if i == 0 else "--:" for i in range(len(self.header))) + "|")
        return "\n".join(lines)


def conditions() -> str:
    """Date, Python, JAX and number of processors of this run."""
    try:
        jax = f", JAX {version('jax')}"
    except PackageNotFoundError:
        jax = ""
    today = datetime.datetime.now(datetime.UTC).date()
    return f"{today}, Python {platform.python_version()}{jax}, {os.cpu_count()} processors"


def write(section: Section, path: Path = RESULTS, docs: Path = DOCS) -> None:
    """Print a section and put it into the file, in the place of the one with its key.

    Documents that quote the table between ``<!-- key -->`` and ``<!-- end key -->`` get the new one.
    """
    body = section.markdown()
    print(body)
    text = path.read_text(encoding="utf-8") if path.exists() else HEAD
    replaced = _replaced(text, section.key, body)
    if replaced is None:
        begin, end = _marks(section.key)
        replaced = f"{text.rstrip()}\n\n{begin}\n{body}{end}\n"
    path.write_text(replaced, encoding="utf-8")
    for document in sorted(docs.glob("*.md")):
        quoted = _replaced(document.read_text(encoding="utf-8"), section.key, section.quotation())
        if quoted is not None:
            document.write_text(quoted, encoding="utf-8")


def _marks(key: str) -> tuple[str, str]:
    return f"<!-- {key} -->", f"<!-- end {key} -->"


def _replaced(text: str, key: str, body: str) -> str | None:
    """The text with another body between the marks of a key; None if it has none."""
    begin, end = _marks(key)
    pattern = re.compile(re.escape(begin) + ".*?" + re.escape(end) + "\n", re.DOTALL)
    return pattern.sub(lambda _: f"{begin}\n{body}{end}\n", text) if pattern.search(text) else None


def seconds(value: float) -> str:
    """A time with three significant digits."""
    return f"{value:.3g}" if value < 100 else f"{value:.0f}"
