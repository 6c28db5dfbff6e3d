"""Tables as Markdown, which reads well on a terminal too, and lines of facts."""

from __future__ import annotations

from collections.abc import Sequence

Facts = Sequence[tuple[str, str]]
"""Keywords with what there is to say of each"""


def fact_lines(facts: Facts) -> str:
    """Lay out facts, a line each."""
    return '\n'.join(f'{keyword:<13} {text}' for keyword, text in facts)


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Lay out a table with columns of even width; a column headed ``...:`` is right-aligned."""
    titles = [title.removesuffix(':') for title in header]
    right = [title.endswith(':') for title in header]
    widths = [max(map(len, column)) for column in zip(titles, *rows, strict=True)]

    def line(cells: Sequence[str]) -> str:
        return (
            '| '
            + ' | '.join(
                cell.rjust(width) if is_right else cell.ljust(width)
                for cell, width, is_right in zip(cells, widths, right, strict=True)
            )
            + ' |'
        )

    rule = '|'.join(
        '-' * (width + 1) + (':' if is_right else '-')
        for width, is_right in zip(widths, right, strict=True)
    )
    return '\n'.join([line(titles), f'|{rule}|', *map(line, rows)])
