"""Pages of HTML that need nothing beside themselves, on a screen and printed."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from datetime import date
from html import escape
from importlib.metadata import version
from pathlib import Path
from string import Template
from typing import TYPE_CHECKING

from ..files.output_file import output_file
from .figures import svg_of
from .tables import Facts

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_PAGE = Template("""\
<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>$title</title>
<style>
body { font: 16px/1.5 system-ui, sans-serif; color: #1a1a1a; background: white;
       max-width: $width; margin: 2rem auto; padding: 0 1rem; }
h1 { font-size: 1.5rem; line-height: 1.25; } h2 { font-size: 1.2rem; margin-top: 2rem; }
svg { width: 100%; height: auto; }
table { border-collapse: collapse; margin: 1rem 0; font-size: 0.9rem; }
th, td { text-align: left; padding: 0.25rem 0.9rem 0.25rem 0; border-bottom: 1px solid #ddd;
         vertical-align: top; font-variant-numeric: tabular-nums; }
.facts th { font-weight: 600; white-space: nowrap; }
.facts td { overflow-wrap: anywhere; }
.warning { border-left: 4px solid #D55E00; background: #fdf3ec; padding: 0.5rem 0.9rem;
           margin: 0.6rem 0; }
footer { color: #666; font-size: 0.85rem; margin-top: 2.5rem; }
.wide { overflow-x: auto; }
$style
@media screen and (max-width: 40rem) {
  .wide svg { min-width: 36rem; }
  .wide td:last-child { min-width: 11rem; }
  .facts th { white-space: normal; overflow-wrap: anywhere; min-width: 6rem; }
}
@media print {
  html { font-size: 11px; }
  body { font-size: 1rem; max-width: none; margin: 0; }
  .wide { overflow: visible; }
  h1, h2 { break-after: avoid; }
  thead { display: table-header-group; }
  tr, svg { break-inside: avoid; }
  svg { width: auto; max-width: 100%; max-height: 16cm; }  /* on a page with some text */
}
</style>
</head>
<body>
<h1>$title</h1>
$content
<footer>Made on $date by tendon_statics $version.</footer>
</body>
</html>
""")


def write_page(
    path: Path, title: str, parts: Sequence[str], *, style: str = '', width: str = '50rem'
) -> None:
    """Write a page.

    Parameters
    ----------
    title : str
        Plain text.
    parts : sequence of str
        HTML.
    style : str
        CSS for what only this page has.
    width : str
        Of the text at most, as in CSS.

    Raises
    ------
    OutputError
        If it cannot be written.
    """
    page = _PAGE.substitute(
        title=escape(title),
        content='\n'.join(parts),
        date=date.today().isoformat(),
        version=version('tendon_statics'),
        style=style,
        width=width,
    )
    with output_file(path) as temporary:
        temporary.write_text(page, encoding='utf-8')


def paragraph(text: str) -> str:
    """Return a paragraph of plain text."""
    return f'<p>{escape(text)}</p>'


def warning(text: str) -> str:
    """Return a paragraph that stands out, of plain text."""
    return f'<p class="warning">{escape(text)}</p>'


def fact_table(facts: Facts) -> str:
    """Return keywords with what there is to say of each, of plain text."""
    rows = ''.join(f'<tr><th>{escape(k)}</th><td>{escape(v)}</td></tr>' for k, v in facts)
    return f'<table class="facts">{rows}</table>'


def figure(draw: Callable[[Figure], object], size: tuple[float, float]) -> str:
    """Return a figure; where there is no room it keeps a legible size, and scrolls."""
    return f'<div class="wide">{svg_of(draw, size)}</div>'


def table(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table of plain text; the colon of a title that `markdown_table` knows is left."""
    return html_table(titles, [[escape(cell) for cell in row] for row in rows])


def html_table(titles: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return a table whose cells are HTML."""
    head = ''.join(f'<th>{escape(title.removesuffix(":"))}</th>' for title in titles)
    body = ''.join('<tr>' + ''.join(f'<td>{cell}</td>' for cell in row) + '</tr>' for row in rows)
    return (
        f'<div class="wide"><table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>'
        '</div>'
    )
