"""What the drawings of a unit and of an arm have in common."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from bokeh.models import Arrow, ColumnDataSource, NormalHead, Range1d
from bokeh.plotting import figure

from ..physics import Load

INK, PALE, GRAVITY, FORCE = '#222222', '#e4e4e4', '#555555', '#c61a1a'

UPRIGHT = 0.5 * math.pi
"""What the browser takes the axis for at zero bend: it counts from X, and to the left"""

LOADS = ('x0', 'z0', 'x1', 'z1', 'colour')
"""Columns of the arrows that `loads_of` returns"""


def columns(names: Sequence[str], rows: Sequence[Sequence[Any]]) -> dict[str, list[Any]]:
    """Return rows by their columns, as a browser is sent them."""
    return {name: [row[place] for row in rows] for place, name in enumerate(names)}


def empty_frame(name: str, width: float, bottom: float, top: float) -> figure:
    """Make a figure without lines or axes, as wide to the left as to the right."""
    plot = figure(
        name=name,
        x_range=Range1d(-width, width),
        y_range=Range1d(bottom, top),
        aspect_ratio=2.0 * width / (top - bottom),
        sizing_mode='stretch_width',
        toolbar_location=None,
        tools='',
        outline_line_color=None,
    )
    plot.axis.visible = plot.grid.visible = False
    return plot


def name_sides(plot: figure, x: float, z: float, what: str) -> None:
    """Write on either side which of the two sides it is, of what."""
    plot.text(
        x=[-x, x],
        y=[z, z],
        text=[f'{what} l', f'{what} s'],
        text_align='center',
        text_color=GRAVITY,
        text_font_size='13px',
    )


def draw_loads(plot: figure, source: ColumnDataSource) -> None:
    """Draw the arrows that a source with the columns of `LOADS` has."""
    plot.add_layout(
        Arrow(
            end=NormalHead(size=9, fill_color='colour', line_color='colour'),
            x_start='x0',
            y_start='z0',
            x_end='x1',
            y_end='z1',
            line_color='colour',
            line_width=2,
            source=source,
        )
    )


def loads_of(
    load: Load | None,
    corner: tuple[float, float],
    tip: tuple[float, float] | None,
    *,
    half: float,
    length: float,
) -> list[tuple[Any, ...]]:
    """Return the arrows of a load; none if it is not known.

    Parameters
    ----------
    corner : tuple of float
        Where the middle of gravity's arrow is.
    tip : tuple of float
        Where the force at the tip acts, and its arrow ends; None if that is not known.
    half, length : float
        Half of how long gravity's arrow is, and how long is that of the force.
    """
    if load is None:
        return []
    x, _, z = load.gravity_direction
    at_x, at_z = corner
    arrows: list[tuple[Any, ...]] = [
        (at_x - half * x, at_z - half * z, at_x + half * x, at_z + half * z, GRAVITY)
    ]
    force = math.hypot(*load.tip_force)
    if force > 0.0 and tip is not None:
        along_x, along_z = (length * part / force for part in load.tip_force)
        arrows.append((tip[0] - along_x, tip[1] - along_z, *tip, FORCE))
    return arrows
