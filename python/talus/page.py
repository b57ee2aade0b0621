"""Tables as Markdown, CSV and HTML, and self-contained HTML pages of tables and pictures."""

import base64
import contextlib
import html
import json
import math
import os
import re
import stat
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

STYLE = """
:root { color-scheme: light; }
body { font: 15px/1.5 Georgia, "DejaVu Serif", serif; color: #1a1a1a; background: #fff;
  max-width: 74rem; margin: 2rem auto; padding: 0 1.5rem; }
h1, h2, h3 { font-family: "Helvetica Neue", Arial, "DejaVu Sans", sans-serif; line-height: 1.25; }
h1 { font-size: 1.7rem; } h2 { font-size: 1.3rem; margin-top: 2.4rem; border-bottom: 1px solid #ccc; }
h3 { font-size: 1.05rem; margin-top: 1.6rem; }
p, li { max-width: 46rem; }
nav { border: 1px solid #ddd; background: #fafaf8; padding: 0.6rem 1rem; font-size: 0.92rem; max-width: 44rem; }
nav ol { margin: 0; padding-left: 1.4rem; columns: 2; } nav a { color: #1f4e79; text-decoration: none; }
nav a:hover { text-decoration: underline; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.86rem; }
div.wide { overflow-x: auto; }
th { text-align: left; vertical-align: bottom; border-bottom: 1.5px solid #444; font-weight: 600; }
td { vertical-align: top; border-bottom: 1px solid #e4e4e4; }
th, td { padding: 0.3rem 0.7rem 0.3rem 0; }
th.number, td.number { text-align: right; font-variant-numeric: tabular-nums; }
.note { display: block; font-size: 0.82em; color: #666; }
.good .note { color: #1b6b35; font-weight: 600; } .bad .note { color: #9a3412; }
.muted { color: #888; }
code, pre { font: 0.86em/1.5 "DejaVu Sans Mono", Consolas, monospace; }
pre { background: #f6f6f4; padding: 0.7rem 1rem; overflow-x: auto; white-space: pre-wrap; }
figure { margin: 1.5rem 0 2rem; } figure img { width: 100%; max-width: 34rem; height: auto; }
figure.wide img { max-width: 100%; }
figcaption { font-size: 0.9rem; max-width: 46rem; }
@page { size: A4 landscape; margin: 12mm; }
@media print {
  body { font-size: 10pt; max-width: none; margin: 0; padding: 0; } div.wide { overflow: visible; }
  table { font-size: 8pt; } tr, figure, pre { break-inside: avoid; } h2, h3 { break-after: avoid; }
}
"""


class Cell(NamedTuple):
    """A cell of a table; HTML has the note below the text, and colours the cell by its tone: good, bad or muted."""

    text: str
    note: str = ""
    tone: str = ""


@dataclass
class Table:
    """Titles of columns, and rows of texts or cells. Rows may have fewer cells than there are titles."""

    titles: list[str]
    rows: Sequence[Sequence[str | Cell]]
    numbers: frozenset[int] = frozenset()  #: columns that HTML aligns to the right

    def csv(self) -> str:
        """Returns CSV. Texts that may contain commas must be quoted (csv_quoted)."""
        return "".join(",".join(map(str, row)) + "\n" for row in [self.titles, *self.rows])

    def markdown(self) -> str:
        """Returns a Markdown table with aligned columns. Texts of a user must be escaped (markdown_escaped)."""
        lines = [list(map(str, row)) for row in [self.titles, *self.rows]]
        widths = [max(3, *(len(text) for text in column)) for column in zip(*lines, strict=True)]
        lines.insert(1, ["-" * width for width in widths])
        filled = ["| " + " | ".join(text.ljust(width) for text, width in zip(line, widths)) + " |\n" for line in lines]
        filled[1] = filled[1].replace(" ", "-")
        return "".join(filled)

    def html(self) -> str:
        head = "".join(_element("th", _escaped(title), "number" * (k in self.numbers)) for k, title in enumerate(self.titles))
        body = "".join(f"<tr>{''.join(self._cell(k, cell) for k, cell in enumerate(row))}</tr>\n" for row in self.rows)
        return f'<div class="wide"><table>\n<thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody></table></div>\n'

    def _cell(self, k: int, cell: str | Cell) -> str:
        text, note, tone = Cell(cell) if isinstance(cell, str) else cell
        inside = _escaped(text) + (f'<span class="note">{_escaped(note)}</span>' if note else "")
        return _element("td", inside, " ".join(filter(None, ["number" * (k in self.numbers), tone])))


def heading(level: int, text: str) -> str:
    anchor = re.sub("[^a-z0-9]+", "-", text.lower()).lstrip("-")
    return f'<h{level} id="{anchor}">{_escaped(text)}</h{level}>\n'


def paragraph(text: str) -> str:
    return f"<p>{_escaped(text)}</p>\n"


def bullets(items: Iterable[str]) -> str:
    return "<ul>\n" + "".join(f"<li>{_escaped(item)}</li>\n" for item in items) + "</ul>\n"


def commands(lines: Iterable[str]) -> str:
    return "<pre>" + "".join(_escaped(line) + "\n" for line in lines) + "</pre>\n"


def picture(png: Path, title: str, caption: str, wide: bool) -> str:
    """Returns a PNG, built into the page, above its title and caption."""
    data = base64.b64encode(png.read_bytes()).decode()
    inside = (f'<img alt="{_escaped(title)}" src="data:image/png;base64,{data}">\n'
              f"<figcaption><strong>{_escaped(title)}.</strong> {_escaped(caption)}</figcaption>")
    return _element("figure", inside, "wide" * wide) + "\n"


def page(title: str, introduction: str, sections: str) -> str:
    """Returns an HTML page whose contents list the headings of level 2. Texts between backticks are set as code."""
    links = "".join(f'<li><a href="#{anchor}">{text}</a></li>\n'
                    for anchor, text in re.findall('<h2 id="(.*?)">(.*?)</h2>', sections))
    return ('<!DOCTYPE html>\n<html lang="en">\n<head>\n<meta charset="utf-8">\n<meta name="viewport" '
            f'content="width=device-width, initial-scale=1">\n<title>{_escaped(title)}</title>\n<style>{STYLE}</style>\n'
            f"</head>\n<body>\n<h1>{_escaped(title)}</h1>\n{paragraph(introduction)}<nav><ol>\n{links}</ol></nav>\n{sections}"
            "</body>\n</html>\n")


def _element(tag: str, inside: str, classes: str) -> str:
    attribute = f' class="{classes}"' if classes else ""
    return f"<{tag}{attribute}>{inside}</{tag}>"


def _escaped(text: str) -> str:
    parts = html.escape(text, quote=False).replace('"', "&quot;").split("`")
    return "".join(part if k % 2 == 0 else f"<code>{part}</code>" for k, part in enumerate(parts))


def markdown_escaped(text: str) -> str:
    """Escapes a text for a cell of a Markdown table, so that it contains no HTML, link or column separator."""
    return re.sub(r"([\[\]|*`])", r"\\\1", visible(text).replace("&", "&amp;").replace("<", "&lt;").replace("\n", " "))


def csv_quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def visible(text: str) -> str:
    r"""Returns the text with \xNN in place of control characters and of bytes that are not UTF-8; line ends are kept."""
    return "".join(c if c.isprintable() or c == "\n" else "".join(f"\\x{byte:02x}" for byte in c.encode("utf-8", "surrogateescape"))
                   for c in text)


def plus_minus(mean: float, width: float, sign: bool = False) -> str:
    """Returns "16.43 ± 0.21": the width, which must be positive, with two digits, and the mean with as many decimals.
    `sign` adds a plus before a mean that is not negative."""
    decimals = min(max(1 - math.floor(math.log10(width)), 0), 12)
    return f"{mean:{'+' if sign else ''}.{decimals}f} ± {width:.{decimals}f}"


def listed(words: Sequence[str]) -> str:
    """Joins words as "a, b and c"."""
    return " and ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))


def json_text(value: Any) -> str:
    """Returns JSON with the shortest digits of numbers, and null for NaN."""
    def plain(item: Any) -> Any:
        if isinstance(item, dict):
            return {name: plain(member) for name, member in item.items()}
        if isinstance(item, (list, tuple)):
            return [plain(member) for member in item]
        if isinstance(item, float):
            return None if not math.isfinite(item) else int(item) if item.is_integer() and abs(item) < 1e7 else item
        return item.encode("utf-8", "surrogateescape").decode("utf-8", "replace") if isinstance(item, str) else item

    return json.dumps(plain(value), indent=2, ensure_ascii=False)


def write_text(path: Path, text: str) -> None:
    """Writes a file whose name appears once it is complete. It keeps the mode and, if possible, the owner of an earlier one."""
    path = Path(os.path.realpath(path))
    part = path.with_name(path.name + ".talus.part")
    try:
        with part.open("w", encoding="utf-8", errors="surrogateescape", newline="") as file:
            file.write(text)
            file.flush()
            with contextlib.suppress(FileNotFoundError, PermissionError):
                earlier = path.stat()
                os.fchmod(file.fileno(), stat.S_IMODE(earlier.st_mode))
                os.fchown(file.fileno(), earlier.st_uid, earlier.st_gid)
            os.fsync(file.fileno())
        part.replace(path)
    except BaseException:
        part.unlink(missing_ok=True)
        raise
